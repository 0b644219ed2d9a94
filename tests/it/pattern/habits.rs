//! A piece is the same however its lines are drawn, and half of it is as good as the whole.

use cutc::ir::Marker;
use cutc::machine::Job;
use fastrand::Rng;

use super::audit::broken;
use super::writer::{Drawn, Place, Writer};
use super::{as_read, fixtures, source};

/// How far two ways of drawing may differ, mm: rounding.
const SAME: f64 = 1e-9;

fn same(a: Place, b: Place) -> bool {
    (a[0] - b[0]).abs() <= SAME && (a[1] - b[1]).abs() <= SAME
}

/// A star about the origin of so many corners, from one angle to another.
fn star(random: &mut Rng, count: usize, [from, to]: [f64; 2]) -> Vec<Place> {
    let corner = |k: usize| {
        let angle = (from + (to - from) * (k as f64 + 0.5) / count as f64).to_radians();
        let reach = 120.0 + 60.0 * random.f64();
        [angle.cos(), angle.sin()].map(|share| (reach * share * 1000.0).round() / 1000.0)
    };
    (0..count).map(corner).collect()
}

/// The corners of the contours, each from its least corner on, counter-clockwise or not as drawn.
fn rings(marker: &Marker) -> Vec<Vec<Place>> {
    let ring = |(_, contour): (usize, &cutc::ir::marker::Contour)| {
        assert!(contour.closed);
        let mut points: Vec<Place> = marker.points(contour).iter().skip(1).map(|point| [point.x, point.y]).collect();
        let key = |place: &Place| place.map(|value| (value * 1e6).round() as i64);
        let least = (0..points.len()).min_by_key(|&k| key(&points[k])).expect("corners");
        points.rotate_left(least);
        let [next, last] = [key(&points[1]), key(&points[points.len() - 1])];
        if last < next {
            points[1..].reverse();
        }
        points
    };
    marker.contours().map(ring).collect()
}

fn slits(marker: &Marker) -> Vec<[Place; 2]> {
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches);
    let mut slits: Vec<[Place; 2]> = notches.map(|n| [[n.root.x, n.root.y], [n.tip.x, n.tip.y]]).collect();
    slits.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]).then(a[0][1].total_cmp(&b[0][1])));
    slits
}

fn assert_same(a: &Marker, b: &Marker, what: &str) {
    let (one, other) = (rings(a), rings(b));
    assert_eq!(one.len(), other.len(), "{what}");
    for (one, other) in one.iter().zip(&other) {
        let is_same = one.len() == other.len() && one.iter().zip(other).all(|(p, q)| same(*p, *q));
        assert!(is_same, "{what}: {one:?} {other:?}");
    }
    let (one, other) = (slits(a), slits(b));
    let is_same = |(p, q): (&[Place; 2], &[Place; 2])| same(p[0], q[0]) && same(p[1], q[1]);
    assert!(one.len() == other.len() && one.iter().zip(&other).all(is_same), "{what}: {one:?} {other:?}");
}

#[test]
fn an_outline_is_the_same_in_every_way_of_drawing_it() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(5..40);
        let places = star(&mut random, count, [0.0, 360.0]);
        let mut first: Option<Marker> = None;
        for drawn in Drawn::ALL {
            let mut file = Writer::begin();
            file.block("A").outline(1, &places, drawn).point(4, places[2], [5.0, 0.0]).end_block();
            let (marker, found) = as_read(&source(file.end(&["UNITS: METRIC"])), &Job::default());
            assert!(found.is_empty(), "{seed} {drawn:?}: {found:?}");
            assert_eq!(marker.pieces[0].notches.len(), 1, "{seed} {drawn:?}");
            match &first {
                Some(first) => assert_same(first, &marker, &format!("seed {seed}, {drawn:?}")),
                None => first = Some(marker),
            }
        }
    }
}

/// The same on the other side of the X axis.
fn mirrored(places: &[Place]) -> Vec<Place> {
    places.iter().rev().map(|&[x, y]| [x, -y]).collect()
}

