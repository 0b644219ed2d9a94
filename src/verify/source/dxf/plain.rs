//! Second reading of plain drawings: strokes at their places, including insertions.

use std::collections::{BTreeMap, BTreeSet};

use super::curve::{self, Curve, Place};
use super::tags::{File, Item, Sheet, sheets};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point};
use crate::machine::MachineProfile;
use crate::units::MM_PER_INCH;
use crate::verify::source::census::{ARC_SAGITTA, Census, Slack};
use crate::verify::source::drawing::drawn::Drawn;

/// Lengths of units by their numbers in the header, mm.
const UNITS: [(f64, f64); 7] =
    [(1.0, MM_PER_INCH), (2.0, 304.8), (4.0, 1.0), (5.0, 10.0), (6.0, 1000.0), (10.0, 914.4), (14.0, 100.0)];
/// Longest side of a drawing, mm, in a header unit that is larger than an inch.
const LONGEST: f64 = 3e4;
/// Maximum nesting depth of insertions, and maximum number of insertions and of items that are followed: beyond these, readers
/// refuse the file.
const DEEPEST: usize = 32;
const MOST_INSERTS: usize = 100_000;
const MOST_ITEMS: usize = 8_000_000;
/// Initial number of chords of a curve between two breaks; their greatest deviation relative to the reader's; and the maximum
/// number of doublings to reach it.
const CHORDS: usize = 16;
const FINER: f64 = 1.0 / 16.0;
const DOUBLINGS: usize = 9;
/// Factor of the length that chords lack: a third of their height times the angle that they cut off.
const LACKING: f64 = 1.0 / 3.0;
/// Safety factor for the rounding of that length.
const ROOM: f64 = 2.0;

/// Affine map: images of the unit vectors, and of the origin.
#[derive(Debug, Clone, Copy)]
struct Map([Place; 3]);

impl Map {
    fn at(&self, [x, y]: Place) -> Place {
        let [a, b, o] = self.0;
        [o[0] + a[0] * x + b[0] * y, o[1] + a[1] * x + b[1] * y]
    }

    /// Composition of two maps; `first` is applied first.
    fn after(&self, first: &Self) -> Self {
        let origin = self.at(first.0[2]);
        let way = |to: Place| {
            let [x, y] = self.at([to[0] + first.0[2][0], to[1] + first.0[2][1]]);
            [x - origin[0], y - origin[1]]
        };
        Self([way(first.0[0]), way(first.0[1]), origin])
    }
}

/// State of the traversal of a drawing.
struct Scan<'a> {
    blocks: BTreeMap<Vec<u8>, &'a Sheet<'a>>,
    hidden: &'a BTreeMap<Vec<u8>, bool>,
    /// Greatest distance of the reader's chords from their curve, mm.
    sagitta: f64,
    census: Census,
    slack: Slack,
    strokes: Vec<Vec<Point>>,
    /// Names of the layers with strokes.
    layers: BTreeSet<&'a [u8]>,
    /// Numbers of insertions and of items that may still be followed.
    left: usize,
    items_left: usize,
}

/// Statistics of a drawing.
pub(in crate::verify::source) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let (_, census, slack) = scanned(bytes, profile);
    (census, slack)
}

/// Strokes of a drawing.
pub(in crate::verify::source) fn drawn(bytes: &[u8], profile: &MachineProfile) -> Drawn {
    scanned(bytes, profile).0
}

fn scanned(bytes: &[u8], profile: &MachineProfile) -> (Drawn, Census, Slack) {
    let file = sheets(bytes, &profile.labels);
    let in_unit = |unit: f64| {
        let mut scan = Scan::of(&file, profile);
        let map = Map([[unit, 0.0], [0.0, unit], [0.0; 2]]);
        scan.items(&file.loose.items, &map, None, 0);
        let layers = scan.layers.iter().map(|name| file.letters.read(name)).collect();
        (Drawn { strokes: scan.strokes, unit: 0.0, layers }, scan.census, scan.slack)
    };
    let of_header = file.unit.and_then(|number| UNITS.iter().find(|unit| unit.0 == number)).map_or(1.0, |unit| unit.1);
    match profile.dxf.unit.mm() {
        Some(unit) => in_unit(unit),
        None if of_header > MM_PER_INCH => {
            let alone = in_unit(1.0);
            let (width, height) = alone.1.bounds.size();
            if of_header * width.max(height) > LONGEST { alone } else { in_unit(of_header) }
        }
        None => in_unit(of_header),
    }
}

