//! Pieces that are longer than a window of the conveyor: they are split, and no thread holds them wherever the conveyor brings
//! the cloth within its tolerance. Whether they come free is seen here by flooding the cloth, not by the verifier.

use std::fmt::Write as _;

use cutc::machine::Job;

use crate::support::nests::compiled;
use crate::support::room::{DONE, FAULTY, Room, USAGE};

/// A strip of 800 mm with a slit on either side and two holes, a bow of 800 mm and a square beside it.
const LONG: &str = "H1*G71*N1*X0Y0*M14*X900Y0*X900Y900*X0Y900*X0Y0*M15*\
    N2*X1500Y1500M43*X6500Y1500M43*X1400Y1000*M14*M19*X1400Y1060*M15*X6000Y2000*M14*M19*X6000Y1940*M15*\
    X0Y1000*M14*X8000Y1000*X8000Y2000*X0Y2000*X0Y1000*M15*\
    N3*X0Y2200*M14*X1000Y2235*X2000Y2260*X3000Y2275*X4000Y2280*X5000Y2275*X6000Y2260*X7000Y2235*X8000Y2200*\
    X8000Y2900*X0Y2900*X0Y2200*M15*M0*";
/// A strip of 800 mm with two cut-outs and a line of its own, and with a cut-out and a patch in it that are pieces.
const HOLED: &str = "H1*G71*N1*X1000Y200*M14*X1500Y200*X1500Y500*X1000Y500*X1000Y200*M15*\
    X3700Y200*M14*X4300Y200*X4300Y500*X3700Y500*X3700Y200*M15*X5000Y700*M14*X5600Y900*M15*\
    X0Y0*M14*X8000Y0*X8000Y1400*X0Y1400*X0Y0*M15*\
    N2*X6500Y300*M14*X7000Y300*X7000Y600*X6500Y600*X6500Y300*M15*\
    N3*X2500Y800*M14*X3000Y800*X3000Y1100*X2500Y1100*X2500Y800*M15*M0*";
/// Options with which both take three windows.
const BITES: &str = "--set bite.length_mm=400";
/// Size of a place of the cloth that is flooded, mm.
const CELL: f64 = 0.25;
/// Waste around the marker, mm.
const ROUND: f64 = 20.0;
/// The column of the way of the cloth.
const ADVANCE: usize = 8;

/// A cloth in small places, each cut or not.
struct Cloth {
    is_cut: Vec<bool>,
    width: usize,
}

impl Cloth {
    /// Cloth from -[`ROUND`] to so far beyond here, mm.
    fn new(to: [f64; 2]) -> Self {
        let [width, height] = to.map(|size| ((size + 2.0 * ROUND) / CELL) as usize);
        Self { is_cut: vec![false; width * height], width }
    }

    fn place(&self, [x, y]: [f64; 2]) -> usize {
        let [column, row] = [x, y].map(|at| ((at + ROUND) / CELL) as usize);
        row * self.width + column
    }

    fn cut(&mut self, from: [f64; 2], to: [f64; 2]) {
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / CELL * 2.5).ceil().max(1.0);
        for step in 0..=steps as usize {
            let share = step as f64 / steps;
            let place = self.place([0, 1].map(|k| from[k] + (to[k] - from[k]) * share));
            self.is_cut[place] = true;
        }
    }

    /// What hangs together with the corner of the cloth, over sides of places, not over their corners.
    fn flooded(&self) -> Vec<bool> {
        let mut is_flooded = vec![false; self.is_cut.len()];
        let mut left = vec![0];
        while let Some(place) = left.pop() {
            if is_flooded[place] || self.is_cut[place] {
                continue;
            }
            is_flooded[place] = true;
            let column = place % self.width;
            left.extend((column > 0).then(|| place - 1));
            left.extend((column + 1 < self.width).then_some(place + 1));
            left.extend(place.checked_sub(self.width));
            left.extend((place + self.width < self.is_cut.len()).then_some(place + self.width));
        }
        is_flooded
    }
}

