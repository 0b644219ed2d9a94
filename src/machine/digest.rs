//! Digests for the provenance of a program.

use std::fmt::Write as _;
use std::io::{self, Read};

use sha2::{Digest, Sha256};

use super::MachineProfile;

/// Block size for reading, bytes.
const BLOCK_BYTES: usize = 1 << 16;

/// SHA-256 of some bytes, as 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// SHA-256 of the whole content of a reader, as 64 lower-case hexadecimal digits.
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

/// BLAKE3 of the whole content of a reader, as `b3sum` prints it. A program is as large as a thousand of its sources, and
/// BLAKE3 is ten times as fast as SHA-256 on processors without instructions for that.
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
    /// SHA-256 of all values of the profile: equal for two files that differ only in comments, order or spelling.
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
