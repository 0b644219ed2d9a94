//! Styles: properties of an element by sheets, attributes and `style`, as far as they decide about its lines.
//!
//! Selectors are names of elements, `*`, classes, ids, and combinations of these without a blank (`path.cut`). Others are
//! reported.

use std::collections::HashMap;

use roxmltree::Node;

/// Properties that matter.
pub(super) const PROPERTIES: [&str; 27] = [
    "display",
    "visibility",
    "stroke",
    "fill",
    "clip-path",
    "mask",
    "marker",
    "marker-start",
    "marker-mid",
    "marker-end",
    "opacity",
    "stroke-opacity",
    "fill-opacity",
    "transform",
    "d",
    "transform-origin",
    "translate",
    "rotate",
    "scale",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "zoom",
    "offset",
    "offset-path",
];
/// Indices of some of them in a [`Style`].
pub(super) const DISPLAY: usize = 0;
pub(super) const VISIBILITY: usize = 1;
pub(super) const STROKE: usize = 2;
pub(super) const FILL: usize = 3;
pub(super) const CLIP_PATH: usize = 4;
pub(super) const MASK: usize = 5;
pub(super) const MARKERS: std::ops::Range<usize> = 6..10;
pub(super) const OPACITY: usize = 10;
pub(super) const STROKE_OPACITY: usize = 11;
pub(super) const FILL_OPACITY: usize = 12;
/// Properties that move or shape lines: attributes of these names are read elsewhere, styles of these names are not written in
/// practice.
const MOVING: std::ops::Range<usize> = 13..27;

/// Values of an element's own properties.
pub(super) type Style<'a> = [Option<&'a str>; PROPERTIES.len()];

/// A rule for one selector.
struct Rule<'a> {
    selector: Selector<'a>,
    declarations: std::rc::Rc<Vec<Declaration<'a>>>,
}

/// A value for a property.
#[derive(Debug, Clone, Copy)]
struct Declaration<'a> {
    property: usize,
    value: &'a str,
    is_important: bool,
}

/// A compound selector.
#[derive(Debug, Default, Clone, PartialEq)]
struct Selector<'a> {
    element: Option<&'a str>,
    id: Option<&'a str>,
    classes: Vec<&'a str>,
}

/// The sheets of a file.
#[derive(Default)]
pub(super) struct Sheets<'a> {
    rules: Vec<Rule<'a>>,
    /// Rules by the id, the class or the element that they need; rules for `*` have an empty name.
    by_key: HashMap<(u8, &'a str), Vec<usize>>,
    /// Selectors and at-rules that are not read.
    pub(super) strange: Vec<&'a str>,
}

impl<'a> Sheets<'a> {
    /// Adds the text of a sheet.
    pub(super) fn add(&mut self, text: &'a str) {
        let mut rest = text;
        while let Some((head, behind)) = until(rest, b"{;") {
            let head = without_comments(head);
            if let Some(after) = behind.strip_prefix(';') {
                rest = after;
                // `@charset`, `@namespace` change nothing here.
                if head.starts_with("@import") {
                    self.strange.push(head);
                }
                continue;
            }
            let (body, after) = block(behind);
            rest = after;
            if head.starts_with('@') {
                if !head.starts_with("@font-face") && !head.starts_with("@keyframes") {
                    self.strange.push(head);
                }
                continue;
            }
            let declarations = std::rc::Rc::new(declarations(body));
            if declarations.is_empty() {
                continue;
            }
            for selector in head.split(',').map(str::trim).filter(|selector| !selector.is_empty()) {
                match Selector::read(selector) {
                    Some(read) => self.push(Rule { selector: read, declarations: declarations.clone() }),
                    None => self.strange.push(selector),
                }
            }
        }
    }

    fn push(&mut self, rule: Rule<'a>) {
        let Selector { element, id, classes } = &rule.selector;
        let key = match (id, classes.first(), element) {
            (Some(id), _, _) => (0, *id),
            (None, Some(class), _) => (1, *class),
            (None, None, Some(element)) => (2, *element),
            (None, None, None) => (3, ""),
        };
        self.by_key.entry(key).or_default().push(self.rules.len());
        self.rules.push(rule);
    }