/// The rows of a program, field by field.
fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().expect("a number")).collect()).collect()
}

/// Cloth that a program has cut, each window of which lies beside its place.
fn cut(rows: &[Vec<f64>], size: [f64; 2], beside: impl Fn(usize) -> [f64; 2]) -> Cloth {
    let mut ways: Vec<f64> = rows.iter().map(|row| row[ADVANCE]).collect();
    ways.dedup();
    let knife = Job::default().profile.knife;
    let mut cloth = Cloth::new(size);
    let mut last: Option<[f64; 2]> = None;
    for row in rows {
        let window = ways.iter().position(|way| *way == row[ADVANCE]).expect("it is one of them");
        let [x, y] = beside(window);
        let (sin, cos) = row[3].to_radians().sin_cos();
        let at = |reach: f64| [row[1] + row[ADVANCE] + x + reach * cos, row[2] + y + reach * sin];
        let tip = at(knife.radius());
        if row[4] == 1.0 {
            cloth.cut(last.unwrap_or_else(|| at(-knife.back())), tip);
        }
        last = (row[4] == 1.0).then_some(tip);
    }
    cloth
}

/// How many of some places of the cloth hang together with its corner.
fn held(rows: &[Vec<f64>], size: [f64; 2], places: &[[f64; 2]], beside: impl Fn(usize) -> [f64; 2]) -> usize {
    let cloth = cut(rows, size, beside);
    let flooded = cloth.flooded();
    places.iter().filter(|&&at| flooded[cloth.place(at)]).count()
}

#[test]
fn parts_that_are_split_come_free_wherever_the_conveyor_brings_the_cloth() {
    let mut job = Job::default();
    job.profile.bite.length_mm = Some(400.0);
    let (_, bytes) = compiled(LONG, "csv", &job).expect("it is split");
    let rows = rows(std::str::from_utf8(&bytes).expect("text"));
    let (size, parts) = ([800.0, 290.0], [[45.0, 45.0], [400.0, 150.0], [400.0, 260.0]]);
    let steps = [-0.5, 0.0, 0.5];
    for step in steps.iter().flat_map(|x| steps.map(|y| [*x, y])) {
        // All windows go the same way on, or each other one goes back.
        let goes_on = |window: usize| step.map(|by| by * window as f64);
        let goes_back = |window: usize| step.map(|by| if window % 2 == 1 { by } else { 0.0 });
        assert_eq!(held(&rows, size, &parts, goes_on), 0, "each advance off by {step:?}");
        if step[0] != 0.0 && step[1] != 0.0 {
            assert_eq!(held(&rows, size, &parts, goes_back), 0, "each other advance off by {step:?}");
        }
    }
    // The flood finds the threads of cuts that do not cross: beyond what the halves veer by.
    let far = |window: usize| [0.0, 2.5 * window as f64];
    assert!(held(&rows, size, &parts, far) > 0);
}

#[test]
fn every_target_cuts_split_pieces_and_is_judged_by_its_own_bytes() {
    let room = Room::with("long.cut", LONG);
    let advance = r#"gcode.advance = ["M68 E0 Q#", "M64 P1", "M66 P1 L3 Q60"]"#;
    room.write("machine.toml", format!("bite.length_mm = 400\n{advance}\n").as_bytes());
    for (target, extension) in
        [("csv", "csv"), ("npy", "npy"), ("counts", "counts"), ("hal", "hal.txt"), ("gcode", "ngc"), ("iso", "cut")]
    {
        let out = format!("out.{extension}");
        let said = room.says(&format!("compile long.cut -t {target} -o {out} -p machine.toml"), DONE);
        assert!(said.contains("  pieces     3\n") && said.contains("windows of a conveyor"), "{said}");
        assert!(!said.contains("ends of plunge cuts in parts"), "{said}");
        room.says(&format!("verify {out} --source long.cut -p machine.toml"), DONE);
    }
    // A sheet moves pieces before they are split.
    for sheet in
        ["--set sheet.mirror=ends", "--set sheet.flip=sides", "--set sheet.copies=2 --set order.policy=fastest"]
    {
        room.says(&format!("compile long.cut --force -o out.csv {BITES} {sheet}"), DONE);
        room.says(&format!("verify out.csv --source long.cut {BITES} {sheet}"), DONE);
    }
    for option in
        ["common.lines=off", "bite.overlap_mm=0", "bite.overlap_mm=20", "bite.match_mm=1.5", "knife.follow=chord"]
    {
        room.says(&format!("compile long.cut --force -o out.csv {BITES} --set {option}"), DONE);
    }
}

