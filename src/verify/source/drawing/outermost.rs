//! Audit of the lines of a drawing that are cut, judged by its strokes alone: no line is cut in the place of the outline around
//! it, and no stroke from edge to edge of a part is left out.
//!
//! The judge knows less than the reader and is stricter where it knows. Lines of several strokes are judged by whether they go
//! around a cut. Where the user gave pens a meaning, only the lines that close outlines are judged, since pens say nothing
//! about shapes.

use std::cell::{OnceCell, RefCell};

use super::drawn::Drawn;
use super::{around, cloth, rectangle, slits};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::marker::Notch;
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::machine::Job;
use crate::machine::plot::Frame;
use crate::verify::rules;

/// Smallest line that may be the outline of a part, mm.
const LEAST_SIZE: f64 = 30.0;
/// Greatest gap of an outline, as a fraction of its length.
const GAP_SHARE: f64 = 0.08;
/// Least mean width of an outline, mm: a narrower one is a line out and back.
const LEAST_WIDTH: f64 = 4.0;
/// Widest hem, mm: marks on one are narrower.
const WIDEST_HEM: f64 = 75.0;
/// Greatest number of outlines in a rectangle that is a part: itself and its seam line. Slits are not looked for in a rectangle
/// with more.
const MOST_IN_A_PART: usize = 2;
/// Greatest number of cuts in a rectangle that are compared to find two side by side.
const MOST_HELD: usize = 512;
/// Distance by which parts may stand over the frame that they touch, mm.
const SAME_BOX: f64 = 0.5;
/// Least distance allowed between a cut and its outline, mm: CAD programs end lines so far beside their start.
const LEAST_OFF: f64 = 0.2;
/// Rounding of gaps, mm.
const CLOSE_EPSILON: f64 = 1e-6;
/// Least share of a cut that an uncut line in it encloses as its seam line: then the cut is an outline.
const SEAM_SHARE: f64 = 0.3;
/// Fraction by which the area of a frame may be below that of its box.
const FRAME_LACK: f64 = 0.01;
/// Limits of a notch that is a stroke, mm: length, mouth, depth.
const STROKE_LENGTH: f64 = 55.0;
const STROKE_MOUTH: [f64; 2] = [0.6, 11.5];
const STROKE_DEPTH: [f64; 2] = [1.5, 14.5];
/// Distance from the outline within which both ends of a notch lie, mm.
const ON_EDGE: f64 = 0.4;
/// Distance from the edge at which a stroke may be a letter of a text beside the edge, mm.
const OFF_EDGE: f64 = 0.1;
/// Greatest distance of a letter from the next one of its text, as a multiple of its size.
const ROOM: f64 = 3.0;
/// Least fall of the depth between two deeper places of a stroke that makes it an M and no notch, mm.
const DENT: f64 = 0.6;
/// Greatest distance of the ends of a cut from those of its stroke, mm.
const SAME_END: f64 = 0.05;

/// Cuts of a drawing as it was read: the points of each contour and of each leg of a notch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawingCuts {
    contours: Vec<Vec<Point>>,
    legs: Vec<[Point; 2]>,
    /// Lines that close an outline and are not in the drawing.
    closed: Vec<Vec<Point>>,
}

impl DrawingCuts {
    /// Cuts of a marker before any pass.
    pub fn of(marker: &Marker) -> Self {
        let contours = marker.contours().map(|(_, contour)| marker.points(contour)).collect();
        let notches = marker.pieces.iter().flat_map(|piece| &piece.notches);
        let legs = notches.flat_map(Notch::strokes).map(|stroke| [stroke.from, stroke.to]).collect();
        let closed = marker.drawing.iter().flat_map(|account| account.aside.moved.closed.iter().cloned()).collect();
        Self { contours, legs, closed }
    }
}

