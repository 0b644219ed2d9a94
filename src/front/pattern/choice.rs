//! Selection of the blocks to cut: the requested sizes, and the quantity of each piece.

use std::collections::{BTreeMap, BTreeSet};

use super::quantity::{Wanted, has_several_numbers, quantity};
use super::tally::{Tally, Thing};
use super::text::{Facts, Said};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::patterns::{Quantity, Sizes};
use crate::machine::{Job, letters::Letters};
use crate::source::{Source, Span};

/// Maximum number of sizes or pieces named in a message.
const SHOWN: usize = 24;

/// A pattern file and the job that reads it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    /// Encoding of its texts.
    pub(super) letters: Letters,
    /// Facts that apply to all blocks of the file.
    pub(super) file: Facts,
}

/// The selected sizes of a file.
#[derive(Debug)]
pub(super) struct Chosen<'a> {
    source: &'a Source,
    letters: Letters,
    /// Sizes to cut; `None` for all.
    sizes: Option<Vec<String>>,
}

/// Normalised form of a size; sizes are case-insensitive.
fn same(text: &str) -> String {
    text.trim().to_uppercase()
}

impl<'a> Chosen<'a> {
    /// Selects sizes by the job and the facts of the blocks. An error is reported if several sizes exist and none is selected.
    /// `are_apart` is true for blocks that insertions place beside each other: they are a marker and cut whatever their sizes.
    pub(super) fn of(asked: &Asked<'a>, blocks: &[Facts], are_apart: bool, out: &mut Diagnostics) -> Self {
        let Asked { source, job, letters, file } = asked;
        let text = |span: Span| letters.name(source.slice(span));
        let mut names: BTreeSet<String> = BTreeSet::new();
        let mut known: Vec<String> = Vec::new();
        for Facts { size, .. } in blocks {
            if let (Some(first), Some(other)) = (size.first.map(text), size.other) {
                let message = format!("a piece has two sizes, `{first}` and `{}`", text(other));
                let finding = Diagnostic::new(&code::DXF_SAID_TWICE, message).at(other);
                out.push(finding.hint("see in the CAD system which is right, and export the file again"));
            }
        }
        for size in blocks.iter().filter_map(|facts| facts.size.first).map(text) {
            if names.insert(same(&size)) {
                known.push(size);
            }
        }
        let has = |size: &str| names.contains(&same(size));
        let other = file.sample_size.other.map(text);
        let sample = file.sample_size.first.map(text);
        let sizes = match (&job.patterns.sizes, &sample) {
            (Some(Sizes::All), _) => None,
            (Some(Sizes::Named(names)), _) => {
                for name in names.iter().filter(|name| !has(name)) {
                    let finding = Diagnostic::new(&code::DXF_NO_SIZE, format!("the file has no size `{name}`"));
                    out.push(finding.hint(its_sizes(&known)));
                }
                Some(names.iter().map(|name| same(name)).collect())
            }
            (None, _) if are_apart && known.len() > 1 => {
                let message = format!("INSERTs place pieces of {} sizes beside each other; all are cut", known.len());
                let finding = Diagnostic::new(&code::DXF_SIZES_PLACED, message);
                out.push(finding.hint(format!("`--size` cuts some of them; {}", its_sizes(&known))));
                None
            }
            (None, Some(sample)) if other.is_none() && has(sample) => Some(vec![same(sample)]),
            (None, sample) if known.len() < 2 => {
                if let Some(sample) = sample.as_ref().filter(|_| known.is_empty() && !blocks.is_empty()) {
                    let message = format!("the sample size is `{sample}`, and no piece says a size; all are cut");
                    let finding = Diagnostic::new(&code::DXF_NO_SIZES, message);
                    let hint = "their sizes may stand under a key that is not known: `cutc manual inputs` lists those";
                    out.push(finding.hint(hint));
                }
                None
            }
            (None, sample) => {
                let message = match sample {
                    Some(sample) if let Some(other) = &other => {
                        format!("the file has several sample sizes, as `{sample}` and `{other}`")
                    }
                    Some(sample) => format!("the sample size `{sample}` is none of the sizes of the file"),
                    None => "the file has several sizes and does not say which is the sample size".to_owned(),
                };
                let finding = Diagnostic::new(&code::DXF_WHICH_SIZE, message);
                out.push(finding.hint(format!("give one with `--size`; {}", its_sizes(&known))));
                None
            }
        };
        Self { source, letters: *letters, sizes }
    }

    /// True if a block is cut. A block without a size goes with every size.
    pub(super) fn has(&self, facts: &Facts) -> bool {
        let text = |span: Span| same(&self.letters.name(self.source.slice(span)));
        match (&self.sizes, facts.size.first.map(text)) {
            (None, _) | (_, None) => true,
            (Some(sizes), Some(size)) => sizes.contains(&size),
        }
    }

