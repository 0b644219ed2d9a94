//! Untimed actions of the machine: needle points in order, and the events between them.

use crate::geom::Point;

/// Action of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Op {
    /// The cloth moves, then the needle pierces it: one turn of the spindle.
    Stitch,
    /// The cloth moves with the needle up.
    Jump,
    /// The thread is cut.
    Trim,
    /// The machine waits for its operator.
    Stop,
    /// The thread is changed, to the one with this number.
    Color(u16),
}

impl Op {
    /// True if the action ends a run of stitches.
    pub fn ends_run(self) -> bool {
        match self {
            Self::Stitch => false,
            Self::Jump | Self::Trim | Self::Stop | Self::Color(_) => true,
        }
    }
}

/// An entry of the sewing sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Action of the entry.
    pub op: Op,
    /// Needle position after it, mm; the first entry starts from the origin.
    pub to: Point,
    /// True if it locks the thread: such a stitch may be short or have no length.
    pub is_tie: bool,
    /// Block, row or record of the file that it comes from, from 1; 0 if there is none.
    pub record: u32,
}

/// The sewing sequence of a pattern.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stitches {
    /// All entries, in order.
    pub steps: Vec<Step>,
}

impl Stitches {
    /// Each entry with the needle position before it.
    pub fn moves(&self) -> impl Iterator<Item = (Point, &Step)> {
        let before = std::iter::once(Point::origin()).chain(self.steps.iter().map(|step| step.to));
        before.zip(&self.steps)
    }

    /// Number of stitches.
    pub fn count(&self) -> usize {
        self.steps.iter().filter(|step| step.op == Op::Stitch).count()
    }

    /// Range of entries of each run of stitches.
    pub fn runs(&self) -> Vec<std::ops::Range<usize>> {
        let mut runs = Vec::new();
        let mut first = None;
        for (i, step) in self.steps.iter().enumerate() {
            match (step.op.ends_run(), first) {
                (true, Some(start)) => {
                    runs.push(start..i);
                    first = None;
                }
                (false, None) => first = Some(i),
                (true, None) | (false, Some(_)) => {}
            }
        }
        runs.extend(first.map(|start| start..self.steps.len()));
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_ends_at_whatever_is_no_stitch() {
        let step = |op| Step { op, to: Point::origin(), is_tie: false, record: 0 };
        let ops = [Op::Jump, Op::Stitch, Op::Stitch, Op::Color(2), Op::Stop, Op::Stitch, Op::Trim, Op::Stitch];
        let stitches = Stitches { steps: ops.into_iter().map(step).collect() };
        assert_eq!(stitches.runs(), [1..3, 5..6, 7..8]);
        assert_eq!(stitches.count(), 4);
    }
}
