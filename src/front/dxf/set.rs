//! The set of patterns: a file becomes the pieces that are cut of it, on the cloth.

use super::chain::Chain;
use super::choice::{Asked, Chosen};
use super::curves::{Drafting, Size, lend};
use super::entity::{Sections, sections};
use super::group::groups;
use super::lay::{Drawn, Laid, Motion, in_a_row};
use super::layer::{Named, Names};
use super::over;
use super::piece::{CurvedPieces, Making, Piece};
use super::placing::{Held, MOST_PIECES, Placing};
use super::shape::{Reader, Shapes, Unread};
use super::tally::{Tally, Thing};
use super::text::Facts;
use super::told::{say_curves, say_hidden, say_on_paper, say_text, say_unread};
use super::unit::unit;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::geom::budget::Budget;
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::machine::patterns::Dxf;
use crate::source::{Source, Span};

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
    /// What its layers are called.
    pub(super) names: Names,
    /// Texts that are of no piece.
    pub(super) texts: Vec<Label>,
    /// Lines of blocks that have no outline, as they are drawn.
    pub(super) apart: Vec<(Named, Chain)>,
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
    say_text(file.unread, out);
    let asked = Asked { source, job, file };
    let unit = unit(&asked, of_header, out);
    let mut reader = Reader {
        source,
        unit,
        sagitta: job.profile.tolerance(0.0) * Dxf::CHORDS_OFF,
        chords: 0,
        on_paper: None,
        names: Names::default(),
        hidden_layers: &hidden,
        hidden: None,
        out,
    };
    let mut loose = reader.shapes(&entities);
    let bases: Vec<Point> = blocks.iter().map(|block| reader.base(&block.head)).collect();
    let placing = Placing::of(source, &blocks, bases, std::mem::take(&mut loose.inserts));
    let mut drawn: Vec<Shapes> = (0..blocks.len()).map(|k| reader.block(&blocks[k], placing.is_piece(k))).collect();
    let (on_paper, hidden, names) = (reader.on_paper, reader.hidden, std::mem::take(&mut reader.names));
    let size = |facts: &Facts| facts.size.first.map(|span| source.slice(span).to_ascii_uppercase());
    let sample = file.sample_size.first.map(|span| source.slice(span).to_ascii_uppercase());
    let sizes: Vec<Size> = own
        .iter()
        .map(|facts| Size {
            piece: facts.name.first.map(|span| source.slice(span)),
            is_sample: size(facts).is_some() && size(facts) == sample,
        })
        .collect();
    lend(&mut drawn, &sizes);
    let held: Vec<Held> = drawn.iter().map(|shapes| Held::of(shapes, &names)).collect();
    let own = own.into_iter().enumerate().map(|(k, own)| placing.facts(k, own));
    // What frames and legends say of sizes is of no piece.
    let is_cut = |k: usize| held[k].is_cut && placing.is_piece(k);
    let facts: Vec<Facts> = own.enumerate().map(|(k, own)| if is_cut(k) { own } else { Facts::default() }).collect();
    let chosen = Chosen::of(&asked, &facts, out);
    let author = [file.author.first, file.author.other].into_iter().flatten();
    let author: Vec<String> = author.map(|span| String::from_utf8_lossy(source.slice(span)).into_owned()).collect();
    let sagitta = job.profile.tolerance(0.0) * Dxf::CHORDS_OFF;
    let mut making = Making {
        notch_depth: job.profile.dxf.notch_mm,
        drafting: Drafting::of(&author.join(" "), job.profile.dxf.curves, sagitta),
        curved: CurvedPieces::default(),
        work: Budget::of_a_marker(),
        tally: Tally::default(),
        apart: Vec::new(),
        out,
    };
    let mut set = Set { gap: job.profile.dxf.gap_mm, sizes: chosen.told(), names, ..Set::default() };
    for ((k, mut shapes), (block, facts)) in drawn.into_iter().enumerate().zip(blocks.iter().zip(&facts)) {
        if held[k].is_cut && !placing.is_piece(k) {
            making.tally.add(Thing::Unnamed, block.head.span());
        }
        if !chosen.has(facts) || !placing.is_piece(k) {
            set.add(Vec::new(), None);
            continue;
        }
        set.unread.append(&mut shapes.unread);
        set.unread.extend(placing.nested(&shapes.inserts, &held, &mut making.tally));
        let quantity = asked.quantity(facts.quantity, &mut making.tally);
        set.add(making.pieces(shapes, block.head.span()), quantity);
    }
    set.lay(&placing, loose, &mut making);
    let Making { work, tally, apart, curved, drafting, .. } = making;
    set.apart = apart;
    say_curves(&curved, &drafting, out);
    tally.report(out);
    say_unread(&set.unread, out);
    say_on_paper(on_paper, out);
    say_hidden(hidden, out);
    set.say(work.is_spent(), out);
    set
}

impl Set {
    /// Adds the pieces that a block draws.
    fn add(&mut self, pieces: Vec<Piece>, quantity: Option<[u32; 2]>) {
        let first = self.pieces.len();
        self.pieces.extend(pieces);
        self.drawn.push(Drawn { pieces: first..self.pieces.len(), quantity });
    }

    /// Puts the pieces where insertions have them, those of what stands in no block where they are drawn.
    fn lay(&mut self, placing: &Placing, mut loose: Shapes, making: &mut Making) {
        self.placed = placing.placed(&self.drawn, &mut making.tally);
        self.texts.clone_from(&loose.texts);
        self.unread.append(&mut loose.unread);
        if !loose.lines.is_empty() || !loose.dots.is_empty() {
            self.add(making.pieces(loose, Span::default()), None);
            // Beside blocks that the file places they lie where they are drawn.
            let pieces = self.drawn.last().map_or(0..0, |drawn| drawn.pieces.clone());
            self.placed.iter_mut().for_each(|placed| placed.extend(pieces.clone().map(|piece| (piece, Motion::STILL))));
        }
        if self.placed.is_some() && self.count() <= MOST_PIECES && !making.out.has_errors() {
            let on_others = over::on_others(&self.laid(), &mut making.work);
            for span in on_others {
                making.tally.add(Thing::OnAnother, span);
            }
        }
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
