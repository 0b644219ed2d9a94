//! Motion of blocks through a planner that sees a few of them at once.
//!
//! Blocks are straight moves with one acceleration each, so that the speed along them is a trapezoid. The planner knows the
//! running block and the waiting ones, and must be able to stop at the end of the last one. It plans again whenever a block
//! arrives, also amid a block. Blocks arrive one by one as soon as there is room.

/// A straight move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// Length.
    pub(super) length: f64,
    /// Greatest speed along it, per s.
    pub(super) speed: f64,
    /// Acceleration along it, per s2.
    pub(super) acceleration: f64,
    /// Square of the greatest speed at its start.
    pub(super) entry: f64,
    /// True if it is a line of the program, or the first block of one.
    pub(super) is_line: bool,
}

impl Block {
    /// Square of the speed that is reached over a length from the square of another one.
    fn reach(&self, square: f64, length: f64) -> f64 {
        square + 2.0 * self.acceleration * length
    }
}

/// The supply of blocks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Supply {
    /// Number of blocks that the planner holds, with the running one.
    pub(super) room: usize,
    /// Least time between two lines of the program, s.
    pub(super) gap: f64,
}

impl Supply {
    /// A planner that knows all blocks from the start.
    pub(super) const UNLIMITED: Self = Self { room: usize::MAX, gap: 0.0 };
}

/// Blocks that have arrived.
struct Queue<'a> {
    blocks: &'a [Block],
    /// Square of the speed at the start of each, so that the axes can stop at the end of the last one.
    entries: Vec<f64>,
    /// Number of them.
    arrived: usize,
    /// Arrival of the last one, s.
    last: f64,
}

impl Queue<'_> {
    /// Takes the blocks that arrive until a time, and returns the arrival of the next one, s; infinite if none can come before
    /// the running block ends. `open` is the start of that block, which left room for one more.
    fn take(&mut self, running: usize, supply: Supply, [open, now]: [f64; 2]) -> f64 {
        let known = self.arrived;
        let due = loop {
            let due = self.due(running, supply).max(open);
            if due > now {
                break due;
            }
            self.last = due;
            self.arrived += 1;
        };
        if self.arrived > known {
            self.plan(running, known);
        }
        due
    }

    /// Arrival of the next block, s, if there was room all the time.
    fn due(&self, running: usize, supply: Supply) -> f64 {
        match self.blocks.get(self.arrived) {
            Some(block) if self.arrived - running < supply.room => {
                let gap = if block.is_line && self.arrived > 0 { supply.gap } else { 0.0 };
                self.last + gap
            }
            Some(_) | None => f64::INFINITY,
        }
    }

    /// Plans the entry speeds behind a running block, where the first ones were known. More blocks make no entry slower, so
    /// entries in front of one that stays are final.
    fn plan(&mut self, running: usize, known: usize) {
        let mut exit = 0.0;
        for i in (running + 1..self.arrived).rev() {
            let block = &self.blocks[i];
            let entry = block.entry.min(block.reach(exit, block.length));
            if i < known && entry <= self.entries[i] {
                break;
            }
            self.entries[i] = entry;
            exit = entry;
        }
    }
}

/// Speeds over time along the rest of a block: a ramp, a constant speed, a ramp.
struct Trapezoid {
    /// Speeds at the start, between the ramps and at the end, per s.
    speeds: [f64; 3],
    /// Acceleration of the ramps, per s2.
    acceleration: f64,
    /// Time between the ramps, s.
    cruise: f64,
}

impl Trapezoid {
    fn new(block: &Block, left: f64, from: f64, to: f64) -> Self {
        let acceleration = block.acceleration;
        let reached = (0.5 * (from * from + to * to) + acceleration * left).sqrt();
        let top = reached.min(block.speed).max(from).max(to);
        let ramps = (2.0 * top * top - from * from - to * to) / (2.0 * acceleration);
        // A block that ends just as the axes stand has nothing left.
        let cruise = if top > 0.0 { (left - ramps).max(0.0) / top } else { 0.0 };
        Self { speeds: [from, top, to], acceleration, cruise }
    }

    fn ramp(&self, end: usize) -> f64 {
        (self.speeds[1] - self.speeds[end]) / self.acceleration
    }

    fn time(&self) -> f64 {
        self.ramp(0) + self.cruise + self.ramp(2)
    }

    /// Distance and speed after a time.
    fn after(&self, time: f64) -> (f64, f64) {
        let [from, top, to] = self.speeds;
        let up = time.min(self.ramp(0));
        let level = (time - self.ramp(0)).clamp(0.0, self.cruise);
        let down = (time - self.ramp(0) - self.cruise).max(0.0);
        let speed = if down > 0.0 { (top - self.acceleration * down).max(to) } else { from + self.acceleration * up };
        let ramps = (from + 0.5 * self.acceleration * up) * up + (top - 0.5 * self.acceleration * down) * down;
        (ramps + level * top, speed)
    }
}

