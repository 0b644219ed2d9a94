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

/// Cells of one row, each with the name of its column, which stands beside it on a narrow screen.
pub(super) struct Cells<'a> {
    names: std::slice::Iter<'a, &'a str>,
}

impl<'a> Cells<'a> {
    /// The cells of a row under these columns, none of them written; `past` are taken by a cell across several columns.
    pub(super) fn of(columns: &'a [&'a str], past: usize) -> Self {
        Self { names: columns[past..].iter() }
    }

    /// True if each column has its cell.
    pub(super) fn is_done(&self) -> bool {
        self.names.len() == 0
    }

    /// Opens the next cell, with attributes.
    pub(super) fn open(&mut self, attributes: &[(&str, &str)], out: &mut Markup) {
        let name = self.names.next().map_or("", |name| name.trim_start_matches('#'));
        out.open("td", &[attributes, &[("data-name", name)]].concat());
    }

    /// A cell of text, with attributes.
    pub(super) fn text(&mut self, shown: &str, attributes: &[(&str, &str)], out: &mut Markup) {
        self.open(attributes, out);
        out.text(shown).close("td");
    }

    /// A cell of a number, with the value to sort by.
    pub(super) fn number(&mut self, shown: &str, value: f64, out: &mut Markup) {
        self.text(shown, &[("class", "number"), ("data-value", &value.to_string())], out);
    }
}

/// A cell of a number, with the value to sort by.
pub(super) fn number(out: &mut Markup, shown: &str, value: f64) {
    out.element("td", &[("class", "number"), ("data-value", &value.to_string())], shown);
}
