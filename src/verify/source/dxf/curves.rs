//! Curves of a block, found anew: fine lines (layers 84 to 87) that replace coarse ones, and edges of other lines that may bow
//! because curve points (layer 3) are on them. It lays no curve.

use std::collections::BTreeMap;

use super::again::once;
use super::fold::Fold;
use super::lines::{MEETS, Measure, Path, Stroke, clusters, paths, strokes};
use super::lookup::Lookup;
use super::stretch::{Parted, parted};
use super::tags::{Item, Sheet};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::machine::patterns::Dxf;

/// Distance from a fine line within which a vertex is on it, mm.
pub(super) const ON: f64 = 0.01;
/// Layers of fine lines.
const FINE: [u32; 4] = [84, 85, 86, 87];
/// Height of a round curve over the chords at a vertex, mm. A line with smaller heights has fine chords.
const HIGH: f64 = 0.2;
/// Least such height for a curve to be missed, mm. A system may leave a chord that its curve leaves by less than 0.006 inch, and
/// beside a corner a curve rises half as far.
const MISSED: f64 = 2.0 * 0.1524;

/// Information of a block about curves.
pub(super) struct Curves {
    /// Groups of fine lines whose ends meet, each with its layer.
    fine: Vec<(u32, Vec<Path>)>,
    turns: Spots,
    smooth: Spots,
    notches: Spots,
    may_bow: bool,
}

/// Points that tell the kinds of vertices: at a vertex, and beside it.
struct Spots {
    on: Lookup,
    beside: Lookup,
}

impl Spots {
    fn of(points: &[Point]) -> Self {
        let within = |reach| Lookup::of(points.iter().copied(), reach);
        Self { on: within(ON), beside: within(Dxf::POINT_OFF) }
    }
}

/// A coarse edge that a curve may leave, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bow {
    pub(super) ends: [Point; 2],
}

/// A vertex at which a curve goes on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    pub(super) at: Point,
    /// The ends of its chords on both sides.
    pub(super) ends: [Point; 2],
    /// Turn of the chords, rad, and height of a round curve over them, mm.
    pub(super) turn: f64,
    pub(super) height: f64,
}

impl Bend {
    /// Its image by a motion or a mirror.
    pub(super) fn moved(&self, to: impl Fn(Point) -> Point) -> Self {
        Self { at: to(self.at), ends: self.ends.map(to), ..*self }
    }

    /// Length of its shorter chord, mm.
    pub(super) fn chord(&self) -> f64 {
        self.ends.iter().map(|end| (end - self.at).norm()).fold(f64::INFINITY, f64::min)
    }

    /// Distance of a place from its chords, mm.
    pub(super) fn off(&self, place: Point) -> f64 {
        let off = self.ends.iter().map(|end| polyline::distance_to_segment(place, self.at, *end));
        off.fold(f64::INFINITY, f64::min)
    }
}

/// Edges that may bow, vertices at which a curve must go on, and vertices that it may pass.
#[derive(Debug, Default)]
pub(super) struct Bows {
    pub(super) edges: Vec<Bow>,
    pub(super) bends: Vec<Bend>,
    pub(super) passed: Vec<Point>,
}

/// Replacement of coarse lines that belong together.
pub(super) enum Course {
    /// The coarse lines are cut themselves; some edges may bow.
    Own(Bows),
    /// Fine lines are cut in the place of some edges. Other edges may bow.
    Part { lines: Vec<Path>, chords: Vec<[Point; 2]>, bows: Bows },
    /// Fine lines are cut in their place, and the spikes of the coarse ones.
    Fine(Vec<Path>),
}

/// Points of a layer, in mm.
pub(super) fn points(items: &[Item], is_wanted: impl Fn(u32) -> bool, unit: f64) -> Vec<Point> {
    let wanted = items.iter().filter(|item| item.kind == b"POINT" && item.layer().is_some_and(&is_wanted));
    wanted.filter_map(|item| item.pair([10, 20])).map(|[x, y]| Point::new(x * unit, y * unit)).collect()
}

