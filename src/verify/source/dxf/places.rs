//! Cuts of a marker as read: places with the groups of the file that they come from.

use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::marker::{Contour, Notch, Piece};

/// Cuts of a marker as read.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPlaces {
    pub(super) contours: Vec<Vec<(Point, u32)>>,
    pub(super) notches: Vec<Notch>,
    pub(super) holes: Vec<(Point, u32)>,
    /// Blocks of notches that are reported and not cut.
    pub(super) left_out: Vec<u32>,
    /// Blocks whose pieces cannot be cut and are left out.
    pub(super) blocks_left_out: Vec<u32>,
    /// Pieces in order.
    pub(super) pieces: Vec<SourcePiece>,
}

/// Piece as read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SourcePiece {
    /// Number of the piece in the selection.
    pub(super) number: u32,
    pub(super) block: u32,
    /// True if nothing of the piece is cut.
    pub(super) is_bare: bool,
}

impl CutPlaces {
    /// Places of a marker before any pass, each with its block.
    pub fn of(marker: &Marker) -> Self {
        let line = |(_, contour): (usize, &Contour)| {
            let mut line: Vec<(Point, u32)> =
                marker.list.vertices(contour.range).map(|(at, span)| (at, span.block)).collect();
            // The edge to the first place of a closed contour has the block of the last.
            if let (true, Some(&(_, block))) = (contour.closed, line.last()) {
                line[0].1 = block;
            }
            line
        };
        let piece = |piece: &Piece| SourcePiece {
            number: piece.number,
            block: piece.span.block,
            is_bare: piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty(),
        };
        Self {
            pieces: marker.pieces.iter().map(piece).collect(),
            contours: marker.contours().map(line).collect(),
            notches: marker.pieces.iter().flat_map(|piece| piece.notches.iter().copied()).collect(),
            holes: marker.pieces.iter().flat_map(|piece| &piece.drills).map(|d| (d.at, d.span.block)).collect(),
            blocks_left_out: marker
                .drawing
                .iter()
                .flat_map(|account| &account.pieces_left_out)
                .map(|span| span.block)
                .collect(),
            left_out: marker.drawing.iter().flat_map(|account| &account.notches_left_out).map(|s| s.block).collect(),
        }
    }
}
