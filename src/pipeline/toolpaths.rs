//! The toolpaths of a marker, after all passes, a window of them at a time.

use rayon::prelude::*;

use super::assert_sound;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::Pose;
use crate::ir::{Marker, Toolpath, check};
use crate::machine::{Job, Mode};
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES, ToolpathPass, check_depths, frame, trace};
use crate::plan;

/// Toolpaths that are made, planned and written at a time: enough to keep all cores busy, few enough to keep memory small.
const WINDOW: usize = 128;

/// Makes toolpaths in cut order.
pub(super) struct Toolpaths<'a> {
    raw: Box<dyn Iterator<Item = Toolpath> + Send + 'a>,
    /// What the passes look at; nothing where there is nothing to pass.
    scene: Option<Scene<'a>>,
    /// Where the last one ends.
    pose: Pose,
}

impl<'a> Toolpaths<'a> {
    /// Those of a job over a marker; none is made yet.
    pub(super) fn new(marker: &'a Marker, job: &'a Job, diagnostics: &mut Diagnostics) -> Self {
        let pose = plan::home(job);
        if job.mode == Mode::Frame {
            let frame = frame(marker, pose, job, diagnostics);
            assert_sound("frame", || check::toolpath(&frame));
            return Self { raw: Box::new(std::iter::once(frame)), scene: None, pose };
        }
        let scene = Scene::new(marker, job);
        check_depths(marker, &scene, diagnostics);
        Self { raw: Box::new(trace(marker, job)), scene: Some(scene), pose }
    }

    /// The next ones; none when there are no more.
    pub(super) fn window(&mut self, diagnostics: &mut Diagnostics) -> Vec<Toolpath> {
        let mut window: Vec<Toolpath> = self.raw.by_ref().take(WINDOW).collect();
        let Some(scene) = &self.scene else { return window };
        let chained = TOOLPATH_PASSES.iter().position(|pass| pass.chained).unwrap_or(TOOLPATH_PASSES.len());
        let (alone, chained) = TOOLPATH_PASSES.split_at(chained);
        let pass = |toolpath: &mut Toolpath, passes: &[ToolpathPass], found: &mut Diagnostics| {
            for pass in passes {
                (pass.run)(toolpath, scene, found);
                assert_sound(pass.name, || check::toolpath(toolpath));
            }
        };
        let by_itself = |toolpath: &mut Toolpath| {
            let mut found = Diagnostics::default();
            pass(toolpath, alone, &mut found);
            found
        };
        let findings: Vec<Diagnostics> = window.par_iter_mut().map(by_itself).collect();
        for (toolpath, found) in window.iter_mut().zip(findings) {
            diagnostics.extend(found);
            toolpath.entry = self.pose;
            pass(toolpath, chained, diagnostics);
            self.pose = toolpath.exit();
        }
        window
    }
}
