//! Matching of plunges inside lines with declarations: each plunge needs a declaration of its own.

use std::collections::{BTreeMap, VecDeque};

use crate::ir::verdict::{Sighting, Worst};

/// Plunge inside a line.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Nibble {
    /// Indices of the declarations that may cover it.
    pub(super) entries: Vec<usize>,
    /// Length of the cut, mm.
    pub(super) length: f64,
    pub(super) place: Sighting,
}

/// Reports the plunges without a declaration in a maximum matching.
pub(super) fn settle(nibbles: &[Nibble], undeclared: &mut Worst) {
    let mut owners = Owners { nibbles, of: BTreeMap::new(), own: vec![None; nibbles.len()] };
    for (i, nibble) in nibbles.iter().enumerate() {
        if !owners.add(i) {
            undeclared.see(nibble.length, || nibble.place);
        }
    }
}

/// Assignment of declarations to plunges, one each.
struct Owners<'a> {
    nibbles: &'a [Nibble],
    /// Plunge of each assigned declaration.
    of: BTreeMap<usize, usize>,
    /// Declaration of each plunge.
    own: Vec<Option<usize>>,
}

impl Owners<'_> {
    /// Adds a plunge by the shortest augmenting path of the bipartite matching; `false` if there is none.
    fn add(&mut self, plunge: usize) -> bool {
        let mut reached_from: BTreeMap<usize, usize> = BTreeMap::new();
        let mut open = VecDeque::from([plunge]);
        while let Some(next) = open.pop_front() {
            for &entry in &self.nibbles[next].entries {
                if reached_from.contains_key(&entry) {
                    continue;
                }
                reached_from.insert(entry, next);
                let Some(&owner) = self.of.get(&entry) else {
                    self.give(entry, &reached_from);
                    return true;
                };
                open.push_back(owner);
            }
        }
        false
    }

    /// Augments the matching along the path that ends at a free declaration.
    fn give(&mut self, entry: usize, reached_from: &BTreeMap<usize, usize>) {
        let mut given = Some(entry);
        while let Some(entry) = given {
            let plunge = reached_from[&entry];
            self.of.insert(entry, plunge);
            given = self.own[plunge].replace(entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::verify::rules;

    /// Length of the longest plunge without a declaration; plunge i, counted from 1, has length i.
    fn left(entries: &[&[usize]]) -> f64 {
        let place = Sighting::missing(Point::origin(), 0);
        let nibble =
            |(i, entries): (usize, &&[usize])| Nibble { entries: entries.to_vec(), length: (i + 1) as f64, place };
        let nibbles: Vec<Nibble> = entries.iter().enumerate().map(nibble).collect();
        let mut worst = Worst::new(&rules::DECLARED, Some(0.0));
        settle(&nibbles, &mut worst);
        worst.value()
    }

    #[test]
    fn a_plunge_takes_another_declaration_where_that_helps_a_later_one() {
        assert_eq!(left(&[&[0, 1], &[0, 1, 2], &[0]]), 0.0);
        assert_eq!(left(&[&[0, 1], &[1], &[0, 1]]), 3.0);
        assert_eq!(left(&[&[0], &[]]), 2.0);
    }
}
