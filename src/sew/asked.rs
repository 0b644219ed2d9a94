//! Choices for a file in addition to the profile.

/// Choices for a file in addition to the profile.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// Format or dialect to read it as; `None` for detection by content.
    pub from: Option<String>,
    /// Pen or layer of a drawing whose lines are sewn; `None` for contours.
    pub line: Option<String>,
    /// Distance of the seam inside closed contours, mm.
    pub inset: f64,
}
