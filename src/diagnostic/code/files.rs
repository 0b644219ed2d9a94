//! Codes of files, whatever is in them, and of cut files, plots and SVG drawings.

use crate::diagnostic::kind::{Code, codes, error, warning};
use crate::diagnostic::telling::Fault::{Shape, Text};
use crate::diagnostic::telling::Harm::{Spares, Spoils};

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
    /// One coordinate where both are written.
    ISO_ALONE = error(Text, "iso/one-coordinate", "A block has X or Y alone, in a file whose other blocks repeat a coordinate that does not change.", "The letter of the other coordinate may be lost: X0Y2000 without its Y is X02000, and the knife would go there. Transfer the file again. Files that omit each coordinate that does not change are read. If the last block of the file is such a block, the file is cut short.\n  X3000Y0*X3000Y2000*X02000*   lacks the Y of its last block.");
    /// A place that no table reaches.
    ISO_FAR_PLACE = error(Text, "iso/far-place", "A place lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.", "No table is a kilometre long, so the motion would be nonsense. Look at the block: two numbers may have run together, or an export in another unit was mixed in.\n  X30000500Y0* instead of X3000500Y0*");
    /// Lines of per cent signs.
    ISO_FRAME = warning(Spares, Text, "iso/percent-frame", "A line that holds nothing but `%` stands at the start or the end of the file; it is passed over.", "Senders put such lines around programs for machine tools. In a cut file they mean nothing, but the file may have gone through the wrong sender.");
    /// Bytes of a serial line.
    ISO_LINE_BYTES = warning(Spares, Text, "iso/line-bytes", "Control bytes of a serial line (STX, ETX, XON, XOFF) stand between blocks; they are passed over.", "Programs that record what a cable carries keep the bytes that start and stop the sender. Nothing is lost by them; if the line was slow to stop, blocks may be. Compare the size of the file with the original.");
    /// Blocks between two slashes.
    ISO_DELETED = warning(Spoils, Text, "iso/deleted-passage", "Whole blocks or a knife-down (M14) stand between two `/` and are left out.", "In cut files two `/` enclose what is left out. In ISO 6983 a `/` at the start of a block leaves out that block alone: two of these take all pieces between them. See in the picture (-t svg) what is missing, and let the CAD system write the file without `/`.\n  /M01*N2*X0Y0*M14*   to the next `/` nothing is cut.");
    /// A number too large to be a place on a table.
    ISO_OVERFLOW = error(Text, "iso/number-overflow", "A number has more digits than a coordinate can have.", "Two coordinates have run together, most likely because an asterisk was lost on the way. Transfer the file again.");
    /// M19 that never ends.
    ISO_OPEN_SLIT = error(Text, "iso/open-slit", "A slit that M19 begins must end with M15 before the next piece, knife-down or end.", "M19 promises a notch, and its end says how deep it is. Without M15 the next outline would be cut as a part of the notch.\n  M19*X0Y100*M14*X5Y100*M15*");
    /// M14 while the knife is down.
    ISO_KNIFE_DOWN_TWICE = warning(Spares, Text, "iso/knife-down-twice", "M14 stands where the knife is down already; the second one is ignored.", "Some systems repeat M14. The cut is the same, but an M15 may have been lost: see in the picture (-t svg) whether two lines are joined that should not be.");
    /// N while the knife is down, and what follows is another piece.
    ISO_PIECE_KNIFE_DOWN = error(Text, "iso/piece-knife-down", "A piece begins while the knife is down, and the cut leads on into it: an M15 is missing.", "Without the M15 the knife would cut from one piece to the next, through whatever lies between. Some controllers insert an N amid an outline: that is no fault, as long as the outline goes on.\n  X0Y0*M15*N2*X4000Y0*M14*   is right; X0Y0*N2*X4000Y0*M14* lacks the M15.");
    /// Places in the air where nothing is done.
    ISO_UNCUT_PLACES = warning(Spoils, Shape, "iso/uncut-places", "Places in a row are passed with the knife up and nothing is cut there: an M14 may be missing.", "A piece whose M14 is lost is passed in the air, and is missing on the table. Look at the picture (-t svg) and count the pieces; transfer the file again.\n  N2*X4000Y0*M14*X7000Y0*   is right; N2*X4000Y0*X7000Y0* cuts nothing.");
    /// Codes that have no business in a cut.
    ISO_MISPLACED = error(Text, "iso/misplaced-code", "A code stands where it cannot: amid a cut, or behind a place in its block.", "A character of a place was changed, so that the knife would miss it or go elsewhere: X4000Y3H00 instead of X4000Y3000, or QX4000Y0, which parks. Transfer the file again.\n  X4000Y3000*M15*   is right; X4000Y300Q* is not.");
    /// A plunge at the end of another contour.
    ISO_NO_START = error(Text, "iso/no-start", "The knife goes down without a place behind a label whose text ends like one.", "The place where the new contour starts is lost, in the text of a label whose `*` is missing: the knife would cut from the old piece into the new one. Transfer the file again.\n  M31*BACK*X5000Y0*M14*   is right; M31*BACKX5000Y0*M14* is not.");
    /// A plunge at the end of another contour, as some files have.
    ISO_START_AT_END = warning(Spoils, Text, "iso/start-at-end", "The knife goes down where another contour or a hole is, though a piece or a label begins in between, or an open line starts there.", "Two contours may meet in a place, and then all is well. Otherwise the place where the second one starts is lost, and the knife cuts from the old piece into the new one. Look at the picture (-t svg).\n  N2*X5000Y0*M14*   starts at a place of its own\n  N2*M14*           starts where the last contour ends");
    /// A decimal point among whole numbers.
    ISO_POINT = error(Text, "iso/decimal-point", "Decimal points with zeros behind them stand in few places of cuts in a file of whole numbers: digits were changed.", "X4000Y3.00 leads elsewhere than X4000Y3000. Files whose numbers have decimals are read; in this one, none but that has any. Transfer it again.");
    /// A decimal that a program may have written.
    ISO_LONE_POINT = warning(Spoils, Text, "iso/lone-decimal-point", "One place of a cut has a decimal point in a file of whole numbers, without zeros behind it.", "Programs that leave out zeros write X2000Y5000.5 for a place between two units, and it is read so. If a digit has become the point, the cut leads elsewhere: compare the picture (-t svg) with the marker.");
    /// A slit that goes nowhere.
    ISO_EMPTY_SLIT = warning(Spares, Text, "iso/empty-slit", "A slit that M19 begins ends where it begins: its tip is missing, and nothing is cut.", "The place between M19 and M15 is lost, and with it a notch. Look at the block that the message names, and transfer the file again.\n  M19*X1000Y60*M15*   is right; M19*M15* cuts nothing.");
    /// A stroke that goes nowhere.
    ISO_EMPTY_STROKE = warning(Spoils, Text, "iso/empty-stroke", "The knife goes down and up at one place without a motion: what it should cut is lost.", "The places between M14 and M15 are lost, and with them a notch or a whole piece. Look at the block that the message names, count the pieces, and transfer the file again.\n  M14*X1000Y60*M15*   is right; M14*M15* cuts nothing.");
    /// The same hole twice.
    ISO_DRILLED_TWICE = warning(Spares, Text, "iso/drilled-twice", "A drill goes down twice at one place; a place between may be lost, or a code doubled.", "The second stroke hurts nothing, unless the place of another hole is lost before it. Count the holes with `cutc info`.\n  X100Y100*M43*M43*   drills twice at one place.");
    /// H amid the pieces.
    ISO_FILE_NUMBER = warning(Spoils, Text, "iso/file-number", "H, the number of the file, stands amid the pieces or twice: it may be another code with a changed letter.", "H43 instead of M43 drills nothing, and H71 instead of G71 leaves the file in another unit. Look at the block, and transfer the file again.");
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
    /// X, Y or F of a code that is not obeyed.
    ISO_OWN_NUMBERS = error(Text, "iso/numbers-of-a-code", "X, Y or F stand in the block of an unknown code, an origin (G04, M70) or a dwell (G04): they may be its own numbers and no place to cut to.", "G04X50 waits in most controllers, and G92X0Y0 gives the place a new name: if the knife went to such an X and Y, it would cut across the part. Leave the code out of the export, or let the profile skip G04 or M70 with its numbers.\n  cutc compile m.cut --set codes.G4=ignore");
    /// Units given twice, differently.
    ISO_UNITS_CHANGED = error(Text, "iso/units-changed", "G70, G71 or G91 change the unit after coordinates were read, or two of them contradict each other at the head.", "Half of the marker would be of another size: two jobs may have been joined into one file, so cut them as two. Two units at the head leave the size open. G91 asks for relative coordinates in other machines; where all places are absolute, the profile can skip one of the two codes.\n  cutc compile m.cut --set codes.G91=ignore");
    /// Moves instead of places.
    ISO_RELATIVE = error(Shape, "iso/relative-coordinates", "No outline of the file closes, and each would if its numbers were moves from one place to the next.", "G91 names the unit 0.254 mm in cut files, and asks for relative coordinates in most other machines. Read as places, such numbers make a tangle. Let the CAD system write absolute coordinates, with G70, G71 or G91 as the unit alone.");
    /// No unit at all.
    ISO_NO_UNIT = warning(Spares, Shape, "iso/no-unit", "The file states no unit (G70, G71, G91), and neither does the profile: 1/100 inch is assumed.", "Files of older cutters state none and mean 1/100 inch. If the code was lost, every part is 2.54 times too large or 10 times too large. Compare the extent that `cutc info` prints with the marker, and set the unit in the profile of the cutter.\n  cutc compile m.cut --set units=in/100");
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
    /// A decimal that a program may have written.
    HPGL_LONE_POINT = warning(Spoils, Text, "hpgl/lone-decimal-point", "One place of a line has a decimal point in a plot of whole numbers, without zeros behind it.", "Programs that leave out zeros write 2000,5000.5 for a place between two units, and it is read so. If a digit has become the point, the line leads elsewhere: compare the picture (-t svg) with the marker.");
    /// A blank, a plus sign or a comma that a program may have written.
    HPGL_LONE_SEPARATOR = warning(Spoils, Text, "hpgl/lone-separator", "A few places of lines have a blank or a plus sign in them, or a comma behind them, and the others have none.", "Blanks may stand between the numbers of a plot, a plus sign before them, and a comma behind them; they are read so. If one has taken the place of a digit, the line leads elsewhere: compare the picture (-t svg) with the marker.\n  PD3640 ,400;   may have been PD36400,400;");
    /// A letter of PA or PR that may be changed.
    HPGL_LONE_MODE = warning(Spoils, Text, "hpgl/lone-mode", "PR stands before places a few times in a plot, and PA ten times as often or more, or the other way round.", "PA is followed by places, PR by displacements. If one letter of it was changed on the way, the lines behind it lie elsewhere, and no number tells. Compare the picture (-t svg) with the marker.\n  PR400,400;   may have been PA400,400;");
    /// More numbers than an instruction takes.
    HPGL_NUMBERS = error(Text, "hpgl/too-many-numbers", "An instruction of a plot has numbers that it cannot have: it may be a line whose mnemonic was changed.", "The places of a line behind another mnemonic draw nothing, so that a part or a mark would be lost. It has more numbers than it takes, or ones beyond its range, or stands where only a move can stand: amid a stroke, or a size of the page (PS) amid a page. The hint names the instruction that was most likely meant. Transfer the file again, or mend the letter.\n  PT36400,400,36400,12400;   was PD36400,400,36400,12400;");
    /// Places in the air where nothing is drawn.
    HPGL_UNCUT_PLACES = warning(Spoils, Shape, "hpgl/uncut-places", "Places in a row are passed with the pen up, and nothing is drawn: a PD may be lost, or have become PU or PA.", "An outline whose PD is lost is passed in the air, and is missing on the table; its seam line, if it has one, is cut as if it were the part. Look at the picture (-t svg) and count the pieces; transfer the file again.\n  PU36400,400,36400,12400,20400,12400;   draws nothing.");
    /// Dots of a pen.
    HPGL_DOTS = warning(Spares, Shape, "hpgl/dots", "The pen is lowered and lifted at one place off the axes: a dot, which is neither cut nor drilled.", "Some programs mark drill holes by a dot; others leave dots behind where a stroke was. If they are holes, let the CAD draw circles of one size, and say up to which size circles are drilled.\n  cutc compile marker.plt --set hpgl.drill_max_mm=5");
    /// No end.
    HPGL_NO_END = warning(Spares, Text, "hpgl/no-end", "A plot ends amid an instruction, where the pen has just come to a place, or before it leaves HP-GL/2.", "Programs lift the pen, park it and put it away, or let the page out. A plot that ends before was most likely cut short on its way: count the pieces with `cutc info` and compare with the marker.");
    /// Numbers in the language of the computer.
    HPGL_DECIMAL_COMMA = error(Text, "hpgl/decimal-comma", "The numbers of a plot have commas for decimal points, so that each reads as two.", "A plotter takes a comma for the end of a number, and would draw something else. Let the program write points, and export again.");
    /// A mnemonic that is not in the table.
    HPGL_UNKNOWN = warning(Spares, Text, "hpgl/unknown-instruction", "A plot has an instruction that cutc does not know; it is ignored, and the message gives its count and first place.", "Private instructions of a plotter do not draw as a rule. If lines are missing from the picture (-t svg), this is where to look.");
    /// Instructions that draw and are not obeyed.
    HPGL_LEFT_OUT = warning(Spares, Text, "hpgl/instruction-not-obeyed", "A plot has an instruction that draws or moves and is not obeyed: fills, drawn characters, windows, copies.", "What it draws is no outline: fills and characters are not cut. A window (IW) that would clip lines is not applied, so lines may reach farther than on paper.");
    /// Different scales of the axes.
    HPGL_UNEVEN_SCALE = warning(Spoils, Text, "hpgl/uneven-scale", "IP and SC scale a plot in X and in Y by factors that differ by more than 1 percent: every part is stretched.", "A calibration of a plotter makes less. Most likely a digit of IP or SC was lost or changed, and the parts would be too long or too wide. Compare a length in X and one in Y with the marker.\n  IP0,0,1016,1000;SC0,1,0,1;   may have been IP0,0,1016,1016;");
    /// A size that depends on the plotter.
    HPGL_SCALE = warning(Spoils, Shape, "hpgl/scale-of-device", "The size of a plot depends on the plotter: it is scaled to corners or a page that it does not give, or its SC, IP, IR or RO is broken and ignored.", "The size of the drawing depends on the plotter that it was made for, or a number of its scale was lost, so it is most likely wrong here. Let the CAD system write coordinates without scale, or with IP.");
    /// More than one page.
    HPGL_PAGES = warning(Spoils, Shape, "hpgl/several-pages", "A plot draws on after a page went out or was cut off, beside or the same as the drawing before, or draws over the same place after a fresh start.", "Two markers in one file are both cut. If they are pages of one marker that go on beside each other, all is well; else split the file. A page that is drawn again is cut once.");
    /// Pages over each other.
    HPGL_PAGES_OVER = error(Shape, "hpgl/pages-overlap", "A plot draws on after a page went out or was cut off (PG, AF, AH, EC), over the drawing before.", "Each page has paper of its own, and its numbers begin anew. On the cloth all pages would lie at one place and be cut into each other. If they are pages of one marker, let the CAD system write one long page; if they are several markers, split the file where the message says.");
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
    SVG_VALUE = error(Text, "svg/bad-value", "A length, a transform or a view box cannot be read, is no size, or is missing where nothing would be drawn without it.", "What has it would lie elsewhere or have another size. Lengths have mm, cm, in, pt, pc, q, px, % or no unit; the size of letters (em) is none that can be cut.");
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
    SVG_HIDDEN = warning(Spares, Text, "svg/hidden", "Shapes and texts of an SVG file are hidden or transparent, and not cut; the message gives their count and first place.", "What is not seen in the drawing is not cut: it is not displayed, not visible or has the opacity 0, itself or through a group around it. Show the layer if it must be cut.");
    /// Invisible shapes.
    SVG_NO_LINE = warning(Spares, Text, "svg/no-line", "Shapes of an SVG file have neither stroke nor fill, and are not cut; the message gives their count and first place.", "Nobody sees them: guides and boxes around texts are often so. Give them a stroke if they must be cut.");
    /// Kinds that are left out.
    SVG_LEFT_OUT = warning(Spares, Text, "svg/left-out", "An SVG file draws something that is not read: pictures, flowing texts, markers, clips; the message gives the count and first place of a kind.", "What it draws is not cut, and lines that a clip or a mask would hide are. If outlines are missing from the picture (-t svg), turn them into paths in the program that drew them.");
    /// Rules that are not obeyed.
    SVG_STYLE = warning(Spares, Text, "svg/style-not-read", "A style sheet of an SVG file has rules whose selectors are not read.", "Selectors of elements, classes, ids and `*` are obeyed. Another one may hide lines, which are cut then: look at the picture (-t svg).");
}
