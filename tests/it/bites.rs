//! Windows of a conveyor: a marker that is longer than the table is cut bite by bite, and a program that moves the cloth on
//! otherwise than it tells is refused.

use cutc::diagnostic::Diagnostics;
use cutc::ir::Marker;
use cutc::ir::marker::{Notch, Piece};
use cutc::machine::Job;
use cutc::pipeline;
use cutc::source::Source;

use crate::support::nests::{Recipe, compiled};
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// Three squares of 300 mm in a row, the middle one with a hole and a slit.
const ROW: &str = "H1*G71*N1*X0Y0*M14*X3000Y0*X3000Y3000*X0Y3000*X0Y0*M15*\
    N2*X4500Y1500M43*X3500Y0*M19*X3500Y0*M14*X3500Y50*M15*X3100Y0*M14*X6100Y0*X6100Y3000*X3100Y3000*X3100Y0*M15*\
    N3*X6200Y0*M14*X9200Y0*X9200Y3000*X6200Y3000*X6200Y0*M15*M0*";
/// Options with which they take three windows.
const BITES: &str = "--set bite.length_mm=400";
/// A machine whose controller is told how far.
const MACHINE: &str = "bite.length_mm = 400\ngcode.advance = [\"M68 E0 Q#\", \"M64 P1\", \"M66 P1 L3 Q60\"]\n";
/// The column of the way of the cloth.
const ADVANCE: usize = 8;

/// Stretches along X that must lie in a window, a piece each, mm.
fn reaches(marker: &Marker, job: &Job) -> Vec<[f64; 2]> {
    let reach = job.profile.knife.reach();
    let of = |piece: &Piece| {
        let places = piece.contours.iter().flat_map(|contour| marker.points(contour)).map(|at| at.x);
        let strokes = piece.notches.iter().flat_map(Notch::strokes).flat_map(|s| [s.from.x, s.to.x]);
        let all = places.chain(strokes).chain(piece.drills.iter().map(|drill| drill.at.x));
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x - reach), b.max(x + reach)])
    };
    marker.pieces.iter().map(of).collect()
}

/// The fewest windows in which all pieces lie whole: places of windows that stab the stretch of places of each piece.
fn fewest(reaches: &[[f64; 2]], length: f64) -> usize {
    let mut stretches: Vec<[f64; 2]> = reaches.iter().map(|[from, to]| [to - length, *from]).collect();
    stretches.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let mut windows: Vec<f64> = Vec::new();
    for [least, most] in stretches {
        if windows.last().is_none_or(|&window| window < least) {
            windows.push(most);
        }
    }
    windows.len()
}

/// The rows of a program, field by field.
fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().expect("a number")).collect()).collect()
}

#[test]
fn nests_are_cut_in_the_fewest_windows_and_the_knife_stays_in_each() {
    for seed in [2, 5, 11, 13, 17, 25] {
        let recipe = Recipe::of(seed, 14, 6);
        let text = recipe.nest().text;
        let source = Source::new("nest.cut", text.as_bytes().to_vec()).expect("small");
        let input = pipeline::read(&source, None, &Job::default(), &mut Diagnostics::default()).expect("a nest");
        let reaches = reaches(&input.marker, &Job::default());
        let longest = reaches.iter().map(|[from, to]| to - from).fold(0.0, f64::max);
        for times in [1.05, 1.7] {
            let mut job = Job::default();
            let length = (longest * times).ceil();
            job.profile.bite.length_mm = Some(length);
            let (compiled, bytes) =
                compiled(&text, "csv", &job).unwrap_or_else(|why| panic!("{recipe:?}, windows of {length}: {why}"));
            let windows = compiled.report.bites.len().max(1);
            // Ways of the cloth are whole mm: so much of a window may be lost.
            let least = fewest(&reaches, length);
            assert!((least..=fewest(&reaches, length - 1.0)).contains(&windows), "{recipe:?}: {windows}, not {least}");
            let start = reaches.iter().map(|[from, _]| *from).fold(f64::INFINITY, f64::min);
            let rows = rows(std::str::from_utf8(&bytes).expect("text"));
            let knife = &job.profile.knife;
            for row in rows.iter().filter(|row| row[4] == 1.0) {
                for reach in [knife.radius(), -knife.back()] {
                    let place = row[1] + reach * row[3].to_radians().cos() - start;
                    assert!((-1e-6..=length + 1e-6).contains(&place), "{recipe:?}, windows of {length}: {row:?}");
                }
            }
            let mut ways: Vec<u32> = rows.iter().map(|row| row[ADVANCE] as u32).collect();
            ways.dedup();
            let told: Vec<u32> = compiled.report.bites.iter().map(|bite| bite.advance_mm).collect();
            assert_eq!(ways, if told.is_empty() { vec![0] } else { told }, "{recipe:?}");
        }
    }
}

