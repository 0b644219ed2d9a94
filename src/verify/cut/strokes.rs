//! Strokes of a program as they are read, before they are assigned to lines.

use std::ops::Range;
use std::sync::Arc;

use crate::verify::program::row::{Going, Row};

/// Sequence of strokes; the last one may still be open.
#[derive(Debug, Default)]
pub(in crate::verify) struct Strokes {
    track: Arc<Track>,
    /// End of each stroke among the rows.
    ends: Vec<usize>,
}

/// Rows of strokes, and the motion at each row for programs without time.
#[derive(Debug, Default)]
struct Track {
    rows: Vec<Row>,
    goings: Vec<Going>,
}

impl Strokes {
    /// Empty sequence with capacity for `rows` rows.
    pub(in crate::verify) fn with_room(rows: usize) -> Self {
        let track = Track { rows: Vec::with_capacity(rows), goings: Vec::with_capacity(rows) };
        Self { track: Arc::new(track), ends: Vec::new() }
    }

    /// Adds a row to the open stroke.
    pub(in crate::verify) fn push(&mut self, row: Row, going: Option<Going>) {
        let track = Arc::get_mut(&mut self.track).expect("no stroke is given out before all are gathered");
        track.rows.push(row);
        if let Some(going) = going {
            track.goings.push(going);
        }
    }

    /// True if a stroke is open.
    pub(in crate::verify) fn are_open(&self) -> bool {
        self.rows() > self.ends.last().copied().unwrap_or(0)
    }

    /// Ends the open stroke.
    pub(in crate::verify) fn end(&mut self) {
        self.ends.push(self.rows());
    }

    /// Number of rows.
    pub(in crate::verify) fn rows(&self) -> usize {
        self.track.rows.len()
    }

    /// Strokes that have ended.
    pub(in crate::verify) fn all(&self) -> Vec<Stroke> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(from, &to)| Stroke { track: Arc::clone(&self.track), range: from..to }).collect()
    }
}

/// Rows of a stroke, from the plunge to the lift.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Stroke {
    track: Arc<Track>,
    range: Range<usize>,
}

impl Stroke {
    /// Rows of the stroke.
    pub(in crate::verify) fn rows(&self) -> &[Row] {
        &self.track.rows[self.range.clone()]
    }

    /// Motion at each row; empty when the rows have a time.
    pub(in crate::verify) fn goings(&self) -> &[Going] {
        self.track.goings.get(self.range.clone()).unwrap_or_default()
    }
}
