//! The logarithmic barrier with Newton steps (Boyd & Vandenberghe, *Convex Optimization*, section 11.3): the one kernel of
//! both solvers of this stage.
//!
//! It starts strictly inside the constraints and every iterate stays there, so it may be stopped at any time.

/// A smooth objective under inequality constraints, over control values of `N` coordinates.
pub(super) trait Problem<const N: usize> {
    /// Number of constraints.
    fn constraints(&self) -> f64;

    /// What is to be minimised; positive.
    fn objective(&self, x: &[[f64; N]]) -> f64;

    /// `weight` times the objective, less the logarithms of the slacks; infinite outside the constraints.
    fn value(&self, x: &[[f64; N]], weight: f64) -> f64;

    /// The Newton direction of [`Problem::value`] and the square of its decrement; `None` when the numbers break down.
    fn newton(&self, x: &[[f64; N]], weight: f64) -> Option<(Vec<[f64; N]>, f64)>;
}

/// How the weight of the objective is raised, and when it is enough.
#[derive(Debug, Clone, Copy)]
pub(super) struct Schedule {
    /// First weight, in parts of constraints over objective.
    pub(super) start: f64,
    /// Growth of the weight from round to round.
    pub(super) growth: f64,
    /// The end: the duality gap in parts of the objective.
    pub(super) gap: f64,
    /// A round ends when the square of the Newton decrement falls below this.
    pub(super) decrement: f64,
    /// Bound on the Newton steps of a round: a guard, above what is needed.
    pub(super) steps_a_round: usize,
    /// Bound on all Newton steps: a guard, far above what is seen.
    pub(super) steps: usize,
}

/// Sufficient decrease of a line search, as a part of what the slope promises.
const ARMIJO: f64 = 1e-4;
/// Least factor of a line search: a smaller step makes no progress in floating point.
const STEP_EPSILON: f64 = 1e-10;

/// From a strictly feasible `x` to the optimum, as near as the schedule says; `None` when `x` is not feasible.
pub(super) fn minimise<const N: usize>(
    problem: &impl Problem<N>,
    mut x: Vec<[f64; N]>,
    schedule: Schedule,
) -> Option<Vec<[f64; N]>> {
    let constraints = problem.constraints();
    let mut weight = schedule.start * constraints / problem.objective(&x).max(f64::MIN_POSITIVE);
    let mut value = problem.value(&x, weight);
    if !weight.is_finite() || !value.is_finite() {
        return None;
    }
    let mut steps = 0;
    loop {
        for _ in 0..schedule.steps_a_round {
            steps += 1;
            let Some((direction, decrement)) = problem.newton(&x, weight) else { break };
            let line = Line { problem, from: &x, direction: &direction, weight };
            let Some(next) = line.search(value, decrement) else { break };
            (x, value) = next;
            if decrement < schedule.decrement {
                break;
            }
        }
        if constraints / weight < schedule.gap * problem.objective(&x) || steps > schedule.steps {
            return Some(x);
        }
        weight *= schedule.growth;
        value = problem.value(&x, weight);
    }
}

/// A line from an iterate in a direction.
struct Line<'a, P, const N: usize> {
    problem: &'a P,
    from: &'a [[f64; N]],
    direction: &'a [[f64; N]],
    weight: f64,
}

impl<P: Problem<N>, const N: usize> Line<'_, P, N> {
    /// Halves the step until the value, so far `before`, falls enough; the place and its value, `None` when it never does.
    fn search(&self, before: f64, decrement: f64) -> Option<(Vec<[f64; N]>, f64)> {
        let mut step = 1.0;
        while step > STEP_EPSILON {
            let moved = |(x, d): (&[f64; N], &[f64; N])| std::array::from_fn(|n| x[n] + step * d[n]);
            let next: Vec<[f64; N]> = self.from.iter().zip(self.direction).map(moved).collect();
            let value = self.problem.value(&next, self.weight);
            if value <= before - ARMIJO * step * decrement {
                return Some((next, value));
            }
            step *= 0.5;
        }
        None
    }
}

/// The sum of the logarithms of positive numbers: that of their product, taken before the product leaves the range of
/// numbers. A logarithm costs as much as all else that is done for a constraint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Logs {
    sum: f64,
    product: f64,
}

/// A product beyond these is taken as it stands: the next factor could carry it out of range.
const PRODUCT_MIN: f64 = 1e-150;
const PRODUCT_MAX: f64 = 1e150;

impl Logs {
    /// The sum of none.
    pub(super) fn new() -> Self {
        Self { sum: 0.0, product: 1.0 }
    }

    /// Adds the logarithm of a number.
    pub(super) fn add(&mut self, number: f64) {
        self.product *= number;
        if !(PRODUCT_MIN..PRODUCT_MAX).contains(&self.product) {
            self.sum += self.product.ln();
            self.product = 1.0;
        }
    }

    /// The sum.
    pub(super) fn sum(&self) -> f64 {
        self.sum + self.product.ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Least sum of x and 1/x inside 0 < x < 1: the optimum lies at the bound.
    struct Bounded;

    impl Problem<1> for Bounded {
        fn constraints(&self) -> f64 {
            1.0
        }

        fn objective(&self, x: &[[f64; 1]]) -> f64 {
            1.0 / x[0][0]
        }

        fn value(&self, x: &[[f64; 1]], weight: f64) -> f64 {
            let x = x[0][0];
            if x <= 0.0 || x >= 1.0 { f64::INFINITY } else { weight / x - (1.0 - x).ln() }
        }

        fn newton(&self, x: &[[f64; 1]], weight: f64) -> Option<(Vec<[f64; 1]>, f64)> {
            let x = x[0][0];
            let slope = -weight / (x * x) + 1.0 / (1.0 - x);
            let bend = 2.0 * weight / x.powi(3) + 1.0 / (1.0 - x).powi(2);
            Some((vec![[-slope / bend]], slope * slope / bend))
        }
    }

    #[test]
    fn logarithms_add_up_beyond_the_range_of_numbers() {
        let numbers = (0..2000).map(|i| [1e-90, 3e-3, 40.0, 1e80][i % 4] * (1.0 + i as f64));
        let mut logs = Logs::new();
        numbers.clone().for_each(|number| logs.add(number));
        let expected: f64 = numbers.map(f64::ln).sum();
        assert!((logs.sum() / expected - 1.0).abs() < 1e-12, "{} {expected}", logs.sum());
    }

    #[test]
    fn the_optimum_at_a_bound_is_approached_from_inside() {
        let schedule = Schedule { start: 0.3, growth: 8.0, gap: 1e-6, decrement: 1e-6, steps_a_round: 20, steps: 1000 };
        let x = minimise(&Bounded, vec![[0.1]], schedule).expect("a feasible start")[0][0];
        assert!(x < 1.0 && x > 1.0 - 1e-4, "{x}");
        assert!(minimise(&Bounded, vec![[2.0]], schedule).is_none());
    }
}
