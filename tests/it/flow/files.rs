//! Markers of every kind on the conveyor of the fixtures: each is cut or refused as it should be.

use std::fmt::Write as _;

use cutc::flow::verify::Bytes;
use cutc::flow::{Emit, Speed};

use super::{Planned, broken, job, judged, plan, planned, target, written};
use crate::support::room::{DONE, FAULTY, Room, USAGE};

fn names(folder: &str) -> Vec<String> {
    let path = format!("{}/fixtures/{folder}", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(path).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| format!("{folder}/{}", entry.expect("readable").file_name().to_string_lossy())).collect();
    names.sort();
    names
}

#[test]
fn every_marker_of_the_fixtures_is_cut_and_said() {
    let job = job(&[]);
    let mut all = String::new();
    for name in names("flow") {
        for speed in [50.0, 150.0] {
            let planned = planned(&name, speed, &job);
            assert_eq!(broken(&planned, &job), [""; 0], "{name} at {speed} mm/s");
            let figures = &planned.program.figures;
            let _ = writeln!(
                all,
                "{name} at {speed} mm/s: {} chains, {} abreast, {} heads (at least {}) in {} rows, travel {:.1} mm (bound {:.1}), {:.2} s",
                figures.chains,
                figures.chains_abreast,
                figures.heads,
                figures.heads_bound,
                figures.rows,
                figures.travel_mm,
                figures.travel_bound_mm,
                figures.time_s
            );
        }
    }
    insta::assert_snapshot!(all);
}

#[test]
fn every_marker_of_the_cutter_is_cut_on_the_conveyor_too() {
    let job = job(&["flow.heads=60", "flow.rows=30", "flow.travel_mm=300"]);
    for name in ["circles", "drills-and-slits", "metric-four-pieces", "narrow-gaps", "touching-parts"] {
        let name = format!("markers/{name}.cut");
        let planned = planned(&name, 40.0, &job);
        assert_eq!(broken(&planned, &job), [""; 0], "{name}");
    }
}

