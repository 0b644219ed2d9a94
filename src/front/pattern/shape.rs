//! Shapes: the entities of a block become lines, points and texts in mm, each with its layer.

use std::collections::BTreeMap;

use super::layer::{Does, Layer, Named, Names, layer};
use super::text::{Facts, is_text};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::dxf::arc::{Arc, bulged, height};
use crate::front::dxf::entity::{BULGE, Block, Bulged, Entity, FLAGS, Hidden, NAME, TEXT};
use crate::geom::{Heading, Point};
use crate::ir::drawing::Vertex;
use crate::ir::marker::Label;
use crate::machine::letters::Letters;
use crate::source::{Source, Span};
use crate::units::rad;

/// Codes of coordinates, and of the data of notches, arcs, attributes and insertions.
const X: i32 = 10;
const Y: i32 = 20;
const X2: i32 = 11;
const Y2: i32 = 21;
const DEPTH: i32 = 30;
const WIDTH: i32 = 39;
const RADIUS: i32 = 40;
const SCALE_X: i32 = 41;
const SCALE_Y: i32 = 42;
const ANGLE: i32 = 50;
const END_ANGLE: i32 = 51;
/// Codes of the base point of a block.
const BASE: [i32; 2] = [X, Y];
/// Codes of the numbers of columns and rows of an insertion.
const ARRAY: [i32; 2] = [FLAGS, 71];
/// Codes of the extrusion direction, from which an entity is seen, and its value in flat drawings.
const EXTRUSION: [i32; 3] = [210, 220, 230];
const FROM_ABOVE: [f64; 3] = [0.0, 0.0, 1.0];
/// Permitted rounding of the extrusion direction.
const EXTRUSION_EPSILON: f64 = 1e-6;
/// Code of the flag of entities in paper space, the sheet around the drawing.
const ON_PAPER: i32 = 67;

/// Flags of polylines: closed, and meshes; of vertices: a control point of a spline.
const CLOSED: i64 = 1;
const MESHES: i64 = 16 | 64;
const CONTROL_POINT: i64 = 16;

/// Largest coordinate, mm: a kilometre, far beyond any table.
const FARTHEST: f64 = 1e6;
/// Sweep below which an arc is a full circle, deg: at any radius on a table so short an arc has no length.
const TURN_EPSILON_DEG: f64 = 1e-6;
/// Maximum number of chords of a file; larger numbers result from a damaged radius.
const MOST_CHORDS: usize = 4_000_000;

/// A line and its layer.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) layer: Named,
    pub(super) vertices: Vec<Vertex>,
    /// True if the last vertex leads to the first.
    pub(super) is_closed: bool,
}

impl Line {
    /// Its edges if it is part of an outline, otherwise none.
    pub(super) fn edges_of_outline(&self) -> impl Iterator<Item = [Vertex; 2]> + '_ {
        let count = self.vertices.len();
        let edges = if self.layer.does != Does::Outline || count < 2 {
            0
        } else if self.is_closed {
            count
        } else {
            count - 1
        };
        (0..edges).map(move |k| [self.vertices[k], self.vertices[(k + 1) % count]])
    }
}

/// A point, with data of a notch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dot {
    pub(super) layer: &'static Layer,
    pub(super) at: Point,
    /// Depth, mm; 0 if the file gives none. The width likewise.
    pub(super) depth: f64,
    pub(super) width: f64,
    pub(super) heading: Option<Heading>,
    pub(super) span: Span,
}

/// An insertion of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Insert<'a> {
    pub(super) name: &'a [u8],
    pub(super) at: Point,
    pub(super) scale: [f64; 2],
    pub(super) turn: f64,
    /// Facts from its attributes.
    pub(super) facts: Facts,
    pub(super) span: Span,
}

