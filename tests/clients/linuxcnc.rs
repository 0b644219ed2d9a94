//! LinuxCNC takes the programs of the target `gcode`: its interpreter all of them, the whole controller one in real time.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use cutc::geom::{Point, polyline};
use cutc::machine::{MachineProfile, Shipped, load};
use cutc::source::Source;

use crate::{interpret, is_there, tell, unprivileged};

/// By how much the estimate may be off, as a part of the time; and the longest time that the program may take, s.
const ESTIMATE_SHARE: f64 = 0.05;
const TIME_MAX: f64 = 8.5;
/// Runs until the time is the estimated one, at the most.
const RUNS: usize = 3;
/// Way of the axes between two samples of a busy computer, mm.
const BETWEEN_SAMPLES: f64 = 5.0;
/// Printed decimals of positions: the programs' and the interpreter's.
const STEP: f64 = 1e-4;

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures")
}

/// A machine as `-p` takes it: the name of a profile that ships, or else a file of `fixtures/machines`.
fn machine(name: &str) -> PathBuf {
    Shipped::find(name).map_or_else(|| fixtures().join(format!("machines/{name}.toml")), |shipped| shipped.name.into())
}

fn profile(name: &str) -> MachineProfile {
    let file = || Source::new(name, std::fs::read(machine(name)).expect("readable")).expect("it is small");
    load(Some(&Shipped::find(name).map_or_else(file, Shipped::source)), &[]).expect("a profile")
}

/// Compiles a fixture for a machine; what it says as JSON, when it can be compiled.
fn compile(input: &Path, machine: &str, folder: &Path) -> Option<serde_json::Value> {
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    compile.args(["compile", "--force", "-t", "gcode", "-o", "program.ngc", "--format", "json"]).arg(input);
    compile.arg("-p").arg(self::machine(machine)).current_dir(folder);
    let compiled = compile.output().expect("the program starts");
    compiled.status.success().then(|| serde_json::from_slice(&compiled.stdout).expect("JSON"))
}

/// A move as a line of a program tells it.
#[derive(Debug, Clone, Copy)]
struct Move {
    code: u32,
    from: [f64; 3],
    /// X, Y and the blade's axis.
    to: [f64; 3],
    centre: Point,
}

/// The moves of a program.
fn moves(program: &str, axis: char) -> Vec<Move> {
    let mut at = [0.0; 3];
    let mut moves = Vec::new();
    for line in program.lines() {
        let words: BTreeMap<char, f64> =
            line.split(' ').filter_map(|word| Some((word.chars().next()?, word.get(1..)?.parse().ok()?))).collect();
        let Some(code) = line.strip_prefix('G').and_then(|_| words.get(&'G')).filter(|code| **code <= 3.0) else {
            continue;
        };
        let word = |letter: char, or: f64| words.get(&letter).copied().unwrap_or(or);
        let to = [word('X', at[0]), word('Y', at[1]), word(axis, at[2])];
        let centre = Point::new(at[0] + word('I', 0.0), at[1] + word('J', 0.0));
        moves.push(Move { code: *code as u32, from: at, to, centre });
        at = to;
    }
    moves
}

/// What the interpreter would have the machine do: the name of each canonical command and its numbers.
fn canon(text: &str) -> Vec<(&str, Vec<f64>)> {
    let call = |line: &'_ str| -> Option<(usize, usize)> { Some((line.find('(')?, line.rfind(')')?)) };
    let commands = text.lines().filter_map(|line| {
        let (open, close) = call(line)?;
        let name = line[..open].rsplit(' ').next()?;
        let numbers = line[open + 1..close].split(',').map(|number| number.trim().parse()).collect::<Result<_, _>>();
        ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"].contains(&name).then_some((name, numbers.ok()?))
    });
    commands.collect()
}

