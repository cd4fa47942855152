//! A move with everything in meters, radians and seconds, and what is wrong with it as it is
//! written.

use alloc::rc::Rc;

use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::{is_old_form, of_old_form};
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::table::{frames_of, target_of};
use crate::rapid::calc::target::{absent_axis, joint_vector, request, target_pose, with_flange};
use crate::rapid::calc::units::Units;
use crate::rapid::calc::wrong::{OrFinding, absent, displaced, not_solved, outside};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::records::RobTarget;
use crate::rapid::data::settings::CirPathMode;
use crate::rapid::program::walker::Stepped;
use irbkin::{Configuration, ConfigurationRequest, Pose, Robot};
use irbkin_motion::paths::Zone;

/// Whether a target must be met with its own configuration.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::rapid) enum Conf {
    /// It must; where no solution has it, that is a finding and the nearest one is taken.
    On,
    /// The nearest one is taken.
    Off,
    /// As `On`, without a finding.
    Quiet,
}

/// The destination of a move.
#[derive(Clone, Copy)]
pub(in crate::rapid) enum Place<const N: usize> {
    /// The tool in the work object.
    Tool(Pose, ConfigurationRequest<N>),
    Joints([f64; N]),
}

pub(in crate::rapid) struct Goal<'m, const N: usize> {
    pub(in crate::rapid) step: &'m Move,
    /// Where it is made, and what is known of that.
    pub(in crate::rapid) stepped: &'m Stepped<'m>,
    /// Where it is known, with its tool and its work object.
    pub(in crate::rapid) place: Option<Place<N>>,
    pub(in crate::rapid) frames: Rc<Frames>,
    pub(in crate::rapid) via: Option<Box<Pose>>,
    /// The corner at its end; none if the target is met.
    pub(in crate::rapid) zone: Option<Zone>,
    pub(in crate::rapid) stops: bool,
    /// Speed of the tool [m/s] and of its reorientation [rad/s]; infinite where they are unknown.
    pub(in crate::rapid) speed: [f64; 2],
    /// The duration of `\T` [s].
    pub(in crate::rapid) time: Option<f64>,
    /// Whether a unit moves the robot or the work object on the way.
    pub(in crate::rapid) is_carried: bool,
    /// Whether something before it, which is not read, may have moved the robot.
    pub(in crate::rapid) from_unknown: bool,
}

impl<'m, const N: usize> Goal<'m, N> {
    /// Whether the tool goes on a line or an arc.
    pub(in crate::rapid) fn is_cartesian(&self) -> bool {
        matches!(self.step.kind, MoveKind::MoveL | MoveKind::MoveC)
    }

    /// The arm angle at its end [rad], of an arm that has one.
    pub(in crate::rapid) fn arm_angle(&self) -> Option<f64> {
        match self.place {
            Some(Place::Tool(_, wanted)) => wanted.arm_angle,
            _ => None,
        }
    }

    /// How its target is met by a joint move.
    pub(in crate::rapid) fn conf(&self) -> Conf {
        let settings = self.step.settings;
        let on = if self.is_cartesian() { settings.conf_l } else { settings.conf_j };
        if on { Conf::On } else { Conf::Off }
    }

