//! Notches: what a plot draws as marks is what a cut file has in its outline.

use cutc::front::by_name;
use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pipeline::{self, Report};

use super::audit::audit;
use super::{as_read, read, rectangle, source};

/// The points of the first outline from its least one on, in 1/40 mm.
fn outline(marker: &Marker) -> Vec<[i64; 2]> {
    let contour = marker.contours().next().expect("an outline").1;
    let mut points: Vec<[i64; 2]> = marker.points(contour).into_iter().map(super::key).collect();
    points.pop();
    let least = (0..points.len()).min_by_key(|&i| points[i]).expect("points");
    points.rotate_left(least);
    points
}

/// A part of 200 by 100 mm with a mark of two legs; the notches of each kind in the marker behind the passes.
fn check(mark: &str, slits: usize, vees: usize) -> Marker {
    let source = source(format!("IN;SP1;{}{mark}PU;SP0;", rectangle(0, 0, 8000, 4000)));
    assert_eq!(audit(&source, &as_read(&source, &Job::default()), &Job::default()), [], "{mark}");
    let (marker, found) = read(&source, &Job::default());
    let report = Report::of(&marker, "hpgl");
    assert_eq!((report.notches.slit, report.notches.v), (slits, vees), "{mark} {found:?}");
    marker
}

#[test]
fn a_mark_of_two_legs_is_one_v_notch_and_the_marker_is_that_of_a_cut_file() {
    let cut = "H1*G71*M15*N1*X0Y0*M14*X970Y0*X1000Y60*X1030Y0*X2000Y0*X2000Y1000*X0Y1000*X0Y0*M15*M0*";
    let cut = source(cut);
    let mut found = cutc::diagnostic::Diagnostics::default();
    let cut = pipeline::read(&cut, by_name("iso"), &Job::default(), &mut found).expect("a cut file").marker;
    assert_eq!(Report::of(&cut, "iso").notches.v, 1);
    for mark in [
        "PU3880,0;PD4000,240,4120,0;",
        "PU4120,0;PD4000,240,3880,0;",
        "PU3880,0;PD4000,240;PU4120,0;PD4000,240;",
        "PU4000,240;PD3880,0;PU4000,240;PD4120,0;",
    ] {
        let plotted = check(mark, 0, 1);
        assert_eq!(outline(&plotted), outline(&cut), "{mark}");
        let [a, b] = [&cut, &plotted].map(|marker| marker.pieces[0].outline_notches[0]);
        assert_eq!(super::key(a.tip), super::key(b.tip));
        assert!((a.depth() - b.depth()).abs() < 1e-9 && (a.width() - b.width()).abs() < 1e-9);
        assert!((a.inwards() - b.inwards()).norm() < 1e-9);
    }
}

#[test]
fn marks_on_an_outline_with_a_small_gap_are_cut_like_the_outline() {
    let gapped = "PU0,0;PD8000,0,8000,4000,0,4000,0,20;";
    let marks =
        "PU1000,0;PD1000,200;PU2000,4000;PD2000,3800,2000,4000;PU3880,0;PD4000,240,4120,0;PU6000,2000;PD6000,2200;";
    let source = source(format!("IN;SP1;{gapped}{marks}PU;SP0;"));
    let marker = as_read(&source, &Job::default());
    assert_eq!(audit(&source, &marker, &Job::default()), []);
    assert_eq!(marker.pieces.len(), 1);
    let mut tips: Vec<[i64; 2]> = marker.pieces[0].notches.iter().map(|notch| super::key(notch.tip)).collect();
    tips.sort_unstable();
    assert_eq!(tips, [[1000, 200], [2000, 3800], [4000, 240], [4000, 240]]);
}

#[test]
fn a_slit_in_short_steps_is_one_slit_however_the_outline_draws_it() {
    for step in [32, 100] {
        let place = |i: i64| format!("4000,{},", i * step);
        let out: String = (1..=200 / step).map(place).collect();
        let back: String = (0..200 / step).rev().map(place).collect();
        let drawn = format!("IN;SP1;PU0,0;PD4000,0,{out}{back}8000,0,8000,4000,0,4000,0,0;PU;SP0;");
        let source = source(drawn);
        let marker = as_read(&source, &Job::default());
        assert_eq!(audit(&source, &marker, &Job::default()), []);
        let slits: Vec<_> = marker.pieces[0].notches.iter().map(|n| [super::key(n.root), super::key(n.tip)]).collect();
        assert_eq!(slits, [[[4000, 0], [4000, 200 / step * step]]], "{step}");
    }
}

#[test]
fn two_legs_that_make_no_v_notch_are_slits() {
    check("PU3600,0;PD4000,240,4400,0;", 2, 0); // wider than deep
    check("PU3880,3;PD4000,240,4120,3;", 2, 0); // beside the edge
    check("PU3880,0;PD4000,-240,4120,0;", 2, 0); // out of the part
    check("PU3880,4000;PD4000,3760,4120,4000;PU1000,0;PD1000,200;", 1, 1);
}

#[test]
fn a_v_notch_on_an_edge_of_two_parts_is_of_the_one_that_it_leads_into() {
    for (tip, piece) in [(4240, 1), (3760, 0)] {
        let parts = [rectangle(0, 0, 8000, 4000), rectangle(0, 4000, 8000, 4000)].concat();
        let text = format!("IN;SP1;{parts}PU3880,4000;PD4000,{tip},4120,4000;PU;SP0;");
        let source = source(text);
        assert_eq!(audit(&source, &as_read(&source, &Job::default()), &Job::default()), []);
        let (marker, _) = read(&source, &Job::default());
        let vees: Vec<usize> = marker.pieces.iter().map(|piece| piece.outline_notches.len()).collect();
        assert_eq!(vees, if piece == 0 { [1, 0] } else { [0, 1] });
        assert_eq!(marker.pieces[piece].outline_notches[0].tip, Point::new(100.0, f64::from(tip) / 40.0));
    }
}

#[test]
fn v_notches_in_a_cut_out_and_beside_spikes_keep_the_account() {
    let cut_out = rectangle(2000, 1000, 3000, 2000);
    let marker = check(&format!("{cut_out}PU3000,1000;PD3100,800,3200,1000;"), 0, 1);
    assert_eq!(marker.pieces[0].contours.len(), 2);
    let spiked = "IN;SP1;PU0,0;PD2000,0,2000,200,2000,0,8000,0,8000,4000,0,4000,0,0;\
                  PU3880,0;PD4000,240,4120,0;PU5880,0;PD6000,240,6120,0;PU;SP0;";
    let source = source(spiked);
    assert_eq!(audit(&source, &as_read(&source, &Job::default()), &Job::default()), []);
    let report = Report::of(&read(&source, &Job::default()).0, "hpgl");
    assert_eq!((report.notches.slit, report.notches.v), (1, 2));
}
