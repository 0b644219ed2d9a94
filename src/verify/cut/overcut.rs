//! What the blade cuts beyond the ends of its line, and of what: its own part, another one, or waste.
//!
//! A place counts as cut into a part when it lies deeper in it than the tolerance, away from all that is cut anyway. The
//! own part may be cut as far as the profile has it for reflex corners. A blade that never moves and is longer than its
//! cut may harm what no other place for it would spare: then the compile has warned. How much that is, is found here
//! anew, from the room that there is at both ends.

use std::ops::{Range, RangeInclusive};

use super::body::Cut;
use super::follow::Foot;
use crate::geom::{Point, Vector, polyline};
use crate::ir::finding::Sighting;
use crate::machine::MachineProfile;
use crate::verify::reference::grid::{Grid, Run};
use crate::verify::reference::inside::Inside;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;
use crate::verify::worst::Worst;

/// Distance of two places at which a way is looked at, mm.
const STEP: f64 = 0.05;
/// Part of the tolerance by which a way that is thought to be free may lie in a part: less than by which any cut may,
/// so that what a blade was placed by is never taken for more room than it was.
const ROOM_SHARE: f64 = 0.5;
/// Length, in how near it is, from which on a way is along an edge: one that crosses it at 30 degrees or more is not.
const ALONG: f64 = 2.0;
/// Parts that overlap by less touch, mm: their outlines were rounded each by itself.
const OVERLAP_MIN: f64 = 0.2;
/// Halvings that find where a way enters a part: from a quarter of a millimetre to rounding.
const HALVINGS: usize = 20;

/// Judges overcuts.
#[derive(Debug)]
pub(in crate::verify) struct Overcut<'a> {
    inside: &'a Inside<'a>,
    /// Rounding of a tip's place, mm.
    rounding: f64,
    tolerance: f64,
    /// How deep an end of a line lies in another part that is drawn there, mm; less is rounding of one of both.
    drawn: f64,
    width: f64,
    /// How far a blade that has the choice stays away from parts, mm.
    clearance: f64,
    /// How far the profile lets the blade cut into the part at a reflex corner, mm.
    reflex: f64,
    /// What the profile allows in the part itself and in others, mm.
    allowed: [Option<f64>; 2],
}

/// The worst overcuts, by what they go into.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Overcuts {
    pub(in crate::verify) part: Worst,
    pub(in crate::verify) neighbour: Worst,
    pub(in crate::verify) waste: Worst,
}

impl Overcuts {
    /// None yet; the tip may leave its line by `tolerance` mm.
    pub(in crate::verify) fn new(profile: &MachineProfile, tolerance: f64) -> Self {
        let verify = &profile.verify;
        let in_part = verify.max_overcut_part_mm.map(|most| most + tolerance);
        Self {
            part: Worst::new("verify/overcut-part", "mm", in_part),
            neighbour: Worst::new("verify/overcut-neighbour", "mm", verify.max_overcut_neighbour_mm),
            waste: Worst::new("verify/overcut-waste", "mm", verify.max_overcut_waste_mm),
        }
    }
}

/// How far a stroke goes in parts beyond the ends of its line: in its own, and in others.
#[derive(Debug, Clone, Copy, Default)]
struct Entered {
    /// All stretches together, mm.
    sums: [f64; 2],
    /// The longest one, mm.
    longest: [f64; 2],
    /// Its place.
    at: [usize; 2],
}

/// A stroke on its line.
pub(in crate::verify) struct Ends<'a> {
    pub(in crate::verify) cut: &'a Cut,
    pub(in crate::verify) feet: &'a [Foot],
    /// The places that are held to the line.
    pub(in crate::verify) held: &'a RangeInclusive<usize>,
    pub(in crate::verify) line: &'a Line<'a>,
    /// The joints between which it is a plunge cut that fits what was left of its line; where the knife may have been
    /// lifted anywhere, the ends of what it cuts anew.
    pub(in crate::verify) fits: Option<[[f64; 2]; 2]>,
}

/// All lines, and those near a place.
#[derive(Clone, Copy)]
pub(in crate::verify) struct Lines<'a> {
    pub(in crate::verify) reference: &'a Reference<'a>,
    pub(in crate::verify) grid: &'a Grid,
}

