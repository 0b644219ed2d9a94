//! Headers of `NumPy` arrays of records, version 1.0 of the format:
//! <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>.

/// Offset of the first record in bytes: a multiple of 64, so that memory maps are aligned.
pub const HEADER_BYTES: usize = 256;
/// Magic string and version.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";

/// The header of an array of `count` records; `fields` lists names and types as Python writes them. The length does not depend
/// on the count, so the count can be filled in later.
pub fn header(fields: &str, count: u64) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let length = HEADER_BYTES - MAGIC.len() - 2;
    bytes.extend_from_slice(&(length as u16).to_le_bytes());
    let text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({count},), }}");
    bytes.extend_from_slice(text.as_bytes());
    debug_assert!(bytes.len() < HEADER_BYTES, "a count has 20 digits at most");
    bytes.resize(HEADER_BYTES - 1, b' ');
    bytes.push(b'\n');
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_has_one_length_whatever_the_count() {
        for count in [0, 1, u64::MAX] {
            let header = header("('t_s', '<f8')", count);
            assert_eq!(header.len(), HEADER_BYTES);
            assert_eq!(HEADER_BYTES % 64, 0);
            assert_eq!(usize::from(u16::from_le_bytes([header[8], header[9]])), HEADER_BYTES - 10);
            assert!(header.ends_with(b" \n"));
        }
    }
}
