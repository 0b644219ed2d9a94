//! Facts for the script of the page, besides the columns.

use serde_json::{Value, json};

use super::about::{About, MOST_MARKS};
use super::piece::Piece;
use crate::diagnostic::Severity;
use crate::geom::{Extent, Point};

/// Inverse of the rounding step of coordinates and times.
const PER_UNIT: f64 = 1e6;

/// The facts; `classes` are the names of lines that are not cut.
pub(super) fn facts(about: &About, classes: &[&str]) -> Value {
    let About { context, record, pieces, .. } = about;
    let knife = &context.job.profile.knife;
    let [cut, travel] = record.limits();
    let length = context.job.profile.bite.length_mm;
    json!({
        "period_s": rounded(context.job.profile.time.period()),
        "ticks": record.ticks(),
        "peak_ticks": record.peaks.ticks(),
        "knife": { "width_mm": rounded(knife.width_mm), "tip_mm": rounded(knife.radius()), "heel_mm": rounded(knife.back()) },
        "limits": { "cut": cut, "travel": travel },
        "has_common": !context.marker.common.is_empty(),
        "extent": corners(&context.marker.extent()),
        "aside": classes,
        "pieces": pieces.iter().map(piece).collect::<Value>(),
        "window_mm": about.windows().and(length),
        "broken": places(about.broken().into_iter()),
        "warned": places(about.places(Severity::Warning)),
        "declared": about.deviations().iter().map(|entry| entry.at_mm).collect::<Vec<_>>(),
    })
}

fn piece(piece: &Piece) -> Value {
    let Piece { whole, number, name, window, extent, .. } = piece;
    json!({
        "whole": whole, "number": number, "name": name, "title": piece.title(), "window": window,
        "extent": corners(extent),
    })
}

/// Places to mark, X and Y in mm; their number is limited, so that they do not hide the cloth.
fn places(all: impl Iterator<Item = Point>) -> Vec<[f64; 2]> {
    all.take(MOST_MARKS).map(|at| [at.x, at.y].map(rounded)).collect()
}

/// Left, lower, right and upper edge of a box, mm; null when it is empty.
fn corners(extent: &Extent) -> Value {
    let Extent { min, max } = extent;
    if extent.is_empty() { Value::Null } else { json!([min.x, min.y, max.x, max.y].map(rounded)) }
}

fn rounded(value: f64) -> f64 {
    (value * PER_UNIT).round() / PER_UNIT
}