impl Curves {
    /// Curves of a block, with curve points and turn points that another size of its piece lends it.
    pub(super) fn of(sheet: &Sheet, lent: &[Vec<Point>; 2], measure: Measure) -> Self {
        let of_layer = |layer: u32, more: &[Point]| {
            let mut all = points(&sheet.items, |of| of == layer, measure.unit);
            all.extend_from_slice(more);
            all
        };
        let [turns, curves] = [of_layer(2, &lent[0]), of_layer(3, &lent[1])];
        let notches = points(&sheet.items, |of| matches!(of, 4 | 80..=83), measure.unit);
        let fine = FINE.into_iter().flat_map(|layer| {
            let all = clusters(paths(&sheet.items, layer, measure));
            all.into_iter().map(move |paths| (layer, once(paths)))
        });
        let [of_turns, of_curves, of_notches] = [&turns, &curves, &notches].map(|points| Spots::of(points));
        Self {
            fine: fine.collect(),
            may_bow: !curves.is_empty(),
            turns: of_turns,
            smooth: of_curves,
            notches: of_notches,
        }
    }

    /// Chooses the lines that are cut for a group of coarse lines; `usual` is the most likely layer of their fine lines.
    pub(super) fn course(&self, coarse: &[Path], usual: u32, fold: Option<Fold>) -> Course {
        let (bare, spikes): (Vec<Path>, Vec<Path>) = {
            let (mut bare, mut spikes) = (Vec::new(), Vec::new());
            for (path, is_twig) in coarse.iter().zip(twigs(coarse)) {
                if is_twig {
                    spikes.push(Path { times: 2.0, ..path.clone() });
                } else {
                    let (rest, taken) = path.without_spikes();
                    bare.push(rest);
                    spikes.extend(taken);
                }
            }
            (bare, spikes)
        };
        let is_on_fold = |at: Point| fold.is_some_and(|fold| fold.off(at).abs() <= MEETS);
        let places: Vec<Point> = bare.iter().flat_map(|path| path.points.iter().copied()).collect();
        let open: Vec<Point> = free_ends(&bare).into_iter().map(|end| end.1).filter(|at| !is_on_fold(*at)).collect();
        let order = self.fine.iter().filter(|(layer, _)| *layer == usual);
        for (_, fine) in order.chain(self.fine.iter().filter(|(layer, _)| *layer != usual)) {
            let whole = closed(fine, &bare);
            let count = held(&whole, &places);
            let is_finer =
                corners(&whole) > corners(&bare) || whole.iter().any(|path| path.curves.iter().any(Option::is_some));
            let ends = free_ends(fine);
            let has_ends = open.iter().all(|at| ends.iter().any(|(_, end)| (end - at).norm() <= ON));
            if count == places.len() && is_finer && has_ends {
                return Course::Fine([whole, spikes].concat());
            }
        }
        let own = self.fine.iter().filter(|(layer, _)| *layer == usual).map(|(_, fine)| fine);
        if let Some(Parted { fine, rest, chords }) = parted(own.clone(), &bare, fold) {
            let (bows, _) = self.bows(&rest, fold);
            return Course::Part { lines: [fine, rest, spikes].concat(), chords, bows };
        }
        // A control polygon shares a few vertices with a line that is fine itself: most of its curve points bend little.
        let own = Lookup::of(own.flatten().flat_map(|path| path.points.iter().copied()), ON);
        let count = places.iter().filter(|at| own.has(**at)).count();
        let may_be_polygon = count > 0 && 2 * count <= places.len();
        let (bows, [smooth, high]) = self.bows(&bare, fold);
        Course::Own(if may_be_polygon && 2 * high <= smooth { Bows::default() } else { bows })
    }

    /// Edges of lines that may bow, and the counts of all curve points between chords and of those at which curves are high.
    fn bows(&self, paths: &[Path], fold: Option<Fold>) -> (Bows, [usize; 2]) {
        let (mut bows, mut counts) = (Bows::default(), [0; 2]);
        for path in paths.iter().filter(|_| self.may_bow) {
            let of_path = self.see(path, fold, &mut bows);
            counts = [counts[0] + of_path[0], counts[1] + of_path[1]];
            bows.passed.extend(path.points.iter().filter(|at| self.is_smooth(**at) && self.is_notched(**at)));
        }
        (bows, counts)
    }

