//! Pieces that may be sizes of one piece although none gives a size: blocks with equal names, or with names that differ only in
//! their last part, such as `FRONT-S`, `FRONT-M` and `FRONT-L`.

use std::collections::{BTreeMap, BTreeSet};

use super::text::Facts;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::dxf::entity::{Block, NAME};
use crate::machine::letters::Letters;
use crate::source::{Source, Span};

/// Separators before the last part of a name.
const BEFORE_LAST: [char; 5] = ['-', '_', '.', ' ', '/'];
/// Last parts of two names that are sides, not sizes.
const SIDES: [[&str; 2]; 2] = [["L", "R"], ["LEFT", "RIGHT"]];

/// Blocks with the same name.
struct Namesakes {
    first: Span,
    count: usize,
    /// Last parts of their names, in capitals; empty if a text gives the piece name.
    ends: BTreeSet<String>,
}

impl Namesakes {
    fn may_be_sizes(&self) -> bool {
        let are_sides = SIDES.iter().any(|sides| self.ends.iter().eq(sides.iter()));
        self.count > 1 && !are_sides && !self.are_numbered()
    }

    /// True if the last parts count from 1.
    fn are_numbered(&self) -> bool {
        self.ends.len() == self.count && (1..=self.count).all(|number| self.ends.contains(&number.to_string()))
    }
}

/// Reports cut blocks that may be one piece in several sizes, where no block gives a size.
pub(super) fn say(blocks: &[(&Block, &Facts)], source: &Source, letters: &Letters, out: &mut Diagnostics) {
    if blocks.iter().any(|(_, facts)| facts.size.first.is_some()) {
        return;
    }
    let mut names: BTreeMap<String, Namesakes> = BTreeMap::new();
    for (block, facts) in blocks {
        let of_block = letters.name(block.head.bytes(NAME)).to_uppercase();
        let (name, end) = match facts.name.first {
            Some(span) => (letters.name(source.slice(span)).to_uppercase(), String::new()),
            None => match of_block.rsplit_once(BEFORE_LAST) {
                Some((stem, end)) if !stem.is_empty() && !end.is_empty() => (stem.to_owned(), end.to_owned()),
                _ => continue,
            },
        };
        let of_name = Namesakes { first: block.head.span(), count: 0, ends: BTreeSet::new() };
        let of_name = names.entry(name).or_insert(of_name);
        of_name.count += 1;
        of_name.ends.extend((!end.is_empty()).then_some(end));
    }
    names.retain(|_, of_name| of_name.may_be_sizes());
    let Some((name, Namesakes { first, count, .. })) = names.first_key_value() else { return };
    let others = match names.len() {
        1 => String::new(),
        2 => ", as do those of another name".to_owned(),
        n => format!(", as do those of {} other names", n - 1),
    };
    let message = format!("{count} pieces share the name `{name}`{others}, and none gives its size: all are cut");
    let hint = "if they are sizes, leave the others out with `--skip`; `cutc manual inputs` lists the keys of sizes";
    out.push(Diagnostic::new(&code::DXF_NO_SIZES, message).at(*first).hint(hint));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_and_numbers_are_no_sizes() {
        let ends = |ends: &[&str]| Namesakes {
            first: Span::default(),
            count: ends.len(),
            ends: ends.iter().map(|end| (*end).to_owned()).collect(),
        };
        assert!(ends(&["S", "M", "L"]).may_be_sizes());
        assert!(ends(&["36", "38"]).may_be_sizes());
        assert!(!ends(&["L", "R"]).may_be_sizes());
        assert!(!ends(&["1", "2", "3"]).may_be_sizes());
        assert!(!ends(&["M"]).may_be_sizes());
    }
}
