//! All moves of a module, checked.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::code::Code;
use super::confdata::Finder;
use super::diagnostic::Diagnostic;
use super::fixes::{Demand, correct};
use super::inherited::with_inherited;
use super::runs::{Run, runs};
use super::zones::Zones;
use crate::error::{Error, RapidFault, RapidFaultKind};
use crate::kinematics::thresholds::CONFIGURATION_EDGE;
use crate::kinematics::{Pose, Robot};
use crate::rapid::calc::problem::Problem;
use crate::rapid::calc::target::with_flange;
use crate::rapid::data::module::Module;
use crate::rapid::data::reason::{Reason, Unresolved};
use crate::rapid::motion::finding::{Finding, FindingKind};
use crate::rapid::motion::goal::Place;
use crate::rapid::motion::joints::Conf;
use crate::rapid::motion::options::MotionOptions;
use crate::rapid::motion::routine::{Followed, check as check_options, velocities};
use crate::rapid::text::place::excerpt;
use crate::report::{Configuration, ConfigurationRule};

/// Axes of a configuration, from 0, and their names in it.
const AXES: [(usize, &str); 3] = [(0, "cf1"), (3, "cf4"), (5, "cf6")];

/// Check every move of a module, of all routines, as `motion` does; branches and loops are checked
/// from where the robot is before them. Diagnostics are in the order of the text.
///
/// `source` is the text that `module` was read from. Without velocities, neither of the robot nor
/// in the options, no joint is too fast. The start and the accelerations of the options do not
/// count.
///
/// # Errors
///
/// [`Error::InvalidModel`] for an arm without configurations; [`Error::InvalidMotion`] for limits
/// or steps that are not positive, or for too many samples; [`Error::Rapid`] if `source` is not the
/// text of `module`.
pub fn check(
    robot: &Robot<6>,
    module: &Module,
    source: &str,
    options: &MotionOptions,
) -> Result<Vec<Diagnostic>, Error> {
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
        ends: Vec::new(),
        found: Vec::new(),
        demands: Vec::new(),
    };
    for run in runs(module) {
        checker.add(&run)?;
    }
    let Checker { mut found, demands, .. } = checker;
    correct(&Finder::new(source, module), &demands, &mut found);
    found.sort_by_key(|diagnostic| (diagnostic.line, diagnostic.column, diagnostic.code));
    Ok(found)
}

struct Checker<'a, 'm> {
    /// The robot, and the same with the flange as its tool.
    robots: [&'a Robot<6>; 2],
    options: MotionOptions,
    max_velocity: [f64; 6],
    /// The joints at the targets of the moves of each run.
    ends: Vec<Vec<Option<[f64; 6]>>>,
    found: Vec<Diagnostic>,
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
        for finding in &findings.all {
            let code = Code::of(&finding.kind);
            let q = made.get(finding.move_index).and_then(|made| made.q);
            if matches!(code, Code::WrongConfdata | Code::OtherConfiguration) && q.is_some() {
                wrong[finding.move_index] = Some(self.found.len());
            }
            let message = words(finding, q.and_then(|q| self.robots[1].configuration(&q).ok()));
            self.push(run, (code, finding.line, finding.column), message, unknown(&finding.kind));
        }
        let zones = Zones { flange: self.robots[1], goals, made };
        for (index, goal) in goals.iter().enumerate() {
            let place = (goal.step.line, goal.step.column);
            if let Some(message) = zones.checked(index) {
                self.push(run, (Code::ZoneTooLarge, place.0, place.1), message, None);
            }
            let (Some(Place::Tool(pose, from)), Some(q)) = (goal.place, made[index].q) else {
                continue;
            };
            if goal.conf() == Conf::Off {
                continue;
            }
            let pose = goal.frames.flange(&pose);
            let named = if goal.is_cartesian() { None } else { self.ambiguous(&pose, from, &q) };
            let edges = on_edges(&q).map(|message| (Code::ConfdataEdge, message));
            let named = named.map(|message| (Code::AmbiguousConfdata, message));
            for (code, message) in named.into_iter().chain(edges) {
                self.push(run, (code, place.0, place.1), message, None);
            }
            let (step, diagnostic) = (goal.step, wrong[index]);
            let to = self.robots[1].configuration(&q)?;
            self.demands.push(Demand { step, from, to, diagnostic });
        }
        self.ends.push(made.iter().map(|made| made.q).collect());
        Ok(())
    }

