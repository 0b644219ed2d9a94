//! Bounds on searches that a drawing made to be slow would keep busy for ever.

/// Comparisons of boxes, and visits of vertices, that one search over one marker may cost: some hundred times what the
/// largest real markers need, and about a second. What is left then stays unsearched, and the marker says so.
const MOST_WORK: usize = 400_000_000;

/// What one line of a large marker may cost, likewise: about ten times what the lines of real ones do.
const WORK_A_LINE: usize = 10_000;

/// How much more a search may do.
#[derive(Debug, Clone)]
pub struct Budget(usize);

impl Budget {
    /// What a search over one marker may do.
    pub fn of_a_marker() -> Self {
        Self(MOST_WORK)
    }

    /// What a search over one marker with so many lines may do: the largest take as much a line as others do.
    pub fn of_lines(count: usize) -> Self {
        Self(MOST_WORK.max(count.saturating_mul(WORK_A_LINE)))
    }

    /// The share of one of `parts` parts of a marker that are searched side by side: whichever is done first, each
    /// finds the same.
    pub fn of_a_part(parts: usize) -> Self {
        Self(MOST_WORK / parts.max(1))
    }

    /// Takes some, in comparisons of boxes; `false` when there is no more.
    pub fn spend(&mut self, amount: usize) -> bool {
        self.0 = self.0.saturating_sub(amount);
        !self.is_spent()
    }

    /// Whether there is no more: what was searched for was not looked for to the end.
    pub fn is_spent(&self) -> bool {
        self.0 == 0
    }
}
