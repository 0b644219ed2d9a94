//! Outlines of turn and curve points are cut along their curves: those of layer 84, else those of the CAD system.

use std::f64::consts::TAU;

use cutc::geom::{Point, Vector, polyline};
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::machine::patterns::Curves;
use fastrand::Rng;

use super::audit::broken;
use super::writer::{Drawn, Place, Writer};
use super::{as_read, source};

/// An outline: its vertices, which of them are corners, and its curves in fine chords.
#[derive(Debug, Clone, Default)]
pub(super) struct Outline {
    pub(super) vertices: Vec<Place>,
    pub(super) is_corner: Vec<bool>,
    pub(super) fine: Vec<Place>,
}

/// A figure like a flower, whose corners are joined by arcs of waves: each side has points of its curve, or is straight.
pub(super) fn flower(random: &mut Rng, sides: usize) -> Outline {
    let mut outline = Outline::default();
    let corner = |k: usize, reach: f64| {
        let angle = TAU * k as f64 / sides as f64;
        [reach * angle.cos(), reach * angle.sin()]
    };
    let reaches: Vec<f64> = (0..sides).map(|_| 200.0 + 100.0 * random.f64()).collect();
    for k in 0..sides {
        let [from, to] = [corner(k, reaches[k]), corner(k + 1, reaches[(k + 1) % sides])];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let points = random.usize(0..5);
        let height = if points == 0 { 0.0 } else { 0.1 * (random.f64() - 0.5) };
        let at = |t: f64| {
            let bow = height * (TAU * t / 2.0).sin();
            [from[0] + t * dx - bow * dy, from[1] + t * dy + bow * dx]
        };
        let steps = (points + 1) * 12;
        for step in 0..steps {
            let place = at(step as f64 / steps as f64);
            if step % 12 == 0 {
                outline.vertices.push(place);
                outline.is_corner.push(step == 0);
            }
            if step == 0 || points > 0 {
                outline.fine.push(place);
            }
        }
    }
    outline
}

impl Outline {
    /// Writes its vertices, and points that say which are corners and which are on curves.
    pub(super) fn write(&self, file: &mut Writer, layer: u32, drawn: Drawn) {
        file.outline(layer, &self.vertices, drawn);
        for (place, is_corner) in self.vertices.iter().zip(&self.is_corner) {
            file.point(if *is_corner { 2 } else { 3 }, *place, [0.0; 2]);
        }
    }

    fn chord(&self, k: usize) -> [Place; 2] {
        [self.vertices[k], self.vertices[(k + 1) % self.vertices.len()]]
    }
}

fn rotated(places: &[Place], by: usize, is_back: bool) -> Vec<Place> {
    let mut places = places.to_vec();
    places.rotate_left(by);
    if is_back {
        places.reverse();
    }
    places
}

pub(super) fn points(marker: &Marker) -> Vec<Point> {
    let (_, contour) = marker.contours().last().expect("an outline");
    marker.points(contour)
}

/// How far the places of one line are from another, mm, at the most.
pub(super) fn apart(places: &[Point], line: &[Point]) -> f64 {
    places.iter().map(|&at| polyline::distance(at, line)).fold(0.0, f64::max)
}

/// Moves a line of the file to where the lower left corner of the box around it is at the origin, as pieces in a row are.
pub(super) fn laid(places: &[Place]) -> Vec<Point> {
    let least = |axis: usize| places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
    let by = Vector::new(least(0), least(1));
    places.iter().chain(&places[..1]).map(|&place| Point::from(place) - by).collect()
}

#[test]
fn an_outline_of_turn_and_curve_points_is_cut_along_layer_84() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let sides = random.usize(3..8);
        let outline = flower(&mut random, sides);
        if outline.fine.len() == outline.vertices.len() {
            continue; // no side has a curve
        }
        let fine = rotated(&outline.fine, random.usize(..outline.fine.len()), random.bool());
        for (drawn, of_fine) in
            Drawn::ALL.into_iter().zip([Drawn::Closed, Drawn::Parts, Drawn::Lines, Drawn::FirstIsLast, Drawn::Closed])
        {
            let mut file = Writer::begin();
            file.block("A");
            outline.write(&mut file, 1, drawn);
            file.outline(84, &fine, of_fine);
            file.end_block();
            let source = source(file.end(&["UNITS: METRIC"]));
            let (marker, found) = as_read(&source, &Job::default());
            assert_eq!(found, ["dxf/curves"], "{seed} {drawn:?}");
            let (cut, wanted) = (points(&marker), laid(&fine));
            let worst = apart(&cut, &wanted).max(apart(&wanted, &cut));
            assert!(worst < 0.01, "seed {seed}, {drawn:?}: {worst}");
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}, {drawn:?}");
        }
    }
}

