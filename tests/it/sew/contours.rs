//! Seams inside contours: on the cloth, wherever that is.

use cutc::geom::Point;
use cutc::geom::ring;
use cutc::machine::Job;
use cutc::sew::{self, Asked};
use cutc::source::Source;

use super::target;

/// A closed square of a plot, from a corner, mm.
fn square(at: f64, size: f64) -> String {
    let [a, b] = [at, at + size].map(|mm| (mm * 40.0).round() as i32);
    format!("PU{a},{a};PD{b},{a},{b},{b},{a},{b},{a},{a};")
}

/// The seams of a plot with an inset, or what is said of it.
fn seams(plot: &str, line: Option<&str>, inset: f64) -> Result<Vec<Vec<Point>>, String> {
    let source = Source::new("x.plt", format!("IN;SP1;{plot}SP0;").into_bytes()).expect("small");
    let asked = Asked { line: line.map(str::to_owned), inset, ..Asked::default() };
    let mut out = cutc::diagnostic::Diagnostics::default();
    let program = sew::plan(&source, &asked, &Job::default(), &mut out);
    let program = program.ok_or_else(|| cutc::diagnostic::render(&out, &source))?;
    let mut bytes = Vec::new();
    (target("queue").write)(&program, &Job::default(), &mut bytes).expect("a vector takes bytes");
    Ok(program.pattern.expect("lines").seams.into_iter().map(|seam| seam.points).collect())
}

fn sizes(plot: &str, line: Option<&str>, inset: f64) -> Vec<f64> {
    let seams = seams(plot, line, inset).unwrap_or_else(|said| panic!("{said}"));
    seams.iter().map(|seam| ring::area(seam).abs().sqrt().round()).collect()
}

#[test]
fn the_seam_of_a_cut_out_lies_on_the_cloth_around_it() {
    // A part, a cut-out in it, and a part that lies in the cut-out.
    let plot = [square(0.0, 100.0), square(20.0, 60.0), square(40.0, 20.0)].concat();
    assert_eq!(sizes(&plot, Some("1"), 5.0), [90.0, 70.0, 10.0]);
}

#[test]
fn a_seam_too_near_to_another_contour_of_its_part_is_refused() {
    let plot = [square(0.0, 100.0), square(8.0, 60.0)].concat();
    assert_eq!(sizes(&plot, Some("1"), 4.0), [92.0, 68.0]);
    let said = seams(&plot, Some("1"), 4.1).expect_err("too near");
    assert!(said.contains("sew/inset") && said.contains("too near to another of its part"), "{said}");
}