#[test]
fn every_target_tells_how_far_the_cloth_is_moved_on_and_is_judged_by_it() {
    let room = Room::with("row.cut", ROW);
    room.write("machine.toml", MACHINE.as_bytes());
    for (target, extension) in
        [("csv", "csv"), ("npy", "npy"), ("counts", "counts"), ("hal", "hal.txt"), ("gcode", "ngc"), ("iso", "cut")]
    {
        let out = format!("out.{extension}");
        let said = room.says(&format!("compile row.cut -t {target} -o {out} -p machine.toml"), DONE);
        assert!(said.contains("bites      3 windows of a conveyor, 620 mm from the first to the last"), "{said}");
        let said = room.says(&format!("verify {out} --source row.cut -p machine.toml"), DONE);
        assert!(said.contains("\nPASS  `out"), "{target}: {said}");
    }
    let text = room.text("out.ngc");
    assert_eq!(text.lines().filter(|line| line.starts_with("M68")).collect::<Vec<_>>(), ["M68 E0 Q310"; 2]);
    // Places are those over the table: each square lies where the first does.
    let places = text.lines().filter_map(|line| line.split(" X").nth(1)?.split(' ').next()?.parse::<f64>().ok());
    assert!(places.fold(0.0, f64::max) < 320.0, "{text}");
    let listed = room.text("out.cut").matches("M69*").count();
    assert_eq!(listed, 2, "the controller of a cut file moves the cloth on by itself");
    let told = room.says(&format!("info row.cut {BITES} --time"), DONE);
    assert!(told.contains("  bite    at mm  pieces    cut m   time s\n     1        0       1    1.200"), "{told}");
    room.says(&format!("compile row.cut -t halrun,json,svg -o side/ {BITES}"), DONE);
    let hal = room.text("side/row.hal");
    assert!(hal.contains("cfg=fffbuuuu\n") && hal.contains("net advance-mm streamer.0.pin.7\n"), "{hal}");
    assert!(room.text("side/row.json").contains("\"advance_mm\": 620}"));
    let picture = room.text("side/row.svg");
    assert!(picture.contains("<title>piece 3, bite 3, ") && picture.contains(">bite 3, cloth moved 620 mm<"));
    assert!(!picture.contains("split between bites"));
}

/// Damages of the rows of three windows.
type Damage = fn(&mut Vec<Vec<f64>>);

#[test]
fn a_program_that_moves_the_cloth_on_otherwise_is_refused() {
    let room = Room::with("row.cut", ROW);
    room.says(&format!("compile row.cut {BITES} -o right.csv"), DONE);
    let text = room.text("right.csv");
    let head = text.lines().next().expect("a header").to_owned();
    let damages: [(&str, &str, Damage); 11] = [
        ("the last window a millimetre farther", "verify/events", |rows| {
            rows.iter_mut().filter(|row| row[ADVANCE] == 620.0).for_each(|row| row[ADVANCE] += 1.0);
        }),
        ("the second window a millimetre less far", "verify/complete", |rows| {
            rows.iter_mut().filter(|row| row[ADVANCE] == 310.0).for_each(|row| row[ADVANCE] -= 1.0);
        }),
        ("two windows exchanged", "verify/events", |rows| {
            let other = |way: f64| [0.0, 620.0, 310.0][(way / 310.0) as usize];
            for row in rows {
                row[ADVANCE] = other(row[ADVANCE]);
            }
        }),
        ("a way without its event", "verify/events", |rows| rows.iter_mut().for_each(|row| row[6] = 0.0)),
        ("a way amid a cut", "verify/events", |rows| {
            let at = rows.iter().rposition(|row| row[4] == 1.0).expect("a cut");
            rows[at][ADVANCE] += 1.0;
        }),
        ("a conveyor that runs back", "verify/events", |rows| {
            let last = rows.len() - 1;
            rows[last][ADVANCE] = 310.0;
        }),
        ("an event that moves nothing", "verify/events", |rows| {
            let last = rows.len() - 1;
            rows[last][6] = 2.0;
        }),
        ("all ways told as none", "verify/complete", |rows| rows.iter_mut().for_each(|row| row[ADVANCE] = 0.0)),
        ("all places on the cloth", "verify/table", |rows| {
            for row in rows {
                (row[1], row[ADVANCE]) = (row[1] + row[ADVANCE], 0.0);
            }
        }),
        ("an advance behind the last cut", "verify/events", |rows| {
            let last = rows.len() - 1;
            (rows[last][6], rows[last][ADVANCE]) = (2.0, 4e6);
        }),
        ("an advance with the knife down", "verify/events", |rows| {
            let at = rows.iter().position(|row| row[6] == 2.0).expect("an advance");
            rows[at][4] = 1.0;
        }),
    ];
    for (name, rule, damage) in damages {
        let mut damaged = rows(&text);
        damage(&mut damaged);
        let lines = damaged.iter().map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
        let lines: Vec<String> = std::iter::once(head.clone()).chain(lines).collect();
        room.write("wrong.csv", (lines.join("\n") + "\n").as_bytes());
        let said = room.says(&format!("verify wrong.csv --source row.cut {BITES}"), FAULTY);
        assert!(said.contains(&format!("FAIL  {rule}")), "{name}: {said}");
    }
    // A machine without a conveyor does not move the cloth, and one with a conveyor must be told.
    let said = room.says("verify right.csv --source row.cut", FAULTY);
    assert!(said.contains("FAIL  verify/events"), "{said}");
    room.says("compile row.cut -o plain.csv", DONE);
    let said = room.says(&format!("verify plain.csv --source row.cut {BITES}"), FAULTY);
    assert!(said.contains("FAIL  verify/events") && said.contains("FAIL  verify/table"), "{said}");
}

