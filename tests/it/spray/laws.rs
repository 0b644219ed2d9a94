//! Laws over many shapes: whatever is followed is verified, and the same whichever way it is drawn.

use std::fmt::Write as _;

use cutc::source::Source;
use fastrand::Rng;

use super::{compiled, job};

/// A smooth part with some waves, as a file; backwards when asked.
fn waves(random: &mut Rng, is_backwards: bool) -> Source {
    let (count, radius) = (random.usize(500..900), random.f64() * 400.0 + 300.0);
    let waves: Vec<[f64; 3]> =
        (2..5).map(|k| [f64::from(k), random.f64() * 0.12 * radius / f64::from(k), random.f64() * 6.0]).collect();
    let at = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / count as f64;
        let out: f64 = radius + waves.iter().map(|[k, high, phase]| high * (k * angle + phase).sin()).sum::<f64>();
        format!("{:.4},{:.4}\n", out * angle.cos(), out * angle.sin())
    };
    let mut rows: Vec<String> = (0..=count).map(|i| at(i % count)).collect();
    if is_backwards {
        rows.reverse();
    }
    Source::new("waves.csv", format!("x_mm,y_mm\n{}", rows.concat()).into_bytes()).expect("small")
}

#[test]
fn whatever_is_followed_is_verified() {
    let mut random = Rng::with_seed(1928);
    for case in 0..12 {
        let distance = format!("tool.distance_mm={}", random.u32(30..350));
        let source = waves(&mut random, case % 2 == 1);
        for planner in ["tool.planner=optimal", "tool.planner=quintic"] {
            let head = job(&[&distance, planner, "table.x_mm=unlimited", "table.y_mm=unlimited"]);
            if let Err(said) = compiled(&source, "csv", &head) {
                panic!("case {case}, {distance}, {planner}: {said}\n{}", String::from_utf8_lossy(source.bytes()));
            }
        }
    }
}

#[test]
fn the_way_of_drawing_does_not_matter_and_programs_are_the_same_each_time() {
    let drawn = |is_backwards| waves(&mut Rng::with_seed(5), is_backwards);
    let head = job(&["table.x_mm=unlimited", "table.y_mm=unlimited", "tool.planner=quintic"]);
    let of = |source: &Source| {
        let (compiled, bytes, _) = compiled(source, "csv", &head).unwrap_or_else(|said| panic!("{said}"));
        (compiled.report.program.time_s.expect("a time"), bytes)
    };
    let (time, bytes) = of(&drawn(false));
    assert_eq!(of(&drawn(false)).1, bytes);
    let (back, _) = of(&drawn(true));
    assert!((time - back).abs() < 0.01, "{time} s, backwards {back} s");
}

#[test]
fn tangled_contours_are_followed_or_refused_but_never_end_in_a_panic() {
    let mut random = Rng::with_seed(28);
    for case in 0..300 {
        // Few places on a coarse grid: contours that cross, touch and repeat themselves, spikes, parts upon each other.
        let mut text = String::from("x_mm,y_mm\n");
        for _ in 0..random.usize(1..4) {
            let points: Vec<[u32; 2]> =
                (0..random.usize(3..12)).map(|_| [random.u32(0..12) * 100, random.u32(0..12) * 100]).collect();
            for [x, y] in points.iter().chain(&points[..1]) {
                // Writing into a `String` cannot fail.
                let _ = writeln!(text, "{x},{y}");
            }
            text.push('\n');
        }
        let source = Source::new("tangle.csv", text.into_bytes()).expect("small");
        let head = job(&["tool.distance_mm=60", "table.x_mm=unlimited", "table.y_mm=unlimited", "time.period_ms=10"]);
        let tried = std::panic::catch_unwind(|| drop(compiled(&source, "csv", &head)));
        assert!(tried.is_ok(), "case {case}: {}", String::from_utf8_lossy(source.bytes()));
    }
}
