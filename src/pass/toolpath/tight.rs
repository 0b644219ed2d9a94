//! Pass `tight`: what is done about curves that are tighter than the blade.
//!
//! Needs runs split at corners. A curve is too tight where the blade, tip and heel on it, would stand across it: on an arc
//! of less than 0.55 blade widths, in a right angle that is rounded with less than 0.4. By `knife.tight_curves` it is
//!
//! - `follow`: cut without a lift. A run with such a curve has the tangent mode: the blade cannot be its
//!   chord. One on which the blade has no way to go, a rounded notch, is nibbled: a single plunge would cut straight
//!   over it.
//! - `nibble`: cut by plunges without motion, each along as many chords as stay within the tolerance of it; on an arc of
//!   radius R that is a step of sqrt(8 R e), e being 0.9 of the tolerance. The blade is longer than that, so that they
//!   overlap, and beyond the step lies outside the curve, along its tangent.
//! - `refuse`: an error.
//!
//! A cut that begins on a curve is too tight there, too, when the blade that plunges as a chord of it would lie farther
//! beside it than `knife.max_bow_mm`: `follow` says so, and nibbles only what that blade cannot enter at all. Of a
//! short curve that it covers one plunge is made where nibbling would cut farther into the part than that leaves beside
//! the line.
//!
//! Leaves no run with the chord mode that the blade cannot be a chord of.

use super::bend;
use super::entry::split;
use super::nibble::{nibbled, worst_overcut};
use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::start::{CurvedStart, curved_start};
use super::tight_report::{Report, Treatment};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{Plunge, overlaps};
use crate::analysis::tight::{TightCurve, joined, tight_curves};
use crate::diagnostic::Diagnostics;
use crate::geom::region::Ray;
use crate::geom::{Point, left, polyline, ring};
use crate::ir::toolpath::{OrientationMode, Run, Shape, Side, Toolpath};
use crate::machine::TightCurves;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "tight",
    about: "follows, nibbles or refuses curves that are tighter than the blade",
    run,
    chained: false,
};

/// Greatest turn of a curve that one straight plunge may stand for, rad (110 degrees): of a quarter circle, rounded.
const COVERED_TURN: f64 = 1.92;

/// Least cosine of a line with the blade that cuts along it (57 degrees).
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

/// The runs that a run with its tight curves is cut as.
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
        // Along the tangent its heel swings farther than as a chord; the blade may be a chord of a part of it.
        let followed = Run { orientation: OrientationMode::Tangent, ..run.clone() };
        let parts = bend::split(followed, around.knife);
        if parts.len() > 1 {
            let parts = parts.into_iter().map(|part| Run { orientation: run.orientation, ..part });
            let parts = parts.flat_map(|part| split(part, around));
            return parts.flat_map(|part| treated(part, around, report)).collect();
        }
    }
    let nibbled_start = start.as_ref().filter(|start| is_start_nibbled(start, treatment, around));
    // Behind a start that alone is nibbled the rest is treated, and seen, by itself.
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

/// What is done about the tight curves of a run.
fn treatment(run: &Run, curves: &[TightCurve], around: &Surroundings) -> Treatment {
    match around.knife.tight_curves {
        TightCurves::Refuse => Treatment::Refused,
        // Plunges around a hole that is narrower than the blade would all lead far into the part.
        TightCurves::Nibble if !is_narrow_hole(run, curves, around) => Treatment::Nibbled,
        TightCurves::Nibble | TightCurves::Follow if is_one_plunge(run, around) => Treatment::Nibbled,
        TightCurves::Nibble | TightCurves::Follow => Treatment::Followed(run.orientation),
    }
}

/// Whether the curve on which a run begins is nibbled: what the blade cannot enter, or covers, even where curves are
/// followed, and where they are refused what it lies slightly beside.
fn is_start_nibbled(start: &CurvedStart, treatment: Treatment, around: &Surroundings) -> bool {
    match treatment {
        Treatment::Nibbled => true,
        Treatment::Followed(_) => !start.deviation.fits || start.deviation.covers_all,
        Treatment::Refused => start.deviation.is_slight(around),
        Treatment::Covered => false,
    }
}

/// Whether one plunge over all of a short curve cuts less into the part than nibbling it: it leaves what lies between the
/// blade and the curve, where shorter cuts with the same blade would reach farther than that into the part.
fn is_best_covered(run: &Run, CurvedStart { deviation, curve }: &CurvedStart, around: &Surroundings) -> bool {
    let is_refused = around.knife.tight_curves == TightCurves::Refuse && !deviation.is_slight(around);
    // What is lifted amid a contour is a part of one that goes on.
    let is_part = run.ends.iter().any(|end| end.side == Side::Contour);
    deviation.covers_all
        && deviation.fits
        && deviation.turned <= COVERED_TURN
        && !is_refused
        && !is_part
        && leads_along(run)
        && deviation.distance < worst_overcut(run, curve, around)
}

/// Whether a run leads along its chord from its first piece to its last, and nowhere across it: there a blade would cut through
/// the line, not along it.
fn leads_along(run: &Run) -> bool {
    let points = &run.points;
    let blade = Plunge::over(points).blade();
    let across = |(from, to): (Point, Point)| {
        polyline::direction(from, to).is_some_and(|along| along.dot(&blade) < ALONG * blade.norm())
    };
    let last = points.len() - 1;
    ![(points[0], points[1]), (points[last - 1], points[last])].into_iter().any(across)
}

/// Whether all of an open run is so near to its start that the blade has no way to go on it, and would cut across.
fn is_one_plunge(run: &Run, around: &Surroundings) -> bool {
    if run.shape == Shape::Ring {
        return false;
    }
    let path = run.extended_by(overlaps(run, around).map(|overlap| overlap.length));
    Plunge::at_start(&path, around.knife.width_mm).covers_all
}

/// Whether a ring is too tight for the blade all around, and the part lies outside of it.
fn is_narrow_hole(run: &Run, curves: &[TightCurve], around: &Surroundings) -> bool {
    let chords = run.points.len() - 1;
    let is_narrow = curves.iter().any(|curve| curve.vertices.end() - curve.vertices.start() >= chords);
    let is_in_part = || {
        // Left of a ring that runs counter-clockwise is its inside.
        let [from, to] = [run.points[0], run.points[1]];
        let outward = -left(to - from).normalize() * ring::area(&run.points).signum();
        around.leads_inside(&Ray { from: from + (to - from) * 0.5, along: outward, reach: around.knife.width_mm })
    };
    run.shape == Shape::Ring && is_narrow && is_in_part()
}
