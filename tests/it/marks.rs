//! Registration marks: a drawing is laid where its marks were found on the table, and what lies elsewhere is refused.

use std::fmt::Write as _;
use std::sync::Arc;

use cutc::diagnostic::Diagnostics;
use cutc::front;
use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::machine::{AffineMap, Job, Mark, Marks};
use cutc::pass::marker::{DRAWN_PASSES, MARKER_PASSES};
use cutc::pipeline;
use cutc::source::Source;
use cutc::verify::Drawn;
use fastrand::Rng;

use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A part with a hole, a notch and a text, and one more; tenths of a millimetre.
const MARKER: &str = "H1*G71*N1*X300Y200M31*FRONT*X400Y300M43*X0Y0*M14*X900Y0*X910Y50*X920Y0*X1500Y0*X1600Y500*X0Y700*X0Y0*M15*\
    N2*X2900Y0*M14*X3900Y0*X3700Y800*X2900Y600*X2900Y0*M15*M0*\n";

/// Places of marks about the marker.
const DRAWN: [[f64; 2]; 5] = [[-10.0, -10.0], [400.0, -10.0], [400.0, 90.0], [-10.0, 90.0], [200.0, 40.0]];

/// Marks that are found where a map has them.
fn marks(map: &AffineMap) -> Vec<Mark> {
    DRAWN.iter().map(|&drawn| Mark { drawn, found: map.place(drawn) }).collect()
}

/// Their file, each found so far off by turns to the right and to the left.
fn file(map: &AffineMap, off: f64) -> String {
    let mut text = String::from("x_mm,y_mm,found_x_mm,found_y_mm\n");
    for (k, Mark { drawn, found: [x, y] }) in marks(map).into_iter().enumerate() {
        let off = if k % 2 == 0 { off } else { -off };
        let _ = writeln!(text, "{},{},{:.4},{y:.4}", drawn[0], drawn[1], x + off);
    }
    text
}

fn job(text: &str) -> Job {
    let source = Arc::new(Source::new("marks.csv", text.as_bytes().to_vec()).expect("small"));
    let mut found = Diagnostics::default();
    let marks = front::marks::read(&source, Job::default().profile.map.max_mm, &mut found);
    Job { marks: Some(Arc::new(marks.expect("sound marks"))), ..Job::default() }
}

/// The marker as drawn and as laid.
fn both(job: &Job) -> [Marker; 2] {
    let source = Source::new("marker.cut", MARKER.as_bytes().to_vec()).expect("small");
    let mut found = Diagnostics::default();
    let dialect = pipeline::read(&source, None, &Job::default(), &mut found).expect("a cut file").dialect;
    let mut marker = pipeline::marker_of(dialect, &source, job, &mut found);
    MARKER_PASSES[..DRAWN_PASSES].iter().for_each(|pass| (pass.run)(&mut marker, job, &mut found));
    let drawn = marker.clone();
    let sheet = &MARKER_PASSES[DRAWN_PASSES];
    assert_eq!(sheet.name, "sheet");
    (sheet.run)(&mut marker, job, &mut found);
    assert!(!found.has_errors());
    [drawn, marker]
}

fn any_map(rng: &mut Rng) -> AffineMap {
    let mut about = |middle: f64, by: f64| middle + by * (2.0 * rng.f64() - 1.0);
    let axes = [[about(1.0, 0.03), about(0.0, 0.05)], [about(0.0, 0.05), about(1.0, 0.03)]];
    AffineMap { axes, by: [about(500.0, 400.0), about(300.0, 200.0)] }
}

