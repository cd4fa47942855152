//! All moves of a program, checked.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::sync::Arc;

use super::corners::Zones;
use super::findings::{Case, sorted};
use super::fixes::{Demand, Finder, correct};
use super::loading::check_loading;
use super::tasks::{Task, check_tasks};
use super::undeclared::{undeclared, unused};
use super::world_zones::{WorldZone, world_zones};
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::AXES;
use crate::rapid::calc::target::{converter, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::Move;
use crate::rapid::data::records::GivenTools;
use crate::rapid::motion::drive::{Drive, MotionOptions};
use crate::rapid::motion::goal::{Conf, Goal, Place};
use crate::rapid::motion::joints::nearest_written;
use crate::rapid::motion::routine::{Followed, check as check_options, velocities};
use crate::rapid::program::walk::runs;
use crate::rapid::program::walker::{Run, Step};
use crate::rapid::program::whole::Program;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use irbkin::report::ConfigurationRule;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{Configuration, Error as RobotError, Interrupt, Pose, Robot};
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use irbkin_motion::{Arm, cell};

/// Options of [`check`].
#[derive(Clone, Copy, Debug, Default)]
pub struct CheckOptions<'a, const N: usize = 6> {
    /// The codes of the findings that are wanted; all but U807 without them.
    pub codes: Option<&'a [Code]>,
    /// How moves are followed. The start and the accelerations do not count.
    pub motion: MotionOptions<N>,
    /// The cell in which each move is proven to touch nothing, each joint moving evenly between two
    /// samples; without it collisions are not looked for.
    pub cell: Option<&'a Cell>,
    /// What moves carry in the cell.
    pub carried: Option<&'a Carried>,
    /// The units that the external axes of targets belong to.
    pub units: Option<&'a Units>,
    /// Whether a PERS that the program assigns has the value that its text has, the last one that
    /// it had when the program was saved; what is found with it is a note.
    pub takes_last: bool,
    /// Tools for those that nothing declares, by their names in lower case, without a name for all
    /// others; what is found with them is a note.
    pub tools: Option<&'a GivenTools>,
    /// Whether every module of the program is here; if that is not known, calls by calculated names
    /// lead to others. A routine that nothing declares is an error in a whole program.
    pub is_whole: Option<bool>,
    /// Modules, by their indices, that are modules of the system although their attributes do not
    /// say so: what they call may be the system's.
    pub of_system: &'a [usize],
    /// The names of the controller's signals, in lower case; without them a name that nothing
    /// declares may be one.
    pub signals: Option<&'a BTreeSet<String>>,
    /// The tasks of the controller, the first with the modules that are checked.
    pub tasks: &'a [Task<'a>],
    /// Ends the check early, with [`Error::Interrupted`].
    pub interrupt: Interrupt<'a>,
}

/// A move of the program: an instruction, and the chain of calls to it where it moves to what they
/// pass on; its place is the innermost text that has the target.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckedMove<const N: usize = 6> {
    /// The module among those that are checked, from 0.
    pub module: usize,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The routine that contains it.
    pub routine: Option<Arc<str>>,
    /// The target as it is written.
    pub target: Arc<str>,
    /// The joints at its target [rad]; `None` if it has none, or is not checked.
    pub q: Option<[f64; N]>,
    /// The confdata of its target; `None` for joint angles, or if the target is not known.
    pub confdata: Option<Configuration>,
    /// Why it is not checked; `None` if its target, tool and work object are known in each pass.
    pub unchecked: Option<Code>,
    /// Whether it is checked with the saved value of a PERS or with a given tool in some pass.
    pub assumed: bool,
}

