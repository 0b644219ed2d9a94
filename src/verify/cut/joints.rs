//! Joints of different cuts: where the drawing has them meet, whether the blade's own ways do.

use rayon::prelude::*;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::reference::common::Joint;

/// The blade's ways about joints.
#[derive(Debug)]
pub(in crate::verify) struct Joints<'a> {
    all: &'a [Joint],
    /// Where their cuts must cross, the boxes of one joint after those of the other.
    boxes: Boxes,
    /// The joint of each box, by its place among all.
    of: Vec<usize>,
    /// The ways that come by each joint; `None` once its cuts are known to cross.
    ways: Vec<Option<Vec<Way>>>,
}

/// A part of a way that a blade cuts.
#[derive(Debug)]
struct Way {
    /// The cut that it is of.
    cut: u32,
    points: Vec<Point>,
}

impl<'a> Joints<'a> {
    /// Joints with no way seen yet.
    pub(in crate::verify) fn new(joints: &'a [Joint]) -> Self {
        Self {
            all: joints,
            boxes: Boxes::new(joints.iter().flat_map(|joint| joint.about.iter().copied()).collect()),
            of: joints.iter().enumerate().flat_map(|(i, joint)| joint.about.iter().map(move |_| i)).collect(),
            ways: joints.iter().map(|_| Some(Vec::new())).collect(),
        }
    }

    /// Sees what a stroke cuts, as a stretch of a cut of the marker.
    pub(in crate::verify) fn see(&mut self, points: &[Point], cut: u32) {
        if self.all.is_empty() {
            return;
        }
        for place in self.boxes.near(Extent::of(points)).collect::<Vec<_>>() {
            let i = self.of[place];
            let Some(known) = &mut self.ways[i] else { continue };
            let before = known.len();
            known.extend(ways(points, cut, self.boxes.all()[place]));
            let crosses = |way: &Way| known.iter().any(|other| self.all[i].is_of([way, other]) && way.crosses(other));
            if known[before..].iter().any(crosses) {
                self.ways[i] = None;
            }
        }
    }

    /// Sees how wide a thread is left at each joint.
    pub(super) fn see_gaps(&self, worst: &mut Worst) {
        let open = self.all.par_iter().zip(&self.ways).filter_map(|(joint, ways)| Some((joint, ways.as_ref()?)));
        let gaps: Vec<(&Joint, f64)> = open.map(|(joint, ways)| (joint, gap(joint, ways))).collect();
        for (joint, gap) in gaps {
            worst.see(gap, || Sighting::missing(joint.at, joint.block));
        }
    }
}

impl Joint {
    /// Whether two ways are of its two cuts.
    fn is_of(&self, ways: [&Way; 2]) -> bool {
        let cuts = ways.map(|way| way.cut);
        cuts == self.cuts || cuts == [self.cuts[1], self.cuts[0]]
    }
}

impl Way {
    fn crosses(&self, other: &Self) -> bool {
        apart(&self.points, &other.points, f64::MIN_POSITIVE) == 0.0
    }
}

/// The parts of a way that lie in a box.
fn ways(points: &[Point], cut: u32, about: Extent) -> Vec<Way> {
    let mut found = Vec::new();
    let mut way: Vec<Point> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = about.clip([ends[0], ends[1]]) else { continue };
        if way.last() != Some(&from) {
            let before = std::mem::replace(&mut way, vec![from]);
            found.extend((before.len() > 1).then_some(Way { cut, points: before }));
        }
        way.push(to);
    }
    found.extend((way.len() > 1).then_some(Way { cut, points: way }));
    found
}

/// How wide the widest gap is on the best way from the one cut of a joint to the other over all that is cut about it, mm.
fn gap(joint: &Joint, ways: &[Way]) -> f64 {
    let [from, to] = joint.cuts;
    // What is not there at all is as far away as can be.
    let (width, height) = joint.about[0].size();
    let most = width.hypot(height);
    let mut least: Vec<f64> = ways.iter().map(|way| if way.cut == from { 0.0 } else { most }).collect();
    let mut is_done = vec![false; ways.len()];
    // The way that is reached over the narrowest gap is final, as in Dijkstra's search.
    while let Some(next) = (0..ways.len()).filter(|&i| !is_done[i]).min_by(|&a, &b| least[a].total_cmp(&least[b])) {
        if ways[next].cut == to {
            return least[next];
        }
        is_done[next] = true;
        for other in (0..ways.len()).filter(|&i| !is_done[i]).collect::<Vec<_>>() {
            if least[other] > least[next] {
                let apart = apart(&ways[next].points, &ways[other].points, least[other]);
                least[other] = least[other].min(apart.max(least[next]));
            }
        }
    }
    most
}

/// Greatest distance that two ways can have, mm: that of their first points.
pub(super) fn most_apart(one: &[Point], other: &[Point]) -> f64 {
    (other[0] - one[0]).norm()
}

/// Distance of two ways, mm, surely where that is less than `limit`.
pub(super) fn apart(one: &[Point], other: &[Point], limit: f64) -> f64 {
    let mut least = limit;
    for a in one.windows(2) {
        let extent = Extent::between(a[0], a[1]).grown(least);
        for b in other.windows(2).filter(|b| Extent::between(b[0], b[1]).meets(&extent)) {
            least = least.min(polyline::distance_of_segments([a[0], a[1]], [b[0], b[1]]));
            if least == 0.0 {
                return 0.0;
            }
        }
    }
    least
}