/// Findings about the lines of a drawing that are cut, by its strokes as they are read a second time; none for a dialect that
/// says itself which lines are cut.
pub fn drawing_audit(dialect: &str, bytes: &[u8], read: &DrawingCuts, job: &Job) -> Vec<Finding> {
    let Some(second) = super::second(dialect) else { return Vec::new() };
    let mut outermost = Worst::new(&rules::SOURCE_OUTERMOST, Some(0.0));
    let mut strokes = Worst::new(&rules::SOURCE_STROKES, Some(0.0));
    let drawn = (second.strokes)(bytes, &job.profile);
    let is_said = drawn.is_said(job);
    let Drawn { strokes: drawn, unit, .. } = drawn;
    let judging = Judging::new(&drawn, unit, read, job);
    let mut wrong = judging.made_up();
    let mut lost = Vec::new();
    if !is_said {
        wrong.extend(judging.in_uncut_outlines());
        wrong.extend(judging.surrounded());
        wrong.extend(judging.about_the_cloth());
        lost = judging.lost_strokes();
        lost.extend(judging.slits());
    }
    for (point, count) in wrong.into_iter().zip(1..) {
        outermost.see(f64::from(count), || Sighting::at(0.0, point, 0));
    }
    for (point, count) in lost.into_iter().zip(1..) {
        strokes.see(f64::from(count), || Sighting::at(0.0, point, 0));
    }
    vec![outermost.finding(), strokes.finding()]
}

struct Judging<'a> {
    drawn: &'a [Vec<Point>],
    /// Grid of the numbers in the file, mm; 0 when they are not rounded.
    unit: f64,
    cuts: &'a DrawingCuts,
    job: &'a Job,
    /// The boxes of the contours that are cut.
    boxes: Boxes,
    /// The boxes of strokes as small as letters, built at first use.
    small: OnceCell<Boxes>,
    work: RefCell<Budget>,
}

impl<'a> Judging<'a> {
    fn new(drawn: &'a [Vec<Point>], unit: f64, cuts: &'a DrawingCuts, job: &'a Job) -> Self {
        let boxes = Boxes::new(cuts.contours.iter().map(|points| Extent::of(points)).collect());
        Self {
            drawn,
            unit,
            cuts,
            job,
            boxes,
            small: OnceCell::new(),
            work: RefCell::new(Budget::of_lines(drawn.len() + cuts.contours.len())),
        }
    }

    /// Places of cuts inside outlines that are not cut.
    fn in_uncut_outlines(&self) -> Vec<Point> {
        let drawn = self.drawn;
        let outlines: Vec<&[Point]> = drawn.iter().map(|stroke| &stroke[..]).filter(|s| goes_around(s)).collect();
        let size = |stroke: &&[Point]| ring::area(stroke).abs();
        let largest = outlines.iter().map(size).fold(0.0, f64::max);
        let mut found = Vec::new();
        for stroke in outlines {
            let is_asked_frame = self.job.profile.hpgl.frame == Frame::Outermost && size(&stroke) >= largest;
            if !is_asked_frame && !self.is_cut(stroke) {
                found.extend(self.cut_inside(stroke));
            }
        }
        found
    }

    /// Places where the edge of the cloth is cut, or a line outside it, unless the user says which lines are cut.
    fn about_the_cloth(&self) -> Vec<Point> {
        let Job { lines, profile, .. } = self.job;
        if lines.all || profile.hpgl.frame != Frame::Auto {
            return Vec::new();
        }
        let outlines = self.drawn.iter().filter(|stroke| goes_around(stroke)).map(|stroke| cloth::Outline {
            stroke,
            is_rectangle: is_own_box(stroke),
            is_cut: self.is_cut(stroke),
        });
        let outlines: Vec<cloth::Outline> = outlines.collect();
        let is_frame = |one: &&cloth::Outline| one.is_rectangle && !one.is_cut && self.is_around_several(one.stroke);
        let edges: Vec<Extent> = outlines.iter().filter(is_frame).map(|one| Extent::of(one.stroke)).collect();
        let mut found = cloth::outside(&edges, self.cuts.contours.iter());
        if lines.inner.is_none() {
            let is_open = |stroke: &&Vec<Point>| stroke.len() > 1 && !goes_around(stroke);
            let extents = self.drawn.iter().filter(is_open).map(|stroke| Extent::of(stroke));
            let open: Vec<Extent> = extents.filter(|one| one.size().0.max(one.size().1) >= LEAST_SIZE).collect();
            found.extend(cloth::cut_edge(&outlines, &open));
        }
        found
    }

