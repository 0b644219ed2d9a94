//! What an outline makes between two places of its edge: whether that is a V, a castle or a U notch, whichever way it goes.
//!
//! The mouth is found from its first end. There an outline turns off, and it comes back to the line that its edge had, on a
//! short way. Nearly all vertices are passed over at their turn, nearly all others at the next vertex.

use std::f64::consts::PI;
use std::ops::Range;

use arrayvec::ArrayVec;

use crate::geom::{Point, Vector, angle, cross, polyline};
use crate::ir::marker::{Notch, NotchForm};

/// Width of mouths, mm: of a V, and of a castle or U.
const V_MOUTH: [f64; 2] = [1.0, Notch::WIDEST];
const MOUTH: [f64; 2] = [1.5, Notch::WIDEST];
/// Depth, mm.
const DEPTH: [f64; 2] = [1.5, Notch::LONGEST];
/// How much longer than the other a leg of a V may be.
const LEG_RATIO: f64 = 1.25;
/// Tangent of how far the axis of a V or castle may lean from the square to its mouth: 60 degrees, as in the notches of
/// pattern DXF. Pattern makers point notches along seams that meet the edge askew.
const AXIS_LEAN: f64 = 1.733;
/// How far the sides of a castle may lean from its axis, of its depth.
const LEAN: f64 = 0.2;
/// Tangent of how far the bottom of a castle may be askew to its mouth, and a leg of a U to the square: 10 degrees. A notch is
/// laid square to the seam, and the edge that it stands on is not quite parallel to that.
const TILT: f64 = 0.176;
/// Least turn at the bottom of a castle, rad: it is round where the turn is spread.
const CORNER: f64 = 65.0 * PI / 180.0;
/// Least area of a U, of the rectangle around it: a semicircle has 0.785, a V 0.5.
const U_AREA: f64 = 0.68;
/// How far the outline may turn where the mouth begins or ends, against the mouth, rad; of the segment beside it, which may
/// be short, more.
const MOUTH_TURN: f64 = PI / 6.0;
const NEXT_TURN: f64 = PI / 3.0;
/// Cosine of that turn.
const NEXT_COSINE: f64 = 0.5;
/// Square of the cosine of the least turn at the end of a mouth: 12 degrees.
const LEAST_TURN: f64 = 0.957;
/// Tangent of a turn that is less than that one, beyond all rounding: 11 degrees.
const SURELY_STRAIGHT: f64 = 0.194;
/// The edge before a mouth has its direction over so much of it, mm.
const EDGE: f64 = 2.0;
/// How far from the first end a notch can go, mm: the far corner of the largest.
const FAR: f64 = 21.0;
/// How many vertices a way may have, and how many are looked at for the direction of an edge: a guard against tangles.
const MOST_STEPS: usize = 64;
/// How far the rounding of two points to a grid may move one against the other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;
/// The same where there is no grid, mm: files without one are written with two or three decimals.
const LEAST_SLACK: f64 = 0.01;

/// What may be a notch of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mouth {
    /// The vertex at which it begins, and how many segments it has.
    pub(super) first: usize,
    pub(super) segments: usize,
    pub(super) form: NotchForm,
    /// The middle of its bottom, and the vertex there or before it.
    pub(super) tip: Point,
    pub(super) deepest: usize,
    /// Whether it lies to the left of the outline.
    pub(super) is_left: bool,
    /// Tangent of the angle from its direction to that of the outline beside it.
    pub(super) askew: f64,
}

/// What may be notches of a ring, whose last point is the first again; in the order of their first vertices.
pub(super) fn find(points: &[Point], unit: f64) -> Vec<Mouth> {
    let count = points.len() - 1;
    let mut found = Vec::new();
    let ring = Ring { points: &points[..count], slack: if unit > 0.0 { ROUNDING * unit } else { LEAST_SLACK } };
    let mut see = |i: usize, from: Point| {
        let (before, after) = (points[i] - from, points[i + 1] - points[i]);
        if is_turn(before, after) {
            found.extend(ring.begun(i, cross(before, after) > 0.0));
        }
    };
    see(0, points[count - 1]);
    each_turn(points, |i| see(i, points[i - 1]));
    found
}

