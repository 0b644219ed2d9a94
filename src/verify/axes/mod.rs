//! Checks of axes and outputs that do not depend on the cut: limits, rests, table, crawling, events.
//!
//! Input: rows as they come, and the profile. Output: the worst value of each rule on axes and outputs. The cut itself is
//! verified elsewhere.

pub(super) mod crawl;
pub(super) mod differences;
pub(super) mod events;
pub(super) mod limits;
pub(super) mod rest;
pub(super) mod table;
