//! Speed of a head along a chain. A head that runs ahead of the cloth reaches the end of its travel and would have to wait with
//! the knife down. Its speed is therefore capped in advance, chord by chord, so that it arrives together with the cloth.
//!
//! The fastest motion gives the minimum time of each chord; the lag before a chord gives the permitted lead over the cloth. A
//! motion under these caps has to accelerate and brake, so it is late against them, never early. Each round subtracts the delay
//! measured in the round before.

use super::chains::Chain;
use super::moving::Moving;
use super::stroke::{Stroke, stroke};
use crate::diagnostic::Diagnostic;
use crate::geom::{Point, Rotation, polyline};
use crate::ir::Toolpath;
use crate::ir::motion::{Kind, Phase};
use crate::ir::toolpath::{Run, Step};

/// Maximum number of slowing rounds.
const ROUNDS: usize = 3;
/// Fraction of the travel below which a chain needs no slower pace.
const PLENTY: f64 = 0.5;
/// Relative difference below which two speeds are equal.
const SAME: f64 = 1e-6;

/// A chord of a run, or the time between two runs.
#[derive(Debug, Clone, Copy)]
struct Leg {
    /// Index of the run among the steps, and of its chord; `None` if the speed cannot be capped.
    chord: Option<[usize; 2]>,
    /// Duration, s.
    time: f64,
    /// Fall of x, mm.
    advance: f64,
    /// Length of the tip's path, mm.
    way: f64,
}

/// The motion of a chain with the least travel along the feed that was found.
pub(super) fn paced(chain: &Chain, toolpath: &Toolpath, moving: &Moving) -> Result<Stroke, Vec<Diagnostic>> {
    let mut best = stroke(chain, toolpath, moving)?;
    let travel = |stroke: &Stroke| stroke.lag.travel(moving.ramp.way);
    let has_plenty = |stroke: &Stroke| travel(stroke) <= PLENTY * moving.travel;
    if has_plenty(&best) {
        return Ok(best);
    }
    let fastest = legs(toolpath, &best, moving);
    let mut late = vec![0.0; fastest.len()];
    let mut capped = toolpath.clone();
    for _ in 0..ROUNDS {
        let times = times(&fastest, &late, moving.speed);
        if !cap(&mut capped, toolpath, &fastest, &times) {
            break;
        }
        // If the slower motion cannot be planned, the best one so far stays.
        let Ok(slower) = stroke(chain, &capped, moving) else { break };
        let now = legs(&capped, &slower, moving);
        late = now.iter().zip(&times).map(|(leg, time)| (leg.time - time).max(0.0)).collect();
        if travel(&slower) < travel(&best) {
            best = slower;
        }
        if has_plenty(&best) {
            break;
        }
    }
    Ok(best)
}

/// Target duration of each leg, s, at which the head never runs ahead of the cloth and its lag stays non-negative. `late` is
/// the measured delay of each leg against its target, s.
fn times(fastest: &[Leg], late: &[f64], speed: f64) -> Vec<f64> {
    let mut lag = 0.0;
    let time = |(leg, late): (&Leg, &f64)| {
        let time = leg.time.max((leg.advance - lag) / speed - late);
        lag += speed * (time + late) - leg.advance;
        time
    };
    fastest.iter().zip(late).map(time).collect()
}

/// Caps the speed of the chords that must take longer than their minimum time. True if any cap changed.
fn cap(capped: &mut Toolpath, plain: &Toolpath, fastest: &[Leg], times: &[f64]) -> bool {
    let mut is_other = false;
    for (leg, &time) in fastest.iter().zip(times) {
        let Some([step, chord]) = leg.chord else { continue };
        let (Step::Run(run), Step::Run(of)) = (&mut capped.steps[step], &plain.steps[step]) else { continue };
        // A chord shorter than the path of one period takes the speed of its neighbours.
        let is_slowed = time > leg.time && leg.way > 0.0;
        let feed = if is_slowed { of.feeds[chord].min(leg.way / time) } else { of.feeds[chord] };
        is_other |= (run.feeds[chord] / feed - 1.0).abs() > SAME;
        run.feeds[chord] = feed;
    }
    is_other
}

/// The legs of a motion.
fn legs(toolpath: &Toolpath, stroke: &Stroke, moving: &Moving) -> Vec<Leg> {
    let knife = &moving.either.profile.knife;
    let mut runs = toolpath.steps.iter().enumerate().filter_map(|(i, step)| match step {
        Step::Run(run) => Some((i, Some(run))),
        Step::PlungeCut(_) => Some((i, None)),
        Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let (mut legs, mut current) = (Vec::new(), None);
    let mut next = stroke.phases.iter().skip(1).map(|phase| phase.pose(0).centre.x).chain([stroke.ends[1].centre.x]);
    for phase in &stroke.phases {
        let end = next.next().unwrap_or(stroke.ends[1].centre.x);
        if phase.kind == Kind::Plunge {
            current = runs.next();
        }
        match current {
            Some((step, Some(run))) if phase.kind == Kind::Cut => {
                let lead = run.edge.lead(knife.ends());
                legs.extend(Cut { step, run, phase, lead, end }.legs(moving));
            }
            _ => {
                let time = f64::from(phase.ticks) * moving.period;
                legs.push(Leg { chord: None, time, advance: phase.pose(0).centre.x - end, way: 0.0 });
            }
        }
    }
    legs
}

/// A run with its motion.
struct Cut<'a> {
    /// Index of the run among the steps.
    step: usize,
    run: &'a Run,
    phase: &'a Phase,
    /// Distance from the C axis to the leading end of the blade, mm.
    lead: f64,
    /// Position of the C axis along the feed at the end, mm.
    end: f64,
}

impl Cut<'_> {
    /// The legs of the run, one per chord. The remaining path locates the tip on the polyline.
    fn legs(&self, moving: &Moving) -> Vec<Leg> {
        let Self { step, run, phase, end, .. } = *self;
        let way = self.way(moving);
        let stations = polyline::stations(&run.points);
        let whole = stations[stations.len() - 1] + run.front;
        let total = phase.length.max(way.last().copied().unwrap_or(0.0));
        // First tick at which the tip has reached a station.
        let reach =
            |station: f64| way.partition_point(|&at| at < total - (whole - station)).min(phase.ticks as usize) as u32;
        let x = |tick: u32| if tick < phase.ticks { phase.pose(tick).centre.x } else { end };
        let travelled = |tick: u32| way.get(tick as usize).copied().unwrap_or(total);
        let last_chord = stations.len() - 2;
        let mut from = 0;
        let leg = |chord: usize| {
            let to = if chord == last_chord { phase.ticks } else { reach(stations[chord + 1]).max(from) };
            let leg = Leg {
                chord: Some([step, chord]),
                time: f64::from(to - from) * moving.period,
                advance: x(from) - x(to),
                way: travelled(to) - travelled(from),
            };
            from = to;
            leg
        };
        (0..=last_chord).map(leg).collect()
    }

    /// Length of the tip's path up to each tick, mm.
    fn way(&self, moving: &Moving) -> Vec<f64> {
        let Self { run, phase, lead, .. } = *self;
        let turn = run.edge.turn() + moving.either.profile.knife.yaw();
        let tip = |tick: u32| -> Point {
            let pose = phase.pose(tick);
            pose.centre + Rotation(pose.c.0 - turn).unit() * lead
        };
        let (mut last, mut sum) = (tip(0), 0.0);
        let to = |tick: u32| {
            let here = tip(tick);
            sum += (here - last).norm();
            last = here;
            sum
        };
        (0..phase.ticks).map(to).collect()
    }
}
