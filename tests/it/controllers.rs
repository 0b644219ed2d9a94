//! Profiles that ship, a controller each: what a machine of that kind is given for a small job, and how they are taken by name.

use std::fs;
use std::io::{BufReader, Cursor};
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::machine::{Job, SHIPPED, load};
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use cutc::verify::{self, Ground};

use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A room with a pocket: straight edges, one that bows, a hole and a stop.
fn room() -> Room {
    let room = Room::new();
    let pocket = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/controllers/pocket.cut");
    fs::copy(pocket, room.at("pocket.cut")).expect("a copy");
    room
}

/// SHA-256 of the machine of a program, as its provenance records it.
fn digest(room: &Room, program: &str) -> String {
    let meta: serde_json::Value = serde_json::from_str(&room.text(&format!("{program}.meta.json"))).expect("JSON");
    meta["profile_sha256"].as_str().expect("a digest").to_owned()
}

#[test]
fn a_pocket_in_the_dialect_of_each_controller() {
    let room = room();
    for shipped in SHIPPED {
        let name = shipped.name;
        room.expect(&format!("compile pocket.cut -p {name} -t gcode -o {name}.ngc"), DONE);
        let program = room.text(&format!("{name}.ngc"));
        insta::assert_snapshot!(name, program);
        room.expect(&format!("verify {name}.ngc --source pocket.cut -p {name}"), DONE);
        room.expect(&format!("compile pocket.cut -p {name} -t gcode -o {name}.ngc --force"), DONE);
        assert!(room.text(&format!("{name}.ngc")) == program, "{name}: another program of the same input");
    }
}

#[test]
fn a_profile_that_ships_is_taken_by_name_with_settings_on_top() {
    let room = room();
    let (listed, _) = room.expect("profile list", DONE);
    assert_eq!(listed.lines().count(), SHIPPED.len());
    for (line, shipped) in listed.lines().zip(SHIPPED) {
        assert!(line.starts_with(shipped.name) && line.ends_with(shipped.about) && line.len() <= 100, "{line}");
        let name = shipped.name;
        room.expect(&format!("profile check {name}"), DONE);
        room.expect(&format!("profile init --for {name} -o {name}.toml"), DONE);
        room.expect(&format!("compile circle.cut -p {name} -t gcode -o named.ngc --force"), DONE);
        room.expect(&format!("compile circle.cut -p {name}.toml -t gcode -o file.ngc --force"), DONE);
        assert_eq!(digest(&room, "named.ngc"), digest(&room, "file.ngc"), "{name}");
    }
    let (shown, _) = room.expect("profile show -p fluidnc --set gcode.letter=B", DONE);
    assert!(shown.contains("letter = \"B\"") && shown.contains("feed_mode = \"G93\""), "{shown}");
    let (program, _) = room.expect("compile circle.cut -p fluidnc --set gcode.letter=B -t gcode -o -", DONE);
    assert!(program.contains("(machine: fluidnc, with gcode.letter set)"), "{program}");
}

#[test]
fn a_file_with_the_name_of_a_profile_that_ships_needs_a_path() {
    let room = room();
    room.write("fluidnc", b"knife.width_mm = 3\n");
    let (_, stderr) = room.expect("profile show -p fluidnc", USAGE);
    assert!(
        stderr.contains("`fluidnc` is a profile that ships, and a file") && stderr.contains("./fluidnc"),
        "{stderr}"
    );
    let (shown, _) = room.expect("profile show -p ./fluidnc", DONE);
    assert!(shown.contains("width_mm = 3.0") && shown.contains("feed_mode = \"G94\""), "{shown}");
    fs::create_dir(room.at("grblhal")).expect("writable");
    let (shown, _) = room.expect("profile show -p grblhal", DONE);
    assert!(shown.contains("feed_mode = \"G93\""), "{shown}");
}

#[test]
fn a_machine_does_not_park_off_its_table() {
    let room = room();
    let table = "--set table.x_mm=[0,1600] --set table.y_mm=[0,1200]";
    let (_, stderr) = room.expect(&format!("profile show -p fluidnc {table} --set park=[5000,0,0]"), USAGE);
    assert!(stderr.contains("`park` is 3400 mm off the table, at 5000, 0 mm"), "{stderr}");
    room.expect(&format!("profile show -p fluidnc {table} --set park=[1600,1200,0]"), DONE);
}

