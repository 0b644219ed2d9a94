//! Lifts and turns: none where the blade may turn in the cloth, each as short as the machine allows, and in the sequence that
//! turns least.

use cutc::machine::{Job, OrderPolicy};
use cutc::pipeline::Report;

use crate::route::compiled;

/// A row of the setpoints: C, degrees, and whether the knife is down.
type Row = (f64, bool);

fn rows(program: &[u8]) -> Vec<Row> {
    let text = std::str::from_utf8(program).expect("ASCII");
    let lines = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        (fields[3].parse().expect("a number"), fields[4] == "1")
    };
    lines.map(row).collect()
}

fn lifts(text: &str, job: &Job) -> usize {
    compiled(text, job).0.program.lifts.expect("it is planned")
}

fn time(report: &Report) -> f64 {
    report.time_s().expect("it is planned")
}

fn file(contours: &str) -> String {
    format!("H1*G71*N1*M15*{contours}M0*\n")
}

/// An octagon whose bends are of 45 degrees each.
const OCTAGON: &str = "X1000Y0*M14*X2000Y0*X2700Y700*X2700Y1700*X2000Y2400*X1000Y2400*X300Y1700*X300Y700*X1000Y0*M15*";

#[test]
fn the_knife_is_lifted_at_corners_alone() {
    let mut job = Job::default();
    assert_eq!(lifts(&file(OCTAGON), &job), 1);
    job.profile.corner.angle_deg = 44.0;
    assert_eq!(lifts(&file(OCTAGON), &job), 8);
    // Whichever way the bends of 45 degrees were computed.
    job.profile.corner.angle_deg = 45.0;
    for turned in [90.0, 180.0, 33.3] {
        job.profile.sheet.rotate_deg = turned;
        assert_eq!(lifts(&file(OCTAGON), &job), 1, "{turned}");
    }
}

#[test]
fn a_line_that_is_drawn_from_amid_an_edge_begins_at_a_corner_without_one_more_lift() {
    let from_corner = file("X0Y0*M14*X2000Y0*X2000Y1000*X0Y1000*X0Y0*M15*");
    let amid = file("X700Y0*M14*X2000Y0*X2000Y1000*X0Y1000*X0Y0*X700Y0*M15*");
    for policy in [OrderPolicy::File, OrderPolicy::Fastest, OrderPolicy::Steady] {
        let mut job = Job::default();
        job.profile.order.policy = policy;
        assert_eq!(lifts(&amid, &job), 4, "{policy:?}");
        assert_eq!(lifts(&from_corner, &job), 4, "{policy:?}");
    }
}

#[test]
fn c_turns_once_the_blade_is_clear_and_what_that_may_save_is_told() {
    let text = file(&format!("X200Y0*M14*X200Y60*M15*X600Y0*M14*X600Y60*M15*{}", OCTAGON.replace("X2700Y700*", "")));
    let mut job = Job::default();
    let (slow, program) = compiled(&text, &job);
    let told = slow.program.savings.and_then(|savings| savings.clear_s).expect("it is told where the key is off");
    let lift_ms = job.profile.knife.lift_ms;
    assert!(least_rest(&program) >= lift_ms, "{}", least_rest(&program));
    job.profile.knife.clear_ms = Some(lift_ms / 3.0);
    let (fast, program) = compiled(&text, &job);
    let rest = least_rest(&program);
    assert!(rest >= lift_ms / 3.0 && rest < lift_ms / 2.0, "{rest}");
    assert!(fast.program.savings.is_some_and(|savings| savings.clear_s.is_none()));
    let saved = time(&slow) - time(&fast);
    assert!(saved > 0.1 && (saved - told).abs() < 0.05 * saved, "{saved} {told}");
}

/// The shortest rest of C behind a lift, in rows of a millisecond.
fn least_rest(program: &[u8]) -> f64 {
    let rows = rows(program);
    let lifted = (1..rows.len()).filter(|&i| rows[i - 1].1 && !rows[i].1);
    let rests = lifted.map(|i| rows[i..].iter().take_while(|row| row.0 == rows[i].0).count());
    rests.min().expect("the knife comes up") as f64
}

#[test]
fn a_double_edged_blade_goes_whichever_way_turns_less() {
    // Strokes to and fro.
    let stroke = |i: u32| format!("X{x}Y{}*M14*X{x}Y{}*M15*", 900 * (i % 2), 900 * ((i + 1) % 2), x = 100 * i);
    let strokes = (0..6).map(stroke).collect::<Vec<String>>().concat();
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.knife.back_mm) = (6.0, Some(3.0));
    let turned = |program: &[u8]| {
        let rows = rows(program);
        rows.windows(2).map(|pair| (pair[1].0 - pair[0].0).abs()).sum::<f64>()
    };
    let (single, program) = compiled(&file(&strokes), &job);
    let turned_by_one = turned(&program);
    job.profile.knife.edges = 2;
    let (double, program) = compiled(&file(&strokes), &job);
    assert!(turned(&program) < 100.0 && turned_by_one > 900.0, "{} {turned_by_one}", turned(&program));
    assert!(double.program.sides.is_some_and(|sides| sides.backwards >= 2));
    assert!(time(&double) < time(&single) - 0.3, "{} {}", time(&double), time(&single));
}

#[test]
fn slits_are_cut_in_the_sequence_that_turns_least_however_they_are_written() {
    // Pairs that point the same way stand on opposite sides, so that nearest next would turn each time.
    let slits = [
        "X300Y0*M14*X300Y60*M15*",
        "X600Y0*M14*X600Y60*M15*",
        "X300Y800*M14*X300Y740*M15*",
        "X600Y800*M14*X600Y740*M15*",
    ];
    let outline = "X0Y0*M14*X1000Y0*X1000Y800*X0Y800*X0Y0*M15*";
    let mut job = Job::default();
    let times = |job: &Job| {
        let orders = [[0, 1, 2, 3], [0, 2, 1, 3], [2, 1, 3, 0], [3, 0, 2, 1]];
        orders.map(|order| time(&compiled(&file(&(order.map(|i| slits[i]).concat() + outline)), job).0))
    };
    let filed = times(&job);
    job.profile.order.policy = OrderPolicy::Fastest;
    let fastest = times(&job);
    assert!(fastest.iter().all(|time| (time - fastest[0]).abs() < 2e-3), "{fastest:?}");
    assert!(
        filed.iter().all(|&time| time > fastest[0] - 1e-3) && filed.iter().any(|&time| time > fastest[0] + 0.1),
        "{filed:?}"
    );
}

/// Outlines that bend by 45 degrees where the cut of a neighbour begins: whether that is a corner, on which the neighbour counts,
/// must not hang on the rounding of what is left of them.
#[test]
fn a_bend_of_just_the_limit_is_the_same_to_all_who_ask() {
    let text = "H1*G71*N48*X13848Y1593*M14*X13848Y843*X13098Y843*X12848Y1093*X12848Y1593*X13848Y1593*M15*N38*X12847Y1017*M14*X10847Y1017*X10597Y1517*X11347Y1517*X11597Y1267*X11847Y1267*X12347Y1517*X12847Y1517*X12847Y1017*M15*N63*X12073Y1519*M14*X11823Y1769*X10323Y1769*X10073Y1519*X12073Y1519*M15*M0*\n";
    let (report, _) = compiled(text, &Job::default());
    assert_eq!(report.common.expect("the parts touch").edges, 2);
}
