//! Target `svg`: the part, the course and the way of the head over it, and speeds over time.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::target::{Target, Writer};
use crate::geom::{Extent, Point, Vector};
use crate::spray::course::Leg;
use crate::spray::figures;
use crate::spray::program::Program;
use crate::spray::rows::Row;
use crate::units::MM_PER_M;
use crate::units::number::{fixed, short};

pub(super) const TARGET: Target = Target {
    name: "svg",
    about: "a picture of the edges, the way of the head, and its speed over time",
    extension: "svg",
    emit: Writer { compares: true, write },
    proof: None,
};

/// Sizes, px: of the picture, its margins, and the panel of speeds.
const WIDTH: f64 = 1000.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 60.0;
const PANEL: f64 = 220.0;
const GAP: f64 = 46.0;
/// Of the legend: its first line, from line to line, the sample of a line, and about the width of a letter.
const FIRST_LINE: f64 = 24.0;
const LINE: f64 = 18.0;
const SAMPLE: f64 = 24.0;
const LETTER: f64 = 6.3;
/// Room around the way of the head, as a share of its greater side.
const ROOM: f64 = 0.04;
/// Rows that are drawn at the most; of speeds between two the greatest.
const MOST_ROWS: usize = 1800;
/// Distance along the path between marks of the head's direction, as a fraction of the picture.
const AIM_EVERY: f64 = 0.06;
/// Drawn size of the greatest deviation from the course, as a fraction of the picture, and greatest magnification.
const VISIBLE: f64 = 0.012;
const MOST_TIMES: f64 = 10_000.0;
/// Parts of an axis of speeds or times, at the most.
const TICKS: f64 = 6.0;

/// Map from places to px.
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
    let ways = Ways::of(program, plan.extent.size().0);
    let top = TOP + plan.height() + GAP;
    head(top + PANEL + GAP, &ways, out)?;
    paths(program, &plan, out)?;
    for drawn in ways.all.iter().rev() {
        way(drawn, &plan, out)?;
    }
    aims(program, &plan, out)?;
    Chart::of(&ways, top).write(&ways, out)?;
    writeln!(out, "</svg>")
}

/// A program as it is drawn.
struct Way<'a> {
    program: &'a Program,
    /// Classes of its head and of its jet.
    class: [&'static str; 2],
    /// Drawn place of its head at each row.
    places: Vec<Point>,
}

/// Programs that are drawn: that of the job, and that of the other planner.
struct Ways<'a> {
    all: Vec<Way<'a>>,
    /// Magnification of deviations.
    times: f64,
}

impl<'a> Ways<'a> {
    /// Paths of a program, on a picture of the given width, mm.
    fn of(program: &'a Program, width: f64) -> Self {
        let programs = [Some(program), program.beside.as_deref()];
        let offs = programs.map(|program| program.map(offs).unwrap_or_default());
        let worst = offs.iter().flatten().map(crate::geom::Vector::norm).fold(0.0, f64::max);
        // Visible deviations are not magnified.
        let times = if worst > 0.0 { round(0.5 * VISIBLE * width / worst).clamp(1.0, MOST_TIMES) } else { 1.0 };
        let classes = [["way", "jet"], ["other", "other-jet"]];
        let way = |((program, offs), class): ((Option<&'a Program>, &Vec<Vector>), [&'static str; 2])| {
            let program = program?;
            let place = |(row, off): (&Row, &Vector)| row.pose.centre + off * (times - 1.0);
            Some(Way { program, class, places: program.rows.iter().zip(offs).map(place).collect() })
        };
        Self { all: programs.into_iter().zip(&offs).zip(classes).filter_map(way).collect(), times }
    }

    /// Legend of the lines: class and words.
    fn legend(&self) -> Vec<(&'static str, String)> {
        let times = if self.times > 1.0 { format!(", off x {}", short(self.times)) } else { String::new() };
        let mut all = vec![("course", "edge at its distance".to_owned()), ("aim", "direction of the head".to_owned())];
        if self.all.len() > 1 {
            all.push(("way", format!("head, quintic{times}")));
            all.push(("other", format!("head, optimal{times}")));
            all.push(("jet", "jet, quintic".to_owned()));
            all.push(("other-jet", "jet, optimal".to_owned()));
        } else {
            all.push(("way", format!("head, jet on{times}")));
            all.push(("air", "jet off".to_owned()));
            all.push(("jet", "jet along the edge".to_owned()));
        }
        all
    }
}