/// The result of a check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked<const N: usize = 6> {
    /// The findings, in the order of the modules and of their texts.
    pub findings: Vec<Finding>,
    /// The moves, in the same order; passes of a loop are one move.
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
/// module's; [`Error::InvalidBody`] for an arm without a body in a cell.
pub fn check<const N: usize>(
    arm: &Arm<N>,
    modules: &[(&Module, &str)],
    options: &CheckOptions<'_, N>,
) -> Result<Checked<N>, Error> {
    arm.configuration_rule()?;
    check_options(&options.motion)?;
    for (module, source) in modules {
        if source.len() != module.text_length {
            let (found, wanted) = (source.len(), module.text_length);
            return Err(RapidFault::nowhere(RapidFaultKind::OtherText { found, wanted }).into());
        }
    }
    let max_velocity = velocities(arm, &options.motion)?.unwrap_or([f64::INFINITY; N]);
    let flange = with_flange(arm)?;
    let (modules, sources): (Vec<&Module>, Vec<&str>) = modules.iter().copied().unzip();
    let units = options.units.unwrap_or(const { &Units(Vec::new()) });
    let convert = converter(&flange, units);
    let program = Program::new(&modules, &convert);
    let (runs, notes) = runs(&program, options.takes_last, options.tools, options.interrupt)?;
    let carried = options.carried.unwrap_or(const { &Carried::new() });
    let arms = options.cell.map(|_| carriers(arm, &runs, carried)).transpose()?;
    let arms = arms.unwrap_or_default();
    let mut carrying = Vec::new();
    if let Some(cell) = options.cell {
        for (names, arm) in &arms {
            carrying.push((names, cell.checker(arm)?.until(options.interrupt)));
        }
    }
    let (zones, no_zones) = world_zones(&program);
    let mut checker = Checker {
        zones,
        robots: [arm, &flange],
        options,
        units,
        max_velocity,
        carrying,
        carried,
        finder: Finder { program: &program, sources: &sources },
        ends: Vec::new(),
        found: Vec::new(),
        demands: Vec::new(),
        moves: Vec::new(),
        cases: Vec::new(),
    };
    for run in &runs {
        checker.add(run)?;
    }
    checker.found.extend(notes.into_iter().chain(no_zones));
    let CheckOptions { is_whole, of_system, signals, interrupt, .. } = *options;
    let has_tools = options.tools.is_some_and(|it| !it.is_empty());
    let (refused, names) =
        check_loading(&program, signals, has_tools, is_whole == Some(true), interrupt)?;
    checker.found.extend(refused.into_iter().chain(check_tasks(options.tasks, is_whole)));
    checker.found.extend(undeclared(&program, &sources, names, is_whole, of_system, interrupt)?);
    if options.codes.is_some_and(|codes| codes.contains(&Code::Unused)) {
        checker.found.extend(unused(&modules, &sources));
    }
    let Checker { mut found, finder, demands, mut moves, cases, .. } = checker;
    correct(&demands, &finder, &mut found);
    // A move is not checked if it is not in one of its passes.
    let place = |it: &CheckedMove<N>| (it.module, it.line, it.column);
    moves.sort_by_key(|(by, it)| {
        (place(it), *by, it.unchecked.is_none(), it.unchecked, !it.assumed)
    });
    moves.dedup_by_key(|(by, it)| (place(it), *by));
    let moves = moves.into_iter().map(|(_, it)| it).collect();
    let mut findings = sorted(found, cases, &modules);
    findings.retain(|it| options.codes.is_none_or(|codes| codes.contains(&it.code)));
    Ok(Checked { findings, moves })
}

/// A move that is not followed, as one that is not checked.
fn unfollowed_move<const N: usize>(finding: &Finding) -> CheckedMove<N> {
    CheckedMove {
        module: finding.module,
        line: finding.line,
        column: finding.column,
        routine: finding.routine.as_deref().map(Into::into),
        target: finding.subject.as_str().into(),
        unchecked: Some(finding.code),
        ..CheckedMove::default()
    }
}

