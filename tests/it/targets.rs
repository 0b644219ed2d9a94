//! Promises of the targets `npy`, `json` and `states`, and several targets in one compile.

use std::fs;

use crate::support::room::Room;
use crate::support::rows;
use serde_json::Value;

/// A square, a short line and a drill: every kind of run but an event.
const SMALL: &str = "H1*G71*N1*X0Y0*M14*X400Y0*X400Y400*X0Y400*X0Y0*M15*N2*X600Y0*M14*X640Y0*M15*X600Y200*M43*M0*";

/// Half of the last decimal that `csv` prints, and what the sum of both roundings to f64 adds.
const ROUNDING: f64 = 0.500_001e-6;

/// The rows of a `csv` program: four decimals, four whole numbers.
fn csv_rows(text: &str) -> Vec<[f64; 8]> {
    let number = |field: &str| field.parse().expect("a number");
    let row = |line: &str| line.split(',').map(number).collect::<Vec<f64>>().try_into().expect("eight fields");
    text.lines().skip(1).map(row).collect()
}

/// The records of an `npy` program, by the published layout of such files.
fn npy_rows(bytes: &[u8]) -> Vec<[f64; 8]> {
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!(start % 64, 0, "memory maps are aligned");
    let header = std::str::from_utf8(&bytes[10..start]).expect("ASCII");
    assert!(header.ends_with('\n'));
    let records = bytes[start..].chunks_exact(39);
    assert!(records.remainder().is_empty());
    assert!(header.contains(&format!("'shape': ({},)", records.len())), "{header}");
    let float = |record: &[u8], i: usize| f64::from_le_bytes(record[8 * i..][..8].try_into().expect("eight bytes"));
    let whole = |byte: u8| f64::from(byte);
    let row = |r: &[u8]| {
        let block = u32::from_le_bytes([r[35], r[36], r[37], r[38]]);
        let [t, x, y, c] = [0, 1, 2, 3].map(|i| float(r, i));
        [t, x, y, c, whole(r[32]), whole(r[33]), whole(r[34]), f64::from(block)]
    };
    records.map(row).collect()
}

#[test]
fn an_array_holds_the_numbers_of_the_table_before_rounding() {
    let room = Room::with("small.cut", SMALL);
    for name in ["small", "circle"] {
        room.says(&format!("compile {name}.cut -t csv,npy"), 0);
        let (table, array) =
            (csv_rows(&room.text(&format!("{name}.csv"))), npy_rows(&room.read(&format!("{name}.npy"))));
        assert_eq!(table.len(), array.len());
        for (printed, exact) in table.iter().zip(&array) {
            assert!((0..4).all(|i| (printed[i] - exact[i]).abs() <= ROUNDING), "{printed:?} {exact:?}");
            assert_eq!(printed[4..], exact[4..]);
        }
        assert!(array.iter().any(|row| row[1].fract() != 0.0 && (row[1] * 1e6).fract() != 0.0), "unrounded");
    }
}

#[test]
fn an_array_is_judged_by_its_own_bytes() {
    let room = Room::with("small.cut", SMALL);
    room.says("compile circle.cut -t npy", 0);
    room.says("verify circle.npy --source circle.cut", 0);
    let sound = room.read("circle.npy");
    let broken = |name: &str, bytes: &[u8], rule: &str| {
        fs::write(room.at("broken.npy"), bytes).expect("writable");
        let output = room.run("verify broken.npy --source circle.cut");
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        assert!(said.lines().any(|line| line.starts_with("FAIL") && line.contains(rule)), "{name}: {said}");
    };
    let edited = |at: usize, with: &[u8]| {
        let mut bytes = sound.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        bytes
    };
    let record = |i: usize| 256 + 39 * i;
    let middle = (sound.len() - 256) / 39 / 2;
    broken("cut short", &sound[..sound.len() - 1], "verify/format");
    broken("a record too many", &[&sound[..], &[0; 39]].concat(), "verify/format");
    broken("not a number", &edited(record(middle) + 8, &f64::NAN.to_le_bytes()), "verify/format");
    broken("a knife of 2", &edited(record(middle) + 32, &[2]), "verify/format");
    broken("another field", &edited(20, b"('T_s'"), "verify/format");
    broken("a version of its own", &edited(6, &[9]), "verify/format");
    broken("a header alone", &sound[..7], "verify/format");
    broken("a jump", &edited(record(middle) + 8, &1e3_f64.to_le_bytes()), "verify/speed-x");
    broken("a late record", &edited(record(middle), &0_f64.to_le_bytes()), "verify/time");
}

