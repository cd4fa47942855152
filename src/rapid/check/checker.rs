//! All moves of a program, checked.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::confdata::{in_wrist_singularity, on_edges, with_nearest};
use super::corners::Zones;
use super::fixes::{Demand, Finder, correct};
use crate::cell::{Cell, Placed};
use crate::error::{Error, RapidFault, RapidFaultKind};
use crate::kinematics::Robot;
use crate::rapid::calc::target::with_flange;
use crate::rapid::calc::units::Units;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::expression::names::predefined_names;
use crate::rapid::motion::drive::MotionOptions;
use crate::rapid::motion::goal::Place;
use crate::rapid::motion::joints::Conf;
use crate::rapid::motion::routine::{Followed, check as check_options, velocities};
use crate::rapid::program::walk::runs;
use crate::rapid::program::walker::Run;
use crate::rapid::program::whole::Program;
use crate::report::Configuration;

/// Options of [`check`].
#[derive(Clone, Copy, Debug, Default)]
pub struct CheckOptions<'a, const N: usize = 6> {
    /// How moves are followed. The start and the accelerations do not count.
    pub motion: MotionOptions<N>,
    /// The cell in which each move is proven to touch nothing, each joint moving evenly between two
    /// samples; without it collisions are not looked for.
    pub cell: Option<&'a Cell>,
    /// The units that the external axes of targets belong to.
    pub units: Option<&'a Units>,
    /// Whether a PERS that the program assigns has the value that its text has, the last one that
    /// it had when the program was saved; each such move has a finding.
    pub takes_last: bool,
}

/// A place at which the program moves.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedMove<const N: usize = 6> {
    /// The module among those that are checked, from 0.
    pub module: usize,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The routine that contains it.
    pub routine: Option<String>,
    /// The target as it is written.
    pub target: String,
    /// The joints at its target [rad]; `None` if it has none, or is not checked.
    pub q: Option<[f64; N]>,
    /// The confdata of its target; `None` for joint angles, or if the target is not known.
    pub confdata: Option<Configuration>,
    /// Why it is not checked; `None` if its target, tool and work object are known.
    pub unchecked: Option<Code>,
}

/// The result of a check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked<const N: usize = 6> {
    /// The findings, in the order of the modules and of their texts.
    pub findings: Vec<Finding>,
    /// The moves, in the same order, each place once.
    pub moves: Vec<CheckedMove<N>>,
}

/// Check every move of a program: modules that know each other, with the texts that they were read
/// from.
///
/// Routines are followed from `main` through calls, with their arguments; those that nothing calls,
/// by themselves. Branches are checked from where the robot is before them, loops in each pass if
/// their bounds are known and else in the first. Without velocities, neither of the robot nor in
/// the options, no joint is too fast.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations; [`Error::InvalidMotion`] for limits
/// or steps that are not positive, or for too many samples; [`Error::Rapid`] if a text is not its
/// module's; [`Error::InvalidBody`] for a robot without a body in a cell.
pub fn check<const N: usize>(
    robot: &Robot<N>,
    modules: &[(&Module, &str)],
    options: &CheckOptions<'_, N>,
) -> Result<Checked<N>, Error> {
    robot.configuration_rule()?;
    check_options(&options.motion)?;
    for (module, source) in modules {
        if source.len() != module.text_length {
            let (found, wanted) = (source.len(), module.text_length);
            return Err(RapidFault::nowhere(RapidFaultKind::OtherText { found, wanted }).into());
        }
    }
    let max_velocity = velocities(robot, &options.motion)?.unwrap_or([f64::INFINITY; N]);
    let flange = with_flange(robot)?;
    let (modules, sources): (Vec<&Module>, Vec<&str>) = modules.iter().copied().unzip();
    let program = Program::new(&modules);
    let units = Units::default();
    let mut checker = Checker {
        robots: [robot, &flange],
        options: options.motion,
        units: options.units.unwrap_or(&units),
        max_velocity,
        cell: options.cell.map(|cell| Ok::<_, Error>((cell, Placed::of(robot)?))).transpose()?,
        finder: Finder::new(&program, &sources),
        ends: Vec::new(),
        found: Vec::new(),
        demands: Vec::new(),
        moves: Vec::new(),
    };
    let (runs, notes) = runs(&program, options.takes_last);
    for run in &runs {
        checker.add(run)?;
    }
    checker.found.extend(notes);
    let Checker { found, demands, moves, .. } = checker;
    Ok(Checked { findings: sorted(found, &demands), moves: places(moves) })
}

