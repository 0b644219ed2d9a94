//! What a block cuts, found anew: the places of its lines, holes and notches on both halves, without joining anything.

use super::lookup::Lookup;
use super::tags::{Item, Sheet};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use crate::geom::{Extent, Point, Vector, cross, left};
use crate::machine::patterns::Dxf;

/// How near to a fold line a place is on it, and how far lines that are one may miss each other, mm.
pub(super) const MEETS: f64 = Dxf::ENDS_MEET;
/// Radius beyond which a curve is straight, mm: on a circle so large the rounding of its centre moves every place.
const STRAIGHT: f64 = 1e9;
/// Angle below which an arc comes round, rad.
const ROUND_EPSILON: f64 = 1e-8;

/// What is cut, mm.
#[derive(Debug, Clone, Default)]
pub(super) struct Cuts {
    /// Places that the knife comes to.
    pub(super) places: Vec<Place>,
    /// Places that it may come to in their stead: ends of lines on a fold, where ends that meet are one.
    pub(super) spare: Vec<Point>,
    /// Circles along which it may come to more.
    pub(super) rounds: Vec<Round>,
    /// Way of the knife, and what chords of curves and gaps may change of it.
    pub(super) length: f64,
    pub(super) slack: f64,
    pub(super) holes: Vec<Point>,
    pub(super) marks: Vec<Mark>,
    /// How much on layers that are cut cannot be understood: numbers that are damaged, planes beside the cloth.
    pub(super) faults: usize,
}

/// A place that the knife comes to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) at: Point,
    /// Whether a line ends here that may be joined to another.
    pub(super) is_end: bool,
}

/// A circle that a curve is of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// Where the curve starts and how far it goes, rad.
    pub(super) start: f64,
    pub(super) sweep: f64,
}

/// A point that asks for a notch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark {
    pub(super) at: Point,
    pub(super) depth: f64,
    pub(super) width: f64,
    /// Number of its group in the file.
    pub(super) block: u32,
}

/// A line of the file.
#[derive(Debug, Default)]
struct Path {
    points: Vec<Point>,
    /// Behind each point the curve that leads on from it, if any.
    curves: Vec<Option<Round>>,
    is_closed: bool,
}

/// How the numbers of a file are read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Farthest that chords lie off their curve, mm.
    pub(super) sagitta: f64,
    /// Depth of notches without one, mm.
    pub(super) notch: f64,
}

/// A fold line as it is drawn, and about what a half is mirrored.
#[derive(Debug, Clone, Copy)]
struct Fold {
    drawn: Axis,
    length: f64,
    about: Axis,
}

/// A place on a straight line, and its direction.
#[derive(Debug, Clone, Copy)]
struct Axis {
    from: Point,
    along: Vector,
}

impl Axis {
    fn between(from: Point, to: Point) -> Self {
        Self { from, along: (to - from) / (to - from).norm() }
    }

    fn off(&self, at: Point) -> f64 {
        cross(self.along, at - self.from)
    }

    fn station(&self, at: Point) -> f64 {
        (at - self.from).dot(&self.along)
    }
}

impl Fold {
    /// Whether a line between two places lies on the fold: it is in line with it, and goes some way along it.
    fn has(&self, ends: [Point; 2]) -> bool {
        let [a, b] = ends.map(|end| self.drawn.station(end));
        let both = a.max(b).min(self.length) - a.min(b).max(0.0);
        ends.iter().all(|end| self.drawn.off(*end).abs() <= MEETS) && both >= (a - b).abs().min(MEETS)
    }

    /// Whether an edge lies on it; a curve does so with its middle, too.
    fn has_edge(&self, ends: [Point; 2], curve: Option<Round>) -> bool {
        let middle = curve.map_or(ends[0], |round| round.at(0.5));
        self.has(ends) && self.drawn.off(middle).abs() <= MEETS
    }

    fn off(&self, at: Point) -> f64 {
        self.about.off(at)
    }

    fn across(&self, at: Point) -> Point {
        at - left(self.about.along) * (2.0 * self.off(at))
    }

    /// Whether lines lie on one side, and not all of them on the fold itself: then they are half of something.
    fn halves(&self, paths: &[Path]) -> bool {
        let middles = |path: &Path| path.curves.iter().flatten().map(|round| round.at(0.5)).collect::<Vec<_>>();
        let places = || paths.iter().flat_map(|path| path.points.iter().copied().chain(middles(path)));
        let offs = || places().map(|at| self.drawn.off(at));
        offs().any(|off| off > MEETS) != offs().any(|off| off < -MEETS)
    }

