//! From theta to joint angles, one column of lanes at a time.

use core::f64::consts::{PI, TAU};

use fearless_simd::prelude::*;

use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::thresholds::LIMIT_TOLERANCE;
use crate::lanes::{Column, LANES, Vector};

/// How joint angles follow from the angles that lanes compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Columns<const N: usize> {
    pub(crate) joints: [JointColumn; N],
    /// Factor of theta_2 that is subtracted from theta_23 for joint 3: one, or zero for an arm with
    /// coupled axes whose thetas turn in one sense (eq. 25).
    pub(crate) uncoupled: f64,
    /// The serial joint 3, if the linkage of the arm has limits.
    pub(crate) linkage: Option<JointColumn>,
    /// All joints at once.
    pub(crate) row: JointRow,
}

impl<const N: usize> Columns<N> {
    /// `differences` are the joints, from 0, whose theta is a difference of two angles. `None` if
    /// the limits require more than the lanes can do.
    pub(crate) fn of(
        map: &JointMap<N>,
        differences: &[usize],
        limits: &JointLimits<N>,
    ) -> Option<Self> {
        let (signs, offsets) = (&map.signs, &map.offsets);
        let column = |offsets: &[f64; N], limits: &[[f64; 2]; N]| {
            JointColumn::of(signs, offsets, limits, differences)
        };
        // Joint 3 of a controller turns by theta_3 + coupling theta_2.
        let coupling = map.coupling * signs[1] * signs[2];
        let mut of_controller = *offsets;
        of_controller[2] += coupling * offsets[1];
        let linkage = match limits.linkage() {
            Some(linkage) => Some(column(offsets, &[linkage; N])?[2]),
            None => None,
        };
        let joints = column(&of_controller, &limits.to_array())?;
        let row = JointRow { coupling, linkage, ..JointRow::of(&joints) };
        Some(Self { joints, uncoupled: 1.0 - coupling, linkage, row })
    }
}

/// How the angle of one joint follows from theta, and its limits: the same for every lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointColumn {
    sign: f64,
    offset: f64,
    low: f64,
    high: f64,
    /// Whether theta may have to be negated, shifted or wrapped.
    moves: bool,
    /// Whether the limits exclude a part of (-pi, pi].
    limits: bool,
    /// Whether a 2 pi equivalent of an angle outside the limits may be inside them.
    turns: bool,
}

impl JointColumn {
    /// One column per joint; `differences` are the joints, from 0, whose theta is a difference of
    /// two angles. `None` if limits are so far from zero that more than one turn may be needed.
    fn of<const N: usize>(
        signs: &[f64; N],
        offsets: &[f64; N],
        limits: &[[f64; 2]; N],
        differences: &[usize],
    ) -> Option<[Self; N]> {
        if limits.iter().any(|[low, high]| *low > PI || *high < -PI) {
            return None;
        }
        Some(core::array::from_fn(|joint| {
            let (sign, offset) = (signs[joint], wrap(offsets[joint]));
            let [low, high] = limits[joint];
            let (low, high) = (low - LIMIT_TOLERANCE, high + LIMIT_TOLERANCE);
            let limits = low > -PI || high < PI;
            Self {
                sign,
                offset,
                low,
                high,
                moves: differences.contains(&joint) || sign < 0.0 || offset != 0.0,
                limits,
                turns: limits && (low <= -PI || high >= PI),
            }
        }))
    }

    /// Mask for the status of a lane that is outside the limits.
    pub(crate) const OUTSIDE: u64 = !(Status::WITHIN_LIMITS.bits() as u64);

    /// Mask for the status of a lane whose angle of this joint is `angle`, without wrapping.
    #[inline(always)]
    pub(crate) fn limited(self, angle: f64) -> u64 {
        if self.holds(angle) { u64::MAX } else { Self::OUTSIDE }
    }

    /// The angle of this joint in (-pi, pi], or its 2 pi equivalent inside the limits (eq. 19, 20),
    /// and whether it is inside.
    #[inline(always)]
    pub(crate) fn wrapped(self, theta: f64) -> (f64, bool) {
        let angle = self.shifted(self.to_joint(theta));
        (angle, self.holds(angle))
    }

    /// Mask for the status of a lane with this theta, modulo 2 pi.
    #[inline(always)]
    pub(crate) fn left_of(self, theta: f64) -> u64 {
        if self.wrapped(theta).1 { u64::MAX } else { Self::OUTSIDE }
    }

    /// [`Self::wrapped`] for many, without the steps that this joint does not need. Clears
    /// `WITHIN_LIMITS` in the status of those outside.
    #[inline(always)]
    pub(crate) fn wrap(self, angles: &mut [f64], status: &mut [u64]) {
        if self.moves {
            for angle in angles.iter_mut() {
                *angle = self.to_joint(*angle);
            }
        } else {
            for angle in angles.iter_mut() {
                // The offset is zero; as in `to_joint`, adding it turns minus zero into zero.
                let theta = *angle + self.offset;
                *angle = if theta <= -PI { PI } else { theta };
            }
        }
        if self.turns {
            for angle in angles.iter_mut() {
                *angle = self.shifted(*angle);
            }
        }
        if self.limits {
            for (angle, status) in angles.iter().zip(status) {
                *status &= if self.holds(*angle) { u64::MAX } else { Self::OUTSIDE };
            }
        }
    }