/// Calls `see` for each vertex of a line at which a notch may begin. Most turn by far less, which takes no lengths to see, and
/// half as many steps where two are looked at together.
#[inline(never)] // every outline comes by here: apart, all that it works with stays in registers
fn each_turn(points: &[Point], mut see: impl FnMut(usize)) {
    let may_turn = |before: Vector, after: Vector| cross(before, after).abs() >= SURELY_STRAIGHT * before.dot(&after);
    let [first, second, rest @ ..] = points else { return };
    let (mut at, mut before) = (*second, second - first);
    let (twos, last) = rest.as_chunks();
    for (&[next, next_but_one], i) in twos.iter().zip((1..).step_by(2)) {
        let (after, then) = (next - at, next_but_one - next);
        let turns = [may_turn(before, after), may_turn(after, then)];
        if turns[0] | turns[1] {
            (i..).zip(turns).filter(|(_, turns)| *turns).for_each(|(i, _)| see(i));
        }
        (at, before) = (next_but_one, then);
    }
    if last.first().is_some_and(|end| may_turn(before, end - at)) {
        see(points.len() - 2);
    }
}

/// Whether a notch may begin between two segments.
fn is_turn(before: Vector, after: Vector) -> bool {
    let (dot, next) = (before.dot(&after), after.norm_squared());
    next <= FAR * FAR && (dot <= 0.0 || dot * dot < LEAST_TURN * before.norm_squared() * next)
}

/// The vertices of a closed line.
#[derive(Clone, Copy)]
struct Ring<'a> {
    points: &'a [Point],
    /// How far rounding may move one point against another, mm.
    slack: f64,
}

/// A way between the ends of a mouth: from its first end along the mouth, and into the notch.
struct Way<'a> {
    /// Its vertices.
    points: &'a [[f64; 2]],
    width: f64,
    depth: f64,
}

/// Room for the vertices of a way; filled where it stands.
type Room = ArrayVec<[f64; 2], MOST_STEPS>;

