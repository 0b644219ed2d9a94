//! Primal-dual barrier method with Newton steps: the kernel of both solvers of this stage.
//!
//! The method minimises the objective, with an increasing weight, minus the logarithms of the slacks s of the constraints (Boyd
//! & Vandenberghe, *Convex Optimization*, section 11.3). Each constraint also has a multiplier z that follows 1 / s by Newton
//! steps of its own (Nocedal & Wright, *Numerical Optimization*, 2nd ed., section 19.3). With z / s instead of 1 / s^2 a step
//! still knows which constraints held back the previous ones, and a round takes half as many steps. The method starts strictly
//! inside the constraints and every iterate stays there, so it may be stopped at any time.

/// A smooth objective under inequality constraints, over control values of `N` coordinates.
pub(in crate::plan) trait Problem<const N: usize> {
    /// The objective to minimise; positive, and NaN where it is undefined.
    fn objective(&self, x: &[[f64; N]]) -> f64;

    /// Computes the slacks of the constraints, in order, all positive; an error when a constraint is violated.
    fn slacks(&self, x: &[[f64; N]], slacks: &mut Vec<f64>) -> Result<(), Outside>;

    /// Number of constraints that are mere padding, with a slack of 1, and bound nothing.
    fn idle(&self) -> usize {
        0
    }

    /// The Newton direction and the squared Newton decrement; `None` on a numerical breakdown.
    fn newton(&self, x: &[[f64; N]], forces: &Forces) -> Option<(Vec<[f64; N]>, f64)>;
}

/// The point violates a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plan) struct Outside;

/// Weight and constraints of a Newton step.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Forces<'a> {
    /// Weight of the objective.
    pub(in crate::plan) weight: f64,
    /// The constraints, in order.
    pub(in crate::plan) walls: Walls<'a>,
}

/// Constraints at an iterate, in order: the fields of [`Wall`] as arrays.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Walls<'a> {
    pub(in crate::plan) slopes: &'a [f64],
    pub(in crate::plan) shares: &'a [f64],
}

impl<'a> Walls<'a> {
    /// The constraints one by one.
    pub(in crate::plan) fn iter(self) -> impl Iterator<Item = Wall> + 'a {
        self.slopes.iter().zip(self.shares).map(|(&slope, &share)| Wall { slope, share })
    }

    /// The constraints before an index, and those from it on.
    pub(in crate::plan) fn split_at(self, place: usize) -> [Self; 2] {
        let ((before, behind), (shares, others)) = (self.slopes.split_at(place), self.shares.split_at(place));
        [Self { slopes: before, shares }, Self { slopes: behind, shares: others }]
    }
}

/// A constraint at an iterate.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Wall {
    /// 1 / s: the negative derivative of -log s by s.
    pub(in crate::plan) slope: f64,
    /// z s: 1 where the multiplier equals that of the barrier, greater where the constraint holds back the next steps.
    pub(in crate::plan) share: f64,
}

impl Wall {
    /// z / s, used in place of the second derivative of -log s by s.
    pub(in crate::plan) fn bend(&self) -> f64 {
        self.share * self.slope * self.slope
    }
}

/// Schedule of the weight of the objective, and the stopping criteria.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Schedule {
    /// Initial weight, as a multiple of the number of constraints over the objective.
    pub(in crate::plan) start: f64,
    /// Growth of the weight per round.
    pub(in crate::plan) growth: f64,
    /// Final duality gap relative to the objective.
    pub(in crate::plan) gap: f64,
    /// Squared Newton decrement that ends a round, as a multiple of the number of constraints. About that share of the gap then
    /// remains to be gained, independent of their number.
    pub(in crate::plan) decrement: f64,
    /// Maximum number of Newton steps per round: a guard, above the usual need.
    pub(in crate::plan) steps_a_round: usize,
    /// Maximum number of Newton steps in total: a guard, far above the usual need.
    pub(in crate::plan) steps: usize,
}

/// Sufficient decrease in a line search, as a fraction of the decrease predicted by the slope.
const ARMIJO: f64 = 1e-4;
/// Factor on the step of a line search that went too far.
const BACKTRACK: f64 = 0.8;
/// Minimum step of a line search; a smaller step makes no progress.
const STEP_EPSILON: f64 = 1e-8;
/// Bound on [`Wall::share`] and on its inverse. It limits the ratio of two walls to its square.
const SHARE_MAX: f64 = 100.0;
/// Fraction of the final weight that counts as reached.
const WEIGHT_SHARE: f64 = 0.95;