    /// The joint angle in (-pi, pi]. Theta is within a turn of zero and the offset within half a
    /// turn, so one turn is enough.
    #[inline(always)]
    fn to_joint(self, theta: f64) -> f64 {
        let angle = self.sign * (theta + self.offset);
        let angle = if angle > PI { angle - TAU } else { angle };
        if angle <= -PI { angle + TAU } else { angle }
    }

    #[inline(always)]
    fn shifted(self, angle: f64) -> f64 {
        let (up, down) = (angle + TAU, angle - TAU);
        let raised = if (angle < self.low) & (up <= self.high) { up } else { angle };
        if (angle > self.high) & (down >= self.low) { down } else { raised }
    }

    #[inline(always)]
    fn holds(self, angle: f64) -> bool {
        (angle >= self.low) & (angle <= self.high)
    }
}

/// How the angles of all joints follow from theta, and their limits: a lane for each joint, and what
/// changes nothing in the lanes behind them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointRow {
    sign: Column,
    offset: Column,
    low: Column,
    high: Column,
    /// Factor of theta_2 that is added to theta_3 for joint 3 (eq. 25).
    coupling: f64,
    /// The serial joint 3, if the linkage of the arm has limits.
    linkage: Option<JointColumn>,
}

impl JointRow {
    /// Angles of the table, without limits.
    pub(crate) const OF_TABLE: Self = Self {
        sign: [1.0; LANES],
        offset: [0.0; LANES],
        low: [f64::NEG_INFINITY; LANES],
        high: [f64::INFINITY; LANES],
        coupling: 0.0,
        linkage: None,
    };

    fn of<const N: usize>(joints: &[JointColumn; N]) -> Self {
        let mut row = Self::OF_TABLE;
        for (lane, joint) in joints.iter().enumerate() {
            (row.sign[lane], row.offset[lane]) = (joint.sign, joint.offset);
            (row.low[lane], row.high[lane]) = (joint.low, joint.high);
        }
        row
    }

    /// [`JointColumn::wrapped`] for all joints, and whether all are inside.
    #[inline(always)]
    pub(crate) fn wrapped<S: Simd>(&self, simd: S, theta: &Column) -> (Vector<S>, bool) {
        let mut of_controller = *theta;
        of_controller[2] += self.coupling * theta[1];
        let theta_3 = theta[2];
        let theta = Vector::load_array(simd, of_controller);
        let (low, high) =
            (Vector::load_array_ref(simd, &self.low), Vector::load_array_ref(simd, &self.high));
        let angle = theta + Vector::load_array_ref(simd, &self.offset);
        let angle = angle * Vector::load_array_ref(simd, &self.sign);
        let angle = angle.simd_gt(PI).select(angle - TAU, angle);
        let angle = angle.simd_le(-PI).select(angle + TAU, angle);
        let (up, down) = (angle + TAU, angle - TAU);
        let raised = (angle.simd_lt(low) & up.simd_le(high)).select(up, angle);
        let angle = (angle.simd_gt(high) & down.simd_ge(low)).select(down, raised);
        let is_inside = (angle.simd_ge(low) & angle.simd_le(high)).all_true();
        (angle, is_inside && self.linkage.is_none_or(|linkage| linkage.wrapped(theta_3).1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{VectorKernel, run_vectors};
    use crate::rng::Rng;

    /// A row of angles of the table.
    struct Wrap<'a>(&'a JointRow, Column);

    impl VectorKernel for Wrap<'_> {
        type Answer = (Column, bool);

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> (Column, bool) {
            let (row, is_inside) = self.0.wrapped(simd, &self.1);
            (row.to_array(), is_inside)
        }
    }

    #[test]
    fn a_row_is_wrapped_as_its_joints_are() {
        let mut rng = Rng::new(1);
        let mut inside = 0;
        for _ in 0..20_000 {
            let signs = core::array::from_fn(|_| rng.sign());
            let offsets = core::array::from_fn(|_| wrap(rng.between(-4.0, 4.0)));
            let limits = core::array::from_fn(|_| [rng.between(-7.0, -1.0), rng.between(1.0, 7.0)]);
            let joints: [_; 6] = JointColumn::of(&signs, &offsets, &limits, &[]).unwrap();
            let mut theta = [0.0; LANES];
            for (joint, theta) in theta[..6].iter_mut().enumerate() {
                // Where the range ends, and where the joint's range does, too.
                let ends = [rng.angle(), PI, -PI, wrap(PI - offsets[joint])];
                *theta = ends[usize::from(rng.unit() < 0.125) * (rng.bits() % 4) as usize];
            }
            let (row, is_inside) = run_vectors(Wrap(&JointRow::of(&joints), theta));
            let mut are_inside = true;
            for (joint, column) in joints.iter().enumerate() {
                let (angle, holds) = column.wrapped(theta[joint]);
                assert_eq!(row[joint].to_bits(), angle.to_bits());
                are_inside &= holds;
            }
            assert_eq!(is_inside, are_inside);
            inside += usize::from(is_inside);
        }
        assert!((1000..19_000).contains(&inside), "{inside}");
    }
}
