//! Tables of the pieces and of the windows of a conveyor.

use super::findings::{self, to_place};
use super::table::{self, Cells};
use super::totals::limit;
use crate::analysis::waits::{Waits, waits};
use crate::back::html::about::{About, clock};
use crate::back::html::piece::Piece;
use crate::back::html::record::Sums;
use crate::diagnostic::Diagnostic;
use crate::ir::motion::Bound;
use crate::ir::toolpath::Event;
use crate::picture::Markup;
use crate::units::MM_PER_M;
use crate::units::number::{counted, fixed};

/// Maximum number of inner pieces that a row names.
const MOST_INNER: usize = 3;
/// Maximum number of messages listed in a row.
const MOST_MESSAGES: usize = 100;
const PERCENT: f64 = 100.0;

/// Row of a piece, with its sections in cut order.
struct Row<'a> {
    piece: &'a Piece,
    sections: Vec<&'a Piece>,
    /// Length of its cuts, mm.
    cut: f64,
    sums: Sums,
    /// Pieces and events that come before it, in words.
    after: String,
}

/// The pieces in the order in which they are begun; the sections of one that is split are one row.
fn rows<'a>(about: &About<'a>) -> Vec<Row<'a>> {
    let mut rows: Vec<Row> = Vec::new();
    let mut known = vec![None; about.pieces.len()];
    for section in about.pieces {
        let place = *known[section.whole].get_or_insert_with(|| {
            let piece = &about.pieces[section.whole];
            rows.push(Row { piece, sections: Vec::new(), cut: 0.0, sums: Sums::default(), after: String::new() });
            rows.len() - 1
        });
        rows[place].sections.push(section);
        rows[place].cut += section.cut;
        rows[place].sums.join(&section.sums);
    }
    let waits = waits(about.context.marker, &about.context.job.profile);
    for row in &mut rows {
        row.after = after(about, row.piece, &waits[row.piece.whole]);
    }
    rows
}

/// The piece that takes longest, and its time, ticks.
pub(super) fn longest<'a>(about: &About<'a>) -> (&'a Piece, u64) {
    let all = rows(about).into_iter().map(|row| (row.piece, row.sums.total()));
    all.reduce(|longest, other| if other.1 > longest.1 { other } else { longest }).expect("what moves has a piece")
}

/// Prerequisites of a piece in words, as in `stop, 3, 4 and 2 more`.
fn after(about: &About, piece: &Piece, Waits { inner, events }: &Waits) -> String {
    let events = events.iter().map(|event| match event.kind {
        Event::Stop => "a stop",
        Event::Advance | Event::AdvanceBy(_) => "the cloth",
    });
    let mut inner: Vec<usize> = inner.iter().map(|&inner| about.pieces[inner].whole).collect();
    inner.dedup();
    inner.retain(|&inner| inner != piece.whole);
    let names = inner.iter().take(MOST_INNER).map(|&inner| about.pieces[inner].number.as_str());
    let said = events.chain(names).collect::<Vec<_>>().join(", ");
    match inner.len().saturating_sub(MOST_INNER) {
        0 => said,
        more => format!("{said} and {more} more"),
    }
}

/// The table of pieces, in cut order.
pub(super) fn section(about: &About, out: &mut Markup) {
    out.open("section", &[("id", "pieces")]).element("h2", &[], "Pieces");
    let (has_time, has_windows) = (about.record.ticks() > 0, about.pieces.iter().any(|piece| piece.window.is_some()));
    // Columns without any text are left out.
    let has_name = about.pieces.iter().any(|piece| !piece.name.is_empty());
    let has_size = about.pieces.iter().any(|piece| !piece.size.is_empty());
    let mut columns = vec!["#Order", "Piece"];
    let some = [(has_name, "Name"), (has_size, "Size"), (has_windows, "#Window")];
    columns.extend(some.into_iter().filter(|(has, _)| *has).map(|(_, name)| name));
    columns.push("#Notches and holes");
    let span = columns.len();
    columns.push("#Lines, m");
    if has_time {
        columns.extend(["#Cutting", "#Travel", "#Other", "#Time in all", "#Plunges", "Limited by"]);
        let words = "Other: turning, plunging, lifting, drilling and waiting. Limited by: what most of the cutting is \
                     bound by. The totals are those of the tables of time.";
        let there = about.outcome.controller.map(|_| " All times are those of the motion that is played here.");
        out.element("p", &[("class", "hint")], &format!("{words}{}", there.unwrap_or_default()));
    }
    let rows = rows(about);
    let has_after = rows.iter().any(|row| !row.after.is_empty());
    columns.extend(has_after.then_some("Comes after"));
    columns.push("#Messages");
    table::open(out, "sortable", &columns);
    for (place, Row { piece, sections, cut, sums, after }) in rows.iter().enumerate() {
        out.open("tr", &[("data-part", &piece.whole.to_string())]);
        let mut cells = Cells::of(&columns, 0);
        cells.number(&(place + 1).to_string(), (place + 1) as f64, out);
        cells.text(&piece.number, &[], out);
        if has_name {
            cells.text(&piece.name, &[("title", &piece.texts)], out);
        }
        if has_size {
            cells.text(&piece.size, &[], out);
        }
        if has_windows {
            let windows = sections.iter().filter_map(|section| section.window);
            let names: Vec<String> = windows.clone().map(|window| (window + 1).to_string()).collect();
            cells.number(&names.join(", "), windows.min().unwrap_or(0) as f64, out);
        }
        let total = piece.marks.total().to_string();
        cells.text(&piece.marks.to_string(), &[("class", "number marks"), ("data-value", &total)], out);
        work(about, *cut, sums, &mut cells, out);
        if has_after {
            cells.text(after, &[], out);
        }
        messages(about, piece, &mut cells, out);
        out.close("tr");
    }
    if has_time {
        table::totals(out);
        totals(about, &rows, (&columns, span), out);
    }
    table::close(out);
    out.close("section");
}