    /// Reports pieces that are not cut, or cut twice, because of the sizes of their blocks.
    pub(super) fn say(&self, facts: &[Facts], out: &mut Diagnostics) {
        self.say_missing(facts, out);
        self.say_unsaid(facts, out);
    }

    /// Reports pieces that exist in none of the selected sizes.
    fn say_missing(&self, facts: &[Facts], out: &mut Diagnostics) {
        let mut pieces: BTreeMap<String, (bool, Span)> = BTreeMap::new();
        let facts = if self.sizes.is_some() { facts } else { &[] };
        for facts in facts {
            if let Some(span) = facts.name.first {
                let name = self.letters.text(self.source.slice(span)).trim().to_owned();
                pieces.entry(name).or_insert((false, span)).0 |= self.has(facts);
            }
        }
        let missing: Vec<(&String, Span)> =
            pieces.iter().filter(|(_, (is_cut, _))| !is_cut).map(|(name, &(_, span))| (name, span)).collect();
        let Some(&(_, first)) = missing.first() else { return };
        let names: Vec<&str> = missing.iter().take(SHOWN).map(|(name, _)| name.as_str()).collect();
        let (are, dots) = (
            if missing.len() == 1 { "1 piece is".to_owned() } else { format!("{} pieces are", missing.len()) },
            if missing.len() > SHOWN { ", ..." } else { "" },
        );
        let message = format!("{are} not cut, since there is none{}: {}{dots}", self.told(), names.join(", "));
        let finding = Diagnostic::new(&code::DXF_SIZE_MISSING, message).at(first);
        out.push(finding.hint("see its sizes with `cutc info --size all`, and name those that are cut with `--size`"));
    }

    /// Reports pieces that are cut twice: from a block with a size and from one without.
    fn say_unsaid(&self, facts: &[Facts], out: &mut Diagnostics) {
        let mut pieces: BTreeMap<String, [Option<Span>; 2]> = BTreeMap::new();
        for facts in facts.iter().filter(|facts| self.has(facts)) {
            if let Some(span) = facts.name.first {
                let name = self.letters.text(self.source.slice(span)).trim().to_owned();
                pieces.entry(name).or_default()[usize::from(facts.size.first.is_none())].get_or_insert(span);
            }
        }
        let twice: Vec<(&String, Span)> =
            pieces.iter().filter_map(|(name, spans)| Some((name, spans[0].and(spans[1])?))).collect();
        let Some(&(_, first)) = twice.first() else { return };
        let names: Vec<&str> = twice.iter().take(SHOWN).map(|(name, _)| name.as_str()).collect();
        let dots = if twice.len() > SHOWN { ", ..." } else { "" };
        let pieces = if twice.len() == 1 { "1 piece".to_owned() } else { format!("{} pieces", twice.len()) };
        let (told, names) = (self.told(), names.join(", "));
        let message = format!("{pieces}{told} and once more in a block without a size, both are cut: {names}{dots}");
        let finding = Diagnostic::new(&code::DXF_SIZE_UNSAID, message).at(first);
        out.push(finding.hint("see in `cutc info` which pieces they are, and leave the others out with `--skip`"));
    }

    /// Description of the selected sizes in messages; empty if all are cut.
    pub(super) fn told(&self) -> String {
        match self.sizes.as_deref() {
            None => String::new(),
            Some([size]) => format!(" of size {size}"),
            Some(sizes) => format!(" of {} sizes", sizes.len()),
        }
    }
}

fn its_sizes(known: &[String]) -> String {
    if known.is_empty() {
        return "its pieces say no size: leave `--size` out".to_owned();
    }
    let dots = if known.len() > SHOWN { ", ..." } else { "" };
    format!("its sizes are {}{dots}", known[..known.len().min(SHOWN)].join(", "))
}

impl Asked<'_> {
    /// Texts of the file that name its CAD system.
    pub(super) fn author(&self) -> String {
        let author = [self.file.author.first, self.file.author.other].into_iter().flatten();
        author.map(|span| self.letters.text(self.source.slice(span))).collect::<Vec<_>>().join(" ")
    }

    /// Quantity of a piece from its texts; `None` if the job ignores quantities or none is given.
    pub(super) fn quantity(&self, said: Said, tally: &mut Tally) -> Option<[u32; 2]> {
        let job = self.job;
        match job.patterns.quantity.unwrap_or(job.profile.dxf.quantity) {
            Quantity::File => {}
            Quantity::One => return None,
        }
        let span = said.first?;
        let read = |span: Span| quantity(&self.letters.text(self.source.slice(span)));
        let wanted = read(span);
        if let Some(other) = said.other {
            tally.add(Thing::TwoQuantities, other);
        }
        match wanted {
            None if has_several_numbers(self.source.slice(span)) => tally.add(Thing::QuantityUnclear, span),
            None => tally.add(Thing::Quantity, span),
            Some(Wanted { words, .. }) => words.into_iter().for_each(|words| tally.add(words, span)),
        }
        wanted.map(|wanted| wanted.times)
    }
}
