//! What a program does beside the drawing because it cannot do otherwise, as it says itself.
//!
//! A compile declares each deviation that it chose; the verifier measures the program and holds what it finds against
//! these, and these against bounds of its own.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::units::number::fixed;

/// A deviation from the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declaration {
    /// What it is.
    pub kind: Kind,
    /// The cut that it is of: its place among the cuts of the marker, from 0.
    pub cut: u32,
    /// From where to where along that cut, mm from its start as it is drawn.
    pub from_mm: f64,
    /// See `from_mm`; on a closed cut it may be the lesser of both.
    pub to_mm: f64,
    /// The end of the cut stretch that it is at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<Which>,
    /// The part that it is in: the place of the piece in the marker, from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<u32>,
    /// How much it is, mm; what that measures is said by the kind.
    pub magnitude_mm: f64,
}

/// What a deviation is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// An overlap that lies in a part, as the profile asks: how deep at the most.
    Overcut,
    /// An overlap that is shorter than the profile asks for: by how much.
    Shortened,
    /// A plunge on a curve: how far blade and line are apart.
    Plunge,
    /// A plunge cut that is longer than its line and has no room: how deep the rest lies in a part.
    Surplus,
    /// The body of the blade on a curve that is tighter than it, or at a bend without a lift: how far it leaves the line.
    Swing,
    /// A plunge amid a line whose tip then moves no farther than smoothing may move it: the length of its cut.
    Nibbled,
    /// A plunge or a lift where the drawing has no end: nothing.
    Lift,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 7] =
        [Self::Overcut, Self::Shortened, Self::Plunge, Self::Surplus, Self::Swing, Self::Nibbled, Self::Lift];

    /// What one is, and what many are, in words.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Overcut => ["overlap into a part", "overlaps into parts"],
            Self::Shortened => ["shortened overlap", "shortened overlaps"],
            Self::Plunge => ["plunge on a curve", "plunges on curves"],
            Self::Surplus => ["end of a plunge cut in a part", "ends of plunge cuts in parts"],
            Self::Swing => ["swing at a bend", "swings at bends"],
            Self::Nibbled => ["plunge amid a line", "plunges amid lines"],
            Self::Lift => ["end amid a line", "ends amid lines"],
        }
    }
}

/// All declarations of a kind, summed up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Total {
    /// The kind.
    pub kind: Kind,
    /// How many there are.
    pub count: usize,
    /// Of how many pieces.
    pub pieces: usize,
    /// The greatest of them, mm; what it measures is said by the kind.
    pub worst_mm: f64,
    /// The number of the piece that this is of.
    pub piece: u32,
    /// The copy of the marker that this is of, from 1; 0, and not there, where there is but one.
    #[serde(skip_serializing_if = "is_only")]
    pub copy: u32,
    /// Where it begins, mm.
    pub at_mm: [f64; 2],
}

impl fmt::Display for Total {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { kind, count, pieces, worst_mm, piece, copy, at_mm: [x, y] } = *self;
        let [one, many] = kind.words();
        write!(f, "{count} {}", if count == 1 { one } else { many })?;
        if count > 1 {
            write!(f, " on {pieces} piece{}", if pieces == 1 { "" } else { "s" })?;
        }
        if worst_mm == 0.0 {
            return Ok(());
        }
        let copy = if is_only(&copy) { String::new() } else { format!(" of copy {copy}") };
        write!(f, ", at most {} mm (piece {piece}{copy} at {}, {})", fixed(worst_mm, 2), fixed(x, 0), fixed(y, 0))
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands fields over by reference")]
fn is_only(copy: &u32) -> bool {
    *copy == 0
}

/// An end of a stretch that is cut in one go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Which {
    /// Where it is plunged.
    Start,
    /// Where it is lifted.
    End,
}

impl Which {
    /// The other end.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Start => Self::End,
            Self::End => Self::Start,
        }
    }
}
