//! Where the blade lies in the cloth when it is plunged.
//!
//! One model, in the order of its questions: how far the blade should and may go past the ends of a run (`overlaps`); where
//! it stands when it is plunged at the start of a path, as a chord of it (`blade`); how far the path lies beside it there
//! (`deviation`); and, when it covers all of the run, where it leaves what it is longer by, and how deep that lies in
//! parts (`cut`). Passes ask and choose. What the model is told is the run as drawn and its overlaps, so that it can be
//! asked before any pass has acted, and of a run the other way round as well.

mod blade;
mod cut;
mod deviation;
mod overlaps;

pub use blade::{PASSING_SHARE, Plunge, stands_across};
pub use cut::BladePlacement;
pub use deviation::{Deviation, REACH, WORTH_SHARE};
pub use overlaps::{Overlap, heel_share, overlaps};
