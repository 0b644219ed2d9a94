//! The set of patterns: the pieces of a file that are cut, on the cloth.

use std::collections::BTreeMap;

use super::chain::Chain;
use super::choice::{Asked, Chosen};
use super::curves::{CurveCounts, Drafting, Size, lend};
use super::doubts;
use super::fold;
use super::lay::{Drawn, Laid, Motion, in_a_row};
use super::layer::{Does, Named, Names};
use super::letters::letters;
use super::namesakes;
use super::over;
use super::piece::{Making, Piece};
use super::placing::{Held, MOST_COPIES, MOST_PIECES, Placing};
use super::retrace::say_retraced;
use super::shape::{Reader, Shapes, Unread};
use super::tally::{Tally, Thing};
use super::text::Facts;
use super::told::{plain, say_at_fault, say_curves, say_text, say_uncut, say_unread, say_unseen};
use super::unit::{Lengths, doubt, unit};
use super::unknown;
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};
use crate::front::dxf::entity::{Block, Entity, NAME, Sections, sections};
use crate::front::dxf::group::groups;
use crate::front::dxf::stray;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::machine::letters::Letters;
use crate::machine::patterns::{Dxf, Quantity};
use crate::source::{Source, Span};
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// The pieces of a file.
#[derive(Debug, Default)]
pub(super) struct Set {
    pieces: Vec<Piece>,
    /// Pieces of each block, in the order of the file.
    drawn: Vec<Drawn>,
    /// Places of the pieces if the file gives them: index of the piece, and its motion.
    placed: Option<Vec<(usize, Motion)>>,
    /// Number of pieces in no block; they come last.
    loose: usize,
    /// True if neither texts nor blocks tell that it is a set of patterns.
    is_plain: bool,
    /// Source of the quantities: the file, or one of each.
    quantity: Quantity,
    /// Gap between pieces in a row, mm.
    gap: f64,
    /// Its sizes, in words.
    sizes: String,
    /// Encoding of its texts.
    pub(super) letters: Option<Letters>,
    /// Names of its layers.
    pub(super) names: Names,
    /// Texts that belong to no piece.
    pub(super) texts: Vec<Label>,
    /// Lines of blocks without an outline, as drawn.
    pub(super) apart: Vec<(Named, Chain)>,
    /// Items that are not read.
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

/// The parts of a file under reading.
struct Parts<'a> {
    source: &'a Source,
    job: &'a Job,
    sections: &'a Sections<'a>,
    letters: Letters,
}

impl<'a> Parts<'a> {
    fn of(sections: &'a Sections<'a>, source: &'a Source, job: &'a Job, out: &mut Diagnostics) -> Self {
        stray::say(sections, out);
        let lettered = letters(sections, source, &job.profile.labels);
        lettered.say(out);
        Self { source, job, sections, letters: lettered.letters }
    }

    /// Reads their entities in a unit, mm.
    fn reader<'o>(&self, unit: f64, out: &'o mut Diagnostics) -> Reader<'a, 'o> {
        Reader {
            source: self.source,
            letters: self.letters,
            unit,
            sagitta: self.job.profile.tolerance(0.0) * Dxf::CHORDS_OFF,
            chords: 0,
            on_paper: None,
            names: Names::default(),
            hidden_layers: &self.sections.hidden,
            hidden: None,
            out,
        }
    }

    /// Lengths of the cuts in the unit of the file.
    fn lengths(&self) -> Lengths {
        let mut unsaid = Diagnostics::default();
        let mut reader = self.reader(1.0, &mut unsaid);
        let blocks = self.sections.blocks.iter().map(|block| &block.entities);
        let mut lengths = Lengths::default();
        for entities in blocks.chain([&self.sections.entities]) {
            let shapes = reader.shapes(entities);
            for line in shapes.lines.iter().filter(|line| matches!(line.layer.does, Does::Outline | Does::Inner)) {
                let again = if line.is_closed { line.vertices.first() } else { None };
                let points: Vec<Point> = line.vertices.iter().chain(again).map(|vertex| vertex.at).collect();
                let length = polyline::length(&points);
                lengths = Lengths { all: lengths.all + length, longest: lengths.longest.max(length) };
            }
        }
        lengths
    }

    fn facts<'e>(&self, entities: impl IntoIterator<Item = &'e Entity<'a>>) -> Facts
    where
        'a: 'e,
    {
        Facts::of(entities, self.source, &self.letters)
    }
}

