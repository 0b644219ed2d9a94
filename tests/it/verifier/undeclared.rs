//! What a program does beside the drawing and does not say.

use cutc::machine::TightCurves;

use crate::verifier::case::Case;
use crate::verifier::harm::Harm;
use crate::verifier::{Damage, damage};

const DECLARED: &str = "verify/declared";

/// The farthest that a knife stays down on a machine that lifts it amid lines, mm.
const DOWN: f64 = 60.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("lifts amid lines that nobody declared", DECLARED, |case, _| {
        let program = case.on(|job| job.profile.knife.max_down_mm = Some(DOWN));
        let has_long = case.name != "tight-curves-and-short-runs" && case.name != "chords";
        has_long.then(|| Harm::anywhere(program, case.job.profile.knife.width_mm))
    }),
    damage("a curve that is nibbled and nobody declared", DECLARED, |case: &Case, _| {
        let program = case.on(|job| job.profile.knife.tight_curves = TightCurves::Nibble);
        (case.name == "tight-curves-and-short-runs").then(|| Harm::anywhere(program, 0.1))
    }),
];
