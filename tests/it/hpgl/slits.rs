//! Slits beside other lines of their pen, and signs at an edge that look like them.

use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::verify::{DrawingCuts, drawing_audit};

use super::{as_read, key, read, source};

/// A part of 300 by 400 mm.
const PART: &str = "IN;SP1;PU0,0;PD12000,0,12000,16000,0,16000,0,0;";

fn refused(text: &str, marker: &Marker) -> Vec<&'static str> {
    let findings = drawing_audit("hpgl", text.as_bytes(), &DrawingCuts::of(marker), &Job::default());
    findings.iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect()
}

/// The slits of the part, root and tip, and the codes of what is said.
fn check(lines: &str, expected: &[[[i64; 2]; 2]], codes: &[&str]) -> String {
    let text = format!("{PART}{lines}PU;");
    let plot = source(text.as_str());
    let marker = as_read(&plot, &Job::default());
    assert_eq!(refused(&text, &marker), [] as [&str; 0], "{lines}");
    let mut found: Vec<_> = marker.pieces[0].notches.iter().map(|notch| [key(notch.root), key(notch.tip)]).collect();
    found.sort_unstable();
    assert_eq!(found, expected, "{lines}");
    assert_eq!(read(&plot, &Job::default()).1, codes, "{lines}");
    text
}

/// The same, and a marker that lacks a slit is refused.
fn check_kept(lines: &str, expected: &[[[i64; 2]; 2]], codes: &[&str]) {
    let text = check(lines, expected, codes);
    let mut lacking = as_read(&source(text.as_str()), &Job::default());
    lacking.pieces[0].notches.pop();
    assert_eq!(refused(&text, &lacking), ["source/strokes"], "{lines}");
}

const LINE: &[&str] = &["drawing/line-from-edge"];
const DIVIDED: &[&str] = &["drawing/divided-part"];

#[test]
fn a_slit_at_the_foot_of_another_line_is_a_notch() {
    let feet = [[[4000, 0], [4000, 200]], [[4800, 0], [4800, 200]]];
    let legs = "PU4000,0;PD4400,3600,4800,0;";
    let slits = "PU4000,0;PD4000,200;PU4800,0;PD4800,200;";
    check_kept(&format!("{legs}{slits}"), &feet, DIVIDED);
    check_kept(&format!("PU4000,0;PD4400,3600;PU4400,3600;PD4800,0;{slits}"), &feet, DIVIDED);
    check_kept(&format!("{slits}PU4000,0;PD4400,3600;PU4800,0;PD4400,3600;"), &feet, DIVIDED);
    let ends = [[[0, 1200], [200, 1200]], [[12_000, 1200], [11_800, 1200]]];
    check_kept("PU0,1200;PD12000,1200;PU0,1200;PD200,1200;PU12000,1200;PD11800,1200;", &ends, DIVIDED);
    check_kept("PU6000,0;PD6000,8000;PU6000,0;PD6000,240;", &[[[6000, 0], [6000, 240]]], LINE);
    let two = [[[4000, 0], [4000, 200]], [[4000, 0], [4240, 480]]];
    check_kept("PU4000,0;PD4000,200;PU4000,0;PD4240,480;", &two, &[]);
}

#[test]
fn a_slit_from_whose_tip_another_line_goes_on_is_a_notch() {
    check("PU6000,240;PD6000,8000;PU6000,0;PD6000,240;", &[[[6000, 0], [6000, 240]]], &[]);
    let ends = [[[6000, 0], [6000, 200]], [[6000, 16_000], [6000, 15_800]]];
    check("PU6000,0;PD6000,200;PU6000,16000;PD6000,15800;PU6000,200;PD6000,15800;", &ends, &[]);
    // Seam lines end at it, or run by.
    let slit = [[[6000, 0], [6000, 400]]];
    check("PU400,400;PD6000,400;PU400,15600;PD400,400;PU6000,0;PD6000,400;", &slit, &[]);
    // A line in three strokes from edge to edge is one line.
    check("PU4000,0;PD4000,240;PU4000,240;PD8000,240;PU8000,240;PD8000,0;", &[], DIVIDED);
    // A slit in two strokes is one slit.
    check("PU4000,0;PD4000,120;PU4000,120;PD4000,240;", &[[[4000, 0], [4000, 240]]], &[]);
}

#[test]
fn a_crossbar_in_two_halves_is_one() {
    check("PU4000,0;PD4000,200;PU4000,200;PD3880,200;PU4000,200;PD4120,200;", &[[[4000, 0], [4000, 200]]], &[]);
}

#[test]
fn barbs_of_arrows_and_arms_of_crosses_are_no_notches() {
    for lines in [
        "PU6000,12;PD6000,15900;PU6000,12;PD5840,400;PU6000,12;PD6160,400;",
        "PU6000,0;PD6000,400;PU6000,0;PD5880,200;PU6000,0;PD6120,200;",
        "PU0,2000;PD320,2000;PU160,1840;PD160,2160;",
        "PU0,2000;PD240,2240;PU0,2240;PD240,2000;",
        "PU8,4000;PD320,4000;PU164,3840;PD164,4160;",
        "PU0,2000;PD160,2000;PU160,2000;PD320,2000;PU160,2000;PD160,2160;PU160,2000;PD160,1840;",
    ] {
        check(lines, &[], LINE);
    }
}

#[test]
fn a_sign_that_is_cut_is_refused() {
    for [slits, sign] in [
        ["PU6000,0;PD5840,400;PU6000,80;PD6160,400;", "PU6000,0;PD6000,15900;PU6000,0;PD5840,400;PU6000,0;PD6160,400;"],
        ["PU0,2000;PD320,2000;", "PU0,2000;PD320,2000;PU160,1840;PD160,2160;"],
    ] {
        let cut = as_read(&source(format!("{PART}{slits}PU;")), &Job::default());
        assert!(!cut.pieces[0].notches.is_empty());
        assert_eq!(refused(&format!("{PART}{sign}PU;"), &cut), ["source/strokes"], "{sign}");
    }
}
