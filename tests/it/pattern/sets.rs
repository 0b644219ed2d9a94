//! Which pieces of a set are cut, where they lie, and what commands say of them.

use cutc::machine::Job;
use cutc::machine::patterns::{Patterns, Quantity, Sizes};

use super::writer::{Drawn, Writer};
use super::{as_read, source};
use crate::support::room::{DONE, FAULTY, Room};

/// Two pieces in three sizes, the width of one telling its size; the second is cut right and left.
fn set(texts: &[&str]) -> String {
    let mut file = Writer::begin();
    for (size, width) in [("S", 100.0), ("M", 110.0), ("L", 120.0)] {
        let places = [[0.0, 0.0], [width, 0.0], [width, 50.0], [20.0, 60.0], [0.0, 50.0]];
        file.block(&format!("FRONT-{size}")).outline(1, &places, Drawn::Closed).outline(14, &places, Drawn::Closed);
        file.text(&format!("Size :  {size}")).text("QUANTITY: 1").end_block();
        file.block(&format!("SIDE-{size}")).outline(1, &places[..3], Drawn::Closed);
        file.text(&format!("SIZE:{size}")).text("Quantity: 1,1").end_block();
    }
    file.end(&[&["UNITS: METRIC"], texts].concat())
}

/// Widths of what is cut.
fn widths(text: &str, patterns: Patterns) -> (Vec<f64>, Vec<&'static str>) {
    let (marker, found) = as_read(&source(text), &Job { patterns, ..Job::default() });
    let width = |(_, contour): (usize, &cutc::ir::marker::Contour)| {
        let xs: Vec<f64> = marker.points(contour).iter().map(|point| point.x).collect();
        xs.iter().copied().fold(f64::MIN, f64::max) - xs.iter().copied().fold(f64::MAX, f64::min)
    };
    (marker.contours().map(width).collect(), found)
}

fn of(sizes: &str) -> Patterns {
    Patterns { sizes: Sizes::parse(sizes), ..Patterns::default() }
}

#[test]
fn the_sample_size_is_cut_unless_others_are_asked_for() {
    let sample = set(&["SAMPLE SIZE: m"]);
    assert_eq!(widths(&sample, Patterns::default()), (vec![110.0; 3], vec!["dxf/cutting-sample", "dxf/unit-doubted"]));
    assert_eq!(widths(&sample, of("s")).0, [100.0; 3]);
    assert_eq!(widths(&sample, of("L,S")).0, [[100.0; 3], [120.0; 3]].concat());
    assert_eq!(widths(&sample, of("all")).0.len(), 9);
    assert_eq!(widths(&sample, of("XL")), (vec![], vec!["dxf/no-size"]));
    assert_eq!(widths(&set(&[]), Patterns::default()), (vec![], vec!["dxf/which-size"]));
    assert_eq!(widths(&set(&["SAMPLE SIZE: 40"]), Patterns::default()), (vec![], vec!["dxf/which-size"]));
    assert_eq!(widths(&set(&[]), of("M")).0, [110.0; 3]);
}

#[test]
fn a_size_is_said_with_a_colon_an_equals_sign_or_a_blank() {
    for sign in [":", ": ", "=", " = ", " - "] {
        let mut text = set(&["Sample size = 38"]);
        for (letter, number) in [("S", "36"), ("M", "38"), ("L", "40")] {
            for before in [format!("Size :  {letter}"), format!("SIZE:{letter}")] {
                text = text.replace(&before, &format!("Size{sign}{number}"));
            }
        }
        let found = widths(&text, Patterns::default());
        assert_eq!(found, (vec![110.0; 3], vec!["dxf/cutting-sample", "dxf/unit-doubted"]), "`{sign}`");
    }
}

