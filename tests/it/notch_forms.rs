//! Notches of every form, as outlines and strokes draw them: on straight and curved edges, rounded to the units of files, drawn
//! either way round, from any point. What is none stays one.

use cutc::diagnostic::Diagnostics;
use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::ir::list::{FULL_SPEED, Joint, Segment};
use cutc::ir::marker::{Contour, NotchKind, Piece};
use cutc::machine::{Job, NotchStyle};
use cutc::pass::marker::MARKER_PASSES;
use cutc::pass::toolpath::trace;
use cutc::source::Span;
use cutc::verify::Works;

/// Units of files, mm: 0.1, a hundredth of an inch, a plotter's, and no grid.
const UNITS: [f64; 4] = [0.1, 0.254, 0.025, 0.0];

/// A place beside the edge: along it, and into the part.
type Place = (f64, f64);

fn arc(radius: f64, depth: f64) -> Vec<Place> {
    let middle = depth - radius;
    let place = |k: i32| {
        let angle = std::f64::consts::PI * f64::from(k) / 8.0;
        (-radius * angle.cos(), middle + radius * angle.sin())
    };
    let bottom = (0..=8).map(place);
    let mut all = vec![(-radius, 0.0)];
    all.extend(bottom.filter(|place| place.1 > 0.01));
    all.push((radius, 0.0));
    all
}

fn rectangle(width: f64, depth: f64) -> Vec<Place> {
    let half = width / 2.0;
    vec![(-half, 0.0), (-half, depth), (half, depth), (half, 0.0)]
}

fn v(width: f64, depth: f64) -> Vec<Place> {
    vec![(-width / 2.0, 0.0), (0.0, depth), (width / 2.0, 0.0)]
}

/// What is drawn in an outline, what it is called, how wide and how deep it is.
fn forms() -> Vec<(Vec<Place>, &'static str, f64, f64)> {
    let out = |places: Vec<Place>| places.into_iter().map(|(x, y)| (x, -y)).collect::<Vec<_>>();
    let steps = |width: f64| {
        let side = |x: f64, ys: [f64; 4]| ys.map(|y| (x, y));
        [side(-width / 2.0, [0.0, 1.6, 3.4, 5.0]), side(width / 2.0, [5.0, 3.1, 1.4, 0.0])].concat()
    };
    vec![
        (v(2.0, 5.0), "v", 2.0, 5.0),
        (v(3.0, 2.5), "v", 3.0, 2.5),
        (v(10.0, 6.0), "v", 10.0, 6.0),
        (out(v(4.0, 4.0)), "v-out", 4.0, 4.0),
        (rectangle(4.0, 4.0), "castle", 4.0, 4.0),
        (rectangle(2.5, 6.0), "castle", 2.5, 6.0),
        (rectangle(11.0, 3.0), "castle", 11.0, 3.0),
        (out(rectangle(4.0, 4.0)), "castle-out", 4.0, 4.0),
        (arc(2.0, 4.0), "u", 4.0, 4.0),
        (arc(4.0, 4.0), "u", 8.0, 4.0),
        (out(arc(3.0, 5.0)), "u-out", 6.0, 5.0),
        (rectangle(0.1, 5.0), "slit", 0.0, 5.0),
        (rectangle(0.5, 8.0), "slit", 0.0, 8.0),
        (v(0.4, 6.0), "slit", 0.0, 6.0),
        (vec![(0.0, 0.0), (0.0, 5.0), (0.0, 0.0)], "slit", 0.0, 5.0),
        (steps(0.0), "slit", 0.0, 5.0),
        (steps(0.2), "slit", 0.0, 5.0),
    ]
}

/// An edge of a part, as the ways that the part was turned and bent.
#[derive(Clone, Copy)]
struct Edge {
    /// How the part is turned, rad.
    turn: f64,
    /// Radius of the edge, mm; 0 when it is straight.
    radius: f64,
}

