//! The triangle of upper arm, forearm and the line from the shoulder to the end of the forearm: two
//! circles that intersect in the elbow.
//!
//! Docs: spherical_wrist.md, eq. 6 to 10. Every structure with an elbow uses it, in lanes and in
//! the scalar solver.

use crate::lanes::mul_add;
use crate::report::Reach;

/// The two links that span it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Triangle {
    /// Squares of the largest and of the least distance that the links span [m^2].
    longest2: f64,
    shortest2: f64,
    /// (upper - forearm) (upper + forearm) [m^2]
    difference: f64,
}

impl Triangle {
    /// The triangle for the lengths of both links [m].
    pub(crate) fn new(upper: f64, forearm: f64) -> Self {
        let (longest, shortest) = (upper + forearm, upper - forearm);
        Self {
            longest2: longest * longest,
            shortest2: shortest * shortest,
            difference: shortest * longest,
        }
    }

    /// The triangle for the lengths of both links, if they span `r` or miss it by at most
    /// `tolerance` [m].
    pub(crate) fn reaching(
        [upper, forearm]: [f64; 2],
        r: f64,
        tolerance: f64,
    ) -> Result<Self, Reach> {
        let (longest, shortest) = (upper + forearm, (upper - forearm).abs());
        if r - longest > tolerance {
            return Err(Reach::TooFar { shortfall: r - longest });
        }
        if shortest - r > tolerance {
            return Err(Reach::TooNear { shortfall: shortest - r });
        }
        Ok(Self::new(upper, forearm))
    }

    /// Whether the links that span r are nearer to stretched than to folded.
    pub(crate) fn is_stretched(&self, r2: f64) -> bool {
        self.longest2 - r2 < r2 - self.shortest2
    }

    /// The square of m, which is twice the triangle's area (eq. 7, 8); negative out of reach.
    /// Heron's formula: the textbook's difference of products loses its digits where the arm is
    /// nearly straight.
    #[inline(always)]
    pub(crate) fn m2(&self, r2: f64) -> f64 {
        0.25 * ((self.longest2 - r2) * (r2 - self.shortest2))
    }

    /// The upper arm times r^2, on the side of the sign of m, with the forearm ending at `end` (eq.
    /// 9, 10).
    #[inline(always)]
    pub(crate) fn upper_arm<const FUSED: bool>(
        &self,
        [x, z]: [f64; 2],
        r2: f64,
        m: f64,
    ) -> [f64; 2] {
        let h2 = 0.5 * (r2 + self.difference);
        [mul_add::<FUSED>(h2, x, -(m * z)), mul_add::<FUSED>(h2, z, m * x)]
    }
}
