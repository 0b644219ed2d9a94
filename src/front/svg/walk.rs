//! The elements of a file, in the order in which they are drawn.

use std::collections::HashMap;
use std::ops::Range;

use roxmltree::{Document, Node, NodeId};

use super::letters::Letters;
use super::page::Page;
use super::pencil::Pencil;
use super::scene::Scene;
use super::shape::{BadValue, Measure, Of};
use super::style::{self, Sheets, Style};
use super::tally::Tally;
use super::transform::{Pair, placed, transform};
use super::viewport::{ViewBox, fit};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Vector;
use crate::geom::affine::Affine;
use crate::ir::Drawing;
use crate::ir::drawing::Unread;
use crate::source::Span;

/// Elements around each other, copies included: nobody nests so deep, and the stack is not endless.
const MOST_DEPTH: usize = 200;
/// Copies that `use` makes, and elements that are drawn in all.
const MOST_COPIES: usize = 100_000;
const MOST_ELEMENTS: usize = 2_000_000;
/// Layers that are told apart, and the name of all others: a thousand groups with names are no layers.
const MOST_LAYERS: usize = 10_000;
const OTHERS: &str = "others";
const XLINK: &str = "http://www.w3.org/1999/xlink";
/// Elements that draw nothing by themselves.
const SILENT: &[&str] = &[
    "clipPath",
    "color-profile",
    "cursor",
    "defs",
    "desc",
    "filter",
    "font",
    "font-face",
    "linearGradient",
    "marker",
    "mask",
    "mesh",
    "meshgradient",
    "metadata",
    "pattern",
    "radialGradient",
    "script",
    "solidcolor",
    "style",
    "symbol",
    "title",
    "view",
    "solidColor",
    "hatch",
];
/// Elements that draw lines or letters, or copy others that do.
const DRAWN: &[&str] = &["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "use"];
/// Elements that change another one in time.
const ANIMATIONS: &[&str] = &["animate", "animateColor", "animateMotion", "animateTransform", "set"];

/// Traversal of the elements.
pub(super) struct Walk<'a, 'input, 'o> {
    pub(super) letters: &'a Letters<'a>,
    pub(super) page: Page,
    sheets: Sheets<'a>,
    ids: HashMap<&'a str, Node<'a, 'input>>,
    /// Numbers of the elements, from 1, by their nodes.
    numbers: Vec<u32>,
    pub(super) pencil: Pencil,
    pub(super) tally: Tally,
    pub(super) out: &'o mut Diagnostics,
    layers: HashMap<String, u16>,
    /// Items that are drawn and not read: kind, layer and place.
    pub(super) unread: Vec<(String, String, Span)>,
    /// Copies under construction.
    uses: Vec<NodeId>,
    copies: usize,
    elements: usize,
    /// True if the drawing is too large to go on.
    is_stopped: bool,
}

impl<'a, 'input, 'o> Walk<'a, 'input, 'o> {
    /// A walk through a document whose curves become chords within `sagitta` mm.
    pub(super) fn new(
        document: &'a Document<'input>,
        letters: &'a Letters<'a>,
        page: Page,
        sagitta: f64,
        out: &'o mut Diagnostics,
    ) -> Self {
        let (mut sheets, mut ids, mut numbers, mut number) = (Sheets::default(), HashMap::new(), Vec::new(), 0);
        for node in document.descendants() {
            number += u32::from(node.is_element());
            numbers.push(number);
            if let Some(id) = node.attribute("id") {
                ids.entry(id).or_insert(node);
            }
            if node.is_element() && node.tag_name().name() == "style" {
                node.children().filter_map(|child| child.text()).for_each(|text| sheets.add(text));
            }
        }
        Self {
            letters,
            page,
            sheets,
            ids,
            numbers,
            pencil: Pencil::new(sagitta),
            tally: Tally::default(),
            out,
            layers: HashMap::new(),
            unread: Vec::new(),
            uses: Vec::new(),
            copies: 0,
            elements: 0,
            is_stopped: false,
        }
    }

