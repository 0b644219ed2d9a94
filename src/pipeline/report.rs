//! What a compile has to tell about its input and its program: the figures of the summary.
//!
//! Serialised figures are rounded, all of them here: lengths and times far below what a machine resolves, peaks to
//! [`PEAK_DIGITS`]. What is kept in memory is not.

use serde::{Serialize, Serializer};

use super::bites::{self, Bite};
use super::rounded::{micro, micro_known, significant, to_millionths};
use super::savings::Savings;
use super::spent::Spent;
use crate::back::Estimate;
use crate::geom::polyline;
use crate::ir::declaration::Total;
use crate::ir::drawing::{Account, LayerLines, LineClass};
use crate::ir::marker::{NotchForm, NotchKind};
use crate::ir::{self, Marker};
use crate::machine::{Follow, NotchStyle};
use crate::spray;
use crate::units::{MM_PER_M, deg};

/// Significant digits of a peak.
const PEAK_DIGITS: i32 = 6;

/// The figures of one file; `None` is what only planning knows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Name of the dialect that was read.
    pub dialect: &'static str,
    /// What the numbers of the file are multiples of, mm; 0 when they are not rounded.
    #[serde(serialize_with = "micro")]
    pub unit_mm: f64,
    /// Width and height of everything that is cut or drilled, mm.
    #[serde(serialize_with = "micro_pair")]
    pub extent_mm: [f64; 2],
    /// Pieces.
    pub pieces: usize,
    /// Contours, closed and open.
    pub contours: usize,
    /// Contours that end where they start.
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
    /// What is cut once for two parts; not there where nothing is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub common: Option<Common>,
    /// Length of the near lines, m: where edges of two parts run beside each other and both are cut, each counts; not there
    /// where nothing is.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "micro_known")]
    pub near_m: Option<f64>,
    /// Windows of a conveyor, in order; not there where the cloth lies still.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bites: Vec<Bite>,
    /// Of a plot: what its lines were taken for.
    #[serde(flatten)]
    pub drawn: Option<Drawn>,
    /// What planning adds.
    #[serde(flatten)]
    pub program: Program,
    /// What the program does beside the drawing because it cannot do otherwise, by kind.
    pub declared: Vec<Total>,
    /// What a controller that plans for itself makes of the program; not there without such a target.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub controller: Option<Controller>,
    /// How a head follows each edge at its distance; not there with another tool.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edges: Option<Vec<spray::Edge>>,
}

/// Edges that are cut once for two parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Common {
    /// How many there are.
    pub edges: usize,
    /// Their length, m.
    #[serde(serialize_with = "micro")]
    pub length_m: f64,
    /// How much less is cut than if every part were cut all round, m: less than their length, since open cuts are led on.
    #[serde(serialize_with = "micro")]
    pub spared_m: f64,
    /// How far one of them is from where it is cut at the most, mm.
    #[serde(serialize_with = "micro")]
    pub shift_mm: f64,
    /// Each of them, in the order of the pieces that are spared.
    pub all: Vec<CommonEdge>,
}

/// An edge that is cut once for two parts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CommonEdge {
    /// The number of the piece that it is cut with.
    pub piece: u32,
    /// That of the piece that is spared it.
    pub spared: u32,
    /// The copies of the marker that the two are of, from 1; not there where there is but one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies: Option<[u32; 2]>,
    /// Its length, m.
    #[serde(serialize_with = "micro")]
    pub length_m: f64,
    /// How far that of the piece that is spared is from there at the most, mm.
    #[serde(serialize_with = "micro")]
    pub shift_mm: f64,
}

impl Common {
    /// Those of a marker.
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Controller {
    /// How long that is likely to take, s.
    #[serde(serialize_with = "micro")]
    pub time_s: f64,
    /// Arcs and lines with the knife down.
    pub moves: usize,
}

impl From<Estimate> for Controller {
    fn from(Estimate { time, moves }: Estimate) -> Self {
        Self { time_s: time, moves }
    }
}

/// The lines of a plot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Drawn {
    /// Way of the pen while it is down, mm; lettered texts are not in it.
    #[serde(serialize_with = "micro")]
    pub pen_down_mm: f64,
    /// Texts that stand in no part, and so belong to no piece.
    pub texts_outside: usize,
    /// What the lines were taken for; classes without any are left out.
    pub lines: Vec<Lines>,
    /// The layers of a drawing that has such.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<Layer>,
}

