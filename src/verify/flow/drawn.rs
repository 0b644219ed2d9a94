//! Comparison of cuts with the drawing. Where parts share edges, one cut replaces two of them and lies near both. It may pass
//! through waste, such as the mouths of two notches that are partly opposite each other, but not through a part.

use std::cell::LazyCell;

use super::ground::Ground;
use super::lines::Lines;
use super::rules;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::verdict::{Sighting, WorstByRule};
use crate::verify::reference::band::band;
use crate::verify::{Inside, Required};

/// Greatest spacing of the checked places of an edge, mm.
const STEP: f64 = 0.5;
/// Greatest distance that a cut may go past its own edge to reach the cut of another part, in multiples of the greatest
/// distance of two shared edges.
const ACROSS: f64 = 4.0;

/// Widest mouth of two notches partly opposite each other that a cut may pass over, mm.
const MOUTH: f64 = 20.0;

/// Verifies cuts against edges.
pub(super) fn judge(required: &Required, lines: &Lines, ground: &Ground, worst: &mut WorstByRule) {
    let near = required.common + ground.tolerance();
    let uncut = ground.profile.verify.max_uncut_mm + ground.tolerance();
    for edge in &required.edges {
        let (length, at) = longest_off(edge, |place| lines.near(place, near).next().is_some());
        worst.see_under(&rules::UNCUT, length, uncut, Sighting::missing(at, 0));
    }
    let chords = |points: &[Point]| points.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>();
    let drawn = required.cuts.iter().filter(|cut| cut.drawn).map(|cut| &cut.points);
    let drawn: Vec<[Point; 2]> = drawn.chain(&required.edges).flat_map(|points| chords(points)).collect();
    let boxes = Boxes::new(drawn.iter().map(|&[from, to]| Extent::between(from, to)).collect());
    let reach = ACROSS * required.common + ground.tolerance();
    let is_drawn = |place: Point| {
        let mut near = boxes.near(Extent::between(place, place).grown(reach)).map(|i| drawn[i]);
        near.any(|[from, to]| polyline::distance_to_segment(place, from, to) <= reach)
    };
    let inside = LazyCell::new(|| {
        let (marker, profile) = (ground.marker, ground.profile);
        Inside::new(marker, profile.notch, band(marker.unit, profile))
    });
    for cut in required.cuts.iter().filter(|cut| !cut.drawn) {
        let (length, _) = longest_off(&cut.points, is_drawn);
        let is_right = |place: Point| is_drawn(place) || length <= MOUTH && !inside.is_in_ring(place);
        let (length, at) = longest_off(&cut.points, is_right);
        worst.see_under(&rules::STRAY, length, uncut, Sighting::missing(at, 0));
    }
}

/// Longest stretch of a line without a place on something, mm, and its start.
fn longest_off(points: &[Point], is_on: impl Fn(Point) -> bool) -> (f64, Point) {
    let stations = polyline::stations(points);
    let count = (stations[stations.len() - 1] / STEP).ceil().max(1.0);
    let step = stations[stations.len() - 1] / count;
    let (mut longest, mut at) = (0.0, points[0]);
    let mut off: Option<(f64, Point)> = None;
    for i in 0..=count as u64 {
        let station = i as f64 * step;
        let place = polyline::place(points, &stations, station);
        if is_on(place) {
            off = None;
            continue;
        }
        let (from, begin) = *off.get_or_insert((station, place));
        // A place represents the step around it.
        if station - from + step > longest {
            (longest, at) = (station - from + step, begin);
        }
    }
    (longest, at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;
    use crate::verify::{RequiredCut, testing};

    /// Rules broken by a cut for two parts; the edge of one lies 0.2 mm aside and ends 10 mm before that of the other.
    fn broken(cut: &[(f64, f64)]) -> Vec<&'static str> {
        let points = |list: &[(f64, f64)]| list.iter().map(|&(x, y)| Point::new(x, y)).collect::<Vec<_>>();
        let rectangle =
            |left: f64, edge: f64, right: f64, far: f64| [[left, edge], [right, edge], [right, far], [left, far]];
        let parts = [rectangle(0.0, 0.0, 100.0, -20.0), rectangle(0.0, 0.2, 90.0, 20.0)];
        let marker = testing::marker(parts.iter().map(|part| &part[..]));
        let cuts = vec![RequiredCut {
            points: points(cut),
            closed: false,
            blocks: vec![1],
            caps: Vec::new(),
            corners: Vec::new(),
            drawn: false,
        }];
        let edges = vec![points(&[(0.0, 0.0), (100.0, 0.0)]), points(&[(90.0, 0.2), (0.0, 0.2)])];
        let required = Required { cuts, edges, common: 0.3 };
        let profile = MachineProfile::default();
        let mut worst = WorstByRule::default();
        judge(&required, &Lines::new(&required), &Ground { marker: &marker, profile: &profile }, &mut worst);
        let seen = worst.findings();
        seen.iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect()
    }

    #[test]
    fn one_cut_stands_for_two_edges_all_along_and_goes_into_no_part() {
        assert!(broken(&[(0.0, 0.0), (100.0, 0.0)]).is_empty());
        assert!(broken(&[(0.0, 0.0), (101.0, 0.1)]).is_empty());
        assert_eq!(broken(&[(0.0, 0.0), (96.0, 0.0)]), ["flow-verify/uncut"]);
        let spike = |y: f64| [(0.0, 0.0), (95.0, 0.0), (95.0, y), (95.0, 0.0), (100.0, 0.0)];
        assert!(broken(&spike(9.0)).is_empty(), "waste");
        assert_eq!(broken(&spike(19.0)), ["flow-verify/stray"]);
        assert_eq!(broken(&spike(-9.0)), ["flow-verify/stray"]);
        assert_eq!(broken(&[(0.0, 3.0), (100.0, 3.0)]), ["flow-verify/stray", "flow-verify/uncut"]);
    }
}
