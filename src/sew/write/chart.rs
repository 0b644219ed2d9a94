//! A picture of three stitches in time, at two speeds: angle of the spindle, window, rates of the pulses of X and Y.
//!
//! The stitches are those of the program with the longest total motion: these decide about its speed. Above they are drawn at
//! the speed of their run, below at two thirds of it.

use std::io::{self, Write};

use super::target::{Target, Writer};
use crate::machine::{Job, Sewing};
use crate::sew::program::{Move, Program};
use crate::sew::stitches::Op;
use crate::units::number::{exact, fixed};
use crate::units::{MS_PER_S, S_PER_MIN};

pub(super) const TARGET: Target = Target {
    name: "timing",
    about: "a picture of three stitches in time at two speeds: spindle, window, pulse rates of X and Y",
    extension: "timing.svg",
    emit: Writer::of_all(write),
    proof: None,
};

/// Stitches that are shown.
const SHOWN: usize = 3;
/// The lower speed, as a part of that of the run.
const SLOWER: f64 = 2.0 / 3.0;
/// Sizes, px: of the picture, and of a panel's rows.
const WIDTH: f64 = 1000.0;
const HEIGHT: f64 = 660.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 20.0;
const ANGLE_HEIGHT: f64 = 70.0;
const RATE_HEIGHT: f64 = 160.0;
const GAP: f64 = 20.0;
/// Hertz in a kilohertz.
const HZ_PER_KHZ: f64 = 1000.0;
const TURN_DEG: f64 = 360.0;

fn write(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    let sewing = &job.profile.sewing;
    let shown = shown(program, job);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\">\n\
         <style>text{{font:13px sans-serif}}.small{{font-size:11px;fill:#555}}.window{{fill:#cfe8cf}}.axis{{stroke:#999;fill:none}}\
         .angle{{stroke:#444;fill:none;stroke-width:1.5}}.x{{stroke:#c22;fill:none;stroke-width:1.6}}.y{{stroke:#22c;fill:none;stroke-width:1.6}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>"
    )?;
    let Some(rpm) = shown.iter().map(|entry| entry.rpm).reduce(f64::min) else {
        return writeln!(out, "<text x=\"{LEFT}\" y=\"40\">no stitches</text>\n</svg>");
    };
    let slower = (rpm * SLOWER).round();
    let slow: Vec<Move> = shown.iter().map(|entry| Move { rpm: slower, ..*entry }).collect();
    let fast: Vec<Move> = shown.iter().map(|entry| Move { rpm, ..*entry }).collect();
    let most = peak(&fast, sewing).max(peak(&slow, sewing));
    // Both on one scale of time, so that they can be compared.
    let time = SHOWN as f64 * S_PER_MIN / slower;
    Panel { sewing, top: 30.0, time, most }.draw(&fast, out)?;
    Panel { sewing, top: 345.0, time, most }.draw(&slow, out)?;
    writeln!(out, "</svg>")
}

/// The stitches that are shown: three in a row of one run and speed, those with the longest way.
fn shown<'a>(program: &'a Program, job: &'a Job) -> Vec<Move<'a>> {
    let moves: Vec<Move> = program.moves(job).collect();
    let is_run = |three: &&[Move]| {
        three.iter().all(|entry| entry.step.op == Op::Stitch && entry.rpm == three[0].rpm && !entry.step.is_tie)
    };
    let way = |three: &[Move]| three.iter().map(|entry| (entry.step.to - entry.from).norm()).sum::<f64>();
    // Of equal ones the first, without a soft start where there is another.
    let best =
        moves.windows(SHOWN).filter(is_run).reduce(|best, three| if way(three) > way(best) { three } else { best });
    let all = || moves.iter().copied().filter(|entry| entry.step.op == Op::Stitch).take(SHOWN).collect();
    best.map_or_else(all, <[Move]>::to_vec)
}

/// The rates of an axis in time: between two pulses the inverse of their interval, s and Hz.
fn rates(entry: &Move, axis: usize, sewing: &Sewing) -> Vec<(f64, f64, f64)> {
    let mut last = 0.0;
    let rate = |time: f64| {
        let row = (last, time, 1.0 / (time - last));
        last = time;
        row
    };
    entry.trains(sewing)[axis].times().map(rate).collect()
}

fn peak(entries: &[Move], sewing: &Sewing) -> f64 {
    let rates = entries.iter().flat_map(|entry| [0, 1].map(|axis| rates(entry, axis, sewing))).flatten();
    rates.map(|(.., rate)| rate).fold(0.0, f64::max)
}

/// Place and scales of a drawing of three stitches.
#[derive(Clone, Copy)]
struct Panel<'a> {
    sewing: &'a Sewing,
    /// Its upper edge, px.
    top: f64,
    /// The time that the picture is wide, s.
    time: f64,
    /// The greatest rate, Hz.
    most: f64,
}

