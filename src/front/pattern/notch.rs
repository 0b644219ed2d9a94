//! Notches: the points of notches on an outline become slits, or stretches of the outline itself.

use std::f64::consts::{FRAC_PI_3, PI};

use super::doubts::{Doubt, Reason};
use super::drawn::{self, LEAST_DEPTH};
use super::layer::Form;
use crate::geom::budget::Budget;
use crate::geom::{Point, Vector, left, polyline, ring};
use crate::ir::drawing::Vertex;
use crate::ir::list::FULL_SPEED;
use crate::ir::marker::{Notch, NotchKind, NotchStroke};
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// Distance on both sides of a notch over which the direction of the edge is measured, mm.
const BESIDE: f64 = 1.0;
/// Least and largest width of a notch in the outline, mm: others become slits.
pub(super) const MOUTHS: [f64; 2] = [1.0, Notch::WIDEST];
/// Least length of a mouth, as a fraction of its edge: at this value the edge bends by a third of a right angle.
const STRAIGHT: f64 = 0.98;
/// Chords of a round bottom.
const ROUND: usize = 12;
/// Distance within which two notches are one, mm.
const SAME: f64 = 0.1;
/// Largest difference of the unit vectors of two notches that are one: six degrees.
const SAME_WAY: f64 = 0.1;

/// Point of a notch in the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark {
    pub(super) form: Form,
    pub(super) at: Point,
    /// mm.
    pub(super) depth: f64,
    pub(super) width: f64,
    /// Direction, in either sense.
    pub(super) along: Option<Vector>,
    pub(super) span: Span,
}

impl Mark {
    fn doubt(&self, reason: Reason) -> Doubt {
        Doubt { reason, mm: self.depth, span: self.span }
    }
}

/// Outline with its notches.
#[derive(Debug, Default)]
pub(super) struct NotchedOutline {
    pub(super) outline: Vec<Vertex>,
    pub(super) slits: Vec<Notch>,
    pub(super) doubts: Vec<Doubt>,
}

/// Site of a notch on its outline.
#[derive(Debug, Clone, Copy)]
struct Site {
    mark: Mark,
    /// Distance along the outline, mm.
    station: f64,
    root: Point,
    /// Unit vector into the part.
    inwards: Vector,
    /// True if its angle leads out of the part.
    is_turned: bool,
}

/// Outline with its measures.
struct Edge<'a> {
    vertices: &'a [Vertex],
    /// Points, with the first one repeated at the end, and their stations.
    points: Vec<Point>,
    stations: Vec<f64>,
    is_left: bool,
}

/// Puts notches on a closed outline, whose first vertex is not repeated.
pub(super) fn cut(mut outline: Vec<Vertex>, marks: &[Mark], work: &mut Budget) -> NotchedOutline {
    let mut notched = NotchedOutline::default();
    let mut placed: Vec<Site> = Vec::new();
    if !marks.is_empty() {
        let edge = Edge::of(&outline);
        for mark in marks {
            if drawn::makes_notch_at(&edge.points, mark.at, work) {
                notched.doubts.push(mark.doubt(Reason::Drawn));
                continue;
            }
            match edge.place(mark, work) {
                Ok(found) => placed.push(found),
                Err((reason, mm)) => notched.doubts.push(Doubt { reason, mm, span: mark.span }),
            }
        }
        let start = edge.start(&placed);
        let [before, length] = [edge.stations[start], edge.length()];
        outline.rotate_left(start);
        for notch in &mut placed {
            notch.station = (notch.station - before).rem_euclid(length);
        }
    }
    placed.sort_by(|a, b| a.station.total_cmp(&b.station));
    let length = polyline::length(&around(&outline));
    notched.doubts.extend(merge(&mut placed, length).iter().map(|merged| merged.doubt(Reason::InAnother)));
    if placed.is_empty() {
        return NotchedOutline { outline, ..notched };
    }
    let edge = Edge::of(&outline);
    let mouths = edge.mouths(&placed);
    let mut taken = mouths.iter().peekable();
    for notch in &placed {
        while taken.next_if(|mouth| mouth.to < notch.station).is_some() {}
        let mark = &notch.mark;
        let is_bar = mark.form == Form::T && edge.has_room_for_bar(notch, work);
        match taken.peek().filter(|mouth| mouth.from <= notch.station) {
            // Its own mouth, or that of another notch that already makes this cut; its mirror image is another notch, too.
            Some(mouth) if mouth.notch.mark.span == mark.span && mouth.notch.station == notch.station => {
                notched.doubts.extend(notch.turned());
            }
            Some(_) => notched.doubts.push(mark.doubt(Reason::InAnother)),
            None => {
                notched.doubts.extend(notch.turned());
                notched.slits.push(notch.slit(is_bar));
                let is_otherwise = notch.is_wide() || mark.form == Form::T && !is_bar;
                notched.doubts.extend(is_otherwise.then(|| mark.doubt(Reason::AsSlit)));
            }
        }
    }
    notched.outline = if mouths.is_empty() { outline } else { edge.with(&mouths) };
    notched
}

