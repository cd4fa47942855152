//! A plan that is a path of `follow`: of seven joints where it passes a singularity of the six that a
//! plan is searched with, and of five.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;

use super::answer::{Plan, PlanError, StrandReason};
use super::certificate::HALF;
use super::options::PlanOptions;
use super::tested::Tests;
use crate::arm::Arm;
use crate::error::Error;
use crate::plan::thresholds::{CONTINUOUS_STEP, PLAN_END_OFF};
use irbkin::follow::{BreakReason, Follower};
use irbkin::internal::thresholds::{EXAMINED_STEP, LIMIT_TOLERANCE};
use irbkin::internal::{MOST_SLOTS, largest, steps};
use irbkin::{Interrupt, Pose, Slot};

/// Angles of joint 7 at the first pose from whose solutions a path is followed.
const ANGLES: usize = 8;

/// How often a step is halved: a jump does not shrink.
const HALVINGS: u32 = 10;

impl Arm<7> {
    /// The plan along the first path of `follow` that meets the options, from `start` or from
    /// solutions of the first pose. `None` if no path does, and where more is free than the
    /// redundancy.
    pub(super) fn followed_plan(
        &self,
        path: &[Pose],
        options: &PlanOptions<7>,
        tests: &mut Tests<'_, '_, 7>,
        interrupt: Interrupt<'_>,
    ) -> Result<Option<Plan<7>>, PlanError<7>> {
        let is_tool_free = options.rotation.is_some() || options.cone.is_some();
        if is_tool_free || !options.external.is_empty() {
            return Ok(None);
        }
        for start in self.starts(&path[0], options)? {
            let Strand { q, end: None } =
                self.followed(path, &start, &options.weights, interrupt)?
            else {
                continue;
            };
            let plan = self.plan_along(&q, options);
            if self.meets_options(&q, &plan, options)
                && self.is_continuous(path, &q, &options.weights)?
                && tests.postures(&q).ok_or(PlanError::Stopped)?.into_iter().all(|passed| passed)
                && tests.motions(&q).into_iter().all(|passed| passed)
            {
                return Ok(Some(plan));
            }
        }
        Ok(None)
    }

    /// Joint vectors from which paths are followed.
    fn starts(&self, first: &Pose, options: &PlanOptions<7>) -> Result<Vec<[f64; 7]>, Error> {
        if let Some(start) = options.start {
            return Ok(vec![start]);
        }
        let [low, high] = self.limits().to_array()[6].map(|limit| limit.clamp(-PI, PI));
        let mut starts = Vec::with_capacity(ANGLES * MOST_SLOTS);
        for angle in 0..ANGLES {
            #[expect(clippy::cast_precision_loss, reason = "a small count")]
            let part = (angle as f64 + 0.5) / ANGLES as f64;
            let solutions = self.ik(first, low + part * (high - low))?;
            let inside = solutions.iter().filter(|solution| solution.is_within_limits());
            starts.extend(inside.map(|solution| solution.q));
        }
        Ok(starts)
    }
}

/// The joint vectors of the poses of a path from the first one on, and why there are no more.
pub(super) struct Strand<const N: usize> {
    pub(super) q: Vec<[f64; N]>,
    pub(super) end: Option<StrandReason>,
}

impl<const N: usize> Arm<N> {
    /// Follow a path from a start, as far as it goes without a jump.
    pub(super) fn followed(
        &self,
        path: &[Pose],
        start: &[f64; N],
        weights: &[f64; N],
        interrupt: Interrupt<'_>,
    ) -> Result<Strand<N>, PlanError<N>> {
        let mut follower = Follower::new(self, start, weights)?;
        let mut q = Vec::with_capacity(path.len());
        for (index, pose) in path.iter().enumerate() {
            if interrupt.ends(index) {
                return Err(PlanError::Stopped);
            }
            match follower.step(pose)? {
                (Some(next), None) => q.push(next.q),
                (_, Some(BreakReason::Unreachable(explanation))) => {
                    let end = Some(StrandReason::Unreachable(explanation));
                    return Ok(Strand { q, end });
                }
                _ => return Ok(Strand { q, end: Some(StrandReason::Ended) }),
            }
        }
        Ok(Strand { q, end: None })
    }

