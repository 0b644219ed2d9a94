//! Which head makes which chain, and when: interval scheduling with set-up times.
//!
//! Tasks are taken in the order in which they may start at the latest. Each goes to the head that is free in time and has
//! the least way to it; a new head is taken where none is. Without set-up times and with tasks that start at one time only
//! that is optimal (Kleinberg & Tardos, *Algorithm Design*, 2006, section 4.1); with them it is a heuristic, and what it
//! gives is shown beside the lower bound.

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