/// Keeps one of the notches at each place of a closed outline, in their order along it. Returns the dropped ones that ask for
/// another kind of notch than the one that stays.
fn merge(placed: &mut Vec<Site>, length: f64) -> Vec<Mark> {
    let mut lost = Vec::new();
    let mut is_one = |next: &Site, before: &Site, distance: f64| {
        let is_one = distance <= SAME;
        lost.extend((is_one && !next.asks_for_the_same_as(before)).then_some(next.mark));
        is_one
    };
    placed.dedup_by(|next, before| is_one(next, before, next.station - before.station));
    if let [first, .., last] = &placed[..]
        && is_one(last, first, first.station + length - last.station)
    {
        placed.pop();
    }
    lost
}

/// Mouth of a notch: the stretch of the outline that it replaces.
#[derive(Debug, Clone, Copy)]
struct Mouth {
    notch: Site,
    /// mm along the outline.
    from: f64,
    to: f64,
}

/// Points of an outline, with the first one repeated at the end.
fn around(outline: &[Vertex]) -> Vec<Point> {
    outline.iter().chain(&outline[..1]).map(|vertex| vertex.at).collect()
}

impl<'a> Edge<'a> {
    fn of(vertices: &'a [Vertex]) -> Self {
        let points = around(vertices);
        let stations = polyline::stations(&points);
        let is_left = ring::area(&points[..vertices.len()]) > 0.0;
        Self { vertices, points, stations, is_left }
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Place at a station, which may lie beyond either end.
    fn at(&self, station: f64) -> Point {
        polyline::place(&self.points, &self.stations, station.rem_euclid(self.length()))
    }

    /// Site of a mark on the outline; otherwise the reason that it has none, with its measure, mm.
    fn place(&self, mark: &Mark, work: &mut Budget) -> Result<Site, (Reason, f64)> {
        if mark.depth > Notch::LONGEST {
            return Err((Reason::TooDeep, mark.depth));
        }
        if !work.spend(2 * self.points.len()) {
            return Err((Reason::OffEdge, Dxf::NOTCH_OFF)); // the file is refused anyway
        }
        let distance = |k: usize| polyline::distance_to_segment(mark.at, self.points[k], self.points[k + 1]);
        let nearest = (0..self.vertices.len()).map(|k| (distance(k), k)).min_by(|a, b| a.0.total_cmp(&b.0));
        let (off, k) = nearest.expect("an outline has an edge");
        if off > Dxf::NOTCH_OFF {
            return Err((Reason::OffEdge, off));
        }
        let [a, b] = [self.points[k], self.points[k + 1]];
        let foot = polyline::foot(mark.at, a, b);
        let station = self.stations[k] + foot * (b - a).norm();
        let root = a + (b - a) * foot;
        let beside = BESIDE.min(self.length() / 8.0);
        let way = self.at(station + beside) - self.at(station - beside);
        let inwards = left(way).try_normalize(0.0).unwrap_or(left(b - a) / (b - a).norm());
        let inwards = if self.is_left { inwards } else { -inwards };
        // An angle that leads out of the part is that of the notch seen from outside. An angle along the edge is ignored.
        let is_turned = mark.along.is_some_and(|along| along.dot(&inwards) <= -FRAC_PI_3.cos());
        let along = mark.along.map(|along| if along.dot(&inwards) < 0.0 { -along } else { along });
        let inwards = along.filter(|along| along.dot(&inwards) >= FRAC_PI_3.cos()).unwrap_or(inwards);
        let placed = Site { mark: *mark, station, root, inwards, is_turned };
        let is_inside = ring::contains(&self.points[..self.vertices.len()], placed.tip());
        if is_inside { Ok(placed) } else { Err((Reason::LeavesPart, mark.depth)) }
    }

    /// True if the crossbar of a T has the width of crossbars, and is inside the part.
    fn has_room_for_bar(&self, notch: &Site, work: &mut Budget) -> bool {
        let [least, most] = MOUTHS;
        let ring = &self.points[..self.vertices.len()];
        (least..=most).contains(&notch.width())
            && work.spend(2 * self.points.len())
            && notch.bar().iter().all(|&end| ring::contains(ring, end))
    }

    /// First vertex outside all mouths, or else the first vertex: the start of the outline.
    fn start(&self, placed: &[Site]) -> usize {
        let length = self.length();
        let mut mouths: Vec<[f64; 2]> = Vec::new();
        for notch in placed.iter().filter(|notch| notch.is_wide()) {
            let [from, to] = notch.ends();
            mouths.extend([[from, to], [from + length, to + length], [from - length, to - length]]);
        }
        mouths.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut next, mut reached) = (0, f64::NEG_INFINITY);
        let mut is_free = |station: f64| {
            while let Some([_, to]) = mouths.get(next).filter(|[from, _]| *from <= station) {
                reached = reached.max(*to);
                next += 1;
            }
            reached < station
        };
        (0..self.vertices.len()).find(|&k| is_free(self.stations[k])).unwrap_or(0)
    }

