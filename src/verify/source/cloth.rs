//! Displacement of a drawing by cloth that wanders on its conveyor. It is read again from the bytes of the centre line and
//! computed by other means than in the pass that moves the marker.

use crate::geom::Point;
use crate::ir::list::{Joint, Segment};
use crate::machine::Job;

/// Rounding error of positions along the feed, mm: the cloth does not displace places in that direction.
const ALONG_EPSILON: f64 = 1e-6;

/// Centre line of a cloth: rows of a position along the feed and the offset of the centre across, mm.
#[derive(Debug, Clone)]
pub(super) struct Cloth(Vec<[f64; 2]>);

impl Cloth {
    /// Cloth of a job; `None` for a cloth in the middle of the conveyor.
    pub(super) fn of(job: &Job) -> Option<Self> {
        let centre = job.centre.as_ref()?;
        let bytes = centre.source.bytes();
        let row = |line: &[u8]| {
            let comma = line.iter().position(|&byte| byte == b',')?;
            let number = |text: &[u8]| std::str::from_utf8(text).ok()?.trim().parse::<f64>().ok();
            Some([number(&line[..comma])?, number(&line[comma + 1..])?])
        };
        let mut rows: Vec<[f64; 2]> = bytes.split(|&byte| byte == b'\n').filter_map(row).collect();
        if let Some(rulers) = centre.rulers {
            // The conveyor position increases while the X under the rulers decreases.
            for row in &mut rows {
                row[0] = rulers - row[0];
            }
            rows.reverse();
        }
        Some(Self(rows))
    }

    /// Displacement of the cloth across at a position along the feed, mm; NaN without rows.
    fn across(&self, x: f64) -> f64 {
        let Self(rows) = self;
        let [[start, first], .., [end, last]] = rows[..] else { return f64::NAN };
        if x <= start {
            return first;
        }
        if x >= end {
            return last;
        }
        let (mut low, mut high) = (0, rows.len() - 1);
        while high - low > 1 {
            let middle = low.midpoint(high);
            if rows[middle][0] > x { high = middle } else { low = middle }
        }
        let ([a, from], [b, to]) = (rows[low], rows[high]);
        (from * (b - x) + to * (x - a)) / (b - a)
    }

    /// Point displaced with the cloth.
    pub(super) fn carried(&self, at: Point) -> Point {
        Point::new(at.x, at.y + self.across(at.x))
    }

    /// Distance of a point from the displaced line between two places, mm.
    fn off([from, to]: [Point; 2], at: Point, across: f64) -> f64 {
        let x = at.x.clamp(from.x.min(to.x), from.x.max(to.x));
        let share = if (to.x - from.x).abs() > ALONG_EPSILON { (x - from.x) / (to.x - from.x) } else { return 0.0 };
        (at.x - x).hypot(at.y - (from.y + (to.y - from.y) * share + across))
    }

    /// Greatest distance of a stroke from the displaced line between two places, mm, at its ends and at each bend of the centre
    /// line.
    fn astray(&self, line: [Point; 2], [from, to]: [Point; 2]) -> f64 {
        let Self(rows) = self;
        let ends = [from, to].map(|at| Self::off(line, at, self.across(at.x)));
        let [least, most] = [from.x.min(to.x), from.x.max(to.x)];
        let start = rows.partition_point(|[x, _]| *x <= least);
        let bends = rows[start..].iter().take_while(|[x, _]| *x < most).map(|[x, across]| {
            let y = from.y + (to.y - from.y) * ((x - from.x) / (to.x - from.x));
            Self::off(line, Point::new(*x, y), *across)
        });
        ends.into_iter().chain(bends).fold(0.0, worse)
    }

    /// Greatest distance of a line of the sheet from its parts, mm. The parts come first in `parts` and are consumed. Infinite
    /// if the parts do not belong to the line.
    pub(super) fn parted<'s>(&self, line: &Segment, parts: &mut impl Iterator<Item = &'s Segment>) -> f64 {
        let ends = [line.from, line.to];
        let along = line.to.x - line.from.x;
        let mut worst = 0.0;
        let (mut is_first, mut has_joint) = (true, false);
        loop {
            let Some(part) = parts.next() else { return f64::INFINITY };
            let has_same = (part.span, part.percent) == (line.span, line.percent);
            let goes_on = (part.to.x - part.from.x) * along >= 0.0;
            has_joint |= part.joint == line.joint;
            if !has_same || !goes_on || (part.joint != line.joint && part.joint != Joint::default()) {
                return f64::INFINITY;
            }
            worst = worse(worst, self.astray(ends, [part.from, part.to]));
            if is_first {
                worst = worse(worst, (self.carried(line.from) - part.from).norm());
            }
            is_first = false;
            if (part.to.x - line.to.x).abs() <= ALONG_EPSILON {
                worst = worse(worst, (self.carried(line.to) - part.to).norm());
                return if has_joint { worst } else { f64::INFINITY };
            }
        }
    }
}

/// Greater of two values; infinite if either is NaN.
fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::INFINITY } else { one.max(other) }
}