/// An insertion, or the name of its block and the reason why it cannot be placed.
pub(super) type Inserted<'a> = Result<Insert<'a>, (&'a [u8], Diagnostic)>;

/// An unsupported entity on a layer that is not cut.
#[derive(Debug, Clone)]
pub(super) struct Unread {
    /// Layer name, as in [`Names`].
    pub(super) pen: String,
    pub(super) kind: String,
    pub(super) span: Span,
}

/// The content of a block.
#[derive(Debug, Clone, Default)]
pub(super) struct Shapes<'a> {
    pub(super) lines: Vec<Line>,
    pub(super) dots: Vec<Dot>,
    pub(super) texts: Vec<Label>,
    pub(super) inserts: Vec<Inserted<'a>>,
    pub(super) unread: Vec<Unread>,
    /// True if an entity that affects cuts was unreadable.
    pub(super) is_faulty: bool,
}

impl Shapes<'_> {
    /// True if there is anything to cut, or an insertion of a block that may have cuts.
    pub(super) fn is_cut(&self) -> bool {
        let lines = self.lines.iter().any(|line| line.layer.is_cut());
        lines || self.is_faulty || !self.inserts.is_empty() || self.dots.iter().any(|dot| dot.layer.is_cut())
    }
}

/// Conversion of entities to shapes, and its findings.
#[derive(Debug)]
pub(super) struct Reader<'a, 'o> {
    pub(super) source: &'a Source,
    /// Encoding of texts.
    pub(super) letters: Letters,
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Maximum deviation of chords from their curve, mm.
    pub(super) sagitta: f64,
    /// Number of chords so far.
    pub(super) chords: usize,
    /// Number of entities in paper space, and the location of the first.
    pub(super) on_paper: Option<(usize, Span)>,
    /// Names of the layers with entities.
    pub(super) names: Names,
    /// Hidden layers, by name.
    pub(super) hidden_layers: &'a BTreeMap<&'a [u8], Hidden>,
    /// Number of hidden entities that are cut, and the location of the first.
    pub(super) hidden: Option<(usize, Span)>,
    pub(super) out: &'o mut Diagnostics,
}

