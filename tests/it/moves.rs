//! Moves that are chosen because the controller makes them fastest: `gcode.moves = "auto"`.

use std::fs;
use std::path::Path;

use cutc::machine::SHIPPED;

use crate::support::room::{DONE, FAULTY, Room};

/// Relative difference of times that count as equal, as in the manual, and the rounding of times in JSON, s.
const TIE_SHARE: f64 = 2e-4;
const ROUNDING_S: f64 = 1e-6;

/// A room with files that bend in different ways: a pocket, a marker, straight notches.
fn room() -> Room {
    let room = Room::new();
    for (name, file) in [
        ("pocket.cut", "controllers/pocket.cut"),
        ("marker.cut", "pictures/marker.cut"),
        ("notches.cut", "iso/notches-that-lean-touch-and-stand-at-a-corner.cut"),
    ] {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(file), room.at(name)).expect("a copy");
    }
    room
}

/// What a program takes on its controller, and the moves that were chosen.
#[derive(Debug)]
struct Told {
    time: f64,
    chosen: Option<String>,
    others: Vec<(String, Option<f64>)>,
}

/// Compiles a file to `out.ngc`; `None` if it is refused.
fn compiled(room: &Room, file: &str, options: &str) -> Option<Told> {
    let output = room.run(&format!("compile {file} {options} -t gcode -o out.ngc --force --format json"));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).ok().filter(|_| output.status.success())?;
    Some(told(&report["controller"]))
}

fn told(controller: &serde_json::Value) -> Told {
    let others = controller["others"].as_array().into_iter().flatten();
    let other =
        |other: &serde_json::Value| (other["moves"].as_str().unwrap_or("?").to_owned(), other["time_s"].as_f64());
    Told {
        time: controller["time_s"].as_f64().expect("seconds"),
        chosen: controller["chosen"].as_str().map(str::to_owned),
        others: others.map(other).collect(),
    }
}

#[test]
fn a_chosen_program_is_never_slower_than_with_fixed_moves() {
    let room = room();
    for shipped in SHIPPED {
        let name = shipped.name;
        let shown = room.expect(&format!("profile show -p {name}"), DONE).0;
        let number = |key: &str| -> f64 {
            let line = shown.lines().find(|line| line.starts_with(key)).unwrap_or_else(|| panic!("{key}: {shown}"));
            line.split(" = ").nth(1).and_then(|value| value.parse().ok()).expect("a number")
        };
        let [chord, heading] = ["chord_mm", "heading_tolerance_deg"].map(number);
        for file in ["pocket.cut", "circle.cut", "notches.cut"] {
            let auto = compiled(&room, file, &format!("-p {name} --set gcode.moves=auto")).expect("a program");
            let mut tried = 0;
            let lines = [1.0, 0.5].map(|share| {
                let [chord, heading] = [share * chord, share * heading];
                format!("gcode.arcs=false --set gcode.chord_mm={chord} --set gcode.heading_tolerance_deg={heading}")
            });
            let arcs = shown.contains("\narcs = true").then(|| "gcode.arcs=true".to_owned());
            for moves in lines.into_iter().chain(arcs) {
                for mode in ["G93", "G94"] {
                    let options =
                        format!("-p {name} --set gcode.moves=fixed --set gcode.feed_mode={mode} --set {moves}");
                    let Some(fixed) = compiled(&room, file, &options) else { continue };
                    tried += 1;
                    assert!(
                        fixed.chosen.is_none() && auto.time <= fixed.time * (1.0 + TIE_SHARE) + ROUNDING_S,
                        "{file} {options}: {auto:?} {fixed:?}"
                    );
                }
            }
            assert!(tried >= 2, "{name} {file}: {tried}");
        }
    }
}

