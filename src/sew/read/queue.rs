//! The entries of a stitch queue, as written by the target `queue`: `op,dx_mm,dy_mm,value`.

use super::format::{FARTHEST, Format, Input, Speed};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::sewn;
use crate::geom::Point;
use crate::sew::stitches::{Op, Step, Stitches};
use crate::source::{Source, Span};

pub(super) const FORMAT: Format = Format {
    name: "queue",
    about: "entries of a stitch queue: `op,dx_mm,dy_mm,value`, as the target queue writes them",
    extensions: &["csv"],
    record_word: "record",
    is_it: |bytes, _| sewn::is_queue(bytes),
    read,
};

/// Content of a row.
enum Row {
    Step(Op, [f64; 2]),
    /// Stitches per minute.
    Speed(f64),
    End,
}

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let (mut steps, mut speeds) = (Vec::new(), Vec::new());
    let mut at = Point::origin();
    let mut start = 0;
    let mut is_ended = false;
    for (line, row) in source.bytes().split(|&byte| byte == b'\n').zip(1..) {
        let span = Span { start, end: start + line.len() as u32, block: row };
        start = span.end + 1;
        if row == 1 || line.trim_ascii().is_empty() {
            continue;
        }
        let parsed = if is_ended { Err("the row stands behind END".to_owned()) } else { parse(line) };
        match parsed {
            Ok(Row::Step(op, [dx, dy])) => {
                at = Point::new(at.x + dx, at.y + dy);
                // The header does not count as a record.
                let is_tie = op == Op::Stitch && dx == 0.0 && dy == 0.0;
                steps.push(Step { op, to: at, is_tie, record: row - 1 });
            }
            Ok(Row::Speed(rpm)) => speeds.push(Speed { record: row - 1, rpm }),
            Ok(Row::End) => is_ended = true,
            Err(message) => {
                let hint = "a row is STITCH or JUMP with two increments in mm, TRIM, STOP, COLOR n, SPEED n or END";
                out.push(Diagnostic::new(&code::SEW_ROW, message).at(span).hint(hint));
            }
        }
    }
    if !is_ended && !out.has_errors() {
        let hint = "the end of the pattern is missing: transfer the file again, and compare sizes";
        out.push(Diagnostic::new(&code::SEW_TRUNCATED, "the queue has no END").hint(hint));
    }
    Input::Stitches(Stitches { steps }, speeds)
}

fn parse(line: &[u8]) -> Result<Row, String> {
    let text = std::str::from_utf8(line).map_err(|_| "the row is no text".to_owned())?.trim_end();
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    let [op, dx, dy, value] = fields[..] else {
        return Err(format!("the row has {} fields instead of 4", fields.len()));
    };
    let number = |field: &str| match field.parse::<f64>() {
        Ok(value) if value.abs() <= FARTHEST => Ok(value + 0.0),
        Ok(_) | Err(_) => Err(format!("`{field}` is no increment in mm")),
    };
    match op {
        "STITCH" => Ok(Row::Step(Op::Stitch, [number(dx)?, number(dy)?])),
        "JUMP" => Ok(Row::Step(Op::Jump, [number(dx)?, number(dy)?])),
        "TRIM" => Ok(Row::Step(Op::Trim, [0.0; 2])),
        "STOP" => Ok(Row::Step(Op::Stop, [0.0; 2])),
        "COLOR" => match value.parse() {
            Ok(thread) if thread > 0 => Ok(Row::Step(Op::Color(thread), [0.0; 2])),
            Ok(_) | Err(_) => Err(format!("`{value}` is no number of a thread")),
        },
        "SPEED" => match value.parse() {
            Ok(rpm) if rpm > 0.0 => Ok(Row::Speed(rpm)),
            Ok(_) | Err(_) => Err(format!("`{value}` is no speed in rpm")),
        },
        "END" => Ok(Row::End),
        _ => Err(format!("`{op}` is no entry of a queue")),
    }
}
