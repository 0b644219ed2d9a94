//! The unit of the numbers, from the file or the profile, and the plausibility of the resulting size.

use super::run::Run;
use super::title::Title;
use super::vertex::Vertices;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::machine::{FileUnit, LONGEST_LAY_MM};
use crate::source::Span;
use crate::units::MM_PER_INCH;

/// Default unit (1/100 inch), mm, which the standard defines. With a wrong unit the drawing may fit neither its title nor a
/// table; [`check_plausible`] reports that and the unit that would fit, or else that the unit is assumed.
const DEFAULT_MM: f64 = MM_PER_INCH / 100.0;

/// Maximum distance of a point from the origin along an axis, mm: a kilometre, far beyond any table.
pub(super) const FARTHEST: f64 = 1e6;

/// Maximum width of a marker on a table, mm, which is up to some 3 m wide, and minimum size of a part, mm.
const WIDEST: f64 = 3500.0;
const SMALLEST: f64 = 5.0;
/// Side below which a drawing in inch units with decimals is doubted, mm. Ten metres written in inches and read as thousandths
/// have that size.
const SMALLEST_OF_DECIMALS: f64 = 10.0;
/// Range of the ratio of the drawing to the size in its title: 40 % to 102 %.
const LEAST_FILL: f64 = 0.40;
const MOST_FILL: f64 = 1.02;
/// Maximum ratio of a side without the outlying point to the side with it.
const FAR: f64 = 0.5;

/// The possible units of a file, with the values of the profile key.
const CANDIDATES: [(FileUnit, &str); 3] =
    [(FileUnit::TenthMm, "mm/10"), (FileUnit::HundredthInch, "in/100"), (FileUnit::ThousandthInch, "in/1000")];

/// The codes of the units.
const CODES: [(FileUnit, &str); 3] =
    [(FileUnit::TenthMm, "G71"), (FileUnit::HundredthInch, "G91"), (FileUnit::ThousandthInch, "G70")];

/// Hint on the other meaning of G91.
const RELATIVE: &str = "G91 is a unit in cut files; in other machines it asks for relative places, not read here";

/// Input of the plausibility check.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sized<'a> {
    pub(super) unit: &'a Unit,
    /// The bounding box of all cuts.
    pub(super) extent: &'a Extent,
    pub(super) title: Option<&'a Title>,
    /// The bytes of the file.
    pub(super) bytes: &'a [u8],
}

/// The current unit.
#[derive(Debug)]
pub(super) struct Unit {
    mm: f64,
    /// True if the profile sets it; the file cannot change it.
    by_profile: bool,
    /// True after a coordinate was converted; the unit may then not change.
    in_use: bool,
    /// The unit that the file states.
    stated: Option<FileUnit>,
    /// True if the file has G91, the code of relative coordinates in most controllers.
    has_g91: bool,
}

impl Unit {
    pub(super) fn new(profile: FileUnit) -> Self {
        Self {
            mm: profile.mm().unwrap_or(DEFAULT_MM),
            by_profile: profile.mm().is_some(),
            in_use: false,
            stated: None,
            has_g91: false,
        }
    }

    /// Length of the unit, mm; marks the unit as used.
    pub(super) fn convert(&mut self) -> f64 {
        self.in_use = true;
        self.mm
    }

    /// Length of the unit, mm.
    pub(super) fn mm(&self) -> f64 {
        self.mm
    }

    /// True if the unit is a fraction of an inch.
    fn is_of_inches(&self) -> bool {
        FileUnit::TenthMm.mm() != Some(self.mm)
    }

    /// The warning that neither the file nor the profile states the unit.
    fn assumed(&self) -> Option<Diagnostic> {
        if self.by_profile || self.stated.is_some() {
            return None;
        }
        let message = format!("no G70, G71 or G91 states the unit: {} mm (1/100 inch) is assumed", self.mm);
        let finding = Diagnostic::new(&code::ISO_NO_UNIT, message);
        Some(finding.hint("compare the size of a part, and set `units` in the profile: mm/10, in/100 or in/1000"))
    }