    /// Mouths of notches in their order along the outline: apart from each other, from corners and from the start.
    fn mouths(&self, placed: &[Site]) -> Vec<Mouth> {
        let mut mouths: Vec<Mouth> = Vec::new();
        let [least, most] = MOUTHS;
        for &notch in placed.iter().filter(|notch| notch.is_wide()) {
            let width = notch.width();
            let [from, to] = notch.ends();
            let fits = (least..=most).contains(&width) && notch.mark.depth >= LEAST_DEPTH;
            let is_free = mouths.last().map_or(0.0, |last| last.to) < from && to < self.length();
            if fits && is_free && (self.at(to) - self.at(from)).norm() >= STRAIGHT * width {
                mouths.push(Mouth { notch, from, to });
            }
        }
        mouths
    }

    /// Outline with these notches.
    fn with(&self, mouths: &[Mouth]) -> Vec<Vertex> {
        let mut vertices: Vec<Vertex> = Vec::with_capacity(self.vertices.len() + mouths.len() * (ROUND + 2));
        let mut k = 0;
        for mouth in mouths {
            while k < self.vertices.len() && self.stations[k] < mouth.from {
                vertices.push(self.vertices[k]);
                k += 1;
            }
            let ends = [mouth.from, mouth.to].map(|station| self.at(station));
            vertices.extend(mouth.notch.way(ends).into_iter().map(|at| Vertex { at, span: mouth.notch.mark.span }));
            while k < self.vertices.len() && self.stations[k] <= mouth.to {
                k += 1;
            }
        }
        vertices.extend_from_slice(&self.vertices[k..]);
        vertices
    }
}

impl Site {
    /// Doubt about an angle that leads out of the part.
    fn turned(&self) -> Option<Doubt> {
        self.is_turned.then(|| self.mark.doubt(Reason::Turned))
    }

    fn tip(&self) -> Point {
        self.root + self.inwards * self.mark.depth
    }

    /// Width of the mouth or the crossbar, mm; the depth if the file has no width.
    fn width(&self) -> f64 {
        if self.mark.width > 0.0 { self.mark.width } else { self.mark.depth }
    }

