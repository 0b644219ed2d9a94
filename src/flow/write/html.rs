//! A page that plays a program: the cloth under the rows, heads in them, what is cut so far. It needs nothing but a browser.

use std::io::{self, Write};

use super::markup::{color, mm};
use super::target::{Kind, Target};
use crate::flow::program::Program;
use crate::ir::Marker;
use crate::units::deg;
use crate::units::number::{exact, fixed};

pub(super) const TARGET: Target = Target {
    name: "html",
    about: "a page that plays the program: cloth and heads moving",
    extension: "html",
    kind: Kind::Whole { stem: "player", write },
};

/// The page, without machine, cuts and heads.
const PAGE: &str = include_str!("player.html");
const MACHINE: &str = "/*MACHINE*/";
const CUTS: &str = "/*CUTS*/";
const HEADS: &str = "/*HEADS*/";
/// Time between two places of a head where there are not too many, s.
const STEP: f64 = 0.02;
/// Most places of all heads: of more a browser would be slow.
const MOST: f64 = 400_000.0;

fn write(program: &Program, marker: &Marker, out: &mut dyn Write) -> io::Result<()> {
    let (head, rest) = PAGE.split_once(MACHINE).expect("the page has a place for the machine");
    let (second, rest) = rest.split_once(CUTS).expect("the page has a place for the cuts");
    let (third, tail) = rest.split_once(HEADS).expect("the page has a place for the heads");
    let places = program.ticks as f64 * program.heads.len() as f64;
    let every = (STEP / program.period()).max(places / MOST).ceil().max(1.0) as u64;
    let stations = program.stations.iter().map(|station| mm(*station)).collect::<Vec<_>>().join(",");
    let [reach, width] = program.knife();
    write!(
        out,
        "{head}{{speed:{},step:{},travel:{},room:{},stations:[{stations}],radius:{},width:{},ticks:{}}}{second}[",
        exact(program.speed),
        exact(every as f64 * program.period()),
        exact(program.travel()),
        exact(program.room()),
        exact(reach),
        exact(width),
        program.ticks / every,
    )?;
    for cut in &marker.cuts {
        let points = marker.list.points(cut.range);
        let points = points.iter().map(|point| format!("{},{}", mm(point.x), mm(point.y)));
        writeln!(out, "[{}],", points.collect::<Vec<_>>().join(","))?;
    }
    write!(out, "]{third}[")?;
    for (i, head) in program.heads.iter().enumerate() {
        write!(out, "{{row:{},color:\"{}\",at:[", head.row, color(i))?;
        for setpoint in program.setpoints(head).filter(|setpoint| setpoint.tick.is_multiple_of(every)) {
            let state = setpoint.state;
            write!(
                out,
                "{},{},{},{},",
                fixed(state.xi, 1),
                fixed(state.y, 1),
                fixed(deg(state.c), 0),
                u8::from(setpoint.knife)
            )?;
        }
        writeln!(out, "]}},")?;
    }
    write!(out, "]{tail}")
}
