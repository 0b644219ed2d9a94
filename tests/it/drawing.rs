//! Plain DXF drawings: their layers, and the second reading that proves that nothing of them is lost or bent.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::geom::{Point, ring};
use cutc::ir::drawing::Aside;
use cutc::ir::list::SegmentList;
use cutc::ir::marker::Notch;
use cutc::ir::{Finding, Marker};
use cutc::machine::Job;
use cutc::machine::layers::LayerUses;
use cutc::machine::plot::{Inner, Lines};
use cutc::pipeline;
use cutc::source::Source;
use cutc::verify::{Census, DrawingCuts, drawing_audit, source_audit};
use fastrand::Rng;

use crate::garment::{self, Dialect, Order};
use crate::support::fixtures::{files, source};

/// Drawings that are made by seeds.
const DRAWINGS: u64 = 60;

fn named(text: &str) -> Source {
    Source::new("a.dxf", text.as_bytes().to_vec()).expect("small")
}

fn as_read(source: &Source, job: &Job) -> (Marker, Diagnostics) {
    let mut found = Diagnostics::default();
    let marker = pipeline::marker_of(by_name("dxf").expect("a dialect"), source, job, &mut found);
    (marker, found)
}

fn codes(found: &Diagnostics) -> Vec<&'static str> {
    found.iter().map(|finding| finding.code.name).collect()
}

/// The rules that a marker breaks when the drawing is read a second time.
fn broken(source: &Source, marker: &Marker, job: &Job) -> Vec<Finding> {
    let read = source_audit("dxf", source.bytes(), &Census::of(marker), &job.profile).expect("drawings have a scan");
    let lines = drawing_audit("dxf", source.bytes(), &DrawingCuts::of(marker), job);
    read.into_iter().chain(lines).filter(|finding| !finding.holds()).collect()
}

/// A file with these entities and blocks.
fn file(entities: &str, blocks: &str) -> String {
    let section = |name: &str, body: &str| format!("0\nSECTION\n2\n{name}\n{body}0\nENDSEC\n");
    let header = section("HEADER", "9\n$INSUNITS\n70\n4\n");
    format!("{header}{}{}0\nEOF\n", section("BLOCKS", blocks), section("ENTITIES", entities))
}

/// An entity: its kind, and codes with their numbers.
fn entity(kind: &str, layer: &str, groups: &[(i32, f64)]) -> String {
    let groups = groups.iter().fold(String::new(), |mut text, (code, value)| {
        let _ = if (60..=79).contains(code) {
            writeln!(text, "{code}\n{value:.0}")
        } else {
            writeln!(text, "{code}\n{value}")
        };
        text
    });
    format!("0\n{kind}\n8\n{layer}\n{groups}")
}

fn rectangle(layer: &str, [x, y, width, height]: [f64; 4]) -> String {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
    let groups: Vec<(i32, f64)> = corners.iter().flat_map(|&(x, y)| [(10, x), (20, y)]).collect();
    entity("LWPOLYLINE", layer, &[vec![(90, 4.0), (70, 1.0)], groups].concat())
}

fn area(marker: &Marker) -> f64 {
    marker.contours().map(|(_, contour)| ring::area(&marker.points(contour)).abs()).sum()
}

/// Shapes about the origin, each with its area.
fn shape(rng: &mut Rng) -> (String, f64) {
    let size = 40.0 + 100.0 * rng.f64();
    match rng.u8(0..4) {
        0 => (entity("CIRCLE", "0", &[(10, 3.0), (20, -2.0), (40, size)]), PI * size * size),
        1 => {
            let (ratio, turn) = (0.4 + 0.6 * rng.f64(), TAU * rng.f64());
            let major = [(11, size * turn.cos()), (21, size * turn.sin())];
            let groups = [vec![(10, 0.0), (20, 0.0)], major.to_vec(), vec![(40, ratio), (41, 0.0), (42, TAU)]].concat();
            (entity("ELLIPSE", "0", &groups), PI * size * size * ratio)
        }
        2 => {
            // Both ends are round: bulges of a half turn.
            let places = [(10, 0.0), (20, 0.0), (10, 2.0 * size), (20, 0.0), (42, 1.0)];
            let back = [(10, 2.0 * size), (20, size), (10, 0.0), (20, size), (42, 1.0)];
            let groups = [vec![(90, 4.0), (70, 1.0)], places.to_vec(), back.to_vec()].concat();
            (entity("LWPOLYLINE", "0", &groups), 2.0 * size * size + PI * size * size / 4.0)
        }
        _ => {
            // A circle as a rational spline of degree two.
            let corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
            let knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4].map(|knot| (40, f64::from(knot)));
            let weights: Vec<(i32, f64)> =
                (0..9).map(|k| (41, if k % 2 == 0 { 1.0 } else { std::f64::consts::FRAC_1_SQRT_2 })).collect();
            let place = |(x, y): (i32, i32)| [(10, size * f64::from(x)), (20, size * f64::from(y))];
            let places: Vec<(i32, f64)> = corners.iter().flat_map(|&corner| place(corner)).collect();
            let groups = [vec![(70, 12.0), (71, 2.0)], knots.to_vec(), weights, places].concat();
            (entity("SPLINE", "0", &groups), PI * size * size)
        }
    }
}

