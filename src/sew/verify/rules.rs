//! Rules for the verification of sewn patterns.

use crate::ir::verdict::{Rule, rules};
use crate::machine::Sewing;

rules! {
    FORMAT { name: "sew-verify/format", unit: "", about: "every row or record can be read, to the end of the program", more: "A motion part that meets a bad row stops with the needle in the cloth, or goes on with another number. After an edit by hand look for empty fields and a last line that is cut off." }
    ENTRIES { name: "sew-verify/entries", unit: "", about: "stitches, jumps, trims, stops and threads are those of the pattern, in its order", more: "An entry that is missing is a gap in the seam or a thread that is not cut; one too many moves all that follow. The value is how many differ." }
    COUNT { name: "sew-verify/count", unit: "", about: "each stitch has as many pulses of X and of Y as its way has steps", more: "A pulse too few or too many displaces all stitches behind it by a step, on a stepping motor for ever: it has no other way to know where it is. The value is the greatest difference." }
    DIRECTION { name: "sew-verify/direction", unit: "", about: "all pulses of an axis within a stitch go the way of the stitch", more: "A motor that turns back at full rate loses steps, and all that is sewn behind lies elsewhere. The value is how many pulses of a stitch go the wrong way." }
    END_POINT { name: "sew-verify/end-point", unit: "mm", about: "the sum of all pulses is the needle point, rounded to a step: half a step off at the most", more: "Rounding each stitch by itself would add up over a pattern; rounding places does not, so that the last stitch is as exact as the first." }
    WINDOW { name: "sew-verify/window", unit: "us", about: "the last pulse comes before the needle enters the cloth again", more: "A needle that is dragged bends, breaks, or tears the cloth. The time from feed start to feed end at this speed must hold the move." }
    TIME { name: "sew-verify/time", unit: "us", about: "times of the pulses of an entry do not go back", more: "A timer that is set to a past time fires at once, or never. The value is by how much a pulse comes before the one that stands above it." }
    FIRST_INTERVAL { name: "sew-verify/first-interval", unit: "us", about: "the first and the last interval are those of the start rate at the least", more: "A stepping motor that starts above its start rate loses steps; one that stops at once from a higher rate overshoots." }
    LEAST_INTERVAL { name: "sew-verify/least-interval", unit: "us", about: "no interval is below that of the greatest rate of the drives", more: "A drive that is asked for more leaves pulses out, and the pattern is displaced from there on. The value is by how much an interval is too short (`sewing.max_hz`)." }
    RAMP { name: "sew-verify/ramp", unit: "us", about: "intervals of an axis within a stitch fall, then rise", more: "A rate that rises again while it should fall shakes the clamp and, near its limit, loses steps. The value is by how much an interval falls behind one that rose." }
    ACCELERATION { name: "sew-verify/acceleration", unit: "mm/s2", about: "the rate changes no faster than the acceleration of the profile", more: "A motor follows no more than its torque allows: beyond it slips. The value is taken between neighbouring intervals, less what their rounding may add." }
    SPEED { name: "sew-verify/speed", unit: "rpm", about: "the spindle keeps its greatest speed, the soft start and the limits by pitch and by seam", more: "The value is by how much the speed passes the least of them. A speed where the needle is up, or none where it sews, counts in full." }
    STEADY_SPEED { name: "sew-verify/steady-speed", unit: "rpm", about: "unless it eases, the spindle turns at one speed within a run, but for its soft start", more: "The spindle is heavy: it cannot follow from stitch to stitch, and the windows would lie elsewhere than planned. The value is the greatest difference." }
    SPINDLE { name: "sew-verify/spindle", unit: "rpm/s", about: "an eased spindle changes its speed between two windows, no faster than it can", more: "A spindle that is still too fast when the window opens closes it before X and Y have arrived. The value is the rate at which the speed must change from feed end to feed start (`sewing.spindle_rpm_s`)." }
    SHORT_PITCH { name: "sew-verify/short-pitch", unit: "mm", about: "no stitch is shorter than the least pitch, but for those that lock the thread", more: "Stitches that are too short pile up under the needle and break the thread. The value is by how much the shortest misses `sewing.min_pitch_mm`." }
    LONG_PITCH { name: "sew-verify/long-pitch", unit: "mm", about: "no stitch is longer than the machine can make, nor than its seam asks", more: "Neither the clamp nor the thread take-up of the machine reaches farther. The value is by how much the longest passes `sewing.max_pitch_mm`." }
    CORNER { name: "sew-verify/corner", unit: "mm", about: "every corner of a seam has a needle point", more: "A seam that cuts a corner short shows on the finished piece. Edges shorter than the least pitch are merged, so that much is allowed." }
    ON_SEAM { name: "sew-verify/on-seam", unit: "mm", about: "every needle point is on its seam, or within its width", more: "Stitches beside the seam line miss the lower ply or the folded edge, and the seam opens. What merging short stitches moves is allowed, and no more." }
    COVER { name: "sew-verify/cover", unit: "mm", about: "both rails of a satin are pierced as closely as its pitch asks", more: "Cloth shows between stitches that stand too far apart, and a rail that is not reached frays. The value is by how much a place of a rail is farther from a needle point than the pitch. What merging short stitches moves is allowed." }
    CURVE { name: "sew-verify/curve", unit: "mm", about: "the line of an arc, circle or eyelet is the curve through the points of the file", more: "A round seam that is flattened too coarsely, or runs the other way round, is another seam. The centre is computed again. The value is by how much the line leaves its curve by more than `path.tolerance_mm`." }
    ORDER { name: "sew-verify/order", unit: "", about: "seams with a number of order are sewn in that order, before all others", more: "A seam that holds a ply must be sewn before the one that covers it. The value is how many stitches come after those of a later seam." }
    NEEDLE_POINT { name: "sew-verify/needle-point", unit: "mm", about: "each stitch of a stitch file is within half of its unit of the pattern", more: "Stitch files know tenths of a millimetre. More than half of one is another place: a reader that rounds moves instead of places drifts away by such." }
    COMMANDS { name: "sew-verify/commands", unit: "", about: "trims of a stitch file are those of the pattern", more: "A trim that is missing leaves a thread across the piece, and one too many a seam that opens. Three jumps in a row are a trim in DST and JEF files." }
    HEADER { name: "sew-verify/header", unit: "", about: "the header of a stitch file says what its records do", more: "Machines place the pattern within their field by the header: a wrong one drives the needle into the clamp. The value is how many entries are wrong." }
    PLACED { name: "sew-verify/placed", unit: "mm", about: "seams and needle points of the file lie where the profile places them (`sheet.*`), once in each copy", more: "A left pocket that is sewn as a right one is waste. The places are computed again from the keys of the profile. The value is how far the worst lies off." }
    FIELD { name: "sew-verify/field", unit: "mm", about: "no needle point is outside the field of the machine, and the pattern is no larger than its clamp", more: "A needle that strikes the clamp breaks, and its pieces fly. The value is by how much the worst passes `table.*` or `sewing.field_mm`." }
    SOURCE { name: "sew-verify/source", unit: "", about: "stitches, jumps, trims, stops and threads of a stitch file or queue that is read are sewn, in their order, and nothing else but parts of a stitch that is split", more: "The reader and a second decoder of the same bytes must find the same; only stitches that are too short may be merged with their neighbours. The value is how many differ. Please report the file." }
}

