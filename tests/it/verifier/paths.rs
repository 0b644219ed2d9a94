//! Programs of a marker of another shape than the one asked for: each is sound by itself.

use std::ops::Range;

use cutc::geom::{Point, Vector, left, polyline};
use cutc::ir::list::Segment;

use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{DAMAGING, SAME};
use crate::verifier::rows::{self, Row, pick};
use crate::verifier::sketch::{
    add, all, along, chain, contours, edited, longest, mapped, midpoint, redraw, segments, slit, turn,
};
use crate::verifier::{Damage, damage, scaled};

const ON_PATH: &str = "verify/on-path";
const COMPLETE: &str = "verify/complete";

/// Rounding that a place of the table may have, mm.
const PLACE_ROUNDING: f64 = 2.0 * SAME;
/// What a drawing in inches is too large by, when it is read in centimetres.
const CM_PER_INCH: f64 = 2.54;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a slit beside its place", COMPLETE, |case, rng| {
        let aside = DAMAGING * case.tolerance() + PLACE_ROUNDING;
        let (old, program) = slit(case, rng, |n| {
            let by = left(along(n)) * aside;
            (n.root, n.tip) = (n.root + by, n.tip + by);
        })?;
        // The whole of it lies beside what was cut.
        Some(Harm { program, amount: old.depth() - SAME, place: Place::Along(vec![old.root, old.tip]) })
    }),
    damage("a slit aslant", COMPLETE, |case, rng| {
        let aside = DAMAGING * case.tolerance() + PLACE_ROUNDING;
        let (old, program) = slit(case, rng, |n| n.tip += left(along(n)) * aside)?;
        // It is cut as far as it lies within the tolerance, a third; a quarter more is for the finite steps of the body.
        let amount = old.depth() * (1.0 - 1.25 / DAMAGING);
        Some(Harm { program, amount, place: Place::Along(vec![old.root, old.tip]) })
    }),
    damage("a curve cut short", ON_PATH, |case, rng| {
        // The fewest vertices in a row that a chord misses by enough.
        let missed = |points: &[Point], i: usize| {
            let away = |end: usize| {
                let away = |point: &Point| polyline::distance_to_segment(*point, points[i - 1], points[end]);
                points[i..end].iter().map(away).fold(0.0, f64::max)
            };
            (i + 1..points.len()).find(|end| away(*end) > aside(case, DAMAGING)).map(|end| i..end)
        };
        let change = |points: &mut Vec<Point>, at: Range<usize>| drop(points.drain(at));
        bend(case, rng, (missed, change))
    }),
    damage("a vertex beside its place", ON_PATH, |case, rng| {
        let by = aside(case, DAMAGING);
        let has_room = |points: &[Point], i: usize| {
            let [before, behind] = [points[i] - points[i - 1], points[i + 1] - points[i]];
            (before.norm().min(behind.norm()) > 4.0 * by).then_some(i..i + 1)
        };
        let change = |points: &mut Vec<Point>, at: Range<usize>| {
            let along = (points[at.end] - points[at.start - 1]).normalize();
            points[at.start] += left(along) * by;
        };
        bend(case, rng, (has_room, change))
    }),
    scaled("a line that bends aside", ON_PATH, |case, rng, times| {
        let by = aside(case, times);
        let least = 4.0 * case.job.profile.knife.width_mm;
        let long: Vec<(usize, usize, usize)> = contours(&case.marker)
            .into_iter()
            .flat_map(|(piece, contour)| {
                let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
                let long = (0..segments.len()).filter(|i| segments[*i].length() > least).collect::<Vec<_>>();
                long.into_iter().map(move |i| (piece, contour, i))
            })
            .collect();
        let (piece, contour, i) = pick(rng, &long)?;
        let mut segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        let whole = segments[i];
        let middle = midpoint(whole.from, whole.to) + left((whole.to - whole.from).normalize()) * by;
        segments[i].to = middle;
        segments.insert(i + 1, Segment { from: middle, joint: cutc::ir::list::Joint::default(), ..whole });
        let mut marker = case.marker.clone();
        redraw(&mut marker, [piece, contour], segments);
        let program = case.redrawn_closely(&marker);
        Some(Harm { program, amount: DAMAGING * case.tolerance(), place: Place::Along(vec![whole.from, whole.to]) })
    }),
    damage("a piece shifted", ON_PATH, |case, rng| {
        let piece = rng.usize(0..case.marker.pieces.len());
        let own = case.marker.pieces[piece].contours.iter().flat_map(|contour| chain(&case.marker, *contour));
        let longest = longest(&own.collect::<Vec<_>>())?;
        let by = left((longest.to - longest.from).normalize()) * aside(case, DAMAGING);
        let moved = mapped(&case.marker, |i, p| if i == piece { p + by } else { p });
        let points = case.marker.pieces[piece].contours.iter().flat_map(|contour| case.marker.points(contour));
        let place = Place::Along(points.collect());
        Some(Harm { program: case.redrawn_closely(&moved), amount: DAMAGING * case.tolerance(), place })
    }),
    damage("everything shifted", ON_PATH, |case, _| {
        let longest = longest(&segments(&case.marker))?;
        let by = left((longest.to - longest.from).normalize()) * aside(case, DAMAGING);
        displaced(case, |p| p + by)
    }),
    damage("everything turned a little", ON_PATH, |case, _| {
        // About the middle of the longest line, whose ends then lie aside by the amount, and all else farther.
        let longest = longest(&segments(&case.marker))?;
        let centre = midpoint(longest.from, longest.to);
        let angle = 2.0 * aside(case, DAMAGING) / longest.length();
        displaced(case, |p| p + left(p - centre) * angle)
    }),
    damage("X a little too long", ON_PATH, |case, _| {
        let from = case.marker.extent().min.x;
        let share = aside(case, DAMAGING) / lever(case, |s, normal| normal.x * (midpoint(s.from, s.to).x - from));
        displaced(case, |p| Point::new(p.x + (p.x - from) * share, p.y))
    }),
    damage("Y a little too short", ON_PATH, |case, _| {
        let from = case.marker.extent().min.y;
        let share = aside(case, DAMAGING) / lever(case, |s, normal| normal.y * (midpoint(s.from, s.to).y - from));
        displaced(case, |p| Point::new(p.x, p.y - (p.y - from) * share))
    }),
    damage("inches for centimetres", COMPLETE, |case, _| misread(case, |p| p * CM_PER_INCH)),
    damage("mirrored", COMPLETE, |case, _| {
        let extent = case.marker.extent();
        let aside = aside(case, DAMAGING);
        misread(case, |p| Point::new(extent.min.x + extent.max.x - p.x + aside, p.y))
    }),
    damage("X and Y exchanged", COMPLETE, |case, _| {
        let aside = aside(case, DAMAGING);
        misread(case, |p| Point::new(p.y, p.x + aside))
    }),
    damage("off the table in X", "verify/table", |case, _| off_table(case, 0)),
    damage("off the table in Y", "verify/table", |case, _| off_table(case, 1)),
    damage("a cut beside a line", ON_PATH, |case, rng| {
        let by = aside(case, DAMAGING);
        let width = case.job.profile.knife.width_mm;
        let long: Vec<Segment> = segments(&case.marker).into_iter().filter(|s| s.length() > 2.0 * width).collect();
        let segment = pick(rng, &long)?;
        let aside = left((segment.to - segment.from).normalize()) * by;
        let program = edited(case, |marker| add(marker, &[segment.from + aside, segment.to + aside]));
        Some(Harm { program, amount: DAMAGING * case.tolerance(), place: Place::Along(vec![segment.from, segment.to]) })
    }),
    damage("a cut across a line", ON_PATH, |case, rng| {
        let width = case.job.profile.knife.width_mm;
        let long: Vec<Segment> = segments(&case.marker).into_iter().filter(|s| s.length() > 2.0 * width).collect();
        let segment = pick(rng, &long)?;
        let middle = midpoint(segment.from, segment.to);
        let aside = left((segment.to - segment.from).normalize()) * width;
        let program = edited(case, |marker| add(marker, &[middle - aside, middle + aside]));
        let place = Place::Along(vec![middle - aside, middle + aside]);
        Some(Harm { program, amount: DAMAGING * case.tolerance(), place })
    }),
];

