//! Planning of a marker at one speed of the conveyor: yields a program or the reason why there is none.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Figures;
use super::bound::{self, Bounds};
use super::chains::{Chain, Line, Parting};
use super::heads::{Links, Schedule, Start, Task};
use super::link::{Link, State, Wait};
use super::moving::Moving;
use super::pace::paced;
use super::placing::{self, Layout};
use super::program::{self, Head, Program};
use super::stroke::{self, Stroke};
use super::track::{BLOCK, Track};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, polyline};
use crate::machine::Job;
use crate::pass::toolpath::Scene;
use crate::units::MM_PER_M;
use crate::units::number::up;

/// The cuts of a marker and the machine that makes them.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub(super) lines: &'a [Line],
    pub(super) scene: &'a Scene<'a>,
    /// Maximum x of the marker, mm.
    pub(super) front: f64,
    pub(super) job: &'a Job,
}

/// Reason why a marker cannot be cut.
#[derive(Debug)]
pub(super) enum Missing {
    /// The conveyor is at least as fast as the heads.
    Axis,
    /// A chain takes more travel along the feed than the heads have.
    Travel {
        /// Travel needed, mm.
        needed: f64,
        /// Start point of the chain.
        at: Point,
    },
    /// The strokes take more heads or rows than the machine has.
    Machine {
        /// Number of heads needed.
        heads: usize,
        /// Number of rows needed.
        rows: usize,
    },
    /// The first row stands too near to the cloth, by this distance, mm.
    Way(f64),
    /// A chain cannot be planned at any pace; these are the findings of the planner.
    Plan(Vec<Diagnostic>),
}

/// Lengths of the turns back allowed within a chain that are tried in turn, as fractions of the travel along the feed. The
/// first one parts a line least.
const BACKS: [f64; 3] = [f64::INFINITY, 0.25, 0.0625];
/// Fraction of the travel that a chain with turns back may use. What it uses beyond that would delay the next chain.
const SHARE: f64 = 0.7;
/// Travel of the unsmoothed chain, as a fraction of the available travel, above which a speed is not tried. Smoothing reduces
/// the travel only slightly.
const HOPELESS: f64 = 1.1;
/// Minimum turn back that parts a line, in multiples of the tolerance.
const WAVE: f64 = 3.0;

/// Plans a marker at a speed of the conveyor.
pub(super) fn attempt(work: &Work, speed: f64, out: &mut Diagnostics) -> Result<Program, Missing> {
    let moving = Moving::new(speed, work.job).ok_or(Missing::Axis)?;
    let cut = |line: &Line| work.cut(line, &moving);
    let made: Vec<_> = work.lines.par_iter().map(cut).collect();
    let mut strokes = Vec::new();
    for made in made {
        let (of_line, found) = made?;
        out.extend(found);
        strokes.extend(of_line);
    }
    let needed = strokes.iter().map(|stroke| (stroke.lag.travel(moving.ramp.way), stroke.points[0]));
    if let Some((needed, at)) = needed.max_by(|a, b| a.0.total_cmp(&b.0))
        && needed > moving.travel
    {
        let needed = needed + work.job.profile.flow.travel_mm - moving.travel;
        return Err(Missing::Travel { needed, at });
    }
    off_table(&strokes, work.job, out);
    work.program(strokes, moving)
}

/// Reports the place where a head leaves the table across the feed by the greatest distance.
fn off_table(strokes: &[Stroke], job: &Job, out: &mut Diagnostics) {
    let Some([least, most]) = job.profile.table.y_mm else { return };
    let ys = strokes.iter().flat_map(|stroke| stroke.poses().map(|(pose, _, _)| pose.centre));
    let off = ys.map(|at| ((least - at.y).max(at.y - most), at)).max_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((beyond, at)) = off.filter(|(beyond, _)| *beyond > 0.0) {
        let message = format!("a head would leave the table across the feed by {} mm", up(beyond, 2));
        let hint = "move the marker across (`sheet.origin`), or mend `table.y_mm`";
        out.push(Diagnostic::new(&code::FLOW_OFF_TABLE, message).on_cloth(at).by(beyond).hint(hint));
    }
}