impl Panel<'_> {
    /// Of a time, s.
    fn x(&self, time: f64) -> String {
        fixed(LEFT + time / self.time * (WIDTH - LEFT - RIGHT), 2)
    }

    /// Of an angle of the spindle, degrees.
    fn angle_y(&self, angle: f64) -> String {
        fixed(self.top + ANGLE_HEIGHT * (1.0 - angle / TURN_DEG), 2)
    }

    /// The lower edge, px.
    fn base(&self) -> f64 {
        self.top + ANGLE_HEIGHT + GAP + RATE_HEIGHT
    }

    /// Of a rate, Hz.
    fn rate_y(&self, rate: f64) -> String {
        fixed(self.base() - rate / self.most * RATE_HEIGHT, 2)
    }

    fn draw(&self, entries: &[Move], out: &mut dyn Write) -> io::Result<()> {
        let (sewing, top) = (self.sewing, self.top);
        let turn = S_PER_MIN / entries[0].rpm;
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"{}\">{} stitches/min: a turn of {} ms, a window of {} ms</text>",
            top - 8.0,
            exact(entries[0].rpm),
            fixed(turn * MS_PER_S, 2),
            fixed(turn * sewing.window() * MS_PER_S, 2)
        )?;
        for (k, entry) in entries.iter().enumerate() {
            self.stitch(entry, k as f64 * turn, out)?;
        }
        writeln!(out, "<path class=\"axis\" d=\"M{LEFT},{top} V{} H{}\"/>", self.base(), WIDTH - RIGHT)?;
        for (text, y) in [("360 deg", self.angle_y(TURN_DEG)), ("0", self.angle_y(0.0)), ("0 kHz", self.rate_y(0.0))] {
            writeln!(out, "<text class=\"small\" x=\"8\" y=\"{y}\">{text}</text>")?;
        }
        let (most, y) = (fixed(self.most / HZ_PER_KHZ, 2), self.rate_y(self.most));
        writeln!(out, "<text class=\"small\" x=\"8\" y=\"{y}\">{most} kHz</text>")?;
        writeln!(
            out,
            "<text class=\"small\" x=\"{}\" y=\"{}\"><tspan fill=\"#c22\">X</tspan> <tspan fill=\"#22c\">Y</tspan> pulse rate, <tspan fill=\"#444\">spindle angle</tspan>, <tspan fill=\"#4a4\">window</tspan></text>",
            WIDTH - 290.0,
            top - 8.0
        )
    }

    /// A stitch: a turn that begins with its window, at a time.
    fn stitch(&self, entry: &Move, start: f64, out: &mut dyn Write) -> io::Result<()> {
        let (sewing, base) = (self.sewing, self.base());
        let turn = S_PER_MIN / entry.rpm;
        let width = fixed(turn * sewing.window() / self.time * (WIDTH - LEFT - RIGHT), 2);
        let (left, top) = (self.x(start), self.top);
        let height = base - top;
        writeln!(out, "<rect class=\"window\" x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/>")?;
        self.angle(start, turn, out)?;
        for (axis, class) in [(0, "x"), (1, "y")] {
            let mut data = format!("M{left},{}", self.rate_y(0.0));
            for (from, to, rate) in rates(entry, axis, sewing) {
                let (from, to, rate) = (self.x(start + from), self.x(start + to), self.rate_y(rate));
                data.extend([" L", &from, ",", &rate, " L", &to, ",", &rate]);
            }
            data.extend([" V", &self.rate_y(0.0)]);
            writeln!(out, "<path class=\"{class}\" d=\"{data}\"/>")?;
        }
        let [x, y] = entry.pulses;
        let below = base + 16.0;
        writeln!(
            out,
            "<text class=\"small\" x=\"{left}\" y=\"{below}\">entry {}: X {x}, Y {y} pulses</text>",
            entry.entry
        )
    }

    /// The angle of the spindle during a turn that begins with the window.
    fn angle(&self, start: f64, turn: f64, out: &mut dyn Write) -> io::Result<()> {
        let feed_start = self.sewing.feed_start_deg;
        let wraps = start + turn * (TURN_DEG - feed_start) / TURN_DEG;
        let (from, top, bottom) = (self.angle_y(feed_start), self.angle_y(TURN_DEG), self.angle_y(0.0));
        let (begins, wraps, ends) = (self.x(start), self.x(wraps), self.x(start + turn));
        writeln!(out, "<path class=\"angle\" d=\"M{begins},{from} L{wraps},{top} M{wraps},{bottom} L{ends},{from}\"/>")
    }
}
