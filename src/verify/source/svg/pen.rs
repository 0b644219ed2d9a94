//! Pen of the second reading: it computes statistics, and divides curves into more chords than the reader.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, TAU};

use super::map::Map;
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, Vector};
use crate::verify::source::census::{Census, Slack};

/// Number of chords here per chord of the reader, and maximum number of the reader's chords.
const FINER: usize = 4;
const MOST_CHORDS: f64 = 100_000.0;
/// Rounding error of a number of chords, relative.
const COUNT_EPSILON: f64 = 1e-9;
/// Permitted difference of lengths and moments, relative to the shortfall of the chords that the reader should have; then where
/// rounding decides between two numbers of chords.
const LACKING: f64 = 0.1;
const DOUBTFUL: f64 = 1.0;
/// Length below which a line is rounding, mm: a place this close to the last one is not a new end of a line.
const ROUNDING: f64 = 1e-6;

/// Curve in mm.
pub(super) enum Bow {
    /// Control points of a Bezier curve: three for a quadratic one, four for a cubic one.
    Bezier(Vec<Point>),
    /// Ellipse: centre, two conjugate semi-axes, start angle and sweep, rad.
    Ellipse { centre: Point, axes: [Vector; 2], start: f64, sweep: f64 },
}

/// Pen that turns the steps of paths into strokes.
pub(super) struct Pen {
    sagitta: f64,
    pub(super) census: Census,
    pub(super) slack: Slack,
    /// Strokes, if requested.
    pub(super) strokes: Option<Vec<Vec<Point>>>,
    /// Names of the layers with strokes, and number of strokes drawn.
    pub(super) layers: BTreeSet<String>,
    pub(super) drawn: usize,
    /// Points since the pen was lifted, and the cause of the last one.
    places: Vec<Point>,
    cause: usize,
    /// Shortfall in moments of the reader's chords of curves since then.
    lack: Moments,
}

impl Pen {
    pub(super) fn new(sagitta: f64, strokes: Option<Vec<Vec<Point>>>) -> Self {
        let slack = Slack { sagitta, length: 0.0, bounds: 0.0, moments: Moments::default() };
        let census = Census::empty(0.0);
        let layers = BTreeSet::new();
        Self {
            sagitta,
            census,
            slack,
            strokes,
            layers,
            drawn: 0,
            places: Vec::new(),
            cause: 0,
            lack: Moments::default(),
        }
    }

    /// Starts a stroke.
    pub(super) fn start(&mut self, at: Point) {
        self.lift();
        self.places.push(at);
    }

    /// Adds a straight line; `cause` identifies its step, and is not 0.
    pub(super) fn line(&mut self, to: Point, cause: usize) {
        if self.places.last().is_none_or(|last| (to - last).norm() <= ROUNDING) {
            return;
        }
        self.places.push(to);
        self.census.points += usize::from(std::mem::replace(&mut self.cause, cause) != cause);
    }

    /// Adds a curve that ends at `to`.
    pub(super) fn curve(&mut self, bow: &Bow, to: Point, cause: usize) {
        let Some(&from) = self.places.last() else { return };
        let needed = bow.needed(self.sagitta);
        let whole = |needed: f64| if needed.is_nan() { 1.0 } else { needed.ceil().clamp(1.0, MOST_CHORDS) };
        let least = whole(needed * (1.0 - COUNT_EPSILON));
        let is_doubtful = least < whole(needed * (1.0 + COUNT_EPSILON));
        let count = least as usize * FINER;
        let places: Vec<Point> =
            (1..=count).map(|k| if k == count { to } else { bow.at(k as f64 / count as f64) }).collect();
        let of =
            |step: usize| Moments::of(std::iter::once(from).chain(places.iter().copied().skip(step - 1).step_by(step)));
        let lack = of(1) - of(FINER);
        let share = if is_doubtful { DOUBTFUL } else { LACKING };
        self.lack += lack;
        self.slack.moments += lack.magnitudes() * share;
        self.slack.length += lack.length() * share;
        if lack != Moments::default() {
            self.slack.bounds = self.slack.sagitta;
        }
        for place in places {
            self.line(place, cause);
        }
    }

