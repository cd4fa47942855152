//! The parameters of an arm that a calibration may correct, and the motion of the tool with each of
//! them (docs/theory/calibrate.md, eq. 1 to 6).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{Matrix3, Rotation3, Translation3, Vector3};

use crate::error::{Error, ModelFault};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::chain::skew::Unskewed;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::constant_sin_cos;

/// Parameters of a row: alpha, a, d, theta, and Hayati's rotation about y.
pub(crate) const ROW_PARAMETERS: usize = 5;

/// Parameters of a frame: x, y, z [m], then angles about x, y, z [rad].
pub(crate) const FRAME_PARAMETERS: usize = 6;

/// Corrections of the parameters of an arm, each added to its value (eq. 1):
///
/// ```text
/// T = base D(base) prod(Rx(alpha) Tx(a) Ry(beta) Rz(theta + q) Tz(d)) flange tool D(tool),
/// D(x, y, z, rx, ry, rz) = Txyz(x, y, z) Rz(rz) Ry(ry) Rx(rx)
/// ```
///
/// The base of eq. 1 includes the transform before the first row. A table has no `beta`: its
/// nominal value is zero. It turns an axis next to a parallel one in the direction that alpha does
/// not. Reference: Hayati, Robot arm geometric link parameter estimation, 1983.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections<const N: usize> {
    /// Of the frame before the first row: x, y, z [m], rx, ry, rz [rad], along and about its own
    /// axes.
    pub base: [f64; FRAME_PARAMETERS],
    /// Of each row: alpha [rad], a [m], d [m], theta [rad], beta [rad].
    pub rows: [[f64; ROW_PARAMETERS]; N],
    /// Of the tool: x, y, z [m], rx, ry, rz [rad], along and about its own axes.
    pub tool: [f64; FRAME_PARAMETERS],
}

impl<const N: usize> Corrections<N> {
    /// No corrections.
    pub const NONE: Self = Self {
        base: [0.0; FRAME_PARAMETERS],
        rows: [[0.0; ROW_PARAMETERS]; N],
        tool: [0.0; FRAME_PARAMETERS],
    };

    /// Number of parameters.
    pub const COUNT: usize = 2 * FRAME_PARAMETERS + ROW_PARAMETERS * N;

    /// Corrections in the order base, rows, tool.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when there are not [`Self::COUNT`] numbers, [`Error::InvalidModel`]
    /// when one is not finite.
    pub fn from_slice(numbers: &[f64]) -> Result<Self, Error> {
        let wrong_length =
            Error::WrongLength { field: "corrections", found: numbers.len(), wanted: Self::COUNT };
        let Some((base, rest)) = numbers.split_first_chunk() else { return Err(wrong_length) };
        let Some((rows, tool)) = rest.split_last_chunk() else { return Err(wrong_length) };
        let (rows, []) = rows.as_chunks() else { return Err(wrong_length) };
        let Ok(rows) = <[[f64; ROW_PARAMETERS]; N]>::try_from(rows) else {
            return Err(wrong_length);
        };
        let corrections = Self { base: *base, rows, tool: *tool };
        corrections.check()?;
        Ok(corrections)
    }

    /// Check that every correction is finite.
    /// Whether the table itself is corrected, not its ends alone.
    #[doc(hidden)]
    pub fn are_of_rows(&self) -> bool {
        self.rows.as_flattened().iter().any(|correction| *correction != 0.0)
    }

    pub(in crate::kinematics) fn check(&self) -> Result<(), Error> {
        let all = self.base.iter().chain(self.rows.as_flattened()).chain(&self.tool);
        for (index, value) in all.enumerate() {
            ModelFault::check("correction", index + 1, *value, f64::MAX)?;
        }
        Ok(())
    }

    /// The twist [rad] and the length [m] of a corrected row.
    fn twist(&self, mdh: &Mdh<N>, row: usize) -> (f64, f64) {
        let [alpha, a, ..] = self.rows[row];
        (mdh.rows[row].alpha + alpha, mdh.rows[row].a + a)
    }

    fn unskewed(&self, mdh: &Mdh<N>, row: usize) -> Option<Unskewed> {
        let (alpha, a) = self.twist(mdh, row);
        Unskewed::new(alpha, a, self.rows[row][4])
    }

    /// The frame of a link of the arm as it is corrected, in the frame of the corrected table, which
    /// may be far away; `None` if they are the same.
    #[doc(hidden)]
    pub fn link(&self, mdh: &Mdh<N>, link: usize) -> Option<Pose> {
        // The base is its own frame, whatever the first row is.
        let behind = (1..N).contains(&link).then_some(link)?;
        let (turn, shift) = self.unskewed(mdh, behind)?.before;
        Some((about_z(turn) * Translation3::new(0.0, 0.0, shift)).inverse())
    }

    /// The corrected table: without beta, which moves into the twist of its row and the offsets of
    /// both axes (eq. 7 to 9).
    pub(in crate::kinematics) fn table(&self, mdh: &Mdh<N>) -> Mdh<N> {
        let mut table = mdh.clone();
        for (i, [_, _, d, theta, _]) in self.rows.into_iter().enumerate() {
            let row = &mut table.rows[i];
            (row.d, row.theta) = (row.d + d, row.theta + theta);
            let Some(unskewed) = self.unskewed(mdh, i) else {
                (row.alpha, row.a) = self.twist(mdh, i);
                continue;
            };
            let Unskewed { before: (turn, shift), alpha, a, behind } = unskewed;
            *row = DhRow::new(alpha, a, row.d + behind.1, row.theta + behind.0);
            match i.checked_sub(1) {
                Some(previous) => {
                    table.rows[previous].theta += turn;
                    table.rows[previous].d += shift;
                }
                None => table.base *= about_z(turn) * Translation3::new(0.0, 0.0, shift),
            }
        }
        table
    }
}

