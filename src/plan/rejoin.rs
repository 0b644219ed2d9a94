//! Runs that are lifted in the middle of a line and continue along it: their curves are parts of one curve.
//!
//! The end of one run and the start of the next lie on the same stretch of the contour. If each were smoothed by itself within
//! the band, they would run side by side there and leave a thread of cloth between the two cuts.

use super::meeting::{self, Overlap, SAME_EPSILON, overlap};
use super::run::{self, Curved, Cut, Order};
use super::spline::{Extended, Near, Smooth, ToleranceBand, smooth};
use crate::diagnostic::Diagnostic;
use crate::geom::{Point, polyline};
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Shape, Toolpath};
use crate::machine::Job;

/// Fractions of the tolerance to try under plunging blades, when with the full tolerance the curve turns away from the blade.
const NARROWER: [f64; 3] = [0.4, 0.15, 0.05];
/// Fractions of the tolerance to try around the chords, when no curve with sagittas works.
const CHORDS: [f64; 2] = [1.0, 0.4];
/// Maximum additional turn of a curve away from a plunged blade, beyond that of its line, as a fraction of the greatest heading
/// error.
const LEAD_SHARE: f64 = 0.9;

/// Solves the runs of a toolpath, in order. Runs whose common line is too tight for one curve are solved separately.
pub(super) fn solve(toolpath: &Toolpath, job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    let (runs, tolerance) = (&toolpath.runs().collect::<Vec<&Run>>()[..], toolpath.tolerance);
    let mut cuts: Vec<Option<Cut>> = runs.iter().map(|_| None).collect();
    let mut refused = Vec::new();
    let near = meeting::near(toolpath, job);
    for group in groups(runs) {
        let of_group: Vec<&Run> = group.iter().map(|&k| runs[k]).collect();
        let is_line = group.len() > 1 || overlap(of_group[0], of_group[0]).is_some();
        let ends = [near[group[0]][0], near[group[group.len() - 1]][1]];
        let of_line = if is_line { Line::of(&of_group, ends, tolerance, job).cuts(tolerance, job) } else { None };
        if let Some(of_line) = of_line {
            group.into_iter().zip(of_line).for_each(|(k, cut)| cuts[k] = Some(cut));
            continue;
        }
        for k in group {
            match run::solve(runs[k], near[k], tolerance, job) {
                Ok(cut) => cuts[k] = Some(cut),
                Err(diagnostic) => refused.push(diagnostic),
            }
        }
    }
    if refused.is_empty() { Ok(cuts.into_iter().flatten().collect()) } else { Err(refused) }
}

/// Groups the runs of a contour, by index: in each group every run continues the one before it. The last run may continue over
/// the start of the first.
fn groups(runs: &[&Run]) -> Vec<Vec<usize>> {
    let count = runs.len();
    if count == 0 {
        return Vec::new();
    }
    let goes_on: Vec<bool> = (0..count).map(|k| overlap(runs[k], runs[(k + 1) % count]).is_some()).collect();
    if goes_on.iter().all(|&goes_on| goes_on) {
        return vec![(0..count).collect()];
    }
    let starts = (0..count).filter(|&k| !goes_on[(k + count - 1) % count]);
    let group = |start: usize| {
        let behind = (start..start + count).take_while(|k| goes_on[k % count]);
        std::iter::once(start).chain(behind.map(|k| (k + 1) % count)).collect()
    };
    starts.map(group).collect()
}

/// Constructor of the band around a polyline.
type Band<'a> = dyn Fn(&[Point]) -> ToleranceBand + 'a;

/// The common line of several runs.
struct Line<'a> {
    points: Vec<Point>,
    junctions: Vec<bool>,
    parts: Vec<Part<'a>>,
    /// Limits on the deviation of the tip at its ends.
    near: [Near; 2],
    /// The ring that the runs form, when the last one ends over the first.
    ring: Option<Run>,
}

/// A run and its position on the common line.
struct Part<'a> {
    run: &'a Run,
    extended: Extended,
    /// Station of its start, mm.
    start: f64,
}

