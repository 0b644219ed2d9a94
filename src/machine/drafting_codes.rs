//! Codes for letters in the texts of DXF: `\U+00F6`, `\M+5B3DF`, `%%d`.

use encoding_rs::{BIG5, EUC_KR, Encoding, GBK, SHIFT_JIS};

/// Encodings selected by the digit of a two-byte code (DXF reference: Japanese, traditional Chinese, Korean, simplified
/// Chinese).
const PAGES: [(char, &Encoding); 4] = [('1', SHIFT_JIS), ('2', BIG5), ('3', EUC_KR), ('5', GBK)];

/// Replaces the codes in a text by their letters. `encoding` applies to letters given by number.
pub(super) fn replaced(text: &str, encoding: &'static Encoding) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['\\', '%']) {
        out.push_str(&rest[..at]);
        let (letters, length) = code(&rest[at..], encoding).unwrap_or_else(|| (rest[at..=at].to_owned(), 1));
        out.push_str(&letters);
        rest = &rest[at + length..];
    }
    out.push_str(rest);
    out
}

/// Letters of the code at the beginning of a text, and its length in bytes.
fn code(text: &str, encoding: &'static Encoding) -> Option<(String, usize)> {
    if let Some(hex) = text.strip_prefix("\\U+").or(text.strip_prefix("\\u+")) {
        return Some((char::from_u32(number(hex, 4, 16)?)?.to_string(), 7));
    }
    if let Some(rest) = text.strip_prefix("\\M+") {
        let page = rest.chars().next()?;
        let (_, page) = PAGES.iter().find(|(number, _)| *number == page)?;
        let pair = number(&rest[1..], 4, 16)? as u16;
        return Some((page.decode_without_bom_handling_and_without_replacement(&pair.to_be_bytes())?.into(), 8));
    }
    let rest = text.strip_prefix("%%")?;
    let letters = match rest.chars().next()? {
        'd' | 'D' => "\u{b0}",
        'p' | 'P' => "\u{b1}",
        'c' | 'C' => "\u{d8}",
        '%' => "%",
        // Lines under, over and through the letters have no letters of their own.
        'u' | 'U' | 'o' | 'O' | 'k' | 'K' => "",
        _ => {
            let byte = u8::try_from(number(rest, 3, 10)?).ok()?;
            return Some((encoding.decode_without_bom_handling_and_without_replacement(&[byte])?.into(), 5));
        }
    };
    Some((letters.to_owned(), 3))
}

/// Number written by the first `digits` digits of a text; `None` if one of them is not a digit.
fn number(text: &str, digits: usize, radix: u32) -> Option<u32> {
    let digits = text.get(..digits).filter(|digits| digits.chars().all(|digit| digit.is_digit(radix)))?;
    u32::from_str_radix(digits, radix).ok()
}

#[cfg(test)]
mod tests {
    use encoding_rs::WINDOWS_1252;

    use super::*;

    #[test]
    fn codes_stand_for_letters_and_all_else_for_itself() {
        let check = |text: &str, expected: &str| assert_eq!(replaced(text, WINDOWS_1252), expected, "{text}");
        check(r"Gr\U+00F6\U+00DFe: 38", "Größe: 38");
        check(r"\M+5B3DF\M+5C2EB: M", "尺码: M");
        check("%%uSIZE:%%u 5%%d %%246 %%%", "SIZE: 5° ö %");
        check(r"\U+D800 \U+12 \M+40000 \M+5FFFF %%999 100% \P \", r"\U+D800 \U+12 \M+40000 \M+5FFFF %%999 100% \P \");
        check("%%ü \\U+尺码", "%%ü \\U+尺码");
    }
}
