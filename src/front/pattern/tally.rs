//! Deviations from the file; each kind is reported once, with its count and first location.

use std::collections::BTreeMap;

use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::source::Span;

/// A kind of deviation, apart from unsupported entities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Thing {
    /// A cut-out or a hole lies outside all outlines.
    Outside,
    /// A block has cuts but no outline.
    NoOutline,
    /// A line is on a layer where only points define notches, or holes.
    StrokeOfNotch,
    StrokeOfHole,
    /// A line is on a layer where only points define the course of outlines.
    StrokeOfPoints,
    /// A quantity is zero or malformed.
    Quantity,
    /// A quantity has several numbers in another form than right and left.
    QuantityUnclear,
    /// A quantity counts pairs.
    QuantityPairs,
    /// The number of a quantity is followed by words.
    QuantityWords,
    /// Texts of a piece give different quantities.
    TwoQuantities,
    /// A quantity differs from the number of insertions of its piece.
    Placed,
    /// An insertion names a missing block.
    NoBlock,
    /// A block inserts another one that has cuts.
    Nested,
    /// An insertion scales a block.
    Scaled,
    /// A block has no insertion while others have.
    NotPlaced,
    /// A block without a name of its own has cuts but no insertion.
    Unnamed,
    /// A piece is placed on another one.
    OnAnother,
    /// An outline inside another one takes up most of it.
    LargeCutOut,
    /// Outlines inside each other, each of which takes up most of the one around it.
    Graded,
    /// A seam line encloses its outline.
    SeamOutside,
    /// A piece is drawn on both sides of its fold line.
    FoldAcross,
    /// A text marks a piece as cut on the fold, but there is no fold line.
    NoFoldLine,
}

/// Counts of deviations.
#[derive(Debug, Default)]
pub(super) struct Tally(BTreeMap<Thing, (usize, Span)>);

impl Tally {
    /// Counts a deviation.
    pub(super) fn add(&mut self, thing: Thing, span: Span) {
        self.0.entry(thing).or_insert((0, span)).0 += 1;
    }

    /// Reports all deviations.
    pub(super) fn report(&self, out: &mut Diagnostics) {
        for (&thing, &(count, span)) in &self.0 {
            let Row { code, one, many, hint } = row(thing);
            let message = if count == 1 { one.to_owned() } else { format!("{count} {many}, the first here") };
            out.push(Diagnostic::new(code, message).at(span).hint(hint));
        }
    }
}

/// Wording of a deviation.
struct Row {
    code: &'static Code,
    one: &'static str,
    many: &'static str,
    hint: &'static str,
}

