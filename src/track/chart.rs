//! Picture of the tracking of a cloth: positions, error and speed over time.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::tracked::Tracked;
use crate::units::number::{fixed, short};

/// Sizes, px: of the picture, its margins, a panel, and the gap below a panel.
const WIDTH: f64 = 1000.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 66.0;
const PANEL: f64 = 190.0;
const GAP: f64 = 42.0;
/// Maximum number of columns of a line; each column shows its first, minimum, maximum and last value.
const COLUMNS: usize = 910;
/// Colours of the followers, in their order.
const COLORS: [&str; 4] = ["#c22", "#b8b8b8", "#3a3", "#a4c"];
/// Approximate width of a letter in the legend, px.
const LETTER: f64 = 6.4;
/// Maximum number of intervals of an axis.
const TICKS: f64 = 6.0;

/// A panel: its title and its lines, each with its class; the first line is on top.
struct Panel {
    title: &'static str,
    lines: Vec<(String, Vec<f64>)>,
}

pub(super) fn write(tracked: &Tracked, out: &mut dyn Write) -> io::Result<()> {
    let (names, places): (Vec<&str>, Vec<&[f64]>) = if tracked.followers.is_empty() {
        (vec!["carriage"], vec![&tracked.carriage])
    } else {
        tracked.followers.iter().map(|(follower, _)| (follower.name.as_str(), &follower.places[..])).unzip()
    };
    let classed = |values: Vec<Vec<f64>>| -> Vec<(String, Vec<f64>)> {
        values.into_iter().enumerate().map(|(i, values)| (format!("f{i}"), values)).collect()
    };
    let error = |places: &&[f64]| places.iter().zip(&tracked.cloth).map(|(place, cloth)| place - cloth).collect();
    let mut positions = classed(places.iter().map(|places| places.to_vec()).collect());
    positions.insert(1, ("cloth".to_owned(), tracked.cloth.clone()));
    let speeds = tracked.replay.commands.iter().map(|command| command.velocity).collect();
    let panels = [
        Panel { title: "position, mm to the right of the middle of the machine", lines: positions },
        Panel {
            title: "error, mm from the centre of the cloth to the carriage",
            lines: classed(places.iter().map(error).collect()),
        },
        Panel { title: "velocity that is commanded, mm/s", lines: classed(vec![speeds]) },
    ];
    let times: Vec<f64> = tracked.replay.rows.iter().map(|row| row.time).collect();
    head(&names, out)?;
    for (panel, number) in panels.iter().zip(0_u8..) {
        draw(panel, &times, TOP + f64::from(number) * (PANEL + GAP), out)?;
    }
    writeln!(out, "</svg>")
}

/// Writes the head of the picture, with the legend.
fn head(names: &[&str], out: &mut dyn Write) -> io::Result<()> {
    let height = TOP + 3.0 * (PANEL + GAP);
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\">\n\
         <style>text{{font:13px sans-serif}}.small{{font-size:11px;fill:#555}}.axis{{stroke:#999;fill:none}}.grid{{stroke:#eee}}\
         .line{{fill:none;stroke-width:1.4;stroke-linejoin:round}}.cloth{{stroke:#222;stroke-dasharray:5 3}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>"
    )?;
    let entries = names.iter().zip(COLORS).map(|(name, color)| (*name, format!("stroke:{color}")));
    let cloth = ("centre of the cloth", "stroke:#222;stroke-dasharray:5 3".to_owned());
    let (mut x, mut y) = (LEFT, 16.0);
    for (name, style) in [cloth].into_iter().chain(entries) {
        let width = 46.0 + LETTER * name.len() as f64;
        if x + width > WIDTH {
            (x, y) = (LEFT, y + 16.0);
        }
        writeln!(out, "<path style=\"{style};stroke-width:2\" d=\"M{},{y} h18\"/>", fixed(x, 1))?;
        writeln!(out, "<text class=\"small\" x=\"{}\" y=\"{}\">{name}</text>", fixed(x + 22.0, 1), y + 4.0)?;
        x += width;
    }
    Ok(())
}

