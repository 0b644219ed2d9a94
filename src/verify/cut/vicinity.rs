//! Lines around consecutive places: looked up once for as long as the places stay near.

use crate::geom::{Extent, Point};
use crate::verify::reference::grid::Grid;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;

/// Length of the path whose surroundings are looked up at a time, mm: roughly a blade width.
const WAY: f64 = 8.0;

/// Cache of the chords of lines around consecutive places.
pub(super) struct Vicinity<'a> {
    reference: &'a Reference<'a>,
    grid: &'a Grid,
    /// Greatest distance of a chord that passes a place, mm.
    slack: f64,
    /// Box of the places whose surroundings are known.
    known: Extent,
    /// Chords that pass within `slack` of the box.
    chords: Vec<(&'a Line<'a>, usize)>,
}

impl<'a> Vicinity<'a> {
    /// Empty cache.
    pub(super) fn new(reference: &'a Reference<'a>, grid: &'a Grid, slack: f64) -> Self {
        Self { reference, grid, slack, known: Extent::EMPTY, chords: Vec::new() }
    }

    /// True if the first of the places is farther than the slack from everything that is cut.
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

    /// Looks up the chords around the first places.
    fn look(&mut self, places: &[Point]) {
        let is_near = |place: &&Point| (*place - places[0]).norm() <= WAY;
        self.known = Extent::EMPTY;
        places.iter().take_while(is_near).for_each(|&place| self.known.add(place));
        self.chords.clear();
        let about = self.known.grown(self.slack);
        for run in self.grid.about(about) {
            let line = &self.reference.lines[run.line()];
            let passes = |&chord: &usize| about.meets_box_of(line.ends(chord));
            self.chords.extend(run.chords().filter(passes).map(|chord| (line, chord)));
        }
    }
}
