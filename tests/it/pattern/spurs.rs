//! Slits that lines make which stand off an outline: on any of its vertices or edges, several at one place, with branches, and
//! however the outline is drawn.

use std::f64::consts::TAU;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pipeline::{self, Order};
use fastrand::Rng;

use super::audit::broken;
use super::writer::{Place, Writer};
use super::{as_read, source};

/// A spur: its lines from the outline on. The first stands on the outline and all others on its end.
#[derive(Debug, Clone)]
struct Spur {
    lines: Vec<Vec<Place>>,
}

/// A ring with spurs at some of its vertices; of those on its edges alone a ring without spurs has none.
#[derive(Debug, Clone, Default)]
struct Figure {
    ring: Vec<Place>,
    spurs: Vec<Vec<Spur>>,
    is_on_edge: Vec<bool>,
}

fn thousandths(place: Place) -> Place {
    place.map(|value| (value * 1000.0).round() / 1000.0)
}

/// The place so far from another one in a direction.
fn from([x, y]: Place, length: f64, angle: f64) -> Place {
    thousandths([x + length * angle.cos(), y + length * angle.sin()])
}

impl Spur {
    /// A spur towards the origin: straight, bent in a joint, or with two or three branches.
    fn of(random: &mut Rng, root: Place, aside: f64) -> Self {
        let inwards = (-root[1]).atan2(-root[0]) + aside;
        let middle = from(root, 3.0 + 3.0 * random.f64(), inwards);
        let stem = vec![root, middle];
        let mut branch = |turn: f64| vec![middle, from(middle, 3.0 + 4.0 * random.f64(), inwards + turn)];
        let lines = match branch(0.0)[1][0].to_bits() % 4 {
            0 => vec![stem],
            1 => vec![stem, branch(0.4)],
            2 => vec![stem, branch(0.6), branch(-0.5)],
            _ => vec![stem, branch(0.9), branch(0.0), branch(-0.8)],
        };
        Self { lines }
    }

    /// The way along it and back, behind its root.
    fn way(&self) -> Vec<Place> {
        let [root, middle] = [self.lines[0][0], self.lines[0][1]];
        let branches = self.lines[1..].iter().flat_map(|branch| [branch[1], middle]);
        [middle].into_iter().chain(branches).chain([root]).collect()
    }
}

impl Figure {
    fn of(random: &mut Rng, most: usize) -> Self {
        let mut figure = Self::default();
        let count = random.usize(4..12);
        let corners: Vec<Place> =
            (0..count).map(|k| from([0.0; 2], 120.0 + 60.0 * random.f64(), TAU * k as f64 / count as f64)).collect();
        for k in 0..count {
            let [a, b] = [corners[k], corners[(k + 1) % count]];
            // The first vertex has one in every second figure.
            let several = if random.u8(..if k == 0 { 2 } else { 3 }) == 0 { random.usize(1..=most) } else { 0 };
            let spur = |j: usize, random: &mut Rng| Spur::of(random, a, if j == 0 { 0.08 } else { -0.08 });
            figure.ring.push(a);
            figure.spurs.push((0..several).map(|j| spur(j, random)).collect());
            figure.is_on_edge.push(false);
            for share in [0.3, 0.7] {
                if random.u8(..4) == 0 {
                    let root = thousandths([0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * share));
                    figure.ring.push(root);
                    figure.spurs.push(vec![Spur::of(random, root, 0.0)]);
                    figure.is_on_edge.push(true);
                }
            }
        }
        figure
    }

    fn spurs(&self) -> impl Iterator<Item = &Spur> {
        self.spurs.iter().flatten()
    }

    /// The ring in one line, the spurs apart.
    fn apart(&self, random: &mut Rng) -> String {
        let mut ring: Vec<Place> =
            self.ring.iter().zip(&self.is_on_edge).filter(|(_, is_on_edge)| !**is_on_edge).map(|(at, _)| *at).collect();
        let count = ring.len();
        ring.rotate_left(if random.bool() { 0 } else { random.usize(..count) });
        let lines: Vec<Vec<Place>> = self.spurs().flat_map(|spur| spur.lines.clone()).collect();
        let mut parts = lines;
        parts.push([&ring[..], &ring[..1]].concat());
        written(random, parts)
    }

    /// The ring in lines that meet where spurs stand.
    fn parted(&self, random: &mut Rng) -> String {
        let count = self.ring.len();
        let mut breaks: Vec<usize> = (0..count).filter(|&k| !self.spurs[k].is_empty() || random.u8(..3) == 0).collect();
        if breaks.len() < 2 {
            breaks = vec![0, count / 2];
        }
        let next = breaks.iter().skip(1).copied().chain([breaks[0] + count]);
        let part = |(from, to): (&usize, usize)| (*from..=to).map(|k| self.ring[k % count]).collect::<Vec<Place>>();
        let mut parts: Vec<Vec<Place>> = breaks.iter().zip(next).map(part).collect();
        parts.extend(self.spurs().flat_map(|spur| spur.lines.clone()));
        written(random, parts)
    }