    /// True if large cuts lie side by side in a rectangle that lies in no cut.
    fn is_around_several(&self, rectangle: &[Point]) -> bool {
        let (boxes, reach) = (self.boxes.all(), Extent::of(rectangle).grown(SAME_BOX));
        let is_large = |k: &usize| boxes[*k].size().0.max(boxes[*k].size().1) >= LEAST_SIZE;
        let inside = self.boxes.near(reach).filter(|&k| reach.covers(&boxes[k])).filter(is_large);
        let inside: Vec<usize> = inside.take(MOST_HELD).collect();
        let several = inside.iter().any(|&k| inside.iter().any(|&other| !boxes[k].meets(&boxes[other])));
        several && !self.lies_in_a_cut(rectangle)
    }

    /// Places of cuts that open lines enclose and that have no seam line of their own.
    fn surrounded(&self) -> Vec<Point> {
        let close = self.job.profile.drawing.close_mm + CLOSE_EPSILON;
        let found = around::surrounded(self.drawn, &self.cuts.contours, close).into_iter();
        let found = found.map(|k| &self.cuts.contours[k]).filter(|cut| !self.has_seam(cut));
        found.map(|cut| cut[0]).collect()
    }

    fn has_seam(&self, cut: &[Point]) -> bool {
        let (extent, least) = (Extent::of(cut), SEAM_SHARE * ring::area(cut).abs());
        let is_seam = |stroke: &&Vec<Point>| {
            goes_around(stroke) && extent.covers(&Extent::of(stroke)) && ring::area(stroke).abs() >= least
        };
        self.drawn.iter().filter(is_seam).any(|stroke| !self.is_cut(stroke))
    }

    /// Places where a line closes an outline over more than a gap and not along the edge of a rectangle.
    fn made_up(&self) -> Vec<Point> {
        let close = self.job.profile.drawing.close_mm + CLOSE_EPSILON;
        let is_long = |places: &&Vec<Point>| polyline::length(places) > close;
        let closed: Vec<&Vec<Point>> = self.cuts.closed.iter().filter(is_long).collect();
        if closed.is_empty() {
            return Vec::new();
        }
        let rectangles = rectangle::drawn(self.drawn, close);
        let is_drawn = |places: &[Point]| rectangles.iter().any(|one| one.runs_along(places, close));
        closed.into_iter().filter(|places| !is_drawn(places)).map(|places| places[0]).collect()
    }

    /// Greatest distance between a cut and its stroke, mm: curves are drawn in chords.
    fn reach(&self) -> f64 {
        self.job.profile.tolerance(self.unit).max(LEAST_OFF)
    }

    /// True if some cut has the box of a stroke, or runs along all of it and on.
    fn is_cut(&self, stroke: &[Point]) -> bool {
        let extent = Extent::of(stroke);
        let reach = self.reach();
        let boxes = self.boxes.all();
        let has_box = |k: usize| {
            let corners = [boxes[k].min - extent.min, boxes[k].max - extent.max];
            corners.iter().all(|corner| corner.amax() <= reach)
        };
        let follows = |k: usize| {
            let points = &self.cuts.contours[k];
            boxes[k].grown(reach).covers(&extent)
                && self.work.borrow_mut().spend(stroke.len().saturating_mul(points.len()))
                && stroke.iter().all(|&place| polyline::distance(place, points) <= reach)
        };
        self.boxes.near(extent).any(has_box) || self.boxes.near(extent).any(follows)
    }

