//! Markers that follow a cloth: every place goes with it, lines are parted where it bends, and what does not follow is refused.

use std::io::Cursor;
use std::sync::Arc;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::ir::text::print_marker;
use cutc::machine::{Centre, Job, OrderPolicy};
use cutc::pass::marker::{DRAWN_PASSES, MARKER_PASSES};
use cutc::pipeline;
use cutc::source::Source;
use cutc::track::centre;
use cutc::verify::Drawn;

use super::{fixture, source};
use crate::support::room::{DONE, FAULTY, Room};

/// What is done to a marker.
type Harm = fn(&mut Marker);

/// A marker with all that a cloth carries: parts that touch, a cut-out, notches, a drill, labels.
const MARKER: &str = "fixtures/markers/drills-and-slits.cut";

/// A cloth that wanders by some mm within some others, as a file.
fn wandering(amplitude: f64, length: f64) -> String {
    let row = |x: i32| {
        let x = f64::from(x) * 5.0;
        format!("{x:.3},{:.3}\n", amplitude * (x / length * std::f64::consts::TAU).sin())
    };
    format!("conv_mm,centre_mm\n{}", (-20..1200).map(row).collect::<String>())
}

fn job(text: &str) -> Job {
    let source = source("cloth.centre.csv", text);
    let mut out = Diagnostics::default();
    let line = centre::read(&source, &mut out).unwrap_or_else(|| panic!("{}", render(&out, &source)));
    Job { centre: Some(Arc::new(Centre { line, source: Arc::new(source), rulers: None })), ..Job::default() }
}

fn marker_source() -> Source {
    source(MARKER, fixture(MARKER.strip_prefix("fixtures/").expect("a fixture")))
}

/// The marker behind the first so many passes.
fn passed(source: &Source, job: &Job, passes: usize) -> Marker {
    let mut found = Diagnostics::default();
    let dialect = pipeline::read(source, None, &Job::default(), &mut found).expect("a marker").dialect;
    let mut marker = pipeline::marker_of(dialect, source, job, &mut found);
    MARKER_PASSES[..passes].iter().for_each(|pass| (pass.run)(&mut marker, job, &mut found));
    assert!(!found.has_errors(), "{}", render(&found, source));
    marker
}

fn compiled(source: &Source, job: &Job, target: &str) -> Vec<u8> {
    let target = TARGETS.iter().find(|row| row.name == target).expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = pipeline::Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes everything");
    let compiled = compiled.unwrap_or_else(|| panic!("{}: {}", source.name(), render(&found, source)));
    assert!(compiled.verdict.is_some_and(|verdict| verdict.passes()));
    out.into_inner()
}

#[test]
fn programs_follow_the_cloth_and_pass_their_verification() {
    let markers = [
        "markers/drills-and-slits.cut",
        "markers/touching-parts.cut",
        "markers/circles.cut",
        "iso/drills-in-all-forms.cut",
    ];
    for name in markers {
        let source = source(name, fixture(name));
        for (amplitude, length) in [(5.0, 2000.0), (8.0, 1000.0), (5.0, 500.0)] {
            let mut job = job(&wandering(amplitude, length));
            compiled(&source, &job, "csv");
            job.profile.order.policy = OrderPolicy::Steady;
            compiled(&source, &job, "iso");
        }
    }
}

#[test]
fn a_cloth_that_lies_to_one_side_moves_the_marker_and_parts_nothing() {
    let source = marker_source();
    let straight = job("conv_mm,centre_mm\n-1000,2.5\n100000,2.5\n");
    let [plain, moved] = [&Job::default(), &straight].map(|job| passed(&source, job, DRAWN_PASSES + 2));
    let points =
        |marker: &Marker| marker.contours().flat_map(|(_, contour)| marker.points(contour)).collect::<Vec<Point>>();
    let [plain, moved] = [points(&plain), points(&moved)];
    assert_eq!(plain.len(), moved.len());
    assert!(plain.iter().zip(&moved).all(|(a, b)| a.x == b.x && (a.y + 2.5 - b.y).abs() < 1e-9));
}

