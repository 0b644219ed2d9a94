//! Graph of open lines by their meeting ends: lines that are part of rings, and trees that stand off them.

use std::collections::BTreeMap;

use super::chain::{Chain, REACH};
use crate::geom::{Point, polyline};
use crate::ir::drawing::Vertex;

/// Number of ends in the node of a continuing line; lines branch at nodes with more.
const PASSING: usize = 2;

/// An end of a line: twice the index of the line, plus one for its last vertex.
pub(super) type End = usize;

/// A path along a spur and back.
#[derive(Debug)]
pub(super) struct Tour {
    /// Start of the spur.
    pub(super) root: Vertex,
    /// Vertices after the root, ending with the root again.
    pub(super) way: Vec<Vertex>,
    /// Free ends.
    pub(super) tips: Vec<Point>,
    /// Indices of its lines.
    pub(super) lines: Vec<usize>,
}

impl Tour {
    /// A tour along one line and back.
    pub(super) fn along(vertices: &[Vertex]) -> Self {
        let last = vertices.len() - 1;
        let way = vertices[1..].iter().chain(vertices[1..last].iter().rev()).copied();
        let back = Vertex { at: vertices[0].at, span: vertices[1].span };
        let way = way.chain([back]).collect();
        Self { root: vertices[0], way, tips: vec![vertices[last].at], lines: Vec::new() }
    }
}

/// A remaining step of a tour.
enum Step {
    /// Out along a line from one of its ends, then along everything attached to its other end.
    Out(End),
    Back(Vec<Vertex>),
}

/// A line reached from a free end of its tree.
#[derive(Debug, Clone, Copy)]
struct Reached {
    /// The end at which it is entered.
    end: End,
    /// Index of the previous line in the list of reached lines.
    from: Option<usize>,
    /// Distance of its other end, mm along the lines.
    far: f64,
}

/// Graph with open lines as edges and their meeting ends as nodes.
pub(super) struct Graph<'a> {
    lines: &'a [Chain],
    /// Node of each end of an open line.
    of_end: Vec<Option<usize>>,
    /// Ends at each node.
    ends: Vec<Vec<End>>,
    /// True for lines in rings or between rings: those that remain after free ends are removed repeatedly.
    is_round: Vec<bool>,
}

impl<'a> Graph<'a> {
    pub(super) fn of(lines: &'a [Chain]) -> Self {
        let cell = |at: Point| [at.x, at.y].map(|value| (value / REACH).floor() as i64);
        let (of_end, is_round) = (vec![None; 2 * lines.len()], lines.iter().map(|line| !line.is_closed).collect());
        let mut graph = Self { lines, of_end, ends: Vec::new(), is_round };
        let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
        let mut places: Vec<Point> = Vec::new();
        for end in (0..2 * lines.len()).filter(|end| !lines[end / 2].is_closed) {
            let at = graph.place(end);
            let [x, y] = cell(at);
            let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
            let near =
                around.filter_map(|cell| cells.get(&cell)).flatten().find(|&&node| (places[node] - at).norm() <= REACH);
            let node = near.copied().unwrap_or_else(|| {
                places.push(at);
                graph.ends.push(Vec::new());
                cells.entry([x, y]).or_default().push(places.len() - 1);
                places.len() - 1
            });
            graph.ends[node].push(end);
            graph.of_end[end] = Some(node);
        }
        graph.take_off_tips();
        graph
    }

    /// Finds the lines in rings by repeatedly removing lines with a free end.
    fn take_off_tips(&mut self) {
        let mut counts: Vec<usize> = self.ends.iter().map(Vec::len).collect();
        let mut free: Vec<usize> = (0..counts.len()).filter(|&node| counts[node] == 1).collect();
        while let Some(node) = free.pop() {
            let Some(&end) = self.ends[node].iter().find(|&&end| self.is_round[end / 2]) else { continue };
            self.is_round[end / 2] = false;
            counts[node] = 0;
            if let Some(other) = self.of_end[end ^ 1] {
                counts[other] -= 1;
                free.extend((counts[other] == 1).then_some(other));
            }
        }
    }

    /// Position of an end of a line.
    pub(super) fn place(&self, end: End) -> Point {
        let vertices = &self.lines[end / 2].vertices;
        vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
    }

