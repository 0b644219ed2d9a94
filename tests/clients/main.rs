//! Programs of others open what is written here. One that is not installed is named on standard error and left out;
//! with `CUTC_REQUIRE_CLIENTS=1` that is a failure.

#[cfg(unix)] // it kills processes by their group
mod dask;

mod drawings;

mod linuxcnc;

mod patterns;

mod player;

#[cfg(unix)]
#[path = "../it/support/page.rs"]
#[expect(dead_code, reason = "commands are read off a page where all of them are run")]
mod page;

#[path = "../it/support/samples.rs"]
mod samples;

mod schema;

mod stitches;

mod tables;

use std::path::Path;
use std::process::{Command, Output};

/// Whether the client is there; says so when not.
fn is_there(name: &str, probe: &mut Command) -> bool {
    if probe.output().is_ok_and(|output| output.status.success()) {
        return true;
    }
    let required = std::env::var("CUTC_REQUIRE_CLIENTS").is_ok_and(|value| value == "1");
    assert!(!required, "{name} is not installed, and CUTC_REQUIRE_CLIENTS=1 asks for it");
    tell(&format!("skipped: {name} is not installed"));
    false
}

/// Says a line on standard error, written to the handle: what a test prints otherwise is not shown when it passes.
fn tell(line: &str) {
    let line = format!("{line}\n");
    std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).expect("standard error is open");
}

