//! Order of the cuts that common lines leave of outlines: the file does not give one. Each cut keeps its direction, because the
//! way in which it is led over other cuts must not depend on a gap within the band.

use std::ops::Range;

use crate::analysis::air::Stop;
use crate::geom::Point;
use crate::ir::marker::{Cut, Marker};
use crate::machine::Job;
use crate::pass::marker::visit::{Choices, Cuts, Measures, Visit};

/// Group of cuts made together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::pass::marker) enum Group {
    /// Strokes of notches, in the order of these.
    Slits,
    /// A contour, by its index in its piece, cut as a whole.
    Contour(usize),
    /// Remaining cuts of contours with common lines, or the legs of notches on them, in any order, by the index of the first.
    Edges(usize),
}

/// Reorders the remaining cuts of outlines for the least travel; everything else stays as it is.
pub(super) fn arrange(marker: &mut Marker, groups: &[Group], job: &Job) {
    if !groups.iter().any(|group| matches!(group, Group::Edges(_))) {
        return; // the usual case
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

/// Cuts of a marker.
struct MadeCuts<'a> {
    marker: &'a Marker,
    /// Group of each cut.
    groups: &'a [Group],
    measures: Measures,
}

impl MadeCuts<'_> {
    /// Cuts of a piece, slits first.
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
