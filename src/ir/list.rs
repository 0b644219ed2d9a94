//! The doubly linked segment list: data in vectors, order as neighbour ids beside them.
//!
//! Consecutive segments of a range share a point, so only the end of each is stored. Links are stored only where something was
//! moved, and requests of the file only where there are any: the reading time of large markers grows with their memory. A
//! segment takes twenty-eight bytes, and about five more for the monotone chains that passes need. Ids are never reused. Links
//! are private to this file: others walk a [`Range`] or edit through a [`Cursor`], whose operations take constant time.

use std::borrow::Cow;

use super::lines::{Chains, Line, LineId, Lines};
use super::links::{Link, Links};
use super::scattered::Scattered;
use crate::geom::{Extent, Point};
use crate::source::Span;

/// A straight piece of a contour as given by the file, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Start point.
    pub from: Point,
    /// End point.
    pub to: Point,
    /// Source block of its end.
    pub span: Span,
    /// Requests of the file at its start.
    pub joint: Joint,
    /// Speed in percent of the speed of the piece, 1 to 100.
    pub percent: u8,
}

/// [`Segment::percent`] where the file requests no speed.
pub const FULL_SPEED: u8 = 100;

/// Requests of the file at the joint where a segment starts.
///
/// The joint of a contour's first segment applies to both ends of the contour, open or closed: `full_advance` to the plunge at
/// the start, `no_overcut` to the lift at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Joint {
    /// Lift the knife here at any angle (an explicit lift in the file, or M46).
    pub lift: bool,
    /// Plunge here without heel overlap (M17, M19).
    pub full_advance: bool,
    /// Lift here without front overlap (M18, M19).
    pub no_overcut: bool,
}

impl Segment {
    /// Length, mm.
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }

    /// True if the file requests anything on it.
    fn asks(&self) -> bool {
        let Joint { lift, full_advance, no_overcut } = self.joint;
        lift || full_advance || no_overcut || self.percent != FULL_SPEED
    }
}

/// Id of a segment in one [`SegmentList`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId(u32);

/// Requests of the file on a segment.
#[derive(Debug, Clone, Copy)]
struct Asked {
    joint: Joint,
    percent: u8,
}

/// No requests: the usual case.
const NOTHING_ASKED: Asked =
    Asked { joint: Joint { lift: false, full_advance: false, no_overcut: false }, percent: FULL_SPEED };

/// The id of the node at an index of the list.
fn id(place: usize) -> SegmentId {
    assert!(place < u32::MAX as usize, "a source below 4 GiB holds fewer than 2^32 - 1 segments");
    SegmentId(place as u32)
}

/// A contour's part of the list, from its first segment to its last, in one of two directions. A copy made before the range was
/// edited is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    first: SegmentId,
    last: SegmentId,
    backward: bool,
    /// True if its segments are adjacent in their original order.
    in_order: bool,
    /// Id of the line under which the range was appended; edits may have left it with other ends.
    line: LineId,
}

impl Range {
    /// The range in the reverse direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { backward: !self.backward, ..self }
    }
}

/// All segments of a marker.
#[derive(Debug, Clone, Default)]
pub struct SegmentList {
    /// End point of each segment; the segment starts where the previous one ends. A sentinel node precedes each range and
    /// stores its start point.
    ends: Vec<Point>,
    /// Source block of each end point.
    spans: Vec<Span>,
    asked: Scattered<Asked>,
    links: Links,
    /// Ranges as they were appended, with their chains.
    lines: Lines,
}

impl SegmentList {
    /// Reserves capacity for more segments in more ranges.
    pub fn reserve(&mut self, segments: usize, ranges: usize) {
        self.ends.reserve(segments + ranges);
        self.spans.reserve(segments + ranges);
        self.lines.reserve(segments, ranges);
    }

