//! Damage to what rows say beside poses and outputs, and to the order of holes.

use cutc::geom::ring;
use cutc::ir::marker::{Contour, Piece};

use crate::verifier::case::Case;
use crate::verifier::harm::Harm;
use crate::verifier::measure::{DAMAGING, SAME};
use crate::verifier::rows::{Row, holes, pick, print, strokes, travels};
use crate::verifier::sketch::edited;
use crate::verifier::{Damage, damage};

const BLOCK: &str = "verify/block";
const EVENTS: &str = "verify/events";

/// How far beside its chord a block may be named, mm, when the tolerance is that of files in a tenth of a millimetre.
const NAME_REACH: f64 = 0.6;
/// No marker has so many blocks.
const NO_BLOCK: u32 = 999_999;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a stroke under a block that no cut has", BLOCK, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        named(case, |i, block| if stroke.contains(&i) { NO_BLOCK } else { block })
    }),
    damage("one row under a block that no cut has", BLOCK, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let row = rng.usize(stroke);
        named(case, |i, block| if i == row { NO_BLOCK } else { block })
    }),
    damage("a stroke without its block", BLOCK, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        named(case, |i, block| if stroke.contains(&i) { 0 } else { block })
    }),
    damage("the blocks of two strokes exchanged", BLOCK, |case, _| {
        let blocks = |stroke: &std::ops::Range<usize>| case.rows[stroke.start].block;
        let strokes = strokes(&case.rows);
        let (first, last) = (strokes.first()?, strokes.last()?);
        let (a, b) = (blocks(first), blocks(last));
        let other = |i: usize, block| match (first.contains(&i), last.contains(&i)) {
            (true, _) => b,
            (_, true) => a,
            (false, false) => block,
        };
        (a != b).then(|| named(case, other))?
    }),
    damage("a block in the air", BLOCK, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        named(case, |i, block| if i == stroke.end + 1 { case.rows[stroke.start].block } else { block })
    }),
    damage("a stop that nobody asked for", "verify/events", |case, rng| {
        let mut rows = case.rows.clone();
        let i = rng.usize(0..rows.len());
        rows[i].event = 1;
        Some(one(print(&rows)))
    }),
    damage("an advance while the knife is down", "verify/events", |case, rng| {
        let mut rows = case.rows.clone();
        rows[pick(rng, &strokes(&case.rows))?.start].event = 2;
        Some(one(print(&rows)))
    }),
    damage("an event left out", EVENTS, |case, rng| told(case, rng, |rows, i| rows[i].event = 0)),
    damage("an event of the other kind", EVENTS, |case, rng| {
        told(case, rng, |rows, i| rows[i].event = 3 - rows[i].event)
    }),
    damage("an event told for two periods", EVENTS, |case, rng| {
        told(case, rng, |rows, i| rows[i + 1].event = rows[i].event)
    }),
    damage("an event behind the next stroke", "verify/order", |case, _| {
        let mut rows = case.rows.clone();
        let told = (0..rows.len()).find(|&i| rows[i].event != 0)?;
        let behind = strokes(&rows).into_iter().find(|stroke| stroke.start > told)?.end;
        let rest = (behind + 1..rows.len()).find(|&i| rows[i].knife == 0 && rows[i - 1].pose == rows[i].pose)?;
        (rows[rest].event, rows[told].event) = (rows[told].event, 0);
        Some(one(print(&rows)))
    }),
    damage("an event on the move", "verify/rest", |case, rng| {
        let mut rows = case.rows.clone();
        let events: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].event != 0).collect();
        let told = pick(rng, &events)?;
        let travel = travels(&rows).into_iter().rev().find(|travel| travel.end <= told + 1)?;
        let moving = travel.start + travel.len() / 2;
        let moved = rows[moving].away(&rows[moving + 1]);
        (rows[moving].event, rows[told].event) = (rows[told].event, 0);
        (moved > DAMAGING * SAME).then(|| Harm::anywhere(print(&rows), DAMAGING * SAME))
    }),
    damage("a drill that is on at the start", "verify/drills", |case, _| {
        let mut rows = case.rows.clone();
        rows[0].drill = 1;
        Some(one(print(&rows)))
    }),
    damage("holes in another order", "verify/order", |case, _| {
        let piece = case.marker.pieces.iter().position(|piece| piece.drills.len() > 1)?;
        let mut marker = case.marker.clone();
        marker.pieces[piece].drills.reverse();
        Some(one(case.redrawn(&marker)))
    }),
    damage("holes behind the cuts", "verify/order", |case, _| {
        // The marker of a later piece has the holes, of the same file otherwise.
        let mut marker = case.marker.clone();
        let last = marker.pieces.len().checked_sub(1).filter(|&last| last > 0)?;
        let drills = std::mem::take(&mut marker.pieces[0].drills);
        let first = drills.first().copied()?;
        marker.pieces[last].drills.push(first);
        marker.pieces[0].drills = drills[1..].to_vec();
        (!holes(&case.rows).is_empty()).then(|| one(case.redrawn(&marker)))
    }),
    damage("slits of a part that is cut already", "verify/freed", |case, _| {
        let last = case.marker.pieces.len().checked_sub(1).filter(|&last| last > 0)?;
        let notch = *case.marker.pieces[0].notches.first()?;
        Some(one(edited(case, |marker| {
            marker.pieces[0].notches.remove(0);
            marker.pieces[last].notches.push(notch);
        })))
    }),
    damage("cut-outs of a part that is cut already", "verify/freed", |case, _| {
        let points = |contour: &Contour| case.marker.points(contour);
        let has_cut_out = |piece: &Piece| match &piece.contours[..] {
            [inner, .., outline] => ring::contains(&points(outline), points(inner)[0]),
            _ => false,
        };
        let piece = case.marker.pieces.iter().position(has_cut_out)?;
        Some(one(edited(case, |marker| marker.pieces[piece].contours.reverse())))
    }),
];

/// The program with other blocks.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn named(case: &Case, block: impl Fn(usize, u32) -> u32) -> Option<Harm> {
    let mut rows = case.rows.clone();
    rows.iter_mut().enumerate().for_each(|(i, row)| row.block = block(i, row.block));
    Some(Harm::anywhere(print(&rows), DAMAGING * NAME_REACH))
}

/// The program in which the row of an event, or those about it, are changed.
fn told(case: &Case, rng: &mut fastrand::Rng, change: impl FnOnce(&mut [Row], usize)) -> Option<Harm> {
    let mut rows = case.rows.clone();
    let events: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].event != 0).collect();
    change(&mut rows, pick(rng, &events)?);
    Some(one(print(&rows)))
}

/// A program with one thing too many or in the wrong place.
fn one(program: Vec<u8>) -> Harm {
    Harm::anywhere(program, 1.0)
}
