//! A picture of the cloth, to scale: which head cuts which chain, where each starts, and which way the cloth moves.

use std::io::{self, Write};

use super::markup::{color, extent, mm, path};
use super::target::{Emit, Target};
use crate::flow::program::Program;
use crate::ir::Marker;
use crate::units::MM_PER_INCH;
use crate::units::number::{counted, fixed};

pub(super) const TARGET: Target = Target {
    name: "svg",
    about: "a picture of the cloth to scale: the chains, coloured by head",
    extension: "svg",
    emit: Emit::Whole { stem: "chains", write },
    proof: None,
};

/// Window in which the whole picture should be readable, pixels, and the least size of one, mm: that of a browser.
const WINDOW_PX: [f64; 2] = [1400.0, 800.0];
const LEAST_PX: f64 = MM_PER_INCH / 96.0;
/// Free space around the cuts, pixels; the legend stands above them.
const MARGIN_PX: f64 = 40.0;
/// Height of a line of the legend, and the width of an entry, pixels.
const LINE_PX: f64 = 22.0;
const ENTRY_PX: f64 = 190.0;
/// Sizes of text, of the number of a head and of the disc behind that, pixels.
const TEXT_PX: f64 = 14.0;
const NUMBER_PX: f64 = 11.0;
const DISC_PX: f64 = 8.0;

/// Layout of the picture: mm, Y down.
struct Sheet {
    /// A nominal pixel, mm.
    px: f64,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    /// Entries of a line of the legend.
    columns: usize,
}

impl Sheet {
    fn of(program: &Program, marker: &Marker) -> Self {
        let extent = extent(marker);
        let (w, h) = extent.size();
        let px = (w / WINDOW_PX[0]).max(h / WINDOW_PX[1]).max(LEAST_PX);
        let (margin, entry) = (MARGIN_PX * px, ENTRY_PX * px);
        // The line on top tells what the picture shows: that takes some entries' width.
        let width = (w + 2.0 * margin).max(4.0 * entry);
        let columns = ((width - margin) / entry).floor().max(1.0) as usize;
        let legend = (program.heads.len().div_ceil(columns) as f64 + 2.0) * LINE_PX * px;
        let height = h + 2.0 * margin + legend;
        Self { px, left: extent.min.x - margin, top: -extent.max.y - margin - legend, width, height, columns }
    }

    /// Place of an entry of the legend; the first line tells the feed.
    fn entry(&self, i: usize) -> [f64; 2] {
        let (column, line) = (i % self.columns, i / self.columns);
        let x = self.left + (MARGIN_PX + column as f64 * ENTRY_PX) * self.px;
        [x, self.top + (line as f64 + 2.5) * LINE_PX * self.px]
    }
}

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let sheet = Sheet::of(program, marker);
    let size = |pixels: f64| mm(pixels * sheet.px);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n\
         <style>svg{{max-width:100vw;max-height:100vh;background:#fff}}path{{fill:none;stroke-width:1.6;\
         vector-effect:non-scaling-stroke}}text{{font:{4}px sans-serif;fill:#333}}.number{{font-size:{5}px;fill:#fff;\
         text-anchor:middle}}.feed{{stroke:#555;stroke-width:2}}</style>",
        mm(sheet.width),
        mm(sheet.height),
        mm(sheet.left),
        mm(sheet.top),
        size(TEXT_PX),
        size(NUMBER_PX),
    )?;
    for i in 0..program.heads.len() {
        chains(program, i, out)?;
    }
    for (i, head) in program.heads.iter().enumerate() {
        let color = color(i);
        for start in &head.tasks {
            let at = program.strokes[start.task].points[0];
            let (x, y) = (mm(at.x), mm(-at.y));
            writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\" fill=\"{color}\"/>", size(DISC_PX))?;
            let base = mm(NUMBER_PX * sheet.px / 3.0 - at.y);
            writeln!(out, "<text class=\"number\" x=\"{x}\" y=\"{base}\">{}</text>", i + 1)?;
        }
        let [x, y] = sheet.entry(i).map(mm);
        let chains = counted(head.tasks.len(), "chain");
        writeln!(
            out,
            "<text x=\"{x}\" y=\"{y}\" style=\"fill:{color}\">head {}, row {}: {chains}</text>",
            i + 1,
            head.row + 1
        )?;
    }
    feed(program, &sheet, out)?;
    writeln!(out, "</svg>")
}

/// The chains of a head.
fn chains(program: &Program, i: usize, out: &mut dyn Write) -> io::Result<()> {
    let (head, color) = (&program.heads[i], color(i));
    for (task, start) in head.tasks.iter().enumerate() {
        let stroke = &program.strokes[start.task];
        let time = |tick: i64| fixed((tick + program.origin(head.row)) as f64 * program.period(), 2);
        let [from, to] = program.chain(head, task).0.map(time);
        writeln!(
            out,
            "<path transform=\"scale(1,-1)\" stroke=\"{color}\" d=\"{}\"><title>head {}, row {}: piece {}, cut {}, {from} to \
             {to} s</title></path>",
            path(stroke.points.iter().copied()),
            i + 1,
            head.row + 1,
            stroke.piece[0],
            stroke.cut + 1,
        )?;
    }
    Ok(())
}

/// Direction and speed of the cloth.
fn feed(program: &Program, sheet: &Sheet, out: &mut dyn Write) -> io::Result<()> {
    /// Length of the arrow, and of its head, pixels.
    const ARROW_PX: [f64; 2] = [60.0, 8.0];
    let [arrow, wing] = ARROW_PX.map(|pixels| pixels * sheet.px);
    let (x, y) = (sheet.left + MARGIN_PX * sheet.px, sheet.top + 1.2 * LINE_PX * sheet.px);
    let (tip, level) = (x + arrow, y - TEXT_PX * sheet.px / 3.0);
    writeln!(
        out,
        "<path class=\"feed\" d=\"M{},{level} H{tip} l{},{} m{},{} l{},{}\"/>\n<text x=\"{}\" y=\"{}\">the cloth moves this way at {} mm/s; a disc is where a chain starts, its number the head</text>",
        mm(x),
        mm(-wing),
        mm(-wing / 2.0),
        mm(wing),
        mm(wing / 2.0),
        mm(-wing),
        mm(wing / 2.0),
        mm(tip + wing),
        mm(y),
        fixed(program.speed, 1),
        level = mm(level),
        tip = mm(tip),
    )
}