#[test]
fn cut_outs_of_a_part_that_is_split_are_whole_and_come_free_before_it() {
    let room = Room::with("holed.cut", HOLED);
    let said = room.says(&format!("compile holed.cut -o right.csv {BITES}"), DONE);
    assert!(said.contains("  pieces     3\n") && said.contains("3 windows of a conveyor"), "{said}");
    let (text, size) = (room.text("right.csv"), [800.0, 140.0]);
    let places = [[50.0, 100.0], [125.0, 35.0], [400.0, 35.0], [675.0, 45.0], [275.0, 95.0]];
    let rows = rows(&text);
    assert_eq!(held(&rows, size, &places, |window| [0.5 * window as f64, -0.5 * window as f64]), 0);
    // The knife is up over the first cut-out, or over the line.
    for (low, high) in [([99.0, 19.0], [151.0, 51.0]), ([499.0, 69.0], [561.0, 91.0])] {
        let mut damaged = rows.clone();
        for row in &mut damaged {
            let at = [row[1] + row[ADVANCE], row[2]];
            if (0..2).all(|axis| (low[axis]..high[axis]).contains(&at[axis])) {
                (row[4], row[7]) = (0.0, 0.0);
            }
        }
        room.write("wrong.csv", written(&text, &damaged).as_bytes());
        let said = room.says(&format!("verify wrong.csv --source holed.cut {BITES}"), FAULTY);
        assert!(said.contains("FAIL  verify/complete"), "{said}");
    }
}

#[test]
fn no_part_with_cut_outs_anywhere_is_refused_as_a_fault() {
    let mut random = fastrand::Rng::with_seed(49);
    let room = Room::new();
    let mut split = 0;
    for _ in 0..24 {
        let mut text = "H1*G71*N1*".to_owned();
        let mut at = random.u32(200..900);
        while at < 7500 {
            let (low, long) = (random.u32(150..600), random.u32(80..900));
            let [right, high] = [(at + long).min(7800), low + random.u32(80..600)];
            write!(text, "X{at}Y{low}*M14*X{right}Y{low}*X{right}Y{high}*X{at}Y{high}*X{at}Y{low}*M15*").expect("text");
            at = right + random.u32(100..1200);
        }
        text.push_str("X0Y0*M14*X8000Y0*X8000Y1400*X0Y1400*X0Y0*M15*M0*");
        room.write("random.cut", text.as_bytes());
        let ran = room.run(&format!("compile random.cut --force -o random.csv {BITES}"));
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        // Cut-outs side by side leave no room for a border.
        assert!(ran.status.success() || said.contains("error[marker/bite]"), "{text}\n{said}");
        split += usize::from(ran.status.success());
    }
    assert!(split >= 12, "{split} of 24 are split");
}

