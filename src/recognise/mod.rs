//! Recognition: a [`Drawing`] to a [`Marker`]. A plot tells the lines of a pen, not the cuts of a knife.
//!
//! Receives strokes and texts with the names of their pens, from any dialect. Promises a marker like that of a cut file - parts
//! with their notches, equal places equal to the bit, texts never cut - and an account of every line: its class, and whether it
//! is cut. A wrong cut inside a part cannot be mended and a missing cut can, so nothing inside a part is cut but notches on its
//! edge, unless a pen or an option asks for it. Knows nothing of the dialect.
//!
//! - Lines: `nodes` splits loose lines where they meet, `faces` orders them by the parts that they bound, at the meetings of
//!   their ends that `meeting` finds. `again` puts strokes aside that are drawn twice. `join` makes lines (`chains`) of the
//!   others, by their `succession` where parts touch, over the gaps that `bridge` finds and without the slits that `slits` and
//!   `tails` find. `close` closes the lines, `twins` puts those aside that lie along another.
//! - Classes: `sheet` classifies the lines with the help of the others. `frame` finds the frames, `nest` the nesting of lines,
//!   `remains` and `enclosed` the outlines that are not whole, `marks` and `strokes` the notches, `signs` the arrows and crosses
//!   among them, `letters` the letters and `seam` the seam lines. `line` has the table of classes and of when each is cut, `pens`
//!   the meaning of pens, `layers` that of layers. `parts` finds the lines in parts.
//! - Results: `piece` makes the marker. `shared` refuses parts that are lost, `passed` outlines that the pen passes in the
//!   air, `torn` those whose numbers have lost a byte.
//!   `say` reports doubts about the drawing, `doubts` those about pieces, `size` sizes beyond any table.

mod again;
mod border;
mod bridge;
mod chains;
mod close;
mod doubts;
mod enclosed;
mod faces;
mod frame;
mod join;
mod layers;
mod letters;
mod line;
mod marks;
mod meeting;
mod nest;
mod nodes;
mod parts;
mod passed;
mod pens;
mod piece;
mod remains;
mod say;
mod seam;
mod shared;
mod sheet;
mod signs;
mod size;
mod slits;
mod strokes;
mod succession;
mod tails;
mod torn;
mod twins;

use self::line::Class;
use self::sheet::Sheet;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::geom::budget::Budget;
use crate::ir::Marker;
use crate::ir::drawing::Drawing;
use crate::machine::Job;
use crate::machine::plot::Inner;

/// Decides which lines of a drawing are cut, and makes the marker from them.
pub fn marker(mut drawing: Drawing, job: &Job, diagnostics: &mut Diagnostics) -> Marker {
    layers::say(&drawing.pens, job, diagnostics);
    if diagnostics.has_errors() {
        return Marker::default();
    }
    let of_layers = layers::drawn(&drawing, job);
    let uses = pens::uses(&drawing.pens, job);
    let reach = join::reach(drawing.unit);
    let divides = job.lines.inner != Some(Inner::Ignore);
    let drawn = drawing.vertices.len();
    let (in_order, again) = faces::put_in_order(&mut drawing, &uses, reach, divides);
    let laid = drawn..drawing.vertices.len();
    let shared = shared::edges(&drawing, &uses);
    let mut work = Budget::of_a_marker();
    let (mut lines, mut moved) = join::join(&mut drawing, &laid, job, &mut work);
    lines.extend(again::lines(again, &drawing, &uses));
    moved.redrawn.extend(in_order.redrawn);
    (moved.doubled, moved.repeated) = (in_order.doubled, in_order.repeated);
    close::close(&mut lines, &mut drawing.vertices, close::Reach::of(drawing.unit, job));
    twins::mark(&mut lines, &drawing.vertices, sheet::band(drawing.unit), &mut work);
    let Drawing { vertices, pens, texts, encoded, passed, unit, ending, .. } = drawing;
    let mut sheet = Sheet {
        vertices,
        lines,
        nest: Nesting::default(),
        marks: Vec::new(),
        strokes: Vec::new(),
        from_edges: Vec::new(),
        remains: Vec::new(),
        frame_doubt: None,
        pens,
        texts,
        encoded,
        passed,
        unit,
        ending,
        moved,
        is_cut_short: work.is_spent(),
    };
    sheet.sort_out(job);
    sheet.decide(job);
    twins::mark_parts(&mut sheet.lines, &sheet.vertices, sheet::band(sheet.unit), &mut work);
    shared::say_doubled(&sheet.moved.doubled, diagnostics);
    shared::refuse(&shared, &sheet.lines, &sheet.vertices, diagnostics);
    let [open, broken] = doubts::doubtful_outlines(&sheet);
    sheet.set_class(broken, Class::BrokenOutline);
    sheet.set_class(open, Class::OpenOutline);
    let open = say::open_lines(&sheet);
    sheet.set_class(open, Class::OpenLine);
    say::all(&sheet, job, diagnostics);
    piece::marker(sheet, of_layers, diagnostics)
}
