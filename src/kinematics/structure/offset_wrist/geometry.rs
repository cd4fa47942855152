//! The stored geometry of an arm with an offset wrist.

use alloc::boxed::Box;

use crate::kinematics::chain::Chain;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::general::General;

/// An arm with an offset wrist: its table between the shoulder and the last joint, and the lengths
/// and angles of the equations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OffsetWrist {
    /// From the foot of the common normal of axes 1 and 2, to frame 6 with its origin at the foot
    /// of that of axes 5 and 6; joint angles are theta.
    pub(super) chain: Chain<6>,
    pub(super) constants: Constants,
    /// The arm as one in general, whose splits are tried where the counts of roots and solutions
    /// differ.
    pub(super) general: Box<General>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    pub(super) lengths: Lengths,
    pub(super) twists: Twists,
    /// The closure of the arm in general.
    pub(super) closure: Closure,
}

/// The lengths and angles of the equations (docs/theory/offset_wrist.md, section 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lengths {
    /// Distance of axis 2 from axis 1 [m].
    pub(super) a1: f64,
    /// Upper arm, along x of frame 2 [m]; may be negative.
    pub(super) upper: f64,
    /// Forearm, from axis 3 to the wrist point in the plane of the arm [m].
    pub(super) forearm: f64,
    /// Unit vector along the forearm, in x3 and the direction a quarter turn on in the plane.
    pub(super) v: [f64; 2],
    /// Distance of the wrist point along axis 2 [m].
    pub(super) b: f64,
    /// 1, or -1 where axis 2 is at -y of frame 1.
    pub(super) s1: f64,
    /// 1, or -1 where axes 2 and 3 have opposite directions.
    pub(super) e: f64,
    /// Cosines of the angles between axes 3 and 4 and between axes 4 and 5.
    pub(super) cos_3: f64,
    pub(super) cos_4: f64,
    /// Component of axis 4 a quarter turn on from x3 in the plane of the arm.
    pub(super) m: f64,
    /// From axis 6 to axis 5 and along axis 5 to the wrist point [m].
    pub(super) a5: f64,
    pub(super) d5: f64,
    /// Sine and cosine of the angle between axes 5 and 6.
    pub(super) sin_5: f64,
    pub(super) cos_5: f64,
    /// The distance of the wrist point from axis 6 [m].
    pub(super) circle: f64,
    /// The sum of the lengths of the rows [m].
    pub(super) extent: f64,
    /// Whether the polynomial is a square (eq. 129).
    pub(super) is_square: bool,
}

impl Lengths {
    /// How many solutions a root has: one for each side of the shoulder, or one.
    pub(super) fn per_root(&self) -> usize {
        if self.is_square { 2 } else { 1 }
    }

    /// The shortest and the longest distance that upper arm and forearm span [m].
    #[inline(always)]
    pub(super) fn span(&self) -> [f64; 2] {
        let upper = self.upper.abs();
        [(upper - self.forearm).abs(), upper + self.forearm]
    }
}

/// Sines and cosines of the twists of rows 4 to 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Twists {
    pub(super) sin_3: f64,
    pub(super) cos_3: f64,
    pub(super) sin_4: f64,
    pub(super) sin_5: f64,
    pub(super) cos_5: f64,
}
