//! The audit of the reader: what a stitch file or a queue says, decoded a second time, is what is sewn.
//!
//! Stitches may be left out where they are too short, and added on the way to one that is too long; nothing else.

use super::events::{self, Event};
use super::ground::{Ground, Original, sighting};
use super::records;
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;

/// Rounding of sums of increments, mm.
const SUM_EPSILON: f64 = 1e-6;
/// Counts what the file says and is not sewn, and what is sewn and not in it.
pub(super) fn judge(ground: &Ground, worst: &mut WorstByRule) {
    let decoded = match ground.original {
        Original::Dst(bytes) => records::dst(bytes).ok().as_ref().map(events::of_records),
        Original::Exp(bytes) => records::exp(bytes).ok().as_ref().map(events::of_records),
        Original::Queue(bytes) => events::of_queue(bytes),
        Original::Other => return,
    };
    worst.count(&rules::SOURCE, 0, None);
    match decoded {
        Some(asked) => Audit { least: ground.sewing.min_pitch_mm, worst }.judge(&asked, &events::sewn(ground.stitches)),
        None => worst.see(&rules::SOURCE, f64::INFINITY, None),
    }
}

struct Audit<'w> {
    /// The shortest stitch that is no fault, mm.
    least: f64,
    worst: &'w mut WorstByRule,
}

/// A needle point that is sewn, and its entry.
type Sewn = (Point, u32);

impl Audit<'_> {
    /// Run by run, and what lies between.
    fn judge(&mut self, mut asked: &[Event], mut sewn: &[(Event, u32)]) {
        let mut needle = Point::origin();
        while !asked.is_empty() || !sewn.is_empty() {
            let places: Vec<Point> = asked.iter().map_while(stitch).collect();
            let made: Vec<Sewn> = sewn.iter().map_while(|(event, entry)| Some((stitch(event)?, *entry))).collect();
            self.run(&places, &made, needle);
            needle = places.last().copied().unwrap_or(needle);
            (asked, sewn) = (&asked[places.len()..], &sewn[made.len()..]);
            let (wanted, found) = (asked.first(), sewn.first());
            if let Some(Event::Jump(place)) = wanted {
                needle = *place;
            }
            let is_other = !alike(wanted, found.map(|(event, _)| event));
            self.worst.count(&rules::SOURCE, usize::from(is_other), found.map(|&(_, entry)| sighting(entry, needle)));
            (asked, sewn) = (asked.get(1..).unwrap_or_default(), sewn.get(1..).unwrap_or_default());
        }
    }

    /// The stitches of a run, from where the needle stands before it.
    fn run(&mut self, asked: &[Point], mut sewn: &[Sewn], needle: Point) {
        let mut last = needle;
        for (i, &place) in asked.iter().enumerate() {
            if let Some(parts) = parts(sewn, last, place) {
                sewn = &sewn[parts + 1..];
                last = place;
                continue;
            }
            let is_near = |other: Point, reach: f64| (place - other).norm() <= reach + SUM_EPSILON;
            // The end itself is sewn, if only by the stitch before that is there already.
            let is_short = match asked.last() {
                Some(&end) if i + 1 < asked.len() => is_near(last, self.least) || is_near(end, self.least),
                Some(_) | None => is_near(last, 0.0),
            };
            self.worst.count(&rules::SOURCE, usize::from(!is_short), sighting(0, place));
        }
        for &(point, entry) in sewn {
            self.worst.count(&rules::SOURCE, 1, sighting(entry, point));
        }
    }
}

fn stitch(event: &Event) -> Option<Point> {
    match event {
        Event::Stitch(place) => Some(*place),
        Event::Jump(_) | Event::Trim | Event::Stop | Event::Thread(_) => None,
    }
}

/// Whether what is sewn is what is asked for.
fn alike(asked: Option<&Event>, sewn: Option<&Event>) -> bool {
    match (asked, sewn) {
        (Some(Event::Jump(a)), Some(Event::Jump(b))) => (a - b).norm() <= SUM_EPSILON,
        (asked, sewn) => asked == sewn,
    }
}

/// How many stitches lie on the way to a place before the one that is there; `None` when there is none.
fn parts(sewn: &[Sewn], from: Point, to: Point) -> Option<usize> {
    let mut at = 0.0;
    for (count, &(point, _)) in sewn.iter().enumerate() {
        if (point - to).norm() <= SUM_EPSILON {
            return Some(count);
        }
        let (gone, left) = ((point - from).norm(), (to - point).norm());
        // Straight on, and never back.
        if gone + left > (to - from).norm() + SUM_EPSILON || gone < at {
            return None;
        }
        at = gone;
    }
    None
}
