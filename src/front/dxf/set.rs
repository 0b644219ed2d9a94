//! The set of patterns: a file becomes the pieces that are cut of it, on the cloth.

use std::collections::{BTreeMap, BTreeSet};

use super::chain::Chain;
use super::choice::{Asked, Chosen};
use super::entity::{Sections, sections};
use super::group::groups;
use super::lay::{Drawn, Laid, Motion, in_a_row};
use super::layer::Layer;
use super::over;
use super::piece::{Making, Piece};
use super::placing::{Held, MOST_PIECES, Placing};
use super::shape::{Reader, Shapes, Unread};
use super::tally::{Tally, Thing};
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
    /// Its sizes, as they are told.
    sizes: String,
    /// Texts that are of no piece.
    pub(super) texts: Vec<Label>,
    /// Lines of blocks that have no outline, as they are drawn.
    pub(super) apart: Vec<(&'static Layer, Chain)>,
    /// What is not read of it.
    pub(super) unread: Vec<Unread>,
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
    let Sections { blocks, entities, unit: of_header, hidden } = sections(source, &groups, out);
    let own: Vec<Facts> = blocks.iter().map(|block| Facts::of(&block.entities, source)).collect();
    let file = own.iter().fold(Facts::of(&entities, source), |facts, of_block| facts.and(*of_block, source));
    let asked = Asked { source, job, file };
    let unit = unit(&asked, of_header, out);
    let mut reader = Reader {
        source,
        unit,
        sagitta: job.profile.tolerance(0.0) * Dxf::CHORDS_OFF,
        chords: 0,
        on_paper: None,
        hidden_layers: &hidden,
        hidden: None,
        out,
    };
    let drawn: Vec<Shapes> = blocks.iter().map(|block| reader.shapes(&block.entities)).collect();
    let mut loose = reader.shapes(&entities);
    let bases: Vec<Point> = blocks.iter().map(|block| reader.base(&block.head)).collect();
    let (on_paper, hidden) = (reader.on_paper, reader.hidden);
    let placing = Placing::of(source, &blocks, bases, std::mem::take(&mut loose.inserts));
    let facts: Vec<Facts> = own.into_iter().enumerate().map(|(k, own)| placing.facts(k, own)).collect();
    let chosen = Chosen::of(&asked, &facts, out);
    let mut making = Making {
        notch_depth: job.profile.dxf.notch_mm,
        work: Budget::of_a_marker(),
        tally: Tally::default(),
        apart: Vec::new(),
        out,
    };
    let held: Vec<Held> = drawn.iter().map(Held::of).collect();
    let mut set = Set { gap: job.profile.dxf.gap_mm, sizes: chosen.told(), ..Set::default() };
    for ((k, mut shapes), (block, facts)) in drawn.into_iter().enumerate().zip(blocks.iter().zip(&facts)) {
        if !chosen.has(facts) || !placing.is_piece(k) {
            set.add(Vec::new(), None);
            continue;
        }
        set.unread.append(&mut shapes.unread);
        set.unread.extend(placing.nested(&shapes.inserts, &held, &mut making.tally));
        let quantity = asked.quantity(facts.quantity, &mut making.tally);
        set.add(making.pieces(shapes, block.head.span()), quantity);
    }
    set.placed = placing.placed(&set.drawn, &mut making.tally);
    set.texts.clone_from(&loose.texts);
    set.unread.append(&mut loose.unread);
    if !loose.lines.is_empty() || !loose.dots.is_empty() {
        set.add(making.pieces(loose, Span::default()), None);
        // Beside blocks that the file places they lie where they are drawn.
        let pieces = set.drawn.last().map_or(0..0, |drawn| drawn.pieces.clone());
        set.placed.iter_mut().for_each(|placed| placed.extend(pieces.clone().map(|piece| (piece, Motion::STILL))));
    }
    if set.placed.is_some() && !making.out.has_errors() {
        let on_others = over::on_others(&set.laid(), &mut making.work);
        on_others.into_iter().for_each(|span| making.tally.add(Thing::OnAnother, span));
    }
    let Making { work, tally, apart, .. } = making;
    set.apart = apart;
    tally.report(out);
    say_unread(&set.unread, out);
    say_on_paper(on_paper, out);
    say_hidden(hidden, out);
    set.say(work.is_spent(), out);
    set
}

