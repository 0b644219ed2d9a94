//! What is chosen for one run: some pieces, the knife up, the frame alone; and what the program says of itself.

use std::fs;
use std::process::Command;

use tempfile::TempDir;

/// Three squares numbered 3, 5 and 9 in the order 5, 3, 9, each with a drill beside it.
const MARKER: &str = "H1*G71*N5*X0Y0*M14*X500*Y500*X0*Y0*M15*X400Y100M43*\
    N3*X1000Y0*M14*X1500*Y500*X1000*Y0*M15*X1400Y100M43*N9*X2000Y0*M14*X2500*Y500*X2000*Y0*M15*M0*";

/// A folder with the marker in it.
fn room() -> TempDir {
    let room = tempfile::tempdir().expect("a directory");
    fs::write(room.path().join("m.cut"), MARKER).expect("writable");
    room
}

/// Runs and expects an exit code; gives standard output and standard error together.
fn run(room: &TempDir, arguments: &str, code: i32) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let output = command.current_dir(room.path()).args(arguments.split_whitespace()).output().expect("it starts");
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "cutc {arguments}\n{said}");
    said.into_owned()
}

/// The rows of a program, split at the commas.
fn rows(room: &TempDir, name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(room.path().join(name)).expect("a program");
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn figure(room: &TempDir, choice: &str, key: &str) -> f64 {
    let said = run(room, &format!("compile m.cut -o f.csv --format json {choice}"), 0);
    let value: serde_json::Value =
        serde_json::from_str(said.split_inclusive("\n}\n").next().unwrap_or_default()).expect("JSON");
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {said}"))
}

#[test]
fn pieces_are_chosen_by_their_numbers_and_cut_in_the_order_of_the_file() {
    let room = room();
    for (choice, pieces, drills) in [
        ("", 3.0, 2.0),
        ("--pieces 3,9", 2.0, 1.0),
        ("--pieces 3-9", 3.0, 2.0),
        ("--skip 3", 2.0, 1.0),
        ("--pieces 3-5 --skip 3", 1.0, 1.0),
        ("--resume-from 3", 2.0, 1.0),
        ("--resume-from 3 --skip 3", 1.0, 0.0),
    ] {
        assert_eq!(figure(&room, choice, "pieces"), pieces, "{choice}");
        assert_eq!(figure(&room, choice, "drills"), drills, "{choice}");
    }
    let dump = run(&room, "compile m.cut --pieces 3,5 --dump-after select", 0);
    let numbers: Vec<&str> = dump
        .lines()
        .filter_map(|line| line.strip_prefix("piece "))
        .map(|line| line.split(' ').next().unwrap_or(line))
        .collect();
    assert_eq!(numbers, ["5", "3"]);
}

#[test]
fn a_chosen_piece_keeps_every_segment() {
    let room = room();
    let piece = |text: &str| -> Vec<String> {
        let lines = text.lines().skip_while(|line| !format!("{line} ").starts_with("piece 3 ")).skip(1);
        lines.take_while(|line| !line.starts_with("piece")).map(str::to_owned).collect()
    };
    let whole = piece(&run(&room, "compile m.cut --dump-after inspect", 0));
    let chosen = piece(&run(&room, "compile m.cut --pieces 3 --dump-after select", 0));
    assert!(whole.len() > 4 && whole == chosen, "{whole:?}\n{chosen:?}");
}

#[test]
fn a_number_that_no_piece_has_is_an_error_that_names_those_that_there_are() {
    let room = room();
    for choice in ["--pieces 4", "--skip 3-10", "--resume-from 57"] {
        let said = run(&room, &format!("compile m.cut {choice}"), 1);
        let flag = choice.split(' ').next().unwrap_or_default();
        assert!(said.contains("select/unknown-piece") && said.contains(flag), "{said}");
        assert!(said.contains("3 numbers between 3 and 9"), "{said}");
    }
    let said = run(&room, "compile m.cut --pieces 3 --skip 3", 1);
    assert!(said.contains("select/nothing-left") && said.contains("none of the 3 pieces"), "{said}");
    for choice in ["--pieces x", "--skip 9-3", "--pieces 3,", "--resume-from -1", "--dry-run --frame"] {
        run(&room, &format!("compile m.cut {choice}"), 2);
    }
    assert!(!room.path().join("m.csv").exists());
}

#[test]
fn info_and_check_leave_pieces_out_too() {
    let room = room();
    let json = |choice: &str| run(&room, &format!("info m.cut --format json {choice}"), 0);
    assert!(json("").contains("\"pieces\": 3") && json("--skip 3").contains("\"pieces\": 2"));
    run(&room, "check m.cut --skip 3", 0);
    for command in ["info", "check"] {
        let said = run(&room, &format!("{command} m.cut --skip 4"), 1);
        assert!(said.contains("select/unknown-piece"), "{said}");
    }
}

#[test]
fn a_program_of_some_pieces_is_proven_against_those_and_the_reader_against_the_whole_file() {
    let room = room();
    let said = run(&room, "compile m.cut --skip 5", 0);
    assert!(said.contains("selected   --skip 5") && said.contains("verified"), "{said}");
    let said = run(&room, "verify m.csv --source m.cut --skip 5", 0);
    assert!(said.contains("PASS") && said.contains("source/points") && !said.contains("warning"), "{said}");
    let said = run(&room, "verify m.csv --source m.cut", 1);
    assert!(said.contains("verify/complete") && said.contains("other options"), "{said}");
    assert!(said.contains("with --skip 5"), "{said}");
}

#[test]
fn a_dry_run_is_the_same_motion_with_everything_up() {
    let room = room();
    run(&room, "compile m.cut -o cut.csv", 0);
    let said = run(&room, "compile m.cut -o dry.csv --dry-run", 0);
    assert!(said.contains("--dry-run was given") && said.contains("verified"), "{said}");
    assert!(!said.contains("limited by"), "nothing is cut, so nothing keeps it from being faster: {said}");
    let said = run(&room, "compile m.cut -o dry.csv --dry-run --format json", 0);
    assert!(said.contains(r#""cut_s": 0.0"#) && said.contains(r#""cut_bound_by": {}"#), "{said}");
    let (cut, dry) = (rows(&room, "cut.csv"), rows(&room, "dry.csv"));
    assert_eq!(cut.len(), dry.len());
    assert!(cut.iter().zip(&dry).all(|(cut, dry)| cut[..4] == dry[..4]));
    assert!(dry.iter().all(|row| row[4] == "0" && row[5] == "0" && row[7] == "0"));
    let meta = fs::read_to_string(room.path().join("dry.csv.meta.json")).expect("provenance");
    assert!(meta.contains("\"options\": \"--dry-run\""), "{meta}");
    let meta = fs::read_to_string(room.path().join("cut.csv.meta.json")).expect("provenance");
    assert!(!meta.contains("options"), "{meta}");
}

#[test]
fn a_knife_that_goes_down_in_a_dry_run_is_seen() {
    let room = room();
    run(&room, "compile m.cut -o cut.csv", 0);
    run(&room, "compile m.cut -o dry.csv --dry-run", 0);
    let said = run(&room, "verify dry.csv --source m.cut --dry-run", 0);
    assert!(said.contains("works on nothing") && !said.contains("verify/complete"), "{said}");
    let said = run(&room, "verify cut.csv --source m.cut --dry-run", 1);
    assert!(said.contains("FAIL  verify/stray") && said.contains("FAIL  verify/drills"), "{said}");
    // And one that stays up where it should cut.
    let said = run(&room, "verify dry.csv --source m.cut", 1);
    assert!(said.contains("FAIL  verify/complete"), "{said}");
}

#[test]
fn the_frame_leads_once_around_the_box_and_back_home() {
    let room = room();
    let said = run(&room, "compile m.cut --frame --pieces 3 --set home=[10,20,30]", 0);
    assert!(said.contains("--frame was given") && said.contains("verified"), "{said}");
    assert!(!said.contains("limited by"), "{said}");
    let rows = rows(&room, "m.csv");
    let number = |row: &[String], column: usize| row[column].parse::<f64>().expect("a number");
    let reach = |column: usize| {
        let values = || rows.iter().map(|row| number(row, column));
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    // Piece 3 lies from 100 to 150 mm; home is left of it.
    assert_eq!((reach(1), reach(2)), ([10.0, 150.0], [0.0, 50.0]));
    assert!(rows.iter().all(|row| row[3] == "30.000000" && row[4] == "0" && row[5] == "0"));
    for corner in [[100.0, 0.0], [150.0, 0.0], [150.0, 50.0], [100.0, 50.0]] {
        assert!(rows.iter().any(|row| [number(row, 1), number(row, 2)] == corner), "{corner:?}");
    }
    let last = rows.last().expect("a row");
    assert_eq!([number(last, 1), number(last, 2)], [10.0, 20.0]);
    let said = run(&room, "compile m.cut --frame --set table.x_mm=[0,120]", 1);
    assert!(said.contains("marker/off-table") && said.contains("does not fit"), "{said}");
}

#[test]
fn explanations_and_completions_are_printed() {
    let room = room();
    for code in ["iso/open-slit", "select/unknown-piece", "verify/on-path", "source/points"] {
        let said = run(&room, &format!("explain {code}"), 0);
        assert!(said.starts_with(code) && said.lines().count() > 5, "{said}");
        assert!(run(&room, "explain", 0).contains(code));
    }
    assert!(run(&room, "explain iso/open-slot", 2).contains("did you mean `iso/open-slit`?"));
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(run(&room, &format!("completions {shell}"), 0).contains("resume-from"), "{shell}");
    }
}

#[test]
fn lines_of_a_plot_are_chosen_by_pen_and_kind_and_the_program_says_so() {
    let room = room();
    let plot = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/hpgl/two-pens.plt");
    fs::copy(plot, room.path().join("p.plt")).expect("a copy");
    let said = run(&room, "info p.plt", 0);
    for line in [
        "part                  2        670.000",
        "inner line            1         70.000  not cut",
        "pen down                       740.000",
    ] {
        assert!(said.contains(line), "{line} in {said}");
    }
    let check = |choice: &str, code: i32, classes: &[(&str, u64, bool)]| {
        let said = run(&room, &format!("info p.plt --format json {choice}"), code);
        let text = said.split_inclusive("\n}\n").next().unwrap_or_default();
        let value: serde_json::Value = serde_json::from_str(text).expect("JSON");
        assert_eq!(value["pen_down_mm"].as_f64(), Some(740.0), "{choice}");
        let lines = value["lines"].as_array().expect("classes");
        let found: Vec<(&str, u64, bool)> = lines
            .iter()
            .map(|line| (line["class"].as_str(), line["count"].as_u64(), line["cut"].as_bool()))
            .map(|(class, count, cut)| (class.expect("a name"), count.expect("a count"), cut.expect("a flag")))
            .collect();
        assert_eq!(found, classes, "{choice}");
    };
    check("", 0, &[("part", 2, true), ("inner line", 1, false)]);
    check("--inner cut", 0, &[("part", 2, true), ("inner line", 1, true)]);
    check("--cut-pens 2", 0, &[("part", 2, false), ("inner line", 1, true)]);
    check("--cut-pens 1 --cut-all", 0, &[("part", 2, true), ("inner line", 1, false)]);
    let said = run(&room, "compile p.plt -o p.csv --cut-pens 2", 0);
    assert!(said.contains("--cut-pens 2"), "{said}");
    run(&room, "verify p.csv --source p.plt --cut-pens 2", 0);
    run(&room, "verify p.csv --source p.plt", 1);
    let said = run(&room, "info m.cut --cut-pens x", 2);
    assert!(said.contains("--cut-pens") && !said.contains("piece"), "{said}");
    for pens in ["0", "0-3"] {
        let said = run(&room, &format!("info p.plt --cut-pens {pens}"), 2);
        assert!(said.contains("pen 0 stands for none"), "{said}");
    }
    let said = run(&room, "info p.plt --set hpgl.pens.0=knife", 2);
    assert!(said.contains("profile/unknown-key") && said.contains("pen 0 is none"), "{said}");
    for choice in ["--inner cut", "--cut-all", "--cut-pens 1"] {
        assert!(run(&room, &format!("info m.cut {choice}"), 0).contains("source/no-plot"), "{choice}");
    }
    assert!(!run(&room, "info m.cut", 0).contains("source/no-plot"));
    for choice in ["--size M", "--quantity one"] {
        assert!(run(&room, &format!("info m.cut {choice}"), 0).contains("source/no-patterns"), "{choice}");
    }
}

#[test]
fn figures_of_a_plot_count_its_texts_beside_the_parts_and_have_no_negative_zeros() {
    let room = room();
    for name in ["labels.plt", "spikes-in-an-outline.plt"] {
        let plot = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/hpgl").join(name);
        fs::copy(plot, room.path().join(name)).expect("a copy");
    }
    assert!(run(&room, "info labels.plt", 0).contains("texts beside          1"));
    let said = run(&room, "info spikes-in-an-outline.plt --format json", 0);
    assert!(said.contains("\"slit\": 2") && !said.contains("-0.0"), "{said}");
}
