//! Stitch files at their edges: ends, what stands behind them, moves too long for a record, headers too narrow for a number.

use cutc::diagnostic::Diagnostics;
use cutc::machine::Job;
use cutc::sew::Op;

use super::{broken, fixture, plan, planned, target, written};

/// The codes of what is said of some bytes, and how many stitches are read.
fn read(name: &str, bytes: Vec<u8>) -> (Vec<&'static str>, usize) {
    let (program, _, out) = plan(name, bytes, &Job::default());
    (out.iter().map(|found| found.code.name).collect(), program.map_or(0, |program| program.stitches.count()))
}

#[test]
fn what_stands_behind_the_end_of_a_dst_file_is_told() {
    let sound = fixture("sew/seat.dst");
    let (codes, stitches) = read("x.dst", sound.clone());
    for (behind, is_told) in [(&b"\x1a"[..], false), (&[0; 40], false), (&sound[512..600], true), (b"x", true)] {
        let mut bytes = sound.clone();
        bytes.extend_from_slice(behind);
        let mut expected = codes.clone();
        expected.extend(is_told.then_some("sew/behind-end"));
        assert_eq!(read("x.dst", bytes), (expected, stitches), "{behind:?}");
    }
}

#[test]
fn every_record_ends_a_dst_file_whose_last_byte_says_so() {
    let sound = fixture("sew/seat.dst");
    let expected = read("x.dst", sound.clone());
    for end in [[0x00, 0x00, 0xF3], [0x12, 0x34, 0xF3], [0x00, 0x00, 0xFF], [0x81, 0x00, 0xF7]] {
        let mut bytes = sound.clone();
        let at = bytes.len() - 3;
        bytes[at..].copy_from_slice(&end);
        assert_eq!(read("x.dst", bytes.clone()), expected, "{end:x?}");
        // Nor does the second decoder go on.
        let (program, _, _) = plan("x.dst", bytes.clone(), &Job::default());
        let program = program.expect("it is read");
        let queue = written(&program, &Job::default(), "queue");
        assert_eq!(broken(&program, &bytes, &Job::default(), ("queue", &queue)), [""; 0]);
    }
    // But what is written has the end that every machine knows.
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    let mut bytes = written(&program, &job, "dst");
    let at = bytes.len() - 3;
    bytes[at] = 0x01;
    assert_eq!(broken(&program, &[], &job, ("dst", &bytes)), ["sew-verify/format"]);
}

/// What the target dst says of a queue.
fn said_of_dst(queue: &str, job: &Job) -> Vec<String> {
    let (program, said, _) = plan("x.csv", queue.as_bytes().to_vec(), job);
    let program = program.unwrap_or_else(|| panic!("{said}"));
    let mut out = Diagnostics::default();
    (target("dst").emit.refusals)(&program, job, &mut out);
    out.iter().map(|found| format!("{}: {}", found.code.name, found.message)).collect()
}

#[test]
fn a_long_move_without_a_trim_is_told_of_in_dst() {
    let job = Job::default();
    let head = "op,dx_mm,dy_mm,value\nSTITCH,0,0,\nSTITCH,2,0,\n";
    for (row, cuts) in [
        ("JUMP,24.2,0,\n", 0),
        ("JUMP,24.4,0,\n", 1),
        ("TRIM,,,\nJUMP,90,0,\n", 0),
        ("COLOR,,,2\nJUMP,90,0,\n", 0),
        ("JUMP,90,0,\nSTITCH,0,0,\nSTITCH,2,0,\nJUMP,0,90,\n", 2),
    ] {
        let said = said_of_dst(&format!("{head}{row}STITCH,0,0,\nSTITCH,2,0,\nEND,,,\n"), &job);
        assert_eq!(said.len(), usize::from(cuts > 0), "{row}: {said:?}");
        assert!(said.iter().all(|said| said.starts_with(&format!("sew/jumps-cut: {cuts} moves"))), "{said:?}");
    }
}

