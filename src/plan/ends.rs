//! The joint angles that a caller gives for an end of the path.

use core::f64::consts::TAU;

use super::freedom::Values;
use super::layer::{Own, Waypoint};
use super::nodes::Arm;
use super::options::PlanOptions;
use super::stations::Stations;
use crate::error::{Error, PlanFault};
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, MOST_FREE_AXES, PLAN_END_OFF};
use crate::kinematics::{Pose, PoseDifference, check_seed, nearest_turn};
use crate::lanes::nearest_whole;

/// Joint angles at an end of the path, as a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given {
    pub(super) q: [f64; 6],
    pub(super) slot: usize,
    /// The nearest node of the grid, and what is free there.
    pub(super) own: Own,
}

impl Given {
    /// The joint angles that are given for the ends of a path.
    pub(super) fn both(
        arm: &Arm<'_>,
        points: &[Waypoint],
        options: &PlanOptions,
    ) -> Result<[Option<Self>; 2], Error> {
        let given = |field, q: &Option<[f64; 6]>, external: &[f64], point: &Waypoint| {
            q.as_ref().map(|q| Self::new(arm, field, (q, external), &point.pose)).transpose()
        };
        Ok([
            given("start", &options.start, &options.start_external, &points[0])?,
            given("end", &options.end, &options.end_external, &points[points.len() - 1])?,
        ])
    }

    /// Check joint angles, and the values of the external axes, against the pose of an end.
    fn new(
        arm: &Arm<'_>,
        field: &'static str,
        (q, external): (&[f64; 6], &[f64]),
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
        if external.len() != arm.freedom.external {
            let (found, wanted) = (external.len(), arm.freedom.external);
            return Err(PlanFault::EndExternal { field, found, wanted }.into());
        }
        let mut values = Values::default();
        values[..external.len()].copy_from_slice(external);
        let tool = arm.robot.fk(q);
        let (angle, values) = arm.freedom.found(pose, &tool, values);
        let turned = arm.freedom.tool(pose, &values, angle);
        let PoseDifference { position, rotation } = PoseDifference::between(&turned, &tool);
        if position.max(rotation) > PLAN_END_OFF {
            let bound = PLAN_END_OFF;
            return Err(PlanFault::EndOff { field, position, rotation, bound }.into());
        }
        let station = station(arm, field, &values)?;
        let (bin, angle) = Self::bin(arm, field, angle)?;
        let slot = match arm.robot.slot_of(q) {
            Some(slot) => slot.index(),
            None => arm.ordinal(q)?,
        };
        Ok(Self { q: *q, slot, own: Own { station, bin, angle, values } })
    }

    /// The bin nearest to a tool angle, and the angle next to that of the bin.
    fn bin(arm: &Arm<'_>, field: &'static str, angle: f64) -> Result<(usize, f64), Error> {
        let Some(rotation) = arm.freedom.rotation else { return Ok((0, angle)) };
        let [lower, upper] = rotation.range();
        let middle = 0.5 * (lower + upper);
        let angle = nearest_turn(angle, middle);
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
}

/// The station nearest to values of the free axes.
fn station(arm: &Arm<'_>, field: &'static str, values: &Values) -> Result<usize, Error> {
    let mut numbers = [0; MOST_FREE_AXES];
    for (index, axis) in arm.freedom.axes.iter().enumerate() {
        let [lower, upper] = axis.range;
        let value = values[index];
        // NaN is in no range.
        let is_inside = value >= lower - PLAN_END_OFF && value <= upper + PLAN_END_OFF;
        if !is_inside {
            let bounds = [lower, upper];
            return Err(PlanFault::EndValue { field, index, value, bounds }.into());
        }
        let number = nearest_whole((value - lower) / axis.step()).max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of values"
        )]
        let number = number as usize;
        numbers[index] = number.min(axis.steps - 1);
    }
    if !arm.freedom.allows(values) {
        let rotation = arm.freedom.tilt(values) - arm.freedom.cone;
        let (position, bound) = (0.0, PLAN_END_OFF);
        return Err(PlanFault::EndOff { field, position, rotation, bound }.into());
    }
    Ok(Stations::of(&arm.freedom.axes).station(numbers))
}
