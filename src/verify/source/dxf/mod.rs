//! A second, small reading of DXF by other means than the readers'.
//!
//! Of patterns: where layers ask for cuts, notches and holes. It joins no lines and makes no notches: it holds every place of
//! the marker against the places of the file. Of plain drawings: [`plain`] follows all that is drawn, along `curve`s.

mod again;
mod cloth;
mod compare;
mod curve;
mod curves;
mod cuts;
mod fold;
mod left_out;
mod letters;
mod lines;
mod lookup;
mod places;
pub(super) mod plain;
mod stretch;
mod tags;

pub use compare::pattern_audit;
pub use places::CutPlaces;