/// One number of a record of three windows, wherever a target has the way of the cloth.
#[test]
fn records_that_tell_another_way_are_refused() {
    let room = Room::with("row.cut", ROW);
    for (program, head, size) in [("some.npy", 0, 43), ("some.counts", 1024, 24)] {
        room.says(&format!("compile row.cut --force -o {program} {BITES}"), DONE);
        let bytes = room.read(program);
        let last = bytes.len() - size;
        assert_eq!((last - head) % size, if head > 0 { 0 } else { (last - head) % size });
        for at in [last, bytes.len() / 2 / size * size] {
            let way = (at + size - 4)..(at + size);
            // The middle of a file is amid a record of the array, whose head has another length.
            let record = bytes.len() - (bytes.len() - way.end).div_ceil(size) * size;
            let mut wrong = bytes.clone();
            let told = u32::from_le_bytes(wrong[record - 4..record].try_into().expect("four bytes"));
            assert!([0, 310, 620].contains(&told), "{program}: {told}");
            for other in [told + 1, u32::MAX] {
                wrong[record - 4..record].copy_from_slice(&other.to_le_bytes());
                room.write("wrong.bin", &wrong);
                let said = room.says(&format!("verify wrong.bin --source row.cut {BITES}"), FAULTY);
                assert!(said.contains("FAIL  verify/events"), "{program}: {said}");
            }
        }
    }
}

/// Stops and advances of a file come between the same pieces in a conveyor's windows as well.
#[test]
fn stops_and_advances_of_a_file_keep_their_say() {
    let room = Room::new();
    let square = |number: u32, x: u32| {
        let (a, b) = (x * 10, x * 10 + 1000);
        format!("X{a}Y0*M14*X{b}Y0*X{b}Y1000*X{a}Y1000*X{a}Y0*M15*").replace("N*", &format!("N{number}*"))
    };
    let file = |middle: &str, end: &str| {
        format!("H1*G71*N1*{}N2*{middle}{}N3*{}{end}M0*", square(1, 0), square(2, 360), square(3, 150))
    };
    for (middle, end, events, last) in [
        ("M01*", "", "1,2", 360.0),
        ("M01*M69*", "", "1,2", 150.0),
        ("M69*", "M69*", "2,2", 475.0),
        ("M69*M69*", "M69*M01*M69*", "2,2,1", 475.0),
    ] {
        room.write("file.cut", file(middle, end).as_bytes());
        let said = room.says("compile file.cut --force -o some.csv --set bite.length_mm=340", DONE);
        let is_idle = middle == "M69*M69*";
        assert_eq!(
            said.contains("warning[marker/idle-advance]: 2 advances of the file move nothing"),
            is_idle,
            "{said}"
        );
        room.says("verify some.csv --source file.cut --set bite.length_mm=340", DONE);
        let rows = rows(&room.text("some.csv"));
        let told: Vec<String> = rows.iter().filter(|row| row[6] > 0.0).map(|row| row[6].to_string()).collect();
        assert_eq!((told.join(",").as_str(), rows[rows.len() - 1][ADVANCE]), (events, last), "{middle} {end}");
    }
    // A piece that is left out needs no window, and an advance at the end moves all off the table still.
    room.says("compile file.cut --force -o some.csv --set bite.length_mm=340 --pieces 1", DONE);
    assert_eq!(rows(&room.text("some.csv")).last().expect("rows")[ADVANCE], 475.0);
    // A long piece with a line inside that is longer than a window is not split.
    let line = "X6500Y1000*M14*X12000Y1000*M15*M0*";
    room.write("long.cut", ROW.replace("X9200", "X12200").replace("M0*", line).as_bytes());
    let said = room.says(&format!("compile long.cut {BITES}"), FAULTY);
    assert!(said.contains("error[marker/bite]: piece 3 takes 614.9 mm"), "{said}");
    room.says(&format!("compile long.cut {BITES} --skip 3"), DONE);
}

