//! Plots: the same marker as from a cut file, what pens and options decide, a second reading that agrees, and patience
//! with bytes that are no plot.

mod audit;
mod classes;
mod closing;
mod curves;
mod facing;
mod frames;
mod lost;
mod notches;
mod pages;
mod patience;
mod remains;
mod slits;
mod twin;
mod words;

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::{self, by_name};
use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::machine::plot::{Inner, Lines, PenUse, PlotUnit};
use cutc::machine::{Job, Numbers, OrderPolicy};
use cutc::pipeline::{self, Report};
use cutc::source::Source;

fn source(bytes: impl Into<Vec<u8>>) -> Source {
    Source::new("a.plt", bytes.into()).expect("small")
}

/// Reads a plot and runs the passes: the marker and the codes of what was found.
fn read(source: &Source, job: &Job) -> (Marker, Vec<&'static str>) {
    let mut found = Diagnostics::default();
    let input = pipeline::read(source, by_name("hpgl"), job, &mut found).expect("the dialect is given");
    (input.marker, found.iter().map(|diagnostic| diagnostic.code.name).collect())
}

/// A job that cuts plots in the order in which they are drawn.
fn as_drawn() -> Job {
    let mut job = Job::default();
    job.profile.order.policy = OrderPolicy::File;
    job
}

/// The marker as it was read, before any pass.
fn as_read(source: &Source, job: &Job) -> Marker {
    pipeline::marker_of(by_name("hpgl").expect("a dialect"), source, job, &mut Diagnostics::default())
}

/// A closed rectangle, in units of the file.
/// The places of every contour.
fn outlines(marker: &Marker) -> Vec<Vec<Point>> {
    let contours = marker.pieces.iter().flat_map(|piece| &piece.contours);
    contours.map(|contour| marker.list.points(contour.range).into_owned()).collect()
}

fn rectangle(x: i64, y: i64, width: i64, height: i64) -> String {
    let (right, top) = (x + width, y + height);
    format!("PU{x},{y};PD{right},{y},{right},{top},{x},{top},{x},{y};")
}

/// Pieces, contours, notches and drills.
fn counts(marker: &Marker) -> [usize; 4] {
    let report = Report::of(marker, "hpgl");
    [report.pieces, report.contours, report.notches.slit, report.drills]
}

// ---- The same marker in both dialects.

/// Units of the plot, 1/40 mm, in a unit of the cut file, 1/10 mm.
const PLOT_UNITS: i64 = 4;

/// In units of the plot.
type Place = [i64; 2];

/// A made-up part: its outline, and slits from some of its corners inwards.
struct Part {
    corners: Vec<Place>,
    /// Index of the corner, and the tip.
    slits: Vec<(usize, Place)>,
}

/// A part around a place, its corners on a grid of some units: a star, so that it does not cross itself.
fn part(random: &mut fastrand::Rng, [x, y]: Place, grid: i64) -> Part {
    let count = random.usize(8..40);
    let corner = |k: usize, reach: f64| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        let on_grid = |way: f64| (reach * way / grid as f64).round() as i64 * grid;
        [x + on_grid(angle.cos()), y + on_grid(angle.sin())]
    };
    let reaches: Vec<f64> = (0..count).map(|_| 3600.0 + 2000.0 * random.f64()).collect();
    let corners: Vec<Place> = (0..count).map(|k| corner(k, reaches[k])).collect();
    let slits = (1..count).filter(|_| random.u8(..5) == 0);
    let slits: Vec<_> = slits.map(|k| (k, k)).map(|(k, _)| (k, corner(k, reaches[k] - 200.0))).collect();
    Part { corners, slits }
}

fn cut_file(parts: &[Part]) -> String {
    let mut out = String::from("H1*G71*M15*");
    for (i, part) in parts.iter().enumerate() {
        let rounded = |v: i64| (v as f64 / PLOT_UNITS as f64).round();
        let at = |[x, y]: Place| format!("X{}Y{}*", rounded(x), rounded(y));
        let first = at(part.corners[0]);
        let _ = write!(out, "N{}*{first}M14*", i + 1);
        for (k, &corner) in part.corners.iter().enumerate().skip(1) {
            out += &at(corner);
            if let Some((_, tip)) = part.slits.iter().find(|(root, _)| *root == k) {
                let _ = write!(out, "M19*{}M15*{}M14*", at(*tip), at(corner));
            }
        }
        let _ = write!(out, "{first}M15*");
    }
    out + "M0*"
}

