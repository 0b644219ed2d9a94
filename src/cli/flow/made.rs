//! Plan and programs that are written: whole and judged, with their provenance beside the plan, or none at all.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;

use super::earlier;
use crate::cli::draft::{self, Draft};
use crate::cli::files::{self, PLAN};
use crate::cli::finished::failure;
use crate::cli::options::typed;
use crate::cli::provenance::{CentreFile, path_of};
use crate::cli::report::pretty;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::flow::verify::{self, Bytes, Ground};
use crate::flow::{self, Head, Kind, Program, Target};
use crate::ir::verdict::Verdict;
use crate::ir::{Finding, Marker};
use crate::machine::{Job, blake3_of, sha256_hex};
use crate::source::Source;

/// Bytes that are written and read at a time.
pub(super) const BLOCK_BYTES: usize = 1 << 17;

/// What is to be written.
pub(super) struct Made<'a> {
    pub(super) targets: &'a [&'static Target],
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    pub(super) marker: &'a Marker,
    pub(super) verify: bool,
    /// What is known of the marker against the bytes that it was read from.
    pub(super) audit: &'a [Finding],
}

/// What was written.
pub(super) struct Written {
    /// What the programs of each target are worth.
    pub(super) verdicts: Vec<(&'static str, Verdict)>,
    /// Programs of heads.
    pub(super) programs: usize,
    /// Files beside the plan.
    pub(super) files: usize,
    /// What is said of earlier ones.
    pub(super) said: String,
}

/// Everything that made a plan. No date, and no path but from the plan to its input: folders that are moved together keep their
/// bytes.
#[derive(Serialize)]
struct Provenance<'a> {
    version: &'static str,
    source: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    source_path: Option<String>,
    source_sha256: String,
    profile: &'a str,
    profile_sha256: String,
    target: String,
    verified: &'static str,
    program_blake3: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<CentreFile>,
    #[serde(skip_serializing_if = "String::is_empty")]
    options: String,
}

impl Made<'_> {
    /// Writes plan and programs into a folder. Nothing takes its place when one is refused.
    pub(super) fn write(&self, program: &Program, folder: &Path, out: &mut Diagnostics) -> anyhow::Result<Written> {
        let mut plan = flow::describe(program, self.marker, &self.job.profile);
        let (mut drafts, mut judged) = (Vec::new(), Vec::new());
        for target in self.targets {
            match target.kind {
                Kind::Heads { write, bytes } => {
                    let of_head = |(i, head): (usize, &Head)| {
                        written(folder, &target.file(i), |out: &mut dyn io::Write| write(program, head, out))
                    };
                    let made: Vec<_> = program.heads.par_iter().enumerate().map(of_head).collect();
                    let mut programs = Vec::new();
                    for (head, made) in plan.heads.iter_mut().zip(made) {
                        let (draft, file) = made?;
                        head.files.push(file);
                        programs.push(draft);
                    }
                    judged.push((*target, bytes, programs));
                }
                Kind::Whole { write, .. } => {
                    let put = |out: &mut dyn io::Write| write(program, self.marker, out);
                    let (draft, file) = written(folder, &target.file(0), put)?;
                    plan.pictures.push(file);
                    drafts.push(draft);
                }
            }
        }
        let programs = judged.iter().map(|(_, _, programs)| programs.len()).sum();
        let text = pretty(&plan);
        let mut verdicts = Vec::new();
        for (target, bytes, mut programs) in judged {
            if self.verify {
                let verdict = self.judged(&text, bytes, &mut programs)?;
                tell(&verdict, target, out);
                verdicts.push((target.name, verdict));
            }
            drafts.append(&mut programs);
        }
        let files = drafts.len();
        let path = folder.join(PLAN);
        let mut draft = Draft::new(&path)?;
        draft.file().write_all(text.as_bytes()).map_err(|error| files::cannot_write(&path, &error))?;
        drafts.push(self.meta(&path, &mut draft)?);
        drafts.push(draft);
        let mut said = String::new();
        if !out.has_errors() {
            let kept: Vec<PathBuf> = drafts.iter().map(|draft| draft.path().to_owned()).collect();
            said = earlier::move_aside(folder, &kept);
            draft::publish(drafts, || Ok(()))?;
        }
        Ok(Written { verdicts, programs, files, said })
    }

    /// What the programs of a target are worth, from their bytes.
    fn judged(&self, plan: &str, bytes: Bytes, programs: &mut [Draft]) -> anyhow::Result<Verdict> {
        let ground = Ground { marker: self.marker, profile: &self.job.profile };
        let files: Vec<&File> = programs.iter_mut().map(|program| &*program.file()).collect();
        let open = |i: usize| -> io::Result<Box<dyn BufRead>> {
            let mut file = files[i];
            file.rewind()?;
            Ok(Box::new(BufReader::with_capacity(BLOCK_BYTES, file.try_clone()?)))
        };
        let judged = verify::judge(plan, (bytes, &open), &ground);
        let mut verdict = judged.map_err(|error| cannot_read_back(&error))?;
        verdict.findings.extend_from_slice(self.audit);
        Ok(verdict)
    }

    /// The provenance of a plan, as a draft of a file.
    fn meta(&self, plan: &Path, draft: &mut Draft) -> anyhow::Result<Draft> {
        let path = files::meta(plan);
        let mut meta = Draft::new(&path)?;
        let name = Path::new(self.source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
        let file = draft.file();
        let written = file.rewind().and_then(|()| blake3_of(&mut *file)).and_then(|blake3| {
            let text = pretty(&Provenance {
                version: env!("CARGO_PKG_VERSION"),
                source: name.unwrap_or_else(|| self.source.name().to_owned()),
                source_path: path_of(self.source, &path),
                source_sha256: sha256_hex(self.source.bytes()),
                profile: self.job.origin.name(),
                profile_sha256: self.job.profile.digest(),
                target: self.targets.iter().map(|target| target.name).collect::<Vec<_>>().join(","),
                verified: if self.verify { "yes" } else { "no" },
                program_blake3: &blake3,
                centre: CentreFile::of(self.job),
                options: typed(self.job),
            });
            meta.file().write_all(text.as_bytes())
        });
        written.map_err(|error| files::cannot_write(&path, &error))?;
        Ok(meta)
    }
}

