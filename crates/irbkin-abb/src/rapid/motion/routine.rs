//! A routine as one motion.

use alloc::collections::BTreeSet;

use super::drive::{Drive, Made, MotionOptions};
use super::goal::Goal;
use super::joints::Samples;
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::table::external_axes;
use crate::rapid::calc::target::{converter, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::{Move, MoveKind};
use crate::rapid::motion::thresholds::{JOINED_MOVES, MOST_ACCELERATION};
use crate::rapid::program::walk::steps;
use crate::rapid::program::walker::Step;
use crate::rapid::program::whole::Program;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind, RoutineFault};
use irbkin::internal::check_seed;
use irbkin::{Interrupt, Pose, Robot};
use irbkin_motion::internal::{
    LEAST_WAY, LIMIT_ROUNDING, MOST_DURATION, MotionFault, check_positive, evenly, within_times,
};
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
    if samples.path.q.is_empty() || made.iter().all(|made| made.q.is_none()) {
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
    Ok(RoutineMotion { routine, trajectory, t, q: samples.path.q, move_index, moves, findings })
}

/// Steps that follow one another, gone through.
pub(in crate::rapid) struct Followed<'m, const N: usize> {
    pub(in crate::rapid) goals: Vec<Goal<'m, N>>,
    samples: Samples<N>,
    pub(in crate::rapid) made: Vec<Made<N>>,
    pub(in crate::rapid) findings: Vec<Finding>,
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
    check_positive("step", options.step)?;
    check_positive("turn", options.turn)?;
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
pub(in crate::rapid) fn goals<'m, const N: usize>(
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
                    if let Some(turns) = units.turn_between(&from, &to) {
                        goal.from_unknown |= goal.is_cartesian() && turns;
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
        let ways = &samples.path.ways[samples.intervals(index)];
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
            tool: goal.frames.t_flange_carried,
            step: goal.step.clone(),
        }
    };
    goals.iter().zip(made).enumerate().map(one).collect()
}

/// The steps of a routine of the first module of a program, and its name; `None` for moves outside
/// routines.
pub(super) fn sequence<'m>(
    program: &Program<'m>,
    routine: Option<&str>,
) -> Result<(Option<String>, Vec<Step<'m>>), Error> {
    let Some(module) = program.modules.first() else {
        return Err(fault(0, RoutineFault::NoMoves { routine: "the program".into() }));
    };
    let name = chosen(module, routine)?;
    let (steps, uncertain) = steps(program, name.as_deref().unwrap_or_default());
    if let Some((line, word)) = uncertain {
        return Err(fault(line, RoutineFault::Branch { word }));
    }
    if steps.iter().any(|step| matches!(step, Step::Move(_))) {
        return Ok((name, steps));
    }
    let routine = name.unwrap_or_else(|| "the text".to_string());
    Err(fault(0, RoutineFault::NoMoves { routine }))
}

fn fault(line: usize, fault: RoutineFault) -> Error {
    let kind = RapidFaultKind::Routine(fault);
    RapidFault { line, column: usize::from(line > 0), kind }.into()
}

/// The routine of a name; without one main, or the only one that moves.
fn chosen(module: &Module, wanted: Option<&str>) -> Result<Option<String>, Error> {
    let names = || module.routines().iter().map(|routine| routine.name.as_str());
    if let Some(wanted) = wanted {
        let found = names().find(|name| name.eq_ignore_ascii_case(wanted));
        let kind = || RoutineFault::Unknown { name: wanted.into(), known: names().collect() };
        return found.map(|name| Some(name.into())).ok_or_else(|| fault(0, kind()));
    }
    if let Some(main) = names().find(|name| name.eq_ignore_ascii_case("main")) {
        return Ok(Some(main.into()));
    }
    let moving: BTreeSet<Option<&str>> =
        module.moves().iter().map(|step| step.routine.as_deref()).collect();
    if moving.is_empty() {
        return Err(fault(0, RoutineFault::NoMoves { routine: "the module".into() }));
    }
    if let (Some(only), 1) = (moving.first(), moving.len()) {
        return Ok(only.map(String::from));
    }
    Err(fault(0, RoutineFault::Which { moving: moving.into_iter().flatten().collect() }))
}

pub(super) struct Pace<'a, 'm, const N: usize> {
    pub(super) samples: &'a Samples<N>,
    pub(super) goals: &'a [Goal<'m, N>],
    pub(super) made: &'a [Made<N>],
    pub(super) max_velocity: &'a [f64; N],
    pub(super) findings: &'a mut Vec<Finding>,
}

