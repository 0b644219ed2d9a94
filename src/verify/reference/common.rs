//! Edges that are cut with another part: the cut that stands for each stretch, its distance from the edge, and the places where
//! cuts must meet.
//!
//! All of it is measured on the cloth: along a spared edge, cuts of any part that run beside it are looked for.

use std::collections::BTreeSet;

use super::grid::Grid;
use super::line::Line;
use super::lines::Reference;
use super::shared::{Around, Drawn, SAME, spared};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, cross, polyline};
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::rules;

/// Least cosine between an edge and a cut that stands for it (30 degrees): lines of a few units tell no direction.
const ALONG: f64 = 0.866;
/// Longest break of one cut, and longest gap to the next cut, in multiples of the distance of two edges: covers corners.
const BREAK: f64 = 2.5;
/// Greatest distance, in multiples of the distance of two edges, from the place needed by the outlines, or from an extension of
/// one of the cuts, at which two cuts may cross: where outlines overlap, one cut crosses the other before it ends.
const ABOUT: f64 = 4.0;
/// Least sine of the angle between two lines for which their crossing is looked for in full: lines at a smaller angle run along
/// each other.
pub(super) const LEAST_SINE: f64 = 0.1;
/// Most boxes along one chord of a way.
const MOST_BOXES: f64 = 64.0;
/// Longest part of an edge for which cuts are looked up at a time, mm.
const SPAN: f64 = 32.0;

/// State of the edges that are cut with other parts.
#[derive(Debug, Default)]
pub(in crate::verify) struct Common {
    /// Places around a part where one cut ends and the next begins.
    pub(in crate::verify) joints: Vec<Joint>,
    /// Stretches without a cut: length, mm, and place.
    pub(in crate::verify) uncut: Vec<(f64, Sighting)>,
    /// The greatest distance of an edge from the cut that stands for it, mm, with its place.
    pub(in crate::verify) shift: Option<(f64, Sighting)>,
}

/// A place at the edge of a part where two cuts must meet, so that it comes free.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Joint {
    /// The place.
    pub(in crate::verify) at: Point,
    /// Source block of the edge there.
    pub(in crate::verify) block: u32,
    /// The cuts, by their indices among the cuts of the marker.
    pub(in crate::verify) cuts: [u32; 2],
    /// Boxes in one of which the cuts must cross. The first is around the place. The others are along the stretch of the edge
    /// beside which both cuts run, and around the extensions of a cut there.
    pub(in crate::verify) about: Vec<Extent>,
}

/// Cuts that may stand for edges.
#[derive(Clone, Copy)]
struct Beds<'r, 'a> {
    reference: &'r Reference<'a>,
    grid: &'r Grid,
    /// Greatest distance from an edge, mm.
    distance: f64,
    /// Index of the piece whose sections alone may stand for its edges; `None` = cuts of any piece.
    section: Option<usize>,
}

impl Beds<'_, '_> {
    /// True if a line may stand for an edge.
    fn has(&self, line: &Line) -> bool {
        self.section.is_none_or(|piece| self.reference.owners[line.piece as usize] == piece)
    }
}

/// A cut that stands for an edge from a place on.
struct Stood {
    cut: u32,
    from: Sighting,
    /// Index of the stretch of the edge, if the cut is of its own part.
    own: Option<usize>,
    /// Boxes along the stretch of the edge beside which the cut before it runs too. The cuts may cross anywhere in it: the
    /// earlier one bounds the part up to the crossing, the later one from it on.
    overlap: Vec<Extent>,
}

/// A stretch of an edge for which a cut stands.
struct Stand {
    /// Its stations along the edge, mm.
    over: [f64; 2],
    cut: u32,
    /// Station of the cut at the end of the stretch, mm.
    reached: f64,
}

/// A straight piece of a cut beside an edge.
#[derive(Clone, Copy)]
struct Beside {
    /// Start and end beside the edge, stations of the edge, mm.
    over: [f64; 2],
    /// Index of the cut among the cuts of the marker.
    cut: u32,
    /// Offset of the cut to the left of the edge at both ends, mm.
    aside: [f64; 2],
    /// Stations of the cut at both ends, mm.
    at: [f64; 2],
    /// Length of the cut when it is closed, mm.
    round: Option<f64>,
}

