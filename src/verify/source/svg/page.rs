//! Size of a page, and view boxes.

use roxmltree::{Document, Node};

use super::map::Map;
use super::numbers::{length, list};
use super::outline::Ruler;

const MM_PER_INCH: f64 = 25.4;
pub(super) const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Map from units of the file to mm, and the units of lengths; `None` for a page without a size.
pub(super) fn page(document: &Document) -> Option<(Map, Ruler)> {
    let root = document.root_element();
    let dots = dots(document);
    let mm = |pixels: f64| pixels / dots * MM_PER_INCH;
    // A page with a size in percent of a window is as large as its view box.
    let side = |name: &str| {
        let text = root.attribute(name).filter(|text| !text.trim_end().ends_with('%'))?;
        length(text, dots, 0.0).map(mm)
    };
    let view = root.attribute("viewBox").map(list).and_then(|numbers| <[f64; 4]>::try_from(numbers).ok());
    let Some([_, _, wide, high]) = view else {
        let [width, height] = [side("width").unwrap_or(0.0), side("height").unwrap_or(0.0)];
        let map = Map([[mm(1.0), 0.0, 0.0], [0.0, -mm(1.0), height]]);
        return Some((map, Ruler { dots, whole: [width / mm(1.0), height / mm(1.0)] }));
    };
    let (width, height) = match (side("width"), side("height")) {
        (Some(width), Some(height)) => (width, height),
        (Some(width), None) => (width, high * (width / wide)),
        (None, Some(height)) => (wide * (height / high), height),
        (None, None) => (mm(wide), mm(high)),
    };
    let inner = window(view?, [width, height], root.attribute("preserveAspectRatio"))?;
    let map = Map([[1.0, 0.0, 0.0], [0.0, -1.0, height]]).times(inner);
    Some((map, Ruler { dots, whole: [wide, high] }))
}

/// Pixels per inch; programs that differ from browsers are recognised by their marks.
fn dots(document: &Document) -> f64 {
    let root = document.root_element();
    if let Some(version) = root.attribute((INKSCAPE, "version")) {
        let numbers: Vec<u32> =
            version.trim().split(|c: char| !c.is_ascii_digit()).map_while(|part| part.parse().ok()).collect();
        if let [0, minor, ..] = numbers[..]
            && minor < 92
        {
            return 90.0;
        }
    }
    let mut comments = document.root().children().filter(Node::is_comment).filter_map(|node| node.text());
    let is_adobe = comments.any(|text| text.contains("Generator: Adobe Illustrator"))
        || root.namespaces().any(|namespace| namespace.uri().contains("//ns.adobe.com/"));
    if is_adobe { 72.0 } else { 96.0 }
}

/// Map from a view box to a window with its corner at the origin.
pub(super) fn window([x, y, wide, high]: [f64; 4], [width, height]: [f64; 2], rule: Option<&str>) -> Option<Map> {
    if !(wide > 0.0 && high > 0.0) {
        return None;
    }
    let words: Vec<&str> =
        rule.unwrap_or("xMidYMid").split_ascii_whitespace().filter(|word| *word != "defer").collect();
    let align = words.first().copied().unwrap_or("xMidYMid");
    if align == "none" {
        return Some(Map::scale(width / wide, height / high).times(Map::shift(-x, -y)));
    }
    let is_slice = words.get(1) == Some(&"slice");
    let ratios = [width / wide, height / high];
    let ratio = if (ratios[0] < ratios[1]) == is_slice { ratios[1] } else { ratios[0] };
    let share = |word: &str| match word {
        "Min" => 0.0,
        "Max" => 1.0,
        _ => 0.5,
    };
    let (across, down) = (share(align.get(1..4)?), share(align.get(5..8)?));
    let free = [(width - wide * ratio) * across, (height - high * ratio) * down];
    Some(Map::shift(free[0], free[1]).times(Map::scale(ratio, ratio)).times(Map::shift(-x, -y)))
}
