//! Formulas that are the same for a number and for eight of them.

use core::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::Vector;

/// A number, or a vector of numbers.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A constant, in as many lanes.
    fn like(self, constant: f64) -> Self;

    /// `self * by + plus`; of vectors in one rounding where the instruction set has it.
    fn times_plus(self, by: Self, plus: Self) -> Self;

    /// The square root.
    fn root(self) -> Self;

    /// The absolute value.
    fn size(self) -> Self;

    /// Return the size with the sign of another number.
    fn signed_as(self, sign: Self) -> Self;

    /// `yes` where this number is above another, else `no`: also where one is not a number.
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self;

    /// `self * by + plus` with a constant factor.
    #[inline(always)]
    fn scaled_plus(self, by: f64, plus: Self) -> Self {
        self.times_plus(self.like(by), plus)
    }

    /// `self * by - minus`.
    #[inline(always)]
    fn times_minus(self, by: Self, minus: Self) -> Self {
        self.times_plus(by, -minus)
    }

    /// The inverse.
    #[inline(always)]
    fn inverse(self) -> Self {
        self.like(1.0) / self
    }

    /// The larger of this and another number; the other if this is not a number.
    #[inline(always)]
    fn or_more(self, other: Self) -> Self {
        self.if_above(other, self, other)
    }
}

/// The product of two vectors with three components.
#[inline(always)]
pub fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0].times_plus(b[0], a[1].times_plus(b[1], a[2] * b[2]))
}

/// The cross product.
#[inline(always)]
pub fn cross<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [
        a[1].times_minus(b[2], a[2] * b[1]),
        a[2].times_minus(b[0], a[0] * b[2]),
        a[0].times_minus(b[1], a[1] * b[0]),
    ]
}

impl Number for f64 {
    #[inline(always)]
    fn like(self, constant: f64) -> Self {
        constant
    }

    #[inline(always)]
    fn times_plus(self, by: Self, plus: Self) -> Self {
        self * by + plus
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn signed_as(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self {
        if self > other { yes } else { no }
    }
}

impl<S: Simd> Number for Vector<S> {
    #[inline(always)]
    fn like(self, constant: f64) -> Self {
        Self::splat(self.token(), constant)
    }

    #[inline(always)]
    fn times_plus(self, by: Self, plus: Self) -> Self {
        self.mul_add(by, plus)
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn signed_as(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self {
        self.simd_gt(other).select(yes, no)
    }
}
