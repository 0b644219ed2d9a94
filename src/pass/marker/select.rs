//! Select: the pieces that this run cuts, in their order, each whole; the others go.
//!
//! Needs: numbered pieces. Leaves true: something is left to cut. A number that the operator wrote and the file does
//! not have is an error, not an empty choice: it is a slip of the hand or the wrong file, and a machine would start.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::marker::{Event, Marker, Piece};
use crate::ir::toolpath;
use crate::machine::{Job, Numbers, Start};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "select", about: "keeps the pieces that --pieces, --skip and --resume-from leave", run };

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let selection = &job.selection;
    if selection.is_all() {
        return;
    }
    let written = |numbers: &Option<Numbers>| numbers.iter().flat_map(Numbers::written).collect::<Vec<_>>();
    let flags = [
        ("--pieces", written(&selection.pieces)),
        ("--skip", written(&selection.skip)),
        ("--resume-from", selection.resume_from.iter().map(|start| start.number).collect()),
    ];
    let mut unknown = false;
    for (flag, numbers) in flags {
        for number in numbers {
            if marker.pieces.iter().all(|piece| piece.number != number) {
                unknown = true;
                diagnostics.push(
                    Diagnostic::new(&code::SELECT_UNKNOWN_PIECE, format!("{flag}: there is no piece {number}"))
                        .hint(known(marker)),
                );
            }
        }
    }
    if unknown {
        return;
    }
    let resumed = selection.resume_from.map(|Start { number, copy }| {
        marker.pieces.iter().position(|piece| piece.number == number && piece.copy.max(1) == copy).ok_or(copy)
    });
    let resumed = match resumed.transpose() {
        Ok(resumed) => resumed,
        Err(copy) => {
            let message = format!("--resume-from: there is no copy {copy}");
            let hint = format!("the marker is cut {} times: sheet.copies", job.profile.sheet.copies);
            diagnostics.push(Diagnostic::new(&code::SELECT_UNKNOWN_PIECE, message).hint(hint));
            return;
        }
    };
    let first = resumed.unwrap_or(0);
    let all = marker.pieces.len();
    let mut place = 0..;
    // The cloth is moved on as far before the pieces that are left.
    let mut moved = 0;
    marker.pieces.retain_mut(|piece| {
        let is_kept = place.next().is_some_and(|i| i >= first) && selection.has(piece.number);
        moved += piece.events.iter().map(|event| event.kind.bite()).sum::<u32>();
        if is_kept && moved > 0 {
            piece.events.retain(|event| event.kind.bite() == 0);
            piece.events.insert(0, Event { kind: toolpath::Event::Bite(std::mem::take(&mut moved)), span: piece.span });
        }
        is_kept
    });
    if !marker.pieces.iter().any(cuts) {
        let message = format!("none of the {all} pieces is left to cut");
        diagnostics.push(
            Diagnostic::new(&code::SELECT_NOTHING_LEFT, message)
                .hint("--pieces, --skip and --resume-from act together: leave one out, or change its numbers"),
        );
    }
}

/// Whether anything of a piece is cut or drilled.
fn cuts(piece: &Piece) -> bool {
    !(piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty())
}

/// What the file has, in words.
fn known(marker: &Marker) -> String {
    let mut numbers: Vec<u32> = marker.pieces.iter().map(|piece| piece.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    match numbers[..] {
        [] => "the file has no pieces".to_owned(),
        [only] => format!("the file has piece {only} alone"),
        [first, .., last] if last - first == numbers.len() as u32 - 1 => {
            format!("the file has the pieces {first} to {last}")
        }
        [first, .., last] => {
            format!("the file has {} numbers between {first} and {last}", numbers.len())
        }
    }
}
