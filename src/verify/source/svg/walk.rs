//! Traversal of the elements that are drawn.

use std::collections::HashMap;
use std::str::FromStr;

use roxmltree::{Document, Node};
use svgtypes::Color;

use super::map::Map;
use super::numbers::list;
use super::outline::{self, Ruler};
use super::page::{INKSCAPE, window};
use super::pen::Pen;
use super::rules::Rules;

/// Maximum nesting depth of elements, copies included, and maximum number of elements; nothing is followed beyond.
const MOST_DEPTH: usize = 210;
const MOST_ELEMENTS: usize = 2_500_000;

/// Elements with children that are followed, and elements that draw a line.
const GROUPS: [&str; 4] = ["g", "a", "svg", "switch"];
const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// Traversal of the elements.
pub(super) struct Walk<'d, 'i, 'p> {
    document: &'d Document<'i>,
    rules: Rules,
    ids: HashMap<&'d str, Node<'d, 'i>>,
    pen: &'p mut Pen,
    elements: usize,
}

/// Inherited properties of an element.
#[derive(Debug, Clone)]
struct State {
    map: Map,
    ruler: Ruler,
    stroke: String,
    fill: String,
    /// True if strokes, and fills, are transparent.
    clear: [bool; 2],
    is_seen: bool,
    /// Label of the Inkscape layer, and id of the outermost group with one.
    label: Option<String>,
    group: Option<String>,
    is_copy: bool,
    depth: usize,
}

impl State {
    /// Name of the layer of a line, or its colour.
    fn layer(&self) -> String {
        if let Some(name) = self.label.as_ref().or(self.group.as_ref()) {
            return name.clone();
        }
        let paint = if self.has_stroke() { &self.stroke } else { &self.fill };
        Color::from_str(paint).map_or_else(
            |_| paint.clone(),
            |colour| format!("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue),
        )
    }

    fn has_stroke(&self) -> bool {
        !self.clear[0] && is_paint(&self.stroke)
    }

    /// Takes over the name of a group.
    fn enter(&mut self, group: Node) {
        let named = |name: Option<&str>| name.filter(|name| !name.trim().is_empty()).map(str::to_owned);
        let label = named(group.attribute((INKSCAPE, "label")))
            .filter(|_| group.attribute((INKSCAPE, "groupmode")) == Some("layer"));
        if label.is_some() {
            self.label = label;
        } else if !self.is_copy && self.group.is_none() {
            self.group = named(group.attribute("id"));
        }
    }
}

fn is_paint(value: &str) -> bool {
    let value = value.to_lowercase();
    value != "none" && Color::from_str(&value).map_or(true, |colour| colour.alpha > 0)
}

/// True for an opacity that lets nothing be seen.
fn is_nothing(opacity: &str) -> bool {
    let number = opacity.strip_suffix('%').unwrap_or(opacity);
    f64::from_str(number.trim()).is_ok_and(|number| number <= 0.0)
}

impl<'d, 'i, 'p> Walk<'d, 'i, 'p> {
    pub(super) fn new(document: &'d Document<'i>, pen: &'p mut Pen) -> Self {
        let (mut rules, mut ids) = (Rules::default(), HashMap::new());
        for node in document.descendants().filter(Node::is_element) {
            if node.tag_name().name() == "style" {
                node.children().filter_map(|child| child.text()).for_each(|sheet| rules.add(sheet));
            }
            if let Some(id) = node.attribute("id") {
                ids.entry(id).or_insert(node);
            }
        }
        Self { document, rules, ids, pen, elements: 0 }
    }

    /// Follows everything that is drawn on a page.
    pub(super) fn run(&mut self, (map, ruler): (Map, Ruler)) {
        let root = self.document.root_element();
        let state = State {
            map,
            ruler,
            stroke: "none".to_owned(),
            fill: "black".to_owned(),
            clear: [false; 2],
            is_seen: true,
            label: None,
            group: None,
            is_copy: false,
            depth: 0,
        };
        if let Some(state) = self.styled(root, &state) {
            self.inside(root, &state);
        }
    }

    fn inside(&mut self, node: Node<'d, 'i>, state: &State) {
        for child in node.children().filter(Node::is_element) {
            self.element(child, state);
        }
    }

    /// True if an element and all in it are transparent.
    fn is_clear(&self, node: Node) -> bool {
        self.rules.value(node, "opacity").is_some_and(|opacity| is_nothing(&opacity))
    }

