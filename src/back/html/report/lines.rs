//! Table of the lines of a drawing: what they are taken for, and what is not cut.

use super::table;
use crate::back::html::about::About;
use crate::ir::drawing::LineClass;
use crate::picture::Markup;
use crate::units::MM_PER_M;
use crate::units::number::{counted, fixed};

/// Lines of the drawing that are not cut, in words; `None` for a file that states itself what is cut, and when all is cut.
pub(super) fn uncut(about: &About) -> Option<String> {
    let uncut = || classes(about).iter().filter(|class| !class.cut);
    let count: usize = uncut().map(|class| class.count).sum();
    let length: f64 = uncut().map(|class| class.length).sum();
    (count > 0).then(|| format!("{} ({} m) not cut", counted(count, "line"), fixed(length / MM_PER_M, 2)))
}

/// The table with one row per class; nothing for files that state themselves what is cut.
pub(super) fn section(about: &About, out: &mut Markup) {
    let classes = classes(about);
    if classes.is_empty() {
        return;
    }
    out.open("section", &[("id", "lines")]).element("h2", &[], "Lines of the drawing");
    table::open(out, "bars", &["Taken for", "Cut", "#Lines", "#Length", "Told by"]);
    for LineClass { name, about, cut, count, length } in classes {
        out.open("tr", &[]).element("td", &[], name).element("td", &[], if *cut { "cut" } else { "not cut" });
        table::number(out, &count.to_string(), *count as f64);
        table::number(out, &format!("{} m", fixed(length / MM_PER_M, 3)), *length);
        out.open("td", &[]).prose(about).close("td").close("tr");
    }
    table::close(out);
    let words = "On the cloth, lines that are not cut are grey; \"lines not cut\" (L) shows them.";
    out.element("p", &[("class", "hint")], words).close("section");
}

fn classes<'a>(about: &About<'a>) -> &'a [LineClass] {
    about.context.marker.drawing.as_ref().map_or(&[], |drawing| &drawing.classes)
}
