//! The structures that an arm of seven joints may have.

use super::Structure;
use super::any::{AnyStructure, recognized};
use super::arm::Arm;
use super::declare::structures;
use super::last_given::LastGiven;
use super::solver::Solver;
use super::spherical_shoulder::SphericalShoulder;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::report::UnknownStructure;

structures! {
    /// Structures with seven joints, of which the caller gives the last.
    SevenJoints, 7, f64: SphericalShoulder: 8, LastGiven: 16
}
