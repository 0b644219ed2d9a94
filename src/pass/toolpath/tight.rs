//! Pass `tight`: treats curves that are tighter than the blade.
//!
//! Needs runs split at corners. A curve is too tight where the blade, tip and heel on it, would stand across it: on an arc of
//! radius below 0.55 blade widths, or in a right angle rounded with less than 0.4. `knife.tight_curves` selects the treatment:
//!
//! - `follow`: cut without a lift. A run with such a curve gets the tangent mode, since the blade cannot be its chord. A run
//!   without room for the blade to move, such as a rounded notch, is nibbled: a single plunge would cut straight over it.
//! - `nibble`: cut by plunges without motion, each along as many chords as stay within the tolerance of it. On an arc of radius
//!   R the step is sqrt(8 R e), where e is 0.9 of the tolerance. The blade is longer than the step, so that the plunges
//!   overlap; beyond the step it lies outside the curve, along its tangent.
//! - `refuse`: an error.
//!
//! The start of a cut on a curve is too tight as well if the blade, plunged as a chord, would lie farther beside it than
//! `knife.max_bow_mm`. `follow` reports that, and nibbles only what the blade cannot enter at all. A short curve that the blade
//! covers is cut by one plunge if nibbling would cut farther into the part than the plunge leaves beside the line.
//!
//! Leaves no run in chord mode of which the blade cannot be a chord.

use super::bend;
use super::entry::split;
use super::nibble::{nibbled, worst_overcut};
use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::start::{CurvedStart, curved_start};
use super::tight_report::{Report, Treatment};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{Leeway, Plunge, overlaps};
use crate::analysis::tight::{TightCurve, joined, tight_curves};
use crate::diagnostic::Diagnostics;
use crate::geom::region::Ray;
use crate::geom::{Point, left, ring};
use crate::ir::toolpath::{OrientationMode, Run, Shape, Side, Toolpath};
use crate::machine::TightCurves;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "tight",
    about: "follows, nibbles or refuses curves that are tighter than the blade",
    run,
    chained: false,
};

/// Greatest turn of a curve that one straight plunge may replace, rad (110 degrees): a quarter circle, rounded.
const COVERED_TURN: f64 = 1.92;

/// Least cosine of the angle between a line and the blade that cuts along it (57 degrees).
const ALONG: f64 = 0.55;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    if around.knife.width_mm == 0.0 {
        return;
    }
    let mut report = Report::new(around.knife);
    runs::replace(toolpath, |run| treated(run, &around, &mut report));
    report.say(diagnostics);
}

/// Splits and treats a run with its tight curves.
fn treated(run: Run, around: &Surroundings, report: &mut Report) -> Vec<Run> {
    let start = curved_start(&run, around);
    if let Some(start) = start.as_ref().filter(|start| is_best_covered(&run, start, around)) {
        if !start.deviation.is_slight(around) {
            report.see_start(start, &run, Treatment::Covered);
        }
        return vec![run];
    }
    let curves = tight_curves(&run, around);
    if curves.is_empty() && start.is_none() {
        return vec![run];
    }
    let treatment = treatment(&run, &curves, around);
    if treatment == Treatment::Followed(OrientationMode::Chord) && !curves.is_empty() {
        // Along the tangent its heel swings out farther than as a chord; the blade may be a chord of a part of the run.
        let followed = Run { orientation: OrientationMode::Tangent, ..run.clone() };
        let parts = bend::split(followed, around.knife);
        if parts.len() > 1 {
            let parts = parts.into_iter().map(|part| Run { orientation: run.orientation, ..part });
            let parts = parts.flat_map(|part| split(part, around));
            return parts.flat_map(|part| treated(part, around, report)).collect();
        }
    }
    let nibbled_start = start.as_ref().filter(|start| is_start_nibbled(start, treatment, around));
    // If only the start is nibbled, the rest is treated and reported by itself.
    let alone = nibbled_start.filter(|_| treatment != Treatment::Nibbled).map(|start| *start.curve.vertices.end());
    for curve in curves.iter().filter(|curve| alone.is_none_or(|end| *curve.vertices.start() <= end)) {
        report.see_curve(curve, &run, treatment);
    }
    if let Some(start) = start.as_ref().filter(|start| !start.deviation.is_slight(around))
        && (curves.is_empty() || matches!(treatment, Treatment::Followed(_)))
    {
        let treatment = if nibbled_start.is_some() { Treatment::Nibbled } else { treatment };
        report.see_start(start, &run, treatment);
    }
    let (run, curves) = match treatment {
        Treatment::Nibbled => (run, curves),
        // The blade cannot be a chord of a run with tight curves.
        _ if !curves.is_empty() => (Run { orientation: OrientationMode::Tangent, ..run }, Vec::new()),
        _ => (run, curves),
    };
    let curves = joined(nibbled_start.map(|start| start.curve.clone()).into_iter().chain(curves).collect());
    if curves.is_empty() {
        return vec![run];
    }
    let mut runs = Vec::new();
    for stretch in nibbled(&run, &curves, around) {
        if stretch.is_plunge {
            report.plunges += 1;
            runs.push(stretch.run);
        } else {
            let parts = split(stretch.run, around);
            runs.extend(parts.into_iter().flat_map(|part| treated(part, around, report)));
        }
    }
    runs
}

