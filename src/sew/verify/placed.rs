//! The audit of places: seams and needle points lie where the keys `sheet.*` put what the file draws, and inside the field.
//!
//! The expected places are computed here from the keys alone.

use super::events::Event;
use super::ground::{Ground, sighting};
use super::laid::half_width;
use super::rules;
use crate::geom::{Extent, Point, Rotation};
use crate::ir::verdict::WorstByRule;
use crate::machine::{Flip, MachineProfile, Mirror};
use crate::sew::pattern::{Pattern, Seam};
use crate::sew::stitches::Op;

/// Compares the seams of the pattern with those of the file, and all stitches with the field.
pub(super) fn judge(ground: &Ground, worst: &mut WorstByRule) {
    if let (Some(drawn), Some(laid)) = (ground.drawn, ground.pattern) {
        compare(drawn, laid, ground.profile, worst);
    }
    let mut all = Extent::EMPTY;
    for (step, entry) in ground.stitches.steps.iter().zip(1..).filter(|(step, _)| step.op == Op::Stitch) {
        worst.see(&rules::FIELD, ground.profile.table.off([step.to.x, step.to.y]), sighting(entry, step.to));
        all.add(step.to);
    }
    if let Some([x, y]) = ground.profile.sewing.field_mm {
        let (width, height) = all.size();
        worst.see(&rules::FIELD, f64::max(width - x, height - y), sighting(0, all.max));
    }
}

fn points(pattern: &Pattern) -> Vec<Point> {
    pattern.seams.iter().flat_map(|seam| &seam.points).copied().collect()
}

fn compare(drawn: &Pattern, laid: &Pattern, profile: &MachineProfile, worst: &mut WorstByRule) {
    let copies = profile.sheet.copies as usize;
    let room = drawn.seams.iter().map(|seam| half_width(seam, &profile.sewing)).fold(0.0, f64::max);
    let place = Place::of(&points(drawn), room, profile);
    let is_whole = laid.seams.len() == copies * drawn.seams.len();
    worst.see(&rules::PLACED, if is_whole { 0.0 } else { f64::INFINITY }, sighting(0, Point::origin()));
    for (i, found) in laid.seams.iter().enumerate() {
        let Some(seam) = drawn.seams.get(i % drawn.seams.len().max(1)) else { break };
        let told = |seam: &Seam| {
            let numbers = [seam.pitch, seam.width, seam.rpm];
            (seam.element, seam.shape, seam.ends, seam.thread, seam.order, seam.stop, seam.points.len(), numbers)
        };
        let copy = (i / drawn.seams.len()) as f64;
        let away = seam.points.iter().zip(&found.points).map(|(from, to)| (place.image(*from, copy) - to).norm());
        let away = if told(seam) == told(found) { away.fold(0.0, f64::max) } else { f64::INFINITY };
        worst.see(&rules::PLACED, away, sighting(0, found.points.first().copied().unwrap_or(Point::origin())));
    }
}

/// The events of a file of stitches as they lie in the field.
pub(super) fn events(drawn: Vec<Event>, profile: &MachineProfile) -> Vec<Event> {
    let stitches: Vec<Point> = drawn.iter().filter_map(|event| stitch(*event)).collect();
    let place = Place::of(&stitches, 0.0, profile);
    let image = |point: Point| place.image(point, 0.0);
    let start = image(Point::origin());
    let begins = drawn.first().copied().and_then(stitch).is_some() && start != Point::origin();
    let laid = drawn.into_iter().map(|event| match event {
        Event::Stitch(at) => Event::Stitch(image(at)),
        Event::Jump(at) => Event::Jump(image(at)),
        Event::Trim | Event::Stop | Event::Thread(_) => event,
    });
    // The first stitch keeps its length: the needle begins at the image of the origin.
    begins.then_some(Event::Jump(start)).into_iter().chain(laid).collect()
}

fn stitch(event: Event) -> Option<Point> {
    if let Event::Stitch(at) = event { Some(at) } else { None }
}

/// Map from places of the file to places in the field.
struct Place {
    /// Factors of X and Y after the turn.
    factors: [f64; 2],
    turn: Rotation,
    by: [f64; 2],
    /// Distance from one copy to the next, mm.
    pitch: f64,
}

impl Place {
    /// Map of some places; in the corner of the field they leave `room` mm.
    fn of(points: &[Point], room: f64, profile: &MachineProfile) -> Self {
        let sheet = &profile.sheet;
        let signs = [sheet.mirror == Mirror::Ends, sheet.flip == Flip::Sides].map(|is| if is { -1.0 } else { 1.0 });
        let factors = [signs[0] * sheet.scale_x, signs[1] * sheet.scale_y];
        let mut place = Self { factors, turn: Rotation(sheet.rotate_deg.to_radians()), by: [0.0; 2], pitch: 0.0 };
        if points.is_empty() {
            return place;
        }
        let turned: Vec<Point> = points.iter().map(|&point| place.image(point, 0.0)).collect();
        let [before, behind] = [points, &turned].map(Extent::of);
        let edges = [profile.table.x_mm, profile.table.y_mm].map(|ends| room + ends.map_or(0.0, |ends| ends[0]));
        let corner = sheet.origin.map_or(edges, |[x, y]| [before.min.x + x, before.min.y + y]);
        place.by = [corner[0] - behind.min.x, corner[1] - behind.min.y];
        place.pitch = behind.max.x - behind.min.x + sheet.copies_gap_mm;
        place
    }

    /// Place of a point in a copy, counted from 0.
    fn image(&self, point: Point, copy: f64) -> Point {
        let along = self.turn.unit();
        let x = point.x * along.x - point.y * along.y;
        let y = point.x * along.y + point.y * along.x;
        Point::new(self.factors[0] * x + self.by[0] + copy * self.pitch, self.factors[1] * y + self.by[1])
    }
}
