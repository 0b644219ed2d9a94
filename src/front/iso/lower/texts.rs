//! Labels and messages of a file.

use super::Lowering;
use crate::front::iso::at_place::Texts;
use crate::front::iso::label;
use crate::front::iso::start::Begun;
use crate::front::iso::syntax::Point;
use crate::front::iso::title::Title;
use crate::geom::{self, Heading};
use crate::ir::marker::Label;

impl Lowering<'_> {
    /// Reads a label; `point` is the point in the block of its M31.
    pub(super) fn label(&mut self, point: Option<Point>, texts: Texts) {
        self.settle_second_point();
        self.awaiting = None;
        let text = label::read(&mut self.blocks, point);
        if let Some(span) = text.text {
            self.begin(Begun::label(self.source.slice(span)), span);
        }
        let Some(span) = text.text.filter(|span| texts == Texts::Kept && span.start < span.end) else { return };
        let at = text.at.map(|at| self.peek(at));
        let second = text.second.map(|second| self.peek(second));
        let heading = at.zip(second).and_then(|(at, second)| direction(at, second));
        let id = self.knife.label(Label { at, heading, span, mirrored: text.mirrored });
        // Only the layout that starts with the point can have its second point later.
        self.awaiting = (point.is_some() && second.is_none()).then_some(id);
    }

    /// Uses the position as the second point of the pending label: the knife has not plunged there.
    pub(super) fn settle_second_point(&mut self) {
        let place = self.knife.at();
        if let Some(id) = self.second.take()
            && let Some(label) = self.knife.label_mut(id)
        {
            label.heading = label.at.and_then(|at| direction(at, place));
        }
    }

    /// Reads the text after M20.
    pub(super) fn message(&mut self) {
        if let Some(span) = self.blocks.next_text() {
            self.title = self.title.or(Title::read(self.source.slice(span), span));
        }
    }
}

fn direction(from: geom::Point, to: geom::Point) -> Option<Heading> {
    (from != to).then(|| Heading::of(to - from))
}
