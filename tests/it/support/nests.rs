//! Nests of parts that touch, as CAD makes them: a cloth divided again and again by slanted lines and gentle S curves. What
//! lies between is a part; both sides of a line are drawn by themselves, with points of their own, rounded by themselves.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::{Point, Vector, left, polyline};
use cutc::machine::Job;
use cutc::pipeline::{self, Compiled, Notches, Order, Verdict};
use cutc::source::Source;
use fastrand::Rng;

use super::cloth::{Cloth, Edge};

/// Gaps between parts, mm; negative: they overlap.
const GAPS: [f64; 5] = [-0.2, -0.1, 0.0, 0.1, 0.5];
/// Which notches stand in a nest.
const MIXTURES: [&[Form]; 6] = [
    &[Form::V, Form::Box, Form::Castle],
    &[Form::U, Form::OutwardV],
    &[Form::Slit, Form::T, Form::Miss],
    &[Form::V, Form::Box, Form::Castle, Form::U, Form::OutwardV, Form::Slit, Form::T, Form::Miss],
    &[Form::T, Form::U, Form::OutwardV, Form::Miss],
    &[],
];
/// How near to an end of an edge a notch stands, mm.
const LEAST: f64 = 12.0;
/// What a point of an edge stays away from a mouth, mm.
const BESIDE: f64 = 1.6;
/// How far about a curve is from its chords, mm.
const SAGITTA: f64 = 0.0125;
/// Where the cloth begins, mm: no coordinate is negative.
const AT: f64 = 50.0;

/// What is drawn at an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    V,
    /// A slit as two lines, 0.1 mm apart.
    Box,
    Castle,
    U,
    OutwardV,
    /// A slit as a stroke of its own.
    Slit,
    /// The same with a crossbar.
    T,
    /// A slit that begins short of its edge.
    Miss,
}

impl Form {
    /// Half of the stretch of the edge on which it stands, mm.
    fn half(self) -> f64 {
        match self {
            Self::V => 1.0,
            Self::Box => 0.05,
            Self::Castle | Self::U | Self::OutwardV | Self::Slit | Self::T | Self::Miss => 2.0,
        }
    }

    /// What the outline draws between the ends of that, along it and into the part, mm.
    fn outline(self) -> Vec<(f64, f64)> {
        let half = self.half();
        match self {
            Self::V => vec![(0.0, 5.0)],
            Self::OutwardV => vec![(0.0, -4.0)],
            Self::Box => vec![(-half, 5.0), (half, 5.0)],
            Self::Castle => vec![(-half, 4.0), (half, 4.0)],
            Self::U => {
                (0..=8).map(|k| PI * f64::from(k) / 8.0).map(|a| (-half * a.cos(), 3.0 + half * a.sin())).collect()
            }
            Self::Slit | Self::T | Self::Miss => Vec::new(),
        }
    }

    /// The strokes that are drawn beside the outline.
    fn strokes(self) -> &'static [[(f64, f64); 2]] {
        match self {
            Self::Slit => &[[(0.0, 0.0), (0.0, 6.0)]],
            Self::T => &[[(0.0, 0.0), (0.0, 5.0)], [(-2.5, 5.0), (2.5, 5.0)]],
            Self::Miss => &[[(0.0, 0.3), (0.0, 5.0)]],
            Self::V | Self::Box | Self::Castle | Self::U | Self::OutwardV => &[],
        }
    }

    fn count(self, notches: &mut Notches) {
        *match self {
            Self::V => &mut notches.v,
            Self::Box | Self::Slit | Self::Miss => &mut notches.slit,
            Self::Castle => &mut notches.castle,
            Self::U => &mut notches.u,
            Self::OutwardV => &mut notches.v_out,
            Self::T => &mut notches.t,
        } += 1;
    }
}

/// What a nest is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recipe {
    pub(crate) seed: u64,
    pub(crate) parts: usize,
    pub(crate) gap: f64,
    pub(crate) forms: &'static [Form],
    /// Both parts of an edge have their notches at the same places.
    pub(crate) is_facing: bool,
    /// In hundredths of an inch, else in tenths of a millimetre.
    pub(crate) is_inch: bool,
    /// How far each part is moved at the most, mm.
    pub(crate) jitter: f64,
}

/// A file with the notches that stand in it.
pub(crate) struct Nest {
    pub(crate) text: String,
    pub(crate) notches: Notches,
}

impl Recipe {
    /// That of a seed, of so many parts and some more: neighbouring seeds differ in everything.
    pub(crate) fn of(seed: u64, parts: usize, more: usize) -> Self {
        let pick = seed as usize;
        Self {
            seed,
            parts: parts + pick * 7 % (more + 1),
            gap: GAPS[pick % GAPS.len()],
            forms: MIXTURES[pick / GAPS.len() % MIXTURES.len()],
            is_facing: pick / 2 % 2 == 1,
            is_inch: pick / 4 % 2 == 1,
            jitter: [0.0, 0.05][pick / 3 % 2],
        }
    }

