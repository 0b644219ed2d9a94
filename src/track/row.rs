//! A row of a log: the readings at a time and optional positions.

/// Maximum position, mm: no conveyor is as long.
pub(super) const FARTHEST: f64 = 1e9;

/// A sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time of the reading, s.
    pub time: f64,
    /// I and J: covered sensors of the rulers over the left and the right edge.
    pub covered: [u16; 2],
    /// I and J of the rulers upstream; `None` if there are none.
    pub upstream: Option<[u16; 2]>,
    /// Position of the conveyor, mm.
    pub conveyor: Option<f64>,
    /// Position of the carriage, mm.
    pub carriage: Option<f64>,
    /// Byte offset of the row in its file; `None` for a simulated row.
    pub start: Option<u32>,
}
