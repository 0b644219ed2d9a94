//! Points that mark the vertices of outlines: turn points, curve points and notches.

use cutc::machine::Job;
use fastrand::Rng;

use super::audit::broken;
use super::curves::flower;
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
