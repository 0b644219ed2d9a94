//! The path of the axes as few cubic pieces: knots with positions and rates, between which the setpoints are met within a
//! tolerance.

use crate::picture::Columns;

/// Units of the knots: positions in mm and degrees, rates in the same per tick.
const UNITS: [f64; 3] = [1e-3, 1e-3, 1e-4];
const RATE_UNIT: f64 = 1e-5;
/// Maximum distance of a cubic from a setpoint, mm and degrees. Together with the rounding of its ends that is half of the
/// accuracy promised by the page.
const OFF: [f64; 3] = [4e-3, 4e-3, 1e-2];

/// Positions of the axes: X and Y in mm, C in degrees.
pub(super) type Axes = [f64; 3];

/// A position of the axes with its rate, in units.
#[derive(Debug, Clone, Copy)]
struct Knot {
    tick: u64,
    place: [i64; 3],
    rate: [i64; 3],
}

/// The knots of a program.
#[derive(Debug, Default)]
pub(super) struct Fit {
    knots: Vec<Knot>,
}

impl Fit {
    /// Adds the path through setpoints, one per tick, from rest to rest.
    pub(super) fn add(&mut self, first_tick: u64, way: &[Axes]) {
        let last = way.len() - 1;
        let knot = |i: usize| {
            let rate = |axis: usize| {
                let inside = (1..last).contains(&i);
                if inside { (way[i + 1][axis] - way[i - 1][axis]) / 2.0 } else { 0.0 }
            };
            let place = [0, 1, 2].map(|axis| (way[i][axis] / UNITS[axis]).round() as i64);
            let rate = [0, 1, 2].map(|axis| (rate(axis) / RATE_UNIT).round() as i64);
            Knot { tick: first_tick + i as u64, place, rate }
        };
        let fits = |from: usize, to: usize| {
            let (start, end) = (knot(from), knot(to));
            (from + 1..to).all(|i| {
                let found = between(&start, &end, (first_tick + i as u64) as f64);
                (0..3).all(|axis| (found[axis] - way[i][axis]).abs() <= OFF[axis])
            })
        };
        self.push(knot(0));
        let (mut from, mut reach) = (0, 1);
        while from < last {
            let most = last - from;
            reach = reach.min(most);
            while reach > 1 && !fits(from, from + reach) {
                reach /= 2;
            }
            while reach < most && fits(from, from + (2 * reach).min(most)) {
                reach = (2 * reach).min(most);
            }
            let mut step = reach / 2;
            while step > 0 {
                if reach + step <= most && fits(from, from + reach + step) {
                    reach += step;
                }
                step /= 2;
            }
            from += reach;
            self.push(knot(from));
        }
    }

    /// Adds a rest of a number of ticks.
    pub(super) fn rest(&mut self, first_tick: u64, ticks: u64, at: Axes) {
        let place = [0, 1, 2].map(|axis| (at[axis] / UNITS[axis]).round() as i64);
        for tick in [first_tick, first_tick + ticks] {
            self.push(Knot { tick, place, rate: [0; 3] });
        }
    }

    fn push(&mut self, knot: Knot) {
        if self.knots.last().is_none_or(|last| last.tick < knot.tick) {
            self.knots.push(knot);
        }
    }

    /// Adds the columns of the knots.
    pub(super) fn write(&self, columns: &mut Columns) {
        columns.add("tick", 1.0, self.knots.iter().map(|knot| knot.tick.cast_signed()));
        for (axis, name) in ["x", "y", "c"].into_iter().enumerate() {
            columns.add(name, UNITS[axis], self.knots.iter().map(|knot| knot.place[axis]));
        }
        for (axis, name) in ["rate_x", "rate_y", "rate_c"].into_iter().enumerate() {
            columns.add(name, RATE_UNIT, self.knots.iter().map(|knot| knot.rate[axis]));
        }
    }
}

/// Position between two knots, by the cubic Hermite interpolation of their positions and rates.
fn between(start: &Knot, end: &Knot, tick: f64) -> Axes {
    let span = (end.tick - start.tick) as f64;
    let u = (tick - start.tick as f64) / span;
    let v = 1.0 - u;
    let (of_start, of_end) = (v * v * (1.0 + 2.0 * u), u * u * (1.0 + 2.0 * v));
    let (rate_start, rate_end) = (u * v * v * span, -u * u * v * span);
    [0, 1, 2].map(|axis| {
        let places = start.place[axis] as f64 * of_start + end.place[axis] as f64 * of_end;
        let rates = start.rate[axis] as f64 * rate_start + end.rate[axis] as f64 * rate_end;
        places * UNITS[axis] + rates * RATE_UNIT
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path from rest to rest along a cosine, with an oscillation of C.
    fn way(ticks: u32) -> Vec<Axes> {
        let at = |i: u32| {
            let phase = std::f64::consts::PI * f64::from(i) / f64::from(ticks);
            [100.0 * (1.0 - phase.cos()), 20.0 * phase.sin().powi(2), 90.0 * (2.0 * phase).sin().powi(2)]
        };
        (0..=ticks).map(at).collect()
    }

    #[test]
    fn few_knots_keep_every_setpoint() {
        let (way, mut fit) = (way(2000), Fit::default());
        fit.rest(0, 50, way[0]);
        fit.add(50, &way);
        assert!(fit.knots.len() < 120, "{} knots", fit.knots.len());
        for pair in fit.knots.windows(2).skip(1) {
            for tick in pair[0].tick..=pair[1].tick {
                let (found, setpoint) = (between(&pair[0], &pair[1], tick as f64), way[tick as usize - 50]);
                let off = [0, 1, 2].map(|axis| (found[axis] - setpoint[axis]).abs());
                assert!(off[0] < 5e-3 && off[1] < 5e-3 && off[2] < 0.011, "{tick}: {off:?}");
            }
        }
    }

    #[test]
    fn a_jump_is_kept_at_its_tick() {
        let mut fit = Fit::default();
        fit.add(7, &[[0.0; 3], [0.0; 3], [5.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
        let ticks: Vec<u64> = fit.knots.iter().map(|knot| knot.tick).collect();
        assert_eq!(ticks, [7, 8, 9, 10]);
    }
}