/// A part of 200 by 150 mm with something at the middle of its lower edge.
fn part(edge: Edge, drawn: &[Place]) -> Vec<Point> {
    let bow = |x: f64| if edge.radius > 0.0 { edge.radius - (edge.radius.powi(2) - x * x).sqrt() } else { 0.0 };
    let mut places: Vec<Place> = Vec::new();
    let side = |x: f64| (x, bow(x));
    let steps: Vec<f64> = (1..14).map(|k| 7.3 * f64::from(k)).collect();
    let room = drawn.iter().map(|place| place.0.abs()).fold(0.0, f64::max) + 1.5;
    let curved = steps.iter().copied().filter(|x| edge.radius > 0.0 && *x > room);
    places.push(side(-100.0));
    places.extend(curved.clone().map(|x| side(-x)).collect::<Vec<_>>().into_iter().rev());
    // The notch lies on the chord of its mouth.
    let base = drawn.first().map_or(0.0, |place| bow(place.0));
    places.extend(drawn.iter().map(|&(x, y)| (x, y + base)));
    places.extend(curved.map(side));
    places.extend([side(100.0), (100.0, 150.0), (-100.0, 150.0)]);
    places.iter().map(|&place| turned(edge, place)).collect()
}

fn turned(edge: Edge, (x, y): Place) -> Point {
    let (sine, cosine) = edge.turn.sin_cos();
    Point::new(317.3 + x * cosine - y * sine, 211.7 + x * sine + y * cosine)
}

/// A line of a file: each place rounded to its unit, none twice in a row.
fn rounded(points: &[Point], unit: f64) -> Vec<Point> {
    let to_unit = |value: f64| if unit > 0.0 { (value / unit).round() * unit } else { value };
    let mut line: Vec<Point> = points.iter().map(|point| Point::new(to_unit(point.x), to_unit(point.y))).collect();
    line.dedup();
    line
}

/// The marker that a file with these lines is, behind all passes, and whether all of it is still cut.
fn passed(lines: &[Vec<Point>], unit: f64, job: &Job) -> (Marker, bool, Vec<&'static str>) {
    let mut marker = Marker { unit, ..Marker::default() };
    let mut block = 0;
    let mut piece = Piece { number: 1, ..Piece::default() };
    for line in lines {
        let segments: Vec<Segment> = line
            .windows(2)
            .map(|ends| {
                block += 1;
                let span = Span { start: 10 * block, end: 10 * block + 9, block };
                Segment { from: ends[0], to: ends[1], span, joint: Joint::default(), percent: FULL_SPEED }
            })
            .collect();
        let range = marker.list.append(segments).expect("a line has segments");
        piece.contours.push(Contour { range, closed: line.first() == line.last() });
    }
    marker.pieces.push(piece);
    let works = Works::of(&marker);
    let mut found = Diagnostics::default();
    for pass in MARKER_PASSES {
        (pass.run)(&mut marker, job, &mut found);
    }
    let codes = found.iter().map(|diagnostic| diagnostic.code.name).collect();
    let kept = works.kept(&marker, &job.profile).holds();
    (marker, kept, codes)
}

/// Kind, depth and place of each notch.
fn notches(marker: &Marker) -> Vec<(&'static str, f64, Point)> {
    let piece = &marker.pieces[0];
    let kind = |kind: NotchKind| if kind == NotchKind::Slit { "slit" } else { "t" };
    let slits = piece.notches.iter().map(|notch| (kind(notch.kind), notch.depth(), notch.root));
    slits.chain(piece.outline_notches.iter().map(|notch| (notch.word(), notch.depth(), notch.root()))).collect()
}

/// The line of a closed contour that starts at a vertex, either way round.
fn ring(points: &[Point], start: usize, is_turned: bool) -> Vec<Point> {
    let mut ring = points.to_vec();
    ring.rotate_left(start % points.len());
    if is_turned {
        ring.reverse();
    }
    ring.push(ring[0]);
    ring
}

fn edges() -> impl Iterator<Item = Edge> {
    let radii = [0.0, 250.0];
    [0.0, 0.37, 1.9, 4.4].into_iter().flat_map(move |turn| radii.map(|radius| Edge { turn, radius }))
}

