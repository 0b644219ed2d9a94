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
