//! A move with everything in meters, radians and seconds, and what is wrong with it as it is
//! written.

use alloc::string::String;
use alloc::vec::Vec;

use super::finding::{Finding, FindingKind};
use crate::kinematics::{Pose, Robot};
use crate::paths::Zone;
use crate::rapid::calc::axes::{absent_axis, joint_vector};
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::problem::Problem;
use crate::rapid::calc::table::{frames_of, outside};
use crate::rapid::calc::target::target_pose;
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::records::RobTarget;
use crate::rapid::data::settings::CirPathMode;
use crate::rapid::data::skipped::Skipped;
use crate::report::Configuration;

/// The destination of a move.
#[derive(Clone, Copy)]
pub(in crate::rapid) enum Place {
    /// The tool in the work object.
    Tool(Pose, Configuration),
    Joints([f64; 6]),
}

/// A move.
pub(in crate::rapid) struct Goal<'m> {
    pub(in crate::rapid) step: &'m Move,
    /// Where it is known, with its tool and its work object.
    pub(in crate::rapid) place: Option<Place>,
    pub(in crate::rapid) frames: Frames,
    /// The point on the circle.
    pub(in crate::rapid) via: Option<Pose>,
    /// The corner at its end; none if the target is met.
    pub(in crate::rapid) zone: Option<Zone>,
    /// Whether the robot stops at its end.
    pub(in crate::rapid) stops: bool,
    /// Speed of the tool [m/s] and of its reorientation [rad/s]; infinite where they are unknown.
    pub(in crate::rapid) speed: [f64; 2],
    /// The duration of `\T` [s].
    pub(in crate::rapid) time: Option<f64>,
    /// Whether something before it, which is not read, may have moved the robot.
    pub(in crate::rapid) from_unknown: bool,
}

impl Goal<'_> {
    /// Whether the tool goes on a line or an arc.
    pub(in crate::rapid) fn is_cartesian(&self) -> bool {
        matches!(self.step.kind, MoveKind::MoveL | MoveKind::MoveC)
    }
}

/// Collects findings.
pub(in crate::rapid) struct Findings {
    pub(in crate::rapid) all: Vec<Finding>,
}

impl Findings {
    pub(in crate::rapid) fn add(&mut self, move_index: usize, step: &Move, kind: FindingKind) {
        let (line, column, what) = (step.line, step.column, words(step));
        self.all.push(Finding { move_index, line, column, what, kind });
    }

    /// Something that is not read, before a move.
    pub(in crate::rapid) fn not_read(
        &mut self,
        move_index: usize,
        skipped: &Skipped,
        kind: FindingKind,
    ) {
        let Skipped { line, column, text, .. } = skipped;
        let (line, column, what) = (*line, *column, text.clone());
        self.all.push(Finding { move_index, line, column, what, kind });
    }
}

/// `MoveL p10`.
fn words(step: &Move) -> String {
    alloc::format!("{} {}", step.kind.name(), step.target.text)
}

impl<'m> Goal<'m> {
    /// A move; what is wrong with it is found.
    pub(in crate::rapid) fn new(
        robot: &Robot<6>,
        step: &'m Move,
        move_index: usize,
        findings: &mut Findings,
    ) -> Self {
        let mut found = |kind| findings.add(move_index, step, kind);
        let frames = frames_of(robot, step);
        let mut place = match placed(step, &frames) {
            Ok(place) => Some(place),
            Err(problem) => {
                found(FindingKind::Target(problem));
                None
            }
        };
        if let Some(Place::Joints(q)) = &place {
            if let Some(problem) = outside(robot, q) {
                found(FindingKind::Target(problem));
            }
            if let Err(problem) = &frames {
                found(FindingKind::Target(problem.clone()));
            }
        }
        let via = step.via.as_ref().map(|via| pose_of(step, via));
        let via = match via.transpose() {
            Ok(via) => via,
            Err(problem) => {
                found(FindingKind::Target(problem));
                place = None;
                None
            }
        };
        let mode = step.settings.cir_path_mode;
        let is_read = matches!(
            mode,
            CirPathMode::PathFrame | CirPathMode::ObjectFrame | CirPathMode::CirPointOri
        );
        if step.kind == MoveKind::MoveC && !is_read {
            found(FindingKind::WristMode(mode));
        }
        let (speed, time) = (speed_of(step, &mut found), time_of(step, &mut found));
        let (zone, stops) = zone_of(step, &mut found);
        // The speed of the tool of joint angles counts at the flange if the tool is unknown.
        let flange =
            Frames::Carried { t_flange_tool: Pose::identity(), t_world_wobj: Pose::identity() };
        let frames = frames.unwrap_or(flange);
        Self { step, place, frames, via, zone, stops, speed, time, from_unknown: false }
    }
}

