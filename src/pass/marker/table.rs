//! Table: checks that the cuts are on the table of the profile. Changes nothing.
//!
//! Needs: the pieces of this run. Only lines count here, which the tip follows to their ends: a line off the table now stays
//! off. Overlaps and the swing of the blade are judged in the program.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point};
use crate::ir::marker::{Marker, Notch};
use crate::machine::{Job, Knife, Table};
use crate::source::Span;
use crate::units::number::{exact, fixed, up};

pub(super) const PASS: MarkerPass = MarkerPass { name: "table", about: "finds what lies off the table", run };

/// Rounding of the computation, mm.
const OFF_EPSILON: f64 = 1e-6;
/// Decimals of distances, and of distances without room for rounding.
const DECIMALS: u32 = 1;
const FINE_DECIMALS: u32 = 3;
/// Last digits of both, mm.
const STEP: f64 = 0.1;
const FINE_STEP: f64 = 0.001;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let table = &job.profile.table;
    if table.x_mm.is_none() && table.y_mm.is_none() {
        return;
    }
    let extent = marker.extent_on_table();
    let off = table.off(extent.min.into()).max(table.off(extent.max.into()));
    if extent.is_empty() || off <= OFF_EPSILON {
        return;
    }
    let Some((place, span)) = farthest(marker, table) else { return };
    let mut axes = [
        Axis { name: "X", lies: [extent.min.x, extent.max.x], table: table.x_mm, knife: &job.profile.knife },
        Axis { name: "Y", lies: [extent.min.y, extent.max.y], table: table.y_mm, knife: &job.profile.knife },
    ];
    let ways: Vec<String> = axes.iter().filter_map(Axis::over).collect();
    if job.profile.bite.length_mm.is_some() {
        // A conveyor brings the rest of the marker: the place of its first window decides.
        axes[0].lies[1] = axes[0].lies[0];
    }
    let (code, what) = if off > Table::EDGE_MM {
        (&code::MARKER_OFF_TABLE, "the marker leaves the table")
    } else {
        (&code::MARKER_OVER_EDGE, "the marker reaches over the edge of the table")
    };
    let finding = Diagnostic::new(code, format!("{what}: {}", ways.join(", ")));
    let finding = finding.at(span).on_cloth(place).by(off);
    let moves = axes.map(|axis| axis.advice());
    let hints = if moves.iter().flatten().all(|advice| matches!(advice, Advice::Move { .. })) {
        vec![moved(&moves, job)]
    } else {
        let alone = |(advice, name): (&Option<Advice>, &str)| Some(advice.as_ref()?.alone(name));
        moves.iter().zip(["X", "Y"]).filter_map(alone).chain(fitting(marker, &marker.extent(), job)).collect()
    };
    diagnostics.push(hints.into_iter().fold(finding, Diagnostic::hint));
}

/// Hint for moving a marker that fits, with the key that does it.
fn moved(moves: &[Option<Advice>; 2], job: &Job) -> String {
    let words: Vec<String> =
        moves.iter().zip(["X", "Y"]).filter_map(|(advice, name)| Some(advice.as_ref()?.way(name))).collect();
    if job.marks.is_some() {
        return format!("move the cloth by {}, and find its marks again", words.join(" and "));
    }
    let hint = format!("move the marker by {}", words.join(" and "));
    let Some(origin) = job.profile.sheet.origin else { return hint };
    // Messages have three decimals.
    let place = |i: usize| exact(((origin[i] + moves[i].as_ref().map_or(0.0, Advice::by)) * 1e3).round() / 1e3);
    format!("{hint}: sheet.origin = [{}, {}]", place(0), place(1))
}

/// Hint with a layout that fits where the marker does not: fewer copies, or the marker turned by a quarter.
fn fitting(marker: &Marker, extent: &Extent, job: &Job) -> Option<String> {
    if job.marks.is_some() {
        return None;
    }
    let (sheet, table) = (&job.profile.sheet, &job.profile.table);
    // Along X a conveyor brings the cloth beyond the table.
    let along = table.x_mm.filter(|_| job.profile.bite.length_mm.is_none());
    let room = [along, table.y_mm].map(|ends| ends.map_or(f64::INFINITY, |[least, most]| most - least + OFF_EPSILON));
    let (width, height) = extent.size();
    if sheet.copies > 1 {
        if !job.selection.is_all() {
            return None;
        }
        let of_copy = |copy: u32| {
            let mut extent = Extent::EMPTY;
            for piece in marker.pieces.iter().filter(|piece| piece.copy == copy) {
                let lines = piece.contours.iter().map(|contour| Extent::of(&marker.list.points(contour.range)));
                let strokes = piece.notches.iter().flat_map(Notch::strokes).map(|s| Extent::between(s.from, s.to));
                let holes = piece.drills.iter().map(|drill| Extent::between(drill.at, drill.at));
                lines.chain(strokes).chain(holes).for_each(|of| extent.join(&of));
            }
            extent
        };
        let [first, second] = [1, 2].map(of_copy);
        let pitch = second.min.x - first.min.x;
        if first.is_empty() || second.is_empty() || height > room[1] || pitch <= 0.0 {
            return None;
        }
        let more = ((room[0] - first.size().0) / pitch).floor();
        return (more >= 0.0).then(|| format!("so many copies fit: sheet.copies = {}", exact(more + 1.0)));
    }
    let fits = height <= room[0] && width <= room[1];
    // With equal scales the box of the turned marker is this one, turned.
    (fits && job.selection.is_all() && sheet.scale_x == sheet.scale_y).then(|| {
        let turned = exact((sheet.rotate_deg + 90.0).rem_euclid(360.0));
        format!("turned by a quarter it fits: sheet.rotate_deg = {turned}, sheet.origin = \"corner\"")
    })
}

