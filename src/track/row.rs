//! A row of a log: what was read at a time, and what else is known of it.

/// Farthest places, mm: no conveyor is as long.
pub(super) const FARTHEST: f64 = 1e9;

/// A sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// When it was read, s.
    pub time: f64,
    /// I and J: covered sensors of the rulers over the left and the right edge.
    pub covered: [u16; 2],
    /// The same upstream.
    pub upstream: Option<[u16; 2]>,
    /// Where the conveyor was, mm.
    pub conveyor: Option<f64>,
    /// Where the carriage was, mm.
    pub carriage: Option<f64>,
    /// The byte at which the row begins; `None` for one that is in no file.
    pub start: Option<u32>,
}
