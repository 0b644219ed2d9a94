//! Pattern DXF: the same piece however it is drawn, what sizes and quantities decide, a second reading that agrees, and
//! patience with damage.

mod audit;
mod curves;
mod damage;
mod habits;
mod marked;
mod programs;
mod retrace;
mod sets;
mod spurs;
mod stretches;
mod writer;

use std::fs;
use std::path::{Path, PathBuf};

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::pipeline;
use cutc::source::Source;

fn source(bytes: impl Into<Vec<u8>>) -> Source {
    Source::new("a.dxf", bytes.into()).expect("small")
}

/// The marker as it was read, before any pass, and the codes of what was found.
fn as_read(source: &Source, job: &Job) -> (Marker, Vec<&'static str>) {
    let mut found = Diagnostics::default();
    let marker = pipeline::marker_of(by_name("pattern").expect("a dialect"), source, job, &mut found);
    (marker, found.iter().map(|diagnostic| diagnostic.code.name).collect())
}

/// Every valid fixture, in order.
fn fixtures() -> Vec<(PathBuf, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let folder = fs::read_dir(root.join("pattern")).expect("a folder").map(|entry| entry.expect("readable").path());
    let mut paths: Vec<PathBuf> = folder.chain([root.join("pictures/pattern.dxf")]).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(&path).expect("readable"))).collect()
}
