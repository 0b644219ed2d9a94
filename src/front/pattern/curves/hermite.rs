//! Cubics between two places, as chords.

use super::leg::Stretch;
use crate::geom::{Point, Vector};

/// Largest number of chords of one cubic: more come from damaged places.
const MOST_CHORDS: f64 = 10_000.0;

/// Number of chords that keep within `sagitta` mm of a curve whose second derivative over its parameter from 0 to 1 is at most
/// `bend` mm: a chord over a part `h` of it is `bend h^2 / 8` off.
fn chords(bend: f64, sagitta: f64) -> usize {
    (bend / (8.0 * sagitta)).sqrt().ceil().clamp(1.0, MOST_CHORDS) as usize
}

/// The places inside a cubic with these unit tangents at its ends, its handles a third of the chord long.
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

/// The places inside a cubic of a spline over a parameter `length` long, with these second derivatives at its ends.
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
