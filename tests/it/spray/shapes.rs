//! Shapes that ask much of a head: either planner follows what can be followed, as fast as is asked, and says what is not.

use super::{compiled, drawing, job};
use cutc::source::Source;

/// Compiles a shape by both planners, and gives what is said by them.
fn made(shape: &Source, sets: &[&str]) -> String {
    let mut all = String::new();
    for planner in ["tool.planner=optimal", "tool.planner=quintic"] {
        let sets: Vec<&str> = sets.iter().copied().chain([planner]).collect();
        let (.., said) = compiled(shape, "csv", &job(&sets))
            .unwrap_or_else(|said| panic!("{sets:?}: {said}\n{}", String::from_utf8_lossy(shape.bytes())));
        all += &said;
    }
    all
}

fn polygon(points: &[[f64; 2]]) -> Source {
    drawing("polygon.csv", points.iter().copied())
}

/// Places on a circle, `share` of it in `count` steps, from an angle on; against the clock when `radius` is positive.
fn arc(centre: [f64; 2], radius: f64, turns: [f64; 2], count: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| {
        let turn = turns[0] + (turns[1] - turns[0]) * i as f64 / count as f64;
        let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
        [centre[0] + radius * cos, centre[1] + radius * sin]
    };
    (0..=count).map(at).collect()
}

const L: [[f64; 2]; 6] = [[0.0, 0.0], [1000.0, 0.0], [1000.0, 400.0], [400.0, 400.0], [400.0, 1000.0], [0.0, 1000.0]];

#[test]
fn corners_of_less_than_the_angle_are_followed_as_straight_lines_between_corners() {
    for turn in [15.0_f64, 19.0] {
        let (sin, cos) = turn.to_radians().sin_cos();
        let [x, y] = [1000.0 + 600.0 * cos, 600.0 * sin];
        made(&polygon(&[[0.0, 0.0], [1000.0, 0.0], [x, y], [800.0, 1000.0], [0.0, 1000.0]]), &[]);
    }
}

#[test]
fn corners_are_followed_at_the_distance_of_a_nozzle() {
    for distance in ["tool.distance_mm=2", "tool.distance_mm=5", "tool.distance_mm=20"] {
        let (.., said) = compiled(&polygon(&L), "csv", &job(&[distance])).unwrap_or_else(|said| panic!("{said}"));
        assert!(said.contains("spray/unreached"), "{distance}: {said}");
    }
    assert_eq!(made(&polygon(&L), &["tool.distance_mm=100"]).matches("spray/unreached").count(), 2);
}

#[test]
fn slow_jets_are_as_fast_as_they_should_be_on_straight_edges() {
    let octagon = arc([700.0, 700.0], 300.0, [0.0, 0.875], 7);
    for speed in ["tool.edge_speed_mm_s=5", "tool.edge_speed_mm_s=20"] {
        let asked: f64 = speed.split('=').nth(1).expect("a value").parse().expect("a number");
        let (compiled, _, said) = compiled(&polygon(&octagon), "csv", &job(&[speed])).expect("a program");
        for edge in compiled.report.edges.expect("edges") {
            assert!(edge.speed_mm_s[1] > 0.97 * asked, "{speed}: {edge:?}");
        }
        assert_eq!(said, "");
    }
}

#[test]
fn bays_and_holes_as_tight_as_the_distance_are_left_out_and_said() {
    let bay =
        [vec![[0.0, 0.0], [2000.0, 0.0], [2000.0, 1000.0]], arc([1000.0, 1000.0], -300.0, [0.5, 0.0], 60)].concat();
    let bay: Vec<[f64; 2]> = bay.into_iter().chain([[0.0, 1000.0]]).collect();
    assert_eq!(made(&polygon(&bay), &[]).matches("spray/unreached").count(), 2);
}

#[test]
fn an_edge_that_the_axes_make_slow_is_told() {
    let disc = arc([800.0, 800.0], 500.0, [0.0, 0.995], 199);
    let said = made(&polygon(&disc), &["axes.c.speed_deg_s=20"]);
    assert_eq!(said.matches("spray/slow").count(), 2, "{said}");
    assert_eq!(made(&polygon(&disc), &[]), "");
}
