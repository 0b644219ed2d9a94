//! Plots: the same marker as from a cut file, what pens and options decide, a second reading that agrees, and patience
//! with bytes that are no plot.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use cutc::diagnostic::Diagnostics;
use cutc::front::{self, by_name};
use cutc::geom::Point;
use cutc::ir::{Finding, Marker};
use cutc::machine::plot::{LineKind, Lines, PenUse, PlotUnit};
use cutc::machine::{Job, Numbers};
use cutc::pipeline::{self, Report};
use cutc::source::Source;
use cutc::verify::{Census, source_audit};

fn source(bytes: impl Into<Vec<u8>>) -> Source {
    Source::new("a.plt", bytes.into()).expect("small")
}

/// Reads a plot and runs the passes: the marker and the codes of what was found.
fn read(source: &Source, job: &Job) -> (Marker, Vec<&'static str>) {
    let mut found = Diagnostics::default();
    let input = pipeline::read(source, by_name("hpgl"), job, &mut found).expect("the dialect is given");
    (input.marker, found.iter().map(|diagnostic| diagnostic.code.name).collect())
}

/// The marker as it was read, before any pass.
fn as_read(source: &Source, job: &Job) -> Marker {
    (by_name("hpgl").expect("a dialect").read)(source, job, &mut Diagnostics::default())
}

/// A closed rectangle, in units of the file.
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
    let all = |a: &[[Place; 2]], b: &[[Place; 2]]| a.len() == b.len() && a.iter().all(|a| b.iter().any(|b| near(a, b)));
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
            let (plotted, found) = read(&source(plot(&parts, drawn)), &Job::default());
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
    let kind = |kind| move |job: &mut Job| job.lines.kind = Some(kind);
    let pen = |pen: &'static str, usage| move |job: &mut Job| _ = job.profile.hpgl.pens.insert(pen.to_owned(), usage);
    let only = |pens| move |job: &mut Job| job.lines.pens = Some(Numbers::parse(pens).expect("numbers"));
    check(&|_| {}, [1, 3, 0, 0]);
    check(&kind(LineKind::All), [1, 4, 0, 0]);
    check(&kind(LineKind::Closed), [1, 3, 0, 0]);
    check(&kind(LineKind::Open), [1, 1, 0, 0]);
    check(&pen("4", PenUse::Pen), [1, 2, 0, 0]);
    check(&pen("4", PenUse::Ignore), [1, 2, 0, 0]);
    check(&pen("1", PenUse::Pen), [1, 1, 0, 0]);
    check(&pen("1", PenUse::Knife), [1, 4, 0, 0]);
    check(&only("4"), [1, 1, 0, 0]);
    check(&only("1-4"), [1, 4, 0, 0]);
    check(&|job| job.lines = Lines { pens: Numbers::parse("1").ok(), kind: Some(LineKind::Open) }, [1, 1, 0, 0]);
}

#[test]
fn small_squares_and_circles_are_holes_when_the_profile_wants_that() {
    let small = [rectangle(2000, 2000, 120, 120), "PU4000,4000;CI80;".to_owned(), rectangle(6000, 2000, 120, 400)];
    let text = source(format!("IN;{}{}PU;", rectangle(0, 0, 8000, 8000), small.concat()));
    let mut job = Job::default();
    assert_eq!(counts(&read(&text, &job).0), [1, 4, 0, 0]);
    job.profile.hpgl.drill_max_mm = Some(5.0);
    let (marker, _) = read(&text, &job);
    assert_eq!(counts(&marker), [1, 2, 0, 2]);
    assert!((marker.pieces[0].drills[0].at - Point::new(51.5, 51.5)).norm() < 1e-9);
    assert!((marker.pieces[0].drills[1].at - Point::new(100.0, 100.0)).norm() < 1e-9);
}

