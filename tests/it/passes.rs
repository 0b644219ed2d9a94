//! Every pass, alone: from the text of a form to the text of a form, and laws over seeded cases.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use cutc::diagnostic::Diagnostics;
use cutc::geom::Point;
use cutc::ir::list::{Joint, Segment};
use cutc::ir::marker::{Contour, Marker, Piece};
use cutc::ir::{check, text};
use cutc::machine::{Centre, Job};
use cutc::pass::marker::{MARKER_PASSES, MarkerPass};
use cutc::pass::toolpath::{Scene, TOOLPATH_PASSES};
use cutc::source::{Source, Span};
use cutc::track::centre;
use cutc::units::number::fixed;

fn marker_pass(name: &str) -> Option<&'static MarkerPass> {
    MARKER_PASSES.iter().find(|pass| pass.name == name)
}

fn run(name: &str, marker: &mut Marker) -> Diagnostics {
    let mut found = Diagnostics::default();
    (marker_pass(name).expect("a pass of that name").run)(marker, &Job::default(), &mut found);
    found
}

/// The job of a text: its lines that start with `;!` are keys of the profile, those with `;@` rows of a centre line.
fn job(input: &str) -> Job {
    let keys: Vec<&str> = input.lines().filter_map(|line| line.strip_prefix(";!")).collect();
    let profile = toml::from_str(&keys.join("\n")).unwrap_or_else(|error| panic!("{error}"));
    let rows: Vec<&str> = input.lines().filter_map(|line| line.strip_prefix(";@")).collect();
    let text = format!("conv_mm,centre_mm\n{}\n", rows.join("\n"));
    let source = Source::new("centre.csv", text.into_bytes()).expect("small");
    let mut found = Diagnostics::default();
    let line = (!rows.is_empty()).then(|| centre::read(&source, &mut found).expect("a centre line"));
    Job {
        profile,
        centre: line.map(|line| Arc::new(Centre { line, source: Arc::new(source), rulers: None })),
        ..Job::default()
    }
}

/// The text that a pass makes of a text, then what it says and what `ir::check` finds.
fn passed(name: &str, input: &str) -> String {
    let (job, mut found) = (job(input), Diagnostics::default());
    let (mut output, faults) = if let Some(pass) = marker_pass(name) {
        let mut marker = text::read_marker(input).unwrap_or_else(|error| panic!("{error}"));
        (pass.run)(&mut marker, &job, &mut found);
        (text::print_marker(&marker), check::marker(&marker))
    } else {
        let pass = TOOLPATH_PASSES.iter().find(|pass| pass.name == name);
        let pass = pass.unwrap_or_else(|| panic!("fixtures/pass/{name} belongs to no pass"));
        // A marker before the toolpath is the cloth around it.
        let (cloth, input) = input.find("\ntoolpath").map_or(("", input), |at| input.split_at(at));
        let cloth = if cloth.contains("\nmarker") { text::read_marker(cloth) } else { Ok(Marker::default()) };
        let cloth = cloth.unwrap_or_else(|error| panic!("{error}"));
        let mut toolpath = text::read_toolpath(input).unwrap_or_else(|error| panic!("{error}"));
        (pass.run)(&mut toolpath, &Scene::new(&cloth, &job), &mut found);
        (text::print_toolpath(&toolpath), check::toolpath(&toolpath))
    };
    for diagnostic in &found {
        let block = diagnostic.span.map_or(0, |span| span.block);
        let _ = writeln!(output, "; {} in block {block}: {}", diagnostic.code.name, diagnostic.message);
    }
    for fault in faults {
        let _ = writeln!(output, "; unsound: {fault}");
    }
    output
}

/// The text with at most six decimals a number: the last bits of a sine are not the same on every machine.
fn rounded(text: &str) -> String {
    let round = |word: &str| match (word.split_once('.'), word.parse::<f64>()) {
        (Some((_, decimals)), Ok(value)) if decimals.len() > 6 => fixed(value, 6),
        _ => word.to_owned(),
    };
    let line = |line: &str| line.split(' ').map(round).collect::<Vec<_>>().join(" ");
    text.lines().map(|text| line(text) + "\n").collect()
}

