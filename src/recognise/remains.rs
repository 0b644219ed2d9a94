//! Remains of outlines: open lines around a closed line. The closed line is then the seam line of an incomplete outline, and no
//! part. The remains may be one open line, or several together: dashes, sides that do not meet, stretches between notches.

use super::line::{Class, Line, SMALL_OUTLINE, is_straight};
use super::seam;
use crate::analysis::nesting::Nesting;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, cross, left, polyline, ring};
use crate::ir::drawing::Vertex;

/// Share of a closed line that open ones together run beside: that of two sides of four, minus the corners.
const BESIDE: f64 = 0.45;
/// Share of a closed line beside open ones at which it is doubtful that it is a part.
const DOUBTFUL: f64 = 0.15;
/// Such a share for a closed line that lacks a seam line where most have one.
const DOUBTFUL_BARE: f64 = 0.08;
/// Least share of a closed line beside open lines if some of these go far beyond it, as two outlines drawn without a lift do.
const SURELY: f64 = 0.75;
/// Least number of its four sides beside which they must run in that case: neighbours lie beside one or two.
const LEAST_SIDES: usize = 3;
/// Least share of an open line that runs beside the closed one: the outline of a neighbour has one side there.
const OWN: f64 = 0.4;
/// Least distance of an outline from its seam line, mm: a nearer line is the same edge drawn again.
const LEAST_OFF: f64 = 1.0;
/// Cosine of the greatest angle between the way to an open line and the square to the closed one.
const SQUARE: f64 = 0.7;
/// Largest line that may be a letter, mm; a dash is straight.
pub(super) const LETTER: f64 = 15.0;
/// Share of an open line along one side that lies at one distance from the part: its ends stick out beyond the corners.
const EVEN: f64 = 0.75;
/// Greatest difference between equal distances, mm: rounding, and curves in chords.
const SAME_OFF: f64 = 0.3;
/// Number of seam lines of other parts that are measured for the usual distance.
const MEASURED: usize = 32;
/// Least length of the lines around a closed one to be searched, as a multiple of the length that they must cover.
const LEAST_DRAWN: f64 = 2.0 / 3.0;

/// Open lines, and the closed line that they go around.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Remains {
    pub(super) lines: Vec<usize>,
    pub(super) inner: usize,
    /// Certainty: true where they are enough to make the closed line no part, false where they make it doubtful.
    pub(super) is_sure: bool,
}

/// The lines of a drawing, and their nesting.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub(super) lines: &'a [Line],
    pub(super) vertices: &'a [Vertex],
    pub(super) nest: &'a Nesting,
}

/// An edge near a closed line.
struct Edge {
    ends: [Point; 2],
    /// Index of its line.
    line: usize,
    /// True if its line stays near the closed one.
    is_own: bool,
}

impl Edge {
    fn extent(&self) -> Extent {
        Extent::between(self.ends[0], self.ends[1])
    }
}

/// Lines beside a closed one, the share of it that they run beside, and the numbers of its four sides: of those that they run
/// beside for the most part, and of all that they meet.
#[derive(Default)]
struct Beside {
    lines: Vec<usize>,
    share: f64,
    sides: usize,
    met: usize,
}

/// Finds the parts that open lines go around. A part that the budget leaves unsearched counts as a seam line: a part
/// that is too small cannot be mended.
pub(super) fn find(all: Drawn, work: &mut Budget) -> Vec<Remains> {
    let (open, parts) = (all.of(|line| !line.is_closed && line.is_open_question()), all.parts());
    if open.is_empty() || parts.is_empty() {
        return Vec::new();
    }
    let mut found = all.single(&open, &parts, work);
    let mut is_found: Vec<bool> = vec![false; all.lines.len()];
    for remains in &found {
        is_found[remains.inner] = true;
    }
    let near = all.near(open, parts, false);
    for &part in near.parts.iter().filter(|&&part| !is_found[part]) {
        found.extend(all.several(part, &near, work));
    }
    found
}

