//! What a program does beside the drawing, summed up: by kind, how often, and where the worst is.

use serde::Serialize;

use crate::geom::polyline;
use crate::ir::Marker;
use crate::ir::declaration::{Declaration, Kind};

/// All declarations of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Beside {
    /// The kind.
    pub kind: Kind,
    /// How many there are.
    pub count: usize,
    /// The greatest of them, mm; what it measures is said by the kind.
    pub worst_mm: f64,
    /// The number of the piece that this is of.
    pub piece: u32,
    /// Where it begins, mm.
    pub at_mm: [f64; 2],
}

impl Beside {
    /// The sums of what the program of a marker declares, those of a kind after those of the one before it.
    pub(super) fn of(declared: &[Declaration], marker: &Marker) -> Vec<Self> {
        let of_kind = |kind: Kind| {
            let mut count = 0;
            let worst = declared.iter().filter(|entry| entry.kind == kind).inspect(|_| count += 1);
            // Of two that are alike the first.
            let worst =
                worst.reduce(|worst, next| if next.magnitude_mm > worst.magnitude_mm { next } else { worst })?;
            let cut = &marker.cuts[worst.cut as usize];
            let points = marker.list.points(cut.range);
            let at = polyline::place(&points, &polyline::stations(&points), worst.from_mm);
            let at_mm = [at.x, at.y].map(|value| (value * 1e3).round() / 1e3);
            let piece = marker.pieces[cut.piece as usize].number;
            Some(Self { kind, count, worst_mm: worst.magnitude_mm, piece, at_mm })
        };
        Kind::ALL.into_iter().filter_map(of_kind).collect()
    }
}
