//! The legend below the drawing: bars of windows, scale, caption, symbols and the tables.

use std::fmt::Write;

use super::bites::{self, Window};
use super::declared;
use super::doubts;
use super::findings;
use super::items::{Item, Symbol, items};
use super::mark::Mark;
use super::markup::{PathData, short};
use super::piece::PALETTE;
use super::sheet::{CELL_PX, LINE_PX, MARGIN_PX, Sheet, TEXT_PX, caption, table_lines};
use crate::back::target::{Context, Outcome};
use crate::geom::{Point, Vector};
use crate::ir::verdict;
use crate::units::MM_PER_M;

/// Width of a symbol, pixels.
const SYMBOL_PX: f64 = 30.0;
/// Height of the ends of a bar for a window, and the distance of its text from it, pixels.
const END_PX: f64 = 5.0;
const TEXT_BELOW_PX: f64 = 9.0;
/// Maximum length of the scale bar, as a fraction of the sheet's width.
const SCALE_PART: f64 = 0.2;

/// Bars of windows, scale bar, caption, symbols and the tables of findings, doubts and declarations, below the drawing.
pub(super) fn layer(
    sheet: &Sheet,
    context: &Context,
    marks: &[Mark],
    Outcome { findings: found, refusals, declared, doubts, .. }: Outcome,
) -> String {
    let line = LINE_PX * sheet.px;
    let left = sheet.left + MARGIN_PX * sheet.px;
    let mut text = String::from("<g id=\"legend\" inkscape:groupmode=\"layer\" inkscape:label=\"legend\">\n");
    let mut y = sheet.legend + line / 2.0;
    text.push_str(&bars(context, sheet, y));
    y += line * bites::lines(context, TEXT_PX * sheet.px, sheet.left + sheet.width) as f64;
    text.push_str(&scale_bar(sheet, Point::new(left, y)));
    text.push_str(&links(sheet, y));
    y += line;
    text.push_str(&sheet.text("", Point::new(left, y), &caption(context)));
    y += line;
    for (i, item) in items(context).enumerate() {
        let (row, column) = (i / sheet.columns(), i % sheet.columns());
        let at = Point::new(left + CELL_PX * sheet.px * column as f64, y + line * row as f64);
        let _infallible = writeln!(text, "<g color=\"{}\">{}</g>", PALETTE[0], symbol(sheet, &item, at));
        text.push_str(&sheet.text("", at + Vector::new((SYMBOL_PX + 8.0) * sheet.px, 0.0), &item.meaning));
    }
    y += line * items(context).count().div_ceil(sheet.columns()) as f64;
    if found.len() + refusals.len() > 0 {
        let (limited, reported) = verdict::counts(found);
        let failing = marks.iter().filter(|mark| !mark.holds).count();
        let class = if failing == 0 { "verdict" } else { "fails-text" };
        let said = match failing {
            0 => {
                format!("verified: {limited} rules hold, {reported} only reported; the worst places on the cloth:")
            }
            n if marks.iter().all(|mark| mark.holds || mark.name.starts_with("verify/")) => {
                format!("REFUSED, no program was written: {n} of {limited} rules are broken:")
            }
            _ => "REFUSED, no program was written:".to_owned(),
        };
        text.push_str(&sheet.text(class, Point::new(left, y), &said));
        for (n, mark) in marks.iter().enumerate() {
            y += line;
            let class = if mark.holds { "" } else { "fails-text" };
            text.push_str(&sheet.text(class, Point::new(left, y), &findings::sentence(n, mark)));
        }
        y += line;
    }
    text.push_str(&doubts::table(doubts, sheet, Point::new(left, y)));
    y += line * table_lines(doubts.len()) as f64;
    text.push_str(&declared::table(declared, sheet, Point::new(left, y)));
    let _infallible = writeln!(text, "</g>\n<view id=\"whole\" viewBox=\"{}\"/>", sheet.view_box());
    text
}

