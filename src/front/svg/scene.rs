//! Inherited properties of an element.

use roxmltree::Node;
use svgtypes::Color;

use super::page::INKSCAPE;
use super::style::{self, Style};
use super::transform::Pair;
use crate::geom::affine::Affine;

/// Inherited properties of an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scene<'a> {
    /// Map from its units to mm.
    pub(super) map: Affine,
    /// Reference width and height of percentages, in its units.
    pub(super) whole: Pair,
    stroke: &'a str,
    fill: &'a str,
    /// True if lines, and areas, are wholly transparent.
    is_clear: [bool; 2],
    pub(super) is_visible: bool,
    /// Names of the Inkscape layer and of the outermost named group.
    layer: Option<&'a str>,
    group: Option<&'a str>,
    /// Number of enclosing elements.
    pub(super) depth: usize,
    /// True inside a copy made by `use`.
    pub(super) is_copy: bool,
}

impl<'a> Scene<'a> {
    /// The initial properties on a page.
    pub(super) fn of_page(map: Affine, whole: Pair) -> Self {
        Self {
            map,
            whole,
            stroke: "none",
            fill: "black",
            is_clear: [false; 2],
            is_visible: true,
            layer: None,
            group: None,
            depth: 0,
            is_copy: false,
        }
    }

    /// The properties after applying the style of an element.
    #[must_use]
    pub(super) fn styled(self, style: &Style<'a>) -> Self {
        let own = |property: usize| style[property].filter(|value| *value != "inherit");
        let is_clear = |property: usize, inherited: bool| own(property).map_or(inherited, style::is_transparent);
        Self {
            stroke: own(style::STROKE).unwrap_or(self.stroke),
            fill: own(style::FILL).unwrap_or(self.fill),
            is_clear: [
                is_clear(style::STROKE_OPACITY, self.is_clear[0]),
                is_clear(style::FILL_OPACITY, self.is_clear[1]),
            ],
            is_visible: own(style::VISIBILITY).map_or(self.is_visible, |value| value == "visible"),
            depth: self.depth + 1,
            ..self
        }
    }

    /// The properties inside a named group.
    #[must_use]
    pub(super) fn named(self, node: Node<'a, '_>) -> Self {
        if node.attribute((INKSCAPE, "groupmode")) == Some("layer")
            && let Some(label) = node.attribute((INKSCAPE, "label")).filter(|label| !label.trim().is_empty())
        {
            return Self { layer: Some(label), ..self };
        }
        let id = node.attribute("id").filter(|id| !self.is_copy && !id.trim().is_empty());
        Self { group: self.group.or(id), ..self }
    }

    /// True if the stroke of a shape is visible.
    pub(super) fn has_stroke(&self) -> bool {
        !self.is_clear[0] && is_paint(self.stroke)
    }

    /// True if the fill of a shape is visible.
    pub(super) fn has_fill(&self) -> bool {
        !self.is_clear[1] && is_paint(self.fill)
    }

    /// Name of the layer of a shape, otherwise the colour of its stroke or fill.
    pub(super) fn layer(&self) -> String {
        if let Some(name) = self.layer.or(self.group) {
            return name.to_owned();
        }
        let paint = if self.has_stroke() { self.stroke } else { self.fill };
        match paint.parse::<Color>() {
            Ok(Color { red, green, blue, .. }) => format!("#{red:02x}{green:02x}{blue:02x}"),
            Err(_) => paint.to_owned(),
        }
    }
}

fn is_paint(paint: &str) -> bool {
    let is_clear = || paint.parse::<Color>().is_ok_and(|colour| colour.alpha == 0);
    !paint.eq_ignore_ascii_case("none") && !is_clear()
}
