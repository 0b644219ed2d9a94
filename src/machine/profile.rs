//! The machine profile as typed: the TOML keys, their defaults, and what they mean in base units.
//!
//! Fields carry the names of their keys, so also their units; a method of the plain name gives mm, s and rad. The
//! defaults follow a real cutter's parameter table with a worn 6.6 mm knife.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::counts::Counts;
use super::gcode::Gcode;
use super::kinematics::Limits;
use super::knife::Knife;
use super::notches::Notches;
use super::plot::Hpgl;
use super::word::{Auto, Off, OrWord, Same, Stay, Unbounded, Unlimited};
use crate::units::{MM_PER_INCH, MS_PER_S, deg, rad};

/// Version of the profile's format that this program reads and writes.
pub const PROFILE_VERSION: u32 = 1;

/// Everything about the machine and the cutting room that a program depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineProfile {
    /// Version of the format, [`PROFILE_VERSION`].
    pub version: u32,
    /// Unit of cut files that overrides what they say.
    pub units: FileUnit,
    /// Pose of the C axis at the start of a program: x mm, y mm, c degrees.
    pub home: [f64; 3],
    /// Where the machine ends.
    #[serde(with = "OrWord::<Stay>")]
    pub park: Option<[f64; 3]>,
    /// The blade and how it is used.
    pub knife: Knife,
    /// Notches.
    pub notch: Notches,
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
    /// The clock of the controller.
    pub time: Time,
    /// The encoders of the drives.
    pub counts: Counts,
    /// The controller that reads G-code.
    pub gcode: Gcode,
    /// What the verifier allows.
    pub verify: Verify,
    /// How plots are read.
    pub hpgl: Hpgl,
    /// The texts of labels.
    pub labels: Labels,
    /// Codes of the cutter file to ignore, by name (`M19`).
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

/// Whether a code of the cutter file is obeyed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CodeUse {
    /// Obeyed.
    Use,
    /// Skipped, without a warning.
    Ignore,
}

/// The drill beside the knife.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drill {
    /// Time of one hole, ms; the axes rest.
    pub dwell_ms: f64,
    /// Where the drill stands, seen from the C axis, mm.
    pub offset_mm: [f64; 2],
}

impl Drill {
    /// Time of one hole, s.
    pub fn dwell(&self) -> f64 {
        self.dwell_ms / MS_PER_S
    }
}

impl Default for Drill {
    fn default() -> Self {
        Self { dwell_ms: 300.0, offset_mm: [0.0, 0.0] }
    }
}

/// What counts as a corner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Corner {
    /// A vertex that turns by more than this is a corner: the knife is lifted and turned in the air, degrees.
    pub angle_deg: f64,
}

impl Corner {
    /// The least turn of a corner, rad.
    pub fn angle(&self) -> f64 {
        rad(self.angle_deg)
    }
}

impl Default for Corner {
    fn default() -> Self {
        Self { angle_deg: 45.0 }
    }
}

/// Where the knife slows down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Slow {
    /// Length before a corner on which it does, mm.
    #[serde(with = "OrWord::<Off>")]
    pub before_corner_mm: Option<f64>,
    /// Its speed there, percent of what it would be.
    pub before_corner_percent: f64,
}

impl Default for Slow {
    fn default() -> Self {
        Self { before_corner_mm: None, before_corner_percent: 50.0 }
    }
}

/// How closely the path is followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Path {
    /// Permitted deviation of the tip from the path, mm; automatic from the file's unit.
    #[serde(with = "OrWord::<Auto>")]
    pub tolerance_mm: Option<f64>,
    /// What the polyline of the file stands for.
    pub fit: Fit,
    /// Greatest bulge beyond a chord that is taken for the curve which the file flattened, mm.
    pub chord_sag_max_mm: f64,
}

/// What a polyline of the file stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fit {
    /// A curve that was flattened: chords cut its corners, so the tube is wider on the outside.
    Curve,
    /// Exactly the polygon.
    Polygon,
}

impl Default for Path {
    fn default() -> Self {
        Self { tolerance_mm: None, fit: Fit::Curve, chord_sag_max_mm: 0.15 }
    }
}

/// Limits of a linear axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearAxis {
    /// Greatest speed, mm/s.
    pub speed_mm_s: f64,
    /// Greatest acceleration, mm/s2.
    pub acceleration_mm_s2: f64,
    /// Greatest jerk, mm/s3.
    pub jerk_mm_s3: f64,
    /// Limits while the knife is up.
    pub travel: LinearTravel,
}

