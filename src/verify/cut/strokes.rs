//! The strokes of a program as they are read, before anybody knows what they cut.

use std::ops::Range;
use std::sync::Arc;

use crate::verify::program::row::{Going, Row};

/// Strokes, one behind the other; the last one may not have ended yet.
#[derive(Debug, Default)]
pub(in crate::verify) struct Strokes {
    track: Arc<Track>,
    /// Where each stroke ends among the rows.
    ends: Vec<usize>,
}

/// The rows of strokes, and how the axes go at each when they have no time but tell that.
#[derive(Debug, Default)]
struct Track {
    rows: Vec<Row>,
    goings: Vec<Going>,
}

impl Strokes {
    /// None yet, with room for so many rows.
    pub(in crate::verify) fn with_room(rows: usize) -> Self {
        let track = Track { rows: Vec::with_capacity(rows), goings: Vec::with_capacity(rows) };
        Self { track: Arc::new(track), ends: Vec::new() }
    }

    /// A row of the stroke that has not ended.
    pub(in crate::verify) fn push(&mut self, row: &Row, going: Option<Going>) {
        let track = Arc::get_mut(&mut self.track).expect("no stroke is given out before all are gathered");
        track.rows.push(*row);
        track.goings.extend(going);
    }

    /// Whether a stroke has begun that has not ended.
    pub(in crate::verify) fn are_open(&self) -> bool {
        self.rows() > self.ends.last().copied().unwrap_or(0)
    }

    /// Ends the stroke that has begun.
    pub(in crate::verify) fn end(&mut self) {
        self.ends.push(self.rows());
    }

    /// Number of rows.
    pub(in crate::verify) fn rows(&self) -> usize {
        self.track.rows.len()
    }

    /// The strokes that have ended.
    pub(in crate::verify) fn all(&self) -> Vec<Stroke> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(from, &to)| Stroke { track: Arc::clone(&self.track), range: from..to }).collect()
    }
}

/// The rows of a stroke, from that of the plunge to that of the lift.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Stroke {
    track: Arc<Track>,
    range: Range<usize>,
}

impl Stroke {
    /// Its rows.
    pub(in crate::verify) fn rows(&self) -> &[Row] {
        &self.track.rows[self.range.clone()]
    }

    /// How the axes go at each; none when the rows have a time.
    pub(in crate::verify) fn goings(&self) -> &[Going] {
        self.track.goings.get(self.range.clone()).unwrap_or_default()
    }
}