#[test]
fn a_control_polygon_on_layer_84_leaves_an_outline_that_is_fine_itself() {
    let mut random = Rng::with_seed(7);
    let outline = flower(&mut random, 5);
    let mut file = Writer::begin();
    file.block("A").outline(1, &outline.fine, Drawn::Closed);
    // Handles beside the curve, and more of them than the outline has vertices.
    let polygon: Vec<Place> =
        outline.fine.iter().flat_map(|&[x, y]| [[1.02 * x, 1.02 * y], [1.03 * x, 1.03 * y]]).collect();
    file.outline(84, &[&outline.fine[..1], &polygon[..]].concat(), Drawn::Closed);
    outline.fine.iter().for_each(|place| _ = file.point(3, *place, [0.0; 2]));
    file.end_block();
    let source = source(file.end(&["UNITS: METRIC"]));
    let (marker, found) = as_read(&source, &Job::default());
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(points(&marker).len(), outline.fine.len() + 1);
    assert_eq!(broken(&source, &marker, &Job::default()), [""; 0]);
}

#[test]
fn a_fine_line_beside_the_vertices_of_its_outline_is_told_and_curves_are_laid_without_it() {
    let mut random = Rng::with_seed(3);
    let outline = flower(&mut random, 5);
    let read = |fine: Option<Vec<Place>>| {
        let mut file = Writer::begin();
        file.block("A");
        outline.write(&mut file, 1, Drawn::Closed);
        if let Some(fine) = fine {
            file.outline(84, &fine, Drawn::Closed);
        }
        file.end_block();
        let source = source(file.end(&["UNITS: METRIC"]));
        let (marker, found) = as_read(&source, &Job::default());
        assert_eq!(broken(&source, &marker, &Job::default()), [""; 0]);
        (points(&marker), found)
    };
    let (laid, _) = read(None);
    let rounded =
        |unit: f64| outline.fine.iter().map(|place| place.map(|value| (value / unit).round() * unit)).collect();
    let moved = |by: Place| outline.fine.iter().map(|&[x, y]| [x + by[0], y + by[1]]).collect();
    for fine in [rounded(0.1), moved([0.02, 0.0]), moved([0.0, 0.02]), moved([0.0, 0.5]), moved([1.0, 0.0])] {
        let (cut, found) = read(Some(fine));
        assert_eq!(found, ["dxf/curve-missed", "dxf/curves-guessed"]);
        assert_eq!(cut, laid);
    }
}

/// The natural cubic spline over the lengths of chords, at so many places a span: its bends by repeated averaging.
fn natural(knots: &[Place], places: usize) -> Vec<Place> {
    let points: Vec<Point> = knots.iter().map(|&knot| knot.into()).collect();
    let h: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let slope = |k: usize| (points[k + 1] - points[k]) / h[k];
    let mut bends = vec![Vector::zeros(); points.len()];
    for _ in 0..200 {
        for k in 1..points.len() - 1 {
            let right = (slope(k) - slope(k - 1)) * 6.0;
            bends[k] = (right - bends[k - 1] * h[k - 1] - bends[k + 1] * h[k]) / (2.0 * (h[k - 1] + h[k]));
        }
    }
    let mut curve = Vec::new();
    for k in 0..h.len() {
        for place in 0..places {
            let s = h[k] * place as f64 / places as f64;
            let r = h[k] - s;
            let bow = (bends[k] * (r * r * r) + bends[k + 1] * (s * s * s)) / (6.0 * h[k]);
            let straight = (points[k].coords / h[k] - bends[k] * (h[k] / 6.0)) * r
                + (points[k + 1].coords / h[k] - bends[k + 1] * (h[k] / 6.0)) * s;
            let at = bow + straight;
            curve.push([at.x, at.y]);
        }
    }
    curve
}

