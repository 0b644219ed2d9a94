//! A second, small reading of pattern DXF: where its layers ask for cuts, notches and holes, by other means than the
//! reader's. It joins no lines and makes no notches: it holds every place of the marker against the places of the file.

mod again;
mod cloth;
mod compare;
mod curves;
mod cuts;
mod left_out;
mod letters;
mod lines;
mod lookup;
mod places;
mod tags;

pub use compare::pattern_audit;
pub use places::CutPlaces;
