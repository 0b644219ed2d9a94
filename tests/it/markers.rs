//! Whole markers: what the generator makes is compiled without errors, inside the limits, to the same bytes every time.

use std::io::Cursor;

use crate::garment::{self, Dialect, Order};
use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::ir::{Finding, Marker};
use cutc::machine::plot::Inner;
use cutc::machine::{Job, MachineProfile};
use cutc::pipeline::{self, Compiled};
use cutc::source::Source;
use rayon::ThreadPoolBuilder;

const DIALECTS: [Dialect; 3] = [Dialect::G71, Dialect::Inch, Dialect::Spaced];
const PIECES: usize = 12;
/// Contours inside a marker of twelve pieces: two in each of two bodices and two trouser legs.
const CUTOUTS: usize = 8;
/// Half of the last of the six decimals of a setpoint, mm or degrees.
const ROUNDING: f64 = 0.5e-6;

/// The marker of an order, as a file.
fn make(order: &Order) -> Source {
    let mut bytes = Vec::new();
    garment::write(order, &mut bytes).expect("memory takes what is written");
    Source::new("made.cut", bytes).expect("made markers are small")
}

/// The same as a plot.
fn make_plot(order: &Order) -> Source {
    let mut bytes = Vec::new();
    garment::write_plot(order, &mut bytes).expect("memory takes what is written");
    Source::new("made.plt", bytes).expect("made markers are small")
}

/// A knife whose C axis lies far from the middle of the blade.
fn eccentric() -> Job {
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.knife.back_mm) = (6.6, Some(2.2));
    job
}

/// Compiles to setpoints; any error fails the test.
fn compile(source: &Source, job: &Job) -> (Compiled, Vec<u8>) {
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let mut out = Cursor::new(Vec::new());
    let mut diagnostics = Diagnostics::default();
    let order = pipeline::Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut diagnostics).expect("memory takes everything");
    let said = render(&diagnostics, source);
    let compiled = compiled.unwrap_or_else(|| panic!("{said}"));
    assert!(diagnostics.iter().next().is_none(), "{said}");
    (compiled, out.into_inner())
}

/// Speed, acceleration and jerk of every axis by plain finite differences of the rows, at rest before and behind them. A
/// difference of order k over a period is a mean of the derivative; rounding adds 2^k q / period^k at most.
fn check_limits(program: &[u8], profile: &MachineProfile) {
    let text = std::str::from_utf8(program).expect("ASCII");
    let position = |line: &str| -> [f64; 3] {
        let mut fields = line.split(',').skip(1).map(|field| field.parse().expect("a number"));
        std::array::from_fn(|_| fields.next().expect("x, y and c"))
    };
    let mut rows: Vec<[f64; 3]> = text.lines().skip(1).map(position).collect();
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    rows.splice(0..0, [first; 3]);
    rows.extend([last; 3]);
    let period = profile.time.period_ms / 1000.0;
    let (x, y, c) = (&profile.axes.x, &profile.axes.y, &profile.axes.c);
    let limits = [
        [x.speed_mm_s, x.acceleration_mm_s2, x.jerk_mm_s3],
        [y.speed_mm_s, y.acceleration_mm_s2, y.jerk_mm_s3],
        [c.speed_deg_s, c.acceleration_deg_s2, c.jerk_deg_s3],
    ];
    for (axis, limits) in limits.iter().enumerate() {
        let mut differences: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
        for (limit, k) in limits.iter().zip(1..) {
            differences = differences.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let worst = differences.iter().fold(0.0_f64, |worst, d| worst.max(d.abs())) / period.powi(k);
            // The relative part is the rounding of the differences themselves.
            let allowed = limit * (1.0 + 1e-6) + (2.0 / period).powi(k) * ROUNDING;
            assert!(worst <= allowed, "axis {axis}, order {k}: {worst} of {limit}");
        }
    }
}

/// Markers of a dialect, each with a default knife and an eccentric one.
fn check(dialect: Dialect) {
    for (cutouts, seed) in [(false, 1), (true, 1), (false, 2), (true, 2), (false, 3), (true, 3)] {
        let order = Order { dialect, pieces: PIECES, cutouts, seed, ..Order::default() };
        let source = make(&order);
        for job in [Job::default(), eccentric()] {
            let (Compiled { report, verdict, .. }, program) = compile(&source, &job);
            let contours = PIECES + if cutouts { CUTOUTS } else { 0 };
            assert_eq!((report.contours, report.closed_contours), (contours, contours), "{order:?}");
            let broken: Vec<Finding> = verdict.expect("it was asked for").broken().cloned().collect();
            assert!(broken.is_empty(), "{order:?}: {broken:?}");
            check_limits(&program, &job.profile);
        }
    }
}

