//! Every rule that programs of heads over a conveyor are judged by.

use crate::ir::finding::RuleRow;

/// A rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// Everything can be read.
    Format,
    /// The plan names the heads of the machine.
    Plan,
    /// Rows come period by period.
    Period,
    /// The conveyor's position is its speed times the time.
    Conveyor,
    /// Rows stand where the profile has them.
    Station,
    /// Heads stay within their travel along the feed.
    Travel,
    /// Heads stay on the table across the feed.
    Across,
    /// C stays in its range.
    Range,
    /// Speeds.
    Speed,
    /// Accelerations.
    Acceleration,
    /// Jerks.
    Jerk,
    /// Heads of a row stay apart.
    Distance,
    /// The blade goes down and up at rest in the cloth.
    Rest,
    /// The blade is down before it comes up.
    Dwell,
    /// The blade is up before it goes down again.
    Up,
    /// Programs begin and end at rest, knife up.
    Ends,
    /// Every stroke follows a cut.
    Stray,
    /// The blade stays on its line.
    Deviation,
    /// The blade lies along its line.
    Heading,
    /// The blade is not too fast.
    Feed,
    /// The blade does not stand in the cloth.
    Crawl,
    /// Nothing is left uncut.
    Uncut,
    /// Nothing is cut twice.
    Twice,
    /// Strokes overlap where one takes over from another.
    Overlap,
    /// Cuts end where they should.
    Overcut,
    /// Rows name the block that is cut.
    Block,
}

/// What is said of a rule.
pub(super) type Row = RuleRow<Rule>;

