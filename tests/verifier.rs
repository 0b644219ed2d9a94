//! The verifier is tested by damage: for every rule, programs that break it, each refused under the right code.

mod support;

#[path = "verifier/audit.rs"]
mod audit;
#[path = "verifier/case.rs"]
mod case;
#[path = "verifier/drawings.rs"]
mod drawings;
#[path = "verifier/machines.rs"]
mod machines;
#[path = "verifier/moves.rs"]
mod moves;
#[path = "verifier/names.rs"]
mod names;
#[path = "verifier/rows.rs"]
mod rows;
#[path = "verifier/texts.rs"]
mod texts;

use std::collections::BTreeSet;
use std::io::BufReader;

use cutc::ir::Marker;
use cutc::machine::{Fit, Job, MachineProfile};
use cutc::verify::{self, RULES, Verdict};
use rayon::prelude::*;

use crate::case::Case;
use crate::support::program::setpoints;

/// A way to damage a program, and the rules of which at least one must then be broken; other rules may break as well.
struct Damage {
    name: &'static str,
    rules: &'static [&'static str],
    /// The damaged program; `None` when the marker has nothing that could be damaged so.
    run: fn(&Case, &mut fastrand::Rng) -> Option<Vec<u8>>,
}

/// A row of the tables below.
const fn damage(
    name: &'static str,
    rules: &'static [&'static str],
    run: fn(&Case, &mut fastrand::Rng) -> Option<Vec<u8>>,
) -> Damage {
    Damage { name, rules, run }
}

/// Every way, from the bytes of a program to the machine that it was made for.
fn damages() -> Vec<&'static Damage> {
    [texts::DAMAGES, moves::DAMAGES, drawings::DAMAGES, machines::DAMAGES, names::DAMAGES]
        .into_iter()
        .flatten()
        .collect()
}

/// Fewer ways, damaged programs or markers to a way than these would be a test that has lost its teeth.
const WAYS: usize = 110;
const PROGRAMS: usize = 700;

fn judge(program: &[u8], marker: &Marker, job: &Job) -> Verdict {
    verify::setpoints(&mut BufReader::new(program), marker, job)
}

fn broken(verdict: &Verdict) -> Vec<&'static str> {
    verdict.broken().map(|finding| finding.rule).collect()
}

#[test]
fn an_undamaged_program_is_accepted_and_reading_it_loses_nothing() {
    for case in case::all() {
        let verdict = judge(&case.program, &case.marker, &case.job);
        assert!(verdict.passes(), "{}: {:#?}", case.name, verdict.broken().collect::<Vec<_>>());
        assert!(rows::print(&case.rows) == case.program, "{}", case.name);
    }
}

/// A change of the machine with which sound programs must stay sound.
type Setting = (&'static str, fn(&mut MachineProfile));

#[test]
fn no_setting_of_the_machine_makes_a_sound_program_refused() {
    let overlaps = |profile: &mut MachineProfile, front: f64, heel: f64| {
        let knife = &mut profile.knife;
        (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (front, front);
        (knife.heel_overlap_mm, knife.corner_heel_overlap_mm) = (heel, heel);
    };
    let settings: &[Setting] = &[
        ("no feed", |p| p.knife.feed_mm_s = None),
        ("a point", |p| (p.knife.width_mm, p.knife.back_mm) = (0.0, Some(0.0))),
        ("a narrow blade", |p| (p.knife.width_mm, p.knife.back_mm) = (2.0, Some(1.5))),
        ("a new blade", |p| (p.knife.width_mm, p.knife.back_mm) = (8.89, Some(6.35))),
        ("a wide blade", |p| (p.knife.width_mm, p.knife.back_mm) = (20.0, Some(12.0))),
        ("lifts amid long lines", |p| p.knife.max_down_mm = Some(300.0)),
        ("half a period", |p| p.time.period_ms = 0.5),
        ("four periods", |p| p.time.period_ms = 4.0),
        ("polygons", |p| p.path.fit = Fit::Polygon),
        ("a narrow tube", |p| p.path.tolerance_mm = Some(0.02)),
        ("a wide tube", |p| p.path.tolerance_mm = Some(0.3)),
        ("corners of 20 degrees", |p| p.corner.angle_deg = 20.0),
        ("no dwells", |p| (p.knife.plunge_ms, p.knife.lift_ms, p.drill.dwell_ms) = (0.0, 0.0, 0.0)),
        ("parked off the table", |p| p.park = Some([-200.0, -100.0, 45.0])),
    ];
    let cases = case::all();
    let small = ["circles", "drills-and-slits", "tight-curves-and-short-runs"];
    let check = |marker: &Marker, job: &Job, name: &str| {
        let verdict = judge(&setpoints(marker, job), marker, job);
        assert!(verdict.passes(), "{name}: {:#?}", verdict.broken().collect::<Vec<_>>());
    };
    cases.par_iter().filter(|case| small.contains(&case.name)).for_each(|case| {
        for (name, set) in settings {
            let mut job = case.job.clone();
            set(&mut job.profile);
            check(&case.marker, &job, &format!("{} with {name}", case.name));
        }
        let mut job = case.job.clone();
        overlaps(&mut job.profile, 3.0, 3.0);
        check(&case.marker, &job, &format!("{} with long overlaps", case.name));
    });
}

#[test]
fn every_damage_is_refused_under_its_rule() {
    let cases = case::all();
    let tasks: Vec<(usize, &Damage, usize)> = damages()
        .into_iter()
        .enumerate()
        .flat_map(|(i, damage)| (0..cases.len()).map(move |case| (i, damage, case)))
        .collect();
    let outcome = |&(i, damage, c): &(usize, &Damage, usize)| {
        let case = &cases[c];
        let mut rng = fastrand::Rng::with_seed((i * 1000 + c) as u64);
        let program = (damage.run)(case, &mut rng)?;
        let found = broken(&judge(&program, &case.marker, &case.job));
        let refused = damage.rules.iter().any(|rule| found.contains(rule));
        Some((i, (!refused).then(|| format!("{} of {}: broken is {found:?}", damage.name, case.name))))
    };
    let outcomes: Vec<(usize, Option<String>)> = tasks.par_iter().filter_map(outcome).collect();
    let survivors: Vec<&String> = outcomes.iter().filter_map(|(_, survivor)| survivor.as_ref()).collect();
    assert!(survivors.is_empty(), "{} of {} survive:\n{survivors:#?}", survivors.len(), outcomes.len());
    let ways: BTreeSet<usize> = outcomes.iter().map(|(i, _)| *i).collect();
    let lost: Vec<&str> =
        damages().iter().enumerate().filter(|(i, _)| !ways.contains(i)).map(|(_, damage)| damage.name).collect();
    assert!(lost.is_empty(), "these damage nothing: {lost:?}");
    assert!(ways.len() >= WAYS && outcomes.len() >= PROGRAMS, "{} ways, {} programs", ways.len(), outcomes.len());
}

#[test]
fn every_rule_with_a_limit_has_a_damage_that_aims_at_it() {
    let reported_only = ["verify/body", "verify/overcut-part", "verify/overcut-neighbour", "verify/overcut-waste"];
    let aimed: BTreeSet<&str> = damages().iter().flat_map(|damage| damage.rules).copied().collect();
    for (rule, _) in RULES.iter().filter(|(rule, _)| rule.starts_with("verify/")) {
        assert!(aimed.contains(rule) || reported_only.contains(rule), "{rule}");
    }
    assert!(aimed.iter().all(|rule| RULES.iter().any(|(code, _)| code == rule)), "{aimed:?}");
}
