//! The worst of many similar places that a pass reports, and their number.

/// Worst of the places recorded in a toolpath.
#[derive(Debug)]
pub(super) struct Worst<T> {
    count: usize,
    worst: Option<T>,
}

impl<T> Default for Worst<T> {
    fn default() -> Self {
        Self { count: 0, worst: None }
    }
}

impl<T> Worst<T> {
    /// Records a place. The first of several equally bad ones is the worst.
    pub(super) fn see<B: PartialOrd>(&mut self, place: T, badness: impl Fn(&T) -> B) {
        self.count += 1;
        if self.worst.as_ref().is_none_or(|worst| badness(&place) > badness(worst)) {
            self.worst = Some(place);
        }
    }

    /// Worst place; `None` if none was recorded.
    pub(super) fn place(&self) -> Option<&T> {
        self.worst.as_ref()
    }

    /// Number of places besides the worst, in words.
    pub(super) fn and_more(&self) -> String {
        match self.count.saturating_sub(1) {
            0 => String::new(),
            n => format!(" ({n} more in this contour)"),
        }
    }
}
