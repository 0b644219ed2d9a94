//! Sheet: lays the marker on the table by the profile (turned, mirrored, scaled, moved, copied), or by registration marks.
//!
//! Needs: everything recognised by its size in the file, such as notches. Leaves true: the same pieces, in the same order, once
//! for each copy; events are repeated in each. The lower left corner of the box stays where it is, except for `sheet.origin`.
//! Texts turn with their pieces and stay readable: they are never mirrored, and if the file has another text for mirrored
//! pieces, that one is shown. A marker that advances the cloth itself is not lengthened, turned or copied: its advances belong
//! to the places in the file.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Heading, Point, Vector};
use crate::ir::drawing::{Account, Aside};
use crate::ir::marker::{Contour, Event, Label, Marker, Piece};
use crate::ir::toolpath;
use crate::machine::{AffineMap, Job, MachineProfile, Marks, Sheet};
use crate::units::number::fixed;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "sheet", about: "turns, mirrors, scales, moves and copies the marker, if that is asked", run };

/// Stretch of cloth beyond which a map is doubted, as a share.
const ODD_STRETCH: f64 = 0.05;
/// Turn or skew of a lay beyond which a map is doubted, deg.
const ODD_ANGLE_DEG: f64 = 5.0;
/// Error of a map at the corners of the marker beyond which it is doubted, relative to the greatest one at a mark: it is
/// reached about a third of the extent of the marks beyond them.
const MOST_ERROR: f64 = 1.5;
/// Greatest number of segments of all copies together: they take some gigabytes of memory.
const MOST_SEGMENTS: usize = 1 << 26;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    if let Some(marks) = &job.marks {
        return by_marks(marker, marks, job, diagnostics);
    }
    let sheet = &job.profile.sheet;
    if sheet.is_plain() {
        return;
    }
    if let Some(advance) = advances(marker).next().filter(|_| !sheet.keeps_length()) {
        let message = "the file moves the cloth on, so that its marker cannot be turned, mirrored end to end, scaled along X or copied";
        let hint = "leave these keys of `sheet` out, or switch the advance off: codes.M69 = \"ignore\"";
        diagnostics.push(Diagnostic::new(&code::SHEET_ADVANCE, message).at(advance.span).hint(hint));
        return;
    }
    let copies = sheet.copies as usize;
    let segments: usize =
        marker.contours().map(|(_, contour)| marker.list.points(contour.range).len()).sum::<usize>() + 1;
    if segments.saturating_mul(copies) > MOST_SEGMENTS {
        let message = format!("{copies} copies of {segments} points are more than one program can have");
        let hint = format!("this marker can be copied {} times: sheet.copies", MOST_SEGMENTS / segments);
        diagnostics.push(Diagnostic::new(&code::SHEET_COPIES, message).hint(hint));
        return;
    }
    let drawn = marker.extent();
    if drawn.is_empty() {
        return;
    }
    lay(marker, &Way::of(sheet));
    let laid = marker.extent();
    let pitch = laid.size().0 + sheet.copies_gap_mm;
    let by = match sheet.origin {
        Some([x, y]) if Way::of(sheet).stays() => Vector::new(x, y),
        Some([x, y]) => drawn.min - laid.min + Vector::new(x, y),
        None => {
            let (width, height) = laid.size();
            in_corner(&job.profile, [width + (copies - 1) as f64 * pitch, height]) - laid.min
        }
    };
    lay(marker, &Way { by, ..Way::STAYS });
    marker.unit *= sheet.growth();
    copy(marker, copies, Vector::new(pitch, 0.0));
}

/// Lays a marker by its registration marks.
fn by_marks(marker: &mut Marker, marks: &Marks, job: &Job, diagnostics: &mut Diagnostics) {
    let sheet = &job.profile.sheet;
    if !sheet.is_plain() {
        let message = format!("`--map` says where the drawing lies on the table, and so does `sheet`: {sheet}");
        diagnostics
            .push(Diagnostic::new(&code::MARKS_SHEET, message).hint("leave the keys of `sheet` at their defaults"));
    }
    if let Some(advance) = advances(marker).next() {
        let message = "the file moves the cloth on, so that marks that were found before do not say where it lies then";
        let hint = "cut it without `--map`, or switch the advance off: codes.M69 = \"ignore\"";
        diagnostics.push(Diagnostic::new(&code::MARKS_SHEET, message).at(advance.span).hint(hint));
    }
    if job.profile.bite.length_mm.is_some() {
        let message = "`--map` says where the drawing lies, and a conveyor (`bite.length_mm`) moves it away from there";
        let hint = "cut it without `--map`, or on a table that holds all of it";
        diagnostics.push(Diagnostic::new(&code::MARKS_SHEET, message).hint(hint));
    }
    let drawn = marker.extent();
    if diagnostics.has_errors() || drawn.is_empty() {
        return;
    }
    odd(marks, &drawn, diagnostics);
    lay(marker, &Way::by(marks.map()));
    marker.unit *= marks.map().growth();
}

/// Warns of an unlikely map, and of a marker far beyond its marks.
fn odd(marks: &Marks, drawn: &Extent, diagnostics: &mut Diagnostics) {
    let mut warn =
        |message: String, hint: &str| diagnostics.push(Diagnostic::new(&code::MARKS_ODD, message).hint(hint));
    let map = marks.map();
    let stretch = map.stretch().map(|stretch| (stretch - 1.0).abs()).into_iter().fold(0.0, f64::max);
    let angle = map.turned_deg().abs().max(map.skewed_deg().abs());
    if stretch > ODD_STRETCH || angle > ODD_ANGLE_DEG {
        warn(format!("the marks give an odd map: {marks}"), "are they of this drawing, and found on this cloth?");
    }
    let corners = [drawn.min.x, drawn.max.x].into_iter().flat_map(|x| [[x, drawn.min.y], [x, drawn.max.y]]);
    let error = corners.map(|corner| marks.error(corner)).fold(0.0, f64::max);
    if error > MOST_ERROR {
        let times = fixed(error, 1);
        warn(
            format!(
                "the marker reaches beyond the marks: an error in finding them is {times} times as large at its corners"
            ),
            "find marks near its ends as well; are all four numbers in mm?",
        );
    }
}

