//! Curves of plain drawings, by other formulas than the reader's: functions from a fraction of the curve to a place.

use super::tags::Item;

/// Place, in units of the file.
pub(super) type Place = [f64; 2];

/// Curve: maps a fraction of it, 0 to 1, to a place.
pub(super) type Curve = Box<dyn Fn(f64) -> Place>;

/// Number of iterations for balancing slopes: each at least halves their error, since the diagonal of a row is twice as large
/// as its neighbours.
const ROUNDS: usize = 100;
/// Greatest difference from a full turn at which an arc counts as a circle, rad.
const ROUND_EPSILON: f64 = 1e-7;
/// Greatest rounding of two written angles a turn apart, rad: they have four decimals.
const WRITTEN_EPSILON: f64 = 2.1e-4;

/// Circle, or circular arc between two angles, rad.
pub(super) fn round(item: &Item) -> Option<Curve> {
    let (centre, radius) = (item.pair([10, 20])?, item.number(40)?.abs());
    let ends = if item.kind == b"CIRCLE" { [0.0, 0.0] } else { item.pair([50, 51])?.map(f64::to_radians) };
    Some(turning(centre, [[radius, 0.0], [0.0, radius]], ends))
}

/// Ellipse, or elliptical arc. Seen from the back it turns in the opposite direction.
pub(super) fn ellipse(item: &Item, is_from_below: bool) -> Option<Curve> {
    let (centre, [x, y]) = (item.pair([10, 20])?, item.pair([11, 21])?);
    let ratio = item.number(40)?.abs() * if is_from_below { -1.0 } else { 1.0 };
    let ends = [item.number(41).unwrap_or(0.0), item.number(42).unwrap_or(0.0)];
    Some(turning(centre, [[x, y], [-y * ratio, x * ratio]], ends))
}

/// Ellipse by its centre and two semi-axes, between two angles, rad; full ellipse if these coincide.
fn turning(centre: Place, [a, b]: [Place; 2], [start, end]: [f64; 2]) -> Curve {
    let whole = std::f64::consts::TAU;
    let turn = (end - start).rem_euclid(whole);
    let is_written_whole = ((end - start).abs() - whole).abs() < WRITTEN_EPSILON;
    let is_round = is_written_whole || turn < ROUND_EPSILON || whole - turn < ROUND_EPSILON;
    let turn = if is_round { whole } else { turn };
    Box::new(move |share| {
        let angle = if is_round && share >= 1.0 { start } else { start + share * turn };
        [0, 1].map(|k| centre[k] + a[k] * angle.cos() + b[k] * angle.sin())
    })
}

/// Arc between two places with a height over the chord of half the chord times the bulge, to the right of the chord.
pub(super) fn bulge(from: Place, to: Place, bulge: f64) -> Curve {
    // Seen from the start, a place at arc angle `a` before the end appears at half that angle from the chord.
    let quarter = bulge.atan();
    Box::new(move |share| {
        if share >= 1.0 {
            return to;
        }
        // Half of the angle passed and half of the angle remaining; they add up to twice `quarter`.
        let (gone, left) = (2.0 * quarter * share, 2.0 * quarter * (1.0 - share));
        let whole = (gone + left).sin();
        if whole.abs() < f64::EPSILON {
            // A full turn or more has no chord; the other zero of the sine cannot occur.
            return from;
        }
        let way = [to[0] - from[0], to[1] - from[1]];
        // Law of sines: chord to the place : whole chord = sine of half its angle : sine of half the whole angle.
        let reach = gone.sin() / whole;
        let (sin, cos) = (-left).sin_cos();
        [from[0] + reach * (way[0] * cos - way[1] * sin), from[1] + reach * (way[0] * sin + way[1] * cos)]
    })
}