    /// True if the notch is a stretch of the outline.
    fn is_wide(&self) -> bool {
        match self.mark.form {
            Form::T => false,
            Form::Plain => self.mark.width > 0.0,
            Form::Castle | Form::Check | Form::U => true,
        }
    }

    /// Start and end of the mouth, mm along the outline.
    fn ends(&self) -> [f64; 2] {
        let half = self.width() / 2.0;
        [self.station - half, self.station + half]
    }

    /// Stretch of the outline from one end of the mouth to the other.
    fn way(&self, [from, to]: [Point; 2]) -> Vec<Point> {
        let down = self.inwards * self.mark.depth;
        let inner = match self.mark.form {
            Form::Plain | Form::Check | Form::T => vec![self.tip()],
            Form::Castle => vec![from + down, to + down],
            Form::U => self.round([from, to]),
        };
        [&[from], &inner[..], &[to]].concat()
    }

    /// Half circle between straight sides, or the arc alone of a flat notch.
    fn round(&self, [from, to]: [Point; 2]) -> Vec<Point> {
        let half = (to - from).norm() / 2.0;
        let along = (to - from) / (2.0 * half);
        let depth = self.mark.depth;
        let radius = if depth >= half { half } else { (half * half + depth * depth) / (2.0 * depth) };
        let centre = from + (to - from) / 2.0 + self.inwards * (depth - radius);
        let opening = if depth >= half { PI / 2.0 } else { (half / radius).min(1.0).asin() };
        let place = |k: usize| {
            let angle = opening * (2.0 * k as f64 / ROUND as f64 - 1.0);
            centre + along * (radius * angle.sin()) + self.inwards * (radius * angle.cos())
        };
        if depth > half { (0..=ROUND).map(place).collect() } else { (1..ROUND).map(place).collect() }
    }

    /// Ends of the crossbar of a T.
    fn bar(&self) -> [Point; 2] {
        let half = left(self.inwards) * (self.width() / 2.0);
        [self.tip() - half, self.tip() + half]
    }

    /// True if two notches at one place are equal.
    fn asks_for_the_same_as(&self, other: &Self) -> bool {
        let [own, its] = [self, other].map(|placed| (placed.mark.form, placed.mark.depth, placed.mark.width));
        own == its && (self.inwards - other.inwards).norm() <= SAME_WAY
    }

