//! Which of the solutions of a pose have a configuration, where more than one may: GoFa, YuMi.

use alloc::vec::Vec;

use super::rule::Quarters;
use crate::kinematics::answer::select::{Cost, Turns};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS};
use crate::report::{Configuration, ConfigurationRule};

/// How far a joint may be on the other side of an edge and still have the configuration exactly
/// [rad]: more than the rounding of a solution, where two of them meet too.
pub(super) const EDGE_ROUNDING: f64 = 1e-6;

/// How far beyond the limits a joint vector may be, tried in this order [rad].
pub(super) const BEYOND: [f64; 2] = [0.0, TAUGHT_BEYOND_LIMITS];

/// The joint vectors that have a configuration, at any 2 pi equivalent of the solutions of a pose.
pub(super) struct Having<'a, const N: usize, S> {
    robot: &'a Robot<N>,
    rule: &'a ConfigurationRule,
    solutions: S,
    wanted: Configuration,
    /// The limits, and the ranges of the configuration.
    limits: JointLimits<N>,
}

impl<const N: usize> Robot<N> {
    /// Return the ones of `solutions` that have a configuration, at most `beyond` the limits [rad];
    /// `None` if none has it.
    pub(super) fn having<'a, S: Iterator<Item = Solution<N>> + Clone>(
        &'a self,
        rule: &'a ConfigurationRule,
        solutions: &S,
        wanted: Configuration,
        beyond: f64,
    ) -> Option<Having<'a, N, S>> {
        let ranges = Quarters::of(rule).ranges(wanted, CONFIGURATION_EDGE);
        let limits = self.limits().widened(beyond).narrowed(&ranges)?;
        let solutions = solutions.clone();
        let having = Having { robot: self, rule, solutions, wanted, limits };
        let is_any = having.members().next().is_some();
        is_any.then_some(having)
    }

    /// Whether a joint vector has the branch that a configuration names; a quantity within `edge`
    /// of zero has either sign.
    pub(super) fn has_sides(
        &self,
        rule: &ConfigurationRule,
        q: &[f64; N],
        wanted: Configuration,
        edge: f64,
    ) -> bool {
        let bits = [4, 2, 1].map(|bit| wanted.cfx & bit != 0);
        let mut sides = self.sides(rule, q).into_iter().zip(bits);
        sides.all(|(side, is_set)| side.abs() <= edge || (side < 0.0) == is_set)
    }
}

impl<const N: usize, S: Iterator<Item = Solution<N>> + Clone> Having<'_, N, S> {
    /// Return the 2 pi equivalents that can be counted. An axis 5 at -180 deg is one at +180 deg
    /// with another branch.
    fn members(&self) -> impl Iterator<Item = Solution<N>> {
        self.solutions
            .clone()
            .flat_map(|solution| Turns::of(&self.limits, &solution))
            .filter(|turn| self.is_on_branch(turn))
            .map(|turn| self.flagged(turn))
    }

    fn is_on_branch(&self, solution: &Solution<N>) -> bool {
        self.robot.has_sides(self.rule, &solution.q, self.wanted, CONFIGURATION_EDGE)
    }

    /// The first of [`Self::all`]; joints without limits are at the turn nearest to the seed.
    pub(super) fn nearest(&self, seed: &[f64; N]) -> Option<Solution<N>> {
        let at_turn = |solution: Solution<N>| {
            let q = self.limits.wrapped_near(&solution.q, seed)?;
            Some(self.flagged(Solution { q, ..solution }))
        };
        let near =
            self.solutions.clone().filter_map(at_turn).filter(|near| self.is_on_branch(near));
        near.chain(self.members()).min_by(|a, b| self.order(a, b, seed))
    }

    /// All of them: first those that have the configuration exactly, then those within an edge of
    /// it; of either, the nearest to a seed [rad] first.
    pub(super) fn all(&self, seed: &[f64; N]) -> Vec<Solution<N>> {
        let mut all: Vec<Solution<N>> = self.members().collect();
        all.sort_by(|a, b| self.order(a, b, seed));
        all
    }

    fn order(&self, a: &Solution<N>, b: &Solution<N>, seed: &[f64; N]) -> core::cmp::Ordering {
        let total = |solution: &Solution<N>| Cost::Distance.total(&solution.q, seed, &[1.0; N]);
        let by_edge = self.is_exact(&b.q).cmp(&self.is_exact(&a.q));
        by_edge.then_with(|| total(a).total_cmp(&total(b)))
    }

    /// Whether a joint vector has the configuration, not only within an edge.
    fn is_exact(&self, q: &[f64; N]) -> bool {
        let ranges = Quarters::of(self.rule).ranges(self.wanted, EDGE_ROUNDING);
        ranges.iter().all(|(joint, [from, to])| (*from..=*to).contains(&q[*joint]))
            && self.robot.has_sides(self.rule, q, self.wanted, EDGE_ROUNDING)
    }

    /// The solution with the flag of the robot's own limits.
    fn flagged(&self, mut solution: Solution<N>) -> Solution<N> {
        solution.status.set(Status::WITHIN_LIMITS, self.robot.limits().contains(&solution.q));
        solution
    }
}
