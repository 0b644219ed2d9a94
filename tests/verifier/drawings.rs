//! Programs of a marker that is not the one asked for: each is sound by itself.

use cutc::geom::{Point, Vector, angle, left, polyline};
use cutc::ir::Marker;
use cutc::ir::list::{FULL_SPEED, Joint, Segment};
use cutc::ir::marker::{Contour, Drill, Notch, Piece};
use cutc::source::Span;

use crate::case::{self, Case};
use crate::rows::pick;
use crate::{Damage, damage};

const COMPLETE: &[&str] = &["verify/complete"];
const OFF: &[&str] = &["verify/on-path", "verify/complete"];
const ONCE: &[&str] = &["verify/once"];
const STRAY: &[&str] = &["verify/stray"];
const DRILLS: &[&str] = &["verify/drills"];

/// Stretch that is left uncut, mm.
const UNCUT: f64 = 1.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a contour left out", COMPLETE, |case, rng| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        edited(case, |marker| {
            let _ = marker.pieces[piece].contours.remove(contour);
        })
    }),
    damage("a piece left out", COMPLETE, |case, rng| {
        let piece = rng.usize(0..case.marker.pieces.len());
        edited(case, |marker| drop(marker.pieces.remove(piece)))
    }),
    damage("a slit left out", COMPLETE, |case, rng| {
        let (piece, notch) = pick(rng, &notches(&case.marker))?;
        edited(case, |marker| {
            let _ = marker.pieces[piece].notches.remove(notch);
        })
    }),
    damage("a slit too short", COMPLETE, |case, rng| slit(case, rng, |n| n.tip -= along(n) * UNCUT)),
    damage("a slit too long", STRAY, |case, rng| slit(case, rng, |n| n.tip += along(n) * 5.0)),
    damage("a slit beside its place", OFF, |case, rng| {
        let aside = 3.0 * case.tolerance() + WIDER;
        slit(case, rng, |n| {
            let by = left(along(n)) * aside;
            (n.root, n.tip) = (n.root + by, n.tip + by);
        })
    }),
    damage("a slit aslant", OFF, |case, rng| {
        let aside = 3.0 * case.tolerance() + WIDER;
        slit(case, rng, |n| n.tip += left(along(n)) * aside)
    }),
    damage("1 mm uncut at a start", COMPLETE, |case, rng| {
        let reach = UNCUT + case.job.profile.knife.heel_overlap_mm;
        gap(case, rng, |case, segments, i| turn(segments, i) > case.job.profile.corner.angle(), |_| [0.0, reach])
    }),
    damage("1 mm uncut at an end", COMPLETE, |case, rng| {
        let reach = UNCUT + case.job.profile.knife.front_overlap_mm;
        let at_end =
            |case: &Case, segments: &[Segment], i: usize| turn(segments, i + 1) > case.job.profile.corner.angle();
        gap(case, rng, at_end, |length| [length - reach, length])
    }),
    damage("1 mm uncut amid a line", COMPLETE, |case, rng| {
        let knife = &case.job.profile.knife;
        let reach = UNCUT + knife.heel_overlap_mm + knife.front_overlap_mm;
        gap(case, rng, |_, _, _| true, |length| [0.5 * (length - reach), 0.5 * (length + reach)])
    }),
    damage("a corner cut off", OFF, |case, rng| {
        let aside = 3.0 * case.tolerance() + WIDER;
        let sharp = |w: [Point; 3]| polyline::distance_to_segment(w[1], w[0], w[2]) > aside;
        vertex(case, rng, sharp, |points, i| {
            let _ = points.remove(i);
        })
    }),
    damage("a vertex beside its place", OFF, |case, rng| {
        let aside = 3.0 * case.tolerance() + WIDER;
        vertex(
            case,
            rng,
            |_| true,
            |points, i| {
                let along = (points[i + 1] - points[i - 1]).normalize();
                points[i] += left(along) * aside;
            },
        )
    }),
    damage("a chord that bulges", OFF, |case, rng| {
        let aside = 3.0 * case.tolerance() + WIDER;
        vertex(
            case,
            rng,
            |w| (w[1] - w[0]).norm() > 2.0,
            |points, i| {
                let (a, b) = (points[i - 1], points[i]);
                points.insert(i, midpoint(a, b) + left((b - a).normalize()) * aside);
            },
        )
    }),
    damage("a piece shifted", OFF, |case, rng| {
        let piece = rng.usize(0..case.marker.pieces.len());
        let by = Vector::new(3.0 * case.tolerance() + WIDER, 0.0);
        edited(case, |marker| {
            let moved = mapped(marker, |i, p| if i == piece { p + by } else { p });
            *marker = moved;
        })
    }),
    damage("everything shifted", OFF, |case, _| {
        let by = 3.0 * case.tolerance() + WIDER;
        Some(all(case, |p| p + Vector::new(by, by)))
    }),
    damage("everything turned a little", OFF, |case, _| {
        let extent = case.marker.extent();
        let centre = midpoint(extent.min, extent.max);
        let angle = 6.0 * (3.0 * case.tolerance() + WIDER) / (extent.max - extent.min).norm();
        Some(all(case, |p| p + left(p - centre) * angle))
    }),
    damage("X a little too long", OFF, |case, _| {
        let extent = case.marker.extent();
        let share = 2.0 * (3.0 * case.tolerance() + WIDER) / (extent.max.x - extent.min.x);
        Some(all(case, |p| Point::new(p.x + (p.x - extent.min.x) * share, p.y)))
    }),
    damage("Y a little too short", OFF, |case, _| {
        let extent = case.marker.extent();
        let share = 2.0 * (3.0 * case.tolerance() + WIDER) / (extent.max.y - extent.min.y);
        Some(all(case, |p| Point::new(p.x, p.y - (p.y - extent.min.y) * share)))
    }),
    damage("inches for centimetres", COMPLETE, |case, _| Some(all(case, |p| p * 2.54))),
    damage("mirrored", COMPLETE, |case, _| {
        let extent = case.marker.extent();
        Some(all(case, |p| Point::new(extent.min.x + extent.max.x - p.x + 5.0, p.y)))
    }),
    damage("X and Y exchanged", COMPLETE, |case, _| Some(all(case, |p| Point::new(p.y, p.x + 5.0)))),
    damage("another marker", COMPLETE, |case, _| {
        let others = case::names();
        let place = others.iter().position(|&name| name == case.name).expect("a case has a name");
        Some(case.redrawn(&case::marker(others[(place + 1) % others.len()], &case.job)))
    }),
    damage("off the table", &["verify/table"], |case, _| Some(all(case, |p| p - Vector::new(300.0, 300.0)))),
    damage("a contour cut twice", ONCE, |case, rng| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        edited(case, |marker| {
            let again = marker.pieces[piece].contours[contour];
            marker.pieces[piece].contours.insert(contour, again);
        })
    }),
    damage("a contour cut there and back", ONCE, |case, rng| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        edited(case, |marker| {
            let again = marker.pieces[piece].contours[contour];
            marker.pieces[piece].contours.insert(contour, Contour { range: again.range.reversed(), ..again });
        })
    }),
    damage("a slit cut twice", ONCE, |case, rng| {
        let (piece, notch) = pick(rng, &notches(&case.marker))?;
        edited(case, |marker| {
            let again = marker.pieces[piece].notches[notch];
            marker.pieces[piece].notches.insert(notch, again);
        })
    }),
    damage("a cut that is in no marker", STRAY, |case, _| {
        let from = case.marker.extent().max + Vector::new(20.0, 20.0);
        edited(case, |marker| add(marker, &[from, from + Vector::new(30.0, 5.0)]))
    }),
    damage("a cut beside a line", &["verify/on-path", "verify/stray"], |case, rng| {
        let segment = pick(rng, &long_segments(&case.marker, 6.0))?;
        let aside = left((segment.to - segment.from).normalize());
        edited(case, |marker| add(marker, &[segment.from + aside, segment.to + aside]))
    }),
    damage("a cut across a line", &["verify/on-path", "verify/stray"], |case, rng| {
        let segment = pick(rng, &long_segments(&case.marker, 6.0))?;
        let middle = midpoint(segment.from, segment.to);
        let aside = left((segment.to - segment.from).normalize()) * 12.0;
        edited(case, |marker| add(marker, &[middle - aside, middle + aside]))
    }),
    damage("a line cut on beyond its end", STRAY, |case, rng| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        let corners: Vec<usize> =
            (0..segments.len()).filter(|&i| turn(&segments, i + 1) > 1.2 && segments[i].length() > 8.0).collect();
        let i = pick(rng, &corners)?;
        let on = (segments[i].to - segments[i].from).normalize() * 15.0;
        let mut longer: Vec<Segment> = segments[i + 1..].iter().chain(&segments[..=i]).copied().collect();
        let last = longer.last_mut().expect("a contour has segments");
        last.to += on;
        edited(case, |marker| redraw(marker, piece, contour, longer.clone()))
    }),
    damage("pieces in another order", &["verify/order"], |case, _| {
        (case.marker.pieces.len() > 1).then(|| edited(case, |marker| marker.pieces.swap(0, 1)))?
    }),
    damage("contours in another order", &["verify/order"], |case, rng| {
        let several: Vec<usize> =
            (0..case.marker.pieces.len()).filter(|&i| case.marker.pieces[i].contours.len() > 1).collect();
        let piece = pick(rng, &several)?;
        edited(case, |marker| marker.pieces[piece].contours.reverse())
    }),
    damage("a hole left out", DRILLS, |case, rng| {
        drill(case, rng, |drills, i| {
            let _ = drills.remove(i);
        })
    }),
    damage("a hole too many", DRILLS, |case, rng| {
        drill(case, rng, |drills, i| drills.push(Drill { at: drills[i].at + Vector::new(15.0, 8.0), ..drills[i] }))
    }),
    damage("a hole beside its place", &["verify/drill-place"], |case, rng| {
        drill(case, rng, |drills, i| drills[i].at += Vector::new(0.02, 0.0))
    }),
    damage("a hole far from its place", DRILLS, |case, rng| {
        drill(case, rng, |drills, i| drills[i].at += Vector::new(18.0, 0.0))
    }),
    damage("a hole of another drill", DRILLS, |case, rng| {
        drill(case, rng, |drills, i| drills[i].tool = 5 - drills[i].tool)
    }),
];