/// The failure of programs whose bytes cannot be had.
pub(super) fn cannot_read_back(error: &io::Error) -> anyhow::Error {
    let hint = "the disk may fail, or something took files away that the plan names";
    failure(format!("the programs cannot be read back: {}", files::reason(error)), hint)
}

/// Writes a file as a draft.
fn written(
    folder: &Path,
    name: &str,
    put: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> anyhow::Result<(Draft, flow::File)> {
    let path = folder.join(name);
    let mut draft = Draft::new(&path)?;
    let file: &mut File = draft.file();
    let blake3 = (|| {
        let mut writer = BufWriter::with_capacity(BLOCK_BYTES, &mut *file);
        put(&mut writer)?;
        writer.flush()?;
        drop(writer);
        file.rewind()?;
        blake3_of(&mut *file)
    })();
    let blake3 = blake3.map_err(|error| files::cannot_write(&path, &error))?;
    Ok((draft, flow::File { file: name.to_owned(), blake3 }))
}

/// Says which rules the programs of a target break.
fn tell(verdict: &Verdict, target: &Target, out: &mut Diagnostics) {
    if let Some(unread) = &verdict.unread {
        let message = format!("the programs (target {}) cannot be read back: {unread}", target.name);
        out.push(Diagnostic::new(&code::FLOW_BROKEN, message));
    }
    for finding in verdict.broken().filter(|_| verdict.unread.is_none()) {
        let limit = finding.limit.unwrap_or(f64::INFINITY);
        let place = finding.place.filter(|place| place.head > 0).and_then(|place| Some((place.head, place.line?)));
        let place = place.map_or(String::new(), |(head, row)| format!(", head {head}, row {row}"));
        let message = format!(
            "{} (target {}): {:.4} {}, allowed {limit:.4}{place}",
            finding.rule.name, target.name, finding.worst, finding.unit
        );
        let mut broken =
            Diagnostic::new(&code::FLOW_BROKEN, message).hint(format!("`cutc explain {}`", finding.rule.name));
        if let Some(place) = finding.place {
            broken = broken.on_cloth(place.point);
        }
        out.push(broken);
    }
}
