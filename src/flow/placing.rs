//! Assignment of heads to rows: as few rows as the simultaneous chains allow, with room for the heads that wait.

use rayon::prelude::*;

use super::link::Wait;
use super::program::{Head, Program};
use super::rows::{self, Conflicts};
use super::track::Track;
use super::yielding::{Mate, Room};
use crate::machine::Job;

/// Heads assigned to rows.
#[derive(Debug)]
pub(super) struct Layout {
    /// The heads, row by row, within a row by increasing y.
    pub(super) heads: Vec<Head>,
    /// Number of rows.
    pub(super) rows: usize,
    /// True if this is provably the minimum number of rows for these heads.
    pub(super) exact: bool,
}

/// Assigns heads that cut the strokes of a program to rows: to the given rows, or to as few as are found.
pub(super) fn place(program: &Program, (heads, rows): (&[Head], Option<Vec<usize>>), job: &Job) -> Layout {
    let flow = &job.profile.flow;
    let width = flow.head_width_mm;
    let span = span(program, heads);
    let mates: Vec<Mate> = heads.par_iter().map(|head| mate(program, head, span)).collect();
    let room = Room {
        moving: &program.moving,
        width,
        span,
        table: job.profile.table.y_mm.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
    };
    let (colours, exact) = rows.map_or_else(
        || rows::colour(&Conflicts::new(mates.len(), |a, b| mates[a].busy.is_near(&mates[b].busy, width))),
        |rows| (rows, false),
    );
    let count = colours.iter().max().map_or(0, |most| most + 1);
    let (mut filled, mut left): (Vec<Vec<usize>>, Vec<usize>) = (Vec::new(), Vec::new());
    for row in 0..count {
        let mut members = Vec::new();
        for head in (0..mates.len()).filter(|&head| colours[head] == row) {
            match joined(&room, &mates, &members, head) {
                Some(with) => members = with,
                None => left.push(head),
            }
        }
        filled.push(members);
    }
    let exact = exact && left.is_empty();
    for head in left {
        let row = filled.iter_mut().find_map(|row| joined(&room, &mates, row, head).map(|with| *row = with));
        if row.is_none() {
            filled.push(vec![head]);
        }
    }
    let mut placed = Vec::with_capacity(mates.len());
    for (row, members) in filled.iter().enumerate() {
        let waits = waits(&room, &mates, members).expect("its members were joined with room for each");
        placed.extend(members.iter().zip(waits).map(|(&head, waits)| Head { row, waits, ..heads[head].clone() }));
    }
    Layout { heads: placed, rows: filled.len(), exact }
}

/// First and last tick at which any head does something, with some ticks at rest before and after.
fn span(program: &Program, heads: &[Head]) -> [i64; 2] {
    let [first, last] = program.extent_of(heads);
    let origin = program.origin(0);
    [first - origin, last - origin]
}

fn mate(program: &Program, head: &Head, span: [i64; 2]) -> Mate {
    let mut busy = Track::free(span);
    for start in &head.tasks {
        let stroke = &program.strokes[start.task];
        let ys = stroke.poses().map(|(pose, _, _)| pose.centre.y).chain([stroke.ends[1].centre.y]);
        ys.zip(start.tick..).for_each(|(y, tick)| busy.put(tick, y));
    }
    Mate { busy, chains: (0..head.tasks.len()).map(|task| program.chain(head, task)).collect() }
}

/// The members of a row, in order, with one head added; `None` if there is no room for it.
fn joined(room: &Room, mates: &[Mate], members: &[usize], head: usize) -> Option<Vec<usize>> {
    let busy = &mates[head].busy;
    if members.iter().any(|&other| busy.is_near(&mates[other].busy, room.width)) {
        return None;
    }
    // The head goes above those that it must be above and below the others. If several places remain, its middle y decides
    // first.
    let above = members.iter().rposition(|&other| busy.side(&mates[other].busy) > 0.0).map_or(0, |i| i + 1);
    let below = members.iter().position(|&other| busy.side(&mates[other].busy) < 0.0).unwrap_or(members.len());
    let middle = busy.middle();
    let fit = members.iter().position(|&other| mates[other].busy.middle() > middle).unwrap_or(members.len());
    let mut places = vec![fit.clamp(above.min(below), below)];
    places.extend((above..=below).filter(|&place| place != fit));
    places.into_iter().find_map(|place| {
        let mut with = members.to_vec();
        with.insert(place, head);
        waits(room, mates, &with).map(|_| with)
    })
}

fn waits(room: &Room, mates: &[Mate], row: &[usize]) -> Option<Vec<Vec<Wait>>> {
    let row: Vec<&Mate> = row.iter().map(|&head| &mates[head]).collect();
    room.waits(&row)
}