/// Finds stretches of outlines beside parts that lack a seam line where most have one, except for lines that are `known`
/// remains of other outlines.
pub(super) fn beside_bare(all: Drawn, bare: &[usize], known: &[Remains], work: &mut Budget) -> Vec<Remains> {
    let mut is_known = vec![false; all.lines.len()];
    for remains in known {
        is_known[remains.inner] = true;
        remains.lines.iter().filter(|_| remains.is_sure).for_each(|&i| is_known[i] = true);
    }
    let mut open = all.of(|line| !line.is_closed && line.is_open_question());
    open.retain(|&i| !is_known[i]);
    let near = all.near(open, all.parts(), true);
    bare.iter().filter(|&&part| !is_known[part]).filter_map(|&part| all.several(part, &near, work)).collect()
}

/// Open and closed lines by their boxes.
struct Near {
    /// The box around all open lines: beyond it nothing is searched.
    cloth: Extent,
    open: Vec<usize>,
    open_boxes: Boxes,
    parts: Vec<usize>,
    part_boxes: Boxes,
    /// True if the parts lack a seam line where most have one.
    are_bare: bool,
}

/// Least share of a closed line beside open lines at which these are reported.
fn least(is_bare: bool) -> f64 {
    if is_bare { DOUBTFUL_BARE } else { DOUBTFUL }
}