    /// The other ends that meet an end.
    fn others(&self, end: End) -> impl Iterator<Item = End> + '_ {
        self.of_end[end].into_iter().flat_map(|node| &self.ends[node]).copied().filter(move |&other| other != end)
    }

    /// Ends of open lines, in order.
    fn open_ends(&self) -> impl Iterator<Item = End> + '_ {
        (0..self.of_end.len()).filter(|&end| self.of_end[end].is_some())
    }

    /// Tours along the trees attached to rings.
    pub(super) fn tours_off_rings(&self) -> Vec<Tour> {
        let leads_round = |ends: &Vec<End>| ends.iter().any(|end| self.is_round[end / 2]);
        let is_of_ring: Vec<bool> = self.ends.iter().map(leads_round).collect();
        let is_root = |end: &End| !self.is_round[end / 2] && self.of_end[*end].is_some_and(|node| is_of_ring[node]);
        self.open_ends().filter(is_root).map(|end| self.tour(end)).collect()
    }

    /// Groups of line ends that meet away from all rings.
    pub(super) fn meetings(&self) -> impl Iterator<Item = &[End]> {
        let is_off_rings = |ends: &&Vec<End>| ends.len() >= PASSING && !ends.iter().any(|end| self.is_round[end / 2]);
        self.ends.iter().filter(is_off_rings).map(Vec::as_slice)
    }

    /// True if a line is part of a ring or connects two rings.
    pub(super) fn leads_round(&self, line: usize) -> bool {
        self.is_round[line]
    }

    /// The far ends of a line, entered at `root`, and of everything attached to it.
    pub(super) fn ends_from(&self, root: End) -> Vec<End> {
        let (mut ends, mut next) = (Vec::new(), vec![root]);
        while let Some(end) = next.pop() {
            ends.push(end ^ 1);
            next.extend(self.others(end ^ 1));
        }
        ends
    }

    /// Tours along the branches attached to the trunk of a tree.
    pub(super) fn tours_off(&self, trunk: &[usize]) -> Vec<Tour> {
        let mut is_trunk = vec![false; self.lines.len()];
        for &line in trunk {
            is_trunk[line] = true;
        }
        let ends = trunk.iter().flat_map(|line| [2 * line, 2 * line + 1]).flat_map(|end| self.others(end));
        let mut roots: Vec<End> = ends.filter(|end| !is_trunk[end / 2]).collect();
        roots.sort_unstable();
        roots.dedup();
        roots.into_iter().map(|end| self.tour(end)).collect()
    }

    /// The tour that starts at an end of a line, follows the line and everything attached to its other end, and returns.
    pub(super) fn tour(&self, root: End) -> Tour {
        let first = self.from(root)[0];
        let mut tour = Tour { root: first, way: Vec::new(), tips: Vec::new(), lines: Vec::new() };
        let mut steps = vec![Step::Out(root)];
        while let Some(step) = steps.pop() {
            let end = match step {
                Step::Out(end) => end,
                Step::Back(way) => {
                    tour.way.extend(way);
                    continue;
                }
            };
            let vertices = self.from(end);
            let here = tour.way.last().unwrap_or(&first).at;
            let mut back: Vec<Vertex> = vertices[1..vertices.len() - 1].to_vec();
            back.reverse();
            back.push(Vertex { at: here, span: vertices[1].span });
            steps.push(Step::Back(back));
            tour.way.extend(&vertices[1..]);
            tour.lines.push(end / 2);
            let mut next: Vec<End> = self.others(end ^ 1).collect();
            if next.is_empty() {
                tour.tips.push(self.place(end ^ 1));
            }
            next.reverse();
            steps.extend(next.into_iter().map(Step::Out));
        }
        tour
    }

    /// The vertices of a line, starting at one of its ends.
    fn from(&self, end: End) -> Vec<Vertex> {
        let mut vertices = self.lines[end / 2].vertices.clone();
        if !end.is_multiple_of(2) {
            vertices.reverse();
        }
        vertices
    }

    /// The lines of each branched tree that is not attached to a ring.
    pub(super) fn trees(&self) -> Vec<Vec<usize>> {
        let (mut is_seen, mut is_node_seen) = (self.is_round.clone(), vec![false; self.ends.len()]);
        let mut trees = Vec::new();
        for first in self.open_ends().map(|end| end / 2) {
            if std::mem::replace(&mut is_seen[first], true) {
                continue;
            }
            let (mut tree, mut next) = (Vec::new(), vec![first]);
            let (mut is_branched, mut is_off_ring) = (false, false);
            while let Some(line) = next.pop() {
                tree.push(line);
                for node in [2 * line, 2 * line + 1].into_iter().filter_map(|end| self.of_end[end]) {
                    if std::mem::replace(&mut is_node_seen[node], true) {
                        continue;
                    }
                    is_branched |= self.ends[node].len() > PASSING;
                    is_off_ring |= self.ends[node].iter().any(|end| self.is_round[end / 2]);
                    for other in self.ends[node].iter().map(|end| end / 2) {
                        next.extend((!std::mem::replace(&mut is_seen[other], true)).then_some(other));
                    }
                }
            }
            if is_branched && !is_off_ring {
                tree.sort_unstable();
                trees.push(tree);
            }
        }
        trees
    }

    /// The free ends of a tree.
    pub(super) fn tips(&self, tree: &[usize]) -> Vec<End> {
        let ends = tree.iter().flat_map(|line| [2 * line, 2 * line + 1]);
        ends.filter(|&end| self.others(end).next().is_none()).collect()
    }

    /// The lines of the longest path between two free ends of a tree.
    pub(super) fn trunk(&self, tree: &[usize]) -> Vec<usize> {
        let Some(&tip) = self.tips(tree).first() else { return tree.to_vec() };
        self.longest(self.longest(tip).0).1
    }

    /// The free end farthest from another one along a tree, and the lines between them.
    fn longest(&self, tip: End) -> (End, Vec<usize>) {
        let mut reached: Vec<Reached> = Vec::new();
        let mut next = vec![Reached { end: tip, from: None, far: 0.0 }];
        while let Some(Reached { end, from, far }) = next.pop() {
            let far = far + polyline::length(&self.lines[end / 2].points());
            reached.push(Reached { end, from, far });
            let from = Some(reached.len() - 1);
            next.extend(self.others(end ^ 1).map(|end| Reached { end, from, far }));
        }
        let last = (0..reached.len()).max_by(|&a, &b| reached[a].far.total_cmp(&reached[b].far));
        let lines = std::iter::successors(last, |&k| reached[k].from).map(|k| reached[k].end / 2);
        (last.map_or(tip, |k| reached[k].end ^ 1), lines.collect())
    }
}
