//! Declarations of a finished toolpath: its unavoidable deviations from the drawing.

use std::collections::BTreeSet;

use super::cloth::Cloth;
use super::plunge::{Plunge, WORTH_SHARE};
use super::swing::{Swing, swing};
use crate::geom::{Point, polyline};
use crate::ir::declaration::{Declaration, Kind, Total, Which};
use crate::ir::toolpath::{End, Overcut, PlungeCut, Run, Shape, Side, Step};
use crate::ir::{Marker, Toolpath};
use crate::machine::Knife;

/// Difference of lengths that count as equal, mm: rounding.
const SAME_EPSILON: f64 = 1e-6;
/// Precision of declared values, steps per mm; magnitudes are rounded upwards. People read them.
const PER_MM: f64 = 1000.0;

/// Declarations of the toolpath of a cut on this cloth. `drawn` is the index of the cut in the marker and its line, which ends
/// with its first point if it is closed; `moved` gives the swing of a run in its planned motion by the index of the run, and
/// `None` without a motion.
pub fn declarations(
    toolpath: &Toolpath,
    (cut, drawn): (u32, &[Point]),
    moved: &dyn Fn(usize) -> Option<Swing>,
    knife: &Knife,
    cloth: &Cloth,
) -> Vec<Declaration> {
    let drawn = Drawn { points: drawn, stations: polyline::stations(drawn) };
    let mut of_cut = OfCut { toolpath, cut, drawn, knife, cloth, last: 0, found: Vec::new() };
    let mut runs = 0..;
    for step in &toolpath.steps {
        match step {
            Step::Run(run) => {
                let index = runs.next().expect("runs are counted");
                of_cut.run(run, &|| moved(index));
            }
            Step::PlungeCut(plunge_cut) => of_cut.plunge_cut(plunge_cut),
            Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    of_cut.found
}

/// Totals of the declarations of a marker's program, ordered by kind.
pub fn totals(declared: &[Declaration], marker: &Marker) -> Vec<Total> {
    let of_kind = |kind: Kind| {
        let of_kind = || declared.iter().filter(|entry| entry.kind == kind);
        let (count, pieces) = (of_kind().count(), of_kind().map(|entry| marker.cuts[entry.cut as usize].piece));
        let pieces = pieces.collect::<BTreeSet<_>>().len();
        // The first of several equal ones.
        let worst = of_kind().reduce(|worst, next| if next.size_mm() > worst.size_mm() { next } else { worst })?;
        let piece = &marker.pieces[marker.cuts[worst.cut as usize].piece as usize];
        let (piece, copy) = (piece.number, piece.copy);
        Some(Total { kind, count, pieces, worst_mm: worst.size_mm(), piece, copy, at_mm: worst.at_mm })
    };
    Kind::ALL.into_iter().filter_map(of_kind).collect()
}

/// Cut as it is drawn.
struct Drawn<'a> {
    points: &'a [Point],
    /// Distance along the line from its start to each point, mm.
    stations: Vec<f64>,
}

impl Drawn<'_> {
    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Point at a station, mm.
    fn place(&self, station: f64) -> Point {
        polyline::place(self.points, &self.stations, station)
    }

    /// First chord, searched from `from` on, on which two points lie in its direction, and the station of the first point.
    fn find(&self, [a, b]: [Point; 2], from: usize) -> Option<(usize, f64)> {
        let chords = self.points.len() - 1;
        (0..chords).map(|i| (from + i) % chords).find_map(|chord| {
            let [start, end] = [self.points[chord], self.points[chord + 1]];
            let is_on = |point| polyline::distance_to_segment(point, start, end) <= SAME_EPSILON;
            let goes_along = (b - a).dot(&(end - start)) > 0.0;
            (goes_along && is_on(a) && is_on(b)).then(|| (chord, self.stations[chord] + (a - start).norm()))
        })
    }
}

/// Size of a deviation, mm, as its kind defines it, and the place at which it is greatest.
#[derive(Debug, Clone, Copy)]
struct Magnitude {
    by: f64,
    at: Point,
}

impl Magnitude {
    /// The farthest of some points, which are at least one.
    fn of(points: &[Point], distance: impl Fn(Point) -> f64) -> Self {
        let all = points.iter().map(|&at| Self { by: distance(at), at });
        all.reduce(|worst, next| if next.by > worst.by { next } else { worst }).expect("one point at least")
    }
}

