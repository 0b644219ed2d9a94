//! Whether the heel of the blade goes where the tip went before it.

use super::body::{Cut, Sagitta};
use super::trial::Trial;
use crate::geom::{Point, polyline};

/// Whether a heel, row by row, surely stays nearer to its line than `known` mm: it comes by where the tip was one width of
/// the blade before, or where the blade plunged. How far that is off the line is known at places; what lies between two of
/// them is within half of their distance of one. Where the way between is known to bow by so much, no vertex of the line
/// lies farther beside it than was seen, and so nothing does, but for as much again at its ends.
pub(super) fn trails(cut: &Cut, heels: impl Iterator<Item = Point>, trial: &Trial, known: f64) -> bool {
    let width = cut.stations[cut.body];
    let (mut place, mut behind) = (cut.body, 0);
    heels.enumerate().all(|(row, heel)| {
        place += usize::from(cut.rows.get(place - cut.body + 1) == Some(&row));
        while cut.stations[behind + 1] < cut.stations[place] - width {
            behind += 1;
        }
        let [from, to] = [behind, behind + 1];
        let aside = polyline::distance_to_segment(heel, cut.points[from], cut.points[to]);
        let off = trial.feet[from].deviation.max(trial.feet[to].deviation);
        let between = match cut.sagitta {
            Sagitta::Within(sagitta) if from >= cut.body => off.max(trial.worst.0) + sagitta,
            Sagitta::Within(_) | Sagitta::Timed => (cut.points[to] - cut.points[from]).norm() / 2.0,
        };
        aside + off + between < known
    })
}
