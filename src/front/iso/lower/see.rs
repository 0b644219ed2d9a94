//! Damage and foreign numbers in single blocks.

use super::Lowering;
use crate::front::iso::meaning::name;
use crate::front::iso::syntax::{Point, Words};
use crate::front::iso::{misplaced, own};
use crate::source::Span;

impl Lowering<'_> {
    /// Looks for damage in a block, and removes the numbers of codes that are not obeyed.
    pub(super) fn see_words(&mut self, words: &mut Words, span: Span) {
        let (job, is_down) = (self.job, self.knife.is_down());
        let obeys = |code| job.profile.codes.is_empty() || job.profile.obeys(&name(code));
        let is_head = self.place == [None, None] && !is_down;
        let own = own::take(words, is_head, span, obeys);
        if let Some(point) = words.point.filter(|_| words.codes.is_empty()) {
            self.see_place(point, span);
        }
        let misplaced = misplaced::behind_place(words, is_down, span, obeys);
        // Such a block is refused, and what follows from it is not told as well.
        self.damaged |= misplaced.is_some();
        let found = [own, misplaced];
        found.into_iter().flatten().for_each(|fault| self.out.push(fault));
    }

    /// Looks for damage in a block of coordinates only.
    pub(super) fn see_place(&mut self, point: Point, span: Span) {
        self.alone.see(point, span);
        if self.knife.is_down() {
            self.decimals.see(self.source.slice(span), span);
        }
    }
}
