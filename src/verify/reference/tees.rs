//! Tees: places where the drawing has an open cut end on another cut, as a slit ends on the edge of its part.

use std::iter;

use super::common::{Joint, LEAST_SINE, along, boxes_of};
use super::grid::{Grid, Run};
use super::inside::Inside;
use super::line::Line;
use super::lines::Reference;
use super::shared::SAME;
use crate::geom::{Extent, Point, Vector, cross, polyline};

/// Distance from its end at which a cut is tested for lying in a part, in multiples of the tolerance.
const LOOK: f64 = 2.0;

/// Fraction of the widest thread within which lines count as meeting in the drawing: a file may leave a gap as wide as a
/// thread, and a cut that follows it then does so, too.
const MET_SHARE: f64 = 0.5;

/// Tees of the open cuts that come out of parts. `limit` is the greatest width of a thread, mm. The line that is met may be cut
/// beside its chord, along the curve that the chord approximates, or by a plunged blade of `width` mm. A slit in the waste
/// frees nothing.
pub(super) fn tees(reference: &Reference, grid: &Grid, inside: &Inside, [width, limit]: [f64; 2]) -> Vec<Joint> {
    let mut found: Vec<Joint> = Vec::new();
    let comes_out = |end: &End| !inside.pieces_at(end.at + end.along * (LOOK * reference.tolerance)).is_empty();
    for End { at: end, along, line, station, block } in ends(&reference.lines).filter(comes_out) {
        let is_led = is_aside(line, station);
        let before = found.len();
        for run in grid.near(end, limit) {
            let other = &reference.lines[run.line()];
            if other.cut.is_edge || other.cut.index == line.cut.index {
                continue;
            }
            if lies_along(line, run.line(), reference, grid, limit) {
                continue;
            }
            let cuts = [line.cut.index, other.cut.index];
            // If both cuts are extended there, the drawing has neither.
            let is_drawn = |chord| !(is_led && is_aside(other, other.chord(chord).deviation(end).1));
            let meets = |&chord: &usize| other.distance_to_chord(chord, end) <= MET_SHARE * limit && is_drawn(chord);
            for chord in run.chords().filter(meets) {
                // Two straight lines at the angle a, each off by d, cross within 2 d / sin a of the drawn place. At a small
                // angle only the ending cut is searched that far.
                let sine = cross(along, other.direction(chord)).abs();
                let drawn = other.chord(chord);
                let off = 2.0 * (reference.tolerance + limit);
                let is_beside = sine < LEAST_SINE;
                if is_beside && lies_along(line, run.line(), reference, grid, off) {
                    continue; // parallel over its whole length: it separates only what the other cut separates
                }
                let off = off + bow(other, drawn.deviation(end).1, width) + drawn.sagitta();
                let about = Extent::between(end, end).grown(off / sine.max(LEAST_SINE));
                let far = if is_beside { boxes_along(line, station, off / sine, off) } else { Vec::new() };
                match found[before..].iter_mut().find(|joint| joint.cuts == cuts) {
                    Some(joint) => {
                        joint.about[0].join(&about);
                        joint.about.extend(far);
                    }
                    None => found.push(Joint { at: end, block, cuts, about: iter::once(about).chain(far).collect() }),
                }
            }
        }
    }
    found
}

/// True if the cut of a line lies along another line over its whole length, so that it separates only what that one does.
fn lies_along(line: &Line, other: usize, reference: &Reference, grid: &Grid, limit: f64) -> bool {
    let of_other = &reference.lines[other];
    let station = |at: Point| {
        let mut chords = grid.near(at, limit).filter(|run| run.line() == other).flat_map(Run::chords);
        let chord = chords.find(|&chord| of_other.distance_to_chord(chord, at) <= limit)?;
        Some(of_other.chord(chord).deviation(at).1)
    };
    let does = |line: &Line| {
        let Some(stations) = line.points().map(station).collect::<Option<Vec<f64>>>() else { return false };
        // Along the other line the way is longer where this one crosses a bay of it.
        let ways = stations.windows(2).map(|ends| along(ends[0], ends[1], of_other.cut.round));
        ways.zip(0..).all(|(way, chord)| way <= line.station(chord + 1) - line.station(chord) + limit)
    };
    does(line) && reference.lines.iter().filter(|of_cut| of_cut.cut.index == line.cut.index).all(does)
}

/// Boxes along an open line from the end at a station over a length of `way` mm or to its other end, each grown by `off` mm.
fn boxes_along(line: &Line, station: f64, way: f64, off: f64) -> Vec<Extent> {
    let [from, to] = if station > 0.0 { [(station - way).max(0.0), station] } else { [0.0, way.min(line.length())] };
    let inner = line.vertices(from, to).map(|vertex| line.point(vertex));
    let points: Vec<Point> = iter::once(line.place(from)).chain(inner).chain([line.place(to)]).collect();
    boxes_of(&points, off)
}

/// Greatest distance beside a line at a station of a blade of that width plunged over it, mm: the sagitta of an arc with the
/// same turn.
fn bow(line: &Line, station: f64, width: f64) -> f64 {
    let (mut heading, mut reach) = (0.0, [0.0_f64; 2]);
    for vertex in line.vertices(station - width, station + width) {
        heading += line.turn(vertex);
        reach = [reach[0].min(heading), reach[1].max(heading)];
    }
    polyline::sagitta(width, reach[1] - reach[0])
}

/// True if a station of a line lies on an extension of its cut.
fn is_aside(line: &Line, station: f64) -> bool {
    line.aside.iter().any(|[from, to]| (from - SAME..=to + SAME).contains(&station))
}

/// End of an open cut.
struct End<'a> {
    at: Point,
    /// Unit vector along the line away from the end.
    along: Vector,
    line: &'a Line<'a>,
    station: f64,
    block: u32,
}

/// Ends of open cuts.
fn ends<'a>(lines: &'a [Line<'a>]) -> impl Iterator<Item = End<'a>> {
    let is_of_cut = |other: Option<&Line>, line: &Line| other.is_some_and(|other| other.cut.index == line.cut.index);
    let open = lines.iter().enumerate().filter(|(_, line)| !line.cut.is_edge && line.cut.round.is_none());
    open.flat_map(move |(i, line)| {
        let last = line.chords() - 1;
        let begins = !is_of_cut(i.checked_sub(1).map(|before| &lines[before]), line);
        let ends = !is_of_cut(lines.get(i + 1), line);
        let start = End { at: line.point(0), along: line.direction(0), line, station: 0.0, block: line.block(0) };
        let (at, along, block) = (line.point(last + 1), -line.direction(last), line.block(last));
        let end = End { at, along, line, station: line.length(), block };
        begins.then_some(start).into_iter().chain(ends.then_some(end))
    })
}
