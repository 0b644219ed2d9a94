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
//! Leaves no run with the chord law that the blade cannot be a chord of.

use super::chord::{Tight, tight};
use super::scene::{Around, Scene};
use super::stretch::{REJOINED, Way};
use super::{ToolpathPass, overlap};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::polyline;
use crate::ir::toolpath::{Law, Run, Shape, Step, Toolpath};
use crate::machine::TightCurves;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "tight",
    about: "follows, nibbles or refuses curves that are tighter than the blade",
    run,
    chained: false,
};

/// Part of the tolerance by which a plunge may pass a vertex; rounding takes a little of the rest.
const NIBBLE_SHARE: f64 = 0.9;
/// Turn of a run without which the blade never stands across it, rad: a little less than the angle whose cosine is 0.4.
const TURN_MIN: f64 = 1.15;
/// Halvings that make plunges alike: to a thousandth of a curve, which is finer than its chords.
const HALVINGS: usize = 10;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    let knife = around.knife();
    if knife.width_mm == 0.0 {
        return;
    }
    let mut worst = Worst::default();
    for step in std::mem::take(&mut toolpath.steps) {
        let mut run = match step {
            Step::Run(run) => run,
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
                continue;
            }
        };
        let curves = tight_curves(&run, &around);
        if curves.is_empty() {
            toolpath.steps.push(Step::Run(run));
            continue;
        }
        let done = match knife.tight_curves {
            TightCurves::Nibble => Done::Nibbled,
            TightCurves::Follow if is_one_plunge(&run, &around) => Done::Nibbled,
            TightCurves::Follow => Done::Followed(run.law),
            TightCurves::Refuse => Done::Refused,
        };
        worst.see((&run, done), &curves);
        match done {
            Done::Nibbled => {
                for part in parts(&run, &curves, &around) {
                    worst.plunges += usize::from(part.is_plunge);
                    toolpath.steps.push(Step::Run(part.run));
                }
            }
            Done::Followed(_) | Done::Refused => {
                run.law = Law::Tangent;
                toolpath.steps.push(Step::Run(run));
            }
        }
    }
    worst.report(&around, diagnostics);
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
    let mut whole = run.clone();
    overlap::give(&mut whole, around);
    run.shape == Shape::Open && polyline::first_at_distance(&whole.extended(), around.knife().width_mm).is_none()
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
    let mut joined: Vec<Tight> = Vec::new();
    for next in tight(&whole, around.knife().width_mm) {
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

/// A part of a run, and whether it is meant to be one plunge.
struct Part {
    run: Run,
    is_plunge: bool,
}

/// What becomes of a run whose tight curves, one at least, are nibbled: what lies before, between and behind them, and the plunges.
fn parts(run: &Run, curves: &[Tight], around: &Around) -> Vec<Part> {
    let way = Way::new(run);
    let chords = way.chords();
    // A ring begins at its first tight curve and ends where that begins again; an open run has its own ends.
    let start = if way.is_ring() { *curves[0].vertices.start() } else { 0 };
    let end = start + chords;
    let station = |vertex: usize| way.station(vertex.cast_signed());
    // What lies before or behind a curve and is shorter than the blade is cut with it: it could only be a plunge, too.
    let is_short = |from: usize, to: usize| station(to) - station(from) < around.knife().width_mm;
    let mut stretches: Vec<[usize; 2]> = Vec::new();
    for curve in curves {
        let (from, to) = ((*curve.vertices.start()).max(start), (*curve.vertices.end()).min(end));
        let behind = stretches.last().map_or(start, |last| last[1]);
        let from = if is_short(behind, from) { behind } else { from };
        let to = if is_short(to, end) { end } else { to };
        match stretches.last_mut() {
            Some(last) if from <= last[1] => last[1] = to.max(last[1]),
            _ => stretches.push([from, to]),
        }
    }
    let mut parts = Vec::new();
    let mut add = |[from, to]: [usize; 2], is_plunge: bool| {
        let is_end = [from == 0, to == chords].map(|is_end| is_end && !way.is_ring());
        let ends = [0, 1].map(|i| if is_end[i] { run.ends[i] } else { REJOINED });
        parts.push(Part { run: way.part(station(from), station(to), ends), is_plunge });
    };
    let mut at = start;
    for [from, to] in stretches {
        if from > at {
            add([at, from], false);
        }
        for piece in nibbles(&way, [from, to], NIBBLE_SHARE * around.tolerance()) {
            add(piece, true);
        }
        at = to;
    }
    if at < end {
        add([at, end], false);
    }
    parts
}

/// The pieces of a stretch between two vertices, each within `allowed` of its chord: as few as there can be, and of these
/// the ones whose longest is shortest, because what the blade before has cut is no piece.
fn nibbles(way: &Way, stretch: [usize; 2], allowed: f64) -> Vec<[usize; 2]> {
    let station = |vertex: usize| way.station(vertex.cast_signed());
    let pieces = |longest: f64| {
        let [mut from, last] = stretch;
        let mut pieces = Vec::new();
        while from < last {
            let is_near = |to: usize| {
                let (a, b) = (way.vertex(from), way.vertex(to));
                (from + 1..to).all(|vertex| polyline::distance_to_segment(way.vertex(vertex), a, b) <= allowed)
            };
            let is_in = |to: &usize| station(*to) - station(from) <= longest && is_near(*to);
            // Twice as far each time, then halving: each look costs as much as it looks at.
            let (mut to, mut step) = (from + 1, 1);
            while to + step <= last && is_in(&(to + step)) {
                (to, step) = (to + step, 2 * step);
            }
            while step > 0 {
                if to + step <= last && is_in(&(to + step)) {
                    to += step;
                }
                step /= 2;
            }
            pieces.push([from, to]);
            from = to;
        }
        pieces
    };
    let length = station(stretch[1]) - station(stretch[0]);
    let fewest = pieces(length).len();
    let (mut low, mut high) = (0.0, length);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if pieces(middle).len() > fewest {
            low = middle;
        } else {
            high = middle;
        }
    }
    pieces(high)
}