#[test]
fn every_form_is_found_in_every_unit_on_every_edge() {
    let job = Job::default();
    for (drawn, word, width, depth) in forms() {
        for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
            let points = part(edge, &drawn);
            let slack = std::f64::consts::SQRT_2 * unit + 0.02;
            for start in 0..points.len() {
                for is_turned in [false, true] {
                    let line = rounded(&ring(&points, start, is_turned), unit);
                    let (marker, is_kept, codes) = passed(&[line], unit, &job);
                    let found = notches(&marker);
                    let case =
                        format!("{word} {width} by {depth}, unit {unit}, turned {} radius {}", edge.turn, edge.radius);
                    assert!(is_kept && codes.is_empty(), "{case}: {codes:?} {is_kept}");
                    let [(kind, deep, root)] = found[..] else { panic!("{case}: {found:?}") };
                    let base = if edge.radius > 0.0 { 0.1 } else { 0.0 };
                    let off = (root - turned(edge, (0.0, 0.0))).norm();
                    assert_eq!(kind, word, "{case}");
                    assert!((deep - depth).abs() <= slack && off <= slack + base, "{case}: {deep} {off}");
                }
            }
        }
    }
}

/// Each corner is rounded by itself, so that the two at the bottom lie at different depths.
#[test]
fn a_castle_stays_a_castle_however_its_corners_are_rounded() {
    const TURNS: u32 = 180;
    let job = Job::default();
    let castles = forms().into_iter().filter(|(_, word, ..)| word.starts_with("castle"));
    for (drawn, word, width, depth) in castles {
        for unit in UNITS {
            for turn in (0..TURNS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(TURNS)) {
                let points = part(Edge { turn, radius: 0.0 }, &drawn);
                let (marker, ..) = passed(&[rounded(&ring(&points, 0, false), unit)], unit, &job);
                let found: Vec<&str> = notches(&marker).into_iter().map(|(word, ..)| word).collect();
                assert_eq!(found, [word], "{width} by {depth}, unit {unit}, turned {turn}");
            }
        }
    }
}

#[test]
fn strokes_at_an_edge_are_slits_also_when_they_miss_it_and_carry_crossbars() {
    let job = Job::default();
    for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
        let outline = rounded(&ring(&part(edge, &[]), 0, false), unit);
        let stroke = |from: Place, to: Place| rounded(&[turned(edge, from), turned(edge, to)], unit);
        let slack = std::f64::consts::SQRT_2 * unit + 0.05;
        // On the chord of a curved edge the place lies off the curve.
        let y = if edge.radius > 0.0 { 0.06 } else { 0.0 };
        for miss in [0.0, 0.15, 0.4] {
            let slit = stroke((0.0, y + miss), (0.0, y + 5.0));
            let (marker, is_kept, _) = passed(&[outline.clone(), slit.clone()], unit, &job);
            let [("slit", depth, _)] = notches(&marker)[..] else { panic!("{unit} {miss}: {:?}", notches(&marker)) };
            assert!(is_kept && (depth - 5.0).abs() <= slack + 0.06, "{unit} {miss} {depth}");
            let bar = stroke((-2.5, y + 5.0), (2.5, y + 5.0));
            let (marker, ..) = passed(&[outline.clone(), slit, bar], unit, &job);
            assert!(matches!(notches(&marker)[..], [("t", ..)]), "{unit} {miss}: {:?}", notches(&marker));
        }
    }
}