#[test]
fn a_name_that_no_profile_has_is_answered_with_those_that_ship() {
    let room = room();
    let names: Vec<&str> = SHIPPED.iter().map(|shipped| shipped.name).collect();
    let known = format!("hint: these ship: {}", names.join(", "));
    for arguments in ["compile circle.cut -p fluid", "profile init --for fluid", "profile check fluid"] {
        let (_, stderr) = room.expect(arguments, USAGE);
        assert!(stderr.contains("there is no profile `fluid`") && stderr.contains(&known), "{stderr}");
        assert!(stderr.lines().all(|line| line.len() <= 100), "{stderr}");
    }
}

#[test]
fn an_output_that_does_not_wait_for_moves_is_switched_where_the_axes_stand() {
    let room = room();
    let grbl = |name| (name, 'P', "\nG4 P0.010\nM64 P1\nG4 P0.300\nM65 P1\n");
    let reprap = ("reprap", 'S', "\nG4 S0.010\nM42 P1 S1\nG4 S0.300\nM42 P1 S0\n");
    let machines = ["grblhal", "grblhal-arcs", "fluidnc", "fluidnc-arcs", "mega5x"].map(grbl);
    for (name, word, held) in machines.into_iter().chain([reprap]) {
        let (program, _) = room.expect(&format!("compile pocket.cut -p {name} -t gcode -o -"), DONE);
        assert!(program.contains(held), "{name}: {program}");
        let check = |from: &str, to: &str, expected: &str| {
            let [from, to] = [from, to].map(|text| text.replace("G4 P", &format!("G4 {word}")));
            let damaged = program.replacen(&from, &to, 1);
            assert_ne!(damaged, program, "{name}: {from}");
            room.write("damaged.ngc", damaged.as_bytes());
            let (said, _) = room.expect(&format!("verify damaged.ngc --source pocket.cut -p {name}"), FAULTY);
            assert!(said.contains(expected), "{name}: {said}");
        };
        // The drill would come down while the head is still on its way.
        check("G4 P0.010\n", "", "acts while the axes move: a rest belongs before it");
        check("G4 P0.010\n", "G4 P0.000\n", "acts while the axes move: a rest belongs before it");
        check("G4 P0.010\n", "G4 P0.020\n", "verify/dwell");
        // Nothing is switched after this rest.
        check("\nG1 X70.0000", "\nG4 P0.010\nG1 X70.0000", "verify/dwell");
    }
}

#[test]
fn a_rest_spelled_for_another_dialect_is_refused() {
    let room = room();
    for (name, from, to) in [("reprap", "G4 S", "G4 P"), ("fluidnc", "G4 P", "G4 S"), ("linuxcnc", "G4 P", "G4 S")] {
        room.expect(&format!("compile pocket.cut -p {name} -t gcode -o out.ngc --force"), DONE);
        let damaged = room.text("out.ngc").replacen(from, to, 1);
        room.write("damaged.ngc", damaged.as_bytes());
        let (said, _) = room.expect(&format!("verify damaged.ngc --source pocket.cut -p {name}"), FAULTY);
        assert!(said.contains("verify/format"), "{name}: {said}");
    }
}

#[test]
fn a_usual_first_line_is_that_of_one_dialect_only() {
    let room = room();
    room.write("other.ngc", b"G17 G21 G90\nG0 X1\n");
    let (_, stderr) = room.expect("verify other.ngc --source pocket.cut -p linuxcnc", FAULTY);
    assert!(stderr.contains("its first line is `G17 G21 G90`, not `G17 G21 G40 G80 G90 G91.1`"), "{stderr}");
}

