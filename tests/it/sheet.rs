//! How the marker lies on the table: turned, mirrored, scaled, moved and copied markers are cut as large as they should be, and
//! what lies otherwise is refused.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::{Heading, Point, Vector};
use cutc::ir::Marker;
use cutc::ir::marker::Notch;
use cutc::ir::text::print_marker;
use cutc::machine::{Flip, Job, Mirror, Mode, Numbers, OrderPolicy, Sheet, Start};
use cutc::pass::marker::{DRAWN_PASSES, MARKER_PASSES};
use cutc::pipeline::{self, Compiled};
use cutc::source::Source;
use cutc::verify::Drawn;
use fastrand::Rng;

use crate::ONE_IN;
use crate::garment::{self, Dialect, Order};
use crate::nest::bricks;
use crate::support;
use crate::support::room::{DONE, FAULTY, Room};

/// Two parts with all that lies askew when a sheet is wrong, beside each other; tenths of a millimetre.
const MARKER: &str = "H1*G71*N3*F300*X1200Y300M43*X300Y200M31*FRONT*TNORF*X400Y300M31*\
    X300Y0*M14*M19*X300Y50*M15*X500Y0*M14*M19*X500Y60*M15*X480Y60*M14*X530Y60*M15*\
    X0Y0*M14*X900Y0*X910Y50*X920Y0*X1500Y0*M25*X1600Y500*M26*X1500Y800*X200Y700*X0Y0*M15*\
    N7*M01*X2000Y100M31*BACK*X2300Y200*M15*X1900Y0*M14*X2900Y0*X2700Y800*M46*X1900Y600*X1900Y0*M15*M0*\n";

fn job(sheet: &Sheet) -> Job {
    let mut job = Job::default();
    job.profile.sheet = sheet.clone();
    job
}

fn source(text: &str) -> Source {
    Source::new("marker.cut", text.as_bytes().to_vec()).expect("small")
}

/// The marker of a source behind some of the passes; `None` when it has errors.
fn passed(source: &Source, job: &Job, passes: usize) -> Option<Marker> {
    let mut found = Diagnostics::default();
    let dialect = pipeline::read(source, None, &Job::default(), &mut found)?.dialect;
    let mut marker = pipeline::marker_of(dialect, source, job, &mut found);
    for pass in &MARKER_PASSES[..passes] {
        (!found.has_errors()).then(|| (pass.run)(&mut marker, job, &mut found))?;
    }
    (!found.has_errors()).then_some(marker)
}

/// As it is drawn.
fn drawn(source: &Source) -> Option<Marker> {
    passed(source, &Job::default(), DRAWN_PASSES)
}

/// As it lies on a sheet, ordered and chosen.
fn laid(source: &Source, job: &Job) -> Option<Marker> {
    passed(source, job, MARKER_PASSES.iter().position(|pass| pass.name == "table").expect("a pass") + 1)
}

fn compiled(source: &Source, job: &Job, target: &str) -> (Compiled, Vec<u8>) {
    let target = TARGETS.iter().find(|row| row.name == target).expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = pipeline::Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes everything");
    let case = || format!("{}, {:?}: {}", source.name(), job.profile.sheet, render(&found, source));
    let compiled = compiled.unwrap_or_else(|| panic!("{}", case()));
    assert!(compiled.verdict.as_ref().is_some_and(pipeline::Verdict::passes), "{}", case());
    (compiled, out.into_inner())
}

/// A sheet of any kind.
fn any_sheet(rng: &mut Rng) -> Sheet {
    let scale = |rng: &mut Rng| if rng.bool() { 1.0 } else { 0.8 + 0.4 * rng.f64() };
    Sheet {
        origin: if rng.u8(0..4) == 0 { None } else { Some([rng.f64() * 500.0, rng.f64() * 50.0 - 20.0]) },
        mirror: if rng.bool() { Mirror::Ends } else { Mirror::Off },
        flip: if rng.bool() { Flip::Sides } else { Flip::Off },
        rotate_deg: [0.0, 90.0, 180.0, -90.0, 37.0, 360.0 * rng.f64()][rng.usize(0..6)],
        scale_x: scale(rng),
        scale_y: scale(rng),
        copies: rng.u32(1..4),
        copies_gap_mm: 5.0 + 10.0 * rng.f64(),
    }
}

