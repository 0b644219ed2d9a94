//! What the axes and outputs do, whatever is cut: limits, rests, the table, crawling, events.
//!
//! Receives rows as they come and the profile, promises the worst value of each rule on axes and outputs. Never judges what
//! is cut.

pub(super) mod crawl;
pub(super) mod differences;
pub(super) mod events;
pub(super) mod limits;
pub(super) mod rest;
pub(super) mod table;
