//! What was cut so far.

use super::coverage::Coverage;
use super::meetings::Meetings;
use super::worsts::Worsts;
use crate::verify::reference::order::Order;

/// What was cut so far, as the strokes tell it.
pub(in crate::verify) struct Done<'a> {
    pub(in crate::verify) coverage: Coverage<'a>,
    pub(in crate::verify) meetings: Meetings<'a>,
    pub(in crate::verify) order: Order<'a>,
    pub(in crate::verify) worsts: Worsts,
}
