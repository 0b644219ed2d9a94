//! Audit of the layout: the drawing lies on the table as the profile or registration marks ask, every piece in every copy, to
//! the last point, and nothing else. The expected places are computed here from the keys of the profile or the file of the
//! marks alone.

use std::collections::BTreeMap;

use crate::geom::{Extent, Heading, Point, Rotation};
use crate::ir::list::Segment;
use crate::ir::marker::{Contour, Drill, Event, Label, Notch, OutlineNotch, Piece};
use crate::ir::toolpath;
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::machine::{Flip, Job, MachineProfile, Mirror};
use crate::verify::rules;
use crate::verify::source::cloth::Cloth;
use crate::verify::source::marks::ByMarks;

/// Rounding of places on a table that is a kilometre long, mm.
const PLACE_EPSILON: f64 = 1e-6;
/// Rounding of directions, rad, and relative rounding of the unit.
const SAME_EPSILON: f64 = 1e-9;

/// A marker as the file draws it.
#[derive(Debug, Clone)]
pub struct Drawn(Marker);

/// A piece by its number, the byte at which it starts and its copy.
type Name = (u32, u32, u32);

impl Drawn {
    /// A marker before any sheet has moved it.
    pub fn of(marker: &Marker) -> Self {
        Self(marker.clone())
    }

    /// Greatest distance of anything in a marker from its place by the sheet of the profile; infinite where something is
    /// missing, superfluous or different. Whole pieces that are not selected may be missing.
    pub fn laid(&self, marker: &Marker, job: &Job) -> Finding {
        let cloth = Cloth::of(job);
        // Wander of the cloth is followed within the tolerance.
        let limit = if cloth.is_some() { job.profile.tolerance(marker.unit) } else { PLACE_EPSILON };
        let mut worst = Worst::new(&rules::SOURCE_LAID, Some(limit));
        let Self(drawn) = self;
        let marks = ByMarks::of(job);
        if marks.is_some_and(|marks| marks.off > job.profile.map.max_mm) {
            worst.see(f64::INFINITY, || Sighting::at(0.0, Point::origin(), 0));
        }
        let table = marks.map_or_else(|| Lay::of(drawn, &job.profile), Lay::by);
        let table = Lay { cloth: cloth.as_ref(), ..table };
        let mut laid: BTreeMap<Name, Vec<&Piece>> = BTreeMap::new();
        let wholes = marker.wholes();
        for piece in wholes.iter().rev() {
            laid.entry((piece.number, piece.span.start, piece.copy)).or_default().push(piece);
        }
        let copies = job.profile.sheet.copies;
        for copy in 1..=copies {
            let table = table.of_copy(copy);
            let number = if copies > 1 { copy } else { 0 };
            for piece in &drawn.pieces {
                let found = laid.get_mut(&(piece.number, piece.span.start, number)).and_then(Vec::pop);
                let Some(found) = found else {
                    // Pieces before the one that a run begins with, and those of other windows, are missing as well.
                    let is_due = job.selection.has(piece.number) && !job.selection.begins_amid();
                    worst.see(if is_due { f64::INFINITY } else { 0.0 }, || of(piece, &table));
                    continue;
                };
                table.compare((drawn, piece), (marker, found), &mut worst);
            }
        }
        for extra in laid.into_values().flatten() {
            worst.see(f64::INFINITY, || Sighting::at(0.0, Point::origin(), extra.span.block));
        }
        let unit = drawn.unit * table.growth;
        // On a conveyor the windows of the profile replace those of the file.
        let has_bites = has_bites(&job.profile);
        let is_asked = |event: &Event| match event.kind {
            toolpath::Event::Stop => true,
            toolpath::Event::Advance | toolpath::Event::AdvanceBy(_) => !has_bites,
        };
        let told = |marker: &Marker, times: u32| -> Vec<Event> {
            let events = marker.pieces.iter().flat_map(|piece| &piece.events).copied().filter(is_asked);
            std::iter::repeat_n(events.collect::<Vec<_>>(), times as usize).flatten().collect()
        };
        let is_told = !job.selection.is_all() || told(drawn, copies) == told(marker, 1);
        let closing = |marker: &Marker| marker.closing.iter().copied().filter(is_asked).collect::<Vec<_>>();
        if !is_told || closing(drawn) != closing(marker) || (marker.unit - unit).abs() > SAME_EPSILON * unit {
            worst.see(f64::INFINITY, || Sighting::at(0.0, Point::origin(), 0));
        }
        worst.finding()
    }
}

/// True if a conveyor advances the cloth.
fn has_bites(profile: &MachineProfile) -> bool {
    profile.bite.length_mm.is_some()
}

