//! Which of the solutions of a pose have a configuration, where more than one may: GoFa, YuMi.

use alloc::vec::Vec;

use super::rule::Quarters;
use crate::kinematics::answer::select::{Cost, Turns};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::arity::{Arity, Joints};
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS};
use crate::report::{Configuration, ConfigurationRule};

/// How closely a joint vector must have a configuration, the closest first: within what of an edge
/// it has both sides of it, and how far beyond the limits it may be [rad].
const CLOSENESS: [[f64; 2]; 3] =
    [[0.0, 0.0], [CONFIGURATION_EDGE, 0.0], [CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS]];

/// The joint vectors that have a configuration as closely as any solution of a pose has it.
pub(super) struct Having<'a, const N: usize, S>
where
    Joints<N>: Arity<N>,
{
    robot: &'a Robot<N>,
    rule: &'a ConfigurationRule,
    solutions: S,
    cfx: i32,
    edge: f64,
    limits: JointLimits<N>,
}

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// Those of `solutions` that have a configuration; `None` if none has it.
    pub(super) fn having<'a, S: Iterator<Item = Solution<N>> + Clone>(
        &'a self,
        rule: &'a ConfigurationRule,
        solutions: &S,
        wanted: Configuration,
    ) -> Option<Having<'a, N, S>> {
        CLOSENESS.into_iter().find_map(|[edge, beyond]| {
            let ranges = Quarters::of(rule).ranges(wanted, edge);
            let limits = self.limits().widened(beyond).narrowed(&ranges)?;
            let solutions = solutions.clone();
            let having = Having { robot: self, rule, solutions, cfx: wanted.cfx, edge, limits };
            let is_inside = |found: Solution<N>| limits.wrapped_near(&found.q, &found.q).is_some();
            let is_any = having.members().any(is_inside);
            is_any.then_some(having)
        })
    }
}

impl<const N: usize, S: Iterator<Item = Solution<N>> + Clone> Having<'_, N, S>
where
    Joints<N>: Arity<N>,
{
    /// The solutions with the branch of the configuration, at any 2 pi equivalent.
    fn members(&self) -> impl Iterator<Item = Solution<N>> {
        self.solutions.clone().filter(|solution| {
            has_sides(&self.robot.sides(self.rule, &solution.q), self.cfx, self.edge)
        })
    }

    /// The one nearest to a seed [rad].
    pub(super) fn nearest(&self, seed: &[f64; N]) -> Option<Solution<N>> {
        let total = |solution: &Solution<N>| Cost::Distance.total(&solution.q, seed, &[1.0; N]);
        let at_turn = |solution: Solution<N>| {
            let q = self.limits.wrapped_near(&solution.q, seed)?;
            Some(self.flagged(Solution { q, ..solution }))
        };
        self.members().filter_map(at_turn).min_by(|a, b| total(a).total_cmp(&total(b)))
    }

    /// All of them at every 2 pi equivalent, the nearest to a seed [rad] first.
    pub(super) fn all(&self, seed: &[f64; N]) -> Vec<Solution<N>> {
        let total = |solution: &Solution<N>| Cost::Distance.total(&solution.q, seed, &[1.0; N]);
        let mut all: Vec<Solution<N>> = self
            .members()
            .flat_map(|solution| Turns::of(&self.limits, &solution))
            .map(|solution| self.flagged(solution))
            .collect();
        all.sort_by(|a, b| total(a).total_cmp(&total(b)));
        all
    }

    /// The solution with the flag of the robot's own limits.
    fn flagged(&self, mut solution: Solution<N>) -> Solution<N> {
        solution.status.set(Status::WITHIN_LIMITS, self.robot.limits().contains(&solution.q));
        solution
    }
}

/// Whether the signs of three quantities are the bits of `cfx`; one within `edge` of zero has
/// either.
fn has_sides(sides: &[f64; 3], cfx: i32, edge: f64) -> bool {
    let bits = [4, 2, 1].map(|bit| cfx & bit != 0);
    sides.iter().zip(bits).all(|(side, is_set)| side.abs() <= edge || (*side < 0.0) == is_set)
}
