//! Locking the ends of a seam, so that the thread does not pull out.

use crate::geom::{Point, polyline};
use crate::machine::Sewing;
use crate::machine::sewing::Ends;

/// The needle points of a seam after the first one, with its start and its end locked. The flag is true for points of a lock.
/// Ties lie on `line`, the line of the thread.
pub(super) fn locked(points: &[Point], line: &[Point], [start, end]: [Ends; 2], sewing: &Sewing) -> Vec<(Point, bool)> {
    if points.len() < 2 {
        return Vec::new();
    }
    let mut out = match start {
        Ends::Open => Vec::new(),
        Ends::Tie => tie_in(points, line, sewing),
        Ends::BackTack => {
            // Forwards and back.
            let count = repeated(points, sewing);
            let forwards = points[1..=count].iter().map(|&point| (point, false));
            forwards.chain(points[..count].iter().rev().map(|&point| (point, true))).collect()
        }
    };
    let (last, before) = (points[points.len() - 1], &points[1..points.len() - 1]);
    out.extend(before.iter().map(|&point| (point, false)));
    match end {
        Ends::Open => out.push((last, false)),
        Ends::Tie => out.extend(tie_off(points, line, sewing)),
        Ends::BackTack => {
            // On, back, and forwards again.
            let count = repeated(points, sewing);
            let tail = &points[points.len() - 1 - count..];
            out.push((last, false));
            out.extend(tail[..count].iter().rev().map(|&point| (point, true)));
            out.extend(tail[1..].iter().map(|&point| (point, true)));
        }
    }
    out
}

/// Number of stitches that a back-tack sews again.
fn repeated(points: &[Point], sewing: &Sewing) -> usize {
    (sewing.back_tack_stitches as usize).min(points.len() - 1)
}

/// Short stitches forth and back along the line at the start of a seam.
fn tie_in(points: &[Point], line: &[Point], sewing: &Sewing) -> Vec<(Point, bool)> {
    let first = points[0];
    let head = on_line(line, (points[1] - first).norm(), sewing);
    (0..sewing.tie_stitches).map(|i| (if i.is_multiple_of(2) { head } else { first }, true)).collect()
}

/// The mirror image of a tie at the start; it ends at the end of the seam.
fn tie_off(points: &[Point], line: &[Point], sewing: &Sewing) -> Vec<(Point, bool)> {
    let [before, last] = [2, 1].map(|back| points[points.len() - back]);
    let back: Vec<Point> = line.iter().rev().copied().collect();
    let tail = on_line(&back, (last - before).norm(), sewing);
    let stitches = sewing.tie_stitches;
    let short = (1..=stitches).rev().map(|i| (if i.is_multiple_of(2) { last } else { tail }, i != stitches));
    short.chain([(last, true)]).collect()
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
        let xs: Vec<f64> = locked(&points, &points, [ends; 2], &sewing).iter().map(|(point, _)| point.x).collect();
        assert_eq!(xs, expected);
    }

    #[test]
    fn ends_are_locked_and_needle_points_stay() {
        check(Ends::Open, 3, &[2.0, 4.0, 6.0]);
        check(Ends::Tie, 3, &[0.5, 0.0, 0.5, 2.0, 4.0, 5.5, 6.0, 5.5, 6.0]);
        check(Ends::Tie, 2, &[0.5, 0.0, 2.0, 4.0, 6.0, 5.5, 6.0]);
        check(Ends::BackTack, 3, &[2.0, 4.0, 2.0, 0.0, 2.0, 4.0, 6.0, 4.0, 2.0, 4.0, 6.0]);
        let points: Vec<Point> = [0.0, 2.0, 4.0].iter().map(|&x| Point::new(x, 0.0)).collect();
        let sewing = Sewing { tie_mm: 0.5, tie_stitches: 2, back_tack_stitches: 1, ..Sewing::default() };
        let mixed = locked(&points, &points, [Ends::BackTack, Ends::Tie], &sewing);
        assert_eq!(mixed.iter().map(|(point, _)| point.x).collect::<Vec<_>>(), [2.0, 0.0, 2.0, 4.0, 3.5, 4.0]);
    }
}