/// A stop, which DST has as the next thread, lies between the last stitch and the trim of its thread.
#[test]
fn a_trim_behind_a_stop_is_read_back_as_one() {
    let job = Job::default();
    let pattern = b"x_mm,y_mm,element\n0,0,straight\n20,0,\n\n0,30,straight stop\n20,30,\n".to_vec();
    let trims = |program: &cutc::sew::Program| program.stitches.steps.iter().filter(|step| step.op == Op::Trim).count();
    let (first, _, out) = plan("pattern.csv", pattern, &job);
    let first = first.unwrap_or_else(|| panic!("{:?}", out.iter().map(|found| &found.message).collect::<Vec<_>>()));
    let (again, _, _) = plan("again.dst", written(&first, &job, "dst"), &job);
    assert_eq!(trims(&again.expect("it is read")), trims(&first));
    assert!(trims(&first) > 1);
}

#[test]
fn a_number_too_long_for_the_header_of_a_dst_file_is_refused() {
    let job = Job::default();
    let stops = "COLOR,,,2\nSTITCH,1,0,\n".repeat(1000);
    let said = said_of_dst(&format!("op,dx_mm,dy_mm,value\nSTITCH,0,0,\n{stops}END,,,\n"), &job);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("target/refused") && said[0].contains("999 stops"), "{said:?}");
    let far = "op,dx_mm,dy_mm,value\nJUMP,9999.9,0,\nJUMP,1,0,\nSTITCH,0,0,\nSTITCH,1,0,\nEND,,,\n";
    assert!(said_of_dst(far, &job)[0].contains("99999 tenths"));
    assert_eq!(said_of_dst(&far.replace("JUMP,1,0", "JUMP,-2,0"), &job), [""; 0]);
}

#[test]
fn the_header_of_a_queue_must_be_there() {
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    let queue = String::from_utf8(written(&program, &job, "queue")).expect("text");
    let without = queue.split_once('\n').expect("rows").1;
    assert_eq!(broken(&program, &[], &job, ("queue", without.as_bytes())), ["sew-verify/format"]);
    assert_eq!(
        broken(&program, &[], &job, ("queue", queue.replacen("op", "operation", 1).as_bytes())),
        ["sew-verify/format"]
    );
}

#[test]
fn speeds_of_a_queue_that_are_not_kept_are_told_of() {
    let job = Job::default();
    let program = planned("sew/pocket.csv", &job);
    let queue = String::from_utf8(written(&program, &job, "queue")).expect("text");
    assert_eq!(plan("x.csv", queue.clone().into_bytes(), &job).1, "");
    let (read, said, _) = plan("x.csv", queue.replace("SPEED,,,3200", "SPEED,,,3000").into_bytes(), &job);
    assert!(said.contains("sew/other-speeds") && said.contains("at 3200 rpm instead of 3000 rpm"), "{said}");
    assert_eq!(read.expect("a warning").runs, program.runs);
}

#[test]
fn a_header_with_blanks_is_one_of_a_pattern() {
    let text = "x_mm, y_mm, element\n0, 0, zigzag open\n10, 0,\n";
    let (program, said, _) = plan("x.csv", text.as_bytes().to_vec(), &Job::default());
    let program = program.unwrap_or_else(|| panic!("{said}"));
    assert_eq!((program.format, program.stitches.count()), ("pattern", 11));
}

#[test]
fn a_window_of_a_degree_is_told_of() {
    let mut job = Job::default();
    assert!(!plan("x.csv", fixture("sew/pocket.csv"), &job).1.contains("slow-pattern"));
    job.profile.sewing.feed_end_deg = 251.0;
    let (_, said, _) = plan("x.csv", fixture("sew/pocket.csv"), &job);
    assert!(
        said.contains("sew/slow-pattern") && said.contains("from 250 to 251 degrees is 1.0 degrees wide"),
        "{said}"
    );
}

