//! Judging: a program is read back, and broken rules are reported.

use std::fmt::Write as _;
use std::io::{self, BufRead as _, BufReader, Read as _};

use super::input::{Judged, Reading, make_cuts, read_to_judge};
use super::product::{BLOCK, Medium};
use super::rounded::significant;
use super::told::{Explained, quote, told};
use super::{off_table, overreach};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::front::Dialect;
use crate::ir::marker::{Notch, Piece};
use crate::ir::verdict::{Rule, Verdict, sort};
use crate::ir::{Finding, Marker};
use crate::machine::{Job, Mode};
use crate::source::{Source, Span};
use crate::units::number::{exact, fixed, up};
use crate::verify::{self, Declared, Ground, Kind, rules};

/// The rules about readable programs.
static FORMAT: [&Rule; 2] = [&rules::FORMAT, &verify::spray::rules::FORMAT];
/// Least excess over the edge of the table that is reported while the rule holds, mm.
const EDGE_SHOWN: f64 = 0.01;
/// Codes of outlines that cross themselves or others: the side of the part is in doubt there.
const CROSSING: [&Code; 2] = [&code::MARKER_SELF_CROSSING, &code::MARKER_OVERLAPPING];
/// Rules that may be broken where runs are split and the blade has no room for it.
static OF_PARTS: [&Rule; 6] =
    [&rules::ON_PATH, &rules::STRAY, &rules::ONCE, &rules::COMPLETE, &rules::HEADING, &rules::BODY];
/// Significant digits at which figures of findings are shown to people.
const DIGITS: i32 = 4;
/// Below this, in any unit, an allowed value is rounding of the computation.
const NOISE_EPSILON: f64 = 0.99e-9;
/// Greatest number of digits that tell a worst value from its limit; beyond, they differ by rounding alone.
const MOST_DIGITS: i32 = 15;

/// Judges a program, edited by hand or not, against a source. `None` when the source has errors: then the diagnostics tell
/// them. The diagnostics are about the source alone; broken rules of the program are in the verdict.
pub fn judge_program(
    program: &mut dyn Medium,
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    declared: Option<&Declared>,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Explained>> {
    let Some(judged) = read_to_judge(source, from, job, diagnostics) else { return Ok(None) };
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let Judged { mut input, reading } = judged;
    make_cuts(&mut input, source, job, diagnostics);
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let audit = audited(source, input.dialect, reading, job);
    let marker = &input.marker;
    let verdict = judge(Asked { source, marker, ground: None, declared, job }, &audit, program)?;
    let mut told = told(&verdict, marker, source, job);
    quote(&mut told, program, job)?;
    Ok(Some(Explained { verdict, told }))
}

/// Reason that a file is no program that can be judged for a job, by its first bytes, and what to do about it; `None` when it is one.
pub fn foreign(file: &mut dyn Medium, job: &Job) -> io::Result<Option<[String; 2]>> {
    file.rewind()?;
    let mut file = BufReader::with_capacity(BLOCK, file);
    if verify::spray::begins(file.fill_buf()?) { Ok(None) } else { verify::foreign(&mut file, &job.profile) }
}

/// Input of a judgement.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) source: &'a Source,
    pub(super) marker: &'a Marker,
    /// The ground of the marker, if it was made before.
    pub(super) ground: Option<&'a Ground<'a>>,
    /// Deviations from the drawing that the program declares; `None` when it declares nothing at all.
    pub(super) declared: Option<&'a Declared>,
    pub(super) job: &'a Job,
}

/// Reads a program back from its start and judges it; `audit` holds the findings about its source.
///
/// If the knife stays up nothing may be cut: the program is judged against a marker without lines, so that every stroke is one
/// too many, and the rules about the manner of cutting are left out.
pub(super) fn judge(
    Asked { source, marker, ground, declared, job }: Asked,
    audit: &[Finding],
    program: &mut dyn Medium,
) -> io::Result<Verdict> {
    program.rewind()?;
    let mut input = BufReader::with_capacity(BLOCK, program);
    let mut verdict = match verify::kind(&mut input, &job.profile) {
        Some(Kind::CutterFile) => {
            let mut bytes = Vec::new();
            input.read_to_end(&mut bytes)?;
            verify::cutter_file(&bytes, marker, source, job)
        }
        kind => {
            let judge_motion = if kind == Some(Kind::Positions) { verify::positions } else { verify::setpoints };
            let mut judge_by = |ground: &Ground| judge_motion(&mut input, declared, ground, job);
            if let Some(ground) = ground {
                judge_by(ground)
            } else if job.mode.cuts() {
                judge_by(&Ground::new(marker, &job.profile))
            } else {
                let mut verdict = judge_by(&Ground::new(&uncut(marker, job.mode), &job.profile));
                verdict.findings.retain(|finding| !finding.rule.needs_cut);
                verdict
            }
        }
    };
    verdict.findings.extend_from_slice(audit);
    sort(&mut verdict.findings);
    Ok(verdict)
}

