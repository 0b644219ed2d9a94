//! Target `iso`: the marker as a normalised ISO cut file.
//!
//! Every file of the family, and anything else that was read, comes out in one spelling: a block a line, both coordinates
//! in every point, slits and crossbars before the contours of their piece, one layout for each kind of label, the list of
//! labels behind M0. Read again it gives the same marker. A marker that lies on no grid of the dialect is written in
//! tenths of a millimetre with decimals. Where windows of a conveyor split a piece, each section comes as a piece of the same
//! number, with open lines in place of the outline.
//!
//! | block | what it says |
//! |---|---|
//! | `H1`, `G70` or `G71` or neither | head, unit of 0.0254, 0.1 or 0.254 mm |
//! | `N7` | a piece, or a section of one; behind it events (`M01`, `M69`) and the feed (`F`) where it changes |
//! | `ZX..` | the length of the advance `M69` behind it, between two windows of a conveyor |
//! | `X..Y..M43`, `M44`, `M45`, `M73` | a hole |
//! | `M31`, `X..Y..`, text | a label; with a direction `X..Y..M31`, text and the second point |
//! | `X..Y..`, `M14`, `M19`, `X..Y..`, `M15` | a slit |
//! | `X..Y..`, `M14` ... `M15` | a contour, with `M17`, `M18`, `M46` and speeds where the marker has them |

use std::io;

use super::target::{Context, Emit, Output, Proof, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Heading, Point};
use crate::ir::list::{FULL_SPEED, Joint, Range, Segment};
use crate::ir::marker::{Event, Field, Label, Notch, NotchKind, Piece};
use crate::ir::toolpath;
use crate::source::Span;
use crate::units::{MM_PER_INCH, S_PER_MIN, number};

pub(super) const TARGET: Target = Target {
    name: "iso",
    about: "a normalised ISO cut file that says the same as the input",
    extension: "iso",
    emit: Emit::Marker(emit),
    proof: Some(Proof::Marker),
};

/// Units of the dialect, mm, and their codes; a file without a code is in hundredths of an inch.
const UNITS: [(f64, Option<&str>); 3] =
    [(0.1, Some("G71")), (MM_PER_INCH / 100.0, None), (MM_PER_INCH / 1000.0, Some("G70"))];
/// Decimals that count in a file, and the step of the last one.
const DECIMALS: u32 = 6;
const STEP: f64 = 1e-6;
/// Greatest number that a file may hold.
const VALUE_MAX: f64 = 1e8;
/// Distance from the place of a label to its second point, units: far enough for six decimals to give the direction.
const LABEL_REACH: f64 = 1000.0;
/// Speeds of M60 to M67, percent.
const SPEEDS: [u8; 8] = [95, 90, 85, 80, 75, 70, 65, 60];

fn emit(context: &Context, out: &mut dyn Output, diagnostics: &mut Diagnostics) -> io::Result<()> {
    if !context.job.mode.cuts() {
        let message = "the target iso cannot keep the knife up: a cut file says what is cut, not how the axes move";
        diagnostics.push(Diagnostic::new(&code::TARGET_REFUSED, message).hint("leave --dry-run and --frame out"));
        return Ok(());
    }
    let mut file = File::new(context);
    file.whole();
    if file.faults.is_empty() {
        return out.write_all(&file.text);
    }
    file.faults.into_iter().for_each(|fault| diagnostics.push(fault));
    Ok(())
}

/// A file in the making.
struct File<'a> {
    context: &'a Context<'a>,
    text: Vec<u8>,
    /// Grid of the numbers, mm.
    unit: f64,
    /// The feed in force, mm/s.
    feed: Option<f64>,
    /// Speeds in force, percent: M25's, and that of M60 to M67, which only the next piece ends.
    slow: u8,
    of_piece: u8,
    faults: Vec<Diagnostic>,
}

impl<'a> File<'a> {
    fn new(context: &'a Context<'a>) -> Self {
        // The grid of the file: that of the marker includes the growth on the table.
        let growth = context.job.growth();
        let unit = UNITS.iter().map(|row| row.0).find(|&unit| unit * growth == context.marker.unit);
        Self {
            context,
            text: Vec::new(),
            unit: unit.unwrap_or(UNITS[0].0),
            feed: None,
            slow: FULL_SPEED,
            of_piece: FULL_SPEED,
            faults: Vec::new(),
        }
    }

    fn whole(&mut self) {
        let marker = self.context.marker;
        self.block("H1");
        if let Some((_, Some(code))) = UNITS.iter().find(|row| row.0 == self.unit) {
            self.block(code);
        }
        // Events and labels of a piece without cuts belong to the next one, as readers of the format have it.
        let (mut events, mut labels): (Vec<&Event>, Vec<&Label>) = (Vec::new(), Vec::new());
        let last = marker.pieces.iter().rposition(is_cut);
        for (i, piece) in marker.pieces.iter().enumerate() {
            events.extend(&piece.events);
            labels.extend(&piece.labels);
            if Some(i) == last {
                labels.extend(marker.pieces[i + 1..].iter().flat_map(|piece| &piece.labels));
            }
            if is_cut(piece) {
                self.piece(i, &std::mem::take(&mut events), &std::mem::take(&mut labels));
            }
        }
        events.into_iter().chain(&marker.closing).for_each(|event| self.event(event));
        self.block("M0");
        self.list_of_labels();
    }