#[test]
fn what_cannot_be_cut_is_said_with_what_would_help() {
    let mut all = String::new();
    for name in names("invalid/flow") {
        let (planned, said) = plan(&name, Speed::Profile, &job(&[]));
        assert!(planned.is_none(), "{name}");
        let _ = writeln!(all, "{name}\n{said}");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn records_hold_what_rows_hold_and_pictures_are_whole() {
    let job = job(&[]);
    let planned = planned("flow/two-discs.csv", 100.0, &job);
    let (plan, heads) = written(&planned, &job, "npy");
    let verdict = judged(&planned.marker, &job, &plan, Bytes::Records, &heads);
    assert!(verdict.passes(), "{verdict:?}");
    assert_eq!((heads[0].len() - 256) as u64, planned.program.ticks * 45);
    let Planned { marker, program } = &planned;
    for (name, start, end) in
        [("svg", "<svg", "</svg>\n"), ("timing", "<svg", "</svg>\n"), ("html", "<!doctype html>", "</html>\n")]
    {
        let Emit::Whole { write, .. } = target(name).emit else { panic!("{name} is a picture") };
        let mut bytes = Vec::new();
        write(program, marker, &mut bytes).expect("a vector takes bytes");
        let text = String::from_utf8(bytes).expect("text");
        assert!(text.starts_with(start) && text.ends_with(end) && !text.contains("NaN"), "{name}");
    }
}

#[test]
fn a_plan_is_judged_anew_from_the_bytes_of_all_its_programs() {
    let room = Room::new();
    room.write("flow.toml", &super::fixture("machines/flow.toml"));
    std::fs::create_dir(room.at("in")).expect("writable");
    room.write("in/two-discs.csv", &super::fixture("flow/two-discs.csv"));
    room.expect("flow in/two-discs.csv -p flow.toml -o out -t csv,npy,svg", DONE);
    let verify = |what: &str, code| room.says(&format!("verify {what} -p flow.toml"), code);
    for named in ["out", "out/plan.json"] {
        let said = verify(&format!("{named} --source in/two-discs.csv"), DONE);
        assert!(said.contains("PASS  `out/plan.json` cuts what `in/two-discs.csv` says: 25 rules hold"), "{said}");
        assert!(!said.contains("warning"), "{said}");
    }
    assert!(verify("out --source in", DONE).contains("1 file, 1 done"));
    // Beside another program both are judged; the programs of heads are the plan's.
    room.expect("compile in/two-discs.csv -o out/two-discs.ngc", DONE);
    assert!(room.says("verify out --source in/two-discs.csv", FAULTY).contains("2 files, "));
    // A knife that comes up too early.
    let rows = String::from_utf8(std::fs::read(room.at("out/head-02.csv")).expect("readable")).expect("text");
    let down = rows.lines().filter(|row| row.contains(",1,")).nth(20).expect("a stroke");
    room.write("out/head-02.csv", rows.replacen(down, &down.replacen(",1,", ",0,", 1), 1).as_bytes());
    let said = verify("out/plan.json --source in/two-discs.csv", FAULTY);
    assert!(said.contains("FAIL  flow-verify/dwell") && said.contains(" of head 2"), "{said}");
    assert!(said.contains("`out/head-02.csv` is not the program that was planned"), "{said}");
    let json = verify("out/plan.json --source in/two-discs.csv --format json -q", FAULTY);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let dwell = json["rules"].as_array().expect("a list").iter().find(|rule| rule["code"] == "flow-verify/dwell");
    assert_eq!(dwell.expect("judged")["where"]["head"], 2);
    // The other target is judged, too.
    room.write("out/head-02.csv", rows.as_bytes());
    let mut records = std::fs::read(room.at("out/head-02.npy")).expect("readable");
    records.pop();
    room.write("out/head-02.npy", &records);
    let said = verify("out/plan.json --source in/two-discs.csv", FAULTY);
    assert!(said.contains("flow-verify/format") && said.contains("the array: it is cut off"), "{said}");
    std::fs::remove_file(room.at("out/head-02.npy")).expect("removable");
    assert!(verify("out/plan.json --source in/two-discs.csv", USAGE).contains("there is no `out/head-02.npy`"));
    room.write("out/plan.json", b"{");
    assert!(verify("out/plan.json --source in/two-discs.csv", FAULTY).contains("plan.json is no JSON"));
}

#[test]
fn a_plan_is_written_whole_and_takes_the_place_of_an_earlier_one() {
    let room = Room::new();
    let machine = super::fixture("machines/flow.toml");
    room.write("flow.toml", &machine);
    room.write("two-discs.csv", &super::fixture("flow/two-discs.csv"));
    let (said, _) = room.expect("flow two-discs.csv -p flow.toml --speed 100 -o out -t csv,npy,svg,timing,html", DONE);
    assert!(said.contains("4 in 2 rows; "), "{said}");
    for name in
        ["plan.json", "plan.json.meta.json", "head-04.csv", "head-04.npy", "chains.svg", "rows.svg", "player.html"]
    {
        assert!(room.at("out").join(name).is_file(), "{name}");
    }
    let first = std::fs::read(room.at("out/head-01.csv")).expect("readable");
    room.expect("flow two-discs.csv -p flow.toml --speed 100 -o out", DONE);
    assert_eq!(std::fs::read(room.at("out/head-01.csv")).expect("readable"), first);
    // What the new plan does not have is moved aside.
    assert!(!room.at("out/head-01.npy").exists() && room.at("out/head-01.npy.stale").is_file());
    room.write("rectangle.csv", &super::fixture("flow/rectangle.csv"));
    room.expect("flow rectangle.csv -p flow.toml -o out", USAGE);
    // Where nothing can be cut no older program stays.
    room.expect("flow two-discs.csv -p flow.toml --speed 900 -o out", FAULTY);
    assert!(!room.at("out/plan.json").exists() && !room.at("out/head-01.csv").exists());
    room.expect("flow two-discs.csv -p flow.toml --speed fast -o out", USAGE);
    room.expect("flow two-discs.csv -p flow.toml --dry-run -o out", USAGE);
}