    /// True if a curve may go on at a vertex.
    fn goes_on(&self, at: Point) -> bool {
        let is_turn = self.turns.on.has(at) || !self.smooth.on.has(at) && self.turns.beside.has(at);
        self.is_smooth(at) || self.is_notched(at) && !is_turn
    }

    /// True if a curve point marks a vertex: one beside the vertex does if no turn point is at it.
    fn is_smooth(&self, at: Point) -> bool {
        self.smooth.on.has(at) || !self.turns.on.has(at) && self.smooth.beside.has(at)
    }

    fn is_notched(&self, at: Point) -> bool {
        self.notches.beside.has(at)
    }

    /// Adds the edges that may bow, and the curve points whose chords a curve leaves by at least [`MISSED`]. Returns the counts
    /// of all curve points between chords and of those with at least [`HIGH`].
    fn see(&self, path: &Path, fold: Option<Fold>, bows: &mut Bows) -> [usize; 2] {
        let [mut smooth, mut high] = [0; 2];
        let count = path.points.len();
        for k in 0..path.curves.len() {
            let ends = path.edge(k);
            if path.curves[k].is_none() && ends.iter().any(|&end| self.goes_on(end)) {
                bows.edges.push(Bow { ends });
            }
            if !path.is_closed && (k == 0 || k + 1 == count) {
                continue;
            }
            let [before, at, behind] = [path.points[(k + count - 1) % count], ends[0], ends[1]];
            let [before, behind] = fold.map_or([before, behind], |fold| fold.neighbours(at, [before, behind]));
            let turn = polyline::turn_at(before, at, behind).abs();
            let is_smooth = self.is_smooth(at) && !self.is_notched(at) && !path.doubled.contains(&at);
            // A round curve that turns by this angle from chord to chord rises an eighth of it over each chord, relative to the
            // chord's length.
            let height = turn * (at - before).norm().min((behind - at).norm()) / 8.0;
            smooth += usize::from(is_smooth);
            high += usize::from(is_smooth && height >= HIGH);
            if is_smooth && height >= MISSED {
                bows.bends.push(Bend { at, ends: [before, behind], turn, height });
            }
        }
        [smooth, high]
    }
}

/// Number of vertices of a group of lines; a vertex where two lines meet counts once.
fn corners(paths: &[Path]) -> usize {
    let ends = 2 * paths.iter().filter(|path| !path.is_closed).count();
    let joints = (ends - free_ends(paths).len()) / 2;
    paths.iter().map(|path| path.points.len()).sum::<usize>() - joints
}

/// Number of places that lie on lines.
fn held(paths: &[Path], places: &[Point]) -> usize {
    let edges: Vec<[Point; 2]> = paths.iter().flat_map(|path| (0..path.curves.len()).map(|k| path.edge(k))).collect();
    let boxes = Boxes::new(edges.iter().map(|[a, b]| Extent::between(*a, *b).grown(ON)).collect());
    let is_on = |at: Point| boxes.at(at).any(|k| polyline::distance_to_segment(at, edges[k][0], edges[k][1]) <= ON);
    places.iter().filter(|at| is_on(**at)).count()
}

/// The two ends of each open line, in order.
fn open_ends(paths: &[Path]) -> Vec<(usize, Point)> {
    let open = paths.iter().enumerate().filter(|(_, path)| !path.is_closed);
    open.flat_map(|(k, path)| [path.points.first(), path.points.last()].into_iter().flatten().map(move |at| (k, *at)))
        .collect()
}

/// The ends of open lines that meet no other end.
fn free_ends(paths: &[Path]) -> Vec<(usize, Point)> {
    let ends = open_ends(paths);
    let lookup = Lookup::of(ends.iter().map(|end| end.1), MEETS);
    ends.iter().filter(|(_, at)| lookup.near(*at).nth(1).is_none()).copied().collect()
}

