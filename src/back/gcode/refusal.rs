//! Holes, events and runs that a G-code program cannot express, with the reasons.

use crate::back::target::Context;
use crate::diagnostic::{Diagnostic, code};
use crate::ir::arcs::{Reason, Unfit};
use crate::ir::marker::Drill;
use crate::ir::toolpath::Event;
use crate::machine::{Job, Mode, gcode};
use crate::units::number::fixed;

/// Decimals of places in messages.
const PLACE_DECIMALS: u32 = 3;
/// The only drill of a profile whose steps have no placeholder for a number.
const ONLY_DRILL: u8 = 1;

/// Diagnostics for the holes and events that the steps of the profile cannot express.
pub(super) fn refusals(context: &Context) -> Vec<Diagnostic> {
    let Context { marker, job, .. } = *context;
    match job.mode {
        // Nothing is drilled and no event is written.
        Mode::Frame => Vec::new(),
        Mode::Cut | Mode::Dry => {
            let of_pieces = marker.pieces.iter().flat_map(|piece| {
                let events = piece.events.iter().filter_map(|event| unsaid_event(event.kind, job));
                events.chain(piece.drills.iter().filter_map(|drill| unsaid_drill(drill, job)))
            });
            of_pieces.chain(marker.closing.iter().filter_map(|event| unsaid_event(event.kind, job))).collect()
        }
    }
}

/// Diagnostic for a run that cannot be written as arcs and lines.
pub(super) fn unfit(unfit: &Unfit) -> Diagnostic {
    let refused = |message: &str| Diagnostic::new(&code::TARGET_REFUSED, message).at(unfit.span);
    match unfit.reason {
        Reason::Band(at) => {
            let (x, y) = (fixed(at.x, PLACE_DECIMALS), fixed(at.y, PLACE_DECIMALS));
            refused("no arc or line stays within the tolerance")
                .hint(format!("the place is X {x} Y {y} mm"))
                .hint("a larger path.tolerance_mm or a smaller corner.angle_deg helps; the target csv needs no arcs")
        }
        Reason::Chord => {
            refused("the target gcode lays the blade along the tangent of curves only, not as a chord of them")
                .hint("set `knife.follow = \"tangent\"`, or take a target with setpoints, such as csv")
        }
    }
}

/// Diagnostic for a hole that the steps of the profile cannot express; `None` when they can.
fn unsaid_drill(drill: &Drill, job: &Job) -> Option<Diagnostic> {
    let keys = &job.profile.gcode;
    let refused = |message: String, hint: &str| {
        Some(Diagnostic::new(&code::TARGET_REFUSED, message).at(drill.span).hint(hint)).filter(|_| job.mode.cuts())
    };
    for (key, steps) in [("gcode.drill_down", &keys.drill_down), ("gcode.drill_up", &keys.drill_up)] {
        if steps.is_empty() {
            return refused(
                format!("`{key}` has no step, but the file drills"),
                "give its steps, such as [\"M64 P#\"]",
            );
        }
    }
    let tool = drill.tool;
    if tool != ONLY_DRILL && !keys.drill_down.iter().any(gcode::Step::has_blank) {
        let message = format!("`gcode.drill_down` tells no drills apart, but the file asks for drill {tool}");
        return refused(message, "put # where the number of the drill belongs, as in M64 P#");
    }
    None
}

/// Diagnostic for an event that the steps of the profile cannot express; `None` when they can.
fn unsaid_event(event: Event, job: &Job) -> Option<Diagnostic> {
    let keys = &job.profile.gcode;
    let (key, steps, asks, hint) = match event {
        Event::Stop => ("gcode.stop", &keys.stop, "stops for the operator", "give its steps, such as [\"M0\"]"),
        Event::Advance if keys.advance.iter().any(gcode::Step::has_blank) => {
            let message = "`gcode.advance` says how far, and the file does not";
            let hint = "say what the table holds, so that its windows are laid: `bite.length_mm`";
            return Some(Diagnostic::new(&code::TARGET_REFUSED, message).hint(hint));
        }
        Event::Advance => ("gcode.advance", &keys.advance, "advances the cloth", "give its steps, such as [\"M1\"]"),
        Event::AdvanceBy(_) if keys.advance.first().is_some_and(|step| !step.has_blank()) => {
            let message = "`gcode.advance` does not say how far, but the marker is cut in bites";
            let hint = "put # where the mm belong, as in [\"M68 E0 Q#\", \"M64 P1\", \"M66 P1 L3 Q60\"]";
            return Some(Diagnostic::new(&code::TARGET_REFUSED, message).hint(hint));
        }
        Event::AdvanceBy(_) => {
            let hint = "give its steps, such as [\"M68 E0 Q#\", \"M64 P1\", \"M66 P1 L3 Q60\"]";
            ("gcode.advance", &keys.advance, "is cut in bites", hint)
        }
    };
    let message = || format!("`{key}` has no step, but the file {asks}");
    steps.is_empty().then(|| Diagnostic::new(&code::TARGET_REFUSED, message()).hint(hint))
}