/// A joint that is too fast at the programmed speed, or at what the length of a line allows.
#[derive(Clone, Copy)]
struct TooFast {
    joint: usize,
    /// Its speed as a part of its limit [1].
    excess: f64,
    /// The speed that the length allows there, if it is below the programmed one [m/s].
    allowed: Option<f64>,
}

impl<const N: usize> Drive<'_, '_, N> {
    /// Find a joint that is too fast at the programmed speed of a move.
    pub(in crate::rapid) fn check_speed(&mut self, index: usize, max_velocity: &[f64; N]) {
        let Self { goals, samples, made, findings, .. } = self;
        let mut least = vec![0.0; samples.path.q.len()];
        Pace { samples, goals, made, max_velocity, findings }.add_times(index, &mut least);
    }
}

impl<const N: usize> Pace<'_, '_, N> {
    /// The trajectory, and the time of each sample [s].
    pub(super) fn timed(
        mut self,
        max_acceleration: Option<&[f64; N]>,
    ) -> Result<(Trajectory, Vec<f64>), Error> {
        let mut least = vec![0.0; self.samples.path.q.len().saturating_sub(1)];
        for index in 0..self.goals.len() {
            self.add_times(index, &mut least);
        }
        let timed = if let Some(max_acceleration) = max_acceleration {
            self.between_rests(&least, max_acceleration)?
        } else {
            let mut times = Vec::with_capacity(self.samples.path.q.len());
            times.push(0.0);
            for (index, least) in least.iter().enumerate() {
                times.push(times[index] + least);
            }
            (evenly(&times, &self.samples.path.q), times)
        };
        let value = timed.0.duration();
        if value.is_nan() || value > MOST_DURATION {
            let bounds = [0.0, MOST_DURATION];
            return Err(MotionFault::Duration { value, bounds }.into());
        }
        self.check_times(&timed.1);
        Ok(timed)
    }

    /// The joint (from 1) that takes longest at its limit from the sample before one, and how long
    /// [s].
    fn slowest(&self, sample: usize) -> (usize, f64) {
        let (from, to) = (&self.samples.path.q[sample - 1], &self.samples.path.q[sample]);
        let time = |joint: usize| (to[joint] - from[joint]).abs() / self.max_velocity[joint];
        let (mut slowest, mut longest) = (0, time(0));
        for joint in 1..N {
            if time(joint) > longest {
                (slowest, longest) = (joint, time(joint));
            }
        }
        (slowest + 1, longest)
    }

    /// The times of the intervals of a move [s], the first one at index 0 for sample 1; a joint that
    /// is too fast is found.
    fn add_times(&mut self, index: usize, least: &mut [f64]) {
        let (intervals, goal) = (self.samples.intervals(index), &self.goals[index]);
        let mut sums = [0.0; 2];
        for way in &self.samples.path.ways[intervals.clone()] {
            sums = [sums[0] + way[0], sums[1] + way[1]];
        }
        let as_programmed = self.made[index].as_programmed;
        let mut speed = goal.speed;
        if let Some(time) = goal.time {
            // By the length of the tool's way or, if it has none, by its turn.
            speed = if sums[0] > 0.0 {
                [sums[0] / time, f64::INFINITY]
            } else {
                [f64::INFINITY, sums[1] / time]
            };
        }
        let too_fast = if !as_programmed {
            for sample in intervals {
                least[sample - 1] = self.slowest(sample).1;
            }
            None
        } else if goal.is_cartesian() {
            self.add_cartesian(index, speed, least)
        } else {
            let programmed =
                goal.time.unwrap_or_else(|| (sums[0] / speed[0]).max(sums[1] / speed[1]));
            let too_fast = self.add_even(intervals, programmed, least);
            // Without \T a joint move is as slow as its slowest joint.
            too_fast.filter(|_| goal.time.is_some())
        };
        if let Some(TooFast { joint, excess, allowed }) = too_fast {
            let bound = self.max_velocity[joint - 1];
            let value = bound * excess;
            let reached = allowed.unwrap_or(speed[0]) * 1e3;
            let of =
                if reached.is_finite() { format!("{reached:.0} mm/s") } else { "it".to_string() };
            let at = if allowed.is_some() {
                "at the speed that its length allows"
            } else {
                "at the programmed speed"
            };
            let words = format!(
                "J{joint} must turn at {:.1} deg/s {at}, its limit is {:.1} deg/s: slowed down to \
                 {:.0} % of {of}",
                value.to_degrees(),
                bound.to_degrees(),
                excess.recip() * 1e2
            );
            let finding = Finding::new(Code::JointTooFast, words).of_joint(joint);
            self.findings.push(finding.with_value(value, bound).at(goal.step, index));
        }
    }

