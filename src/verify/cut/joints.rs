//! Where the strokes of a line may meet: at its ends, at bends that a plunged blade cannot follow, where the knife is
//! lifted because it was down for too long, and all along the stretches that are nibbled. Only there a blade may stand
//! as a chord of a curve or be longer than what it cuts: elsewhere a curve could be cut as a polygon, and a part
//! stabbed.

use super::body::Cut;
use crate::geom::{Point, polyline};
use crate::machine::Knife;
use crate::verify::reference::line::Line;
use crate::verify::reference::nibbled::sharpest_share;
use crate::verify::reference::tight::stands_across;

/// Part of a line on which a bend is looked at, in widths of the blade: more than it can lie on.
const WIDTHS: f64 = 4.0;

/// Least part of the turn under a blade that one vertex makes where there is a bend, by a little: a curve is nibbled.
const CURVE_SHARE: f64 = 0.65;

/// Finds joints.
#[derive(Debug)]
pub(in crate::verify) struct Joints {
    width: f64,
    /// How far a heel may stand before an end of a line, mm.
    pub(in crate::verify) heels: [f64; 3],
    /// How far a tip may stand past one, mm.
    pub(in crate::verify) fronts: [f64; 3],
    longest: Option<f64>,
    /// How far the body of a plunged blade may lie beside a curve before that is worth a word, mm.
    permitted: f64,
}

/// A stretch of a line on which a joint is looked for.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Around {
    /// Station of its middle, mm.
    pub(in crate::verify) station: f64,
    /// Half of its length, mm.
    pub(in crate::verify) slack: f64,
    /// Width of the tolerance band, mm: behind a slight bend a straight blade stays in it for a while.
    pub(in crate::verify) band: f64,
}

impl Joints {
    pub(in crate::verify) fn new(knife: &Knife) -> Self {
        Self {
            width: knife.width_mm,
            heels: [0.0, knife.heel_overlap_mm, knife.corner_heel_overlap_mm],
            fronts: [0.0, knife.front_overlap_mm, knife.corner_front_overlap_mm],
            longest: knife.longest_cut(),
            permitted: knife.max_bow_mm,
        }
    }

    /// Whether the knife is lifted amid a line: it would be down for too long, or C has to unwind.
    pub(in crate::verify) fn is_lifted(&self, line: &Line) -> bool {
        line.winds || self.longest.is_some_and(|longest| line.length() > longest)
    }

    /// How far a line may bow away from the body of a blade that plunges with its heel and its tip at two stations, mm: at
    /// ends and bends, and where the knife was down for too long, as far as it does. Where the line is nibbled a blade that
    /// never moves lies near to what it cuts, unless that is all there is between two of them and bent, and any other bows
    /// by no more than is worth no word.
    pub(in crate::verify) fn permitted_deviation(&self, line: &Line, [heel, tip]: [Around; 2], cut: &Cut) -> f64 {
        let is_at = |around: Around| self.at_end_or_bend(line, around).is_some();
        let is_nibbled = [heel, tip].iter().any(|around| line.is_nibbled(around.station));
        let is_open = match (is_nibbled, cut.is_plunge_cut()) {
            (true, true) => is_at(heel) && is_at(tip) && is_bent(line, [heel.station, tip.station]),
            (false, true) => self.is_lifted(line) || is_at(heel) || is_at(tip),
            (_, false) => self.is_lifted(line) || is_at(heel),
        };
        if is_open {
            f64::INFINITY
        } else if is_nibbled && !cut.is_plunge_cut() {
            self.permitted
        } else {
            0.0
        }
    }

    /// The stations of the first and the last joint about a station; `None` when there is none.
    pub(in crate::verify) fn near(&self, line: &Line, around: Around) -> Option<[f64; 2]> {
        if self.is_lifted(line) || line.is_nibbled(around.station) {
            return Some([f64::NEG_INFINITY, f64::INFINITY]);
        }
        self.at_end_or_bend(line, around)
    }