#[test]
fn half_a_piece_is_the_whole_of_it_wherever_its_fold_line_lies() {
    for seed in 0..60 {
        let mut random = Rng::with_seed(seed);
        let (count, slits) = (random.usize(3..20), random.usize(0..3));
        let arc = star(&mut random, count, [0.0, 180.0]);
        let half = [&[[150.0, 0.0]], &arc[..], &[[-140.0, 0.0]]].concat();
        let whole = [&half[..], &mirrored(&half[1..half.len() - 1])].concat();
        let hole = [[-20.0, 20.0], [0.0, 20.0], [0.0, 40.0]];
        let mut files = [Writer::begin(), Writer::begin()];
        let [halved, drawn] = &mut files;
        let way = Drawn::ALL[seed as usize % Drawn::ALL.len()];
        halved.block("A").outline(1, &half, way).line(6, [half[0], half[half.len() - 1]]);
        halved.outline(11, &hole, Drawn::Closed).point(13, [30.0, 30.0], [0.0; 2]).point(13, [40.0, 0.0], [0.0; 2]);
        drawn.block("A").outline(1, &whole, Drawn::Closed);
        drawn.outline(11, &hole, Drawn::Closed).outline(11, &mirrored(&hole), Drawn::Closed);
        for &[x, y] in arc.iter().take(slits) {
            halved.point(4, [x, y], [4.0, 0.0]);
            drawn.point(4, [x, y], [4.0, 0.0]).point(4, [x, -y], [4.0, 0.0]);
        }
        let [halved, drawn] = files.map(|mut file| {
            file.end_block();
            as_read(&source(file.end(&["UNITS: METRIC"])), &Job::default())
        });
        assert!(halved.1.is_empty() && drawn.1.is_empty(), "seed {seed}: {:?} {:?}", halved.1, drawn.1);
        assert_same(&halved.0, &drawn.0, &format!("seed {seed}, {way:?}"));
        assert_eq!(halved.0.pieces[0].drills.len(), 3);
    }
}

#[test]
fn what_is_on_a_layer_that_is_not_cut_changes_nothing() {
    let square = [[0.0, 0.0], [200.0, 0.0], [200.0, 100.0], [0.0, 100.0]];
    let cut = |layers: &[u32]| {
        let mut file = Writer::begin();
        file.block("A").outline(1, &square, Drawn::Closed);
        for &layer in layers {
            file.outline(layer, &[[10.0, 10.0], [90.0, 20.0], [50.0, 90.0]], Drawn::Closed);
        }
        file.end_block();
        as_read(&source(file.end(&["UNITS: METRIC"])), &Job::default())
    };
    let (plain, _) = cut(&[]);
    for layer in (0..100).filter(|layer| ![1, 6, 11].contains(layer)) {
        let (marker, found) = cut(&[layer]);
        assert_same(&plain, &marker, &format!("layer {layer}"));
        // Where points have a meaning, a line is one that would be missing.
        let is_told = matches!(layer, 2..=4 | 13 | 80..=83);
        let told = match layer {
            84 => vec!["dxf/curve-missed"],
            _ if is_told => vec!["dxf/line-not-cut"],
            _ => vec![],
        };
        assert_eq!(found, told, "layer {layer}");
    }
    assert_eq!(cut(&[11]).0.contours().count(), 2);
}

#[test]
fn a_file_whose_lines_end_with_carriage_returns_is_the_same() {
    for (path, bytes) in fixtures().into_iter().filter(|(_, bytes)| bytes.contains(&b'\n')) {
        let returns: Vec<u8> = bytes.iter().filter(|&&byte| byte != b'\r').copied().collect();
        let returns: Vec<u8> = returns.into_iter().map(|byte| if byte == b'\n' { b'\r' } else { byte }).collect();
        let [(marker, found), (other, of_other)] =
            [bytes, returns.clone()].map(|bytes| as_read(&source(bytes), &Job::default()));
        let lines = |marker: &Marker| marker.contours().map(|(_, contour)| marker.points(contour)).collect::<Vec<_>>();
        assert_eq!((lines(&other), of_other), (lines(&marker), found), "{}", path.display());
        assert_eq!(broken(&source(returns), &other, &Job::default()), [""; 0], "{}", path.display());
    }
}

