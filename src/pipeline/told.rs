//! Details of a broken rule beside its figures: the piece, and the line of the program with its text, so that people find both.

use std::io::{self, BufRead, BufReader};

use super::place::name;
use super::product::{BLOCK, Medium};
use crate::diagnostic::PieceName;
use crate::geom::{Point, polyline};
use crate::ir::marker::{Notch, Piece};
use crate::ir::verdict::Verdict;
use crate::ir::{Finding, Marker};
use crate::machine::Job;
use crate::source::Source;
use crate::verify::{self, rules};

/// Greatest number of letters of a program line that are shown.
const LETTERS: usize = 100;

/// A verdict with the details of each broken rule, in the order of [`Verdict::broken`].
#[derive(Debug)]
pub struct Explained {
    /// The verdict.
    pub verdict: Verdict,
    /// The details.
    pub told: Vec<Told>,
}

impl Explained {
    /// The findings, with details for those that do not hold.
    pub fn findings(&self) -> impl Iterator<Item = (&Finding, Option<&Told>)> {
        let mut told = self.told.iter();
        self.verdict.findings.iter().map(move |finding| (finding, if finding.holds() { None } else { told.next() }))
    }
}

/// Details of a broken rule.
#[derive(Debug, Default)]
pub struct Told {
    /// Piece at the worst value; `None` if it was seen at no piece.
    pub piece: Option<PieceName>,
    /// Pieces of which nothing is cut, for the rule about that.
    pub uncut: Vec<PieceName>,
    /// Place in the program.
    pub line: Option<Line>,
}

/// A place in a program.
#[derive(Debug)]
pub enum Line {
    /// A line, the first being 1.
    Text {
        /// Its number.
        number: u64,
        /// Its text, shortened.
        text: String,
    },
    /// A record of a program without lines, the first being 0.
    Record(u64),
    /// A row of one of several heads, the first of each being 1.
    Row {
        /// The head, from 1.
        head: u32,
        /// The row.
        number: u64,
    },
    /// An entry of a program that is sewn, the first being 1.
    Entry(u64),
}

/// Details of each rule that a program breaks, without quoted lines.
pub fn told(verdict: &Verdict, marker: &Marker, source: &Source, job: &Job) -> Vec<Told> {
    let letters = marker.letters(&job.profile.labels);
    let named = |piece: &Piece| name(piece, source, letters);
    let tell = |finding: &Finding| {
        let place = finding.place?;
        let uncut = if finding.rule == &rules::COMPLETE { &verdict.uncut[..] } else { &[] };
        let line = place.line.map(|number| match place.head {
            0 => Line::Record(number),
            head => Line::Row { head, number },
        });
        let uncut = uncut.iter().map(|&piece| named(&marker.pieces[piece as usize])).collect();
        Some(Told { piece: piece_of(marker, place.block, place.point).map(named), uncut, line })
    };
    verdict.broken().map(|finding| tell(finding).unwrap_or_default()).collect()
}

/// Quotes the lines of a program that the details refer to, if it has lines.
pub fn quote(told: &mut [Told], program: &mut dyn Medium, job: &Job) -> io::Result<()> {
    program.rewind()?;
    let mut program = BufReader::with_capacity(BLOCK, program);
    if !verify::has_lines(&mut program, &job.profile) {
        return Ok(());
    }
    let places = told.iter_mut().filter_map(|told| told.line.as_mut());
    let mut lines: Vec<(u64, &mut Line)> = places.filter_map(|line| numbered(line).map(|n| (n, line))).collect();
    lines.sort_by_key(|(number, _)| *number);
    let (mut text, mut read) = (Vec::new(), 0);
    for (number, line) in lines {
        while read < number {
            text.clear();
            if program.read_until(b'\n', &mut text)? == 0 {
                return Ok(());
            }
            read += 1;
        }
        // Characters that a terminal would obey are shown as escapes.
        let all: String = String::from_utf8_lossy(text.trim_ascii_end()).escape_debug().collect();
        let text = match all.char_indices().nth(LETTERS) {
            Some((end, _)) => format!("{}...", &all[..end]),
            None => all,
        };
        *line = Line::Text { number, text };
    }
    Ok(())
}

/// Number of a place that can be quoted.
fn numbered(line: &Line) -> Option<u64> {
    match line {
        Line::Record(number) => Some(*number),
        Line::Text { .. } | Line::Row { .. } | Line::Entry(_) => None,
    }
}

/// The piece in which a block cuts; among several copies, the nearest to a place.
fn piece_of(marker: &Marker, block: u32, place: Point) -> Option<&Piece> {
    let has = |piece: &&Piece| {
        let contours = piece.contours.iter().flat_map(|contour| marker.list.walk(contour.range)).map(|(_, s)| s.span);
        let notches = piece.notches.iter().flat_map(Notch::strokes).map(|stroke| stroke.span);
        let drills = piece.drills.iter().map(|drill| drill.span);
        contours.chain(notches).chain(drills).any(|span| span.block == block)
    };
    let pieces = marker.pieces.iter().filter(|_| block > 0);
    if marker.pieces.iter().all(|piece| piece.copy == 0) {
        return pieces.clone().find(has);
    }
    let away = |piece: &Piece| {
        let contours = piece.contours.iter().flat_map(|contour| marker.list.lines(contour.range));
        let ways = contours.chain(piece.notches.iter().map(|notch| [notch.root, notch.tip]));
        let ways = ways.chain(piece.drills.iter().map(|drill| [drill.at; 2]));
        ways.map(|[from, to]| polyline::distance_to_segment(place, from, to)).fold(f64::INFINITY, f64::min)
    };
    pieces.filter(has).map(|piece| (away(piece), piece)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, piece)| piece)
}
