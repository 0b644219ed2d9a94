//! Facing edges of two parts: near enough to merge, with the parts on opposite sides.

use super::ring::Ring;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, cross, polyline};

/// Least cosine of the angle between two facing edges (30 degrees): edges not much longer than the rounding have no direction.
const LEAST_COSINE: f64 = 0.866;
/// Tangent of the greatest angle between them that rounding does not explain (2 degrees).
const MOST_SLOPE: f64 = 0.035;
/// Length below which a stretch counts as empty, mm: rounding.
const LEAST: f64 = 1e-6;

/// Cost of two facing segments besides the comparison of their boxes: they are stored.
const HIT: usize = 200;

/// Stretch of a ring beside a stretch of another, both straight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facing {
    /// Stations on its own ring, mm.
    pub(super) own: [f64; 2],
    /// Index of the other ring.
    pub(super) other: usize,
    /// Stations on the other ring, beside those on its own, mm.
    pub(super) theirs: [f64; 2],
    /// Distances between both at its ends, mm.
    pub(super) apart: [f64; 2],
}

impl Facing {
    /// Part between two shares of its length.
    pub(super) fn part(&self, [from, to]: [f64; 2]) -> Self {
        let between = |ends: [f64; 2]| [from, to].map(|share| ends[0] + (ends[1] - ends[0]) * share);
        Self { own: between(self.own), theirs: between(self.theirs), apart: between(self.apart), ..*self }
    }

    /// Share of its length before a station of its own ring.
    fn share(&self, station: f64) -> f64 {
        (station - self.own[0]) / self.length()
    }

    /// Distance between both at a station of its own ring, mm.
    fn apart_at(&self, station: f64) -> f64 {
        self.apart[0] + (self.apart[1] - self.apart[0]) * self.share(station)
    }

    /// Length on its own ring, mm.
    pub(super) fn length(&self) -> f64 {
        self.own[1] - self.own[0]
    }
}

/// Criteria for facing edges.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Greatest distance of two edges, mm: the merge tolerance.
    pub(super) distance: f64,
    /// Displacement of either end by rounding, mm.
    pub(super) slack: f64,
}

/// Spatial index of the segments of rings.
#[derive(Debug)]
pub(super) struct Segments {
    boxes: Boxes,
    /// Index of the ring and of the segment on it, for each box.
    of: Vec<[u32; 2]>,
}

impl Segments {
    /// Indexes the segments of all rings.
    pub(super) fn new(rings: &[Ring]) -> Self {
        let of_ring = |i: usize| (0..rings[i].segments().len()).map(move |k| [i, k].map(|place| place as u32));
        let of: Vec<[u32; 2]> = (0..rings.len()).flat_map(of_ring).collect();
        let extents = of.iter().map(|&of| {
            let [from, to] = ends(rings, of);
            Extent::between(from, to)
        });
        Self { boxes: Boxes::new(extents.collect()), of }
    }

    /// Segments whose boxes meet a box: index of the ring, index of the segment on it, and its ends.
    pub(super) fn near<'a>(
        &'a self,
        rings: &'a [Ring],
        extent: Extent,
    ) -> impl Iterator<Item = ([usize; 2], [Point; 2])> + 'a {
        self.boxes.near(extent).map(move |i| (self.of[i].map(|place| place as usize), ends(rings, self.of[i])))
    }

    /// Facing stretches of each ring, by station; `None` if the budget is spent.
    pub(super) fn facing(&self, rings: &[Ring], near: Near, work: &mut Budget) -> Option<Vec<Vec<Facing>>> {
        let mut found = vec![Vec::new(); rings.len()];
        for (i, &[ring, segment]) in self.of.iter().enumerate() {
            let around = self.boxes.all()[i].grown(near.distance);
            if !work.spend(self.boxes.cost_near(&around)) {
                return None;
            }
            let [own_ring, own_segment] = [ring, segment].map(|place| place as usize);
            for k in self.boxes.near_from(i + 1, around) {
                let [other, place] = self.of[k].map(|place| place as usize);
                if !may_share(&rings[own_ring], &rings[other]) {
                    continue;
                }
                let is_same_way = rings[own_ring].is_part_left == rings[other].is_part_left;
                let both = [[ring, segment], self.of[k]].map(|of| ends(rings, of));
                let Some((own, theirs, apart)) = beside(both, is_same_way, near) else { continue };
                if !work.spend(HIT) {
                    return None;
                }
                let own = own.map(|station| station + rings[own_ring].station(own_segment));
                let theirs = theirs.map(|station| station + rings[other].station(place));
                found[own_ring].push(Facing { own, other, theirs, apart });
                let turned = theirs[1] < theirs[0];
                let [own, theirs, apart] = [own, theirs, apart].map(|[a, b]| if turned { [b, a] } else { [a, b] });
                found[other].push(Facing { own: theirs, other: own_ring, theirs: own, apart });
            }
        }
        let mut nearest = Vec::with_capacity(found.len());
        for mut facing in found {
            facing.sort_by(|a, b| a.own[0].total_cmp(&b.own[0]).then(a.other.cmp(&b.other)));
            nearest.push(nearest_of(&facing, near.slack, work)?);
        }
        Some(nearest)
    }
}

