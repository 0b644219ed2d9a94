//! Summary of a file as text: aligned, with units, within 80 columns.

use std::fmt::Write as _;

use super::options::counted;
use super::{bites, edges};
use crate::diagnostic::{Diagnostics, Severity};
use crate::ir::declaration::Total;
use crate::machine::gcode::Planner;
use crate::machine::patterns::Patterns;
use crate::machine::plot::Lines;
use crate::machine::{Follow, Job, Mode, NotchStyle, ToolKind};
use crate::pipeline::{
    Axes, Common, Controller, Limit, Peak, Peaks, Report, Savings, Sides, Spent, TIE_SHARE, Verdict, rules,
};
use crate::units::S_PER_MIN;
use crate::units::number::{fixed, short};

/// Heading of the table of the axes at the end of a summary.
pub(super) const AXES: &str = "\n  greatest value of limit\n";
/// Maximum columns of a line of shares.
const SHARES_WIDTH: usize = 66;
/// Minimum saving to report, as a fraction of the time of the program. Smaller ones are uncertain, because estimates ignore the
/// effect of changed cut lengths.
const TELLING_SHARE: f64 = 0.02;
/// Limit from which values have no decimals. Below it they have two.
const WHOLE_FROM: f64 = 100.0;

/// The summary of a report. Lines on planning are left out if it did not run.
pub(super) fn text(report: &Report, name: &str, diagnostics: &Diagnostics) -> String {
    let mut out = format!("{name}\n");
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    let mut line = |label: &str, value: String| {
        let _ = writeln!(out, "  {label:10} {value}");
    };
    let unit = if report.unit_mm > 0.0 { format!("unit {} mm", short(report.unit_mm)) } else { "no grid".to_owned() };
    line("dialect", format!("{}, {unit}", report.dialect));
    let [width, height] = report.extent_mm;
    line("extent", format!("{} x {} mm", fixed(width, 1), fixed(height, 1)));
    line("pieces", report.pieces.to_string());
    let open = report.contours - report.closed_contours;
    line("contours", format!("{} ({} closed, {open} open)", report.contours, report.closed_contours));
    let notches = report.notches;
    let all: usize = notches.by_kind().iter().map(|(_, count)| count).sum();
    // Rarer kinds are listed only if there are any.
    let said = notches.by_kind().into_iter().filter(|&(kind, count)| count > 0 || matches!(kind, "slit" | "v"));
    let said: Vec<String> = said.map(|(kind, count)| format!("{count} {kind}")).collect();
    let style = match report.program.notch_style {
        Some(NotchStyle::Slit) => ", all cut as slits",
        Some(NotchStyle::Skip) => ", none is cut",
        Some(NotchStyle::AsDrawn) | None => "",
    };
    line("notches", format!("{all} ({}){style}", said.join(", ")));
    line("drills", report.drills.to_string());
    line("labels", report.labels.to_string());
    line("cut", format!("{} m", fixed(report.cut_m, 3)));
    if let &Some(Common { edges, length_m, spared_m, shift_mm, .. }) = &report.common {
        let edges = counted(edges, "common edge");
        let [length, spared] = [length_m, spared_m].map(|length| fixed(length, 3));
        let moved =
            if shift_mm > 0.0 { format!(", moved by {} mm at the most", fixed(shift_mm, 2)) } else { String::new() };
        line("common", format!("{spared} m less: {edges}, {length} m, cut once{moved}"));
    }
    if let Some(near) = report.near_m {
        line("near", format!("{} m beside edges of other parts, a thin strip between two cuts", fixed(near, 3)));
    }
    if let Some(windows) = bites::line(&report.bites) {
        line("bites", windows);
    }
    of_program(report, &mut line);
    line("warnings", diagnostics.count(Severity::Warning).to_string());
    if let Some(edges) = &report.edges {
        out.push_str(&edges::table(edges));
    }
    if !report.bites.is_empty() {
        out.push_str(&bites::table(&report.bites));
    }
    if let Some(axes) = &report.program.axes {
        peaks(&mut out, axes);
    }
    out
}