#[test]
fn what_is_no_notch_stays_none() {
    let teeth = |count: i32| {
        let start = -1.5 * f64::from(count);
        (0..=2 * count).map(|k| (start + 1.5 * f64::from(k), if k % 2 == 1 { 3.0 } else { 0.0 })).collect::<Vec<_>>()
    };
    let out = |places: Vec<Place>| places.into_iter().map(|(x, y)| (x, -y)).collect::<Vec<_>>();
    let job = Job::default();
    for drawn in [
        v(20.0, 10.0),
        v(8.0, 30.0),
        teeth(9),
        rectangle(20.0, 8.0),
        out(rectangle(20.0, 8.0)),
        out(rectangle(4.0, 30.0)),
        rectangle(4.0, 25.0),
        rectangle(0.5, 25.0),
        vec![(0.0, 0.0), (0.0, 0.9), (3.0, 0.9)],
        Vec::new(),
    ] {
        for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
            let line = rounded(&ring(&part(edge, &drawn), 2, false), unit);
            let segments = line.len() - 1;
            let (marker, is_kept, _) = passed(&[line], unit, &job);
            assert_eq!(notches(&marker), [], "{drawn:?} {unit} {}", edge.turn);
            let left = marker.points(&marker.pieces[0].contours[0]).len() - 1;
            assert!(is_kept && left == segments, "{drawn:?}");
        }
    }
    // A part that is a triangle, and one that is smaller than a notch may be.
    for corners in [vec![(0.0, 0.0), (0.0, 5.0), (2.0, 0.0)], rectangle(8.0, 8.0), rectangle(0.5, 10.0)] {
        let points: Vec<Point> = corners.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let (marker, ..) = passed(&[ring(&points, 0, false)], 0.1, &job);
        assert_eq!(notches(&marker), [], "{corners:?}");
    }
}

#[test]
fn a_step_out_and_back_that_is_shorter_than_a_notch_is_dropped() {
    let job = Job::default();
    for unit in UNITS {
        let edge = Edge { turn: 0.0, radius: 0.0 };
        let line = rounded(&ring(&part(edge, &[(0.0, 0.0), (0.0, 0.6), (0.0, 0.0)]), 0, false), unit);
        let (marker, is_kept, _) = passed(&[line], unit, &job);
        assert!(is_kept && notches(&marker).is_empty(), "{unit}");
        assert_eq!(marker.points(&marker.pieces[0].contours[0]).len(), 6, "{unit}");
    }
}

#[test]
fn every_style_acts_on_every_form_whichever_way_it_goes() {
    for (drawn, word, _, depth) in forms() {
        for (style, asked, cuts) in
            [(NotchStyle::Slit, None, 2), (NotchStyle::Slit, Some(3.0), 2), (NotchStyle::Skip, None, 1)]
        {
            let mut job = Job::default();
            (job.profile.notch.style, job.profile.notch.depth_mm) = (style, asked);
            let edge = Edge { turn: 0.0, radius: 0.0 };
            for start in [0, 2, 3] {
                let line = rounded(&ring(&part(edge, &drawn), start, false), 0.025);
                let (marker, ..) = passed(&[line], 0.025, &job);
                let runs: Vec<Vec<Point>> = trace(&marker, &job)
                    .flat_map(|toolpath| toolpath.steps)
                    .filter_map(|step| match step {
                        cutc::ir::toolpath::Step::Run(run) => Some(run.points),
                        _ => None,
                    })
                    .collect();
                assert_eq!(runs.len(), cuts, "{word} {style:?}");
                let way = |points: &[Point]| points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum::<f64>();
                assert!((way(&runs[cuts - 1]) - 700.0).abs() < 0.1, "{word} {style:?}: {:?}", runs[cuts - 1]);
                if style == NotchStyle::Slit {
                    let (from, to) = (runs[0][0], runs[0][1]);
                    assert!(((to - from).norm() - asked.unwrap_or(depth)).abs() < 0.05, "{word} {runs:?}");
                    assert!((from.y - 211.7).abs() < 0.05 && to.y > from.y, "{word}: into the part, {runs:?}");
                }
            }
        }
    }
}