impl Common {
    /// Finds the cuts that stand for the spared edges of some contours, at most `distance` mm away.
    pub(in crate::verify) fn new(shared: &[Around], reference: &Reference, grid: &Grid, distance: f64) -> Self {
        let mut common = Self::default();
        for Around { slits, stretches, section } in shared {
            let beds = Beds { reference, grid, distance, section: *section };
            common.see(stretches, &reference.lines[slits.clone()], beds);
        }
        for stretch in reference.open.iter().filter(|stretch| stretch.cut.is_none()) {
            let [from, to] = stretch.ends;
            common.uncut.push(((to - from).norm(), sighting(from, stretch.block)));
        }
        let leads: Vec<Vec<Point>> = leads(&reference.lines);
        let boxes = Boxes::new(leads.iter().map(|lead| Extent::of(lead)).collect());
        let near = ABOUT * distance;
        for joint in &mut common.joints {
            let place = Extent::between(joint.at, joint.at);
            joint.about[0] = place.grown(near.max(crossing(joint, reference, grid, distance)));
            let by_place = boxes.near(place.grown(near));
            let by_place = by_place.filter(|&lead| polyline::distance(joint.at, &leads[lead]) <= near);
            let by_edge = joint.about[1..].iter().flat_map(|&about| boxes.near(about));
            // Extensions of any cut count: two cuts may be connected by a third one that ends there.
            let led: BTreeSet<usize> = by_place.chain(by_edge).collect();
            joint.about.extend(led.into_iter().map(|lead| boxes.all()[lead].grown(near)));
        }
        common
    }

    /// Distance of edges from the cuts that stand for them.
    pub(in crate::verify) fn finding(&self) -> Finding {
        let mut worst = Worst::new(&rules::COMMON, None);
        if let Some((shift, place)) = self.shift {
            worst.see(shift, || place);
        }
        worst.finding()
    }

    /// Goes once around a contour of a piece with slits.
    fn see(&mut self, ring: &[Drawn], slits: &[Line], beds: Beds) {
        // The tour starts with a stretch that is cut with the piece, if there is one.
        let start =
            (0..ring.len()).find(|&i| ring[i].cut.is_some() && ring[(i + ring.len() - 1) % ring.len()].cut.is_none());
        let mut ring = ring.to_vec();
        ring.rotate_left(start.unwrap_or(0));
        let mut spared = spared(&ring);
        let mut cuts: Vec<Stood> = Vec::new();
        // A cut that leaves the edge and comes back to it leaves the stretch between uncut.
        let mut left: Vec<(usize, f64, Sighting)> = Vec::new();
        let mut is_in_spared = false;
        for (i, stretch) in ring.iter().enumerate() {
            let [from, _] = stretch.ends;
            match stretch.cut {
                Some(cut) => {
                    let from = sighting(from, stretch.block);
                    cuts.push(Stood { cut, from, own: Some(i), overlap: Vec::new() });
                }
                None if is_in_spared => {}
                None => {
                    let edge = spared.next().expect("a spared stretch is one of them");
                    let stands = self.stands(edge, slits, beds);
                    if stands.is_empty() {
                        let length = edge.iter().map(|chord| (chord.ends[1] - chord.ends[0]).norm()).sum();
                        left.push((cuts.len(), length, sighting(from, stretch.block)));
                    }
                    cuts.extend(stands);
                }
            }
            is_in_spared = stretch.cut.is_none();
        }
        let count = cuts.len();
        for (next, length, place) in left {
            // A gap between two different cuts is judged by whether these meet.
            if count == 0 || cuts[next % count].cut == cuts[(next + count - 1) % count].cut {
                self.uncut.push((length, place));
            }
        }
        let Some(mut before) = cuts.last() else { return };
        // A cut of the part itself may be extended along its edge, beside the cut that stands for the edge.
        let also = |own: Option<usize>, cut: u32, step: usize| {
            let stretches = own.into_iter().flat_map(|own| (0..ring.len()).map(move |k| own + k * step));
            both_beside(stretches.map(|i| &ring[i % ring.len()]), cut, beds)
        };
        for next in &cuts {
            if before.cut != next.cut {
                let led_on =
                    also(before.own, next.cut, ring.len() - 1).into_iter().chain(also(next.own, before.cut, 1));
                let about = [Extent::EMPTY].into_iter().chain(next.overlap.iter().copied()).chain(led_on).collect();
                let Sighting { point: at, block, .. } = next.from;
                self.joints.push(Joint { at, block, cuts: [before.cut, next.cut], about });
            }
            before = next;
        }
    }

