//! Toolpaths of a marker after all passes, in windows.

use rayon::prelude::*;

use super::sound::assert_sound;
use crate::analysis::cloth::Cloth;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Pose, Step};
use crate::ir::{Marker, Toolpath, check};
use crate::machine::{Job, Mode};
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES, ToolpathPass, frame, trace};
use crate::plan;

/// Number of toolpaths in a window, one per stage: enough to keep all cores busy, few enough to keep memory small.
const WINDOW: usize = 128;

/// Producer of toolpaths in cut order.
pub(super) struct Toolpaths<'a> {
    raw: Box<dyn Iterator<Item = Toolpath> + Send + 'a>,
    /// Context of the passes; `None` if there is nothing to pass.
    scene: Option<Scene<'a>>,
    /// Pose at the start of the first one.
    home: Pose,
}

/// Consecutive toolpaths, and the findings of their passes.
pub(super) struct Window {
    pub(super) toolpaths: Vec<Toolpath>,
    /// Cut of the marker to which each belongs, if any.
    pub(super) cuts: Vec<Option<u32>>,
    /// Findings of each.
    pub(super) findings: Vec<Diagnostics>,
}

/// First stage: processes each toolpath by itself.
pub(super) struct Drawing<'t, 'a> {
    raw: &'t mut Box<dyn Iterator<Item = Toolpath> + Send + 'a>,
    scene: Option<&'t Scene<'a>>,
    /// Number of cuts made so far.
    cuts: u32,
}

/// Second stage: processes toolpaths in sequence.
pub(super) struct Linking<'t, 'a> {
    scene: Option<&'t Scene<'a>>,
    /// Pose at the end of the last one.
    pose: Pose,
}

impl<'a> Toolpaths<'a> {
    /// Toolpaths of a job over a marker; none is made yet.
    pub(super) fn new(marker: &'a Marker, job: &'a Job) -> Self {
        let home = plan::home_over(marker.moved_on, job);
        if job.mode == Mode::Frame {
            let frame = frame(marker, home, job);
            assert_sound("frame", || check::toolpath(&frame));
            return Self { raw: Box::new(std::iter::once(frame)), scene: None, home };
        }
        let scene = Scene::new(marker, job);
        Self { raw: Box::new(trace(marker, job)), scene: Some(scene), home }
    }

    /// Both stages; they work on different toolpaths at the same time.
    pub(super) fn stages(&mut self) -> (Drawing<'_, 'a>, Linking<'_, 'a>) {
        let scene = self.scene.as_ref();
        (Drawing { raw: &mut self.raw, scene, cuts: 0 }, Linking { scene, pose: self.home })
    }
}

impl Drawing<'_, '_> {
    /// Next window; `None` at the end.
    pub(super) fn next(&mut self) -> Option<Window> {
        let mut toolpaths: Vec<Toolpath> = self.raw.by_ref().take(WINDOW).collect();
        if toolpaths.is_empty() {
            return None;
        }
        let Some(scene) = self.scene else {
            return Some(Window { cuts: vec![None; toolpaths.len()], toolpaths, findings: Vec::new() });
        };
        let cuts = toolpaths.iter().map(|toolpath| self.next_cut(toolpath)).collect();
        let by_itself = |toolpath: &mut Toolpath| {
            let mut found = Diagnostics::default();
            run(passes()[0], toolpath, scene, &mut found);
            found
        };
        let findings = toolpaths.par_iter_mut().map(by_itself).collect();
        Some(Window { toolpaths, cuts, findings })
    }

    /// Cut to which the next raw toolpath belongs.
    fn next_cut(&mut self, toolpath: &Toolpath) -> Option<u32> {
        let is_cut = matches!(toolpath.steps[..], [Step::Run(_)]);
        let cut = self.cuts;
        self.cuts += u32::from(is_cut);
        is_cut.then_some(cut)
    }
}

impl<'t, 'a> Linking<'t, 'a> {
    /// Cloth on which they lie; `None` if nothing is cut.
    pub(super) fn cloth(&self) -> Option<&'t Cloth<'a>> {
        self.scene.map(|scene| &scene.cloth)
    }

    /// Finishes the next window.
    pub(super) fn link(&mut self, mut window: Window) -> Window {
        let Some(scene) = self.scene else { return window };
        for (toolpath, found) in window.toolpaths.iter_mut().zip(&mut window.findings) {
            toolpath.entry = self.pose;
            run(passes()[1], toolpath, scene, found);
            self.pose = toolpath.exit();
        }
        window
    }
}

/// Passes that process a toolpath by itself, and those from the first one on that depends on the previous toolpath.
fn passes() -> [&'static [ToolpathPass]; 2] {
    let chained = TOOLPATH_PASSES.iter().position(|pass| pass.chained).unwrap_or(TOOLPATH_PASSES.len());
    let (alone, chained) = TOOLPATH_PASSES.split_at(chained);
    [alone, chained]
}

fn run(passes: &[ToolpathPass], toolpath: &mut Toolpath, scene: &Scene, found: &mut Diagnostics) {
    for pass in passes {
        (pass.run)(toolpath, scene, found);
        assert_sound(pass.name, || check::toolpath(toolpath));
    }
}