/// How far a line must be drawn beside its place to be some times the tolerance off, mm: its program may lie a third of
/// the tolerance nearer, and the tolerance band of a curve may bulge after it.
fn aside(case: &Case, times: f64) -> f64 {
    let more = if times < 1.0 { 0.0 } else { case.tolerance() + case.job.profile.path.chord_sag_max_mm };
    times * case.tolerance() + more + PLACE_ROUNDING
}

/// The program of a marker whose every point is a little elsewhere.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn displaced(case: &Case, map: impl Fn(Point) -> Point) -> Option<Harm> {
    let program = case.redrawn_closely(&mapped(&case.marker, |_, point| map(point)));
    Some(Harm::anywhere(program, DAMAGING * case.tolerance()))
}

/// The program of a marker that lies elsewhere altogether.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn misread(case: &Case, map: impl Fn(Point) -> Point) -> Option<Harm> {
    Some(Harm::anywhere(all(case, map), DAMAGING * case.job.profile.verify.max_uncut_mm))
}

/// The greatest value of any segment and its normal.
fn lever(case: &Case, value: impl Fn(&Segment, Vector) -> f64) -> f64 {
    let values = segments(&case.marker).into_iter().map(|s| value(&s, left((s.to - s.from).normalize())).abs());
    values.fold(0.0, f64::max)
}

