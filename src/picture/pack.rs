//! Columns of whole numbers as a page holds them: differences of neighbours in as few bytes as they need, deflated and in
//! base64.

use miniz_oxide::deflate::compress_to_vec_zlib;

/// Level at which the columns are packed, 0 to 10.
const LEVEL: u8 = 7;
/// Letters of base64.
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Columns of numbers under names, one behind the other.
#[derive(Debug, Default)]
pub struct Columns {
    names: Vec<(&'static str, usize, f64)>,
    bytes: Vec<u8>,
}

impl Columns {
    /// Adds a column of numbers that are multiples of a unit.
    pub fn add(&mut self, name: &'static str, unit: f64, numbers: impl IntoIterator<Item = i64>) {
        let (mut count, mut last) = (0, 0_i64);
        for number in numbers {
            push(&mut self.bytes, number.wrapping_sub(last));
            (last, count) = (number, count + 1);
        }
        self.names.push((name, count, unit));
    }

    /// Names, lengths and units of the columns, as JSON.
    pub(super) fn names(&self) -> serde_json::Value {
        self.names.iter().map(|(name, count, unit)| serde_json::json!([name, count, unit])).collect()
    }

    /// The columns as text.
    pub(super) fn packed(&self) -> String {
        base64(&compress_to_vec_zlib(&self.bytes, LEVEL))
    }
}

/// Adds a number in groups of seven bits, the lowest first; its sign is the lowest bit.
fn push(bytes: &mut Vec<u8>, number: i64) {
    let mut rest = (number.wrapping_shl(1) ^ (number >> 63)).cast_unsigned();
    while rest >= 0x80 {
        bytes.push((rest & 0x7f) as u8 | 0x80);
        rest >>= 7;
    }
    bytes.push(rest as u8);
}

/// Bytes in base64, as RFC 4648 has it.
pub(super) fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        let words = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|word| base64(word.as_bytes()));
        assert_eq!(words, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
    }

    #[test]
    fn small_differences_take_a_byte() {
        let mut columns = Columns::default();
        columns.add("x", 0.5, [1000, 1001, 999, -1]);
        assert_eq!(columns.bytes, [0xd0, 0x0f, 2, 3, 0xcf, 0x0f]);
        assert_eq!(columns.names().to_string(), r#"[["x",4,0.5]]"#);
    }

    #[test]
    fn every_number_is_packed() {
        let mut bytes = Vec::new();
        push(&mut bytes, i64::MIN);
        push(&mut bytes, i64::MAX);
        assert_eq!(bytes.len(), 20);
    }
}
