//! The verifier of sewn patterns is tested by damage: every way to spoil a program is refused under its rule.

use std::collections::BTreeSet;

use cutc::geom::Point;
use cutc::machine::sewing::{OnLong, Spindle};
use cutc::machine::{Job, Mirror};
use cutc::sew::verify::RULES;
use cutc::sew::{Op, Program, Step};

use super::{broken, fixture, plan, planned, written};

/// A way to damage a program: its name, the target, the rule that it breaks, and what it does.
struct Damage(&'static str, &'static str, &'static str, fn(&mut Vec<String>));

/// The fields of a row.
fn fields(row: &str) -> Vec<String> {
    row.split(',').map(str::to_owned).collect()
}

/// Changes the field of a row.
fn change(row: &mut String, field: usize, change: impl FnOnce(&str) -> String) {
    let mut all = fields(row);
    all[field] = change(&all[field]);
    *row = all.join(",");
}

/// Places of the rows of an entry of a pulse file.
fn of(rows: &[String], entry: u32) -> Vec<usize> {
    (1..rows.len()).filter(|&i| rows[i].starts_with(&format!("{entry},"))).collect()
}

/// Shifts the time of a row, microseconds.
fn shift(row: &mut String, by: f64) {
    change(row, 4, |time| format!("{:.3}", time.parse::<f64>().expect("a time") + by));
}

/// An entry amid the first seam, straight along Y: 48 or more pulses of one axis.
const ENTRY: u32 = 20;
const T_US: usize = 4;
const Y: usize = 6;

#[rustfmt::skip] // a table: a damage a row
const DAMAGES: &[Damage] = &[
    Damage("a pulse is left out", "pulses", "sew-verify/count", |rows| _ = rows.remove(of(rows, ENTRY)[5])),
    Damage("a pulse is left out, so all behind it are off", "pulses", "sew-verify/end-point", |rows| _ = rows.remove(of(rows, ENTRY)[5])),
    Damage("a pulse comes twice", "pulses", "sew-verify/count", |rows| { let i = of(rows, ENTRY)[5]; rows.insert(i, rows[i].clone()); }),
    Damage("a pulse comes twice at the same time", "pulses", "sew-verify/least-interval", |rows| { let i = of(rows, ENTRY)[5]; rows.insert(i, rows[i].clone()); }),
    Damage("a pulse goes back", "pulses", "sew-verify/direction", |rows| { let i = of(rows, ENTRY)[5]; change(&mut rows[i], Y, |_| "1".to_owned()); }),
    Damage("a stitch goes the other way", "pulses", "sew-verify/direction", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], Y, |_| "1".to_owned()); }),
    Damage("a pulse of X for one of Y", "pulses", "sew-verify/count", |rows| { let i = of(rows, ENTRY)[5]; change(&mut rows[i], 5, |_| "1".to_owned()); change(&mut rows[i], Y, |_| "0".to_owned()); }),
    Damage("the first pulse is early", "pulses", "sew-verify/first-interval", |rows| { let i = of(rows, ENTRY)[0]; shift(&mut rows[i], -20.0); }),
    Damage("the last pulse is early", "pulses", "sew-verify/first-interval", |rows| { let i = *of(rows, ENTRY).last().expect("rows"); shift(&mut rows[i], -20.0); }),
    Damage("the last pulse is late", "pulses", "sew-verify/window", |rows| { let i = *of(rows, ENTRY).last().expect("rows"); shift(&mut rows[i], 0.5); }),
    Damage("all pulses are late", "pulses", "sew-verify/window", |rows| for i in of(rows, ENTRY) { shift(&mut rows[i], 2.0); }),
    Damage("a pulse comes before the one before it", "pulses", "sew-verify/time", |rows| { let i = of(rows, ENTRY)[30]; shift(&mut rows[i], -2000.0); }),
    Damage("two pulses too near", "pulses", "sew-verify/least-interval", |rows| { let i = of(rows, ENTRY)[24]; let t: f64 = fields(&rows[i - 1])[T_US].parse().expect("a time"); change(&mut rows[i], T_US, |_| format!("{:.3}", t + 40.0)); }),
    Damage("a pulse of a ramp is early", "pulses", "sew-verify/ramp", |rows| { let i = of(rows, ENTRY)[12]; shift(&mut rows[i], -30.0); }),
    Damage("a pulse of a ramp is a little early", "pulses", "sew-verify/acceleration", |rows| { let i = of(rows, ENTRY)[12]; shift(&mut rows[i], -3.0); }),
    Damage("the spindle is faster for a stitch", "pulses", "sew-verify/steady-speed", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 2, |_| "3000".to_owned()); }),
    Damage("the speed changes amid a stitch", "pulses", "sew-verify/steady-speed", |rows| { let i = of(rows, ENTRY)[9]; change(&mut rows[i], 2, |_| "3000".to_owned()); }),
    Damage("the spindle is faster than it can", "pulses", "sew-verify/speed", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 2, |_| "3300".to_owned()); }),
    Damage("no soft start", "pulses", "sew-verify/speed", |rows| for i in of(rows, 3) { change(&mut rows[i], 2, |_| "3200".to_owned()); }),
    Damage("the spindle stands while it sews", "pulses", "sew-verify/speed", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 2, |_| "0".to_owned()); }),
    Damage("the spindle turns during a jump", "pulses", "sew-verify/speed", |rows| for i in of(rows, 1) { change(&mut rows[i], 2, |_| "400".to_owned()); }),
    Damage("an entry is left out", "pulses", "sew-verify/entries", |rows| rows.retain(|row| !row.starts_with("20,"))),
    Damage("a stitch becomes a jump", "pulses", "sew-verify/entries", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 1, |_| "JUMP".to_owned()); }),
    Damage("another thread", "pulses", "sew-verify/entries", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 3, |_| "2".to_owned()); }),
    Damage("the end is missing", "pulses", "sew-verify/entries", |rows| rows.truncate(2000)),
    Damage("a field is missing", "pulses", "sew-verify/format", |rows| "1,STITCH,400,1,5.000,1".clone_into(&mut rows[77])),
    Damage("a time is no number", "pulses", "sew-verify/format", |rows| change(&mut rows[77], T_US, |_| "nan".to_owned())),
    Damage("a pulse of two steps", "pulses", "sew-verify/format", |rows| change(&mut rows[77], Y, |_| "2".to_owned())),
    Damage("another header", "pulses", "sew-verify/format", |rows| "entry,op,rpm,thread,t_ms,x,y".clone_into(&mut rows[0])),
    Damage("an increment is off", "queue", "sew-verify/end-point", |rows| change(&mut rows[15], 2, |dy| format!("{:.4}", dy.parse::<f64>().expect("mm") + 0.1))),
    Damage("a trim is left out", "queue", "sew-verify/entries", |rows| { let i = rows.iter().position(|row| row.starts_with("TRIM")).expect("a trim"); rows.remove(i); }),
    Damage("a stitch is left out", "queue", "sew-verify/end-point", |rows| _ = rows.remove(20)),
    Damage("a jump is sewn", "queue", "sew-verify/entries", |rows| rows[1] = rows[1].replace("JUMP", "STITCH")),
    Damage("another colour", "queue", "sew-verify/entries", |rows| for row in rows { if row == "COLOR,,,2" { "COLOR,,,3".clone_into(row); } }),
    Damage("a speed too high", "queue", "sew-verify/speed", |rows| for row in rows { if row == "SPEED,,,3200" { "SPEED,,,3300".clone_into(row); } }),
    Damage("a speed at which nothing fits", "queue", "sew-verify/window", |rows| for row in rows { if row == "SPEED,,,3200" { "SPEED,,,3900".clone_into(row); } }),
    Damage("the speed changes amid a run", "queue", "sew-verify/steady-speed", |rows| rows.insert(30, "SPEED,,,3000".to_owned())),
    Damage("no speed before the first stitch", "queue", "sew-verify/speed", |rows| _ = rows.remove(2)),
    Damage("END is missing", "queue", "sew-verify/format", |rows| _ = rows.pop()),
    Damage("a word that is none", "queue", "sew-verify/format", |rows| "HOP,1.0000,1.0000,".clone_into(&mut rows[9])),
];

