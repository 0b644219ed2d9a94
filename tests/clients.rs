//! Programs of others open what is written here. One that is not installed is named on standard error and left out;
//! with `CUTC_REQUIRE_CLIENTS=1` that is a failure.

use std::path::Path;
use std::process::{Command, Output};

/// Whether the client is there; says so when not.
fn is_there(name: &str, probe: &mut Command) -> bool {
    if probe.output().is_ok_and(|output| output.status.success()) {
        return true;
    }
    let required = std::env::var("CUTC_REQUIRE_CLIENTS").is_ok_and(|value| value == "1");
    assert!(!required, "{name} is not installed, and CUTC_REQUIRE_CLIENTS=1 asks for it");
    // Written to the handle: what a test prints otherwise is not shown when it passes.
    let line = format!("skipped: {name} is not installed\n");
    std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).expect("standard error is open");
    false
}

fn python(script: &str, directory: &Path) -> Output {
    Command::new("python3").args(["-c", script]).current_dir(directory).output().expect("python3 starts")
}

/// Way of the pen while it is down, mm, in a plot of plain PU and PD in units of 1/40 mm.
fn pen_down(plot: &str) -> f64 {
    let (mut at, mut way) = ([0.0, 0.0], 0.0);
    for command in plot.split(';') {
        let (name, numbers) = command.trim().split_at(command.trim().len().min(2));
        if !["PU", "PD"].contains(&name) {
            continue;
        }
        let numbers: Vec<f64> = numbers.split(',').filter_map(|number| number.parse().ok()).collect();
        for pair in numbers.chunks_exact(2) {
            if name == "PD" {
                way += (pair[0] - at[0]).hypot(pair[1] - at[1]) / 40.0;
            }
            at = [pair[0], pair[1]];
        }
    }
    way
}

/// Plots without texts that hp2xx 3.4.4 draws otherwise, and why.
const OTHERWISE: [(&str, &str); 13] = [
    ("arcs", "its arcs by three points are not numbers, its chords are others"),
    ("beziers", "its chords are others"),
    ("circle-with-a-cross", "its chords are others"),
    ("circles", "its chords are others"),
    ("rectangles-and-wedge", "its chords are others"),
    ("encoded-and-saved-as-utf-8", "it repairs nothing"),
    ("encoded-fractions", "it reads no fraction bits"),
    ("fills-left-out", "it fills"),
    ("junk-between", "it stops at junk"),
    ("odd-coordinate", "it stops at a coordinate without its partner"),
    ("pages", "it draws the first page alone"),
    ("polygons", "it leaves out the edge that PM 1 adds"),
    ("scaled-to-the-device", "its corners are those of another device"),
];

#[test]
fn hp2xx_draws_the_same_way_of_the_pen() {
    // It has no option that ends well without a plot.
    if !is_there("hp2xx", Command::new("sh").args(["-c", "command -v hp2xx"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/hpgl");
    let mut plots: Vec<_> =
        std::fs::read_dir(fixtures).expect("a folder").map(|e| e.expect("readable").path()).collect();
    plots.sort();
    let mut compared = 0;
    for plot in plots {
        let name = plot.file_stem().and_then(|stem| stem.to_str()).expect("ASCII").to_owned();
        // It letters texts, so that they are strokes.
        let has_texts = std::fs::read(&plot).expect("readable").windows(2).any(|two| two == b"LB");
        if has_texts || OTHERWISE.iter().any(|(other, _)| *other == name) {
            continue;
        }
        compared += 1;
        let mut other = Command::new("hp2xx");
        other.args(["-q", "-t", "-m", "hpgl", "-f", "out.hpgl"]).arg(&plot).current_dir(folder.path());
        assert!(other.output().expect("hp2xx starts").status.success(), "{name}");
        let drawn = std::fs::read_to_string(folder.path().join("out.hpgl")).expect("hp2xx writes text");
        let mut info = Command::new(env!("CARGO_BIN_EXE_cutc"));
        let said = info.args(["info", "--format", "json"]).arg(&plot).output().expect("the program starts");
        let report: serde_json::Value = serde_json::from_slice(&said.stdout).expect("JSON");
        let found = report["pen_down_mm"].as_f64().unwrap_or_else(|| panic!("{name}: {report}"));
        let expected = pen_down(&drawn);
        assert!((found - expected).abs() <= 1e-3, "{name}: {found} mm instead of {expected}");
    }
    assert!(compared >= 25, "only {compared} plots were compared");
}

#[test]
fn numpy_maps_an_array_and_finds_the_numbers_of_the_table() {
    if !is_there("numpy", Command::new("python3").args(["-c", "import numpy"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let input = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/seed-circle.cut");
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let compiled = compile.args(["compile", "-t", "csv,npy"]).arg(input).current_dir(folder.path()).output();
    assert!(compiled.expect("the program starts").status.success());
    let script = r#"
import numpy
array = numpy.load("seed-circle.npy", mmap_mode="r")
assert isinstance(array, numpy.memmap) and array.ndim == 1 and array.itemsize == 39
assert array.dtype.names == ("t_s", "x_mm", "y_mm", "c_deg", "knife", "drill", "event", "block")
assert [array.dtype[i].str for i in range(8)] == ["<f8"] * 4 + ["|u1"] * 3 + ["<u4"]
table = numpy.genfromtxt("seed-circle.csv", delimiter=",", names=True)
assert len(table) == len(array) > 0 and table.dtype.names == array.dtype.names
for name in array.dtype.names:
    assert numpy.abs(table[name] - array[name]).max() <= 0.500001e-6, name
numpy.save("again.npy", array)
"#;
    let ran = python(script, folder.path());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    // What numpy writes from it is a program, too.
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/seed-circle.cut");
    let mut verify = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let judged = verify.args(["verify", "again.npy", "--source"]).arg(source).current_dir(folder.path()).output();
    let judged = judged.expect("the program starts");
    assert!(judged.status.success(), "{}", String::from_utf8_lossy(&judged.stdout));
}