    /// Place of the first cut inside an outline that is not cut; `None` if the outline is a frame or lies in a part itself.
    /// When the work budget is spent, the outline counts as one with a cut inside.
    fn cut_inside(&self, stroke: &[Point]) -> Option<Point> {
        let extent = Extent::of(stroke);
        let boxes = self.boxes.all();
        // Parts may touch the frame.
        let (is_rectangle, reach) = (is_own_box(stroke), extent.grown(SAME_BOX));
        let inside: Vec<usize> = self.boxes.near(reach).filter(|&k| reach.covers(&boxes[k])).collect();
        if inside.is_empty() || self.lies_in_a_cut(stroke) {
            return None;
        }
        let holds = |&k: &usize| {
            let points = &self.cuts.contours[k];
            let is_large = boxes[k].size().0.max(boxes[k].size().1) >= LEAST_SIZE;
            is_large && (is_rectangle || points.iter().all(|&point| ring::contains(stroke, point)))
        };
        let cost: usize = inside.iter().map(|&k| self.cuts.contours[k].len()).sum();
        if !self.work.borrow_mut().spend(cost.saturating_mul(stroke.len())) {
            return Some(stroke[0]);
        }
        let held: Vec<usize> = inside.into_iter().filter(holds).collect();
        let &first = held.first()?;
        // A frame is a rectangle around parts side by side.
        let beside = held.iter().any(|&k| held.iter().any(|&other| !boxes[k].meets(&boxes[other])))
            || held.len() > 1 && !held.iter().any(|&k| held.iter().all(|&other| boxes[k].covers(&boxes[other])));
        (!is_rectangle || !beside && !self.holds_another(stroke, first)).then(|| self.cuts.contours[first][0])
    }

    /// True if a rectangle contains, beside a cut, an outline wider than any hem that is not cut because it is open or lies in
    /// an open one: then the rectangle is a frame.
    fn holds_another(&self, rectangle: &[Point], cut: usize) -> bool {
        let (reach, beside) = (Extent::of(rectangle).grown(SAME_BOX), &self.boxes.all()[cut]);
        let close = self.job.profile.drawing.close_mm;
        let is_beside = |extent: &Extent| {
            let (width, height) = extent.size();
            width.min(height) > WIDEST_HEM && reach.covers(extent) && !extent.meets(beside)
        };
        let is_open = |stroke: &&Vec<Point>| gap(stroke) > close && is_beside(&Extent::of(stroke));
        let is_in_open = |stroke: &Vec<Point>| {
            let extent = Extent::of(stroke);
            self.drawn.iter().filter(is_open).any(|other| Extent::of(other).covers(&extent))
                || around::is_surrounded(stroke, self.drawn, close)
        };
        let mut outlines = self.drawn.iter().filter(|stroke| goes_around(stroke) && is_beside(&Extent::of(stroke)));
        outlines.any(|stroke| is_open(&stroke) || is_in_open(stroke))
    }

    fn lies_in_a_cut(&self, stroke: &[Point]) -> bool {
        let boxes = self.boxes.all();
        let extent = Extent::of(stroke);
        let around: Vec<usize> = self.boxes.near(extent).filter(|&k| boxes[k].covers(&extent)).collect();
        around.into_iter().any(|k| {
            let points = &self.cuts.contours[k];
            self.work.borrow_mut().spend(points.len()) && ring::contains(points, stroke[0])
        })
    }

    /// Tips of strokes from edge to edge of a part that are not cut.
    fn lost_strokes(&self) -> Vec<Point> {
        let drawn = self.drawn;
        let mut ends: Vec<[Point; 2]> = self.cuts.contours.iter().map(|c| [c[0], c[c.len() - 1]]).collect();
        ends.extend(&self.cuts.legs);
        ends.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
        let mut found = Vec::new();
        for stroke in drawn {
            let Some(tip) = tip(stroke) else { continue };
            let [first, .., last] = stroke[..] else { continue };
            if !is_among(&ends, [first, last])
                && !is_among(&ends, [last, first])
                && self.is_on_part([first, last], tip, ON_EDGE)
                && !self.is_along_a_cut(stroke)
                && (self.is_on_part([first, last], tip, OFF_EDGE) || !self.is_in_text(stroke))
            {
                found.push(tip);
            }
        }
        found
    }