/// Limits of a linear axis while the knife is up, where they differ from those of cutting.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearTravel {
    /// Greatest speed, mm/s.
    #[serde(with = "OrWord::<Same>")]
    pub speed_mm_s: Option<f64>,
    /// Greatest acceleration, mm/s2.
    #[serde(with = "OrWord::<Same>")]
    pub acceleration_mm_s2: Option<f64>,
    /// Greatest jerk, mm/s3.
    #[serde(with = "OrWord::<Same>")]
    pub jerk_mm_s3: Option<f64>,
}

impl Default for LinearAxis {
    fn default() -> Self {
        Self { speed_mm_s: 1200.0, acceleration_mm_s2: 8000.0, jerk_mm_s3: 2.0e5, travel: LinearTravel::default() }
    }
}

/// Limits of a rotary axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryAxis {
    /// Greatest speed, degrees/s.
    pub speed_deg_s: f64,
    /// Greatest acceleration, degrees/s2.
    pub acceleration_deg_s2: f64,
    /// Greatest jerk, degrees/s3.
    pub jerk_deg_s3: f64,
    /// Limits while the knife is up.
    pub travel: RotaryTravel,
}

/// Limits of a rotary axis while the knife is up, where they differ from those of cutting.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryTravel {
    /// Greatest speed, degrees/s.
    #[serde(with = "OrWord::<Same>")]
    pub speed_deg_s: Option<f64>,
    /// Greatest acceleration, degrees/s2.
    #[serde(with = "OrWord::<Same>")]
    pub acceleration_deg_s2: Option<f64>,
    /// Greatest jerk, degrees/s3.
    #[serde(with = "OrWord::<Same>")]
    pub jerk_deg_s3: Option<f64>,
}

impl Default for RotaryAxis {
    fn default() -> Self {
        Self { speed_deg_s: 1080.0, acceleration_deg_s2: 2.0e4, jerk_deg_s3: 1.0e6, travel: RotaryTravel::default() }
    }
}

/// Limits of the axes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Axes {
    /// Along the table.
    pub x: LinearAxis,
    /// Across the table.
    pub y: LinearAxis,
    /// The blade's turn.
    pub c: RotaryAxis,
}

impl Axes {
    /// Limits of x, y, c in mm, rad and s while the knife is down.
    pub fn limits(&self) -> [Limits; 3] {
        let linear = |axis: &LinearAxis| Limits {
            speed: axis.speed_mm_s,
            acceleration: axis.acceleration_mm_s2,
            jerk: axis.jerk_mm_s3,
        };
        let c = Limits {
            speed: rad(self.c.speed_deg_s),
            acceleration: rad(self.c.acceleration_deg_s2),
            jerk: rad(self.c.jerk_deg_s3),
        };
        [linear(&self.x), linear(&self.y), c]
    }

    /// Limits of x, y, c in mm, rad and s while the knife is up.
    pub fn travel_limits(&self) -> [Limits; 3] {
        let linear = |axis: &LinearAxis| Limits {
            speed: axis.travel.speed_mm_s.unwrap_or(axis.speed_mm_s),
            acceleration: axis.travel.acceleration_mm_s2.unwrap_or(axis.acceleration_mm_s2),
            jerk: axis.travel.jerk_mm_s3.unwrap_or(axis.jerk_mm_s3),
        };
        let RotaryAxis { travel, .. } = &self.c;
        let c = Limits {
            speed: rad(travel.speed_deg_s.unwrap_or(self.c.speed_deg_s)),
            acceleration: rad(travel.acceleration_deg_s2.unwrap_or(self.c.acceleration_deg_s2)),
            jerk: rad(travel.jerk_deg_s3.unwrap_or(self.c.jerk_deg_s3)),
        };
        [linear(&self.x), linear(&self.y), c]
    }
}

/// The rotary axis as the controller counts it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CAxis {
    /// Least and greatest position, degrees.
    #[serde(with = "OrWord::<Unbounded>")]
    pub range_deg: Option<[f64; 2]>,
    /// Angle between machine zero and +X, degrees; for targets that address a controller.
    pub offset_deg: f64,
    /// Whether the controller counts clockwise; for targets that address a controller.
    pub reverse: bool,
}

impl CAxis {
    /// Least and greatest position, rad.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range_deg.map(|range| range.map(rad))
    }

    /// What the controller shows at a position (rad), degrees.
    pub fn shown_deg(&self, position: f64) -> f64 {
        let away = deg(position) - self.offset_deg;
        if self.reverse { -away } else { away }
    }
}

/// The table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Table {
    /// Reach along X, mm.
    #[serde(with = "OrWord::<Unlimited>")]
    pub x_mm: Option<[f64; 2]>,
    /// Reach along Y, mm.
    #[serde(with = "OrWord::<Unlimited>")]
    pub y_mm: Option<[f64; 2]>,
}

impl Table {
    /// A program that leaves the table by more is refused, mm: a hand puts a marker down no better than that.
    pub const EDGE_MM: f64 = 1.0;

