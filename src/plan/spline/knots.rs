//! Knots of the path spline: their spacing depends on the shape, not on the length.
//!
//! At a vertex with turn `th` the rounding inside a band of `tol` is about `4 tol / th` long, so the spacing there is a
//! fraction of that. Away from vertices the spacing grows in proportion to the distance. Long straight chords cost next to
//! nothing.

use std::ops::Range;

use super::band::ToleranceBand;
use super::lap::Lap;

/// Knot spacing at a vertex, as a fraction of the length of its rounding.
const SHARE_OF_ROUNDING: f64 = 0.5;
/// Growth of the spacing with the distance from a vertex.
const GROWTH: f64 = 0.5;
/// Minimum spacing, mm: far below any tolerance.
const SPACING_MIN: f64 = 0.02;
/// Turn below which a vertex is treated as straight, rad.
const TURN_EPSILON: f64 = 1e-4;
/// Maximum spacing at the ends of a run, mm, and as a fraction of its length.
const END_SPACING: f64 = 2.0;
const END_SHARE: f64 = 1.0 / 6.0;
/// Rounding of a station, mm.
const STATION_EPSILON: f64 = 1e-6;
/// Minimum number of spans of a spline.
const SPANS_MIN: usize = 5;

/// The breaks of a spline over the band's stations; `finer` has a factor on the spacing at each vertex.
pub(super) fn breaks(band: &ToleranceBand, finer: &[f64]) -> Vec<f64> {
    match &band.lap {
        None => spread(&spacing_at_vertices(band, finer), &band.stations),
        Some(lap) => repeated(band, finer, lap),
    }
}

/// The breaks of a ring: those of its lap repeated, and the ends of its polyline.
fn repeated(band: &ToleranceBand, finer: &[f64], lap: &Lap) -> Vec<f64> {
    let vertex = |station: f64| band.stations.partition_point(|&at| at < station - STATION_EPSILON);
    let [from, to] = [vertex(lap.start), vertex(lap.start + lap.length)];
    let once = spread(&spacing_on_lap(band, finer, from..to), &band.stations[from..=to]);
    let (length, first) = (band.length(), once[0]);
    let [before, behind] = [(lap.start / lap.length).ceil(), ((length - lap.start) / lap.length).ceil()];
    let laps = (-before as i64..behind as i64).map(|k| lap.start - first + k as f64 * lap.length);
    let all = laps.flat_map(|by| once[..once.len() - 1].iter().map(move |at| at + by));
    let mut breaks = vec![0.0];
    let apart = |a: f64, b: f64| b - a > SPACING_MIN;
    breaks.extend(all.filter(|&at| apart(0.0, at) && apart(at, length)));
    breaks.push(length);
    breaks
}

/// Spacing at the vertices of a lap, mm, whose last vertex is its first one again. Each is the minimum over the images of the
/// vertex in all laps.
fn spacing_on_lap(band: &ToleranceBand, finer: &[f64], lap: Range<usize>) -> Vec<f64> {
    let (count, last) = (lap.len(), band.points.len() - 1);
    let mut spacing = vec![f64::INFINITY; count];
    for (i, finer) in finer.iter().enumerate().take(last).skip(1) {
        let j = (i + count - lap.start % count) % count;
        spacing[j] = spacing[j].min(at_vertex(band, i) * finer);
    }
    let chord = |j: usize| band.stations[lap.start + j + 1] - band.stations[lap.start + j];
    // Twice round, so that each vertex influences all others.
    for k in 0..2 * count {
        let (j, next) = (k % count, (k + 1) % count);
        spacing[next] = spacing[next].min(spacing[j] + GROWTH * chord(j));
    }
    for k in (0..2 * count).rev() {
        let (j, next) = (k % count, (k + 1) % count);
        spacing[j] = spacing[j].min(spacing[next] + GROWTH * chord(j));
    }
    spacing.push(spacing[0]);
    spacing
}