#[rustfmt::skip] // a table: a damage a row
const EASED_DAMAGES: &[Damage] = &[
    Damage("the spindle is slower for a stitch", "pulses", "sew-verify/spindle", |rows| for i in of(rows, ENTRY) { change(&mut rows[i], 2, |_| "1000".to_owned()); }),
    Damage("the spindle recovers too fast", "queue", "sew-verify/spindle", |rows| { let i = rows.iter().position(|row| row.starts_with("SPEED,,,7")).expect("a speed"); "SPEED,,,1400".clone_into(&mut rows[i]); }),
    Damage("the spindle does not slow down", "queue", "sew-verify/window", |rows| for row in rows { if row == "SPEED,,,1720" { "SPEED,,,1800".clone_into(row); } }),
    Damage("the soft start is left out", "queue", "sew-verify/speed", |rows| for row in rows { if row == "SPEED,,,400" { "SPEED,,,800".clone_into(row); } }),
];

#[test]
fn every_damage_of_eased_speeds_is_refused_under_its_rule() {
    let mut job = Job::default();
    job.profile.sewing.spindle = Spindle::Eased;
    let program = planned("sew/one-long-stitch.csv", &job);
    for Damage(name, target, rule, run) in EASED_DAMAGES {
        let text = String::from_utf8(written(&program, &job, target)).expect("text");
        let mut rows: Vec<String> = text.lines().map(str::to_owned).collect();
        run(&mut rows);
        let broken = broken(&program, &[], &job, (target, &bytes(&rows)));
        assert!(broken.contains(rule), "{name}: {rule} holds, but {broken:?} do not");
    }
}

