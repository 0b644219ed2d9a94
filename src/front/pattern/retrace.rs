//! Retraced lines: a line that continues past its own start, or repeats itself, is reduced to the ring that it closes.
//!
//! Other software draws the overcut of its knife into an outline. Notches and folds need the ring itself, so the repeated
//! stretch is removed first.

use super::chain::Chain;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::geom::closing::{self, Retrace};
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// A removed stretch of a line that repeated the line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Retraced {
    /// Length past the start, mm.
    past: f64,
    rounds: usize,
    is_back: bool,
    /// Location of the start of the line.
    span: Span,
}

/// The repetition in a line.
fn retrace(line: &Chain) -> Option<Retrace> {
    let count = line.vertices.len();
    let round = count + usize::from(line.is_closed);
    closing::retrace(round, |k| line.vertices[if k < count { k } else { k - count }].at, Dxf::RETRACE_OFF)
}

/// True if a line continues past its own start or repeats itself.
pub(super) fn retraces(line: &Chain) -> bool {
    retrace(line).is_some()
}

/// Removes the repeated stretches of lines and records them.
pub(super) fn once(lines: Vec<Chain>, retraced: &mut Vec<Retraced>) -> Vec<Chain> {
    let ring = |mut line: Chain| {
        if let Some(Retrace { last, rounds, is_back, past }) = retrace(&line) {
            let count = line.vertices.len();
            retraced.push(Retraced { past, rounds, is_back, span: line.vertices[0].span });
            // The next segment starts at the first vertex instead.
            let closing = line.vertices[(last + 1) % count].span;
            line.vertices.truncate(last + 1);
            line.vertices[0].span = closing;
            line.is_closed = true;
        }
        line
    };
    lines.into_iter().map(ring).collect()
}

/// Reports the numbers of outlines and cut-outs that continue past their start or repeat themselves.
pub(super) fn say_retraced(retraced: &[Retraced], out: &mut Diagnostics) {
    let longest = retraced.iter().map(|line| line.past).fold(0.0, f64::max);
    let most = retraced.iter().filter(|line| !line.is_back).map(|line| line.rounds).max().unwrap_or(0);
    let mut say = |code: &'static Code, is_so: fn(&Retraced) -> bool, how: String| {
        let lines: Vec<&Retraced> = retraced.iter().filter(|line| is_so(line)).collect();
        let Some(first) = lines.first() else { return };
        let (count, verb) = match lines.len() {
            1 => ("1 outline".to_owned(), "runs"),
            count => (format!("{count} outlines"), "run"),
        };
        out.push(Diagnostic::new(code, format!("{count} {verb} {how}: cut once")).at(first.span));
    };
    say(&code::MARKER_OVERRUN, |line| line.past > 0.0, format!("past the start, by up to {longest:.1} mm"));
    say(
        &code::MARKER_ROUND_AGAIN,
        |line| line.rounds > 1 && !line.is_back,
        format!("round {most} times in one stroke"),
    );
    say(&code::MARKER_ROUND_AGAIN, |line| line.is_back, "round and back in one stroke".to_owned());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_is_what_is_promised() {
        assert_eq!(Dxf::PAST_CORNER.to_bits(), closing::LONGEST_STRAIGHT.to_bits());
        assert_eq!(Dxf::RETRACE_OFF.to_bits(), closing::LEAST_REACH.to_bits());
    }
}
