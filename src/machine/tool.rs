//! Tool that follows the lines: the keys `tool.*` and `quintic.*`.

use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::key::{Key, PERCENT, SPEED, Takes, from};
use super::knife::{Follow, Knife, Spare, TightCurves};
use super::word::words;

/// The keys `tool.*` and `quintic.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "tool.kind", takes: Takes::Word(words::<ToolKind>), about: "\"knife\", or a tool without a blade that follows lines as one does, without overlaps: \"wheel\" = a\ncreasing wheel, \"pen\", \"router\"; or \"spray\" = a head that follows edges at a distance." },
    Key { name: "tool.distance_mm", takes: Takes::Number(from(1.0, 10_000.0)), about: "How far outside the edge of a part the spray head runs." },
    Key { name: "tool.edge_speed_mm_s", takes: Takes::Number(SPEED), about: "How fast the jet of the spray head goes along the edge." },
    Key { name: "tool.edge_speed_percent", takes: Takes::Number(PERCENT), about: "By how much the jet may be faster than that: where it is, the coat is thinner." },
    Key { name: "tool.corner_speed_mm_s", takes: Takes::Number(SPEED), about: "How fast the spray head goes round a corner of the part: the jet stands on the corner meanwhile." },
    Key { name: "tool.planner", takes: Takes::Word(words::<Planner>), about: "How the spray head is planned: \"optimal\" = as fast as the axes and the speeds above allow,\n\"quintic\" = least-squares polynomials of order 5 for X, Y and C, edge by edge." },
    Key { name: "quintic.basis", takes: Takes::Word(words::<Basis>), about: "What the polynomials are sums of: \"chebyshev\" polynomials on the time of their piece, or plain\npowers of the time (\"monomial\", for study: their equations are ill-conditioned)." },
    Key { name: "quintic.split", takes: Takes::Flag, about: "Edges are split until their polynomials keep path.tolerance_mm; false = one for each edge,\nfor study." },
];

/// Tool that follows the lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tool {
    /// Kind.
    pub kind: ToolKind,
    /// Distance from head to edge.
    pub distance_mm: f64,
    /// Speed of the jet along the edge.
    pub edge_speed_mm_s: f64,
    /// Permitted excess of the jet's speed.
    pub edge_speed_percent: f64,
    /// Speed of the head round a corner.
    pub corner_speed_mm_s: f64,
    /// Planner of its motion.
    pub planner: Planner,
}

/// Kind of the tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ToolKind {
    /// Tangential knife.
    Knife,
    /// Spray head that follows edges at a distance, turned towards them.
    Spray,
    /// Creasing wheel.
    Wheel,
    /// Pen.
    Pen,
    /// Router.
    Router,
}

/// Planner of the motion of a spray head.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Planner {
    /// Jerk-limited motion, as fast as the limits allow.
    Optimal,
    /// Least-squares polynomials of order 5.
    Quintic,
}

/// Polynomials of [`Planner::Quintic`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Quintic {
    /// Basis functions.
    pub basis: Basis,
    /// True if edges are split until the polynomials are close enough.
    pub split: bool,
}

/// Basis functions of a polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Chebyshev polynomials on the time of the piece.
    Chebyshev,
    /// Powers of the time.
    Monomial,
}

impl Default for Tool {
    fn default() -> Self {
        Self {
            kind: ToolKind::Knife,
            distance_mm: 300.0,
            edge_speed_mm_s: 300.0,
            edge_speed_percent: 5.0,
            corner_speed_mm_s: 480.0,
            planner: Planner::Optimal,
        }
    }
}

impl Default for Quintic {
    fn default() -> Self {
        Self { basis: Basis::Chebyshev, split: true }
    }
}

