//! Lines about places that follow each other: looked up once, as long as the places stay near.

use crate::geom::{Extent, Point};
use crate::verify::reference::grid::Grid;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;

/// Length of the way whose surroundings are looked up at a time, mm: about that of a blade.
const WAY: f64 = 8.0;

/// The chords of lines about places that follow each other.
pub(super) struct Vicinity<'a> {
    reference: &'a Reference<'a>,
    grid: &'a Grid,
    /// Greatest distance of a chord that passes a place, mm.
    slack: f64,
    /// The box of the places whose surroundings are known.
    known: Extent,
    /// The chords that pass within `slack` of the box.
    chords: Vec<(&'a Line<'a>, usize)>,
}

impl<'a> Vicinity<'a> {
    /// Surroundings that are still unknown.
    pub(super) fn new(reference: &'a Reference<'a>, grid: &'a Grid, slack: f64) -> Self {
        Self { reference, grid, slack, known: Extent::EMPTY, chords: Vec::new() }
    }

    /// Whether the first of some places is farther from all that is cut than the slack.
    pub(super) fn is_away(&mut self, places: &[Point]) -> bool {
        let place = places[0];
        if !self.known.holds(place) {
            self.look(places);
        }
        let is_near = |&(line, chord): &(&Line, usize)| {
            line.may_reach(chord, place, self.slack) && line.distance_to_chord(chord, place) <= self.slack
        };
        !self.chords.iter().any(is_near)
    }

    /// Looks up the chords about the first places.
    fn look(&mut self, places: &[Point]) {
        let is_near = |place: &&Point| (*place - places[0]).norm() <= WAY;
        self.known = Extent::EMPTY;
        places.iter().take_while(is_near).for_each(|&place| self.known.add(place));
        self.chords.clear();
        let about = self.known.grown(self.slack);
        for run in self.grid.about(about) {
            let line = &self.reference.lines[run.line()];
            let passes = |&chord: &usize| {
                let [from, to] = line.ends(chord);
                Extent::between(from, to).meets(&about)
            };
            self.chords.extend(run.chords().filter(passes).map(|chord| (line, chord)));
        }
    }
}