/// Start, along one axis of the table, of a layout of length `long` in its corner, mm: away from the edge by a blade and its
/// front overlap, or by half of the room that is left if that is less.
fn in_corner(profile: &MachineProfile, table: Option<[f64; 2]>, long: f64) -> f64 {
    let Some([edge, end]) = table else { return 0.0 };
    let knife = &profile.knife;
    let blade = knife.width_mm + f64::max(knife.front_overlap_mm, knife.corner_front_overlap_mm);
    let left_over = end - edge - long;
    if left_over <= 0.0 { edge } else { edge + f64::min(blade, left_over / 2.0) }
}

/// Expected place of a piece.
fn of(piece: &Piece, table: &Lay) -> Sighting {
    let labels = piece.labels.iter().filter_map(|label| label.at);
    let place = piece.drills.iter().map(|drill| drill.at).chain(piece.notches.iter().map(|notch| notch.root));
    Sighting::at(0.0, table.place(place.chain(labels).next().unwrap_or(Point::origin())), piece.span.block)
}

/// Map from places of the file to places on the table.
#[derive(Debug, Clone, Copy)]
struct Lay<'a> {
    /// Images of a step of 1 mm along X and of one along Y.
    axes: [[f64; 2]; 2],
    /// Growth of the unit of the file.
    growth: f64,
    /// Distance from one copy to the next, mm.
    pitch: f64,
    by: [f64; 2],
    /// The cloth that carries it across.
    cloth: Option<&'a Cloth>,
}

