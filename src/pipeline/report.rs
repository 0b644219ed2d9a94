//! Figures of the input and the program of a compile: the summary.
//!
//! Serialised figures are rounded, all of them here: lengths and times far below the resolution of a machine, peaks to
//! [`PEAK_DIGITS`]. Figures in memory are exact.

use serde::{Serialize, Serializer};

use super::bites::{self, Bite};
use super::rounded::{micro, micro_known, significant, to_millionths};
use super::savings::Savings;
use super::spent::Spent;
use crate::back::{Estimate, Limit};
use crate::geom::polyline;
use crate::ir::declaration::Total;
use crate::ir::drawing::{Account, LayerLines, LineClass};
use crate::ir::marker::{NotchForm, NotchKind};
use crate::ir::{self, Marker};
use crate::machine::gcode::Planner;
use crate::machine::{Follow, NotchStyle};
use crate::spray;
use crate::units::{MM_PER_M, deg};

/// Significant digits of a peak.
const PEAK_DIGITS: i32 = 6;

/// Figures of one file; `None` before planning.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Name of the dialect that was read.
    pub dialect: &'static str,
    /// Grid of the numbers in the file, mm; 0 when they are not rounded.
    #[serde(serialize_with = "micro")]
    pub unit_mm: f64,
    /// Width and height of all cuts and holes, mm.
    #[serde(serialize_with = "micro_pair")]
    pub extent_mm: [f64; 2],
    /// Pieces.
    pub pieces: usize,
    /// Contours, closed and open.
    pub contours: usize,
    /// Contours that end at their start.
    pub closed_contours: usize,
    /// Notches by kind.
    pub notches: Notches,
    /// Holes.
    pub drills: usize,
    /// Texts.
    pub labels: usize,
    /// Length of contours and slits, without overlaps, m.
    #[serde(serialize_with = "micro")]
    pub cut_m: f64,
    /// Edges that are cut once for two parts; absent if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub common: Option<Common>,
    /// Length of the near lines, m: if edges of two parts run side by side and both are cut, each counts; absent if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "micro_known")]
    pub near_m: Option<f64>,
    /// Windows of a conveyor, in order; absent if the cloth lies still.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bites: Vec<Bite>,
    /// Classes of the lines of a plot.
    #[serde(flatten)]
    pub drawn: Option<Drawn>,
    /// Figures of planning.
    #[serde(flatten)]
    pub program: Program,
    /// Unavoidable deviations of the program from the drawing, by kind.
    pub declared: Vec<Total>,
    /// Estimate for a controller that plans for itself; absent without such a target.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub controller: Option<Controller>,
    /// Figures of a head that follows edges at a distance, by edge; absent with another tool.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edges: Option<Vec<spray::Edge>>,
}

/// Edges that are cut once for two parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Common {
    /// Number of edges.
    pub edges: usize,
    /// Their length, m.
    #[serde(serialize_with = "micro")]
    pub length_m: f64,
    /// Length saved compared with cutting every part all round, m: less than their length, since open cuts are extended.
    #[serde(serialize_with = "micro")]
    pub spared_m: f64,
    /// Greatest distance of such an edge from its cut, mm.
    #[serde(serialize_with = "micro")]
    pub shift_mm: f64,
    /// The edges, in the order of the pieces that are spared.
    pub all: Vec<CommonEdge>,
}

/// An edge that is cut once for two parts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CommonEdge {
    /// Number of the piece that it is cut with.
    pub piece: u32,
    /// Number of the piece that is spared it.
    pub spared: u32,
    /// Copies of the marker that the two belong to, from 1; absent if there is only one copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies: Option<[u32; 2]>,
    /// Its length, m.
    #[serde(serialize_with = "micro")]
    pub length_m: f64,
    /// Greatest distance of the spared piece's edge from the cut, mm.
    #[serde(serialize_with = "micro")]
    pub shift_mm: f64,
}

impl Common {
    /// Common edges of a marker; `None` if there are none.
    fn of(marker: &Marker) -> Option<Self> {
        let all: Vec<CommonEdge> = marker.common.iter().map(|edge| CommonEdge::of(marker, edge)).collect();
        let shift_mm = all.iter().map(|edge| edge.shift_mm).fold(0.0, f64::max);
        let [length_m, spared_m] = [marker.common_length(), marker.spared].map(|length| length / MM_PER_M);
        (!all.is_empty()).then_some(Self { edges: all.len(), length_m, spared_m, shift_mm, all })
    }
}

