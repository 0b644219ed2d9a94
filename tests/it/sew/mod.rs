//! The pattern-sewing machine: what is read, what is sewn how fast, and what is written.

mod audit;
mod command;
mod contours;
mod damage;
mod files;
mod laws;
mod placed;
mod stitch_files;

use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::Job;
use cutc::sew::{self, Asked, Made, Program, TARGETS, Target};
use cutc::source::Source;
use fastrand::Rng;

/// The bytes of a fixture.
fn fixture(name: &str) -> Vec<u8> {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What is planned of some bytes, and what is said of them.
fn plan(name: &str, bytes: Vec<u8>, job: &Job) -> (Option<Program>, String, Diagnostics) {
    plan_as(&Asked::default(), name, bytes, job)
}

/// The same of what is asked for of a file.
fn plan_as(asked: &Asked, name: &str, bytes: Vec<u8>, job: &Job) -> (Option<Program>, String, Diagnostics) {
    let source = Source::new(name.rsplit('/').next().expect("a name"), bytes).expect("small");
    let mut out = Diagnostics::default();
    let program = sew::plan(&source, asked, job, &mut out);
    let said = render(&out, &source);
    (program, said, out)
}

/// What is planned of a fixture.
fn planned(name: &str, job: &Job) -> Program {
    let (program, said, _) = plan(name, fixture(name), job);
    program.unwrap_or_else(|| panic!("{name}: {said}"))
}

/// A target by its name.
fn target(name: &str) -> &'static Target {
    TARGETS.iter().find(|target| target.name == name).expect("a target")
}

/// The bytes of a program.
fn written(program: &Program, job: &Job, name: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    (target(name).emit.write)(program, job, &mut bytes).expect("a vector takes bytes");
    bytes
}

/// Whether a target cannot express a program.
fn refuses(program: &Program, job: &Job, name: &str) -> bool {
    let mut out = Diagnostics::default();
    (target(name).emit.refusals)(program, job, &mut out);
    out.has_errors()
}

/// The codes of the rules that some bytes break, of a program that was made from others.
fn broken(program: &Program, original: &[u8], job: &Job, (name, bytes): (&str, &[u8])) -> Vec<&'static str> {
    let source = Source::new("original", original.to_vec()).expect("small");
    let proof = target(name).proof.expect("the target is judged");
    let verdict = Made { program, source: &source, job }.judge(proof, &mut &bytes[..]).expect("memory is readable");
    verdict.broken().map(|finding| finding.rule.name).collect()
}

/// A stitch file of random records: short moves and long ones, ways back, doubled points, jumps, trims, stops.
fn stitch_file(random: &mut Rng, name: &str) -> Vec<u8> {
    let is_dst = name.ends_with("dst");
    let mut bytes = if is_dst { vec![b' '; 512] } else { Vec::new() };
    bytes.splice(0..0, is_dst.then_some(*b"LA:").into_iter().flatten());
    bytes.truncate(if is_dst { 512 } else { 0 });
    let mut last = [0_i8; 2];
    for _ in 0..random.usize(1..60) {
        // Sums of these are whatever a record can say.
        let way = match random.u8(0..5) {
            0 => [0, 0],
            1 => [random.i8(-2..=2), random.i8(-2..=2)],
            2 => last.map(|way| -way),
            _ => [random.i8(-80..=80), random.i8(-80..=80)],
        };
        last = way;
        let kind = match random.u8(0..20) {
            0..14 => 0,
            14..18 => 1,
            _ => random.u8(1..4),
        };
        for _ in 0..if kind == 1 { random.usize(1..5) } else { 1 } {
            bytes.extend(if is_dst { dst_record(way, kind) } else { exp_record(way, kind) });
        }
    }
    bytes.extend(is_dst.then_some([0, 0, 0xF3]).into_iter().flatten());
    bytes
}

/// A record of a DST file: a stitch, a jump, or a stop.
fn dst_record([x, y]: [i8; 2], kind: u8) -> Vec<u8> {
    let mut bytes = [0, 0, [0x03, 0x83, 0xC3, 0xC3][usize::from(kind)]];
    // Balanced ternary, weight by weight: the byte, and the bits for right, left, up, down.
    let weights = [(2, 0x04, 0x08, 0x20, 0x10), (1, 0x04, 0x08, 0x20, 0x10), (0, 0x04, 0x08, 0x20, 0x10)];
    let small = [(1, 0x01, 0x02, 0x80, 0x40), (0, 0x01, 0x02, 0x80, 0x40)];
    let (mut left, mut weight) = ([i32::from(x), i32::from(y)], 81);
    for (byte, right, leftwards, up, down) in weights.into_iter().chain(small) {
        for (left, [more, less]) in left.iter_mut().zip([[right, leftwards], [up, down]]) {
            if 2 * *left > weight {
                (*left, bytes[byte]) = (*left - weight, bytes[byte] | more);
            } else if 2 * *left < -weight {
                (*left, bytes[byte]) = (*left + weight, bytes[byte] | less);
            }
        }
        weight /= 3;
    }
    bytes.to_vec()
}

/// A record of an EXP file: a stitch, a jump, a trim or another thread.
fn exp_record(way: [i8; 2], kind: u8) -> Vec<u8> {
    let [x, y] = way.map(i8::cast_unsigned);
    match kind {
        0 => vec![x, y],
        1 => vec![0x80, 0x04, x, y],
        2 => vec![0x80, 0x80, 0x07, 0x00],
        _ => vec![0x80, 0x01, x, y],
    }
}
