//! The joint angles that a caller gives for an end of the path.

use core::f64::consts::TAU;

use super::graph::{Own, Values, Waypoint};
use super::nodes::PlannedArm;
use super::options::PlanOptions;
use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::{MOST_FREE_AXES, PLAN_END_OFF};
use irbkin::internal::lanes::nearest_whole;
use irbkin::internal::{at_limit, check_seed, nearest_turn};
use irbkin::{Pose, PoseDifference};

#[derive(Clone, Copy, Debug)]
pub(super) struct EndNode {
    pub(super) q: [f64; 6],
    pub(super) slot: usize,
    /// The nearest node of the grid, and what is free there.
    pub(super) own: Own,
}

impl EndNode {
    /// The joint angles that are given for the ends of a path.
    pub(super) fn both(
        arm: &PlannedArm<'_>,
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
        arm: &PlannedArm<'_>,
        field: &'static str,
        (q, external): (&[f64; 6], &[f64]),
        pose: &Pose,
    ) -> Result<Self, Error> {
        check_seed(field, q)?;
        let mut inside = *q;
        for (joint, bounds) in arm.robot.limits().to_array().into_iter().enumerate() {
            let value = q[joint];
            let outside = PlanFault::EndOutside { field, joint: joint + 1, value, bounds };
            inside[joint] = at_limit(value, bounds).ok_or(outside)?;
        }
        if external.len() != arm.freedom.external {
            let (found, wanted) = (external.len(), arm.freedom.external);
            return Err(PlanFault::EndExternal { field, found, wanted }.into());
        }
        let mut values = Values::default();
        values[..external.len()].copy_from_slice(external);
        let tool = arm.robot.fk(q);
        let mut values = arm.freedom.nearest(pose, &tool, values);
        let met = arm.freedom.tool(pose, &values);
        let PoseDifference { position, rotation } = PoseDifference::between(&met, &tool);
        if position.max(rotation) > PLAN_END_OFF {
            let bound = PLAN_END_OFF;
            return Err(PlanFault::EndOff { field, position, rotation, bound }.into());
        }
        let cell = nearest_cell(arm, field, &mut values)?;
        let slot = match arm.robot.slot_of(&inside) {
            Some(slot) => slot.index(),
            None => arm.ordinal(&inside)?,
        };
        Ok(Self { q: inside, slot, own: Own { cell, values } })
    }
}

/// The cell nearest to values of the free axes; a tool angle becomes the one next to its cell.
fn nearest_cell(
    arm: &PlannedArm<'_>,
    field: &'static str,
    values: &mut Values,
) -> Result<usize, Error> {
    let mut numbers = [0; MOST_FREE_AXES];
    for (index, axis) in arm.freedom.axes.iter().enumerate() {
        let [lower, upper] = axis.range;
        if axis.is_rotation() {
            values[index] = nearest_turn(values[index], 0.5 * (lower + upper));
        }
        let value = values[index];
        // NaN is in no range.
        if !(lower - PLAN_END_OFF..=upper + PLAN_END_OFF).contains(&value) {
            let bounds = [lower, upper];
            return Err(if axis.is_rotation() {
                PlanFault::EndAngle { field, angle: value, bounds }.into()
            } else {
                PlanFault::EndValue { field, index, value, bounds }.into()
            });
        }
        let number = if axis.steps > 1 { (value - lower) / axis.step() } else { 0.0 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of values"
        )]
        let number = nearest_whole(number).max(0.0) as usize;
        numbers[index] = number.min(axis.steps - 1);
        // The upper end of a full turn is its lower one.
        if axis.is_cyclic && number >= axis.steps {
            (numbers[index], values[index]) = (number - axis.steps, value - TAU);
        }
    }
    let rotation = arm.freedom.tilt(values) - arm.freedom.cone;
    if rotation > PLAN_END_OFF {
        let (position, bound) = (0.0, PLAN_END_OFF);
        return Err(PlanFault::EndOff { field, position, rotation, bound }.into());
    }
    Ok(arm.grid().cell(numbers))
}
