//! Division of a batch into shards. The content of a file determines its shard, so that every machine gets the same division.

use std::fmt;

/// Leading hexadecimal digits of a digest that determine the shard: 64 bits.
const DIGITS: usize = 16;

/// One shard of a batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) struct Shard {
    /// Number of the shard, from 1.
    index: u64,
    count: u64,
}

impl Shard {
    /// Parses `3/16`.
    pub(in crate::cli) fn parse(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("a part is a number from 1 on and how many there are, as in 3/16".to_owned()),
        }
    }

    /// True if content with this digest belongs to the shard.
    pub(in crate::cli) fn has(self, sha256: &str) -> bool {
        let number = sha256.get(..DIGITS).and_then(|digits| u64::from_str_radix(digits, 16).ok());
        number.expect("a digest is hexadecimal digits") % self.count == self.index - 1
    }
}

impl fmt::Display for Shard {
    /// The form used in file names.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-of-{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::sha256_hex;

    #[test]
    fn every_file_belongs_to_one_part() {
        for count in [1, 2, 7] {
            let parts: Vec<_> = (1..=count).map(|i| Shard::parse(&format!("{i}/{count}")).expect("a part")).collect();
            let mut sizes = vec![0; parts.len()];
            for file in 0..1000_u32 {
                let digest = sha256_hex(&file.to_le_bytes());
                let homes: Vec<_> = (0..parts.len()).filter(|&i| parts[i].has(&digest)).collect();
                assert_eq!(homes.len(), 1);
                sizes[homes[0]] += 1;
            }
            assert!(sizes.iter().all(|&size| size > 1000 / count / 2), "{sizes:?}");
        }
        assert_eq!(Shard::parse("3/16").expect("a part").to_string(), "3-of-16");
        for wrong in ["0/4", "5/4", "1", "1/0", "a/b", "/", "-1/4"] {
            assert!(Shard::parse(wrong).is_err(), "{wrong}");
        }
    }
}
