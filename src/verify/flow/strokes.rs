//! Strokes of a head: the rows from a down command to the next up command, with the blade as it lies on the cloth.

use super::rows::Row;
use crate::geom::{Point, Rotation, Vector};
use crate::ir::verdict::Sighting;
use crate::machine::MachineProfile;
use crate::units::rad;

/// Stroke of a head.
#[derive(Debug, Clone)]
pub(super) struct Stroke {
    /// Path of the blade's leading end, mm; the first point is the trailing end at the plunge.
    pub(super) trace: Vec<Point>,
    /// Direction of the blade from the trailing to the leading end, for each point after the first.
    pub(super) along: Vec<Vector>,
    /// Place in the program of each point after the first.
    pub(super) places: Vec<Sighting>,
    /// Blocks that the rows name, ascending, without repetition.
    pub(super) blocks: Vec<u32>,
}

/// Collects the strokes of a head.
pub(super) struct Strokes {
    width: f64,
    radius: f64,
    yaw: f64,
    /// True if the blade has two edges, so that it may go heel first.
    is_double: bool,
    /// Rows of the open stroke.
    now: Vec<(Point, Vector, Sighting, u32)>,
    done: Vec<Stroke>,
}

/// Greatest move of the centre of a blade that stands still, mm.
const STILL: f64 = 1e-3;

impl Strokes {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        let knife = &profile.knife;
        let is_double = knife.edges == 2;
        let (width, radius, yaw) = (knife.width_mm, knife.radius(), knife.yaw());
        Self { width, radius, yaw, is_double, now: Vec::new(), done: Vec::new() }
    }

    /// Processes the next row.
    pub(super) fn see(&mut self, row: &Row, at: Sighting) {
        let along = Rotation(rad(row.c) - self.yaw).unit();
        if row.knife {
            self.now.push((at.point, along, at, row.block));
        } else if !self.now.is_empty() {
            // The blade comes out where it is commanded up.
            self.now.push((at.point, along, at, self.now[self.now.len() - 1].3));
            self.close();
        }
    }

    fn close(&mut self) {
        let rows = std::mem::take(&mut self.now);
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        let moved = rows.iter().map(|row| row.0 - first.0).find(|way| way.norm() > STILL);
        // A blade with one edge must go tip first; otherwise it tears the cloth and is found lying the wrong way along its
        // line.
        let is_turned = self.is_double && moved.is_some_and(|way| way.dot(&first.1) < 0.0);
        let (lead, side) = if is_turned { (self.width - self.radius, -1.0) } else { (self.radius, 1.0) };
        let along: Vec<Vector> = rows.iter().map(|row| row.1 * side).collect();
        let mut trace = vec![first.0 + along[0] * (lead - self.width)];
        trace.extend(rows.iter().zip(&along).map(|(row, along)| row.0 + along * lead));
        let mut blocks: Vec<u32> = rows.iter().map(|row| row.3).collect();
        blocks.sort_unstable();
        blocks.dedup();
        debug_assert!(last.2.line >= first.2.line, "rows come in order");
        self.done.push(Stroke { trace, along, places: rows.iter().map(|row| row.2).collect(), blocks });
    }

    /// All strokes; a stroke without a lift extends to the last row.
    pub(super) fn finish(mut self) -> Vec<Stroke> {
        if !self.now.is_empty() {
            self.close();
        }
        self.done
    }
}

impl Stroke {
    /// True if the blade never moves.
    pub(super) fn is_plunge(&self) -> bool {
        self.trace[1..].iter().all(|point| (point - self.trace[1]).norm() <= STILL)
    }
}
