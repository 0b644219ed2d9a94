//! Check that the heel of the blade follows the tip.

use super::body::{Cut, Sagitta};
use super::trial::Trial;
use crate::geom::{Point, polyline};

/// True if the heel certainly stays within `known` mm of its line at each row, since it passes where the tip was one blade
/// width earlier or where the blade plunged. The deviation there is known at points; a place between two of them is at most
/// half their distance away from one. For a path with a known bow, no vertex of the line deviates by more than the greatest
/// deviation seen; so the path deviates by at most that plus the bow.
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
