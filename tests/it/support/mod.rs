//! What several topics share: markers and toolpaths made from points, programs made from them, a room to run ours in.

use cutc::diagnostic::Diagnostics;
use cutc::geom::Point;
use cutc::ir::list::{Joint, Segment};
use cutc::ir::marker::{Contour, Marker, Piece};
use cutc::ir::toolpath::{Run, Step, Toolpath};
use cutc::machine::Job;
use cutc::pass::marker::{CUTTING_PASSES, MARKER_PASSES};
use cutc::pass::toolpath::{Scene, TOOLPATH_PASSES, trace};
use cutc::plan;
use cutc::source::Span;

pub(crate) mod cloth;
pub(crate) mod damage;
pub(crate) mod fixtures;
pub(crate) mod nests;
pub(crate) mod page;
pub(crate) mod program;
pub(crate) mod room;
pub(crate) mod samples;

/// Registration marks about the marker of the pictures.
pub(crate) const MARKS: &[u8] =
    b"x_mm,y_mm,found_x_mm,found_y_mm\n0,0,5,8\n1700,0,1705,9\n1700,1400,1704,1409\n0,1400,4,1408\n";

/// A marker of one piece with one contour through the points; block k + 1 holds the k-th chord.
pub(crate) fn marker(points: &[Point]) -> Marker {
    let mut marker = Marker::default();
    let chain = points.windows(2).zip(1..).map(|(w, block)| Segment {
        from: w[0],
        to: w[1],
        span: Span { block, ..Span::default() },
        joint: Joint::default(),
        percent: 100,
    });
    let range = marker.list.append(chain).expect("two points or more");
    let closed = points.first() == points.last();
    marker.pieces.push(Piece { number: 1, contours: vec![Contour { range, closed }], ..Piece::default() });
    marker
}

/// A marker with its cuts and its near lines: those that it has, or all of them.
pub(crate) fn with_cuts(marker: &Marker, job: &Job) -> Marker {
    let mut marker = marker.clone();
    if !marker.cuts.is_empty() {
        return marker;
    }
    for pass in &MARKER_PASSES[MARKER_PASSES.len() - CUTTING_PASSES..] {
        (pass.run)(&mut marker, job, &mut Diagnostics::default());
    }
    marker
}

/// All toolpaths of a marker after all passes, which must find nothing wrong.
pub(crate) fn toolpaths(marker: &Marker, job: &Job) -> Vec<Toolpath> {
    let mut diagnostics = Diagnostics::default();
    let mut pose = plan::home(job);
    let marker = with_cuts(marker, job);
    let scene = Scene::new(&marker, job);
    let mut toolpaths: Vec<Toolpath> = trace(&marker, job).collect();
    for toolpath in &mut toolpaths {
        toolpath.entry = pose;
        for pass in TOOLPATH_PASSES {
            (pass.run)(toolpath, &scene, &mut diagnostics);
        }
        pose = toolpath.exit();
    }
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    toolpaths
}

/// The runs among the steps.
pub(crate) fn runs(toolpath: &Toolpath) -> Vec<&Run> {
    let mut runs = Vec::new();
    for step in &toolpath.steps {
        if let Step::Run(run) = step {
            runs.push(run);
        }
    }
    runs
}

/// The rows of numbers of a CSV file in `fixtures`, header and words left out.
pub(crate) fn rows(name: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let numbers = |line: &str| line.split(',').filter_map(|field| field.trim().parse().ok()).collect();
    text.lines().skip(1).map(numbers).filter(|row: &Vec<f64>| !row.is_empty()).collect()
}

/// The points of a contour in `fixtures/motion`.
pub(crate) fn contour(name: &str) -> Vec<Point> {
    rows(&format!("motion/{name}.csv")).iter().map(|row| Point::new(row[0], row[1])).collect()
}
