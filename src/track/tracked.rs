//! Results of a log or a scenario, for all outputs.

use super::even::even;
use super::log::is_gap;
use super::measure::{Measures, measure};
use super::replay::{self, Replay};
use super::scenario::Scenario;
use super::simulate::{self, Follower};
use super::{law, log};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::{CentreLine, Tracking};
use crate::source::Source;
use crate::units::number::short;

/// Data required by an output; each level includes the previous ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Needs {
    /// The commands of the controller.
    Commands,
    /// Also the positions of conveyor and carriage.
    Places,
    /// Also the centre line of the cloth.
    Centre,
}

/// Results of a log or a scenario.
#[derive(Debug)]
pub struct Tracked {
    /// Rows and commands.
    pub replay: Replay,
    /// Position of the conveyor at each row, mm.
    pub conveyor: Vec<f64>,
    /// Position of the carriage at each row, mm; empty if not required.
    pub carriage: Vec<f64>,
    /// Centre of the cloth by conveyor position, mm; empty if not required.
    pub centre: Vec<[f64; 2]>,
    /// Centre of the cloth under the carriage at each row, mm, from that line or from the scenario; empty for a log without the
    /// line.
    pub cloth: Vec<f64>,
    /// The followers in a scenario, the controller first, each with its measures; empty for a log.
    pub followers: Vec<(Follower, Measures)>,
}

impl Tracked {
    /// Replays a log; `None` if there are faults, which are diagnostics.
    pub fn of_log(source: &Source, track: &Tracking, needs: Needs, out: &mut Diagnostics) -> Option<Self> {
        let rows = log::read(source, track, out);
        if out.has_errors() {
            return None;
        }
        law::note(track, out);
        if track.upstream_mm.is_some() && rows.iter().all(|row| row.upstream.is_none()) {
            let message =
                "`track.upstream_mm` is given, but the log has no columns `up_i` and `up_j`: nothing is fed forward";
            out.push(Diagnostic::new(&code::TRACK_NO_UPSTREAM, message));
        }
        let replay = replay::replay(rows, track, out);
        let conveyor = replay.rows.iter().map(|row| row.conveyor.unwrap_or(row.time * track.cloth_mm_s)).collect();
        let carriage = if needs >= Needs::Places { replay::carriage(&replay, track, out) } else { Vec::new() };
        let tracked = Self { replay, conveyor, carriage, centre: Vec::new(), cloth: Vec::new(), followers: Vec::new() };
        let mut tracked = tracked.with_centre(track, needs, out)?;
        tracked.cloth = tracked.along_centre();
        Some(tracked)
    }

    /// Simulates a scenario; `None` if there are faults, which are diagnostics.
    pub fn of_scenario(source: &Source, track: &Tracking, needs: Needs, out: &mut Diagnostics) -> Option<Self> {
        let scenario = Scenario::read(source, track, out)?;
        law::note(track, out);
        let simulation = simulate::compare(&scenario, track);
        let measured = |follower: Follower| {
            let measures = measure(&follower, &simulation.cloth, &scenario, track);
            (follower, measures)
        };
        let followers: Vec<_> = simulation.followers.into_iter().map(measured).collect();
        let replay = simulation.replay;
        replay::tell(&replay, track, out);
        let conveyor = replay.rows.iter().filter_map(|row| row.conveyor).collect();
        let carriage = replay.rows.iter().filter_map(|row| row.carriage).collect();
        let cloth = simulation.cloth;
        Self { replay, conveyor, carriage, centre: Vec::new(), cloth, followers }.with_centre(track, needs, out)
    }

    /// Adds the centre line if it is required; `None` if it cannot be determined.
    fn with_centre(mut self, track: &Tracking, needs: Needs, out: &mut Diagnostics) -> Option<Self> {
        if needs < Needs::Centre {
            return Some(self);
        }
        let readings: Vec<[f64; 2]> = self.readings(track).collect();
        self.centre = even(&without_damage(&readings, track.debounce().into()), track.centre_mm);
        if self.centre.len() < 2 {
            out.push(no_centre(&readings, track));
            return None;
        }
        if let Some(unseen) = tell_unseen(&self.unseen(track)) {
            out.push(unseen);
        }
        Some(self)
    }