    /// The same for ends and bends alone.
    fn at_end_or_bend(&self, line: &Line, around: Around) -> Option<[f64; 2]> {
        let Around { station, slack, band } = around;
        let length = line.length();
        if line.ring {
            return None;
        }
        let reach = |vertex: usize| slack + band / line.turn(vertex).abs().sin();
        let is_near = |vertex: usize| (line.station(vertex) - station).abs() <= reach(vertex);
        let bends = line.vertices(station - self.width, station + self.width);
        let bends = bends.filter(|&v| is_near(v) && self.is_bend(line, v)).map(|v| line.station(v));
        let ends = [0.0, length].into_iter().filter(|end| (end - station).abs() <= slack);
        bends.chain(ends).fold(None, |found, joint| {
            Some(found.map_or([joint; 2], |[first, last]: [f64; 2]| [first.min(joint), last.max(joint)]))
        })
    }

    /// Whether a blade that plunges somewhere before a vertex, as a chord of the line, would pass the vertex farther away
    /// than it would on an arc of the same turn.
    fn is_bend(&self, line: &Line, vertex: usize) -> bool {
        if vertex == 0 || vertex == line.chords() {
            return false;
        }
        let at = line.station(vertex);
        let behind = |heel: usize| at - line.station(heel) <= WIDTHS * self.width;
        // What is near, counted from its first point.
        let first = if behind(0) { 0 } else { line.before(at - WIDTHS * self.width) };
        let end = line.up_to(at + WIDTHS * self.width);
        let points: Vec<Point> = line.points().take(end + 1).skip(first).collect();
        let whole = end >= line.chords();
        let vertex = vertex - first;
        let within = |heel: usize| (points[vertex] - points[heel]).norm() < self.width;
        let before = (0..vertex).rev().take_while(|&heel| behind(first + heel)).filter(|&heel| within(heel));
        let ends: &[f64] = if whole { &self.fronts } else { &[0.0] };
        let heels = if behind(0) { &self.heels[..] } else { &[] };
        let mut starts: Vec<(Vec<Point>, usize)> =
            before.map(|heel| (points[heel..].to_vec(), vertex - heel)).collect();
        starts.extend(heels.iter().filter(|&&heel| heel > 0.0).map(|&heel| {
            let back = points[0] - line.direction(0) * heel;
            (std::iter::once(back).chain(points.iter().copied()).collect(), vertex + 1)
        }));
        starts.into_iter().any(|(path, vertex)| ends.iter().any(|&front| self.misses(&led_on(&path, front), vertex)))
    }

    /// Whether the blade, its heel on the first point of a path, passes a vertex too far away.
    fn misses(&self, path: &[Point], vertex: usize) -> bool {
        let (tip, chord) =
            polyline::first_at_distance(path, self.width).unwrap_or((path[path.len() - 1], path.len() - 2));
        // The chord that is being left counts, too: a curve turns along its chords, not at its vertices.
        let turn = |w: &[Point]| polyline::turn_at(w[0], w[1], w[2]).abs();
        let turned: f64 = path.windows(3).take(chord + 1).map(turn).sum();
        let sharpest = path.windows(3).take(chord + 1).map(turn).fold(0.0, f64::max);
        let away = polyline::distance_to_segment(path[vertex], path[0], tip);
        let blade = tip - path[0];
        let is_across = polyline::direction(path[0], path[1]).is_some_and(|first| stands_across(blade, first));
        let is_bent = sharpest > CURVE_SHARE * turned;
        vertex <= chord && is_bent && (is_across || away > polyline::sagitta(blade.norm(), turned))
    }
}

/// Whether a line turns at one bend between two stations, and not little by little.
fn is_bent(line: &Line, [a, b]: [f64; 2]) -> bool {
    let turns: Vec<f64> = line.vertices(a.min(b), a.max(b)).map(|vertex| line.turn(vertex).abs()).collect();
    sharpest_share(&turns) > CURVE_SHARE
}

/// A path led straight on beyond its end.
fn led_on(path: &[Point], front: f64) -> Vec<Point> {
    let mut path = path.to_vec();
    let [before, last] = [path[path.len() - 2], path[path.len() - 1]];
    if let Some(along) = polyline::direction(before, last).filter(|_| front > 0.0) {
        path.push(last + along * front);
    }
    path
}