/// Collects the declarations of one cut.
struct OfCut<'a> {
    toolpath: &'a Toolpath,
    cut: u32,
    drawn: Drawn<'a>,
    knife: &'a Knife,
    cloth: &'a Cloth<'a>,
    /// Chord of the cut that was found last: the next stretch is on it or behind it.
    last: usize,
    found: Vec<Declaration>,
}

impl OfCut<'_> {
    fn run(&mut self, run: &Run, moved: &dyn Fn() -> Option<Swing>) {
        let Some(ends) = self.stations(&run.points, run.turned) else { return };
        self.plunge(run, ends);
        if let Some(drawn) = swing(run, self.knife.width_mm).filter(|drawn| drawn.off > self.knife.max_bow_mm) {
            let moved = moved();
            let shown = moved.unwrap_or(drawn);
            self.declare(Kind::Swing, ends, None, Magnitude { by: drawn.off, at: shown.tip });
            let within = self.cloth.part_at(shown.at);
            let last = self.found.last_mut().expect("one was declared");
            last.within = within;
            last.seen_mm = moved.map(|moved| rounded(moved.off.min(drawn.off)));
        }
        self.ends([run.heel, run.front], run.ends, run.turned, ends, run.shape);
        let stands_still = self.stands_still(run);
        if stands_still {
            self.nibble(&run.points, run.ends, ends);
        }
        for (which, (end, by)) in [Which::Start, Which::End].into_iter().zip(run.ends.iter().zip([run.heel, run.front]))
        {
            let station = end_of(ends, which, run.turned);
            match end.side {
                Side::Contour if stands_still => {}
                Side::Contour => {
                    let at = which.of(&run.points);
                    self.declare(Kind::Lift, [station; 2], Some(which), Magnitude { by: 0.0, at });
                }
                Side::Part if by > SAME_EPSILON => {
                    let at = which.of(&run.extended());
                    self.declare(Kind::Overcut, [station; 2], Some(which), Magnitude { by, at });
                    self.found.last_mut().expect("one was declared").within = Some(self.toolpath.part);
                }
                Side::Waste | Side::Part | Side::Gap => {}
            }
        }
    }

    fn plunge_cut(&mut self, cut: &PlungeCut) {
        let Some(ends) = self.stations(&cut.points, cut.turned) else { return };
        let [from, to] = [cut.points[0], cut.points[cut.points.len() - 1]];
        let farthest = Magnitude::of(&cut.points, |point| polyline::distance_to_segment(point, from, to));
        if farthest.by > self.worth() {
            self.declare(Kind::Plunge, ends, None, farthest);
        }
        self.nibble(&cut.points, cut.ends, ends);
        let tip = cut.pose.centre + cut.along * self.knife.radius();
        let beyond = [[from, tip - cut.along * self.knife.width_mm], [to, tip]];
        for ((which, Overcut { own, other }), beyond) in
            [Which::Start, Which::End].into_iter().zip(cut.overcut).zip(beyond)
        {
            let at = beyond[1];
            if own > 0.0 {
                self.declare(Kind::Surplus, ends, Some(which), Magnitude { by: own, at });
                self.in_part(Some(self.toolpath.part));
            }
            if other > 0.0 {
                self.declare(Kind::Surplus, ends, Some(which), Magnitude { by: other, at });
                self.in_part(self.cloth.deepest_other(self.toolpath.part as usize, beyond));
            }
        }
        self.ends([cut.heel, cut.front], cut.ends, cut.turned, ends, Shape::Open);
    }

    /// True if the tip of the blade stays within the reach of smoothing around its plunge on a run: a leg of a nibbled curve
    /// that is hardly longer than the blade.
    fn stands_still(&self, run: &Run) -> bool {
        let width = self.knife.width_mm;
        if width == 0.0 || run.shape != Shape::Open {
            return false;
        }
        let path = run.extended();
        Plunge::at_start(&path, width).stands_still(&path, self.toolpath.tolerance)
    }

    /// Declares the cut of a blade that stands still over some points as nibbled where the contour goes on from one of its
    /// ends.
    fn nibble(&mut self, points: &[Point], ends: [End; 2], stretch: [f64; 2]) {
        if ends.iter().any(|end| end.side == Side::Contour) {
            self.declare(Kind::Nibbled, stretch, None, Magnitude { by: polyline::length(points), at: points[0] });
        }
    }

    /// Declares the distance of the path from the blade that is plunged at its start.
    fn plunge(&mut self, run: &Run, [from, to]: [f64; 2]) {
        if self.knife.width_mm == 0.0 {
            return;
        }
        let path = if run.shape == Shape::Ring { run.points.clone() } else { run.extended() };
        let plunge = Plunge::at_start(&path, self.knife.width_mm);
        let Magnitude { by, at } = Magnitude::of(&path[..=plunge.chord], |point| plunge.distance(point));
        if by > self.worth() {
            let way = polyline::length(&path[..=plunge.chord]) + (plunge.tip - path[plunge.chord]).norm();
            let stretch = if run.turned { [to - way, to] } else { [from, from + way] };
            // Smoothing moves both the path and the place of the tip on it.
            let most = Magnitude { by: by + self.toolpath.tolerance, at };
            self.declare(Kind::Plunge, stretch.map(|station| self.on_cut(station)), None, most);
        }
    }

    /// Declares the overlaps that are shorter than in the profile.
    fn ends(&mut self, given: [f64; 2], ends: [End; 2], turned: bool, stretch: [f64; 2], shape: Shape) {
        let knife = self.knife;
        let asked = [
            (knife.heel_overlap_mm, knife.corner_heel_overlap_mm, knife.reflex_heel_overlap_mm),
            (knife.front_overlap_mm, knife.corner_front_overlap_mm, knife.reflex_front_overlap_mm),
        ];
        for (i, which) in [Which::Start, Which::End].into_iter().enumerate() {
            let (plain, at_corner, reflex) = asked[i];
            let asked = match ends[i].side {
                _ if ends[i].bare || shape == Shape::Ring && i == 0 => 0.0,
                Side::Part => reflex,
                Side::Contour => 0.0,
                Side::Waste | Side::Gap if ends[i].corner => at_corner,
                Side::Waste | Side::Gap => plain,
            };
            if asked - given[i] > SAME_EPSILON {
                let station = end_of(stretch, which, turned);
                let missing = Magnitude { by: asked - given[i], at: self.drawn.place(station) };
                self.declare(Kind::Shortened, [station; 2], Some(which), missing);
            }
        }
    }

    fn worth(&self) -> f64 {
        WORTH_SHARE * self.toolpath.tolerance
    }

    /// Stations at the ends of a stretch of the cut, in the direction in which that is drawn.
    fn stations(&mut self, points: &[Point], turned: bool) -> Option<[f64; 2]> {
        let last = points.len() - 1;
        let (first, end) = if turned { ([last, last - 1], [1, 0]) } else { ([0, 1], [last - 1, last]) };
        let (chord, from) = self.drawn.find(first.map(|i| points[i]), self.last)?;
        let (chord, before) = self.drawn.find(end.map(|i| points[i]), chord)?;
        self.last = if turned { 0 } else { chord };
        Some([from, before + (points[end[1]] - points[end[0]]).norm()])
    }

    /// Station brought back onto the cut: on a closed one it may lie on another lap.
    fn on_cut(&self, station: f64) -> f64 {
        let length = self.drawn.length();
        let is_closed = self.drawn.points.first() == self.drawn.points.last();
        if is_closed && !(0.0..=length).contains(&station) {
            station.rem_euclid(length)
        } else {
            station.clamp(0.0, length)
        }
    }

    /// Sets the part in which the last declared deviation is.
    fn in_part(&mut self, part: Option<u32>) {
        self.found.last_mut().expect("one was declared").part = part;
    }

    fn declare(&mut self, kind: Kind, stretch: [f64; 2], end: Option<Which>, Magnitude { by, at }: Magnitude) {
        let [from_mm, to_mm] = stretch.map(rounded);
        let (magnitude_mm, at_mm) = ((by * PER_MM).ceil() / PER_MM, [at.x, at.y].map(rounded));
        let (cut, part, seen_mm, within) = (self.cut, None, None, None);
        self.found.push(Declaration { kind, cut, from_mm, to_mm, end, part, magnitude_mm, at_mm, seen_mm, within });
    }
}

/// A value for people. Zero is added to make 0 of -0.
fn rounded(value: f64) -> f64 {
    (value * PER_MM).round() / PER_MM + 0.0
}

/// Station of the end of a stretch at which it is plunged or lifted.
fn end_of([from, to]: [f64; 2], which: Which, turned: bool) -> f64 {
    if (which == Which::Start) == turned { to } else { from }
}
