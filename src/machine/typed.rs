//! Options of a job, as the command line has them.

use std::path::Path;

use super::patterns::Quantity;
use super::plot::Inner;
use super::{Job, Mode, Selection};
use crate::source::Source;

impl Job {
    /// The choice of the job as options of the command line; empty if everything is cut.
    pub fn typed(&self) -> String {
        let Selection { pieces, skip, resume_from, bites } = &self.selection;
        let mut words = Vec::new();
        words.extend(self.lines.pens.iter().map(|numbers| format!("--cut-pens {numbers}")));
        words.extend(self.lines.layers.iter().map(|layers| format!("--layers {layers}")));
        words.extend(self.lines.inner.iter().map(|inner| {
            let name = match inner {
                Inner::Ignore => "ignore",
                Inner::Cut => "cut",
                Inner::All => "all",
            };
            format!("--inner {name}")
        }));
        words.extend(self.lines.all.then(|| "--cut-all".to_owned()));
        words.extend(self.patterns.sizes.iter().map(|sizes| format!("--size {sizes}")));
        words.extend(self.patterns.quantity.iter().map(|quantity| {
            let name = match quantity {
                Quantity::File => "file",
                Quantity::One => "one",
            };
            format!("--quantity {name}")
        }));
        words.extend(pieces.iter().map(|numbers| format!("--pieces {numbers}")));
        words.extend(skip.iter().map(|numbers| format!("--skip {numbers}")));
        words.extend(resume_from.iter().map(|number| format!("--resume-from {number}")));
        words.extend(bites.iter().map(|numbers| format!("--bites {numbers}")));
        words.extend(self.centre.iter().map(|centre| format!("--centre {}", file_name(&centre.source))));
        words.extend(self.marks.iter().map(|marks| format!("--map {}", file_name(marks.source()))));
        match self.mode {
            Mode::Cut => {}
            Mode::Dry => words.push("--dry-run".to_owned()),
            Mode::Frame => words.push("--frame".to_owned()),
        }
        words.join(" ")
    }
}

/// The name of a file without its directory.
pub fn file_name(source: &Source) -> String {
    let name = Path::new(source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
    name.unwrap_or_else(|| source.name().to_owned())
}
