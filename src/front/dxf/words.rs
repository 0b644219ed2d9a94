//! Manual entries on plain DXF.

use crate::front::Word;

/// The entities of plain DXF and their effects.
#[rustfmt::skip] // a table: one row per line
pub(super) const WORDS: &[Word] = &[
    Word { words: "`LINE`, `LWPOLYLINE`, `POLYLINE`, `ARC`, `CIRCLE`, `ELLIPSE`, `SPLINE`", about: "drawn; arcs, bulges and splines as chords within a quarter of the tolerance. Splines may be rational, closed, and without control points: then the curve goes through their fit points" },
    Word { words: "`INSERT`", about: "draws its block, scaled, mirrored and turned, in rows and columns, and blocks in blocks. What stands on layer `0` of a block is on the layer of the `INSERT`. Blocks that nobody inserts are not drawn; an `INSERT` of a block that the file does not have is told" },
    Word { words: "`TEXT`, `MTEXT`, `ATTRIB`", about: "labels; never cut" },
    Word { words: "`HATCH`, `DIMENSION`, `LEADER`, `POINT`, `SOLID`, `VIEWPORT` and any other kind", about: "not cut, and told with their counts" },
    Word { words: "layers that are off or frozen, invisible entities (group 60), paper space (group 67)", about: "not cut, and told" },
    Word { words: "`$INSUNITS`", about: "the unit; without it mm, and a warning tells the size that the drawing has then. `dxf.unit` says otherwise. A unit that would make the drawing longer than 30 m is taken for mm, with a warning" },
    Word { words: "extrusion (groups 210, 220, 230)", about: "0, 0, -1 is the back: X goes to the left. Any other plane than that of the cloth is refused" },
];