#[test]
fn everything_lies_where_the_map_has_it_and_nothing_else_is_accepted() {
    let mut rng = Rng::with_seed(486);
    for _ in 0..200 {
        let map = any_map(&mut rng);
        let job = job(&file(&map, 0.0));
        let [drawn, laid] = both(&job);
        let place = |at: Point| Point::from(map.place([at.x, at.y]));
        let holes =
            |marker: &Marker| marker.pieces.iter().flat_map(|piece| &piece.drills).map(|d| d.at).collect::<Vec<_>>();
        assert!(holes(&drawn).into_iter().zip(holes(&laid)).all(|(a, b)| (place(a) - b).norm() < 1e-3));
        assert!(Drawn::of(&drawn).laid(&laid, &job).holds());
        let x = 1 + rng.usize(0..3);
        let damages: [fn(&mut Marker, usize); 4] = [
            |marker, _| marker.list.move_points(|at| Point::new(at.x + 2e-6, at.y)),
            |marker, _| marker.pieces[0].drills[0].at.y += 2e-6,
            |marker, k| {
                let mut range = marker.pieces[1].contours[0].range;
                let mut cursor = marker.list.cursor(&mut range);
                (0..k).for_each(|_| _ = cursor.advance());
                cursor.to_mut().x += 2e-6;
            },
            |marker, _| marker.unit *= 1.001,
        ];
        for damage in damages {
            let mut wrong = laid.clone();
            damage(&mut wrong, x);
            assert!(!Drawn::of(&drawn).laid(&wrong, &job).holds());
        }
        assert!(!Drawn::of(&drawn).laid(&drawn, &job).holds(), "as drawn");
    }
}

#[test]
fn a_compiler_that_takes_another_map_or_marks_that_give_none_is_refused() {
    let map = any_map(&mut Rng::with_seed(7));
    let right = job(&file(&map, 0.0));
    let [drawn, laid] = both(&right);
    assert!(Drawn::of(&drawn).laid(&laid, &right).holds());
    for by in [[1e-4, 0.0], [0.0, -1e-4]] {
        let by = [map.by[0] + by[0], map.by[1] + by[1]];
        let [_, wrong] = both(&job(&file(&AffineMap { by, ..map }, 0.0)));
        assert!(!Drawn::of(&drawn).laid(&wrong, &right).holds());
    }
    // Files without a sound map: the verifier refuses them, whatever map the compiler took.
    let text = file(&map, 0.0);
    let rows: Vec<&str> = text.lines().collect();
    let mirrored = file(&AffineMap { axes: [map.axes[0], map.axes[1].map(|way| -way)], ..map }, 0.0);
    for bad in [rows[..4].join("\n"), text.replace(rows[3], "1,2,3"), mirrored, file(&map, 2.0), String::new()] {
        let source = Arc::new(Source::new("marks.csv", bad.into_bytes()).expect("small"));
        let marks = Marks::new(marks(&map), source).expect("on no line");
        let job = Job { marks: Some(Arc::new(marks)), ..Job::default() };
        let [drawn, laid] = both(&job);
        assert!(!Drawn::of(&drawn).laid(&laid, &job).holds());
    }
}

#[test]
fn the_command_lays_a_marker_by_its_marks_and_verify_asks_for_the_same() {
    let room = Room::with("printed.cut", MARKER);
    let map = AffineMap { axes: [[1.004, 0.003], [-0.003, 0.997]], by: [120.0, 80.0] };
    room.write("marks.csv", file(&map, 0.2).as_bytes());
    room.write("other.csv", file(&AffineMap { by: [121.0, 80.0], ..map }, 0.2).as_bytes());
    let said = room.says("compile printed.cut --map marks.csv -t csv", DONE);
    assert!(said.contains("map        5 marks, at most 0.8"), "{said}");
    let meta: serde_json::Value = serde_json::from_slice(&room.read("printed.csv.meta.json")).expect("JSON");
    assert_eq!((&meta["map"]["file"], &meta["options"]), (&"marks.csv".into(), &"--map marks.csv".into()));
    room.expect("verify printed.csv --source printed.cut --map marks.csv", DONE);
    let said = room.says("verify printed.csv --source printed.cut --map other.csv", FAULTY);
    assert!(said.contains("was laid by other marks"), "{said}");
    let said = room.says("verify printed.csv --source printed.cut", FAULTY);
    assert!(said.contains("with --map marks.csv"), "{said}");
    room.expect("compile printed.cut --changed -o out/ --map marks.csv", DONE);
    room.write("marks.csv", file(&map, 0.1).as_bytes());
    let said = room.says("compile printed.cut --changed -o out/ --map marks.csv", DONE);
    assert!(!said.contains("1 unchanged"), "{said}");
}

