//! State of the verification of strokes.

use super::coverage::Coverage;
use super::meetings::Meetings;
use super::worsts::Worsts;
use crate::verify::reference::order::Order;

/// Coverage, meetings, order and worst values after the strokes so far.
pub(in crate::verify) struct Done<'a> {
    pub(in crate::verify) coverage: Coverage<'a>,
    pub(in crate::verify) meetings: Meetings<'a>,
    pub(in crate::verify) order: Order<'a>,
    pub(in crate::verify) worsts: Worsts,
}