/// An insertion of a block at a place, with its scales and its turn, degrees.
fn insert(name: &str, at: [f64; 2], scale: [f64; 2], turn: f64) -> String {
    let groups = [(10, at[0]), (20, at[1]), (41, scale[0]), (42, scale[1]), (50, turn)];
    entity(&format!("INSERT\n2\n{name}"), "0", &groups)
}

#[test]
fn a_second_reading_finds_what_the_reader_finds_in_every_drawing() {
    let choices = [
        Lines::default(),
        Lines { inner: Some(Inner::All), ..Lines::default() },
        Lines { all: true, ..Lines::default() },
    ];
    for path in files("dxf") {
        let source = source(&path, std::fs::read(&path).expect("readable"));
        for lines in &choices {
            let job = Job { lines: lines.clone(), ..Job::default() };
            let (marker, found) = as_read(&source, &job);
            assert!(!found.has_errors(), "{}", path.display());
            let broken = broken(&source, &marker, &job);
            assert!(broken.is_empty(), "{}, {lines:?}: {broken:#?}", path.display());
        }
    }
}

#[test]
fn curves_in_blocks_keep_their_areas_however_they_are_put() {
    for seed in 0..DRAWINGS {
        let mut rng = Rng::with_seed(seed);
        let (mut entities, mut blocks, mut expected, mut around) = (String::new(), String::new(), 0.0, 0.0);
        for k in 0..rng.u32(1..5) {
            let (shape, area) = shape(&mut rng);
            let [inner, outer] = [format!("S{k}"), format!("O{k}")];
            let scale = [0.5 + rng.f64(), 0.5 + rng.f64()].map(|by| if rng.bool() { by } else { -by });
            let within = insert(&inner, [10.0 * rng.f64(), 5.0], scale, 360.0 * rng.f64());
            let _ = write!(blocks, "0\nBLOCK\n2\n{inner}\n10\n0\n20\n0\n{shape}0\nENDBLK\n");
            let _ = write!(blocks, "0\nBLOCK\n2\n{outer}\n10\n1\n20\n2\n{within}0\nENDBLK\n");
            let size = 0.7 + 0.6 * rng.f64();
            entities += &insert(&outer, [1500.0 * f64::from(k), 0.0], [size, size], 360.0 * rng.f64());
            let all = area * scale[0].abs() * scale[1].abs() * size * size;
            expected += all;
            around += 6.0 * TAU * all.sqrt();
        }
        let source = named(&file(&entities, &blocks));
        let job = Job::default();
        let (marker, found) = as_read(&source, &job);
        assert!(codes(&found).is_empty(), "{seed}: {:?}", codes(&found));
        // Chords lie inside, by a quarter of the tolerance at the most.
        let lack = expected - area(&marker);
        assert!((-1e-3..0.0125 * around).contains(&lack), "{seed}: {lack} of {expected}");
        let broken = broken(&source, &marker, &job);
        assert!(broken.is_empty(), "{seed}: {broken:#?}");
    }
}

/// A marker whose first contour has other places.
fn with_contour(marker: &Marker, change: impl Fn(&[Point]) -> Vec<Point>) -> Marker {
    let mut damaged = marker.clone();
    let mut list = SegmentList::default();
    for piece in &mut damaged.pieces {
        for contour in &mut piece.contours {
            let points = marker.list.points(contour.range).to_vec();
            let spans: Vec<_> = marker.list.walk(contour.range).map(|(_, segment)| segment.span).collect();
            let changed = change(&points);
            let spans: Vec<_> = (0..changed.len()).map(|k| spans[k.saturating_sub(1).min(spans.len() - 1)]).collect();
            contour.range = list.append_line(&changed, &spans).expect("a line");
        }
    }
    damaged.list = list;
    damaged
}

