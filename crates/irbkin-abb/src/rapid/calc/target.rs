//! `CalcJointT` and `CalcRobT`: joint angles of targets and back.
//!
//! The joints of an arm are RAPID's axes: six of them and, of seven-axis arms, an external one. A
//! `YuMi`'s axes are 1, 2, 7, 3, 4, 5, 6 from the base to the flange. `eax_a` of its jointtarget is
//! axis 7, `eax_a` of its robtarget the arm angle. Of other arms it is a track or a positioner.

use super::frames::{Frames, pose_in, rapid_pose};
use super::units::{EXTERNAL_AXES, MOST_DEGREES, Units};
use crate::Error;
use crate::rapid::data::moves::Target;
use crate::rapid::data::records::{JointTarget, RapidPose, RobTarget, ToolData, WobjData};
use crate::rapid::expression::names::ToolIn;
use crate::rapid::text::fault::FrameFault;
use irbkin::internal::JointFault;
use irbkin::report::ConfigurationRule;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{ConfigurationRequest, Error as RobotError, Pose, Robot};

/// The treatment of a target whose configuration no solution has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fallback<const N: usize = 6> {
    /// It has no joint angles.
    None,
    /// It has no joint angles. If a configuration names more than one solution, it gets the one
    /// nearest to the previous joint angles; these [rad] are before the first target.
    Near([f64; N]),
    /// It gets the solution nearest to the previous joint angles (for the first target, to these
    /// [rad]), and the problem reports so.
    Nearest([f64; N]),
}

/// Joint angles of a robtarget, as by RAPID's `CalcJointT`: inside the limits, with the target's
/// configuration.
///
/// A tool replaces the robot's own, which is the default. A work object is in the world frame that
/// [`Robot::with_base`] defines. External axes are copied unchanged, except `eax_a` of a `YuMi`.
///
/// # Errors
///
/// As [`Robot::ik_configured`]; [`error_name`](crate::rapid::error_name) gives RAPID's names.
/// [`Error::Frame`] for a tool and a work object that cannot be combined or are not poses.
pub fn calc_joint_t<const N: usize>(
    robot: &Robot<N>,
    target: &RobTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
) -> Result<JointTarget, Error> {
    calc_joint_t_or(robot, target, tool, wobj, Fallback::None)
}

/// [`calc_joint_t`], with a fallback for a configuration that names no solution, or more than one.
///
/// # Errors
///
/// As [`calc_joint_t`].
pub fn calc_joint_t_or<const N: usize>(
    robot: &Robot<N>,
    target: &RobTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    fallback: Fallback<N>,
) -> Result<JointTarget, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let pose = frames.flange(&target_pose(target)?);
    let request = request(robot, target)?;
    let request = match fallback {
        Fallback::None => request,
        Fallback::Near(seed) => request.near(seed),
        Fallback::Nearest(seed) => request.or_nearest(seed),
    };
    let q = with_flange(robot)?.ik_configured(&pose, request)?.q;
    Ok(joint_target(&q, target.extax))
}

/// The robtarget of joint angles, with its configuration, as by RAPID's `CalcRobT`. Limits are not
/// checked.
///
/// # Errors
///
/// As [`Robot::configuration`], and [`Error::Frame`] as [`calc_joint_t`].
pub fn calc_rob_t<const N: usize>(
    robot: &Robot<N>,
    joints: &JointTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
) -> Result<RobTarget, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let q = joint_vector(joints);
    let robconf = robot.configuration(&q)?;
    let mut extax = joints.extax;
    if let ConfigurationRule::ArmAngle { .. } = robot.configuration_rule()? {
        extax[0] = robot.arm_angle(&q)?.unwrap_or(0.0).to_degrees();
    }
    let RapidPose { trans_mm, rot } = rapid_pose(&frames.tool(&with_flange(robot)?.fk(&q)));
    Ok(RobTarget { trans_mm, rot, robconf, extax })
}

