//! Points that need attention: messages, findings of the verifier, declared deviations.

use super::table::{self, Cells};
use crate::back::html::about::{About, Worth, is_finite, place as place_of};
use crate::back::html::piece::Piece;
use crate::diagnostic::pieces::listed;
use crate::diagnostic::{Code, Diagnostic, Harm, Severity, code, rank};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::declaration::{Declaration, Kind, Total};
use crate::picture::Markup;
use crate::units::number::{clock, counted, exact, fixed, short};

/// Maximum number of messages listed per code; people fix the worst of them and compile again.
const MOST_MESSAGES: usize = 40;
/// Numbers of messages of a code and of deviations that the style sheet leaves on paper.
const PRINTED: [usize; 2] = [10, 40];
/// Values below this, in any unit, are rounding of the computation.
const NOISE_EPSILON: f64 = 1e-8;
/// Rules of overcuts into parts, each with the warning of a compile that tells its places.
const OVERCUTS: [(&str, &Code); 2] =
    [("verify/overcut-part", &code::PATH_OVERCUT), ("verify/overcut-neighbour", &code::PATH_OVERCUT_NEIGHBOUR)];
/// Distance within which a message and a finding are about one place, mm: the deepest place of a cut and the end of its blade.
const SAME_PLACE: f64 = 0.5;
/// Depths that differ by less are equal on the page, mm.
const ROUNDING: f64 = 0.01;
/// Percent of a whole limit.
const PERCENT: f64 = 100.0;

/// Moment at which the blade is at a place: its time, s, or the piece with which it comes there, by index.
#[derive(Debug, Clone, Copy)]
enum Moment {
    At(f64),
    During(usize),
    /// With any piece.
    Any,
}

/// Button that moves the player to a place, and to the moment at which the blade is there; `told` is shown beside the cloth.
fn jump(out: &mut Markup, at: Point, moment: Moment, told: &str) {
    let told = told.replace('`', "");
    let (x, y) = (fixed(at.x, 3), fixed(at.y, 3));
    let (time, part) = match moment {
        Moment::At(time) => (Some(fixed(time, 6)), None),
        Moment::During(part) => (None, Some(part.to_string())),
        Moment::Any => (None, None),
    };
    let mut attributes = vec![("type", "button"), ("class", "jump"), ("data-x", x.as_str()), ("data-y", y.as_str())];
    attributes.push(("data-told", &told));
    attributes.extend(time.as_deref().map(|time| ("data-time", time)));
    attributes.extend(part.as_deref().map(|part| ("data-part", part)));
    let at = format!("X {} Y {}", fixed(at.x, 1), fixed(at.y, 1));
    let words = if let Moment::At(time) = moment { format!("{at}, {}", clock(time, 3)) } else { at };
    out.element("button", &attributes, &words);
}

/// Messages of one code.
struct Group<'a> {
    code: &'static Code,
    messages: Vec<&'a Diagnostic>,
}

/// Groups messages by code, the worst code first as everywhere; within a code the worst first, where measured.
fn groups<'a>(messages: &[&'a Diagnostic]) -> Vec<Group<'a>> {
    let mut groups: Vec<Group> = Vec::new();
    for &message in messages {
        match groups.iter_mut().find(|group| group.code == message.code) {
            Some(group) => group.messages.push(message),
            None => groups.push(Group { code: message.code, messages: vec![message] }),
        }
    }
    groups.sort_by_key(|group| rank(group.code));
    for group in &mut groups {
        group.messages.sort_by(|a, b| b.by.unwrap_or(0.0).total_cmp(&a.by.unwrap_or(0.0)));
    }
    groups
}

/// True if a warning is about harm to parts.
fn spoils(code: &Code) -> bool {
    code.severity == Severity::Warning && code.harm == Harm::Spoils
}

/// Advice on the program before it is run.
pub(super) fn to_do(about: &About) -> &'static str {
    let is_harm = about.outcome.messages.iter().any(|message| spoils(message.code));
    match (about.worth(), is_harm) {
        (Worth::Refused, _) => "No program was written. Mend the errors and compile again.",
        (Worth::NotJudged, _) => "The program is not verified. Verify it before you cut.",
        (Worth::Verified, true) => "Before you cut, look at the warnings of parts that may be spoilt.",
        (Worth::Verified, false) => "Nothing must be done before you cut: there is no warning of harm to parts.",
    }
}

