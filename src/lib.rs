//! `cutc` compiles garment cutter files to machine programs for a tangential knife.
//!
//! # Bird's eye
//!
//! A cutter file says where cloth is to be cut. A tangential knife is a blade that stands in the cloth and turns with
//! the path: two axes move it, a third keeps it along the cut, a fourth state says whether it is down. Between the two
//! lies what a compiler does. The file is read into one form whatever its dialect; passes edit that form; the motion
//! of the axes is planned; a target writes it; and what was written is read again and judged.
//!
//! ```text
//! bytes -> front (-> Drawing -> recognise) -> Marker -> pass -> Toolpath -> plan -> Motion -> back -> bytes -> verify
//!                                                                              -> Arcs   ->
//! ```
//!
//! Four forms carry everything, each in [`ir`]: the *Marker* is what the file says, in mm; the *Toolpath* is what the
//! knife does, in order but without time; the *Motion* is where the axes are at every tick of the controller's clock; and
//! for a controller that plans for itself the *Arcs* are few arcs and lines of the axes instead. The Marker is whole in
//! memory. The others come and go, a contour at a time, so that the length of a program does not matter.
//!
//! # Code map, in the order of the pipeline
//!
//! | Module | What it is for |
//! |---|---|
//! | [`source`] | the bytes of a file; spans, which everything made from them keeps |
//! | [`units`] | conversion factors, and the one place that prints numbers |
//! | [`diagnostic`] | everything that is said about the user's data: codes, text, JSON |
//! | [`geom`] | points, headings and rotations, polylines, curves |
//! | [`machine`] | the profile of a machine, the job, closed-form moves of one axis |
//! | [`ir`] | the four forms and the drawing, the segment list, the checker, the text form |
//! | [`front`] | dialects: bytes to Marker or Drawing, a file or folder each, rows of [`front::DIALECTS`] |
//! | [`recognise`] | what of a drawing is cut: Drawing to Marker, whatever the dialect |
//! | [`analysis`] | what lies in what, how deep, and where a plunged blade lies: asked by `recognise`, `pass`, `plan`, `back`, never by `verify` |
//! | [`pass`] | edits of Marker and Toolpath, a file each, rows of two tables in order |
//! | [`plan`] | `spline`: smooth curves inside the tolerance band; `orientation`: the blade along them; `timing`: jerk-limited speed; `solver`: their kernels; then rapids, and samples that keep the limits |
//! | [`plan::arcs`] | few arcs and lines inside the band, for controllers that plan for themselves |
//! | [`picture`] | pages for a browser: markup, columns of numbers, the script and style of the player |
//! | [`back`] | targets: a form to bytes, a file each, rows of [`back::TARGETS`]; printing only |
//! | `verify` | `program`: readers of its own; `reference`: what must be cut; `cut` and `axes`: what blade and axes do; `source`: the audit of the reader; `flow`, `spray`: other heads |
//! | [`pipeline`] | names every stage once, in order |
//! | [`sew`] | the pattern-sewing machine, a pipeline of its own: patterns to stitches, pulses and stitch files |
//! | [`spray`] | the head that follows edges at a distance: rings to offsets, courses and setpoints with velocities |
//! | [`track`] | the carriage that follows the centre of a moving cloth: ruler readings to commands and centre lines |
//! | [`flow`] | heads over a conveyor, a pipeline of its own: a Marker to chains, heads, rows and a program a head |
//! | [`machines`] | the machines, rows of [`machines::MACHINES`]: names, targets, rules, and the functions that commands call |
//! | [`manual`] | the manual, a page a topic, rows of [`manual::PAGES`] |
//! | `cli` | arguments as typed to a job as meant; the binary adds printing and the exit code |
//!
//! Other machines of the sewing floor are small pipelines of the same shape: [`sew`] reads what `front` reads and has its own
//! forms, targets and verifier; [`spray`] takes what the cutter reads and has its own course and targets; [`track`] reads
//! logs, and a firmware can take its controller over; [`flow`] takes the Marker that the cutter would cut, asks `pass` and
//! `plan` for the motion over the cloth, and has programs and targets of its own. `verify::spray` and `verify::flow` judge them.
//!
//! To find a thing, follow the data: a wrong coordinate is `front`'s, a wrong order or overlap `pass`'s, a shaking axis
//! `plan`'s, a wrong column `back`'s.
//!
//! # What always holds
//!
//! - **Stages do not know each other.** They meet in [`ir`], and may ask [`analysis`]. `verify` shares no code with what it judges but the
//!   foundation, since a checker must not repeat the fault that it looks for. A test reads the imports.
//! - **Behind `front` nothing knows the dialect, before `back` nothing knows the target.** Tables of plain functions are
//!   the only place where either is listed; help, flags and tests are made from them.
//! - **Nothing is lost silently.** What a stage drops or doubts is a diagnostic with a stable code, and every fault of a
//!   file is found in one run. After each pass [`ir::check`] looks for broken invariants in tests and debug builds.
//! - **Everything knows where it came from.** A span goes with each segment from its block in the file to the rows of the
//!   program.
//! - **Same input, same bytes.** No clock, locale, hash order or order of threads reaches the output. Time is the number of
//!   a tick times the period, never a sum.
//! - **Inside there is one system of units:** mm, s, rad, in `f64`. Any other unit is in the name.
//! - **Stages are pure.** Files, threads, clocks and the environment belong to the pipeline and the command line.
//! - **A program with an error is not written**, not even in part.
//! - **A panic is a fault of this program**, never of a file.
//!
//! # What is absent, on purpose
//!
//! - **No trait for a stage and no plug-ins.** A dialect, pass, target or machine is a row of data with functions in it.
//! - **No shared toolbox module.** What two stages need is geometry, a unit, part of a form, or a question to
//!   [`analysis`].
//! - **No curves in the Toolpath.** It is polylines, as files are; what is smooth about a motion is `plan`'s own.
//! - **No second form for a dialect's peculiarities.** What the forms cannot say, a reader must resolve or report.
//! - **No repair of the drawing in silence.** Small gaps of a plot are closed, and what retraces an outline is left out; each is said.
//!   A wider gap or a repeated contour is named and cut as it stands: closing it would be a guess.
//! - **No state between two compiles**, and no configuration but the profile and the arguments.

pub mod analysis;
pub mod back;
pub mod cli;
pub mod diagnostic;
pub mod flow;
pub mod front;
pub mod geom;
pub mod ir;
pub mod machine;
pub mod machines;
pub mod manual;
pub mod pass;
pub mod picture;
pub mod pipeline;
pub mod plan;
pub mod recognise;
pub mod sew;
pub mod source;
pub mod spray;
pub mod track;
pub mod units;
pub mod verify;
