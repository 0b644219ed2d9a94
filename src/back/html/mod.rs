//! Target `html`: a page that plays the cutting of a marker and reports on it, for a browser without a network.
//!
//! The page holds the path of the axes as cubic pieces that keep within 0.01 mm of the setpoints of `csv`, the lines of the
//! cloth, and least and greatest speed, acceleration and jerk in short stretches of time. Its script draws them; the report
//! below is plain markup that is read and printed without it.

mod about;
mod drawn;
mod facts;
mod fit;
mod peaks;
mod piece;
mod record;
mod report;

use std::io;

use super::target::{Context, Emit, Outcome, Output, PageWriter, Target};
use crate::ir::Motion;
use crate::picture::{Columns, Page, Script};
use about::About;
use drawn::Lines;
use record::Record;

pub(super) const TARGET: Target = Target {
    name: "html",
    about: "a page for a browser: plays the cutting, shows speeds and limits, and reports",
    extension: "html",
    emit: Emit::Page(begin),
    proof: None,
};

/// A page under construction.
struct Writer<'a> {
    context: Context<'a>,
    record: Record,
}

fn begin<'a>(context: &Context<'a>) -> Box<dyn PageWriter + 'a> {
    let record = Record::new(&context.job.profile, context.marker.pieces.len());
    Box::new(Writer { context: *context, record })
}

impl PageWriter for Writer<'_> {
    fn take(&mut self, motion: &Motion) {
        self.record.take(motion);
    }

    fn write(&mut self, outcome: Outcome, out: &mut dyn Output) -> io::Result<()> {
        let context = &self.context;
        let pieces = piece::pieces(context, &self.record, outcome);
        let (mut columns, lines) = (Columns::default(), Lines::of(context));
        let about = About { context, record: &self.record, outcome, pieces: &pieces };
        let (title, body, facts) = (about.title(), report::body(&about), facts::facts(&about, &lines.classes));
        self.record.write(&mut columns);
        lines.write(&mut columns);
        Page { title, body, facts, columns, script: Script::Cutting }.write(out)
    }
}
