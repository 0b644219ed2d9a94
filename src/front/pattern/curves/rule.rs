//! Rules by which CAD systems lay curves through the curve points of their patterns.

use super::leg::Stretch;
use super::spline::Ends;
use super::{gerber, spline};
use crate::geom::Point;

/// Kind of curve through points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    /// Repeated division of chords, with the middles moved according to bisector tangents.
    Bisectors,
    /// A cubic spline parametrised by chord length.
    Spline(Ends),
}

/// A CAD system, recognised by a word in the author texts of a file, and its rule.
struct Row {
    word: &'static str,
    /// Name in messages.
    name: &'static str,
    rule: Rule,
}

#[rustfmt::skip] // a table: one row per word
const ROWS: [Row; 7] = [
    Row { word: "ACCUMARK", name: "Gerber AccuMark", rule: Rule::Bisectors },
    Row { word: "GERBER", name: "Gerber AccuMark", rule: Rule::Bisectors },
    Row { word: "RICHPEACE", name: "Richpeace", rule: Rule::Spline(Ends::Parabolic) },
    Row { word: "RPCAD", name: "Richpeace", rule: Rule::Spline(Ends::Parabolic) },
    Row { word: "CLO", name: "CLO", rule: Rule::Spline(Ends::Natural) },
    Row { word: "CLO3D", name: "CLO", rule: Rule::Spline(Ends::Natural) },
    Row { word: "MARVELOUS", name: "CLO", rule: Rule::Spline(Ends::Natural) },
];

/// Rule for files of unknown systems.
const UNKNOWN: Rule = Rule::Spline(Ends::Natural);

/// The rule for files of an author, and the name of the CAD system if it is known.
pub(super) fn rule_of(author: &str) -> (Rule, Option<&'static str>) {
    let author = author.to_uppercase();
    let is_there = |word: &str| author.split(|letter: char| !letter.is_alphanumeric()).any(|found| found == word);
    let known =
        ROWS.iter().find(|row| is_there(row.word) || row.word.len() > "CLO3D".len() && author.contains(row.word));
    known.map_or((UNKNOWN, None), |row| (row.rule, Some(row.name)))
}

impl Rule {
    /// Points of the curve between consecutive knots; `None` beyond `most` points.
    pub(super) fn spans(self, knots: &[Point], sagitta: f64, most: usize) -> Option<Vec<Stretch>> {
        match self {
            Self::Bisectors => gerber::spans(knots, sagitta, most),
            Self::Spline(ends) => spline::spans(knots, ends, sagitta, most),
        }
    }

    /// True if the system adds vertices for notches that do not belong to its curve.
    pub(super) fn may_pass_notches(self) -> bool {
        self == Self::Bisectors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_is_known_by_a_word_of_its_author() {
        let name = |author| rule_of(author).1;
        assert_eq!(name("Gerber Technology AccuMark V10.0.1"), Some("Gerber AccuMark"));
        assert_eq!(name("AccuMark10"), Some("Gerber AccuMark"));
        assert_eq!(name("RichPeace CAD V8"), Some("Richpeace"));
        assert_eq!([name("CLO Standalone 7.0"), name("clo3d")], [Some("CLO"), Some("CLO")]);
        assert_eq!([name("Cloth & Co"), name("")], [None, None]);
    }
}
