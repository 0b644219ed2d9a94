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
    if !weight.is_finite() || !problem.value(&x, weight).is_finite() {
        return None;
    }
    let mut steps = 0;
    loop {
        for _ in 0..schedule.steps_a_round {
            steps += 1;
            let Some((direction, decrement)) = problem.newton(&x, weight) else { break };
            let Some(next) = line_search(problem, &x, &direction, weight, decrement) else { break };
            x = next;
            if decrement < schedule.decrement {
                break;
            }
        }
        if constraints / weight < schedule.gap * problem.objective(&x) || steps > schedule.steps {
            return Some(x);
        }
        weight *= schedule.growth;
    }
}

/// Halves the step until the value falls enough; `None` when it never does.
fn line_search<const N: usize>(
    problem: &impl Problem<N>,
    x: &[[f64; N]],
    direction: &[[f64; N]],
    weight: f64,
    decrement: f64,
) -> Option<Vec<[f64; N]>> {
    let before = problem.value(x, weight);
    let mut step = 1.0;
    while step > STEP_EPSILON {
        let moved = |(x, d): (&[f64; N], &[f64; N])| std::array::from_fn(|n| x[n] + step * d[n]);
        let next: Vec<[f64; N]> = x.iter().zip(direction).map(moved).collect();
        if problem.value(&next, weight) <= before - ARMIJO * step * decrement {
            return Some(next);
        }
        step *= 0.5;
    }
    None
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
    fn the_optimum_at_a_bound_is_approached_from_inside() {
        let schedule = Schedule { start: 0.3, growth: 8.0, gap: 1e-6, decrement: 1e-6, steps_a_round: 20, steps: 1000 };
        let x = minimise(&Bounded, vec![[0.1]], schedule).expect("a feasible start")[0][0];
        assert!(x < 1.0 && x > 1.0 - 1e-4, "{x}");
        assert!(minimise(&Bounded, vec![[2.0]], schedule).is_none());
    }
}
