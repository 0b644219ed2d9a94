//! Lowering: the entities of a plain drawing become strokes on named layers.
//!
//! Lines, ellipses and splines have their coordinates in world space, whatever side they are seen from. Polylines, arcs,
//! circles and insertions have them on their own plane (DXF reference, "Object Coordinate Systems (OCS)"). That plane must be
//! the cloth or its back; any other is refused.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::arc::{bulged, height};
use super::conic::Conic;
use super::entity::{BULGE, Block, Bulged, Entity, Hidden, NAME, Sections, TEXT, X, Y, number_at, place, sections};
use super::fit;
use super::group::groups;
use super::insert::{Placing, base};
use super::nurbs::Nurbs;
use super::page::page;
use super::stray;
use super::told::Told;
use super::unit::unit;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::affine::Affine;
use crate::geom::{Heading, Point, Vector};
use crate::ir::Drawing;
use crate::ir::label::Label;
use crate::machine::Job;
use crate::machine::letters::Letters;
use crate::machine::patterns::Dxf;
use crate::source::{Source, Span};
use crate::units::rad;

/// Codes of second points, of radius and angles, and of the data of splines.
const X2: i32 = 11;
const Y2: i32 = 21;
const RADIUS: i32 = 40;
const ANGLE: i32 = 50;
const END_ANGLE: i32 = 51;
const RATIO: i32 = 40;
const START: i32 = 41;
const END: i32 = 42;
const KNOT: i32 = 40;
const WEIGHT: i32 = 41;
const DEGREE: i32 = 71;
const TANGENTS: [i32; 4] = [12, 22, 13, 23];
/// Codes of the extrusion direction, from which an entity is seen.
const EXTRUSION: [i32; 3] = [210, 220, 230];
/// Permitted rounding of the extrusion direction.
const EXTRUSION_EPSILON: f64 = 1e-6;
/// Code of the flag of entities in paper space, the sheet around the drawing.
const ON_PAPER: i32 = 67;

/// Flags of polylines and splines: closed, coordinates in space, and meshes; of vertices: a control point.
const CLOSED: i64 = 1;
const IN_SPACE: i64 = 8;
const MESHES: i64 = 16 | 64;
const CONTROL_POINT: i64 = 16;

/// Kinds without lines of their own: they end other entities, define texts of later insertions, or follow a polyline.
const SILENT: [&str; 3] = ["SEQEND", "ATTDEF", "VERTEX"];
/// Largest coordinate, mm: a kilometre, far beyond any table.
const FARTHEST: f64 = 1e6;
/// Sweep below which an arc is a full circle, deg.
const TURN_EPSILON_DEG: f64 = 1e-6;
/// Deviation of an arc from a full turn, either way, below which it is a circle, deg. Angles in rad are written with four
/// decimals.
const WHOLE_EPSILON_DEG: f64 = 0.012;
/// Maximum number of points of a drawing. Larger numbers result from damaged values or from deeply nested blocks.
const MOST_PLACES: usize = 4_000_000;

/// Maximum nesting depth of insertions. CAD systems nest a few; a block that contains itself would never end.
const DEEPEST: usize = 32;
/// Maximum number of followed insertions, counting each row and column.
const MOST_INSERTS: usize = 100_000;
/// Maximum number of processed entities, counting those of a block each time it is drawn.
const MOST_ENTITIES: usize = 8_000_000;

/// Lowers a file as far as it can be read. The drawing is meaningless if there is an error among the diagnostics.
pub(super) fn lower(source: &Source, job: &Job, out: &mut Diagnostics) -> Drawing {
    let groups = groups(source, out);
    let sections = sections(source, &groups, out);
    stray::say(&sections, out);
    let extent = || Lowering::of(source, &sections, job, &mut Diagnostics::default()).drawn(1.0).extent();
    let unit = unit(&job.profile.dxf, sections.unit, source, extent, out);
    let drawing = Lowering::of(source, &sections, job, out).drawn(unit.mm);
    unit.doubt(&drawing.extent(), out);
    drawing
}

