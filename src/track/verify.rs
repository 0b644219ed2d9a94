//! The verifier of commands: reads the written rows back and compares each with the readings of the log and the profile.
//!
//! It shares no code with the controller and its tables: the permitted content of a row follows from its own readings and those
//! of the debounce time before it. If upstream rulers add the velocity of the cloth, the speed of the carriage is only checked
//! against its maximum, because its own rulers do not determine it.

use std::io::{self, BufRead};

use super::row::Row;
use crate::machine::Tracking;
use crate::units::MS_PER_S;

/// The first line.
const HEADER: &str = "t_s,i,j,status,direction,v_mm_s";
/// Rounding of written times, s, and of written speeds, mm/s.
const TIME: f64 = 1e-6;
const SPEED: f64 = 1e-3;
/// Relative deviation of a time step from the period above which a sample is missing.
const MISSING: f64 = 0.4;
/// Fraction of a period that is ignored as rounding when the debounce time is counted in periods.
const PART: f64 = 1e-9;

/// Fraction of the acceleration with which the carriage brakes.
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

/// State from the rows so far.
struct Seen {
    /// |I - J| of the consecutive samples with the same side as the last one, the newest last.
    held: Vec<f64>,
    /// Side of the last sample: 1 = to the right, -1 = to the left, 0 = centred.
    side: f64,
    /// Side to which the carriage was last driven by these readings; 0 if there is none.
    driven: f64,
    time: Option<f64>,
}

/// Compares written commands with the samples of a log. Returns a description of the first fault, if any.
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
    /// The fault of a row, if any.
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

    /// Clears the state.
    fn begin(&mut self) {
        (self.held, self.side, self.driven) = (Vec::new(), 0.0, 0.0);
    }

    /// The fault in the decision on a sample that sees both edges, if any.
    fn decided(&mut self, command: &Command, track: &Tracking) -> Option<String> {
        let [left, right] = command.covered.map(f64::from);
        // I > J: the cloth lies to the left, and the carriage moves there.
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

/// Required speed of the carriage at a deviation in counts, mm/s: from minimum speed and gain. With the brake it is also
/// limited so that the carriage can stop within the guaranteed remaining distance, with the fraction [`BRAKED`] of its
/// acceleration after its dead time.
fn due_speed(counts: f64, track: &Tracking) -> f64 {
    let wanted = (track.least_speed_mm_s + track.gain_mm_s * counts).min(track.max_speed_mm_s);
    if !track.brake {
        return wanted;
    }
    let braked = BRAKED * track.carriage_acceleration_mm_s2;
    let dead = (track.latency_ms + 1.5 * track.period_ms + track.lag_ms) / MS_PER_S;
    let left = (counts - 1.0) * track.pitch_mm / 2.0;
    // From a speed v it covers v dead + v^2 / (2 braked) until it stands.
    let stops_from = braked * ((dead * dead + 2.0 * left / braked).sqrt() - dead);
    wanted.min(stops_from.max(track.least_speed_mm_s))
}

/// The alarm status of readings at which the drive is off; `None` if there is no alarm.
fn alarm([left, right]: [u16; 2], track: &Tracking) -> Option<&'static str> {
    let sensors = track.sensors as u16;
    if left >= sensors || right >= sensors {
        return Some("lost-covered");
    }
    if left == 0 || right == 0 {
        return Some("lost-open");
    }
    let [least, greatest] = track.width_range_mm?;
    // I + J - m = (W - W0)/q within one count; a whole number is read.
    let counts = f64::from(left) + f64::from(right) - f64::from(sensors);
    let [low, high] = [least, greatest].map(|width| (width - track.width_mm) / track.pitch_mm);
    (counts < low.floor() - 1.0 || counts > high.ceil() + 1.0).then_some("width")
}
