//! Table at the end of a batch: one row per file with failures last, and a sum.

use std::fmt::Write as _;
use std::path::Path;

use super::figures::Figures;
use super::found::Found;
use super::manifest::Standing;
use crate::cli::options::counted;
use crate::cli::times::clock;
use crate::machine::{Costs, Price};
use crate::units::number::fixed;

/// Maximum columns of a file name. Longer names are cut at the start.
const NAME_COLUMNS: usize = 40;
/// Message about a file that caused a panic.
pub(super) const BROKEN: &str = "cutc broke down over it, which is a fault of cutc";

/// Outcome of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum State {
    /// Success.
    Done,
    /// Nothing to do: the earlier output is still valid.
    Unchanged,
    /// The file has errors or cannot be read, or its output cannot be written.
    Failed,
}

/// Outcome and figures of a file.
#[derive(Debug, Clone)]
pub(in crate::cli) struct Row {
    pub(in crate::cli) file: String,
    pub(in crate::cli) state: State,
    pub(in crate::cli) pieces: Option<usize>,
    /// Length of the cuts, m.
    pub(in crate::cli) cut_m: Option<f64>,
    /// Number of stitches.
    pub(in crate::cli) stitches: Option<usize>,
    /// Length of the stitches, m.
    pub(in crate::cli) thread_m: Option<f64>,
    /// Duration of the program, s.
    pub(in crate::cli) time_s: Option<f64>,
    /// Further figures, if requested.
    pub(in crate::cli) figures: Option<Figures>,
    /// The worst finding or the verdict; empty if there is none.
    pub(in crate::cli) worst: String,
    /// Findings in numbers and words.
    pub(in crate::cli) found: Found,
    /// Verdict on its programs; `None` if it was not compiled.
    pub(in crate::cli) verdict: Option<Standing>,
}

impl Row {
    /// Costs of the file; `None` if its time or its number of pieces is unknown.
    pub(in crate::cli) fn costs(&self, price: Price) -> Option<Costs> {
        Some(price.costs(self.time_s?, self.pieces?))
    }

    /// The row of a file on which the program panicked.
    pub(in crate::cli) fn broken(file: &Path) -> Self {
        Self { worst: BROKEN.to_owned(), ..Self::new(file, State::Failed) }
    }

    /// A row without figures.
    pub(in crate::cli) fn new(file: &Path, state: State) -> Self {
        let file = file.display().to_string();
        Self {
            file,
            state,
            pieces: None,
            cut_m: None,
            stitches: None,
            thread_m: None,
            time_s: None,
            figures: None,
            worst: String::new(),
            found: Found::default(),
            verdict: None,
        }
    }
}

/// Columns of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) enum Columns {
    /// Pieces and metres: the figures of a file that was read.
    Read,
    /// The figures of a file that was read, and the time of its program.
    Planned,
    /// All figures of a file, with its costs if there is a price.
    Counted(Option<Price>),
    /// Number of stitches, their length, and the time.
    Sewn,
    /// The verdict only.
    Judged,
}

/// Form of the report on a batch.
#[derive(Debug, Clone, Copy)]
pub(in crate::cli) struct Telling {
    /// Columns of the table.
    pub(in crate::cli) columns: Columns,
    /// True if only failures are reported.
    pub(in crate::cli) quiet: bool,
    /// True if a list of JSON objects goes to standard output.
    pub(in crate::cli) json: bool,
}

/// The table of some rows. With `quiet` it holds only the failed ones.
pub(in crate::cli) fn text(rows: &[Row], Telling { columns, quiet, .. }: Telling) -> String {
    let mut shown = failed_last(rows);
    shown.retain(|row| !quiet || row.state == State::Failed);
    let mut cells = vec![titles(columns)];
    cells.extend(shown.iter().map(|row| row.cells(columns)));
    if shown.len() > 1 && columns != Columns::Judged && !quiet {
        cells.push(sum(rows).cells(columns));
    }
    let width = |column: usize| cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..cells[0].len()).map(width).collect();
    let mut out = String::new();
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    if !shown.is_empty() {
        let last = widths.len() - 1;
        for row in &cells {
            let mut line = format!("  {:1$}", row[0], widths[0]);
            for column in 1..last {
                let _ = write!(line, "  {:>1$}", row[column], widths[column]);
            }
            let _ = writeln!(out, "{}", format!("{line}  {}", row[last]).trim_end());
        }
    }
    out + &counts(rows)
}