impl CommonEdge {
    fn of(marker: &Marker, edge: &ir::marker::CommonEdge) -> Self {
        let pieces = edge.pieces.map(|piece| &marker.pieces[piece as usize]);
        let [piece, spared] = pieces.map(|piece| piece.number);
        let copies = pieces.map(|piece| piece.copy);
        Self {
            piece,
            spared,
            copies: Some(copies).filter(|copies| *copies != [0; 2]),
            length_m: polyline::length(&marker.list.points(edge.range)) / MM_PER_M,
            shift_mm: edge.shift,
        }
    }
}

/// A program on a controller that plans for itself.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Controller {
    /// Likely duration, s.
    #[serde(serialize_with = "micro")]
    pub time_s: f64,
    /// Number of arcs and lines with the knife down.
    pub moves: usize,
    /// Planner whose time it is.
    #[serde(serialize_with = "titled")]
    pub planner: Planner,
    /// Moves that were chosen because they are the fastest; absent if the profile fixes them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<String>,
    /// Moves that were not chosen, the fastest first; absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<Other>,
    /// Time by limit, the greatest first; absent where it is not known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<Limited>,
}

/// Moves of a controller that were not chosen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Other {
    /// Their name.
    pub moves: String,
    /// Likely duration, s; absent if the file cannot be cut with them within the permitted deviations.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "micro_known")]
    pub time_s: Option<f64>,
}

/// Figures of a program that is not written.
#[derive(Debug, Default)]
pub struct Estimated {
    /// Figures of planning.
    pub program: Program,
    /// The program on the controller of the profile, where that plans for itself.
    pub controller: Option<Controller>,
}

/// Time of a program that one limit costs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limited {
    /// The limit.
    #[serde(serialize_with = "in_words")]
    pub limit: Limit,
    /// Its time, s.
    #[serde(serialize_with = "micro")]
    pub time_s: f64,
}

impl From<Estimate> for Controller {
    fn from(Estimate { spent, moves, planner, chosen, .. }: Estimate) -> Self {
        let (chosen, others) = chosen.map_or((None, Vec::new()), |chosen| (Some(chosen.name), chosen.others));
        let others = others.into_iter().map(|(moves, time_s)| Other { moves, time_s }).collect();
        let limits = spent.limits.into_iter().map(|(limit, time_s)| Limited { limit, time_s }).collect();
        Self { time_s: spent.time, moves, planner, chosen, others, limits }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands fields over by reference")]
fn titled<S: Serializer>(planner: &Planner, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(planner.title())
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands fields over by reference")]
fn in_words<S: Serializer>(limit: &Limit, out: S) -> Result<S::Ok, S::Error> {
    out.collect_str(limit)
}

/// Lines of a plot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Drawn {
    /// Length of lines drawn with the pen down, mm, without lettered texts.
    #[serde(serialize_with = "micro")]
    pub pen_down_mm: f64,
    /// Number of texts in no part, which belong to no piece.
    pub texts_outside: usize,
    /// Lines by class; classes without lines are left out.
    pub lines: Vec<Lines>,
    /// Layers of a drawing; absent for pens.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<Layer>,
}

/// Lines of a layer of a drawing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Layer {
    /// Name of the layer.
    pub name: String,
    /// Use of its lines.
    pub used: &'static str,
    /// Number of lines.
    pub count: usize,
    /// Length as drawn, mm.
    #[serde(serialize_with = "micro")]
    pub length_mm: f64,
}

/// Lines of a plot in one class.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lines {
    /// Name of the class.
    pub class: &'static str,
    /// How such lines are told from others.
    pub about: &'static str,
    /// True if they are cut or drilled.
    pub cut: bool,
    /// Number of lines.
    pub count: usize,
    /// Length as drawn, mm; notches in an outline count as part of it.
    #[serde(serialize_with = "micro")]
    pub length_mm: f64,
}

impl Drawn {
    fn of(account: &Account) -> Self {
        let lines = |class: &LineClass| Lines {
            class: class.name,
            about: class.about,
            cut: class.cut,
            count: class.count,
            length_mm: class.length,
        };
        let lines = account.classes.iter().map(lines).collect();
        let layer = |layer: &LayerLines| Layer {
            name: layer.name.clone(),
            used: layer.used,
            count: layer.count,
            length_mm: layer.length,
        };
        let layers = account.layers.iter().map(layer).collect();
        Self { pen_down_mm: account.pen_down, texts_outside: account.texts_outside, lines, layers }
    }
}

