//! Where the blade stands at the ends of runs: the paper's states, plunge cuts, rings.

use std::f64::consts::{PI, TAU};
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, Severity, render};
use cutc::geom::{Heading, Point};
use cutc::ir::Marker;
use cutc::ir::toolpath::{Pose, Shape, Step};
use cutc::machine::{Job, NotchStyle};
use cutc::pipeline::{self, Compiled};
use cutc::source::Source;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support;

fn knife(width: f64, back: f64, front: f64, heel: f64) -> Job {
    let mut job = Job::default();
    let knife = &mut job.profile.knife;
    (knife.width_mm, knife.back_mm) = (width, Some(back));
    (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (front, front);
    (knife.heel_overlap_mm, knife.corner_heel_overlap_mm) = (heel, heel);
    job
}

fn near(a: Point, b: Point, accuracy: f64) -> bool {
    (a - b).norm() < accuracy
}

#[test]
fn the_square_of_the_paper_has_its_eight_states() {
    let square = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)];
    let points: Vec<Point> = square.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let job = knife(6.0, 2.0, 1.0, 0.5);
    let toolpaths = support::toolpaths(&support::marker(&points), &job);
    let states: Vec<Pose> = support::runs(&toolpaths[0]).iter().flat_map(|run| [run.start, run.end]).collect();
    let table = support::rows("knife/square_table.csv");
    assert_eq!(states.len(), table.len());
    for (state, row) in states.iter().zip(table) {
        let [_, x, y, c, tip_x, tip_y, tail_x, tail_y, ..] = row[..] else { panic!("a row has eight numbers or more") };
        assert!(near(state.centre, Point::new(x, y), 1e-9), "{state:?} {x} {y}");
        assert!(near(state.ahead(4.0), Point::new(tip_x, tip_y), 1e-9));
        assert!(near(state.ahead(-2.0), Point::new(tail_x, tail_y), 1e-9));
        assert!((state.c.heading().radians().to_degrees() - c).abs() < 1e-9);
    }
}

#[test]
fn a_straight_run_starts_with_its_tail_and_ends_with_its_tip_at_the_overlaps() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..500 {
        let width = random.random_range(0.0..10.0);
        let back = random.random_range(0.0..=width);
        let (front, heel) = (random.random_range(0.0..3.0), random.random_range(0.0..3.0));
        let job = knife(width, back, front, heel);
        let from = Point::new(random.random_range(-1e3..1e3), random.random_range(-1e3..1e3));
        let angle: f64 = random.random_range(-9.0..9.0);
        let length = random.random_range(0.1..40.0);
        let along = cutc::geom::Heading::new(angle).unit();
        let to = from + along * length;
        let toolpath = &support::toolpaths(&support::marker(&[from, to]), &job)[0];
        let last = toolpath.steps.last().expect("a run or a stab");
        match last {
            Step::Run(run) => {
                assert!(length + front + heel > width);
                assert!(near(run.start.ahead(-back), from - along * heel, 1e-9));
                assert!(near(run.end.ahead(width - back), to + along * front, 1e-9));
            }
            Step::PlungeCut(plunge_cut) => {
                assert!(length + front + heel <= width + 1e-9);
                assert!(near(plunge_cut.pose.ahead(width - back), to + along * front, 1e-9));
            }
            other => panic!("neither a run nor a stab: {other:?}"),
        }
    }
}

#[test]
fn a_slit_shorter_than_the_blade_is_a_plunge_cut_with_its_surplus_outside() {
    let job = knife(6.6, 2.2, 0.0, 0.0);
    let (edge, inside) = (Point::new(10.0, 0.0), Point::new(10.0, 5.0));
    let toolpath = &support::toolpaths(&support::marker(&[edge, inside]), &job)[0];
    let Some(Step::PlungeCut(plunge_cut)) = toolpath.steps.last() else { panic!("not a stab: {toolpath:?}") };
    assert!(near(plunge_cut.pose.ahead(4.4), inside, 1e-12));
    assert!(near(plunge_cut.pose.ahead(-2.2), Point::new(10.0, -1.6), 1e-12));
    assert!((plunge_cut.heel - 1.6).abs() < 1e-12 && plunge_cut.front == 0.0);
}