/// A compiled `json` program.
fn steps(room: &Room, name: &str) -> Value {
    room.says(&format!("compile {name}.cut -t csv,json"), 0);
    serde_json::from_slice(&room.read(&format!("{name}.json"))).expect("JSON")
}

#[test]
fn the_times_of_the_runs_add_up_to_the_program() {
    let room = Room::with("small.cut", SMALL);
    for name in ["small", "circle"] {
        let json = steps(&room, name);
        let (runs, program) = (json["runs"].as_array().expect("a list"), &json["program"]);
        let sum = |key: &str| runs.iter().map(|run| run[key].as_f64().expect("a number")).sum::<f64>();
        let time = program["time_s"].as_f64().expect("a number");
        assert!((sum("duration_s") + sum("dwell_s") - time).abs() < 1e-9, "{program}");
        assert_eq!(Some(sum("ticks")), program["ticks"].as_f64());
        assert_eq!(program["runs"], runs.len());
        let last = csv_rows(&room.text(&format!("{name}.csv"))).pop().expect("rows");
        assert_eq!(program["setpoints_s"].as_f64(), Some(last[0]), "the last setpoint");
        assert!(time <= last[0] + 1e-9, "whole periods only stretch");
        for (i, run) in runs.iter().enumerate() {
            assert_eq!(run["index"], i);
        }
        assert!(runs.windows(2).all(|pair| pair[0]["end"] == pair[1]["start"]), "nothing jumps");
    }
}

/// A text with no more than nine decimals a number: the last digits of a root are not the same everywhere.
fn reviewed(text: &str) -> String {
    let mut decimals = None;
    let mut keep = |c: char| {
        decimals = match decimals {
            Some(count) if c.is_ascii_digit() => Some(count + 1),
            _ => (c == '.').then_some(0),
        };
        decimals.is_none_or(|count| count <= 9)
    };
    text.chars().filter(|&c| keep(c)).collect()
}

#[test]
fn the_runs_of_a_small_program_read_well() {
    let room = Room::with("small.cut", SMALL);
    steps(&room, "small");
    insta::assert_snapshot!(reviewed(&room.text("small.json")));
}

#[test]
fn several_targets_give_what_each_gives_alone() {
    let room = Room::with("small.cut", SMALL);
    for folder in ["all", "one"] {
        fs::create_dir(room.at(folder)).expect("writable");
    }
    let said = room.says("compile small.cut -t csv,npy,json,svg -o all", 0);
    for end in ["csv", "npy", "json", "svg"] {
        room.says(&format!("compile small.cut -t {end} -o one"), 0);
        for name in [format!("small.{end}"), format!("small.{end}.meta.json")] {
            assert!(room.read(&format!("one/{name}")) == room.read(&format!("all/{name}")), "{name}");
        }
        assert!(said.contains(&format!("small.{end}`")), "{said}");
    }
    room.says("compile small.cut -t svg,json --no-verify -o all", 0);
    assert!(room.text("all/small.svg.meta.json").contains("\"verified\": \"no\""));
}

#[test]
fn several_targets_need_several_places() {
    let room = Room::with("small.cut", SMALL);
    for arguments in ["-t csv,svg -o one.csv", "-t csv,svg -o -", "-t csv,csv", "-t csv -t csv", "-t csv,nothing"] {
        room.says(&format!("compile small.cut {arguments}"), 2);
    }
    assert_eq!(room.names(), ["circle.cut", "junk.cut", "small.cut"], "nothing is written");
}

#[test]
fn of_several_targets_none_is_written_when_one_cannot_be() {
    let room = Room::with("small.cut", SMALL);
    room.says("compile small.cut -t csv,npy", 0);
    let said = room.says("compile small.cut -t csv,npy --set verify.max_overcut_waste_mm=0", 1);
    for end in ["csv", "npy"] {
        assert!(!room.has(&format!("small.{end}")) && room.has(&format!("small.{end}.stale")), "{said}");
        assert!(room.has(&format!("small.{end}.meta.json.stale")));
    }
    fs::create_dir(room.at("small.json")).expect("writable");
    room.says("compile small.cut -t csv,json", 2);
    assert!(!room.has("small.csv"));
}

