//! `check`: all moves of a module, checked.

use std::collections::HashMap;

use irbkin::Robot;
use irbkin::cell::Cell;
use irbkin::rapid::{self, CheckOptions};
use serde::Serialize;

use crate::program::{Fault, Finding, Program, faults};
use crate::request::{Refusal, Request};

/// The moves of a module and what is wrong with them.
#[derive(Debug, Serialize)]
pub struct Checked {
    /// The moves, in the order of the text.
    pub moves: Vec<Move>,
    /// The findings, in the order of the text.
    pub findings: Vec<Finding>,
    /// Invalid statements, which are skipped.
    pub faults: Vec<Fault>,
}

/// A place at which the program moves.
#[derive(Debug, Serialize)]
pub struct Move {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The routine that contains it.
    pub routine: Option<String>,
    /// The instruction, as it is written; null if it is not read.
    pub instruction: Option<String>,
    /// The target, as it is written.
    pub target: String,
    /// The joints at its target [rad].
    pub q: Option<Vec<f64>>,
    /// The confdata of its target.
    pub confdata: Option<[i32; 4]>,
    /// The code for why it is not checked; null if it is.
    pub unchecked: Option<&'static str>,
}

impl Checked {
    pub(crate) fn of<const N: usize>(
        robot: &Robot<N>,
        program: &Program,
        cell: &Cell,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let cell = request.flag("collide")?.then_some(cell);
        let options = CheckOptions { cell, ..CheckOptions::default() };
        let checked = rapid::check(robot, &[(&program.module, &program.text)], &options)?;
        let read = program.module.moves().iter();
        let instructions: HashMap<_, _> =
            read.map(|it| ((it.line, it.column), &it.instruction)).collect();
        let moves = checked.moves.into_iter().map(|it| Move {
            line: it.line,
            column: it.column,
            routine: it.routine,
            instruction: instructions.get(&(it.line, it.column)).map(ToString::to_string),
            target: it.target,
            q: it.q.map(|q| q.to_vec()),
            confdata: it.confdata.map(Into::into),
            unchecked: it.unchecked.map(rapid::Code::id),
        });
        Ok(Self {
            moves: moves.collect(),
            findings: checked.findings.iter().map(Finding::from).collect(),
            faults: faults(&program.module),
        })
    }
}
