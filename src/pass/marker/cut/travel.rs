//! In which order what common lines leave of outlines is cut: the file does not say. Each keeps its direction: which way it is
//! led over other cuts must not hang on a gap within the band.

use std::ops::Range;

use crate::analysis::air::Stop;
use crate::geom::Point;
use crate::ir::marker::{Cut, Marker};
use crate::machine::Job;
use crate::pass::marker::visit::{Choices, Cuts, Measures, Visit};

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
    let made = MadeCuts { marker, groups, measures: Measures::new(job, marker) };
    let given: Vec<Cuts> = (0..marker.pieces.len()).map(|piece| made.of_piece(piece)).collect();
    let left: Vec<usize> = (0..given.len()).filter(|&i| !given[i].is_empty()).collect();
    let air = made.measures.air;
    let visits: Vec<Vec<Visit>> = left.iter().map(|&i| given[i].visits(&air)).collect();
    let [x, y, _] = job.profile.home;
    let choices = Choices { visits: &visits, home: Stop::anyhow(Point::new(x, y)), air };
    let (chosen, _) = choices.choose(&(0..left.len()).collect::<Vec<_>>());
    let ranges: Vec<Range<usize>> = (0..marker.pieces.len() as u32).map(|piece| marker.range_of(piece)).collect();
    let cuts = &mut marker.cuts;
    for ((of_piece, chosen), &i) in visits.iter().zip(chosen).zip(&left) {
        let range = ranges[i].clone();
        let made: Vec<Cut> = cuts[range.clone()].to_vec();
        let fixed = range.len() - of_piece[chosen].cuts.len();
        for (cut, &(place, _)) in cuts[range].iter_mut().skip(fixed).zip(&of_piece[chosen].cuts) {
            *cut = made[place];
        }
    }
}

/// The cuts of a marker as they are made.
struct MadeCuts<'a> {
    marker: &'a Marker,
    /// For each cut the group that it is of.
    groups: &'a [Group],
    measures: Measures,
}

impl MadeCuts<'_> {
    /// Those of a piece, slits first.
    fn of_piece(&self, piece: usize) -> Cuts {
        let Self { marker, groups, measures } = self;
        let range = marker.range_of(piece as u32);
        let groups = &groups[range.clone()];
        let mut made = Cuts::of_drills(&marker.pieces[piece], &marker.list, measures);
        for (place, cut) in marker.cuts[range].iter().enumerate() {
            let start = || measures.as_is(cut.range, &marker.list);
            match groups[place] {
                Group::Slits => made.fixed.push(start().stops),
                Group::Contour(_) => made.add(place, vec![start()], false),
                group @ Group::Edges(_) => {
                    let starts = vec![start()];
                    made.add(place, starts, place > 0 && groups[place - 1] == group);
                }
            }
        }
        made
    }
}