/// What the interpreter of `LinuxCNC` would have the machine do for a program in a folder; otherwise what it says. One at a
/// time: it keeps its tools in a file that all of a computer share.
fn interpret(program: &str, folder: &Path) -> Result<String, String> {
    let lock = std::env::temp_dir().join("cutc-rs274.lock");
    let mut interpret = Command::new("flock");
    interpret.args(["-w", "600"]).arg(lock).args(["rs274", "-g", program, "canon.txt"]).current_dir(folder);
    let ran = interpret.output().expect("flock starts");
    let canon = std::fs::read_to_string(folder.join("canon.txt")).expect("text");
    ran.status.success().then_some(canon).ok_or_else(|| format!("{ran:?}"))
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
const OTHERWISE: [(&str, &str); 34] = [
    ("arcs", "its arcs by three points are not numbers, its chords are others"),
    ("beziers", "its chords are others"),
    ("circle-beside-decimals", "its chords are others"),
    ("circle-with-a-cross", "its chords are others"),
    ("circles", "its chords are others"),
    ("corners-behind-the-scale", "it forgets the scale when corners follow"),
    ("corners-given-late", "it forgets the scale when corners follow"),
    ("ends-amid-a-radius", "its chords are others"),
    ("interface-sequence-amid-places", "it ends the list at the sequence"),
    ("page-drawn-again", "it draws the page twice"),
    ("rectangles-and-wedge", "its chords are others"),
    ("encoded-and-saved-as-utf-8", "it repairs nothing"),
    ("encoded-fractions", "it reads no fraction bits"),
    ("encoded-fractions-of-both-signs", "it reads no fraction bits"),
    ("encoded-up-to-another-language", "it reads a body up to a semicolon"),
    ("fills-left-out", "it fills"),
    ("junk-between", "it stops at junk"),
    ("odd-coordinate", "it stops at a coordinate without its partner"),
    ("message", "its messages end at the terminator of labels, not at the semicolon"),
    ("pages", "it draws the first page alone"),
    ("polygons", "it leaves out the edge that PM 1 adds"),
    ("raster-data", "it draws data that an escape sequence counts"),
    ("scaled-arcs-on-a-line", "its arcs by three points are not numbers"),
    ("scaled-from-a-moved-corner", "its corners are those of another device"),
    ("scaled-mirrored", "its chords are others"),
    ("scaled-to-the-device", "its corners are those of another device"),
    ("scaled-unequally", "its arcs by three points are not numbers, its chords are others"),
    ("scaled-unequally-mirrored-and-turned", "its arcs by three points are not numbers, its chords are others"),
    ("scales-that-are-broken", "it stops at a scale that is broken"),
    ("text-on-the-display", "it draws what the display shows"),
    ("title-without-quotes", "it runs the words of the title"),
    ("turned-amid", "it makes relative moves from a place that is not turned, its chords are others"),
    ("u-notch-of-an-arc-amid-an-outline", "its chords are others"),
    ("wedge-of-a-full-turn", "it draws the radii of a full turn as well"),
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

/// Compiles a fixture in a folder.
fn compile(name: &str, targets: &str, folder: &Path) {
    let input = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    let compiled = compile.args(["compile", "-t", targets]).arg(input).current_dir(folder).output();
    let compiled = compiled.expect("the program starts");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
}

#[test]
fn numpy_maps_counts_and_finds_the_positions_of_the_table() {
    if !is_there("numpy", Command::new("python3").args(["-c", "import numpy"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    compile("iso/seed-circle.cut", "csv,counts", folder.path());
    let script = r#"
import json, numpy
head = json.loads(open("seed-circle.counts", "rb").read(1024))
counts = numpy.memmap("seed-circle.counts", "<i4", "r", 1024).reshape(-1, 5)
table = numpy.genfromtxt("seed-circle.csv", delimiter=",", names=True)
assert head["rows"] == len(counts) == len(table) and head["columns"] == ["x", "y", "c", "outputs", "block"]
for i, (axis, column, per) in enumerate([("x", "x_mm", "per_mm"), ("y", "y_mm", "per_mm"), ("c", "c_deg", "per_deg")]):
    scale = head[axis][per]
    away = numpy.abs((counts[:, i].astype(float) - head[axis]["offset"]) / scale - table[column]).max()
    assert away <= 0.5 / scale + 0.500001e-6, (axis, away)
assert (counts[:, 3] & 1 == table["knife"]).all() and (counts[:, 4] == table["block"]).all()
"#;
    let ran = python(script, folder.path());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
}

/// Plays the rows of `halrun` through followers that obey our limits, and logs input and output.
const FOLLOWERS: &str = r"
loadrt threads name1=servo period1=PERIOD
loadrt streamer depth=DEPTH cfg=fffbuuu
loadrt sampler depth=DEPTH cfg=ffffffb
loadrt limit3 names=lx,ly,lc
addf streamer.0 servo
addf lx servo
addf ly servo
addf lc servo
addf sampler.0 servo
net x-pos streamer.0.pin.0 lx.in sampler.0.pin.0
net y-pos streamer.0.pin.1 ly.in sampler.0.pin.1
net c-pos streamer.0.pin.2 lc.in sampler.0.pin.2
net x-out lx.out sampler.0.pin.3
net y-out ly.out sampler.0.pin.4
net c-out lc.out sampler.0.pin.5
net knife streamer.0.pin.3 sampler.0.pin.6
setp lx.maxv VXY
setp ly.maxv VXY
setp lc.maxv VC
setp lx.maxa AXY
setp ly.maxa AXY
setp lc.maxa AC
setp streamer.0.enable 0
setp sampler.0.enable 0
start
loadusr -w halstreamer ROWS
setp sampler.0.enable 1
setp streamer.0.enable 1
loadusr -w timeout 120 halsampler -n SAMPLES log.txt
";

#[test]
fn a_whole_marker_is_followed_without_lag_by_the_real_time_layer_of_linuxcnc() {
    if !is_there("halrun", Command::new("sh").args(["-c", "command -v halrun halstreamer halsampler"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    compile("markers/metric-four-pieces.cut", "hal,halrun", folder.path());
    let at = |name: &str| folder.path().join(name);
    let text = std::fs::read_to_string(at("metric-four-pieces.hal.txt")).expect("rows");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(' ').map(|field| field.parse().expect("a number")).collect())
        .collect();
    // HAL knows no real time here: a hundred times faster, with limits that are as much larger, is the same.
    let speed = 100.0;
    let margin = 1.001;
    let limit = |value: f64, power: i32| format!("{}", value * margin * f64::powi(speed, power));
    let samples = rows.len() + 200;
    let words = [
        ("PERIOD", "10000".to_owned()),
        ("DEPTH", (samples + 100).to_string()),
        ("VXY", limit(1200.0, 1)),
        ("VC", limit(1080.0, 1)),
        ("AXY", limit(8000.0, 2)),
        ("AC", limit(20_000.0, 2)),
        ("ROWS", "metric-four-pieces.hal.txt".to_owned()),
        ("SAMPLES", samples.to_string()),
    ];
    let file = words.iter().fold(FOLLOWERS.to_owned(), |file, (word, value)| file.replace(word, value));
    std::fs::write(at("follow.hal"), file).expect("writable");
    let ran = hal("follow.hal", folder.path());
    let log = std::fs::read_to_string(at("log.txt"));
    let log = log
        .unwrap_or_else(|_| panic!("{}{}", String::from_utf8_lossy(&ran.stdout), String::from_utf8_lossy(&ran.stderr)));
    let logged: Vec<Vec<f64>> =
        log.lines().map(|line| line.split_whitespace().filter_map(|field| field.parse().ok()).collect()).collect();
    // The sampler was on before the streamer: the program stands somewhere inside the log, row by row.
    let first = &rows[1];
    let is_first = |line: &&Vec<f64>| line.len() == 7 && (0..3).all(|i| (line[i] - first[i]).abs() < 1e-6);
    let start = logged.iter().position(|line| is_first(&line)).expect("the first moving row is logged") - 1;
    assert!(logged.len() >= start + rows.len(), "{} of {} rows", logged.len(), rows.len());
    for (row, line) in rows.iter().zip(&logged[start..]).skip(1) {
        for i in 0..3 {
            assert!((line[i] - row[i]).abs() < 1e-6, "a row is lost: {row:?} {line:?}");
            assert!((line[i + 3] - row[i]).abs() < 1e-6, "the follower lags: {row:?} {line:?}");
        }
        assert_eq!(line[6], row[3], "the knife");
    }
    // The file that is written beside the rows plays them, too.
    let played = hal("metric-four-pieces.hal", folder.path());
    assert!(played.status.success(), "{}", String::from_utf8_lossy(&played.stderr));
}

/// Runs a file of HAL in a folder.
fn hal(file: &str, folder: &Path) -> Output {
    unprivileged(&format!("halrun {file}"), folder)
}

/// Runs a line in a folder: as another user when this one is root, whom `LinuxCNC` refuses; one at a time, because HAL is
/// one per machine.
fn unprivileged(line: &str, folder: &Path) -> Output {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout == b"0\n");
    let run = format!("flock -w 600 /tmp/cutc-hal.lock {line}");
    let line = if is_root {
        format!(
            "id cutc-hal >/dev/null 2>&1 || useradd -m cutc-hal; chown -R cutc-hal . && touch /tmp/cutc-hal.lock && \
             chmod 666 /tmp/cutc-hal.lock; runuser -u cutc-hal -- env HOME=/home/cutc-hal {run}"
        )
    } else {
        run
    };
    Command::new("sh").args(["-c", &line]).current_dir(folder).output().expect("sh runs")
}
