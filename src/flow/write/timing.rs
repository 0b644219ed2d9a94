//! A chart of the rows against time: where each head is across the feed, thick while its knife is down, and below that how
//! far it is along the feed in its travel.

use std::io::{self, Write};

use super::markup::{color, extent, mm};
use super::target::{Kind, Target};
use crate::flow::program::{Head, Program, Setpoint};
use crate::ir::Marker;
use crate::units::number::fixed;

pub(super) const TARGET: Target = Target {
    name: "timing",
    about: "a chart of the rows against time: heads across the feed, and in their travel along it",
    extension: "svg",
    kind: Kind::Whole { stem: "rows", write },
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

/// What a chart is drawn to.
struct Scale {
    /// Time that the chart is wide, s.
    time: f64,
    /// Least and greatest y, mm.
    across: [f64; 2],
    /// Travel along the feed, mm.
    travel: f64,
    every: u64,
}

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let rows = program.heads.iter().map(|head| head.row + 1).max().unwrap_or(0);
    let height = TOP + rows as f64 * (ACROSS + ALONG + GAP) + GAP;
    let every = program.ticks.div_ceil(PLACES).max(1);
    let ys = program.heads.iter().flat_map(|head| program.setpoints(head)).map(|setpoint| setpoint.state.y);
    let (mut least, mut most) = (extent(marker).min.y, extent(marker).max.y);
    ys.for_each(|y| (least, most) = (least.min(y), most.max(y)));
    let time = program.ticks as f64 * program.period();
    let scale = Scale { time, across: [least, most], travel: program.travel(), every };
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\">\n\
         <style>text{{font:12px sans-serif}}.axis{{fill:none;stroke:#999}}.air{{fill:none;stroke-width:.8;opacity:.6}}\
         .cut{{fill:none;stroke-width:3}}.travel{{fill:none;stroke-width:1}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"18\">conveyor {} mm/s, {} s; heads across the feed (thick: knife down), below in their travel of {} mm</text>",
        fixed(program.speed, 1),
        fixed(time, 1),
        fixed(scale.travel, 0)
    )?;
    for row in 0..rows {
        let top = TOP + row as f64 * (ACROSS + ALONG + GAP);
        frame(program, row, top, &scale, out)?;
        for (i, head) in program.heads.iter().enumerate().filter(|(_, head)| head.row == row) {
            lines(program, i, head, top, &scale, out)?;
        }
    }
    writeln!(out, "</svg>")
}

fn px(time: f64, scale: &Scale) -> String {
    mm(LEFT + time / scale.time * (WIDTH - LEFT - RIGHT))
}

/// The axes of a row.
fn frame(program: &Program, row: usize, top: f64, scale: &Scale, out: &mut dyn Write) -> io::Result<()> {
    let [middle, base] = [top + ACROSS, top + ACROSS + ALONG];
    let right = WIDTH - RIGHT;
    writeln!(out, "<path class=\"axis\" d=\"M{LEFT},{top} V{base} H{right} M{LEFT},{middle} H{right}\"/>")?;
    writeln!(out, "<text x=\"6\" y=\"{}\">row {}</text>", top + 26.0, row + 1)?;
    writeln!(out, "<text x=\"6\" y=\"{}\">X {} mm</text>", top + 42.0, fixed(program.stations[row], 0))?;
    for (y, text) in [(top + 10.0, scale.across[1]), (middle - 2.0, scale.across[0])] {
        writeln!(out, "<text x=\"{}\" y=\"{y}\">{}</text>", LEFT - 34.0, fixed(text, 0))?;
    }
    for k in 0..=10 {
        let time = scale.time * f64::from(k) / 10.0;
        writeln!(out, "<text x=\"{}\" y=\"{}\">{} s</text>", px(time, scale), base + 14.0, fixed(time, 1))?;
    }
    Ok(())
}

/// The lines of a head.
fn lines(program: &Program, i: usize, head: &Head, top: f64, scale: &Scale, out: &mut dyn Write) -> io::Result<()> {
    let color = color(i);
    let [least, most] = scale.across;
    let across = |y: f64| mm(top + ACROSS * (most - y) / (most - least).max(1.0));
    let along = |xi: f64| mm(top + ACROSS + ALONG * (1.0 - xi / scale.travel.max(1.0)));
    let mut travel = String::new();
    let mut part = String::new();
    let mut was_down = false;
    let end = |part: &mut String, down: bool, out: &mut dyn Write| {
        let class = if down { "cut" } else { "air" };
        let data = std::mem::take(part);
        writeln!(out, "<path class=\"{class}\" stroke=\"{color}\" d=\"{data}\"><title>head {}</title></path>", i + 1)
    };
    let mut last: Option<Setpoint> = None;
    for setpoint in program.setpoints(head) {
        let is_other = setpoint.knife != was_down;
        if !setpoint.tick.is_multiple_of(scale.every) && !is_other {
            last = Some(setpoint);
            continue;
        }
        let time = px(setpoint.tick as f64 * program.period(), scale);
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
