//! Notches that are omitted or cut differently from the file; each kind is reported once, with its pieces.

use std::collections::BTreeMap;

use crate::diagnostic::{Code, Diagnostic, Diagnostics, code, pieces};
use crate::ir::marker::Notch;
use crate::machine::patterns::Dxf;
use crate::source::Span;
use crate::units::number::fixed;

/// Decimals of lengths in messages, mm.
const DECIMALS: u32 = 1;

/// Reason for omitting a notch or cutting it differently from the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reason {
    /// Too far from all outlines.
    OffEdge,
    /// Deeper than the maximum of notches.
    TooDeep,
    /// Deeper than the part at that position.
    LeavesPart,
    /// In the mouth of another notch, or at the position of one of another kind.
    InAnother,
    /// Drawn in the outline itself.
    Drawn,
    /// Cut into the part although its angle points outwards.
    Turned,
    /// Cut as a slit: too narrow, too wide, too flat, at a corner, beside another, or with a crossbar that leaves the part.
    AsSlit,
}

/// A notch that is not cut as in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Doubt {
    pub(super) reason: Reason,
    /// Distance from the edge for [`Reason::OffEdge`], otherwise the depth of the notch, mm.
    pub(super) mm: f64,
    pub(super) span: Span,
}

impl Doubt {
    /// True if the notch is omitted.
    pub(super) fn leaves_out(&self) -> bool {
        match self.reason {
            Reason::OffEdge | Reason::TooDeep | Reason::LeavesPart | Reason::InAnother | Reason::Drawn => true,
            Reason::AsSlit | Reason::Turned => false,
        }
    }
}

/// Reports the doubts about notches, given with the numbers of their pieces; each kind once.
pub(super) fn say<'a>(doubts: impl Iterator<Item = (&'a Doubt, &'a [u32])>, out: &mut Diagnostics) {
    let mut kinds: BTreeMap<Reason, (Vec<&Doubt>, Vec<u32>)> = BTreeMap::new();
    for (doubt, numbers) in doubts {
        let (of_kind, of_pieces) = kinds.entry(doubt.reason).or_default();
        of_kind.push(doubt);
        of_pieces.extend(numbers);
    }
    for (reason, (doubts, mut numbers)) in kinds {
        numbers.sort_unstable();
        numbers.dedup();
        let worst = doubts.iter().map(|doubt| doubt.mm).fold(0.0, f64::max);
        let (notches, one) = match doubts.len() {
            1 => (format!("a notch of {}", pieces::listed(&numbers)), true),
            count => (format!("{count} notches of {}", pieces::listed(&numbers)), false),
        };
        let Words { code, message, hint } = words(reason, &notches, &fixed(worst, DECIMALS), one);
        out.push(Diagnostic::new(code, message).at(doubts[0].span).about(numbers).hint(hint));
    }
}

/// Wording of a doubt.
struct Words {
    code: &'static Code,
    message: String,
    hint: &'static str,
}

fn words(reason: Reason, notches: &str, mm: &str, is_one: bool) -> Words {
    let verb = |one, several| if is_one { one } else { several };
    let (code, message, hint) = match reason {
        Reason::OffEdge => (
            &code::DXF_NOTCH_LEFT_OUT,
            format!(
                "{notches} {} {mm} mm from the outline, more than {} mm: not cut",
                verb("lies", "lie up to"),
                Dxf::NOTCH_OFF
            ),
            "it may mark a seam line: cut it by hand if it is missing",
        ),
        Reason::TooDeep => (
            &code::DXF_NOTCH_LEFT_OUT,
            format!("{notches} {} {mm} mm deep, more than {} mm: not cut", verb("is", "are up to"), Notch::LONGEST),
            "look at the depth (group 30) and at the unit of the file",
        ),
        Reason::LeavesPart => (
            &code::DXF_NOTCH_LEFT_OUT,
            format!("{notches} {} {mm} mm deep and would leave the part: not cut", verb("is", "are up to")),
            "look at the depth (group 30) and at the place of the notch",
        ),
        Reason::InAnother => (
            &code::DXF_NOTCH_LEFT_OUT,
            format!(
                "{notches} {}: not cut",
                verb("lies in the mouth of another one or at its place", "lie in mouths of others or at their places")
            ),
            "one of both is enough: see which in the picture (-t svg)",
        ),
        Reason::Drawn => (
            &code::DXF_NOTCH_DRAWN,
            format!("{notches} {} drawn in the outline, too: cut once, as drawn", verb("is", "are")),
            "look at them in the picture (-t svg)",
        ),
        Reason::Turned => (
            &code::DXF_NOTCH_TURNED,
            format!(
                "{} of {notches} {} out of the part: cut inwards",
                verb("the angle", "the angles"),
                verb("leads", "lead")
            ),
            "a notch that stands out of the edge has to be drawn in the outline",
        ),
        Reason::AsSlit => (
            &code::DXF_NOTCH_AS_SLIT,
            format!(
                "{notches} {}: cut {}",
                verb(
                    "is too small or wide, at a corner or beside another",
                    "are too small or wide, at corners or beside others"
                ),
                verb("as a slit", "as slits")
            ),
            "a slit marks the same place",
        ),
    };
    Words { code, message, hint }
}
