//! A page that plays a program: the cloth under the rows, the heads in them, the cuts so far. It needs nothing but a browser.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::markup::color;
use super::target::{Emit, Target};
use crate::flow::program::{Program, Setpoint};
use crate::ir::Marker;
use crate::picture::{Columns, Page, Script};
use crate::units::deg;

pub(super) const TARGET: Target = Target {
    name: "html",
    about: "a page that plays the program: cloth and heads moving",
    extension: "html",
    emit: Emit::Whole { stem: "player", write },
    proof: None,
};

/// Time between two places of a head where there are not too many, s.
const STEP: f64 = 0.02;
/// Most places of all heads: of more a browser would be slow.
const MOST: f64 = 400_000.0;
/// Units of places, mm, and of headings, degrees.
const UNIT: f64 = 0.01;
const UNIT_DEG: f64 = 0.1;

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let places = program.ticks as f64 * program.heads.len() as f64;
    let every = (STEP / program.period()).max(places / MOST).ceil().max(1.0) as u64;
    let mut columns = Columns::default();
    cuts(marker, &mut columns);
    let count = heads(program, every, &mut columns);
    let [reach, width] = program.knife();
    let facts = json!({
        "speed": program.speed,
        "step": every as f64 * program.period(),
        "travel": program.travel(),
        "room": program.room(),
        "stations": program.stations,
        "radius": reach,
        "width": width,
        "ticks": count,
        "heads": program.heads.iter().enumerate()
            .map(|(i, head)| json!({ "row": head.row, "color": color(i) })).collect::<Value>(),
    });
    let (title, script) = ("Heads over the conveyor".to_owned(), Script::Heads);
    Page { title, body: script.markup().to_owned(), facts, columns, script }.write(out)
}

/// Adds the columns of all cuts.
fn cuts(marker: &Marker, columns: &mut Columns) {
    let cuts: Vec<_> = marker.cuts.iter().map(|cut| marker.list.points(cut.range)).collect();
    let of =
        |axis: usize| cuts.iter().flat_map(move |points| points.iter().map(move |point| in_units(point[axis], UNIT)));
    columns.add("cut_points", 1.0, cuts.iter().map(|points| i64::from(points.len() as u32)));
    columns.add("cut_x", UNIT, of(0));
    columns.add("cut_y", UNIT, of(1));
}

/// Adds the columns of all heads in order, and returns the number of places of each.
fn heads(program: &Program, every: u64, columns: &mut Columns) -> usize {
    let is_told = |setpoint: &Setpoint| setpoint.tick.is_multiple_of(every);
    let places: Vec<Vec<Setpoint>> =
        program.heads.iter().map(|head| program.setpoints(head).filter(is_told).collect()).collect();
    let all = || places.iter().flatten();
    columns.add("head_x", UNIT, all().map(|setpoint| in_units(setpoint.state.xi, UNIT)));
    columns.add("head_y", UNIT, all().map(|setpoint| in_units(setpoint.state.y, UNIT)));
    columns.add("head_c", UNIT_DEG, all().map(|setpoint| in_units(deg(setpoint.state.c), UNIT_DEG)));
    columns.add("head_knife", 1.0, all().map(|setpoint| i64::from(setpoint.knife)));
    places.first().map_or(0, Vec::len)
}

fn in_units(value: f64, unit: f64) -> i64 {
    (value / unit).round() as i64
}
