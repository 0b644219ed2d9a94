//! Far points: vertices of a contour that a wrong digit has moved away.
//!
//! The neighbours of such a vertex lie near each other. Three forms of it are told:
//!
//! - A vertex 300 mm or more off, out of the rest of its contour, or with a digit too many or too few.
//! - A needle: a vertex 30 mm or more off, on legs of different length that leave the line of the contour. The legs of a dart are
//!   sewn to each other and equally long; those of a needle are not, unless by chance.
//! - A corner a metre or more off, several times as far as the rest of its contour is long.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::angle::turn;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::Range;
use crate::ir::marker::{Contour, Marker};
use crate::units::number;

/// Least distance of a far point from both of its neighbours, mm: a part of a garment has no spike so long.
const FAR: f64 = 300.0;
/// Greatest distance between these neighbours, as a share of that.
const FAR_SHARE: f64 = 0.1;
/// Least distance of a misplaced corner from both neighbours, mm: parts of a garment that are longer than this and taper to a
/// point are rare.
const FAR_CORNER: f64 = 1000.0;
/// Greatest distance between the neighbours of a misplaced corner, as a share of that.
const CORNER_SHARE: f64 = 0.3;
/// Least area of the rest of a contour with a misplaced corner, as a share of the square of its longer side; a long triangle has
/// less.
const CORNER_REST: f64 = 0.1;
/// Least length of both legs of a needle, mm: twice the depth of the deepest notch.
const NEEDLE: f64 = 30.0;
/// Greatest distance between the neighbours of a needle, as a share of its shorter leg.
const NEEDLE_SHARE: f64 = 1.0 / 3.0;
/// Least difference between the legs of a needle: as a share of the distance between its neighbours, and mm. The legs of a dart
/// differ by the rounding of a CAD system.
const LEGS_SHARE: f64 = 0.25;
const LEGS: f64 = 1.0;
/// Least turn from the line of a contour into a leg of a needle, rad: where two curves taper to a point they lead on into it.
const LEAVES: f64 = std::f64::consts::FRAC_PI_3;
/// Least area of a contour without its far point, as a multiple of that of the spike.
const REST: f64 = 4.0;
/// Length of a spike, as a multiple of the extent of the rest of its contour, from which on that is compared with the square of
/// its foot alone.
const LONGER: f64 = 3.0;
/// Greatest number of far points of a contour that are compared with the rest of it, the farthest first.
const MOST_TRIED: usize = 16;

/// Reports the number of contours that have a far point, and the farthest.
pub(super) fn report(marker: &Marker, diagnostics: &mut Diagnostics) {
    let (mut count, mut worst): (usize, Option<(f64, usize, Range, usize)>) = (0, None);
    for (piece, contour) in marker.contours() {
        let Some((off, before)) = farthest(marker, contour) else { continue };
        count += 1;
        if worst.is_none_or(|(most, ..)| off > most) {
            worst = Some((off, piece, contour.range, before));
        }
    }
    let Some((off, piece, range, segment)) = worst else { return };
    let (off, number) = (number::fixed(off, 0), marker.pieces[piece].number);
    let message = match count {
        1 => format!("a point of piece {number} stands {off} mm off its neighbours"),
        count => format!("{count} contours have a point far off its neighbours, piece {number} {off} mm"),
    };
    let span = marker.list.spans(range)[segment];
    let finding = Diagnostic::new(&code::MARKER_FAR_POINT, message).at(span).about(vec![number]);
    diagnostics.push(finding.hint("a digit may be doubled or lost: look at the picture (`-t svg`), export it again"));
}

/// Distance of the farthest far point of a contour from its neighbours, mm, and the index of the one before it.
fn farthest(marker: &Marker, contour: &Contour) -> Option<(f64, usize)> {
    let points = marker.list.points(contour.range);
    let last = points.len() - 1;
    // A line turns back at a far point, so that a monotone chain begins there.
    let chains = marker.list.chains(contour.range);
    let begins = chains.each().map(|(chain, _)| chain.first as usize).filter(|k| (1..last).contains(k));
    let start = contour.closed.then_some([last - 1, last, 1]);
    let spikes = begins.map(|k| [k - 1, k, k + 1]).chain(start).map(|three| (three, Spike::of(&points, three)));
    let is_closed = contour.closed;
    let mut far: Vec<_> = spikes.filter(|(three, spike)| spike.may_be_far(&points, *three, is_closed)).collect();
    far.sort_by(|a, b| b.1.shorter().total_cmp(&a.1.shorter()));
    let wrong = far.into_iter().take(MOST_TRIED).find(|(three, spike)| {
        let is_needle = spike.is_needle(&points, *three, is_closed);
        Rest::of(&points, *spike).is_wrong(is_needle, marker.unit)
    });
    wrong.map(|([before, ..], spike)| (spike.shorter(), before))
}

/// A vertex and its neighbours.
#[derive(Debug, Clone, Copy)]
struct Spike {
    before: Point,
    at: Point,
    after: Point,
}

impl Spike {
    fn of(points: &[Point], [before, at, after]: [usize; 3]) -> Self {
        Self { before: points[before], at: points[at], after: points[after] }
    }

