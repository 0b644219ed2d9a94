//! `cutc manual`: prints the pages of the manual.

use std::fmt::Write as _;

use clap::Args;

use super::choices;
use super::finished::{DONE, Finished};
use crate::manual::{PAGES, Page};

/// Arguments of `cutc manual`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The page; without one, all are listed
    #[arg(value_parser = choices::pages())]
    page: Option<&'static Page>,
}

pub(super) fn run(arguments: &Arguments) -> Finished {
    let text = arguments.page.map_or_else(list, |page| page.text.to_owned());
    Finished::text(text, String::new(), DONE)
}

/// The list of pages, one per line.
fn list() -> String {
    let width = PAGES.iter().map(|page| page.name.len()).max().unwrap_or(0);
    let mut out = String::new();
    for Page { name, about, .. } in PAGES {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "{name:width$}  {about}");
    }
    out
}
