//! Points with one coordinate in a file that writes both: the letter of the other one is lost.
//!
//! A block with X alone keeps the last Y. Files that use this omit every coordinate that does not change; files that repeat one
//! from block to block never do. `X0Y2000` without its Y is `X02000`, a sound block that leads elsewhere. A last block without
//! its asterisk has lost more than a letter: the file is cut short there.

use super::block::Blocks;
use super::meaning::{Meaning, meaning};
use super::syntax::Point;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Least number of repeated coordinates for each omitted one, if several are omitted: a transfer loses few letters.
const FEW: usize = 10;
const LOST_LETTER: &str = "the letter of the other coordinate may be lost; transfer the file again";

/// Points with one coordinate.
#[derive(Debug, Default)]
pub(super) struct Alone {
    count: usize,
    first: Option<(char, Span)>,
    last: Option<Span>,
    /// Places at which the knife goes down before X and Y are known, and whether one of the two is.
    unplaced: Vec<(bool, Span)>,
}

impl Alone {
    /// Records the point of a block without codes if it has one coordinate.
    pub(super) fn see(&mut self, point: Point, span: Span) {
        let letter = match (point.x, point.y) {
            (Some(_), None) => 'X',
            (None, Some(_)) => 'Y',
            _ => return,
        };
        self.count += 1;
        self.first.get_or_insert((letter, span));
        self.last = Some(span);
    }

    /// Records that the knife goes down before X and Y are known; `is_half` if one of the two is.
    pub(super) fn down_without_place(&mut self, is_half: bool, span: Span) {
        self.unplaced.push((is_half, span));
    }

    /// Reports the points if they are few, and the file repeats coordinates otherwise; then the knife-downs without a place,
    /// unless such a point is the reason. `torn` is the last block of the file if it lacks its asterisk.
    pub(super) fn report(&self, bytes: &[u8], torn: Option<Span>, out: &mut Diagnostics) {
        let finding = self.finding(bytes, torn, out);
        let is_told = finding.is_some();
        if let Some(finding) = finding {
            out.push(finding);
        }
        for &(_, span) in self.unplaced.iter().filter(|(is_half, _)| !(*is_half && is_told)) {
            let message = "the knife goes down before any X and Y; what is missing is taken as 0";
            let finding = Diagnostic::new(&code::ISO_NO_POSITION, message).at(span);
            out.push(finding.hint("look at the first contour in the picture (`-t svg`) before it is cut"));
        }
    }

    fn finding(&self, bytes: &[u8], torn: Option<Span>, out: &Diagnostics) -> Option<Diagnostic> {
        let (letter, first) = self.first?;
        let is_torn = torn.is_some() && torn == self.last;
        let count = self.count - usize::from(is_torn);
        let are_few = |repeats: usize| repeats > count && (count <= 1 || repeats >= FEW * count);
        let is_known = is_torn && out.iter().any(|finding| finding.code == &code::ISO_ENDS_KNIFE_DOWN);
        if count == 0 && is_known || !are_few(repeats(bytes)) {
            return None;
        }
        let (blocks, hint) = match count {
            0 => ("the file ends".to_owned(), "the file is most likely cut short; export it again"),
            1 => ("one block".to_owned(), LOST_LETTER),
            _ => (format!("one of {count} blocks"), LOST_LETTER),
        };
        let message = format!("{blocks} with {letter} alone, where others repeat an unchanged coordinate");
        Some(Diagnostic::new(&code::ISO_ALONE, message).at(first).hint(hint))
    }
}

/// Number of times that a block of X and Y repeats a coordinate of the block before it. The knife may go down between them.
fn repeats(bytes: &[u8]) -> usize {
    let mut blocks = Blocks::new(bytes);
    let (mut repeats, mut last) = (0, None);
    loop {
        if let Some((point, _)) = blocks.next_point() {
            let both = point.x.zip(point.y);
            if let (Some((x, y)), Some((last_x, last_y))) = (both, last) {
                repeats += usize::from((x == last_x) != (y == last_y));
            }
            last = both;
        } else {
            let Some(block) = blocks.next() else { return repeats };
            let is_down = |code| meaning(code) == Meaning::Down;
            if !block.words.is_ok_and(|words| words.point.is_none() && words.codes.iter().copied().all(is_down)) {
                last = None;
            }
        }
    }
}
