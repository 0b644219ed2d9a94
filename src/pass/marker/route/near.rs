//! Neighbouring visits, between which a tour may move.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point};

/// Number of nearest visits on either side, by distance.
const NEAR: usize = 10;
/// Greatest number of visits from which these are chosen: if more are around a place, any will do.
const MOST_AROUND: usize = 500;
/// Least search radius around a place, mm.
const LEAST_REACH: f64 = 1.0;
/// Number of neighbours kept, by time.
const NEAREST: usize = 8;

/// Visits that start near the end or end near the start of each visit, from the start and end points of all.
pub(super) fn near(ends: &[[Point; 2]]) -> Vec<Vec<u32>> {
    let boxes = |side: usize| Boxes::new(ends.iter().map(|ends| Extent::between(ends[side], ends[side])).collect());
    let (starts, stops) = (boxes(0), boxes(1));
    let mut whole = Extent::EMPTY;
    for [start, end] in ends {
        whole.join(&Extent::between(*start, *end));
    }
    let (width, height) = whole.size();
    let count = ends.len() as f64;
    let least = (width * height / count).sqrt().max(width.max(height) / count).max(LEAST_REACH);
    let nearest = |boxes: &Boxes, i: usize, at: Point| {
        let mut reach = least;
        loop {
            let around = Extent::between(at, at).grown(reach);
            let around = boxes.near(around).filter(|&k| k != i).take(MOST_AROUND);
            let mut found: Vec<u32> = around.map(|k| k as u32).collect();
            if found.len() >= NEAR || reach > width + height {
                let away = |k: &u32| (boxes.all()[*k as usize].min - at).norm();
                found.sort_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
                found.truncate(NEAR);
                return found;
            }
            reach *= 2.0;
        }
    };
    (0..ends.len())
        .map(|i| {
            let mut near = nearest(&starts, i, ends[i][1]);
            let other = nearest(&stops, i, ends[i][0]);
            near.extend(other.into_iter().filter(|k| !near.contains(k)).collect::<Vec<_>>());
            near
        })
        .collect()
}

/// Neighbouring visit, and the duration of the move between the two, s.
pub(super) type Near = (u32, f64);

/// Neighbours of each visit, the nearest in time first.
pub(super) struct Nearest {
    all: Vec<Near>,
    /// Index of the first neighbour of each visit, and the end of the last.
    starts: Vec<u32>,
}

impl Nearest {
    pub(super) fn new(near: &[Vec<u32>], time: impl Fn(usize, usize) -> f64) -> Self {
        let mut nearest = Self { all: Vec::with_capacity(near.len() * NEAREST), starts: vec![0] };
        for (visit, near) in near.iter().enumerate() {
            let mut near: Vec<Near> = near.iter().map(|&other| (other, time(visit, other as usize))).collect();
            near.sort_by(|a, b| a.1.total_cmp(&b.1));
            nearest.all.extend(near.iter().take(NEAREST));
            nearest.starts.push(nearest.all.len() as u32);
        }
        nearest
    }

    /// Neighbours of a visit.
    pub(super) fn of(&self, visit: usize) -> &[Near] {
        &self.all[self.starts[visit] as usize..self.starts[visit + 1] as usize]
    }
}
