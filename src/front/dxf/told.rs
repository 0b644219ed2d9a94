//! Report on entities that are not drawn.

use std::collections::{BTreeMap, BTreeSet};

use super::entity::Entity;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Maximum number of kinds or layers named in a message.
const SHOWN: usize = 8;

/// Number of entities, and the location of the first.
type Count = (usize, Span);

/// Counts of the entities that are not drawn.
#[derive(Debug, Default)]
pub(super) struct Told {
    /// Entities of kinds that draw no line, or annotate lines.
    kinds: BTreeMap<String, Count>,
    /// Entities in paper space, hidden entities, and insertions of missing blocks.
    on_paper: Option<Count>,
    hidden: Option<Count>,
    /// Names of the hidden layers, as shown to the user.
    hidden_layers: BTreeSet<String>,
    unnamed: Option<Count>,
}

impl Told {
    /// Counts an entity of an unsupported kind.
    pub(super) fn kind(&mut self, entity: &Entity) {
        let kind = entity.kind().escape_ascii().to_string().to_ascii_uppercase();
        self.kinds.entry(kind).or_insert((0, entity.span())).0 += 1;
    }

    /// Counts an entity in paper space.
    pub(super) fn on_paper(&mut self, entity: &Entity) {
        self.on_paper.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Counts a hidden entity.
    pub(super) fn hidden(&mut self, entity: &Entity, layer: String) {
        self.hidden_layers.insert(layer);
        self.hidden.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Counts an insertion of a block that is missing in the file.
    pub(super) fn unnamed(&mut self, entity: &Entity) {
        self.unnamed.get_or_insert((0, entity.span())).0 += 1;
    }

    /// Reports the entities that are not drawn.
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
