//! Many files at once: where their programs go, what is said of them, what is left when a run is stopped.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use serde_json::Value;

use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A square of so many tenths of a millimetre.
fn square(side: usize) -> String {
    format!("H1*G71*N1*X0Y0*M14*X{side}*Y{side}*X0*Y0*M15*M0*")
}

/// A room with a folder of squares, one of them a plot, one of them bad.
fn room() -> Room {
    let room = Room::new();
    for folder in ["in/left", "in/right"] {
        fs::create_dir_all(room.at(folder)).expect("writable");
    }
    room.write("in/a.cut", square(500).as_bytes());
    room.write("in/left/a.cut", square(600).as_bytes());
    room.write("in/left/b.plt", b"IN;SP1;PU0,0;PD4000,0,4000,4000,0,4000,0,0;PU;SP0;");
    room.write("in/right/bad.cut", b"no cutter file at all\n");
    room.write("in/right/z.CUT", square(700).as_bytes());
    room
}

/// The lines of a manifest.
fn lines(room: &Room, name: &str) -> Vec<Value> {
    room.text(name).lines().map(|line| serde_json::from_str(line).expect("a line is JSON")).collect()
}

/// What the lines of a manifest say under a key.
fn all<'l>(lines: &'l [Value], key: &str) -> Vec<&'l str> {
    lines.iter().map(|line| line[key].as_str().unwrap_or("null")).collect()
}

#[test]
fn a_folder_is_compiled_in_its_structure_and_one_bad_file_stops_none() {
    let room = room();
    let said = room.says("compile in -o out -t gcode,csv", FAULTY);
    for name in ["a", "left/a", "left/b", "right/z"] {
        for end in ["ngc", "csv", "ngc.meta.json", "csv.meta.json"] {
            assert!(room.has(&format!("out/{name}.{end}")), "{name}.{end}\n{said}");
        }
    }
    assert!(!room.has("out/right/bad.csv") && said.contains("5 files, 4 done, 1 failed"), "{said}");
    let rows: Vec<&str> = said.lines().filter(|line| line.starts_with("  in/")).collect();
    assert_eq!(rows.len(), 5, "{said}");
    assert!(rows[0].starts_with("  in/a.cut               1    0.2  0:"), "{said}");
    assert!(rows[4].contains("in/right/bad.cut") && rows[4].contains("FAILED source/unknown-format"), "{said}");
    let lines = lines(&room, "out/cutc.jsonl");
    assert_eq!(all(&lines, "source"), ["a.cut", "left/a.cut", "left/b.plt", "right/bad.cut", "right/z.CUT"]);
    assert_eq!(all(&lines, "verdict"), ["verified", "verified", "verified", "refused", "verified"]);
    assert_eq!(lines[1]["outputs"][0]["path"], "left/a.ngc");
    assert_eq!(lines[1]["outputs"][1]["path"], "left/a.csv");
    // As one by one.
    fs::create_dir_all(room.at("single/left")).expect("writable");
    room.expect("compile in/left/a.cut -o single/left/a.csv", DONE);
    for name in ["left/a.csv", "left/a.csv.meta.json"] {
        assert_eq!(room.read(&format!("single/{name}")), room.read(&format!("out/{name}")), "{name}");
    }
    // With --quiet only what failed is told.
    let said = room.says("compile in -o quiet --quiet", FAULTY);
    assert!(!said.contains("in/a.cut") && said.contains("FAILED") && !said.contains("wrote"), "{said}");
}

#[test]
fn patterns_and_files_choose_what_is_compiled() {
    let room = room();
    room.expect("compile in/**/*.{cut,CUT} -o cut -q", FAULTY);
    let sources = ["a.cut", "left/a.cut", "right/bad.cut", "right/z.CUT"];
    assert_eq!(all(&lines(&room, "cut/cutc.jsonl"), "source"), sources);
    room.expect("compile in/left/* -o out", DONE);
    assert_eq!(all(&lines(&room, "out/cutc.jsonl"), "source"), ["a.cut", "b.plt"]);
    room.expect("compile in/a.cut circle.cut", DONE);
    assert!(room.has("a.csv") && room.has("circle.csv") && room.has("cutc.jsonl"));
    room.expect("compile nowhere in/a.cut -o some", FAULTY);
    assert!(room.has("some/a.csv"));
}

