//! Every code that a diagnostic can carry: a stable name, its severity, and what it means.
//! The first word is the stage. Names never change once released: scripts filter by them.

pub use super::kind::Code;
use super::kind::{codes, error, warning};
pub use super::telling::{Fault, Harm, Severity, Telling};
use Fault::{Shape, Text};
use Harm::{Spares, Spoils};

codes! {
    // The source as a whole.
    /// Nothing in the file.
    SOURCE_EMPTY = error(Text, "source/empty", "The file holds no bytes, or only blanks.", "Nothing arrived: an export was cancelled, or the copy to the cutter failed. Export the marker again and compare the sizes of the files.");
    /// More bytes than spans can address.
    SOURCE_TOO_LARGE = error(Text, "source/too-large", "The file has 4 GiB or more; split the marker.", "Places in a file are kept as 32-bit numbers. No marker needs this much: most likely it is another file. Split a real one by pieces in the CAD system.");
    /// No dialect recognises the content.
    SOURCE_UNKNOWN = error(Text, "source/unknown-format", "The content is none of the dialects that cutc reads; the message names what it looks like.", "Cutting from a guess could ruin a lay. Export an ISO cut file, or name the dialect if the file has an unusual head.\n  cutc check odd.txt --from iso");
    /// Options for plots, and no plot.
    SOURCE_NO_PLOT = warning(Spares, Shape, "source/no-plot", "`--cut-pens`, `--inner` or `--cut-all` is given for a file that is no drawing; they change nothing.", "A cut file says itself what is cut, so there is nothing to choose by pens and shapes. To cut some of its pieces name them.\n  cutc compile marker.cut --pieces 3,7-12");
    /// Options of patterns for another file.
    SOURCE_NO_PATTERNS = warning(Spares, Shape, "source/no-patterns", "`--size` or `--quantity` is given for a file that is no pattern DXF; they change nothing.", "Cut files, plots and drawings have no sizes and no quantities: all of their pieces are cut, each as often as it is drawn. To cut some of them name them.\n  cutc compile marker.cut --pieces 3,7-12");

    // ISO cut files.
    /// A block that is not words.
    ISO_SYNTAX = error(Text, "iso/syntax", "A block does not follow the grammar: a word is a letter and, mostly, a number.", "A damaged block may hide a coordinate, and a cut to the wrong place cannot be taken back. Look at the excerpt; export or transfer the file again.\n  X100Y200*M14*   is right; X100Y2#0* is not.");
    /// X or Y without a number.
    ISO_NO_VALUE = error(Text, "iso/no-value", "X, Y, I or J stands without its number.", "A coordinate without its number could be anything; taking it as 0 would cut across the lay. Export the file again, or write the number.\n  X100Y*   lacks the number of Y.");
    /// A place that no table reaches.
    ISO_FAR_PLACE = error(Text, "iso/far-place", "A place lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.", "No table is a kilometre long, so the motion would be nonsense. Look at the block: two numbers may have run together, or an export in another unit was mixed in.\n  X30000500Y0* instead of X3000500Y0*");
    /// Lines of per cent signs.
    ISO_FRAME = warning(Spares, Text, "iso/percent-frame", "A line that holds nothing but `%` stands at the start or the end of the file; it is passed over.", "Senders put such lines around programs for machine tools. In a cut file they mean nothing, but the file may have gone through the wrong sender.");
    /// A number too large to be a place on a table.
    ISO_OVERFLOW = error(Text, "iso/number-overflow", "A number has more digits than a coordinate can have.", "Two coordinates have run together, most likely because an asterisk was lost on the way. Transfer the file again.");
    /// M19 that never ends.
    ISO_OPEN_SLIT = error(Text, "iso/open-slit", "A slit that M19 begins must end with M15 before the next piece, knife-down or end.", "M19 promises a notch, and its end says how deep it is. Without M15 the next outline would be cut as a part of the notch.\n  M19*X0Y100*M14*X5Y100*M15*");
    /// M14 while the knife is down.
    ISO_KNIFE_DOWN_TWICE = warning(Spares, Text, "iso/knife-down-twice", "M14 stands where the knife is down already; the second one is ignored.", "Some systems repeat M14. The cut is the same, but an M15 may have been lost: see in the picture (-t svg) whether two lines are joined that should not be.");
    /// N while the knife is down, and what follows is another piece.
    ISO_PIECE_KNIFE_DOWN = error(Text, "iso/piece-knife-down", "A piece begins while the knife is down, and the cut leads on into it: an M15 is missing.", "Without the M15 the knife would cut from one piece to the next, through whatever lies between. Some controllers insert an N amid an outline: that is no fault, as long as the outline goes on.\n  X0Y0*M15*N2*X4000Y0*M14*   is right; X0Y0*N2*X4000Y0*M14* lacks the M15.");
    /// Places in the air where nothing is done.
    ISO_UNCUT_PLACES = warning(Spares, Shape, "iso/uncut-places", "Places in a row are passed with the knife up and nothing is cut there: an M14 may be missing.", "A piece whose M14 is lost is passed in the air, and is missing on the table. Look at the picture (-t svg) and count the pieces; transfer the file again.\n  N2*X4000Y0*M14*X7000Y0*   is right; N2*X4000Y0*X7000Y0* cuts nothing.");
    /// The file ends with the knife in the cloth.
    ISO_ENDS_KNIFE_DOWN = error(Text, "iso/ends-knife-down", "The file ends while the knife is down: it is most likely cut short.", "The end of the file is missing, and with it perhaps more pieces. Transfer it again and compare the sizes; add M15 and M0 only if you know that all is there.");
    /// Last block without its asterisk.
    ISO_NO_FINAL_ASTERISK = warning(Spares, Text, "iso/no-final-asterisk", "The last block has no `*`; it is read all the same.", "The last block was read as it stands. If its last digits were cut off, the coordinate is wrong: compare the size of the file with the original.");
    /// No M0.
    ISO_NO_END = warning(Spares, Text, "iso/no-end", "The file has no M0 at its end; check that it is complete.", "Many systems write M0 last. Its absence may mean that the transfer stopped early: count the pieces with `cutc info` and compare with the marker.");
    /// A code that has no meaning here.
    ISO_UNKNOWN_CODE = warning(Spares, Text, "iso/unknown-code", "A code that cutc does not know is ignored, as the standard says; the message gives its count and first block.", "Cutters skip what they do not know, and so does this. If the code steers something that you rely on, such as a speed or a tool, the cut will lack it.");
    /// A code that is known but has no effect.
    ISO_IGNORED_CODE = warning(Spares, Text, "iso/ignored-code", "A code that would change how the piece is cut is not obeyed; the message gives its count and first block.", "The file asks for a speed, a stop or another treatment that this program does not give. Decide whether the cloth can be cut without it; `[codes]` in the profile silences what you do not want.\n  codes.M25 = \"ignore\"");
    /// Units given twice, differently.
    ISO_UNITS_CHANGED = error(Text, "iso/units-changed", "G70, G71 or G91 change the unit after coordinates were read; two jobs may stand in one file.", "Half of the marker would be of another size. Two jobs may have been joined into one file: cut them as two files.");
    /// The drawing does not fit its own title or any table.
    ISO_UNIT_DOUBTFUL = warning(Spoils, Shape, "iso/unit-doubtful", "The extent suggests that another unit is meant; set `units` if it is.", "A marker that is 2.54 or 10 times too large or small spoils the whole lay. Compare the extent that `cutc info` prints with the width of the cloth, then set the unit.\n  cutc compile m.cut --set units=mm/10");
    /// Decimals where whole numbers stand, and a drawing smaller than parts.
    ISO_DECIMALS = error(Shape, "iso/decimals", "Coordinates have decimal points, and read as a hundredth or a thousandth of an inch they make a drawing smaller than 10 mm: they are inches.", "Numbers of cut files are whole, and G70 says that 1000 of them are an inch. A file with inches in decimals was written for another machine: each piece would be a dot. Let the CAD system write a cut file of whole numbers.\n  X5000Y1000*   is 5 inches along with G70; X5.000Y1.000* is not.");
    /// An arc with inconsistent centre or ends.
    ISO_ARC_RADIUS = error(Text, "iso/arc-radius", "An arc (G02, G03) has no centre, or its two ends are not equally far from it within one unit of the file.", "An arc whose ends disagree goes somewhere else than its author meant, perhaps into the part. Let the CAD system write the arc again, or as short straight lines.\n  G03X0Y100I-50J0*   the centre stands beside the start.");
    /// Labels of nothing.
    ISO_TRAILER_PIECE = warning(Spares, Shape, "iso/trailer-piece", "The list of labels behind M0 names a piece that the file does not hold; its fields are dropped.", "Labels that belong to no piece may come from another marker: then the list was copied to the wrong file. Nothing of it is cut.");
    /// M14 before any place.
    ISO_NO_POSITION = warning(Spoils, Text, "iso/no-position", "The knife goes down before the file gave X and Y; what is missing is taken as 0.", "The first cut may start at the corner of the table instead of its place. Look at the first contour in the picture (-t svg) before you cut.");
    /// X Y M14 in one block.
    ISO_KNIFE_IN_MOVE = error(Text, "iso/knife-in-move", "A code behind the place of its block lowers or lifts the knife.", "Some controllers move before they obey such a code, others behind it: the knife would cut on its way to the contour, or leave its last side uncut. Write the move and the code as two blocks, or the code before the place: X100Y100*M14*.");
    /// A drill between M14 and M15.
    ISO_DRILL_KNIFE_DOWN = error(Text, "iso/drill-knife-down", "A drill code stands where the knife is down; an M15 may be missing.", "A drill would come down beside a standing blade. Look at the blocks before it: where the outline ends there must be an M15.\n  X100Y0*M15*X50Y50M43*");
    /// No contour, slit or drill.
    ISO_NOTHING_TO_CUT = error(Shape, "iso/nothing-to-cut", "The file was read to its end and holds no contour, slit or drill.", "Only labels or titles are there, or the pieces are on a layer that was not exported. Export the marker with its cut lines.");

    // HPGL plots.
    /// Junk.
    HPGL_NOT_A_PLOT = error(Text, "hpgl/not-a-plot", "Most of what stands in the file is no instruction of a plotter.", "Reading went on until more was junk than not. The file is of another kind, or was damaged on the way: look at its first bytes, and let cutc recognise it.\n  cutc check odd.plt");
    /// A number too large to be a place on a table.
    HPGL_OVERFLOW = error(Text, "hpgl/number-overflow", "A coordinate of a plot is beyond any table.", "Numbers that have run together lead the knife off the table. A separator was lost on the way: transfer the file again.");
    /// Bytes of PE that mean nothing.
    HPGL_PE_DAMAGED = error(Text, "hpgl/encoding-damaged", "An encoded polyline (PE) holds a byte that cannot stand there, or ends amid a number or a place.", "Every place behind the damage is relative to what is lost, so the outlines would be wrong. Transfer the file again as binary data: mail and editors change such bytes.");
    /// PE without its end.
    HPGL_PE_OPEN = warning(Spoils, Text, "hpgl/encoding-open", "An encoded polyline (PE) has no semicolon, and the file ends with it.", "Its numbers are whole, but nobody knows whether more should follow. Compare the size of the file with the original, and the pieces with the marker.");
    /// PE that became text.
    HPGL_PE_REPAIRED = warning(Spares, Text, "hpgl/encoding-repaired", "The plot was saved again as UTF-8, which doubles bytes of encoded polylines (PE); they were put together again.", "An editor or a mail program took the plot for text. The repair is exact as long as nothing else was changed: look at the pieces in the picture (-t svg), and transfer plots as binary data.");
    /// LB without its end.
    HPGL_OPEN_LABEL = warning(Spares, Text, "hpgl/open-label", "A label of a plot has no terminator; it ends with its line, or at a semicolon.", "A text without its end would swallow the lines behind it. Count the pieces with `cutc info`; if the file sets another terminator than ETX (DT), it may have been lost.");
    /// Bytes between instructions.
    HPGL_JUNK = warning(Spares, Text, "hpgl/junk", "Bytes of a plot begin no instruction and were passed over; the message gives their count and first place.", "Plotters pass over such bytes, too. A few at the beginning or end come from drivers. Where a line hangs on them the file is refused (hpgl/lost-place).");
    /// X without Y.
    HPGL_ODD = warning(Spoils, Text, "hpgl/odd-coordinate", "A list of coordinates in a plot has an odd number of values; the last one is ignored.", "Plotters ignore it as well. Amid a line a number is lost, and then the file is refused (hpgl/lost-place); behind one that is closed nothing hangs on it.");
    /// Bytes that cannot be read, amid a line or before it.
    HPGL_LOST = error(Text, "hpgl/lost-place", "A line of a plot hangs on something that cannot be read, or an instruction that draws lacks numbers.", "A character was lost or changed amid an outline, so that it would miss a place, or start from another one. Transfer the file again and compare the sizes.");
    /// Numbers in the language of the computer.
    HPGL_DECIMAL_COMMA = error(Text, "hpgl/decimal-comma", "The numbers of a plot have commas for decimal points, so that each reads as two.", "A plotter takes a comma for the end of a number, and would draw something else. Let the program write points, and export again.");
    /// A mnemonic that is not in the table.
    HPGL_UNKNOWN = warning(Spares, Text, "hpgl/unknown-instruction", "A plot has an instruction that cutc does not know; it is ignored, and the message gives its count and first place.", "Private instructions of a plotter do not draw as a rule. If lines are missing from the picture (-t svg), this is where to look.");
    /// Instructions that draw and are not obeyed.
    HPGL_LEFT_OUT = warning(Spares, Text, "hpgl/instruction-not-obeyed", "A plot has an instruction that draws or moves and is not obeyed: fills, drawn characters, windows, copies.", "What it draws is no outline: fills and characters are not cut. A window (IW) that would clip lines is not applied, so lines may reach farther than on paper.");
    /// A size that depends on the plotter.
    HPGL_SCALE = warning(Spoils, Shape, "hpgl/scale-of-device", "The size of a plot depends on the plotter: it is scaled to corners or a page that it does not give, or its SC, IP, IR or RO is broken and ignored.", "The size of the drawing depends on the plotter that it was made for, or a number of its scale was lost, so it is most likely wrong here. Let the CAD system write coordinates without scale, or with IP.");
    /// More than one page.
    HPGL_PAGES = warning(Spoils, Shape, "hpgl/several-pages", "A plot draws on after a page went out or was cut off, or draws over the same place after a fresh start; the pages lie on each other.", "Two markers in one file would be cut into each other. If they are pages of one marker, export it as one long page; else split the file.");
    /// Frames of a long plot.
    HPGL_FRAMES = error(Shape, "hpgl/frame-advance", "A plot draws on after the paper was moved on by a frame (FR).", "Places behind FR have the same numbers and lie a frame farther on the paper. How long a frame is only the plotter knows, so the frames would be cut into each other. Let the CAD system write one long plot, without frames.");
    /// A place that no table reaches.
    HPGL_FAR_PLACE = error(Text, "hpgl/far-place", "A place of a plot lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.", "No table is a kilometre long, so the motion would be nonsense. Two numbers may have run together, relative moves may be damaged, or the unit is far too large.\n  cutc check marker.plt --set hpgl.unit=0.01");
    /// Curves that fill the memory.
    HPGL_CURVES = error(Shape, "hpgl/too-many-chords", "The curves of a plot, or polygons that are drawn again and again, have more chords than a plot can need.", "Curves are read as chords within a quarter of the tolerance. So many of them come from a damaged radius, from a polygon that is drawn thousands of times, or from a tolerance far below what a knife can follow.");
    /// Drawing from where letters left the pen.
    HPGL_PLACE_UNKNOWN = warning(Spoils, Shape, "hpgl/place-unknown", "A plot draws from where a text has left the pen, which depends on the letters of the plotter.", "Behind a text the pen stands at its end, and only the plotter knows how wide its letters are. A relative move from there leads elsewhere on each machine. Let the CAD system write absolute places (PA), or leave the text out.");
    /// Drawing with SP0.
    HPGL_NO_PEN = warning(Spares, Shape, "hpgl/no-pen", "A plot draws lines while no pen is taken (SP0); they are not cut.", "SP0 puts the pen away. Some programs write it at the start and draw all the same: then nothing would be cut. Let the CAD system choose pen 1 for the outlines.");
    /// Another size than the texts say, or than any table has.
    HPGL_UNIT_DOUBTFUL = warning(Spoils, Shape, "hpgl/unit-doubtful", "The extent of a plot, or a length that stands in its texts, suggests another unit; set `hpgl.unit` if it is.", "Plots do not say their unit. 1/40 mm and 1/1000 inch differ by 1.6 percent, which nobody sees and every part would be wrong. Compare the extent with the marker.\n  cutc compile marker.plt --set hpgl.unit=0.0254");
    /// A polygon that does not end.
    HPGL_ENDS_IN_POLYGON = error(Text, "hpgl/ends-in-polygon", "A polygon (PM) of a plot has no end, and is not drawn: the file is most likely cut short.", "What PM gathers is drawn by EP once PM2 has ended it; the file ends before, or another polygon begins. Transfer it again and compare the sizes.");

    // SVG drawings.
    /// No XML, or another kind of it.
    SVG_NOT_XML = error(Text, "svg/not-xml", "The file is no whole XML, or XML of another kind than SVG.", "A drawing that was cut short on its way, or edited by hand, lacks the ends of its elements, and nobody knows what is lost. Save it again from the program that drew it, and compare the sizes of the copies.");
    /// Entities that blow up.
    SVG_ENTITIES = error(Text, "svg/entities", "Entities of an SVG file stand for each other so often that it would fill the memory.", "Illustrator writes a few entities for names, which are read. No program for drawings nests them: the file was made to stop whoever reads it.");
    /// Bytes that are no text in the encoding of the file.
    SVG_ENCODING = error(Text, "svg/encoding", "The letters of an SVG file cannot be told: its encoding is not read, or its bytes are not in it.", "UTF-8, UTF-16 and encodings with one byte a letter are read, such as ISO-8859-1. Names of layers and parts hang on their letters. Save the drawing in UTF-8.");
    /// Path data with a fault.
    SVG_PATH = error(Text, "svg/path-data", "The data of a path or the places of a polyline have a fault.", "Browsers draw such a path up to its fault and leave out the rest: a part would lack its edge. Save the drawing again, or mend the number at the byte that the message names.");
    /// An attribute that cannot be read.
    SVG_VALUE = error(Text, "svg/bad-value", "A length, a transform or a view box cannot be read, or is no size.", "What has it would lie elsewhere or have another size. Lengths have mm, cm, in, pt, pc, q, px, % or no unit; the size of letters (em) is none that can be cut.");
    /// A style that transforms.
    SVG_STYLE_MOVES = error(Text, "svg/style-moves", "A style sheet or a `style` transforms a shape or gives the data of a path, or `transform-origin` moves the centre of a transform.", "Programs for drawings write such things as attributes of their own, which are read. These are not, so the shape would be cut elsewhere than it is seen.");
    /// A copy of nothing or of itself.
    SVG_USE = error(Text, "svg/use-broken", "A `use` copies an element that is not in the file, or one that holds it.", "Whatever it should draw would be missing from the cloth. It may stand in another file, or have been deleted: turn copies into shapes of their own before saving.");
    /// Too much of everything.
    SVG_TOO_MUCH = error(Shape, "svg/too-much", "The elements, copies or curves of an SVG file are more, or stand deeper in each other, than a drawing can need.", "Copies of copies multiply, and a damaged radius has chords without end. Turn copies into shapes, ungroup, and look for a number with too many digits.");
    /// A place beyond any table.
    SVG_FAR = error(Text, "svg/far-place", "A place of an SVG file lies more than a kilometre from the page.", "A digit is doubled, a decimal point lost, or a transform wrong: no table is a kilometre long. Look at the number and at the transforms of the groups around it.\n  cutc check drawing.svg");
    /// A picture of ours.
    SVG_OWN_PICTURE = error(Shape, "svg/own-picture", "The file is a picture that cutc made of a marker.", "It shows runs, plunges, overlaps and findings beside the lines of the parts: all of them would be cut. Compile the marker that it was made of.\n  cutc compile marker.cut -o marker.svg");
    /// A size in pixels.
    SVG_NO_UNIT = warning(Spoils, Shape, "svg/size-in-pixels", "The size of an SVG drawing is in pixels, and programs do not agree how large those are.", "96 go to an inch, 90 in old Inkscape and 72 in Illustrator: a wrong guess makes every part a third too large or too small. Compare the width that the message names with the drawing. A page with width and height in mm leaves no doubt.");
    /// A size that no garment has.
    SVG_SIZE = warning(Spoils, Shape, "svg/size-doubtful", "An SVG drawing is smaller than any part, or wider than any table both ways.", "Its unit was most likely taken for another one. Set the size of the page in mm in the program that drew it, and save it again.");
    /// Hidden layers.
    SVG_HIDDEN = warning(Spares, Text, "svg/hidden", "Elements of an SVG file are not displayed, and not cut; the message gives their count and first place.", "A hidden layer is not seen in the drawing, so it is not cut either. Show the layer if it must be cut.");
    /// Invisible shapes.
    SVG_NO_LINE = warning(Spares, Text, "svg/no-line", "Shapes of an SVG file have neither stroke nor fill, and are not cut; the message gives their count and first place.", "Nobody sees them: guides and boxes around texts are often so. Give them a stroke if they must be cut.");
    /// Kinds that are left out.
    SVG_LEFT_OUT = warning(Spares, Text, "svg/left-out", "An SVG file draws something that is not read: pictures, flowing texts, markers, clips; the message gives the count and first place of a kind.", "What it draws is not cut, and lines that a clip or a mask would hide are. If outlines are missing from the picture (-t svg), turn them into paths in the program that drew them.");
    /// Rules that are not obeyed.
    SVG_STYLE = warning(Spares, Text, "svg/style-not-read", "A style sheet of an SVG file has rules whose selectors are not read.", "Selectors of elements, classes, ids and `*` are obeyed. Another one may hide lines, which are cut then: look at the picture (-t svg).");

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
    /// A part beside open lines.
    DRAWING_MAY_BE_SEAM = error(Shape, "drawing/may-be-seam-line", "A part may be a seam line: open lines run beside it from outside, as those of a broken outline do.", "A closed line with some of an outline around it may be the seam line of a part whose outline is not whole: cut along it, the part would be too small. Close the outline in the CAD system, or leave the piece out. If those lines only guide a worker, say so once you have looked at the picture.\n  cutc compile marker.plt --skip 10\n  cutc compile marker.plt --cut-pens 1\n  cutc compile marker.plt -t svg --set drawing.beside=guide");
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
    DRAWING_FRAME_OR_PART = error(Shape, "drawing/frame-or-part", "A rectangle around closed lines beside each other may be the frame of the drawing, or a part with cut-outs: nothing in the file tells.", "A frame that is taken for a part is cut, and none of the parts in it; a part that is taken for a frame is cut inside and not around. Frames are filled by parts to half at least, and little lies beside them. Say what the rectangle is.\n  cutc compile marker.plt --set hpgl.frame=outermost\n  cutc compile marker.plt --inner ignore");
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
    DXF_NO_COORDINATE = error(Text, "dxf/no-coordinate", "An entity of a DXF file lacks a coordinate.", "A place that is taken for 0 would pull the outline across the cloth. Lines were lost on the way: export or transfer the file again.");
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

    // The marker, whatever the dialect.
    /// A contour that does not close.
    MARKER_OPEN = warning(Spares, Shape, "marker/open-contour", "A contour does not end where it starts; it is cut as it stands.", "A part whose outline does not close hangs on the cloth by a bridge, and is torn out by hand. Close it in the CAD system; if it is a line that is meant to be open, all is well.");
    /// A point far off.
    MARKER_FAR_POINT = warning(Spoils, Shape, "marker/far-point", "A point of a contour stands 300 mm or more off, between two that lie near each other: a digit of it may be doubled or lost.", "A contour leads out to the point and straight back: no part looks so, unless a slash is drawn as a spike. The knife cuts there and back, through what lies on the way. Look at it in the picture (-t svg), and transfer or export the file again.");
    /// Nothing that a knife can cut.
    MARKER_TINY = error(Shape, "marker/tiny", "All contours of the file together are smaller than 1 mm: its unit is wrong, or it is damaged.", "No knife cuts a part of that size: it would stab the cloth in one place for each piece. Compare the extent that `cutc info` prints with the marker, and say the unit where the file has another one.\n  cutc compile marker.cut --set units=mm/10");
    /// Hardly anything that a knife can cut.
    MARKER_SMALL = warning(Spoils, Shape, "marker/small", "All contours of a file without a grid together are smaller than 5 mm: its unit is doubtful.", "Parts of garments are larger. Points of a CSV file are in mm, those of a pattern DXF in the unit that it says: compare the extent that `cutc info` prints with the parts.");
    /// Sides of an outline that miss each other.
    MARKER_SIDES = warning(Spoils, Shape, "marker/sides", "Open contours of a cut file miss each other at both ends by one or two units of the file; each is cut as an open line.", "An outline that is drawn in strokes is one contour where each stroke starts at the end of the one before. Strokes that were rounded apart are cut one by one, with overcuts at each end, and count as open lines. Let the CAD system write the outline in one stroke, or with equal ends.\n  X3117Y1199*M15*X3117Y1199*M14*   goes on; from X3117Y1200 another line begins.");
    /// An outline with an overcut of other software.
    MARKER_OVERRUN = warning(Spares, Shape, "marker/overrun", "Outlines run past their own start, as overcuts of other software do; they are closed where they start, and cut once.", "Other software draws the overcut of its own knife into the file. The knife lays its own overlap at the start of every outline, so the drawn one is left out, and the area of the part counts once. Leave the overcut out of the export and the line goes.");
    /// An outline with several rounds.
    MARKER_ROUND_AGAIN = warning(Spares, Shape, "marker/round-again", "Outlines go round two times or more in one stroke, there and back, or stand twice in a drawing, and so do lines; they are cut once.", "Some plots draw an outline twice to make the line bold, some go back along it, and some cutters go twice through thick cloth. A second cut frays the edge and may shift the part, which is free by then. Draw each outline once in the CAD system.");
    /// A contour that is repeated.
    MARKER_TWICE = warning(Spoils, Shape, "marker/contour-twice", "A contour stands twice in the file, or runs within `nest.band_mm` of another one all the way, and would be cut twice.", "The knife runs the same way again: that takes time, frays the edge and may shift the part, which is free by then. Delete one of the two in the CAD system.");
    /// Equal points in a row.
    MARKER_EQUAL_POINTS = warning(Spares, Shape, "marker/equal-points", "Points that repeat the one before them were dropped, in files without a grid those within 0.01 mm of it, too; the message gives their count.", "Harmless: a direction cannot be taken from two points at one place, so one of them goes. Many of them hint at an export in too coarse a unit.");
    /// A slit again.
    MARKER_SLIT_TWICE = warning(Spares, Shape, "marker/slit-twice", "The same slit stands twice in a piece; it is cut once.", "Some systems write a notch once for each of the two pieces or sizes. A second cut in the same place would only widen the notch.");
    /// A slit that leads out of its part.
    MARKER_SLIT_OUTWARDS = warning(Spoils, Shape, "marker/slit-outwards", "A slit begins on the edge of its part and leads out of it; it is cut as the file says.", "A notch is cut into the seam allowance. A slit that leads outwards marks nothing on its own part and may cut into the one beside it: its two ends may be swapped, or the part mirrored without its notches. Look at it in the picture (-t svg).");
    /// A slit without length.
    MARKER_SLIT_NO_LENGTH = warning(Spares, Shape, "marker/slit-no-length", "A slit ends where it starts: nothing is cut there.", "A notch was drawn there and its depth shrank to nothing, perhaps below the unit of the file. If the sewer needs it, give it a depth in the CAD system.");
    /// A contour that is one place.
    MARKER_NO_LENGTH = warning(Spares, Shape, "marker/no-length", "All points of a contour are the same place: nothing is cut there.", "Something was drawn there and shrank to a point, perhaps a notch below the unit of the file. If something is missing, export in a finer unit.");
    /// Contours of a piece that cross.
    MARKER_SELF_CROSSING = warning(Spoils, Shape, "marker/self-crossing", "A contour crosses itself, or another one of its piece: the knife cuts through what was cut before, and the part has loose corners.", "Where an outline crosses itself a small loose corner falls out, and the knife passes through cloth that is free. Mostly an offset or a seam allowance was folded over: mend the corner in the CAD system. Lines that cross are marks or hatchings that were not meant for the knife: leave them out of the export.");
    /// Slits that meet.
    MARKER_SEVERED = warning(Spoils, Shape, "marker/severed", "A slit comes within 0.5 mm of another slit of its piece, or of an edge on the other side of the part.", "What is left between the two tears at the next touch, or nothing is left: a strip comes apart, a cut-out opens to the edge. Narrow parts with notches that face each other are such places. Shorten the slits, or move them along the edge.");
    /// Contours of two pieces that cross.
    MARKER_OVERLAPPING = warning(Spoils, Shape, "marker/overlapping-pieces", "The outlines of two pieces overlap: each is cut into the other. Pieces that only touch are no such case.", "One of the two parts is cut into and will not fit at its seam. Move the pieces apart in the marker; look at the place in the picture (-t svg).");
    /// A notch that stands out into another piece.
    MARKER_NOTCH_OVER = warning(Spoils, Shape, "marker/notch-over-piece", "A notch that stands out of its part lies over another piece, which is cut into; the message says how deep.", "A notch that stands out needs waste beside its part. Here another part lies there, and the notch is cut into its edge. Move the two apart in the marker by the depth of the notch, or have such notches cut as slits into their own part.\n  cutc compile marker.cut --set notch.style=slit");
    /// A hole in no part.
    MARKER_DRILL_OUTSIDE = warning(Spoils, Shape, "marker/drill-outside", "A hole is drilled where no part is: in the waste or in a cut-out.", "A hole in the waste marks nothing: the drill belongs to another place, or the piece was moved without it. Look at it in the picture (-t svg).");
    /// Outlines that cannot be told from cut-outs.
    MARKER_TOO_MANY = error(Shape, "marker/too-many-outlines", "So many outlines lie in or over one another that the search for which lies in which was ended: parts would be cut before their cut-outs.", "Nobody could tell which outline lies in which any more, and a part that is cut before its cut-outs is free and shifts. No lay of parts looks so: the file holds fills, hatchings, a pattern of many rings or the same job many times. Leave them out of the export, or split the marker.");
    /// A search that was not brought to its end.
    MARKER_SEARCH_ENDED = warning(Spoils, Shape, "marker/search-ended", "So many lines lie near one another that a search was ended; the message says for what.", "What was found is said; what was not looked at may be as wrong. No lay of parts looks so: the file holds fills or hatchings. Leave them out of the export, or split the marker.");
    /// Numbers that start again.
    MARKER_NUMBER_TWICE = warning(Spares, Shape, "marker/piece-number-twice", "The number of a piece comes again: two jobs may stand in one file, and both are cut.", "Two markers that were joined into one file are both cut, and --pieces takes both pieces of a number. If only one of them is meant, split the file.");

    // Layout of the marker on the table, and selection of its pieces.
    /// A sheet that takes places away from advances.
    SHEET_ADVANCE = error(Shape, "sheet/advance", "The file moves the cloth on (M69), and the sheet of the profile would take the marker away from where it expects that.", "What is cut before an advance lies in the first window of the conveyor, and the advance is as long as the file means it: turned, mirrored end to end, scaled along X or copied, parts would be cut where no cloth is yet. Move or flip the marker only, or ignore the advance where the table is long enough.\n  cutc compile m.cut --set sheet.copies=2 --set codes.M69=ignore");
    /// More than a program holds.
    SHEET_COPIES = error(Shape, "sheet/too-many-copies", "So many copies of the marker have more points than one program can have, or a file of stitches is to be copied.", "A thousand million points are more than any table takes. Set sheet.copies to what the hint says, and run the program again. Between two copies of stitches the thread is cut and its colour set back, which is for the program that made the file to say.");
    /// A number that no piece has.
    SELECT_UNKNOWN_PIECE = error(Shape, "select/unknown-piece", "A piece number that was asked for is not in the file; the message names the flag, the hint the numbers that there are.", "It is a slip of the hand or the wrong file; cutting what is left of the choice could waste cloth. Both ends of a range must be numbers of the file. `--dump-after inspect` shows the pieces with their numbers.\n  cutc compile m.cut --pieces 3,7-12");
    /// Nothing is chosen.
    SELECT_NOTHING_LEFT = error(Shape, "select/nothing-left", "The options that choose pieces leave nothing to cut.", "--pieces, --skip, --resume-from and --bites act together: a piece is cut when all leave it. Pieces that hold labels alone count for nothing.");

    // The knife's way.
    /// A smooth closed contour too small for the blade.
    PATH_TIGHT = warning(Spoils, Shape, "path/tight-contour", "A smooth closed contour is narrower than the blade; it is cut all the same.", "The blade is longer than the hole is wide: its body cuts the edge as it turns. Use a narrower knife or a drill for such holes, or accept a ragged edge.");
    /// A cut that begins on a curve from which the blade's body lies away.
    PATH_BOWED_PLUNGE = warning(Spoils, Shape, "path/bowed-plunge", "A cut begins on a curve, and the body of the plunged blade cuts beside it by more than `knife.max_bow_mm`.", "The blade plunges straight, and the curve bows away from it: on a radius R by about w^2/8R. A narrower knife helps; knife.tight_curves = \"nibble\" cuts the start of the curve by short steps. Best is to let the outline begin, or turn its corner, on a straighter stretch.");
    /// A curve too tight for the blade.
    PATH_TIGHT_CURVE = warning(Spoils, Shape, "path/tight-curve", "A curve is tighter than the blade, which would stand across it: it is cut along the tangent, or nibbled, as `knife.tight_curves` says.", "On such a curve the blade is longer than the curve is wide: whatever `knife.follow` says, its heel swings out of the line and tears the cloth. A narrower knife helps; knife.tight_curves = \"nibble\" cuts the curve by plunges, which is slower and cuts past it along its tangents.");
    /// A bend without a lift at which the body of the blade leaves its line far.
    PATH_SWING = warning(Spoils, Shape, "path/swing", "The heel of the blade leaves its line by more than 3 mm behind a bend.", "The blade turns about its tip in the cloth, and its heel is a blade's width behind: behind a vertex that turns by an angle a it stands w sin(a) beside the line and cuts there, in the waste or in the part. knife.max_swing_mm lifts the knife at such bends as at corners; a lower corner.angle_deg does that at every bend, a narrower knife swings less.");
    /// A tight curve that the profile refuses.
    PATH_TIGHT_CURVE_REFUSED = error(Shape, "path/tight-curve-refused", "A curve is tighter than the blade, and `knife.tight_curves` is \"refuse\".", "The profile wants no curve cut that the blade cannot follow. Use a narrower knife, draw the curve wider, or set knife.tight_curves to \"follow\" or \"nibble\".");
    /// A blade longer than its cut that cuts into the part itself.
    PATH_OVERCUT = warning(Spoils, Shape, "path/overcut", "The blade is longer than a short cut and there is no waste at its ends: it cuts past them into its own part, where that lies least deep.", "A cut shorter than the blade is one plunge, and what the blade is longer by lies beyond its ends: in the waste if there is any, otherwise in the part. A narrower knife cuts less far; a notch of another shape may need no such cut.");
    /// A blade longer than its cut that cuts into another part.
    PATH_OVERCUT_NEIGHBOUR = warning(Spoils, Shape, "path/overcut-neighbour", "The blade is longer than a short cut and there is no waste at its ends: it cuts past them into another part, which the message names.", "A cut shorter than the blade is one plunge. Beyond its ends the blade lies where it goes least deep into any part, and here that is the part beside it. Leave more room between the two in the marker, take a narrower knife, or let `knife.spare` put the blade into its own part.");
    /// A blade longer than its cut that cuts into parts deeper than the profile allows.
    PATH_OVERCUT_REFUSED = error(Shape, "path/overcut-refused", "A short cut cannot be made without cutting deeper into a part than `verify.max_overcut_part_mm` or `verify.max_overcut_neighbour_mm` allows.", "The blade is longer than the cut, there is no waste at its ends, and wherever it is put it lies deeper in the cloth than the profile allows. Take a narrower knife, draw the notch longer or of another shape, or allow more if the seam hides it.\n  verify.max_overcut_part_mm = 6");
    /// A slit that the profile makes deeper than its part is wide.
    PATH_NOTCH_THROUGH = error(Shape, "path/notch-through", "A slit that `notch.depth_mm` makes deeper than it is drawn would cut through its part.", "The profile asks for slits of one depth, and this part is too narrow for it: the slit would come out on the other side, or reach the next part. Take a smaller notch.depth_mm, or cut such pieces with a profile of their own.");
    /// A run that winds C past its range.
    PATH_C_RANGE = error(Shape, "path/c-range", "A run winds the C axis past `c.range_deg` however it is entered and wherever it is parted.", "The cables of the blade's axis would be torn. Runs are lifted on the way and C unwound, but this one cannot be parted so: widen c.range_deg if the machine can turn farther.");
    /// Off the table, by a hair.
    MARKER_OVER_EDGE = warning(Spares, Shape, "marker/over-the-edge", "The marker or the knife's way leaves the table of the profile, by a millimetre at the most.", "A hand puts a marker down no better than to a millimetre, so this is only said, in one line. Move the marker a little, or correct `table` in the profile.");
    /// A piece that fits no window of a conveyor.
    MARKER_BITE = error(Shape, "marker/bite", "A piece is longer than a window of the conveyor (`bite.length_mm`) and cannot be split, begins before a window that the conveyor has passed, or is chosen in some of its windows only.", "A conveyor cuts a window, moves the cloth on and cuts the next. A piece that is longer than a window is split where its edges are straight, or nearly, with waste beside them: there both halves leave the edge, so that they cross wherever the conveyor brings the cloth. A piece with lines or cut-outs inside, or that lies in another one, is not split. Turn the marker so that its pieces are shorter along X, part them farther from each other, or leave the piece out with --skip and cut it on a longer table. A conveyor does not run back: what the file has behind a stop or an advance must lie behind it. A piece that is split is cut in all of its windows or in none: begin with its first one.");
    /// Nothing to move the cloth on for.
    MARKER_IDLE_ADVANCE = warning(Spares, Shape, "marker/idle-advance", "The file moves the cloth on (M69) where nothing behind that lies farther along X, and `bite.length_mm` is given; the advance is left out.", "On a conveyor the windows of the marker decide how far the cloth is moved, and an advance of nothing is none. Two advances behind each other, or one before the first piece, look so. If the file means the operator to be waited for, let it stop (M01).");
    /// Off the table.
    MARKER_OFF_TABLE = error(Shape, "marker/off-table", "The marker, the blade beyond the end of a line, or a head that follows edges leaves the table of the profile by more than a millimetre; the hint says how to move the marker.", "The head would hit its end stop, and the cut stop in the middle of a part. Move the marker as the hint says, choose other pieces with --skip, or correct `table` in the profile.");

    // Motion.
    /// No curve inside the tolerance band.
    PLAN_SMOOTH = error(Shape, "plan/smooth", "No smooth curve was found inside the tolerance of a run; a larger `path.tolerance_mm` or a smaller `corner.angle_deg` helps.", "The points turn too sharply for a blade in the cloth and too gently to count as a corner. With a smaller corner.angle_deg the knife lifts there; with a larger path.tolerance_mm it may round it.");
    /// No motion within the limits.
    PLAN_PROFILE = error(Shape, "plan/profile", "No motion within the limits was found for a run.", "No pace keeps speed, acceleration and jerk of all axes on this run. Limits that are far apart, such as a tiny jerk, cause it: check `axes` in the profile.");
    /// The samples break a limit.
    PLAN_CHORD = error(Shape, "plan/chord", "The blade cannot be a chord of the smooth curve of a run, although it can be one of its points; `knife.follow = \"tangent\"` cuts it.", "With its tip on the smooth curve the blade finds no place for its heel there. It is a matter of a little: a smaller path.tolerance_mm, or knife.follow = \"tangent\", cuts the file.");
    /// The samples break a limit.
    PLAN_CERTIFY = error(Shape, "plan/certify", "The samples of a run break a limit of the profile however far it is slowed down.", "Every sample is checked before it leaves, and these could not be made to pass. Check time.period_ms and `axes` in the profile; if they are right, please report the file.");

    // Verification.
    /// A target that cannot say it.
    TARGET_REFUSED = error(Shape, "target/refused", "The target cannot express something that the marker or the options ask for; the message says what.", "Each target says what its reader understands: a cut file knows no dry run, a controller with arcs no blade that lies as a chord on tight curves. Nothing is written rather than something else; write another target, or change what the message names.");
    /// A rule does not hold.
    VERIFY_BROKEN = error(Shape, "verify/broken", "The program, read back, breaks a rule; the message names the rule, the worst value, the limit, the time and the place.", "The program was thrown away before it could reach the machine. The message names the rule; `cutc explain` with that name says what it protects. Where a rule has a key of its own in the profile, the hint names it.");

    // Sewn patterns.
    /// No stitch.
    SEW_NOTHING = error(Shape, "sew/nothing-to-sew", "The file holds no line and no stitch.", "The pattern is empty, or holds what is no line. `cutc info` tells what is in a drawing; `--line` names the pen or layer whose lines are sewn.\n  cutc sew seat.plt --line 2");
    /// A row that says nothing known.
    SEW_ROW = error(Text, "sew/row", "A row of a pattern or of a queue cannot be read; the message says why.", "Sewing on without it would leave a gap or displace all that follows. Mend the row: decimal points, commas between the fields.\n  0,0,zigzag open");
    /// A file that ends too soon.
    SEW_TRUNCATED = error(Text, "sew/truncated", "A stitch file or queue ends before its end.", "What is missing would not be sewn, and a thread would be left uncut. Transfer the file again as binary data and compare the sizes of both.");
    /// A pattern without its last record.
    SEW_NO_END = warning(Spares, Text, "sew/no-end", "A DST file has no record for its end, but as many records as its header counts.", "Some programs leave the end out. The pattern is whole and is sewn; a machine that reads the file itself may not stop there. Write it anew if it goes to one.\n  cutc sew seat.dst -t dst -o whole.dst");
    /// A record that cannot be read.
    SEW_RECORD = error(Text, "sew/record", "A record of a stitch file is none that its format knows; the message has its number.", "All that follows would be sewn in another place. The file is damaged, or is of another format: name that with `--from`.\n  cutc sew odd.bin --from exp");
    /// A header that tells something else.
    SEW_HEADER = warning(Spares, Text, "sew/header", "The header of a DST file does not fit its stitches; the message says what it tells and what there is.", "The stitches are sewn as they are. If the header is right, some are missing: compare with the original. Headers of files that were edited are often wrong.");
    /// More than the pattern.
    SEW_BEHIND_END = warning(Spares, Text, "sew/behind-end", "Bytes stand behind the end of a stitch file; they are not sewn.", "Machines stop at the end, and so does this. If two files have run together, or a damaged byte ends the pattern too soon, stitches are missing: compare their number with the original.");
    /// Speeds that are others now.
    SEW_SPEEDS = warning(Spares, Shape, "sew/other-speeds", "A queue that is read asks for other speeds than it is sewn at: speeds are computed from the profile.", "SPEED rows are written anew, so an edit of them by hand has no effect. Limit the speed by `sewing.max_rpm`, or by pitch with `sewing.speeds`.\n  cutc sew pocket.queue.csv --set sewing.max_rpm=2500");
    /// A machine that is hardly used.
    SEW_SLOW = warning(Spares, Shape, "sew/slow-pattern", "No run is sewn at a quarter of the greatest speed of the spindle, because no stitch fits into its window faster.", "The pattern takes many times as long as it should: most likely an angle of the window, a step or a rate of the profile is mistyped. The message has the window.\n  sewing.feed_start_deg = 250\n  sewing.feed_end_deg = 110");
    /// Jumps that cut the thread.
    SEW_JUMPS_CUT = warning(Spares, Shape, "sew/jumps-cut", "Long moves without a trim are three jumps or more in a DST or JEF file, which most machines take for one.", "The thread is cut where it was to run on, and a seam may open. Let the thread be cut there anyway (`sewing.trim`), or write EXP, which has a record for a trim.");
    /// Jump after jump.
    SEW_JUMPS = warning(Spares, Shape, "sew/jump-storm", "So many jumps follow one another that the file is most likely damaged.", "Jumps in a row are made as one move, so nothing is lost, but no system writes so many. Look at the picture (-t svg), and compare the stitches with the original.");
    /// An element on a line that cannot bear it.
    SEW_ELEMENT = error(Shape, "sew/element", "An element of a pattern does not suit its line: a box needs four corners, a bar tack two points, any other two places.", "What was meant cannot be told from the points, and a tack in the wrong place is a hole in the garment. Mend the points, or take another element.\n  0,0,box-x");
    /// A needle point where the machine cannot be.
    SEW_FIELD = error(Shape, "sew/field", "A needle point lies outside the field of the machine (`table.*`), or the pattern is larger than its clamp (`sewing.field_mm`).", "The needle would strike the clamp, or X and Y their stops. Move the pattern, as with sheet.origin, or turn it, or give the field of the machine.\n  cutc sew pocket.csv --set sheet.origin=corner");
    /// An inset that leaves nothing.
    SEW_INSET = error(Shape, "sew/inset", "A contour is too narrow for the inset that is asked for, or the file has no contours.", "The seam would run outside the part, or through another seam: somewhere the contour is narrower than twice the inset. Take a smaller `--inset`, or draw the seam.");
    /// No such line.
    SEW_NO_LINE = error(Shape, "sew/no-line", "The file has no line of the name that `--line` gives; the hint names those that it has.", "Pens and layers have the names that the file gives them; `seam` means the seam lines that are recognised in parts.\n  cutc sew parts.plt --line seam");
    /// A line of a kind that is not read.
    SEW_UNREAD = error(Shape, "sew/unread-line", "The pen or layer that `--line` names draws something of a kind that is not read, such as a spline.", "What is not read would not be sewn: a seam would have a gap, or be missing. Let the CAD system export polylines, as the convention for patterns has them.");
    /// A stitch that is too short.
    SEW_SHORT = warning(Spares, Shape, "sew/short-stitch", "A stitch is shorter than `sewing.min_pitch_mm`; it is merged with the next. The message has its record.", "Stitches that are too short pile up under the needle and break the thread. Where they are meant, to lock a seam, lower the key.");
    /// A stitch that is too long.
    SEW_LONG = error(Shape, "sew/long-stitch", "A stitch is longer than the machine can make, or than its speed allows where `sewing.on_long` is \"reject\". The message has its record.", "The needle would be dragged through the cloth. `--on-long split` makes it several, `--on-long slow` sews its run more slowly.");
    /// Stitches that were split.
    SEW_SPLIT = warning(Spoils, Shape, "sew/split-stitches", "Stitches too long for the speed were split into equal ones; the message has how many penetrations that adds.", "The seam has more holes than were drawn, which shows on leather and weakens it. `--on-long slow` keeps every stitch and takes more time.");
    /// A run that one stitch slows down.
    SEW_SLOWED = warning(Spares, Shape, "sew/slowed-run", "A run is sewn more slowly than most of its stitches allow, because of one; the message names it and what it costs.", "The spindle keeps one speed within a run. Shorten the stitch in the pattern, split it (`--on-long split`), or end the run before it by a trim.");
    /// No speed at all.
    SEW_NO_SPEED = error(Shape, "sew/no-speed", "A stitch fits into its window at no speed of the spindle.", "Even the slowest turn is too short for the move. Look at `sewing.feed_start_deg`, `sewing.feed_end_deg`, the acceleration and `sewing.grid_rpm`, or split the stitch.");
    /// The queue runs dry.
    SEW_UNDERRUN = warning(Spares, Shape, "sew/underrun", "The host does not fill the queue as fast as the machine takes from it; the message says from which entry on.", "The machine stops amid a seam and waits. A deeper queue bridges it, a faster host or a slower spindle ends it.\n  cutc sew seat.dst --set sewing.queue_depth=1024");
    /// The program breaks a rule.
    SEW_BROKEN = error(Shape, "sew/broken", "The program, read back, breaks a rule; the message names the rule, the worst value, the limit and the entry.", "The program is not written: it would not sew what the file says. Please report the file: a pattern that is read without errors should be sewn as it is.");

    // Heads that follow edges at a distance.
    /// Nothing to follow.
    SPRAY_NOTHING = error(Shape, "spray/nothing", "A file has no closed contour, or none that a head can follow at its distance.", "A head follows the closed edges of parts from outside, and holes from inside. Close the contours, or take a smaller distance.\n  tool.distance_mm = 150");
    /// Edges that meet.
    SPRAY_TANGLED = error(Shape, "spray/tangled", "Edges cross, touch or run back upon each other, so that there is no outside from which a head could follow them.", "What is coated there could be anything. Draw each part by one line that does not meet itself, and move parts that touch apart: between them a head has no room anyway.");
    /// Lines that are no edges.
    SPRAY_NO_EDGE = warning(Spares, Shape, "spray/no-edge", "Open lines, notches and holes of a file are no edges of parts: no head at a distance follows them.", "Only closed contours have an inside and an outside. If an edge is among them, it is drawn open: close it in the CAD system.");
    /// Edges that are not reached.
    SPRAY_UNREACHED = warning(Spoils, Shape, "spray/unreached", "A part of an edge cannot be followed at the distance of the tool, because something else is nearer; the message says how much, and where the worst is.", "It stays without coat: slots and bays that are narrower than twice the distance, and both sides of corners inwards. Coat it by hand, or with a smaller distance.\n  cutc compile panel.csv -p spray.toml --set tool.distance_mm=150");
    /// Polynomials that do not fit.
    SPRAY_UNFIT = error(Shape, "spray/unfit", "Polynomials stay farther from the way of the head than is allowed, however often edges are split.", "The program would not be judged good. Powers of the time (`quintic.basis`) are ill-conditioned on long edges; Chebyshev polynomials are not.\n  quintic.basis = \"chebyshev\"");
    /// Chords that are too coarse for a curve.
    SPRAY_COARSE = warning(Spares, Shape, "spray/coarse", "Chords look like those of a curve, but leave it by more than `path.chord_sag_max_mm`: they are followed as straight lines.", "A head swings from chord to chord then, and asks much of its axes. If a curve is meant, say how far its chords may leave it, or export it in finer ones; `path.fit = \"polygon\"` says that none is.\n  path.chord_sag_max_mm = 0.5");
    /// A jet that is slow.
    SPRAY_SLOW = warning(Spoils, Shape, "spray/slow", "The jet passes an edge more slowly than by twice `tool.edge_speed_percent`, on more than its two ends.", "Its coat is thicker there. The axes cannot follow the head through so tight a curve at its speed, or chords are too coarse for one.\n  tool.edge_speed_mm_s = 200");
    /// C beyond its range.
    SPRAY_RANGE = error(Shape, "spray/c-range", "Around an edge the head turns farther than `c.range_deg` lets it.", "Around a part without corners inwards the head turns once, and its hoses with it. Widen the range, or let C turn without end.\n  c.range_deg = \"unbounded\"");
    /// A target that tells of a knife.
    SPRAY_TARGET = error(Shape, "spray/target", "A target that tells of a knife is asked for, but the tool is a head at a distance.", "Its program would be that of a knife on the lines. Take setpoints or a picture.\n  cutc compile panel.csv -p spray.toml -t csv,svg");

    // Tracking the centre of a moving cloth.
    /// The first row of a log.
    TRACK_HEADER = error(Text, "track/header", "The first row of a log does not name its columns.", "Without names I and J could be taken for each other, and the carriage would run away from the centre. Write them as the hint has them.\n  t_s,i,j");
    /// A column that nothing is known of.
    TRACK_COLUMN = warning(Spares, Text, "track/column", "A log has columns that nothing is known of; they are passed over.", "If one of them is the place of the conveyor or of the carriage it has another name here. The hint has the names.\n  t_s,i,j,conv_mm,carriage_mm");
    /// A row that cannot be read.
    TRACK_ROW = error(Text, "track/row", "A row of a log cannot be read, or does not follow the one before it; the message says why.", "Leaving it out would shift all that the controller counts by a sample. Mend the row: decimal points, commas, times that go on.\n  0.010,33,31");
    /// A header alone.
    TRACK_NO_ROWS = error(Text, "track/no-rows", "A log has no rows.", "Nothing was recorded, or all of it was lost on the way: the carriage cannot have followed anything by it. Look at the recorder, and compare the sizes of its file and of this one.");
    /// Rows in another rhythm.
    TRACK_PERIOD = error(Text, "track/period", "Most rows of a log are not `track.period_ms` apart.", "The controller counts samples: with another period its debounce time and what it feeds forward would be others. Set the period of the log.\n  cutc track log.csv --set track.period_ms=5");
    /// Samples that are missing.
    TRACK_GAP = warning(Spares, Text, "track/gap", "Samples are missing in a log; behind them the controller begins anew.", "What the carriage did meanwhile is not known. If the recorder loses samples, so may the controller: look at the load of its processor.");
    /// An edge that is lost.
    TRACK_LOST = warning(Spoils, Text, "track/edge-lost", "All sensors of a ruler are covered, or none: its edge is lost, and the drive is off until it is found.", "Meanwhile the heads do not follow the cloth, and what they cut there is displaced. Bring the cloth between the rulers before it is cut; longer rulers lose it less easily.");
    /// A width outside its limits.
    TRACK_WIDTH = warning(Spoils, Text, "track/width", "The width of the cloth is outside `track.width_range_mm`; the drive is off until it is inside.", "A fold, a tear or a seam between two bolts: parts may lie beyond the edge of the cloth. Look at the place before it is cut, or widen the range.\n  track.width_range_mm = [1480, 1520]");
    /// A profile that may overshoot.
    TRACK_OVERSHOOT = warning(Spares, Shape, "track/overshoot", "The profile breaks a condition under which the carriage is sure not to overshoot; the message says which and by how much.", "The conditions are sufficient, not necessary: it may do well all the same. Simulate it with the delays of your machine before you believe it.\n  cutc track --simulate step.toml -p machine.toml");
    /// A carriage whose place is not known.
    TRACK_CARRIAGE = warning(Spoils, Shape, "track/carriage-assumed", "A log does not tell where the carriage was; it is taken to have followed the commands.", "The rulers tell where the cloth is from the carriage, so the centre line is only as true as its place. Log its encoder as the column `carriage_mm`, in mm to the right of the middle.");
    /// Upstream rulers without columns in the log.
    TRACK_NO_UPSTREAM = warning(Spares, Shape, "track/no-upstream", "The profile has rulers upstream, but the log does not have their readings; nothing is fed forward.", "The carriage then only follows what it sees, and is farther off centre than it could be. Log the readings as columns `up_i` and `up_j`.");
    /// The commands break the law.
    TRACK_BROKEN = error(Shape, "track/broken", "The commands for the carriage, read back, are not those that the readings and the profile ask for; the message names the row.", "Nothing is written: the carriage would be driven away from the cloth. Please report the log: what is written should keep the law.");
    /// No line to write.
    TRACK_NO_CENTRE = error(Shape, "track/no-centre", "A log sees both edges of the cloth in no two places of the conveyor, so that there is no centre line.", "The edges are lost throughout, or the conveyor stands. Look at the picture of another run, and at the column `conv_mm`.");
    /// Cloth without readings.
    TRACK_UNSEEN = warning(Spoils, Shape, "track/unseen", "A centre line goes over cloth whose edges were not both seen, or for which samples are missing; it is taken to go straight there.", "The cloth may have wandered meanwhile, and what is cut there is displaced by as much. Record that stretch again, or leave it out of the marker.");
    /// A scenario that cannot be read.
    TRACK_SCENARIO = error(Text, "track/scenario", "A scenario has a key that is none, or a value that is out of its range.", "A mistyped key would leave the cloth lying still without a word. `cutc manual tracking` lists the keys.\n  offset_mm = 20");
    /// The first row of a centre line.
    CENTRE_HEADER = error(Text, "centre/header", "The first row of a centre line is not `conv_mm,centre_mm`.", "Another file of numbers would move every part to one side. Give the file that `cutc track -t centre` writes.\n  cutc compile marker.cut --centre cloth.centre.csv");
    /// A row that cannot be read.
    CENTRE_ROW = error(Text, "centre/row", "A row of a centre line cannot be read, or the conveyor does not go on in it; the message says why.", "Guessing it would cut parts beside their places. Mend the row, or make the file anew from the log.\n  125.5,-0.75");
    /// A line without two ends.
    CENTRE_SHORT = error(Text, "centre/short", "A centre line has fewer than two rows.", "One place says nothing of how the cloth lies beside it. For cloth that lies straight give its two ends.\n  0,1.5\n  3000,1.5");
    /// A marker that is longer than its centre line.
    CENTRE_BEYOND = warning(Spoils, Shape, "centre/beyond", "The marker reaches beyond the ends of the centre line, where the cloth is taken to lie as at the nearer end.", "Nobody has seen the cloth there. Record the whole of it, or move the marker to where it was seen (`sheet.origin`).");
    /// A centre line that no cloth takes.
    CENTRE_STEEP = warning(Spoils, Shape, "centre/steep", "The centre line runs across more steeply than cloth does on a conveyor, or bends within a notch, which is cut straight.", "Parts are sheared along the line: where it is wrong they are spoilt. Compare the file with the cloth; a column in another unit, or damage of an edge that was taken for its way, looks like that.\n  cutc track log.csv -t centre,svg");
    /// A row of marks that cannot be read.
    MARKS_ROW = error(Text, "marks/row", "A row of a file of registration marks (`--map`) cannot be read, or the first one is not `x_mm,y_mm,found_x_mm,found_y_mm`.", "Guessing a place would move every part. The first two numbers are where the mark stands in the drawing, the others where it lies on the table.\n  120.5,80,1322.4,96.2");
    /// Marks that give no map.
    MARKS_FIT = error(Shape, "marks/fit", "Registration marks do not say where the drawing lies: they are fewer than four, lie on a line or mirrored, stretch it as no cloth is, or do not fit each other within `map.max_mm`.", "A mark that was read wrongly would spoil every part. Find the marks again that the message names; six marks or more tell well which one is wrong.");
    /// An unlikely map.
    MARKS_ODD = warning(Spoils, Shape, "marks/odd", "The map of the registration marks turns or skews the drawing by more than 5 degrees or stretches it by more than a twentieth, or the marker reaches far beyond the marks.", "It fits the marks all the same: they may be in another unit, or of another drawing. Far beyond the marks their errors grow. Compare one part with a ruler before the first cut.");
    /// A map, and something else that moves the drawing.
    MARKS_SHEET = error(Shape, "marks/sheet", "`--map` says where the drawing lies, and a key of `sheet`, the file or the row of a pattern set lays it as well.", "Two answers to where the cloth lies would cut beside it. Leave the keys of `sheet` out.\n  cutc compile marker.cut --map marks.csv");
    // Flow cutting.
    /// No cut.
    FLOW_NOTHING = error(Shape, "flow/nothing-to-cut", "The marker holds nothing that a head over a conveyor could cut.", "Heads cut lines; a file of holes, labels or events has none. Look at what is in it.\n  cutc info marker.cut");
    /// Requests that heads do not carry out.
    FLOW_LEFT_OUT = warning(Spoils, Shape, "flow/left-out", "Something in the file is not made on the conveyor: holes, stops, advances; the message says what and how many.", "The parts come off the conveyor without it. Drill them elsewhere, or cut this marker on a table.\n  cutc compile marker.cut");
    /// More than the machine has.
    FLOW_INFEASIBLE = error(Shape, "flow/infeasible", "The machine cannot cut the marker at this speed of the conveyor; the message says what it takes, the hints what would help, each with its figure.", "A head that comes too late would leave a stretch uncut that is gone for good. Slow the conveyor down, give heads more travel along the feed (`flow.travel_mm`), or take more heads and rows.\n  cutc flow marker.cut -p flow.toml --speed max -o out");
    /// Off the conveyor.
    FLOW_OFF_TABLE = error(Shape, "flow/off-table", "A head would leave the table across the feed (`table.y_mm`).", "There it has no cloth to cut and runs into its end. Move the marker across (`sheet.origin`), or mend the key.");
    /// The program breaks a rule.
    FLOW_BROKEN = error(Shape, "flow/broken", "The programs of the heads, read back, break a rule; the message names the rule, the worst value, the limit, the head and the row.", "Nothing is written: cloth would be spoilt. Please report the file: a marker that is planned should be cut as it is.");

    // Machine profile.
    /// The TOML is broken.
    PROFILE_SYNTAX = error(Text, "profile/syntax", "The profile is not valid TOML.", "TOML wants a key, an equals sign and a value on a line; text stands in quotes. `cutc profile init` prints a profile that is right.\n  knife.width_mm = 7.2");
    /// A key that does not exist.
    PROFILE_UNKNOWN_KEY = error(Text, "profile/unknown-key", "The profile has a key that does not exist; the message names the nearest one.", "A mistyped key would leave the default in force without a word, and the knife would be of another width than you think. Take the name that the message suggests.");
    /// A value of the wrong type.
    PROFILE_TYPE = error(Text, "profile/type", "A value of the profile has the wrong type.", "A number in quotes, or text where a number belongs. The message says what the key takes.\n  knife.width_mm = 7.2     and not \"7.2\"");
    /// A value out of its range.
    PROFILE_RANGE = error(Text, "profile/range", "A value of the profile is out of its range.", "No machine has such a value: a comma may have slipped, or the unit is another. The message gives the range; the unit stands in the name of the key.");
}

/// The code of that name.
pub fn find(name: &str) -> Option<&'static Code> {
    ALL.iter().copied().find(|code| code.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_a_name_and_a_meaning_of_its_own() {
        for (i, code) in ALL.iter().enumerate() {
            assert!(ALL[..i].iter().all(|other| other.name != code.name), "{} stands twice", code.name);
            let is_kebab = code.name.chars().all(|c| matches!(c, 'a'..='z' | '0'..='9' | '-' | '/'));
            assert!(is_kebab && code.name.matches('/').count() == 1 && code.about.ends_with('.'), "{}", code.name);
        }
    }
}