#[test]
fn notches_in_a_row_are_counted_and_the_strips_between_them_are_not() {
    for style in [NotchStyle::AsDrawn, NotchStyle::Slit] {
        let mut job = Job::default();
        job.profile.notch.style = style;
        for (form, word) in [(rectangle(5.0, 5.0), "castle"), (arc(2.5, 5.0), "u")] {
            for (count, strip) in [(2, 4.0), (3, 3.0), (3, 8.0), (5, 6.0), (6, 10.0)] {
                let place = |k: usize| (k as f64 - (count - 1) as f64 / 2.0) * (5.0 + strip);
                let row: Vec<Place> =
                    (0..count).flat_map(|k| form.iter().map(move |&(x, y)| (x + place(k), y))).collect();
                let points = part(Edge { turn: 0.3, radius: 0.0 }, &row);
                let (marker, is_kept, _) = passed(&[rounded(&ring(&points, 1, false), 0.025)], 0.025, &job);
                let found: Vec<&str> = notches(&marker).into_iter().map(|(kind, ..)| kind).collect();
                assert_eq!((found, is_kept), (vec![word; count], true), "{count} {strip} mm apart");
            }
        }
    }
}

/// A form that leans: sheared along the edge, and as deep along its axis as before.
fn leaning(drawn: &[Place], lean: f64) -> Vec<Place> {
    drawn.iter().map(|&(x, y)| (x + y * lean.sin(), y * lean.cos())).collect()
}

/// Seeded leans up to 40 degrees to either side, rad.
fn leans() -> impl Iterator<Item = f64> {
    let most = 40.0_f64.to_radians();
    let mut seed: u64 = 0x5eed;
    let seeded = std::iter::repeat_with(move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 40) as f64 / f64::from(1 << 24)).mul_add(2.0, -1.0) * most
    });
    [-most, most].into_iter().chain(seeded.take(4))
}

/// V, castle and U notches with a mouth that stays wider than a slit when they lean; a U needs walls to lean.
fn leaning_forms() -> impl Iterator<Item = (Vec<Place>, &'static str, f64, f64)> {
    let has_walls = |word: &str, width: f64, depth: f64| !word.starts_with('u') || depth >= width;
    forms()
        .into_iter()
        .filter(move |(_, word, width, depth)| *word != "slit" && *width >= 2.0 && has_walls(word, *width, *depth))
}

/// V and castle notches, with a mouth that stays wider than a slit when they lean.
fn wide_forms() -> impl Iterator<Item = (Vec<Place>, &'static str, f64, f64)> {
    forms().into_iter().filter(|(_, word, width, _)| !word.starts_with('u') && *word != "slit" && *width >= 2.0)
}

#[test]
fn a_notch_that_leans_to_its_edge_keeps_its_form_depth_and_place() {
    let job = Job::default();
    for (drawn, word, width, depth) in leaning_forms() {
        for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
            for lean in leans() {
                let points = part(edge, &leaning(&drawn, lean));
                for (start, is_turned) in [(0, false), (2, true), (points.len() / 2, false)] {
                    let line = rounded(&ring(&points, start, is_turned), unit);
                    let (marker, is_kept, codes) = passed(&[line], unit, &job);
                    let case = format!("{word} {width} by {depth}, lean {lean}, unit {unit}, turned {}", edge.turn);
                    assert!(is_kept && codes.is_empty(), "{case}: {codes:?} {is_kept}");
                    let found = notches(&marker);
                    let [(kind, deep, root)] = found[..] else { panic!("{case}: {found:?}") };
                    let slack = std::f64::consts::SQRT_2 * unit + 0.02;
                    // A U with short walls looks nearly alike, whether it leans or its edge cuts it off askew.
                    let deeper = if word.starts_with('u') { slack + 0.15 * depth } else { 0.0 };
                    let base = if edge.radius > 0.0 { 0.1 } else { 0.0 };
                    assert_eq!(kind, word, "{case}");
                    let off = (root - turned(edge, (0.0, 0.0))).norm();
                    assert!((deep - depth).abs() <= slack + deeper && off <= slack + base, "{case}: {deep} {off}");
                }
            }
        }
    }
}

/// A castle or U that is turned about the middle of its mouth, its walls cut off or led on to the edge.
fn turned_and_cut_off(drawn: &[Place], lean: f64) -> Vec<Place> {
    let (sine, cosine) = lean.sin_cos();
    let turned = |(x, y): Place| (x * cosine + y * sine, y * cosine - x * sine);
    let on_edge = |place: Place| {
        let (x, y) = turned(place);
        (x - y * lean.tan(), 0.0)
    };
    let [first, inner @ .., last] = drawn else { panic!("a notch has places") };
    let inner = inner.iter().map(|&place| turned(place));
    [on_edge(*first)].into_iter().chain(inner).chain([on_edge(*last)]).collect()
}