impl<'a> Reader<'a, '_> {
    /// Reads the entities of a block; faulty ones are reported and omitted.
    pub(super) fn shapes(&mut self, entities: &[Entity<'a>]) -> Shapes<'a> {
        let mut shapes = Shapes::default();
        let mut rest = entities;
        while let [entity, behind @ ..] = rest {
            let is_vertex = |entity: &&Entity| entity.is("VERTEX");
            let count = if entity.is("POLYLINE") { behind.iter().take_while(is_vertex).count() } else { 0 };
            rest = &behind[count..];
            if entity.number(ON_PAPER).is_ok_and(|flag| flag == Some(1.0)) && !is_text(entity) {
                self.on_paper.get_or_insert((0, entity.span())).0 += 1;
                continue;
            }
            let is_hidden = || entity.is_invisible() || self.hidden_layers.contains_key(entity.layer_bytes());
            if layer(entity.layer()).is_cut() && is_hidden() {
                self.hidden.get_or_insert((0, entity.span())).0 += 1;
            }
            let read = if entity.is("POLYLINE") {
                if !rest.first().is_some_and(|behind| behind.is("SEQEND")) {
                    self.say(entity, open_polyline(entity));
                }
                self.polyline(entity, &behind[..count], &mut shapes)
            } else if entity.is("INSERT") {
                // A fault only matters if the inserted block is cut, which is known after all blocks are read.
                shapes.inserts.push(self.insert(entity, behind).map_err(|fault| (entity.bytes(NAME), fault)));
                Ok(())
            } else {
                self.entity(entity, &mut shapes)
            };
            if let Err(fault) = read {
                self.say(entity, fault);
            }
        }
        shapes
    }

    /// Reports a fault of an entity. If the entity does not affect cuts, the fault is only a warning.
    fn say(&mut self, entity: &Entity, fault: Diagnostic) {
        if layer(entity.layer()).shapes_cuts() {
            self.out.push(fault);
            return;
        }
        let Diagnostic { message, span, .. } = fault;
        let message = format!("{message}; left out, as layer {} is not cut", entity.layer_name(&self.letters));
        let finding = Diagnostic::new(&code::DXF_DAMAGED, message).at(span.unwrap_or(entity.span()));
        self.out.push(finding.hint("what is cut is whole; export the file again if the drawing is to be sewn"));
    }

    /// Reads a block and returns its findings separately; they only matter if the block is a piece that is cut.
    pub(super) fn block(&mut self, block: &Block<'a>) -> (Shapes<'a>, Diagnostics) {
        let mut said = Diagnostics::default();
        std::mem::swap(self.out, &mut said);
        let mut shapes = self.shapes(&block.entities);
        std::mem::swap(self.out, &mut said);
        shapes.is_faulty = said.has_errors();
        (shapes, said)
    }

    fn entity(&mut self, entity: &Entity<'a>, shapes: &mut Shapes<'a>) -> Result<(), Diagnostic> {
        let layer = self.names.layer(entity.layer(), || entity.layer_name(&self.letters));
        // Lines and points have their coordinates in world space, whatever side they are seen from (DXF reference, OCS).
        if layer.is_cut() && (entity.is("LWPOLYLINE") || entity.is("ARC") || entity.is("CIRCLE")) {
            flat(entity)?;
        }
        if entity.is("LINE") {
            let [from, to] = [self.place(entity, [X, Y])?, self.place(entity, [X2, Y2])?];
            let span = |code| entity.value(code).unwrap_or(entity.span());
            let vertices = vec![Vertex { at: from, span: span(X) }, Vertex { at: to, span: span(X2) }];
            shapes.lines.push(Line { layer, vertices, is_closed: false });
        } else if entity.is("LWPOLYLINE") {
            let places = entity.light_vertices()?;
            let on_table =
                |(at, bulge, span): Bulged| Ok((Vertex { at: self.on_table([at.x, at.y], span)?, span }, bulge));
            let vertices = places.into_iter().map(on_table).collect::<Result<Vec<_>, Diagnostic>>()?;
            shapes.lines.push(self.line(layer, &vertices, entity.flags()? & CLOSED != 0)?);
        } else if entity.is("ARC") || entity.is("CIRCLE") {
            self.arc(entity, layer, shapes)?;
        } else if entity.is("POINT") {
            let size = |code| match layer.does {
                Does::Notch(_) => self.size(entity, code),
                Does::Outline
                | Does::Fold
                | Does::Inner
                | Does::Drill
                | Does::Drawn
                | Does::Seam
                | Does::Sign
                | Does::Turn
                | Does::Curve
                | Does::Fine => Ok(0.0),
            };
            let heading = entity.number(ANGLE)?.map(|degrees| Heading::new(rad(degrees)));
            let (depth, width, span) = (size(DEPTH)?, size(WIDTH)?, entity.span());
            shapes.dots.push(Dot { layer: layer.row, at: self.place(entity, [X, Y])?, depth, width, heading, span });
        } else if is_text(entity) {
            // A text without a position is kept, too.
            let at = self.place(entity, [X, Y]).ok();
            let heading = entity.number(ANGLE).ok().flatten().map(|degrees| Heading::new(rad(degrees)));
            let text = entity.value(TEXT).filter(|span| span.start < span.end);
            shapes.texts.extend(text.map(|span| Label { at, heading, span, mirrored: None }));
        } else if !entity.is("SEQEND") {
            shapes.unread.push(self.unread(entity)?);
        }
        Ok(())
    }

    /// An insertion, with facts from the attributes after it.
    fn insert(&self, entity: &Entity<'a>, behind: &[Entity<'a>]) -> Result<Insert<'a>, Diagnostic> {
        flat(entity)?;
        alone(entity)?;
        let scale = |code| Ok::<f64, Diagnostic>(entity.number(code)?.unwrap_or(1.0));
        let attributes = behind.iter().take_while(|entity| entity.is("ATTRIB"));
        Ok(Insert {
            name: entity.bytes(NAME),
            at: self.place(entity, [X, Y])?,
            scale: [scale(SCALE_X)?, scale(SCALE_Y)?],
            turn: rad(entity.number(ANGLE)?.unwrap_or(0.0)),
            facts: Facts::of(attributes, self.source, &self.letters),
            span: entity.span(),
        })
    }

    /// Reads a polyline with its vertices.
    fn polyline(
        &mut self,
        entity: &Entity<'a>,
        vertices: &[Entity<'a>],
        shapes: &mut Shapes<'a>,
    ) -> Result<(), Diagnostic> {
        let layer = self.names.layer(entity.layer(), || entity.layer_name(&self.letters));
        let flags = entity.flags()?;
        if layer.is_cut() {
            flat(entity)?;
        }
        if flags & MESHES != 0 {
            shapes.unread.push(self.unread(entity)?);
            return Ok(());
        }
        let mut places = Vec::with_capacity(vertices.len());
        for vertex in vertices {
            if vertex.flags()? & CONTROL_POINT != 0 {
                continue;
            }
            let vertex_at = Vertex { at: self.place(vertex, [X, Y])?, span: vertex.span() };
            places.push((vertex_at, vertex.number(BULGE)?.unwrap_or(0.0)));
        }
        shapes.lines.push(self.line(layer, &places, flags & CLOSED != 0)?);
        Ok(())
    }

    /// A line through vertices; a bulge makes an arc to the next vertex.
    fn line(&mut self, layer: Named, places: &[(Vertex, f64)], is_closed: bool) -> Result<Line, Diagnostic> {
        let mut vertices: Vec<Vertex> = Vec::with_capacity(places.len());
        for (i, &(vertex, bulge)) in places.iter().enumerate() {
            vertices.push(vertex);
            let next = places.get(i + 1).or(if is_closed { places.first() } else { None });
            if let Some((next, _)) = next
                && let Some(arc) = bulged([vertex.at, next.at], bulge, self.sagitta)
            {
                if height(next.at - vertex.at, bulge) > FARTHEST {
                    return Err(too_far(vertex.span));
                }
                let count = self.chords_of(&arc, vertex.span)?;
                let inner = (1..count).map(|k| Vertex { at: arc.place(k as f64 / count as f64), span: next.span });
                vertices.extend(inner);
            }
        }
        Ok(Line { layer, vertices, is_closed })
    }

    /// Reads an arc or a circle as chords; a circle on the layer of holes becomes a hole. An arc that ends at its start point
    /// is a circle.
    fn arc(&mut self, entity: &Entity, layer: Named, shapes: &mut Shapes) -> Result<(), Diagnostic> {
        let centre = self.place(entity, [X, Y])?;
        let radius = self.unit * entity.coordinate(RADIUS)?.abs();
        let span = entity.span();
        let [start, end] =
            if entity.is("CIRCLE") { [0.0, 360.0] } else { [entity.coordinate(ANGLE)?, entity.coordinate(END_ANGLE)?] };
        let sweep = (end - start).rem_euclid(360.0);
        let is_circle = sweep <= TURN_EPSILON_DEG;
        let sweep = if is_circle { 360.0 } else { sweep };
        if is_circle && layer.does == Does::Drill {
            shapes.dots.push(Dot { layer: layer.row, at: centre, depth: 0.0, width: 0.0, heading: None, span });
            return Ok(());
        }
        if !radius.is_finite() || radius > FARTHEST {
            return Err(too_far(span));
        }
        let arc = Arc { centre, radius, start: rad(start), sweep: rad(sweep) };
        let count = self.chords_of(&arc, span)?;
        let last = if is_circle { count - 1 } else { count };
        let vertices = (0..=last).map(|k| Vertex { at: arc.place(k as f64 / count as f64), span }).collect();
        shapes.lines.push(Line { layer, vertices, is_closed: is_circle });
        Ok(())
    }

    /// Number of chords of an arc; an error beyond the maximum.
    fn chords_of(&mut self, arc: &Arc, span: Span) -> Result<usize, Diagnostic> {
        let count = arc.chords(self.sagitta);
        self.chords = self.chords.saturating_add(count);
        if self.chords > MOST_CHORDS {
            let message = format!("the curves of the file have more than {MOST_CHORDS} chords");
            return Err(Diagnostic::new(&code::DXF_CURVES, message).at(span).hint("look for a damaged radius"));
        }
        Ok(count)
    }

    /// An unsupported entity; an error if its layer is cut.
    fn unread(&mut self, entity: &Entity) -> Result<Unread, Diagnostic> {
        let layer = self.names.layer(entity.layer(), || entity.layer_name(&self.letters));
        let kind = entity.kind().escape_ascii().to_string();
        if layer.is_cut() {
            let message = format!("{kind} on layer {}, which is cut, is not read", entity.layer_name(&self.letters));
            let finding = Diagnostic::new(&code::DXF_UNREAD_CUT, message).at(entity.span());
            return Err(finding.hint("export polylines: read are polylines, lines, arcs, circles, points and texts"));
        }
        Ok(Unread { pen: self.names.of(layer).to_owned(), kind, span: entity.span() })
    }

    /// The point given by two codes, mm.
    pub(super) fn place(&self, entity: &Entity, [x, y]: [i32; 2]) -> Result<Point, Diagnostic> {
        self.on_table([entity.coordinate(x)?, entity.coordinate(y)?], entity.value(x).unwrap_or(entity.span()))
    }

    /// Base point of a block; the origin if the file gives none.
    pub(super) fn base(&self, block: &Entity) -> Result<Point, Diagnostic> {
        if BASE.iter().all(|&code| block.value(code).is_none()) {
            return Ok(Point::origin());
        }
        self.place(block, BASE)
    }

    /// Absolute value of a depth or width, mm; 0 if the file gives none.
    fn size(&self, entity: &Entity, code: i32) -> Result<f64, Diagnostic> {
        let size = self.unit * entity.number(code)?.unwrap_or(0.0).abs();
        if size > FARTHEST {
            let finding = Diagnostic::new(&code::DXF_FAR_PLACE, "a notch is larger than a kilometre");
            return Err(finding.at(entity.value(code).unwrap_or(entity.span())).hint("look for a damaged number"));
        }
        Ok(size)
    }

    fn on_table(&self, place: [f64; 2], span: Span) -> Result<Point, Diagnostic> {
        let [x, y] = place.map(|value| value * self.unit);
        if x.abs() > FARTHEST || y.abs() > FARTHEST {
            return Err(too_far(span));
        }
        Ok(Point::new(x, y))
    }
}

