//! Lines of a block as drawn in the file: places and curves, without joins.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use super::lookup::Lookup;
use super::tags::Item;
use crate::geom::{Extent, Point, Vector, left};
use crate::machine::patterns::Dxf;

/// Greatest distance from a fold line of a place on it, and between lines that count as one, mm.
pub(super) const MEETS: f64 = Dxf::ENDS_MEET;
/// Radius beyond which a curve counts as straight, mm: on such a large circle, rounding of the centre moves every place.
const STRAIGHT: f64 = 1e9;
/// Angle below which an arc counts as a full turn, rad.
const ROUND_EPSILON: f64 = 1e-8;

/// Circle of a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// Start angle and sweep, rad.
    pub(super) start: f64,
    pub(super) sweep: f64,
}

/// Line of the file.
#[derive(Debug, Clone)]
pub(super) struct Path {
    pub(super) points: Vec<Point>,
    /// Curve that leads on from each point, if any.
    pub(super) curves: Vec<Option<Round>>,
    pub(super) is_closed: bool,
    /// Places that the file repeats immediately.
    pub(super) doubled: Vec<Point>,
    /// Number of times that the knife follows the line.
    pub(super) times: f64,
}

impl Default for Path {
    fn default() -> Self {
        Self { points: Vec::new(), curves: Vec::new(), is_closed: false, doubled: Vec::new(), times: 1.0 }
    }
}

/// Parameters for reading the numbers of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Greatest distance of chords from their curve, mm.
    pub(super) sagitta: f64,
    /// Depth of notches that state none, mm.
    pub(super) notch: f64,
}

/// Line that may have curves, as it stands in the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Stroke {
    pub(super) layer: u32,
    pub(super) is_closed: bool,
    /// True if one of its edges is an arc: then it has vertices that the file does not contain.
    pub(super) has_arcs: bool,
    /// Vertices, each with the number of the group that it begins with.
    pub(super) vertices: Vec<(Point, u32)>,
}

/// True if an arc leads on from a vertex.
fn bulges(item: &Item) -> bool {
    item.each([42; 3]).any(|(_, bulge)| bulge != 0.0)
}

/// Lines that may have curves, in file order.
pub(super) fn strokes(items: &[Item], unit: f64) -> Vec<Stroke> {
    let mut strokes: Vec<Stroke> = Vec::new();
    let mut is_open = false;
    let place = |[x, y]: [f64; 2]| Point::new(x * unit, y * unit);
    for item in items {
        if item.kind == b"VERTEX" {
            let stroke = strokes.last_mut().filter(|_| is_open && item.flag(16) != Some(true));
            let vertex = item.pair([10, 20]).map(|at| (place(at), item.number));
            if let Some(stroke) = stroke {
                stroke.vertices.extend(vertex);
                stroke.has_arcs |= bulges(item);
            }
            continue;
        }
        is_open = false;
        let Some(layer) = item.layer().filter(|layer| matches!(layer, 1 | 8 | 11 | 14)) else { continue };
        let is_closed = item.flag(1) == Some(true);
        let places = match &item.kind[..] {
            b"POLYLINE" => Vec::new(),
            b"LINE" => [item.places([10, 20]), item.places([11, 21])].concat(),
            b"LWPOLYLINE" => item.places([10, 20]),
            _ => continue,
        };
        is_open = item.kind == b"POLYLINE";
        let vertices = places.into_iter().map(|(at, number)| (place(at), number)).collect();
        strokes.push(Stroke { layer, is_closed, has_arcs: bulges(item), vertices });
    }
    strokes
}

impl Round {
    /// Box around the curve.
    pub(super) fn extent(&self) -> Extent {
        let half = self.sweep.abs() / 2.0;
        if half >= FRAC_PI_2 {
            return Extent::of(&[self.centre]).grown(self.radius);
        }
        let height = self.radius * (1.0 - half.cos());
        Extent::of(&[self.at(0.0), self.at(1.0)]).grown(height)
    }

    /// Place at a fraction of the curve.
    pub(super) fn at(&self, share: f64) -> Point {
        let angle = self.start + share * self.sweep;
        self.centre + Vector::new(angle.cos(), angle.sin()) * self.radius
    }
}

