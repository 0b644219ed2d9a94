//! Machine profile as typed: the TOML keys, their defaults, and their values in base units.
//!
//! Fields carry the names of their keys, including the units; a method of the plain name returns mm, s and rad. The meaning and
//! the legal values of a key are in its row of `KEYS`, in the file of its section. The defaults follow a real cutter's
//! parameter table with a worn 6.6 mm knife.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::axes::{Axes, CAxis};
use super::bite::Bite;
pub use super::codes::CodeUse;
use super::common::{Common, CommonLines, Lines};
use super::counts::Counts;
use super::drawings::Drawings;
use super::drill::Drill;
use super::flow::Flow;
use super::gcode::Gcode;
use super::key::{Key, Takes};
use super::knife::Knife;
use super::labels::Labels;
use super::marks::Map;
use super::nest::Nest;
use super::notches::Notches;
use super::order::Order;
pub use super::path::Fit;
use super::path::{Corner, Path, Slow};
use super::patterns::Dxf;
use super::plot::Hpgl;
use super::sewing::Sewing;
use super::sheet::Sheet;
use super::table::Table;
use super::time::Time;
use super::tool::{Quintic, Tool};
use super::tracking::Tracking;
use super::verify::Verify;
use super::word::{OrWord, Stay, Word as _, words};
use crate::units::{MM_PER_INCH, rad};

/// Version of the profile format that this program reads and writes.
pub const PROFILE_VERSION: u32 = 1;

/// Top-level keys.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "version", takes: Takes::Whole(&[PROFILE_VERSION as i64]), about: "Version of this format." },
    Key { name: "units", takes: Takes::Word(words::<FileUnit>), about: "Unit of the coordinates in cut files. \"auto\" believes the file (G70, G71, G91); set it for a\nfile that is drawn in another unit than it says." },
    Key { name: "home", takes: Takes::Pose, about: "Where the axes stand when a program starts." },
    Key { name: "park", takes: Takes::PoseOr(Stay::WORD), about: "Where the axes go when a program ends; \"stay\" = they stay over the last cut." },
];

/// All properties of the machine and the cutting room on which a program depends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineProfile {
    /// Format version, [`PROFILE_VERSION`].
    pub version: u32,
    /// Unit of cut files.
    pub units: FileUnit,
    /// Pose at the start of a program: x mm, y mm, c degrees.
    pub home: [f64; 3],
    /// Pose at its end; `None` = the axes stay.
    #[serde(with = "OrWord::<Stay>")]
    pub park: Option<[f64; 3]>,
    /// Blade and its use.
    pub knife: Knife,
    /// Notches.
    pub notch: Notches,
    /// Distances between parts in a nest.
    pub nest: Nest,
    /// Edges that two parts have in common.
    pub common: Common,
    /// Order in which pieces are cut.
    pub order: Order,
    /// Placement of the marker on the table.
    pub sheet: Sheet,
    /// Required fit of registration marks.
    pub map: Map,
    /// Drill.
    pub drill: Drill,
    /// Criterion for a corner.
    pub corner: Corner,
    /// Slowdown before corners.
    pub slow: Slow,
    /// Accuracy with which the path is followed.
    pub path: Path,
    /// Limits of the axes.
    pub axes: Axes,
    /// Rotary axis.
    pub c: CAxis,
    /// Table.
    pub table: Table,
    /// Conveyor under the table.
    pub bite: Bite,
    /// Clock of the controller.
    pub time: Time,
    /// Encoders of the drives.
    pub counts: Counts,
    /// Controller that reads G-code.
    pub gcode: Gcode,
    /// Limits of the verifier.
    pub verify: Verify,
    /// Reading of drawings.
    pub drawing: Drawings,
    /// Reading of plots.
    pub hpgl: Hpgl,
    /// Reading of pattern DXF.
    pub dxf: Dxf,
    /// Texts of labels.
    pub labels: Labels,
    /// Pattern-sewing machine.
    pub sewing: Sewing,
    /// Carriage that follows a moving cloth.
    pub track: Tracking,
    /// Heads over a conveyor.
    pub flow: Flow,
    /// Tool that follows the lines.
    pub tool: Tool,
    /// Polynomials of the spray head.
    pub quintic: Quintic,
    /// Uses of codes of the cutter file by name, such as `M19`.
    pub codes: BTreeMap<String, CodeUse>,
}

/// Unit of the integers in a cut file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum FileUnit {
    /// Unit stated in the file.
    #[default]
    #[serde(rename = "auto")]
    Auto,
    /// A tenth of a millimetre (G71).
    #[serde(rename = "mm/10")]
    TenthMm,
    /// A hundredth of an inch (no code, G91).
    #[serde(rename = "in/100")]
    HundredthInch,
    /// A thousandth of an inch (G70).
    #[serde(rename = "in/1000")]
    ThousandthInch,
}