    /// Style of an element: by its attributes, by sheets, by its `style`, in ascending priority.
    pub(super) fn of(&self, node: Node<'a, '_>) -> Style<'a> {
        let mut style = Style::default();
        for (value, property) in style.iter_mut().zip(&PROPERTIES[..MOVING.start]) {
            *value = node.attribute(*property).map(str::trim).filter(|value| !value.is_empty());
        }
        let mut found = self.matching(node);
        found.sort_unstable_by_key(|&rule| (self.rules[rule].selector.strength(), rule));
        let own = node.attribute("style").map(declarations).unwrap_or_default();
        let sheets = || found.iter().flat_map(|&rule| self.rules[rule].declarations.iter());
        for is_important in [false, true] {
            let said = sheets().chain(&own).filter(|declaration| declaration.is_important == is_important);
            said.for_each(|declaration| style[declaration.property] = Some(declaration.value));
        }
        style
    }

    /// The rules for an element, in any order.
    fn matching(&self, node: Node<'a, '_>) -> Vec<usize> {
        if self.rules.is_empty() {
            return Vec::new();
        }
        let id = node.attribute("id");
        let classes = node.attribute("class").unwrap_or_default();
        let keys = id.map(|id| (0, id)).into_iter().chain(classes.split_ascii_whitespace().map(|class| (1, class)));
        let keys = keys.chain([(2, node.tag_name().name()), (3, "")]);
        let rules = keys.filter_map(|key| self.by_key.get(&key)).flatten().copied();
        let mut found: Vec<usize> = rules.filter(|&rule| self.rules[rule].selector.fits(node)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// Property of a style that moves or shapes an element; `None` if there is none or it has no effect.
pub(super) fn moving(style: &Style) -> Option<&'static str> {
    MOVING.into_iter().find(|&at| style[at].is_some_and(|value| value != "none")).map(|at| PROPERTIES[at])
}

/// True if nothing of an element is seen, with all that it holds: it is not displayed, or wholly transparent.
pub(super) fn is_unseen(style: &Style) -> bool {
    style[DISPLAY] == Some("none") || style[OPACITY].is_some_and(is_transparent)
}

/// True for an opacity of 0 or less.
pub(super) fn is_transparent(opacity: &str) -> bool {
    opacity.trim_end_matches('%').trim().parse().is_ok_and(|opacity: f64| opacity <= 0.0)
}

impl<'a> Selector<'a> {
    /// A compound selector; `None` of any other.
    fn read(text: &'a str) -> Option<Self> {
        let mut selector = Self::default();
        let end = text.find(['.', '#']).unwrap_or(text.len());
        let (element, mut rest) = text.split_at(end);
        if !element.is_empty() && element != "*" {
            selector.element = Some(element).filter(|name| is_name(name));
            selector.element?;
        }
        while let Some(sign) = rest.chars().next() {
            let end = rest[1..].find(['.', '#']).map_or(rest.len(), |at| at + 1);
            let (name, behind) = (&rest[1..end], &rest[end..]);
            if !is_name(name) || sign == '#' && selector.id.is_some() {
                return None;
            }
            if sign == '#' {
                selector.id = Some(name);
            } else {
                selector.classes.push(name);
            }
            rest = behind;
        }
        Some(selector)
    }

    /// Specificity: ids, classes, elements.
    fn strength(&self) -> (usize, usize, usize) {
        (usize::from(self.id.is_some()), self.classes.len(), usize::from(self.element.is_some()))
    }

    fn fits(&self, node: Node) -> bool {
        let classes = node.attribute("class").unwrap_or_default();
        self.element.is_none_or(|name| name == node.tag_name().name())
            && self.id.is_none_or(|id| node.attribute("id") == Some(id))
            && self.classes.iter().all(|class| classes.split_ascii_whitespace().any(|own| own == *class))
    }
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_')
}

/// A text up to the first of some bytes outside comments, and the rest from there.
fn until<'a>(text: &'a str, ends: &[u8]) -> Option<(&'a str, &'a str)> {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at..].starts_with(b"/*") {
            at += 2 + memchr::memmem::find(&bytes[at + 2..], b"*/")? + 2;
        } else if ends.contains(&bytes[at]) {
            return Some((&text[..at], &text[at..]));
        } else {
            at += 1;
        }
    }
    None
}

