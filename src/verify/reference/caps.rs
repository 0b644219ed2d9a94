//! Speed caps of the tip along a line: the feed of the profile and of the piece, slowed cuts, and the stretch before a corner.

use super::vertex::Vertex;
use crate::ir::list::FULL_SPEED;
use crate::ir::marker::Piece;
use crate::machine::MachineProfile;

/// Speed caps of a line in both directions.
#[derive(Debug)]
pub(in crate::verify) enum BothWays {
    /// Single cap for the whole line, mm/s: the usual case.
    One(f64),
    /// Caps by station for a tip that moves with the line, and by distance from the end for one that moves against it.
    Each(Box<[Caps; 2]>),
}

/// Speed caps of a line by station.
#[derive(Debug)]
pub(in crate::verify) struct Caps {
    /// Cap at the start of the line, mm/s; infinite without a cap.
    first: f64,
    /// Later caps, each with the station from which it holds, mm. Consecutive caps differ.
    later: Box<[[f64; 2]]>,
}

/// Kind of an end of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::verify) enum End {
    /// Corner, where the knife is lifted; the cut may have to be slower before it.
    AtCorner,
    /// End of the contour, or a line that goes all the way around.
    Plain,
}

/// Feeds of a piece, from which caps are computed.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Feeds<'a> {
    profile: &'a MachineProfile,
    /// Lower of the feeds of the profile and of the piece, mm/s; infinite without a feed.
    feed: f64,
}

impl<'a> Feeds<'a> {
    pub(in crate::verify) fn new(profile: &'a MachineProfile, piece: &Piece) -> Self {
        let feeds = [profile.knife.feed_mm_s, piece.feed];
        Self { profile, feed: feeds.into_iter().flatten().fold(f64::INFINITY, f64::min) }
    }

    /// Speed to which a percentage refers without a feed: the speed that the tip can reach in every direction, mm/s.
    fn fastest(&self) -> f64 {
        let [x, y, _] = self.profile.axes.limits();
        self.feed.min(x.speed).min(y.speed)
    }

    /// Cap of a cut at a percentage of its speed, mm/s.
    pub(in crate::verify) fn at(&self, percent: u8) -> f64 {
        if percent < FULL_SPEED { self.fastest() * f64::from(percent) / 100.0 } else { self.feed }
    }

    /// Caps of a line whose chords have these speeds in percent; `ends` are the kinds of its start and end, `near` the station
    /// ranges beside which the edge of another part runs.
    pub(in crate::verify) fn both_ways(
        &self,
        path: &[Vertex],
        mut percents: impl DoubleEndedIterator<Item = u8> + Clone,
        ends: [End; 2],
        near: &[[f64; 2]],
    ) -> BothWays {
        let chords = percents.clone().map(|percent| self.at(percent));
        let first = percents.next().unwrap_or(FULL_SPEED);
        let is_even = near.is_empty() && self.profile.slow.before_corner_mm.is_none();
        if is_even && percents.all(|percent| percent == first) {
            return BothWays::One(self.at(first));
        }
        let mut stations: Vec<f64> = path.iter().map(|vertex| vertex.station).collect();
        let mut chords: Vec<f64> = chords.collect();
        if let Some(share) = self.profile.knife.near_share() {
            self.slow_down(&mut stations, &mut chords, near, share);
        }
        let length = stations[stations.len() - 1];
        let back: Vec<f64> = stations.iter().rev().map(|station| length - station).collect();
        let against = self.caps(&back, chords.iter().rev().copied().collect(), ends[0]);
        BothWays::Each(Box::new([self.caps(&stations, chords, ends[1]), against]))
    }

