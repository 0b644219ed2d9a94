//! Drawings with more lines over one another than any lay of parts: they are refused, or it is said what was not looked at,
//! and nothing goes on for ever.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::geom::Extent;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pass::marker::MARKER_PASSES;
use cutc::pipeline;
use cutc::source::Source;

/// The blocks of a closed rectangle, in units of the file.
fn rectangle([left, low, right, high]: [u32; 4]) -> String {
    format!("M15*X{left}Y{low}*M14*X{right}Y{low}*X{right}Y{high}*X{left}Y{high}*X{left}Y{low}*M15*")
}

/// A rectangle that lies deeper in all others with each step.
fn nested(depth: u32) -> [u32; 4] {
    [depth, depth, 30_000 - depth, 30_000 - depth]
}

/// The marker of blocks after all passes, and the codes of what was found: each once.
fn read(blocks: &str) -> (Marker, Vec<&'static str>) {
    let source = Source::new("a.cut", format!("H1*G71*{blocks}M0*").into_bytes()).expect("small");
    let (job, mut found) = (Job::default(), Diagnostics::default());
    let mut marker = pipeline::read(&source, None, &job, &mut found).expect("a cut file").marker;
    for pass in MARKER_PASSES {
        (pass.run)(&mut marker, &job, &mut found);
    }
    let mut codes: Vec<_> = found.iter().map(|finding| finding.code.name).collect();
    codes.dedup();
    (marker, codes)
}

/// Rectangles, each a piece.
fn pieces(rectangles: impl Iterator<Item = [u32; 4]>) -> String {
    let mut blocks = String::new();
    for (corners, number) in rectangles.zip(1..) {
        let _ = write!(blocks, "N{number}*{}", rectangle(corners));
    }
    blocks
}

#[test]
fn pieces_in_one_another_are_cut_from_the_inside_out_or_not_at_all() {
    let (marker, codes) = read(&pieces((0..300).map(nested)));
    assert_eq!(codes, [""; 0]);
    // Every other one is the cut-out of the part around it.
    let numbers: Vec<u32> = marker.pieces.iter().map(|piece| piece.number).collect();
    assert!(numbers.chunks(2).eq((1..=150).map(|k| [2 * k, 2 * k - 1])), "{numbers:?}");
    assert_eq!(read(&pieces((0..4000).map(nested))).1[0], "marker/too-many-outlines");
}

#[test]
fn contours_in_one_another_are_cut_from_the_inside_out_or_not_at_all() {
    let contours = |count| format!("N1*{}", (0..count).map(nested).map(rectangle).collect::<String>());
    let (marker, codes) = read(&contours(300));
    assert_eq!(codes, [""; 0]);
    let widths = marker.contours().map(|(_, contour)| Extent::of(&marker.points(contour)).size().0);
    assert!(widths.is_sorted());
    assert_eq!(read(&contours(12_000)).1[0], "marker/too-many-outlines");
}

#[test]
fn a_part_with_ten_thousand_holes_is_no_crowd() {
    let holes = (0..10_000).map(|k| (10 * (k % 100) + 3, 10 * (k / 100) + 3)).map(|(x, y)| [x, y, x + 4, y + 4]);
    let contours = std::iter::once([0, 0, 1000, 1000]).chain(holes).map(rectangle);
    let (marker, codes) = read(&format!("N1*{}", contours.collect::<String>()));
    assert_eq!(codes, [""; 0]);
    let last = marker.pieces[0].contours.last().expect("the outline");
    assert_eq!((marker.pieces[0].contours.len(), Extent::of(&marker.points(last)).size()), (10_001, (100.0, 100.0)));
}

#[test]
fn what_was_not_looked_at_is_said() {
    let across = (0..2000).map(|k| [0, 2 * k, 4000, 2 * k + 1]);
    let along = (0..2000).map(|k| [2 * k, 0, 2 * k + 1, 4000]);
    assert_eq!(read(&pieces(across.chain(along))).1, ["marker/overlapping-pieces", "marker/search-ended"]);
    // Short strokes under long edges.
    let mut teeth = "N1*M15*X0Y0*M14*".to_owned();
    for k in 0..5000 {
        let _ = write!(teeth, "X30000Y{}*X0Y{}*", 2 * k + 1, 2 * k + 2);
    }
    teeth.push_str("X0Y0*");
    for x in (0..5000).map(|k| 5 * k) {
        let _ = write!(teeth, "M15*X{x}Y20000*M14*X{x}Y20030*M15*");
    }
    let (_, codes) = read(&teeth);
    assert!(codes.contains(&"marker/search-ended"), "{codes:?}");
}
