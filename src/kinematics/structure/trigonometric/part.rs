//! A part of an arc, by its Bernstein coefficients.

use core::f64::consts::PI;

use super::roots::Root;
use super::tables::{ARCS, FIRST_MIDDLE, HALF_ARC_TAN, POWERS};

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
    pub(super) coefficients: Coefficients<f64>,
}

impl Part {
    /// The angle at a place of its arc [rad].
    pub(super) fn angle(&self, place: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "one of 16")]
        let middle = FIRST_MIDDLE + self.arc as f64 * (2.0 * PI / ARCS as f64);
        let tan = HALF_ARC_TAN * (2.0 * place - 1.0);
        let square = tan * tan;
        let series = ATAN.iter().rev().fold(0.0, |sum, part| sum * square + part);
        middle + 2.0 * tan * (1.0 + square * series)
    }

    /// One simple root.
    pub(super) fn simple(&self) -> Root {
        Root { is_simple: true, most: 1, ..self.cluster() }
    }

    pub(super) fn cluster(&self) -> Root {
        Root { low: self.angle(self.low), high: self.angle(self.high), is_simple: false, most: 0 }
    }
}
