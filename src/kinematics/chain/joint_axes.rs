//! A modified Denavit-Hartenberg table from the lines of the joint axes.
//!
//! Reference: Craig, Introduction to Robotics, 2005, section 3.4: x of frame `i` runs along the
//! common normal of axes `i` and `i + 1`.

use core::f64::consts::PI;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{Error, ModelFault};
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::thresholds::{FORM_TOLERANCE, MOST_LENGTH};

/// Cosine above which a direction is too near an axis to be made perpendicular to it [1]: of two
/// perpendicular directions, one is below.
const ALONG: f64 = 0.9;

/// Axis of a revolute joint at zero joint angles, in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointAxis {
    /// The direction about which the joint turns; its length has no effect.
    pub direction: [f64; 3],
    /// A point on the axis [m].
    pub point: [f64; 3],
}

impl<const N: usize> Mdh<N> {
    /// The table of an arm from its joint axes and the pose of its tip, all at zero joint angles
    /// and in the base frame.
    ///
    /// z of frame `i` is axis `i` with its direction. x runs along the common normal to the next
    /// axis, less than a right angle from the previous x where there is a choice. Between parallel
    /// axes `d` is zero. An axis 1 parallel to z of the base is in the first row, except for its
    /// distance along y; any other is in `base`. The last row ends at the height of the tip;
    /// `flange` has the rest.
    ///
    /// Axes within 1e-9 rad of parallel are treated as parallel, and within 1e-9 m of intersecting
    /// as intersecting: the common normal of nearly parallel axes is far away.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a number is not finite or too large, a direction has no length,
    /// or two axes are so nearly parallel that their common normal is more than [`MOST_LENGTH`]
    /// away; [`Error::InvalidPose`] when the tip is no rigid transform.
    pub fn from_joint_axes(axes: &[JointAxis; N], t_base_tip: &Pose) -> Result<Self, Error> {
        let tip = checked_pose(t_base_tip)?;
        let mut lines = [Line { z: Vector3::zeros(), point: Vector3::zeros() }; N];
        for (i, (line, axis)) in lines.iter_mut().zip(axes).enumerate() {
            *line = Line::new(i + 1, axis)?;
        }
        let (base, mut normal) = lines.first().map_or((Pose::identity(), Normal::NONE), Line::root);
        let mut rows = [DhRow::default(); N];
        for (i, row) in rows.iter_mut().enumerate() {
            let next = match lines.get(i + 1) {
                Some(next) => lines[i].normal_to(next, &normal),
                None => lines[i].normal_to_tip(&tip),
            };
            let farthest = next.from.abs().max(next.to.abs());
            if farthest > MOST_LENGTH {
                let off = next.alpha.abs().min(PI - next.alpha.abs());
                return Err(ModelFault::NearlyParallel {
                    axes: (i + 1, i + 2),
                    off,
                    distance: farthest,
                    bound: MOST_LENGTH,
                    snap: None,
                }
                .into());
            }
            *row = DhRow::new(
                normal.alpha,
                normal.a,
                next.from - normal.to,
                turn(&normal.x, &next.x, &lines[i].z),
            );
            normal = next;
        }
        let flange = lines.last().map_or(tip, |last| last.flange(&normal, &tip));
        Ok(Self { base, rows, flange })
    }
}

#[derive(Clone, Copy)]
struct Line {
    /// Unit direction.
    z: Vector3<f64>,
    /// A point on it [m].
    point: Vector3<f64>,
}

/// The common normal of an axis and the next one: the part `Rx(alpha) Tx(a)` of the next row.
struct Normal {
    /// Unit direction.
    x: Vector3<f64>,
    /// Where it leaves the axis, measured from the axis' point [m].
    from: f64,
    /// Where it meets the next axis, measured from that axis' point [m].
    to: f64,
    a: f64,
    alpha: f64,
}

impl Normal {
    const NONE: Self =
        Self { x: Vector3::new(1.0, 0.0, 0.0), from: 0.0, to: 0.0, a: 0.0, alpha: 0.0 };
}

impl Line {
    fn new(axis: usize, given: &JointAxis) -> Result<Self, Error> {
        for value in given.direction {
            ModelFault::check("direction of axis", axis, value, f64::MAX)?;
        }
        for value in given.point {
            ModelFault::check("point of axis", axis, value, MOST_LENGTH)?;
        }
        let z = unit(given.direction).ok_or(ModelFault::AxisDirection { axis })?;
        Ok(Self { z, point: Vector3::from(given.point) })
    }

    /// The transform before the first row, and the twist and length of that row.
    fn root(&self) -> (Pose, Normal) {
        let Self { z, point } = self;
        if z.x.hypot(z.y) > FORM_TOLERANCE {
            let to = -point.dot(z);
            let x = across(z, &Matrix3::identity());
            let stand =
                IsometryMatrix3::from_parts(Translation3::from(point + z * to), frame(&x, z));
            return (stand, Normal { x, to, ..Normal::NONE });
        }
        let to = -point.z * z.z;
        let foot = point + z * to;
        let base = Pose::translation(0.0, nearly(foot.y), 0.0);
        (
            base,
            Normal {
                to,
                a: nearly(foot.x),
                alpha: if z.z < 0.0 { PI } else { 0.0 },
                ..Normal::NONE
            },
        )
    }

