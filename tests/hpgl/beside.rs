//! What is not cut beside outlines, or cut within them, is named where it may be missed.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::machine::Job;
use cutc::machine::plot::LineKind;

use super::{rectangle, source};

/// Reads a plot: the codes, with the text that each stands at and its message.
fn found(text: &str, job: &Job) -> Vec<(&'static str, String, String)> {
    let source = source(format!("IN;SP1;{text}PU;SP0;"));
    let mut found = Diagnostics::default();
    (by_name("hpgl").expect("a dialect").read)(&source, job, &mut found);
    let place = |span: cutc::source::Span| {
        String::from_utf8_lossy(&source.bytes()[span.start as usize..span.end as usize]).into_owned()
    };
    found.iter().map(|d| (d.code.name, d.span.map(place).unwrap_or_default(), d.message.clone())).collect()
}

/// One code, at this text, with this in its message; without a code nothing is said.
fn check(text: &str, code: &str, place: &str, message: &str) {
    let found = found(text, &Job::default());
    if code.is_empty() {
        assert_eq!(found, [], "{text}");
        return;
    }
    let [(name, at, said)] = &found[..] else { panic!("{text}: {found:?}") };
    assert_eq!((*name, at.contains(place)), (code, true), "{text}: {at}");
    assert!(said.contains(message), "{text}: {said}");
}

/// A part of 300 by 300 mm.
fn part() -> String {
    rectangle(4000, 4000, 12_000, 12_000)
}

#[test]
fn an_edge_that_two_parts_share_is_named_however_they_are_drawn() {
    let half = rectangle(4000, 4000, 8000, 12_000);
    for (text, place, length) in [
        (rectangle(4000, 4000, 16_000, 12_000) + "PU12000,4000;PD12000,16000;", "12000,16000", "300.0"),
        (half.clone() + "PU12000,4000;PD20000,4000,20000,16000,12000,16000;", "20000,4000", "700.0"),
        ("PU12000,4000;PD20000,4000,20000,16000,12000,16000;".to_owned() + &half, "20000,4000", "700.0"),
        (half.clone() + "PU12000,6000;PD20000,6000,20000,14000,12000,14000;", "20000,6000", "600.0"),
        (half.clone() + "PU12038,6000;PD20000,6000,20000,14000,12038,14000;", "20000,6000", "598.1"),
    ] {
        check(&text, "hpgl/dividing-line", place, &format!("a line of {length} mm leads from one place"));
    }
    // One end in the open is a grain line; what ends farther off is none.
    check(&(half.clone() + "PU8000,4000;PD8000,12000;"), "", "", "");
    check(&(half + "PU12050,6000;PD20000,6000,20000,14000,12050,14000;"), "", "", "");
}

#[test]
fn marks_that_are_no_notches_are_named_beside_an_edge_and_across_it() {
    for mark in [
        "PU8000,4008;PD8000,4240;",                     // 0.2 mm inside
        "PU8000,4040;PD8000,4240;",                     // 1 mm inside
        "PU8000,3960;PD8000,4240;",                     // across, from 1 mm outside
        "PU8000,3840;PD8000,4160;",                     // across, halves
        "PU8000,4000;PD8000,5200;",                     // 30 mm
        "PU8000,4000;PD8000,4240,8240,4240,8240,4000;", // a U
        "PU8000,4000;PD8000,4240,7880,4240,8120,4240;", // a T in one line
        "PU8000,4000;PD8000,4240;PU7880,4240;PD8120,4240;",
    ] {
        check(&(part() + mark), "hpgl/missed-mark", "", "a mark of ");
    }
    let marks = "PU8000,4000;PD8000,4240;PU9000,4012;PD9000,4240;PU10000,3880;PD10000,4120;";
    check(&(part() + marks), "hpgl/missed-mark", "9000,4240", "2 marks, the first one here, stand");
}

#[test]
fn notches_and_marks_in_the_midst_of_a_part_or_on_a_small_hole_are_not_named() {
    check(&(part() + "PU8000,4000;PD8000,4240;PU9000,16000;PD9000,15800;"), "", "", "");
    check(&(part() + "PU8000,4100;PD8000,4300;PU9900,10000;PD10100,10000;"), "", "", "");
    check(&(part() + "PU4000,8000;PD4000,8240;PU16000,4000;PD15000,4000;"), "", "", ""); // drawn over the edge
    let hole = rectangle(9900, 9900, 200, 200);
    check(&(part() + &hole + "PU9900,10000;PD10100,10000;PU10000,9850;PD10000,10150;"), "", "", "");
}

#[test]
fn a_cut_out_that_leaves_little_of_its_part_is_named_unless_closed_lines_are_asked_for() {
    let seam = rectangle(4400, 4400, 11_200, 11_200);
    check(&(part() + &seam), "hpgl/large-cut-out", "15600,4400", "87 percent");
    check(&(part() + "SP2;" + &seam), "hpgl/large-cut-out", "15600,4400", "87 percent");
    check(&(rectangle(0, 0, 20_000, 20_000) + &part()), "hpgl/large-cut-out", "16000,4000", "36 percent");
    check(&(part() + "SP2;" + &rectangle(6000, 6000, 8000, 8000)), "hpgl/large-cut-out", "14000,6000", "44 percent");
    check(&(part() + &rectangle(6000, 6000, 4000, 4000)), "", "", "");
    let mut job = Job::default();
    job.lines.kind = Some(LineKind::Closed);
    assert_eq!(found(&(part() + &seam), &job), []);
}
