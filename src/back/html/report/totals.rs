//! Totals of a job.

use super::lines::uncut;
use super::table;
use crate::analysis::area;
use crate::back::Estimate;
use crate::back::html::about::{About, clock};
use crate::back::html::piece::Marks;
use crate::back::html::record::Sums;
use crate::ir::Marker;
use crate::ir::declaration::Total;
use crate::ir::motion::Bound;
use crate::machine::NotchStyle;
use crate::picture::Markup;
use crate::units::number::{counted, fixed};
use crate::units::{MM_PER_M, MM2_PER_M2};

const PERCENT: f64 = 100.0;
/// Least share of the time on a controller whose limit is named.
const LEAST_SHARE: f64 = 0.005;

/// The job in one line.
pub(super) fn summary(about: &About) -> String {
    let marker = about.context.marker;
    let (width, height) = marker.extent().size();
    let said = format!(
        "{}, {} x {} mm, {} m of lines to cut",
        counted(marker.piece_count(), "piece"),
        fixed(width, 0),
        fixed(height, 0),
        fixed(marker.cut_length() / MM_PER_M, 2)
    );
    let windows = about.windows().map(|windows| format!(" in {}", counted(windows, "window")));
    let time = time(about).map(|time| match about.outcome.controller {
        Some(_) => format!(", about {} on the controller", clock(time)),
        None => format!(", {}", clock(time)),
    });
    let uncut = uncut(about).map(|uncut| format!("; {uncut}"));
    [windows, time, uncut].into_iter().flatten().fold(said, |said, more| said + &more)
}

/// Duration of the program, s: by the planning of its controller, or as it is played; `None` when nothing moves.
pub(super) fn time(about: &About) -> Option<f64> {
    let ticks = about.record.all.total();
    let played = (ticks > 0).then(|| about.time(ticks));
    about.outcome.controller.map(|controller| controller.spent.time).or(played)
}

/// The section of totals.
pub(super) fn section(about: &About, out: &mut Markup) {
    let marker = about.context.marker;
    let sums = &about.record.all;
    let (width, height) = marker.extent().size();
    let mut rows = vec![
        ("Pieces", marker.piece_count().to_string()),
        ("Extent of the pieces", format!("{} x {} mm", fixed(width, 1), fixed(height, 1))),
        ("Lines to cut", format!("{} m as they are drawn", metres(marker.cut_length()))),
    ];
    rows.extend(between_parts(marker));
    rows.extend(notches(about).map(|notches| ("Notches and holes", notches)));
    if let Some(area) = area(marker, &about.context.job.profile) {
        let of = width * height;
        let share =
            if of > 0.0 { format!(", {} % of their extent", fixed(PERCENT * area / of, 1)) } else { String::new() };
        rows.push(("Area of the parts", format!("{} m2{share}", fixed(area / MM2_PER_M2, 4))));
    }
    if sums.total() > 0 {
        let moved = if about.windows().is_some() { " without the time in which the cloth is moved on" } else { "" };
        let played = clock(about.time(sums.total())) + moved;
        match about.outcome.controller {
            Some(Estimate { spent, moves, planner, chosen, .. }) => {
                let time = clock(spent.time);
                rows.push((
                    "Time on the controller",
                    format!("about {time} by {}'s planner, {moves} arcs and lines", planner.title()),
                ));
                rows.extend(chosen.iter().map(|chosen| ("Moves", format!("{}, the fastest", chosen.name))));
                let share = |part: f64| format!("{} %", fixed(PERCENT * part / spent.time, 0));
                let limits = spent.limits.iter().filter(|(_, part)| *part >= LEAST_SHARE * spent.time);
                let limits: Vec<String> = limits.map(|(limit, part)| format!("{limit} {}", share(*part))).collect();
                rows.extend((!limits.is_empty()).then(|| ("It is limited by", limits.join(", "))));
                rows.push(("Time as played here", played));
            }
            None => rows.push(("Time", played)),
        }
        rows.push(("Plunges", sums.plunges.to_string()));
    }
    if sums.plunges > 0 {
        let cut = metres(marker.cut_length() + sums.overlaps);
        rows.push(("Cut in all", format!("{cut} m, of it overlaps past ends {} m", metres(sums.overlaps))));
    }
    rows.extend(cost(about).map(|cost| ("Cost", cost)));
    for Total { kind, count, worst_mm, .. } in about.outcome.declared {
        let [one, many] = kind.words();
        let name = if *count == 1 { one } else { many };
        rows.push(("Declared", format!("{count} {name}, at most {} {}", fixed(*worst_mm, 2), kind.unit())));
    }
    table::facts(out, "totals", "Totals", &rows);
    if sums.total() > 0 {
        spent(about, sums, out);
        limited(about, sums, out);
    }
}

