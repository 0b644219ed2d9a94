//! Lines of a plot that are drawn but not cut: thin grey lines below the pieces, with the class of each as its title.

use std::collections::BTreeMap;

use super::markup::PathData;
use crate::back::target::Context;
use crate::ir::drawing::{Account, LineClass};

/// Style class of such lines.
pub(super) const ASIDE: &str = "aside";

/// Classes of lines that are not cut.
pub(super) fn classes<'a>(context: &'a Context) -> impl Iterator<Item = &'a LineClass> {
    context.marker.drawing.iter().flat_map(|account| &account.classes).filter(|class| !class.cut)
}

/// The layer; empty when everything is cut.
pub(super) fn layer(context: &Context) -> String {
    let Some(Account { aside, classes, .. }) = &context.marker.drawing else { return String::new() };
    let mut paths: BTreeMap<&str, PathData> = BTreeMap::new();
    for (class, vertices) in aside.each() {
        // The way back of a mark lies on the mark itself.
        let Some(class) = class else { continue };
        paths.entry(class).or_default().line(vertices.iter().map(|vertex| vertex.at));
    }
    if paths.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "<g id=\"drawn\" inkscape:groupmode=\"layer\" inkscape:label=\"drawn, not cut\" transform=\"scale(1,-1)\">\n",
    );
    for class in classes {
        if let Some(path) = paths.remove(class.name) {
            text.push_str(&path.titled(ASIDE, &format!("{}: {}; not cut", class.name, class.about)));
        }
    }
    text + "</g>\n"
}
