//! Execution time on a controller: the trapezoidal planner of `LinuxCNC` 2.9 for motions with a rotary axis.
//!
//! The planner plans each move from rest to rest and starts the next one while the last one decelerates (a parabolic blend).
//! For that it halves the acceleration, and it slows down at kinks so that the path deviates by at most G64 P. It makes no
//! blend arcs in this case, so the speed of a piece never exceeds sqrt(a l). Kinks are defined by the acceleration: that of an
//! arc leans towards its centre at its start, more so for a higher F. The look-ahead share is
//! the time beyond that of the same moves planned from kink to kink. The rules are those of the planner (`tp.c`, `tc.c`,
//! `blendmath.c`, `emccanon.cc`) as closed-form formulas; cycles are not simulated.

use super::buffer::{Block, Supply, durations};
use super::planner::{Move, Planner, sorted, spend};
use crate::back::target::{Limit, Spent};
use crate::geom::{Vector, left};
use crate::machine::gcode::Step;
use crate::machine::{Job, Limits};

/// Letters of the axes, in the order of their distances.
const AXES: [char; 3] = ['x', 'y', 'c'];

/// Fraction of the acceleration that an arc may use towards its centre, and the fraction then available along it.
const NORMAL_SHARE: f64 = 0.866_025_403_784_438_6;
const ALONG_SHARE: f64 = 0.5;
/// Fraction of the acceleration available to a move; the other half is reserved for the blending move.
const BLEND_SHARE: f64 = 0.5;
/// Speed at which the direction of an arc's acceleration is compared, as a fraction of F.
const LEAN_SPEED_SHARE: f64 = 0.5;
/// Cosine of the half angle below which a kink is ignored.
const KINK_MIN: f64 = 1e-3;
/// Minimum number of cycles per move.
const CYCLES_MIN: f64 = 3.0;

/// Accumulates the time of moves.
#[derive(Debug)]
pub(super) struct Pace {
    /// Limits of X, Y, C with the knife down, and with the knife up.
    limits: [[Limits; 3]; 2],
    blend: Option<f64>,
    cycle: f64,
    /// Accumulated time up to the last rest, s, in all and by limit.
    time: f64,
    spent: Vec<(Limit, f64)>,
    /// Moves that blend into each other, since the last rest.
    moves: Vec<Planned>,
}

/// A move with the limits of the machine applied.
#[derive(Debug, Clone, Copy)]
struct Planned {
    length: f64,
    /// Maximum speed, mm/s.
    speed: f64,
    /// Limit of the speed, and of the acceleration.
    limits: [Limit; 2],
    /// Acceleration along the path, mm/s2, halved to allow for blending.
    acceleration: f64,
    /// Directions of the acceleration at its ends.
    directions: [Vector; 2],
}

impl Pace {
    pub(super) fn new(job: &Job) -> Self {
        let profile = &job.profile;
        Self {
            limits: [profile.axes.limits(), profile.axes.travel_limits()],
            blend: profile.gcode.blend_mm,
            cycle: profile.time.period(),
            time: 0.0,
            spent: Vec::new(),
            moves: Vec::new(),
        }
    }