    /// The fold of a half: where an edge of its outline is as long on the line as that is, the cloth is folded along the longest.
    fn of_half(self, outlines: &[Path]) -> Self {
        let edges = outlines.iter().flat_map(|path| (0..path.curves.len()).map(|k| (path.edge(k), path.curves[k])));
        let mut longest = self.length - 2.0 * MEETS;
        let mut fold = self;
        for (ends, _) in edges.filter(|(ends, curve)| self.has_edge(*ends, *curve)) {
            let length = (ends[1] - ends[0]).norm();
            if length > longest || (length >= longest && fold.about.from == self.about.from) {
                (longest, fold.about) = (length, Axis::between(ends[0], ends[1]));
            }
        }
        fold
    }
}

impl Cuts {
    /// What a block cuts.
    pub(super) fn of(sheet: &Sheet, measure: Measure) -> Self {
        let paths = |layer: u32| paths(&sheet.items, layer, measure);
        let outlines = paths(1);
        let is_odd = |item: &&Item| item.is_of_cuts() && (!item.is_plain() || item.flag(1).is_none());
        let mut cuts = Self { faults: sheet.items.iter().filter(is_odd).count(), ..Self::default() };
        if outlines.is_empty() {
            return cuts;
        }
        let fold = paths(6).iter().find_map(|path| {
            let (first, last) = (path.points.first()?, path.points.last()?);
            let way = last - first;
            let drawn = Axis::between(*first, *last);
            (way.norm() > MEETS).then(|| Fold { drawn, length: way.norm(), about: drawn })
        });
        let fold = fold.filter(|fold| fold.halves(&outlines)).map(|fold| fold.of_half(&outlines));
        cuts.add(&outlines, fold, measure.sagitta);
        for paths in clusters(paths(11)) {
            cuts.add(&paths, fold.filter(|fold| fold.halves(&paths)), measure.sagitta);
        }
        let mut holes: Vec<[Option<Point>; 2]> = Vec::new();
        for item in &sheet.items {
            let Some(at) = item.pair([10, 20]).map(|[x, y]| Point::new(x * measure.unit, y * measure.unit)) else {
                continue;
            };
            let also = fold.filter(|fold| fold.off(at).abs() > MEETS).map(|fold| fold.across(at));
            match (&item.kind[..], item.layer()) {
                (b"POINT" | b"CIRCLE", Some(13)) => holes.push([Some(at), also]),
                (b"POINT", Some(layer @ (4 | 80..=83))) => {
                    let size = |code| item.number(code).unwrap_or(0.0).abs() * measure.unit;
                    let depth = if size(30) > 0.0 { size(30) } else { measure.notch };
                    let width = if size(39) > 0.0 || layer == 4 { size(39) } else { depth };
                    let mark = Mark { at, depth, width, block: item.number };
                    cuts.marks.push(mark);
                    cuts.marks.extend(also.map(|at| Mark { at, ..mark }));
                }
                (b"ARC", Some(13)) if round_path(item, Some(at), measure).is_some_and(|path| path.is_closed) => {
                    holes.push([Some(at), also]);
                }
                _ => {}
            }
        }
        cuts.drill(&holes);
        cuts
    }

    /// Adds holes with their mirror images, but for those where one is already.
    fn drill(&mut self, asked: &[[Option<Point>; 2]]) {
        let all: Vec<(usize, Point)> =
            asked.iter().enumerate().flat_map(|(k, both)| both.iter().flatten().map(move |at| (k, *at))).collect();
        let lookup = Lookup::of(all.iter().map(|hole| hole.1), MEETS);
        let mut is_made = vec![false; asked.len()];
        for (k, both) in asked.iter().enumerate() {
            let Some(at) = both[0] else { continue };
            let is_there = lookup.near(at).any(|i| all[i].0 < k && is_made[all[i].0]);
            is_made[k] = !is_there;
            self.holes.extend(both.iter().flatten().filter(|_| !is_there));
        }
    }

    /// Adds lines that belong together, on both sides of a fold, without what lies on it.
    fn add(&mut self, paths: &[Path], fold: Option<Fold>, sagitta: f64) {
        let times = if fold.is_some() { 2.0 } else { 1.0 };
        for path in paths {
            let count = path.points.len();
            let mut is_met = vec![count == 1; count];
            for (k, curve) in path.curves.iter().enumerate() {
                let (ends, next) = (path.edge(k), (k + 1) % count);
                if fold.is_some_and(|fold| count > 1 && fold.has_edge(ends, *curve)) {
                    continue;
                }
                (is_met[k], is_met[next]) = (true, true);
                let mut way = (ends[1] - ends[0]).norm();
                if let Some(round) = curve {
                    way = round.radius * round.sweep.abs();
                    // An arc over an angle is longer than its chords by a third of that times their sagitta.
                    self.slack += times * sagitta * round.sweep.abs();
                    self.rounds.push(*round);
                    self.rounds.extend(fold.map(|fold| round.across(fold)));
                }
                self.length += times * way;
            }
            for (k, &at) in path.points.iter().enumerate() {
                let is_end = !path.is_closed && (k == 0 || k + 1 == count);
                if !is_met[k] {
                    self.spare.extend(is_end.then_some(at));
                    continue;
                }
                self.places.push(Place { at, is_end });
                let Some(fold) = fold else { continue };
                if fold.off(at).abs() > MEETS {
                    self.places.push(Place { at: fold.across(at), is_end });
                } else {
                    // Beside the fold a line goes over to its other half, which may take twice the distance more or less.
                    self.slack += 2.0 * fold.off(at).abs();
                }
            }
        }
    }
}

