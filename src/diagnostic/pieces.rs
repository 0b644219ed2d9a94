//! Lists of pieces in messages.

/// Greatest number of pieces that a message names.
const SHOWN: usize = 8;

/// Pieces by their numbers, in a few words: `piece 4`, `pieces 1, 3`, or the first ones and the number of the others.
pub fn listed(numbers: &[u32]) -> String {
    if numbers.is_empty() {
        return "no piece".to_owned();
    }
    let shown: Vec<String> = numbers.iter().take(SHOWN).map(u32::to_string).collect();
    let noun = if numbers.len() == 1 { "piece" } else { "pieces" };
    match numbers.len().saturating_sub(SHOWN) {
        0 => format!("{noun} {}", shown.join(", ")),
        more => format!("{noun} {} and {more} more", shown.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_pieces_are_counted() {
        assert_eq!(listed(&[]), "no piece");
        assert_eq!(listed(&[4]), "piece 4");
        assert_eq!(listed(&[1, 3]), "pieces 1, 3");
        let all: Vec<u32> = (1..=10).collect();
        assert_eq!(listed(&all), "pieces 1, 2, 3, 4, 5, 6, 7, 8 and 2 more");
    }
}