/// Placement and layer of the entities being drawn.
#[derive(Debug, Clone, Copy)]
struct Within<'a> {
    map: Affine,
    /// Layer of the insertion, which entities on layer 0 of a block inherit.
    layer: Option<&'a [u8]>,
    /// Number of enclosing insertions.
    depth: usize,
}

/// Name of the layer whose entities inherit the layer of the insertion.
const LAYER_OF_INSERT: &[u8] = b"0";

/// State of the lowering.
struct Lowering<'a, 'o> {
    source: &'a Source,
    entities: &'a [Entity<'a>],
    blocks: BTreeMap<Vec<u8>, &'a Block<'a>>,
    hidden: &'a BTreeMap<&'a [u8], Hidden>,
    letters: Letters,
    /// Maximum deviation of chords from their curve, mm.
    sagitta: f64,
    drawing: Drawing,
    told: Told,
    out: &'o mut Diagnostics,
    /// True once the drawing exceeds a size limit; reading then stops.
    is_full: bool,
    /// Insertions that may still be followed.
    inserts_left: usize,
    /// Entities that may still be processed, each counted as often as it is drawn.
    entities_left: usize,
    /// Pens of the layers used so far, by their names as written.
    pens: BTreeMap<&'a [u8], u16>,
}

impl<'a, 'o> Lowering<'a, 'o> {
    fn of(source: &'a Source, sections: &'a Sections<'a>, job: &Job, out: &'o mut Diagnostics) -> Self {
        let mut blocks = BTreeMap::new();
        for block in &sections.blocks {
            blocks.entry(block.head.bytes(NAME).to_ascii_uppercase()).or_insert(block);
        }
        let of_header = || sections.page.and_then(|span| page(source.slice(span)));
        Self {
            source,
            entities: &sections.entities,
            blocks,
            hidden: &sections.hidden,
            letters: job.profile.labels.set().or_else(of_header).unwrap_or(Letters::utf_8()).with_codes(),
            sagitta: job.profile.tolerance(0.0) * Dxf::CHORDS_OFF,
            drawing: Drawing::default(),
            told: Told::default(),
            out,
            is_full: false,
            inserts_left: MOST_INSERTS,
            entities_left: MOST_ENTITIES,
            pens: BTreeMap::new(),
        }
    }

    /// The drawing of the file; `unit` is the length of its unit, mm.
    fn drawn(mut self, unit: f64) -> Drawing {
        let within = Within { map: Affine::scale(unit, unit), layer: None, depth: 0 };
        self.entities(self.entities, &within);
        self.told.say(self.out);
        self.drawing
    }