impl Work<'_> {
    /// True if a speed can be ruled out in closed form: some chain exceeds the travel even if its line is parted at every turn
    /// back.
    pub(super) fn is_hopeless(&self, speed: f64) -> bool {
        let profile = &self.job.profile;
        let bounds = Bounds::of(profile);
        let takes_more = |line: &Line| {
            let parting = self.parting(line, 0.0);
            let most = HOPELESS * profile.flow.travel_mm + line.toolpath.tolerance;
            line.chains(parting).iter().any(|chain| bounds.lag(&chain.way(parting), speed) > most)
        };
        speed >= bounds.speeds[0] || self.lines.par_iter().any(takes_more)
    }

    /// Parting of a line that allows turns back of up to `back` mm within a chain.
    fn parting(&self, line: &Line, back: f64) -> Parting {
        let profile = &self.job.profile;
        Parting {
            back: back.max(WAVE * line.toolpath.tolerance),
            overlap: profile.flow.overlap_mm,
            blade: profile.knife.width_mm,
            corner: profile.corner_angle(),
            unit: self.scene.unit,
        }
    }

    /// The strokes of a line, in as few chains as the travel along the feed allows.
    fn cut(&self, line: &Line, moving: &Moving) -> Result<(Vec<Stroke>, Diagnostics), Missing> {
        let bounds = Bounds::of(&self.job.profile);
        let mut parted = 0;
        let share = |chain: &Chain| if chain.falls { 1.0 } else { SHARE };
        for part in BACKS {
            let parting = self.parting(line, part * moving.travel);
            let chains = line.chains(parting);
            let may_fit = |chain: &Chain| bounds.lag(&chain.way(parting), moving.speed) <= share(chain) * moving.travel;
            if chains.len() == parted || !chains.iter().all(may_fit) {
                continue;
            }
            parted = chains.len();
            let mut found = Diagnostics::default();
            let strokes = self.strokes(&chains, moving, &mut found)?;
            let fits =
                |(stroke, chain): (&Stroke, &Chain)| stroke.lag.travel(moving.ramp.way) <= share(chain) * moving.travel;
            if strokes.iter().zip(&chains).all(fits) {
                return Ok((strokes, found));
            }
        }
        // The line is parted at every turn back here. If the chains do not fit now, they never will.
        let mut found = Diagnostics::default();
        let strokes = self.strokes(&line.chains(self.parting(line, 0.0)), moving, &mut found)?;
        Ok((strokes, found))
    }

    fn strokes(&self, chains: &[Chain], moving: &Moving, out: &mut Diagnostics) -> Result<Vec<Stroke>, Missing> {
        let stroke = |chain: &Chain| {
            let toolpath = stroke::toolpath(chain, self.scene, out);
            paced(chain, &toolpath, moving).map_err(Missing::Plan)
        };
        chains.iter().map(stroke).collect()
    }

    /// Assigns the strokes to heads and rows.
    fn program(&self, strokes: Vec<Stroke>, moving: Moving) -> Result<Program, Missing> {
        let flow = &self.job.profile.flow;
        let tasks: Vec<Task> = strokes.iter().map(|stroke| task(stroke, &moving)).collect();
        let linking = Linking { strokes: &strokes, moving: &moving, blocks: blocks(&strokes) };
        let head = |tasks: Vec<Start>| Head {
            row: 0,
            turns: linking.turns(&tasks),
            waits: vec![Wait::There; tasks.len() + 1],
            tasks,
        };
        let schedule = Schedule { tasks: &tasks, links: &linking };
        let few: Vec<Head> = schedule.heads().into_iter().map(head).collect();
        let (rows, in_rows): (Vec<usize>, Vec<Head>) =
            schedule.heads_in_rows().into_iter().map(|(row, tasks)| (row, head(tasks))).unzip();
        let at_least = heads_at_least(&tasks, &moving);
        let stations = program::stations(self.front, self.job);
        let (speed, figures) = (moving.speed, Figures::default());
        let mut program = Program { strokes, heads: Vec::new(), speed, stations, ticks: 0, figures, moving };
        let layouts = [
            placing::place(&program, (&few, None), self.job),
            placing::place(&program, (&in_rows, Some(rows)), self.job),
        ];
        let is_there = |layout: &Layout| layout.heads.len() <= flow.heads as usize && layout.rows <= flow.rows as usize;
        let cost = |layout: &Layout| (!is_there(layout), layout.heads.len() + layout.rows, layout.heads.len());
        let [a, b] = layouts;
        let layout = if cost(&b) < cost(&a) { b } else { a };
        if !is_there(&layout) {
            return Err(Missing::Machine { heads: layout.heads.len(), rows: layout.rows });
        }
        program.heads = layout.heads;
        let [first, last] = program.extent();
        if first < 0 {
            return Err(Missing::Way(-first as f64 * program.moving.step()));
        }
        program.ticks = last as u64;
        let layout =
            Figures { rows: layout.rows, rows_exact: layout.exact, heads_bound: at_least, ..Figures::default() };
        program.figures = self.figures(&program, &layout);
        Ok(program)
    }

    /// The figures of a program. `layout` supplies those of the layout.
    fn figures(&self, program: &Program, layout: &Figures) -> Figures {
        let profile = &self.job.profile;
        let bounds = Bounds::of(profile);
        let Program { strokes, heads, moving, .. } = program;
        let flow = &profile.flow;
        let (mut travel_bound, mut speed_bound) = (0.0_f64, flow.max_speed_mm_s.min(bounds.speeds[0]));
        for way in strokes.iter().map(|stroke| stroke.way(&profile.knife)) {
            travel_bound = travel_bound.max(bounds.lag(&way, moving.speed));
            // The bound of the earlier strokes holds for most others, so the bisection is rarely needed.
            if bounds.lag(&way, speed_bound) > flow.travel_mm {
                speed_bound = bounds.fastest(&way, flow.travel_mm, speed_bound);
            }
        }
        let time = program.ticks as f64 * moving.period;
        let cutting: f64 = strokes.iter().map(|stroke| f64::from(stroke.ticks) * moving.period).sum();
        let travel = strokes.iter().map(|stroke| stroke.lag.travel(moving.ramp.way)).fold(0.0, f64::max);
        Figures {
            chains: strokes.len(),
            heads: heads.len(),
            chains_abreast: bound::abreast(strokes.iter().map(|stroke| stroke.span)),
            travel_mm: travel,
            travel_bound_mm: travel_bound,
            speed_bound_mm_s: speed_bound,
            cut_m: self.lines.iter().map(|line| polyline::length(&line.run.points)).sum::<f64>() / MM_PER_M,
            time_s: time,
            busy: if heads.is_empty() { 0.0 } else { cutting / (time * heads.len() as f64) },
            ..layout.clone()
        }
    }
}

