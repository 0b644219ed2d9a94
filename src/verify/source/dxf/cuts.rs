//! Cuts of a block, found anew: the places of its lines, holes and notches on both halves, without joining anything.

use super::again::once;
use super::curves::{Bend, Bow, Bows, Course, Curves, standing, twigs};
use super::fold::Fold;
use super::lines::{MEETS, Measure, Path, Round, clusters, paths, round_path, strokes};
use super::lookup::Lookup;
use super::tags::{Item, Sheet};
use std::f64::consts::FRAC_PI_2;

use crate::geom::Point;

/// Usual layer of the curves of outlines.
const FINE_OUTLINE: u32 = 84;

/// Cuts, lengths in mm.
#[derive(Debug, Clone, Default)]
pub(super) struct Cuts {
    /// Places that the knife comes to.
    pub(super) places: Vec<Place>,
    /// Alternatives to them: ends of lines on a fold, where ends that meet are one.
    pub(super) spare: Vec<Point>,
    /// Circles along which there may be more places.
    pub(super) rounds: Vec<Round>,
    /// Length of the cuts, and its uncertainty by chords of curves and gaps.
    pub(super) length: f64,
    pub(super) slack: f64,
    pub(super) holes: Vec<Point>,
    pub(super) marks: Vec<Mark>,
    /// Edges that a curve may leave, and vertices at which it goes on.
    pub(super) bows: Vec<Bow>,
    pub(super) bends: Vec<Bend>,
    /// Coarse edges that curves replace: notches beside them are on the curves.
    pub(super) chords: Vec<[Point; 2]>,
    /// Vertices of outlines with the number of the group of the file that they begin with.
    pub(super) corners: Vec<(Point, u32)>,
    /// Number of unreadable items on layers that are cut: damaged numbers, planes other than that of the cloth.
    pub(super) faults: usize,
}

/// A place that the knife comes to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) at: Point,
    /// True if a line ends here that may be joined to another.
    pub(super) is_end: bool,
    /// True if a curve may pass it within a hundredth of a millimetre.
    pub(super) is_passed: bool,
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

