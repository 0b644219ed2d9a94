//! Written plan and programs: complete and judged, with their provenance beside the plan, or none at all.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::earlier;
use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::made::{BLOCK_BYTES, say_broken};
use crate::cli::provenance::{self, Verified};
use crate::cli::report::pretty;
use crate::diagnostic::{Diagnostics, code};
use crate::flow::verify::{self, Bytes, Ground};
use crate::flow::{self, Emit, Head, Program, Target};
use crate::ir::verdict::{Sighting, Verdict};
use crate::ir::{Finding, Marker};
use crate::machine::{Job, blake3_of};
use crate::machines::flow::PLAN;
use crate::source::Source;

/// Input of a write.
pub(super) struct Made<'a> {
    pub(super) targets: &'a [&'static Target],
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    pub(super) marker: &'a Marker,
    pub(super) verify: bool,
    /// Findings about the marker against the bytes of its source.
    pub(super) audit: &'a [Finding],
}

/// Result of a write.
pub(super) struct Written {
    /// Verdicts on the programs of each target.
    pub(super) verdicts: Vec<(&'static str, Verdict)>,
    /// Number of programs of heads.
    pub(super) programs: usize,
    /// Number of files beside the plan.
    pub(super) files: usize,
    /// Messages about earlier programs.
    pub(super) said: String,
}

impl Made<'_> {
    /// Writes plan and programs into a folder. If one is refused, none takes its place.
    pub(super) fn write(&self, program: &Program, folder: &Path, out: &mut Diagnostics) -> anyhow::Result<Written> {
        let mut plan = flow::describe(program, self.marker, &self.job.profile);
        let (mut drafts, mut judged) = (Vec::new(), Vec::new());
        for target in self.targets {
            match target.emit {
                Emit::Heads(write) => {
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
                    judged.push((*target, programs));
                }
                Emit::Whole { write, .. } => {
                    let put = |out: &mut dyn io::Write| write(program, self.marker, out);
                    let (draft, file) = written(folder, &target.file(0), put)?;
                    plan.pictures.push(file);
                    drafts.push(draft);
                }
            }
        }
        let programs = judged.iter().map(|(_, programs)| programs.len()).sum();
        let text = pretty(&plan);
        let mut verdicts = Vec::new();
        for (target, mut programs) in judged {
            if let Some(bytes) = target.proof.filter(|_| self.verify) {
                let verdict = self.judged(&text, bytes, &mut programs)?;
                let place = |place: Sighting| {
                    let row = place.line.filter(|_| place.head > 0);
                    row.map(|row| format!("head {}, row {row}", place.head))
                };
                say_broken(&verdict, target.name, &code::FLOW_BROKEN, place, out);
                verdicts.push((target.name, verdict));
            }
            drafts.append(&mut programs);
        }
        let files = drafts.len();
        let path = folder.join(PLAN);
        let mut draft = Draft::new(&path)?;
        draft.file().write_all(text.as_bytes()).map_err(|error| files::cannot_write(&path, &error))?;
        let verified = if self.verify { Verified::Yes } else { Verified::No };
        let target = &self.targets.iter().map(|target| target.name).collect::<Vec<_>>().join(",");
        let Self { source, job, .. } = *self;
        let of_plan = provenance::Made { source, job, target, verified, cut: None, options: &job.typed() };
        drafts.push(provenance::draft(&files::meta(&path), draft.file(), &of_plan)?);
        drafts.push(draft);
        let mut said = String::new();
        if !out.has_errors() {
            let kept: Vec<PathBuf> = drafts.iter().map(|draft| draft.path().to_owned()).collect();
            said = earlier::move_aside(folder, &kept);
            draft::publish(drafts, || Ok(()))?;
        }
        Ok(Written { verdicts, programs, files, said })
    }

    /// Verdict on the programs of a target, from their bytes.
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
}

/// Error about programs whose bytes cannot be read.
fn cannot_read_back(error: &io::Error) -> anyhow::Error {
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
