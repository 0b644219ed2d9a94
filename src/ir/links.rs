//! Neighbours in the segment list, as ids.
//!
//! Nearly all segments stay between the segments with the next lower and the next higher id, as they were appended. A large
//! marker that is never edited needs no memory for links.

use super::scattered::Scattered;

/// Neighbours of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link {
    pub(super) prev: u32,
    pub(super) next: u32,
}

impl Link {
    /// The neighbours of a segment in its original position. Neighbours beyond the ends of a range are never read.
    pub(super) fn in_order(id: u32) -> Self {
        Self { prev: id.wrapping_sub(1), next: id.wrapping_add(1) }
    }
}

/// Neighbours of all segments.
#[derive(Debug, Clone, Default)]
pub(super) struct Links {
    moved: Scattered<Link>,
}

impl Links {
    /// Neighbours of a segment.
    pub(super) fn of(&self, id: u32) -> Link {
        self.moved.get(id).unwrap_or(Link::in_order(id))
    }

    /// Links `next` directly after `prev`.
    pub(super) fn join(&mut self, prev: u32, next: u32) {
        self.moved.get_mut(prev, Link::in_order).next = next;
        self.moved.get_mut(next, Link::in_order).prev = prev;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_moved_stands_beside_others() {
        let mut links = Links::default();
        links.join(5, 5000);
        assert_eq!(links.of(5), Link { prev: 4, next: 5000 });
        assert_eq!(links.of(5000), Link { prev: 5, next: 5001 });
        assert_eq!(links.of(6), Link { prev: 5, next: 7 });
        assert_eq!(links.of(2000), Link { prev: 1999, next: 2001 });
        assert_eq!(links.of(1_000_000), Link { prev: 999_999, next: 1_000_001 });
    }
}