/// Refuses entities on another plane than the cloth: seen from above they are mirrored or slanted.
fn flat(entity: &Entity) -> Result<(), Diagnostic> {
    for (code, wanted) in EXTRUSION.into_iter().zip(FROM_ABOVE) {
        if let Some(found) = entity.number(code)?
            && (found - wanted).abs() > EXTRUSION_EPSILON
        {
            let kind = entity.kind().escape_ascii();
            let message = format!("the {kind} is not drawn from above: its group {code} is {found}");
            let finding =
                Diagnostic::new(&code::DXF_EXTRUSION, message).at(entity.value(code).unwrap_or(entity.span()));
            return Err(finding.hint("flatten the drawing in the CAD system: a mirrored copy has its back upwards"));
        }
    }
    Ok(())
}

/// Refuses an insertion with several columns or rows.
fn alone(entity: &Entity) -> Result<(), Diagnostic> {
    for code in ARRAY {
        if let Some(count) = entity.whole(code)?.filter(|count| !(0..=1).contains(count)) {
            let message = format!("an INSERT puts rows or columns of copies: its group {code} is {count}");
            let finding = Diagnostic::new(&code::DXF_ARRAY, message).at(entity.value(code).unwrap_or(entity.span()));
            return Err(finding.hint("explode the array in the CAD system: each piece needs an INSERT"));
        }
    }
    Ok(())
}

fn open_polyline(entity: &Entity) -> Diagnostic {
    let message = "the polyline that begins here has no SEQEND";
    let finding = Diagnostic::new(&code::DXF_OPEN_POLYLINE, message).at(entity.span());
    finding.hint("vertices of it may be missing: export the file again")
}

fn too_far(span: Span) -> Diagnostic {
    let finding = Diagnostic::new(&code::DXF_FAR_PLACE, "a place lies more than a kilometre from the origin").at(span);
    finding.hint("look for a doubled digit, and at the unit (`dxf.unit`)")
}
