//! Limits at places of a run. All limits of a place, and the gradients of the barrier, follow from three numbers: the unknown b
//! and its first two derivatives b' and b'' (see [`super::profile()`]). Several places are evaluated at once.

use wide::f64x4;

use crate::machine::Limits;
use crate::plan::orientation::Axes;

/// Number of constraints at a place: the speed, and both signs of acceleration and jerk of three axes.
pub(super) const BOUNDS: usize = 13;
/// Index of the first constraint of each kind: three axes with one sign, then with the other.
const ACCELERATION: usize = 1;
const JERK: usize = 7;
/// Minimum slope of an axis that bounds its speed; smaller slopes allow any speed.
const SLOPE_EPSILON: f64 = 1e-12;

/// Number of places evaluated at once.
pub(super) const LANES: usize = 4;

/// b, b' and b''.
pub(super) type Pace = [f64; 3];

/// Constraint values at several places, one SIMD lane per place.
pub(super) type Bounded = [f64x4; BOUNDS];

/// Coefficients of the limits at a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    /// Inverse of the greatest b that the speed limits allow.
    speed: f64,
    /// Acceleration of each axis relative to its limit, as coefficients of b and b'.
    acceleration: [[f64; 2]; 3],
    /// Jerk of each axis relative to its limit, without the factor sqrt(b), as coefficients of b, b' and b''.
    jerk: [[f64; 3]; 3],
}

/// Coefficients of the limits at several places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loads {
    speed: f64x4,
    acceleration: [[f64x4; 2]; 3],
    jerk: [[f64x4; 3]; 3],
}

/// Second-order models of the barrier by b, b' and b'' at several places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Models {
    slope: [[f64; LANES]; 3],
    /// Lower triangle of the Hessian, row by row.
    bend: [[f64; LANES]; 6],
}

/// Second-order model of the barrier at one place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Model {
    pub(super) slope: [f64; 3],
    /// Lower triangle of the Hessian, row by row.
    pub(super) bend: [f64; 6],
}

impl Load {
    /// The limits for a state of the axes; `feed` is the speed cap of the tip, mm/s.
    pub(super) fn new(axes: &Axes, limits: &[Limits; 3], feed: f64) -> Self {
        let [_, q1, q2, q3] = axes.q;
        let mut speed = (axes.pace / feed).powi(2);
        for (q1, limits) in q1.iter().zip(limits) {
            speed = speed.max((q1.abs().max(SLOPE_EPSILON) / limits.speed).powi(2));
        }
        let acceleration = std::array::from_fn(|k| [q2[k], 0.5 * q1[k]].map(|part| part / limits[k].acceleration));
        let jerk = std::array::from_fn(|k| [q3[k], 1.5 * q2[k], 0.5 * q1[k]].map(|part| part / limits[k].jerk));
        Self { speed, acceleration, jerk }
    }

    /// Greatest use of the limits on speed, acceleration and jerk, as fractions. When b, b' and b'' grow by one factor, the
    /// first two grow by it and the last by its power 3/2.
    pub(super) fn parts(&self, pace: &Pace) -> [f64; 3] {
        let greatest = |parts: [f64; 3]| parts.iter().fold(0.0_f64, |greatest, part| greatest.max(part.abs()));
        let a = greatest(self.acceleration.map(|a| acceleration(&a, pace)));
        let j = greatest(self.jerk.map(|j| jerk(&j, pace)));
        [self.speed * pace[0], a, j * pace[0].sqrt()]
    }
}

fn acceleration(c: &[f64; 2], pace: &Pace) -> f64 {
    c[0] * pace[0] + c[1] * pace[1]
}

/// Jerk without the factor sqrt(b).
fn jerk(c: &[f64; 3], pace: &Pace) -> f64 {
    c[0] * pace[0] + c[1] * pace[1] + c[2] * pace[2]
}

/// One coefficient at several places; 0 in unused lanes.
fn lanes(loads: &[Load], part: impl Fn(&Load) -> f64) -> f64x4 {
    f64x4::new(std::array::from_fn(|lane| loads.get(lane).map_or(0.0, &part)))
}

impl Loads {
    /// The limits at several places; unused lanes are unlimited.
    pub(super) fn of(loads: &[Load]) -> Self {
        Self {
            speed: lanes(loads, |load| load.speed),
            acceleration: std::array::from_fn(|k| {
                std::array::from_fn(|i| lanes(loads, |load| load.acceleration[k][i]))
            }),
            jerk: std::array::from_fn(|k| std::array::from_fn(|i| lanes(loads, |load| load.jerk[k][i]))),
        }
    }

    /// Slacks of all constraints; zero or negative where a constraint is violated.
    pub(super) fn slacks(&self, pace: &[f64x4; 3]) -> Bounded {
        let root = pace[0].sqrt();
        let a = self.acceleration.map(|c| c[0] * pace[0] + c[1] * pace[1]);
        let j = self.jerk.map(|c| root * (c[0] * pace[0] + c[1] * pace[1] + c[2] * pace[2]));
        let mut slacks = [f64x4::ONE; BOUNDS];
        slacks[0] -= self.speed * pace[0];
        for k in 0..3 {
            slacks[ACCELERATION + k] -= a[k];
            slacks[ACCELERATION + 3 + k] += a[k];
            slacks[JERK + k] -= j[k];
            slacks[JERK + 3 + k] += j[k];
        }
        slacks
    }

