//! Choices of moves that a controller times rightly, for `gcode.moves = "auto"`.
//!
//! G93 and G94 ask for the same speeds, so the mode of the profile is kept wherever the controller times it rightly. Chords are
//! never coarser than the profile permits. Finer ones have smaller kinks, but more moves.

use super::step::Step;
use super::{Dialect, FeedCounts, FeedMode, Gcode, Moves};

/// Fractions of the permitted deviations of chords that are tried.
const CHORD_SHARES: [f64; 2] = [1.0, 0.5];

impl Gcode {
    /// The choices, each as a controller with fixed moves; the first one of equally fast ones is preferred. There is always one.
    pub fn choices(&self) -> Vec<Self> {
        match self.moves {
            Moves::Fixed => vec![self.clone()],
            Moves::Auto => {
                let fixed = Self { moves: Moves::Fixed, ..self.clone() };
                let lines = CHORD_SHARES.map(|share| Self {
                    arcs: false,
                    chord_mm: share * self.chord_mm,
                    heading_tolerance_deg: share * self.heading_tolerance_deg,
                    ..fixed.clone()
                });
                let shapes = self.arcs.then_some(fixed).into_iter().chain(lines);
                shapes.filter_map(Self::timed_rightly).collect()
            }
        }
    }

    /// True if the controller mistimes arcs in inverse time.
    pub fn mistimes_arcs(&self) -> bool {
        self.arcs && self.feed_mode == FeedMode::G93 && !self.divides_inverse_time()
    }

    /// True if it divides the time of an arc among its chords. Controllers that count the degrees of the rotary axis multiply F
    /// by the number of chords and then take it for a speed, so that the arc takes the length of a chord times as long as asked
    /// (grblHAL and `FluidNC`, `mc_arc`). `RepRapFirmware` gives each chord the time of the whole arc (`GCodes::ReadMove` copies
    /// `feedRate`, `DDA::InitStandardMove` divides the distance of the chord by it).
    pub fn divides_inverse_time(&self) -> bool {
        self.dialect == Dialect::Rs274 && self.feed_counts == FeedCounts::Linear
    }

    /// The controller with its feed mode, or with the other one if it would misread that; `None` if it misreads both.
    fn timed_rightly(self) -> Option<Self> {
        let other = match self.feed_mode {
            FeedMode::G93 => FeedMode::G94,
            FeedMode::G94 => FeedMode::G93,
        };
        let modes = [self.feed_mode, other];
        modes.into_iter().map(|feed_mode| Self { feed_mode, ..self.clone() }).find(Self::is_timed_rightly)
    }

    /// True if F is read as it is meant: that of arcs, and that of moves of Z, which is a speed.
    fn is_timed_rightly(&self) -> bool {
        let has_feed = |steps: &Vec<Step>| steps.iter().any(Step::has_feed);
        let of_tools = [&self.knife_down, &self.knife_up, &self.drill_down, &self.drill_up];
        let of_pauses = [&self.stop, &self.advance];
        let misreads_z = self.feed_mode == FeedMode::G93 && of_tools.into_iter().chain(of_pauses).any(has_feed);
        !self.mistimes_arcs() && !misreads_z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(keys: &Gcode, expected: &[(bool, FeedMode, f64)]) {
        let choices = keys.choices();
        let found: Vec<_> = choices.iter().map(|keys| (keys.arcs, keys.feed_mode, keys.chord_mm)).collect();
        assert_eq!(found, expected);
        assert!(choices.iter().all(|keys| keys.moves == Moves::Fixed));
    }

    #[test]
    fn arcs_and_finer_and_finer_lines_are_tried_in_the_mode_of_the_profile_where_that_is_right() {
        use FeedMode::{G93, G94};
        let auto = Gcode { moves: Moves::Auto, chord_mm: 0.008, ..Gcode::default() };
        check(&Gcode { moves: Moves::Fixed, ..auto.clone() }, &[(true, G94, 0.008)]);
        check(&auto, &[(true, G94, 0.008), (false, G94, 0.008), (false, G94, 0.004)]);
        let inverse = Gcode { feed_mode: G93, ..auto.clone() };
        check(&inverse, &[(true, G93, 0.008), (false, G93, 0.008), (false, G93, 0.004)]);
        let grbl = Gcode { feed_counts: FeedCounts::All, ..inverse };
        check(&grbl, &[(true, G94, 0.008), (false, G93, 0.008), (false, G93, 0.004)]);
        // A controller that knows no arcs is given none.
        check(&Gcode { arcs: false, ..auto }, &[(false, G94, 0.008), (false, G94, 0.004)]);
        let slow = "G1 Z-2 F600".parse::<Step>().expect("a step");
        let plunge = Gcode { arcs: false, knife_down: vec![slow], ..grbl };
        check(&plunge, &[(false, G94, 0.008), (false, G94, 0.004)]);
    }
}
