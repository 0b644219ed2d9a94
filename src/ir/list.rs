//! The doubly linked segment list: order as `prev`/`next` ids in a vector, data beside it.
//!
//! Ids are never reused. Nobody outside this file sees a link; others walk a [`Range`] or edit through a [`Cursor`],
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
    segments: Vec<Segment>,
}

impl SegmentList {
    /// Makes room for so many more segments.
    pub fn reserve(&mut self, segments: usize) {
        self.links.reserve(segments);
        self.segments.reserve(segments);
    }

    /// Appends a chain of segments as a range of its own; `None` when there are none.
    pub fn append(&mut self, chain: impl IntoIterator<Item = Segment>) -> Option<Range> {
        let first = self.segments.len() as u32;
        self.segments.extend(chain);
        assert!(self.segments.len() < NONE as usize, "a source below 4 GiB holds fewer than 2^32 - 1 segments");
        let end = self.segments.len() as u32;
        self.links.extend((first..end).map(|id| Links {
            prev: if id == first { NONE } else { id - 1 },
            next: if id + 1 == end { NONE } else { id + 1 },
        }));
        (end > first).then(|| Range { first: SegmentId(first), last: SegmentId(end - 1), backward: false })
    }

    /// Walks a range in its direction. A segment that is walked backward comes out turned round.
    pub fn walk(&self, range: Range) -> Walk<'_> {
        let (at, end) = if range.backward { (range.last, range.first) } else { (range.first, range.last) };
        Walk { list: self, range, at: Some(at), end }
    }

    /// Makes one range of two: `first`, then `second`, in the direction that both are walked in. `None`, and nothing
    /// changed, when their directions differ or they are the same range.
    pub fn join(&mut self, first: Range, second: Range) -> Option<Range> {
        if first.backward != second.backward || first.first == second.first {
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

    /// Number of segments ever made; an upper bound of those in use.
    pub fn capacity_used(&self) -> usize {
        self.segments.len()
    }

    /// Whether the links between the ends of a range agree in both directions and end at its ends.
    pub fn is_linked(&self, range: Range) -> bool {
        let mut at = range.first.0;
        if self.links[at as usize].prev != NONE {
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
    end: SegmentId,
}

impl Iterator for Walk<'_> {
    type Item = (SegmentId, Segment);

    fn next(&mut self) -> Option<Self::Item> {
        let id = self.at?;
        let links = self.list.links[id.0 as usize];
        let segment = self.list.segments[id.0 as usize];
        let follow = if self.range.backward { links.prev } else { links.next };
        self.at = (id != self.end && follow != NONE).then_some(SegmentId(follow));
        if !self.range.backward {
            return Some((id, segment));
        }
        // Walked backward, a segment starts at the joint that its successor in the list starts with; the contour's
        // own end, which has no successor, shares its joint with the start.
        let after = if links.next == NONE { self.range.first.0 } else { links.next };
        let joint = self.list.segments[after as usize].joint;
        Some((id, Segment { from: segment.to, to: segment.from, joint, ..segment }))
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
        self.list.segments[self.at.0 as usize]
    }

    /// The segment under the cursor, to change.
    pub fn segment_mut(&mut self) -> &mut Segment {
        &mut self.list.segments[self.at.0 as usize]
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

    /// Puts a segment behind the one under the cursor; the cursor stays.
    pub fn insert_after(&mut self, segment: Segment) -> SegmentId {
        let id = self.list.segments.len() as u32;
        assert!(id < NONE, "a source below 4 GiB holds fewer than 2^32 - 1 segments");
        let next = self.list.links[self.at.0 as usize].next;
        self.list.segments.push(segment);
        self.list.links.push(Links { prev: self.at.0, next });
        self.list.links[self.at.0 as usize].next = id;
        match next {
            NONE => self.range.last = SegmentId(id),
            next => self.list.links[next as usize].prev = id,
        }
        SegmentId(id)
    }

    /// Splits the segment under the cursor at `point`; the cursor stays on the first part.
    pub fn split(&mut self, point: Point) -> SegmentId {
        let whole = self.segment();
        self.segment_mut().to = point;
        self.insert_after(Segment { from: point, joint: Joint::default(), ..whole })
    }

    /// Takes the segment under the cursor out and moves to the next one, or to the one before when it was the last.
    /// `false`, and nothing changed, when it is the only one.
    pub fn remove(&mut self) -> bool {
        let Links { prev, next } = self.list.links[self.at.0 as usize];
        if prev == NONE && next == NONE {
            return false;
        }
        match prev {
            NONE => self.range.first = SegmentId(next),
            prev => self.list.links[prev as usize].next = next,
        }
        match next {
            NONE => self.range.last = SegmentId(prev),
            next => self.list.links[next as usize].prev = prev,
        }
        self.at = SegmentId(if next == NONE { prev } else { next });
        true
    }

    /// Makes the segment under the cursor the first of a closed range: the ones before it go behind the last.
    pub fn make_first(&mut self) {
        let prev = self.list.links[self.at.0 as usize].prev;
        if prev == NONE {
            return;
        }
        let (first, last) = (self.range.first, self.range.last);
        self.list.links[last.0 as usize].next = first.0;
        self.list.links[first.0 as usize].prev = last.0;
        self.list.links[prev as usize].next = NONE;
        self.list.links[self.at.0 as usize].prev = NONE;
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
        assert!(size_of::<Segment>() + size_of::<Links>() <= 64);
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
            let b = turned(list.append(chain(&[7.0, 8.0])).expect("one segment"));
            let expected: Vec<_> = list.walk(a).chain(list.walk(b)).collect();
            assert_eq!(list.join(a, b.reversed()), None);
            assert_eq!(list.join(a, a), None);
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
