//! A chart of the rows against time: where each head is across the feed, thick while its knife is down, and below that how
//! far it is along the feed in its travel.

use std::io::{self, Write};

use super::markup::{color, extent, mm};
use super::target::{Emit, Target};
use crate::flow::program::{Head, Program, Setpoint};
use crate::ir::Marker;
use crate::units::number::fixed;

pub(super) const TARGET: Target = Target {
    name: "timing",
    about: "a chart of the rows against time: heads across the feed, and in their travel along it",
    extension: "svg",
    emit: Emit::Whole { stem: "rows", write },
    proof: None,
};

/// Size of the chart, px: its width, the places of its axes, and the heights of the two panels of a row.
const WIDTH: f64 = 1400.0;
const LEFT: f64 = 80.0;
const RIGHT: f64 = 20.0;
const ACROSS: f64 = 150.0;
const ALONG: f64 = 50.0;
const GAP: f64 = 34.0;
const TOP: f64 = 30.0;
/// Places of a head that are drawn, at the most.
const PLACES: u64 = 2400;

/// Marks of the time axis, at the most.
const MARKS: f64 = 12.0;

/// A chart of a program.
struct Chart<'a> {
    program: &'a Program,
    /// Time that it is wide, s.
    time: f64,
    /// Least and greatest y, mm.
    across: [f64; 2],
    /// Travel along the feed, mm.
    travel: f64,
    every: u64,
}

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let rows = program.heads.iter().map(|head| head.row + 1).max().unwrap_or(0);
    let height = TOP + rows as f64 * (ACROSS + ALONG + GAP);
    let every = program.ticks.div_ceil(PLACES).max(1);
    let ys = program.heads.iter().flat_map(|head| program.setpoints(head)).map(|setpoint| setpoint.state.y);
    let (mut least, mut most) = (extent(marker).min.y, extent(marker).max.y);
    ys.for_each(|y| (least, most) = (least.min(y), most.max(y)));
    let time = program.ticks as f64 * program.period();
    let chart = Chart { program, time, across: [least, most], travel: program.travel(), every };
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\">\n\
         <style>svg{{max-width:100%;height:auto;background:#fff}}text{{font:12px sans-serif;fill:#333}}\
         .axis{{fill:none;stroke:#999}}.mark{{text-anchor:middle}}.value{{text-anchor:end}}\
         .air{{fill:none;stroke-width:.8;opacity:.6}}.cut{{fill:none;stroke-width:3}}\
         .travel{{fill:none;stroke-width:1}}</style>\n\
         <text x=\"{LEFT}\" y=\"18\">conveyor {} mm/s, {} s; above where heads are across the feed, mm (thick: knife down), below \
         where in their travel of {} mm along it</text>",
        fixed(program.speed, 1),
        fixed(time, 1),
        fixed(chart.travel, 0)
    )?;
    for row in 0..rows {
        chart.frame(row, out)?;
        for (i, head) in program.heads.iter().enumerate().filter(|(_, head)| head.row == row) {
            chart.lines(i, head, out)?;
        }
    }
    writeln!(out, "</svg>")
}

/// The step of a scale that has no more than so many over a range: 1, 2 or 5 times a power of ten.
fn step(range: f64, most: f64) -> f64 {
    let power = 10.0_f64.powf((range / most).log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|part| part * power).into_iter().find(|step| range / step <= most).unwrap_or(range)
}

impl Chart<'_> {
    /// Top of the panels of a row, px.
    fn top(row: usize) -> f64 {
        TOP + row as f64 * (ACROSS + ALONG + GAP)
    }

    fn px(&self, time: f64) -> String {
        mm(LEFT + time / self.time * (WIDTH - LEFT - RIGHT))
    }

    /// The axes of a row.
    fn frame(&self, row: usize, out: &mut dyn Write) -> io::Result<()> {
        let top = Self::top(row);
        let [middle, base] = [top + ACROSS, top + ACROSS + ALONG];
        let right = WIDTH - RIGHT;
        writeln!(out, "<path class=\"axis\" d=\"M{LEFT},{top} V{base} H{right} M{LEFT},{middle} H{right}\"/>")?;
        writeln!(out, "<text x=\"6\" y=\"{}\">row {}</text>", top + 56.0, row + 1)?;
        writeln!(out, "<text x=\"6\" y=\"{}\">X {}</text>", top + 72.0, fixed(self.program.stations[row], 0))?;
        let values =
            [(top + 10.0, self.across[1]), (middle - 2.0, self.across[0]), (middle + 12.0, self.travel), (base, 0.0)];
        for (y, value) in values {
            writeln!(out, "<text class=\"value\" x=\"{}\" y=\"{y}\">{}</text>", LEFT - 5.0, fixed(value, 0))?;
        }
        let step = step(self.time, MARKS);
        let decimals = if step < 1.0 { 2 } else { 0 };
        for k in 0..=(self.time / step) as u32 {
            let time = f64::from(k) * step;
            let (x, text) = (self.px(time), fixed(time, decimals));
            writeln!(out, "<path class=\"axis\" d=\"M{x},{base} v4\"/>")?;
            writeln!(out, "<text class=\"mark\" x=\"{x}\" y=\"{}\">{text} s</text>", base + 16.0)?;
        }
        Ok(())
    }

    /// The lines of a head.
    fn lines(&self, i: usize, head: &Head, out: &mut dyn Write) -> io::Result<()> {
        let (top, color, [least, most]) = (Self::top(head.row), color(i), self.across);
        let across = |y: f64| mm(top + ACROSS * (most - y) / (most - least).max(1.0));
        let along = |xi: f64| mm(top + ACROSS + ALONG * (1.0 - xi / self.travel.max(1.0)));
        let mut travel = String::new();
        let mut part = String::new();
        let mut was_down = false;
        let end = |part: &mut String, down: bool, out: &mut dyn Write| {
            let class = if down { "cut" } else { "air" };
            let data = std::mem::take(part);
            writeln!(
                out,
                "<path class=\"{class}\" stroke=\"{color}\" d=\"{data}\"><title>head {}</title></path>",
                i + 1
            )
        };
        let mut last: Option<Setpoint> = None;
        for setpoint in self.program.setpoints(head) {
            let is_other = setpoint.knife != was_down;
            if !setpoint.tick.is_multiple_of(self.every) && !is_other {
                last = Some(setpoint);
                continue;
            }
            let time = self.px(setpoint.tick as f64 * self.program.period());
            let join = |data: &mut String, y: String| {
                data.push(if data.is_empty() { 'M' } else { ' ' });
                data.extend([&time, ",", &y]);
            };
            join(&mut travel, along(setpoint.state.xi));
            join(&mut part, across(setpoint.state.y));
            if is_other {
                end(&mut part, was_down, out)?;
                join(&mut part, across(last.map_or(setpoint.state.y, |last| last.state.y)));
                was_down = setpoint.knife;
            }
        }
        end(&mut part, was_down, out)?;
        writeln!(out, "<path class=\"travel\" stroke=\"{color}\" d=\"{travel}\"/>")
    }
}