/// Findings about the reading of the source against its bytes, and about the passes.
pub fn audited(source: &Source, dialect: &Dialect, reading: Reading, job: &Job) -> Vec<Finding> {
    let Reading { census, patterns, drawing, kept, laid } = reading;
    let audit = match patterns {
        Some(places) => Some(verify::pattern_audit(source.bytes(), &places, job)),
        None => verify::source_audit(dialect.name, source.bytes(), &census, &job.profile),
    };
    let drawing = drawing.map(|cuts| verify::drawing_audit(dialect.name, source.bytes(), &cuts, job));
    audit.into_iter().flatten().chain(drawing.into_iter().flatten()).chain([kept]).chain(laid).collect()
}

/// Rest of a marker if the knife stays up: the events for a dry run, nothing for a frame.
fn uncut(marker: &Marker, mode: Mode) -> Marker {
    match mode {
        Mode::Cut | Mode::Dry => {
            let told = |piece: &Piece| Piece { events: piece.events.clone(), ..Piece::default() };
            let pieces = marker.pieces.iter().map(told).collect();
            Marker { pieces, closing: marker.closing.clone(), unit: marker.unit, ..Marker::default() }
        }
        Mode::Frame => Marker { unit: marker.unit, ..Marker::default() },
    }
}

/// Verdict on two programs of one compile: for each rule the worse finding, the first of two equal ones.
pub fn both(first: Verdict, second: Verdict) -> Verdict {
    let mut findings = first.findings;
    for finding in second.findings {
        match findings.iter_mut().find(|known| known.rule == finding.rule) {
            Some(known) if known.holds() && !finding.holds() => *known = finding,
            Some(_) => {}
            None => findings.push(finding),
        }
    }
    sort(&mut findings);
    let (mut untimed, mut uncut) = (first.untimed, first.uncut);
    uncut.extend(second.uncut);
    uncut.sort_unstable();
    uncut.dedup();
    untimed.extend(second.untimed);
    untimed.retain(|rule| findings.iter().all(|finding| finding.rule != *rule));
    Verdict { findings, unread: first.unread.or(second.unread), untimed, uncut }
}

/// Adds a diagnostic for each broken rule.
pub fn report(verdict: &Verdict, marker: &Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let crossing = diagnostics.iter().map(|known| known.code).find(|code| CROSSING.contains(code));
    for finding in verdict.broken() {
        let (worst, limit) = figures(finding);
        let unit = finding.unit;
        let mut message = format!("{}: {worst} {unit}", finding.rule.name);
        if let Some(limit) = limit {
            let _ = write!(message, " ({limit} allowed)");
        }
        if let Some(unread) = verdict.unread.as_ref().filter(|_| FORMAT.contains(&finding.rule)) {
            let _ = write!(message, ": {unread}");
        }
        let mut span = None;
        if let Some(place) = finding.place {
            if let Some(time) = place.time {
                let _ = write!(message, ", {} s into the program", fixed(time, 3));
            }
            span = span_of(marker, place.block);
        }
        let rule = format!("the rule: {}", finding.rule.about);
        let hint = match (finding.rule.key, parting_keys(job)) {
            (_, Some(keys)) if OF_PARTS.contains(&finding.rule) => {
                format!("{keys} parts this cut into pieces that the blade is too wide for: give it more")
            }
            (Some(key), _) if crossing.is_none() => {
                format!("the limit is the profile's `{key}`; where that is its default this is a fault of `cutc`")
            }
            _ if finding.rule == &rules::TABLE => off_table::advice(marker, job),
            _ => fault(crossing, job.lines.all),
        };
        let at = finding.place.map(|place| Box::new(place.point.into()));
        let diagnostic = Diagnostic { span, at, ..Diagnostic::new(&code::VERIFY_BROKEN, message) };
        diagnostics.push(diagnostic.hint(rule).hint(hint));
    }
    over_the_edge(verdict, job, diagnostics);
}

/// Advice on a broken rule that the profile does not answer for. Outlines may be known to cross, as they do if every line of a
/// plot is cut.
fn fault(crossing: Option<&Code>, is_all_cut: bool) -> String {
    match crossing {
        Some(Code { name, .. }) if is_all_cut => format!(
            "`--cut-all` cuts seam lines, grain lines and letters across each other (`{name}`): compile without it, or \
             name pens that do not cross with `--cut-pens`"
        ),
        Some(Code { name, .. }) => {
            format!(
                "mend the outlines of which `{name}` tells; what is still said is a fault of `cutc`: please report it"
            )
        }
        None => {
            "this is a fault of `cutc`, whatever the file: please report it, with the file and the profile".to_owned()
        }
    }
}

/// Adds a line about a blade that leaves the table by less than is refused, unless the marker itself is known to.
fn over_the_edge(verdict: &Verdict, job: &Job, diagnostics: &mut Diagnostics) {
    let over = verdict.under(&rules::TABLE).filter(|finding| finding.holds());
    let Some((by, place)) = over.and_then(|finding| Some((finding.worst, finding.place?))) else { return };
    if by < EDGE_SHOWN || diagnostics.iter().any(|finding| finding.code == &code::MARKER_OVER_EDGE) {
        return;
    }
    let message = format!("the knife reaches over the edge of the table: {} mm", up(by, 2));
    let finding = Diagnostic::new(&code::MARKER_OVER_EDGE, message).on_cloth(place.point).by(by);
    diagnostics.push(if overreach::may_lay(job) { finding.hint(overreach::LAY) } else { finding });
}