/// The box around the outlines that a block draws.
fn extent_of(shapes: &Shapes) -> Extent {
    let outlines = shapes.lines.iter().filter(|line| line.layer.does == Does::Outline);
    Extent::of(&outlines.flat_map(|line| &line.vertices).map(|vertex| vertex.at).collect::<Vec<Point>>())
}

/// Reads a file. If the diagnostics hold an error, the result is unusable.
pub(super) fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Set {
    let groups = groups(source, out);
    let sections = sections(source, &groups, out);
    let Sections { blocks, entities, unit: of_header, .. } = &sections;
    let parts = Parts::of(&sections, source, job, out);
    let own: Vec<Facts> = blocks.iter().map(|block| parts.facts(&block.entities)).collect();
    let file = own.iter().fold(parts.facts(entities), |facts, of_block| facts.and(*of_block, source, &parts.letters));
    say_text(file.unread, out);
    let asked = Asked { source, job, letters: parts.letters, file };
    let unit = unit(&asked, *of_header, || parts.lengths(), out);
    let mut reader = parts.reader(unit, out);
    let mut loose = reader.shapes(entities);
    let (mut drawn, mut said): (Vec<Shapes>, Vec<Diagnostics>) = blocks.iter().map(|block| reader.block(block)).unzip();
    let placing = Placing::of(&asked, blocks, bases(&reader, blocks, &mut said), std::mem::take(&mut loose.inserts));
    let (on_paper, hidden, names) = (reader.on_paper, reader.hidden, std::mem::take(&mut reader.names));
    borrow(&mut drawn, &mut said, &sizes_of(&own, &asked));
    let held: Vec<Held> = drawn.iter().map(|shapes| Held::of(shapes, &names)).collect();
    let own: Vec<Facts> = own.into_iter().enumerate().map(|(k, own)| placing.facts(k, own)).collect();
    // Sizes in frames and legends belong to no piece.
    let is_cut = |k: usize| held[k].is_cut && placing.is_piece(k);
    let facts: Vec<Facts> = (0..own.len()).map(|k| if is_cut(k) { own[k] } else { Facts::default() }).collect();
    let boxes: Vec<Extent> = drawn.iter().map(extent_of).collect();
    let chosen = Chosen::of(&asked, &facts, placing.parts(&boxes), out);
    chosen.say(&facts, out);
    let mut making = Making::of(&asked, out);
    let mut set = Set {
        quantity: job.patterns.quantity.unwrap_or(job.profile.dxf.quantity),
        gap: job.profile.dxf.gap_mm,
        sizes: chosen.told(),
        names,
        letters: Some(parts.letters),
        ..Set::default()
    };
    for (k, (mut shapes, said)) in drawn.into_iter().zip(said).enumerate() {
        let (span, facts) = (blocks[k].head.span(), &facts[k]);
        if held[k].is_cut && !placing.is_piece(k) {
            making.tally.add(Thing::Unnamed, span);
        }
        if !chosen.has(facts) || !placing.is_piece(k) {
            set.add(Vec::new(), None);
            continue;
        }
        set.unread.append(&mut shapes.unread);
        set.unread.extend(placing.nested(&shapes.inserts, &held, &mut making.tally));
        let quantity = asked.quantity(facts.quantity, &mut making.tally);
        set.add(making.pieces_of_block(shapes, span, said), quantity);
    }
    set.is_plain = !file.says_anything() && set.pieces.is_empty();
    set.lay(&placing, loose, &mut making);
    let wanted = (0..blocks.len()).filter(|&k| is_cut(k) && chosen.has(&facts[k])).map(|k| (&blocks[k], &facts[k]));
    set.say_texts(&wanted.collect::<Vec<_>>(), &asked, &mut making);
    making.report();
    let uncut = if set.count() > 0 { uncut(blocks, &own, &held, &placing, &chosen) } else { Vec::new() };
    say_uncut(&uncut, &asked, making.out);
    let Making { work, apart, .. } = making;
    set.apart = apart;
    say_unread(&set.unread, out);
    say_unseen([on_paper, hidden], blocks, &asked, out);
    set.say(work.is_spent(), &asked, out);
    set
}

