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
