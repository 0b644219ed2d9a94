//! Logs: ruler readings as CSV, `t_s,i,j` and optional columns, one row per sample.
//!
//! Promises rows with increasing times and with readings that a ruler can give; all faults of a file are reported in one run.

use super::row::{FARTHEST, Row};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Tracking;
use crate::source::{CsvLines, Source, Span, csv_number};
use crate::units::MS_PER_S;
use crate::units::number::short;

/// Content of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Time,
    Left,
    Right,
    UpstreamLeft,
    UpstreamRight,
    Conveyor,
    Carriage,
    /// An output of an earlier run.
    Said,
    /// Unknown content.
    Other,
}

/// The known columns; the first three are mandatory.
const COLUMNS: [(&str, Column); 10] = [
    ("t_s", Column::Time),
    ("i", Column::Left),
    ("j", Column::Right),
    ("up_i", Column::UpstreamLeft),
    ("up_j", Column::UpstreamRight),
    ("conv_mm", Column::Conveyor),
    ("carriage_mm", Column::Carriage),
    ("status", Column::Said),
    ("direction", Column::Said),
    ("v_mm_s", Column::Said),
];
/// Number of mandatory columns.
const NEEDED: usize = 3;
/// Maximum time, s: beyond all clocks that count from 1970 on.
const LATEST: f64 = 1e11;
/// Relative deviation of a time step from the period above which samples are missing.
const MISSING: f64 = 0.4;

/// Reads a log; faults of the data are diagnostics.
pub(super) fn read(source: &Source, track: &Tracking, out: &mut Diagnostics) -> Vec<Row> {
    let bytes = source.bytes();
    let mut lines = CsvLines::of(bytes);
    let Some((header, span)) = lines.next() else {
        out.push(Diagnostic::new(&code::SOURCE_EMPTY, "the log is empty"));
        return Vec::new();
    };
    let columns = match columns(header) {
        Ok((columns, others)) => {
            if !others.is_empty() {
                let message = format!("the log has columns that nothing is known of: {}", others.join(", "));
                let finding = Diagnostic::new(&code::TRACK_COLUMN, message).at(span);
                out.push(finding.hint(format!("they are passed over; known are {}", known().join(", "))));
            }
            columns
        }
        Err((message, hint)) => {
            out.push(Diagnostic::new(&code::TRACK_HEADER, message).at(span).hint(hint));
            return Vec::new();
        }
    };
    let mut rows: Vec<Row> = Vec::with_capacity(bytes.len() / header.len().max(8));
    let mut refuse = |message: String, span: Span| {
        let hint = format!("a row is {}, with decimal points and commas", names(&columns));
        out.push(Diagnostic::new(&code::TRACK_ROW, message).at(span).hint(hint));
    };
    for (line, span) in lines {
        match parse(line, &columns, track).map(|row| Row { start: Some(span.start), ..row }) {
            Ok(row) => {
                // A row with a wrong time or position is still the reference for the next one, so that one slip is one fault.
                if let Err(message) = follows(rows.last(), &row) {
                    refuse(message, span);
                }
                rows.push(row);
            }
            Err(message) => refuse(message, span),
        }
    }
    if rows.is_empty() && !out.has_errors() {
        out.push(Diagnostic::new(&code::TRACK_NO_ROWS, "the log has a header and no row"));
    }
    if !out.has_errors() {
        rhythm(&rows, track, out);
    }
    rows
}

/// The names of columns, in the order of the header.
fn names(columns: &[Column]) -> String {
    let names = columns.iter().map(|column| {
        let known = COLUMNS.iter().find(|(_, known)| known == column);
        known.map_or("...", |(name, known)| if *known == Column::Said { "what was said" } else { name })
    });
    format!("`{}`", names.collect::<Vec<_>>().join(","))
}

/// The names of all known columns.
fn known() -> [&'static str; COLUMNS.len()] {
    COLUMNS.map(|(name, _)| name)
}

/// The columns of a header, and the names of unknown ones. The error is a message and a hint.
fn columns(header: &[u8]) -> Result<(Vec<Column>, Vec<String>), (String, String)> {
    let known = known();
    let hint = || {
        format!("the first row is `{}`, and may go on with {}", known[..NEEDED].join(","), known[NEEDED..].join(", "))
    };
    let text = std::str::from_utf8(header).map_err(|_| ("the first row is no text".to_owned(), hint()))?;
    if let Some(other) = [';', '\t'].into_iter().find(|&other| text.contains(other) && !text.contains(',')) {
        let message = format!("`{}` parts the columns of the log", other.escape_debug());
        return Err((message, "commas part them, and numbers have decimal points".to_owned()));
    }
    let (mut columns, mut others) = (Vec::new(), Vec::new());
    for name in text.split(',').map(str::trim) {
        let column = known.iter().position(|known| known.eq_ignore_ascii_case(name)).map(|i| COLUMNS[i].1);
        let is_twice = |column: Column| !matches!(column, Column::Said | Column::Other) && columns.contains(&column);
        if column.is_some_and(is_twice) {
            return Err((format!("the column `{name}` stands twice"), hint()));
        }
        others.extend(column.is_none().then(|| format!("`{}`", name.escape_debug())));
        columns.push(column.unwrap_or(Column::Other));
    }
    if let Some((name, _)) = COLUMNS[..NEEDED].iter().find(|(_, column)| !columns.contains(column)) {
        return Err((format!("the column `{name}` is missing"), hint()));
    }
    if columns.contains(&Column::UpstreamLeft) != columns.contains(&Column::UpstreamRight) {
        return Err(("the rulers upstream are a pair: `up_i` and `up_j`".to_owned(), hint()));
    }
    Ok((columns, others))
}

