//! The set of patterns: a file becomes the pieces that are cut of it, on the cloth.

use super::choice::{Asked, Chosen};
use super::entity::{Block, Sections, sections};
use super::group::groups;
use super::lay::{Drawn, Laid, Motion, in_a_row};
use super::piece::{Making, Piece};
use super::placing::{MOST_PIECES, Placing};
use super::shape::{Reader, Shapes, Unread};
use super::tally::Tally;
use super::text::Facts;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::geom::budget::Budget;
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::machine::patterns::Dxf;
use crate::source::{Source, Span};
use crate::units::MM_PER_INCH;

/// The pieces of a file.
#[derive(Debug, Default)]
pub(super) struct Set {
    pieces: Vec<Piece>,
    /// Which of them each block draws, in the order of the file.
    drawn: Vec<Drawn>,
    /// Where each lies when the file says so: its place among the pieces, and how it is moved.
    placed: Option<Vec<(usize, Motion)>>,
    /// Room between those that lie in a row, mm.
    gap: f64,
    /// Texts that are of no piece.
    pub(super) texts: Vec<Label>,
}

impl Set {
    /// The pieces on the cloth, in the order of the file.
    pub(super) fn laid(&self) -> Vec<Laid<'_>> {
        match &self.placed {
            None => in_a_row(&self.pieces, &self.drawn, self.gap),
            Some(placed) => placed.iter().map(|&(k, motion)| Laid { piece: &self.pieces[k], motion }).collect(),
        }
    }
}

/// Reads a file. With an error among the diagnostics what is read is worth nothing.
pub(super) fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Set {
    let groups = groups(source, out);
    let Sections { blocks, entities } = sections(source, &groups, out);
    let blocks: Vec<(&Block, Facts)> = blocks.iter().map(|block| (block, Facts::of(&block.entities, source))).collect();
    let of_all = |facts: Facts, (_, of_block): &(&Block, Facts)| facts.or(*of_block, source);
    let file = blocks.iter().fold(Facts::of(&entities, source), of_all);
    let asked = Asked { source, job, file };
    let unit = unit(&asked, out);
    let mut reader = Reader {
        source,
        unit,
        sagitta: job.profile.tolerance(0.0) * Dxf::CHORDS_OFF,
        chords: 0,
        unread: Unread::new(),
        on_paper: None,
        out,
    };
    let drawn: Vec<Shapes> = blocks.iter().map(|(block, _)| reader.shapes(&block.entities)).collect();
    let mut loose = reader.shapes(&entities);
    let bases: Vec<Point> = blocks.iter().map(|(block, _)| reader.base(&block.head)).collect();
    let (unread, on_paper) = (std::mem::take(&mut reader.unread), reader.on_paper);
    let chosen = Chosen::of(&asked, &blocks, out);
    let mut making =
        Making { notch_depth: job.profile.dxf.notch_mm, work: Budget::of_a_marker(), tally: Tally::default(), out };
    let placing = Placing::of(&blocks, bases, std::mem::take(&mut loose.inserts));
    let is_cut: Vec<bool> = drawn.iter().map(Shapes::is_cut).collect();
    let mut set = Set { gap: job.profile.dxf.gap_mm, ..Set::default() };
    for ((k, (block, facts)), shapes) in blocks.iter().enumerate().zip(drawn) {
        if !chosen.has(facts) {
            set.add(Vec::new(), None);
            continue;
        }
        placing.see_nested(&shapes.inserts, &is_cut, &mut making.tally);
        let quantity = asked.quantity(placing.quantity(k).or(facts.quantity), &mut making.tally);
        set.add(making.pieces(shapes, block.head.span()), quantity);
    }
    set.placed = placing.placed(&set.drawn, &mut making.tally);
    set.texts.clone_from(&loose.texts);
    if !loose.lines.is_empty() || !loose.dots.is_empty() {
        set.add(making.pieces(loose, Span::default()), None);
        // Beside blocks that the file places they lie where they are drawn.
        let pieces = set.drawn.last().map_or(0..0, |drawn| drawn.pieces.clone());
        set.placed.iter_mut().for_each(|placed| placed.extend(pieces.clone().map(|piece| (piece, Motion::STILL))));
    }
    let Making { work, tally, .. } = making;
    tally.report(out);
    say_unread(unread, out);
    say_on_paper(on_paper, out);
    set.say(&chosen, work.is_spent(), out);
    set
}

