//! Which of the pieces that a file names are any.

use crate::ir::marker::{Event, Piece};

/// An N without anything to cut is no piece (controllers insert some); its labels and events go to the next piece, the
/// events of the last one to `closing`.
pub(super) fn retain(pieces: &mut Vec<Piece>, closing: &mut Vec<Event>) {
    let mut labels = Vec::new();
    pieces.retain_mut(|piece| {
        let is_kept = !(piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty());
        // What waits stands before its own.
        prepend(&mut labels, &mut piece.labels);
        prepend(closing, &mut piece.events);
        if !is_kept {
            std::mem::swap(&mut labels, &mut piece.labels);
            std::mem::swap(closing, &mut piece.events);
        }
        is_kept
    });
    if let Some(last) = pieces.last_mut() {
        last.labels.append(&mut labels);
    }
}

/// Moves `waiting` in front of `own`.
fn prepend<T>(waiting: &mut Vec<T>, own: &mut Vec<T>) {
    if !waiting.is_empty() {
        own.splice(..0, waiting.drain(..));
    }
}
