//! The audit of the readers: what it takes for a fault, and what it does not.

use cutc::machine::Job;
use cutc::sew::{Op, Step};
use fastrand::Rng;

use super::{broken, plan, stitch_file, written};

const SOURCE: [&str; 1] = ["sew-verify/source"];

/// The rules that a file breaks when what is made of it is spoilt.
fn spoilt(name: &str, bytes: &[u8], spoil: impl Fn(&mut Vec<Step>)) -> Vec<&'static str> {
    let job = Job::default();
    let (program, said, _) = plan(name, bytes.to_vec(), &job);
    let mut program = program.unwrap_or_else(|| panic!("{said}"));
    spoil(&mut program.stitches.steps);
    let queue = written(&program, &job, "queue");
    broken(&program, bytes, &job, ("queue", &queue))
}

#[test]
fn a_doubled_point_and_a_way_back_are_no_fault() {
    let bytes = [0x14, 0, 0, 0, 0x14, 0, 0xec, 0, 0x14, 0];
    assert_eq!(spoilt("x.exp", &bytes, |_| {}), [""; 0]);
}

#[test]
fn stitches_that_are_merged_at_the_end_of_a_run_are_no_fault() {
    // Needle points at 2, then beside it on both sides, less than the least pitch away each.
    let queue = b"op,dx_mm,dy_mm,value\nSTITCH,2,0,\nSTITCH,2,0,\nSTITCH,-0.09,0,\nSTITCH,0.18,0,\nTRIM,,,\nJUMP,5,0,\nSTITCH,0,0,\nSTITCH,2,0,\nEND,,,\n";
    assert_eq!(spoilt("x.csv", queue, |_| {}), [""; 0]);
}

#[test]
fn trims_stops_threads_and_jumps_of_a_file_are_compared() {
    let queue = b"op,dx_mm,dy_mm,value\nSTITCH,0,0,\nSTITCH,2,0,\nTRIM,,,\nCOLOR,,,3\nSTOP,,,\nJUMP,9,0,\nSTITCH,0,0,\nSTITCH,2,0,\nEND,,,\n";
    let exp = [0x0a, 0, 0x0a, 0, 0x80, 0x80, 0x07, 0, 0x80, 0x01, 0, 0, 0x80, 0x04, 0x50, 0, 0, 0, 0x0a, 0, 0x0a, 0];
    for (name, bytes) in [("x.csv", &queue[..]), ("x.exp", &exp)] {
        let without = |op: fn(Op) -> bool| spoilt(name, bytes, |steps| steps.retain(|step| !op(step.op)));
        assert_eq!(without(|op| op == Op::Trim), SOURCE, "{name}");
        assert_eq!(without(|op| matches!(op, Op::Color(_))), SOURCE, "{name}");
        let change = |step: &mut Step| {
            if let Op::Color(thread) = &mut step.op {
                *thread += 1;
            }
        };
        assert_eq!(spoilt(name, bytes, |steps| steps.iter_mut().for_each(change)), SOURCE, "{name}");
        let jump = |steps: &mut Vec<Step>| {
            let jump = steps.iter_mut().find(|step| step.op == Op::Jump).expect("a jump");
            jump.to.x += 0.1;
        };
        assert_eq!(spoilt(name, bytes, jump), SOURCE, "{name}");
        assert_eq!(spoilt(name, bytes, |_| {}), [""; 0], "{name}");
    }
    let stop = |steps: &mut Vec<Step>| steps.retain(|step| step.op != Op::Stop);
    assert_eq!(spoilt("x.csv", queue, stop), SOURCE);
}

#[test]
fn no_random_stitch_file_is_refused_by_its_audit() {
    let mut random = Rng::with_seed(77);
    let mut refused = 0;
    for i in 0..600 {
        let mut job = Job::default();
        job.profile.sewing.min_pitch_mm = [0.0, 0.1, 0.5, 1.0][random.usize(0..4)];
        job.profile.sewing.on_long =
            [cutc::machine::sewing::OnLong::Slow, cutc::machine::sewing::OnLong::Split][random.usize(0..2)];
        let name = ["x.dst", "x.exp"][random.usize(0..2)];
        let bytes = stitch_file(&mut random, name);
        let (program, said, _) = plan(name, bytes.clone(), &job);
        let Some(program) = program else {
            assert!(said.contains("error[sew/"), "{i}: {said}");
            refused += 1;
            continue;
        };
        for target in ["queue", "pulses-npy", "dst", "exp"] {
            let made = written(&program, &job, target);
            let broken = broken(&program, &bytes, &job, (target, &made));
            assert!(broken.is_empty(), "{i} {target}: {broken:?} {}", bytes.escape_ascii());
        }
    }
    assert!(refused < 100, "{refused}");
}
