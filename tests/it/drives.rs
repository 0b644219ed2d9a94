//! What the targets `counts`, `hal` and `halrun` promise: the setpoints of `csv`, in the form that drives take.

use std::fs;

use crate::support::room::Room;
use serde_json::Value;

const SMALL: &str = "H1*G71*N1*X0Y0*M14*X400Y0*X400Y400*X0Y400*X0Y0*M15*N2*X600Y0*M14*X640Y0*M15*X600Y200*M43*M01*M0*";

/// Half of the last decimal of `csv`.
const CSV_ROUNDING: f64 = 0.500_001e-6;

/// The numbers of a `csv` program.
fn csv(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().expect("a number")).collect()).collect()
}

/// The header and the records of a `counts` program.
fn counts(bytes: &[u8]) -> (Value, Vec<[i32; 5]>) {
    let (head, records) = bytes.split_at(1024);
    let word = |record: &[u8], i: usize| i32::from_le_bytes(record[4 * i..4 * i + 4].try_into().expect("four bytes"));
    let records = records.chunks_exact(20);
    assert!(records.remainder().is_empty());
    (serde_json::from_slice(head).expect("JSON"), records.map(|r| [0, 1, 2, 3, 4].map(|i| word(r, i))).collect())
}

#[test]
fn counts_are_the_absolute_positions_and_never_drift() {
    let room = Room::with("small.cut", SMALL);
    let profile = "--set c.offset_deg=30 --set c.reverse=true --set counts.x.per_mm=4096 --set counts.x.offset=-77 \
                   --set counts.c.per_deg=2500.5";
    for name in ["small", "circle"] {
        room.says(&format!("compile {name}.cut -t csv,counts {profile}"), 0);
        let (head, records) = counts(&room.read(&format!("{name}.counts")));
        let rows = csv(&room.text(&format!("{name}.csv")));
        assert_eq!(head["rows"], rows.len());
        assert_eq!(rows.len(), records.len());
        for (row, [x, y, c, outputs, block]) in rows.iter().zip(records) {
            let near = |count: i32, exact: f64, per: f64| (f64::from(count) - exact).abs() <= 0.5 + CSV_ROUNDING * per;
            assert!(near(x, row[1] * 4096.0 - 77.0, 4096.0), "{row:?} {x}");
            assert!(near(y, row[2] * 10_000.0, 10_000.0), "{row:?} {y}");
            assert!(near(c, (30.0 - row[3]) * 2500.5, 2500.5), "{row:?} {c}");
            let told = [outputs & 1, outputs >> 4 & 7, outputs >> 8 & 3, block].map(f64::from);
            assert_eq!(told, [row[4], row[5], row[6], row[7]]);
        }
    }
}

#[test]
fn counts_too_coarse_for_the_tolerance_are_refused_before_anything_is_planned() {
    let room = Room::with("small.cut", SMALL);
    let coarse = "compile small.cut -t counts --set counts.x.per_mm=20 --set counts.y.per_mm=20";
    let said = room.says(coarse, 1);
    let refused = "error[target/refused]: counts are too coarse: rounding to them moves the blade by 0.0354 mm";
    assert!(said.contains(refused), "{said}");
    assert!(!room.at("small.counts").exists());
    room.says(&format!("{coarse} --set path.tolerance_mm=0.2"), 0);
}

#[test]
fn counts_are_judged_by_their_own_bytes() {
    let room = Room::with("small.cut", SMALL);
    room.says("compile circle.cut -t counts", 0);
    room.says("verify circle.counts --source circle.cut", 0);
    let sound = room.read("circle.counts");
    let middle = 1024 + (sound.len() - 1024) / 20 / 2 * 20;
    let edited = |at: usize, with: &[u8]| {
        let mut bytes = sound.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        bytes
    };
    let broken = |name: &str, bytes: &[u8], rule: &str| {
        fs::write(room.at("broken.counts"), bytes).expect("writable");
        let said = room.says("verify broken.counts --source circle.cut", 1);
        assert!(said.lines().any(|line| line.starts_with("FAIL") && line.contains(rule)), "{name}: {said}");
    };
    broken("cut short", &sound[..sound.len() - 1], "verify/format");
    broken("a record too many", &[&sound[..], &[0; 20]].concat(), "verify/format");
    broken("an output that is none", &edited(middle + 12, &[0xff]), "verify/format");
    broken("a jump", &edited(middle, &2_000_000_i32.to_le_bytes()), "verify/speed-x");
    broken("a record lost", &[&sound[..middle], &sound[middle + 20..]].concat(), "verify/format");
    let said = room.says("verify circle.counts --source circle.cut --set counts.x.per_mm=5000", 1);
    assert!(said.contains("verify/format"), "another machine: {said}");
}

#[test]
fn a_drive_whose_register_goes_round_is_followed() {
    let room = Room::with("small.cut", SMALL);
    room.says("compile circle.cut -t counts --set counts.c.offset=2147483000 --set counts.x.offset=2147483640", 0);
    let (_, records) = counts(&room.read("circle.counts"));
    assert!(records.windows(2).any(|pair| pair[0][0].abs_diff(pair[1][0]) > 1 << 31), "it goes round");
}

#[test]
fn hal_rows_are_the_setpoints_as_halstreamer_takes_them() {
    let room = Room::with("small.cut", SMALL);
    room.says("compile small.cut -t csv,hal,halrun --set c.offset_deg=-90", 0);
    let text = room.text("small.hal.txt");
    assert!(text.starts_with("# cutc hal") && text.ends_with('\n'));
    let rows = csv(&room.text("small.csv"));
    let lines: Vec<&str> = text.lines().skip(1).collect();
    assert_eq!(rows.len(), lines.len());
    for (row, line) in rows.iter().zip(&lines) {
        let told: Vec<f64> = line.split(' ').map(|field| field.parse().expect("a number")).collect();
        assert!((0..2).all(|i| (told[i] - row[i + 1]).abs() <= CSV_ROUNDING), "{line}");
        assert!((told[2] - (row[3] + 90.0)).abs() <= CSV_ROUNDING, "{line}");
        assert_eq!(told[3..], row[4..]);
    }
    let file = room.text("small.hal");
    assert!(file.contains(&format!("depth={} cfg=fffbuuu", rows.len() + 2)), "{file}");
    assert!(file.contains("halstreamer small.hal.txt") && file.contains("period1=1000000\n"), "{file}");
    room.says("verify small.hal.txt --source small.cut --set c.offset_deg=-90", 0);
    fs::write(room.at("small.hal.txt"), text.replace(" 1 0 0 ", " 2 0 0 ")).expect("writable");
    let said = room.says("verify small.hal.txt --source small.cut --set c.offset_deg=-90", 1);
    assert!(said.contains("verify/format"), "{said}");
}