    /// The common normal to the next axis; `before` is the one from the previous axis. Adding zero
    /// removes minus zero.
    fn normal_to(&self, next: &Self, before: &Normal) -> Normal {
        let between = next.point - self.point;
        let cross = self.z.cross(&next.z);
        let (sin, cos) = (cross.norm(), self.z.dot(&next.z));
        if sin <= FORM_TOLERANCE {
            return self.normal_to_parallel(next, before, &between, cos);
        }
        let normal = cross / sin;
        let distance = nearly(between.dot(&normal));
        let sign = self.facing(&normal, distance, before);
        Normal {
            x: square_to(&self.z, &(normal * sign)),
            from: between.cross(&next.z).dot(&normal) / sin,
            to: between.cross(&self.z).dot(&normal) / sin,
            a: distance * sign + 0.0,
            alpha: (sin * sign).atan2(cos),
        }
    }

    /// Parallel axes have many common normals: choose the one that makes `d` zero. For coincident
    /// axes, keep x.
    fn normal_to_parallel(
        &self,
        next: &Self,
        before: &Normal,
        between: &Vector3<f64>,
        cos: f64,
    ) -> Normal {
        let aside = between - self.z * between.dot(&self.z);
        let distance = nearly(aside.norm());
        let normal = if distance > 0.0 { aside / distance } else { before.x };
        let sign = self.facing(&normal, distance, before);
        let from = before.to;
        Normal {
            x: square_to(&self.z, &(normal * sign)),
            from,
            to: (self.z * from - between).dot(&next.z),
            a: distance * sign + 0.0,
            alpha: if cos < 0.0 { PI } else { 0.0 },
        }
    }

    /// The sign of x along a normal, 1 or -1: less than a right angle from the previous x; at a
    /// right angle, towards the next axis; where the axes intersect, a right angle on.
    fn facing(&self, normal: &Vector3<f64>, distance: f64, before: &Normal) -> f64 {
        let choices = [normal.dot(&before.x), distance, before.x.cross(normal).dot(&self.z)];
        let chosen = choices.into_iter().find(|choice| choice.abs() > FORM_TOLERANCE);
        if chosen.is_some_and(|choice| choice < 0.0) { -1.0 } else { 1.0 }
    }

    /// The last frame is at the height of the tip, with the tip's x where possible.
    fn normal_to_tip(&self, tip: &Pose) -> Normal {
        let from = (tip.translation.vector - self.point).dot(&self.z);
        Normal { x: across(&self.z, tip.rotation.matrix()), from, ..Normal::NONE }
    }

    /// The transform that remains after the last row.
    fn flange(&self, last: &Normal, tip: &Pose) -> Pose {
        let t_base_last = frame(&last.x, &self.z);
        let aside =
            t_base_last.inverse() * (tip.translation.vector - self.point - self.z * last.from);
        IsometryMatrix3::from_parts(
            Translation3::new(aside.x, aside.y, 0.0),
            t_base_last.inverse() * tip.rotation,
        )
    }
}

/// The direction with length one; exact along x, y and z.
pub fn unit(direction: [f64; 3]) -> Option<Vector3<f64>> {
    // Scaled first: squares of very small and very large numbers lose their digits.
    let largest = direction.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let scaled = Vector3::from(direction.map(|value| value / largest));
    (largest > 0.0).then(|| scaled / scaled.norm())
}

/// The length, or zero if it is within the tolerance [m].
fn nearly(length: f64) -> f64 {
    if length.abs() > FORM_TOLERANCE { length } else { 0.0 }
}

/// The angle about `z` from one direction to another, in (-pi, pi] [rad].
fn turn(from: &Vector3<f64>, to: &Vector3<f64>, z: &Vector3<f64>) -> f64 {
    // Minus zero would turn a half turn into minus pi.
    (from.cross(to).dot(z) + 0.0).atan2(from.dot(to))
}

/// The unit direction perpendicular to `z` that is nearest to `x`.
fn square_to(z: &Vector3<f64>, x: &Vector3<f64>) -> Vector3<f64> {
    let square = x - z * x.dot(z);
    square / square.norm()
}

/// x of a rotation made perpendicular to `z`; its y where x runs along `z`.
fn across(z: &Vector3<f64>, rotation: &Matrix3<f64>) -> Vector3<f64> {
    let [x, y] = [0, 1].map(|column| Vector3::from(rotation.column(column)));
    square_to(z, if x.dot(z).abs() < ALONG { &x } else { &y })
}

fn frame(x: &Vector3<f64>, z: &Vector3<f64>) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[*x, z.cross(x), *z]))
}