    /// Sets the unit stated in the file.
    pub(super) fn set(&mut self, unit: FileUnit, span: Span, out: &mut Diagnostics) {
        self.has_g91 |= unit == FileUnit::HundredthInch;
        let Some(mm) = unit.mm().filter(|_| !self.by_profile) else { return };
        let before = self.stated.replace(unit);
        if mm.to_bits() == self.mm.to_bits() || !self.in_use && before.is_none() {
            self.mm = mm;
            return;
        }
        let (old, new) = (before.map_or("no code", code_of), code_of(unit));
        let message = if self.in_use {
            format!("the unit changes from {} mm to {mm} mm ({new}) after coordinates", self.mm)
        } else {
            format!("{old} and {new} contradict each other: a unit of {} mm or of {mm} mm", self.mm)
        };
        let finding = Diagnostic::new(&code::ISO_UNITS_CHANGED, message).at(span);
        // A choice of the unit would cut a tangle where G91 asks for relative coordinates.
        let is_relative = unit == FileUnit::HundredthInch || self.has_g91 && !self.in_use;
        out.push(match (is_relative, self.in_use) {
            (true, true) => finding.hint(RELATIVE).hint("two jobs may stand in one file: then split it"),
            (true, false) => finding.hint(RELATIVE),
            (false, true) => finding.hint("two jobs may stand in one file: split it; or set `units` in the profile"),
            (false, false) => {
                finding.hint("compare a part: `--set units=mm/10`, in/100 or in/1000 says which is right")
            }
        });
    }
}

/// The code of a unit.
fn code_of(unit: FileUnit) -> &'static str {
    CODES.iter().find(|(of, _)| *of == unit).map_or("units", |(_, code)| code)
}

/// A point of the drawing, and its block.
type DrawnPlace = (Point, Span);

/// All points in the bounding box of a marker, with their blocks.
fn places(marker: &Marker) -> impl Iterator<Item = DrawnPlace> + '_ {
    let cut = marker.contours().flat_map(|(_, contour)| marker.list.vertices(contour.range));
    let of_piece = marker.pieces.iter().flat_map(|piece| {
        let slits = piece.notches.iter().flat_map(|notch| [(notch.root, notch.span), (notch.tip, notch.span)]);
        slits.chain(piece.drills.iter().map(|drill| (drill.at, drill.span)))
    });
    cut.chain(of_piece)
}

/// Points that are alone in a half of a box: left, right, lower or upper. `None` if each half has at least two, which may be
/// known long before the last point.
fn alone(extent: &Extent, places: impl Iterator<Item = DrawnPlace>) -> Option<Vec<DrawnPlace>> {
    let middle = extent.min + (extent.max - extent.min) / 2.0;
    let mut first: [Option<DrawnPlace>; 4] = [None; 4];
    let mut is_crowded = [false; 4];
    for place in places {
        let (x, y) = (place.0.x - middle.x, place.0.y - middle.y);
        for (half, is_in) in [x < 0.0, x > 0.0, y < 0.0, y > 0.0].into_iter().enumerate() {
            match first[half] {
                None if is_in => first[half] = Some(place),
                Some((at, _)) if is_in && at != place.0 => is_crowded[half] = true,
                _ => {}
            }
        }
        if is_crowded == [true; 4] {
            return None;
        }
    }
    let uncrowded = first.into_iter().zip(is_crowded).filter(|(_, is_crowded)| !is_crowded);
    Some(uncrowded.filter_map(|(place, _)| place).collect())
}

/// The single point that makes a drawing too large: without it the rest `fits`. It is alone in a half of the box.
fn far_from_others(extent: &Extent, marker: &Marker, fits: impl Fn(&Extent) -> bool) -> Option<DrawnPlace> {
    // The first points of the contours, taken from both ends of the marker, usually rule out such a point quickly.
    let both = marker.pieces.iter().zip(marker.pieces.iter().rev()).flat_map(|(one, other)| [one, other]);
    let contours = both.flat_map(|piece| &piece.contours);
    alone(extent, contours.flat_map(|contour| marker.list.vertices(contour.range).take(2)))?;
    alone(extent, places(marker))?.into_iter().find(|(far, _)| {
        let mut rest = Extent::EMPTY;
        places(marker).filter(|(at, _)| at != far).for_each(|(at, _)| rest.add(at));
        !rest.is_empty() && fits(&rest)
    })
}

