//! Rows of files for other programs: as JSON with their sum, or as CSV. Names contain the units.

use serde::Serialize;
use serde_json::Value;

use super::arguments::DIGITS;
use crate::cli::batch::{self, Row, State};
use crate::cli::report::pretty;
use crate::machine::Price;
use crate::pipeline::significant;
use crate::units::number::{exact, fixed};

/// Names of all figures, in the order of the CSV columns.
const FIGURES: [&str; 8] =
    ["pieces", "cut_m", "time_s", "notches", "area_m2", "length_mm", "width_mm", "utilisation_percent"];
/// Names of the cost figures, which are present on request.
const COSTS: [&str; 3] = ["cost", "cost_per_ply", "cost_per_part"];
/// Characters that require quotes around a CSV cell.
const QUOTED: [char; 4] = [',', '"', '\n', '\r'];

/// The figures of a file or of all. Unknown ones are null.
#[derive(Serialize)]
pub(super) struct Figures {
    pieces: Option<usize>,
    cut_m: Option<f64>,
    time_s: Option<f64>,
    notches: Option<usize>,
    area_m2: Option<f64>,
    length_mm: Option<f64>,
    width_mm: Option<f64>,
    utilisation_percent: Option<f64>,
    /// Present only on request.
    #[serde(flatten)]
    costs: Option<Costs>,
}

/// Costs, without a currency.
#[derive(Debug, Serialize)]
pub(super) struct Costs {
    plies: u32,
    cost: Option<f64>,
    cost_per_ply: Option<f64>,
    cost_per_part: Option<f64>,
}

/// State and figures of a file.
#[derive(Serialize)]
struct OfFile<'a> {
    file: &'a str,
    state: &'static str,
    #[serde(flatten)]
    figures: Figures,
    /// Code of the worst finding, or the reason why the file cannot be read.
    worst: Option<&'a str>,
}

/// Totals of all files. The figures are those of the files that succeeded.
#[derive(Serialize)]
struct Sum {
    files: usize,
    failed: usize,
    #[serde(flatten)]
    figures: Figures,
}

impl Figures {
    fn of(row: &Row, price: Option<Price>) -> Self {
        let rounded = |value| significant(value, DIGITS);
        let known = row.figures.as_ref();
        Self {
            pieces: row.pieces,
            cut_m: row.cut_m.map(rounded),
            time_s: row.time_s.map(rounded),
            notches: known.map(|known| known.notches),
            area_m2: known.and_then(|known| known.area_m2).map(rounded),
            length_mm: known.map(|known| rounded(known.cloth.length_mm)),
            width_mm: known.map(|known| rounded(known.cloth.width_mm)),
            utilisation_percent: known.and_then(batch::Figures::utilisation_percent).map(rounded),
            costs: price.map(|price| Costs::of(row, price)),
        }
    }
}

impl Costs {
    /// The costs of a row; null while its time is unknown.
    pub(super) fn of(row: &Row, price: Price) -> Self {
        let rounded = |value| significant(value, DIGITS);
        let costs = row.costs(price);
        Self {
            plies: price.plies,
            cost: costs.map(|costs| rounded(costs.marker)),
            cost_per_ply: costs.map(|costs| rounded(costs.ply)),
            cost_per_part: costs.and_then(|costs| costs.part).map(rounded),
        }
    }

    /// The costs as a line of text; empty while the time is unknown.
    pub(super) fn text(&self) -> String {
        let Self { plies, cost: Some(cost), cost_per_ply: Some(ply), cost_per_part } = self else {
            return String::new();
        };
        let part = cost_per_part.map_or_else(String::new, |part| format!(", {} a part", fixed(part, 4)));
        let plies = if *plies == 1 { "1 ply".to_owned() } else { format!("{plies} plies") };
        format!("  cost       {} for {plies}: {} a ply{part}\n", fixed(*cost, 2), fixed(*ply, 3))
    }
}