/// Chords that are divided until none is higher than a curve tolerance of 0.006 in, as some systems write layer 84.
fn divided(knots: &[Place]) -> Vec<Place> {
    let mut way: Vec<(Point, bool)> = knots.iter().map(|&knot| (knot.into(), true)).collect();
    loop {
        let unit = |k: usize| (way[k + 1].0 - way[k].0).normalize();
        let tangent = |k: usize| {
            if k == 0 {
                unit(0)
            } else if k + 1 == way.len() {
                unit(k - 1)
            } else {
                (unit(k - 1) + unit(k)).normalize()
            }
        };
        let mut next = Vec::new();
        for k in 0..way.len() - 1 {
            let [a, b] = [way[k].0, way[k + 1].0];
            let lift = (tangent(k) - tangent(k + 1)) * (0.98 * (b - a).norm() / 8.0);
            let middle = a + (b - a) / 2.0 + lift;
            let is_high = way[k].1 && polyline::distance_to_segment(middle, a, b) > 0.1524;
            next.push((a, is_high));
            if is_high {
                next.push((middle, true));
            }
        }
        next.push(way[way.len() - 1]);
        if next.len() == way.len() {
            return next[..next.len() - 1].iter().map(|(at, _)| [at.x, at.y]).collect();
        }
        way = next;
    }
}

/// The fine line of an outline whose curves some system lays between corners.
fn drafted(outline: &Outline, lay: impl Fn(&[Place]) -> Vec<Place>) -> Vec<Place> {
    let count = outline.vertices.len();
    let corners: Vec<usize> = (0..count).filter(|&k| outline.is_corner[k]).chain([count]).collect();
    let mut fine = Vec::new();
    for pair in corners.windows(2) {
        let knots: Vec<Place> = (pair[0]..=pair[1]).map(|k| outline.vertices[k % count]).collect();
        fine.extend(if knots.len() > 2 { lay(&knots) } else { vec![knots[0]] });
    }
    fine
}

#[test]
fn with_layer_84_and_without_a_pattern_is_the_same() {
    type Lay = fn(&[Place]) -> Vec<Place>;
    // The curves of layer 84 are chords of their own: 0.006 in, or fine ones.
    let systems: [(&str, Lay, f64); 2] = [
        ("AUTHOR: Gerber AccuMark V10.0.1", divided, 0.003),
        ("Author : CLO Standalone 7.0", |knots| natural(knots, 40), 0.001),
    ];
    for (author, lay, most) in systems {
        for seed in 0..40 {
            let mut random = Rng::with_seed(seed);
            let sides = random.usize(3..7);
            let outline = flower(&mut random, sides);
            let fine = drafted(&outline, lay);
            if fine.len() == outline.vertices.len() {
                continue;
            }
            let read = |with_fine: bool| {
                let mut file = Writer::begin();
                file.block("A");
                outline.write(&mut file, 1, Drawn::Closed);
                if with_fine {
                    file.outline(84, &fine, Drawn::Closed);
                }
                file.end_block();
                let source = source(file.end(&["UNITS: METRIC", author]));
                let (marker, found) = as_read(&source, &Job::default());
                assert_eq!(found, ["dxf/curves"], "{author} {seed}");
                assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "{author} {seed}");
                marker
            };
            let [astm, aama] = [true, false].map(|with_fine| points(&read(with_fine)));
            // Both lie in a corner of their own box, which the chords of one may cut a little narrower.
            let worst = apart(&astm, &aama);
            assert!(worst <= most + 0.16, "{author} {seed}: {worst}");
            let centred = |points: &[Point], by: Vector| points.iter().map(|at| at + by).collect::<Vec<Point>>();
            let first = |points: &[Point]| points[0];
            let by = first(&aama) - first(&astm);
            let worst = apart(&centred(&astm, by), &aama);
            assert!(worst <= most + 0.02, "{author} {seed}: {worst}");
        }
    }
}

