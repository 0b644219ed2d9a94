//! Speed cap of the tip along a run, constant on each chord.

/// Speed caps of a run by station.
#[derive(Debug, Clone)]
pub(in crate::plan) struct Feed {
    /// Station where each cap begins, mm; the first is 0.
    starts: Vec<f64>,
    /// Caps, mm/s; infinite where the tip is not capped. Consecutive caps differ.
    caps: Vec<f64>,
}

impl Feed {
    /// The caps of the chords between `stations`, of which there is one more than `caps`.
    pub(in crate::plan) fn new(stations: &[f64], caps: &[f64]) -> Self {
        let mut feed = Self { starts: Vec::new(), caps: Vec::new() };
        for (&start, &cap) in stations.iter().zip(caps) {
            if feed.caps.last() != Some(&cap) {
                feed.starts.push(start);
                feed.caps.push(cap);
            }
        }
        feed
    }

    /// The cap, if it is constant along the run.
    pub(in crate::plan) fn constant(&self) -> Option<f64> {
        if let [cap] = self.caps[..] { Some(cap) } else { None }
    }

    /// Cap at a station; the lower one where two caps meet.
    pub(in crate::plan) fn at(&self, u: f64) -> f64 {
        let next = self.starts.partition_point(|&start| start <= u).max(1);
        let here = self.caps[next - 1];
        if next > 1 && self.starts[next - 1] == u { here.min(self.caps[next - 2]) } else { here }
    }

    /// Greatest cap from station `a` to station `b`.
    pub(in crate::plan) fn greatest(&self, a: f64, b: f64) -> f64 {
        let first = self.starts.partition_point(|&start| start <= a).max(1) - 1;
        let last = self.starts.partition_point(|&start| start < b).max(first + 1);
        self.caps[first..last].iter().copied().fold(0.0, f64::max)
    }

    /// Stations where the cap changes.
    pub(in crate::plan) fn changes(&self) -> &[f64] {
        &self.starts[1..]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn caps_hold_between_their_changes_and_the_lower_one_where_they_meet() {
        let feed = Feed::new(&[0.0, 10.0, 20.0, 30.0, 40.0], &[5.0, 5.0, 2.0, 7.0]);
        assert_eq!((feed.changes(), feed.constant()), (&[20.0, 30.0][..], None));
        assert_eq!([0.0, 15.0, 20.0, 25.0, 30.0, 31.0, 99.0].map(|u| feed.at(u)), [5.0, 5.0, 2.0, 2.0, 2.0, 7.0, 7.0]);
        assert_eq!([feed.greatest(12.0, 20.0), feed.greatest(19.0, 21.0), feed.greatest(25.0, 31.0)], [5.0, 5.0, 7.0]);
        assert_eq!(Feed::new(&[0.0, 10.0], &[f64::INFINITY]).constant(), Some(f64::INFINITY));
    }
}
