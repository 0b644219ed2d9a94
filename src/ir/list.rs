//! The doubly linked segment list: order as `prev`/`next` ids in a vector, data beside it.
//!
//! The segments of a range join, since each is kept as its end alone: forty bytes, for large markers are as slow to read
//! as they are large in memory. Ids are never reused. Nobody outside this file sees a link; others walk a [`Range`] or edit through a [`Cursor`],
//! whose every operation takes constant time.

use crate::geom::Point;
use crate::source::Span;

/// A straight piece of a contour as the file says it, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Where it starts.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// The block that its end came from.
    pub span: Span,
    /// What the file asks for where it starts.
    pub joint: Joint,
    /// Its speed in percent of the speed of the piece, 1 to 100.
    pub percent: u8,
}

/// [`Segment::percent`] where the file asks for nothing.
pub const FULL_SPEED: u8 = 100;

/// What the file asks for at the joint where a segment starts.
///
/// The joint of a contour's first segment speaks for both of its ends, open or closed: `full_advance` for the plunge at
/// the start, `no_overcut` for the lift at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Joint {
    /// The knife is lifted here whatever the angle (a lift that the file writes, or M46).
    pub lift: bool,
    /// The plunge here goes without heel overlap (M17, M19).
    pub full_advance: bool,
    /// The lift here goes without front overlap (M18, M19).
    pub no_overcut: bool,
}

impl Segment {
    /// Length, mm.
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

/// Names a segment of one [`SegmentList`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId(u32);

/// "No neighbour" in a link.
const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, Copy)]
struct Links {
    prev: u32,
    next: u32,
}

/// What is kept of a segment: where it starts, the one before it ends. In front of the first segment of a range stands a
/// node that is none: its end is where the range starts, and nothing is before it.
#[derive(Debug, Clone, Copy)]
struct Node {
    to: Point,
    span: Span,
    joint: Joint,
    percent: u8,
}

impl Node {
    fn of(segment: Segment) -> Self {
        let Segment { to, span, joint, percent, .. } = segment;
        Self { to, span, joint, percent }
    }

    /// The one in front of a range that starts at `at`.
    fn start(at: Point) -> Self {
        Self { to: at, span: Span::default(), joint: Joint::default(), percent: FULL_SPEED }
    }
}

/// A contour's part of the list: from its first segment to its last, walked in one of two directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    first: SegmentId,
    last: SegmentId,
    backward: bool,
}

impl Range {
    /// Whether it is walked against the order of the list.
    pub fn is_backward(self) -> bool {
        self.backward
    }

    /// The same segments, walked the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { backward: !self.backward, ..self }
    }
}

/// All segments of a marker.
#[derive(Debug, Clone, Default)]
pub struct SegmentList {
    links: Vec<Links>,
    nodes: Vec<Node>,
}

impl SegmentList {
    /// Makes room for so many more segments in so many ranges.
    pub fn reserve(&mut self, segments: usize, ranges: usize) {
        self.links.reserve(segments + ranges);
        self.nodes.reserve(segments + ranges);
    }

    /// Appends a chain of segments, each of which starts where the one before it ends, as a range of its own; `None` when
    /// there are none.
    pub fn append(&mut self, chain: impl IntoIterator<Item = Segment>) -> Option<Range> {
        let mut chain = chain.into_iter();
        let segment = chain.next()?;
        let start = self.nodes.len() as u32;
        self.nodes.extend([Node::start(segment.from), Node::of(segment)]);
        let mut end = segment.to;
        self.nodes.extend(chain.map(|segment| {
            debug_assert!(segment.from == end, "the segments of a chain join");
            end = segment.to;
            Node::of(segment)
        }));
        assert!(self.nodes.len() < NONE as usize, "a source below 4 GiB holds fewer than 2^32 - 1 segments");
        let (first, last) = (start + 1, self.nodes.len() as u32 - 1);
        self.links.push(Links { prev: NONE, next: first });
        self.links.extend((first..last).map(|id| Links { prev: id - 1, next: id + 1 }));
        self.links.push(Links { prev: last - 1, next: NONE });
        Some(Range { first: SegmentId(first), last: SegmentId(last), backward: false })
    }

