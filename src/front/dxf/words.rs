//! What the manual lists of pattern DXF.

use crate::front::Word;

/// The layers, entities and texts of pattern DXF, and what is done about them.
#[rustfmt::skip] // a table: a row a line
pub(super) const WORDS: &[Word] = &[
    Word { words: "layer 1; layer 11", about: "outlines and cut-outs, cut; polylines, or lines whose ends meet within 0.2 mm; an outline that does not close is refused" },
    Word { words: "layer 4; layers 80 to 83", about: "notches, as points on the outline: a slit, or a V when it has a width (group 39); T, castle, check (cut as a V) and U. Depth is group 30 whatever its sign, else `dxf.notch_mm`; the direction is group 50, else into the part. Lines on these layers are not cut, and that is told" },
    Word { words: "layer 6", about: "fold line of half a piece: outline, notches, holes, cut-outs, internal and seam lines are on both sides, and the fold is not cut. It lies within 0.2 mm along an edge of the outline, about which all is mirrored" },
    Word { words: "layer 13", about: "drill holes, as points or circles, one where both are: drill 1. Other lines there are told and not drilled" },
    Word { words: "layers 5, 7, 8, 14, 15 and all others", about: "drawn, not cut: grade references, grain lines, internal lines, seam lines (`cutc sew --line 14`), annotations" },
    Word { words: "layers 2, 3, 84 to 87", about: "turn and curve points, and copies of layers 1, 8, 11 and 14: never cut" },
    Word { words: "`POLYLINE`, `LWPOLYLINE`, `LINE`, `ARC`, `CIRCLE`, `POINT`", about: "read; bulges and arcs as chords within a quarter of the tolerance; control points of splines are passed over" },
    Word { words: "`TEXT`, `MTEXT`, `ATTDEF`, `ATTRIB`", about: "labels; never cut. What they say is read from the lines of an MTEXT, too" },
    Word { words: "`INSERT`", about: "places, mirrors and turns a block; one that scales it, puts rows and columns of it or inserts into another block what is cut there is refused; when all of them are at the origin the pieces lie in a row. A block whose name begins with `*` is a piece only where one puts it. One without its block is reported" },
    Word { words: "`SIZE:`, `SAMPLE SIZE:`", about: "the size of a block, where an attribute of its INSERT holds before a text; the size that is cut unless `--size` says otherwise, one in all of the file" },
    Word { words: "`QUANTITY:`", about: "how often a piece is cut, `1,1` = right and left, which is mirrored; an attribute of its INSERT holds before a text of its block; where INSERTs place it they say how often; `dxf.quantity` or `--quantity one` says otherwise" },
    Word { words: "`UNITS:`", about: "`METRIC` = mm, `ENGLISH` = inch; else what `$INSUNITS` of the header says, else mm, with a warning; `dxf.unit` says otherwise" },
    Word { words: "paper space (group 67)", about: "not cut, and told" },
    Word { words: "what is not shown (group 60, layers that are off or frozen)", about: "cut as all else, and told" },
    Word { words: "any other entity", about: "refused on a layer that is cut, else reported" },
];
