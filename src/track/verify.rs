//! The verifier of commands: reads the written rows back and holds each against the readings of the log and the profile.
//!
//! Shares nothing with the controller and its tables: what a row may say follows from its own readings and from those of the
//! debounce time before it. Where rulers upstream add the velocity of the cloth, how fast the carriage is driven is judged by
//! its greatest speed alone: its own rulers do not tell more.

use std::io::{self, BufRead};

use super::row::Row;
use crate::machine::Tracking;
use crate::units::MS_PER_S;

/// The first line.
const HEADER: &str = "t_s,i,j,status,direction,v_mm_s";
/// Rounding of times, s, and of speeds, mm/s, as they are written.
const TIME: f64 = 1e-6;
const SPEED: f64 = 1e-3;
/// Part of a period by which a sample may be late before one is missing.
const MISSING: f64 = 0.4;
/// Part of a period that is none: a debounce time that is so many periods but for rounding.
const PART: f64 = 1e-9;

/// The part of its acceleration that the carriage brakes with.
const BRAKED: f64 = 0.6;

/// A written row.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Command<'a> {
    time: f64,
    covered: [u16; 2],
    status: &'a str,
    direction: i8,
    speed: f64,
}

/// What the rows so far say.
struct Seen {
    /// |I - J| of the samples that told the same side as the last one, without a break before it, the newest last.
    held: Vec<f64>,
    /// The side that the last one told: 1 = to the right, -1 = to the left.
    side: f64,
    /// The side to which the carriage was driven last by these readings; 0 = to none.
    driven: f64,
    time: Option<f64>,
}

/// What is wrong with written commands for the samples of a log, if anything is: the first row of it, in words.
pub fn commands(bytes: &mut dyn BufRead, rows: &[Row], track: &Tracking) -> io::Result<Option<String>> {
    let mut lines = bytes.lines();
    if lines.next().transpose()?.as_deref() != Some(HEADER) {
        return Ok(Some(format!("the first line is not `{HEADER}`")));
    }
    let mut seen = Seen { held: Vec::new(), side: 0.0, driven: 0.0, time: None };
    let mut count = 0;
    for (line, number) in lines.zip(2..) {
        let line = line?;
        let wrong = match (parse(&line), rows.get(count)) {
            (None, _) => Some("it is no row".to_owned()),
            (_, None) => Some("there are more rows than samples".to_owned()),
            (Some(command), Some(row)) => seen.wrong(&command, row, track),
        };
        if let Some(wrong) = wrong {
            return Ok(Some(format!("line {number}: {wrong}")));
        }
        count += 1;
    }
    Ok((count != rows.len()).then(|| format!("{count} rows stand for {} samples", rows.len())))
}

fn parse(line: &str) -> Option<Command<'_>> {
    let fields: Vec<&str> = line.split(',').collect();
    let [time, left, right, status, direction, speed] = fields[..] else { return None };
    Some(Command {
        time: time.parse().ok()?,
        covered: [left.parse().ok()?, right.parse().ok()?],
        status,
        direction: direction.parse().ok()?,
        speed: speed.parse().ok().filter(|speed: &f64| speed.is_finite())?,
    })
}

impl Seen {
    /// What is wrong with a row, if anything is.
    fn wrong(&mut self, command: &Command, row: &Row, track: &Tracking) -> Option<String> {
        if (command.time - row.time).abs() > TIME || command.covered != row.covered {
            return Some("it is of another sample than the log has there".to_owned());
        }
        let period = track.period_ms / MS_PER_S;
        let is_gap = self.time.is_some_and(|time| (row.time - time - period).abs() > MISSING * period);
        self.time = Some(row.time);
        if is_gap {
            self.begin();
        }
        let Command { status, direction, speed, .. } = *command;
        if !(0.0..=track.max_speed_mm_s + SPEED).contains(&speed) || (direction == 0) != (speed == 0.0) && speed > SPEED
        {
            return Some(format!("the carriage goes {direction} at {speed} mm/s"));
        }
        if let Some(alarm) = alarm(row.covered, track) {
            self.begin();
            let is_off = status == alarm && direction == 0 && speed == 0.0;
            return (!is_off).then(|| format!("it says `{status}` at {speed} mm/s where the drive is off: `{alarm}`"));
        }
        self.decided(command, track)
    }

