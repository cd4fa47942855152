//! `Arm::plan` of five axes: a pose has few solutions, so that each is followed along the path.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;

use super::answer::{NoPlan, Plan, PlanBreak, PlanError, StrandEnd, StrandReason};
use super::followed::Strand;
use super::options::{Accept, PlanOptions};
use super::robot::checked_path;
use super::tested::Tests;
use crate::arm::Arm;
use crate::error::Error;
use crate::plan::fault::PlanFault;
use irbkin::{Interrupt, Pose, Slot};

impl Arm<5> {
    /// The best joint path along a path of poses, as [`Arm::<6>::plan`], of an arm of five axes: each
    /// pose is reached within [`Robot::heading_tolerance`](irbkin::Robot::heading_tolerance). Every
    /// solution of the first pose, with its turns, is followed; nothing else may be free.
    ///
    /// # Errors
    ///
    /// As [`Arm::<6>::plan`].
    pub fn plan(&self, path: &[Pose], options: &PlanOptions<5>) -> Result<Plan<5>, PlanError<5>> {
        self.planned(path, options, None, Interrupt::none())
    }

    /// [`Self::plan`], for a caller that may be asked.
    #[doc(hidden)]
    pub fn planned(
        &self,
        path: &[Pose],
        options: &PlanOptions<5>,
        accept: Option<&mut Accept<'_, 5>>,
        interrupt: Interrupt<'_>,
    ) -> Result<Plan<5>, PlanError<5>> {
        options.check(path.len())?;
        check_fixed(options)?;
        self.check_structure()?;
        let path = checked_path(path, options)?;
        let mut search = Search {
            arm: self,
            turning: self.clone().map(|robot| robot.with_heading_tolerance(PI))?,
            options,
            tests: Tests::new(self, options, accept)?,
            interrupt,
        };
        let mut best: Option<Plan<5>> = None;
        let strands = search.strands(&path, options.start)?;
        for strand in strands.iter().filter(|strand| strand.end.is_none()) {
            let plan = self.plan_along(&strand.q, options);
            let order = |plan: &Plan<5>| options.order.cost(plan.bottleneck, plan.cost);
            if best.as_ref().is_none_or(|best| order(&plan) < order(best)) {
                best = Some(plan);
            }
        }
        match best {
            Some(best) => Ok(best),
            None => Err(PlanError::NoPlan(Box::new(search.no_plan(&path, strands)?))),
        }
    }
}

/// Refuse what a plan of five axes does not choose.
fn check_fixed(options: &PlanOptions<5>) -> Result<(), Error> {
    let free = [
        ("rotation", options.rotation.is_some()),
        ("tolerance", options.cone.is_some()),
        ("carrier", !options.external.is_empty()),
        ("max_acceleration", options.max_acceleration.is_some()),
        ("limit_cost", options.limit_cost > 0.0),
        ("singularity_cost", options.singularity_cost > 0.0),
    ];
    match free.into_iter().find(|(_, given)| *given) {
        Some((field, _)) => Err(PlanFault::FiveAxes { field }.into()),
        None => Ok(()),
    }
}

struct Search<'a, 'b> {
    arm: &'a Arm<5>,
    /// The arm for poses on the way, whose headings nothing asks for.
    turning: Arm<5>,
    options: &'a PlanOptions<5>,
    tests: Tests<'a, 'b, 5>,
    interrupt: Interrupt<'a>,
}

impl Search<'_, '_> {
    /// The strands of a path from a joint vector, or from every solution of its first pose with its
    /// turns, each as far as it passes the tests and meets the options.
    fn strands(
        &mut self,
        path: &[Pose],
        start: Option<[f64; 5]>,
    ) -> Result<Vec<Strand<5>>, PlanError<5>> {
        let starts: Vec<_> = match start {
            Some(start) => vec![start],
            None => self.arm.ik(&path[0])?.turns().map(|solution| solution.q).collect(),
        };
        let mut strands = Vec::new();
        for start in starts {
            let mut strand =
                self.arm.followed(path, &start, &self.options.weights, self.interrupt)?;
            self.test(path, &mut strand)?;
            strands.push(strand);
        }
        Ok(strands)
    }

