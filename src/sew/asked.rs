//! What is asked of a file beside the profile.

/// What is asked of a file beside the profile.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// What it is read as, a format or a dialect; `None` = what its content looks like.
    pub from: Option<String>,
    /// The pen or layer of a drawing whose lines are sewn; `None` = contours.
    pub line: Option<String>,
    /// How far inside closed contours are sewn, mm.
    pub inset: f64,
}
