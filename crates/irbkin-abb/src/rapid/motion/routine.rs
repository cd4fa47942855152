//! A routine as one motion.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::drive::{Drive, Made, MotionOptions};
use super::goal::Goal;
use super::joints::Samples;
use super::pace::Pace;
use super::sequence::sequence;
use crate::Error;
use crate::rapid::calc::table::external_axes;
use crate::rapid::calc::target::{converter, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::{Move, MoveKind};
use crate::rapid::program::walker::Step;
use crate::rapid::program::whole::Program;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind, RoutineFault};
use irbkin::internal::check_seed;
use irbkin::{Interrupt, Pose, Robot};
use irbkin_motion::internal::MotionFault;
use irbkin_motion::paths::Spacing;
use irbkin_motion::trajectory::Trajectory;

/// The moves of a routine as one motion of the joints, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct RoutineMotion<const N: usize = 6> {
    /// The routine; `None` for moves outside routines.
    pub routine: Option<String>,
    /// The joints over time. Without accelerations they go evenly from sample to sample, and the
    /// duration is a kinematic lower bound.
    pub trajectory: Trajectory,
    /// Times of the samples [s].
    pub t: Vec<f64>,
    /// Joint angles of the samples [rad].
    pub q: Vec<[f64; N]>,
    /// The move, by its index in `moves`, that each sample belongs to.
    pub move_index: Vec<usize>,
    /// The moves of the routine, in order.
    pub moves: Vec<MotionMove<N>>,
    /// Findings on moves, in order.
    pub findings: Vec<Finding>,
}

/// A move of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionMove<const N: usize = 6> {
    /// The instruction.
    pub kind: MoveKind,
    /// The module among those that are given, from 0.
    pub module: usize,
    /// Its index in [`Module::moves`].
    pub module_index: usize,
    /// Line of the instruction.
    pub line: usize,
    /// When it begins [s], halfway through the corner before it.
    pub start: f64,
    /// When it ends [s], halfway through the corner behind it.
    pub end: f64,
    /// The length of the tool's way in the work object [m].
    pub length: f64,
    /// The joints at its target [rad], which is met or passed; `None` if it is left out.
    pub q: Option<[f64; N]>,
    /// Whether it is made as it is programmed; otherwise the joints go straight to its target at
    /// their limits or, without `q`, it is left out.
    pub as_programmed: bool,
    /// The tool in the flange frame; of a stationary tool, the work object that the robot carries.
    pub tool: Pose,
    /// The instruction with its arguments.
    pub(super) step: Move,
}

/// The moves of a routine as one motion: `MoveAbsJ`, `MoveJ`, `MoveL` and `MoveC` in order, each
/// followed, timed and checked (docs/guide/motion.md).
///
/// The routine is one of the first module: without a name, `main` or else the only one that moves.
/// Calls of procedures of all modules are followed, loops with known bounds in each pass.
/// Everything that is wrong with a move is a finding: an unknown value, a target that cannot be
/// reached, a flip, a singularity, another configuration than the target's, a joint too fast at the
/// programmed speed.
/// A line or an arc that cannot be followed is replaced by a joint move to its target; a move whose
/// target has no joints is left out, and a line after it is replaced in the same way.
///
/// # Errors
///
/// [`Error::Rapid`] for a routine that does not exist or has no moves, for branches, loops and
/// jumps around moves, with their line, and if not one move can be made; [`Error::InvalidModel`]
/// for an arm without configurations; [`Error::InvalidMotion`] for limits or steps that are not
/// positive, for a robot without velocities if none are given, or for too many samples;
/// [`Error::InvalidJoints`] for a start that is not finite.
pub fn motion<const N: usize>(
    robot: &Robot<N>,
    modules: &[&Module],
    routine: Option<&str>,
    options: &MotionOptions<N>,
) -> Result<RoutineMotion<N>, Error> {
    robot.configuration_rule()?;
    check(options)?;
    let max_velocity = velocities(robot, options)?.ok_or(MotionFault::NoMaxVelocity)?;
    let flange = with_flange(robot)?;
    let convert = converter(&flange, const { &Units(Vec::new()) });
    let program = Program::new(modules, &convert);
    let (routine, steps) = sequence(&program, routine)?;
    let none = Interrupt::none();
    let followed =
        Followed::new([robot, &flange], &steps, options, None, none, &mut |_, _| Ok(()))?;
    let Followed { goals, samples, made, mut findings, unfollowed } = followed;
    findings.extend(unfollowed);
    if samples.q.is_empty() || made.iter().all(|made| made.q.is_none()) {
        let finding = findings.first().map(Finding::to_string).unwrap_or_default();
        return Err(RapidFault::nowhere(RapidFaultKind::Routine(RoutineFault::NoMotion {
            finding,
        }))
        .into());
    }
    let pace = Pace {
        samples: &samples,
        goals: &goals,
        made: &made,
        max_velocity: &max_velocity,
        findings: &mut findings,
    };
    let (trajectory, t) = pace.timed(options.max_acceleration.as_ref())?;
    let moves = moves(&goals, &samples, &made, &t);
    let mut move_index = Vec::with_capacity(t.len());
    for (index, end) in samples.ends.iter().enumerate() {
        move_index.resize(*end, index);
    }
    findings.sort_by_key(|finding| finding.move_index);
    Ok(RoutineMotion { routine, trajectory, t, q: samples.q, move_index, moves, findings })
}

