//! Polylines in the compact encoding of PE.

use super::scan::Scan;

/// Maximum absolute number of fraction bits.
const MOST_BITS: f64 = 26.0;

impl Scan<'_> {
    /// PE: numbers in digits of base 64 or 32, least significant first.
    pub(super) fn encoded(&mut self) {
        let (mut base, mut last_from) = (64.0, 191);
        let (mut bits, mut is_up, mut is_absolute, mut flag) = (0, false, false, b' ');
        let (mut value, mut weight) = (0.0, 1.0);
        // Start of the number that is being read.
        let mut begun = None;
        let mut first: Option<(f64, usize)> = None;
        while let Some(&raw) = self.bytes.get(self.at) {
            self.at += 1;
            let mut byte = raw;
            if self.is_text && matches!(raw, 0xc2 | 0xc3) {
                let low = self.bytes.get(self.at).copied().unwrap_or(0);
                byte = (raw << 6) | (low & 0x3f);
                self.at += 1;
            }
            match byte {
                // A number without its last digit belongs to the next instruction.
                b';' | b'0'..=b'9' | b'+' | b'-' | b',' if begun.is_some() => {
                    self.at = begun.unwrap_or(self.at);
                    return;
                }
                b';' => return,
                // Change of language.
                0x1b if begun.is_none() && self.bytes.get(self.at) == Some(&b'%') => {
                    self.at -= 1;
                    return;
                }
                b'7' => (base, last_from) = (32.0, 95),
                b'<' => is_up = true,
                b'=' => is_absolute = true,
                b':' | b'>' => flag = byte,
                63..=126 | 191..=254 => {
                    begun.get_or_insert(self.at - 1);
                    let is_last = byte >= last_from;
                    value += f64::from(byte - if is_last { last_from } else { 63 }) * weight;
                    weight *= base;
                    if !is_last {
                        continue;
                    }
                    begun = None;
                    let half = (value / 2.0).floor();
                    let number = if value % 2.0 == 0.0 { half } else { -half };
                    (value, weight) = (0.0, 1.0);
                    match (std::mem::replace(&mut flag, b' '), first.take()) {
                        (b':', kept) => (first, self.pen.cause) = (kept, None),
                        (b'>', kept) if number.abs() <= MOST_BITS => (first, bits) = (kept, number as i32),
                        // The reader ignores the rest, too.
                        (b'>', _) => return,
                        (_, None) => first = Some((number * 2.0_f64.powi(-bits), self.at)),
                        (_, Some((x, cause))) => {
                            let to = self.target([x, number * 2.0_f64.powi(-bits)], !is_absolute);
                            self.pen.is_down = !is_up;
                            self.lead(to, cause);
                            (is_absolute, is_up) = (false, false);
                        }
                    }
                }
                _ => {}
            }
        }
    }
}
