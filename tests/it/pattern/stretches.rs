//! Layer 84 with the curved parts of an outline alone: each is cut in the place of the edges that it draws anew.

use cutc::machine::Job;
use cutc::machine::patterns::Curves;
use fastrand::Rng;

use super::audit::broken;
use super::curves::{Outline, apart, flower, laid, points};
use super::writer::{Drawn, Place, Writer};
use super::{as_read, source};

/// The sides of an outline from corner to corner, in fine chords.
fn sides(outline: &Outline) -> Vec<Vec<Place>> {
    let corners = outline.vertices.iter().zip(&outline.is_corner).filter(|(_, is_corner)| **is_corner);
    let at = |corner: &Place| outline.fine.iter().position(|place| place == corner).expect("a corner is on the curve");
    let starts: Vec<usize> = corners.map(|(corner, _)| at(corner)).collect();
    let again = [&outline.fine[..], &outline.fine[..1]].concat();
    let ends = starts[1..].iter().copied().chain([outline.fine.len()]);
    starts.iter().zip(ends).map(|(&start, end)| again[start..=end].to_vec()).collect()
}

#[test]
fn curves_that_layer_84_draws_one_by_one_are_cut_along_them() {
    let mut of_parts = 0;
    for seed in 0..40 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(3..8);
        let outline = flower(&mut random, count);
        let mut curved: Vec<Vec<Place>> = sides(&outline).into_iter().filter(|side| side.len() > 2).collect();
        if curved.is_empty() {
            continue;
        }
        of_parts += usize::from(curved.len() < count);
        random.shuffle(&mut curved);
        for drawn in Drawn::ALL {
            let write = |sides: &[Vec<Place>], random: &mut Rng| {
                let mut file = Writer::begin();
                file.block("A");
                outline.write(&mut file, 1, drawn);
                for side in sides {
                    let mut side = side.clone();
                    if random.bool() {
                        side.reverse();
                    }
                    file.polyline(84, &side, false);
                }
                file.end_block();
                source(file.end(&["UNITS: METRIC", "AUTHOR: CLO"]))
            };
            let whole = write(&curved, &mut random);
            let (marker, found) = as_read(&whole, &Job::default());
            assert_eq!(found, ["dxf/curves"], "{seed} {drawn:?}");
            let (cut, wanted) = (points(&marker), laid(&outline.fine));
            let worst = apart(&cut, &wanted).max(apart(&wanted, &cut));
            assert!(worst < 0.01, "seed {seed}, {drawn:?}: {worst}");
            assert_eq!(broken(&whole, &marker, &Job::default()), [""; 0], "seed {seed}, {drawn:?}");
            let mut straight = Job::default();
            straight.profile.dxf.curves = Curves::Points;
            let (chords, _) = as_read(&whole, &straight);
            assert!(broken(&whole, &chords, &Job::default()).contains(&"source/points"), "{seed} {drawn:?}");
            // One that is not drawn is laid by the rule of the system.
            if curved.len() > 1 {
                let part = write(&curved[1..], &mut random);
                let (marker, found) = as_read(&part, &Job::default());
                // Where lines meet the rule has corners.
                if matches!(drawn, Drawn::Closed | Drawn::FirstIsLast) {
                    assert_eq!(found, ["dxf/curves", "dxf/curves"], "{seed} {drawn:?}");
                }
                assert_eq!(broken(&part, &marker, &Job::default()), [""; 0], "seed {seed}, {drawn:?}");
            }
        }
    }
    assert!(of_parts > 20, "{of_parts}");
}

/// A rectangle whose upper edge bows, and a line on layer 84.
fn bowed(fine: &[Place]) -> (Vec<&'static str>, usize, Vec<&'static str>) {
    let mut file = Writer::begin();
    file.block("A").polyline(1, &RECTANGLE, true).polyline(84, fine, false).end_block();
    let source = source(file.end(&["UNITS: METRIC"]));
    let (marker, found) = as_read(&source, &Job::default());
    (found, points(&marker).len() - 1, broken(&source, &marker, &Job::default()))
}

const RECTANGLE: [Place; 4] = [[0.0, 0.0], [300.0, 0.0], [300.0, 100.0], [0.0, 100.0]];

#[test]
fn a_curve_over_one_edge_is_taken_and_a_line_elsewhere_is_told() {
    let none: [&str; 0] = [];
    let bow = [[300.0, 100.0], [200.0, 108.0], [100.0, 108.0], [0.0, 100.0]];
    assert_eq!(bowed(&bow), (vec!["dxf/curves"], 6, none.to_vec()));
    let [first, .., last] = [[300.03, 100.0], bow[1], bow[2], [0.0, 99.97]];
    assert_eq!(bowed(&[first, bow[1], bow[2], last]), (vec!["dxf/curves"], 6, none.to_vec()));
    // Nearer to another edge than to its own: the control polygon of a curve that layer 1 draws.
    let polygon = [[300.0, 100.0], [300.0, -20.0], [0.0, -20.0], [0.0, 100.0]];
    assert_eq!(bowed(&polygon), (vec!["dxf/curve-missed"], 4, none.to_vec()));
    // From amid an edge.
    let amid = [[300.0, 100.0], [200.0, 108.0], [100.0, 108.0], [50.0, 100.0]];
    assert_eq!(bowed(&amid), (vec!["dxf/curve-missed"], 4, none.to_vec()));
    // A copy of an edge says nothing new.
    assert_eq!(bowed(&[[300.0, 100.0], [0.0, 100.0]]), (Vec::new(), 4, none.to_vec()));
}
