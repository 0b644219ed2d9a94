//! Outlines of shapes.

use std::f64::consts::TAU;

use roxmltree::Node;

use super::map::Map;
use super::numbers::{length, list};
use super::path;
use super::pen::{Bow, Pen};
use super::trace::Trace;

/// Units of an element's lengths: pixels per inch, and the size that percentages refer to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ruler {
    pub(super) dots: f64,
    pub(super) whole: [f64; 2],
}

impl Ruler {
    /// Length of an element by the name of its attribute, which determines the size that percentages refer to.
    pub(super) fn of(self, node: Node, name: &str) -> Option<f64> {
        let [width, height] = self.whole;
        let whole = match name {
            "x" | "x1" | "x2" | "cx" | "rx" | "width" => width,
            "r" => f64::midpoint(width * width, height * height).sqrt(),
            _ => height,
        };
        length(node.attribute(name)?, self.dots, whole)
    }

    fn or_zero(self, node: Node, name: &str) -> f64 {
        self.of(node, name).unwrap_or(0.0)
    }
}

/// Draws a shape.
pub(super) fn draw(node: Node, map: Map, ruler: Ruler, pen: &mut Pen) {
    let name = node.tag_name().name();
    let text = |name: &str| node.attribute(name).unwrap_or_default();
    let mut trace = Trace::new(pen, map, matches!(name, "path" | "polyline" | "polygon"));
    match name {
        "path" => path::follow(text("d"), &mut trace),
        "polyline" | "polygon" => {
            let numbers = list(text("points"));
            let (pairs, _) = numbers.as_chunks::<2>();
            if let Some((first, rest)) = pairs.split_first() {
                trace.start(*first);
                for &to in rest {
                    trace.line(to);
                }
            }
            if name == "polygon" {
                trace.close();
            }
        }
        "line" => {
            trace.start(["x1", "y1"].map(|name| ruler.or_zero(node, name)));
            trace.line(["x2", "y2"].map(|name| ruler.or_zero(node, name)));
        }
        "rect" => rectangle(node, ruler, &mut trace),
        _ => ellipse(node, ruler, &mut trace),
    }
    pen.lift();
}

/// Rectangle from its upper left corner, along growing x, then growing y.
fn rectangle(node: Node, ruler: Ruler, trace: &mut Trace) {
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| ruler.or_zero(node, name));
    let [rx, ry] = ["rx", "ry"].map(|name| ruler.of(node, name));
    let [rx, ry] = [rx.or(ry).unwrap_or(0.0).min(width / 2.0), ry.or(rx).unwrap_or(0.0).min(height / 2.0)];
    if width <= 0.0 || height <= 0.0 {
        return;
    }
    let (right, bottom) = (x + width, y + height);
    let is_round = rx > 0.0 && ry > 0.0;
    let [rx, ry] = if is_round { [rx, ry] } else { [0.0; 2] };
    trace.start([x + rx, y]);
    // Ends of a side, and of the corner behind it.
    let sides = [
        ([right - rx, y], [right, y + ry]),
        ([right, bottom - ry], [right - rx, bottom]),
        ([x + rx, bottom], [x, bottom - ry]),
        ([x, y + ry], [x + rx, y]),
    ];
    for (side, corner) in sides {
        trace.line(side);
        if is_round {
            trace.arc([rx, ry, 0.0], [false, true], corner);
        }
    }
    trace.close();
}

/// Full ellipse from its place of greatest x, towards growing y.
fn ellipse(node: Node, ruler: Ruler, trace: &mut Trace) {
    let radius = ruler.of(node, "r").filter(|_| node.tag_name().name() == "circle");
    let own = |name: &str| ruler.of(node, name).filter(|_| node.tag_name().name() == "ellipse");
    let [rx, ry] = [radius.or(own("rx")).or(own("ry")), radius.or(own("ry")).or(own("rx"))];
    let (Some(rx), Some(ry)) = (rx.filter(|rx| *rx > 0.0), ry.filter(|ry| *ry > 0.0)) else { return };
    let [cx, cy] = ["cx", "cy"].map(|name| ruler.or_zero(node, name));
    let axes = [trace.map.along(rx, 0.0), trace.map.along(0.0, ry)];
    trace.start([cx + rx, cy]);
    trace.bow(&Bow::Ellipse { centre: trace.map.at(cx, cy), axes, start: 0.0, sweep: TAU }, [cx + rx, cy]);
}