/// Draws a panel; `top` is its upper edge, px.
fn draw(panel: &Panel, times: &[f64], top: f64, out: &mut dyn Write) -> io::Result<()> {
    let [start, end] = [times[0], times[times.len() - 1]];
    let all = || panel.lines.iter().flat_map(|(_, values)| values.iter().copied());
    let [least, most] = all().fold([0.0_f64; 2], |[least, most], value| [least.min(value), most.max(value)]);
    // A constant line lies in the middle of a range of one unit to either side.
    let margin = if most > least { 0.05 * (most - least) } else { 1.0 };
    let (least, most) = (least - margin, most + margin);
    let px = |time: f64| LEFT + (time - start) / (end - start).max(f64::MIN_POSITIVE) * (WIDTH - LEFT - RIGHT);
    let py = |value: f64| top + (most - value) / (most - least) * PANEL;
    writeln!(out, "<text x=\"{LEFT}\" y=\"{}\">{}</text>", fixed(top - 8.0, 1), panel.title)?;
    for value in ticks(least, most) {
        let y = fixed(py(value), 1);
        writeln!(out, "<path class=\"grid\" d=\"M{LEFT},{y} H{}\"/>", WIDTH - RIGHT)?;
        writeln!(
            out,
            "<text class=\"small\" text-anchor=\"end\" x=\"{}\" y=\"{y}\" dy=\"4\">{}</text>",
            LEFT - 6.0,
            short(value)
        )?;
    }
    for time in ticks(start, end) {
        let (x, bottom) = (fixed(px(time), 1), top + PANEL);
        writeln!(out, "<path class=\"grid\" d=\"M{x},{top} V{bottom}\"/>")?;
        writeln!(
            out,
            "<text class=\"small\" text-anchor=\"middle\" x=\"{x}\" y=\"{}\">{} s</text>",
            bottom + 14.0,
            short(time)
        )?;
    }
    writeln!(out, "<path class=\"axis\" d=\"M{LEFT},{top} V{} H{}\"/>", top + PANEL, WIDTH - RIGHT)?;
    for (class, values) in panel.lines.iter().rev() {
        let number = class.strip_prefix('f').and_then(|number| number.parse::<usize>().ok());
        let style =
            number.and_then(|i| COLORS.get(i)).map_or(String::new(), |color| format!(" style=\"stroke:{color}\""));
        let data = path(values, times, &px, &py);
        writeln!(out, "<path class=\"line {class}\"{style} d=\"{data}\"/>")?;
    }
    Ok(())
}

/// Round numbers between two values, for the marks of an axis.
fn ticks(least: f64, most: f64) -> Vec<f64> {
    let span = most - least;
    let magnitude = 10_f64.powf((span / TICKS).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|part| part * magnitude).into_iter().find(|step| span / step <= TICKS);
    let Some(step) = step.filter(|step| step.is_finite() && *step > 0.0) else { return vec![least] };
    let (first, last) = ((least / step).ceil() as i64, (most / step).floor() as i64);
    (first..=last).map(|n| n as f64 * step).collect()
}

/// Path data of a line: the first, minimum, maximum and last value of each column of the picture.
fn path(values: &[f64], times: &[f64], px: &dyn Fn(f64) -> f64, py: &dyn Fn(f64) -> f64) -> String {
    let mut data = String::new();
    let size = values.len().div_ceil(COLUMNS).max(1);
    for (first, column) in (0..).step_by(size).zip(values.chunks(size)) {
        let by = |order: std::cmp::Ordering| {
            let mut indices = 0..column.len();
            indices.by_ref().next();
            indices.fold(0, |best, i| if column[i].total_cmp(&column[best]) == order { i } else { best })
        };
        let mut shown = [0, by(std::cmp::Ordering::Less), by(std::cmp::Ordering::Greater), column.len() - 1];
        shown.sort_unstable();
        let mut last = None;
        for i in shown.into_iter().filter(|i| last.replace(*i) != Some(*i)) {
            let letter = if data.is_empty() { 'M' } else { ' ' };
            // Writing into a `String` cannot fail.
            let _ = write!(data, "{letter}{},{}", fixed(px(times[first + i]), 1), fixed(py(column[i]), 1));
        }
    }
    data
}