/// A bar for each window of a conveyor, at its place along X, with the top of the first line.
fn bars(context: &Context, sheet: &Sheet, top: f64) -> String {
    let mut text = String::new();
    for window in bites::windows(context.marker, TEXT_PX * sheet.px, sheet.left + sheet.width) {
        let Window { index, ends, row, words, words_at } = window;
        let y = top + LINE_PX * sheet.px * row as f64;
        let down = Vector::new(0.0, END_PX * sheet.px);
        let [start, end] = ends.map(|x| Point::new(x, y));
        let mut data = PathData::default();
        data.line([start + down, start, end, end + down]);
        let colour = PALETTE[index % PALETTE.len()];
        let _infallible = write!(text, "<g color=\"{colour}\">{}", data.element("run").trim_end());
        let at = Point::new(words_at, y + TEXT_BELOW_PX * sheet.px);
        let _infallible = writeln!(text, "{}</g>", sheet.text("", at, &words).trim_end());
    }
    text
}

/// Links to views of the sheet.
fn links(sheet: &Sheet, y: f64) -> String {
    let mut text = String::new();
    for (target, words, from_right) in [("whole", "whole", 190.0), ("marker", "actual size", 130.0)] {
        let at = Point::new(sheet.left + sheet.width - from_right * sheet.px, y);
        let _infallible = writeln!(text, "<a href=\"#{target}\">{}</a>", sheet.text("link", at, words).trim_end());
    }
    text
}

/// A bar of a round length, in four parts.
fn scale_bar(sheet: &Sheet, at: Point) -> String {
    let length = round_length(sheet.width * SCALE_PART);
    let height = 5.0 * sheet.px;
    let mut text = String::new();
    for part in 0..4 {
        let x = at.x + length / 4.0 * f64::from(part);
        let (low, high) = (at.y - height / 2.0, at.y + height / 2.0);
        let mut data = PathData::default();
        data.polygon(
            [(x, low), (x + length / 4.0, low), (x + length / 4.0, high), (x, high)].map(|(x, y)| Point::new(x, y)),
        );
        text.push_str(&data.element(if part % 2 == 0 { "bar" } else { "bar-open" }));
    }
    let words =
        if length >= MM_PER_M { format!("{} m", short(length / MM_PER_M)) } else { format!("{} mm", short(length)) };
    text.push_str(&sheet.text("", Point::new(at.x + length + 8.0 * sheet.px, at.y), &words));
    text
}

fn symbol(sheet: &Sheet, item: &Item, at: Point) -> String {
    let spot = |x: f64, y: f64| at + Vector::new(x, y) * sheet.px;
    let mut data = PathData::default();
    match item.symbol {
        Symbol::Line => data.line([spot(0.0, 0.0), spot(SYMBOL_PX, 0.0)]),
        Symbol::Bar => data.polygon([spot(6.0, -1.2), spot(24.0, -1.2), spot(24.0, 1.2), spot(6.0, 1.2)]),
        Symbol::Circle(radius) => data.circle(spot(15.0, 0.0), radius * sheet.px),
        Symbol::Target => {
            data.circle(spot(15.0, 0.0), 5.0 * sheet.px);
            data.line([spot(7.0, 0.0), spot(23.0, 0.0)]);
            data.line([spot(15.0, -8.0), spot(15.0, 8.0)]);
        }
    }
    data.element(item.class)
}

/// The greatest 1, 2 or 5 times a power of ten that is at most `length`, mm.
fn round_length(length: f64) -> f64 {
    let decade = 10_f64.powf(length.log10().floor());
    [5.0, 2.0].into_iter().map(|step| step * decade).find(|&step| step <= length).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_bar_has_a_round_length() {
        let lengths: Vec<f64> = [3.0, 199.0, 200.0, 740.0, 6000.0].into_iter().map(round_length).collect();
        assert_eq!(lengths, [2.0, 100.0, 200.0, 500.0, 5000.0]);
        assert_eq!((short(5000.0), short(6.6), short(0.25)), ("5000".into(), "6.6".into(), "0.25".into()));
    }
}
