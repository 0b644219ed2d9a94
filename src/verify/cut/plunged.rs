//! Straight plunged blade over a line that may be curved.

use super::body::Cut;
use super::follow::Foot;
use super::heading::on_lap;
use crate::geom::polyline;
use crate::verify::reference::line::Line;

/// Greatest share of the total turn at a blade that one vertex of a curve may have; a vertex with more is a bend, and no blade
/// may lie over a bend.
const BEND_SHARE: f64 = 0.75;

/// Position of the body of a blade relative to its line at the plunge.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::verify) struct Plunged {
    /// First and last place of the body that stand on the line; between them the line may bow away.
    pub(in crate::verify) ends: [usize; 2],
    /// Greatest distance between line and blade between these places, mm.
    pub(in crate::verify) sagitta: f64,
    /// Sagitta of a curve that turns by the same angle, mm; 0 at a bend.
    pub(in crate::verify) bound: f64,
}

impl Plunged {
    /// Plunge of a cut with places at `feet`; a place is on the line if its deviation is at most `allowed` mm. `None` unless
    /// both the tip and another place are on the line.
    pub(in crate::verify) fn new(line: &Line, cut: &Cut, feet: &[Foot], allowed: f64) -> Option<Self> {
        let is_on = |&i: &usize| feet[i].deviation <= allowed;
        let (first, last) = ((0..=cut.body).find(is_on)?, cut.body);
        if !is_on(&last) || first >= last {
            return None;
        }
        let (from, to) = (cut.points[first], cut.points[last]);
        let (a, b) = (feet[first].station, feet[last].station);
        let (low, high) = (a.min(b), a.max(b));
        let of_body = feet[first..=last].iter().map(|foot| foot.deviation);
        let of_line =
            line.vertices(low, high).map(|vertex| polyline::distance_to_segment(line.point(vertex), from, to));
        let sagitta = of_body.chain(of_line).fold(0.0, f64::max);
        let bound = if sagitta > allowed { bound(line, [low, high], [(to - from).norm(), allowed]) } else { 0.0 };
        Some(Self { ends: [first, last], sagitta, bound })
    }

    /// Plunge of a plunge cut with places `ends` over a line between two of its stations.
    pub(in crate::verify) fn over(
        line: &Line,
        cut: &Cut,
        ends: [usize; 2],
        [low, high]: [f64; 2],
        allowed: f64,
    ) -> Self {
        let (from, to) = (cut.points[0], cut.points[cut.body]);
        let of_line =
            line.vertices(low, high).map(|vertex| polyline::distance_to_segment(line.point(vertex), from, to));
        let [a, b] = [low, high].map(|station| line.place(on_lap(line, station)));
        Self { ends, sagitta: of_line.fold(0.0, f64::max), bound: bound(line, [low, high], [(b - a).norm(), allowed]) }
    }

    /// True if a place of the body lies between the places on the line.
    pub(in crate::verify) fn spans(&self, place: usize) -> bool {
        self.ends[0] < place && place < self.ends[1]
    }
}

/// Greatest sagitta over a chord of that length, mm, for a curve that turns as far as a line does between two stations; the
/// stations are uncertain by the tolerance.
fn bound(line: &Line, ends: [f64; 2], [chord, allowed]: [f64; 2]) -> f64 {
    [0.0, allowed].map(|inset| arc(line, ends, [chord, inset])).into_iter().fold(0.0, f64::max)
}

/// Sagitta of an arc over a chord of that length, mm, that turns as far as a line does between two stations. The vertices
/// before and after count too, because a curve turns along its chords: each up to the sharpest turn in between, and half of its
/// neighbour where the line ends. 0 if one vertex makes most of the turn.
fn arc(line: &Line, [low, high]: [f64; 2], [chord, inset]: [f64; 2]) -> f64 {
    let is_inner = |vertex: &usize| line.ring || (1..line.chords()).contains(vertex);
    let (from, to) = (low + inset, high - inset);
    let under: Vec<f64> = line.vertices(from, to).filter(is_inner).map(|vertex| line.turn(vertex)).collect();
    let [Some(first), Some(last)] = [under.first(), under.last()] else { return 0.0 };
    let sharpest = under.iter().copied().map(f64::abs).fold(0.0, f64::max);
    let outer = |vertex: Option<usize>, next: f64| {
        vertex.filter(is_inner).map_or(next / 2.0, |vertex| line.turn(vertex).clamp(-sharpest, sharpest))
    };
    let before = outer(line.vertex_before(from), *first);
    let behind = outer(line.vertices(to, to + line.length()).next(), *last);
    let (mut heading, mut reach, mut all) = (0.0_f64, [0.0_f64; 2], 0.0);
    for turn in std::iter::once(before).chain(under.iter().copied()).chain([behind]) {
        heading += turn;
        reach = [reach[0].min(heading), reach[1].max(heading)];
        all += turn.abs();
    }
    if sharpest > BEND_SHARE * all { 0.0 } else { polyline::sagitta(chord, reach[1] - reach[0]) }
}
