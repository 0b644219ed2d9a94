//! A piece whose outline is not wholly cut with it: its own stretches, and those for which the cut of another part must stand.
//!
//! The marker lists the cuts of the piece. Every chord of the drawing is looked up on them; a chord on none of them is spared.

use std::ops::Range;

use super::line::Line;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::list::Segment;

/// Rounding, mm: greatest distance of a cut from its drawn line, and length below which a stretch is ignored.
pub(super) const SAME: f64 = 1e-6;
/// Least cosine between a chord and a cut along it.
const ALONG: f64 = 0.999_999;

/// A straight stretch of a contour, as it is drawn.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Drawn {
    /// Its ends.
    pub(in crate::verify) ends: [Point; 2],
    /// The cut of its own piece that it lies on, by its index among the cuts of the marker; `None` where it is spared.
    pub(in crate::verify) cut: Option<u32>,
    /// Source block of its chord.
    pub(in crate::verify) block: u32,
}

/// A closed contour that is not wholly cut with its piece.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Around {
    /// The slits of the piece among all lines.
    pub(in crate::verify) slits: Range<usize>,
    /// Its stretches, in the order of the drawing.
    pub(in crate::verify) stretches: Vec<Drawn>,
    /// Index of the piece where windows of a conveyor split it: its own sections alone may stand for its edges.
    pub(in crate::verify) section: Option<usize>,
}

/// Index of chords by place, each with the cut or source block that it belongs to.
#[derive(Debug)]
pub(super) struct Chords {
    chords: Vec<([Point; 2], u32)>,
    boxes: Boxes,
}

impl Chords {
    fn new(chords: Vec<([Point; 2], u32)>) -> Self {
        let extents = chords.iter().map(|([from, to], _)| Extent::between(*from, *to).grown(SAME));
        Self { boxes: Boxes::new(extents.collect()), chords }
    }

    /// Chords of cuts, each with the index of its cut among the cuts of the marker.
    pub(super) fn of_cuts(cuts: &[Line]) -> Self {
        let chords = cuts
            .iter()
            .flat_map(|line| (0..line.chords()).map(move |i| ([line.point(i), line.point(i + 1)], line.cut.index)));
        Self::new(chords.collect())
    }

    /// Chords of drawn contours, each with its source block.
    pub(super) fn of_contours<'s>(drawn: impl Iterator<Item = &'s Segment>) -> Self {
        Self::new(drawn.map(|segment| ([segment.from, segment.to], segment.span.block)).collect())
    }

    /// Chords that meet the box of a chord.
    fn near(&self, [from, to]: [Point; 2]) -> impl Iterator<Item = ([Point; 2], u32)> {
        self.boxes.near(Extent::between(from, to)).map(|i| self.chords[i])
    }
}

/// Splits a contour into stretches on cuts of its own piece and other stretches.
pub(super) fn parted(drawn: &[Segment], own: &Chords) -> Vec<Drawn> {
    let mut found = Vec::new();
    for segment in drawn {
        let (length, way) = (segment.length(), segment.to - segment.from);
        let chord = [segment.from, segment.to];
        let near = own.near(chord);
        let mut on: Vec<([f64; 2], u32)> = near.filter_map(|(ends, cut)| Some((lies_on(chord, ends)?, cut))).collect();
        on.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.1.cmp(&b.1)));
        let mut at = 0.0;
        let mut push = |to: f64, cut: Option<u32>| {
            if to - at > SAME {
                let place = |station: f64| segment.from + way * (station / length);
                found.push(Drawn { ends: [place(at), place(to)], cut, block: segment.span.block });
                at = to;
            }
        };
        for ([from, to], cut) in on {
            push(from, None);
            push(to, Some(cut));
        }
        push(length, None);
    }
    found
}

/// Stretches of a cut, by station, that lie on none of some contours of its own piece.
pub(super) fn aside(line: &Line, drawn: &Chords) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for i in 0..line.chords() {
        let (ends, start) = ([line.point(i), line.point(i + 1)], line.station(i));
        let mut on: Vec<[f64; 2]> = drawn.near(ends).filter_map(|(chord, _)| lies_on(ends, chord)).collect();
        on.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let length = (ends[1] - ends[0]).norm();
        let mut at = 0.0;
        for [from, to] in on.into_iter().chain([[length; 2]]) {
            if from - at > SAME {
                found.push([start + at, start + from]);
            }
            at = f64::max(at, to);
        }
    }
    found
}

/// Stations of a chord between which it lies on a part of a cut, in either direction.
pub(super) fn lies_on([from, to]: [Point; 2], ends: [Point; 2]) -> Option<[f64; 2]> {
    let along = polyline::direction(from, to)?;
    if polyline::direction(ends[0], ends[1])?.dot(&along).abs() < ALONG {
        return None;
    }
    if ends.iter().any(|end| polyline::distance_to_line(*end, from, along) > SAME) {
        return None;
    }
    let [one, other] = ends.map(|end| (end - from).dot(&along).clamp(0.0, (to - from).norm()));
    let (low, high) = (one.min(other), one.max(other));
    (high - low > SAME).then_some([low, high])
}

/// Spared stretches of a contour; adjacent ones are joined.
pub(super) fn spared(ring: &[Drawn]) -> impl Iterator<Item = &[Drawn]> {
    let all = ring.chunk_by(|a, b| a.cut.is_none() && b.cut.is_none());
    all.filter(|stretches| stretches[0].cut.is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chord_lies_on_a_cut_whichever_way_that_goes() {
        let ends = |from: f64, to: f64| [from, to].map(|x| Point::new(x, 0.0));
        for (from, to) in [(2.0, 8.0), (8.0, 2.0)] {
            assert_eq!(lies_on(ends(0.0, 10.0), ends(from, to)), Some([2.0, 8.0]));
        }
    }
}
