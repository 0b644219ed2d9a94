//! Plunge cuts that nobody needs: the blade before, or those before and behind together, cut all of their stretch, as on a
//! nibbled curve whose steps are shorter than the blade.

use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{PASSING_SHARE, Plunge};
use crate::geom::{Point, Vector, cross};
use crate::ir::toolpath::{PlungeCut, Shape, Side, Step};

/// Leaves those out of the steps of a toolpath, but never two in a row: the second may be what cuts the stretch of the first.
pub(super) fn leave_out(steps: &mut Vec<Step>, around: &Surroundings) {
    let is_spare = |steps: &[Step], i: usize| {
        let [Step::PlungeCut(before), Step::PlungeCut(cut)] = &steps[i - 1..=i] else { return false };
        // A line from corner to corner is cut by itself, even beside another one, but for one that goes straight back.
        let goes_back = || before.points.first() == cut.points.last() && before.points.last() == cut.points.first();
        if cut.ends.iter().all(|end| end.side != Side::Contour) && !goes_back() {
            return false;
        }
        let before = Blade::of(before, around);
        // Of one that ends at a corner the overlap there is asked for, which two others may not give.
        let is_amid = || cut.ends.iter().all(|end| end.side == Side::Contour);
        let behind = || steps.get(i + 1).and_then(|step| Blade::at_start(step, around));
        let are_over = |behind: Blade| are_over(&[before, behind], cut, around);
        // Where the part itself lies beyond, nothing is overcut unless the profile asks for it.
        let knife = around.knife;
        let spares_parts = knife.reflex_front_overlap_mm == 0.0 && knife.reflex_heel_overlap_mm == 0.0;
        let asks_no_overlap = || {
            cut.ends.iter().all(|end| match end.side {
                Side::Contour => true,
                Side::Part => end.bare || spares_parts,
                Side::Waste | Side::Gap => end.bare,
            })
        };
        asks_no_overlap() && is_over(&before, cut, around) || is_amid() && behind().is_some_and(are_over)
    };
    let mut i = 1;
    while i < steps.len() {
        if is_spare(steps, i) {
            steps.remove(i);
        }
        i += 1;
    }
}

/// A blade that is plunged.
#[derive(Debug, Clone, Copy)]
struct Blade {
    tip: Point,
    /// Unit vector from its heel to its tip.
    along: Vector,
}

impl Blade {
    /// That of a plunge cut.
    fn of(cut: &PlungeCut, around: &Surroundings) -> Self {
        Self { tip: cut.pose.centre + cut.along * around.knife.radius(), along: cut.along }
    }

    /// Where a step begins; `None` when it does not with a plunge.
    fn at_start(step: &Step, around: &Surroundings) -> Option<Self> {
        match step {
            Step::PlungeCut(cut) => Some(Self::of(cut, around)),
            Step::Run(run) if run.shape == Shape::Open => {
                let plunge = Plunge::at_start(&run.extended(), around.knife.width_mm);
                Some(Self { tip: plunge.tip, along: plunge.blade().try_normalize(0.0)? })
            }
            Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
        }
    }
}

/// Whether a blade lies over all of the stretch of another, which would then cut nothing that is not cut already.
fn is_over(blade: &Blade, cut: &PlungeCut, around: &Surroundings) -> bool {
    let beside = around.tolerance;
    cut.points.windows(2).all(|ends| under(blade, [ends[0], ends[1]], beside, around) == Some([0.0, 1.0]))
}

/// Whether two blades together surely lie over all of the stretch of another.
fn are_over(blades: &[Blade; 2], cut: &PlungeCut, around: &Surroundings) -> bool {
    let beside = PASSING_SHARE * around.tolerance;
    cut.points.windows(2).all(|ends| {
        let [a, b] = blades.each_ref().map(|blade| under(blade, [ends[0], ends[1]], beside, around));
        match (a, b) {
            (Some([0.0, to]), Some([from, 1.0])) | (Some([from, 1.0]), Some([0.0, to])) => to >= from,
            (Some(all), _) | (_, Some(all)) => all == [0.0, 1.0],
            (None, None) => false,
        }
    })
}

/// The part of a segment, from 0 at its start to 1 at its end, that lies no farther beside a blade than so many mm.
fn under(
    &Blade { tip, along }: &Blade,
    [from, to]: [Point; 2],
    beside: f64,
    around: &Surroundings,
) -> Option<[f64; 2]> {
    let knife = around.knife;
    let [a, b] = [from, to].map(|point| [cross(along, point - tip), along.dot(&(point - tip))]);
    let ranges = [[-beside, beside], [-knife.width_mm, 0.0]];
    (0..2).try_fold([0.0_f64, 1.0_f64], |[low, high], k| {
        let [from, to] = between(a[k], b[k], ranges[k])?;
        let (low, high) = (low.max(from), high.min(to));
        (low <= high).then_some([low, high])
    })
}

/// Where a value that goes evenly from one to another between 0 and 1 lies in a range.
fn between(start: f64, end: f64, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
    let slope = end - start;
    if slope == 0.0 {
        return (low..=high).contains(&start).then_some([0.0, 1.0]);
    }
    let (a, b) = ((low - start) / slope, (high - start) / slope);
    Some([a.min(b).max(0.0), a.max(b).min(1.0)])
}
