//! Drawing of shapes and texts: the elements with content of their own.

use std::f64::consts::TAU;
use std::ops::Range;

use roxmltree::{Attribute, Node};

use super::curve::{Curve, Elliptic};
use super::path::{self, Fault, Step};
use super::scan::Scan;
use super::scene::Scene;
use super::shape::{self, BadValue};
use super::transform::{Pair, led, placed};
use super::walk::Walk;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::Point;
use crate::ir::marker::Label;
use crate::source::Span;

/// Steps, each with its byte range in the attribute.
type Steps = Result<Vec<(Step, Range<usize>)>, Fault>;

impl<'a, 'input> Walk<'a, 'input, '_> {
    /// Draws a shape.
    pub(super) fn shape(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) -> Result<(), BadValue> {
        let span = self.span(node);
        let name = node.tag_name().name();
        shape::check(node)?;
        if !scene.is_visible {
            self.tally.hide(1, span);
            return Ok(());
        }
        if !scene.has_stroke() && (!scene.has_fill() || name == "line") {
            self.tally.lack_line(span);
            return Ok(());
        }
        let drawn = self.pencil.drawing.strokes.len();
        self.outline(node, scene)?;
        self.lay(drawn, &scene);
        Ok(())
    }

    /// Draws the outline of a shape.
    fn outline(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) -> Result<(), BadValue> {
        let (span, name) = (self.span(node), node.tag_name().name());
        let by = self.measure(scene);
        match name {
            "path" => self.listed(node, "d", path::read, scene),
            "polyline" | "polygon" => self.listed(node, "points", shape::points, scene),
            "circle" | "ellipse" => {
                if let Some([centre, radii]) = shape::ellipse(node, by)? {
                    self.ellipse(centre, radii, scene, span);
                }
            }
            _ => {
                let steps = if name == "rect" { shape::rectangle(node, by)? } else { shape::line(node, by)? };
                self.trace(steps.into_iter().map(|step| (step, span)), scene);
            }
        }
        Ok(())
    }

    /// Draws the path data or points in an attribute.
    fn listed(&mut self, node: Node<'a, 'input>, name: &str, read: fn(&str) -> Steps, scene: Scene<'a>) {
        let Some(attribute) = node.attribute_node(name) else { return };
        let number = self.number(node);
        let range = attribute.range_value();
        let text = self.data(&attribute);
        // Character references shift the text after them; its ranges are clamped to the attribute.
        let at = |place: usize| (range.start + place).min(range.end);
        let spot = |letters: Range<usize>| at(letters.start)..at(letters.end);
        match read(text) {
            Err(Fault { at: place, what }) => {
                let span = self.letters.span(spot(place..place + 1), number);
                let finding = Diagnostic::new(&code::SVG_PATH, what).at(span);
                self.out.push(finding.hint("the file was damaged or cut short: save the drawing again"));
            }
            Ok(steps) => {
                let letters = self.letters;
                let steps = steps.into_iter().map(|(step, range)| (step, letters.span(spot(range), number)));
                let close = (node.tag_name().name() == "polygon").then(|| (Step::Close, self.span(node)));
                let steps: Vec<(Step, Span)> = steps.chain(close).collect();
                self.trace(steps.into_iter(), scene);
            }
        }
    }

    /// The value of an attribute: the raw text of the file unless it contains references.
    fn data(&self, attribute: &Attribute<'a, 'input>) -> &'a str {
        let raw = &self.letters.text[attribute.range_value()];
        if raw.contains('&') { attribute.value() } else { raw }
    }

    /// Draws the steps of a path.
    fn trace(&mut self, steps: impl Iterator<Item = (Step, Span)>, scene: Scene) {
        for (step, span) in steps {
            if let Err(fault) = self.pencil.draw(step, scene.map, span) {
                self.refuse(fault);
                break;
            }
        }
        self.pencil.lift();
    }

    /// Draws an ellipse.
    fn ellipse(&mut self, centre: Pair, [rx, ry]: Pair, scene: Scene, span: Span) {
        let (start, map) = ([centre[0] + rx, centre[1]], scene.map);
        let to = placed(&map, start);
        let axes = [led(&map, [rx, 0.0]), led(&map, [0.0, ry])];
        let curve = Curve::Elliptic(Elliptic { centre: placed(&map, centre), axes, start: 0.0, sweep: TAU, to });
        let drawn = self.pencil.draw(Step::Move(start), map, span);
        if let Err(fault) = drawn.and_then(|()| self.pencil.curve(&curve, map, span)) {
            self.refuse(fault);
        }
        self.pencil.lift();
    }

    /// Makes the labels of a text.
    pub(super) fn text(&mut self, text: Node<'a, 'input>, scene: Scene<'a>) {
        if !scene.is_visible {
            self.tally.hide(1, self.span(text));
            return;
        }
        let parts =
            text.descendants().filter(|node| node.is_text() && node.text().is_some_and(|t| !t.trim().is_empty()));
        for part in parts {
            // Text in another encoding would give wrong labels.
            if !self.letters.are_plain() {
                let span = self.span(text);
                self.tally.leave_out("text", span);
                self.unread.push(("text".to_owned(), scene.layer(), span));
                return;
            }
            let place = |name: &str| {
                let around = part.ancestors().take_while(|node| Some(*node) != text.parent());
                let first = |node: Node| Scan::of(node.attribute(name)?).number();
                around.filter(Node::is_element).find_map(first).unwrap_or(0.0)
            };
            let [x, y] = Self::placed(&scene, [place("x"), place("y")]);
            let range = part.range();
            let raw = &self.letters.text[range.clone()];
            let start = range.start + raw.len() - raw.trim_start().len();
            let span = self.letters.span(start..start + raw.trim().len(), self.number(text));
            let at = Some(Point::new(x, y)).filter(|at| at.iter().all(|number| number.is_finite()));
            self.pencil.drawing.texts.push(Label { at, heading: None, span, mirrored: None });
        }
    }
}
