//! The joint angles of every target of a module.

use super::frames::Frames;
use super::target::{Fallback, absent_axis, joint_vector, request, target_pose, with_flange};
use super::units::Units;
use super::wrong::{
    OrFinding, absent, ambiguous, displaced, nearest_taken, not_solved, outside, unknown_axis,
};
use crate::Error;
use crate::prelude::*;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::{Content, Module};
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::records::{JointTarget, NOT_THERE, RobTarget, ToolData, WobjData};
use crate::rapid::data::value::Value;
use crate::rapid::text::fault::FrameFault;
use irbkin::{Configuration, Error as RobotError, Explanation, Robot, SingularDistances, Solution};

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
    /// The configuration of the joint angles; without joint angles the target's, or zeros if it
    /// is unknown too.
    pub configuration: Configuration,
    /// Distances of the joint angles from the singularities.
    pub distances: Option<SingularDistances>,
    /// Why there are no joint angles, or others than the target requests.
    pub finding: Option<Finding>,
}

/// The joint angles of every target of the module's moves, in order; a `MoveC` has two.
///
/// Each is solved with its own tool and work object. A `MoveAbsJ` has the joint angles that it
/// names, or none if one of them exceeds 1E6 degrees, as the 9E9 of an axis that does not exist. A
/// displaced move has none. A move of external axes only has no row.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations. A problem with one target is reported
/// in its row.
pub fn calc_moves<const N: usize>(
    robot: &Robot<N>,
    module: &Module,
    fallback: Fallback<N>,
) -> Result<Vec<TableRow<N>>, Error> {
    let mut table = Table::new(robot, fallback)?;
    for step in module.moves().iter().filter(|step| step.kind != MoveKind::MoveExtJ) {
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
pub fn calc_targets<const N: usize>(
    robot: &Robot<N>,
    module: &Module,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    fallback: Fallback<N>,
) -> Result<Vec<TableRow<N>>, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let mut table = Table::new(robot, fallback)?;
    for datum in module.data().iter().filter(|datum| datum.routine.is_none()) {
        let (sizes, values) = match &datum.content {
            Content::Single(value) => (&[][..], core::slice::from_ref(value)),
            Content::Array { sizes, values } => (sizes.as_slice(), values.as_slice()),
            Content::Uninitialized { .. } => continue,
        };
        for (number, value) in values.iter().enumerate() {
            if let Value::RobTarget(target) = value {
                let text = element(&datum.name, sizes, number);
                let place = (datum.line, datum.column);
                let row = Row { kind: "robtarget", text, place, routine: None };
                table.add(row, table.solved(target, Ok(frames)), target.robconf);
            }
        }
    }
    Ok(table.rows)
}

/// The frames of a move, with the units of its external axes.
pub(in crate::rapid) fn frames_of<const N: usize>(
    robot: &Robot<N>,
    step: &Move,
    units: Option<&Units>,
) -> OrFinding<Frames> {
    let tool = known(&step.tool, Code::UnknownTool, "tool ")?;
    let wobj = step.wobj.as_ref().map(|wobj| known(wobj, Code::UnknownWorkObject, "work object "));
    let extax = external_axes::<N>(step);
    let wobj = wobj.transpose()?;
    let Some(units) = units else {
        return Frames::new(robot, Some(tool), wobj).map_err(|error| not_solved(&error).into());
    };
    if let Some(external) = units.unknown(&extax) {
        return Err(unknown_axis(external, extax[external]).into());
    }
    Frames::at(robot, Some(tool), wobj, (units, &extax)).map_err(|error| {
        let Error::Frame(fault) = &error else { return not_solved(&error).into() };
        let cause = error.to_string();
        let words = match (fault, &step.wobj) {
            (FrameFault::Moved { .. }, Some(it)) => format!("work object {}: {cause}", it.text),
            (FrameFault::Carried { .. }, _) => cause.clone(),
            // Joint angles need no frame.
            (FrameFault::AxisMissing { .. }, _) if step.kind == MoveKind::MoveAbsJ => cause.clone(),
            _ => return not_solved(&error).into(),
        };
        Finding::new(Code::UnknownUnit, words).caused_by(cause).into()
    })
}

/// The external axes of a move's target [deg or mm]; zero where its value is not known. The first
/// number of a seven-axis arm belongs to its own axis 7.
pub(in crate::rapid) fn external_axes<const N: usize>(step: &Move) -> [f64; 6] {
    let mut extax = match &step.target.value {
        Ok(Target::RobTarget(target)) => target.extax,
        Ok(Target::JointTarget(target)) => target.extax,
        Err(_) => [0.0; 6],
    };
    if N == 7 {
        extax[0] = NOT_THERE;
    }
    extax
}

/// The value of an argument, which messages name after what it is.
fn known<'m, T>(argument: &'m Argument<T>, code: Code, what: &str) -> OrFinding<&'m T> {
    argument.value.as_ref().map_err(|reason| {
        Finding::unknown(code, reason, format!("{what}{}: {reason}", argument.text)).into()
    })
}

