//! Heads over a conveyor: a plan, and a program for each head.

use std::io::{self, BufRead};
use std::path::Path;
use std::sync::Arc;

use serde_json::Value;

use super::machine::{Checked, Machine, Part, Written, dialect, listed};
use crate::diagnostic::Diagnostics;
use crate::flow::verify::{self, Bytes, Ground};
use crate::flow::{self, Program, Speed, TARGETS, Target};
use crate::front::Dialect;
use crate::ir::{Finding, Marker};
use crate::machine::{Centre, Job, Mode, ToolKind};
use crate::pipeline::{self, Explained, Input, Judged, Reading};
use crate::sew::Asked;
use crate::source::Source;

/// Name of a plan, in a folder with the programs of its heads.
pub const PLAN: &str = "plan.json";

pub(super) const MACHINE: Machine = Machine {
    name: "flow",
    about: "heads in rows over a conveyor, which cut cloth while it moves",
    works: "cuts",
    tool: None,
    targets: || listed(TARGETS),
    rules: verify::RULES,
    is_sewn: false,
    claims: |claim| claim.name == PLAN,
    refusal,
    parts: Some(heads),
    check: |source, asked, job, out| {
        let job = on_cloth(job.clone(), dialect(asked), source);
        let Cut { input, .. } = cut(source, dialect(asked), &job, out)?;
        flow::plan(&input.marker, Speed::Profile, &job, out);
        Some(Checked::of(&input))
    },
    judge: Some(judge),
};

/// Fault of jobs that heads over a conveyor cannot do, with a hint: dry runs, frames and spray tools.
pub fn refusal(job: &Job) -> Option<[&'static str; 2]> {
    if job.mode != Mode::Cut {
        return Some(["heads over a conveyor have no dry run and no frame", "leave `--dry-run` and `--frame` out"]);
    }
    if job.marks.is_some() {
        return Some([
            "`--map` lays a drawing on a table, and cloth on a conveyor moves",
            "leave `--map` out; `--centre` follows cloth that wanders",
        ]);
    }
    if job.profile.bite.length_mm.is_some() {
        return Some([
            "`bite.length_mm` cuts cloth that lies still, and heads over a conveyor cut cloth that moves",
            "leave `bite.length_mm` out",
        ]);
    }
    if job.profile.tool.kind == ToolKind::Spray {
        return Some([
            "`tool.kind` is \"spray\", and heads over a conveyor follow lines with a tool that touches the cloth",
            "take a profile of another tool, or `cutc compile` for the spray head",
        ]);
    }
    None
}

/// The job with its centre line by places of the cloth: the front of the marker comes under the rulers first.
pub fn on_cloth(job: Job, from: Option<&'static Dialect>, source: &Source) -> Job {
    let Some(centre) = &job.centre else { return job };
    // Findings are dropped here: the later reading reports them. No place moves along the feed until then.
    let plain = Job { centre: None, ..job.clone() };
    let input = pipeline::read(source, from, &plain, &mut Diagnostics::default());
    let extent = input.map(|input| input.marker.extent()).filter(|extent| !extent.is_empty());
    let Some(extent) = extent else { return job };
    let rulers = extent.max.x + job.profile.flow.rulers_mm;
    let line = centre.line.on_cloth(rulers);
    let centre = Centre { line, source: Arc::clone(&centre.source), rulers: Some(rulers) };
    Job { centre: Some(Arc::new(centre)), ..job }
}

/// A source with its cuts.
struct Cut {
    input: Input,
    reading: Reading,
}

fn cut(source: &Source, from: Option<&'static Dialect>, job: &Job, out: &mut Diagnostics) -> Option<Cut> {
    let Judged { mut input, reading } = pipeline::read_to_judge(source, from, job, out)?;
    pipeline::make_cuts(&mut input, source, job, out);
    (!out.has_errors()).then_some(Cut { input, reading })
}

/// Cuts, the heads that make them, and findings on the marker against the bytes that it was read from.
#[derive(Debug)]
pub struct Planned {
    /// The marker with its cuts.
    pub marker: Marker,
    /// The heads.
    pub program: Program,
    /// Findings on the marker.
    pub audit: Vec<Finding>,
}

