//! Waiting positions of the heads of one row between their chains. Heads cannot pass each other and make room for those that
//! cut.
//!
//! Heads are handled from the lowest to the highest. Between two chains a head waits at the start of the next one, at the end
//! of the last one, or at a third place. It takes the first of these that keeps one head width from the head below and, for
//! each cutting head n places above, n head widths from that head.

use super::link::{Gap, Link, State, Wait};
use super::moving::Moving;
use super::track::{BLOCK, Track};

/// A head of a row with its chains.
#[derive(Debug, Clone)]
pub(super) struct Mate {
    /// Track of the head while it cuts; free otherwise.
    pub(super) busy: Track,
    /// First and end tick of each chain, and the states at both.
    pub(super) chains: Vec<([i64; 2], [State; 2])>,
}

/// Common data of a row of heads.
pub(super) struct Room<'a> {
    pub(super) moving: &'a Moving,
    /// Minimum distance of two heads, mm.
    pub(super) width: f64,
    /// First and last tick of the program.
    pub(super) span: [i64; 2],
    /// Permitted positions across the feed, mm.
    pub(super) table: [f64; 2],
}

/// A head and its neighbours in the row.
struct Between<'a> {
    mate: &'a Mate,
    /// Track of the head below, with its waits.
    below: Option<&'a Track>,
    /// Tracks of the heads above while they cut, each with the number of places between it and this head.
    above: Vec<(&'a Track, f64)>,
}

/// Extra distance beyond the width of a head, mm: positions are recorded only at some periods.
const MARGIN: f64 = 0.01;

impl Room<'_> {
    /// Waiting positions of each head of a row before, between and after its chains; `None` if there is no room. `mates` are
    /// sorted from the lowest to the highest.
    pub(super) fn waits(&self, mates: &[&Mate]) -> Option<Vec<Vec<Wait>>> {
        let mut below: Option<Track> = None;
        let mut all = Vec::with_capacity(mates.len());
        for (k, mate) in mates.iter().enumerate() {
            let above = mates[k + 1..].iter().zip(1..).map(|(mate, n)| (&mate.busy, f64::from(n))).collect();
            let between = Between { mate, below: below.as_ref(), above };
            let mut track = mate.busy.clone();
            let waits: Option<Vec<Wait>> =
                (0..=mate.chains.len()).map(|gap| self.wait(&between, gap, &mut track)).collect();
            all.push(waits?);
            below = Some(track);
        }
        Some(all)
    }

    /// Finds the waiting position of a head in a gap between its chains, and records the motion in its track.
    fn wait(&self, between: &Between, gap: usize, track: &mut Track) -> Option<Wait> {
        let Between { mate, below, above } = between;
        let before = gap.checked_sub(1).map(|i| mate.chains[i]);
        let behind = mate.chains.get(gap).copied();
        let span =
            [before.map_or(self.span[0], |(ticks, _)| ticks[1]), behind.map_or(self.span[1], |(ticks, _)| ticks[0])];
        let gap_width = self.width + MARGIN;
        let blocks = below.or(above.first().map(|above| above.0)).map_or(0, |track| track.between(span).len());
        let mut corridor = vec![self.table; blocks];
        if let Some(below) = below {
            for (room, block) in corridor.iter_mut().zip(below.between(span)) {
                room[0] = room[0].max(block[1] + gap_width);
            }
        }
        for (above, heads) in above {
            for (room, block) in corridor.iter_mut().zip(above.between(span)) {
                room[1] = room[1].min(block[0] - *heads * gap_width);
            }
        }
        let ends = [before.map(|(_, states)| states[1]), behind.map(|(_, states)| states[0])];
        let found = self.candidates(ends, &corridor).into_iter().find_map(|wait| {
            let link = self.link(ends, span, wait)?;
            link.has_time().then_some(())?;
            keeps(&link, span, &corridor, track.begin(span[0])).then_some((wait, link))
        });
        let (wait, link) = found?;
        let step = BLOCK as usize / 2;
        (0..=link.ticks)
            .step_by(step)
            .chain([link.ticks])
            .for_each(|tick| track.put(span[0] + i64::from(tick), link.y(tick)));
        Some(wait)
    }

    /// Candidates for the waiting position, the simplest first.
    fn candidates(&self, ends: [Option<State>; 2], corridor: &[[f64; 2]]) -> Vec<Wait> {
        let mut waits = vec![Wait::There, Wait::Here];
        let [low, high] = corridor.iter().fold(self.table, |[low, high], room| [low.max(room[0]), high.min(room[1])]);
        if low <= high {
            let ys = ends.iter().flatten().map(|state| state.y.clamp(low, high));
            waits.extend(ys.map(Wait::At));
            waits.extend([low, high].into_iter().filter(|y| y.is_finite()).map(Wait::At));
        }
        waits
    }

    /// The link in a gap. At an end of the program the head is at its waiting position.
    fn link(&self, ends: [Option<State>; 2], [from, to]: [i64; 2], wait: Wait) -> Option<Link> {
        let states = ends_of(ends, wait)?;
        let ticks = u32::try_from(to - from).ok()?;
        Some(Link::new(&Gap { ends: states, moves: ends.map(|end| end.is_some()), wait }, ticks, self.moving))
    }
}

/// States of a head at both ends of a gap; at an end of the program it is at its waiting position.
pub(super) fn ends_of(ends: [Option<State>; 2], wait: Wait) -> Option<[State; 2]> {
    let own = ends[0].or(ends[1])?;
    let y = match wait {
        Wait::At(y) => y,
        Wait::There | Wait::Here => own.y,
    };
    Some(ends.map(|end| end.unwrap_or(State { y, ..own })))
}

/// True if a link stays within a corridor, given as one range per block, from the tick `begin` on.
fn keeps(link: &Link, [from, _]: [i64; 2], corridor: &[[f64; 2]], begin: i64) -> bool {
    corridor.iter().zip(0..).all(|(&[low, high], block)| {
        let ticks = [begin + block * BLOCK, begin + (block + 1) * BLOCK];
        ticks.into_iter().all(|tick| {
            let tick = (tick - from).clamp(0, i64::from(link.ticks)) as u32;
            (low..=high).contains(&link.y(tick))
        })
    })
}