impl<'a> OfFile<'a> {
    fn of(row: &'a Row, price: Option<Price>) -> Self {
        let state = match row.state {
            State::Done | State::Unchanged => "done",
            State::Failed => "failed",
        };
        let worst = Some(row.worst.as_str()).filter(|worst| !worst.is_empty());
        Self { file: &row.file, state, figures: Figures::of(row, price), worst }
    }
}

/// All files, with the failed ones last, and their sum.
pub(super) fn json(rows: &[Row], price: Option<Price>) -> String {
    #[derive(Serialize)]
    struct All<'a> {
        files: Vec<OfFile<'a>>,
        sum: Sum,
    }
    let failed = rows.iter().filter(|row| row.state == State::Failed).count();
    let files = batch::failed_last(rows).into_iter().map(|row| OfFile::of(row, price)).collect();
    let sum = Sum { files: rows.len(), failed, figures: Figures::of(&batch::sum(rows), price) };
    pretty(&All { files, sum })
}

/// A header and one row per file, with the failed ones last. Unknown values are empty.
pub(super) fn csv(rows: &[Row], price: Option<Price>) -> String {
    let costs: &[&str] = if price.is_some() { &COSTS } else { &[] };
    let keys = [&["file", "state"], &FIGURES[..], costs, &["worst"]].concat();
    let mut out = keys.join(",") + "\n";
    for row in batch::failed_last(rows) {
        let values = serde_json::to_value(OfFile::of(row, price)).expect("figures are plain data");
        let cells: Vec<String> = keys.iter().map(|key| cell(&values[*key])).collect();
        out += &(cells.join(",") + "\n");
    }
    out
}

/// A value as a CSV cell, quoted as in RFC 4180 if necessary.
fn cell(value: &Value) -> String {
    match value {
        Value::String(text) if text.contains(QUOTED) => format!("\"{}\"", text.replace('"', "\"\"")),
        Value::String(text) => text.clone(),
        Value::Number(number) => number.as_f64().map_or_else(String::new, exact),
        Value::Null | Value::Bool(_) | Value::Array(_) | Value::Object(_) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::cli::batch::Cloth;

    fn rows() -> [Row; 2] {
        let cloth = Cloth { length_mm: 2000.0, width_mm: 1500.0 };
        let known = batch::Figures { notches: 3, area_m2: Some(2.4), cloth };
        let done = Row {
            pieces: Some(8),
            cut_m: Some(12.345_678_901_2),
            time_s: Some(60.5),
            figures: Some(known),
            ..Row::new(Path::new("a \"b\", c.cut"), State::Done)
        };
        [Row { worst: "iso/not-a-word".to_owned(), ..Row::new(Path::new("bad.cut"), State::Failed) }, done]
    }

    #[test]
    fn a_sheet_has_a_row_a_file_and_quotes_what_must_be() {
        insta::assert_snapshot!(csv(&rows(), None), @r#"
        file,state,pieces,cut_m,time_s,notches,area_m2,length_mm,width_mm,utilisation_percent,worst
        "a ""b"", c.cut",done,8,12.3456789,60.5,3,2.4,2000,1500,80,
        bad.cut,failed,,,,,,,,,iso/not-a-word
        "#);
    }

    #[test]
    fn every_key_of_a_row_is_a_column() {
        let values = serde_json::to_value(OfFile::of(&rows()[1], None)).expect("plain data");
        let mut keys: Vec<&str> = values.as_object().expect("an object").keys().map(String::as_str).collect();
        let mut columns = [&["file", "state", "worst"], &FIGURES[..]].concat();
        keys.sort_unstable();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }

    #[test]
    fn the_sum_leaves_out_what_failed_and_says_so() {
        let value: Value = serde_json::from_str(&json(&rows(), None)).expect("JSON");
        assert_eq!((&value["files"][1]["file"], &value["files"][1]["state"]), (&"bad.cut".into(), &"failed".into()));
        assert!(value["files"][1]["pieces"].is_null() && value["files"][0]["worst"].is_null());
        assert_eq!((&value["sum"]["files"], &value["sum"]["failed"]), (&2.into(), &1.into()));
        assert_eq!((&value["sum"]["pieces"], &value["sum"]["utilisation_percent"]), (&8.into(), &80.0.into()));
    }
}