/// The tightest curve of a toolpath.
#[derive(Default)]
struct Worst {
    curves: usize,
    plunges: usize,
    /// Its radius, mm, its source, and what is done about it.
    tightest: Option<(f64, Span, Done)>,
}

impl Worst {
    fn see(&mut self, (run, done): (&Run, Done), curves: &[Tight]) {
        self.curves += curves.len();
        for curve in curves {
            if self.tightest.is_none_or(|(radius, ..)| curve.radius < radius) {
                self.tightest = Some((curve.radius, run.spans[curve.at % run.spans.len()], done));
            }
        }
    }

    fn report(&self, around: &Around, diagnostics: &mut Diagnostics) {
        let Some((radius, span, done)) = self.tightest else { return };
        let width = around.knife().width_mm;
        let swing = fixed(radius.hypot(width) - radius, 2);
        let (code, done) = match done {
            Done::Followed(Law::Chord) => (
                &code::PATH_TIGHT_CURVE,
                format!("it cannot be its chord and follows the tangent, its heel off by up to {swing} mm"),
            ),
            Done::Followed(Law::Tangent) => {
                (&code::PATH_TIGHT_CURVE, format!("its heel leaves the line by up to {swing} mm"))
            }
            Done::Nibbled => (&code::PATH_TIGHT_CURVE, format!("nibbled with {} plunges", self.plunges)),
            Done::Refused => (&code::PATH_TIGHT_CURVE_REFUSED, "refused by `knife.tight_curves`".to_owned()),
        };
        let more = match self.curves - 1 {
            0 => String::new(),
            n => format!(" ({n} more in this contour)"),
        };
        let (block, radius, width) = (span.block, fixed(radius, 2), fixed(width, 2));
        let message = format!(
            "block {block}: a curve of radius {radius} mm is tighter than the blade of {width} mm: {done}{more}"
        );
        diagnostics.push(
            Diagnostic::new(code, message)
                .at(span)
                .hint("a narrower blade follows it; `knife.tight_curves` is \"follow\", \"nibble\" or \"refuse\""),
        );
    }
}
