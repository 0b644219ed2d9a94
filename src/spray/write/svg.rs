//! Target `svg`: the part, the course and the way of the head over it, and speeds over time.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::target::Target;
use crate::geom::{Extent, Point};
use crate::spray::program::Program;
use crate::units::MM_PER_M;
use crate::units::number::{fixed, short};

pub(super) const TARGET: Target =
    Target { name: "svg", about: "a picture of the edges, the way of the head, and its speed over time", write };

/// Sizes, px: of the picture, its margins, and the panel of speeds.
const WIDTH: f64 = 1000.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 60.0;
const PANEL: f64 = 220.0;
const GAP: f64 = 46.0;
/// Room around the way of the head, as a share of its greater side.
const ROOM: f64 = 0.04;
/// Rows that are drawn at the most; of speeds between two the greatest.
const MOST_ROWS: usize = 1800;
/// How far apart on its way the head's direction is shown, as a share of the picture.
const AIM_EVERY: f64 = 0.06;
/// Parts of an axis of speeds or times, at the most.
const TICKS: f64 = 6.0;

/// How places become px.
struct Plan {
    extent: Extent,
    scale: f64,
}

impl Plan {
    /// The plan of a program: all of it, as wide as the picture.
    fn of(program: &Program) -> Self {
        let mut extent = Extent::of(&program.edges.concat());
        program.rows.iter().for_each(|row| extent.add(row.pose.centre));
        let (width, height) = extent.size();
        let extent = extent.grown(ROOM * width.max(height));
        Self { scale: (WIDTH - LEFT - RIGHT) / extent.size().0, extent }
    }

    fn height(&self) -> f64 {
        self.extent.size().1 * self.scale
    }

    /// A place as it stands in path data: Y goes up.
    fn at(&self, place: Point) -> String {
        let x = LEFT + (place.x - self.extent.min.x) * self.scale;
        let y = TOP + (self.extent.max.y - place.y) * self.scale;
        format!("{} {}", fixed(x, 2), fixed(y, 2))
    }

    /// A line through places.
    fn line(&self, places: impl Iterator<Item = Point>) -> String {
        let places: Vec<String> = places.map(|place| self.at(place)).collect();
        if places.is_empty() { String::new() } else { format!("M{}", places.join("L")) }
    }
}

fn write(program: &Program, out: &mut dyn Write) -> io::Result<()> {
    let plan = Plan::of(program);
    let top = TOP + plan.height() + GAP;
    head(top + PANEL + GAP, out)?;
    paths(program, &plan, out)?;
    speeds(program, top, out)?;
    writeln!(out, "</svg>")
}

/// The head of the picture, with the legend.
fn head(height: f64, out: &mut dyn Write) -> io::Result<()> {
    let height = fixed(height, 0);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"12\">"
    )?;
    writeln!(
        out,
        "<style>rect{{fill:#fff}} path{{fill:none}} .part{{fill:#ebe4d8;stroke:#555;fill-rule:evenodd}} \
         .course{{stroke:#e8a33d;stroke-width:4}} .way{{stroke:#15519c;stroke-width:1.3}} \
         .air{{stroke:#15519c;stroke-dasharray:5 4;stroke-width:.9}} .aim{{stroke:#2a8f4a}} .jet{{stroke:#c22}} \
         .grid{{stroke:#ddd}} text{{fill:#333}}</style>"
    )?;
    writeln!(out, "<rect width=\"{WIDTH}\" height=\"{height}\"/>")?;
    let mut at = LEFT;
    for (class, text) in [
        ("course", "course: edge at its distance"),
        ("way", "head, jet on"),
        ("air", "head, jet off"),
        ("aim", "its direction"),
        ("jet", "jet along the edge"),
    ] {
        writeln!(out, "<path class=\"{class}\" d=\"M{at} 28h24\"/><text x=\"{}\" y=\"32\">{text}</text>", at + 30.0)?;
        at += 56.0 + 6.3 * text.len() as f64;
    }
    Ok(())
}