impl FileUnit {
    /// Length of the unit, mm; `None` if the file decides.
    pub fn mm(self) -> Option<f64> {
        match self {
            Self::Auto => None,
            Self::TenthMm => Some(0.1),
            Self::HundredthInch => Some(MM_PER_INCH / 100.0),
            Self::ThousandthInch => Some(MM_PER_INCH / 1000.0),
        }
    }
}

impl Default for MachineProfile {
    fn default() -> Self {
        Self {
            version: PROFILE_VERSION,
            units: FileUnit::Auto,
            home: [0.0; 3],
            park: None,
            knife: Knife::default(),
            notch: Notches::default(),
            nest: Nest::default(),
            common: Common::default(),
            order: Order::default(),
            sheet: Sheet::default(),
            map: Map::default(),
            drill: Drill::default(),
            corner: Corner::default(),
            slow: Slow::default(),
            path: Path::default(),
            axes: Axes::default(),
            c: CAxis::default(),
            table: Table::default(),
            bite: Bite::default(),
            time: Time::default(),
            counts: Counts::default(),
            gcode: Gcode::default(),
            verify: Verify::default(),
            drawing: Drawings::default(),
            hpgl: Hpgl::default(),
            dxf: Dxf::default(),
            labels: Labels::default(),
            sewing: Sewing::default(),
            track: Tracking::default(),
            flow: Flow::default(),
            tool: Tool::default(),
            quintic: Quintic::default(),
            codes: BTreeMap::new(),
        }
    }
}

/// Least tolerance of the automatic rule, mm.
const AUTO_TOLERANCE: f64 = 0.05;
/// Least band of the automatic rule, mm: too small to be noticed.
const AUTO_BAND: f64 = 0.2;
/// Extra distance within which two edges still merge, mm: the gap of many nests equals the band, and the rounding of a turned
/// one must not split its edges.
const BAND_EPSILON: f64 = 1e-9;
/// Greatest distance of a point from its rounded place, in units of the grid: half the diagonal of a cell.
const ROUNDING_REACH: f64 = 0.71;

impl MachineProfile {
    /// Least and greatest angle of the blade at which C is inside its range, rad; `None` = unbounded.
    pub fn blade_range(&self) -> Option<[f64; 2]> {
        self.c.range().map(|range| range.map(|end| end - self.knife.yaw()))
    }

    /// Least turn at which the knife is lifted, rad: that of `corner.angle_deg`, or less where the heel would swing out by more
    /// than `knife.max_swing_mm` behind the corner, w sin(a).
    pub fn corner_angle(&self) -> f64 {
        let swing = self.knife.max_swing_mm.filter(|&swing| swing < self.knife.width_mm);
        swing.map_or(f64::INFINITY, |swing| (swing / self.knife.width_mm).asin()).min(self.corner.angle())
    }

    /// Permitted deviation of the tip from the path, mm, for a file whose numbers are multiples of `unit` mm: at least the
    /// resolution of the file, because its vertices carry that much noise.
    pub fn tolerance(&self, unit: f64) -> f64 {
        self.path.tolerance_mm.unwrap_or_else(|| AUTO_TOLERANCE.max(ROUNDING_REACH * unit))
    }

    /// Distance within which edges of two parts are one edge, mm, for a file whose numbers are multiples of `unit` mm: each
    /// outline was rounded by itself, so that they may be a diagonal of the grid apart.
    pub fn band(&self, unit: f64) -> f64 {
        self.nest.band_mm.unwrap_or_else(|| AUTO_BAND.max(std::f64::consts::SQRT_2 * unit)) + BAND_EPSILON
    }

    /// Distance within which edges of two parts are cut once, mm, for a file whose numbers are multiples of `unit` mm; `None`
    /// if each edge is cut.
    pub fn common(&self, unit: f64) -> Option<f64> {
        match self.common.lines {
            Lines::Within(distance) => Some(distance + BAND_EPSILON),
            Lines::Word(CommonLines::Auto) => Some(self.band(unit)),
            Lines::Word(CommonLines::Off) => None,
        }
    }

    /// Greatest angle between the blade and its orientation mode in a program of G-code, rad: at most the limit of the
    /// verifier.
    pub fn blade_tolerance(&self) -> f64 {
        rad(self.gcode.heading_tolerance_deg.min(self.verify.max_heading_deg))
    }

    /// Tables as in TOML.
    pub(super) fn to_table(&self) -> toml::Table {
        toml::Table::try_from(self).expect("a profile holds numbers, words and named tables")
    }

    /// True if a code of the cutter file, such as `M19`, is obeyed.
    pub fn obeys(&self, code: &str) -> bool {
        self.codes.get(code) != Some(&CodeUse::Ignore)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::keys;

    #[test]
    fn what_is_said_of_the_automatic_tolerance_is_true() {
        let about = keys::find("path.tolerance_mm").expect("a key").about;
        assert!(about.contains(&format!("\"auto\" = {AUTO_TOLERANCE} mm,")), "{about}");
        assert_eq!(MachineProfile::default().tolerance(0.0), AUTO_TOLERANCE);
    }
}
