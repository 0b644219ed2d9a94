//! The fixtures, and the text of a marker that was read from one.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use cutc::diagnostic::Diagnostics;
use cutc::front::Dialect;
use cutc::geom::{Point, polyline};
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::source::Source;

/// The files of a folder of fixtures, in order.
pub(crate) fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(folder);
    let mut files: Vec<PathBuf> =
        fs::read_dir(&root).map(|dir| dir.map(|entry| entry.expect("readable").path()).collect()).unwrap_or_default();
    files.sort();
    assert!(!files.is_empty(), "{} holds no fixture", root.display());
    files
}

/// The name of a fixture without its extension.
pub(crate) fn stem(path: &Path) -> &str {
    path.file_stem().and_then(|stem| stem.to_str()).expect("a fixture is named by its topic in ASCII")
}

/// A fixture of these bytes.
pub(crate) fn source(path: &Path, bytes: Vec<u8>) -> Source {
    let name = path.file_name().and_then(|name| name.to_str()).expect("an ASCII name");
    Source::new(name, bytes).expect("fixtures are small")
}

/// A fixture as its dialect reads it.
pub(crate) fn read(dialect: &Dialect, source: &Source) -> (Marker, Diagnostics) {
    let mut found = Diagnostics::default();
    let marker = cutc::pipeline::marker_of(dialect, source, &Job::default(), &mut found);
    (marker, found)
}

fn at(point: Point) -> String {
    format!("{:.3} {:.3}", point.x, point.y)
}

/// Text of all that a marker holds, a line for each thing.
pub(crate) fn describe(marker: &Marker, source: &Source) -> String {
    let mut out = format!("unit {} mm\n", marker.unit);
    for piece in &marker.pieces {
        for event in &piece.events {
            let _ = writeln!(out, "{:?}, block {}", event.kind, event.span.block);
        }
        let feed = piece.feed.map_or(String::new(), |feed| format!(", feed {feed:.3} mm/s"));
        let _ = writeln!(out, "piece {}, block {}{feed}", piece.number, piece.span.block);
        for contour in &piece.contours {
            let points = marker.points(contour);
            let kind = if contour.closed { "closed" } else { "open" };
            let (count, length) = (points.len(), polyline::length(&points));
            let _ = writeln!(out, "  {kind} contour of {count} points, {length:.3} mm, from {}", at(points[0]));
            for (_, segment) in marker.list.walk(contour.range) {
                let joint = segment.joint;
                let flags =
                    [(joint.lift, "lift"), (joint.full_advance, "full advance"), (joint.no_overcut, "no overcut")];
                let asked: Vec<&str> = flags.iter().filter(|(set, _)| *set).map(|(_, name)| *name).collect();
                if segment.percent != 100 {
                    let _ = writeln!(out, "    to {}: {} %", at(segment.to), segment.percent);
                }
                if !asked.is_empty() {
                    let _ = writeln!(out, "    at {}: {}", at(segment.from), asked.join(", "));
                }
            }
        }
        for notch in &piece.notches {
            let _ =
                writeln!(out, "  {:?} {} -> {}, block {}", notch.kind, at(notch.root), at(notch.tip), notch.span.block);
        }
        for drill in &piece.drills {
            let _ = writeln!(out, "  drill {} at {}, block {}", drill.tool, at(drill.at), drill.span.block);
        }
        for label in &piece.labels {
            let text = source.slice(label.span).escape_ascii().to_string();
            let place = label.at.map_or("nowhere".to_owned(), at);
            let heading = label.heading.map_or(String::new(), |h| format!(", {:.1} deg", h.radians().to_degrees()));
            let _ = writeln!(out, "  label at {place}{heading}: {text}");
            if let Some(mirrored) = label.mirrored {
                let _ = writeln!(out, "    mirrored: {}", source.slice(mirrored).escape_ascii());
            }
        }
        for field in &piece.fields {
            let value = source.slice(field.span).escape_ascii();
            let _ = writeln!(out, "  field {}: {value}", char::from(field.letter));
        }
    }
    for event in &marker.closing {
        let _ = writeln!(out, "{:?}, block {}", event.kind, event.span.block);
    }
    out
}