/// Rows as bytes again.
fn bytes(rows: &[String]) -> Vec<u8> {
    rows.iter().flat_map(|row| [row.as_bytes(), b"\n"].concat()).collect()
}

#[test]
fn every_damage_of_rows_is_refused_under_its_rule() {
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    for Damage(name, target, rule, run) in DAMAGES {
        let text = String::from_utf8(written(&program, &job, target)).expect("text");
        let mut rows: Vec<String> = text.lines().map(str::to_owned).collect();
        run(&mut rows);
        let broken = broken(&program, &[], &job, (target, &bytes(&rows)));
        assert!(broken.contains(rule), "{name}: {rule} holds, but {broken:?} do not");
    }
}

/// A way to damage the bytes of a file: its name, the target, the rule, and what it does.
type ByteDamage = (&'static str, &'static str, &'static str, fn(&mut Vec<u8>));

const DST_BODY: usize = 512;
const NPY_BODY: usize = 256;
/// Offsets of the stitches of the pocket: of one thread, two with the next.
const PES_STITCHES: usize = 22 + 532;
const JEF_STITCHES: usize = 116 + 8 * 2;

#[rustfmt::skip] // a table: a damage a row
const BYTE_DAMAGES: &[ByteDamage] = &[
    ("a stitch of a DST file is a tenth longer", "dst", "sew-verify/needle-point", |bytes| bytes[DST_BODY + 90] ^= 0x01),
    ("a stitch of a DST file is left out", "dst", "sew-verify/entries", |bytes| _ = bytes.drain(DST_BODY + 90..DST_BODY + 93)),
    ("a stitch of a DST file becomes a jump", "dst", "sew-verify/entries", |bytes| bytes[DST_BODY + 92] |= 0x80),
    ("a DST file without its end", "dst", "sew-verify/format", |bytes| bytes.truncate(bytes.len() - 3)),
    ("a record of a DST file that is none", "dst", "sew-verify/format", |bytes| bytes[DST_BODY + 92] = 0x00),
    ("bytes behind the end of a DST file", "dst", "sew-verify/format", |bytes| bytes.push(0x1A)),
    ("a header that counts otherwise", "dst", "sew-verify/header", |bytes| bytes[DST_BODY - 482] = b'7'),
    ("a trim of a DST file is left out", "dst", "sew-verify/commands", |bytes| {
        let trim = [0x85, 0x85, 0x83];
        let at = (DST_BODY..bytes.len()).step_by(3).find(|&i| bytes[i] == trim[0] || bytes[i + 2] == 0x83 && i > DST_BODY + 300);
        let at = at.expect("a trim");
        bytes.drain(at..at + 9);
    }),
    ("a stitch of an EXP file is longer", "exp", "sew-verify/needle-point", |bytes| bytes[61] = bytes[61].wrapping_add(2)),
    ("an EXP file that is cut off", "exp", "sew-verify/format", |bytes| _ = bytes.pop()),
    ("a command of an EXP file that is none", "exp", "sew-verify/format", |bytes| { let i = (0..bytes.len()).find(|&i| bytes[i] == 0x80).expect("a jump"); bytes[i + 1] = 0x55; }),
    ("a trim of an EXP file is left out", "exp", "sew-verify/commands", |bytes| { let i = bytes.windows(2).position(|two| two == [0x80, 0x80]).expect("a trim"); bytes.drain(i..i + 4); }),
    ("a stitch of a PES file is longer", "pes", "sew-verify/needle-point", |bytes| { let i = PES_STITCHES + 20; bytes[i] ^= 0x04; }),
    ("a stitch of a PES file is left out", "pes", "sew-verify/entries", |bytes| _ = bytes.drain(PES_STITCHES + 20..PES_STITCHES + 22)),
    ("a PES file without its end", "pes", "sew-verify/format", |bytes| bytes.truncate(PES_STITCHES + 60)),
    ("bytes behind a PES file", "pes", "sew-verify/format", |bytes| bytes.push(0)),
    ("a PES file with another number of threads", "pes", "sew-verify/header", |bytes| bytes[PES_STITCHES - 532 + 48] += 1),
    ("a PES file of another width", "pes", "sew-verify/header", |bytes| bytes[PES_STITCHES - 532 + 520] += 1),
    ("a trim of a PES file is left out", "pes", "sew-verify/commands", |bytes| {
        let i = (PES_STITCHES..bytes.len()).find(|&i| bytes[i] & 0xF0 == 0xA0 && bytes[i + 2] & 0xF0 == 0xA0).expect("a trim");
        (bytes[i], bytes[i + 2]) = (bytes[i] ^ 0x30, bytes[i + 2] ^ 0x30);
    }),
    ("a stitch of a JEF file is longer", "jef", "sew-verify/needle-point", |bytes| bytes[JEF_STITCHES + 61] ^= 0x02),
    ("a stitch of a JEF file is left out", "jef", "sew-verify/entries", |bytes| _ = bytes.drain(JEF_STITCHES + 60..JEF_STITCHES + 62)),
    ("a JEF file without its end", "jef", "sew-verify/format", |bytes| bytes.truncate(bytes.len() - 2)),
    ("bytes behind a JEF file", "jef", "sew-verify/format", |bytes| bytes.push(0)),
    ("a command of a JEF file that is none", "jef", "sew-verify/format", |bytes| { let i = (JEF_STITCHES..bytes.len()).find(|&i| bytes[i] == 0x80).expect("a jump"); bytes[i + 1] = 0x55; }),
    ("a JEF file with another number of points", "jef", "sew-verify/header", |bytes| bytes[28] ^= 1),
    ("a JEF file with another reach", "jef", "sew-verify/header", |bytes| bytes[36] ^= 1),
    ("a trim of a JEF file is left out", "jef", "sew-verify/commands", |bytes| { let trim = [0x80, 2, 0, 0].repeat(3); let i = bytes.windows(12).position(|twelve| twelve == trim).expect("a trim"); bytes.drain(i..i + 12); }),
    ("an array that is cut off", "pulses-npy", "sew-verify/format", |bytes| bytes.truncate(bytes.len() - 5)),
    ("bytes behind an array", "pulses-npy", "sew-verify/format", |bytes| bytes.push(0)),
    ("a time of an array that is none", "pulses-npy", "sew-verify/format", |bytes| bytes[NPY_BODY..NPY_BODY + 8].copy_from_slice(&f64::NAN.to_le_bytes())),
    ("an operation of an array that is none", "pulses-npy", "sew-verify/format", |bytes| bytes[NPY_BODY + 16] = 9),
    ("a pulse of an array goes back", "pulses-npy", "sew-verify/direction", |bytes| bytes[NPY_BODY + 18] = 0xFF),
    ("another type of a field", "pulses-npy", "sew-verify/format", |bytes| { let i = bytes.windows(3).position(|three| three == b"<f8").expect("a type"); bytes[i + 2] = b'4'; }),
];

#[test]
fn every_damage_of_bytes_is_refused_under_its_rule() {
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    for (name, target, rule, run) in BYTE_DAMAGES {
        let mut bytes = written(&program, &job, target);
        run(&mut bytes);
        let broken = broken(&program, &[], &job, (target, &bytes));
        assert!(broken.contains(rule), "{name}: {rule} holds, but {broken:?} do not");
    }
}

/// A way to spoil what is laid: its name, the rule, and what it does to the steps.
type LaidDamage = (&'static str, &'static str, fn(&mut Vec<Step>));

#[rustfmt::skip] // a table: a damage a row
const LAID_DAMAGES: &[LaidDamage] = &[
    ("a stitch beside its seam", "sew-verify/on-seam", |steps| steps[15].to.x += 0.2),
    ("a corner without a needle point", "sew-verify/corner", |steps| steps.retain(|step| step.op != Op::Stitch || (step.to.x - 85.0).abs() + (step.to.y - 60.0).abs() > 0.5)),
    ("a stitch that is too long", "sew-verify/long-pitch", |steps| _ = steps.drain(12..18)),
    ("a stitch that is too short", "sew-verify/short-pitch", |steps| { let mut step = steps[15]; step.to.y -= 0.05; steps.insert(16, step); }),
];

#[test]
fn every_damage_of_what_is_laid_is_refused_under_its_rule() {
    let job = Job::default();
    for (name, rule, run) in LAID_DAMAGES {
        let mut program: Program = planned("sew/pocket.csv", &job);
        run(&mut program.stitches.steps);
        let bytes = written(&program, &job, "dst");
        let broken = broken(&program, &[], &job, ("dst", &bytes));
        assert!(broken.contains(rule), "{name}: {rule} holds, but {broken:?} do not");
    }
}

#[test]
fn the_pitch_and_the_speed_of_a_seam_are_held_against_what_is_sewn() {
    let job = Job::default();
    let text = b"x_mm,y_mm,element\n0,0,straight pitch 2 speed 1200\n40,0,\n\n0,9,\n40,9,\n".to_vec();
    let (program, said, _) = plan("x.csv", text, &job);
    let mut program = program.unwrap_or_else(|| panic!("{said}"));
    let queue = String::from_utf8(written(&program, &job, "queue")).expect("text");
    assert_eq!(broken(&program, &[], &job, ("queue", queue.as_bytes())), [""; 0]);
    let faster = queue.replace("SPEED,,,1200", "SPEED,,,1300");
    assert_eq!(broken(&program, &[], &job, ("queue", faster.as_bytes())), ["sew-verify/speed"]);
    // A needle point less doubles a stitch to 4 mm.
    program.stitches.steps.remove(10);
    let queue = written(&program, &job, "queue");
    assert!(broken(&program, &[], &job, ("queue", &queue)).contains(&"sew-verify/long-pitch"));
}

/// A way in which a reader of stitch files could go wrong: its name, and what it makes of the steps.
type ReadDamage = (&'static str, fn(&mut Vec<Step>));

#[rustfmt::skip] // a table: a damage a row
const READ_DAMAGES: &[ReadDamage] = &[
    ("a stitch is lost", |steps| _ = steps.remove(30)),
    ("a stitch is made up", |steps| { let mut step = steps[30]; step.to.x += 1.0; steps.insert(30, step); }),
    ("all stitches behind one are displaced", |steps| steps[50..].iter_mut().for_each(|step| step.to.y += 0.1)),
    ("the last stitch is lost", |steps| { let i = steps.iter().rposition(|step| step.op == Op::Stitch).expect("a stitch"); steps.remove(i); }),
];
const SOURCE: &str = "sew-verify/source";

#[test]
fn every_fault_of_a_reader_of_stitch_files_is_seen() {
    let job = Job::default();
    for name in [
        "sew/seat.dst",
        "sew/three-seams.exp",
        "sew/leaf.pes",
        "sew/leaf.jef",
        "sew/leaf.vp3",
        "sew/leaf.xxx",
        "sew/leaf.u01",
    ] {
        for (damage, run) in READ_DAMAGES {
            let mut program = planned(name, &job);
            run(&mut program.stitches.steps);
            let bytes = written(&program, &job, "exp");
            let broken = broken(&program, &fixture(name), &job, ("exp", &bytes));
            assert!(broken.contains(&SOURCE), "{name}, {damage}: {broken:?}");
        }
    }
    // What is split is no fault.
    let mut job = job;
    job.profile.sewing.on_long = OnLong::Split;
    let program = planned("sew/three-seams.exp", &job);
    assert!(program.stitches.count() > planned("sew/three-seams.exp", &Job::default()).stitches.count());
    let bytes = written(&program, &job, "exp");
    assert_eq!(broken(&program, &fixture("sew/three-seams.exp"), &job, ("exp", &bytes)), [""; 0]);
}

/// A way to place a pattern wrongly: its name, the rule, and what it does to the program.
type PlaceDamage = (&'static str, &'static str, fn(&mut Program));

#[rustfmt::skip] // a table: a damage a row
const PLACE_DAMAGES: &[PlaceDamage] = &[
    ("a pattern that is not mirrored", "sew-verify/placed", |program| program.pattern = program.drawn.clone()),
    ("another pitch than that of the file", "sew-verify/placed", |program| program.pattern.as_mut().expect("a pattern").seams[0].pitch = Some(1.0)),
    ("a seam that is left out", "sew-verify/placed", |program| _ = program.pattern.as_mut().and_then(|pattern| pattern.seams.pop())),
    ("a needle point outside the field", "sew-verify/field", |program| program.stitches.steps[15].to.x += 500.0),
];

#[test]
fn a_pattern_in_another_place_is_refused() {
    let mut job = Job::default();
    job.profile.sheet.mirror = Mirror::Ends;
    job.profile.table.x_mm = Some([-10.0, 400.0]);
    for (name, rule, run) in PLACE_DAMAGES {
        let mut program: Program = planned("sew/pocket.csv", &job);
        assert_eq!(broken(&program, &[], &job, ("dst", &written(&program, &job, "dst"))), [""; 0]);
        run(&mut program);
        let bytes = written(&program, &job, "dst");
        let broken = broken(&program, &[], &job, ("dst", &bytes));
        assert!(broken.contains(rule), "{name}: {rule} holds, but {broken:?} do not");
    }
}

#[test]
fn every_rule_is_broken_by_a_damage() {
    let rows = DAMAGES.iter().chain(EASED_DAMAGES).map(|Damage(_, _, rule, _)| *rule);
    let bytes = BYTE_DAMAGES.iter().map(|row| row.2);
    let laid = LAID_DAMAGES.iter().map(|row| row.1);
    let aimed: BTreeSet<&str> = rows
        .chain(bytes)
        .chain(laid)
        .chain(PLACE_DAMAGES.iter().map(|row| row.1))
        .chain([SOURCE, COVER, CURVE, ORDER])
        .collect();
    assert_eq!(aimed, RULES.iter().map(|row| row.name).collect());
}

/// Rules of a satin and of curves, which have tests of their own.
const COVER: &str = "sew-verify/cover";
const CURVE: &str = "sew-verify/curve";
/// Rule of the order of seams.
const ORDER: &str = "sew-verify/order";

#[test]
fn a_satin_with_a_gap_or_a_stitch_outside_is_refused() {
    let job = Job::default();
    let spoilt = |spoil: fn(&mut Vec<Step>)| {
        let mut program = planned("sew/satin.csv", &job);
        spoil(&mut program.stitches.steps);
        let bytes = written(&program, &job, "queue");
        broken(&program, &[], &job, ("queue", &bytes))
    };
    assert!(spoilt(|steps| _ = steps.drain(20..24)).contains(&COVER));
    assert!(spoilt(|steps| steps[20].to.y += 4.0).contains(&"sew-verify/on-seam"));
}

#[test]
fn an_arc_or_circle_beside_its_curve_is_refused() {
    let job = Job::default();
    let spoilt = |seam: usize, spoil: fn(&mut Vec<Point>)| {
        let mut program = planned("sew/round.csv", &job);
        for pattern in [&mut program.drawn, &mut program.pattern].into_iter().flatten() {
            spoil(&mut pattern.seams[seam].points);
        }
        let bytes = written(&program, &job, "queue");
        broken(&program, &[], &job, ("queue", &bytes))
    };
    assert!(!spoilt(1, |_| {}).contains(&CURVE));
    assert!(spoilt(0, |points| points[5].y += 0.2).contains(&CURVE));
    assert!(spoilt(1, |points| _ = points.drain(5..30)).contains(&CURVE));
    assert!(spoilt(1, |points| points.reverse()).contains(&CURVE));
    assert!(spoilt(3, |points| *points = vec![points[0], points[points.len() - 1]]).contains(&CURVE));
}

#[test]
fn seams_in_another_order_than_that_of_their_numbers_are_refused() {
    let job = Job::default();
    let mut program = planned("sew/order.csv", &job);
    let judged = |program: &Program| broken(program, &[], &job, ("queue", &written(program, &job, "queue")));
    assert_eq!(judged(&program), [""; 0]);
    let first: BTreeSet<u32> = program.stitches.steps.iter().map(|step| step.record).take(2).collect();
    assert_eq!(first, BTreeSet::from([8]));
    if let Some(pattern) = &mut program.pattern {
        pattern.seams[0].order = Some(1);
    }
    assert!(judged(&program).contains(&ORDER));
}