    /// Cuts that stand for an edge, each with the place where it begins to; the cuts of slits on the edge must meet the slits.
    fn stands(&mut self, edge: &[Drawn], slits: &[Line], beds: Beds) -> Vec<Stood> {
        let distance = beds.distance;
        let points: Vec<Point> = edge[..1].iter().map(|chord| chord.ends[0]).chain(ends(edge)).collect();
        let stations = polyline::stations(&points);
        let length = stations[edge.len()];
        let seen = |station: f64| {
            let chord = stations.partition_point(|&passed| passed <= station).clamp(1, edge.len()) - 1;
            sighting(polyline::place(&points, &stations, station), edge[chord].block)
        };
        let reach = BREAK * distance;
        let mut found = Stands { reach, ..Stands::default() };
        for (chord, &start) in edge.iter().zip(&stations) {
            for one in beside(chord, beds) {
                found.add(Beside { over: one.over.map(|way| way + start), ..one });
            }
        }
        let Stands { all: stands, covered, left, shift, .. } = found;
        for gap in left {
            let (length, at) = longest_without(gap, &covered);
            if length > distance / 2.0 {
                self.uncut.push((length, seen(at)));
            }
        }
        if shift.0 > self.shift.map_or(0.0, |known| known.0) {
            self.shift = Some((shift.0, seen(shift.1)));
        }
        let slits = slits.iter().filter(|slit| is_on(root(slit), edge, distance));
        self.joints.extend(slits.filter_map(|slit| {
            let cut = first_across(slit, &stands, beds)?;
            let (at, block) = (root(slit), slit.block(0));
            Some(Joint { at, block, cuts: [cut, slit.cut.index], about: vec![Extent::EMPTY] })
        }));
        let overlap = |before: &Stand, next: &Stand| {
            let [from, to] = [before.over[0].max(next.over[0]), before.over[1].min(next.over[1])];
            if from < to { along_edge(&points, &stations, [from, to], distance) } else { Vec::new() }
        };
        let (mut at, mut chain, mut before) = (0.0, Vec::new(), None);
        while length - at > reach {
            let next = stands.iter().filter(|stand| stand.over[0] <= at + reach && stand.over[1] > at + SAME);
            let next = next.max_by(|a, b| a.over[1].total_cmp(&b.over[1]).then(b.cut.cmp(&a.cut)));
            if let Some(next) = next {
                let overlap = before.map_or_else(Vec::new, |before| overlap(before, next));
                chain.push(Stood { cut: next.cut, from: seen(at), own: None, overlap });
                (at, before) = (next.over[1], Some(next));
                continue;
            }
            before = None;
            let ahead = stands.iter().map(|stand| stand.over[0]).filter(|&from| from > at).fold(length, f64::min);
            self.uncut.push((ahead - at, seen(f64::midpoint(at, ahead))));
            at = ahead;
        }
        chain
    }
}

/// Greatest distance from a joint at which its cuts cross, mm, when each is off by the tolerance: lines at a small angle cross
/// farther away.
fn crossing(joint: &Joint, reference: &Reference, grid: &Grid, distance: f64) -> f64 {
    let directions = |cut: u32| -> Vec<Vector> {
        let runs = grid.near(joint.at, distance).map(|run| (&reference.lines[run.line()], run));
        let of_cut = runs.filter(|(line, _)| line.cut.index == cut);
        let chords = of_cut.flat_map(|(line, run)| run.chords().map(move |chord| (line, chord)));
        let here = chords.filter(|(line, chord)| line.distance_to_chord(*chord, joint.at) <= distance);
        here.map(|(line, chord)| line.direction(chord)).collect()
    };
    let [ones, others] = joint.cuts.map(directions);
    let sines = ones.iter().flat_map(|one| others.iter().map(|other| cross(*one, *other).abs()));
    let sine = sines.fold(0.0, f64::max);
    if sine < LEAST_SINE { 0.0 } else { (2.0 * reference.tolerance + distance) / sine }
}

/// True if a place lies at most `distance` mm from an edge.
fn is_on(place: Point, edge: &[Drawn], distance: f64) -> bool {
    edge.iter().any(|chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1]) <= distance)
}

/// Place of a slit on the drawn edge.
fn root(slit: &Line) -> Point {
    slit.place(slit.aside.first().map_or(0.0, |&[_, end]| end))
}