/// Cell of the messages that name a piece: their number, which opens their list.
fn messages(about: &About, piece: &Piece, cells: &mut Cells, out: &mut Markup) {
    let count = piece.messages.len();
    if count == 0 {
        cells.number("0", 0.0, out);
        return;
    }
    cells.open(&[("class", "count"), ("data-value", &count.to_string())], out);
    out.open("details", &[]).element("summary", &[], &count.to_string()).open("ul", &[]);
    for message in piece.messages.iter().take(MOST_MESSAGES).map(|&message| about.outcome.messages[message]) {
        out.open("li", &[]).prose(&words(about, piece, message)).text(" ");
        out.element("code", &[], message.code.name).text(" ");
        to_place(about, message, out);
        out.close("li");
    }
    out.close("ul");
    if let more @ 1.. = count.saturating_sub(MOST_MESSAGES) {
        out.element("p", &[], &format!("and {more} more"));
    }
    out.close("details").close("td");
}

/// A message in the row of a piece; one of another piece begins with that.
fn words(about: &About, piece: &Piece, message: &Diagnostic) -> String {
    match findings::piece(about, message) {
        Some(other) if other.whole != piece.whole => findings::told(about, message),
        Some(_) | None => message.message.clone(),
    }
}

/// Cells of the work on a piece: metres, and what its time is spent on.
fn work(about: &About, cut: f64, sums: &Sums, cells: &mut Cells, out: &mut Markup) {
    cells.number(&fixed(cut / MM_PER_M, 3), cut, out);
    if about.record.ticks() > 0 {
        let [cutting, travelling, other] = sums.shares();
        for ticks in [cutting, travelling, other, sums.total()] {
            let time = about.time(ticks);
            cells.number(&clock(time), time, out);
        }
        cells.number(&sums.plunges.to_string(), sums.plunges as f64, out);
        let bounds = sums.bounds();
        let all: u64 = bounds.iter().map(|(_, ticks)| ticks).sum();
        let said = |&(bound, ticks): &(Bound, u64)| {
            format!("{} {} %", limit(bound), fixed(PERCENT * ticks as f64 / all as f64, 0))
        };
        let said: Vec<String> = bounds.iter().map(said).collect();
        let first = said.first().map_or("", String::as_str);
        cells.text(first, &[("class", "bound"), ("title", &said.join(", "))], out);
    }
}

/// Totals under the pieces: work outside of them, if there is any, and all.
fn totals(about: &About, rows: &[Row], (columns, before): (&[&str], usize), out: &mut Markup) {
    let mut inside = Sums::default();
    for row in rows {
        inside.join(&row.sums);
    }
    let cut = rows.iter().map(|row| row.cut).sum();
    let all = &about.record.all;
    let mut outside = Sums { plunges: all.plunges - inside.plunges, ..Sums::default() };
    outside.ticks.iter_mut().zip(all.ticks.iter().zip(inside.ticks)).for_each(|(out, (all, of))| *out = all - of);
    let lines = [("Outside of pieces", 0.0, &outside), ("All", cut, all)];
    for (name, cut, sums) in lines.into_iter().filter(|(_, _, sums)| sums.total() > 0) {
        out.open("tr", &[]).element("th", &[("scope", "row"), ("colspan", &before.to_string())], name);
        let mut cells = Cells::of(columns, before);
        work(about, cut, sums, &mut cells, out);
        while !cells.is_done() {
            cells.text("", &[], out);
        }
        out.close("tr");
    }
}

/// The table of windows; empty where the cloth does not advance.
pub(super) fn windows(about: &About, out: &mut Markup) {
    let Some(count) = about.windows() else { return };
    out.open("section", &[("id", "windows")]).element("h2", &[], "Windows of the conveyor");
    out.element(
        "p",
        &[("class", "hint")],
        "The time in which the conveyor moves the cloth on is not counted anywhere.",
    );
    table::open(out, "sortable", &["#Window", "Pieces", "#Lines, m", "#Time"]);
    let mut sections = vec![0; about.pieces.len()];
    for piece in about.pieces {
        sections[piece.whole] += 1;
    }
    let is_split = |piece: &Piece| sections[piece.whole] > 1;
    for window in 0..count {
        let pieces = || about.pieces.iter().filter(move |piece| piece.window == Some(window));
        let cut: f64 = pieces().map(|piece| piece.cut).sum();
        let time = about.time(pieces().map(|piece| piece.sums.total()).sum());
        out.open("tr", &[]);
        table::number(out, &(window + 1).to_string(), window as f64);
        let (whole, split): (Vec<_>, Vec<_>) = pieces().partition(|piece| !is_split(piece));
        let sections: Vec<&str> = split.iter().map(|piece| piece.number.as_str()).collect();
        let sections = (!sections.is_empty()).then(|| format!("a section of {}", sections.join(", ")));
        let wholes = (!whole.is_empty() || sections.is_none()).then(|| counted(whole.len(), "piece"));
        out.element("td", &[], &wholes.into_iter().chain(sections).collect::<Vec<_>>().join(", "));
        table::number(out, &fixed(cut / MM_PER_M, 3), cut);
        table::number(out, &clock(time), time);
        out.close("tr");
    }
    table::close(out);
    out.close("section");
}