/// Duration of each of some blocks, from rest to rest, s, with the time that the axes wait for it.
pub(super) fn durations(blocks: &[Block], supply: Supply) -> Vec<f64> {
    let mut queue = Queue { blocks, entries: vec![0.0; blocks.len()], arrived: 0, last: 0.0 };
    let (mut now, mut speed) = (0.0_f64, 0.0_f64);
    let run = |(i, block): (usize, &Block)| {
        let open = now;
        if queue.arrived <= i {
            now = now.max(queue.due(i, supply));
        }
        let mut left = block.length;
        loop {
            let due = queue.take(i, supply, [open, now]);
            let reach = block.reach(speed * speed, left);
            let slowest = (2.0 * speed * speed - reach).max(0.0);
            let exit = if i + 1 < queue.arrived { queue.entries[i + 1] } else { 0.0 };
            let exit = exit.min(reach).max(slowest).sqrt();
            let trapezoid = Trapezoid::new(block, left, speed, exit);
            let end = now + trapezoid.time();
            if due >= end {
                (now, speed) = (end, exit);
                break now - open;
            }
            let (way, reached) = trapezoid.after(due - now);
            (left, speed, now) = ((left - way).max(0.0), reached, due);
        }
    };
    blocks.iter().enumerate().map(run).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(length: f64, speed: f64, acceleration: f64) -> Block {
        Block { length, speed, acceleration, entry: speed * speed, is_line: true }
    }

    fn total(blocks: &[Block], room: usize, gap: f64) -> f64 {
        durations(blocks, Supply { room, gap }).iter().sum()
    }

    /// Blocks of any length and kink, some as slow as a crawl.
    fn random(random: &mut fastrand::Rng) -> Vec<Block> {
        let mut number = |least: f64, most: f64| least * (most / least).powf(random.f64());
        let mut before = 0.0;
        let blocks = (0..200).map(|_| {
            let (length, speed) = (number(0.01, 20.0), number(1.0, 400.0));
            let entry = number(0.1, 2.0) * f64::min(before, speed * speed);
            let entry = entry.min(before).min(speed * speed);
            before = speed * speed;
            Block { entry, ..block(length, speed, number(200.0, 8000.0)) }
        });
        blocks.collect()
    }

    #[test]
    fn a_lone_block_is_a_trapezoid() {
        let check = |length: f64, expected: f64| {
            let time = total(&[block(length, 100.0, 1000.0)], 15, 0.0);
            assert!((time - expected).abs() < 1e-9, "{time} {expected}");
        };
        check(30.0, 30.0 / 100.0 + 100.0 / 1000.0);
        // It never reaches its speed.
        check(2.5, 2.0 * (2.5_f64 / 1000.0).sqrt());
    }

    #[test]
    fn blocks_without_a_kink_are_one_block() {
        let whole = total(&[block(30.0, 100.0, 1000.0)], 2, 0.0);
        for lengths in [[10.0, 20.0], [29.0, 1.0], [15.0, 15.0]] {
            let parts = total(&lengths.map(|length| block(length, 100.0, 1000.0)), 2, 0.0);
            // A stop at the end of the first part is planned until the second part has arrived.
            assert!((parts - whole).abs() < 1e-9, "{lengths:?}: {parts} {whole}");
        }
    }

    #[test]
    fn a_planner_of_one_block_stops_after_each() {
        let parts = [block(10.0, 100.0, 1000.0), block(20.0, 50.0, 500.0)];
        let alone: f64 = parts.iter().map(|part| total(&[*part], 1, 0.0)).sum();
        assert!((total(&parts, 1, 0.0) - alone).abs() < 1e-9);
    }

    #[test]
    fn short_blocks_are_as_fast_as_the_planner_can_still_stop_in_those_that_it_holds() {
        let (length, acceleration) = (0.1, 4000.0);
        let blocks = vec![block(length, 500.0, acceleration); 300];
        for room in [2, 8, 15, 35] {
            let square = 2.0 * acceleration * (room - 1) as f64 * length;
            let top = (square + acceleration * length).sqrt();
            let expected = 2.0 * (top - square.sqrt()) / acceleration;
            let time = durations(&blocks, Supply { room, gap: 0.0 })[150];
            assert!((time - expected).abs() < 1e-9, "{room}: {time} {expected}");
        }
    }

    #[test]
    fn more_look_ahead_and_a_faster_supply_take_no_longer_and_no_block_beats_its_speed() {
        let mut seeded = fastrand::Rng::with_seed(11);
        for _ in 0..40 {
            let blocks = random(&mut seeded);
            let mut last = f64::INFINITY;
            for (room, gap) in [(2, 0.05), (5, 0.05), (5, 0.01), (5, 0.0), (6, 0.0), (20, 0.0), (90, 0.0), (300, 0.0)] {
                let time = total(&blocks, room, gap);
                assert!(time <= last + 1e-9, "{room} {gap}: {time} {last}");
                last = time;
            }
            for (time, block) in durations(&blocks, Supply::UNLIMITED).iter().zip(&blocks) {
                assert!(*time >= block.length / block.speed - 1e-12, "{time} {block:?}");
            }
        }
    }

    #[test]
    fn blocks_that_arrive_late_stop_the_axes_in_between() {
        let blocks = vec![block(1.0, 100.0, 8000.0); 20];
        let alone = total(&blocks[..1], 15, 0.0);
        let gap = 0.5;
        assert!((total(&blocks, 15, gap) - (19.0 * gap + alone)).abs() < 1e-9);
        // Blocks of one line arrive together.
        let chords: Vec<Block> = (0..20).map(|i| Block { is_line: i == 0, ..blocks[0] }).collect();
        assert!((total(&chords, 15, gap) - total(&blocks, 15, 0.0)).abs() < 1e-9);
    }
}
