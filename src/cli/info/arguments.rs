//! Arguments of `cutc info`, and the figures that they select.

use std::path::PathBuf;

use clap::Args;

use crate::cli::batch::{Cloth, Figures, Threads};
use crate::cli::choices::Sheet;
use crate::cli::finished::Finished;
use crate::cli::options::{LeftOut, Messages, NO_HEADING, Reading};
use crate::cli::price::Pricing;
use crate::ir::Marker;
use crate::machine::Job;
use crate::pipeline::{self, Report, significant};
use crate::units::MM2_PER_M2;
use crate::units::quantity::value_in;

/// Significant digits of areas and costs, far below anything that is measured or paid.
pub(super) const DIGITS: i32 = 9;

/// Arguments of `cutc info`.
///
/// Of one file it says all. Of several it gives a row a file and their sum, with the time of the program that each would
/// become; the files that failed come last.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Cutter files to look into, folders of such, or patterns as 'in/**/*.cut'; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,

    #[command(flatten)]
    pub(super) reading: Reading,

    #[command(flatten)]
    left_out: LeftOut,

    #[command(flatten)]
    pub(super) messages: Messages,

    #[command(flatten)]
    pub(super) threads: Threads,

    /// Also list the labels of each piece: place, angle, text, and the fields of the list behind M0
    ///
    /// Of one file only. Texts that are no UTF-8 are read in the encoding `labels.encoding` of the profile, as in `--set
    /// labels.encoding=windows-1251`.
    #[arg(long, help_heading = NO_HEADING)]
    pub(super) labels: bool,

    /// Also plan the program: what it takes, piece by piece, and what keeps it from being faster
    ///
    /// Nothing is written and nothing is verified. Of several files the time is always given, as one number.
    #[arg(long, help_heading = NO_HEADING)]
    pub(super) time: bool,

    /// Width of the cloth, as in `--cloth-width 1500` (mm) or `--cloth-width 1.5m`: how much of it is used follows from it
    ///
    /// Without it the cloth is as wide as what is cut; it is always as long as that.
    #[arg(long, value_name = "MM", value_parser = width, help_heading = "Costs")]
    pub(super) cloth_width: Option<f64>,

    #[command(flatten)]
    pub(super) pricing: Pricing,

    /// How to give the figures
    ///
    /// JSON of one file has the keys of `cutc compile`, `profile` and `knife` among them, with null for what only
    /// planning knows, and `notch_depths`, `speeds`, `events` and the area of the parts; with --labels also
    /// `labels_by_piece`, with --time what planning knows, and `time_by_piece`. JSON of several is `files`, a list, and
    /// their `sum`. CSV is a header and a row a file.
    #[arg(long, value_enum, default_value = "text", help_heading = NO_HEADING)]
    pub(super) format: Sheet,
}

/// Parses a width. A plain number is in mm; other units are written out.
fn width(text: &str) -> Result<f64, String> {
    let mm = text.parse().ok().or_else(|| value_in(text, "mm").ok());
    mm.filter(|mm: &f64| mm.is_finite() && *mm > 0.0)
        .ok_or_else(|| "a width is a length above 0, as in 1500 (mm), 150cm or 60in".to_owned())
}

impl Arguments {
    /// The job, or the faults of its profile.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        Ok(self.reading.job()?.map(|job| self.left_out.of(job)))
    }

    /// Figures of a marker beyond its report. A marker with errors has no area.
    pub(super) fn figures(&self, marker: Option<&Marker>, report: &Report, job: &Job) -> Figures {
        let [length_mm, height_mm] = report.extent_mm;
        Figures {
            notches: report.notches.by_kind().iter().map(|(_, count)| count).sum(),
            area_m2: marker.and_then(|marker| pipeline::area(marker, &job.profile)).map(|area| area / MM2_PER_M2),
            cloth: Cloth { length_mm, width_mm: self.cloth_width.unwrap_or(height_mm) },
        }
    }

    /// A warning if a file needs more cloth than there is; otherwise empty.
    pub(super) fn doubts(&self, name: &str, report: &Report) -> String {
        let [_, height] = report.extent_mm;
        let Some(width) = self.cloth_width.filter(|width| height > *width) else { return String::new() };
        format!(
            "warning: `{name}` is {} mm wide, more than the {} mm of the cloth\n  = hint: name the width of the cloth \
             that it is made for with --cloth-width\n",
            significant(height, DIGITS),
            significant(width, DIGITS)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_is_millimetres_or_has_a_unit() {
        for text in ["1500", "150cm", "1.5 m", "1500.0"] {
            assert_eq!(width(text), Ok(1500.0), "{text}");
        }
        for text in ["0", "-3", "inf", "NaN", "wide", "3kg", ""] {
            assert!(width(text).expect_err("refused").contains("1500"), "{text}");
        }
    }
}