/// The rows of a `states` program: the state, then its numbers.
fn states(text: &str) -> Vec<(String, Vec<f64>)> {
    let row = |line: &str| {
        let (state, numbers) = line.split_once(',').expect("a state and numbers");
        (state.to_owned(), numbers.split(',').map(|field| field.parse().expect("a number")).collect())
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn the_states_of_a_square_are_those_of_the_paper() {
    let square = "H1*G71*N1*X0Y0*M14*X1000Y0*X1000Y1000*X0Y1000*X0Y0*M15*M0*";
    let room = Room::with("square.cut", square);
    let knife = ["width_mm=6", "back_mm=2", "front_overlap_mm=1", "heel_overlap_mm=0.5"];
    let corners = ["corner_front_overlap_mm=1", "corner_heel_overlap_mm=0.5"];
    let keys: Vec<String> = knife.iter().chain(&corners).map(|key| format!(" --set knife.{key}")).collect();
    let keys = keys.concat();
    room.says(&format!("compile square.cut -o square.states{keys}"), 0);
    let (states, table) = (states(&room.text("square.states")), rows("knife/square_table.csv"));
    assert_eq!(states.len(), table.len());
    for (i, ((state, numbers), row)) in states.iter().zip(table).enumerate() {
        assert_eq!(state, ["plunge", "lift"][i % 2]);
        let &[_, _, _, _, _, tip_x, tip_y, tail_x, tail_y, x, y, c, dx, dy, dc] = &numbers[..] else { panic!("{i}") };
        assert_eq!([x, y, c, tip_x, tip_y, tail_x, tail_y], row[1..8], "{i}");
        // The paper counts its increments from the first state, the target from `home`.
        let home = if i == 0 { [1.5, 0.0, 0.0] } else { [0.0; 3] };
        let increments: Vec<f64> = (0..3).map(|k| row[8 + k] + home[k]).collect();
        assert_eq!([dx, dy, dc], increments[..], "{i}");
    }
}

#[test]
fn each_state_has_its_blade_on_the_path_and_the_increments_of_the_axes() {
    let arc: String = (0..=40).map(|i| f64::from(i) * 4.0_f64.to_radians()).fold(String::new(), |text, a| {
        format!("{text}X{:.0}Y{:.0}*", 3000.0 + 800.0 * a.sin(), 2000.0 - 800.0 * a.cos())
    });
    let (start, rest) = arc.split_once('*').expect("points");
    let cut = format!("{}N3*{start}*M14*{rest}M15*M0*", SMALL.strip_suffix("M0*").expect("an end"));
    let room = Room::with("small.cut", &cut);
    for follow in ["tangent", "chord"] {
        room.says(&format!("compile small.cut --force -o small.states --set knife.follow={follow}"), 0);
        let states = states(&room.text("small.states"));
        let kinds = ["plunge", "end", "lift", "plunge-cut", "drill"];
        assert!(kinds.iter().all(|kind| states.iter().any(|(state, _)| state == kind)), "{states:?}");
        let mut axes = [0.0; 3];
        for (state, numbers) in &states {
            let &[_, _, _, to_x, to_y, tip_x, tip_y, tail_x, tail_y, x, y, c, dx, dy, dc] = &numbers[..] else {
                panic!("{numbers:?}")
            };
            let (along_x, along_y) = (tip_x - tail_x, tip_y - tail_y);
            assert!((along_x.hypot(along_y) - 6.6).abs() < 1e-5, "{state} {numbers:?}");
            let off = (along_y.atan2(along_x).to_degrees() - c).rem_euclid(360.0);
            assert!((0.0..360.0).contains(&c) && off.min(360.0 - off) < 1e-4, "{state} {numbers:?}");
            if state == "end" {
                assert!((tip_x - to_x).hypot(tip_y - to_y) < 1e-5, "{state} {numbers:?}");
            }
            axes = [axes[0] + dx, axes[1] + dy, axes[2] + dc];
            assert!((axes[0] - x).hypot(axes[1] - y) < 1e-4, "{state} {numbers:?}");
            let turned = (axes[2] - c).rem_euclid(360.0);
            assert!(turned.min(360.0 - turned) < 1e-3, "{state} {numbers:?}");
        }
    }
}

#[test]
fn states_are_refused_on_a_conveyor() {
    let room = Room::with("small.cut", SMALL);
    let stderr = room.says("compile small.cut -t states --set bite.length_mm=70", 1);
    assert!(stderr.contains("target/refused") && stderr.contains("bite.length_mm"), "{stderr}");
    assert!(!room.has("small.states"));
}
