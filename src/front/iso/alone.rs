//! Points with one coordinate in a file that writes both: the letter of the other one is lost.
//!
//! A block with X alone keeps the last Y. Files that use this omit every coordinate that does not change; files that repeat one
//! from block to block never do. `X0Y2000` without its Y is `X02000`, a sound block that leads elsewhere.

use super::block::Blocks;
use super::meaning::{Meaning, meaning};
use super::syntax::Point;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Least number of repeated coordinates for each omitted one, if several are omitted: a transfer loses few letters.
const FEW: usize = 10;

/// Points with one coordinate.
#[derive(Debug, Default)]
pub(super) struct Alone {
    count: usize,
    first: Option<(char, Span)>,
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
    }

    /// Reports the points if they are few, and the file repeats coordinates otherwise.
    pub(super) fn report(&self, bytes: &[u8], out: &mut Diagnostics) {
        let are_few = |repeats: usize| repeats > self.count && (self.count == 1 || repeats >= FEW * self.count);
        let Some((letter, span)) = self.first.filter(|_| are_few(repeats(bytes))) else { return };
        let blocks = if self.count == 1 { "one block".to_owned() } else { format!("one of {} blocks", self.count) };
        let message = format!("{blocks} with {letter} alone, where others repeat an unchanged coordinate");
        let finding = Diagnostic::new(&code::ISO_ALONE, message).at(span);
        out.push(finding.hint("the letter of the other coordinate may be lost; transfer the file again"));
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
