//! Counts of ignored statements; each kind is reported once, with its count and first location.

use std::collections::BTreeMap;

use super::count::Count;
use super::ending::AirMoves;
use super::parameters::Surplus;
use super::plotter::Refusal;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::decimals::Decimals;
use crate::source::Span;

/// Number of junk statements that ends reading if there are more of them than of sound ones: the file is not a plot.
const MOST_JUNK: usize = 10_000;
/// Maximum number of distinct mnemonics that are counted; junk has hundreds.
const MOST_NAMES: usize = 40;
/// Maximum number of mnemonics named in a message.
const SHOWN_NAMES: usize = 8;

/// Least number of plain places of lines for each one with a separator of its own, and of plain lists of places.
const FEW_PLAIN: usize = 5;
const FEW_LISTS: usize = 3;
/// Least number of instructions for each comma before their numbers.
const FEW_COMMAS: usize = 10;

/// Least number of lists of places behind PA for each behind PR, or the other way round.
const FEW_MODES: usize = 10;

/// Counts of ignored and faulty statements.
#[derive(Debug, Default)]
pub(super) struct Tally {
    sound: usize,
    junk: Count,
    odd: Count,
    /// The last coordinate without a partner.
    pub(super) last_odd: Option<Span>,
    unknown: BTreeMap<[u8; 2], Count>,
    unknown_total: usize,
    left_out: BTreeMap<[u8; 2], (&'static str, Count)>,
    /// Numbers beyond any table.
    overflow: Count,
    /// Points beyond any table.
    too_far: Count,
    /// Moves dropped because curves exceeded the maximum number of chords.
    too_many: Count,
    /// Lines with a start that only the plotter knows.
    adrift: Count,
    /// Places that the pen touches without drawing.
    pub(super) dots: Count,
    /// Lines that depend on unreadable bytes.
    lost: Count,
    /// Encoded polylines that an editor converted to UTF-8.
    repaired: Count,
    open_labels: Count,
    /// Places in lists of which a number is missing.
    gaps: Count,
    /// Commas before the first number of a list of places.
    commas: Count,
    /// Places of lines with a blank or a plus sign.
    lone: Count,
    /// Lists of places with a blank before the first number, and number of all lists of places.
    leads: Count,
    pub(super) lists: usize,
    /// Place behind the last mnemonic of a move.
    pub(super) list_from: u32,
    /// Lists of places with a comma or a blank behind the last number.
    pub(super) ends: Count,
    pub(super) surplus: Surplus,
    /// Lists of places behind PA, and behind PR.
    pub(super) modes: [Count; 2],
    decimals: Decimals,
    /// Number of places that the pen draws to, by their numbers in the file.
    pub(super) places: usize,
    pub(super) air: AirMoves,
}

impl Tally {
    /// Counts a known instruction.
    pub(super) fn sound(&mut self) {
        self.sound += 1;
    }

    /// Counts bytes that begin no statement.
    pub(super) fn junk(&mut self, span: Span) {
        self.junk.add(span);
    }

    /// Counts a coordinate without a partner.
    pub(super) fn odd(&mut self, span: Span) {
        self.odd.add(span);
        self.last_odd = Some(span);
    }

    /// Counts a place before which a number is missing.
    pub(super) fn gap(&mut self, span: Span) {
        self.gaps.add(span);
    }

    /// Counts a comma before the first number of a list of places.
    pub(super) fn comma(&mut self, span: Span) {
        self.commas.add(span);
    }

    /// Records a place of a line that is not written as digits and a comma alone. A line break parts numbers of any program.
    pub(super) fn unusual(&mut self, text: &[u8], span: Span) {
        self.decimals.see(text, span);
        let is_separator = |byte: &u8| b" \t+".contains(byte);
        if text.contains(&b'\n') || !text.iter().any(is_separator) {
            return;
        }
        if span.start == self.list_from && !text.trim_ascii_start().iter().any(is_separator) {
            self.leads.add(span);
        } else {
            self.lone.add(span);
        }
    }

    /// Counts an unknown instruction.
    pub(super) fn unknown(&mut self, mnemonic: [u8; 2], span: Span) {
        self.unknown_total += 1;
        if self.unknown.len() < MOST_NAMES || self.unknown.contains_key(&mnemonic) {
            self.unknown.entry(mnemonic).or_default().add(span);
        }
    }

    /// Counts a known instruction that draws but is ignored; `what` describes it.
    pub(super) fn left_out(&mut self, mnemonic: [u8; 2], what: &'static str, span: Span) {
        self.left_out.entry(mnemonic).or_insert((what, Count::default())).1.add(span);
    }

    /// Counts a number beyond any table.
    pub(super) fn overflow(&mut self, span: Span) {
        self.overflow.add(span);
    }