    /// Lowers the caps of chords over some stretches to a share; divides chords where a stretch begins or ends inside.
    fn slow_down(&self, stations: &mut Vec<f64>, chords: &mut Vec<f64>, near: &[[f64; 2]], share: f64) {
        let mut divide = |at: f64| {
            let behind = stations.partition_point(|&station| station < at);
            if behind > 0 && behind < stations.len() && stations[behind] > at {
                stations.insert(behind, at);
                chords.insert(behind, chords[behind - 1]);
            }
            behind.min(chords.len())
        };
        let slowed: Vec<[usize; 2]> = near.iter().map(|ends| ends.map(&mut divide)).collect();
        let [x, y, _] = self.profile.axes.limits();
        for [first, last] in slowed {
            chords[first..last].iter_mut().for_each(|cap| *cap = cap.min(x.speed).min(y.speed) * share);
        }
    }

    /// Caps of chords between stations, up to the end of the line.
    fn caps(&self, stations: &[f64], chords: Vec<f64>, end: End) -> Caps {
        let (mut starts, mut caps) = (stations[..chords.len()].to_vec(), chords);
        if let (Some(reach), End::AtCorner) = (self.profile.slow.before_corner_mm, end) {
            let from = (stations[stations.len() - 1] - reach).max(0.0);
            let first = starts.partition_point(|&start| start < from);
            if starts.get(first) != Some(&from) {
                starts.insert(first, from);
                caps.insert(first, caps[first - 1]);
            }
            let [x, y, _] = self.profile.axes.limits();
            let share = self.profile.slow.before_corner_percent / 100.0;
            caps[first..].iter_mut().for_each(|cap| *cap = cap.min(x.speed).min(y.speed) * share);
        }
        let first = caps[0];
        let (mut last, mut later) = (first, Vec::new());
        for (start, cap) in starts.into_iter().zip(caps) {
            if cap != last {
                later.push([start, cap]);
                last = cap;
            }
        }
        Caps { first, later: later.into() }
    }
}

/// Selection from two caps: the greater or the lesser.
pub(in crate::verify) type Pick = fn(f64, f64) -> f64;

/// Direction along a line.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Way {
    /// 1 with the line, -1 against it.
    pub(in crate::verify) sign: f64,
    /// Length of a closed line, mm; `None` for an open one.
    pub(in crate::verify) round: Option<f64>,
}

impl BothWays {
    /// Cap of the whole line; `None` if it has several. `sign` is +1 with the line, -1 against it.
    pub(in crate::verify) fn only(&self, sign: f64) -> Option<f64> {
        match self {
            Self::One(cap) => Some(*cap),
            Self::Each(ways) => way(ways, sign).only(),
        }
    }

    /// Stretches of a line of that length with constant caps: the end of each, and the caps with the line and against it.
    pub(in crate::verify) fn stretches(&self, length: f64) -> Vec<(f64, [f64; 2])> {
        let [with, against] = match self {
            Self::One(cap) => return vec![(length, [*cap; 2])],
            Self::Each(ways) => &**ways,
        };
        let starts = with.later.iter().map(|&[start, _]| start);
        let mut ends: Vec<f64> = starts.chain(against.later.iter().map(|&[start, _]| length - start)).collect();
        ends.push(length);
        ends.sort_by(f64::total_cmp);
        let mut from = 0.0;
        let stretch = |to: f64| {
            let middle = f64::midpoint(from, to);
            from = to;
            (to, [with.over([middle; 2], f64::max), against.over([length - middle; 2], f64::max)])
        };
        ends.into_iter().map(stretch).collect()
    }

    /// Cap picked among those between two stations; for a way against the line, stations count from its end.
    pub(in crate::verify) fn over(&self, ends: [f64; 2], Way { sign, round }: Way, pick: Pick) -> f64 {
        match (self, round) {
            (Self::One(cap), _) => *cap,
            (Self::Each(ways), Some(length)) => way(ways, sign).over_round(ends, length, pick),
            (Self::Each(ways), None) => way(ways, sign).over(ends, pick),
        }
    }
}

