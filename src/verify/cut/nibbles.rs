//! Plunges amid lines and the declarations that they may be known by: each plunge needs one of its own.

use std::collections::{BTreeMap, VecDeque};

use crate::ir::verdict::{Sighting, Worst};

/// A plunge amid a line.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Nibble {
    /// The declarations that may be its own, by their places.
    pub(super) entries: Vec<usize>,
    /// Length of what it cuts, mm.
    pub(super) length: f64,
    pub(super) place: Sighting,
}

/// Sees the plunges that are left over when as many as can be have a declaration of their own.
pub(super) fn settle(nibbles: &[Nibble], undeclared: &mut Worst) {
    let mut owners = Owners { nibbles, of: BTreeMap::new(), own: vec![None; nibbles.len()] };
    for (i, nibble) in nibbles.iter().enumerate() {
        if !owners.add(i) {
            undeclared.see(nibble.length, || nibble.place);
        }
    }
}

/// Declarations that are given to plunges, one each.
struct Owners<'a> {
    nibbles: &'a [Nibble],
    /// The plunge of each declaration that is given.
    of: BTreeMap<usize, usize>,
    /// The declaration of each plunge.
    own: Vec<Option<usize>>,
}

impl Owners<'_> {
    /// Whether a further plunge gets a declaration: a free one, or one whose plunge takes another. The shortest augmenting
    /// path of a bipartite matching.
    fn add(&mut self, plunge: usize) -> bool {
        let mut asked: BTreeMap<usize, usize> = BTreeMap::new();
        let mut open = VecDeque::from([plunge]);
        while let Some(next) = open.pop_front() {
            for &entry in &self.nibbles[next].entries {
                if asked.contains_key(&entry) {
                    continue;
                }
                asked.insert(entry, next);
                let Some(&owner) = self.of.get(&entry) else {
                    self.give(entry, &asked);
                    return true;
                };
                open.push_back(owner);
            }
        }
        false
    }

    /// Gives a declaration to the plunge that asked for it, what that had to the one that asked for this, and so on.
    fn give(&mut self, entry: usize, asked: &BTreeMap<usize, usize>) {
        let mut given = Some(entry);
        while let Some(entry) = given {
            let plunge = asked[&entry];
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

    /// The length of the longest plunge that is left over; plunges are as long as their numbers, from 1.
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
