//! Codes of the cutting knife: marker, layout, path, motion, proof.

use crate::diagnostic::kind::{Code, codes, error, warning};
use crate::diagnostic::telling::Fault::Shape;
use crate::diagnostic::telling::Harm::{Spares, Spoils};

codes! {
    // The marker, whatever the dialect.
    /// A contour that does not close.
    MARKER_OPEN = warning(Spares, Shape, "marker/open-contour", "A contour does not end where it starts; it is cut as it stands.", "A part whose outline does not close hangs on the cloth by a bridge, and is torn out by hand. Close it in the CAD system; if it is a line that is meant to be open, all is well. In drawings with layers, open lines in a part are slashes, and only those outside all parts are told.");
    /// A point far off.
    MARKER_FAR_POINT = warning(Spoils, Shape, "marker/far-point", "A point of a contour lies far from two that are near each other: 300 mm or more, or 30 mm or more on legs of different length out of an even line; or a corner lies a metre or more off a part less than a third of that long. A digit may be wrong.", "A contour leads out to the point and straight back. The legs of a dart do so, too, but they are equally long, since they are sewn to each other; a slash drawn as a spike is the other exception. The knife cuts there and back, through what lies on the way. A corner moved far away stretches the part. Look at it in the picture (-t svg), and transfer or export the file again.");
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
    MARKER_SEVERED = warning(Spoils, Shape, "marker/severed", "A slit comes within 0.5 mm of another slit of its piece, or of an edge on the other side of the part, or starts inside the part, longer than a notch, and leads out of it.", "What is left between the two tears at the next touch, or nothing is left: a strip comes apart, a cut-out opens to the edge. Narrow parts with notches that face each other are such places. Shorten the slits, or move them along the edge.");
    /// Contours of two pieces that cross.
    MARKER_OVERLAPPING = warning(Spoils, Shape, "marker/overlapping-pieces", "The outlines of two pieces overlap: each is cut into the other. Pieces that only touch are no such case.", "One of the two parts is cut into and will not fit at its seam. Move the pieces apart in the marker; look at the place in the picture (-t svg).");
    /// Parts that lie in each other.
    MARKER_DEEP_OVERLAP = error(Shape, "marker/deep-overlap", "Two parts lie over each other deeper than `nest.overlap_mm`, or by a quarter of the smaller one: the same cloth cannot lie in both.", "Marker makers let parts overlap by some millimetres to save cloth. Farther, one of the two is cut to pieces: a label box lies across an outline, two pages or jobs lie over each other, or a part was moved by mistake. Move the parts apart, leave one out, or say how deep an overlap may be. A closed line up to 15 mm long is no part here.\n  cutc compile m.cut --skip 7\n  cutc compile m.cut --set nest.overlap_mm=8");
    /// A notch that stands out into another piece.
    MARKER_NOTCH_OVER = warning(Spoils, Shape, "marker/notch-over-piece", "A notch that stands out of its part lies over another piece, which is cut into; the message says how deep.", "A notch that stands out needs waste beside its part. Here another part lies there, and the notch is cut into its edge. Move the two apart in the marker by the depth of the notch, or have such notches cut as slits into their own part.\n  cutc compile marker.cut --set notch.style=slit");
    /// A hole in no part.
    MARKER_DRILL_OUTSIDE = warning(Spoils, Shape, "marker/drill-outside", "A hole is drilled where no part is: in the waste or in a cut-out.", "A hole in the waste marks nothing: the drill belongs to another place, or the piece was moved without it. Look at it in the picture (-t svg).");
    /// A stroke on no edge.
    MARKER_STRAY = warning(Spoils, Shape, "marker/stray-stroke", "A slit, or a stroke as short as a notch, in a cutter file, begins on no edge of its piece: it lies in the waste or inside a part.", "Notches start at the edge of their part. One in the waste marks nothing, and one inside a part is a hole in it: a digit of its place may be lost, or the piece was moved without it. Where it is a mark on purpose, all is well. Look at it in the picture (-t svg).");
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
}
