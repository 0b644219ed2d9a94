//! Joints of different cuts: places where the cuts meet in the drawing, and where the cut paths must meet, too.

use rayon::prelude::*;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::reference::common::Joint;

/// Cut paths around joints.
#[derive(Debug)]
pub(in crate::verify) struct Joints<'a> {
    all: &'a [Joint],
    /// Boxes of all joints; the boxes of one joint are adjacent.
    boxes: Boxes,
    /// Index of the joint of each box.
    joint_of: Vec<usize>,
    /// Paths through each box.
    ways: Vec<Vec<Way>>,
    /// True for each joint whose cuts are known to cross.
    is_met: Vec<bool>,
}

/// Part of a path that a blade cuts.
#[derive(Debug)]
struct Way {
    /// Cut of the marker that the path belongs to.
    cut: u32,
    points: Vec<Point>,
}

impl<'a> Joints<'a> {
    /// Joints before any path.
    pub(in crate::verify) fn new(joints: &'a [Joint]) -> Self {
        Self {
            all: joints,
            boxes: Boxes::new(joints.iter().flat_map(|joint| joint.about.iter().copied()).collect()),
            joint_of: joints.iter().enumerate().flat_map(|(i, joint)| joint.about.iter().map(move |_| i)).collect(),
            ways: joints.iter().flat_map(|joint| &joint.about).map(|_| Vec::new()).collect(),
            is_met: vec![false; joints.len()],
        }
    }

    /// Adds the points that a stroke cuts, as part of a cut of the marker.
    pub(in crate::verify) fn see(&mut self, points: &[Point], cut: u32) {
        if self.all.is_empty() {
            return;
        }
        for place in self.boxes.near(Extent::of(points)).collect::<Vec<_>>() {
            let joint = self.joint_of[place];
            if self.is_met[joint] {
                continue;
            }
            let known = &mut self.ways[place];
            let before = known.len();
            known.extend(ways(points, cut, self.boxes.all()[place]));
            let crosses =
                |way: &Way| known.iter().any(|other| self.all[joint].is_of([way, other]) && way.crosses(other));
            self.is_met[joint] = known[before..].iter().any(crosses);
        }
    }

    /// Records the width of the uncut thread at each joint.
    pub(super) fn see_gaps(&self, worst: &mut Worst) {
        let firsts = self.all.iter().scan(0, |next, joint| Some(std::mem::replace(next, *next + joint.about.len())));
        let joints = self.all.iter().zip(firsts).zip(&self.is_met);
        let open: Vec<(&'a Joint, usize)> = joints.filter(|(_, is_met)| !**is_met).map(|(joint, _)| joint).collect();
        let least = |&(joint, first): &(&'a Joint, usize)| -> (&'a Joint, f64) {
            let ways: Vec<&Way> = self.ways[first..first + joint.about.len()].iter().flatten().collect();
            (joint, gap(joint, &ways))
        };
        for (joint, gap) in open.par_iter().map(least).collect::<Vec<_>>() {
            worst.see(gap, || Sighting::missing(joint.at, joint.block));
        }
    }
}

impl Joint {
    /// True if two paths belong to the two cuts of the joint.
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

/// Parts of a path inside a box.
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

/// Widest gap on the best route from one cut of a joint to the other over all paths in its boxes, mm.
fn gap(joint: &Joint, ways: &[&Way]) -> f64 {
    let [from, to] = joint.cuts;
    // If a cut is missing, the gap is as wide as the box around the place.
    let (width, height) = joint.about[0].size();
    let most = width.hypot(height);
    let mut least: Vec<f64> = ways.iter().map(|way| if way.cut == from { 0.0 } else { most }).collect();
    let mut is_done = vec![false; ways.len()];
    // As in Dijkstra's algorithm, the path with the smallest gap is final.
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

/// Upper bound on the distance of two paths, mm: the distance of their first points.
pub(super) fn most_apart(one: &[Point], other: &[Point]) -> f64 {
    (other[0] - one[0]).norm()
}

/// Distance of two paths, mm; exact if it is less than `limit`, otherwise `limit`.
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
