//! Budgets that stop searches on drawings made to be slow.

/// Maximum cost of one search over one marker, in comparisons of boxes and visits of vertices: some hundred times the cost of
/// the largest real markers, about a second. The rest stays unsearched, and the marker says so.
const MOST_WORK: usize = 400_000_000;

/// Maximum cost per line of a large marker, in the same unit: about ten times the cost per line of real markers.
const WORK_A_LINE: usize = 10_000;

/// Remaining work of a search.
#[derive(Debug, Clone)]
pub struct Budget(usize);

impl Budget {
    /// The budget of a search over one marker.
    pub fn of_a_marker() -> Self {
        Self(MOST_WORK)
    }

    /// The budget of a search over a marker with `count` lines. It grows with the lines, so that the largest markers are
    /// searched as well.
    pub fn of_lines(count: usize) -> Self {
        Self(MOST_WORK.max(count.saturating_mul(WORK_A_LINE)))
    }

    /// The budget of one of `parts` parts of a marker that are searched in parallel. A fixed share for each makes the result
    /// independent of which part finishes first.
    pub fn of_a_part(parts: usize) -> Self {
        Self(MOST_WORK / parts.max(1))
    }

    /// Spends an amount, in comparisons of boxes; `false` once the budget is spent.
    pub fn spend(&mut self, amount: usize) -> bool {
        self.0 = self.0.saturating_sub(amount);
        !self.is_spent()
    }

    /// True if the budget is spent: the search is incomplete.
    pub fn is_spent(&self) -> bool {
        self.0 == 0
    }
}