    /// The centre line at the conveyor position of each row, mm.
    fn along_centre(&self) -> Vec<f64> {
        let line = CentreLine::new(self.centre.clone());
        line.map_or_else(Vec::new, |line| self.conveyor.iter().map(|at| line.at(*at)).collect())
    }

    /// Stretches of cloth without a view of both edges, from and to conveyor positions, mm. They lie between two readings that
    /// see both edges, with other readings or missing samples between. Stretches up to the smoothing length are omitted,
    /// because the neighbouring readings determine the line there.
    fn unseen(&self, track: &Tracking) -> Vec<[f64; 2]> {
        let mut stretches = Vec::new();
        let mut seen: Option<usize> = None;
        for i in (0..self.replay.rows.len()).filter(|&i| self.replay.commands[i].status.sees_both_edges()) {
            if let Some(before) = seen {
                let rows = &self.replay.rows;
                let is_lost = i - before > 1 || is_gap(&rows[before], &rows[i], track);
                let stretch = [self.conveyor[before], self.conveyor[i]];
                stretches.extend((is_lost && stretch[1] - stretch[0] > track.centre_mm).then_some(stretch));
            }
            seen = Some(i);
        }
        stretches
    }

    /// Positions of conveyor and cloth centre from the readings that see both edges, mm: M = c - (I - J) q/2.
    fn readings(&self, track: &Tracking) -> impl Iterator<Item = [f64; 2]> {
        let half = track.pitch_mm / 2.0;
        let rows = self.replay.rows.iter().zip(&self.replay.commands);
        rows.zip(self.conveyor.iter().zip(&self.carriage)).filter_map(move |((row, command), (conveyor, carriage))| {
            let [left, right] = row.covered.map(f64::from);
            command.status.sees_both_edges().then(|| [*conveyor, carriage - (left - right) * half])
        })
    }
}

/// The finding on readings that give no centre line; they hold positions of conveyor and centre.
fn no_centre(readings: &[[f64; 2]], track: &Tracking) -> Diagnostic {
    let (Some([from, _]), Some([to, _])) = (readings.first(), readings.last()) else {
        let message = "there is no centre line: no row sees both edges of the cloth";
        return Diagnostic::new(&code::TRACK_NO_CENTRE, message)
            .hint("look at `track.width_mm`, and where the rulers stand");
    };
    let message = format!(
        "there is no centre line: while both edges are seen the conveyor moves {} mm in all, and a place of the line takes {} mm",
        short(to - from),
        short(track.centre_mm)
    );
    let hint = "record more of the cloth; `conv_mm` is in mm, and `track.centre_mm` says of how much a place is made";
    Diagnostic::new(&code::TRACK_NO_CENTRE, message).hint(hint)
}

/// The finding on stretches of cloth without a view of both edges, from and to conveyor positions, mm.
fn tell_unseen(stretches: &[[f64; 2]]) -> Option<Diagnostic> {
    let longest = stretches.iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let [from, to] = *longest;
    let places = match stretches.len() {
        1 => String::new(),
        count => format!(" in {count} places, the longest"),
    };
    let message = format!(
        "the centre of the cloth was not seen{places} from {} to {} mm of the conveyor: it is taken to go straight there",
        short(from),
        short(to)
    );
    let hint = "what is cut there may be displaced: record it again, or leave that stretch out of the marker";
    Some(Diagnostic::new(&code::TRACK_UNSEEN, message).by(to - from).hint(hint))
}

/// Removes edge damage that passes within a number of samples: each reading becomes the median of that many samples to either
/// side.
fn without_damage(readings: &[[f64; 2]], samples: usize) -> Vec<[f64; 2]> {
    let mut sorted: Vec<f64> = Vec::with_capacity(2 * samples + 1);
    let median = |(i, [at, _]): (usize, &[f64; 2])| {
        // Equally many on both sides, also near the ends.
        let reach = samples.min(i).min(readings.len() - 1 - i);
        sorted.clear();
        sorted.extend(readings[i - reach..=i + reach].iter().map(|[_, centre]| *centre));
        sorted.sort_unstable_by(f64::total_cmp);
        [*at, sorted[reach]]
    };
    readings.iter().enumerate().map(median).collect()
}
