//! Detection of decimal commas, written by programs that format numbers in the language of the computer. A pair of such numbers
//! reads as four numbers with wrong values.

/// Number of bytes examined.
const LOOKED_AT: usize = 4096;
/// Minimum number of numbers as evidence; fewer may be chance.
const LEAST: usize = 4;
/// Minimum number of decimals where blanks separate the numbers; a single digit after a comma may be a coordinate.
const LEAST_DECIMALS: usize = 2;
/// Height below which a drawing is flat, mm. Decimals that are read as Y stay below it.
const FLAT: f64 = 3.0;
/// Minimum number of points of a flat drawing, and its minimum ratio of length to height. A square with misread commas reaches
/// both.
const LEAST_PLACES: usize = 6;
const FLAT_RATIO: f64 = 8.0;
/// Minimum number of turns of a pen that follows a line back and forth.
const LEAST_TURNS: usize = 3;

/// True if the coordinates of a plot have decimal commas. Either all numbers have equally many digits after the comma, some of
/// which begin with a zero, as no coordinate does; or the digits after the commas, read as Y, make a flat drawing. `unit` is
/// the unit of the file, mm.
pub(super) fn has(bytes: &[u8], unit: f64) -> bool {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    // The last instruction may be truncated.
    let end = memchr::memrchr(b';', head).unwrap_or(0);
    are_parted_by_blanks(places(&head[..end])) || is_flat(bytes, unit)
}

/// The numbers of each pen instruction that has some.
fn places(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let instructions = bytes.split(|&byte| byte == b';').map(<[u8]>::trim_ascii);
    let places = instructions.filter_map(|instruction| match instruction {
        [b'P', b'U' | b'D' | b'A' | b'R', places @ ..] => Some(places.trim_ascii()),
        _ => None,
    });
    places.filter(|places| !places.is_empty())
}

/// True if every number has a comma with equally many digits after it, and some of these begin with a zero.
fn are_parted_by_blanks<'a>(places: impl Iterator<Item = &'a [u8]>) -> bool {
    let numbers = places.flat_map(|places| places.split(|&byte| byte == b' '));
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

/// True if all points of a plot, read as pairs, have a Y without a sign and with equally many digits, so that the drawing is
/// nearly a line but not exactly one, or a line that the pen follows back and forth. Plots with relative moves or scales are
/// excluded. In nearly all plots one of the first points ends the search.
fn is_flat(bytes: &[u8], unit: f64) -> bool {
    let (mut x, mut y) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, 0.0_f64]);
    let (mut digits, mut count) = (None, 0);
    let (mut last, mut is_forth, mut turns) = (f64::NAN, None, 0);
    for pairs in places(bytes) {
        let numbers = pairs.split(|&byte| byte == b',' || byte == b' ').filter(|number| !number.is_empty());
        let mut numbers = numbers.map(|number| (number, parsed(number)));
        while let Some((_, column)) = numbers.next() {
            let (Some(column), Some((row, Some(height)))) = (column, numbers.next()) else { return false };
            let is_alike = row.iter().all(u8::is_ascii_digit) && *digits.get_or_insert(row.len()) == row.len();
            if !is_alike || height * unit > FLAT {
                return false;
            }
            if column != last && !last.is_nan() {
                turns += usize::from(is_forth.replace(column > last) == Some(column < last));
            }
            last = column;
            x = [x[0].min(column), x[1].max(column)];
            y = [y[0].min(height), y[1].max(height)];
            count += 1;
        }
    }
    let leaves_line = y[1] > y[0]
        || digits.is_some_and(|digits| digits >= LEAST_DECIMALS) && y[1] == 0.0
        || y[0] > 0.0 && turns >= LEAST_TURNS;
    let is_scaled = || bytes.windows(3).any(|three| matches!(three, [b';', b'P', b'R'] | [b';', b'S', b'C']));
    count >= LEAST_PLACES && leaves_line && x[1] - x[0] >= FLAT_RATIO * y[1].max(1.0) && !is_scaled()
}

fn parsed(number: &[u8]) -> Option<f64> {
    std::str::from_utf8(number).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_between_coordinates_are_none_of_numbers() {
        for (plot, is_decimal) in [
            ("IN;PU400,00 400,00;PD4400,00 400,00;PD4400,00 2400,00;", true),
            ("IN;PU10,25 7,50;PD10,25 80,00;PU;PD3,50 -4,05;", true),
            ("IN;PU404,94 413,51;PD12409,38 413,51;PD12409,38 8444,59;PD404,94 8444,59;", true),
            ("IN;PU404,94,413,51;PD12409,38,413,51;PD12409,38,8444,59;PD404,94,8444,59;", true),
            ("IN;PU400,00,400,00;PD4400,00,400,00;PD4400,00,2400,00;PD400,00,2400,00;", true),
            ("IN;PU404,9 413,5;PD12409,4 413,5 12409,4 8444,6 404,9 8444,6 404,9 413,5;", true),
            ("IN;PU404,9;PD413,5,12409,4,413,5,12409,4,8444,6,404,9,8444,6,404,9,413,5;", true),
            ("IN;PU400,5,400,5;PD16400,5,400,5;PD16400,5,8400,5;PD400,5,8400,5;PD400,5,400,5;", true),
            ("IN;PU400,5;PD800,5;PU1200,5;PD1600,5;PU2000,5;PD2400,5;PU2800,5;PD3200,5;", false),
            ("IN;PU400,100 400,200;PD4400,300 400,500;PD4400,200 2400,400;", false),
            ("IN;PU400,0 400,0;PD4400,0 400,0;PD4400,0 2400,0;", false),
            ("IN;PU400,00,400,00;PD4400,00,400,00;", false),
            ("IN;PU400,00 400,00;PD", false),
            // A line of 2 mm by 2 mm, small moves, and a scale.
            ("IN;PU10,10;PD20,10,90,10,90,90,10,90,10,10;", false),
            ("IN;PU400,40;PR;PD400,10,800,20,900,30,700,20,800,10;", false),
            ("IN;SC0,10000,0,100;PU404,94,413,51;PD12409,38,413,51;PD12409,38,8444,59;", false),
        ] {
            assert_eq!(has(plot.as_bytes(), 0.025), is_decimal, "{plot}");
        }
        let in_mm = "PU100,10;PD900,10,900,90,500,95,100,90,100,10;";
        assert!(!has(in_mm.as_bytes(), 1.0));
    }
}