/// Lines that stand off the others of their group: those that disappear when lines with a free end are removed repeatedly. None
/// if no ring remains.
pub(super) fn twigs(paths: &[Path]) -> Vec<bool> {
    let ends = open_ends(paths);
    let lookup = Lookup::of(ends.iter().map(|end| end.1), MEETS);
    let mut is_twig = vec![false; paths.len()];
    // Ends that rely on each end: once its line is gone they are free, unless they find another.
    let mut dependents: Vec<Vec<usize>> = vec![Vec::new(); ends.len()];
    let mut queue: Vec<usize> = (0..ends.len()).collect();
    while let Some(end) = queue.pop() {
        let (path, at) = ends[end];
        if is_twig[path] {
            continue;
        }
        let holder = lookup.near(at).find(|&other| other != end && !is_twig[ends[other].0]);
        if let Some(other) = holder {
            dependents[other].push(end);
            continue;
        }
        is_twig[path] = true;
        for own in [end & !1, end | 1] {
            queue.append(&mut dependents[own]);
        }
    }
    if is_twig.iter().all(|&is_twig| is_twig) { vec![false; paths.len()] } else { is_twig }
}

/// Groups of lines that stand on edges of others: open ones with exactly one free end on an edge, or with none there but all
/// their meetings at one place on an edge. Where all are open the longest one is half of an outline, which ends at a fold.
pub(super) fn standing(clusters: &[Vec<Path>]) -> Vec<bool> {
    let is_open = |paths: &Vec<Path>| twigs(paths).iter().all(|is_twig| !is_twig) && !free_ends(paths).is_empty();
    let length = |k: &usize| -> f64 {
        clusters[*k].iter().flat_map(|path| (0..path.curves.len()).map(|edge| path.length(edge))).sum()
    };
    let longest = (0..clusters.len()).max_by(|a, b| length(a).total_cmp(&length(b)));
    let half = longest.filter(|_| clusters.iter().all(is_open));
    let edges: Vec<[Point; 2]> = (0..clusters.len())
        .filter(|&k| half == Some(k) || !is_open(&clusters[k]))
        .flat_map(|k| &clusters[k])
        .flat_map(|path| (0..path.curves.len()).map(|k| path.edge(k)).collect::<Vec<_>>())
        .collect();
    let boxes = Boxes::new(edges.iter().map(|[a, b]| Extent::between(*a, *b).grown(MEETS)).collect());
    let is_on = |at: Point| boxes.at(at).any(|k| polyline::distance_to_segment(at, edges[k][0], edges[k][1]) <= MEETS);
    let meets_there = |paths: &[Path]| {
        let places: Vec<Point> = open_ends(paths).into_iter().map(|end| end.1).filter(|at| is_on(*at)).collect();
        half.is_none() && !places.is_empty() && places.iter().all(|at| (at - places[0]).norm() <= MEETS)
    };
    let stands = |paths: &Vec<Path>| {
        let free = || free_ends(paths).into_iter().filter(|end| is_on(end.1)).count();
        is_open(paths) && (free() == 1 || free() == 0 && meets_there(paths))
    };
    clusters.iter().enumerate().map(|(k, paths)| half != Some(k) && stands(paths)).collect()
}

/// Fine lines, with the chord that closes them if the coarse ones are closed.
fn closed(fine: &[Path], coarse: &[Path]) -> Vec<Path> {
    let mut all = fine.to_vec();
    if let ([(_, a), (_, b)], []) = (&free_ends(fine)[..], &free_ends(coarse)[..]) {
        all.push(Path::straight([*a, *b]));
    }
    all
}

