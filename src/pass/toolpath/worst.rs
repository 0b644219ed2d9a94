//! What a pass says of many places alike: the worst of them, and how many there are.

/// The worst of the places that were seen in a toolpath.
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
    /// Sees a place. Of two that are as bad as each other the first is the worst.
    pub(super) fn see<B: PartialOrd>(&mut self, place: T, badness: impl Fn(&T) -> B) {
        self.count += 1;
        if self.worst.as_ref().is_none_or(|worst| badness(&place) > badness(worst)) {
            self.worst = Some(place);
        }
    }

    /// The worst place; `None` when none was seen.
    pub(super) fn place(&self) -> Option<&T> {
        self.worst.as_ref()
    }

    /// How many there are beside the worst, in words.
    pub(super) fn and_more(&self) -> String {
        match self.count.saturating_sub(1) {
            0 => String::new(),
            n => format!(" ({n} more in this contour)"),
        }
    }
}
