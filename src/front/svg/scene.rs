//! What an element has from those around it.

use roxmltree::Node;
use svgtypes::Color;

use super::page::INKSCAPE;
use super::style::{self, Style};
use super::transform::Pair;
use crate::geom::affine::Affine;

/// Properties that an element has from those around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scene<'a> {
    /// From its units to mm.
    pub(super) map: Affine,
    /// Width and height that percents are of, in its units.
    pub(super) whole: Pair,
    stroke: &'a str,
    fill: &'a str,
    pub(super) is_visible: bool,
    /// Name of the layer of Inkscape, and of the outermost group with a name.
    layer: Option<&'a str>,
    group: Option<&'a str>,
    /// Elements around it.
    pub(super) depth: usize,
    /// Whether it is a copy that `use` makes.
    pub(super) is_copy: bool,
}

impl<'a> Scene<'a> {
    /// The scene of a page.
    pub(super) fn of_page(map: Affine, whole: Pair) -> Self {
        Self {
            map,
            whole,
            stroke: "none",
            fill: "black",
            is_visible: true,
            layer: None,
            group: None,
            depth: 0,
            is_copy: false,
        }
    }

    /// With the style of an element.
    #[must_use]
    pub(super) fn styled(self, style: &Style<'a>) -> Self {
        let own = |property: usize| style[property].filter(|value| *value != "inherit");
        Self {
            stroke: own(style::STROKE).unwrap_or(self.stroke),
            fill: own(style::FILL).unwrap_or(self.fill),
            is_visible: own(style::VISIBILITY).map_or(self.is_visible, |value| value == "visible"),
            depth: self.depth + 1,
            ..self
        }
    }

    /// With the name of a group.
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

    /// Whether a line along a shape is seen.
    pub(super) fn has_stroke(&self) -> bool {
        is_paint(self.stroke)
    }

    /// Whether the area of a shape is.
    pub(super) fn has_fill(&self) -> bool {
        is_paint(self.fill)
    }

    /// Name of the layer that a shape is in, or the colour of its line or area.
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
    !paint.eq_ignore_ascii_case("none") && !paint.eq_ignore_ascii_case("transparent")
}