/// Length of a unit, mm.
fn unit(Asked { source, job, file }: &Asked, out: &mut Diagnostics) -> f64 {
    if let Some(mm) = job.profile.dxf.unit.mm() {
        return mm;
    }
    let Some(span) = file.units else {
        let message = "the file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm";
        let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
        out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
        return 1.0;
    };
    match source.slice(span).to_ascii_uppercase().as_slice() {
        b"METRIC" | b"MM" | b"MILLIMETERS" | b"MILLIMETRES" => 1.0,
        b"ENGLISH" | b"INCH" | b"INCHES" | b"IN" | b"IMPERIAL" => MM_PER_INCH,
        other => {
            let message = format!("`{}` is no unit that pattern DXF knows", other.escape_ascii());
            let finding = Diagnostic::new(&code::DXF_UNIT, message).at(span);
            out.push(finding.hint("say which it is: `--set dxf.unit=mm` or `--set dxf.unit=inch`"));
            1.0
        }
    }
}

impl Set {
    /// Adds the pieces that a block draws.
    fn add(&mut self, pieces: Vec<Piece>, quantity: Option<[u32; 2]>) {
        let first = self.pieces.len();
        self.pieces.extend(pieces);
        self.drawn.push(Drawn { pieces: first..self.pieces.len(), quantity });
    }

    /// How many pieces lie on the cloth.
    fn count(&self) -> usize {
        match &self.placed {
            Some(placed) => placed.len(),
            None => self.drawn.iter().map(|drawn| drawn.pieces.len() * drawn.times()).sum(),
        }
    }

    /// What is to be said of the set as a whole.
    fn say(&self, chosen: &Chosen, is_spent: bool, out: &mut Diagnostics) {
        let count = self.count();
        if is_spent || count > MOST_PIECES {
            let message = "the file has more pieces, notches or outlines than can be told apart";
            out.push(Diagnostic::new(&code::DXF_TOO_MANY, message).hint("look at the quantities, and split the file"));
        } else if count == 0 {
            if !out.has_errors() {
                let message = format!("the file holds no outline on layer 1{}", chosen.told());
                let hint = "pattern DXF (AAMA, ASTM D6673) has the outlines of its pieces on layer 1: export it so";
                out.push(Diagnostic::new(&code::DXF_NOTHING_TO_CUT, message).hint(hint));
            }
        } else if self.placed.is_none() && count > 1 && !out.has_errors() {
            let message =
                format!("patterns are no marker: {count} pieces{} lie in a row, {} mm apart", chosen.told(), self.gap);
            let finding = Diagnostic::new(&code::DXF_SAMPLE, message);
            out.push(finding.hint("it is a cutting sample: for a lay make a marker of it in the CAD system"));
        }
    }
}

/// What kinds of entities are not read.
fn say_unread(unread: Unread, out: &mut Diagnostics) {
    for (kind, (count, span)) in unread {
        let message = format!("{count} of the kind {kind} {} not read", if count == 1 { "is" } else { "are" });
        let finding = Diagnostic::new(&code::DXF_UNREAD, message).at(span);
        out.push(finding.hint("none of them is on a layer that is cut"));
    }
}

/// How much stands on the sheet around the drawing.
fn say_on_paper(on_paper: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = on_paper {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let finding = Diagnostic::new(&code::DXF_ON_PAPER, format!("{message} in paper space and not cut")).at(span);
        out.push(finding.hint("what is cut must be drawn in model space"));
    }
}