    /// A move; report what is wrong with it.
    pub(in crate::rapid) fn new(
        robot: &Robot<N>,
        stepped: &'m Stepped<'m>,
        units: Option<&Units>,
        move_index: usize,
        findings: &mut Vec<Finding>,
    ) -> Self {
        let step = &*stepped.step;
        let mut found = |finding: Finding| findings.push(finding.at(step, move_index));
        let frames = frames_of(robot, step, units);
        let mut place = placed(robot, step, &frames).map_err(|finding| found(*finding)).ok();
        if let (Some(Place::Tool(pose, wanted)), Ok(frames)) = (&mut place, &frames)
            && is_old_form::<N>(wanted.configuration.cfx)
        {
            let now = with_flange(robot)
                .ok()
                .and_then(|flange| of_old_form(&flange, &frames.flange(pose), wanted));
            found(old_confdata(wanted.configuration.cfx, now));
            match now {
                Some(now) => wanted.configuration = now,
                None => place = None,
            }
        }
        if let Some(Place::Joints(q)) = &place {
            outside(robot, q).into_iter().for_each(&mut found);
            if let Err(finding) = &frames
                && finding.code != Code::UnknownUnit
            {
                found(Finding::clone(finding));
            }
        }
        let via = step.via.as_ref().map(|via| pose_of(step, via));
        let via = match via.transpose() {
            Ok(via) => via,
            Err(finding) => {
                found(*finding);
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
            let mode = mode.name();
            let words = format!("CirPathMode \\{mode} is not followed, \\PathFrame is taken");
            found(Finding::new(Code::NotFollowed, words));
        }
        let (speed, time) = (speed_of(step, &mut found), time_of(step, &mut found));
        let (zone, stops) = zone_of(step, &mut found);
        // The speed of the tool of joint angles counts at the flange if the tool is unknown.
        let frames = Rc::new(frames.unwrap_or_default());
        Self {
            step,
            stepped,
            place,
            frames,
            via: via.map(Box::new),
            zone,
            stops,
            speed,
            time,
            is_carried: false,
            from_unknown: false,
        }
    }
}

/// A target whose cfx has an old form, and its confdata in the new one, if that is known.
fn old_confdata(cfx: i32, now: Option<Configuration>) -> Finding {
    let words = match now {
        Some(now) => format!(
            "cfx {cfx} is an old form of {}, now its confdata is {now}: controllers with the new \
             one refuse it (event 50488)",
            now.cfx,
        ),
        None => format!("cfx {cfx} has an old form that is not known: teach the target again"),
    };
    Finding::new(Code::OldConfdata, words)
}

fn placed<const N: usize>(
    robot: &Robot<N>,
    step: &Move,
    frames: &OrFinding<Frames>,
) -> OrFinding<Place<N>> {
    if let Some(line) = step.displaced {
        return Err(displaced(line).into());
    }
    match target_of(&step.target)? {
        Target::JointTarget(joints) => match absent_axis::<N>(joints) {
            Some((axis, degrees)) => Err(absent(axis, degrees).into()),
            None => Ok(Place::Joints(joint_vector(joints))),
        },
        Target::RobTarget(target) => {
            frames.as_ref().map_err(Clone::clone)?;
            let pose = target_pose(target).map_err(|error| not_solved(&error))?;
            let unknown = |error: Error| Finding::new(Code::UnknownValue, error.to_string());
            let wanted = request(robot, target).map_err(unknown)?;
            Ok(Place::Tool(pose, wanted))
        }
    }
}

fn pose_of(step: &Move, via: &Argument<RobTarget>) -> OrFinding<Pose> {
    if let Some(line) = step.displaced {
        return Err(displaced(line).into());
    }
    target_pose(target_of(via)?).map_err(|error| not_solved(&error).into())
}

/// The corner at the end of a move, and whether the robot stops there.
fn zone_of(step: &Move, found: &mut impl FnMut(Finding)) -> (Option<Zone>, bool) {
    let zone = match &step.zone.value {
        Ok(zone) => zone,
        Err(reason) => {
            let words = format!("zone {}: {reason}; the target is met", step.zone.text);
            found(Finding::unknown(Code::UnknownZone, reason, words));
            return (None, true);
        }
    };
    let numbers = [
        ("pzone_tcp", zone.pzone_tcp_mm),
        ("pzone_ori", zone.pzone_ori_mm),
        ("zone_ori", zone.zone_ori_deg),
    ];
    if let Some((field, value)) = numbers.into_iter().find(|(_, value)| *value < 0.0) {
        found(left_out(field, value, "not negative"));
        return (None, true);
    }
    let corner = Zone::of_zonedata([zone.pzone_tcp_mm, zone.pzone_ori_mm], zone.zone_ori_deg);
    ((!zone.finep && corner.position > 0.0).then_some(corner), zone.finep)
}

/// A number that no move can have, with RAPID's name of its field.
fn left_out(field: &str, value: f64, wanted: &str) -> Finding {
    let words = format!("{field} is {value}, it must be finite and {wanted}; it is left out");
    Finding::new(Code::InvalidNumber, words)
}

fn speed_of(step: &Move, found: &mut impl FnMut(Finding)) -> [f64; 2] {
    match &step.speed.value {
        Ok(speed) => {
            let numbers = [
                ("v_tcp", speed.v_tcp_mm_s, 1e-3),
                ("v_ori", speed.v_ori_deg_s, 1_f64.to_radians()),
            ];
            numbers.map(|(field, value, unit)| {
                if value > 0.0 {
                    return value * unit;
                }
                found(left_out(field, value, "positive"));
                f64::INFINITY
            })
        }
        // \T replaces it.
        Err(_) if matches!(step.time.as_deref(), Some(Ok(_))) => [f64::INFINITY; 2],
        Err(reason) => {
            let text = &step.speed.text;
            let words = format!("speed {text}: {reason}; the limits of the joints alone count");
            found(Finding::unknown(Code::UnknownSpeed, reason, words));
            [f64::INFINITY; 2]
        }
    }
}

fn time_of(step: &Move, found: &mut impl FnMut(Finding)) -> Option<f64> {
    match step.time.as_deref()? {
        Ok(time) if *time > 0.0 => return Some(*time),
        Ok(time) => found(left_out("\\T", *time, "positive")),
        Err(reason) => {
            let words = format!("\\T: {reason}; the speed counts");
            found(Finding::unknown(Code::UnknownSpeed, reason, words));
        }
    }
    None
}