    /// Appends a chain of connected segments as a new range; `None` when the chain is empty.
    pub fn append(&mut self, chain: impl IntoIterator<Item = Segment, IntoIter: Clone>) -> Option<Range> {
        let chain = chain.into_iter();
        let front = self.ends.len();
        self.ends.push(chain.clone().next()?.from);
        self.ends.extend(chain.clone().map(|segment| segment.to));
        debug_assert!(chain.clone().zip(&self.ends[front..]).all(|(segment, end)| segment.from == *end), "they join");
        self.spans.push(Span::default());
        self.spans.extend(chain.clone().map(|segment| segment.span));
        // Usually there are no requests, and checking is faster than storing.
        if chain.clone().any(|segment| segment.asks()) {
            for (Segment { joint, percent, .. }, place) in chain.zip(front + 1..) {
                *self.asked_mut(id(place)) = Asked { joint, percent };
            }
        }
        Some(self.appended(front))
    }

    /// Appends the polyline through some points as a new range; `None` for fewer than two points. `spans` has the source block
    /// of each point. The segments have no requests.
    pub fn append_line(&mut self, points: &[Point], spans: &[Span]) -> Option<Range> {
        let (_, [_, ..]) = points.split_first()? else { return None };
        debug_assert_eq!(points.len(), spans.len(), "a block stands beside each point");
        let front = self.ends.len();
        self.ends.extend_from_slice(points);
        self.spans.push(Span::default());
        self.spans.extend_from_slice(&spans[1..points.len()]);
        Some(self.appended(front))
    }

    /// The range from behind a sentinel to the end of the list.
    fn appended(&mut self, front: usize) -> Range {
        let [first, last] = [front + 1, self.ends.len() - 1].map(id);
        let line = self.lines.add([first.0, last.0], &self.ends[front..]);
        Range { first, last, backward: false, in_order: true, line }
    }

    /// Bounding box of a range, mm; precomputed for most ranges.
    pub fn extent(&self, range: Range) -> Extent {
        self.known(range).map_or_else(|| Extent::of(&self.points(range)), |line| line.extent)
    }

