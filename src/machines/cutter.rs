//! The cutter: a tool that touches the cloth on a table.

use super::machine::{Checked, Machine, Tool, dialect, listed};
use crate::machine::ToolKind;
use crate::{back, pipeline, verify};

pub(super) const MACHINE: Machine = Machine {
    name: "cutter",
    about: "a tangential knife, a wheel, a pen or a router over a table",
    works: "cuts",
    tool: Some(Tool {
        kinds: &[ToolKind::Knife, ToolKind::Wheel, ToolKind::Pen, ToolKind::Router],
        compile: pipeline::compile_all,
        cuts: pipeline::make_cuts,
        estimate: pipeline::estimate,
    }),
    targets: || listed(back::TARGETS),
    rules: verify::RULES,
    is_sewn: false,
    claims: |_| false,
    refusal: |_| None,
    parts: None,
    check: |source, asked, job, out| {
        let input = pipeline::read(source, dialect(asked), job, out)?;
        Some(Checked::of(&input))
    },
    judge: Some(|program, source, asked, job, out| {
        pipeline::judge_program(program.bytes, source, dialect(asked), job, program.declared, out)
    }),
};
