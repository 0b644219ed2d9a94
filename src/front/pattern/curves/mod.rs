//! Curves between the vertices of a line: layer 1 has the corners of an outline and a few points of its curves; layers 8, 11
//! and 14 have those of other lines.
//!
//! Receives the lines of a block, joined and unfolded, with its points. Promises each line as the CAD system draws it: along
//! the [`fine`] line of layers 84 to 87 that passes all of its vertices; otherwise along a curve by the [`rule`] of the system
//! between turn points, straight where there is no curve point, as given by its [`nodes`]; otherwise unchanged. Never leaves a
//! vertex: one that [`gerber`] adds for a notch lies within a hundredth of a millimetre of the curve, or is one of its
//! [`knots`].

mod block;
mod count;
mod curve;
mod drafting;
mod fine;
mod gerber;
mod hermite;
mod knots;
mod leg;
mod lend;
mod nodes;
mod rule;
mod run;
mod spikes;
mod spline;
mod split;

pub(super) use block::Curves;
pub(super) use count::{CurveCount, CurveCounts};
pub(super) use drafting::Drafting;
pub(super) use lend::{Size, lend};
pub(super) use nodes::Nodes;