/// Maximum value permitted by a rule.
pub(super) fn limit(rule: &Rule, sewing: &Sewing) -> f64 {
    let limits: [(&[&Rule], f64); 7] = [
        (&[&END_POINT], sewing.step_mm / 2.0 + PLACE_EPSILON),
        (&[&WINDOW, &TIME, &FIRST_INTERVAL, &LEAST_INTERVAL, &RAMP], TIME_US),
        (&[&ACCELERATION], sewing.feed_acceleration_mm_s2 * (1.0 + ACCELERATION_EPSILON)),
        (&[&SPINDLE], sewing.spindle_rpm_s * (1.0 + SPEED_EPSILON)),
        (&[&SHORT_PITCH, &LONG_PITCH, &CURVE, &PLACED, &FIELD], PLACE_EPSILON),
        (&[&CORNER, &ON_SEAM, &COVER], sewing.min_pitch_mm + PLACE_EPSILON),
        (&[&NEEDLE_POINT], FILE_UNIT / 2.0 + PLACE_EPSILON),
    ];
    // The other rules permit nothing.
    limits.iter().find(|(rules, _)| rules.contains(&rule)).map_or(0.0, |(_, limit)| *limit)
}

/// Rounding of positions, mm: rows have four decimals.
pub(super) const PLACE_EPSILON: f64 = 1e-4;
/// Rounding of intervals, microseconds: rows have three decimals, and an interval has two ends.
const TIME_US: f64 = 0.0015;
/// Relative rounding of accelerations: times are sums of roots.
const ACCELERATION_EPSILON: f64 = 1e-4;
/// Relative rounding of the change of a speed: a difference of squares.
const SPEED_EPSILON: f64 = 1e-9;
/// Unit of stitch files, mm.
const FILE_UNIT: f64 = 0.1;