/// Lines of a layer.
pub(super) fn paths(items: &[Item], layer: u32, measure: Measure) -> Vec<Path> {
    let mut paths: Vec<Path> = Vec::new();
    let mut is_vertex = false;
    let place = |item: &Item, codes| item.pair(codes).map(|[x, y]| Point::new(x * measure.unit, y * measure.unit));
    let mut bulges: Vec<f64> = Vec::new();
    for item in items {
        let is_of_layer = item.layer() == Some(layer);
        match &item.kind[..] {
            b"VERTEX" if is_vertex => {
                if let (Some(at), Some(path), false) =
                    (place(item, [10, 20]), paths.last_mut(), item.flag(16) == Some(true))
                {
                    path.points.push(at);
                    bulges.push(item.number(42).unwrap_or(0.0));
                }
                continue;
            }
            _ if is_vertex => {
                paths.last_mut().into_iter().for_each(|path| path.bend(&bulges));
                bulges.clear();
                is_vertex = false;
            }
            _ => {}
        }
        if !is_of_layer {
            continue;
        }
        match &item.kind[..] {
            b"POLYLINE" => {
                is_vertex = true;
                paths.push(Path { is_closed: item.flag(1) == Some(true), ..Path::default() });
            }
            b"LWPOLYLINE" => {
                let (mut path, mut of_path) =
                    (Path { is_closed: item.flag(1) == Some(true), ..Path::default() }, Vec::new());
                let mut x = 0.0;
                for (code, value) in item.each([10, 20, 42]) {
                    match code {
                        10 => x = value,
                        20 => {
                            path.points.push(Point::new(x * measure.unit, value * measure.unit));
                            of_path.push(0.0);
                        }
                        _ => of_path.last_mut().into_iter().for_each(|bulge| *bulge = value),
                    }
                }
                path.bend(&of_path);
                paths.push(path);
            }
            b"LINE" => {
                let points: Vec<Point> = [place(item, [10, 20]), place(item, [11, 21])].into_iter().flatten().collect();
                paths.push(Path { points, curves: vec![None], ..Path::default() });
            }
            b"ARC" | b"CIRCLE" => paths.extend(round_path(item, place(item, [10, 20]), measure)),
            _ => {}
        }
    }
    distinct(paths)
}

/// Lines with a length, without duplicates; a closed line takes precedence over an open one of the same places.
fn distinct(mut paths: Vec<Path>) -> Vec<Path> {
    paths.iter_mut().for_each(Path::tidy);
    let is_dot = |path: &Path| path.curves.iter().flatten().any(|round| round.radius == 0.0);
    paths.retain(|path| !path.curves.is_empty() && !is_dot(path));
    let closed: BTreeSet<_> = paths.iter().filter(|path| path.is_closed).map(Path::key).collect();
    let mut seen = BTreeSet::new();
    paths.retain(|path| (path.is_closed || !closed.contains(&path.key())) && seen.insert(path.key()));
    paths
}

/// Path of an arc or a circle.
pub(super) fn round_path(item: &Item, centre: Option<Point>, measure: Measure) -> Option<Path> {
    let (centre, radius) = (centre?, item.number(40)?.abs() * measure.unit);
    let whole = Round { centre, radius, start: 0.0, sweep: std::f64::consts::TAU };
    let arc = if item.kind == b"CIRCLE" { None } else { Some(item.pair([50, 51])?) };
    let arc = arc.map(|[start, end]| Round {
        start: start.to_radians(),
        sweep: (end - start).rem_euclid(360.0).to_radians(),
        ..whole
    });
    let is_open = |round: &Round| round.sweep > ROUND_EPSILON;
    let is_circle = !arc.as_ref().is_some_and(is_open);
    let round = match arc {
        Some(round) if is_circle => Round { sweep: whole.sweep, ..round },
        Some(round) => round,
        None => whole,
    };
    let points = if is_circle { vec![round.at(0.0)] } else { vec![round.at(0.0), round.at(1.0)] };
    Some(Path { points, curves: vec![Some(round)], is_closed: is_circle, ..Path::default() })
}

impl Path {
    /// Path of a single edge.
    pub(super) fn straight(ends: [Point; 2]) -> Self {
        Self { points: ends.to_vec(), curves: vec![None], ..Self::default() }
    }

    /// Path without spikes, parts that go out and straight back; and the spikes, each to be followed twice.
    pub(super) fn without_spikes(&self) -> (Self, Vec<Self>) {
        let count = self.points.len();
        let at = |k: usize| self.points[k % count];
        let mut is_gone = vec![false; count];
        let mut spikes = Vec::new();
        let inner = if self.is_closed { 0..count } else { 1..count.saturating_sub(1) };
        for tip in inner {
            let most = if self.is_closed { count / 2 } else { tip.min(count - 1 - tip) };
            let reach = (1..=most).take_while(|&j| at(tip + j) == at(tip + count - j)).count();
            if reach == 0 || 2 * reach + 2 >= count {
                continue;
            }
            spikes.push(Self { times: 2.0, ..Self::open((0..=reach).map(|j| at(tip + j)).collect()) });
            (0..2 * reach).for_each(|j| is_gone[(tip + count - reach + 1 + j) % count] = true);
        }
        if spikes.is_empty() || self.curves.iter().any(Option::is_some) {
            return (self.clone(), Vec::new());
        }
        let points: Vec<Point> = (0..count).filter(|&k| !is_gone[k]).map(at).collect();
        let edges = if self.is_closed { points.len() } else { points.len() - 1 };
        (Self { curves: vec![None; edges], points, ..self.clone() }, spikes)
    }