/// Notches by kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Notches {
    /// One straight cut from the edge inwards.
    pub slit: usize,
    /// A slit with a crossbar over its tip.
    pub t: usize,
    /// Two legs of an outline that meet inside.
    pub v: usize,
    /// Rectangles that an outline makes.
    pub castle: usize,
    /// Notches of an outline with a round bottom.
    pub u: usize,
    /// V notches of an outline that protrude from the part.
    #[serde(rename = "v-out")]
    pub v_out: usize,
    /// Castle notches of an outline that protrude.
    #[serde(rename = "castle-out")]
    pub castle_out: usize,
    /// U notches of an outline that protrude.
    #[serde(rename = "u-out")]
    pub u_out: usize,
}

impl Notches {
    /// Counts of a marker.
    fn of(marker: &Marker) -> Self {
        let mut counts = Self::default();
        for piece in &marker.pieces {
            let slits = piece.notches.iter().filter(|notch| notch.kind == NotchKind::Slit).count();
            counts.slit += slits;
            counts.t += piece.notches.len() - slits;
            for notch in &piece.outline_notches {
                let count = match (notch.form, notch.outwards) {
                    (NotchForm::V, false) => &mut counts.v,
                    (NotchForm::V, true) => &mut counts.v_out,
                    (NotchForm::Castle, false) => &mut counts.castle,
                    (NotchForm::Castle, true) => &mut counts.castle_out,
                    (NotchForm::U, false) => &mut counts.u,
                    (NotchForm::U, true) => &mut counts.u_out,
                };
                *count += 1;
            }
        }
        counts
    }

    /// Each kind with its count, in the order of a summary.
    pub fn by_kind(&self) -> [(&'static str, usize); 8] {
        [
            ("slit", self.slit),
            ("t", self.t),
            ("v", self.v),
            ("castle", self.castle),
            ("u", self.u),
            ("v-out", self.v_out),
            ("castle-out", self.castle_out),
            ("u-out", self.u_out),
        ]
    }
}

/// The figures of a program.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Program {
    /// Length of the C axis's path with the knife up, m.
    #[serde(serialize_with = "micro_known")]
    pub travel_m: Option<f64>,
    /// Times that the knife goes down: runs and plunge cuts.
    pub runs: Option<usize>,
    /// Style in which notches are cut.
    pub notch_style: Option<NotchStyle>,
    /// Orientation mode of the blade.
    pub follow: Option<Follow>,
    /// Cuts in the tangent mode because the chord mode, which the profile asks for, is impossible on them.
    pub tangent_runs: Option<usize>,
    /// Plunges without motion.
    #[serde(rename = "stabs")]
    pub plunge_cuts: Option<usize>,
    /// Times that the knife goes up.
    pub lifts: Option<usize>,
    /// Duration of the program, s.
    #[serde(serialize_with = "micro_known")]
    pub time_s: Option<f64>,
    /// Overlaps beyond the ends of cuts.
    pub sides: Option<Sides>,
    /// Parts of that time.
    pub spent: Option<Spent>,
    /// Possible savings.
    pub savings: Option<Savings>,
    /// Parts of the time of each piece by its number and its index in the marker, in cut order.
    #[serde(skip)]
    pub by_piece: Vec<([u32; 2], Spent)>,
    /// Greatest bulge of the knife's path beyond the chords of flattened curves, mm.
    #[serde(skip)]
    pub bulge_mm: Option<f64>,
    /// Greatest speed, acceleration and jerk of each axis, with their limits.
    pub axes: Option<Axes>,
}

/// Measures by which the blade avoids harm beyond the ends of its cuts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Sides {
    /// Ends beyond which the part itself lies.
    pub inside: usize,
    /// Overlaps that a narrow gap shortens.
    pub shortened: usize,
    /// Cuts in the reverse direction of the file.
    pub turned: usize,
    /// Cuts with the back edge of the blade leading.
    pub backwards: usize,
    /// Plunge cuts that cut into a part.
    pub harmful: usize,
    /// Depth of the worst of them in a part, mm.
    #[serde(serialize_with = "micro")]
    pub overcut_mm: f64,
    /// Plunge cuts that cut into a part other than their own.
    pub trespassing: usize,
    /// Depth of the worst of them in such a part, mm.
    #[serde(serialize_with = "micro")]
    pub neighbour_overcut_mm: f64,
    /// Cuts that continue where the knife was lifted amid a contour.
    pub rejoined: usize,
}

