//! What a program does beside the drawing and does not say, and a knife that does nothing.

use cutc::machine::TightCurves;

use crate::verifier::case::Case;
use crate::verifier::harm::Harm;
use crate::verifier::rows::{pick, print, renumber, strokes};
use crate::verifier::{Damage, damage};

const DECLARED: &str = "verify/declared";
const OVERLAP: &str = "verify/overlap";
const CRAWL: &str = "verify/crawl";

/// How long a knife rests in the cloth, s.
const REST: f64 = 20.0;

/// The farthest that a knife stays down on a machine that lifts it amid lines, mm.
const DOWN: f64 = 60.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("lifts amid lines that nobody declared", DECLARED, |case, _| {
        let program = case.on(|job| job.profile.knife.max_down_mm = Some(DOWN));
        let has_long = case.name != "tight-curves-and-short-runs" && case.name != "chords";
        has_long.then(|| Harm::anywhere(program, case.job.profile.knife.width_mm))
    }),
    damage("overlaps that are left out", OVERLAP, |case, _| {
        let program = case.on(|job| {
            (job.profile.knife.front_overlap_mm, job.profile.knife.corner_front_overlap_mm) = (0.0, 0.0);
        });
        (case.name == "spaced-four-pieces").then(|| Harm::anywhere(program, 0.7))
    }),
    damage("a knife that rests in the cloth", CRAWL, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let at = stroke.end - 1;
        let period = case.job.profile.time.period();
        let mut rows = case.rows.clone();
        let rest = vec![rows[at]; (REST / period) as usize];
        rows.splice(at..at, rest);
        renumber(&mut rows, period);
        Some(Harm::anywhere(print(&rows), 4.5))
    }),
    damage("a curve that is nibbled and nobody declared", DECLARED, |case: &Case, _| {
        let program = case.on(|job| job.profile.knife.tight_curves = TightCurves::Nibble);
        (case.name == "tight-curves-and-short-runs").then(|| Harm::anywhere(program, 0.1))
    }),
];