/// Lines of a layer of a drawing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Layer {
    /// Name of the layer.
    pub name: String,
    /// What is said of its lines.
    pub used: &'static str,
    /// How many there are.
    pub count: usize,
    /// Length as drawn, mm.
    #[serde(serialize_with = "micro")]
    pub length_mm: f64,
}

/// Lines of a plot that were taken for the same thing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lines {
    /// What they were taken for.
    pub class: &'static str,
    /// How such lines are told from others.
    pub about: &'static str,
    /// Whether they are cut or drilled.
    pub cut: bool,
    /// How many there are.
    pub count: usize,
    /// Length as drawn, mm; that of notches in an outline counts with it.
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
    /// Of the outlines, those that stand out of the part.
    #[serde(rename = "v-out")]
    pub v_out: usize,
    /// Rectangles that stand out.
    #[serde(rename = "castle-out")]
    pub castle_out: usize,
    /// Round ones that stand out.
    #[serde(rename = "u-out")]
    pub u_out: usize,
}

impl Notches {
    /// Those of a marker.
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
    /// Way of the C axis with the knife up, m.
    #[serde(serialize_with = "micro_known")]
    pub travel_m: Option<f64>,
    /// Times that the knife goes down: runs and plunge cuts.
    pub runs: Option<usize>,
    /// How notches are cut.
    pub notch_style: Option<NotchStyle>,
    /// How the blade lies on curves.
    pub follow: Option<Follow>,
    /// Cuts whose blade lies along the tangent, because it cannot be a chord of a curve on them, although it should.
    pub tangent_runs: Option<usize>,
    /// Plunges without motion.
    #[serde(rename = "stabs")]
    pub plunge_cuts: Option<usize>,
    /// Times that the knife goes up.
    pub lifts: Option<usize>,
    /// Duration of the program, s.
    #[serde(serialize_with = "micro_known")]
    pub time_s: Option<f64>,
    /// Where the blade goes beyond the ends of its cuts.
    pub sides: Option<Sides>,
    /// Where that time goes.
    pub spent: Option<Spent>,
    /// What it could save.
    pub savings: Option<Savings>,
    /// The same for each piece by its number and its place in the marker, in cut order.
    #[serde(skip)]
    pub by_piece: Vec<([u32; 2], Spent)>,
    /// The farthest that the way of the knife bulges beyond the chords of flattened curves, mm.
    #[serde(skip)]
    pub bulge_mm: Option<f64>,
    /// The greatest speed, acceleration and jerk of each axis beside its limit.
    pub axes: Option<Axes>,
}

/// What was done so that the blade cuts beyond the ends of its cuts where it harms nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Sides {
    /// Ends behind which the part itself lies.
    pub inside: usize,
    /// Overlaps that a gap shortens.
    pub shortened: usize,
    /// Cuts that go the other way round than the file has them.
    pub turned: usize,
    /// Cuts that the back edge of the blade makes.
    pub backwards: usize,
    /// Plunge cuts that cut into a part.
    pub harmful: usize,
    /// How deep the worst of them lies in one, mm.
    #[serde(serialize_with = "micro")]
    pub overcut_mm: f64,
    /// Plunge cuts that cut into another part than their own.
    pub trespassing: usize,
    /// How deep the worst of them lies in one, mm.
    #[serde(serialize_with = "micro")]
    pub neighbour_overcut_mm: f64,
    /// Cuts that go on where the knife is lifted amid a contour.
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
    /// What the profile allows.
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
    /// What the program takes, s, as planned here or as a controller is likely to; `None` when it was not planned.
    pub fn time_s(&self) -> Option<f64> {
        self.program.time_s.or(self.controller.map(|controller| controller.time_s))
    }

    /// The report with what planning found of its marker.
    #[must_use]
    pub fn planned(self, program: Program, marker: &Marker) -> Self {
        Self { bites: bites::of(marker, &program.by_piece), program, ..self }
    }

    /// What is in a marker, before any planning.
    pub fn of(marker: &Marker, dialect: &'static str) -> Self {
        let (width, height) = marker.extent().size();
        Self {
            dialect,
            unit_mm: marker.unit,
            extent_mm: [width, height],
            pieces: marker.wholes().len(),
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

// The signatures are those that serde calls.
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