    /// Draws entities; faulty ones are reported.
    fn entities(&mut self, entities: &'a [Entity<'a>], within: &Within<'a>) {
        let mut rest = entities;
        while let [entity, behind @ ..] = rest {
            let is_vertex = |entity: &&Entity| entity.is("VERTEX");
            let count = if entity.is("POLYLINE") { behind.iter().take_while(is_vertex).count() } else { 0 };
            rest = &behind[count..];
            if self.is_full {
                return;
            }
            let Some(left) = self.entities_left.checked_sub(1) else {
                let fault = self.full(entity.span());
                self.out.push(fault);
                return;
            };
            self.entities_left = left;
            if entity.number(ON_PAPER).is_ok_and(|flag| flag == Some(1.0)) {
                self.told.on_paper(entity);
                continue;
            }
            if entity.is_invisible() || self.is_hidden(entity, within) {
                if !is_text(entity) {
                    let name = self.letters.name(layer_of(entity, within));
                    self.told.hidden(entity, name);
                }
                continue;
            }
            if entity.is("POLYLINE") && !rest.first().is_some_and(|behind| behind.is("SEQEND")) {
                let finding = Diagnostic::new(&code::DXF_OPEN_POLYLINE, "the polyline that begins here has no SEQEND");
                let finding = finding.at(entity.span());
                self.out.push(finding.hint("vertices of it may be missing: export the file again"));
            }
            let drawn = if entity.is("POLYLINE") {
                self.polyline(entity, &behind[..count], within)
            } else if entity.is("INSERT") {
                self.insert(entity, within)
            } else {
                self.entity(entity, within)
            };
            if let Err(fault) = drawn {
                self.out.push(fault);
            }
        }
    }

    /// True if the layer of an entity hides it. An insertion on a layer that is off still shows the other layers of its block.
    fn is_hidden(&self, entity: &Entity<'a>, within: &Within<'a>) -> bool {
        match self.hidden.get(layer_of(entity, within)) {
            Some(Hidden::Off) => !entity.is("INSERT"),
            Some(Hidden::Frozen) => true,
            None => false,
        }
    }

    /// Draws the block of an insertion once per column and row.
    fn insert(&mut self, entity: &Entity<'a>, within: &Within<'a>) -> Result<(), Diagnostic> {
        let name = entity.bytes(NAME).to_ascii_uppercase();
        let Some(&block) = self.blocks.get(&name) else {
            self.told.unnamed(entity);
            return Ok(());
        };
        if within.depth == DEEPEST {
            self.is_full = true;
            let shown = name.escape_ascii();
            let message = format!("the block `{shown}` is inserted {DEEPEST} blocks deep: it may hold itself");
            let finding = Diagnostic::new(&code::DXF_RECURSION, message).at(entity.span());
            return Err(finding.hint("explode its insertions in the CAD system"));
        }
        let placing = Placing::of(entity)?;
        let plane = on_plane(entity, within)?;
        let base = base(block)?;
        let layer = Some(layer_of(entity, within));
        for row in 0..placing.counts[1] {
            for column in 0..placing.counts[0] {
                let Some(left) = self.inserts_left.checked_sub(1) else {
                    return Err(self.full(entity.span()));
                };
                self.inserts_left = left;
                let map = placing.map(base, [column as f64, row as f64]).then(&plane);
                self.entities(&block.entities, &Within { map, layer, depth: within.depth + 1 });
                if self.is_full {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    fn entity(&mut self, entity: &Entity<'a>, within: &Within<'a>) -> Result<(), Diagnostic> {
        if entity.is("LINE") {
            let span = |code| entity.value(code).unwrap_or(entity.span());
            let [from, to] = [place(entity, [X, Y])?, place(entity, [X2, Y2])?].map(|at| within.map.point(at));
            self.draw(entity, within, &[(from, span(X)), (to, span(X2))])
        } else if entity.is("LWPOLYLINE") {
            let vertices = entity.light_vertices()?;
            let map = on_plane(entity, within)?;
            let is_closed = entity.flags()? & CLOSED != 0;
            self.chain(entity, &Within { map, ..*within }, &vertices, is_closed)
        } else if entity.is("ARC") || entity.is("CIRCLE") {
            let conic = round(entity)?.mapped(&on_plane(entity, within)?);
            self.conic(entity, within, &conic)
        } else if entity.is("ELLIPSE") {
            let conic = ellipse(entity)?.mapped(&within.map);
            self.conic(entity, within, &conic)
        } else if entity.is("SPLINE") {
            self.spline(entity, within)
        } else if is_text(entity) {
            self.text(entity, within);
            Ok(())
        } else {
            if !SILENT.iter().any(|kind| entity.is(kind)) {
                self.told.kind(entity);
            }
            Ok(())
        }
    }

    /// Records a text. A text without a position is kept, too.
    fn text(&mut self, entity: &Entity<'a>, within: &Within<'a>) {
        let at = place(entity, [X, Y]).ok().map(|at| within.map.point(at));
        let turn = entity.number(ANGLE).ok().flatten().map(|degrees| Affine::turn(rad(degrees)).vector(Vector::x()));
        let heading = turn.map(|way| Heading::of(within.map.vector(way)));
        let text = entity.value(TEXT).filter(|span| span.start < span.end);
        self.drawing.texts.extend(text.map(|span| Label { at, heading, span, mirrored: None }));
    }

    /// Draws a polyline from its vertices.
    fn polyline(
        &mut self,
        entity: &Entity<'a>,
        vertices: &[Entity<'a>],
        within: &Within<'a>,
    ) -> Result<(), Diagnostic> {
        let flags = entity.flags()?;
        if flags & MESHES != 0 {
            self.told.kind(entity);
            return Ok(());
        }
        let map = if flags & IN_SPACE == 0 { on_plane(entity, within)? } else { within.map };
        let mut places = Vec::with_capacity(vertices.len());
        for vertex in vertices {
            if vertex.flags()? & CONTROL_POINT == 0 {
                places.push((place(vertex, [X, Y])?, vertex.number(BULGE)?.unwrap_or(0.0), vertex.span()));
            }
        }
        self.chain(entity, &Within { map, ..*within }, &places, flags & CLOSED != 0)
    }

    /// Draws the segments between vertices; a bulge makes an arc to the next vertex.
    fn chain(
        &mut self,
        entity: &Entity<'a>,
        within: &Within<'a>,
        vertices: &[Bulged],
        is_closed: bool,
    ) -> Result<(), Diagnostic> {
        let own_sagitta = self.sagitta / within.map.stretch().max(f64::MIN_POSITIVE);
        let mut places: Vec<(Point, Span)> = Vec::with_capacity(vertices.len() + 1);
        for (i, &(at, bulge, span)) in vertices.iter().enumerate() {
            places.push((within.map.point(at), span));
            let next = vertices.get(i + 1).or(if is_closed { vertices.first() } else { None });
            let Some(&(end, _, behind)) = next else { continue };
            let Some(arc) = bulged([at, end], bulge, own_sagitta) else { continue };
            if within.map.stretch() * height(end - at, bulge) > FARTHEST {
                return Err(too_far(span));
            }
            let [across, up] = [Vector::new(arc.radius, 0.0), Vector::new(0.0, arc.radius)];
            let conic = Conic { centre: arc.centre, across, up, start: arc.start, sweep: arc.sweep };
            let conic = conic.mapped(&within.map);
            let count = self.room(conic.chords(self.sagitta), span)?;
            places.extend((1..count).map(|k| (conic.place(k as f64 / count as f64), behind)));
        }
        if let Some(&first) = places.first().filter(|_| is_closed) {
            places.push(first);
        }
        self.draw(entity, within, &places)
    }

    fn conic(&mut self, entity: &Entity<'a>, within: &Within<'a>, conic: &Conic) -> Result<(), Diagnostic> {
        let span = entity.span();
        if conic.reach() > FARTHEST || !conic.reach().is_finite() {
            return Err(too_far(span));
        }
        let count = self.room(conic.chords(self.sagitta), span)?;
        let mut places: Vec<(Point, Span)> =
            (0..=count).map(|k| (conic.place(k as f64 / count as f64), span)).collect();
        if conic.is_closed() {
            places[count] = places[0];
        }
        self.draw(entity, within, &places)
    }

    /// Draws a spline along its control points or, if it has none, through its fit points.
    fn spline(&mut self, entity: &Entity<'a>, within: &Within<'a>) -> Result<(), Diagnostic> {
        let is_closed = entity.flags()? & CLOSED != 0;
        let [control, fitted] = [[X, Y], [X2, Y2]].map(|codes| self.points(entity, codes));
        let (control, fitted) = (control?, fitted?);
        let refuse = |flaw: &str| {
            let message = format!("the SPLINE has {flaw}");
            Diagnostic::new(&code::DXF_SPLINE, message).at(entity.span()).hint("export it as a polyline, or again")
        };
        if control.is_empty() && TANGENTS.iter().any(|&code| entity.value(code).is_some()) {
            return Err(refuse("end tangents and no control points"));
        }
        let spline = if control.is_empty() {
            fit::through(&fitted, is_closed).ok_or_else(|| refuse("fewer than two points"))?
        } else {
            let degree = entity.whole(DEGREE)?.and_then(|degree| usize::try_from(degree).ok()).unwrap_or(0);
            let (knots, weights) = (self.numbers(entity, KNOT)?, self.numbers(entity, WEIGHT)?);
            Nurbs::of(degree, knots, &control, &weights).map_err(refuse)?
        };
        let most = MOST_PLACES - self.drawing.vertices.len().min(MOST_PLACES);
        let Some(points) = spline.mapped(&within.map).flatten(self.sagitta, most) else {
            return Err(self.full(entity.span()));
        };
        let mut places: Vec<(Point, Span)> = points.into_iter().map(|at| (at, entity.span())).collect();
        let last = places.len() - 1;
        if (places[last].0 - places[0].0).norm() <= self.sagitta && is_closed {
            places[last] = places[0];
        }
        self.draw(entity, within, &places)
    }

    /// The points given by two codes, in units of the file.
    fn points(&self, entity: &Entity, [x_code, y_code]: [i32; 2]) -> Result<Vec<Point>, Diagnostic> {
        let (xs, ys) = (self.numbers(entity, x_code)?, self.numbers(entity, y_code)?);
        if xs.len() != ys.len() {
            let message = format!("the SPLINE has {} groups {x_code}, and {} groups {y_code}", xs.len(), ys.len());
            let finding = Diagnostic::new(&code::DXF_NO_COORDINATE, message).at(entity.span());
            return Err(finding.hint("its groups were lost on the way: export the file again"));
        }
        Ok(xs.into_iter().zip(ys).map(|(x, y)| Point::new(x, y)).collect())
    }

    /// All numbers with a code.
    fn numbers(&self, entity: &Entity, code: i32) -> Result<Vec<f64>, Diagnostic> {
        let groups = entity.groups().iter().filter(|group| group.code == code);
        groups.map(|group| number_at(self.source, group.value)).collect()
    }

    /// Checks that `count` more points fit into the drawing.
    fn room(&mut self, count: usize, span: Span) -> Result<usize, Diagnostic> {
        if self.drawing.vertices.len().saturating_add(count) > MOST_PLACES {
            return Err(self.full(span));
        }
        Ok(count)
    }

    /// Marks the drawing as full, which stops reading, and returns the error for it.
    fn full(&mut self, span: Span) -> Diagnostic {
        self.is_full = true;
        let message = "the file draws more places, or has more insertions, than any drawing needs";
        let finding = Diagnostic::new(&code::DXF_TOO_LARGE, message).at(span);
        finding.hint("look for a damaged radius or count, and for blocks that insert each other many times")
    }

    /// Draws a stroke; coordinates in mm.
    fn draw(&mut self, entity: &Entity<'a>, within: &Within<'a>, places: &[(Point, Span)]) -> Result<(), Diagnostic> {
        let is_far = |at: &Point| !(at.x.abs() <= FARTHEST && at.y.abs() <= FARTHEST);
        if let Some(&(_, span)) = places.iter().find(|(at, _)| is_far(at)) {
            return Err(too_far(span));
        }
        self.room(places.len(), entity.span())?;
        let layer = layer_of(entity, within);
        let (letters, drawing) = (&self.letters, &mut self.drawing);
        let pen = *self.pens.entry(layer).or_insert_with(|| drawing.layer(&letters.name(layer)));
        let Some((&(first, span), behind)) = places.split_first() else { return Ok(()) };
        self.drawing.begin(first, span, pen);
        for &(at, span) in behind {
            self.drawing.line(at, span);
        }
        self.drawing.lift();
        Ok(())
    }
}

/// The layer of an entity.
fn layer_of<'a>(entity: &Entity<'a>, within: &Within<'a>) -> &'a [u8] {
    let own = entity.layer_bytes();
    within.layer.filter(|_| own == LAYER_OF_INSERT || own.is_empty()).unwrap_or(own)
}

fn is_text(entity: &Entity) -> bool {
    ["TEXT", "MTEXT", "ATTRIB"].iter().any(|kind| entity.is(kind))
}

/// A circle or an arc, in units of the file. An arc that ends at its start point is a circle.
fn round(entity: &Entity) -> Result<Conic, Diagnostic> {
    let (centre, radius) = (place(entity, [X, Y])?, entity.coordinate(RADIUS)?.abs());
    let [start, end] =
        if entity.is("CIRCLE") { [0.0, 360.0] } else { [entity.coordinate(ANGLE)?, entity.coordinate(END_ANGLE)?] };
    let sweep = sweep(rad(start), rad(end));
    Ok(Conic { centre, across: Vector::new(radius, 0.0), up: Vector::new(0.0, radius), start: rad(start), sweep })
}

/// Sweep from one angle to another, rad; a full turn if the angles are equal or about a turn apart.
fn sweep(start: f64, end: f64) -> f64 {
    let (apart, sweep) = ((end - start).abs(), (end - start).rem_euclid(TAU));
    let is_one = sweep.min(TAU - sweep) <= rad(TURN_EPSILON_DEG);
    if is_one || (apart - TAU).abs() <= rad(WHOLE_EPSILON_DEG) { TAU } else { sweep }
}

/// An ellipse or an arc of one, in units of the file. The second axis is the first, turned left as seen from the side of the
/// ellipse, times a ratio.
fn ellipse(entity: &Entity) -> Result<Conic, Diagnostic> {
    let (centre, major) = (place(entity, [X, Y])?, place(entity, [X2, Y2])?.coords);
    let ratio = entity.coordinate(RATIO)?.abs();
    let minor = crate::geom::left(major) * if is_from_below(entity)? { -ratio } else { ratio };
    let start = entity.number(START)?.unwrap_or(0.0);
    let sweep = sweep(start, entity.number(END)?.unwrap_or(TAU));
    Ok(Conic { centre, across: major, up: minor, start, sweep })
}

/// Map of an entity with coordinates on its own plane. Seen from the back, X points left.
fn on_plane(entity: &Entity, within: &Within) -> Result<Affine, Diagnostic> {
    Ok(if is_from_below(entity)? { Affine::scale(-1.0, 1.0).then(&within.map) } else { within.map })
}

/// True if an entity is seen from the back of the cloth. An error if its plane is not that of the cloth.
fn is_from_below(entity: &Entity) -> Result<bool, Diagnostic> {
    let mut normal = [0.0, 0.0, 1.0];
    for (value, code) in normal.iter_mut().zip(EXTRUSION) {
        *value = entity.number(code)?.unwrap_or(*value);
    }
    let is = |wanted: f64| {
        let off = normal.iter().zip([0.0, 0.0, wanted]).map(|(value, wanted)| (value - wanted).abs());
        off.fold(0.0, f64::max) <= EXTRUSION_EPSILON
    };
    if is(1.0) || is(-1.0) {
        return Ok(is(-1.0));
    }
    let kind = entity.kind().escape_ascii();
    let [x, y, z] = normal;
    let message = format!("the {kind} is drawn on another plane than the cloth: seen from {x}, {y}, {z}");
    let finding = Diagnostic::new(&code::DXF_EXTRUSION, message).at(entity.span());
    Err(finding.hint("flatten the drawing in the CAD system"))
}

fn too_far(span: Span) -> Diagnostic {
    let finding = Diagnostic::new(&code::DXF_FAR_PLACE, "a place lies more than a kilometre from the origin").at(span);
    finding.hint("look for a doubled digit, and at the unit (`dxf.unit`)")
}
