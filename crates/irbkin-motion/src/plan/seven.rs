//! `Arm::plan` of seven joints: six of them are planned, and the last one is an external axis that
//! turns the tool, or the first one is one that turns the arm (docs/theory/plan.md, eq. 1); or one
//! is locked.

use core::f64::consts::TAU;

use super::answer::{NoPlan, Plan, PlanError, StrandEnd, StrandReason};
use super::axes::{Carried, ExternalAxis};
use super::graph::Values;
use super::options::{Accept, Caller, PlanOptions, Test};
use super::robot::planned;
use super::tested::{OfSix, Tests};
use crate::arm::Arm;
use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::MOST_EXTERNAL;
use crate::prelude::*;
use crate::trajectory::Retiming;
use irbkin::internal::{JointFault, at_limit, check_weights};
use irbkin::{Interrupt, Pose, Robot, Slot};

impl Arm<7> {
    /// The best joint path along a path of poses, as [`Arm::<6>::plan`]: the better of the plan
    /// with joint 7 as one more external axis, and of the one with joint 1; or a joint of
    /// [`Robot::locked`] stays at its angle. Where neither leads through, since the other six joints
    /// are singular on the way, the plan is a path of [`Robot::follow`]. `limit_cost` and
    /// `singularity_cost` are costs of these six.
    ///
    /// # Errors
    ///
    /// As [`Arm::<6>::plan`].
    pub fn plan(&self, path: &[Pose], options: &PlanOptions<7>) -> Result<Plan<7>, PlanError<7>> {
        self.planned(path, options, None, Interrupt::none())
    }

    /// [`Self::plan`] through joint vectors that `accept` accepts, as [`Arm::<6>::plan_accepted`].
    ///
    /// # Errors
    ///
    /// As [`Arm::<6>::plan_accepted`].
    pub fn plan_accepted(
        &self,
        path: &[Pose],
        options: &PlanOptions<7>,
        accept: &mut Accept<'_, 7>,
    ) -> Result<Plan<7>, PlanError<7>> {
        self.planned(path, options, Some(accept), Interrupt::none())
    }

    /// [`Self::plan`], for a caller that may be asked.
    #[doc(hidden)]
    pub fn planned(
        &self,
        path: &[Pose],
        options: &PlanOptions<7>,
        accept: Option<&mut Accept<'_, 7>>,
        interrupt: Interrupt<'_>,
    ) -> Result<Plan<7>, PlanError<7>> {
        self.check_structure()?;
        let mut tests = Tests::new(self, options, accept)?;
        let robot = &self.before(&options.external)?;
        if robot.locked_joint().is_some() {
            return Seven { robot, locked: robot, is_free: false }
                .planned(path, options, &mut tests, interrupt);
        }
        let mut by = |joint| {
            let locked = &robot.locked(joint, 0.0)?;
            Seven { robot, locked, is_free: true }.planned(path, options, &mut tests, interrupt)
        };
        match (by(7), by(1)) {
            (Ok(one), Ok(other)) => {
                let is_better = self.cost(&other, options)? < self.cost(&one, options)?;
                Ok(if is_better { other } else { one })
            }
            (Err(PlanError::NoPlan(one)), Err(PlanError::NoPlan(other))) => {
                let farther = if other.pose_index > one.pose_index { other } else { one };
                let followed = self.followed_plan(path, options, &mut tests, interrupt)?;
                followed.ok_or(PlanError::NoPlan(farther))
            }
            (Err(PlanError::NoPlan(_)), other) => other,
            (one, _) => one,
        }
    }

    /// The costs of a plan, in the order in which they count: of a timed one, its duration first.
    fn cost(&self, plan: &Plan<7>, options: &PlanOptions<7>) -> Result<(f64, f64), Error> {
        let Some(max_acceleration) = &options.max_acceleration else {
            return Ok(options.order.cost(plan.bottleneck, plan.cost));
        };
        let joints = self.max_velocity().copied().unwrap_or([1.0; 7]);
        let axes = options.external.iter().map(ExternalAxis::max_velocity);
        let max_velocity: Vec<f64> = joints.into_iter().chain(axes).collect();
        let rows = plan.q.iter().zip(&plan.external);
        let rows = rows.flat_map(|(q, own)| q.iter().flatten().chain(own).copied());
        let timed = Retiming::within(&max_velocity, max_acceleration);
        Ok((timed.along(&rows.collect::<Vec<_>>())?.duration(), plan.cost))
    }
}

/// Seven joints, and the six of them that are planned.
struct Seven<'a> {
    robot: &'a Robot<7>,
    /// The robot with the joint locked that is not one of the six.
    locked: &'a Robot<7>,
    /// Whether that joint is the first external axis.
    is_free: bool,
}

