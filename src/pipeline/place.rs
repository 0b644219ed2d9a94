//! Places of findings on the cloth: the piece and the point for a span of the source.

use std::collections::BTreeMap;

use crate::diagnostic::{Diagnostics, PieceName};
use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::marker::{Notch, Piece};
use crate::machine::Job;
use crate::machine::letters::Letters;
use crate::source::{Source, Span};

/// Greatest number of letters of a label that are shown.
const LETTERS: usize = 24;

/// Adds piece and point to findings with a span, as far as the marker knows them. Known places stay, and so do the first
/// `known` findings. One walk over the marker, and none without such findings.
pub fn place(diagnostics: &mut Diagnostics, known: usize, marker: &Marker, source: &Source, job: &Job) {
    let mut wanted: BTreeMap<u32, Vec<OnCloth>> = BTreeMap::new();
    for finding in diagnostics.iter().skip(known).filter(|finding| finding.piece.is_none()) {
        wanted.extend(finding.span.map(|span| (span.start, Vec::new())));
    }
    let Some((least, most)) = wanted.keys().copied().next().zip(wanted.keys().copied().next_back()) else { return };
    for (i, piece) in marker.pieces.iter().enumerate() {
        let mut see = |span: Span, point: Option<Point>| {
            // Segments without a block have no place in the source.
            if span.block > 0
                && let Some(places) = wanted.get_mut(&span.start)
                // The first one in each piece; a block of a drawing may be several pieces.
                && places.last().is_none_or(|place| place.piece != Some(i))
            {
                places.push(OnCloth { piece: Some(i), point });
            }
        };
        for contour in &piece.contours {
            // The first segment of a contour stands for its first point as well, which is in no other's span.
            let (points, spans) = (marker.list.points(contour.range), marker.list.spans(contour.range));
            let ends = spans.iter().zip(&points[1..]).filter(|(span, _)| (least..=most).contains(&span.start));
            ends.for_each(|(&span, &to)| see(span, Some(to)));
        }
        piece.notches.iter().flat_map(Notch::strokes).for_each(|stroke| see(stroke.span, Some(stroke.to)));
        piece.drills.iter().for_each(|drill| see(drill.span, Some(drill.at)));
        piece.labels.iter().for_each(|label| see(label.span, label.at));
        piece.events.iter().for_each(|event| see(event.span, None));
        see(piece.span, None);
    }
    // Other lines of a drawing belong to no piece.
    for vertex in marker.drawing.iter().flat_map(|account| &account.aside.vertices) {
        if let Some(places) = wanted.get_mut(&vertex.span.start).filter(|places| places.is_empty()) {
            places.push(OnCloth { piece: None, point: Some(vertex.at) });
        }
    }
    let letters = marker.letters(&job.profile.labels);
    diagnostics.revise(known, |finding| {
        let places = finding.span.and_then(|span| wanted.get(&span.start)).into_iter().flatten();
        // Of several, one that the finding is about, at its place.
        let is_other = |place: &OnCloth| {
            let number = place.piece.map(|piece| marker.pieces[piece].number);
            !finding.pieces.is_empty() && number.is_none_or(|number| !finding.pieces.contains(&number))
        };
        let away = |place: &OnCloth| {
            let [at, point] =
                [finding.at.as_deref().copied().map(Point::from), place.point].map(|at| at.unwrap_or(Point::origin()));
            if finding.at.is_none() { 0.0 } else { (at - point).norm() }
        };
        let place = places.min_by(|a, b| is_other(a).cmp(&is_other(b)).then(away(a).total_cmp(&away(b))));
        let Some(place) = place.filter(|_| finding.piece.is_none()) else { return };
        finding.piece = place.piece.map(|piece| Box::new(name(&marker.pieces[piece], source, letters)));
        finding.at = finding.at.take().or_else(|| place.point.map(|point| Box::new(point.into())));
    });
}

/// A piece, by its index, and a point of it; no piece for lines that are not cut.
struct OnCloth {
    piece: Option<usize>,
    point: Option<Point>,
}

/// A piece by its number and the start of its first label.
pub(super) fn name(piece: &Piece, source: &Source, letters: Letters) -> PieceName {
    let texts = piece.labels.iter().map(|label| letters.text(source.slice(label.span)));
    let mut texts = texts.map(|text| text.trim().to_owned()).filter(|text| !text.is_empty());
    let label = texts.next().map(|text| match text.char_indices().nth(LETTERS) {
        Some((end, _)) => format!("{}...", text[..end].trim_end()),
        None => text,
    });
    PieceName { number: piece.number, copy: piece.copy, label }
}