/// Goes from a strictly feasible `x` to the optimum, within the gap of the schedule; `None` when `x` is not feasible.
pub(in crate::plan) fn minimise<const N: usize>(
    problem: &impl Problem<N>,
    x: Vec<[f64; N]>,
    schedule: Schedule,
) -> Option<Vec<[f64; N]>> {
    let mut descent = Descent::new(problem, x, schedule)?;
    loop {
        descent.round();
        let growth = descent.missing();
        if growth * WEIGHT_SHARE <= 1.0 || descent.steps > schedule.steps {
            return Some(descent.x);
        }
        descent.raise(growth.min(schedule.growth));
    }
}

/// Moves a strictly feasible `x` towards the centre of the constraints, by one round with the first weight of the schedule;
/// `None` when `x` is not feasible.
pub(in crate::plan) fn centre<const N: usize>(
    problem: &impl Problem<N>,
    x: Vec<[f64; N]>,
    schedule: Schedule,
) -> Option<Vec<[f64; N]>> {
    let mut descent = Descent::new(problem, x, schedule)?;
    descent.round();
    Some(descent.x)
}

/// State of a descent.
struct Descent<'a, P, const N: usize> {
    problem: &'a P,
    schedule: Schedule,
    x: Vec<[f64; N]>,
    /// Weighted objective minus the logarithms of the slacks.
    value: f64,
    weight: f64,
    /// Fields of [`Wall`], by constraint.
    slopes: Vec<f64>,
    shares: Vec<f64>,
    /// Number of constraints without the padding.
    count: f64,
    /// Newton steps so far.
    steps: usize,
    /// Trial point of a line search, and its slacks.
    next: Vec<[f64; N]>,
    slacks: Vec<f64>,
}

impl<'a, P: Problem<N>, const N: usize> Descent<'a, P, N> {
    /// The start, with the multipliers of the barrier; `None` when it is not feasible.
    fn new(problem: &'a P, x: Vec<[f64; N]>, schedule: Schedule) -> Option<Self> {
        let mut slacks = Vec::new();
        problem.slacks(&x, &mut slacks).ok()?;
        let slopes: Vec<f64> = slacks.iter().map(|slack| 1.0 / slack).collect();
        let shares = vec![1.0; slopes.len()];
        let count = (slopes.len() - problem.idle()) as f64;
        let objective = problem.objective(&x).max(f64::MIN_POSITIVE);
        let weight = schedule.start * count / objective;
        let value = weight * objective - logarithms(&slacks);
        let finite = weight.is_finite() && value.is_finite();
        let next = x.clone();
        finite.then_some(Self { problem, schedule, x, value, weight, slopes, shares, count, steps: 0, next, slacks })
    }

    /// Newton steps at constant weight until the iterate is near its optimum.
    fn round(&mut self) {
        let near = self.schedule.decrement * self.count;
        for _ in 0..self.schedule.steps_a_round {
            self.steps += 1;
            let walls = Walls { slopes: &self.slopes, shares: &self.shares };
            let forces = Forces { weight: self.weight, walls };
            let Some((direction, decrement)) = self.problem.newton(&self.x, &forces) else { return };
            let Some(step) = self.search(&direction, decrement) else { return };
            self.follow(step);
            if decrement < near {
                return;
            }
        }
    }

    /// Shortens the step until the value falls enough, and moves there. Returns the step length; `None` when the value never
    /// falls.
    fn search(&mut self, direction: &[[f64; N]], decrement: f64) -> Option<f64> {
        let mut step = 1.0;
        while step > STEP_EPSILON {
            for ((next, x), d) in self.next.iter_mut().zip(&self.x).zip(direction) {
                *next = std::array::from_fn(|n| x[n] + step * d[n]);
            }
            if self.problem.slacks(&self.next, &mut self.slacks).is_ok() {
                let value = self.weight * self.problem.objective(&self.next) - logarithms(&self.slacks);
                if value <= self.value - ARMIJO * step * decrement {
                    self.value = value;
                    std::mem::swap(&mut self.x, &mut self.next);
                    return Some(step);
                }
            }
            step *= BACKTRACK;
        }
        None
    }

