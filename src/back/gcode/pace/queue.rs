//! Blocks of a planner with a look-ahead since the last rest, and the time that each limit has cost so far.

use super::buffer::{Block, Supply, durations};
use super::planner::{sorted, spend};
use crate::back::target::{Limit, Spent};
use crate::machine::gcode::Gcode;

/// Blocks since the last rest.
#[derive(Debug)]
pub(super) struct Queue {
    /// Number of blocks that the planner holds, with the running one.
    room: usize,
    /// Least time between two lines, s.
    gap: f64,
    pub(super) blocks: Vec<Block>,
    /// Limit of the speed and of the acceleration of each block.
    limits: Vec<[Limit; 2]>,
    spent: Vec<(Limit, f64)>,
}

impl Queue {
    pub(super) fn new(keys: &Gcode) -> Self {
        let gap = keys.max_blocks_s.map_or(0.0, f64::recip);
        Self { room: keys.planner_blocks as usize, gap, blocks: Vec::new(), limits: Vec::new(), spent: Vec::new() }
    }

    /// Adds a block with the limits of its speed and of its acceleration.
    pub(super) fn push(&mut self, block: Block, limits: [Limit; 2]) {
        self.blocks.push(block);
        self.limits.push(limits);
    }

    /// Brings the axes to rest.
    pub(super) fn stop(&mut self) {
        let Self { room, gap, .. } = *self;
        let free = durations(&self.blocks, Supply::UNLIMITED);
        let [fed, supplied] = [0.0, gap].map(|gap| durations(&self.blocks, Supply { room, gap }).iter().sum::<f64>());
        let blocks = std::mem::take(&mut self.blocks);
        let limits = std::mem::take(&mut self.limits);
        for ((block, [speed, ramp]), time) in blocks.iter().zip(limits).zip(&free) {
            let level = block.length / block.speed;
            self.spend(speed, level);
            self.spend(ramp, time - level);
        }
        self.spend(Limit::LookAhead, fed - free.iter().sum::<f64>());
        self.spend(Limit::Late, supplied - fed);
    }

    pub(super) fn spend(&mut self, limit: Limit, time: f64) {
        spend(&mut self.spent, limit, time);
    }

    /// Brings the axes to rest, waits for a time, s, and goes on.
    pub(super) fn wait(&mut self, time: f64) {
        self.stop();
        self.spend(Limit::Rest, time);
    }

    /// Brings the axes to rest and returns the time since the start.
    pub(super) fn finish(&mut self) -> Spent {
        self.stop();
        let limits = sorted(std::mem::take(&mut self.spent));
        Spent { time: limits.iter().map(|(_, time)| time).sum(), limits }
    }
}
