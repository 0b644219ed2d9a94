//! Every code that a diagnostic can carry: a stable name, its severity, and what it means.
//!
//! The first word is the stage. Names never change once released: scripts filter by them.

use serde::Serialize;

/// Whether a finding forbids a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// No program is written.
    Error,
    /// A program is written; somebody should look.
    Warning,
}

/// Whether what a warning is about may spoil parts: such findings are told before others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Harm {
    /// Cloth may be cut where it must not be, or at another size: that can't be mended.
    Spoils,
    /// Nothing, or something that is seen and mended.
    Spares,
}

/// What is at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// What stands in the file: its bytes are shown.
    Text,
    /// What the file draws, or what is made of it: no byte of it tells anything.
    Shape,
}

/// One kind of finding.
#[derive(Debug, PartialEq, Eq)]
pub struct Code {
    /// Stable name, `stage/kebab-case`.
    pub name: &'static str,
    /// Its severity, the same wherever it is found.
    pub severity: Severity,
    /// Whether it may spoil parts. Of an error nothing is cut.
    pub harm: Harm,
    /// What is at fault.
    pub fault: Fault,
    /// What it means and what to do, in a sentence or two.
    pub about: &'static str,
}

impl Code {
    /// Its place among all codes, the worst first: errors, then what may spoil parts, then the rest, each by stages.
    pub fn rank(&self) -> (Severity, Harm, usize) {
        let row = ALL.iter().position(|code| code.name == self.name).unwrap_or(ALL.len());
        (self.severity, self.harm, row)
    }
}

const fn error(fault: Fault, name: &'static str, about: &'static str) -> Code {
    Code { name, severity: Severity::Error, harm: Harm::Spares, fault, about }
}

const fn warning(harm: Harm, fault: Fault, name: &'static str, about: &'static str) -> Code {
    Code { name, severity: Severity::Warning, harm, fault, about }
}

// The source as a whole.
#[rustfmt::skip] // a table: one row a code
mod table {
    use super::Fault::{Shape, Text};
    use super::Harm::{Spares, Spoils};
    use super::{Code, error, warning};

    /// Nothing in the file.
    pub static SOURCE_EMPTY: Code = error(Text, "source/empty", "The file holds no bytes, or only blanks.");
    /// More bytes than spans can address.
    pub static SOURCE_TOO_LARGE: Code = error(Text, "source/too-large", "The file has 4 GiB or more; split the marker.");
    /// No dialect recognises the content.
    pub static SOURCE_UNKNOWN: Code = error(Text, "source/unknown-format", "The content is none of the dialects that cutc reads; the message names what it looks like.");
    /// Options for plots, and no plot.
    pub static SOURCE_NO_PLOT: Code = warning(Spares, Shape, "source/no-plot", "`--cut-pens`, `--inner` or `--cut-all` is given for a file that is no drawing; they change nothing.");

