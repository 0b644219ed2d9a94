//! Nodes: behaviour of the curve at each vertex of a line, given by turn points (layer 2), curve points (layer 3) and notches.

use std::collections::BTreeMap;

use crate::front::pattern::chain::Chain;
use crate::front::pattern::fold::Fold;
use crate::front::pattern::layer::Does;
use crate::front::pattern::retrace::retraces;
use crate::front::pattern::shape::{Dot, Line};
use crate::geom::{Point, bits};
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// Distance within which points are equal, mm: above rounding, and below the distance of any two vertices. A vertex without a
/// point that near takes the kind of the points within [`Dxf::POINT_OFF`].
pub(super) const ON: f64 = 0.01;
/// Maximum number of points kept per cell; only a damaged file has more.
const MOST_AROUND: usize = 16;

/// Behaviour of a curve at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Node {
    /// The curve ends; another may begin.
    Corner,
    /// The curve continues smoothly; the vertex is a curve point.
    Smooth,
    /// The curve continues smoothly; the vertex is a curve point at a notch, as some systems add.
    Notched,
    /// A notch: the curve, if any, continues.
    Passing,
}

/// Mark of the file at a point.
#[derive(Debug, Clone, Copy)]
enum Sign {
    Turn,
    Curve,
    Notch,
    /// Lines that the file draws separately are joined there.
    Joint,
    /// A line repeats the point.
    Doubled,
}

/// Set of the signs of a point.
#[derive(Debug, Clone, Copy, Default)]
struct Signs([bool; 5]);

impl Signs {
    fn has(self, sign: Sign) -> bool {
        self.0[sign as usize]
    }

    fn with(mut self, sign: Sign) -> Self {
        self.0[sign as usize] = true;
        self
    }

    fn without(mut self, sign: Sign) -> Self {
        self.0[sign as usize] = false;
        self
    }

    fn and(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] || other.0[k]))
    }
}

/// Points that a line passes, each with the numbers of the layers of open lines that do, or none for a ring. Another line that ends there
/// stands on it, and joins nothing; open lines of one layer are parts of an outline, one of which may go on past its start.
struct Passed(BTreeMap<[u64; 2], Vec<Option<u16>>>);

impl Passed {
    fn of(lines: &[Line]) -> Self {
        let curved = || lines.iter().filter(|line| line.layer.is_curved() && !line.vertices.is_empty());
        let is_ring = |line: &Line| line.is_closed || line.vertices[0].at == line.vertices[line.vertices.len() - 1].at;
        let mut passed: BTreeMap<[u64; 2], Vec<Option<u16>>> = BTreeMap::new();
        if curved().any(|line| !is_ring(line)) {
            for line in curved() {
                let count = line.vertices.len();
                let (inner, by) =
                    if is_ring(line) { (0..count, None) } else { (1..count.max(2) - 1, Some(line.layer.row.number)) };
                line.vertices[inner].iter().for_each(|vertex| passed.entry(bits(vertex.at)).or_default().push(by));
            }
        }
        Self(passed)
    }

    /// True if a line that ends at a point stands on another one there.
    fn has(&self, at: Point, layer: u16) -> bool {
        self.0.get(&bits(at)).is_some_and(|by| by.iter().any(|by| *by != Some(layer)))
    }
}

/// The first curve point that marks no vertex of any line of its block.
fn stray(lines: &[Line], dots: &[Dot]) -> Option<Span> {
    let mut vertices: Vec<Point> = lines.iter().flat_map(|line| &line.vertices).map(|vertex| vertex.at).collect();
    vertices.sort_unstable_by(|a, b| a.x.total_cmp(&b.x));
    let marks_vertex = |dot: &&Dot| {
        let first = vertices.partition_point(|at| at.x < dot.at.x - Dxf::POINT_OFF);
        let mut near = vertices[first..].iter().take_while(|at| at.x <= dot.at.x + Dxf::POINT_OFF);
        near.any(|at| (at - dot.at).norm() <= Dxf::POINT_OFF)
    };
    dots.iter().filter(|dot| dot.layer.does == Does::Curve).find(|dot| !marks_vertex(dot)).map(|dot| dot.span)
}

/// The signs of a block, by position.
#[derive(Debug, Clone, Default)]
pub(in crate::front::pattern) struct Nodes {
    cells: BTreeMap<[i64; 2], Vec<(Point, Signs)>>,
    /// True if there is a curve point.
    pub(super) has_curves: bool,
    /// The first curve point that marks no vertex.
    pub(super) stray: Option<Span>,
}