/// Names of the blocks without cuts whose texts give a name or a quantity of a piece, and that contain its lines.
fn uncut(blocks: &[Block], own: &[Facts], held: &[Held], placing: &Placing, chosen: &Chosen) -> Vec<Span> {
    let is_uncut = |k: &usize| !held[*k].is_cut && held[*k].has_lines && placing.is_piece(*k) && chosen.has(&own[*k]);
    let name = |k: usize| {
        let Facts { name, quantity, .. } = own[k];
        name.first.or(quantity.first.and_then(|_| blocks[k].head.value(NAME)))
    };
    (0..blocks.len()).filter(is_uncut).filter_map(name).collect()
}

/// Base points of blocks; a fault in one is reported for its block.
fn bases(reader: &Reader, blocks: &[Block], said: &mut [Diagnostics]) -> Vec<Point> {
    let base = |(block, said): (&Block, &mut Diagnostics)| {
        reader.base(&block.head).unwrap_or_else(|fault| {
            said.push(fault);
            Point::origin()
        })
    };
    blocks.iter().zip(said).map(base).collect()
}

/// Lends turn and curve points to blocks without any. Damaged points are damaged for the borrower, too.
fn borrow(drawn: &mut [Shapes], said: &mut [Diagnostics], sizes: &[Size]) {
    let lenders = lend(drawn, sizes);
    let error = |said: &Diagnostics| said.iter().find(|finding| finding.code.severity == Severity::Error).cloned();
    let errors: Vec<Option<Diagnostic>> = said.iter().map(error).collect();
    for (said, lender) in said.iter_mut().zip(lenders) {
        lender.and_then(|lender| errors[lender].clone()).into_iter().for_each(|error| said.push(error));
    }
}

/// Piece of each block, and whether it is of the sample size.
fn sizes_of<'a>(own: &[Facts], Asked { source, file, .. }: &Asked<'a>) -> Vec<Size<'a>> {
    let name = |span: Option<Span>| span.map(|span| source.slice(span).to_ascii_uppercase());
    let sample = name(file.sample_size.first);
    let size = |facts: &Facts| Size {
        piece: facts.name.first.map(|span| source.slice(span)),
        is_sample: sample.is_some() && name(facts.size.first) == sample,
    };
    own.iter().map(size).collect()
}

impl<'o> Making<'o> {
    /// Start for a file.
    fn of(asked: &Asked, out: &'o mut Diagnostics) -> Self {
        let dxf = &asked.job.profile.dxf;
        let sagitta = asked.job.profile.tolerance(0.0) * Dxf::CHORDS_OFF;
        Self {
            notch_depth: dxf.notch_mm,
            drafting: Drafting::of(&asked.author(), dxf.curves, sagitta),
            curved: CurveCounts::default(),
            work: Budget::of_a_marker(),
            tally: Tally::default(),
            retraced: Vec::new(),
            apart: Vec::new(),
            out,
        }
    }
}

impl Making<'_> {
    /// Reports the curves of the pieces, omissions in their outlines, and requests of the file that are not met.
    fn report(&mut self) {
        say_curves(&self.curved, &self.drafting, self.out);
        say_retraced(&self.retraced, self.out);
        self.tally.report(self.out);
    }

    /// The pieces of a block, with the findings of its reading. An error makes it a piece that cannot be cut.
    fn pieces_of_block(&mut self, shapes: Shapes, span: Span, read: Diagnostics) -> Vec<Piece> {
        let labels = shapes.texts.clone();
        if read.has_errors() {
            return vec![Piece::at_fault(span, labels, &read)];
        }
        self.out.extend(read);
        let (pieces, made) = self.pieces_apart(shapes, span);
        if made.has_errors() {
            return vec![Piece::at_fault(span, labels, &made)];
        }
        self.out.extend(made);
        pieces
    }
}