/// Length of the unit that the texts name, else the header, mm.
fn unit(Asked { source, job, file }: &Asked, of_header: Option<Span>, out: &mut Diagnostics) -> f64 {
    if let Some(mm) = job.profile.dxf.unit.mm() {
        return mm;
    }
    let Some(first) = file.units.first else {
        if let Some(mm) = of_header.and_then(|span| unit_of_header(source.slice(span))) {
            return mm;
        }
        let message = "the file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm";
        let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
        out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
        return 1.0;
    };
    let say_which = "say which it is: `--set dxf.unit=mm` or `--set dxf.unit=inch`";
    let told = [Some(first), file.units.other].into_iter().flatten().map(|span| {
        let text = source.slice(span);
        unit_of(text).ok_or_else(|| {
            let message = format!("`{}` is no unit that pattern DXF knows", text.escape_ascii());
            Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(say_which)
        })
    });
    match told.collect::<Result<Vec<f64>, Diagnostic>>().as_deref() {
        Ok(&[mm]) => mm,
        Ok(units) => {
            if let (Some(other), true) = (file.units.other, units.windows(2).any(|pair| pair[0] != pair[1])) {
                let text = |span: Span| source.slice(span).escape_ascii();
                let message = format!("the file has two units, `{}` and `{}`", text(first), text(other));
                out.push(Diagnostic::new(&code::DXF_SAID_TWICE, message).at(other).hint(say_which));
            }
            units.first().copied().unwrap_or(1.0)
        }
        Err(fault) => {
            out.push(fault.clone());
            1.0
        }
    }
}

/// Length of the unit of a number in the header, mm (DXF reference, `$INSUNITS`); `None` for none and for those in which no
/// garment is drawn.
fn unit_of_header(number: &[u8]) -> Option<f64> {
    match number {
        b"1" => Some(MM_PER_INCH),
        b"4" => Some(1.0),
        b"5" => Some(10.0),
        b"6" => Some(1000.0),
        _ => None,
    }
}

/// Length of a unit that a text names, mm.
fn unit_of(text: &[u8]) -> Option<f64> {
    match text.to_ascii_uppercase().as_slice() {
        b"METRIC" | b"MM" | b"MILLIMETERS" | b"MILLIMETRES" => Some(1.0),
        b"ENGLISH" | b"INCH" | b"INCHES" | b"IN" | b"IMPERIAL" => Some(MM_PER_INCH),
        _ => None,
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

    /// Says so when there is nothing to cut.
    pub(super) fn see_cuts(&self, out: &mut Diagnostics) {
        if self.count() == 0 && !out.has_errors() {
            let message = format!("the file holds no outline on layer 1{}", self.sizes);
            let hint = "pattern DXF (AAMA, ASTM D6673) has the outlines of its pieces on layer 1: export it so";
            out.push(Diagnostic::new(&code::DXF_NOTHING_TO_CUT, message).hint(hint));
        }
    }

    /// What is to be said of the set as a whole.
    fn say(&self, is_spent: bool, out: &mut Diagnostics) {
        let count = self.count();
        if is_spent || count > MOST_PIECES {
            let message = "the file has more pieces, notches or outlines than can be told apart";
            out.push(Diagnostic::new(&code::DXF_TOO_MANY, message).hint("look at the quantities, and split the file"));
        } else if self.placed.is_none() && count > 1 && !out.has_errors() {
            let message =
                format!("patterns are no marker: {count} pieces{} lie in a row, {} mm apart", self.sizes, self.gap);
            let finding = Diagnostic::new(&code::DXF_SAMPLE, message);
            out.push(finding.hint("it is a cutting sample: for a lay make a marker of it in the CAD system"));
        }
    }
}

/// What kinds of entities are not read, and on which layers.
fn say_unread(unread: &[Unread], out: &mut Diagnostics) {
    let mut kinds: BTreeMap<&str, (Vec<&Unread>, BTreeSet<&str>)> = BTreeMap::new();
    for entity in unread {
        let (of_kind, layers) = kinds.entry(&entity.kind).or_default();
        of_kind.push(entity);
        layers.insert(&entity.layer_name);
    }
    for (kind, (of_kind, layers)) in kinds {
        let word = if layers.len() == 1 { "layer" } else { "layers" };
        let layers = format!("{word} {}", layers.into_iter().collect::<Vec<_>>().join(", "));
        let (count, are) = (of_kind.len(), if of_kind.len() == 1 { "is" } else { "are" });
        let message = format!("{count} of the kind {kind} {are} not read, on {layers}");
        let finding = Diagnostic::new(&code::DXF_UNREAD, message).at(of_kind[0].span);
        out.push(finding.hint("nothing there is cut"));
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

/// How much is cut that nobody sees in the drawing.
fn say_hidden(hidden: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = hidden {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let message = format!("{message} hidden in the drawing, on layers that are cut; they are cut all the same");
        out.push(
            Diagnostic::new(&code::DXF_HIDDEN, message).at(span).hint("show all layers in the CAD system and look"),
        );
    }
}
