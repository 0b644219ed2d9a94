//! The second reading of a plot agrees with the reader, and refuses a marker that is damaged.

use std::fs;
use std::path::Path;

use cutc::geom::{Extent, Point, Vector};
use cutc::ir::drawing::{Aside, Redrawn, Vertex};
use cutc::ir::marker::Contour;
use cutc::ir::{Finding, Marker};
use cutc::machine::Job;
use cutc::machine::plot::{Inner, Lines, PlotUnit};
use cutc::source::{Source, Span};
use cutc::verify::{Census, source_audit};

use super::{as_read, rectangle, source, two_pens};

pub(super) fn audit(source: &Source, marker: &Marker, job: &Job) -> Vec<Finding> {
    let found = source_audit("hpgl", source.bytes(), &Census::of(marker), &job.profile).expect("plots have a scan");
    found.into_iter().filter(|finding| !finding.holds()).collect()
}

/// What a user may ask to be cut.
fn choices() -> [Job; 4] {
    let lines = [
        Lines::default(),
        Lines { inner: Some(Inner::Cut), ..Lines::default() },
        Lines { inner: Some(Inner::All), ..Lines::default() },
        Lines { all: true, ..Lines::default() },
    ];
    lines.map(|lines| Job { lines, ..Job::default() })
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
    jobs.extend(choices());
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
    assert!(contours > 30 && points > 30 && notches >= 4, "{contours} {points} {notches}");
}

/// The rule that must see some damage.
type Damage<'a> = (&'static str, &'a dyn Fn(&mut Aside));

#[test]
fn an_account_of_what_is_left_aside_that_is_wrong_in_anything_is_refused() {
    let job = Job::default();
    let line = |y: f64| [Point::new(10.0, y), Point::new(110.0, y)];
    let redraw = |aside: &mut Aside, by: f64| {
        aside.moved.redrawn.push(Redrawn { drawn: line(10.0).to_vec(), now: line(10.0 + by) });
    };
    let add_at = |aside: &mut Aside, places: [[f64; 2]; 2]| {
        let vertex =
            |(at, block): ([f64; 2], u32)| Vertex { at: at.into(), span: Span { start: block, end: block, block } };
        aside.add(None, &places.into_iter().zip(1..).map(vertex).collect::<Vec<_>>());
    };
    let add = |aside: &mut Aside, xs: [f64; 2]| add_at(aside, xs.map(|x| [x, 10.0]));
    let damages: [Damage; 6] = [
        ("source/points", &|aside| aside.moved.points += 1),
        ("source/points", &|aside| add(aside, [10.0, 10.0])),
        ("source/bounds", &|aside| add_at(aside, [[1e4, 1e4], [1e4, 1e4 + 1.0]])),
        ("source/length", &|aside| add(aside, [10.0, 110.0])),
        // Something drawn is accounted for beside its place.
        ("source/moments", &|aside| redraw(aside, 0.29)),
        // One that was moved farther than rounding parts lines is not accounted for at all.
        ("source/length", &|aside| {
            add(aside, [10.0, 110.0]);
            aside.moved.redrawn.push(Redrawn { drawn: line(400.0).to_vec(), now: line(10.0) });
        }),
    ];
    for (name, source) in fixtures() {
        let marker = as_read(&source, &job);
        for (rule, damage) in &damages {
            let mut damaged = marker.clone();
            damage(&mut damaged.drawing.as_mut().expect("a plot has an account").aside);
            let broken = audit(&source, &damaged, &job);
            assert!(broken.iter().any(|finding| finding.rule.name == *rule), "{name}: {rule} {broken:?}");
        }
    }
}

/// What a sound plot is refused for, whatever is cut of it.
fn refusals(text: &str) -> Vec<Finding> {
    let source = source(text);
    choices().iter().flat_map(|job| audit(&source, &as_read(&source, job), job)).collect()
}

#[test]
fn a_sound_plot_is_not_refused() {
    let part = rectangle(0, 0, 8000, 4000);
    // An open polygon that is drawn twice is one line, out and back.
    let twice = "PU0,5000;PM0;PD4000,5000,4000,9000;PU0,5000;PM2;EP;EP;";
    assert_eq!(refusals(&format!("IN;SP1;{part}{twice}PU;SP0;")), []);
    assert_eq!(refusals(&format!("IN;SP1;{part}{}PU;SP0;", twice.replace("EP;EP;", "EP;EP;EP;"))), []);
    // A polygon is drawn with the turn that is in force then.
    let turned = "PS40000,30000;PU9000,9000;PM0;PD;AA12000,9000,180;PD9000,9500;PM2;RO90;EP;RO180;EP;RO0;PU;SP0;";
    assert_eq!(refusals(&format!("IN;SP1;{turned}")), []);
    // Figures of all kinds in a polygon.
    let figures = "PM0;PU9000,9000;CI900;PM1;PU12000,9000;EW900,30,100;PM1;EW700,0,360;PM1;EA13000,12000;PM2;EP;PU0,0;";
    assert_eq!(refusals(&format!("IN;SP1;{part}{figures}PU;SP0;")), []);
    // Decimals that matter where a scale makes them large.
    let scaled = "IP0,0,40000,40000;SC0,0.0001,0,0.0001;PU0,0;PD.00001234567,0,.00001234567,.00007654321,0,0;";
    assert_eq!(refusals(&format!("IN;{scaled}PU;SP0;")), []);
    // Arcs of few chords on an edge are no marks of two legs, whose points would be counted.
    for degrees in 1..60 {
        let half = (1000.0 * (f64::from(degrees) / 2.0).to_radians().sin()).round();
        let centre = (1000.0 * (f64::from(degrees) / 2.0).to_radians().cos()).round();
        let arc = format!("PU{},0;PD;AA4000,{},-{degrees};", 4000.0 - half, -centre);
        assert_eq!(refusals(&format!("IN;SP1;{part}{arc}PU;SP0;")), [], "{degrees}");
    }
}