impl Drawn<'_> {
    /// Lines that satisfy a condition.
    pub(super) fn of(&self, is: impl Fn(&Line) -> bool) -> Vec<usize> {
        (0..self.lines.len()).filter(|&i| is(&self.lines[i])).collect()
    }

    /// Lines that are parts.
    pub(super) fn parts(&self) -> Vec<usize> {
        self.of(|line| line.class == Class::Part)
    }

    fn near(&self, open: Vec<usize>, parts: Vec<usize>, are_bare: bool) -> Near {
        let extents = |lines: &[usize]| Boxes::new(lines.iter().map(|&i| self.lines[i].extent).collect());
        let mut cloth = Extent::EMPTY;
        for &i in &open {
            cloth.join(&self.lines[i].extent);
        }
        Near { cloth, open_boxes: extents(&open), part_boxes: extents(&parts), open, parts, are_bare }
    }

    pub(super) fn points(&self, line: usize) -> Vec<Point> {
        self.lines[line].points(self.vertices)
    }

    /// True if the pen of a closed line is declared a knife, and that of an open one is not.
    pub(super) fn is_named_knife(&self, part: usize, open: usize) -> bool {
        self.lines[part].usage.is_knife() && !self.lines[open].usage.is_knife()
    }

    /// Single open lines that go around much of a part.
    fn single(&self, open: &[usize], parts: &[usize], work: &mut Budget) -> Vec<Remains> {
        let may_be = |line: &Line| line.end - line.first > 2 && line.size() > SMALL_OUTLINE;
        let boxes = Boxes::new(parts.iter().map(|&part| self.lines[part].extent).collect());
        let mut found = Vec::new();
        for &line in open.iter().filter(|&&line| may_be(&self.lines[line])) {
            let extent = self.lines[line].extent;
            work.spend(boxes.cost_near(&extent));
            let fits = |k: &usize| seam::may_be_left_of(&extent, &boxes.all()[*k]);
            let near: Vec<usize> = boxes.near(extent).filter(fits).map(|k| parts[k]).collect();
            if near.is_empty() {
                continue;
            }
            let outline = self.points(line);
            for part in near.into_iter().filter(|&part| !self.is_named_knife(part, line)) {
                let places = self.points(part);
                if !work.spend(seam::COST * (outline.len() + places.len())) || seam::is_left_of(&outline, &places) {
                    found.push(Remains { lines: vec![line], inner: part, is_sure: true });
                }
            }
        }
        found
    }

    /// Open lines that go around a part without a seam line, or around some of it.
    fn several(&self, part: usize, near: &Near, work: &mut Budget) -> Option<Remains> {
        let extent = self.lines[part].extent;
        let reach = extent.grown(seam::FARTHEST);
        let is_beside = |&open: &usize| {
            let line = &self.lines[open];
            let may_be = line.size() > LETTER || is_straight(line.vertices(self.vertices));
            // A line in the box of a part is usually in the part; a slanted side may not be.
            let may_lie_beside = near.are_bare || !extent.covers(&line.extent);
            may_be && may_lie_beside && !self.is_named_knife(part, open)
        };
        if !near.cloth.meets(&reach) {
            return None;
        }
        work.spend(near.open_boxes.cost_near(&reach));
        let open = near.open_boxes.near(reach).map(|k| near.open[k]);
        let mut open: Vec<usize> = open.filter(is_beside).collect();
        let drawn = open.iter().fold(0.0, |sum, &open| sum + self.lines[open].length);
        if drawn < LEAST_DRAWN * least(near.are_bare) * self.lines[part].length {
            return None;
        }
        open.sort_unstable();
        let places = self.points(part);
        let mut edges = Edges::new(self.edges(part, &places, &open, work), near.are_bare);
        let unsearched = |lines| Remains { lines, inner: part, is_sure: true };
        match edges.around(&places, work) {
            Cover::Unsearched => return Some(unsearched(open)),
            Cover::Little => return None,
            Cover::Side(_) | Cover::Partial(_) | Cover::Most(_) => {}
        }
        // Few parts come here: no closed line may stand between, and a line in a neighbour is a line of that.
        edges = Edges::new(self.outside_others(edges.list, part, near, work), near.are_bare);
        edges.walls = Walls::new(self.walls(part, near, work));
        let cover = edges.around(&places, work);
        let is_most = matches!(cover, Cover::Most(_));
        let remains = match cover {
            Cover::Unsearched => unsearched(open),
            Cover::Little => return None,
            // Parts of this size have no seam line, so there is no doubt.
            Cover::Side(_) | Cover::Partial(_) if self.lines[part].size() <= SMALL_OUTLINE => return None,
            Cover::Side(line) if !self.is_usual(line, part, &places, work) => return None,
            Cover::Side(line) => Remains { lines: vec![line], inner: part, is_sure: false },
            Cover::Partial(lines) => Remains { lines, inner: part, is_sure: false },
            Cover::Most(lines) => Remains { lines, inner: part, is_sure: true },
        };
        // A part with a seam line is an outline, unless that is a topstitch, and the part the seam line of a broken outline.
        let has_seam = self.has_seam(part, &places, work);
        (is_most || !has_seam).then_some(Remains { is_sure: remains.is_sure && !has_seam, ..remains })
    }

    /// The edges of open lines near a part.
    fn edges(&self, part: usize, places: &[Point], open: &[usize], work: &mut Budget) -> Vec<Edge> {
        let extent = self.lines[part].extent;
        let (reach, margin) = (extent.grown(seam::FARTHEST), extent.grown(seam::BOX_MARGIN));
        let mut edges = Vec::new();
        for &line in open {
            let Line { first, end, extent, .. } = self.lines[line];
            let is_short = self.lines[line].size() <= SMALL_OUTLINE;
            let cost = if is_short { 1 } else { seam::COST * places.len() + (end - first) as usize };
            let is_own = margin.covers(&extent)
                && (is_short || !work.spend(cost) || share_beside(&self.points(line), places) >= OWN);
            let edge = |ends: &[Vertex]| Edge { ends: [ends[0].at, ends[1].at], line, is_own };
            let is_near = |edge: &Edge| edge.extent().meets(&reach) && margin.covers(&edge.extent());
            edges.extend(self.lines[line].vertices(self.vertices).windows(2).map(edge).filter(is_near));
        }
        edges
    }

    /// The edges that lie in no other part: lines in a part are its own. A neighbour may overlap an outline by rounding.
    fn outside_others(&self, mut edges: Vec<Edge>, part: usize, near: &Near, work: &mut Budget) -> Vec<Edge> {
        let reach = self.lines[part].extent.grown(seam::FARTHEST);
        for other in near.part_boxes.near(reach).map(|k| near.parts[k]).filter(|&other| other != part) {
            let (extent, places) = (self.lines[other].extent, self.points(other));
            edges.retain(|edge| {
                let middle = edge.ends[0] + (edge.ends[1] - edge.ends[0]) / 2.0;
                !extent.holds(middle)
                    || !work.spend(places.len())
                    || !ring::contains(&places, middle)
                    || polyline::distance(middle, &places) <= LEAST_OFF
            });
        }
        edges
    }

    /// The edges of other parts near one.
    fn walls(&self, part: usize, near: &Near, work: &mut Budget) -> Vec<[Point; 2]> {
        let reach = self.lines[part].extent.grown(seam::FARTHEST);
        work.spend(near.part_boxes.cost_near(&reach));
        let mut walls = Vec::new();
        for other in near.part_boxes.near(reach).map(|k| near.parts[k]).filter(|&other| other != part) {
            let vertices = self.lines[other].vertices(self.vertices);
            work.spend(vertices.len());
            let ends = vertices.windows(2).map(|ends| [ends[0].at, ends[1].at]);
            walls.extend(ends.filter(|ends| Extent::between(ends[0], ends[1]).meets(&reach)));
        }
        walls
    }

    /// True if an open line is as far from a part as another part is from its seam line.
    fn is_usual(&self, open: usize, part: usize, places: &[Point], work: &mut Budget) -> bool {
        if !work.spend(self.lines.len() + seam::COST * places.len()) {
            return true;
        }
        let Some(distance) = even_distance(&self.points(open), places) else { return false };
        let part_around = |inner: usize| {
            let outer = self.nest.parent(inner)?;
            let is_part = outer != part && self.lines[outer].class == Class::Part && self.lines[inner].is_outline();
            is_part.then_some([inner, outer])
        };
        let mut seams = (0..self.lines.len()).filter_map(part_around).take(MEASURED);
        seams.any(|pair| {
            let [inner, outer] = pair.map(|line| self.points(line));
            work.spend(2 * seam::COST * outer.len())
                && seam::follows(&inner, &outer)
                && even_distance(&inner, &outer).is_some_and(|other| (other - distance).abs() <= SAME_OFF)
        })
    }

    /// True if a closed line has a seam line inside it: then it is an outline.
    fn has_seam(&self, part: usize, places: &[Point], work: &mut Budget) -> bool {
        work.spend(self.lines.len());
        let is_inner = |&i: &usize| self.nest.parent(i) == Some(part) && self.lines[i].is_outline();
        let mut inner: Vec<usize> = (0..self.lines.len()).filter(is_inner).collect();
        inner.sort_by(|&a, &b| self.lines[b].area.total_cmp(&self.lines[a].area).then(a.cmp(&b)));
        let follows = |&i: &usize| work.spend(seam::COST * places.len()) && seam::follows(&self.points(i), places);
        inner.iter().take(seam::CANDIDATES).any(follows)
    }
}