/// What lies at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cloth {
    Part,
    Neighbour,
    Waste,
}

impl<'a> Overcut<'a> {
    /// For parts in which places lie, a tip that may leave its line by `tolerance` mm, and places that are rounded to
    /// `rounding` mm.
    pub(in crate::verify) fn new(
        Reference { tolerance, marker, .. }: &Reference,
        inside: &'a Inside<'a>,
        profile: &MachineProfile,
        rounding: f64,
    ) -> Self {
        let (knife, verify) = (&profile.knife, &profile.verify);
        let unit = marker.unit;
        Self {
            inside,
            rounding,
            tolerance: tolerance + rounding,
            drawn: OVERLAP_MIN.max(unit * std::f64::consts::SQRT_2),
            width: knife.width_mm,
            clearance: knife.clearance_mm,
            reflex: knife.reflex_front_overlap_mm.max(knife.reflex_heel_overlap_mm),
            allowed: [verify.max_overcut_part_mm, verify.max_overcut_neighbour_mm],
        }
    }

    /// Judges what a stroke cuts beyond the ends of its line.
    pub(in crate::verify) fn see(
        &self,
        stroke: &Ends,
        lines: Lines,
        seen: &impl Fn(usize) -> Sighting,
        overcuts: &mut Overcuts,
    ) {
        let joints = stroke.joints();
        let beyond: Vec<f64> = (0..stroke.feet.len()).map(|i| stroke.beyond(i, joints)).collect();
        if beyond.iter().all(|&beyond| beyond <= self.rounding) {
            return;
        }
        let points = &stroke.cut.points;
        let cloth: Vec<Option<Cloth>> = (0..points.len())
            .map(|i| (beyond[i] > self.rounding).then(|| self.at(points[i], stroke.line, lines)))
            .collect();
        let mut entered = Entered::default();
        let mut from = 0;
        for group in cloth.chunk_by(|a, b| a == b) {
            let range = from..from + group.len();
            from = range.end;
            let far = range.clone().max_by(|&a, &b| beyond[a].total_cmp(&beyond[b])).expect("a chunk is never empty");
            let kind = match group[0] {
                None => continue,
                Some(Cloth::Waste) => {
                    overcuts.waste.see(beyond[far], || seen(far));
                    continue;
                }
                Some(Cloth::Part) => 0,
                Some(Cloth::Neighbour) => 1,
            };
            if !range.clone().any(|i| lines.is_away(points[i], self.tolerance)) {
                continue;
            }
            let entry = came_from(&beyond, range).map_or(0.0, |[before, near]| {
                let way = self.entered([points[before], points[near]], group[0], stroke.line, lines);
                (beyond[near] - way).max(0.0)
            });
            let length = beyond[far] - entry.clamp(0.0, beyond[far]);
            entered.sums[kind] += length;
            if length > entered.longest[kind] {
                (entered.longest[kind], entered.at[kind]) = (length, far);
            }
        }
        self.hold(&entered, stroke, lines, seen, overcuts);
    }

    /// Holds what a stroke cuts of parts against what may be: of a plunge cut all of it, of any other the longest stretch.
    fn hold(
        &self,
        entered: &Entered,
        stroke: &Ends,
        lines: Lines,
        seen: &impl Fn(usize) -> Sighting,
        overcuts: &mut Overcuts,
    ) {
        let Entered { sums, longest, at } = *entered;
        let is_plunge_cut = stroke.cut.is_plunge_cut();
        let is_any = longest.iter().any(|&length| length > 0.0);
        let spared = if is_plunge_cut && is_any { self.unavoidable(stroke, lines) } else { [0.0; 2] };
        let [part, neighbour] = if is_plunge_cut { sums } else { longest };
        let [of_part, of_neighbour] = self.allowed.map(|allowed| allowed.unwrap_or(f64::INFINITY));
        let reflex = if is_plunge_cut { 2.0 * self.reflex } else { self.reflex };
        if part > 0.0 {
            overcuts.part.see_under(part, of_part + self.tolerance + reflex.max(spared[0]), || seen(at[0]));
        }
        if neighbour > 0.0 {
            let unspared = if spared[1] > 0.0 { spared[1] + self.tolerance } else { 0.0 };
            overcuts.neighbour.see_under(neighbour, of_neighbour + unspared, || seen(at[1]));
        }
    }

