//! Plans for the shortest timed motion: best joint paths of both orders, from each branch, timed
//! (docs/theory/plan.md, section 5).

use super::answer::PlanError;
use super::best::JointPath;
use super::ends::EndNode;
use super::freedom::Freedom;
use super::graph::Waypoint;
use super::nodes::PlannedArm;
use super::options::{Caller, PlanOptions, PlanOrder};
use super::planner::Planner;
use super::refine::{coarse_to_fine, is_long};
use crate::prelude::*;
use crate::trajectory::{Retiming, Trajectory};

/// Of the best joint paths in either order, from each branch of the first pose and with a fixed
/// tool, the one with the shortest timed motion; `None` if no path leads through all poses.
pub(super) fn fastest<'a>(
    arm: PlannedArm<'a>,
    [coarse, fixed]: [&'a Freedom; 2],
    points: &[Waypoint],
    (options, max_acceleration): (&PlanOptions, &[f64]),
    caller: &mut Caller<'_>,
) -> Result<Option<(Planner<'a>, JointPath)>, PlanError> {
    let mut best: Option<(Planner<'a>, JointPath)> = None;
    let mut shortest = f64::INFINITY;
    let mut take = |planner: Planner<'a>, path: JointPath| {
        let duration = planner.retimed(&path, max_acceleration)?.duration();
        if duration < shortest {
            (shortest, best) = (duration, Some((planner, path)));
        }
        Ok::<(), PlanError>(())
    };
    // First any branch: where no path leads through all poses, none is looked for on each.
    let slots = (0..arm.robot.slot_count()).map(Some);
    for first_slot in core::iter::once(None).chain(slots) {
        let arm = PlannedArm { first_slot, ..arm };
        for order in [PlanOrder::Bottleneck, PlanOrder::Sum] {
            let options = PlanOptions { order, ..options.clone() };
            let found = whole(arm, coarse, points, &options, caller)?;
            let Some((planner, path)) = found else {
                if first_slot.is_none() {
                    return Ok(None);
                }
                // Nor is there one in the other order.
                break;
            };
            take(planner, path)?;
        }
    }
    // External axes of a fixed tool are a plan of their own.
    if arm.freedom.external == 0 && !arm.freedom.axes.is_empty() {
        let arm = PlannedArm { freedom: fixed, ..arm };
        let ends = EndNode::both(&arm, points, options)?;
        for order in [PlanOrder::Bottleneck, PlanOrder::Sum] {
            let options = PlanOptions { order, ..options.clone() };
            let mut planner = Planner::new(arm, points, &options, &ends)?;
            if let Some(path) = planner.whole_path(caller)? {
                take(planner, path)?;
            }
        }
    }
    Ok(best)
}

/// The best joint path through all poses; of a long path with free axes, only from coarse to fine.
fn whole<'a>(
    arm: PlannedArm<'a>,
    coarse: &'a Freedom,
    points: &[Waypoint],
    options: &PlanOptions,
    caller: &mut Caller<'_>,
) -> Result<Option<(Planner<'a>, JointPath)>, PlanError> {
    let long = coarse_to_fine(PlannedArm { freedom: coarse, ..arm }, points, options, caller)?;
    if long.is_some() || (is_long(points) && !coarse.axes.is_empty()) {
        return Ok(long);
    }
    let ends = EndNode::both(&arm, points, options)?;
    let mut planner = Planner::new(arm, points, options, &ends)?;
    let Some(path) = planner.whole_path(caller)? else { return Ok(None) };
    let path = planner.refined(path, caller)?;
    let path = planner.smoothed(path, caller)?;
    Ok(Some((planner, path)))
}

impl Planner<'_> {
    /// Limits of the velocities of the joints [rad/s], then of the external axes.
    fn max_velocity(&self) -> Vec<f64> {
        let external = &self.arm.freedom.axes[..self.arm.freedom.external];
        let joints = self.arm.joints.velocity.into_iter();
        joints.chain(external.iter().map(|axis| axis.velocity)).collect()
    }

    /// Joint angles and external axes of each layer.
    fn rows(&self, path: &JointPath) -> Vec<f64> {
        let mut rows = Vec::new();
        for ((layer, node), q) in self.layers.iter().zip(&path.nodes).zip(&path.q) {
            rows.extend(q);
            rows.extend(&layer.values(&self.grid, node.cell)[..self.arm.freedom.external]);
        }
        rows
    }

    /// The fastest motion along a joint path through all layers.
    fn retimed(&self, path: &JointPath, max_acceleration: &[f64]) -> Result<Trajectory, PlanError> {
        let velocity = self.max_velocity();
        let motion = Retiming::within(&velocity, max_acceleration);
        let interrupt = self.arm.interrupt;
        let timed = motion.along_until(&self.rows(path), interrupt);
        if interrupt.is_raised() { Err(PlanError::Stopped) } else { Ok(timed?) }
    }
}
