//! What a program does, measured here and not by the verifier, and what the profile allows.

use std::ops::Range;

use cutc::geom::{Extent, Point, angle, polyline};
use cutc::ir::Marker;
use cutc::machine::Follow;

use crate::verifier::case::Case;
use crate::verifier::rows::{Row, strokes};
use crate::verifier::sketch::{chain, turn};

/// Half of the last decimal of a printed number: mm, degrees, s.
pub(crate) const ROUNDING: f64 = 0.5e-6;
/// Two printed numbers of one value may differ by this, mm and degrees: what "at rest" allows.
pub(crate) const SAME: f64 = 2.0 * ROUNDING;
/// What a damage breaks its limit by.
pub(crate) const DAMAGING: f64 = 3.0;
/// What a damage that must be allowed takes of its limit.
pub(crate) const HARMLESS: f64 = 1.0 / 3.0;
/// A stroke that lies farther than this from a line is none of it, mm.
pub(crate) const STROKE_REACH: f64 = 2.0;
/// A hole that lies farther than this from a place is another hole, mm.
pub(crate) const HOLE_REACH: f64 = 5.0;

/// Way of the tip from row to row that shows a direction to a hundredth of a degree, mm.
const CLEAR_WAY: f64 = 0.02;

/// Limit of the difference of an order of an axis, in mm or degrees per s to the power of the order.
pub(crate) fn axis_limit(case: &Case, axis: usize, order: u8) -> f64 {
    let limits = case.job.profile.axes.limits()[axis];
    let limit = [limits.speed, limits.acceleration, limits.jerk][usize::from(order) - 1];
    if axis == 2 { limit.to_degrees() } else { limit }
}

/// What rounding can add to a difference of an order.
pub(crate) fn axis_rounding(case: &Case, order: u8) -> f64 {
    ROUNDING * (2.0 / case.job.profile.time.period()).powi(i32::from(order))
}

/// The amount that a damage of an axis must reach.
pub(crate) fn axis_amount(case: &Case, axis: usize, order: u8) -> f64 {
    DAMAGING * axis_limit(case, axis, order) + axis_rounding(case, order)
}

/// Absolute difference quotients of an axis, of the order, behind each row and three rows of rest behind the last one.
pub(crate) fn differences(poses: impl Iterator<Item = f64>, order: u8, period: f64) -> Vec<f64> {
    let mut values: Vec<f64> = poses.collect();
    let last = *values.last().expect("a program has rows");
    values.extend([last; 3]);
    for _ in 0..order {
        let mut before = values[0];
        for value in &mut values {
            (*value, before) = (*value - before, *value);
        }
    }
    values.iter().map(|difference| difference.abs() / period.powi(i32::from(order))).collect()
}

/// Greatest difference quotient of an axis in a program.
pub(crate) fn greatest(case: &Case, rows: &[Row], axis: usize, order: u8) -> f64 {
    let quotients = differences(rows.iter().map(|row| row.pose[axis]), order, case.job.profile.time.period());
    quotients.into_iter().fold(0.0, f64::max)
}

/// Greatest speed of the tip with the knife down, mm/s.
pub(crate) fn feed(case: &Case, rows: &[Row]) -> f64 {
    let knife = &case.job.profile.knife;
    let cuts = rows.windows(2).filter(|w| w[0].knife == 1);
    let ways = cuts.map(|w| (w[1].tip(knife) - w[0].tip(knife)).norm());
    ways.fold(0.0, f64::max) / case.job.profile.time.period()
}

/// Greatest angle between the blade and the way of its tip, degrees, where that way is clear and the blade no longer
/// lies as it plunged.
pub(crate) fn heading_error(case: &Case, rows: &[Row]) -> f64 {
    let knife = &case.job.profile.knife;
    let mut worst = 0.0_f64;
    for stroke in strokes(rows) {
        let tips: Vec<Point> = rows[stroke.clone()].iter().map(|row| row.tip(knife)).collect();
        if knife.follow == Follow::Chord {
            worst = worst.max(chord_error(&rows[stroke], &tips, knife.width_mm));
            continue;
        }
        let mut way = 0.0;
        for (i, w) in tips.windows(3).enumerate() {
            way += (w[1] - w[0]).norm();
            let is_clear = (w[1] - w[0]).norm().min((w[2] - w[1]).norm()) > CLEAR_WAY;
            if way > knife.width_mm && is_clear {
                let along = w[2] - w[0];
                let off = angle::wrap(along.y.atan2(along.x) - rows[stroke.start + i + 1].pose[2].to_radians());
                worst = worst.max(off.abs().to_degrees());
            }
        }
    }
    worst
}

