//! Removal of pieces without anything to cut.

use crate::ir::marker::{Event, Piece};

/// Drops pieces without anything to cut; controllers insert such an N. Their labels and events move to the next piece; the
/// events of the last ones move to `closing`.
pub(super) fn drop_empty(pieces: &mut Vec<Piece>, closing: &mut Vec<Event>) {
    let mut labels = Vec::new();
    pieces.retain_mut(|piece| {
        if piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty() {
            labels.append(&mut piece.labels);
            closing.append(&mut piece.events);
            return false;
        }
        prepend(&mut labels, &mut piece.labels);
        prepend(closing, &mut piece.events);
        true
    });
    if let Some(last) = pieces.last_mut() {
        last.labels.append(&mut labels);
    }
}

/// Moves `waiting` in front of `own`.
fn prepend<T>(waiting: &mut Vec<T>, own: &mut Vec<T>) {
    if !waiting.is_empty() {
        own.splice(..0, waiting.drain(..));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::ir::marker::{Drill, Label};
    use crate::ir::toolpath;
    use crate::source::Span;

    fn label(start: u32) -> Label {
        Label { at: None, heading: None, span: Span { start, ..Span::default() }, mirrored: None }
    }

    fn piece(number: u32, is_empty: bool) -> Piece {
        let span = Span { start: number, ..Span::default() };
        let hole = Drill { at: Point::origin(), tool: 1, span };
        let event = Event { kind: toolpath::Event::Stop, span };
        let drills = if is_empty { Vec::new() } else { vec![hole] };
        Piece { number, drills, labels: vec![label(number)], events: vec![event], ..Piece::default() }
    }

    #[test]
    fn what_an_empty_piece_says_goes_to_the_next_in_the_order_of_the_file() {
        let mut pieces: Vec<Piece> = [(1, true), (2, true), (3, false), (4, true), (5, false), (6, true)]
            .map(|(number, is_empty)| piece(number, is_empty))
            .into();
        let mut closing = Vec::new();
        drop_empty(&mut pieces, &mut closing);
        let starts = |spans: Vec<Span>| spans.iter().map(|span| span.start).collect::<Vec<_>>();
        let labels: Vec<_> = pieces.iter().map(|p| starts(p.labels.iter().map(|l| l.span).collect())).collect();
        let events: Vec<_> = pieces.iter().map(|p| starts(p.events.iter().map(|e| e.span).collect())).collect();
        assert_eq!(labels, [vec![1, 2, 3], vec![4, 5, 6]]);
        assert_eq!(events, [vec![1, 2, 3], vec![4, 5]]);
        assert_eq!(starts(closing.iter().map(|event| event.span).collect()), [6]);
    }

    #[test]
    fn a_hundred_thousand_empty_pieces_are_dropped_as_they_come() {
        let mut pieces: Vec<Piece> = (0..100_000).map(|number| piece(number, true)).chain([piece(7, false)]).collect();
        drop_empty(&mut pieces, &mut Vec::new());
        assert_eq!((pieces.len(), pieces[0].labels.len()), (1, 100_001));
    }
}
