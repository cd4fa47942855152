//! What can be wrong with a pose.

use core::fmt;

/// What is wrong with a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PoseFault {
    /// An element is NaN or infinite.
    NotFinite {
        /// Row of the matrix, from 0.
        row: usize,
        /// Column of the matrix, from 0.
        column: usize,
        /// The element.
        value: f64,
    },
    /// A position is too far away to calculate with.
    TooFar {
        /// Name of the argument.
        field: &'static str,
        /// Index of the coordinate, from 0.
        index: usize,
        /// The coordinate [m].
        value: f64,
        /// The largest size of a coordinate [m].
        bound: f64,
    },
    /// The last row is not 0 0 0 1.
    LastRow {
        /// The row that came.
        row: [f64; 4],
        /// Whether the last column is 0 0 0 1: the matrix is transposed.
        transposed: bool,
    },
    /// The columns of the rotation are not orthonormal: the largest element of `R^T R - I` exceeds
    /// the bound.
    NotOrthonormal {
        /// The largest element of `R^T R - I`.
        deviation: f64,
        /// The largest that is repaired.
        bound: f64,
    },
    /// The rotation mirrors: its determinant is negative.
    Mirrored {
        /// The determinant.
        determinant: f64,
    },
    /// A quaternion's norm is too far from one.
    QuaternionNorm {
        /// The norm.
        norm: f64,
        /// The largest distance from one that is normalized.
        bound: f64,
        /// The order of its elements.
        order: &'static str,
    },
    /// An Euler angle of more than a full turn, as degrees are.
    EulerAngle {
        /// Index into the angles, from 0.
        index: usize,
        /// The angle [rad].
        value: f64,
        /// The largest size of an angle [rad].
        bound: f64,
    },
    /// A tool is too long to be one, as one in millimeters is.
    ToolTooLong {
        /// Distance of the tool center point from the flange [m].
        length: f64,
        /// The longest that is taken [m].
        bound: f64,
    },
    /// A translation, quaternion or Euler angle is NaN or infinite.
    FieldNotFinite {
        /// Name of the argument.
        field: &'static str,
        /// Index into it.
        index: usize,
        /// The element.
        value: f64,
    },
}

impl fmt::Display for PoseFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { row, column, value } => {
                write!(f, "pose[{row}, {column}] is {value}: every element must be finite")
            }
            Self::TooFar { field: "pose", index, value, bound } => {
                write!(f, "pose[{index}, 3] is {value:e} m, its size must be at most {bound:e} m")
            }
            Self::TooFar { field, index, value, bound } => {
                write!(f, "{field}[{index}] is {value:e} m, its size must be at most {bound:e} m")
            }
            Self::LastRow { row: [a, b, c, d], transposed } => {
                write!(f, "pose row 3 must be [0, 0, 0, 1], got [{a}, {b}, {c}, {d}]")?;
                if *transposed {
                    write!(f, ", and column 3 is [0, 0, 0, 1] (is it transposed?)")
                } else {
                    Ok(())
                }
            }
            Self::NotOrthonormal { deviation, bound } => {
                write!(
                    f,
                    "pose rotation is off orthonormal by {deviation:.3e}, more than the {bound:.0e} that \
                     is repaired (is it scaled, or written with too few digits?)"
                )
            }
            Self::Mirrored { determinant } => {
                write!(
                    f,
                    "pose rotation mirrors: its determinant is {determinant:.6}, it must be 1 (is \
                     an axis negated?)"
                )
            }
            Self::QuaternionNorm { norm, bound, order } => {
                write!(
                    f,
                    "quaternion norm is {norm:.6}, it must be 1 within {bound:.0e} (order is {order})"
                )
            }
            Self::EulerAngle { index, value, bound } => {
                write!(
                    f,
                    "euler_zyx[{index}] is {value} rad, its size must be at most {bound:.4} rad \
                     (did you pass degrees?)"
                )
            }
            Self::ToolTooLong { length, bound } => {
                write!(
                    f,
                    "the tool center point is {length:.1} m from the flange, it must be at most \
                     {bound} m (is the tool in millimeters? meters are wanted)"
                )
            }
            Self::FieldNotFinite { field, index, value } => {
                write!(f, "{field}[{index}] is {value}: every element must be finite")
            }
        }
    }
}
