//! The joint angles of every target of a module.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::axes::{absent_axis, joint_vector, request};
use super::fallback::Fallback;
use super::frames::Frames;
use super::problem::Problem;
use super::target::{target_pose, with_flange};
use crate::error::Error;
use crate::kinematics::{Robot, SingularDistances, Solution};
use crate::rapid::data::module::{Content, Module};
use crate::rapid::data::moves::{Argument, Move, Target};
use crate::rapid::data::records::{JointTarget, RobTarget, ToolData, WobjData};
use crate::rapid::data::value::Value;
use crate::report::{Configuration, Explanation};

/// The result for one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow<const N: usize = 6> {
    /// The instruction, `MoveL` and the like, or `robtarget`.
    pub kind: &'static str,
    /// The target as it is written, or the name of its declaration.
    pub text: String,
    /// Line of the instruction or of the declaration.
    pub line: usize,
    /// Joint angles [rad]; `None` if there are none.
    pub q: Option<[f64; N]>,
    /// The configuration of the joint angles; if there are none, that of the target, or zeros if it
    /// is unknown too.
    pub configuration: Configuration,
    /// Distances of the joint angles from the singularities.
    pub distances: Option<SingularDistances>,
    /// The reason why there are no joint angles, or others than the target requests.
    pub problem: Option<Problem>,
}

/// The joint angles of every target of the module's moves, in order; a `MoveC` has two.
///
/// Each is solved with its own tool and work object. A `MoveAbsJ` has the joint angles that it
/// names, or none if one of them exceeds 1E6 degrees, as the 9E9 of an axis that does not exist. A
/// displaced move has none.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations. A problem with one target is reported
/// in its row.
pub fn calc_moves(
    robot: &Robot<6>,
    module: &Module,
    fallback: Fallback,
) -> Result<Vec<TableRow>, Error> {
    moves_table(robot, module, fallback)
}

/// [`calc_moves`] of an arm of any number of joints that has configurations.
///
/// # Errors
///
/// As [`calc_moves`].
pub fn moves_table<const N: usize>(
    robot: &Robot<N>,
    module: &Module,
    fallback: Fallback<N>,
) -> Result<Vec<TableRow<N>>, Error> {
    let mut table = Table::new(robot, fallback)?;
    for step in module.moves() {
        if let Some(via) = &step.via {
            table.add_move(step, via, |via| Ok(*via));
        }
        table.add_move(step, &step.target, |target| match target {
            Target::RobTarget(target) => Ok(*target),
            Target::JointTarget(joints) => Err(*joints),
        });
    }
    Ok(table.rows)
}

/// The joint angles of every robtarget that the module itself declares, element by element for
/// arrays, in the order of the text, all with one tool and one work object.
///
/// # Errors
///
/// As [`calc_moves`], and [`Error::Frame`] as [`calc_joint_t`](crate::rapid::calc_joint_t).
pub fn calc_targets(
    robot: &Robot<6>,
    module: &Module,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    fallback: Fallback,
) -> Result<Vec<TableRow>, Error> {
    targets_table(robot, module, tool, wobj, fallback)
}

/// [`calc_targets`] of an arm of any number of joints that has configurations.
///
/// # Errors
///
/// As [`calc_targets`].
pub fn targets_table<const N: usize>(
    robot: &Robot<N>,
    module: &Module,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    fallback: Fallback<N>,
) -> Result<Vec<TableRow<N>>, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let mut table = Table::new(robot, fallback)?;
    for datum in module.data().iter().filter(|datum| datum.routine.is_none()) {
        match &datum.content {
            Content::Single(Value::RobTarget(target)) => {
                table.add("robtarget", datum.name.clone(), datum.line, target, Ok(frames));
            }
            Content::Array { sizes, values } => {
                for (number, value) in values.iter().enumerate() {
                    if let Value::RobTarget(target) = value {
                        table.add(
                            "robtarget",
                            element(&datum.name, sizes, number),
                            datum.line,
                            target,
                            Ok(frames),
                        );
                    }
                }
            }
            _ => {}
        }
    }
    Ok(table.rows)
}

/// The frames of a move.
pub(in crate::rapid) fn frames_of<const N: usize>(
    robot: &Robot<N>,
    step: &Move,
) -> Result<Frames, Problem> {
    let Argument { text, value, .. } = &step.tool;
    let tool = value
        .as_ref()
        .map_err(|reason| Problem::Tool { text: text.clone(), reason: reason.clone() })?;
    let wobj = step.wobj.as_ref().map(|Argument { text, value, .. }| {
        value
            .as_ref()
            .map_err(|reason| Problem::WorkObject { text: text.clone(), reason: reason.clone() })
    });
    Frames::new(robot, Some(tool), wobj.transpose()?).map_err(Problem::NotSolved)
}

/// The joint or linkage that is outside the limits, and the excess.
pub(in crate::rapid) fn outside<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Option<Problem> {
    let limits = robot.limits();
    if limits.contains(q) {
        return None;
    }
    let farthest =
        (0..N).max_by(|a, b| limits.excess(*a, q[*a]).total_cmp(&limits.excess(*b, q[*b])))?;
    let excess = limits.excess(farthest, q[farthest]);
    Some(if excess > 0.0 {
        Problem::OutsideLimits { joint: farthest + 1, excess }
    } else {
        Problem::OutsideLinkageLimits { excess: limits.linkage_excess(q) }
    })
}