#[test]
fn programs_that_would_collide_are_refused_before_anything_runs() {
    let room = room();
    room.write("in/left/a.plt", b"IN;");
    let said = room.says("compile in -o out", USAGE);
    assert!(said.contains("`out/left/a.csv` would be written for `in/left/a.cut` and `in/left/a.plt`"), "{said}");
    assert!(said.contains("= hint:") && !room.has("out"), "{said}");
    // A program of an earlier run is no input, but a file of its name is.
    fs::remove_file(room.at("in/left/a.plt")).expect("removable");
    room.write("in/a.csv", b"x_mm,y_mm\n0,0\n50,0\n50,50\n0,0\n");
    let said = room.says("compile in -o in", USAGE);
    assert!(said.contains("`in/a.csv` is an input"), "{said}");
    fs::remove_file(room.at("in/a.csv")).expect("removable");
    room.expect("compile in -o in", FAULTY);
    assert!(room.says("compile in -o in", FAULTY).contains("5 files"), "programs are no inputs");
    for (arguments, why) in [
        ("compile in -o x.csv", "one place for many"),
        ("compile in -o -", "one place for many"),
        ("compile in --dump-after weld", "looks into one file"),
        ("compile in --shard 3/2", "as in 3/16"),
    ] {
        let said = room.says(arguments, USAGE);
        assert!(said.contains(why), "{arguments}: {said}");
    }
}

#[test]
fn a_program_that_was_made_from_another_file_is_not_overwritten() {
    let room = room();
    room.expect("compile in/left/b.plt -o out/", DONE);
    fs::rename(room.at("in/left/b.plt"), room.at("in/left/b.hpgl")).expect("movable");
    let before = room.read("out/b.csv");
    room.write("in/left/b.cut", square(800).as_bytes());
    let said = room.says("compile in/left/b.cut -o out/", USAGE);
    assert!(said.contains("`out/b.csv` was made from `b.plt`, not from `b.cut`"), "{said}");
    fs::create_dir(room.at("other")).expect("writable");
    fs::rename(room.at("in/left/b.cut"), room.at("other/b.cut")).expect("movable");
    let said = room.says("compile other in/a.cut -o out", FAULTY);
    assert!(said.contains("2 files, 1 done, 1 failed") && said.contains("say --force"), "{said}");
    assert_eq!(room.read("out/b.csv"), before);
    room.expect("compile other -o out --force", DONE);
    assert_ne!(room.read("out/b.csv"), before);
}

#[test]
fn only_what_was_changed_is_compiled() {
    let room = room();
    fs::remove_file(room.at("in/right/bad.cut")).expect("removable");
    let run = |options: &str, expected: &str| {
        let said = room.says(&format!("compile in -o out --changed {options}"), DONE);
        assert!(said.contains(expected), "{options}: {said}");
    };
    run("", "4 files, 4 done");
    let manifest = room.read("out/cutc.jsonl");
    run("", "4 files, 4 unchanged");
    assert_eq!(room.read("out/cutc.jsonl"), manifest);
    room.write("in/a.cut", square(510).as_bytes());
    run("", "4 files, 1 done, 3 unchanged");
    // Edited by hand or gone a program does not stand; without its provenance it is not ours to replace.
    room.write("out/left/a.csv", b"t_s\n");
    fs::remove_file(room.at("out/left/b.csv")).expect("removable");
    fs::remove_file(room.at("out/right/z.csv.meta.json")).expect("removable");
    let said = room.says("compile in -o out --changed", FAULTY);
    assert!(said.contains("4 files, 2 done, 1 unchanged, 1 failed") && said.contains("--force"), "{said}");
    fs::remove_file(room.at("out/right/z.csv")).expect("removable");
    run("", "4 files, 1 done, 3 unchanged");
    run("--set knife.width_mm=7", "4 files, 4 done");
    run("--set knife.width_mm=7 --dry-run", "4 files, 4 done");
    run("--set knife.width_mm=7 --dry-run --no-verify", "4 files, 4 done");
    run("--set knife.width_mm=7 --dry-run --no-verify", "4 files, 4 unchanged");
    // Another target stands beside it.
    run("-t gcode", "4 files, 4 done");
    assert_eq!(lines(&room, "out/cutc.jsonl").len(), 8);
    // What is left of a line, or was never one, tells nothing.
    let mut torn = room.read("out/cutc.jsonl");
    torn.truncate(torn.len() - 20);
    torn.splice(0..0, *b"no line of ours\n");
    room.write("out/cutc.jsonl", &torn);
    run("-t gcode", "4 files, 1 done, 3 unchanged");
}