/// Turn points and curve points for each block that has none: at the places that they have among the vertices of another size
/// of its piece, preferably the sample size.
pub(super) fn lent(blocks: &[Sheet], sample: Option<&[u8]>, unit: f64) -> Vec<[Vec<Point>; 2]> {
    let dots = |block: &Sheet, layer: u32| points(&block.items, |of| of == layer, unit);
    let has_dots =
        |block: &Sheet| block.items.iter().any(|item| item.kind == b"POINT" && matches!(item.layer(), Some(2 | 3)));
    let is_sample = |block: &Sheet| {
        let [size, sample] = [block.says("SIZE"), sample].map(|text| text.map(<[u8]>::to_ascii_uppercase));
        size.is_some() && size == sample
    };
    let mut lenders: BTreeMap<Vec<u8>, &Sheet> = BTreeMap::new();
    for block in blocks.iter().filter(|block| has_dots(block)) {
        let Some(name) = block.says("PIECE NAME") else { continue };
        let known = lenders.entry(name.to_vec()).or_insert(block);
        if is_sample(block) && !is_sample(known) {
            *known = block;
        }
    }
    let of_block = |block: &Sheet| {
        let lender = block.says("PIECE NAME").and_then(|name| lenders.get(name)).filter(|_| !has_dots(block))?;
        let [own, its] = [&block.items, &lender.items].map(|items| strokes(items, unit));
        let shape = |stroke: &Stroke| (stroke.layer, stroke.is_closed, stroke.vertices.len());
        let has_arcs = own.iter().chain(&its).any(|stroke| stroke.has_arcs);
        let is_alike = !has_arcs && own.iter().map(shape).eq(its.iter().map(shape));
        let vertices =
            |strokes: &[Stroke]| strokes.iter().flat_map(|stroke| stroke.vertices.clone()).collect::<Vec<_>>();
        let (own, its) = (vertices(&own), vertices(&its));
        let on = |layer: u32| -> Vec<Point> {
            let dots = Lookup::of(dots(lender, layer).into_iter(), Dxf::POINT_OFF);
            own.iter().zip(&its).filter(|(_, its)| dots.has(its.0)).map(|(own, _)| own.0).collect()
        };
        is_alike.then(|| [on(2), on(3)])
    };
    blocks.iter().map(|block| of_block(block).unwrap_or_default()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twigs by their definition, found round by round: reference for the test.
    fn by_rounds(paths: &[Path]) -> Vec<bool> {
        let mut left: Vec<usize> = (0..paths.len()).collect();
        loop {
            let rest: Vec<Path> = left.iter().map(|&k| paths[k].clone()).collect();
            let free: Vec<usize> = free_ends(&rest).into_iter().map(|end| left[end.0]).collect();
            if free.is_empty() {
                break;
            }
            left.retain(|k| !free.contains(k));
        }
        (0..paths.len()).map(|k| !left.is_empty() && !left.contains(&k)).collect()
    }

    #[test]
    fn lines_are_twigs_that_peeling_round_by_round_takes_away() {
        let mut random = fastrand::Rng::with_seed(3);
        let mut counts = [0; 2];
        for _ in 0..400 {
            let mut place = || Point::new(f64::from(random.u8(0..4)), f64::from(random.u8(0..4)));
            let mut paths: Vec<Path> = (0..12).map(|_| Path::straight([place(), place()])).collect();
            paths[0].is_closed = random.bool();
            let found = twigs(&paths);
            assert_eq!(found, by_rounds(&paths), "{paths:?}");
            for is_twig in found {
                counts[usize::from(is_twig)] += 1;
            }
        }
        assert!(counts.iter().all(|&count| count > 400), "{counts:?}");
    }

    #[test]
    fn a_ring_with_a_tail_of_a_hundred_thousand_lines_has_that_many_twigs() {
        let at = |k: u32| Point::new(f64::from(k), 0.0);
        let ring = [at(0), Point::new(0.0, 9.0), Point::new(9.0, 9.0), at(0)];
        let mut paths: Vec<Path> = ring.windows(2).map(|ends| Path::straight([ends[0], ends[1]])).collect();
        paths.extend((0..100_000).map(|k| Path::straight([at(k), at(k + 1)])));
        assert_eq!(twigs(&paths).iter().filter(|&&is_twig| is_twig).count(), 100_000);
    }
}
