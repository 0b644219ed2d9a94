//! Codes of what is drawn: recognition of plots and drawings, patterns and plain drawings as DXF, polylines as CSV.

use crate::diagnostic::kind::{Code, codes, error, warning};
use crate::diagnostic::telling::Fault::{Shape, Text};
use crate::diagnostic::telling::Harm::{Spares, Spoils};

codes! {
    // Recognition of drawings.
    /// The file is not whole.
    DRAWING_CUT_SHORT = error(Text, "drawing/cut-short", "A drawing ends amid a number or a pair of coordinates, or amid a line outside all parts that does not close: it is most likely cut short.", "The end of the file is missing, and with it the rest of an outline and perhaps more pieces. Transfer it again and compare the sizes. If only the last PU or a semicolon is missing, write it at the end.\n  PD4000,4000;PU;");
    /// A search without an end.
    DRAWING_TOO_MANY = error(Shape, "drawing/too-many-lines", "A drawing has so many closed lines that the search for which lies in which was ended: inner lines would be cut as parts.", "Nobody could tell which outline lies in which any more: inner lines would be cut as parts. Split the plot, or leave fills and hatchings out of the export.");
    /// No line is to be cut.
    DRAWING_NOTHING_TO_CUT = error(Shape, "drawing/nothing-to-cut", "A drawing was read to its end and no line of it is taken for something to cut.", "Its outlines may not close, be smaller than 25 mm, or belong to a pen that is no knife. `cutc info` says what the lines were taken for; options decide otherwise.\n  cutc compile marker.plt --cut-all");
    /// A part with several others in it.
    DRAWING_MAY_BE_FRAME = warning(Spoils, Shape, "drawing/may-be-frame", "A part holds closed lines that are not cut: it may be a frame or the edge of the table, and they the parts.", "Frames are known by their shape: rectangles around two parts or more, which fill half of them. One of another shape, nearly empty, or around a single part looks like a part with cut-outs, and only its edge would be cut. Say which it is.\n  cutc compile marker.plt --set hpgl.frame=outermost\n  cutc compile marker.plt --inner cut");
    /// Outlines with a gap that was closed.
    DRAWING_OPEN_OUTLINES = warning(Spares, Shape, "drawing/open-outlines", "Long lines of a drawing do not close and lie in no part, or stand on the edge of one from outside: they may be outlines, and are not cut.", "Only closed lines are taken for parts, and ends up to four units and 0.2 mm from each other are joined. A part whose outline has a wider gap would be missing on the table: close it in the CAD system, or cut every line.\n  cutc compile marker.plt --cut-all");
    /// Outlines with a gap.
    DRAWING_CLOSED = warning(Spares, Shape, "drawing/closed", "Outlines of a drawing stop a little before their start, or at the edge of the frame; they are closed by straight lines, and cut.", "Ends of an outline up to drawing.close_mm apart are joined by a straight line, and so are two ends on the edge of the frame, which draws the rest. Look at the places in the picture (-t svg), or close the outlines in the CAD system.\n  cutc compile marker.plt --set drawing.close_mm=0");
    /// Encoded outlines that have lost a byte.
    DRAWING_BYTE_LOST = error(Text, "drawing/byte-lost", "An encoded outline (PE) misses its start by just what one of its numbers lacks when a byte is lost, or hangs on a line that the pen should not have drawn.", "Each place of an encoded polyline hangs on the one before: a byte that is lost on the way bends all that follows, and the outline would not be cut. Transfer the file again, as binary data. A line that is right can be left out by its pen, or cut with every other line.\n  cutc compile marker.plt --cut-pens 1\n  cutc compile marker.plt --cut-all");
    /// A part with an open outline.
    DRAWING_OPEN_PART = warning(Spoils, Shape, "drawing/open-part", "Closed lines lie inside an outline that does not close: they may be its seam line or its cut-outs, and nothing of them is cut.", "An outline with a gap wider than drawing.close_mm is no part, nor are dashes or sides that do not meet, and a line inside them is never cut in its place: the part would be too small. Close the outline in the CAD system, or raise drawing.close_mm after a look at the picture (-t svg).\n  cutc compile marker.plt --set drawing.close_mm=5");
    /// A part without its seam line.
    DRAWING_NO_SEAM = warning(Spoils, Shape, "drawing/no-seam-line", "A part has no seam line inside it, though most parts of the drawing have one.", "Where every other part has its seam line, the outline of one without may be missing and its seam line cut in its place: the part would be too small. Compare the part in the picture (-t svg) with the CAD system.");
    /// A part beside open lines, or among them.
    DRAWING_MAY_BE_SEAM = error(Shape, "drawing/may-be-seam-line", "A part may be a seam line or another inner line: open lines run beside or all around it, as those of a broken outline do.", "A closed line with some of an outline around it may be the seam line, a pocket or a cut-out of a part whose outline is not whole: cut along it, the part would be too small, or missing. Close the outline in the CAD system, or leave the piece out. If those lines only guide a worker, say so once you have looked at the picture.\n  cutc compile marker.plt --skip 10\n  cutc compile marker.plt --cut-pens 1\n  cutc compile marker.plt -t svg --set drawing.beside=guide");
    /// Lines on outlines.
    DRAWING_LINE_FROM_EDGE = warning(Spares, Shape, "drawing/line-from-edge", "Open lines begin on the outline of a part, or small closed ones stand on it, and are not cut.", "A notch of another size or shape looks so, and so do a dart, a slash or a grain line, or a notch that is drawn as a closed line. Strokes of 1 to 15 mm that lead inwards are notches, and so are open strokes whose both ends lie on the outline. A line that must be cut can be cut by hand, or with every other line.\n  cutc compile marker.plt --cut-all");
    /// Lines through a part.
    DRAWING_DIVIDED_PART = warning(Spares, Shape, "drawing/divided-part", "An open line goes from the outline of a part to the same outline, longer than any notch, and is not cut: the part stays in one piece.", "A line from edge to edge divides a part in two, or it is a fold, a pleat or a stripe. Two parts that share an edge are two outlines in most plots. Look at it in the picture (-t svg); if it must be cut, let the CAD draw both parts, or cut every line.\n  cutc compile marker.plt --cut-all");
    /// Lines between the strokes of an outline.
    DRAWING_SHARED_EDGE = error(Shape, "drawing/shared-edge", "An open line leads through a part between two places where strokes of its outline meet: it may be the edge that two parts share.", "Two parts in strokes that share an edge draw it once: the lines around both are one outline, and cut so they would be one part. A fold or a hem in a part that is drawn line by line looks the same. If two parts share it, let the CAD draw each part as one closed line, or cut every line. If it is a line in one part, say that such lines stay.\n  cutc compile marker.plt --cut-all\n  cutc compile marker.plt --inner ignore");
    /// Edges of two parts that are drawn once.
    DRAWING_EDGE_OF_TWO = warning(Spoils, Shape, "drawing/edge-of-two", "Loose lines of a drawing with layers draw an edge once with an area on both its sides: each of the two areas is cut as a part.", "Programs that draw parts in lines draw an edge that two parts share once, and so they draw a fold from edge to edge in one part. Nothing tells an area between parts that is waste. Look at the picture (-t svg): leave out what is waste, say what the layer of folds is, or that lines in parts stay.\n  cutc compile parts.dxf --skip 3\n  cutc compile parts.dxf --layers FOLD=ignore\n  cutc compile parts.dxf --inner ignore");
    /// An edge of two parts of which one is lost.
    DRAWING_PART_LOST = error(Shape, "drawing/part-lost", "Loose lines of a drawing with layers draw an edge twice, for two parts, and it lies on fewer than two of the outlines that are found.", "Lines that are drawn part after part tell parts apart that touch. In another order four lines or more meet at the ends of the edge, and the outlines that are found go around both parts together. Let the CAD draw each part as one closed polyline, or its lines one after the other.");
    /// A rectangle around a few parts.
    DRAWING_FRAME = warning(Spoils, Shape, "drawing/frame", "A rectangle around a few parts is taken for the frame of the drawing, and is not cut; it may be a part with cut-outs.", "Frames are drawn around markers, to show the cloth. A rectangular part with cut-outs that fill half of it looks the same: then say that there is no frame.\n  cutc compile marker.plt --set hpgl.frame=none");
    /// A rectangle that may be a frame or a part.
    DRAWING_FRAME_OR_PART = error(Shape, "drawing/frame-or-part", "A rectangle around closed lines beside each other or in a corner, or around one with marks of a part, may be the frame of the drawing, or a part with cut-outs: nothing in the file tells.", "A frame that is taken for a part is cut, and none of the parts in it; a part that is taken for a frame is cut inside and not around. Frames are filled by parts to half at least, and little lies beside them. A cut-out is waste, with no seam line, notch or grain line in it, and no cut-out leaves a strip at two edges. Say what the rectangle is.\n  cutc compile marker.plt --set hpgl.frame=outermost\n  cutc compile marker.plt --inner ignore");
    /// A part or a drawing beyond any table.
    DRAWING_SIZE = warning(Spoils, Shape, "drawing/size", "A part of a drawing is longer than 10 m, or the drawing is longer than 100 m: a decimal point may be lost, or a digit doubled.", "No garment has such a part, and no cloth is spread so far. A place of which a decimal point is lost makes a part of hundreds of metres; a wrong unit makes all of it too large. Compare the size with the marker, and transfer the file again.\n  cutc info marker.plt");
    /// Closed lines outside the frame.
    DRAWING_OUTSIDE_FRAME = warning(Spares, Shape, "drawing/outside-frame", "Closed lines lie outside the frame of the drawing: there is no cloth, and they are not cut.", "Title blocks, test squares and large letters are drawn beside the frame of a marker, which shows the cloth. If they are parts, name their pen as a knife.\n  cutc compile marker.plt --cut-pens 1");
    /// Closed lines inside parts.
    DRAWING_INNER_LINES = warning(Spares, Shape, "drawing/inner-lines", "Closed lines lie inside parts and are no seam lines: they may be cut-outs, and are not cut unless somebody asks for it (`--inner cut`).", "A plot draws seam lines, pockets and cut-outs alike. A cut-out that is missing can be cut by hand, a pocket that was cut cannot be mended: so nothing inside a part is cut unless somebody asks for it. Seam lines stay whole with `cut`; `all` cuts them, too.\n  cutc compile marker.plt --inner cut");
    /// Circles that may be holes.
    DRAWING_HOLES = warning(Spares, Shape, "drawing/holes", "Small circles stand alone in parts; they may be holes to drill, and are not drilled as long as `hpgl.drill_max_mm` is off. Crosses never are.", "Small circles and crosses of a plot may be drill holes, letters or signs. Say up to which size circles and squares are holes.\n  cutc compile marker.plt --set hpgl.drill_max_mm=5");
    /// Too small for parts.
    DRAWING_SMALL_OUTLINES = warning(Spares, Shape, "drawing/small-outlines", "Small closed lines of a drawing lie in no part; they are not cut.", "Closed lines of 10 to 25 mm outside all parts are letters, arrows and test squares as a rule. If they are parts, name their pen as a knife.\n  cutc compile marker.plt --cut-pens 1");
    /// Lines that are drawn twice.
    DRAWING_AGAIN = warning(Spares, Shape, "drawing/drawn-again", "Lines of a drawing are drawn again, in the same places or nearly so; each is taken once.", "Some programs draw a notch or an outline twice, or a whole plot once more with another pen. A second cut in the same place frays the cloth: copies are left out, and an edge that two parts share is none. If the file holds a marker twice, export it again.");
    /// The searches for notches, letters and seam lines.
    DRAWING_SEARCH_ENDED = warning(Spares, Shape, "drawing/search-ended", "A drawing has so many lines that the search for notches, letters and seam lines was ended; some are not recognised.", "A mark that is not recognised as a notch is not cut, and a seam line may count as a cut-out. Leave texts and clutter out of the export, or split the plot.");
    /// Layers with a use by their names.
    DRAWING_LAYERS = warning(Spares, Shape, "drawing/layers", "Names of layers say which lines of a drawing are cut, as CUT, FOLD and TEXT do; where one is cut by its name, layers of which nothing is said are not.", "Layers are tools: one is the knife, others are folded, drawn or only noted. Words of six languages are known. Say it for the file, or once for all files in the profile, where a name may be a pattern.\n  cutc compile drawing.dxf --layers CUT,FOLD=pen,TEXT=ignore\n  cutc info drawing.dxf");
    /// Options for layers that are not there.
    DRAWING_NO_LAYER = error(Shape, "drawing/no-layer", "`--layers` names a layer that the drawing does not have, or is given for a plot, which has pens; or `--cut-pens` is given for a drawing with layers.", "An option that does nothing hides a slip: the layer that was meant would be cut or left out all the same. The hint names the layers that there are.\n  cutc info drawing.dxf");

    // Pattern DXF.
    /// A line that is no code.
    DXF_GROUP = error(Text, "dxf/group", "A line of a DXF file should hold the code of a group, and does not.", "DXF is pairs of lines, a code and its value. Where a line is lost or added, every value behind it would be taken for another: a coordinate for a layer. Export the file again, or transfer it as it is.");
    /// No end.
    DXF_CUT_SHORT = error(Text, "dxf/cut-short", "A DXF file does not end with EOF: it was cut short.", "The end of the file is missing, and with it perhaps the rest of an outline or whole pieces. Transfer it again and compare the sizes of both files.");
    /// A damaged number.
    DXF_NUMBER = error(Text, "dxf/number", "A coordinate, size or angle of a DXF file is not a decimal number, or a flag or count no whole one.", "A number that is guessed would be a wrong cut. Decimal commas come from the language of the computer that exported the file: set the export to decimal points.");
    /// A place without X or Y.
    DXF_NO_COORDINATE = error(Text, "dxf/no-coordinate", "An entity of a DXF file lacks a coordinate, or has more of them than one of its kind.", "A place that is taken for 0 would pull the outline across the cloth. A coordinate that stands twice is that of another entity, whose first group is lost. Lines were lost on the way: export or transfer the file again.");
    /// A place that no table reaches.
    DXF_FAR_PLACE = error(Text, "dxf/far-place", "A place of a DXF file lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.", "No table is a kilometre long, so the motion would be nonsense. Look at the number, and whether the file is really in inches.\n  cutc check pattern.dxf --set dxf.unit=mm");
    /// Curves without end.
    DXF_CURVES = error(Shape, "dxf/too-many-chords", "The curves of a DXF file have more chords than a set of patterns can need.", "Curves are read as chords within a quarter of the tolerance. So many of them come from a damaged radius, or from a tolerance far below what a knife can follow.");
    /// A unit that makes pieces of a size that no garment has.
    DXF_UNIT_DOUBTED = warning(Spoils, Shape, "dxf/unit-doubted", "The unit of a DXF file is doubtful: in that of its header ($INSUNITS) a line would be longer than 30 m, so it is taken for mm; or a piece is longer than 10 m or wider than 3.3 m both ways, or the largest of several is smaller than 100 mm.", "Some libraries write metres into the header of every file, and some systems write METRIC over patterns in cm. Compare the extent that is printed with the pieces before you cut, and say the unit.\n  cutc compile pattern.dxf --set dxf.unit=mm");
    /// A plain drawing.
    DXF_PLAIN = error(Shape, "dxf/plain", "A DXF file that is read as a set of patterns (`--from pattern`) is a plain drawing: it has no blocks of pieces, and layers of its own or outlines that share edges.", "Pattern DXF (AAMA, ASTM D6673) says by layer numbers what is cut. A plain drawing does not, so reading it by these numbers would lose some lines and cut others. Without `--from` it is read as a drawing, whose layers are tools.\n  cutc compile drawing.dxf --layers CUT,FOLD=pen");
    /// An entity that nothing cuts is damaged.
    DXF_DAMAGED = warning(Spares, Text, "dxf/damaged-drawing", "An entity of a DXF file on a layer that is not cut is damaged, and left out.", "Nothing that is cut depends on it. If its layer is to be sewn, export the file again.");
    /// Sizes side by side.
    DXF_SIZES_PLACED = warning(Spares, Shape, "dxf/sizes-placed", "INSERTs of a DXF file place pieces of several sizes beside each other, so all of them are cut.", "Sizes that lie over each other are a set of patterns, of which one is cut; beside each other they are a marker. To cut some of them name them.\n  cutc compile pattern.dxf --size M");
    /// Insertions that are no places.
    DXF_NO_PLACES = warning(Spares, Shape, "dxf/no-places", "INSERTs of a DXF file put most of its pieces on each other: they are no places, and the pieces lie in a row.", "Some CAD systems write an offset for each piece that has nothing to do with cloth. A row is good for a sample, not for a lay: let the CAD system make a marker.");
    /// Outlines outside blocks.
    DXF_AS_DRAWN = warning(Spares, Shape, "dxf/as-drawn", "Outlines of a DXF file stand in no block; they lie as they are drawn.", "A block is a piece that can be laid. Outlines outside blocks keep their places to each other, as in a marker: look at the picture (-t svg) whether they lie as the cloth is to be cut.");
    /// Pieces are cut along curves that their outlines have but at a few points.
    DXF_CURVED = warning(Spares, Shape, "dxf/curves", "Pieces of a DXF file are cut along curves, of which layer 1 holds the corners and a few points: as layers 84 to 87 draw them, or as the CAD system that wrote the file lays them.", "CAD systems write the curve of a neck or an armhole as points of it, and its course in fine chords on layer 84. Straight lines from point to point would be up to some millimetres off. The message says how far the curves leave them.\n  cutc compile pattern.dxf --set dxf.curves=points");
    /// A fine line that is not used.
    DXF_CURVE_MISSED = warning(Spoils, Shape, "dxf/curve-missed", "A fine line on layers 84 to 87 does not go through all vertices of the outline that it lies about, or a curve point (layer 3) lies on no vertex, and is not used.", "The course of a curve on layer 84 is taken where all vertices of layer 1 lie on it within 0.01 mm: then both draw one line. A curve from one vertex of layer 1 to another is taken between them. Here they do not, so that it may be the line of another size or of a seam. A curve point marks the vertex within 0.05 mm of it; one that has none bends no line, and the chords are cut there. Compare the picture with the CAD system; export the file with curve points or as a cut file.\n  cutc compile pattern.dxf -t svg");
    /// Curves by a rule that is not known to be that of the file's writer.
    DXF_CURVE_GUESSED = warning(Spoils, Shape, "dxf/curves-guessed", "Pieces of a DXF file are cut along natural splines through their curve points (layer 3), since the file has no layer 84 and does not say which CAD system wrote it.", "Each CAD system lays other curves through the same points: mostly within half a millimetre of each other, in wide spans by two or more. Export ASTM DXF with layer 84, or compare a neck and an armhole with the pattern before you cut.\n  cutc compile pattern.dxf --set dxf.curves=points");
    /// A block without its end.
    DXF_OPEN_BLOCK = error(Text, "dxf/open-block", "A block of a DXF file has no ENDBLK: lines of it may be missing.", "A block is a piece. Without its end nobody knows whether an edge, a notch or the next piece was lost. Export the file again.");
    /// A polyline without its end.
    DXF_OPEN_POLYLINE = error(Text, "dxf/open-polyline", "A polyline of a DXF file has no SEQEND: vertices of it may be missing.", "An outline that lacks vertices would be cut straight across the gap, through the piece. Export the file again, or transfer it as it is.");
    /// Something to cut that is not read.
    DXF_UNREAD_CUT = error(Text, "dxf/unread-cut", "An entity on a layer that is cut is of a kind that is not read, such as SPLINE or ELLIPSE.", "The convention for patterns has polylines, lines, points and texts alone. Leaving the entity out would leave a part of an outline uncut: let the CAD system export polylines (R12, AAMA or ASTM).");
    /// An unknown unit.
    DXF_UNIT = error(Text, "dxf/unit", "The text UNITS of a DXF file is neither METRIC, CM nor ENGLISH, or its header names a unit in which no patterns are drawn.", "Patterns that are 25.4 times too large or too small spoil the cloth. Say which unit the numbers have.\n  cutc compile pattern.dxf --set dxf.unit=mm");
    /// A text that is not read.
    DXF_TEXT = error(Text, "dxf/text", "A text of a DXF file that says a size, a quantity or the unit is in parts of more than 250 bytes, or has codes of its letters amid the value.", "A size that is lost is cut with every other one, and a unit that is lost makes all pieces too small. Let the CAD system write such texts as TEXT, one for each.");
    /// Texts that contradict each other.
    DXF_SAID_TWICE = error(Text, "dxf/said-twice", "Texts of a DXF file say two things where one can be right: two units, or of a piece two sizes or quantities.", "Which of them is meant nobody can tell, and the wrong one is another garment. See in the CAD system which is right; the unit and the quantity can be said beside the file.\n  cutc compile pattern.dxf --set dxf.unit=mm\n  cutc compile pattern.dxf --quantity one");
    /// Several sizes without a choice.
    DXF_WHICH_SIZE = error(Shape, "dxf/which-size", "A set of patterns has several sizes, and neither its sample size nor `--size` says which is cut.", "Sizes lie over each other in the file. Cutting a size that nobody asked for wastes the cloth: name one, several, or all.\n  cutc compile pattern.dxf --size M\n  cutc compile pattern.dxf --size S,M,L");
    /// A size that is not there.
    DXF_NO_SIZE = error(Shape, "dxf/no-size", "A size that `--size` asks for is not in the file.", "The sizes of a set stand in its texts, as in SIZE: M. The message lists them.\n  cutc compile pattern.dxf --size all");
    /// An outline with a gap.
    DXF_OPEN_OUTLINE = error(Shape, "dxf/open-outline", "The outline of a piece (layer 1) does not close; its lines are joined where their ends meet within 0.2 mm.", "A piece whose outline is open cannot be cut out, and a straight line across the gap may be wrong by its width. Close the outline in the CAD system.");
    /// A fold that is no edge.
    DXF_FOLD = error(Shape, "dxf/fold", "A fold line (layer 6) does not lie along exactly one straight edge of its outline, so the piece cannot be unfolded.", "A block with a fold line is half a piece. Cut as it is drawn the garment would lack the other half, and unfolded about a wrong line it would have another shape. Let the CAD system export the whole piece, or correct the line.");
    /// Too much of everything.
    DXF_TOO_MANY = error(Shape, "dxf/too-many-pieces", "A DXF file has more pieces, notches or outlines than can be told apart, or quantities beyond any order.", "Which notch is on which outline was not sought to the end, so some would not be cut. Split the file, or correct a quantity that is damaged.");
    /// No outline.
    DXF_NOTHING_TO_CUT = error(Shape, "dxf/nothing-to-cut", "A DXF file was read to its end and holds no outline on layer 1, of the sizes that are cut.", "Drawings of other CAD systems have layers of their own. Pattern DXF has outlines on layer 1, notches on 4, cut-outs on 11, drill holes on 13: export it as AAMA or ASTM DXF.");
    /// Patterns are no marker.
    DXF_SAMPLE = warning(Spares, Shape, "dxf/cutting-sample", "A set of patterns is no marker: its pieces lie in a row, which takes more cloth than a marker.", "Pattern DXF says what pieces look like, not where they lie. A row is good for a sample, not for a lay. Let the CAD system make a marker; `dxf.gap_mm` sets the room between the pieces.\n  cutc compile pattern.dxf --set dxf.gap_mm=10");
    /// No unit.
    DXF_NO_UNIT = warning(Spoils, Shape, "dxf/no-unit", "A DXF file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm.", "Patterns in inches would be 25 times too small. Compare the extent that is printed with the pieces, then say the unit.\n  cutc compile pattern.dxf --set dxf.unit=inch");
    /// A whole piece with a fold line.
    DXF_FOLD_ACROSS = warning(Spoils, Shape, "dxf/fold-across", "A piece is drawn on both sides of its fold line (layer 6), so it is taken for a whole one.", "Half pieces end at their fold line. One that goes on across it is whole already, or its line is wrong. Look at the picture (-t svg) before you cut.");
    /// Half a piece that may be cut.
    DXF_NO_FOLD_LINE = warning(Spoils, Shape, "dxf/no-fold-line", "A text of a piece in a DXF file says that it is cut on the fold, and no fold line (layer 6) shows where: the piece is cut as it is drawn.", "Patterns for paper draw half a piece beside the fold of the cloth. A cutter cuts single plies that lie flat: half a piece would be cut. Look at the picture (-t svg); if it is half, let the CAD system unfold the piece.");
    /// A piece of other sizes only.
    DXF_SIZE_MISSING = warning(Spares, Shape, "dxf/size-missing", "A piece of a set has none of the sizes that are cut, and is not cut.", "A set holds each piece in its sizes, and those of one size are a garment. A piece that is there in other sizes only would be missing: some CAD systems name sizes of accessories otherwise. Name all that are wanted.\n  cutc compile pattern.dxf --size 38,40");
    /// A block without a size beside one of a size.
    DXF_SIZE_UNSAID = warning(Spares, Shape, "dxf/size-unsaid", "A piece of a set is drawn in a size that is cut and once more in a block without a size; both are cut.", "A block without a size goes with every size. Where another block of that name has one, its size most likely stands under a key that cutc does not know, and it is another size. See in the picture (-t svg) which is right, and leave the other out.\n  cutc compile pattern.dxf --skip 2");
    /// A sample size without sizes.
    DXF_NO_SIZES = warning(Spoils, Shape, "dxf/no-sizes", "No piece of a DXF file gives its size, although the file names a sample size or several pieces share a name: all are cut.", "If the pieces are of several sizes, all of them would be cut. Their sizes may stand under a key that cutc does not know, or in letters that it does not read: see in the picture (-t svg) whether pieces come again in other sizes.");
    /// A key that may be the quantity.
    DXF_KEY = warning(Spares, Text, "dxf/unknown-key", "Every piece of a DXF file has a small number under a key that cutc does not know, and no quantity; each is cut once.", "The number may say how often the piece is cut: then pieces would be missing. Compare the count of `cutc info` with the garment, and let the CAD system write QUANTITY.\n  QUANTITY: 2");
    /// Texts in an unknown encoding.
    DXF_LETTERS = warning(Spares, Text, "dxf/letters", "Texts of a DXF file are in an encoding that neither its header nor the profile gives; they are read in the one in which the most keys are found.", "Sizes and quantities stand behind keys in the language of the CAD system. The header ($DWGCODEPAGE) should name their encoding; where it does not, or names another one, the profile can.\n  cutc compile pattern.dxf --set labels.encoding=windows-1251");
    /// Texts that cannot be read.
    DXF_LETTERS_LOST = warning(Spoils, Text, "dxf/unread-key", "Texts of a DXF file have bytes before their colon or number that are no letters in the encoding in which the file is read.", "A size, a sample size or a quantity may stand there: then all sizes would be cut, or too few pieces. Compare the count of `cutc info` with the garment, and say the encoding.\n  cutc compile pattern.dxf --set labels.encoding=big5");
    /// A notch that is not cut.
    DXF_NOTCH_LEFT_OUT = warning(Spares, Shape, "dxf/notch-left-out", "A notch of a DXF file is not cut: it lies off the outline, is deeper than 15 mm or than its part is there, or lies in another one or at its place.", "A cut into a part that is wrong cannot be mended, and a notch that is missing can. Notches on seam lines mark where parts meet and are not for the knife. See in the picture (-t svg) which are missing.");
    /// A notch that is drawn in its outline and marked by a point.
    DXF_NOTCH_DRAWN = warning(Spares, Shape, "dxf/notch-drawn", "Points of notches in a DXF file lie at notches that the outline already has; each is cut once, as drawn.", "Some programs write a notch as a stretch of the outline and mark it by a point on layer 4 as well. A second notch at the same place would go deeper into the part.");
    /// A notch whose angle leads out of the part.
    DXF_NOTCH_TURNED = warning(Spares, Shape, "dxf/notch-turned", "The angles (group 50) of notches in a DXF file lead out of their pieces; the notches are cut inwards.", "Some programs write the angle of a notch as it is seen from outside. A notch that stands out of the edge of a part cannot be cut into it: let the CAD system draw it in the outline.");
    /// A notch that becomes a slit.
    DXF_NOTCH_AS_SLIT = warning(Spares, Shape, "dxf/notch-as-slit", "A V, T, castle, check or U notch of a DXF file is cut as a slit: it is narrower than 1 mm, wider than 12 mm or flatter than 1.5 mm, or stands at a corner or beside another.", "Its mouth would take in a corner or another notch and change the outline, or its crossbar would leave the part. A slit of the same depth marks the same place.");
    /// Something to cut outside.
    DXF_OUTSIDE = warning(Spoils, Shape, "dxf/outside", "A cut-out or a hole of a DXF file lies outside of its outline; it is cut all the same.", "Its layer says that it is cut, but no piece is there: it may lie in a neighbour on the cloth, or belong to an outline that is missing. Look at the picture (-t svg) before you cut.");
    /// A cut-out that may be no cut-out.
    DXF_LARGE_CUT_OUT = warning(Spoils, Shape, "dxf/large-cut-out", "On layer 1 of a DXF file an outline lies in another one and takes more than half of it; it is cut as a cut-out.", "A piece with such a hole is a frame. More often the outline is drawn twice, a little apart, or the seam line lies on layer 1 with it. Look at the picture (-t svg) before you cut.");
    /// Layers that may be exchanged.
    DXF_SEAM_OUTSIDE = warning(Spoils, Shape, "dxf/seam-outside", "A seam line of a DXF file (layer 14) goes round its outline (layer 1).", "The knife follows layer 1. If that has the seam and layer 14 the edge, the parts are cut without their seam allowance. Compare the extent that `cutc info` prints with the pieces, and let the CAD system export layer 1 as the line of the knife.");
    /// A block without an outline.
    DXF_NO_OUTLINE = warning(Spares, Shape, "dxf/no-outline", "A block of a DXF file has something to cut, or the name or quantity of a piece, but no outline on layer 1; nothing of it is cut.", "Its outline may be on another layer, or was not exported. Count the pieces with `cutc info`.");
    /// A line on a layer of points.
    DXF_STROKE = warning(Spoils, Shape, "dxf/line-not-cut", "A line of a DXF file lies on a layer of notches (4, 80 to 83), of drill holes (13) or of turn and curve points (2, 3), and is not cut.", "The convention has notches and holes as points, which say their depth, width and direction. A notch that is drawn as a line, or a hole as a cross, would be missing in the cut part. Let the CAD system export points, or draw the line on layer 11 if the knife is to follow it.");
    /// A quantity that cannot be read.
    DXF_QUANTITY = warning(Spares, Text, "dxf/quantity", "The quantity of a piece is 0 or cannot be read, and the piece is cut once; or it counts pairs; or it has words behind its number, which holds.", "Some systems write 0 where nobody said how often. A quantity is how often the piece is cut as it is drawn, and behind a comma how often mirrored.\n  QUANTITY: 1,1");
    /// Two counts of a piece.
    DXF_PLACED_QUANTITY = warning(Spares, Shape, "dxf/placed-quantity", "A piece of a DXF file is placed by INSERTs, and not as often as its quantity says.", "A file that puts its pieces somewhere is a marker, and each INSERT in it is one piece. The quantity of a pattern is then another count of the same: compare both before the cloth is spread.");
    /// An insertion of nothing.
    DXF_NO_BLOCK = warning(Spares, Text, "dxf/no-block", "An INSERT of a DXF file names a block that the file does not hold.", "Some systems leave the names of pieces that were deleted. If a piece is missing, export the file again.");
    /// An insertion that scales.
    DXF_SCALE = error(Shape, "dxf/scale", "An INSERT of a DXF file changes the size of a piece.", "Pieces have the size in which their blocks are drawn: one that is scaled, perhaps in one direction only, does not fit the others. If the scale stands for another unit, say that instead.\n  cutc compile pattern.dxf --set dxf.unit=inch");
    /// Copies in rows and columns.
    DXF_ARRAY = error(Shape, "dxf/array", "An INSERT of a DXF file puts copies in rows or columns (groups 70 and 71).", "Sets of patterns place each piece by an INSERT of its own. Read without its rows and columns the INSERT would stand for one piece where many are wanted: let the CAD system explode it.");
    /// A block in a block.
    DXF_NESTED = error(Shape, "dxf/nested-block", "A block of a DXF file inserts another block that holds something to cut.", "A piece is drawn in one block. What another block holds, perhaps a cut-out or a notch, would be missing in the cut part: let the CAD system explode the INSERTs that stand inside blocks.");
    /// A piece far from the others.
    DXF_FAR_PIECE = warning(Spares, Shape, "dxf/far-piece", "A piece of a DXF file lies more than 20 m from the others.", "No marker leaves so much cloth empty: a digit of the place of its INSERT is doubled or wrong, or it was drawn aside by mistake. Put it beside the others in the CAD system, or leave it out.\n  cutc compile patterns.dxf --skip 3");
    /// Two pieces at one place.
    DXF_ON_ANOTHER = error(Shape, "dxf/on-another", "INSERTs of a DXF file put a piece on another one.", "One cloth cannot be both: the second cut would go through the first part. A set of patterns, whose pieces are drawn over each other, has no INSERTs or has them all at the origin, and is laid in a row. A marker needs a place for each piece.");
    /// Another plane than the cloth.
    DXF_EXTRUSION = error(Shape, "dxf/extrusion", "An entity of a DXF file that is cut is drawn on another plane than the cloth (groups 210, 220, 230 are not 0, 0, 1).", "Copies that are mirrored in space have their coordinates on the back of the drawing: read as they stand they would be cut mirrored or slanted. Flatten the drawing in the CAD system and export it again.");
    /// A piece that is nowhere.
    DXF_NOT_PLACED = warning(Spares, Shape, "dxf/not-placed", "A DXF file places some pieces by INSERT, and others not; those are not cut.", "A file that puts its pieces somewhere is a marker, and what it does not place is not in it. Count the pieces with `cutc info`.");
    /// The sheet around the drawing.
    DXF_ON_PAPER = warning(Spares, Text, "dxf/paper-space", "Entities of a DXF file stand in paper space (group 67 is 1) and are not cut.", "Paper space is the sheet on which a drawing is shown, with its frame and titles. If a piece is missing, it was drawn there: move it to model space.");
    /// Entities that are cut and not shown.
    DXF_HIDDEN = warning(Spoils, Shape, "dxf/hidden", "Entities of a DXF file on layers that are cut are not shown in the CAD system (group 60 is 1, or their layer is off or frozen); they are cut all the same.", "Somebody who looks at the drawing does not see these cuts. Show all layers, delete what is not meant, and export the file again; or look at the picture (-t svg).");
    /// Layers that the convention does not have.
    DXF_OTHER_LAYERS = warning(Spares, Text, "dxf/other-layers", "Points of a pattern are on layers that the convention does not have, or lines or points on none; they are not cut.", "AAMA and ASTM D6673 number the layers: 1 = outlines, 4 and 80 to 83 = notches, 13 = drill holes, and so on. A notch whose layer was lost or has another number is no notch. The message names the layers; look for what is missing in the picture (-t svg).");
    /// Kinds that are not read.
    DXF_UNREAD = warning(Spares, Text, "dxf/unread", "Entities of a DXF file are of kinds that are not read; none of them is on a layer that is cut.", "Dimensions, hatchings and splines of other layers are drawn and not cut. If a line is missing in the picture (-t svg), this is where to look.");

    // Plain DXF drawings.
    /// Kinds that draw no lines.
    DXF_NO_LINES = warning(Spares, Text, "dxf/no-lines", "Entities of a plain DXF drawing are of kinds that are no lines, as HATCH, DIMENSION and POINT, and are not cut.", "Dimensions, hatchings and leaders are drawn about parts and are no parts. If a line is missing in the picture (-t svg), this is where to look: explode the entity into lines in the CAD system.\n  cutc compile drawing.dxf -t svg");
    /// Layers that are off or frozen.
    DXF_NOT_SHOWN = warning(Spares, Shape, "dxf/not-shown", "Entities of a plain DXF drawing are hidden in the CAD system (group 60 is 1, or their layer is off or frozen), and are not cut.", "A layer that somebody has switched off is mostly one that is not meant. Show it and export the drawing again if it is to be cut.");
    /// A spline whose numbers make none.
    DXF_SPLINE = error(Text, "dxf/spline", "The numbers of a SPLINE of a plain DXF drawing make no curve: its knots, weights or control points do not fit together.", "A curve that nobody can draw would be missing in the part. Let the CAD system export it as a polyline, or export the file again.");
    /// A block that holds itself.
    DXF_RECURSION = error(Shape, "dxf/recursive-block", "Blocks of a plain DXF drawing insert each other more than 32 deep: one of them may hold itself.", "A block that holds itself has no end, and a file with one is damaged or was made to do harm. Explode its insertions in the CAD system, and export the drawing again.\n  cutc check drawing.dxf");
    /// More than can be drawn.
    DXF_TOO_LARGE = error(Shape, "dxf/too-large", "A plain DXF drawing draws more than four million places, or has more than a hundred thousand insertions.", "No marker has so many: a damaged number, or blocks that insert each other many times, make them. Look at radii and at counts of columns and rows.");

    // CSV polylines.
    /// The header is missing.
    CSV_HEADER = error(Text, "csv/header", "The first row must be `x_mm,y_mm`.", "The header tells a list of points from any other table, and says that the unit is mm. Write it above the rows.\n  x_mm,y_mm\n  0,0\n  100,0");
    /// A row that is not two numbers.
    CSV_ROW = error(Text, "csv/row", "A row must hold two finite decimal numbers, separated by a comma.", "A row that is guessed would be a wrong cut. Use a point for decimals and a comma between the two numbers, without units.\n  12.5,-3");
    /// A contour of one point.
    CSV_NO_LENGTH = error(Shape, "csv/no-length", "A contour must have two different points at least; a blank line ends a contour.", "One point is nowhere to cut along, and points that are equal count as one. Remove it, or look for a blank line too many: it ends a contour.");
    /// No contour.
    CSV_NOTHING_TO_CUT = error(Shape, "csv/nothing-to-cut", "The file holds a header and no contour.", "The export wrote a header and then stopped, or everything was on a layer that it leaves out. Look at the drawing, and export the points again.");
}
