//! The short answers: what people ask first of a job.

use super::findings::{self, jump_to};
use super::lines::uncut;
use super::pieces;
use super::totals::{cost, time};
use crate::back::html::about::{About, clock};
use crate::back::html::record::Sums;
use crate::ir::declaration::Declaration;
use crate::picture::Markup;
use crate::units::number::{counted, fixed};

const PERCENT: f64 = 100.0;
/// Least share of the time of an activity that is named.
const LEAST_SPENT: f64 = 0.05;

/// Where the blade is off its drawn line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Where {
    Another,
    Own,
    Aside,
}

impl Where {
    const ALL: [Self; 3] = [Self::Another, Self::Own, Self::Aside];

    fn of(about: &About, entry: &Declaration) -> Self {
        match findings::into(about, entry) {
            Some(part) if part.whole == findings::piece_of(about, entry).whole => Self::Own,
            Some(_) => Self::Another,
            None => Self::Aside,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Another => "Deepest in another part",
            Self::Own => "Deepest in its own part",
            Self::Aside => "Farthest beside its line",
        }
    }
}

/// The section of short answers.
pub(super) fn section(about: &About, out: &mut Markup) {
    out.open("section", &[("id", "short")]).element("h2", &[], "In short").open("table", &[("class", "facts")]);
    row("To do", findings::to_do(about), out);
    if about.record.ticks() > 0 {
        off(about, out);
        let (piece, ticks) = pieces::longest(about);
        let all = clock(about.time(about.record.all.total()));
        let played = about.outcome.controller.map_or("", |_| ", as it is played here");
        let longest = format!("{}: {} of {all}{played}", piece.title(), clock(about.time(ticks)));
        row("Longest piece", &longest, out);
        row("Time is spent on", &spent(about), out);
        let total = time(about).map(clock).unwrap_or_default();
        let cost = cost(about).map(|cost| format!("; cost {cost}"));
        row("Time in all", &(total + &cost.unwrap_or_default()), out);
    }
    let all = match &about.context.marker.drawing {
        Some(_) => "none: every line of the drawing is cut",
        None => "none: the file says itself what is cut",
    };
    row("Lines not cut", &uncut(about).unwrap_or_else(|| all.to_owned()), out);
    out.close("table").close("section");
}

fn row(name: &str, value: &str, out: &mut Markup) {
    out.open("tr", &[]).element("th", &[("scope", "row")], name).element("td", &[], value).close("tr");
}

/// Rows of the farthest places off the drawing, as the program declares them.
fn off(about: &About, out: &mut Markup) {
    let entries = about.deviations();
    let counts = Where::ALL.map(|place| {
        let all = about.outcome.deviations.iter().filter(|entry| entry.kind.is_off());
        all.filter(|entry| Where::of(about, entry) == place).count()
    });
    for (place, count) in Where::ALL.into_iter().zip(counts) {
        let is_there = |entry: &&Declaration| entry.kind.is_off() && Where::of(about, entry) == place;
        let Some(worst) = entries.iter().find(is_there) else {
            row(place.name(), "nowhere, as declared", out);
            continue;
        };
        let part = match place {
            Where::Another => findings::into(about, worst).map(|part| format!(" in {}", part.title())),
            Where::Own | Where::Aside => None,
        };
        let cutter = findings::piece_of(about, worst).title();
        let words = format!("{} mm{}, with a cut of {cutter}", fixed(worst.size_mm(), 2), part.unwrap_or_default());
        out.open("tr", &[]).element("th", &[("scope", "row")], place.name()).open("td", &[]).text(&words).text(" ");
        jump_to(about, worst, &format!("{}: {words}", place.name()), out);
        out.text(&format!(" ({})", counted(count, "place"))).close("td").close("tr");
    }
}

/// Activities that most of the time is spent on, in words.
fn spent(about: &About) -> String {
    let sums = &about.record.all;
    let mut parts: Vec<(&str, u64)> = Sums::PARTS.into_iter().zip(sums.ticks).collect();
    parts.sort_by_key(|(_, ticks)| std::cmp::Reverse(*ticks));
    let shares = parts.iter().map(|&(name, ticks)| (name, ticks as f64 / sums.total() as f64));
    let said = shares.filter(|(_, share)| *share >= LEAST_SPENT);
    let said = said.map(|(name, share)| format!("{name} {} %", fixed(PERCENT * share, 1)));
    said.collect::<Vec<_>>().join(", ")
}
