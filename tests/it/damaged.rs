//! Damage to fixtures of every dialect, cut short and with a byte changed: nothing of it panics.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use cutc::diagnostic::render;
use cutc::front::{DIALECTS, Dialect};

use crate::ONE_IN;
use crate::support::fixtures::{describe, files, read, source};

/// Largest fixture that is damaged in every way, bytes.
const SMALL: usize = 2048;
/// Single bytes that are damaged in each small fixture.
const DAMAGES: usize = 2000;

/// Reads damaged bytes: as long as nothing panics, anything may be found.
fn survive(dialect: &Dialect, path: &Path, bytes: Vec<u8>, damage: &str) {
    let source = source(path, bytes);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let (marker, found) = read(dialect, &source);
        let _ = (dialect.sniff)(source.bytes());
        (describe(&marker, &source), render(&found, &source))
    }));
    assert!(outcome.is_ok(), "{}: {damage} panics", path.display());
}

fn small_fixtures(dialect: &Dialect) -> Vec<(PathBuf, Vec<u8>)> {
    let folders = [dialect.name.to_owned(), format!("invalid/{}", dialect.name)];
    let paths = folders.iter().flat_map(|folder| files(folder));
    paths.map(|path| (path.clone(), fs::read(&path).expect("readable"))).filter(|(_, b)| b.len() < SMALL).collect()
}

#[test]
fn a_fixture_cut_short_anywhere_never_panics() {
    for dialect in DIALECTS {
        for (path, bytes) in small_fixtures(dialect) {
            for length in (0..bytes.len()).step_by(ONE_IN) {
                survive(dialect, &path, bytes[..length].to_vec(), &format!("a cut after {length} bytes"));
            }
        }
    }
}

#[test]
fn a_fixture_with_a_damaged_byte_never_panics() {
    for dialect in DIALECTS {
        for (path, bytes) in small_fixtures(dialect).into_iter().filter(|(_, bytes)| !bytes.is_empty()) {
            let mut random = fastrand::Rng::with_seed(bytes.len() as u64);
            for _ in 0..DAMAGES / ONE_IN {
                let mut damaged = bytes.clone();
                let (at, byte) = (random.usize(..bytes.len()), random.u8(..));
                damaged[at] = byte;
                survive(dialect, &path, damaged, &format!("byte {byte:#04x} at {at}"));
            }
        }
    }
}