#[test]
fn a_marker_that_does_not_follow_is_refused() {
    let source = marker_source();
    let followed = job(&wandering(6.0, 800.0));
    let other = job(&wandering(6.2, 800.0));
    let drawn = Drawn::of(&passed(&source, &Job::default(), DRAWN_PASSES));
    let laid = passed(&source, &followed, DRAWN_PASSES + 2);
    let away = |marker: &Marker| {
        let finding = drawn.laid(marker, &followed);
        (finding.holds(), finding.worst)
    };
    let (holds, worst) = away(&laid);
    assert!(holds && worst > 0.0 && worst < 0.05, "{worst}");
    // Not moved at all, only in part, or along with another cloth.
    assert!(!away(&passed(&source, &Job::default(), DRAWN_PASSES + 2)).0);
    assert!(!away(&passed(&source, &other, DRAWN_PASSES + 2)).0);
    // Moved point by point, without parting what the cloth bends.
    let mut unparted = passed(&source, &Job::default(), DRAWN_PASSES + 2);
    let line = followed.centre.as_ref().expect("a centre line").line.clone();
    unparted.list.move_points(|at| Point::new(at.x, at.y + line.at(at.x)));
    assert!(!away(&unparted).0);
    // A piece, a hole, a notch and a line that lie elsewhere.
    let harms: [(&str, Harm); 5] = [
        ("a piece is missing", |marker| _ = marker.pieces.pop()),
        ("a hole", |marker| {
            let drill = marker.pieces.iter_mut().flat_map(|piece| &mut piece.drills).next();
            drill.expect("a hole").at.y += 0.1;
        }),
        ("a notch", |marker| {
            let notch = marker.pieces.iter_mut().flat_map(|piece| &mut piece.notches).next();
            notch.expect("a notch").tip.x += 0.1;
        }),
        ("a point", |marker| {
            let mut range = marker.pieces[0].contours[0].range;
            marker.list.cursor(&mut range).to_mut().y += 0.1;
        }),
        ("along the feed", |marker| marker.list.move_points(|at| Point::new(at.x + 0.1, at.y))),
    ];
    for (what, harm) in harms {
        let mut marker = laid.clone();
        harm(&mut marker);
        assert!(!away(&marker).0, "{what} is not seen: {}", print_marker(&marker));
    }
}

#[test]
fn the_command_names_the_cloth_that_a_program_follows_and_verify_asks_for_the_same() {
    let room = Room::new();
    room.write("cloth.centre.csv", wandering(5.0, 300.0).as_bytes());
    room.write("other.centre.csv", wandering(5.5, 300.0).as_bytes());
    room.expect("compile circle.cut --centre cloth.centre.csv", DONE);
    let meta: serde_json::Value = serde_json::from_slice(&room.read("circle.csv.meta.json")).expect("JSON");
    assert_eq!(meta["centre"]["file"], "cloth.centre.csv");
    assert_eq!(meta["centre"]["sha256"].as_str().map(str::len), Some(64));
    assert_eq!(meta["options"], "--centre cloth.centre.csv");
    room.expect("verify circle.csv --source circle.cut --centre cloth.centre.csv", DONE);
    let said = room.says("verify circle.csv --source circle.cut --centre other.centre.csv", FAULTY);
    assert!(said.contains("follows another centre line"), "{said}");
    let said = room.says("verify circle.csv --source circle.cut", FAULTY);
    assert!(said.contains("with --centre cloth.centre.csv"), "{said}");
    // The table is looked at behind it.
    let said = room.says("compile circle.cut --centre cloth.centre.csv --set table.y_mm=[0,100]", FAULTY);
    assert!(said.contains("marker/off-table"), "{said}");
    room.write("short.centre.csv", b"conv_mm,centre_mm\n0,1\n");
    let said = room.says("compile circle.cut --centre short.centre.csv", FAULTY);
    assert!(said.contains("centre/short"), "{said}");
    // A folder is compiled anew when the cloth is another.
    room.expect("compile circle.cut --changed -o out/ --centre cloth.centre.csv", DONE);
    room.write("cloth.centre.csv", wandering(4.0, 300.0).as_bytes());
    let said = room.says("compile circle.cut --changed -o out/ --centre cloth.centre.csv", DONE);
    assert!(!said.contains("1 unchanged"), "{said}");
}