/// Part in which a deviation lies; `None` if it lies in none.
pub(super) fn into<'a>(about: &About<'a>, entry: &Declaration) -> Option<&'a Piece> {
    about.pieces.get(entry.part.or(entry.within)? as usize)
}

/// The piece with whose cut a deviation comes.
pub(super) fn piece_of<'a>(about: &About<'a>, entry: &Declaration) -> &'a Piece {
    &about.pieces[about.context.marker.cuts[entry.cut as usize].piece as usize]
}

/// Button that leads to the place of a deviation.
pub(super) fn jump_to(about: &About, entry: &Declaration, words: &str, out: &mut Markup) {
    jump(out, Point::from(entry.at_mm), Moment::During(piece_of(about, entry).whole), words);
}

/// The section of errors and warnings, grouped by code.
pub(super) fn messages(about: &About, out: &mut Markup) {
    let groups = groups(about.outcome.messages);
    out.open("section", &[("id", "messages")]).element("h2", &[], "Messages");
    if groups.is_empty() {
        out.element("p", &[], "There are none.");
    }
    for Group { code, messages } in groups {
        let severity = match code.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        let count = counted(messages.len(), severity);
        let harm = if spoils(code) { "may spoil parts: " } else { "" };
        let few = match messages.len() {
            0..=MOST_MESSAGES => String::new(),
            _ => format!(" (the worst {MOST_MESSAGES}; the others stand with their pieces)"),
        };
        out.open("p", &[("class", &format!("group {severity}"))]).element("strong", &[], &count).text(harm);
        out.element("code", &[], code.name).text(&few).close("p");
        out.open("p", &[("class", "about")]).prose(code.about).close("p");
        // A hint common to all of them is shown once.
        let shared =
            messages[0].hints.iter().filter(|hint| messages.iter().all(|message| message.hints.contains(hint)));
        let shared: Vec<&String> = shared.collect();
        printed(PRINTED[0], messages.len(), out);
        let shown = messages.len().min(MOST_MESSAGES);
        let (first, more) = messages[..shown].split_at(shown.min(PRINTED[0]));
        out.open("ol", &[("class", "messages")]);
        for message in first {
            entry(about, message, &shared, out);
        }
        out.close("ol");
        if !more.is_empty() {
            out.open("details", &[]).element("summary", &[], &format!("{} more", more.len()));
            out.open("ol", &[("class", "messages"), ("start", &(PRINTED[0] + 1).to_string())]);
            for message in more {
                entry(about, message, &shared, out);
            }
            out.close("ol").close("details");
        }
        for hint in shared {
            advice(hint, out);
        }
    }
    out.close("section");
}

/// One message, with the hints that are not common to its group.
fn entry(about: &About, message: &Diagnostic, shared: &[&String], out: &mut Markup) {
    out.open("li", &[]).open("span", &[]).prose(&message.message).close("span");
    let several = (!message.pieces.is_empty()).then(|| listed(&message.pieces));
    if let Some(title) = title(about, message).or(several) {
        out.text(" ").element("span", &[("class", "quiet")], &title);
    }
    out.text(" ");
    to_place(about, message, out);
    for hint in message.hints.iter().filter(|hint| !shared.contains(hint)) {
        advice(hint, out);
    }
    out.close("li");
}

/// Button that leads to the place of a message, if it has one.
pub(super) fn to_place(about: &About, message: &Diagnostic, out: &mut Markup) {
    if let Some(at) = place_of(message) {
        jump(out, at, moment(about, message), &told(about, message));
    }
}

/// A line of advice.
fn advice(text: &str, out: &mut Markup) {
    out.open("p", &[("class", "hint")]).prose(text).close("p");
}

/// Line on paper about entries that are left out there.
fn printed(most: usize, count: usize, out: &mut Markup) {
    if count > most {
        out.element("p", &[("class", "omitted")], &format!("The first {most} of {count} are printed."));
    }
}

/// A message with its piece.
pub(super) fn told(about: &About, message: &Diagnostic) -> String {
    let piece = title(about, message).map(|piece| format!("{piece}: "));
    piece.unwrap_or_default() + &message.message
}

/// The piece that a message names.
pub(super) fn piece<'a>(about: &About<'a>, message: &Diagnostic) -> Option<&'a Piece> {
    let name = message.piece.as_deref()?;
    about.pieces.iter().find(|piece| piece.is_called(name))
}