#[test]
fn a_marker_that_is_damaged_is_refused() {
    let bulged = [(90, 4.0), (70, 1.0), (10, 0.0), (20, 0.0), (42, 0.3), (10, 300.0), (20, 0.0)];
    let rest = [(10, 300.0), (20, 180.0), (10, 0.0), (20, 200.0)];
    let source = named(&file(&entity("LWPOLYLINE", "0", &[bulged.to_vec(), rest.to_vec()].concat()), ""));
    let job = Job::default();
    let (marker, _) = as_read(&source, &job);
    assert!(broken(&source, &marker, &job).is_empty());
    let same = with_contour(&marker, <[Point]>::to_vec);
    assert!(broken(&source, &same, &job).is_empty(), "a marker that is only made anew is sound");
    let chord = |points: &[Point]| {
        let is_corner = |at: &&Point| [(0.0, 0.0), (300.0, 0.0), (300.0, 180.0), (0.0, 200.0)].contains(&(at.x, at.y));
        points.iter().filter(is_corner).copied().collect()
    };
    let rules = |marker: &Marker| broken(&source, marker, &job).iter().map(|found| found.rule.name).collect::<Vec<_>>();
    assert!(rules(&with_contour(&marker, chord)).contains(&"source/length"), "a curve as its chord");
    let mirrored = |points: &[Point]| points.iter().map(|at| Point::new(300.0 - at.x, at.y)).collect();
    assert!(rules(&with_contour(&marker, mirrored)).contains(&"source/moments"), "mirrored in its box");
    let moved = |points: &[Point]| points.iter().map(|at| Point::new(at.x + 0.5, at.y)).collect();
    assert!(rules(&with_contour(&marker, moved)).contains(&"source/bounds"), "half a millimetre aside");
    let mut lost = marker.clone();
    lost.pieces.clear();
    assert!(rules(&lost).contains(&"source/points"), "a contour that is lost");
    let mut kept = marker.clone();
    kept.drawing.as_mut().expect("an account").aside = Aside::default();
    assert!(rules(&kept).is_empty(), "nothing is aside in this drawing");
}

#[test]
fn layers_are_cut_as_somebody_says() {
    let entities = rectangle("CUT", [0.0, 0.0, 300.0, 200.0])
        + &rectangle("CUT", [100.0, 60.0, 80.0, 40.0])
        + &rectangle("other", [400.0, 0.0, 100.0, 100.0])
        + &rectangle("FOLD", [600.0, 0.0, 100.0, 100.0]);
    let source = named(&file(&entities, ""));
    let cut = |text: Option<&str>| {
        let layers = text.map(|text| LayerUses::parse(text).expect("layers"));
        let job = Job { lines: Lines { layers, ..Lines::default() }, ..Job::default() };
        let (marker, found) = as_read(&source, &job);
        assert!(found.has_errors() || broken(&source, &marker, &job).is_empty(), "{text:?}");
        (marker.contours().count(), codes(&found))
    };
    // By its name CUT is the knife, and cuts what lies inside, too.
    assert_eq!(cut(None), (2, vec!["drawing/layers"]));
    assert_eq!(cut(Some("other")).0, 1);
    assert_eq!(cut(Some("cut=ignore,OTHER,fold")).0, 2);
    assert_eq!(cut(Some("*")).0, 4);
    assert_eq!(cut(Some("*=ignore")), (0, vec!["drawing/nothing-to-cut"]));
    assert_eq!(cut(Some("CUTS")), (0, vec!["drawing/no-layer"]));
    let mut job = Job::default();
    job.profile.drawing.layers.insert("o*".to_owned(), cutc::machine::plot::PenUse::Knife);
    assert_eq!(as_read(&source, &job).0.contours().count(), 1);
}