#[test]
fn a_corner_of_a_box_that_comes_twice_is_one() {
    let text = "x_mm,y_mm,element\n0,0,box-x\n20,0,\n20,0.0000004,\n20,10,\n20,10,\n0,10,\n";
    let job = Job::default();
    let (program, said, _) = plan("x.csv", text.as_bytes().to_vec(), &job);
    let program = program.unwrap_or_else(|| panic!("{said}"));
    let bytes = written(&program, &job, "queue");
    assert_eq!(broken(&program, &[], &job, ("queue", &bytes)), [""; 0]);
    assert!(program.stitches.steps.iter().any(|step| step.op == Op::Stitch && (step.to.x, step.to.y) == (20.0, 10.0)));
}

/// Pitches of the stitches of a pattern, in tenths of a millimetre, and its speeds.
fn sewn(words: &str) -> (Vec<i64>, Vec<f64>) {
    let job = Job::default();
    let text = format!("x_mm,y_mm,element\n0,0,{words}\n12,0,\n");
    let (program, said, _) = plan("x.csv", text.into_bytes(), &job);
    let program = program.unwrap_or_else(|| panic!("{said}"));
    let stitches = program.moves(&job).filter(|entry| entry.step.op == Op::Stitch);
    stitches.map(|entry| ((10.0 * (entry.step.to - entry.from).norm()).round() as i64, entry.rpm)).unzip()
}

#[test]
fn a_seam_has_a_pitch_a_width_a_speed_and_ends_of_its_own() {
    assert_eq!(sewn("open pitch 3").0, [0, 30, 30, 30, 30]);
    assert_eq!(sewn("open pitch 4 speed 1200").1, [400.0, 400.0, 1200.0, 1200.0]);
    // A speed below that of the soft start holds for it, too.
    assert_eq!(sewn("open pitch 4 speed 300").1, [300.0; 4]);
    assert_eq!(sewn("start back-tack end open pitch 4").0, [0, 40, 40, 40, 40, 40, 40, 40, 40, 40]);
    assert_eq!(sewn("open start tie pitch 6").0, [0, 7, 7, 7, 53, 60]);
    // From side to side: an advance of 3 and a width of 4 mm.
    assert_eq!(sewn("zigzag open pitch 3 width 4").0, [0, 50, 50, 50, 50]);
    for (words, fault) in [
        ("pitch", "`` is not a stitch length in mm from 0.05 to 50"),
        ("pitch 0", "`0` is not a stitch length"),
        ("speed fast", "`fast` is not a speed"),
        ("zigzag width -1", "`-1` is not a width"),
        ("width 3", "a width is given for a seam that has none"),
        ("pitch 2 pitch 3", "the pitch is named twice"),
        ("end", "`` is no way to lock an end"),
        ("start tie start open", "what is done at the start is named twice"),
    ] {
        let text = format!("x_mm,y_mm,element\n0,0,{words}\n12,0,\n");
        let (program, said, _) = plan("x.csv", text.into_bytes(), &Job::default());
        assert!(program.is_none() && said.contains(fault) && said.contains("line 2"), "{words}: {said}");
    }
}

#[test]
fn a_seam_of_a_long_pitch_is_laid_closer_where_stitches_are_split() {
    let mut job = Job::default();
    job.profile.sewing.on_long = cutc::machine::sewing::OnLong::Split;
    let text = "x_mm,y_mm,element\n0,0,open pitch 5\n40,0,\n40,30,\n";
    let (program, said, _) = plan("x.csv", text.as_bytes().to_vec(), &job);
    let program = program.unwrap_or_else(|| panic!("{said}"));
    assert!(said.contains("sew/split-stitches") && program.runs[0].rpm == 3200.0, "{said}");
    let queue = written(&program, &job, "queue");
    assert_eq!(broken(&program, &[], &job, ("queue", &queue)), [""; 0]);
}
