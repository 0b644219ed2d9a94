//! Programs of the machines beside the knife: written whole and judged, with their provenance beside them, or not at all.

use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, Write};

use tempfile::SpooledTempFile;

use super::destination::Place;
use super::draft::{self, Draft, Whole};
use super::files;
use super::finished::failure;
use super::provenance::{self, Made, Verified};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::ir::verdict::{Sighting, Verdict};
use crate::machine::Job;
use crate::source::Source;

/// Bytes of a program for standard output that stay in memory, at most; longer programs go to a temporary file.
const SPOOL_BYTES: usize = 16 << 20;
/// Bytes that are written and read at a time.
pub(super) const BLOCK_BYTES: usize = 1 << 17;

/// Writes a program.
pub(super) type Writer<'a> = dyn Fn(&mut dyn Write) -> io::Result<()> + 'a;
/// Judges a program by its bytes: what is wrong with it goes to the diagnostics.
pub(super) type Judge<'a> = dyn Fn(&mut dyn BufRead, &mut Diagnostics) -> io::Result<()> + 'a;

/// Program of a target, about to be written.
pub(super) struct Product<'a> {
    /// Name of the target.
    pub(super) target: &'static str,
    /// Writer of its bytes.
    pub(super) write: Box<Writer<'a>>,
    /// Verdict that its provenance records.
    pub(super) verified: Verified,
    /// `None` for a target without a judge.
    pub(super) judge: Option<Box<Judge<'a>>>,
}

impl Product<'_> {
    /// Writes it, and judges what was written.
    pub(super) fn make(&self, file: &mut (impl Read + Write + Seek), out: &mut Diagnostics) -> io::Result<()> {
        let mut writer = BufWriter::with_capacity(BLOCK_BYTES, &mut *file);
        (self.write)(&mut writer)?;
        writer.flush()?;
        drop(writer);
        file.rewind()?;
        if let Some(judge) = &self.judge {
            let mut input = BufReader::with_capacity(BLOCK_BYTES, &mut *file);
            judge(&mut input, out)
                .map_err(|error| io::Error::new(error.kind(), format!("the program cannot be read back: {error}")))?;
            file.rewind()?;
        }
        Ok(())
    }

    /// Writes it to a temporary file.
    pub(super) fn spool(&self, out: &mut Diagnostics) -> anyhow::Result<SpooledTempFile> {
        let mut spool = SpooledTempFile::new(SPOOL_BYTES);
        self.make(&mut spool, out).map_err(|error| {
            let hint = "make room for temporary files, or write to a file";
            failure(format!("cannot spool the program: {error}"), hint)
        })?;
        Ok(spool)
    }
}

/// Record of programs that take their places: it is made together with them or not at all.
pub(super) type Record<'r> = dyn Fn(&Diagnostics, Vec<Whole>) -> anyhow::Result<()> + 'r;

/// Source and machine of programs.
#[derive(Clone, Copy)]
pub(super) struct Origin<'a> {
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    /// Options as typed.
    pub(super) options: &'a str,
    /// `None` of programs that no manifest lists.
    pub(super) record: Option<&'a Record<'a>>,
}

impl Origin<'_> {
    /// Writes every program to its place; the one for standard output is handed back. Nothing takes its place when one is
    /// refused.
    pub(super) fn write(
        &self,
        products: &[Product],
        place: &Place,
        out: &mut Diagnostics,
    ) -> anyhow::Result<Option<SpooledTempFile>> {
        let paths = match place {
            Place::Stdout => return products.first().map(|product| product.spool(out)).transpose(),
            Place::Files(paths) => paths,
        };
        let (mut drafts, mut whole) = (Vec::new(), Vec::new());
        for (product, path) in products.iter().zip(paths) {
            let mut draft = Draft::new(path)?;
            product.make(draft.file(), out).map_err(|error| files::cannot_write(path, &error))?;
            let (Self { source, job, options, record }, Product { target, verified, .. }) = (*self, product);
            let made = Made { source, job, target, verified: *verified, cut: None, options };
            drafts.push(provenance::draft(&files::meta(path), draft.file(), &made)?);
            whole.extend(record.map(|_| Whole::of(&mut draft)).transpose()?);
            drafts.push(draft);
        }
        if !out.has_errors() {
            draft::publish(drafts, || self.record.map_or(Ok(()), |record| record(out, whole)))?;
        }
        Ok(None)
    }
}

/// Reports the rules that the program of a target breaks, or that it cannot be read back. `place` words the place of a finding.
pub(super) fn say_broken(
    verdict: &Verdict,
    target: &str,
    code: &'static Code,
    place: impl Fn(Sighting) -> Option<String>,
    out: &mut Diagnostics,
) {
    if let Some(unread) = &verdict.unread {
        out.push(Diagnostic::new(code, format!("the program (target {target}) cannot be read back: {unread}")));
        return;
    }
    for finding in verdict.broken() {
        let limit = finding.limit.unwrap_or(f64::INFINITY);
        let place = finding.place.and_then(&place).map_or(String::new(), |place| format!(", {place}"));
        let message = format!(
            "{} (target {target}): {:.4} {}, allowed {limit:.4}{place}",
            finding.rule.name, finding.worst, finding.unit
        );
        let broken = Diagnostic::new(code, message).hint(format!("`cutc explain {}`", finding.rule.name));
        out.push(match finding.place {
            Some(place) => broken.on_cloth(place.point),
            None => broken,
        });
    }
}
