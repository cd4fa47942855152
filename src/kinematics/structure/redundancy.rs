//! What a pose leaves open of every arm with a number of joints, and a caller gives.

use crate::error::Error;
use crate::kinematics::answer::check::check_angle;
use crate::lanes::{Column, LANES};

/// What a caller gives with a pose: nothing, `()`, for six joints; the angle of joint 7 [rad], an
/// `f64`, for seven.
pub trait Redundancy: Copy + Send + Sync + 'static {
    /// The same of a block of poses.
    #[doc(hidden)]
    type Lanes: Copy;

    /// That of a block, of those of all poses; of rows behind the last, anything.
    #[doc(hidden)]
    fn lanes(rows: &[Self], block: usize) -> Self::Lanes;

    /// That of a joint vector.
    #[doc(hidden)]
    fn of(q: &[f64]) -> Self;

    /// Gives a joint vector the angle as it was given.
    #[doc(hidden)]
    fn put(self, q: &mut [f64]);

    /// Checks that it is an angle.
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