#[test]
fn a_notch_that_its_edge_cuts_off_askew_keeps_its_form_and_depth() {
    let job = Job::default();
    let out = |places: Vec<Place>| places.into_iter().map(|(x, y)| (x, -y)).collect::<Vec<_>>();
    let forms = [
        (rectangle(4.0, 4.0), "castle", 4.0),
        (rectangle(2.5, 6.0), "castle", 6.0),
        (out(rectangle(4.0, 7.0)), "castle-out", 7.0),
        (arc(2.0, 6.0), "u", 6.0),
        (arc(1.5, 5.0), "u", 5.0),
        (out(arc(2.5, 7.0)), "u-out", 7.0),
    ];
    for (drawn, word, depth) in forms {
        for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
            for lean in leans() {
                let points = part(edge, &turned_and_cut_off(&drawn, lean));
                let (marker, is_kept, codes) = passed(&[rounded(&ring(&points, 1, false), unit)], unit, &job);
                let case = format!("{word} {depth} deep, lean {lean}, unit {unit}, turned {}", edge.turn);
                assert!(is_kept && codes.is_empty(), "{case}: {codes:?} {is_kept}");
                let found = notches(&marker);
                let [(kind, deep, _)] = found[..] else { panic!("{case}: {found:?}") };
                assert_eq!(kind, word, "{case}");
                assert!((deep - depth).abs() <= 2.0 * unit + 0.1, "{case}: {deep}");
            }
        }
    }
}

#[test]
fn v_notches_that_touch_are_counted_up_to_three_in_a_row() {
    for (style, edge) in
        [NotchStyle::AsDrawn, NotchStyle::Slit].into_iter().flat_map(|style| edges().map(move |edge| (style, edge)))
    {
        let mut job = Job::default();
        job.profile.notch.style = style;
        for (width, depth) in [(3.0, 5.0), (4.0, 4.0), (5.0, 4.5)] {
            for (count, lean, unit) in [(2, 0.0, 0.1), (2, 0.2, 0.254), (3, 0.0, 0.025), (3, -0.2, 0.0), (4, 0.0, 0.1)]
            {
                let one = leaning(&v(width, depth), lean);
                let place = |k: usize| (k as f64 - (count - 1) as f64 / 2.0) * width;
                let mut row: Vec<Place> =
                    (0..count).flat_map(|k| one.iter().map(move |&(x, y)| (x + place(k), y))).collect();
                row.dedup_by(|a, b| (a.0 - b.0).abs() < 1e-9 && a.1 == b.1);
                let points = part(edge, &row);
                for start in 0..points.len() {
                    let line = rounded(&ring(&points, start, start % 2 == 1), unit);
                    let (marker, is_kept, _) = passed(&[line], unit, &job);
                    let found: Vec<&str> = notches(&marker).into_iter().map(|(kind, ..)| kind).collect();
                    let expected = if count <= 3 { vec!["v"; count] } else { Vec::new() };
                    let case = format!("{count} of {width} by {depth}, lean {lean}, unit {unit}, start {start}");
                    assert_eq!((found, is_kept), (expected, true), "{case}");
                }
            }
        }
    }
}