#[test]
fn a_smooth_ring_has_no_heel_and_goes_past_its_start() {
    let points: Vec<Point> = (0..=36)
        .map(|i| std::f64::consts::TAU * f64::from(i % 36) / 36.0)
        .map(|a| Point::new(30.0 * a.cos(), 30.0 * a.sin()))
        .collect();
    let job = knife(6.0, 2.0, 1.0, 0.5);
    let toolpath = &support::toolpaths(&support::marker(&points), &job)[0];
    let runs = support::runs(toolpath);
    assert_eq!((runs.len(), runs[0].shape), (1, Shape::Ring));
    assert!(near(runs[0].start.ahead(4.0), points[0], 1e-9));
    assert!((runs[0].end.c.0 - runs[0].start.c.0 - std::f64::consts::TAU).abs() < 0.1);
}

/// A cutter file of the fixtures.
fn source(name: &str) -> Source {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    Source::new(name, std::fs::read(path).expect("a fixture")).expect("small")
}

fn read(name: &str) -> Marker {
    pipeline::read(&source(name), None, &Job::default(), &mut Diagnostics::default()).expect("a marker").marker
}

/// Compiles a fixture to setpoints; gives what was said about it, by code.
fn compile(name: &str, job: &Job) -> Vec<&'static str> {
    let (_, diagnostics) = compiled(&source(name), job);
    diagnostics.iter().map(|diagnostic| diagnostic.code.name).collect()
}

/// Compiles a source to setpoints, which are judged.
fn compiled(source: &Source, job: &Job) -> (Compiled, Diagnostics) {
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let mut diagnostics = Diagnostics::default();
    let order = pipeline::Order { from: None, target, verify: true };
    let mut out = Cursor::new(Vec::new());
    let compiled = pipeline::compile(source, job, order, &mut out, &mut diagnostics).expect("memory takes everything");
    (compiled.unwrap_or_else(|| panic!("{}", render(&diagnostics, source))), diagnostics)
}

#[test]
fn a_curve_with_points_as_near_as_their_rounding_is_cut_without_a_lift() {
    // Three units from each other in a file of 0.1 mm: rounding makes a step of 45 degrees of every other one.
    for radius in [8.0_f64, 13.0, 25.0, 60.0] {
        for waves in [0.0, 2.0, 3.0] {
            let count = (TAU * radius / 0.3) as u32;
            let point = |i: u32| {
                let turn = TAU * f64::from(i % count) / f64::from(count);
                let place = Heading::new(turn).unit() * (radius * (1.0 + 0.04 * (waves * turn + 0.4).cos()));
                format!("X{:.0}Y{:.0}*", 1000.0 + 10.0 * place.x, 1000.0 + 10.0 * place.y)
            };
            let mut points: Vec<String> = (0..=count).map(point).collect();
            points.dedup();
            let text = format!("H1*G71*N1*{}M14*{}M15*M0*", points[0], points[1..].concat());
            let source = Source::new("dense.cut", text.into_bytes()).expect("small");
            let (Compiled { report, .. }, _) = compiled(&source, &Job::default());
            assert_eq!(report.program.lifts, Some(1), "radius {radius}, {waves} waves");
        }
    }
}

#[test]
fn darts_hems_castles_and_parts_in_cut_outs_are_cut_by_every_blade_and_what_harms_is_warned_of() {
    for (width, back) in [(6.6, 6.35), (6.6, 2.2), (8.89, 6.35)] {
        let mut job = Job::default();
        (job.profile.knife.width_mm, job.profile.knife.back_mm) = (width, Some(back));
        let said = compile("knife/hard-cases.cut", &job);
        assert!(!said.is_empty() && said.iter().all(|&code| code == "path/overcut"), "{width} {back}: {said:?}");
    }
}

/// A blade that plunges at the corner beside the slit stands as a chord of the curve, and cuts 0.17 mm outside of its root.
#[test]
fn a_slit_meets_its_edge_where_that_bows_away_from_a_plunged_blade() {
    for (width, tolerance) in [(6.6, 0.05), (6.6, 0.02), (6.0, 0.05), (3.0, 0.05)] {
        let mut job = Job::default();
        job.profile.knife.width_mm = width;
        job.profile.knife.back_mm = Some(width - 0.25);
        job.profile.path.tolerance_mm = Some(tolerance);
        compile("iso/slit-amid-a-short-curve.cut", &job);
    }
}

