//! The meaning of a file: executes block after block and builds the marker. [`texts`] reads labels and messages, [`see`]
//! looks for damage in its blocks, [`knife`] lowers and lifts the knife.

mod knife;
mod see;
mod texts;

use std::ops::ControlFlow;

use super::alone::Alone;
use super::arc::{Arc, Centre, Turn};
use super::at_place::{AtPlace, Hole, Texts};
use super::block::Blocks;
use super::decimal;
use super::draft::{Draft, LabelId};
use super::lost;
use super::meaning::{Meaning, meaning, name, whole};
use super::misplaced::{self, Head};
use super::relative;
use super::run::Run;
use super::start::{Begun, Start, Twice};
use super::strokes::Strokes;
use super::syntax::{Code, Point};
use super::tally::Tally;
use super::title::Title;
use super::trailer;
use super::unit::{Sized, Unit, check_plausible, convert, convert_run, scale};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::decimals::Decimals;
use crate::geom::{self, Vector};
use crate::ir::Marker;
use crate::ir::list::FULL_SPEED;
use crate::ir::marker::Event;
use crate::machine::Job;
use crate::source::{Source, Span};
use crate::units::{MM_PER_INCH, MM_PER_M};

/// Maximum deviation of chords from their arc, mm: far below what shows on cloth, and coarse enough for few chords.
const SAGITTA_MAX: f64 = 0.01;
/// Fraction of the tolerance available to the chords of an arc; the rest is for the knife.
const SAGITTA_SHARE: f64 = 0.25;
const SECONDS_PER_MINUTE: f64 = 60.0;
/// Bytes of a large file per segment, a low estimate: moving all segments takes longer than allocating unused capacity.
const BYTES_A_SEGMENT: usize = 12;
/// Usual minimum number of bytes per piece. It sets the initial capacity, which grows if pieces are shorter.
const BYTES_A_PIECE: usize = 512;

/// Reads a file as the job's profile requires.
pub(super) fn lower(source: &Source, job: &Job, out: &mut Diagnostics) -> Marker {
    let mut lowering = Lowering {
        source,
        job,
        blocks: Blocks::new(source.bytes()),
        knife: Draft::with_room(source.bytes().len() / BYTES_A_SEGMENT, source.bytes().len() / BYTES_A_PIECE),
        unit: Unit::new(job.profile.units),
        run: Run::default(),
        place: [None, None],
        damaged: false,
        far: None,
        fresh: false,
        waiting: None,
        awaiting: None,
        second: None,
        title: None,
        bite: None,
        turn: None,
        ended: None,
        tally: Tally::default(),
        alone: Alone::default(),
        decimals: Decimals::default(),
        head: Head::default(),
        start: Start::default(),
        twice: Twice::default(),
        strokes: Strokes::default(),
        last_cut: None,
        out,
    };
    let last = lowering.run();
    lowering.finish(last)
}

struct Lowering<'a> {
    source: &'a Source,
    job: &'a Job,
    blocks: Blocks<'a>,
    knife: Draft,
    unit: Unit,
    run: Run,
    /// The last X and Y, in units of the file; a coordinate that a block omits keeps its value.
    place: [Option<f64>; 2],
    /// True if a block was unreadable: it may have held the missing coordinates.
    damaged: bool,
    /// The first point beyond [`FARTHEST`](super::unit::FARTHEST), mm, and its block.
    far: Option<(geom::Point, Span)>,
    /// True if the knife has moved here in the air and nothing has been done here yet: a drill code without a point applies
    /// here.
    fresh: bool,
    /// A drill code that waits for its point.
    waiting: Option<Hole>,
    /// A label that may still get a second point, and a label whose second point is the current position unless the knife
    /// plunges there.
    awaiting: Option<LabelId>,
    second: Option<LabelId>,
    title: Option<Title>,
    /// Bite size: its code, the size in units of the file, and its block.
    bite: Option<(Code, f64, Span)>,
    /// Direction of blocks with I or J: that of the last G02 or G03; `None` after G01.
    turn: Option<Turn>,
    /// Offset after the M0 that ended the file.
    ended: Option<usize>,
    tally: Tally,
    /// Points with one coordinate.
    alone: Alone,
    decimals: Decimals,
    head: Head,
    start: Start,
    twice: Twice,
    strokes: Strokes,
    /// Offset after the last block that cuts or drills; `None` until it is searched for.
    last_cut: Option<usize>,
    out: &'a mut Diagnostics,
}