#[test]
fn an_unknown_system_is_said_and_no_curves_are_laid_where_nobody_wants_them() {
    let mut random = Rng::with_seed(3);
    let outline = flower(&mut random, 4);
    let mut file = Writer::begin();
    file.block("A");
    outline.write(&mut file, 1, Drawn::Parts);
    file.end_block();
    let source = source(file.end(&["UNITS: METRIC"]));
    let (curved, found) = as_read(&source, &Job::default());
    assert_eq!(found, ["dxf/curves-guessed"]);
    let mut job = Job::default();
    job.profile.dxf.curves = Curves::Points;
    let (straight, found) = as_read(&source, &job);
    assert!(found.is_empty(), "{found:?}");
    assert_eq!(points(&straight).len(), outline.vertices.len() + 1);
    assert!(points(&curved).len() > points(&straight).len());
    assert_eq!(broken(&source, &straight, &job), [""; 0]);
    // Neither is taken for the other.
    assert!(broken(&source, &straight, &Job::default()).contains(&"source/points"));
    assert!(broken(&source, &curved, &job).contains(&"source/points"));
}

/// Half of an outline above the X axis, with its fold line, and the whole of it.
fn halves(random: &mut Rng, is_smooth: bool, with_fine: bool) -> [Writer; 2] {
    let count = random.usize(3..7);
    let reach = 150.0 + 50.0 * random.f64();
    let at = |t: f64| {
        let angle = TAU / 2.0 * t;
        [(reach * angle.cos() * 1e6).round() / 1e6, (0.8 * reach * angle.sin() * 1e6).round() / 1e6]
    };
    let arc = |count: usize| (0..=count).map(|k| at(k as f64 / count as f64)).collect::<Vec<Place>>();
    let mirrored = |places: &[Place]| places.iter().rev().map(|&[x, y]| [x, -y]).collect::<Vec<Place>>();
    let whole = |half: &[Place]| [half, &mirrored(&half[1..half.len() - 1])].concat();
    let (half, fine) = (arc(count), arc(12 * count));
    [half.clone(), whole(&half)].map(|places| {
        let mut file = Writer::begin();
        file.block("A").outline(1, &places, Drawn::Closed);
        for (k, place) in places.iter().enumerate() {
            let is_on_fold = k == 0 || *place == half[count];
            let layers: &[u32] = if !is_on_fold {
                &[3]
            } else if is_smooth {
                &[2, 3]
            } else {
                &[2]
            };
            for &layer in layers {
                file.point(layer, *place, [0.0; 2]);
            }
        }
        if with_fine {
            file.outline(84, &if places.len() == half.len() { fine.clone() } else { whole(&fine) }, Drawn::Closed);
        }
        if places.len() == half.len() {
            file.line(6, [half[0], half[count]]);
        }
        file
    })
}

#[test]
fn a_curve_meets_the_fold_as_on_a_whole_piece() {
    for seed in 0..40 {
        for (is_smooth, with_fine) in [(false, false), (true, false), (false, true), (true, true)] {
            for author in ["AUTHOR: ACCUMARK", "AUTHOR: CLO", "AUTHOR: RICHPEACE"] {
                let mut random = Rng::with_seed(seed);
                let [half, whole] = halves(&mut random, is_smooth, with_fine).map(|mut file| {
                    file.end_block();
                    let source = source(file.end(&["UNITS: METRIC", author]));
                    let (marker, found) = as_read(&source, &Job::default());
                    assert_eq!(found, ["dxf/curves"], "{seed} {author}");
                    assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "{seed} {author}");
                    points(&marker)
                });
                let worst = apart(&half, &whole).max(apart(&whole, &half));
                assert!(worst < 1e-6, "seed {seed}, {author}, smooth {is_smooth}, fine {with_fine}: {worst}");
            }
        }
    }
}

#[test]
fn notches_that_are_drawn_on_the_chords_are_cut_into_the_curve() {
    for seed in 0..40 {
        let mut random = Rng::with_seed(seed);
        let outline = flower(&mut random, 4);
        let fine = drafted(&outline, |knots| natural(knots, 40));
        for with_fine in [true, false] {
            let mut file = Writer::begin();
            file.block("A");
            outline.write(&mut file, 1, Drawn::Closed);
            if with_fine {
                file.outline(84, &fine, Drawn::Closed);
            }
            let mut marks = 0;
            for k in 0..outline.vertices.len() {
                let [a, b] = outline.chord(k);
                if (b[0] - a[0]).hypot(b[1] - a[1]) < 60.0 {
                    continue;
                }
                marks += 1;
                let width = if random.bool() { 4.0 } else { 0.0 };
                file.point(4, [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])], [5.0, width]);
            }
            file.end_block();
            let source = source(file.end(&["UNITS: METRIC", "AUTHOR: CLO"]));
            let (marker, found) = as_read(&source, &Job::default());
            let is_curved = fine.len() > outline.vertices.len();
            assert!(
                found.iter().all(|code| *code == "dxf/curves") && found.len() == usize::from(is_curved),
                "{seed} {found:?}"
            );
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}");
            let cut = points(&marker);
            for notch in &marker.pieces[0].notches {
                assert!(polyline::distance(notch.root, &cut) < 1e-6, "seed {seed}: {:?}", notch.root);
            }
            assert!(marker.pieces[0].notches.len() <= marks);
        }
    }
}

