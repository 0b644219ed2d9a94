//! Checks of all invariants of marker, toolpath, arcs and motion. They collect every violation instead of stopping at the
//! first.

use super::arcs::{Arc, Arcs, Piece};
use super::marker::{Marker, Notch};
use super::motion::{Motion, Poses};
use super::toolpath::{Pose, Run, Step, Toolpath};
use crate::geom::Point;

/// Violations, one sentence each; empty when the form is sound.
pub type Faults = Vec<String>;

/// Checks a marker as it is after the pass `weld`.
pub fn marker(marker: &Marker) -> Faults {
    let mut faults = Faults::new();
    let mut owners = std::collections::HashSet::new();
    for (i, piece) in marker.pieces.iter().enumerate() {
        for (k, contour) in piece.contours.iter().enumerate() {
            let name = format!("piece {} contour {}", i + 1, k + 1);
            if !marker.list.is_linked(contour.range) {
                faults.push(format!("{name}: its links do not agree"));
                continue;
            }
            let segments: Vec<_> = marker.list.walk(contour.range).collect();
            for (id, segment) in &segments {
                if !owners.insert(*id) {
                    faults.push(format!("{name}: a segment belongs to two contours"));
                }
                if !(finite(segment.from) && finite(segment.to)) {
                    faults.push(format!("{name}: a point is not finite"));
                }
                if segment.from == segment.to {
                    faults.push(format!("{name}: a segment has no length"));
                }
            }
            let meets = segments.first().map(|s| s.1.from) == segments.last().map(|s| s.1.to);
            if meets != contour.closed {
                faults.push(format!(
                    "{name}: closed is {} but its ends {}",
                    contour.closed,
                    if meets { "meet" } else { "do not meet" }
                ));
            }
        }
        for notch in &piece.outline_notches {
            let word = notch.word();
            if !(finite(notch.tip) && notch.mouth.into_iter().all(finite)) {
                faults.push(format!("piece {}: a notch of an outline ({word}) is not finite", i + 1));
            } else if notch.depth() == 0.0 || notch.width() == 0.0 || notch.segments < 2 {
                faults.push(format!("piece {}: a notch of an outline ({word}) has no depth or no width", i + 1));
            }
        }
        let mut strokes = piece.notches.iter().flat_map(Notch::strokes);
        if strokes.any(|s| !finite(s.from) || !finite(s.to)) || piece.drills.iter().any(|d| !finite(d.at)) {
            faults.push(format!("piece {}: a notch or drill is not finite", i + 1));
        }
    }
    faults.extend(cut_faults(marker));
    faults
}

fn cut_faults(marker: &Marker) -> Faults {
    let mut faults = Faults::new();
    let pieces = marker.pieces.len() as u32;
    for (i, cut) in marker.cuts.iter().enumerate() {
        let mut wrong = |what: &str| faults.push(format!("cut {}: {what}", i + 1));
        if cut.piece >= pieces || cut.sides.iter().flatten().any(|&part| part >= pieces) {
            wrong("there is no such piece");
        }
        if !marker.list.is_linked(cut.range) {
            wrong("its links do not agree");
            continue;
        }
        let [start, end] = marker.list.ends_of(cut.range);
        if (start == end) != cut.kind.is_closed() {
            wrong("its ends do not agree with its kind");
        }
    }
    if !marker.cuts.is_sorted_by_key(|cut| cut.piece) {
        faults.push("the cuts do not come in the order of their pieces".to_owned());
    }
    faults
}

/// Checks a toolpath as it is after all toolpath passes.
pub fn toolpath(toolpath: &Toolpath) -> Faults {
    let mut faults = Faults::new();
    for (i, step) in toolpath.steps.iter().enumerate() {
        let wrong = |what: &str| format!("step {}: {what}", i + 1);
        match step {
            Step::Run(run) => faults.extend(run_faults(run).into_iter().map(wrong)),
            Step::PlungeCut(plunge_cut) => {
                if plunge_cut.points.len() < 2 || plunge_cut.spans.len() + 1 != plunge_cut.points.len() {
                    faults.push(wrong("a plunge cut needs a span a chord"));
                }
                let overcuts = plunge_cut.overcut.iter().flat_map(|overcut| [overcut.own, overcut.other]);
                if !overcuts.chain([plunge_cut.front, plunge_cut.heel]).all(|length| length >= 0.0) {
                    faults.push(wrong("an overlap is negative"));
                }
                if (plunge_cut.along.norm() - 1.0).abs() > UNIT_EPSILON || !pose_finite(plunge_cut.pose) {
                    faults.push(wrong("a plunge cut needs a unit direction and a finite pose"));
                }
            }
            Step::Turn(air) | Step::Travel(air) => {
                if !pose_finite(air.from) || !pose_finite(air.to) {
                    faults.push(wrong("an end is not finite"));
                }
            }
            Step::Drill(drill) => {
                if !finite(drill.at) || !(1..=4).contains(&drill.tool) {
                    faults.push(wrong("a drill needs a finite place and a tool of 1 to 4"));
                }
            }
            Step::Event(_) => {}
        }
    }
    faults
}