    /// Ends a stroke. A last point equal to the first up to rounding is replaced by it.
    pub(super) fn lift(&mut self) {
        let mut places = std::mem::take(&mut self.places);
        self.cause = 0;
        let lack = std::mem::take(&mut self.lack);
        if places.len() < 2 {
            return;
        }
        self.drawn += 1;
        let first = places[0];
        if let Some(last) = places.last_mut().filter(|last| (**last - first).norm() <= ROUNDING) {
            *last = first;
        }
        let moments = Moments::of(places.iter().copied()) - lack;
        self.census.length += moments.length();
        self.census.moments += moments;
        let bounds: &mut Extent = &mut self.census.bounds;
        for &place in &places {
            bounds.add(place);
        }
        if let Some(strokes) = &mut self.strokes {
            strokes.push(places);
        }
    }
}

impl Bow {
    /// Number of chords that the reader needs.
    fn needed(&self, sagitta: f64) -> f64 {
        match self {
            Self::Bezier(controls) => {
                // Each second difference, times d (d - 1) / 8 for the degree d.
                let degree = (controls.len() - 1) as f64;
                let bends = controls.windows(3).map(|w| ((w[1] - w[0]) - (w[2] - w[1])).norm());
                (degree * (degree - 1.0) / 8.0 * bends.fold(0.0, f64::max) / sagitta).sqrt()
            }
            Self::Ellipse { axes: [u, v], sweep, .. } => {
                // Greater singular value of the 2 x 2 matrix.
                let longest = f64::midpoint((u.x + v.y).hypot(u.y - v.x), (u.x - v.y).hypot(u.y + v.x));
                let step = if sagitta < longest {
                    2.0 * (sagitta * (2.0 * longest - sagitta)).sqrt().atan2(longest - sagitta)
                } else {
                    FRAC_PI_2
                };
                sweep.abs() / step.min(FRAC_PI_2)
            }
        }
    }

    /// Point at a fraction of the curve, by de Casteljau's algorithm or by the angle.
    fn at(&self, share: f64) -> Point {
        match self {
            Self::Bezier(controls) => {
                let mut places = controls.clone();
                while places.len() > 1 {
                    places = places.windows(2).map(|w| w[0] + (w[1] - w[0]) * share).collect();
                }
                places[0]
            }
            Self::Ellipse { centre, axes: [u, v], start, sweep } => {
                let angle = start + sweep * share;
                centre + u * angle.cos() + v * angle.sin()
            }
        }
    }

    /// Arc of a path: its ends, radii and rotation (degrees), then the flags for the large arc and for a growing angle; `None`
    /// for a straight line.
    pub(super) fn arc(ends: [[f64; 2]; 2], numbers: [f64; 3], flags: [bool; 2], map: Map) -> Option<Self> {
        let [rx, ry] = [numbers[0].abs(), numbers[1].abs()];
        let [[x0, y0], [x1, y1]] = ends;
        if rx == 0.0 || ry == 0.0 || ends[0] == ends[1] {
            return None;
        }
        // Frame in which the ellipse is the unit circle.
        let frame = Map::read(&format!("rotate({})", numbers[2]))?.times(Map::scale(rx, ry));
        let (cos, sin) = (frame.0[0][0] / rx, frame.0[1][0] / rx);
        let seen = |x: f64, y: f64| Vector::new((x * cos + y * sin) / rx, (y * cos - x * sin) / ry);
        let chord = seen(x1 - x0, y1 - y0);
        // An ellipse that is too small to reach from end to end is enlarged.
        let radius = (chord.norm() / 2.0).max(1.0);
        let height = (radius * radius - chord.norm_squared() / 4.0).max(0.0).sqrt();
        let side = if flags[0] == flags[1] { -height } else { height };
        // To the left of the chord when x turns to y.
        let spoke = -chord / 2.0 - Vector::new(-chord.y, chord.x).normalize() * side;
        let start = spoke.y.atan2(spoke.x);
        let end = spoke + chord;
        let turn = (end.y.atan2(end.x) - start).rem_euclid(TAU);
        let sweep = if flags[1] { turn } else { turn - TAU };
        let back = frame.along(-spoke.x, -spoke.y);
        let centre = map.at(x0 + back.x, y0 + back.y);
        let axis = |x: f64, y: f64| {
            let way = frame.along(x * radius, y * radius);
            map.along(way.x, way.y)
        };
        Some(Self::Ellipse { centre, axes: [axis(1.0, 0.0), axis(0.0, 1.0)], start, sweep })
    }
}
