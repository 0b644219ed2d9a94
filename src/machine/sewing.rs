//! Pattern-sewing machine: the keys `sewing.*`.
//!
//! The defaults reproduce the two figures by which such machines are advertised: 3200 stitches a minute at 2.5 mm, 2800 at 3
//! mm.

use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::key::{Key, Takes, between, from};
use super::word::{Off, OrWord, Word as _, words};
use crate::units::MS_PER_S;

/// Full turn of the spindle, degrees.
const TURN_DEG: f64 = 360.0;

/// The keys `sewing.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "sewing.feed_start_deg", takes: Takes::Number(from(0.0, 360.0)), about: "Angle of the spindle at which the needle has left the cloth and X and Y may start." },
    Key { name: "sewing.feed_end_deg", takes: Takes::Number(from(0.0, 360.0)), about: "Angle at which they must have arrived; the window between the two may pass 0." },
    Key { name: "sewing.step_mm", takes: Takes::Number(from(0.001, 1.0)), about: "Way of X and of Y for one pulse of their stepping motors." },
    Key { name: "sewing.start_hz", takes: Takes::Number(from(0.0, 1.0e6)), about: "Rate at which the motors start and stop without losing pulses; 0 = from rest." },
    Key { name: "sewing.feed_acceleration_mm_s2", takes: Takes::Number(from(1.0, 1.0e6)), about: "How fast X and Y may become faster or slower beyond that rate." },
    Key { name: "sewing.max_hz", takes: Takes::NumberOr(from(1.0, 1.0e7), Off::WORD), about: "Highest rate of pulses that the drives take; \"off\" = any." },
    Key { name: "sewing.ramp", takes: Takes::Word(words::<Ramp>), about: "\"fill\" = the gentlest ramp that just fills the window; \"fastest\" = as fast as the drives can, then\nidle until the window ends." },
    Key { name: "sewing.max_rpm", takes: Takes::Number(from(10.0, 20_000.0)), about: "Highest speed of the spindle: a turn is a stitch." },
    Key { name: "sewing.grid_rpm", takes: Takes::Count(1000), about: "Speeds are multiples of this." },
    Key { name: "sewing.spindle", takes: Takes::Word(words::<Spindle>), about: "\"uniform\" = one speed within a run, that of its slowest stitch; \"eased\" = the spindle slows down\nbefore a long stitch and recovers after it." },
    Key { name: "sewing.spindle_rpm_s", takes: Takes::Number(from(1.0, 1.0e7)), about: "How fast an eased spindle may change its speed, rpm a second; it does so between two windows." },
    Key { name: "sewing.speeds", takes: Takes::Pairs(from(0.0, 100.0), from(10.0, 20_000.0)), about: "Your own limits by pitch, a list of [pitch_mm, rpm]: a run with a stitch of this pitch or a longer\none is not sewn faster. [[2, 3000], [3, 2500]]" },
    Key { name: "sewing.soft_start_rpm", takes: Takes::NumberOr(from(10.0, 20_000.0), Off::WORD), about: "Speed of the first stitches of a run, which form the first loops; \"off\" = that of the run." },
    Key { name: "sewing.soft_start_stitches", takes: Takes::Count(100), about: "How many stitches a soft start has." },
    Key { name: "sewing.pitch_mm", takes: Takes::Number(from(0.1, 50.0)), about: "Length of a stitch on seams that are laid; evened between corners, never longer." },
    Key { name: "sewing.min_pitch_mm", takes: Takes::Number(from(0.0, 10.0)), about: "Shorter stitches are merged with the next." },
    Key { name: "sewing.field_mm", takes: Takes::PointOr(Off::WORD), about: "Opening of the clamp along X and Y: no pattern may be larger; \"off\" = any. Where it\nlies is `table.*`." },
    Key { name: "sewing.max_pitch_mm", takes: Takes::Number(from(0.1, 100.0)), about: "The longest stitch that the machine can make." },
    Key { name: "sewing.corner_deg", takes: Takes::Number(between(0.0, 180.0)), about: "A turn of a seam from which on its vertex is a corner: a stitch ends there." },
    Key { name: "sewing.on_long", takes: Takes::Word(words::<OnLong>), about: "What is done about stitches too long for the speed: \"slow\" = the whole run is sewn more slowly;\n\"split\" = they become several; \"reject\" = nothing is written." },
    Key { name: "sewing.ends", takes: Takes::Word(words::<Ends>), about: "How the ends of seams are locked: \"tie\" = short stitches back and forth; \"back-tack\" = the first\nand last stitches are sewn again, back and forth; \"open\" = not at all." },
    Key { name: "sewing.tie_mm", takes: Takes::Number(from(0.1, 5.0)), about: "Length of a short stitch of a tie." },
    Key { name: "sewing.tie_stitches", takes: Takes::Count(20), about: "How many short stitches a tie has." },
    Key { name: "sewing.back_tack_stitches", takes: Takes::Count(20), about: "How many stitches a back-tack sews again." },
    Key { name: "sewing.zigzag_width_mm", takes: Takes::Number(from(0.1, 50.0)), about: "Width of a zigzag seam." },
    Key { name: "sewing.zigzag_pitch_mm", takes: Takes::Number(from(0.05, 50.0)), about: "How far a zigzag seam advances with each stitch." },
    Key { name: "sewing.tack_width_mm", takes: Takes::Number(from(0.1, 50.0)), about: "Width of a bar tack." },
    Key { name: "sewing.tack_pitch_mm", takes: Takes::Number(from(0.05, 50.0)), about: "How far a bar tack advances with each stitch." },
    Key { name: "sewing.order", takes: Takes::Word(words::<SeamOrder>), about: "In which order seams are sewn: \"file\", or \"travel\" = on a short way between them. Threads keep\ntheir order, and no seam is turned round: its two thread sides differ." },
    Key { name: "sewing.trim", takes: Takes::Flag, about: "Whether the thread is cut between seams." },
    Key { name: "sewing.trim_ms", takes: Takes::Number(from(0.0, 10_000.0)), about: "How long cutting the thread takes." },
    Key { name: "sewing.start_ms", takes: Takes::Number(from(0.0, 10_000.0)), about: "How long the spindle takes to start and to stop, for each run." },
    Key { name: "sewing.queue_depth", takes: Takes::Count(1_000_000), about: "How many entries the queue of the motion part holds." },
    Key { name: "sewing.producer_hz", takes: Takes::Number(from(0.1, 1.0e7)), about: "How many entries a second the host puts into it." },
];

