//! Ignored codes, each reported once, with its count and first block.

use std::collections::BTreeMap;

use super::meaning::{Meaning, kind, meaning, name};
use super::syntax::Code;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Counts of ignored codes.
#[derive(Debug, Default)]
pub(super) struct Tally {
    /// Entries by letter and by the bits of the number.
    codes: BTreeMap<(u8, Option<u64>), Entry>,
}

#[derive(Debug)]
struct Entry {
    code: Code,
    /// Description; `None` for an unknown code.
    what: Option<&'static str>,
    first: Span,
    count: usize,
}

impl Tally {
    /// Counts a known code that changes the cut but is ignored; `what` describes it.
    pub(super) fn ignore(&mut self, code: Code, what: &'static str, span: Span) {
        self.add(code, Some(what), span);
    }

    /// Counts an unknown code.
    pub(super) fn unknown(&mut self, code: Code, span: Span) {
        self.add(code, None, span);
    }

    fn add(&mut self, code: Code, what: Option<&'static str>, first: Span) {
        let code = kind(code);
        let key = (code.letter, code.number.map(f64::to_bits));
        self.codes.entry(key).or_insert(Entry { code, what, first, count: 0 }).count += 1;
    }

    /// Reports the codes in the order of the file.
    pub(super) fn report(self, out: &mut Diagnostics) {
        let mut entries: Vec<Entry> = self.codes.into_values().collect();
        entries.sort_by_key(|entry| entry.first);
        for Entry { code, what, first, count } in entries {
            let name = name(code);
            let times = if count == 1 { "once".to_owned() } else { format!("{count} times") };
            let first_block = first.block;
            out.push(match what {
                Some(what) => {
                    let message =
                        format!("{name} ({what}) is not obeyed: it stands {times}, first in block {first_block}");
                    let mut finding = Diagnostic::new(&code::ISO_IGNORED_CODE, message).at(first);
                    if meaning(code) == Meaning::End {
                        finding = finding.hint("two jobs may stand in one file, and both are cut: split it to cut one");
                    }
                    finding.hint(format!("`codes.{name} = \"ignore\"` in the profile silences this"))
                }
                None => unknown(code, &format!("it stands {times}, first in block {first_block}")).at(first),
            });
        }
    }
}

/// The finding on an unknown code, with its count.
fn unknown(code: Code, count: &str) -> Diagnostic {
    let message = format!("{} is not known and was ignored: {count}", name(code));
    let finding = Diagnostic::new(&code::ISO_UNKNOWN_CODE, message);
    if code.number.is_some() && meaning(Code { number: None, ..code }) != Meaning::Unknown {
        let letter = char::from(code.letter);
        return finding.hint(format!("`{letter}` is known without a number only: see `cutc explain {letter}`"));
    }
    finding.hint("if the cutter obeys it, see in its manual whether the pieces need it")
}
