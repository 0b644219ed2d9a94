//! Replay: the rows of a log through the controller, and what happens on the way.

use super::controller::{Command, Controller, Reading, Status};
use super::drive::Drive;
use super::law::law;
use super::log::is_gap;
use super::row::Row;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::machine::Tracking;
use crate::source::Span;
use crate::units::number::short;

/// A log with what the controller makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// The samples.
    pub rows: Vec<Row>,
    /// A command for each.
    pub commands: Vec<Command>,
}

/// Gives rows to a controller, one by one. It begins anew where samples are missing.
pub(super) fn replay(rows: Vec<Row>, track: &Tracking, out: &mut Diagnostics) -> Replay {
    let law = law(track);
    let mut controller = Controller::new();
    let mut commands: Vec<Command> = Vec::with_capacity(rows.len());
    let mut before: Option<&Row> = None;
    for row in &rows {
        if before.is_some_and(|before| is_gap(before, row, track)) {
            controller = Controller::new();
        }
        let Row { covered: [left, right], upstream, .. } = *row;
        let command = controller.step(&law, Reading { left, right, upstream });
        let last = commands.last().map(|command| command.status);
        if let Some(alarm) = alarm(command.status).filter(|_| last != Some(command.status)) {
            out.push(alarmed(alarm, row, track));
        }
        commands.push(command);
        before = Some(row);
    }
    Replay { rows, commands }
}

/// What is said of a status at which the drive is switched off.
fn alarm(status: Status) -> Option<(&'static Code, &'static str)> {
    match status {
        Status::Centred | Status::Waiting | Status::Driving => None,
        Status::LostCovered => Some((&code::TRACK_LOST, "all sensors of a ruler are covered")),
        Status::LostOpen => Some((&code::TRACK_LOST, "no sensor of a ruler is covered")),
        Status::Width => Some((&code::TRACK_WIDTH, "the cloth is")),
    }
}

/// The finding of an alarm that begins at a row.
fn alarmed((code, what): (&'static Code, &'static str), row: &Row, track: &Tracking) -> Diagnostic {
    let [left, right] = row.covered;
    let time = short(row.time);
    let message = if code == &code::TRACK_WIDTH {
        let excess = f64::from(left) + f64::from(right) - f64::from(track.sensors);
        format!(
            "{what} {} mm wide at {time} s (I = {left}, J = {right})",
            short(track.width_mm + excess * track.pitch_mm)
        )
    } else {
        format!("{what} at {time} s (I = {left}, J = {right}): its edge is lost, the drive is off")
    };
    Diagnostic::new(code, message).at(Span { start: row.start, end: row.start, block: 0 })
}

/// Where the carriage was at each row, mm: as the log tells, or as a drive would have followed the commands from the middle.
pub(super) fn carriage(replay: &Replay, track: &Tracking, out: &mut Diagnostics) -> Vec<f64> {
    if let Some(told) = replay.rows.iter().map(|row| row.carriage).collect() {
        return told;
    }
    let message = "the log does not tell where the carriage was: it is taken to have followed these commands from 0 mm";
    let hint = "log its encoder as a column `carriage_mm`: the centre line is only as true as that";
    out.push(Diagnostic::new(&code::TRACK_CARRIAGE, message).hint(hint));
    let mut drive = Drive::new(track);
    let befores = std::iter::once(None).chain(replay.rows.iter().map(Some));
    let samples = replay.rows.iter().zip(&replay.commands).zip(befores);
    let place = |((row, command), before): ((&Row, &Command), Option<&Row>)| {
        // Where samples are missing nothing commands the drive.
        if let Some(before) = before.filter(|before| is_gap(before, row, track)) {
            let missing = ((row.time - before.time) / track.period()).round().clamp(1.0, STOPPED) as u32 - 1;
            (0..missing).for_each(|_| drive.follow(0.0));
        }
        let place = drive.place;
        drive.follow(command.velocity);
        place
    };
    samples.map(place).collect()
}

/// Periods after which a drive that nothing commands stands.
const STOPPED: f64 = 100_000.0;
