//! Noding: open strokes parted where the end of another lies on them, and where they cross.

use super::line::SMALL_OUTLINE;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, cross, polyline};
use crate::ir::drawing::{Drawing, PenStroke, Vertex};

/// A stroke, or what lies of it between two places where others meet it.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    /// The stroke, as an index.
    pub(super) stroke: usize,
    /// The pen that draws it.
    pub(super) pen: u16,
    /// Its places, two at least.
    pub(super) vertices: Vec<Vertex>,
}

/// Place of a stroke at which it is parted: its chord, the share of that, and the place.
type Parting = (usize, f64, Point);

/// A chord of an edge.
#[derive(Debug, Clone, Copy)]
struct Chord {
    edge: usize,
    at: usize,
    ends: [Point; 2],
}

/// Edges of some open strokes, in their order; strokes below the size of a part stay whole, and are no reason to part others.
pub(super) fn edges(drawing: &Drawing, strokes: &[usize], reach: f64, work: &mut Budget) -> Vec<Edge> {
    let edge = |&stroke: &usize| {
        let PenStroke { pen, .. } = drawing.strokes[stroke];
        Edge { stroke, pen, vertices: drawing.vertices[drawing.strokes[stroke].range()].to_vec() }
    };
    let whole: Vec<Edge> = strokes.iter().map(edge).collect();
    let Some(partings) = partings(&whole, reach, work) else { return whole };
    let parted = whole.into_iter().zip(partings).flat_map(|(edge, places)| edge.parted(places, reach));
    parted.collect()
}

/// Where each edge is parted; `None` when the search has no end.
fn partings(edges: &[Edge], reach: f64, work: &mut Budget) -> Option<Vec<Vec<Parting>>> {
    let mut partings = vec![Vec::new(); edges.len()];
    let large = edges.iter().enumerate().filter(|(_, edge)| edge.length() > SMALL_OUTLINE);
    let chords: Vec<Chord> = large
        .flat_map(|(edge, Edge { vertices, .. })| {
            let ends = vertices.windows(2).map(|ends| [ends[0].at, ends[1].at]);
            ends.enumerate().map(move |(at, ends)| Chord { edge, at, ends })
        })
        .collect();
    let extent = |chord: &Chord| Extent::between(chord.ends[0], chord.ends[1]);
    let boxes = Boxes::new(chords.iter().map(|chord| extent(chord).grown(reach)).collect());
    for (i, one) in chords.iter().enumerate() {
        if !work.spend(boxes.cost_near(&extent(one))) {
            return None;
        }
        for other in boxes.near_from(i + 1, extent(one)).map(|k| &chords[k]) {
            if one.edge == other.edge || edges[one.edge].pen != edges[other.edge].pen {
                continue;
            }
            for (stem, bar) in [(one, other), (other, one)] {
                for end in edges[stem.edge].ends_on(stem) {
                    let share = polyline::foot(end, bar.ends[0], bar.ends[1]);
                    let foot = bar.ends[0] + (bar.ends[1] - bar.ends[0]) * share;
                    let meets = (foot - end).amax() <= reach && edges[bar.edge].is_amid(foot, reach);
                    partings[bar.edge].extend(meets.then_some((bar.at, share, foot)));
                }
            }
            if let Some([share, of_other]) = crossing(one.ends, other.ends) {
                let place = one.ends[0] + (one.ends[1] - one.ends[0]) * share;
                if [one, other].iter().all(|chord| edges[chord.edge].is_amid(place, reach)) {
                    partings[one.edge].push((one.at, share, place));
                    partings[other.edge].push((other.at, of_other, place));
                }
            }
        }
    }
    Some(partings)
}

/// The shares of two chords at which they cross; each holds its first end and not its last.
fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<[f64; 2]> {
    let sine = cross(b - a, d - c);
    let shares = [cross(c - a, d - c) / sine, cross(c - a, b - a) / sine];
    shares.iter().all(|share| (0.0..1.0).contains(share)).then_some(shares)
}

impl Edge {
    pub(super) fn length(&self) -> f64 {
        self.vertices.windows(2).map(|ends| (ends[1].at - ends[0].at).norm()).sum()
    }

    /// The ends of the edge that are ends of a chord of it.
    fn ends_on(&self, chord: &Chord) -> impl Iterator<Item = Point> {
        let first = (chord.at == 0).then_some(chord.ends[0]);
        let last = (chord.at + 2 == self.vertices.len()).then_some(chord.ends[1]);
        first.into_iter().chain(last)
    }

    /// Whether a place of the edge lies at neither of its ends.
    fn is_amid(&self, place: Point, reach: f64) -> bool {
        let ends = [self.vertices[0].at, self.vertices[self.vertices.len() - 1].at];
        ends.iter().all(|end| (end - place).amax() > reach)
    }

    /// What lies between some places of it, each line with what drew it. Places within reach of the one before are that one.
    fn parted(self, mut places: Vec<Parting>, reach: f64) -> Vec<Self> {
        places.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        places.dedup_by(|later, earlier| (later.2 - earlier.2).amax() <= reach);
        let Self { stroke, pen, vertices } = self;
        let mut edges: Vec<Self> = Vec::with_capacity(places.len() + 1);
        let mut open = vec![vertices[0]];
        let mut places = places.into_iter().peekable();
        for (at, end) in vertices[1..].iter().enumerate() {
            while let Some((_, _, place)) = places.next_if(|place| place.0 == at) {
                let vertex = Vertex { at: place, span: end.span };
                // A place on a vertex makes no line without length.
                if open[open.len() - 1].at != place {
                    open.push(vertex);
                }
                let before = std::mem::replace(&mut open, vec![vertex]);
                edges.extend((before.len() > 1).then_some(Self { stroke, pen, vertices: before }));
            }
            if open[open.len() - 1].at != end.at {
                open.push(*end);
            }
        }
        edges.extend((open.len() > 1).then_some(Self { stroke, pen, vertices: open }));
        edges
    }
}