#[test]
fn the_bytes_do_not_depend_on_how_many_work() {
    let room = room();
    for jobs in [1, 2, 5] {
        room.expect(&format!("compile in -o out{jobs} -j {jobs} -t csv,svg"), FAULTY);
    }
    for name in ["cutc.jsonl", "a.csv", "left/b.svg", "right/z.csv"] {
        for jobs in [2, 5] {
            assert_eq!(room.read(&format!("out1/{name}")), room.read(&format!("out{jobs}/{name}")), "{name}");
        }
    }
}

#[test]
fn the_parts_of_several_machines_join_to_what_one_makes() {
    let room = room();
    room.expect("compile in -o whole", FAULTY);
    let done: usize = (1..=3)
        .map(|part| {
            let output = room.run(&format!("compile in -o parts --shard {part}/3"));
            assert!(room.has(&format!("parts/cutc.{part}-of-3.jsonl")), "{output:?}");
            lines(&room, &format!("parts/cutc.{part}-of-3.jsonl")).len()
        })
        .sum();
    assert_eq!(done, 5);
    let said = room.says("compile in -o parts --changed", FAULTY);
    assert!(said.contains("4 unchanged, 1 failed"), "{said}");
    assert_eq!(room.read("parts/cutc.jsonl"), room.read("whole/cutc.jsonl"));
    assert!(!room.has("parts/cutc.1-of-3.jsonl"), "its lines are joined");
    for name in ["a.csv", "left/a.csv", "left/b.csv", "right/z.csv", "left/b.csv.meta.json"] {
        assert_eq!(room.read(&format!("parts/{name}")), room.read(&format!("whole/{name}")), "{name}");
    }
}

#[test]
fn figures_of_many_files_come_as_a_list() {
    let room = room();
    let (stdout, _) = room.expect("compile in -o out --format json", FAULTY);
    let list: Vec<Value> = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(all(&list, "file")[..2], ["in/a.cut", "in/left/a.cut"]);
    assert_eq!(list.len(), 5);
    assert_eq!((&list[0]["pieces"], &list[3]["errors"][0]["code"]), (&1.into(), &"source/unknown-format".into()));
}

/// Names in a folder of the room that begin like drafts.
fn drafts(room: &Room, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(room.at(folder)).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with(".cutc-")).collect()
}

/// A marker that takes long enough to be stopped amid it.
fn long() -> String {
    let piece = |piece: usize| {
        let (x, y) = (piece / 20 * 800, piece % 20 * 800);
        let outline = [(700, 0), (750, 300), (700, 650), (350, 700), (30, 680), (0, 350), (0, 0)];
        let points = outline.map(|(i, j)| format!("X{}Y{}*", x + i, y + j)).concat();
        format!("N{}*X{x}Y{y}*M14*{points}M15*", piece + 1)
    };
    let pieces: Vec<String> = (0..400).map(piece).collect();
    format!("H1*G71*{}M0*", pieces.concat())
}

/// Begins a run and waits until it has something in the making.
fn begun(room: &Room, arguments: &str, folder: &str) -> Child {
    let mut command = room.command(arguments);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts");
    while drafts(room, folder).is_empty() {
        assert!(child.try_wait().expect("known").is_none(), "it ends before it has begun a program");
        thread::sleep(Duration::from_millis(1));
    }
    child
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
    assert!(sent.expect("kill starts").success());
}

