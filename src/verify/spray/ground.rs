//! Edges as drawn: nearest edge, outward direction, and places that a head can face.

use std::collections::BTreeMap;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, left, polyline};
use crate::ir::Marker;
use crate::machine::{Fit, MachineProfile};

/// Distance below which two points coincide, mm.
const SAME_EPSILON: f64 = 1e-6;
/// Distance from an edge at which its outer side is tested, mm.
const BESIDE: f64 = 1e-3;

/// Chord of an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    /// Ends, mm.
    pub(super) ends: [Point; 2],
    /// Unit vector away from the material.
    pub(super) out: Vector,
    /// Greatest turn of the outward direction of a curve through the ends, relative to `out`, at each end, rad, positive to
    /// the left: that of the neighbouring chord's outward direction; at a corner, the value of the other end.
    pub(super) bent: [f64; 2],
    /// Greatest distance of such a curve from the chord on its outer side and on its inner side, mm.
    pub(super) bulge: [f64; 2],
    /// Source block.
    pub(super) block: u32,
}

impl Chord {
    /// Curvature of the curve that the chord approximates, 1/mm, positive inwards (a bay).
    pub(super) fn bay(&self) -> f64 {
        let way = self.ends[1] - self.ends[0];
        let turn = 0.5 * (self.bent[1] - self.bent[0]);
        turn / way.norm() * left(way).dot(&self.out).signum()
    }
}

/// Neighbourhood of a curve at one end of a chord.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Side {
    /// Turn to the neighbouring chord, rad; 0 at a corner.
    turn: f64,
    /// Length of the neighbouring chord, mm; 0 at a corner.
    length: f64,
}

impl Side {
    /// Neighbourhood of a chord towards the previous or the next chord.
    fn of(chord: [Point; 2], other: [Point; 2], corner: f64) -> Self {
        let turn = if other[1] == chord[0] {
            polyline::turn_at(other[0], chord[0], chord[1])
        } else {
            polyline::turn_at(chord[0], chord[1], other[1])
        };
        if turn.abs() < corner { Self { turn, length: (other[1] - other[0]).norm() } } else { Self::default() }
    }

    /// This side, or at a corner the other one.
    fn or(self, other: Self) -> Self {
        if self.length > 0.0 { self } else { other }
    }

    /// Bulge on a chord of that length of the circle through the vertex and its neighbours, mm.
    fn bulge(self, length: f64) -> f64 {
        0.25 * length * self.turn * length / (length + self.length)
    }
}

/// All edges, with an index of their chords.
#[derive(Debug)]
pub struct Ground {
    pub(super) chords: Vec<Chord>,
    /// Greatest permitted error of a head's distance, mm.
    pub(super) tolerance: f64,
    boxes: Boxes,
    /// Greatest X of any edge, mm.
    right: f64,
    /// Chords of each block.
    blocks: BTreeMap<u32, Vec<usize>>,
}

impl Ground {
    /// Ground of the closed contours of a marker; vertices that turn by less than the profile's corner angle approximate
    /// curves.
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
                // A turn to the left bulges to the right, which is inwards as long as left is outwards.
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

    /// True if a point lies in a part: a ray to the right crosses an odd number of edges.
    fn is_material(&self, place: Point) -> bool {
        let crosses = |&i: &usize| {
            let [a, b] = self.chords[i].ends;
            (a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y)
        };
        let ray = Extent::between(place, Point::new(self.right.max(place.x), place.y));
        self.boxes.near(ray).filter(crosses).count() % 2 == 1
    }

    /// Chord nearest to a point and the signed distance outside of it, mm, negative inside; `None` without a chord within
    /// `reach`.
    pub(super) fn nearest(&self, place: Point, reach: f64) -> Option<(&Chord, f64)> {
        let near = self.boxes.near(Extent::between(place, place).grown(reach)).map(|i| &self.chords[i]);
        let away = |chord: &Chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1]);
        // If two chords meet in the nearest vertex, the one that faces the point determines the side.
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

    /// Chords within a distance of a point, mm.
    pub(super) fn within(&self, place: Point, distance: f64) -> impl Iterator<Item = &Chord> {
        let near = self.boxes.near(Extent::between(place, place).grown(distance)).map(|i| &self.chords[i]);
        near.filter(move |chord| polyline::distance_to_segment(place, chord.ends[0], chord.ends[1]) <= distance)
    }

    /// Chords drawn by a block.
    pub(super) fn of_block(&self, block: u32) -> impl Iterator<Item = &Chord> {
        self.blocks.get(&block).into_iter().flatten().map(|&i| &self.chords[i])
    }

    /// True if any edge is closer to a point than `distance`, mm.
    pub(super) fn is_nearer(&self, place: Point, distance: f64) -> bool {
        self.boxes.near(Extent::between(place, place).grown(distance)).any(|i| {
            let [a, b] = self.chords[i].ends;
            polyline::distance_to_segment(place, a, b) < distance
        })
    }
}