/// Findings in the order of the text, each once, with their corrections.
fn sorted(mut found: Vec<Finding>, demands: &[Demand]) -> Vec<Finding> {
    correct(demands, &mut found);
    found.sort_by_key(|it| (it.module, it.line, it.column, it.code));
    found.dedup_by(|a, b| {
        (a.module, a.line, a.column, a.code, &a.message)
            == (b.module, b.line, b.column, b.code, &b.message)
    });
    // A unit is named once, and nothing is said of the way to a target that cannot be met.
    let mut units = BTreeSet::new();
    let what = |it: &Finding| it.message.split_once(": ").map(|(_, words)| String::from(words));
    let (mut unmet, mut without_path) = (None, None);
    found.retain(|it| {
        let place = (it.module, it.line, it.column);
        match it.code {
            Code::OutOfReach | Code::OutsideLimits => unmet = Some(place),
            Code::NoPath => without_path = Some(place),
            Code::UncertainCircle => return without_path != Some(place),
            Code::PathBlocked | Code::Flip => return unmet != Some(place),
            Code::UnknownUnit => return units.insert(what(it)),
            _ => {}
        }
        true
    });
    found
}

/// Moves in the order of the text, each place once: checked if it is in one of its passes.
fn places<const N: usize>(mut moves: Vec<CheckedMove<N>>) -> Vec<CheckedMove<N>> {
    moves.sort_by_key(|it| (it.module, it.line, it.column, it.unchecked));
    moves.dedup_by_key(|it| (it.module, it.line, it.column));
    moves
}

