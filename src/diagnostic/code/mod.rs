//! Every code that a diagnostic can carry: a stable name, its severity, and its meaning.
//! The first word is the stage. Names never change once released: scripts filter by them.

mod files;
mod knife;
mod machines;
mod shapes;

pub use super::kind::Code;
pub use super::telling::{Fault, Harm, Severity, Telling};
pub use files::*;
pub use knife::*;
pub use machines::*;
pub use shapes::*;

/// Every code, in the order of the manual.
pub fn all() -> impl Iterator<Item = &'static Code> {
    [files::CODES, shapes::CODES, knife::CODES, machines::CODES].into_iter().flatten().copied()
}

/// The code of that name.
pub fn find(name: &str) -> Option<&'static Code> {
    all().find(|code| code.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_a_name_and_a_meaning_of_its_own() {
        for (i, code) in all().enumerate() {
            assert!(all().take(i).all(|other| other.name != code.name), "{} stands twice", code.name);
            let is_kebab = code.name.chars().all(|c| matches!(c, 'a'..='z' | '0'..='9' | '-' | '/'));
            assert!(is_kebab && code.name.matches('/').count() == 1 && code.about.ends_with('.'), "{}", code.name);
        }
    }
}
