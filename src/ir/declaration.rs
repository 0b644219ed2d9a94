//! Declared deviations: everything a program does that is not in the drawing because it is unavoidable.
//!
//! A compile declares each deviation that it chose. The verifier measures the program and compares its findings with these
//! declarations, and the declarations with bounds of its own.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::geom::Point;
use crate::units::number::fixed;

/// A deviation from the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declaration {
    /// Kind of deviation.
    pub kind: Kind,
    /// Index of its cut among the cuts of the marker, from 0.
    pub cut: u32,
    /// Start of the affected stretch, mm from the start of the cut as drawn.
    pub from_mm: f64,
    /// End of the affected stretch, as `from_mm`; may be less than `from_mm` on a closed cut.
    pub to_mm: f64,
    /// End of the cut stretch at which it occurs; `None` when it is not at an end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<Which>,
    /// Part in which it occurs: index of the piece in the marker, from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<u32>,
    /// Magnitude, mm, as defined by the kind.
    pub magnitude_mm: f64,
    /// Place on the cloth at which it is greatest, for a swing that of the tip: X and Y, mm. For people only, as are the fields
    /// below: the verifier judges by the stretch.
    #[serde(default)]
    pub at_mm: [f64; 2],
    /// Magnitude of a swing in the planned motion, mm: less than at the bend as drawn, which smoothing rounds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seen_mm: Option<f64>,
    /// Part in which the end of the blade then is: index of the piece in the marker, from 0; `None` in the waste.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<u32>,
}

impl Declaration {
    /// Size of the deviation as people are told it, mm.
    pub fn size_mm(&self) -> f64 {
        self.seen_mm.unwrap_or(self.magnitude_mm)
    }
}

/// Kind of a deviation; it defines the meaning of the magnitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// An overlap that lies in a part, as the profile requires. Magnitude: maximum depth.
    Overcut,
    /// An overlap that is shorter than the profile requires. Magnitude: missing length.
    Shortened,
    /// A plunge on a curve. Magnitude: distance between blade and line.
    Plunge,
    /// A plunge cut longer than its line, without room. Magnitude: depth of the excess in a part.
    Surplus,
    /// The body of the blade on a curve tighter than the blade, or at a bend without a lift. Magnitude: distance from the line.
    Swing,
    /// A plunge in the middle of a line after which the tip moves no farther than smoothing may move it. Magnitude: length of
    /// its cut.
    Nibbled,
    /// A plunge or a lift where the drawing has no end. Magnitude: 0.
    Lift,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 7] =
        [Self::Overcut, Self::Shortened, Self::Plunge, Self::Surplus, Self::Swing, Self::Nibbled, Self::Lift];

    /// Name of the kind in words, singular and plural.
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

impl Kind {
    /// True if the blade leaves the drawn line, by the size of the deviation.
    pub fn is_off(self) -> bool {
        match self {
            Self::Overcut | Self::Plunge | Self::Surplus | Self::Swing => true,
            Self::Shortened | Self::Nibbled | Self::Lift => false,
        }
    }

    /// Unit of the size, with what that is where the blade is not off its line.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Nibbled => "mm long",
            Self::Shortened => "mm too short",
            Self::Overcut | Self::Plunge | Self::Surplus | Self::Swing | Self::Lift => "mm",
        }
    }

    /// Meaning of the kind and of its size, in a sentence for people.
    pub fn about(self) -> &'static str {
        match self {
            Self::Overcut => {
                "the blade goes past an inner corner into the part, as the profile asks; the size is how far."
            }
            Self::Shortened => {
                "the blade goes less far past an end than the profile asks, because a part is in the way; the size is what \
                 is missing."
            }
            Self::Plunge => "the straight blade goes down on a curve; the size is how far it stands beside the line.",
            Self::Surplus => "the blade is longer than a short cut; the size is how deep its end goes into the part.",
            Self::Swing => "the heel leaves the line behind a bend; the size is how far.",
            Self::Nibbled => {
                "a tight curve is cut by plunges without motion; the size is the length of one, not how far it is off."
            }
            Self::Lift => "the knife is lifted and goes down again where the drawing has no end.",
        }
    }
}

/// Summary of all declarations of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Total {
    /// The kind.
    pub kind: Kind,
    /// Number of declarations.
    pub count: usize,
    /// Number of pieces with such a declaration.
    pub pieces: usize,
    /// Greatest magnitude, mm, as defined by the kind.
    pub worst_mm: f64,
    /// Number of the piece with the greatest magnitude.
    pub piece: u32,
    /// Copy of the marker with the greatest magnitude, from 1; 0, and omitted, when there is only one copy.
    #[serde(skip_serializing_if = "is_only")]
    pub copy: u32,
    /// Place of the greatest magnitude on the cloth: X and Y, mm.
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
    /// The plunge.
    Start,
    /// The lift.
    End,
}

impl Which {
    /// The first or the last point of a path.
    pub fn of(self, path: &[Point]) -> Point {
        match self {
            Self::Start => path[0],
            Self::End => path[path.len() - 1],
        }
    }

    /// The other end.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Start => Self::End,
            Self::End => Self::Start,
        }
    }
}
