//! Parts that lie over each other: some millimetres are told, more is refused, and both ways out lead out.

use std::fmt::Write as _;

use crate::support::room::{DONE, FAULTY, Room};

/// A cut file with a closed line around each rectangle, given by two corners in mm, every one of them a piece.
fn cut(rectangles: &[[f64; 4]]) -> String {
    let mut blocks = "H1*G71*".to_owned();
    for (number, corners) in (1..).zip(rectangles) {
        let [x, y, right, top] = corners.map(|mm| (10.0 * mm).round());
        let _ = write!(blocks, "N{number}*M15*X{x}Y{y}*M14*X{right}Y{y}*X{right}Y{top}*X{x}Y{top}*X{x}Y{y}*M15*");
    }
    blocks + "M0*"
}

const PART: [f64; 4] = [0.0, 0.0, 300.0, 200.0];
const DEEP: &str = "error[marker/deep-overlap]";
const SHALLOW: &str = "warning[marker/overlapping-pieces]";

/// Findings on a part and another rectangle, with options.
fn said(other: [f64; 4], options: &str, code: i32) -> String {
    Room::with("two.cut", &cut(&[PART, other])).expect(&format!("check two.cut {options}"), code).1
}

#[test]
fn parts_overlap_by_some_millimetres_and_no_more() {
    let beside = |depth: f64| [300.0 - depth, 20.0, 500.0, 150.0];
    assert!(said(beside(4.9), "", DONE).contains(SHALLOW));
    let deep = said(beside(5.2), "", FAULTY);
    assert!(deep.contains(DEEP) && deep.contains("pieces 1 and 2 lie over each other by 5.20 mm\n"), "{deep}");
    assert!(said(beside(2.0), "--set nest.overlap_mm=1.5", FAULTY).contains(DEEP));
    assert!(said(beside(40.0), "--set nest.overlap_mm=40.5", DONE).contains(SHALLOW));
    assert!(!said(beside(0.1), "--set nest.overlap_mm=0", DONE).contains("overlap"));
}

#[test]
fn a_part_that_lies_in_another_for_a_quarter_is_refused_however_shallow() {
    // A label box of 8 mm across the edge, and a copy of the part 3 mm aside.
    let label = said([100.0, 196.0, 150.0, 204.0], "", FAULTY);
    assert!(label.contains(DEEP) && label.contains("by 4.00 mm, 50 % of piece 2"), "{label}");
    let copy = said([3.0, 0.0, 303.0, 200.0], "", FAULTY);
    assert!(copy.contains(DEEP) && copy.contains("by 3.00 mm, 99 % of piece 1"), "{copy}");
    assert!(said([100.0, 198.4, 150.0, 206.4], "", DONE).contains(SHALLOW));
    // A mark that stands on the edge is no part, and neither is one within a part.
    assert!(said([100.0, 194.0, 112.0, 206.0], "", DONE).contains(SHALLOW));
    assert!(!said([100.0, 100.0, 150.0, 150.0], "", DONE).contains("overlap"));
}

#[test]
fn a_deep_overlap_has_two_ways_out_and_pens_may_draw_it() {
    let room = Room::with("two.cut", &cut(&[PART, [100.0, 100.0, 500.0, 300.0], [600.0, 0.0, 700.0, 100.0]]));
    room.expect("compile two.cut -o a.csv", FAULTY);
    assert!(!room.has("a.csv"));
    for way in ["--skip 2", "--skip 1", "--pieces 2-3", "--set nest.overlap_mm=off"] {
        let said = room.expect(&format!("compile two.cut -o a.csv --force {way}"), DONE).1;
        assert!(said.contains("warning[marker/overlapping-pieces]"), "{way}: {said}");
    }
    room.expect("compile two.cut -o a.csv --skip 3", FAULTY);
    room.expect("compile two.cut -o pen.csv --set tool.kind=pen --set knife.width_mm=0", DONE);
    room.expect("compile two.cut -o router.csv --set tool.kind=router --set knife.width_mm=0", FAULTY);
}

#[test]
fn open_lines_in_a_part_take_no_cloth_from_it() {
    let room = Room::with(
        "line.cut",
        "H1*G71*N1*M15*X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*N2*X500Y400*M14*X500Y1500*M15*M0*",
    );
    assert!(room.expect("check line.cut", DONE).1.contains(SHALLOW));
}

#[test]
fn plots_over_each_other_are_told_in_few_lines_the_deepest_first() {
    let job = |off: u32| {
        let part = |k: u32| {
            let (x, y) = (off * (k + 1) + 5000 * (k % 8), 5000 * (k / 8));
            format!("PU{x},{y};PD{},{y},{},{},{x},{},{x},{y};", x + 4000, x + 4000, y + 3000, y + 3000)
        };
        format!("IN;SP1;{}PU;SP0;", (0..40).map(part).collect::<String>())
    };
    let room = Room::with("jobs.plt", &format!("{}{}", job(0), job(20)));
    let (_, said) = room.expect("check jobs.plt", FAULTY);
    assert!(said.lines().count() < 60, "{said}");
    let depths = said.lines().filter(|line| line.starts_with(DEEP));
    let depths: Vec<f64> =
        depths.filter_map(|line| line.split(" by ").nth(1)?.split(' ').next()?.parse().ok()).collect();
    assert!(depths.len() == 20 && depths.is_sorted_by(|a, b| a >= b) && depths[0] > 19.0, "{depths:?}");
    assert!(said.contains("warning[hpgl/several-pages]") && said.lines().all(|line| line.len() <= 110), "{said}");
}