#[test]
fn an_outline_is_whole_when_its_strokes_miss_each_other_by_a_unit_and_named_when_by_more() {
    let strokes = |gap: i64| {
        let miss = 4000 + gap;
        format!("IN;PU0,0;PD4000,0;PU{miss},0;PD4000,4000;PU4000,{miss};PD0,4000;PU{},4000;PD0,{gap};PU;", -gap)
    };
    let (marker, found) = read(&source(strokes(1)), &Job::default());
    assert_eq!((counts(&marker), found), ([1, 1, 0, 0], vec![]));
    assert!(marker.contours().all(|(_, contour)| contour.closed));
    for gap in [3, 39] {
        let (_, found) = read(&source(strokes(gap)), &Job::default());
        assert_eq!(found, ["hpgl/open-outline", "hpgl/nothing-to-cut"], "{gap}");
    }
}

#[test]
fn a_nesting_that_was_cut_short_is_an_error() {
    let nested: String = (0..20_000).map(|i| rectangle(i, i, 100_000 - 2 * i, 100_000 - 2 * i)).collect();
    assert!(within_patience("nested outlines", nested.into_bytes()).contains(&"hpgl/too-many-lines"));
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
    assert_eq!(read(&wide, &Job::default()).1, ["hpgl/unit-doubtful"]);
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
        assert!(said.contains("hpgl/nothing-to-cut") && said.contains(expected), "{expected}: {said}");
    };
    check(&|_| {}, "the file draws with pens 3,5");
    check(&|job| job.lines.pens = Numbers::parse("7").ok(), "`--cut-pens 7` leaves all lines out");
    check(&|job| job.lines.kind = Some(LineKind::Closed), "`--cut closed` leaves out every open line");
    let ignore = |job: &mut Job| {
        let pens = ["3", "5"].map(|pen| (pen.to_owned(), PenUse::Ignore));
        job.profile.hpgl.pens.extend(pens);
    };
    check(&ignore, "`hpgl.pens` of the profile leaves them out; the file draws with pens 3,5; `--cut-pens 3,5`");
    let without = open.replace("SP3", "SP0").replace("SP5", "SP0");
    assert!(said(&without, &Job::default()).contains("let the CAD take pen 1"));
}

#[test]
fn an_outline_whose_halves_cancel_is_cut_when_asked_for_and_named_otherwise() {
    let bow_tie = format!("IN;SP1;{}PU0,0;PD4000,0,0,4000,4000,4000,0,0;PU;", rectangle(10_000, 0, 4000, 4000));
    let (marker, found) = read(&source(bow_tie.clone()), &Job::default());
    assert_eq!((counts(&marker), found), ([1, 1, 0, 0], vec!["hpgl/crossed-outline"]));
    for kind in [LineKind::Closed, LineKind::All] {
        let job = Job { lines: Lines { kind: Some(kind), ..Lines::default() }, ..Job::default() };
        let (marker, found) = read(&source(bow_tie.clone()), &job);
        assert_eq!((counts(&marker), found), ([2, 2, 0, 0], vec!["marker/self-crossing"]));
    }
    // A line that goes out and back goes around nothing, straight or not.
    for line in ["PU0,0;PD4000,0,1000,0,0,0;PU;", "PU0,0;PD4000,0,4000,4000,4000,0,0,0;PU;"] {
        let job = Job { lines: Lines { kind: Some(LineKind::Closed), ..Lines::default() }, ..Job::default() };
        assert_eq!(counts(&read(&source(format!("{line}{}", rectangle(9000, 0, 400, 400))), &job).0), [1, 1, 0, 0]);
    }
}

#[test]
fn letters_are_told_from_small_parts_by_the_row_that_they_stand_in() {
    let check = |drawn: &str, contours: usize, is_text: bool| {
        let text = format!("IN;{}{drawn}PU;", rectangle(0, 0, 8000, 8000));
        let (marker, found) = read(&source(text), &Job::default());
        assert_eq!(counts(&marker)[1], contours, "{drawn}");
        assert_eq!(found.contains(&"hpgl/taken-for-text"), is_text, "{drawn}: {found:?}");
    };
    let small = rectangle(2000, 2000, 100, 200);
    check(&small, 2, false);
    // Digits of one height; another line; a grain line in a part; a third shape makes a row.
    check(&format!("{small}PU1950,2000;PD1950,2200;"), 1, true);
    check(&format!("{small}PU1950,2000;PD1950,2150;"), 2, false);
    check(&format!("{small}PU2050,2050;PD2050,2150;PU1950,2000;PD1950,2200;"), 2, false);
    check(&format!("{small}PU1950,2000;PD1950,2150;PU2150,2000;PD2150,2150;"), 1, true);
    check(&format!("{small}PU1990,1800;PD2390,1900;PU1990,2300;PD2390,2400;"), 2, false);
}

