//! `CalcJointT` and `CalcRobT`.

use super::axes::{joint_target, joint_vector, request, with_arm_angle};
use super::fallback::Fallback;
use super::frames::{Frames, pose_in, rapid_pose};
use crate::error::Error;
use crate::kinematics::{Pose, Robot};
use crate::rapid::data::records::{JointTarget, RapidPose, RobTarget, ToolData, WobjData};
use crate::report::Explanation;

/// Joint angles of a robtarget, as by RAPID's `CalcJointT`: those with the target's configuration,
/// inside the limits.
///
/// A tool replaces the robot's own, which is the default. A work object is in the world frame that
/// [`Robot::with_base`] defines. External axes are copied unchanged.
///
/// # Errors
///
/// As [`Robot::ik_configured`]; [`error_name`] gives RAPID's names. [`Error::Frame`] for a tool and
/// a work object that cannot be combined or are not poses.
pub fn calc_joint_t(
    robot: &Robot<6>,
    target: &RobTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
) -> Result<JointTarget, Error> {
    joint_target_of(robot, target, tool, wobj, Fallback::None)
}

/// [`calc_joint_t`] or, if no solution has the target's configuration, the solution nearest to
/// `seed` [rad].
///
/// # Errors
///
/// As [`calc_joint_t`], and never [`Error::NoConfiguration`].
pub fn calc_joint_t_or_nearest(
    robot: &Robot<6>,
    target: &RobTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
    seed: &[f64; 6],
) -> Result<JointTarget, Error> {
    joint_target_of(robot, target, tool, wobj, Fallback::Nearest(*seed))
}

/// [`calc_joint_t`] of an arm of six joints or of a `YuMi`, whose `eax_a` is the arm angle in a
/// robtarget and axis 7 in a jointtarget.
///
/// # Errors
///
/// As [`calc_joint_t`].
pub fn joint_target_of<const N: usize>(
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

/// The robtarget of joint angles, with its configuration, as by RAPID's `CalcRobT`.
///
/// # Errors
///
/// As [`Robot::configuration`], and [`Error::Frame`] as [`calc_joint_t`]. Limits are not checked.
pub fn calc_rob_t(
    robot: &Robot<6>,
    joints: &JointTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
) -> Result<RobTarget, Error> {
    rob_target_of(robot, joints, tool, wobj)
}

/// [`calc_rob_t`] of an arm of six joints or of a `YuMi`, whose `eax_a` is axis 7 in a jointtarget
/// and the arm angle in a robtarget.
///
/// # Errors
///
/// As [`calc_rob_t`].
pub fn rob_target_of<const N: usize>(
    robot: &Robot<N>,
    joints: &JointTarget,
    tool: Option<&ToolData>,
    wobj: Option<&WobjData>,
) -> Result<RobTarget, Error> {
    let frames = Frames::new(robot, tool, wobj)?;
    let q = joint_vector(joints);
    let robconf = robot.configuration(&q)?;
    let extax = with_arm_angle(robot, &q, joints.extax)?;
    let RapidPose { trans_mm, rot } = rapid_pose(&frames.tool(&with_flange(robot)?.fk(&q)));
    Ok(RobTarget { trans_mm, rot, robconf, extax })
}

/// RAPID's name of an error of [`calc_joint_t`]: `ERR_OUTSIDE_REACH` if the arm is too short or too
/// long, `ERR_ROBLIMIT` if solutions exist, but none inside the limits with the requested
/// configuration. `None` for errors that no controller reports.
#[must_use]
pub fn error_name(error: &Error) -> Option<&'static str> {
    match error {
        Error::Unreachable(Explanation::OutOfReach(_) | Explanation::NoRoots { .. }) => {
            Some("ERR_OUTSIDE_REACH")
        }
        Error::Unreachable(_) | Error::NoConfiguration(_) => Some("ERR_ROBLIMIT"),
        _ => None,
    }
}

/// The same robot with the flange as its tool.
pub(in crate::rapid) fn with_flange<const N: usize>(robot: &Robot<N>) -> Result<Robot<N>, Error> {
    robot.clone().with_tool(&Pose::identity())
}

/// The tool in the work object [m].
pub(in crate::rapid) fn target_pose(target: &RobTarget) -> Result<Pose, Error> {
    pose_in(&RapidPose { trans_mm: target.trans_mm, rot: target.rot }, "robtarget")
}
