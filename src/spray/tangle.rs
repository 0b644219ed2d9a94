//! Check for edges that cross, touch or run back upon each other. Inside and outside are ambiguous there, and no offset is
//! defined.

use super::edge::Ring;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, polyline};

/// Distance below which edges meet, mm; finer than the resolution of any file.
const MEET_EPSILON: f64 = 1e-6;
/// Cosine of the turn at which a chord runs back upon the previous one: a half turn, except for rounding.
const BACK: f64 = -1.0 + 1e-9;

/// A chord: the index of its ring, and its index in the ring.
type Chord = [usize; 2];

/// Reports the first place at which edges meet.
pub(super) fn report(rings: &[Ring], out: &mut Diagnostics) {
    let Some([ring, chord]) = first(rings) else { return };
    let message =
        "an edge crosses, touches or runs back upon another or itself: a head has no outside to follow it from";
    let hint = "draw each part by one line that does not meet itself, with room for the head between parts";
    let ring = &rings[ring];
    out.push(
        Diagnostic::new(&code::SPRAY_TANGLED, message).at(ring.spans[chord]).on_cloth(ring.points[chord]).hint(hint),
    );
}

/// The first chord that meets an earlier one, or at which the work budget is exhausted.
fn first(rings: &[Ring]) -> Option<Chord> {
    let chords: Vec<Chord> =
        rings.iter().enumerate().flat_map(|(i, ring)| (0..ring.points.len()).map(move |chord| [i, chord])).collect();
    let ends = |[ring, chord]: Chord| rings[ring].chord(chord);
    let extent = |&chord: &Chord| {
        let [from, to] = ends(chord);
        Extent::between(from, to).grown(MEET_EPSILON)
    };
    let boxes = Boxes::new(chords.iter().map(extent).collect());
    let mut work = Budget::of_a_marker();
    for (i, &chord) in chords.iter().enumerate() {
        let [ring, place] = chord;
        let (of, around) = (&rings[ring], boxes.all()[i]);
        if !work.spend(boxes.cost_near(&around)) || of.along(of.before(place)).dot(&of.along(place)) < BACK {
            return Some(chord);
        }
        let follows = |other: Chord| other[0] == ring && (of.before(place) == other[1] || of.before(other[1]) == place);
        let meets = |other: Chord| polyline::distance_of_segments(ends(chord), ends(other)) <= MEET_EPSILON;
        let mut others = boxes.near(around).filter(|&k| k < i).map(|k| chords[k]);
        if others.any(|other| !follows(other) && meets(other)) {
            return Some(chord);
        }
    }
    None
}
