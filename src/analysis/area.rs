//! Area of the cloth that the parts take up.

use std::collections::BTreeSet;

use super::nesting::{Line, Nesting};
use crate::geom::{Extent, ring};
use crate::ir::Marker;
use crate::ir::marker::Contour;
use crate::machine::MachineProfile;

/// Resolution at which outlines are compared, steps per mm: finer than any file's unit.
const STEPS_PER_MM: f64 = 1000.0;

/// Key that is equal for two copies of a line in the file.
fn key(line: &Line, area: f64) -> [i64; 5] {
    let Extent { min, max } = line.extent;
    [min.x, min.y, max.x, max.y, area].map(|value| (value * STEPS_PER_MM).round() as i64)
}

/// Area of the parts of a marker, mm2: their outlines, including the notches in these, less their cut-outs. A line inside a
/// cut-out is a part again; an open line bounds nothing. `None` if the nesting of outlines is so deep that the search for it
/// was stopped.
pub fn area(marker: &Marker, profile: &MachineProfile) -> Option<f64> {
    let nesting = Nesting::of(marker, profile.band(marker.unit));
    if nesting.ended().is_some() {
        return None;
    }
    let area = |(_, contour): (usize, &Contour)| ring::area(&marker.list.points(contour.range)).abs();
    let areas: Vec<f64> = marker.contours().map(area).collect();
    let mut known = BTreeSet::new();
    let is_new = |(line, &area): (&Line, &f64)| line.is_closed && known.insert(key(line, area));
    let is_new: Vec<bool> = nesting.lines().iter().zip(&areas).map(is_new).collect();
    let signed = |line: usize| {
        let depth = nesting.around(line).filter(|&outer| is_new[outer]).count();
        areas[line] * if depth % 2 == 0 { 1.0 } else { -1.0 }
    };
    // The sum of no areas would be -0.
    Some((0..is_new.len()).filter(|&line| is_new[line]).map(signed).fold(0.0, |sum, area| sum + area))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::text;

    /// A square between two coordinates, mm, as a contour.
    fn square(low: i32, high: i32) -> String {
        format!(
            "piece 1\ncontour closed\n  from {low} {low} to {high} {low}\n  to {high} {high}\n  to {low} {high}\n  to {low} {low}\n"
        )
    }

    fn check(contours: &[String], expected: f64) {
        let text = format!("marker unit-mm 0\n{}", contours.concat());
        let marker = text::read_marker(&text).expect("sound");
        let area = area(&marker, &MachineProfile::default()).expect("few outlines");
        assert!((area - expected).abs() < 1e-6, "{area} mm2 of {contours:?}");
    }

    #[test]
    fn cut_outs_are_taken_off_and_what_lies_in_them_is_a_part_again() {
        check(&[square(0, 100)], 10_000.0);
        check(&[square(0, 100), square(20, 80)], 10_000.0 - 3600.0);
        check(&[square(40, 60), square(20, 80), square(0, 100)], 10_000.0 - 3600.0 + 400.0);
        check(&[square(0, 100), square(200, 300)], 20_000.0);
        check(&[square(0, 100), square(0, 100)], 10_000.0);
        // An open line bounds nothing.
        check(&[square(0, 100), "piece 2\ncontour open\n  from 10 10 to 20 10\n  to 20 20\n".to_owned()], 10_000.0);
        assert_eq!(area(&Marker::default(), &MachineProfile::default()), Some(0.0));
    }
}
