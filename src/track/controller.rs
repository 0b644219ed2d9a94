//! The controller: it turns a pair of readings into a command for the drive. It only needs `core`: no heap, no clock, and a
//! state of fixed size, so that a firmware can use this file unchanged.
//!
//! Timing: [`Controller::step`] is called once per sample period, with the readings that were latched at its start. All times
//! in the [`Law`] are counted in samples. A step makes at most `debounce` comparisons. With an upstream pair of rulers it also
//! sorts n = `2 debounce + 1` numbers, in at most n (n - 1)/2 moves, 8,256 for the longest debounce time; it has no other
//! loops. A command holds until the next one.
//!
//! Let c be the centre of the carriage, M that of the cloth, W its width and W0 the nominal width, q the pitch of the sensors
//! and m their number on a ruler. The numbers of covered sensors I (left edge) and J (right edge) then satisfy
//!
//! ```text
//! I - J = 2 (c - M)/q        I + J - m = (W - W0)/q
//! ```
//!
//! each within one count. I > J: the cloth lies to the left of the carriage, which is driven to the left (negative).

/// Maximum number of sensors of a ruler.
pub const MOST_SENSORS: usize = 256;
/// Maximum debounce time, samples.
pub const MOST_DEBOUNCE: usize = 64;
/// Maximum delay between a reading of the upstream rulers and its use, samples.
pub const MOST_DELAY: usize = 2048;
/// Maximum number of upstream readings in a median filter: equally many before and after a reading.
const MOST_FILTER: usize = 2 * MOST_DEBOUNCE + 1;

/// Numbers of covered sensors at the start of a sample period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// I: sensors covered on the ruler over the left edge.
    pub left: u16,
    /// J: sensors covered on the ruler over the right edge.
    pub right: u16,
    /// I and J of a fixed pair of rulers upstream, centred on the middle of the machine; `None` if there is none.
    pub upstream: Option<[u16; 2]>,
}

/// Judgement of the measured deviation. The feed-forward velocity is applied with any of the first three.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// I = J, or one count past it after an approach: no correction.
    Centred,
    /// Off centre, but not for long enough yet: no correction.
    Waiting,
    /// Off centre: the carriage is driven.
    Driving,
    /// All sensors of a ruler are covered: the edge is lost. Drive off, alarm.
    LostCovered,
    /// No sensor of a ruler is covered: the edge is lost. Drive off, alarm.
    LostOpen,
    /// The width is outside its limits. Drive off, alarm.
    Width,
}

impl Status {
    /// True if both edges are seen and the width is within its limits.
    pub const fn sees_both_edges(self) -> bool {
        match self {
            Self::Centred | Self::Waiting | Self::Driving => true,
            Self::LostCovered | Self::LostOpen | Self::Width => false,
        }
    }
}

/// Command to the drive until the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// Judgement of the deviation. The feed-forward velocity is added to the correction, so the carriage may move while the
    /// cloth is centred.
    pub status: Status,
    /// Velocity of the carriage, mm/s, positive to the right; 0 = stop.
    pub velocity: f64,
}

/// Parameters of the controller, constant while it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    /// m: number of sensors of a ruler.
    pub sensors: u16,
    /// Minimum and maximum of I + J - m.
    pub width: [i32; 2],
    /// Speed of the carriage by |I - J|, mm/s; the first entry is for 0.
    pub speeds: [f64; MOST_SENSORS + 1],
    /// Maximum speed of the carriage, mm/s.
    pub max_speed: f64,
    /// Number of samples, after the first one, during which a side must be measured before it counts.
    pub debounce: u16,
    /// Use of the upstream rulers; `None` if there are none.
    pub feed_forward: Option<FeedForward>,
}

/// Parameters of the feed-forward from the upstream rulers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedForward {
    /// Number of samples between the two readings whose difference gives the velocity of the cloth's centre.
    pub window: u16,
    /// Delay of the velocity, samples, so that the drive applies it when the cloth arrives.
    pub delay: u16,
    /// Number of samples on either side of a reading in its median filter, which removes damage of the edge.
    pub filter: u16,
    /// Velocity per count of difference between two readings of I - J, mm/s.
    pub per_count: f64,
}

/// The state of a controller, of fixed size.
#[derive(Debug, Clone, PartialEq)]
pub struct Controller {
    /// The measured side, -1, 0 or 1, and the number of samples for which it has held after the first.
    side: i8,
    held: u16,
    /// The side to which the carriage was last driven; 0 if there is none yet.
    driven: i8,
    /// Ring buffer of |I - J| of the last samples.
    deviations: [u16; MOST_DEBOUNCE],
    at: u16,
    upstream: Upstream,
}

/// State of the upstream measurement.
#[derive(Debug, Clone, PartialEq)]
struct Upstream {
    /// Ring buffer of I - J of the last readings.
    raw: [i16; MOST_FILTER],
    /// Ring buffer of their medians.
    filtered: [i16; MOST_DELAY],
    /// Number of readings so far, limited to the number needed.
    count: u16,
    /// Number of consecutive readings with a lost edge.
    lost: u16,
    raw_at: u16,
    at: u16,
}

impl Controller {
    /// A controller without any readings yet.
    pub const fn new() -> Self {
        let upstream =
            Upstream { raw: [0; MOST_FILTER], filtered: [0; MOST_DELAY], count: 0, lost: 0, raw_at: 0, at: 0 };
        Self { side: 0, held: 0, driven: 0, deviations: [0; MOST_DEBOUNCE], at: 0, upstream }
    }