    /// Walks a range in its direction. A segment that is walked backward comes out turned round.
    pub fn walk(&self, range: Range) -> Walk<'_> {
        let (at, end) = if range.backward { (range.last, range.first) } else { (range.first, range.last) };
        Walk { list: self, range, at: Some(at), from: self.start(range), end }
    }

    /// The points of a range in its direction: one more than its segments.
    pub fn points(&self, range: Range) -> impl Iterator<Item = Point> {
        self.vertices(range).map(|(point, _)| point)
    }

    /// The points of a range in its direction, each with the span of the segment that leads there; to the first none does.
    pub fn vertices(&self, range: Range) -> impl Iterator<Item = (Point, Span)> {
        let front = self.links[range.first.0 as usize].prev;
        let (start, end) = if range.backward { (range.last.0, front) } else { (front, range.last.0) };
        let follow = move |&id: &u32| {
            let Links { prev, next } = self.links[id as usize];
            (id != end).then_some(if range.backward { prev } else { next })
        };
        let mut before = Span::default();
        std::iter::successors(Some(start), follow).map(move |id| {
            let Node { to, span, .. } = self.nodes[id as usize];
            let after = std::mem::replace(&mut before, span);
            (to, if range.backward { after } else { span })
        })
    }

    /// The two ends of each segment of a range, in its direction.
    pub fn lines(&self, range: Range) -> impl Iterator<Item = [Point; 2]> {
        let mut points = self.points(range);
        let mut before = points.next();
        points.filter_map(move |point| before.replace(point).map(|before| [before, point]))
    }

    /// The two ends of a segment, in the order of the list.
    pub fn ends(&self, SegmentId(id): SegmentId) -> [Point; 2] {
        [self.links[id as usize].prev, id].map(|id| self.nodes[id as usize].to)
    }

    /// Where a range starts, in its direction.
    fn start(&self, range: Range) -> Point {
        let id = if range.backward { range.last.0 } else { self.links[range.first.0 as usize].prev };
        self.nodes[id as usize].to
    }

    /// Makes one range of two: `first`, then `second`, in the direction that both are walked in. `None`, and nothing
    /// changed, when their directions differ, they are the same range or do not meet.
    pub fn join(&mut self, first: Range, second: Range) -> Option<Range> {
        if first.backward != second.backward || first.first == second.first {
            return None;
        }
        if self.start(first.reversed()) != self.start(second) {
            return None;
        }
        let (ahead, behind) = if first.backward { (second, first) } else { (first, second) };
        self.links[ahead.last.0 as usize].next = behind.first.0;
        self.links[behind.first.0 as usize].prev = ahead.last.0;
        Some(Range { first: ahead.first, last: behind.last, backward: first.backward })
    }

    /// A cursor on the first segment of a range, in the order of the list.
    pub fn cursor<'a>(&'a mut self, range: &'a mut Range) -> Cursor<'a> {
        let at = range.first;
        Cursor { list: self, range, at }
    }

    /// Whether the links between the ends of a range agree in both directions and end at its ends.
    pub fn is_linked(&self, range: Range) -> bool {
        let mut at = range.first.0;
        let front = self.links[at as usize].prev;
        if front == NONE || self.links[front as usize].prev != NONE || self.links[front as usize].next != at {
            return false;
        }
        for _ in 0..self.links.len() {
            let next = self.links[at as usize].next;
            if next == NONE {
                return at == range.last.0;
            }
            if self.links[next as usize].prev != at {
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
    /// Where that one starts.
    from: Point,
    end: SegmentId,
}

impl Iterator for Walk<'_> {
    type Item = (SegmentId, Segment);

    fn next(&mut self) -> Option<Self::Item> {
        let id = self.at?;
        if self.range.backward {
            return Some((id, self.turned_round(id)));
        }
        let Node { to, span, joint, percent } = self.list.nodes[id.0 as usize];
        let next = self.list.links[id.0 as usize].next;
        self.at = (id != self.end && next != NONE).then_some(SegmentId(next));
        let from = std::mem::replace(&mut self.from, to);
        Some((id, Segment { from, to, span, joint, percent }))
    }
}

impl Walk<'_> {
    /// A segment walked backward. It starts at the joint that its successor in the list starts with; the contour's own
    /// end, which has no successor, shares its joint with the start.
    fn turned_round(&mut self, id: SegmentId) -> Segment {
        let Links { prev, next } = self.list.links[id.0 as usize];
        let after = if next == NONE { self.range.first.0 } else { next };
        let Node { span, percent, .. } = self.list.nodes[id.0 as usize];
        let (to, joint) = (self.list.nodes[prev as usize].to, self.list.nodes[after as usize].joint);
        self.at = (id != self.end).then_some(SegmentId(prev));
        Segment { from: std::mem::replace(&mut self.from, to), to, span, joint, percent }
    }
}

/// Edits a range in place; stands on one segment of it.
#[derive(Debug)]
pub struct Cursor<'a> {
    list: &'a mut SegmentList,
    range: &'a mut Range,
    at: SegmentId,
}

