//! Products of a sewing program, one for each target.

use std::cell::RefCell;
use std::io;

use tempfile::SpooledTempFile;

use crate::cli::destination::Place;
use crate::cli::made::{Judge, Origin, Product, Record, say_broken};
use crate::cli::provenance::Verified;
use crate::diagnostic::{Diagnostics, code};
use crate::ir::verdict::{Sighting, Verdict};
use crate::sew::verify::Bytes;
use crate::sew::{Made, TARGETS, Target};

/// Input of a write.
#[derive(Clone, Copy)]
pub(super) struct Writing<'a> {
    pub(super) made: Made<'a>,
    pub(super) targets: &'a [&'static Target],
    /// Options of the file, as typed.
    pub(super) options: &'a str,
    pub(super) verify: bool,
    /// Record of the files that take their places.
    pub(super) record: Option<&'a Record<'a>>,
}

/// Result of a write.
pub(super) struct Written {
    /// Judged targets with their verdicts.
    pub(super) verdicts: Vec<(&'static Target, Verdict)>,
    /// The program for standard output.
    pub(super) stdout: Option<SpooledTempFile>,
}

impl<'a> Writing<'a> {
    /// Writes every program to its place. If one is refused, none takes its place.
    pub(super) fn write(&self, place: &Place, out: &mut Diagnostics) -> anyhow::Result<Written> {
        for target in self.targets {
            (target.emit.refusals)(self.made.program, self.made.job, out);
        }
        let verdicts = RefCell::default();
        if self.verify && self.targets.iter().all(|target| target.proof.is_none()) {
            // A picture shows the program of another target: that is judged.
            let pulses = TARGETS.iter().find(|target| target.proof == Some(Bytes::PulseRecords));
            self.product(pulses.expect("pulses are a target"), &verdicts).spool(out)?;
        }
        let products: Vec<Product> = self.targets.iter().map(|target| self.product(target, &verdicts)).collect();
        let Made { source, job, .. } = self.made;
        let stdout = Origin { source, job, options: self.options, record: self.record }.write(&products, place, out)?;
        drop(products);
        Ok(Written { verdicts: verdicts.into_inner(), stdout })
    }

    /// Product of a target; its verdict is added to `verdicts`.
    fn product<'p>(
        &self,
        target: &'static Target,
        verdicts: &'p RefCell<Vec<(&'static Target, Verdict)>>,
    ) -> Product<'p>
    where
        'a: 'p,
    {
        let made = self.made;
        let judge = move |bytes: Bytes, input: &mut dyn io::BufRead, out: &mut Diagnostics| {
            let verdict = made.judge(bytes, input)?;
            let entry = |place: Sighting| place.line.map(|entry| format!("entry {entry}"));
            say_broken(&verdict, target.name, &code::SEW_BROKEN, entry, out);
            verdicts.borrow_mut().push((target, verdict));
            Ok(())
        };
        let proof = target.proof.filter(|_| self.verify);
        Product {
            target: target.name,
            verified: if self.verify { Verified::Yes } else { Verified::No },
            write: Box::new(move |out| (target.emit.write)(made.program, made.job, out)),
            judge: proof.map(|bytes| -> Box<Judge<'p>> { Box::new(move |input, out| judge(bytes, input, out)) }),
        }
    }
}