    /// Nothing is known of what was before.
    fn begin(&mut self) {
        (self.held, self.side, self.driven) = (Vec::new(), 0.0, 0.0);
    }

    /// What is wrong with what was decided of a sample that sees both edges.
    fn decided(&mut self, command: &Command, track: &Tracking) -> Option<String> {
        let [left, right] = command.covered.map(f64::from);
        // I > J: the cloth lies to the left, and the carriage goes there.
        let off = right - left;
        let side = if off == 0.0 { 0.0 } else { off.signum() };
        if side != self.side {
            (self.held, self.side) = (Vec::new(), side);
        }
        self.held.push(off.abs());
        let needed = (track.debounce_ms / track.period_ms - PART).ceil().max(0.0) as usize + 1;
        let is_on_its_way = off.abs() == 1.0 && side == -self.driven;
        let due = if side == 0.0 || is_on_its_way {
            "centred"
        } else if self.held.len() < needed {
            "waiting"
        } else {
            "driving"
        };
        let Command { status, direction, speed, .. } = *command;
        if status != due {
            return Some(format!("it says `{status}` where the cloth lies {} counts off: `{due}`", -off));
        }
        let is_driven = due == "driving";
        if is_driven {
            self.driven = side;
        }
        if track.upstream_mm.is_some() {
            return None;
        }
        if !is_driven {
            return (speed != 0.0).then(|| format!("the carriage goes at {speed} mm/s while it is `{status}`"));
        }
        let window = &self.held[self.held.len() - needed..];
        let least = window.iter().copied().fold(f64::INFINITY, f64::min);
        let is_right = f64::from(direction) == side || speed <= SPEED;
        (!is_right || (speed - due_speed(least, track)).abs() > SPEED)
            .then(|| format!("the carriage goes {direction} at {speed} mm/s, where the cloth lies {} counts off", -off))
    }
}

/// How fast the carriage is driven that is so many counts off, mm/s: by least speed and gain, and with the brake no faster than it
/// stops from, within what is sure to be left, with that part of its acceleration behind its dead time.
fn due_speed(counts: f64, track: &Tracking) -> f64 {
    let wanted = (track.least_speed_mm_s + track.gain_mm_s * counts).min(track.max_speed_mm_s);
    if !track.brake {
        return wanted;
    }
    let braked = BRAKED * track.carriage_acceleration_mm_s2;
    let dead = (track.latency_ms + 1.5 * track.period_ms + track.lag_ms) / MS_PER_S;
    let left = (counts - 1.0) * track.pitch_mm / 2.0;
    // From a speed v it goes v dead + v^2 / (2 braked) until it stands.
    let stops_from = braked * ((dead * dead + 2.0 * left / braked).sqrt() - dead);
    wanted.min(stops_from.max(track.least_speed_mm_s))
}

/// The status of readings with which the drive is off.
fn alarm([left, right]: [u16; 2], track: &Tracking) -> Option<&'static str> {
    let sensors = track.sensors as u16;
    if left >= sensors || right >= sensors {
        return Some("lost-covered");
    }
    if left == 0 || right == 0 {
        return Some("lost-open");
    }
    let [least, greatest] = track.width_range_mm?;
    // I + J - m = (W - W0)/q within one count, of which a whole number is read.
    let counts = f64::from(left) + f64::from(right) - f64::from(sensors);
    let [low, high] = [least, greatest].map(|width| (width - track.width_mm) / track.pitch_mm);
    (counts < low.floor() - 1.0 || counts > high.ceil() + 1.0).then_some("width")
}
