//! The joint angles of every target of a module.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::calc::{error_name, target_pose, with_flange};
use super::frames::Frames;
use super::module::{Content, Module};
use super::moves::{Argument, Move, Target};
use super::values::{NOT_THERE, RobTarget, ToolData, Value, WobjData};
use crate::error::Error;
use crate::kinematics::{Configuration, Robot, SingularDistances};

/// |joint angle| above which a jointtarget means that the axis is not there [deg]: no joint turns so far, and RAPID writes 9E9.
const MOST_DEGREES: f64 = 1e6;

/// What became of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    /// What it is: `MoveL` and the like, or `robtarget`.
    pub kind: &'static str,
    /// The target as it is written, or the name of its declaration.
    pub text: String,
    /// Line of the instruction or of the declaration.
    pub line: usize,
    /// Joint angles [rad]; `None` where there are none.
    pub q: Option<[f64; 6]>,
    /// The configuration of the joint angles; that of the target where there are none, zeros where that is not known either.
    pub configuration: Configuration,
    /// How far the joint angles are from the singularities.
    pub distances: Option<SingularDistances>,
    /// What is wrong: why there are no joint angles, or why they are others than the target asks for.
    pub problem: Option<String>,
}

/// What to do with a target whose configuration no solution has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fallback {
    /// It has no joint angles.
    None,
    /// It gets the solution nearest to the joint angles before it, of the first target to these [rad], and the problem says so.
    Nearest([f64; 6]),
}

/// The joint angles of every target of the module's moves, in their order; a `MoveC` has two.
///
/// Each is seen with its own tool and work object. A `MoveAbsJ` has the joint angles that it names, none where one of them is more than
/// 1E6 degrees, as the 9E9 of an axis that is not there. A move that is displaced has none.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations. What is wrong with one target is told in its row.
pub fn calc_moves(
    robot: &Robot<6>,
    module: &Module,
    fallback: Fallback,
) -> Result<Vec<TableRow>, Error> {
    let mut table = Table::new(robot, fallback)?;
    for step in module.moves() {
        if let Some(via) = &step.via {
            table.add_move(step, via, |via| Ok(*via));
        }
        table.add_move(step, &step.target, |target| match target {
            Target::RobTarget(target) => Ok(*target),
            Target::JointTarget(joints) => Err(joints.robax_deg),
        });
    }
    Ok(table.rows)
}