/// Pattern-sewing machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sewing {
    /// Angle of the spindle at which X and Y may start.
    pub feed_start_deg: f64,
    /// Angle of the spindle at which X and Y must have arrived.
    pub feed_end_deg: f64,
    /// Distance of X or Y per pulse.
    pub step_mm: f64,
    /// Pulse rate at which the motors start and stop without a ramp.
    pub start_hz: f64,
    /// Greatest acceleration of X and of Y beyond that rate.
    pub feed_acceleration_mm_s2: f64,
    /// Greatest pulse rate.
    #[serde(with = "OrWord::<Off>")]
    pub max_hz: Option<f64>,
    /// Use of the window.
    pub ramp: Ramp,
    /// Greatest speed of the spindle.
    pub max_rpm: f64,
    /// Grid of speeds.
    pub grid_rpm: u32,
    /// Speeds of the spindle within a run.
    pub spindle: Spindle,
    /// Greatest change of its speed, rpm per second.
    pub spindle_rpm_s: f64,
    /// Speed limits by pitch: mm, rpm.
    pub speeds: Vec<[f64; 2]>,
    /// Speed of a soft start.
    #[serde(with = "OrWord::<Off>")]
    pub soft_start_rpm: Option<f64>,
    /// Number of stitches of a soft start.
    pub soft_start_stitches: u32,
    /// Stitch length of seams that are laid out.
    pub pitch_mm: f64,
    /// Least stitch length.
    pub min_pitch_mm: f64,
    /// Greatest stitch length.
    pub max_pitch_mm: f64,
    /// Least turn of a corner.
    pub corner_deg: f64,
    /// Treatment of stitches too long for the speed.
    pub on_long: OnLong,
    /// Locking of the ends of seams.
    pub ends: Ends,
    /// Stitch length of a tie.
    pub tie_mm: f64,
    /// Number of stitches of a tie.
    pub tie_stitches: u32,
    /// Number of stitches that a back-tack repeats.
    pub back_tack_stitches: u32,
    /// Opening of the clamp along X and Y; `None` = unlimited.
    #[serde(with = "OrWord::<Off>")]
    pub field_mm: Option<[f64; 2]>,
    /// Width of a zigzag seam.
    pub zigzag_width_mm: f64,
    /// Advance of a zigzag seam per stitch.
    pub zigzag_pitch_mm: f64,
    /// Width of a bar tack.
    pub tack_width_mm: f64,
    /// Advance of a bar tack per stitch.
    pub tack_pitch_mm: f64,
    /// Order of seams.
    pub order: SeamOrder,
    /// True if the thread is cut between seams.
    pub trim: bool,
    /// Duration of a trim.
    pub trim_ms: f64,
    /// Duration of a start and a stop of the spindle.
    pub start_ms: f64,
    /// Capacity of the queue of the motion part, entries.
    pub queue_depth: u32,
    /// Rate at which the host fills the queue, entries per second.
    pub producer_hz: f64,
}

/// Use of the window in which X and Y may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ramp {
    /// All of it, as gently as possible.
    Fill,
    /// As little of it as possible.
    Fastest,
}

/// Speeds of the spindle within a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Spindle {
    /// One speed, apart from the soft start.
    Uniform,
    /// A speed for each stitch.
    Eased,
}