    /// One line along the ring and its spurs, from any place on.
    fn one(&self, random: &mut Rng) -> String {
        let ring = self.ring.iter().zip(&self.spurs);
        let mut way: Vec<Place> =
            ring.flat_map(|(at, spurs)| [vec![*at], spurs.iter().flat_map(Spur::way).collect()].concat()).collect();
        let count = way.len();
        way.rotate_left(random.usize(..count));
        way.push(way[0]);
        written(random, vec![way])
    }
}

/// A file of lines in any order, each either way round.
pub(super) fn written(random: &mut Rng, mut parts: Vec<Vec<Place>>) -> String {
    random.shuffle(&mut parts);
    let mut file = Writer::begin();
    file.block("A");
    for part in &mut parts {
        if random.bool() {
            part.reverse();
        }
        file.polyline(1, part, false);
    }
    file.end_block();
    file.end(&["UNITS: METRIC"])
}

/// The edges of a marker, sorted; each from its lesser end on, in millionths of a millimetre.
fn edges(marker: &Marker) -> Vec<[[i64; 2]; 2]> {
    let mut edges = Vec::new();
    for (_, contour) in marker.contours() {
        assert!(contour.closed);
        let points = marker.points(contour);
        let key = |k: usize| [points[k].x, points[k].y].map(|value| (1e6 * value).round() as i64);
        edges.extend((1..points.len()).map(|k| [key(k - 1).min(key(k)), key(k - 1).max(key(k))]));
    }
    edges.sort_unstable();
    edges
}

#[test]
fn spurs_are_slits_wherever_they_stand_and_however_they_branch() {
    for seed in 0..150 {
        let mut random = Rng::with_seed(seed);
        // Spurs at one vertex of a ring in one line would be joined to a line across it.
        let most = if seed % 2 == 0 { 1 } else { 2 };
        let figure = Figure::of(&mut random, most);
        let mut texts = vec![figure.one(&mut random), figure.parted(&mut random)];
        texts.extend((most == 1).then(|| figure.apart(&mut random)));
        let mut all = texts.iter().map(|text| {
            let source = source(text.clone());
            let (marker, found) = as_read(&source, &Job::default());
            assert!(found.is_empty(), "seed {seed}: {found:?}\n{text}");
            assert_eq!(marker.contours().count(), 1, "seed {seed}\n{text}");
            assert_eq!(broken(&source, &marker, &Job::default()), [""; 0], "seed {seed}\n{text}");
            edges(&marker)
        });
        let wanted = all.next().expect("a file");
        // Each edge of a spur is gone along twice.
        let lines: usize = figure.spurs().map(|spur| spur.lines.len()).sum();
        assert_eq!(wanted.len(), figure.ring.len() + 2 * lines, "seed {seed}");
        for (found, text) in all.zip(&texts[1..]) {
            assert_eq!(found, wanted, "seed {seed}\n{text}");
        }
    }
}

#[test]
fn programs_with_spurs_are_verified() {
    for seed in 0..12 {
        let mut random = Rng::with_seed(seed);
        let figure = Figure::of(&mut random, 1);
        for text in [figure.apart(&mut random), figure.parted(&mut random)] {
            let source = source(text.clone());
            let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
            let mut found = Diagnostics::default();
            let order = Order { from: None, target, verify: true };
            let compiled = pipeline::compile(&source, &Job::default(), order, &mut Cursor::new(Vec::new()), &mut found);
            let is_made = compiled.expect("memory takes everything").is_some();
            assert!(is_made, "seed {seed}: {}\n{text}", render(&found, &source));
        }
    }
}

#[test]
fn an_outline_past_its_start_keeps_its_spurs() {
    for seed in 0..40 {
        let mut random = Rng::with_seed(seed);
        let figure = Figure::of(&mut random, 1);
        let count = figure.ring.len();
        let Some(start) = (0..count).find(|&k| figure.spurs[k].is_empty() && !figure.is_on_edge[k]) else { continue };
        let on = |k: usize| figure.ring[(start + k) % count];
        let [from, to] = [on(0), on(1)];
        let past = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * 0.1);
        let ring = |past: &[Place]| (0..=count).map(on).chain(past.iter().copied()).collect::<Vec<Place>>();
        let read = |past: &[Place], random: &mut Rng| {
            // Lines meet where spurs stand.
            let mut parts: Vec<Vec<Place>> = vec![Vec::new()];
            for (k, at) in ring(past).into_iter().enumerate() {
                parts.last_mut().expect("a line").push(at);
                if k < count && !figure.spurs[(start + k) % count].is_empty() {
                    parts.push(vec![at]);
                }
            }
            parts.extend(figure.spurs().flat_map(|spur| spur.lines.clone()));
            let text = written(random, parts);
            let (marker, found) = as_read(&source(text.clone()), &Job::default());
            let wanted: &[&str] = if past.is_empty() { &[] } else { &["marker/overrun"] };
            assert_eq!(found, wanted, "seed {seed}\n{text}");
            edges(&marker)
        };
        let [overrun, once] = [read(&[past], &mut random), read(&[], &mut random)];
        // The ring may begin at the end of the overrun: then the first edge has a vertex there.
        let added = overrun.iter().filter(|edge| !once.contains(edge)).count();
        assert!(overrun.len() - added + added / 2 == once.len() && added <= 2, "seed {seed}: {overrun:?} {once:?}");
    }
}
