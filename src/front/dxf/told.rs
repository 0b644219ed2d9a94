//! Entities that are not drawn: what is said of them.

use std::collections::{BTreeMap, BTreeSet};

use super::entity::Entity;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Kinds that a message names.
const SHOWN: usize = 8;

/// Count of entities, and where the first begins.
type Count = (usize, Span);

/// Entities of a drawing that are not drawn, counted.
#[derive(Debug, Default)]
pub(super) struct Told {
    /// Those of kinds that draw no line, or are drawn about lines.
    kinds: BTreeMap<String, Count>,
    /// Those in paper space, those that are not shown, and insertions of blocks that are not there.
    on_paper: Option<Count>,
    hidden: Option<Count>,
    /// Names of the layers that are not shown, as they are written.
    hidden_layers: BTreeSet<String>,
    unnamed: Option<Count>,
}

impl Told {
    /// Counts an entity of a kind that is not read.
    pub(super) fn kind(&mut self, entity: &Entity) {
        let kind = entity.kind().escape_ascii().to_string().to_ascii_uppercase();
        self.kinds.entry(kind).or_insert((0, entity.span())).0 += 1;
    }

    /// Counts an entity that stands on the sheet around the drawing.
    pub(super) fn on_paper(&mut self, entity: &Entity) {
        self.on_paper.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Counts an entity that is not shown.
    pub(super) fn hidden(&mut self, entity: &Entity, layer: String) {
        self.hidden_layers.insert(layer);
        self.hidden.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Counts an insertion of a block that the file does not have.
    pub(super) fn unnamed(&mut self, entity: &Entity) {
        self.unnamed.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Says what is not drawn.
    pub(super) fn say(&self, out: &mut Diagnostics) {
        let are = |count: usize, one: &str, many: &str| {
            if count == 1 { format!("1 {one} is") } else { format!("{count} {many} are") }
        };
        if let Some(&(_, first)) = self.kinds.values().min_by_key(|(_, span)| span.start) {
            let all: usize = self.kinds.values().map(|(count, _)| count).sum();
            let each = self.kinds.iter().take(SHOWN).map(|(kind, (count, _))| format!("{count} {kind}"));
            let dots = if self.kinds.len() > SHOWN { ", ..." } else { "" };
            let each = each.collect::<Vec<_>>().join(", ");
            let are = are(all, "entity", "entities");
            let message = format!("{are} of kinds that are no lines and not cut: {each}{dots}");
            let finding = Diagnostic::new(&code::DXF_NO_LINES, message).at(first);
            out.push(finding.hint("explode them into lines in the CAD system if any of them is to be cut"));
        }
        if let Some((count, span)) = self.on_paper {
            let message = format!("{} in paper space and not cut", are(count, "entity", "entities"));
            let finding = Diagnostic::new(&code::DXF_ON_PAPER, message).at(span);
            out.push(finding.hint("what is cut must be drawn in model space"));
        }
        if let Some((count, span)) = self.hidden {
            let names: Vec<&str> = self.hidden_layers.iter().take(SHOWN).map(String::as_str).collect();
            let (are, names) = (are(count, "entity", "entities"), names.join("`, `"));
            let message = format!("{are} hidden, on `{names}`, and not cut");
            let finding = Diagnostic::new(&code::DXF_NOT_SHOWN, message).at(span);
            out.push(finding.hint("show the layer in the CAD system if they are to be cut"));
        }
        if let Some((count, span)) = self.unnamed {
            let message = match count {
                1 => "an INSERT names a block that the file does not have".to_owned(),
                count => format!("{count} INSERTs name blocks that the file does not have, the first here"),
            };
            let finding = Diagnostic::new(&code::DXF_NO_BLOCK, message).at(span);
            out.push(finding.hint("what it would draw is missing: bind external references and export the file again"));
        }
    }
}
