//! Nests of parts that touch, as CAD makes them: a cloth divided again and again by slanted lines and gentle S curves. What
//! lies between is a part; both sides of a line are drawn by themselves, with points of their own, rounded by themselves.

use std::f64::consts::PI;
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
const GAPS: [f64; 6] = [-0.2, -0.1, 0.0, 0.1, 0.5, 2.0];
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
/// Half of a side of a cut-out, and how far its middle is from the edges of its part at the least, mm.
const CUT_OUT: [f64; 2] = [10.0, 25.0];

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

/// How a nest is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Dialect {
    /// A cut file in tenths of a millimetre.
    Metric,
    /// A cut file in hundredths of an inch.
    Inch,
    /// A plot.
    Plot,
}

impl Dialect {
    /// Of its numbers, mm.
    fn unit(self) -> f64 {
        match self {
            Self::Metric => 0.1,
            Self::Inch => 0.254,
            Self::Plot => 0.025,
        }
    }

    /// A line that is cut.
    fn line(self, points: &[Point]) -> String {
        let places = points.iter().map(|at| [at.x, at.y].map(|value| ((value + AT) / self.unit()).round()));
        let (before, between) = if self == Self::Plot { ("", ",") } else { ("X", "Y") };
        let mut places: Vec<String> = places.map(|[x, y]| format!("{before}{x:.0}{between}{y:.0}")).collect();
        places.dedup();
        let (first, rest) = (&places[0], &places[1..]);
        if self == Self::Plot {
            format!("PU{first};PD{};", rest.join(","))
        } else {
            format!("{first}*M14*{}*M15*", rest.join("*"))
        }
    }

    /// The lines of a part, its outline first and slits last.
    fn part(self, number: usize, lines: &[Vec<Point>], slits: &[Vec<Point>]) -> String {
        let all = |lines: &[Vec<Point>], before: &str| -> String {
            let lines: Vec<String> = lines.iter().map(|line| self.line(line)).collect();
            lines.iter().flat_map(|line| [before, line]).collect()
        };
        if self == Self::Plot {
            return all(lines, "") + &all(slits, "");
        }
        format!("N{number}*M15*{}{}", all(lines, ""), all(slits, "M19*"))
    }

    /// A file of parts.
    fn file(self, parts: &str) -> String {
        match self {
            Self::Metric => format!("H1*G71*{parts}M0*\n"),
            Self::Inch => format!("G91*{parts}M0*\n"),
            Self::Plot => format!("IN;SP1;{parts}PU;SP0;PG;"),
        }
    }
}

/// What parts a nest has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Layout {
    Plain,
    /// No edge is curved.
    Straight,
    /// A third of the parts more, small ones; every tenth part is none.
    SmallAndWaste,
    /// Every fifth part has a square cut-out; none in plots, which do not cut what lies in parts.
    CutOuts,
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
    pub(crate) dialect: Dialect,
    /// How far each part is moved at the most, mm.
    pub(crate) jitter: f64,
    pub(crate) layout: Layout,
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
            dialect: [Dialect::Metric, Dialect::Inch, Dialect::Plot][pick / 4 % 3],
            jitter: [0.0, 0.05][pick / 3 % 2],
            layout: [Layout::Plain, Layout::Straight, Layout::SmallAndWaste, Layout::CutOuts][pick / 5 % 4],
        }
    }

    /// The nest: the same recipe, the same bytes.
    pub(crate) fn nest(&self) -> Nest {
        let mut rng = Rng::with_seed(self.seed);
        let small = if self.layout == Layout::SmallAndWaste { self.parts / 3 } else { 0 };
        let cloth = Cloth::divided([self.parts, small], self.layout == Layout::Straight, &mut rng);
        let places: Vec<[f64; 2]> =
            cloth.curves.iter().map(|_| [rng.f64() * 0.35 + 0.1, rng.f64() * 0.35 + 0.55]).collect();
        let mut text = String::new();
        let mut notches = Notches::default();
        let is_drawn = |number: usize| self.layout != Layout::SmallAndWaste || !number.is_multiple_of(10);
        for (part, number) in cloth.parts.iter().zip(1..).filter(|(_, number)| is_drawn(*number)) {
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
                strokes.extend(form.strokes().iter().map(|ends| ends.map(place).to_vec()));
            }
            let start = rng.usize(..outline.len());
            outline.rotate_left(start);
            if rng.bool() {
                outline.reverse();
            }
            outline.push(outline[0]);
            let has_cut_out = self.layout == Layout::CutOuts && self.dialect != Dialect::Plot && number % 5 == 0;
            let cut_out = if has_cut_out { cut_out(&at) } else { None };
            let lines: Vec<Vec<Point>> = cut_out.into_iter().chain([outline]).collect();
            text += &self.dialect.part(number, &lines, &strokes);
        }
        Nest { text: self.dialect.file(&text), notches }
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

/// A square in the middle of a ring, where that is wide enough.
fn cut_out(ring: &[Point]) -> Option<Vec<Point>> {
    let middle = Point::from(ring.iter().map(|at| at.coords).sum::<Vector>() / ring.len() as f64);
    let [half, least] = CUT_OUT;
    let edges = (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]);
    let is_wide = edges.map(|[a, b]| polyline::distance_to_segment(middle, a, b)).all(|away| away > least);
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half), (-half, -half)];
    is_wide.then(|| corners.map(|(x, y)| middle + Vector::new(x, y)).to_vec())
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
