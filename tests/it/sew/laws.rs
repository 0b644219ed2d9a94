//! What holds of every pattern: over seeded random ones.

use std::fmt::Write as _;

use cutc::geom::Point;
use cutc::machine::Job;
use cutc::machine::sewing::{OnLong, Ramp, SeamOrder, Spindle};
use cutc::sew::{Drive, Op, Program};
use fastrand::Rng;

use super::{broken, plan, planned, refuses, written};

/// A queue of random stitches within the pitches of the machine.
fn random_queue(random: &mut Rng, longest: f64) -> Vec<u8> {
    let mut text = "op,dx_mm,dy_mm,value\nSTITCH,0,0,\n".to_owned();
    for _ in 0..random.usize(3..40) {
        let (angle, pitch) = (random.f64() * std::f64::consts::TAU, 0.2 + (longest - 0.2) * random.f64());
        let word = if random.u8(0..12) == 0 { "JUMP" } else { "STITCH" };
        _ = writeln!(text, "{word},{:.4},{:.4},", pitch * angle.cos(), pitch * angle.sin());
        if random.u8(0..15) == 0 {
            text += ["TRIM,,,\n", "STOP,,,\n", "COLOR,,,2\n"][random.usize(0..3)];
        }
    }
    (text + "END,,,\n").into_bytes()
}

#[test]
fn random_patterns_are_proven_in_every_form_and_mode() {
    let mut random = Rng::with_seed(2026);
    for i in 0..300 {
        let mut job = Job::default();
        let sewing = &mut job.profile.sewing;
        sewing.ramp = if random.bool() { Ramp::Fill } else { Ramp::Fastest };
        sewing.on_long = if random.bool() { OnLong::Slow } else { OnLong::Split };
        sewing.spindle = if random.bool() { Spindle::Uniform } else { Spindle::Eased };
        sewing.spindle_rpm_s = 10.0_f64.powf(2.0 + 3.0 * random.f64());
        sewing.start_hz = [0.0, 1500.0, 2836.364, 3400.0][random.usize(0..4)];
        sewing.feed_acceleration_mm_s2 = 10.0_f64.powf(3.0 + 2.0 * random.f64());
        sewing.grid_rpm = [1, 10, 50][random.usize(0..3)];
        sewing.max_rpm = 1000.0 + 4000.0 * random.f64();
        sewing.max_hz = [None, Some(3500.0), Some(6000.0)][random.usize(0..3)];
        sewing.step_mm = [0.05, 0.1, 0.0125][random.usize(0..3)];
        sewing.soft_start_rpm = [None, Some(400.0)][random.usize(0..2)];
        sewing.feed_start_deg = random.f64() * 360.0;
        sewing.feed_end_deg = (sewing.feed_start_deg + 90.0 + 200.0 * random.f64()) % 360.0;
        let queue = random_queue(&mut random, 9.0);
        let (program, said, _) = plan("x.csv", queue.clone(), &job);
        let Some(program) = program else { panic!("{i}: {said}\n{}", String::from_utf8_lossy(&queue)) };
        for target in ["queue", "jsonl", "pulses", "pulses-npy", "dst", "exp", "pes", "jef"] {
            if refuses(&program, &job, target) {
                continue;
            }
            let bytes = written(&program, &job, target);
            let broken = broken(&program, &queue, &job, (target, &bytes));
            assert!(
                broken.is_empty(),
                "{i} {target}: {broken:?} {:?}\n{}",
                job.profile.sewing,
                String::from_utf8_lossy(&queue)
            );
        }
    }
}

/// A pattern of random lines with random elements: straight ones, corners, curves, edges down to a hundredth of a millimetre.
fn random_pattern(random: &mut Rng) -> Vec<u8> {
    let mut text = "x_mm,y_mm,element".to_owned();
    for _ in 0..random.usize(1..6) {
        let element = ["straight", "zigzag", "bar-tack", "box-x", "satin"][random.usize(0..5)];
        let words = [
            element,
            ["", "tie", "back-tack", "open"][random.usize(0..4)],
            ["", "thread 2", "stop"][random.usize(0..3)],
            ["", "pitch 1.2", "pitch 3.5 speed 1200", "speed 900"][random.usize(0..4)],
            ["", "start open", "end back-tack"][random.usize(0..3)],
            if matches!(element, "zigzag" | "bar-tack") {
                ["", "width 1", "width 4.5"][random.usize(0..3)]
            } else {
                ""
            },
        ];
        let count = match element {
            "bar-tack" => 2,
            "box-x" => 4,
            _ => random.usize(2..30),
        };
        let (mut at, mut heading) = ([100.0 * random.f64(), 100.0 * random.f64()], random.f64() * 6.0);
        // The rails of a satin are parallel, so that they do not cross.
        let across = (element == "satin").then(|| [5.0 * random.f64(), 5.0 * random.f64()]);
        text += "\n";
        for i in 0..count {
            let words = if i == 0 { words.join(" ") } else { String::new() };
            _ = write!(text, "\n{:.4},{:.4},{words}", at[0], at[1]);
            if let Some([x, y]) = across {
                _ = write!(text, "\n{:.4},{:.4},", at[0] + x, at[1] + y);
            }
            let length = 10.0_f64.powf(-2.0 + 3.5 * random.f64());
            heading += [0.0, 0.1, std::f64::consts::FRAC_PI_2, 3.0 * random.f64()][random.usize(0..4)];
            at = [at[0] + length * heading.cos(), at[1] + length * heading.sin()];
        }
    }
    text.into_bytes()
}