/// The first of the cuts that stand for an edge that a slit on it meets on the way out of the part.
fn first_across(slit: &Line, stands: &[Stand], Beds { reference, grid, distance, .. }: Beds) -> Option<u32> {
    let root = root(slit);
    let out = polyline::direction(slit.place(slit.length()), root)?;
    let reach = ABOUT * distance;
    let mut first: Option<(f64, u32)> = None;
    for run in grid.near(root, reach) {
        let line = &reference.lines[run.line()];
        if line.cut.is_edge || !stands.iter().any(|stand| stand.cut == line.cut.index) {
            continue;
        }
        for [a, b] in run.chords().map(|i| [line.point(i), line.point(i + 1)]) {
            let sides = [a, b].map(|end| cross(out, end - root));
            if (sides[0] > 0.0) == (sides[1] > 0.0) {
                continue;
            }
            let way = (a + (b - a) * (sides[0] / (sides[0] - sides[1])) - root).dot(&out);
            if way.abs() <= reach && first.is_none_or(|known| (way, line.cut.index) < known) {
                first = Some((way, line.cut.index));
            }
        }
    }
    first.map(|(_, cut)| cut)
}

/// A place of the drawing without a time of the program.
fn sighting(point: Point, block: u32) -> Sighting {
    Sighting::missing(point, block)
}

/// Extensions of cuts: stretches at their ends that lie on no edge of their own part.
fn leads(lines: &[Line]) -> Vec<Vec<Point>> {
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate().filter(|(_, line)| !line.cut.is_edge && line.cut.round.is_none()) {
        let is_of_cut = |other: Option<&Line>| other.is_some_and(|other| other.cut.index == line.cut.index);
        let begins = !is_of_cut(i.checked_sub(1).map(|before| &lines[before]));
        let ends = !is_of_cut(lines.get(i + 1));
        for &[from, to] in &line.aside {
            if begins && from <= SAME || ends && line.length() - to <= SAME {
                let inner = line.vertices(from, to).map(|vertex| line.point(vertex));
                found.push(std::iter::once(line.place(from)).chain(inner).chain([line.place(to)]).collect());
            }
        }
    }
    found
}

/// The cuts beside an edge, in the order along it.
#[derive(Default)]
struct Stands {
    all: Vec<Stand>,
    /// Stretches of the edge that pieces of cuts cover, mm along it.
    covered: Vec<[f64; 2]>,
    /// Stretches of the edge over which a cut does not go straight on, mm along the edge.
    left: Vec<[f64; 2]>,
    /// Greatest distance of a cut from the edge, mm, and its station along the edge, mm.
    shift: (f64, f64),
    /// Longest break of one cut, mm.
    reach: f64,
}

impl Stands {
    /// Adds the next piece of a cut.
    fn add(&mut self, piece: Beside) {
        let Beside { over, cut, aside, at, round } = piece;
        self.covered.push(over);
        let off = aside[0].abs().max(aside[1].abs());
        if off > self.shift.0 {
            self.shift = (off, over[0]);
        }
        let reach = self.reach;
        let meets = |known: &&mut Stand| {
            known.cut == cut && over[0] <= known.over[1] + reach && over[1] >= known.over[0] - reach
        };
        let Some(known) = self.all.iter_mut().find(meets) else {
            return self.all.push(Stand { over, cut, reached: at[1] });
        };
        // A detour round a notch is longer than one about a corner: then the cloth of the notch hangs on this part.
        let gap = over[0] - known.over[1];
        if gap > SAME && along(known.reached, at[0], round) > reach + gap {
            self.left.push([known.over[1], over[0]]);
        }
        if over[1] > known.over[1] {
            known.reached = at[1];
        }
        known.over = [known.over[0].min(over[0]), known.over[1].max(over[1])];
    }
}

/// End points of the chords of an edge.
fn ends(edge: &[Drawn]) -> impl Iterator<Item = Point> {
    edge.iter().map(|chord| chord.ends[1])
}

/// Boxes along a stretch of an edge, mm along it, each grown by `distance`, the greatest distance of a cut from the edge, mm.
fn along_edge(points: &[Point], stations: &[f64], [from, to]: [f64; 2], distance: f64) -> Vec<Extent> {
    let first = stations.partition_point(|&station| station <= from);
    let last = stations.partition_point(|&station| station < to);
    let ends = [from, to].map(|station| polyline::place(points, stations, station));
    let vertices: Vec<Point> = ends[..1].iter().chain(&points[first..last]).chain(&ends[1..]).copied().collect();
    boxes_of(&vertices, distance)
}

/// Boxes along a polyline, each grown by `distance` mm. Long chords are divided, since the box of a long oblique chord would
/// hold places far from it.
pub(super) fn boxes_of(points: &[Point], distance: f64) -> Vec<Extent> {
    let mut found = Vec::new();
    for chord in points.windows(2) {
        let way = chord[1] - chord[0];
        let count = (way.norm() / (ABOUT * distance)).ceil().clamp(1.0, MOST_BOXES);
        let place = |share: f64| chord[0] + way * (share / count);
        let places = (0..count as u64).map(|k| k as f64);
        found.extend(places.map(|k| Extent::between(place(k), place(k + 1.0)).grown(distance)));
    }
    found
}

