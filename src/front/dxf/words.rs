//! What the manual lists of pattern DXF.

use crate::front::Word;

/// The layers, entities and texts of pattern DXF, and what is done about them.
#[rustfmt::skip] // a table: a row a line
pub(super) const WORDS: &[Word] = &[
    Word { words: "layer 1; layer 11", about: "outlines and cut-outs, cut; polylines, or lines whose ends meet within 0.2 mm; an outline that does not close is refused. A line that stands off an outline with one end is a slit: the outline goes along it and back" },
    Word { words: "layer 4; layers 80 to 83", about: "notches, as points on the outline: a slit, or a V when it has a width (group 39); T, castle, check (cut as a V) and U. Depth is group 30 whatever its sign, else `dxf.notch_mm`; the direction is group 50, else into the part. Lines on these layers are not cut, and that is told" },
    Word { words: "layer 6", about: "fold line of half a piece: outline, notches, holes, cut-outs, internal and seam lines are on both sides, and the fold is not cut. It lies within 0.2 mm along an edge of the outline, about which all is mirrored" },
    Word { words: "layer 13", about: "drill holes, as points or circles, one where both are: drill 1. Other lines there are told and not drilled" },
    Word { words: "layers 5, 7, 8, 14, 15 and all others", about: "drawn, not cut: grade references, grain lines, internal lines, seam lines (`cutc sew --line 14`), annotations" },
    Word { words: "layers 84 to 87", about: "the curves of layers 1, 8, 11 and 14 in fine chords: cut or sewn in their stead where all vertices of a line lie on one of them, within 0.01 mm, and it has more. One that misses vertices is not used, with a warning, unless it is the control polygon of a line that is fine itself: it has at most half of the vertices as its own, and the chords at half of the curve points or more are within 0.2 mm of a curve" },
    Word { words: "layers 2, 3", about: "turn points and curve points: where a line has no fine one, a curve is laid through the curve points from turn point to turn point, as the CAD system does that `AUTHOR:` names: Gerber AccuMark, Richpeace or CLO, else as a natural spline, with a warning. It is straight where no curve point stands between. A size without such points has those of another size of its piece (`PIECE NAME:`). `dxf.curves` says otherwise" },
    Word { words: "`POLYLINE`, `LWPOLYLINE`, `LINE`, `ARC`, `CIRCLE`, `POINT`", about: "read; bulges and arcs as chords within a quarter of the tolerance; control points of splines are passed over" },
    Word { words: "`TEXT`, `MTEXT`, `ATTDEF`, `ATTRIB`", about: "labels; never cut. What they say is read from the lines of an MTEXT, too, and codes such as `\\U+00F6`, `\\M+5B3DF` and `%%d` stand for their letters" },
    Word { words: "`INSERT`", about: "places, mirrors and turns a block; one that scales it, puts rows and columns of it or inserts into another block what is cut there is refused; when all of them are at the origin, or most pieces would lie on each other, the pieces lie in a row. A block whose name begins with `*` is a piece only where one puts it. One without its block is reported" },
    Word { words: "`SIZE:`, `SIZE NAME:`, `SAMPLE SIZE:`", about: "the size of a block, where an attribute of its INSERT holds before a text; the size that is cut unless `--size` says otherwise, one in all of the file. Sizes that INSERTs place beside each other are all cut" },
    Word { words: "`QUANTITY:`, `QTY:`, `QUANTITY=`, `QUANTITY 2`", about: "how often a piece is cut, `1,1` = right and left, which is mirrored; an attribute of its INSERT holds before a text of its block; where INSERTs place it they say how often; `dxf.quantity` or `--quantity one` says otherwise" },
    Word { words: "`UNITS:`", about: "`METRIC` = mm, `CM` = cm, `ENGLISH` = inch; else what `$INSUNITS` of the header says, else mm, with a warning; `dxf.unit` says otherwise. A unit of the header that would make more than a kilometre of cuts is taken for mm, with a warning" },
    Word { words: "paper space (group 67)", about: "not cut, and told" },
    Word { words: "what is not shown (group 60, layers that are off or frozen)", about: "cut as all else, and told" },
    Word { words: "any other entity", about: "refused on a layer that is cut, else reported. What nothing cuts refuses nothing: an entity there that is damaged is left out, with a warning" },
];