/// Distance at which most of a line runs beside another one, mm.
fn even_distance(line: &[Point], other: &[Point]) -> Option<f64> {
    let samples = seam::samples(line);
    let mut off: Vec<f64> = samples.iter().map(|(at, _)| polyline::distance(*at, other)).collect();
    off.sort_by(f64::total_cmp);
    let middle = *off.get(off.len() / 2)?;
    let even = off.iter().filter(|off| (**off - middle).abs() <= SAME_OFF).count();
    (even as f64 >= EVEN * off.len() as f64).then_some(middle)
}

/// Share of an open line that runs beside a closed one from outside, square to it.
fn share_beside(open: &[Point], closed: &[Point]) -> f64 {
    let samples = seam::samples(open);
    let runs_beside = |(at, way): &&(Point, Vector)| {
        let foot = |ends: &[Point]| ends[0] + (ends[1] - ends[0]) * polyline::foot(*at, ends[0], ends[1]) - at;
        let ways = closed.windows(2).map(|ends| (foot(ends), ends[1] - ends[0]));
        let nearest = ways.min_by(|a, b| a.0.norm_squared().total_cmp(&b.0.norm_squared()));
        nearest.is_some_and(|(off, edge)| {
            off.norm() <= seam::FARTHEST
                && cross(*way, off).abs() >= SQUARE * way.norm() * off.norm()
                && seam::is_along(*way, edge)
                && !ring::contains(closed, *at)
        })
    };
    samples.iter().filter(runs_beside).count() as f64 / samples.len().max(1) as f64
}

/// Edges of other closed lines, by their boxes: no outline lies beyond one.
#[derive(Default)]
struct Walls {
    ends: Vec<[Point; 2]>,
    boxes: Boxes,
}

impl Walls {
    fn new(ends: Vec<[Point; 2]>) -> Self {
        let boxes = Boxes::new(ends.iter().map(|[a, b]| Extent::between(*a, *b)).collect());
        Self { ends, boxes }
    }
}

/// Extent to which open lines run along a closed one.
enum Cover {
    /// The budget is spent.
    Unsearched,
    Little,
    /// One runs beside one side of it.
    Side(usize),
    /// They run beside some of it.
    Partial(Vec<usize>),
    /// They run beside so much of it that it is no part.
    Most(Vec<usize>),
}

/// The edges of open lines near a closed one, by their boxes.
struct Edges {
    list: Vec<Edge>,
    boxes: Boxes,
    walls: Walls,
    /// True if the closed line lacks a seam line where most parts have one.
    is_bare: bool,
}