/// The length of all that is drawn, had it been turned and scaled, mm.
fn length(marker: &Marker, sheet: &Sheet) -> f64 {
    let turn = sheet.rotate_deg.to_radians();
    let scaled = |way: Vector| {
        let [x, y] = [way.x * turn.cos() - way.y * turn.sin(), way.x * turn.sin() + way.y * turn.cos()];
        (sheet.scale_x * x).hypot(sheet.scale_y * y)
    };
    let contours = marker.contours().flat_map(|(_, contour)| marker.list.lines(contour.range));
    let strokes = marker.pieces.iter().flat_map(|piece| &piece.notches).flat_map(Notch::strokes);
    let strokes = strokes.map(|stroke| [stroke.from, stroke.to]);
    f64::from(sheet.copies) * contours.chain(strokes).map(|[from, to]| scaled(to - from)).sum::<f64>()
}

fn files(folder: &str) -> Vec<Source> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(folder);
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).expect("fixtures").map(|entry| entry.expect("readable").path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        Source::new(name, fs::read(&path).expect("readable")).expect("small")
    };
    paths.into_iter().map(read).collect()
}

#[test]
fn a_sheet_that_changes_nothing_gives_the_same_bytes() {
    let marker = source(MARKER);
    let expected = compiled(&marker, &Job::default(), "csv").1;
    let plain = Sheet { copies_gap_mm: 7.0, ..Sheet::default() };
    for sheet in [plain, Sheet { rotate_deg: 360.0, ..Sheet::default() }] {
        assert!(compiled(&marker, &job(&sheet), "csv").1 == expected, "{sheet:?}");
    }
}

#[test]
fn whatever_the_sheet_every_file_lies_as_it_says_and_is_as_long_as_scaled() {
    let mut rng = Rng::with_seed(11);
    let mut count = 0;
    for marker in ["iso", "hpgl", "pattern", "dxf", "svg"].into_iter().flat_map(files) {
        let Some(drawn) = drawn(&marker) else { continue };
        for _ in 0..4 {
            let sheet = any_sheet(&mut rng);
            let mut job = job(&sheet);
            job.profile.order.policy = [OrderPolicy::File, OrderPolicy::Fastest, OrderPolicy::Steady][rng.usize(0..3)];
            // Advances keep the cloth where it is.
            let Some(laid) = laid(&marker, &job) else { continue };
            count += 1;
            let finding = Drawn::of(&drawn).laid(&laid, &job);
            assert!(finding.holds(), "{}, {sheet:?}: {finding:?}", marker.name());
            let (found, expected) = (laid.drawn_length(), length(&drawn, &sheet));
            assert!((found - expected).abs() <= 1e-9 * (1.0 + expected), "{}, {sheet:?}", marker.name());
        }
    }
    assert!(count > 1000, "{count} sheets");
}

#[test]
fn programs_of_any_sheet_are_verified() {
    let mut rng = Rng::with_seed(5);
    let marker = source(MARKER);
    for _ in 0..60 / ONE_IN * 4 {
        let sheet = any_sheet(&mut rng);
        let (compiled, _) = compiled(&marker, &job(&sheet), "csv");
        assert_eq!(compiled.report.pieces, 2 * sheet.copies as usize);
        let expected = length(&drawn(&marker).expect("sound"), &sheet) / 1000.0;
        assert!((compiled.report.cut_m - expected).abs() < 1e-9, "{sheet:?}");
    }
    for (seed, dialect) in [(1, Dialect::G71), (2, Dialect::Inch)] {
        let order = Order { dialect, pieces: 4, cutouts: true, seed, ..Order::default() };
        let mut bytes = Vec::new();
        garment::write(&order, &mut bytes).expect("memory takes it");
        let made = Source::new("made.cut", bytes).expect("small");
        for sheet in [
            Sheet { rotate_deg: 37.0, scale_x: 1.03, ..Sheet::default() },
            Sheet { mirror: Mirror::Ends, copies: 2, copies_gap_mm: 3.0, ..Sheet::default() },
            Sheet { flip: Flip::Sides, rotate_deg: 90.0, scale_y: 0.97, origin: None, ..Sheet::default() },
        ] {
            compiled(&made, &job(&sheet), "csv");
        }
    }
}