impl<'a> Scan<'a> {
    fn of(file: &'a File<'a>, profile: &MachineProfile) -> Self {
        let mut blocks = BTreeMap::new();
        for block in &file.blocks {
            blocks.entry(block.name.clone()).or_insert(block);
        }
        let sagitta = profile.tolerance(0.0) * ARC_SAGITTA;
        Self {
            blocks,
            hidden: &file.hidden,
            sagitta,
            census: Census::empty(0.0),
            slack: Slack { sagitta, length: 0.0, bounds: 0.0, moments: Moments::default() },
            strokes: Vec::new(),
            layers: BTreeSet::new(),
            left: MOST_INSERTS,
            items_left: MOST_ITEMS,
        }
    }

    /// Follows the items of a block, or those outside blocks; items on layer 0 of a block are on the layer of its insertion.
    fn items(&mut self, items: &'a [Item<'a>], map: &Map, layer: Option<&'a [u8]>, depth: usize) {
        let mut rest = items;
        while let [item, behind @ ..] = rest {
            let is_vertex = |item: &&Item| item.kind == b"VERTEX";
            let vertices = if item.kind == b"POLYLINE" { behind.iter().take_while(is_vertex).count() } else { 0 };
            rest = &behind[vertices..];
            if self.items_left == 0 {
                return;
            }
            self.items_left -= 1;
            let own = item.text(8);
            let on = layer.filter(|_| own == b"0" || own.is_empty()).unwrap_or(own);
            let is_insert = item.kind == b"INSERT";
            let is_hidden = self.hidden.get(on).is_some_and(|&is_frozen| is_frozen || !is_insert);
            if is_hidden || item.number(60) == Some(1.0) {
                continue;
            }
            if is_insert {
                self.insert(item, map, on, depth);
            } else {
                let before = self.strokes.len();
                self.item(item, &behind[..vertices], map);
                self.layers.extend((self.strokes.len() > before).then_some(on));
            }
        }
    }

    fn insert(&mut self, item: &'a Item<'a>, map: &Map, layer: &'a [u8], depth: usize) {
        let Some(&block) = self.blocks.get(&item.text(2).to_ascii_uppercase()) else { return };
        let (Some(at), Some(base)) = (item.pair([10, 20]), block.base) else { return };
        if depth == DEEPEST {
            return;
        }
        let number = |code, usual| item.number(code).unwrap_or(usual);
        let (sin, cos) = number(50, 0.0).to_radians().sin_cos();
        let [x, y] = [number(41, 1.0), number(42, 1.0)];
        let [columns, rows] = [70, 71].map(|code| number(code, 1.0).max(1.0) as usize);
        for row in 0..rows {
            for column in 0..columns {
                if self.left == 0 {
                    return;
                }
                self.left -= 1;
                let step = [column as f64 * number(44, 0.0), row as f64 * number(45, 0.0)];
                let off = [step[0] - x * base[0], step[1] - y * base[1]];
                let origin = [at[0] + cos * off[0] - sin * off[1], at[1] + sin * off[0] + cos * off[1]];
                let own = Map([[cos * x, sin * x], [-sin * y, cos * y], origin]);
                self.items(&block.items, &plane(item, map).after(&own), Some(layer), depth + 1);
            }
        }
    }

    fn item(&mut self, item: &Item, vertices: &[Item], map: &Map) {
        match &item.kind[..] {
            b"LINE" => {
                if let (Some(from), Some(to)) = (item.pair([10, 20]), item.pair([11, 21])) {
                    self.chain(&[(from, 0.0), (to, 0.0)], false, map);
                }
            }
            b"LWPOLYLINE" => {
                let mut places: Vec<(Place, f64)> = Vec::new();
                let mut x = 0.0;
                for (code, value) in item.each([10, 20, 42]) {
                    match code {
                        10 => x = value,
                        20 => places.push(([x, value], 0.0)),
                        _ => places.last_mut().into_iter().for_each(|place| place.1 = value),
                    }
                }
                self.chain(&places, item.flag(1) == Some(true), &plane(item, map));
            }
            b"POLYLINE" => {
                let flags = item.number(70).unwrap_or(0.0) as u32;
                if flags & (16 | 64) != 0 {
                    return;
                }
                let is_line = |vertex: &&Item| vertex.flag(16) == Some(false);
                let place = |vertex: &Item| Some((vertex.pair([10, 20])?, vertex.number(42).unwrap_or(0.0)));
                let places: Vec<(Place, f64)> = vertices.iter().filter(is_line).filter_map(place).collect();
                self.chain(&places, flags & 1 != 0, &if flags & 8 != 0 { *map } else { plane(item, map) });
            }
            b"CIRCLE" | b"ARC" => self.alone(curve::round(item), &[0.0, 1.0], &plane(item, map)),
            b"ELLIPSE" => self.alone(curve::ellipse(item, is_from_below(item)), &[0.0, 1.0], map),
            b"SPLINE" => self.alone(curve::spline(item), &curve::breaks(item), map),
            _ => {}
        }
    }

    /// Adds a stroke of straight lines and arcs.
    fn chain(&mut self, places: &[(Place, f64)], is_closed: bool, map: &Map) {
        let mut stroke: Vec<Point> = Vec::new();
        let edges = if is_closed { places.len() } else { places.len().saturating_sub(1) };
        for k in 0..edges {
            let ((from, bulge), (to, _)) = (places[k], places[(k + 1) % places.len()]);
            if stroke.is_empty() {
                stroke.push(point(map.at(from)));
            }
            if bulge == 0.0 {
                self.line(&mut stroke, point(map.at(to)));
            } else {
                self.curve(&curve::bulge(from, to, bulge), &[0.0, 1.0], map, &mut stroke);
            }
        }
        self.end(stroke);
    }

    /// Adds a curve as a stroke of its own.
    fn alone(&mut self, curve: Option<Curve>, breaks: &[f64], map: &Map) {
        let Some(curve) = curve else { return };
        let mut stroke = vec![point(map.at(curve(0.0)))];
        self.curve(&curve, breaks, map, &mut stroke);
        self.end(stroke);
    }

    fn line(&mut self, stroke: &mut Vec<Point>, to: Point) {
        self.census.points += usize::from(stroke[stroke.len() - 1] != to);
        stroke.push(to);
    }

    /// Follows a curve in chords finer than those of any reader, and adds the permitted shortfall of the reader's chords to the
    /// slack.
    fn curve(&mut self, curve: &Curve, breaks: &[f64], map: &Map, stroke: &mut Vec<Point>) {
        let place = |share: f64| point(map.at(curve(share)));
        let mut fine = vec![stroke[stroke.len() - 1]];
        for pair in breaks.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let mut count = CHORDS;
            for _ in 0..DOUBLINGS {
                let at = |k: usize, of: usize| place(from + (to - from) * k as f64 / of as f64);
                let off = (0..count).map(|k| {
                    let [a, b] = [at(k, count), at(k + 1, count)];
                    (at(2 * k + 1, 2 * count) - (a + (b - a) / 2.0)).norm()
                });
                if off.fold(0.0, f64::max) <= self.sagitta * FINER {
                    break;
                }
                count *= 2;
            }
            fine.extend((1..=count).map(|k| place(from + (to - from) * k as f64 / count as f64)));
        }
        let length = Moments::of(fine.iter().copied()).length();
        let turn: f64 = fine.windows(3).map(|three| turned([three[0], three[1], three[2]])).sum();
        let reach = fine.iter().map(|at| at.coords.amax()).fold(0.0, f64::max);
        let lack = ROOM * LACKING * turn * self.sagitta;
        self.slack.length += lack;
        self.slack.moments += Moments::beside(length, reach, [self.sagitta, lack]);
        self.slack.bounds = self.sagitta;
        self.census.points += usize::from(length > 0.0);
        stroke.extend_from_slice(&fine[1..]);
    }

    fn end(&mut self, stroke: Vec<Point>) {
        if stroke.windows(2).all(|pair| pair[0] == pair[1]) {
            return;
        }
        let moments = Moments::of(stroke.iter().copied());
        self.census.length += moments.length();
        self.census.moments += moments;
        let extent = Extent::of(&stroke);
        self.census.bounds.add(extent.min);
        self.census.bounds.add(extent.max);
        self.strokes.push(stroke);
    }
}

/// Absolute turn of a polyline of three points, rad.
fn turned([a, b, c]: [Point; 3]) -> f64 {
    let [v, w] = [b - a, c - b];
    (v.x * w.y - v.y * w.x).atan2(v.dot(&w)).abs()
}

fn point([x, y]: Place) -> Point {
    Point::new(x, y)
}

/// True if an item is seen from the back of the cloth.
fn is_from_below(item: &Item) -> bool {
    item.number(230).is_some_and(|up| up < 0.0)
}

/// Map of an item on its own plane: seen from the back, X points left.
fn plane(item: &Item, map: &Map) -> Map {
    let [x, y, origin] = map.0;
    if is_from_below(item) { Map([[-x[0], -x[1]], y, origin]) } else { *map }
}