// ---- Recognition.

#[test]
fn content_decides_whatever_the_extension() {
    let iso = b"H1*G71*M15*N1*X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*M0*".to_vec();
    let plot = format!("IN;SP1;{}PU;", rectangle(0, 0, 8000, 4000)).into_bytes();
    let csv = b"x_mm,y_mm\n0,0\n1,0\n".to_vec();
    for (bytes, expected) in [(iso, "iso"), (plot, "hpgl"), (csv, "csv")] {
        for extension in ["plt", "cut", "gbr", "nc", "iso", "cam", "PLT"] {
            let found = front::detect(&source(bytes.clone()), Some(extension), &mut Diagnostics::default());
            assert_eq!(found.map(|dialect| dialect.name), Some(expected), "{extension}");
        }
    }
}

// ---- The second reading.

fn audit(source: &Source, marker: &Marker, job: &Job) -> Vec<Finding> {
    let found = source_audit("hpgl", source.bytes(), &Census::of(marker), &job.profile).expect("plots have a scan");
    found.into_iter().filter(|finding| !finding.holds()).collect()
}

fn fixtures() -> Vec<(String, Source)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/hpgl");
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path()).collect();
    paths.sort();
    let named = |path: std::path::PathBuf| (path.display().to_string(), source(fs::read(&path).expect("readable")));
    paths.into_iter().map(named).collect()
}

#[test]
fn a_second_reading_finds_what_the_reader_finds_in_every_plot_whatever_is_cut() {
    let mut drilling = Job::default();
    drilling.profile.hpgl.drill_max_mm = Some(8.0);
    let mut jobs = vec![Job::default(), drilling];
    for kind in [LineKind::All, LineKind::Closed, LineKind::Open] {
        jobs.push(Job { lines: Lines { kind: Some(kind), ..Lines::default() }, ..Job::default() });
    }
    let mut differing = Vec::new();
    for (name, source) in fixtures() {
        for job in &jobs {
            let broken = audit(&source, &as_read(&source, job), job);
            if !broken.is_empty() {
                differing.push(format!("{name}, {:?}: {broken:?}", job.lines));
            }
        }
    }
    assert!(differing.is_empty(), "{differing:#?}");
}

#[test]
fn a_marker_that_lacks_a_contour_a_point_or_a_notch_is_refused() {
    let job = Job::default();
    let (mut contours, mut points, mut notches) = (0, 0, 0);
    for (name, source) in fixtures() {
        let marker = as_read(&source, &job);
        let mut lacking = marker.clone();
        if lacking.pieces[0].contours.pop().is_some() {
            contours += 1;
            assert!(!audit(&source, &lacking, &job).is_empty(), "{name}");
        }
        let mut lacking = marker.clone();
        let contour = &mut lacking.pieces[0].contours[0];
        points += 1;
        *lacking.list.cursor(&mut contour.range).from_mut() += cutc::geom::Vector::new(4.0, 3.0);
        assert!(!audit(&source, &lacking, &job).is_empty(), "{name}");
        let mut lacking = marker.clone();
        if lacking.pieces[0].notches.pop().is_some() {
            notches += 1;
            assert!(!audit(&source, &lacking, &job).is_empty(), "{name}");
        }
    }
    assert!(contours > 30 && points > 30 && notches >= 5, "{contours} {points} {notches}");
}

