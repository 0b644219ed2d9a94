//! The entries of the legend: symbols with their meanings.

use super::{aside, bites, common, near};
use crate::back::target::Context;
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// An entry of the legend.
pub(super) struct Item {
    pub(super) class: &'static str,
    pub(super) symbol: Symbol,
    pub(super) meaning: String,
}

/// Symbol of an entry.
#[derive(Clone, Copy)]
pub(super) enum Symbol {
    Line,
    /// A bar, the zoomed appearance of a blade and an overlap.
    Bar,
    /// A circle with its radius, pixels.
    Circle(f64),
    Target,
}

/// The entries of a picture: the common ones, common edges, near lines, splits, then the lines of a plot that are drawn but not cut.
pub(super) fn items(context: &Context) -> impl Iterator<Item = Item> {
    let aside = aside::classes(context).map(|class| Item {
        class: aside::ASIDE,
        symbol: Symbol::Line,
        meaning: format!("{}: {}, {} m, uncut", class.name, class.count, fixed(class.length / MM_PER_M, 1)),
    });
    let all = ITEMS.iter().map(|&(class, symbol, meaning)| Item { class, symbol, meaning: meaning.to_owned() });
    let common = common::meaning(context);
    let common = common.map(|meaning| Item { class: common::COMMON, symbol: Symbol::Line, meaning });
    let near = near::meaning(context).map(|meaning| Item { class: near::NEAR, symbol: Symbol::Line, meaning });
    let border = bites::meaning(context);
    let border = border.map(|meaning| Item { class: bites::BORDER, symbol: Symbol::Line, meaning });
    all.chain(common).chain(near).chain(border).chain(aside)
}

const ITEMS: [(&str, Symbol, &str); 10] = [
    ("run", Symbol::Line, "cut, in the piece's colour"),
    ("over", Symbol::Bar, "overlap past an end"),
    ("harm", Symbol::Bar, "stab into a part"),
    ("blade", Symbol::Bar, "blade at plunge and lift"),
    ("stab", Symbol::Bar, "stab: plunge only"),
    ("plunge", Symbol::Circle(4.0), "plunge, at the tip"),
    ("lift", Symbol::Circle(3.0), "lift, at the tip"),
    ("air", Symbol::Line, "knife up (C axis)"),
    ("drill", Symbol::Target, "drill"),
    ("notch", Symbol::Line, "notch: slit or V"),
];