#[test]
fn parts_of_loose_lines_that_touch_are_cut_in_any_order() {
    // Two squares with a whole edge in common, each side a line of its own.
    let sides = |x: f64| {
        let corners = [[x, 0.0], [x + 200.0, 0.0], [x + 200.0, 200.0], [x, 200.0]];
        (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]).collect::<Vec<_>>()
    };
    let in_order = [sides(0.1), sides(200.1)].concat();
    let read = |lines: &[[[f64; 2]; 2]]| {
        let line =
            |[from, to]: &[[f64; 2]; 2]| entity("LINE", "0", &[(10, from[0]), (20, from[1]), (11, to[0]), (21, to[1])]);
        let (marker, found) = as_read(&named(&file(&lines.iter().map(line).collect::<String>(), "")), &Job::default());
        (marker.pieces.len(), codes(&found))
    };
    assert_eq!(read(&in_order), (2, Vec::new()));
    let mut rng = Rng::with_seed(7);
    for _ in 0..DRAWINGS {
        let mut lines = in_order.clone();
        rng.shuffle(&mut lines);
        for line in &mut lines {
            if rng.bool() {
                line.reverse();
            }
        }
        assert_eq!(read(&lines), (2, Vec::new()), "{lines:?}");
    }
}

/// Both ends of a line.
type Ends = [[f64; 2]; 2];

/// Parts of a rectangle between straight lines, each of which is drawn once: their areas, and the lines.
fn divided([x, y, width, height]: [f64; 4], depth: u32, rng: &mut Rng) -> (Vec<f64>, Vec<Ends>) {
    if depth == 0 || width.max(height) < 120.0 {
        return (vec![width * height], Vec::new());
    }
    let share = 0.3 + 0.4 * rng.f64();
    let [one, other, line] = if width > height {
        let at = (width * share).round();
        [[x, y, at, height], [x + at, y, width - at, height], [x + at, y, x + at, y + height]]
    } else {
        let at = (height * share).round();
        [[x, y, width, at], [x, y + at, width, height - at], [x, y + at, x + width, y + at]]
    };
    let [(mut areas, mut lines), (more, others)] = [one, other].map(|part| divided(part, depth - 1, rng));
    areas.extend(more);
    lines.extend(others);
    lines.push([[line[0], line[1]], [line[2], line[3]]]);
    (areas, lines)
}

#[test]
fn edges_of_two_parts_that_are_drawn_once_bound_both() {
    for seed in 0..DRAWINGS {
        let mut rng = Rng::with_seed(seed);
        let (width, height, depth) = (800.0, [500.0, 300.0, 790.0][rng.usize(..3)], rng.u32(1..5));
        let (areas, inner) = divided([0.0, 0.0, width, height], depth, &mut rng);
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let around = (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]);
        let mut lines: Vec<Ends> = inner.iter().copied().chain(around).collect();
        // A notch parts no edge, and a line that is drawn again is the same line.
        lines.push([[20.5, 0.0], [20.5, 6.0]]);
        let again = lines.iter().filter(|&&line| line != inner[0] && rng.u32(..4) == 0).copied().collect::<Vec<_>>();
        lines.extend(again);
        rng.shuffle(&mut lines);
        let turn = rng.f64() * TAU;
        let place = |[x, y]: [f64; 2]| {
            [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()].map(|mm| (mm * 1e4).round() / 1e4)
        };
        let line = |ends: &Ends| {
            let [from, to] = if rng.bool() { [ends[1], ends[0]] } else { *ends }.map(place);
            entity("LINE", "0", &[(10, from[0]), (20, from[1]), (11, to[0]), (21, to[1])])
        };
        let source = named(&file(&lines.iter().map(line).collect::<String>(), ""));
        let (marker, found) = as_read(&source, &Job::default());
        assert_eq!(marker.pieces.len(), areas.len(), "{seed}: {:?}", codes(&found));
        assert!((area(&marker) - width * height).abs() < 1.0, "{seed}: {} of {}", area(&marker), width * height);
        assert!(codes(&found).contains(&"drawing/edge-of-two"), "{seed}: {:?}", codes(&found));
        assert_eq!(broken(&source, &marker, &Job::default()), [], "{seed}");
        // Somebody says that the lines are folds.
        let mut folds = Job::default();
        folds.lines.inner = Some(Inner::Ignore);
        let (whole, found) = as_read(&source, &folds);
        assert!(!codes(&found).contains(&"drawing/edge-of-two"), "{seed}: {:?}", codes(&found));
        assert_eq!(broken(&source, &whole, &folds), [], "{seed}");
        // An edge is said to stand twice and does not.
        let mut forged = marker.clone();
        let moved = &mut forged.drawing.as_mut().expect("an account").aside.moved;
        moved.doubled[0].iter_mut().for_each(|vertex| vertex.at.x += 50.0);
        let rules = broken(&source, &forged, &Job::default());
        assert!(rules.iter().any(|found| found.rule.name == "source/length"), "{seed}: {rules:?}");
    }
}

