//! Locking the ends of a seam, so that the thread does not pull out.

use crate::geom::{Point, polyline};
use crate::machine::Sewing;
use crate::machine::sewing::Ends;

/// The needle points of a seam after the first one, with its ends locked. The flag is true for points of a lock. Ties lie on
/// `line`, the line of the thread.
pub(super) fn locked(points: &[Point], line: &[Point], ends: Ends, sewing: &Sewing) -> Vec<(Point, bool)> {
    let plain = |points: &[Point]| points.iter().map(|&point| (point, false)).collect::<Vec<_>>();
    let [first, rest @ ..] = points else { return Vec::new() };
    if rest.is_empty() {
        return Vec::new();
    }
    match ends {
        Ends::Open => plain(rest),
        Ends::Tie => tied((*first, rest), line, sewing),
        Ends::BackTack => {
            let count = (sewing.back_tack_stitches as usize).min(rest.len());
            // At the start: forwards, back, and on; at the end: on, back, and forwards again.
            let mut out = plain(&points[1..=count]);
            out.extend(points[..count].iter().rev().map(|&point| (point, true)));
            out.extend(plain(rest));
            let tail = &points[points.len() - 1 - count..];
            out.extend(tail[..count].iter().rev().map(|&point| (point, true)));
            out.extend(tail[1..].iter().map(|&point| (point, true)));
            out
        }
    }
}

/// A seam with short stitches back and forth along the line at its ends; its own needle points stay.
fn tied((first, rest): (Point, &[Point]), line: &[Point], sewing: &Sewing) -> Vec<(Point, bool)> {
    let last = rest[rest.len() - 1];
    let before = if rest.len() > 1 { rest[rest.len() - 2] } else { first };
    let head = on_line(line, (rest[0] - first).norm(), sewing);
    let back: Vec<Point> = line.iter().rev().copied().collect();
    let tail = on_line(&back, (last - before).norm(), sewing);
    let stitches = sewing.tie_stitches;
    let mut out: Vec<(Point, bool)> =
        (0..stitches).map(|i| (if i.is_multiple_of(2) { head } else { first }, true)).collect();
    out.extend(rest[..rest.len() - 1].iter().map(|&point| (point, false)));
    // The mirror image of the start; it ends at the end of the seam.
    out.extend((1..=stitches).rev().map(|i| (if i.is_multiple_of(2) { last } else { tail }, i != stitches)));
    out.push((last, true));
    out
}

/// Point of a tie along a line from its start; at most half way to the next needle point if that is near. `pitch` is the
/// distance of that point, mm.
fn on_line(line: &[Point], pitch: f64, sewing: &Sewing) -> Point {
    let room = (pitch - sewing.min_pitch_mm).max(pitch / 2.0);
    polyline::place(line, &polyline::stations(line), sewing.tie_mm.min(room))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(ends: Ends, stitches: u32, expected: &[f64]) {
        let points: Vec<Point> = [0.0, 2.0, 4.0, 6.0].iter().map(|&x| Point::new(x, 0.0)).collect();
        let sewing = Sewing { tie_mm: 0.5, tie_stitches: stitches, back_tack_stitches: 2, ..Sewing::default() };
        let xs: Vec<f64> = locked(&points, &points, ends, &sewing).iter().map(|(point, _)| point.x).collect();
        assert_eq!(xs, expected);
    }

    #[test]
    fn ends_are_locked_and_needle_points_stay() {
        check(Ends::Open, 3, &[2.0, 4.0, 6.0]);
        check(Ends::Tie, 3, &[0.5, 0.0, 0.5, 2.0, 4.0, 5.5, 6.0, 5.5, 6.0]);
        check(Ends::Tie, 2, &[0.5, 0.0, 2.0, 4.0, 6.0, 5.5, 6.0]);
        check(Ends::BackTack, 3, &[2.0, 4.0, 2.0, 0.0, 2.0, 4.0, 6.0, 4.0, 2.0, 4.0, 6.0]);
    }
}