/// Parses a row, without its location.
fn parse(line: &[u8], columns: &[Column], track: &Tracking) -> Result<Row, String> {
    let text = std::str::from_utf8(line).map_err(|_| "the row is no text".to_owned())?;
    let mut row = Row { time: 0.0, covered: [0; 2], upstream: None, conveyor: None, carriage: None, start: None };
    let mut upstream = [0; 2];
    let mut fields = text.trim_end().split(',');
    for column in columns {
        let Some(field) = fields.next() else {
            let count = text.split(',').count();
            return Err(format!("the row has {count} fields instead of {}", columns.len()));
        };
        let field = field.trim();
        match column {
            Column::Time => row.time = csv_number(field, "time in s", LATEST)?,
            Column::Left => row.covered[0] = count(field, track)?,
            Column::Right => row.covered[1] = count(field, track)?,
            Column::UpstreamLeft => upstream[0] = count(field, track)?,
            Column::UpstreamRight => upstream[1] = count(field, track)?,
            Column::Conveyor => row.conveyor = Some(csv_number(field, "place of the conveyor in mm", FARTHEST)?),
            Column::Carriage => row.carriage = Some(csv_number(field, "place of the carriage in mm", FARTHEST)?),
            Column::Said | Column::Other => {}
        }
    }
    if fields.next().is_some() {
        let count = text.split(',').count();
        return Err(format!("the row has {count} fields instead of {}", columns.len()));
    }
    row.upstream = columns.contains(&Column::UpstreamLeft).then_some(upstream);
    Ok(row)
}

fn count(field: &str, track: &Tracking) -> Result<u16, String> {
    match field.parse::<u16>() {
        Ok(value) if u32::from(value) <= track.sensors => Ok(value),
        Ok(value) => Err(format!("{value} sensors are covered, but `track.sensors` is {}", track.sensors)),
        Err(_) => Err(format!("`{}` is no number of sensors", field.escape_debug())),
    }
}

/// Checks that a row may follow another.
fn follows(last: Option<&Row>, row: &Row) -> Result<(), String> {
    let Some(last) = last else { return Ok(()) };
    if row.time <= last.time {
        return Err(format!(
            "the time {} s is not behind that of the row before, {} s",
            short(row.time),
            short(last.time)
        ));
    }
    match (last.conveyor, row.conveyor) {
        (Some(before), Some(now)) if now < before => {
            Err(format!("the conveyor goes back, from {} to {} mm", short(before), short(now)))
        }
        _ => Ok(()),
    }
}

/// True if samples are missing between two consecutive rows, by the time between them.
pub(super) fn is_gap(before: &Row, row: &Row, track: &Tracking) -> bool {
    (row.time - before.time - track.period()).abs() > MISSING * track.period()
}

/// Checks the times of all rows: most must be one period apart; at the others samples are missing.
fn rhythm(rows: &[Row], track: &Tracking, out: &mut Diagnostics) {
    let gaps: Vec<&Row> = rows.windows(2).filter(|w| is_gap(&w[0], &w[1], track)).map(|w| &w[1]).collect();
    if gaps.len() > rows.len() / 2 {
        let mut steps: Vec<f64> = rows.windows(2).map(|w| w[1].time - w[0].time).collect();
        steps.sort_by(f64::total_cmp);
        let step = steps[steps.len() / 2];
        let message = format!(
            "the log has a row each {} ms, but `track.period_ms` is {}",
            short(step * MS_PER_S),
            track.period_ms
        );
        let times = (step / track.period()).round();
        let hint = if times >= MS_PER_S {
            "times are in s: are these ms?".to_owned()
        } else {
            format!("the controller counts samples: --set track.period_ms={}", short(step * MS_PER_S))
        };
        out.push(Diagnostic::new(&code::TRACK_PERIOD, message).hint(hint));
        return;
    }
    for row in gaps {
        let message = format!("samples are missing before {} s: the controller begins anew", short(row.time));
        let start = row.start.unwrap_or_default();
        out.push(Diagnostic::new(&code::TRACK_GAP, message).at(Span { start, end: start, block: 0 }));
    }
}
