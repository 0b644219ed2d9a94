//! An outline that runs past its own start, or goes round again in one stroke, is the part that it is without that.

use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::ir::marker::Contour;
use cutc::machine::Job;
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use fastrand::Rng;

use super::audit::broken;
use super::writer::{Place, Writer};
use super::{as_read, source};

const OVERRUN: &str = "marker/overrun";
const AGAIN: &str = "marker/round-again";

/// A ring about the origin, in thousandths of a millimetre.
fn ring(random: &mut Rng) -> Vec<Place> {
    let count = random.usize(4..30);
    let corner = |k: usize| {
        let angle = k as f64 / count as f64 * std::f64::consts::TAU;
        let reach = 90.0 + 60.0 * random.f64();
        [angle.cos(), angle.sin()].map(|share| (reach * share * 1000.0).round() / 1000.0)
    };
    (0..count).map(corner).collect()
}

/// The ring as a line that goes round so often and on by so much, mm, along its own start.
fn stroke(ring: &[Place], rounds: usize, past: f64) -> Vec<Place> {
    let mut places: Vec<Place> = (0..rounds).flat_map(|_| ring.iter().copied()).chain([ring[0]]).collect();
    let mut left = past;
    for k in 0..ring.len() {
        let [a, b] = [ring[k], ring[(k + 1) % ring.len()]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        if left <= 0.0 {
            break;
        }
        let share = (left / length).min(1.0);
        places.push([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * share));
        left -= length;
    }
    places
}

/// Codes that a line asks for.
fn codes(rounds: usize, past: f64) -> Vec<&'static str> {
    [(past > 0.0).then_some(OVERRUN), (rounds > 1).then_some(AGAIN)].into_iter().flatten().collect()
}

/// How a seed draws its outline: rounds, and mm past its start.
fn way(seed: u64, random: &mut Rng) -> (usize, f64) {
    match seed % 3 {
        0 => (1, 0.5 + 9.5 * random.f64()),
        1 => (random.usize(2..4), 0.0),
        _ => (2, 0.5 + 9.5 * random.f64()),
    }
}

/// A line in polylines, the last of which goes past the start.
fn parts(places: &[Place], count: usize, corners: usize) -> Vec<&[Place]> {
    let ends: Vec<usize> = (1..count).map(|k| k * corners / count).chain([places.len() - 1]).collect();
    ends.iter().zip(std::iter::once(&0).chain(&ends)).map(|(&to, &from)| &places[from..=to]).collect()
}

#[test]
fn a_pattern_is_the_same_however_far_its_outline_runs_on() {
    for seed in 0..90 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let (rounds, past) = way(seed, &mut random);
        // A notch, a cut-out, and curve points in every second file.
        let has_curves = seed % 2 == 0;
        let hole = [[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]];
        let file = |outlines: &[&[Place]], hole: &[Place]| {
            let mut file = Writer::begin();
            file.block("A");
            for places in outlines {
                file.polyline(1, places, false);
            }
            file.polyline(11, hole, false);
            file.point(4, ring[1], [5.0, 0.0]);
            if has_curves {
                for (k, &at) in ring.iter().enumerate() {
                    file.point(if k % 2 == 0 { 3 } else { 2 }, at, [0.0; 2]);
                }
            }
            file.end_block();
            file.end(&["UNITS: METRIC", "AUTHOR: Gerber"])
        };
        // A second round in lines of its own would be lines drawn twice.
        let count = if rounds == 1 { random.usize(1..4) } else { 1 };
        let [once, places] = [stroke(&ring, 1, 0.0), stroke(&ring, rounds, past)];
        let plain = file(&parts(&once, count, ring.len()), &stroke(&hole, 1, 0.0));
        let (plain, said) = as_read(&source(plain), &Job::default());
        let bytes = file(&parts(&places, count, ring.len()), &stroke(&hole, rounds, past));
        let what = format!("seed {seed}: {rounds} rounds, {past} past, {count} lines\n{bytes}");
        let source_of = source(bytes);
        let (found, codes_found) = as_read(&source_of, &Job::default());
        assert_eq!(broken(&source_of, &found, &Job::default()), [""; 0], "{what}");
        let more: Vec<&str> = codes_found.iter().copied().filter(|code| !said.contains(code)).collect();
        assert_eq!(more, codes(rounds, past), "{what}");
        let of = |marker: &Marker| {
            let way = |contour: &Contour| {
                let points = marker.points(contour);
                points.iter().map(|at| [at.x, at.y].map(|v| (v * 1e6).round())).collect::<Vec<_>>()
            };
            let contours = marker.contours().map(|(_, contour)| (contour.closed, way(contour))).collect::<Vec<_>>();
            (contours, marker.pieces.iter().map(|piece| piece.notches.len()).collect::<Vec<_>>())
        };
        assert_eq!(of(&found), of(&plain), "{what}");
    }
}