/// What the tube may be wider than its tolerance, on a curve that was flattened, mm.
const WIDER: f64 = 0.2;

/// The program of a changed marker.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn edited(case: &Case, change: impl FnOnce(&mut Marker)) -> Option<Vec<u8>> {
    let mut marker = case.marker.clone();
    change(&mut marker);
    Some(case.redrawn(&marker))
}

/// The program of a marker whose every point is another.
fn all(case: &Case, map: impl Fn(Point) -> Point) -> Vec<u8> {
    case.redrawn(&mapped(&case.marker, |_, point| map(point)))
}

fn mapped(marker: &Marker, map: impl Fn(usize, Point) -> Point) -> Marker {
    let mut mapped = marker.clone();
    for (piece, contour) in contours(marker) {
        let segments = chain(marker, marker.pieces[piece].contours[contour]).into_iter();
        let moved = segments.map(|s| Segment { from: map(piece, s.from), to: map(piece, s.to), ..s }).collect();
        redraw(&mut mapped, piece, contour, moved);
    }
    for (i, piece) in mapped.pieces.iter_mut().enumerate() {
        for notch in &mut piece.notches {
            (notch.root, notch.tip) = (map(i, notch.root), map(i, notch.tip));
        }
        piece.drills.iter_mut().for_each(|drill| drill.at = map(i, drill.at));
    }
    mapped
}

