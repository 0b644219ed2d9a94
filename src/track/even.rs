//! Smoothing: readings of the cloth's centre, in steps of half a pitch, become a smooth line.

/// Number of averaging bins per smoothing length, so that a long log does not give many points to fit.
const BINS: f64 = 32.0;
/// Minimum distance of rows, mm: two units of the last printed decimal.
const STEP: f64 = 0.002;

/// The smooth line through readings (conveyor position, never decreasing, and centre, mm). Each point is the value of the
/// parabola that best fits the readings within half of `length` (least squares; Savitzky and Golay 1964), which preserves slope
/// and curvature. Readings closer than a thirty-second of the length are averaged first.
pub(super) fn even(readings: &[[f64; 2]], length: f64) -> Vec<[f64; 2]> {
    let means = means(readings, (length / BINS).max(STEP));
    let before = |place: f64| means.partition_point(|[at, _]| *at < place);
    let evened = |[at, mean]: &[f64; 2]| {
        let near = &means[before(at - length / 2.0)..before(at + length / 2.0 + STEP)];
        [*at, fit(near, *at).unwrap_or(*mean)]
    };
    let mut line: Vec<[f64; 2]> = means.iter().map(evened).collect();
    // The line extends over the full range of the readings.
    if let ([first, .., last], [[from, _], .., [to, _]]) = (&mut line[..], readings) {
        for (row, at) in [(first, *from), (last, *to)] {
            *row = evened(&[at, row[1]]);
        }
    }
    line
}

/// Means of groups of readings; each group spans less than `within` mm from its first reading.
fn means(readings: &[[f64; 2]], within: f64) -> Vec<[f64; 2]> {
    let mut means: Vec<[f64; 2]> = Vec::new();
    let mut rest = readings;
    while let Some([first, _]) = rest.first() {
        let count = rest.iter().take_while(|[at, _]| *at - first < within).count();
        let sum = rest[..count].iter().fold([0.0; 2], |sum, row| [sum[0] + row[0], sum[1] + row[1]]);
        let mean = sum.map(|sum| sum / count as f64);
        // Two means may be closer than the averaging distance, if the conveyor stands and then moves.
        if means.last().is_none_or(|last| mean[0] - last[0] >= STEP) {
            means.push(mean);
        }
        rest = &rest[count..];
    }
    means
}

/// The value at a position of the parabola that best fits the points; `None` for fewer than five points or without a finite
/// solution.
fn fit(points: &[[f64; 2]], at: f64) -> Option<f64> {
    if points.len() < 5 {
        return None;
    }
    let scale = points.iter().map(|[x, _]| (x - at).abs()).fold(0.0, f64::max);
    // Sums of powers of the distance, and of these times the value.
    let (mut s, mut b) = ([0.0; 5], [0.0; 3]);
    for [x, y] in points {
        let x = (x - at) / scale;
        let powers = [1.0, x, x * x, x * x * x, x * x * x * x];
        s.iter_mut().zip(powers).for_each(|(sum, power)| *sum += power);
        b.iter_mut().zip(powers).for_each(|(sum, power)| *sum += power * y);
    }
    // The constant term by Cramer's rule; distinct points make the determinant positive.
    let det = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let whole = det([[s[0], s[1], s[2]], [s[1], s[2], s[3]], [s[2], s[3], s[4]]]);
    let value = det([[b[0], s[1], s[2]], [b[1], s[2], s[3]], [b[2], s[3], s[4]]]) / whole;
    // At a jump of the cloth a parabola overshoots; the value is limited to the range of the readings.
    let [least, most] =
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], [_, y]| [least.min(*y), most.max(*y)]);
    value.is_finite().then(|| value.clamp(least, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_stays_as_it_is() {
        let readings: Vec<[f64; 2]> = (0..400).map(f64::from).map(|x| [x, 3.0 - 0.02 * x + 1e-4 * x * x]).collect();
        let line = even(&readings, 60.0);
        let (first, last) = (0, line.len() - 1);
        for (i, [x, y]) in line.into_iter().enumerate() {
            // At its ends the line stays within the range of the nearby readings.
            let accuracy = if i == first || i == last { 0.1 } else { 1e-3 };
            assert!((y - (3.0 - 0.02 * x + 1e-4 * x * x)).abs() < accuracy, "{x} {y}");
        }
    }

    #[test]
    fn steps_of_readings_are_evened() {
        // Cloth that wanders by 8 mm over a metre, measured to half a millimetre.
        let wander = |x: f64| 8.0 * (x * std::f64::consts::TAU / 1000.0).sin();
        let readings: Vec<[f64; 2]> =
            (0..2000).map(|i| f64::from(i) * 2.0).map(|x| [x, (wander(x) * 2.0).round() / 2.0]).collect();
        let worst = even(&readings, 100.0).iter().map(|[x, y]| (y - wander(*x)).abs()).fold(0.0, f64::max);
        assert!(worst < 0.25, "{worst}");
    }

    #[test]
    fn a_conveyor_that_stands_is_one_place() {
        assert_eq!(even(&[[0.0, 1.0], [0.0, 3.0], [10.0, 5.0], [10.0, 5.0]], 0.0), [[0.0, 2.0], [10.0, 5.0]]);
        assert!(even(&[], 10.0).is_empty());
    }
}
