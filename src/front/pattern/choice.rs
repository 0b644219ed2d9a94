//! Selection of the blocks to cut: the requested sizes, and the quantity of each piece.

use std::collections::{BTreeMap, BTreeSet};

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

/// Words that may follow a quantity, in capitals: words for pieces, and names of materials.
#[rustfmt::skip] // a table: a few languages per row
const OF_PIECES: [&str; 51] = [
    "X", "×", "PC", "PCS", "PIECE", "PIECES", "ST", "STK", "STCK", "STÜCK", "STUECK", "PIÈCE", "PIÈCES",
    "PZ", "PEZZO", "PEZZI", "PIEZA", "PIEZAS", "PEÇA", "PEÇAS", "STUKS", "SZT", "SZTUK", "SZTUKI", "KS", "DB", "BUC",
    "ADET", "ШТ", "ШТУК", "ШТУКИ", "ДЕТ", "片", "件", "枚", "张", "張", "个", "個", "장", "매", "STYCK",
    "SELF", "MAIN", "SHELL", "LINING", "FABRIC", "CONTRAST", "INTERFACING", "ON FOLD",
    "ON THE FOLD",
];

/// Words for a pair of a right and a left piece, in capitals.
const PAIRS: [&str; 12] =
    ["PAIR", "PAIRS", "PR", "PRS", "PAAR", "PAARE", "PAIRE", "PAIRES", "PAIO", "PAIA", "PAR", "PARES"];

/// Quantity of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Wanted {
    /// Number of copies as drawn, and mirrored: `1,1` is one right and one left piece.
    pub(super) times: [u32; 2],
    /// Finding on words after the number.
    words: Option<Thing>,
}

/// Parses a quantity. `None` if the text is malformed or the quantity is zero.
pub(super) fn quantity(text: &str) -> Option<Wanted> {
    // Some systems write whole numbers with decimals.
    let whole = |number: &str| number.trim_end_matches('0').strip_suffix('.').unwrap_or(number).parse::<u32>().ok();
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| whole(number.trim())).collect();
    let times = match numbers.as_deref() {
        None => return worded(text),
        Some(&[right]) => [right, 0],
        Some(&[right, left]) => [right, left],
        Some(_) => return None,
    };
    (times != [0, 0]).then_some(Wanted { times, words: None })
}

/// Parses a number at the start of a text, followed by a word for pieces or pairs, or by a remark in parentheses.
fn worded(text: &str) -> Option<Wanted> {
    let text = text.trim();
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, behind) = text.split_at(digits);
    let (word, aside) = match behind.split_once('(') {
        None => (behind, None),
        Some((word, aside)) => (word, Some(aside.strip_suffix(')')?)),
    };
    let word = word.trim().trim_end_matches('.').to_uppercase();
    let is_aside = aside.is_some_and(|aside| !aside.contains(['(', ')']));
    let is_pair = PAIRS.contains(&word.as_str());
    let is_known = is_pair || OF_PIECES.contains(&word.as_str());
    let is_clear = if word.is_empty() { is_aside } else { is_known && aside.is_none_or(|_| is_aside) };
    let number = number.parse().ok().filter(|&number| is_clear && number > 0)?;
    Some(if is_pair {
        Wanted { times: [number, number], words: Some(Thing::QuantityPairs) }
    } else {
        Wanted { times: [number, 0], words: Some(Thing::QuantityWords) }
    })
}

/// True if a text has two numbers or more, which may be those of right and left pieces.
fn has_several_numbers(text: &[u8]) -> bool {
    let is_of_number = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    text.chunk_by(|a, b| is_of_number(a) == is_of_number(b)).filter(|run| run[0].is_ascii_digit()).count() > 1
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
        // `2` and `2 ON FOLD` say the same.
        let is_other = |wanted: Wanted, span: Span| read(span).is_none_or(|other| other.times != wanted.times);
        if let Some(other) = said.other.filter(|&other| wanted.is_none_or(|wanted| is_other(wanted, other))) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantity_is_right_and_left() {
        let times = |text: &str| quantity(text).map(|wanted| wanted.times);
        let check = |text: &str, expected: Option<[u32; 2]>| assert_eq!(times(text), expected, "{text}");
        check("1,1", Some([1, 1]));
        check("2", Some([2, 0]));
        check("2.0", Some([2, 0]));
        check("20", Some([20, 0]));
        check("1.5", None);
        check(" 0 , 1 ", Some([0, 1]));
        check("0", None);
        check("1,", None);
        check("1,1,1", None);
        check("-1", None);
        check("two", None);
        for text in ["2x", "2 Stück", "2 Stk.", "2 (1 PAIR)", "2 pcs (left and right)", "2片", "2 SELF", "2 Lining"] {
            check(text, Some([2, 0]));
        }
        for text in ["2 PAIRS", "2 Paar", "2 pairs (left and right)", "2prs."] {
            check(text, Some([2, 2]));
        }
        for text in ["1L 1R", "0 PAIRS", "PAIR", "1+1", "1/1", "1 (R), 1 (L)", "2 x SELF", "x", "2 ", "()", "2 ()("] {
            check(text, times("2").filter(|_| text == "2 "));
        }
        for text in ["1;1", "L1 R1", "1+1", "1 L + 1 R", "1,1,1", "1 / 1.0"] {
            assert!(times(text).is_none() && has_several_numbers(text.as_bytes()), "{text}");
        }
        for text in ["0", "1.5", "two", "x2", "", "1 L"] {
            assert!(!has_several_numbers(text.as_bytes()), "{text}");
        }
    }
}