    fn piece(&mut self, part: usize, events: &[&Event], labels: &[&Label]) {
        let marker = self.context.marker;
        let piece = &marker.pieces[part];
        self.block(&format!("N{}", piece.number));
        (self.slow, self.of_piece) = (FULL_SPEED, FULL_SPEED);
        for event in events {
            self.event(event);
        }
        self.set_feed(piece);
        for drill in &piece.drills {
            let code = match drill.tool {
                1 => "M43",
                2 => "M44",
                3 => "M45",
                _ => "M73",
            };
            self.point(drill.at, code);
        }
        for label in labels {
            self.label(label);
        }
        piece.notches.iter().for_each(|notch| self.notch(notch));
        let split = marker.split_outline(part);
        let whole = piece.contours.iter().enumerate().filter(|(i, _)| Some(*i) != split);
        whole.map(|(_, contour)| contour.range).chain(marker.section_cuts(part)).for_each(|range| self.contour(range));
    }

    fn event(&mut self, event: &Event) {
        match event.kind {
            toolpath::Event::Stop => return self.block("M01"),
            toolpath::Event::Advance => {}
            // Coordinates stay those of the marker: readers of the file count the bites.
            toolpath::Event::AdvanceBy(mm) => {
                self.text.extend_from_slice(b"ZX");
                self.number(f64::from(mm) / self.unit, event.span);
                self.end_block();
            }
        }
        self.block("M69");
    }

    /// F, where the feed changes. It stays in force, so that no piece behind a capped one can be without a cap.
    fn set_feed(&mut self, piece: &Piece) {
        let has_lines = piece.section.is_some() || !(piece.contours.is_empty() && piece.notches.is_empty());
        if !has_lines || piece.feed == self.feed {
            return;
        }
        let Some(feed) = piece.feed else {
            self.refuse(piece.span, format!("piece {} has no cap on its speed, but one before it has", piece.number));
            return;
        };
        self.text.push(b'F');
        self.number(feed * S_PER_MIN / MM_PER_INCH, piece.span);
        self.end_block();
        self.feed = Some(feed);
    }

    /// M25, M26 and M60 to M67, so that the product of their speeds is `percent`.
    fn set_speed(&mut self, percent: u8, span: Span) {
        let slowed = self.context.job.profile.knife.slow();
        let product = |slow: u8, of_piece: u8| (u32::from(slow) * u32::from(of_piece) / u32::from(FULL_SPEED)).max(1);
        let is_it = |&(slow, of_piece): &(u8, u8)| product(slow, of_piece) == u32::from(percent);
        let slows = [self.slow, FULL_SPEED, slowed];
        let of_pieces = std::iter::once(self.of_piece).chain(SPEEDS);
        let Some((slow, of_piece)) = of_pieces.flat_map(|of| slows.map(|slow| (slow, of))).find(is_it) else {
            self.refuse(span, format!("no code, or none behind those before it, gives {percent} percent of the speed"));
            return;
        };
        if slow != self.slow {
            self.block(if slow == FULL_SPEED { "M26" } else { "M25" });
        }
        if let Some(k) = SPEEDS.iter().position(|&speed| speed == of_piece && of_piece != self.of_piece) {
            self.block(&format!("M{}", 60 + k));
        }
        (self.slow, self.of_piece) = (slow, of_piece);
    }

    fn notch(&mut self, notch: &Notch) {
        self.set_speed(notch.percent, notch.span);
        self.point(notch.root, "");
        self.blocks(&["M14", "M19"]);
        self.point(notch.tip, "");
        self.block("M15");
        match notch.kind {
            NotchKind::Slit => {}
            NotchKind::T(bar) => {
                self.point(bar.from, "");
                self.block("M14");
                self.point(bar.to, "");
                self.block("M15");
            }
        }
    }

    fn contour(&mut self, range: Range) {
        let segments: Vec<Segment> = self.context.marker.list.walk(range).map(|(_, s)| s).collect();
        let first = segments[0];
        self.set_speed(first.percent, first.span);
        self.point(first.from, "");
        if is_slit(&segments) {
            self.blocks(&["M14", "M19"]);
            for segment in &segments {
                self.set_speed(segment.percent, segment.span);
                self.point(segment.to, "");
            }
            self.block("M15");
            return;
        }
        if first.joint.full_advance {
            self.block("M17");
        }
        self.block("M14");
        if first.joint.lift {
            // A lift at the very start is asked for at the point that repeats it.
            self.block("M46");
            self.point(first.from, "");
        }
        for (i, segment) in segments.iter().enumerate() {
            self.set_speed(segment.percent, segment.span);
            let joint = segments.get(i + 1).map_or(Joint::default(), |next| next.joint);
            let is_plain = !joint.full_advance && !joint.no_overcut;
            if joint.lift && is_plain {
                self.block("M46");
            }
            self.point(segment.to, "");
            if !is_plain {
                self.interrupt(joint, segment.span);
            }
        }
        if first.joint.no_overcut {
            self.block("M18");
        }
        self.block("M15");
    }

