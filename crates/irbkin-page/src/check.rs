//! `check`: all moves of a program, checked.

use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin_abb::rapid;
use irbkin_abb::rapid::{CheckOptions, RoutineKind};
use irbkin_motion::Arm;
use irbkin_motion::cell::Cell;
use serde::Serialize;

use super::program::{Fault, Finding, Program, faults};
use super::request::{Refusal, Request};

/// The moves of a program and what is wrong with them.
#[derive(Debug, Serialize)]
pub struct Checked {
    /// The procedures, in the order of the texts.
    pub procedures: Vec<Procedure>,
    /// The moves, in the order of the texts.
    pub moves: Vec<Move>,
    /// The findings, in the order of the texts.
    pub findings: Vec<Finding>,
    /// Invalid statements, which are skipped.
    pub faults: Vec<Fault>,
}

/// A procedure, which `motion` can follow.
#[derive(Debug, Serialize)]
pub struct Procedure {
    /// The module, from 0.
    pub module: usize,
    /// Its name.
    pub name: String,
}

/// A place at which the program moves.
#[derive(Debug, Serialize)]
pub struct Move {
    /// The module, from 0.
    pub module: usize,
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
        arm: &Arm<N>,
        program: &Program,
        cell: &Cell,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let cell = request.flag("collide")?.then_some(cell);
        let options = CheckOptions { cell, ..CheckOptions::default() };
        let modules = &program.modules;
        let sources: Vec<_> =
            modules.iter().zip(program.texts.iter().map(String::as_str)).collect();
        let checked = rapid::check(arm, &sources, &options)?;
        let mut procedures = Vec::new();
        let mut instructions = BTreeMap::new();
        for (module, own) in modules.iter().enumerate() {
            let named = own.routines().iter().filter(|it| it.kind == RoutineKind::Proc);
            procedures.extend(named.map(|it| Procedure { module, name: it.name.clone() }));
            let moves = own.moves().iter();
            instructions.extend(moves.map(|it| ((module, it.line, it.column), &it.instruction)));
        }
        let instruction = |place| instructions.get(&place).map(ToString::to_string);
        let moves = checked.moves.into_iter().map(|it| Move {
            module: it.module,
            line: it.line,
            column: it.column,
            routine: it.routine.as_deref().map(Into::into),
            instruction: instruction((it.module, it.line, it.column)),
            target: it.target.to_string(),
            q: it.q.map(|q| q.to_vec()),
            confdata: it.confdata.map(Into::into),
            unchecked: it.unchecked.map(rapid::Code::id),
        });
        Ok(Self {
            procedures,
            moves: moves.collect(),
            findings: checked.findings.iter().map(Finding::from).collect(),
            faults: faults(modules),
        })
    }
}
