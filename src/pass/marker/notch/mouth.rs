//! Recognition of one notch: whether the outline between two places of its edge is a V, a castle or a U, inwards or outwards.
//!
//! The mouth is found from its first end: there the outline turns off, and it comes back soon to the line of its edge. Nearly
//! all vertices are rejected by their turn, nearly all others at the next vertex.

use std::f64::consts::PI;
use std::ops::Range;

use arrayvec::ArrayVec;

use crate::geom::{Point, Vector, angle, cross, polyline};
use crate::ir::marker::{Notch, NotchForm};

/// Widths of mouths, mm: of a V, and of a castle or U.
const V_MOUTH: [f64; 2] = [1.0, Notch::WIDEST];
const MOUTH: [f64; 2] = [1.5, Notch::WIDEST];
/// Depth, mm.
const DEPTH: [f64; 2] = [1.5, Notch::LONGEST];
/// Tangent of the greatest lean of the axis of a notch from the square to its mouth: 60 degrees, as in the notches of pattern
/// DXF. Pattern makers point notches along seams that meet the edge at an angle.
const AXIS_LEAN: f64 = 1.733;
/// Greatest lean of the sides of a castle from its axis, as a fraction of its depth.
const LEAN: f64 = 0.2;
/// Tangent of the greatest tilt of the bottom of a castle to its mouth, and of a leg of a U to the square: 10 degrees. A notch
/// is laid square to the seam, and its edge is not quite parallel to that.
const TILT: f64 = 0.176;
/// Least turn at the bottom of a castle, rad: a bottom with a gradual turn is round.
const CORNER: f64 = 65.0 * PI / 180.0;
/// Least area of a U, as a fraction of the rectangle around it: a semicircle has 0.785, a V 0.5.
const U_AREA: f64 = 0.68;
/// Greatest turn of the outline at either end of the mouth, relative to the mouth, rad; the segment beside it, which may be
/// short, may turn by more.
const MOUTH_TURN: f64 = PI / 6.0;
const NEXT_TURN: f64 = PI / 3.0;
/// Cosine of [`NEXT_TURN`].
const NEXT_COSINE: f64 = 0.5;
/// Least turn from the edge into a V whose mouth begins or ends at a corner, rad. A cut-out at a corner turns by at most a
/// right angle, so it is no notch.
const CORNER_INTO: f64 = 95.0 * PI / 180.0;
/// Greatest sum of the turns of the edge at such corners, rad: the corners of a swallowtail turn by more.
const CORNERS_MOST: f64 = 135.0 * PI / 180.0;
/// Number of notches before and after one among which its neighbours are looked for: their sides alternate.
const BESIDE: usize = 4;
/// Square of the cosine of the least turn at the end of a mouth: 12 degrees.
const LEAST_TURN: f64 = 0.957;
/// Tangent of a turn that is less than that one, beyond all rounding: 11 degrees.
const SURELY_STRAIGHT: f64 = 0.194;
/// Length of edge before a mouth that gives its direction, mm.
const EDGE: f64 = 2.0;
/// Greatest distance of a notch from the first end of its mouth, mm: the far corner of the largest.
const FAR: f64 = 21.0;
/// Greatest number of vertices of a notch, and of an edge for its direction: a guard against tangles.
const MOST_STEPS: usize = 64;
/// Distance by which rounding to a grid may move two points against each other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;
/// Distance by which rounding may move two points in a file without a grid, mm: such files have two or three decimals.
const LEAST_SLACK: f64 = 0.01;

/// A candidate for a notch of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mouth {
    /// The vertex at which it begins, and the number of its segments.
    pub(super) first: usize,
    pub(super) segments: usize,
    pub(super) form: NotchForm,
    /// The middle of its bottom, and the vertex there or before it.
    pub(super) tip: Point,
    pub(super) deepest: usize,
    /// True if it lies to the left of the outline.
    pub(super) is_left: bool,
    /// Tangent of the angle from its direction to that of the outline beside it; infinite at a corner.
    pub(super) askew: f64,
    /// Turns of the outline from the edge to the mouth and back, rad; 0 where there is no corner.
    corners: [f64; 2],
}

