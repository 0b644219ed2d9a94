//! The edges as drawn, to measure by: which is nearest, which way is out, what a head can face.

use std::collections::BTreeMap;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, left, polyline};
use crate::ir::Marker;
use crate::machine::{Fit, MachineProfile};

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
    /// How far the way out of a curve through its ends may be turned from that at each end, rad, to the left positive: as far
    /// as the way out of the chord beyond is; at a corner as at the other end.
    pub(super) bent: [f64; 2],
    /// How far such a curve may lie on the near side of the chord, seen from outside, and on the far side, mm.
    pub(super) bulge: [f64; 2],
    /// Its block.
    pub(super) block: u32,
}

impl Chord {
    /// Curvature of the curve that it stands for, 1/mm, inwards (a bay) positive.
    pub(super) fn bay(&self) -> f64 {
        let way = self.ends[1] - self.ends[0];
        let turn = 0.5 * (self.bent[1] - self.bent[0]);
        turn / way.norm() * left(way).dot(&self.out).signum()
    }
}

/// What of a curve there is at one end of a chord.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Side {
    /// The turn to the chord beyond, rad; nothing at a corner.
    turn: f64,
    /// The length of that chord, mm.
    length: f64,
}

impl Side {
    /// Between a chord and the one before it or behind it.
    fn of(chord: [Point; 2], other: [Point; 2], corner: f64) -> Self {
        let turn = if other[1] == chord[0] {
            polyline::turn_at(other[0], chord[0], chord[1])
        } else {
            polyline::turn_at(chord[0], chord[1], other[1])
        };
        if turn.abs() < corner { Self { turn, length: (other[1] - other[0]).norm() } } else { Self::default() }
    }

    /// This, or at a corner the other one.
    fn or(self, other: Self) -> Self {
        if self.length > 0.0 { self } else { other }
    }

    /// How far a circle through the vertex and its neighbours bulges on a chord of that length, mm.
    fn bulge(self, length: f64) -> f64 {
        0.25 * length * self.turn * length / (length + self.length)
    }
}

/// All edges.
#[derive(Debug)]
pub struct Ground {
    pub(super) chords: Vec<Chord>,
    /// How far from its distance a head may be, mm.
    pub(super) tolerance: f64,
    boxes: Boxes,
    /// The greatest X of any edge, mm.
    right: f64,
    /// The chords of each block.
    blocks: BTreeMap<u32, Vec<usize>>,
}

impl Ground {
    /// The closed contours of a marker; vertices that turn by less than the corner angle of the profile stand for curves.
    pub fn new(marker: &Marker, profile: &MachineProfile) -> Self {
        let corner = profile.corner_angle();
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
            let n = ring.len();
            for (i, &(ends, block)) in ring.iter().enumerate() {
                let sides = [(i + n - 1) % n, (i + 1) % n].map(|j| Side::of(ends, ring[j].0, corner));
                let out = left((ends[1] - ends[0]).normalize());
                let bent = [-sides[0].or(sides[1]).turn, sides[1].or(sides[0]).turn];
                let most = if profile.path.fit == Fit::Curve { profile.path.chord_sag_max_mm } else { 0.0 };
                let bulge = sides.map(|side| side.bulge((ends[1] - ends[0]).norm()).clamp(-most, most));
                // A turn to the left bulges to the right, which is inwards as long as left is out.
                let bulge = [bulge[0].min(bulge[1]).min(0.0).abs(), bulge[0].max(bulge[1]).max(0.0)];
                chords.push(Chord { ends, out, bent, bulge, block });
            }
        }
        let boxes = Boxes::new(chords.iter().map(|chord| Extent::between(chord.ends[0], chord.ends[1])).collect());
        let mut blocks: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, chord) in chords.iter().enumerate() {
            blocks.entry(chord.block).or_default().push(i);
        }
        let right = chords.iter().flat_map(|chord| chord.ends).map(|end| end.x).fold(f64::NEG_INFINITY, f64::max);
        let mut ground = Self { right, chords, tolerance: profile.tolerance(marker.unit), boxes, blocks };
        for i in 0..ground.chords.len() {
            let chord = ground.chords[i];
            let middle = chord.ends[0] + (chord.ends[1] - chord.ends[0]) * 0.5;
            if ground.is_material(middle + chord.out * BESIDE) {
                ground.chords[i].out = -chord.out;
                ground.chords[i].bulge.reverse();
            }
        }
        ground
    }

    /// Whether a place lies in a part: a ray to the right, to the end of everything, crosses an odd number of edges.
    fn is_material(&self, place: Point) -> bool {
        let crosses = |&i: &usize| {
            let [a, b] = self.chords[i].ends;
            (a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y)
        };
        let ray = Extent::between(place, Point::new(self.right.max(place.x), place.y));
        self.boxes.near(ray).filter(crosses).count() % 2 == 1
    }

    /// The chord nearest to a place, and how far outside of it that is, mm, inside being negative; looked for as far as `reach`.
    pub(super) fn nearest(&self, place: Point, reach: f64) -> Option<(&Chord, f64)> {
        let near = self.boxes.near(Extent::between(place, place).grown(reach)).map(|i| &self.chords[i]);
        let away = |chord: &Chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1]);
        // Of two that meet in the nearest vertex the one that faces the place tells outside from inside.
        let height = |chord: &Chord| (place - chord.ends[0]).dot(&chord.out);
        let order = |a: &&Chord, b: &&Chord| {
            let [far_a, far_b] = [away(a), away(b)];
            if (far_a - far_b).abs() > SAME_EPSILON {
                far_a.total_cmp(&far_b)
            } else {
                height(b).abs().total_cmp(&height(a).abs())
            }
        };
        let chord = near.min_by(order)?;
        Some((chord, away(chord).copysign(height(chord))))
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
