//! Bulge of a chord: distance from the chord to the curve that was flattened to it.
//!
//! CAD flattens curves to chords with their ends on the curve. An arc of chord L that turns by t from end to end rises L t / 8
//! above the middle of the chord. The turn of the arc is taken as the mean of the turns at both ends of the chord.

use crate::geom::polyline;
use crate::machine::Fit;
use crate::machine::MachineProfile;

/// Turn that counts as none, rad: an overlap is straight except for rounding.
const TURN_EPSILON: f64 = 1e-6;

/// Height of the curve above the middle of a chord of `length` mm with these turns at its ends (rad, left positive), mm:
/// positive to the left of the chord, at most `path.chord_sag_max_mm` in size. Zero where the path turns back, at corners, on
/// chords too long for a curve, and if the profile fits no curves.
pub fn bulge(length: f64, [before, after]: [f64; 2], profile: &MachineProfile) -> f64 {
    let corner = profile.corner_angle();
    let is_turn = |turn: f64| turn.abs() > TURN_EPSILON && turn.abs() < corner;
    let is_curve = before * after > 0.0 && is_turn(before) && is_turn(after) && length <= polyline::CURVE_CHORD_MAX;
    if profile.path.fit == Fit::Polygon || !is_curve {
        return 0.0;
    }
    let mean = f64::midpoint(before, after);
    // A path that turns left lies to the right of its chords.
    -mean.signum() * (length * mean.abs() / 8.0).min(profile.path.chord_sag_max_mm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chord_of_a_curve_bulges_to_the_outside() {
        let mut profile = MachineProfile::default();
        let is_near = |height: f64, expected: f64| (height - expected).abs() < 1e-12;
        // 8 mm of a circle of 64 mm turn by 1/8 rad: the sagitta is L^2 / (8 R).
        assert!(is_near(bulge(8.0, [0.125, 0.125], &profile), -0.125));
        assert!(is_near(bulge(8.0, [-0.2, -0.05], &profile), 0.125));
        assert!(is_near(bulge(12.0, [0.2, 0.2], &profile), -profile.path.chord_sag_max_mm));
        let straight = [[0.1, -0.1], [0.1, 0.0], [0.1, profile.corner_angle()]];
        assert_eq!(straight.map(|turns| bulge(8.0, turns, &profile)), [0.0; 3]);
        assert_eq!(bulge(polyline::CURVE_CHORD_MAX + 1.0, [0.1; 2], &profile), 0.0);
        profile.path.fit = Fit::Polygon;
        assert_eq!(bulge(8.0, [0.1; 2], &profile), 0.0);
    }
}
