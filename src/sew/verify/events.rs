//! Events of a stitch file, decoded for the audit of its reader.

use super::records::{File, Kind, Record};
use crate::geom::Point;
use crate::sew::stitches::{Op, Stitches};
use crate::units::TENTHS_PER_MM;

/// An event, with the needle position after it, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The needle pierces the cloth.
    Stitch(Point),
    /// The cloth was moved with the needle up.
    Jump(Point),
    /// The thread is cut.
    Trim,
    /// The machine waits for its operator.
    Stop,
    /// The thread changes to the one with this number.
    Thread(u16),
}

/// The events that are sewn, each with its entry, from 1.
pub(super) fn sewn(stitches: &Stitches) -> Vec<(Event, u32)> {
    let event = |op: Op, to: Point| match op {
        Op::Stitch => Event::Stitch(to),
        Op::Jump => Event::Jump(to),
        Op::Trim => Event::Trim,
        Op::Stop => Event::Stop,
        Op::Color(thread) => Event::Thread(thread),
    };
    stitches.steps.iter().zip(1..).map(|(step, entry)| (event(step.op, step.to), entry)).collect()
}

/// The events of the records of a stitch file. Consecutive jumps are one move, and from `trim_jumps` on they cut a thread in
/// use. A stop is a change to the next thread.
pub(super) fn of_records(file: &File) -> Vec<Event> {
    let mut events = Events { list: Vec::new(), jumps: 0, sews: false, needle: [0; 2], file };
    let (mut at, mut thread) = ([0; 2], 1_u16);
    for &Record { kind, at: to } in &file.records {
        match kind {
            Kind::Jump => events.jumps += 1,
            Kind::Stitch => {
                events.land(at);
                events.list.push(Event::Stitch(place(to)));
                (events.needle, events.sews) = (to, true);
            }
            Kind::Trim | Kind::Stop | Kind::Needle(_) | Kind::Halt => {
                events.land(at);
                events.halt(kind, &mut thread);
                events.jumps = usize::from(to != at);
            }
        }
        at = to;
    }
    events.land(at);
    events.list
}

struct Events<'a> {
    list: Vec<Event>,
    /// Number of consecutive jumps.
    jumps: usize,
    /// True if the thread of the last stitch is not cut yet.
    sews: bool,
    /// Needle position before the jumps, tenths of a millimetre.
    needle: [i64; 2],
    /// The file, whose format says which jumps cut the thread.
    file: &'a File,
}

impl Events<'_> {
    /// Cuts the thread in use.
    fn trim(&mut self) {
        if std::mem::take(&mut self.sews) {
            self.list.push(Event::Trim);
        }
    }

    /// Adds an event at which the needle stands; `thread` is the one in use.
    fn halt(&mut self, kind: Kind, thread: &mut u16) {
        let next = match kind {
            Kind::Trim => return self.trim(),
            Kind::Halt => return self.list.push(Event::Stop),
            Kind::Needle(needle) => needle,
            Kind::Stop | Kind::Stitch | Kind::Jump => thread.saturating_add(1),
        };
        if next != *thread {
            *thread = next;
            self.list.push(Event::Thread(next));
        }
    }

    /// Ends the jumps before an event, at a position.
    fn land(&mut self, at: [i64; 2]) {
        let jumps = std::mem::take(&mut self.jumps);
        let way = (at[0] - self.needle[0]).abs().max((at[1] - self.needle[1]).abs());
        let is_cut = self.file.trim_jumps.is_some_and(|least| jumps >= least)
            || self.file.trim_way.is_some_and(|most| way > most);
        if jumps > 0 && is_cut {
            self.trim();
        }
        if at != self.needle {
            self.list.push(Event::Jump(place(at)));
            self.needle = at;
        }
    }
}

fn place(at: [i64; 2]) -> Point {
    Point::new(at[0] as f64 / TENTHS_PER_MM, at[1] as f64 / TENTHS_PER_MM)
}

/// The events of the rows of a queue; `None` if a row is malformed or the end is missing.
pub(super) fn of_queue(bytes: &[u8]) -> Option<Vec<Event>> {
    let text = String::from_utf8_lossy(bytes);
    let (mut events, mut at) = (Vec::new(), Point::origin());
    for row in text.lines().skip(1).filter(|row| !row.trim().is_empty()) {
        let mut fields = row.split(',').map(str::trim);
        let [word, dx, dy, value] = std::array::from_fn(|_| fields.next().unwrap_or_default());
        if matches!(word, "STITCH" | "JUMP") {
            at = Point::new(at.x + dx.parse::<f64>().ok()?, at.y + dy.parse::<f64>().ok()?);
        }
        events.push(match word {
            "STITCH" => Event::Stitch(at),
            "JUMP" => Event::Jump(at),
            "TRIM" => Event::Trim,
            "STOP" => Event::Stop,
            "COLOR" => Event::Thread(value.parse().ok()?),
            "SPEED" => continue,
            "END" => return Some(events),
            _ => return None,
        });
    }
    None
}
