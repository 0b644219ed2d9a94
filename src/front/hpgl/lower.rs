//! The meaning of a plot: follows statement after statement and gathers strokes and texts. [`figures`] draws curves, rectangles
//! and wedges.

mod figures;

use super::encoded::{Body, Ending, Item};
use super::ending::{self, Last};
use super::instruction::{Instruction, serves_place};
use super::lost;
use super::page::{End, Pages};
use super::parameters::Amid;
use super::plotter::{MOST_PENS, NO_PEN, Plotter, Refusal, Sheet};
use super::reader::{Next, Reader, Statement};
use super::scale::{Frame, Pair, Unknown};
use super::tally::Tally;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Heading, Vector};
use crate::ir::Drawing;
use crate::ir::marker::Label;
use crate::source::{Source, Span};
use crate::units::number::fixed;

/// Measures of a plot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Greatest distance of the chords of a curve from it, mm.
    pub(super) sagitta: f64,
}

/// Follows a plot to its end.
pub(super) fn lower(source: &Source, measure: Measure, out: &mut Diagnostics) -> Drawing {
    let mut lowering = Lowering {
        reader: Reader::new(source.bytes()),
        plotter: Plotter::new(Sheet { unit: measure.unit, bytes: source.bytes().len() }),
        sagitta: measure.sagitta / measure.unit,
        labels: Vec::new(),
        heading: None,
        buffer: None,
        pages: Pages::default(),
        unsized_at: None,
        scaled: None,
        doubts: Vec::new(),
        last_drew: false,
        last: None,
        tally: Tally::default(),
        out,
    };
    lowering.run();
    lowering.end();
    lowering.tally.report(lowering.plotter.drawing.strokes.len(), lowering.out);
    let mut drawing = lowering.plotter.drawing;
    drawing.texts = lowering.labels;
    drawing.passed = lowering.tally.air.outlines;
    drawing
}

struct Lowering<'a> {
    reader: Reader<'a>,
    plotter: Plotter,
    /// Sagitta of curves, units of the plotter.
    sagitta: f64,
    labels: Vec<Label>,
    /// Direction of labels, if it is not +X.
    heading: Option<Heading>,
    /// Text of BL for PB.
    buffer: Option<Span>,
    pages: Pages,
    /// Place that left the scale to the device, as long as nothing was drawn in it: the corners may follow.
    unsized_at: Option<Span>,
    /// Number of vertices at the last change of the scale, and its place.
    scaled: Option<(usize, Span)>,
    /// Doubts about scales that were reported, each once.
    doubts: Vec<Unknown>,
    /// True if the last statement has drawn something.
    last_drew: bool,
    /// The last statement, if it is an instruction, and its place.
    last: Option<(Instruction, Span)>,
    tally: Tally,
    out: &'a mut Diagnostics,
}

/// Fraction bits of PE, of either sign; more are damage. (Hewlett-Packard, "HP-GL/2 and HP RTL Reference Guide", PE.)
const FRACTION_BITS: std::ops::RangeInclusive<i64> = -26..=26;

/// Decimals of the factors of a scale in messages.
const DECIMALS_OF_FACTORS: u32 = 3;