/// A cut file's marker drawn as plain DXF: outlines as polylines on one layer, slits as lines on it.
fn drawn(marker: &Marker) -> String {
    let mut entities = String::new();
    for (_, contour) in marker.contours() {
        let points = marker.points(contour);
        let places = &points[..points.len() - usize::from(contour.closed)];
        let groups = places.iter().flat_map(|at| [(10, at.x), (20, at.y)]);
        let flags = [(90, places.len() as f64), (70, f64::from(u8::from(contour.closed)))];
        entities += &entity("LWPOLYLINE", "Layer 1", &flags.into_iter().chain(groups).collect::<Vec<_>>());
    }
    for stroke in marker.pieces.iter().flat_map(|piece| &piece.notches).flat_map(Notch::strokes) {
        let groups = [(10, stroke.from.x), (20, stroke.from.y), (11, stroke.to.x), (21, stroke.to.y)];
        entities += &entity("LINE", "Layer 1", &groups);
    }
    file(&entities, "")
}

#[test]
fn a_marker_that_is_drawn_is_cut_as_its_cut_file() {
    for (seed, dialect) in (1..=8).flat_map(|seed| [(seed, Dialect::G71), (seed, Dialect::Inch)]) {
        let mut bytes = Vec::new();
        garment::write(&Order { dialect, seed, ..Order::default() }, &mut bytes).expect("memory takes it");
        let job = Job::default();
        let as_file = Source::new("a.cut", bytes).expect("small");
        let mut found = Diagnostics::default();
        let as_read = pipeline::marker_of(by_name("iso").expect("a dialect"), &as_file, &job, &mut found);
        let drawn = named(&drawn(&as_read));
        let read = |source: &Source| {
            let marker = pipeline::read(source, None, &job, &mut Diagnostics::default()).expect("a marker").marker;
            let notches: usize = marker.pieces.iter().map(|piece| piece.notches.len()).sum();
            (marker.pieces.len(), marker.contours().count(), notches, marker.drawn_length())
        };
        let (expected, read) = (read(&as_file), read(&drawn));
        assert_eq!((read.0, read.1, read.2), (expected.0, expected.1, expected.2), "{seed}, {dialect:?}");
        assert!((read.3 - expected.3).abs() <= 0.05, "{seed}, {dialect:?}: {} of {}", read.3, expected.3);
        let (marker, _) = self::as_read(&drawn, &job);
        let broken = broken(&drawn, &marker, &job);
        assert!(broken.is_empty(), "{seed}, {dialect:?}: {broken:#?}");
    }
}

#[test]
fn pens_and_layers_are_not_mixed_up() {
    let source = named(&file(&rectangle("0", [0.0, 0.0, 300.0, 200.0]), ""));
    let pens = cutc::machine::Numbers::parse("1").expect("a pen");
    let job = Job { lines: Lines { pens: Some(pens), ..Lines::default() }, ..Job::default() };
    assert_eq!(codes(&as_read(&source, &job).1), ["drawing/no-layer"]);
    let plot = Source::new("a.plt", b"IN;SP1;PU0,0;PD9000,0,9000,6000,0,6000,0,0;PU;".to_vec()).expect("small");
    let layers = Some(LayerUses::parse("CUT").expect("layers"));
    let job = Job { lines: Lines { layers, ..Lines::default() }, ..Job::default() };
    let mut found = Diagnostics::default();
    pipeline::marker_of(by_name("hpgl").expect("a dialect"), &plot, &job, &mut found);
    assert_eq!(codes(&found), ["drawing/no-layer"]);
}

#[test]
fn open_outlines_on_the_layer_of_the_knife_are_told() {
    let path = files("dxf").into_iter().find(|path| path.ends_with("open-outlines-on-the-layer-of-the-knife.dxf"));
    let path = path.expect("a fixture");
    let source = source(&path, std::fs::read(&path).expect("readable"));
    let mut found = Diagnostics::default();
    pipeline::read(&source, None, &Job::default(), &mut found).expect("a drawing");
    let found = codes(&found);
    assert_eq!(found, ["drawing/layers", "marker/sides", "marker/open-contour"]);
}