/// Lengths of edges that two parts have in common, and of those that lie close to each other.
fn between_parts(marker: &Marker) -> impl Iterator<Item = (&'static str, String)> {
    let (common, spared, near) = (marker.common_length(), marker.spared, marker.near_length());
    let once = format!("{} m are cut once for two parts, {} m less", metres(common), metres(spared));
    let strips = format!("{} m beside edges of other parts", metres(near));
    let rows = [(spared, "Edges in common", once), (near, "Thin strips", strips)];
    rows.into_iter().filter(|(length, ..)| *length > 0.0).map(|(_, name, words)| (name, words))
}

/// Length in metres.
fn metres(mm: f64) -> String {
    fixed(mm / MM_PER_M, 3)
}

/// Notches and holes of all pieces by kind, and how notches are cut; `None` without any.
fn notches(about: &About) -> Option<String> {
    let marks = Marks::all(about.pieces.iter().map(|piece| &piece.marks));
    let style = match about.context.job.profile.notch.style {
        NotchStyle::AsDrawn => "cut as drawn",
        NotchStyle::Slit => "notches are cut as slits",
        NotchStyle::Skip => "no notch is cut",
    };
    (marks.total() > 0).then(|| format!("{marks}; {style}"))
}

/// Cost of the job; `None` when the price is unknown.
pub(super) fn cost(about: &About) -> Option<String> {
    let price = about.context.job.remarks.price?;
    Some(price.costs(time(about)?, about.context.marker.piece_count()).to_string())
}

/// Breakdown of the time: one row per activity, with a bar of its share.
fn spent(about: &About, sums: &Sums, out: &mut Markup) {
    let title = if about.outcome.controller.is_some() { "Time as played here" } else { "Time" };
    out.open("section", &[("id", "spent")]).element("h2", &[], title);
    table::open(out, "bars", &["Spent on", "#Time", "#Share", "#Distance", ""]);
    let total = sums.total() as f64;
    let cells = |ticks: u64, way: Option<f64>, of: &str, out: &mut Markup| {
        let (time, share) = (about.time(ticks), ticks as f64 / total);
        table::number(out, &clock(time), time);
        table::number(out, &format!("{} %", fixed(PERCENT * share, 1)), share);
        let shown = way.map(|way| format!("{} m{of}", metres(way)));
        table::number(out, &shown.unwrap_or_default(), way.unwrap_or(0.0));
    };
    let ways =
        [(Some(sums.cut), " of the tip"), (Some(sums.travel), "")].into_iter().chain(std::iter::repeat((None, "")));
    for ((name, &ticks), (way, of)) in
        Sums::PARTS.iter().zip(&sums.ticks).zip(ways).filter(|((_, ticks), _)| **ticks > 0)
    {
        out.open("tr", &[]).element("td", &[], name);
        cells(ticks, way, of, out);
        bar(name, ticks as f64 / total, out);
        out.close("tr");
    }
    table::totals(out);
    out.open("tr", &[]).element("th", &[("scope", "row")], "in all");
    cells(sums.total(), Some(sums.cut + sums.travel), "", out);
    out.element("td", &[], "").close("tr");
    table::close(out);
    let words = "Of the tip: with overlaps, without what the blade cuts along its own width where it plunges.";
    out.element("p", &[("class", "hint")], words);
    if about.outcome.controller.is_some() {
        let words = "The motion that is played here has these times. The controller paces the same way by its own planner, and \
                     takes longer or shorter over each cut.";
        out.element("p", &[("class", "hint")], words);
    }
    out.close("section");
}

/// Cell with a bar of a share.
fn bar(name: &str, share: f64, out: &mut Markup) {
    let value = fixed(share, 4);
    out.open("td", &[]).open("meter", &[("value", &value), ("aria-label", name)]).close("meter").close("td");
}

/// Breakdown of the time with the knife down on its way: one row per limit that keeps a cut from being faster.
fn limited(about: &About, sums: &Sums, out: &mut Markup) {
    let bounds = sums.bounds();
    if bounds.is_empty() {
        return;
    }
    out.open("section", &[("id", "limited")]).element("h2", &[], "Limits of the cutting");
    let words =
        "Starts and stops: from rest to speed and back to rest. Feed: what the profile or the file allows the tip.";
    table::open(out, "bars", &["Limited by", "#Time", "#Of cutting", ""]);
    let all: u64 = bounds.iter().map(|(_, ticks)| ticks).sum();
    for (bound, ticks) in bounds {
        let (time, share, name) = (about.time(ticks), ticks as f64 / all as f64, limit(bound));
        out.open("tr", &[]).element("td", &[], &name);
        table::number(out, &clock(time), time);
        table::number(out, &format!("{} %", fixed(PERCENT * share, 1)), share);
        bar(&name, share, out);
        out.close("tr");
    }
    table::close(out);
    out.element("p", &[("class", "hint")], words).close("section");
}

/// Name of a limit; axes in capitals as elsewhere on the page.
pub(super) fn limit(bound: Bound) -> String {
    let words = bound.to_string();
    match words.rsplit_once(' ') {
        Some((order, axis)) if axis.len() == 1 => format!("{order} {}", axis.to_uppercase()),
        _ => words,
    }
}
