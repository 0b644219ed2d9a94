//! Damage to the bytes of a program.

use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::{Damage, damage};

const FORMAT: &str = "verify/format";

pub(crate) const DAMAGES: &[Damage] = &[
    damage("empty file", FORMAT, |_, _| Some(bad(Vec::new(), 0.0))),
    damage("header alone", FORMAT, |case, _| Some(bad(lines(case)[0].clone(), 0.0))),
    damage("no header", FORMAT, |case, _| Some(bad(lines(case)[1..].concat(), 0.0))),
    damage("header of another order", FORMAT, |case, _| line(case, 0, |text| text.replace("x_mm,y_mm", "y_mm,x_mm"))),
    damage("cut short inside a row", FORMAT, |case, rng| {
        let end = case.program.len() / 2 + rng.usize(0..case.program.len() / 4);
        let end = if case.program[end - 1] == b'\n' { end - 1 } else { end };
        let whole = case.program[..end].split(|&byte| byte == b'\n').count() - 1;
        Some(bad(case.program[..end].to_vec(), case.rows[whole - 1].t))
    }),
    damage("missing field", FORMAT, |case, rng| {
        line(case, any(case, rng), |text| text[..text.rfind(',').expect("fields")].to_owned() + "\n")
    }),
    damage("extra field", FORMAT, |case, rng| line(case, any(case, rng), |text| text.replace('\n', ",0\n"))),
    damage("NaN", FORMAT, |case, rng| field(case, any(case, rng), (1, "NaN"))),
    damage("infinity", FORMAT, |case, rng| field(case, any(case, rng), (2, "inf"))),
    damage("a number beyond all numbers", FORMAT, |case, rng| field(case, any(case, rng), (3, "1e999"))),
    damage("a word for a number", FORMAT, |case, rng| field(case, any(case, rng), (1, "null"))),
    damage("empty field", FORMAT, |case, rng| field(case, any(case, rng), (2, ""))),
    damage("knife neither up nor down", FORMAT, |case, rng| field(case, any(case, rng), (4, "2"))),
    damage("a fifth drill", FORMAT, |case, rng| field(case, any(case, rng), (5, "5"))),
    damage("decimal commas", FORMAT, |case, rng| line(case, any(case, rng), |text| text.replace('.', ","))),
    damage("blank line", FORMAT, |case, rng| line(case, any(case, rng), |text| format!("\n{text}"))),
    damage("another encoding", FORMAT, |case, _| {
        Some(bad(case.program.iter().flat_map(|&byte| [byte, 0]).collect(), 0.0))
    }),
];

/// A program with one bad row, which is seen at the time of the row before it.
fn bad(program: Vec<u8>, time: f64) -> Harm {
    Harm { program, amount: 1.0, place: Place::During([time; 2]) }
}

fn lines(case: &Case) -> Vec<Vec<u8>> {
    case.program.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect()
}

/// The line of any row; that of the header is 0.
fn any(case: &Case, rng: &mut fastrand::Rng) -> usize {
    rng.usize(1..=case.rows.len())
}

/// Changes a line.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn line(case: &Case, place: usize, change: impl Fn(&str) -> String) -> Option<Harm> {
    let mut lines = lines(case);
    lines[place] = change(std::str::from_utf8(&lines[place]).expect("programs are ASCII")).into_bytes();
    Some(bad(lines.concat(), case.rows[place.saturating_sub(2)].t))
}

/// Gives one field of a line another value.
fn field(case: &Case, place: usize, (index, value): (usize, &str)) -> Option<Harm> {
    line(case, place, |text| {
        let mut fields: Vec<&str> = text.trim_end().split(',').collect();
        fields[index] = value;
        fields.join(",") + "\n"
    })
}
