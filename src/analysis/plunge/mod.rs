//! Position of the plunged blade in the cloth.
//!
//! One model in four steps: the wanted and possible overlaps of a run (`overlaps`); the position of the blade plunged at the
//! start of a path, as a chord of it (`blade`); the deviation of the path from it (`deviation`); and, if it covers all of the
//! run, the place of its surplus length and the depth of that in parts (`cut`). Passes ask and choose. The input is the run as
//! drawn and its overlaps, so that the model can be asked before any pass has acted, and for a reversed run as well.

mod blade;
mod cut;
mod deviation;
mod overlaps;

pub use blade::{PASSING_SHARE, Plunge, stands_across};
pub use cut::{BladePlacement, Continuation};
pub use deviation::{Deviation, Leeway, REACH, WORTH_SHARE};
pub use overlaps::{Overlap, heel_share, overlaps};