    /// Monotone chains of a range in its direction; precomputed for most ranges.
    pub fn chains(&self, range: Range) -> Chains<'_> {
        self.known(range).map_or_else(|| Chains::of(&self.points(range)), |line| self.lines.chains(line))
    }

    /// The line of a range that is still in its original order; otherwise `None`.
    fn known(&self, range: Range) -> Option<&Line> {
        let Range { first, last, backward, in_order, line } = range;
        if in_order && !backward { self.lines.get(line, [first.0, last.0]) } else { None }
    }

    /// Applies a map to every point.
    pub fn move_points(&mut self, to: impl Fn(Point) -> Point) {
        self.lines.clear();
        self.ends.iter_mut().for_each(|end| *end = to(*end));
    }

    /// Walks a range in its direction. Segments walked backward are reversed.
    pub fn walk(&self, range: Range) -> Walk<'_> {
        let (at, end) = if range.backward { (range.last, range.first) } else { (range.first, range.last) };
        Walk { list: self, range, at: Some(at), from: self.start(range), end }
    }

    /// The points of a range in its direction, one more than its segments. They are borrowed where they are adjacent, as in
    /// nearly all ranges.
    #[inline] // every stage needs the points of every outline
    pub fn points(&self, range: Range) -> Cow<'_, [Point]> {
        if range.in_order && !range.backward {
            Cow::Borrowed(&self.ends[range.first.0 as usize - 1..=range.last.0 as usize])
        } else {
            Cow::Owned(self.gathered(range))
        }
    }

    fn gathered(&self, range: Range) -> Vec<Point> {
        let nodes = || self.nodes(range);
        // Count first: large markers leave little memory for the growth of a vector.
        let mut points = Vec::with_capacity(nodes().count());
        points.extend(nodes().map(|id| self.ends[id as usize]));
        points
    }

    /// Source blocks of the segments of a range, in its direction.
    pub fn spans(&self, range: Range) -> Cow<'_, [Span]> {
        if range.in_order && !range.backward {
            return Cow::Borrowed(&self.spans[range.first.0 as usize..=range.last.0 as usize]);
        }
        self.walk(range).map(|(_, segment)| segment.span).collect()
    }

    /// The points of a range in its direction, each with the span of the segment that leads there; the default span for the
    /// first.
    pub fn vertices(&self, range: Range) -> impl Iterator<Item = (Point, Span)> {
        let mut before = Span::default();
        self.nodes(range).map(move |id| {
            let (to, span) = (self.ends[id as usize], self.spans[id as usize]);
            let after = std::mem::replace(&mut before, span);
            (to, if range.backward { after } else { span })
        })
    }

    /// The two ends of each segment of a range, in its direction.
    pub fn lines(&self, range: Range) -> impl Iterator<Item = [Point; 2]> {
        let mut points = self.nodes(range).map(|id| self.ends[id as usize]);
        let mut before = points.next();
        points.filter_map(move |point| before.replace(point).map(|before| [before, point]))
    }

    /// The two ends of a segment, in list order.
    pub fn ends(&self, SegmentId(id): SegmentId) -> [Point; 2] {
        [self.links.of(id).prev, id].map(|id| self.ends[id as usize])
    }

    /// Start and end of a range, in its direction.
    pub fn ends_of(&self, range: Range) -> [Point; 2] {
        [self.start(range), self.start(range.reversed())]
    }

    /// Start of a range, in its direction.
    fn start(&self, range: Range) -> Point {
        let id = if range.backward { range.last.0 } else { self.front(range) };
        self.ends[id as usize]
    }

    fn asked(&self, SegmentId(id): SegmentId) -> Asked {
        self.asked.get(id).unwrap_or(NOTHING_ASKED)
    }

    fn asked_mut(&mut self, SegmentId(id): SegmentId) -> &mut Asked {
        self.asked.get_mut(id, |_| NOTHING_ASKED)
    }

    /// The sentinel node before the first segment of a range.
    fn front(&self, range: Range) -> u32 {
        self.beside(range, range.first.0).prev
    }

    /// The neighbours of a segment of a range.
    fn beside(&self, range: Range, id: u32) -> Link {
        if range.in_order { Link::in_order(id) } else { self.links.of(id) }
    }

    /// The nodes of a range in its direction, one more than its segments.
    fn nodes(&self, range: Range) -> impl Iterator<Item = u32> {
        let front = self.front(range);
        let (start, end) = if range.backward { (range.last.0, front) } else { (front, range.last.0) };
        std::iter::successors(Some(start), move |&id| {
            let Link { prev, next } = self.beside(range, id);
            (id != end).then_some(if range.backward { prev } else { next })
        })
    }

    /// Joins two ranges into one: `first`, then `second`, in their common direction. `None`, without any change, when their
    /// directions differ, they are the same range or they do not meet.
    pub fn join(&mut self, first: Range, second: Range) -> Option<Range> {
        if first.backward != second.backward || first.first == second.first {
            return None;
        }
        if self.start(first.reversed()) != self.start(second) {
            return None;
        }
        let (ahead, behind) = if first.backward { (second, first) } else { (first, second) };
        self.links.join(ahead.last.0, behind.first.0);
        Some(Range {
            first: ahead.first,
            last: behind.last,
            backward: first.backward,
            in_order: false,
            line: first.line,
        })
    }

    /// A cursor on the first segment of a range, in list order.
    pub fn cursor<'a>(&'a mut self, range: &'a mut Range) -> Cursor<'a> {
        let at = range.first;
        Cursor { list: self, range, at }
    }

    /// True if the links within a range agree in both directions and lead from its first segment to its last.
    pub fn is_linked(&self, range: Range) -> bool {
        let mut at = self.links.of(range.first.0).prev;
        if self.links.of(at).next != range.first.0 {
            return false;
        }
        for _ in 0..self.ends.len() {
            if at == range.last.0 {
                return true;
            }
            let next = self.links.of(at).next;
            let is_beside = !range.in_order || next == at.wrapping_add(1);
            if next as usize >= self.ends.len() || self.links.of(next).prev != at || !is_beside {
                return false;
            }
            at = next;
        }
        false
    }
}