#[test]
fn arcs_through_places_on_a_line_are_lines_whatever_the_scale() {
    let mut random = fastrand::Rng::with_seed(3);
    for _ in 0..2000 {
        let corners = [(); 2].map(|()| random.i32(3000..9000));
        let range = random.i32(7..500);
        let (x, y) = (f64::from(range) * 0.1, f64::from(range) * 0.3);
        let (way, rise) = (f64::from(random.i32(1..9)) / 10.0, f64::from(random.i32(-9..9)) / 10.0);
        let at = |k: i32| format!("{:.1},{:.1}", x + way * f64::from(k), y + rise * f64::from(k));
        let (from, middle, to) = (random.i32(-3..3), random.i32(-9..9), random.i32(3..9));
        let text = format!(
            "IN;IP0,0,{},{};SC0,{range},0,{range};PU{};PD;AT{},{};PA0,0,{};PU;",
            corners[0],
            corners[1],
            at(from),
            at(middle),
            at(to),
            at(from)
        );
        let source = source(text.clone());
        let job = Job { lines: Lines { kind: Some(LineKind::All), ..Lines::default() }, ..Job::default() };
        let marker = as_read(&source, &job);
        assert!(marker.pieces.iter().flat_map(|p| &p.contours).all(|c| marker.points(c).len() <= 4), "{text}");
        assert_eq!(audit(&source, &marker, &job), [], "{text}");
    }
}

#[test]
fn a_mirrored_scale_gives_the_mirror_image_curves_and_all() {
    let drawing = "SP1;PU20,20;PD100,20;AA100,60,180;AR0,10,-90;PD20,100,20,20;PU40,60;EW10,0,90;PU80,60;EW10,30,-200;\
                   PU60,40;AT70,50,60,60;PD60,40;PU150,150;CI20;PU;";
    let job = Job::default();
    let plain = source(format!("IN;IP0,0,8000,8000;SC0,200,0,200;{drawing}"));
    let whole = read(&plain, &job).0;
    for (scale, is_turned) in [("0,200,200,0", false), ("200,0,0,200", true)] {
        let mirrored = source(format!("IN;IP0,0,8000,8000;SC{scale};{drawing}"));
        let marker = read(&mirrored, &job).0;
        assert_eq!(audit(&mirrored, &as_read(&mirrored, &job), &job), []);
        let points =
            |marker: &Marker| -> Vec<Point> { marker.contours().flat_map(|(_, c)| marker.points(c)).collect() };
        let (points, mirrored) = (points(&whole), points(&marker));
        assert_eq!(points.len(), mirrored.len());
        let image = |p: &Point| if is_turned { Point::new(200.0 - p.x, p.y) } else { Point::new(p.x, 200.0 - p.y) };
        assert!(points.iter().zip(&mirrored).all(|(p, q)| (image(p) - q).norm() < 1e-9), "{scale}");
    }
}

#[test]
fn a_marker_of_another_unit_than_the_profile_is_refused() {
    let plot = two_pens();
    let mut marker = as_read(&plot, &Job::default());
    marker.unit = 0.0254;
    assert!(!audit(&plot, &marker, &Job::default()).is_empty());
    let mut job = Job::default();
    job.profile.hpgl.unit = PlotUnit::of_mm(0.0254);
    assert!(!audit(&plot, &as_read(&plot, &Job::default()), &job).is_empty());
}

// ---- Patience.

/// The longest that a hostile file may take in a test build, far above what it takes.
const PATIENCE: Duration = Duration::from_secs(20);

fn within_patience(what: &str, bytes: Vec<u8>) -> Vec<&'static str> {
    let source = source(bytes);
    let mut found = Diagnostics::default();
    let start = Instant::now();
    (by_name("hpgl").expect("a dialect").read)(&source, &Job::default(), &mut found);
    assert!(start.elapsed() < PATIENCE, "{what}: {:?}", start.elapsed());
    found.iter().map(|diagnostic| diagnostic.code.name).collect()
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused_quickly() {
    const SIZE: usize = 100 << 20;
    let mut random = fastrand::Rng::with_seed(8);
    let mut garbage = |pick: &mut dyn FnMut(&mut fastrand::Rng) -> u8| -> Vec<u8> {
        // A stretch is random, and repeated: making it must not take longer than reading it.
        let stretch: Vec<u8> = (0..1 << 16).map(|_| pick(&mut random)).collect();
        stretch.into_iter().cycle().take(SIZE).collect()
    };
    let bytes = garbage(&mut |random| random.u8(..));
    assert_eq!(within_patience("bytes", bytes), ["source/unknown-format"]);
    let text = garbage(&mut |random| random.u8(b' '..=b'~'));
    let found = within_patience("text", text.clone());
    assert!(found.iter().any(|code| ["hpgl/not-a-plot", "hpgl/encoding-damaged"].contains(code)), "{found:?}");
    let start = Instant::now();
    let detected = front::detect(&source(text), Some("plt"), &mut Diagnostics::default()).map(|dialect| dialect.name);
    assert!(detected != Some("hpgl") && start.elapsed() < PATIENCE / 10);
    for (what, word) in
        [("numbers", "1,"), ("semicolons", ";"), ("labels", "LB"), ("escapes", "\u{1b}%0B"), ("junk", "!?")]
    {
        let bytes: Vec<u8> = word.bytes().cycle().take(SIZE).collect();
        let found = within_patience(what, bytes);
        let refused = ["hpgl/not-a-plot", "hpgl/nothing-to-cut", "source/unknown-format"];
        assert!(found.iter().any(|code| refused.contains(code)), "{what}: {found:?}");
    }
}

