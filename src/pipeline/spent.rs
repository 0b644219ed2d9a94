//! Use of the time of a program, and the limits that keep its cuts from being faster.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::rounded::to_millionths;
use crate::ir::motion::{BOUNDS, Bound, Motion, Shares};

/// Times by activity of the machine, s.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spent {
    /// Knife down, along the path.
    pub cut: f64,
    /// Knife up, from contour to contour.
    pub travel: f64,
    /// Knife up, at corners.
    pub turn: f64,
    /// Until the knife is through the cloth.
    pub plunge: f64,
    /// Until the knife is clear of the cloth.
    pub lift: f64,
    /// Drilling.
    pub drill: f64,
    /// At rest for another reason: until the knife is all the way up, for an event, or at the end.
    pub wait: f64,
    /// Limits of the cuts, each with its time, in the order of [`BOUNDS`]; those without any time are omitted. Empty if nothing
    /// is cut.
    pub bounds: Vec<(Bound, f64)>,
}

impl Spent {
    /// Total, s.
    pub fn total(&self) -> f64 {
        self.parts().iter().map(|(_, time)| time).sum()
    }

    /// Activities in words, with their times, s.
    pub fn parts(&self) -> [(&'static str, f64); 7] {
        [
            ("cut", self.cut),
            ("travel", self.travel),
            ("turn", self.turn),
            ("plunge", self.plunge),
            ("lift", self.lift),
            ("drill", self.drill),
            ("wait", self.wait),
        ]
    }
}

impl Serialize for Spent {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        let mut map = out.serialize_map(None)?;
        for (name, time) in self.parts() {
            map.serialize_entry(&format!("{name}_s"), &to_millionths(time))?;
        }
        let key = |bound: Bound| format!("{}_s", bound.to_string().replace(' ', "_"));
        let bounds: serde_json::Map<String, serde_json::Value> =
            self.bounds.iter().map(|&(bound, time)| (key(bound), to_millionths(time).into())).collect();
        map.serialize_entry("cut_bound_by", &bounds)?;
        map.end()
    }
}

/// Counter of ticks by activity of the machine.
#[derive(Debug, Clone, Default)]
pub(super) struct Clock {
    ticks: [u64; 7],
    shares: Shares,
}

impl Clock {
    /// Adds the phases of a motion and the limits of its cuts.
    pub(super) fn add(&mut self, motion: &Motion) {
        self.shares.merge(&motion.shares);
        for phase in &motion.phases {
            self.ticks[phase.kind.part()] += u64::from(phase.ticks);
        }
    }

    /// Times, s, for a period in s.
    pub(super) fn spent(&self, period: f64) -> Spent {
        let time = |ticks: u64| ticks as f64 * period;
        let [cut, travel, turn, plunge, lift, drill, wait] = self.ticks.map(time);
        // A dry run with the knife up only travels: its limits slow no cut down.
        let shares = |bound: &Bound| if cut > 0.0 { time(self.shares.of(*bound)) } else { 0.0 };
        let bounds = BOUNDS.iter().map(|bound| (*bound, shares(bound))).filter(|row| row.1 > 0.0).collect();
        Spent { cut, travel, turn, plunge, lift, drill, wait, bounds }
    }
}
