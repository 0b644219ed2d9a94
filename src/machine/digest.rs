//! Digests for the provenance of a program.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::MachineProfile;

/// The SHA-256 of some bytes, 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    let mut hex = String::with_capacity(64);
    for byte in Sha256::digest(bytes) {
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
