//! Replay: runs the rows of a log through the controller and reports alarms.

use super::controller::{Command, Controller, Reading, Status};
use super::drive::Drive;
use super::law::law;
use super::log::is_gap;
use super::row::Row;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::machine::Tracking;
use crate::source::Span;
use crate::units::number::short;

/// A log with the commands of the controller.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// The samples.
    pub rows: Vec<Row>,
    /// The command for each sample.
    pub commands: Vec<Command>,
}

/// Runs rows through a controller, which is reset where samples are missing.
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
        commands.push(command);
        before = Some(row);
    }
    let replay = Replay { rows, commands };
    tell(&replay, track, out);
    replay
}

/// Reports where the drive is switched off.
pub(super) fn tell(replay: &Replay, track: &Tracking, out: &mut Diagnostics) {
    let mut last = None;
    for (row, Command { status, .. }) in replay.rows.iter().zip(&replay.commands) {
        if let Some(alarm) = alarm(*status).filter(|_| last != Some(*status)) {
            out.push(alarmed(alarm, row, track));
        }
        last = Some(*status);
    }
}

/// Code and wording of a status at which the drive is switched off.
fn alarm(status: Status) -> Option<(&'static Code, &'static str)> {
    match status {
        Status::Centred | Status::Waiting | Status::Driving => None,
        Status::LostCovered => Some((&code::TRACK_LOST, "all sensors of a ruler are covered")),
        Status::LostOpen => Some((&code::TRACK_LOST, "no sensor of a ruler is covered")),
        Status::Width => Some((&code::TRACK_WIDTH, "the cloth is")),
    }
}

/// The finding on an alarm that begins at a row.
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
    let found = Diagnostic::new(code, message);
    // The rows of a simulation are not in a file.
    row.start.map_or(found.clone(), |start| found.at(Span { start, end: start, block: 0 }))
}

/// Position of the carriage at each row, mm: from the log, otherwise simulated by a drive that follows the commands from the
/// middle.
pub(super) fn carriage(replay: &Replay, track: &Tracking, out: &mut Diagnostics) -> Vec<f64> {
    if let Some(told) = replay.rows.iter().map(|row| row.carriage).collect() {
        return told;
    }
    let message = "the log does not tell where the carriage was: it is taken to have followed these commands from 0 mm";
    let hint = "log its encoder as a column `carriage_mm`: the centre line is only as true as that";
    out.push(Diagnostic::new(&code::TRACK_CARRIAGE, message).hint(hint));
    let mut drive = Drive::new(track);
    let mut before: Option<&Row> = None;
    let rows = replay.rows.iter().zip(&replay.commands);
    rows.map(|(row, command)| {
        // There are no commands while samples are missing: the drive comes to rest.
        if let Some(before) = before.filter(|before| is_gap(before, row, track)) {
            let missing = ((row.time - before.time) / track.period()).round() - 1.0;
            let mut left = missing.max(0.0) as u64;
            while left > 0 && !drive.rests() {
                drive.follow(0.0);
                left -= 1;
            }
        }
        before = Some(row);
        let place = drive.place;
        drive.follow(command.velocity);
        place
    })
    .collect()
}
