//! Pages, frames and fresh starts: drawing behind one may lie on the drawing before it.

use cutc::machine::Job;

use super::{read, source};

/// Two rectangles of 100 x 80 mm: one before the end of a page, and one behind it, `off` mm to its right.
fn check(end: &str, off: f64, expected: &[&str]) {
    let rectangle = |left: f64| {
        let right = left + 4000.0;
        format!("PU{left},400;PD{right},400,{right},3600,{left},3600,{left},400;PU;")
    };
    let text = format!("IN;SP1;{}{end}SP1;{}SP0;{end}", rectangle(400.0), rectangle(400.0 + 40.0 * off));
    let (_, codes) = read(&source(text), &Job::default());
    let codes: Vec<&str> = codes.into_iter().filter(|code| code.starts_with("hpgl/")).collect();
    assert_eq!(codes, expected, "{end:?}, {off} mm aside");
}

#[test]
fn a_page_a_frame_or_a_cutter_amid_the_drawing_is_told_and_one_behind_it_is_not() {
    for off in [50.0, 120.0] {
        check("PG;", off, &["hpgl/several-pages"]);
        check("EC;", off, &["hpgl/several-pages"]);
        check("EC0;", off, &[]);
        check("FR;", off, &["hpgl/frame-advance"]);
        check("PG;FR;", off, &["hpgl/frame-advance"]);
        check("FR;IN;", off, &["hpgl/frame-advance"]);
    }
}

#[test]
fn a_fresh_start_is_told_where_the_same_place_is_drawn_again() {
    for start in ["IN;", "BP;", "\x1bE", "IN;IN;"] {
        check(start, 50.0, &["hpgl/several-pages"]);
        check(start, 100.0, &[]);
        check(start, 120.0, &[]);
    }
    check("DF;", 50.0, &[]);
}
