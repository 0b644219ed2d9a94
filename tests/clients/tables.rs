//! Tables of controllers that somebody writes: the interpreter of LinuxCNC takes every program of a table that is legal.

use std::path::Path;
use std::process::Command;

use crate::{interpret, is_there};

/// Values of keys, `gcode.` left out.
type Table = &'static [(&'static str, &'static str)];

/// Tables that are legal: knives and drills of all kinds, heads, ends, waits.
const LEGAL: &[Table] = &[
    &[],
    &[("knife_down", "M3"), ("knife_up", "M5")],
    &[("knife_down", "M3 S1000"), ("knife_up", "M5"), ("footer", "M9\nM30")],
    &[("knife_down", "m03 s90"), ("knife_up", "m3 s10"), ("header", "M3 S10"), ("footer", "M5\nM2")],
    &[("knife_down", "M7"), ("knife_up", "M9")],
    &[("knife_down", "M64 P63"), ("knife_up", "M65 P63")],
    &[("knife_down", "M65 P0"), ("knife_up", "M64 P0")],
    &[("knife_down", "M64P0"), ("knife_up", "m65 P0.0")],
    &[("knife_down", "M64 P5\nM65 P6"), ("knife_up", "M64 P6\nM65 P5")],
    &[("knife_down", "M64 P5\nG4 P0.05\nM65 P5"), ("knife_up", "M64 P6\nG4 P0.05\nM65 P6")],
    &[("knife_down", "M64 P5\nM66 P0 L3 Q2"), ("knife_up", "M65 P5\nM66 P0 L4 Q2")],
    &[("knife_down", "M68 E0 Q5"), ("knife_up", "M68 E0 Q-5")],
    &[("knife_down", "M3\nM8\nM64 P0"), ("knife_up", "M5\nM9\nM65 P0")],
    &[("knife_down", "G0 Z-2"), ("knife_up", "G0 Z5")],
    &[("knife_down", "G1 Z-2 F300"), ("knife_up", "G0 Z5")],
    &[("knife_down", "G1 Z-2 F0.5"), ("knife_up", "G1 Z5 F20000")],
    &[("knife_down", "G01z-2.0f300."), ("knife_up", "g00Z+05")],
    &[("knife_down", "G1 F300 Z-2"), ("knife_up", "G0 Z5")],
    &[("knife_down", "G0 Z0\nG1 Z-2 F300"), ("knife_up", "G0 Z5"), ("footer", "M9\nM2")],
    &[("knife_down", "G1 Z-2 F300\nM64 P0"), ("knife_up", "G0 Z5\nM65 P0")],
    &[("letter", "A"), ("knife_down", "M8"), ("knife_up", "M9")],
    &[
        ("letter", "B"),
        ("knife_down", "G1 Z-1 F50"),
        ("knife_up", "G0 Z1"),
        ("drill_down", "M3 S#"),
        ("drill_up", "M5"),
    ],
    &[("wrapped", "true"), ("knife_down", "G1 Z-1 F50"), ("knife_up", "G0 Z1")],
    &[("arcs", "false"), ("knife_down", "G1 Z-1 F50"), ("knife_up", "G0 Z1"), ("line_numbers", "true")],
    &[("blend_mm", "off"), ("drill_down", "M64 P#\nG1 Z-1 F50"), ("drill_up", "M65 P#\nG0 Z1")],
    &[("blend_mm", "0.001"), ("decimals", "6")],
    &[("drill_down", "M64 P#"), ("drill_up", "M65 P1\nM65 P2\nM65 P3\nM65 P4")],
    &[("drill_down", "M3 S#\nG1 Z-5 F200"), ("drill_up", "G0 Z5\nM5")],
    &[("header", "G17 G21 G40 G49 G80 G90 G91.1 G54")],
    &[("header", "G59.3\nM49\nM8\nM3 S500"), ("footer", "M5\nM9\nM48\nM30")],
    &[("header", "T1 M6\nG92.1"), ("footer", "M2")],
    &[("header", "(a) (b) ; c\n\nM0 (wait)"), ("footer", "(the end)\nM2 (so)")],
    &[("header", "(MSG, load)\nG4 P0.5"), ("footer", "G80 G90\nM30")],
    &[("stop", "M1"), ("advance", "M0")],
    &[("stop", "M60"), ("advance", "M64 P5\nG4 P0.5\nM65 P5\nM66 P0 L3 Q30")],
    &[("stop", "M65 P9\nM1"), ("advance", "G0 Z100 \n M1")],
];

