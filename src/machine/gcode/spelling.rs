//! Spellings of a step as regular expressions, for programs that check a profile while it is written.

use super::step::{FORMS, Form};

/// Kind of step.
pub(in crate::machine) struct Spelling {
    /// Effect.
    pub(in crate::machine) about: &'static str,
    /// Complete example.
    pub(in crate::machine) example: &'static str,
    /// Regular expression for a whole step. It covers the letters of the words; the ranges of their numbers are left to
    /// [`Step::read`](super::Step).
    pub(in crate::machine) pattern: String,
}

/// Every kind of step.
pub(in crate::machine) fn spellings() -> impl Iterator<Item = Spelling> {
    FORMS.iter().map(|form| Spelling { about: form.about, example: form.example, pattern: pattern(form) })
}

/// Number in a word.
const NUMBER: &str = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)";

fn pattern(form: &Form) -> String {
    let (letter, number) = form.code.split_at(1);
    // Codes that act on drills may contain their number.
    let number_of_word = if letter == "M" { format!("(?:#|{NUMBER})") } else { NUMBER.to_owned() };
    let number = if number == "0" { r"[+-]?(?:0+\.?0*|\.0+)" } else { &format!(r"\+?0*{number}(?:\.0*)?") };
    let code = format!("{}{number}", either_case(letter));
    let letters = either_case(&format!("{}{}", form.needs, form.takes));
    let word = format!(r"\s*{letters}{number_of_word}");
    // The number of words equals the number of letters, and each letter occurs among them: one word each, in any order.
    let each: Vec<String> = form.needs.chars().map(|c| format!("(?=.*{})", either_case(&c.to_string()))).collect();
    let words = match (form.needs.len(), form.takes.len()) {
        (0, 0) => String::new(),
        (1, 0) => word,
        (needs, takes) => format!("{}(?:{word}){{{needs},{}}}", each.concat(), needs + takes),
    };
    format!(r"^\s*{code}{words}\s*$")
}

/// Class of some letters in upper and lower case.
fn either_case(letters: &str) -> String {
    format!("[{letters}{}]", letters.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_has_the_words_of_its_form() {
        let of = |start: &str| spellings().find(|kind| kind.example.starts_with(start)).expect("a form").pattern;
        assert_eq!(of("M5"), r"^\s*[Mm]\+?0*5(?:\.0*)?\s*$");
        assert_eq!(of("G0"), format!(r"^\s*[Gg][+-]?(?:0+\.?0*|\.0+)\s*[Zz]{NUMBER}\s*$"));
        assert_eq!(of("M3"), format!(r"^\s*[Mm]\+?0*3(?:\.0*)?(?:\s*[Ss](?:#|{NUMBER})){{0,1}}\s*$"));
        let both = format!(r"(?=.*[Zz])(?=.*[Ff])(?:\s*[ZFzf]{NUMBER}){{2,2}}");
        assert_eq!(of("G1"), format!(r"^\s*[Gg]\+?0*1(?:\.0*)?{both}\s*$"));
    }
}