    fn push(
        &mut self,
        run: &Run<'_>,
        (code, line, column): (Code, usize, usize),
        message: String,
        unknown: Option<String>,
    ) {
        let routine = run.routine.map(String::from);
        let edits = Vec::new();
        self.found.push(Diagnostic { code, line, column, routine, message, unknown, edits });
    }

    /// Why the confdata of a target, to which a joint move brings the joints `q`, is ambiguous. A
    /// line or an arc arrives with the joints that it comes with.
    fn ambiguous(&self, flange: &Pose, confdata: Configuration, q: &[f64; 6]) -> Option<String> {
        let robot = self.robots[1];
        if robot.configuration_rule().ok()? != ConfigurationRule::SphericalWrist {
            let named = robot.ik_configured_all(flange, confdata).map_or(0, |all| all.len());
            return (named > 1).then(|| {
                format!("{named} joint vectors have the confdata {confdata} there; use MoveAbsJ")
            });
        }
        let wrist = robot.singular_distances(q).map_or(1.0, |at| at.wrist);
        (wrist < CONFIGURATION_EDGE).then(|| {
            format!(
                "the target is {:.4} deg from the wrist singularity: axes 4 and 6 coincide, many \
                 joint angles have its confdata; use MoveAbsJ",
                wrist.to_degrees()
            )
        })
    }
}

/// The axes of joints that are on the edge of a quarter, in sentences.
fn on_edges(q: &[f64; 6]) -> impl Iterator<Item = String> {
    AXES.into_iter().filter_map(|(axis, name)| {
        let degrees = q[axis].to_degrees();
        let edge = (degrees / 90.0).round();
        let is_near = (degrees - 90.0 * edge).abs() < CONFIGURATION_EDGE.to_degrees();
        is_near.then(|| {
            format!(
                "axis {} is {:.4} deg, on the edge of a quarter: {name} {} and {edge:.0} both \
                 name it",
                axis + 1,
                degrees + 0.0,
                edge - 1.0,
            )
        })
    })
}

/// What is wrong, in one line. `nearest` is the configuration of the joints that the move arrives
/// with.
fn words(finding: &Finding, nearest: Option<Configuration>) -> String {
    let (what, kind) = (excerpt(&finding.what), &finding.kind);
    if let Some(name) = unknown(kind) {
        return format!("{what}: {name} is not declared");
    }
    match (kind, nearest) {
        (FindingKind::Target(Problem::Nearest(Error::NoConfiguration(missed))), Some(nearest)) => {
            format!(
                "{what}: no solution has its confdata {}; that of the nearest is {nearest}",
                missed.wanted
            )
        }
        (FindingKind::Target(Problem::Nearest(error)), Some(nearest)) => {
            format!("{what}: {error}; that of the nearest is {nearest}")
        }
        _ => format!("{what}: {kind}"),
    }
}

/// The name that nothing declares.
fn unknown(kind: &FindingKind) -> Option<String> {
    let (FindingKind::Target(
        Problem::Target(reason) | Problem::Tool { reason, .. } | Problem::WorkObject { reason, .. },
    )
    | FindingKind::Speed { reason, .. }
    | FindingKind::Zone { reason, .. }
    | FindingKind::Time(reason)) = kind
    else {
        return None;
    };
    match reason {
        Reason::Reference { name, why: Unresolved::NotDeclared } => Some(name.clone()),
        _ => None,
    }
}