    /// The limits of a move, set by its slowest axis; `None` for a move without length.
    fn planned(&self, step: &Move) -> Option<Planned> {
        let limits = &self.limits[usize::from(step.feed.speed.is_infinite())];
        let ways = step.ways.map(f64::abs);
        let straight = step.curvature == 0.0;
        // A move of C alone is measured by its turn.
        let length = if step.length > 0.0 { step.length } else { ways[2] };
        if length == 0.0 {
            return None;
        }
        let slowest = |limit: fn(&Limits) -> f64| {
            let ways = if straight { [ways[0], ways[1], ways[2]] } else { [length, length, ways[2]] };
            let longest = |axis: usize| (ways[axis] / limit(&limits[axis]), AXES[axis]);
            let later = |a: (f64, char), b: (f64, char)| if b.0 > a.0 { b } else { a };
            let (time, axis) = later(later(longest(0), longest(1)), longest(2));
            (length / time, axis)
        };
        let ((mut most, axis), (whole, ramp)) = (slowest(|l| l.speed), slowest(|l| l.acceleration));
        let (mut limit, mut acceleration) = (Limit::Speed(axis), whole);
        if self.blend.is_some() {
            acceleration *= BLEND_SHARE;
        }
        let mut lean = 0.0;
        if !straight {
            let bent = (NORMAL_SHARE * whole / step.curvature.abs()).sqrt();
            (most, limit) = if bent < most { (bent, Limit::Acceleration(ramp)) } else { (most, limit) };
            lean = (LEAN_SPEED_SHARE * step.feed.speed.min(most)).powi(2) * step.curvature / acceleration;
            acceleration *= ALONG_SHARE;
        }
        let limit = if step.feed.speed <= most { step.feed.limit } else { limit };
        let [asked, shortest] = [step.feed.speed.min(most), length / (CYCLES_MIN * self.cycle)];
        let (speed, limit) = if shortest < asked { (shortest, Limit::Cycles) } else { (asked, limit) };
        let [start, end] = step.along;
        let start = (start + left(start) * lean).try_normalize(0.0).unwrap_or_default();
        Some(Planned {
            length,
            speed,
            limits: [limit, Limit::Acceleration(ramp)],
            acceleration,
            directions: [start, end],
        })
    }

    /// Adds the time of the moves up to a rest.
    fn rest(&mut self) {
        if self.moves.is_empty() {
            return;
        }
        let start = self.time;
        // Speed and distance that the previous move has already given to this one.
        let (mut begun, mut way) = (0.0, 0.0);
        for (i, now) in self.moves.iter().enumerate() {
            let accel = now.acceleration;
            let left = (now.length - way).max(0.0);
            let reached = (accel * left + 0.5 * begun * begun).sqrt();
            let top = reached.min(now.speed.max(begun));
            let ramps = (2.0 * top * top - begun * begun) / (2.0 * accel);
            self.time += (top - begun) / accel + (left - ramps).max(0.0) / top + top / accel;
            (begun, way) = (0.0, 0.0);
            if let (Some(next), Some(blend)) = (self.moves.get(i + 1), self.blend) {
                // The next move starts when this one falls below the blend speed, and accelerates while this one decelerates.
                let time = top.min(blended([now, next], blend)) / accel;
                begun = (time * next.acceleration).min(next.speed).min((next.acceleration * next.length).sqrt());
                way = (0.5 * begun * time).min(0.5 * next.length);
            }
        }
        self.attribute(self.time - start);
        self.moves.clear();
    }

    /// Divides the time of the moves since the last rest, s, among what limits them.
    fn attribute(&mut self, time: f64) {
        let block = |(i, planned): (usize, &Planned)| {
            let before = i.checked_sub(1).map(|before| &self.moves[before]);
            let entry = before
                .zip(self.blend)
                .map_or(0.0, |(before, blend)| at_kink([before, planned], blend).min(before.speed).min(planned.speed));
            let Planned { length, speed, acceleration, .. } = *planned;
            Block { length, speed, acceleration, entry: entry * entry, is_line: true }
        };
        let blocks: Vec<Block> = self.moves.iter().enumerate().map(block).collect();
        let free = durations(&blocks, Supply::UNLIMITED);
        // A blend may be a little faster than its kink.
        let share = (time / free.iter().sum::<f64>()).min(1.0);
        for (planned, free) in self.moves.iter().zip(&free) {
            let level = planned.length / planned.speed;
            spend(&mut self.spent, planned.limits[0], share * level);
            spend(&mut self.spent, planned.limits[1], share * (free - level));
        }
        spend(&mut self.spent, Limit::LookAhead, time - share * free.iter().sum::<f64>());
    }
}

impl Planner for Pace {
    fn go(&mut self, step: &Move) {
        if let Some(planned) = self.planned(step) {
            self.moves.push(planned);
        }
    }

    /// Every step stops the axes; its own time is not known.
    fn steps(&mut self, _: &[Step]) {
        self.rest();
    }

