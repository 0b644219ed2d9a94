//! Overlaps that are left out, or that a declaration excuses for which the drawing has no cause.

use std::f64::consts::TAU;

use cutc::geom::Heading;
use cutc::ir::Marker;
use cutc::ir::declaration::{Declaration, Kind, Which};
use cutc::ir::list::Segment;
use cutc::ir::marker::{Contour, Piece};
use cutc::machine::Job;
use cutc::pipeline::Declared;

use crate::loopholes::program::{Program, broken, circle, p};
use crate::support;

/// A ring that is cut once round and over its start by a part of the overlap, mm.
fn lapped(overlap: f64) -> Vec<&'static str> {
    let (marker, radius) = (circle(20.0), 20.0);
    let mut program = Program::new(&Job::default());
    program.plunge(p(100.0 + radius, 50.0), 90.0, 1);
    program.along(300.0, Program::down(1), |x| {
        let turn = (TAU + overlap / radius) * x;
        let tip = p(100.0, 50.0) + Heading::new(turn).unit() * radius;
        let centre = tip - Heading::new(turn + TAU / 4.0).unit() * 0.25;
        [centre.x, centre.y, 90.0 + turn.to_degrees()]
    });
    program.lift();
    broken(&program.judge(&marker))
}

#[test]
fn a_ring_goes_on_over_its_own_start() {
    for missing in [0.0, 0.08] {
        assert!(!lapped(0.8 - missing).contains(&"verify/overlap"), "{missing}");
    }
    for missing in [0.12, 0.2, 0.4, 0.6, 0.8] {
        assert!(lapped(0.8 - missing).contains(&"verify/overlap"), "{missing}");
    }
}

/// A line of 8 mm from X 100 on that is cut by plunges with their tips at these X.
fn plunged(tips: &[f64]) -> Vec<&'static str> {
    let mut program = Program::new(&Job::default());
    for &tip in tips {
        program.plunge_cut(p(tip, 50.0), 0.0, 1);
    }
    broken(&program.judge(&support::marker(&[p(100.0, 50.0), p(108.0, 50.0)])))
}

#[test]
fn one_of_the_plunges_that_reach_an_end_has_its_overlap() {
    for tips in [[106.1, 107.95, 108.8], [106.1, 108.8, 107.95], [107.95, 106.1, 108.8]] {
        assert!(!plunged(&tips).contains(&"verify/overlap"), "{tips:?}");
    }
    for tips in [[106.1, 107.95], [107.95, 106.1], [106.6, 108.8]] {
        assert!(plunged(&tips).contains(&"verify/overlap"), "{tips:?}");
    }
}

/// The line from X 100 to 200 with an overlap of 0.01 mm at its end, which is declared as shortened.
fn shortened(marker: &Marker) -> Vec<&'static str> {
    let mut program = Program::new(&Job::default());
    program.run(p(99.5, 50.0), p(200.01, 50.0), 1);
    program.declared = Some(Declared::new(vec![Declaration {
        kind: Kind::Shortened,
        cut: 0,
        from_mm: 0.0,
        to_mm: 100.0,
        end: Some(Which::End),
        part: None,
        magnitude_mm: 0.79,
        at_mm: [0.0; 2],
        seen_mm: None,
        within: None,
    }]));
    broken(&program.judge(marker))
}

#[test]
fn a_shortened_overlap_needs_something_in_its_way() {
    let line = support::marker(&[p(100.0, 50.0), p(200.0, 50.0)]);
    assert!(shortened(&line).contains(&"verify/overlap"));
    for (ahead, is_cause) in [(0.5, true), (3.0, false)] {
        let mut marker = line.clone();
        let x = 200.0 + ahead;
        let corners = [p(x, 40.0), p(x + 20.0, 40.0), p(x + 20.0, 60.0), p(x, 60.0), p(x, 40.0)];
        let other = support::marker(&corners);
        let chain: Vec<Segment> = other.list.walk(other.pieces[0].contours[0].range).map(|(_, one)| one).collect();
        let range = marker.list.append(chain).expect("four sides");
        marker.pieces.push(Piece { number: 2, contours: vec![Contour { range, closed: true }], ..Piece::default() });
        assert_eq!(!shortened(&marker).contains(&"verify/overlap"), is_cause, "{ahead}");
    }
}

/// Codes of the rules that a plunge over a slit of 3 mm amid a part breaks: it goes 1.8 mm into the part at either end, and
/// declares some of these ends.
fn declared_at(job: &Job, ends: &[Which]) -> Vec<&'static str> {
    let corners = [p(100.0, 0.0), p(200.0, 0.0), p(200.0, 100.0), p(100.0, 100.0), p(100.0, 0.0)];
    let mut marker = support::marker(&corners);
    let slit = support::marker(&[p(150.0, 50.0), p(153.0, 50.0)]);
    let chain: Vec<Segment> = slit.list.walk(slit.pieces[0].contours[0].range).map(|(_, one)| one).collect();
    let range = marker.list.append(chain).expect("one side");
    marker.pieces[0].contours.insert(0, Contour { range, closed: false });
    let mut program = Program::new(job);
    program.plunge_cut(p(154.8, 50.0), 0.0, 1);
    let entry = |&end: &Which| Declaration {
        kind: Kind::Surplus,
        cut: 0,
        from_mm: 0.0,
        to_mm: 3.0,
        end: Some(end),
        part: Some(0),
        magnitude_mm: 1.8,
        at_mm: [0.0; 2],
        seen_mm: None,
        within: None,
    };
    program.declared = Some(Declared::new(ends.iter().map(entry).collect()));
    broken(&program.judge(&marker))
}

#[test]
fn the_surplus_of_each_end_is_declared_by_itself() {
    let mut two_edges = Job::default();
    two_edges.profile.knife.edges = 2;
    for job in [&Job::default(), &two_edges] {
        let both = declared_at(job, &[Which::Start, Which::End]);
        assert!(!both.contains(&"verify/declared"), "{both:?}");
        for ends in [&[Which::Start][..], &[Which::End], &[]] {
            assert!(declared_at(job, ends).contains(&"verify/declared"), "{ends:?}");
        }
    }
}