/// Two squares in windows of a conveyor: the analog output that it reads tells it how far, and each square lies in the first
/// window when it is cut.
#[test]
fn the_interpreter_of_linuxcnc_moves_the_cloth_on_between_the_bites_of_a_conveyor() {
    if !is_there("rs274", Command::new("sh").args(["-c", "command -v rs274"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let cut = "H1*G71*N1*X0Y0*M14*X3000Y0*X3000Y3000*X0Y0*M15*N2*X3500Y0*M14*X6500Y0*X6500Y3000*X3500Y0*M15*M0*";
    std::fs::write(folder.path().join("row.cut"), cut).expect("a file");
    let machine = "bite.length_mm = 400\ngcode.advance = [\"M68 E0 Q#\", \"M64 P1\", \"M66 P1 L3 Q60\"]\n";
    std::fs::write(folder.path().join("machine.toml"), machine).expect("a file");
    let mut compile = Command::new(env!("CARGO_BIN_EXE_cutc"));
    compile.args(["compile", "row.cut", "-p", "machine.toml", "-o", "program.ngc"]).current_dir(folder.path());
    assert!(compile.status().expect("the program starts").success());
    let text = interpret("program.ngc", folder.path()).expect("a program that the interpreter takes");
    assert_eq!(text.matches("SET_AUX_OUTPUT_VALUE(0,350.000000)").count(), 1, "{text}");
    let farthest = canon(&text).iter().map(|(_, numbers)| numbers[0]).fold(0.0, f64::max);
    assert!((300.0..310.0).contains(&farthest), "{farthest}");
}

#[test]
fn the_interpreter_of_linuxcnc_takes_every_program_and_means_the_same_places() {
    if !is_there("rs274", Command::new("sh").args(["-c", "command -v rs274"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let mut inputs: Vec<PathBuf> = Vec::new();
    for (kind, extension) in [("markers", "cut"), ("iso", "cut"), ("hpgl", "plt"), ("csv", "csv")] {
        let files =
            std::fs::read_dir(fixtures().join(kind)).expect("a folder").map(|file| file.expect("readable").path());
        inputs.extend(files.filter(|path| path.extension().is_some_and(|found| found == extension)));
    }
    inputs.sort();
    let mut taken = 0;
    for machine in ["linuxcnc", "grblhal", "fluidnc", "mega5x", "eccentric"] {
        let keys = profile(machine).gcode;
        // Where the blade's axis stands among A, B and C.
        let axis = (keys.letter.byte() - b'A') as usize;
        // One table takes all; of the others the markers and cut files show what differs, of those like another the markers.
        let is_asked = |input: &&PathBuf| match machine {
            "linuxcnc" => true,
            "grblhal" | "mega5x" => input.parent().is_some_and(|folder| folder.ends_with("markers")),
            _ => input.extension().is_some_and(|end| end == "cut"),
        };
        for input in inputs.iter().filter(is_asked) {
            let name = format!("{machine}: {}", input.display());
            if compile(input, machine, folder.path()).is_none() {
                continue;
            }
            let commands = interpret("program.ngc", folder.path()).unwrap_or_else(|why| panic!("{name}: {why}"));
            let program = std::fs::read_to_string(folder.path().join("program.ngc")).expect("text");
            let (moves, commands) = (moves(&program, keys.letter.byte().into()), canon(&commands));
            assert_eq!(moves.len(), commands.len(), "{name}");
            for (step, (command, numbers)) in moves.iter().zip(&commands) {
                let (places, kind): (Vec<f64>, &str) = match step.code {
                    0 => (vec![numbers[0], numbers[1], numbers[3 + axis]], "STRAIGHT_TRAVERSE"),
                    1 => (vec![numbers[0], numbers[1], numbers[3 + axis]], "STRAIGHT_FEED"),
                    _ => (vec![numbers[0], numbers[1], numbers[6 + axis], numbers[2], numbers[3]], "ARC_FEED"),
                };
                assert_eq!(*command, kind, "{name}: {step:?}");
                let [x, y, c] = step.to;
                for (found, expected) in places.iter().zip([x, y, c, step.centre.x, step.centre.y]) {
                    assert!((found - expected).abs() < 0.51 * STEP, "{name}: {step:?} {numbers:?}");
                }
                assert!(step.code < 2 || (numbers[4] > 0.0) == (step.code == 3), "{name}: {step:?} {numbers:?}");
            }
            taken += 1;
        }
    }
    assert!(taken >= 120, "only {taken} programs were taken");
}

/// Starts the machine, homes it, runs the program and logs where it is.
const DRIVER: &str = r#"#!/usr/bin/python3
import sys, time, linuxcnc

command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()

def until(holds, seconds, what):
    end = time.time() + seconds
    while time.time() < end:
        status.poll()
        if holds():
            return
        time.sleep(0.01)
    sys.exit("no " + what)

time.sleep(1)
command.state(linuxcnc.STATE_ESTOP_RESET)
command.wait_complete()
command.state(linuxcnc.STATE_ON)
until(lambda: status.task_state == linuxcnc.STATE_ON, 10, "power")
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.home(-1)
until(lambda: all(status.homed[:status.joints]), 20, "home")
command.mode(linuxcnc.MODE_AUTO)
command.wait_complete()
command.program_open("FOLDER/program.ngc")
command.auto(linuxcnc.AUTO_RUN, 0)
with open("FOLDER/trace.txt", "w") as trace:
    start, running = time.time(), False
    while time.time() < start + SECONDS:
        status.poll()
        x, y, _, _, _, c = status.position[:6]
        trace.write("%.4f %.5f %.5f %.5f\n" % (time.time() - start, x, y, c))
        error = errors.poll()
        if error:
            sys.exit(str(error))
        running = running or status.interp_state != linuxcnc.INTERP_IDLE
        if running and status.interp_state == linuxcnc.INTERP_IDLE and status.inpos:
            break
        time.sleep(0.002)
    trace.write("end\n")
"#;

/// A line as somebody might spell it who edits the program by hand.
fn by_hand((number, line): (usize, &str)) -> String {
    if line.starts_with('(') {
        return format!("\t{line} ; by hand\n\n");
    }
    match number % 6 {
        0 => format!("{} (by hand)\n", line.to_lowercase()),
        1 => format!("n{number:05}{}\n", line.replace("G1 ", "G01").replace("G0 ", "G00").replace(' ', "")),
        2 => format!(" {} ; by hand\n", line.replace(' ', " \t")),
        3 => format!("\n(a) {line} (b)\n; c\n"),
        4 => match line.split_once(' ') {
            Some((code @ ("G0" | "G1" | "G2" | "G3"), words)) => format!("{words} {code}\n"),
            _ => format!("{line}\n"),
        },
        _ => format!("{}\n", line.replace(" X", " X+0").replace("+0-", "-0")),
    }
}

#[test]
fn the_interpreter_of_linuxcnc_and_the_verifier_read_a_program_that_is_spelled_by_hand_as_the_same() {
    if !is_there("rs274", Command::new("sh").args(["-c", "command -v rs274"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let input = fixtures().join("markers/metric-six-pieces.cut");
    compile(&input, "linuxcnc", folder.path()).expect("it is compiled");
    let path = |file: &str| folder.path().join(file);
    let program = std::fs::read_to_string(path("program.ngc")).expect("text");
    let hand: String = program.lines().enumerate().map(by_hand).collect();
    std::fs::write(path("hand.ngc"), hand).expect("writable");
    let canon_of = |file: &str| interpret(file, folder.path()).unwrap_or_else(|why| panic!("{file}: {why}"));
    let [written, hand] = ["program.ngc", "hand.ngc"].map(canon_of);
    assert!(canon(&written).len() > 100 && canon(&written) == canon(&hand));
    let mut verify = Command::new(env!("CARGO_BIN_EXE_cutc"));
    verify.args(["verify", "hand.ngc", "--source"]).arg(&input).current_dir(folder.path());
    let judged = verify.args(["-p", "linuxcnc"]).output().expect("the program starts");
    assert!(judged.status.success(), "{}", String::from_utf8_lossy(&judged.stdout));
}

/// The controller's own description of a machine with these limits.
fn ini(profile: &MachineProfile, folder: &Path) -> String {
    let [x, y, c] = [&profile.axes.x, &profile.axes.y]
        .map(|axis| [axis.speed_mm_s, axis.acceleration_mm_s2])
        .into_iter()
        .chain([[profile.axes.c.speed_deg_s, profile.axes.c.acceleration_deg_s2]])
        .collect::<Vec<_>>()
        .try_into()
        .expect("three axes");
    let folder = folder.display();
    let mut text = format!(
        "[EMC]\nVERSION = 1.1\nMACHINE = cutter\n[DISPLAY]\nDISPLAY = {folder}/driver.py\n[TASK]\nTASK = milltask\n\
         CYCLE_TIME = 0.001\n[RS274NGC]\nPARAMETER_FILE = {folder}/parameters.var\n[EMCIO]\nEMCIO = io\n\
         TOOL_TABLE = {folder}/tools.tbl\n[EMCMOT]\nEMCMOT = motmod\nSERVO_PERIOD = 1000000\n[HAL]\n\
         HALFILE = LIB:basic_sim.tcl\n[KINS]\nJOINTS = 4\nKINEMATICS = trivkins coordinates=XYZC\n[TRAJ]\n\
         COORDINATES = X Y Z C\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\nNO_FORCE_HOMING = 1\n\
         MAX_LINEAR_VELOCITY = {0}\nDEFAULT_LINEAR_VELOCITY = {0}\nMAX_LINEAR_ACCELERATION = {1}\n",
        x[0], x[1]
    );
    let axes: [(&str, &str, [f64; 2]); 4] =
        [("X", "LINEAR", x), ("Y", "LINEAR", y), ("Z", "LINEAR", [100.0, 1000.0]), ("C", "ANGULAR", c)];
    for (joint, (letter, kind, [speed, acceleration])) in axes.iter().enumerate() {
        let limits =
            format!("MAX_VELOCITY = {speed}\nMAX_ACCELERATION = {acceleration}\nMIN_LIMIT = -1e6\nMAX_LIMIT = 1e6\n");
        let _ = write!(text, "[AXIS_{letter}]\n{limits}[JOINT_{joint}]\nTYPE = {kind}\nHOME_SEQUENCE = 0\n");
        // What is simulated follows late when the computer is busy: that is no fault of the program.
        let _ = write!(text, "{limits}FERROR = 1000\nMIN_FERROR = 1000\n");
    }
    text
}

/// The way of the axes over the table as straight lines.
fn outline(moves: &[Move]) -> Vec<Point> {
    let mut points = Vec::new();
    for step in moves {
        let (from, to) = (Point::new(step.from[0], step.from[1]), Point::new(step.to[0], step.to[1]));
        points.push(from);
        if step.code >= 2 {
            let arm = from - step.centre;
            let ends = [arm, to - step.centre].map(|arm| arm.y.atan2(arm.x));
            let sense = if step.code == 3 { 1.0 } else { -1.0 };
            let sweep = (sense * (ends[1] - ends[0])).rem_euclid(std::f64::consts::TAU);
            let steps = (sweep / 0.05).max(sweep * arm.norm() / 0.5).ceil() as usize;
            for i in 1..steps {
                let (sin, cos) = (sense * sweep * i as f64 / steps as f64).sin_cos();
                let at =
                    step.centre.coords + cutc::geom::Vector::new(arm.x * cos - arm.y * sin, arm.x * sin + arm.y * cos);
                points.push(at.into());
            }
        }
        points.push(to);
    }
    points.dedup();
    points
}

/// The farthest that points are from a way, mm.
fn farthest(points: &[Point], way: &[Point]) -> f64 {
    let away = |point: &Point| {
        way.windows(2).map(|w| polyline::distance_to_segment(*point, w[0], w[1])).fold(f64::INFINITY, f64::min)
    };
    points.iter().map(away).fold(0.0, f64::max)
}

#[test]
fn the_whole_controller_of_linuxcnc_runs_a_program_in_its_band_and_in_the_time_that_was_estimated() {
    if !is_there("linuxcnc", Command::new("sh").args(["-c", "command -v linuxcnc"])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let at = |name: &str| folder.path().join(name);
    let profile = profile("wavy");
    let report = compile(&fixtures().join("motion/wavy751.csv"), "wavy", folder.path()).expect("it is sound");
    let estimate = report["controller"]["time_s"].as_f64().expect("seconds");
    let driver = DRIVER.replace("FOLDER", &folder.path().display().to_string()).replace("SECONDS", "60");
    let parameters: String = (5161..5170).map(|n| format!("{n} 0\n")).chain(["5220 1\n".to_owned()]).collect();
    let files = [
        ("driver.py", driver),
        ("machine.ini", ini(&profile, folder.path())),
        ("tools.tbl", String::new()),
        ("parameters.var", parameters),
    ];
    for (name, text) in files {
        std::fs::write(at(name), text).expect("writable");
    }
    let program = std::fs::read_to_string(at("program.ngc")).expect("text");
    let way = outline(&moves(&program, 'C'));
    // A busy computer stalls the controller's clock now and then, and who watches it: the fastest run counts, and the one
    // that was seen best.
    let (mut traced, mut took, mut missed) = (Vec::new(), f64::INFINITY, f64::INFINITY);
    for _ in 0..RUNS {
        let ran = unprivileged("sh -c 'chmod +x driver.py && timeout 120 linuxcnc -r machine.ini'", folder.path());
        let said = format!("{}{}", String::from_utf8_lossy(&ran.stdout), String::from_utf8_lossy(&ran.stderr));
        let trace = std::fs::read_to_string(at("trace.txt")).unwrap_or_else(|_| panic!("{said}"));
        assert!(trace.ends_with("end\n"), "{said}");
        let rows: Vec<Vec<f64>> = trace
            .lines()
            .filter(|line| *line != "end")
            .map(|line| line.split(' ').map(|field| field.parse().expect("a number")).collect::<Vec<f64>>())
            .collect();
        let moving: Vec<usize> = (1..rows.len()).filter(|&i| rows[i][1..] != rows[i - 1][1..]).collect();
        took = f64::min(took, rows[moving[moving.len() - 1]][0] - rows[moving[0] - 1][0]);
        let seen: Vec<Point> = rows.iter().map(|row| Point::new(row[1], row[2])).collect();
        missed = f64::min(missed, farthest(&way, &seen));
        traced.extend(seen);
        if (took / estimate - 1.0).abs() <= ESTIMATE_SHARE && missed <= BETWEEN_SAMPLES {
            break;
        }
    }
    tell(&format!("LinuxCNC took {took:.3} s, {estimate:.3} s were estimated"));
    assert!((took / estimate - 1.0).abs() <= ESTIMATE_SHARE, "{took} s instead of {estimate} s");
    assert!(took <= TIME_MAX, "{took} s");
    // Beside its way it may be by G64 P, and by rounding of the trace.
    let allowed = profile.gcode.blend_mm.expect("it blends") + 0.02;
    let off = farthest(&traced, &way);
    assert!(off <= allowed, "{off} mm off its way");
    assert!(missed <= BETWEEN_SAMPLES, "{missed} mm of its way are left out");
}
