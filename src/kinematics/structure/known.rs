//! The structures that an arm may have, in the order in which they are tried on a table.

use alloc::sync::Arc;
use core::any::Any;

use nalgebra::{Rotation3, Vector3};

use super::Structure;
use super::general::General;
use super::inverse::{Inverse, of_count};
use super::locked::{Locked, LockedJoint};
use super::offset_wrist::OffsetWrist;
use super::refined::Refined;
use super::solver::Solver;
use super::spherical_shoulder::SphericalShoulder;
use super::spherical_wrist::{OpwParameters, SphericalWrist};
use super::three_parallel::ThreeParallel;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{Mdh, screw_x};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::translation_z;
use crate::report::UnknownStructure;

/// A chain with deviations from a structure within rounding removed, and its inverse.
pub(crate) type Solved<const N: usize> = (Chain<N>, Arc<dyn Inverse<N>>);

/// A structure, as it is tried on a table.
struct Known<const N: usize> {
    is_closed_form: bool,
    measure: fn(&Mdh<N>) -> Result<Solved<N>, UnknownStructure>,
}

/// The last one takes every table whose joints are independent.
static SIX_JOINTS: &[Known<6>] = &[
    Known { is_closed_form: true, measure: measured::<SphericalWrist, 6, 8> },
    Known { is_closed_form: true, measure: measured::<ThreeParallel, 6, 8> },
    Known { is_closed_form: false, measure: measured::<OffsetWrist, 6, 16> },
    Known { is_closed_form: false, measure: measured::<General, 6, 16> },
];

static SEVEN_JOINTS: &[Known<7>] = &[
    Known { is_closed_form: true, measure: measured::<SphericalShoulder, 7, 8> },
    Known { is_closed_form: false, measure: last_locked },
];

fn known<const N: usize>() -> &'static [Known<N>] {
    let lists: [&'static dyn Any; 2] = [&SIX_JOINTS, &SEVEN_JOINTS];
    let of_count = lists.iter().find_map(|list| list.downcast_ref::<&'static [Known<N>]>());
    of_count.copied().unwrap_or(&[])
}

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
    fn new((chain, inverse): Solved<N>, missing_form: Option<UnknownStructure>) -> Self {
        Self { chain, inverse: Some(inverse), missing_form }
    }

    /// A table without its inverse, for a reason.
    fn unknown(mdh: &Mdh<N>, reason: UnknownStructure) -> Self {
        Self { chain: Chain::new(mdh.clone()), inverse: None, missing_form: Some(reason) }
    }
}

/// Recognize the structure of a table.
pub(crate) fn recognize<const N: usize>(mdh: &Mdh<N>) -> Recognized<N> {
    let nearest = match closed_form(mdh) {
        Ok(solved) => return Recognized::new(solved, None),
        Err(nearest) => nearest,
    };
    let mut refused = None;
    for known in known().iter().filter(|known| !known.is_closed_form) {
        match (known.measure)(mdh) {
            Ok(solved) => return Recognized::new(solved, Some(nearest)),
            Err(missed) => refused = Some(missed),
        }
    }
    // A link that is too short says more than what depends on it.
    let reason = refused.filter(|_| !nearest.is_length()).unwrap_or(nearest);
    Recognized::unknown(mdh, reason)
}

/// Recognize the structure of a table if it has a closed form; otherwise prepare no inverse, which
/// takes milliseconds.
pub(crate) fn recognize_closed_form<const N: usize>(mdh: &Mdh<N>) -> Recognized<N> {
    match closed_form(mdh) {
        Ok(solved) => Recognized::new(solved, None),
        Err(reason) => Recognized::unknown(mdh, reason),
    }
}

/// Recognize a table that differs by a link from the table of another arm.
pub(crate) fn recognize_like(mdh: &Mdh<6>, other: &dyn Inverse<6>) -> Recognized<6> {
    let other: &dyn Any = other;
    let Some(Solver { structure: other, .. }) = other.downcast_ref::<Solver<General, 6, 16>>()
    else {
        return recognize(mdh);
    };
    // The offset wrist is recognized before an arm in general.
    let is_offset_wrist = OffsetWrist::PATTERN.square_up(mdh).is_ok();
    let (Err(nearest), false) = (closed_form(mdh), is_offset_wrist) else {
        return recognize(mdh);
    };
    let Ok(general) = General::like(mdh, other) else { return recognize(mdh) };
    let chain = Chain::new(mdh.clone());
    let solver = Solver::new(general, &chain, &JointLimits::UNLIMITED);
    Recognized::new((chain, Arc::new(solver)), Some(nearest))
}

/// The inverse of a table in closed form; otherwise the conditions of the nearest one.
pub(crate) fn closed_form<const N: usize>(mdh: &Mdh<N>) -> Result<Solved<N>, UnknownStructure> {
    let mut nearest: Option<UnknownStructure> = None;
    for known in known().iter().filter(|known| known.is_closed_form) {
        match (known.measure)(mdh) {
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
    let six = recognize(&Mdh { base: mdh.base, rows, flange: link * mdh.flange });
    let chain = Chain::new(mdh.clone());
    let locked = LockedJoint::new(&chain, 6, 0.0);
    let inverse = six
        .inverse
        .and_then(|inverse| Locked::of(inverse, six.chain, locked, JointLimits::UNLIMITED));
    match inverse {
        Some(inverse) => Ok((chain, inverse)),
        None => Err(six.missing_form.unwrap_or(UnknownStructure::joint_count(7))),
    }
}

/// The inverse of an ortho-parallel arm with a spherical wrist; `None` for another number of joints
/// than six.
pub(crate) fn of_opw<const N: usize>(
    opw: &OpwParameters,
    chain: &Chain<N>,
) -> Option<Arc<dyn Inverse<N>>> {
    let chain = of_count(chain.clone())?;
    let solver = Solver::new(SphericalWrist::from_opw(opw), &chain, &JointLimits::UNLIMITED);
    of_count::<Arc<dyn Inverse<6>>, _>(Arc::new(solver))
}

/// The inverse of the calibrated arm `chain` by way of its nominal arm; `None` for another number
/// of joints than six.
pub(crate) fn refined<const N: usize>(
    nominal: &Arc<dyn Inverse<N>>,
    nominal_chain: &Chain<N>,
    chain: &Chain<N>,
    limits: &JointLimits<N>,
) -> Option<Arc<dyn Inverse<N>>> {
    let nominal = of_count::<_, Arc<dyn Inverse<6>>>(Arc::clone(nominal))?;
    let chains = (of_count(nominal_chain.clone())?, of_count(chain.clone())?);
    let refined = Refined::new(&*nominal, chains.0, &chains.1, &of_count(*limits)?);
    of_count::<Arc<dyn Inverse<6>>, _>(Arc::new(refined))
}
