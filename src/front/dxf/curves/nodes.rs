//! Nodes: how the curve goes through each vertex of a line, as turn points (layer 2), curve points (layer 3) and notches say.

use std::collections::BTreeMap;

use crate::front::dxf::chain::Chain;
use crate::front::dxf::fold::Fold;
use crate::front::dxf::layer::Does;
use crate::front::dxf::shape::{Dot, Line};
use crate::geom::{Point, bits};

/// How far from a vertex the point that says its kind may lie, mm: rounding, and less than any two vertices lie apart.
pub(super) const ON: f64 = 0.01;
/// Places of one cell that are kept: only a damaged file has more within a hundredth of a millimetre.
const MOST_AROUND: usize = 16;

/// How a curve goes through a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Node {
    /// It ends there, and another may begin.
    Corner,
    /// It goes on; the vertex is a curve point.
    Smooth,
    /// It goes on; the vertex is a curve point that some systems add for the sake of a notch.
    Notched,
    /// It goes on if it is a curve: a notch stands there.
    Passing,
}

/// What points say of a place.
#[derive(Debug, Clone, Copy, Default)]
struct Signs {
    is_turn: bool,
    is_curve: bool,
    is_notch: bool,
    /// Lines were joined there that the file draws one by one.
    is_joint: bool,
    /// A line has the place twice.
    is_doubled: bool,
}

impl Signs {
    fn and(self, other: Self) -> Self {
        Self {
            is_turn: self.is_turn || other.is_turn,
            is_curve: self.is_curve || other.is_curve,
            is_notch: self.is_notch || other.is_notch,
            is_joint: self.is_joint || other.is_joint,
            is_doubled: self.is_doubled || other.is_doubled,
        }
    }
}

/// The signs of a block, by where they are.
#[derive(Debug, Clone, Default)]
pub(in crate::front::dxf) struct Nodes {
    cells: BTreeMap<[i64; 2], Vec<(Point, Signs)>>,
    /// Whether a curve point is among them.
    pub(super) has_curves: bool,
}

fn cell(at: Point) -> [i64; 2] {
    [at.x, at.y].map(|value| (value / ON).floor() as i64)
}

impl Nodes {
    /// Those of the lines of a block as the file draws them, and of its points.
    pub(in crate::front::dxf) fn of(lines: &[Line], dots: &[Dot]) -> Self {
        let mut nodes = Self::default();
        for dot in dots {
            let signs = match dot.layer.does {
                Does::Turn => Signs { is_turn: true, ..Signs::default() },
                Does::Curve => Signs { is_curve: true, ..Signs::default() },
                Does::Notch(_) => Signs { is_notch: true, ..Signs::default() },
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
            nodes.has_curves |= signs.is_curve;
            nodes.add(dot.at, signs);
        }
        if !nodes.has_curves {
            return Self::default();
        }
        for line in lines.iter().filter(|line| line.layer.is_curved()) {
            let doubled = line.vertices.windows(2).filter(|pair| pair[0].at == pair[1].at);
            doubled.for_each(|pair| nodes.add(pair[0].at, Signs { is_doubled: true, ..Signs::default() }));
            let ends = Chain::of(line.vertices.clone(), line.is_closed).filter(|chain| !chain.is_closed);
            for end in ends.iter().flat_map(|chain| [chain.vertices.first(), chain.vertices.last()]).flatten() {
                nodes.add(end.at, Signs { is_joint: true, ..Signs::default() });
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

    /// The same with what is on the other side of a fold. A line that ends on the fold goes on there.
    pub(super) fn unfolded(self, fold: &Fold) -> Self {
        let mut nodes = Self { has_curves: self.has_curves, ..Self::default() };
        for (at, signs) in self.cells.into_values().flatten() {
            let is_middle = fold.is_middle(at);
            nodes.add(at, Signs { is_joint: signs.is_joint && !is_middle, ..signs });
            if !is_middle {
                nodes.add(fold.mirror(at), signs);
            }
        }
        nodes
    }

    /// How a curve goes through a vertex.
    pub(super) fn at(&self, at: Point) -> Node {
        let [x, y] = cell(at);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        let near = near.filter(|(place, _)| (place - at).norm() <= ON);
        let Signs { is_turn, is_curve, is_notch, is_joint, is_doubled } =
            near.fold(Signs::default(), |signs, (_, more)| signs.and(*more));
        // A place that turns and curves is smooth, even where two lines meet.
        let is_parted = is_doubled || is_joint && !(is_turn && is_curve);
        match (is_parted, is_curve, is_notch) {
            (false, true, false) => Node::Smooth,
            (false, true, true) => Node::Notched,
            (false, false, true) if !is_turn => Node::Passing,
            _ => Node::Corner,
        }
    }
}