    // ISO cut files.
    /// A block that is not words.
    pub static ISO_SYNTAX: Code = error(Text, "iso/syntax", "A block does not follow the grammar: a word is a letter and, mostly, a number.");
    /// X or Y without a number.
    pub static ISO_NO_VALUE: Code = error(Text, "iso/no-value", "X, Y, I or J stands without its number.");
    /// A place that no table reaches.
    pub static ISO_FAR_PLACE: Code = error(Text, "iso/far-place", "A place lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.");
    /// Lines of per cent signs.
    pub static ISO_FRAME: Code = warning(Spares, Text, "iso/percent-frame", "A line that holds nothing but `%` stands at the start or the end of the file; it is passed over.");
    /// A number too large to be a place on a table.
    pub static ISO_OVERFLOW: Code = error(Text, "iso/number-overflow", "A number has more digits than a coordinate can have.");
    /// M19 that never ends.
    pub static ISO_OPEN_SLIT: Code = error(Text, "iso/open-slit", "A slit that M19 begins must end with M15 before the next piece, knife-down or end.");
    /// M14 while the knife is down.
    pub static ISO_KNIFE_DOWN_TWICE: Code = warning(Spares, Text, "iso/knife-down-twice", "M14 stands where the knife is down already; the second one is ignored.");
    /// N while the knife is down, and what follows is another piece.
    pub static ISO_PIECE_KNIFE_DOWN: Code = error(Text, "iso/piece-knife-down", "A piece begins while the knife is down, and the cut leads on into it: an M15 is missing.");
    /// Places in the air where nothing is done.
    pub static ISO_UNCUT_PLACES: Code = warning(Spares, Shape, "iso/uncut-places", "Places in a row are passed with the knife up and nothing is cut there: an M14 may be missing.");
    /// The file ends with the knife in the cloth.
    pub static ISO_ENDS_KNIFE_DOWN: Code = error(Text, "iso/ends-knife-down", "The file ends while the knife is down: it is most likely cut short.");
    /// Last block without its asterisk.
    pub static ISO_NO_FINAL_ASTERISK: Code = warning(Spares, Text, "iso/no-final-asterisk", "The last block has no `*`; it is read all the same.");
    /// No M0.
    pub static ISO_NO_END: Code = warning(Spares, Text, "iso/no-end", "The file has no M0 at its end; check that it is complete.");
    /// A code that has no meaning here.
    pub static ISO_UNKNOWN_CODE: Code = warning(Spares, Text, "iso/unknown-code", "A code that cutc does not know is ignored, as the standard says; the message gives its count and first block.");
    /// A code that is known but has no effect.
    pub static ISO_IGNORED_CODE: Code = warning(Spares, Text, "iso/ignored-code", "A code that would change how the piece is cut is not obeyed; the message gives its count and first block.");
    /// Units given twice, differently.
    pub static ISO_UNITS_CHANGED: Code = error(Text, "iso/units-changed", "G70, G71 or G91 change the unit after coordinates were read; two jobs may stand in one file.");
    /// The drawing does not fit its own title or any table.
    pub static ISO_UNIT_DOUBTFUL: Code = warning(Spoils, Shape, "iso/unit-doubtful", "The extent suggests that another unit is meant; set `units` if it is.");
    /// An arc that is none.
    pub static ISO_ARC_RADIUS: Code = error(Text, "iso/arc-radius", "An arc (G02, G03) has no centre, or its two ends are not equally far from it within one unit of the file.");
    /// Labels of nothing.
    pub static ISO_TRAILER_PIECE: Code = warning(Spares, Shape, "iso/trailer-piece", "The list of labels behind M0 names a piece that the file does not hold; its fields are dropped.");
    /// M14 before any place.
    pub static ISO_NO_POSITION: Code = warning(Spoils, Text, "iso/no-position", "The knife goes down before the file gave X and Y; what is missing is taken as 0.");
    /// A drill between M14 and M15.
    pub static ISO_DRILL_KNIFE_DOWN: Code = error(Text, "iso/drill-knife-down", "A drill code stands where the knife is down; an M15 may be missing.");
    /// No contour, slit or drill.
    pub static ISO_NOTHING_TO_CUT: Code = error(Shape, "iso/nothing-to-cut", "The file was read to its end and holds no contour, slit or drill.");

