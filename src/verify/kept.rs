//! Whether what was read is still there behind the passes: every block that cuts or drills something in the marker as it
//! was read does so in the marker that is cut, or a pass has lost it.

use std::collections::BTreeSet;

use super::worst::Worst;
use crate::geom::Point;
use crate::ir::finding::Sighting;
use crate::ir::marker::{Notch, Piece, Stroke};
use crate::ir::{Finding, Marker};

/// Something that a block cuts or drills.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Work {
    /// Where its piece starts in the file, which no other does there.
    piece: Name,
    block: u32,
    at: Point,
    /// Both ends when it is a slit: of two that are the same one is enough.
    slit: Option<Ends>,
}

/// A piece by its number and the byte at which it starts: numbers may come again.
type Name = (u32, u32);
/// The ends of a slit by the bits of their coordinates, whichever way round.
type Ends = [[u64; 2]; 2];

/// All that a marker cuts or drills. A segment without length cuts nothing, and one without a block is from no file.
pub(super) fn works(marker: &Marker) -> Vec<Work> {
    let mut works = Vec::new();
    for piece in &marker.pieces {
        let name = name(piece);
        let mut add = |block: u32, at: Point, slit: Option<Ends>| {
            if block != 0 {
                works.push(Work { piece: name, block, at, slit });
            }
        };
        piece.drills.iter().for_each(|drill| add(drill.span.block, drill.at, None));
        let strokes = piece.notches.iter().flat_map(Notch::strokes);
        for stroke in strokes.filter(|stroke| stroke.from != stroke.to) {
            add(stroke.span.block, stroke.to, Some(ends(&stroke)));
        }
        for contour in &piece.contours {
            let segments = marker.list.walk(contour.range).map(|(_, segment)| segment);
            segments.filter(|s| s.from != s.to).for_each(|s| add(s.span.block, s.to, None));
        }
    }
    works
}

/// Compares what was read with what is cut. Pieces that were not selected are gone as a whole.
pub(super) fn kept(read: &[Work], marker: &Marker) -> Finding {
    let cut = works(marker);
    let pieces: BTreeSet<Name> = marker.pieces.iter().map(name).collect();
    let blocks: BTreeSet<(Name, u32)> = cut.iter().map(|work| (work.piece, work.block)).collect();
    let slits: BTreeSet<(Name, Ends)> = cut.iter().filter_map(|work| Some((work.piece, work.slit?))).collect();
    let mut worst = Worst::new("source/kept", "blocks", Some(0.0));
    let mut lost = BTreeSet::new();
    for work in read.iter().filter(|work| pieces.contains(&work.piece)) {
        let has_twin = work.slit.is_some_and(|slit| slits.contains(&(work.piece, slit)));
        if !has_twin && !blocks.contains(&(work.piece, work.block)) && lost.insert((work.piece, work.block)) {
            worst.see(lost.len() as f64, || Sighting { time: None, point: work.at, block: work.block });
        }
    }
    worst.finding()
}

fn name(piece: &Piece) -> Name {
    (piece.number, piece.span.start)
}

fn ends(stroke: &Stroke) -> Ends {
    // Zero has one sign.
    let mut ends = [stroke.from, stroke.to].map(|point| [(point.x + 0.0).to_bits(), (point.y + 0.0).to_bits()]);
    ends.sort_unstable();
    ends
}
