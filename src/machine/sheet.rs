//! Placement of the marker on the table: the keys `sheet.*`.
//!
//! The marker is turned first; all other keys refer to X and Y of the table, along the cloth and across it. The lower left
//! corner of its box stays where the file has it, unless `origin` moves it.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::AffineMap;
use super::key::{Key, Takes, from};
use super::word::{Corner, OrWord, Word as _, words};
use crate::units::number::exact;

/// Quarter turn, degrees.
const QUARTER: f64 = 90.0;
/// Greatest number of copies of a marker: no table is longer.
pub const COPIES_MAX: u32 = 1000;

/// The keys `sheet.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "sheet.origin", takes: Takes::PointOr(Corner::WORD), about: "How far the marker is moved along X and Y of the table, mm, from where the file has it; \"corner\" =\nits lower left corner lies in that of the table, as far from its edges as the blade may reach\nbeyond a line (knife.width_mm and an overlap), or in their middle where there is less room." },
    Key { name: "sheet.mirror", takes: Takes::Word(words::<Mirror>), about: "\"ends\" = mirrored along the cloth: the end at small X comes to large X, its sides stay." },
    Key { name: "sheet.flip", takes: Takes::Word(words::<Flip>), about: "\"sides\" = mirrored across the cloth, as a marker that is laid face down: the side at small Y\ncomes to large Y, its ends stay." },
    Key { name: "sheet.rotate_deg", takes: Takes::Number(from(-360.0, 360.0)), about: "The marker is turned by that, counter-clockwise, before all else." },
    Key { name: "sheet.scale_x", takes: Takes::Number(from(0.8, 1.2)), about: "The marker becomes longer along the cloth by this factor: 1.03 where it shrinks by 3 percent." },
    Key { name: "sheet.scale_y", takes: Takes::Number(from(0.8, 1.2)), about: "The same across the cloth." },
    Key { name: "sheet.copies", takes: Takes::Count(COPIES_MAX), about: "The marker is cut so many times, one behind the other along the cloth." },
    Key { name: "sheet.copies_gap_mm", takes: Takes::Number(from(0.0, 10_000.0)), about: "From the end of one copy to the beginning of the next." },
];

/// Placement of the marker on the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sheet {
    /// Position of the origin of the file; `None` = the corner of the marker is in that of the table, with room for the reach
    /// of the blade beyond its lines.
    #[serde(with = "OrWord::<Corner>")]
    pub origin: Option<[f64; 2]>,
    /// Exchange of its ends.
    pub mirror: Mirror,
    /// Exchange of its sides.
    pub flip: Flip,
    /// Rotation, counter-clockwise.
    pub rotate_deg: f64,
    /// Scale factor along the cloth.
    pub scale_x: f64,
    /// Scale factor across the cloth.
    pub scale_y: f64,
    /// Number of copies.
    pub copies: u32,
    /// Distance from one copy to the next.
    pub copies_gap_mm: f64,
}

/// Exchange of the ends of the marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mirror {
    /// Ends unchanged.
    #[default]
    Off,
    /// Ends exchanged.
    Ends,
}

/// Exchange of the sides of the marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flip {
    /// Sides unchanged.
    #[default]
    Off,
    /// Sides exchanged.
    Sides,
}

impl Default for Sheet {
    fn default() -> Self {
        Self {
            origin: Some([0.0; 2]),
            mirror: Mirror::Off,
            flip: Flip::Off,
            rotate_deg: 0.0,
            scale_x: 1.0,
            scale_y: 1.0,
            copies: 1,
            copies_gap_mm: 0.0,
        }
    }
}

impl Sheet {
    /// True if the marker is placed once, as it is in the file.
    pub fn is_plain(&self) -> bool {
        Self { copies_gap_mm: 0.0, ..self.clone() } == Self::default()
    }

    /// True if X of the cloth equals that of the file except for an offset, and there is one copy, so that conveyor commands of
    /// the file find the cloth where they expect it.
    pub fn keeps_length(&self) -> bool {
        let Self { origin: _, mirror, flip: _, rotate_deg, scale_x, scale_y: _, copies, copies_gap_mm: _ } = *self;
        mirror == Mirror::Off && rotate_deg.rem_euclid(360.0) == 0.0 && scale_x == 1.0 && copies == 1
    }

    /// True if it shows the other side of the parts.
    pub fn is_mirrored(&self) -> bool {
        (self.mirror == Mirror::Ends) != (self.flip == Flip::Sides)
    }

    /// Placement about the origin of the file: turned, then mirrored and scaled along X and Y of the table.
    pub fn turned(&self) -> AffineMap {
        // Quarter turns are exact, so that edges along an axis stay so.
        let (sin, cos) = match (self.rotate_deg / QUARTER).rem_euclid(4.0) {
            0.0 => (0.0, 1.0),
            1.0 => (1.0, 0.0),
            2.0 => (0.0, -1.0),
            3.0 => (-1.0, 0.0),
            _ => self.rotate_deg.to_radians().sin_cos(),
        };
        let along = match self.mirror {
            Mirror::Off => self.scale_x,
            Mirror::Ends => -self.scale_x,
        };
        let across = match self.flip {
            Flip::Off => self.scale_y,
            Flip::Sides => -self.scale_y,
        };
        AffineMap { axes: [[along * cos, across * sin], [-along * sin, across * cos]], by: [0.0; 2] }
    }

    /// Greatest scale factor: the rounding of the file grows with the marker.
    pub fn growth(&self) -> f64 {
        self.scale_x.max(self.scale_y)
    }
}

/// Text for a report.
impl fmt::Display for Sheet {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut told = Vec::new();
        if self.rotate_deg != 0.0 {
            told.push(format!("turned by {} degrees", exact(self.rotate_deg)));
        }
        match self.mirror {
            Mirror::Off => {}
            Mirror::Ends => told.push("ends mirrored".to_owned()),
        }
        match self.flip {
            Flip::Off => {}
            Flip::Sides => told.push("sides flipped".to_owned()),
        }
        if (self.scale_x, self.scale_y) != (1.0, 1.0) {
            told.push(format!("scaled by {} x {}", exact(self.scale_x), exact(self.scale_y)));
        }
        match self.origin {
            None => told.push("in the corner of the table".to_owned()),
            Some([0.0, 0.0]) => {}
            Some([x, y]) => told.push(format!("moved by {}, {} mm", exact(x), exact(y))),
        }
        if self.copies > 1 {
            told.push(format!("{} copies, {} mm apart", self.copies, exact(self.copies_gap_mm)));
        }
        f.write_str(&told.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_tells_what_it_does_and_nothing_else() {
        let plain = Sheet { copies_gap_mm: 5.0, ..Sheet::default() };
        assert!(plain.is_plain() && plain.to_string().is_empty());
        let sheet = Sheet { origin: Some([10.0, 2.5]), mirror: Mirror::Ends, scale_x: 1.03, copies: 3, ..plain };
        let told = "ends mirrored, scaled by 1.03 x 1, moved by 10, 2.5 mm, 3 copies, 5 mm apart";
        assert_eq!(sheet.to_string(), told);
        assert!(!sheet.is_plain() && sheet.is_mirrored());
        assert!(!Sheet { flip: Flip::Sides, ..sheet }.is_mirrored());
    }
}
