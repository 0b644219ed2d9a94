//! Deviation of the body of a blade from its line: at a plunge on a curve, and while it follows one.

use super::chord::{self, BODY_SHARES};
use super::heel;
use super::stroke::{Judge, Traced};
use super::trial::Trial;
use super::worsts::Worsts;
use crate::machine::Follow;

impl Judge<'_> {
    /// Measures how far the path bows away from the plunged blade, how far the body leaves the path while the blade moves, and
    /// how deep it enters parts there. It is information without a limit: a tip on its line and a blade along it determine the
    /// position of the body.
    pub(super) fn check_body(&self, traced: &Traced, trial: &Trial, worsts: &mut Worsts) {
        if self.knife.width_mm == 0.0 {
            return;
        }
        let Worsts { body, swing, .. } = worsts;
        let Traced { stroke, cut, .. } = traced;
        for (i, foot) in trial.feet[..cut.body].iter().enumerate() {
            if foot.beyond == 0.0 && trial.held.contains(&i) {
                body.see(foot.deviation, || stroke.sighting(cut, i));
            }
        }
        // Deviation of the body on any curve: smoothing moves both the tip and the path of the heel.
        let slight = self.knife.max_bow_mm + 2.0 * self.tracer.allowed + self.sagitta;
        // In the chord mode the middle of the blade has the greatest deviation on an arc.
        let shares: &[f64] = match self.knife.follow {
            Follow::Tangent => &[0.0],
            Follow::Chord => &BODY_SHARES,
        };
        for &share in shares {
            let heels =
                || stroke.rows().iter().zip(&traced.blades).map(|(row, blade)| row.centre - blade * traced.ends[1]);
            if share == 0.0 && heel::trails(cut, heels(), trial, body.value()) {
                continue;
            }
            let feet = chord::along(stroke.rows(), self.blade(traced, trial), share);
            for ((foot, row), blade) in feet.iter().zip(stroke.rows()).zip(&traced.blades) {
                if foot.beyond > 0.0 {
                    continue;
                }
                body.see(foot.deviation, || row.sighting());
                // The excess length of a plunge cut is checked as its surplus.
                if !cut.is_plunge_cut() && foot.deviation > slight.max(swing.value()) {
                    let place = row.centre + blade * (share * self.knife.width_mm - traced.ends[1]);
                    swing.see(self.overcut.deepest(place, foot.deviation, &self.ends(cut, trial)), || row.sighting());
                }
            }
        }
    }
}