    /// The models of the barrier for walls with these slopes and shares. They use g g^T for each constraint, so they are
    /// positive definite everywhere.
    pub(super) fn models(&self, pace: &[f64x4; 3], slopes: &Bounded, shares: &Bounded) -> Models {
        let bends: Bounded = std::array::from_fn(|i| shares[i] * slopes[i] * slopes[i]);
        let root = pace[0].sqrt();
        let half = f64x4::splat(0.5) / root;
        let none = f64x4::ZERO;
        let mut slope = [self.speed * slopes[0], none, none];
        let mut bend = [self.speed * self.speed * bends[0], none, none, none, none, none];
        for k in 0..3 {
            let [c0, c1] = self.acceleration[k];
            let (up, down) = (ACCELERATION + k, ACCELERATION + 3 + k);
            let (force, stiffness) = (slopes[up] - slopes[down], bends[up] + bends[down]);
            slope[0] += force * c0;
            slope[1] += force * c1;
            bend[0] += stiffness * c0 * c0;
            bend[1] += stiffness * c0 * c1;
            bend[2] += stiffness * c1 * c1;
            // Gradient of sqrt(b) (c . pace).
            let c = &self.jerk[k];
            let whole = c[0] * pace[0] + c[1] * pace[1] + c[2] * pace[2];
            let g = [root * c[0] + half * whole, root * c[1], root * c[2]];
            let (up, down) = (JERK + k, JERK + 3 + k);
            let (force, stiffness) = (slopes[up] - slopes[down], bends[up] + bends[down]);
            for (slope, g) in slope.iter_mut().zip(g) {
                *slope += force * g;
            }
            let h = g.map(|g| stiffness * g);
            bend[0] += h[0] * g[0];
            bend[1] += h[1] * g[0];
            bend[2] += h[1] * g[1];
            bend[3] += h[2] * g[0];
            bend[4] += h[2] * g[1];
            bend[5] += h[2] * g[2];
        }
        Models { slope: slope.map(f64x4::to_array), bend: bend.map(f64x4::to_array) }
    }
}

impl Models {
    /// The model at one of the places.
    pub(super) fn at(&self, lane: usize) -> Model {
        Model { slope: self.slope.map(|slope| slope[lane]), bend: self.bend.map(|bend| bend[lane]) }
    }
}

impl Model {
    /// The product of the Hessian with vectors of b, b' and b'', one per lane.
    pub(super) fn times(&self, v: &[f64x4; 3]) -> [f64x4; 3] {
        let [b00, b10, b11, b20, b21, b22] = self.bend.map(f64x4::splat);
        [
            b00 * v[0] + b10 * v[1] + b20 * v[2],
            b10 * v[0] + b11 * v[1] + b21 * v[2],
            b20 * v[0] + b21 * v[1] + b22 * v[2],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load() -> Load {
        let q = [[1.0, 2.0, 0.1], [0.8, -0.6, 0.02], [0.004, 0.003, -0.001], [-0.0005, 0.0002, 0.000_3]];
        let limits = [(1200.0, 8000.0, 2e5), (1100.0, 9000.0, 3e5), (18.0, 350.0, 17_000.0)];
        let limits = limits.map(|(speed, acceleration, jerk)| Limits { speed, acceleration, jerk });
        Load::new(&Axes { q, pace: 1.0 }, &limits, 760.0)
    }

    const PACE: Pace = [9e4, 300.0, -40.0];

    /// Slacks at one place, in the last used lane of a partly filled set.
    fn slacks(load: Load, pace: &Pace) -> [f64; BOUNDS] {
        let slacks = Loads::of(&[load; LANES - 1]).slacks(&pace.map(f64x4::splat));
        assert!(slacks.iter().all(|slacks| slacks.to_array()[LANES - 1] == 1.0), "nothing is limited beyond the last");
        slacks.map(|slacks| slacks.to_array()[LANES - 2])
    }

    #[test]
    fn what_is_left_of_a_limit_is_the_slack() {
        let load = load();
        let used = load.parts(&PACE).into_iter().fold(0.0, f64::max);
        let least = slacks(load, &PACE).into_iter().fold(f64::INFINITY, f64::min);
        assert!((used + least - 1.0).abs() < 1e-12, "{used} {least}");
        let grown = load.parts(&PACE.map(|v| 4.0 * v));
        let expected = load.parts(&PACE);
        for (grown, expected) in grown.into_iter().zip([4.0 * expected[0], 4.0 * expected[1], 8.0 * expected[2]]) {
            assert!((grown / expected - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_model_has_the_slope_of_the_barrier_and_its_bend_along_straight_constraints() {
        let load = load();
        let barrier = |pace: &Pace| -slacks(load, pace).iter().map(|slack| slack.ln()).sum::<f64>();
        let slopes = slacks(load, &PACE).map(|slack| f64x4::splat(1.0 / slack));
        let models = Loads::of(&[load]).models(&PACE.map(f64x4::splat), &slopes, &[f64x4::ONE; BOUNDS]);
        let model = models.at(0);
        for k in 0..3 {
            let step = [1.0, 1e-2, 1e-3][k];
            let moved = |by: f64| std::array::from_fn(|i| if i == k { PACE[i] + by } else { PACE[i] });
            let [before, behind] = [-step, step].map(|by| barrier(&moved(by)));
            let numeric = (behind - before) / (2.0 * step);
            assert!((model.slope[k] / numeric - 1.0).abs() < 1e-5, "{k}: {} {numeric}", model.slope[k]);
            // In b'' all constraints are linear, and in b' too.
            let unit = std::array::from_fn(|i| f64x4::splat(f64::from(u8::from(i == k))));
            let numeric = (behind - 2.0 * barrier(&PACE) + before) / (step * step);
            let bend = model.times(&unit)[k].to_array()[0];
            assert!(k == 0 || (bend / numeric - 1.0).abs() < 1e-3, "{k}: {bend} {numeric}");
        }
    }
}
