//! How much of the cloth the parts take.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::geom::budget::Budget;
use crate::geom::nest::Shape;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point, ring};
use crate::ir::Marker;

/// Steps of a millimetre at which two outlines are told apart: finer than any file's unit.
const STEPS_PER_MM: f64 = 1000.0;

/// A closed line of a marker.
struct Outline<'a> {
    points: Cow<'a, [Point]>,
    extent: Extent,
    /// mm2, whichever way round it runs.
    area: f64,
}

impl Outline<'_> {
    /// The same for a line that stands twice in the file.
    fn key(&self) -> [i64; 5] {
        let Extent { min, max } = self.extent;
        [min.x, min.y, max.x, max.y, self.area].map(|value| (value * STEPS_PER_MM).round() as i64)
    }
}

/// Area of the parts of a marker, mm2: their outlines, notches in these included, less their cut-outs. What lies in a
/// cut-out is a part again; a line that does not close bounds nothing. `None` when so many outlines lie in one another that
/// the search for which lies in which was ended.
pub fn area(marker: &Marker) -> Option<f64> {
    let mut outlines: Vec<Outline> = Vec::new();
    let mut known = BTreeSet::new();
    for (_, contour) in marker.contours().filter(|(_, contour)| contour.closed) {
        let points = marker.list.points(contour.range);
        let outline = Outline { extent: Extent::of(&points), area: ring::area(&points).abs(), points };
        if known.insert(outline.key()) {
            outlines.push(outline);
        }
    }
    let count = outlines.len() as u32;
    let regions = Regions::new(0..count, |i| vec![Cow::Borrowed(&*outlines[i as usize].points)]);
    let mut work = Budget::of_a_marker();
    let mut sum = 0.0;
    for (i, outline) in (0..count).zip(&outlines) {
        let Some(inner) = Shape::new(&[&outline.points]).inner() else { continue };
        if !work.spend(regions.cost_at(inner)) {
            return None;
        }
        let holds = |&other: &u32| {
            let around = &outlines[other as usize];
            other != i && around.area > outline.area && around.extent.covers(&outline.extent)
        };
        let depth = regions.owners_at(inner).into_iter().filter(holds).count();
        sum += if depth % 2 == 0 { outline.area } else { -outline.area };
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::pipeline::read;
    use crate::source::Source;

    /// A square between two coordinates, mm, as contour of a file of points.
    fn square(low: i32, high: i32) -> String {
        format!("{low},{low}\n{high},{low}\n{high},{high}\n{low},{high}\n{low},{low}\n\n")
    }

    fn check(contours: &[String], expected: f64) {
        let text = format!("x_mm,y_mm\n{}", contours.concat());
        let source = Source::new("a.csv", text.into_bytes()).expect("small");
        let mut diagnostics = Diagnostics::default();
        let input = read(&source, None, &Job::default(), &mut diagnostics).expect("readable");
        assert!(!diagnostics.has_errors(), "{contours:?}");
        let area = area(&input.marker).expect("few outlines");
        assert!((area - expected).abs() < 1e-6, "{area} mm2 of {contours:?}");
    }

    #[test]
    fn cut_outs_are_taken_off_and_what_lies_in_them_is_a_part_again() {
        check(&[square(0, 100)], 10_000.0);
        check(&[square(0, 100), square(20, 80)], 10_000.0 - 3600.0);
        check(&[square(40, 60), square(20, 80), square(0, 100)], 10_000.0 - 3600.0 + 400.0);
        check(&[square(0, 100), square(200, 300)], 20_000.0);
        check(&[square(0, 100), square(0, 100)], 10_000.0);
        // A notch of 4 mm2 in an edge, and a line that bounds nothing.
        check(&["0,0\n48,0\n50,2\n52,0\n100,0\n100,100\n0,100\n0,0\n\n10,10\n20,10\n20,20\n".to_owned()], 9996.0);
        assert_eq!(area(&Marker::default()), Some(0.0));
    }
}