    /// Lengths of both legs, mm.
    fn legs(&self) -> [f64; 2] {
        [self.before, self.after].map(|end| (self.at - end).norm())
    }

    fn shorter(&self) -> f64 {
        let [one, other] = self.legs();
        one.min(other)
    }

    /// Distance between the neighbours, mm.
    fn foot(&self) -> f64 {
        (self.after - self.before).norm()
    }

    /// True if the legs are long enough beside their foot for one of the forms.
    fn may_be_far(&self, points: &[Point], three: [usize; 3], is_closed: bool) -> bool {
        let shorter = self.shorter();
        let share = if shorter >= FAR_CORNER { CORNER_SHARE } else { FAR_SHARE };
        shorter >= FAR && self.foot() <= share * shorter || self.is_needle(points, three, is_closed)
    }

    /// True if the vertex stands out of a line that its neighbours continue, on legs of different length.
    fn is_needle(&self, points: &[Point], [before, _, after]: [usize; 3], is_closed: bool) -> bool {
        let ([one, other], foot) = (self.legs(), self.foot());
        let is_thin = one.min(other) >= NEEDLE && foot <= NEEDLE_SHARE * one.min(other);
        if !is_thin || (one - other).abs() < LEGS.max(LEGS_SHARE * foot) {
            return false;
        }
        let last = points.len() - 1;
        if !is_closed && (before == 0 || after == last) {
            return false;
        }
        let previous = points[if before == 0 { last - 1 } else { before - 1 }];
        let next = points[if after == last { 1 } else { after + 1 }];
        let into = turn(self.before - previous, self.at - self.before).abs();
        let out = turn(self.after - self.at, next - self.after).abs();
        into.max(out) >= LEAVES
    }
}

/// A contour without a far point.
struct Rest {
    spike: Spike,
    points: Vec<Point>,
    /// Its area, mm2, and its longer side, mm.
    area: f64,
    side: f64,
}

impl Rest {
    fn of(points: &[Point], spike: Spike) -> Self {
        let points: Vec<Point> = points.iter().copied().filter(|point| *point != spike.at).collect();
        let (width, height) = Extent::of(&points).size();
        Self { spike, area: ring::area(&points).abs(), side: width.max(height), points }
    }

    /// True if the far point is none of a part. On a grid of `unit` mm (0 = none) its number may tell.
    fn is_wrong(&self, is_needle: bool, unit: f64) -> bool {
        if is_needle && self.is_small() || self.is_corner() {
            return true;
        }
        let is_far = self.spike.shorter() >= FAR && self.spike.foot() <= FAR_SHARE * self.spike.shorter();
        is_far && (self.stands_out(unit) || has_wrong_digit(self.spike, unit))
    }

    /// True if the point is several times as far off as the rest of the contour is long.
    fn is_longer(&self) -> bool {
        self.spike.shorter() >= LONGER * self.side
    }

    /// True if the spike has a small part of the area: the tip of a strip or of a godet is most of its part, unless it is several
    /// times as long as all the rest.
    fn is_small(&self) -> bool {
        let Spike { before, at, after } = self.spike;
        let base =
            if self.is_longer() { (after - before).norm_squared() } else { ring::area(&[before, at, after]).abs() };
        self.area >= REST * base
    }

    /// True if a far point is a small spike out of the rest of the contour. On a grid of `unit` mm (0 = none) a dart or a slash
    /// leads into its part, and a wrong digit is told by its number.
    fn stands_out(&self, unit: f64) -> bool {
        self.is_small() && (unit <= 0.0 || !ring::contains(&self.points, self.spike.at))
    }

    /// True if the point is a corner of an outline that is moved far away.
    fn is_corner(&self) -> bool {
        self.spike.shorter() >= FAR_CORNER && self.is_longer() && self.area >= CORNER_REST * self.side * self.side
    }
}

/// True if a point would lie between its neighbours with one digit more or less in one coordinate, on a grid of `unit` mm (0 =
/// none). The tip of a dart or a slash has no such number, unless by chance.
fn has_wrong_digit(Spike { before, at, after }: Spike, unit: f64) -> bool {
    if unit <= 0.0 {
        return false;
    }
    let is_wrong = |axis: usize| {
        let [one, other] = [before[axis], after[axis]];
        let is_between = |value: f64| value >= one.min(other) - unit / 2.0 && value <= one.max(other) + unit / 2.0;
        let number = format!("{:.0}", (at[axis] / unit).abs());
        let told = |digits: String| digits.parse::<f64>().is_ok_and(|n| is_between((n * unit).copysign(at[axis])));
        let more = (0..=number.len()).flat_map(|k| (0..10).map(move |digit| (k, digit)));
        let mut more = more.map(|(k, digit)| format!("{}{digit}{}", &number[..k], &number[k..]));
        let mut less = (0..number.len()).map(|k| format!("{}{}", &number[..k], &number[k + 1..]));
        more.any(told) || less.any(told)
    };
    let is_kept = |axis: usize| {
        let [one, other] = [before[axis], after[axis]];
        at[axis] >= one.min(other) && at[axis] <= one.max(other)
    };
    is_kept(0) && is_wrong(1) || is_kept(1) && is_wrong(0)
}