    /// The nest: the same recipe, the same bytes.
    pub(crate) fn nest(&self) -> Nest {
        let mut rng = Rng::with_seed(self.seed);
        let cloth = Cloth::divided(self.parts, &mut rng);
        let unit = if self.is_inch { 0.254 } else { 0.1 };
        let xy = |at: Point| format!("X{:.0}Y{:.0}*", (at.x + AT) / unit, (at.y + AT) / unit);
        let line = |points: &[Point]| {
            let mut blocks: Vec<String> = points.iter().map(|&at| xy(at)).collect();
            blocks.dedup();
            format!("{}M14*{}M15*", blocks[0], blocks[1..].concat())
        };
        let places: Vec<[f64; 2]> =
            cloth.curves.iter().map(|_| [rng.f64() * 0.35 + 0.1, rng.f64() * 0.35 + 0.55]).collect();
        let mut text = String::from(if self.is_inch { "G91*" } else { "H1*G71*" });
        let mut notches = Notches::default();
        for (part, number) in cloth.parts.iter().zip(1..) {
            let mut ring = Vec::new();
            for &edge in part {
                ring.extend(self.side(&cloth, edge, &places[edge.curve], &mut rng));
            }
            let moved = Vector::new(2.0 * rng.f64() - 1.0, 2.0 * rng.f64() - 1.0) * self.jitter;
            let at: Vec<Point> = drawn_in(&ring, self.gap / 2.0).into_iter().map(|at| at + moved).collect();
            let (mut outline, mut strokes) = (Vec::new(), Vec::new());
            for (i, &(_, form)) in ring.iter().enumerate() {
                outline.push(at[i]);
                let Some(form) = form else { continue };
                form.count(&mut notches);
                let (from, to) = (at[i], at[(i + 1) % at.len()]);
                let along = (to - from).normalize();
                let place = |(x, y): (f64, f64)| from + (to - from) / 2.0 + along * x + left(along) * y;
                outline.extend(form.outline().into_iter().map(place));
                strokes.extend(form.strokes().iter().map(|ends| ends.map(place)));
            }
            let start = rng.usize(..outline.len());
            outline.rotate_left(start);
            if rng.bool() {
                outline.reverse();
            }
            outline.push(outline[0]);
            let _infallible = write!(text, "N{number}*M15*{}", line(&outline));
            for stroke in strokes {
                let _infallible = write!(text, "M19*{}", line(&stroke));
            }
        }
        Nest { text: text + "M0*\n", notches }
    }

    /// An edge as one part draws it, without its end: points, each with what stands between it and the next.
    fn side(&self, cloth: &Cloth, edge: Edge, places: &[f64], rng: &mut Rng) -> Vec<(Point, Option<Form>)> {
        let (curve, length) = (&cloth.curves[edge.curve], cloth.length(edge));
        let per_mm = (edge.to - edge.from) / length;
        let stations: Vec<f64> = if self.is_facing {
            places.iter().map(|place| (place - edge.from) / per_mm).collect()
        } else {
            let count = [0, 0, 1, 1, 1 + usize::from(length > 150.0)][rng.usize(..5)];
            (0..count).map(|k| length * (0.3 + 0.4 * k as f64 + 0.15 * (rng.f64() - 0.5))).collect()
        };
        let mut stations: Vec<f64> =
            stations.into_iter().filter(|station| (LEAST..length - LEAST).contains(station)).collect();
        stations.sort_by(f64::total_cmp);
        let notches: Vec<(f64, Form)> =
            stations.iter().filter_map(|&station| Some((station, rng.choice(self.forms).copied()?))).collect();
        let chord = [edge.from, edge.to].map(|t| curve.at(t));
        let bow =
            cloth.points(edge).map(|at| polyline::distance_to_segment(at, chord[0], chord[1])).fold(0.0, f64::max);
        let steps =
            if bow < 0.02 { 1 } else { ((bow / SAGITTA).sqrt() * (0.8 + 0.4 * rng.f64())).ceil().max(3.0) as usize };
        let step = |k: usize| length * (k as f64 + if k > 0 { 0.5 * (rng.f64() - 0.5) } else { 0.0 }) / steps as f64;
        let points = (0..steps).map(step).map(|station| (station, None));
        let is_free = |station: f64| notches.iter().all(|(at, form)| (station - at).abs() > form.half() + BESIDE);
        let mut all: Vec<(f64, Option<Form>)> = points.filter(|&(station, _)| is_free(station)).collect();
        for &(station, form) in &notches {
            all.extend([(station - form.half(), Some(form)), (station + form.half(), None)]);
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().map(|(station, form)| (curve.at(edge.from + station * per_mm), form)).collect()
    }
}

/// The places of a ring moved into it.
fn drawn_in(ring: &[(Point, Option<Form>)], by: f64) -> Vec<Point> {
    let at = |i: usize| ring[i % ring.len()].0;
    let moved = |i: usize| {
        let [before, behind] = [i + ring.len() - 1, i].map(|i| left((at(i + 1) - at(i)).normalize()));
        at(i) + (before + behind) * (by / (1.0 + before.dot(&behind)).max(0.2))
    };
    (0..ring.len()).map(moved).collect()
}

/// A verified program of a nest for a target, and what else there is to say of it, or why it was refused.
pub(crate) fn compiled(nest: &str, target: &str, job: &Job) -> Result<(Compiled, Vec<u8>), String> {
    let source = Source::new("nest.cut", nest.as_bytes().to_vec()).expect("small");
    let target = TARGETS.iter().find(|known| known.name == target).expect("a target");
    let order = Order { from: None, target, verify: true };
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let compiled = pipeline::compile(&source, job, order, &mut out, &mut found).expect("memory takes everything");
    let sound = compiled.filter(|compiled| compiled.verdict.as_ref().is_some_and(Verdict::passes));
    sound.map(|compiled| (compiled, out.into_inner())).ok_or_else(|| render(&found, &source))
}