    /// Newton step of the multipliers after a `step` of the iterate. With `ratio` = new slack / old slack, (z s) becomes ratio
    /// (1 + (z s) (1 - ratio) / step).
    fn follow(&mut self, step: f64) {
        let pace = 1.0 / step;
        for ((slope, share), slack) in self.slopes.iter_mut().zip(&mut self.shares).zip(&self.slacks) {
            let ratio = slack * *slope;
            *share = (ratio * (1.0 + *share * (1.0 - ratio) * pace)).clamp(1.0 / SHARE_MAX, SHARE_MAX);
            *slope = 1.0 / slack;
        }
    }

    /// Remaining growth factor of the weight.
    fn missing(&self) -> f64 {
        let objective = self.problem.objective(&self.x);
        if objective <= 0.0 {
            // Rounding leaves nothing of the objective, as on a straight: there is nothing to gain.
            return 0.0;
        }
        self.count / (self.schedule.gap * objective) / self.weight
    }

    /// Raises the weight. The multipliers are relative to it and grow by the same factor.
    fn raise(&mut self, growth: f64) {
        self.value += (growth - 1.0) * self.weight * self.problem.objective(&self.x);
        self.weight *= growth;
        self.shares.iter_mut().for_each(|share| *share = (*share * growth).min(SHARE_MAX));
    }
}

/// Number of factors multiplied before the range check.
const FACTORS: usize = 8;
/// Range of a product; beyond it the next factors could overflow or underflow.
const PRODUCT_MIN: f64 = 1e-150;
const PRODUCT_MAX: f64 = 1e150;

/// Sum of the logarithms of positive numbers, computed as logarithms of products within range. A logarithm costs as much as all
/// other work for a constraint.
fn logarithms(numbers: &[f64]) -> f64 {
    let (mut sum, mut product) = (0.0, 1.0_f64);
    for factors in numbers.chunks(FACTORS) {
        product *= factors.iter().product::<f64>();
        if !(PRODUCT_MIN..PRODUCT_MAX).contains(&product) {
            sum += product.ln();
            product = 1.0;
        }
    }
    sum + product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Minimum of x + 1/x inside 0 < x < 1: the optimum lies at the bound.
    struct Bounded;

    impl Problem<1> for Bounded {
        fn objective(&self, x: &[[f64; 1]]) -> f64 {
            1.0 / x[0][0]
        }

        fn slacks(&self, x: &[[f64; 1]], slacks: &mut Vec<f64>) -> Result<(), Outside> {
            let x = x[0][0];
            *slacks = vec![1.0 - x];
            if x > 0.0 && x < 1.0 { Ok(()) } else { Err(Outside) }
        }

        fn newton(&self, x: &[[f64; 1]], forces: &Forces) -> Option<(Vec<[f64; 1]>, f64)> {
            let (x, wall) = (x[0][0], forces.walls.iter().next().expect("one"));
            let slope = -forces.weight / (x * x) + wall.slope;
            let bend = 2.0 * forces.weight / x.powi(3) + wall.bend();
            Some((vec![[-slope / bend]], slope * slope / bend))
        }
    }

    const SCHEDULE: Schedule =
        Schedule { start: 0.3, growth: 8.0, gap: 1e-6, decrement: 1e-3, steps_a_round: 20, steps: 1000 };

    #[test]
    fn logarithms_add_up_beyond_the_range_of_numbers() {
        let numbers: Vec<f64> = (0..2000).map(|i| [1e-20, 3e-3, 40.0, 1e10][i % 4] * (1.0 + i as f64)).collect();
        let expected: f64 = numbers.iter().copied().map(f64::ln).sum();
        assert!((logarithms(&numbers) / expected - 1.0).abs() < 1e-12, "{} {expected}", logarithms(&numbers));
    }

    #[test]
    fn the_optimum_at_a_bound_is_approached_from_inside() {
        let x = minimise(&Bounded, vec![[0.1]], SCHEDULE).expect("a feasible start")[0][0];
        assert!(x < 1.0 && x > 1.0 - 1e-5, "{x}");
        let middle = centre(&Bounded, vec![[0.1]], SCHEDULE).expect("a feasible start")[0][0];
        assert!(middle > 0.1 && middle < 0.9, "{middle}");
        assert!(minimise(&Bounded, vec![[2.0]], SCHEDULE).is_none());
    }

    #[test]
    fn a_round_takes_but_a_few_steps() {
        let mut descent = Descent::new(&Bounded, vec![[0.1]], SCHEDULE).expect("a feasible start");
        descent.round();
        for _ in 0..4 {
            let before = descent.steps;
            descent.raise(SCHEDULE.growth);
            descent.round();
            assert!(descent.steps - before <= 6, "{} steps", descent.steps - before);
        }
    }
}
