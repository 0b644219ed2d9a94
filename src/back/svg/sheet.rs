//! The sheet: its size, style, frame, scale and legend.

use std::fmt::Write;

use super::markup::{PathData, escape, mm};
use super::piece::PALETTE;
use super::{aside, findings};
use crate::back::target::Context;
use crate::geom::{Extent, Point, Vector};
use crate::ir::Finding;
use crate::units::number::fixed;
use crate::units::{MM_PER_INCH, MM_PER_M, deg};

/// Window in which the whole drawing should be readable, pixels: text and margins are sized for it.
const WINDOW_PX: [f64; 2] = [1400.0, 800.0];
/// Least width of a sheet, pixels: the legend needs it.
const LEAST_WIDTH_PX: f64 = 760.0;
/// A nominal pixel is never smaller than one of a browser, mm: at actual size, text is readable.
const LEAST_PX: f64 = MM_PER_INCH / 96.0;
/// Free space around the drawing, pixels.
const MARGIN_PX: f64 = 30.0;
/// Height of a line and of text in the legend, pixels.
const LINE_PX: f64 = 24.0;
const TEXT_PX: f64 = 13.0;
/// Width of a cell of the legend and of the symbol in it, pixels.
const CELL_PX: f64 = 220.0;
const SYMBOL_PX: f64 = 30.0;
/// Length of the arrows at the origin, pixels.
const ARROW_PX: f64 = 26.0;
/// The scale bar is at most this part of the sheet's width.
const SCALE_PART: f64 = 0.2;
/// Width of the word `refused` and height of its letters, in sizes of its font, and how much of the drawing it fills.
const WORD_EMS: f64 = 4.6;
const LETTER_EMS: f64 = 1.0;
const WORD_SHARE: f64 = 0.92;
/// Bytes of the opening tag, padded with blanks so that the tail can write it once more with the final size.
const OPENING_BYTES: usize = 480;