#[test]
fn a_point_that_marks_a_drawn_notch_changes_nothing() {
    let mut random = Rng::with_seed(4);
    for _ in 0..60 {
        let tenths = |low: i32, high: i32, random: &mut Rng| f64::from(random.i32(low..=high)) / 10.0;
        let (x, depth) = (tenths(300, 1700, &mut random), tenths(20, 120, &mut random));
        let half = [0.0, tenths(10, 60, &mut random)][random.usize(0..2)];
        let is_castle = half > 0.0 && random.bool();
        let inner = if is_castle { half } else { 0.0 };
        let notch = [[x - half, 0.0], [x - inner, depth], [x + inner, depth], [x + half, 0.0]];
        let at = [[x, 0.0], [x, depth]][random.usize(0..2)];
        let cut = |is_marked: bool| {
            let mut places = vec![[0.0, 0.0]];
            places.extend(notch);
            places.extend([[200.0, 0.0], [200.0, 100.0], [0.0, 100.0]]);
            places.dedup();
            let mut file = Writer::begin();
            file.block("A").outline(1, &places, Drawn::Closed);
            if is_marked {
                file.point(4, at, [depth, 2.0 * half]);
            }
            file.end_block();
            as_read(&source(file.end(&["UNITS: METRIC"])), &Job::default())
        };
        let [(drawn, _), (marked, told)] = [cut(false), cut(true)];
        let what = format!("{half} wide, {depth} deep at {x}, marked at {at:?}");
        assert_same(&drawn, &marked, &what);
        assert_eq!(told, ["dxf/notch-drawn"], "{what}");
    }
}

#[test]
fn notches_of_an_outline_that_lean_touch_or_stand_at_a_corner_are_counted() {
    let mut random = Rng::with_seed(44);
    for case in 0..40 {
        let lean = -0.7 + 1.4 * random.f64();
        let (sine, cosine) = lean.sin_cos();
        // A castle of 4 by 7 mm whose walls the edge cuts off askew, and two V of 4 by 6 mm that lean.
        let half = 2.0 / cosine;
        let bottom = |x: f64| [40.0 + 7.0 * sine + x * cosine, 7.0 * cosine - x * sine];
        let castle = [[40.0 - half, 0.0], bottom(-2.0), bottom(2.0), [40.0 + half, 0.0]];
        let tip = |x: f64| [x + 6.0 * sine, 6.0 * cosine];
        let touching = [[98.0, 0.0], tip(100.0), [102.0, 0.0], tip(104.0), [106.0, 0.0]];
        let corner = [[197.0, 0.0], [196.0, 4.0], [200.0, 3.0], [200.0, 150.0], [0.0, 150.0], [0.0, 0.0]];
        let ring: Vec<Place> = castle.into_iter().chain(touching).chain(corner).collect();
        for drawn in Drawn::ALL {
            let mut file = Writer::begin();
            file.block("A").text("PIECE NAME: A").text("SIZE: M").outline(1, &ring, drawn).end_block();
            let source = source(file.end(&["UNITS: METRIC", "SAMPLE SIZE: M"]));
            let mut found = cutc::diagnostic::Diagnostics::default();
            let read = cutc::pipeline::read(&source, cutc::front::by_name("pattern"), &Job::default(), &mut found);
            let marker = read.expect("a pattern").marker;
            let mut words: Vec<&str> =
                marker.pieces[0].outline_notches.iter().map(cutc::ir::marker::OutlineNotch::word).collect();
            words.sort_unstable();
            assert_eq!(words, ["castle", "v", "v", "v"], "case {case}, lean {lean}, {drawn:?}");
        }
    }
}
