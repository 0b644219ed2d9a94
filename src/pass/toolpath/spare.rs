//! Redundant plunge cuts: their stretch is cut by the blade before them, or by those before and behind together, as on a
//! nibbled curve whose steps are shorter than the blade. The blades before and behind must meet without them.

use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{PASSING_SHARE, Plunge};
use crate::geom::{Point, Vector, cross, polyline};
use crate::ir::toolpath::{PlungeCut, Shape, Side, Step};

/// Removes plunge cuts whose stretch other blades cut, but never two in a row: the second may be the one that cuts the stretch
/// of the first. A cut whose removal would leave a gap wider than `thread` mm stays.
pub(super) fn leave_out(steps: &mut Vec<Step>, around: &Surroundings, thread: f64) {
    let mut i = 1;
    while i < steps.len() {
        if (Strokes { steps, around, thread }).is_spare(i) {
            steps.remove(i);
        }
        i += 1;
    }
    while (Strokes { steps, around, thread }).ends_over_start() {
        steps.pop();
    }
}

/// The strokes of a toolpath.
struct Strokes<'a> {
    steps: &'a [Step],
    around: &'a Surroundings<'a>,
    /// Greatest distance between two strokes that meet, mm.
    thread: f64,
}

impl Strokes<'_> {
    /// True if a step is a redundant plunge cut.
    fn is_spare(&self, i: usize) -> bool {
        let Self { steps, around, .. } = *self;
        let [Step::PlungeCut(before), Step::PlungeCut(cut)] = &steps[i - 1..=i] else { return false };
        // A line from corner to corner is cut by itself, even beside another one, unless it goes straight back.
        let goes_back = before.points.first() == cut.points.last() && before.points.last() == cut.points.first();
        if goes_back {
            return asks_no_overlap(cut, around) && is_over(&Blade::of(before, around), cut, around);
        }
        // The first stretch of a line is cut by itself too, however near to it the previous line ends.
        let goes_on = cut.ends[usize::from(cut.turned)].side == Side::Contour;
        if !goes_on || !asks_no_overlap(cut, around) {
            return false;
        }
        let (before, behind) = (Blade::of(before, around), self.behind(i, cut));
        // A cut that ends at a corner needs its overlap there, which two others may not provide.
        let is_amid = cut.ends.iter().all(|end| end.side == Side::Contour);
        let behind_starts = || steps.get(i + 1).and_then(|step| Blade::at_start(step, around));
        let are_over = |behind: Blade| are_over(&[before, behind], cut, around);
        let is_cut = is_over(&before, cut, around) || is_amid && behind_starts().is_some_and(are_over);
        is_cut && behind.is_none_or(|step| self.meets(&before, step))
    }

    /// True if the last step is a plunge cut amid a closed contour that is covered by the blade which begins the contour.
    fn ends_over_start(&self) -> bool {
        let [first, .., before, Step::PlungeCut(cut)] = self.steps else { return false };
        let Some(start) = Blade::at_start(first, self.around) else { return false };
        let is_amid = cut.ends.iter().all(|end| end.side == Side::Contour);
        is_amid && is_over(&start, cut, self.around) && self.meets(&start, before)
    }

    /// Stroke that continues from the end of a cut; for the last one of a closed contour, the first.
    fn behind(&self, i: usize, cut: &PlungeCut) -> Option<&Step> {
        let end = drawn(&cut.points, cut.turned)[1];
        let goes_on = |step: &&Step| match step {
            Step::Run(run) => drawn(&run.points, run.turned)[0] == end,
            Step::PlungeCut(next) => drawn(&next.points, next.turned)[0] == end,
            Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => false,
        };
        self.steps.get(i + 1).filter(goes_on).or_else(|| self.steps.first().filter(goes_on))
    }

    /// True if a blade is near enough to a stroke to meet it.
    fn meets(&self, blade: &Blade, step: &Step) -> bool {
        let width = self.around.knife.width_mm;
        let way = match step {
            Step::PlungeCut(cut) => Blade::of(cut, self.around).ends(width).to_vec(),
            Step::Run(run) if run.shape == Shape::Open => {
                // The blade lies from the start of the path to its tip.
                let path = run.extended();
                std::iter::once(Plunge::at_start(&path, width).tip).chain(path).collect()
            }
            Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => return false,
        };
        let blade = blade.ends(width);
        way.windows(2).any(|ends| polyline::distance_of_segments(blade, [ends[0], ends[1]]) <= self.thread)
    }
}

/// First and last point of a stroke in the order of the file.
pub(super) fn drawn(points: &[Point], turned: bool) -> [Point; 2] {
    let ends = [points[0], points[points.len() - 1]];
    if turned { [ends[1], ends[0]] } else { ends }
}

/// True if the profile requires no overlap at either end of a plunge cut.
fn asks_no_overlap(cut: &PlungeCut, around: &Surroundings) -> bool {
    // With the part itself beyond the end, nothing is overcut unless the profile asks for it.
    let knife = around.knife;
    let spares_parts = knife.reflex_front_overlap_mm == 0.0 && knife.reflex_heel_overlap_mm == 0.0;
    cut.ends.iter().all(|end| match end.side {
        Side::Contour => true,
        Side::Part => end.bare || spares_parts,
        Side::Waste | Side::Gap => end.bare,
    })
}

/// Plunged blade.
#[derive(Debug, Clone, Copy)]
struct Blade {
    tip: Point,
    /// Unit vector from heel to tip.
    along: Vector,
}

impl Blade {
    /// Blade of a plunge cut.
    fn of(cut: &PlungeCut, around: &Surroundings) -> Self {
        Self { tip: cut.pose.centre + cut.along * around.knife.radius(), along: cut.along }
    }

    /// Heel and tip.
    fn ends(&self, width: f64) -> [Point; 2] {
        [self.tip - self.along * width, self.tip]
    }

    /// Blade at the start of a step; `None` if the step does not begin with a plunge.
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

/// True if a blade covers the whole stretch of a plunge cut, which would then cut nothing new.
fn is_over(blade: &Blade, cut: &PlungeCut, around: &Surroundings) -> bool {
    let beside = around.tolerance;
    cut.points.windows(2).all(|ends| under(blade, [ends[0], ends[1]], beside, around) == Some([0.0, 1.0]))
}

/// True if two blades together reliably cover the whole stretch of a plunge cut.
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

/// Part of a segment, from 0 at its start to 1 at its end, that lies at most `beside` mm beside a blade.
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

/// Part of the interval from 0 to 1 in which a linear function from `start` to `end` lies in a range.
fn between(start: f64, end: f64, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
    let slope = end - start;
    if slope == 0.0 {
        return (low..=high).contains(&start).then_some([0.0, 1.0]);
    }
    let (a, b) = ((low - start) / slope, (high - start) / slope);
    Some([a.min(b).max(0.0), a.max(b).min(1.0)])
}