impl Round {
    /// A box around its curve.
    pub(super) fn extent(&self) -> Extent {
        let half = self.sweep.abs() / 2.0;
        if half >= FRAC_PI_2 {
            return Extent::of(&[self.centre]).grown(self.radius);
        }
        let height = self.radius * (1.0 - half.cos());
        Extent::of(&[self.at(0.0), self.at(1.0)]).grown(height)
    }

    fn across(&self, fold: Fold) -> Self {
        let start = fold.across(self.at(0.0)) - fold.across(self.centre);
        Self { centre: fold.across(self.centre), start: start.y.atan2(start.x), sweep: -self.sweep, ..*self }
    }

    /// Its place after so much of it.
    pub(super) fn at(&self, share: f64) -> Point {
        let angle = self.start + share * self.sweep;
        self.centre + Vector::new(angle.cos(), angle.sin()) * self.radius
    }
}

/// The lines of a layer.
fn paths(items: &[Item], layer: u32, measure: Measure) -> Vec<Path> {
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
                paths.push(Path { points, curves: vec![None], is_closed: false });
            }
            b"ARC" | b"CIRCLE" => paths.extend(round_path(item, place(item, [10, 20]), measure)),
            _ => {}
        }
    }
    distinct(paths)
}

/// Lines that have a length, each once; of an open and a closed one of the same places the closed one.
fn distinct(mut paths: Vec<Path>) -> Vec<Path> {
    paths.iter_mut().for_each(Path::tidy);
    let is_dot = |path: &Path| path.curves.iter().flatten().any(|round| round.radius == 0.0);
    paths.retain(|path| !path.curves.is_empty() && !is_dot(path));
    let closed: BTreeSet<_> = paths.iter().filter(|path| path.is_closed).map(Path::key).collect();
    let mut seen = BTreeSet::new();
    paths.retain(|path| (path.is_closed || !closed.contains(&path.key())) && seen.insert(path.key()));
    paths
}

/// An arc or a circle.
fn round_path(item: &Item, centre: Option<Point>, measure: Measure) -> Option<Path> {
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
    Some(Path { points, curves: vec![Some(round)], is_closed: is_circle })
}

impl Path {
    /// The ends of an edge.
    fn edge(&self, k: usize) -> [Point; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    /// Drops what has no length: equal places beside each other, and the way back of a line that goes out and back.
    fn tidy(&mut self) {
        if self.curves.iter().any(Option::is_some) {
            return;
        }
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

    /// The same for lines with the same places in either order; what curves is its own.
    fn key(&self) -> Vec<[u64; 2]> {
        let way: Vec<[u64; 2]> = self.points.iter().map(|point| [point.x.to_bits(), point.y.to_bits()]).collect();
        let curves = self.curves.iter().flatten();
        let curves: Vec<[u64; 2]> = curves.map(|round| [round.radius.to_bits(), round.sweep.to_bits()]).collect();
        let back: Vec<[u64; 2]> = way.iter().rev().copied().collect();
        if curves.is_empty() { way.min(back) } else { [way, curves].concat() }
    }

    /// Finds the curves of bulges: by the height of the arc over its chord, which is half the chord times the bulge.
    fn bend(&mut self, bulges: &[f64]) {
        let count = self.points.len();
        let edges = if self.is_closed { count } else { count.saturating_sub(1) };
        for k in 0..edges {
            let [from, to] = [self.points[k], self.points[(k + 1) % count]];
            let chord = to - from;
            let bulge = bulges.get(k).copied().unwrap_or(0.0);
            let height = bulge * chord.norm() / 2.0;
            // Signed: the centre is as far from the middle of the arc, which lies right of the chord for a bulge above 0.
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

/// Lines whose ends meet belong together.
fn clusters(paths: Vec<Path>) -> Vec<Vec<Path>> {
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

/// The one that stands for all that belong together.
fn root(owner: &mut [usize], mut k: usize) -> usize {
    while owner[k] != k {
        owner[k] = owner[owner[k]];
        k = owner[k];
    }
    k
}
