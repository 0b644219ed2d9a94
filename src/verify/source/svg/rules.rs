//! Style sheets, as far as they determine what is drawn.

use std::collections::HashMap;

use roxmltree::Node;

/// Part of a selector.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Part {
    Any,
    Element(String),
    Class(String),
    Id(String),
}

/// Value of a property, with its rank: importance, numbers of ids, classes and elements, and position among all rules.
#[derive(Debug)]
struct Value {
    rank: (bool, [usize; 3], usize),
    property: String,
    text: String,
}

/// Style sheets of a document.
#[derive(Default)]
pub(super) struct Rules {
    /// Selectors in parts, each with its values.
    all: Vec<(Vec<Part>, Vec<Value>)>,
    by_part: HashMap<Part, Vec<usize>>,
}

impl Rules {
    /// Adds a style sheet.
    pub(super) fn add(&mut self, sheet: &str) {
        let plain = without_comments(sheet).replace("<!--", " ").replace("-->", " ");
        let (mut head, mut body, mut depth) = (String::new(), String::new(), 0_usize);
        for letter in plain.chars() {
            match letter {
                '{' if depth == 0 => depth = 1,
                '}' if depth == 1 => {
                    self.rule(head.trim(), &body);
                    (head, body, depth) = (String::new(), String::new(), 0);
                }
                // Statement without a block.
                ';' if depth == 0 => head.clear(),
                letter if depth == 0 => head.push(letter),
                letter => {
                    depth = if letter == '{' { depth + 1 } else { depth - usize::from(letter == '}') };
                    body.push(letter);
                }
            }
        }
        if depth > 0 {
            self.rule(head.trim(), &body);
        }
    }

    fn rule(&mut self, head: &str, body: &str) {
        if head.starts_with('@') {
            return;
        }
        for selector in head.split(',') {
            let Some(parts) = parts(selector.trim()) else { continue };
            let count = |is: fn(&Part) -> bool| parts.iter().filter(|part| is(part)).count();
            let strength = [
                count(|part| matches!(part, Part::Id(_))),
                count(|part| matches!(part, Part::Class(_))),
                count(|part| matches!(part, Part::Element(_))),
            ];
            let place = self.all.len();
            let value =
                |(property, text, is_important)| Value { rank: (is_important, strength, place), property, text };
            let values = declarations(body).into_iter().map(value).collect();
            // Index by the last part, which the fewest elements have.
            let key = parts.last().cloned().unwrap_or(Part::Any);
            self.by_part.entry(key).or_default().push(place);
            self.all.push((parts, values));
        }
    }

    /// Value of a property of an element, from the declaration of highest precedence.
    pub(super) fn value(&self, node: Node, property: &str) -> Option<String> {
        let own = node.attribute("style").map(|style| declarations(&without_comments(style))).unwrap_or_default();
        let own = |important: bool| {
            own.iter().rev().find(|(name, _, is)| name == property && *is == important).map(|(_, text, _)| text.clone())
        };
        let of_sheets = self.strongest(node, property);
        let important = of_sheets.filter(|value| value.rank.0);
        own(true)
            .or_else(|| important.map(|value| value.text.clone()))
            .or_else(|| own(false))
            .or_else(|| of_sheets.map(|value| value.text.clone()))
            .or_else(|| node.attribute(property).map(|text| text.trim().to_owned()).filter(|text| !text.is_empty()))
    }

    fn strongest(&self, node: Node, property: &str) -> Option<&Value> {
        if self.all.is_empty() {
            return None;
        }
        let classes = node.attribute("class").unwrap_or_default().split_ascii_whitespace();
        let mut having: Vec<Part> = classes.map(|class| Part::Class(class.to_owned())).collect();
        having.extend(node.attribute("id").map(|id| Part::Id(id.to_owned())));
        having.extend([Part::Element(node.tag_name().name().to_owned()), Part::Any]);
        let rules = having.iter().filter_map(|part| self.by_part.get(part)).flatten().map(|&rule| &self.all[rule]);
        let fitting = rules.filter(|(parts, _)| parts.iter().all(|part| having.contains(part)));
        let values = fitting.flat_map(|(_, values)| values).filter(|value| value.property == property);
        values.max_by_key(|value| value.rank)
    }
}

/// Parts of a selector without combinators: the element, then classes and ids, ids last; `None` for any other selector.
fn parts(text: &str) -> Option<Vec<Part>> {
    let is_name = |name: &str| {
        !name.is_empty() && name.chars().all(|letter| letter.is_alphanumeric() || letter == '-' || letter == '_')
    };
    let mut found = Vec::new();
    let mut rest = text.replace('.', " .").replace('#', " #");
    if text.split_ascii_whitespace().count() != 1 {
        return None;
    }
    rest.truncate(rest.trim_end().len());
    for part in rest.split_ascii_whitespace() {
        let (part, name) = match part.split_at_checked(1)? {
            (".", name) => (Part::Class(name.to_owned()), name),
            ("#", name) => (Part::Id(name.to_owned()), name),
            ("*", "") => (Part::Any, "any"),
            _ => (Part::Element(part.to_owned()), part),
        };
        if !is_name(name) {
            return None;
        }
        found.push(part);
    }
    found.sort_by_key(|part| match part {
        Part::Any => 0,
        Part::Element(_) => 1,
        Part::Class(_) => 2,
        Part::Id(_) => 3,
    });
    if found.iter().filter(|part| matches!(part, Part::Id(_))).count() > 1 { None } else { Some(found) }
}

/// Properties with their values; true for important ones.
fn declarations(text: &str) -> Vec<(String, String, bool)> {
    let mut found = Vec::new();
    for declaration in text.split(';') {
        let Some((name, value)) = declaration.split_once(':') else { continue };
        let lower = value.to_lowercase();
        let mark = lower.rfind('!').filter(|&at| lower[at + 1..].trim() == "important" && lower.len() == value.len());
        let text = value[..mark.unwrap_or(value.len())].trim();
        if !text.is_empty() {
            found.push((name.trim().to_lowercase(), text.to_owned(), mark.is_some()));
        }
    }
    found
}

/// Text with a blank in place of each comment.
fn without_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        plain.push(' ');
        plain.push_str(part.split_once("*/").map_or("", |(_, behind)| behind));
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_rule_says_the_value() {
        let document = roxmltree::Document::parse("<p id='i' class='a b' fill='0' style='mask:s'/>").expect("XML");
        let check = |sheet: &str, property: &str, expected: Option<&str>| {
            let mut rules = Rules::default();
            rules.add(sheet);
            assert_eq!(rules.value(document.root_element(), property).as_deref(), expected, "{sheet}");
        };
        check("", "fill", Some("0"));
        check(".a{fill:1} p{fill:2} *{fill:3}", "fill", Some("1"));
        check("#i{fill:1} p.a.b{fill:2}", "fill", Some("1"));
        check(".a{fill:1} .b{fill:2}", "fill", Some("2"));
        check(".a,.c{fill:1} .c{fill:2} p .a{fill:3}", "fill", Some("1"));
        check("#i{mask:1}", "mask", Some("s"));
        check(".a{mask:1 !important}", "mask", Some("1"));
        check("@media print{.a{fill:1}} /*.a{fill:2}*/", "fill", Some("0"));
        check("@charset 'x'; .a{fill:1", "fill", Some("1"));
    }
}
