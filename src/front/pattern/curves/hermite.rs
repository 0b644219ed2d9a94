//! Conversion of cubics between two points to chords.

use super::leg::Stretch;
use crate::geom::{Point, Vector};

/// Maximum number of chords of one cubic; larger numbers result from damaged coordinates.
const MOST_CHORDS: f64 = 10_000.0;

/// Number of chords within `sagitta` mm of a curve. The second derivative by its parameter, from 0 to 1, is at most `bend` mm;
/// a chord over a fraction `h` deviates by `bend h^2 / 8`.
fn chords(bend: f64, sagitta: f64) -> usize {
    (bend / (8.0 * sagitta)).sqrt().ceil().clamp(1.0, MOST_CHORDS) as usize
}

/// Inner points of a cubic with given unit tangents at its ends and handles of a third of the chord.
pub(super) fn bowed([from, to]: [Point; 2], [out, into]: [Vector; 2], sagitta: f64) -> Stretch {
    let third = (to - from).norm() / 3.0;
    let [a, b] = [from + out * third, to - into * third];
    let bend = 6.0
        * f64::max((from.coords - a.coords * 2.0 + b.coords).norm(), (a.coords - b.coords * 2.0 + to.coords).norm());
    let count = chords(bend, sagitta);
    let place = |k: usize| {
        let t = k as f64 / count as f64;
        let u = 1.0 - t;
        let coords = from.coords * (u * u * u) + a.coords * (3.0 * u * u * t) + b.coords * (3.0 * u * t * t);
        Point::from(coords + to.coords * (t * t * t))
    };
    (1..count).map(place).collect()
}

/// Inner points of a spline cubic over a parameter interval of `length`, with given second derivatives at its ends.
pub(super) fn sprung([from, to]: [Point; 2], [start, end]: [Vector; 2], length: f64, sagitta: f64) -> Stretch {
    let square = length * length;
    let count = chords(f64::max(start.norm(), end.norm()) * square, sagitta);
    let place = |k: usize| {
        let t = k as f64 / count as f64;
        let u = 1.0 - t;
        let bow = start * (u * u * u - u) + end * (t * t * t - t);
        from + (to - from) * t + bow * (square / 6.0)
    };
    (1..count).map(place).collect()
}