/// The lines on the planned program.
fn of_program(report: &Report, line: &mut impl FnMut(&str, String)) {
    let program = &report.program;
    if let Some(travel) = program.travel_m {
        line("travel", format!("{} m", fixed(travel, 3)));
    }
    if let (Some(runs), Some(plunge_cuts)) = (program.runs, program.plunge_cuts) {
        line("runs", format!("{runs}, of which {}", counted(plunge_cuts, "plunge cut")));
    }
    if let (Some(Follow::Chord), Some(tangents)) = (program.follow, program.tangent_runs) {
        let but = if tangents > 0 {
            format!("\n             {} along the tangent, tighter than the blade", counted(tangents, "run"))
        } else {
            String::new()
        };
        line("blade", format!("a chord of curves, heel and tip on the line{but}"));
    }
    if let Some(sides) = program.sides {
        line("overlaps", overlaps(&sides));
    }
    if !report.declared.is_empty() {
        line("declared", declared(&report.declared));
    }
    if let Some(lifts) = program.lifts {
        line("lifts", lifts.to_string());
    }
    if let Some(time) = program.time_s {
        line("time", duration(time));
    }
    if let Some(spent) = &program.spent {
        line("spent", shares(&spent.parts(), spent.total()));
        let bounds: Vec<(String, f64)> = spent.bounds.iter().map(|&(bound, time)| (bound.to_string(), time)).collect();
        let limited = shares(&bounds, spent.cut);
        if !limited.is_empty() {
            line("limited by", limited);
        }
    }
    if let (Some(spent), Some(savings)) = (&program.spent, &program.savings) {
        could_save(spent, savings, line);
    }
    if let Some(controller) = &report.controller {
        planned_there(controller, line);
    }
    if let Some(bulge) = program.bulge_mm.filter(|&bulge| fixed(bulge, 3) != "0.000") {
        line("bulge", format!("{} mm beyond the chords of flattened curves", fixed(bulge, 3)));
    }
}

/// Time on a controller that plans for itself, what limits it, and keys whose change would save a relevant part of it.
fn planned_there(controller: &Controller, line: &mut impl FnMut(&str, String)) {
    let Controller { time_s, moves, planner, chosen, others, limits } = controller;
    let title = planner.title();
    line("controller", format!("about {} by {title}'s planner, {moves} arcs and lines", duration(*time_s)));
    let parts: Vec<(String, f64)> = limits.iter().map(|part| (part.limit.to_string(), part.time_s)).collect();
    let limited = shares(&parts, *time_s);
    if !limited.is_empty() {
        line("", limited);
    }
    if let Some(chosen) = chosen {
        let timed: Vec<(&str, f64)> =
            others.iter().filter_map(|other| Some((other.moves.as_str(), other.time_s?))).collect();
        line(
            "",
            if timed.is_empty() { chosen.clone() } else { format!("{chosen}, the fastest of {}", timed.len() + 1) },
        );
        if let Some(&(next, time)) = timed.first() {
            line("", format!("{next}: {}", later(time, *time_s)));
        }
    }
    for part in limits.iter().filter(|part| part.time_s >= TELLING_SHARE * time_s) {
        let Some(what) = advice(part.limit, *planner) else { continue };
        let share = 100.0 * part.time_s / time_s;
        line("", format!("{what} would save about {} s, {} %", fixed(part.time_s, 1), fixed(share, 0)));
    }
}

/// Duration of the next best moves in comparison with that of the chosen ones, s.
fn later(other: f64, chosen: f64) -> String {
    if other < chosen * (1.0 + TIE_SHARE) {
        "as fast".to_owned()
    } else {
        format!("{} s more", fixed(other - chosen, 1))
    }
}

/// Change of the profile that reduces the time of a limit; `None` if no single key does.
fn advice(limit: Limit, planner: Planner) -> Option<&'static str> {
    match (limit, planner) {
        (Limit::LookAhead, Planner::Grbl | Planner::Reprap) => Some("more of gcode.planner_blocks"),
        (Limit::Late, Planner::Grbl | Planner::Reprap | Planner::Linuxcnc) => Some("more of gcode.max_blocks_s"),
        (Limit::LookAhead, Planner::Linuxcnc)
        | (Limit::Feed | Limit::Blocks | Limit::Cycles | Limit::Speed(_) | Limit::Acceleration(_) | Limit::Rest, _) => {
            None
        }
    }
}