#[test]
fn a_flag_that_closes_an_outline_behind_its_overcut_changes_nothing() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let [a, b] = [ring[0], ring[1]];
        let past = (0.9 * (b[0] - a[0]).hypot(b[1] - a[1])).min(0.5 + 9.5 * random.f64());
        let read = |places: &[Place], is_closed: bool| {
            let mut file = Writer::begin();
            file.block("A").polyline(1, places, is_closed).point(4, ring[2], [5.0, 0.0]).end_block();
            let source = source(file.end(&["UNITS: METRIC"]));
            let (marker, codes) = as_read(&source, &Job::default());
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}: {places:?}");
            let contours = marker.contours().map(|(_, contour)| marker.points(contour)).collect::<Vec<_>>();
            (contours, codes)
        };
        let [once, places] = [stroke(&ring, 1, 0.0), stroke(&ring, 1, past)];
        let (plain, _) = read(&once, false);
        assert_eq!(read(&places, true), (plain, vec![OVERRUN]), "seed {seed}: {past} past");
    }
}

#[test]
fn a_table_of_places_is_the_same_however_far_its_line_runs_on() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let (rounds, past) = way(seed, &mut random);
        let read = |places: &[Place]| {
            let rows: Vec<String> = places.iter().map(|[x, y]| format!("{x},{y}")).collect();
            let source = Source::new("a.csv", format!("x_mm,y_mm\n{}\n", rows.join("\n")).into_bytes()).expect("small");
            let mut found = Diagnostics::default();
            let input = pipeline::read(&source, by_name("csv"), &Job::default(), &mut found).expect("a dialect");
            let marker = input.marker;
            let way = |(_, contour): (usize, &Contour)| {
                let places: Vec<Place> = marker.points(contour).iter().map(|at| [at.x, at.y]).collect();
                (contour.closed, places)
            };
            let contours: Vec<(bool, Vec<Place>)> = marker.contours().map(way).collect();
            (contours, found.iter().map(|diagnostic| diagnostic.code.name).collect::<Vec<_>>())
        };
        let (plain, said) = read(&stroke(&ring, 1, 0.0));
        assert_eq!(said, [""; 0]);
        assert_eq!(read(&stroke(&ring, rounds, past)), (plain, codes(rounds, past)), "seed {seed}: {rounds}, {past}");
    }
}

/// A file of one piece with an outline through places, and nothing else.
fn alone(outline: &[Place]) -> Source {
    let mut file = Writer::begin();
    file.block("A").polyline(1, outline, false).end_block();
    source(file.end(&["UNITS: METRIC"]))
}

/// The rules that a piece breaks whose outline a file draws in one way, read of a file that draws it in another.
fn judged(drawn: &[Place], read: &[Place]) -> Vec<&'static str> {
    let (marker, said) = as_read(&alone(read), &Job::default());
    assert_eq!(marker.contours().count(), 1, "{said:?} {read:?}");
    broken(&alone(drawn), &marker, &Job::default())
}

#[test]
fn a_round_that_is_cut_twice_is_caught() {
    for seed in 0..30 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        for (rounds, past) in [(1, 0.0), (1, 6.0), (2, 0.0), (3, 4.0)] {
            let source = alone(&stroke(&ring, rounds, past));
            let (mut marker, _) = as_read(&source, &Job::default());
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}");
            let contour = marker.pieces[0].contours[0];
            let once: Vec<_> = marker.list.vertices(contour.range).collect();
            // From its start, and from there the whole round again or a stretch of it.
            for again in [once.len() - 1, 1] {
                let way = || once.iter().copied().chain(once[1..=again].iter().copied());
                let (points, spans): (Vec<_>, Vec<_>) = way().unzip();
                let range = marker.list.append_line(&points, &spans).expect("a line");
                marker.pieces[0].contours[0] = Contour { range, ..contour };
                let broken = broken(&source, &marker, &Job::default());
                assert!(broken.contains(&"source/length"), "seed {seed}: {rounds}, {past}, {again}: {broken:?}");
            }
        }
    }
}