/// The keys of the profile by which runs are split amid a line, as the start of a sentence; `None` if there are none.
fn parting_keys(job: &Job) -> Option<&'static str> {
    match (job.profile.knife.max_down_mm, job.profile.c.range_deg) {
        (Some(_), Some(_)) => Some("`knife.max_down_mm` or `c.range_deg`"),
        (Some(_), None) => Some("`knife.max_down_mm`"),
        (None, Some(_)) => Some("`c.range_deg`"),
        (None, None) => None,
    }
}

/// The worst value and the limit of a finding for people: short, but distinct if the worst value breaks the limit.
pub fn figures(finding: &Finding) -> (String, Option<String>) {
    let shown = |value: f64, digits| match value {
        f64::INFINITY => "infinite".to_owned(),
        noise if noise < NOISE_EPSILON && finding.holds() => "0".to_owned(),
        _ => exact(significant(value, digits)),
    };
    // Rounded up, so that the worst value passes if it is set as the limit.
    let above = |digits| {
        if !finding.worst.is_normal() || finding.worst < NOISE_EPSILON {
            return finding.worst;
        }
        let near = significant(finding.worst, digits);
        let step = 10_f64.powi(finding.worst.abs().log10().floor() as i32 + 1 - digits);
        if near < finding.worst && digits < MOST_DIGITS { near + step } else { finding.worst }
    };
    let limit = |digits| finding.limit.map(|limit| shown(limit, digits));
    let apart =
        |digits: &i32| finding.holds() || limit(*digits).is_none_or(|limit| limit != shown(finding.worst, *digits));
    let digits = (DIGITS..MOST_DIGITS).find(apart).unwrap_or(MOST_DIGITS);
    (shown(above(digits), digits), limit(digits))
}

/// The span of a source block that is cut.
fn span_of(marker: &Marker, block: u32) -> Option<Span> {
    let contours = marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range)).map(|(_, s)| s.span);
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches).flat_map(Notch::strokes).map(|cut| cut.span);
    contours.chain(notches).find(|span| span.block == block && block > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::keys;
    use crate::machine::plot::Lines;

    #[test]
    fn a_broken_limit_is_seen_in_the_figures() {
        let check = |worst, limit, expected: (&str, Option<&str>)| {
            let finding = Finding { rule: &rules::BODY, worst, limit, unit: "mm", place: None };
            let (worst, limit) = figures(&finding);
            assert_eq!((worst.as_str(), limit.as_deref()), expected);
        };
        check(0.061_234, Some(0.071), ("0.06124", Some("0.071")));
        check(0.071_000_2, Some(0.071), ("0.0710002", Some("0.071")));
        check(204_000.2, Some(204_000.0), ("204000.2", Some("204000")));
        check(203_999.8, Some(204_000.0), ("204000", Some("204000")));
        check(5e-7, Some(0.0), ("0.0000005", Some("0")));
        check(f64::INFINITY, Some(0.1), ("infinite", Some("0.1")));
        check(4e-12, Some(1e-9), ("0", Some("0.000000001")));
        check(4e-12, Some(0.0), ("0.000000000004", Some("0")));
        check(3.0, None, ("3", None));
    }

    #[test]
    fn a_refusal_tells_of_outlines_that_cross_before_it_blames_the_compiler() {
        let said_of = |known: &[&'static Code], job: Job| {
            let finding =
                Finding { rule: &rules::OVERLAP, worst: 0.8, limit: Some(0.05), unit: "mm missing", place: None };
            let verdict = Verdict { findings: vec![finding], ..Verdict::default() };
            let mut diagnostics = Diagnostics::default();
            for code in known {
                diagnostics.push(Diagnostic::new(code, ""));
            }
            report(&verdict, &Marker::default(), &job, &mut diagnostics);
            let last = diagnostics.iter().last().expect("a refusal");
            last.hints.join(" ")
        };
        let said = |known: &[&'static Code]| said_of(known, Job::default());
        assert!(
            said(&[&code::MARKER_SELF_CROSSING]).contains("mend the outlines of which `marker/self-crossing` tells")
        );
        assert!(said(&[]).contains("this is a fault of `cutc`, whatever the file"));
        let every_line = Lines { all: true, ..Lines::default() };
        let of_every_line = said_of(&[&code::MARKER_SELF_CROSSING], Job { lines: every_line, ..Job::default() });
        assert!(of_every_line.contains("compile without it") && !of_every_line.contains("fault"), "{of_every_line}");
    }

    #[test]
    fn the_limit_of_a_rule_is_a_key_of_the_profile() {
        for rule in [verify::RULES, verify::spray::RULES].concat() {
            assert!(rule.key.is_none_or(|key| keys::find(key).is_some()), "{rule:?}");
        }
    }
}