/// Compares the order of the cuts with the best one, and names other changes that would save a relevant part of the time.
fn could_save(spent: &Spent, savings: &Savings, line: &mut impl FnMut(&str, String)) {
    let &Savings { least_travel_s, steady_s, clear_s } = savings;
    let is_worth_telling = |saved: &f64| *saved >= TELLING_SHARE * spent.total();
    if spent.travel > 0.0 {
        let [travel, least] = [spent.travel, least_travel_s].map(|time| fixed(time, 1));
        line("order", format!("{travel} s from cut to cut; about {least} s at the least"));
    }
    let steady = steady_s.filter(is_worth_telling).map(|saved| (r#"order.policy = "steady""#, " or more", saved));
    let clear = clear_s.filter(is_worth_telling).map(|saved| ("knife.clear_ms, a third of lift_ms,", "", saved));
    for (what, more, saved) in steady.into_iter().chain(clear) {
        let share = 100.0 * saved / spent.total();
        line("", format!("{what} would save about {} s{more}, {} %", fixed(saved, 0), fixed(share, 0)));
    }
}

/// Actions of the program that are not in the drawing, one line per kind.
fn declared(declared: &[Total]) -> String {
    declared.iter().map(ToString::to_string).collect::<Vec<String>>().join("\n             ")
}

/// Measures that keep overlaps from harming a part.
fn overlaps(sides: &Sides) -> String {
    let Sides { inside, shortened, turned, backwards, rejoined, .. } = *sides;
    let mut out = format!("{} inside parts, {shortened} shortened", counted(inside, "end"));
    let _ = write!(out, "; {} turned round", counted(turned, "cut"));
    if backwards > 0 {
        let _ = write!(out, "\n             {} made by the back edge", counted(backwards, "cut"));
    }
    if rejoined > 0 {
        let _ =
            write!(out, "\n             {} resumed where the knife was lifted on its way", counted(rejoined, "cut"));
    }
    for (count, deepest, into) in [
        (sides.harmful, sides.overcut_mm, "a part"),
        (sides.trespassing, sides.neighbour_overcut_mm, "another part than its own"),
    ] {
        if count > 0 {
            let (plunge_cuts, at_most) = (counted(count, "plunge cut"), fixed(deepest, 2));
            let _ = write!(out, "\n             {plunge_cuts} into {into}, at most {at_most} mm deep");
        }
    }
    out
}

/// Description of the choice of lines, pieces and mode; empty for the whole marker with the knife down.
pub(super) fn choice(job: &Job) -> String {
    let mut out = String::new();
    if !job.selection.is_all() {
        let selection = Job { selection: job.selection.clone(), ..Job::default() }.typed();
        let _ = writeln!(out, "\n  selected   {selection}: the figures are those of these pieces");
    }
    if job.lines != Lines::default() {
        let lines = Job { lines: job.lines.clone(), ..Job::default() }.typed();
        let _ = writeln!(out, "{}  lines      {lines}: so they were chosen", if out.is_empty() { "\n" } else { "" });
    }
    if job.patterns != Patterns::default() {
        let patterns = Job { patterns: job.patterns.clone(), ..Job::default() }.typed();
        let _ = writeln!(out, "{}  patterns   {patterns}: so they were chosen", if out.is_empty() { "\n" } else { "" });
    }
    let is_head = job.profile.tool.kind == ToolKind::Spray;
    let mode = match job.mode {
        Mode::Cut => return out,
        Mode::Dry if is_head => "off all the time: --dry-run was given, nothing is sprayed",
        Mode::Frame if is_head => "off all the time: --frame was given, the head goes once around the box of its way",
        Mode::Dry => "up all the time: --dry-run was given, nothing is cut or drilled",
        Mode::Frame => "up all the time: --frame was given, the C axis goes once around the box",
    };
    let gap = if out.is_empty() { "\n" } else { "" };
    let tool = if is_head { "jet" } else { "knife" };
    let _ = writeln!(out, "{gap}  {tool:10} {mode}");
    out
}

/// Summary of the verdict on a program.
pub(super) fn verdict(verdict: Option<&Verdict>) -> String {
    let Some(verdict) = verdict else {
        return "\n  verified   no: --no-verify was given, nobody has read the program back\n".to_owned();
    };
    let (limited, reported) = verdict.counts();
    let mut out = format!("\n  verified   {} hold", counted(limited, "rule"));
    let on_path = verdict.under(&rules::ON_PATH);
    if let Some((worst, limit)) = on_path.and_then(|finding| Some((finding.worst, finding.limit?))) {
        let _ = write!(out, "; tip at most {} mm off the path ({} allowed)", fixed(worst, 3), fixed(limit, 3));
        // On a curve the body of a blade cuts beside the line.
        if let Some(body) = verdict.under(&rules::BODY).filter(|body| body.worst > limit) {
            let block = body.place.map_or_else(String::new, |place| format!(", block {}", place.block));
            let _ =
                write!(out, "\n             body of the blade at most {} mm beside it{block}", fixed(body.worst, 3));
        }
    }
    if reported > 0 {
        let _ = write!(out, "\n             {} without a limit only reported", counted(reported, "rule"));
    }
    if !verdict.untimed.is_empty() {
        let _ = write!(
            out,
            "\n             {} on times not judged: the program tells none",
            counted(verdict.untimed.len(), "rule")
        );
    }
    out + "\n"
}

/// Shares of a whole in percent, from the largest, wrapped to the line. Shares that round to 0 are left out.
fn shares<T: AsRef<str>>(parts: &[(T, f64)], whole: f64) -> String {
    let percent = |time: f64| (100.0 * time / whole).round();
    let mut parts: Vec<(&str, f64)> = parts.iter().map(|(name, time)| (name.as_ref(), percent(*time))).collect();
    parts.retain(|(_, percent)| *percent >= 1.0);
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut out = String::new();
    let mut column = 0;
    for (i, (name, percent)) in parts.iter().enumerate() {
        let part = format!("{name} {} %", fixed(*percent, 0));
        if i > 0 {
            out.push(',');
            if column + part.len() + 3 > SHARES_WIDTH {
                out.push_str("\n            ");
                column = 0;
            }
            out.push(' ');
        }
        out.push_str(&part);
        column += part.len() + 2;
    }
    out
}

/// A duration in seconds, or in minutes and seconds.
fn duration(seconds: f64) -> String {
    if seconds < S_PER_MIN {
        return format!("{} s", fixed(seconds, 2));
    }
    // Round first: 119.96 s are 2 min, not 1 min 60.0 s.
    let rounded = (seconds * 10.0).round() / 10.0;
    let minutes = (rounded / S_PER_MIN).floor();
    format!("{} min {} s", fixed(minutes, 0), fixed(rounded - minutes * S_PER_MIN, 1))
}

/// Appends the table of the greatest values of each axis beside its limits.
fn peaks(out: &mut String, axes: &Axes) {
    let cells = |peaks: &Peaks| [peaks.speed, peaks.acceleration, peaks.jerk].map(cell);
    let rows = [("x mm", cells(&axes.x)), ("y mm", cells(&axes.y)), ("c degrees", cells(&axes.c))];
    let titles = ["speed, /s", "acceleration, /s2", "jerk, /s3"];
    let worst = |column: usize| rows.iter().map(|(_, cells)| cells[column].0.len()).max().unwrap_or(0);
    let limit = |column: usize| rows.iter().map(|(_, cells)| cells[column].1.len()).max().unwrap_or(0);
    let width = |column: usize| titles[column].len().max(worst(column) + 4 + limit(column));
    out.push_str(AXES);
    let title = |i: usize| format!("   {:>1$}", titles[i], width(i));
    let _ = writeln!(out, "  {:9}{}", "axis", [0, 1, 2].map(title).concat());
    for (axis, cells) in &rows {
        let cell = |i: usize| {
            let both = format!("{:>2$} of {:>3$}", cells[i].0, cells[i].1, worst(i), limit(i));
            format!("   {both:>0$}", width(i))
        };
        let _ = writeln!(out, "  {axis:9}{}", [0, 1, 2].map(cell).concat());
    }
}

fn cell(peak: Peak) -> (String, String) {
    let decimals = if peak.limit < WHOLE_FROM { 2 } else { 0 };
    (fixed(peak.worst, decimals), fixed(peak.limit, decimals))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::motion::Bound;
    use crate::ir::{Finding, Marker};
    use crate::pipeline::{Notches, Program, Sides, Spent};

    fn report() -> Report {
        let peak = |worst, limit| Peak { worst, limit };
        let x = Peaks { speed: peak(761.4, 1200.0), acceleration: peak(7999.9, 8000.0), jerk: peak(199_876.0, 2e5) };
        let c = Peaks { speed: peak(7.4, 1080.0), acceleration: peak(19_999.9, 2e4), jerk: peak(1e6, 1e6) };
        Report {
            unit_mm: 0.254,
            extent_mm: [1234.56, 789.0],
            pieces: 12,
            contours: 14,
            closed_contours: 13,
            notches: Notches { slit: 31, ..Notches::default() },
            drills: 2,
            labels: 12,
            cut_m: 20.123_456,
            program: Program {
                savings: Some(Savings { least_travel_s: 9.8, steady_s: Some(7.2), clear_s: Some(0.4) }),
                travel_m: Some(8.2),
                runs: Some(101),
                notch_style: Some(NotchStyle::Slit),
                follow: Some(Follow::Chord),
                tangent_runs: Some(2),
                plunge_cuts: Some(1),
                sides: Some(Sides {
                    inside: 8,
                    shortened: 3,
                    turned: 1,
                    harmful: 1,
                    overcut_mm: 1.55,
                    ..Sides::default()
                }),
                lifts: Some(101),
                time_s: Some(119.96),
                bulge_mm: Some(0.138_2),
                axes: Some(Axes { x, y: x, c }),
                spent: Some(Spent {
                    cut: 60.0,
                    travel: 20.0,
                    turn: 15.0,
                    plunge: 14.4,
                    lift: 10.2,
                    drill: 0.36,
                    wait: 0.0,
                    bounds: vec![
                        (Bound::Ends, 30.0),
                        (Bound::Feed, 12.0),
                        (Bound::Axis { axis: 0, order: 1 }, 3.0),
                        (Bound::Axis { axis: 2, order: 2 }, 14.9),
                        (Bound::Axis { axis: 1, order: 0 }, 0.1),
                    ],
                }),
                by_piece: Vec::new(),
            },
            ..Report::of(&Marker::default(), "iso")
        }
    }

    #[test]
    fn equally_fast_moves_are_not_said_to_take_longer() {
        let said = [[99.99, 100.0], [100.01, 100.0], [101.0, 100.0]].map(|[other, chosen]| later(other, chosen));
        assert_eq!(said, ["as fast", "as fast", "1.0 s more"]);
        assert_eq!(advice(Limit::LookAhead, Planner::Reprap), Some("more of gcode.planner_blocks"));
        assert_eq!(advice(Limit::LookAhead, Planner::Linuxcnc), None);
    }

    #[test]
    fn a_summary_is_aligned_and_fits_80_columns() {
        let text = text(&report(), "marker.cut", &Diagnostics::default());
        assert!(text.lines().all(|line| line.len() <= 80), "{text}");
        insta::assert_snapshot!(text, @r#"
        marker.cut
          dialect    iso, unit 0.254 mm
          extent     1234.6 x 789.0 mm
          pieces     12
          contours   14 (13 closed, 1 open)
          notches    31 (31 slit, 0 v), all cut as slits
          drills     2
          labels     12
          cut        20.123 m
          travel     8.200 m
          runs       101, of which 1 plunge cut
          blade      a chord of curves, heel and tip on the line
                     2 runs along the tangent, tighter than the blade
          overlaps   8 ends inside parts, 3 shortened; 1 cut turned round
                     1 plunge cut into a part, at most 1.55 mm deep
          lifts      101
          time       2 min 0.0 s
          spent      cut 50 %, travel 17 %, turn 13 %, plunge 12 %, lift 9 %
          limited by starts and stops 50 %, jerk of c 25 %, feed 20 %,
                     acceleration of x 5 %
          order      20.0 s from cut to cut; about 9.8 s at the least
                     order.policy = "steady" would save about 7 s or more, 6 %
          bulge      0.138 mm beyond the chords of flattened curves
          warnings   0

          greatest value of limit
          axis          speed, /s   acceleration, /s2            jerk, /s3
          x mm        761 of 1200       8000 of  8000    199876 of  200000
          y mm        761 of 1200       8000 of  8000    199876 of  200000
          c degrees     7 of 1080      20000 of 20000   1000000 of 1000000
        "#);
    }

    #[test]
    fn what_only_planning_knows_is_left_out_without_it() {
        let unplanned = Report { program: Program::default(), unit_mm: 0.0, ..report() };
        insta::assert_snapshot!(text(&unplanned, "marker.cut", &Diagnostics::default()), @r"
        marker.cut
          dialect    iso, no grid
          extent     1234.6 x 789.0 mm
          pieces     12
          contours   14 (13 closed, 1 open)
          notches    31 (31 slit, 0 v)
          drills     2
          labels     12
          cut        20.123 m
          warnings   0
        ");
    }

    #[test]
    fn a_verdict_is_a_line() {
        let finding = |rule, worst, limit| Finding { rule, worst, limit, unit: "mm", place: None };
        let findings = vec![
            finding(&rules::ON_PATH, 0.061_23, Some(0.071)),
            finding(&rules::STRAY, 0.0, Some(0.0)),
            finding(&rules::BODY, 0.3, None),
        ];
        let line = verdict(Some(&Verdict { findings, untimed: vec![&rules::FEED], ..Verdict::default() }));
        assert_eq!(
            line,
            "\n  verified   2 rules hold; tip at most 0.061 mm off the path (0.071 allowed)\n             body of the blade at most 0.300 mm beside it\n             1 rule without a limit only reported\n             1 rule on times not judged: the program tells none\n"
        );
        assert!(verdict(None).contains("no: --no-verify"));
    }
}