/// Name of the piece of a message, as everywhere on the page.
fn title(about: &About, message: &Diagnostic) -> Option<String> {
    piece(about, message).map(Piece::title).or_else(|| message.piece.as_ref().map(ToString::to_string))
}

/// Moment of a message: while its piece is cut, if it names one.
fn moment(about: &About, message: &Diagnostic) -> Moment {
    piece(about, message).map_or(Moment::Any, |piece| Moment::During(piece.whole))
}

/// The section of the verifier's findings.
pub(super) fn section(about: &About, out: &mut Markup) {
    let findings = about.findings();
    if findings.is_empty() {
        return;
    }
    out.open("section", &[("id", "findings")]).element("h2", &[], "Rules of the verifier");
    let words = "Nearest to its limit: the value that leaves least room. Where limits differ from place to place, as those of \
                 overcuts do, a greater value elsewhere may leave more.";
    out.element("p", &[("class", "hint")], words);
    table::open(
        out,
        "sortable",
        &["Rule", "Verdict", "#Nearest to its limit", "#Limit there", "#Of limit", "Where", "Promise"],
    );
    for finding in findings {
        row(about, finding, out);
    }
    table::close(out);
    out.close("section");
}

fn row(about: &About, finding: &Finding, out: &mut Markup) {
    let Finding { rule, worst, limit, unit, place } = finding;
    let verdict = match (limit, finding.holds()) {
        (None, _) => "reported",
        (Some(_), true) => "holds",
        (Some(_), false) => "broken",
    };
    out.open("tr", &[("class", verdict)]).element("td", &[], rule.name).element("td", &[], verdict);
    let shown = |value: f64| match value.abs() {
        noise if noise < NOISE_EPSILON => format!("0 {unit}"),
        _ if !value.is_finite() => "missing".to_owned(),
        // A value and the limit that it breaks may differ in late digits only.
        _ if finding.holds() => format!("{} {unit}", exact(format!("{value:.3e}").parse().unwrap_or(value))),
        _ => format!("{} {unit}", short(value)),
    };
    table::number(out, &shown(*worst), *worst);
    // The limit with the rounding of the rows, which is allowed, and that of the profile.
    let allowed = *limit;
    let limit = allowed.map(|allowed| about.record.limit(rule.name, allowed));
    match allowed.zip(limit) {
        Some((allowed, limit)) => {
            let rounding = if *worst > limit && finding.holds() { allowed - limit } else { 0.0 };
            let more = if rounding > 0.0 { format!(" and {} of rounding", shown(rounding)) } else { String::new() };
            table::number(out, &(shown(limit) + &more), limit);
            let share = if limit > 0.0 { PERCENT * worst / allowed } else { 0.0 };
            let words = if limit > 0.0 && share.is_finite() { format!("{} %", fixed(share, 1)) } else { String::new() };
            table::number(out, &words, share);
        }
        None => _ = out.element("td", &[("class", "number")], "").element("td", &[("class", "number")], ""),
    }
    out.open("td", &[]);
    if let Some(place) = place.filter(|place| is_finite(place.point)) {
        let limit = allowed.map(|allowed| format!(" of {}", shown(allowed))).unwrap_or_default();
        let mut words = format!("{}, {verdict} with {}{limit}: {}", rule.name, shown(*worst), rule.about);
        let is_here = |message: &&&Diagnostic| place_of(message).is_some_and(|at| is_one(at, place.point));
        let here = about.outcome.messages.iter().find(is_here).map(|message| format!(". {}", told(about, message)));
        words += &here.unwrap_or_default();
        jump(out, place.point, place.time.map_or(Moment::Any, Moment::At), &words);
    }
    deepest(about, finding, out);
    out.close("td").open("td", &[]).prose(rule.about);
    if !finding.holds() {
        for line in rule.more.lines().filter(|line| !line.trim().is_empty()) {
            advice(line.trim(), out);
        }
    }
    out.close("td").close("tr");
}

/// True if two places are one for a message and a finding.
fn is_one(a: Point, b: Point) -> bool {
    (a - b).norm() <= SAME_PLACE
}

