//! The structures that an arm may have, in the order in which they are tried on a table.

use alloc::sync::Arc;

use nalgebra::{Rotation3, Vector3};

use super::Structure;
use super::general::General;
use super::inverse::{Inverse, Solved};
use super::locked::{Locked, LockedJoint};
use super::offset_wrist::OffsetWrist;
use super::pan_roll::PanRoll;
use super::solver::Solver;
use super::spherical_shoulder::SphericalShoulder;
use super::spherical_wrist::{OpwParameters, SphericalWrist};
use super::three_parallel::ThreeParallel;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{Mdh, screw_x};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::translation_z;
use crate::report::UnknownStructure;

/// The structures that an arm may have, in the order in which they are tried on a table.
pub(crate) struct Known<const N: usize> {
    /// They take microseconds to prepare.
    pub(crate) closed_forms: &'static [Measure<N>],
    /// They take milliseconds.
    pub(crate) others: &'static [Measure<N>],
}

pub(crate) type Measure<const N: usize> = fn(&Mdh<N>) -> Result<Solved<N>, UnknownStructure>;

/// The last one takes every table whose joints are independent.
pub(crate) const SIX_JOINTS: Known<6> = Known {
    closed_forms: &[measured::<SphericalWrist, 6, 8>, measured::<ThreeParallel, 6, 8>],
    others: &[measured::<OffsetWrist, 6, 16>, measured::<General, 6, 16>],
};

pub(crate) const FIVE_JOINTS: Known<5> = Known { closed_forms: &[PanRoll::measured], others: &[] };

pub(crate) const SEVEN_JOINTS: Known<7> =
    Known { closed_forms: &[measured::<SphericalShoulder, 7, 8>], others: &[last_locked] };

fn measured<T: Structure<N, S>, const N: usize, const S: usize>(
    mdh: &Mdh<N>,
) -> Result<Solved<N>, UnknownStructure> {
    let (chain, solver) = solver_of::<T, N, S>(mdh)?;
    Ok((chain, Arc::new(solver)))
}

/// The chain and the solver of a table of structure `T`, with identity base and tool.
pub(crate) fn solver_of<T: Structure<N, S>, const N: usize, const S: usize>(
    mdh: &Mdh<N>,
) -> Result<(Chain<N>, Solver<T, N, S>), UnknownStructure> {
    let mut squared = T::PATTERN.square_up(mdh)?;
    let structure = T::measure(&mut squared)?;
    let chain = Chain::new(squared);
    let solver = Solver::new(structure, &chain, &JointLimits::UNLIMITED);
    Ok((chain, solver))
}

/// The chain and the inverse of a table.
pub(crate) struct Recognized<const N: usize> {
    pub(crate) chain: Chain<N>,
    /// `None` if the structure is unknown.
    pub(crate) inverse: Option<Arc<dyn Inverse<N>>>,
    /// The closed form that is nearest, and how far the table is from it; `None` if it has one.
    pub(crate) missing_form: Option<UnknownStructure>,
}

impl<const N: usize> Recognized<N> {
    pub(crate) fn new((chain, inverse): Solved<N>, missing_form: Option<UnknownStructure>) -> Self {
        Self { chain, inverse: Some(inverse), missing_form }
    }
}

pub(crate) fn recognize<const N: usize>(mdh: &Mdh<N>, known: &Known<N>) -> Recognized<N> {
    let nearest = match closed_form(mdh, known) {
        Ok(solved) => return Recognized::new(solved, None),
        Err(nearest) => nearest,
    };
    let mut refused = None;
    for measure in known.others {
        match measure(mdh) {
            Ok(solved) => return Recognized::new(solved, Some(nearest)),
            Err(missed) => refused = Some(missed),
        }
    }
    // A link that is too short says more than what depends on it.
    let reason = refused.filter(|_| !nearest.is_length()).unwrap_or(nearest);
    Recognized { chain: Chain::new(mdh.clone()), inverse: None, missing_form: Some(reason) }
}

/// Recognize a table that differs by a link from the table of another arm.
pub(crate) fn recognize_like(mdh: &Mdh<6>, other: &dyn Inverse<6>) -> Recognized<6> {
    // The offset wrist is recognized before an arm in general.
    let is_offset_wrist = OffsetWrist::PATTERN.square_up(mdh).is_ok();
    let (Err(nearest), false) = (closed_form(mdh, &SIX_JOINTS), is_offset_wrist) else {
        return recognize(mdh, &SIX_JOINTS);
    };
    match other.like(mdh) {
        Some(solved) => Recognized::new(solved, Some(nearest)),
        None => recognize(mdh, &SIX_JOINTS),
    }
}

/// The inverse of a table in closed form; otherwise the conditions of the nearest one.
pub(crate) fn closed_form<const N: usize>(
    mdh: &Mdh<N>,
    known: &Known<N>,
) -> Result<Solved<N>, UnknownStructure> {
    let mut nearest: Option<UnknownStructure> = None;
    for measure in known.closed_forms {
        match measure(mdh) {
            Ok(solved) => return Ok(solved),
            Err(missed) => nearest = Some(missed.nearer_of(nearest)),
        }
    }
    Err(nearest.unwrap_or(UnknownStructure::joint_count(N)))
}

/// The inverse of seven joints of which a caller locks the last.
fn last_locked(mdh: &Mdh<7>) -> Result<Solved<7>, UnknownStructure> {
    let [rows @ .., last] = mdh.rows;
    let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), last.theta);
    let link = screw_x(last.alpha, last.a) * turned * translation_z(last.d);
    let six = recognize(&Mdh { base: mdh.base, rows, flange: link * mdh.flange }, &SIX_JOINTS);
    let chain = Chain::new(mdh.clone());
    let locked = LockedJoint::new(&chain, 6, 0.0);
    let inverse =
        six.inverse.ok_or(six.missing_form.unwrap_or(UnknownStructure::joint_count(7)))?;
    Ok((chain, Locked::of(inverse, six.chain, locked, JointLimits::UNLIMITED)))
}

/// The chain and the inverse of an ortho-parallel arm with a spherical wrist.
pub(crate) fn of_opw(opw: &OpwParameters) -> Solved<6> {
    let chain = Chain::new(opw.mdh());
    let solver = Solver::new(SphericalWrist::from_opw(opw), &chain, &JointLimits::UNLIMITED);
    (chain, Arc::new(solver))
}