    /// Straight cut from the edge inwards, with a crossbar or without.
    fn slit(&self, with_bar: bool) -> Notch {
        let (tip, span) = (self.tip(), self.mark.span);
        let [from, to] = self.bar();
        let kind = if with_bar { NotchKind::T(NotchStroke { from, to, span }) } else { NotchKind::Slit };
        Notch { kind, root: self.root, tip, percent: FULL_SPEED, span }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 100 mm, drawn clockwise or not.
    fn square(is_left: bool) -> Vec<Vertex> {
        let mut places = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]];
        if !is_left {
            places.reverse();
        }
        places.iter().map(|&[x, y]| Vertex { at: Point::new(x, y), span: Span::default() }).collect()
    }

    fn mark(form: Form, at: [f64; 2], [depth, width]: [f64; 2]) -> Mark {
        let span = Span { start: (100.0 * at[0] + at[1]) as u32, ..Span::default() };
        Mark { form, at: at.into(), depth, width, along: None, span }
    }

    fn notched(is_left: bool, marks: &[Mark]) -> NotchedOutline {
        cut(square(is_left), marks, &mut Budget::of_a_marker())
    }

    #[test]
    fn a_slit_goes_inwards_whichever_way_the_outline_runs() {
        for is_left in [true, false] {
            let found = notched(is_left, &[mark(Form::Plain, [40.0, 0.05], [6.0, 0.0])]);
            let [slit] = &found.slits[..] else { panic!("{found:?}") };
            assert_eq!((slit.root, slit.tip, found.doubts.len()), (Point::new(40.0, 0.0), Point::new(40.0, 6.0), 0));
            assert_eq!(found.outline.len(), 4);
        }
    }

    #[test]
    fn an_angle_of_the_file_holds_in_either_sense_unless_it_leads_along_the_edge() {
        for (along, tip) in [([0.6, 0.8], [43.0, 4.0]), ([-0.6, -0.8], [43.0, 4.0]), ([1.0, 0.1], [40.0, 5.0])] {
            let mark = Mark { along: Some(along.into()), ..mark(Form::Plain, [40.0, 0.0], [5.0, 0.0]) };
            let found = notched(true, &[mark]);
            assert!((found.slits[0].tip - Point::from(tip)).norm() < 1e-9, "{along:?}");
        }
    }

    #[test]
    fn wide_notches_are_ways_of_the_outline_wherever_that_starts() {
        for (form, added) in [(Form::Plain, 3), (Form::Check, 3), (Form::Castle, 4), (Form::U, ROUND + 3)] {
            for x in [40.0, 3.0] {
                for is_left in [true, false] {
                    let found = notched(is_left, &[mark(form, [x, 0.0], [5.0, 4.0])]);
                    assert!(found.slits.is_empty() && found.doubts.is_empty(), "{form:?} {found:?}");
                    assert_eq!(found.outline.len(), 4 + added, "{form:?}");
                    let points: Vec<Point> = found.outline.iter().map(|vertex| vertex.at).collect();
                    let area = ring::area(&points).abs();
                    assert!((10_000.0 - 21.0..10_000.0 - 9.0).contains(&area), "{form:?}: {area}");
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_cut_so_is_a_slit_or_is_left_out() {
        let doubts = |marks: &[Mark]| {
            let found = notched(true, marks);
            (found.slits.len(), found.doubts.iter().map(|doubt| doubt.reason).collect::<Vec<_>>())
        };
        assert_eq!(doubts(&[mark(Form::Plain, [0.0, 0.0], [5.0, 4.0])]), (1, vec![Reason::AsSlit]));
        assert_eq!(doubts(&[mark(Form::Castle, [50.0, 0.0], [5.0, 14.0])]), (1, vec![Reason::AsSlit]));
        assert_eq!(doubts(&[mark(Form::Plain, [50.0, 5.0], [5.0, 0.0])]), (0, vec![Reason::OffEdge]));
        assert_eq!(doubts(&[mark(Form::Plain, [50.0, 0.0], [16.0, 0.0])]), (0, vec![Reason::TooDeep]));
        let beside = [mark(Form::U, [50.0, 0.0], [5.0, 4.0]), mark(Form::Plain, [51.0, 0.0], [5.0, 0.0])];
        assert_eq!(doubts(&beside), (0, vec![Reason::InAnother]));
        let other = [mark(Form::Plain, [50.0, 0.0], [5.0, 0.0]), mark(Form::Plain, [50.05, 0.0], [5.0, 4.0])];
        assert_eq!(doubts(&other), (1, vec![Reason::InAnother]));
        for width in [0.5, 13.0, 500.0] {
            assert_eq!(doubts(&[mark(Form::T, [50.0, 0.0], [5.0, width])]), (1, vec![Reason::AsSlit]), "{width}");
        }
        assert_eq!(doubts(&[mark(Form::T, [3.0, 0.0], [5.0, 10.0])]), (1, vec![Reason::AsSlit]));
        let twice = [mark(Form::Plain, [50.0, 0.0], [5.0, 0.0]), mark(Form::Plain, [50.05, 0.0], [5.0, 0.0])];
        assert_eq!(doubts(&twice), (1, vec![]));
        let around = [mark(Form::Plain, [0.02, 0.0], [5.0, 0.0]), mark(Form::Plain, [0.0, 0.02], [5.0, 0.0])];
        assert_eq!(doubts(&around).0, 1, "one of them is at the end of the outline");
        let over = [mark(Form::U, [50.0, 0.0], [5.0, 4.0]), mark(Form::U, [53.0, 0.0], [5.0, 4.0])];
        assert_eq!(doubts(&over), (1, vec![Reason::AsSlit]));
    }
}
