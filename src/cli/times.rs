//! Time of each piece of a program, and its limiting factor.

use std::fmt::Write as _;

use serde::Serialize;

use crate::ir::Marker;
use crate::ir::marker::Piece;
use crate::ir::toolpath::Event;
use crate::machine::MachineProfile;
use crate::pipeline::{Program, Spent, Waits, significant, waits};
use crate::units::number::fixed;
use crate::units::{S_PER_HOUR, S_PER_MIN};

/// Significant digits of times, far below a control period.
const DIGITS: i32 = 9;

/// The time of one piece. Fields are keys of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct Timed {
    piece: u32,
    /// Absent if there is only one copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    copy: Option<u32>,
    #[serde(skip)]
    name: String,
    /// Names of the pieces inside this one, which are cut before it.
    waits_for: Vec<String>,
    /// Events before the piece.
    asked: Vec<&'static str>,
    time_s: f64,
    spent: Spent,
}

/// Maximum number of inner pieces to name in a row. JSON has all.
const NAMED: usize = 3;

/// The pieces of a program in cut order. The travel to a piece counts as its own.
pub(super) fn of(program: &Program, marker: &Marker, profile: &MachineProfile) -> Vec<Timed> {
    let waits = waits(marker, profile);
    let timed = |([piece, part], spent): &([u32; 2], Spent)| {
        let of = marker.pieces.get(*part as usize);
        let Waits { inner, events } = waits.get(*part as usize).cloned().unwrap_or_default();
        Timed {
            piece: *piece,
            copy: of.map(|piece| piece.copy).filter(|&copy| copy > 0),
            name: of.map_or_else(|| piece.to_string(), Piece::name),
            waits_for: inner.into_iter().map(|inner| marker.pieces[inner].name()).collect(),
            asked: events.into_iter().map(|event| asked_for(event.kind)).collect(),
            time_s: significant(spent.total(), DIGITS),
            spent: spent.clone(),
        }
    };
    program.by_piece.iter().map(timed).collect()
}

/// A long duration in hours, minutes and seconds, as in `1:02:05`.
pub(super) fn clock(seconds: f64) -> String {
    let all = seconds.round() as u64;
    let (hour, minute) = (S_PER_HOUR as u64, S_PER_MIN as u64);
    let (hours, minutes, seconds) = (all / hour, all % hour / minute, all % minute);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

/// A table with one row per piece: its time, the time by activity, and the main limit of its cutting.
pub(super) fn text(pieces: &[Timed]) -> String {
    let mut out = String::from("\n  piece    time s     cut  travel    turn  plunge    lift   other  limited by\n");
    for Timed { name, time_s, spent, waits_for, asked, .. } in pieces {
        let other = spent.drill + spent.wait;
        let _ = write!(out, "  {name:>5}  {:>8}", fixed(*time_s, 2)); // a `String` takes all
        for part in [spent.cut, spent.travel, spent.turn, spent.plunge, spent.lift, other] {
            let _ = write!(out, "  {:>6}", fixed(part, 2));
        }
        if let Some((bound, _)) = spent.bounds.iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
            let _ = write!(out, "  {bound}");
        }
        let mut waits: Vec<&str> = asked.clone();
        waits.extend(waits_for.iter().take(NAMED).map(String::as_str));
        let more = waits_for.len().saturating_sub(NAMED);
        if !waits.is_empty() {
            let _ = write!(out, "; waits for {}", waits.join(", "));
        }
        if more > 0 {
            let _ = write!(out, " and {more} more");
        }
        out.push('\n');
    }
    out
}

/// A request to the operator or the conveyor, in a word.
fn asked_for(event: Event) -> &'static str {
    match event {
        Event::Stop => "stop",
        Event::Advance | Event::AdvanceBy(_) => "advance",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_times_are_told_by_the_clock() {
        assert_eq!([0.4, 59.6, 3599.0, 3725.0, 90_000.0].map(clock), ["0:00", "1:00", "59:59", "1:02:05", "25:00:00"]);
    }
}
