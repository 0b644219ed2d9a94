//! Logs, scenarios and centre lines: each is read or refused as it should be, whatever is done to it.

use std::fmt::Write as _;

use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::Tracking;
use cutc::track::scenario::Scenario;
use cutc::track::{Needs, Tracked, centre, verify};
use fastrand::Rng;

use super::{fixture, replayed, source, written};
use crate::support::damage::{names, survives};
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// Damages of each file that are tried.
const DAMAGES: usize = 300;

/// Reads a file as what its name says it is; what is said of it, and whether it can be used.
fn read(name: &str, bytes: Vec<u8>, track: &Tracking) -> (bool, String) {
    let (source, mut out) = (source(name, bytes), Diagnostics::default());
    let is_read = if name.contains(".toml") {
        Scenario::read(&source, track, &mut out).is_some()
    } else if name.contains(".centre.") {
        centre::read(&source, &mut out).is_some()
    } else {
        Tracked::of_log(&source, track, Needs::Centre, &mut out).is_some()
    };
    assert_eq!(is_read, !out.has_errors(), "{name}");
    (is_read, render(&out, &source))
}

#[test]
fn every_log_and_scenario_is_read_and_said() {
    let mut all = String::new();
    for name in names("track") {
        let (is_read, said) = read(&name, fixture(&name), &Tracking::default());
        assert!(is_read, "{name}: {said}");
        let _ = write!(all, "{name}\n{said}");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn every_fault_of_a_file_is_said_with_its_place() {
    let mut all = String::new();
    for name in names("invalid/track") {
        let (is_read, said) = read(&name, fixture(&name), &Tracking::default());
        assert!(!is_read, "{name}: {said}");
        let _ = writeln!(all, "{name}\n{said}");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn damaged_files_are_refused_or_read_but_never_end_in_a_panic() {
    let mut random = Rng::with_seed(27);
    for name in names("track").into_iter().chain(names("invalid/track")) {
        survives(&mut random, DAMAGES, (&name, &fixture(&name)), |bytes| {
            read(&name, bytes.to_vec(), &Tracking::default());
        });
    }
}

#[test]
fn the_log_of_a_simulation_replays_to_the_same_commands() {
    for upstream_mm in [None, Some(400.0)] {
        let track = Tracking { upstream_mm, ..Tracking::default() };
        for name in ["track/step.toml", "track/wander-fast.toml", "track/damage.toml"] {
            let (toml, mut out) = (source(name, fixture(name)), Diagnostics::default());
            let simulated = Tracked::of_scenario(&toml, &track, Needs::Centre, &mut out).expect("a scenario");
            let log = written(&simulated, "log");
            let (replay, said) = replayed("x.csv", log.clone(), &track);
            let replay = replay.unwrap_or_else(|| panic!("{name}: {said}"));
            assert_eq!(written(&simulated, "commands"), written(&replay, "commands"), "{name}");
            assert_eq!(written(&simulated, "centre"), written(&replay, "centre"), "{name}");
            assert_eq!(log, written(&replay, "log"), "{name}");
            // What an earlier run said may stand in a log.
            assert!(replayed("x.csv", written(&replay, "commands"), &Tracking::default()).0.is_some());
            // A carriage that is not logged is taken to have followed the commands, which is what it did.
            let header = if upstream_mm.is_some() { "t_s,i,j,up_i,up_j" } else { "t_s,i,j" };
            let fields = header.matches(',').count() + 1;
            let text = String::from_utf8(log).expect("text");
            let bare: Vec<String> =
                text.lines().map(|line| line.split(',').take(fields).collect::<Vec<_>>().join(",")).collect();
            let (bare, said) = replayed("x.csv", bare.join("\n"), &track);
            assert!(said.contains("track/carriage-assumed"), "{said}");
            assert_eq!(written(&bare.expect("a log"), "centre"), written(&replay, "centre"), "{name}");
        }
    }
}

#[test]
fn the_centre_line_is_that_of_the_cloth() {
    for (name, within) in [("track/wander.toml", 0.25), ("track/wander-fast.toml", 0.6)] {
        let track = Tracking::default();
        let scenario = super::scenario(name, &track);
        let (toml, mut out) = (source(name, fixture(name)), Diagnostics::default());
        let simulated = Tracked::of_scenario(&toml, &track, Needs::Centre, &mut out).expect("a scenario");
        let line = source("x.centre.csv", written(&simulated, "centre"));
        let line = centre::read(&line, &mut out).expect("a centre line");
        let off = |[at, centre]: &[f64; 2]| (centre - scenario.centre(at / track.cloth_mm_s)).abs();
        let worst = line.rows().iter().map(off).fold(0.0, f64::max);
        assert!(worst <= within, "{name}: {worst}");
        assert!(line.range()[1] > 3990.0, "{:?}", line.range());
    }
}

#[test]
fn the_command_writes_all_or_nothing_and_says_how_well_the_cloth_is_followed() {
    let room = Room::new();
    room.write("step.toml", &fixture("track/step.toml"));
    let (stdout, _) = room.expect("track --simulate step.toml", DONE);
    assert!(stdout.contains("PI guide") && stdout.contains("older, two mechanisms, 10 mm/s"), "{stdout}");
    assert!(!room.has("step.commands.csv"), "nobody asked for it");
    room.expect("track --simulate step.toml -t log,centre --plot step.svg", DONE);
    assert!(
        room.text("step.svg").starts_with("<svg ") && room.text("step.svg.meta.json").contains("\"target\": \"svg\"")
    );
    let (stdout, _) = room.expect("track step.log.csv", DONE);
    assert!(stdout.contains("301 samples") && stdout.contains("driving"), "{stdout}");
    assert!(
        room.text("step.log.commands.csv")
            .starts_with("t_s,i,j,status,direction,v_mm_s\n0.000000,32,32,centred,0,0.000\n")
    );
    let (stdout, _) = room.expect("track --simulate step.toml --format json", DONE);
    let json: serde_json::Value = serde_json::from_str(&stdout).expect("JSON");
    assert!(json["followers"][0]["settling_s"].as_f64().is_some_and(|time| time < 0.5), "{stdout}");
    let (stdout, stderr) = room.expect("track step.log.csv -o -", DONE);
    assert!(stdout.starts_with("t_s,i,j,status") && stderr.contains("301 samples"), "{stderr}");
    // A log that is damaged leaves nothing that could be taken for its commands.
    room.write("step.log.csv", b"t_s,i,j\n0,32,32\n0.01,x,32\n");
    let said = room.says("track step.log.csv", FAULTY);
    assert!(said.contains("`x` is no number of sensors") && said.contains("line 3"), "{said}");
    assert!(!room.has("step.log.commands.csv") && room.has("step.log.commands.csv.stale"));
    room.expect("track step.toml -o step.toml", USAGE);
    room.expect("track -o x.csv -t log,centre step.log.csv", USAGE);
}

#[test]
fn commands_that_break_the_law_are_seen() {
    let track = Tracking { width_range_mm: Some([1480.0, 1520.0]), ..Tracking::default() };
    let name = "track/step.toml";
    let (toml, mut out) = (source(name, fixture(name)), Diagnostics::default());
    let tracked = Tracked::of_scenario(&toml, &track, Needs::Commands, &mut out).expect("a scenario");
    let text = String::from_utf8(written(&tracked, "commands")).expect("text");
    let rows = &tracked.replay.rows;
    let judged = |text: &str| verify::commands(&mut text.as_bytes(), rows, &track).expect("memory is readable");
    assert_eq!(judged(&text), None);
    // The first rows of each status, as they stand.
    let row = |status: &str| text.lines().find(|line| line.contains(status)).unwrap_or_else(|| panic!("no {status}"));
    let (waiting, driving, centred) = (row(",waiting,"), row(",driving,"), row(",centred,"));
    let fields: Vec<&str> = driving.split(',').collect();
    let other = |direction: &str, speed: &str| format!("{},{direction},{speed}", fields[..4].join(","));
    let damages = [
        text.replacen(waiting, &waiting.replace("waiting,0,0.000", "driving,1,7.000"), 1),
        text.replacen(driving, &driving.replace(",driving,", ",waiting,"), 1),
        text.replacen(driving, &other(if fields[4] == "1" { "-1" } else { "1" }, fields[5]), 1),
        text.replacen(driving, &other(fields[4], "999.000"), 1),
        text.replacen(driving, &other(fields[4], "190.000"), 1),
        text.replacen(driving, &other(fields[4], "0.500"), 1),
        text.replacen(driving, &other("0", fields[5]), 1),
        text.replacen(centred, &centred.replace("centred,0,0.000", "centred,1,2.000"), 1),
        text.replacen(centred, &centred.replace(",32,32,", ",31,32,"), 1),
        text.replacen("t_s,i,j", "t_s,j,i", 1),
        text.split_inclusive('\n').take(40).collect(),
        format!("{text}9.000000,32,32,centred,0,0.000\n"),
        text.replacen(centred, "half a row", 1),
    ];
    for (i, damaged) in damages.iter().enumerate() {
        assert_ne!(*damaged, text, "damage {i} does nothing");
        assert!(judged(damaged).is_some(), "damage {i}");
    }
}

#[test]
fn alarms_and_gaps_are_held_against_the_readings() {
    let track = Tracking { width_range_mm: Some([1490.0, 1510.0]), ..Tracking::default() };
    let mut log = String::from("t_s,i,j\n");
    let readings = [[32, 32], [64, 10], [30, 34], [30, 34], [0, 40], [20, 20], [30, 34]];
    for (k, [i, j]) in readings.iter().flat_map(|reading| std::iter::repeat_n(reading, 10)).enumerate() {
        let gap = if k < 35 { 0 } else { 50 };
        let _ = writeln!(log, "{:.2},{i},{j}", 0.01 * f64::from(k as u32 + gap));
    }
    let (tracked, said) = replayed("x.csv", log, &track);
    let tracked = tracked.unwrap_or_else(|| panic!("{said}"));
    let text = String::from_utf8(written(&tracked, "commands")).expect("text");
    let judged =
        |text: &str| verify::commands(&mut text.as_bytes(), &tracked.replay.rows, &track).expect("memory is readable");
    assert_eq!(judged(&text), None);
    for status in ["lost-covered", "lost-open", "width"] {
        let line = text.lines().find(|line| line.contains(status)).unwrap_or_else(|| panic!("no {status}"));
        assert!(judged(&text.replacen(line, &line.replace(",0,0.000", ",1,4.000"), 1)).is_some(), "{status}");
        assert!(judged(&text.replacen(line, &line.replace(status, "centred"), 1)).is_some(), "{status}");
    }
    // Behind the gap nothing is held: a carriage that goes on there does not wait.
    let behind = text.lines().find(|line| line.starts_with("0.85")).expect("a row behind the gap");
    assert!(behind.contains(",waiting,"), "{behind}");
    assert!(judged(&text.replacen(behind, &behind.replace("waiting,0,0.000", "driving,1,4.000"), 1)).is_some());
}