    /// Drawing of the document.
    pub(super) fn run(mut self, root: Node<'a, 'input>) -> Drawing {
        let style = self.sheets.of(root);
        let scene = Scene::of_page(self.page.map, self.page.whole).styled(&style);
        if style::is_unseen(&style) {
            self.hide(root);
        } else {
            self.children(root, scene);
        }
        self.account();
        self.tally.tell(&self.sheets.strange, self.out);
        self.pencil.drawing
    }

    fn children(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) {
        for child in node.children() {
            if child.is_element() {
                self.element(child, scene);
            } else if child.is_text() && child.text().is_some_and(|text| text.trim_end().ends_with('>')) {
                let Range { start, end } = child.range();
                let start = end - self.letters.text[start..end].trim_start().len();
                let span = self.letters.span(start..end, self.number(node));
                let finding =
                    Diagnostic::new(&code::SVG_NOT_XML, "an element has lost the `<` before its name").at(span);
                self.out.push(finding.hint("the file was damaged, or edited by hand: save the drawing again"));
            }
        }
    }

    /// Draws an element.
    fn element(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) {
        let name = node.tag_name().name();
        let is_foreign = node.tag_name().namespace() != node.document().root_element().tag_name().namespace();
        if self.is_stopped || is_foreign || SILENT.contains(&name) {
            return;
        }
        let span = self.span(node);
        self.elements += 1;
        if scene.depth > MOST_DEPTH || self.elements > MOST_ELEMENTS {
            let what = format!("elements stand more than {MOST_DEPTH} deep in each other");
            self.stop(if scene.depth > MOST_DEPTH { what } else { "copies draw too many elements".to_owned() }, span);
            return;
        }
        let style = self.sheets.of(node);
        if style::is_unseen(&style) {
            self.hide(node);
            return;
        }
        if ANIMATIONS.contains(&name) {
            self.tally.leave_out(name, span);
            return;
        }
        self.tell_style(&style, span);
        let mut scene = scene.styled(&style);
        if let Some(text) = node.attribute("transform") {
            let Some(map) = transform(text) else {
                self.blame(node, ("transform", "this is no list of transforms that can be read"));
                return;
            };
            scene.map = map.then(&scene.map);
            if node.attribute("transform-origin").is_some_and(|origin| !is_corner(origin)) {
                let message = "`transform-origin` moves the centre of a transform, and is not read";
                let finding = Diagnostic::new(&code::SVG_STYLE_MOVES, message).at(span);
                self.out
                    .push(finding.hint("write the centre into `transform`, or save the drawing from another program"));
            }
        }
        if let Err(fault) = self.follow(node, scene) {
            self.blame(node, fault);
        }
    }

    /// Draws an element that is displayed, in a scene of its own.
    fn follow(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) -> Result<(), BadValue> {
        match node.tag_name().name() {
            "g" => self.children(node, scene.named(node)),
            "a" => self.children(node, scene),
            "svg" => return self.viewport(node, scene, [None; 2]),
            "switch" => {
                if let Some(child) = node.children().find(|child| child.is_element() && is_fitting(*child)) {
                    self.element(child, scene);
                }
            }
            "use" => return self.copy(node, scene),
            "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" => return self.shape(node, scene),
            "text" => self.text(node, scene),
            name => {
                let span = self.span(node);
                self.tally.leave_out(name, span);
                self.unread.push((name.to_owned(), scene.layer(), span));
            }
        }
        Ok(())
    }

    /// Counts the shapes and texts of an element that is not seen.
    fn hide(&mut self, node: Node<'a, 'input>) {
        let is_silent = |node: &Node| SILENT.contains(&node.tag_name().name());
        let is_drawn =
            |node: &Node| DRAWN.contains(&node.tag_name().name()) && !node.ancestors().any(|node| is_silent(&node));
        let count = node.descendants().filter(is_drawn).count();
        self.elements += count;
        self.tally.hide(count, self.span(node));
    }