#[test]
fn a_choice_of_windows_parts_no_piece() {
    let room = Room::with("long.cut", LONG);
    let said = room.says(&format!("compile long.cut {BITES} --resume-from bite:3"), FAULTY);
    assert!(said.contains("error[marker/bite]: piece 2 is cut in the bites 1 to 3"), "{said}");
    assert!(said.contains("begin with bite 1"), "{said}");
    for choice in ["--bites 1", "--bites 2-3"] {
        room.says(&format!("compile long.cut {BITES} {choice}"), FAULTY);
    }
    for choice in ["--bites 1-3", "--pieces 2", "--skip 2", "--skip 2,3", "--resume-from bite:1"] {
        room.says(&format!("compile long.cut --force -o some.csv {BITES} {choice}"), DONE);
        room.says(&format!("verify some.csv --source long.cut {BITES} {choice}"), DONE);
    }
}

#[test]
fn no_cut_is_split_near_a_slit() {
    let room = Room::new();
    for at in (2100..3700).step_by(250) {
        let file = format!("H1*G71*N1*X{at}Y0*M14*M19*X{at}Y60*M15*X0Y0*M14*X6000Y0*X6000Y1000*X0Y1000*X0Y0*M15*M0*");
        room.write("one.cut", file.as_bytes());
        room.says(&format!("compile one.cut --force -o one.csv {BITES}"), DONE);
        let told = room.says(&format!("compile one.cut {BITES} --dump-after bite"), DONE);
        let border = told.split("section 0 to ").nth(1).and_then(|rest| rest.lines().next());
        let border: f64 = border.and_then(|border| border.parse().ok()).expect("a section");
        let slit = f64::from(at) / 10.0;
        assert!((border - slit).abs() > 30.0, "a border at {border}, a slit at {slit}");
    }
}

#[test]
fn a_slit_lies_in_the_window_of_its_section() {
    let room = Room::new();
    for (root, tip) in [(3640, 4240), (4200, 3600)] {
        let slit = format!("X{root}Y500*M14*M19*X{tip}Y500*M15*");
        let file = format!("H1*G71*N1*{slit}X0Y0*M14*X6000Y0*X6000Y1000*X0Y1000*X0Y0*M15*M0*");
        room.write("slit.cut", file.as_bytes());
        room.says(&format!("compile slit.cut --force -o slit.csv {BITES} --set table.x_mm=[-8,393]"), DONE);
    }
}

#[test]
fn a_piece_that_is_split_is_counted_once() {
    let room = Room::with("long.cut", LONG);
    room.write("again.cut", LONG.as_bytes());
    let said = room.says(&format!("check long.cut again.cut {BITES}"), DONE);
    assert!(said.lines().any(|line| line.split_whitespace().take(2).eq(["all", "6"])), "{said}");
    room.says(&format!("compile long.cut -o out/ -t json,svg {BITES}"), DONE);
    assert!(room.text("out/long.json").contains("\"pieces\": 3,"));
    let picture = room.text("out/long.svg");
    assert!(picture.contains("3 pieces, ") && picture.contains("split between bites: "), "{picture}");
    assert_eq!(picture.matches("<path class=\"border\" d=\"M").count(), picture.matches(" is split at X ").count() + 1);
}

/// Damages of the rows of three windows.
type Damage = fn(&mut Vec<Vec<f64>>);