#[test]
fn marks_that_say_nothing_sound_are_refused_and_odd_ones_are_doubted() {
    let room = Room::with("printed.cut", MARKER);
    let plain = AffineMap { axes: [[1.0, 0.0], [0.0, 1.0]], by: [50.0, 50.0] };
    let compiled = |marks: &str, more: &str, code: i32| {
        room.write("marks.csv", marks.as_bytes());
        room.says(&format!("compile printed.cut --map marks.csv -t csv --force {more}"), code)
    };
    let said = compiled(&file(&plain, 2.0), "", FAULTY);
    assert!(said.contains("marks/fit") && said.contains("map.max_mm"), "{said}");
    let said = compiled(&file(&plain, 2.0), "--set map.max_mm=9", DONE);
    assert!(!said.contains("marks/"), "{said}");
    let said = compiled(&file(&plain, 0.0), "--set sheet.origin=[10,10]", FAULTY);
    assert!(said.contains("marks/sheet"), "{said}");
    compiled(&file(&plain, 0.0), "--centre marks.csv", USAGE);
    for (stretch, code, word) in
        [(25.4, FAULTY, "as no cloth is"), (0.0, FAULTY, "marks/fit"), (1.06, DONE, "marks/odd")]
    {
        let stretched = AffineMap { axes: [[stretch, 0.0], [0.0, stretch]], ..plain };
        let said = compiled(&file(&stretched, 0.0), "", code);
        assert!(said.contains(word), "{said}");
    }
    let said = compiled(&file(&plain, 0.0), "--set table.x_mm=[0,300] --set table.y_mm=[0,200]", FAULTY);
    assert!(!said.contains("sheet."), "{said}");
    let said = compiled(&file(&plain, 0.0), "--set table.x_mm=[100,800] --set table.y_mm=[0,400]", FAULTY);
    assert!(said.contains("move the cloth by X") && !said.contains("sheet."), "{said}");
    let near = "x_mm,y_mm,found_x_mm,found_y_mm\n0,0,50,50\n100,0,150,50\n100,60,150,110\n0,60,50,110\n";
    let said = compiled(near, "", DONE);
    assert!(said.contains("marks/odd") && said.contains("beyond the marks"), "{said}");
    room.write("printed.cut", MARKER.replace("M0*", "M69*M0*").as_bytes());
    let said = compiled(&file(&plain, 0.0), "", FAULTY);
    assert!(said.contains("marks/sheet"), "{said}");
}

#[test]
fn a_map_lays_one_drawing_on_a_table() {
    let room = Room::with("printed.cut", MARKER);
    let plain = AffineMap { axes: [[1.002, 0.0], [0.0, 0.999]], by: [50.0, 50.0] };
    room.write("marks.csv", file(&plain, 0.0).as_bytes());
    let said = room.says("compile printed.cut circle.cut --map marks.csv -o out/", USAGE);
    assert!(said.contains("marks of its own"), "{said}");
    std::fs::create_dir(room.at("in")).expect("writable");
    let said = room.says("watch in -o out/ --map marks.csv", USAGE);
    assert!(said.contains("marks of its own"), "{said}");
    let said = room.says("flow printed.cut --map marks.csv -o plan/", USAGE);
    assert!(said.contains("on a table"), "{said}");
    let pattern = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/pictures/pattern.dxf");
    std::fs::copy(pattern, room.at("pattern.dxf")).expect("a copy");
    let said = room.says("compile pattern.dxf --map marks.csv", FAULTY);
    assert!(said.contains("marks/sheet"), "{said}");
    // A file in inches stays one.
    room.write("inch.cut", MARKER.replace("G71", "G70").as_bytes());
    room.expect("compile inch.cut --map marks.csv -t iso -o laid.cut", DONE);
    assert!(room.text("laid.cut").contains("G70"), "{}", room.text("laid.cut"));
}