/// Tables that are refused, each for one value.
const REFUSED: &[(&str, &str)] = &[
    ("knife_down", "G1 Z-2"),
    ("knife_down", "G1 Z-2 F0"),
    ("knife_down", "Z-2"),
    ("knife_down", "G53"),
    ("knife_down", "G33"),
    ("knife_down", "G33 Z-2 K1"),
    ("knife_down", "M428"),
    ("knife_down", "M101"),
    ("knife_down", "M64"),
    ("knife_down", "M64\nP0"),
    ("knife_down", "M64 P0 P1"),
    ("knife_down", "M64 P0 M65"),
    ("knife_down", "M64 P0 G4 P1"),
    ("knife_down", "M68 Q5"),
    ("knife_down", "M3 M4"),
    ("knife_down", "M3 M7 M48 M64 P0 M0"),
    ("knife_down", "M3 S-1"),
    ("knife_down", "M3 S1e3"),
    ("knife_down", "M3.5"),
    ("knife_down", "M3 (a (b)"),
    ("knife_down", "M3 (a"),
    ("knife_down", "M3 a)"),
    ("knife_down", "M(a)3"),
    ("knife_down", "M3 Q1"),
    ("knife_down", "M3 D1"),
    ("knife_down", "G0 U1"),
    ("knife_down", "G4 P-1"),
    ("knife_down", "$H"),
    ("header", "T-1"),
    ("header", "T1.5"),
    ("header", "G59.4"),
    ("header", "G50"),
    ("header", "G54 G55"),
    ("header", "G43 H99"),
    ("header", "M98 P7"),
    ("header", "O100 CALL"),
    ("header", "M72"),
    ("header", "M66 P0 L3"),
    ("footer", "%"),
    ("footer", "M5"),
    ("footer", "G80 Z1\nM2"),
];

/// Values that the interpreter takes, and that are refused all the same: they undo what the program says, or do nothing.
const HARMFUL: &[(&str, &str)] = &[
    ("knife_down", "#5221=1"),
    ("knife_down", "G0 Z[1-3]"),
    ("knife_down", "G4 P0.01"),
    ("knife_down", "M0"),
    ("knife_down", "G55\nM3"),
    ("knife_down", "G0 C0"),
    ("knife_down", "M62 P0"),
    ("knife_down", "/M3"),
    ("knife_down", "G38.2 Z-2 F10"),
    ("knife_down", "G81 Z-2 R1 F9"),
    ("header", "G91"),
    ("header", "G92 X1"),
    ("header", "F100"),
    ("header", "M2"),
    ("header", "G0 Z5"),
    ("footer", "M2\nM5"),
    ("footer", "G0 X0 Y0\nM2"),
    ("footer", "G28\nM30"),
    ("footer", "M65 P0\nM2"),
    ("stop", "M0 (PROBEOPEN)"),
    ("stop", "M1"),
];

/// Keys that are lists of steps; a table has each step on a line.
const STEPS: [&str; 6] = ["knife_down", "knife_up", "drill_down", "drill_up", "stop", "advance"];

/// The arguments that set keys of the target.
fn arguments(table: &[(&str, &str)]) -> Vec<String> {
    let set = |(key, value): &(&str, &str)| {
        let value = if STEPS.contains(key) { format!("[{}]", value.replace('\n', ", ")) } else { (*value).to_owned() };
        ["--set".to_owned(), format!("gcode.{key}={value}")]
    };
    table.iter().flat_map(set).collect()
}