struct Checker<'a, 'm, const N: usize> {
    /// The robot, and the same with the flange as its tool.
    robots: [&'a Robot<N>; 2],
    options: MotionOptions<N>,
    units: &'a Units,
    max_velocity: [f64; N],
    cell: Option<(&'a Cell, Placed<'a, N>)>,
    finder: Finder<'a, 'm>,
    /// The joints at the targets of the moves of each run.
    ends: Vec<Vec<Option<[f64; N]>>>,
    found: Vec<Finding>,
    demands: Vec<Demand>,
    moves: Vec<CheckedMove<N>>,
}

impl<const N: usize> Checker<'_, '_, N> {
    fn add(&mut self, run: &Run<'_>) -> Result<(), Error> {
        let start =
            run.from.and_then(|(run, moves)| *self.ends.get(run)?.get(moves.checked_sub(1)?)?);
        let options = MotionOptions { start, max_acceleration: None, ..self.options };
        let mut followed = Followed::new(self.robots, &run.steps, &options, Some(self.units))?;
        followed.check_speeds(&self.max_velocity);
        let Followed { goals, made, findings, unfollowed, .. } = &followed;
        self.moves.extend(unfollowed.iter().map(|finding| CheckedMove {
            module: finding.module,
            line: finding.line,
            column: finding.column,
            routine: finding.routine.clone(),
            target: finding.message.split(": ").next().unwrap_or_default().into(),
            q: None,
            confdata: None,
            unchecked: Some(finding.code),
        }));
        self.found.extend(unfollowed.iter().cloned());
        // Where the confdata of a move is wrong.
        let mut wrong: Vec<Option<usize>> = goals.iter().map(|_| None).collect();
        // Why a move is not checked.
        let mut unchecked: Vec<Option<Code>> = goals.iter().map(|_| None).collect();
        for finding in findings {
            let (index, mut finding) = (finding.move_index, finding.clone());
            let (Some(goal), Some(made)) = (goals.get(index), made.get(index)) else { continue };
            if goal.place.is_none() {
                unchecked[index].get_or_insert(finding.code);
            }
            let is_wrong = matches!(
                finding.code,
                Code::WrongConfdata | Code::OtherConfiguration | Code::NearConfdata
            );
            if let Some(q) = made.q.filter(|_| is_wrong) {
                wrong[index] = Some(self.found.len());
                finding = with_nearest(self.robots[1], finding, goal, &q);
            }
            if let Some(name) = finding.unknown.clone() {
                let words = format!("{name} is not declared");
                finding.message = Finding::new(finding.code, words).at(goal.step, index).message;
            }
            if let Some(line) = goal.stepped.displaced_on {
                finding.message = format!("{} (displaced on line {line})", finding.message);
            }
            self.found.push(finding.in_module(goal.stepped.module));
        }
        for (index, goal) in
            goals.iter().enumerate().filter(|(index, _)| made[*index].as_programmed)
        {
            let finding = self.collision(followed.along(index));
            let placed = finding.map(|it| it.at(goal.step, index).in_module(goal.stepped.module));
            self.found.extend(placed);
        }
        let zones = Zones { flange: self.robots[1], goals, made };
        for (index, goal) in goals.iter().enumerate() {
            self.moves.push(CheckedMove {
                module: goal.stepped.module,
                line: goal.step.line,
                column: goal.step.column,
                routine: goal.step.routine.clone(),
                target: goal.step.target.text.clone(),
                q: made[index].q,
                confdata: match goal.place {
                    Some(Place::Tool(_, wanted)) => Some(wanted.configuration),
                    _ => None,
                },
                unchecked: unchecked[index],
            });
            let mut found = |finding: Finding| {
                self.found.push(finding.at(goal.step, index).in_module(goal.stepped.module));
            };
            zones.checked(index).for_each(&mut found);
            if goal.stepped.takes_last {
                let words = "a PERS that the program assigns has its last value here";
                found(Finding::new(Code::LastValue, words));
            }
            let (Some(Place::Tool(_, wanted)), Some(q)) = (goal.place, made[index].q) else {
                continue;
            };
            if goal.conf() == Conf::Off {
                continue;
            }
            if !goal.is_cartesian() {
                in_wrist_singularity(self.robots[1], &q).into_iter().for_each(&mut found);
            }
            on_edges(self.robots[1], &q)?.for_each(found);
            let to = self.robots[1].configuration(&q)?;
            let written = self.finder.of(goal.stepped.module, goal.step);
            self.demands.push(Demand {
                written,
                from: wanted.configuration,
                to,
                finding: wrong[index],
            });
        }
        self.ends.push(made.iter().map(|made| made.q).collect());
        Ok(())
    }

    /// A move that touches something in the cell.
    fn collision(&mut self, along: &[[f64; N]]) -> Option<Finding> {
        let (cell, placed) = self.cell.as_mut()?;
        let contact = cell.contact(placed, along)?;
        #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52 samples")]
        let part = contact.at / along.len().saturating_sub(1).max(1) as f64;
        let words = format!(
            "link {} touches {} after {:.0} % of the way, {:.1} mm deep",
            contact.nearest.link,
            contact.nearest.near,
            1e2 * part,
            1e3 * contact.depth.max(0.0),
        );
        Some(Finding::new(Code::Collision, words))
    }
}

/// The names that could be meant by the unknown name of a finding: of data of the modules, and
/// RAPID's own.
#[must_use]
pub fn candidates(finding: &Finding, modules: &[&Module]) -> Vec<String> {
    let data_type = finding.code.data_type();
    let data = modules.iter().flat_map(|module| module.data());
    let fitting = data.filter(|datum| data_type.is_none_or(|wanted| datum.data_type == wanted));
    let mut names: Vec<String> = fitting.map(|datum| datum.name.clone()).collect();
    names.extend(data_type.map(predefined_names).unwrap_or_default());
    names
}