/// Key of the knife, and a test of whether its value asks for something.
type Asks = (&'static str, fn(&Knife) -> bool);

/// Keys that require a blade.
const OF_BLADES: &[Asks] = &[
    ("knife.width_mm", |knife| knife.width_mm > 0.0),
    ("knife.back_mm", |knife| knife.back_mm.is_some_and(|back| back > 0.0)),
    ("knife.radius_mm", |knife| knife.radius_mm.is_some_and(|radius| radius > 0.0)),
    ("knife.front_overlap_mm", |knife| knife.front_overlap_mm > 0.0),
    ("knife.corner_front_overlap_mm", |knife| knife.corner_front_overlap_mm > 0.0),
    ("knife.heel_overlap_mm", |knife| knife.heel_overlap_mm > 0.0),
    ("knife.corner_heel_overlap_mm", |knife| knife.corner_heel_overlap_mm > 0.0),
    ("knife.reflex_front_overlap_mm", |knife| knife.reflex_front_overlap_mm > 0.0),
    ("knife.reflex_heel_overlap_mm", |knife| knife.reflex_heel_overlap_mm > 0.0),
    ("knife.edges", |knife| knife.edges > 1),
    ("knife.follow", |knife| knife.follow == Follow::Chord),
    ("knife.tight_curves", |knife| knife.tight_curves != TightCurves::Follow),
    ("knife.max_swing_mm", |knife| knife.max_swing_mm.is_some()),
    ("knife.spare", |knife| knife.spare != Spare::Both),
    ("knife.max_bow_mm", |_| true),
];

/// Keys that a head which never touches the material ignores as well: plunges, lifts and cutting speeds.
const OF_CUTS: &[Asks] = &[
    ("knife.feed_mm_s", |knife| knife.feed_mm_s.is_some()),
    ("knife.slow_percent", |_| true),
    ("knife.near_percent", |_| true),
    ("knife.plunge_ms", |knife| knife.plunge_ms > 0.0),
    ("knife.lift_ms", |knife| knife.lift_ms > 0.0),
    ("knife.clear_ms", |knife| knife.clear_ms.is_some()),
    ("knife.max_down_mm", |knife| knife.max_down_mm.is_some()),
    ("knife.yaw_deg", |knife| knife.yaw_deg != 0.0),
];

impl ToolKind {
    /// Name in profiles.
    pub fn name(self) -> &'static str {
        match self {
            Self::Knife => "knife",
            Self::Spray => "spray",
            Self::Wheel => "wheel",
            Self::Pen => "pen",
            Self::Router => "router",
        }
    }

    /// True if it has a blade, with a heel, a tip and overlaps.
    pub fn has_blade(self) -> bool {
        match self {
            Self::Knife => true,
            Self::Spray | Self::Wheel | Self::Pen | Self::Router => false,
        }
    }

    /// True if it cuts the material through: a place of it then lies in one part at most.
    pub fn severs(self) -> bool {
        match self {
            Self::Knife | Self::Router => true,
            Self::Spray | Self::Wheel | Self::Pen => false,
        }
    }

    /// Adapts the knife to the tool: a tool without a blade is a point on the line, along its tangent, without overlaps.
    pub(super) fn fit(self, knife: &mut Knife) {
        if !self.has_blade() {
            *knife = Knife {
                width_mm: 0.0,
                back_mm: None,
                radius_mm: Some(0.0),
                front_overlap_mm: 0.0,
                corner_front_overlap_mm: 0.0,
                heel_overlap_mm: 0.0,
                corner_heel_overlap_mm: 0.0,
                reflex_front_overlap_mm: 0.0,
                reflex_heel_overlap_mm: 0.0,
                ..knife.clone()
            };
        }
    }
}

/// Faults of keys that contradict the tool.
pub(super) fn faults(tool: &Tool, knife: &Knife, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let lacks = match tool.kind {
        ToolKind::Knife => &[][..],
        ToolKind::Wheel | ToolKind::Pen | ToolKind::Router => &[("has no blade", OF_BLADES)][..],
        ToolKind::Spray => &[("has no blade", OF_BLADES), ("does not cut", OF_CUTS)][..],
    };
    let name = tool.kind.name();
    let odd = |&(why, keys): &(&str, &'static [Asks])| {
        let given = keys.iter().filter(|(key, asks)| asks(knife) && is_given(key));
        let fault = |(key, _): &Asks| {
            let message = format!("`tool.kind` is \"{name}\", which {why}, but `{key}` is given");
            Fault::of_range(&[key, "tool.kind"], message, "leave it out, or set `tool.kind = \"knife\"`")
        };
        given.map(fault).collect::<Vec<_>>()
    };
    let mut faults: Vec<Fault> = lacks.iter().flat_map(odd).collect();
    if tool.kind != ToolKind::Spray && tool.planner != Planner::Optimal && is_given("tool.planner") {
        let message = format!("`tool.kind` is \"{name}\", but `tool.planner` is that of a head at a distance");
        let hint = "leave it out, or set `tool.kind = \"spray\"`";
        faults.push(Fault::of_range(&["tool.planner", "tool.kind"], message, hint));
    }
    faults
}
