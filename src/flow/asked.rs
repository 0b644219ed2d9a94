//! Options of flow planning that are not part of the profile.

/// Speed of the conveyor.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Speed {
    /// The speed of the profile (`flow.speed_mm_s`).
    #[default]
    Profile,
    /// A given speed, mm/s.
    Of(f64),
    /// The greatest speed at which the heads can follow.
    Most,
}
