//! What the body of a blade does beside its line: where it plunges over a curve, and where it follows one.

use super::chord::{self, BODY_SHARES};
use super::heel;
use super::stroke::{Judge, Traced};
use super::trial::Trial;
use super::worsts::Worsts;
use crate::machine::Follow;

impl Judge<'_> {
    /// How far the path bows away from the plunged blade, how far the body leaves it while the blade moves, and how deep it lies
    /// in parts there. Nothing is held against that: a tip on its line and a blade along it leave the body no other place.
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
        // So far any curve takes the body off its line: smoothing moves both the tip and what the heel follows.
        let slight = self.knife.max_bow_mm + 2.0 * self.tracer.allowed + self.sagitta;
        // In the chord mode it is the middle of the blade that leaves an arc the farthest.
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
                // What a plunge cut is longer by is judged as that.
                if !cut.is_plunge_cut() && foot.deviation > slight.max(swing.value()) {
                    let place = row.centre + blade * (share * self.knife.width_mm - traced.ends[1]);
                    swing.see(self.overcut.deepest(place, foot.deviation, &self.ends(cut, trial)), || row.sighting());
                }
            }
        }
    }
}