impl Edges {
    fn new(list: Vec<Edge>, is_bare: bool) -> Self {
        let boxes = Boxes::new(list.iter().map(Edge::extent).collect());
        Self { list, boxes, walls: Walls::default(), is_bare }
    }

    /// The lines that go around a closed line.
    fn around(&self, places: &[Point], work: &mut Budget) -> Cover {
        let Some(any) = self.beside(places, false, work) else { return Cover::Unsearched };
        if any.share < least(self.is_bare) {
            return Cover::Little; // the usual case
        }
        let Some(own) = self.beside(places, true, work) else { return Cover::Unsearched };
        match (any, own) {
            (_, own) if own.share >= BESIDE => Cover::Most(own.lines),
            (any, _) if any.share >= SURELY && any.sides >= LEAST_SIDES => Cover::Most(any.lines),
            // A line along one side of a part that lacks its seam line is no guide.
            (_, own) if own.share >= least(self.is_bare) && (own.met > 1 || self.is_bare) => Cover::Partial(own.lines),
            // A line along one side is a fold, a grain line or the edge of the cloth, or is as far off as outlines are.
            (_, own) if own.share >= DOUBTFUL && own.sides == 1 => match own.lines[..] {
                [line] => Cover::Side(line),
                _ => Cover::Little,
            },
            _ => Cover::Little,
        }
    }

    /// The lines beside a closed line from outside: all open ones, or those that stay near it. `None` when the budget is spent.
    fn beside(&self, places: &[Point], is_own: bool, work: &mut Budget) -> Option<Beside> {
        let samples = seam::samples(places);
        let turn = ring::area(places).signum();
        let mut found = Beside::default();
        let mut sides = [[0_usize; 2]; 4];
        let mut beside = 0_usize;
        for (k, (at, way)) in samples.iter().enumerate() {
            // The remaining samples are too few to reach the share.
            if ((beside + samples.len() - k) as f64) < least(self.is_bare) * samples.len() as f64 {
                break;
            }
            let outward = -left(*way) * (turn / way.norm());
            let side = if outward.x.abs() > outward.y.abs() {
                usize::from(outward.x > 0.0)
            } else {
                2 + usize::from(outward.y > 0.0)
            };
            sides[side][1] += 1;
            let around = Extent::between(*at, *at).grown(seam::FARTHEST);
            if !work.spend(self.boxes.cost_near(&around) + self.walls.boxes.cost_near(&around)) {
                return None;
            }
            if let Some(line) = self.line_beside(*at, *way, outward, is_own) {
                sides[side][0] += 1;
                beside += 1;
                found.lines.push(line);
            }
        }
        found.share = beside as f64 / samples.len().max(1) as f64;
        found.sides = sides.iter().filter(|[beside, all]| 2 * beside > *all).count();
        found.met = sides.iter().filter(|[beside, _]| *beside > 0).count();
        found.lines.sort_unstable();
        found.lines.dedup();
        Some(found)
    }

    /// The open line that runs beside a place of a closed one, with nothing closed between them.
    fn line_beside(&self, at: Point, way: Vector, outward: Vector, is_own: bool) -> Option<usize> {
        let around = Extent::between(at, at).grown(seam::FARTHEST);
        // Distance of an edge straight ahead, if it is there.
        let ahead = |[a, b]: [Point; 2]| {
            let off = a + (b - a) * polyline::foot(at, a, b) - at;
            let distance = off.norm();
            (distance <= seam::FARTHEST && off.dot(&outward) >= SQUARE * distance).then_some(distance)
        };
        let edges = self.boxes.near(around).map(|k| &self.list[k]);
        let along = edges.filter(|edge| (edge.is_own || !is_own) && seam::is_along(way, edge.ends[1] - edge.ends[0]));
        let near = along.filter_map(|edge| Some((ahead(edge.ends)?, edge.line)));
        let off = near.filter(|(distance, _)| *distance > LEAST_OFF);
        // The edges are in no order.
        let (distance, line) = off.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        let mut walls = self.walls.boxes.near(around).filter_map(|k| ahead(self.walls.ends[k]));
        // The outline of a neighbour may lie in this one.
        (!walls.any(|wall| wall < distance - SAME_OFF)).then_some(line)
    }
}