    fn wait(&mut self, time: f64) {
        self.rest();
        self.time += time;
        spend(&mut self.spent, Limit::Rest, time);
    }

    /// A higher F would slow an arc down at its start.
    fn best_speed(&self, length: f64, curvature: f64) -> f64 {
        let Some(tolerance) = self.blend.filter(|&tolerance| tolerance > 0.0) else { return f64::INFINITY };
        let [x, y, _] = self.limits[0];
        let whole = x.acceleration.min(y.acceleration);
        let acceleration = ALONG_SHARE * BLEND_SHARE * whole;
        // At a speed v the arc leans by v^2 k / (2 a), so it may start at 2 a sqrt(t / k) / v: this is the product of the two.
        let product = 2.0 * whole * (tolerance / curvature.abs()).sqrt();
        // The move then takes (v - product / v) / a + l / v.
        let reached = acceleration * length;
        if reached <= product { reached.sqrt() } else { (reached - product).max(product).sqrt() }
    }

    fn finish(&mut self) -> Spent {
        self.rest();
        Spent { time: self.time, limits: sorted(std::mem::take(&mut self.spent)) }
    }
}

/// Speed of a move below which the next one starts, mm/s.
fn blended([this, next]: [&Planned; 2], tolerance: f64) -> f64 {
    let reached = |planned: &Planned| (planned.acceleration * planned.length).sqrt().min(planned.speed);
    let [now, then] = [this, next].map(reached);
    let longest = (this.length / now).min(next.length / then);
    let time = longest.min((now / this.acceleration).max(then / next.acceleration));
    now.min(time * this.acceleration).min(at_kink([this, next], tolerance))
}

/// Speed at a kink at which the corner is cut by a tolerance, mm/s; infinite if there is no kink.
fn at_kink([this, next]: [&Planned; 2], tolerance: f64) -> f64 {
    // Half the angle between one direction and the reverse of the other: a right angle without a kink.
    let straight = this.directions[1].dot(&next.directions[0]).clamp(-1.0, 1.0);
    let cosine = (0.5 * (1.0 - straight)).sqrt();
    if tolerance > 0.0 && cosine > KINK_MIN {
        // Decelerating from v takes v^2 / (2 a), of which the corner may be cut by the tolerance.
        return 2.0 * (this.acceleration * tolerance / cosine).sqrt();
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::gcode::pace::planner::Feed;
    use crate::back::target::Limit;

    fn line(length: f64, along: Vector) -> Move {
        let ways = [length * along.x, length * along.y, 1e-9];
        let feed = Feed { speed: 200.0, limit: Limit::Feed };
        Move { ways, length, feed, along: [along; 2], curvature: 0.0 }
    }

    fn time(moves: &[Move]) -> f64 {
        let mut pace = Pace::new(&Job::default());
        for step in moves {
            pace.go(step);
        }
        pace.finish().time
    }

    #[test]
    fn a_lone_move_is_a_trapezoid() {
        let along = Vector::new(1.0, 0.0);
        // Half the acceleration, though no move blends in.
        assert!((time(&[line(100.0, along)]) - (100.0 / 200.0 + 200.0 / 4000.0)).abs() < 1e-9);
        assert!((time(&[line(2.0, along)]) - 2.0 * (2.0_f64 / 4000.0).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn long_moves_that_go_on_straight_lose_little_and_short_ones_crawl() {
        let along = Vector::new(0.6, 0.8);
        let long = time(&[line(100.0, along); 10]);
        assert!((5.0..5.2).contains(&long), "{long}");
        // Half the acceleration: at most sqrt(4000 * 1) = 63 mm/s.
        let short = time(&vec![line(1.0, along); 1000]);
        assert!((12.0..18.0).contains(&short), "{short}");
    }

    #[test]
    fn a_kink_slows_down_as_far_as_the_tolerance_asks() {
        let corner = [line(100.0, Vector::new(1.0, 0.0)), line(100.0, Vector::new(0.0, 1.0))];
        let (rounded, straight) = (time(&corner), time(&[corner[0]; 2]));
        assert!(rounded > straight + 0.02, "{rounded} {straight}");
    }
}