#[test]
fn arcs_in_inverse_time_are_refused_for_a_controller_that_does_not_divide_it() {
    let room = room();
    let fixed = "--set gcode.moves=fixed --set gcode.feed_mode=G93";
    for (name, who) in [("reprap", "RepRapFirmware"), ("fluidnc-arcs", "the grbl family")] {
        let (_, stderr) = room.expect(&format!("compile pocket.cut -p {name} {fixed} -t gcode -o out.ngc"), USAGE);
        assert!(stderr.contains(&format!("is \"G93\" with arcs, which {who} mistimes")), "{stderr}");
    }
    room.expect(&format!("compile pocket.cut -p reprap {fixed} --set gcode.arcs=false -t gcode -o out.ngc"), DONE);
    room.expect(&format!("compile pocket.cut -p linuxcnc {fixed} -t gcode -o arcs.ngc"), DONE);
}

/// A line with its word of a letter changed; `None` if it has none.
fn with_word(line: &str, letter: char, change: impl Fn(f64) -> f64) -> Option<String> {
    let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
    let word = words.iter_mut().skip(1).find(|word| word.starts_with(letter))?;
    *word = format!("{letter}{:.5}", change(word[1..].parse().ok()?));
    Some(words.join(" "))
}

#[test]
fn two_hundred_damaged_programs_of_each_dialect_are_refused() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/controllers/pocket.cut");
    let source = Source::new("pocket.cut", fs::read(path).expect("a fixture")).expect("small");
    for shipped in SHIPPED {
        let job = Job { profile: load(Some(&shipped.source()), &[]).expect("it is legal"), ..Job::default() };
        let mut said = Diagnostics::default();
        let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
        let mut out = Cursor::new(Vec::new());
        let order = Order { from: None, target, verify: true };
        pipeline::compile(&source, &job, order, &mut out, &mut said).expect("memory takes it").expect("a program");
        let program = String::from_utf8(out.into_inner()).expect("ASCII");
        let input = pipeline::read(&source, None, &job, &mut said).expect("it is read");
        let ground = Ground::new(&input.marker, &job.profile);
        let passes = |text: &str| verify::positions(&mut BufReader::new(text.as_bytes()), None, &ground, &job).passes();
        assert!(passes(&program), "{}", shipped.name);
        let lines: Vec<&str> = program.lines().collect();
        let mut random = fastrand::Rng::with_seed(51);
        let mut count = 0;
        while count < 200 {
            let at = random.usize(..lines.len());
            let (line, sign) = (lines[at], if random.bool() { 1.0 } else { -1.0 });
            let (kind, by) = (random.usize(..4), sign * (1.0 + 4.0 * random.f64()));
            let changed = match kind {
                _ if line.starts_with('(') => continue,
                0 => with_word(line, ['X', 'Y'][random.usize(..2)], |place| place + by),
                // A hole is drilled with the blade any way round.
                1 if line.starts_with("G0") => continue,
                1 => with_word(line, char::from(job.profile.gcode.letter.byte()), |turn| turn + 2.0 * by),
                2 => with_word(line, 'F', |feed| 40.0 * feed),
                _ => {
                    let words: Vec<&str> = line.split(' ').collect();
                    let left_out = random.usize(..words.len());
                    let kept = words.iter().enumerate().filter(|(i, _)| *i != left_out).map(|(_, word)| *word);
                    Some(kept.collect::<Vec<_>>().join(" "))
                }
            };
            let Some(changed) = changed else { continue };
            let mut damaged: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
            damaged[at].clone_from(&changed);
            assert!(!passes(&(damaged.join("\n") + "\n")), "{}: `{changed}` for `{line}`", shipped.name);
            count += 1;
        }
    }
}

#[test]
fn a_flat_arc_is_a_straight_move_for_a_controller_that_would_miss_it() {
    let room = room();
    room.expect("compile pocket.cut -p grblhal-arcs --set gcode.max_radius_mm=off -t gcode -o any.ngc", DONE);
    room.expect("compile pocket.cut -p grblhal-arcs -t gcode -o some.ngc", DONE);
    let arcs = |name: &str| room.text(name).lines().filter(|line| line.contains(" I")).count();
    assert_eq!([arcs("any.ngc"), arcs("some.ngc")], [4, 3]);
    let (said, _) = room.expect("verify any.ngc --source pocket.cut -p grblhal-arcs", FAULTY);
    assert!(said.contains("is an arc of radius 31152 mm, which this controller misses"), "{said}");
}