#[test]
fn damage_to_split_cuts_is_found() {
    let room = Room::with("long.cut", LONG);
    room.says(&format!("compile long.cut {BITES} -o right.csv"), DONE);
    let text = room.text("right.csv");
    let damages: [(&str, &str, Damage); 5] = [
        ("the last advance a tenth longer than told", "verify/on-path", |rows| {
            let last = rows[rows.len() - 1][ADVANCE];
            rows.iter_mut().filter(|row| row[ADVANCE] == last).for_each(|row| row[1] -= 0.1);
        }),
        ("the second window askew", "verify/on-path", |rows| {
            let ways = ways(rows);
            rows.iter_mut().filter(|row| row[ADVANCE] == ways[1]).for_each(|row| row[2] += 0.1);
        }),
        ("two windows exchanged", "verify/events", |rows| {
            let ways = ways(rows);
            let other = |way: f64| {
                if way == ways[1] {
                    ways[2]
                } else if way == ways[2] {
                    ways[1]
                } else {
                    way
                }
            };
            for row in &mut *rows {
                row[ADVANCE] = other(row[ADVANCE]);
            }
        }),
        ("the ways aside left out", "verify/joint", |rows| {
            for stroke in rows.chunk_by_mut(|one, next| one[4] == next[4]) {
                let way: f64 =
                    stroke.windows(2).map(|ends| (ends[1][1] - ends[0][1]).hypot(ends[1][2] - ends[0][2])).sum();
                // The strip lies between 100 and 200 mm: a short stroke outside of that leads into the waste.
                let is_beside = |row: &Vec<f64>| (98.0..99.8).contains(&row[2]) || (200.2..202.0).contains(&row[2]);
                if stroke[0][4] == 1.0 && way < 14.0 && stroke.iter().any(is_beside) {
                    for row in stroke.iter_mut() {
                        (row[4], row[7]) = (0.0, 0.0);
                    }
                }
            }
        }),
        ("a part free before all in it is cut", "verify/order", |rows| {
            let ways = ways(rows);
            let (first, rest): (Vec<_>, Vec<_>) = rows.drain(..).partition(|row| row[ADVANCE] < ways[2]);
            rows.extend(rest.into_iter().chain(first));
            for (tick, row) in rows.iter_mut().enumerate() {
                row[0] = tick as f64 * 0.001;
            }
        }),
    ];
    for (name, rule, damage) in damages {
        let mut damaged = rows(&text);
        damage(&mut damaged);
        room.write("wrong.csv", written(&text, &damaged).as_bytes());
        let said = room.says(&format!("verify wrong.csv --source long.cut {BITES}"), FAULTY);
        assert!(said.contains(&format!("FAIL  {rule}")), "{name}: {said}");
    }
    // A conveyor that is worse than the one that the cuts were made for leaves threads.
    let said = room.says(&format!("verify right.csv --source long.cut {BITES} --set bite.match_mm=2"), FAULTY);
    assert!(said.contains("FAIL  verify/joint"), "{said}");
}

#[test]
fn a_cut_file_in_bites_has_the_cuts_of_each_window() {
    let room = Room::with("long.cut", LONG);
    // Alone, and beside a target that needs the motion.
    for targets in ["iso", "iso,csv"] {
        room.says(&format!("compile long.cut --force -t {targets} -o out/ {BITES}"), DONE);
        insta::assert_snapshot!("cut_file_in_bites", room.text("out/long.iso"));
    }
    // Read again, it cuts the same in the same windows; a split piece is open there, and comes in each of its windows.
    let info = room.says(&format!("info out/long.iso {BITES}"), DONE);
    assert!(info.contains("  pieces     7\n") && info.contains("3 windows of a conveyor"), "{info}");
    assert!(info.contains("9 (1 closed, 8 open)"), "{info}");
    for options in ["", BITES] {
        room.says(&format!("compile out/long.iso --force -o again.csv {options}"), DONE);
        room.says(&format!("verify again.csv --source out/long.iso {options}"), DONE);
    }
    room.write("holed.cut", HOLED.as_bytes());
    for options in ["--set sheet.copies=2", "--set sheet.scale_x=1.03", "--set bite.overlap_mm=0", "--pieces 2"] {
        for file in ["long.cut", "holed.cut"] {
            room.says(&format!("compile {file} --force -t iso -o some.iso {BITES} {options}"), DONE);
            room.says(&format!("verify some.iso --source {file} {BITES} {options}"), DONE);
        }
    }
}

