//! Lines of G-code that a profile gives: which of their words would undo what the program around them says.

use super::controller::Gcode;

/// Words that change what every number behind them means, or how the way there is taken.
const MODES: &[&str] = &[
    "G7", "G10", "G18", "G19", "G20", "G41", "G42", "G43", "G43.1", "G43.2", "G51", "G52", "G61", "G61.1", "G64",
    "G68", "G70", "G90.1", "G91", "G92", "G93", "G94", "G95",
];
/// Words that move axes without naming them, and that call other programs.
const MOVES: &[&str] = &["G28", "G30", "G38.2", "G65", "M98"];
/// Words that end the program.
const ENDS: &[&str] = &["M2", "M02", "M30", "%"];

/// Words that switch outputs, but only where the next move begins: the knife would come down as it is led on.
const LATE: &[&str] = &["M62", "M63", "M67"];

/// The lines of a profile by their keys.
fn texts(gcode: &Gcode) -> [(&'static str, &String); 8] {
    [
        ("gcode.header", &gcode.header),
        ("gcode.knife_down", &gcode.knife_down),
        ("gcode.knife_up", &gcode.knife_up),
        ("gcode.drill_down", &gcode.drill_down),
        ("gcode.drill_up", &gcode.drill_up),
        ("gcode.stop", &gcode.stop),
        ("gcode.advance", &gcode.advance),
        ("gcode.footer", &gcode.footer),
    ]
}

/// The lines of a profile by their keys, and the first word of each that has no business there.
pub(super) fn harmful(gcode: &Gcode) -> Vec<(&'static str, String)> {
    let axes = [b'X', b'Y', gcode.letter.byte()];
    let found = texts(gcode).into_iter().filter_map(|(key, text)| {
        let is_last = key == "gcode.footer";
        let harms = |word: &String| {
            let is_axis = axes.contains(&word.as_bytes()[0]) && word.len() > 1;
            let is_any = |list: &[&str]| list.contains(&word.as_str());
            // F would hold where a move has none, O begins a subroutine, N is the number that the program gives.
            let is_call = word.starts_with(['F', 'O', 'N']);
            is_any(MODES) || is_call || !is_last && (is_axis || is_any(MOVES) || is_any(ENDS))
        };
        Some((key, text.lines().flat_map(words).find(harms)?))
    });
    found.collect()
}

/// The lines of a profile by their keys, and the first word of each that acts too late.
pub(super) fn late(gcode: &Gcode) -> Vec<(&'static str, String)> {
    let first = |text: &str| text.lines().flat_map(words).find(|word| LATE.contains(&word.as_str()));
    texts(gcode).into_iter().filter_map(|(key, text)| Some((key, first(text)?))).collect()
}

/// Two keys that must not say the same: what puts a tool down and what lifts it.
pub(super) fn same(gcode: &Gcode) -> Vec<[&'static str; 2]> {
    let pairs = [
        (["gcode.knife_down", "gcode.knife_up"], [&gcode.knife_down, &gcode.knife_up]),
        (["gcode.drill_down", "gcode.drill_up"], [&gcode.drill_down, &gcode.drill_up]),
    ];
    let said = |text: &str| text.lines().flat_map(words).collect::<Vec<_>>();
    pairs
        .into_iter()
        .filter(|(_, [down, up])| !said(down).is_empty() && said(down) == said(up))
        .map(|(keys, _)| keys)
        .collect()
}

/// The keys whose lines open a comment and do not close it: controllers stop there.
pub(super) fn open_comments(gcode: &Gcode) -> Vec<&'static str> {
    let is_open = |line: &str| line.matches('(').count() != line.matches(')').count();
    texts(gcode).into_iter().filter(|(_, text)| text.lines().any(is_open)).map(|(key, _)| key).collect()
}

/// Whether the last lines end the program.
pub(super) fn ends(gcode: &Gcode) -> bool {
    gcode.footer.lines().flat_map(words).any(|word| ENDS.contains(&word.as_str()))
}

/// The keys that must say something: without them nothing would move the knife, or end the program.
pub(super) fn blank(gcode: &Gcode) -> Vec<&'static str> {
    let texts =
        [("gcode.knife_down", &gcode.knife_down), ("gcode.knife_up", &gcode.knife_up), ("gcode.footer", &gcode.footer)];
    texts.into_iter().filter(|(_, text)| text.lines().flat_map(words).next().is_none()).map(|(key, _)| key).collect()
}

/// The first character of lines that no controller reads: they are plain ASCII.
pub(super) fn foreign(gcode: &Gcode) -> Vec<(&'static str, char)> {
    let is_foreign = |c: &char| !matches!(c, ' '..='~' | '\t' | '\n' | '\r');
    texts(gcode).into_iter().filter_map(|(key, text)| Some((key, text.chars().find(is_foreign)?))).collect()
}

/// The words of a line: letters with their numbers, upper case, whatever blanks stand between; comments are none.
fn words(line: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut is_comment = false;
    for c in line.chars().take_while(|&c| c != ';') {
        match c {
            '(' => is_comment = true,
            ')' => is_comment = false,
            _ if is_comment || c.is_whitespace() => {}
            _ if c.is_ascii_alphabetic() || c == '%' => words.push(c.to_ascii_uppercase().to_string()),
            _ => words.last_mut().into_iter().for_each(|word| word.push(c)),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_undo_the_program_are_found_in_any_spelling() {
        let found = |header: &str, footer: &str| {
            harmful(&Gcode { header: header.to_owned(), footer: footer.to_owned(), ..Gcode::default() })
        };
        assert_eq!(found("G54\n(G20 X5) T1 M6", "M65 P0\nG0 X0 Y0\nM2"), []);
        for (header, word) in [("g20", "G20"), ("G54 G 92 X10", "G92"), ("M30", "M30"), ("G0X5", "X5"), ("%", "%")] {
            assert_eq!(found(header, "M2"), [("gcode.header", word.to_owned())], "{header}");
        }
        assert_eq!(found("", "G91\nM2"), [("gcode.footer", "G91".to_owned())]);
        assert_eq!(found("N5 G54", "M2"), [("gcode.header", "N5".to_owned())]);
    }

    #[test]
    fn outputs_that_wait_for_a_move_are_found() {
        let with = |down: &str| late(&Gcode { knife_down: down.to_owned(), ..Gcode::default() });
        assert_eq!(with("M64 P0"), []);
        assert_eq!(with("m62 p0"), [("gcode.knife_down", "M62".to_owned())]);
    }
}
