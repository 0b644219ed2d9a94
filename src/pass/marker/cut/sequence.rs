//! In which order and direction the open cuts of a line are made that has edges in common with others: the file says none.

use crate::analysis::air::{Air, Stop};
use crate::geom::Point;
use crate::ir::list::Segment;

/// Of more cuts only the nearest comes next each time; what follows from that is left.
const MOST_IMPROVED: usize = 200;
/// Gains that are less are none, s: the few tenths of a millimetre by which edges in common lie apart decide nothing.
const LEAST_GAIN: f64 = 5e-3;

/// An open cut as the knife comes to it and leaves it, either way.
#[derive(Debug, Clone, Copy)]
struct Ends {
    /// Where it comes down and up along the cut, and against it.
    stops: [[Stop; 2]; 2],
}

/// A cut by its place among the given ones, and whether it is made against its direction.
pub(super) type Turn = (usize, bool);

/// An order of cuts with little travel from a place on, and where the knife comes up behind the last.
pub(super) fn sequence(cuts: &[Vec<Segment>], from: Stop, air: &Air) -> (Vec<Turn>, Stop) {
    let ends: Vec<Ends> = cuts.iter().map(|cut| Ends::of(cut, air)).collect();
    let mut turns = nearest_next(&ends, from, air);
    if turns.len() <= MOST_IMPROVED {
        improve(&mut turns, &ends, from, air);
    }
    let end = turns.last().map_or(from, |&last| ends[last.0].stops(last)[1]);
    (turns, end)
}

impl Ends {
    fn of(cut: &[Segment], air: &Air) -> Self {
        let (first, last) = (cut[0], cut[cut.len() - 1]);
        let way = |first: [Point; 2], last: [Point; 2]| [air.down(first[0], first[1]), air.up(last[0], last[1])];
        let along = way([first.from, first.to], [last.from, last.to]);
        let against = way([last.to, last.from], [first.to, first.from]);
        Self { stops: [along, against] }
    }

    fn stops(&self, (_, is_reversed): Turn) -> [Stop; 2] {
        self.stops[usize::from(is_reversed)]
    }
}

fn nearest_next(ends: &[Ends], mut from: Stop, air: &Air) -> Vec<Turn> {
    let mut left: Vec<usize> = (0..ends.len()).collect();
    let mut turns = Vec::with_capacity(ends.len());
    while !left.is_empty() {
        let ways = left.iter().enumerate().flat_map(|(k, &i)| [(k, (i, false)), (k, (i, true))]);
        let time = |&(_, turn): &(usize, Turn)| air.time(&from, &ends[turn.0].stops(turn)[0]);
        let least = ways.clone().map(|way| time(&way)).fold(f64::INFINITY, f64::min);
        let nearest = ways.clone().find(|way| time(way) <= least + LEAST_GAIN).expect("one is left");
        from = ends[nearest.1.0].stops(nearest.1)[1];
        turns.push(nearest.1);
        left.remove(nearest.0);
    }
    turns
}

/// Reverses stretches as long as that gains (2-opt): the cuts of one are then made against their direction.
fn improve(turns: &mut Vec<Turn>, ends: &[Ends], from: Stop, air: &Air) {
    let time = |turns: &[Turn]| {
        let mut at = from;
        turns.iter().fold(0.0, |sum, &turn| {
            let [down, up] = ends[turn.0].stops(turn);
            sum + air.time(&std::mem::replace(&mut at, up), &down)
        })
    };
    // How much less the moves to a stretch and from it take when it is reversed.
    let gain = |turns: &[Turn], i: usize, j: usize| {
        let before = i.checked_sub(1).map_or(from, |before| ends[turns[before].0].stops(turns[before])[1]);
        let [first, last] = [i, j].map(|k| turns[k]);
        let reversed = |(cut, is_reversed): Turn| ends[cut].stops((cut, !is_reversed));
        let to = |stop: Stop| turns.get(j + 1).map_or(0.0, |&next| air.time(&stop, &ends[next.0].stops(next)[0]));
        let now = air.time(&before, &ends[first.0].stops(first)[0]) + to(ends[last.0].stops(last)[1]);
        now - air.time(&before, &reversed(last)[0]) - to(reversed(first)[1])
    };
    let mut whole = time(turns);
    let mut is_improved = true;
    while std::mem::take(&mut is_improved) {
        for i in 0..turns.len() {
            for j in i..turns.len() {
                if gain(turns, i, j) <= LEAST_GAIN {
                    continue;
                }
                let mut other = turns.clone();
                other[i..=j].reverse();
                other[i..=j].iter_mut().for_each(|turn| turn.1 = !turn.1);
                let time = time(&other);
                if time < whole - LEAST_GAIN {
                    (*turns, whole, is_improved) = (other, time, true);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::list::Joint;
    use crate::machine::Job;
    use crate::source::Span;

    fn cut(from: [f64; 2], to: [f64; 2]) -> Vec<Segment> {
        let [from, to] = [from, to].map(|[x, y]| Point::new(x, y));
        vec![Segment { from, to, span: Span::default(), joint: Joint::default(), percent: 100 }]
    }

    #[test]
    fn sides_of_a_part_are_cut_one_after_the_other_whichever_way_they_are_drawn() {
        let sides = [cut([0.0, 0.0], [900.0, 0.0]), cut([0.0, 500.0], [0.0, 20.0]), cut([900.0, 500.0], [900.0, 20.0])];
        let air = Air::new(&Job::default());
        let (turns, end) = sequence(&sides, Stop::anyhow(Point::new(0.0, 600.0)), &air);
        assert_eq!(turns, [(1, false), (0, false), (2, true)]);
        assert!((end.at - Point::new(900.0, 500.0)).norm() < 10.0);
    }
}
