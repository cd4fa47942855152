//! The redundancy parameter: what every pose leaves undetermined for a number of joints, and a
//! caller gives.

use crate::error::Error;
use crate::kinematics::answer::check::check_angle;
use crate::lanes::{Column, LANES};

/// The redundancy parameter that a caller gives with a pose: `()` for six joints; the angle of
/// joint 7 [rad], an `f64`, for seven.
pub trait Redundancy: Copy + Send + Sync + 'static {
    /// The redundancy parameters of a block of poses.
    #[doc(hidden)]
    type Lanes: Copy;

    /// The parameters of a block, from those of all poses; arbitrary for rows after the last.
    #[doc(hidden)]
    fn lanes(rows: &[Self], block: usize) -> Self::Lanes;

    /// The parameter of a joint vector.
    #[doc(hidden)]
    fn of(q: &[f64]) -> Self;

    /// Set the given angle in a joint vector.
    #[doc(hidden)]
    fn put(self, q: &mut [f64]);

    /// Check that the parameter is a valid angle.
    #[doc(hidden)]
    fn check(self) -> Result<(), Error>;
}

impl Redundancy for () {
    type Lanes = ();

    #[inline(always)]
    fn lanes(_: &[()], _: usize) {}

    #[inline(always)]
    fn of(_: &[f64]) -> Self {}

    #[inline(always)]
    fn put(self, _: &mut [f64]) {}

    #[inline(always)]
    fn check(self) -> Result<(), Error> {
        Ok(())
    }
}

impl Redundancy for f64 {
    type Lanes = Column;

    #[inline(always)]
    fn lanes(rows: &[f64], block: usize) -> Column {
        let mut column = [0.0; LANES];
        for (to, from) in column.iter_mut().zip(rows.iter().skip(LANES * block)) {
            *to = *from;
        }
        column
    }

    #[inline(always)]
    fn of(q: &[f64]) -> Self {
        q.last().copied().unwrap_or(0.0)
    }

    #[inline(always)]
    fn put(self, q: &mut [f64]) {
        if let Some(last) = q.last_mut() {
            *last = self;
        }
    }

    fn check(self) -> Result<(), Error> {
        check_angle("q7", 7, self)
    }
}