#[test]
fn random_lines_are_laid_with_every_corner_and_on_their_seams() {
    let mut random = Rng::with_seed(31);
    for i in 0..400 {
        let mut job = Job::default();
        let sewing = &mut job.profile.sewing;
        sewing.order = [SeamOrder::File, SeamOrder::Travel][random.usize(0..2)];
        sewing.on_long = [OnLong::Slow, OnLong::Split][random.usize(0..2)];
        sewing.pitch_mm = [0.5, 2.5, 4.0][random.usize(0..3)];
        sewing.min_pitch_mm = [0.0, 0.1, 0.3][random.usize(0..3)];
        sewing.tie_stitches = random.u32(1..6);
        sewing.back_tack_stitches = random.u32(1..9);
        sewing.trim = random.bool();
        let pattern = random_pattern(&mut random);
        let shown = String::from_utf8_lossy(&pattern).into_owned();
        let (program, said, _) = plan("x.csv", pattern, &job);
        let Some(program) = program else { panic!("{i}: {said}\n{shown}") };
        for target in ["queue", "pulses-npy", "dst", "jef"] {
            let bytes = written(&program, &job, target);
            let broken = broken(&program, &[], &job, (target, &bytes));
            assert!(broken.is_empty(), "{i} {target}: {broken:?} {:?}\n{shown}", job.profile.sewing);
        }
    }
}

#[test]
fn an_eased_spindle_sews_no_stitch_more_slowly_than_one_of_one_speed() {
    let mut random = Rng::with_seed(52);
    let mut faster = 0;
    for _ in 0..60 {
        let mut job = Job::default();
        job.profile.sewing.soft_start_rpm = None;
        let queue = random_queue(&mut random, 6.0);
        let speeds = |job: &Job| -> Vec<f64> {
            let (program, said, _) = plan("x.csv", queue.clone(), job);
            program.unwrap_or_else(|| panic!("{said}")).moves(job).map(|entry| entry.rpm).collect()
        };
        let uniform = speeds(&job);
        job.profile.sewing.spindle = Spindle::Eased;
        for (eased, uniform) in speeds(&job).into_iter().zip(uniform) {
            assert!(eased >= uniform, "{eased} {uniform}");
            faster += usize::from(eased > uniform);
        }
    }
    assert!(faster > 200, "{faster}");
}

#[test]
fn a_slower_run_is_feasible_wherever_a_faster_one_is() {
    let mut random = Rng::with_seed(5);
    for _ in 0..60 {
        let mut job = Job::default();
        let queue = random_queue(&mut random, 6.0);
        let speeds = |job: &Job| -> Vec<f64> {
            let (program, said, _) = plan("x.csv", queue.clone(), job);
            program.unwrap_or_else(|| panic!("{said}")).runs.iter().map(|run| run.rpm).collect()
        };
        let free = speeds(&job);
        job.profile.sewing.max_rpm = 500.0 + 2500.0 * random.f64();
        let most = (job.profile.sewing.max_rpm / 10.0).floor() * 10.0;
        // A lower limit is taken exactly, unless a stitch is the lower one: nothing between is infeasible.
        let expected: Vec<f64> = free.iter().map(|rpm| rpm.min(most)).collect();
        assert_eq!(speeds(&job), expected);
    }
}

#[test]
fn rounding_never_adds_up() {
    let job = Job::default();
    let drive = Drive::of(&job.profile.sewing);
    let mut text = "op,dx_mm,dy_mm,value\nSTITCH,0,0,\n".to_owned();
    for _ in 0..20_000 {
        text += "STITCH,0.3333,0.7071,\n";
    }
    let (program, said, _) = plan("x.csv", (text + "END,,,\n").into_bytes(), &job);
    let program: Program = program.unwrap_or_else(|| panic!("{said}"));
    let mut at = [0, 0];
    for entry in program.moves(&job) {
        at = [at[0] + entry.pulses[0], at[1] + entry.pulses[1]];
        let here = Point::new(at[0] as f64 * drive.step, at[1] as f64 * drive.step);
        let off = here - entry.step.to;
        assert!(off.x.abs().max(off.y.abs()) <= drive.step / 2.0 + 1e-9, "{off}");
    }
}