/// Every rule, in the order of reports.
#[rustfmt::skip] // a table: a rule a row
pub const RULES: &[Row] = &[
    Row { rule: Rule::Format, name: "flow-verify/format", unit: "", about: "the plan and every row or record can be read, all heads to the same end", more: "A controller that meets a bad row stops a head with its knife in cloth that moves on." },
    Row { rule: Rule::Plan, name: "flow-verify/plan", unit: "", about: "the plan names no more heads, rows and speed than the machine has", more: "The value is how many heads are too many, and how many name a row that is none; a conveyor that is faster than `flow.max_speed_mm_s` counts as one more." },
    Row { rule: Rule::Period, name: "flow-verify/period", unit: "s", about: "rows follow each other by the period of the controller, from 0 on", more: "A row that is missing is a jump of an axis; the value is the greatest error of a time." },
    Row { rule: Rule::Conveyor, name: "flow-verify/conveyor", unit: "mm", about: "the conveyor's position in a row is its speed times the time of the row", more: "An encoder-driven controller takes a row when the conveyor is there. Were it elsewhere, the head would cut beside its line by the difference, which is the value." },
    Row { rule: Rule::Station, name: "flow-verify/station", unit: "mm", about: "every row of heads stands where `flow.first_row_mm` and `flow.row_pitch_mm` have it", more: "All that a row cuts is displaced along the feed by an error of its station, which is the value." },
    Row { rule: Rule::Travel, name: "flow-verify/travel", unit: "mm", about: "no head leaves its travel along the feed, 0 to `flow.travel_mm`", more: "The value is by how much it does: there the axis runs into its end, knife down." },
    Row { rule: Rule::Across, name: "flow-verify/across", unit: "mm", about: "no head leaves the table across the feed (`table.y_mm`)", more: "Beyond the table there is no cloth to cut, and the axis runs into its end, with all that is behind it. The value is by how much a head leaves it." },
    Row { rule: Rule::Range, name: "flow-verify/c-range", unit: "deg", about: "C stays within `c.range_deg`", more: "Beyond it the cables of the head wind up. The value is by how much it leaves it." },
    Row { rule: Rule::Speed, name: "flow-verify/speed", unit: "", about: "no axis of a head is faster than its limit", more: "The value is the greatest speed in parts of its limit; along the feed the head's own, over the table. Above 1 the drive falls behind." },
    Row { rule: Rule::Acceleration, name: "flow-verify/acceleration", unit: "", about: "no axis of a head accelerates more than its limit", more: "The value is the greatest acceleration in parts of its limit, from the differences of three rows." },
    Row { rule: Rule::Jerk, name: "flow-verify/jerk", unit: "", about: "no axis of a head has more jerk than its limit", more: "The value is the greatest jerk in parts of its limit, from the differences of four rows." },
    Row { rule: Rule::Distance, name: "flow-verify/distance", unit: "mm", about: "heads of one row are never nearer to each other than `flow.head_width_mm`, nor do they pass", more: "They stand on one beam, so they would collide. The value is by how much two come too near, over all rows of their programs." },
    Row { rule: Rule::Rest, name: "flow-verify/rest", unit: "mm", about: "while the blade goes down and comes out it rests in the cloth: it moves with the conveyor", more: "A blade that moves while it is half in tears the cloth. The value is the farthest that it moves in that time." },
    Row { rule: Rule::Dwell, name: "flow-verify/dwell", unit: "s", about: "the blade is all the way down before it is sent up again", more: "A drive that is turned back on its way has not gone through the cloth: a notch that is one plunge is not cut. The value is how much time is lacking (`knife.plunge_ms`)." },
    Row { rule: Rule::Up, name: "flow-verify/up", unit: "s", about: "the blade is all the way up before it is sent down again", more: "A drive that is turned back on its way leaves the blade in the cloth between two strokes. The value is how much time is lacking (`knife.lift_ms`)." },
    Row { rule: Rule::Ends, name: "flow-verify/ends", unit: "", about: "every program begins and ends at rest with the knife up", more: "A controller that takes a program up or leaves it in motion jerks the axes, or drags a blade through cloth. The value is how many ends do not." },
    Row { rule: Rule::Stray, name: "flow-verify/stray", unit: "mm", about: "every stroke of a head, mapped back to the cloth, follows a cut of the file", more: "A stroke that follows no line goes through parts. The value is the length of the longest such stroke." },
    Row { rule: Rule::Deviation, name: "flow-verify/deviation", unit: "mm", about: "the blade's leading end stays on the line, as it lies on the moving cloth", more: "The value is the farthest that it leaves it. What is allowed is `path.tolerance_mm` and, on curves, `path.chord_sag_max_mm`." },
    Row { rule: Rule::Heading, name: "flow-verify/heading", unit: "deg", about: "the blade lies along its line in the frame of the cloth, which the conveyor does not turn", more: "The value is the greatest angle between the blade and its way over the cloth; not over the table, where the head goes another way (`verify.max_heading_deg`)." },
    Row { rule: Rule::Feed, name: "flow-verify/feed", unit: "mm/s", about: "the blade goes along its line, over the cloth, no faster than it may there", more: "What caps it are `knife.feed_mm_s`, the feed of the piece, and what the file or the profile slows down (`slow.*`, `common.near`). The value is its speed where it is the most too fast." },
    Row { rule: Rule::Crawl, name: "flow-verify/crawl", unit: "times as long", about: "the blade stays nowhere in the cloth for long", more: "A blade that stands while it is down heats the cloth and fuses its edges. The value is the longest that it stays within a millimetre, beside what its limits and the cloth that passes by ask for." },
    Row { rule: Rule::Uncut, name: "flow-verify/uncut", unit: "mm", about: "every point of every cut is cut by some head", more: "The value is the longest stretch that none cuts: threads hold the part there." },
    Row { rule: Rule::Twice, name: "flow-verify/twice", unit: "mm", about: "no stretch is cut twice, but for the overlaps where one stroke takes over from another", more: "The value is the longest stretch that is cut twice beside those: a second blade shaves a sliver off the edge." },
    Row { rule: Rule::Overlap, name: "flow-verify/overlap", unit: "mm", about: "where one stroke takes over from another amid a line both cut on by `flow.overlap_mm`", more: "The value is by how much the shortest of these overlaps is too short. At a corner each goes on straight instead; in a bend that is too tight for the blade one head may lift it without an overlap." },
    Row { rule: Rule::Overcut, name: "flow-verify/overcut", unit: "mm", about: "strokes go on beyond the ends of cuts and corners by the overlaps of the profile at the most", more: "The value is by how much one goes too far. A blade that is longer than its cut may stand out by its length." },
    Row { rule: Rule::Block, name: "flow-verify/block", unit: "", about: "rows name a block of the cut that they follow", more: "The value is how many strokes name another one: who looks for a fault by its block would look in the wrong place." },
];

impl Rule {
    /// Its row.
    pub fn row(self) -> &'static Row {
        &RULES[self as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_has_its_row() {
        for (i, row) in RULES.iter().enumerate() {
            assert_eq!(row.rule as usize, i, "{}", row.name);
        }
        assert_eq!(RULES.len(), Rule::Block as usize + 1);
    }
}
