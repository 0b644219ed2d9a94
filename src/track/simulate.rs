//! The closed loop: the controller on a plant, over the cloth of a scenario, with alternative trackers for comparison.

use super::controller::{Command, Controller, Reading};
use super::drive::Drive;
use super::law::law;
use super::replay::Replay;
use super::rivals::{Guide, INTEGRAL, Older, PROPORTIONAL};
use super::row::Row;
use super::rulers::covered;
use super::scenario::Scenario;
use crate::machine::Tracking;
use crate::units::number::short;

/// Speeds of the older tracker, mm/s: its original speed, and a reduced one.
const OLDER_SPEEDS: [f64; 2] = [50.0, 10.0];

/// Result of a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// Centre of the cloth under the carriage at each sample, mm.
    pub cloth: Vec<f64>,
    /// The log of the carriage, with the commands of the controller.
    pub replay: Replay,
    /// The followers of the cloth; the controller of the profile comes first.
    pub followers: Vec<Follower>,
}

/// A follower of the cloth.
#[derive(Debug, Clone, PartialEq)]
pub struct Follower {
    /// Description.
    pub name: String,
    /// Position at each sample, mm.
    pub places: Vec<f64>,
}

/// Simulates only the controller of a profile.
pub fn run(scenario: &Scenario, track: &Tracking) -> Simulation {
    let law = law(track);
    let (mut controller, mut drive) = (Controller::new(), Drive::new(track));
    let count = (scenario.duration / track.period()).floor() as usize + 1;
    let mut simulation = Simulation {
        cloth: Vec::with_capacity(count),
        replay: Replay { rows: Vec::with_capacity(count), commands: Vec::with_capacity(count) },
        followers: Vec::new(),
    };
    let mut places = Vec::with_capacity(count);
    for sample in 0..count {
        let time = sample as f64 * track.period();
        let [left, right] = covered(track, drive.place, edges(scenario, time));
        let ahead = track.upstream_mm.map(|distance| time + distance / track.cloth_mm_s);
        let upstream = ahead.map(|time| covered(track, 0.0, edges(scenario, time)));
        let command: Command = controller.step(&law, Reading { left, right, upstream });
        simulation.cloth.push(scenario.centre(time));
        simulation.replay.rows.push(Row {
            time,
            covered: [left, right],
            upstream,
            conveyor: Some(time * track.cloth_mm_s),
            carriage: Some(drive.place),
            start: None,
        });
        simulation.replay.commands.push(command);
        places.push(drive.place);
        drive.follow(command.velocity);
    }
    let brake = if track.brake { ", brake" } else { "" };
    let ahead = if track.upstream_mm.is_some() { ", feed-forward" } else { "" };
    let (f, k) = (short(track.least_speed_mm_s), short(track.gain_mm_s));
    simulation.followers.push(Follower { name: format!("controller, f = {f}, k = {k}{brake}{ahead}"), places });
    simulation
}

/// Simulates the controller of a profile and the alternative trackers.
pub fn compare(scenario: &Scenario, track: &Tracking) -> Simulation {
    let mut simulation = run(scenario, track);
    let times = || simulation.replay.rows.iter().map(|row| row.time);
    let older = OLDER_SPEEDS.map(|speed| {
        let mut older = Older::new(track, speed);
        let follow = |time: f64| {
            let place = older.place();
            older.follow(edges(scenario, time));
            place
        };
        Follower { name: format!("older, two mechanisms, {speed} mm/s"), places: times().map(follow).collect() }
    });
    let (mut guide, mut drive) = (Guide::new(), Drive::new(track));
    let follow = |time: f64| {
        let place = drive.place;
        drive.follow(guide.step(track, covered(track, place, edges(scenario, time))));
        place
    };
    let name = format!("PI guide, Kp = {PROPORTIONAL}, Ki = {INTEGRAL}");
    let guide = Follower { name, places: times().map(follow).collect() };
    simulation.followers.extend(older);
    simulation.followers.push(guide);
    simulation
}

/// Positions of the cloth edges as seen by a ruler, mm.
fn edges(scenario: &Scenario, time: f64) -> [f64; 2] {
    let (centre, half) = (scenario.centre(time), scenario.width / 2.0);
    let missing = scenario.missing(time);
    [centre - half + missing[0], centre + half - missing[1]]
}
