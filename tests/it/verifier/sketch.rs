//! Changes of a marker, and the programs of what comes out.

use cutc::geom::{Point, Vector, angle};
use cutc::ir::Marker;
use cutc::ir::list::{FULL_SPEED, Joint, Segment};
use cutc::ir::marker::{Contour, Drill, Notch, Piece};
use cutc::source::Span;

use crate::verifier::case::Case;
use crate::verifier::rows::pick;

/// The program of a changed marker.
pub(crate) fn edited(case: &Case, change: impl FnOnce(&mut Marker)) -> Vec<u8> {
    let mut marker = case.marker.clone();
    change(&mut marker);
    case.redrawn(&marker)
}

/// The program of a marker whose every point is another.
pub(crate) fn all(case: &Case, map: impl Fn(Point) -> Point) -> Vec<u8> {
    case.redrawn(&mapped(&case.marker, |_, point| map(point)))
}

pub(crate) fn mapped(marker: &Marker, map: impl Fn(usize, Point) -> Point) -> Marker {
    let mut mapped = marker.clone();
    for (piece, contour) in contours(marker) {
        let segments = chain(marker, marker.pieces[piece].contours[contour]).into_iter();
        let moved = segments.map(|s| Segment { from: map(piece, s.from), to: map(piece, s.to), ..s }).collect();
        redraw(&mut mapped, [piece, contour], moved);
    }
    for (i, piece) in mapped.pieces.iter_mut().enumerate() {
        for notch in &mut piece.notches {
            (notch.root, notch.tip) = (map(i, notch.root), map(i, notch.tip));
        }
        piece.drills.iter_mut().for_each(|drill| drill.at = map(i, drill.at));
    }
    mapped
}

/// All contours: the index of the piece, and among its contours.
pub(crate) fn contours(marker: &Marker) -> Vec<(usize, usize)> {
    indices(marker, |piece| piece.contours.len())
}

/// All slits, in the same way.
pub(crate) fn notches(marker: &Marker) -> Vec<(usize, usize)> {
    indices(marker, |piece| piece.notches.len())
}

fn indices(marker: &Marker, count: impl Fn(&Piece) -> usize) -> Vec<(usize, usize)> {
    marker.pieces.iter().enumerate().flat_map(|(i, piece)| (0..count(piece)).map(move |k| (i, k))).collect()
}

pub(crate) fn chain(marker: &Marker, contour: Contour) -> Vec<Segment> {
    marker.list.walk(contour.range).map(|(_, segment)| segment).collect()
}

/// All segments of all contours.
pub(crate) fn segments(marker: &Marker) -> Vec<Segment> {
    marker.contours().flat_map(|(_, contour)| chain(marker, *contour)).collect()
}

/// The longest segment of some.
pub(crate) fn longest(segments: &[Segment]) -> Option<Segment> {
    segments.iter().max_by(|a, b| a.length().total_cmp(&b.length())).copied()
}

/// Gives a contour other segments.
pub(crate) fn redraw(marker: &mut Marker, [piece, contour]: [usize; 2], segments: Vec<Segment>) {
    let closed = segments[0].from == segments[segments.len() - 1].to;
    let range = marker.list.append(segments).expect("a contour has segments");
    marker.pieces[piece].contours[contour] = Contour { range, closed };
}

/// Adds an open contour to the last piece.
pub(crate) fn add(marker: &mut Marker, points: &[Point]) {
    let segment = |w: &[Point]| Segment {
        from: w[0],
        to: w[1],
        span: Span::default(),
        joint: Joint::default(),
        percent: FULL_SPEED,
    };
    let range = marker.list.append(points.windows(2).map(segment)).expect("two points or more");
    let last = marker.pieces.last_mut().expect("a marker has pieces");
    last.contours.push(Contour { range, closed: false });
}

pub(crate) fn along(notch: &Notch) -> Vector {
    (notch.tip - notch.root).normalize()
}

/// A slit, and the program with it changed.
pub(crate) fn slit(case: &Case, rng: &mut fastrand::Rng, change: impl FnOnce(&mut Notch)) -> Option<(Notch, Vec<u8>)> {
    let (piece, notch) = pick(rng, &notches(&case.marker))?;
    let program = edited(case, |marker| change(&mut marker.pieces[piece].notches[notch]));
    Some((case.marker.pieces[piece].notches[notch], program))
}

/// A hole, and the program with the holes of its piece changed.
pub(crate) fn drill(
    case: &Case,
    rng: &mut fastrand::Rng,
    change: impl FnOnce(&mut Vec<Drill>, usize),
) -> Option<(Drill, Vec<u8>)> {
    let (piece, drill) = pick(rng, &indices(&case.marker, |piece| piece.drills.len()))?;
    let program = edited(case, |marker| change(&mut marker.pieces[piece].drills, drill));
    Some((case.marker.pieces[piece].drills[drill], program))
}

/// Absolute turn of a closed contour where a segment starts, rad.
pub(crate) fn turn(segments: &[Segment], i: usize) -> f64 {
    let count = segments.len();
    let (before, behind) = (&segments[(i + count - 1) % count], &segments[i % count]);
    angle::turn(before.to - before.from, behind.to - behind.from).abs()
}

pub(crate) fn midpoint(a: Point, b: Point) -> Point {
    a + (b - a) * 0.5
}