impl Lowering<'_> {
    fn run(&mut self) {
        while let Some((statement, span)) = self.reader.next() {
            let drawn = self.plotter.drawing.vertices.len();
            self.last = None;
            if let Statement::Instruction(instruction, mnemonic) = statement {
                self.last = Some((instruction, span));
                if !instruction.is_move() {
                    let amid = Amid {
                        stroke: self.plotter.is_amid_stroke(),
                        page: self.plotter.is_drawing() || self.pages.goes_on(self.plotter.drawing.strokes.len()),
                    };
                    self.tally.surplus.see(mnemonic, span, amid, &self.reader);
                    if serves_place(mnemonic) {
                        self.tally.air.settle_at(self.plotter.at(), self.plotter.vertex(span));
                    } else if instruction == Instruction::Pen {
                        self.tally.air.pause();
                    }
                } else if instruction == Instruction::Down {
                    self.tally.air.settle();
                }
            }
            match statement {
                Statement::Instruction(Instruction::Unknown, mnemonic) => {
                    self.tally.unknown(mnemonic, span);
                    lost::over_unknown(mnemonic, &self.reader, &mut self.plotter, span);
                }
                Statement::Instruction(Instruction::LeftOut(what), mnemonic) => {
                    self.tally.left_out(mnemonic, what, span);
                }
                Statement::Instruction(Instruction::Letters(what), mnemonic) => {
                    self.tally.left_out(mnemonic, what, span);
                    self.plotter.drift();
                }
                Statement::Instruction(instruction @ Instruction::Symbol, mnemonic) => {
                    self.tally.left_out(mnemonic, "a symbol at each point", span);
                    self.reader.pass_over(instruction.tail());
                }
                Statement::Instruction(instruction, _) => {
                    self.tally.sound();
                    self.obey(instruction, span);
                }
                Statement::Reset => self.reset(span),
                Statement::Junk => {
                    self.tally.junk(span);
                    lost::over_junk(&self.reader, &mut self.plotter, span);
                }
            }
            self.last_drew = self.plotter.drawing.vertices.len() > drawn;
            if self.tally.is_hopeless() {
                return;
            }
        }
        self.pages.report(&self.plotter.drawing, self.out);
    }

    /// End of the file: a line that the pen is still drawing there may be cut short.
    fn end(&mut self) {
        self.see_scale();
        if let Some(last) = self.plotter.unfinished() {
            let message = "a polygon (PM) has no end, and is not drawn";
            let finding = Diagnostic::new(&code::HPGL_ENDS_IN_POLYGON, message).at(last);
            self.out.push(finding.hint("the file is most likely cut short; export it again"));
        }
        let last = Last { instruction: self.last, drew: self.last_drew, odd: self.tally.last_odd };
        self.plotter.drawing.ending = ending::of_line(&last, &self.reader, &self.plotter);
        if let Some(finding) = ending::of_plot(&last, &self.reader, &self.plotter) {
            self.out.push(finding);
        }
        self.tally.dots = self.plotter.dots;
        self.plotter.lift();
        self.tally.adrift(self.plotter.adrift);
        self.tally.lost(self.plotter.lost);
        let Drawing { strokes, pens, .. } = &self.plotter.drawing;
        let pens = || strokes.iter().filter(|stroke| !pens[usize::from(stroke.pen)].draws);
        if let Some(first) = pens().next() {
            let lines = if pens().count() == 1 { "a line is" } else { &format!("{} lines are", pens().count()) };
            let message = format!("{lines} drawn while no pen is taken (SP0), the first one here: not cut");
            let span = self.plotter.drawing.vertices[first.first as usize + 1].span;
            let finding = Diagnostic::new(&code::HPGL_NO_PEN, message).at(span);
            self.out.push(finding.hint("plotters draw nothing there; if they are outlines, let the CAD take pen 1"));
        }
    }

    fn reset(&mut self, span: Span) {
        self.see_scale();
        self.pages.end(End::Afresh, self.plotter.drawing.strokes.len(), span);
        self.plotter.reset();
        self.tally.air.restart();
        (self.heading, self.unsized_at, self.buffer) = (None, None, None);
    }

    fn obey(&mut self, instruction: Instruction, span: Span) {
        match instruction {
            Instruction::Down => {
                self.plotter.lower(span);
                if self.moves() == 0 {
                    self.tally.air.settle_at(self.plotter.at(), self.plotter.vertex(span));
                }
            }
            Instruction::Up => {
                self.plotter.lift();
                self.pass(span);
            }
            Instruction::Absolute | Instruction::Relative => {
                self.plotter.set_relative(instruction == Instruction::Relative);
                self.moves_as_it_is(instruction, span);
            }
            Instruction::Pen => self.pen(),
            Instruction::Encoded => self.encoded(),
            Instruction::ArcAbsolute | Instruction::ArcRelative => {
                self.arc(instruction == Instruction::ArcRelative, span);
            }
            Instruction::ArcThroughAbsolute | Instruction::ArcThroughRelative => {
                self.arc_through(instruction == Instruction::ArcThroughRelative, span);
            }
            Instruction::Circle => self.circle(span),
            Instruction::BezierAbsolute | Instruction::BezierRelative => {
                self.beziers(instruction == Instruction::BezierRelative);
            }
            Instruction::RectangleAbsolute | Instruction::RectangleRelative => {
                self.rectangle(instruction == Instruction::RectangleRelative, span);
            }
            Instruction::Wedge => self.wedge(span),
            Instruction::Polygon => self.polygon(span),
            Instruction::EdgePolygon => self.edge_polygon(span),
            Instruction::Page(end) => self.page(end, span),
            Instruction::Label
            | Instruction::Terminator
            | Instruction::Buffer
            | Instruction::PrintBuffer
            | Instruction::Display
            | Instruction::Comment
            | Instruction::Direction => self.say(instruction, span),
            Instruction::Initialize => self.reset(span),
            Instruction::Begin => {
                self.reader.pass_over(instruction.tail());
                self.reset(span);
            }
            Instruction::Default => self.set_default(),
            Instruction::Scale
            | Instruction::Corners
            | Instruction::CornersPercent
            | Instruction::Rotate
            | Instruction::PageSize => self.reframe(instruction, span),
            Instruction::Housekeeping
            | Instruction::Symbol
            | Instruction::LeftOut(_)
            | Instruction::Letters(_)
            | Instruction::Unknown => {}
        }
    }

    /// Instructions for texts, their terminators and their direction.
    fn say(&mut self, instruction: Instruction, span: Span) {
        match instruction {
            Instruction::Label => self.label(span),
            Instruction::Terminator => self.reader.define_terminator(),
            Instruction::Buffer => self.buffer = Some(self.text(span)),
            Instruction::PrintBuffer => match self.buffer {
                Some(text) if text.start < text.end => self.write(text),
                Some(_) => {}
                None => self.plotter.tear(span),
            },
            Instruction::Display => {
                let has_numbers = self.reader.number_follows();
                if self.reader.display() {
                    if has_numbers {
                        self.plotter.lose(span);
                    }
                    self.tally.open_label(span);
                }
            }
            Instruction::Comment => self.reader.quoted(),
            _ => self.direction(),
        }
    }

    /// The places after PA and PR, which do not tell whether the pen is down.
    fn moves_as_it_is(&mut self, instruction: Instruction, span: Span) {
        let first = self.reader.at();
        if self.plotter.is_drawing() || self.plotter.is_gathering() {
            self.moves();
        } else {
            self.pass(span);
        }
        if self.reader.at() > first {
            self.plotter.trust_pen();
            self.tally.modes[usize::from(instruction == Instruction::Relative)].add(span);
        }
    }

    /// SP; without a number it puts the pen away.
    fn pen(&mut self) {
        let pen = self.values::<1>().first().copied().unwrap_or(0.0);
        self.take_pen(pen);
    }

    /// PM: a polygon begins, continues with another part, or ends.
    fn polygon(&mut self, span: Span) {
        match self.values::<1>().first() {
            None | Some(0.0) => self.plotter.begin_polygon(span),
            Some(1.0) => self.plotter.close_part(span),
            Some(_) => self.plotter.end_polygon(span),
        }
    }

    /// EP.
    fn edge_polygon(&mut self, span: Span) {
        let drawn = self.plotter.edge_polygon();
        self.check(drawn, span);
    }

    /// DF.
    fn set_default(&mut self) {
        self.plotter.set_default();
        (self.heading, self.unsized_at) = (None, None);
    }

    /// PG, FR: the drawing before it is complete. EC may be a setting; `EC0` switches the cutter off.
    fn page(&mut self, end: End, span: Span) {
        let is_off = end == End::CutOff && self.values::<1>().first() == Some(&0.0);
        if end != End::CutOff {
            self.plotter.drawing.lift();
        }
        if !is_off {
            self.pages.end(end, self.plotter.drawing.strokes.len(), span);
        }
    }

    /// DI: the direction of texts.
    fn direction(&mut self) {
        let values = self.values::<2>();
        let way = values.get(1).map(|&rise| Vector::new(values[0], rise));
        self.heading = way.filter(|way| way.norm() > 0.0).map(Heading::of).filter(|h| h.radians() != 0.0);
    }

    /// Some numbers of the instruction; one beyond any table ends them.
    fn values<const MOST: usize>(&mut self) -> arrayvec::ArrayVec<f64, MOST> {
        match self.reader.values() {
            Ok(values) => values,
            Err(span) => {
                self.tally.overflow(span);
                arrayvec::ArrayVec::new()
            }
        }
    }

    /// The next pair of the instruction; incomplete pairs are counted.
    fn pair(&mut self) -> Option<(Pair, Span)> {
        loop {
            match self.reader.pair() {
                Next::Some(pair) => return Some(pair),
                Next::Unusual((pair, span)) => {
                    if self.plotter.is_drawing() {
                        self.tally.unusual(self.reader.slice(span), span);
                    }
                    return Some((pair, span));
                }
                Next::End => {
                    if let Some(span) = self.reader.end_of_list() {
                        self.tally.ends.add(span);
                    }
                    return None;
                }
                Next::Gap(span) => self.tally.gap(span),
                Next::Odd(span) => self.odd(span),
                Next::Overflow(span) => self.tally.overflow(span),
            }
        }
    }

    /// A number without a partner.
    fn odd(&mut self, span: Span) {
        self.tally.odd(span);
        self.plotter.lose(span);
    }

    /// Check after every move.
    fn check(&mut self, outcome: Result<(), Refusal>, span: Span) {
        if let Err(refusal) = outcome {
            self.tally.refused(refusal, span);
        }
        if let Some(span) = self.unsized_at
            && self.plotter.frame.is_left_to_device()
        {
            self.unsized_at = None;
            self.doubt(Unknown::Corners, span);
        }
    }

    /// The places after an instruction while the pen is up.
    fn pass(&mut self, span: Span) {
        let places = self.moves();
        if !self.plotter.is_gathering() {
            self.tally.air.pass(places, self.plotter.at(), span);
        }
    }

    /// The places after PU, PD, PA and PR; returns their number.
    fn moves(&mut self) -> usize {
        let mut places = 0;
        if let Some(span) = self.reader.comma() {
            self.tally.comma(span);
        }
        self.tally.list_from = self.reader.at() as u32;
        loop {
            while let Some((pair, span)) = self.reader.plain_pair().or_else(|| self.pair()) {
                let to = self.plotter.target(pair);
                let outcome = self.plotter.lead(to, span);
                self.check(outcome, span);
                self.plotter.settle_by_mode();
                if !self.plotter.is_drawing() {
                    self.tally.air.go(self.plotter.vertex(span));
                }
                places += 1;
            }
            if !self.reader.pass_query() {
                break;
            }
        }
        if self.plotter.is_drawing() {
            self.tally.places += places;
        }
        self.tally.lists += usize::from(places > 0);
        places
    }

    fn take_pen(&mut self, pen: f64) {
        self.plotter.take_pen(if (0.0..=MOST_PENS).contains(&pen) { pen as u16 } else { NO_PEN });
    }

    /// Instructions that change the meaning of numbers.
    fn reframe(&mut self, instruction: Instruction, span: Span) {
        match instruction {
            Instruction::Scale => self.frame(Frame::set_scale, span),
            Instruction::Corners => self.frame(Frame::set_corners, span),
            Instruction::CornersPercent => self.frame(Frame::set_corners_percent, span),
            Instruction::Rotate => self.frame(Frame::rotate, span),
            _ => {
                let values = self.values::<2>();
                self.plotter.reframe(|frame| frame.set_page(&values));
            }
        }
    }

    /// SC, IP, IR, RO.
    fn frame(&mut self, set: fn(&mut Frame, &[f64]) -> Result<(), Unknown>, span: Span) {
        self.see_scale();
        let values = self.values::<7>();
        self.scaled = Some((self.plotter.drawing.vertices.len(), span));
        if let Err(doubt) = self.plotter.reframe(|frame| set(frame, &values)) {
            self.doubt(doubt, span);
        }
        let first = self.unsized_at.unwrap_or(span);
        self.unsized_at = self.plotter.frame.is_left_to_device().then_some(first);
    }

    /// Warns once of a scale in force that stretches what is drawn in it.
    fn see_scale(&mut self) {
        let Some((drawn, span)) = self.scaled.filter(|_| !self.doubts.contains(&Unknown::Uneven)) else { return };
        if let Some([x, y]) = self.plotter.frame.uneven()
            && self.plotter.drawing.vertices.len() > drawn
        {
            self.doubts.push(Unknown::Uneven);
            let [by_x, by_y] = [x, y].map(|factor| fixed(factor, DECIMALS_OF_FACTORS));
            let percent = fixed((x.max(y) / x.min(y) - 1.0) * 100.0, 1);
            let message = format!("a number is {by_x} units in X and {by_y} in Y (IP, SC): stretched by {percent} %");
            let finding = Diagnostic::new(&code::HPGL_UNEVEN_SCALE, message).at(span);
            self.out.push(
                finding.hint("a digit of IP or SC may be wrong: compare a length in X and one in Y with the marker"),
            );
        }
    }

    /// Warns of a scale, once for each kind of doubt.
    fn doubt(&mut self, doubt: Unknown, span: Span) {
        if self.doubts.contains(&doubt) {
            return;
        }
        self.doubts.push(doubt);
        let message = match doubt {
            Unknown::Corners => "SC scales the drawing to corners that the file does not give (IP)",
            Unknown::Page => "IR gives corners in percent of a page whose size the file does not give (PS)",
            Unknown::Range => "SC scales from or to a range without width and is ignored",
            Unknown::Incomplete => "numbers are missing here: SC needs four of them, IP and IR two or four",
            Unknown::Angle => "RO turns by quarters only; another angle is ignored",
            Unknown::Uneven => return, // reported with its factors
        };
        let finding = Diagnostic::new(&code::HPGL_SCALE, message).at(span);
        self.out.push(
            finding.hint("check the extent: the size of the drawing depends on the plotter that it was made for"),
        );
    }

    /// PE.
    fn encoded(&mut self) {
        let mut body = self.reader.body();
        let (mut is_absolute, mut is_up) = (false, false);
        // Meaning of the next number, and the first of two coordinates with its place.
        let mut flag = None;
        let mut first: Option<(f64, usize)> = None;
        loop {
            let start = body.at;
            let Some(item) = body.next() else { break };
            let number = match item {
                Item::Number(number) => number,
                // Flags stand before places, not inside them.
                Item::Pen | Item::Fraction | Item::Up | Item::Absolute if first.is_some() => {
                    body.ending = Ending::Damaged;
                    break;
                }
                Item::Pen | Item::Fraction | Item::Up | Item::Absolute => {
                    is_up |= item == Item::Up;
                    is_absolute |= item == Item::Absolute;
                    flag = Some(item).filter(|item| matches!(item, Item::Pen | Item::Fraction)).or(flag);
                    continue;
                }
            };
            match flag.take() {
                Some(Item::Pen) => self.take_pen(number as f64),
                Some(_) if FRACTION_BITS.contains(&number) => body.step = 2.0_f64.powi(-number as i32),
                Some(_) => {
                    body.ending = Ending::Damaged;
                    break;
                }
                None => {
                    let value = number as f64 * body.step;
                    let Some((x, start)) = first.take() else {
                        first = Some((value, start));
                        continue;
                    };
                    let pair = [x, value];
                    let to = if is_absolute { self.plotter.absolute(pair) } else { self.plotter.relative(pair) };
                    let span = self.reader.within(start, body.at);
                    if is_up {
                        self.plotter.lift();
                    } else {
                        self.plotter.lower(span);
                    }
                    let outcome = self.plotter.lead(to, span);
                    self.check(outcome, span);
                    if is_absolute {
                        self.plotter.settle();
                    }
                    (is_absolute, is_up) = (false, false);
                }
            }
        }
        self.reader.behind(&body);
        let start = first.map_or(body.at.saturating_sub(1), |(_, start)| start);
        if first.is_some() {
            // A body with an unpaired number has lost one.
            body.ending = Ending::Damaged;
        }
        self.end_encoded(&body, self.reader.within(start, body.at));
        self.plotter.encoded(self.reader.within(body.start, body.at), body.digit_bits(), body.step);
    }

    /// Diagnostics about the end of an encoded polyline, or about a fault before it.
    fn end_encoded(&mut self, body: &Body, span: Span) {
        match body.ending {
            Ending::Damaged => {
                let finding =
                    Diagnostic::new(&code::HPGL_PE_DAMAGED, "an encoded polyline (PE) is damaged here").at(span);
                self.out.push(finding.hint("transfer the file again, as binary data"));
            }
            Ending::Open => {
                let finding =
                    Diagnostic::new(&code::HPGL_PE_OPEN, "an encoded polyline (PE) has no semicolon at its end");
                self.out.push(finding.at(span).hint("the file may be cut short; compare its size with the original"));
            }
            Ending::Done | Ending::More | Ending::Next => {}
        }
        if body.is_empty() {
            self.plotter.tear(span); // a PD with a changed letter
        }
        if body.repaired {
            self.tally.repaired(span);
        }
    }

    /// LB.
    fn label(&mut self, span: Span) {
        let text = self.text(span);
        if text.start < text.end {
            self.write(text);
        }
    }

    /// The text of LB, BL and WD.
    fn text(&mut self, span: Span) -> Span {
        let (text, is_open) = self.reader.text();
        if is_open {
            self.tally.open_label(span);
        }
        text
    }

    /// Adds a text at the place of the pen.
    fn write(&mut self, text: Span) {
        let (at, heading) = (Some(self.plotter.place()), self.heading);
        self.labels.push(Label { at, heading, span: text, mirrored: None });
        self.plotter.drift();
    }

    /// Counts an instruction that draws and lacks numbers.
    fn incomplete(&mut self, span: Span) {
        self.plotter.lost.add(span);
    }
}