/// Breaks from the first to the last station, for a spacing at each station.
fn spread(spacing: &[f64], stations: &[f64]) -> Vec<f64> {
    let steps: Vec<Step> = spacing.windows(2).zip(stations.windows(2)).map(|(f, s)| Step::new(f, s)).collect();
    let total: f64 = steps.iter().map(Step::count).sum();
    let spans = (total.ceil() as usize).max(SPANS_MIN);
    let mut breaks = Vec::with_capacity(spans + 1);
    breaks.push(stations[0]);
    let (mut step, mut before) = (0, 0.0);
    for i in 1..spans {
        let wanted = total * i as f64 / spans as f64;
        while step + 1 < steps.len() && before + steps[step].count() < wanted {
            before += steps[step].count();
            step += 1;
        }
        breaks.push(steps[step].place(wanted - before));
    }
    breaks.push(stations[stations.len() - 1]);
    breaks
}

/// Spacing at a vertex due to its own turn, mm.
fn at_vertex(band: &ToleranceBand, vertex: usize) -> f64 {
    let rounding = 4.0 * band.tolerance / band.turns[vertex].abs().max(TURN_EPSILON);
    (SHARE_OF_ROUNDING * rounding).max(SPACING_MIN)
}

/// Spacing at each vertex, mm, with growth limited to [`GROWTH`].
fn spacing_at_vertices(band: &ToleranceBand, finer: &[f64]) -> Vec<f64> {
    let last = band.points.len() - 1;
    let end = END_SPACING.min(band.length() * END_SHARE);
    let mut spacing: Vec<f64> = (0..=last).map(|vertex| at_vertex(band, vertex) * finer[vertex]).collect();
    spacing[0] = end * finer[0];
    spacing[last] = end * finer[last];
    for i in 1..=last {
        spacing[i] = spacing[i].min(spacing[i - 1] + GROWTH * (band.stations[i] - band.stations[i - 1]));
    }
    for i in (0..last).rev() {
        spacing[i] = spacing[i].min(spacing[i + 1] + GROWTH * (band.stations[i + 1] - band.stations[i]));
    }
    spacing
}

/// Spacing along one chord. It grows from both ends up to its maximum at `top`; the number of spans up to a place is the
/// integral of 1 / spacing.
struct Step {
    start: f64,
    top: f64,
    length: f64,
    from: f64,
    to: f64,
}

impl Step {
    fn new(spacing: &[f64], stations: &[f64]) -> Self {
        let length = stations[1] - stations[0];
        let top = ((spacing[1] - spacing[0] + GROWTH * length) / (2.0 * GROWTH)).clamp(0.0, length);
        Self { start: stations[0], top, length, from: spacing[0], to: spacing[1] }
    }

    fn rising(&self) -> f64 {
        (1.0 + GROWTH * self.top / self.from).ln() / GROWTH
    }

    fn count(&self) -> f64 {
        self.rising() + (1.0 + GROWTH * (self.length - self.top) / self.to).ln() / GROWTH
    }

    /// The station where `count` spans have passed since the chord's start.
    fn place(&self, count: f64) -> f64 {
        let rising = self.rising();
        let x = if count <= rising {
            self.from * ((GROWTH * count).exp() - 1.0) / GROWTH
        } else {
            let left = self.count() - count;
            self.length - self.to * ((GROWTH * left).exp() - 1.0) / GROWTH
        };
        self.start + x.clamp(0.0, self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::machine::MachineProfile;

    fn band(points: &[(f64, f64)]) -> ToleranceBand {
        ToleranceBand::new(points.iter().map(|&(x, y)| Point::new(x, y)).collect(), 0.05, &MachineProfile::default())
    }

    #[test]
    fn breaks_rise_and_stand_close_at_a_kink() {
        let band = band(&[(0.0, 0.0), (500.0, 0.0), (1000.0, 300.0)]);
        let breaks = breaks(&band, &[1.0; 3]);
        assert!(breaks.windows(2).all(|w| w[1] > w[0]));
        let nearest = breaks.iter().map(|b| (b - 500.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.2, "{nearest}");
        assert!(breaks.len() < 80, "a long chord costs next to nothing: {}", breaks.len());
    }

    #[test]
    fn the_number_of_breaks_does_not_depend_on_how_a_straight_is_divided() {
        let whole = band(&[(0.0, 0.0), (100.0, 0.0), (200.0, 10.0)]);
        let divided = band(&[(0.0, 0.0), (30.0, 0.0), (60.0, 0.0), (100.0, 0.0), (200.0, 10.0)]);
        let (a, b) = (breaks(&whole, &[1.0; 3]).len(), breaks(&divided, &[1.0; 5]).len());
        assert!(a.abs_diff(b) <= 1, "{a} {b}");
    }
}