    /// End a strand before its first joint vector that does not pass.
    fn test(&mut self, path: &[Pose], strand: &mut Strand<5>) -> Result<(), PlanError<5>> {
        let q = &strand.q;
        if self.tests.is_any() {
            let postures = self.tests.postures(q).ok_or(PlanError::Stopped)?;
            let motions = self.tests.motions(q);
            let touched = postures.iter().position(|passed| !passed);
            let between = motions.iter().position(|passed| !passed).map(|before| before + 1);
            if let Some(index) = touched.into_iter().chain(between).min() {
                let first = if touched == Some(index) { index } else { index - 1 };
                let reason = self.tests.reason(&q[first..=index]);
                strand.q.truncate(index);
                strand.end = Some(reason);
                return Ok(());
            }
        }
        if strand.end.is_some() || q.is_empty() {
            return Ok(());
        }
        if !self.turning.is_continuous(path, q, &self.options.weights)? {
            strand.end = Some(StrandReason::Ended);
        } else if !self.arm.meets_options(q, &self.arm.plan_along(q, self.options), self.options) {
            strand.end = Some(StrandReason::NotAtEnd);
        }
        Ok(())
    }

    /// The longest strand after the other: the plan with the fewest breaks, and why each ends.
    fn no_plan(
        mut self,
        path: &[Pose],
        mut strands: Vec<Strand<5>>,
    ) -> Result<NoPlan<5>, PlanError<5>> {
        let ends = strands.iter().filter_map(|strand| self.end(strand)).collect();
        let pose_index = strands.iter().map(|strand| strand.q.len()).max().unwrap_or(0);
        let mut plan = self.arm.plan_along(&[], self.options);
        let mut leave = None;
        while plan.q.len() < path.len() {
            let from = plan.q.len();
            if from > 0 {
                strands = self.strands(&path[from..], None)?;
            }
            let longest = strands.drain(..).map(|strand| strand.q).max_by_key(Vec::len);
            let Some(q) = longest.filter(|q| !q.is_empty()) else {
                plan.q.push(None);
                plan.slot.push(None);
                continue;
            };
            if from > 0 {
                plan.breaks.push(PlanBreak { leave, enter: Some(from) });
            }
            leave = Some(from + q.len() - 1);
            let part =
                self.arm.plan_along(&q, &PlanOptions { times: None, ..self.options.clone() });
            plan.q.extend(part.q);
            plan.slot.extend(part.slot);
            plan.cost += part.cost;
            plan.bottleneck = plan.bottleneck.max(part.bottleneck);
        }
        let is_open = leave.is_none_or(|leave| leave + 1 < path.len());
        if is_open {
            plan.breaks.push(PlanBreak { leave, enter: None });
        }
        plan.tool_angle = vec![0.0; path.len()];
        (plan.external, plan.tolerance) =
            (vec![Vec::new(); path.len()], vec![Vec::new(); path.len()]);
        let backward: Vec<Pose> = path.iter().rev().copied().collect();
        let back = self.strands(&backward, self.options.end)?;
        let reached = back.iter().map(|strand| strand.q.len()).max().unwrap_or(0);
        let end_index = path.len() - 1 - reached.min(path.len() - 1);
        Ok(NoPlan { pose_index: pose_index.min(path.len() - 1), end_index, ends, plan })
    }

    fn end(&self, strand: &Strand<5>) -> Option<StrandEnd> {
        let slot = strand.q.first().and_then(|q| self.arm.slot_of(q)).map_or(0, Slot::index);
        Some(StrandEnd { slot, pose_index: strand.q.len(), reason: strand.end.clone()? })
    }
}
