//! Codes that stand where they cannot: a character of a place was changed into a letter.

use super::meaning::{Meaning, meaning, name};
use super::syntax::{Code, Words};
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// The fault of a block with a point and codes behind it. `is_down` tells whether the knife is down before the block, and
/// `obeys` whether the profile obeys a code.
pub(super) fn behind_place(
    words: &Words,
    is_down: bool,
    span: Span,
    obeys: impl Fn(Code) -> bool,
) -> Option<Diagnostic> {
    words.point?;
    let behind = || words.codes[words.ahead..].iter().copied().filter(|&code| obeys(code));
    // Some controllers move before they lower or lift the knife, others do not.
    let changes = if is_down { Meaning::Up } else { Meaning::Down };
    if let Some(code) = behind().find(|&code| meaning(code) == changes) {
        let message = format!("{} stands behind the place of its block: before or after the move?", name(code));
        let finding = Diagnostic::new(&code::ISO_KNIFE_IN_MOVE, message).at(span);
        return Some(finding.hint("let the CAD write the move and the knife code as two blocks"));
    }
    let cuts = words.codes[..words.ahead].iter().fold(is_down, |is_down, &code| match meaning(code) {
        Meaning::Down => true,
        Meaning::Up => false,
        _ => is_down,
    });
    let code = behind().find(|code| match code.letter {
        b'H' | b'N' => true,
        // Radii stand behind the end of an arc; holes and parking are judged by themselves.
        b'M' | b'G' | b'D' | b'F' | b'R' => false,
        // Post-processors of machine tools write spindle speeds, tools, dwells and a third centre beside a place.
        b'S' | b'T' | b'P' | b'K' if code.number.is_some() => false,
        _ => cuts && !matches!(meaning(*code), Meaning::Park | Meaning::BiteSize),
    })?;
    let message = format!("{} stands behind the place of a block, where it has no meaning", name(code));
    Some(fault(message, "a digit, X, Y or `*`", code, span))
}

/// The fault of a block whose code parks the knife, or gives a size, while it cuts. `has_point` tells whether the block has a
/// point.
pub(super) fn amid_cut(code: Code, has_point: bool, span: Span) -> Diagnostic {
    let name = name(code);
    if has_point {
        let message = format!("{name} stands amid a cut, and the knife would miss a place");
        fault(message, "a digit, X, Y or `*`", code, span)
    } else {
        fault(format!("{name} stands amid a cut, where it has no meaning"), "X, Y or another code", code, span)
    }
}

/// The fault of a code that something else may have become. The profile can switch known codes off; without H and N the numbers
/// of files and pieces would be lost.
fn fault(message: String, origin: &str, code: Code, span: Span) -> Diagnostic {
    let finding = Diagnostic::new(&code::ISO_MISPLACED, message).at(span);
    let name = name(code);
    if meaning(code) == Meaning::Unknown || matches!(code.letter, b'H' | b'N') {
        finding.hint(format!("{origin} may have become {name}; transfer the file again"))
    } else {
        finding.hint(format!("{origin} may have become {name}: transfer it again, or set `codes.{name} = \"ignore\"`"))
    }
}

/// Numbers of the unit codes G70, G71 and G91.
const UNITS: [f64; 3] = [70.0, 71.0, 91.0];

/// Position in a job: H, the number of the file, stands in its head.
#[derive(Debug, Default)]
pub(super) struct Head {
    has_number: bool,
    is_past: bool,
}

impl Head {
    /// The finding on H amid the pieces, or on a second one with the number of a unit.
    pub(super) fn see(&mut self, code: Code, span: Span) -> Option<Diagnostic> {
        let is_unit = self.has_number && code.number.is_some_and(|number| UNITS.contains(&number));
        self.has_number = true;
        if !is_unit && !self.is_past {
            return None;
        }
        let place = if is_unit { "a second time" } else { "amid the pieces" };
        let number = code.number.map(|number| number.to_string()).unwrap_or_default();
        let message = format!("H{number}, a number of the file, stands {place}");
        let finding = Diagnostic::new(&code::ISO_FILE_NUMBER, message).at(span);
        let letter = if is_unit { 'G' } else { 'M' };
        Some(finding.hint(format!("it may be {letter}{number} with a changed letter; transfer the file again")))
    }

    /// Records a piece, a cut or a hole: the head is past.
    pub(super) fn pass(&mut self) {
        self.is_past = true;
    }

    /// Records the end of a job: another head may follow.
    pub(super) fn end(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::machine::profile::CodeUse;
    use crate::source::Source;

    /// Checks the codes of the findings on a file with a whole piece behind `blocks`.
    fn check(blocks: &str, expected: &[&str]) {
        let file = format!("H1*G71*N1*X0Y0*M14*X1000Y0*{blocks}X1000Y1000*X0Y1000*X0Y0*M15*M0*");
        let source = Source::new("a", file.clone().into_bytes()).expect("small");
        let mut out = Diagnostics::default();
        crate::front::iso::lower::lower(&source, &Job::default(), &mut out);
        let names = out.iter().map(|finding| finding.code.name);
        let found: Vec<&str> = names.filter(|name| *name != "iso/unknown-code").collect();
        assert_eq!(found, expected, "{file}");
    }

    #[test]
    fn letters_in_the_places_of_a_cut_are_told() {
        for letter in ["H", "N", "L", "O", "E", "Q", "Z", "U", "B", "C"] {
            check(&format!("X1000Y3{letter}00*"), &["iso/misplaced-code"]);
        }
        check("QX1000Y500*", &["iso/misplaced-code"]);
        check("Z1000Y500*", &["iso/misplaced-code"]);
        check("X1000Y500Q*", &["iso/misplaced-code"]);
        check("Q*X1000Y500*", &["iso/misplaced-code"]);
        check("H43*", &["iso/file-number"]);
    }

    #[test]
    fn the_profile_switches_off_codes_amid_a_cut() {
        let file = "H1*G71*X0Y0*M14*X900Y0*QX900Y500*Q*X0Y900*X0Y0*M15*M0*";
        let source = Source::new("a", file.as_bytes().to_vec()).expect("small");
        let (mut job, mut out) = (Job::default(), Diagnostics::default());
        crate::front::iso::lower::lower(&source, &job, &mut out);
        let told: Vec<_> = out.iter().filter(|finding| finding.code.name == "iso/misplaced-code").collect();
        assert_eq!(told.len(), 2);
        assert!(told.iter().all(|finding| finding.hints.iter().any(|hint| hint.contains("codes.Q"))));
        job.profile.codes.insert("Q".to_owned(), CodeUse::Ignore);
        out = Diagnostics::default();
        crate::front::iso::lower::lower(&source, &job, &mut out);
        assert!(!out.has_errors());
    }

    #[test]
    fn codes_of_real_files_may_stand_beside_a_place() {
        for sound in [
            "X1000Y500M26*",
            "G01X1000Y500F300*",
            "X1000Y500D1*",
            "L*X1000Y500*O*",
            "G03X1000Y500R400*G01*",
            "G01X1000Y500S100T1*",
        ] {
            check(sound, &[]);
        }
    }
}