/// The inside of a block in braces, and what stands behind it. A block without an end goes to the end.
fn block(text: &str) -> (&str, &str) {
    let mut depth = 0;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' if depth == 1 => return (&text[1..at], &text[at + 1..]),
            b'}' => depth -= 1,
            _ => {}
        }
    }
    (&text[1..], "")
}

/// A text behind the comments and the marks of old browsers (`<!--`) at its start.
fn without_comments(text: &str) -> &str {
    let mut text = text.trim();
    loop {
        let behind = match text.strip_prefix("/*") {
            Some(comment) => comment.split_once("*/").map_or("", |(_, behind)| behind),
            None if text.starts_with("<!--") || text.starts_with("-->") => {
                text.trim_start_matches(['<', '!', '-', '>'])
            }
            None => return text,
        };
        text = behind.trim_start();
    }
}

/// The declarations of a `style` or a block that matter here.
fn declarations(text: &str) -> Vec<Declaration<'_>> {
    let declaration = |text| {
        let (name, value) = without_comments(text).split_once(':')?;
        let property = PROPERTIES.iter().position(|known| name.trim().eq_ignore_ascii_case(known))?;
        let value = value.split_once("/*").map_or(value, |(value, _)| value).trim();
        let important = value.rsplit_once('!').filter(|(_, word)| word.trim().eq_ignore_ascii_case("important"));
        let (value, is_important) = important.map_or((value, false), |(value, _)| (value.trim(), true));
        (!value.is_empty()).then_some(Declaration { property, value, is_important })
    };
    text.split(';').filter_map(declaration).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(sheet: &str, element: &str, property: usize, expected: Option<&str>) {
        let text = format!("<svg>{element}</svg>");
        let document = roxmltree::Document::parse(&text).expect("XML");
        let mut sheets = Sheets::default();
        sheets.add(sheet);
        let node = document.root_element().first_element_child().expect("an element");
        assert_eq!(sheets.of(node)[property], expected, "{sheet} {element}");
    }

    #[test]
    fn the_stronger_selector_wins_and_then_the_later_rule() {
        let path = "<path id='p' class='a b' fill='red'/>";
        check("", path, FILL, Some("red"));
        check("path{fill:blue}", path, FILL, Some("blue"));
        check("*{fill:blue} path{fill:green}", path, FILL, Some("green"));
        check("#p{fill:blue} .a{fill:green}", path, FILL, Some("blue"));
        check(".b{fill:blue} .a{fill:green}", path, FILL, Some("green"));
        check("path.a.b{fill:blue} .a{fill:green}", path, FILL, Some("blue"));
        check(".c,.a{fill:blue}", path, FILL, Some("blue"));
        check(".c{fill:blue} rect{fill:blue} #q{fill:blue}", path, FILL, Some("red"));
        check(".a{fill:blue}", "<path class='a' style='stroke:red;fill : none'/>", FILL, Some("none"));
        check(".a{fill:blue!important}", "<path class='a' style='fill:none'/>", FILL, Some("blue"));
        check("<!-- /* x */ .a { display: none } -->", "<g class='a'/>", DISPLAY, Some("none"));
        check("@font-face{a:b} @media print{ .a{display:none} } .a{fill:blue}", "<g class='a'/>", DISPLAY, None);
    }

    #[test]
    fn strange_selectors_are_kept_to_be_told() {
        let mut sheets = Sheets::default();
        sheets
            .add("g path{fill:red} a:hover{fill:red} [x]{stroke:red} b>c{zoom:1} @import url(x); @media all{a{}} d{}");
        assert_eq!(sheets.strange, ["g path", "a:hover", "[x]", "b>c", "@import url(x)", "@media all"]);
    }

    #[test]
    fn sheets_cut_short_are_read_as_far_as_they_go() {
        let text = "/* a */ .a{fill:red;stroke:/*b*/blue} @media x{ .b{fill:none} } .c , #d{display:none}";
        for end in 0..text.len() {
            Sheets::default().add(&text[..end]);
        }
    }
}
