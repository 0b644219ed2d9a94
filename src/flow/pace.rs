//! A head that is too fast along the feed comes to the end of its travel and would have to wait with the knife down. It is
//! slowed before that: chord by chord, to the speed at which it arrives where the cloth is.
//!
//! The fastest motion tells how long each chord takes at the least; the lag before a chord, how much sooner than the cloth
//! the head may arrive. A motion under these caps starts from rest and so is later than they say, never earlier; its lag is
//! taken into account in the next round.

use super::chains::Chain;
use super::moving::Moving;
use super::stroke::{Stroke, stroke};
use crate::diagnostic::Diagnostic;
use crate::geom::{Point, polyline};
use crate::ir::Toolpath;
use crate::ir::motion::{Kind, Phase};
use crate::ir::toolpath::{Run, Step};

/// Rounds of slowing down.
const ROUNDS: usize = 5;
/// A chain that takes no more of the travel needs no better pace.
const PLENTY: f64 = 0.5;
/// Speeds that differ by less are alike.
const SAME: f64 = 1e-6;

/// A chord of a run, or a time between two runs.
#[derive(Debug, Clone, Copy)]
struct Leg {
    /// The run among the steps, and the chord of it; `None` where no speed can be capped.
    chord: Option<[usize; 2]>,
    /// How long it takes, s.
    time: f64,
    /// How far x falls, mm.
    advance: f64,
    /// Length of the way, mm.
    way: f64,
}

/// The motion of a chain at a pace that takes as little travel along the feed as is found.
pub(super) fn paced(chain: &Chain, toolpath: &Toolpath, moving: &Moving) -> Result<Stroke, Vec<Diagnostic>> {
    let mut best = stroke(chain, toolpath, moving)?;
    let travel = |stroke: &Stroke| stroke.lag.travel(moving.ramp.way);
    let fastest = legs(toolpath, &best, moving);
    let mut now = fastest.clone();
    let mut capped = toolpath.clone();
    for round in 0..ROUNDS {
        if travel(&best) <= PLENTY * moving.travel {
            break;
        }
        let lags = if round == 0 { lags_of_bound(&fastest, moving.speed) } else { lags(&now, moving.speed) };
        if !cap(&mut capped, toolpath, &fastest, &lags, moving.speed) {
            break;
        }
        let slower = stroke(chain, &capped, moving)?;
        now = legs(&capped, &slower, moving);
        if travel(&slower) < travel(&best) {
            best = slower;
        }
    }
    Ok(best)
}

/// The lag before each leg where a head waits when it would be early: it never falls below that of its start, mm.
fn lags_of_bound(legs: &[Leg], speed: f64) -> Vec<f64> {
    let mut lag: f64 = 0.0;
    let before = |leg: &Leg| {
        let before = lag;
        lag = (lag + speed * leg.time - leg.advance).max(0.0);
        before
    };
    legs.iter().map(before).collect()
}

/// The lag before each leg of a motion, mm.
fn lags(legs: &[Leg], speed: f64) -> Vec<f64> {
    let mut lag: f64 = 0.0;
    let before = |leg: &Leg| {
        let before = lag;
        lag += speed * leg.time - leg.advance;
        before
    };
    legs.iter().map(before).collect()
}

/// Caps the chords at whose fastest the lag would fall below that of the start; says whether any cap is another one than
/// before.
fn cap(capped: &mut Toolpath, plain: &Toolpath, fastest: &[Leg], lags: &[f64], speed: f64) -> bool {
    let mut is_other = false;
    for (leg, lag) in fastest.iter().zip(lags) {
        let Some([step, chord]) = leg.chord else { continue };
        let (Step::Run(run), Step::Run(of)) = (&mut capped.steps[step], &plain.steps[step]) else { continue };
        let time = (leg.advance - lag) / speed;
        let feed = if time > leg.time { of.feeds[chord].min(leg.way / time) } else { of.feeds[chord] };
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
                legs.extend(of_cut(step, run, phase, lead, end, moving));
            }
            _ => {
                let time = f64::from(phase.ticks) * moving.period;
                legs.push(Leg { chord: None, time, advance: phase.pose(0).centre.x - end, way: 0.0 });
            }
        }
    }
    legs
}

/// The legs of a cut, a chord each: where the tip is along the polyline is told by how far it still has to go.
fn of_cut(step: usize, run: &Run, phase: &Phase, lead: f64, end: f64, moving: &Moving) -> Vec<Leg> {
    let turn = run.edge.turn() + moving.either.profile.knife.yaw();
    let tip = |tick: u32| -> Point {
        let pose = phase.pose(tick);
        pose.centre + crate::geom::Rotation(pose.c.0 - turn).unit() * lead
    };
    let mut way = Vec::with_capacity(phase.ticks as usize + 1);
    let (mut last, mut sum) = (tip(0), 0.0);
    for tick in 0..phase.ticks {
        let here = tip(tick);
        sum += (here - last).norm();
        way.push(sum);
        last = here;
    }
    let stations = polyline::stations(&run.points);
    let whole = stations[stations.len() - 1] + run.front;
    let total = phase.length.max(sum);
    // The tick at which the tip is at a station, and the place of the centre then.
    let reach =
        |station: f64| way.partition_point(|&at| at < total - (whole - station)).min(phase.ticks as usize) as u32;
    let x = |tick: u32| if tick < phase.ticks { phase.pose(tick).centre.x } else { end };
    let last_chord = stations.len() - 2;
    let mut from = 0;
    (0..=last_chord)
        .map(|chord| {
            let to = if chord == last_chord { phase.ticks } else { reach(stations[chord + 1]).max(from) };
            let travelled = |tick: u32| way.get(tick as usize).copied().unwrap_or(total);
            let leg = Leg {
                chord: Some([step, chord]),
                time: f64::from(to - from) * moving.period,
                advance: x(from) - x(to),
                way: travelled(to) - travelled(from),
            };
            from = to;
            leg
        })
        .collect()
}