#[test]
fn steps_of_a_controller_tell_how_far_or_are_refused() {
    let room = Room::with("row.cut", ROW);
    let said = room.says(&format!("compile row.cut -t gcode {BITES}"), FAULTY);
    assert!(said.contains("`gcode.advance` does not say how far, but the marker is cut in bites"), "{said}");
    room.write("machine.toml", MACHINE.as_bytes());
    room.says("compile row.cut -t gcode -o right.ngc -p machine.toml", DONE);
    let text = room.text("right.ngc");
    let verify = "verify wrong.ngc --source row.cut -p machine.toml";
    for (right, wrong) in
        [("Q310", "Q311"), ("Q310", "Q-310"), ("Q310", "Q309.5"), ("M64 P1\n", ""), ("Q310", "Q99999999999")]
    {
        room.write("wrong.ngc", text.replacen(right, wrong, 1).as_bytes());
        let said = room.says(verify, FAULTY);
        assert!(said.contains("FAIL"), "{right} {wrong}: {said}");
    }
    room.write("wrong.ngc", text.replace("M68 E0 Q310", "m68 E0 Q310.0 (on)").as_bytes());
    room.says(verify, DONE);
    for (keys, expected) in [
        (r#"gcode.advance = ["M64 P1", "M68 E0 Q#"]"#, "# behind its first step"),
        (r#"gcode.advance = ["M64 P#"]"#, "M64 P#, where # is no value of an output"),
        (r#"gcode.advance = ["M68 E# Q5"]"#, "where # is no value of an output"),
        (
            "gcode.advance = [\"M68 E0 Q#\"]\ngcode.knife_down = [\"M68 E0 Q5\"]\ngcode.knife_up = [\"M68 E0 Q0\"]",
            "`gcode.knife_down` sets the output by which `gcode.advance` tells the way of the cloth",
        ),
    ] {
        room.write("wrong.toml", keys.as_bytes());
        let said = room.says("compile row.cut -t gcode -p wrong.toml", FAULTY);
        assert!(said.contains(expected), "{said}");
    }
    // A file that moves the cloth on, and does not say how far.
    room.write("file.cut", ROW.replace("N2*", "N2*M69*").as_bytes());
    room.write("still.toml", MACHINE.replace("400", "\"off\"").as_bytes());
    let said = room.says("compile file.cut -t gcode -p still.toml", FAULTY);
    assert!(said.contains("says how far, and the file does not"), "{said}");
    room.says("compile file.cut -t gcode -p machine.toml", DONE);
}

/// The ways of the cloth at the start and at the end of a program.
fn ways(room: &Room) -> [f64; 2] {
    let rows = rows(&room.text("some.csv"));
    [rows[0][ADVANCE], rows[rows.len() - 1][ADVANCE]]
}

#[test]
fn pieces_that_are_chosen_are_cut_on_cloth_that_lies_as_at_the_start() {
    let room = Room::with("row.cut", ROW);
    for (choice, expected) in [("--pieces 3", [620.0; 2]), ("--skip 1", [310.0, 620.0]), ("--skip 2,3", [0.0; 2])] {
        room.says(&format!("compile row.cut --force -o some.csv {BITES} {choice}"), DONE);
        room.says(&format!("verify some.csv --source row.cut {BITES} {choice}"), DONE);
        assert_eq!(ways(&room), expected, "{choice}");
        // At the start the first row tells the advance.
        assert_eq!(rows(&room.text("some.csv"))[0][6], if expected[0] > 0.0 { 2.0 } else { 0.0 }, "{choice}");
    }
}

#[test]
fn a_run_goes_on_with_the_cloth_where_it_stopped() {
    let room = Room::with("row.cut", ROW);
    room.write("machine.toml", MACHINE.as_bytes());
    for (start, expected) in
        [("bite:1", [0.0, 620.0]), ("2", [310.0, 620.0]), ("bite:2", [310.0, 620.0]), ("bite:3", [620.0; 2])]
    {
        let options = format!("-p machine.toml --resume-from {start}");
        for program in ["some.csv", "some.ngc"] {
            room.says(&format!("compile row.cut --force -o {program} {options}"), DONE);
            room.says(&format!("verify {program} --source row.cut {options}"), DONE);
        }
        assert_eq!(ways(&room), expected, "{start}");
        let advances = rows(&room.text("some.csv")).iter().filter(|row| row[6] == 2.0).count();
        assert_eq!(advances, ((expected[1] - expected[0]) / 310.0) as usize, "{start}: it stands where it begins");
    }
    for (bites, expected) in [("1", [0.0; 2]), ("1-2", [0.0, 310.0]), ("2-3", [310.0, 620.0]), ("1,3", [0.0, 620.0])] {
        let options = format!("-p machine.toml --bites {bites}");
        for program in ["some.csv", "some.ngc"] {
            room.says(&format!("compile row.cut --force -o {program} {options}"), DONE);
            room.says(&format!("verify {program} --source row.cut {options}"), DONE);
        }
        assert_eq!(ways(&room), expected, "{bites}");
    }
    room.says("verify some.csv --source row.cut -p machine.toml", FAULTY);
    let said = room.says("compile row.cut -p machine.toml --bites 3-4", FAULTY);
    assert!(said.contains("--bites: there is no bite 4") && said.contains("in 3 windows"), "{said}");
    room.says("compile row.cut -p machine.toml --bites 3 --resume-from bite:2", USAGE);
    // The cloth stands elsewhere than the program begins.
    room.says("verify some.ngc --source row.cut -p machine.toml --resume-from bite:2", FAULTY);
    let said = room.says(&format!("compile row.cut {BITES} --resume-from bite:4"), FAULTY);
    assert!(said.contains("there is no bite 4") && said.contains("the marker is cut in 3 windows"), "{said}");
    let said = room.says("compile row.cut --resume-from bite:1 -o whole.csv", DONE);
    assert!(!said.contains("bites  "), "{said}");
    let said = room.says("compile row.cut --resume-from bite:2", FAULTY);
    assert!(said.contains("the cloth lies still: bite.length_mm"), "{said}");
    for mode in ["--frame", "--dry-run"] {
        room.says(&format!("compile row.cut --force -o some.csv {BITES} {mode}"), DONE);
        let farthest = rows(&room.text("some.csv")).iter().map(|row| row[1]).fold(0.0, f64::max);
        assert!(farthest < 320.0, "{mode}: {farthest}");
    }
}

#[test]
fn a_table_and_a_conveyor_agree_and_other_machines_have_none() {
    let room = Room::with("row.cut", ROW);
    let corner = r#"--set table.x_mm=[0,400] --set sheet.origin="corner""#;
    room.says(&format!("compile row.cut {BITES} {corner}"), DONE);
    room.says(&format!("verify row.csv --source row.cut {BITES} {corner}"), DONE);
    let said = room.says("compile row.cut --set bite.length_mm=500 --set table.x_mm=[0,400]", USAGE);
    assert!(said.contains("`bite.length_mm` is 500 mm, more than `table.x_mm` has, 400 mm"), "{said}");
    // A marker that begins before the table is not too long for a conveyor.
    let said = room.says(&format!("compile row.cut {BITES} --set table.x_mm=[100,500]"), FAULTY);
    assert!(said.contains("error[marker/off-table]") && said.contains("sheet.origin = [107.4, 0]"), "{said}");
    assert!(!said.contains("does not fit"), "{said}");
    let said = room.says(&format!("compile row.cut {BITES} --set tool.kind=spray"), USAGE);
    assert!(said.contains("`tool.kind` is \"spray\""), "{said}");
    room.write("marks.csv", b"x_mm,y_mm,found_x_mm,found_y_mm\n0,0,0,0\n900,0,900,0\n900,300,900,300\n0,300,0,300\n");
    let said = room.says(&format!("compile row.cut {BITES} --map marks.csv"), FAULTY);
    assert!(said.contains("error[marks/sheet]") && said.contains("moves it away from there"), "{said}");
    let said = room.says(&format!("flow row.cut -o plan {BITES}"), USAGE);
    assert!(said.contains("leave `bite.length_mm` out"), "{said}");
}