#[test]
fn nests_that_share_their_edges_are_verified_on_any_sheet() {
    let plain = Sheet::default();
    for gap in [0.0, 0.1] {
        let nest = source(&bricks(gap));
        for sheet in [
            Sheet { mirror: Mirror::Ends, ..plain.clone() },
            Sheet { flip: Flip::Sides, ..plain.clone() },
            Sheet { rotate_deg: 90.0, ..plain.clone() },
            Sheet { rotate_deg: 37.0, ..plain.clone() },
            Sheet { rotate_deg: 0.4, scale_x: 1.04, scale_y: 0.98, ..plain.clone() },
            Sheet { scale_x: 1.2, scale_y: 0.8, ..plain.clone() },
            // The copies touch, too.
            Sheet { copies: 2, copies_gap_mm: gap, mirror: Mirror::Ends, ..plain.clone() },
        ] {
            let (compiled, _) = compiled(&nest, &job(&sheet), "csv");
            let common = compiled.report.common.expect("parts touch");
            let pieces = compiled.report.pieces;
            let between = common.all.iter().filter(|edge| edge.copies.is_some_and(|[one, other]| one != other)).count();
            assert_eq!(between > 0, sheet.copies > 1, "{sheet:?}");
            assert!(common.edges >= pieces, "{sheet:?}: {} edges of {pieces} pieces", common.edges);
        }
    }
}

#[test]
fn gaps_as_wide_as_the_band_are_no_matter_of_the_angle() {
    // Gaps of two tenths, which is the band: turned, rounding makes them a little more here and a little less there.
    let nest = files("markers").into_iter().find(|source| source.name() == "touching-parts.cut").expect("a fixture");
    for angle in [3.0, 7.0, 11.0, 17.0, 29.0, 53.0] {
        let sheet = Sheet { rotate_deg: angle, origin: Some([517.123, 3.7]), ..Sheet::default() };
        compiled(&nest, &job(&sheet), "csv");
    }
}