/// Spline by its control points, or through its fit points; `None` when malformed.
pub(super) fn spline(item: &Item) -> Option<Curve> {
    let all = |code: i32| item.each([code; 3]).map(|(_, number)| number).collect::<Vec<f64>>();
    let points = |codes: [i32; 2]| -> Option<Vec<Place>> {
        let [x, y] = codes.map(all);
        (x.len() == y.len()).then(|| x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
    };
    let (control, fitted) = (points([10, 20])?, points([11, 21])?);
    if control.is_empty() {
        return fit(fitted, item.number(70).is_some_and(|flags| flags as u32 & 1 != 0));
    }
    let (degree, knots, mut weights) = (item.number(71)? as usize, all(40), all(41));
    weights.resize(if weights.is_empty() { control.len() } else { weights.len() }, 1.0);
    if knots.len() != control.len() + degree + 1 || weights.len() != control.len() {
        return None;
    }
    let [first, last] = [knots[degree], knots[control.len()]];
    Some(Box::new(move |share| {
        let at = first + share * (last - first);
        let mut sums = [0.0; 3];
        // Only the control points of the span contribute; at its end the next ones begin.
        let span = knots.partition_point(|&knot| knot <= at);
        let near = span.saturating_sub(degree + 2)..control.len().min(span + 1);
        for k in near {
            let (point, weight) = (control[k], weights[k]);
            let part = weight * basis(&knots, [k, degree], at, last);
            sums = [sums[0] + part * point[0], sums[1] + part * point[1], sums[2] + part];
        }
        [sums[0] / sums[2], sums[1] / sums[2]]
    }))
}

/// B-spline basis function of a control point and a degree, by its recursive definition (Cox and de Boor); the last span
/// includes its end.
fn basis(knots: &[f64], [k, degree]: [usize; 2], at: f64, last: f64) -> f64 {
    if at < knots[k] || at > knots[k + degree + 1] {
        return 0.0;
    }
    if degree == 0 {
        let is_last = at >= last && knots[k + 1] >= last && knots[k] < last;
        return f64::from(u8::from(knots[k] <= at && at < knots[k + 1] || is_last));
    }
    let part = |over: f64, of: f64| if of > 0.0 { over / of } else { 0.0 };
    part(at - knots[k], knots[k + degree] - knots[k]) * basis(knots, [k, degree - 1], at, last)
        + part(knots[k + degree + 1] - at, knots[k + degree + 1] - knots[k + 1])
            * basis(knots, [k + 1, degree - 1], at, last)
}

/// Cubic curve through points with a continuous second derivative with respect to chord length.
fn fit(mut points: Vec<Place>, is_closed: bool) -> Option<Curve> {
    points.dedup();
    if is_closed && points.len() > 2 && points.first() == points.last() {
        points.pop();
    }
    let is_closed = is_closed && points.len() > 2;
    let count = points.len();
    let spans = if is_closed { count } else { count.checked_sub(1)? };
    if spans == 0 {
        return None;
    }
    let chord = |k: usize| {
        let [a, b] = [points[k % count], points[(k + 1) % count]];
        [b[0] - a[0], b[1] - a[1]]
    };
    let lengths: Vec<f64> = (0..spans).map(|k| chord(k)[0].hypot(chord(k)[1])).collect();
    let mut slopes = vec![[0.0; 2]; count];
    for _ in 0..ROUNDS {
        for k in 0..count {
            let before = if is_closed { Some((k + count - 1) % count) } else { k.checked_sub(1) };
            let behind = Some(k).filter(|k| *k < spans);
            slopes[k] = [0, 1].map(|axis| {
                // Each neighbour contributes three times the slope of the chord minus its own slope.
                let pull = |span: Option<usize>, other: usize| match span {
                    Some(span) => {
                        let h = lengths[span];
                        ((3.0 * chord(span)[axis] / h - slopes[other][axis]) / h, 2.0 / h)
                    }
                    None => (0.0, 0.0),
                };
                let (a, b) = (pull(before, before.unwrap_or(k)), pull(behind, (k + 1) % count));
                (a.0 + b.0) / (a.1 + b.1)
            });
        }
    }
    let whole: f64 = lengths.iter().sum();
    Some(Box::new(move |share| {
        let mut left = share * whole;
        let mut k = 0;
        while k + 1 < spans && left > lengths[k] {
            left -= lengths[k];
            k += 1;
        }
        let (h, next) = (lengths[k], (k + 1) % count);
        let t = (left / h).min(1.0);
        // Cubic Hermite interpolation from places and slopes at both ends.
        [0, 1].map(|axis| {
            let [p, q] = [points[k][axis], points[next][axis]];
            let [m, n] = [slopes[k][axis] * h, slopes[next][axis] * h];
            p + t * (m + t * (3.0 * (q - p) - 2.0 * m - n + t * (2.0 * (p - q) + m + n)))
        })
    }))
}

/// Fractions of a curve at which it may bend sharply: the knots of a spline.
pub(super) fn breaks(item: &Item) -> Vec<f64> {
    let knots: Vec<f64> = item.each([40; 3]).map(|(_, number)| number).collect();
    let degree = item.number(71).unwrap_or(3.0) as usize;
    if item.kind == b"SPLINE" && knots.is_empty() {
        // As many stretches as the curve has points: a longer one does not need more chords.
        let count = item.each([11; 3]).count().max(1);
        return (0..=count).map(|k| k as f64 / count as f64).collect();
    }
    if item.kind != b"SPLINE" || knots.len() < 2 * degree + 2 {
        return vec![0.0, 1.0];
    }
    let domain = &knots[degree..knots.len() - degree];
    let [first, last] = [domain[0], domain[domain.len() - 1]];
    let mut breaks: Vec<f64> = domain.iter().map(|knot| (knot - first) / (last - first)).collect();
    breaks.dedup();
    breaks
}
