//! A plunge cut: a run that the blade covers where it is plunged, and where it leaves what it is longer by.

use super::blade::Plunge;
use crate::analysis::cloth::Surroundings;
use crate::geom::region::{Ray, Room};
use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Overcut, Run};

/// A shorter overcut is none, mm: rounding.
const OVERCUT_EPSILON: f64 = 1e-6;

/// Where the blade stands when one plunge without motion cuts all of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BladePlacement {
    /// Direction of the blade, unit vector from heel to tip: a chord of the run, which its overlaps lead on.
    pub along: Vector,
    /// Where the tip stands.
    pub tip: Point,
    /// How far the blade goes beyond the start and the end of the run, mm: the overlaps, and what it is longer by.
    pub beyond: [f64; 2],
    /// How much of what it is longer by lies in parts, before the start and past the end.
    pub overcut: [Overcut; 2],
}

impl BladePlacement {
    /// That of an open run with overlaps of these lengths at its start and its end, mm; `None` when the blade has a way
    /// to go between plunge and lift.
    ///
    /// What the blade is longer by, the surplus, goes into the waste: behind the start as far as there is room, then
    /// past the end, and first past the end where the start alone may have no overlap. What finds no room cuts into the
    /// part itself, never into another one that can be spared.
    pub fn of(run: &Run, overlaps: [f64; 2], around: &Surroundings) -> Option<Self> {
        let width = around.knife.width_mm;
        let path = run.extended_by(overlaps);
        if width == 0.0 || Plunge::at_start(&path, width).has_way(&path) {
            return None;
        }
        let (start, end) = (run.points[0], run.points[run.points.len() - 1]);
        let along = polyline::direction(start, end)?;
        let line = [start - along * overlaps[0], end + along * overlaps[1]];
        let surplus = (width - (line[1] - line[0]).norm()).max(0.0);
        let reach = surplus + around.knife.clearance_mm;
        let rooms = [Ray { from: line[0], along: -along, reach }, Ray { from: line[1], along, reach }];
        let rooms = rooms.map(|ray| around.room(&ray));
        let order = if run.ends[0].bare && !run.ends[1].bare { [1, 0] } else { [0, 1] };
        let shared = shared(surplus, order.map(|end| rooms[end]), around.knife.clearance_mm);
        let shares = order.map(|end| shared[end]);
        Some(Self {
            along,
            tip: line[1] + along * shares[1],
            beyond: [overlaps[0] + shares[0], overlaps[1] + shares[1]],
            overcut: [overcut(shares[0], rooms[0]), overcut(shares[1], rooms[1])],
        })
    }

    /// How far it cuts into parts beyond both ends together, mm.
    pub fn overcut(&self) -> f64 {
        self.overcut.into_iter().map(Overcut::total).sum()
    }
}

/// Shares a surplus out to the two ends of a line, of which the first is preferred, by how much room there is beyond each:
/// to the waste; then into the part itself, alike at both ends so that the greater is least; and only what is left into
/// another part. All in mm.
fn shared(surplus: f64, rooms: [Room; 2], clearance: f64) -> [f64; 2] {
    let clear = |gap: f64| (gap - clearance).max(0.0);
    let first = surplus.min(clear(rooms[0].least()));
    let second = (surplus - first).min(clear(rooms[1].least()));
    let left = surplus - first - second;
    if left <= OVERCUT_EPSILON {
        return [first + left, second];
    }
    // Where nothing but the part itself lies ahead it may be cut, up to the next part.
    let spare =
        |room: Room, length: f64| if room.own < room.other { (clear(room.other) - length).max(0.0) } else { 0.0 };
    let spare = [spare(rooms[0], first), spare(rooms[1], second)];
    let own = (left / 2.0).min(spare[0]).max(left - spare[1]).min(spare[0]);
    let own = [own, (left - own).min(spare[1])];
    // The rest enters another part whichever end it leaves by.
    let rest = left - own[0] - own[1];
    [first + own[0] + rest / 2.0, second + own[1] + rest / 2.0]
}

/// How much of a way of a length beyond an end lies in parts, mm, by how much room there is.
fn overcut(length: f64, room: Room) -> Overcut {
    let into = |from: f64, to: f64| if to - from > OVERCUT_EPSILON { to - from } else { 0.0 };
    Overcut { own: into(room.own, length.min(room.other)), other: into(room.other, length) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: f64 = f64::INFINITY;

    fn room(own: f64, other: f64) -> Room {
        Room { own, other }
    }

    #[test]
    fn a_surplus_goes_behind_the_start_then_past_the_end() {
        assert_eq!(shared(2.0, [room(FREE, FREE); 2], 0.1), [2.0, 0.0]);
        assert_eq!(shared(2.0, [room(FREE, 1.6), room(FREE, FREE)], 0.1), [1.5, 0.5]);
    }

    #[test]
    fn what_finds_no_room_goes_into_the_own_part_alike_and_spares_others() {
        assert_eq!(shared(2.0, [room(0.0, FREE); 2], 0.1), [1.0, 1.0]);
        assert_eq!(shared(2.0, [room(FREE, 0.0), room(0.0, FREE)], 0.1), [0.0, 2.0]);
        assert_eq!(shared(2.0, [room(FREE, 0.0); 2], 0.1), [1.0, 1.0]);
        assert_eq!(overcut(2.0, room(0.5, 1.5)), Overcut { own: 1.0, other: 0.5 });
    }
}
