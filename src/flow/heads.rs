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

/// The tasks of each head, in order.
pub(super) fn assign(tasks: &[Task], links: &impl Links) -> Vec<Vec<Start>> {
    let mut order: Vec<usize> = (0..tasks.len()).collect();
    order.sort_by_key(|&i| (tasks[i].window[0], tasks[i].window[1], i));
    let mut heads: Vec<Vec<Start>> = Vec::new();
    for task in order {
        let free = heads.iter().enumerate().filter_map(|(head, done)| {
            let last = *done.last()?;
            let tick = start(tasks, last, task, links)?;
            Some((links.cost(last.task, task), head, tick))
        });
        match free.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) {
            Some((_, head, tick)) => heads[head].push(Start { task, tick }),
            None => heads.push(vec![Start { task, tick: tasks[task].window[0] }]),
        }
    }
    heads
}

/// A head of a row that is being filled.
#[derive(Debug, Clone)]
struct Slot {
    row: usize,
    done: Vec<Start>,
}

/// The row and the tasks of each head, in order, where tasks go to rows in which they clash with none.
pub(super) fn assign_in_rows(tasks: &[Task], links: &impl Links) -> Vec<(usize, Vec<Start>)> {
    let mut order: Vec<usize> = (0..tasks.len()).collect();
    order.sort_by_key(|&i| (tasks[i].window[0], tasks[i].window[1], i));
    let mut slots: Vec<Slot> = Vec::new();
    for task in order {
        let free = slots.iter().enumerate().filter_map(|(head, slot)| {
            let last = *slot.done.last()?;
            let start = Start { task, tick: start(tasks, last, task, links)? };
            fits(&slots, slot.row, Some(head), start, tasks, links).then(|| (links.cost(last.task, task), head, start))
        });
        let best = free.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((_, head, start)) = best {
            slots[head].done.push(start);
            continue;
        }
        let start = Start { task, tick: tasks[task].window[0] };
        let rows = slots.iter().map(|slot| slot.row + 1).max().unwrap_or(0);
        let row = (0..rows).find(|&row| fits(&slots, row, None, start, tasks, links)).unwrap_or(rows);
        slots.push(Slot { row, done: vec![start] });
    }
    slots.into_iter().map(|slot| (slot.row, slot.done)).collect()
}

/// Whether a head of a row, or one that comes into it, can make a task beside the others of the row: it meets none, and is
/// on the same side of each as before.
fn fits(slots: &[Slot], row: usize, head: Option<usize>, start: Start, tasks: &[Task], links: &impl Links) -> bool {
    let mates = slots.iter().enumerate().filter(|(mate, slot)| slot.row == row && Some(*mate) != head);
    let own = head.map_or(&[][..], |head| &slots[head].done);
    mates.into_iter().all(|(_, mate)| {
        let side = side_of(start, &mate.done, tasks, links);
        side != Some(0.0) && {
            let before = || own.iter().rev().find_map(|&own| side_of(own, &mate.done, tasks, links));
            side.is_none_or(|side| before().is_none_or(|before| before * side > 0.0))
        }
    })
}

/// On which side of a task those of another head are that are made at the same time; 0 where any comes too near.
fn side_of(start: Start, done: &[Start], tasks: &[Task], links: &impl Links) -> Option<f64> {
    let late = done.iter().rev().take_while(|other| other.tick + tasks[other.task].ticks >= start.tick);
    let sides = late.filter_map(|&other| links.side(start, other));
    sides.reduce(|a, b| if a * b > 0.0 { a } else { 0.0 })
}

/// When a head that made one task can start another one; `None` when that is too late.
fn start(tasks: &[Task], last: Start, task: usize, links: &impl Links) -> Option<i64> {
    let end = last.tick + tasks[last.task].ticks;
    let [earliest, latest] = tasks[task].window;
    let mut tick = earliest;
    for _ in 0..ROUNDS {
        let ready = end + links.ticks(last, Start { task, tick });
        if ready <= tick {
            return Some(tick);
        }
        tick = ready;
        if tick > latest {
            return None;
        }
    }
    None
}