#[test]
fn drawings_made_to_be_slow_are_read_in_time() {
    let nested: String = (0..20_000).map(|i| rectangle(i, i, 100_000 - 2 * i, 100_000 - 2 * i)).collect();
    within_patience("nested outlines", nested.into_bytes());
    let specks: String = (0..60_000).map(|i| rectangle(i % 300, i / 300, 1, 1) + "PU5,5;PD6,6;").collect();
    within_patience("specks", specks.into_bytes());
    let comb = (0..40_000).fold(String::new(), |comb, i| comb + &format!("PU{i},100;PD{i},200;"));
    within_patience("marks", format!("{}{comb}", rectangle(0, 100, 40_000, 10_000)).into_bytes());
    let fan = (0..60_000).fold(String::new(), |fan, i| fan + &format!("PU0,0;PD{i},900;"));
    within_patience("strokes that all meet", fan.into_bytes());
    let curves = "CI99999999;".repeat(300);
    assert_eq!(within_patience("circles", format!("PU0,0;{curves}").into_bytes()), ["hpgl/far-place"]);
    let curves = "CI30000000;".repeat(3000);
    let found = within_patience("near circles", format!("PU0,0;{curves}").into_bytes());
    assert!(found.contains(&"hpgl/too-many-chords"), "{found:?}");
    let polygons = format!("PM0;PD{}PM2;{}", "9,9,5,5,".repeat(10_000), "EP;".repeat(100_000));
    let found = within_patience("polygons", polygons.into_bytes());
    assert!(found.contains(&"hpgl/too-many-chords"), "{found:?}");
}

#[test]
fn no_coordinate_wraps_around() {
    for number in
        ["2147483647", "2147483648", "4294967296", "4294971296", "18446744073709551616", "99999999999999999999999"]
    {
        for sign in ["", "-"] {
            let text = format!("IN;PU0,0;PD{sign}{number},0,4000,4000,0,0;PU;");
            let (_, found) = read(&source(text), &Job::default());
            assert!(found.contains(&"hpgl/number-overflow"), "{sign}{number}: {found:?}");
        }
    }
    let sums = format!("IN;PR;PD{}PU;", "99999999,1,".repeat(30) + "0,0;");
    assert!(read(&source(sums), &Job::default()).1.contains(&"hpgl/far-place"));
}

#[test]
fn an_outline_that_is_cut_short_is_never_cut_in_silence() {
    let first = format!("IN;SP1;{}", rectangle(1000, 1000, 8000, 4000));
    let whole = format!("{first}{}PU;SP0;", rectangle(10_000, 1000, 8000, 4000));
    let complete = read(&source(whole.clone()), &Job::default()).0.cut_length();
    for length in 1..whole.len() {
        let (marker, found) = read(&source(&whole.as_bytes()[..length]), &Job::default());
        let is_complete = (marker.cut_length() - complete).abs() < 1e-9;
        // Where the pen is up or was just lowered, or an outline is whole, nobody can tell that a part should follow.
        let is_whole = length + 1 >= first.len() && length <= first.len();
        let pen_is_up =
            !whole[..length].rsplit_once('P').is_some_and(|(_, last)| last.starts_with('D') && last.len() > 1);
        assert!(
            is_complete || is_whole || pen_is_up || !found.is_empty(),
            "after {length} bytes: {}",
            &whole[..length]
        );
    }
}
