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
        check("EC0;", off, &[]);
        check("FR;", off, &["hpgl/frame-advance"]);
        check("PG;FR;", off, &["hpgl/frame-advance"]);
        check("FR;IN;", off, &["hpgl/frame-advance"]);
    }
}

#[test]
fn pages_over_each_other_are_refused_and_others_are_told() {
    for end in ["PG;", "EC;", "AF;", "PG;IN;"] {
        check(end, 50.0, &["hpgl/pages-overlap"]);
        check(end, 89.0, &["hpgl/pages-overlap"]);
        // Sheets that follow each other, by their edges or apart, and a copy.
        check(end, 100.0, &["hpgl/several-pages"]);
        check(end, 120.0, &["hpgl/several-pages"]);
        check(end, 0.0, &["hpgl/several-pages"]);
    }
}

#[test]
fn a_page_over_others_is_refused_at_its_place_whatever_lies_beside() {
    let page = |x: u32, y: u32| format!("PU{x},{y};PD{},{y},{},{},{x},{y};PU;", x + 4000, x + 4000, y + 3000);
    let text = format!("IN;SP1;{}PG;{}PG;{}PG;{}", page(0, 0), page(0, 0), page(6000, 0), page(6500, 500));
    let source = source(text.clone());
    let job = Job::default();
    let mut found = cutc::diagnostic::Diagnostics::default();
    let input = cutc::pipeline::read(&source, None, &job, &mut found);
    assert!(input.is_none_or(|input| !input.is_whole) && found.has_errors());
    let over = found.iter().find(|finding| finding.code.name == "hpgl/pages-overlap").expect("told");
    assert_eq!(over.span.map(|span| span.start as usize), text.rfind("PG;"));
    assert!(over.message.starts_with("a page lies over"), "{}", over.message);
    assert_eq!(found.iter().filter(|finding| finding.code.name == "hpgl/several-pages").count(), 2);
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
