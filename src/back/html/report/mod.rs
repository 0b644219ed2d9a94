//! The report: markup that describes the job and lists everything to check before cutting.

mod findings;
mod pieces;
mod table;
mod totals;

use super::about::About;
use crate::back::target::Context;
use crate::diagnostic::Severity;
use crate::machine::{Mode, sha256_hex};
use crate::picture::{Markup, Script};
use crate::units::number::{counted, fixed};

/// Markup of the page.
pub(super) fn body(about: &About) -> String {
    let mut out = Markup::default();
    out.open("header", &[]).element("h1", &[], &about.file());
    let worth = about.worth();
    out.element("p", &[("class", "worth"), ("data-worth", worth.word())], worth.words());
    tally(about, &mut out);
    out.element("p", &[("class", "summary")], &totals::summary(about)).close("header");
    if about.record.ticks() > 0 {
        out.markup(Script::Cutting.markup());
    }
    out.open("main", &[("id", "report")]);
    job(about, &mut out);
    totals::section(about, &mut out);
    findings::messages(about, &mut out);
    findings::section(about, &mut out);
    pieces::section(about, &mut out);
    findings::deviations(about, &mut out);
    pieces::windows(about, &mut out);
    out.close("main");
    out.into_text()
}

/// Numbers of errors and warnings, with a link to their list.
fn tally(about: &About, out: &mut Markup) {
    let count = |severity| about.outcome.messages.iter().filter(|message| message.code.severity == severity).count();
    let counts = [(count(Severity::Error), "error"), (count(Severity::Warning), "warning")];
    let said: Vec<String> =
        counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, word)| counted(count, word)).collect();
    out.open("p", &[("class", "tally")]);
    if said.is_empty() {
        out.text("no warnings");
    } else {
        out.element("a", &[("href", "#messages")], &said.join(", "));
    }
    out.close("p");
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
        ("Machine", job.origin.described()),
        ("Digest of the machine", profile.digest()),
        ("Knife", knife),
        ("Cycle", format!("{} ms", fixed(profile.time.period_ms, 3))),
        ("Mode", mode.to_owned()),
        ("Compiler", format!("cutc {}", env!("CARGO_PKG_VERSION"))),
        ("Verified", about.worth().words().to_owned()),
    ];
    rows.extend(job.remarks.date.iter().map(|date| ("Date", date.clone())));
    table::facts(out, "job", "Job", &rows);
}
