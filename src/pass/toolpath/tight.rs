//! Pass `tight`: what is done about curves that are tighter than the blade.
//!
//! Needs runs split at corners. A curve is too tight where the blade, tip and tail on it, would stand across it: on an arc
//! of less than 0.55 blade widths, in a right angle that is rounded with less than 0.4. By `knife.tight_curves` it is
//!
//! - `follow`: cut without a lift. A run with such a curve has the tangent law: the blade cannot be its chord. One on which
//!   the blade has no way to go, a rounded notch, is nibbled: a single plunge would cut straight over it.
//! - `nibble`: cut by plunges without motion, each along as many chords as stay within the tolerance of it; on an arc of
//!   radius R that is a step of sqrt(8 R e), e being 0.9 of the tolerance. The blade is longer than that, so that they
//!   overlap, and beyond the step lies outside the curve, along its tangent.
//! - `refuse`: an error.
//!
//! A cut that begins on a curve is too tight there, too, when the blade that plunges as a chord of it would lie farther
//! beside it than `knife.max_bow_mm`: `follow` says so, and nibbles only what that blade cannot enter at all. Of a short curve
//! that it covers one plunge is made where nibbling would cut farther into the part than that leaves beside the line.
//!
//! Leaves no run with the chord law that the blade cannot be a chord of.

use super::bow::{BowedStart, bowed_start};
use super::chord::{Tight, tight};
use super::nibble::{self, parts};
use super::overlap::INSIDE_EPSILON;
use super::scene::{Around, Scene};
use super::{ToolpathPass, overlap};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::region::Ray;
use crate::geom::{left, polyline, ring};
use crate::ir::toolpath::{Law, Run, Shape, Side, Step, Toolpath};
use crate::machine::TightCurves;
use crate::source::Span;
use crate::units::number::{fixed, up};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "tight",
    about: "follows, nibbles or refuses curves that are tighter than the blade",
    run,
    chained: false,
};

/// Greatest turn of a curve that one straight plunge may stand for, rad (110 degrees): of a quarter circle, rounded.
const COVERED_TURN: f64 = 1.92;
/// Turn of a run without which the blade never stands across it, rad: a little less than the angle whose cosine is 0.4.
const TURN_MIN: f64 = 1.15;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    if around.knife().width_mm == 0.0 {
        return;
    }
    let mut settling =
        Settling { around, steps: Vec::new(), tight: Worst::default(), bowed: Bowed::default(), plunges: 0 };
    for step in std::mem::take(&mut toolpath.steps) {
        match step {
            Step::Run(run) => settling.settle(run),
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                settling.steps.push(step);
            }
        }
    }
    settling.report(diagnostics);
    toolpath.steps = settling.steps;
}

/// The steps of a toolpath whose tight curves are being settled, and what there is to say about them.
struct Settling<'a> {
    around: Around<'a>,
    steps: Vec<Step>,
    tight: Worst,
    bowed: Bowed,
    plunges: usize,
}

impl Settling<'_> {
    fn settle(&mut self, mut run: Run) {
        let around = self.around;
        let start = bowed_start(&run, &around);
        if let Some(start) = start.as_ref().filter(|start| self.is_best_covered(&run, start)) {
            if !start.bow.is_slight(&around) {
                self.bowed.see(start.bow.away, run.spans[0], Beside::Covered);
            }
            self.steps.push(Step::Run(run));
            return;
        }
        let mut curves = tight_curves(&run, &around);
        let policy = match around.knife().tight_curves {
            // Plunges around a hole that is narrower than the blade would all lead far into the part.
            TightCurves::Nibble if is_narrow_hole(&run, &curves, &around) => TightCurves::Follow,
            policy => policy,
        };
        let is_nibbled = match policy {
            TightCurves::Nibble => true,
            TightCurves::Follow => is_one_plunge(&run, &around),
            TightCurves::Refuse => false,
        };
        let done = match policy {
            _ if is_nibbled => Done::Nibbled,
            TightCurves::Nibble | TightCurves::Follow => Done::Followed(run.law),
            TightCurves::Refuse => Done::Refused,
        };
        // What the blade cannot enter is nibbled even where curves are followed, and what lies slightly beside it in any case.
        let is_start_nibbled = start.as_ref().is_some_and(|BowedStart { bow, .. }| match done {
            Done::Nibbled => true,
            Done::Followed(_) => !bow.fits,
            Done::Refused => bow.is_slight(&around),
        });
        // Behind a start that alone is nibbled the rest is settled, and seen, by itself.
        let behind =
            start.as_ref().filter(|_| is_start_nibbled && !is_nibbled).map(|start| *start.curve.vertices.end());
        for curve in curves.iter().filter(|curve| behind.is_none_or(|end| *curve.vertices.start() <= end)) {
            self.tight.see(curve, run.spans[curve.at % run.spans.len()], done);
        }
        if let Some(start) = start.as_ref().filter(|start| !start.bow.is_slight(&around))
            && (curves.is_empty() || matches!(done, Done::Followed(_)))
        {
            self.bowed.see(start.bow.away, run.spans[0], if is_start_nibbled { Beside::Nibbled } else { done.into() });
        }
        if !is_nibbled && !curves.is_empty() {
            run.law = Law::Tangent;
        }
        if !is_nibbled {
            curves.clear();
        }
        if let (Some(start), true) = (start, is_start_nibbled) {
            curves.insert(0, start.curve);
        }
        if curves.is_empty() {
            self.steps.push(Step::Run(run));
            return;
        }
        for part in parts(&run, &joined(curves), &around) {
            if part.is_plunge {
                self.plunges += 1;
                self.steps.push(Step::Run(part.run));
            } else {
                self.settle(part.run);
            }
        }
    }

    /// Whether one plunge over all of a short curve harms less than nibbling it: it leaves what lies between the blade and the
    /// curve, where shorter cuts with the same blade would reach farther than that into the part.
    fn is_best_covered(&self, run: &Run, BowedStart { bow, curve }: &BowedStart) -> bool {
        let around = &self.around;
        let is_refused = around.knife().tight_curves == TightCurves::Refuse && !bow.is_slight(around);
        // What is lifted amid a contour is a part of one that goes on.
        let is_part = run.ends.iter().any(|end| end.side == Side::Contour);
        bow.is_whole
            && bow.fits
            && bow.turned <= COVERED_TURN
            && !is_refused
            && !is_part
            && bow.away < nibble::harm(run, curve, around)
    }

    fn nibbled(&self) -> String {
        format!("nibbled with {} plunge{}", self.plunges, if self.plunges == 1 { "" } else { "s" })
    }

    fn report(&self, diagnostics: &mut Diagnostics) {
        self.tight.report(self, diagnostics);
        self.bowed.report(self, diagnostics);
    }
}

