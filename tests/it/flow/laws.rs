//! What holds of every plan: it stays under its bounds, gives the same bytes again, and follows cloth that wanders.

use cutc::flow::verify::{self, Bytes, Ground};
use cutc::flow::{Kind, Speed};
use cutc::ir::Marker;

use super::{Planned, broken, job, plan, planned, target, written};

/// The machine of the bounds in the manual: no feed, 1000 mm/s, 1440 degrees/s, 0.15 s for lift and plunge.
fn bound_job(travel: f64) -> cutc::machine::Job {
    let travel = format!("flow.travel_mm={travel}");
    let sets = [&travel, "flow.max_speed_mm_s=1000", "knife.plunge_ms=75", "knife.clear_ms=75", "knife.lift_ms=75"];
    job(&[&sets[..], &["knife.feed_mm_s=off", "corner.angle_deg=20", "flow.row_pitch_mm=600"]].concat())
}

#[test]
fn a_rectangle_is_cut_below_the_speed_that_its_edges_across_the_feed_allow() {
    for (travel, bound, least) in [(50.0, 121.21, 0.5), (200.0, 484.85, 0.5), (500.0, 1000.0, 0.4)] {
        let job = bound_job(travel);
        let (planned, said) = plan("flow/rectangle.csv", Speed::Most, &job);
        let planned = planned.unwrap_or_else(|| panic!("{said}"));
        let speed = planned.program.speed;
        let own = planned.program.figures.speed_bound_mm_s;
        assert!((own - bound).abs() < 0.01, "{travel} mm: bound {own} mm/s");
        assert!(speed < bound && speed > least * bound, "{travel} mm: {speed} of {bound} mm/s");
        assert_eq!(broken(&planned, &job), [""; 0], "{travel} mm");
    }
}

#[test]
fn a_circle_takes_more_travel_than_without_accelerations() {
    let job = job(&["flow.travel_mm=80", "knife.width_mm=0", "knife.radius_mm=0", "knife.back_mm=0"]);
    let planned = planned("flow/circle.csv", 200.0, &job);
    let figures = &planned.program.figures;
    assert!(figures.travel_bound_mm > 1.98 && figures.travel_mm > figures.travel_bound_mm, "{figures:?}");
    assert_eq!(broken(&planned, &job), [""; 0]);
}

#[test]
fn three_diamonds_take_four_heads_in_two_rows_where_the_conveyor_is_slow() {
    let job = job(&["flow.travel_mm=100"]);
    let figures = |speed: f64| planned("flow/diamonds.csv", speed, &job).program.figures;
    let slow = figures(50.0);
    assert_eq!((slow.heads, slow.heads_bound, slow.rows), (4, 4, 2));
    let fast = figures(160.0);
    assert!(fast.heads >= 4 && fast.heads <= 6 && fast.rows >= 2, "{fast:?}");
}

#[test]
fn the_same_marker_gives_the_same_bytes_on_any_number_of_threads() {
    let job = job(&[]);
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| written(&planned("flow/diamonds.csv", 100.0, &job), &job, "csv"))
    };
    assert_eq!(bytes(1), bytes(4));
}

/// How far wandering cloth lies to +Y when the conveyor is at a position, mm.
fn wander(conveyor: f64) -> f64 {
    8.0 * (conveyor / 400.0).sin()
}

#[test]
fn heads_follow_cloth_that_wanders_sideways() {
    let job = job(&["axes.y.speed_mm_s=1010", "axes.y.acceleration_mm_s2=10100", "axes.y.jerk_mm_s3=4.1e5"]);
    let planned = planned("flow/two-discs.csv", 100.0, &super::job(&[]));
    let Planned { marker, program } = &planned;
    let plan = written(&planned, &job, "csv").0;
    let Kind::Heads { write, .. } = target("csv").kind else { panic!("csv is a program") };
    let bytes = |head: &cutc::flow::Head| {
        let mut bytes = Vec::new();
        write(program, head, &wander, &mut bytes).expect("a vector takes bytes");
        bytes
    };
    let heads: Vec<Vec<u8>> = program.heads.iter().map(bytes).collect();
    let judge = |marker: &Marker, shift: &(dyn Fn(f64) -> f64 + Sync)| {
        let ground = Ground { marker, profile: &job.profile, shift };
        let mut open = |i: usize| -> std::io::Result<Box<dyn std::io::BufRead>> {
            Ok(Box::new(std::io::Cursor::new(heads[i].clone())))
        };
        verify::judge(&plan, Bytes::Rows, &mut open, &ground).expect("memory is readable")
    };
    let broken = |verdict: &verify::Verdict| verdict.broken().map(|seen| seen.finding.rule).collect::<Vec<_>>();
    let there = broken(&judge(marker, &wander));
    assert!(there.is_empty(), "{there:?}");
    assert!(!broken(&judge(marker, &cutc::flow::straight)).is_empty(), "8 mm beside the line");
}