impl Cuts {
    /// Cuts of a block.
    pub(super) fn of(sheet: &Sheet, lent: Option<&[Vec<Point>; 2]>, measure: Measure) -> Self {
        let paths = |layer: u32| paths(&sheet.items, layer, measure);
        let outlines = paths(1);
        let is_odd = |item: &&Item| item.is_of_cuts() && (!item.is_plain() || item.flag(1).is_none());
        let mut cuts = Self { faults: sheet.items.iter().filter(is_odd).count(), ..Self::default() };
        if outlines.is_empty() {
            return cuts;
        }
        let fold = paths(6).iter().find_map(Fold::of);
        let fold = fold.filter(|fold| fold.halves(&outlines)).map(|fold| fold.of_half(&outlines));
        let curves = lent.map(|lent| Curves::of(sheet, lent, measure));
        for (layer, usual) in [(1, FINE_OUTLINE), (11, 86)] {
            let clusters: Vec<Vec<Path>> = clusters(paths(layer)).into_iter().map(once).collect();
            let are_spurs = if layer == 1 { standing(&clusters) } else { vec![false; clusters.len()] };
            for (mut paths, is_spur) in clusters.into_iter().zip(are_spurs) {
                if is_spur {
                    for path in &mut paths {
                        path.times = 2.0;
                    }
                }
                let fold = if layer == 1 { fold } else { fold.filter(|fold| fold.halves(&paths)) };
                cuts.add_curved(paths, usual, curves.as_ref(), Halving { fold, sagitta: measure.sagitta });
            }
        }
        let outlines = strokes(&sheet.items, measure.unit).into_iter().filter(|stroke| stroke.layer == 1);
        cuts.corners = outlines.flat_map(|stroke| stroke.vertices).collect();
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

    /// Adds holes with their mirror images, except where there already is one.
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

    /// Adds lines that belong together with their curves, if curves are asked for.
    fn add_curved(&mut self, mut paths: Vec<Path>, usual: u32, curves: Option<&Curves>, halving: Halving) {
        let both_ends = |ends: [Point; 2]| halving.both_ends(ends);
        let edges = |paths: &[Path]| -> Vec<[Point; 2]> {
            paths.iter().flat_map(|path| (0..path.curves.len()).map(|k| path.edge(k)).collect::<Vec<_>>()).collect()
        };
        match curves.map(|curves| curves.course(&paths, usual, halving.fold)) {
            Some(Course::Fine(fine)) => {
                self.chords.extend(edges(&paths).into_iter().flat_map(both_ends));
                self.add(&fine, &[], halving);
            }
            Some(Course::Part { lines, chords, bows }) => {
                self.chords.extend(chords.into_iter().flat_map(both_ends));
                self.add_bows(&bows, halving);
                self.add(&lines, &bows.passed, halving);
            }
            Some(Course::Own(bows)) => {
                self.add_bows(&bows, halving);
                double(&mut paths, usual);
                self.add(&paths, &bows.passed, halving);
            }
            None => {
                double(&mut paths, usual);
                self.add(&paths, &[], halving);
            }
        }
    }

    /// Adds edges that may bow, on both sides of a fold.
    fn add_bows(&mut self, bows: &Bows, halving: Halving) {
        for [a, b] in bows.edges.iter().map(|bow| bow.ends) {
            // A curve over a chord is at most as long as half a circle.
            self.slack += halving.times() * (FRAC_PI_2 - 1.0) * (b - a).norm();
            self.bows.extend(halving.both_ends([a, b]).map(|ends| Bow { ends }));
            self.chords.extend(halving.both_ends([a, b]));
        }
        self.bends.extend_from_slice(&bows.bends);
        let across = |fold: Fold| bows.bends.iter().map(move |bend| bend.moved(|at| fold.across(at)));
        self.bends.extend(halving.fold.into_iter().flat_map(across));
    }

    /// Adds lines that belong together, on both sides of a fold, without edges on the fold itself. A curve may pass some of
    /// their vertices.
    fn add(&mut self, paths: &[Path], passed: &[Point], Halving { fold, sagitta }: Halving) {
        for path in paths {
            let times = path.times * if fold.is_some() { 2.0 } else { 1.0 };
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
                    // An arc is longer than its chords by a third of its angle times their sagitta.
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
                let is_passed = passed.contains(&at);
                self.places.push(Place { at, is_end, is_passed });
                let Some(fold) = fold else { continue };
                if fold.off(at).abs() > MEETS {
                    self.places.push(Place { at: fold.across(at), is_end, is_passed });
                } else {
                    // A line that ends beside the fold goes over to its other half: up to twice the distance more or less.
                    self.slack += 2.0 * fold.off(at).abs();
                }
            }
        }
    }
}

/// Number of sides of the lines, and greatest distance of chords from their curves, mm.
#[derive(Debug, Clone, Copy)]
struct Halving {
    fold: Option<Fold>,
    sagitta: f64,
}

impl Halving {
    /// A point, and its mirror image.
    fn both(self, at: Point) -> impl Iterator<Item = Point> {
        [Some(at), self.fold.map(|fold| fold.across(at))].into_iter().flatten()
    }

    /// The ends of an edge, and of its mirror image.
    fn both_ends(self, [a, b]: [Point; 2]) -> impl Iterator<Item = [Point; 2]> {
        self.both(a).zip(self.both(b)).map(|(a, b)| [a, b])
    }

    fn times(self) -> f64 {
        if self.fold.is_some() { 2.0 } else { 1.0 }
    }
}

/// Lines that stand off an outline are cut there and back.
fn double(paths: &mut [Path], usual: u32) {
    if usual != FINE_OUTLINE {
        return;
    }
    let twigs = twigs(paths);
    paths.iter_mut().zip(twigs).filter(|(_, is_twig)| *is_twig).for_each(|(path, _)| path.times = 2.0);
}
