//! Products of a log, one for each target.

use crate::cli::made::{Judge, Product};
use crate::cli::provenance::Verified;
use crate::diagnostic::{Diagnostic, code};
use crate::machine::Job;
use crate::track::{Target, Tracked};

/// The product of a target. Commands are read back and compared with the readings.
pub(super) fn product<'a>(target: &'static Target, tracked: &'a Tracked, job: &'a Job) -> Product<'a> {
    let judge = target.proof.map(|read| -> Box<Judge<'a>> {
        Box::new(move |input, out| {
            if let Some(wrong) = read(input, &tracked.replay.rows, &job.profile.track)? {
                let message = format!("the commands, read back, break the law: {wrong}");
                out.push(Diagnostic::new(&code::TRACK_BROKEN, message));
            }
            Ok(())
        })
    });
    Product {
        target: target.name,
        verified: if judge.is_some() { Verified::Yes } else { Verified::No },
        write: Box::new(|out| (target.emit.write)(tracked, out)),
        judge,
    }
}