/// Line on the deepest entry into a part with a warning, for the rule that judges it. The worst value of the rule is the one
/// nearest to its own limit, often at another place.
fn deepest(about: &About, finding: &Finding, out: &mut Markup) {
    let Some((_, code)) = OVERCUTS.iter().find(|(name, _)| *name == finding.rule.name) else { return };
    if finding.worst < NOISE_EPSILON {
        // A declared overlap that ends within the tolerance of an edge is no depth.
        let overlaps =
            about.outcome.declared.iter().find(|total| total.kind == Kind::Overcut && *code == &code::PATH_OVERCUT);
        if let Some(Total { count, worst_mm, .. }) = overlaps {
            let declared = counted(*count, "overlap");
            let words = format!(
                "{declared} into parts declared, at most {} mm long: as deep as the tolerance counts as the edge",
                fixed(*worst_mm, 2)
            );
            out.element("p", &[("class", "hint")], &words);
        }
    }
    let messages = about.outcome.messages.iter().filter(|message| message.code == *code);
    let Some((message, by)) = deepest_of(messages) else { return };
    let into = if message.pieces.is_empty() { String::new() } else { format!(" into {}", listed(&message.pieces)) };
    let at = place_of(message);
    let is_here = at.zip(finding.place).is_some_and(|(at, here)| is_one(at, here.point));
    if is_here {
        out.element("p", &[("class", "hint")], &format!("the deepest entry{into}"));
        return;
    }
    let more = if by > finding.worst + ROUNDING { ", where more is allowed," } else { "" };
    out.open("p", &[("class", "hint")]).text(&format!("deepest entry: {} mm{into}{more} ", fixed(by, 2)));
    if let Some(at) = at {
        jump(out, at, moment(about, message), &told(about, message));
    }
    out.close("p");
}

/// Message with the greatest magnitude, the first of equals: it is the first in its list as well.
fn deepest_of<'a>(messages: impl Iterator<Item = &'a &'a Diagnostic>) -> Option<(&'a Diagnostic, f64)> {
    let measured = messages.filter_map(|message| Some((*message, message.by?)));
    measured.reduce(|deepest, other| if other.1 > deepest.1 { other } else { deepest })
}

/// The section of declared deviations with their places.
pub(super) fn deviations(about: &About, out: &mut Markup) {
    let entries = about.deviations();
    if entries.is_empty() {
        return;
    }
    out.open("section", &[("id", "deviations")]).element("h2", &[], "Declared deviations from the drawing");
    let count = about.outcome.deviations.len();
    if count > entries.len() {
        let words =
            format!("{} of {count}, of each kind the greatest; the program's .meta.json has all.", entries.len());
        out.element("p", &[], &words);
    }
    printed(PRINTED[1], count, out);
    for Total { kind, count, worst_mm, .. } in about.outcome.declared {
        let [one, many] = kind.words();
        let name = if *count == 1 { one } else { many };
        let words = format!("{count} {name}, at most {} {}: {}", fixed(*worst_mm, 2), kind.unit(), kind.about());
        out.element("p", &[("class", "hint")], &words);
    }
    let columns = ["Deviation", "Piece", "Into", "#Size, mm", "Where"];
    table::open(out, "sortable", &columns);
    for entry in entries {
        let mut cells = Cells::of(&columns, 0);
        let piece = piece_of(about, &entry);
        let [one, _] = entry.kind.words();
        out.open("tr", &[]);
        cells.text(one, &[], out);
        cells.text(&piece.title(), &[], out);
        let into = into(about, &entry).map(|part| match part.whole {
            own if own == piece.whole => "its own part".to_owned(),
            _ => part.title(),
        });
        let mut words = format!("{one}, {} mm: {}", fixed(entry.size_mm(), 3), piece.title());
        if let Some(into) = &into {
            words.extend([" into ", into]);
        }
        cells.text(&into.unwrap_or_default(), &[], out);
        cells.number(&fixed(entry.size_mm(), 3), entry.size_mm(), out);
        cells.open(&[], out);
        jump_to(about, &entry, &words, out);
        out.close("td").close("tr");
    }
    table::close(out);
    out.close("section");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_without_a_time_is_jumped_to_by_its_place() {
        let mut out = Markup::default();
        jump(&mut out, Point::new(1.0, -2.0), Moment::During(3), "set `a`");
        assert_eq!(
            out.into_text(),
            "<button type=\"button\" class=\"jump\" data-x=\"1.000\" data-y=\"-2.000\" \
             data-told=\"set a\" data-part=\"3\">X 1.0 Y -2.0</button>\n"
        );
    }
}