#[test]
fn pieces_lie_beside_each_other_and_the_left_one_is_mirrored() {
    let job = Job { patterns: of("M"), ..Job::default() };
    let (marker, _) = as_read(&source(set(&[])), &job);
    let boxes = marker.contours().map(|(_, contour)| cutc::geom::Extent::of(&marker.points(contour)));
    let boxes: Vec<[f64; 4]> = boxes.map(|e| [e.min.x, e.min.y, e.max.x, e.max.y]).collect();
    assert_eq!(boxes, [[0.0, 0.0, 110.0, 60.0], [130.0, 0.0, 240.0, 50.0], [260.0, 0.0, 370.0, 50.0]]);
    let area = |k: usize| {
        let (_, contour) = marker.contours().nth(k).expect("three");
        cutc::geom::ring::area(&marker.points(contour))
    };
    assert!(area(1) > 0.0 && area(2) == -area(1));
    let once = Patterns { quantity: Some(Quantity::One), ..of("M") };
    assert_eq!(widths(&set(&[]), once).0.len(), 2);
}

#[test]
fn commands_take_sizes_and_sew_by_layers() {
    let room = Room::new();
    room.write("set.dxf", set(&["SAMPLE SIZE: M"]).as_bytes());
    let said = room.says("compile set.dxf -t csv", DONE);
    assert!(said.contains("3 pieces of size M") && said.contains("rules hold"), "{said}");
    assert!(room.says("verify set.csv --source set.dxf", DONE).contains("hold"));
    assert!(room.says("verify set.csv --source set.dxf --size L", FAULTY).contains("verify/"));
    let said = room.says("info set.dxf --size all --quantity one --labels", DONE);
    assert!(said.contains("outline") && said.contains("seam line") && said.contains("pieces     6"), "{said}");
    assert!(room.says("check set.dxf --size XXL", FAULTY).contains("its sizes are S, M, L"));
    for line in ["14", "seam"] {
        let said = room.says(&format!("sew set.dxf --line {line} -t queue -o {line}.queue.csv"), DONE);
        assert!(said.contains("in 1 run"), "{said}");
    }
    assert_eq!(room.read("14.queue.csv"), room.read("seam.queue.csv"));
    assert!(room.says("sew set.dxf --line 14 --size all -t queue -o all.queue.csv", DONE).contains("in 3 runs"));
    assert!(room.says("sew set.dxf --line 9 -t queue", FAULTY).contains("pens or layers are 1, 14"));
}

/// The words of a row of the list of what is read.
fn listed(row: &str) -> Vec<&'static str> {
    let words = cutc::front::by_name("pattern").expect("a dialect").words;
    let row = words.iter().find(|word| word.words == row).expect("a row of keys");
    row.about.split(", ").map(|key| key.trim_matches('`')).collect()
}

#[test]
fn every_key_of_the_list_is_read_and_read_again() {
    let [sizes, samples, counts] = ["keys of a size", "keys of the sample size", "keys of a quantity"].map(listed);
    for k in 0..sizes.len().max(samples.len()).max(counts.len()) {
        let [size, sample, count] = [&sizes, &samples, &counts].map(|keys| keys[k % keys.len()].to_ascii_lowercase());
        let mut file = Writer::begin();
        for (name, width) in [("38", 100.0), ("40", 110.0)] {
            file.block(name).outline(1, &[[0.0, 0.0], [width, 0.0], [width, 50.0]], Drawn::Closed);
            file.text(&format!("{size}: {name}")).text(&format!("{count}: 2")).end_block();
        }
        let source = source(file.end(&["UNITS: METRIC", &format!("{sample}: 38")]));
        let (marker, found) = as_read(&source, &Job::default());
        assert_eq!(found, ["dxf/cutting-sample"], "{size} {sample} {count}");
        assert_eq!(marker.contours().count(), 2, "{size} {sample} {count}");
        let places = cutc::verify::CutPlaces::of(&marker);
        let findings = cutc::verify::pattern_audit(source.bytes(), &places, &Job::default());
        assert!(findings.iter().all(cutc::ir::Finding::holds), "{size} {sample} {count}: {findings:?}");
    }
}
