//! In which order and direction what common lines leave of outlines is cut: the file says neither.

use std::ops::Range;

use crate::analysis::air::Stop;
use crate::geom::Point;
use crate::ir::list::SegmentList;
use crate::ir::marker::{Cut, Marker, Piece};
use crate::machine::Job;
use crate::pass::marker::visit::{Cuts, Measures, Start, Visit, choose};

/// What a cut is made with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::pass::marker) enum Group {
    /// The strokes of notches, in the order of these.
    Slits,
    /// A contour, by its place in its piece, cut as a whole.
    Contour(usize),
    /// The legs of notches on one with common lines, by the place of the first: in any order, each as it is, for the blade cuts
    /// both legs of a notch from the edge inwards anyhow.
    Legs(usize),
    /// What common lines leave of one, by the place of the first: in any order, from either end.
    Edges(usize),
}

impl Group {
    /// Where a cut of it may start that is a contour with common lines no longer.
    pub(in crate::pass::marker) fn starts(self, cut: &Cut, list: &SegmentList, measures: &Measures) -> Vec<Start> {
        match self {
            Self::Slits | Self::Contour(_) | Self::Legs(_) => vec![measures.as_is(cut.range, list)],
            Self::Edges(_) => measures.either_way(cut.range, list),
        }
    }
}

/// Puts what is left of outlines in the order and directions with the least travel; all else stays as it is.
pub(super) fn arrange(marker: &mut Marker, groups: &[Group], job: &Job) {
    if !groups.iter().any(|group| matches!(group, Group::Legs(_) | Group::Edges(_))) {
        return; // as in most files
    }
    let measures = Measures::new(job, marker.unit);
    let ranges: Vec<Range<usize>> = (0..marker.pieces.len() as u32).map(|piece| marker.range_of(piece)).collect();
    let Marker { pieces, cuts, list, .. } = marker;
    let given: Vec<Cuts> = pieces
        .iter()
        .zip(&ranges)
        .map(|(piece, range)| as_made(piece, &cuts[range.clone()], &groups[range.clone()], list, &measures))
        .collect();
    let left: Vec<usize> = (0..given.len()).filter(|&i| !given[i].is_empty()).collect();
    let visits: Vec<Vec<Visit>> = left.iter().map(|&i| given[i].visits(&measures.air)).collect();
    let [x, y, _] = job.profile.home;
    let order: Vec<usize> = (0..left.len()).collect();
    let (chosen, _) = choose(&order, &visits, &Stop::anyhow(Point::new(x, y)), &measures.air);
    for ((of_piece, chosen), &i) in visits.iter().zip(chosen).zip(&left) {
        let range = ranges[i].clone();
        let made: Vec<Cut> = cuts[range.clone()].to_vec();
        let fixed = range.len() - of_piece[chosen].cuts.len();
        for (cut, (place, begin)) in cuts[range].iter_mut().skip(fixed).zip(&of_piece[chosen].cuts) {
            *cut = if begin.is_reversed { reversed(made[*place]) } else { made[*place] };
        }
    }
}

/// A piece as its cuts are made, slits first.
fn as_made(piece: &Piece, cuts: &[Cut], groups: &[Group], list: &SegmentList, measures: &Measures) -> Cuts {
    let mut made = Cuts::of_drills(piece, measures);
    for (place, cut) in cuts.iter().enumerate() {
        match groups[place] {
            Group::Slits => made.fixed.push(measures.as_is(cut.range, list).stops),
            group @ Group::Contour(_) => made.add(place, group.starts(cut, list, measures), false),
            group @ (Group::Legs(_) | Group::Edges(_)) => {
                made.add(place, group.starts(cut, list, measures), place > 0 && groups[place - 1] == group);
            }
        }
    }
    made
}

fn reversed(cut: Cut) -> Cut {
    let [left, right] = cut.sides;
    Cut { range: cut.range.reversed(), sides: [right, left], ..cut }
}
