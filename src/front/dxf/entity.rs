//! Entities: groups are sorted into the sections and blocks of the file.

use std::collections::BTreeMap;

use super::group::Group;
use super::syntax::{number, whole};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::letters::Letters;
use crate::source::{Source, Span};

/// Codes of the group that begins an entity, of its text, its name and its layer.
const BEGINS: i32 = 0;
pub(in crate::front) const TEXT: i32 = 1;
pub(in crate::front) const NAME: i32 = 2;
const LAYER: i32 = 8;
/// Code of the flags of polylines and vertices; for an insertion, of the number of columns.
pub(in crate::front) const FLAGS: i32 = 70;

/// Codes of the first point of an entity.
pub(super) const X: i32 = 10;
pub(super) const Y: i32 = 20;

/// Codes that an entity of one point has once at most: its layer, its points, and a bulge or a scale.
const SINGLE: [i32; 6] = [LAYER, X, Y, 11, 21, BULGE];

/// Codes of the bulge of the arc to the next vertex, and of the vertex count of a light polyline.
pub(in crate::front) const BULGE: i32 = 42;
const COUNT: i32 = 90;

/// Code of the name of a header variable, and the names of the variables for the unit and the code page.
const VARIABLE: i32 = 9;
const UNIT: &[u8] = b"$INSUNITS";
const PAGE: &[u8] = b"$DWGCODEPAGE";
/// Code of the colour of a layer, negative if the layer is off, and the flag of a frozen layer.
const COLOUR: i32 = 62;
const FROZEN: i64 = 1;
/// Code of visibility; 1 = invisible.
const INVISIBLE: i32 = 60;

/// An entity: the group that begins it and all groups up to the next entity.
#[derive(Debug, Clone, Copy)]
pub(in crate::front) struct Entity<'a> {
    groups: &'a [Group],
    source: &'a Source,
}

/// A block. In a pattern file: a piece of the pattern set in one size.
#[derive(Debug, Clone)]
pub(in crate::front) struct Block<'a> {
    /// The entity that begins the block, with its name and base point.
    pub(in crate::front) head: Entity<'a>,
    pub(in crate::front) entities: Vec<Entity<'a>>,
}

/// A vertex, the bulge of the arc to the next vertex, and its span.
pub(in crate::front) type Bulged = (Point, f64, Span);

/// State of a hidden layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::front) enum Hidden {
    /// Blocks inserted on it show their entities on other layers.
    Off,
    /// Blocks inserted on it are hidden completely.
    Frozen,
}

/// The sections of a file that are read.
#[derive(Debug, Clone, Default)]
pub(in crate::front) struct Sections<'a> {
    /// Unit number in the header.
    pub(in crate::front) unit: Option<Span>,
    /// Name of the code page in the header.
    pub(in crate::front) page: Option<Span>,
    /// Hidden layers, by name.
    pub(in crate::front) hidden: BTreeMap<&'a [u8], Hidden>,
    pub(in crate::front) blocks: Vec<Block<'a>>,
    /// Entities outside all blocks.
    pub(in crate::front) entities: Vec<Entity<'a>>,
}

impl<'a> Entity<'a> {
    /// The word that begins the entity, as written.
    pub(in crate::front) fn kind(&self) -> &'a [u8] {
        self.source.slice(self.groups[0].value)
    }

    pub(in crate::front) fn is(&self, kind: &str) -> bool {
        self.kind().eq_ignore_ascii_case(kind.as_bytes())
    }

    /// Location of the word that begins the entity.
    pub(in crate::front) fn span(&self) -> Span {
        self.groups[0].value
    }

    /// The groups after the first.
    pub(in crate::front) fn groups(&self) -> &'a [Group] {
        &self.groups[1..]
    }

    /// The first value with a code.
    pub(in crate::front) fn value(&self, code: i32) -> Option<Span> {
        self.groups().iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// The bytes of the first value with a code; empty if there is none.
    pub(in crate::front) fn bytes(&self, code: i32) -> &'a [u8] {
        self.value(code).map_or(b"", |span| self.source.slice(span))
    }

    /// Layer number; `None` if the layer name is not a number.
    pub(in crate::front) fn layer(&self) -> Option<u16> {
        let name = self.bytes(LAYER);
        let is_number = !name.is_empty() && name.iter().all(u8::is_ascii_digit);
        std::str::from_utf8(name).ok().filter(|_| is_number).and_then(|name| name.parse().ok())
    }

    /// Layer name, as written.
    pub(in crate::front) fn layer_bytes(&self) -> &'a [u8] {
        self.bytes(LAYER)
    }

    /// Layer name, decoded for display.
    pub(in crate::front) fn layer_name(&self, letters: &Letters) -> String {
        letters.name(self.bytes(LAYER))
    }

    /// The number with a code; `None` if there is none. An error if it is malformed.
    pub(in crate::front) fn number(&self, code: i32) -> Result<Option<f64>, Diagnostic> {
        self.value(code).map(|span| number_at(self.source, span)).transpose()
    }

    /// The number with a code that is mandatory.
    pub(in crate::front) fn coordinate(&self, code: i32) -> Result<f64, Diagnostic> {
        self.number(code)?.ok_or_else(|| {
            let message =
                format!("the {} has no group {code}, which is a coordinate of it", self.kind().escape_ascii());
            let finding = Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(self.span());
            finding.hint("its groups were lost on the way: export the file again")
        })
    }

    /// The whole number with a code, used for flags and counts; `None` if there is none. An error if it is malformed.
    pub(in crate::front) fn whole(&self, code: i32) -> Result<Option<i64>, Diagnostic> {
        let read = |span: Span| {
            let bytes = self.source.slice(span);
            whole(bytes).ok_or_else(|| no_number("a whole number", bytes, span))
        };
        self.value(code).map(read).transpose()
    }

    /// The flag bits; 0 if the flags are missing.
    pub(in crate::front) fn flags(&self) -> Result<i64, Diagnostic> {
        Ok(self.whole(FLAGS)?.unwrap_or(0))
    }
}