impl Lowering<'_> {
    /// Executes the file to its end and returns its last block.
    fn run(&mut self) -> Span {
        let mut ended = false;
        let mut last = Span::default();
        loop {
            if let Some((point, span)) = self.blocks.next_point() {
                self.see_place(point, span);
                self.go(point, span);
                last = self.cut_on().unwrap_or(span);
                continue;
            }
            let flow = if let Some((code, span)) = self.blocks.next_code() {
                last = span;
                self.obey(&[code], None, span)
            } else {
                let Some(block) = self.blocks.next() else { break };
                last = block.span;
                match block.words {
                    Ok(mut words) => {
                        self.see_words(&mut words, block.span);
                        self.obey(&words.codes, words.point, block.span)
                    }
                    Err(fault) => {
                        self.damaged = true;
                        self.out.push(fault);
                        ControlFlow::Continue(())
                    }
                }
            };
            if flow.is_break() {
                ended = true;
                self.ended = Some(self.blocks.offset());
                break;
            }
        }
        if !self.blocks.all_ended() {
            let finding = Diagnostic::new(&code::ISO_NO_FINAL_ASTERISK, "the last block has no `*`").at(last);
            self.out.push(finding.hint("check that the file is complete"));
        }
        if let Some(span) = self.blocks.frame() {
            let finding =
                Diagnostic::new(&code::ISO_FRAME, "a line of `%` frames the file; it is passed over").at(span);
            self.out.push(finding.hint("cut files need none: check that the file is meant for this cutter"));
        }
        if !ended {
            let finding = Diagnostic::new(&code::ISO_NO_END, "the file has no M0 at its end").at(last);
            self.out.push(finding.hint("check that the file is complete"));
        }
        last
    }

    /// Continues the current cut over the following blocks of X and Y only. These are most of a file and only add vertices,
    /// since the first block after a code has already applied that code. Returns the last block; `None` if there is none or the
    /// knife is not cutting.
    fn cut_on(&mut self) -> Option<Span> {
        let Self { knife, blocks, unit, far, run, .. } = self;
        let mut last = None;
        let span = knife.cut_on(|vertices| {
            let unit = unit.convert();
            while blocks.next_run(run) {
                last = convert_run(run, unit, far, vertices);
            }
        });
        self.place = last?.map(Some);
        span
    }

    /// Finishes the marker and checks it as a whole.
    fn finish(mut self, last: Span) -> Marker {
        self.settle_second_point();
        let (mut marker, extent) = self.knife.finish(last, self.unit.mm(), self.out);
        if let Some((place, span)) = self.far {
            let size = place.x.abs().max(place.y.abs()) / MM_PER_M;
            let message = format!("the place is {size:.0} m from the origin, with a unit of {} mm", self.unit.mm());
            let finding = Diagnostic::new(&code::ISO_FAR_PLACE, message).at(span);
            self.out.push(finding.hint("a digit may be doubled; or set `units` in the profile if the unit is wrong"));
        }
        if let Some(offset) = self.ended {
            trailer::read(self.source, offset, last.block, &mut marker.pieces, self.out);
        }
        if let Some((code, size, span)) = self.bite
            && size * self.unit.mm() < extent.max.x
            && self.job.profile.bite.length_mm.is_none()
        {
            self.tally.ignore(code, "bite size", span);
        }
        self.tally.report(self.out);
        self.strokes.report(self.out);
        self.blocks.passed().report(self.out);
        self.alone.report(self.source.bytes(), self.blocks.torn(last), self.out);
        let found =
            [decimal::finding(&self.decimals, self.source.bytes()), self.twice.finding(), relative::finding(&marker)];
        found.into_iter().flatten().for_each(|finding| self.out.push(finding));
        if marker.pieces.is_empty() && !self.out.has_errors() {
            let finding = Diagnostic::new(&code::ISO_NOTHING_TO_CUT, "the file holds no contour, slit or drill");
            let photoplot = lost::photoplot(self.source.bytes());
            let hint = "export the marker with its cut lines, or see what `codes` of the profile ignores";
            self.out.push(photoplot.unwrap_or_else(|| finding.hint(hint)));
        }
        // A point beyond a kilometre makes further findings on size redundant.
        if self.far.is_none() {
            let (title, bytes) = (self.title.as_ref(), self.source.bytes());
            let sized = Sized { unit: &self.unit, extent: &extent, title, bytes };
            check_plausible(sized, &marker, self.out);
        }
        marker
    }

    /// Executes a block of coordinates only.
    fn go(&mut self, point: Point, span: Span) {
        if point.has_centre() {
            return self.arc(point, None, span);
        }
        let to = self.locate(point, span);
        self.go_to(to, span);
    }

    /// Moves in a straight line.
    fn go_to(&mut self, to: geom::Point, span: Span) {
        if self.knife.is_down() {
            self.knife.go(to, span);
        } else {
            self.land(to, span);
        }
    }

    /// Moves with the knife up.
    fn land(&mut self, to: geom::Point, span: Span) {
        if let Some(hole) = self.waiting.take() {
            self.move_in_air(to, span);
            return self.drill(hole);
        }
        let label = self.awaiting.take();
        self.move_in_air(to, span);
        if label.is_some() {
            self.knife.settle();
        }
        self.second = label;
    }

    fn move_in_air(&mut self, to: geom::Point, span: Span) {
        self.settle_second_point();
        self.awaiting = None;
        self.knife.go(to, span);
        self.fresh = true;
        self.start.go();
    }

    /// Executes the codes of a block, then its move; labels and drills apply at the end position of the block. (According to
    /// the vendor, a knife code before the point of its block acts before the move; no known file has one.)
    fn obey(&mut self, codes: &[Code], point: Option<Point>, span: Span) -> ControlFlow<()> {
        let asked = self.obey_codes(codes, point, span);
        self.obey_place(&asked, point, span);
        // Everything in the block of the end is executed, too.
        if asked.ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Executes the codes of a block and returns the actions for its end position.
    fn obey_codes(&mut self, codes: &[Code], point: Option<Point>, span: Span) -> AtPlace {
        let names_end = || codes.iter().any(|&code| meaning(code) == Meaning::End);
        let mut asked = AtPlace::default();
        for &code in codes {
            let obeyed = self.obeys(code);
            match meaning(code) {
                Meaning::Park | Meaning::BiteSize if obeyed && self.knife.is_down() => {
                    asked.rests = true;
                    self.out.push(misplaced::amid_cut(code, point.is_some(), span));
                }
                Meaning::Park => asked.rests = true,
                Meaning::BiteSize => {
                    asked.rests = true;
                    let size = code.number.or(point.and_then(|point| point.x));
                    self.bite = size.filter(|_| obeyed).map(|size| (code, size, span)).or(self.bite);
                }
                Meaning::Message => self.message(),
                Meaning::Label => asked.label = Some(if obeyed { Texts::Kept } else { Texts::Ignored }),
                _ if !obeyed => {}
                Meaning::Down => self.down(span),
                Meaning::Up => self.up(),
                Meaning::Piece => self.piece(code, span),
                Meaning::Unit(unit) => self.unit.set(unit, span, self.out),
                Meaning::Drill(tool) => (asked.drill, asked.names_end) = (Some(tool), names_end()),
                Meaning::Arc(way) => (asked.turn, self.turn) = (Some(way), Some(way)),
                Meaning::Line => self.turn = None,
                Meaning::Rapid => {
                    self.turn = None;
                    self.tally.ignore(code, "rapid positioning", span);
                }
                Meaning::Slow => self.knife.slow(self.job.profile.knife.slow()),
                Meaning::Normal => self.knife.slow(FULL_SPEED),
                Meaning::SpeedOfPiece(percent) => self.knife.speed_of_piece(percent),
                Meaning::Feed => self.feed(code, span),
                Meaning::Event(kind) => self.knife.event(Event { kind, span }),
                Meaning::Origin => self.origin(code, point, span),
                Meaning::Slit => self.knife.slit(span),
                Meaning::FullAdvance => self.knife.full_advance(),
                Meaning::NoOvercut => self.knife.no_overcut(),
                Meaning::CornerLift => self.knife.corner_lift(),
                Meaning::End if self.more_to_cut() => {
                    self.head.end();
                    self.tally.ignore(code, "stop before the end", span);
                }
                Meaning::End => asked.ends = true,
                Meaning::NotObeyed(what) => self.tally.ignore(code, what, span),
                Meaning::Housekeeping if code.letter == b'H' && point.is_none() => self.file_number(code, span),
                Meaning::Housekeeping => {}
                Meaning::Unknown if code.letter == b'R' && point.is_some() => asked.radius = Some(code),
                Meaning::Unknown => self.tally.unknown(code, span),
            }
        }
        asked
    }

    /// Executes the actions of a block at its end position, and the move to it.
    fn obey_place(&mut self, asked: &AtPlace, point: Option<Point>, span: Span) {
        let AtPlace { rests, drill, label, radius, names_end, .. } = *asked;
        let point = point.filter(|_| !rests);
        // The direction of the last G02 or G03 also applies to a block with only a radius.
        let turn = asked.turn.or(radius.and(self.turn));
        if let Some(code) = radius.filter(|_| turn.is_none() || drill.is_some() || label.is_some()) {
            self.tally.unknown(code, span);
        }
        if let Some(tool) = drill {
            let hole = Hole { tool, span };
            // No point follows the end of the file, and the point after M31 is that of the label.
            let may_wait = label.is_none() && !names_end;
            match point {
                _ if self.knife.is_down() => self.refuse_hole(hole),
                Some(point) => {
                    let to = self.locate(point, span);
                    self.move_in_air(to, span);
                    self.drill(hole);
                }
                None if may_wait && !self.fresh && self.point_of_drill_follows() => self.waiting = Some(hole),
                None => self.drill(hole),
            }
        }
        if let Some(texts) = label {
            self.label(point, texts);
        } else if let Some(point) = point.filter(|_| drill.is_none()) {
            match turn {
                Some(_) => self.arc(point, radius.and_then(|code| code.number), span),
                None => self.go(point, span),
            }
        }
    }

    #[inline] // called for every code
    fn obeys(&self, code: Code) -> bool {
        self.job.profile.codes.is_empty() || self.job.profile.obeys(&name(code))
    }

    /// Records a piece or a label: the contour behind it needs a start, unless an interrupted one goes on.
    fn begin(&mut self, begun: Begun, span: Span) {
        let is_amid = self.knife.is_down() || self.knife.is_at_open_end();
        self.start.begin(begun, span, is_amid);
    }

    /// H.
    fn file_number(&mut self, code: Code, span: Span) {
        self.head.see(code, span).into_iter().for_each(|finding| self.out.push(finding));
    }

    /// N: a piece begins.
    fn piece(&mut self, code: Code, span: Span) {
        self.settle_second_point();
        self.awaiting = None;
        self.head.pass();
        self.begin(Begun::Piece, span);
        let number = code.number.and_then(whole);
        if number.is_none() && code.number.is_some() {
            self.tally.ignore(code, "piece number that is not a whole one", span);
        }
        self.knife.begin_piece(number, span, self.out);
    }

    /// F: caps the speed; without a valid speed it is reported.
    fn feed(&mut self, code: Code, span: Span) {
        match code.number {
            Some(feed) if feed > 0.0 => self.knife.feed(feed * MM_PER_INCH / SECONDS_PER_MINUTE),
            _ => self.tally.ignore(code, "feed without a speed", span),
        }
    }

    /// G04 and M70: before the first point of the file they set the usual origin and have no effect. Vendors do not define
    /// later ones, and all coordinates are absolute, so those are reported.
    fn origin(&mut self, code: Code, point: Option<Point>, span: Span) {
        if self.place != [None, None] || point.is_some() {
            self.tally.ignore(code, "origin amid the file", span);
        }
    }

    /// A block with the end of an arc and its centre or radius. All chords keep the block. With the knife up it is an ordinary
    /// move.
    fn arc(&mut self, point: Point, radius: Option<f64>, span: Span) {
        let from = self.knife.at();
        let to = self.locate(point, span);
        if !self.knife.is_down() {
            if point.has_centre() && from == to {
                self.out.push(lost::circle_in_air(span));
            }
            return self.land(to, span);
        }
        let unit = self.unit.mm();
        let centre = if point.has_centre() {
            Some(Centre::At(Vector::new(point.i.unwrap_or(0.0) * unit, point.j.unwrap_or(0.0) * unit)))
        } else {
            radius.map(|radius| Centre::Radius(radius * unit))
        };
        let chords = match (self.turn, centre) {
            (Some(turn), Some(centre)) => {
                let sagitta = (self.job.profile.tolerance(unit) * SAGITTA_SHARE).min(SAGITTA_MAX);
                Arc { from, to, turn, centre }.flatten(unit, sagitta)
            }
            (None, _) => Err("I or J stand in a block that no G02 or G03 makes an arc".to_owned()),
            (Some(_), None) => Err("the arc has neither a centre I J nor a radius R".to_owned()),
        };
        match chords {
            Ok(chords) => chords.into_iter().for_each(|to| self.knife.go(to, span)),
            Err(message) => {
                let finding = Diagnostic::new(&code::ISO_ARC_RADIUS, message).at(span);
                self.out.push(finding.hint(match centre {
                    Some(Centre::Radius(_)) => "R is in units of the file, and at least half the way to the arc's end",
                    Some(Centre::At(_)) | None => "I and J give the centre as seen from the start of the arc",
                }));
                self.knife.go(to, span);
            }
        }
    }

    /// Adds a hole at the position of the knife.
    fn drill(&mut self, Hole { tool, span }: Hole) {
        self.second = None;
        self.fresh = false;
        self.twice.see(self.knife.at(), Hole { tool, span });
        self.start.serve();
        self.head.pass();
        self.knife.drill(self.knife.at(), tool, span);
    }

    fn refuse_hole(&mut self, hole: Hole) {
        let message = "a drill code stands where the knife is down";
        let finding = Diagnostic::new(&code::ISO_DRILL_KNIFE_DOWN, message).at(hole.span);
        self.out.push(finding.hint("an M15 may be missing before it"));
    }

    /// True if the next block is a point other than the start of a contour.
    fn point_of_drill_follows(&self) -> bool {
        let mut ahead = self.blocks.clone();
        let words = |ahead: &mut Blocks<'_>| ahead.next().and_then(|block| block.words.ok());
        if !words(&mut ahead).is_some_and(|words| words.codes.is_empty() && words.point.is_some()) {
            return false;
        }
        while let Some(words) = words(&mut ahead) {
            if words.point.is_some() {
                return true;
            }
            for &code in &words.codes {
                match meaning(code) {
                    Meaning::Down if self.obeys(code) => return false,
                    Meaning::Up | Meaning::Housekeeping | Meaning::FullAdvance | Meaning::NoOvercut => {}
                    _ => return true,
                }
            }
        }
        true
    }

    /// True if any later block cuts or drills. The file is searched only once.
    fn more_to_cut(&mut self) -> bool {
        let last = *self.last_cut.get_or_insert_with(|| trailer::last_cut(self.blocks.clone()));
        last > self.blocks.offset()
    }

    /// Converts a point of the file to mm and makes it the current position.
    fn locate(&mut self, point: Point, span: Span) -> geom::Point {
        self.place = [point.x.or(self.place[0]), point.y.or(self.place[1])];
        convert(self.place.map(Option::unwrap_or_default), self.unit.convert(), span, &mut self.far)
    }

    /// Converts a point of the file to mm.
    fn peek(&mut self, point: Point) -> geom::Point {
        let place = [point.x.or(self.place[0]), point.y.or(self.place[1])].map(Option::unwrap_or_default);
        scale(place, self.unit.convert())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::FileUnit;
    use crate::machine::profile::CodeUse;

    const SQUARE: &str = "H1*G71*M15*N1*X0Y0*M14*X1000Y0*X1000Y1000*M19*X800Y800*M15*X1000Y1000*M14*X0Y0*M15*M0*";

    /// Reads with a profile; gives the marker and the codes of the findings.
    fn check(text: &str, edit: impl Fn(&mut Job), found: &[&str]) -> Marker {
        let source = Source::new("a", text.as_bytes().to_vec()).expect("small");
        let mut job = Job::default();
        edit(&mut job);
        let mut out = Diagnostics::default();
        let marker = lower(&source, &job, &mut out);
        let codes: Vec<&str> = out.iter().map(|diagnostic| diagnostic.code.name).collect();
        assert_eq!(codes, found, "{text}");
        marker
    }

    #[test]
    fn the_profile_overrides_the_unit_of_the_file() {
        let marker = check(SQUARE, |job| job.profile.units = FileUnit::HundredthInch, &[]);
        assert_eq!(marker.extent().size(), (1000.0 * 0.254, 1000.0 * 0.254));
        assert_eq!(marker.unit.to_bits(), 0.254_f64.to_bits());
    }

    #[test]
    fn a_code_that_the_profile_ignores_is_skipped_in_silence() {
        let ignore =
            |name: &'static str| move |job: &mut Job| _ = job.profile.codes.insert(name.to_owned(), CodeUse::Ignore);
        assert_eq!(check(SQUARE, ignore("M19"), &[]).pieces[0].notches.len(), 0);
        assert_eq!(check(SQUARE, |_| {}, &[]).pieces[0].notches.len(), 1);
        check("H1*G71*E*E*X0Y0*M14*X500Y0*M15*M0*", |_| {}, &["iso/ignored-code"]);
        check("H1*G71*E*E*X0Y0*M14*X500Y0*M15*M0*", ignore("E"), &[]);
        let feed = |marker: Marker| marker.pieces[0].feed;
        let slow = "H1*G71*F30*X0Y0*M14*X500Y0*M15*M0*";
        assert_eq!(feed(check(slow, |_| {}, &[])), Some(12.7));
        assert_eq!(feed(check(slow, ignore("F"), &[])), None);
    }

    #[test]
    fn equal_points_of_the_file_are_equal_to_the_bit() {
        let marker = check("G71*X3Y-0*M14*X1003Y7*X+3.0Y0*M15*M0*", |_| {}, &[]);
        assert!(marker.pieces[0].contours[0].closed);
    }

    #[test]
    fn a_closed_contour_is_never_rejoined() {
        let twice = "G71*X0Y0*M14*X900Y0*X0Y900*X0Y0*M15*M14*X-900Y0*X0Y-900*X0Y0*M15*M0*";
        assert_eq!(check(twice, |_| {}, &[]).contours().count(), 2);
    }

    #[test]
    fn an_origin_means_nothing_before_the_first_place() {
        check("H1*G71*M70*G04*X0Y0*M14*X500Y0*M15*M0*", |_| {}, &[]);
        check("H1*G71*X0Y0*M70*M14*X500Y0*M15*M0*", |_| {}, &["iso/ignored-code"]);
        check("H1*G71*G04X5Y5*X0Y0*M14*X500Y0*M15*M0*", |_| {}, &["iso/ignored-code"]);
    }

    #[test]
    fn a_bite_longer_than_the_marker_changes_nothing() {
        check("H1*G71*ZX984251*X0Y0*M14*X500Y0*M15*M0*", |_| {}, &[]);
        check("H1*G71*ZX400*X0Y0*M14*X500Y0*M15*M0*", |_| {}, &["iso/ignored-code"]);
    }
}