/// Treatment of the tight curves of a run.
fn treatment(run: &Run, curves: &[TightCurve], around: &Surroundings) -> Treatment {
    match around.knife.tight_curves {
        TightCurves::Refuse => Treatment::Refused,
        // Plunges around a hole narrower than the blade would all reach far into the part.
        TightCurves::Nibble if !is_narrow_hole(run, curves, around) => Treatment::Nibbled,
        TightCurves::Nibble | TightCurves::Follow if is_one_plunge(run, around) => Treatment::Nibbled,
        TightCurves::Nibble | TightCurves::Follow => Treatment::Followed(run.orientation),
    }
}

/// True if the curve at the start of a run is nibbled. Where curves are followed, that is one which the blade cannot enter, which
/// it covers or on which it has no way to turn; where they are refused, one from which it deviates only slightly.
fn is_start_nibbled(start: &CurvedStart, treatment: Treatment, around: &Surroundings) -> bool {
    match treatment {
        Treatment::Nibbled => true,
        Treatment::Followed(_) => !start.deviation.fits || start.deviation.is_one_plunge(),
        Treatment::Refused => start.deviation.is_slight(around),
        Treatment::Covered => false,
    }
}

/// True if one plunge over all of a short curve cuts less into the part than nibbling. The plunge leaves the strip between
/// blade and curve uncut, where shorter cuts with the same blade would reach farther than that into the part.
fn is_best_covered(run: &Run, CurvedStart { deviation, curve }: &CurvedStart, around: &Surroundings) -> bool {
    let is_refused = around.knife.tight_curves == TightCurves::Refuse && !deviation.is_slight(around);
    // A run lifted amid a contour is only a part of it.
    let is_part = run.ends.iter().any(|end| end.side == Side::Contour);
    deviation.leeway == Leeway::None
        && deviation.fits
        && deviation.turned <= COVERED_TURN
        && !is_refused
        && !is_part
        && leads_along(run, around)
        && deviation.distance < worst_overcut(run, curve, around)
}

/// True if a run leads along its blade at both ends; across it, the blade would cut through the line. Its direction at an end
/// is that as far as it lies on the blade: the steps of rounded points turn single chords.
fn leads_along(run: &Run, around: &Surroundings) -> bool {
    let points = &run.points;
    let blade = Plunge::over(points);
    let is_on = |point: &Point| blade.distance(*point) <= around.tolerance;
    let last = points.len() - 1;
    let ahead = (1..=last).find(|&i| !is_on(&points[i])).map_or(last, |i| (i - 1).max(1));
    let behind = (0..last).rev().find(|&i| !is_on(&points[i])).map_or(0, |i| (i + 1).min(last - 1));
    let ends = [points[ahead] - points[0], points[last] - points[behind]];
    ends.iter().all(|along| along.dot(&blade.blade()) >= ALONG * along.norm() * blade.blade().norm())
}

/// True if an open run ends so near to its start that the blade has no room to move on it.
fn is_one_plunge(run: &Run, around: &Surroundings) -> bool {
    if run.shape == Shape::Ring {
        return false;
    }
    let path = run.extended_by(overlaps(run, around).map(|overlap| overlap.length));
    Plunge::at_start(&path, around.knife.width_mm).covers_all
}

/// True if a ring is too tight for the blade all around, and the part lies outside of it.
fn is_narrow_hole(run: &Run, curves: &[TightCurve], around: &Surroundings) -> bool {
    let chords = run.points.len() - 1;
    let is_narrow = curves.iter().any(|curve| curve.vertices.end() - curve.vertices.start() >= chords);
    let is_in_part = || {
        // The inside of a counter-clockwise ring is on its left.
        let [from, to] = [run.points[0], run.points[1]];
        let outward = -left(to - from).normalize() * ring::area(&run.points).signum();
        around.leads_inside(&Ray { from: from + (to - from) * 0.5, along: outward, reach: around.knife.width_mm })
    };
    run.shape == Shape::Ring && is_narrow && is_in_part()
}
