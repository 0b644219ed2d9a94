//! The lap of a ring: its smooth curve ends at its own start.
//!
//! The curve of a ring is computed along a polyline that goes round more than once, so that it has the same shape near the seam
//! as elsewhere. Its end and its start would nevertheless lie side by side within the band and leave a thread of cloth between
//! the two cuts. The knots of a ring therefore repeat with each lap. The control points after the seam are those after the
//! start, and those before the seam blend into them gradually.

use crate::geom::polyline;
use crate::ir::toolpath::{Run, Shape};

/// Number of control points before the seam over which the curve blends into its start. A control point influences about ten
/// spans.
const LED: usize = 8;
/// Number of breaks at an end of the spline that belong to no lap but influence control points: the order of the spline.
const AT_END: usize = 6;

/// The part of a ring's polyline that is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plan) struct Lap {
    /// Station of its start, mm.
    pub(super) start: f64,
    /// Length of the ring, mm.
    pub(super) length: f64,
    /// Station up to which the curve is needed, mm: the end of the overlap plus a margin.
    pub(super) last: f64,
}

impl Lap {
    /// The lap of a run whose polyline starts `start` mm before it, needed up to the station `last`; `None` for an open run.
    pub(in crate::plan) fn of(run: &Run, start: f64, last: f64) -> Option<Self> {
        (run.shape == Shape::Ring).then(|| Self { start, length: polyline::length(&run.points), last })
    }

    /// Index of the break at the start of the lap, and its number of spans.
    fn spans(&self, breaks: &[f64]) -> [usize; 2] {
        let at = |station: f64| {
            let next = breaks.partition_point(|&at| at < station);
            // Stations are sums with rounding: use the nearest break.
            if next > 0 && (next == breaks.len() || station - breaks[next - 1] < breaks[next] - station) {
                next - 1
            } else {
                next
            }
        };
        let start = at(self.start);
        [start, at(self.start + self.length) - start]
    }

    /// True if the polyline extends far enough before the start and after the end to close the curve.
    pub(in crate::plan) fn has_room(&self, breaks: &[f64]) -> bool {
        let [start, _] = self.spans(breaks);
        let behind = breaks.len() - breaks.partition_point(|&at| at <= self.last);
        start >= LED + AT_END && behind > AT_END + 1
    }

    /// The control points of a curve that ends at its own start.
    pub(super) fn closed(&self, mut control: Vec<[f64; 2]>, breaks: &[f64]) -> Vec<[f64; 2]> {
        let [start, spans] = self.spans(breaks);
        let Some(room) = start.checked_sub(AT_END) else { return control };
        let led = LED.min(room);
        let last = (breaks.len() - 2).saturating_sub(spans + 1);
        for i in start - led..=last {
            let share = ((i + led + 1 - start) as f64 / (led + 1) as f64).min(1.0);
            // Smoothstep, so that neither end of the blend is noticeable.
            let share = share * share * (3.0 - 2.0 * share);
            let [own, first] = [control[i + spans], control[i]];
            control[i + spans] = [0, 1].map(|axis| own[axis] + (first[axis] - own[axis]) * share);
        }
        control
    }
}
