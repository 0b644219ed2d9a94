//! Groups that an entity of their kind does not have: most likely a digit of their code was lost or doubled, and the group that
//! is meant, such as the scale of an insertion or the depth of a notch, has its usual value.

use std::collections::BTreeMap;

use super::entity::{Entity, Sections};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Codes of any entity: handles, line type, layer, subclasses, colour, visibility, space, extrusion and the like (DXF reference,
/// "Common Group Codes for Entities").
#[rustfmt::skip] // a table
const COMMON: [i32; 28] = [
    5, 6, 8, 38, 39, 48, 60, 62, 67, 92, 100, 102, 160, 210, 220, 230, 284, 310, 330, 347, 348, 360, 370, 380, 390, 410, 420, 440,
];
/// Codes of the handle of an entity, and of that of its owner.
const HANDLE: i32 = 5;
const OWNER: i32 = 330;
/// Further codes of colours, and the first one of extended data.
const COLOUR_NAME: i32 = 430;
const EXTENDED: i32 = 999;
/// Kinds whose groups are looked at, each with its own codes.
const KINDS: [(&str, &[i32]); 2] =
    [("INSERT", &[2, 10, 20, 30, 41, 42, 43, 44, 45, 50, 66, 70, 71]), ("POINT", &[10, 20, 30, 50])];

/// Groups with codes that their entities do not have.
#[derive(Debug, Default)]
struct Strays {
    /// Number of entities of each kind.
    entities: [usize; KINDS.len()],
    /// Number and first place of each code, by kind.
    found: BTreeMap<(usize, i32), (usize, Span)>,
}

/// Warns of groups that insertions and points of a file do not have.
pub(in crate::front) fn say(sections: &Sections, out: &mut Diagnostics) {
    let mut strays = Strays::default();
    let of_blocks = sections.blocks.iter().flat_map(|block| &block.entities);
    for entity in sections.entities.iter().chain(of_blocks) {
        strays.see(entity);
    }
    strays.report(out);
}

impl Strays {
    /// Looks at the groups of an entity.
    fn see(&mut self, entity: &Entity) {
        let Some(kind) = KINDS.iter().position(|(name, _)| entity.is(name)) else { return };
        self.entities[kind] += 1;
        for group in entity.groups() {
            let is_common = COMMON.contains(&group.code) || group.code == COLOUR_NAME || group.code >= EXTENDED;
            // An entity with an owner has a handle of its own.
            let is_orphan = group.code == OWNER && entity.value(HANDLE).is_none();
            if group.code < 0 || !is_orphan && (is_common || KINDS[kind].1.contains(&group.code)) {
                continue;
            }
            self.found.entry((kind, group.code)).or_insert((0, group.value)).0 += 1;
        }
    }

    /// Warns of codes that stand in some entities of a kind only. A program may write a code of its own in all.
    fn report(&self, out: &mut Diagnostics) {
        for (&(kind, code), &(count, span)) in &self.found {
            if count > 1 && count >= self.entities[kind] {
                continue;
            }
            let name = KINDS[kind].0;
            let times = if count == 1 { String::new() } else { format!("; so have {} others", count - 1) };
            let message = format!("the {name} has a group {code}, which no {name} has{times}");
            let finding = Diagnostic::new(&code::DXF_STRAY_GROUP, message).at(span);
            out.push(
                finding.hint("a digit of its code may be lost or doubled: compare size and place of the piece here"),
            );
        }
    }
}
