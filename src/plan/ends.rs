//! The joint angles that a caller gives for an end of the path.

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::RealField as _;

use super::nodes::{Arm, largest};
use super::options::ToolAxis;
use crate::error::{Error, PlanFault};
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, PLAN_END_OFF};
use crate::kinematics::{Pose, PoseDifference, check_seed};
use crate::lanes::nearest_whole;

/// Joint angles at an end of the path, as a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given {
    pub(super) q: [f64; 6],
    pub(super) slot: usize,
    /// The nearest bin, and the tool angle [rad].
    pub(super) bin: usize,
    pub(super) angle: f64,
}

impl Given {
    /// Check joint angles against the pose of an end.
    pub(super) fn new(
        arm: &Arm<'_>,
        field: &'static str,
        q: &[f64; 6],
        pose: &Pose,
    ) -> Result<Self, Error> {
        check_seed(field, q)?;
        for (joint, [lower, upper]) in arm.robot.limits().to_array().into_iter().enumerate() {
            let value = q[joint];
            if value < lower - LIMIT_TOLERANCE || value > upper + LIMIT_TOLERANCE {
                let bounds = [lower, upper];
                return Err(PlanFault::EndOutside { field, joint: joint + 1, value, bounds }.into());
            }
        }
        let tool = arm.robot.fk(q);
        let angle = arm.rotation.map_or(0.0, |rotation| angle_about(rotation.axis(), pose, &tool));
        let turned = arm.turned(pose, angle);
        let PoseDifference { position, rotation } = PoseDifference::between(&turned, &tool);
        if position.max(rotation) > PLAN_END_OFF {
            let bound = PLAN_END_OFF;
            return Err(PlanFault::EndOff { field, position, rotation, bound }.into());
        }
        let (bin, angle) = Self::bin(arm, field, angle)?;
        let slot = match arm.robot.slot_of(q) {
            Some(slot) => slot.index(),
            None => Self::nearest_slot(arm, q, &turned)?,
        };
        Ok(Self { q: *q, slot, bin, angle })
    }

    /// The bin nearest to a tool angle, and the angle next to that of the bin.
    fn bin(arm: &Arm<'_>, field: &'static str, angle: f64) -> Result<(usize, f64), Error> {
        let Some(rotation) = arm.rotation else { return Ok((0, angle)) };
        let [lower, upper] = rotation.range();
        let middle = 0.5 * (lower + upper);
        let angle = middle + (angle - middle) - TAU * nearest_whole((angle - middle) / TAU);
        if angle < lower - PLAN_END_OFF || angle > upper + PLAN_END_OFF {
            return Err(PlanFault::EndAngle { field, angle, bounds: [lower, upper] }.into());
        }
        if rotation.steps() == 1 {
            return Ok((0, angle));
        }
        let number = nearest_whole((angle - lower) / rotation.step()).max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of tool angles"
        )]
        let number = number as usize;
        // The upper end of a full turn is its lower one.
        let over = number >= rotation.steps();
        if over && rotation.is_full() {
            return Ok((number - rotation.steps(), angle - TAU));
        }
        Ok((number.min(rotation.steps() - 1), angle))
    }

    /// The slot of the solution nearest to joint angles, of an arm whose slots are ordinals.
    fn nearest_slot(arm: &Arm<'_>, q: &[f64; 6], pose: &Pose) -> Result<usize, Error> {
        let solutions = arm.robot.ik(pose)?;
        let off = |other: &[f64; 6]| {
            largest(&core::array::from_fn(|joint| {
                let step = q[joint] - other[joint];
                step - TAU * nearest_whole(step / TAU)
            }))
        };
        let nearest = solutions.iter().min_by(|a, b| off(&a.q).total_cmp(&off(&b.q)));
        Ok(nearest.map_or(0, |nearest| nearest.slot.index()))
    }
}

/// The angle about an axis of a pose by which another pose is turned from it, as far as it is.
fn angle_about(axis: ToolAxis, from: &Pose, to: &Pose) -> f64 {
    let relative = from.rotation.inverse() * to.rotation;
    let (first, second) = match axis {
        ToolAxis::X => (1, 2),
        ToolAxis::Y => (2, 0),
        ToolAxis::Z => (0, 1),
    };
    let matrix = relative.matrix();
    let sin = matrix[(second, first)] - matrix[(first, second)];
    sin.atan2(matrix[(first, first)] + matrix[(second, second)])
}
