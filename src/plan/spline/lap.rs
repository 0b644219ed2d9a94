//! The lap of a ring: its smooth curve ends on its own start.
//!
//! The curve of a ring is found along a polyline that goes round more than once, so that it has the same shape near the
//! seam as elsewhere. Found by themselves, its end and its start would still lie beside each other, each inside the band, and a
//! thread of cloth would stay between the two cuts. The knots of a ring therefore repeat with each lap, and the control
//! points behind the seam are those behind the start; those before the seam lead there little by little.

use crate::geom::polyline;
use crate::ir::toolpath::{Run, Shape};

/// Control points before the seam over which the curve is led onto its start. A control point influences about ten spans.
const LED: usize = 8;
/// Breaks at an end of the spline that belong to no lap, and on which control points depend: the order of the spline.
const AT_END: usize = 6;

/// The stretch of a ring's polyline that is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plan) struct Lap {
    /// Station at which it begins, mm.
    pub(super) start: f64,
    /// Length of the ring, mm.
    pub(super) length: f64,
    /// Station up to which the curve is needed, mm: the end of the overlap, and some more.
    pub(super) last: f64,
}

impl Lap {
    /// The lap of a run whose polyline starts `start` mm before it, needed up to a station; `None` for an open run.
    pub(in crate::plan) fn of(run: &Run, start: f64, last: f64) -> Option<Self> {
        (run.shape == Shape::Ring).then(|| Self { start, length: polyline::length(&run.points), last })
    }

    /// The index of the break at which the lap begins, and how many spans it has.
    fn spans(&self, breaks: &[f64]) -> [usize; 2] {
        let at = |station: f64| {
            let next = breaks.partition_point(|&at| at < station);
            // Stations are sums: the nearest break is meant.
            if next > 0 && (next == breaks.len() || station - breaks[next - 1] < breaks[next] - station) {
                next - 1
            } else {
                next
            }
        };
        let start = at(self.start);
        [start, at(self.start + self.length) - start]
    }

    /// Whether the polyline goes round far enough before the start and behind the end for the curve to be closed.
    pub(in crate::plan) fn has_room(&self, breaks: &[f64]) -> bool {
        let [start, _] = self.spans(breaks);
        let behind = breaks.len() - breaks.partition_point(|&at| at <= self.last);
        start >= LED + AT_END && behind > AT_END + 1
    }

    /// The control points of a curve that ends on its own start.
    pub(super) fn closed(&self, mut control: Vec<[f64; 2]>, breaks: &[f64]) -> Vec<[f64; 2]> {
        let [start, spans] = self.spans(breaks);
        let Some(room) = start.checked_sub(AT_END) else { return control };
        let led = LED.min(room);
        let last = (breaks.len() - 2).saturating_sub(spans + 1);
        for i in start - led..=last {
            let share = ((i + led + 1 - start) as f64 / (led + 1) as f64).min(1.0);
            // Smoothstep: neither end of the stretch is felt.
            let share = share * share * (3.0 - 2.0 * share);
            let [own, first] = [control[i + spans], control[i]];
            control[i + spans] = [0, 1].map(|axis| own[axis] + (first[axis] - own[axis]) * share);
        }
        control
    }
}
