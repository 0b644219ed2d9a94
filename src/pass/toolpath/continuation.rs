//! Straight continuation of a short cut: the stretches of its line before and behind it. A blade that is longer than the cut
//! may lie over them, because they are cut anyway.

use super::spare::drawn;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::Continuation;
use crate::geom::{Point, Vector, cross, polyline};
use crate::ir::toolpath::{Run, Side, Step};

/// Shortfall of a straight stretch against the blade that lies on it, in tolerances: one at either end, one for where it bends.
const SHORT: f64 = 3.0;

/// Straight continuation of the line before the start and behind the end of a run; none if the run is longer than the blade.
/// `step` is the index of the run.
pub(super) fn continuation(steps: &[Step], step: usize, run: &Run, around: &Surroundings) -> Continuation {
    let width = around.knife.width_mm;
    let ends = [run.points[0], run.points[run.points.len() - 1]];
    let Some(along) = polyline::direction(ends[0], ends[1]) else { return Continuation::default() };
    let length = polyline::length(&run.points);
    if length > width {
        return Continuation::default();
    }
    let straight = [0, 1].map(|end| {
        if run.ends[end].side != Side::Contour {
            return 0.0;
        }
        let band = Band { from: ends[end], along: if end == 0 { -along } else { along }, beside: around.tolerance };
        let is_before = (end == 0) != run.turned;
        band.straight(points_from(steps, step, is_before), width - length)
    });
    let takes_all = straight[0] + length + straight[1] >= width - SHORT * around.tolerance;
    Continuation { straight, takes_all }
}

/// Points of the strokes before or behind a step, leading away from it, as long as each stroke starts where the previous one
/// ends.
fn points_from(steps: &[Step], step: usize, is_before: bool) -> impl Iterator<Item = Point> + '_ {
    let others: Box<dyn Iterator<Item = &Step>> =
        if is_before { Box::new(steps[..step].iter().rev()) } else { Box::new(steps[step + 1..].iter()) };
    let mut place = points_of(&steps[step]).map(|(points, turned)| drawn(points, turned)[usize::from(!is_before)]);
    let next = move |other: &Step| {
        let (points, turned) = points_of(other)?;
        let [first, last] = drawn(points, turned);
        let [near, far] = if is_before { [last, first] } else { [first, last] };
        if Some(near) != place {
            return None;
        }
        place = Some(far);
        let mut points = points.to_vec();
        if points[0] != near {
            points.reverse();
        }
        Some(points)
    };
    others.map_while(next).flat_map(|points| points.into_iter().skip(1))
}

/// Points of a stroke, and true if it is cut against the order of the file.
fn points_of(step: &Step) -> Option<(&[Point], bool)> {
    match step {
        Step::Run(run) => Some((&run.points, run.turned)),
        Step::PlungeCut(cut) => Some((&cut.points, cut.turned)),
        Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    }
}

/// Band along a straight line.
struct Band {
    from: Point,
    /// Unit vector.
    along: Vector,
    /// Half the width of the band, mm.
    beside: f64,
}

impl Band {
    /// Length of a path from the start of the band to where it leaves the band or turns back, mm, at most `reach`.
    fn straight(&self, points: impl Iterator<Item = Point>, reach: f64) -> f64 {
        let [mut way, mut aside] = [0.0; 2];
        for point in points {
            let [next, beside] = [self.along.dot(&(point - self.from)), cross(self.along, point - self.from)];
            if way >= reach || next <= way {
                break;
            }
            if beside.abs() > self.beside {
                way += (next - way) * (self.beside * beside.signum() - aside) / (beside - aside);
                break;
            }
            [way, aside] = [next, beside];
        }
        way.min(reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_straight_up_to_where_it_leaves_its_band() {
        let band = Band { from: Point::origin(), along: Vector::new(1.0, 0.0), beside: 0.1 };
        let straight = |points: &[[f64; 2]], reach| band.straight(points.iter().map(|&at| Point::from(at)), reach);
        assert_eq!(straight(&[[2.0, 0.05], [3.0, 0.0]], 9.0), 3.0);
        assert_eq!(straight(&[[2.0, 0.05], [3.0, 0.0]], 2.5), 2.5);
        assert_eq!(straight(&[[2.0, 0.0], [4.0, 0.2], [9.0, 0.0]], 9.0), 3.0);
        assert_eq!(straight(&[[2.0, 0.0], [1.0, 0.0]], 9.0), 2.0);
        assert_eq!(straight(&[], 9.0), 0.0);
    }
}
