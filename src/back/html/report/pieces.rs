//! Tables of the pieces and of the windows of a conveyor.

use super::table;
use crate::back::html::about::{About, clock};
use crate::picture::Markup;
use crate::units::MM_PER_M;
use crate::units::number::{counted, fixed};

/// The table of pieces, in cut order.
pub(super) fn section(about: &About, out: &mut Markup) {
    out.open("section", &[("id", "pieces")]).element("h2", &[], "Pieces");
    let has_time = about.record.ticks() > 0;
    let mut columns = vec!["#Order", "Piece", "Name", "Size", "Notches and holes", "#Cut, m"];
    if has_time {
        columns.extend(["#Time", "#Plunges"]);
    }
    columns.push("#Messages");
    table::open(out, "sortable", &columns);
    for (place, piece) in about.pieces.iter().enumerate() {
        let part = place.to_string();
        out.open("tr", &[("data-part", &part)]);
        table::number(out, &(place + 1).to_string(), place as f64);
        out.element("td", &[], &piece.number);
        out.element("td", &[("title", &piece.texts)], &piece.name);
        out.element("td", &[], &piece.size).element("td", &[], &piece.marks);
        table::number(out, &fixed(piece.cut / MM_PER_M, 3), piece.cut);
        if has_time {
            let time = about.time(piece.sums.total());
            table::number(out, &clock(time), time);
            table::number(out, &piece.sums.plunges.to_string(), piece.sums.plunges as f64);
        }
        table::number(out, &piece.messages.to_string(), piece.messages as f64);
        out.close("tr");
    }
    table::close(out);
    out.close("section");
}

/// The table of windows; empty where the cloth does not advance.
pub(super) fn windows(about: &About, out: &mut Markup) {
    let Some(last) = about.pieces.iter().filter_map(|piece| piece.window).max() else { return };
    out.open("section", &[("id", "windows")]).element("h2", &[], "Windows of the conveyor");
    table::open(out, "sortable", &["#Window", "Pieces", "#Cut, m", "#Time"]);
    for window in 0..=last {
        let pieces = || about.pieces.iter().filter(move |piece| piece.window == Some(window));
        let cut: f64 = pieces().map(|piece| piece.cut).sum();
        let time = about.time(pieces().map(|piece| piece.sums.total()).sum());
        out.open("tr", &[]);
        table::number(out, &(window + 1).to_string(), window as f64);
        out.element("td", &[], &counted(pieces().count(), "piece"));
        table::number(out, &fixed(cut / MM_PER_M, 3), cut);
        table::number(out, &clock(time), time);
        out.close("tr");
    }
    table::close(out);
    out.close("section");
}
