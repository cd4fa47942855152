//! `Arm::plan` of six joints.

use super::answer::{NoPlan, Plan, PlanBreak, PlanError};
use super::best::JointPath;
use super::ends::EndNode;
use super::freedom::Freedom;
use super::graph::{Values, Waypoint};
use super::joints::{NodeCost, PlannedJoints};
use super::nodes::PlannedArm;
use super::options::{Accept, Caller, PlanOptions, Test};
use super::planner::Planner;
use super::refine::coarse_to_fine;
use super::tested::{OfSix, Tests};
use super::timed::fastest;
use super::work::Work;
use crate::arm::Arm;
use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::{COARSEST_TOOL_STEP, PLAN_END_OFF};
use crate::prelude::*;
use irbkin::internal::checked_pose;
use irbkin::{Interrupt, Pose, PoseDifference, Robot};

impl Arm<6> {
    /// The best joint path along a path of poses.
    ///
    /// Of all continuous joint paths, on any branch, with any turns and tool angles, return the one
    /// with the smallest bottleneck: the largest velocity of a joint, relative to its limit
    /// ([`Robot::max_velocity`]; 1 rad/s of each joint if it is unknown). Of several, the one with
    /// the smallest weighted sum of squares of joint steps and of the costs of limits and
    /// singularities; another [`PlanOrder`](crate::plan::PlanOrder) puts the sum first. Both are
    /// exact over the grid of what is free, which is then refined. A path of 64 poses or more with
    /// free axes is planned along some of its poses first, then in bands around that plan. At last,
    /// what is free is smoothed, which raises the bottleneck by at most 3 %, never above the one
    /// with nothing free, and never the sum if it comes first. Every step is shown to be continuous
    /// between its two poses.
    ///
    /// # Errors
    ///
    /// [`PlanError::NoPlan`], with the first pose that is not reached, the reason for each branch,
    /// and the plan with the fewest breaks; [`PlanError::Invalid`] for poses that are no rigid
    /// transforms, or half a turn apart, options that do not fit, and an arm of unknown structure.
    pub fn plan(&self, path: &[Pose], options: &PlanOptions) -> Result<Plan, PlanError> {
        self.planned(path, options, None, Interrupt::none())
    }

    /// [`Self::plan`] through joint vectors that `accept` accepts: it is asked for many at a time,
    /// along the best joint path. Joint vectors that differ by full turns are asked for once.
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
        self.planned(path, options, Some(accept), Interrupt::none())
    }

    /// [`Self::plan`], for a caller that may be asked.
    #[doc(hidden)]
    pub fn planned(
        &self,
        path: &[Pose],
        options: &PlanOptions,
        accept: Option<&mut Accept<'_>>,
        interrupt: Interrupt<'_>,
    ) -> Result<Plan, PlanError> {
        let mut tests = Tests::new(self, options, accept)?;
        let is_any = tests.is_any();
        let mut tests = OfSix { tests: &mut tests, all: |q: &[f64; 6], _: &Values| *q };
        let tests = is_any.then_some(&mut tests as &mut dyn Test);
        let robot = &self.before(&options.external)?;
        planned(robot, path, options, &mut Caller { tests, interrupt })
    }
}

/// The plan of six joints, for a caller that is asked for free axes, too.
pub(super) fn planned(
    robot: &Robot<6>,
    path: &[Pose],
    options: &PlanOptions,
    caller: &mut Caller<'_>,
) -> Result<Plan, PlanError> {
    options.check(path.len())?;
    robot.check_structure()?;
    let path = checked_path(path, options)?;
    let joints = PlannedJoints::of(robot, options.weights);
    let joints = match options.start.or(options.end) {
        Some(q) if q.iter().copied().all(f64::is_finite) => joints.around(&q),
        _ => joints,
    };
    let [fine, coarse] = freedoms(options);
    let fixed = coarse.clone().with_fixed_tool();
    let node_cost = NodeCost::new(robot, options.limit_cost, options.singularity_cost);
    let interrupt = caller.interrupt;
    let work = Work::default();
    let (joints, work) = (&joints, &work);
    let (freedom, first_slot) = (&fine, None);
    let arm = PlannedArm { robot, joints, freedom, node_cost, interrupt, work, first_slot };
    let points = waypoints(&path, options);
    if let Some(limits) = &options.max_acceleration
        && let Some((planner, path)) =
            fastest(arm, [&coarse, &fixed], &points, (options, limits), caller)?
    {
        return Ok(planner.plan_of(&[path])?);
    }
    let refined = coarse_to_fine(PlannedArm { freedom: &coarse, ..arm }, &points, options, caller)?;
    if let Some((planner, path)) = refined {
        return Ok(planner.plan_of(&[path])?);
    }
    let ends = EndNode::both(&arm, &points, options)?;
    let mut planner = Planner::new(arm, &points, options, &ends)?;
    let mut parts = Vec::new();
    let mut from = 0;
    while from < planner.layers.len() {
        match planner.proven_path(from, caller)? {
            Some(part) => {
                from = part.reached() + 1;
                parts.push(part);
            }
            None => from += 1,
        }
    }
    let is_whole = matches!(&parts[..], [part] if part.nodes.len() == planner.layers.len());
    if is_whole {
        let part = planner.refined(parts.swap_remove(0), caller)?;
        let part = planner.smoothed(part, caller)?;
        return Ok(planner.plan_of(&[part])?);
    }
    let plan = planner.plan_of(&parts)?;
    let end_index = reached_from_the_end(arm, &path, options, caller)?;
    let (pose_index, ends) = match parts.first().filter(|part| part.from == 0) {
        Some(part) => {
            let behind = (part.reached() + 1).min(planner.layers.len() - 1);
            (planner.index_of(behind), planner.branch_ends(part, caller)?)
        }
        None => (0, planner.none_at_start(caller)?),
    };
    Err(PlanError::NoPlan(Box::new(NoPlan { pose_index, end_index, ends, plan })))
}

