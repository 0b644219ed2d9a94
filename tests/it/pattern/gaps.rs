//! Outlines that nearly close are closed as those of plots are, and wider gaps are refused with their width.

use cutc::machine::Job;
use fastrand::Rng;

use super::audit::broken;
use super::curves::{apart, laid, points};
use super::habits::star;
use super::writer::{Place, Writer};
use super::{as_read, source};

/// The strokes that are left of a ring with gaps, each amid an edge or at one of its ends, all as wide as asked for.
fn strokes(ring: &[Place], gaps: usize, width: f64, random: &mut Rng) -> Vec<Vec<Place>> {
    let mut edges: Vec<usize> = (0..ring.len()).collect();
    random.shuffle(&mut edges);
    edges.truncate(gaps);
    edges.sort_unstable();
    let mut strokes = vec![Vec::new()];
    for (k, &[x, y]) in ring.iter().enumerate() {
        strokes.last_mut().expect("a stroke").push([x, y]);
        if edges.contains(&k) {
            let [to_x, to_y] = ring[(k + 1) % ring.len()];
            let length = (to_x - x).hypot(to_y - y);
            // A stroke of one corner would be none.
            let is_corner_alone = strokes.last().is_some_and(|stroke| stroke.len() == 1);
            let from = [0.5, 1.0, 0.0][random.usize(..if is_corner_alone { 2 } else { 3 })] * (length - width);
            let at = |way: f64| [x + (to_x - x) * way / length, y + (to_y - y) * way / length];
            if from > 0.0 {
                strokes.last_mut().expect("a stroke").push(at(from));
            }
            let is_at_corner = from + width >= length;
            strokes.push(if is_at_corner { Vec::new() } else { vec![at(from + width)] });
        }
    }
    let last = strokes.pop().expect("a stroke");
    strokes[0].splice(0..0, last);
    for stroke in &mut strokes {
        if random.bool() {
            stroke.reverse();
        }
    }
    random.shuffle(&mut strokes);
    strokes
}

#[test]
fn gaps_up_to_the_key_are_closed_and_wider_ones_are_refused() {
    for seed in 0..80 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(4..9);
        let ring = star(&mut random, count, [0.0, 360.0]);
        let gaps = random.usize(1..4);
        for (width, is_closed) in [(0.3, true), (1.0, true), (1.4, true), (2.0, false), (5.0, false)] {
            let mut file = Writer::begin();
            file.block("A");
            for stroke in strokes(&ring, gaps, width, &mut random) {
                file.polyline(1, &stroke, false);
            }
            file.end_block();
            let source = source(file.end(&["UNITS: METRIC"]));
            let mut job = Job::default();
            if !is_closed {
                let (marker, found) = as_read(&source, &job);
                let is_refused = found.iter().all(|code| *code == "dxf/open-outline") && !found.is_empty();
                assert!(is_refused && marker.pieces.is_empty(), "seed {seed}, {width} mm: {found:?}");
                job.profile.drawing.close_mm = 5.1;
            }
            let (marker, found) = as_read(&source, &job);
            assert_eq!(found, ["drawing/closed"], "seed {seed}, {gaps} of {width} mm");
            let (cut, wanted) = (points(&marker), laid(&ring));
            let worst = apart(&cut, &wanted).max(apart(&wanted, &cut));
            assert!(worst < 1e-9, "seed {seed}, {gaps} of {width} mm: {worst}");
            assert_eq!(broken(&source, &marker, &job), [""; 0], "seed {seed}, {gaps} of {width} mm");
            // Where nobody wants gaps to be closed the line over a gap is too much.
            job.profile.drawing.close_mm = 0.0;
            assert!(
                width < 1.0 || broken(&source, &marker, &job).contains(&"source/length"),
                "seed {seed}, {gaps} of {width} mm"
            );
        }
    }
}

#[test]
fn two_lines_beside_each_other_are_no_outline() {
    let mut file = Writer::begin();
    file.block("A").polyline(1, &[[0.0, 0.0], [200.0, 0.0], [200.0, 90.0], [0.0, 90.0]], true);
    file.line(1, [[0.0, 40.0], [200.0, 40.0]]).line(1, [[0.0, 41.0], [200.0, 41.0]]);
    file.end_block();
    let (marker, found) = as_read(&source(file.end(&["UNITS: METRIC"])), &Job::default());
    assert!(marker.pieces.is_empty());
    assert_eq!(found, ["dxf/open-outline", "dxf/open-outline"]);
}
