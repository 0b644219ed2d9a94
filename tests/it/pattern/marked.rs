//! Points that mark the vertices of outlines: turn points, curve points and notches.

use cutc::machine::Job;
use fastrand::Rng;

use super::audit::broken;
use super::curves::{flower, points};
use super::writer::{Drawn, Writer};
use super::{as_read, source};

#[test]
fn a_notch_that_takes_a_curve_point_away_leaves_its_piece_in_its_place() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let outline = flower(&mut random, 5);
        let smooth: Vec<usize> = (0..outline.vertices.len()).filter(|&k| !outline.is_corner[k]).collect();
        // The first curve point, or any.
        let Some(&k) = smooth.get(if seed % 2 == 0 { 0 } else { random.usize(..smooth.len().max(1)) }) else {
            continue;
        };
        for (layer, author) in [4, 81, 82, 83].into_iter().zip(["Gerber", "CLO", "Richpeace", "nobody"]) {
            let mut file = Writer::begin();
            file.block("A");
            outline.write(&mut file, 1, Drawn::FirstIsLast);
            file.point(layer, outline.vertices[k], [5.0, 4.0]).end_block();
            let source = source(file.end(&["UNITS: METRIC", &format!("AUTHOR: {author}")]));
            let (marker, _) = as_read(&source, &Job::default());
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}, layer {layer}, vertex {k}");
        }
    }
}

#[test]
fn points_that_rounding_moves_off_their_vertices_mark_them_and_others_are_told() {
    let mut random = Rng::with_seed(5);
    let outline = flower(&mut random, 5);
    let read = |off: f64| {
        let mut file = Writer::begin();
        file.block("A").outline(1, &outline.vertices, Drawn::Closed);
        for (k, [x, y]) in outline.vertices.iter().enumerate() {
            let turn = off * if k % 2 == 0 { 1.0 } else { -1.0 };
            file.point(if outline.is_corner[k] { 2 } else { 3 }, [x + turn, *y], [0.0; 2]);
        }
        file.end_block();
        let source = source(file.end(&["UNITS: METRIC", "AUTHOR: Gerber"]));
        let (marker, found) = as_read(&source, &Job::default());
        assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "{off}");
        (points(&marker), found)
    };
    let (laid, _) = read(0.0);
    for off in [0.005, 0.02, 0.05] {
        assert_eq!(read(off), (laid.clone(), vec!["dxf/curves"]), "{off}");
    }
    for off in [0.06, 0.3, 2.0] {
        let (cut, found) = read(off);
        assert_eq!((cut.len(), found), (outline.vertices.len() + 1, vec!["dxf/curve-missed"]), "{off}");
    }
}

#[test]
fn a_line_that_ends_at_a_curve_point_bends_no_curve() {
    for seed in 0..20 {
        let mut random = Rng::with_seed(seed);
        let outline = flower(&mut random, 5);
        let write = |layer: Option<u32>| {
            let mut file = Writer::begin();
            file.block("A");
            outline.write(&mut file, 1, Drawn::Closed);
            for (at, _) in outline.vertices.iter().zip(&outline.is_corner).filter(|(_, is_corner)| !**is_corner) {
                if let Some(layer) = layer {
                    file.line(layer, [*at, at.map(|value| 0.97 * value)]);
                }
            }
            file.end_block();
            source(file.end(&["UNITS: METRIC", "AUTHOR: CLO"]))
        };
        let [alone, inner, slits] = [None, Some(8), Some(1)].map(|layer| {
            let source = write(layer);
            let (marker, found) = as_read(&source, &Job::default());
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}, layer {layer:?}");
            (points(&marker), found)
        });
        assert_eq!(alone, inner, "seed {seed}");
        let mut slits = slits.0.into_iter();
        assert!(alone.0.iter().all(|at| slits.any(|of_slits| of_slits == *at)), "seed {seed}");
    }
}