/// A program that is shifted as far as lets its blade leave the table by three times what is allowed.
fn off_table(case: &Case, axis: usize) -> Option<Harm> {
    let knife = &case.job.profile.knife;
    let table = [case.job.profile.table.x_mm, case.job.profile.table.y_mm][axis]?;
    let least = |rows: &[Row]| {
        let places = rows.iter().filter(|row| row.knife == 1).flat_map(|row| [row.tip(knife), row.tail(knife)]);
        places.map(|place| [place.x, place.y][axis]).fold(f64::INFINITY, f64::min)
    };
    let amount = DAMAGING * (cutc::machine::Table::EDGE_MM + PLACE_ROUNDING);
    let mut by = [0.0; 2];
    by[axis] = table[0] - least(&case.rows) - amount - PLACE_ROUNDING;
    let program = all(case, |p| p + Vector::new(by[0], by[1]));
    // It is planned anew where it lies now: its ticks fall on other places, and its own rows say how far off it is.
    let off = table[0] - least(&rows::parse(&program));
    Some(Harm::anywhere(program, off))
}

/// Changes inner vertices of a contour, none of them a corner: those that are found from one of them.
fn bend(
    case: &Case,
    rng: &mut fastrand::Rng,
    (find, change): (impl Fn(&[Point], usize) -> Option<Range<usize>>, impl FnOnce(&mut Vec<Point>, Range<usize>)),
) -> Option<Harm> {
    let mut places = Vec::new();
    for (piece, contour) in contours(&case.marker) {
        let old = case.marker.pieces[piece].contours[contour];
        let (points, segments) = (case.marker.points(&old), chain(&case.marker, old));
        let is_bend = |i: usize| turn(&segments, i) < case.job.profile.corner_angle();
        let found = (1..points.len() - 1).filter_map(|i| find(&points, i)).filter(|at| at.clone().all(is_bend));
        places.extend(found.map(|at| ([piece, contour], at)));
    }
    let ([piece, contour], at) = pick(rng, &places)?;
    let old = case.marker.pieces[piece].contours[contour];
    let segments = chain(&case.marker, old);
    let mut points = case.marker.points(&old);
    let place = Place::Along(points[at.start - 1..=at.end].to_vec());
    change(&mut points, at);
    let span_of = |k: usize| segments[k.min(segments.len() - 1)];
    let redrawn = points.windows(2).enumerate().map(|(k, w)| Segment { from: w[0], to: w[1], ..span_of(k) }).collect();
    let mut marker = case.marker.clone();
    redraw(&mut marker, [piece, contour], redrawn);
    Some(Harm { program: case.redrawn_closely(&marker), amount: DAMAGING * case.tolerance(), place })
}
