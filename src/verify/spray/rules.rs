//! Rules for the program of a head at a distance.

use crate::ir::verdict::{Rule, rules};

rules! {
    FORMAT { name: "spray-verify/format", unit: "", about: "every row can be read, to the end of the program", more: "A controller that meets a bad row stops with the jet on one spot. After an edit by hand look for empty fields and a last line that is cut off." }
    TIME { name: "spray-verify/time", unit: "s", about: "rows follow each other at the period of the profile, without gap or repetition", more: "The controller takes a row a period: a row that is missing is a jump of the head. Compile again instead of deleting rows." }
    START { name: "spray-verify/start", unit: "mm", about: "the program starts at home, with the jet off", more: "A first row elsewhere is a jump across the table. Check `home` in the profile." }
    END { name: "spray-verify/end", unit: "", about: "the program ends at rest with the jet off, parked if the profile says so", more: "A jet that is left on floods what stands below it, and a head that stops amid the path stands in the way of the next part. The value counts what is wrong at the end: the jet, a speed that is not 0, another place than the park position." }
    SPEED_X { name: "spray-verify/speed-x", unit: "mm/s", about: "X never is faster than its limit", more: "A drive that is asked for more than it can falls behind, and the head leaves its way. Check axes.x.speed_mm_s." }
    SPEED_Y { name: "spray-verify/speed-y", unit: "mm/s", about: "Y never is faster than its limit", more: "A drive that is asked for more than it can falls behind, and the head leaves its way. Check axes.y.speed_mm_s." }
    SPEED_C { name: "spray-verify/speed-c", unit: "deg/s", about: "C never is faster than its limit", more: "A head that turns more slowly than it should looks beside the edge. Check axes.c.speed_deg_s." }
    ACCELERATION_X { name: "spray-verify/acceleration-x", unit: "mm/s2", about: "X never accelerates more than its limit", more: "Too much force makes a belt skip. Check axes.x.acceleration_mm_s2, and how fast the tool goes round corners." }
    ACCELERATION_Y { name: "spray-verify/acceleration-y", unit: "mm/s2", about: "Y never accelerates more than its limit", more: "Too much force makes a belt skip. Check axes.y.acceleration_mm_s2, and how fast the tool goes round corners." }
    ACCELERATION_C { name: "spray-verify/acceleration-c", unit: "deg/s2", about: "C never accelerates more than its limit", more: "Too much torque makes the head swing. Check axes.c.acceleration_deg_s2, and how fast the tool goes round corners." }
    JERK_X { name: "spray-verify/jerk-x", unit: "mm/s3", about: "X never jerks more than its limit", more: "A sudden change of force shakes the gantry, and the coat shows waves. Check axes.x.jerk_mm_s3." }
    JERK_Y { name: "spray-verify/jerk-y", unit: "mm/s3", about: "Y never jerks more than its limit", more: "A sudden change of force shakes the gantry, and the coat shows waves. Check axes.y.jerk_mm_s3." }
    JERK_C { name: "spray-verify/jerk-c", unit: "deg/s3", about: "C never jerks more than its limit", more: "A sudden change of torque makes the head swing. Check axes.c.jerk_deg_s3." }
    C_RANGE { name: "spray-verify/c-range", unit: "deg", about: "C stays inside its range", more: "Beyond its range the head winds up its hoses. Check c.range_deg." }
    TABLE { name: "spray-verify/table", unit: "mm", about: "the head stays over the table", more: "Outside are end stops. The head runs outside the part by its distance: move the part, or correct `table`." }
    VELOCITY { name: "spray-verify/velocity", unit: "mm/s", about: "the velocities of a row are those of the positions around it", more: "A controller that feeds velocities forward moves by them: where they contradict the positions it shakes." }
    DISTANCE { name: "spray-verify/distance", unit: "mm", key: Some("path.tolerance_mm"), about: "while the jet is on, the nearest edge is as far from the head as tool.distance_mm says, within the tolerance", more: "Nearer the coat runs, farther it is dust. The tolerance is path.tolerance_mm; a plain fit of one polynomial an edge (quintic.split = false) needs a wide one." }
    HEADING { name: "spray-verify/heading", unit: "deg", key: Some("verify.max_heading_deg"), about: "while the jet is on, the head looks at the nearest place of the edge, square to it", more: "A jet that meets the edge askew coats one side of it. The limit is verify.max_heading_deg; where chords stand for a curve any direction between those of its chords is square." }
    EDGE_SPEED { name: "spray-verify/edge-speed", unit: "mm/s", key: Some("tool.edge_speed_percent"), about: "over no centimetre of edge the jet is faster than tool.edge_speed_mm_s and tool.edge_speed_percent", more: "Where the jet is faster the coat is thinner. On a convex curve the head must be faster than the jet, in a bay slower." }
    EDGE_SLOW { name: "spray-verify/edge-slow", unit: "mm", about: "how much of the edge the jet passes more slowly than by tool.edge_speed_percent", more: "There the coat is thicker: where the head comes to rest at corners inwards, and where it gathers the speed of a curve. Only reported." }
    DWELL { name: "spray-verify/dwell", unit: "s", about: "about no place the jet stays longer than twice what its speeds, the turn of the head and a rest take", more: "A jet that stands floods the place. Around corners the head goes at tool.corner_speed_mm_s; slow axes or a small jerk make it linger there." }
    COVERAGE { name: "spray-verify/coverage", unit: "mm", about: "every place of every edge that a head at the distance can face without coming nearer to another one is sprayed", more: "What is left has no coat. Places that nothing can face are told by the compile (spray/unreached), and do not count." }
    TWICE { name: "spray-verify/twice", unit: "mm", about: "no stretch of an edge is sprayed again", more: "Its coat would be twice as thick, and run. Where a closed edge begins it ends, and few millimetres meet. The value is the longest stretch." }
    JET { name: "spray-verify/jet", unit: "", about: "in a dry run the jet stays off", more: "With --dry-run and --frame the head moves and nothing is sprayed. The value is how many rows have the jet on." }
    BLOCK { name: "spray-verify/block", unit: "mm", about: "rows with the jet on name the block that drew the edge there, and no others name one", more: "A program is resumed, and reports say where, by the blocks that its rows name. The value is how far the named block is from where the jet meets the edge." }
}

/// Rules of axis limits, by order of the derivative and axis.
pub(super) static OF_AXES: [[&Rule; 3]; 3] =
    [[&SPEED_X, &SPEED_Y, &SPEED_C], [&ACCELERATION_X, &ACCELERATION_Y, &ACCELERATION_C], [&JERK_X, &JERK_Y, &JERK_C]];
