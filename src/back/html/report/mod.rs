//! The report: markup that describes the job and lists everything to check before cutting.

mod findings;
mod lines;
mod pieces;
mod short;
mod table;
mod totals;

use super::about::{About, Worth};
use crate::back::target::{Beside, Context};
use crate::diagnostic::Severity;
use crate::ir::verdict::counts;
use crate::machine::{Mode, sha256_hex};
use crate::picture::{Markup, Script};
use crate::units::number::{counted, fixed};

/// Attributes of a badge that warns.
const WARNING: [(&str, &str); 2] = [("class", "worth"), ("data-worth", "not-judged")];

/// Markup of the page.
pub(super) fn body(about: &About) -> String {
    let mut out = Markup::default();
    out.open("header", &[]).element("h1", &[], &about.file());
    let worth = about.worth();
    out.element("p", &[("class", "worth"), ("data-worth", worth.word())], worth.words());
    match about.context.job.mode {
        Mode::Cut => {}
        Mode::Dry => _ = out.element("p", &WARNING, "dry run: nothing is cut"),
        Mode::Frame => _ = out.element("p", &WARNING, "frame: nothing is cut"),
    }
    tally(about, &mut out);
    out.element("p", &[("class", "summary")], &totals::summary(about)).close("header");
    // A marker that was refused before it was planned has its cloth, and nothing that moves over it.
    let class = if about.record.ticks() > 0 { "moving" } else { "still" };
    out.open("div", &[("class", class)]).markup(Script::Cutting.markup()).close("div");
    out.open("main", &[("id", "report")]);
    short::section(about, &mut out);
    job(about, &mut out);
    totals::section(about, &mut out);
    lines::section(about, &mut out);
    findings::messages(about, &mut out);
    let is_broken = about.outcome.findings.iter().any(|finding| !finding.holds());
    if is_broken {
        findings::section(about, &mut out);
    }
    pieces::section(about, &mut out);
    findings::deviations(about, &mut out);
    pieces::windows(about, &mut out);
    if !is_broken {
        findings::section(about, &mut out);
    }
    out.close("main");
    out.into_text()
}

/// Numbers of errors and warnings, with a link to their list.
fn tally(about: &About, out: &mut Markup) {
    let count = |severity| about.outcome.messages.iter().filter(|message| message.code.severity == severity).count();
    let counts = [(count(Severity::Error), "error"), (count(Severity::Warning), "warning")];
    let said: Vec<String> =
        counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, word)| counted(count, word)).collect();
    let class = if counts[0].0 > 0 { "tally error" } else { "tally" };
    out.open("p", &[("class", class)]);
    if said.is_empty() {
        out.text("no warnings");
    } else {
        out.element("a", &[("href", "#messages")], &said.join(", "));
    }
    out.close("p").open("p", &[("class", "to")]).element("a", &[("href", "#report")], "report").close("p");
}

/// Judgement of the program in a line.
fn verified(about: &About) -> String {
    let findings = about.outcome.findings;
    let broken = findings.iter().filter(|finding| !finding.holds()).count();
    match about.worth() {
        Worth::Verified => format!("read back, {} hold", counted(counts(findings).0, "rule")),
        Worth::NotJudged => "no: with --no-verify nobody has read the program back".to_owned(),
        Worth::Refused if broken > 0 => format!("read back, {} broken", counted(broken, "rule")),
        Worth::Refused => "no: it was refused before".to_owned(),
    }
}

/// Source, profile and machine of the program.
fn job(about: &About, out: &mut Markup) {
    let Context { source, job, .. } = about.context;
    let profile = &job.profile;
    let mode = match job.mode {
        Mode::Cut => "cut",
        Mode::Dry => "dry run, knife and drills up",
        Mode::Frame => "frame, knife up",
    };
    let mm = |value| fixed(value, 2);
    let knife =
        format!("{} mm wide, C axis {} mm behind the tip", mm(profile.knife.width_mm), mm(profile.knife.radius()));
    let mut rows = vec![
        ("File", about.file()),
        ("SHA-256 of the file", sha256_hex(source.bytes())),
        ("Profile", job.origin.name().to_owned()),
        ("SHA-256 of all values in force", profile.digest()),
    ];
    let set: Vec<String> = job.origin.set.iter().map(|(key, value)| format!("{key} = {value}")).collect();
    rows.extend((!set.is_empty()).then(|| ("Set for this job", set.join("; "))));
    let typed = job.typed();
    rows.extend((!typed.is_empty()).then_some(("Options", typed)));
    rows.extend([
        ("Knife", knife),
        ("Cycle", format!("{} ms", fixed(profile.time.period_ms, 3))),
        ("Mode", mode.to_owned()),
        ("Compiler", format!("cutc {}", env!("CARGO_PKG_VERSION"))),
        ("Verified", verified(about)),
    ]);
    let programs = about.outcome.programs;
    for Beside { name, blake3 } in programs {
        rows.extend([("Program", name.clone()), ("BLAKE3 of the program", blake3.clone())]);
    }
    if programs.is_empty() {
        let words = match about.worth() {
            Worth::Refused => "none: it was refused",
            Worth::Verified | Worth::NotJudged => "none beside this page; -t csv,html writes both",
        };
        rows.push(("Program", words.to_owned()));
    }
    rows.extend(job.remarks.date.iter().map(|date| ("Date", date.clone())));
    table::facts(out, "job", "Job", &rows);
}