/// A finding on a goal in its module, with what it rests on: values of the move and, on the way to
/// its target, of the move before it. Names, speeds and zones rest on nothing.
fn resting<const N: usize>(
    finding: Finding,
    goals: &[Goal<'_, N>],
    before: Option<&String>,
) -> Finding {
    let (index, id) = (finding.move_index, finding.code.id());
    let of = |index: usize| goals.get(index).and_then(|goal| goal.stepped.assumed.clone());
    let start = || if index == 0 { before.cloned() } else { of(index - 1) };
    let assumed = match id {
        "D702" | "Z502" => finding.assumed.clone(),
        _ if finding.unknown.is_some() || id.starts_with('U') => None,
        "C202" | "R103" | "R104" | "R105" | "R107" => of(index).or_else(start),
        _ if id.starts_with(['K', 'S', 'V', 'Z']) => of(index).or_else(start),
        _ => of(index),
    };
    let Some(Goal { stepped, .. }) = goals.get(index) else { return finding };
    let (module, instruction, case) = (stepped.module, stepped.instruction, stepped.case.clone());
    let calls: Vec<_> = stepped.call.iter().map(|it| it.place).collect();
    let cause = match finding.cause.as_str() {
        "" if !calls.is_empty() => format!("{instruction:?} {}", finding.message),
        _ => finding.cause,
    };
    Finding { module, assumed, cause, case, instruction, calls, ..finding }
}

/// The joints at the target of a move, and what it rests on.
type End<const N: usize> = (Option<[f64; N]>, Option<String>);

struct Checker<'a, 'm, const N: usize> {
    /// The robot, and the same with the flange as its tool.
    robots: [&'a Robot<N>; 2],
    options: &'a CheckOptions<'a, N>,
    units: &'a Units,
    max_velocity: [f64; N],
    zones: Vec<WorldZone>,
    /// The arm with what it carries in the cell, by the names of that; none without a cell.
    carrying: Vec<(&'a Vec<String>, cell::Checker<'a, N>)>,
    carried: &'a Carried,
    finder: Finder<'a, 'm>,
    ends: Vec<Vec<End<N>>>,
    found: Vec<Finding>,
    demands: Vec<Demand<'a>>,
    /// The moves with the chain of calls, the module and the index of the instruction.
    moves: Vec<([usize; 3], CheckedMove<N>)>,
    cases: Vec<Case>,
}

impl<'a, 'm, const N: usize> Checker<'a, 'm, N> {
    fn add(&mut self, run: &'a Run<'m>) -> Result<(), Error> {
        let end = run.from.and_then(|(run, moves)| self.ends.get(run)?.get(moves.checked_sub(1)?));
        let (start, assumed) = end.cloned().unwrap_or_default();
        let options = MotionOptions { start, max_acceleration: None, ..self.options.motion };
        let (robots, units, interrupt) = (self.robots, Some(self.units), self.options.interrupt);
        let mut collisions = Vec::new();
        let mut finish = |drive: &mut Drive<'_, '_, N>, index: usize| {
            drive.check_speed(index, &self.max_velocity);
            if drive.made[index].as_programmed {
                interrupt.check(0)?;
                let (goal, along) = (&drive.goals[index], drive.samples.along(index));
                let touched = self.collision(goal.step, along);
                let zones = self.zones.iter();
                let entered = zones.filter_map(|it| it.entry(robots[1], &goal.frames, along));
                collisions
                    .extend(touched.into_iter().chain(entered).map(|it| it.at(goal.step, index)));
            }
            drive.samples.forget_before(index + 1);
            Ok(())
        };
        let followed = Followed::new(robots, &run.steps, &options, units, interrupt, &mut finish)?;
        let Followed { goals, made, findings, unfollowed, .. } = &followed;
        for finding in unfollowed {
            self.moves.push(([0, finding.module, usize::MAX], unfollowed_move(finding)));
            self.found.push(finding.clone());
        }
        // Where the confdata of a move is wrong.
        let mut wrong: Vec<Option<usize>> = goals.iter().map(|_| None).collect();
        // Why a move is not checked.
        let mut unchecked: Vec<Option<Code>> = goals.iter().map(|_| None).collect();
        for finding in findings {
            let (index, mut finding) = (finding.move_index, finding.clone());
            let (Some(goal), Some(made)) = (goals.get(index), made.get(index)) else { continue };
            if goal.place.is_none()
                && !matches!(finding.code, Code::OutOfReach | Code::OutsideLimits)
            {
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
            let finding = resting(self.worded(finding, goal, is_wrong), goals, assumed.as_ref());
            self.found.push(finding);
        }
        let collisions = collisions.into_iter();
        self.found.extend(collisions.map(|it| resting(it, goals, assumed.as_ref())));
        let zones = Zones { flange: self.robots[1], goals, made };
        for (index, goal) in goals.iter().enumerate() {
            interrupt.check(index)?;
            let (module, line, column) = (goal.stepped.module, goal.step.line, goal.step.column);
            let (home, instruction) = goal.stepped.instruction;
            let own = CheckedMove {
                module,
                line,
                column,
                routine: goal.step.routine.clone(),
                target: goal.step.target.text.clone(),
                q: made[index].q,
                confdata: match goal.place {
                    Some(Place::Tool(_, wanted)) => Some(wanted.configuration),
                    _ => None,
                },
                unchecked: unchecked[index],
                assumed: unchecked[index].is_none() && goal.stepped.assumed.is_some(),
            };
            self.moves.push(([goal.stepped.chain, home, instruction], own));
            let call = goal.stepped.call.as_ref().map(|it| it.place);
            let (place, case) = ((module, line, column), goal.stepped.case.clone());
            self.cases.push((place, (home, instruction), call, case));
            let mut found = |finding: Finding| {
                let finding = resting(finding.at(goal.step, index), goals, assumed.as_ref());
                self.found.push(finding);
            };
            zones.checked(index).for_each(&mut found);
            let (Some(Place::Tool(_, wanted)), Some(q)) = (goal.place, made[index].q) else {
                continue;
            };
            if goal.conf() == Conf::Off {
                continue;
            }
            if !goal.is_cartesian() {
                in_wrist_singularity(self.robots[1], &q).into_iter().for_each(&mut found);
            }
            if self.options.codes.is_none_or(|codes| codes.contains(&Code::ConfdataEdge)) {
                on_edges(self.robots[1], &q)?.for_each(found);
            }
            let to = self.robots[1].configuration(&q)?;
            if wrong[index].is_some() && !self.is_nearest_written(goal, to) {
                continue;
            }
            let (from, finding) = (wanted.configuration, wrong[index]);
            self.demands.push(Demand { module, step: goal.step, from, to, finding });
        }
        let ends =
            made.iter().zip(goals).map(|(made, goal)| (made.q, goal.stepped.assumed.clone()));
        self.ends.push(ends.collect());
        Ok(())
    }

    /// A finding on a goal with what the program has to do with it.
    fn worded(&self, mut finding: Finding, goal: &Goal<'_, N>, is_wrong: bool) -> Finding {
        if is_wrong && !finding.cause.is_empty() {
            let routine = goal.step.routine.as_deref().unwrap_or_default();
            // In a routine, or in the run that is added.
            finding.cause = match finding.code {
                Code::NearConfdata => {
                    format!("{} {routine} {}", goal.stepped.module, finding.cause)
                }
                _ => format!("{} {}", self.ends.len(), finding.cause),
            };
        }
        if let Some(name) = &finding.unknown {
            let words = format!("{name} is not declared");
            finding.message = Finding::new(finding.code, words).at(goal.step, 0).message;
        }
        if let Some(line) = goal.stepped.displaced_on {
            finding.message = format!("{} (displaced on line {line})", finding.message);
        }
        finding
    }

    /// Whether a configuration belongs to the joints nearest to the written one of a goal: any other
    /// is another wrist, or whole turns away, and does not correct it.
    fn is_nearest_written(&self, goal: &Goal<'_, N>, to: Configuration) -> bool {
        let Some(Place::Tool(pose, wanted)) = goal.place else { return false };
        let nearest = nearest_written(self.robots[1], &goal.frames.flange(&pose), &wanted);
        nearest.is_some_and(|(q, _)| self.robots[1].configuration(&q) == Ok(to))
    }

    fn collision(&mut self, step: &Move, along: &[[f64; N]]) -> Option<Finding> {
        let names = carried_by(step, self.carried);
        let (_, checker) = self.carrying.iter_mut().find(|(own, _)| **own == names)?;
        let contact = checker.contact(along)?;
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

/// Shapes in the flange frame, which it carries in moves with the tool or the work object of a name,
/// in lower case.
pub type Carried = BTreeMap<String, Vec<Shape>>;

/// The names of what a move carries: of its tool and its work object those that have shapes and are
/// not known to be stationary.
fn carried_by(step: &Move, carried: &Carried) -> Vec<String> {
    let is_held = !matches!(&step.tool.value, Ok(tool) if !tool.robhold);
    let tool = Some(&step.tool.text).filter(|_| is_held);
    let wobj = step.wobj.as_ref();
    let part = wobj.filter(|it| !matches!(&it.value, Ok(wobj) if !wobj.robhold));
    let part = part.map(|wobj| &wobj.text);
    let names = [tool, part].into_iter().flatten().map(|text| text.to_lowercase());
    names.filter(|name| carried.contains_key(name)).collect()
}

/// The arms that the moves of a program are made with, beside the names of what they carry.
fn carriers<const N: usize>(
    arm: &Arm<N>,
    runs: &[Run<'_>],
    carried: &Carried,
) -> Result<Vec<(Vec<String>, Arm<N>)>, Error> {
    let mut arms = Vec::from([(Vec::new(), arm.clone())]);
    for step in runs.iter().flat_map(|run| &run.steps) {
        let Step::Move(stepped) = step else { continue };
        let names = carried_by(&stepped.step, carried);
        if arms.iter().all(|(own, _)| *own != names) {
            let shapes: Vec<Shape> =
                names.iter().flat_map(|name| &carried[name]).cloned().collect();
            arms.push((names, arm.clone().with_attached(&shapes, &Pose::identity(), None)?));
        }
    }
    Ok(arms)
}

/// A finding on confdata that no solution has, with the configuration of the nearest joints.
fn with_nearest<const N: usize>(
    flange: &Robot<N>,
    finding: Finding,
    goal: &Goal<'_, N>,
    q: &[f64; N],
) -> Finding {
    let (Code::WrongConfdata, Some(Place::Tool(pose, wanted)), Ok(nearest)) =
        (finding.code, goal.place, flange.configuration(q))
    else {
        return finding;
    };
    let words = match flange.ik_configured(&goal.frames.flange(&pose), wanted) {
        Err(error @ RobotError::InvalidJoints(_)) => error.to_string(),
        _ => format!("no solution has its confdata {}", wanted.configuration),
    };
    let words = format!("{words}; that of the nearest is {nearest}");
    Finding::new(finding.code, words).at(goal.step, finding.move_index)
}

/// A target that is so near the wrist singularity that its confdata names many joints, of which a
/// joint move brings `q`. A line or an arc arrives with the joints that it comes with.
fn in_wrist_singularity<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Option<Finding> {
    let wrist = robot.singular_distances(q).map_or(1.0, |at| at.wrist);
    let is_counted = robot.configuration_rule() == Ok(ConfigurationRule::SphericalWrist);
    (is_counted && wrist < CONFIGURATION_EDGE).then(|| {
        let words = format!(
            "the target is {:.4} deg from the wrist singularity: axes 4 and 6 coincide, many joint \
             angles have its confdata; use MoveAbsJ",
            wrist.to_degrees()
        );
        Finding::new(Code::AmbiguousConfdata, words)
    })
}

/// The axes of joints that are on the edge of a quarter, in sentences.
fn on_edges<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
) -> Result<impl Iterator<Item = Finding>, RobotError> {
    let (joints, zero) = robot.counted_joints()?;
    Ok(AXES.into_iter().zip(joints).filter_map(move |(axis, joint)| {
        let degrees = q[joint].to_degrees();
        let from_zero = degrees - zero.to_degrees();
        let edge = (from_zero / 90.0).round();
        let is_near = (from_zero - 90.0 * edge).abs() < CONFIGURATION_EDGE.to_degrees();
        is_near.then(|| {
            let words = format!(
                "axis {} is {:.4} deg, on the edge of a quarter: cf{axis} {} and {edge:.0} both \
                 name it",
                axis,
                degrees + 0.0,
                edge - 1.0,
            );
            Finding::new(Code::ConfdataEdge, words)
        })
    }))
}