/// What is done about a tight curve.
#[derive(Debug, Clone, Copy)]
enum Done {
    /// It is cut without a lift; its run was to have this law.
    Followed(Law),
    Nibbled,
    Refused,
}

/// Whether all of an open run is so near to its start that the blade has no way to go on it, and would cut across.
fn is_one_plunge(run: &Run, around: &Around) -> bool {
    if run.shape == Shape::Ring {
        return false;
    }
    let knife = around.knife();
    let heel = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm).max(knife.reflex_heel_overlap_mm);
    let reach = knife.width_mm + heel + INSIDE_EPSILON;
    if run.points.iter().any(|point| (point - run.points[0]).norm() > reach) {
        // Nearly always: whatever room there is for overlaps.
        return false;
    }
    let mut whole = run.clone();
    overlap::give(&mut whole, around);
    polyline::first_at_distance(&whole.extended(), around.knife().width_mm).is_none()
}

/// Whether a ring is too tight for the blade all around, and the part lies outside of it.
fn is_narrow_hole(run: &Run, curves: &[Tight], around: &Around) -> bool {
    let chords = run.points.len() - 1;
    let is_narrow = curves.iter().any(|curve| curve.vertices.end() - curve.vertices.start() >= chords);
    let is_in_part = || {
        // Left of a ring that runs counter-clockwise is its inside.
        let [from, to] = [run.points[0], run.points[1]];
        let outward = -left(to - from).normalize() * ring::area(&run.points).signum();
        let ray = Ray { from: from + (to - from) * 0.5, along: outward, reach: around.knife().width_mm };
        around.room(&ray).own <= INSIDE_EPSILON
    };
    run.shape == Shape::Ring && is_narrow && is_in_part()
}

/// The stretches of a run that are too tight, those that meet joined. A smooth contour that is narrower than the blade is
/// one of them as a whole.
fn tight_curves(run: &Run, around: &Around) -> Vec<Tight> {
    let turned: f64 = run.points.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]).abs()).sum();
    if run.shape == Shape::Open && turned < TURN_MIN {
        return Vec::new();
    }
    let mut whole = run.clone();
    overlap::give(&mut whole, around);
    joined(tight(&whole, around.knife().width_mm))
}

/// Curves in order, those that meet joined.
fn joined(curves: Vec<Tight>) -> Vec<Tight> {
    let mut joined: Vec<Tight> = Vec::new();
    for next in curves {
        match joined.last_mut() {
            Some(last) if next.vertices.start() <= last.vertices.end() => {
                let end = *last.vertices.end().max(next.vertices.end());
                let tighter = if next.radius < last.radius { &next } else { &*last };
                *last = Tight { vertices: *last.vertices.start()..=end, radius: tighter.radius, at: tighter.at };
            }
            _ => joined.push(next),
        }
    }
    joined
}

/// The tightest curve of a toolpath.
#[derive(Default)]
struct Worst {
    curves: usize,
    /// Its radius, mm, its source, and what is done about it.
    tightest: Option<(f64, Span, Done)>,
}

