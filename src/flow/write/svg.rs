//! A picture of the cloth, to scale: which head cuts which chain, where each starts, and which way the cloth moves.

use std::io::{self, Write};

use super::markup::{color, extent, mm, path};
use super::target::{Kind, Target};
use crate::flow::program::Program;
use crate::ir::Marker;
use crate::units::number::fixed;

pub(super) const TARGET: Target = Target {
    name: "svg",
    about: "a picture of the cloth to scale: the chains, coloured by head",
    extension: "svg",
    kind: Kind::Whole { stem: "chains", write },
};

/// Free space around the cuts, mm; the legend stands above them.
const MARGIN: f64 = 40.0;
/// Height of a line of the legend, mm, and the width of an entry.
const LINE: f64 = 22.0;
const ENTRY: f64 = 190.0;

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let extent = extent(marker);
    let (width, height) = extent.size();
    let (width, height) = (width.max(ENTRY) + 2.0 * MARGIN, height + 2.0 * MARGIN);
    let columns = ((width / ENTRY) as usize).max(1);
    let legend = (program.heads.len().div_ceil(columns) as f64 + 1.0) * LINE;
    let (left, top) = (extent.min.x - MARGIN, -extent.max.y - MARGIN - legend);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n\
         <style>path{{fill:none;stroke-width:1.6}}text{{font:13px sans-serif}}.number{{font-size:11px;fill:#fff;\
         text-anchor:middle}}.feed{{stroke:#555;stroke-width:2}}</style>\n\
         <rect x=\"{2}\" y=\"{3}\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
        mm(width),
        mm(height + legend),
        mm(left),
        mm(top)
    )?;
    for (i, head) in program.heads.iter().enumerate() {
        let color = color(i);
        for (task, start) in head.tasks.iter().enumerate() {
            let stroke = &program.strokes[start.task];
            let seconds = program
                .chain(head, task)
                .0
                .map(|tick| fixed((tick + program.origin(head.row)) as f64 * program.period(), 2));
            writeln!(
                out,
                "<path transform=\"scale(1,-1)\" stroke=\"{color}\" d=\"{}\"><title>head {}, row {}: piece {}, cut {}, {} to {} s</title></path>",
                path(stroke.points.iter().copied()),
                i + 1,
                head.row + 1,
                stroke.piece[0],
                stroke.cut + 1,
                seconds[0],
                seconds[1]
            )?;
        }
        for start in &head.tasks {
            let at = program.strokes[start.task].points[0];
            let (x, y) = (mm(at.x), mm(-at.y));
            writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"8\" fill=\"{color}\"/>")?;
            writeln!(out, "<text class=\"number\" x=\"{x}\" y=\"{}\">{}</text>", mm(4.0 - at.y), i + 1)?;
        }
        let (column, line) = (i % columns, i / columns);
        let (x, y) = (left + MARGIN + column as f64 * ENTRY, top + (line as f64 + 2.0) * LINE);
        writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" fill=\"{color}\">head {}, row {}: {}</text>",
            mm(x),
            mm(y),
            i + 1,
            head.row + 1,
            head.tasks.len()
        )?;
    }
    feed(program, left + MARGIN, top + LINE, out)?;
    writeln!(out, "</svg>")
}

/// Which way the cloth moves, and how fast.
fn feed(program: &Program, x: f64, y: f64, out: &mut dyn Write) -> io::Result<()> {
    /// Length of the arrow, and of its head, mm.
    const ARROW: [f64; 2] = [60.0, 8.0];
    let (tip, level) = (x + ARROW[0], y - ARROW[1] / 2.0);
    writeln!(
        out,
        "<path class=\"feed\" d=\"M{},{level} H{tip} l{},{} m{},{} l{},{}\"/>\n<text x=\"{}\" y=\"{y}\">the cloth moves this way at {} mm/s; numbers of heads where their chains start, with how many each cuts</text>",
        mm(x),
        -ARROW[1],
        -ARROW[1] / 2.0,
        ARROW[1],
        ARROW[1] / 2.0,
        -ARROW[1],
        ARROW[1] / 2.0,
        mm(tip + ARROW[1]),
        fixed(program.speed, 1),
        level = mm(level),
        tip = mm(tip),
        y = mm(y),
    )
}