/// Poses of which the last gap is searched first, and how many times more each next time.
const FEW: usize = 16;

/// The last pose from which no branch reaches the end: where the path ends, gone backward.
fn reached_from_the_end(
    arm: PlannedArm<'_>,
    path: &[Pose],
    options: &PlanOptions,
    caller: &mut Caller<'_>,
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
    let mut count = if options.closed { path.len() } else { FEW.min(path.len()) };
    loop {
        let is_whole = count == path.len();
        let open = PlanOptions { end: options.end.filter(|_| is_whole), ..options.clone() };
        let ends = EndNode::both(&arm, &points[..count], &open)?;
        let mut planner = Planner::new(arm, &points[..count], &open, &ends)?;
        let reached = planner.proven_path(0, caller)?.map_or(0, |path| path.reached() + 1);
        let layers = planner.layers.len();
        if is_whole || reached < layers {
            return Ok(path.len() - 1 - planner.index_of(reached.min(layers - 1)));
        }
        count = path.len().min(FEW * count);
    }
}

/// Everything that is free; with coarse tool angles, too.
pub(super) fn freedoms(options: &PlanOptions) -> [Freedom; 2] {
    let coarse = options.rotation.map(|rotation| rotation.coarser(COARSEST_TOOL_STEP));
    [options.rotation, coarse]
        .map(|rotation| Freedom::new(&options.external, options.cone, rotation))
}

pub(super) fn waypoints(path: &[Pose], options: &PlanOptions) -> Vec<Waypoint> {
    let times = options.times_of(path.len());
    let points = path.iter().zip(times).enumerate();
    points.map(|(index, (pose, time))| Waypoint { index, pose: *pose, time }).collect()
}

/// The poses of a path, checked; of a closed one, the last is the first.
pub(super) fn checked_path<const N: usize>(
    path: &[Pose],
    options: &PlanOptions<N>,
) -> Result<Vec<Pose>, Error> {
    let mut checked = Vec::with_capacity(path.len());
    for (index, pose) in path.iter().enumerate() {
        checked.push(checked_pose(pose).map_err(|error| match error {
            irbkin::Error::InvalidPose(fault) => PlanFault::Pose { index, fault }.into(),
            other => Error::from(other),
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
    /// The plan of joint paths, with breaks between them.
    fn plan_of(&self, parts: &[JointPath]) -> Result<Plan, Error> {
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
        let rotation = freedom.rotation();
        let tool = freedom.external..rotation.unwrap_or(freedom.axes.len());
        let mut leave = None;
        for part in parts {
            let mut angle: Option<f64> = None;
            let mut enter = None;
            let along = self.layers[part.from..].iter().zip(&part.nodes).zip(&part.q);
            for ((layer, node), q) in along {
                let values = layer.values(&self.grid, node.cell);
                if let Some(axis) = rotation {
                    let next = |from| from + freedom.axes[axis].difference(from, values[axis]);
                    angle = Some(angle.map_or(values[axis], next));
                }
                let Some(index) = layer.index else { continue };
                plan.q[index] = Some(*q);
                plan.tool_angle[index] = angle.unwrap_or_default();
                plan.external[index] = values[..freedom.external].to_vec();
                plan.tolerance[index] = values[tool.clone()].to_vec();
                let slot = if self.arm.has_names() { node.slot } else { self.arm.ordinal(q)? };
                plan.slot[index] = Some(slot);
                if enter.is_none() {
                    enter = Some(index);
                    if leave.is_some() || index > 0 {
                        plan.breaks.push(PlanBreak { leave, enter });
                    }
                }
                leave = Some(index);
            }
            plan.cost += part.squares;
            plan.bottleneck = plan.bottleneck.max(part.bottleneck);
        }
        if leave.is_none_or(|leave| leave + 1 < count) {
            plan.breaks.push(PlanBreak { leave, enter: None });
        }
        Ok(plan)
    }
}
