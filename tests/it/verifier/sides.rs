//! Overlaps that go into parts: on the side that a program must spare.

use cutc::geom::Vector;

use crate::verifier::case::{Case, WIDE};
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::DAMAGING;
use crate::verifier::sketch::{along, chain, contours, edited, redraw, slit};
use crate::verifier::{Damage, damage, judge, scaled};

const PART: &str = "verify/overcut-part";
const NEIGHBOUR: &str = "verify/overcut-neighbour";
/// The rules that these damages aim at.
pub(crate) const RULES: [&str; 2] = [PART, NEIGHBOUR];

/// How deep in a part the edge of that still is, mm.
const BAND: f64 = 0.2;
/// An overlap that is harm enough, mm.
const OVERLAP: f64 = 0.8;
/// Part of an overlap by which it is seen to be in a part, at the least: it enters that at any angle.
const ENTERED: f64 = 0.9;
/// By how much an outline does not close, mm.
const AJAR: f64 = 0.01;
/// The gap between the parts of the marker that has narrow ones, mm.
const GAP: f64 = 0.5;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("overcuts at reflex corners", PART, |case, _| {
        other(case, case.on(|job| job.profile.knife.reflex_front_overlap_mm = OVERLAP))
    }),
    damage("heel cuts at reflex corners", PART, |case, _| {
        // Where the gaps are narrow only plunge cuts end at reflex corners, and lie there as deep anyway.
        let has_runs = case.name != "narrow-gaps";
        has_runs.then(|| other(case, case.on(|job| job.profile.knife.reflex_heel_overlap_mm = OVERLAP)))?
    }),
    scaled("a slit that goes too far into the part", PART, |case, rng, times| {
        let limit = case.tolerance() + BAND;
        let (old, program) = slit(case, rng, |notch| notch.tip += along(notch) * (times * limit))?;
        Some(Harm { program, amount: (DAMAGING - 1.0) * limit, place: Place::Along(vec![old.root, old.tip]) })
    }),
    damage("overlaps as if there were no parts", NEIGHBOUR, |case, _| {
        let has_gaps = case.name == "narrow-gaps";
        has_gaps.then(|| {
            // Lines that do not close bound nothing and leave room everywhere.
            let program = edited(case, |marker| {
                for (piece, contour) in contours(marker) {
                    let mut segments = chain(marker, marker.pieces[piece].contours[contour]);
                    segments.last_mut().expect("a contour has segments").to += Vector::new(AJAR, 0.0);
                    redraw(marker, [piece, contour], segments);
                }
            });
            Harm::anywhere(program, ENTERED * (WIDE - GAP))
        })
    }),
];

/// Another program than that of the case; `None` when it is the same, or the case harms its parts as much, unavoidably.
fn other(case: &Case, program: Vec<u8>) -> Option<Harm> {
    let amount = ENTERED * OVERLAP;
    let sound = judge(&case.program, &case.marker, &case.declared, &case.job);
    let harmed = sound.findings.iter().any(|finding| finding.rule.name == PART && finding.worst >= amount);
    (program != case.program && !harmed).then(|| Harm::anywhere(program, amount))
}