    /// How far a place lies off the table, mm; not above 0 on it.
    pub fn off(&self, place: [f64; 2]) -> f64 {
        let beyond = |value: f64, range: Option<[f64; 2]>| {
            range.map_or(f64::NEG_INFINITY, |[least, most]| (least - value).max(value - most))
        };
        beyond(place[0], self.x_mm).max(beyond(place[1], self.y_mm))
    }
}

/// The clock of the controller.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Time {
    /// Time between two setpoints, ms.
    pub period_ms: f64,
}

impl Time {
    /// Time between two setpoints, s.
    pub fn period(&self) -> f64 {
        self.period_ms / MS_PER_S
    }
}

impl Default for Time {
    fn default() -> Self {
        Self { period_ms: 1.0 }
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
            drill: Drill::default(),
            corner: Corner::default(),
            slow: Slow::default(),
            path: Path::default(),
            axes: Axes::default(),
            c: CAxis::default(),
            table: Table::default(),
            time: Time::default(),
            counts: Counts::default(),
            gcode: Gcode::default(),
            verify: Verify::default(),
            hpgl: Hpgl::default(),
            labels: Labels::default(),
            codes: BTreeMap::new(),
        }
    }
}

/// What the verifier allows beyond the tolerance of the path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Verify {
    /// Longest stretch that may be left uncut, mm: what rounding of the setpoints can leave.
    pub max_uncut_mm: f64,
    /// Greatest angle between the blade and its law, degrees.
    pub max_heading_deg: f64,
    /// Farthest that the blade's body may leave the path on curves, mm.
    #[serde(with = "OrWord::<Off>")]
    pub max_body_mm: Option<f64>,
    /// Farthest overcut into the part itself, mm, beside the tolerance and what is warned of.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_part_mm: Option<f64>,
    /// Farthest overcut into another part, mm, beside what is warned of.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_neighbour_mm: Option<f64>,
    /// Farthest overcut into waste, mm.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_waste_mm: Option<f64>,
}

impl Default for Verify {
    fn default() -> Self {
        Self {
            max_uncut_mm: 0.01,
            max_heading_deg: 0.5,
            max_body_mm: None,
            max_overcut_part_mm: Some(0.0),
            max_overcut_neighbour_mm: Some(0.0),
            max_overcut_waste_mm: None,
        }
    }
}

/// The texts of labels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Labels {
    /// Name of the encoding of texts that are no UTF-8; [`Labels::text`] decodes them.
    pub encoding: String,
}

impl Default for Labels {
    fn default() -> Self {
        Self { encoding: "utf-8".to_owned() }
    }
}

/// Least tolerance of the automatic rule, mm.
const AUTO_TOLERANCE: f64 = 0.05;
/// Largest distance of a point from its rounded place, in units of the grid: half the diagonal of a cell.
const ROUNDING_REACH: f64 = 0.71;

impl MachineProfile {
    /// Least and greatest angle of the blade at which C is inside its range, rad.
    pub fn blade_range(&self) -> Option<[f64; 2]> {
        self.c.range().map(|range| range.map(|end| end - self.knife.yaw()))
    }

    /// Permitted deviation of the tip from the path, mm, for a file whose numbers are multiples of `unit` mm:
    /// not smaller than what the file resolves, because its vertices carry that much noise.
    pub fn tolerance(&self, unit: f64) -> f64 {
        self.path.tolerance_mm.unwrap_or_else(|| AUTO_TOLERANCE.max(ROUNDING_REACH * unit))
    }

    /// How far the blade may be turned from its law in a program of G-code, rad: no farther than it is judged by.
    pub fn blade_tolerance(&self) -> f64 {
        rad(self.gcode.heading_tolerance_deg.min(self.verify.max_heading_deg))
    }

    /// Whether a code of the cutter file, such as `M19`, is obeyed.
    pub fn obeys(&self, code: &str) -> bool {
        self.codes.get(code) != Some(&CodeUse::Ignore)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_is_what_the_back_leaves_of_the_width() {
        let default = Knife::default();
        assert!((default.radius() - 0.25).abs() < 1e-12 && (default.back() - 6.35).abs() < 1e-12);
        let new = Knife { width_mm: 8.89, ..Knife::default() };
        assert!((new.radius() - 2.54).abs() < 1e-12);
        let eccentric = Knife { back_mm: None, radius_mm: Some(4.4), ..Knife::default() };
        assert!((eccentric.back() - 2.2).abs() < 1e-12);
    }

    #[test]
    fn a_narrow_blade_and_a_point_turn_about_their_tip() {
        for width_mm in [0.0, 3.0] {
            let knife = Knife { width_mm, ..Knife::default() };
            assert_eq!((knife.radius(), knife.back()), (0.0, width_mm));
        }
    }
}
