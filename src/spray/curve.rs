//! Reconstruction of the curves that chords stand for, in chords so short that the head runs as smoothly as on the curve.
//!
//! A CAD system flattens a curve to chords that deviate from it by some hundredths of a millimetre, or by some tenths. At a
//! distance each vertex becomes an arc and each chord a line, and a head that followed these would swing from one to the other.
//! Therefore each chord is replaced by a cubic through its ends, in the directions that the neighbouring chords give, provided
//! that it bulges by no more than permitted (`path.chord_sag_max_mm`).

use super::edge::Ring;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, left};
use crate::machine::path::{Fit, Path};
use crate::units::number::fixed;

/// Length ratio to both neighbours above which a chord is a straight side and not part of a curve.
const ALIKE: f64 = 4.0;
/// Permitted deviation of the new chords from the curve, mm; far below any tolerance.
const ACCURACY: f64 = 1e-3;

/// Turn above which a vertex between chords that are followed as straight lines is a corner, rad (half a degree).
const CORNER: f64 = 0.008_726_646_259_971_648;
/// Sagitta above which chords certainly form a polygon, mm. No export of curves is as coarse.
const POLYGON: f64 = 3.0;

/// Replaces the chords of rings by the curves that they stand for. Reports the chords that are too coarse.
pub(super) fn drawn(rings: Vec<Ring>, path: &Path, out: &mut Diagnostics) -> Vec<Ring> {
    match path.fit {
        Fit::Curve => {
            for ring in &rings {
                report(ring, path.chord_sag_max_mm, out);
            }
            rings.iter().map(|ring| smooth(ring, path.chord_sag_max_mm)).collect()
        }
        Fit::Polygon => rings,
    }
}

/// Reports chords that look like those of a curve but bulge by more than `most`, mm.
fn report(ring: &Ring, most: f64, out: &mut Diagnostics) {
    let bulge = |chord: usize| circle(ring, chord).unwrap_or(0.0);
    let coarse: Vec<usize> = (0..ring.points.len()).filter(|&i| (most..POLYGON).contains(&bulge(i))).collect();
    let Some(&worst) = coarse.iter().max_by(|&&a, &&b| bulge(a).total_cmp(&bulge(b))) else { return };
    let message = format!(
        "{} seem to stand for a curve that lies up to {} mm beside them: they are followed as straight lines",
        if coarse.len() == 1 { "one chord".to_owned() } else { format!("{} chords", coarse.len()) },
        fixed(bulge(worst), 2)
    );
    let hint = format!(
        "if it is a curve, export it in finer chords, or set `path.chord_sag_max_mm` = {}",
        fixed((10.0 * bulge(worst)).ceil() / 10.0, 1)
    );
    let finding = Diagnostic::new(&code::SPRAY_COARSE, message).hint(hint);
    out.push(finding.at(ring.spans[worst]).on_cloth(ring.points[worst]));
}

/// The ring with its curves in shorter chords. Curves bulge by at most `most` mm.
fn smooth(ring: &Ring, most: f64) -> Ring {
    let n = ring.points.len();
    let curved: Vec<bool> = (0..n).map(|chord| circle(ring, chord).is_some_and(|bulge| bulge <= most)).collect();
    let is_of_polygon =
        |vertex: usize| !curved[vertex] && !curved[ring.before(vertex)] && ring.turns[vertex].abs() > CORNER;
    let (mut points, mut spans, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    for chord in 0..n {
        let [from, to] = ring.chord(chord);
        let mut ends = if curved[chord] { directions(ring, chord, &curved) } else { [0.0; 2] };
        let bulge = bulge(ring.length(chord), ends);
        if bulge > most {
            ends = ends.map(|end| end * most / bulge);
        }
        let pieces = (bulge.min(most) / ACCURACY).sqrt().ceil().max(1.0);
        for piece in 0..pieces as usize {
            points.push(on_cubic([from, to], ends, piece as f64 / pieces));
            spans.push(ring.spans[chord]);
            corners.push(piece == 0 && (ring.is_corner(chord) || is_of_polygon(chord)));
        }
    }
    Ring::with_corners(points, spans, corners)
}

/// Bulge of a cubic over its chord, mm. `from` and `to` are the angles between its directions at the ends and the chord, rad.
fn bulge(length: f64, [from, to]: [f64; 2]) -> f64 {
    length * (from.abs() + to.abs()) / 8.0
}

/// Fraction of the turn at a vertex that falls on a chord, on the circle through the vertex and its neighbours.
fn share(ring: &Ring, chord: usize, other: usize) -> f64 {
    ring.length(chord) / (ring.length(chord) + ring.length(other))
}

/// Both sides of a chord: its vertex there, and the chord beyond it.
fn sides(ring: &Ring, chord: usize) -> [(usize, usize); 2] {
    [(chord, ring.before(chord)), (ring.behind(chord), ring.behind(chord))]
}

/// Bulge over a chord of the circles through its ends, mm; `None` if no neighbouring chord is similar in length.
fn circle(ring: &Ring, chord: usize) -> Option<f64> {
    let sides = sides(ring, chord).map(|(vertex, other)| {
        let is_alike = !ring.is_corner(vertex) && ring.length(chord) <= ALIKE * ring.length(other);
        is_alike.then(|| ring.turns[vertex] * share(ring, chord, other))
    });
    // At a corner the curve is bent as at the other end of its chord.
    let ends = [sides[0].or(sides[1])?, sides[1].or(sides[0])?];
    Some(bulge(ring.length(chord), ends))
}

/// Turn of a curve from its direction at the start to its chord, and from the chord to its direction at the end, rad; positive
/// to the left.
fn directions(ring: &Ring, chord: usize, curved: &[bool]) -> [f64; 2] {
    let at = |(vertex, other): (usize, usize)| {
        // A straight side continues tangentially in its curve.
        let share = if curved[other] { share(ring, chord, other) } else { 1.0 };
        (!ring.is_corner(vertex)).then(|| ring.turns[vertex] * share)
    };
    let [from, to] = sides(ring, chord).map(at);
    // At a corner the curve is bent as at the other end of its chord.
    [from.or(to), to.or(from)].map(Option::unwrap_or_default)
}

/// Point at a fraction of the cubic between two points (Hermite's form over the chord).
fn on_cubic([from, to]: [Point; 2], ends: [f64; 2], t: f64) -> Point {
    let slopes = [-ends[0].tan(), ends[1].tan()];
    let height = slopes[0] * t * (1.0 - t).powi(2) - slopes[1] * t * t * (1.0 - t);
    from + (to - from) * t + left(to - from) * height
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn ring(points: Vec<Point>) -> Ring {
        let spans = vec![Span::default(); points.len()];
        Ring::new(points, spans, 0.35)
    }

    #[test]
    fn the_chords_of_a_circle_become_the_circle() {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 40.0;
            Point::new(100.0 * angle.cos(), 100.0 * angle.sin())
        };
        let smooth = smooth(&ring((0..40).map(at).collect()), 1.0);
        assert!(smooth.points.len() > 400);
        assert!(smooth.points.iter().all(|point| (point.coords.norm() - 100.0).abs() < 2e-3));
    }

    #[test]
    fn straight_sides_and_coarse_polygons_stay_as_they_are() {
        let slab = [[0.0, 0.0], [450.0, 0.0], [900.0, 60.0], [900.0, 600.0], [0.0, 600.0]];
        let slab = ring(slab.map(|[x, y]| Point::new(x, y)).to_vec());
        assert_eq!(smooth(&slab, 1.0).points, slab.points);
    }
}
