//! Decimal commas: plots of programs that write numbers as the language of the computer has them. Their pairs read as four
//! numbers, all of them at other places.

/// Bytes that are looked at.
const LOOKED_AT: usize = 4096;
/// Numbers that show it: fewer may be chance.
const LEAST: usize = 4;
/// Decimals of a number at the least: one digit behind a comma may as well be a coordinate.
const LEAST_DECIMALS: usize = 2;

/// Whether the places of a plot have commas for points: blanks part the numbers, behind each comma stand as many digits, and
/// some of these begin with a zero, which no coordinate does.
pub(super) fn has(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    // The last instruction may go on behind what is looked at.
    let end = memchr::memrchr(b';', head).unwrap_or(0);
    let instructions = head[..end].split(|&byte| byte == b';').map(<[u8]>::trim_ascii);
    let places = instructions.filter_map(|instruction| match instruction {
        [b'P', b'U' | b'D' | b'A' | b'R', places @ ..] => Some(places.trim_ascii()),
        _ => None,
    });
    let numbers = places.filter(|places| !places.is_empty()).flat_map(|places| places.split(|&byte| byte == b' '));
    let (mut count, mut decimals, mut has_zero) = (0, None, false);
    for number in numbers.filter(|number| !number.is_empty()) {
        let Some(comma) = memchr::memchr(b',', number) else { return false };
        let behind = &number[comma + 1..];
        if behind.len() < LEAST_DECIMALS || !behind.iter().all(u8::is_ascii_digit) {
            return false;
        }
        if *decimals.get_or_insert(behind.len()) != behind.len() {
            return false;
        }
        has_zero |= behind[0] == b'0';
        count += 1;
    }
    has_zero && count >= LEAST
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_between_coordinates_are_none_of_numbers() {
        for (plot, is_decimal) in [
            ("IN;PU400,00 400,00;PD4400,00 400,00;PD4400,00 2400,00;", true),
            ("IN;PU10,25 7,50;PD10,25 80,00;PU;PD3,50 -4,05;", true),
            ("IN;PU400,100 400,200;PD4400,300 400,500;PD4400,200 2400,400;", false),
            ("IN;PU400,0 400,0;PD4400,0 400,0;PD4400,0 2400,0;", false),
            ("IN;PU400,00,400,00;PD4400,00,400,00;", false),
            ("IN;PU400,00 400,00;PD", false),
        ] {
            assert_eq!(has(plot.as_bytes()), is_decimal, "{plot}");
        }
    }
}