/// Edges, course and way of the head.
fn paths(program: &Program, plan: &Plan, out: &mut dyn Write) -> io::Result<()> {
    let rings: String = program.edges.iter().map(|ring| plan.line(ring.iter().copied()) + "Z").collect();
    writeln!(out, "<path class=\"part\" d=\"{rings}\"/>")?;
    for pass in &program.passes {
        let places = pass.iter().map(|leg| leg.ends[0].at).chain(pass.last().map(|leg| leg.ends[1].at));
        writeln!(out, "<path class=\"course\" d=\"{}\"/>", plan.line(places))?;
    }
    let every = program.rows.len().div_ceil(MOST_ROWS);
    let (mut from, rows) = (0, &program.rows);
    while from < rows.len() {
        let jet = rows[from].jet;
        let count = rows[from..].iter().take_while(|row| row.jet == jet).count();
        let until = (from + count).min(rows.len() - 1);
        let places = (from..until).step_by(every).chain([until]).map(|i| rows[i].pose.centre);
        writeln!(out, "<path class=\"{}\" d=\"{}\"/>", if jet { "way" } else { "air" }, plan.line(places))?;
        from += count;
    }
    let apart = AIM_EVERY * plan.extent.size().0;
    let mut way = apart;
    let mut aims = String::new();
    for pair in rows.windows(2) {
        way += (pair[1].pose.centre - pair[0].pose.centre).norm();
        if pair[1].jet && way >= apart {
            way = 0.0;
            let pose = pair[1].pose;
            aims += &plan.line([pose.centre, pose.centre + pose.c.unit() * (0.5 * apart)].into_iter());
        }
    }
    writeln!(out, "<path class=\"aim\" d=\"{aims}\"/>")
}

/// The speed of the head and of its jet over time.
fn speeds(program: &Program, top: f64, out: &mut dyn Write) -> io::Result<()> {
    let rows = &program.rows;
    let speed = |i: usize| rows[i].velocity[0].hypot(rows[i].velocity[1]);
    let spot = |i: usize| rows[i].pose.centre + rows[i].pose.c.unit() * program.distance;
    let jet = |i: usize| {
        let (before, behind) = (i.saturating_sub(1), (i + 1).min(rows.len() - 1));
        (spot(behind) - spot(before)).norm() / ((behind - before) as f64 * program.period)
    };
    let most = (0..rows.len()).map(speed).fold(0.0, f64::max) / MM_PER_M;
    let (step, ticks) = (round(most / TICKS), round(program.duration() / (2.0 * TICKS)));
    let whole = (most / step).ceil().max(1.0) * step;
    let wide = WIDTH - LEFT - RIGHT;
    let x = |i: usize| LEFT + wide * i as f64 / (rows.len() - 1) as f64;
    let y = |metres: f64| top + PANEL * (1.0 - metres / whole);
    for i in 0..=(whole / step).round() as usize {
        let at = i as f64 * step;
        let down = fixed(y(at), 2);
        writeln!(
            out,
            "<path class=\"grid\" d=\"M{LEFT} {down}h{wide}\"/><text x=\"{}\" y=\"{down}\" dy=\"4\" text-anchor=\"end\">{}</text>",
            LEFT - 6.0,
            short(at)
        )?;
    }
    for i in 0..=(program.duration() / ticks) as usize {
        let at = i as f64 * ticks;
        let along = fixed(LEFT + wide * at / program.duration(), 2);
        writeln!(
            out,
            "<path class=\"grid\" d=\"M{along} {top}v{PANEL}\"/><text x=\"{along}\" y=\"{}\" text-anchor=\"middle\">{} s</text>",
            top + PANEL + 18.0,
            short(at)
        )?;
    }
    writeln!(
        out,
        "<text x=\"{LEFT}\" y=\"{}\">speed, m/s: of the head, and of its jet along the edge</text>",
        top - 10.0
    )?;
    let every = rows.len().div_ceil(MOST_ROWS);
    let of = |value: &dyn Fn(usize) -> f64, from: usize| {
        (from..rows.len().min(from + every)).map(value).fold(0.0, f64::max) / MM_PER_M
    };
    let (mut head, mut spots, mut drawn) = (String::new(), String::new(), false);
    for from in (0..rows.len()).step_by(every) {
        let letter = if head.is_empty() { 'M' } else { 'L' };
        // Writing into a `String` cannot fail.
        let _ = write!(head, "{letter}{} {}", fixed(x(from), 2), fixed(y(of(&speed, from)), 2));
        if rows[from].jet {
            let letter = if drawn { 'L' } else { 'M' };
            let _ = write!(spots, "{letter}{} {}", fixed(x(from), 2), fixed(y(of(&jet, from).min(whole)), 2));
        }
        drawn = rows[from].jet;
    }
    writeln!(out, "<path class=\"jet\" d=\"{spots}\"/><path class=\"way\" d=\"{head}\"/>")
}

/// The next round number: 1, 2 or 5 times a power of ten.
fn round(value: f64) -> f64 {
    let power = 10.0_f64.powf(value.max(f64::MIN_POSITIVE).log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|factor| factor * power).find(|&step| step >= value).unwrap_or(10.0 * power)
}
