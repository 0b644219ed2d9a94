//! An outline that runs past its own start, or goes round again in one stroke, is the part that it is without that.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::ir::marker::Contour;
use cutc::machine::Job;
use cutc::pipeline;
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
