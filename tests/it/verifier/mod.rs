//! The verifier is tested by damage: for every rule, programs that break it, each refused under the right code.

mod audit;
mod axes;
mod blades;
pub(crate) mod case;
mod chords;
mod drawings;
mod faked;
mod harm;
mod machines;
mod measure;
mod names;
mod outputs;
mod paths;
mod plunges;
mod rows;
mod sides;
mod sketch;
mod texts;
mod undeclared;

use std::collections::BTreeSet;
use std::io::BufReader;

use cutc::ir::Marker;
use cutc::ir::verdict::Verdict;
use cutc::machine::{Fit, Follow, Job, MachineProfile, TightCurves};
use cutc::pipeline::Declared;
use cutc::verify::{self, Ground, RULES};
use fastrand::Rng;
use rayon::prelude::*;

use crate::support::program::{declared, setpoints};
use crate::support::with_cuts;
use crate::verifier::case::Case;
use crate::verifier::harm::Harm;

/// A way to damage a program, and the rule that must then be broken; other rules may break as well.
struct Damage {
    name: &'static str,
    rule: &'static str,
    run: Run,
}

/// The damaged program; `None` when the marker has nothing that could be damaged so.
enum Run {
    /// By what breaks the rule.
    Whole(fn(&Case, &mut Rng) -> Option<Harm>),
    /// By some times what the rule allows: it is broken by three times as much, and holds with a third of it.
    Scaled(fn(&Case, &mut Rng, f64) -> Option<Harm>),
}

/// A row of the tables below.
const fn damage(name: &'static str, rule: &'static str, run: fn(&Case, &mut Rng) -> Option<Harm>) -> Damage {
    Damage { name, rule, run: Run::Whole(run) }
}

/// A row of the tables below, of a damage that can be so small that it is none.
const fn scaled(name: &'static str, rule: &'static str, run: fn(&Case, &mut Rng, f64) -> Option<Harm>) -> Damage {
    Damage { name, rule, run: Run::Scaled(run) }
}

/// Every way, from the bytes of a program to the machine that it was made for.
fn damages() -> Vec<&'static Damage> {
    let tables = [
        texts::DAMAGES,
        axes::DAMAGES,
        outputs::DAMAGES,
        blades::DAMAGES,
        paths::DAMAGES,
        drawings::DAMAGES,
        machines::DAMAGES,
        names::DAMAGES,
        sides::DAMAGES,
        chords::DAMAGES,
        undeclared::DAMAGES,
    ];
    tables.into_iter().flatten().collect()
}

/// How many programs are damaged in all, and how many a little only: fewer would be a test that has lost its teeth.
const DAMAGED_AT_LEAST: usize = 1399;
const HARMLESS_AT_LEAST: usize = 230;

fn judge(program: &[u8], marker: &Marker, declared: &Declared, job: &Job) -> Verdict {
    let marker = with_cuts(marker, job);
    verify::setpoints(&mut BufReader::new(program), Some(declared), &Ground::new(&marker, &job.profile), job)
}