    /// State of an element; `None` if nothing of it is seen.
    fn styled(&self, node: Node, state: &State) -> Option<State> {
        if self.rules.value(node, "display").as_deref() == Some("none") || self.is_clear(node) {
            return None;
        }
        let value = |name: &str| self.rules.value(node, name).filter(|value| value != "inherit");
        let clear = |name: &str, before: bool| value(name).map_or(before, |opacity| is_nothing(&opacity));
        Some(State {
            stroke: value("stroke").unwrap_or_else(|| state.stroke.clone()),
            fill: value("fill").unwrap_or_else(|| state.fill.clone()),
            clear: [clear("stroke-opacity", state.clear[0]), clear("fill-opacity", state.clear[1])],
            is_seen: value("visibility").map_or(state.is_seen, |value| value == "visible"),
            depth: state.depth + 1,
            ..state.clone()
        })
    }

    fn element(&mut self, node: Node<'d, 'i>, state: &State) {
        let name = node.tag_name().name();
        let is_ours = node.tag_name().namespace() == self.document.root_element().tag_name().namespace();
        let is_drawn = GROUPS.contains(&name) || SHAPES.contains(&name) || name == "use";
        self.elements += 1;
        if !is_ours || !is_drawn || state.depth > MOST_DEPTH || self.elements > MOST_ELEMENTS {
            return;
        }
        let Some(mut state) = self.styled(node, state) else { return };
        if !transform(node, &mut state) {
            return;
        }
        match name {
            "use" => self.copy(node, &state),
            "svg" => self.window(node, &state, [None; 2]),
            "switch" => {
                let is_for_us = |child: &Node| {
                    let languages = child.attribute("systemLanguage").unwrap_or("en");
                    child.is_element()
                        && child.attribute("requiredExtensions").is_none()
                        && languages.split(',').any(|language| language.trim_start().starts_with("en"))
                };
                if let Some(child) = node.children().find(is_for_us) {
                    self.element(child, &state);
                }
            }
            "g" => {
                state.enter(node);
                self.inside(node, &state);
            }
            "a" => self.inside(node, &state),
            _ => self.shape(node, &state),
        }
    }

    /// Draws a shape if it is visible; a `line` element has no area to fill.
    fn shape(&mut self, node: Node, state: &State) {
        let has_area = !state.clear[1] && is_paint(&state.fill) && node.tag_name().name() != "line";
        if !state.is_seen || !state.has_stroke() && !has_area {
            return;
        }
        let before = self.pen.drawn;
        outline::draw(node, state.map, state.ruler, self.pen);
        if self.pen.drawn > before {
            self.pen.layers.insert(state.layer());
        }
    }

    /// Draws a copy: the element is at the place of the copy.
    fn copy(&mut self, node: Node<'d, 'i>, state: &State) {
        let link = node.attribute("href").or_else(|| node.attribute(("http://www.w3.org/1999/xlink", "href")));
        let id = link.and_then(|link| link.trim().strip_prefix('#'));
        let Some(&target) = id.and_then(|id| self.ids.get(id)) else { return };
        let [x, y] = ["x", "y"].map(|name| state.ruler.of(node, name).unwrap_or(0.0));
        let state = State { map: state.map.times(Map::shift(x, y)), is_copy: true, ..state.clone() };
        if !["symbol", "svg"].contains(&target.tag_name().name()) {
            self.element(target, &state);
            return;
        }
        if state.depth > MOST_DEPTH {
            return;
        }
        if self.is_clear(target) {
            return;
        }
        // A symbol is displayed through its copies, regardless of its own properties.
        let size = ["width", "height"].map(|name| state.ruler.of(node, name));
        let Some(mut inner) = self.styled(target, &state).or_else(|| Some(state.clone())) else { return };
        if transform(target, &mut inner) {
            self.window(target, &inner, size);
        }
    }

    /// Draws the inside of an element with a view box, in the size of the copy or of the element.
    fn window(&mut self, node: Node<'d, 'i>, state: &State, copied: [Option<f64>; 2]) {
        let mut inner = state.clone();
        let own = ["width", "height"].map(|name| state.ruler.of(node, name));
        let size: [f64; 2] = std::array::from_fn(|k| copied[k].or(own[k]).unwrap_or(state.ruler.whole[k]));
        if node.tag_name().name() == "svg" {
            let [x, y] = ["x", "y"].map(|name| state.ruler.of(node, name).unwrap_or(0.0));
            inner.map = inner.map.times(Map::shift(x, y));
        }
        inner.ruler.whole = size;
        if let Some(view) = node.attribute("viewBox").map(list).and_then(|list| <[f64; 4]>::try_from(list).ok()) {
            let Some(map) = window(view, size, node.attribute("preserveAspectRatio")) else { return };
            inner.map = inner.map.times(map);
            inner.ruler.whole = [view[2], view[3]];
        }
        if size[0] > 0.0 && size[1] > 0.0 {
            self.inside(node, &inner);
        }
    }
}

/// Applies the transform of an element; `false` if it cannot be read.
fn transform(node: Node, state: &mut State) -> bool {
    let Some(map) = node.attribute("transform").map_or(Some(Map::shift(0.0, 0.0)), Map::read) else { return false };
    state.map = state.map.times(map);
    true
}
