//! Conversion of arcs (G02, G03) to chords.

use std::f64::consts::TAU;

use crate::geom::{Point, Vector, cross};

/// Maximum length of an arc, mm. No table is as long, and the chords of a damaged number would exhaust the memory.
const LONGEST: f64 = 100_000.0;

/// Direction of an arc around its centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Turn {
    /// G02.
    Clockwise,
    /// G03.
    Counterclockwise,
}

/// Centre of an arc as given in a file, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Centre {
    /// I and J: centre relative to the start.
    At(Vector),
    /// R: radius; a negative one selects the longer arc.
    Radius(f64),
}

/// An arc from one point to another, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) from: Point,
    pub(super) to: Point,
    pub(super) turn: Turn,
    pub(super) centre: Centre,
}

impl Arc {
    /// The ends of its chords with a sagitta below `sagitta`; the last one is the exact end. The error describes the fault,
    /// such as radii at both ends that differ by more than `unit`. An arc that ends at its start point is a full circle.
    pub(super) fn flatten(&self, unit: f64, sagitta: f64) -> Result<Vec<Point>, String> {
        let centre = self.centre(unit)?;
        let (start, end) = (self.from - centre, self.to - centre);
        let (first, last) = (start.norm(), end.norm());
        if (first - last).abs() > unit || first.min(last) <= 0.0 {
            return Err(format!("the radius of the arc is {first:.3} mm at its start and {last:.3} mm at its end"));
        }
        let turned = cross(start, end).atan2(start.dot(&end));
        let sweep = match self.turn {
            _ if self.from == self.to => TAU,
            Turn::Counterclockwise => turned.rem_euclid(TAU),
            Turn::Clockwise => (-turned).rem_euclid(TAU),
        };
        let radius = first.max(last);
        if sweep * radius > LONGEST {
            return Err(format!("the arc is {:.0} m long", sweep * radius / 1000.0));
        }
        // The sagitta of a chord over the angle a is r (1 - cos(a / 2)).
        let step = 2.0 * (1.0 - (sagitta / radius).min(0.5)).acos();
        let chords = (sweep / step).ceil().max(1.0);
        let signed = match self.turn {
            Turn::Counterclockwise => sweep,
            Turn::Clockwise => -sweep,
        };
        let zero = start.y.atan2(start.x);
        let mut points: Vec<Point> = (1..chords as u32)
            .map(|i| {
                let part = f64::from(i) / chords;
                let (sin, cos) = (zero + signed * part).sin_cos();
                centre + Vector::new(cos, sin) * (first + (last - first) * part)
            })
            .collect();
        points.push(self.to);
        Ok(points)
    }

    fn centre(&self, unit: f64) -> Result<Point, String> {
        let radius = match self.centre {
            Centre::At(offset) => return Ok(self.from + offset),
            Centre::Radius(radius) => radius,
        };
        let chord = self.to - self.from;
        let half = chord.norm() / 2.0;
        if half <= 0.0 || half > radius.abs() + unit {
            return Err(format!("no arc of radius {:.3} mm joins points {:.3} mm apart", radius.abs(), 2.0 * half));
        }
        // The centre lies on the perpendicular bisector: left of the chord for the shorter counter-clockwise arc.
        let height = (radius * radius - half * half).max(0.0).sqrt();
        let left = (self.turn == Turn::Counterclockwise) == (radius > 0.0);
        let across = Vector::new(-chord.y, chord.x) / (2.0 * half);
        Ok(self.from + chord / 2.0 + across * if left { height } else { -height })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: f64 = 0.1;
    const SAGITTA: f64 = 0.01;

    fn arc(to: [f64; 2], turn: Turn, centre: Centre) -> Result<Vec<Point>, String> {
        Arc { from: Point::new(100.0, 0.0), to: Point::from(to), turn, centre }.flatten(UNIT, SAGITTA)
    }

    /// Total length of the chords, which must keep to a circle of 50 mm around `centre` within the sagitta.
    fn check(to: [f64; 2], turn: Turn, centre: Centre, around: [f64; 2], length: f64) {
        let mut points = vec![Point::new(100.0, 0.0)];
        points.extend(arc(to, turn, centre).expect("an arc"));
        assert_eq!(points.last(), Some(&Point::from(to)));
        let around = Point::from(around);
        let mut sum = 0.0;
        for pair in points.windows(2) {
            let middle = pair[0] + (pair[1] - pair[0]) / 2.0;
            assert!(((middle - around).norm() - 50.0).abs() < SAGITTA * 1.001, "{pair:?}");
            sum += (pair[1] - pair[0]).norm();
        }
        assert!((sum - length).abs() < 1e-3 * length, "{sum} instead of {length}");
    }

    #[test]
    fn an_arc_goes_the_way_that_its_code_says() {
        let half = TAU * 25.0;
        let at = |x, y| Centre::At(Vector::new(x, y));
        check([100.0, 100.0], Turn::Counterclockwise, at(0.0, 50.0), [100.0, 50.0], half);
        check([100.0, 100.0], Turn::Clockwise, at(0.0, 50.0), [100.0, 50.0], half);
        check([50.0, 50.0], Turn::Clockwise, at(0.0, 50.0), [100.0, 50.0], half / 2.0);
        check([50.0, 50.0], Turn::Counterclockwise, at(0.0, 50.0), [100.0, 50.0], 1.5 * half);
        check([100.0, 0.0], Turn::Clockwise, at(-50.0, 0.0), [50.0, 0.0], 2.0 * half);
    }

    #[test]
    fn a_negative_radius_takes_the_longer_way_round() {
        let quarter = TAU * 12.5;
        check([150.0, 50.0], Turn::Counterclockwise, Centre::Radius(50.0), [100.0, 50.0], quarter);
        check([150.0, 50.0], Turn::Counterclockwise, Centre::Radius(-50.0), [150.0, 0.0], 3.0 * quarter);
        check([150.0, 50.0], Turn::Clockwise, Centre::Radius(50.0), [150.0, 0.0], quarter);
    }

    #[test]
    fn ends_must_agree_on_the_radius_within_a_unit_of_the_file() {
        let at = Centre::At(Vector::new(0.0, 50.0));
        assert!(arc([100.0, 100.09], Turn::Clockwise, at).is_ok());
        assert!(arc([100.0, 100.2], Turn::Clockwise, at).is_err());
        assert!(arc([100.0, 0.0], Turn::Clockwise, Centre::Radius(50.0)).is_err());
        assert!(arc([300.0, 0.0], Turn::Clockwise, Centre::Radius(50.0)).is_err());
        assert!(arc([100.0, 0.0], Turn::Clockwise, Centre::At(Vector::new(1e8, 0.0))).is_err());
    }
}
