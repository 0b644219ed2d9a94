//! The audit of the reader: a stitch file or a queue is decoded a second time and compared with the sewn stitches.
//!
//! Only two differences are permitted: stitches that are too short may be omitted, and stitches may be added on the way to one
//! that is too long.

use super::events::{self, Event};
use super::ground::{Ground, Original, sighting};
use super::placed;
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;

/// Rounding of sums of increments, mm.
const SUM_EPSILON: f64 = 1e-6;
/// Counts the differences between the file and the sewn stitches, in both directions.
pub(super) fn judge(ground: &Ground, worst: &mut WorstByRule) {
    let decoded = match ground.original {
        Original::File(bytes, decode) => decode(bytes).ok().as_ref().map(events::of_records),
        Original::Queue(bytes) => events::of_queue(bytes),
        Original::Other => return,
    };
    worst.count(&rules::SOURCE, 0, None);
    match decoded {
        Some(asked) => {
            let asked = placed::events(asked, ground.profile);
            Audit { least: ground.sewing.min_pitch_mm, worst }.judge(&asked, &events::sewn(ground.stitches));
        }
        None => worst.see(&rules::SOURCE, f64::INFINITY, None),
    }
}

struct Audit<'w> {
    /// Minimum length of a stitch; shorter ones may be omitted, mm.
    least: f64,
    worst: &'w mut WorstByRule,
}

/// A sewn needle point, and its entry.
type Sewn = (Point, u32);

impl Audit<'_> {
    /// Compares run by run, and the events between the runs.
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

    /// Compares the stitches of a run; `needle` is the needle position before it.
    fn run(&mut self, asked: &[Point], mut sewn: &[Sewn], needle: Point) {
        let mut last = needle;
        for (i, &place) in asked.iter().enumerate() {
            if let Some(parts) = parts(sewn, last, place) {
                sewn = &sewn[parts + 1..];
                last = place;
                continue;
            }
            let is_near = |other: Point, reach: f64| (place - other).norm() <= reach + SUM_EPSILON;
            // The end of a run must be sewn, unless the stitch before it is at the same point.
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

/// True if two events are equal.
fn alike(asked: Option<&Event>, sewn: Option<&Event>) -> bool {
    match (asked, sewn) {
        (Some(Event::Jump(a)), Some(Event::Jump(b))) => (a - b).norm() <= SUM_EPSILON,
        (asked, sewn) => asked == sewn,
    }
}

/// Number of stitches on the way to a point before the one at the point; `None` if there is none.
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
