//! In which order the open cuts of a line are made that has edges in common with others: the file says none.

use crate::analysis::air::{Air, Stop};
use crate::ir::list::Segment;

/// Of more cuts only the nearest comes next each time; what follows from that is left.
const MOST_IMPROVED: usize = 200;
/// Gains that are less are none, s: the few tenths of a millimetre by which edges in common lie apart decide nothing.
const LEAST_GAIN: f64 = 5e-3;

/// An order of cuts with little travel from a place on, by their places among the given ones.
pub(super) fn sequence(cuts: &[Vec<Segment>], from: Stop, air: &Air) -> Vec<usize> {
    let ends = cuts.iter().map(|cut| {
        let (first, last) = (cut[0], cut[cut.len() - 1]);
        [air.down(first.from, first.to), air.up(last.from, last.to)]
    });
    let ends: Vec<[Stop; 2]> = ends.collect();
    let mut order = nearest_next(&ends, from, air);
    if order.len() <= MOST_IMPROVED {
        improve(&mut order, &ends, from, air);
    }
    order
}

fn nearest_next(ends: &[[Stop; 2]], mut from: Stop, air: &Air) -> Vec<usize> {
    let mut left: Vec<usize> = (0..ends.len()).collect();
    let mut order = Vec::with_capacity(ends.len());
    while !left.is_empty() {
        let times: Vec<f64> = left.iter().map(|&cut| air.time(&from, &ends[cut][0])).collect();
        let least = times.iter().copied().fold(f64::INFINITY, f64::min);
        let next = times.iter().position(|&time| time <= least + LEAST_GAIN).expect("one is the nearest");
        order.push(left.remove(next));
        from = ends[order[order.len() - 1]][1];
    }
    order
}

/// Moves single cuts to other places of the order as long as that gains.
fn improve(order: &mut Vec<usize>, ends: &[[Stop; 2]], from: Stop, air: &Air) {
    // Between the cuts at two places of an order without one: the start before the first, nothing behind the last.
    let time = |before: Option<usize>, next: Option<usize>| {
        next.map_or(0.0, |next| air.time(&before.map_or(from, |before| ends[before][1]), &ends[next][0]))
    };
    let mut is_improved = true;
    while std::mem::take(&mut is_improved) {
        for i in 0..order.len() {
            let cut = order[i];
            let mut others = order.clone();
            others.remove(i);
            let around = |k: usize| (k.checked_sub(1).map(|before| others[before]), others.get(k).copied());
            let inserted = |k: usize| {
                let (before, next) = around(k);
                time(before, Some(cut)) + time(Some(cut), next) - time(before, next)
            };
            let best =
                (0..=others.len()).min_by(|&a, &b| inserted(a).total_cmp(&inserted(b))).expect("there is a place");
            if inserted(best) < inserted(i) - LEAST_GAIN {
                others.insert(best, cut);
                (*order, is_improved) = (others, true);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::ir::list::Joint;
    use crate::machine::Job;
    use crate::source::Span;

    fn cut(from: [f64; 2], to: [f64; 2]) -> Vec<Segment> {
        let [from, to] = [from, to].map(|[x, y]| Point::new(x, y));
        vec![Segment { from, to, span: Span::default(), joint: Joint::default(), percent: 100 }]
    }

    #[test]
    fn sides_of_a_part_are_cut_one_after_the_other() {
        let sides = [cut([0.0, 0.0], [900.0, 0.0]), cut([900.0, 20.0], [900.0, 500.0]), cut([0.0, 500.0], [0.0, 20.0])];
        let order = sequence(&sides, Stop::anyhow(Point::new(0.0, 600.0)), &Air::new(&Job::default()));
        assert_eq!(order, [2, 0, 1]);
    }

    #[test]
    fn what_was_passed_by_is_taken_on_the_way() {
        // The nearest comes first each time: the one on the far left is left to the end, and then put where it is passed.
        let cuts = [cut([100.0, 0.0], [200.0, 0.0]), cut([-150.0, 0.0], [-60.0, 0.0]), cut([300.0, 0.0], [900.0, 0.0])];
        let order = sequence(&cuts, Stop::anyhow(Point::new(0.0, 0.0)), &Air::new(&Job::default()));
        assert_eq!(order, [1, 0, 2]);
    }
}
