//! Where a program comes from: the `.meta.json` beside it.

use std::path::Path;

use serde::Serialize;

use super::report::pretty;
use crate::back::Target;
use crate::machine::{Job, sha256_hex};
use crate::source::Source;

/// Everything that made a program, for whoever finds it later. No date and no path: the same input gives the same bytes.
#[derive(Serialize)]
struct Provenance<'a> {
    /// Version of this program.
    version: &'static str,
    /// Name of the input, without its directory.
    source: String,
    source_sha256: String,
    /// Of the values in effect, `--set` included.
    profile_sha256: String,
    target: &'a str,
    period_ms: f64,
    units: Units,
    verified: Verified,
}

/// Units of the setpoints.
#[derive(Serialize)]
struct Units {
    time: &'static str,
    length: &'static str,
    angle: &'static str,
}

/// Whether the program was read back and proven to cut what the input says.
#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Verified {
    /// Not by this compile.
    No,
    /// By this compile.
    Yes,
}

/// The provenance of a program as JSON.
pub(super) fn json(source: &Source, job: &Job, target: &Target, verified: bool) -> String {
    let name = Path::new(source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
    pretty(&Provenance {
        version: env!("CARGO_PKG_VERSION"),
        source: name.unwrap_or_else(|| source.name().to_owned()),
        source_sha256: sha256_hex(source.bytes()),
        profile_sha256: job.profile.digest(),
        target: target.name,
        period_ms: job.profile.time.period_ms,
        units: Units { time: "s", length: "mm", angle: "deg" },
        verified: if verified { Verified::Yes } else { Verified::No },
    })
}