    /// Whether the arm goes from each pose to the next one without a jump.
    pub(super) fn is_continuous(
        &self,
        path: &[Pose],
        q: &[[f64; N]],
        weights: &[f64; N],
    ) -> Result<bool, Error> {
        for (poses, ends) in path.windows(2).zip(q.windows(2)) {
            if !self.is_step([poses[0], poses[1]], [ends[0], ends[1]], weights, HALVINGS)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a step is continuous: half way, the curve next to the mean of its ends has joints
    /// between both; or else its halves are (docs/theory/plan.md, eq. 8).
    fn is_step(
        &self,
        poses: [Pose; 2],
        ends: [[f64; N]; 2],
        weights: &[f64; N],
        halvings: u32,
    ) -> Result<bool, Error> {
        let whole = largest(&steps(&ends[0], &ends[1]));
        let mean = core::array::from_fn(|joint| 0.5 * (ends[0][joint] + ends[1][joint]));
        let pose = poses[0].lerp_slerp(&poses[1], 0.5);
        let (Some(middle), _) = Follower::new(self, &mean, weights)?.step(&pose)? else {
            return Ok(false);
        };
        let middle = middle.q;
        let farther = ends.iter().map(|end| largest(&steps(end, &middle))).fold(0.0, f64::max);
        if farther <= (HALF * whole).max(CONTINUOUS_STEP) && whole <= EXAMINED_STEP {
            return Ok(true);
        }
        let halves = [[(poses[0], ends[0]), (pose, middle)], [(pose, middle), (poses[1], ends[1])]];
        for [(from, q), (to, next)] in halves {
            if halvings == 0 || !self.is_step([from, to], [q, next], weights, halvings - 1)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    pub(super) fn plan_along(&self, q: &[[f64; N]], options: &PlanOptions<N>) -> Plan<N> {
        let velocity = self.max_velocity().copied().unwrap_or([1.0; N]);
        let times = options.times_of(q.len());
        let (mut cost, mut bottleneck) = (0.0, 0.0_f64);
        for (ends, times) in q.windows(2).zip(times.windows(2)) {
            for (joint, step) in steps(&ends[0], &ends[1]).into_iter().enumerate() {
                cost += options.weights[joint] * step * step;
                let most = velocity[joint] * (times[1] - times[0]);
                bottleneck = bottleneck.max(step.abs() / most);
            }
        }
        Plan {
            q: q.iter().copied().map(Some).collect(),
            tool_angle: vec![0.0; q.len()],
            external: vec![Vec::new(); q.len()],
            tolerance: vec![Vec::new(); q.len()],
            slot: q.iter().map(|q| self.slot_of(q).map(Slot::index)).collect(),
            cost,
            bottleneck,
            breaks: Vec::new(),
            certified: true,
        }
    }

    /// Whether ends and speeds are as they are asked for.
    pub(super) fn meets_options(
        &self,
        q: &[[f64; N]],
        plan: &Plan<N>,
        options: &PlanOptions<N>,
    ) -> bool {
        let is_slow = options.times.is_none()
            || self.max_velocity().is_none()
            || plan.bottleneck <= 1.0 + LIMIT_TOLERANCE;
        let end = if options.closed { Some(q[0]) } else { options.end };
        let is_at = |wanted: Option<[f64; N]>, q: &[f64; N]| {
            wanted.is_none_or(|wanted| largest(&steps(&wanted, q)) <= PLAN_END_OFF)
        };
        is_slow && is_at(options.start, &q[0]) && is_at(end, &q[q.len() - 1])
    }
}