/// Candidates for notches of a ring, whose last point is the first again, in the order of their first vertices.
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
    if found.iter().any(Mouth::is_at_corner) {
        ring.leave_between_edges(&mut found);
    }
    found
}

/// A notch that the drawing declares, by its first vertex and its segments: anything but a V or a castle is a U.
pub(super) fn said(points: &[Point], unit: f64, [first, segments]: [usize; 2]) -> Option<Mouth> {
    let count = points.len() - 1;
    let ring = Ring { points: &points[..count], slack: if unit > 0.0 { ROUNDING * unit } else { LEAST_SLACK } };
    let [from, to] = [first, first + segments].map(|i| ring.at(i));
    let height = |k: &usize| cross(to - from, ring.at(*k) - from);
    let apex = (first..first + segments).max_by(|a, b| height(a).abs().total_cmp(&height(b).abs()))?;
    let is_left = height(&apex) > 0.0;
    let shape = (segments < MOST_STEPS).then(|| ring.shape(first, segments, if is_left { 1.0 } else { -1.0 }));
    let (form, tip, deepest) = shape.flatten().unwrap_or((NotchForm::U, ring.at(apex), apex % count));
    Some(Mouth { first, segments, form, tip, deepest, is_left, askew: 0.0, corners: [0.0; 2] })
}

impl Mouth {
    /// True if two share a segment of a ring with `count` vertices.
    pub(super) fn overlaps(&self, other: &Self, count: usize) -> bool {
        let ahead = |from: &Self, to: &Self| (to.first + count - from.first) % count;
        ahead(self, other) < self.segments || ahead(other, self) < other.segments
    }

    fn is_at_corner(&self) -> bool {
        self.corners != [0.0; 2]
    }
}

/// Calls `see` for each vertex of a line at which a notch may begin. Most turn by far less: that test needs no lengths, and two
/// vertices at a time take half as many steps.
#[inline(never)] // every outline comes by here: apart, all that it works with stays in registers
fn each_turn(points: &[Point], mut see: impl FnMut(usize)) {
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

/// True unless the turn between two segments is surely less than that at the end of a mouth.
fn may_turn(before: Vector, after: Vector) -> bool {
    cross(before, after).abs() >= SURELY_STRAIGHT * before.dot(&after)
}

/// True if a notch may begin between two segments.
fn is_turn(before: Vector, after: Vector) -> bool {
    let (dot, next) = (before.dot(&after), after.norm_squared());
    next <= FAR * FAR && (dot <= 0.0 || dot * dot < LEAST_TURN * before.norm_squared() * next)
}

/// The vertices of a closed line.
#[derive(Clone, Copy)]
struct Ring<'a> {
    points: &'a [Point],
    /// Distance by which rounding may move one point against another, mm.
    slack: f64,
}

/// Vertices of a notch relative to the first one.
type Room = ArrayVec<Vector, MOST_STEPS>;

/// A candidate seen along the axis of the notch: in one view the walls of a castle or U are upright, whatever the edge does.
/// The mouth reaches from wall to wall, level with the longer one.
struct Way {
    /// Vertices: across the axis from the first one, and along the axis from the mouth.
    places: Room,
    /// Base vectors of the view.
    axes: [Vector; 2],
    width: f64,
    depth: f64,
}