#[test]
fn damage_to_a_cut_file_in_bites_is_found() {
    let room = Room::with("long.cut", LONG);
    room.says(&format!("compile long.cut -t iso -o right.iso {BITES}"), DONE);
    let text = room.text("right.iso");
    let windows: Vec<&str> = text.split("N2*\n").collect();
    let [head, first, second, third] = windows[..] else { panic!("three windows: {text}") };
    let swapped = [head, first, &third.replace("M0*\n", ""), &format!("{second}M0*\n")].join("N2*\n");
    let left_out = [head, first, third].join("N2*\n");
    let damages = [
        ("an advance a tenth longer", "verify/same-place", text.replacen("ZX3470*", "ZX3471*", 1)),
        ("an advance without its event", "verify/format", text.replacen("ZX3470*\nM69*\n", "ZX3470*\n", 1)),
        ("an advance without its length", "verify/same", text.replacen("ZX3470*\n", "", 1)),
        ("two windows exchanged", "verify/same", swapped),
        ("a window left out", "verify/complete", left_out),
        (
            "halves that end on the border",
            "verify/overlap",
            text.replacen("X3713Y2000*\nX3703Y2000*", "X3650Y2000*", 1),
        ),
        ("halves that do not reach each other", "verify/complete", {
            text.replacen("X3713Y2000*\nX3703Y2000*", "X3500Y2000*", 1)
        }),
        ("halves that stay on the line", "verify/joint", text.replace("Y2017.84*", "Y2000*")),
        ("halves that veer into the part", "verify/overcut-part", text.replace("Y2017.84*", "Y1982.16*")),
    ];
    for (name, rule, damaged) in damages {
        assert_ne!(damaged, text, "{name}");
        room.write("wrong.iso", damaged.as_bytes());
        let said = room.says(&format!("verify wrong.iso --source long.cut {BITES}"), FAULTY);
        assert!(said.contains(&format!("FAIL  {rule} ")), "{name}: {said}");
    }
    // The file is judged by the overlap and the conveyor of the profile.
    let other = "--set bite.overlap_mm=8";
    let said = room.says(&format!("verify right.iso --source long.cut {BITES} {other}"), FAULTY);
    assert!(said.contains("FAIL  verify/overlap "), "{said}");
    let said = room.says(&format!("verify right.iso --source long.cut {BITES} --set bite.match_mm=2"), FAULTY);
    assert!(said.contains("FAIL  verify/joint "), "{said}");
}

/// A program of other rows.
fn written(program: &str, rows: &[Vec<f64>]) -> String {
    let head = program.lines().next().expect("a header").to_owned();
    let lines = rows.iter().map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    std::iter::once(head).chain(lines).collect::<Vec<_>>().join("\n") + "\n"
}

/// The ways of the cloth of all windows, mm.
fn ways(rows: &[Vec<f64>]) -> Vec<f64> {
    let mut ways: Vec<f64> = rows.iter().map(|row| row[ADVANCE]).collect();
    ways.dedup();
    ways
}

#[test]
fn pieces_that_cannot_be_split_are_refused() {
    let room = Room::new();
    let square = |inside: &str| {
        format!(
            "H1*G71*N1*X0Y0*M14*X6000Y0*X6000Y1000*X0Y1000*X0Y0*M15*{inside}N2*X0Y1100*M14*X500Y1100*X500Y1600*X0Y1600*X0Y1100*M15*M0*"
        )
    };
    let cut_out = "X1000Y300*M14*X5200Y300*X5200Y600*X1000Y600*X1000Y300*M15*";
    for inside in ["X1000Y500*M14*X5000Y500*M15*", cut_out] {
        room.write("inside.cut", square(inside).as_bytes());
        let said = room.says(&format!("compile inside.cut {BITES}"), FAULTY);
        assert!(said.contains("error[marker/bite]: piece 1 takes 614.8 mm along X"), "{said}");
        assert!(said.contains("it cannot be split: that takes straight edges beside waste"), "{said}");
    }
    room.write("plain.cut", square("").as_bytes());
    room.says(&format!("compile plain.cut {BITES}"), DONE);
    room.says("compile plain.cut --set bite.veer_mm=-1", USAGE);
    // So large a way aside finds no waste.
    room.says(&format!("compile plain.cut --force {BITES} --set bite.veer_mm=9"), DONE);
}
