//! Every rule that programs are judged by.

/// A rule: a row of [`RULES`].
#[derive(Debug)]
pub struct Rule {
    /// Its name, as findings bear it.
    pub name: &'static str,
    /// Whether it judges timed rows: of a program without them it says nothing.
    pub needs_time: bool,
    /// Whether it is on how something is cut or drilled: of a program that does neither it says nothing.
    pub needs_cut: bool,
    /// What must hold.
    pub about: &'static str,
    /// Why it matters in a cutting room, and what to do: a line a paragraph, an indented line an example.
    pub more: &'static str,
}

/// Every rule. The order is that of reports.
#[rustfmt::skip] // a table: a rule a row
pub const RULES: &[Rule] = &[
    Rule { name: "verify/format", needs_time: false, needs_cut: false, about: "every row can be read: numbers are finite, outputs legal, no field is missing", more: "A controller that meets a bad row stops, or worse, goes on with another number. After an edit by hand look for empty fields, words and a last line that is cut off." },
    Rule { name: "verify/time", needs_time: true, needs_cut: false, about: "rows follow each other at the period of the profile, without gap or repetition", more: "The controller takes a row a period. A row that is missing is a jump of the axes, one too many a halt. Delete or repeat no rows; compile again instead." },
    Rule { name: "verify/start", needs_time: true, needs_cut: false, about: "the program starts at home", more: "The axes are at home when the program begins; a first row elsewhere is a jump across the table. Check `home` in the profile." },
    Rule { name: "verify/end", needs_time: false, needs_cut: false, about: "the program ends with knife and drill up, and parked if the profile says so", more: "A knife or drill left down tears the cloth when the head moves next. Check `park` in the profile." },
    Rule { name: "verify/speed-x", needs_time: true, needs_cut: false, about: "X never is faster than its limit", more: "A drive that is asked for more than it can falls behind, and the cut leaves the line. Check axes.x.speed_mm_s." },
    Rule { name: "verify/speed-y", needs_time: true, needs_cut: false, about: "Y never is faster than its limit", more: "A drive that is asked for more than it can falls behind, and the cut leaves the line. Check axes.y.speed_mm_s." },
    Rule { name: "verify/speed-c", needs_time: true, needs_cut: false, about: "C never is faster than its limit", more: "A blade that turns too late cuts beside its line and bends. Check axes.c.speed_deg_s." },
    Rule { name: "verify/acceleration-x", needs_time: true, needs_cut: false, about: "X never accelerates more than its limit", more: "Too much force makes the drive slip or trip, and the rest of the lay is cut displaced. Check axes.x.acceleration_mm_s2." },
    Rule { name: "verify/acceleration-y", needs_time: true, needs_cut: false, about: "Y never accelerates more than its limit", more: "Too much force makes the drive slip or trip, and the rest of the lay is cut displaced. Check axes.y.acceleration_mm_s2." },
    Rule { name: "verify/acceleration-c", needs_time: true, needs_cut: false, about: "C never accelerates more than its limit", more: "Too much torque makes the blade's drive slip, and from there on the blade stands askew. Check axes.c.acceleration_deg_s2." },
    Rule { name: "verify/jerk-x", needs_time: true, needs_cut: false, about: "X never jerks more than its limit", more: "A sudden change of force shakes the gantry, and the edge shows waves. Check axes.x.jerk_mm_s3." },
    Rule { name: "verify/jerk-y", needs_time: true, needs_cut: false, about: "Y never jerks more than its limit", more: "A sudden change of force shakes the gantry, and the edge shows waves. Check axes.y.jerk_mm_s3." },
    Rule { name: "verify/jerk-c", needs_time: true, needs_cut: false, about: "C never jerks more than its limit", more: "A sudden change of torque makes the blade tremble in the cloth, and the edge frays. Check axes.c.jerk_deg_s3." },
    Rule { name: "verify/feed", needs_time: false, needs_cut: true, about: "the tip is never faster than the feed, the slowed parts of the file and the way before a corner let it be", more: "A reciprocating knife that is pushed faster than it strokes tears the cloth instead of cutting it. What caps it: knife.feed_mm_s, F and slowed parts of the file, and slow.before_corner_mm." },
    Rule { name: "verify/crawl", needs_time: false, needs_cut: true, about: "while the knife is down F of G-code asks for a quarter of the speed that the feed and the axes allow, or more", more: "A knife that crawls stays in one place for many strokes: it heats the cloth, and synthetics fuse at the edge. After an edit by hand look for an F that lost a digit, or is meant for G93 in a program of G94. To cut slower, set knife.feed_mm_s or slow the piece in the file." },
    Rule { name: "verify/rest", needs_time: true, needs_cut: false, about: "the axes rest while the knife plunges or lifts, while a drill works and at events", more: "Moving while the blade is half in the cloth bends it and pulls the plies along. The axes must stand from the command until the dwell is over." },
    Rule { name: "verify/dwell", needs_time: false, needs_cut: true, about: "plunges, lifts and drills last as long as the profile says, and G-code rests nowhere else", more: "A blade that has not arrived leaves the first millimetres uncut, or tears on the way out. In G-code no rest may be longer either, nor one be added: a blade that runs on the spot heats the cloth. Check knife.plunge_ms, knife.lift_ms and drill.dwell_ms." },
    Rule { name: "verify/c-range", needs_time: false, needs_cut: false, about: "C stays inside its range", more: "Beyond its range the blade's axis winds up its cables. Check c.range_deg." },
    Rule { name: "verify/table", needs_time: false, needs_cut: false, about: "the axes, and the blade while it is down, stay over the table", more: "Outside the table are end stops and no cloth. A millimetre is let pass; move the marker or correct `table`." },
    Rule { name: "verify/on-path", needs_time: false, needs_cut: true, about: "the tip stays inside the tolerance band of the path while it cuts", more: "A part whose edge leaves the line by more than the tolerance does not fit its neighbour at the seam. The tolerance is path.tolerance_mm." },
    Rule { name: "verify/stray", needs_time: false, needs_cut: false, about: "the knife cuts nothing that is not in the marker", more: "A stroke that belongs to no line cuts through a part. With --dry-run and --frame every stroke is one too many: the knife must stay up." },
    Rule { name: "verify/order", needs_time: false, needs_cut: true, about: "events, holes, slits and contours come in the order of the marker", more: "Notches and cut-outs come before the outline, since a part that is free shifts. A hole goes through cloth that still lies fast. A program in another order than the marker may cut or drill a loose part." },
    Rule { name: "verify/once", needs_time: false, needs_cut: true, about: "nothing is cut twice beyond the overlaps", more: "A second cut along the same line frays the edge and takes time. Look for a contour that stands twice in the file (marker/contour-twice)." },
    Rule { name: "verify/complete", needs_time: false, needs_cut: true, about: "no stretch of a contour or slit is left uncut", more: "A stretch left uncut holds the part in the cloth, and it is torn when lifted off. The allowance is verify.max_uncut_mm, what rounding can leave." },
    Rule { name: "verify/heading", needs_time: false, needs_cut: true, about: "the blade points as its orientation mode asks while it cuts", more: "A blade askew to its way bends and pushes the plies aside: upper and lower parts come out different. Short lines of G-code in few decimals point askew: more gcode.decimals or gcode.arcs = true helps. The limit is verify.max_heading_deg." },
    Rule { name: "verify/down", needs_time: false, needs_cut: true, about: "how far the tip goes while the knife is down", more: "The tip goes farther between a plunge and a lift than knife.max_down_mm allows: the program was made with another profile, or a lift was taken out." },
    Rule { name: "verify/body", needs_time: false, needs_cut: true, about: "how far the blade's body leaves the path on curves", more: "On a curve the body of a wide blade leaves the line although its tip is on it, and widens the cut. A narrower knife helps; verify.max_body_mm makes it a limit." },
    Rule { name: "verify/overcut-part", needs_time: false, needs_cut: true, about: "how far the blade cuts into its own part beyond ends and corners", more: "A cut past a corner into the part weakens the seam allowance there. Only what a compile warned of (path/overcut) may go farther than the tolerance; verify.max_overcut_part_mm allows more." },
    Rule { name: "verify/overcut-neighbour", needs_time: false, needs_cut: true, about: "how far the blade cuts into another part beyond ends and corners", more: "A cut past a corner reaches into the part beside it. Leave more room in the marker or take smaller overlaps; verify.max_overcut_neighbour_mm allows more." },
    Rule { name: "verify/overcut-waste", needs_time: false, needs_cut: true, about: "how far the blade cuts into waste beyond ends and corners", more: "A cut past a corner into waste does no harm, and is what frees the part. verify.max_overcut_waste_mm makes it a limit all the same." },
    Rule { name: "verify/declared", needs_time: false, needs_cut: true, about: "what the blade does beside the drawing is what the program says of itself", more: "A compile says beside its program (.meta.json) where it could not cut as drawn: a plunge on a curve, a blade longer than its notch. What it does not say nobody chose: the program was changed, or the file beside it is that of another." },
    Rule { name: "verify/drills", needs_time: false, needs_cut: false, about: "every hole is drilled once, by its drill, and no other", more: "A hole that is missing, or one too many, is found only at the sewing machine. In a dry run there must be none." },
    Rule { name: "verify/drill-place", needs_time: false, needs_cut: true, about: "every hole is where the marker has it", more: "A hole marks where a pocket or a dart goes: beside its place it shows on the garment. Check drill.offset_mm." },
    Rule { name: "verify/block", needs_time: true, needs_cut: false, about: "rows that cut name the block that is cut there, and no others name one", more: "A program is resumed by the blocks that its rows name, and reports say where by them. A wrong name would resume it in the wrong place; compile it anew rather than edit that column." },
    Rule { name: "verify/events", needs_time: false, needs_cut: false, about: "the events of the marker are told, each once and with the knife up, and no others", more: "An event stops the machine or moves the cloth on. One that is left out leaves the cloth where it lies; one too many, or out of its turn, moves away what is not yet cut." },
    Rule { name: "verify/same", needs_time: false, needs_cut: false, about: "a cut file that is written says what the marker says: pieces, events, speeds, holes, slits, contours, texts, fields", more: "Another cutter will cut from this file: what it lacks is not cut, and what it has too much is. After an edit by hand the number tells how many statements differ; compile again instead." },
    Rule { name: "verify/same-place", needs_time: false, needs_cut: false, about: "every place of a cut file that is written is that of the marker", more: "Numbers of a cut file are rounded to a millionth of its unit, far below what a cutter resolves. More than that is another drawing." },
    Rule { name: "source/points", needs_time: false, needs_cut: false, about: "the marker has the points that the file cuts", more: "The reader and a second scan of the same bytes must count the same points: otherwise a line would be missing or made up. Please report the file." },
    Rule { name: "source/drills", needs_time: false, needs_cut: false, about: "the marker has the holes of the cut file; those of a plot are deduced from its shapes", more: "The reader and a second scan of the same bytes must count the same holes. Please report the file if they do not." },
    Rule { name: "source/length", needs_time: false, needs_cut: false, about: "the marker has the cut length of the file", more: "The reader and a second scan of the same bytes must find the same way of the knife. Please report the file if they do not." },
    Rule { name: "source/bounds", needs_time: false, needs_cut: false, about: "the marker has the bounds of the file", more: "The reader and a second scan of the same bytes must find the same box: a piece displaced or of another size would be seen here. Please report the file." },
    Rule { name: "source/moments", needs_time: false, needs_cut: false, about: "the lines of a plot lie where the file draws them", more: "The reader and a second scan of the same plot must find its lines in the same places: a part that is moved, turned or mirrored within the bounds would be seen here. Please report the file." },
    Rule { name: "source/kept", needs_time: false, needs_cut: false, about: "every block that cuts or drills in the file as read does so in the marker that is cut", more: "Between reading and cutting lines are joined, points and slits that stand twice are dropped, pieces are chosen. A block that is lost on that way would leave a line uncut. Please report the file." },
];

/// The row of a rule, by its name.
pub fn rule(name: &str) -> &'static Rule {
    RULES.iter().find(|rule| rule.name == name).expect("every rule stands in the table")
}