#[test]
fn a_cut_out_that_is_a_piece_of_its_own_nicks_the_part_around_it_by_one_tolerance() {
    let job = Job::default();
    let toolpaths = support::toolpaths(&read("knife/cut-out-without-pieces.cut"), &job);
    let overlaps = |toolpath| support::runs(toolpath).iter().map(|run| run.front + run.heel).sum::<f64>();
    let [inner, outer] = toolpaths.iter().map(overlaps).collect::<Vec<f64>>()[..] else { panic!("two contours") };
    // Cuts that are off by that still meet at its corners.
    assert!((inner - 8.0 * toolpaths[0].tolerance).abs() < 1e-9, "{inner}");
    assert!((outer - 4.0 * (0.8 + 0.5)).abs() < 1e-9, "{outer}");
    assert_eq!(compile("knife/cut-out-without-pieces.cut", &job), [""; 0]);
}

#[test]
fn notches_are_cut_in_the_style_of_the_profile() {
    let cuts = |style: NotchStyle, depth: Option<f64>| {
        let mut job = Job::default();
        (job.profile.notch.style, job.profile.notch.depth_mm) = (style, depth);
        assert_eq!(compile("markers/metric-four-pieces.cut", &job), [""; 0], "{style:?} {depth:?}");
        let marker = read("markers/metric-four-pieces.cut");
        let steps = support::toolpaths(&marker, &job).into_iter().flat_map(|toolpath| toolpath.steps);
        steps.filter(|step| matches!(step, Step::Run(_) | Step::PlungeCut(_))).count()
    };
    let marker = read("markers/metric-four-pieces.cut");
    let vees = marker.pieces.iter().map(|piece| piece.outline_notches.len()).sum::<usize>();
    let drawn = cuts(NotchStyle::AsDrawn, None);
    assert!(vees > 0);
    // Two legs and two parts of the edge become one cut over the mouth, and a slit.
    assert_eq!(cuts(NotchStyle::Slit, None), drawn - 2 * vees);
    assert_eq!(cuts(NotchStyle::Slit, Some(3.0)), drawn - 2 * vees);
    assert_eq!(cuts(NotchStyle::Skip, None), drawn - 3 * vees);
}

#[test]
fn a_slit_that_the_profile_would_lead_out_of_its_part_is_refused() {
    let band = "G71*N1*X0Y0*M14*X1500Y0*M19*X1500Y40*M15*X1500Y0*M14*X3000Y0*X3000Y100*X0Y100*X0Y0*M15*M0*";
    let source = Source::new("band.cut", band.as_bytes().to_vec()).expect("small");
    let found = |depth: f64| {
        let mut job = Job::default();
        job.profile.notch.depth_mm = Some(depth);
        let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
        let order = pipeline::Order { from: None, target, verify: true };
        let mut found = Diagnostics::default();
        let compiled = pipeline::compile(&source, &job, order, &mut Cursor::new(Vec::new()), &mut found);
        let has_program = compiled.expect("memory takes everything").is_some();
        (has_program, found.iter().map(|diagnostic| diagnostic.code.name).collect::<Vec<_>>())
    };
    assert_eq!(found(9.0), (true, Vec::new()));
    assert_eq!(found(12.0), (false, vec!["path/notch-through"]));
}

#[test]
fn a_ring_that_winds_past_the_range_of_c_begins_elsewhere_or_is_cut_in_parts() {
    let mut job = Job::default();
    let runs = |job: &Job| {
        let toolpaths = support::toolpaths(&read("iso/seed-circle.cut"), job);
        toolpaths.iter().map(|toolpath| support::runs(toolpath).len()).sum::<usize>()
    };
    for (range_deg, parts, said) in [
        (None, 1, &["iso/no-end", "path/swing"][..]),
        (Some([-200.0, 200.0]), 1, &["iso/no-end", "path/swing"]),
        (Some([-185.0, 185.0]), 2, &["iso/no-end", "path/bowed-plunge", "path/swing"]),
    ] {
        job.profile.c.range_deg = range_deg;
        assert_eq!(compile("iso/seed-circle.cut", &job), said, "{range_deg:?}");
        assert_eq!(runs(&job), parts, "{range_deg:?}");
    }
}

