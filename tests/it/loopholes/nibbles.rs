//! Curves under blades that never move: where they are cuts, and where they are not.

use std::f64::consts::{FRAC_PI_2, TAU};

use cutc::geom::{Heading, Point};
use cutc::machine::Job;
use cutc::pipeline::Declared;

use crate::loopholes::program::{Program, broken, circle, p};
use crate::support;

/// An open arc of 24 chords about (100, 50), from +X on through an angle.
fn arc(radius: f64, through: f64) -> Vec<Point> {
    let at = |i: i32| p(100.0, 50.0) + Heading::new(through * f64::from(i) / 24.0).unit() * radius;
    (0..=24).map(at).collect()
}

/// A line that is cut by plunges, each from one of its points on towards another, is not cut well.
fn check_badly_cut(points: &[Point], plunges: impl Iterator<Item = [usize; 2]>, rule: &str) {
    let mut program = Program::new(&Job::default());
    for [from, to] in plunges {
        let along = (points[to] - points[from]).normalize();
        let tip = points[from] + along * program.job.profile.knife.width_mm;
        program.plunge_cut(tip, along.y.atan2(along.x).to_degrees(), to as u32);
    }
    let found = broken(&program.judge(&support::marker(points)));
    assert!(found.contains(&rule), "{points:?}: {found:?}");
}

#[test]
fn a_curve_that_the_blade_covers_is_not_cut_by_one_straight_plunge() {
    for radius in [4.0, 6.0, 10.0] {
        check_badly_cut(&arc(radius, 6.0 / radius), [[0, 24]].into_iter(), "verify/on-path");
    }
}

#[test]
fn a_line_that_may_be_nibbled_is_not_cut_as_a_polygon() {
    // Its start bows away from the blade by more than is worth no word: it may be nibbled, within the tolerance.
    for radius in [4.0, 6.0, 8.0] {
        check_badly_cut(&arc(radius, 3.0), (0..24).step_by(4).map(|i| [i, i + 4]), "verify/complete");
    }
}

#[test]
fn two_bends_alike_under_the_blade_are_not_cut_straight() {
    let mut points = vec![p(100.0, 50.0)];
    for turn_deg in [0.0_f64, 25.0, 50.0] {
        points.push(points[points.len() - 1] + Heading::new(turn_deg.to_radians()).unit() * 2.0);
    }
    check_badly_cut(&points, [[0, 3]].into_iter(), "verify/on-path");
}

#[test]
fn a_plunge_cut_on_a_curve_does_not_leave_it_along_the_tangent() {
    let marker = circle(20.0);
    let mut program = Program::new(&Job::default());
    program.declared = Some(Declared::default());
    program.plunge_cut(p(120.0, 53.3), 90.0, 2);
    let start = p(120.0, 50.0);
    program.plunge(start, 90.0, 1);
    program.along(600.0, Program::down(1), |x| {
        let turn = (TAU + 0.04) * x;
        let tip = p(100.0, 50.0) + Heading::new(turn).unit() * 20.0;
        let centre = tip - Heading::new(turn + TAU / 4.0).unit() * 0.25;
        [centre.x, centre.y, 90.0 + turn.to_degrees()]
    });
    program.lift();
    let found = broken(&program.judge(&marker));
    assert!(found.contains(&"verify/declared"), "{found:?}");
}

/// A quarter circle of 3 mm about a place, of 8 chords.
fn quarter(centre: Point, from: f64) -> Vec<Point> {
    let at = |i: i32| centre + Heading::new(from + FRAC_PI_2 * f64::from(i) / 8.0).unit() * 3.0;
    (0..=8).map(at).collect()
}

/// What is found when the corner of a part, its first eight blocks, is cut by one plunge along its chord, and nothing else is.
fn covered(corner: &[Point], rest: &[Point]) -> Vec<&'static str> {
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.corner.angle_deg) = (8.89, 20.0);
    let points = [corner, rest, &corner[..1]].concat();
    let mut program = Program::new(&job);
    let way = corner[8] - corner[0];
    let tip = corner[8] + way.normalize() * ((8.89 - way.norm()) / 2.0);
    program.plunge_cut(tip, way.y.atan2(way.x).to_degrees(), 4);
    broken(&program.judge(&support::marker(&points)))
}

#[test]
fn one_plunge_cuts_a_short_curve_only_where_several_would_reach_farther_into_the_part() {
    // A bite out of a part: what the plunge leaves stands in it, and every shorter cut would lie deep in the part.
    let bite = quarter(p(100.0, 50.0), 0.0);
    let around =
        [(48.0, 23.0), (20.0, 23.0), (20.0, 110.0), (160.0, 110.0), (160.0, -20.0), (73.0, -20.0), (73.0, -2.0)];
    let around = around.map(|(x, y)| p(x, y));
    assert_eq!(covered(&bite, &around), ["verify/complete"]);
    // Around a corner that is rounded off the waste has room for shorter cuts: the plunge would cut it off for nothing.
    let lobe: Vec<Point> = quarter(p(103.0, 53.0), TAU / 2.0).into_iter().rev().collect();
    let around = [p(90.0, 110.0), p(160.0, 80.0)];
    let found = covered(&lobe, &around);
    assert!(found.contains(&"verify/overcut-part"), "{found:?}");
}

#[test]
fn a_line_may_be_nibbled_only_where_it_must_be() {
    // It begins on a curve that the blade lies far beside; behind a straight it bends again, so gently that the blade follows.
    let mut points = arc(6.0, 1.5);
    let along = |points: &[Point]| (points[points.len() - 1] - points[points.len() - 2]).normalize();
    points.push(points[points.len() - 1] + along(&points) * 40.0);
    let (start, mut heading) = (points.len() - 1, along(&points));
    for _ in 0..12 {
        points.push(points[points.len() - 1] + heading * 1.5);
        heading = Heading::new(heading.y.atan2(heading.x) + 1.5 / 20.0).unit();
    }
    for _ in 0..2 {
        points.push(points[points.len() - 1] + heading * 40.0);
    }
    let plunge_cut = |from: usize, declared: Option<Declared>| {
        let mut program = Program::new(&Job::default());
        program.declared = declared;
        let way = (points[from + 1] - points[from]).normalize();
        program.plunge_cut(points[from] + way * 6.6, way.y.atan2(way.x).to_degrees(), from as u32 + 1);
        broken(&program.judge(&support::marker(&points)))
    };
    assert_eq!(plunge_cut(8, None), ["verify/complete"]);
    // On a straight never; on a curve, and on that at its start, too, only where the program says so.
    let declares_nothing = || Some(Declared::default());
    for (from, declared) in [(points.len() - 2, None), (start + 4, declares_nothing()), (8, declares_nothing())] {
        let found = plunge_cut(from, declared);
        assert!(found.contains(&"verify/declared"), "{from}: {found:?}");
    }
}