/// Treatment of stitches that are too long for the speed of their run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnLong {
    /// The run is sewn more slowly.
    Slow,
    /// Each is split into several.
    Split,
    /// The pattern is refused.
    Reject,
}

/// Locking of the ends of seams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ends {
    /// Short stitches back and forth.
    Tie,
    /// The first and last stitches are repeated back and forth.
    BackTack,
    /// No locking.
    Open,
}

/// Order in which seams are sewn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeamOrder {
    /// Order of the file.
    File,
    /// Short travel between seams.
    Travel,
}

impl Default for Sewing {
    fn default() -> Self {
        Self {
            feed_start_deg: 250.0,
            feed_end_deg: 110.0,
            step_mm: 0.05,
            start_hz: 2836.364,
            feed_acceleration_mm_s2: 26_657.85,
            max_hz: Some(20_000.0),
            ramp: Ramp::Fill,
            max_rpm: 3200.0,
            grid_rpm: 10,
            spindle: Spindle::Uniform,
            spindle_rpm_s: 10_000.0,
            speeds: Vec::new(),
            soft_start_rpm: Some(400.0),
            soft_start_stitches: 2,
            pitch_mm: 2.5,
            min_pitch_mm: 0.1,
            field_mm: None,
            max_pitch_mm: 12.7,
            corner_deg: 20.0,
            on_long: OnLong::Slow,
            ends: Ends::Tie,
            tie_mm: 0.7,
            tie_stitches: 3,
            back_tack_stitches: 3,
            zigzag_width_mm: 3.0,
            zigzag_pitch_mm: 1.0,
            tack_width_mm: 2.0,
            tack_pitch_mm: 0.4,
            order: SeamOrder::File,
            trim: true,
            trim_ms: 350.0,
            start_ms: 150.0,
            queue_depth: 64,
            producer_hz: 1000.0,
        }
    }
}

impl Sewing {
    /// Window, degrees, 0 to 360.
    pub fn window_deg(&self) -> f64 {
        (self.feed_end_deg - self.feed_start_deg).rem_euclid(TURN_DEG)
    }

    /// Window as a share of a turn, 0 to 1.
    pub fn window(&self) -> f64 {
        self.window_deg() / TURN_DEG
    }

    /// Speed at which X and Y start, mm/s.
    pub fn start(&self) -> f64 {
        self.start_hz * self.step_mm
    }

    /// Greatest speed of X and Y, mm/s.
    pub fn cap(&self) -> f64 {
        self.max_hz.map_or(f64::INFINITY, |rate| rate * self.step_mm)
    }

    /// Duration of cutting the thread, s.
    pub fn trim_time(&self) -> f64 {
        self.trim_ms / MS_PER_S
    }

    /// Duration of a start and a stop of the spindle, s.
    pub fn start_time(&self) -> f64 {
        self.start_ms / MS_PER_S
    }
}

/// Checks values against each other.
pub(super) fn faults(sewing: &Sewing) -> Vec<Fault> {
    let mut faults = Vec::new();
    if sewing.window() == 0.0 {
        let message = format!(
            "`sewing.feed_start_deg` and `sewing.feed_end_deg` are both {} degrees: X and Y would have no time to move",
            sewing.feed_start_deg
        );
        let hint = "the window is the turn from where the needle leaves the cloth to where it enters it again";
        faults.push(Fault::of_range(&["sewing.feed_start_deg", "sewing.feed_end_deg"], message, hint));
    }
    let [least, pitch, most] = [sewing.min_pitch_mm, sewing.pitch_mm, sewing.max_pitch_mm];
    if least > pitch || pitch > most {
        let message = format!(
            "`sewing.pitch_mm` is {pitch} mm, not within `sewing.min_pitch_mm` and `sewing.max_pitch_mm`, {least} and {most} mm"
        );
        let hint = "seams would be laid with stitches that the machine does not make";
        faults.push(Fault::of_range(&["sewing.pitch_mm", "sewing.min_pitch_mm", "sewing.max_pitch_mm"], message, hint));
    }
    if f64::from(sewing.grid_rpm) > sewing.max_rpm {
        let (grid, most) = (sewing.grid_rpm, sewing.max_rpm);
        let message = format!("`sewing.grid_rpm` is {grid} rpm, more than `sewing.max_rpm`, {most} rpm");
        let hint = "no multiple of it is a speed that the spindle has";
        faults.push(Fault::of_range(&["sewing.grid_rpm", "sewing.max_rpm"], message, hint));
    }
    if let Some(most) = sewing.max_hz.filter(|&most| most < sewing.start_hz) {
        let message = format!("`sewing.max_hz` is {most} Hz, less than `sewing.start_hz`, {} Hz", sewing.start_hz);
        let hint = "the motors start at a rate that the drives take";
        faults.push(Fault::of_range(&["sewing.max_hz", "sewing.start_hz"], message, hint));
    }
    faults
}