    /// Up and down again at a joint, with the codes that act there. A slit without a way leaves the contour without a lift
    /// that is meant.
    fn interrupt(&mut self, joint: Joint, span: Span) {
        match (joint.lift, joint.no_overcut) {
            (true, true) => self.blocks(&["M18", "M15"]),
            (true, false) => self.block("M15"),
            (false, false) => self.blocks(&["M19", "M15"]),
            (false, true) => self.refuse(span, "no code leaves the overcut out where the knife is not lifted"),
        }
        if joint.full_advance {
            self.block("M17");
        }
        self.block("M14");
    }

    fn label(&mut self, label: &Label) {
        let source = self.context.source;
        let words = [Some(label.span), label.mirrored].map(|span| span.map(|span| source.slice(span).trim_ascii()));
        if words.iter().flatten().any(|text| text.contains(&b'*')) {
            self.refuse(label.span, "a label holds `*`, which ends a text");
            return;
        }
        let [text, mirrored] = words.map(Option::unwrap_or_default);
        let second = label.at.filter(|_| label.heading.is_some() || label.mirrored.is_some());
        let Some(at) = second else {
            self.block("M31");
            if let Some(at) = label.at {
                self.point(at, "");
            }
            self.text_block(text);
            return;
        };
        let reach = LABEL_REACH * self.unit;
        let second = label.heading.map_or(at, |heading: Heading| at + heading.unit() * reach);
        self.point(at, "M31");
        self.text_block(text);
        if label.mirrored.is_some() {
            self.text_block(mirrored);
            self.point(second, "M31");
        } else {
            self.point(second, "");
        }
        // The label is complete here, whatever follows.
        self.block("M15");
    }

    /// The list behind M0. A record is named by its first N or L, so one that begins without comes first.
    fn list_of_labels(&mut self) {
        let marker = self.context.marker;
        let is_named = |piece: &&Piece| piece.fields.first().is_some_and(|field| matches!(field.letter, b'L' | b'N'));
        // The list goes by numbers, which all copies have in common.
        let is_listed = |piece: &&Piece| is_cut(piece) && !piece.fields.is_empty() && piece.copy < 2;
        let with_fields = marker.pieces.iter().filter(is_listed);
        let (named, unnamed): (Vec<&Piece>, Vec<&Piece>) = with_fields.partition(is_named);
        if named.is_empty() && unnamed.is_empty() {
            return;
        }
        for Field { letter, span } in unnamed.iter().chain(&named).flat_map(|piece| &piece.fields) {
            self.text.extend_from_slice(&[*letter, b',']);
            self.text.extend_from_slice(self.context.source.slice(*span));
            self.text.push(b'\n');
        }
        self.block("L0");
    }

    fn blocks(&mut self, texts: &[&str]) {
        for text in texts {
            self.block(text);
        }
    }

    fn block(&mut self, text: &str) {
        self.text_block(text.as_bytes());
    }

    fn text_block(&mut self, text: &[u8]) {
        self.text.extend_from_slice(text);
        self.end_block();
    }

    fn end_block(&mut self) {
        self.text.extend_from_slice(b"*\n");
    }

    /// A place, and the code that shares its block.
    fn point(&mut self, at: Point, code: &str) {
        self.text.push(b'X');
        self.number(at.x / self.unit, Span::default());
        self.text.push(b'Y');
        self.number(at.y / self.unit, Span::default());
        self.block(code);
    }

    /// A number with as few decimals as it has, of those that count.
    fn number(&mut self, value: f64, span: Span) {
        if value.abs() > VALUE_MAX {
            self.refuse(span, format!("a number is beyond {VALUE_MAX} units of the file"));
        }
        let decimals = if (value - value.round()).abs() < 0.5 * STEP { 0 } else { DECIMALS };
        number::push_fixed(&mut self.text, value, decimals);
        if decimals > 0 {
            let zeros = self.text.iter().rev().take_while(|&&digit| digit == b'0').count();
            self.text.truncate(self.text.len() - zeros);
        }
    }

    fn refuse(&mut self, span: Span, message: impl std::fmt::Display) {
        let fault = Diagnostic::new(&code::TARGET_REFUSED, format!("the target iso cannot say this: {message}"));
        let span = Some(span).filter(|span| *span != Span::default());
        self.faults.push(Diagnostic { span, ..fault }.hint("write another target, or choose pieces without it"));
    }
}

/// True if anything of a piece is cut or drilled.
fn is_cut(piece: &Piece) -> bool {
    piece.section.is_some() || !(piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty())
}

/// True if an open line is a slit of several legs: one that begins with M19 and has no overlaps.
fn is_slit(segments: &[Segment]) -> bool {
    let bare = |i: usize| Joint { lift: false, full_advance: i == 0, no_overcut: true };
    segments.len() > 1 && segments.iter().enumerate().all(|(i, segment)| segment.joint == bare(i))
}