/// Permitted deviation of a unit vector from length 1: a few roundings.
const UNIT_EPSILON: f64 = 1e-9;

fn run_faults(run: &Run) -> Vec<&'static str> {
    let mut faults = Vec::new();
    let chords = run.points.len().saturating_sub(1);
    if chords == 0 || [run.spans.len() + 1, run.feeds.len() + 1, run.joints.len()] != [chords + 1; 3] {
        faults.push("a run needs a span and a speed a chord, and a joint a point");
    }
    if ![0, chords].contains(&run.junctions.len()) {
        faults.push("a run marks every chord as a junction or not, or none");
    }
    if run.points.iter().any(|&p| !finite(p)) || !pose_finite(run.start) || !pose_finite(run.end) {
        faults.push("a number is not finite");
    }
    if run.points.windows(2).any(|w| w[0] == w[1]) {
        faults.push("a chord has no length");
    }
    if !(run.front >= 0.0 && run.heel >= 0.0) {
        faults.push("an overlap is negative");
    }
    if run.feeds.iter().any(|feed| feed.is_nan() || *feed <= 0.0) {
        faults.push("the speed cap is not positive");
    }
    faults
}

/// Relative tolerance for the ends of an arc, and for the length of a piece: a few roundings, for arcs with little curvature.
const ARC_EPSILON: f64 = 1e-6;

/// Checks the arcs of a toolpath.
pub fn arcs(arcs: &Arcs, toolpath: &Toolpath) -> Faults {
    let mut faults = Faults::new();
    let cuts = toolpath.steps.iter().filter(|step| matches!(step, Step::Run(_) | Step::PlungeCut(_))).count();
    if arcs.paths.len() != cuts {
        faults.push(format!("{} paths, but {cuts} runs and plunge cuts", arcs.paths.len()));
    }
    for (i, path) in arcs.paths.iter().enumerate() {
        let mut from = path.start;
        for (k, piece) in path.pieces.iter().enumerate() {
            let wrong = piece_fault(from, piece);
            faults.extend(wrong.map(|wrong| format!("path {} piece {}: {wrong}", i + 1, k + 1)));
            from = piece.to;
        }
        if !pose_finite(path.start) {
            faults.push(format!("path {}: a number is not finite", i + 1));
        }
    }
    faults
}

fn piece_fault(from: Pose, piece: &Piece) -> Option<&'static str> {
    let chord = (piece.to.centre - from.centre).norm();
    let length = match piece.arc {
        None => chord,
        Some(Arc { centre, turn }) => {
            let [start, end] = [from, piece.to].map(|pose| (pose.centre - centre).norm());
            if (start - end).abs() > ARC_EPSILON * (1.0 + start) {
                return Some("the ends of its arc lie at two distances from the centre");
            }
            start * turn.abs()
        }
    };
    if !pose_finite(piece.to) || !piece.length.is_finite() {
        Some("a number is not finite")
    } else if (piece.length - length).abs() > ARC_EPSILON * (1.0 + length) {
        Some("its length is not that of its way")
    } else if piece.feed.is_nan() || piece.feed <= 0.0 || piece.speed.is_nan() || piece.speed < 0.0 {
        Some("the speed cap is not positive")
    } else {
        None
    }
}

/// Checks a motion.
pub fn motion(motion: &Motion) -> Faults {
    let mut faults = Faults::new();
    for (i, phase) in motion.phases.iter().enumerate() {
        if phase.ticks == 0 {
            faults.push(format!("phase {}: it has no ticks", i + 1));
        }
        let is_whole = match &phase.poses {
            Poses::Samples(poses) => poses.len() == phase.ticks as usize,
            Poses::Still(_) | Poses::StraightCut(_) | Poses::Glide(_) => true,
        };
        if !is_whole {
            faults.push(format!("phase {}: it has not a pose for each of its {} ticks", i + 1, phase.ticks));
        } else if !phase.setpoints().all(|(pose, _)| pose_finite(pose)) {
            faults.push(format!("phase {}: a pose is not finite", i + 1));
        }
    }
    faults
}

fn finite(point: Point) -> bool {
    point.x.is_finite() && point.y.is_finite()
}

fn pose_finite(pose: Pose) -> bool {
    finite(pose.centre) && pose.c.0.is_finite()
}