fn cell(at: Point) -> [i64; 2] {
    [at.x, at.y].map(|value| (value / Dxf::POINT_OFF).floor() as i64)
}

impl Nodes {
    /// Signs from the lines of a block as drawn, and from its points.
    pub(in crate::front::pattern) fn of(lines: &[Line], dots: &[Dot]) -> Self {
        let mut nodes = Self::default();
        for dot in dots {
            let sign = match dot.layer.does {
                Does::Turn => Sign::Turn,
                Does::Curve => Sign::Curve,
                Does::Notch(_) => Sign::Notch,
                Does::Outline
                | Does::Fold
                | Does::Inner
                | Does::Drill
                | Does::Drawn
                | Does::Seam
                | Does::Sign
                | Does::Fine => {
                    continue;
                }
            };
            nodes.has_curves |= matches!(sign, Sign::Curve);
            nodes.add(dot.at, Signs::default().with(sign));
        }
        if !nodes.has_curves {
            return Self::default();
        }
        nodes.stray = stray(lines, dots);
        let passed = Passed::of(lines);
        for line in lines.iter().filter(|line| line.layer.is_curved()) {
            let doubled = line.vertices.windows(2).filter(|pair| pair[0].at == pair[1].at);
            doubled.for_each(|pair| nodes.add(pair[0].at, Signs::default().with(Sign::Doubled)));
            let open = |chain: &Chain| !chain.is_closed && !retraces(chain);
            let ends = Chain::of(line.vertices.clone(), line.is_closed).filter(open);
            let ends = ends.iter().flat_map(|chain| [chain.vertices.first(), chain.vertices.last()]).flatten();
            for end in ends.filter(|end| !passed.has(end.at, line.layer.row.number)) {
                nodes.add(end.at, Signs::default().with(Sign::Joint));
            }
        }
        nodes
    }

    fn add(&mut self, at: Point, signs: Signs) {
        let places = self.cells.entry(cell(at)).or_default();
        let known = places.iter().position(|(place, _)| bits(*place) == bits(at));
        match known {
            Some(k) => places[k].1 = places[k].1.and(signs),
            None if places.len() < MOST_AROUND => places.push((at, signs)),
            None => {}
        }
    }

    /// Signs within [`ON`] of a point, and signs within [`Dxf::POINT_OFF`].
    fn signs(&self, at: Point) -> [Signs; 2] {
        let [x, y] = cell(at);
        let mut found = [Signs::default(); 2];
        for (place, signs) in
            (x - 1..=x + 1).flat_map(|x| self.cells.range([x, y - 1]..=[x, y + 1])).flat_map(|(_, all)| all)
        {
            for (found, reach) in found.iter_mut().zip([ON, Dxf::POINT_OFF]) {
                if (place - at).norm() <= reach {
                    *found = found.and(*signs);
                }
            }
        }
        found
    }

    /// Signs on both sides of a fold. A line that ends on the fold continues on the other side.
    pub(super) fn unfolded(self, fold: &Fold) -> Self {
        let mut nodes = Self { has_curves: self.has_curves, stray: self.stray, ..Self::default() };
        for (at, signs) in self.cells.into_values().flatten() {
            let is_middle = fold.is_middle(at);
            nodes.add(at, if is_middle { signs.without(Sign::Joint) } else { signs });
            if !is_middle {
                nodes.add(fold.mirror(at), signs);
            }
        }
        nodes
    }

    /// Behaviour of a curve at a vertex.
    pub(super) fn at(&self, at: Point) -> Node {
        let [signs, beside] = self.signs(at);
        let is_marked = [Sign::Turn, Sign::Curve].iter().any(|sign| signs.has(*sign));
        let [is_turn, is_curve] =
            [Sign::Turn, Sign::Curve].map(|sign| if is_marked { signs.has(sign) } else { beside.has(sign) });
        let is_notch = beside.has(Sign::Notch);
        // A point marked as turn and curve point is smooth, even where two lines meet.
        let is_parted = signs.has(Sign::Doubled) || signs.has(Sign::Joint) && !(is_turn && is_curve);
        match (is_parted, is_curve, is_notch) {
            (false, true, false) => Node::Smooth,
            (false, true, true) => Node::Notched,
            (false, false, true) if !is_turn => Node::Passing,
            _ => Node::Corner,
        }
    }
}
