//! The machines of the sewing floor, a row of [`MACHINES`] each.
//!
//! Receives names, jobs and programs, promises the functions of their machine. Commands read rows and know no machine by name.
//! Plans nothing: the pipelines behind the rows do.
//!
//! A new machine needs a pipeline of its own (plan and targets), a file here that ends in its `MACHINE`, and its row.

mod cutter;
pub mod flow;
mod machine;
mod sew;
mod spray;
mod track;

pub use machine::{Checked, Claim, Compile, Judge, Listed, Machine, Part, Parts, Tool, Written};

use crate::machine::Job;

/// Every machine; the first is the default.
pub const MACHINES: &[Machine] = &[cutter::MACHINE, sew::MACHINE, flow::MACHINE, spray::MACHINE, track::MACHINE];

/// The machine that the tool of a profile makes of `cutc compile`.
pub fn of(job: &Job) -> &'static Machine {
    let is_for = |tool: &Tool| tool.kinds.contains(&job.profile.tool.kind);
    MACHINES.iter().find(|machine| machine.tool.as_ref().is_some_and(is_for)).expect("every tool has a machine")
}

/// The planner of a job that `cutc compile` does.
pub fn tool_of(job: &Job) -> &'static Tool {
    of(job).tool.as_ref().expect("it was found by its tool")
}

/// The machine of a program by its name or provenance; `None` if only the bytes may tell.
pub fn claimant(claim: Claim) -> Option<&'static Machine> {
    MACHINES.iter().find(|machine| (machine.claims)(claim))
}

/// True if programs of a target are judged by any machine that has a target of this name.
pub fn is_judged(target: &str) -> bool {
    let judged = MACHINES.iter().filter(|machine| machine.judge.is_some());
    let mut targets = judged.flat_map(|machine| (machine.targets)());
    targets.any(|listed| listed.name == target && listed.is_judged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::keys::{self, Takes};
    use crate::machine::load;

    #[test]
    fn every_tool_of_a_profile_has_one_machine() {
        let Takes::Word(words) = keys::find("tool.kind").expect("a key").takes else { panic!("it takes a word") };
        for word in words() {
            let profile = load(None, &[format!("tool.kind={word}")]).unwrap_or_else(|_| panic!("{word} is legal"));
            let job = Job { profile, ..Job::default() };
            let has = |machine: &&Machine| {
                machine.tool.as_ref().is_some_and(|tool| tool.kinds.contains(&job.profile.tool.kind))
            };
            assert_eq!(MACHINES.iter().filter(has).count(), 1, "{word}");
            assert!(of(&job).judge.is_some(), "{word}");
        }
    }

    #[test]
    fn machines_have_names_and_rules_of_their_own() {
        for (i, machine) in MACHINES.iter().enumerate() {
            assert!(MACHINES[..i].iter().all(|other| other.name != machine.name), "{}", machine.name);
            for rule in machine.rules {
                let others = MACHINES.iter().filter(|other| other.name != machine.name);
                assert!(others.flat_map(|other| other.rules).all(|other| other.name != rule.name), "{}", rule.name);
            }
        }
    }
}