/// How a plot draws notches.
#[derive(Clone, Copy)]
enum Drawn {
    Spikes,
    Marks,
}

fn plot(parts: &[Part], drawn: Drawn) -> String {
    let at = |[x, y]: Place| format!("{x},{y}");
    let mut out = String::from("IN;SP1;");
    for part in parts {
        let first = at(part.corners[0]);
        let mut marks = String::new();
        let _ = write!(out, "PU{first};PD");
        for (k, &corner) in part.corners.iter().enumerate().skip(1) {
            let _ = write!(out, "{},", at(corner));
            let Some((_, tip)) = part.slits.iter().find(|(root, _)| *root == k) else { continue };
            match drawn {
                Drawn::Spikes => _ = write!(out, "{},{},", at(*tip), at(corner)),
                Drawn::Marks => _ = write!(marks, "PU{};PD{};", at(corner), at(*tip)),
            }
        }
        let _ = write!(out, "{first};{marks}");
    }
    out + "PU;SP0;"
}

/// A point in units of the plot, which divides the unit of the cut file.
fn key(point: Point) -> Place {
    [point.x, point.y].map(|mm| (mm * 40.0).round() as i64)
}

/// The outlines, and the roots and tips of the slits of each piece.
fn shapes(marker: &Marker) -> (Vec<Vec<Place>>, Vec<Vec<[Place; 2]>>) {
    let outlines = marker.contours().map(|(_, contour)| marker.points(contour).into_iter().map(key).collect());
    let slits = |piece: &cutc::ir::marker::Piece| piece.notches.iter().map(|n| [key(n.root), key(n.tip)]).collect();
    (outlines.collect(), marker.pieces.iter().map(slits).collect())
}

/// Whether two points are the same but for `most` units of the plot in each coordinate.
fn is_near(p: Place, q: Place, most: u64) -> bool {
    p[0].abs_diff(q[0]).max(p[1].abs_diff(q[1])) <= most
}

/// Whether outlines are the same, point by point.
fn outlines_agree(a: &[Vec<Place>], b: &[Vec<Place>], most: u64) -> bool {
    let near = |(p, q): (&Place, &Place)| is_near(*p, *q, most);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(near))
}

/// Whether slits are the same, piece by piece; a plot may have them in another order.
fn slits_agree(a: &[Vec<[Place; 2]>], b: &[Vec<[Place; 2]>], most: u64) -> bool {
    let near = |a: &[Place; 2], b: &[Place; 2]| is_near(a[0], b[0], most) && is_near(a[1], b[1], most);
    // Each is the partner of one that no other has taken.
    let all = |a: &[[Place; 2]], b: &[[Place; 2]]| {
        let mut left = b.to_vec();
        let take = |a: &[Place; 2]| left.iter().position(|b| near(a, b)).map(|at| left.swap_remove(at)).is_some();
        a.len() == b.len() && a.iter().all(take)
    };
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| all(a, b))
}

/// Writes markers with corners on a grid of some units of the plot in both dialects; what is read may differ by `most`.
fn check_dialects(grid: i64, most: u64) {
    let mut count = 0;
    for seed in 0..200 {
        let mut random = fastrand::Rng::with_seed(seed);
        let parts: Vec<Part> = (0..5).map(|i| part(&mut random, [8000 + 12_000 * i, 8000], grid)).collect();
        count += parts.iter().map(|part| part.slits.len()).sum::<usize>();
        let cut = source(cut_file(&parts));
        let mut found = Diagnostics::default();
        let cut = pipeline::read(&cut, by_name("iso"), &Job::default(), &mut found).expect("a cut file").marker;
        assert!(!found.has_errors(), "{found:?}");
        let (outlines, slits) = shapes(&cut);
        for drawn in [Drawn::Spikes, Drawn::Marks] {
            let (plotted, found) = read(&source(plot(&parts, drawn)), &as_drawn());
            assert!(!found.iter().any(|code| code.starts_with("hpgl/")), "seed {seed}: {found:?}");
            let (drawn_outlines, drawn_slits) = shapes(&plotted);
            assert!(outlines_agree(&outlines, &drawn_outlines, most), "seed {seed}: {outlines:?} {drawn_outlines:?}");
            assert!(slits_agree(&slits, &drawn_slits, most), "seed {seed}: {slits:?} {drawn_slits:?}");
        }
    }
    assert!(count > 1000, "{count}");
}