/// The rows in their order, with the failed ones last.
pub(in crate::cli) fn failed_last(rows: &[Row]) -> Vec<&Row> {
    let (failed, well): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row.state == State::Failed);
    [well, failed].concat()
}

/// A line with the number of files by outcome.
pub(in crate::cli) fn counts(rows: &[Row]) -> String {
    let count = |state: State| rows.iter().filter(|row| row.state == state).count();
    let (done, unchanged, failed) = (count(State::Done), count(State::Unchanged), count(State::Failed));
    let mut said = vec![counted(rows.len(), "file")];
    said.extend((done > 0).then(|| format!("{done} done")));
    said.extend((unchanged > 0).then(|| format!("{unchanged} unchanged")));
    said.extend((failed > 0).then(|| format!("{failed} failed")));
    said.join(", ") + "\n"
}

fn titles(columns: Columns) -> Vec<String> {
    let costs: &[&str] = &["cost", "a ply", "a part"];
    let titles: &[&[&str]] = match columns {
        Columns::Read => &[&["pieces", "cut m", "worst finding"]],
        Columns::Planned => &[&["pieces", "cut m", "time", "worst finding"]],
        Columns::Counted(price) => {
            let known: &[&str] = &["pieces", "cut m", "time", "notches", "area m2", "cloth mm", "used %"];
            &[known, if price.is_some() { costs } else { &[] }, &["worst finding"]]
        }
        Columns::Sewn => &[&["stitches", "thread m", "time", "worst finding"]],
        Columns::Judged => &[&["verdict"]],
    };
    std::iter::once("file").chain(titles.concat()).map(str::to_owned).collect()
}

/// The sum of all rows.
pub(in crate::cli) fn sum(rows: &[Row]) -> Row {
    Row {
        file: "all".to_owned(),
        state: State::Done,
        pieces: Some(rows.iter().filter_map(|row| row.pieces).sum()),
        cut_m: Some(rows.iter().filter_map(|row| row.cut_m).sum()),
        stitches: Some(rows.iter().filter_map(|row| row.stitches).sum()),
        thread_m: Some(rows.iter().filter_map(|row| row.thread_m).sum()),
        time_s: Some(rows.iter().filter_map(|row| row.time_s).sum()),
        figures: Figures::sum(rows.iter().filter_map(|row| row.figures.as_ref())),
        worst: String::new(),
        found: Found::default(),
        verdict: None,
    }
}

impl Row {
    fn cells(&self, columns: Columns) -> Vec<String> {
        let count = self.file.chars().count();
        let file = if count > NAME_COLUMNS {
            format!("...{}", self.file.chars().skip(count - NAME_COLUMNS + 3).collect::<String>())
        } else {
            self.file.clone()
        };
        let pieces = self.pieces.map_or_else(String::new, |pieces| pieces.to_string());
        let cut = self.cut_m.map_or_else(String::new, |cut| fixed(cut, 1));
        let worst = match self.state {
            State::Unchanged if self.worst.is_empty() => "unchanged".to_owned(),
            State::Unchanged => format!("unchanged, {}", self.worst),
            State::Failed => format!("FAILED {}", self.worst),
            State::Done => self.worst.clone(),
        };
        let time = || self.time_s.map_or_else(String::new, clock);
        match columns {
            Columns::Read => vec![file, pieces, cut, worst],
            Columns::Planned => vec![file, pieces, cut, time(), worst],
            Columns::Counted(price) => {
                let mut cells = vec![file, pieces, cut, time()];
                cells.extend(self.figures.map_or_else(Default::default, |figures| known(&figures)));
                cells.extend(price.into_iter().flat_map(|price| {
                    let costs = self.costs(price);
                    costs.map_or_else(Default::default, |costs| shares(&costs))
                }));
                cells.push(worst);
                cells
            }
            Columns::Sewn => {
                let stitches = self.stitches.map_or_else(String::new, |stitches| stitches.to_string());
                let thread = self.thread_m.map_or_else(String::new, |thread| fixed(thread, 2));
                vec![file, stitches, thread, time(), worst]
            }
            Columns::Judged => vec![file, worst],
        }
    }
}

