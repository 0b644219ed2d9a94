//! Nests of parts that touch, of 30 to 60 and of 400 parts: faults where edges are cut once for two parts show only where
//! there are many of them. None is refused, with whatever blade.

use std::path::Path;

use cutc::machine::{Job, Lines};
use rayon::prelude::*;

use crate::support::nests::{Dialect, Recipe, compiled};

/// Nests that are compiled, each with one of the blades: so many are all gaps and mixtures of notches with all blades.
const SEEDS: u64 = 144;
/// Width of a blade and of its back, mm.
const BLADES: [[f64; 2]; 4] = [[6.6, 6.35], [6.0, 4.0], [8.89, 6.35], [3.0, 1.5]];

/// Nests of hundreds of parts that are compiled: needles between three parts show only there.
const LARGE_SEEDS: u64 = 4;
/// Parts of each large nest.
const LARGE: usize = 400;

/// Nests that are cut in the windows of a conveyor, and the lengths of these, mm.
const SEEDS_IN_BITES: u64 = 48;
const BITES: [f64; 4] = [700.0, 850.0, 1100.0, 1600.0];

/// One of so many has edges cut once that are up to 1 mm apart.
const WIDE: u64 = 5;

/// Faults of the programs of a nest; a nest with faults is kept as a file.
fn wrong(seed: u64, recipe: &Recipe) -> Option<String> {
    let nest = recipe.nest();
    let blade = BLADES[(seed + seed / 36) as usize % BLADES.len()];
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.knife.back_mm) = (blade[0], Some(blade[1]));
    let is_wide = seed.is_multiple_of(WIDE);
    if is_wide {
        job.profile.common.lines = Lines::Within(1.0);
    }
    let targets = if blade == BLADES[0] { &["csv", "gcode"][..] } else { &["csv"] };
    let wrong: Vec<String> = targets
        .iter()
        .filter_map(|target| match compiled(&nest.text, target, &job) {
            Err(why) => Some(format!("{target}: {why}")),
            Ok((compiled, _)) if compiled.report.notches != nest.notches => {
                Some(format!("{target}: {:?}, drawn were {:?}", compiled.report.notches, nest.notches))
            }
            Ok(_) => None,
        })
        .collect();
    if wrong.is_empty() {
        return None;
    }
    let extension = if recipe.dialect == Dialect::Plot { "plt" } else { "cut" };
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("nest-{seed}.{extension}"));
    std::fs::write(&path, &nest.text).expect("the folder of the build is writable");
    let [width, back] = blade;
    let wide = if is_wide { " --set common.lines=1" } else { "" };
    let again =
        format!("cutc compile {} --set knife.width_mm={width} --set knife.back_mm={back}{wide}", path.display());
    Some(format!("{recipe:?}\n{again}\n{}", wrong.join("\n")))
}

#[test]
fn no_nest_is_refused_whatever_notches_gaps_and_blades() {
    let found: Vec<String> =
        (0..SEEDS).into_par_iter().filter_map(|seed| wrong(seed, &Recipe::of(seed, 30, 20))).collect();
    assert!(found.is_empty(), "{} of {SEEDS} nests:\n{}", found.len(), found.join("\n\n"));
}

#[test]
fn no_nest_is_refused_in_the_windows_of_a_conveyor() {
    let wrong = |seed: u64| {
        let recipe = Recipe::of(seed, 30, 20);
        let mut job = Job::default();
        let length = BITES[(seed / 3) as usize % BITES.len()];
        job.profile.bite.length_mm = Some(length);
        let compiled = compiled(&recipe.nest().text, if seed.is_multiple_of(2) { "csv" } else { "npy" }, &job);
        compiled.err().map(|why| format!("{recipe:?} in windows of {length} mm: {why}"))
    };
    let found: Vec<String> = (0..SEEDS_IN_BITES).into_par_iter().filter_map(wrong).collect();
    assert!(found.is_empty(), "{} of {SEEDS_IN_BITES} nests:\n{}", found.len(), found.join("\n\n"));
}

#[test]
fn no_nest_of_hundreds_of_parts_is_refused() {
    let large = |seed: u64| Recipe { dialect: Dialect::Plot, ..Recipe::of(7 * seed, LARGE, 0) };
    let found: Vec<String> = (0..LARGE_SEEDS).into_par_iter().filter_map(|seed| wrong(seed, &large(seed))).collect();
    assert!(found.is_empty(), "{} of {LARGE_SEEDS} nests:\n{}", found.len(), found.join("\n\n"));
}