/// What is done to a marker that lies right.
type Damage = (&'static str, fn(&mut Marker));

const DAMAGES: &[Damage] = &[
    ("a copy is missing", |marker| marker.pieces.retain(|piece| piece.copy != 2)),
    ("a piece of a copy is missing", |marker| drop(marker.pieces.remove(1))),
    ("a piece stands there twice", |marker| marker.pieces.push(marker.pieces[1].clone())),
    ("a piece is of another copy", |marker| marker.pieces[0].copy = 2),
    ("a point is moved", |marker| {
        let mut range = marker.pieces[2].contours[0].range;
        marker.list.cursor(&mut range).to_mut().x += 1e-5;
    }),
    ("a joint is lost", |marker| {
        let mut range = marker.pieces[3].contours[0].range;
        let mut cursor = marker.list.cursor(&mut range);
        while !cursor.segment().joint.lift {
            assert!(cursor.advance(), "M46 asks for a lift");
        }
        cursor.joint_mut().lift = false;
    }),
    ("a speed is lost", |marker| marker.pieces[2].feed = None),
    ("a slow stretch is lost", |marker| {
        let mut range = marker.pieces[2].contours[0].range;
        let mut cursor = marker.list.cursor(&mut range);
        while cursor.advance() {
            *cursor.percent_mut() = 100;
        }
    }),
    ("a contour is left out", |marker| marker.pieces[2].contours.clear()),
    ("a hole is left behind", |marker| marker.pieces[2].drills[0].at.x -= 10.0),
    ("a hole has another drill", |marker| marker.pieces[2].drills[0].tool = 2),
    ("a slit is left behind", |marker| marker.pieces[0].notches[0].root.y += 0.1),
    ("a notch is deeper", |marker| marker.pieces[0].notches[1].tip.y += 0.1),
    ("a notch of an outline is left behind", |marker| marker.pieces[0].outline_notches[0].tip.x += 0.1),
    ("a text is left behind", |marker| {
        let at = marker.pieces[2].labels[0].at.as_mut();
        at.expect("a place").x = 30.0;
    }),
    ("a text is upside down", |marker| {
        let heading = &mut marker.pieces[0].labels[0].heading;
        *heading = heading.map(|heading| Heading::new(heading.radians() + std::f64::consts::PI));
    }),
    ("a text is in its other form", |marker| {
        let label = &mut marker.pieces[0].labels[0];
        label.span = label.mirrored.replace(label.span).expect("two forms");
    }),
    ("a text is lost", |marker| marker.pieces[3].labels.clear()),
    ("a stop is lost", |marker| marker.pieces[3].events.clear()),
    ("the unit is another", |marker| marker.unit *= 1.01),
];

#[test]
fn what_a_pass_lays_wrongly_is_refused() {
    let marker = source(MARKER);
    let drawn = drawn(&marker).expect("sound");
    let right = Sheet {
        origin: Some([10.0, 20.0]),
        mirror: Mirror::Ends,
        rotate_deg: 3.0,
        scale_x: 1.03,
        copies: 2,
        copies_gap_mm: 25.0,
        ..Sheet::default()
    };
    let sheet = job(&right);
    let laid = |job: &Job| laid(&marker, job).expect("sound");
    let finding = Drawn::of(&drawn).laid(&laid(&sheet), &sheet);
    assert!(finding.holds(), "{finding:?}");
    for (name, damage) in DAMAGES {
        let mut damaged = laid(&sheet);
        damage(&mut damaged);
        let finding = Drawn::of(&drawn).laid(&damaged, &sheet);
        assert!(!finding.holds() && finding.rule.name == "source/laid", "{name}: {finding:?}");
    }
    // A pass that misreads a key.
    for (name, wrong) in [
        ("not mirrored", Sheet { mirror: Mirror::Off, ..right.clone() }),
        ("mirrored and flipped", Sheet { flip: Flip::Sides, ..right.clone() }),
        ("flipped instead", Sheet { mirror: Mirror::Off, flip: Flip::Sides, ..right.clone() }),
        ("turned the other way", Sheet { rotate_deg: -3.0, ..right.clone() }),
        ("scaled twice", Sheet { scale_x: 1.03 * 1.03, ..right.clone() }),
        ("scaled along the other axis", Sheet { scale_x: 1.0, scale_y: 1.03, ..right.clone() }),
        ("scaled along both axes", Sheet { scale_y: 1.03, ..right.clone() }),
        ("scaled a little otherwise", Sheet { scale_x: 1.030_01, ..right.clone() }),
        ("moved the other way", Sheet { origin: Some([-10.0, 20.0]), ..right.clone() }),
        ("in the corner", Sheet { origin: None, ..right.clone() }),
        ("one copy", Sheet { copies: 1, ..right.clone() }),
        ("three copies", Sheet { copies: 3, ..right.clone() }),
        ("copies without a gap", Sheet { copies_gap_mm: 0.0, ..right.clone() }),
        ("as drawn", Sheet::default()),
    ] {
        assert!(!Drawn::of(&drawn).laid(&laid(&job(&wrong)), &sheet).holds(), "{name}");
    }
}

#[test]
fn a_program_for_another_sheet_is_refused() {
    let marker = source(MARKER);
    let right = Sheet { scale_x: 1.03, copies: 2, copies_gap_mm: 10.0, ..Sheet::default() };
    let (_, program) = compiled(&marker, &job(&right), "csv");
    for wrong in [
        Sheet::default(),
        Sheet { scale_x: 1.02, ..right.clone() },
        Sheet { flip: Flip::Sides, ..right.clone() },
        Sheet { copies: 1, ..right.clone() },
        Sheet { copies: 3, ..right.clone() },
        Sheet { copies_gap_mm: 11.0, ..right.clone() },
    ] {
        let mut found = Diagnostics::default();
        let judged =
            pipeline::judge_program(&mut Cursor::new(program.clone()), &marker, None, &job(&wrong), None, &mut found);
        let explained = judged.expect("memory is read").expect("the source is sound");
        assert!(!explained.verdict.passes(), "{wrong:?}");
    }
}

#[test]
fn a_cut_file_of_a_sheet_is_read_back_as_it_lies() {
    let marker = source(MARKER);
    let sheet = Sheet { rotate_deg: 37.0, scale_x: 1.1, copies: 2, mirror: Mirror::Ends, ..Sheet::default() };
    let job = job(&sheet);
    let (_, bytes) = compiled(&marker, &job, "iso");
    let text = String::from_utf8(bytes).expect("ASCII");
    assert!(text.contains("G71*") && text.contains("N3*") && text.matches("N7*").count() == 2, "{text}");
    let again = drawn(&source(&text)).expect("sound");
    let laid = laid(&marker, &job).expect("sound");
    let (one, other) = (again.extent(), laid.extent());
    assert!((one.min - other.min).norm() < 1e-5 && (one.max - other.max).norm() < 1e-5);
    assert!((again.drawn_length() - laid.drawn_length()).abs() < 1e-3);
}

#[test]
fn cut_files_of_any_sheet_say_what_the_marker_says() {
    let mut rng = Rng::with_seed(3);
    let mut count = 0;
    for marker in files("iso") {
        let sheet = any_sheet(&mut rng);
        let target = TARGETS.iter().find(|row| row.name == "iso").expect("a target");
        let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
        let order = pipeline::Order { from: None, target, verify: true };
        let made = pipeline::compile(&marker, &job(&sheet), order, &mut out, &mut found).expect("memory");
        count += usize::from(made.is_some());
        // Some cannot be written, or lie before an advance.
        let broken = found.iter().filter(|finding| finding.code.name == "verify/broken").count();
        assert_eq!(broken, 0, "{}, {sheet:?}: {}", marker.name(), render(&found, &marker));
    }
    assert!(count > 40, "{count} cut files");
}

#[test]
fn pieces_are_chosen_in_every_copy_and_stay_where_they_lie() {
    let marker = source(MARKER);
    let sheet = Sheet { copies: 3, copies_gap_mm: 10.0, rotate_deg: 90.0, ..Sheet::default() };
    let all = laid(&marker, &job(&sheet)).expect("sound");
    let of =
        |marker: &Marker| -> Vec<(u32, u32)> { marker.pieces.iter().map(|piece| (piece.number, piece.copy)).collect() };
    assert_eq!(of(&all), [(3, 1), (7, 1), (3, 2), (7, 2), (3, 3), (7, 3)]);
    let mut chosen = job(&sheet);
    chosen.selection.pieces = Some(Numbers::parse("7").expect("a number"));
    let some = laid(&marker, &chosen).expect("sound");
    assert_eq!(of(&some), [(7, 1), (7, 2), (7, 3)]);
    let text = |marker: &Marker, i: usize| {
        let text = print_marker(marker);
        text.split("\npiece ").nth(i + 1).expect("a piece").trim_end().to_owned()
    };
    assert_eq!(text(&some, 1), text(&all, 3));
    let mut resumed = job(&sheet);
    resumed.selection.resume_from = Some(Start::Piece { number: 7, copy: 2 });
    assert_eq!(of(&laid(&marker, &resumed).expect("sound")), [(7, 2), (3, 3), (7, 3)]);
    compiled(&marker, &resumed, "csv");
    resumed.selection.resume_from = Some(Start::Piece { number: 7, copy: 4 });
    assert!(laid(&marker, &resumed).is_none());
    for mode in [Mode::Dry, Mode::Frame] {
        compiled(&marker, &Job { mode, ..chosen.clone() }, "csv");
    }
    compiled(&marker, &chosen, "csv");
}

#[test]
fn a_marker_off_the_table_is_told_the_sheet_that_fits() {
    let room = Room::with("m.cut", MARKER);
    // Both axes at once, beside an origin that is there.
    let table = "--set table.x_mm=[20,500] --set table.y_mm=[-3,100]";
    let said = room.says(&format!("compile m.cut {table} --set sheet.origin=[0,-5]"), FAULTY);
    assert!(said.contains("error[marker/off-table]"), "{said}");
    assert_eq!(said.matches("marker/off-table").count(), 1, "{said}");
    let told = said.split("sheet.origin = ").nth(1).and_then(|rest| rest.split('\n').next()).expect("an origin");
    let told = told.replace(' ', "");
    room.expect(&format!("compile m.cut {table} --set sheet.origin={told}"), DONE);
    // Too many copies for the length of the table.
    let table = "--set table.x_mm=[-10,1000] --set table.y_mm=[-10,100] --set sheet.copies_gap_mm=20";
    let said = room.says(&format!("compile m.cut {table} --set sheet.copies=5"), FAULTY);
    assert!(said.contains("so many copies fit: sheet.copies = 3"), "{said}");
    room.expect(&format!("compile m.cut {table} --set sheet.copies=3"), DONE);
    // Along the wrong axis.
    let table = "--set table.x_mm=[0,200] --set table.y_mm=[0,400]";
    let said = room.says(&format!("compile m.cut {table}"), FAULTY);
    assert!(said.contains(r#"sheet.rotate_deg = 90, sheet.origin = "corner""#), "{said}");
}

#[test]
fn in_the_corner_of_the_table_there_is_room_for_the_blade() {
    let room = Room::with("m.cut", MARKER);
    let sheet =
        "--set sheet.origin=corner --set sheet.copies=2 --set sheet.copies_gap_mm=20 --set order.policy=fastest";
    for ends in [[0, 2000], [300, 5000]] {
        let table = format!("--set table.x_mm=[{},{}] --set table.y_mm=[{},{}]", ends[0], ends[1], ends[0], ends[1]);
        let said = room.says(&format!("compile m.cut -o m.csv --force {table} {sheet}"), DONE);
        assert!(said.contains("verified") && !said.contains("marker/over-edge"), "{said}");
    }
    let source = source(MARKER);
    let mut job = job(&Sheet { origin: None, ..Sheet::default() });
    let least = |job: &Job| laid(&source, job).expect("sound").extent().min;
    assert_eq!(least(&job), Point::origin(), "a table without ends has no edges");
    // A blade of 6.6 mm and 0.8 mm of overlap.
    job.profile.table.y_mm = Some([-50.0, 100.0]);
    assert!((least(&job) - Point::new(0.0, -50.0 + 7.4)).norm() < 1e-9);
    // In the middle of a table that is but a little wider.
    job.profile.table.y_mm = Some([0.0, 86.0]);
    assert!((least(&job) - Point::new(0.0, 3.0)).norm() < 1e-9, "{:?}", least(&job));
}

#[test]
fn a_blade_off_the_table_is_told_a_move_that_works_at_the_first_go() {
    let room = Room::with("m.cut", MARKER);
    let table = "--set table.x_mm=[-0.1,400] --set table.y_mm=[-0.1,200]";
    let said = room.says(&format!("compile m.cut -o m.csv {table}"), FAULTY);
    assert!(said.contains("marker/off-table") && said.contains("move the marker by X +7.3 mm and Y +7.3 mm"), "{said}");
    assert!(
        said.contains("sheet.origin = \"corner\"") && !said.contains("verify/table"),
        "told before planning: {said}"
    );
    let told = said.split("sheet.origin = [").nth(1).and_then(|rest| rest.split(';').next()).expect("an origin");
    let told = format!("[{}", told.replace(' ', ""));
    let said = room.says(&format!("compile m.cut -o m.csv {table} --set sheet.origin={told}"), DONE);
    assert!(!said.contains("marker/over-edge"), "{said}");
    // Where there is no room for the blade on both sides no move helps.
    let table = "--set table.x_mm=[-10,400] --set table.y_mm=[0,80]";
    let said = room.says(&format!("compile m.cut -o m.csv {table}"), FAULTY);
    assert!(
        said.contains("along Y the table leaves 0.0 mm beside the marker, and the blade may need 14.8 mm"),
        "{said}"
    );
}

#[test]
fn reports_say_what_sheet_was_applied_and_tell_copies_apart() {
    let room = Room::with("m.cut", MARKER);
    let sheet = "--set sheet.scale_x=1.03 --set sheet.copies=2 --set sheet.copies_gap_mm=10";
    let line = "  sheet      scaled by 1.03 x 1, 2 copies, 10 mm apart\n";
    for command in ["compile m.cut -o m.csv", "info m.cut", "info m.cut --time", "check m.cut"] {
        let said = room.says(&format!("{command} {sheet}"), DONE);
        assert_eq!(said.matches(line).count(), 1, "{command}: {said}");
        let said = room.says(command, DONE);
        assert!(!said.contains("sheet"), "{command}: {said}");
    }
    let (json, _) = room.expect(&format!("info m.cut --format json {sheet}"), DONE);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&json["sheet"]["copies"], &json["sheet"]["scale_x"]), (&2.into(), &1.03.into()));
    assert_eq!(json["pieces"], 4);
    // The second copy alone is judged for what it is.
    let said = room.says(&format!("compile m.cut -o m.csv {sheet}"), DONE);
    assert!(said.contains("verified"), "{said}");
    room.expect(&format!("verify m.csv --source m.cut {sheet}"), DONE);
    let other = sheet.replace("copies=2", "copies=3");
    let said = room.says(&format!("verify m.csv --source m.cut {other}"), FAULTY);
    assert!(said.contains("piece 3 of copy 3") && !said.contains("piece 3 of copy 2"), "{said}");
}

#[test]
fn a_file_that_moves_the_cloth_on_is_moved_and_flipped_alone() {
    let room = Room::with("m.cut", &MARKER.replace("M01*", "M69*"));
    for keys in ["copies=2", "rotate_deg=1", "scale_x=1.01", "mirror=ends"] {
        let said = room.says(&format!("compile m.cut --set sheet.{keys}"), FAULTY);
        assert!(said.contains("error[sheet/advance]") && said.contains("codes.M69"), "{said}");
        room.expect(&format!("compile m.cut --set sheet.{keys} --set codes.M69=ignore"), DONE);
    }
    for keys in ["origin=[5,5]", "origin=corner", "scale_y=1.01", "flip=sides"] {
        room.expect(&format!("compile m.cut --set sheet.{keys}"), DONE);
    }
    for keys in ["mirror=sides", "flip=ends", "scale_x=1.3", "copies=0", "copies=1.5", "rotate_deg=400", "origin=[1]"] {
        let (_, said) = room.expect(&format!("compile m.cut --set sheet.{keys}"), 2);
        assert!(said.contains("`sheet."), "{said}");
    }
}

#[test]
fn more_copies_than_a_program_holds_are_refused_before_they_are_made() {
    let points: Vec<Point> = (0..1_100_000).map(|i| Point::new(0.1 * f64::from(i), f64::from(i % 2))).collect();
    let mut marker = support::marker(&points);
    let mut found = Diagnostics::default();
    let sheet = Sheet { copies: 1000, ..Sheet::default() };
    (MARKER_PASSES[DRAWN_PASSES].run)(&mut marker, &job(&sheet), &mut found);
    assert_eq!(marker.pieces.len(), 1);
    let refused = found.iter().next().expect("an error");
    assert_eq!(refused.code.name, "sheet/too-many-copies");
    assert!(refused.hints[0].contains("61 times"), "{:?}", refused.hints);
}

#[test]
fn the_sheet_is_laid_when_all_that_has_a_size_of_its_own_is_found() {
    assert_eq!(MARKER_PASSES[DRAWN_PASSES].name, "sheet");
    // A notch of 14 mm is one; cloth that shrinks does not make it a dart.
    let deep = "H1*G71*N1*X0Y0*M14*X500Y0*X510Y140*X520Y0*X2000Y0*X2000Y1000*X0Y1000*X0Y0*M15*M0*";
    let sheet = Sheet { scale_x: 1.2, scale_y: 1.2, ..Sheet::default() };
    let laid = laid(&source(deep), &job(&sheet)).expect("sound");
    let notch = laid.pieces[0].outline_notches[0];
    assert!((notch.depth() - 1.2 * 14.0).abs() < 0.1 && (notch.width() - 2.4).abs() < 1e-9, "{notch:?}");
}
