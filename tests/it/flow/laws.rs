//! What holds of every plan: it stays under its bounds, gives the same bytes again, and follows cloth that wanders.

use cutc::flow::Speed;

use super::{broken, fixture, job, plan, planned, written};
use crate::support::room::{DONE, Room};

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
        // Of the way that is planned: the plunge alone cuts a blade's width of the edge, overlaps make it longer.
        let own = planned.program.figures.speed_bound_mm_s;
        assert!(speed <= own && (own / bound - 1.0).abs() < 0.1, "{travel} mm: {speed} of {own} of {bound} mm/s");
        assert!(speed > least * bound, "{travel} mm: {speed} of {bound} mm/s");
        assert_eq!(broken(&planned, &job), [""; 0], "{travel} mm");
    }
}

#[test]
fn a_corner_that_is_lifted_takes_the_travel_of_its_lift() {
    let figures = |lift: &str| {
        let sets = [format!("knife.clear_ms={lift}"), format!("knife.lift_ms={lift}")];
        let sets = [&sets[0], &sets[1], "flow.travel_mm=200", "knife.plunge_ms=75", "corner.angle_deg=20"];
        planned("flow/rectangle.csv", 100.0, &job(&sets)).program.figures
    };
    let [short, long] = ["75", "225"].map(figures);
    // 0.15 s more at 100 mm/s: at the corner, and once more behind the last edge.
    let bound = long.travel_bound_mm - short.travel_bound_mm;
    assert!((bound - 15.0).abs() < 0.2, "{short:?} {long:?}");
    assert!(long.travel_mm - short.travel_mm >= bound - 0.2, "{short:?} {long:?}");
    assert!(short.travel_mm > short.travel_bound_mm && long.travel_mm > long.travel_bound_mm);
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
    assert_eq!((slow.heads, slow.chains_abreast, slow.rows), (4, 4, 2));
    assert!((2..=4).contains(&slow.heads_bound), "{slow:?}");
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

#[test]
fn one_cut_goes_over_the_mouths_of_notches_that_lie_partly_opposite_each_other() {
    let job = job(&[]);
    let planned = planned("flow/notches-partly-opposite.cut", 20.0, &job);
    assert!(!planned.marker.common.is_empty());
    assert_eq!(broken(&planned, &job), [""; 0]);
}

/// How far cloth that wanders lies to +Y where it is when the conveyor is at a place, mm.
fn wander(conveyor: f64) -> f64 {
    8.0 * (conveyor / 40.0).sin() + 0.02 * conveyor
}

#[test]
fn heads_follow_cloth_that_wanders_sideways() {
    let room = Room::new();
    room.write("flow.toml", &fixture("machines/flow.toml"));
    room.write("two-discs.csv", &fixture("flow/two-discs.csv"));
    let row = |i: i32| format!("{},{:.4}\n", 4 * i, wander(f64::from(4 * i)));
    let rows: String = (0..80).map(row).collect();
    room.write("centre.csv", format!("conv_mm,centre_mm\n{rows}").as_bytes());
    // The front of the discs, X 130, has 50 mm to go to the rulers when the conveyor counts 0.
    let asked = "--centre centre.csv --set flow.rulers_mm=50 --speed 60 -o out --format json";
    let (said, _) = room.expect(&format!("flow two-discs.csv -p flow.toml {asked}"), DONE);
    assert!(said.contains("source/laid"), "{said}");
    let read = |name: &str| std::fs::read_to_string(room.at("out").join(name)).expect("readable");
    let plan: serde_json::Value = serde_json::from_str(&read("plan.json")).expect("JSON");
    let (mut worst, mut count) = (0.0_f64, 0);
    for (i, head) in plan["heads"].as_array().expect("heads").iter().enumerate() {
        let station = head["station_mm"].as_f64().expect("a place");
        for row in read(&format!("head-{:02}.csv", i + 1)).lines().skip(1) {
            let values: Vec<f64> = row.split(',').map(|field| field.parse().expect("a number")).collect();
            let [_, conveyor, x, y, c, knife, _] = values[..] else { panic!("{row}") };
            if knife == 1.0 {
                // The tip, 2.2 mm before the C axis, on the cloth as it passed the rulers.
                let (sin, cos) = c.to_radians().sin_cos();
                let (x, y) = (station + x - conveyor + 2.2 * cos, y + 2.2 * sin);
                let y = y - wander(130.0 + 50.0 - x);
                let off = |centre: [f64; 2]| ((x - centre[0]).hypot(y - centre[1]) - 60.0).abs();
                worst = worst.max(off([60.0, 60.0]).min(off([70.0, 260.0])));
                count += 1;
            }
        }
    }
    assert!(worst < 0.4 && count > 1000, "{worst} mm off the discs in {count} rows");
}
