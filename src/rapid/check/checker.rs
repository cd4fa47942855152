//! All moves of a module, checked.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::fixes::{Demand, Finder, correct};
use super::inherited::with_inherited;
use super::runs::{Run, runs};
use crate::cell::{Cell, Placed};
use crate::error::{Error, RapidFault, RapidFaultKind};
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, LEAST_WAY};
use crate::kinematics::{Pose, Robot};
use crate::paths::ArcOrientation;
use crate::paths::polyline::Leg;
use crate::rapid::calc::target::with_flange;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::Module;
use crate::rapid::expression::names::predefined_names;
use crate::rapid::motion::drive::{Made, MotionOptions};
use crate::rapid::motion::goal::{Goal, Place};
use crate::rapid::motion::joints::Conf;
use crate::rapid::motion::routine::{Followed, check as check_options, velocities};
use crate::report::{Configuration, ConfigurationRule};

/// Axes of a configuration, from 0, and their names in it.
const AXES: [(usize, &str); 3] = [(0, "cf1"), (3, "cf4"), (5, "cf6")];

/// Check every move of a module, of all routines, as `motion` does; branches and loops are checked
/// from where the robot is before them. Findings are in the order of the text.
///
/// `source` is the text that `module` was read from. Without velocities, neither of the robot nor
/// in the options, no joint is too fast. The start and the accelerations of the options do not
/// count. With a cell, each move is proven to touch nothing, each joint moving evenly between two
/// samples, or where it first does is found.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations; [`Error::InvalidMotion`] for limits
/// or steps that are not positive, or for too many samples; [`Error::Rapid`] if `source` is not the
/// text of `module`; [`Error::InvalidBody`] for a robot without a body in a cell.
pub fn check(
    robot: &Robot<6>,
    module: &Module,
    source: &str,
    options: &MotionOptions,
    cell: Option<&Cell>,
) -> Result<Vec<Finding>, Error> {
    robot.configuration_rule()?;
    check_options(options)?;
    if source.len() != module.text_length {
        let (found, wanted) = (source.len(), module.text_length);
        return Err(RapidFault::nowhere(RapidFaultKind::OtherText { found, wanted }).into());
    }
    let max_velocity = velocities(robot, options)?.unwrap_or([f64::INFINITY; 6]);
    let flange = with_flange(robot)?;
    let module = &*with_inherited(module);
    let mut checker = Checker {
        robots: [robot, &flange],
        options: *options,
        max_velocity,
        cell: cell.map(|cell| Ok::<_, Error>((cell, Placed::of(robot)?))).transpose()?,
        ends: Vec::new(),
        found: Vec::new(),
        demands: Vec::new(),
    };
    for run in runs(module) {
        checker.add(&run)?;
    }
    let Checker { mut found, demands, .. } = checker;
    correct(&Finder::new(source, module), &demands, &mut found);
    found.sort_by_key(|finding| (finding.line, finding.column, finding.code));
    Ok(found)
}

struct Checker<'a, 'm> {
    /// The robot, and the same with the flange as its tool.
    robots: [&'a Robot<6>; 2],
    options: MotionOptions,
    max_velocity: [f64; 6],
    cell: Option<(&'a Cell, Placed<'a, 6>)>,
    /// The joints at the targets of the moves of each run.
    ends: Vec<Vec<Option<[f64; 6]>>>,
    found: Vec<Finding>,
    demands: Vec<Demand<'m>>,
}

impl<'m> Checker<'_, 'm> {
    fn add(&mut self, run: &Run<'m>) -> Result<(), Error> {
        let start =
            run.from.and_then(|(run, moves)| *self.ends.get(run)?.get(moves.checked_sub(1)?)?);
        let options = MotionOptions { start, max_acceleration: None, ..self.options };
        let mut followed = Followed::new(self.robots, &run.steps, &options)?;
        followed.check_speeds(&self.max_velocity);
        let Followed { goals, made, findings, .. } = &followed;
        // Where the confdata of a move is wrong.
        let mut wrong: Vec<Option<usize>> = goals.iter().map(|_| None).collect();
        for finding in findings {
            let (index, mut finding) = (finding.move_index, finding.clone());
            if let (Some(goal), Some(made)) = (goals.get(index), made.get(index)) {
                let is_wrong =
                    matches!(finding.code, Code::WrongConfdata | Code::OtherConfiguration);
                if let Some(q) = made.q.filter(|_| is_wrong) {
                    wrong[index] = Some(self.found.len());
                    finding = self.with_nearest(finding, goal, &q);
                }
                if let Some(name) = &finding.unknown {
                    let words = format!("{name} is not declared");
                    finding.message =
                        Finding::new(finding.code, words).at(goal.step, index).message;
                }
            }
            self.found.push(finding);
        }
        for (index, goal) in
            goals.iter().enumerate().filter(|(index, _)| made[*index].as_programmed)
        {
            let finding = self.collision(followed.along(index));
            self.found.extend(finding.map(|finding| finding.at(goal.step, index)));
        }
        let zones = Zones { flange: self.robots[1], goals, made };
        for (index, goal) in goals.iter().enumerate() {
            let mut found = |finding: Finding| self.found.push(finding.at(goal.step, index));
            zones.checked(index).into_iter().for_each(&mut found);
            let (Some(Place::Tool(pose, from)), Some(q)) = (goal.place, made[index].q) else {
                continue;
            };
            if goal.conf() == Conf::Off {
                continue;
            }
            let flange = goal.frames.flange(&pose);
            if !goal.is_cartesian() {
                ambiguous(self.robots[1], &flange, from, &q).into_iter().for_each(&mut found);
            }
            on_edges(&q).for_each(found);
            let to = self.robots[1].configuration(&q)?;
            self.demands.push(Demand { step: goal.step, from, to, finding: wrong[index] });
        }
        self.ends.push(made.iter().map(|made| made.q).collect());
        Ok(())
    }

