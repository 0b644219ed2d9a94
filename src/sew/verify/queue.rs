//! Checks of queue entries: the increments add up to the needle points, and each stitch fits at the current speed.

use std::collections::BTreeMap;
use std::io::BufRead;

use super::clock;
use super::ground::{Ground, sighting};
use super::rules;
use super::spindle::Spindle;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;
use crate::sew::stitches::Op;
use crate::units::columns::{Lines, Unread};

/// Rounding of times, as a fraction of the window: the speed is a whole number.
const WINDOW_EPSILON: f64 = 2e-6;

/// An entry of a queue.
#[derive(Debug, PartialEq)]
pub(super) enum Entry {
    /// A stitch (true) or a jump (false), with its increments, mm.
    Way(bool, [f64; 2]),
    Trim,
    Stop,
    Color(u16),
    Speed(f64),
    End,
}

/// File format of a queue.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form {
    /// First line, if it is not an entry.
    head: Option<&'static str>,
    /// Parses any other line.
    entry: fn(&str) -> Option<Entry>,
}

/// Rows of text.
pub(super) const ROWS: Form = Form { head: Some("op,dx_mm,dy_mm,value"), entry: row };
/// JSON, one entry per line.
pub(super) const JSON: Form = Form { head: None, entry: json };

/// Verifies a queue of a file format.
pub(super) fn judge(
    input: &mut dyn BufRead,
    form: Form,
    ground: &Ground,
    worst: &mut WorstByRule,
) -> Result<(), Unread> {
    let (mut lines, mut i) = (Lines::default(), 0);
    if let Some(head) = form.head {
        lines.header(input, head)?;
    }
    // Many moves have the same number of steps, so their times are cached.
    let mut times: BTreeMap<u64, f64> = BTreeMap::new();
    let (mut at, mut rpm, mut spindle, mut is_ended) = ([0.0; 2], 0.0, Spindle::new(ground), false);
    while let Some(text) = lines.next(input)? {
        let entry = (form.entry)(text).filter(|_| !is_ended).ok_or_else(|| lines.is("it is no entry"))?;
        let (is_asked, way) = match entry {
            Entry::Speed(speed) => {
                rpm = speed;
                continue;
            }
            Entry::End => {
                is_ended = true;
                continue;
            }
            Entry::Way(true, way) => (op(ground, i) == Some(Op::Stitch), way),
            Entry::Way(false, way) => (op(ground, i) == Some(Op::Jump), way),
            Entry::Trim => (op(ground, i) == Some(Op::Trim), [0.0; 2]),
            Entry::Stop => (op(ground, i) == Some(Op::Stop), [0.0; 2]),
            Entry::Color(thread) => (op(ground, i) == Some(Op::Color(thread)), [0.0; 2]),
        };
        at = [at[0] + way[0], at[1] + way[1]];
        let is_sewn = matches!(entry, Entry::Way(true, _));
        see(ground, worst, i, (is_asked, at));
        spindle.see(i, if is_sewn { rpm } else { 0.0 }, ground, worst);
        if is_sewn {
            let steps = way.map(|way| (way / ground.sewing.step_mm).abs().round() as u64);
            let steps = steps[0].max(steps[1]);
            let needed = *times.entry(steps).or_insert_with(|| clock::least_move_us(ground.sewing, steps));
            fits(ground, worst, i, (needed, rpm));
        }
        i += 1;
    }
    if !is_ended {
        return Err(lines.is("END is missing"));
    }
    worst.count(&rules::ENTRIES, ground.stitches.steps.len().abs_diff(i), None);
    Ok(())
}

fn op(ground: &Ground, i: usize) -> Option<Op> {
    ground.stitches.steps.get(i).map(|step| step.op)
}

/// Checks an entry; `is_asked` is true for the required action, `at` is the needle position after it.
fn see(ground: &Ground, worst: &mut WorstByRule, i: usize, (is_asked, at): (bool, [f64; 2])) {
    let step = ground.stitches.steps.get(i);
    let place = step.map(|step| sighting(i as u32 + 1, step.to));
    worst.count(&rules::ENTRIES, usize::from(!is_asked), place);
    let planned = step.map_or(Point::new(f64::NAN, f64::NAN), |step| step.to);
    let off = (at[0] - planned.x).abs().max((at[1] - planned.y).abs());
    if step.is_some() {
        worst.see(&rules::END_POINT, off, place);
    }
}

/// Checks that a stitch that needs a time, microseconds, fits into its window at a speed.
fn fits(ground: &Ground, worst: &mut WorstByRule, i: usize, (needed, rpm): (f64, f64)) {
    let window = clock::window_us(ground.sewing, rpm);
    let place = ground.stitches.steps.get(i).map(|step| sighting(i as u32 + 1, step.to));
    worst.see(&rules::WINDOW, needed - window * (1.0 + WINDOW_EPSILON), place);
}

/// Parses a finite number, such as an increment.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Parses an entry from a row of text.
fn row(text: &str) -> Option<Entry> {
    let mut fields = text.split(',');
    let [word, dx, dy, value] = [fields.next()?, fields.next()?, fields.next()?, fields.next()?];
    if fields.next().is_some() {
        return None;
    }
    let is_bare = dx.is_empty() && dy.is_empty();
    match word {
        "STITCH" | "JUMP" if value.is_empty() => Some(Entry::Way(word == "STITCH", [number(dx)?, number(dy)?])),
        "TRIM" if is_bare && value.is_empty() => Some(Entry::Trim),
        "STOP" if is_bare && value.is_empty() => Some(Entry::Stop),
        "END" if is_bare && value.is_empty() => Some(Entry::End),
        "COLOR" if is_bare => value.parse().ok().map(Entry::Color),
        "SPEED" if is_bare => number(value).map(Entry::Speed),
        _ => None,
    }
}

/// Parses an entry from a line of JSON.
fn json(text: &str) -> Option<Entry> {
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Line<'a> {
        op: &'a str,
        dx_mm: Option<f64>,
        dy_mm: Option<f64>,
        value: Option<f64>,
    }
    let Line { op, dx_mm, dy_mm, value } = serde_json::from_str(text).ok()?;
    match (op, dx_mm, dy_mm, value) {
        ("STITCH" | "JUMP", Some(dx), Some(dy), None) => Some(Entry::Way(op == "STITCH", [dx, dy])),
        ("TRIM", None, None, None) => Some(Entry::Trim),
        ("STOP", None, None, None) => Some(Entry::Stop),
        ("END", None, None, None) => Some(Entry::End),
        ("COLOR", None, None, Some(thread)) => {
            let is_number = thread.fract() == 0.0 && (0.0..=f64::from(u16::MAX)).contains(&thread);
            is_number.then_some(Entry::Color(thread as u16))
        }
        ("SPEED", None, None, Some(rpm)) => Some(Entry::Speed(rpm)),
        _ => None,
    }
}