    // HPGL plots.
    /// Junk.
    pub static HPGL_NOT_A_PLOT: Code = error(Text, "hpgl/not-a-plot", "Most of what stands in the file is no instruction of a plotter.");
    /// A number too large to be a place on a table.
    pub static HPGL_OVERFLOW: Code = error(Text, "hpgl/number-overflow", "A coordinate of a plot is beyond any table.");
    /// Bytes of PE that mean nothing.
    pub static HPGL_PE_DAMAGED: Code = error(Text, "hpgl/encoding-damaged", "An encoded polyline (PE) holds a byte that cannot stand there, or ends amid a number.");
    /// PE without its end.
    pub static HPGL_PE_OPEN: Code = warning(Spoils, Text, "hpgl/encoding-open", "An encoded polyline (PE) has no semicolon, and the file ends with it.");
    /// PE that became text.
    pub static HPGL_PE_REPAIRED: Code = warning(Spares, Text, "hpgl/encoding-repaired", "The plot was saved again as UTF-8, which doubles bytes of encoded polylines (PE); they were put together again.");
    /// LB without its end.
    pub static HPGL_OPEN_LABEL: Code = warning(Spares, Text, "hpgl/open-label", "A label of a plot has no terminator; it ends with its line, or at a semicolon.");
    /// Bytes between instructions.
    pub static HPGL_JUNK: Code = warning(Spares, Text, "hpgl/junk", "Bytes of a plot begin no instruction and were passed over; the message gives their count and first place.");
    /// X without Y.
    pub static HPGL_ODD: Code = warning(Spoils, Text, "hpgl/odd-coordinate", "A list of coordinates in a plot has an odd number of values; the last one is ignored.");
    /// A mnemonic that is not in the table.
    pub static HPGL_UNKNOWN: Code = warning(Spares, Text, "hpgl/unknown-instruction", "A plot has an instruction that cutc does not know; it is ignored, and the message gives its count and first place.");
    /// What draws and is not cut.
    pub static HPGL_LEFT_OUT: Code = warning(Spares, Text, "hpgl/instruction-not-obeyed", "A plot has an instruction that draws or moves and is not obeyed: fills, drawn characters, windows.");
    /// A size that depends on the plotter.
    pub static HPGL_SCALE: Code = warning(Spoils, Shape, "hpgl/scale-of-device", "The size of a plot depends on the plotter: it is scaled to corners or a page that it does not give, or its SC, IP, IR or RO is broken and ignored.");
    /// More than one page.
    pub static HPGL_PAGES: Code = warning(Spoils, Shape, "hpgl/several-pages", "A plot draws on after a page went out; the pages lie on each other.");
    /// A place that no table reaches.
    pub static HPGL_FAR_PLACE: Code = error(Text, "hpgl/far-place", "A place of a plot lies more than a kilometre from the origin: a digit is doubled, or the unit is wrong.");
    /// Curves that fill the memory.
    pub static HPGL_CURVES: Code = error(Shape, "hpgl/too-many-chords", "The curves of a plot, or polygons that are drawn again and again, have more chords than a plot can need.");
    /// Drawing from where letters left the pen.
    pub static HPGL_PLACE_UNKNOWN: Code = warning(Spoils, Shape, "hpgl/place-unknown", "A plot draws from where a text has left the pen, which depends on the letters of the plotter.");
    /// Drawing with SP0.
    pub static HPGL_NO_PEN: Code = warning(Spares, Shape, "hpgl/no-pen", "A plot draws lines while no pen is taken (SP0); they are not cut.");
    /// Another size than the texts say, or than any table has.
    pub static HPGL_UNIT_DOUBTFUL: Code = warning(Spoils, Shape, "hpgl/unit-doubtful", "The extent of a plot, or a length that stands in its texts, suggests another unit; set `hpgl.unit` if it is.");
    /// A polygon that does not end.
    pub static HPGL_ENDS_IN_POLYGON: Code = error(Text, "hpgl/ends-in-polygon", "A plot ends amid a polygon (PM), which is not drawn: it is most likely cut short.");

    // What drawings want cut.
    /// The file is not whole.
    pub static DRAWING_CUT_SHORT: Code = error(Text, "drawing/cut-short", "A drawing ends amid a number, or amid a line outside all parts that does not close: it is most likely cut short.");
    /// A search without an end.
    pub static DRAWING_TOO_MANY: Code = error(Shape, "drawing/too-many-lines", "A drawing has so many closed lines that the search for which lies in which was ended: inner lines would be cut as parts.");
    /// No line is to be cut.
    pub static DRAWING_NOTHING_TO_CUT: Code = error(Shape, "drawing/nothing-to-cut", "A drawing was read to its end and no line of it is taken for something to cut.");
    /// A part with several others in it.
    pub static DRAWING_MAY_BE_FRAME: Code = warning(Spoils, Shape, "drawing/may-be-frame", "A part holds several closed lines that are not cut: it may be a frame or the edge of the table, and they the parts.");
    /// Lines that nobody closed.
    pub static DRAWING_OPEN_OUTLINES: Code = warning(Spares, Shape, "drawing/open-outlines", "Long lines of a drawing do not close and lie in no part: they may be outlines, and are not cut.");
    /// A rectangle around a few parts.
    pub static DRAWING_FRAME: Code = warning(Spoils, Shape, "drawing/frame", "A rectangle around a few parts is taken for the frame of the drawing, and is not cut; it may be a part with cut-outs.");
    /// Closed lines inside parts.
    pub static DRAWING_INNER_LINES: Code = warning(Spares, Shape, "drawing/inner-lines", "Closed lines lie inside parts and are no seam lines: they may be cut-outs, and are not cut unless somebody asks for it (`--inner cut`).");
    /// Too small for parts.
    pub static DRAWING_SMALL_OUTLINES: Code = warning(Spares, Shape, "drawing/small-outlines", "Small closed lines of a drawing lie in no part; they are not cut.");
    /// The searches for notches, letters and seam lines.
    pub static DRAWING_SEARCH_ENDED: Code = warning(Spares, Shape, "drawing/search-ended", "A drawing has so many lines that the search for notches, letters and seam lines was ended; some are not recognised.");

