//! Assignment of chains to heads and start times: interval scheduling with set-up times.
//!
//! Tasks are taken in the order of their earliest starts. Each goes to the nearest head that is free in time, or to a new head.
//! Without set-up times and with fixed start times this is optimal (Kleinberg & Tardos, *Algorithm Design*, 2006, section 4.1);
//! otherwise it is a heuristic, and its result is reported beside the lower bound. It uses as few heads as it can and leaves
//! the rows to a later step.
//!
//! The alternative assigns each task at once to a head of a row, provided that it does not clash with the neighbours in that
//! row. This sometimes takes more heads, but fewer rows where parts lie close.

/// A task of a head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Task {
    /// Earliest and latest tick of the start.
    pub(super) window: [i64; 2],
    /// Duration in ticks.
    pub(super) ticks: i64,
}

/// Set-up times and conflicts between tasks.
pub(super) trait Links {
    /// Minimum ticks from the end of one task to the start of another, given the ticks at which both start.
    fn ticks(&self, from: Start, to: Start) -> i64;
    /// Cost of giving a head task `to` after task `from`. The head with the lowest cost is preferred.
    fn cost(&self, from: usize, to: usize) -> f64;
    /// Side of one task on which another lies while both are made: 1 above, -1 below, 0 if they come too near or pass each
    /// other; `None` if they are not made at the same time.
    fn side(&self, of: Start, other: Start) -> Option<f64>;
}

/// A task with its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Start {
    /// Index of the task.
    pub task: usize,
    /// Tick of the start.
    pub tick: i64,
}

/// Maximum number of iterations to find a start. The set-up time depends on the start, and the start on the set-up time.
const ROUNDS: usize = 4;

/// A set of tasks and the links between them.
pub(super) struct Schedule<'a, L> {
    pub(super) tasks: &'a [Task],
    pub(super) links: &'a L,
}

/// A head of a row to which tasks are being assigned.
#[derive(Debug, Clone)]
struct Slot {
    row: usize,
    done: Vec<Start>,
    /// Side of this slot on which each earlier one has been, as in [`Links::side`]; 0 if they have not met yet.
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

    /// The row and the tasks of each head, in order. No task clashes with another task of its row.
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

    /// Indices of all tasks, in the order of their earliest starts.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.tasks.len()).collect();
        order.sort_by_key(|&i| (self.tasks[i].window[0], self.tasks[i].window[1], i));
        order
    }

    /// Heads by increasing cost of the task after their last one.
    fn nearest<'s>(&self, lasts: impl Iterator<Item = Option<&'s Start>>, task: usize) -> Vec<usize> {
        let cost = |(head, last): (usize, Option<&Start>)| Some((self.links.cost(last?.task, task), head));
        let mut heads: Vec<(f64, usize)> = lasts.enumerate().filter_map(cost).collect();
        heads.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        heads.into_iter().map(|(_, head)| head).collect()
    }

    fn earliest(&self, task: usize) -> Start {
        Start { task, tick: self.tasks[task].window[0] }
    }

    /// Earliest start of a task by a head that made another one last; `None` if that is too late.
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

    /// The heads of the row that a head meets during a task, each with its side of that head. `None` if one comes too near or
    /// would be passed.
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

    /// Side of a task on which the simultaneous tasks of another head lie; 0 if one comes too near or they lie on both sides,
    /// `None` if there are none.
    fn side_of(&self, start: Start, done: &[Start]) -> Option<f64> {
        let is_late = |other: &&Start| other.tick + self.tasks[other.task].ticks >= start.tick;
        let sides = done.iter().rev().take_while(is_late).filter_map(|&other| self.links.side(start, other));
        sides.reduce(|a, b| if a * b > 0.0 { a } else { 0.0 })
    }
}
