//! How notches are cut.

use serde::{Deserialize, Serialize};

use super::word::{AsDrawn, OrWord};

/// How notches are cut, whatever the file draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Notches {
    /// Which shape they get.
    pub style: NotchStyle,
    /// How deep slits go into the part, mm.
    #[serde(with = "OrWord::<AsDrawn>")]
    pub depth_mm: Option<f64>,
    /// Boxes up to so wide are slits, mm.
    pub box_max_mm: f64,
}

impl Default for Notches {
    fn default() -> Self {
        Self { style: NotchStyle::AsDrawn, depth_mm: None, box_max_mm: 0.6 }
    }
}

/// The shape of notches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NotchStyle {
    /// As the file draws them.
    #[default]
    AsDrawn,
    /// Notches of all kinds as slits: one straight cut from the edge into the part.
    Slit,
    /// None is cut: the outline runs straight over their mouths.
    Skip,
}