    // CSV polylines.
    /// The header is missing.
    pub static CSV_HEADER: Code = error(Text, "csv/header", "The first row must be `x_mm,y_mm`.");
    /// A row that is not two numbers.
    pub static CSV_ROW: Code = error(Text, "csv/row", "A row must hold two finite decimal numbers, separated by a comma.");
    /// A contour of one point.
    pub static CSV_NO_LENGTH: Code = error(Shape, "csv/no-length", "A contour must have two different points at least; a blank line ends a contour.");
    /// No contour.
    pub static CSV_NOTHING_TO_CUT: Code = error(Shape, "csv/nothing-to-cut", "The file holds a header and no contour.");

    // The marker, whatever the dialect.
    /// A contour that does not close.
    pub static MARKER_OPEN: Code = warning(Spares, Shape, "marker/open-contour", "A contour does not end where it starts; it is cut as it stands.");
    /// The same contour twice.
    pub static MARKER_TWICE: Code = warning(Spoils, Shape, "marker/contour-twice", "The same contour stands twice in the file and would be cut twice.");
    /// Equal points in a row.
    pub static MARKER_EQUAL_POINTS: Code = warning(Spares, Shape, "marker/equal-points", "Points that repeat the one before them were dropped; the message gives their count.");
    /// A slit again.
    pub static MARKER_SLIT_TWICE: Code = warning(Spares, Shape, "marker/slit-twice", "The same slit stands twice in a piece; it is cut once.");
    /// A slit without length.
    pub static MARKER_SLIT_NO_LENGTH: Code = warning(Spares, Shape, "marker/slit-no-length", "A slit ends where it starts: nothing is cut there.");
    /// A contour that is one place.
    pub static MARKER_NO_LENGTH: Code = warning(Spares, Shape, "marker/no-length", "All points of a contour are the same place: nothing is cut there.");
    /// Contours of a piece that cross.
    pub static MARKER_SELF_CROSSING: Code = warning(Spoils, Shape, "marker/self-crossing", "A contour crosses itself, or another one of its piece: the knife cuts through what was cut before, and the part has loose corners.");
    /// Contours of two pieces that cross.
    pub static MARKER_OVERLAPPING: Code = warning(Spoils, Shape, "marker/overlapping-pieces", "The outlines of two pieces overlap: each is cut into the other. Pieces that only touch are no such case.");
    /// A notch that stands out into another piece.
    pub static MARKER_NOTCH_OVER: Code = warning(Spoils, Shape, "marker/notch-over-piece", "A notch that stands out of its part lies over another piece, which is cut into; the message says how deep.");
    /// A hole in no part.
    pub static MARKER_DRILL_OUTSIDE: Code = warning(Spoils, Shape, "marker/drill-outside", "A hole is drilled where no part is: in the waste or in a cut-out.");
    /// Outlines that cannot be told from cut-outs.
    pub static MARKER_TOO_MANY: Code = error(Shape, "marker/too-many-outlines", "So many outlines lie in or over one another that the search for which lies in which was ended: parts would be cut before their cut-outs.");
    /// A search that was not brought to its end.
    pub static MARKER_SEARCH_ENDED: Code = warning(Spoils, Shape, "marker/search-ended", "So many lines lie near one another that a search was ended; the message says for what.");
    /// Numbers that start again.
    pub static MARKER_NUMBER_TWICE: Code = warning(Spares, Shape, "marker/piece-number-twice", "The number of a piece comes again: two jobs may stand in one file, and both are cut.");

    // The choice of pieces.
    /// A number that no piece has.
    pub static SELECT_UNKNOWN_PIECE: Code = error(Shape, "select/unknown-piece", "A piece number that was asked for is not in the file; the message names the flag, the hint the numbers that there are.");
    /// Nothing is chosen.
    pub static SELECT_NOTHING_LEFT: Code = error(Shape, "select/nothing-left", "The options that choose pieces leave nothing to cut.");