#[test]
fn a_damaged_encoding_is_scanned_without_an_overflow() {
    let far = "~".repeat(6);
    let source = source(format!("IN;SP1;{}PE>{far}\u{e0}\u{e0}\u{e0};", rectangle(0, 0, 8000, 4000)));
    audit(&source, &as_read(&source, &Job::default()), &Job::default());
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

/// Eight parts, the one in the middle without any symmetry; `curves` makes one of them round.
fn parts(curves: &str) -> Source {
    let corners: String =
        [[0, 0], [30_000, 0], [0, 30_000], [30_000, 30_000]].map(|[x, y]| rectangle(x, y, 4000, 3000)).concat();
    let middle = "PU10000,10000;PD14000,10500,16000,13000,12000,15500,10400,14000,10000,10000;";
    source(format!("IN;SP1;{corners}{middle}{curves}PU;SP0;"))
}

/// Does something to the points of a contour.
fn change(marker: &mut Marker, contour: Contour, change: &dyn Fn(Point) -> Point) {
    let Contour { mut range, .. } = contour;
    let mut cursor = marker.list.cursor(&mut range);
    let first = cursor.from_mut();
    *first = change(*first);
    loop {
        let next = cursor.to_mut();
        *next = change(*next);
        if !cursor.advance() {
            break;
        }
    }
}

#[test]
fn what_moves_turns_or_is_mirrored_within_the_bounds_is_refused() {
    let job = Job::default();
    for curves in ["", "PU22000,20000;CI2500;PU20000,9000;PD;AA20500,9000,180;PD20000,9000;"] {
        let source = parts(curves);
        let whole = as_read(&source, &job);
        assert_eq!(audit(&source, &whole, &job), []);
        let middle = whole.pieces[4].contours[0];
        let extent = whole.points(&middle).into_iter().fold(Extent::EMPTY, |mut extent, point| {
            extent.add(point);
            extent
        });
        let sum = extent.min + extent.max.coords;
        let unit = job.profile.hpgl.unit.mm();
        let check = |what: &str, edit: &dyn Fn(Point) -> Point| {
            let mut damaged = whole.clone();
            change(&mut damaged, middle, edit);
            let rules: Vec<&str> = audit(&source, &damaged, &job).iter().map(|finding| finding.rule.name).collect();
            assert!(rules.contains(&"source/moments"), "{what}: {rules:?}");
        };
        check("shifted by a unit", &|p| p + Vector::new(unit, 0.0));
        check("shifted far", &|p| p + Vector::new(0.0, 137.0));
        check("mirrored in X", &|p| Point::new(sum.x - p.x, p.y));
        check("mirrored in Y", &|p| Point::new(p.x, sum.y - p.y));
        check("turned by half", &|p| Point::new(sum.x - p.x, sum.y - p.y));
        check("coordinates swapped", &|p| Point::new(p.y, p.x));
        check("coordinates of a corner swapped", &|p| if p.x == 400.0 { Point::new(p.y, p.x) } else { p });
        check("a corner moved by a unit", &|p| if p.x == 400.0 { Point::new(p.x, p.y + unit) } else { p });
    }
}

#[test]
fn a_shift_of_any_contour_of_any_plot_is_refused() {
    let job = Job::default();
    let mut count = 0;
    for (name, source) in fixtures() {
        let marker = as_read(&source, &job);
        let contours: Vec<Contour> = marker.contours().map(|(_, contour)| *contour).collect();
        for contour in contours {
            let mut damaged = marker.clone();
            change(&mut damaged, contour, &|p| p + Vector::new(0.25, -0.25));
            assert!(!audit(&source, &damaged, &job).is_empty(), "{name}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn whatever_lines_meet_where_nothing_is_lost() {
    let mut random = fastrand::Rng::with_seed(11);
    let mut closed = 0;
    for _ in 0..400 {
        // Lines between the places of a grid, so that many meet; marks of one line and of two at some of them.
        let (cells, size) = (random.i32(2..6), random.i32(100..2000));
        let side = i64::from((cells - 1) * size);
        let mut text = format!("IN;SP1;{}", rectangle(0, 0, side, side));
        for _ in 0..random.usize(4..60) {
            let place = |random: &mut fastrand::Rng| [0; 2].map(|_| random.i32(0..cells) * size);
            let [x, y] = place(&mut random);
            let rise = random.i32(-200..200);
            let line = match random.u8(0..4) {
                0 => format!("PU{x},{y};PD{},{};", x + random.i32(-200..200), y + rise),
                1 => format!("PU{},{y};PD{},{},{},{y};", x + 9, x + 69, y + rise, x + 129),
                _ => {
                    let places = (0..random.usize(1..6)).map(|_| place(&mut random));
                    let places: Vec<String> = places.map(|[x, y]| format!("{x},{y}")).collect();
                    format!("PU{x},{y};PD{};", places.join(","))
                }
            };
            text += &line;
        }
        let source = source(text.clone() + "PU;SP0;");
        for job in choices() {
            let marker = as_read(&source, &job);
            assert_eq!(audit(&source, &marker, &job), [], "{:?} {text}", job.lines);
            assert_eq!(Census::of(&marker), Census::of(&as_read(&source, &job)));
            closed += marker.contours().filter(|(_, contour)| contour.closed).count();
        }
    }
    assert!(closed > 1000, "{closed}");
}
