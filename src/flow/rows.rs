//! Assignment of heads to rows: graph colouring of the heads that come too near to each other.
//!
//! Up to a number of heads the colouring is exact, by branch and bound in the order of DSATUR; beyond that the greedy colouring
//! in this order is used (Brelaz, *New methods to color the vertices of a graph*, CACM 22, 1979).

/// Pairs of heads that cannot stand in one row.
#[derive(Debug, Clone)]
pub(super) struct Conflicts {
    count: usize,
    pairs: Vec<bool>,
}

impl Conflicts {
    /// The conflicts among `count` heads.
    pub(super) fn new(count: usize, conflict: impl Fn(usize, usize) -> bool) -> Self {
        let mut pairs = vec![false; count * count];
        for a in 0..count {
            for b in a + 1..count {
                let found = conflict(a, b);
                pairs[a * count + b] = found;
                pairs[b * count + a] = found;
            }
        }
        Self { count, pairs }
    }

    fn has(&self, a: usize, b: usize) -> bool {
        self.pairs[a * self.count + b]
    }
}

/// Maximum number of heads for exact colouring. More heads are coloured greedily.
const EXACT: usize = 16;
/// Maximum number of search steps. The search then returns the best colouring so far.
const STEPS: usize = 200_000;

/// Row of each head, from 0; and true if this is provably the minimum number of rows.
pub(super) fn colour(conflicts: &Conflicts) -> (Vec<usize>, bool) {
    let greedy = greedy(conflicts);
    let count = |rows: &[usize]| rows.iter().max().map_or(0, |most| most + 1);
    if conflicts.count > EXACT {
        return (greedy, false);
    }
    let mut search = Search { conflicts, best: greedy.clone(), most: count(&greedy), steps: 0 };
    search.go(&mut vec![usize::MAX; conflicts.count], 0);
    (search.best, search.steps < STEPS)
}

/// The head without a row that has the most forbidden rows; of several, the one with the most conflicts.
fn next(conflicts: &Conflicts, rows: &[usize]) -> Option<usize> {
    let free = (0..conflicts.count).filter(|&head| rows[head] == usize::MAX);
    free.max_by_key(|&head| {
        let mut forbidden: Vec<usize> =
            (0..conflicts.count).filter(|&b| conflicts.has(head, b)).map(|b| rows[b]).collect();
        let degree = forbidden.len();
        forbidden.retain(|&row| row != usize::MAX);
        forbidden.sort_unstable();
        forbidden.dedup();
        (forbidden.len(), degree, usize::MAX - head)
    })
}

fn allowed(conflicts: &Conflicts, rows: &[usize], head: usize, row: usize) -> bool {
    (0..conflicts.count).all(|b| rows[b] != row || !conflicts.has(head, b))
}

fn greedy(conflicts: &Conflicts) -> Vec<usize> {
    let mut rows = vec![usize::MAX; conflicts.count];
    while let Some(head) = next(conflicts, &rows) {
        // As many rows as heads are always enough.
        rows[head] = (0..conflicts.count).find(|&row| allowed(conflicts, &rows, head, row)).unwrap_or(0);
    }
    rows
}

struct Search<'a> {
    conflicts: &'a Conflicts,
    best: Vec<usize>,
    most: usize,
    steps: usize,
}

impl Search<'_> {
    fn go(&mut self, rows: &mut Vec<usize>, used: usize) {
        self.steps += 1;
        if used >= self.most || self.steps >= STEPS {
            return;
        }
        let Some(head) = next(self.conflicts, rows) else {
            self.best.clone_from(rows);
            self.most = used;
            return;
        };
        for row in 0..=used.min(self.most.saturating_sub(1)) {
            if allowed(self.conflicts, rows, head, row) {
                rows[head] = row;
                self.go(rows, used.max(row + 1));
                rows[head] = usize::MAX;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_heads_are_coloured_with_as_few_rows_as_there_can_be() {
        // Heads of a crown graph in an order that misleads greedy colouring: two rows are enough.
        let crown = Conflicts::new(8, |a, b| a % 2 != b % 2 && a / 2 != b / 2);
        let (rows, exact) = colour(&crown);
        assert!(exact && rows.iter().all(|&row| row < 2), "{rows:?}");
        let ring = Conflicts::new(5, |a, b| (b - a) % 5 == 1 || (b - a) % 5 == 4);
        assert_eq!(colour(&ring).0.iter().max(), Some(&2));
        let many = Conflicts::new(40, |a, b| b - a < 4);
        let (rows, exact) = colour(&many);
        assert!(!exact && (0..40).all(|a| (a + 1..40.min(a + 4)).all(|b| rows[a] != rows[b])));
    }
}