    /// A line or an arc: each interval takes what the programmed speeds and the joints need
    /// (eq. 31).
    fn add_cartesian(&self, index: usize, speed: [f64; 2], least: &mut [f64]) -> Option<TooFast> {
        let mut too_fast = None;
        let mut most = 1.0 + LIMIT_ROUNDING;
        let intervals = self.samples.intervals(index);
        let is_timed = self.goals[index].time.is_some();
        let starts = !is_timed && index > 0 && self.goals[index - 1].stops;
        let stops = !is_timed && self.goals[index].stops;
        let total: f64 = self.samples.path.ways[intervals.clone()].iter().map(|way| way[0]).sum();
        let mut gone = 0.0;
        // The time that the tool takes for a way, from rest or to rest.
        let time = |way: f64| (2.0 * way.max(0.0) / MOST_ACCELERATION).sqrt();
        for sample in intervals {
            let [length, angle] = self.samples.path.ways[sample];
            let programmed = (length / speed[0]).max(angle / speed[1]);
            let (joint, needed) = self.slowest(sample);
            least[sample - 1] = programmed.max(needed);
            let mut duration = programmed;
            if starts {
                duration = duration.max(time(gone + length) - time(gone));
            }
            gone += length;
            if stops {
                duration = duration.max(time(total - gone + length) - time(total - gone));
            }
            let excess = needed / duration;
            // Of a speed that was left out nothing can be too fast.
            let is_known = programmed > 0.0 && (length == 0.0 || speed[0].is_finite());
            // Nor where the rounding of joints is more than what the tool goes.
            let is_known = is_known && (length > LEAST_WAY || angle > JOINED_MOVES);
            if is_known && excess > most {
                let allowed = (duration > programmed).then(|| length / duration);
                (most, too_fast) = (excess, Some(TooFast { joint, excess, allowed }));
            }
        }
        too_fast
    }

    /// A joint move: all joints arrive together, at a constant pace of the slowest (eq. 32).
    fn add_even(
        &self,
        intervals: core::ops::Range<usize>,
        programmed: f64,
        least: &mut [f64],
    ) -> Option<TooFast> {
        let mut total = 0.0;
        let mut longest = (1, 0.0);
        for sample in intervals.clone() {
            let (joint, needed) = self.slowest(sample);
            total += needed;
            if needed > longest.1 {
                longest = (joint, needed);
            }
        }
        let slower = if total > 0.0 { (programmed / total).max(1.0) } else { 1.0 };
        for sample in intervals {
            least[sample - 1] = self.slowest(sample).1 * slower;
        }
        let excess = total / programmed;
        (programmed > 0.0 && excess > 1.0 + LIMIT_ROUNDING).then_some(TooFast {
            joint: longest.0,
            excess,
            allowed: None,
        })
    }

    /// With accelerations: from rest to rest, where the robot stops and where it does not go on
    /// smoothly.
    fn between_rests(
        &self,
        least: &[f64],
        max_acceleration: &[f64; N],
    ) -> Result<(Trajectory, Vec<f64>), Error> {
        let q = &self.samples.path.q;
        let mut times = vec![0.0];
        let mut motion = evenly(&[0.0], &q[..1]);
        let mut begin = 0;
        for (index, goal) in self.goals.iter().enumerate() {
            let end = self.samples.ends[index];
            let next = self.made.get(index + 1);
            let is_smooth = self.made[index].is_rounded && !goal.stops;
            let goes_on = is_smooth && next.is_some_and(|next| next.as_programmed);
            if goes_on || end <= begin + 1 {
                continue;
            }
            let rows = &q[begin..end];
            let (part, own) =
                within_times(rows, &least[begin..end - 1], self.max_velocity, max_acceleration)?;
            let offset = times[begin];
            times.extend(own.iter().skip(1).map(|time| offset + time));
            motion = if begin == 0 { part } else { motion.then(&part)? };
            begin = end - 1;
        }
        Ok((motion, times))
    }

    /// Report moves that take longer than `\T` says.
    fn check_times(&mut self, times: &[f64]) {
        for (index, goal) in self.goals.iter().enumerate() {
            let (own, Some(bound)) = (self.samples.intervals(index), goal.time) else { continue };
            if own.is_empty() || !self.made[index].as_programmed {
                continue;
            }
            let value = times[own.end - 1] - times[own.start - 1];
            if value > bound * (1.0 + LIMIT_ROUNDING) {
                let words = format!("takes {value:.3} s, \\T asks for {bound:.3} s");
                let finding = Finding::new(Code::JointTooFast, words).with_value(value, bound);
                self.findings.push(finding.at(goal.step, index));
            }
        }
    }
}
