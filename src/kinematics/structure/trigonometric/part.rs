//! A part of an arc, by its Bernstein coefficients.

use super::roots::Root;
use super::tables::{FIRST_MIDDLE, HALF_ARC, HALF_ARC_TAN, POWERS};
use crate::lanes::{Column, Number};

/// Series of the arc tangent, behind its first term: good to 1e-17 on half an arc.
const ATAN: [f64; 7] =
    [-1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0];

pub(super) type Coefficients<T> = [T; POWERS + 1];

/// A part of an arc: ends in 0 ..= 1, and the Bernstein coefficients between them.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) arc: usize,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Where it is to be divided, as a part of it, and which of its two parts count.
    pub(super) cut: f64,
    pub(super) keeps: [bool; 2],
    pub(super) coefficients: Coefficients<f64>,
}

impl Part {
    /// A whole arc, to be divided in the middle; without coefficients.
    #[inline(always)]
    pub(super) fn whole(arc: usize) -> Self {
        let coefficients = [0.0; POWERS + 1];
        Self { arc, low: 0.0, high: 1.0, cut: 0.5, keeps: [true; 2], coefficients }
    }

    /// The part in a lane of coefficients: its arc and its ends.
    #[inline(always)]
    pub(super) fn of(
        columns: &Coefficients<Column>,
        lane: usize,
        (arc, low, high): (usize, f64, f64),
    ) -> Self {
        let coefficients = core::array::from_fn(|j| columns[j][lane]);
        Self { low, high, coefficients, ..Self::whole(arc) }
    }

    pub(super) fn cluster(&self) -> Root {
        let [low, high] = [self.low, self.high].map(|place| angle(middle(self.arc), place));
        Root { low, high, ..Root::NONE }
    }
}

/// The middle of an arc [rad].
#[expect(clippy::cast_precision_loss, reason = "one of 16")]
pub(super) fn middle(arc: usize) -> f64 {
    FIRST_MIDDLE + arc as f64 * (2.0 * HALF_ARC)
}

/// The angle at a place of an arc with this middle [rad].
#[inline(always)]
pub(super) fn angle<T: Number>(middle: T, place: T) -> T {
    let tan = place.scaled_plus(2.0 * HALF_ARC_TAN, place.like(-HALF_ARC_TAN));
    let square = tan * tan;
    let mut series = place.like(ATAN[ATAN.len() - 1]);
    for part in ATAN[..ATAN.len() - 1].iter().rev() {
        series = series.times_plus(square, place.like(*part));
    }
    (tan * 2.0).times_plus(series.times_plus(square, place.like(1.0)), middle)
}
