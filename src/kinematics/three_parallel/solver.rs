//! An arm between the frames in which poses are given: what a solve needs.

use super::ThreeParallel;
use crate::kinematics::chain::Chain;
use crate::kinematics::surroundings::Surroundings;

/// The geometry, with what stands before and behind it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ParallelSolver {
    pub(crate) arm: ThreeParallel,
    pub(crate) surroundings: Surroundings,
}

impl ParallelSolver {
    /// The solver of `arm` between the base and the tool of its chain.
    pub(crate) fn new<const N: usize>(arm: ThreeParallel, chain: &Chain<N>, _limits: &[[f64; 2]]) -> Self {
        let arm = arm.standing_between(chain.base(), chain.tool());
        Self { surroundings: Surroundings::new(&arm.placement, chain), arm }
    }
}
