//! `Robot::plan`.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use super::answer::{NoPlan, Plan, PlanBreak, PlanError};
use super::caller::{Accept, Caller, Watch};
use super::ends::Given;
use super::freedom::Freedom;
use super::guide::guided;
use super::layer::Waypoint;
use super::nodes::Arm;
use super::options::{PlanOptions, PlanOrder};
use super::planner::Planner;
use super::sieve::may_be_passed;
use super::soft::Soft;
use super::turns::PlannedJoints;
use super::way::Way;
use crate::error::{Error, ModelFault, PlanFault};
use crate::kinematics::thresholds::PLAN_END_OFF;
use crate::kinematics::{Pose, PoseDifference, Robot, checked_pose};

impl Robot<6> {
    /// The best joint path along a path of poses.
    ///
    /// Of all joint paths that are continuous, on whatever branch, with whatever turns and tool
    /// angles, that with the smallest bottleneck: the largest velocity of a joint, relative to its
    /// limit ([`Robot::max_velocity`]; 1 rad/s of each joint if it is unknown). Of those, that with
    /// the smallest weighted sum of squares of joint steps, with what being near limits and
    /// singularities costs; [`PlanOrder`] may be another. Both are exact over the tool angles of
    /// the grid, which is then refined around the best ones. Every step is shown to be continuous
    /// between its two poses.
    ///
    /// # Errors
    ///
    /// [`PlanError::NoPlan`], with the first pose that is not reached, the reason for each branch,
    /// and the plan with the fewest breaks; [`PlanError::Invalid`] for poses that are no rigid
    /// transforms, or half a turn apart, options that do not fit, and an arm of unknown structure.
    pub fn plan(&self, path: &[Pose], options: &PlanOptions) -> Result<Plan, PlanError> {
        self.planned(path, options, &mut Caller { accept: None, watch: Watch::default() })
    }

    /// [`Self::plan`] through joint vectors that `accept` accepts: it is asked for many at a time,
    /// where the best way goes. Joint vectors that differ by full turns are asked for once.
    ///
    /// # Errors
    ///
    /// As [`Self::plan`]; [`PlanError::Stopped`] if `accept` answers nothing, or not for each.
    pub fn plan_accepted(
        &self,
        path: &[Pose],
        options: &PlanOptions,
        accept: &mut Accept<'_>,
    ) -> Result<Plan, PlanError> {
        let caller = &mut Caller { accept: Some(accept), watch: Watch::default() };
        self.planned(path, options, caller)
    }