    /// Processes the readings of a sample and returns the command for the drive.
    pub fn step(&mut self, law: &Law, reading: Reading) -> Command {
        let ahead = match (&law.feed_forward, reading.upstream) {
            (Some(feed_forward), Some(pair)) => self.upstream.velocity(law, feed_forward, pair),
            (Some(_) | None, _) => 0.0,
        };
        let Reading { left, right, .. } = reading;
        let excess = i32::from(left) + i32::from(right) - i32::from(law.sensors);
        let alarm = if left >= law.sensors || right >= law.sensors {
            Some(Status::LostCovered)
        } else if left == 0 || right == 0 {
            Some(Status::LostOpen)
        } else if excess < law.width[0] || excess > law.width[1] {
            Some(Status::Width)
        } else {
            None
        };
        if let Some(status) = alarm {
            self.side = 0;
            self.held = 0;
            self.driven = 0;
            return Command { status, velocity: 0.0 };
        }
        let (status, back) = self.decide(law, left, right);
        let velocity = (back + ahead).clamp(-law.max_speed, law.max_speed);
        Command { status, velocity: if velocity == 0.0 { 0.0 } else { velocity } }
    }

    /// Judges the deviation and returns the correcting velocity, mm/s.
    ///
    /// The speed is that of the minimum deviation during the debounce time, so that damage beside an edge cannot make the
    /// carriage jump while it is driven. During an approach to the centre that minimum is the last deviation.
    ///
    /// One count to the side opposite to the approach counts as centred. A ruler is accurate to one count, and if both change
    /// at the same position no reading is ever I = J; the carriage would be driven back and forth forever.
    fn decide(&mut self, law: &Law, left: u16, right: u16) -> (Status, f64) {
        let side = match left.cmp(&right) {
            core::cmp::Ordering::Less => 1,
            core::cmp::Ordering::Equal => 0,
            core::cmp::Ordering::Greater => -1,
        };
        self.held = if side == self.side { self.held.saturating_add(1) } else { 0 };
        self.side = side;
        self.at = (self.at + 1) % MOST_DEBOUNCE as u16;
        self.deviations[usize::from(self.at)] = left.abs_diff(right);
        if side == 0 || (left.abs_diff(right) == 1 && side == -self.driven) {
            return (Status::Centred, 0.0);
        }
        if self.held < law.debounce {
            return (Status::Waiting, 0.0);
        }
        self.driven = side;
        let mut least = u16::MAX;
        for back in 0..=law.debounce.min(MOST_DEBOUNCE as u16 - 1) {
            let at = (self.at + MOST_DEBOUNCE as u16 - back) % MOST_DEBOUNCE as u16;
            least = least.min(self.deviations[usize::from(at)]);
        }
        (Status::Driving, f64::from(side) * law.speeds[usize::from(least).min(MOST_SENSORS)])
    }
}

impl Default for Controller {
    fn default() -> Self {
        Self::new()
    }
}

impl Upstream {
    /// Processes a reading and returns the velocity of the cloth's centre where the carriage will be, mm/s; 0 until enough
    /// readings are known.
    fn velocity(&mut self, law: &Law, feed_forward: &FeedForward, [left, right]: [u16; 2]) -> f64 {
        let FeedForward { window, delay, filter, per_count } = *feed_forward;
        let is_lost = left == 0 || right == 0 || left >= law.sensors || right >= law.sensors;
        let last = self.raw[usize::from(self.raw_at)];
        self.raw_at = (self.raw_at + 1) % MOST_FILTER as u16;
        // While an edge is lost the centre is unknown and taken as constant.
        let now = if is_lost { last } else { left.wrapping_sub(right).cast_signed() };
        self.raw[usize::from(self.raw_at)] = now;
        let (need, taken) = (window + delay, 2 * filter + 1);
        self.lost = if is_lost { self.lost.saturating_add(1) } else { 0 };
        // A loss longer than the median filter can hide restarts the measurement, so that the return of the edge does not look
        // like a jump of the cloth.
        self.count = if self.lost > filter { 0 } else { self.count.saturating_add(1).min(need.saturating_add(taken)) };
        self.at = (self.at + 1) % MOST_DELAY as u16;
        self.filtered[usize::from(self.at)] = if self.count < taken { now } else { self.median(taken) };
        if self.count < need.saturating_add(taken) {
            return 0.0;
        }
        let back = |samples: u16| {
            let at = (self.at + MOST_DELAY as u16 - samples) % MOST_DELAY as u16;
            f64::from(self.filtered[usize::from(at)])
        };
        (back(delay) - back(need)) * per_count
    }

    /// The median of the last `taken` readings, an odd number.
    fn median(&self, taken: u16) -> i16 {
        let mut sorted = [0_i16; MOST_FILTER];
        let mut length = 0;
        for back in 0..taken.min(MOST_FILTER as u16) {
            let at = (self.raw_at + MOST_FILTER as u16 - back) % MOST_FILTER as u16;
            let value = self.raw[usize::from(at)];
            let mut place = length;
            while place > 0 && sorted[place - 1] > value {
                sorted[place] = sorted[place - 1];
                place -= 1;
            }
            sorted[place] = value;
            length += 1;
        }
        sorted[length / 2]
    }
}