#[test]
fn a_cut_that_is_little_longer_than_the_blade_is_plunged_where_that_would_turn_on_the_spot() {
    let room = Room::new();
    let name = "notches-that-lean-touch-and-stand-at-a-corner.cut";
    let notches = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso").join(name);
    fs::copy(notches, room.at("notches.cut")).expect("a copy");
    for (machine, corner) in [("fluidnc", 22), ("fluidnc", 30), ("linuxcnc", 26)] {
        room.expect(&format!("compile notches.cut -p {machine} --set corner.angle_deg={corner} -t gcode -o -"), DONE);
    }
}

#[test]
fn the_time_is_that_of_the_planner_of_the_controller_with_what_limits_it() {
    let room = room();
    let mut all = String::new();
    let options = ["", " --set gcode.planner_blocks=3 --set gcode.arc_tolerance_mm=0.0005 --set knife.feed_mm_s=900"];
    for shipped in SHIPPED {
        for option in options {
            let command = format!("compile pocket.cut -p {} -t gcode -o out.ngc --force{option}", shipped.name);
            let (_, summary) = room.expect(&command, DONE);
            let lines = summary.lines().skip_while(|line| !line.contains("controller"));
            all += shipped.name;
            all += option;
            all.push('\n');
            for line in lines.take_while(|line| line.contains("controller") || line.starts_with("             ")) {
                assert!(line.len() <= 80, "{line}");
                all += line;
                all.push('\n');
            }
        }
    }
    insta::assert_snapshot!(all);
}

#[test]
fn a_longer_look_ahead_is_never_slower_and_costs_what_is_told() {
    let room = room();
    let told = |blocks: u32| {
        let set = format!("--set gcode.planner_blocks={blocks} --set knife.feed_mm_s=900");
        let command = format!("compile pocket.cut -p fluidnc-arcs {set} -t gcode -o out.ngc --force --format json");
        let (report, _) = room.expect(&command, DONE);
        let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
        let controller = &report["controller"];
        assert_eq!(controller["planner"], "grbl");
        let number = |value: &serde_json::Value| value.as_f64().expect("seconds");
        let parts = controller["limits"].as_array().expect("limits").iter();
        let parts: Vec<(String, f64)> =
            parts.map(|part| (part["limit"].as_str().expect("a word").to_owned(), number(&part["time_s"]))).collect();
        let time = number(&controller["time_s"]);
        let late = parts.iter().find(|(limit, _)| limit == "look-ahead").map_or(0.0, |(_, time)| *time);
        (time, late)
    };
    let [short, long, longest] = [2, 20, 1000].map(told);
    assert!(short.0 > long.0 + 0.01 && long.0 >= longest.0, "{short:?} {long:?} {longest:?}");
    // An unlimited look-ahead saves the time that the short one costs.
    assert!((short.0 - short.1 - longest.0).abs() < 1e-4 && longest.1 < 1e-6, "{short:?} {longest:?}");
}

#[test]
fn info_tells_the_time_on_the_controller_of_a_profile_that_has_one() {
    let room = room();
    let json =
        |command: &str| -> serde_json::Value { serde_json::from_str(&room.expect(command, DONE).0).expect("JSON") };
    for name in ["linuxcnc", "fluidnc", "fluidnc-arcs"] {
        let written = json(&format!("compile pocket.cut -p {name} -t gcode -o out.ngc --force --format json"));
        let known = json(&format!("info pocket.cut -p {name} --time --format json"));
        assert!(written["controller"]["time_s"].as_f64().is_some_and(|time| time > 1.0));
        assert_eq!(known["controller"], written["controller"], "{name}");
        let row = json(&format!("info pocket.cut circle.cut -p {name} --format json"));
        let times = [&row["files"][0], &written["controller"]].map(|of| of["time_s"].as_f64().expect("seconds"));
        assert!((times[0] - times[1]).abs() < 1e-4, "{name}: {times:?}");
    }
    // A job that the target refuses has no time there, and no fault.
    let known = json("info pocket.cut --set gcode.letter=A --set knife.follow=chord --time --format json");
    assert!(known["controller"].is_null() && known["time_s"].as_f64().is_some());
    let known = json("info pocket.cut --time --format json");
    assert!(known["controller"].is_null() && known["time_s"].as_f64().is_some());
}
