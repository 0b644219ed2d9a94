//! The edges as drawn, to measure by: which is nearest, which way is out, what a head can face.

use std::collections::BTreeMap;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, left, polyline};
use crate::ir::Marker;

/// Points nearer to each other than that are one, mm.
const SAME_EPSILON: f64 = 1e-6;
/// How far beside an edge it is tried whether that is outside, mm.
const BESIDE: f64 = 1e-3;

/// A chord of an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    /// Its ends, mm.
    pub(super) ends: [Point; 2],
    /// Unit vector away from the material.
    pub(super) out: Vector,
    /// How far a curve through its ends may turn the way out from that, rad: half of the turn at each that is no corner, to
    /// the left positive.
    pub(super) bent: [f64; 2],
    /// Its block.
    pub(super) block: u32,
}

/// All edges.
#[derive(Debug)]
pub struct Ground {
    pub(super) chords: Vec<Chord>,
    boxes: Boxes,
    /// The chords of each block.
    blocks: BTreeMap<u32, Vec<usize>>,
}

impl Ground {
    /// The closed contours of a marker; vertices that turn by less than `corner` (rad) stand for curves.
    pub fn new(marker: &Marker, corner: f64) -> Self {
        let mut chords: Vec<Chord> = Vec::new();
        for (_, contour) in marker.contours().filter(|(_, contour)| contour.closed) {
            let points = marker.list.points(contour.range);
            let spans = marker.list.spans(contour.range);
            let n = points.len();
            let mut ring: Vec<([Point; 2], u32)> = Vec::new();
            for i in 0..n {
                let ends = [points[i], points[(i + 1) % n]];
                if (ends[1] - ends[0]).norm() > SAME_EPSILON {
                    ring.push((ends, spans[i.min(spans.len() - 1)].block));
                }
            }
            let turn = |i: usize, j: usize| {
                let turn = polyline::turn_at(ring[i].0[0], ring[i].0[1], ring[j].0[1]);
                if turn.abs() < corner { 0.5 * turn } else { 0.0 }
            };
            let n = ring.len();
            for (i, &(ends, block)) in ring.iter().enumerate() {
                let bent = [-turn((i + n - 1) % n, i), turn(i, (i + 1) % n)];
                chords.push(Chord { ends, out: left((ends[1] - ends[0]).normalize()), bent, block });
            }
        }
        let boxes = Boxes::new(chords.iter().map(|chord| Extent::between(chord.ends[0], chord.ends[1])).collect());
        let mut blocks: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, chord) in chords.iter().enumerate() {
            blocks.entry(chord.block).or_default().push(i);
        }
        let mut ground = Self { chords, boxes, blocks };
        for i in 0..ground.chords.len() {
            let chord = ground.chords[i];
            let middle = chord.ends[0] + (chord.ends[1] - chord.ends[0]) * 0.5;
            if ground.is_material(middle + chord.out * BESIDE) {
                ground.chords[i].out = -chord.out;
            }
        }
        ground
    }

    /// Whether a place lies in a part: an odd number of edges lies to the right of it.
    fn is_material(&self, place: Point) -> bool {
        let crosses = |chord: &&Chord| {
            let [a, b] = chord.ends;
            (a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y)
        };
        self.chords.iter().filter(crosses).count() % 2 == 1
    }

    /// How far the nearest chord is from a place, mm; looked for as far as `reach`.
    pub(super) fn nearest(&self, place: Point, reach: f64) -> Option<f64> {
        let near = self.boxes.near(Extent::between(place, place).grown(reach)).map(|i| &self.chords[i]);
        near.map(|chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1])).min_by(f64::total_cmp)
    }

    /// The chords that are no farther from a place than that, mm.
    pub(super) fn within(&self, place: Point, distance: f64) -> impl Iterator<Item = &Chord> {
        let near = self.boxes.near(Extent::between(place, place).grown(distance)).map(|i| &self.chords[i]);
        near.filter(move |chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1]) <= distance)
    }

    /// The chords that a block draws.
    pub(super) fn of_block(&self, block: u32) -> impl Iterator<Item = &Chord> {
        self.blocks.get(&block).into_iter().flatten().map(|&i| &self.chords[i])
    }

    /// Whether any edge is nearer to a place than that, mm.
    pub(super) fn is_nearer(&self, place: Point, distance: f64) -> bool {
        self.boxes.near(Extent::between(place, place).grown(distance)).any(|i| {
            let [a, b] = self.chords[i].ends;
            polyline::distance_to_segment(place, a, b) < distance
        })
    }
}