#[test]
fn a_marker_is_the_same_from_a_plot_and_from_a_cut_file() {
    check_dialects(PLOT_UNITS, 0);
}

#[test]
fn a_marker_that_each_dialect_rounds_to_its_unit_is_the_same_within_the_coarser_one() {
    check_dialects(1, PLOT_UNITS as u64 / 2);
}

// ---- What pens and options decide.

/// A part with a cut-out and a grain line of pen 1, a cut-out of pen 4.
fn two_pens() -> Source {
    let grain = "PU2000,3000;PD6000,3000;";
    let text = [
        &rectangle(0, 0, 8000, 8000),
        &rectangle(1000, 1000, 1000, 1000),
        grain,
        "SP4;",
        &rectangle(4000, 4000, 2000, 2000),
    ];
    source(format!("IN;SP1;{}PU;SP0;", text.concat()))
}

#[test]
fn pens_and_options_decide_what_is_cut() {
    let check = |edit: &dyn Fn(&mut Job), expected: [usize; 4]| {
        let mut job = Job::default();
        edit(&mut job);
        let (marker, found) = read(&two_pens(), &job);
        assert_eq!(counts(&marker), expected, "{found:?}");
    };
    let inner = |inner| move |job: &mut Job| job.lines.inner = Some(inner);
    let pen = |pen: &'static str, usage| move |job: &mut Job| _ = job.profile.hpgl.pens.insert(pen.to_owned(), usage);
    let only = |pens| move |job: &mut Job| job.lines.pens = Some(Numbers::parse(pens).expect("numbers"));
    check(&|_| {}, [1, 1, 0, 0]);
    check(&inner(Inner::Ignore), [1, 1, 0, 0]);
    check(&inner(Inner::Cut), [1, 3, 0, 0]);
    check(&|job| job.profile.hpgl.inner = Inner::Cut, [1, 3, 0, 0]);
    check(&|job| job.lines.all = true, [1, 4, 0, 0]);
    check(&pen("4", PenUse::Knife), [1, 2, 0, 0]);
    check(&pen("1", PenUse::Knife), [1, 2, 0, 0]);
    check(&pen("1", PenUse::Pen), [0, 0, 0, 0]);
    check(&pen("1", PenUse::Ignore), [1, 1, 0, 0]);
    check(&only("4"), [1, 1, 0, 0]);
    check(&only("1-4"), [1, 3, 0, 0]);
    check(&|job| job.lines = Lines { pens: Numbers::parse("1").ok(), all: true, ..Lines::default() }, [1, 3, 0, 0]);
    // What a pen that only draws adds to the edge of a part that is cut is a notch; what an ignored one adds is
    // nothing.
    let text = format!("IN;SP4;{}SP1;PU4000,0;PD4000,200;PU;SP0;", rectangle(0, 0, 8000, 8000));
    for (usage, notches) in [(PenUse::Pen, 1), (PenUse::Knife, 1), (PenUse::Ignore, 0)] {
        let mut job = Job::default();
        only("4")(&mut job);
        assert_eq!(counts(&read(&source(text.clone()), &job).0), [1, 1, 1, 0]);
        let mut job = Job::default();
        pen("1", usage)(&mut job);
        assert_eq!(counts(&read(&source(text.clone()), &job).0), [1, 1, notches, 0], "{usage:?}");
    }
}

#[test]
fn small_squares_and_circles_are_holes_when_the_profile_wants_that() {
    let small = [rectangle(2000, 2000, 120, 120), "PU4000,4000;CI80;".to_owned(), rectangle(6000, 2000, 120, 400)];
    let text = source(format!("IN;{}{}PU;", rectangle(0, 0, 8000, 8000), small.concat()));
    let mut job = Job::default();
    assert_eq!(counts(&read(&text, &job).0), [1, 1, 0, 0]);
    job.profile.hpgl.drill_max_mm = Some(5.0);
    let (marker, _) = read(&text, &job);
    assert_eq!(counts(&marker), [1, 1, 0, 2]);
    assert!((marker.pieces[0].drills[0].at - Point::new(51.5, 51.5)).norm() < 1e-9);
    assert!((marker.pieces[0].drills[1].at - Point::new(100.0, 100.0)).norm() < 1e-9);
}

