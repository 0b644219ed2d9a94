//! Damage to the bytes of a program.

use crate::case::Case;
use crate::{Damage, damage};

const FORMAT: &[&str] = &["verify/format"];

pub(crate) const DAMAGES: &[Damage] = &[
    damage("empty file", FORMAT, |_, _| Some(Vec::new())),
    damage("header alone", FORMAT, |case, _| Some(lines(case)[0].clone())),
    damage("no header", FORMAT, |case, _| Some(lines(case)[1..].concat())),
    damage("header of another order", FORMAT, |case, rng| {
        line(case, rng, true, |text| text.replace("x_mm,y_mm", "y_mm,x_mm"))
    }),
    damage("cut short inside a row", FORMAT, |case, rng| {
        let end = case.program.len() / 2 + rng.usize(0..case.program.len() / 4);
        let end = if case.program[end - 1] == b'\n' { end - 1 } else { end };
        Some(case.program[..end].to_vec())
    }),
    damage("missing field", FORMAT, |case, rng| {
        line(case, rng, false, |text| text[..text.rfind(',').expect("fields")].to_owned() + "\n")
    }),
    damage("extra field", FORMAT, |case, rng| line(case, rng, false, |text| text.replace('\n', ",0\n"))),
    damage("NaN", FORMAT, |case, rng| field(case, rng, 1, "NaN")),
    damage("infinity", FORMAT, |case, rng| field(case, rng, 2, "inf")),
    damage("a number beyond all numbers", FORMAT, |case, rng| field(case, rng, 3, "1e999")),
    damage("a word for a number", FORMAT, |case, rng| field(case, rng, 1, "null")),
    damage("empty field", FORMAT, |case, rng| field(case, rng, 2, "")),
    damage("knife neither up nor down", FORMAT, |case, rng| field(case, rng, 4, "2")),
    damage("a fifth drill", FORMAT, |case, rng| field(case, rng, 5, "5")),
    damage("decimal commas", FORMAT, |case, rng| line(case, rng, false, |text| text.replace('.', ","))),
    damage("blank line", FORMAT, |case, rng| line(case, rng, false, |text| format!("\n{text}"))),
    damage("another encoding", FORMAT, |case, _| Some(case.program.iter().flat_map(|&byte| [byte, 0]).collect())),
];

fn lines(case: &Case) -> Vec<Vec<u8>> {
    case.program.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect()
}

/// Changes the header or one row.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn line(case: &Case, rng: &mut fastrand::Rng, header: bool, change: impl Fn(&str) -> String) -> Option<Vec<u8>> {
    let mut lines = lines(case);
    let place = if header { 0 } else { rng.usize(1..lines.len()) };
    lines[place] = change(std::str::from_utf8(&lines[place]).expect("programs are ASCII")).into_bytes();
    Some(lines.concat())
}

/// Changes one field of one row.
fn field(case: &Case, rng: &mut fastrand::Rng, index: usize, value: &str) -> Option<Vec<u8>> {
    line(case, rng, false, |text| {
        let mut fields: Vec<&str> = text.trim_end().split(',').collect();
        fields[index] = value;
        fields.join(",") + "\n"
    })
}
