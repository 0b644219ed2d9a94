//! Ends of open cuts beside a corner of another outline along whose next edge they would run: both go straight on, past the
//! corner, until they have crossed. Neither bends, and no edge is cut twice.

use super::lead::{Arrival, LEAST_COSINE, LEAST_SINE, Leads, Neighbour};
use super::ring::Ring;
use super::stretch::BREAK;
use crate::geom::{Point, angle, cross};

/// Least length of a straight edge at such a corner, in blade widths: a shorter one may be cut by plunges with their ends
/// elsewhere, or its corner may be due to rounding.
const STRAIGHT: f64 = 2.0;
/// Greatest distance beside the corner at which the open cut may pass, in multiples of the merge tolerance.
const BESIDE: f64 = std::f64::consts::SQRT_2;

/// Two cuts that continue until they have crossed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Past {
    /// End of the open cut.
    pub(super) end: Point,
    /// Corner of the outline, and the end of its extension from there.
    pub(super) corner: [Point; 2],
}

impl Leads<'_> {
    /// Crossing of an arriving cut with a neighbour's cut, each past the end of its own edge; `None` if the neighbour has no
    /// corner there along whose next edge the cut would run.
    pub(super) fn past_corner(&self, arrival: Arrival, to: Neighbour) -> Option<Past> {
        let (ring, reach) = (&self.rings[to.ring], BREAK * self.asked.near.distance);
        let straight = STRAIGHT * self.asked.width;
        let is_fit = |&corner: &f64| {
            let about = [corner - straight, corner + straight];
            let is_straight =
                ring.vertices([about[0], corner]).chain(ring.vertices([corner, about[1]])).next().is_none();
            is_straight && self.is_cut(to.ring, about)
        };
        let mut corners = ring.vertices([to.station - reach, to.station + reach]).filter(is_fit);
        corners.find_map(|corner| [true, false].into_iter().find_map(|before| self.past(ring, corner, before, arrival)))
    }

    /// Crossing at one corner, with the edge `before` or behind it.
    fn past(&self, ring: &Ring, corner: f64, before: bool, Arrival { at, along, .. }: Arrival) -> Option<Past> {
        let (edge, next) = (ring.arriving(corner, before), -ring.arriving(corner, !before));
        let sine = cross(along, edge);
        let is_corner = angle::is_turned(edge, next, self.asked.corner);
        if sine.abs() < LEAST_SINE || next.dot(&along) < LEAST_COSINE || !is_corner {
            return None;
        }
        // at + ahead * along = place + beside * edge
        let place = ring.place(corner);
        let ahead = cross(place - at, edge) / sine;
        let beside = cross(place - at, along) / sine;
        let (near, margin) = (self.asked.near.distance, self.asked.beyond / sine.abs());
        let is_near = ahead.abs() <= BREAK * near && (-BREAK * near..=BESIDE * near).contains(&beside);
        is_near.then(|| Past {
            end: at + along * (ahead + margin).max(0.0),
            corner: [place, place + edge * (beside + margin).max(0.0)],
        })
    }
}