    // The knife's way.
    /// A smooth closed contour too small for the blade.
    pub static PATH_TIGHT: Code = warning(Spoils, Shape, "path/tight-contour", "A smooth closed contour is narrower than the blade; it is cut all the same.");
    /// A cut that begins on a curve from which the blade's body lies away.
    pub static PATH_BOWED_PLUNGE: Code = warning(Spoils, Shape, "path/bowed-plunge", "A cut begins on a curve, and the body of the plunged blade cuts beside it by more than `knife.max_bow_mm`.");
    /// A curve too tight for the blade.
    pub static PATH_TIGHT_CURVE: Code = warning(Spoils, Shape, "path/tight-curve", "A curve is tighter than the blade, which would stand across it: it is cut along the tangent, or nibbled, as `knife.tight_curves` says.");
    /// The same, refused.
    pub static PATH_TIGHT_CURVE_REFUSED: Code = error(Shape, "path/tight-curve-refused", "A curve is tighter than the blade, and `knife.tight_curves` is \"refuse\".");
    /// Overlaps that the gap between parts does not hold.
    pub static PATH_SHORTENED: Code = warning(Spares, Shape, "path/overlap-shortened", "The gap beside a part is narrower than the overlaps; they are shortened so that they stay out of the next part.");
    /// A blade longer than its cut, with nowhere to go.
    pub static PATH_OVERCUT: Code = warning(Spoils, Shape, "path/overcut", "The blade is longer than a short cut and there is no waste at its ends: it cuts past them, where that harms least.");
    /// A slit that the profile makes deeper than its part is wide.
    pub static PATH_NOTCH_THROUGH: Code = error(Shape, "path/notch-through", "A slit that `notch.depth_mm` makes deeper than it is drawn would cut through its part.");
    /// A run that winds C past its range.
    pub static PATH_C_RANGE: Code = error(Shape, "path/c-range", "A run winds the C axis past `c.range_deg` however it is entered and wherever it is parted.");
    /// Off the table, by a hair.
    pub static MARKER_OVER_EDGE: Code = warning(Spares, Shape, "marker/over-the-edge", "The marker or the knife's way leaves the table of the profile, by a millimetre at the most.");
    /// Off the table.
    pub static MARKER_OFF_TABLE: Code = error(Shape, "marker/off-table", "The marker leaves the table of the profile by more than a millimetre; the hint says how to move it.");

    // Motion.
    /// No curve inside the tube.
    pub static PLAN_SMOOTH: Code = error(Shape, "plan/smooth", "No smooth curve was found inside the tolerance of a run; a larger `path.tolerance_mm` or a smaller `corner.angle_deg` helps.");
    /// No motion within the limits.
    pub static PLAN_PROFILE: Code = error(Shape, "plan/profile", "No motion within the limits was found for a run.");
    /// The samples break a limit.
    pub static PLAN_CHORD: Code = error(Shape, "plan/chord", "The blade cannot be a chord of the smooth curve of a run, although it can be one of its points; the tangent law cuts it.");
    /// The samples break a limit.
    pub static PLAN_CERTIFY: Code = error(Shape, "plan/certify", "The samples of a run break a limit of the profile however far it is slowed down.");

    // Verification.
    /// A target that cannot say it.
    pub static TARGET_REFUSED: Code = error(Shape, "target/refused", "The target cannot express something that the marker or the options ask for; the message says what.");
    /// A rule does not hold.
    pub static VERIFY_BROKEN: Code = error(Shape, "verify/broken", "The program, read back, breaks a rule; the message names the rule, the worst value, the limit, the time and the place.");

    // Machine profile.
    /// The TOML is broken.
    pub static PROFILE_SYNTAX: Code = error(Text, "profile/syntax", "The profile is not valid TOML.");
    /// A key that does not exist.
    pub static PROFILE_UNKNOWN_KEY: Code = error(Text, "profile/unknown-key", "The profile has a key that does not exist; the message names the nearest one.");
    /// A value of the wrong type.
    pub static PROFILE_TYPE: Code = error(Text, "profile/type", "A value of the profile has the wrong type.");
    /// A value out of its range.
    pub static PROFILE_RANGE: Code = error(Text, "profile/range", "A value of the profile is out of its range.");
}

pub use table::*;