/// All contours: the index of the piece, and among its contours.
fn contours(marker: &Marker) -> Vec<(usize, usize)> {
    indices(marker, |piece| piece.contours.len())
}

fn notches(marker: &Marker) -> Vec<(usize, usize)> {
    indices(marker, |piece| piece.notches.len())
}

fn indices(marker: &Marker, count: impl Fn(&Piece) -> usize) -> Vec<(usize, usize)> {
    marker.pieces.iter().enumerate().flat_map(|(i, piece)| (0..count(piece)).map(move |k| (i, k))).collect()
}

fn chain(marker: &Marker, contour: Contour) -> Vec<Segment> {
    marker.list.walk(contour.range).map(|(_, segment)| segment).collect()
}

fn redraw(marker: &mut Marker, piece: usize, contour: usize, segments: Vec<Segment>) {
    let closed = segments[0].from == segments[segments.len() - 1].to;
    let range = marker.list.append(segments).expect("a contour has segments");
    marker.pieces[piece].contours[contour] = Contour { range, closed };
}

/// Adds an open contour to the last piece.
fn add(marker: &mut Marker, points: &[Point]) {
    let segment = |w: &[Point]| Segment {
        from: w[0],
        to: w[1],
        span: Span::default(),
        joint: Joint::default(),
        percent: FULL_SPEED,
    };
    let range = marker.list.append(points.windows(2).map(segment)).expect("two points or more");
    let last = marker.pieces.last_mut().expect("a marker has pieces");
    last.contours.push(Contour { range, closed: false });
}

