//! What the axes and outputs do, whatever is cut: limits, rests, the table, crawling, events.

pub(super) mod crawl;
pub(super) mod events;
pub(super) mod limits;
pub(super) mod rest;
pub(super) mod table;
