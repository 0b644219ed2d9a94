//! Select: keeps the pieces that this run cuts, in their order, each whole.
//!
//! Needs: numbered pieces. Leaves true: something is left to cut. A number that the operator gives and the file does not have
//! is an error, not an empty choice: it is a slip of the hand or the wrong file, and a machine would start.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::marker::{Event, Marker, Piece};
use crate::machine::{Job, Numbers, Selection, Start};

pub(super) const PASS: MarkerPass = MarkerPass {
    name: "select",
    about: "keeps the pieces that --pieces, --skip, --resume-from and --bites leave",
    run,
};

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let selection = &job.selection;
    if selection.is_all() {
        return;
    }
    let written = |numbers: &Option<Numbers>| numbers.iter().flat_map(Numbers::written).collect::<Vec<_>>();
    let begun = match selection.resume_from {
        Some(Start::Piece { number, .. }) => vec![number],
        Some(Start::Bite(_)) | None => Vec::new(),
    };
    let flags =
        [("--pieces", written(&selection.pieces)), ("--skip", written(&selection.skip)), ("--resume-from", begun)];
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
    let windows = windows(marker);
    let first = match selection.resume_from.map(|start| place(start, marker, &windows, job)).transpose() {
        Ok(first) => first.unwrap_or(0),
        Err(finding) => {
            diagnostics.push(finding);
            return;
        }
    };
    let last = windows.last().copied().unwrap_or(0);
    if let Some(bite) = selection.bites.iter().flat_map(Numbers::written).find(|bite| !(1..=last).contains(bite)) {
        diagnostics.push(unknown_bite("--bites", bite, last, job));
        return;
    }
    let is_chosen = |i: usize| i >= first && selection.bites.as_ref().is_none_or(|bites| bites.has(windows[i]));
    let all = marker.pieces.len();
    let chosen: Vec<bool> = (0..all).map(is_chosen).collect();
    if let Some(finding) = parted(marker, &chosen, &windows, selection) {
        diagnostics.push(finding);
        return;
    }
    keep(marker, &chosen, selection);
    if !marker.pieces.iter().any(cuts) {
        let message = format!("none of the {all} pieces is left to cut");
        diagnostics.push(
            Diagnostic::new(&code::SELECT_NOTHING_LEFT, message)
                .hint("the options that choose pieces act together: leave one out, or change its numbers"),
        );
    }
}

/// The piece that a run begins with.
fn place(start: Start, marker: &Marker, windows: &[u32], job: &Job) -> Result<usize, Diagnostic> {
    match start {
        Start::Piece { number, copy } => {
            let found = marker.pieces.iter().position(|p| p.number == number && p.copy.max(1) == copy);
            found.ok_or_else(|| {
                let hint = format!("the marker is cut {} times: sheet.copies", job.profile.sheet.copies);
                let message = format!("--resume-from: there is no copy {copy}");
                Diagnostic::new(&code::SELECT_UNKNOWN_PIECE, message).hint(hint)
            })
        }
        Start::Bite(number) => {
            let last = windows.last().copied().unwrap_or(0);
            let first = windows.iter().position(|&window| window == number);
            first.ok_or_else(|| unknown_bite("--resume-from", number, last, job))
        }
    }
}

/// Number of the conveyor's window of each piece, from 1.
fn windows(marker: &Marker) -> Vec<u32> {
    let stations = marker.stations();
    let begins = |i: usize| i > 0 && stations[i] != stations[i - 1];
    let number = |window: &mut u32, i: usize| {
        *window += u32::from(begins(i));
        Some(*window)
    };
    (0..stations.len()).scan(1, number).collect()
}

/// Refusal of a selection that has a piece in some of its windows and not in others.
fn parted(marker: &Marker, chosen: &[bool], windows: &[u32], selection: &Selection) -> Option<Diagnostic> {
    let owners = marker.owners();
    let is_parted = |&i: &usize| chosen[i] != chosen[owners[i]] && selection.has(marker.pieces[i].number);
    let i = (0..owners.len()).find(is_parted)?;
    let (piece, first, last) = (&marker.pieces[i], windows[i], windows[owners[i]]);
    let name = piece.name();
    let message = format!("piece {name} is cut in the bites {first} to {last}, and not all of these are chosen");
    let hint = format!("begin with bite {first}, choose all of them, or leave the piece out: --skip {}", piece.number);
    Some(Diagnostic::new(&code::MARKER_BITE, message).at(piece.span).about(vec![piece.number]).hint(hint))
}

/// Refusal of the number of a window that the marker does not have.
fn unknown_bite(flag: &str, bite: u32, last: u32, job: &Job) -> Diagnostic {
    let hint = match job.profile.bite.length_mm {
        Some(_) => format!("the marker is cut in {last} windows"),
        None => "the cloth lies still: bite.length_mm".to_owned(),
    };
    Diagnostic::new(&code::SELECT_UNKNOWN_PIECE, format!("{flag}: there is no bite {bite}")).hint(hint)
}

/// Keeps the pieces that are chosen, by index. A run that begins amid the marker begins with the cloth in its position for its
/// first piece. Otherwise every advance before a remaining piece stays, and if the file has one at its end, so do those after
/// the last piece.
fn keep(marker: &mut Marker, is_chosen: &[bool], selection: &Selection) {
    let first = is_chosen.iter().position(|is| *is).unwrap_or(0);
    let Marker { pieces, moved_on, closing, .. } = marker;
    let (mut place, mut left): (_, Vec<Event>) = (0.., Vec::new());
    pieces.retain_mut(|piece| {
        let i = place.next().unwrap_or(0);
        left.extend(piece.events.extract_if(.., |event| event.kind.advance_mm() > 0));
        if i == first && selection.begins_amid() {
            *moved_on = left.drain(..).map(|event| event.kind.advance_mm()).sum();
        }
        let is_kept = is_chosen[i] && selection.has(piece.number);
        if is_kept {
            piece.events.splice(0..0, left.drain(..));
        }
        is_kept
    });
    if let Some(at) = closing.iter().position(|event| event.kind.advance_mm() > 0) {
        closing.splice(at..at, left);
    }
}

/// True if anything of a piece is cut or drilled.
fn cuts(piece: &Piece) -> bool {
    !(piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty())
}

/// Numbers of the pieces of the file, in words.
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