#[test]
fn arcs_lines_and_finer_lines_are_chosen_each_where_it_is_the_fastest() {
    let room = room();
    // A controller that divides arcs into many chords and sees few of them at once, and one that keeps up with any line.
    let short = "-p grblhal-arcs --set gcode.decimals=6 --set gcode.heading_tolerance_deg=0.3 --set \
                 gcode.max_blocks_s=1000 --set gcode.arc_tolerance_mm=0.0001 --set gcode.planner_blocks=15";
    let quick = "-p grblhal-arcs --set gcode.decimals=6 --set gcode.heading_tolerance_deg=0.5 --set \
                 gcode.max_blocks_s=off";
    let (profile, _) = room.expect("profile init --for fluidnc", DONE);
    room.write("slow.toml", profile.replace("[\"G0 Z-2\"]", "[\"G1 Z-2 F1200\"]").as_bytes());
    for (file, machine, chosen) in [
        ("marker.cut", "-p grblhal-arcs", "arcs in G94"),
        ("marker.cut", "-p linuxcnc", "arcs in G94"),
        ("pocket.cut", short, "lines in G94 within 0.002 mm and 0.3 degrees"),
        ("marker.cut", quick, "lines in G94 within 0.001 mm and 0.25 degrees"),
        ("marker.cut", "-p fluidnc", "lines in G93 within 0.01 mm and 0.3 degrees"),
        // A mode that the controller would read wrongly is left for the other one.
        ("pocket.cut", "-p fluidnc-arcs --set gcode.feed_mode=G93", "arcs in G94"),
        ("pocket.cut", "-p slow.toml", "lines in G94 within 0.01 mm and 0.3 degrees"),
    ] {
        let told = compiled(&room, file, &format!("{machine} --set gcode.moves=auto")).expect("a program");
        assert_eq!(told.chosen.as_deref(), Some(chosen), "{machine} {file}: {told:?}");
        let slower = told.others.iter().filter_map(|(_, time)| *time).all(|time| time >= told.time * (1.0 - TIE_SHARE));
        assert!(slower, "{told:?}");
    }
}

#[test]
fn a_chosen_program_is_that_of_fixed_moves_on_any_number_of_threads() {
    let room = room();
    let lines_of = |name: &str| -> Vec<String> {
        room.text(name).lines().filter(|line| !line.starts_with("(machine:")).map(str::to_owned).collect()
    };
    room.expect("compile marker.cut -p fluidnc-arcs -t gcode -o fixed.ngc", DONE);
    let fixed = lines_of("fixed.ngc");
    for threads in ["1", "4"] {
        let mut command =
            room.command("compile marker.cut -p fluidnc-arcs --set gcode.moves=auto -t gcode -o auto.ngc --force");
        let output = command.env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert!(output.status.success(), "{output:?}");
        assert!(lines_of("auto.ngc") == fixed, "{threads} threads");
    }
}

#[test]
fn lines_that_the_decimals_do_not_tell_are_no_choice() {
    let room = room();
    let told = compiled(&room, "circle.cut", "-p grblhal-arcs --set gcode.moves=auto").expect("a program");
    assert_eq!(told.chosen.as_deref(), Some("arcs in G94"));
    assert!(told.others.len() == 2 && told.others.iter().all(|(_, time)| time.is_none()), "{told:?}");
}

#[test]
fn info_names_the_moves_that_a_compile_chooses() {
    let room = room();
    let options = "-p fluidnc-arcs --set gcode.moves=auto";
    let written = compiled(&room, "pocket.cut", options).expect("a program");
    let (known, _) = room.expect(&format!("info pocket.cut {options} --time --format json"), DONE);
    let known: serde_json::Value = serde_json::from_str(&known).expect("JSON");
    assert_eq!(format!("{:?}", told(&known["controller"])), format!("{written:?}"));
    let (said, _) = room.expect(&format!("info pocket.cut {options} --time"), DONE);
    assert!(said.contains("arcs in G94, the fastest of 3"), "{said}");
}

#[test]
fn a_program_is_judged_by_the_feed_mode_that_it_chose() {
    let room = room();
    let verify = |text: &str, options: &str, code: i32| {
        room.write("edited.ngc", text.as_bytes());
        room.says(&format!("verify edited.ngc --source pocket.cut {options}"), code)
    };
    for (options, mode, other) in [
        ("-p fluidnc-arcs --set gcode.moves=auto", "\nG94\n", "\nG93\n"),
        ("-p fluidnc --set gcode.moves=auto", "\nG93\n", "\nG94\n"),
    ] {
        compiled(&room, "pocket.cut", options).expect("a program");
        let program = room.text("out.ngc");
        assert!(program.contains(mode), "{program}");
        verify(&program, options, DONE);
        let said = verify(&program.replacen(mode, other, 1), options, FAULTY);
        let is_told =
            said.contains("an arc in inverse time, which this controller mistimes") || said.contains("verify/crawl");
        assert!(is_told, "{options}: {said}");
        let said = verify(&program.replacen(mode, "\nG95\n", 1), options, FAULTY);
        assert!(said.contains("is `G95` where `G9"), "{said}");
    }
}
