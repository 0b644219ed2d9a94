//! Vertices of the knife path, stored in the layout of the segment list: separate vectors of points, blocks, and requests of
//! codes.

use crate::geom::Point;
use crate::ir::list::{FULL_SPEED, Joint, Range, SegmentList};
use crate::source::Span;

/// A vertex of the knife path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub(super) at: Point,
    pub(super) span: Span,
    pub(super) joint: Joint,
    /// Speed of the motion to it, percent.
    pub(super) percent: u8,
}

/// Requests of codes at a vertex; the default is none, as at most vertices.
#[derive(Debug, Clone, Copy)]
struct Asked {
    joint: Joint,
    percent: u8,
}

impl Default for Asked {
    fn default() -> Self {
        Self { joint: Joint::default(), percent: FULL_SPEED }
    }
}

impl Asked {
    fn is_nothing(self) -> bool {
        self.joint == Joint::default() && self.percent == FULL_SPEED
    }
}

/// Vertices in order.
#[derive(Debug, Default)]
pub(super) struct Vertices {
    points: Vec<Point>,
    spans: Vec<Span>,
    /// Requests up to the last vertex that has one; may be shorter than `points`.
    asked: Vec<Asked>,
}

impl Vertices {
    pub(super) fn push(&mut self, Vertex { at, span, joint, percent }: Vertex) {
        let asked = Asked { joint, percent };
        if !asked.is_nothing() {
            *self.asked_mut(self.points.len()) = asked;
        }
        self.points.push(at);
        self.spans.push(span);
    }

    /// Appends vertices without requests.
    pub(super) fn extend(&mut self, points: impl ExactSizeIterator<Item = Point>, spans: &[Span]) {
        self.points.extend(points);
        self.spans.extend_from_slice(spans);
    }

    /// Sets the speed of the motion to each vertex from index `first` on, percent.
    pub(super) fn set_speed(&mut self, first: usize, percent: u8) {
        if percent != FULL_SPEED {
            (first..self.points.len()).for_each(|i| self.asked_mut(i).percent = percent);
        }
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points
    }

    pub(super) fn get(&self, i: usize) -> Option<Vertex> {
        let (&at, &span) = self.points.get(i).zip(self.spans.get(i))?;
        let Asked { joint, percent } = self.asked(i);
        Some(Vertex { at, span, joint, percent })
    }

    /// The joint of a vertex, for changes.
    pub(super) fn joint_mut(&mut self, i: usize) -> &mut Joint {
        &mut self.asked_mut(i).joint
    }

    fn asked(&self, i: usize) -> Asked {
        self.asked.get(i).copied().unwrap_or_default()
    }

    fn asked_mut(&mut self, i: usize) -> &mut Asked {
        if self.asked.len() <= i {
            self.asked.resize(i + 1, Asked::default());
        }
        &mut self.asked[i]
    }

    /// Removes the last vertex.
    pub(super) fn pop(&mut self) {
        self.points.pop();
        self.spans.pop();
        self.asked.truncate(self.points.len());
    }

    /// Removes all vertices and keeps the capacity.
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.spans.clear();
        self.asked.clear();
    }

    /// Writes the segments between the vertices into a list; `None` if there are none.
    pub(super) fn write(&self, list: &mut SegmentList) -> Option<Range> {
        let mut range = list.append_line(&self.points, &self.spans)?;
        let mut cursor = list.cursor(&mut range);
        for i in 0..self.asked.len() {
            let (joint, percent) = (self.asked(i).joint, self.asked(i + 1).percent);
            if !(Asked { joint, percent }).is_nothing() {
                (*cursor.joint_mut(), *cursor.percent_mut()) = (joint, percent);
            }
            if !cursor.advance() {
                break;
            }
        }
        Some(range)
    }
}

impl FromIterator<Vertex> for Vertices {
    fn from_iter<I: IntoIterator<Item = Vertex>>(all: I) -> Self {
        let mut vertices = Self::default();
        all.into_iter().for_each(|vertex| vertices.push(vertex));
        vertices
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_asked_at_a_vertex_comes_to_the_segments_beside_it() {
        let vertex = |x: f64, lift: bool, percent: u8| Vertex {
            at: Point::new(x, 0.0),
            span: Span { block: x as u32, ..Span::default() },
            joint: Joint { lift, ..Joint::default() },
            percent,
        };
        let all = [vertex(1.0, false, 7), vertex(2.0, true, 100), vertex(3.0, false, 50), vertex(4.0, true, 100)];
        let mut vertices: Vertices = all.into_iter().collect();
        assert!((0..5).map(|i| vertices.get(i)).eq(all.into_iter().map(Some).chain([None])));
        let mut list = SegmentList::default();
        let mut found = |vertices: &Vertices| -> Vec<_> {
            let range = vertices.write(&mut list).expect("two vertices at least");
            list.walk(range).map(|(_, s)| (s.from.x, s.span.block, s.joint.lift, s.percent)).collect()
        };
        let expected = [(1.0, 2, false, 100), (2.0, 3, true, 50), (3.0, 4, false, 100)];
        assert_eq!(found(&vertices), expected);
        vertices.pop();
        assert_eq!(found(&vertices), expected[..2]);
        vertices.joint_mut(0).lift = true;
        assert_eq!(found(&vertices)[0], (1.0, 2, true, 100));
        vertices.clear();
        vertices.push(all[0]);
        assert_eq!(vertices.write(&mut list), None);
    }
}
