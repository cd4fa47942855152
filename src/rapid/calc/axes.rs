//! The joints of an arm as RAPID's axes: six of them and, of seven-axis arms, an external one.
//!
//! A `YuMi`'s axes are 1, 2, 7, 3, 4, 5, 6 from the base to the flange. `eax_a` of its jointtarget
//! is axis 7, `eax_a` of its robtarget the arm angle. Of other arms it is a track or a positioner.

use crate::error::{Error, JointFault};
use crate::kinematics::{ConfigurationRequest, Robot};
use crate::rapid::data::records::{JointTarget, RobTarget};
use crate::report::ConfigurationRule;

/// angle
///
/// above which an axis does not exist [deg]: no joint turns so far, and RAPID writes 9E9.
pub(in crate::rapid) const MOST_DEGREES: f64 = 1e6;

/// The joint angles of a jointtarget [rad].
pub(in crate::rapid) fn joint_vector<const N: usize>(joints: &JointTarget) -> [f64; N] {
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
pub(crate) fn joint_target<const N: usize>(q: &[f64; N], mut extax: [f64; 6]) -> JointTarget {
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

/// What the configuration of a target asks of an arm.
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

/// The external axes of a robtarget, of joint angles [rad] with external axes.
pub(in crate::rapid) fn with_arm_angle<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
    mut extax: [f64; 6],
) -> Result<[f64; 6], Error> {
    if let ConfigurationRule::ArmAngle { .. } = robot.configuration_rule()? {
        extax[0] = robot.arm_angle_of(q)?.unwrap_or(0.0).to_degrees();
    }
    Ok(extax)
}