    /// Tips of slits that are drawn by themselves and are not cut, and of signs at an edge that are cut.
    fn slits(&self) -> Vec<Point> {
        if self.job.lines.all {
            return Vec::new();
        }
        let strokes = slits::Strokes::of(self.drawn);
        let legs = self.cuts.legs.iter().copied();
        let mut found: Vec<Point> = legs.filter(|leg| strokes.is_sign(*leg)).map(|leg| leg[1]).collect();
        let mut ends: Vec<[Point; 2]> = self.cuts.contours.iter().map(|c| [c[0], c[c.len() - 1]]).collect();
        ends.extend(&self.cuts.legs);
        ends.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
        for outline in self.drawn.iter().filter(|stroke| goes_around(stroke) && gap(stroke) <= LEAST_OFF) {
            let Some(edge) = self.part_of(outline, &strokes) else { continue };
            let is_lost = |[foot, tip]: &[Point; 2]| {
                !is_among(&ends, [*foot, *tip])
                    && !is_among(&ends, [*tip, *foot])
                    && self.work.borrow_mut().spend(edge.len())
                    && ring::contains(edge, *tip)
                    && !self.is_along_a_cut(&[*foot, *tip])
            };
            found.extend(strokes.slits(edge).into_iter().filter(is_lost).map(|slit| slit[1]));
        }
        found
    }

    /// The cut of an outline, if it lies in no other cut and is no rectangle around others.
    fn part_of(&self, outline: &[Point], strokes: &slits::Strokes) -> Option<&Vec<Point>> {
        let (extent, reach) = (Extent::of(outline), self.reach());
        let is_same = |&k: &usize| {
            let other = self.boxes.all()[k];
            (other.min - extent.min).amax().max((other.max - extent.max).amax()) <= reach
        };
        let cut = self.boxes.near(extent).find(is_same).map(|k| &self.cuts.contours[k])?;
        let is_outer = |k: usize| self.boxes.all()[k].grown(reach).covers(&extent);
        let is_frame = || is_own_box(outline) && strokes.has_more_in(extent, MOST_IN_A_PART, goes_around);
        let is_one = self.boxes.near(extent).filter(|&k| is_outer(k)).count() == 1;
        (is_one && cut.len() > 3 && !is_frame()).then_some(cut)
    }

    /// True if a stroke that begins off its edge may be a letter: another small stroke is near it.
    fn is_in_text(&self, stroke: &[Point]) -> bool {
        let extent = Extent::of(stroke);
        let size = |extent: &Extent| extent.size().0.max(extent.size().1);
        let around = extent.grown(ROOM * size(&extent));
        let is_text = |other: &Extent| size(other) <= STROKE_DEPTH[1];
        let small = self.small.get_or_init(|| {
            let strokes = self.drawn.iter().filter(|other| other.len() > 1).map(|other| Extent::of(other));
            Boxes::new(strokes.filter(is_text).collect())
        });
        if !self.work.borrow_mut().spend(small.cost_near(&around)) {
            return false;
        }
        let near = || small.near(around).map(|k| small.all()[k]);
        near().any(|other| other != extent)
    }

    /// True if one cut runs along all of a stroke, place by place and from edge to edge: the cut is the outline, which the
    /// stroke continues there.
    fn is_along_a_cut(&self, stroke: &[Point]) -> bool {
        let extent = Extent::of(stroke);
        let (boxes, reach) = (self.boxes.all(), self.reach());
        let looked_at = stroke.windows(2).flat_map(|ends| [ends[0] + (ends[1] - ends[0]) / 2.0, ends[1]]);
        let looked_at: Vec<Point> = stroke.first().copied().into_iter().chain(looked_at).collect();
        self.boxes.near(extent).any(|k| {
            let points = &self.cuts.contours[k];
            boxes[k].grown(reach).covers(&extent)
                && self.work.borrow_mut().spend(looked_at.len().saturating_mul(points.len()))
                && looked_at.iter().all(|&place| polyline::distance(place, points) <= reach)
        })
    }