/// The segments of a range with their ids, in the range's direction.
#[derive(Debug, Clone)]
pub struct Walk<'a> {
    list: &'a SegmentList,
    range: Range,
    at: Option<SegmentId>,
    /// Start of the segment `at`.
    from: Point,
    end: SegmentId,
}

impl Iterator for Walk<'_> {
    type Item = (SegmentId, Segment);

    fn next(&mut self) -> Option<Self::Item> {
        let id = self.at?;
        let Link { prev, next } = self.list.beside(self.range, id.0);
        let span = self.list.spans[id.0 as usize];
        let Asked { mut joint, percent } = self.list.asked(id);
        let (to, following) = if self.range.backward {
            // Reversed, a segment starts at the joint of its successor in the list. The last segment has no successor: the
            // contour's end shares the joint of its start.
            let after = if id == self.range.last { self.range.first } else { SegmentId(next) };
            joint = self.list.asked(after).joint;
            (prev, prev)
        } else {
            (id.0, next)
        };
        self.at = (id != self.end).then_some(SegmentId(following));
        let to = self.list.ends[to as usize];
        let from = std::mem::replace(&mut self.from, to);
        Some((id, Segment { from, to, span, joint, percent }))
    }
}

/// Edits a range in place; positioned on one of its segments.
#[derive(Debug)]
pub struct Cursor<'a> {
    list: &'a mut SegmentList,
    range: &'a mut Range,
    at: SegmentId,
}

