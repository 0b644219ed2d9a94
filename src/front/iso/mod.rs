//! ISO cut files: the family of codes that garment CAD writes for knife cutters.
//!
//! Receives bytes: blocks that end with `*`, with line breaks and blanks anywhere, free text after some codes, three possible
//! units. Promises a marker in mm: outlines that the file interrupts for slits and corner lifts are whole again, slits are
//! notches, equal points have equal bits, and texts are never executed. Ignored codes are reported with their count. Never
//! closes a contour that the file leaves open, and never recognises a notch by its shape: that is left to the passes.
//!
//! Arcs become chords. [`block`] splits the bytes into blocks, plain ones in [`run`]s, and passes over what [`passed`]
//! records; [`syntax`] is the grammar of a block, [`mod@meaning`] the table of codes, [`label`] the layouts of text,
//! [`trailer`] the list of labels at the end. [`lower`] executes the file, [`draft`] assembles its cuts from [`chain`]s of
//! vertices ([`vertex`]). [`lost`] finds signs of lost knife codes, [`strokes`] of lost strokes, [`alone`] of lost
//! coordinates, [`start`] of lost starts, [`misplaced`] and [`decimal`] of changed characters, [`relative`] of relative
//! coordinates. [`own`] takes the numbers of codes out of their blocks, and [`owner`] assigns slits to pieces in files
//! without piece numbers.

mod alone;
mod arc;
mod at_place;
mod block;
mod chain;
mod decimal;
mod draft;
mod kept;
mod label;
mod lost;
mod lower;
mod meaning;
mod misplaced;
mod own;
mod owner;
mod passed;
mod relative;
mod run;
mod start;
mod strokes;
mod syntax;
mod tally;
mod title;
mod trailer;
mod unit;
mod vertex;
mod words;

use self::block::Blocks;
use self::meaning::{Meaning, meaning};
use super::{Dialect, Likeness, Read};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Marker;
use crate::machine::Job;
use crate::source::Source;

pub(super) const DIALECT: Dialect = Dialect {
    name: "iso",
    about: "ISO cut file of garment CAD: blocks that end in `*`, M14/M15 for the knife",
    extensions: &["cut", "iso", "ggt", "nc"],
    sniff,
    syntax: check_syntax,
    read: Read::Marker(read),
    words: words::WORDS,
};

/// Number of blocks and of bytes examined to recognise a file.
const SNIFFED_BLOCKS: usize = 64;
const SNIFFED_BYTES: usize = 4096;
/// Number of sound blocks from which a file is recognised for certain.
const SURE_BLOCKS: usize = 3;

fn sniff(bytes: &[u8]) -> Likeness {
    let bytes = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    let mut blocks = Blocks::new(bytes);
    let (mut sound, mut all) = (0, 0);
    while all < SNIFFED_BLOCKS
        && let Some(block) = blocks.next()
        && blocks.all_ended()
    {
        all += 1;
        let known = |words: &syntax::Words| words.codes.iter().all(|&c| meaning(c) != Meaning::Unknown);
        sound += usize::from(block.words.is_ok_and(|words| known(&words)));
    }
    match sound {
        0 if memchr::memchr(b'*', bytes).is_none() => Likeness::No,
        SURE_BLOCKS.. if 2 * sound > all => Likeness::Sure,
        _ => Likeness::Maybe,
    }
}

/// Checks every block against the grammar.
fn check_syntax(source: &Source, out: &mut Diagnostics) {
    let mut blocks = Blocks::new(source.bytes());
    while let Some(block) = blocks.next() {
        let words = match block.words {
            Ok(words) => words,
            Err(fault) => {
                out.push(fault);
                continue;
            }
        };
        for &code in &words.codes {
            match meaning(code) {
                Meaning::Message => _ = blocks.next_text(),
                Meaning::Label => _ = label::read(&mut blocks, words.point),
                _ => {}
            }
        }
    }
    if !blocks.all_ended() {
        let finding = Diagnostic::new(&code::ISO_NO_FINAL_ASTERISK, "the last block has no `*`");
        out.push(finding.hint("check that the file is complete"));
    }
}

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Marker {
    lower::lower(source, job, out)
}
