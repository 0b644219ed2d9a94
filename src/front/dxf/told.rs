//! What is said of entities that are not read, not in the drawing, or not shown.

use std::collections::{BTreeMap, BTreeSet};

use super::shape::Unread;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// What kinds of entities are not read, and on which layers.
pub(super) fn say_unread(unread: &[Unread], out: &mut Diagnostics) {
    let mut kinds: BTreeMap<&str, (Vec<&Unread>, BTreeSet<&str>)> = BTreeMap::new();
    for entity in unread {
        let (of_kind, layers) = kinds.entry(&entity.kind).or_default();
        of_kind.push(entity);
        layers.insert(&entity.pen);
    }
    for (kind, (of_kind, layers)) in kinds {
        let word = if layers.len() == 1 { "layer" } else { "layers" };
        let layers = format!("{word} {}", layers.into_iter().collect::<Vec<_>>().join(", "));
        let (count, are) = (of_kind.len(), if of_kind.len() == 1 { "is" } else { "are" });
        let message = format!("{count} of the kind {kind} {are} not read, on {layers}");
        let finding = Diagnostic::new(&code::DXF_UNREAD, message).at(of_kind[0].span);
        out.push(finding.hint("nothing there is cut"));
    }
}

/// How much stands on the sheet around the drawing.
pub(super) fn say_on_paper(on_paper: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = on_paper {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let finding = Diagnostic::new(&code::DXF_ON_PAPER, format!("{message} in paper space and not cut")).at(span);
        out.push(finding.hint("what is cut must be drawn in model space"));
    }
}

/// How much is cut that nobody sees in the drawing.
pub(super) fn say_hidden(hidden: Option<(usize, Span)>, out: &mut Diagnostics) {
    if let Some((count, span)) = hidden {
        let message = if count == 1 { "1 entity is".to_owned() } else { format!("{count} entities are") };
        let message = format!("{message} hidden in the drawing, on layers that are cut; they are cut all the same");
        out.push(
            Diagnostic::new(&code::DXF_HIDDEN, message).at(span).hint("show all layers in the CAD system and look"),
        );
    }
}

/// A text that says what must be known, and is not read.
pub(super) fn say_text(unread: Option<Span>, out: &mut Diagnostics) {
    if let Some(span) = unread {
        let message = "a text that may say a size, a quantity or the unit is long, or has codes amid it";
        out.push(Diagnostic::new(&code::DXF_TEXT, message).at(span).hint("write it as a TEXT of its own"));
    }
}