/// True if most coordinates of a file have decimal points.
fn has_decimals(bytes: &[u8]) -> bool {
    let (mut all, mut decimal) = (0, 0);
    for at in memchr::memchr2_iter(b'X', b'Y', bytes) {
        let number = &bytes[at + 1..];
        let number = number.strip_prefix(b"-").or(number.strip_prefix(b"+")).unwrap_or(number);
        let digits = number.iter().take_while(|byte| byte.is_ascii_digit()).count();
        all += usize::from(digits > 0);
        decimal += usize::from(digits > 0 && number.get(digits) == Some(&b'.'));
    }
    2 * decimal > all
}

/// The error for a file whose numbers are most likely inches with decimals.
fn of_decimals(unit: &Unit, extent: &Extent) -> Diagnostic {
    let (length, width) = extent.size();
    let per_inch = (MM_PER_INCH / unit.mm).round();
    let message =
        format!("coordinates have decimals: in units of {} mm the drawing is {length:.1} x {width:.1} mm", unit.mm);
    let of_read = (length, width);
    let [length, width] = [length, width].map(|side| side * per_inch);
    let finding = Diagnostic::new(&code::ISO_DECIMALS, message);
    let finding = finding.hint(format!("read as inches it would be {length:.0} x {width:.0} mm"));
    let finding =
        finding.hint(format!("let the CAD write whole numbers, {per_inch:.0} an inch; or as mm with G71, 10 a mm"));
    match CANDIDATES.iter().find(|(of, _)| of.mm() == Some(unit.mm)) {
        Some((_, key)) if of_read.0.max(of_read.1) >= SMALLEST_OF_DECIMALS => {
            finding.hint(format!("where the size is right as it was read, `--set units={key}` says so"))
        }
        _ => finding,
    }
}

/// The warning for a file whose numbers are most likely mm with decimals.
fn of_decimal_mm(unit: &Unit, extent: &Extent) -> Diagnostic {
    let (length, width) = extent.size();
    let message =
        format!("coordinates have decimals: in units of {} mm the drawing is {length:.1} x {width:.1} mm", unit.mm);
    let [length, width] = [length, width].map(|side| side / unit.mm);
    let finding = Diagnostic::new(&code::ISO_UNIT_DOUBTFUL, message);
    let finding = finding.hint(format!("read as mm it would be {length:.0} x {width:.0} mm"));
    finding.hint("let the CAD write whole numbers, 10 a mm; where it is right, `--set units=mm/10` says so")
}

/// The warning for a drawing that fits neither its title nor any table.
fn doubt(Sized { unit, extent, title, .. }: Sized) -> Diagnostic {
    let (length, width) = extent.size();
    let drawn = format!("{length:.0} x {width:.0} mm");
    match title {
        Some(title) if width <= WIDEST && length <= LONGEST_LAY_MM && length.max(width) >= SMALLEST => {
            let stated = |size: Option<f64>| size.map_or("any".to_owned(), |size| format!("{size:.0}"));
            let (l, w) = (stated(title.length), stated(title.width));
            let message =
                format!("with a unit of {} mm the drawing is {drawn}, but its title says {l} x {w} mm", unit.mm);
            Diagnostic::new(&code::ISO_UNIT_DOUBTFUL, message).at(title.span)
        }
        _ => {
            let what = match () {
                () if width > WIDEST => "wider than any table",
                () if length > LONGEST_LAY_MM => "longer than any table",
                () => "smaller than any part",
            };
            let message = format!("with a unit of {} mm the drawing is {drawn}: {what}", unit.mm);
            Diagnostic::new(&code::ISO_UNIT_DOUBTFUL, message)
        }
    }
}

