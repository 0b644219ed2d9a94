//! Damage to the rows of a program: a blade that follows another mode than the profile says.

use cutc::machine::Follow;

use crate::verifier::blades::{HEADING, erring, fade, twist};
use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::DAMAGING;
use crate::verifier::rows::{Row, parse, print, strokes};
use crate::verifier::{Damage, damage};

/// A cut that is longer than this is no notch, in widths of the blade.
const LONG: f64 = 2.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a blade along the tangent instead of the chord", HEADING, |case, _| {
        following(case, [Follow::Chord, Follow::Tangent])
    }),
    damage("a blade along the chord instead of the tangent", HEADING, |case, _| {
        following(case, [Follow::Tangent, Follow::Chord])
    }),
    damage("a heel off the line before the tip has gone a width", HEADING, |case, _| {
        let profile = &case.job.profile;
        let knife = &profile.knife;
        if knife.follow != Follow::Chord {
            return None;
        }
        let stroke = strokes(&case.rows).into_iter().find(|stroke| {
            let rows = &case.rows[stroke.clone()];
            (rows[rows.len() - 1].tip(knife) - rows[0].tip(knife)).norm() > LONG * knife.width_mm
        })?;
        let from = case.rows[stroke.start].tip(knife);
        // The tolerance band lets the heel be off on one side of the path and on the other.
        let band = (2.0 * case.tolerance() / knife.width_mm).atan().to_degrees();
        let twist = twist(case, DAMAGING) + band;
        let turned = |(i, row): (usize, &Row)| {
            let way = (row.tip(knife) - from).norm() / knife.width_mm;
            // Neither at the plunge nor behind the first width.
            let by = if stroke.contains(&i) && way < 1.0 { twist * fade(1.0 - (2.0 * way - 1.0).abs()) } else { 0.0 };
            row.turned_to(row.pose[2] + by, knife)
        };
        let rows: Vec<Row> = case.rows.iter().enumerate().map(turned).collect();
        let place = Place::During([rows[stroke.start].t, rows[stroke.end].t]);
        Some(Harm { program: print(&rows), amount: DAMAGING * profile.verify.max_heading_deg, place })
    }),
];

/// The program of a machine that should follow one mode and follows another.
fn following(case: &Case, [orientation, other]: [Follow; 2]) -> Option<Harm> {
    (case.job.profile.knife.follow == orientation)
        .then(|| erring(case, &parse(&case.on(|job| job.profile.knife.follow = other))))?
}
