//! Text, numbers and path data in the syntax of XML and SVG.

use std::fmt::Write;

use crate::geom::Point;
pub(super) use crate::picture::escape;
use crate::source::Span;
use crate::units::number;

/// Decimals of coordinates, mm: a micrometre, far below the accuracy of cloth or blade.
const DECIMALS: u32 = 3;

/// A length or coordinate in mm as an attribute value.
pub(super) fn mm(value: f64) -> String {
    number::fixed(value, DECIMALS)
}

/// A number without trailing zeros.
pub(super) fn short(value: f64) -> String {
    let text = number::fixed(value, 3);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Path data: any number of polylines and circles.
#[derive(Debug, Default)]
pub(super) struct PathData(Vec<u8>);

impl PathData {
    /// Adds a polyline.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = Point>) {
        for (i, point) in points.into_iter().enumerate() {
            self.0.push(if i == 0 { b'M' } else { b' ' });
            self.pair(point.x, point.y);
        }
    }

    /// Adds a polygon; its first point is not repeated.
    pub(super) fn polygon(&mut self, points: impl IntoIterator<Item = Point>) {
        self.line(points);
        self.0.push(b'Z');
    }

    /// Adds a circle.
    pub(super) fn circle(&mut self, centre: Point, radius: f64) {
        self.0.push(b'M');
        self.pair(centre.x - radius, centre.y);
        for across in [2.0 * radius, -2.0 * radius] {
            self.0.push(b'a');
            self.pair(radius, radius);
            self.0.extend_from_slice(b" 0 1 0 ");
            self.pair(across, 0.0);
        }
        self.0.push(b'Z');
    }

    fn pair(&mut self, x: f64, y: f64) {
        number::push_fixed(&mut self.0, x, DECIMALS);
        self.0.push(b',');
        number::push_fixed(&mut self.0, y, DECIMALS);
    }

    /// The path element with a style class; empty when the path is empty.
    pub(super) fn element(&self, class: &str) -> String {
        self.titled(class, "")
    }

    /// The path element with a title, which browsers show under the pointer.
    pub(super) fn titled(&self, class: &str, title: &str) -> String {
        if self.0.is_empty() {
            return String::new();
        }
        let data = std::str::from_utf8(&self.0).expect("path data is ASCII");
        if title.is_empty() {
            return format!("<path class=\"{class}\" d=\"{data}\"/>\n");
        }
        format!("<path class=\"{class}\" d=\"{data}\"><title>{}</title></path>\n", escape(title))
    }
}

/// The range of source blocks of some spans in words; empty when there are none.
pub(super) fn blocks(spans: impl IntoIterator<Item = Span>) -> String {
    let mut range: Option<(u32, u32)> = None;
    for span in spans {
        // Block 0 means no block.
        if span.block > 0 {
            let (least, greatest) = range.unwrap_or((span.block, span.block));
            range = Some((least.min(span.block), greatest.max(span.block)));
        }
    }
    let mut text = String::new();
    if let Some((least, greatest)) = range {
        let _infallible = if least == greatest {
            write!(text, ", block {least}")
        } else {
            write!(text, ", blocks {least} to {greatest}")
        };
    }
    text
}