    /// Reports styles that change what is visible and are not obeyed.
    fn tell_style(&mut self, style: &Style, span: Span) {
        if let Some(property) = style::moving(style) {
            let message = format!("a style gives the property `{property}`, which moves or shapes what it is of");
            let finding = Diagnostic::new(&code::SVG_STYLE_MOVES, message).at(span);
            self.out.push(finding.hint("write it as an attribute, or save the drawing from another program"));
        }
        let is_set = |at: usize| style[at].is_some_and(|value| value != "none");
        for at in [style::CLIP_PATH, style::MASK] {
            if is_set(at) {
                self.tally.leave_out(style::PROPERTIES[at], span);
            }
        }
        if style::MARKERS.into_iter().any(is_set) {
            self.tally.leave_out("marker", span);
        }
    }

    /// The inside of an element with a viewport, in the size of the element or of its copy.
    fn viewport(&mut self, node: Node<'a, 'input>, scene: Scene<'a>, copied: [Option<f64>; 2]) -> Result<(), BadValue> {
        let by = self.measure(scene);
        let is_symbol = node.tag_name().name() == "symbol";
        let at = |name, of| if is_symbol { Ok(0.0) } else { by.place(node, name, of) };
        let at = [at("x", Of::Width)?, at("y", Of::Height)?];
        let own = [by.size(node, "width", Of::Width)?, by.size(node, "height", Of::Height)?];
        let size = [0, 1].map(|axis| copied[axis].or(own[axis]).unwrap_or(scene.whole[axis]));
        let mut inner = scene;
        (inner.map, inner.whole) = (Affine::shift(Vector::from(at)).then(&scene.map), size);
        if let Some(text) = node.attribute("viewBox") {
            let view = ViewBox::read(text).ok_or(("viewBox", "this is no view box: four numbers, the size above 0"))?;
            let map = fit(view, size, node.attribute("preserveAspectRatio"));
            let map = map.ok_or(("preserveAspectRatio", "this is no rule for the shape of the view box"))?;
            inner.map = map.then(&inner.map);
            inner.whole = view.size;
        }
        if size.iter().all(|&size| size > 0.0) {
            self.children(node, inner);
        }
        Ok(())
    }

    /// A copy of another element.
    fn copy(&mut self, node: Node<'a, 'input>, scene: Scene<'a>) -> Result<(), BadValue> {
        let name = if node.has_attribute("href") { "href" } else { "xlink:href" };
        let link = node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default().trim();
        let Some(target) = link.strip_prefix('#').and_then(|id| self.ids.get(id).copied()) else {
            return Err((name, "there is no element of this id in the file"));
        };
        if self.uses.contains(&node.id()) || node.ancestors().any(|around| around == target) {
            return Err((name, "the copy would hold itself"));
        }
        let by = self.measure(scene);
        let at = [by.place(node, "x", Of::Width)?, by.place(node, "y", Of::Height)?];
        let size = [by.size(node, "width", Of::Width)?, by.size(node, "height", Of::Height)?];
        self.copies += 1;
        if self.copies > MOST_COPIES {
            self.stop(format!("`use` makes more than {MOST_COPIES} copies"), self.span(node));
            return Ok(());
        }
        let mut inner = scene;
        (inner.map, inner.is_copy) = (Affine::shift(Vector::from(at)).then(&scene.map), true);
        self.uses.push(node.id());
        let drawn = match target.tag_name().name() {
            "symbol" | "svg" => self.copied_viewport(target, &mut inner, size),
            _ => {
                self.element(target, inner);
                Ok(())
            }
        };
        self.uses.pop();
        drawn
    }

    /// A copy of an element with a viewport.
    fn copied_viewport(
        &mut self,
        target: Node<'a, 'input>,
        scene: &mut Scene<'a>,
        size: [Option<f64>; 2],
    ) -> Result<(), BadValue> {
        if scene.depth > MOST_DEPTH {
            self.stop(format!("copies stand more than {MOST_DEPTH} deep in each other"), self.span(target));
            return Ok(());
        }
        let style = self.sheets.of(target);
        if style[style::OPACITY].is_some_and(style::is_transparent) {
            self.hide(target);
            return Ok(());
        }
        self.tell_style(&style, self.span(target));
        let mut inner = scene.styled(&style);
        if let Some(text) = target.attribute("transform") {
            let map = transform(text).ok_or(("transform", "a symbol has no list of transforms that can be read"))?;
            inner.map = map.then(&inner.map);
        }
        self.viewport(target, inner, size)
    }