#[rustfmt::skip] // a table: one row per deviation; a test compares its numbers with those of the reader
fn row(thing: Thing) -> Row {
    match thing {
        Thing::Outside => Row { code: &code::DXF_OUTSIDE, one: "a cut-out or a hole lies outside of its outline, and is cut all the same", many: "cut-outs or holes lie outside of their outlines, and are cut all the same", hint: "see in the picture (-t svg) where the knife goes" },
        Thing::NoOutline => Row { code: &code::DXF_NO_OUTLINE, one: "what has no outline on layer 1 asks for cuts; nothing of it is cut", many: "blocks without an outline on layer 1 ask for cuts; nothing of them is cut", hint: "count the pieces with `cutc info`" },
        Thing::StrokeOfNotch => Row { code: &code::DXF_STROKE, one: "a line on a layer of notches (4, 80 to 83) is not cut", many: "lines on layers of notches (4, 80 to 83) are not cut", hint: "let the CAD system export notches as points, or draw them into the outline" },
        Thing::StrokeOfHole => Row { code: &code::DXF_STROKE, one: "a line on the layer of drill holes (13) is not drilled", many: "lines on the layer of drill holes (13) are not drilled", hint: "let the CAD system export holes as points" },
        Thing::StrokeOfPoints => Row { code: &code::DXF_STROKE, one: "a line on layer 2 or 3 is not cut", many: "lines on layers 2, 3 are not cut", hint: "they hold points; draw what is to be cut on layer 1, or on 11 if it lies inside" },
        Thing::Quantity => Row { code: &code::DXF_QUANTITY, one: "a quantity is 0 or cannot be read; the piece is cut once", many: "quantities are 0 or cannot be read; these pieces are cut once", hint: "it is written as `QUANTITY: 1` or, right and left, as `QUANTITY: 1,1`" },
        Thing::QuantityUnclear => Row { code: &code::DXF_QUANTITY_UNCLEAR, one: "a quantity has several numbers: are they right and left?", many: "quantities have several numbers: are they right and left?", hint: "one right and one left are `QUANTITY: 1,1`; `--quantity one` cuts each piece once" },
        Thing::QuantityPairs => Row { code: &code::DXF_QUANTITY, one: "a quantity counts pairs: each is a right piece and a mirrored left one", many: "quantities count pairs: each is a right piece and a mirrored left one", hint: "if none is to be mirrored write the number of pieces without the word" },
        Thing::QuantityWords => Row { code: &code::DXF_QUANTITY, one: "words stand behind the number of a quantity, which holds", many: "quantities have words behind their number, which holds", hint: "none is mirrored: right and left are `QUANTITY: 1,1`" },
        Thing::TwoQuantities => Row { code: &code::DXF_SAID_TWICE, one: "a piece has two quantities, the other one here", many: "pieces have two quantities, another one", hint: "see which is right; `--quantity one` cuts each piece once" },
        Thing::Placed => Row { code: &code::DXF_PLACED_QUANTITY, one: "INSERTs place a piece more or less often than its quantity says; they hold", many: "pieces are placed more or less often than their quantities say; the INSERTs hold", hint: "count the pieces with `cutc info`" },
        Thing::NoBlock => Row { code: &code::DXF_NO_BLOCK, one: "an INSERT names a block that the file does not hold", many: "INSERTs name blocks that the file does not hold", hint: "a piece may be missing: count them with `cutc info`" },
        Thing::Nested => Row { code: &code::DXF_NESTED, one: "an INSERT in a block puts another block there that is cut", many: "INSERTs in blocks put other blocks there that are cut", hint: "explode it in the CAD system, so that each piece is drawn in one block" },
        Thing::Scaled => Row { code: &code::DXF_SCALE, one: "an INSERT scales a piece", many: "INSERTs scale pieces", hint: "`dxf.unit` says another unit, `--from dxf` that it is a plain drawing" },
        Thing::NotPlaced => Row { code: &code::DXF_NOT_PLACED, one: "a piece is placed by no INSERT while others are, and is not cut", many: "pieces are placed by no INSERT while others are, and are not cut", hint: "count the pieces with `cutc info`" },
        Thing::Unnamed => Row { code: &code::DXF_NOT_PLACED, one: "a block whose name begins with `*` draws on layers that are cut, no INSERT places it, and it is not cut", many: "blocks whose names begin with `*` draw on layers that are cut, no INSERT places them, and they are not cut", hint: "CAD systems have such blocks for dimensions and groups; count the pieces with `cutc info`" },
        Thing::OnAnother => Row { code: &code::DXF_ON_ANOTHER, one: "an INSERT puts this piece on another one", many: "pieces are put on others by INSERTs", hint: "in a marker give each piece a free place; in a set of patterns delete the INSERTs" },
        Thing::LargeCutOut => Row { code: &code::DXF_LARGE_CUT_OUT, one: "an outline lies in another one and takes more than half of it; it is cut as a cut-out", many: "outlines lie in others and take more than half of them; they are cut as cut-outs", hint: "see in the picture (-t svg) whether the same outline is drawn twice, or its seam line with it" },
        Thing::Graded => Row { code: &code::DXF_GRADED, one: "outlines lie in each other, three or more: sizes of one piece?", many: "blocks have outlines in each other: sizes of one piece?", hint: "let the CAD system export each size as a block of its own" },
        Thing::SeamOutside => Row { code: &code::DXF_SEAM_OUTSIDE, one: "a seam line (layer 14) goes round its outline (layer 1)", many: "seam lines (layer 14) go round their outlines (layer 1)", hint: "the layers may be exchanged: compare the extent with the piece with its seam allowance" },
        Thing::FoldAcross => Row { code: &code::DXF_FOLD_ACROSS, one: "a piece is drawn on both sides of its fold line (layer 6); it is cut as it is drawn", many: "pieces are drawn on both sides of their fold lines (layer 6); they are cut as they are drawn", hint: "look at the picture (-t svg): both halves must be there" },
        Thing::NoFoldLine => Row { code: &code::DXF_NO_FOLD_LINE, one: "a piece is marked as cut on the fold but has no fold line (layer 6); it is cut as drawn", many: "pieces to cut on the fold have no fold line (layer 6); they are cut as drawn", hint: "if half a piece is drawn, let the CAD unfold it or draw its fold line on layer 6" },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::pattern::drawn::LEAST_DEPTH;
    use crate::front::pattern::notch::MOUTHS;
    use crate::front::pattern::words::WORDS;
    use crate::ir::marker::Notch;
    use crate::machine::patterns::Dxf;

    /// The numbers in the sentences are plain text; each must be the value in use.
    #[test]
    fn what_is_told_of_measures_is_what_they_are() {
        let mm = |value: f64| format!("{value} mm");
        let says = |text: &str, value: f64| assert!(text.contains(&mm(value)), "{} in: {text}", mm(value));
        says(code::DXF_NOTCH_LEFT_OUT.about, Notch::LONGEST);
        let [least, most] = MOUTHS;
        for value in [least, most, LEAST_DEPTH] {
            says(code::DXF_NOTCH_AS_SLIT.about, value);
        }
        says(code::DXF_OPEN_OUTLINE.about, Dxf::ENDS_MEET);
        says(WORDS[0].about, Dxf::ENDS_MEET);
        assert!(WORDS.iter().any(|word| word.about.contains("a quarter of the tolerance")) && Dxf::CHORDS_OFF == 0.25);
    }
}