/// The greatest angle between the blade and the chord to the last tip that is a width away, degrees: between two rows the
/// tip goes less than would turn that by what is read anyway.
fn chord_error(rows: &[Row], tips: &[Point], width: f64) -> f64 {
    let error = |(i, row): (usize, &Row)| {
        let tail = (0..i).rev().find(|&k| (tips[k] - tips[i]).norm() >= width)?;
        // From the tip before to the one behind, at the place where the distance is the width.
        let (far, near) = ((tips[tail] - tips[i]).norm(), (tips[tail + 1] - tips[i]).norm());
        let at = tips[tail] + (tips[tail + 1] - tips[tail]) * ((far - width) / (far - near));
        let chord = tips[i] - at;
        Some(angle::wrap(chord.y.atan2(chord.x) - row.pose[2].to_radians()).abs().to_degrees())
    };
    rows.iter().enumerate().filter_map(error).fold(0.0, f64::max)
}

/// Distance of a point from the nearest line of a marker, mm.
pub(crate) fn distance(marker: &Marker, point: Point) -> f64 {
    let chords =
        marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range)).map(|(_, s)| (s.from, s.to));
    let slits = marker.pieces.iter().flat_map(|piece| &piece.notches).map(|notch| (notch.root, notch.tip));
    chords.chain(slits).map(|(a, b)| polyline::distance_to_segment(point, a, b)).fold(f64::INFINITY, f64::min)
}

/// Farthest that the blade passes by a bend of a contour, mm: at a vertex the tolerance band is as wide as the tolerance.
pub(crate) fn passed_by(case: &Case, rows: &[Row]) -> f64 {
    let knife = &case.job.profile.knife;
    // The blade's body cuts where it plunges, then its tip.
    let track = |stroke: Range<usize>| {
        let mut extent = Extent::EMPTY;
        let mut places = vec![rows[stroke.start].tail(knife)];
        places.extend(rows[stroke].iter().map(|row| row.tip(knife)));
        places.dedup();
        for place in &places {
            extent.add(*place);
        }
        (extent, places)
    };
    let tracks: Vec<(Extent, Vec<Point>)> = strokes(rows).into_iter().map(track).collect();
    let nearest = |vertex: Point| {
        let is_near = |Extent { min, max }: &Extent| {
            let outside = [min.x - vertex.x, vertex.x - max.x, min.y - vertex.y, vertex.y - max.y];
            outside.iter().all(|outside| *outside < STROKE_REACH)
        };
        let near = tracks.iter().filter(|(extent, _)| is_near(extent)).flat_map(|(_, places)| places.windows(2));
        near.map(|w| (polyline::distance_to_segment(vertex, w[0], w[1]), w)).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut worst = 0.0_f64;
    for (_, contour) in case.marker.contours() {
        let segments = chain(&case.marker, *contour);
        let is_bend = |i: &usize| turn(&segments, *i) < case.job.profile.corner_angle();
        // A way passes on the inside of the bend, where the lines are nearer than the vertex. The verifier judges the places
        // that it reads: the straight line between two of them passes farther inside than either.
        let passed = |i: usize| {
            nearest(segments[i].from).map_or(f64::INFINITY, |(away, places)| {
                let read = places.iter().map(|place| distance(&case.marker, *place)).fold(0.0, f64::max);
                read.min(away * (0.5 * turn(&segments, i)).cos())
            })
        };
        worst = (1..segments.len()).filter(is_bend).map(passed).fold(worst, f64::max);
    }
    worst
}

/// How far beyond an end of a line the blade may cut, mm: the overlap and the tolerance.
pub(crate) fn overlap_limit(case: &Case) -> f64 {
    let knife = &case.job.profile.knife;
    let overlaps =
        [knife.front_overlap_mm, knife.corner_front_overlap_mm, knife.heel_overlap_mm, knife.corner_heel_overlap_mm];
    overlaps.into_iter().fold(0.0, f64::max) + case.tolerance()
}

/// How much may be cut twice, mm: the overlaps of an end and the tolerance on both sides.
pub(crate) fn once_limit(case: &Case) -> f64 {
    let knife = &case.job.profile.knife;
    let front = knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
    let heel = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm);
    front + heel + 2.0 * case.tolerance()
}