#[test]
fn the_interpreter_of_linuxcnc_takes_the_programs_of_every_table_that_is_legal() {
    let is_there = is_there("rs274", Command::new("sh").args(["-c", "command -v rs274"]));
    let folder = tempfile::tempdir().expect("a directory");
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    for mode in ["G94", "G93"] {
        for table in LEGAL {
            for file in ["markers/drills-and-slits.cut", "iso/speeds-and-events.cut"] {
                let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
                compile.args(["compile", "--force", "-t", "gcode", "-o", "program.ngc"]).arg(fixtures.join(file));
                compile.args(arguments(table)).args(arguments(&[("feed_mode", mode)])).current_dir(folder.path());
                let compiled = compile.output().expect("the program starts");
                let said = String::from_utf8_lossy(&compiled.stderr).into_owned();
                // In inverse time F is no speed of Z.
                let has_feed = |(key, lines): &(&str, &str)| STEPS.contains(key) && lines.contains(['F', 'f']);
                if mode == "G93" && table.iter().any(has_feed) {
                    assert!(!compiled.status.success() && said.contains("profile/range"), "{table:?}: {file}: {said}");
                    continue;
                }
                assert!(compiled.status.success(), "{mode}: {table:?}: {file}: {said}");
                if !is_there {
                    continue;
                }
                match interpret("program.ngc", folder.path()) {
                    Ok(canon) => check_plunges(&canon, table),
                    Err(why) => panic!("{mode}: {table:?}: {file}: {why}"),
                }
            }
        }
    }
}

/// A knife at Z is down on every cut.
fn check_plunges(canon: &str, table: Table) {
    let is_down = |(key, line): &&(&str, &str)| *key == "knife_down" && *line == "G1 Z-2 F300";
    if !table.iter().any(|pair| is_down(&pair)) {
        return;
    }
    let cuts = canon.lines().filter_map(|line| line.split_once("STRAIGHT_FEED(")?.1.split(", ").nth(2)?.parse().ok());
    let depths: Vec<f64> = cuts.collect();
    assert!(depths.len() > 10 && depths.iter().all(|&z| z == -2.0), "{table:?}: {depths:?}");
}

#[test]
fn a_table_that_the_interpreter_of_linuxcnc_refuses_is_no_profile() {
    let is_there = is_there("rs274", Command::new("sh").args(["-c", "command -v rs274"]));
    let folder = tempfile::tempdir().expect("a directory");
    let all = REFUSED.iter().map(|pair| (pair, false)).chain(HARMFUL.iter().map(|pair| (pair, true)));
    let mut otherwise = Vec::new();
    for (&(key, value), is_harm) in all {
        let mut check = Command::new(env!("CARGO_BIN_EXE_cutc"));
        let said =
            check.args(["profile", "show"]).args(arguments(&[(key, value)])).output().expect("the program starts");
        let text = String::from_utf8_lossy(&said.stderr).into_owned();
        let is_told =
            text.contains("profile/range") && text.contains(&format!("`gcode.{key}`")) && text.contains("hint");
        assert!(!said.status.success() && is_told, "{key}: {value}: {text}");
        if !is_there {
            continue;
        }
        let (head, go) = ("G17 G21 G40 G80 G90 G91.1\nG64 P0.05 Q0\nG94", "G0 X1 Y1 C0");
        let is_end = key == "footer";
        let program = if is_end { format!("{head}\n{go}\n{value}\n") } else { format!("{head}\n{value}\n{go}\nM2\n") };
        std::fs::write(folder.path().join("table.ngc"), program).expect("writable");
        otherwise.extend(Some((key, value)).filter(|_| interpret("table.ngc", folder.path()).is_ok() != is_harm));
    }
    assert_eq!(otherwise, [], "the interpreter says otherwise");
}
