//! What was cut so far.

use super::coverage::Coverage;
use super::joints::Joints;
use super::worsts::Worsts;
use crate::verify::reference::order::Order;

/// What was cut so far, as the strokes tell it.
pub(in crate::verify) struct Done<'a> {
    pub(in crate::verify) coverage: Coverage<'a>,
    pub(in crate::verify) joints: Joints<'a>,
    pub(in crate::verify) order: Order<'a>,
    pub(in crate::verify) worsts: Worsts,
}
