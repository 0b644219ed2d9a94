//! What holds of every part of the compiler, a module a topic; one program, because each is linked with all of the crate.

#[path = "../bench/garment.rs"]
mod garment;
mod support;

/// Of cases that come in thousands, one in so many is tried here; `tests/heavy` tries them all.
const ONE_IN: usize = 10;

mod architecture;
mod batch;
mod bites;
mod chord;
mod cli;
mod coarse;
mod codes;
mod common;
mod controllers;
mod damaged;
mod drawing;
mod drives;
mod edits;
mod entries;
mod fixtures;
mod flow;
mod gcode;
mod grammar;
mod hpgl;
mod knife;
mod labels;
mod lifts;
mod loopholes;
mod manual;
mod many_info;
mod markers;
mod marks;
mod messages;
mod motion;
mod moves;
mod nest;
mod notch_forms;
mod notches;
mod options;
mod overlaps;
mod page;
mod passes;
mod pattern;
mod picture;
mod places;
mod planner;
mod player;
mod plunges;
mod profile;
mod properties;
mod readme;
mod rewritten;
mod route;
mod sew;
mod sheet;
mod sound;
mod splits;
mod spray;
mod svg;
mod targets;
mod threads;
mod told;
mod track;
mod verifier;
#[cfg(unix)]
mod watch;