impl Cursor<'_> {
    /// The segment under the cursor.
    pub fn segment(&self) -> Segment {
        let Node { to, span, joint, percent } = self.list.nodes[self.at.0 as usize];
        let before = self.list.links[self.at.0 as usize].prev;
        Segment { from: self.list.nodes[before as usize].to, to, span, joint, percent }
    }

    /// Where the segment under the cursor starts and the one before it ends, to change.
    pub fn from_mut(&mut self) -> &mut Point {
        let before = self.list.links[self.at.0 as usize].prev;
        &mut self.list.nodes[before as usize].to
    }

    /// Where the segment under the cursor ends and the next one starts, to change.
    pub fn to_mut(&mut self) -> &mut Point {
        &mut self.list.nodes[self.at.0 as usize].to
    }

    /// What the file asks for where the segment under the cursor starts, to change.
    pub fn joint_mut(&mut self) -> &mut Joint {
        &mut self.list.nodes[self.at.0 as usize].joint
    }

    /// The speed of the segment under the cursor, to change.
    pub fn percent_mut(&mut self) -> &mut u8 {
        &mut self.list.nodes[self.at.0 as usize].percent
    }

    /// Moves to the next segment in list order; `false` at the last.
    pub fn advance(&mut self) -> bool {
        match self.list.links[self.at.0 as usize].next {
            NONE => false,
            next => {
                self.at = SegmentId(next);
                true
            }
        }
    }

    /// Whether the segment under the cursor is the last in list order.
    pub fn is_last(&self) -> bool {
        self.list.links[self.at.0 as usize].next == NONE
    }

    /// Splits the segment under the cursor at `point`; the cursor stays on the first part.
    pub fn split(&mut self, point: Point) -> SegmentId {
        let id = self.list.nodes.len() as u32;
        assert!(id < NONE, "a source below 4 GiB holds fewer than 2^32 - 1 segments");
        let node = &mut self.list.nodes[self.at.0 as usize];
        let behind = Node { joint: Joint::default(), ..*node };
        node.to = point;
        let next = self.list.links[self.at.0 as usize].next;
        self.list.nodes.push(behind);
        self.list.links.push(Links { prev: self.at.0, next });
        self.list.links[self.at.0 as usize].next = id;
        match next {
            NONE => self.range.last = SegmentId(id),
            next => self.list.links[next as usize].prev = id,
        }
        SegmentId(id)
    }

    /// Takes the segment under the cursor out and moves to the next one, or to the one before when it was the last. One
    /// that others stand around is bridged by the next. `false`, and nothing changed, when it is the only one.
    pub fn remove(&mut self) -> bool {
        let Links { prev, next } = self.list.links[self.at.0 as usize];
        let was_first = self.at == self.range.first;
        if was_first && next == NONE {
            return false;
        }
        if was_first {
            self.list.nodes[prev as usize].to = self.list.nodes[self.at.0 as usize].to;
            self.range.first = SegmentId(next);
        }
        self.list.links[prev as usize].next = next;
        match next {
            NONE => self.range.last = SegmentId(prev),
            next => self.list.links[next as usize].prev = prev,
        }
        self.at = SegmentId(if next == NONE { prev } else { next });
        true
    }

    /// Makes the segment under the cursor the first of a closed range: the ones before it go behind the last.
    pub fn make_first(&mut self) {
        if self.at == self.range.first {
            return;
        }
        let (first, last) = (self.range.first, self.range.last);
        let prev = self.list.links[self.at.0 as usize].prev;
        let front = self.list.links[first.0 as usize].prev;
        self.list.nodes[front as usize].to = self.list.nodes[prev as usize].to;
        self.list.links[front as usize].next = self.at.0;
        self.list.links[self.at.0 as usize].prev = front;
        self.list.links[last.0 as usize].next = first.0;
        self.list.links[first.0 as usize].prev = last.0;
        self.list.links[prev as usize].next = NONE;
        self.range.first = self.at;
        self.range.last = SegmentId(prev);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(xs: &[f64]) -> Vec<Segment> {
        let p = |x: f64| Point::new(x, 0.0);
        let segment = |w: &[f64]| Segment {
            from: p(w[0]),
            to: p(w[1]),
            span: Span::default(),
            joint: Joint::default(),
            percent: FULL_SPEED,
        };
        xs.windows(2).map(segment).collect()
    }

    fn xs(list: &SegmentList, range: Range) -> Vec<f64> {
        let mut xs: Vec<f64> = list.walk(range).map(|(_, s)| s.from.x).collect();
        xs.extend(list.walk(range).last().map(|(_, s)| s.to.x));
        xs
    }

    #[test]
    fn a_segment_stays_small() {
        assert!(size_of::<Node>() + size_of::<Links>() <= 40);
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
            let ends: Vec<_> = expected.windows(2).map(|pair| [pair[0].0, pair[1].0]).collect();
            assert_eq!(list.lines(range).collect::<Vec<_>>(), ends);
        }
    }

    #[test]
    fn a_closed_range_starts_anywhere() {
        let mut list = SegmentList::default();
        let mut range = list.append(chain(&[0.0, 1.0, 2.0, 0.0])).expect("three segments");
        let mut cursor = list.cursor(&mut range);
        cursor.advance();
        cursor.make_first();
        assert_eq!(xs(&list, range), [1.0, 2.0, 0.0, 1.0]);
        assert!(list.is_linked(range));
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
            assert_eq!(list.walk(joined).collect::<Vec<_>>(), expected);
            assert!(list.is_linked(joined));
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