#[test]
fn an_undamaged_program_is_accepted_and_reading_it_loses_nothing() {
    for case in case::all() {
        let verdict = judge(&case.program, &case.marker, &case.declared, &case.job);
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
        ("a wide blade", |p| {
            (p.knife.width_mm, p.knife.back_mm) = (20.0, Some(12.0));
            p.verify.max_overcut_part_mm = None;
        }),
        ("lifts amid long lines", |p| p.knife.max_down_mm = Some(300.0)),
        ("half a period", |p| p.time.period_ms = 0.5),
        ("four periods", |p| p.time.period_ms = 4.0),
        ("polygons", |p| p.path.fit = Fit::Polygon),
        ("a narrow tube", |p| p.path.tolerance_mm = Some(0.02)),
        ("a wide tube", |p| p.path.tolerance_mm = Some(0.3)),
        ("corners of 20 degrees", |p| p.corner.angle_deg = 20.0),
        ("no dwells", |p| (p.knife.plunge_ms, p.knife.lift_ms, p.drill.dwell_ms) = (0.0, 0.0, 0.0)),
        ("yaw", |p| p.knife.yaw_deg = 2.0),
        ("a narrow range of C", |p| p.c.range_deg = Some([-200.0, 200.0])),
        ("the blade as a chord", |p| p.knife.follow = Follow::Chord),
        ("tight curves nibbled", |p| p.knife.tight_curves = TightCurves::Nibble),
        ("parked off the table", |p| p.park = Some([-200.0, -100.0, 45.0])),
    ];
    let cases = case::all();
    let small = ["circles", "drills-and-slits", "tight-curves-and-short-runs", "chords"];
    let check = |marker: &Marker, job: &Job, name: &str| {
        let verdict = judge(&setpoints(marker, job), marker, &declared(marker, job), job);
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

/// What comes of every way with some of the markers that can be damaged so, each pair with a seed of its own: with all in
/// the heavy tests, else with one in so many, and not always the same.
fn outcomes<T: Send>(cases: &[Case], outcome: impl Fn(&'static Damage, &Case, Rng) -> Option<T> + Sync) -> Vec<T> {
    let most = cases.len().div_ceil(crate::ONE_IN);
    let of_way = |(i, damage): (usize, &'static Damage)| {
        let places = (0..cases.len()).map(|k| (i + k) % cases.len());
        let found = places.filter_map(|c| outcome(damage, &cases[c], Rng::with_seed((i * 1000 + c) as u64)));
        found.take(most).collect::<Vec<_>>()
    };
    damages().into_par_iter().enumerate().flat_map_iter(of_way).collect()
}

#[test]
fn every_damage_is_refused_under_its_rule() {
    let cases = case::all();
    let outcome = |damage: &'static Damage, case: &Case, mut rng: Rng| {
        let harm = match damage.run {
            Run::Whole(run) => run(case, &mut rng),
            Run::Scaled(run) => run(case, &mut rng, measure::DAMAGING),
        }?;
        let unseen = harm.unseen(&judge(&harm.program, &case.marker, &case.declared, &case.job), damage.rule, case);
        Some((damage.name, unseen.map(|why| format!("{} of {}: {why}", damage.name, case.name))))
    };
    let outcomes: Vec<(&str, Option<String>)> = outcomes(&cases, outcome);
    let survivors: Vec<&String> = outcomes.iter().filter_map(|(_, survivor)| survivor.as_ref()).collect();
    let ways: BTreeSet<&str> = outcomes.iter().map(|(name, _)| *name).collect();
    let lost: Vec<&str> = damages().iter().map(|damage| damage.name).filter(|name| !ways.contains(name)).collect();
    assert!(survivors.is_empty(), "{} of {} survive:\n{survivors:#?}\n{lost:?}", survivors.len(), outcomes.len());
    assert!(lost.is_empty(), "these damage nothing: {lost:?}");
    assert!(crate::ONE_IN > 1 || outcomes.len() >= DAMAGED_AT_LEAST, "{} damaged programs", outcomes.len());
}

#[test]
fn a_damage_of_a_third_of_its_limit_is_accepted() {
    let cases = case::all();
    let outcome = |damage: &'static Damage, case: &Case, mut rng: Rng| {
        let Run::Scaled(run) = damage.run else { return None };
        let harm = run(case, &mut rng, measure::HARMLESS)?;
        if harm.program == case.program {
            return Some(Some(format!("{} of {} changes nothing", damage.name, case.name)));
        }
        let mut job = case.job.clone();
        if damage.rule != "verify/c-range" {
            // C may stand at an end of its range, from where any more is too much.
            job.profile.c.range_deg = None;
        }
        let verdict = judge(&harm.program, &case.marker, &case.declared, &job);
        // A line that is drawn anew, or a little longer, may end inside a part or leave a thread: harms that have rules of
        // their own.
        let is_aside = |rule: &str| {
            sides::RULES.contains(&rule) || ["verify/declared", "verify/overlap", "verify/joint"].contains(&rule)
        };
        let broken =
            verdict.broken().filter(|finding| sides::RULES.contains(&damage.rule) || !is_aside(finding.rule.name));
        let broken: Vec<_> = broken.map(|f| (f.rule.name, f.worst, f.limit, f.place)).collect();
        Some((!broken.is_empty()).then(|| format!("{} of {}: {broken:?}", damage.name, case.name)))
    };
    let outcomes: Vec<Option<String>> = outcomes(&cases, outcome);
    let refused: Vec<&String> = outcomes.iter().flatten().collect();
    assert!(refused.is_empty(), "{} of {} are refused:\n{refused:#?}", refused.len(), outcomes.len());
    assert!(
        crate::ONE_IN > 1 || outcomes.len() >= HARMLESS_AT_LEAST,
        "{} programs with a little damage",
        outcomes.len()
    );
}

#[test]
fn every_rule_with_a_limit_has_a_damage_that_aims_at_it() {
    let reported_only = ["verify/body", "verify/swing", "verify/overcut-waste", "verify/common"];
    // Of cut files that a target writes; `tests/it/rewritten.rs` damages those.
    let of_cut_files = ["verify/same", "verify/same-place"];
    // Of parts that share edges, and of cuts that meet; `tests/it/common.rs` and `tests/it/loopholes` damage their programs.
    let of_common_lines = ["verify/joint"];
    let aimed: BTreeSet<&str> = damages().iter().map(|damage| damage.rule).collect();
    for rule in RULES.iter().map(|rule| &rule.name).filter(|rule| rule.starts_with("verify/")) {
        let judged = aimed.contains(rule)
            || reported_only.contains(rule)
            || of_cut_files.contains(rule)
            || of_common_lines.contains(rule);
        assert!(judged, "{rule}");
    }
    assert!(aimed.iter().all(|rule| RULES.iter().any(|row| row.name == *rule)), "{aimed:?}");
}