#[test]
fn a_stretch_that_was_taken_for_a_second_round_is_missed() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let once = stroke(&ring, 1, 0.0);
        assert_eq!(judged(&once, &once), [""; 0], "seed {seed}");
        let k = random.usize(1..ring.len());
        let caught = |drawn: &[Place], what: &str| {
            let broken = judged(drawn, &once);
            assert!(!broken.is_empty(), "seed {seed}, {what}, {k}: {drawn:?}");
        };
        // A second round beside the first at one corner, and one that leaves a corner out.
        let mut beside = stroke(&ring, 2, 0.0);
        beside[ring.len() + k] = ring[k].map(|at| at * if random.bool() { 1.01 } else { 0.99 });
        caught(&beside, "beside");
        let mut shorter = stroke(&ring, 2, 0.0);
        shorter.remove(ring.len() + k);
        caught(&shorter, "shorter");
        // A stretch past the start that leaves the outline, by little and straight through the piece.
        let mut leaving = once.clone();
        let [a, b] = [ring[0], ring[1]];
        leaving.push([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * 0.1));
        let across = [a[1] - b[1], b[0] - a[0]].map(|step| 0.3 * step / (b[0] - a[0]).hypot(b[1] - a[1]));
        leaving.push([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * 0.2 + across[axis]));
        caught(&leaving, "leaving");
        let across = [&once[..], &[ring[k].map(|at| at * 0.9)]].concat();
        caught(&across, "across");
        // Another lobe that comes back to the same start.
        let lobe = [[ring[0][0] + 40.0, 15.0], [ring[0][0] + 40.0, -15.0], ring[0]];
        caught(&[&once[..], &lobe].concat(), "lobe");
        // A stretch back along the outline, and a way back beside it at one corner.
        let mut back: Vec<Place> = once.iter().rev().skip(1).copied().collect();
        caught(&[&once[..], &back[..1]].concat(), "back a stretch");
        assert_eq!(judged(&[&once[..], &back].concat(), &once), [""; 0], "seed {seed}: back");
        let corner = ring.len() - 1 - k;
        back[corner] = back[corner].map(|at| at * 1.01);
        caught(&[&once[..], &back].concat(), "back beside");
    }
}