/// The destination of a move.
fn placed(step: &Move, frames: &Result<Frames, Problem>) -> Result<Place, Problem> {
    if let Some(line) = step.displaced {
        return Err(Problem::Displaced { line });
    }
    match &step.target.value {
        Err(reason) => Err(Problem::Target(reason.clone())),
        Ok(Target::JointTarget(joints)) => match absent_axis::<6>(joints) {
            Some((axis, degrees)) => Err(Problem::AbsentAxis { axis, degrees }),
            None => Ok(Place::Joints(joint_vector(joints))),
        },
        Ok(Target::RobTarget(target)) => {
            frames.as_ref().map_err(Problem::clone)?;
            let pose = target_pose(target).map_err(Problem::NotSolved)?;
            Ok(Place::Tool(pose, target.robconf))
        }
    }
}

/// The point on a circle.
fn pose_of(step: &Move, via: &Argument<RobTarget>) -> Result<Pose, Problem> {
    match (&via.value, step.displaced) {
        // The target reports it.
        (_, Some(line)) => Err(Problem::Displaced { line }),
        (Ok(via), None) => target_pose(via).map_err(Problem::NotSolved),
        (Err(reason), None) => Err(Problem::Target(reason.clone())),
    }
}

/// The corner at the end of a move, and whether the robot stops there.
fn zone_of(step: &Move, found: &mut impl FnMut(FindingKind)) -> (Option<Zone>, bool) {
    let zone = match &step.zone_data {
        Ok(zone) => zone,
        Err(reason) => {
            found(FindingKind::Zone { text: step.zone.clone(), reason: reason.clone() });
            return (None, true);
        }
    };
    let numbers = [
        ("pzone_tcp", zone.pzone_tcp_mm),
        ("pzone_ori", zone.pzone_ori_mm),
        ("zone_ori", zone.zone_ori_deg),
    ];
    if let Some((field, value)) = numbers.into_iter().find(|(_, value)| *value < 0.0) {
        found(FindingKind::Number { field, value });
        return (None, true);
    }
    let corner = Zone::of_zonedata([zone.pzone_tcp_mm, zone.pzone_ori_mm], zone.zone_ori_deg);
    ((!zone.finep && corner.position > 0.0).then_some(corner), zone.finep)
}

/// The speed of a move.
fn speed_of(step: &Move, found: &mut impl FnMut(FindingKind)) -> [f64; 2] {
    match &step.speed_data {
        Ok(speed) => {
            let numbers = [
                ("v_tcp", speed.v_tcp_mm_s, 1e-3),
                ("v_ori", speed.v_ori_deg_s, 1_f64.to_radians()),
            ];
            numbers.map(|(field, value, unit)| {
                if value > 0.0 {
                    return value * unit;
                }
                found(FindingKind::Number { field, value });
                f64::INFINITY
            })
        }
        // \T replaces it.
        Err(_) if matches!(step.time, Some(Ok(_))) => [f64::INFINITY; 2],
        Err(reason) => {
            found(FindingKind::Speed { text: step.speed.clone(), reason: reason.clone() });
            [f64::INFINITY; 2]
        }
    }
}

/// The duration of `\T`.
fn time_of(step: &Move, found: &mut impl FnMut(FindingKind)) -> Option<f64> {
    match step.time.as_ref()? {
        Ok(time) if *time > 0.0 => Some(*time),
        Ok(time) => {
            found(FindingKind::Number { field: "\\T", value: *time });
            None
        }
        Err(reason) => {
            found(FindingKind::Time(reason.clone()));
            None
        }
    }
}