#[test]
fn a_circle_under_a_narrow_range_of_c_is_proven_or_refused_by_name() {
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    for (radius, start) in [4.0, 6.0, 8.0, 10.0, 20.0].into_iter().flat_map(|r| [0, 18, 31, 50].map(|start| (r, start)))
    {
        let at = |i: i32| Heading::new(TAU * f64::from(i % 72) / 72.0).unit() * radius;
        let rows = (start..=start + 72).map(|i| format!("{:.3},{:.3}\n", 100.0 + at(i).x, 50.0 + at(i).y));
        let text = rows.collect::<Vec<_>>().concat();
        let source = Source::new("circle.csv", format!("x_mm,y_mm\n{text}").into_bytes()).expect("it is small");
        for most in [185.0, 186.0, 187.0, 190.0, 200.0, 270.0] {
            let mut job = Job::default();
            job.profile.c.range_deg = Some([-most, most]);
            let order = pipeline::Order { from: None, target, verify: true };
            let (mut out, mut diagnostics) = (Cursor::new(Vec::new()), Diagnostics::default());
            let compiled = pipeline::compile(&source, &job, order, &mut out, &mut diagnostics).expect("memory");
            let case = format!("{radius} mm from {start}, {most} degrees: {}", render(&diagnostics, &source));
            let errors = diagnostics.iter().filter(|found| found.code.severity == Severity::Error);
            let errors: Vec<&str> = errors.map(|found| found.code.name).collect();
            match compiled {
                Some(_) => assert!(errors.is_empty(), "{case}"),
                None => assert_eq!(errors, ["path/c-range"], "{case}"),
            }
            // From 360 degrees, the turn of the overlap and 10 degrees on there is a way.
            let needed = 180.0 + (0.8 / radius).to_degrees() / 2.0 + 5.0;
            assert!(compiled.is_some() || most < needed, "{case}");
        }
    }
}

#[test]
fn a_line_that_ends_in_a_circle_is_cut_and_proven() {
    for radius in [10.0, 15.0, 20.0, 30.0] {
        let centre = Point::new(90.0 + radius, 0.0);
        let circle = (0..=90).map(|i| centre + Heading::new(PI + TAU * f64::from(i) / 90.0).unit() * radius);
        let rows = std::iter::once(Point::origin()).chain(circle).map(|at| format!("{:.3},{:.3}\n", at.x, at.y));
        let text = rows.collect::<Vec<_>>().concat();
        let source = Source::new("circle.csv", format!("x_mm,y_mm\n{text}").into_bytes()).expect("it is small");
        let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
        let order = pipeline::Order { from: None, target, verify: true };
        let (mut out, mut diagnostics) = (Cursor::new(Vec::new()), Diagnostics::default());
        let compiled = pipeline::compile(&source, &Job::default(), order, &mut out, &mut diagnostics);
        assert!(compiled.is_ok_and(|compiled| compiled.is_some()), "{radius} mm: {}", render(&diagnostics, &source));
    }
}

#[test]
fn a_blade_with_two_edges_cuts_either_way_round_and_turns_less() {
    let source = source("markers/metric-four-pieces.cut");
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let order = pipeline::Order { from: None, target, verify: true };
    let cut = |edges: u32| {
        // The axis stands far from the middle of the blade: run backwards, that is another blade.
        let mut job = knife(6.6, 2.2, 0.8, 0.5);
        job.profile.knife.edges = edges;
        let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
        let compiled = pipeline::compile(&source, &job, order, &mut out, &mut found).expect("memory takes everything");
        let compiled = compiled.unwrap_or_else(|| panic!("{}", render(&found, &source)));
        (job, out, compiled.report.program)
    };
    let (one_edge, _, one) = cut(1);
    let (two_edges, mut program, two) = cut(2);
    let [before, now] = [&one, &two].map(|program| program.sides.expect("it is planned").backwards);
    assert!(before == 0 && now > 0 && now < two.lifts.expect("it is planned"), "{before} {now}");
    assert!(two.time_s < one.time_s, "{:?} {:?}", two.time_s, one.time_s);
    let mut judge = |job: &Job| {
        let mut found = Diagnostics::default();
        let verdict =
            pipeline::judge_program(&mut program, &source, None, job, None, &mut found).expect("memory is readable");
        verdict.expect("the source is sound").verdict.broken().map(|finding| finding.rule.name).collect::<Vec<_>>()
    };
    assert_eq!(judge(&two_edges), [""; 0]);
    assert!(judge(&one_edge).contains(&"verify/heading"), "a blade with one edge must not run backwards");
}
