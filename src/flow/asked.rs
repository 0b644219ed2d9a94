//! What is asked of a marker beside the profile.

/// How fast the conveyor runs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Speed {
    /// As the profile has it (`flow.speed_mm_s`).
    #[default]
    Profile,
    /// So fast, mm/s.
    Of(f64),
    /// As fast as the heads can follow.
    Most,
}

/// By how much the cloth lies farther to +Y than it should when the conveyor is at a position, mm for mm: what a tracker of
/// its centre found.
pub type Shift<'a> = &'a (dyn Fn(f64) -> f64 + Sync);

/// Cloth that lies where it should.
pub fn straight(_: f64) -> f64 {
    0.0
}
