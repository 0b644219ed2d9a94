//! Unknown keys under which every piece has a value that looks like a quantity.

use std::collections::BTreeMap;

use super::choice::Asked;
use super::key::key;
use super::quantity::quantity;
use super::text::{Facts, is_text, pairs};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::dxf::entity::Block;
use crate::source::Span;

/// Largest number that may be a quantity; sizes and style numbers are larger.
const MOST: u32 = 20;
/// Keys of the convention, and of its writers, with numbers that are no quantities, in capitals.
const OTHERS: [&str; 14] = [
    "ANNOTATION",
    "CATEGORY",
    "DATE",
    "FABRIC",
    "GRADE RULE TABLE",
    "ID",
    "MATERIAL",
    "NUMBER",
    "PIECE NUMBER",
    "RULE TABLE",
    "STYLE",
    "STYLE NAME",
    "TIME",
    "VERSION",
];
/// Maximum length of a key in a message, characters.
const SHOWN: usize = 30;

/// Uses of a key: number of pieces with it, location of the first, and whether any value differs from a single piece as drawn.
#[derive(Debug, Default)]
struct Use {
    blocks: usize,
    first: Option<Span>,
    is_more: bool,
}

/// Warns of an unknown key with a quantity-like number on every piece, if no piece gives a quantity under a known key.
pub(super) fn say(pieces: &[(&Block, &Facts)], asked: &Asked, out: &mut Diagnostics) {
    if pieces.iter().any(|(_, facts)| facts.quantity.first.is_some()) {
        return;
    }
    let text = |span: Span| asked.letters.text(asked.source.slice(span));
    let mut uses: BTreeMap<String, Use> = BTreeMap::new();
    for (block, _) in pieces {
        let texts = block.entities.iter().filter(|entity| is_text(entity));
        let mut of_block: BTreeMap<String, Span> = BTreeMap::new();
        for (name, value) in texts.flat_map(|entity| pairs(entity, asked.source, &asked.letters)) {
            let name = asked.letters.text(name).trim().to_owned();
            let is_other = OTHERS.contains(&name.to_uppercase().as_str()) || key(&name).is_some();
            let is_word = name.chars().any(char::is_alphabetic) && !name.contains(char::REPLACEMENT_CHARACTER);
            if !is_other && is_word && name.chars().count() <= SHOWN {
                of_block.entry(name).or_insert(value);
            }
        }
        for (name, value) in of_block {
            let Some(wanted) = quantity(&text(value)).filter(|wanted| wanted.times.iter().sum::<u32>() <= MOST) else {
                continue;
            };
            let of_key = uses.entry(name).or_default();
            of_key.blocks += 1;
            of_key.first = of_key.first.or(Some(value));
            of_key.is_more |= wanted.times != [1, 0];
        }
    }
    let is_quantity = |of_key: &Use| of_key.blocks == pieces.len() && of_key.is_more;
    for (name, first) in
        uses.iter().filter_map(|(name, of_key)| Some((name, of_key.first.filter(|_| is_quantity(of_key))?)))
    {
        let message = format!("every piece has `{name}: {}`, a key that is not known", text(first).trim());
        let finding = Diagnostic::new(&code::DXF_KEY, message).at(first);
        out.push(finding.hint("if that is its quantity let the CAD write `QUANTITY`; each piece is cut once"));
    }
}
