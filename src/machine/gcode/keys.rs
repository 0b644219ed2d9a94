//! Table of the keys `gcode.*`: their values and meanings.

use super::{Dialect, FeedCounts, FeedMode, Letter, Moves, Outputs, Planner};
use crate::machine::axes::ACCELERATION;
use crate::machine::key::{Key, SPEED, Takes, from};
use crate::machine::word::{Off, Word as _, words};

/// The keys `gcode.*`.
#[rustfmt::skip] // a table: one row a key
pub(in crate::machine) const KEYS: &[Key] = &[
    Key { name: "gcode.dialect", takes: Takes::Word(words::<Dialect>), about: "Spelling: \"rs274\" = RS274/NGC, as LinuxCNC and grbl; \"reprap\" = RepRapFirmware, which knows\nfewer codes for the first line, and whose G4 takes seconds as S." },
    Key { name: "gcode.letter", takes: Takes::Word(words::<Letter>), about: "Target gcode: letter of the axis that turns the blade." },
    Key { name: "gcode.wrapped", takes: Takes::Flag, about: "Whether that axis counts from 0 to 360 degrees only; a negative number then means to turn back." },
    Key { name: "gcode.moves", takes: Takes::Word(words::<Moves>), about: "\"fixed\" = arcs if gcode.arcs is true, or else lines; \"auto\" = what is fastest by the planner of\nthe controller: arcs or lines, finer chords, and the other feed mode where one would be mistimed." },
    Key { name: "gcode.arcs", takes: Takes::Flag, about: "Whether the controller knows arcs (G2, G3) on which that axis turns, too." },
    Key { name: "gcode.max_radius_mm", takes: Takes::NumberOr(from(100.0, 1.0e9), Off::WORD), about: "Greatest radius of an arc: flatter ones are written as straight moves. A controller that reckons\nin single precision misses an arc of 1 km by 0.06 mm (grblHAL, FluidNC); \"off\" = any." },
    Key { name: "gcode.feed_mode", takes: Takes::Word(words::<FeedMode>), about: "What F says: the speed of X and Y (G94), or one over the time of each move (G93), for controllers\nthat would count degrees as mm." },
    Key { name: "gcode.feed_counts", takes: Takes::Word(words::<FeedCounts>), about: "Axes whose motion F of G94 counts: \"linear\" = X and Y; \"all\" = the axis of the blade, too, its\ndegrees as if they were mm (grblHAL, FluidNC, grbl-Mega-5X)." },
    Key { name: "gcode.blend_mm", takes: Takes::NumberOr(from(0.001, 10.0), Off::WORD), about: "How far the controller may leave the path to keep its speed (G64 P), beside path.tolerance_mm;\n\"off\" = no G64 is written: the controller does as it was set." },
    Key { name: "gcode.max_blocks_s", takes: Takes::NumberOr(from(1.0, 1.0e5), Off::WORD), about: "Moves a second that the controller plans: F makes no move shorter than that, so that it never\nwaits for the next one; \"off\" = it keeps up." },
    Key { name: "gcode.planner", takes: Takes::Word(words::<Planner>), about: "Planner by which the time is estimated: \"grbl\" = that of grbl, grbl-Mega-5X, grblHAL and FluidNC;\n\"reprap\" = that of RepRapFirmware; \"linuxcnc\" = that of LinuxCNC, which also keeps F of arcs to\nwhat it reaches." },
    Key { name: "gcode.planner_blocks", takes: Takes::Count(1000), about: "Planners grbl, reprap: moves that the controller knows at once, the running one included. It must\nbe able to stop at the end of the last one." },
    Key { name: "gcode.junction_deviation_mm", takes: Takes::Number(from(0.0001, 1.0)), about: "Planner grbl: its junction deviation ($11), which sets the speed at kinks." },
    Key { name: "gcode.arc_tolerance_mm", takes: Takes::Number(from(0.0001, 1.0)), about: "Planner grbl: its arc tolerance ($12), the deviation of the chords into which it divides an arc." },
    Key { name: "gcode.jump_mm_s", takes: Takes::Number(from(0.01, 1000.0)), about: "Planner reprap: greatest instantaneous change of speed of X, Y and Z (M566 counts per minute)." },
    Key { name: "gcode.jump_deg_s", takes: Takes::Number(from(0.01, 1.0e5)), about: "Planner reprap: greatest instantaneous change of speed of the axis of the blade (M566)." },
    Key { name: "gcode.z_speed_mm_s", takes: Takes::NumberOr(SPEED, Off::WORD), about: "Planners grbl, reprap: greatest speed of Z ($112 is per minute); \"off\" = Z is not counted." },
    Key { name: "gcode.z_acceleration_mm_s2", takes: Takes::NumberOr(ACCELERATION, Off::WORD), about: "Planners grbl, reprap: greatest acceleration of Z ($122); \"off\" = moves of Z are not counted." },
    Key { name: "gcode.decimals", takes: Takes::Whole(&[3, 4, 5, 6]), about: "Decimals of positions." },
    Key { name: "gcode.line_numbers", takes: Takes::Flag, about: "Whether lines are numbered (N)." },
    Key { name: "gcode.outputs", takes: Takes::Word(words::<Outputs>), about: "When M42, M64 to M66 and M68 act: \"queued\" = when the moves before them are over (LinuxCNC);\n\"immediate\" = when they are read (grblHAL, FluidNC), so that a rest stands before them." },
    Key { name: "gcode.heading_tolerance_deg", takes: Takes::Number(from(0.001, 10.0)), about: "How far the blade may be turned from the tangent where the axis turns evenly along a piece." },
    Key { name: "gcode.chord_mm", takes: Takes::Number(from(0.0001, 1.0)), about: "Without arcs: how far a straight piece may leave its arc." },
    Key { name: "gcode.header", takes: Takes::Text, about: "Lines behind the first one, which chooses mm and absolute positions: a coordinate system (G54), a\ntool (T1 M6), what is switched. They move nothing." },
    Key { name: "gcode.footer", takes: Takes::Text, about: "Lines at the end, the last one M2 or M30. They move nothing: park says where the axes end." },
    Key { name: "gcode.knife_down", takes: Takes::Steps, about: "Steps that put the knife down: a digital output (M64 P0 on, M65 P0 off), a move of Z (G0 Z-2,\nG1 Z-2 F600), a rest (G4 P0.05, in s), M42 P S, M3 to M5 with S, M7 to M9, M68 E Q, M66 P L Q." },
    Key { name: "gcode.knife_up", takes: Takes::Steps, about: "Steps that lift it: they undo those of knife_down." },
    Key { name: "gcode.drill_down", takes: Takes::Steps, about: "Steps that put a drill down; # stands for its number, 1 to 4." },
    Key { name: "gcode.drill_up", takes: Takes::Steps, about: "Steps that lift it." },
    Key { name: "gcode.stop", takes: Takes::Steps, about: "Steps that wait for the operator (event 1): M0, M1, M60 or M226." },
    Key { name: "gcode.advance", takes: Takes::Steps, about: "Steps that advance the cloth (event 2); # in the first one stands for the mm of an advance\nbetween two bites (bite.length_mm)." },
];
