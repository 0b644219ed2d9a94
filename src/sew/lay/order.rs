//! Order of the seams: by their numbers, then that of the file, or one with little travel.
//!
//! Threads keep their order, a stop stays before its seam, and no seam is reversed: upper and lower thread form different sides
//! of a stitch, which depend on the sewing direction.

use crate::geom::Point;
use crate::machine::Sewing;
use crate::machine::sewing::SeamOrder;
use crate::sew::pattern::{Pattern, Seam};

/// Maximum number of seams for which the nearest-neighbour order is improved; each round takes quadratic time.
const BETTERED: usize = 2000;
/// Maximum number of improvement rounds; later ones gain little.
const ROUNDS: usize = 40;
/// Minimum gain of a change, mm, so that rounding cannot cause a cycle.
const GAIN_EPSILON: f64 = 1e-6;

/// The seams in sewing order.
pub(super) fn order<'p>(pattern: &'p Pattern, sewing: &Sewing) -> Vec<&'p Seam> {
    let mut seams: Vec<&Seam> = pattern.seams.iter().filter(|seam| !seam.points.is_empty()).collect();
    // A stable sort: seams of one number, and those without, keep the order of the file.
    seams.sort_by_key(|seam| turn(seam));
    match sewing.order {
        SeamOrder::File => seams,
        SeamOrder::Travel => {
            let mut at = Point::origin();
            let mut out = Vec::with_capacity(seams.len());
            for group in seams.chunk_by(|a, b| a.thread == b.thread && !b.stop && a.order == b.order) {
                // A stop belongs before the first seam of its group.
                let (fixed, free) = group.split_at(usize::from(group[0].stop));
                out.extend_from_slice(fixed);
                at = fixed.first().map_or(at, |seam| end(seam));
                let group = shortest(free, at);
                at = group.last().map_or(at, |seam| end(seam));
                out.extend(group);
            }
            out
        }
    }
}

/// Key of the sewing order: seams without a number are last.
fn turn(seam: &Seam) -> (bool, Option<u16>) {
    (seam.order.is_none(), seam.order)
}

fn end(seam: &Seam) -> Point {
    seam.points[seam.points.len() - 1]
}

fn way(from: Point, to: Point) -> f64 {
    (to - from).norm()
}

/// Nearest-neighbour order, then each seam is moved to its cheapest position.
fn shortest<'p>(seams: &[&'p Seam], start: Point) -> Vec<&'p Seam> {
    let mut left = seams.to_vec();
    let mut out = Vec::with_capacity(left.len());
    let mut at = start;
    while !left.is_empty() {
        let distance = |i: &usize| way(at, left[*i].points[0]);
        let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("some are left");
        // `remove` keeps the order of the others, so the first of equally near seams is taken.
        let seam = left.remove(nearest);
        at = end(seam);
        out.push(seam);
    }
    if out.len() <= BETTERED {
        for _ in 0..ROUNDS {
            if !better(&mut out, start) {
                break;
            }
        }
    }
    out
}

/// Moves each seam to its cheapest position; true if any was moved.
fn better(seams: &mut Vec<&Seam>, start: Point) -> bool {
    let mut is_moved = false;
    for from in 0..seams.len() {
        let before = |seams: &[&Seam], i: usize| if i == 0 { start } else { end(seams[i - 1]) };
        let seam = seams[from];
        let entered = way(before(seams, from), seam.points[0]);
        let left = seams
            .get(from + 1)
            .map_or((0.0, 0.0), |next| (way(end(seam), next.points[0]), way(before(seams, from), next.points[0])));
        let spared = entered + left.0 - left.1;
        let rest: Vec<&Seam> = seams.iter().enumerate().filter(|(i, _)| *i != from).map(|(_, seam)| *seam).collect();
        let cost = |to: usize| {
            let behind = rest
                .get(to)
                .map_or(0.0, |next| way(end(seam), next.points[0]) - way(before(&rest, to), next.points[0]));
            way(before(&rest, to), seam.points[0]) + behind
        };
        let best = (0..=rest.len()).min_by(|a, b| cost(*a).total_cmp(&cost(*b))).expect("there is a place");
        if best != from && cost(best) < spared - GAIN_EPSILON {
            *seams = rest;
            seams.insert(best, seam);
            is_moved = true;
        }
    }
    is_moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn starts(rows: &[(f64, u16, bool)], order: SeamOrder) -> Vec<f64> {
        let seam = |&(x, thread, stop): &(f64, u16, bool)| Seam {
            thread,
            stop,
            ..Seam::plain(vec![Point::new(x, 0.0), Point::new(x + 1.0, 0.0)], Span::default())
        };
        let pattern = Pattern { seams: rows.iter().map(seam).collect() };
        super::order(&pattern, &Sewing { order, ..Sewing::default() }).iter().map(|seam| seam.points[0].x).collect()
    }

    #[test]
    fn a_short_way_keeps_threads_stops_and_directions() {
        let plain = [(9.0, 1, false), (0.0, 1, false), (5.0, 1, false)];
        assert_eq!(starts(&plain, SeamOrder::File), [9.0, 0.0, 5.0]);
        assert_eq!(starts(&plain, SeamOrder::Travel), [0.0, 5.0, 9.0]);
        let threads = [(9.0, 1, false), (0.0, 1, false), (1.0, 2, false), (3.0, 2, true), (2.0, 2, false)];
        assert_eq!(starts(&threads, SeamOrder::Travel), [0.0, 9.0, 1.0, 3.0, 2.0]);
    }

    #[test]
    fn numbered_seams_are_sewn_first_in_either_order() {
        let seam = |(x, order): (f64, Option<u16>)| Seam {
            order,
            ..Seam::plain(vec![Point::new(x, 0.0), Point::new(x + 1.0, 0.0)], Span::default())
        };
        let rows = [(0.0, None), (9.0, Some(2)), (4.0, Some(2)), (7.0, Some(1))];
        let pattern = Pattern { seams: rows.into_iter().map(seam).collect() };
        let starts = |order: SeamOrder| -> Vec<f64> {
            let sewing = Sewing { order, ..Sewing::default() };
            super::order(&pattern, &sewing).iter().map(|seam| seam.points[0].x).collect()
        };
        assert_eq!(starts(SeamOrder::File), [7.0, 9.0, 4.0, 0.0]);
        assert_eq!(starts(SeamOrder::Travel), [7.0, 9.0, 4.0, 0.0]);
    }
}
