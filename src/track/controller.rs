//! The controller: a pair of readings in, a command for the drive out. Nothing here needs more than `core`: no heap, no
//! clock, a state of fixed size, so that a firmware can take the file over as it stands.
//!
//! Timing: [`Controller::step`] is called once a sample period, with the readings that were latched at its start; every time
//! in the [`Law`] is counted in samples. A step makes at most `debounce` comparisons. With an upstream pair of rulers it sorts
//! n = `2 debounce + 1` numbers besides, in n (n - 1)/2 moves at the most, 8,256 for the longest debounce time; nothing else
//! in it is repeated. The command holds until the next one.
//!
//! With c the centre of the carriage, M that of the cloth, W its width and W0 the nominal one, q the pitch of the sensors and
//! m their number on a ruler, the covered sensors I (left edge) and J (right edge) say
//!
//! ```text
//! I - J = 2 (c - M)/q        I + J - m = (W - W0)/q
//! ```
//!
//! each within one count. I > J: the cloth lies to the left of the carriage, which is driven to the left (negative).

/// The most sensors of a ruler.
pub const MOST_SENSORS: usize = 256;
/// The most samples of a debounce time.
pub const MOST_DEBOUNCE: usize = 64;
/// The most samples between a reading of the upstream rulers and what is done about it.
pub const MOST_DELAY: usize = 2048;
/// Upstream readings that are looked at together: as many before one as behind it.
const MOST_FILTER: usize = 2 * MOST_DEBOUNCE + 1;

/// Covered sensors of the rulers at the start of a sample period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// I: of the ruler over the left edge.
    pub left: u16,
    /// J: of the ruler over the right edge.
    pub right: u16,
    /// The same of a fixed pair upstream, whose centre is the middle of the machine; `None` where there is none.
    pub upstream: Option<[u16; 2]>,
}

/// What the controller makes of the deviation that it reads. What is fed forward is driven with any of the first three.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// I = J, or one count beyond that on the way to it: nothing to do.
    Centred,
    /// Off centre, but not long enough yet: nothing is done about it.
    Waiting,
    /// Off centre: the carriage is driven.
    Driving,
    /// All sensors of a ruler are covered: its edge is lost. Drive off, alarm.
    LostCovered,
    /// No sensor of a ruler is covered: its edge is lost. Drive off, alarm.
    LostOpen,
    /// The width is outside its limits. Drive off, alarm.
    Width,
}

impl Status {
    /// Whether both edges are seen, and the width is within its limits.
    pub const fn sees_both_edges(self) -> bool {
        match self {
            Self::Centred | Self::Waiting | Self::Driving => true,
            Self::LostCovered | Self::LostOpen | Self::Width => false,
        }
    }
}

/// What the drive has to do until the next command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// Where the cloth lies, and what is done about that. What is fed forward comes to it: then the carriage may move while the
    /// cloth lies in its centre.
    pub status: Status,
    /// Velocity of the carriage, mm/s, positive to the right; 0 = stop.
    pub velocity: f64,
}

/// What the controller goes by: made once, never changed while it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    /// m: sensors of a ruler.
    pub sensors: u16,
    /// Least and greatest I + J - m.
    pub width: [i32; 2],
    /// Speed of the carriage by |I - J|, mm/s; the first is that of none.
    pub speeds: [f64; MOST_SENSORS + 1],
    /// Greatest speed of the carriage, mm/s.
    pub max_speed: f64,
    /// For how many samples behind its first one a side must have been told.
    pub debounce: u16,
    /// What is done with the upstream rulers.
    pub feed_forward: Option<FeedForward>,
}

/// How the upstream rulers are used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedForward {
    /// Samples between the two readings whose difference is the velocity of the cloth's centre.
    pub window: u16,
    /// Samples that the velocity is held back by, so that the drive does it when the cloth is there.
    pub delay: u16,
    /// Samples on either side of a reading whose median it becomes: damage of the edge is no motion of the cloth.
    pub filter: u16,
    /// Velocity by the difference of two readings of I - J, mm/s a count.
    pub per_count: f64,
}

/// The state of a controller, of fixed size.
#[derive(Debug, Clone, PartialEq)]
pub struct Controller {
    /// The side that is told, -1, 0 or 1, and for how many samples behind the first.
    side: i8,
    held: u16,
    /// The side to which the carriage was driven last; 0 = to none yet.
    driven: i8,
    /// |I - J| of the last samples, a ring.
    deviations: [u16; MOST_DEBOUNCE],
    at: u16,
    upstream: Upstream,
}

/// What is known of the cloth upstream.
#[derive(Debug, Clone, PartialEq)]
struct Upstream {
    /// I - J of the last readings, a ring.
    raw: [i16; MOST_FILTER],
    /// Their medians, a ring.
    filtered: [i16; MOST_DELAY],
    /// Readings so far, no more than it takes to use them.
    count: u16,
    /// For how many readings an edge has been lost.
    lost: u16,
    raw_at: u16,
    at: u16,
}

impl Controller {
    /// A controller that has read nothing yet.
    pub const fn new() -> Self {
        let upstream =
            Upstream { raw: [0; MOST_FILTER], filtered: [0; MOST_DELAY], count: 0, lost: 0, raw_at: 0, at: 0 };
        Self { side: 0, held: 0, driven: 0, deviations: [0; MOST_DEBOUNCE], at: 0, upstream }
    }

    /// Takes the readings of a sample and says what the drive has to do.
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

    /// What is done about the deviation, and the velocity back to the centre, mm/s.
    ///
    /// The speed is that of the least deviation of the debounce time: damage beside an edge that is being followed must not
    /// make the carriage jump, either. On the way to the centre that is the last one.
    ///
    /// One count to the other side than the carriage came from is centred: a ruler reads within one count, and where both
    /// change at the same place no reading is ever I = J, so that the carriage would be driven to and fro for good.
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
    /// Takes a reading, and gives the velocity of the cloth's centre where the carriage will be, mm/s; 0 until enough is
    /// known.
    fn velocity(&mut self, law: &Law, feed_forward: &FeedForward, [left, right]: [u16; 2]) -> f64 {
        let FeedForward { window, delay, filter, per_count } = *feed_forward;
        let is_lost = left == 0 || right == 0 || left >= law.sensors || right >= law.sensors;
        let last = self.raw[usize::from(self.raw_at)];
        self.raw_at = (self.raw_at + 1) % MOST_FILTER as u16;
        // Where an edge is lost nothing is known of the centre: it is taken to stay.
        let now = if is_lost { last } else { left.wrapping_sub(right).cast_signed() };
        self.raw[usize::from(self.raw_at)] = now;
        let (need, taken) = (window + delay, 2 * filter + 1);
        self.lost = if is_lost { self.lost.saturating_add(1) } else { 0 };
        // What the median does not hide is no jump of the cloth when the edge is found again: everything begins anew.
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

    /// The median of the last readings, an odd number of them.
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
