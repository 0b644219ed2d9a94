//! The set of patterns: a file becomes the pieces that are cut of it, on the cloth.

use super::choice::{self, Chosen};
use super::entity::{Block, NAME, Sections, sections};
use super::group::groups;
use super::lay::{Drawn, Laid, Motion, in_a_row};
use super::piece::{Making, Piece};
use super::shape::{Insert, Reader, Shapes};
use super::tally::{Tally, Thing};
use super::text::Facts;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::budget::Budget;
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::source::{Source, Span};
use crate::units::MM_PER_INCH;

/// Codes of the base point of a block.
const BASE: [i32; 2] = [10, 20];
/// Farthest that the chords of a curve may lie off it, as a part of the tolerance.
const SAGITTA: f64 = 0.25;
/// Most pieces that are laid.
const MOST_PIECES: usize = 100_000;

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
    let file = blocks.iter().fold(Facts::of(&entities, source), |facts, (_, of_block)| facts.or(*of_block));
    let unit = unit(&file, source, job, out);
    let mut reader = Reader {
        source,
        unit,
        sagitta: job.profile.tolerance(0.0) * SAGITTA,
        chords: 0,
        unread: std::collections::BTreeMap::new(),
        out,
    };
    let drawn: Vec<Shapes> = blocks.iter().map(|(block, _)| reader.shapes(&block.entities)).collect();
    let mut loose = reader.shapes(&entities);
    let bases: Vec<_> = blocks.iter().map(|(block, _)| reader.place(&block.head, BASE).unwrap_or_default()).collect();
    let unread = std::mem::take(&mut reader.unread);
    let chosen = Chosen::of(&blocks, &file, source, job, out);
    let inserts = std::mem::take(&mut loose.inserts);
    let mut making =
        Making { notch_depth: job.profile.dxf.notch_mm, work: Budget::of_a_marker(), tally: Tally::default(), out };
    let mut set = Set { gap: job.profile.dxf.gap_mm, ..Set::default() };
    for ((block, facts), shapes) in blocks.iter().zip(drawn) {
        let is_chosen = chosen.has(facts);
        let quantity = if is_chosen { quantity(facts, source, job, &mut making.tally) } else { [0; 2] };
        let pieces = if is_chosen { making.pieces(shapes, block.head.span()) } else { Vec::new() };
        set.add(pieces, quantity);
    }
    set.placed = placed(&blocks, &bases, &set.drawn, &inserts, &mut making.tally);
    set.texts.clone_from(&loose.texts);
    if !loose.lines.is_empty() {
        set.add(making.pieces(loose, Span::default()), [1, 0]);
        // Beside blocks that the file places they lie where they are drawn.
        let pieces = set.drawn.last().map_or(0..0, |drawn| drawn.pieces.clone());
        set.placed.iter_mut().for_each(|placed| placed.extend(pieces.clone().map(|piece| (piece, Motion::STILL))));
    }
    let Making { work, tally, .. } = making;
    tally.report(out);
    say_unread(unread, out);
    say_set(&set, &chosen, work.is_spent(), out);
    set
}

