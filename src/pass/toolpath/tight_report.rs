//! Messages of pass `tight`: the tightest curve of a toolpath, its worst start on a curve, and their treatment.

use super::start::CurvedStart;
use super::worst::Worst;
use crate::analysis::tight::TightCurve;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::ir::toolpath::{OrientationMode, Run};
use crate::machine::{Knife, TightCurves};
use crate::source::Span;
use crate::units::number::{fixed, up};

/// Treatment of a curve that is tighter than the blade, or of a start from which the plunged blade deviates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Treatment {
    /// x
    Followed(OrientationMode),
    /// Cut by several plunges.
    Nibbled,
    /// The whole run is cut by one plunge.
    Covered,
    /// Reported as an error.
    Refused,
}

/// Findings in a toolpath.
pub(super) struct Report<'a> {
    knife: &'a Knife,
    /// Tight curves, by their radius, mm.
    curves: Worst<Seen>,
    /// Starts on curves, by the distance of the curve from the blade, mm.
    starts: Worst<Seen>,
    /// Number of plunges by which curves are nibbled.
    pub(super) plunges: usize,
}

/// Curve and its treatment.
#[derive(Debug, Clone, Copy)]
struct Seen {
    size: f64,
    span: Span,
    treatment: Treatment,
}

/// Words about a treatment.
struct Words {
    code: &'static Code,
    done: String,
    hint: &'static str,
}

impl<'a> Report<'a> {
    pub(super) fn new(knife: &'a Knife) -> Self {
        Self { knife, curves: Worst::default(), starts: Worst::default(), plunges: 0 }
    }

    /// Records a tight curve of a run.
    pub(super) fn see_curve(&mut self, curve: &TightCurve, run: &Run, treatment: Treatment) {
        let span = run.spans[curve.at % run.spans.len()];
        self.curves.see(Seen { size: curve.radius, span, treatment }, |seen| -seen.size);
    }

    /// Records a run that begins on a curve.
    pub(super) fn see_start(&mut self, start: &CurvedStart, run: &Run, treatment: Treatment) {
        self.starts.see(Seen { size: start.deviation.distance, span: run.spans[0], treatment }, |seen| seen.size);
    }

    /// Reports the worst of both.
    pub(super) fn say(&self, diagnostics: &mut Diagnostics) {
        let width = fixed(self.knife.width_mm, 2);
        if let Some(&Seen { size, span, treatment }) = self.curves.place() {
            let Words { code, done, hint } = self.about_curve(size, treatment);
            let (radius, more) = (fixed(size, 2), self.curves.and_more());
            let message =
                format!("a curve of radius {radius} mm is tighter than the blade of {width} mm: {done}{more}");
            diagnostics.push(Diagnostic::new(code, message).at(span).by(self.swing(size)).hint(hint));
        }
        if let Some(&Seen { size, span, treatment }) = self.starts.place() {
            let Words { code, done, hint } = self.about_start(treatment);
            let (away, more) = (up(size, 2), self.starts.and_more());
            let message = format!(
                "a cut begins on a curve, which bows {away} mm away from the plunged blade of {width} mm: {done}{more}"
            );
            diagnostics.push(
                Diagnostic::new(code, message)
                    .at(span)
                    .by(size)
                    .hint("a narrower blade bows less; so does a corner that is drawn where the outline is straighter")
                    .hint(hint),
            );
        }
    }

    /// Distance of the heel from a curve that it follows along the tangent, mm.
    fn swing(&self, radius: f64) -> f64 {
        radius.hypot(self.knife.width_mm) - radius
    }

    fn about_curve(&self, radius: f64, treatment: Treatment) -> Words {
        let swing = fixed(self.swing(radius), 2);
        let followed = |done: String| Words {
            code: &code::PATH_TIGHT_CURVE,
            done,
            hint: "a narrower blade leaves it less; `knife.tight_curves` is \"nibble\" for cuts by plunges, \"refuse\" for an error",
        };
        match treatment {
            Treatment::Followed(OrientationMode::Chord) => {
                followed(format!("it cannot be its chord and follows the tangent, its heel off by up to {swing} mm"))
            }
            Treatment::Followed(OrientationMode::Tangent) => {
                followed(format!("its heel leaves the line by up to {swing} mm"))
            }
            Treatment::Nibbled | Treatment::Covered => Words {
                code: &code::PATH_TIGHT_CURVE,
                done: self.nibbled(),
                hint: match self.knife.tight_curves {
                    TightCurves::Nibble => {
                        "a narrower blade can follow it; `knife.tight_curves` is \"follow\" for cuts without a lift, \"refuse\" for an error"
                    }
                    TightCurves::Follow | TightCurves::Refuse => "a narrower blade has a way to go on it",
                },
            },
            Treatment::Refused => refused(),
        }
    }

    fn about_start(&self, treatment: Treatment) -> Words {
        let (done, hint) = match treatment {
            Treatment::Followed(_) => (
                "it cuts that far beside the line".to_owned(),
                "`knife.tight_curves = \"nibble\"` cuts such starts by steps, from `knife.max_bow_mm` on",
            ),
            Treatment::Nibbled => (self.nibbled(), "a start that bows less is cut without a lift"),
            Treatment::Covered => (
                "one plunge cuts all of it, because several would reach farther into the part".to_owned(),
                "what lies between the blade and the line stays on the part, or is cut off it",
            ),
            Treatment::Refused => return refused(),
        };
        Words { code: &code::PATH_BOWED_PLUNGE, done, hint }
    }

    fn nibbled(&self) -> String {
        format!("nibbled with {} plunge{}", self.plunges, if self.plunges == 1 { "" } else { "s" })
    }
}

/// Words about a curve that `knife.tight_curves` refuses.
fn refused() -> Words {
    Words {
        code: &code::PATH_TIGHT_CURVE_REFUSED,
        done: "refused by `knife.tight_curves`".to_owned(),
        hint: "a narrower blade follows it; `knife.tight_curves` is \"follow\" or \"nibble\" for what is to be cut all the same",
    }
}