/// Deviation of the head from its course at each row, mm; zero between passes.
fn offs(program: &Program) -> Vec<Vector> {
    let legs: Vec<Leg> = program.passes.iter().flatten().copied().collect();
    let on: Vec<Row> = program.rows.iter().filter(|row| row.leg.is_some()).copied().collect();
    let mut known = figures::deviations(&legs, &on).into_iter();
    let off = |row: &Row| row.leg.and_then(|_| known.next()).unwrap_or_else(Vector::zeros);
    program.rows.iter().map(off).collect()
}

/// The head of the picture, with the legend.
fn head(height: f64, ways: &Ways, out: &mut dyn Write) -> io::Result<()> {
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
         .other{{stroke:#7a2a9c;stroke-width:1.1}} .other-jet{{stroke:#e07a7a;stroke-dasharray:3 2}} \
         .grid{{stroke:#ddd}} text{{fill:#333}}</style>"
    )?;
    writeln!(out, "<rect width=\"{WIDTH}\" height=\"{height}\"/>")?;
    let (mut at, mut down) = (LEFT, FIRST_LINE);
    for (class, text) in ways.legend() {
        let width = SAMPLE + 20.0 + LETTER * text.len() as f64;
        if at + width > WIDTH {
            (at, down) = (LEFT, down + LINE);
        }
        let (line, middle, words) = (fixed(at, 1), down - 4.0, fixed(at + SAMPLE + 6.0, 1));
        writeln!(
            out,
            "<path class=\"{class}\" d=\"M{line} {middle}h{SAMPLE}\"/><text x=\"{words}\" y=\"{down}\">{text}</text>"
        )?;
        at += width;
    }
    Ok(())
}

/// Edges and course.
fn paths(program: &Program, plan: &Plan, out: &mut dyn Write) -> io::Result<()> {
    let rings: String = program.edges.iter().map(|ring| plan.line(ring.iter().copied()) + "Z").collect();
    writeln!(out, "<path class=\"part\" d=\"{rings}\"/>")?;
    for pass in &program.passes {
        let places = pass.iter().map(|leg| leg.ends[0].at).chain(pass.last().map(|leg| leg.ends[1].at));
        writeln!(out, "<path class=\"course\" d=\"{}\"/>", plan.line(places))?;
    }
    Ok(())
}

/// The way of the head of a program.
fn way(way: &Way, plan: &Plan, out: &mut dyn Write) -> io::Result<()> {
    let (rows, places) = (&way.program.rows, &way.places);
    let every = rows.len().div_ceil(MOST_ROWS);
    let mut from = 0;
    while from < rows.len() {
        let jet = rows[from].jet;
        let count = rows[from..].iter().take_while(|row| row.jet == jet).count();
        let until = (from + count).min(rows.len() - 1);
        let line = plan.line((from..until).step_by(every).chain([until]).map(|i| places[i]));
        let class = if jet { way.class[0] } else { "air" };
        writeln!(out, "<path class=\"{class}\" d=\"{line}\"/>")?;
        from += count;
    }
    Ok(())
}

/// Direction of the head, at intervals.
fn aims(program: &Program, plan: &Plan, out: &mut dyn Write) -> io::Result<()> {
    let apart = AIM_EVERY * plan.extent.size().0;
    let mut way = apart;
    let mut aims = String::new();
    for pair in program.rows.windows(2) {
        way += (pair[1].pose.centre - pair[0].pose.centre).norm();
        if pair[1].jet && way >= apart {
            way = 0.0;
            let pose = pair[1].pose;
            aims += &plan.line([pose.centre, pose.centre + pose.c.unit() * (0.5 * apart)].into_iter());
        }
    }
    writeln!(out, "<path class=\"aim\" d=\"{aims}\"/>")
}

/// Speeds over time.
struct Chart {
    /// Its top, px.
    top: f64,
    /// The greatest speed, m/s, and time, s, that it has room for, and its steps.
    whole: [f64; 2],
    steps: [f64; 2],
}

impl Chart {
    fn of(ways: &Ways, top: f64) -> Self {
        let programs = || ways.all.iter().map(|way| way.program);
        let speeds = programs().flat_map(|program| &program.rows).map(|row| row.velocity[0].hypot(row.velocity[1]));
        let most = speeds.fold(0.0, f64::max) / MM_PER_M;
        let duration = programs().map(Program::duration).fold(0.0, f64::max);
        let steps = [round(most / TICKS), round(duration / (2.0 * TICKS))];
        Self { top, whole: [(most / steps[0]).ceil().max(1.0) * steps[0], duration], steps }
    }

    /// Position of a time, s, and a speed, m/s, px.
    fn at(&self, time: f64, speed: f64) -> [f64; 2] {
        let x = LEFT + (WIDTH - LEFT - RIGHT) * time / self.whole[1];
        [x, self.top + PANEL * (1.0 - speed.min(self.whole[0]) / self.whole[0])]
    }

    fn write(&self, ways: &Ways, out: &mut dyn Write) -> io::Result<()> {
        let wide = WIDTH - LEFT - RIGHT;
        for i in 0..=(self.whole[0] / self.steps[0]).round() as usize {
            let speed = i as f64 * self.steps[0];
            let (down, left, speed) = (fixed(self.at(0.0, speed)[1], 2), LEFT - 6.0, short(speed));
            writeln!(
                out,
                "<path class=\"grid\" d=\"M{LEFT} {down}h{wide}\"/><text x=\"{left}\" y=\"{down}\" dy=\"4\" text-anchor=\"end\">{speed}</text>"
            )?;
        }
        for i in 0..=(self.whole[1] / self.steps[1]) as usize {
            let time = i as f64 * self.steps[1];
            let (along, top, under, time) =
                (fixed(self.at(time, 0.0)[0], 2), self.top, self.top + PANEL + 18.0, short(time));
            writeln!(
                out,
                "<path class=\"grid\" d=\"M{along} {top}v{PANEL}\"/><text x=\"{along}\" y=\"{under}\" text-anchor=\"middle\">{time} s</text>"
            )?;
        }
        let title = self.top - 10.0;
        writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"{title}\">speed, m/s: of the head, and of its jet along the edge</text>"
        )?;
        ways.all.iter().rev().try_for_each(|way| self.lines(way, out))
    }

    /// The speeds of a program: of rows that share a place on the picture the greatest.
    fn lines(&self, way: &Way, out: &mut dyn Write) -> io::Result<()> {
        let Program { rows, distance, period, .. } = way.program;
        let spot = |i: usize| rows[i].pose.centre + rows[i].pose.c.unit() * *distance;
        let speed = |i: usize| rows[i].velocity[0].hypot(rows[i].velocity[1]);
        let jet = |i: usize| {
            let (before, behind) = (i.saturating_sub(1), (i + 1).min(rows.len() - 1));
            (spot(behind) - spot(before)).norm() / ((behind - before) as f64 * period)
        };
        let every = rows.len().div_ceil(MOST_ROWS);
        let place = |value: &dyn Fn(usize) -> f64, from: usize| {
            let most = (from..rows.len().min(from + every)).map(value).fold(0.0, f64::max) / MM_PER_M;
            let [x, y] = self.at(from as f64 * period, most);
            format!("{} {}", fixed(x, 2), fixed(y, 2))
        };
        let (mut head, mut spots, mut drawn) = (String::new(), String::new(), false);
        for from in (0..rows.len()).step_by(every) {
            let _ = write!(head, "{}{}", if head.is_empty() { 'M' } else { 'L' }, place(&speed, from));
            if rows[from].jet {
                let _ = write!(spots, "{}{}", if drawn { 'L' } else { 'M' }, place(&jet, from));
            }
            drawn = rows[from].jet;
        }
        let [of_head, of_jet] = way.class;
        writeln!(out, "<path class=\"{of_jet}\" d=\"{spots}\"/><path class=\"{of_head}\" d=\"{head}\"/>")
    }
}

/// The next round number: 1, 2 or 5 times a power of ten.
fn round(value: f64) -> f64 {
    let power = 10.0_f64.powf(value.max(f64::MIN_POSITIVE).log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|factor| factor * power).find(|&step| step >= value).unwrap_or(10.0 * power)
}
