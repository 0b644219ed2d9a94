//! Files of the fixtures, and what becomes of them on a bad disk or in a careless editor.

use std::panic::{AssertUnwindSafe, catch_unwind};

use fastrand::Rng;

/// The files in a folder of the fixtures, in order, each with the folder before its name.
pub(crate) fn names(folder: &str) -> Vec<String> {
    let path = format!("{}/fixtures/{folder}", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(path).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| format!("{folder}/{}", entry.expect("readable").file_name().to_string_lossy())).collect();
    names.sort();
    names
}

/// Tries so many damages of a file: cut short, a byte put in, a byte that is another. None may end in a panic.
pub(crate) fn survives(random: &mut Rng, times: usize, (name, bytes): (&str, &[u8]), what: impl Fn(&[u8])) {
    for _ in 0..times {
        let mut bytes = bytes.to_vec();
        match random.u8(0..3) {
            0 => bytes.truncate(random.usize(0..=bytes.len())),
            1 => bytes.insert(random.usize(0..=bytes.len()), random.u8(..)),
            _ if bytes.is_empty() => {}
            _ => {
                let at = random.usize(0..bytes.len());
                bytes[at] = random.u8(..);
            }
        }
        let tried = catch_unwind(AssertUnwindSafe(|| what(&bytes)));
        assert!(tried.is_ok(), "{name}: {}", bytes.escape_ascii());
    }
}