fn along(notch: &Notch) -> Vector {
    (notch.tip - notch.root).normalize()
}

/// Changes one slit.
fn slit(case: &Case, rng: &mut fastrand::Rng, change: impl FnOnce(&mut Notch)) -> Option<Vec<u8>> {
    let (piece, notch) = pick(rng, &notches(&case.marker))?;
    edited(case, |marker| change(&mut marker.pieces[piece].notches[notch]))
}

/// Changes the holes of a piece.
fn drill(case: &Case, rng: &mut fastrand::Rng, change: impl FnOnce(&mut Vec<Drill>, usize)) -> Option<Vec<u8>> {
    let (piece, drill) = pick(rng, &indices(&case.marker, |piece| piece.drills.len()))?;
    edited(case, |marker| change(&mut marker.pieces[piece].drills, drill))
}

/// Absolute turn of a closed contour where a segment starts, rad.
fn turn(segments: &[Segment], i: usize) -> f64 {
    let count = segments.len();
    let (before, behind) = (&segments[(i + count - 1) % count], &segments[i % count]);
    angle::turn(before.to - before.from, behind.to - behind.from).abs()
}

fn long_segments(marker: &Marker, least: f64) -> Vec<Segment> {
    let all = marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range));
    all.map(|(_, segment)| segment).filter(|segment| segment.length() > least).collect()
}

/// Leaves a stretch of one segment of a closed contour out: it then is an open contour.
fn gap(
    case: &Case,
    rng: &mut fastrand::Rng,
    fits: impl Fn(&Case, &[Segment], usize) -> bool,
    out: impl Fn(f64) -> [f64; 2],
) -> Option<Vec<u8>> {
    let mut places = Vec::new();
    for (piece, contour) in contours(&case.marker) {
        let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        if case.marker.pieces[piece].contours[contour].closed {
            // Beside a short line between corners the blade, which is longer, would cut the gap with its body.
            let smooth = (0..segments.len()).all(|i| turn(&segments, i) < case.job.profile.corner.angle());
            let least = if smooth { 4.0 } else { 3.0 * case.job.profile.knife.width_mm };
            let long = (0..segments.len()).filter(|&i| segments[i].length() > least && fits(case, &segments, i));
            places.extend(long.map(|i| (piece, contour, i)));
        }
    }
    let (piece, contour, i) = pick(rng, &places)?;
    let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
    let whole = segments[i];
    let along = (whole.to - whole.from) / whole.length();
    let [from, to] = out(whole.length());
    let mut open = Vec::new();
    if to < whole.length() {
        open.push(Segment { from: whole.from + along * to, joint: Joint::default(), ..whole });
    }
    open.extend(segments[i + 1..].iter().chain(&segments[..i]));
    if from > 0.0 {
        open.push(Segment { to: whole.from + along * from, ..whole });
    }
    edited(case, |marker| redraw(marker, piece, contour, open))
}

/// Changes one inner vertex of a contour that fits.
fn vertex(
    case: &Case,
    rng: &mut fastrand::Rng,
    fits: impl Fn([Point; 3]) -> bool,
    change: impl FnOnce(&mut Vec<Point>, usize),
) -> Option<Vec<u8>> {
    let mut places = Vec::new();
    for (piece, contour) in contours(&case.marker) {
        let points = case.marker.points(&case.marker.pieces[piece].contours[contour]);
        let fitting = (1..points.len() - 1).filter(|&i| fits([points[i - 1], points[i], points[i + 1]]));
        places.extend(fitting.map(|i| (piece, contour, i)));
    }
    let (piece, contour, i) = pick(rng, &places)?;
    let old = case.marker.pieces[piece].contours[contour];
    let segments = chain(&case.marker, old);
    let mut points = case.marker.points(&old);
    change(&mut points, i);
    let span_of = |k: usize| segments[k.min(segments.len() - 1)];
    let redrawn = points.windows(2).enumerate().map(|(k, w)| Segment { from: w[0], to: w[1], ..span_of(k) }).collect();
    edited(case, |marker| redraw(marker, piece, contour, redrawn))
}

fn midpoint(a: Point, b: Point) -> Point {
    a + (b - a) * 0.5
}
