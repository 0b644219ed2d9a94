//! Vertex of a line.

/// Data of a point of a line and of the chord that begins there. No chord begins at the last point.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Vertex {
    /// Length of the line from its first point, mm.
    pub(in crate::verify) station: f64,
    /// Bulge of the chord at its middle, to its left, in lengths of the chord. Single precision is far finer than the estimate
    /// behind it and saves memory: lines are most of the verifier's data.
    pub(in crate::verify) sagitta: f32,
    /// Source block of the chord.
    pub(in crate::verify) block: u32,
}
