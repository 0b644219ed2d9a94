//! Tables of the report.

use crate::picture::Markup;

/// A section with a table of facts, one per row.
pub(super) fn facts(out: &mut Markup, id: &str, title: &str, rows: &[(&str, String)]) {
    out.open("section", &[("id", id)]).element("h2", &[], title).open("table", &[("class", "facts")]);
    for (name, value) in rows {
        out.open("tr", &[]).element("th", &[("scope", "row")], name).element("td", &[], value).close("tr");
    }
    out.close("table").close("section");
}

/// Opens a table that can be sorted by its columns; `#` before a name marks a column of numbers.
pub(super) fn open(out: &mut Markup, class: &str, columns: &[&str]) {
    out.open("div", &[("class", "scroll")]).open("table", &[("class", class)]).open("thead", &[]).open("tr", &[]);
    for column in columns {
        match column.strip_prefix('#') {
            Some(name) => out.element("th", &[("scope", "col"), ("class", "number")], name),
            None => out.element("th", &[("scope", "col")], column),
        };
    }
    out.close("tr").close("thead").open("tbody", &[]);
}

/// Goes on from the rows to the totals below them, which stay there however the rows are sorted.
pub(super) fn totals(out: &mut Markup) {
    out.close("tbody").open("tbody", &[("class", "totals")]);
}

/// Closes the table.
pub(super) fn close(out: &mut Markup) {
    out.close("tbody").close("table").close("div");
}

/// A cell of a number, with the value to sort by.
pub(super) fn number(out: &mut Markup, shown: &str, value: f64) {
    let value = format!("{value}");
    out.element("td", &[("class", "number"), ("data-value", &value)], shown);
}