#[test]
fn a_pass_makes_of_a_text_what_was_reviewed() {
    insta::glob!("../../fixtures/pass", "*/*.path", |path| {
        let folder = path.parent().and_then(Path::file_name).expect("the folder of a pass");
        let input = std::fs::read_to_string(path).expect("a readable fixture");
        let title = input.lines().next().unwrap_or_default().to_owned();
        let output = rounded(&passed(&folder.to_string_lossy(), &input));
        insta::with_settings!({ description => title, omit_expression => true }, {
            insta::assert_snapshot!(output);
        });
    });
}

#[test]
fn every_pass_has_fixtures_of_its_own() {
    let names = MARKER_PASSES.iter().map(|pass| pass.name).chain(TOOLPATH_PASSES.iter().map(|pass| pass.name));
    for name in names {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/pass").join(name);
        let texts = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let count = texts.filter(|entry| entry.path().extension().is_some_and(|e| e == "path")).count();
        assert!(count > 0, "the pass `{name}` needs a text in fixtures/pass/{name}/*.path");
    }
}

/// Seeded numbers (`splitmix64`, Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % n
    }

    /// A point of a coarse grid, so that chains often meet.
    fn point(&mut self) -> Point {
        Point::new(self.below(5) as f64 * 0.1, self.below(4) as f64 * 0.1 - 0.1)
    }

    fn flag(&mut self) -> bool {
        self.below(4) == 0
    }
}

/// A marker as a reader leaves it: chains of any kind, equal points among them.
fn raw_marker(random: &mut Random) -> Marker {
    let mut marker = Marker { unit: 0.1, ..Marker::default() };
    let mut block = 0;
    for number in 1..=1 + random.below(3) as u32 {
        let mut piece = Piece { number, ..Piece::default() };
        for _ in 0..random.below(12) {
            let mut from = random.point();
            let mut chain = Vec::new();
            for _ in 0..=random.below(4) {
                let to = if random.flag() { from } else { random.point() };
                let joint = Joint { lift: random.flag(), full_advance: random.flag(), no_overcut: random.flag() };
                block += 1;
                chain.push(Segment {
                    from,
                    to,
                    span: Span { start: 5 * block, end: 5 * block + 4, block },
                    joint,
                    percent: 100,
                });
                from = to;
            }
            let range = marker.list.append(chain).expect("a segment at least");
            piece.contours.push(Contour { range, closed: false });
        }
        marker.pieces.push(piece);
    }
    marker
}

/// The ends and the source of every segment that has a length, piece by piece, in an order of its own.
fn cuts(marker: &Marker) -> Vec<(usize, Span, [u64; 4])> {
    let segments = marker
        .contours()
        .flat_map(|(piece, contour)| marker.list.walk(contour.range).map(move |(_, segment)| (piece, segment)));
    let mut cuts: Vec<_> = segments
        .filter(|(_, s)| s.from != s.to)
        .map(|(piece, s)| (piece, s.span, [s.from.x, s.from.y, s.to.x, s.to.y].map(f64::to_bits)))
        .collect();
    cuts.sort_unstable();
    cuts
}

#[test]
fn welding_loses_no_segment_and_no_length() {
    for seed in 0..2000 {
        let mut marker = raw_marker(&mut Random(seed));
        let (before, length) = (cuts(&marker), marker.drawn_length());
        run("weld", &mut marker);
        assert_eq!(cuts(&marker), before, "seed {seed}");
        assert!((marker.drawn_length() - length).abs() < 1e-9, "seed {seed}");
        assert_eq!(check::marker(&marker), Vec::<String>::new(), "seed {seed}");
    }
}