impl Set {
    /// Adds the pieces that a block draws.
    fn add(&mut self, pieces: Vec<Piece>, quantity: Option<[u32; 2]>) {
        let first = self.pieces.len();
        self.pieces.extend(pieces);
        self.drawn.push(Drawn { pieces: first..self.pieces.len(), quantity });
    }

    /// Puts the pieces at the places of insertions, and loose items where they are drawn.
    fn lay(&mut self, placing: &Placing, mut loose: Shapes, making: &mut Making) {
        self.placed = placing.placed(&self.drawn, making);
        self.texts.clone_from(&loose.texts);
        self.unread.append(&mut loose.unread);
        if !loose.lines.is_empty() || !loose.dots.is_empty() {
            // By convention turn and curve points are points.
            let is_other = loose.lines.iter().any(|line| matches!(line.layer.does, Does::Turn | Does::Curve));
            let (pieces, said) = making.pieces_apart(loose, Span::default());
            if self.is_plain && (is_other || said.has_errors()) {
                making.out.push(plain(&self.names));
            }
            if !(self.is_plain && is_other) {
                making.out.extend(said);
            }
            self.loose = pieces.len();
            self.add(pieces, None);
            // Beside blocks that the file places, they lie where they are drawn.
            let pieces = self.drawn.last().map_or(0..0, |drawn| drawn.pieces.clone());
            self.placed.iter_mut().for_each(|placed| placed.extend(pieces.clone().map(|piece| (piece, Motion::STILL))));
        }
        if self.placed.is_none() {
            self.count_inserts(placing);
            return;
        }
        if self.count() <= MOST_PIECES && !making.out.has_errors() {
            let on_others = over::on_others(&self.laid(), &mut making.work);
            if 2 * on_others.count > self.count() {
                let count = self.count();
                let message =
                    format!("INSERTs put {} of {count} pieces on each other: they are no places", on_others.count);
                let finding = Diagnostic::new(&code::DXF_NO_PLACES, message);
                making.out.push(finding.hint(
                    "they lie in a row, as often as texts or INSERTs say; for a lay make a marker in the CAD system",
                ));
                self.placed = None;
                self.count_inserts(placing);
                return;
            }
            on_others.spans.into_iter().for_each(|span| making.tally.add(Thing::OnAnother, span));
        }
        placing.count(&self.drawn, &mut making.tally);
    }

    /// Sets the count of pieces in a row to that of their insertions, if their blocks give no quantity.
    fn count_inserts(&mut self, placing: &Placing) {
        if self.quantity == Quantity::File {
            placing.as_often(&mut self.drawn);
        }
    }

    /// Reports cut blocks that may be half a piece and, if no INSERT places them, possible sizes and quantities under unknown
    /// keys.
    fn say_texts(&self, pieces: &[(&Block, &Facts)], asked: &Asked, making: &mut Making) {
        fold::see_missing_lines(pieces, &asked.letters, &mut making.tally);
        if self.placed.is_some() {
            return;
        }
        if self.quantity == Quantity::File {
            unknown::say(pieces, asked, making.out);
        }
        if asked.file.sample_size.first.is_none() {
            namesakes::say(pieces, asked.source, &asked.letters, making.out);
        }
    }

    /// Number of pieces on the cloth.
    fn count(&self) -> usize {
        match &self.placed {
            Some(placed) => placed.len(),
            None => self.drawn.iter().map(|drawn| drawn.pieces.len() * drawn.times()).sum(),
        }
    }

    /// Reports that there is nothing to cut, if so.
    pub(super) fn see_cuts(&self, out: &mut Diagnostics) {
        if self.count() > 0 || out.has_errors() {
            return;
        }
        if self.is_plain && !self.names.all().is_empty() {
            out.push(plain(&self.names));
            return;
        }
        let message = format!("the file holds no outline on layer 1{}", self.sizes);
        let hint = "pattern DXF (AAMA, ASTM D6673) has the outlines of its pieces on layer 1: export it so";
        out.push(Diagnostic::new(&code::DXF_NOTHING_TO_CUT, message).hint(hint));
    }

