//! Knife-down and knife-up.

use super::Lowering;
use crate::source::Span;

impl Lowering<'_> {
    pub(super) fn down(&mut self, span: Span) {
        if self.place.contains(&None) && !self.damaged {
            self.alone.down_without_place(self.place != [None, None], span);
        }
        if self.place != [None, None] && !self.knife.is_down() {
            self.start.finding(span).into_iter().for_each(|finding| self.out.push(finding));
        }
        self.head.pass();
        if !self.knife.is_down() {
            let stays = !self.start.has_moved();
            self.strokes.down(stays, stays && self.knife.is_at_open_end(), span);
        }
        // This position is the start of a contour, not the second point of a label.
        self.second = None;
        self.awaiting = None;
        self.fresh = false;
        self.knife.down(span, self.out);
    }

    pub(super) fn up(&mut self) {
        self.fresh = false;
        if self.knife.is_down() {
            self.start.serve();
            let finding = self.strokes.up(self.knife.stroke(), self.knife.piece_number());
            if let Some(finding) = finding {
                self.out.push(finding);
            }
        }
        self.knife.up(self.out);
    }
}