/// Boxes along the first of some stretches of an edge, as far as a cut runs beside them, each grown by `distance`, the greatest
/// distance of a cut from the edge, mm.
fn both_beside<'s>(stretches: impl Iterator<Item = &'s Drawn>, cut: u32, beds: Beds) -> Vec<Extent> {
    let mut found = Vec::new();
    for stretch in stretches.take_while(|stretch| stretch.cut.is_some()) {
        let pieces: Vec<Beside> = beside(stretch, beds).into_iter().filter(|piece| piece.cut == cut).collect();
        if pieces.is_empty() {
            break;
        }
        let [from, to] = stretch.ends;
        let along = polyline::direction(from, to).unwrap_or_default();
        let places = pieces.iter().map(|piece| piece.over.map(|way| from + along * way));
        found.extend(places.flat_map(|ends| boxes_of(&ends, beds.distance)));
    }
    found
}

/// Distance between two stations along a cut, mm; `round` is the length of a closed cut.
pub(super) fn along(from: f64, to: f64, round: Option<f64>) -> f64 {
    let way = (to - from).abs();
    round.map_or(way, |length| {
        let way = way.rem_euclid(length);
        way.min(length - way)
    })
}

/// Longest part of a stretch that no others cover, mm, and its start.
fn longest_without([from, to]: [f64; 2], covered: &[[f64; 2]]) -> (f64, f64) {
    let mut ends: Vec<[f64; 2]> = covered.iter().copied().filter(|over| over[1] > from && over[0] < to).collect();
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut longest, mut reached) = ((0.0, from), from);
    for [start, end] in ends.into_iter().chain([[to; 2]]) {
        if start - reached > longest.0 {
            longest = (start - reached, reached);
        }
        reached = reached.max(end);
    }
    longest
}

/// The cuts beside a chord of an edge.
fn beside(chord: &Drawn, beds: Beds) -> Vec<Beside> {
    let [from, to] = chord.ends;
    let Some(along) = polyline::direction(from, to) else { return Vec::new() };
    let length = (to - from).norm();
    let parts = (length / SPAN).ceil().max(1.0);
    let span = length / parts;
    let mut found = Vec::new();
    for part in 0..parts as usize {
        let start = from + along * (span * part as f64);
        let of_part = beside_part(start, along, span, beds).into_iter();
        found.extend(of_part.map(|one| Beside { over: one.over.map(|way| way + span * part as f64), ..one }));
    }
    found
}

/// Pieces of cuts beside a part of an edge, from a place along a unit vector.
fn beside_part(from: Point, along: Vector, length: f64, beds: Beds) -> Vec<Beside> {
    let Beds { reference, grid, distance, .. } = beds;
    let middle = from + along * (length / 2.0);
    let mut found = Vec::new();
    for run in grid.near(middle, length / 2.0 + distance) {
        let line = &reference.lines[run.line()];
        if line.cut.is_edge || !beds.has(line) {
            continue;
        }
        for i in run.chords() {
            let ends = [line.point(i), line.point(i + 1)];
            let Some(direction) = polyline::direction(ends[0], ends[1]) else { continue };
            if direction.dot(&along).abs() < ALONG {
                continue;
            }
            let [a, b] = ends.map(|end: Point| ((end - from).dot(&along), cross(along, end - from)));
            let off = |way: f64| a.1 + (b.1 - a.1) * ((way - a.0) / (b.0 - a.0));
            let (mut low, mut high) = (a.0.min(b.0).max(0.0), a.0.max(b.0).min(length));
            if b.1 != a.1 {
                let limits = [-distance, distance].map(|limit| a.0 + (limit - a.1) / (b.1 - a.1) * (b.0 - a.0));
                (low, high) = (low.max(limits[0].min(limits[1])), high.min(limits[0].max(limits[1])));
            } else if a.1.abs() > distance {
                continue;
            }
            if high > low {
                let (from, way) = (line.cut.offset + line.station(i), line.station(i + 1) - line.station(i));
                let at = [low, high].map(|place| from + way * ((place - a.0) / (b.0 - a.0)));
                let aside = [low, high].map(|way| off(way).clamp(-distance, distance));
                found.push(Beside { over: [low, high], cut: line.cut.index, aside, at, round: line.cut.round });
            }
        }
    }
    found.sort_by(|a, b| a.over[0].total_cmp(&b.over[0]).then(a.cut.cmp(&b.cut)));
    found
}