/// The name of an element of an array, by its index in the order of the values.
fn element(name: &str, sizes: &[usize], mut number: usize) -> String {
    let mut indices = Vec::with_capacity(sizes.len());
    for size in sizes.iter().rev() {
        indices.push((number % size + 1).to_string());
        number /= size;
    }
    indices.reverse();
    format!("{name}{{{}}}", indices.join(","))
}

struct Table<'a, const N: usize> {
    robot: &'a Robot<N>,
    /// The same robot with the flange as its tool.
    flange: Robot<N>,
    fallback: Fallback<N>,
    rows: Vec<TableRow<N>>,
}

impl<'a, const N: usize> Table<'a, N> {
    fn new(robot: &'a Robot<N>, fallback: Fallback<N>) -> Result<Self, Error> {
        robot.configuration_rule()?;
        Ok(Self { robot, flange: with_flange(robot)?, fallback, rows: Vec::new() })
    }

    /// Add a row for an argument of a move, which `read` converts to a robtarget or a jointtarget.
    fn add_move<T>(
        &mut self,
        step: &Move,
        argument: &Argument<T>,
        read: impl Fn(&T) -> Result<RobTarget, JointTarget>,
    ) {
        let (kind, text) = (step.kind.name(), argument.text.clone());
        if let Some(line) = step.displaced {
            return self.add_problem(kind, text, step.line, Problem::Displaced { line });
        }
        match argument.value.as_ref().map(read) {
            Ok(Ok(target)) => {
                let frames = frames_of(self.robot, step);
                self.add(kind, text, step.line, &target, frames);
            }
            Ok(Err(joints)) => match absent_axis::<N>(&joints) {
                Some((axis, degrees)) => {
                    let problem = Problem::AbsentAxis { axis, degrees };
                    self.add_problem(kind, text, step.line, problem);
                }
                None => self.add_joints(kind, text, step.line, joint_vector(&joints)),
            },
            Err(reason) => self.add_problem(kind, text, step.line, Problem::Target(reason.clone())),
        }
    }

    fn add_problem(&mut self, kind: &'static str, text: String, line: usize, problem: Problem) {
        let configuration = Configuration::default();
        self.rows.push(TableRow {
            kind,
            text,
            line,
            q: None,
            configuration,
            distances: None,
            problem: Some(problem),
        });
    }

    fn add(
        &mut self,
        kind: &'static str,
        text: String,
        line: usize,
        target: &RobTarget,
        frames: Result<Frames, Problem>,
    ) {
        let (q, problem) = match frames.and_then(|frames| self.solved(target, &frames)) {
            Ok((q, problem)) => (Some(q), problem),
            Err(problem) => (None, Some(problem)),
        };
        let (configuration, distances) = q.map_or((target.robconf, None), |q| self.seen(&q));
        self.rows.push(TableRow { kind, text, line, q, configuration, distances, problem });
    }

    fn add_joints(&mut self, kind: &'static str, text: String, line: usize, q: [f64; N]) {
        let (configuration, distances) = self.seen(&q);
        let problem = outside(self.robot, &q);
        self.rows.push(TableRow {
            kind,
            text,
            line,
            q: Some(q),
            configuration,
            distances,
            problem,
        });
    }

    /// The joint angles of a target, and the problem with them, if any.
    fn solved(
        &self,
        target: &RobTarget,
        frames: &Frames,
    ) -> Result<([f64; N], Option<Problem>), Problem> {
        let pose = frames.flange(&target_pose(target).map_err(Problem::NotSolved)?);
        let mut asked = request(&self.flange, target).map_err(Problem::NotSolved)?;
        let first = match self.fallback {
            Fallback::None => None,
            Fallback::Near(first) | Fallback::Nearest(first) => Some(first),
        };
        asked.seed = self.rows.iter().rev().find_map(|row| row.q).or(first);
        let missed = match self.flange.ik_configured_all(&pose, asked) {
            Ok(all) => return chosen(&all),
            Err(error) => error,
        };
        let (Error::NoConfiguration(_), Fallback::Nearest(_), Some(seed)) =
            (&missed, self.fallback, asked.seed)
        else {
            return Err(Problem::NotSolved(missed));
        };
        let nearest = self.flange.ik_nearest(&pose, &seed, &[1.0; N]);
        Ok((nearest.map_err(Problem::NotSolved)?.q, Some(Problem::Nearest(missed))))
    }

    fn seen(&self, q: &[f64; N]) -> (Configuration, Option<SingularDistances>) {
        let configuration = self.robot.configuration(q).unwrap_or_default();
        (configuration, self.robot.singular_distances(q))
    }
}

/// The first of the solutions that a configuration names, and that there are more.
fn chosen<const N: usize>(all: &[Solution<N>]) -> Result<([f64; N], Option<Problem>), Problem> {
    let first =
        all.first().ok_or(Problem::NotSolved(Error::Unreachable(Explanation::FilteredOut)))?;
    let count = all.len();
    Ok((first.q, (count > 1).then_some(Problem::Ambiguous { count })))
}
