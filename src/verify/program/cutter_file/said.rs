//! Statements of a cut file, and the statements that a marker requires.

use std::f64::consts::PI;

use crate::geom::{Heading, Point, angle};
use crate::ir::Marker;
use crate::ir::list::{Joint, Range};
use crate::ir::marker::{Event, NotchKind, Piece};
use crate::ir::toolpath;
use crate::ir::verdict::Sighting;
use crate::source::Source;

/// Greatest difference between two directions due to the six decimals of a distant second point, rad.
const DIRECTION_EPSILON: f64 = 1e-8;
/// Greatest relative difference between two feeds.
const FEED_EPSILON: f64 = 1e-6;

/// Statement of a cut file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Said {
    Piece(u32),
    Event(toolpath::Event),
    /// Advance of the cloth by so many mm.
    Advance(f64),
    Hole(Point, u8),
    Label {
        text: Vec<u8>,
        mirrored: Option<Vec<u8>>,
        at: Option<Point>,
        direction: Option<f64>,
    },
    Slit(Cut),
    Bar(Cut),
    Contour(Cut),
    Field(u8, Vec<u8>),
}

/// Line that is cut.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Cut {
    pub(super) points: Vec<Point>,
    /// Speed of each chord, percent, and the commands at its start.
    pub(super) chords: Vec<(u8, Joint)>,
    /// Feed of the piece, mm/s.
    pub(super) feed: Option<f64>,
    /// Block of the first chord, 0 when unknown.
    pub(super) block: u32,
}

impl Said {
    /// Distance between the places of two statements, mm; `None` when the statements differ in anything else.
    pub(super) fn away(&self, other: &Self) -> Option<f64> {
        let apart = |a: Point, b: Point| (a - b).norm();
        match (self, other) {
            (Self::Hole(a, tool), Self::Hole(b, other)) if tool == other => Some(apart(*a, *b)),
            (Self::Advance(one), Self::Advance(other)) => Some((one - other).abs()),
            (
                Self::Label { text, mirrored, at, direction },
                Self::Label { text: t, mirrored: m, at: a, direction: d },
            ) => {
                let turned = match (direction, d) {
                    (Some(one), Some(other)) => angle::wrap(one - other).abs(),
                    (None, None) => 0.0,
                    _ => PI,
                };
                let same = text == t && mirrored == m && turned <= DIRECTION_EPSILON && at.is_some() == a.is_some();
                same.then(|| at.zip(*a).map_or(0.0, |(one, other)| apart(one, other)))
            }
            (Self::Slit(a), Self::Slit(b)) | (Self::Bar(a), Self::Bar(b)) | (Self::Contour(a), Self::Contour(b)) => {
                let feed = match (a.feed, b.feed) {
                    (Some(one), Some(other)) => (one - other).abs() <= FEED_EPSILON * other,
                    (None, None) => true,
                    _ => false,
                };
                let same = a.points.len() == b.points.len() && a.chords == b.chords && feed;
                same.then(|| a.points.iter().zip(&b.points).map(|(one, other)| apart(*one, *other)).fold(0.0, f64::max))
            }
            _ => (self == other).then_some(0.0),
        }
    }

    /// Place of the statement; `None` when it has none.
    pub(super) fn sighting(&self) -> Option<Sighting> {
        let (point, block) = match self {
            Self::Hole(at, _) => (*at, 0),
            Self::Slit(cut) | Self::Bar(cut) | Self::Contour(cut) => (*cut.points.first()?, cut.block),
            Self::Label { at, .. } => ((*at)?, 0),
            Self::Piece(_) | Self::Event(_) | Self::Advance(_) | Self::Field(..) => return None,
        };
        Some(Sighting::missing(point, block))
    }
}

/// Statements of a marker, in the order in which they are written.
pub(super) fn expected(marker: &Marker, source: &Source) -> Vec<Said> {
    let is_cut = |piece: &Piece| {
        let is_empty = piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty();
        piece.section.is_some() || !is_empty
    };
    let text = |span| source.slice(span).trim_ascii().to_vec();
    let (mut said, mut waiting, mut fields) = (Vec::new(), (Vec::new(), Vec::new()), Vec::new());
    let last = marker.pieces.iter().rposition(is_cut);
    for (index, piece) in marker.pieces.iter().enumerate() {
        // Events and texts of a piece without cuts go to the next piece with cuts; texts behind the last such piece go to that
        // piece.
        waiting.0.extend(piece.events.iter().map(said_event));
        let labels = piece
            .labels
            .iter()
            .chain(marker.pieces[index + 1..].iter().flat_map(|piece| &piece.labels).filter(|_| last == Some(index)));
        waiting.1.extend(labels.map(|label| Said::Label {
            text: text(label.span),
            mirrored: label.mirrored.map(text),
            at: label.at,
            direction: label.heading.map(Heading::radians),
        }));
        if !is_cut(piece) {
            continue;
        }
        said.push(Said::Piece(piece.number));
        said.append(&mut waiting.0);
        said.extend(piece.drills.iter().map(|drill| Said::Hole(drill.at, drill.tool)));
        said.append(&mut waiting.1);
        for notch in &piece.notches {
            let cut = |from, to, block| Cut {
                points: vec![from, to],
                chords: vec![(notch.percent, Joint::default())],
                feed: piece.feed,
                block,
            };
            said.push(Said::Slit(cut(notch.root, notch.tip, notch.span.block)));
            if let NotchKind::T(bar) = notch.kind {
                said.push(Said::Bar(cut(bar.from, bar.to, bar.span.block)));
            }
        }
        // The cuts of a section stand in place of an outline that is split.
        let split = marker.split_outline(index);
        let whole = piece.contours.iter().enumerate().filter(|(i, _)| Some(*i) != split);
        let ranges = whole.map(|(_, contour)| contour.range).chain(marker.section_cuts(index));
        said.extend(ranges.map(|range| Said::Contour(cut_along(marker, range, piece))));
        // A single list names the pieces of all copies.
        if !piece.fields.is_empty() && piece.copy < 2 {
            let named = matches!(piece.fields[0].letter, b'L' | b'N');
            fields.push((named, piece));
        }
    }
    said.extend(waiting.0);
    said.extend(marker.closing.iter().map(said_event));
    fields.sort_by_key(|(named, _)| *named); // stable: fields without a name first
    let values = fields.iter().flat_map(|(_, piece)| &piece.fields);
    said.extend(values.map(|field| Said::Field(field.letter, source.slice(field.span).to_vec())));
    said
}

/// Cut along a range of the list of segments.
fn cut_along(marker: &Marker, range: Range, piece: &Piece) -> Cut {
    let mut cut = Cut { points: marker.list.points(range).into_owned(), feed: piece.feed, ..Cut::default() };
    for (_, segment) in marker.list.walk(range) {
        cut.block = if cut.chords.is_empty() { segment.span.block } else { cut.block };
        cut.chords.push((segment.percent, segment.joint));
    }
    cut
}

/// Event as a cut file states it.
fn said_event(event: &Event) -> Said {
    match event.kind {
        toolpath::Event::AdvanceBy(mm) => Said::Advance(f64::from(mm)),
        plain @ (toolpath::Event::Stop | toolpath::Event::Advance) => Said::Event(plain),
    }
}