    /// Counts a move that the plotter refuses.
    pub(super) fn refused(&mut self, refusal: Refusal, span: Span) {
        match refusal {
            Refusal::TooFar => self.too_far.add(span),
            Refusal::TooMany => self.too_many.add(span),
        }
    }

    /// Sets the count of lines with a start that only the plotter knows.
    pub(super) fn adrift(&mut self, lines: Count) {
        self.adrift = lines;
    }

    /// Sets the count of lines that depend on unreadable bytes.
    pub(super) fn lost(&mut self, lines: Count) {
        self.lost = lines;
    }

    /// Counts an encoded polyline whose bytes were restored.
    pub(super) fn repaired(&mut self, span: Span) {
        self.repaired.add(span);
    }

    /// Counts a label without a terminator.
    pub(super) fn open_label(&mut self, span: Span) {
        self.open_labels.add(span);
    }

    /// True if junk statements outnumber sound ones.
    fn is_junk(&self) -> bool {
        self.junk.count + self.unknown_total > self.sound
    }

    /// True if the file cannot be a plot, whatever follows.
    pub(super) fn is_hopeless(&self) -> bool {
        self.junk.count + self.unknown_total > MOST_JUNK && self.is_junk()
    }

    /// Reports all counts; `strokes` is the number of strokes that were drawn.
    pub(super) fn report(&self, strokes: usize, out: &mut Diagnostics) {
        if self.is_hopeless() || (self.is_junk() && strokes == 0) {
            let message = format!(
                "this is no plot: of its first {} statements {} are none",
                self.sound + self.junk.count + self.unknown_total,
                self.junk.count + self.unknown_total
            );
            let finding = Diagnostic::new(&code::HPGL_NOT_A_PLOT, message);
            out.push(finding.hint("it is of another kind, or damaged: look at its first bytes"));
            return;
        }
        let mut found = Vec::new();
        self.say_of_places(&mut found);
        found.extend(self.surplus.findings());
        let whole = self.places.saturating_sub(self.decimals.count());
        found.extend(self.lone_separator());
        found.extend(self.lone_mode());
        found.extend(self.decimals.finding(&code::HPGL_LOST, &code::HPGL_LONE_POINT, |least| whole >= least));
        found.extend(self.air.finding());
        if self.dots.count > 0 {
            let message = format!("the pen touches the paper and draws nothing {}: not drilled", self.dots.times());
            let finding = self.dots.diagnostic(&code::HPGL_DOTS, message);
            found.push(finding.hint("if they mark holes, let the CAD draw circles, and set `hpgl.drill_max_mm`"));
        }
        self.say_of_statements(&mut found);
        found.sort_by_key(|finding| finding.span);
        for finding in found {
            out.push(finding);
        }
    }

    /// Findings on coordinates and moves.
    fn say_of_places(&self, found: &mut Vec<Diagnostic>) {
        if self.overflow.count > 0 {
            let message = format!("a number is beyond any table; this happens {}", self.overflow.times());
            let finding = self.overflow.diagnostic(&code::HPGL_OVERFLOW, message);
            found.push(finding.hint("numbers end at 100 million; the file may be damaged here"));
        }
        if self.too_far.count > 0 {
            let message =
                format!("a place lies more than a kilometre from the origin; this happens {}", self.too_far.times());
            let finding = self.too_far.diagnostic(&code::HPGL_FAR_PLACE, message);
            found.push(finding.hint("a digit may be doubled; or set `hpgl.unit` in the profile if the unit is wrong"));
        }
        if self.too_many.count > 0 {
            let message = "the curves of the plot have more chords than a plot can need; no more is read from here on";
            let finding = self.too_many.diagnostic(&code::HPGL_CURVES, message.to_owned());
            found.push(finding.hint("a radius may be damaged, or the tolerance of the profile be far too fine"));
        }
        if self.lost.count > 0 {
            let message = format!("a line hangs on what cannot be read here; this happens {}", self.lost.times());
            let finding = self.lost.diagnostic(&code::HPGL_LOST, message);
            found.push(finding.hint(if self.odd.count > 0 {
                "decimal commas, exponents, or a lost character: write plain numbers, or transfer it again"
            } else {
                "transfer the file again; a character is lost, and the outline would be another one"
            }));
        }
        if self.gaps.count > 0 {
            let message = format!("a number is missing between two commas; this happens {}", self.gaps.times());
            let finding = self.gaps.diagnostic(&code::HPGL_LOST, message);
            found.push(finding.hint("transfer the file again; a digit has become a comma, or a number is lost"));
        }
        // Where many lists have such a comma, a program writes them so.
        if self.commas.count == 1 || (1..=self.sound / FEW_COMMAS).contains(&self.commas.count) {
            let message = format!("a comma stands before the first number; this happens {}", self.commas.times());
            let finding = self.commas.diagnostic(&code::HPGL_LOST, message);
            found.push(finding.hint("transfer the file again; a digit has become a comma, or a number is lost"));
        }
        if self.adrift.count > 0 {
            let message = format!(
                "a line is drawn from where a text has left the pen, which only the plotter knows; this happens {}",
                self.adrift.times()
            );
            let finding = self.adrift.diagnostic(&code::HPGL_PLACE_UNKNOWN, message);
            found.push(finding.hint("look at the picture (-t svg): it may lie beside its place"));
        }
    }