#[cfg(unix)]
#[test]
fn who_is_stopped_leaves_nothing_half_made_and_a_true_manifest() {
    let room = room();
    room.write("in/long.cut", long().as_bytes());
    for (name, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let mut single = begun(&room, "compile in/long.cut -o alone/", "alone");
        signal(&single, name);
        assert_eq!(single.wait().expect("it ends").code(), Some(code));
        assert!(!room.has("alone"), "the directory was made for the program, and goes with it");
        fs::create_dir_all(room.at("out")).expect("writable");
        let mut batch = begun(&room, "compile in -o out -j 1", "out");
        while !room.has("out/left/b.csv") || drafts(&room, "out").is_empty() {
            assert!(batch.try_wait().expect("known").is_none(), "there is time to stop it");
            thread::sleep(Duration::from_millis(1));
        }
        signal(&batch, name);
        assert_eq!(batch.wait().expect("it ends").code(), Some(code));
        assert!(drafts(&room, "out").is_empty());
        for line in room.text("out/cutc.jsonl").lines() {
            let line: Value = serde_json::from_str(line).expect("a whole line");
            for output in line["outputs"].as_array().expect("a list") {
                assert!(room.has(&format!("out/{}", output["path"].as_str().expect("a path"))));
            }
        }
    }
    // What its parent had it ignore it ignores.
    let nohup = format!("trap '' HUP; exec {} compile in/long.cut -o kept.csv -q", env!("CARGO_BIN_EXE_cutc"));
    let mut command = Command::new("sh");
    let folder = room.at("in").parent().expect("the room").to_owned();
    let mut child = command.args(["-c", &nohup]).current_dir(folder).spawn().expect("sh starts");
    while drafts(&room, ".").is_empty() {
        assert!(child.try_wait().expect("known").is_none());
        thread::sleep(Duration::from_millis(1));
    }
    signal(&child, "HUP");
    assert_eq!(child.wait().expect("it ends").code(), Some(DONE));
}

#[cfg(unix)]
#[test]
fn what_a_killed_run_left_the_next_one_removes() {
    let room = room();
    room.write("in/long.cut", long().as_bytes());
    fs::create_dir(room.at("out")).expect("writable");
    let mut killed = begun(&room, "compile in/long.cut -o out/", "out");
    signal(&killed, "KILL");
    killed.wait().expect("it ends");
    let left = drafts(&room, "out");
    assert!(!left.is_empty());
    assert!(left.iter().all(|name| name.contains(&format!("-{}-", killed.id()))), "{left:?}");
    // That of a run that goes on stays.
    let mut other = begun(&room, "compile in/long.cut -o out/other.csv", "out");
    room.expect("compile in/a.cut -o out/", DONE);
    let names = drafts(&room, "out");
    assert!(names.iter().all(|name| name.contains(&format!("-{}-", other.id()))), "{names:?}");
    assert_eq!(other.wait().expect("it ends").code(), Some(DONE));
    assert!(room.has("out/other.csv") && drafts(&room, "out").is_empty());
}

#[cfg(unix)]
#[test]
fn what_a_full_disk_refused_is_named_and_compiled_later() {
    let room = room();
    fs::remove_file(room.at("in/right/bad.cut")).expect("removable");
    room.write("in/long.cut", long().as_bytes());
    // No file may have more than so many blocks of 512 bytes, as if the disk had no more.
    let script = format!("trap '' XFSZ; ulimit -f 2000; {} compile in -o out", env!("CARGO_BIN_EXE_cutc"));
    let folder = room.at("in").parent().expect("the room").to_owned();
    let output = Command::new("sh").args(["-c", &script]).current_dir(&folder).output().expect("sh starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(FAULTY), "{said}");
    assert!(said.contains("5 files, 4 done, 1 failed"), "{said}");
    assert!(said.contains("FAILED cannot write `out/long.csv`"), "{said}");
    assert!(drafts(&room, "out").is_empty() && !room.has("out/long.csv"));
    let said = room.says("compile in -o out --changed", DONE);
    assert!(said.contains("5 files, 1 done, 4 unchanged"), "{said}");
    assert!(room.has("out/long.csv") && room.has("out/cutc.jsonl"));
}