/// Advice about a marker that is beyond the table along an axis.
enum Advice {
    /// Move it by that distance, mm, told with that number of decimals.
    Move { by: f64, decimals: u32 },
    /// It does not fit: its length, the excess, and the length of the table.
    TooLong([String; 3]),
}

impl Advice {
    /// Distance of the move, mm.
    fn by(&self) -> f64 {
        match self {
            Self::Move { by, .. } => *by,
            Self::TooLong(_) => 0.0,
        }
    }

    /// The move in words.
    fn way(&self, name: &str) -> String {
        match self {
            Self::Move { by, decimals } => {
                let sign = if *by < 0.0 { '-' } else { '+' };
                format!("{name} {sign}{} mm", fixed(by.abs(), *decimals))
            }
            Self::TooLong(_) => String::new(),
        }
    }

    /// The advice in words.
    fn alone(&self, name: &str) -> String {
        match self {
            Self::Move { .. } => format!("move the marker by {}", self.way(name)),
            Self::TooLong([lies, over, has]) => format!(
                "along {name} the marker does not fit: its {lies} mm are {over} mm more than the table has, {has} mm"
            ),
        }
    }
}

/// Place of the marker that is farthest off the table, with its source.
fn farthest(marker: &Marker, table: &Table) -> Option<(Point, Span)> {
    let mut worst = (0.0, None);
    let mut see = |point: Point, on_table: Point, span: Span| {
        let off = table.off(on_table.into());
        if off > worst.0 {
            worst = (off, Some((point, span)));
        }
    };
    for (piece, station) in marker.pieces.iter().zip(marker.stations()) {
        let mut see = |point: Point, span: Span| see(point, piece.on_table(point, station), span);
        for contour in &piece.contours {
            for (_, segment) in marker.list.walk(contour.range) {
                see(segment.to, segment.span);
                see(segment.from, segment.span);
            }
        }
        for stroke in piece.notches.iter().flat_map(Notch::strokes) {
            see(stroke.to, stroke.span);
            see(stroke.from, stroke.span);
        }
        piece.drills.iter().for_each(|drill| see(drill.at, drill.span));
    }
    worst.1
}

/// One direction of the table.
struct Axis<'a> {
    name: &'static str,
    /// Extent of the marker along it, mm.
    lies: [f64; 2],
    table: Option<[f64; 2]>,
    knife: &'a Knife,
}

impl Axis<'_> {
    /// Distances of the marker beyond the two ends of the table, mm; `None` when it is beyond neither.
    fn beyond(&self) -> Option<[f64; 2]> {
        let [least, most] = self.table?;
        let beyond = [least - self.lies[0], self.lies[1] - most];
        (beyond[0].max(beyond[1]) > OFF_EPSILON).then_some(beyond)
    }

    /// Excess at each end, in words.
    fn over(&self) -> Option<String> {
        let over = self.beyond()?.into_iter().zip(self.table?).filter(|(by, _)| *by > OFF_EPSILON);
        let words = over.map(|(by, end)| {
            format!("{} mm beyond {} {}", up(by - OFF_EPSILON, DECIMALS), self.name, fixed(end, DECIMALS))
        });
        Some(words.collect::<Vec<_>>().join(" and "))
    }

    /// Advice for this axis; `None` when the marker is on the table.
    fn advice(&self) -> Option<Advice> {
        let ([below, above], [least, most]) = (self.beyond()?, self.table?);
        let room = (most - least) - (self.lies[1] - self.lies[0]);
        if room < 0.0 {
            let [lies, has] = [self.lies[1] - self.lies[0], most - least].map(|size| fixed(size, DECIMALS));
            return Some(Advice::TooLong([lies, up(-room - OFF_EPSILON, DECIMALS), has]));
        }
        // Reach of the blade from its tip: if there is room, the blade shall stay on the table, too.
        let spare = self.knife.reach().min(room / 2.0);
        let by = below.max(above) + spare;
        let (by, decimals) = if spare > STEP {
            (((by - OFF_EPSILON) / STEP).ceil() * STEP, DECIMALS)
        } else {
            ((by / FINE_STEP).round() * FINE_STEP, FINE_DECIMALS)
        };
        Some(Advice::Move { by: if below > above { by } else { -by }, decimals })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advice(lies: [f64; 2], table: [f64; 2]) -> (Option<String>, Option<String>) {
        let knife = Knife::default();
        let axis = Axis { name: "X", lies, table: Some(table), knife: &knife };
        (axis.over(), axis.advice().map(|advice| advice.alone("X")))
    }

    #[test]
    fn the_marker_is_moved_back_as_far_as_there_is_room() {
        let check = |lies, table, over: &str, hint: &str| {
            assert_eq!(advice(lies, table), (Some(over.to_owned()), Some(hint.to_owned())));
        };
        assert_eq!(advice([0.0, 100.0], [0.0, 100.0]), (None, None));
        // Distance off the table plus the reach of the blade.
        check([-5.0, 100.0], [0.0, 205.0], "5.0 mm beyond X 0.0", "move the marker by X +12.4 mm");
        check([100.0, 305.01], [0.0, 300.0], "5.1 mm beyond X 300.0", "move the marker by X -12.5 mm");
        // Limited by the room on the table.
        check([-5.0, 100.0], [0.0, 105.0], "5.0 mm beyond X 0.0", "move the marker by X +5.000 mm");
        let hint = "along X the marker does not fit: its 105.0 mm are 5.0 mm more than the table has, 100.0 mm";
        check([0.0, 105.0], [0.0, 100.0], "5.0 mm beyond X 100.0", hint);
    }
}
