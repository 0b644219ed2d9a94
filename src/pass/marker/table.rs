//! Table: whether what is cut lies on the table of the profile. Changes nothing.
//!
//! Needs: the pieces of this run. Here only the lines are looked at, which the tip follows to their ends: what is off
//! the table now stays so. Overlaps and the swing of the blade are judged in the program.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::ir::marker::{Marker, Notch};
use crate::machine::{Job, Knife, Table};
use crate::source::Span;
use crate::units::number::{fixed, up};

pub(super) const PASS: MarkerPass = MarkerPass { name: "table", about: "finds what lies off the table", run };

/// A marker that leaves the table by less does so by rounding of the computation, mm.
const OFF_EPSILON: f64 = 1e-6;
/// Decimals of distances, and of those that have no room for rounding.
const DECIMALS: u32 = 1;
const FINE_DECIMALS: u32 = 3;
/// What a distance of so many decimals is rounded by at the most, mm.
const STEP: f64 = 0.1;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let table = &job.profile.table;
    if table.x_mm.is_none() && table.y_mm.is_none() {
        return;
    }
    let extent = marker.extent();
    let off = table.off(extent.min.into()).max(table.off(extent.max.into()));
    if extent.is_empty() || off <= OFF_EPSILON {
        return;
    }
    let Some((place, span)) = farthest(marker, table) else { return };
    let axes = [
        Axis { name: "X", lies: [extent.min.x, extent.max.x], table: table.x_mm, knife: &job.profile.knife },
        Axis { name: "Y", lies: [extent.min.y, extent.max.y], table: table.y_mm, knife: &job.profile.knife },
    ];
    let ways: Vec<String> = axes.iter().filter_map(Axis::over).collect();
    let (code, what) = if off > Table::EDGE_MM {
        (&code::MARKER_OFF_TABLE, "the marker leaves the table")
    } else {
        (&code::MARKER_OVER_EDGE, "the marker reaches over the edge of the table")
    };
    let finding = Diagnostic::new(code, format!("{what}: {}", ways.join(", ")));
    let finding = finding.at(span).on_cloth(place).by(off);
    diagnostics.push(axes.iter().filter_map(Axis::advice).fold(finding, Diagnostic::hint));
}

/// The place of the marker that is the farthest off, with its source.
fn farthest(marker: &Marker, table: &Table) -> Option<(Point, Span)> {
    let mut worst = (0.0, None);
    let mut see = |point: Point, span: Span| {
        let off = table.off(point.into());
        if off > worst.0 {
            worst = (off, Some((point, span)));
        }
    };
    for piece in &marker.pieces {
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
    /// Where the marker lies along it, mm.
    lies: [f64; 2],
    table: Option<[f64; 2]>,
    knife: &'a Knife,
}

impl Axis<'_> {
    /// How far the marker is beyond the two ends of the table, mm; nothing when it is beyond none.
    fn beyond(&self) -> Option<[f64; 2]> {
        let [least, most] = self.table?;
        let beyond = [least - self.lies[0], self.lies[1] - most];
        (beyond[0].max(beyond[1]) > OFF_EPSILON).then_some(beyond)
    }

    /// By how much, in words.
    fn over(&self) -> Option<String> {
        let over = self.beyond()?.into_iter().zip(self.table?).filter(|(by, _)| *by > OFF_EPSILON);
        let words = over.map(|(by, end)| {
            format!("{} mm beyond {} {}", up(by - OFF_EPSILON, DECIMALS), self.name, fixed(end, DECIMALS))
        });
        Some(words.collect::<Vec<_>>().join(" and "))
    }

    /// How to move the marker; or that it does not fit.
    fn advice(&self) -> Option<String> {
        let ([below, above], [least, most], name) = (self.beyond()?, self.table?, self.name);
        let room = (most - least) - (self.lies[1] - self.lies[0]);
        if room < 0.0 {
            let size = [self.lies[1] - self.lies[0], most - least].map(|size| fixed(size, DECIMALS));
            let [lies, has] = size;
            return Some(format!(
                "along {name} the marker does not fit: its {lies} mm are {} mm more than the table has, {has} mm",
                up(-room - OFF_EPSILON, DECIMALS)
            ));
        }
        // The blade reaches so far from its tip; where there is room for that it is to stay on the table, too.
        let knife = self.knife;
        let reach = knife.width_mm + knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
        let spare = reach.min(room / 2.0);
        let by = below.max(above) + spare;
        let by = if spare > STEP { up(by - OFF_EPSILON, DECIMALS) } else { fixed(by, FINE_DECIMALS) };
        Some(format!("move the marker by {name} {}{by} mm", if below > above { '+' } else { '-' }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advice(lies: [f64; 2], table: [f64; 2]) -> (Option<String>, Option<String>) {
        let knife = Knife::default();
        let axis = Axis { name: "X", lies, table: Some(table), knife: &knife };
        (axis.over(), axis.advice())
    }

    #[test]
    fn the_marker_is_moved_back_as_far_as_there_is_room() {
        let check = |lies, table, over: &str, hint: &str| {
            assert_eq!(advice(lies, table), (Some(over.to_owned()), Some(hint.to_owned())));
        };
        assert_eq!(advice([0.0, 100.0], [0.0, 100.0]), (None, None));
        // As far as the blade reaches, beside what it takes.
        check([-5.0, 100.0], [0.0, 205.0], "5.0 mm beyond X 0.0", "move the marker by X +12.4 mm");
        check([100.0, 305.01], [0.0, 300.0], "5.1 mm beyond X 300.0", "move the marker by X -12.5 mm");
        // As far as there is room.
        check([-5.0, 100.0], [0.0, 105.0], "5.0 mm beyond X 0.0", "move the marker by X +5.000 mm");
        let hint = "along X the marker does not fit: its 105.0 mm are 5.0 mm more than the table has, 100.0 mm";
        check([0.0, 105.0], [0.0, 100.0], "5.0 mm beyond X 100.0", hint);
    }
}