impl Cursor<'_> {
    /// The segment under the cursor.
    pub fn segment(&self) -> Segment {
        let span = self.list.spans[self.at.0 as usize];
        let Asked { joint, percent } = self.list.asked(self.at);
        let [from, to] = self.list.ends(self.at);
        Segment { from, to, span, joint, percent }
    }

    /// Start of the current segment, which is also the end of the previous one, for modification.
    pub fn from_mut(&mut self) -> &mut Point {
        let before = self.link().prev;
        self.list.lines.forget(before);
        &mut self.list.ends[before as usize]
    }

    /// End of the current segment, which is also the start of the next one, for modification.
    pub fn to_mut(&mut self) -> &mut Point {
        self.list.lines.forget(self.at.0);
        &mut self.list.ends[self.at.0 as usize]
    }

    /// Requests of the file at the start of the current segment, for modification.
    pub fn joint_mut(&mut self) -> &mut Joint {
        &mut self.list.asked_mut(self.at).joint
    }

    /// Speed of the current segment in percent, for modification.
    pub fn percent_mut(&mut self) -> &mut u8 {
        &mut self.list.asked_mut(self.at).percent
    }

    fn link(&self) -> Link {
        self.list.links.of(self.at.0)
    }

    /// Moves to the next segment in list order; `false` at the last.
    pub fn advance(&mut self) -> bool {
        if self.is_last() {
            return false;
        }
        self.at = SegmentId(self.link().next);
        true
    }

    /// True if the current segment is the last in list order.
    pub fn is_last(&self) -> bool {
        self.at == self.range.last
    }

    /// Splits the current segment at `point` and returns the id of the second part; the cursor stays on the first.
    pub fn split(&mut self, point: Point) -> SegmentId {
        let Asked { percent, .. } = self.list.asked(self.at);
        let behind = id(self.list.ends.len());
        self.list.lines.forget(self.at.0);
        if percent != FULL_SPEED {
            self.list.asked_mut(behind).percent = percent;
        }
        let SegmentList { ends, spans, links, .. } = &mut *self.list;
        let at = self.at.0 as usize;
        let end = std::mem::replace(&mut ends[at], point);
        ends.push(end);
        spans.push(spans[at]);
        if self.at == self.range.last {
            self.range.last = behind;
        } else {
            links.join(behind.0, links.of(self.at.0).next);
        }
        links.join(self.at.0, behind.0);
        self.range.in_order = false;
        behind
    }

    /// Removes the current segment and moves to the next one, or to the previous one at the end. A gap inside the range is
    /// bridged by the next segment. `false`, without any change, for the only segment.
    pub fn remove(&mut self) -> bool {
        let Link { prev, next } = self.link();
        let [prev, next] = [prev, next].map(SegmentId);
        match (self.at == self.range.first, self.is_last()) {
            (true, true) => return false,
            (false, true) => (self.range.last, self.at) = (prev, prev),
            // The removed segment ends where the range now starts, so it becomes the sentinel node.
            (true, false) => (self.range.first, self.at) = (next, next),
            (false, false) => {
                self.list.links.join(prev.0, next.0);
                (self.range.in_order, self.at) = (false, next);
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(xs: &[f64]) -> Vec<Segment> {
        let p = |x: f64| Point::new(x, 0.0);
        let (span, joint) = (Span::default(), Joint::default());
        let segment = |w: &[f64]| Segment { from: p(w[0]), to: p(w[1]), span, joint, percent: FULL_SPEED };
        xs.windows(2).map(segment).collect()
    }

    fn xs(list: &SegmentList, range: Range) -> Vec<f64> {
        let mut xs: Vec<f64> = list.walk(range).map(|(_, s)| s.from.x).collect();
        xs.extend(list.walk(range).last().map(|(_, s)| s.to.x));
        xs
    }

    #[test]
    fn a_segment_stays_small() {
        assert!(size_of::<Point>() + size_of::<Span>() <= 28);
    }

    #[test]
    fn edits_keep_the_order_and_the_links() {
        let mut list = SegmentList::default();
        list.append(chain(&[100.0, 101.0])).expect("one segment");
        let mut range = list.append(chain(&[0.0, 1.0, 2.0, 3.0])).expect("three segments");
        let mut cursor = list.cursor(&mut range);
        cursor.split(Point::new(0.5, 0.0));
        while cursor.advance() {}
        cursor.split(Point::new(2.5, 0.0));
        assert_eq!(xs(&list, range), [0.0, 0.5, 1.0, 2.0, 2.5, 3.0]);
        assert_eq!(xs(&list, range.reversed()), [3.0, 2.5, 2.0, 1.0, 0.5, 0.0]);
        let mut cursor = list.cursor(&mut range);
        assert!(cursor.remove());
        assert_eq!(xs(&list, range), [0.5, 1.0, 2.0, 2.5, 3.0]);
        assert!(list.is_linked(range));
    }

    #[test]
    fn points_lie_side_by_side_until_one_amid_is_moved() {
        let mut list = SegmentList::default();
        let mut range = list.append(chain(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0])).expect("five segments");
        let expect = |list: &SegmentList, range: Range, expected: &[f64], is_borrowed: bool| {
            for (range, turned) in [(range, false), (range.reversed(), true)] {
                let mut points: Vec<f64> = list.points(range).iter().map(|point| point.x).collect();
                assert_eq!(points, xs(list, range));
                if turned {
                    points.reverse();
                }
                assert_eq!(points, expected);
                assert_eq!(matches!(list.points(range), Cow::Borrowed(_)), is_borrowed && !turned);
            }
            assert!(list.is_linked(range));
        };
        assert!(list.cursor(&mut range).remove());
        expect(&list, range, &[1.0, 2.0, 3.0, 4.0, 5.0], true);
        let mut cursor = list.cursor(&mut range);
        while cursor.advance() {}
        assert!(cursor.remove());
        expect(&list, range, &[1.0, 2.0, 3.0, 4.0], true);
        let mut cursor = list.cursor(&mut range);
        cursor.advance();
        assert!(cursor.remove());
        expect(&list, range, &[1.0, 2.0, 4.0], false);
    }

    #[test]
    fn the_box_and_the_chains_of_a_range_are_those_of_its_points_whatever_is_done_to_them() {
        let mut list = SegmentList::default();
        let points: Vec<Point> = [0.0, 3.0, -2.0, 1.0].map(|x| Point::new(x, 2.0 * x)).into();
        let spans = vec![Span::default(); points.len()];
        let [mut range, other] = [(); 2].map(|()| list.append_line(&points, &spans).expect("three segments"));
        let check = |list: &SegmentList, range: Range| {
            for range in [range, range.reversed(), other] {
                let points = list.points(range);
                assert_eq!(list.extent(range), Extent::of(&points));
                assert_eq!(list.chains(range), Chains::of(&points));
            }
        };
        check(&list, range);
        assert!(list.cursor(&mut range).remove());
        check(&list, range);
        list.cursor(&mut range).split(Point::new(7.0, 7.0));
        check(&list, range);
        *list.cursor(&mut range).to_mut() = Point::new(9.0, 9.0);
        check(&list, range);
        list.move_points(|at| Point::new(at.y, at.x));
        check(&list, range);
        *list.cursor(&mut range).from_mut() = Point::new(-9.0, 9.0);
        check(&list, range);
    }

    #[test]
    fn vertices_are_the_ends_of_the_segments_in_either_direction() {
        let mut list = SegmentList::default();
        let mut segments = chain(&[0.0, 1.0, 2.0, 3.0]);
        for (segment, block) in segments.iter_mut().zip(1..) {
            segment.span.block = block;
        }
        let range = list.append(segments).expect("three segments");
        for range in [range, range.reversed()] {
            let (_, first) = list.walk(range).next().expect("three segments");
            let ends = list.walk(range).map(|(_, segment)| (segment.to, segment.span));
            let expected: Vec<_> = std::iter::once((first.from, Span::default())).chain(ends).collect();
            assert_eq!(list.vertices(range).collect::<Vec<_>>(), expected);
            assert!(list.spans(range).iter().eq(expected[1..].iter().map(|(_, span)| span)));
            let ends: Vec<_> = expected.windows(2).map(|pair| [pair[0].0, pair[1].0]).collect();
            assert_eq!(list.lines(range).collect::<Vec<_>>(), ends);
        }
    }

    #[test]
    fn two_ranges_join_in_the_direction_that_they_are_walked_in() {
        for backward in [false, true] {
            let mut list = SegmentList::default();
            let turned = |range: Range| if backward { range.reversed() } else { range };
            let a = turned(list.append(chain(&[0.0, 1.0, 2.0])).expect("two segments"));
            let next: &[f64] = if backward { &[-1.0, 0.0] } else { &[2.0, 3.0] };
            let b = turned(list.append(chain(next)).expect("one segment"));
            let apart = turned(list.append(chain(&[7.0, 8.0])).expect("one segment"));
            let expected: Vec<_> = list.walk(a).chain(list.walk(b)).collect();
            assert_eq!(list.join(a, b.reversed()), None);
            assert_eq!(list.join(a, a), None);
            assert_eq!(list.join(a, apart), None);
            let joined = list.join(a, b).expect("the same direction");
            assert!(list.is_linked(joined) && list.walk(joined).eq(expected));
        }
    }

    #[test]
    fn a_joint_stays_at_its_point_when_walked_backward() {
        let mut list = SegmentList::default();
        let mut segments = chain(&[0.0, 1.0, 2.0, 0.0]);
        segments[1].joint.lift = true; // at x = 1
        let range = list.append(segments).expect("three segments").reversed();
        let lifts: Vec<(f64, bool)> = list.walk(range).map(|(_, s)| (s.from.x, s.joint.lift)).collect();
        assert_eq!(lifts, [(0.0, false), (2.0, false), (1.0, true)]);
    }
}