#[test]
fn corners_of_a_pattern_have_needle_points() {
    let job = Job::default();
    let program = planned("sew/square.csv", &job);
    for (x, y) in [(0.0, 0.0), (50.0, 0.0), (50.0, 50.0), (0.0, 50.0)] {
        let corner = Point::new(x, y);
        assert!(program.stitches.steps.iter().any(|step| step.op == Op::Stitch && step.to == corner), "{corner}");
    }
}

#[test]
fn one_profile_reproduces_both_headline_figures() {
    let program = planned("sew/headline.csv", &Job::default());
    assert_eq!(program.runs.iter().map(|run| run.rpm).collect::<Vec<_>>(), [3200.0, 2800.0]);
}

#[test]
fn one_long_stitch_costs_what_the_equations_say() {
    let mut job = Job::default();
    let sewing = &mut job.profile.sewing;
    sewing.feed_acceleration_mm_s2 = 80_000.0;
    sewing.start_hz = 0.0;
    sewing.soft_start_rpm = None;
    sewing.grid_rpm = 1;
    // The stitch without length by which the needle goes down counts, too.
    let time = |job: &Job| {
        let program = planned("sew/one-long-stitch.csv", job);
        (program.stitches.count(), program.runs[0].rpm, cutc::sew::estimate(&program, job).sewing_s)
    };
    let (stitches, rpm, slowed) = time(&job);
    // 2116.95 stitches a minute, and the grid is whole ones.
    assert_eq!((stitches, rpm), (202, 2116.0));
    assert!((slowed - 202.0 * 60.0 / 2116.0).abs() < 1e-9 && (slowed - 60.0 / 2116.0 - 5.70).abs() < 0.005);
    job.profile.sewing.on_long = OnLong::Split;
    let (stitches, rpm, split) = time(&job);
    assert_eq!((stitches, rpm), (204, 3200.0));
    assert!((split - 60.0 / 3200.0 - 3.81).abs() < 0.005);
}

/// Patterns and keys that a long search found, each refused once by the verifier.
const FOUND: [(&str, &str, &[&str]); 3] = [
    (
        "a run ends with stitches too short on both sides of it",
        "-51.8828,101.6025,straight open\n-50.6600,99.3014,\n-52.4821,102.7218,\n-52.4555,102.6742,\n-52.5212,102.7865,\n",
        &[],
    ),
    (
        "a limit by pitch lets long stitches fit, but not shorter ones",
        "-3.958654,-116.258676,straight open\n-3.615435,-115.520800,\n-1.652429,-117.103599,\n-0.230505,-115.340113,\n-2.5,-113,\n",
        &[
            "sewing.on_long=split",
            "sewing.start_hz=1500",
            "sewing.max_rpm=4500",
            "sewing.corner_deg=150",
            "sewing.speeds=[[2, 1800], [3, 1500]]",
        ],
    ),
    (
        "a zigzag around a curve as narrow as its pitch",
        "0,0,zigzag\n0.3,0.1,\n0.5,0.35,\n0.5,0.65,\n0.3,0.9,\n0,1,\n-0.3,0.9,\n-0.5,0.65,\n-0.5,0.35,\n-0.3,0.1,\n0,0,\n0.3,0.1,\n",
        &[
            "sewing.on_long=split",
            "sewing.step_mm=0.0125",
            "sewing.feed_acceleration_mm_s2=1000",
            "sewing.max_hz=4000",
            "sewing.min_pitch_mm=0.05",
            "sewing.zigzag_width_mm=0.3",
        ],
    ),
];

#[test]
fn what_a_search_found_refused_is_sewn() {
    for (name, seam, set) in FOUND {
        let set: Vec<String> = set.iter().map(|key| (*key).to_owned()).collect();
        let job = Job { profile: cutc::machine::load(None, &set).expect("legal"), ..Job::default() };
        let (program, said, _) = plan("x.csv", format!("x_mm,y_mm,element\n{seam}").into_bytes(), &job);
        let program = program.unwrap_or_else(|| panic!("{name}: {said}"));
        for target in ["queue", "pulses", "pulses-npy", "dst"] {
            let bytes = written(&program, &job, target);
            assert_eq!(broken(&program, &[], &job, (target, &bytes)), [""; 0], "{name}, {target}");
        }
    }
}