/// Steps that follow one another, gone through.
pub(in crate::rapid) struct Followed<'m, const N: usize> {
    pub(in crate::rapid) goals: Vec<Goal<'m, N>>,
    samples: Samples<N>,
    pub(in crate::rapid) made: Vec<Made<N>>,
    /// Findings on goals.
    pub(in crate::rapid) findings: Vec<Finding>,
    /// Findings on what is not followed.
    pub(in crate::rapid) unfollowed: Vec<Finding>,
}

impl<'m, const N: usize> Followed<'m, N> {
    /// The second robot is the first one with the flange as its tool. Without units, external axes
    /// do not matter. `finish` gets each move when its samples are final.
    pub(in crate::rapid) fn new(
        robots: [&Robot<N>; 2],
        steps: &'m [Step<'m>],
        options: &MotionOptions<N>,
        units: Option<&Units>,
        interrupt: Interrupt<'_>,
        finish: &mut dyn FnMut(&mut Drive<'_, 'm, N>, usize) -> Result<(), Error>,
    ) -> Result<Self, Error> {
        let (mut findings, mut unfollowed) = (Vec::new(), Vec::new());
        let goals = goals(robots[0], steps, units, [&mut findings, &mut unfollowed]);
        let (samples, made) =
            Drive::through(robots, &goals, options, &mut findings, interrupt, finish)?;
        Ok(Self { goals, samples, made, findings, unfollowed })
    }
}

pub(in crate::rapid) fn check<const N: usize>(options: &MotionOptions<N>) -> Result<(), Error> {
    if let Some(start) = &options.start {
        check_seed("start", start)?;
    }
    Spacing::step(options.step, options.turn)?;
    for (field, value) in [("step", options.step), ("turn", options.turn)] {
        if value.is_infinite() {
            return Err(MotionFault::NotPositive { field, index: None, value }.into());
        }
    }
    for (field, limits) in
        [("max_velocity", options.max_velocity), ("max_acceleration", options.max_acceleration)]
    {
        check_limits(field, limits.as_ref())?;
    }
    Ok(())
}

/// The velocities of the joints [rad/s], the robot's unless the options have them.
pub(in crate::rapid) fn velocities<const N: usize>(
    robot: &Robot<N>,
    options: &MotionOptions<N>,
) -> Result<Option<[f64; N]>, Error> {
    let max_velocity = options.max_velocity.or(robot.max_velocity().copied());
    check_limits("max_velocity", max_velocity.as_ref())?;
    Ok(max_velocity)
}

fn check_limits<const N: usize>(
    field: &'static str,
    limits: Option<&[f64; N]>,
) -> Result<(), Error> {
    let is_wrong = |limit: &f64| !(*limit > 0.0 && limit.is_finite());
    if let Some(limits) = limits
        && let Some(index) = limits.iter().position(is_wrong)
    {
        let (index, value) = (Some(index), limits[index]);
        return Err(MotionFault::NotPositive { field, index, value }.into());
    }
    Ok(())
}

/// The moves as goals; what is wrong with them, and what is not followed, is found.
fn goals<'m, const N: usize>(
    robot: &Robot<N>,
    steps: &'m [Step<'m>],
    units: Option<&Units>,
    [findings, unfollowed]: [&mut Vec<Finding>; 2],
) -> Vec<Goal<'m, N>> {
    let mut goals: Vec<Goal<'m, N>> = Vec::with_capacity(steps.len());
    let mut from_unknown = false;
    for step in steps {
        let move_index = goals.len();
        match step {
            Step::Move(stepped) => {
                let mut goal = Goal::new(robot, stepped, units, move_index, findings);
                goal.from_unknown = core::mem::take(&mut from_unknown);
                if let Some(before) = goals.last().filter(|it| it.frames == goal.frames) {
                    goal.frames = before.frames.clone();
                }
                if let (Some(units), Some(before)) = (units, goals.last()) {
                    let [from, to] = [before.step, goal.step].map(external_axes::<N>);
                    let between = units.between(&from, &to);
                    goal.from_unknown |= goal.is_cartesian() && between.turns;
                    if between.moves {
                        // How fast the tool goes there, seen from the robot, is not known.
                        goal.speed = [f64::INFINITY; 2];
                        goal.is_carried = true;
                    }
                }
                goals.push(goal);
            }
            Step::NotFollowed { module, statement, words } => {
                let finding = Finding::new(Code::NotFollowed, words.clone()).in_module(*module);
                unfollowed.push(finding.at_statement(statement, move_index));
                from_unknown = true;
            }
        }
    }
    for finding in unfollowed.iter_mut() {
        finding.move_index = finding.move_index.min(goals.len().saturating_sub(1));
    }
    goals
}

/// The moves with their times.
fn moves<const N: usize>(
    goals: &[Goal<'_, N>],
    samples: &Samples<N>,
    made: &[Made<N>],
    t: &[f64],
) -> Vec<MotionMove<N>> {
    let one = |(index, (goal, made)): (usize, (&Goal<'_, N>, &Made<N>))| {
        let own = samples.own(index);
        // It begins at the last sample of the move before it.
        let begin = own.start.saturating_sub(1);
        let ways = &samples.ways[samples.intervals(index)];
        MotionMove {
            kind: goal.step.kind,
            module: goal.stepped.instruction.0,
            module_index: goal.stepped.instruction.1,
            line: goal.step.line,
            start: t.get(begin).copied().unwrap_or(0.0),
            end: t.get(own.end.saturating_sub(1)).copied().unwrap_or(0.0),
            length: ways.iter().fold(0.0, |sum, way| sum + way[0]),
            q: made.q,
            as_programmed: made.as_programmed,
            tool: goal.frames.carried(),
            step: goal.step.clone(),
        }
    };
    goals.iter().zip(made).enumerate().map(one).collect()
}
