//! Plots that are made to be slow: each is read after a bounded search, and what was not searched is said. Where a bound is
//! lacking the test goes on for minutes or for ever; no clock is looked at.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::machine::Job;
use cutc::source::Source;

/// Some lines, each by its number.
fn many(count: i64, line: &dyn Fn(i64) -> String) -> String {
    (0..count).map(line).collect()
}

/// A closed rectangle.
fn rectangle(x: i64, y: i64, width: i64, height: i64) -> String {
    let (right, top) = (x + width, y + height);
    format!("PU{x},{y};PD{right},{y},{right},{top},{x},{top},{x},{y};")
}

/// Expects that this is found in a drawing.
fn check(what: &str, text: &str, expected: &[&str]) {
    let source = Source::new("a.plt", format!("{text}PU;").into_bytes()).expect("small");
    let mut found = Diagnostics::default();
    cutc::pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, &Job::default(), &mut found);
    let found: Vec<&str> = found.iter().map(|diagnostic| diagnostic.code.name).collect();
    assert_eq!(found, expected, "{what}");
}

#[test]
fn drawings_made_to_be_slow_are_read_in_time_and_what_was_not_searched_is_said() {
    let specks = many(200_000, &|i| rectangle(i % 500, i / 500, 1, 1) + "PU5,5;PD6,6;");
    check("specks", &specks, &["drawing/search-ended", "drawing/nothing-to-cut"]);
    let comb = rectangle(0, 100, 40_000, 10_000) + &many(40_000, &|i| format!("PU{i},100;PD{i},200;"));
    // Those within 0.25 mm of a side lie along it, and those a few units from another are that one again.
    check("marks", &comb, &["drawing/line-from-edge", "drawing/drawn-again"]);
    let fan = many(60_000, &|i| format!("PU0,0;PD{i},900;"));
    check("strokes that all meet", &fan, &["drawing/nothing-to-cut"]);
    let bars = many(200_000, &|i| rectangle(0, 20 * i, 100_000, 10));
    check("outlines that lie beside each other", &bars, &[]);
    let marks = many(200_000, &|i| format!("PU{},-1000;PD{},-1100;", i % 90_000, i % 90_000));
    check(
        "marks beside many outlines",
        &(marks + &bars[..bars.len() / 2]),
        &["drawing/search-ended", "drawing/drawn-again"],
    );
    let zigzag = many(50_000, &|i| format!("{},{},", 90_000 * (i % 2), 40 * i));
    let marks = many(100_000, &|i| format!("PU{},2000;PD{},2090;", i % 90_000, i % 90_000));
    check(
        "an outline with long segments",
        &format!("PU0,0;PD{zigzag}-900000,0,0,0;{marks}"),
        &["hpgl/unit-doubtful", "drawing/search-ended", "drawing/size", "drawing/drawn-again"],
    );
    let way = many(200_000, &|i| format!("{},0,", 3 * (200_000 - i)));
    let back = many(200_000, &|i| format!(",{},0", 3 * (i + 1)));
    check("a way out and back", &format!("PU600000,0;PD{way}0,0,0,9000,-9000,9000,0,0{back};"), &["drawing/size"]);
}
