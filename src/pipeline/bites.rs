//! Windows of a conveyor in which a marker is cut.

use std::ops::Range;

use serde::Serialize;

use super::rounded::{micro, micro_known};
use super::spent::Spent;
use crate::ir::Marker;
use crate::units::MM_PER_M;

/// Window of a conveyor: the cuts made while the cloth lies still.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bite {
    /// Advance of the cloth before it, in all, mm.
    pub advance_mm: u32,
    /// Number of pieces.
    pub pieces: usize,
    /// Length of the cuts, m.
    #[serde(serialize_with = "micro")]
    pub cut_m: f64,
    /// Duration, s; `None` if nothing was planned.
    #[serde(serialize_with = "micro_known")]
    pub time_s: Option<f64>,
}

/// Windows of a marker, in order, with the planned durations of its pieces; empty if the cloth does not move.
pub(super) fn of(marker: &Marker, by_piece: &[([u32; 2], Spent)]) -> Vec<Bite> {
    let windows = marker.windows();
    if windows.last().is_none_or(|&(last, _)| last == 0) {
        return Vec::new();
    }
    // Index of the window of each part.
    let of_part: Vec<usize> =
        windows.iter().enumerate().flat_map(|(k, (_, pieces))| pieces.clone().map(move |_| k)).collect();
    let bite = |(advance_mm, pieces): (u32, Range<usize>)| {
        let cut: f64 = pieces.clone().map(|part| marker.cut_length_of(part as u32)).sum();
        Bite { advance_mm, pieces: pieces.len(), cut_m: cut / MM_PER_M, time_s: None }
    };
    let mut bites: Vec<Bite> = windows.into_iter().map(bite).collect();
    for ([_, part], spent) in by_piece {
        let Some(&window) = of_part.get(*part as usize) else { continue };
        *bites[window].time_s.get_or_insert(0.0) += spent.total();
    }
    bites
}
