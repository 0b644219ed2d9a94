//! The carriage that follows the centre of a moving cloth.

use super::machine::{Checked, Machine, listed};
use crate::track::{Needs, TARGETS, Tracked};

pub(super) const MACHINE: Machine = Machine {
    name: "track",
    about: "a carriage that keeps over the centre of a moving cloth",
    works: "follows",
    tool: None,
    targets: || listed(TARGETS),
    // Its law is not a table of rules: commands are judged against the readings of the same log while they are written.
    rules: &[],
    is_sewn: false,
    claims: |_| false,
    refusal: |_| None,
    parts: None,
    check: |source, _, job, out| {
        Tracked::of_log(source, &job.profile.track, Needs::Commands, out)?;
        Some(Checked { format: "log", pieces: None, cut_m: None })
    },
    judge: None,
};