/// Events of the file that advance the cloth.
fn advances(marker: &Marker) -> impl Iterator<Item = &Event> {
    let events = marker.pieces.iter().flat_map(|piece| &piece.events).chain(&marker.closing);
    events.filter(|event| event.kind == toolpath::Event::Advance)
}

/// Position of the lower left corner of a box of this size, mm, in that of the table: as far from an edge as the blade may
/// reach beyond a line, or centred if there is less room.
fn in_corner(profile: &MachineProfile, size: [f64; 2]) -> Point {
    let along = |ends: Option<[f64; 2]>, size: f64| {
        ends.map_or(0.0, |[least, most]| least + profile.knife.reach().min((most - least - size) / 2.0).max(0.0))
    };
    // A conveyor brings the rest of it onto the table.
    let long = profile.bite.length_mm.map_or(size[0], |_| 0.0);
    Point::new(along(profile.table.x_mm, long), along(profile.table.y_mm, size[1]))
}

/// Placement of points.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    /// Images of the unit vectors along X and Y.
    axes: [Vector; 2],
    by: Vector,
    /// True if it mirrors.
    is_mirrored: bool,
}

impl Way {
    const STAYS: Self =
        Self { axes: [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)], by: Vector::new(0.0, 0.0), is_mirrored: false };

    /// Placement about the origin of the file.
    fn of(sheet: &Sheet) -> Self {
        Self { is_mirrored: sheet.is_mirrored(), ..Self::by(&sheet.turned()) }
    }

    /// Placement by a map without mirroring.
    fn by(map: &AffineMap) -> Self {
        Self { axes: map.axes.map(Vector::from), by: Vector::from(map.by), is_mirrored: false }
    }

    fn stays(&self) -> bool {
        self.axes == Self::STAYS.axes
    }

    fn vector(&self, step: Vector) -> Vector {
        self.axes[0] * step.x + self.axes[1] * step.y
    }

    fn place(&self, at: Point) -> Point {
        Point::origin() + self.vector(at.coords) + self.by
    }

    fn move_place(&self, at: &mut Point) {
        *at = self.place(*at);
    }

    fn piece(&self, piece: &mut Piece) {
        piece.places_mut().for_each(|at| self.move_place(at));
        piece.labels.iter_mut().for_each(|label| self.label(label));
    }

    fn label(&self, label: &mut Label) {
        let has_place = label.at.is_some();
        if let Some(at) = &mut label.at {
            self.move_place(at);
        }
        if let Some(mirrored) = label.mirrored.as_mut().filter(|_| self.is_mirrored) {
            std::mem::swap(mirrored, &mut label.span);
        }
        if self.stays() {
            return;
        }
        // A text without a direction runs along the image of X.
        let heading = label.heading.unwrap_or(Heading::new(0.0));
        let turned = Heading::of(self.vector(heading.unit()));
        if label.heading.is_some() || has_place && turned != heading {
            label.heading = Some(turned);
        }
    }
}

/// Moves all geometry, and everything that is shown.
fn lay(marker: &mut Marker, way: &Way) {
    if *way == Way::STAYS {
        return;
    }
    marker.list.move_points(|at| way.place(at));
    marker.pieces.iter_mut().for_each(|piece| way.piece(piece));
    for vertex in marker.drawing.iter_mut().flat_map(|account| &mut account.aside.vertices) {
        way.move_place(&mut vertex.at);
    }
}

/// Appends copies of the marker, each displaced by `step` from the previous one.
fn copy(marker: &mut Marker, copies: usize, step: Vector) {
    if copies < 2 {
        return;
    }
    let first = marker.pieces.len();
    let segments = marker.contours().map(|(_, contour)| marker.list.points(contour.range).len()).sum::<usize>();
    let ranges = marker.contours().count();
    marker.list.reserve(segments * (copies - 1), ranges * (copies - 1));
    marker.pieces.reserve_exact(first * (copies - 1));
    let aside = marker.drawing.as_ref().map(|Account { aside, .. }| aside.clone());
    for number in 2..=copies {
        let way = Way { by: step * (number - 1) as f64, ..Way::STAYS };
        for i in 0..first {
            let mut piece = Piece { copy: number as u32, ..marker.pieces[i].clone() };
            for Contour { range, .. } in &mut piece.contours {
                let segments: Vec<_> = marker.list.walk(*range).map(|(_, segment)| segment).collect();
                let moved = segments.into_iter().map(|mut segment| {
                    way.move_place(&mut segment.from);
                    way.move_place(&mut segment.to);
                    segment
                });
                *range = marker.list.append(moved).expect("it has as many segments as before");
            }
            way.piece(&mut piece);
            marker.pieces.push(piece);
        }
        for (class, vertices) in aside.iter().flat_map(Aside::each) {
            let mut vertices = vertices.to_vec();
            for vertex in &mut vertices {
                way.move_place(&mut vertex.at);
            }
            if let Some(account) = &mut marker.drawing {
                account.aside.add(class, &vertices);
            }
        }
    }
    marker.pieces[..first].iter_mut().for_each(|piece| piece.copy = 1);
}