    fn open(points: Vec<Point>) -> Self {
        Self { curves: vec![None; points.len() - 1], points, ..Self::default() }
    }

    /// Length of an edge, mm.
    pub(super) fn length(&self, k: usize) -> f64 {
        let [from, to] = self.edge(k);
        self.curves[k].map_or((to - from).norm(), |round| round.radius * round.sweep.abs())
    }

    /// Ends of an edge.
    pub(super) fn edge(&self, k: usize) -> [Point; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    /// Removes parts without length: adjacent equal places, and the way back of a line that goes out and back.
    fn tidy(&mut self) {
        if self.curves.iter().any(Option::is_some) {
            return;
        }
        self.doubled = self.points.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
        self.points.dedup();
        let is_back = |points: &[Point]| points.len() > 2 && points.first() == points.last();
        if self.is_closed && is_back(&self.points) || self.points.len() == 3 && is_back(&self.points) {
            self.points.pop();
        }
        if !self.is_closed && self.points.len() > 3 && is_back(&self.points) {
            self.points.pop();
            self.is_closed = true;
        }
        self.is_closed &= self.points.len() > 2;
        let edges = if self.is_closed { self.points.len() } else { self.points.len().saturating_sub(1) };
        self.curves = vec![None; edges];
    }

    /// Key that is equal for lines with the same places in either order; paths with curves have directed keys.
    fn key(&self) -> Vec<[u64; 2]> {
        let way: Vec<[u64; 2]> = self.points.iter().map(|point| [point.x.to_bits(), point.y.to_bits()]).collect();
        let curves = self.curves.iter().flatten();
        let curves: Vec<[u64; 2]> = curves.map(|round| [round.radius.to_bits(), round.sweep.to_bits()]).collect();
        let back: Vec<[u64; 2]> = way.iter().rev().copied().collect();
        if curves.is_empty() { way.min(back) } else { [way, curves].concat() }
    }

    /// Computes the curves of bulges from the height of each arc over its chord, half the chord times the bulge.
    fn bend(&mut self, bulges: &[f64]) {
        let count = self.points.len();
        let edges = if self.is_closed { count } else { count.saturating_sub(1) };
        for k in 0..edges {
            let [from, to] = [self.points[k], self.points[(k + 1) % count]];
            let chord = to - from;
            let bulge = bulges.get(k).copied().unwrap_or(0.0);
            let height = bulge * chord.norm() / 2.0;
            // Signed: distance of the centre from the middle of the arc, which lies to the right of the chord for a positive
            // bulge.
            let radius = (chord.norm_squared() / 4.0 + height * height) / (2.0 * height);
            if !radius.is_finite() || radius.abs() > STRAIGHT {
                self.curves.push(None);
                continue;
            }
            let centre = from + chord / 2.0 + left(chord / chord.norm()) * (radius - height);
            let spoke = from - centre;
            let sweep = 4.0 * bulge.atan();
            let round = Round { centre, radius: radius.abs(), start: spoke.y.atan2(spoke.x), sweep };
            self.curves.push(Some(round));
        }
    }
}

/// Groups lines whose ends meet.
pub(super) fn clusters(paths: Vec<Path>) -> Vec<Vec<Path>> {
    let mut owner: Vec<usize> = (0..paths.len()).collect();
    let ends = |k: usize| [paths[k].points[0], paths[k].points[paths[k].points.len() - 1]];
    let all: Vec<(Point, usize)> =
        (0..paths.len()).filter(|&k| !paths[k].is_closed).flat_map(|k| ends(k).map(|at| (at, k))).collect();
    let of_ends = Lookup::of(all.iter().map(|end| end.0), MEETS);
    for &(at, k) in &all {
        for other in of_ends.near(at) {
            let [a, b] = [root(&mut owner, k), root(&mut owner, all[other].1)];
            owner[a] = b;
        }
    }
    let roots: Vec<usize> = (0..paths.len()).map(|k| root(&mut owner, k)).collect();
    let mut clusters: Vec<Vec<Path>> = paths.iter().map(|_| Vec::new()).collect();
    paths.into_iter().zip(roots).for_each(|(path, root)| clusters[root].push(path));
    clusters.retain(|paths| !paths.is_empty());
    clusters
}

/// Representative of a group.
fn root(owner: &mut [usize], mut k: usize) -> usize {
    while owner[k] != k {
        owner[k] = owner[owner[k]];
        k = owner[k];
    }
    k
}