/// Kinds with at most one point of codes 10 and 20, one of codes 11 and 21, and one bulge or scale; and kinds without any.
const OF_ONE_POINT: [&str; 9] = ["VERTEX", "LINE", "POINT", "CIRCLE", "ARC", "TEXT", "INSERT", "POLYLINE", "BLOCK"];
const OF_NO_POINT: [&str; 2] = ["SEQEND", "ENDBLK"];

impl Entity<'_> {
    /// The finding on an entity with more layers or coordinates than one of its kind has: the group that begins the next entity is
    /// lost, or the code of a group is changed.
    fn merged(&self) -> Option<Diagnostic> {
        let most = if OF_ONE_POINT.iter().any(|kind| self.is(kind)) {
            1
        } else if OF_NO_POINT.iter().any(|kind| self.is(kind)) {
            0
        } else {
            return None;
        };
        let mut counts = [0; SINGLE.len()];
        let surplus = self.groups().iter().find(|group| {
            let place = SINGLE.iter().position(|code| *code == group.code);
            place.is_some_and(|place| {
                counts[place] += 1;
                counts[place] > if group.code == LAYER { 1 } else { most }
            })
        })?;
        let (kind, code) = (self.kind().escape_ascii(), surplus.code);
        let message = match most {
            0 if code != LAYER => format!("the {kind} has a group {code}, and no coordinates belong to it"),
            _ => format!("the {kind} has group {code} twice"),
        };
        let finding = Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(surplus.value);
        Some(finding.hint("a group was lost or changed on the way: export or transfer the file again"))
    }
}

/// The point given by two codes, in units of the file.
pub(super) fn place(entity: &Entity, [x, y]: [i32; 2]) -> Result<Point, Diagnostic> {
    Ok(Point::new(entity.coordinate(x)?, entity.coordinate(y)?))
}

/// The number at a span.
pub(in crate::front) fn number_at(source: &Source, span: Span) -> Result<f64, Diagnostic> {
    let bytes = source.slice(span);
    number(bytes).ok_or_else(|| no_number("a decimal number", bytes, span))
}

fn no_number(wanted: &str, bytes: &[u8], span: Span) -> Diagnostic {
    let shown = bytes[..bytes.len().min(SHOWN)].escape_ascii();
    let finding = Diagnostic::new(&code::DXF_NUMBER, format!("`{shown}` is not {wanted}")).at(span);
    finding.hint(if bytes.contains(&b',') {
        "numbers in DXF have decimal points; set the export to the English notation"
    } else {
        "export the file again"
    })
}

/// Number of bytes of a wrong number that are shown.
const SHOWN: usize = 20;

/// Splits groups into entities.
fn entities<'a>(source: &'a Source, groups: &'a [Group]) -> impl Iterator<Item = Entity<'a>> {
    let first = groups.iter().position(|group| group.code == BEGINS).unwrap_or(groups.len());
    let chunks = groups[first..].chunk_by(|_, next| next.code != BEGINS);
    chunks.map(move |groups| Entity { groups, source })
}

/// The current section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Within {
    Blocks,
    Entities,
    Tables,
    /// The header and all other sections.
    Others,
}

