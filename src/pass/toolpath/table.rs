//! Pass `table`: whether the knife stays over the table, its swing included.
//!
//! Needs placed steps. Changes nothing.

use super::ToolpathPass;
use super::scene::Scene;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::ir::toolpath::{Step, Toolpath};
use crate::machine::Mode;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "table", about: "finds where the knife would leave the table", run, chained: false };

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let job = scene.job;
    let table = &job.profile.table;
    if table.x_mm.is_none() && table.y_mm.is_none() {
        return;
    }
    let knife = &job.profile.knife;
    // The blade reaches this far from where its tip or its axis can be on the path.
    let swing = knife.width_mm + knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
    for step in &toolpath.steps {
        let (points, spans, reach): (&[Point], &[Span], f64) = match step {
            Step::Run(run) => (&run.points, &run.spans, swing),
            Step::Stab(stab) => (&stab.points, &stab.spans, swing),
            Step::Drill(drill) => (&[drill.at], &[drill.span], 0.0),
            // A travel ends where a run starts, but for the frame of a marker, which has no runs.
            Step::Travel(air) if job.mode == Mode::Frame => (&[air.to.centre], &[], 0.0),
            Step::Turn(_) | Step::Travel(_) | Step::Event(_) => continue,
        };
        let outside = |p: &Point| {
            let beyond = |value: f64, range: Option<[f64; 2]>| {
                range.map_or(0.0, |[least, most]| (least - (value - reach)).max(value + reach - most))
            };
            beyond(p.x, table.x_mm).max(beyond(p.y, table.y_mm))
        };
        let Some((i, by)) = points.iter().map(outside).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        if by > 0.0 {
            let code = if table.strict { &code::PATH_OFF_TABLE_STRICT } else { &code::PATH_OFF_TABLE };
            let (x, y) = (fixed(points[i].x, 2), fixed(points[i].y, 2));
            let message = format!("the knife may leave the table by {} mm at X {x} Y {y} mm", fixed(by, 2));
            let span = spans.get(i).or(spans.last()).copied();
            let finding = Diagnostic { span, ..Diagnostic::new(code, message) };
            diagnostics.push(finding.hint("move the marker on the table, or check `table` and `knife` of the profile"));
        }
    }
}
