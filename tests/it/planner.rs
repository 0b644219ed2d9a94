//! F of G-code: what the axes can follow and the planner of the controller takes.

use std::io::Cursor;
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::machine::gcode::{FeedCounts, FeedMode};
use cutc::machine::{Job, Shipped, load};
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use cutc::units::S_PER_MIN;
use cutc::verify::{self, Ground};

fn fixture(name: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    Source::new(name, std::fs::read(path).expect("readable")).expect("fixtures are small")
}

/// The job of a profile that ships.
fn shipped(name: &str) -> Job {
    let profile = load(Some(&Shipped::find(name).expect("it ships").source()), &[]).expect("a legal profile");
    Job { profile, ..Job::default() }
}

/// The program of a source, which must be sound.
fn program(source: &Source, job: &Job) -> String {
    let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes it");
    assert!(compiled.is_some(), "{found:?}");
    String::from_utf8(out.into_inner()).expect("ASCII")
}

/// The number behind a letter in a line.
fn word(line: &str, letter: char) -> Option<f64> {
    line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse().ok())
}

/// Length of X and Y, mm, turn of the axis A, degrees, and F of each move with F, as the lines tell them.
fn moves(program: &str) -> Vec<[f64; 3]> {
    let mut at = [0.0; 3];
    let mut moves = Vec::new();
    for line in program.lines() {
        let (Some(x), Some(y), Some(a)) = (word(line, 'X'), word(line, 'Y'), word(line, 'A')) else { continue };
        let chord = (x - at[0]).hypot(y - at[1]);
        let length = word(line, 'I').zip(word(line, 'J')).map_or(chord, |(i, j)| {
            let radius = i.hypot(j);
            2.0 * radius * (chord / (2.0 * radius)).min(1.0).asin()
        });
        moves.extend(word(line, 'F').map(|f| [length, (a - at[2]).abs(), f]));
        at = [x, y, a];
    }
    moves
}

#[test]
fn f_of_inverse_time_asks_for_no_more_than_c_can_turn_and_the_controller_can_plan() {
    let job = shipped("fluidnc");
    let [_, _, c] = job.profile.axes.limits();
    let most = job.profile.gcode.max_blocks_s.expect("it plans few moves a second") * S_PER_MIN;
    let program = program(&fixture("markers/tight-curves-and-short-runs.cut"), &job);
    let mut capped = 0;
    for [_, turned, f] in moves(&program) {
        assert!(turned * f / S_PER_MIN <= c.speed.to_degrees() * 1.001 && f <= most + 1e-3, "{turned} {f}");
        capped += usize::from(f > most - 1e-3);
    }
    assert!(capped > 20, "{capped} moves are as short as they may be");
}

#[test]
fn f_that_counts_degrees_asks_for_the_time_of_f_that_does_not_and_is_refused_where_it_is_not_asked_for() {
    for name in ["fluidnc-arcs", "grblhal"] {
        let mut all = shipped(name);
        all.profile.gcode.feed_mode = FeedMode::G94;
        // Otherwise moves may be so slow that they are legal at a higher speed, too.
        all.profile.gcode.max_blocks_s = None;
        let mut linear = all.clone();
        linear.profile.gcode.feed_counts = FeedCounts::Linear;
        let source = fixture("markers/circles.cut");
        let [counted, plain] = [&all, &linear].map(|job| program(&source, job));
        let (counted_moves, plain_moves) = (moves(&counted), moves(&plain));
        assert!(counted_moves.len() == plain_moves.len() && !plain_moves.is_empty(), "{name}");
        for ([length, turned, f], [.., plain]) in counted_moves.iter().zip(&plain_moves) {
            let ratio = length.hypot(*turned) / length;
            // Both ends are rounded to four decimals.
            assert!((f / plain / ratio - 1.0).abs() < 1e-3 + 2e-4 / length, "{name}: {length} {turned} {f} {plain}");
        }
        assert!(counted_moves.iter().zip(&plain_moves).any(|([.., f], [.., plain])| *f > 1.5 * plain), "{name}");
        let mut said = Diagnostics::default();
        let input = pipeline::read(&source, None, &linear, &mut said).expect("it is read");
        let ground = Ground::new(&input.marker, &linear.profile);
        let verdict = verify::positions(&mut counted.as_bytes(), None, &ground, &linear);
        assert!(verdict.broken().any(|finding| finding.rule.name == "verify/feed"), "{name}");
    }
}