impl Entity<'_> {
    /// The value of a header variable. The entity is the one that begins the header.
    fn variable(&self, name: &[u8]) -> Option<Span> {
        let variable = self
            .groups()
            .iter()
            .position(|group| group.code == VARIABLE && self.source.slice(group.value).eq_ignore_ascii_case(name))?;
        self.groups().get(variable + 1).map(|group| group.value)
    }

    /// The state of the layer if this entry of the layer table hides it.
    fn hidden_layer(&self) -> Option<Hidden> {
        let is_off = self.whole(COLOUR).is_ok_and(|colour| colour.is_some_and(|colour| colour < 0));
        let is_frozen = self.flags().is_ok_and(|flags| flags & FROZEN != 0);
        let state = if is_frozen { Some(Hidden::Frozen) } else { is_off.then_some(Hidden::Off) };
        state.filter(|_| self.is("LAYER"))
    }

    /// The vertices of a light polyline, which are consecutive groups of one entity.
    pub(in crate::front) fn light_vertices(&self) -> Result<Vec<Bulged>, Diagnostic> {
        let mut vertices: Vec<Bulged> = Vec::new();
        let (mut x, mut is_bulged) = (None, false);
        let lost = |span: Span| {
            let message = "a vertex of the LWPOLYLINE has not both of its coordinates (groups 10 and 20)";
            Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(span).hint("export the file again")
        };
        for group in self.groups() {
            let number = || number_at(self.source, group.value);
            match (group.code, x) {
                (X, None) => x = Some((number()?, group.value)),
                (Y, Some((first, span))) => {
                    vertices.push((Point::new(first, number()?), 0.0, span));
                    (x, is_bulged) = (None, false);
                }
                (BULGE, None) if is_bulged => {
                    let message = "a vertex of the LWPOLYLINE has two bulges (group 42)";
                    let finding = Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(group.value);
                    return Err(finding.hint("export the file again"));
                }
                (X, Some(_)) | (Y, None) => return Err(lost(group.value)),
                (BULGE, None) => {
                    let bulge = number()?;
                    is_bulged = true;
                    vertices.last_mut().into_iter().for_each(|vertex| vertex.1 = bulge);
                }
                _ => {}
            }
        }
        let told = self.number(COUNT)?;
        match x {
            Some((_, span)) => Err(lost(span)),
            None if told.is_some_and(|count| count != vertices.len() as f64) => {
                let message = format!("the LWPOLYLINE has {} vertices, and its count another", vertices.len());
                Err(Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(self.span()).hint("export the file again"))
            }
            None => Ok(vertices),
        }
    }

    /// True if the entity itself is invisible, on whatever layer.
    pub(in crate::front) fn is_invisible(&self) -> bool {
        self.whole(INVISIBLE).is_ok_and(|flag| flag == Some(1))
    }
}

/// Sorts the entities of a file into its sections and blocks.
pub(in crate::front) fn sections<'a>(source: &'a Source, groups: &'a [Group], out: &mut Diagnostics) -> Sections<'a> {
    let mut sections = Sections::default();
    let mut within = Within::Others;
    let mut open: Option<Block> = None;
    for entity in entities(source, groups) {
        entity.merged().into_iter().for_each(|finding| out.push(finding));
        let is_end = ["ENDBLK", "BLOCK", "ENDSEC", "SECTION", "EOF"].iter().any(|kind| entity.is(kind));
        if is_end && let Some(block) = open.take() {
            if !entity.is("ENDBLK") {
                let message =
                    format!("the block that begins here has no ENDBLK before {}", entity.kind().escape_ascii());
                let finding = Diagnostic::new(&code::DXF_OPEN_BLOCK, message).at(block.head.span());
                out.push(finding.hint("something is missing in the file: export it again"));
            }
            sections.blocks.push(block);
        }
        if entity.is("SECTION") {
            within = match entity.bytes(NAME).to_ascii_uppercase().as_slice() {
                b"BLOCKS" => Within::Blocks,
                b"ENTITIES" => Within::Entities,
                b"TABLES" => Within::Tables,
                b"HEADER" => {
                    sections.unit = sections.unit.or(entity.variable(UNIT));
                    sections.page = sections.page.or(entity.variable(PAGE));
                    Within::Others
                }
                _ => Within::Others,
            };
        } else if entity.is("ENDSEC") {
            within = Within::Others;
        } else if entity.is("BLOCK") {
            // Some writers end the section of blocks too early, so blocks are accepted anywhere.
            open = Some(Block { head: entity, entities: Vec::new() });
        } else if !is_end {
            match (&mut open, within) {
                (Some(block), _) => block.entities.push(entity),
                (None, Within::Entities) => sections.entities.push(entity),
                (None, Within::Tables) => {
                    sections.hidden.extend(entity.hidden_layer().map(|state| (entity.bytes(NAME), state)));
                }
                (None, Within::Blocks | Within::Others) => {}
            }
        }
    }
    sections
}
