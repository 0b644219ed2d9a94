//! Record of a program, phase by phase: the path of the axes, outputs, blocks, and the time and path lengths of each piece.

use super::fit::{Axes, Fit};
use super::peaks::{Limits, Peaks};
use crate::ir::Motion;
use crate::ir::motion::{BOUNDS, Bound, Kind, Phase, Poses, Shares};
use crate::ir::toolpath::{Event, Pose};
use crate::machine::{self, MachineProfile};
use crate::picture::Columns;
use crate::units::deg;

/// Orders of the limits of an axis, as rules of the verifier name them.
const ORDERS: [&str; 3] = ["speed", "acceleration", "jerk"];

/// Time and path lengths of a program or of one piece.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    /// Ticks by activity, in the order of [`Sums::PARTS`].
    pub(super) ticks: [u64; 10],
    /// Ticks of its cuts by the limit that binds them.
    pub(super) bound: Shares,
    /// Path length of the C axis with the knife up, mm.
    pub(super) travel: f64,
    /// Path length of the tip with the knife down, mm.
    pub(super) cut: f64,
    /// Number of plunges.
    pub(super) plunges: usize,
    /// Length of all overlaps, mm.
    pub(super) overlaps: f64,
}

impl Sums {
    /// Names of the activities, by index: those of [`Kind::part`], with a line for each thing that is waited for.
    pub(super) const PARTS: [&str; 10] = [
        "cutting",
        "travelling",
        "turning",
        "plunging",
        "lifting",
        "drilling",
        "waiting for the knife to be all the way up",
        "asking for a stop: its length is not counted",
        "asking for the cloth: its move is not counted",
        "resting at the end",
    ];

    fn add(&mut self, phase: &Phase) {
        let activity = match phase.kind {
            Kind::Event(Event::Stop) => 7,
            Kind::Event(Event::Advance | Event::AdvanceBy(_)) => 8,
            Kind::Rest => 9,
            kind => kind.part(),
        };
        self.ticks[activity] += u64::from(phase.ticks);
        match phase.kind {
            Kind::Cut => self.cut += phase.length,
            Kind::Travel | Kind::Turn => self.travel += phase.length,
            Kind::Plunge => self.plunges += 1,
            Kind::Lift | Kind::Drill(_) | Kind::Wait | Kind::Event(_) | Kind::Rest => {}
        }
    }

    /// Adds the sums of another section.
    pub(super) fn join(&mut self, other: &Self) {
        self.ticks.iter_mut().zip(other.ticks).for_each(|(ticks, more)| *ticks += more);
        self.bound.merge(&other.bound);
        self.travel += other.travel;
        self.cut += other.cut;
        self.plunges += other.plunges;
        self.overlaps += other.overlaps;
    }

    /// Ticks of cutting, of travelling, and of everything else.
    pub(super) fn shares(&self) -> [u64; 3] {
        let [cutting, travelling, ..] = self.ticks;
        [cutting, travelling, self.total() - cutting - travelling]
    }

    /// Limits of its cuts with their ticks, the longest first; those without any are omitted. A program that keeps the knife
    /// up cuts nothing that they could bind.
    pub(super) fn bounds(&self) -> Vec<(Bound, u64)> {
        let cut = self.ticks[Kind::Cut.part()];
        let bounds = BOUNDS.iter().map(|&bound| (bound, self.bound.of(bound)));
        let mut bounds: Vec<_> = bounds.filter(|&(_, ticks)| cut > 0 && ticks > 0).collect();
        bounds.sort_by_key(|&(_, ticks)| std::cmp::Reverse(ticks));
        bounds
    }

    /// Total number of ticks.
    pub(super) fn total(&self) -> u64 {
        self.ticks.iter().sum()
    }
}

/// A phase as stored for the page.
#[derive(Debug)]
struct Stretch {
    tick: u64,
    kind: i64,
    /// Index of its piece in the marker; -1 before any piece.
    part: i64,
    station: u32,
}

/// A phase that is still open: it ends where the next one starts.
#[derive(Debug)]
struct Open {
    first_tick: u64,
    ticks: u64,
    /// The setpoints; a single one where the axes are at rest.
    way: Vec<Axes>,
}

/// The record of a program.
#[derive(Debug)]
pub(super) struct Record {
    tick: u64,
    /// Index in the marker of the piece whose work was taken last; what follows outside of pieces counts for it.
    part: Option<u32>,
    /// Limits of the axes in cuts and with the knife up.
    limits: [Limits; 2],
    open: Option<Open>,
    fit: Fit,
    pub(super) peaks: Peaks,
    stretches: Vec<Stretch>,
    /// Start ticks of the blocks, with their numbers.
    blocks: Vec<[u64; 2]>,
    /// Sums over the program, and for each piece by its index in the marker.
    pub(super) all: Sums,
    pub(super) pieces: Vec<Sums>,
}

impl Record {
    pub(super) fn new(profile: &MachineProfile, pieces: usize) -> Self {
        let in_page = |limits: [machine::Limits; 3]| {
            [0, 1, 2].map(|axis| {
                let machine::Limits { speed, acceleration, jerk } = limits[axis];
                [speed, acceleration, jerk].map(|limit| if axis == 2 { deg(limit) } else { limit })
            })
        };
        Self {
            tick: 0,
            part: None,
            limits: [in_page(profile.axes.limits()), in_page(profile.axes.travel_limits())],
            open: None,
            fit: Fit::default(),
            peaks: Peaks::new(profile.time.period()),
            stretches: Vec::new(),
            blocks: Vec::new(),
            all: Sums::default(),
            pieces: vec![Sums::default(); pieces],
        }
    }

