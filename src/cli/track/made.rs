//! Products of a log, one for each target.

use crate::cli::made::{Judge, Product};
use crate::cli::provenance::Verified;
use crate::diagnostic::{Diagnostic, code};
use crate::machine::Job;
use crate::track::{Target, Tracked, verify};

/// The product of a target. Commands, read back, are held against the readings.
pub(super) fn product<'a>(target: &'static Target, tracked: &'a Tracked, job: &'a Job) -> Product<'a> {
    let judge: Box<Judge<'a>> = Box::new(|input, out| {
        if let Some(wrong) = verify::commands(input, &tracked.replay.rows, &job.profile.track)? {
            let message = format!("the commands, read back, break the law: {wrong}");
            out.push(Diagnostic::new(&code::TRACK_BROKEN, message));
        }
        Ok(())
    });
    Product {
        target: target.name,
        verified: if target.is_judged { Verified::Yes } else { Verified::No },
        write: Box::new(|out| (target.write)(tracked, out)),
        judge: Some(judge).filter(|_| target.is_judged),
    }
}