impl Lay<'_> {
    fn of(drawn: &Marker, profile: &MachineProfile) -> Self {
        let sheet = &profile.sheet;
        // Factors of X and Y after the turn.
        let mut factors = [sheet.scale_x, sheet.scale_y];
        if sheet.mirror == Mirror::Ends {
            factors[0] *= -1.0;
        }
        if sheet.flip == Flip::Sides {
            factors[1] *= -1.0;
        }
        let along = Rotation(sheet.rotate_deg.to_radians()).unit();
        let axes = [[along.x, along.y], [-along.y, along.x]].map(|[x, y]| [factors[0] * x, factors[1] * y]);
        let growth = f64::max(sheet.scale_x, sheet.scale_y);
        let mut lay = Self { axes, growth, pitch: 0.0, by: [0.0; 2], cloth: None };
        let (mut before, mut behind) = (Extent::EMPTY, Extent::EMPTY);
        let mut see = |place: Point| {
            before.add(place);
            behind.add(lay.place(place));
        };
        for piece in &drawn.pieces {
            piece.contours.iter().for_each(|contour| drawn.points(contour).into_iter().for_each(&mut see));
            let strokes = piece.notches.iter().flat_map(Notch::strokes);
            strokes.flat_map(|stroke| [stroke.from, stroke.to]).for_each(&mut see);
            piece.drills.iter().map(|drill| drill.at).for_each(&mut see);
        }
        if before.is_empty() {
            return lay;
        }
        lay.pitch = behind.max.x - behind.min.x + sheet.copies_gap_mm;
        let far_end = behind.max.x + f64::from(sheet.copies - 1) * lay.pitch;
        let corner = match sheet.origin {
            Some([x, y]) => [before.min.x + x, before.min.y + y],
            None => [
                // A conveyor brings everything beyond its first window onto the table later.
                in_corner(profile, profile.table.x_mm, if has_bites(profile) { 0.0 } else { far_end - behind.min.x }),
                in_corner(profile, profile.table.y_mm, behind.max.y - behind.min.y),
            ],
        };
        lay.by = [corner[0] - behind.min.x, corner[1] - behind.min.y];
        lay
    }

    fn by(ByMarks { axes, by, .. }: ByMarks) -> Self {
        let growth = axes.map(|[x, y]| x.hypot(y)).into_iter().fold(0.0, f64::max);
        Self { axes, growth, pitch: 0.0, by, cloth: None }
    }

    /// Map of a copy, counted from 1.
    fn of_copy(self, copy: u32) -> Self {
        let [x, y] = self.by;
        Self { by: [x + f64::from(copy - 1) * self.pitch, y], ..self }
    }

    fn place(&self, at: Point) -> Point {
        let laid = self.on_table(at);
        self.cloth.map_or(laid, |cloth| cloth.carried(laid))
    }

    /// Place by the sheet alone.
    fn on_table(&self, at: Point) -> Point {
        let [x, y] = self.turned(at.x, at.y);
        Point::new(x + self.by[0], y + self.by[1])
    }

    fn turned(&self, x: f64, y: f64) -> [f64; 2] {
        [0, 1].map(|k| self.axes[0][k] * x + self.axes[1][k] * y)
    }

    fn away(&self, drawn: Point, laid: Point) -> f64 {
        (self.place(drawn) - laid).norm()
    }

    /// Compares a piece as drawn with one that lies on the table.
    fn compare(&self, drawn: (&Marker, &Piece), laid: (&Marker, &Piece), worst: &mut Worst) {
        let (one, other) = (drawn.1, laid.1);
        let counts = |piece: &Piece| {
            [
                piece.contours.len(),
                piece.notches.len(),
                piece.drills.len(),
                piece.labels.len(),
                piece.outline_notches.len(),
            ]
        };
        if counts(one) != counts(other) || one.feed != other.feed || one.fields != other.fields {
            worst.see(f64::INFINITY, || of(one, self));
            return;
        }
        let (before, behind) = (contours(drawn), contours(laid));
        let start = |contour: &Vec<Segment>| contour.iter().map(|segment| segment.span.start).min().unwrap_or(0);
        for (drawn, laid) in pairs([&before, &behind], start, |drawn, laid| self.contour(drawn, laid).0) {
            let (away, place) = self.contour(drawn, laid);
            worst.see(away, || place);
        }
        let away = |drawn: &Notch, laid: &Notch| self.notch(drawn, laid);
        for (drawn, laid) in pairs([&one.notches, &other.notches], |notch| notch.span.start, away) {
            worst.see(self.notch(drawn, laid), || Sighting::at(0.0, laid.tip, laid.span.block));
        }
        let away = |drawn: &Drill, laid: &Drill| self.away(drawn.at, laid.at);
        for (drawn, laid) in pairs([&one.drills, &other.drills], |drill| drill.span.start, away) {
            let Drill { at: place, tool, span } = *laid;
            let is_same = (drawn.tool, drawn.span) == (tool, span);
            worst.see(if is_same { self.away(drawn.at, place) } else { f64::INFINITY }, || {
                Sighting::at(0.0, place, span.block)
            });
        }
        for (drawn, laid) in one.labels.iter().zip(&other.labels) {
            worst.see(self.label(drawn, laid), || {
                Sighting::at(0.0, laid.at.unwrap_or(Point::origin()), laid.span.block)
            });
        }
        let away = |drawn: &OutlineNotch, laid: &OutlineNotch| self.outline_notch(drawn, laid);
        for (drawn, laid) in pairs([&one.outline_notches, &other.outline_notches], |notch| notch.span.start, away) {
            worst.see(self.outline_notch(drawn, laid), || Sighting::at(0.0, laid.tip, laid.span.block));
        }
    }

    /// Distance of a notch from its expected place, mm; infinite for a different notch.
    fn notch(&self, drawn: &Notch, laid: &Notch) -> f64 {
        let strokes = |notch: &Notch| notch.strokes().collect::<Vec<_>>();
        let (strokes, found) = (strokes(drawn), strokes(laid));
        if strokes.len() != found.len() || (drawn.percent, drawn.span) != (laid.percent, laid.span) {
            return f64::INFINITY;
        }
        let ways = strokes.iter().zip(&found);
        ways.map(|(a, b)| self.away(a.from, b.from).max(self.away(a.to, b.to))).fold(0.0, f64::max)
    }

    /// Distance of an outline notch from its expected place, mm; infinite for a different notch.
    fn outline_notch(&self, drawn: &OutlineNotch, laid: &OutlineNotch) -> f64 {
        // Lines of a notch may be split where the cloth wanders.
        let parted = if self.cloth.is_some() { laid.segments.saturating_sub(drawn.segments) } else { 0 };
        let told = |n: &OutlineNotch| (n.form, n.outwards, n.span);
        if told(drawn) != told(laid) || drawn.segments + parted != laid.segments {
            return f64::INFINITY;
        }
        let [from, to] = laid.mouth;
        let mouths = [[from, to], [to, from]].into_iter();
        let away = mouths.map(|mouth| self.away(drawn.mouth[0], mouth[0]).max(self.away(drawn.mouth[1], mouth[1])));
        away.fold(f64::INFINITY, f64::min).max(self.away(drawn.tip, laid.tip))
    }

    /// Greatest distance of a contour from its expected place, mm, with the place: a closed one may begin elsewhere, and any
    /// may be cut the other way.
    fn contour(&self, drawn: &[Segment], laid: &[Segment]) -> (f64, Sighting) {
        let turned = laid.iter().rev().map(|&segment| Segment { from: segment.to, to: segment.from, ..segment });
        let turned: Vec<Segment> = turned.collect();
        let nearer = [laid, &turned].map(|laid| self.farthest(drawn, laid)).into_iter();
        nearer.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are two")
    }

    /// Greatest distance of the segments of a contour from their expected places, mm, with the place.
    fn farthest(&self, drawn: &[Segment], laid: &[Segment]) -> (f64, Sighting) {
        let first = &drawn[0];
        let begin = (0..laid.len()).filter(|&i| laid[i].span == first.span);
        let away = |i: &usize| self.away(first.from, laid[*i].from);
        let begin = begin.min_by(|a, b| away(a).total_cmp(&away(b)));
        let Some(begin) = begin.filter(|_| drawn.len() == laid.len() || self.cloth.is_some()) else {
            return (f64::INFINITY, Sighting::at(0.0, self.place(first.from), first.span.block));
        };
        if let Some(cloth) = self.cloth {
            return self.farthest_parted(cloth, drawn, laid.iter().cycle().skip(begin).take(laid.len()));
        }
        let all = drawn.iter().zip(laid.iter().cycle().skip(begin)).map(|(drawn, laid)| {
            let told = |segment: &Segment| (segment.span, segment.percent, segment.joint);
            let away = self.away(drawn.from, laid.from).max(self.away(drawn.to, laid.to));
            let away = if told(drawn) == told(laid) { away } else { f64::INFINITY };
            (away, Sighting::at(0.0, laid.to, laid.span.block))
        });
        all.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a contour has a segment")
    }

    /// Greatest distance of a contour whose lines may be split where the cloth wanders, mm, with the place.
    fn farthest_parted<'s>(
        &self,
        cloth: &Cloth,
        drawn: &[Segment],
        mut laid: impl Iterator<Item = &'s Segment>,
    ) -> (f64, Sighting) {
        let mut worst = (0.0, Sighting::at(0.0, self.place(drawn[0].from), drawn[0].span.block));
        for line in drawn {
            let on_table = Segment { from: self.on_table(line.from), to: self.on_table(line.to), ..*line };
            let away = cloth.parted(&on_table, &mut laid);
            if away > worst.0 {
                worst = (away, Sighting::at(0.0, self.place(line.to), line.span.block));
            }
        }
        if laid.next().is_some() { (f64::INFINITY, worst.1) } else { worst }
    }

    /// Distance of a text from its place, mm; infinite where it differs or points in another direction.
    fn label(&self, drawn: &Label, laid: &Label) -> f64 {
        let [[a, b], [c, d]] = self.axes;
        let is_mirrored = a * d - b * c < 0.0;
        let texts = match drawn.mirrored {
            Some(mirrored) if is_mirrored => (mirrored, Some(drawn.span)),
            other => (drawn.span, other),
        };
        let along = drawn.heading.map_or(0.0, Heading::radians);
        // A text without place and direction is nowhere.
        let is_loose = drawn.at.is_none() && drawn.heading.is_none();
        let [x, y] = if is_loose { [1.0, 0.0] } else { self.turned(along.cos(), along.sin()) };
        let askew = laid.heading.unwrap_or(Heading::new(0.0)).turn_to(Heading::new(y.atan2(x))).abs();
        if texts != (laid.span, laid.mirrored) || askew > SAME_EPSILON {
            return f64::INFINITY;
        }
        match (drawn.at, laid.at) {
            (Some(drawn), Some(laid)) => self.away(drawn, laid),
            (None, None) => 0.0,
            (Some(_), None) | (None, Some(_)) => f64::INFINITY,
        }
    }
}

