//! In which order what common lines leave of outlines is cut: the file does not say. Each keeps its direction: led over other
//! cuts the other way round it may leave threads there.

use std::ops::Range;

use crate::analysis::air::Stop;
use crate::geom::Point;
use crate::ir::list::SegmentList;
use crate::ir::marker::{Cut, Marker, Piece};
use crate::machine::Job;
use crate::pass::marker::visit::{Cuts, Measures, Visit, choose};

/// What a cut is made with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::pass::marker) enum Group {
    /// The strokes of notches, in the order of these.
    Slits,
    /// A contour, by its place in its piece, cut as a whole.
    Contour(usize),
    /// What common lines leave of one, or the legs of notches on it, by the place of the first: in any order.
    Edges(usize),
}

/// Puts what is left of outlines in the order with the least travel; all else stays as it is.
pub(super) fn arrange(marker: &mut Marker, groups: &[Group], job: &Job) {
    if !groups.iter().any(|group| matches!(group, Group::Edges(_))) {
        return; // as in most files
    }
    let measures = Measures::new(job, marker);
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
        for (cut, &(place, _)) in cuts[range].iter_mut().skip(fixed).zip(&of_piece[chosen].cuts) {
            *cut = made[place];
        }
    }
}

/// A piece as its cuts are made, slits first.
fn as_made(piece: &Piece, cuts: &[Cut], groups: &[Group], list: &SegmentList, measures: &Measures) -> Cuts {
    let mut made = Cuts::of_drills(piece, list, measures);
    for (place, cut) in cuts.iter().enumerate() {
        match groups[place] {
            Group::Slits => made.fixed.push(measures.as_is(cut.range, list).stops),
            Group::Contour(_) => made.add(place, vec![measures.as_is(cut.range, list)], false),
            group @ Group::Edges(_) => {
                made.add(place, vec![measures.as_is(cut.range, list)], place > 0 && groups[place - 1] == group);
            }
        }
    }
    made
}
