//! Independent scan of the source bytes, by other means than the reader's. Its counts must agree with the marker, so that a
//! fault of the reader is detected, too.

use super::census::Census;
use super::drawing;
use super::scan::scan_iso;
use crate::geom::Point;
use crate::geom::moments::{Allowance, Difference};
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::MachineProfile;
use crate::verify::rules;

/// Rounding error of sums of lengths, relative.
const LENGTH_EPSILON: f64 = 1e-9;
/// Rounding error of sums of moments, relative: sums of a million lines agree to a thousandth of it.
const MOMENT_EPSILON: f64 = 1e-10;
/// Compares a marker as read with a scan of the bytes; `None` for a dialect without a scan.
pub fn source_audit(dialect: &str, bytes: &[u8], read: &Census, profile: &MachineProfile) -> Option<Vec<Finding>> {
    let (scanned, slack) = match dialect {
        "iso" => scan_iso(bytes, read.unit, profile),
        _ => (drawing::second(dialect)?.census)(bytes, profile),
    };
    let corner = |a: Point, b: Point| (a - b).amax();
    let bounds = match (read.bounds.is_empty(), scanned.bounds.is_empty()) {
        (true, true) => 0.0,
        (false, false) => corner(read.bounds.min, scanned.bounds.min).max(corner(read.bounds.max, scanned.bounds.max)),
        _ => f64::INFINITY,
    };
    let nowhere = || Sighting::missing(Point::origin(), 0);
    let finding = |rule, value: f64, limit| {
        let mut worst = Worst::new(rule, Some(limit));
        worst.see(value, nowhere);
        Finding { place: None, ..worst.finding() }
    };
    // Equal lengths in different units count as different.
    let is_same_unit = read.unit.to_bits() == scanned.unit.to_bits();
    let length = if is_same_unit { (read.length - scanned.length).abs() } else { f64::INFINITY };
    let mut findings = vec![
        finding(&rules::SOURCE_POINTS, read.points.abs_diff(scanned.points) as f64, 0.0),
        finding(&rules::SOURCE_LENGTH, length, LENGTH_EPSILON * (1.0 + read.length) + slack.length),
        finding(&rules::SOURCE_BOUNDS, bounds, LENGTH_EPSILON + slack.bounds),
    ];
    if dialect == "iso" {
        // Holes of a drawing are deduced from its shapes: the bytes do not contain them.
        findings.insert(1, finding(&rules::SOURCE_DRILLS, read.drills.abs_diff(scanned.drills) as f64, 0.0));
    } else {
        let corners = [read.bounds.min, read.bounds.max, scanned.bounds.min, scanned.bounds.max];
        let reach = corners.iter().map(|corner| corner.coords.amax()).fold(0.0, f64::max);
        let allowance = Allowance { reach, epsilon: MOMENT_EPSILON, slack: &slack.moments };
        let Difference { distance, limit } = read.moments.compare(&scanned.moments, allowance);
        findings.push(finding(&rules::SOURCE_MOMENTS, distance, limit));
    }
    Some(findings)
}
