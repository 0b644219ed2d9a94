//! Overview of a folder of pages: a table with one row per file, each with a link to its page.

use std::cmp::Reverse;
use std::fmt::Write as _;
use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::back::{Emit, Target};
use crate::cli::batch::{Found, Row, Standing, State};
use crate::cli::draft::{self, Draft};
use crate::cli::files::cannot_write;
use crate::cli::finished::failure;
use crate::machine::{Job, Price};
use crate::picture::{Columns, Markup, Page, Script};
use crate::units::number::{clock, counted, fixed};

/// File name of the overview.
const NAME: &str = "index.html";
/// Markup that identifies an overview among other pages.
const MARK: &str = "<main id=\"overview\">";

/// Columns of the table; `#` before a name marks a column of numbers.
const COLUMNS: [&str; 11] = [
    "File",
    "Worst finding",
    "Verdict",
    "Made",
    "#Errors",
    "#May spoil parts",
    "#Warnings",
    "#Pieces",
    "#Lines, m",
    "#Time",
    // With a price only.
    "#Cost",
];

/// A row of the table, and the path of its page.
pub(in crate::cli) type Seen<'a> = (&'a Row, &'a Path);

/// The overview of a folder.
#[derive(Debug)]
pub(in crate::cli) struct Overview<'a> {
    path: PathBuf,
    out: &'a Path,
}

impl<'a> Overview<'a> {
    /// The overview of a folder of programs; `None` if the programs have no pages, or if a page has the name of the overview.
    pub(in crate::cli) fn of<'p>(
        out: &'a Path,
        targets: &[&'static Target],
        places: impl IntoIterator<Item = &'p [PathBuf]>,
    ) -> Option<Self> {
        let path = out.join(NAME);
        let page = page_of(targets)?;
        let is_taken = places.into_iter().any(|places| places[page] == path);
        (!is_taken).then_some(Self { path, out })
    }

    /// Checks that the overview may be written.
    ///
    /// # Errors
    ///
    /// Another file that is not an overview stands in its place.
    pub(in crate::cli) fn may_be_written(&self) -> anyhow::Result<()> {
        let is_ours =
            fs::read(&self.path).map_or(true, |bytes| bytes.windows(MARK.len()).any(|part| part == MARK.as_bytes()));
        if is_ours {
            return Ok(());
        }
        let shown = self.path.display();
        Err(failure(
            format!("`{shown}` is no overview of pages: it is not overwritten"),
            "give the programs another place with -o, or say --force",
        ))
    }