impl Worst {
    fn see(&mut self, curve: &Tight, span: Span, done: Done) {
        self.curves += 1;
        if self.tightest.is_none_or(|(radius, ..)| curve.radius < radius) {
            self.tightest = Some((curve.radius, span, done));
        }
    }

    fn report(&self, settling: &Settling, diagnostics: &mut Diagnostics) {
        let Some((radius, span, done)) = self.tightest else { return };
        let knife = settling.around.knife();
        let swing = fixed(radius.hypot(knife.width_mm) - radius, 2);
        let (code, done, hint) = match done {
            Done::Followed(law) => {
                let done = match law {
                    Law::Chord => {
                        format!("it cannot be its chord and follows the tangent, its heel off by up to {swing} mm")
                    }
                    Law::Tangent => format!("its heel leaves the line by up to {swing} mm"),
                };
                let hint = "a narrower blade leaves it less; `knife.tight_curves` is \"nibble\" for cuts by plunges, \"refuse\" for an error";
                (&code::PATH_TIGHT_CURVE, done, hint)
            }
            Done::Nibbled => {
                let hint = match knife.tight_curves {
                    TightCurves::Nibble => {
                        "a narrower blade can follow it; `knife.tight_curves` is \"follow\" for cuts without a lift, \"refuse\" for an error"
                    }
                    TightCurves::Follow | TightCurves::Refuse => "a narrower blade has a way to go on it",
                };
                (&code::PATH_TIGHT_CURVE, settling.nibbled(), hint)
            }
            Done::Refused => (&code::PATH_TIGHT_CURVE_REFUSED, REFUSED.to_owned(), HOW_TO_CUT),
        };
        let more = and_more(self.curves);
        let (radius, width) = (fixed(radius, 2), fixed(knife.width_mm, 2));
        let message = format!("a curve of radius {radius} mm is tighter than the blade of {width} mm: {done}{more}");
        diagnostics.push(Diagnostic::new(code, message).at(span).hint(hint));
    }
}

/// What is said of what `knife.tight_curves` refuses, and what else there is.
const REFUSED: &str = "refused by `knife.tight_curves`";
const HOW_TO_CUT: &str =
    "a narrower blade follows it; `knife.tight_curves` is \"follow\" or \"nibble\" for what is to be cut all the same";

/// What is done about a plunged blade beside which the start of a run lies.
#[derive(Debug, Clone, Copy)]
enum Beside {
    /// It cuts beside the line.
    Left,
    /// The start is cut by several plunges.
    Nibbled,
    /// One plunge cuts all of the run.
    Covered,
    Refused,
}

impl From<Done> for Beside {
    fn from(done: Done) -> Self {
        match done {
            Done::Followed(_) => Self::Left,
            Done::Nibbled => Self::Nibbled,
            Done::Refused => Self::Refused,
        }
    }
}

/// The start of a toolpath's runs that bows the most away from the blade that plunges there.
#[derive(Default)]
struct Bowed {
    starts: usize,
    /// How far, mm, its source, and what is done about it.
    worst: Option<(f64, Span, Beside)>,
}

impl Bowed {
    fn see(&mut self, away: f64, span: Span, beside: Beside) {
        self.starts += 1;
        if self.worst.is_none_or(|(worst, ..)| away > worst) {
            self.worst = Some((away, span, beside));
        }
    }

    fn report(&self, settling: &Settling, diagnostics: &mut Diagnostics) {
        let Some((bowed, span, beside)) = self.worst else { return };
        let (code, done, hint) = match beside {
            Beside::Left => {
                let hint = "`knife.tight_curves = \"nibble\"` cuts such starts by steps, from `knife.max_bow_mm` on";
                (&code::PATH_BOWED_PLUNGE, "it cuts that far beside the line".to_owned(), hint)
            }
            Beside::Nibbled => {
                let done = settling.nibbled();
                (&code::PATH_BOWED_PLUNGE, done, "a start that bows less is cut without a lift")
            }
            Beside::Covered => {
                let done = "one plunge cuts all of it, because several would reach farther into the part".to_owned();
                (
                    &code::PATH_BOWED_PLUNGE,
                    done,
                    "what lies between the blade and the line stays on the part, or is cut off it",
                )
            }
            Beside::Refused => (&code::PATH_TIGHT_CURVE_REFUSED, REFUSED.to_owned(), HOW_TO_CUT),
        };
        let (away, more) = (up(bowed, 2), and_more(self.starts));
        let width = fixed(settling.around.knife().width_mm, 2);
        let message = format!(
            "a cut begins on a curve, which bows {away} mm away from the plunged blade of {width} mm: {done}{more}"
        );
        diagnostics.push(
            Diagnostic::new(code, message)
                .at(span)
                .by(bowed)
                .hint("a narrower blade bows less; so does a corner that is drawn where the outline is straighter")
                .hint(hint),
        );
    }
}

/// How many others like the one that is named there are.
pub(super) fn and_more(count: usize) -> String {
    match count - 1 {
        0 => String::new(),
        n => format!(" ({n} more in this contour)"),
    }
}
