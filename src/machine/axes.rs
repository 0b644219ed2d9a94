//! Limits of the axes: the keys `axes.*` and `c.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, SPEED, Takes, Within, from};
use super::kinematics::Limits;
use super::word::{OrWord, Same, Unbounded, Word as _};
use crate::units::{deg, rad};

/// Greatest accelerations, per s2.
pub(super) const ACCELERATION: Within = from(1.0, 1.0e9);
/// Greatest jerks, per s3.
const JERK: Within = from(1.0, 1.0e12);
/// Angles within one turn either way, degrees.
const TURN: Within = from(-360.0, 360.0);

/// The keys `axes.*` and `c.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "axes.x.speed_mm_s", takes: Takes::Number(SPEED), about: "Greatest speed along the table." },
    Key { name: "axes.x.acceleration_mm_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration along the table." },
    Key { name: "axes.x.jerk_mm_s3", takes: Takes::Number(JERK), about: "Greatest jerk along the table." },
    Key { name: "axes.y.speed_mm_s", takes: Takes::Number(SPEED), about: "Greatest speed across the table." },
    Key { name: "axes.y.acceleration_mm_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration across the table." },
    Key { name: "axes.y.jerk_mm_s3", takes: Takes::Number(JERK), about: "Greatest jerk across the table." },
    Key { name: "axes.c.speed_deg_s", takes: Takes::Number(SPEED), about: "Greatest speed of the blade's turn." },
    Key { name: "axes.c.acceleration_deg_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration of the blade's turn." },
    Key { name: "axes.c.jerk_deg_s3", takes: Takes::Number(JERK), about: "Greatest jerk of the blade's turn." },
    Key { name: "axes.x.travel.speed_mm_s", takes: Takes::NumberOr(SPEED, Same::WORD), about: "Greatest speed along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.x.travel.acceleration_mm_s2", takes: Takes::NumberOr(ACCELERATION, Same::WORD), about: "Greatest acceleration along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.x.travel.jerk_mm_s3", takes: Takes::NumberOr(JERK, Same::WORD), about: "Greatest jerk along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.speed_mm_s", takes: Takes::NumberOr(SPEED, Same::WORD), about: "Greatest speed across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.acceleration_mm_s2", takes: Takes::NumberOr(ACCELERATION, Same::WORD), about: "Greatest acceleration across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.jerk_mm_s3", takes: Takes::NumberOr(JERK, Same::WORD), about: "Greatest jerk across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.speed_deg_s", takes: Takes::NumberOr(SPEED, Same::WORD), about: "Greatest speed of the blade's turn while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.acceleration_deg_s2", takes: Takes::NumberOr(ACCELERATION, Same::WORD), about: "Greatest acceleration of the blade's turn while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.jerk_deg_s3", takes: Takes::NumberOr(JERK, Same::WORD), about: "Greatest jerk of the blade's turn while the knife is up; \"same\" = as in cutting." },
    Key { name: "c.range_deg", takes: Takes::RangeOr(Unbounded::WORD), about: "Least and greatest position of the C axis, when its cables do not let it turn for ever." },
    Key { name: "c.offset_deg", takes: Takes::Number(TURN), about: "Where the machine's zero of C points, seen from +X." },
    Key { name: "c.reverse", takes: Takes::Flag, about: "Whether the machine counts C clockwise." },
];

/// Limits of a linear axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearAxis {
    /// Greatest speed.
    pub speed_mm_s: f64,
    /// Greatest acceleration.
    pub acceleration_mm_s2: f64,
    /// Greatest jerk.
    pub jerk_mm_s3: f64,
    /// Limits while the knife is up.
    pub travel: LinearTravel,
}

/// Limits of a linear axis while the knife is up; `None` = the limit for cutting.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearTravel {
    /// Greatest speed.
    #[serde(with = "OrWord::<Same>")]
    pub speed_mm_s: Option<f64>,
    /// Greatest acceleration.
    #[serde(with = "OrWord::<Same>")]
    pub acceleration_mm_s2: Option<f64>,
    /// Greatest jerk.
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
    /// Greatest speed.
    pub speed_deg_s: f64,
    /// Greatest acceleration.
    pub acceleration_deg_s2: f64,
    /// Greatest jerk.
    pub jerk_deg_s3: f64,
    /// Limits while the knife is up.
    pub travel: RotaryTravel,
}

/// Limits of a rotary axis while the knife is up; `None` = the limit for cutting.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryTravel {
    /// Greatest speed.
    #[serde(with = "OrWord::<Same>")]
    pub speed_deg_s: Option<f64>,
    /// Greatest acceleration.
    #[serde(with = "OrWord::<Same>")]
    pub acceleration_deg_s2: Option<f64>,
    /// Greatest jerk.
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
    /// Axis along the table.
    pub x: LinearAxis,
    /// Axis across the table.
    pub y: LinearAxis,
    /// Axis that turns the blade.
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

/// Rotary axis as the controller counts it, for targets that address one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CAxis {
    /// Least and greatest position; `None` = unbounded.
    #[serde(with = "OrWord::<Unbounded>")]
    pub range_deg: Option<[f64; 2]>,
    /// Machine zero, counter-clockwise from +X.
    pub offset_deg: f64,
    /// True if the machine counts clockwise.
    pub reverse: bool,
}

impl CAxis {
    /// Least and greatest position, rad; `None` = unbounded.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range_deg.map(|range| range.map(rad))
    }

    /// Value that the controller shows at a position (rad), degrees.
    pub fn shown_deg(&self, position: f64) -> f64 {
        let away = deg(position) - self.offset_deg;
        if self.reverse { -away } else { away }
    }
}