#[test]
fn other_sizes_borrow_the_points_of_the_sample_size() {
    let mut random = Rng::with_seed(11);
    let outline = flower(&mut random, 5);
    let grown = |places: &[Place]| places.iter().map(|place| place.map(|value| 1.1 * value)).collect::<Vec<Place>>();
    let mut file = Writer::begin();
    file.block("A-L")
        .outline(1, &grown(&outline.vertices), Drawn::Closed)
        .text("SIZE: L")
        .text("PIECE NAME: A")
        .end_block();
    file.block("A-M");
    outline.write(&mut file, 1, Drawn::Closed);
    file.text("SIZE: M").text("PIECE NAME: A").end_block();
    let source = source(file.end(&["UNITS: METRIC", "SAMPLE SIZE: M", "AUTHOR: CLO"]));
    let read = |size: &str| {
        let sizes = cutc::machine::patterns::Sizes::parse(size);
        let job = Job { patterns: cutc::machine::patterns::Patterns { sizes, quantity: None }, ..Job::default() };
        let (marker, found) = as_read(&source, &job);
        assert_eq!(found, ["dxf/curves"], "{size}");
        assert_eq!(broken(&source, &marker, &job), [""; 0], "{size}");
        points(&marker)
    };
    let [sample, large] = ["M", "L"].map(read);
    let sample: Vec<Point> = sample.iter().map(|at| at * 1.1).collect();
    let worst = apart(&sample, &large).max(apart(&large, &sample));
    assert!(worst < 0.05, "{worst}"); // chords of 0.02 mm of two curves
}

#[test]
fn a_reader_that_takes_chords_or_loses_a_notch_is_caught() {
    let mut random = Rng::with_seed(5);
    let outline = flower(&mut random, 4);
    let fine = drafted(&outline, |knots| natural(knots, 40));
    for with_fine in [true, false] {
        let mut file = Writer::begin();
        file.block("A");
        outline.write(&mut file, 1, Drawn::Closed);
        if with_fine {
            file.outline(84, &fine, Drawn::Closed);
        }
        for k in 0..outline.vertices.len() {
            let [a, b] = outline.chord(k);
            if (b[0] - a[0]).hypot(b[1] - a[1]) >= 60.0 {
                file.point(4, [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])], [5.0, 0.0]);
            }
        }
        file.end_block();
        let source = source(file.end(&["UNITS: METRIC", "AUTHOR: CLO"]));
        let mut job = Job::default();
        job.profile.dxf.curves = Curves::Points;
        let (chords, _) = as_read(&source, &job);
        assert!(broken(&source, &chords, &Job::default()).contains(&"source/points"), "chords, {with_fine}");
        let (mut lost, _) = as_read(&source, &Job::default());
        assert!(!lost.pieces[0].notches.is_empty());
        lost.pieces[0].notches.pop();
        assert!(broken(&source, &lost, &Job::default()).contains(&"source/notches"), "a lost notch, {with_fine}");
        let (mut moved, _) = as_read(&source, &Job::default());
        moved.pieces[0].notches[0].root.x += 1.5;
        moved.pieces[0].notches[0].root.y += 1.5;
        assert!(broken(&source, &moved, &Job::default()).contains(&"source/notches"), "a moved notch, {with_fine}");
    }
}

/// The curve through a ring of knots from the first one round to it.
fn ring_through(knots: &[Place]) -> Vec<Place> {
    let all = divided(&[knots, knots, knots, &knots[..1]].concat());
    let starts: Vec<usize> = (0..all.len()).filter(|&k| all[k] == knots[0]).collect();
    all[starts[1]..starts[2]].to_vec()
}