    /// The finding on places with a blank, a plus sign or a comma where nearly all have none.
    fn lone_separator(&self) -> Option<Diagnostic> {
        let few = |count: Count, all: usize, least: usize| {
            let is_few = all.saturating_sub(count.count) >= least * count.count;
            (if is_few { count.count } else { 0 }, count.first)
        };
        let of_lists = |count: Count| few(count, self.lists, FEW_LISTS);
        let counts = [few(self.lone, self.places, FEW_PLAIN), of_lists(self.leads), of_lists(self.ends)];
        let first = counts.iter().filter(|(count, _)| *count > 0).filter_map(|(_, first)| *first).min();
        let lone = Count { count: counts.iter().map(|(count, _)| count).sum(), first: Some(first?) };
        let message = format!("a blank, a comma or a plus sign is beside a number; this happens {}", lone.times());
        let finding = lone.diagnostic(&code::HPGL_LONE_SEPARATOR, message);
        Some(finding.hint("if a digit has become one, a cut leads elsewhere: see it in the picture (-t svg)"))
    }

    /// The finding on a PR among many PA, or the other way round.
    fn lone_mode(&self) -> Option<Diagnostic> {
        let [absolute, relative] = self.modes;
        let is_lone = |one: Count, other: Count| one.count > 0 && other.count >= FEW_MODES * one.count;
        let (lone, name, others, other_name) = match () {
            () if is_lone(relative, absolute) => (relative, "PR", absolute.count, "PA"),
            () if is_lone(absolute, relative) => (absolute, "PA", relative.count, "PR"),
            () => return None,
        };
        let message = format!("{name} stands before places {}, and {other_name} {others} times", lone.times());
        let finding = lone.diagnostic(&code::HPGL_LONE_MODE, message);
        Some(finding.hint("if a letter has changed, all lines behind it lie elsewhere: see the picture (-t svg)"))
    }

    /// Findings on statements: junk, damaged, unknown and ignored ones.
    fn say_of_statements(&self, found: &mut Vec<Diagnostic>) {
        if self.junk.count > 0 {
            let message = format!("what stands here is no instruction; this happens {}", self.junk.times());
            found.push(self.junk.diagnostic(&code::HPGL_JUNK, message));
        }
        if self.odd.count > 0 {
            let message = format!("a coordinate has no partner and is ignored; this happens {}", self.odd.times());
            found.push(self.odd.diagnostic(&code::HPGL_ODD, message));
        }
        if self.repaired.count > 0 {
            let message = "the file was saved again as UTF-8; its encoded polylines (PE) were repaired".to_owned();
            let finding = self.repaired.diagnostic(&code::HPGL_PE_REPAIRED, message);
            found.push(finding.hint("compare the pieces with the original; transfer such files as binary data"));
        }
        if self.open_labels.count > 0 {
            let message = format!(
                "a label has no terminator and ends with its line or at a semicolon; this happens {}",
                self.open_labels.times()
            );
            let finding = self.open_labels.diagnostic(&code::HPGL_OPEN_LABEL, message);
            found.push(finding.hint("look whether lines are missing: a text may have swallowed them"));
        }
        if let Some(first) = self.unknown.values().filter_map(|count| count.first).min() {
            let names: Vec<String> = self.unknown.keys().take(SHOWN_NAMES).copied().map(name).collect();
            let more = if self.unknown.len() > SHOWN_NAMES { " and others" } else { "" };
            let times = Count { count: self.unknown_total, first: Some(first) };
            let message = format!("{}{more}: not known and ignored; this happens {}", names.join(", "), times.times());
            found.push(times.diagnostic(&code::HPGL_UNKNOWN, message));
        }
        for (mnemonic, (what, count)) in &self.left_out {
            let message = format!("{} ({what}) is not obeyed: it stands {}", name(*mnemonic), count.times());
            found.push(count.diagnostic(&code::HPGL_LEFT_OUT, message));
        }
    }
}

fn name(mnemonic: [u8; 2]) -> String {
    String::from_utf8_lossy(&mnemonic).into_owned()
}
