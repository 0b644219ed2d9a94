//! Overlaps of the blade past the ends of a run: the length in the profile, as far as there is room.

use crate::analysis::cloth::{Surroundings, begins_inside};
use crate::geom::region::Ray;
use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{End, Run, Shape, Side};

use super::blade::{PASSING_SHARE, Plunge};

/// Overlap that counts as none, mm: rounding must not become a chord of the path.
const OVERLAP_EPSILON: f64 = 1e-6;

/// Overlap of the blade past one end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Length, mm.
    pub length: f64,
    /// Kind of region in which it lies.
    pub side: Side,
}

/// Overlaps of a run: length of the heel before its start, and of the tip past its end.
///
/// Each continues straight: in waste with the length in the profile, in the part itself with the length for parts, and
/// shortened to the gap less `knife.clearance_mm` where a part lies ahead. On a curve the heel overlap is limited so that the
/// plunged blade stays near the start. A ring has a front overlap along itself.
pub fn overlaps(run: &Run, around: &Surroundings) -> [Overlap; 2] {
    let knife = around.knife;
    let [start, end] = run.ends;
    let heel = if start.corner { knife.corner_heel_overlap_mm } else { knife.heel_overlap_mm };
    let front = if end.corner { knife.corner_front_overlap_mm } else { knife.front_overlap_mm };
    if run.shape == Shape::Ring {
        // A second lap would cut nothing new.
        let length = if end.bare { 0.0 } else { front.min(polyline::length(&run.points)) };
        return [Overlap::none(start), Overlap { length, ..Overlap::none(end) }];
    }
    let n = run.points.len();
    let direction = |from: usize, to: usize| {
        polyline::direction(run.points[from], run.points[to]).expect("no chord of a run has length zero")
    };
    let part = [knife.reflex_heel_overlap_mm, knife.reflex_front_overlap_mm];
    let ends = [
        Wanted { end: start, waste: heel, part: part[0], from: run.points[0], along: direction(1, 0) },
        Wanted { end, waste: front, part: part[1], from: run.points[n - 1], along: direction(n - 2, n - 1) },
    ];
    let [heel, front] = ends.map(|wanted| wanted.given(around));
    let share = heel_share(run, heel.length, PASSING_SHARE * around.tolerance, knife.width_mm);
    [Overlap { length: heel.length * share, ..heel }, front]
}

/// Overlap as the profile wants it.
struct Wanted {
    /// End of the run past which it goes.
    end: End,
    /// Wanted length in the waste, mm.
    waste: f64,
    /// Wanted length in the part, mm.
    part: f64,
    /// Start point, and unit vector of its direction.
    from: Point,
    along: Vector,
}

impl Wanted {
    /// Overlap as far as there is room for it.
    fn given(&self, around: &Surroundings) -> Overlap {
        if self.end.bare {
            return Overlap::none(self.end);
        }
        let clearance = around.knife.clearance_mm;
        let reach = self.waste.max(self.part) + clearance;
        if reach == 0.0 {
            return Overlap::none(End::default());
        }
        let room = around.room(&Ray { from: self.from, along: self.along, reach });
        let is_inside = begins_inside(room);
        let (wanted, gap) = if is_inside { (self.part, room.other) } else { (self.waste, room.least()) };
        let length = wanted.min(gap - clearance);
        let length = if length > OVERLAP_EPSILON { length } else { 0.0 };
        let side = match (is_inside, length < wanted) {
            (true, _) => Side::Part,
            (false, true) => Side::Gap,
            (false, false) => Side::Waste,
        };
        Overlap { length, side }
    }
}

impl Overlap {
    fn none(end: End) -> Self {
        Self { length: 0.0, side: end.side }
    }
}

/// Share of a heel overlap with which a plunged blade of `width` mm passes the start of its run within `allowed` mm. A curve
/// turns the blade away from its first chord, along which the overlap lies: with the whole overlap the blade would cut into the
/// corner.
pub fn heel_share(run: &Run, heel: f64, allowed: f64, width: f64) -> f64 {
    // The curve turns the blade by at most the turn of the run under it.
    if heel == 0.0 || heel >= width || heel * polyline::turn_within(&run.points, width) <= allowed {
        return 1.0;
    }
    let near = run.points.iter().position(|point| (point - run.points[0]).norm() > width);
    let under = &run.points[..near.map_or(run.points.len(), |near| near + 1)];
    let along = polyline::direction(run.points[0], run.points[1]).expect("no chord of a run has length zero");
    let path: Vec<Point> = std::iter::once(run.points[0] - along * heel).chain(under.iter().copied()).collect();
    let plunge = Plunge::at_start(&path, width);
    if plunge.covers_all { 1.0 } else { (allowed / plunge.distance(run.points[0])).min(1.0) }
}