/// Whether the curve of the others clearly misses a knot: a curve is within 0.16 mm of these chords.
fn is_needed(knots: &[Place], k: usize) -> bool {
    let others = ring_through(&[&knots[k + 1..], &knots[..k]].concat());
    let chords: Vec<Point> = others.iter().chain(&others[..1]).map(|&place| place.into()).collect();
    polyline::distance(knots[k].into(), &chords) > 0.2
}

/// A smooth ring of curve points without a corner, and its curve as `divided` lays it round and round.
#[derive(Debug, Clone)]
struct Round {
    vertices: Vec<Place>,
    /// Whether a notch is drawn at a vertex.
    is_notched: Vec<bool>,
    curve: Vec<Place>,
}

impl Round {
    /// A blob of `count` knots, with notches on some of them and on vertices between them.
    fn of(random: &mut Rng, count: usize) -> Self {
        let waves = [2.0, 3.0].map(|times: f64| (times, 30.0 * random.f64() / times, TAU * random.f64()));
        let knot = |k: usize| {
            let angle = TAU * (k as f64 + 0.4 * random.f64()) / count as f64;
            let reach =
                110.0 + waves.map(|(times, height, start)| height * (times * angle + start).cos()).iter().sum::<f64>();
            [reach * angle.cos(), reach * angle.sin()]
        };
        let knots: Vec<Place> = (0..count).map(knot).collect();
        let mut round = Self { vertices: Vec::new(), is_notched: Vec::new(), curve: ring_through(&knots) };
        let share = random.u8(4..12);
        let mut last = 0;
        for (k, place) in round.curve.clone().into_iter().enumerate() {
            let of_knots = knots.iter().position(|knot| *knot == place);
            // Some notches are apart, and some have neighbours on the same piece of the curve.
            let is_apart = of_knots.is_some() || k > last + 3 || random.u8(..4) == 0;
            let is_asked = random.u8(..share) == 0 && is_apart;
            let is_notched = is_asked && of_knots.is_none_or(|k| is_needed(&knots, k));
            if of_knots.is_some() || is_notched {
                round.vertices.push(place);
                round.is_notched.push(is_notched);
                last = k;
            }
        }
        round
    }

    fn write(&self, file: &mut Writer) {
        file.outline(1, &self.vertices, Drawn::Closed);
        for (&place, is_notched) in self.vertices.iter().zip(&self.is_notched) {
            file.point(3, place, [0.0; 2]);
            if *is_notched {
                file.point(4, place, [5.0, 0.0]);
            }
        }
    }
}

#[test]
fn a_ring_of_curve_points_with_notches_is_cut_along_its_curve() {
    let mut judged = 0;
    for seed in 0..300 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(12..40);
        let round = Round::of(&mut random, count);
        let mut file = Writer::begin();
        file.block("A");
        round.write(&mut file);
        file.point(13, [0.0; 2], [0.0; 2]).end_block();
        let source = source(file.end(&["UNITS: METRIC", "AUTHOR: ACCUMARK"]));
        let (marker, _) = as_read(&source, &Job::default());
        assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}");
        let cut = points(&marker);
        // The hole is drawn at the origin.
        let by = marker.pieces[0].drills[0].at.coords;
        let moved: Vec<Point> = round.curve.iter().map(|&place| Point::from(place) + by).collect();
        let worst = apart(&moved, &cut);
        // Where half of the vertices are notches, several curves go through all of them.
        let notches = round.is_notched.iter().filter(|is_notched| **is_notched).count();
        let is_judged = notches > 0 && 2 * notches < round.vertices.len();
        assert!(worst < 0.01 || !is_judged, "seed {seed}: {worst}");
        judged += usize::from(is_judged);
    }
    assert!(judged > 200, "{judged}");
}

#[test]
fn a_hundred_round_pieces_are_read() {
    let mut random = Rng::with_seed(1);
    let mut file = Writer::begin();
    for k in 0..100 {
        let round = Round::of(&mut random, 40);
        file.block(&format!("P{k}"));
        round.write(&mut file);
        file.text(&format!("PIECE NAME: P{k}")).end_block();
    }
    let source = source(file.end(&["UNITS: METRIC", "AUTHOR: ACCUMARK"]));
    let (marker, found) = as_read(&source, &Job::default());
    assert_eq!(marker.pieces.len(), 100, "{found:?}");
    assert_eq!(broken(&source, &marker, &Job::default()), [""; 0]);
}
