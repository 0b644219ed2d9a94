//! A picture of a pattern, to scale: needle points, threads coloured by speed, jumps, trims, stops.

use std::io::{self, Write};

use super::markup::{color, extent, mm, path, speeds};
use super::target::{Target, Writer};
use crate::geom::Point;
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::stitches::Op;
use crate::units::number::exact;

pub(super) const TARGET: Target = Target {
    name: "svg",
    about: "a picture to scale: needle points, jumps, trims, the speed by colour",
    extension: "svg",
    emit: Writer::of_all(write),
    proof: None,
};

/// Free space around the pattern, mm; the legend stands in it.
const MARGIN: f64 = 12.0;
/// From the left edge to the legend, mm.
const LEGEND_MARGIN: f64 = 3.0;
/// Radius of a needle point, mm.
const NEEDLE: f64 = 0.3;
/// Rows of the legend.
const LEGEND: [(&str, &str); 4] =
    [("needle", "needle point"), ("jump", "jump, needle up"), ("trim", "thread cut"), ("stop", "stop or other thread")];

fn write(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    let extent = extent(program);
    let range = speeds(program, job);
    // The legend has room beside a small pattern, too.
    let width = (extent.max.x - extent.min.x + 2.0 * MARGIN).max(legend_width());
    let height = extent.max.y - extent.min.y + 2.0 * MARGIN;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">",
        mm(width),
        mm(height),
        mm(extent.min.x - MARGIN),
        // Y of the machine goes up.
        mm(-extent.max.y - MARGIN)
    )?;
    writeln!(
        out,
        "<style>path{{fill:none;stroke-width:.35}}.needle{{fill:#222}}.jump{{stroke:#888;stroke-dasharray:1 1;stroke-width:.25}}\
         .trim{{fill:#d60;stroke:none}}.stop{{fill:none;stroke:#a0a;stroke-width:.4}}text{{font:3px sans-serif}}</style>"
    )?;
    writeln!(
        out,
        "<rect x=\"{}\" y=\"{}\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
        mm(extent.min.x - MARGIN),
        mm(-extent.max.y - MARGIN)
    )?;
    writeln!(out, "<g transform=\"scale(1,-1)\">")?;
    threads(program, job, range, out)?;
    marks(program, out)?;
    writeln!(out, "</g>")?;
    legend(extent.min, -extent.max.y, range, out)?;
    writeln!(out, "</svg>")
}

/// Stitches of one speed in a row are a path, jumps one each.
fn threads(program: &Program, job: &Job, range: [f64; 2], out: &mut dyn Write) -> io::Result<()> {
    let mut line: Vec<Point> = Vec::new();
    let mut speed = 0.0;
    let end = |line: &mut Vec<Point>, speed: f64, out: &mut dyn Write| {
        let points = std::mem::take(line);
        if points.len() < 2 {
            return Ok(());
        }
        let data = path(points);
        writeln!(
            out,
            "<path stroke=\"{}\" d=\"{data}\"><title>{} rpm</title></path>",
            color(speed, range),
            exact(speed)
        )
    };
    for entry in program.moves(job) {
        if entry.rpm != speed {
            end(&mut line, speed, out)?;
            speed = entry.rpm;
        }
        match entry.step.op {
            Op::Stitch => {
                if line.is_empty() {
                    line.push(entry.from);
                }
                line.push(entry.step.to);
            }
            Op::Jump => writeln!(out, "<path class=\"jump\" d=\"{}\"/>", path([entry.from, entry.step.to]))?,
            Op::Trim | Op::Stop | Op::Color(_) => {}
        }
    }
    end(&mut line, speed, out)
}

/// Needle points, trims and stops, over the threads.
fn marks(program: &Program, out: &mut dyn Write) -> io::Result<()> {
    for (step, entry) in program.stitches.steps.iter().zip(1..) {
        let (x, y) = (mm(step.to.x), mm(step.to.y));
        match step.op {
            Op::Stitch => writeln!(
                out,
                "<circle class=\"needle\" cx=\"{x}\" cy=\"{y}\" r=\"{NEEDLE}\"><title>{entry}</title></circle>"
            )?,
            Op::Jump => {}
            Op::Trim => writeln!(out, "<circle class=\"trim\" cx=\"{x}\" cy=\"{y}\" r=\"0.6\"/>")?,
            Op::Stop | Op::Color(_) => writeln!(out, "<circle class=\"stop\" cx=\"{x}\" cy=\"{y}\" r=\"1.1\"/>")?,
        }
    }
    Ok(())
}

/// Room for a mark and its text, mm.
fn row_width(text: &str) -> f64 {
    4.0 + 1.75 * text.len() as f64
}

/// Room for the legend and its margins, mm.
fn legend_width() -> f64 {
    2.0 * LEGEND_MARGIN + LEGEND.iter().map(|(_, text)| row_width(text)).sum::<f64>()
}

/// Legend of the marks, and of the colours of least and greatest speed.
fn legend(corner: Point, top: f64, range: [f64; 2], out: &mut dyn Write) -> io::Result<()> {
    let (mut x, y) = (corner.x - MARGIN + LEGEND_MARGIN, top - MARGIN + 4.0);
    for (class, text) in LEGEND {
        if class == "jump" {
            writeln!(out, "<path class=\"jump\" d=\"M{},{} h3\"/>", mm(x - 1.5), mm(y - 1.0))?;
        } else {
            writeln!(out, "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\".8\"/>", mm(x), mm(y - 1.0))?;
        }
        writeln!(out, "<text x=\"{}\" y=\"{}\">{text}</text>", mm(x + 2.2), mm(y))?;
        x += row_width(text);
    }
    let mut x = corner.x - MARGIN + LEGEND_MARGIN;
    for rpm in range {
        writeln!(out, "<path stroke=\"{}\" d=\"M{},{} h3\"/>", color(rpm, range), mm(x - 1.5), mm(y + 3.6))?;
        writeln!(out, "<text x=\"{}\" y=\"{}\">{} rpm</text>", mm(x + 2.2), mm(y + 4.6), exact(rpm))?;
        x += 22.0;
    }
    Ok(())
}
