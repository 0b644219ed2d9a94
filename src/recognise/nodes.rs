//! Noding: splits loose lines at the ends of others that lie on them, and where they cross each other.

use std::collections::BTreeMap;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, cross, polyline};
use crate::ir::drawing::{Drawing, PenStroke, Vertex};

/// Greatest number of compared pairs per chord: more are a hatching or a tangle, which stays as drawn.
const MOST_PAIRS: usize = 64;
/// Least sine of the angle at which two lines cross: at a smaller one they run along each other.
const LEAST_SINE: f64 = 0.1;

/// Stretch of a stroke between places where it meets others.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    /// Index of the stroke in the drawing.
    pub(super) stroke: usize,
    pub(super) pen: u16,
    /// Places, with their spans.
    pub(super) vertices: Vec<Vertex>,
}

/// Strokes split where others of their pen meet them within `reach`, mm; unsplit if too many lie over each other.
pub(super) fn parted(drawing: &Drawing, strokes: &[usize], reach: f64) -> Vec<Stretch> {
    let cuts = cuts(drawing, strokes, reach).unwrap_or_default();
    let stretches = strokes.iter().flat_map(|&stroke| {
        let PenStroke { pen, .. } = drawing.strokes[stroke];
        let vertices = &drawing.vertices[drawing.strokes[stroke].range()];
        let all = cuts.get(&stroke).map_or_else(|| vec![vertices.to_vec()], |cuts| divided(vertices, cuts, reach));
        all.into_iter().map(move |vertices| Stretch { stroke, pen, vertices })
    });
    stretches.collect()
}

/// Place on a stroke: the index of its chord, and the share of its length.
type Cut = (usize, f64);

/// Places at which strokes are met, by stroke; `None` if too many chords are near each other.
fn cuts(drawing: &Drawing, strokes: &[usize], reach: f64) -> Option<BTreeMap<usize, Vec<Cut>>> {
    let chords: Vec<Chord> = strokes.iter().flat_map(|&stroke| Chord::of(drawing, stroke)).collect();
    let boxes = Boxes::new(chords.iter().map(|chord| Extent::between(chord.from, chord.to).grown(reach)).collect());
    let mut left = MOST_PAIRS * chords.len();
    let mut cuts: BTreeMap<usize, Vec<Cut>> = BTreeMap::new();
    for chord in &chords {
        for other in boxes.near(Extent::between(chord.from, chord.to)).map(|k| &chords[k]) {
            left = left.checked_sub(1)?;
            if other.stroke == chord.stroke || other.pen != chord.pen {
                continue;
            }
            for share in chord.met(other, reach) {
                cuts.entry(chord.stroke).or_default().push((chord.index, share));
            }
        }
    }
    Some(cuts)
}

/// Straight segment of a stroke.
struct Chord {
    stroke: usize,
    pen: u16,
    index: usize,
    from: Point,
    to: Point,
    /// Its ends that are also ends of the stroke.
    ends: [Option<Point>; 2],
}

impl Chord {
    /// Chords of a stroke.
    fn of(drawing: &Drawing, stroke: usize) -> impl Iterator<Item = Self> {
        let (range, pen) = (drawing.strokes[stroke].range(), drawing.strokes[stroke].pen);
        let count = range.len() - 1;
        drawing.vertices[range].windows(2).enumerate().map(move |(index, pair)| {
            let [from, to] = [pair[0].at, pair[1].at];
            let ends = [(index == 0).then_some(from), (index + 1 == count).then_some(to)];
            Self { stroke, pen, index, from, to, ends }
        })
    }

    /// Places at which another chord ends on this one or crosses it, as shares of its length, except at the ends of its own
    /// stroke.
    fn met(&self, other: &Self, reach: f64) -> impl Iterator<Item = f64> {
        let place = |share: f64| self.from + (self.to - self.from) * share;
        let is_at = move |share: f64, end: Point| (place(share) - end).amax() <= reach;
        let foot = |end: Point| Some(polyline::foot(end, self.from, self.to)).filter(|&share| is_at(share, end));
        let ends_here = other.ends.map(|end| end.and_then(foot));
        let crossing = if ends_here == [None; 2] { self.crossing(other, reach) } else { None };
        let is_amid = move |share: &f64| !self.ends.into_iter().flatten().any(|end| is_at(*share, end));
        ends_here.into_iter().chain([crossing]).flatten().filter(is_amid)
    }

    /// Crossing of two chords, as a share of this one; `None` if the other stroke ends there.
    fn crossing(&self, other: &Self, reach: f64) -> Option<f64> {
        let [way, across] = [self.to - self.from, other.to - other.from];
        let sine = cross(way, across);
        if sine.abs() <= LEAST_SINE * way.norm() * across.norm() {
            return None;
        }
        let between = other.from - self.from;
        let [share, along] = [cross(between, across) / sine, cross(between, way) / sine];
        let at = self.from + way * share;
        let ends_there = other.ends.into_iter().flatten().any(|end| (end - at).amax() <= reach);
        let is_inside = [share, along].iter().all(|share| (0.0..=1.0).contains(share));
        (is_inside && !ends_there).then_some(share)
    }
}

/// Stretches of a stroke between cuts; cuts within `reach` of the previous one, mm, are merged.
fn divided(vertices: &[Vertex], cuts: &[Cut], reach: f64) -> Vec<Vec<Vertex>> {
    let mut cuts = cuts.to_vec();
    cuts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut stretches = Vec::new();
    let mut stretch = vec![vertices[0]];
    let mut cuts = cuts.into_iter().peekable();
    for (chord, pair) in vertices.windows(2).enumerate() {
        while let Some((_, share)) = cuts.next_if(|cut| cut.0 == chord) {
            let at = Vertex { at: pair[0].at + (pair[1].at - pair[0].at) * share, span: pair[1].span };
            if (at.at - stretch[0].at).amax() <= reach && stretch.len() <= 2 {
                continue;
            }
            if at.at != stretch[stretch.len() - 1].at {
                stretch.push(at);
            }
            stretches.push(std::mem::replace(&mut stretch, vec![at]));
        }
        if pair[1].at != stretch[stretch.len() - 1].at {
            stretch.push(pair[1]);
        }
    }
    stretches.push(stretch);
    stretches.retain(|stretch| stretch.len() > 1);
    stretches
}