/// A line on the layer of the knife in no part that turns is an outline without one or two of its sides.
#[test]
fn a_bent_line_outside_all_parts_on_the_layer_of_the_knife_is_told() {
    let told = |open: &[[f64; 2]]| {
        let line = |places: &[[f64; 2]], closed: u8| {
            let vertex = |[x, y]: &[f64; 2]| format!("0\nVERTEX\n8\nCUT\n10\n{x}\n20\n{y}\n");
            let vertices = places.iter().map(vertex).collect::<Vec<_>>().concat();
            format!("0\nPOLYLINE\n8\nCUT\n66\n1\n70\n{closed}\n{vertices}0\nSEQEND\n")
        };
        let square = line(&[[0.0, 0.0], [300.0, 0.0], [300.0, 300.0], [0.0, 300.0]], 1);
        let text = format!(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}{square}0\nENDSEC\n0\nEOF\n",
            line(open, 0)
        );
        let source = Source::new("a.dxf", text.into_bytes()).expect("small");
        let mut found = Diagnostics::default();
        pipeline::read(&source, None, &Job::default(), &mut found).expect("a drawing");
        codes(&found).contains(&"marker/open-contour")
    };
    assert!(told(&[[500.0, 0.0], [800.0, 0.0], [800.0, 300.0]]));
    assert!(told(&[[500.0, 0.0], [1000.0, 0.0], [1000.0, 300.0]]));
    assert!(!told(&[[500.0, 0.0], [800.0, 0.0], [1100.0, 10.0]]));
    assert!(!told(&[[100.0, 0.0], [100.0, 50.0], [150.0, 50.0]]));
}

/// Dashes along the edges of a polygon with gaps between them and at its corners, mm; longer ones where an edge needs it.
fn dashes(polygon: &[Point], [dash, gap]: [f64; 2]) -> String {
    let mut lines = String::new();
    for (i, from) in polygon.iter().enumerate() {
        let way = polygon[(i + 1) % polygon.len()] - from;
        let step = 1.0 / (way.norm() / (dash + gap)).floor().max(1.0);
        let aside = 0.5 * gap / way.norm();
        let count = (1.0 / step).round() as u32;
        for at in (0..count).map(|k| f64::from(k) * step) {
            let [a, b] = [at + aside, at + step - aside].map(|share| from + way * share);
            lines += &entity("LINE", "0", &[(10, a.x), (20, a.y), (11, b.x), (21, b.y)]);
        }
    }
    lines
}

#[test]
fn a_pocket_in_an_outline_of_dashes_is_no_part() {
    for seed in 0..DRAWINGS {
        let mut rng = Rng::with_seed(seed);
        let (corners, turn) = (rng.u32(3..9), rng.f64() * TAU);
        let [width, height] = [200.0 + 500.0 * rng.f64(), 200.0 + 500.0 * rng.f64()];
        let corner = |i: u32| {
            let (y, x) = (turn + TAU * f64::from(i) / f64::from(corners)).sin_cos();
            Point::new(500.0 + width * x, 500.0 + height * y)
        };
        let outline: Vec<Point> = (0..corners).map(corner).collect();
        // From dashes as long as their gaps to whole sides that stop short of their corners.
        let dash = if rng.bool() { 6.0 + 20.0 * rng.f64() } else { 1000.0 };
        let gap = 3.0 + (dash.min(20.0) - 3.0) * rng.f64();
        let [dx, dy] = [0.15 * width, 0.15 * height].map(|most| most * (2.0 * rng.f64() - 1.0));
        let pocket = |x: f64| rectangle("0", [500.0 + x + dx, 485.0 + dy, 30.0, 30.0]);
        // Two pockets hide parts of the outline from each other.
        let pocket = if rng.bool() { pocket(-15.0) } else { pocket(-35.0) + &pocket(5.0) };
        let other = rectangle("0", [1600.0, 300.0, 300.0, 200.0]);
        let text = file(&format!("{}{pocket}{other}", dashes(&outline, [dash, gap])), "");
        let found = codes(&as_read(&named(&text), &Job::default()).1);
        assert!(found.contains(&"drawing/may-be-seam-line"), "{seed}: {found:?}");
    }
}
