//! The machine profile as typed: the TOML keys, their defaults, and what they mean in base units.
//!
//! Fields carry the names of their keys, so also their units; a method of the plain name gives mm, s and rad. What a key
//! means and takes stands in its row of `KEYS`, in the file of its section. The defaults follow a real cutter's parameter
//! table with a worn 6.6 mm knife.

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

/// Version of the profile's format that this program reads and writes.
pub const PROFILE_VERSION: u32 = 1;

/// The keys at the top.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "version", takes: Takes::Whole(&[PROFILE_VERSION as i64]), about: "Version of this format." },
    Key { name: "units", takes: Takes::Word(words::<FileUnit>), about: "Unit of the coordinates in cut files. \"auto\" believes the file (G70, G71, G91); set it for a\nfile that is drawn in another unit than it says." },
    Key { name: "home", takes: Takes::Pose, about: "Where the axes stand when a program starts." },
    Key { name: "park", takes: Takes::PoseOr(Stay::WORD), about: "Where the axes go when a program ends; \"stay\" = they stay over the last cut." },
];

/// Everything about the machine and the cutting room that a program depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineProfile {
    /// [`PROFILE_VERSION`].
    pub version: u32,
    /// Unit of cut files.
    pub units: FileUnit,
    /// Where a program starts: x mm, y mm, c degrees.
    pub home: [f64; 3],
    /// Where it ends, likewise.
    #[serde(with = "OrWord::<Stay>")]
    pub park: Option<[f64; 3]>,
    /// The blade and how it is used.
    pub knife: Knife,
    /// Notches.
    pub notch: Notches,
    /// How parts lie beside each other.
    pub nest: Nest,
    /// Edges that two parts have in common.
    pub common: Common,
    /// In which order pieces are cut.
    pub order: Order,
    /// How the marker lies on the table.
    pub sheet: Sheet,
    /// How closely registration marks must fit.
    pub map: Map,
    /// The drill.
    pub drill: Drill,
    /// Corners.
    pub corner: Corner,
    /// Where the knife slows down.
    pub slow: Slow,
    /// How closely the path is followed.
    pub path: Path,
    /// Limits of the axes.
    pub axes: Axes,
    /// The rotary axis.
    pub c: CAxis,
    /// The table.
    pub table: Table,
    /// The conveyor under the table.
    pub bite: Bite,
    /// The clock of the controller.
    pub time: Time,
    /// The encoders of the drives.
    pub counts: Counts,
    /// The controller that reads G-code.
    pub gcode: Gcode,
    /// What the verifier allows.
    pub verify: Verify,
    /// How drawings are read.
    pub drawing: Drawings,
    /// How plots are read.
    pub hpgl: Hpgl,
    /// How pattern DXF is read.
    pub dxf: Dxf,
    /// The texts of labels.
    pub labels: Labels,
    /// The pattern-sewing machine.
    pub sewing: Sewing,
    /// The carriage that follows a moving cloth.
    pub track: Tracking,
    /// Heads over a conveyor.
    pub flow: Flow,
    /// What follows the lines.
    pub tool: Tool,
    /// Its polynomials.
    pub quintic: Quintic,
    /// Codes of the cutter file by name, `M19`.
    pub codes: BTreeMap<String, CodeUse>,
}

/// Unit of the integers in a cut file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum FileUnit {
    /// As the file says.
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
    /// Length of the unit, mm; `None` when the file decides.
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
/// Least band of the automatic rule, mm: what no worker sees.
const AUTO_BAND: f64 = 0.2;
/// How much farther from each other than the band edges are one all the same, mm: the gap of many nests is the band, and
/// rounding of a turned one must not tear its edges to pieces.
const BAND_EPSILON: f64 = 1e-9;
/// Largest distance of a point from its rounded place, in units of the grid: half the diagonal of a cell.
const ROUNDING_REACH: f64 = 0.71;

impl MachineProfile {
    /// Least and greatest angle of the blade at which C is inside its range, rad.
    pub fn blade_range(&self) -> Option<[f64; 2]> {
        self.c.range().map(|range| range.map(|end| end - self.knife.yaw()))
    }

    /// Least turn at which the knife is lifted, rad: of `corner.angle_deg`, and less where the heel would stand farther than
    /// `knife.max_swing_mm` beside the line behind it, w sin(a).
    pub fn corner_angle(&self) -> f64 {
        let swing = self.knife.max_swing_mm.filter(|&swing| swing < self.knife.width_mm);
        swing.map_or(f64::INFINITY, |swing| (swing / self.knife.width_mm).asin()).min(self.corner.angle())
    }

    /// Permitted deviation of the tip from the path, mm, for a file whose numbers are multiples of `unit` mm:
    /// not smaller than what the file resolves, because its vertices carry that much noise.
    pub fn tolerance(&self, unit: f64) -> f64 {
        self.path.tolerance_mm.unwrap_or_else(|| AUTO_TOLERANCE.max(ROUNDING_REACH * unit))
    }

    /// How near to each other edges of two parts are one edge, mm, for a file whose numbers are multiples of `unit` mm: each
    /// outline was rounded by itself, so that they may be a diagonal of that apart.
    pub fn band(&self, unit: f64) -> f64 {
        self.nest.band_mm.unwrap_or_else(|| AUTO_BAND.max(std::f64::consts::SQRT_2 * unit)) + BAND_EPSILON
    }

    /// How near to each other edges of two parts are cut once, mm, for a file whose numbers are multiples of `unit` mm; `None` =
    /// each is cut.
    pub fn common(&self, unit: f64) -> Option<f64> {
        match self.common.lines {
            Lines::Within(distance) => Some(distance + BAND_EPSILON),
            Lines::Word(CommonLines::Auto) => Some(self.band(unit)),
            Lines::Word(CommonLines::Off) => None,
        }
    }

    /// How far the blade may be turned from where its orientation mode has it in a program of G-code, rad: no farther
    /// than it is judged by.
    pub fn blade_tolerance(&self) -> f64 {
        rad(self.gcode.heading_tolerance_deg.min(self.verify.max_heading_deg))
    }

    /// Its tables, as in TOML.
    pub(super) fn to_table(&self) -> toml::Table {
        toml::Table::try_from(self).expect("a profile holds numbers, words and named tables")
    }

    /// Whether a code of the cutter file, such as `M19`, is obeyed.
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