#[test]
fn a_round_that_lacks_a_tip_of_another_is_no_repetition() {
    for seed in 0..20 {
        let plain = stroke(&ring(&mut Rng::with_seed(seed)), 1, 0.0);
        // Amid the last edge, a quarter of a millimetre high, so that the lengths differ by less than they may.
        let [a, b] = [plain[plain.len() - 2], plain[plain.len() - 1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |[a, b]: [Place; 2], station: f64, off: f64| {
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let along = [0, 1].map(|axis| (b[axis] - a[axis]) / length);
            [a[0] + along[0] * station - along[1] * off, a[1] + along[1] * station + along[0] * off]
        };
        let tip = |ends: [Place; 2], station: f64, [half, off]: [f64; 2]| {
            [(-half, 0.0), (0.0, off), (half, 0.0)].map(|(beside, off)| at(ends, station + beside, off))
        };
        let mut tipped = plain.clone();
        tipped.splice(plain.len() - 1..plain.len() - 1, tip([a, b], length / 2.0, [0.03, 0.25]));
        assert_eq!(judged(&tipped, &tipped), [""; 0], "seed {seed}");
        for [first, second] in [[&plain, &tipped], [&tipped, &plain]] {
            let drawn = [&first[..], &second[1..]].concat();
            assert!(!judged(&drawn, first).is_empty(), "seed {seed}: {drawn:?}");
        }
        // A tip of a stretch past the start: hardly farther off than a repetition may be, and hardly longer.
        let ends = [plain[0], plain[1]];
        let past = |off: f64| [&plain[..], &tip(ends, 5.0, [0.25, off]), &[at(ends, 10.0, 0.0)]].concat();
        assert_eq!(judged(&past(0.19), &plain), [""; 0], "seed {seed}");
        assert!(!judged(&past(0.204), &plain).is_empty(), "seed {seed}");
    }
}

#[test]
fn an_outline_is_cut_once_however_many_rounds_it_goes_and_whichever_way() {
    for seed in 0..40 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let once = stroke(&ring, 1, 0.0);
        let mut drawn = once.clone();
        for _ in 0..random.usize(4..9) {
            let is_back = seed % 2 == 0 && random.bool();
            drawn.extend(
                once[1..].iter().enumerate().map(|(k, at)| if is_back { once[once.len() - 2 - k] } else { *at }),
            );
        }
        assert_eq!(judged(&drawn, &once), [""; 0], "seed {seed}");
        let (read, said) = as_read(&alone(&drawn), &Job::default());
        let places = read.contours().map(|(_, contour)| read.points(contour).len()).collect::<Vec<_>>();
        assert_eq!((places, said.contains(&AGAIN)), (vec![once.len()], true), "seed {seed}");
        drawn.extend_from_slice(&[[400.0, 0.0], once[0]]);
        assert!(!judged(&drawn, &once).is_empty(), "seed {seed}");
    }
}

#[test]
fn an_outline_that_stands_twice_is_cut_once_wherever_it_starts() {
    let mut told = 0;
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let ring = ring(&mut random);
        let mut again = ring.clone();
        again.rotate_left(random.usize(..ring.len()));
        if random.bool() {
            again.reverse();
        }
        if random.bool() {
            // A vertex more amid an edge.
            let (a, b) = (again[0], again[1]);
            again.insert(1, [0, 1].map(|axis| ((a[axis] + b[axis]) * 500.0).round() / 1000.0));
        }
        let mut file = Writer::begin();
        file.block("A");
        for places in [&ring, &again] {
            file.polyline(1, places, true);
        }
        file.end_block();
        let source = source(file.end(&["UNITS: METRIC"]));
        let mut said = Diagnostics::default();
        let read =
            pipeline::read(&source, by_name("pattern"), &Job::default(), &mut said).expect("the dialect is given");
        let codes: Vec<&str> = said.iter().map(|finding| finding.code.name).collect();
        assert_eq!(read.marker.contours().count(), 1, "seed {seed}: {codes:?}");
        assert!(!codes.contains(&"marker/contour-twice"), "seed {seed}: {codes:?}");
        told += usize::from(codes.contains(&AGAIN));
        verified(&source, seed);
    }
    // Lines that are equal place by place are one from the start.
    assert!(told > 40, "{told}");
}

/// Compiles a source and judges the program.
fn verified(source: &Source, seed: u64) {
    let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
    let mut found = Diagnostics::default();
    let order = Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, &Job::default(), order, &mut Cursor::new(Vec::new()), &mut found);
    let is_made = compiled.expect("memory takes everything").is_some();
    assert!(is_made, "seed {seed}: {}", render(&found, source));
}

#[test]
fn a_spur_longer_than_a_slit_is_cut_once_and_told() {
    for (seed, length) in (0..).zip([26.0, 30.0, 60.0, 120.0, 250.0]) {
        let bent = [250.0 + length / 3.0, length];
        for way in [vec![[250.0, length]], vec![[250.0, length / 2.0], bent]] {
            let mut file = Writer::begin();
            file.block("A");
            let ring = [[0.0, 0.0], [250.0, 0.0], [500.0, 0.0], [500.0, 300.0], [0.0, 300.0], [0.0, 0.0]];
            file.polyline(1, &ring, false);
            file.polyline(1, &[&[[250.0, 0.0]], &way[..]].concat(), false);
            file.end_block();
            let source = source(file.end(&["UNITS: METRIC"]));
            let mut said = Diagnostics::default();
            let read = pipeline::read(&source, by_name("pattern"), &Job::default(), &mut said);
            let marker = read.expect("the dialect is given").marker;
            let codes: Vec<&str> = said.iter().map(|finding| finding.code.name).collect();
            assert!(codes.contains(&AGAIN), "{way:?}: {codes:?}");
            let (rings, lines): (Vec<_>, Vec<_>) = marker.contours().partition(|(_, contour)| contour.closed);
            assert_eq!((rings.len(), lines.len()), (1, 1), "{way:?}: {codes:?}");
            let mut points: Vec<Place> = marker.points(lines[0].1).iter().map(|at| [at.x, at.y]).collect();
            if points[0] != [250.0, 0.0] {
                points.reverse();
            }
            assert_eq!(points, [&[[250.0, 0.0]], &way[..]].concat());
            verified(&source, seed);
        }
    }
}