/// Plans the heads that cut a source at a speed of the conveyor; `None` when it is impossible: the diagnostics tell why.
pub fn plan(
    source: &Source,
    from: Option<&'static Dialect>,
    speed: Speed,
    job: &Job,
    out: &mut Diagnostics,
) -> Option<Planned> {
    let Cut { input, reading } = cut(source, from, job, out)?;
    let program = flow::plan(&input.marker, speed, job, out)?;
    let audit = pipeline::audited(source, input.dialect, reading, job);
    Some(Planned { marker: input.marker, program, audit })
}

/// Judges the programs of all targets that a plan names by the marker that they must cut.
fn judge(
    plan: &mut Written,
    source: &Source,
    asked: &Asked,
    job: &Job,
    out: &mut Diagnostics,
) -> io::Result<Option<Explained>> {
    let job = on_cloth(job.clone(), dialect(asked), source);
    let Some(Cut { input, reading }) = cut(source, dialect(asked), &job, out) else { return Ok(None) };
    let mut bytes = Vec::new();
    plan.bytes.rewind()?;
    plan.bytes.read_to_end(&mut bytes)?;
    let text = String::from_utf8_lossy(&bytes);
    let ground = Ground { marker: &input.marker, profile: &job.profile };
    let mut verdict = None;
    for Programs { bytes, names } in programs(&told(text.as_bytes())) {
        let open = |head: usize| -> io::Result<Box<dyn BufRead>> { (plan.open)(&names[head]) };
        let judged = verify::judge(&text, (bytes, &open), &ground)?;
        verdict = Some(match verdict {
            None => judged,
            Some(known) => pipeline::both(known, judged),
        });
    }
    let mut verdict = verdict.expect("a plan has programs of one target at the least");
    verdict.findings.extend(pipeline::audited(source, input.dialect, reading, &job));
    let told = pipeline::told(&verdict, &input.marker, source, &job);
    Ok(Some(Explained { verdict, told }))
}

/// A plan as JSON; null if it is none.
fn told(plan: &[u8]) -> Value {
    serde_json::from_slice(plan).unwrap_or_default()
}

/// Programs of one target that a plan names, head by head.
struct Programs {
    bytes: Bytes,
    names: Vec<String>,
}

/// The programs of each target that a plan names. A head without a program has the name that its target gives it; a plan
/// without any program has those of the first target.
fn programs(plan: &Value) -> Vec<Programs> {
    let heads = plan["heads"].as_array().map_or(&[][..], Vec::as_slice);
    let of_target = |target: &Target| {
        let bytes = target.proof?;
        let named: Vec<Option<String>> = heads.iter().map(|head| named(head, target.extension)).collect();
        let is_any = named.iter().any(Option::is_some);
        let names =
            named.into_iter().enumerate().map(|(head, name)| name.unwrap_or_else(|| target.file(head))).collect();
        Some((is_any, Programs { bytes, names }))
    };
    let (named, unnamed): (Vec<_>, Vec<_>) = TARGETS.iter().filter_map(of_target).partition(|(is_named, _)| *is_named);
    let kept = if named.is_empty() { unnamed.into_iter().take(1).collect() } else { named };
    kept.into_iter().map(|(_, programs)| programs).collect()
}

/// The file of a head with an extension.
fn named(head: &Value, extension: &str) -> Option<String> {
    let has_extension = |part: &Part| Path::new(&part.name).extension().is_some_and(|end| end == extension);
    files(&head["files"]).find(has_extension).map(|part| part.name)
}

/// The programs of heads that a plan names.
fn heads(plan: &[u8]) -> Vec<Part> {
    let plan = told(plan);
    plan["heads"].as_array().into_iter().flatten().flat_map(|head| files(&head["files"])).collect()
}

/// All files that a plan names: programs of heads, then pictures.
pub fn files_of(plan: &[u8]) -> Vec<Part> {
    heads(plan).into_iter().chain(files(&told(plan)["pictures"])).collect()
}

/// Files of a list in a plan, in the folder of the plan; names that lead out of it are skipped.
fn files(list: &Value) -> impl Iterator<Item = Part> {
    let file = |file: &Value| {
        let name = file["file"].as_str().filter(|name| Path::new(name).file_name().is_some_and(|own| own == *name))?;
        Some(Part { name: name.to_owned(), blake3: file["blake3"].as_str().map(str::to_owned) })
    };
    list.as_array().into_iter().flatten().filter_map(file)
}
