//! Text blocks: the label after M31, in its four layouts.
//!
//! ```text
//! X..Y..M31*text*                        then optionally a second point X..Y.. that gives the angle
//! M31*X..Y..*text*
//! M31*text*
//! X..Y..M31*normal*mirrored*X..Y..M31*
//! ```

use super::block::{Block, Blocks};
use super::meaning::{Meaning, meaning};
use super::syntax::{Point, Words};
use crate::source::Span;

/// The blocks after M31.
#[derive(Debug, PartialEq)]
pub(super) struct Layout {
    /// Position, in numbers of the file; `None` if the file gives none.
    pub(super) at: Option<Point>,
    /// The text; `None` if the file ends before it.
    pub(super) text: Option<Span>,
    /// The second point, which gives the angle.
    pub(super) second: Option<Point>,
    /// The text for mirrored pieces.
    pub(super) mirrored: Option<Span>,
}

/// Reads the blocks of an M31 whose own block holds `point`.
pub(super) fn read(blocks: &mut Blocks<'_>, point: Option<Point>) -> Layout {
    let Some(at) = point else {
        let at = next_if(blocks, |words| words.codes.is_empty() && is_place(words));
        return Layout { at, text: blocks.next_text(), second: None, mirrored: None };
    };
    let text = blocks.next_text();
    let (mirrored, second) = mirrored(blocks).unzip();
    Layout { at: Some(at), text, second, mirrored }
}

/// The mirrored text and the second point of the fourth layout. Texts may look like codes and codes like texts, so all three
/// blocks must fit: one that is not codes, a point with M31, and codes again.
fn mirrored(blocks: &mut Blocks<'_>) -> Option<(Span, Point)> {
    let mut ahead = blocks.clone();
    if ahead.next().is_none_or(|block| is_known(&block)) {
        return None;
    }
    let mut ahead = blocks.clone();
    let text = ahead.next_text()?;
    let second = next_if(&mut ahead, |words| {
        is_place(words) && words.codes.len() == 1 && words.codes.iter().all(|&c| meaning(c) == Meaning::Label)
    })?;
    let after = ahead.clone().next();
    if after.is_some_and(|block| !is_known(&block)) {
        return None;
    }
    *blocks = ahead;
    Some((text, second))
}

/// Consumes the next block if it matches, and returns its point.
fn next_if(blocks: &mut Blocks<'_>, wanted: impl Fn(&Words) -> bool) -> Option<Point> {
    let mut ahead = blocks.clone();
    let words = ahead.next()?.words.ok()?;
    if !wanted(&words) {
        return None;
    }
    *blocks = ahead;
    words.point
}

fn is_place(words: &Words) -> bool {
    words.point.is_some_and(|point| point.x.is_some() && point.y.is_some() && !point.has_centre())
}

/// True if a block holds only known codes and coordinates.
fn is_known(block: &Block) -> bool {
    block.words.as_ref().is_ok_and(|words| words.codes.iter().all(|&code| meaning(code) != Meaning::Unknown))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the label whose M31 block is the first, and gives its text, its points and the block that follows.
    fn check(bytes: &str, text: &str, at: Option<f64>, second: Option<f64>, next_block: u32) {
        let mut blocks = Blocks::new(bytes.as_bytes());
        let words = blocks.next().expect("M31").words.expect("sound");
        let label = read(&mut blocks, words.point);
        let span = label.text.expect("text");
        assert_eq!(&bytes[span.start as usize..span.end as usize], text, "{bytes}");
        assert_eq!((label.at.and_then(|p| p.x), label.second.and_then(|p| p.x)), (at, second), "{bytes}");
        assert_eq!(blocks.next().map(|b| b.span.block), Some(next_block), "{bytes}");
    }

    #[test]
    fn a_label_has_four_layouts() {
        check("X1Y2M31*S:M-A*D2*M15*", "S:M-A", Some(1.0), None, 3);
        check("M31*X1Y2*36*M15*", "36", Some(1.0), None, 4);
        check("M31*BK R X1*M15*", "BK R X1", None, None, 3);
        check("X1Y2M31*FRONT*FRONT.*X9Y2M31*M15*", "FRONT", Some(1.0), Some(9.0), 5);
    }

    #[test]
    fn text_that_looks_like_codes_stays_text() {
        check("X1Y2M31*M14*M15*", "M14", Some(1.0), None, 3);
        check("M31*X7*M15*", "X7", None, None, 3);
        check("X1Y2M31*A*X9Y9M31*B*", "A", Some(1.0), None, 3);
        check("X1Y2M31*A*M99*X9Y9M31*TEXT-2*M15*", "A", Some(1.0), None, 3);
    }
}