/// Style of everything. Strokes keep their width on the screen; symbols grow with the zoom.
const STYLE: &str = "\
svg{max-width:100vw;max-height:100vh;background:#fff}
svg:target{max-width:none;max-height:none}
text{font-family:'DejaVu Sans',Verdana,Arial,sans-serif;fill:#333}
path{vector-effect:non-scaling-stroke;fill:none;stroke-linejoin:round}
.area{fill:currentColor;fill-opacity:.13;fill-rule:evenodd;stroke:none}
.number{fill:currentColor;fill-opacity:.8;font-weight:bold;text-anchor:middle}
.label{fill:#333;fill-opacity:.85}
.notch{stroke:currentColor;stroke-opacity:.5;stroke-width:6;stroke-linecap:round}
.aside{stroke:#9a9a9a;stroke-width:.6}
.run{stroke:currentColor;stroke-width:1.5}
.air{stroke:#8c8c8c;stroke-width:.7;stroke-dasharray:5 4}
.over{fill:#d6006c;stroke:#d6006c;stroke-width:1.3}
.harm{fill:#ff7a00;stroke:#ff7a00;stroke-width:1.6}
.blade{fill:#222;fill-opacity:.25;stroke:#222;stroke-width:.6}
.stab{fill:#222;stroke:#222;stroke-width:1.1}
.plunge{fill:#fff;stroke:#222;stroke-width:.6}
.lift{fill:#222;stroke:none}
.drill{stroke:#222;stroke-width:1.2}
.event{fill:#fff;stroke:#222;stroke-width:1.2}
.fails{stroke:#d00000;stroke-width:2.6}
.holds{stroke:#d08a00;stroke-width:1.1}
.fails-text{fill:#d00000;font-weight:bold}
.holds-text{fill:#9a6600}
.verdict{font-weight:bold}
.frame{stroke:#bbb;stroke-width:.7}
.axis{stroke:#666;stroke-width:1.2}
.bar{fill:#333;stroke:#333;stroke-width:1}
.bar-open{fill:#fff;stroke:#333;stroke-width:1}
a{cursor:pointer}
.link{fill:#2a5db0;text-decoration:underline}
";

/// Where everything stands on the sheet, in its own coordinates: mm, Y down, the table's origin at (0, 0).
#[derive(Debug)]
pub(super) struct Sheet {
    /// A nominal pixel, mm.
    pub(super) px: f64,
    /// What is cut or drilled, in table coordinates (Y up).
    extent: Extent,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    /// Where the legend begins.
    legend: f64,
}

impl Sheet {
    /// The sheet of a marker, with room for a table of findings.
    pub(super) fn of(context: &Context, found: &[Finding]) -> Self {
        let profile = &context.job.profile;
        let extent = context.marker.extent();
        let mut drawn = extent;
        context.marker.pieces.iter().flat_map(|piece| &piece.labels).filter_map(|l| l.at).for_each(|at| drawn.add(at));
        drawn.add(Point::new(profile.home[0], profile.home[1]));
        let aside = context.marker.drawing.iter().flat_map(|account| &account.aside.vertices);
        aside.for_each(|vertex| drawn.add(vertex.at));
        // Only the marker decides the scale: the head does not know the findings yet.
        let (w, h) = drawn.size();
        let px = (w / WINDOW_PX[0]).max(h / WINDOW_PX[1]).max(LEAST_PX);
        for place in found.iter().filter_map(|finding| finding.place) {
            if place.point.x.is_finite() && place.point.y.is_finite() {
                drawn.add(place.point);
            }
        }
        let (w, _) = drawn.size();
        let margin = MARGIN_PX * px + profile.knife.width_mm;
        let width = (w + 2.0 * margin).max(LEAST_WIDTH_PX * px);
        let (left, top) = (drawn.min.x - margin, -drawn.max.y - margin);
        let legend = -drawn.min.y + margin;
        let mut sheet = Self { px, extent, left, top, width, height: 0.0, legend };
        let lines = 2 + items(context).count().div_ceil(sheet.columns()) + found.len() + usize::from(!found.is_empty());
        sheet.height = legend - top + LINE_PX * px * (lines as f64 + 0.5);
        sheet
    }

    /// The XML declaration and the opening tag, always of the same length.
    pub(super) fn opening(&self) -> String {
        let tag = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg id=\"marker\" xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{}mm\" height=\"{}mm\" viewBox=\"{}\"",
            mm(self.width),
            mm(self.height),
            self.view_box()
        );
        format!("{tag:<OPENING_BYTES$}>\n")
    }

    /// The corners of the part of the sheet above the legend, in table coordinates (Y up), the first one repeated.
    pub(super) fn edge(&self) -> [Point; 5] {
        let (left, right) = (self.left, self.left + self.width);
        let (top, bottom) = (-self.top, -self.legend);
        [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)].map(|(x, y)| Point::new(x, y))
    }

    fn view_box(&self) -> String {
        format!("{} {} {} {}", mm(self.left), mm(self.top), mm(self.width), mm(self.height))
    }

    fn columns(&self) -> usize {
        ((self.width / self.px - 2.0 * MARGIN_PX) / CELL_PX).floor().max(1.0) as usize
    }

    /// Title, paper, the box around the marker and the directions of the axes.
    pub(super) fn ground(&self, context: &Context) -> String {
        let mut text = format!("<title>{}</title>\n", escape(&caption(context)));
        let (x, y) = (mm(self.left), mm(self.top));
        let _infallible =
            writeln!(text, "<rect id=\"paper\" x=\"{x}\" y=\"{y}\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>");
        text.push_str("<g id=\"table\" inkscape:groupmode=\"layer\" inkscape:label=\"table\">\n");
        if !self.extent.is_empty() {
            let (low, high) = (self.extent.min, self.extent.max);
            let mut frame = PathData::default();
            frame.polygon([
                Point::new(low.x, -low.y),
                Point::new(high.x, -low.y),
                Point::new(high.x, -high.y),
                Point::new(low.x, -high.y),
            ]);
            text.push_str(&frame.titled("frame", "the box around everything that is cut"));
        }
        let (arrow, head) = (ARROW_PX * self.px, 4.0 * self.px);
        let mut axes = PathData::default();
        for (along, across) in
            [(Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)), (Vector::new(0.0, -1.0), Vector::new(1.0, 0.0))]
        {
            let tip = Point::origin() + along * arrow;
            let barb = along * -head;
            axes.line([Point::origin(), tip]);
            axes.line([tip + barb + across * (head / 2.0), tip, tip + barb - across * (head / 2.0)]);
        }
        text.push_str(&axes.titled("axis", "the origin of the table, X and Y"));
        text.push_str(&self.text("", Point::new(arrow + 3.0 * self.px, 12.0 * self.px), "X"));
        text.push_str(&self.text("", Point::new(-12.0 * self.px, -arrow - 2.0 * self.px), "Y"));
        text.push_str("</g>\n");
        text
    }

    /// Scale bar, caption, symbols and the table of findings, below the drawing; with the numbers of rules that have a limit
    /// and that only report.
    pub(super) fn legend(&self, context: &Context, found: &[Finding], (limited, reported): (usize, usize)) -> String {
        let line = LINE_PX * self.px;
        let left = self.left + MARGIN_PX * self.px;
        let mut text = String::from("<g id=\"legend\" inkscape:groupmode=\"layer\" inkscape:label=\"legend\">\n");
        let mut y = self.legend + line / 2.0;
        text.push_str(&self.scale_bar(Point::new(left, y)));
        text.push_str(&self.links(y));
        y += line;
        text.push_str(&self.text("", Point::new(left, y), &caption(context)));
        y += line;
        for (i, item) in items(context).enumerate() {
            let (row, column) = (i / self.columns(), i % self.columns());
            let at = Point::new(left + CELL_PX * self.px * column as f64, y + line * row as f64);
            let _infallible = writeln!(text, "<g color=\"{}\">{}</g>", PALETTE[0], self.symbol(&item, at));
            text.push_str(&self.text("", at + Vector::new((SYMBOL_PX + 8.0) * self.px, 0.0), &item.meaning));
        }
        y += line * items(context).count().div_ceil(self.columns()) as f64;
        if limited + reported > 0 {
            let failing = found.iter().filter(|finding| !finding.holds()).count();
            let class = if failing == 0 { "verdict" } else { "fails-text" };
            let verdict = match failing {
                0 => {
                    format!("verified: {limited} rules hold, {reported} only reported; the worst places on the cloth:")
                }
                n if found.iter().all(|finding| finding.holds() || finding.rule.starts_with("verify/")) => {
                    format!("REFUSED, no program was written: {n} of {limited} rules are broken:")
                }
                _ => "REFUSED, no program was written:".to_owned(),
            };
            text.push_str(&self.text(class, Point::new(left, y), &verdict));
            for (n, finding) in found.iter().enumerate() {
                y += line;
                let class = if finding.holds() { "" } else { "fails-text" };
                text.push_str(&self.text(class, Point::new(left, y), &findings::sentence(n, finding)));
            }
        }
        let _infallible = writeln!(text, "</g>\n<view id=\"whole\" viewBox=\"{}\"/>", self.view_box());
        text
    }

    /// The word across the drawing that tells everybody what the picture is of: no program.
    pub(super) fn refused(&self) -> String {
        let (width, height) = (self.width, self.legend - self.top);
        let slope = height.atan2(width);
        let (sin, cos) = slope.sin_cos();
        // As large as the drawing is wide and high for the box around the word, turned along the diagonal.
        let by_width = width / (WORD_EMS * cos + LETTER_EMS * sin);
        let by_height = height / (WORD_EMS * sin + LETTER_EMS * cos);
        let size = WORD_SHARE * by_width.min(by_height);
        // The middle of the letters stands on the diagonal.
        format!(
            "<g id=\"refused\" inkscape:groupmode=\"layer\" inkscape:label=\"refused\" transform=\"translate({},{}) \
             rotate({})\"><text y=\"{}\" font-size=\"{}\" style=\"fill:#d00000;fill-opacity:.2;font-weight:bold;\
             text-anchor:middle;pointer-events:none\">refused</text></g>\n",
            mm(self.left + width / 2.0),
            mm(self.top + height / 2.0),
            fixed(-deg(slope), 2),
            mm(0.27 * size),
            mm(size)
        )
    }

    fn text(&self, class: &str, at: Point, words: &str) -> String {
        let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
        // The middle of the letters stands at the point's level.
        let y = at.y + 0.36 * TEXT_PX * self.px;
        let size = mm(TEXT_PX * self.px);
        format!("<text{class} x=\"{}\" y=\"{}\" font-size=\"{size}\">{}</text>\n", mm(at.x), mm(y), escape(words))
    }

    fn links(&self, y: f64) -> String {
        let mut text = String::new();
        for (target, words, from_right) in [("whole", "whole", 190.0), ("marker", "actual size", 130.0)] {
            let at = Point::new(self.left + self.width - from_right * self.px, y);
            let _infallible = writeln!(text, "<a href=\"#{target}\">{}</a>", self.text("link", at, words).trim_end());
        }
        text
    }

    /// A bar of a round length, in four parts.
    fn scale_bar(&self, at: Point) -> String {
        let length = round_length(self.width * SCALE_PART);
        let height = 5.0 * self.px;
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
        let words = if length >= MM_PER_M {
            format!("{} m", short(length / MM_PER_M))
        } else {
            format!("{} mm", short(length))
        };
        text.push_str(&self.text("", Point::new(at.x + length + 8.0 * self.px, at.y), &words));
        text
    }

    fn symbol(&self, item: &Item, at: Point) -> String {
        let spot = |x: f64, y: f64| at + Vector::new(x, y) * self.px;
        let mut data = PathData::default();
        match item.symbol {
            Symbol::Line => data.line([spot(0.0, 0.0), spot(SYMBOL_PX, 0.0)]),
            Symbol::Bar => data.polygon([spot(6.0, -1.2), spot(24.0, -1.2), spot(24.0, 1.2), spot(6.0, 1.2)]),
            Symbol::Circle(radius) => data.circle(spot(15.0, 0.0), radius * self.px),
            Symbol::Target => {
                data.circle(spot(15.0, 0.0), 5.0 * self.px);
                data.line([spot(7.0, 0.0), spot(23.0, 0.0)]);
                data.line([spot(15.0, -8.0), spot(15.0, 8.0)]);
            }
        }
        data.element(item.class)
    }
}

/// An entry of the legend.
struct Item {
    class: &'static str,
    symbol: Symbol,
    meaning: String,
}

#[derive(Clone, Copy)]
enum Symbol {
    Line,
    /// A bar, as a blade and an overlap look when zoomed.
    Bar,
    /// With its radius, pixels.
    Circle(f64),
    Target,
}

/// The entries of a picture: those of all, then what of a plot is drawn and not cut.
fn items(context: &Context) -> impl Iterator<Item = Item> {
    let aside = aside::classes(context).map(|class| Item {
        class: aside::ASIDE,
        symbol: Symbol::Line,
        meaning: format!("{}: {}, {} m, uncut", class.name, class.count, fixed(class.length / MM_PER_M, 1)),
    });
    let all = ITEMS.iter().map(|&(class, symbol, meaning)| Item { class, symbol, meaning: meaning.to_owned() });
    all.chain(aside)
}

const ITEMS: [(&str, Symbol, &str); 10] = [
    ("run", Symbol::Line, "cut, in the piece's colour"),
    ("over", Symbol::Bar, "overlap past an end"),
    ("harm", Symbol::Bar, "stab into a part"),
    ("blade", Symbol::Bar, "blade at plunge and lift"),
    ("stab", Symbol::Bar, "stab: plunge only"),
    ("plunge", Symbol::Circle(4.0), "plunge, at the tip"),
    ("lift", Symbol::Circle(3.0), "lift, at the tip"),
    ("air", Symbol::Line, "knife up (C axis)"),
    ("drill", Symbol::Target, "drill"),
    ("notch", Symbol::Line, "notch: slit or V"),
];

/// The style element: what is common, then the colours of the pieces.
pub(super) fn style(colours: &str) -> String {
    format!("<style>\n{STYLE}{colours}</style>\n")
}

fn caption(context: &Context) -> String {
    let marker = context.marker;
    let (w, h) = marker.extent().size();
    let knife = &context.job.profile.knife;
    let pieces = match marker.pieces.len() {
        1 => "1 piece".to_owned(),
        n => format!("{n} pieces"),
    };
    format!(
        "{pieces}, {} x {} mm, cut {} m; blade {} mm, C axis {} mm behind the tip",
        fixed(w, 1),
        fixed(h, 1),
        fixed(marker.cut_length() / MM_PER_M, 2),
        short(knife.width_mm),
        short(knife.radius())
    )
}

/// A number without the zeros that say nothing.
fn short(value: f64) -> String {
    let text = fixed(value, 3);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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
