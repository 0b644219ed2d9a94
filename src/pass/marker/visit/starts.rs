//! Where lines may start, and which way they may be cut from there.

use crate::analysis::air::{Air, Stop};
use crate::geom::{Point, corner};
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, OutlineNotch, Piece};
use crate::machine::{Job, OrderPolicy};

/// Corners of a contour that are looked at, at the most, each either way round.
const MOST_STARTS: usize = 64;

/// What visits are made by.
#[derive(Debug, Clone, Copy)]
pub(in crate::pass::marker) struct Measures {
    /// How long moves take.
    pub(in crate::pass::marker) air: Air,
    /// Greatest turn that is no corner, rad.
    pub(in crate::pass::marker) corner: f64,
    /// What coordinates are multiples of, mm.
    pub(in crate::pass::marker) unit: f64,
    /// Whether pieces end towards the cloth that is still uncut, if they can: that of larger X.
    pub(in crate::pass::marker) is_steady: bool,
}

/// How a line is begun.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::pass::marker) struct Begin {
    /// The segment that starts where it is begun, by its place among its own; of an open one the first.
    pub(in crate::pass::marker) segment: usize,
    /// Whether it is cut against its direction from there on.
    pub(in crate::pass::marker) is_reversed: bool,
}

/// A start of a line.
#[derive(Debug, Clone, Copy)]
pub(in crate::pass::marker) struct Start {
    pub(super) begin: Begin,
    /// Where the knife comes down then, and where it comes up.
    pub(in crate::pass::marker) stops: [Stop; 2],
    /// Where the line ends then.
    pub(super) to: Point,
}

impl Start {
    fn new(of: &[Segment], begin: Begin, air: &Air) -> Self {
        let count = of.len();
        // The last segment of a closed one ends where the first starts.
        let (first, last) = (&of[begin.segment], &of[(begin.segment + count - 1) % count]);
        if begin.is_reversed {
            let stops = [air.down(last.to, last.from), air.up(first.to, first.from)];
            return Self { begin, stops, to: first.from };
        }
        Self { begin, stops: [air.down(first.from, first.to), air.up(last.from, last.to)], to: last.to }
    }
}

impl Measures {
    /// Those of a job for a marker.
    pub(in crate::pass::marker) fn new(job: &Job, marker: &Marker) -> Self {
        let is_steady = job.profile.order.policy(marker.drawing.is_some()) == OrderPolicy::Steady;
        Self { air: Air::new(job), corner: job.profile.corner_angle(), unit: marker.unit, is_steady }
    }

    /// That of a line that is cut as it is.
    pub(in crate::pass::marker) fn as_is(&self, range: Range, list: &SegmentList) -> Start {
        Start::new(&segments(range, list), Begin::default(), &self.air)
    }

    fn of_ends(&self, of: &[Segment]) -> Vec<Start> {
        let ways = [false, true].map(|is_reversed| Begin { segment: 0, is_reversed });
        ways[..=usize::from(is_plain(of))].iter().map(|&begin| Start::new(of, begin, &self.air)).collect()
    }

    /// Where a contour may start: as it does, and, if the file asks for nothing on it, at its other end, or a closed one at its
    /// corners, either way round.
    pub(in crate::pass::marker) fn of_contour(
        &self,
        contour: &Contour,
        piece: &Piece,
        list: &SegmentList,
    ) -> Vec<Start> {
        let of = &segments(contour.range, list)[..];
        let mut found = self.of_ends(of);
        let count = of.len();
        if !contour.closed || !is_plain(of) || count < 3 {
            return found;
        }
        let is_corner = |&i: &usize| {
            let before = (1..count).map(|k| of[(i + count - k) % count].from);
            let behind = (0..count - 1).map(|k| of[(i + k) % count].to);
            corner::is_corner(of[i].from, &before, &behind, self.corner, self.unit)
        };
        let on_notch = on_notches(of, &piece.outline_notches);
        let corners: Vec<usize> = (1..count).filter(|&i| !on_notch[i]).filter(is_corner).collect();
        let step = corners.len().div_ceil(MOST_STARTS).max(1);
        for segment in corners.into_iter().step_by(step) {
            let begins = [false, true].map(|is_reversed| Begin { segment, is_reversed });
            found.extend(begins.map(|begin| Start::new(of, begin, &self.air)));
        }
        found
    }
}

fn segments(range: Range, list: &SegmentList) -> Vec<Segment> {
    list.walk(range).map(|(_, segment)| segment).collect()
}

/// Whether the file asks for nothing on a line.
fn is_plain(of: &[Segment]) -> bool {
    of.iter().all(|segment| segment.joint == Joint::default() && segment.percent == of[0].percent)
}

/// Which points of a closed contour are of notches that it makes, mouths included.
fn on_notches(of: &[Segment], notches: &[OutlineNotch]) -> Vec<bool> {
    let count = of.len();
    let mut found = vec![false; count];
    for notch in notches {
        let opens = |&i: &usize| {
            of[i].from == notch.mouth[0] && of[(i + notch.segments as usize - 1) % count].to == notch.mouth[1]
        };
        if let Some(first) = (0..count).find(opens) {
            (0..=notch.segments as usize).for_each(|k| found[(first + k) % count] = true);
        }
    }
    found
}
