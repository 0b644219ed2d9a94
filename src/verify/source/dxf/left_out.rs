//! Check of blocks that are left out: each of their pieces must have a number that the job's selection excludes. The numbers
//! are counted here, in the order in which the file lays its blocks.

use super::places::{CutPlaces, SourcePiece};
use super::tags::Sheet;
use crate::machine::Selection;

/// Number of pieces that are left out without a reason: they are selected, or the file lays their block elsewhere. `order`
/// yields the block of each laid piece.
pub(super) fn wrong_count(
    order: impl Iterator<Item = usize>,
    blocks: &[Sheet],
    read: &CutPlaces,
    selection: &Selection,
) -> usize {
    let is_left_out = |block: &Sheet| read.blocks_left_out.contains(&block.number);
    let mut pieces = read.pieces.iter().zip(1..).peekable();
    let mut wrong = 0;
    for k in order {
        let (first, behind) = (blocks[k].number, blocks.get(k + 1).map_or(u32::MAX, |next| next.number));
        if is_left_out(&blocks[k]) {
            // A block that cannot be cut is a single piece.
            let is_left = |(piece, number): &(&SourcePiece, u32)| {
                piece.is_bare && piece.block == first && piece.number == *number && !selection.has(*number)
            };
            wrong += usize::from(pieces.next_if(is_left).is_none());
        } else {
            while pieces.next_if(|(piece, _)| !piece.is_bare && (first..behind).contains(&piece.block)).is_some() {}
        }
    }
    // Pieces outside blocks come last, and all of them are cut.
    wrong + pieces.filter(|(piece, _)| piece.is_bare).count()
}
