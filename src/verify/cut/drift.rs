//! Direction of the blade against the path of its tip when positions are too coarse to show directions from row to row.
//!
//! A tip that moves in the direction of its blade ends up at the sum of its steps, each taken along the blade. The drift from
//! that sum divided by the path length is the tangent of the angle between blade and path, on any curve. Rounding affects only
//! the two ends of a path.

use std::f64::consts::FRAC_PI_2;

use super::heading::{Moving, fading};
use crate::geom::{Vector, angle, cross};
use crate::ir::verdict::Worst;

/// Path length over which an angle is measured, in multiples of rounding divided by the angle limit: rounding then makes up
/// half of the angle.
const LENGTH: f64 = 4.0;
/// Number of iterations for the lead at a plunge.
const ROUNDS: usize = 8;

/// Compares a blade with the path of its tip; positions are rounded by up to `rounding` mm, and an angle of `limit` rad must be
/// detected.
pub(super) fn check(moving: &Moving, [rounding, limit]: [f64; 2], heading: &mut Worst) {
    let rows = moving.rows;
    let Drift { stations, aside, turned, .. } = Drift::of(moving, lead(moving, rounding));
    let length = stations[stations.len() - 1];
    let window = LENGTH * rounding / limit;
    let mut end = 0;
    for start in 0..rows.len() {
        end = end.max(start);
        while end + 1 < rows.len() && stations[end] - stations[start] < window {
            end += 1;
        }
        let way = stations[end] - stations[start];
        if way < window.min(length) || way <= 0.0 {
            break;
        }
        // As directions turn, the rounding of the positions in between counts a little, too.
        let noise = rounding * (2.0 + turned[end] - turned[start]);
        let drift = ((aside[end] - aside[start]).norm() - noise).max(0.0);
        heading.see((drift / way).atan().to_degrees(), || rows[usize::midpoint(start, end)].sighting());
    }
}

/// Drift of the tip from its way along the blade, row by row.
struct Drift {
    /// Path length of the tip, mm: measured along the blade, so that rounding adds nothing.
    stations: Vec<f64>,
    /// Accumulated displacement across the blade, mm.
    aside: Vec<Vector>,
    /// Accumulated turn of the blade, rad.
    turned: Vec<f64>,
    /// Decrease of `left` per increase of the lead, mm per rad.
    faded: f64,
    /// Weighted displacement to the left while the lead fades, mm.
    left: f64,
}

impl Drift {
    /// Drift for a path that deviates from the blade by `lead` rad at the plunge.
    fn of(moving: &Moving, lead: f64) -> Self {
        let Moving { tips, blades, fade, .. } = *moving;
        let share = |station: f64| if station < fade { fading(station.max(0.0) / fade) } else { 0.0 };
        let count = tips.len();
        let (stations, aside, turned) =
            (Vec::with_capacity(count), Vec::with_capacity(count), Vec::with_capacity(count));
        let mut drift = Self { stations, aside, turned, faded: 0.0, left: 0.0 };
        let (mut station, mut aside, mut turned) = (0.0_f64, Vector::zeros(), 0.0);
        for i in 0..tips.len() {
            drift.stations.push(station);
            drift.aside.push(aside);
            drift.turned.push(turned);
            let Some(&next) = tips.get(i + 1) else { break };
            let shares = share(station);
            let along = [0, 1].map(|k| rotated(blades[i + k], lead * shares));
            let mean = (along[0] + along[1]).try_normalize(0.0).unwrap_or(along[0]);
            let step = next - tips[i];
            let way = mean.dot(&step);
            station = (station + way).max(station);
            aside += step - mean * way;
            turned += angle::turn(along[0], along[1]).abs();
            drift.left += if shares > 0.0 { shares * cross(mean, step) } else { 0.0 };
            drift.faded += shares * shares * way;
        }
        drift
    }
}

/// Angle from the blade to the tip's path at the plunge, rad: the permitted value that fits the start of the path best.
fn lead(moving: &Moving, rounding: f64) -> f64 {
    let [least, greatest] = moving.lead;
    if least >= greatest || moving.fade <= 0.0 {
        return least;
    }
    let middle = f64::midpoint(least.max(-FRAC_PI_2), greatest.min(FRAC_PI_2));
    // The remaining displacement corrects the lead; large leads take several iterations.
    (0..ROUNDS).fold(middle, |lead, _| {
        let Drift { faded, left, .. } = Drift::of(moving, lead);
        if faded <= rounding { lead } else { (lead + left / faded).clamp(least, greatest) }
    })
}

fn rotated(vector: Vector, by: f64) -> Vector {
    let (sin, cos) = by.sin_cos();
    Vector::new(vector.x * cos - vector.y * sin, vector.x * sin + vector.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Heading, Point};
    use crate::verify::program::row::Row;
    use crate::verify::rules;

    /// Angle detected for a blade that points `aside` rad off a path along a quarter circle, with positions rounded to 0.01 mm.
    fn seen(radius: f64, aside: f64) -> f64 {
        let count = 400_u32;
        let (mut rows, mut tips, mut blades) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..=count {
            let turned = FRAC_PI_2 * f64::from(i) / f64::from(count);
            let place = Heading::new(turned - FRAC_PI_2).unit() * radius;
            let rounded = Point::new((place.x * 100.0).round() / 100.0, (place.y * 100.0).round() / 100.0);
            let tick = u64::from(i);
            rows.push(Row {
                tick,
                t: 0.0,
                centre: rounded,
                c_deg: 0.0,
                knife: true,
                drill: 0,
                event: 0,
                block: 0,
                station: 0,
                line: 0,
            });
            tips.push(rounded);
            blades.push(Heading::new(turned + aside).unit());
        }
        let moving = Moving {
            rows: &rows,
            ways: &[],
            tips: &tips,
            blades: &blades,
            lead: [0.0; 2],
            fade: 0.0,
            way_min: 0.0,
            noise_deg: 0.0,
        };
        let mut heading = Worst::new(&rules::HEADING, None);
        check(&moving, [0.0075, 0.5_f64.to_radians()], &mut heading);
        heading.value()
    }

    #[test]
    fn a_blade_askew_is_seen_on_any_curve_though_its_places_are_coarse() {
        for radius in [3.0, 10.0, 100.0] {
            assert!(seen(radius, 0.0) < 0.1, "{radius}: {}", seen(radius, 0.0));
            let askew = seen(radius, 2_f64.to_radians());
            assert!(askew > 1.0 && askew < 2.2, "{radius}: {askew}");
        }
    }
}