#[test]
fn metric_markers_with_v_notches_compile_and_keep_the_limits() {
    check(Dialect::G71);
}

#[test]
fn inch_markers_with_slits_compile_and_keep_the_limits() {
    check(Dialect::Inch);
}

#[test]
fn spaced_markers_with_corner_lifts_compile_and_keep_the_limits() {
    check(Dialect::Spaced);
}

#[test]
fn plots_with_spikes_compile_and_keep_the_limits() {
    for (cutouts, seed) in [(false, 1), (true, 2)] {
        let order = Order { pieces: PIECES, cutouts, seed, ..Order::default() };
        let mut job = eccentric();
        job.profile.hpgl.drill_max_mm = Some(4.0);
        job.profile.hpgl.inner = Inner::Cut;
        let (Compiled { report, verdict, .. }, program) = compile(&make_plot(&order), &job);
        let contours = PIECES + if cutouts { CUTOUTS } else { 0 };
        assert_eq!((report.contours, report.closed_contours, report.drills), (contours, contours, 2), "{order:?}");
        assert_eq!(report.labels, PIECES);
        let broken: Vec<Finding> = verdict.expect("it was asked for").broken().cloned().collect();
        assert!(broken.is_empty(), "{order:?}: {broken:?}");
        check_limits(&program, &job.profile);
    }
}

#[test]
fn a_marker_gives_the_same_bytes_again_and_on_any_number_of_threads() {
    for dialect in DIALECTS {
        let source = make(&Order { dialect, cutouts: true, ..Order::default() });
        let (_, program) = compile(&source, &eccentric());
        assert!(compile(&source, &eccentric()).1 == program, "{dialect:?}, again");
        for threads in [1, 3] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a few threads");
            let other = pool.install(|| compile(&source, &eccentric()).1);
            assert!(other == program, "{dialect:?}, {threads} threads");
        }
    }
}

/// What is in the marker of an order.
fn read(order: &Order) -> Marker {
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&make(order), None, &Job::default(), &mut diagnostics).expect("it is a cutter file");
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    input.marker
}

#[test]
fn a_made_marker_is_what_was_ordered() {
    let order = Order { pieces: 40, cutouts: true, ..Order::default() };
    assert_eq!(make(&order).bytes(), make(&order).bytes());
    assert_ne!(make(&order).bytes(), make(&Order { seed: 2, ..order.clone() }).bytes());

    let inch = read(&Order { dialect: Dialect::Inch, ..order.clone() });
    assert_eq!(inch.pieces.len(), 40);
    assert!(inch.pieces.iter().all(|piece| piece.labels.len() == 2));
    assert_eq!(inch.pieces.iter().map(|piece| piece.drills.len()).sum::<usize>(), 7);
    assert!(inch.pieces.iter().any(|piece| !piece.notches.is_empty()));
    assert!(inch.extent().max.y <= order.width);

    let clockwise = |marker: &Marker| {
        let area = |contour| {
            let points = marker.points(contour);
            points.windows(2).map(|w| w[0].x * w[1].y - w[0].y * w[1].x).sum::<f64>()
        };
        marker.contours().filter(|(_, contour)| area(contour) < 0.0).count()
    };
    let contours = inch.contours().count();
    assert!((contours / 4..contours * 3 / 4).contains(&clockwise(&inch)));

    let vertices = |tolerance| {
        let order = Order { vertices: Some(5_000), tolerance, ..Order::default() };
        let marker = read(&order);
        (marker.pieces.len(), marker.contours().map(|(_, contour)| marker.points(contour).len() - 1).sum::<usize>())
    };
    let (coarse, fine) = (vertices(0.05), vertices(0.01));
    assert!(coarse.0 > fine.0, "finer curves need fewer pieces for as many vertices");
    // The last piece goes past the number; the two more points of each V notch do not count.
    assert!((5_000..6_000).contains(&coarse.1) && (5_000..6_000).contains(&fine.1), "{coarse:?} {fine:?}");
}