fn way([with, against]: &[Caps; 2], sign: f64) -> &Caps {
    if sign > 0.0 { with } else { against }
}

impl Caps {
    /// Cap of the whole line; `None` if it has several.
    fn only(&self) -> Option<f64> {
        self.later.is_empty().then_some(self.first)
    }

    /// Cap picked among those between two stations; beyond an end, the cap of that end.
    fn over(&self, [low, high]: [f64; 2], pick: Pick) -> f64 {
        let before = |station: f64| self.later.partition_point(|&[start, _]| start <= station);
        let (from, to) = (before(low), before(high));
        let at_low = if from == 0 { self.first } else { self.later[from - 1][1] };
        self.later[from..to.max(from)].iter().map(|&[_, cap]| cap).fold(at_low, pick)
    }

    /// Cap picked among those between two stations of a closed line of that length.
    fn over_round(&self, [low, high]: [f64; 2], length: f64, pick: Pick) -> f64 {
        let from = low.rem_euclid(length);
        let to = from + (high - low).min(length);
        if to <= length {
            self.over([from, to], pick)
        } else {
            pick(self.over([from, length], pick), self.over([0.0, to - length], pick))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn caps(profile: &MachineProfile, feed: Option<f64>, percents: [u8; 3]) -> Caps {
        let piece = Piece { feed, ..Piece::default() };
        let feeds = Feeds::new(profile, &piece);
        feeds.caps(&[0.0, 10.0, 20.0, 30.0], percents.map(|percent| feeds.at(percent)).to_vec(), End::AtCorner)
    }

    #[test]
    fn the_least_of_all_that_asks_for_slowness_caps_the_tip() {
        let mut profile = MachineProfile::default();
        profile.knife.feed_mm_s = Some(400.0);
        profile.slow.before_corner_mm = Some(5.0);
        let caps = caps(&profile, Some(300.0), [100, 50, 100]);
        let at = |station: f64| caps.over([station; 2], f64::max);
        assert_eq!(
            [-1.0, 9.0, 11.0, 21.0, 24.0, 26.0, 99.0].map(at),
            [300.0, 300.0, 150.0, 300.0, 300.0, 150.0, 150.0]
        );
        let least = |ends| caps.over(ends, f64::min);
        assert_eq!([caps.over([9.0, 29.0], f64::max), least([9.0, 29.0]), least([21.0, 24.0])], [300.0, 150.0, 300.0]);
    }

    #[test]
    fn without_any_feed_a_share_is_one_of_the_slower_axis() {
        let mut profile = MachineProfile::default();
        profile.knife.feed_mm_s = None;
        profile.axes.y.speed_mm_s = 500.0;
        let plain = caps(&profile, None, [100, 50, 100]);
        assert_eq!([5.0, 15.0].map(|at| plain.over([at; 2], f64::max)), [f64::INFINITY, 250.0]);
        profile.slow.before_corner_mm = Some(99.0);
        assert_eq!([5.0, 15.0].map(|at| caps(&profile, None, [100, 50, 100]).over([at; 2], f64::max)), [250.0, 125.0]);
    }

    #[test]
    fn a_line_that_goes_round_has_the_caps_of_its_start_behind_its_end() {
        let profile = MachineProfile::default();
        let piece = Piece { feed: Some(100.0), ..Piece::default() };
        let feeds = Feeds::new(&profile, &piece);
        let caps = feeds.caps(&[0.0, 10.0, 20.0], vec![100.0, 50.0], End::Plain);
        assert_eq!(
            [[12.0, 18.0], [18.0, 21.0], [32.0, 38.0], [-1.0, 0.5]].map(|ends| caps.over_round(ends, 20.0, f64::max)),
            [50.0, 100.0, 50.0, 100.0]
        );
        assert_eq!([[21.0, 29.0], [18.0, 21.0]].map(|ends| caps.over_round(ends, 20.0, f64::min)), [100.0, 50.0]);
    }
}
