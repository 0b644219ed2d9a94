//! Checks of the jet: distance of the head from the edge, its direction, speed of the jet, and coat.

use super::coat::Coat;
use super::dwell;
use super::ground::{Chord, Ground};
use super::rows::{EPSILON, POSITION_ROUNDING, Row, WAY};
use super::rules;
use crate::geom::{Heading, Point, Rotation, polyline};
use crate::ir::verdict::WorstByRule;
use crate::machine::Job;
use crate::units::{deg, rad};

/// Sprays up to this length are not an edge, mm.
const SHORT: f64 = 2.0;

/// Check of the jet on the edges.
pub(super) struct Jet<'a> {
    rows: &'a [Row],
    /// Middle of the jet at each row.
    spots: Vec<Point>,
    ground: &'a Ground,
    job: &'a Job,
}

impl<'a> Jet<'a> {
    /// Check of the jet in some rows.
    pub(super) fn new(rows: &'a [Row], ground: &'a Ground, job: &'a Job) -> Self {
        let distance = job.profile.tool.distance_mm;
        let spots = rows.iter().map(|row| row.head + Rotation(rad(row.c_deg)).unit() * distance).collect();
        Self { rows, spots, ground, job }
    }

    /// Verifies the jet.
    pub(super) fn judge(&self, worst: &mut WorstByRule) {
        let rows = self.rows;
        if !self.job.mode.cuts() {
            let on = rows.iter().filter(|row| row.jet).count();
            worst.see_under(&rules::JET, on as f64, 0.0, rows.iter().find(|row| row.jet).map(Row::sighting));
            return;
        }
        for (row, &spot) in rows.iter().zip(&self.spots) {
            if row.jet {
                self.aimed(row, spot, worst);
            }
            if row.block > 0 && !row.jet {
                worst.see_under(&rules::BLOCK, f64::INFINITY, 0.0, row.sighting());
            }
        }
        self.speeds(worst);
        dwell::judge(rows, &self.spots, self.job, worst);
        let coat = Coat::new(rows, &self.spots, self.ground, self.job);
        coat.judge(worst);
    }

    /// Checks distance and direction of a row, and the block that it names.
    fn aimed(&self, row: &Row, spot: Point, worst: &mut WorstByRule) {
        let (profile, ground) = (&self.job.profile, self.ground);
        let (distance, tolerance) = (profile.tool.distance_mm, ground.tolerance);
        let reach = distance + tolerance + profile.path.chord_sag_max_mm + 1.0;
        let Some((chord, away)) = ground.nearest(row.head, reach) else {
            worst.see_under(&rules::DISTANCE, f64::INFINITY, tolerance, row.sighting());
            return;
        };
        // The bulge of a curve beyond its chord does not count; over the material the distance is negative.
        let [near, far] = chord.bulge;
        let off = (distance - far - away).max(away - distance - near).max(0.0);
        worst.see_under(&rules::DISTANCE, off, tolerance + EPSILON, row.sighting());
        // Between two equally distant edges the head may face either.
        let equal = ground.within(row.head, away.abs() + 2.0 * tolerance);
        let askew = equal.map(|chord| askew(row, chord)).fold(f64::INFINITY, f64::min);
        let limit = profile.verify.max_heading_deg + POSITION_ROUNDING + EPSILON;
        worst.see_under(&rules::HEADING, deg(askew), limit, row.sighting());
        let named = ground.of_block(row.block);
        let off = named.map(|chord| polyline::distance_to_segment(spot, chord.ends[0], chord.ends[1]));
        let off = off.fold(f64::INFINITY, f64::min);
        // Near the ends of a chord that approximates a curve, the jet is ahead of the head or behind it.
        worst.see_under(&rules::BLOCK, off, tolerance + WAY, row.sighting());
    }

    /// Checks the speed of the jet over each centimetre of its path.
    fn speeds(&self, worst: &mut WorstByRule) {
        let (rows, spots, tool) = (self.rows, &self.spots, &self.job.profile.tool);
        let period = self.job.profile.time.period();
        let share = tool.edge_speed_percent / 100.0;
        let (limit, slow) = (tool.edge_speed_mm_s * (1.0 + share), tool.edge_speed_mm_s * (1.0 - share));
        let (mut from, mut way, mut slow_way) = (0, 0.0, 0.0);
        let step = |i: usize| if rows[i].jet && rows[i - 1].jet { (spots[i] - spots[i - 1]).norm() } else { 0.0 };
        let mut slowest = None;
        for (i, row) in rows.iter().enumerate().skip(1) {
            if !row.jet {
                // A spray that is shorter than a centimetre is checked as a whole.
                if way > SHORT && way < WAY {
                    let speed = way / ((i - 1 - from) as f64 * period);
                    worst.see_under(&rules::EDGE_SPEED, speed, limit * (1.0 + EPSILON), row.sighting());
                }
                (from, way) = (i, 0.0);
                continue;
            }
            way += step(i);
            while way - step(from + 1) >= WAY {
                from += 1;
                way -= step(from);
            }
            if way < WAY {
                continue;
            }
            let speed = way / ((i - from) as f64 * period);
            worst.see_under(&rules::EDGE_SPEED, speed, limit * (1.0 + EPSILON), row.sighting());
            if speed < slow {
                slow_way += step(i);
                slowest = slowest.or(Some(row.sighting()));
            }
        }
        worst.see(&rules::EDGE_SLOW, slow_way, slowest);
    }
}

/// Deviation of a row's direction from the normal of a chord, rad.
fn askew(row: &Row, chord: &Chord) -> f64 {
    let [from, to] = chord.ends;
    let along = polyline::foot(row.head, from, to).clamp(0.0, 1.0);
    let foot = from + (to - from) * along;
    let looks = Rotation(rad(row.c_deg)).heading();
    let aim = Heading::of(foot - row.head).turn_to(looks);
    // The outward direction of a curve varies from that of one chord to that of the next.
    let across = Heading::of(-chord.out).turn_to(looks);
    let [from, to] = [chord.bent[0] * (1.0 - along), chord.bent[1] * along];
    let bent = (across - from.max(to).max(0.0)).max(from.min(to).min(0.0) - across).max(0.0);
    aim.abs().min(bent)
}