    /// What lies at a place beyond an end of a line. A part in which the line itself lies is no neighbour: so it is drawn.
    fn at(&self, point: Point, line: &Line, lines: Lines) -> Cloth {
        let pieces = self.inside.pieces_at(point);
        if pieces.contains(&self.inside.part_of(line.piece as usize)) {
            return Cloth::Part;
        }
        let is_drawn_in = |piece: &usize| {
            let ends = [line.point(0), line.point(line.chords())];
            ends.into_iter()
                .any(|end| self.inside.pieces_at(end).contains(piece) && lines.is_away_from(end, *piece, self.drawn))
        };
        if pieces.iter().all(is_drawn_in) { Cloth::Waste } else { Cloth::Neighbour }
    }

    /// How far before the second of two places, between which a way enters some cloth, it does so, mm.
    fn entered(&self, [mut before, behind]: [Point; 2], cloth: Option<Cloth>, line: &Line, lines: Lines) -> f64 {
        let mut after = behind;
        for _ in 0..HALVINGS {
            let middle = before + (after - before) / 2.0;
            if Some(self.at(middle, line, lines)) == cloth { after = middle } else { before = middle }
        }
        (behind - after).norm()
    }

    /// What a blade that does not move must cut of its own part and, even if it may cut that, of others, mm: what it is
    /// longer by than its cut and the room at both ends.
    fn unavoidable(&self, stroke: &Ends, lines: Lines) -> [f64; 2] {
        let Some([from, to]) = stroke.fits else { return [0.0; 2] };
        // Behind a slight bend a blade stays in the tolerance band for a while, so that it may have been meant to end
        // at either.
        let [inner, outer] =
            [innermost([from, to]), [from[0], to[1]]].map(|ends| self.spared(ends, stroke.line, lines));
        [0, 1].map(|i| inner[i].max(outer[i]))
    }

    /// The same where the cut goes from one station of its line to another.
    fn spared(&self, stations: [f64; 2], line: &Line, lines: Lines) -> [f64; 2] {
        let [start, end] = stations.map(|station| line.place(station));
        let Some(along) = polyline::direction(start, end) else { return [0.0; 2] };
        let rooms = [self.room(start, -along, line, lines), self.room(end, along, line, lines)];
        let surplus = self.width - (end - start).norm();
        let clear = |gap: f64| (gap - self.clearance).max(0.0);
        let least = |room: [f64; 2]| clear(room[0].min(room[1]));
        let other = |room: [f64; 2]| clear(room[1]);
        let spared = [surplus - least(rooms[0]) - least(rooms[1]), surplus - other(rooms[0]) - other(rooms[1])];
        spared.map(|spared| spared.max(0.0))
    }

    /// How far a blade reaches into the part, alike at both ends, where it cuts a line by as many plunges of one length
    /// as keep it within the tolerance, mm: chords of an arc of its length and its turn.
    pub(in crate::verify) fn of_nibbles(&self, line: &Line, lines: Lines) -> f64 {
        let turned: f64 = (1..line.chords()).map(|vertex| line.turn(vertex).abs()).sum();
        let count = (line.length() * turned / (8.0 * self.tolerance)).sqrt().ceil().max(1.0);
        let station = |i: f64| line.length() * i / count;
        let of = |i: usize| self.spared([station(i as f64), station((i + 1) as f64)], line, lines)[0] / 2.0;
        (0..count as usize).map(of).fold(0.0, f64::max)
    }