/// Lower bound on the number of heads: the largest set of tasks no two of which one head can do in sequence. One head cannot do
/// two tasks if each must start before the other is finished and left, even at its earliest start.
fn heads_at_least(tasks: &[Task], moving: &Moving) -> usize {
    let between = i64::from(Link::fewest(moving));
    let spans = tasks.iter().map(|task| [task.window[0] + task.ticks + between, task.window[1]]);
    bound::abreast(spans.filter(|[left, starts]| left > starts).map(|span| span.map(|tick| tick as f64))).max(1)
}

/// Extra distance between two heads beyond the width of a head, mm. Positions are compared block by block only.
const WIDTH_MARGIN: f64 = 0.02;

/// Window of the start of a stroke and its duration, in ticks.
fn task(stroke: &Stroke, moving: &Moving) -> Task {
    let [earliest, latest] = stroke.lag.window(moving).map(|time| time / moving.period);
    Task { window: [earliest.ceil() as i64, latest.floor() as i64], ticks: i64::from(stroke.ticks) }
}

/// Links between the strokes.
struct Linking<'a> {
    strokes: &'a [Stroke],
    moving: &'a Moving,
    /// Minimum and maximum y of each stroke in each block of periods, mm.
    blocks: Vec<Vec<[f64; 2]>>,
}