/// True if two rings may share an edge: they bound two parts that are on the table at the same time.
fn may_share(one: &Ring, other: &Ring) -> bool {
    one.part != other.part && one.advances == other.advances
}

/// Facing stretches of a ring, in order, without those behind a nearer one: a narrow part between two others has both edges,
/// and these do not share one. `None` if the budget is spent.
fn nearest_of(facing: &[Facing], slack: f64, work: &mut Budget) -> Option<Vec<Facing>> {
    let mut behind: Vec<Vec<[f64; 2]>> = vec![Vec::new(); facing.len()];
    let mut open: Vec<usize> = Vec::new();
    for (i, part) in facing.iter().enumerate() {
        open.retain(|&before| facing[before].own[1] > part.own[0]);
        if !work.spend(open.len()) {
            return None;
        }
        for &before in &open {
            let both = [part.own[0], part.own[1].min(facing[before].own[1])];
            let [own, other] = [part, &facing[before]].map(|part| part.apart_at(f64::midpoint(both[0], both[1])));
            if (own - other).abs() > slack {
                behind[if own > other { i } else { before }].push(both);
            }
        }
        open.push(i);
    }
    let kept = facing.iter().zip(behind).flat_map(|(part, behind)| {
        let shares = behind.into_iter().map(|ends| ends.map(|station| part.share(station)));
        without([0.0, 1.0], shares).into_iter().map(|shares| part.part(shares))
    });
    Some(kept.collect())
}

/// Rest of a stretch without some others.
pub(super) fn without(whole: [f64; 2], gone: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    gone.fold(vec![whole], |left, [from, to]| {
        let parts = left.iter().flat_map(|&[low, high]| [[low, high.min(from)], [low.max(to), high]]);
        parts.filter(|[low, high]| low < high).collect()
    })
}

/// Ends of a segment.
fn ends(rings: &[Ring], [ring, segment]: [u32; 2]) -> [Point; 2] {
    let segment = rings[ring as usize].segments()[segment as usize];
    [segment.from, segment.to]
}

/// Stations from the start of a segment, those of another beside them, and the distances between both.
type Beside = ([f64; 2], [f64; 2], [f64; 2]);

/// Stretch of a segment beside another. `is_same_way` is true if their rings run the same way round their parts, so that facing
/// edges run opposite ways.
fn beside([own, other]: [[Point; 2]; 2], is_same_way: bool, near: Near) -> Option<Beside> {
    let along = polyline::direction(own[0], own[1])?;
    let direction = polyline::direction(other[0], other[1])?;
    let cosine = along.dot(&direction);
    if (if is_same_way { -cosine } else { cosine }) < LEAST_COSINE {
        return None;
    }
    let lengths = [own, other].map(|ends| (ends[1] - ends[0]).norm());
    let at = other.map(|point| (point - own[0]).dot(&along));
    let away = other.map(|point| cross(along, point - own[0]));
    let slope = (away[1] - away[0]) / (at[1] - at[0]);
    let away_at = |station: f64| away[0] + slope * (station - at[0]);
    let (mut low, mut high) = (at[0].min(at[1]).max(0.0), at[0].max(at[1]).min(lengths[0]));
    if slope != 0.0 {
        let near = [-near.distance, near.distance].map(|limit| at[0] + (limit - away[0]) / slope);
        (low, high) = (low.max(near[0].min(near[1])), high.min(near[0].max(near[1])));
    } else if away[0].abs() > near.distance {
        return None;
    }
    let apart = [low, high].map(away_at);
    if high - low <= LEAST || (apart[1] - apart[0]).abs() > MOST_SLOPE * (high - low) + 2.0 * near.slack {
        return None;
    }
    let theirs = [low, high].map(|station| (station - at[0]) / (at[1] - at[0]) * lengths[1]);
    Some(([low, high], theirs, apart.map(f64::abs)))
}