    /// True if two places lie within `reach` mm of the edge of one part and a third one inside it. Also true when the work
    /// budget is spent.
    fn is_on_part(&self, ends: [Point; 2], tip: Point, reach: f64) -> bool {
        let around = Extent::between(ends[0], ends[1]).grown(reach);
        let near: Vec<usize> = self.boxes.near(around).collect();
        near.into_iter().any(|k| {
            let points = &self.cuts.contours[k];
            if points.len() < 4 || points[0] != points[points.len() - 1] {
                return false;
            }
            if !self.work.borrow_mut().spend(3 * points.len()) {
                return true;
            }
            let is_near = |end: &Point| polyline::distance(*end, points) <= reach;
            ends.iter().all(is_near) && ring::contains(points, tip)
        })
    }
}

/// True if a stroke is large and comes back nearly to its start.
fn goes_around(stroke: &[Point]) -> bool {
    let (width, height) = Extent::of(stroke).size();
    if stroke.len() < 3 || width.max(height) < LEAST_SIZE {
        return false;
    }
    let length = polyline::length(stroke);
    gap(stroke) <= GAP_SHARE * length && ring::area(stroke).abs() >= LEAST_WIDTH / 2.0 * length
}

/// Distance from the end of a stroke to its start, mm.
fn gap(stroke: &[Point]) -> f64 {
    (stroke[stroke.len() - 1] - stroke[0]).norm()
}

/// True if a stroke fills its own box.
fn is_own_box(stroke: &[Point]) -> bool {
    let (width, height) = Extent::of(stroke).size();
    ring::area(stroke).abs() >= (1.0 - FRAME_LACK) * width * height
}

/// The place of a stroke farthest from its mouth, if it has the measures of a notch.
fn tip(stroke: &[Point]) -> Option<Point> {
    let [first, _, .., last] = stroke[..] else { return None };
    let is_within = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value);
    if !is_within((last - first).norm(), STROKE_MOUTH) || polyline::length(stroke) > STROKE_LENGTH {
        return None;
    }
    let depth = |at: &Point| polyline::distance_to_segment(*at, first, last);
    let deepest = stroke.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)))?;
    let depths: Vec<f64> = stroke.iter().map(depth).collect();
    // A stroke with several notches comes back to the edge between them.
    let mut notches = depths.split_inclusive(|depth| *depth <= ON_EDGE / 2.0);
    let is_notch = |depths: &[f64]| !has_dent(depths) && depths.iter().all(|depth| *depth <= STROKE_DEPTH[1]);
    (depth(deepest) >= STROKE_DEPTH[0] && notches.all(is_notch)).then_some(*deepest)
}

/// True if some depth lies below greater ones on both sides.
fn has_dent(depths: &[f64]) -> bool {
    let greatest = |most: &mut f64, depth: &f64| {
        *most = most.max(*depth);
        Some(*most)
    };
    let before: Vec<f64> = depths.iter().scan(0.0, greatest).collect();
    let behind: Vec<f64> = depths.iter().rev().scan(0.0, greatest).collect();
    let around = before.iter().zip(behind.iter().rev());
    around.zip(depths).any(|((before, behind), depth)| before.min(*behind) - depth > DENT)
}

/// True if a cut goes from one place to another; the cuts are sorted by the X of their starts.
fn is_among(ends: &[[Point; 2]], [from, to]: [Point; 2]) -> bool {
    let first = ends.partition_point(|cut| cut[0].x < from.x - SAME_END);
    let near = ends[first..].iter().take_while(|cut| cut[0].x <= from.x + SAME_END);
    let mut same = near.filter(|cut| (cut[0] - from).amax() <= SAME_END && (cut[1] - to).amax() <= SAME_END);
    same.next().is_some()
}
