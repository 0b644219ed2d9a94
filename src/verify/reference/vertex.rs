//! A vertex of a line.

/// What is known of a point of a line, and of the chord that begins there. The last one begins none.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Vertex {
    /// Length of the line from its first point, mm.
    pub(in crate::verify) station: f64,
    /// Outward bulge of the chord in its middle, to its left, in lengths of the chord. In single precision, which is far
    /// finer than what it is guessed from: lines are most of what the verifier keeps.
    pub(in crate::verify) sagitta: f32,
    /// Source block of the chord.
    pub(in crate::verify) block: u32,
}
