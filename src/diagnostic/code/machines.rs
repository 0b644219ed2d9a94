//! Codes of the other machines of the sewing floor, and of the machine profile.

use crate::diagnostic::kind::{Code, codes, error, warning};
use crate::diagnostic::telling::Fault::{Shape, Text};
use crate::diagnostic::telling::Harm::{Spares, Spoils};

codes! {
    // Sewn patterns.
    /// No stitch.
    SEW_NOTHING = error(Shape, "sew/nothing-to-sew", "The file holds no line and no stitch.", "The pattern is empty, or holds what is no line. `cutc info` tells what is in a drawing; `--line` names the pen or layer whose lines are sewn.\n  cutc sew seat.plt --line 2");
    /// A row that says nothing known.
    SEW_ROW = error(Text, "sew/row", "A row of a pattern or of a queue cannot be read; the message says why.", "Sewing on without it would leave a gap or displace all that follows. Mend the row: decimal points, commas between the fields.\n  0,0,zigzag open");
    /// A file that ends too soon.
    SEW_TRUNCATED = error(Text, "sew/truncated", "A stitch file or queue ends before its end.", "What is missing would not be sewn, and a thread would be left uncut. Transfer the file again as binary data and compare the sizes of both.");
    /// A pattern without its last record.
    SEW_NO_END = warning(Spares, Text, "sew/no-end", "A DST file has no record for its end, but as many records as its header counts.", "Some programs leave the end out. The pattern is whole and is sewn; a machine that reads the file itself may not stop there. Write it anew if it goes to one.\n  cutc sew seat.dst -t dst -o whole.dst");
    /// A record that cannot be read.
    SEW_RECORD = error(Text, "sew/record", "A record of a stitch file is none that its format knows; the message has its number.", "All that follows would be sewn in another place. The file is damaged, or is of another format: name that with `--from`.\n  cutc sew odd.bin --from exp");
    /// A header that tells something else.
    SEW_HEADER = warning(Spares, Text, "sew/header", "The header of a DST file does not fit its stitches; the message says what it tells and what there is.", "The stitches are sewn as they are. If the header is right, some are missing: compare with the original. Headers of files that were edited are often wrong.");
    /// More than the pattern.
    SEW_BEHIND_END = warning(Spares, Text, "sew/behind-end", "Bytes stand behind the end of a stitch file; they are not sewn.", "Machines stop at the end, and so does this. If two files have run together, or a damaged byte ends the pattern too soon, stitches are missing: compare their number with the original.");
    /// Speeds that are others now.
    SEW_SPEEDS = warning(Spares, Shape, "sew/other-speeds", "A queue that is read asks for other speeds than it is sewn at: speeds are computed from the profile.", "SPEED rows are written anew, so an edit of them by hand has no effect. Limit the speed by `sewing.max_rpm`, or by pitch with `sewing.speeds`.\n  cutc sew pocket.queue.csv --set sewing.max_rpm=2500");
    /// A machine that is hardly used.
    SEW_SLOW = warning(Spares, Shape, "sew/slow-pattern", "No run is sewn at a quarter of the greatest speed of the spindle, because no stitch fits into its window faster.", "The pattern takes many times as long as it should: most likely an angle of the window, a step or a rate of the profile is mistyped. The message has the window.\n  sewing.feed_start_deg = 250\n  sewing.feed_end_deg = 110");
    /// Jumps that cut the thread.
    SEW_JUMPS_CUT = warning(Spares, Shape, "sew/jumps-cut", "Long moves without a trim are three jumps or more in a DST or JEF file, which most machines take for one.", "The thread is cut where it was to run on, and a seam may open. Let the thread be cut there anyway (`sewing.trim`), or write EXP, which has a record for a trim.");
    /// Jump after jump.
    SEW_JUMPS = warning(Spares, Shape, "sew/jump-storm", "So many jumps follow one another that the file is most likely damaged.", "Jumps in a row are made as one move, so nothing is lost, but no system writes so many. Look at the picture (-t svg), and compare the stitches with the original.");
    /// An element on a line that cannot bear it.
    SEW_ELEMENT = error(Shape, "sew/element", "An element of a pattern does not suit its line: a box needs four corners, a bar tack two points, a satin rails that do not cross, an arc three points, a circle or an eyelet two, any other two places.", "What was meant cannot be told from the points, and a tack in the wrong place is a hole in the garment. Mend the points, or take another element.\n  0,0,box-x");
    /// A needle point where the machine cannot be.
    SEW_FIELD = error(Shape, "sew/field", "A needle point lies outside the field of the machine (`table.*`), or the pattern is larger than its clamp (`sewing.field_mm`).", "The needle would strike the clamp, or X and Y their stops. Move the pattern, as with sheet.origin, or turn it, or give the field of the machine.\n  cutc sew pocket.csv --set sheet.origin=corner");
    /// An inset that leaves nothing.
    SEW_INSET = error(Shape, "sew/inset", "A contour is too narrow for the inset that is asked for, or the file has no contours.", "The seam would run outside the part, or through another seam: somewhere the contour is narrower than twice the inset. Take a smaller `--inset`, or draw the seam.");
    /// No such line.
    SEW_NO_LINE = error(Shape, "sew/no-line", "The file has no line of the name that `--line` gives; the hint names those that it has.", "Pens and layers have the names that the file gives them; `seam` means the seam lines that are recognised in parts.\n  cutc sew parts.plt --line seam");
    /// A line of a kind that is not read.
    SEW_UNREAD = error(Shape, "sew/unread-line", "The pen or layer that `--line` names draws something of a kind that is not read, such as a spline.", "What is not read would not be sewn: a seam would have a gap, or be missing. Let the CAD system export polylines, as the convention for patterns has them.");
    /// A stitch that is too short.
    SEW_SHORT = warning(Spares, Shape, "sew/short-stitch", "A stitch is shorter than `sewing.min_pitch_mm`; it is merged with the next. The message has its record.", "Stitches that are too short pile up under the needle and break the thread. Where they are meant, to lock a seam, lower the key.");
    /// A stitch that is too long.
    SEW_LONG = error(Shape, "sew/long-stitch", "A stitch is longer than the machine can make, or than its speed allows where `sewing.on_long` is \"reject\". The message has its record.", "The needle would be dragged through the cloth. `--on-long split` makes it several, `--on-long slow` sews its run more slowly.");
    /// Stitches that were split.
    SEW_SPLIT = warning(Spoils, Shape, "sew/split-stitches", "Stitches too long for the speed were split into equal ones; the message has how many penetrations that adds.", "The seam has more holes than were drawn, which shows on leather and weakens it. `--on-long slow` keeps every stitch and takes more time.");
    /// A run that one stitch slows down.
    SEW_SLOWED = warning(Spares, Shape, "sew/slowed-run", "A run is sewn more slowly than most of its stitches allow, because of one; the message names it and what it costs.", "The spindle keeps one speed within a run. Shorten the stitch in the pattern, split it (`--on-long split`), or end the run before it by a trim.");
    /// No speed at all.
    SEW_NO_SPEED = error(Shape, "sew/no-speed", "A stitch fits into its window at no speed of the spindle.", "Even the slowest turn is too short for the move. Look at `sewing.feed_start_deg`, `sewing.feed_end_deg`, the acceleration and `sewing.grid_rpm`, or split the stitch.");
    /// The queue runs dry.
    SEW_UNDERRUN = warning(Spares, Shape, "sew/underrun", "The host does not fill the queue as fast as the machine takes from it; the message says from which entry on.", "The machine stops amid a seam and waits. A deeper queue bridges it, a faster host or a slower spindle ends it.\n  cutc sew seat.dst --set sewing.queue_depth=1024");
    /// The program breaks a rule.
    SEW_BROKEN = error(Shape, "sew/broken", "The program, read back, breaks a rule; the message names the rule, the worst value, the limit and the entry.", "The program is not written: it would not sew what the file says. Please report the file: a pattern that is read without errors should be sewn as it is.");

    // Heads that follow edges at a distance.
    /// Nothing to follow.
    SPRAY_NOTHING = error(Shape, "spray/nothing", "A file has no closed contour, or none that a head can follow at its distance.", "A head follows the closed edges of parts from outside, and holes from inside. Close the contours, or take a smaller distance.\n  tool.distance_mm = 150");
    /// Edges that meet.
    SPRAY_TANGLED = error(Shape, "spray/tangled", "Edges cross, touch or run back upon each other, so that there is no outside from which a head could follow them.", "What is coated there could be anything. Draw each part by one line that does not meet itself, and move parts that touch apart: between them a head has no room anyway.");
    /// Lines that are no edges.
    SPRAY_NO_EDGE = warning(Spares, Shape, "spray/no-edge", "Open lines, notches and holes of a file are no edges of parts: no head at a distance follows them.", "Only closed contours have an inside and an outside. If an edge is among them, it is drawn open: close it in the CAD system.");
    /// Edges that are not reached.
    SPRAY_UNREACHED = warning(Spoils, Shape, "spray/unreached", "A part of an edge cannot be followed at the distance of the tool, because something else is nearer; the message says how much, and where the worst is.", "It stays without coat: slots and bays that are narrower than twice the distance, and both sides of corners inwards. Coat it by hand, or with a smaller distance.\n  cutc compile panel.csv -p spray.toml --set tool.distance_mm=150");
    /// Polynomials that do not fit.
    SPRAY_UNFIT = error(Shape, "spray/unfit", "Polynomials stay farther from the way of the head than is allowed, however often edges are split.", "The program would not be judged good. Powers of the time (`quintic.basis`) are ill-conditioned on long edges; Chebyshev polynomials are not.\n  quintic.basis = \"chebyshev\"");
    /// Chords that are too coarse for a curve.
    SPRAY_COARSE = warning(Spares, Shape, "spray/coarse", "Chords look like those of a curve, but leave it by more than `path.chord_sag_max_mm`: they are followed as straight lines.", "A head swings from chord to chord then, and asks much of its axes. If a curve is meant, say how far its chords may leave it, or export it in finer ones; `path.fit = \"polygon\"` says that none is.\n  path.chord_sag_max_mm = 0.5");
    /// A jet that is slow.
    SPRAY_SLOW = warning(Spoils, Shape, "spray/slow", "The jet passes an edge more slowly than by twice `tool.edge_speed_percent`, on more than its two ends.", "Its coat is thicker there. The axes cannot follow the head through so tight a curve at its speed, or chords are too coarse for one.\n  tool.edge_speed_mm_s = 200");
    /// C beyond its range.
    SPRAY_RANGE = error(Shape, "spray/c-range", "Around an edge the head turns farther than `c.range_deg` lets it.", "Around a part without corners inwards the head turns once, and its hoses with it. Widen the range, or let C turn without end.\n  c.range_deg = \"unbounded\"");
    /// A target that tells of a knife.
    SPRAY_TARGET = error(Shape, "spray/target", "A target that tells of a knife is asked for, but the tool is a head at a distance.", "Its program would be that of a knife on the lines. Take setpoints or a picture.\n  cutc compile panel.csv -p spray.toml -t csv,svg");

    // Tracking the centre of a moving cloth.
    /// The first row of a log.
    TRACK_HEADER = error(Text, "track/header", "The first row of a log does not name its columns.", "Without names I and J could be taken for each other, and the carriage would run away from the centre. Write them as the hint has them.\n  t_s,i,j");
    /// A column that nothing is known of.
    TRACK_COLUMN = warning(Spares, Text, "track/column", "A log has columns that nothing is known of; they are passed over.", "If one of them is the place of the conveyor or of the carriage it has another name here. The hint has the names.\n  t_s,i,j,conv_mm,carriage_mm");
    /// A row that cannot be read.
    TRACK_ROW = error(Text, "track/row", "A row of a log cannot be read, or does not follow the one before it; the message says why.", "Leaving it out would shift all that the controller counts by a sample. Mend the row: decimal points, commas, times that go on.\n  0.010,33,31");
    /// A header alone.
    TRACK_NO_ROWS = error(Text, "track/no-rows", "A log has no rows.", "Nothing was recorded, or all of it was lost on the way: the carriage cannot have followed anything by it. Look at the recorder, and compare the sizes of its file and of this one.");
    /// Rows in another rhythm.
    TRACK_PERIOD = error(Text, "track/period", "Most rows of a log are not `track.period_ms` apart.", "The controller counts samples: with another period its debounce time and what it feeds forward would be others. Set the period of the log.\n  cutc track log.csv --set track.period_ms=5");
    /// Samples that are missing.
    TRACK_GAP = warning(Spares, Text, "track/gap", "Samples are missing in a log; behind them the controller begins anew.", "What the carriage did meanwhile is not known. If the recorder loses samples, so may the controller: look at the load of its processor.");
    /// An edge that is lost.
    TRACK_LOST = warning(Spoils, Text, "track/edge-lost", "All sensors of a ruler are covered, or none: its edge is lost, and the drive is off until it is found.", "Meanwhile the heads do not follow the cloth, and what they cut there is displaced. Bring the cloth between the rulers before it is cut; longer rulers lose it less easily.");
    /// A width outside its limits.
    TRACK_WIDTH = warning(Spoils, Text, "track/width", "The width of the cloth is outside `track.width_range_mm`; the drive is off until it is inside.", "A fold, a tear or a seam between two bolts: parts may lie beyond the edge of the cloth. Look at the place before it is cut, or widen the range.\n  track.width_range_mm = [1480, 1520]");
    /// A profile that may overshoot.
    TRACK_OVERSHOOT = warning(Spares, Shape, "track/overshoot", "The profile breaks a condition under which the carriage is sure not to overshoot; the message says which and by how much.", "The conditions are sufficient, not necessary: it may do well all the same. Simulate it with the delays of your machine before you believe it.\n  cutc track --simulate step.toml -p machine.toml");
    /// A carriage whose place is not known.
    TRACK_CARRIAGE = warning(Spoils, Shape, "track/carriage-assumed", "A log does not tell where the carriage was; it is taken to have followed the commands.", "The rulers tell where the cloth is from the carriage, so the centre line is only as true as its place. Log its encoder as the column `carriage_mm`, in mm to the right of the middle.");
    /// Upstream rulers without columns in the log.
    TRACK_NO_UPSTREAM = warning(Spares, Shape, "track/no-upstream", "The profile has rulers upstream, but the log does not have their readings; nothing is fed forward.", "The carriage then only follows what it sees, and is farther off centre than it could be. Log the readings as columns `up_i` and `up_j`.");
    /// The commands break the law.
    TRACK_BROKEN = error(Shape, "track/broken", "The commands for the carriage, read back, are not those that the readings and the profile ask for; the message names the row.", "Nothing is written: the carriage would be driven away from the cloth. Please report the log: what is written should keep the law.");
    /// No line to write.
    TRACK_NO_CENTRE = error(Shape, "track/no-centre", "A log sees both edges of the cloth in no two places of the conveyor, so that there is no centre line.", "The edges are lost throughout, or the conveyor stands. Look at the picture of another run, and at the column `conv_mm`.");
    /// Cloth without readings.
    TRACK_UNSEEN = warning(Spoils, Shape, "track/unseen", "A centre line goes over cloth whose edges were not both seen, or for which samples are missing; it is taken to go straight there.", "The cloth may have wandered meanwhile, and what is cut there is displaced by as much. Record that stretch again, or leave it out of the marker.");
    /// A scenario that cannot be read.
    TRACK_SCENARIO = error(Text, "track/scenario", "A scenario has a key that is none, or a value that is out of its range.", "A mistyped key would leave the cloth lying still without a word. `cutc manual tracking` lists the keys.\n  offset_mm = 20");
    /// The first row of a centre line.
    CENTRE_HEADER = error(Text, "centre/header", "The first row of a centre line is not `conv_mm,centre_mm`.", "Another file of numbers would move every part to one side. Give the file that `cutc track -t centre` writes.\n  cutc compile marker.cut --centre cloth.centre.csv");
    /// A row that cannot be read.
    CENTRE_ROW = error(Text, "centre/row", "A row of a centre line cannot be read, or the conveyor does not go on in it; the message says why.", "Guessing it would cut parts beside their places. Mend the row, or make the file anew from the log.\n  125.5,-0.75");
    /// A line without two ends.
    CENTRE_SHORT = error(Text, "centre/short", "A centre line has fewer than two rows.", "One place says nothing of how the cloth lies beside it. For cloth that lies straight give its two ends.\n  0,1.5\n  3000,1.5");
    /// A marker that is longer than its centre line.
    CENTRE_BEYOND = warning(Spoils, Shape, "centre/beyond", "The marker reaches beyond the ends of the centre line, where the cloth is taken to lie as at the nearer end.", "Nobody has seen the cloth there. Record the whole of it, or move the marker to where it was seen (`sheet.origin`).");
    /// A centre line that no cloth takes.
    CENTRE_STEEP = warning(Spoils, Shape, "centre/steep", "The centre line runs across more steeply than cloth does on a conveyor, or bends within a notch, which is cut straight.", "Parts are sheared along the line: where it is wrong they are spoilt. Compare the file with the cloth; a column in another unit, or damage of an edge that was taken for its way, looks like that.\n  cutc track log.csv -t centre,svg");
    /// A row of marks that cannot be read.
    MARKS_ROW = error(Text, "marks/row", "A row of a file of registration marks (`--map`) cannot be read, or the first one is not `x_mm,y_mm,found_x_mm,found_y_mm`.", "Guessing a place would move every part. The first two numbers are where the mark stands in the drawing, the others where it lies on the table.\n  120.5,80,1322.4,96.2");
    /// Marks that give no map.
    MARKS_FIT = error(Shape, "marks/fit", "Registration marks do not say where the drawing lies: they are fewer than four, lie on a line or mirrored, stretch it as no cloth is, or do not fit each other within `map.max_mm`.", "A mark that was read wrongly would spoil every part. Find the marks again that the message names; six marks or more tell well which one is wrong.");
    /// An unlikely map.
    MARKS_ODD = warning(Spoils, Shape, "marks/odd", "The map of the registration marks turns or skews the drawing by more than 5 degrees or stretches it by more than a twentieth, or the marker reaches far beyond the marks.", "It fits the marks all the same: they may be in another unit, or of another drawing. Far beyond the marks their errors grow. Compare one part with a ruler before the first cut.");
    /// A map, and something else that moves the drawing.
    MARKS_SHEET = error(Shape, "marks/sheet", "`--map` says where the drawing lies, and a key of `sheet`, the file or the row of a pattern set lays it as well.", "Two answers to where the cloth lies would cut beside it. Leave the keys of `sheet` out.\n  cutc compile marker.cut --map marks.csv");
    // Flow cutting.
    /// No cut.
    FLOW_NOTHING = error(Shape, "flow/nothing-to-cut", "The marker holds nothing that a head over a conveyor could cut.", "Heads cut lines; a file of holes, labels or events has none. Look at what is in it.\n  cutc info marker.cut");
    /// Requests that heads do not carry out.
    FLOW_LEFT_OUT = warning(Spoils, Shape, "flow/left-out", "Something in the file is not made on the conveyor: holes, stops, advances; the message says what and how many.", "The parts come off the conveyor without it. Drill them elsewhere, or cut this marker on a table.\n  cutc compile marker.cut");
    /// More than the machine has.
    FLOW_INFEASIBLE = error(Shape, "flow/infeasible", "The machine cannot cut the marker at this speed of the conveyor; the message says what it takes, the hints what would help, each with its figure.", "A head that comes too late would leave a stretch uncut that is gone for good. Slow the conveyor down, give heads more travel along the feed (`flow.travel_mm`), or take more heads and rows.\n  cutc flow marker.cut -p flow.toml --speed max -o out");
    /// Off the conveyor.
    FLOW_OFF_TABLE = error(Shape, "flow/off-table", "A head would leave the table across the feed (`table.y_mm`).", "There it has no cloth to cut and runs into its end. Move the marker across (`sheet.origin`), or mend the key.");
    /// The program breaks a rule.
    FLOW_BROKEN = error(Shape, "flow/broken", "The programs of the heads, read back, break a rule; the message names the rule, the worst value, the limit, the head and the row.", "Nothing is written: cloth would be spoilt. Please report the file: a marker that is planned should be cut as it is.");

    // Machine profile.
    /// The TOML is broken.
    PROFILE_SYNTAX = error(Text, "profile/syntax", "The profile is not valid TOML.", "TOML wants a key, an equals sign and a value on a line; text stands in quotes. `cutc profile init` prints a profile that is right.\n  knife.width_mm = 7.2");
    /// A key that does not exist.
    PROFILE_UNKNOWN_KEY = error(Text, "profile/unknown-key", "The profile has a key that does not exist; the message names the nearest one.", "A mistyped key would leave the default in force without a word, and the knife would be of another width than you think. Take the name that the message suggests.");
    /// A value of the wrong type.
    PROFILE_TYPE = error(Text, "profile/type", "A value of the profile has the wrong type.", "A number in quotes, or text where a number belongs. The message says what the key takes.\n  knife.width_mm = 7.2     and not \"7.2\"");
    /// A value out of its range.
    PROFILE_RANGE = error(Text, "profile/range", "A value of the profile is out of its range.", "No machine has such a value: a comma may have slipped, or the unit is another. The message gives the range; the unit stands in the name of the key.");
}
