//! Possible starts and directions of lines.

use crate::analysis::air::{Air, Stop};
use crate::geom::Point;
use crate::geom::corner::Corners;
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, OutlineNotch, Piece};
use crate::machine::{Job, OrderPolicy};

/// Greatest number of corners of a contour that are tried, each in both directions.
const MOST_STARTS: usize = 64;

/// Parameters of visits.
#[derive(Debug, Clone, Copy)]
pub(in crate::pass::marker) struct Measures {
    /// Durations of moves.
    pub(in crate::pass::marker) air: Air,
    /// Greatest turn that is not a corner, rad.
    pub(in crate::pass::marker) corner: f64,
    /// Grid of coordinates, mm.
    pub(in crate::pass::marker) unit: f64,
    /// True if pieces should end towards the uncut cloth, at larger X.
    pub(in crate::pass::marker) is_steady: bool,
}

/// Start of a line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::pass::marker) struct Begin {
    /// Index of the segment that starts there; the first one for an open line.
    pub(in crate::pass::marker) segment: usize,
    /// True if the line is cut against its direction from there.
    pub(in crate::pass::marker) is_reversed: bool,
}

/// Start of a line, with its positions.
#[derive(Debug, Clone, Copy)]
pub(in crate::pass::marker) struct Start {
    pub(super) begin: Begin,
    /// Stops at the plunge and at the lift.
    pub(in crate::pass::marker) stops: [Stop; 2],
    /// End of the line.
    pub(super) to: Point,
}

impl Start {
    fn new(of: &[Segment], begin: Begin, air: &Air) -> Self {
        let count = of.len();
        // The last segment of a closed line ends where the first starts.
        let (first, last) = (&of[begin.segment], &of[(begin.segment + count - 1) % count]);
        if begin.is_reversed {
            let stops = [air.down(last.to, last.from), air.up(first.to, first.from)];
            return Self { begin, stops, to: first.from };
        }
        Self { begin, stops: [air.down(first.from, first.to), air.up(last.from, last.to)], to: last.to }
    }
}

impl Measures {
    /// Parameters of a job for a marker.
    pub(in crate::pass::marker) fn new(job: &Job, marker: &Marker) -> Self {
        let is_steady = job.profile.order.policy(marker.drawing.is_some()) == OrderPolicy::Steady;
        Self { air: Air::new(job), corner: job.profile.corner_angle(), unit: marker.unit, is_steady }
    }

    /// Start of a line that is cut as it is.
    pub(in crate::pass::marker) fn as_is(&self, range: Range, list: &SegmentList) -> Start {
        Start::new(&segments(range, list), Begin::default(), &self.air)
    }

    fn of_ends(&self, of: &[Segment]) -> Vec<Start> {
        let ways = [false, true].map(|is_reversed| Begin { segment: 0, is_reversed });
        ways[..=usize::from(is_plain(of))].iter().map(|&begin| Start::new(of, begin, &self.air)).collect()
    }

    /// Possible starts of a contour: as drawn, and, if the file has no codes on it, at the other end of an open one, or at the
    /// corners of a closed one, in both directions.
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
        let (limit, unit) = (self.corner, self.unit);
        let corners = Corners { point: |i: usize| of[i].from, count, is_ring: true, limit, unit };
        let on_notch = on_notches(of, &piece.outline_notches);
        let corners: Vec<usize> = (1..count).filter(|&i| !on_notch[i] && corners.is_at(i)).collect();
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

/// True if the file has no codes on a line.
fn is_plain(of: &[Segment]) -> bool {
    of.iter().all(|segment| segment.joint == Joint::default() && segment.percent == of[0].percent)
}

/// True for each point of a closed contour that belongs to a notch, mouths included.
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