/// The transform D of eq. 1.
pub(in crate::kinematics) fn correction([x, y, z, rx, ry, rz]: [f64; FRAME_PARAMETERS]) -> Pose {
    let mut pose = Pose::translation(x, y, z);
    pose.rotation *= about_z(rz) * about_y(ry) * about_x(rx);
    pose
}

/// How a parameter moves all that comes behind it.
#[derive(Clone, Copy)]
enum Motion {
    /// Along a unit vector.
    Slide(Vector3<f64>),
    /// About a unit vector through a point.
    Turn(Vector3<f64>, Vector3<f64>),
}

impl Motion {
    /// Velocity of the tool center point [m/rad, 1], then angular velocity [1, 1/m] (eq. 2, 3).
    fn velocity(self, tool: &Vector3<f64>) -> [f64; 6] {
        let (linear, angular) = match self {
            Self::Slide(along) => (along, Vector3::zeros()),
            Self::Turn(about, through) => (about.cross(&(tool - through)), about),
        };
        [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
    }
}

impl<const N: usize> Chain<N> {
    /// Pose of the corrected arm's tool for the joint angles `q` [rad] (eq. 1).
    pub(in crate::kinematics) fn corrected_fk(
        &self,
        corrections: &Corrections<N>,
        q: &[f64; N],
    ) -> Pose {
        self.corrected(corrections, q, &mut |_, _| ())
    }

    /// Write the motion of the tool with each parameter, in the order base, rows, tool: the rows of
    /// a Jacobian with [`Corrections::COUNT`] columns.
    pub(in crate::kinematics) fn parameter_jacobian(
        &self,
        corrections: &Corrections<N>,
        q: &[f64; N],
        jacobian: &mut [f64],
    ) {
        let width = Corrections::<N>::COUNT;
        // The tool center point is needed from the first parameter on.
        let tool = self.corrected_fk(corrections, q).translation.vector;
        self.corrected(corrections, q, &mut |parameter, motion| {
            for (row, value) in motion.velocity(&tool).into_iter().enumerate() {
                if let Some(element) = jacobian.get_mut(row * width + parameter) {
                    *element = value;
                }
            }
        });
    }

    /// Take a frame from the base to the tool (eq. 1); `meet` gets each parameter with its motion.
    fn corrected(
        &self,
        corrections: &Corrections<N>,
        q: &[f64; N],
        meet: &mut impl FnMut(usize, Motion),
    ) -> Pose {
        let mut frame = *self.first();
        correct(&mut frame, corrections.base, 0, meet);
        let q = self.uncoupled(q);
        for (i, (row, correction)) in self.mdh().rows.iter().zip(corrections.rows).enumerate() {
            let first = FRAME_PARAMETERS + ROW_PARAMETERS * i;
            let [alpha, a, d, theta, beta] = correction;
            let x = axis(&frame, 0);
            meet(first, Motion::Turn(x, frame.translation.vector));
            meet(first + 1, Motion::Slide(x));
            frame *= screw_x(row.alpha + alpha, row.a + a);
            meet(first + 4, Motion::Turn(axis(&frame, 1), frame.translation.vector));
            frame.rotation *= about_y(beta);
            let z = axis(&frame, 2);
            meet(first + 2, Motion::Slide(z));
            meet(first + 3, Motion::Turn(z, frame.translation.vector));
            frame.rotation *= about_z(row.theta + theta + q[i]);
            frame *= Translation3::new(0.0, 0.0, row.d + d);
        }
        frame *= *self.last();
        correct(&mut frame, corrections.tool, FRAME_PARAMETERS + ROW_PARAMETERS * N, meet);
        frame
    }
}

/// Multiply a frame by D of eq. 1.
fn correct(
    frame: &mut Pose,
    [x, y, z, rx, ry, rz]: [f64; FRAME_PARAMETERS],
    first: usize,
    meet: &mut impl FnMut(usize, Motion),
) {
    for along in 0..3 {
        meet(first + along, Motion::Slide(axis(frame, along)));
    }
    *frame *= Translation3::new(x, y, z);
    let origin = frame.translation.vector;
    for (about, rotation) in [(2, about_z(rz)), (1, about_y(ry)), (0, about_x(rx))] {
        meet(first + 3 + about, Motion::Turn(axis(frame, about), origin));
        frame.rotation *= rotation;
    }
}

fn axis(frame: &Pose, index: usize) -> Vector3<f64> {
    frame.rotation.matrix().column(index).into()
}

fn about_x(angle: f64) -> Rotation3<f64> {
    screw_x(angle, 0.0).rotation
}

pub(in crate::kinematics) fn about_y(angle: f64) -> Rotation3<f64> {
    let (sin, cos) = constant_sin_cos(angle);
    Rotation3::from_matrix_unchecked(Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos))
}

pub(in crate::kinematics) fn about_z(angle: f64) -> Rotation3<f64> {
    let (sin, cos) = constant_sin_cos(angle);
    Rotation3::from_matrix_unchecked(Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0))
}
