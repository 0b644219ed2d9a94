//! Target `svg`: the marker and the work of the knife on it, drawn to scale.
//!
//! One user unit is a millimetre. The drawing itself stands in table coordinates (a transform turns Y up), so every number in
//! it is one of the program; text and legend stand outside that transform. Strokes keep their width on the screen at any zoom,
//! and symbols scale with the blade: the whole picture shows pieces, a corner shows its overlaps.
//!
//! Layers from the bottom: lines of a plot that are not cut, pieces with their notches and numbers, labels, the path of the
//! knife (a group for each contour, notch and drill), the word `refused` where no program is written, edges that are cut once
//! for two parts, near lines, splits between windows of a conveyor, doubtful pieces, the worst places by the verifier, the
//! places of declared deviations, the legend. In a browser the picture fills the window; a piece's number is a link to a view
//! of that piece, and the legend links to the whole and to the actual size.

mod aside;
mod bites;
mod common;
mod declared;
mod doubts;
mod findings;
mod items;
mod knife;
mod label;
mod legend;
mod mark;
mod markup;
mod near;
mod piece;
mod sheet;
mod spot;

use std::io::{self, SeekFrom};

use super::target::{Context, Emit, Outcome, Output, Parts, Target, nothing};
use crate::ir::Toolpath;
use sheet::Sheet;

pub(super) const TARGET: Target = Target {
    name: "svg",
    about: "a picture to scale: pieces, labels, runs, overlaps, plunges, travels, findings",
    extension: "svg",
    emit: Emit::Picture(Parts { refusals: nothing, head, body, tail }),
    proof: None,
};

fn head(context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let sheet = Sheet::of(context, &[], Outcome::default());
    let mut text = sheet.opening();
    let mut shapes = piece::shapes(context.marker);
    let labels = label::layer(&mut shapes, &sheet, context);
    text.push_str(&sheet::style(&piece::colour_rules(&shapes)));
    text.push_str(&sheet.ground(context));
    text.push_str(&aside::layer(context));
    text.push_str(&piece::layer(&shapes, &sheet));
    text.push_str(&labels);
    text.push_str("<g id=\"knife\" inkscape:groupmode=\"layer\" inkscape:label=\"knife\" transform=\"scale(1,-1)\">\n");
    out.write_all(text.as_bytes())
}

fn body(toolpath: &Toolpath, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(knife::group(toolpath, &context.job.profile.knife).as_bytes())
}

fn tail(context: &Context, outcome: Outcome, out: &mut dyn Output) -> io::Result<()> {
    let marks = mark::marks(outcome);
    let sheet = Sheet::of(context, &marks, outcome);
    let mut text = String::from("</g>\n");
    if marks.iter().any(|mark| !mark.holds) {
        text.push_str(&sheet.refused());
    }
    text.push_str(&common::layer(context));
    text.push_str(&near::layer(context));
    text.push_str(&bites::layer(context));
    text.push_str(&doubts::layer(outcome.doubts, &sheet, context));
    text.push_str(&findings::layer(&marks, &sheet, &context.job.profile.knife));
    text.push_str(&declared::layer(outcome.declared, &sheet));
    text.push_str(&legend::layer(&sheet, context, &marks, outcome));
    text.push_str("</svg>\n");
    out.write_all(text.as_bytes())?;
    // The table of findings makes the sheet taller than the head could know.
    let (before, now) = (Sheet::of(context, &[], Outcome::default()).opening(), sheet.opening());
    if before != now && before.len() == now.len() {
        let end = out.stream_position()?;
        out.seek(SeekFrom::Start(0))?;
        out.write_all(now.as_bytes())?;
        out.seek(SeekFrom::Start(end))?;
    }
    Ok(())
}