pub(in crate::rapid) fn target_of<T>(argument: &Argument<T>) -> OrFinding<&T> {
    let value = argument.value.as_ref();
    value.map_err(|reason| Finding::unknown(Code::UnknownTarget, reason, reason.to_string()).into())
}

/// The name of an element of an array, by its index in the order of the values; without sizes the
/// name of the datum.
fn element(name: &str, sizes: &[usize], mut number: usize) -> String {
    if sizes.is_empty() {
        return name.to_string();
    }
    let mut indices = Vec::with_capacity(sizes.len());
    for size in sizes.iter().rev() {
        indices.push((number % size + 1).to_string());
        number /= size;
    }
    indices.reverse();
    format!("{name}{{{}}}", indices.join(","))
}

/// A row before its target is solved.
struct Row {
    kind: &'static str,
    text: String,
    /// Line and column.
    place: (usize, usize),
    routine: Option<String>,
}

/// Joint angles, with a finding if they are others than the target requests.
type Solved<const N: usize> = OrFinding<([f64; N], Option<Finding>)>;

struct Table<'a, const N: usize> {
    robot: &'a Robot<N>,
    /// The robot with the flange as its tool.
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
        let (kind, text) = (step.kind.name(), argument.text.to_string());
        let place = (step.line, step.column);
        let routine = step.routine.as_deref().map(Into::into);
        let row = Row { kind, text, place, routine };
        let target = match step.displaced {
            Some(line) => Err(displaced(line).into()),
            None => target_of(argument).map(read),
        };
        let mut robconf = Configuration::default();
        let solved = match target {
            Err(finding) => Err(finding),
            Ok(Ok(target)) => {
                robconf = target.robconf;
                self.solved(&target, frames_of(self.robot, step, None))
            }
            Ok(Err(joints)) => {
                if let Some((axis, degrees)) = absent_axis::<N>(&joints) {
                    Err(absent(axis, degrees).into())
                } else {
                    let q = joint_vector(&joints);
                    Ok((q, outside(self.robot, &q)))
                }
            }
        };
        self.add(row, solved, robconf);
    }

    /// Add a row; without joint angles it has the configuration of the target.
    fn add(&mut self, row: Row, solved: Solved<N>, robconf: Configuration) {
        let Row { kind, text, place, routine } = row;
        let (q, finding) = match solved {
            Ok((q, finding)) => (Some(q), finding),
            Err(finding) => (None, Some(*finding)),
        };
        let configuration = q.map_or(robconf, |q| self.robot.configuration(&q).unwrap_or_default());
        let distances = q.and_then(|q| self.robot.singular_distances(&q));
        let what = format!("{kind} {text}");
        let finding = finding.map(|it| it.placed(place, routine, self.rows.len(), &what));
        let line = place.0;
        self.rows.push(TableRow { kind, text, line, q, configuration, distances, finding });
    }

    fn solved(&self, target: &RobTarget, frames: OrFinding<Frames>) -> Solved<N> {
        let refused = |error: Error| Box::new(not_solved(&error));
        let pose = frames?.flange(&target_pose(target).map_err(refused)?);
        let mut asked = request(&self.flange, target).map_err(refused)?;
        let first = match self.fallback {
            Fallback::None => None,
            Fallback::Near(first) | Fallback::Nearest(first) => Some(first),
        };
        asked.seed = self.rows.iter().rev().find_map(|row| row.q).or(first);
        let missed = match self.flange.ik_configured_all(&pose, asked) {
            Ok(all) => return chosen(&all),
            Err(error) => Error::from(error),
        };
        let (Error::Robot(RobotError::NoConfiguration(_)), Fallback::Nearest(_), Some(seed)) =
            (&missed, self.fallback, asked.seed)
        else {
            return Err(refused(missed));
        };
        let nearest = self.flange.ik_nearest(&pose, &seed, &[1.0; N]);
        let nearest = nearest.map_err(|error| refused(error.into()))?;
        Ok((nearest.q, Some(nearest_taken(&missed))))
    }
}

/// The first of the solutions that a configuration names, with a finding if there are more.
fn chosen<const N: usize>(all: &[Solution<N>]) -> Solved<N> {
    let none = || not_solved(&RobotError::Unreachable(Explanation::FilteredOut).into());
    let first = all.first().ok_or_else(none)?;
    let count = all.len();
    Ok((first.q, (count > 1).then(|| ambiguous(count))))
}
