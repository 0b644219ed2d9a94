//! Values of options from the tables of the stages: clap lists and explains them, and names the nearest to a mistyped one.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::front::{DIALECTS, Dialect};
use crate::ir::Target;
use crate::machine::keys::{self, Takes};
use crate::machine::{patterns, plot};
use crate::machines::{MACHINES, Machine};
use crate::manual::{PAGES, Page};
use crate::pass::marker::MARKER_PASSES;
use crate::pass::toolpath::TOOLPATH_PASSES;
use crate::sew;

/// Format of figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// For people
    Text,
    /// For programs: JSON on standard output
    Json,
}

/// Format of the figures of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Sheet {
    /// For people
    Text,
    /// For programs: JSON on standard output
    Json,
    /// For spreadsheets: a header and a row a file on standard output
    Csv,
}

/// Closed lines inside the parts of a plot that are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Inner {
    /// None
    Ignore,
    /// All but seam lines, and none that takes more than half of its part
    Cut,
    /// All, seam lines too
    All,
}

impl From<Inner> for plot::Inner {
    fn from(inner: Inner) -> Self {
        match inner {
            Inner::Ignore => Self::Ignore,
            Inner::Cut => Self::Cut,
            Inner::All => Self::All,
        }
    }
}

/// Number of times that the pieces of a pattern DXF are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Quantity {
    /// As the file says, right and left
    File,
    /// Once, as they are drawn
    One,
}

impl From<Quantity> for patterns::Quantity {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::File => Self::File,
            Quantity::One => Self::One,
        }
    }
}

/// Reads the name of a target, a row of a table.
pub(super) fn targets<E: Sync, P: Sync>(
    table: &'static [Target<E, P>],
) -> impl TypedValueParser<Value = &'static Target<E, P>> {
    let find = move |name: String| table.iter().find(|target| target.name == name);
    names(table.iter().map(|target| (target.name, target.about)))
        .map(move |name| find(name).expect("clap lets only the names of the table pass"))
}

/// Reads the name of a machine.
pub(super) fn machines() -> impl TypedValueParser<Value = &'static Machine> {
    names(MACHINES.iter().map(|machine| (machine.name, machine.about))).map(|name| {
        MACHINES.iter().find(|machine| machine.name == name).expect("clap lets only the names of the table pass")
    })
}

/// Reads the name of a dialect.
pub(super) fn dialects() -> impl TypedValueParser<Value = &'static Dialect> {
    names(DIALECTS.iter().map(|dialect| (dialect.name, dialect.about))).map(|name| {
        DIALECTS.iter().find(|dialect| dialect.name == name).expect("clap lets only the names of the table pass")
    })
}

/// Reads the name of a format that can be sewn: a format of sewing machines, or a dialect.
pub(super) fn sewing_formats() -> impl TypedValueParser<Value = String> {
    let formats = sew::FORMATS.iter().map(|format| (format.name, format.about));
    names(formats.chain(DIALECTS.iter().map(|dialect| (dialect.name, dialect.about))))
}

/// Reads the name of a page of the manual.
pub(super) fn pages() -> impl TypedValueParser<Value = &'static Page> {
    names(PAGES.iter().map(|page| (page.name, page.about)))
        .map(|name| PAGES.iter().find(|page| page.name == name).expect("clap lets only the names of the table pass"))
}

/// The key of the planner of a head.
pub(super) const PLANNER: &str = "tool.planner";

/// Reads the name of a planner of a head.
pub(super) fn planners() -> PossibleValuesParser {
    match keys::find(PLANNER).expect("the profile has the key").takes {
        Takes::Word(words) => PossibleValuesParser::new(words()),
        other => unreachable!("a planner has a name, and is none of {other:?}"),
    }
}

/// Reads the name of a pass.
pub(super) fn passes() -> impl TypedValueParser<Value = String> {
    let marker = MARKER_PASSES.iter().map(|pass| (pass.name, pass.about));
    names(marker.chain(TOOLPATH_PASSES.iter().map(|pass| (pass.name, pass.about))))
}

fn names(rows: impl Iterator<Item = (&'static str, &'static str)>) -> PossibleValuesParser {
    PossibleValuesParser::new(rows.map(|(name, about)| PossibleValue::new(name).help(about)))
}
