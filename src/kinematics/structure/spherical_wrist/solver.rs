//! An arm between the frames in which poses are given: what a solve needs.

use super::SphericalWrist;
use super::branch::Constants;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::coupling::coupled;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::structure::end_frames::Surroundings;
use crate::kinematics::structure::joint_map::Placement;
use crate::kinematics::structure::lanes::JointColumn;

/// The geometry, with what stands before and behind it and what is asked of its joints.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WristSolver {
    pub(crate) arm: SphericalWrist,
    pub(crate) surroundings: Surroundings,
    pub(super) constants: Constants,
    /// `None` where the limits ask for more than what lanes do.
    pub(super) columns: Option<Columns>,
}

/// How joint angles come from the angles that lanes calculate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Columns {
    pub(super) joints: [JointColumn; 6],
    /// How much of theta_2 is taken off theta_23 for joint 3: one, or nothing of an arm with coupled axes (eq. 25).
    pub(super) serial: f64,
    /// The serial joint 3, of an arm whose rod has limits.
    pub(super) rod: Option<JointColumn>,
}

impl Columns {
    fn of(placement: &Placement<6>, limits: &[[f64; 2]], rod: Option<[f64; 2]>) -> Option<Self> {
        let (signs, offsets) = (&placement.signs, &placement.offsets);
        let column =
            |offsets: &[f64; 6], limits: &[[f64; 2]]| JointColumn::of(signs, offsets, limits, &[2]);
        let told = if placement.coupled { coupled(*offsets) } else { *offsets };
        let rod = match rod {
            Some(rod) => Some(column(offsets, &[rod; 6])?[2]),
            None => None,
        };
        Some(Self {
            joints: column(&told, limits)?,
            serial: if placement.coupled { 0.0 } else { 1.0 },
            rod,
        })
    }
}

impl WristSolver {
    /// The solver of `arm` between the base and the tool of its chain, coupled as it is, with limits.
    pub(crate) fn new<const N: usize>(
        arm: SphericalWrist,
        chain: &Chain<N>,
        limits: &JointLimits<N>,
    ) -> Self {
        let arm =
            arm.standing_between(chain.base(), chain.tool()).with_coupling(chain.is_coupled());
        Self {
            surroundings: Surroundings::new(&arm.placement, chain),
            constants: Constants::of(&arm.planar),
            columns: Columns::of(&arm.placement, &limits.to_array(), limits.rod()),
            arm,
        }
    }
}
