//! Quantities: the number of copies that a text asks for, in the words of several CAD systems.

use super::tally::Thing;

/// Words that may follow a quantity, in capitals: words for pieces, and names of materials.
#[rustfmt::skip] // a table: a few languages per row
const OF_PIECES: [&str; 51] = [
    "X", "×", "PC", "PCS", "PIECE", "PIECES", "ST", "STK", "STCK", "STÜCK", "STUECK", "PIÈCE", "PIÈCES",
    "PZ", "PEZZO", "PEZZI", "PIEZA", "PIEZAS", "PEÇA", "PEÇAS", "STUKS", "SZT", "SZTUK", "SZTUKI", "KS", "DB", "BUC",
    "ADET", "ШТ", "ШТУК", "ШТУКИ", "ДЕТ", "片", "件", "枚", "张", "張", "个", "個", "장", "매", "STYCK",
    "SELF", "MAIN", "SHELL", "LINING", "FABRIC", "CONTRAST", "INTERFACING", "ON FOLD",
    "ON THE FOLD",
];

/// Words for a pair of a right and a left piece, in capitals.
const PAIRS: [&str; 12] =
    ["PAIR", "PAIRS", "PR", "PRS", "PAAR", "PAARE", "PAIRE", "PAIRES", "PAIO", "PAIA", "PAR", "PARES"];

/// Quantity of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Wanted {
    /// Number of copies as drawn, and mirrored: `1,1` is one right and one left piece.
    pub(super) times: [u32; 2],
    /// Finding on words after the number.
    pub(super) words: Option<Thing>,
}

/// Parses a quantity. `None` if the text is malformed or the quantity is zero.
pub(super) fn quantity(text: &str) -> Option<Wanted> {
    // Some systems write whole numbers with decimals.
    let whole = |number: &str| number.trim_end_matches('0').strip_suffix('.').unwrap_or(number).parse::<u32>().ok();
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| whole(number.trim())).collect();
    let times = match numbers.as_deref() {
        None => return worded(text),
        Some(&[right]) => [right, 0],
        Some(&[right, left]) => [right, left],
        Some(_) => return None,
    };
    (times != [0, 0]).then_some(Wanted { times, words: None })
}

/// Parses a number at the start of a text, followed by a word for pieces or pairs, or by a remark in parentheses.
fn worded(text: &str) -> Option<Wanted> {
    let text = text.trim();
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, behind) = text.split_at(digits);
    let (word, aside) = match behind.split_once('(') {
        None => (behind, None),
        Some((word, aside)) => (word, Some(aside.strip_suffix(')')?)),
    };
    let word = word.trim().trim_end_matches('.').to_uppercase();
    let is_aside = aside.is_some_and(|aside| !aside.contains(['(', ')']));
    let is_pair = PAIRS.contains(&word.as_str());
    let is_known = is_pair || OF_PIECES.contains(&word.as_str());
    let is_clear = if word.is_empty() { is_aside } else { is_known && aside.is_none_or(|_| is_aside) };
    let number = number.parse().ok().filter(|&number| is_clear && number > 0)?;
    Some(if is_pair {
        Wanted { times: [number, number], words: Some(Thing::QuantityPairs) }
    } else {
        Wanted { times: [number, 0], words: Some(Thing::QuantityWords) }
    })
}

/// True if a text has two numbers or more, which may be those of right and left pieces.
pub(super) fn has_several_numbers(text: &[u8]) -> bool {
    let is_of_number = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    text.chunk_by(|a, b| is_of_number(a) == is_of_number(b)).filter(|run| run[0].is_ascii_digit()).count() > 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantity_is_right_and_left() {
        let times = |text: &str| quantity(text).map(|wanted| wanted.times);
        let check = |text: &str, expected: Option<[u32; 2]>| assert_eq!(times(text), expected, "{text}");
        check("1,1", Some([1, 1]));
        check("2", Some([2, 0]));
        check("2.0", Some([2, 0]));
        check("20", Some([20, 0]));
        check("1.5", None);
        check(" 0 , 1 ", Some([0, 1]));
        check("0", None);
        check("1,", None);
        check("1,1,1", None);
        check("-1", None);
        check("two", None);
        for text in ["2x", "2 Stück", "2 Stk.", "2 (1 PAIR)", "2 pcs (left and right)", "2片", "2 SELF", "2 Lining"] {
            check(text, Some([2, 0]));
        }
        for text in ["2 PAIRS", "2 Paar", "2 pairs (left and right)", "2prs."] {
            check(text, Some([2, 2]));
        }
        for text in ["1L 1R", "0 PAIRS", "PAIR", "1+1", "1/1", "1 (R), 1 (L)", "2 x SELF", "x", "2 ", "()", "2 ()("] {
            check(text, times("2").filter(|_| text == "2 "));
        }
        for text in ["1;1", "L1 R1", "1+1", "1 L + 1 R", "1,1,1", "1 / 1.0"] {
            assert!(times(text).is_none() && has_several_numbers(text.as_bytes()), "{text}");
        }
        for text in ["0", "1.5", "two", "x2", "", "1 L"] {
            assert!(!has_several_numbers(text.as_bytes()), "{text}");
        }
    }
}