#[test]
fn an_outline_is_whole_when_its_strokes_miss_each_other_by_a_few_units_and_named_when_by_more() {
    let strokes = |gap: i64| {
        let miss = 4000 + gap;
        format!("IN;PU0,0;PD4000,0;PU{miss},0;PD4000,4000;PU4000,{miss};PD0,4000;PU{},4000;PD0,{gap};PU;", -gap)
    };
    let one = |gap: i64| format!("IN;PU0,0;PD4000,0,4000,4000,0,4000,0,{gap};PU;");
    for gap in 1..=4 {
        for text in [strokes(gap), one(gap)] {
            let (marker, found) = read(&source(text), &Job::default());
            assert_eq!((counts(&marker), found), ([1, 1, 0, 0], vec![]), "{gap}");
            assert!(marker.contours().all(|(_, contour)| contour.closed));
        }
    }
    for (gap, code) in [(5, "drawing/closed"), (39, "drawing/closed"), (61, "drawing/open-outlines")] {
        let (_, found) = read(&source(strokes(gap)), &Job::default());
        let expected = if gap < 60 { "drawing/closed" } else { "drawing/nothing-to-cut" };
        assert_eq!(found, [expected], "{gap}");
        let text = rectangle(10_000, 0, 4000, 4000) + &one(gap);
        let (_, found) = read(&source(text), &Job::default());
        assert_eq!(found, [code], "{gap}");
    }
}

#[test]
fn the_unit_is_that_of_the_profile() {
    let text = source(format!("IN;{}PU;", rectangle(0, 0, 8000, 4000)));
    for (unit, width) in [("1/40 mm", 200.0), ("1/1000 in", 203.2), ("0.1", 800.0), ("400 dpi", 508.0)] {
        let mut job = Job::default();
        job.profile.hpgl.unit = PlotUnit::parse(unit).expect("a unit");
        let (width_found, _) = read(&text, &job).0.extent().size();
        assert!((width_found - width).abs() < 1e-9, "{unit}: {width_found}");
    }
    let wide = source(format!("IN;{}PU;", rectangle(0, 0, 800_000, 400_000)));
    assert_eq!(read(&wide, &Job::default()).1, ["hpgl/unit-doubtful", "drawing/size"]);
}

/// What is found in a plot with these options, as people read it.
fn said(text: &str, job: &Job) -> String {
    let source = source(text);
    let mut found = Diagnostics::default();
    pipeline::read(&source, by_name("hpgl"), job, &mut found);
    cutc::diagnostic::render(&found, &source)
}

#[test]
fn when_nothing_is_cut_the_hint_names_the_pens_and_what_left_them_out() {
    let open = "IN;SP3;PU0,0;PD4000,0,4000,4000;SP5;PU0,500;PD900,500;PU;";
    let check = |edit: &dyn Fn(&mut Job), expected: &str| {
        let mut job = Job::default();
        edit(&mut job);
        let said = said(open, &job);
        assert!(said.contains("drawing/nothing-to-cut") && said.contains(expected), "{expected}: {said}");
    };
    check(&|_| {}, "the file draws with pens 3,5");
    check(&|job| job.lines.pens = Numbers::parse("7").ok(), "`--cut-pens 7` leaves all lines out");
    let ignore = |job: &mut Job| {
        let pens = ["3", "5"].map(|pen| (pen.to_owned(), PenUse::Ignore));
        job.profile.hpgl.pens.extend(pens);
    };
    check(
        &ignore,
        "`hpgl.pens` of the profile leaves them out; the file draws with pens 3,5; `--set hpgl.pens.3=knife`",
    );
    let without = open.replace("SP3", "SP0").replace("SP5", "SP0");
    assert!(said(&without, &Job::default()).contains("let the CAD take pen 1"));
}

// ---- Recognition.

#[test]
fn content_decides_whatever_the_extension() {
    let iso = b"H1*G71*M15*N1*X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*M0*".to_vec();
    let plot = format!("IN;SP1;{}PU;", rectangle(0, 0, 8000, 4000)).into_bytes();
    let csv = b"x_mm,y_mm\n0,0\n1,0\n".to_vec();
    for (bytes, expected) in [(iso, "iso"), (plot, "hpgl"), (csv, "csv")] {
        for extension in ["plt", "cut", "gbr", "nc", "iso", "cam", "PLT"] {
            let found = front::choose(&source(bytes.clone()), None, Some(extension), &mut Diagnostics::default());
            assert_eq!(found.map(|dialect| dialect.name), Some(expected), "{extension}");
        }
    }
}