/// Minimum and maximum y of each stroke in each block of periods, mm.
fn blocks(strokes: &[Stroke]) -> Vec<Vec<[f64; 2]>> {
    let of = |stroke: &Stroke| {
        let mut track = Track::free([0, i64::from(stroke.ticks)]);
        let ys = stroke.poses().map(|(pose, _, _)| pose.centre.y).chain([stroke.ends[1].centre.y]);
        ys.zip(0..).for_each(|(y, tick)| track.put(tick, y));
        track.between([0, i64::from(stroke.ticks)]).to_vec()
    };
    strokes.par_iter().map(of).collect()
}

impl Linking<'_> {
    /// Whole turns of C, rad, added to the motion of each stroke so that C turns least between strokes.
    fn turns(&self, tasks: &[Start]) -> Vec<f64> {
        let mut turns = vec![0.0; tasks.len()];
        for i in 1..tasks.len() {
            let last = self.state(tasks[i - 1], true).c + turns[i - 1];
            turns[i] = self.whole(last - self.state(tasks[i], false).c);
        }
        turns
    }

    /// The whole number of turns nearest to an angle, rad; 0 where the range of C is limited.
    fn whole(&self, angle: f64) -> f64 {
        let is_free = self.moving.either.profile.c.range_deg.is_none();
        if is_free { (angle / TAU).round() * TAU } else { 0.0 }
    }

    fn state(&self, start: Start, is_end: bool) -> State {
        let stroke = &self.strokes[start.task];
        let pose = stroke.ends[usize::from(is_end)];
        let tick = start.tick + if is_end { i64::from(stroke.ticks) } else { 0 };
        State { xi: pose.centre.x + tick as f64 * self.moving.step(), y: pose.centre.y, c: pose.c.0 }
    }
}

impl Links for Linking<'_> {
    fn ticks(&self, from: Start, to: Start) -> i64 {
        let (from, mut to) = (self.state(from, true), self.state(to, false));
        to.c += self.whole(from.c - to.c);
        i64::from(Link::least([from, to], [true; 2], self.moving))
    }

    fn cost(&self, from: usize, to: usize) -> f64 {
        (self.strokes[from].ends[1].centre.y - self.strokes[to].ends[0].centre.y).abs()
    }

    fn side(&self, of: Start, other: Start) -> Option<f64> {
        let (own, others) = (&self.blocks[of.task], &self.blocks[other.task]);
        let width = self.moving.either.profile.flow.head_width_mm + WIDTH_MARGIN;
        let mut side: Option<f64> = None;
        for (i, a) in (0_i64..).zip(own) {
            // The blocks of two strokes are not aligned: a block of one overlaps two blocks of the other.
            let first = (of.tick + i * BLOCK - other.tick).div_euclid(BLOCK);
            for k in [first, first + 1] {
                let Some(b) = usize::try_from(k).ok().and_then(|k| others.get(k)) else { continue };
                let here = if b[0] - a[1] >= width {
                    1.0
                } else if a[0] - b[1] >= width {
                    -1.0
                } else {
                    return Some(0.0);
                };
                if side.is_some_and(|side| side * here < 0.0) {
                    return Some(0.0);
                }
                side = Some(here);
            }
        }
        side
    }
}