    /// Number of setpoints of the program so far.
    pub(super) fn ticks(&self) -> u64 {
        self.tick
    }

    /// Limits of the axes in cuts and with the knife up, in mm or degrees and powers of s.
    pub(super) fn limits(&self) -> &[Limits; 2] {
        &self.limits
    }

    /// Axis limit of the profile from which the limit of a rule was widened, by the rounding of the rows: the greatest of its axis
    /// and order that is not above it. Limits of other rules are those of the profile as they are.
    pub(super) fn limit(&self, rule: &str, allowed: f64) -> f64 {
        let of_axis = |axis: &str| ["x", "y", "c"].iter().position(|name| *name == axis);
        let of_order = |order: &str| ORDERS.iter().position(|name| *name == order);
        let Some((order, axis)) = rule.strip_prefix("verify/").and_then(|name| name.rsplit_once('-')) else {
            return allowed;
        };
        let (Some(order), Some(axis)) = (of_order(order), of_axis(axis)) else { return allowed };
        let known = self.limits.iter().map(|limits| limits[axis][order]).filter(|&limit| limit <= allowed);
        known.reduce(f64::max).unwrap_or(allowed)
    }

    /// Adds the motion of a toolpath.
    pub(super) fn take(&mut self, motion: &Motion) {
        if motion.piece > 0 {
            self.part = Some(motion.part);
        }
        for phase in &motion.phases {
            self.phase(phase);
        }
        let overlaps: f64 = motion.tasks.iter().map(|task| task.front.max(0.0) + task.heel.max(0.0)).sum();
        self.count(|sums| {
            sums.overlaps += overlaps;
            sums.bound.merge(&motion.shares);
        });
    }

    /// Adds to the sums over the program and to those of the piece.
    fn count(&mut self, add: impl Fn(&mut Sums)) {
        add(&mut self.all);
        if let Some(piece) = self.part.and_then(|part| self.pieces.get_mut(part as usize)) {
            add(piece);
        }
    }

    fn phase(&mut self, phase: &Phase) {
        self.close(axes(phase.pose(0)));
        self.count(|sums| sums.add(phase));
        let limits = &self.limits[usize::from(!phase.kind.knife_down())];
        let rests = matches!(phase.poses, Poses::Still(_));
        let mut way = Vec::with_capacity(if rests { 1 } else { phase.ticks as usize + 1 });
        for tick in 0..phase.ticks {
            let at = axes(phase.pose(tick));
            self.peaks.take(at, limits);
            if tick == 0 || !rests {
                way.push(at);
            }
        }
        self.open = Some(Open { first_tick: self.tick, ticks: u64::from(phase.ticks), way });
        let part = self.part.map_or(-1, i64::from);
        self.stretches.push(Stretch { tick: self.tick, kind: number(phase.kind), part, station: phase.station });
        for spell in &phase.spells {
            self.blocks.push([self.tick + u64::from(spell.first), u64::from(spell.block)]);
        }
        self.tick += u64::from(phase.ticks);
    }

    /// Closes the open phase at the start of the next one.
    fn close(&mut self, end: Axes) {
        let Some(Open { first_tick, ticks, mut way }) = self.open.take() else { return };
        if way.len() == 1 {
            self.fit.rest(first_tick, ticks, way[0]);
        } else {
            way.push(end);
            self.fit.add(first_tick, &way);
        }
    }

    /// Adds the columns.
    pub(super) fn write(&mut self, columns: &mut Columns) {
        if let Some(last) = self.open.as_ref().and_then(|open| open.way.last().copied()) {
            self.close(last);
        }
        if self.stretches.is_empty() {
            // The axes of a marker that was not planned rest at home.
            self.fit.rest(0, 0, [0.0; 3]);
            self.stretches.push(Stretch { tick: 0, kind: number(Kind::Rest), part: -1, station: 0 });
        }
        self.fit.write(columns);
        columns.add("phase_tick", 1.0, self.stretches.iter().map(|phase| phase.tick.cast_signed()));
        columns.add("phase_kind", 1.0, self.stretches.iter().map(|phase| phase.kind));
        columns.add("phase_part", 1.0, self.stretches.iter().map(|phase| phase.part));
        columns.add("phase_station", 1.0, self.stretches.iter().map(|phase| i64::from(phase.station)));
        columns.add("block_tick", 1.0, self.blocks.iter().map(|block| block[0].cast_signed()));
        columns.add("block", 1.0, self.blocks.iter().map(|block| block[1].cast_signed()));
        self.peaks.write(columns);
    }
}

/// A pose in the units of the page.
fn axes(pose: Pose) -> Axes {
    [pose.centre.x, pose.centre.y, deg(pose.c.0)]
}

/// Code of a phase kind on the page.
fn number(kind: Kind) -> i64 {
    match kind {
        Kind::Rest => 0,
        Kind::Wait => 1,
        Kind::Travel => 2,
        Kind::Turn => 3,
        Kind::Plunge => 4,
        Kind::Cut => 5,
        Kind::Lift => 6,
        Kind::Event(Event::Stop) => 7,
        Kind::Event(Event::Advance | Event::AdvanceBy(_)) => 8,
        Kind::Drill(tool) => 10 + i64::from(tool),
    }
}