    /// [`Self::plan`], for a caller that may be asked.
    pub(crate) fn planned(
        &self,
        path: &[Pose],
        options: &PlanOptions,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Plan, PlanError> {
        options.check(path.len())?;
        if let Some(reason) = self.unknown_structure() {
            return Err(Error::from(ModelFault::UnknownStructure(reason)).into());
        }
        let path = checked_path(path, options)?;
        let joints = PlannedJoints::of(self, options.weights);
        let joints = match options.start.or(options.end) {
            Some(q) if q.iter().all(|angle| angle.is_finite()) => joints.around(&q),
            _ => joints,
        };
        let freedom = Freedom::of(options);
        let soft = Soft::of(self, options);
        let arm =
            Arm { robot: self, joints: &joints, freedom: &freedom, soft, watch: caller.watch };
        let points = waypoints(&path, options);
        let ends = Given::both(&arm, &points, options)?;
        let coarser = freedom.coarser();
        let guided = guided(Arm { freedom: &coarser, ..arm }, &points, options, caller)?;
        if let Some((guide, way)) = guided {
            // A way of the whole grid is taken if it is better still.
            let ends = [ends[0], if options.closed { ends[0] } else { ends[1] }];
            let is_best = options.order == PlanOrder::Bottleneck
                && !may_be_passed(arm, &points, &ends, way.bottleneck)?;
            if is_best {
                return Ok(guide.plan_of(&[way])?);
            }
            let mut planner = Planner::new(arm, &points, options, &ends)?;
            planner.expected = Some(way.cost(options.order).0);
            if let Some(other) = planner.way_within(way.bottleneck, caller)? {
                let other = planner.refined(other, caller)?;
                if other.cost(options.order) < way.cost(options.order) {
                    return Ok(planner.plan_of(&[other])?);
                }
            }
            return Ok(guide.plan_of(&[way])?);
        }
        let mut planner = Planner::new(arm, &points, options, &ends)?;
        let mut ways = Vec::new();
        let mut from = 0;
        while from < planner.layers.len() {
            match planner.proven_way(from, caller)? {
                Some(way) => {
                    from = way.reached() + 1;
                    ways.push(way);
                }
                None => from += 1,
            }
        }
        let is_whole = matches!(&ways[..], [way] if way.nodes.len() == planner.layers.len());
        if is_whole {
            let way = planner.refined(ways.swap_remove(0), caller)?;
            return Ok(planner.plan_of(&[way])?);
        }
        let plan = planner.plan_of(&ways)?;
        let end_index = reached_from_the_end(arm, &path, options, caller)?;
        Err(PlanError::NoPlan(Box::new(planner.gap(&ways, plan, end_index)?)))
    }
}

/// The last pose from which no branch reaches the end: where the path ends, gone backward.
fn reached_from_the_end(
    arm: Arm<'_>,
    path: &[Pose],
    options: &PlanOptions,
    caller: &mut Caller<'_, '_>,
) -> Result<usize, PlanError> {
    let backward: Vec<Pose> = path.iter().rev().copied().collect();
    let times = options.times.as_ref().map(|times| times.iter().rev().map(|time| -time).collect());
    let (start, start_external) = if options.closed {
        (options.start, &options.start_external)
    } else {
        (options.end, &options.end_external)
    };
    let options = PlanOptions {
        times,
        start,
        start_external: start_external.clone(),
        end: if options.closed { None } else { options.start },
        end_external: options.start_external.clone(),
        ..options.clone()
    };
    let points = waypoints(&backward, &options);
    let ends = Given::both(&arm, &points, &options)?;
    let mut planner = Planner::new(arm, &points, &options, &ends)?;
    let count = planner.layers.len();
    let reached = planner.proven_way(0, caller)?.map_or(0, |way| way.reached() + 1);
    Ok(path.len() - 1 - planner.index_of(reached.min(count - 1)))
}

/// The poses of a path with their times.
pub(super) fn waypoints(path: &[Pose], options: &PlanOptions) -> Vec<Waypoint> {
    let times = options.times_of(path.len());
    let points = path.iter().zip(times).enumerate();
    points.map(|(index, (pose, time))| Waypoint { index, pose: *pose, time }).collect()
}

/// The poses of a path, checked; of a closed one, the last is the first.
fn checked_path(path: &[Pose], options: &PlanOptions) -> Result<Vec<Pose>, Error> {
    let mut checked = Vec::with_capacity(path.len());
    for (index, pose) in path.iter().enumerate() {
        checked.push(checked_pose(pose).map_err(|error| match error {
            Error::InvalidPose(fault) => PlanFault::Pose { index, fault }.into(),
            other => other,
        })?);
    }
    if options.closed {
        let last = checked.len() - 1;
        let apart = PoseDifference::between(&checked[0], &checked[last]);
        if apart.largest() > PLAN_END_OFF {
            let PoseDifference { position, rotation } = apart;
            return Err(PlanFault::Open { position, rotation, bound: PLAN_END_OFF }.into());
        }
        checked[last] = checked[0];
    }
    Ok(checked)
}

impl Planner<'_> {
    /// The plan of ways, with breaks between them.
    fn plan_of(&self, ways: &[Way]) -> Result<Plan, Error> {
        let count = self.layers.iter().filter(|layer| layer.index.is_some()).count();
        let mut plan = Plan {
            q: vec![None; count],
            tool_angle: vec![0.0; count],
            external: vec![Vec::new(); count],
            tolerance: vec![Vec::new(); count],
            slot: vec![None; count],
            cost: 0.0,
            bottleneck: 0.0,
            breaks: Vec::new(),
            certified: true,
        };
        let freedom = self.arm.freedom;
        let mut leave = None;
        for way in ways {
            let mut angle: Option<f64> = None;
            let mut enter = None;
            for (step, node) in way.nodes.iter().enumerate() {
                let layer = &self.layers[way.from + step];
                let own = layer.tool_angle(&self.grid, node.bin);
                let next = angle.map_or(own, |angle| angle + freedom.angle_step(angle, own));
                angle = Some(next);
                let Some(index) = layer.index else { continue };
                plan.q[index] = Some(way.q[step]);
                plan.tool_angle[index] = next;
                let values = layer.values(&self.grid, node.station);
                let (external, tolerance) = values[..freedom.axes.len()].split_at(freedom.external);
                plan.external[index] = external.to_vec();
                plan.tolerance[index] = tolerance.to_vec();
                plan.slot[index] = Some(if self.arm.has_names() {
                    node.slot
                } else {
                    self.arm.ordinal(&way.q[step])?
                });
                if enter.is_none() {
                    enter = Some(index);
                    if leave.is_some() || index > 0 {
                        plan.breaks.push(PlanBreak { leave, enter });
                    }
                }
                leave = Some(index);
            }
            plan.cost += way.squares;
            plan.bottleneck = plan.bottleneck.max(way.bottleneck);
        }
        if leave.is_none_or(|leave| leave + 1 < count) {
            plan.breaks.push(PlanBreak { leave, enter: None });
        }
        Ok(plan)
    }

    /// Where and why the first way ends.
    fn gap(&self, ways: &[Way], plan: Plan, end_index: usize) -> Result<NoPlan, Error> {
        let Some(way) = ways.first().filter(|way| way.from == 0) else {
            let ends = self.none_at_start()?;
            return Ok(NoPlan { pose_index: 0, end_index, ends, plan });
        };
        let pose_index = self.index_of((way.reached() + 1).min(self.layers.len() - 1));
        Ok(NoPlan { pose_index, end_index, ends: self.strand_ends(way)?, plan })
    }
}