    /// How far a way from a place goes before it enters the part, and before it enters another, mm; the blade's width when
    /// it does not.
    fn room(&self, from: Point, along: Vector, line: &Line, lines: Lines) -> [f64; 2] {
        let mut room = [self.width; 2];
        let mut entry: Option<(Cloth, f64)> = None;
        // From where on it runs along an edge that is cut anyway: rounding decides in what cloth that is.
        let mut edge: Option<f64> = None;
        let steps = (self.width / STEP).ceil() as usize;
        let slack = ROOM_SHARE * self.tolerance;
        for i in 1..=steps {
            let way = STEP * i as f64;
            let (place, before) = (from + along * way, from + along * (way - STEP));
            let cloth = self.at(place, line, lines);
            let kind = match cloth {
                Cloth::Waste => {
                    let is_along = !lines.is_away(place, slack);
                    (entry, edge) = (None, if is_along { edge.or(Some(way - STEP)) } else { None });
                    continue;
                }
                Cloth::Part => 0,
                Cloth::Neighbour => 1,
            };
            let entered = match entry {
                Some((same, entered)) if same == cloth => entered,
                Some(_) | None if i == 1 => 0.0,
                // What crosses an edge is as near to it only for a little.
                Some(_) | None => match edge {
                    Some(edge) if way - edge > ALONG * slack => edge,
                    Some(_) | None => way - self.entered([before, place], Some(cloth), line, lines),
                },
            };
            (entry, edge) = (Some((cloth, entered)), None);
            if lines.is_away(place, slack) {
                room[kind] = room[kind].min(entered);
            }
        }
        room
    }
}

/// Of the joints at which a plunge cut may begin and those at which it may end, the two nearest to each other; the
/// outermost when these are not in order.
pub(super) fn innermost([from, to]: [[f64; 2]; 2]) -> [f64; 2] {
    if from[1] < to[0] { [from[1], to[0]] } else { [from[0], to[1]] }
}

impl Ends<'_> {
    /// The outermost joints between which it is a plunge cut that fits what was left of its line, and the direction
    /// from the one to the other.
    fn joints(&self) -> Option<([Point; 2], Vector)> {
        let [from, to] = self.fits?;
        let ends = [from[0], to[1]].map(|station| self.line.place(station));
        Some((ends, polyline::direction(ends[0], ends[1])?))
    }

    /// How far place `i` stands beyond the joints of a plunge cut, an end of the line, or what is held to that, mm.
    fn beyond(&self, i: usize, joints: Option<([Point; 2], Vector)>) -> f64 {
        if let Some(([start, end], along)) = joints {
            let point = self.cut.points[i];
            return (start - point).dot(&along).max((point - end).dot(&along)).max(0.0);
        }
        if self.held.contains(&i) {
            return self.feet[i].beyond;
        }
        let edge = i.clamp(*self.held.start(), *self.held.end());
        self.feet[i].beyond.max((self.cut.points[i] - self.cut.points[edge]).norm())
    }
}

impl Lines<'_> {
    /// Whether a place is farther than `slack` mm from all that is cut.
    fn is_away(self, point: Point, slack: f64) -> bool {
        self.grid.near(point, slack).all(|run| self.is_away_from_run(run, point, slack))
    }

    /// Whether it is from what is cut of a piece.
    fn is_away_from(self, point: Point, piece: usize, slack: f64) -> bool {
        let mut near = self.grid.near(point, slack);
        near.all(|run| {
            self.reference.lines[run.line()].piece as usize != piece || self.is_away_from_run(run, point, slack)
        })
    }

    fn is_away_from_run(self, run: &Run, point: Point, slack: f64) -> bool {
        let line = &self.reference.lines[run.line()];
        run.chords().all(|chord| line.distance_to_chord(chord, point) > slack)
    }
}

/// The place before a stretch of places beyond an end of a line, and the place of the stretch beside it: on the side where
/// the stretch is entered, which is less far beyond. `None` where it begins at its farthest.
fn came_from(beyond: &[f64], stretch: Range<usize>) -> Option<[usize; 2]> {
    let before = stretch.start.checked_sub(1).map(|before| [before, stretch.start]);
    let behind = Some([stretch.end, stretch.end - 1]).filter(|[behind, _]| *behind < beyond.len());
    let sides = [before, behind].into_iter().flatten().filter(|&[outer, inner]| beyond[outer] < beyond[inner]);
    sides.min_by(|a, b| beyond[a[0]].total_cmp(&beyond[b[0]]))
}
