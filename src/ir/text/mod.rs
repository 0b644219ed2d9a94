//! The text form of marker and toolpath: prints and reads, so that any pass can be tested from such a text alone.
//!
//! One line a segment, point or step; lengths in mm, angles in rad under a name that says so; `;` starts a comment.
//! Every number is the shortest one that reads back as the same `f64`, so a form survives the round trip to the bit.
//!
//! ```text
//! marker unit-mm 0.1
//! piece 1 @0..3#1
//! event stop @4..7#1
//! feed-mm-s 300
//! section 0 to 385
//! drill 40 30 tool 1 @50..60#9
//! slit 20 0 to 20 5 @60..70#12 percent 75
//! slit 30 0 to 30 5 @90..96#17 bar 28 5 to 32 5 @97..99#18
//! contour closed
//!   from 0 0 to 100 0 @4..9#2
//!   to 100 80 @10..19#3 percent 75 lift full-advance no-overcut
//!   to 0 0 @20..29#4
//! notch v 59 0 to 60 5 to 61 0 segments 2 @70..80#14
//! notch castle out 79 0 to 80 -4 to 81 0 segments 3 @81..88#15
//! label at 10 10 heading-rad 0 @30..39#5 mirrored @40..44#6
//! field D @80..89#15
//! piece 2 copy 1 @84..86#16
//! closing advance @90..93#16
//! cut slit piece 1 sides 1 1
//!   from 20 0 to 20 5 @60..70#12 lift full-advance no-overcut
//! cut outline piece 1 sides 1 - contour 1
//! common cut 1 spared 2 shift-mm 0.1
//!   from 100.1 80 to 100.1 0 @90..94#20
//! junction 100 82 to 100.2 75
//! near piece 2 40 80 to 160 80
//! ```
//!
//! ```text
//! toolpath piece 1 tolerance-mm 0.05 entry 0 0 c-rad 0
//! travel 0 0 c-rad 0 to 3 0 c-rad 0
//! run open tangent front 1 heel 0.5 feed off
//!   ends corner path-bare
//!   start 3 0 c-rad 0
//!   end 99 0 c-rad 0
//!   point 0 0 full-advance
//!   point 60 0 @4..9#2 junction
//!   point 100 0 @10..19#3 lift no-overcut
//! stab along 1 0 front 1 heel 0.5 turned backwards harm 0.5 0 0.3 0.2
//!   ends corner corner
//!   sides part gap
//!   pose 3 0 c-rad 0
//!   point 0 0
//!   point 4 0 @4..9#2
//! turn 3 0 c-rad 0 to 3 0 c-rad 1.5
//! drill 40 30 tool 1 @50..60#9
//! event stop
//! ```
//!
//! `@start..end#block` is a span; without one the span is that of no block. A segment line `to` starts where the line before it
//! ends, so only the first segment of a contour has `from`. Words after a segment are the joint at its start; words after a
//! point are the requests there. A contour is printed in the direction of the cut and read as one in list order: the same
//! segments, the same joints.
//!
//! - A piece of a marker of which there are several copies names its copy, from 1.
//! - A `cut` is of the contour of its piece that it names, or of segments of its own. Its sides are the parts on its left
//!   and right, by the places of their pieces from 1, as its piece is, or `-` for waste.
//! - `common` is an edge that the first piece and the second have in common, as the second has it; it is cut with the first.
//! - A `junction` is a short way about which cuts of several parts cross; in a toolpath the word stands behind the end of a
//!   chord about which that is so.
//! - `near` is a stretch of a cut of that piece beside which one around another part runs.
//! - `moved-on` behind the unit of a marker has the way of the cloth before the program, mm.
//! - How much less is cut for all common edges, a mere figure, is not printed.
//! - A `notch` is one that the contours make: the ends of its mouth with its tip between them, and how many segments lie
//!   there.
//! - `section` has the stretch along X of the outline of a piece that is cut with it where windows of a conveyor split that.
//! - `event advance-by` has the way of the cloth behind it, whole mm.
//! - `stab` is a plunge cut; `harm` has what it cuts too far of the part itself and of others before the start, and the
//!   same past the end.
//! - `sides` stands where an end has another than `waste`, `part` behind the number of a piece that is not the first.

mod print;
mod read;

pub use print::{print_marker, print_toolpath};
pub use read::{ReadError, read_marker, read_toolpath};

use super::list::Joint;
use super::marker::{CutKind, NotchForm};
use super::toolpath::{End, Event, OrientationMode, Shape, Side};

/// Picks one flag of a joint.
type Flag = fn(&mut Joint) -> &mut bool;

/// Words of a joint, each with its flag.
const JOINTS: [(&str, Flag); 3] = [
    ("lift", |joint| &mut joint.lift),
    ("full-advance", |joint| &mut joint.full_advance),
    ("no-overcut", |joint| &mut joint.no_overcut),
];

const FORMS: [(&str, NotchForm); 3] = [("v", NotchForm::V), ("castle", NotchForm::Castle), ("u", NotchForm::U)];

const KINDS: [(&str, CutKind); 5] = [
    ("outline", CutKind::Outline),
    ("inner", CutKind::Inner),
    ("edge", CutKind::Edge),
    ("slit", CutKind::Slit),
    ("line", CutKind::Line),
];

const SHAPES: [(&str, Shape); 2] = [("open", Shape::Open), ("ring", Shape::Ring)];

const ORIENTATION_MODES: [(&str, OrientationMode); 2] =
    [("tangent", OrientationMode::Tangent), ("chord", OrientationMode::Chord)];

const ENDS: [(&str, End); 4] = [
    ("path", End { corner: false, bare: false, side: Side::Waste }),
    ("path-bare", End { corner: false, bare: true, side: Side::Waste }),
    ("corner", End { corner: true, bare: false, side: Side::Waste }),
    ("corner-bare", End { corner: true, bare: true, side: Side::Waste }),
];

const SIDES: [(&str, Side); 4] =
    [("waste", Side::Waste), ("part", Side::Part), ("gap", Side::Gap), ("contour", Side::Contour)];

/// Events of one word; `advance-by` is followed by the advance, mm.
const EVENTS: [(&str, Event); 2] = [("stop", Event::Stop), ("advance", Event::Advance)];
const ADVANCE_BY: &str = "advance-by";

#[cfg(test)]
mod tests;
