//! Digests for the provenance of a program.

use std::fmt::Write as _;
use std::io::{self, Read};

use sha2::{Digest, Sha256};

use super::MachineProfile;

/// Bytes that are read at a time.
const BLOCK_BYTES: usize = 1 << 16;

/// The SHA-256 of some bytes, 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// The same of all that a reader gives.
pub fn sha256_of(mut bytes: impl Read) -> io::Result<String> {
    let mut digest = Sha256::new();
    let mut block = vec![0; BLOCK_BYTES];
    loop {
        match bytes.read(&mut block)? {
            0 => return Ok(hex(&digest.finalize())),
            n => digest.update(&block[..n]),
        }
    }
}

/// The BLAKE3 of all that a reader gives, as `b3sum` prints it: a program is as large as a thousand of its sources, and this
/// is ten times as fast on processors without instructions for the other.
pub fn blake3_of(bytes: impl Read) -> io::Result<String> {
    let mut digest = blake3::Hasher::new();
    digest.update_reader(bytes)?;
    Ok(digest.finalize().to_string())
}

fn hex(digest: &[u8]) -> String {
    let mut hex = String::with_capacity(2 * digest.len());
    for byte in digest {
        // Writing into a `String` cannot fail.
        let _ = write!(hex, "{byte:02x}");
    }
    hex
}

impl MachineProfile {
    /// The SHA-256 of everything that the profile says: equal for two files that differ in comments, order or spelling.
    pub fn digest(&self) -> String {
        let canonical = serde_json::to_vec(&self.effective()).expect("a profile holds numbers, words and named tables");
        sha256_hex(&canonical)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Knife;

    #[test]
    fn a_digest_is_that_of_the_standard() {
        assert_eq!(sha256_hex(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn the_digest_follows_the_meaning_not_the_spelling() {
        let by_back = MachineProfile::default();
        let knife = Knife { back_mm: None, radius_mm: Some(0.25), ..Knife::default() };
        let by_radius = MachineProfile { knife, ..MachineProfile::default() };
        assert_eq!(by_back.digest(), by_radius.digest());
        let other = MachineProfile { home: [0.0, 0.0, 1.0], ..MachineProfile::default() };
        assert_ne!(by_back.digest(), other.digest());
    }
}
