//! Which head makes which chain, and when: interval scheduling with set-up times.
//!
//! Tasks are taken in the order in which they may start. Each goes to the head that is free in time and has the least way
//! to it; a new head is taken where none is. Without set-up times and with tasks that start at one time only that is
//! optimal (Kleinberg & Tardos, *Algorithm Design*, 2006, section 4.1); with them it is a heuristic, and what it gives is
//! shown beside the lower bound. It takes as few heads as it can, and leaves it to others which stand in one row.
//!
//! The other way is to give each task to a head of a row at once, one with whose neighbours it does not clash. That takes
//! more heads now and then, and fewer rows where parts lie close.

/// Something that a head has to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Task {
    /// The earliest and the latest tick at which it may start.
    pub(super) window: [i64; 2],
    /// How many ticks it takes.
    pub(super) ticks: i64,
}

/// What lies between two tasks of a head.
pub(super) trait Links {
    /// Ticks from the end of one task, which started at a tick, to the start of another one at a tick.
    fn ticks(&self, from: Start, to: Start) -> i64;
    /// How much rather another head should go there.
    fn cost(&self, from: usize, to: usize) -> f64;
    /// On which side of one task another one is while both are made: 1 above, -1 below; 0 where they come too near or pass
    /// each other, `None` where they are not made at the same time.
    fn side(&self, of: Start, other: Start) -> Option<f64>;
}

/// A task that starts at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Start {
    /// Which.
    pub task: usize,
    /// When.
    pub tick: i64,
}

/// Rounds in which the start of a task and the way to it are brought together: the later it starts, the shorter or longer
/// that is.
const ROUNDS: usize = 4;

/// Tasks, and what lies between them.
pub(super) struct Schedule<'a, L> {
    pub(super) tasks: &'a [Task],
    pub(super) links: &'a L,
}

/// A head of a row that is being filled.
#[derive(Debug, Clone)]
struct Slot {
    row: usize,
    done: Vec<Start>,
    /// On which side of each slot before it this one has been, as [`Links::side`] tells; 0 = of none yet.
    sides: Vec<f64>,
}

impl<L: Links> Schedule<'_, L> {
    /// The tasks of each head, in order.
    pub(super) fn heads(&self) -> Vec<Vec<Start>> {
        let mut heads: Vec<Vec<Start>> = Vec::new();
        for task in self.order() {
            let lasts = heads.iter().map(|done| done.last());
            let found = self.nearest(lasts, task).into_iter().find_map(|head| {
                let start = self.start(*heads[head].last()?, task)?;
                Some((head, start))
            });
            match found {
                Some((head, start)) => heads[head].push(start),
                None => heads.push(vec![self.earliest(task)]),
            }
        }
        heads
    }

    /// The row and the tasks of each head, in order, where tasks go to rows in which they clash with none.
    pub(super) fn heads_in_rows(&self) -> Vec<(usize, Vec<Start>)> {
        let mut slots: Vec<Slot> = Vec::new();
        for task in self.order() {
            let lasts = slots.iter().map(|slot| slot.done.last());
            let found = self.nearest(lasts, task).into_iter().find_map(|head| {
                let start = self.start(*slots[head].done.last()?, task)?;
                Some((head, start, self.sides(&slots, head, start)?))
            });
            let (head, start, sides) = found.unwrap_or_else(|| {
                let start = self.earliest(task);
                let rows = slots.iter().map(|slot| slot.row + 1).max().unwrap_or(0);
                let head = slots.len();
                slots.push(Slot { row: rows, done: Vec::new(), sides: vec![0.0; head] });
                for row in 0..rows {
                    slots[head].row = row;
                    if let Some(sides) = self.sides(&slots, head, start) {
                        return (head, start, sides);
                    }
                }
                slots[head].row = rows;
                (head, start, Vec::new())
            });
            slots[head].done.push(start);
            for (mate, side) in sides {
                let [low, high] = [head.min(mate), head.max(mate)];
                slots[high].sides[low] = if head > mate { side } else { -side };
            }
        }
        slots.into_iter().map(|slot| (slot.row, slot.done)).collect()
    }

    /// All tasks, in the order in which they may start.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.tasks.len()).collect();
        order.sort_by_key(|&i| (self.tasks[i].window[0], self.tasks[i].window[1], i));
        order
    }

    /// Heads by their last tasks, the one first that has the least way to another.
    fn nearest<'s>(&self, lasts: impl Iterator<Item = Option<&'s Start>>, task: usize) -> Vec<usize> {
        let cost = |(head, last): (usize, Option<&Start>)| Some((self.links.cost(last?.task, task), head));
        let mut heads: Vec<(f64, usize)> = lasts.enumerate().filter_map(cost).collect();
        heads.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        heads.into_iter().map(|(_, head)| head).collect()
    }

    fn earliest(&self, task: usize) -> Start {
        Start { task, tick: self.tasks[task].window[0] }
    }

    /// When a head that made one task can start another one; `None` when that is too late.
    fn start(&self, last: Start, task: usize) -> Option<Start> {
        let end = last.tick + self.tasks[last.task].ticks;
        let [earliest, latest] = self.tasks[task].window;
        let mut tick = earliest;
        for _ in 0..ROUNDS {
            let ready = end + self.links.ticks(last, Start { task, tick });
            if ready <= tick {
                return Some(Start { task, tick });
            }
            tick = ready;
            if tick > latest {
                return None;
            }
        }
        None
    }

    /// The sides of the other heads of its row on which a head is that makes a task, of those that it meets; `None` where it
    /// comes too near to one, or would pass it.
    fn sides(&self, slots: &[Slot], head: usize, start: Start) -> Option<Vec<(usize, f64)>> {
        let mut met = Vec::new();
        let row = slots[head].row;
        for (mate, slot) in slots.iter().enumerate().filter(|(mate, slot)| *mate != head && slot.row == row) {
            let Some(side) = self.side_of(start, &slot.done) else { continue };
            let before = if head > mate { slots[head].sides[mate] } else { -slot.sides[head] };
            if side == 0.0 || before * side < 0.0 {
                return None;
            }
            met.push((mate, side));
        }
        Some(met)
    }

    /// On which side of a task those of another head are that are made at the same time; 0 where any comes too near.
    fn side_of(&self, start: Start, done: &[Start]) -> Option<f64> {
        let is_late = |other: &&Start| other.tick + self.tasks[other.task].ticks >= start.tick;
        let sides = done.iter().rev().take_while(is_late).filter_map(|&other| self.links.side(start, other));
        sides.reduce(|a, b| if a * b > 0.0 { a } else { 0.0 })
    }
}
