//! Cuts that have to meet and do not, each on its line within the tolerance: a thread of cloth is left between them.

use std::f64::consts::TAU;

use cutc::geom::{Heading, Point, Vector};
use cutc::ir::list::Segment;
use cutc::ir::marker::{Contour, Notch, NotchKind};
use cutc::machine::Job;
use cutc::source::Span;

use crate::loopholes::program::{Program, broken, circle, p};
use crate::support;

/// By how much cuts are moved apart, mm, each by half of that.
const APART: [f64; 6] = [0.02, 0.03, 0.05, 0.08, 0.11, 0.14];

/// A machine whose cuts may be off their lines by half of all that.
fn job() -> Job {
    let mut job = Job::default();
    job.profile.path.tolerance_mm = Some(0.1);
    job
}

/// The same, whose cuts end where their lines do.
fn bare() -> Job {
    let mut job = job();
    let knife = &mut job.profile.knife;
    (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (0.0, 0.0);
    (knife.heel_overlap_mm, knife.corner_heel_overlap_mm) = (0.0, 0.0);
    job
}

fn check(program: &mut Program, marker: &cutc::ir::Marker, apart: f64) {
    let found = broken(&program.judge(marker));
    assert_eq!(found.contains(&"verify/joint"), apart > 0.0, "{apart} mm apart: {found:?}");
}

#[test]
fn cuts_meet_at_corners() {
    let corners = [p(100.0, 0.0), p(200.0, 0.0), p(200.0, 100.0), p(100.0, 100.0), p(100.0, 0.0)];
    let marker = support::marker(&corners);
    for apart in [0.0].into_iter().chain(APART) {
        let mut program = Program::new(&bare());
        for (ends, block) in corners.windows(2).zip(1..) {
            let along = (ends[1] - ends[0]).normalize();
            // To the right of each, which is out of the square.
            let aside = Vector::new(along.y, -along.x) * (apart / 2.0);
            program.run(ends[0] + aside, ends[1] + aside, block);
        }
        check(&mut program, &marker, apart);
    }
}

#[test]
fn the_end_of_a_ring_meets_its_start() {
    let (marker, radius, overlap) = (circle(20.0), 20.0, 0.8);
    for apart in [0.0].into_iter().chain(APART) {
        let mut program = Program::new(&job());
        program.plunge(p(100.0 + radius + apart / 2.0, 50.0), 90.0, 1);
        program.along(300.0, Program::down(1), |x| {
            let turn = (TAU + overlap / radius) * x;
            let tip = p(100.0, 50.0) + Heading::new(turn).unit() * (radius + apart * (0.5 - x));
            let centre = tip - Heading::new(turn + TAU / 4.0).unit() * 0.25;
            [centre.x, centre.y, 90.0 + turn.to_degrees()]
        });
        program.lift();
        check(&mut program, &marker, apart);
    }
}

#[test]
fn cuts_meet_where_the_knife_is_lifted_amid_a_line() {
    let marker = support::marker(&[p(100.0, 50.0), p(200.0, 50.0)]);
    for apart in [0.0].into_iter().chain(APART) {
        let mut program = Program::new(&job());
        program.run(p(99.5, 50.0 + apart / 2.0), p(150.0, 50.0 + apart / 2.0), 1);
        program.run(p(149.0, 50.0 - apart / 2.0), p(200.8, 50.0 - apart / 2.0), 1);
        check(&mut program, &marker, apart);
    }
}

#[test]
fn a_slit_meets_the_edge_that_it_stands_on() {
    let corners = [p(100.0, 0.0), p(200.0, 0.0), p(200.0, 100.0), p(100.0, 100.0), p(100.0, 0.0)];
    let mut marker = support::marker(&corners);
    let (root, tip) = (p(150.0, 100.0), p(150.0, 88.0));
    let span = Span { block: 11, ..Span::default() };
    marker.pieces[0].notches = vec![Notch { kind: NotchKind::Slit, root, tip, percent: 100, span }];
    for apart in [0.0].into_iter().chain(APART) {
        let mut program = Program::new(&bare());
        program.run(root, tip, 11);
        for (ends, block) in corners.windows(2).zip(1..) {
            // The edge of the slit alone is cut farther out.
            let aside = if block == 3 { Vector::new(0.0, apart) } else { Vector::zeros() };
            program.run(ends[0] + aside, ends[1] + aside, block);
        }
        check(&mut program, &marker, apart);
    }
}

#[test]
fn a_cut_that_leaves_an_edge_little_by_little_meets_it() {
    let corners = [p(100.0, 0.0), p(200.0, 0.0), p(200.0, 100.0), p(100.0, 100.0), p(100.0, 0.0)];
    // From the edge into the part: straight at 3 degrees, and on an arc that begins along the edge.
    let straight: Vec<Point> = vec![p(180.0, 100.0), p(120.0, 100.0 - 60.0 * 3.0_f64.to_radians().tan())];
    let arc = |k: u32| Heading::new(TAU * f64::from(k) / 720.0).unit();
    let bent: Vec<Point> = (0..=90).map(|k| p(180.0 - 50.0 * arc(k).y, 50.0 + 50.0 * arc(k).x)).collect();
    for line in [straight, bent] {
        let mut marker = support::marker(&corners);
        let like = marker.list.walk(marker.pieces[0].contours[0].range).next().expect("it is not empty").1;
        let span = Span { block: 11, ..Span::default() };
        let segments = line.windows(2).map(|ends| Segment { from: ends[0], to: ends[1], span, ..like });
        let range = marker.list.append(segments).expect("it has a length");
        marker.pieces[0].contours.push(Contour { range, closed: false });
        // Farther than the tolerance the edge is another line.
        for apart in [0.0].into_iter().chain(APART).filter(|apart| *apart < 0.1) {
            let mut program = Program::new(&bare());
            for ends in line.windows(2) {
                program.run(ends[0], ends[1], 11);
            }
            for (ends, block) in corners.windows(2).zip(1..) {
                // The edge of the line alone is cut farther out.
                let aside = if block == 3 { Vector::new(0.0, apart) } else { Vector::zeros() };
                program.run(ends[0] + aside, ends[1] + aside, block);
            }
            check(&mut program, &marker, apart);
        }
    }
}