/// Warns if the drawing fits neither its title nor any table, and names the units that would fit.
pub(super) fn check_plausible(sized: Sized, marker: &Marker, out: &mut Diagnostics) {
    let Sized { unit, extent, title, bytes } = sized;
    if extent.is_empty() {
        return;
    }
    let (length, width) = extent.size();
    let per_inch = MM_PER_INCH / unit.mm;
    // As inches it would be a marker, and as written it is narrower than any.
    let is_marker_in_inches = !unit.by_profile && width * per_inch <= WIDEST && length * per_inch <= LONGEST_LAY_MM;
    let is_small = length.max(width) < SMALLEST_OF_DECIMALS || is_marker_in_inches;
    if unit.is_of_inches() && is_small && has_decimals(bytes) {
        out.push(of_decimals(unit, extent));
        return;
    }
    let fits_as = |(length, width): (f64, f64), scale: f64| {
        let filled = |size: f64, stated: Option<f64>| {
            stated.is_none_or(|stated| (LEAST_FILL..=MOST_FILL).contains(&(size * scale / stated)))
        };
        title.is_none_or(|title| filled(length, title.length) && filled(width, title.width))
            && width * scale <= WIDEST
            && length * scale <= LONGEST_LAY_MM
            && length.max(width) * scale >= SMALLEST
    };
    let fits = |scale: f64| fits_as((length, width), scale);
    let is_mm = || !unit.by_profile && title.is_none() && fits(1.0 / unit.mm) && has_decimals(bytes);
    if !unit.is_of_inches() && is_mm() {
        out.push(of_decimal_mm(unit, extent));
        return;
    }
    if fits(1.0) {
        // A title that fits the drawing tells the unit as well as a code.
        if let Some(finding) = unit.assumed().filter(|_| title.is_none()) {
            out.push(finding);
        }
        return;
    }
    let drawn = format!("{length:.0} x {width:.0} mm");
    let mut finding = doubt(sized);
    let is_rest = |rest: &Extent| {
        let size = rest.size();
        (size.0 < FAR * length || size.1 < FAR * width) && fits_as(size, 1.0)
    };
    if let Some((at, span)) = far_from_others(extent, marker, is_rest) {
        let message =
            format!("the drawing is {drawn}, but without the place X {:.0} Y {:.0} mm it would fit", at.x, at.y);
        let finding = Diagnostic::new(&code::ISO_UNIT_DOUBTFUL, message).at(span);
        out.push(finding.hint("one place alone lies far from the others: a digit of it may be doubled or wrong"));
        return;
    }
    for (candidate, key) in CANDIDATES {
        if candidate.mm().is_some_and(|mm| fits(mm / unit.mm)) {
            finding = finding.hint(format!("`units = \"{key}\"` in the profile would fit"));
        }
    }
    if finding.hints.is_empty() {
        finding =
            finding.hint("no unit of cut files would fit: check that the drawing is whole, and its title its own");
    }
    out.push(finding);
}

/// Converts a point of the file to mm. The first point that is too far away is recorded in `far`, for a later report.
pub(super) fn convert(place: [f64; 2], unit: f64, span: Span, far: &mut Option<(Point, Span)>) -> Point {
    let to = scale(place, unit);
    if (to.x.abs() > FARTHEST) | (to.y.abs() > FARTHEST) {
        keep_first(far, to, span);
    }
    to
}

/// Converts the points of a run to mm and appends them to `vertices`. The first point that is too far away is recorded in
/// `far`. Returns the last point, in units of the file.
pub(super) fn convert_run(
    run: &Run,
    unit: f64,
    far: &mut Option<(Point, Span)>,
    vertices: &mut Vertices,
) -> Option<[f64; 2]> {
    vertices.extend(run.places().map(|place| scale(place, unit)), run.spans());
    if far.is_none() && run.bound() * unit > FARTHEST {
        for (place, &span) in run.places().zip(run.spans()) {
            convert(place, unit, span, far);
        }
    }
    run.places().next_back()
}

#[cold]
fn keep_first(far: &mut Option<(Point, Span)>, to: Point, span: Span) {
    far.get_or_insert((to, span));
}

/// Converts with a single multiplication, so that equal numbers of the file give equal bits.
pub(super) fn scale(place: [f64; 2], unit: f64) -> Point {
    Point::new(place[0] * unit, place[1] * unit)
}