    /// Writes the overview of the outcomes of the inputs, and returns its path.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub(in crate::cli) fn write(&self, rows: &[Seen<'_>], job: &Job) -> anyhow::Result<String> {
        let page = Page {
            title: format!("{}: overview", counted(rows.len(), "file")),
            body: self.body(rows, job),
            facts: serde_json::json!({}),
            columns: Columns::default(),
            script: Script::Cutting,
        };
        let mut draft = Draft::new(&self.path)?;
        page.write(draft.file()).map_err(|error| cannot_write(&self.path, &error))?;
        draft::publish(vec![draft], || Ok(()))?;
        Ok(self.path.display().to_string())
    }

    fn body(&self, rows: &[Seen<'_>], job: &Job) -> String {
        let mut out = Markup::default();
        let failed = rows.iter().filter(|(row, _)| row.state == State::Failed).count();
        out.open("header", &[]).element("h1", &[], &counted(rows.len(), "file"));
        let said = if failed == 0 { "all done".to_owned() } else { format!("{failed} failed") };
        let worth = if failed == 0 { "verified" } else { "refused" };
        out.element("p", &[("class", "worth"), ("data-worth", worth)], &said);
        let sum = |of: fn(&Row) -> Option<f64>| rows.iter().filter_map(|(row, _)| of(row)).sum::<f64>();
        let time = sum(|row| row.time_s);
        let price = job.remarks.price;
        let pieces = rows.iter().filter_map(|(row, _)| row.pieces).sum();
        let cost = price.map(|price| format!("; cost {}", price.costs(time, pieces)));
        let lines = fixed(sum(|row| row.cut_m), 2);
        let summary = format!("{lines} m of lines to cut, {}{}", clock(time, 1), cost.unwrap_or_default());
        out.element("p", &[("class", "summary")], &summary).close("header");
        out.markup(MARK).open("section", &[]);
        let profile = format!("Profile: {}, SHA-256 of all values {}", job.origin.described(), job.profile.digest());
        out.element("p", &[("class", "hint")], &profile).open("div", &[("class", "scroll")]);
        out.open("table", &[("class", "sortable")]).open("thead", &[]).open("tr", &[]);
        for column in COLUMNS.into_iter().take(COLUMNS.len() - usize::from(price.is_none())) {
            let (class, name) = column.strip_prefix('#').map_or(("", column), |name| ("number", name));
            out.element("th", &[("scope", "col"), ("class", class)], name);
        }
        out.close("tr").close("thead").open("tbody", &[]);
        let mut rows: Vec<&Seen> = rows.iter().collect();
        // By harm: failed files first, then those with most warnings of spoilt parts, then those with most warnings.
        rows.sort_by_key(|(Row { state, found, .. }, _)| {
            Reverse((*state == State::Failed, found.spoils, found.warnings))
        });
        for (row, page) in rows {
            self.row(row, page, price, &mut out);
        }
        out.close("tbody").close("table").close("div").close("section").close("main");
        out.into_text()
    }

    fn row(&self, row: &Row, page: &Path, price: Option<Price>, out: &mut Markup) {
        let Found { errors, warnings, spoils, .. } = &row.found;
        let (class, made) = match row.state {
            State::Done => ("", "now"),
            State::Unchanged => ("", "unchanged"),
            State::Failed => ("broken", "not"),
        };
        out.open("tr", &[("class", class)]).open("td", &[]);
        if page.exists() {
            out.element("a", &[("href", &link(page.strip_prefix(self.out).unwrap_or(page)))], &row.file);
        } else {
            out.text(&row.file);
        }
        out.close("td");
        told(row, page, out);
        let verdict = match row.verdict {
            Some(Standing::Verified) => "verified",
            Some(Standing::Unverified) => "not verified",
            Some(Standing::Refused) => "refused",
            None => "failed",
        };
        out.element("td", &[], verdict).element("td", &[("data-name", "Made")], made);
        // On a narrow screen each number has its name beside it.
        let mut numbers = COLUMNS.into_iter().filter_map(|column| column.strip_prefix('#'));
        let mut number = |shown: Option<String>, value: Option<f64>| {
            let (name, value) = (numbers.next().unwrap_or_default(), value.unwrap_or(-1.0).to_string());
            let attributes = [("class", "number"), ("data-name", name), ("data-value", &value)];
            out.element("td", &attributes, &shown.unwrap_or_default());
        };
        let count = |count: usize| Some(count).filter(|&count| count > 0);
        for count in [count(*errors), count(*spoils), count(*warnings), row.pieces] {
            number(count.map(|count| count.to_string()), count.map(|count| count as f64));
        }
        number(row.cut_m.map(|metres| fixed(metres, 3)), row.cut_m);
        number(row.time_s.map(|time| clock(time, 1)), row.time_s);
        if let Some(price) = price {
            let cost = row.costs(price).map(|costs| costs.marker);
            number(cost.map(|cost| fixed(cost, 2)), cost);
        }
        out.close("tr");
    }
}

/// Cell of what was found: the message, and behind it the code, which is all there is of what cannot be read; then what to do,
/// and further errors.
fn told(row: &Row, page: &Path, out: &mut Markup) {
    let Found { errors, told, hint, more, .. } = &row.found;
    out.open("td", &[]).prose(if told.is_empty() { &row.worst } else { told });
    if !told.is_empty() {
        out.text(" ").element("code", &[("class", "quiet")], &row.worst);
    }
    if !hint.is_empty() {
        out.open("p", &[("class", "hint")]).prose(hint).close("p");
    }
    if !more.is_empty() {
        out.open("ul", &[]);
        for told in more {
            out.open("li", &[]).prose(told).close("li");
        }
        out.close("ul");
    }
    if let left @ 1.. = errors.saturating_sub(1 + more.len()) {
        out.element("p", &[("class", "hint")], &format!("and {}", counted(left, "further error")));
    }
    if !page.exists() {
        let words = "it has no page: nothing of it can be drawn; cutc check tells all that is wrong";
        out.element("p", &[("class", "hint")], words);
    }
    out.close("td");
}

/// Index of the page among the targets of a file; `None` if no target is a page.
pub(in crate::cli) fn page_of(targets: &[&'static Target]) -> Option<usize> {
    targets.iter().position(|target| matches!(target.emit, Emit::Page(_)))
}

/// A relative path as a link. Bytes that are not unreserved in a URL are percent-encoded.
fn link(path: &Path) -> String {
    let mut link = String::from(".");
    for part in path.components() {
        let Component::Normal(name) = part else { continue };
        link.push('/');
        for &byte in name.as_encoded_bytes() {
            if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
                link.push(char::from(byte));
            } else {
                let _infallible = write!(link, "%{byte:02X}");
            }
        }
    }
    link
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_leads_to_any_name() {
        assert_eq!(link(Path::new("a/b c?#%ż.html")), "./a/b%20c%3F%23%25%C5%BC.html");
        assert_eq!(link(Path::new("javascript:x.html")), "./javascript%3Ax.html");
    }
}
