//! Codes of cutter files that a profile may switch off: the keys `codes.*`.

use serde::{Deserialize, Serialize};

use super::key::{Family, Key, Takes};
use super::word::words;

/// Prefix of the names of these keys.
pub const CODES: &str = "codes";

/// The keys `codes.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "codes.<code>", takes: Takes::Word(words::<CodeUse>), about: "A code of the cutter file to obey or to skip, as the USE/IGNORE switches of a cutter." },
];

/// Family with one key per code.
pub(super) const FAMILY: Family = Family { start: CODES, has: is_code, pattern, example: "M19 = \"ignore\"" };

/// Use of a code of the cutter file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CodeUse {
    /// Obeyed.
    Use,
    /// Skipped, without a warning.
    Ignore,
}

/// All codes of cutter files that may be switched, without leading zeros, and without the number where that is a value.
#[rustfmt::skip] // a table: one row a letter
pub const CODE_NAMES: &[&str] = &[
    "A", "B", "E", "F", "H", "L", "N", "O", "Q", "R", "Z",
    "D1", "D2", "D4",
    "G0", "G1", "G2", "G3", "G4", "G70", "G71", "G90", "G91",
    "M0", "M1", "M14", "M15", "M17", "M18", "M19", "M20", "M23", "M25", "M26", "M30", "M31", "M40", "M41", "M42", "M43",
    "M44", "M45", "M46", "M47", "M48", "M51", "M60", "M61", "M62", "M63", "M64", "M65", "M66", "M67", "M68", "M69", "M70",
    "M72", "M73",
];

/// Regular expression for all codes, with the leading zeros that files write.
fn pattern() -> String {
    let spelled = |code: &&str| match code.split_at(1) {
        (letter, "") => letter.to_owned(),
        // The zero of a code such as `G0` itself must stay.
        (letter, number) => format!("{letter}0*{number}"),
    };
    format!("(?:{})", CODE_NAMES.iter().map(spelled).collect::<Vec<_>>().join("|"))
}

fn is_code(word: &str) -> bool {
    CODE_NAMES.contains(&word)
}

/// Name of a key as in the table of keys: without the leading zeros that files write in codes (`M01` is `M1`).
pub(super) fn canonical(name: &str) -> String {
    let plain = || {
        let code = name.strip_prefix(CODES)?.strip_prefix('.')?;
        let digits = code.find(|c: char| c.is_ascii_digit())?;
        let (letter, number) = code.split_at(digits);
        let number: u32 = number.parse().ok()?;
        let code = format!("{letter}{number}");
        is_code(&code).then(|| format!("{CODES}.{code}"))
    };
    plain().unwrap_or_else(|| name.to_owned())
}

/// Number of codes suggested for one that does not exist.
const NEAR_CODES: usize = 3;

/// Keys of the codes suggested for one that does not exist, the likeliest first; `None` if the name is not a code's.
pub fn near_codes(name: &str) -> Option<Vec<String>> {
    let typed = name.strip_prefix(CODES)?.strip_prefix('.')?.to_uppercase();
    let digits = typed.find(|c: char| c.is_ascii_digit()).unwrap_or(typed.len());
    let (letter, number) = typed.split_at(digits);
    // Normalises the spelling of files: M01 is M1, F300 is F.
    let significant = match number.trim_start_matches('0') {
        "" if !number.is_empty() => "0",
        significant => significant,
    };
    let spelled = [format!("{letter}{significant}"), letter.to_owned()];
    let mut codes: Vec<&str> = match CODE_NAMES.iter().find(|code| spelled.iter().any(|word| word == *code)) {
        Some(code) => vec![*code],
        None => CODE_NAMES.to_vec(),
    };
    codes.sort_by_key(|code| strsim::damerau_levenshtein(&typed, code)); // stable: the table's order among equals
    Some(codes.into_iter().take(NEAR_CODES).map(|code| format!("{CODES}.{code}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_code_has_its_near_ones() {
        let check =
            |typed: &str, expected: &[&str]| assert_eq!(near_codes(typed).expect("a code"), expected, "{typed}");
        check("codes.m19", &["codes.M19"]);
        check("codes.M001", &["codes.M1"]);
        check("codes.M00", &["codes.M0"]);
        check("codes.F300", &["codes.F"]);
        check("codes.M91", &["codes.G91", "codes.M1", "codes.M19"]);
        check("codes.X", &["codes.A", "codes.B", "codes.E"]);
        assert_eq!(near_codes("knife.width"), None);
    }
}
