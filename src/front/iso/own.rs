//! Numbers of an unknown code, of an origin or of a dwell, which stand in its block as X, Y or F and are no place and no speed.

use super::meaning::{Meaning, meaning, name};
use super::syntax::{Code, Words};
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// Number of the code that is an origin in cut files and a dwell in most controllers of machine tools.
const DWELL: f64 = 4.0;
/// Number of the code that sets the origin in controllers of machine tools.
const NEW_ORIGIN: f64 = 92.0;

/// Removes the numbers that belong to a code of the block, and the code. Returns the fault if the profile does not ignore the
/// code. `is_head` tells that the file has no place yet: the first place is one, whatever stands before it.
pub(super) fn take(words: &mut Words, is_head: bool, span: Span, obeys: impl Fn(Code) -> bool) -> Option<Diagnostic> {
    let has_place = words.point.is_some_and(|point| point.x.is_some() || point.y.is_some());
    let owner = words.codes.iter().zip(0..).find(|&(&code, at)| owns(code, at < words.ahead && has_place));
    let (&owner, _) = owner?;
    let is_dwell = is_dwell(owner);
    // The time of a dwell is no speed, even at the head of the file.
    let has_time = is_dwell && words.codes.iter().any(|code| code.letter == b'F');
    let is_ignored = !obeys(owner);
    let is_refused = !is_ignored && (has_time || has_place && !is_head);
    if is_dwell {
        retain(words, |code| !matches!(code.letter, b'F' | b'P'));
    }
    if is_ignored || is_refused {
        words.point = None;
    }
    if !is_refused {
        return None;
    }
    retain(words, |code| code != owner);
    let name = name(owner);
    let message = match meaning(owner) {
        _ if is_dwell => {
            format!("{name} with X, Y or F is a dwell in most controllers, and no place")
        }
        Meaning::Origin => format!("{name} with X or Y sets an origin amid the file, which is not obeyed"),
        _ if is_new_origin(owner) => format!("{name} with X or Y sets a new origin, which is not obeyed"),
        _ => format!("{name} is not known, and X or Y behind it may be its own numbers"),
    };
    let finding = Diagnostic::new(&code::ISO_OWN_NUMBERS, message).at(span);
    Some(match meaning(owner) {
        Meaning::Origin => {
            finding.hint(format!("`codes.{name} = \"ignore\"` skips it with its numbers, if it is a dwell"))
        }
        _ if is_new_origin(owner) => finding.hint("let the CAD write all places from one origin"),
        _ => finding.hint(format!("leave {name} out, or write X and Y as a block of their own if they are a place")),
    })
}

/// True if X and Y of its block may belong to a code. `is_before_place` tells that the block has a place behind the code.
fn owns(code: Code, is_before_place: bool) -> bool {
    match meaning(code) {
        Meaning::Origin => true,
        // Post-processors write spindle speeds, tools, dwells, a third centre and radii before a place, too.
        Meaning::Unknown => is_before_place && !matches!(code.letter, b'S' | b'T' | b'P' | b'K' | b'R'),
        _ => false,
    }
}

fn is_dwell(code: Code) -> bool {
    code.letter == b'G' && code.number == Some(DWELL)
}

fn is_new_origin(code: Code) -> bool {
    code.letter == b'G' && code.number == Some(NEW_ORIGIN)
}

/// Removes the codes that are not `kept`.
fn retain(words: &mut Words, kept: impl Fn(Code) -> bool) {
    words.ahead = words.codes[..words.ahead].iter().filter(|&&code| kept(code)).count();
    words.codes.retain(|&mut code| kept(code));
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::machine::profile::CodeUse;
    use crate::source::Source;

    /// Checks the findings on a square with a block amid its cut, and the number of its places if it has no error.
    fn check(block: &str, ignored: &[&str], expected: &[&str]) {
        let file = format!("H1*G71*N1*X0Y0*M14*X1000Y0*{block}*X1000Y1000*X0Y1000*X0Y0*M15*M0*");
        let source = Source::new("a", file.into_bytes()).expect("small");
        let (mut job, mut out) = (Job::default(), Diagnostics::default());
        job.profile.codes.extend(ignored.iter().map(|&name| (name.to_owned(), CodeUse::Ignore)));
        let marker = crate::front::iso::lower::lower(&source, &job, &mut out);
        let found: Vec<&str> = out.iter().map(|finding| finding.code.name).collect();
        assert_eq!(found, expected, "{block}");
        assert_eq!(marker.extent().size(), (100.0, 100.0), "{block}");
        assert_eq!(marker.pieces[0].feed, None, "{block}");
    }

    #[test]
    fn numbers_of_a_code_are_no_place_and_no_speed() {
        for block in ["M99X500Y500", "G92X0Y0", "G04X50", "G4F2", "X500G04", "M70X5Y5", "U1000Y500"] {
            check(block, &[], &["iso/numbers-of-a-code"]);
        }
        check("G04P500", &[], &["iso/ignored-code"]);
        for block in ["G04X50", "G4F2", "G04P500", "G04X9000F2"] {
            check(block, &["G4"], &[]);
        }
        check("M70X5Y5", &["M70"], &[]);
    }

    #[test]
    fn other_codes_stand_beside_a_place() {
        for block in ["M68X1000Y500", "S100T1X1000Y500", "G01X1000Y500"] {
            let file = format!("H1*G71*N1*X0Y0*M14*X1000Y0*{block}*X1000Y1000*X0Y1000*X0Y0*M15*M0*");
            let source = Source::new("a", file.into_bytes()).expect("small");
            let mut out = Diagnostics::default();
            crate::front::iso::lower::lower(&source, &Job::default(), &mut out);
            assert!(!out.has_errors(), "{block}");
        }
    }
}