/// The segments of each contour of a piece.
fn contours((marker, piece): (&Marker, &Piece)) -> Vec<Vec<Segment>> {
    let segments = |contour: &Contour| marker.list.walk(contour.range).map(|(_, segment)| segment).collect::<Vec<_>>();
    piece.contours.iter().map(segments).collect()
}

/// Pairs drawn things with laid ones, which may come in another order: by their first byte, and by distance among those from
/// one byte, such as the two halves of a folded piece.
fn pairs<T>([drawn, laid]: [&[T]; 2], start: impl Fn(&T) -> u32, away: impl Fn(&T, &T) -> f64) -> Vec<(&T, &T)> {
    let mut left: Vec<&T> = laid.iter().collect();
    left.sort_by_key(|thing| start(thing));
    let mut sorted: Vec<&T> = drawn.iter().collect();
    sorted.sort_by_key(|thing| start(thing));
    let mut found = Vec::with_capacity(sorted.len());
    for thing in sorted {
        let first = left.partition_point(|other| start(other) < start(thing));
        let alike = left[first..].iter().take_while(|other| start(other) == start(thing)).count();
        let nearest = if alike > 1 {
            let away = (first..first + alike).map(|k| (away(thing, left[k]), k));
            away.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(first, |(_, k)| k)
        } else {
            first.min(left.len() - 1)
        };
        found.push((thing, left.remove(nearest)));
    }
    found
}