/// Length of a unit, mm.
fn unit(file: &Facts, source: &Source, job: &Job, out: &mut Diagnostics) -> f64 {
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

/// How often a block is cut.
fn quantity(facts: &Facts, source: &Source, job: &Job, tally: &mut Tally) -> [u32; 2] {
    let Some(span) = facts.quantity.filter(|_| choice::is_as_the_file_says(job)) else { return [1, 0] };
    choice::quantity(source.slice(span)).unwrap_or_else(|| {
        tally.add(Thing::Quantity, span);
        [1, 0]
    })
}

/// Where the insertions of a file put its pieces; `None` when all of them put them nowhere, at the origin.
fn placed(
    blocks: &[(&Block, Facts)],
    bases: &[crate::geom::Point],
    drawn: &[Drawn],
    inserts: &[Insert],
    tally: &mut Tally,
) -> Option<Vec<(usize, Motion)>> {
    let name = |block: &Block| block.head.bytes(NAME).to_ascii_uppercase();
    let mut names: Vec<(Vec<u8>, usize)> = blocks.iter().enumerate().map(|(k, (block, _))| (name(block), k)).collect();
    names.sort();
    let find = |insert: &Insert| {
        let wanted = insert.name.to_ascii_uppercase();
        let k = names.partition_point(|(name, _)| *name < wanted);
        names.get(k).filter(|(name, _)| *name == wanted).map(|(_, k)| *k)
    };
    let mut is_placing = false;
    let mut is_used = vec![false; blocks.len()];
    let mut placed = Vec::new();
    for insert in inserts {
        let Some(k) = find(insert) else {
            tally.add(Thing::NoBlock, insert.span);
            continue;
        };
        is_used[k] = true;
        if insert.scale.iter().any(|scale| scale.abs() != 1.0) {
            tally.add(Thing::Scaled, insert.span);
        }
        let pieces = drawn[k].pieces.clone();
        is_placing |= !pieces.is_empty() && (insert.at != bases[k] || insert.turn != 0.0 || insert.scale != [1.0; 2]);
        placed.extend(pieces.map(|piece| (piece, Motion::of_insert(insert, bases[k]))));
    }
    if !is_placing {
        return None;
    }
    for (k, (block, _)) in blocks.iter().enumerate() {
        if !is_used[k] && !drawn[k].pieces.is_empty() {
            tally.add(Thing::NotPlaced, block.head.span());
        }
    }
    Some(placed)
}

impl Set {
    /// Adds the pieces that a block draws.
    fn add(&mut self, pieces: Vec<Piece>, quantity: [u32; 2]) {
        let first = self.pieces.len();
        self.pieces.extend(pieces);
        self.drawn.push(Drawn { pieces: first..self.pieces.len(), quantity });
    }

    /// How many pieces lie on the cloth.
    fn count(&self) -> usize {
        let times = |quantity: &[u32; 2]| quantity.iter().map(|&count| count as usize).sum::<usize>();
        match &self.placed {
            Some(placed) => placed.len(),
            None => self.drawn.iter().map(|drawn| drawn.pieces.len() * times(&drawn.quantity)).sum(),
        }
    }
}

/// What kinds of entities are not read.
fn say_unread(unread: super::shape::Unread, out: &mut Diagnostics) {
    for (kind, (count, span)) in unread {
        let message = format!("{count} of the kind {kind} {} not read", if count == 1 { "is" } else { "are" });
        let finding = Diagnostic::new(&code::DXF_UNREAD, message).at(span);
        out.push(finding.hint("none of them is on a layer that is cut"));
    }
}

/// What is to be said of the set as a whole.
fn say_set(set: &Set, chosen: &Chosen, is_spent: bool, out: &mut Diagnostics) {
    let count = set.count();
    if is_spent || count > MOST_PIECES {
        let message = "the file has more pieces, notches or outlines than can be told apart";
        out.push(Diagnostic::new(&code::DXF_TOO_MANY, message).hint("look at the quantities, and split the file"));
    } else if count == 0 {
        if !out.has_errors() {
            let message = format!("the file holds no outline on layer 1{}", chosen.told());
            let hint = "pattern DXF (AAMA, ASTM D6673) has the outlines of its pieces on layer 1: export it so";
            out.push(Diagnostic::new(&code::DXF_NOTHING_TO_CUT, message).hint(hint));
        }
    } else if set.placed.is_none() && count > 1 && !out.has_errors() {
        let message =
            format!("patterns are no marker: {count} pieces{} lie in a row, {} mm apart", chosen.told(), set.gap);
        let finding = Diagnostic::new(&code::DXF_SAMPLE, message);
        out.push(finding.hint("it is a cutting sample: for a lay make a marker of it in the CAD system"));
    }
}
