//! Windows of a conveyor in which a marker is cut.

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
    let stations = marker.stations();
    if stations.last().is_none_or(|&last| last == 0) {
        return Vec::new();
    }
    let mut bites: Vec<Bite> = Vec::new();
    // Index of the window of each part.
    let mut of_part = Vec::with_capacity(stations.len());
    for (part, &advance_mm) in (0..).zip(&stations) {
        if bites.last().is_none_or(|last| last.advance_mm != advance_mm) {
            bites.push(Bite { advance_mm, pieces: 0, cut_m: 0.0, time_s: None });
        }
        of_part.push(bites.len() - 1);
        let bite = &mut bites[of_part[of_part.len() - 1]];
        bite.pieces += 1;
        bite.cut_m += marker.cut_length_of(part) / MM_PER_M;
    }
    for ([_, part], spent) in by_piece {
        let Some(&window) = of_part.get(*part as usize) else { continue };
        *bites[window].time_s.get_or_insert(0.0) += spent.total();
    }
    bites
}