    /// A move that touches something in the cell.
    fn collision(&mut self, along: &[[f64; 6]]) -> Option<Finding> {
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

    /// A finding on confdata that no solution has, with the configuration of the nearest joints.
    fn with_nearest(&self, finding: Finding, goal: &Goal<'_>, q: &[f64; 6]) -> Finding {
        let flange = self.robots[1];
        let (Code::WrongConfdata, Some(Place::Tool(pose, wanted)), Ok(nearest)) =
            (finding.code, goal.place, flange.configuration(q))
        else {
            return finding;
        };
        let words = match flange.ik_configured(&goal.frames.flange(&pose), wanted) {
            Err(error @ Error::InvalidJoints(_)) => error.to_string(),
            _ => format!("no solution has its confdata {wanted}"),
        };
        let words = format!("{words}; that of the nearest is {nearest}");
        Finding::new(finding.code, words).at(goal.step, finding.move_index)
    }
}

/// An ambiguous target, to which a joint move brings the joints `q`. A line or an arc arrives with
/// the joints that it comes with.
fn ambiguous(
    robot: &Robot<6>,
    flange: &Pose,
    confdata: Configuration,
    q: &[f64; 6],
) -> Option<Finding> {
    let words = if robot.configuration_rule().ok()? == ConfigurationRule::SphericalWrist {
        let wrist = robot.singular_distances(q).map_or(1.0, |at| at.wrist);
        (wrist < CONFIGURATION_EDGE).then(|| {
            format!(
                "the target is {:.4} deg from the wrist singularity: axes 4 and 6 coincide, many \
                 joint angles have its confdata; use MoveAbsJ",
                wrist.to_degrees()
            )
        })
    } else {
        let named = robot.ik_configured_all(flange, confdata).map_or(0, |all| all.len());
        (named > 1).then(|| {
            format!("{named} joint vectors have the confdata {confdata} there; use MoveAbsJ")
        })
    };
    words.map(|words| Finding::new(Code::AmbiguousConfdata, words))
}

/// The axes of joints that are on the edge of a quarter, in sentences.
fn on_edges(q: &[f64; 6]) -> impl Iterator<Item = Finding> {
    AXES.into_iter().filter_map(|(axis, name)| {
        let degrees = q[axis].to_degrees();
        let edge = (degrees / 90.0).round();
        let is_near = (degrees - 90.0 * edge).abs() < CONFIGURATION_EDGE.to_degrees();
        is_near.then(|| {
            let words = format!(
                "axis {} is {:.4} deg, on the edge of a quarter: {name} {} and {edge:.0} both \
                 name it",
                axis + 1,
                degrees + 0.0,
                edge - 1.0,
            );
            Finding::new(Code::ConfdataEdge, words)
        })
    })
}

/// How far a zone may exceed half of a distance [1]: rounding.
const ROUNDING: f64 = 1e-6;

/// Goals that follow one another, and what became of them.
struct Zones<'a, 'm> {
    /// The robot with the flange as its tool.
    flange: &'a Robot<6>,
    goals: &'a [Goal<'m>],
    made: &'a [Made],
}

impl Zones<'_, '_> {
    /// A move with too large a zone.
    fn checked(&self, index: usize) -> Option<Finding> {
        let goal = &self.goals[index];
        let zone = goal.zone?;
        let before = index.checked_sub(1).and_then(|_| self.way(index));
        let after = self.goals.get(index + 1).and_then(|_| self.way(index + 1));
        let sides = [(before, "the target before it"), (after, "the next target")];
        let known = sides.into_iter().filter_map(|(way, side)| way.map(|way| (way, side)));
        let (way, side) = known.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let bound = 0.5 * way;
        if zone.position <= bound * (1.0 + ROUNDING) {
            return None;
        }
        let words = format!(
            "zone {} ({:.1} mm) is over half of the {:.1} mm to {side}: the controller reduces it \
             to {:.1} mm",
            goal.step.zone,
            zone.position * 1e3,
            way * 1e3,
            bound * 1e3
        );
        let finding = Finding::new(Code::ZoneTooLarge, words);
        Some(finding.with_value(zone.position, bound))
    }

    /// The length of the way to a move's target from the one before it [m]; `None` if either is
    /// unknown or the tool only turns.
    fn way(&self, index: usize) -> Option<f64> {
        let goal = &self.goals[index];
        if goal.from_unknown {
            return None;
        }
        let (start, end) = (self.tool(index - 1, goal)?, self.tool(index, goal)?);
        let line = (end.translation.vector - start.translation.vector).norm();
        let arc = goal.via.as_ref().and_then(|via| {
            Leg::arc([&start, via, &end], ArcOrientation::Path).ok().map(|arc| arc.length())
        });
        Some(arc.unwrap_or(line)).filter(|way| *way > LEAST_WAY)
    }

    /// The tool at the target of a move, in the work object of another one.
    fn tool(&self, index: usize, within: &Goal<'_>) -> Option<Pose> {
        let goal = &self.goals[index];
        match goal.place? {
            Place::Tool(pose, _) if goal.frames == within.frames => Some(pose),
            _ => Some(within.frames.tool(&self.flange.fk(&self.made[index].q?))),
        }
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