#[test]
fn welding_leaves_no_chain_that_a_later_one_continues() {
    for seed in 0..2000 {
        let mut marker = raw_marker(&mut Random(seed));
        run("weld", &mut marker);
        for piece in &marker.pieces {
            let open = || piece.contours.iter().enumerate().filter(|(_, c)| !c.closed);
            for (i, contour) in open() {
                let points = marker.points(contour);
                let continued = open().any(|(k, later)| k > i && marker.points(later)[0] == points[points.len() - 1]);
                assert!(!continued, "seed {seed}");
            }
        }
    }
}

#[test]
fn welding_twice_is_welding_once() {
    for seed in 0..2000 {
        let mut marker = raw_marker(&mut Random(seed));
        run("weld", &mut marker);
        let once = text::print_marker(&marker);
        let found = run("weld", &mut marker);
        assert_eq!(text::print_marker(&marker), once, "seed {seed}");
        assert_eq!(found.iter().count(), 0, "seed {seed}");
    }
}

#[test]
fn a_welded_marker_is_the_same_from_its_text() {
    for seed in 0..500 {
        let mut direct = raw_marker(&mut Random(seed));
        let mut read = text::read_marker(&text::print_marker(&direct)).expect("printed text");
        run("weld", &mut direct);
        run("weld", &mut read);
        assert_eq!(text::print_marker(&read), text::print_marker(&direct), "seed {seed}");
    }
}

#[test]
fn a_contour_is_known_again_from_any_start_and_either_way() {
    for seed in 0..300 {
        let mut random = Random(seed);
        let mut marker = Marker { unit: 0.1, ..Marker::default() };
        let n = 3 + random.below(20);
        let ring: Vec<Point> = (0..n).map(|i| Point::new(i as f64, (i * i) as f64 * 0.1)).collect();
        let mut again = ring.clone();
        again.rotate_left(random.below(n) as usize);
        if random.flag() {
            again.reverse();
        }
        // One vertex elsewhere makes another contour; within the band it would be the same edge.
        let mut other = again.clone();
        other[random.below(n) as usize].y -= 1.0;
        for ring in [&ring, &again, &other] {
            let next = ring.iter().cycle().skip(1);
            let chain = ring.iter().zip(next).map(|(&from, &to)| Segment {
                from,
                to,
                span: Span::default(),
                joint: Joint::default(),
                percent: 100,
            });
            let range = marker.list.append(chain).expect("three segments at least");
            marker.pieces.push(Piece { contours: vec![Contour { range, closed: true }], ..Piece::default() });
        }
        let found = run("inspect", &mut marker);
        let codes: Vec<_> = found.iter().map(|d| d.code.name).collect();
        assert_eq!(codes, ["marker/contour-twice"], "seed {seed}");
    }
}

/// Times a million segments; the bound is that of a release build with room to spare on a slow machine.
#[test]
fn ten_thousand_chains_weld_into_a_thousand_rings() {
    let mut marker = Marker { unit: 0.1, ..Marker::default() };
    for number in 0..1000_u32 {
        let mut piece = Piece { number, ..Piece::default() };
        let ring: Vec<Point> = (0..1000)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::TAU / 1000.0;
                Point::new(f64::from(number) * 300.0 + 100.0 * angle.cos(), 100.0 * angle.sin())
            })
            .collect();
        for k in 0..10 {
            let chain = (100 * k..100 * (k + 1)).map(|i| Segment {
                from: ring[i],
                to: ring[(i + 1) % 1000],
                span: Span::default(),
                joint: Joint::default(),
                percent: 100,
            });
            let range = marker.list.append(chain).expect("a hundred segments");
            piece.contours.push(Contour { range, closed: false });
        }
        marker.pieces.push(piece);
    }
    let found = [run("weld", &mut marker), run("inspect", &mut marker)];
    assert_eq!(marker.contours().filter(|(_, contour)| contour.closed).count(), 1000);
    assert_eq!(found.map(|found| found.iter().count()), [0, 0]);
}