/// The robot as a program calculates with it: a target in a tool and a work object as it is in
/// others or, without these, as joints. Units of external axes may carry the robot.
pub(in crate::rapid) fn converter<const N: usize>(
    robot: &Robot<N>,
    units: &Units,
) -> impl Fn(&Target, &ToolIn, Option<&ToolIn>) -> Result<Target, Error> {
    |target, at, to| {
        let (Target::RobTarget(RobTarget { extax, .. })
        | Target::JointTarget(JointTarget { extax, .. })) = target;
        let carried = || match units.unknown(extax).filter(|_| N < 7) {
            Some(external) => {
                Err(Error::from(FrameFault::Carried { unit: EXTERNAL_AXES[external].into() }))
            }
            None => Ok(robot.clone().with_base(&(units.carried(extax)? * robot.base()))?),
        };
        let frames = |(tool, wobj): &ToolIn| Frames::new(robot, Some(tool), Some(wobj));
        match (target, to) {
            (Target::JointTarget(_), None) => Ok(target.clone()),
            (Target::RobTarget(_), Some(to)) if to == at => Ok(target.clone()),
            (Target::JointTarget(joints), Some((tool, wobj))) => {
                calc_rob_t(&carried()?, joints, Some(tool), Some(wobj)).map(Target::RobTarget)
            }
            (Target::RobTarget(target), None) => {
                calc_joint_t(&carried()?, target, Some(&at.0), Some(&at.1)).map(Target::JointTarget)
            }
            (Target::RobTarget(target), Some(to)) => {
                let flange = frames(at)?.flange(&target_pose(target)?);
                let RapidPose { trans_mm, rot } = rapid_pose(&frames(to)?.tool(&flange));
                Ok(Target::RobTarget(RobTarget { trans_mm, rot, ..*target }))
            }
        }
    }
}

/// The robot with the flange as its tool, and with limits that take the rounding of a target's
/// printed digits: controllers hold targets that are up to 0.005 deg beyond a limit.
pub(in crate::rapid) fn with_flange<const N: usize>(
    robot: &Robot<N>,
) -> Result<Robot<N>, RobotError> {
    let limits = robot.limits().widened(CONFIGURATION_EDGE);
    robot.clone().with_limits(limits).with_tool(&Pose::identity())
}

/// The tool in the work object [m].
pub(in crate::rapid) fn target_pose(target: &RobTarget) -> Result<Pose, Error> {
    pose_in(&RapidPose { trans_mm: target.trans_mm, rot: target.rot }, "robtarget")
}

/// The joint angles of a jointtarget [rad], in the order of the arm's joints: of seven, axis 7 is the
/// third. An axis that does not exist has its huge angle.
#[must_use]
pub fn joint_vector<const N: usize>(joints: &JointTarget) -> [f64; N] {
    let [one, two, three, four, five, six] = joints.robax_deg;
    let [seven, ..] = joints.extax;
    let from_base = [one, two, seven, three, four, five, six];
    let six_axes = joints.robax_deg;
    core::array::from_fn(|joint| {
        let axes: &[f64] = if N == 7 { &from_base } else { &six_axes };
        axes.get(joint).map_or(f64::NAN, |angle| angle.to_radians())
    })
}

/// The jointtarget of joint angles [rad], with external axes.
#[doc(hidden)]
pub fn joint_target<const N: usize>(q: &[f64; N], mut extax: [f64; 6]) -> JointTarget {
    let robax_deg = match q.map(f64::to_degrees)[..] {
        [one, two, three, four, five, six] => [one, two, three, four, five, six],
        [one, two, seven, three, four, five, six] => {
            extax[0] = seven;
            [one, two, three, four, five, six]
        }
        _ => [f64::NAN; 6],
    };
    JointTarget { robax_deg, extax }
}

/// The first axis of a jointtarget that does not exist, from 1, and its angle [deg].
pub(in crate::rapid) fn absent_axis<const N: usize>(joints: &JointTarget) -> Option<(usize, f64)> {
    let [seven, ..] = joints.extax;
    let axes = joints.robax_deg.into_iter().chain((N == 7).then_some(seven));
    let mut numbered = (1..).zip(axes);
    numbered.find(|(_, degrees)| degrees.abs() > MOST_DEGREES)
}

/// The request for solutions with the configuration of a target.
pub(in crate::rapid) fn request<const N: usize>(
    robot: &Robot<N>,
    target: &RobTarget,
) -> Result<ConfigurationRequest<N>, Error> {
    let request = ConfigurationRequest::from(target.robconf);
    let ConfigurationRule::ArmAngle { .. } = robot.configuration_rule()? else {
        return Ok(request);
    };
    let [arm_angle, ..] = target.extax;
    if arm_angle.abs() > MOST_DEGREES {
        return Err(JointFault::MissingArmAngle.into());
    }
    Ok(request.at_arm_angle(arm_angle.to_radians()))
}