#[test]
fn a_v_over_a_corner_or_beside_one_is_a_notch_and_a_cut_out_is_none() {
    let job = Job::default();
    let corner = |drawn: &[Place]| [drawn, &[(150.0, 0.0), (150.0, 120.0), (0.0, 120.0)]].concat();
    for (drawn, expected) in [
        (vec![(0.0, 3.0), (5.0, 5.0), (3.0, 0.0)], vec!["v"]),
        (vec![(0.0, 0.0), (2.0, 5.0), (4.0, 0.0)], vec!["v"]),
        (vec![(0.0, 0.0), (1.5, 0.0), (3.5, 5.0), (5.5, 0.0)], vec!["v"]),
        (vec![(0.0, 5.0), (5.0, 5.0), (5.0, 0.0)], vec![]),
        (vec![(0.0, 4.0), (7.0, 4.0), (7.0, 0.0)], vec![]),
        (vec![(0.0, 5.0), (5.0, 0.0)], vec![]),
        (vec![(0.0, 6.0), (1.8, 1.8), (6.0, 0.0)], vec![]),
    ] {
        for (unit, edge) in UNITS.into_iter().flat_map(|unit| edges().map(move |edge| (unit, edge))) {
            let points: Vec<Point> = corner(&drawn).into_iter().map(|place| turned(edge, place)).collect();
            for start in 0..points.len() {
                let (marker, is_kept, _) = passed(&[rounded(&ring(&points, start, start % 2 == 0), unit)], unit, &job);
                let found: Vec<&str> = notches(&marker).into_iter().map(|(kind, ..)| kind).collect();
                assert_eq!((found, is_kept), (expected.clone(), true), "{drawn:?}, unit {unit}, turn {}", edge.turn);
            }
        }
    }
}

#[test]
fn the_tails_of_a_narrow_strip_are_no_notch() {
    let job = Job::default();
    for unit in UNITS {
        let strip = [(0.0, 0.0), (80.0, 0.0), (75.0, 5.0), (80.0, 10.0), (0.0, 10.0)];
        let points: Vec<Point> = strip.map(|(x, y)| Point::new(x + 50.0, y + 50.0)).to_vec();
        let (marker, ..) = passed(&[rounded(&ring(&points, 0, false), unit)], unit, &job);
        assert_eq!(notches(&marker), [], "{unit}");
    }
}

#[test]
fn every_style_acts_on_a_notch_that_leans() {
    for (drawn, word, _, depth) in wide_forms() {
        for (style, lean) in [NotchStyle::Slit, NotchStyle::Skip].into_iter().flat_map(|s| leans().map(move |l| (s, l)))
        {
            let mut job = Job::default();
            job.profile.notch.style = style;
            let edge = Edge { turn: 0.0, radius: 0.0 };
            let line = rounded(&ring(&part(edge, &leaning(&drawn, lean)), 0, false), 0.025);
            let (marker, ..) = passed(&[line], 0.025, &job);
            let steps = trace(&marker, &job).flat_map(|toolpath| toolpath.steps);
            let run = |step| if let cutc::ir::toolpath::Step::Run(run) = step { Some(run.points) } else { None };
            let runs: Vec<Vec<Point>> = steps.filter_map(run).collect();
            let case = format!("{word} {style:?} {lean}");
            assert_eq!(runs.len(), if style == NotchStyle::Slit { 2 } else { 1 }, "{case}");
            let outline: f64 = runs[runs.len() - 1].windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
            assert!((outline - 700.0).abs() < 0.1, "{case}: {outline}");
            if style == NotchStyle::Slit {
                let slit = runs[0][1] - runs[0][0];
                assert!((slit.norm() - depth).abs() < 0.05, "{case}: as deep as along the axis");
                assert!((slit.y - depth * lean.cos()).abs() < 0.05, "{case}: into the part, along the axis");
            }
        }
    }
}

#[test]
fn boxes_as_wide_as_the_profile_says_are_slits() {
    let edge = Edge { turn: 0.2, radius: 0.0 };
    let kinds = |width: f64, box_max: f64| {
        let mut job = Job::default();
        job.profile.notch.box_max_mm = box_max;
        let (marker, ..) = passed(&[ring(&part(edge, &rectangle(width, 5.0)), 0, false)], 0.0, &job);
        notches(&marker).into_iter().map(|(kind, ..)| kind).collect::<Vec<_>>()
    };
    assert_eq!(kinds(0.6, 0.6), ["slit"]);
    assert_eq!(kinds(0.8, 0.6), [""; 0]);
    assert_eq!(kinds(0.8, 1.0), ["slit"]);
    assert_eq!(kinds(0.1, 0.0), [""; 0]);
}
