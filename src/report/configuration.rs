//! ABB's confdata, as a program writes it, and the rules by which controllers count it.

use core::fmt;

/// ABB's confdata `[cf1, cf4, cf6, cfx]`: quarter turns of axes 1, 4 and 6, and the branch of the
/// arm.
///
/// A quarter turn's number is `floor(angle / 90 deg)`. `cfx` is 4 (wrist center behind axis 1) + 2
/// (behind the lower arm) + 1 (q5 < 0). Arms of other structures count as their
/// [`ConfigurationRule`] says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "python",
    pyo3::pyclass(module = "irbkin", frozen, get_all, sequence, from_py_object)
)]
pub struct Configuration {
    /// Quarter turn of axis 1.
    pub cf1: i32,
    /// Quarter turn of axis 4.
    pub cf4: i32,
    /// Quarter turn of axis 6.
    pub cf6: i32,
    /// The branch of an arm that bends backwards; zero for one with coupled axes 2 and 3.
    pub cfx: i32,
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cf1, cf4, cf6, cfx } = self;
        write!(f, "[{cf1}, {cf4}, {cf6}, {cfx}]")
    }
}

/// How a controller counts the configurations of an arm.
///
/// docs/abb.md says what each rule was validated against.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ConfigurationRule {
    /// Six axes with a spherical wrist: cf is the floor of the quarter turns, cfx the slot.
    SphericalWrist,
    /// GoFa: cf is the floor of the quarter turns, cfx that of a wrist whose center is the
    /// intersection of axes 4 and 5. A configuration may name two joint vectors of a pose.
    OffsetWrist,
    /// YuMi: cf is the nearest number of quarter turns, cfx 4 (q2 < 0) + 2 (q3 below the stretched
    /// elbow) + 1 (q5 < 0) of ABB's axes 2, 3 and 5. The arm angle completes it.
    ArmAngle {
        /// The direction, in the frame before the first link, from which the arm angle counts.
        reference: [f64; 3],
    },
}