/// Every code, in the order of the README.
pub static ALL: &[&Code] = &[
    &SOURCE_EMPTY,
    &SOURCE_TOO_LARGE,
    &SOURCE_UNKNOWN,
    &SOURCE_NO_PLOT,
    &ISO_SYNTAX,
    &ISO_NO_VALUE,
    &ISO_FAR_PLACE,
    &ISO_FRAME,
    &ISO_OVERFLOW,
    &ISO_OPEN_SLIT,
    &ISO_KNIFE_DOWN_TWICE,
    &ISO_PIECE_KNIFE_DOWN,
    &ISO_UNCUT_PLACES,
    &ISO_ENDS_KNIFE_DOWN,
    &ISO_NO_FINAL_ASTERISK,
    &ISO_NO_END,
    &ISO_UNKNOWN_CODE,
    &ISO_IGNORED_CODE,
    &ISO_UNITS_CHANGED,
    &ISO_UNIT_DOUBTFUL,
    &ISO_ARC_RADIUS,
    &ISO_TRAILER_PIECE,
    &ISO_NO_POSITION,
    &ISO_DRILL_KNIFE_DOWN,
    &ISO_NOTHING_TO_CUT,
    &HPGL_NOT_A_PLOT,
    &HPGL_OVERFLOW,
    &HPGL_PE_DAMAGED,
    &HPGL_PE_OPEN,
    &HPGL_PE_REPAIRED,
    &HPGL_OPEN_LABEL,
    &HPGL_JUNK,
    &HPGL_ODD,
    &HPGL_UNKNOWN,
    &HPGL_LEFT_OUT,
    &HPGL_SCALE,
    &HPGL_PAGES,
    &HPGL_FAR_PLACE,
    &HPGL_CURVES,
    &HPGL_PLACE_UNKNOWN,
    &HPGL_NO_PEN,
    &HPGL_UNIT_DOUBTFUL,
    &HPGL_ENDS_IN_POLYGON,
    &DRAWING_CUT_SHORT,
    &DRAWING_TOO_MANY,
    &DRAWING_NOTHING_TO_CUT,
    &DRAWING_MAY_BE_FRAME,
    &DRAWING_OPEN_OUTLINES,
    &DRAWING_FRAME,
    &DRAWING_INNER_LINES,
    &DRAWING_SMALL_OUTLINES,
    &DRAWING_SEARCH_ENDED,
    &CSV_HEADER,
    &CSV_ROW,
    &CSV_NO_LENGTH,
    &CSV_NOTHING_TO_CUT,
    &MARKER_OPEN,
    &MARKER_TWICE,
    &MARKER_EQUAL_POINTS,
    &MARKER_SLIT_TWICE,
    &MARKER_SLIT_NO_LENGTH,
    &MARKER_NO_LENGTH,
    &MARKER_SELF_CROSSING,
    &MARKER_OVERLAPPING,
    &MARKER_NOTCH_OVER,
    &MARKER_DRILL_OUTSIDE,
    &MARKER_TOO_MANY,
    &MARKER_SEARCH_ENDED,
    &MARKER_NUMBER_TWICE,
    &SELECT_UNKNOWN_PIECE,
    &SELECT_NOTHING_LEFT,
    &PATH_TIGHT,
    &PATH_BOWED_PLUNGE,
    &PATH_TIGHT_CURVE,
    &PATH_TIGHT_CURVE_REFUSED,
    &PATH_SHORTENED,
    &PATH_OVERCUT,
    &PATH_NOTCH_THROUGH,
    &PATH_C_RANGE,
    &MARKER_OVER_EDGE,
    &MARKER_OFF_TABLE,
    &PLAN_SMOOTH,
    &PLAN_PROFILE,
    &PLAN_CHORD,
    &PLAN_CERTIFY,
    &TARGET_REFUSED,
    &VERIFY_BROKEN,
    &PROFILE_SYNTAX,
    &PROFILE_UNKNOWN_KEY,
    &PROFILE_TYPE,
    &PROFILE_RANGE,
];

/// The code of that name.
pub fn find(name: &str) -> Option<&'static Code> {
    ALL.iter().copied().find(|code| code.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_listed_once() {
        let declared = include_str!("code.rs").matches("pub static").count() - 2; // ALL, and this very line
        assert_eq!(declared, ALL.len());
        for (i, code) in ALL.iter().enumerate() {
            assert!(ALL[..i].iter().all(|other| other.name != code.name), "{} stands twice", code.name);
            let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '/';
            assert!(code.name.chars().all(kebab) && code.name.matches('/').count() == 1, "{}", code.name);
            assert!(code.about.ends_with('.'), "{}", code.name);
        }
    }
}