/// Peaks of the three axes; mm for x and y, degrees for c.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Axes {
    /// Along the table.
    pub x: Peaks,
    /// Across the table.
    pub y: Peaks,
    /// The blade's turn.
    pub c: Peaks,
}

/// The greatest values of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peaks {
    /// Per s.
    pub speed: Peak,
    /// Per s2.
    pub acceleration: Peak,
    /// Per s3.
    pub jerk: Peak,
}

/// A greatest value and its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peak {
    /// The greatest value of the program, by finite differences of its setpoints.
    #[serde(serialize_with = "peak")]
    pub worst: f64,
    /// Limit of the profile.
    #[serde(serialize_with = "peak")]
    pub limit: f64,
}

impl Axes {
    /// Peaks (mm, rad) beside their limits, in mm and degrees.
    pub fn new(peaks: &crate::plan::Peaks) -> Self {
        let axis = |i: usize, unit: fn(f64) -> f64| {
            let [speed, acceleration, jerk] =
                peaks[i].map(|peak| Peak { worst: unit(peak.worst), limit: unit(peak.limit) });
            Peaks { speed, acceleration, jerk }
        };
        Self { x: axis(0, |v| v), y: axis(1, |v| v), c: axis(2, deg) }
    }
}

impl Report {
    /// Time of the program, s: on a controller that plans for itself, else as planned here; `None` when it was not planned.
    pub fn time_s(&self) -> Option<f64> {
        self.controller.as_ref().map(|controller| controller.time_s).or(self.program.time_s)
    }

    /// The report with estimated figures.
    #[must_use]
    pub fn estimated(self, estimated: Estimated, marker: &Marker) -> Self {
        Self { controller: estimated.controller, ..self }.planned(estimated.program, marker)
    }

    /// The report with the figures of planning.
    #[must_use]
    pub fn planned(self, program: Program, marker: &Marker) -> Self {
        Self { bites: bites::of(marker, &program.by_piece), program, ..self }
    }

    /// Content of a marker, before any planning.
    pub fn of(marker: &Marker, dialect: &'static str) -> Self {
        let (width, height) = marker.extent().size();
        Self {
            dialect,
            unit_mm: marker.unit,
            extent_mm: [width, height],
            pieces: marker.piece_count(),
            contours: marker.contours().count(),
            closed_contours: marker.contours().filter(|(_, c)| c.closed).count(),
            notches: Notches::of(marker),
            drills: marker.pieces.iter().map(|p| p.drills.len()).sum(),
            labels: marker.pieces.iter().map(|p| p.labels.len()).sum(),
            cut_m: marker.cut_length() / MM_PER_M,
            common: Common::of(marker),
            near_m: Some(marker.near_length() / MM_PER_M).filter(|&length| length > 0.0),
            bites: bites::of(marker, &[]),
            drawn: marker.drawing.as_ref().map(Drawn::of),
            program: Program::default(),
            declared: Vec::new(),
            controller: None,
            edges: None,
        }
    }
}

// Serde requires these signatures.
fn micro_pair<S: Serializer>(values: &[f64; 2], out: S) -> Result<S::Ok, S::Error> {
    values.map(to_millionths).serialize(out)
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands fields over by reference")]
fn peak<S: Serializer>(value: &f64, out: S) -> Result<S::Ok, S::Error> {
    significant(*value, PEAK_DIGITS).serialize(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_printed_without_stray_decimals() {
        let peak = Peak { worst: 199_977.108_195_525_94, limit: 2e5 };
        let text = serde_json::to_string(&peak).expect("plain data");
        assert_eq!(text, r#"{"worst":199977.0,"limit":200000.0}"#);
        let report = Report {
            extent_mm: [12.800_000_000_000_011, 3.999_999_999_999_9],
            cut_m: 19.059_211_020_457_624,
            program: Program { time_s: Some(80.642_000_000_1), bulge_mm: Some(0.1), ..Program::default() },
            ..Report::of(&Marker::default(), "iso")
        };
        let json = serde_json::to_value(&report).expect("plain data");
        assert_eq!(json["extent_mm"].to_string(), "[12.8,4.0]");
        assert_eq!((json["cut_m"].to_string().as_str(), json["time_s"].to_string().as_str()), ("19.059211", "80.642"));
        assert!(json["travel_m"].is_null() && json.get("bulge_mm").is_none());
    }
}