impl Seven<'_> {
    fn planned(
        &self,
        path: &[Pose],
        options: &PlanOptions<7>,
        tests: &mut Tests<'_, '_, 7>,
        interrupt: Interrupt<'_>,
    ) -> Result<Plan<7>, PlanError<7>> {
        let six = self.locked.six_joints()?.ok_or(JointFault::NoJoint { joint: 7, dof: 7 });
        let six = six.map_err(Error::from)?;
        let options = self.options(options)?;
        let is_any = tests.is_any();
        let all = |q: &[f64; 6], values: &Values| self.all(q, values);
        let mut tests = OfSix { tests, all };
        let tests = is_any.then_some(&mut tests as &mut dyn Test);
        let planned = planned(&six, path, &options, &mut Caller { tests, interrupt });
        planned.map(|plan| self.plan(plan)).map_err(|error| match error {
            PlanError::Invalid(error) => PlanError::Invalid(error),
            PlanError::Stopped => PlanError::Stopped,
            PlanError::NoPlan(gap) => {
                let NoPlan { pose_index, end_index, ends, plan } = *gap;
                let ends = ends.into_iter().map(|end| self.end(end)).collect();
                let plan = self.plan(plan);
                PlanError::NoPlan(Box::new(NoPlan { pose_index, end_index, ends, plan }))
            }
        })
    }

    /// The index of the joint that is not one of the six.
    fn joint(&self) -> usize {
        self.locked.locked_index()
    }

    fn options(&self, options: &PlanOptions<7>) -> Result<PlanOptions, Error> {
        check_weights(&options.weights)?;
        let mut external = Vec::new();
        if self.is_free {
            external.extend(self.axis(options)?);
        }
        let most = MOST_EXTERNAL - external.len();
        if options.external.len() > most {
            return Err(PlanFault::External { found: options.external.len(), most }.into());
        }
        external.extend(&options.external);
        let end = |field, q: Option<[f64; 7]>, own: &[f64]| {
            let Some(mut q) = q else { return Ok((None, own.to_vec())) };
            q[self.joint()] = self.check_end(field, &q)?;
            let free = &q[self.joint()..][..usize::from(self.is_free)];
            Ok::<_, Error>((Some(self.locked.others(&q)), [free, own].concat()))
        };
        let (start, start_external) = end("start", options.start, &options.start_external)?;
        let (end, end_external) = end("end", options.end, &options.end_external)?;
        let PlanOptions { rotation, cone, closed, order, .. } = *options;
        let PlanOptions { limit_cost, singularity_cost, redundancy, .. } = *options;
        Ok(PlanOptions {
            redundancy,
            rotation,
            external,
            cone,
            times: options.times.clone(),
            start,
            end,
            start_external,
            end_external,
            closed,
            weights: self.locked.others(&options.weights),
            order,
            limit_cost,
            singularity_cost,
            max_acceleration: self.accelerations(options.max_acceleration.as_deref()),
            // Its tests are of all seven joints.
            cell: None,
        })
    }

    /// The joint as an axis that turns the arm, or the tool.
    fn axis(&self, options: &PlanOptions<7>) -> Result<Option<ExternalAxis>, Error> {
        let Some((direction, point)) = self.locked.locked_axis() else { return Ok(None) };
        let (robot, joint) = (self.locked, self.joint());
        let carried = if joint == 0 { Carried::Arm } else { Carried::Tool };
        let [low, high] = robot.limits().to_array()[joint];
        let range = [low.max(-TAU), high.min(TAU)];
        let velocity = robot.max_velocity().map_or(1.0, |velocity| velocity[joint]);
        ExternalAxis::joint(carried(direction, point), range, options.redundancy)?
            .with_max_velocity(velocity)?
            .with_weight(options.weights[joint])
            .map(Some)
    }

    /// The joint that is not one of the six at an end of the path, checked.
    fn check_end(&self, field: &'static str, q: &[f64; 7]) -> Result<f64, Error> {
        let joint = self.joint();
        let bounds = match self.locked.locked_joint() {
            Some((_, angle)) if !self.is_free => [angle; 2],
            _ => self.locked.limits().to_array()[joint],
        };
        let value = q[joint];
        let outside = PlanFault::EndOutside { field, joint: joint + 1, value, bounds };
        Ok(at_limit(value, bounds).ok_or(outside)?)
    }

    /// The accelerations of the six joints, then of the external axes.
    fn accelerations(&self, all: Option<&[f64]>) -> Option<Vec<f64>> {
        let mut own = all?.to_vec();
        if own.len() > 6 {
            let joint = own.remove(self.joint());
            if self.is_free {
                own.insert(6, joint);
            }
        }
        Some(own)
    }

    /// The joint vector of six joints and the values of the external axes.
    fn all(&self, six: &[f64; 6], external: &[f64]) -> [f64; 7] {
        let mut q = self.locked.with_others(six);
        if self.is_free {
            q[self.joint()] = external[0];
        }
        q
    }

    fn plan(&self, plan: Plan) -> Plan<7> {
        let Plan { tool_angle, mut external, tolerance, mut slot, .. } = plan;
        let Plan { cost, bottleneck, breaks, certified, .. } = plan;
        let rows = plan.q.iter().zip(&external);
        let q: Vec<_> = rows.map(|(q, own)| q.map(|q| self.all(&q, own))).collect();
        if self.is_free {
            external.iter_mut().filter(|own| !own.is_empty()).for_each(|own| _ = own.remove(0));
        }
        for (slot, q) in slot.iter_mut().zip(&q) {
            *slot = q.and_then(|q| self.robot.slot_of(&q)).map(Slot::index).or(*slot);
        }
        Plan { q, tool_angle, external, tolerance, slot, cost, bottleneck, breaks, certified }
    }

    /// The end of a branch, with the numbers of the seven joints.
    fn end(&self, mut end: StrandEnd) -> StrandEnd {
        let number = |joint: usize| joint + usize::from(joint > self.joint());
        match &mut end.reason {
            StrandReason::Limit { joint, .. }
            | StrandReason::Speed { joint, .. }
            | StrandReason::Jump { joint, .. } => *joint = number(*joint),
            StrandReason::AxisSpeed { axis: 1, ratio } if self.is_free => {
                end.reason = StrandReason::Speed { joint: self.joint() + 1, ratio: *ratio };
            }
            StrandReason::AxisSpeed { axis, .. } => *axis -= usize::from(self.is_free),
            _ => {}
        }
        end
    }
}