    /// Reports findings about the set as a whole.
    fn say(&self, is_spent: bool, asked: &Asked, out: &mut Diagnostics) {
        let count = self.count();
        if is_spent || count > MOST_PIECES || self.drawn.iter().any(|drawn| drawn.times() > MOST_COPIES) {
            let message = "the file has more pieces, notches or outlines than can be told apart";
            out.push(Diagnostic::new(&code::DXF_TOO_MANY, message).hint("look at the quantities, and split the file"));
            return;
        }
        self.say_faults(asked, out);
        self.say_doubts(asked, out);
        if out.has_errors() {
            return;
        }
        if self.placed.is_none() && count > 1 && count > self.loose {
            let message =
                format!("patterns are no marker: {count} pieces{} lie in a row, {} mm apart", self.sizes, self.gap);
            let hint = "it is a cutting sample: for a lay make a marker of it in the CAD system";
            let code = if asked.job.marks.is_some() { &code::MARKS_SHEET } else { &code::DXF_SAMPLE };
            out.push(Diagnostic::new(code, message).hint(hint));
        }
        if self.loose > 1 || self.loose == 1 && self.placed.is_some() {
            let (outlines, they) = if self.loose == 1 {
                ("outline stands", "it lies as it is")
            } else {
                ("outlines stand", "they lie as they are")
            };
            let message = format!("{} {outlines} in no block; {they} drawn", self.loose);
            let finding = Diagnostic::new(&code::DXF_AS_DRAWN, message);
            out.push(finding.hint("see in the picture (-t svg) how they lie on the cloth"));
        }
        let sizes = self.pieces.iter().filter(|piece| !piece.is_at_fault());
        self.say_far_off(out);
        doubt(sizes.map(|piece| Extent::of(&piece.plain.points()).size()), self.pieces.len() == 1, asked, out);
    }

    /// Reports a piece that lies far from the others.
    fn say_far_off(&self, out: &mut Diagnostics) {
        let Some((span, off)) = over::far_off(&self.laid()) else { return };
        let message = format!("a piece lies {} m from the others", fixed(off / MM_PER_M, 0));
        let finding = Diagnostic::new(&code::DXF_FAR_PIECE, message).at(span);
        out.push(finding.hint("a digit of its INSERT may be doubled; put it beside the others in the CAD system"));
    }

    /// Reports notches that are left out or cut in another way, with the numbers of their pieces.
    fn say_doubts(&self, asked: &Asked, out: &mut Diagnostics) {
        let mut pieces: BTreeMap<u32, (&Piece, Vec<u32>)> = BTreeMap::new();
        for (laid, number) in self.laid().into_iter().zip(1..) {
            if !laid.piece.doubts.is_empty() && asked.job.selection.has(number) {
                pieces.entry(laid.piece.span.start).or_insert((laid.piece, Vec::new())).1.push(number);
            }
        }
        let each = pieces.values();
        doubts::say(each.flat_map(|(piece, of)| piece.doubts.iter().map(move |doubt| (doubt, &of[..]))), out);
    }

    /// Reports pieces that cannot be cut, with their numbers, unless they are left out.
    fn say_faults(&self, asked: &Asked, out: &mut Diagnostics) {
        let mut numbers: BTreeMap<u32, (&Piece, Vec<u32>)> = BTreeMap::new();
        for (laid, number) in self.laid().into_iter().zip(1..) {
            if laid.piece.is_at_fault() && asked.job.selection.has(number) {
                numbers.entry(laid.piece.span.start).or_insert((laid.piece, Vec::new())).1.push(number);
            }
        }
        let hint = if self.pieces.iter().all(Piece::is_at_fault) {
            None
        } else {
            let all: Vec<String> = numbers.values().flat_map(|(_, numbers)| numbers).map(u32::to_string).collect();
            Some(format!("`cutc compile` cuts all other pieces without it: `--skip {}`", all.join(",")))
        };
        for (piece, numbers) in numbers.values() {
            say_at_fault(piece, numbers[0], hint.as_deref(), asked, out);
        }
    }
}
