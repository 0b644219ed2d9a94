//! The sheet: its size, style and frame.

use std::fmt::Write;

use super::bites;
use super::items::items;
use super::mark::Mark;
use super::markup::{PathData, escape, mm, short};
use crate::back::target::{Context, Outcome};
use crate::geom::{Extent, Point, Vector};
use crate::units::number::fixed;
use crate::units::{MM_PER_INCH, MM_PER_M, deg};

/// Window in which the whole drawing should be readable, pixels; text and margins are sized for it.
const WINDOW_PX: [f64; 2] = [1400.0, 800.0];
/// Minimum width of a sheet, pixels: the legend needs it.
const LEAST_WIDTH_PX: f64 = 760.0;
/// Minimum size of a nominal pixel, mm: that of a browser pixel, so that text is readable at actual size.
const LEAST_PX: f64 = MM_PER_INCH / 96.0;
/// Free space around the drawing, pixels.
pub(super) const MARGIN_PX: f64 = 30.0;
/// Height of a line and of text in the legend, pixels.
pub(super) const LINE_PX: f64 = 24.0;
pub(super) const TEXT_PX: f64 = 13.0;
/// Width of a cell of the legend, pixels.
pub(super) const CELL_PX: f64 = 220.0;
/// Length of the arrows at the origin, pixels.
const ARROW_PX: f64 = 26.0;
/// Width of the word `refused` and height of its letters, in font sizes, and the fraction of the drawing that it fills.
const WORD_EMS: f64 = 4.6;
const LETTER_EMS: f64 = 1.0;
const WORD_SHARE: f64 = 0.92;
/// Length of the opening tag in bytes, padded with blanks so that the tail can rewrite it with the final size.
const OPENING_BYTES: usize = 480;

/// Style of all elements. Strokes keep their width on the screen; symbols grow with the zoom.
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
.border{stroke:#c2185b;stroke-width:2.2;stroke-dasharray:9 4}
.common{stroke:#8fd400;stroke-width:5;stroke-opacity:.7}
.near{stroke:#00a3c4;stroke-width:4;stroke-opacity:.6}
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
.declared{stroke:#7a3fb0;stroke-width:1.1}
.declared-text{fill:#6a2fa0}
.doubt{stroke:#ff5a1f;stroke-width:8;stroke-opacity:.5;stroke-linejoin:round}
.doubt-sign{fill:#d23c00;font-weight:bold;text-anchor:middle}
.doubt-text{fill:#b83400}
.verdict{font-weight:bold}
.frame{stroke:#bbb;stroke-width:.7}
.axis{stroke:#666;stroke-width:1.2}
.bar{fill:#333;stroke:#333;stroke-width:1}
.bar-open{fill:#fff;stroke:#333;stroke-width:1}
a{cursor:pointer}
.link{fill:#2a5db0;text-decoration:underline}
";

/// Layout of the sheet in its own coordinates: mm, Y down, the table's origin at (0, 0).
#[derive(Debug)]
pub(super) struct Sheet {
    /// Size of a nominal pixel, mm.
    pub(super) px: f64,
    /// Box of everything that is cut or drilled, in table coordinates (Y up).
    extent: Extent,
    pub(super) left: f64,
    top: f64,
    pub(super) width: f64,
    height: f64,
    /// Top of the legend.
    pub(super) legend: f64,
}

impl Sheet {
    /// The sheet of a marker, with room for the tables of findings, doubts and declarations.
    pub(super) fn of(context: &Context, marks: &[Mark], Outcome { declared, doubts, .. }: Outcome) -> Self {
        let profile = &context.job.profile;
        let extent = context.marker.extent();
        let mut drawn = extent;
        context.marker.pieces.iter().flat_map(|piece| &piece.labels).filter_map(|l| l.at).for_each(|at| drawn.add(at));
        drawn.add(Point::new(profile.home[0], profile.home[1]));
        let aside = context.marker.drawing.iter().flat_map(|account| &account.aside.vertices);
        aside.for_each(|vertex| drawn.add(vertex.at));
        // The scale depends on the marker only, because the head is written before the findings are known.
        let (w, h) = drawn.size();
        let px = (w / WINDOW_PX[0]).max(h / WINDOW_PX[1]).max(LEAST_PX);
        for place in marks.iter().filter_map(|mark| mark.place) {
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
        let tables: usize = [marks.len(), declared.len(), doubts.len()].into_iter().map(table_lines).sum();
        let bites = bites::lines(context, TEXT_PX * px, left + width);
        let lines = 2 + bites + items(context).count().div_ceil(sheet.columns()) + tables;
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

    /// Corners of the part of the sheet above the legend, in table coordinates (Y up), with the first one repeated.
    pub(super) fn edge(&self) -> [Point; 5] {
        let (left, right) = (self.left, self.left + self.width);
        let (top, bottom) = (-self.top, -self.legend);
        [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)].map(|(x, y)| Point::new(x, y))
    }

    /// The whole sheet, as the value of the attribute `viewBox`.
    pub(super) fn view_box(&self) -> String {
        format!("{} {} {} {}", mm(self.left), mm(self.top), mm(self.width), mm(self.height))
    }

    /// Number of legend cells per row.
    pub(super) fn columns(&self) -> usize {
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

    /// The word across the drawing that marks the picture as not a program.
    pub(super) fn refused(&self) -> String {
        let (width, height) = (self.width, self.legend - self.top);
        let slope = height.atan2(width);
        let (sin, cos) = slope.sin_cos();
        // The largest size at which the box around the word, rotated along the diagonal, fits the drawing in width and height.
        let by_width = width / (WORD_EMS * cos + LETTER_EMS * sin);
        let by_height = height / (WORD_EMS * sin + LETTER_EMS * cos);
        let size = WORD_SHARE * by_width.min(by_height);
        // The middle of the letters is on the diagonal.
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

    /// Words that start at a point.
    pub(super) fn text(&self, class: &str, at: Point, words: &str) -> String {
        let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
        // The middle of the letters is at the level of the point.
        let y = at.y + 0.36 * TEXT_PX * self.px;
        let size = mm(TEXT_PX * self.px);
        format!("<text{class} x=\"{}\" y=\"{}\" font-size=\"{size}\">{}</text>\n", mm(at.x), mm(y), escape(words))
    }
}

/// Number of text lines of a table, including its title.
pub(super) fn table_lines(rows: usize) -> usize {
    rows + usize::from(rows > 0)
}

/// The style element: the common style, then the colours of the pieces.
pub(super) fn style(colours: &str) -> String {
    format!("<style>\n{STYLE}{colours}</style>\n")
}

/// Marker and knife in one line.
pub(super) fn caption(context: &Context) -> String {
    let marker = context.marker;
    let (w, h) = marker.extent().size();
    let knife = &context.job.profile.knife;
    let pieces = match marker.piece_count() {
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