/// The joint angles of every robtarget that the module itself declares, element by element of arrays, in the order of the text, all with one
/// tool and one work object.
///
/// # Errors
///
/// As [`calc_moves`], and [`Error::Frame`] as [`super::calc_joint_t`].
pub fn calc_targets(
    robot: &Robot<6>,
    module: &Module,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    fallback: Fallback,
) -> Result<Vec<TableRow>, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let mut table = Table::new(robot, fallback)?;
    for datum in module.data().iter().filter(|datum| datum.routine.is_none()) {
        match &datum.content {
            Content::Single(Value::RobTarget(target)) => {
                table.add("robtarget", datum.name.clone(), datum.line, target, Ok(frames))
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

/// What is said of the first axis that is not there, by the joint angles [deg].
fn absent_axis(robax_deg: &[f64; 6]) -> Option<String> {
    let axis = robax_deg.iter().position(|degrees| degrees.abs() > MOST_DEGREES)?;
    let written = if robax_deg[axis].to_bits() == NOT_THERE.to_bits() {
        "9E9".to_string()
    } else {
        Value::Num(robax_deg[axis]).to_string()
    };
    Some(format!("axis {} is {written}: it is not there", axis + 1))
}

/// The name of an element of an array by its number in the order of the values.
fn element(name: &str, sizes: &[usize], mut number: usize) -> String {
    let mut indices = Vec::with_capacity(sizes.len());
    for size in sizes.iter().rev() {
        indices.push((number % size + 1).to_string());
        number /= size;
    }
    indices.reverse();
    format!("{name}{{{}}}", indices.join(","))
}

struct Table<'a> {
    robot: &'a Robot<6>,
    /// The same robot with its flange for a tool.
    flange: Robot<6>,
    fallback: Fallback,
    rows: Vec<TableRow>,
}

impl<'a> Table<'a> {
    fn new(robot: &'a Robot<6>, fallback: Fallback) -> Result<Self, Error> {
        robot.counted()?;
        Ok(Self { robot, flange: with_flange(robot)?, fallback, rows: Vec::new() })
    }

    /// A row for an argument of a move, which `read` takes for a robtarget or for joint angles [deg].
    fn add_move<T>(
        &mut self,
        step: &Move,
        argument: &Argument<T>,
        read: impl Fn(&T) -> Result<RobTarget, [f64; 6]>,
    ) {
        let (kind, text) = (step.kind.name(), argument.text.clone());
        if let Some(line) = step.displaced {
            let problem = format!("line {line} displaces it, which is not followed");
            return self.add_problem(kind, text, step.line, problem);
        }
        match argument.value.as_ref().map(read) {
            Ok(Ok(target)) => {
                let frames = self.frames_of(step);
                self.add(kind, text, step.line, &target, frames);
            }
            Ok(Err(joints)) => match absent_axis(&joints) {
                Some(problem) => self.add_problem(kind, text, step.line, problem),
                None => self.add_joints(kind, text, step.line, joints.map(f64::to_radians)),
            },
            Err(reason) => self.add_problem(kind, text, step.line, reason.clone()),
        }
    }

    fn frames_of(&self, step: &Move) -> Result<Frames, String> {
        let tool = step
            .tool
            .value
            .as_ref()
            .map_err(|reason| format!("tool {}: {reason}", step.tool.text))?;
        let wobj = step.wobj.as_ref().map(|wobj| {
            wobj.value.as_ref().map_err(|reason| format!("work object {}: {reason}", wobj.text))
        });
        Frames::new(self.robot, Some(tool), wobj.transpose()?).map_err(|error| error.to_string())
    }

    fn add_problem(&mut self, kind: &'static str, text: String, line: usize, problem: String) {
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
        frames: Result<Frames, String>,
    ) {
        let (q, problem) = match frames.and_then(|frames| self.solved(target, &frames)) {
            Ok((q, problem)) => (Some(q), problem),
            Err(problem) => (None, Some(problem)),
        };
        let (configuration, distances) = q.map_or((target.robconf, None), |q| self.seen(&q));
        self.rows.push(TableRow { kind, text, line, q, configuration, distances, problem });
    }

    fn add_joints(&mut self, kind: &'static str, text: String, line: usize, q: [f64; 6]) {
        let (configuration, distances) = self.seen(&q);
        let problem = self.outside(&q).map(|outside| format!("ERR_ROBLIMIT: {outside}"));
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

    /// What is outside the limits, and by how much.
    fn outside(&self, q: &[f64; 6]) -> Option<String> {
        let limits = self.robot.limits();
        if limits.contain(q) {
            return None;
        }
        let farthest =
            (0..6).max_by(|a, b| limits.excess(*a, q[*a]).total_cmp(&limits.excess(*b, q[*b])))?;
        let (excess, rod) = (limits.excess(farthest, q[farthest]), limits.rod_excess(q));
        Some(if excess > 0.0 {
            format!("J{} is outside its limits by {:.1} deg", farthest + 1, excess.to_degrees())
        } else {
            format!("the rod (q3 - q2) is outside its limits by {:.1} deg", rod.to_degrees())
        })
    }

    /// The joint angles of a target, and what is wrong with them.
    fn solved(
        &self,
        target: &RobTarget,
        frames: &Frames,
    ) -> Result<([f64; 6], Option<String>), String> {
        let told = |error: &Error| match error_name(error) {
            Some(name) => format!("{name}: {error}"),
            None => error.to_string(),
        };
        let pose = frames.flange(&target_pose(target).map_err(|error| told(&error))?);
        let missed = match self.flange.ik_configured(&pose, target.robconf) {
            Ok(solution) => return Ok((solution.q, None)),
            Err(error) => error,
        };
        let problem = told(&missed);
        let (Error::NoConfiguration(_), Fallback::Nearest(first)) = (missed, self.fallback) else {
            return Err(problem);
        };
        let before = self.rows.iter().rev().find_map(|row| row.q).unwrap_or(first);
        let nearest =
            self.flange.ik_nearest(&pose, &before, &[1.0; 6]).map_err(|error| told(&error))?;
        Ok((nearest.q, Some(format!("{problem}; the nearest to the joints before is taken"))))
    }

    fn seen(&self, q: &[f64; 6]) -> (Configuration, Option<SingularDistances>) {
        let configuration = self.robot.configuration(q).unwrap_or_default();
        (configuration, self.robot.singular_distances(q))
    }
}