    /// Measures of the lengths of an element.
    pub(super) fn measure(&self, scene: Scene) -> Measure {
        Measure { pixel: self.page.pixel, whole: scene.whole }
    }

    /// Assigns the strokes after the first `strokes` to the layer of a scene.
    pub(super) fn lay(&mut self, strokes: usize, scene: &Scene) {
        let drawing = &mut self.pencil.drawing;
        if drawing.strokes.len() == strokes {
            return;
        }
        let name = scene.layer();
        let is_told = self.layers.contains_key(&name) || self.layers.len() < MOST_LAYERS;
        let name = if is_told { name } else { OTHERS.to_owned() };
        let pen = *self.layers.entry(name).or_insert_with_key(|name| drawing.layer(name));
        drawing.strokes[strokes..].iter_mut().for_each(|stroke| stroke.pen = pen);
    }

    /// Records drawn items that are not read, if their layer also draws lines.
    fn account(&mut self) {
        for (kind, layer, span) in std::mem::take(&mut self.unread) {
            if let Some(&pen) = self.layers.get(&layer) {
                self.pencil.drawing.unread.push(Unread { kind, pen, span });
            }
        }
    }

    /// Span of the start tag of an element, the place of everything that it draws.
    pub(super) fn span(&self, node: Node) -> Span {
        let start = node.range().start;
        let name = self.letters.text[start..].find(|c: char| c.is_whitespace() || c == '>' || c == '/').unwrap_or(1);
        self.letters.span(start..start + name, self.number(node))
    }

    /// Number of an element in the file, from 1.
    pub(super) fn number(&self, node: Node) -> u32 {
        self.numbers.get(node.id().get_usize()).copied().unwrap_or(1)
    }

    /// Reports a fault of an attribute; its element is not drawn.
    fn blame(&mut self, node: Node, (name, what): BadValue) {
        let local = name.rsplit(':').next().unwrap_or(name);
        let attribute = node.attributes().find(|attribute| attribute.name() == local);
        let span = attribute.map(|attribute| self.letters.span(attribute.range_value(), self.number(node)));
        let code = if local == "href" { &code::SVG_USE } else { &code::SVG_VALUE };
        let finding = Diagnostic::new(code, format!("`{name}` of `{}`: {what}", node.tag_name().name()));
        self.out.push(finding.at(span.unwrap_or_else(|| self.span(node))).hint(if local == "href" {
            "turn copies into shapes of their own (Inkscape: Edit, Clone, Unlink) and save again"
        } else {
            "the file was damaged, or written by hand: save the drawing again"
        }));
    }

    /// Refuses a drawing that is too large.
    fn stop(&mut self, message: String, span: Span) {
        self.is_stopped = true;
        let finding = Diagnostic::new(&code::SVG_TOO_MUCH, message).at(span);
        self.out.push(finding.hint("turn copies into shapes of their own, ungroup, and save the drawing again"));
    }

    /// Refuses the lines of a shape.
    pub(super) fn refuse(&mut self, fault: Diagnostic) {
        self.is_stopped |= fault.code == &code::SVG_TOO_MUCH;
        self.out.push(fault);
    }

    /// Place on the page of a place in a scene, mm.
    pub(super) fn placed(scene: &Scene, at: Pair) -> Pair {
        placed(&scene.map, at)
    }
}

/// True if a child of `switch` suits this reader: it requires no extension, and no language but English.
fn is_fitting(node: Node) -> bool {
    let is_english = |languages: &str| languages.split(',').any(|language| language.trim().starts_with("en"));
    !node.has_attribute("requiredExtensions") && node.attribute("systemLanguage").is_none_or(is_english)
}

/// True if the centre of a transform is the corner of the page, which is the default.
fn is_corner(origin: &str) -> bool {
    let mut values = origin.split([' ', ',']).filter(|value| !value.is_empty());
    values.all(|value| value.trim_end_matches("px").parse() == Ok(0.0))
}