impl Ring<'_> {
    /// A vertex; indices may be up to twice the count.
    fn at(&self, i: usize) -> Point {
        let count = self.points.len();
        self.points[if i < count { i } else { i - count }]
    }

    /// The notch that begins at a vertex, on the given side.
    fn begun(&self, i: usize, is_left: bool) -> Option<Mouth> {
        let long = self.edge(i, EDGE.max(4.0 * self.slack));
        let by_long = long.and_then(|edge| self.mouth(i, edge, is_left));
        by_long.or_else(|| {
            // Beside a tooth the edge is short, and on a grid it has the direction of the grid there.
            let short = self.edge(i, 2.0 * self.slack)?;
            let by_short = if long == Some(short) { None } else { self.mouth(i, short, is_left) };
            by_short.or_else(|| self.at_corner(i, short, is_left))
        })
    }

    /// The notch that begins at a corner, on the given side. The edge before the corner does not give the direction of its
    /// mouth.
    fn at_corner(&self, i: usize, edge: Vector, is_left: bool) -> Option<Mouth> {
        let side = if is_left { 1.0 } else { -1.0 };
        let from = self.points[i];
        let far = |steps: usize, least: f64| (self.at(i + steps) - from).norm() >= least;
        let most = self.points.len().min(MOST_STEPS);
        let wall = self.at(i + (1..most).find(|&steps| far(steps, 2.0 * self.slack))?) - from;
        // The first test needs no angle: most corners turn by a right angle at most.
        if edge.dot(&wall) > 0.0 || side * angle::turn(edge, wall) < CORNER_INTO {
            return None;
        }
        let turns = |steps: usize| {
            let [before, at, after] = [steps - 1, steps, steps + 1].map(|k| self.at(i + k));
            may_turn(at - before, after - at)
        };
        let within = (2..most).take_while(|&steps| !far(steps, FAR)).filter(|&steps| turns(steps));
        let mut ends = within.filter(|&steps| far(steps, V_MOUTH[0]) && !far(steps, MOUTH[1] + self.slack));
        ends.find_map(|steps| self.between(i, steps, side))
    }

    /// Keeps those whose mouth follows the edge: at an end of the mouth at a corner, the outline must turn by at most the angle
    /// of a part's corner, or another notch of the same side must end or begin there.
    fn leave_between_edges(&self, found: &mut Vec<Mouth>) {
        let all = found.clone();
        let end = |mouth: &Mouth, end: usize| self.at(mouth.first + if end == 0 { 0 } else { mouth.segments });
        let touches = |k: usize, which: usize| {
            let beside = (1..all.len().min(BESIDE)).flat_map(|by| [k + by, k + all.len() - by]);
            let mut others =
                beside.map(|other| &all[other % all.len()]).filter(|other| other.is_left == all[k].is_left);
            others.any(|other| (end(other, 1 - which) - end(&all[k], which)).norm() <= 2.0 * self.slack)
        };
        let mut k = 0..;
        found.retain(|mouth| {
            let k = k.next().expect("it never ends");
            let corners = mouth.corners.iter().enumerate();
            let turn: f64 =
                corners.filter(|&(which, turn)| *turn > 0.0 && !touches(k, which)).map(|(_, turn)| turn).sum();
            turn <= CORNERS_MOST
        });
    }

    /// The notch that begins at a vertex, on the given side of the edge before it.
    fn mouth(&self, i: usize, edge: Vector, is_left: bool) -> Option<Mouth> {
        let count = self.points.len();
        let side = if is_left { 1.0 } else { -1.0 };
        let from = self.points[i];
        let mut highest: f64 = 0.0;
        for steps in 1..count.min(MOST_STEPS) {
            let way = self.at(i + steps) - from;
            let height = side * cross(edge, way);
            let width = way.norm();
            // The line comes back too soon, or never. Near the first vertex rounding hides its direction.
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

    /// Direction of the edge before a vertex, over a length of at least `least` mm.
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

    /// The notch between a vertex and the one `steps` steps ahead.
    #[inline(never)] // seldom asked for: apart, it leaves the registers to the steps
    fn between(&self, i: usize, steps: usize, side: f64) -> Option<Mouth> {
        let (form, tip, deepest) = self.shape(i, steps, side)?;
        let chord = self.at(i + steps) - self.points[i];
        let [start, end] = [false, true].map(|is_end| {
            let askew = self.askew(i, is_end, steps, chord).map(|askew| (askew, 0.0));
            let corner = || self.corner(i, is_end, steps, side).filter(|_| form == NotchForm::V);
            askew.or_else(|| corner().map(|turn| (f64::INFINITY, turn)))
        });
        let (start, end) = (start?, end?);
        Some(Mouth {
            first: i,
            segments: steps,
            form,
            tip,
            deepest,
            is_left: side > 0.0,
            askew: start.0.max(end.0),
            corners: [start.1, end.1],
        })
    }

    /// Form of a candidate on that side of its mouth, the middle of its bottom, and the vertex there or before it.
    fn shape(&self, i: usize, steps: usize, side: f64) -> Option<(NotchForm, Point, usize)> {
        let chord = self.at(i + steps) - self.points[i];
        let along = chord / chord.norm();
        let local = |k: usize| {
            let way = self.at(i + k) - self.points[i];
            Vector::new(way.dot(&along), side * cross(along, way))
        };
        let places: Room = (0..=steps).map(local).collect();
        let way = Way::upright(places);
        if !is_within(way.depth, DEPTH, self.slack) || way.places.iter().any(|place| place.y < -self.slack) {
            return None;
        }
        let (form, tip) = way.form(self.slack)?;
        let (deepest, tip) = if form == NotchForm::V {
            let apex = way.apex();
            (apex, self.at(i + apex))
        } else {
            let across = Vector::new(-along.y, along.x) * side;
            let (deepest, _) = way.bottom(0..steps + 1, rounding(self.slack))?;
            (deepest, self.points[i] + along * tip.x + across * tip.y)
        };
        Some((form, tip, (i + deepest) % self.points.len()))
    }

    /// Turn of the outline between its edge and a mouth at a corner that a notch is cut into, rad; `None` unless the outline
    /// turns by more than a right angle from the edge into the notch.
    fn corner(&self, i: usize, is_end: bool, steps: usize, side: f64) -> Option<f64> {
        let count = self.points.len();
        let least = 2.0 * self.slack;
        let [own, other] = if is_end { [i + steps, i] } else { [i, i + steps] }.map(|k| self.at(k));
        let at = if is_end { i + steps } else { i };
        let first_far = |by: usize| {
            let places = (1..count.min(MOST_STEPS)).map(|k| self.points[(at + k * by) % count]);
            places.map(|place| place - own).find(|way| way.norm() >= least)
        };
        let [before, after] = [-first_far(count - 1)?, first_far(1)?];
        let [into, bend] = if is_end {
            [angle::turn(before, after), angle::turn(own - other, after)]
        } else {
            [angle::turn(before, after), angle::turn(before, other - own)]
        }
        .map(|turn| side * turn);
        (into >= CORNER_INTO && bend >= 0.0).then_some(bend)
    }

    /// Tangent of the angle between the direction of a mouth and that of the outline beside it; `None` if the angle is too
    /// large. Near the mouth the outline may have very short segments with the direction of the grid; a stretch as long as the
    /// mouth is wide has its own direction.
    fn askew(&self, i: usize, is_end: bool, steps: usize, mouth: Vector) -> Option<f64> {
        let count = self.points.len();
        let beside = |k: usize| {
            if is_end { self.at(i + steps + k) - self.at(i + steps) } else { self.points[i] - self.at(i + count - k) }
        };
        let width = mouth.norm();
        let turn = |way: Vector| angle::turn(way, mouth).abs();
        // The direction with the least turn has the greatest cosine.
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

/// True if a length is between two limits, to rounding.
fn is_within(length: f64, [least, most]: [f64; 2], slack: f64) -> bool {
    (least - slack..=most + slack).contains(&length)
}

impl Way {
    /// A view whose first axis is the direction of the mouth.
    fn upright(places: Room) -> Self {
        let width = places[places.len() - 1].x;
        let depth = places.iter().map(|place| place.y).fold(0.0, f64::max);
        Self { places, axes: [Vector::x(), Vector::y()], width, depth }
    }

    /// The candidate in another view; its tip may be off the middle of its mouth by up to the depth of a notch.
    fn seen(&self, axes: [Vector; 2]) -> Self {
        let [across, along] = axes;
        let whole = cross(across, along);
        let local = |place: &Vector| Vector::new(cross(*place, along), cross(across, *place)) / whole;
        let mut places: Room = self.places.iter().map(local).collect();
        let last = places[places.len() - 1];
        let level = last.y.min(0.0);
        let depth = places.iter().map(|place| place.y).fold(0.0, f64::max) - level;
        places.iter_mut().for_each(|place| place.y -= level);
        Self { places, axes, width: last.x, depth }
    }

    /// Its form, and the middle of its bottom: a V by its legs; a castle or a U in one of three views. In these its base and
    /// its mouth are square to its axis, or both follow the edge while the axis leans, or the edge cuts its walls off at an
    /// angle.
    fn form(&self, slack: f64) -> Option<(NotchForm, Vector)> {
        let middle = Vector::new(self.width / 2.0, 0.0);
        let is_deep = |tip: &Vector| is_within((tip - middle).norm(), DEPTH, slack);
        if is_within(self.width, V_MOUTH, slack) && self.is_v(slack) {
            return Some((NotchForm::V, self.places[self.apex()])).filter(|(_, tip)| is_deep(tip));
        }
        if !is_within(self.width, MOUTH, slack) {
            return None;
        }
        let leaning = self.axis(slack).map(|axis| [[Vector::x(), axis], [Vector::new(axis.y, -axis.x), axis]]);
        let others = leaning.into_iter().flatten().map(|axes| self.seen(axes));
        let others: ArrayVec<Way, 2> = others.filter(|way| way.width >= MOUTH[0] - slack).collect();
        let views = || std::iter::once(self).chain(&others);
        let castle = views().find_map(|way| Some((NotchForm::Castle, way.drawn(way.castle(slack)?))));
        let u = || {
            let shares = views().filter_map(|way| Some((way.u(slack)?, way)));
            let (_, way) = shares.max_by(|a, b| a.0.total_cmp(&b.0))?;
            Some((NotchForm::U, way.drawn(Vector::new(way.width / 2.0, way.depth))))
        };
        castle.or_else(u).filter(|(_, tip)| is_deep(tip))
    }

    /// Direction of its walls, if they lean from the square to its mouth by a permitted angle: the longer one has more weight.
    fn axis(&self, slack: f64) -> Option<Vector> {
        let last = self.places.len() - 1;
        let left = (1..=self.apex()).rev().find(|&k| self.is_straight([0, k], slack))?;
        let right = (self.apex()..last).find(|&k| self.is_straight([k, last], slack))?;
        let way = self.places[left] + (self.places[right] - self.places[last]);
        let leans = slack * 2.0..=AXIS_LEAN * way.y;
        leans.contains(&way.x.abs()).then(|| way.normalize())
    }

    /// A place of this view in the coordinates of the outline, relative to the first vertex.
    fn drawn(&self, place: Vector) -> Vector {
        let [across, along] = self.axes;
        // The first vertex lies on the mouth or, where its wall is the shorter one, above it.
        across * place.x + along * (place.y - self.places[0].y)
    }

    /// The deepest vertex.
    fn apex(&self) -> usize {
        (0..self.places.len()).max_by(|&a, &b| self.places[a].y.total_cmp(&self.places[b].y)).unwrap_or(0)
    }

    /// Greatest difference of depth along the bottom of a castle, mm: rounding, and tilt up to half the depth.
    fn bottom_tolerance(&self, slack: f64) -> f64 {
        rounding(slack) + (TILT * self.width).min(self.depth / 2.0)
    }

    /// First and last of some vertices whose depth is within `most` mm of the greatest.
    fn bottom(&self, mut among: Range<usize>, most: f64) -> Option<(usize, usize)> {
        let is_low = |k: &usize| self.places[*k].y >= self.depth - most;
        let left = among.find(is_low)?;
        Some((left, among.rfind(is_low).unwrap_or(left)))
    }

    fn place(&self, k: usize) -> Point {
        self.places[k].into()
    }

    /// True if the vertices between two are on the line between them.
    fn is_straight(&self, [from, to]: [usize; 2], slack: f64) -> bool {
        let [a, b] = [from, to].map(|k| self.place(k));
        (from + 1..to).all(|k| polyline::distance_to_segment(self.place(k), a, b) <= slack)
    }

    /// True for two straight legs whose tip is off the middle of the mouth by at most the lean of an axis.
    fn is_v(&self, slack: f64) -> bool {
        let (apex, last) = (self.apex(), self.places.len() - 1);
        let leans = (self.places[apex].x - self.width / 2.0).abs();
        leans <= AXIS_LEAN * self.depth + slack
            && self.is_straight([0, apex], slack)
            && self.is_straight([apex, last], slack)
    }

    /// The middle of the bottom, if the candidate is a rectangle.
    fn castle(&self, slack: f64) -> Option<Vector> {
        let last = self.places.len() - 1;
        let (left, right) = self.bottom(1..last, self.bottom_tolerance(slack))?;
        let most = slack + LEAN * self.depth.min(self.width);
        let leans = [self.places[left].x.abs(), (self.places[right].x - self.width).abs()];
        let is_castle = leans.into_iter().all(|lean| lean <= most)
            && self.is_straight([0, left], slack)
            && self.is_straight([left, right], slack)
            && self.is_straight([right, last], slack)
            && [left, right].into_iter().all(|k| self.is_corner(k, slack));
        is_castle.then(|| (self.places[left] + self.places[right]) / 2.0)
    }

    /// True if the line turns by nearly a right angle at a vertex, not gradually around it.
    fn is_corner(&self, k: usize, slack: f64) -> bool {
        let least = (self.depth.min(self.width) / 4.0).max(2.0 * slack);
        let at = self.place(k);
        let far = |place: &Point| (place - at).norm() >= least;
        let before = (0..k).rev().map(|i| self.place(i)).find(far).unwrap_or_else(|| self.place(0));
        let after = (k + 1..self.places.len()).map(|i| self.place(i)).find(far);
        let after = after.unwrap_or_else(|| self.place(self.places.len() - 1));
        angle::is_turned(at - before, after - at, CORNER)
    }

    /// Share of its rectangle that a candidate fills, if it leads down, across and up again.
    fn u(&self, slack: f64) -> Option<f64> {
        let (apex, last) = (self.apex(), self.places.len() - 1);
        let beside = LEAN * self.width + TILT * self.depth + slack;
        let (left, right) = (-beside, self.width + beside);
        let steps = || self.places.windows(2);
        // A step must lead on by one measure; it may lead back by at most its tilt times the step along the other.
        let leads_on = |on: f64, along: f64| on >= -2.0 * slack - TILT * along.abs();
        let is_round = self.places.iter().all(|place| (left..=right).contains(&place.x))
            && steps().all(|ends| leads_on(ends[1].x - ends[0].x, ends[1].y - ends[0].y))
            && steps().take(apex).all(|ends| leads_on(ends[1].y - ends[0].y, ends[1].x - ends[0].x))
            && steps().skip(apex).all(|ends| leads_on(ends[0].y - ends[1].y, ends[1].x - ends[0].x));
        let doubled: f64 = steps().map(|ends| (ends[1].x - ends[0].x) * (ends[1].y + ends[0].y)).sum();
        let share = doubled / (2.0 * self.width * self.depth);
        (last > 3 && is_round && share >= U_AREA).then_some(share)
    }
}