impl Ring<'_> {
    /// A vertex, less than twice round.
    fn at(&self, i: usize) -> Point {
        let count = self.points.len();
        self.points[if i < count { i } else { i - count }]
    }

    /// The notch that begins at a vertex, to that side.
    fn begun(&self, i: usize, is_left: bool) -> Option<Mouth> {
        let long = self.edge(i, EDGE.max(4.0 * self.slack));
        let by_long = long.and_then(|edge| self.mouth(i, edge, is_left));
        // Beside a tooth the edge is short, on a grid it has the direction of the grid where it is.
        let short = || self.edge(i, 2.0 * self.slack).filter(|short| long != Some(*short));
        by_long.or_else(|| short().and_then(|edge| self.mouth(i, edge, is_left)))
    }

    /// The notch that begins at a vertex, to that side of the edge that leads there.
    fn mouth(&self, i: usize, edge: Vector, is_left: bool) -> Option<Mouth> {
        let count = self.points.len();
        let side = if is_left { 1.0 } else { -1.0 };
        let from = self.points[i];
        let mut highest: f64 = 0.0;
        for steps in 1..count.min(MOST_STEPS) {
            let way = self.at(i + steps) - from;
            let height = side * cross(edge, way);
            let width = way.norm();
            // It came back too soon, or never will. So near the first vertex rounding hides which way it goes.
            let is_low = height <= self.slack && width > 2.0 * self.slack;
            if width > FAR || is_low && highest < DEPTH[0] - self.slack {
                return None;
            }
            if height > highest {
                highest = height;
            }
            let is_back = height.abs() <= width * MOUTH_TURN.tan() + self.slack;
            if steps > 1 && is_back && width <= MOUTH[1] + self.slack && width >= V_MOUTH[0] - self.slack {
                let found = self.between(i, steps, side);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// The direction of the edge that leads to a vertex, over so much of it, mm.
    fn edge(&self, i: usize, least: f64) -> Option<Vector> {
        let count = self.points.len();
        let mut ways = (1..count.min(MOST_STEPS)).map(|k| self.points[i] - self.at(i + count - k));
        let mut way = ways.next()?;
        while way.norm() < least
            && let Some(next) = ways.next()
        {
            way = next;
        }
        (way.norm() > 0.0).then(|| way / way.norm())
    }

    /// The notch between a vertex and the one so many steps ahead.
    #[inline(never)] // seldom asked for: apart, it leaves the registers to the steps
    fn between(&self, i: usize, steps: usize, side: f64) -> Option<Mouth> {
        let chord = self.at(i + steps) - self.points[i];
        let width = chord.norm();
        let along = chord / width;
        let local = |k: usize| {
            let way = self.at(i + k) - self.points[i];
            [way.dot(&along), side * cross(along, way)]
        };
        let mut points = Room::new();
        points.extend((0..=steps).map(local));
        let depth = points.iter().map(|point| point[1]).fold(0.0, f64::max);
        let way = Way { points: &points, width, depth };
        if !is_within(depth, DEPTH, self.slack) || way.points.iter().any(|point| point[1] < -self.slack) {
            return None;
        }
        let (form, tip) = way.form(self.slack)?;
        let askew = self.askew(i, false, steps, chord)?.max(self.askew(i, true, steps, chord)?);
        let (deepest, tip) = if form == NotchForm::V {
            let apex = way.apex();
            (apex, self.at(i + apex))
        } else {
            let across = Vector::new(-along.y, along.x) * side;
            let (deepest, _) = way.bottom(0..steps + 1, rounding(self.slack))?;
            (deepest, self.points[i] + along * tip[0] + across * tip[1])
        };
        Some(Mouth {
            first: i,
            segments: steps,
            form,
            tip,
            deepest: (i + deepest) % self.points.len(),
            is_left: side > 0.0,
            askew,
        })
    }

    /// Tangent of the angle from the direction of a mouth to that of the outline that comes to it, or leaves it; `None` when
    /// that is too far. Near the mouth the outline may have very short segments, whose direction is that of the grid; a
    /// stretch as long as the mouth is wide has its own.
    fn askew(&self, i: usize, is_end: bool, steps: usize, mouth: Vector) -> Option<f64> {
        let count = self.points.len();
        let beside = |k: usize| {
            if is_end { self.at(i + steps + k) - self.at(i + steps) } else { self.points[i] - self.at(i + count - k) }
        };
        let width = mouth.norm();
        let turn = |way: Vector| angle::turn(way, mouth).abs();
        // The one that turns least has the greatest cosine.
        let (mut straightest, mut cosine, mut is_next) = (None, f64::NEG_INFINITY, None);
        for k in 1..(count - steps).min(MOST_STEPS) {
            let way = beside(k);
            let length = way.norm();
            let along = way.dot(&mouth) / length;
            if along > cosine {
                (straightest, cosine) = (Some(way), along);
            }
            if length >= 2.0 * self.slack && is_next.is_none() {
                let is_surely = along >= NEXT_COSINE * width;
                is_next = Some(is_surely || turn(way) <= NEXT_TURN + self.slack.atan2(length));
            }
            if length >= width {
                break;
            }
        }
        let tangent =
            |way: Vector| if cosine > 0.0 { cross(way, mouth).abs() / way.dot(&mouth) } else { f64::INFINITY };
        let least = straightest.map_or(f64::INFINITY, tangent);
        let is_along = least <= MOUTH_TURN.tan() || least.atan() <= MOUTH_TURN + self.slack.atan2(width);
        (is_along && is_next.unwrap_or(true)).then_some(least)
    }
}

/// Difference of depth that rounding makes, mm: a vertex moves by one slack, the mouth by another.
fn rounding(slack: f64) -> f64 {
    2.0 * slack
}

/// Whether a length lies between two, to rounding.
fn is_within(length: f64, [least, most]: [f64; 2], slack: f64) -> bool {
    (least - slack..=most + slack).contains(&length)
}

impl Way<'_> {
    /// What it looks like, and the middle of its bottom.
    fn form(&self, slack: f64) -> Option<(NotchForm, [f64; 2])> {
        self.square_form(slack).or_else(|| self.leaning_form(slack))
    }

    /// The form of a notch whose axis leans: the form that it has when it is sheared along its mouth until its axis is square.
    /// A part of a round bottom may look like a U that leans, so that only a V and a castle may.
    fn leaning_form(&self, slack: f64) -> Option<(NotchForm, [f64; 2])> {
        let last = self.points.len() - 1;
        let (left, right) = self.bottom(0..last + 1, self.bottom_tolerance(slack))?;
        // Shearing keeps straight sides straight, so that a way with curved ones is neither a V nor a castle.
        if !self.is_straight([0, left], slack) || !self.is_straight([right, last], slack) {
            return None;
        }
        let across = (self.points[left][0] + self.points[right][0] - self.width) / 2.0;
        let leans = (slack..=AXIS_LEAN * self.depth + slack).contains(&across.abs());
        if !leans || !is_within(across.hypot(self.depth), DEPTH, slack) {
            return None;
        }
        let lean = across / self.depth;
        let mut points = Room::new();
        points.extend(self.points.iter().map(|&[x, y]| [x - lean * y, y]));
        let upright = Way { points: &points, ..*self };
        let (form, [x, y]) = upright.square_form(slack).filter(|(form, _)| *form != NotchForm::U)?;
        Some((form, [x + lean * y, y]))
    }

    /// What it looks like when its axis is square to its mouth, and the middle of its bottom.
    fn square_form(&self, slack: f64) -> Option<(NotchForm, [f64; 2])> {
        if is_within(self.width, V_MOUTH, slack) && self.is_v(slack) {
            return Some((NotchForm::V, self.points[self.apex()]));
        }
        if !is_within(self.width, MOUTH, slack) {
            return None;
        }
        if let Some(bottom) = self.castle(slack) {
            return Some((NotchForm::Castle, bottom));
        }
        self.is_u(slack).then_some((NotchForm::U, [self.width / 2.0, self.depth]))
    }

    /// The vertex that lies deepest.
    fn apex(&self) -> usize {
        (0..self.points.len()).max_by(|&a, &b| self.points[a][1].total_cmp(&self.points[b][1])).unwrap_or(0)
    }

    /// Greatest difference of depth along the bottom of a castle, mm: rounding, and tilt up to half the depth.
    fn bottom_tolerance(&self, slack: f64) -> f64 {
        rounding(slack) + (TILT * self.width).min(self.depth / 2.0)
    }

    /// First and last of some vertices whose depth is within `most` mm of the greatest.
    fn bottom(&self, mut among: Range<usize>, most: f64) -> Option<(usize, usize)> {
        let is_low = |k: &usize| self.points[*k][1] >= self.depth - most;
        let left = among.find(is_low)?;
        Some((left, among.rfind(is_low).unwrap_or(left)))
    }

    fn place(&self, k: usize) -> Point {
        Point::new(self.points[k][0], self.points[k][1])
    }

    /// Whether the vertices between two lie on the line between them.
    fn is_straight(&self, [from, to]: [usize; 2], slack: f64) -> bool {
        let [a, b] = [from, to].map(|k| self.place(k));
        (from + 1..to).all(|k| polyline::distance_to_segment(self.place(k), a, b) <= slack)
    }

    /// Two legs, equal within a quarter.
    fn is_v(&self, slack: f64) -> bool {
        let (apex, last) = (self.apex(), self.points.len() - 1);
        let legs = [0, last].map(|end| (self.place(apex) - self.place(end)).norm());
        let [shorter, longer] = [legs[0].min(legs[1]), legs[0].max(legs[1])];
        longer <= LEG_RATIO * shorter + slack
            && self.is_straight([0, apex], slack)
            && self.is_straight([apex, last], slack)
    }

    /// The middle of the bottom, if it is a rectangle.
    fn castle(&self, slack: f64) -> Option<[f64; 2]> {
        let last = self.points.len() - 1;
        let (left, right) = self.bottom(1..last, self.bottom_tolerance(slack))?;
        let most = slack + LEAN * self.depth.min(self.width);
        let leans = [self.points[left][0].abs(), (self.points[right][0] - self.width).abs()];
        let is_castle = leans.into_iter().all(|lean| lean <= most)
            && self.is_straight([0, left], slack)
            && self.is_straight([left, right], slack)
            && self.is_straight([right, last], slack)
            && [left, right].into_iter().all(|k| self.is_corner(k, slack));
        let middle = self.place(left) + (self.place(right) - self.place(left)) / 2.0;
        is_castle.then_some([middle.x, middle.y])
    }

    /// Whether it turns by nearly a right angle at a vertex, and not little by little around it.
    fn is_corner(&self, k: usize, slack: f64) -> bool {
        let least = (self.depth.min(self.width) / 4.0).max(2.0 * slack);
        let at = self.place(k);
        let far = |place: &Point| (place - at).norm() >= least;
        let before = (0..k).rev().map(|i| self.place(i)).find(far).unwrap_or_else(|| self.place(0));
        let after = (k + 1..self.points.len()).map(|i| self.place(i)).find(far);
        let after = after.unwrap_or_else(|| self.place(self.points.len() - 1));
        angle::is_turned(at - before, after - at, CORNER)
    }

    /// A way down, across and up again that fills most of the rectangle around it.
    fn is_u(&self, slack: f64) -> bool {
        let (apex, last) = (self.apex(), self.points.len() - 1);
        let beside = LEAN * self.width + TILT * self.depth + slack;
        let (left, right) = (-beside, self.width + beside);
        let steps = || self.points.windows(2);
        // Whether a step leads on by one measure, or back no more than its tilt has it do by the way along the other.
        let leads_on = |on: f64, along: f64| on >= -2.0 * slack - TILT * along.abs();
        let is_round = self.points.iter().all(|point| (left..=right).contains(&point[0]))
            && steps().all(|ends| leads_on(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]))
            && steps().take(apex).all(|ends| leads_on(ends[1][1] - ends[0][1], ends[1][0] - ends[0][0]))
            && steps().skip(apex).all(|ends| leads_on(ends[0][1] - ends[1][1], ends[1][0] - ends[0][0]));
        let doubled: f64 = steps().map(|ends| (ends[1][0] - ends[0][0]) * (ends[1][1] + ends[0][1])).sum();
        last > 3 && is_round && doubled / 2.0 >= U_AREA * self.width * self.depth
    }
}
