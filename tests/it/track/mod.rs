//! The carriage that follows a moving cloth: what it does to cloth of any kind, what is read and refused, and how a marker
//! follows the line that was found.

mod files;
mod laws;
mod marker;

use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::Tracking;
use cutc::source::Source;
use cutc::track::scenario::Scenario;
use cutc::track::{Needs, TARGETS, Tracked};

/// The bytes of a fixture.
fn fixture(name: &str) -> Vec<u8> {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn source(name: &str, bytes: impl Into<Vec<u8>>) -> Source {
    Source::new(name.rsplit('/').next().expect("a name"), bytes.into()).expect("small")
}

/// What a log comes to, and what is said of it.
fn replayed(name: &str, bytes: impl Into<Vec<u8>>, track: &Tracking) -> (Option<Tracked>, String) {
    let (source, mut out) = (source(name, bytes), Diagnostics::default());
    let tracked = Tracked::of_log(&source, track, Needs::Centre, &mut out);
    (tracked, render(&out, &source))
}

/// The scenario of a fixture.
fn scenario(name: &str, track: &Tracking) -> Scenario {
    let (source, mut out) = (source(name, fixture(name)), Diagnostics::default());
    Scenario::read(&source, track, &mut out).unwrap_or_else(|| panic!("{name}: {}", render(&out, &source)))
}

/// The bytes of a target.
fn written(tracked: &Tracked, name: &str) -> Vec<u8> {
    let target = TARGETS.iter().find(|target| target.name == name).expect("a target");
    let mut bytes = Vec::new();
    (target.emit.write)(tracked, &mut bytes).expect("a vector takes bytes");
    bytes
}