impl<'a> Line<'a> {
    fn of(runs: &[&'a Run], near: [Near; 2], tolerance: f64, job: &Job) -> Self {
        let width = job.profile.knife.width_mm;
        let mut line = Self { points: Vec::new(), junctions: Vec::new(), parts: Vec::new(), near, ring: None };
        let has_junctions = runs.iter().any(|run| !run.junctions.is_empty());
        let mut end = 0.0;
        for (k, &run) in runs.iter().enumerate() {
            let extended = run::extended(run, tolerance, width);
            let mut junctions = extended.junctions.clone();
            junctions.resize(if has_junctions { extended.points.len() - 1 } else { 0 }, false);
            let overlap = k.checked_sub(1).and_then(|before| overlap(runs[before], run));
            let (start, known) = match (overlap, k.checked_sub(1)) {
                (Some(Overlap { chord, length }), Some(before)) => {
                    (end - length, runs[before].points.len() - 1 - chord)
                }
                _ => (0.0, 0),
            };
            // The last vertex of the previous run lies inside a chord of this one.
            line.points.pop();
            line.junctions.pop();
            line.points.extend(&extended.points[known..]);
            line.junctions.extend(&junctions[known.saturating_sub(1).min(junctions.len())..]);
            end = start + extended.end;
            line.parts.push(Part { run, extended, start });
        }
        line.ring = line.lap();
        line
    }

    /// The ring that the runs form; `None` when the line is open.
    fn lap(&self) -> Option<Run> {
        let [first, last] = [&self.parts[0], &self.parts[self.parts.len() - 1]];
        let Overlap { chord, length } = overlap(last.run, first.run)?;
        let chord = self.points.len() - (last.run.points.len() - chord);
        let start = self.points[0];
        // The run may start at a vertex.
        let last = chord + usize::from((self.points[chord] - start).norm() > SAME_EPSILON);
        let points: Vec<Point> = self.points[..last].iter().copied().chain([start]).collect();
        let (count, run) = (points.len() - 1, first.run);
        Some(Run {
            points,
            spans: vec![run.spans[0]; count],
            joints: vec![Joint::default(); count + 1],
            feeds: vec![f64::INFINITY; count],
            junctions: self.junctions[..count.min(self.junctions.len())].to_vec(),
            shape: Shape::Ring,
            front: length,
            heel: 0.0,
            ..run.clone()
        })
    }

    /// The cuts of the runs; `None` where no common curve was found or one of the runs cannot be cut along it.
    fn cuts(&self, tolerance: f64, job: &Job) -> Option<Vec<Cut>> {
        let ends = [self.points[0], self.points[self.points.len() - 1]];
        let length = polyline::length(&self.points);
        if self.ring.is_none()
            && polyline::is_straight(&self.points, run::straight_share(&self.junctions) * tolerance)
            && run::passes_ends(&self.points, self.near, tolerance)
        {
            let at = |station: f64| ends[0] + (ends[1] - ends[0]) * (station / length);
            let smooth = Smooth { curve: run::straight_curve(length, ends), sagitta: 0.0 };
            let cut = |part: &Part| {
                let order = Order::new(part.run, &part.extended, job);
                if order.has_one_feed() {
                    return order.straight([part.start, part.start + part.extended.end].map(at)).ok();
                }
                Some(order.curved(&part.extended, &part.stretch_of(&smooth, 0.0)).ok()?.cut)
            };
            return self.parts.iter().map(cut).collect();
        }
        let bulging = |points: &[Point]| ToleranceBand::new(points.to_vec(), tolerance, &job.profile);
        let found = self.cuts_within(&bulging, tolerance, job);
        let within = |share: f64| move |points: &[Point]| ToleranceBand::plain(points.to_vec(), share * tolerance);
        found.or_else(|| CHORDS.into_iter().find_map(|share| self.cuts_within(&within(share), tolerance, job)))
    }

    /// The cuts of the runs along one curve within a band; `None` where no such curve was found.
    fn cuts_within(&self, band: &Band, tolerance: f64, job: &Job) -> Option<Vec<Cut>> {
        // Where the curve of a ring cannot be closed, limit its deviation at the ends instead.
        let ring = self.ring.as_ref().and_then(|ring| self.cuts_along(Some(ring), band, tolerance, job));
        ring.or_else(|| self.cuts_along(None, band, tolerance, job))
    }

    /// The cuts of the runs along one curve within a band: the closed curve of `ring`, if given.
    fn cuts_along(&self, ring: Option<&Run>, band: &Band, tolerance: f64, job: &Job) -> Option<Vec<Cut>> {
        let mut shares: Vec<f64> = vec![1.0; self.parts.len()];
        loop {
            let (first, smooth) = self.smooth(ring, &shares, band, [tolerance, job.profile.knife.width_mm])?;
            let cuts = self.along(&smooth, first, tolerance, job);
            if cuts.iter().all(Option::is_some) {
                return cuts.into_iter().collect();
            }
            for (share, _) in shares.iter_mut().zip(&cuts).filter(|(_, cut)| cut.is_none()) {
                *share = NARROWER.into_iter().find(|narrower| narrower < share)?;
            }
        }
    }

    /// Flags the chords of a polyline under the blade at the start of a part. The line starts at station `first`, and `lap` is
    /// the length of its ring, mm.
    fn under_plunge(part: &Part, points: &[Point], first: f64, lap: Option<f64>, width: f64) -> Vec<bool> {
        let stations = polyline::stations(points);
        let lap = lap.unwrap_or(2.0 * (stations[stations.len() - 1] + width));
        let is_under = |ends: &[f64]| {
            let way = (ends[0] - first - part.start).rem_euclid(lap);
            way < width || way + ends[1] - ends[0] > lap
        };
        stations.windows(2).map(is_under).collect()
    }

    /// A smooth curve along the line within a band, with a fraction of the tolerance under the blade at the start of each part.
    /// Returned with the parameter at which the line starts.
    fn smooth(
        &self,
        ring: Option<&Run>,
        shares: &[f64],
        band: &Band,
        [tolerance, width]: [f64; 2],
    ) -> Option<(f64, Smooth)> {
        let length = ring.map(|ring| polyline::length(&ring.points));
        let ring = ring.map(|ring| (run::extended(ring, tolerance, width), ring));
        let (points, junctions, first, lap) = match &ring {
            Some((ring, run)) => (&ring.points, &ring.junctions, ring.start, ring.lap(run)),
            None => (&self.points, &self.junctions, 0.0, None),
        };
        let near = if lap.is_some() { [Near::default(); 2] } else { self.near };
        let plain = || band(points).with_lap(lap);
        let band = || plain().with_ends(near);
        let under = |part: &Part| Self::under_plunge(part, points, first, length, width);
        let along = |band: &dyn Fn() -> ToleranceBand| {
            if shares.iter().all(|share| *share == 1.0) {
                return run::smoothed(band, junctions);
            }
            let parts = self.parts.iter().zip(shares).filter(|(_, share)| **share < 1.0);
            smooth(&parts.fold(band(), |band, (part, &share)| band.with_junctions(&under(part), share)))
        };
        // A ring whose curve is not closed is useless if its ends leave the line.
        let is_parted = ring.is_none() && self.ring.is_some();
        let found = along(&band).or_else(|tight| if is_parted { Err(tight) } else { along(&plain) });
        Some((first, found.ok()?))
    }

    /// The cuts of the runs along a curve on which the line starts at the parameter `first`. A cut is `None` if its blade would
    /// plunge too far beside its line, or at too great an angle to the curve where the line is straight.
    fn along(&self, smooth: &Smooth, first: f64, tolerance: f64, job: &Job) -> Vec<Option<Cut>> {
        let slack = LEAD_SHARE * job.profile.verify.max_heading_deg.to_radians();
        let band = ToleranceBand::new(self.points.clone(), tolerance, &job.profile);
        let cut = |part: &Part| {
            let order = Order::new(part.run, &part.extended, job);
            let Curved { cut, beside, lead } = order.curved(&part.extended, &part.stretch_of(smooth, first)).ok()?;
            let width = job.profile.knife.width_mm;
            let ends = [part.start, part.start + width.min(part.extended.end)];
            let turned = turned(&part.extended, width) + ends.map(|station| band.bow_at(station)).iter().sum::<f64>();
            (beside <= order.most_beside(tolerance) && lead.abs() <= turned + slack).then_some(cut)
        };
        self.parts.iter().map(cut).collect()
    }
}

/// Turn of a line under a blade that plunges at its start, including the first vertex ahead of it, where a curve turns earlier,
/// rad.
fn turned(extended: &Extended, width: f64) -> f64 {
    let under = extended.stations().take_while(|(_, station)| *station < width).count();
    let ahead = extended.stations().skip(under).take_while(|(_, station)| *station < 2.0 * width).take(1).count();
    let points = &extended.points;
    let inner = 1..(under + ahead).min(points.len() - 1);
    inner.map(|k| polyline::turn_at(points[k - 1], points[k], points[k + 1]).abs()).sum()
}

impl Part<'_> {
    /// The part of the common curve that belongs to this run; `first` is the parameter at which the line starts.
    fn stretch_of(&self, smooth: &Smooth, first: f64) -> Smooth {
        let from = first + self.start;
        Smooth { curve: smooth.curve.slice([from, from + self.extended.end]), sagitta: smooth.sagitta }
    }
}
