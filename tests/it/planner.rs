//! F of G-code: what the axes can follow and the planner of the controller takes.

use std::io::Cursor;
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::machine::{Job, load};
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use cutc::units::S_PER_MIN;

fn fixture(name: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    Source::new(name, std::fs::read(path).expect("readable")).expect("fixtures are small")
}

#[test]
fn f_of_inverse_time_asks_for_no_more_than_c_can_turn_and_the_controller_can_plan() {
    let word = |line: &str, letter: char| -> Option<f64> {
        line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse().ok())
    };
    let profile = load(Some(&fixture("machines/fluidnc.toml")), &[]).expect("a legal profile");
    let job = Job { profile, ..Job::default() };
    let [_, _, c] = job.profile.axes.limits();
    let most = job.profile.gcode.max_blocks_s.expect("it plans few moves a second") * S_PER_MIN;
    let letter = char::from(job.profile.gcode.letter.byte());
    let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    let source = fixture("markers/tight-curves-and-short-runs.cut");
    let compiled = pipeline::compile(&source, &job, order, &mut out, &mut found).expect("memory takes it");
    assert!(compiled.is_some(), "{found:?}");
    let program = String::from_utf8(out.into_inner()).expect("ASCII");
    let (mut capped, mut stood) = (0, 0.0);
    for line in program.lines() {
        let Some(to) = word(line, letter) else { continue };
        let turned = (to - stood).abs();
        stood = to;
        let Some(f) = word(line, 'F') else { continue };
        assert!(turned * f / S_PER_MIN <= c.speed.to_degrees() * 1.001 && f <= most + 1e-3, "{line}");
        capped += usize::from(f > most - 1e-3);
    }
    assert!(capped > 20, "{capped} moves are as short as they may be");
}