/// Cells of notches, area, cloth and utilisation.
fn known(figures: &Figures) -> [String; 4] {
    let Figures { notches, area_m2, cloth } = figures;
    let cloth = format!("{} x {}", fixed(cloth.length_mm, 0), fixed(cloth.width_mm, 0));
    let used = figures.utilisation_percent().map_or_else(String::new, |used| fixed(used, 1));
    [notches.to_string(), area_m2.map_or_else(String::new, |area| fixed(area, 3)), cloth, used]
}

/// Cells of the costs of the marker, of a ply and of a part. The latter have more decimals, because they are small.
fn shares(costs: &Costs) -> [String; 3] {
    [fixed(costs.marker, 2), fixed(costs.ply, 3), costs.part.map_or_else(String::new, |part| fixed(part, 4))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::batch::Cloth;

    #[test]
    fn what_failed_stands_last_before_the_sum() {
        let row = |file: &str, state, worst: &str| Row { worst: worst.to_owned(), ..Row::new(Path::new(file), state) };
        let rows = [
            Row { pieces: Some(8), cut_m: Some(12.34), time_s: Some(61.2), ..row("a.cut", State::Done, "") },
            row("b.cut", State::Failed, "iso/not-a-word"),
            Row { pieces: Some(160), cut_m: Some(400.0), time_s: Some(3725.0), ..row("c.cut", State::Unchanged, "") },
            Row { pieces: Some(2), ..row(&format!("{}/d.cut", "x".repeat(50)), State::Done, "iso/no-end") },
        ];
        let told = |quiet| text(&rows, Telling { columns: Columns::Planned, quiet, json: false });
        insta::assert_snapshot!(told(false), @r"
          file                                      pieces  cut m     time  worst finding
          a.cut                                          8   12.3     1:01
          c.cut                                        160  400.0  1:02:05  unchanged
          ...xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx/d.cut       2                  iso/no-end
          b.cut                                                             FAILED iso/not-a-word
          all                                          170  412.3  1:03:06
        4 files, 2 done, 1 unchanged, 1 failed
        ");
        insta::assert_snapshot!(told(true), @r"
          file   pieces  cut m  time  worst finding
          b.cut                       FAILED iso/not-a-word
        4 files, 2 done, 1 unchanged, 1 failed
        ");
    }

    #[test]
    fn figures_stand_in_columns_and_add_up() {
        let known =
            |area_m2, length_mm| Some(Figures { notches: 4, area_m2, cloth: Cloth { length_mm, width_mm: 1500.0 } });
        let row = |file: &str, figures| Row {
            pieces: Some(8),
            cut_m: Some(12.34),
            time_s: Some(61.2),
            figures,
            ..Row::new(Path::new(file), State::Done)
        };
        let bad = Row { worst: "iso/not-a-word".to_owned(), ..Row::new(Path::new("b.cut"), State::Failed) };
        let rows = [row("a.cut", known(Some(2.4), 2000.0)), bad, row("c.cut", known(Some(0.0), 0.0))];
        let told = |price| text(&rows, Telling { columns: Columns::Counted(price), quiet: false, json: false });
        insta::assert_snapshot!(told(None), @r"
          file   pieces  cut m  time  notches  area m2     cloth mm  used %  worst finding
          a.cut       8   12.3  1:01        4    2.400  2000 x 1500    80.0
          c.cut       8   12.3  1:01        4    0.000     0 x 1500
          b.cut                                                              FAILED iso/not-a-word
          all        16   24.7  2:02        8    2.400  2000 x 1500    80.0
        3 files, 2 done, 1 failed
        ");
        insta::assert_snapshot!(told(Some(Price { per_s: 0.01, plies: 5 })), @r"
          file   pieces  cut m  time  notches  area m2     cloth mm  used %  cost  a ply  a part  worst finding
          a.cut       8   12.3  1:01        4    2.400  2000 x 1500    80.0  0.61  0.122  0.0153
          c.cut       8   12.3  1:01        4    0.000     0 x 1500          0.61  0.122  0.0153
          b.cut                                                                                   FAILED iso/not-a-word
          all        16   24.7  2:02        8    2.400  2000 x 1500    80.0  1.22  0.245  0.0153
        3 files, 2 done, 1 failed
        ");
    }
}
