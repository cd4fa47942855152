//! Finding an ortho-parallel basis with a spherical wrist in a modified Denavit-Hartenberg table.

use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use crate::error::{Error, ModelFault};
use crate::kinematics::chain::Chain;
use crate::kinematics::dh::Mdh;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::thresholds::{FORM_TOLERANCE, LEAST_LINK};

/// How two axes of a known form stand to one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// At right angles.
    Perpendicular,
    /// Parallel.
    Parallel,
    /// Meeting in a point.
    Meeting,
}

/// A condition that an arm does not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// How the axes should stand.
    pub relation: Relation,
    /// The axes, from 1.
    pub axes: (usize, usize),
    /// How far they are off: an angle [rad] or, for axes that should meet, a distance [m].
    pub off: f64,
}

/// The conditions of an ortho-parallel basis with a spherical wrist. Axes 4 and 6 meet axis 5 in one point.
const FORM: [(Relation, (usize, usize)); 8] = [
    (Relation::Perpendicular, (1, 2)),
    (Relation::Parallel, (2, 3)),
    (Relation::Perpendicular, (3, 4)),
    (Relation::Perpendicular, (4, 5)),
    (Relation::Perpendicular, (5, 6)),
    (Relation::Meeting, (4, 5)),
    (Relation::Meeting, (5, 6)),
    (Relation::Meeting, (4, 6)),
];

/// Every condition that keeps an arm from having a closed form here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotRecognised {
    joints: usize,
    /// How far each condition of the form is off; zero where it is met.
    off: [f64; FORM.len()],
}

impl NotRecognised {
    /// An arm whose number of joints alone rules a closed form out.
    pub(crate) fn joint_count(joints: usize) -> Self {
        Self { joints, off: [0.0; FORM.len()] }
    }

    /// The conditions that are not met.
    pub fn conditions(&self) -> impl Iterator<Item = Condition> {
        let off = FORM.into_iter().zip(self.off).filter(|(_, off)| *off > 0.0);
        off.map(|((relation, axes), off)| Condition { relation, axes, off })
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { relation, axes: (i, j), off } = *self;
        match relation {
            Relation::Perpendicular => write!(f, "axes {i} and {j} must be at right angles, they are {:.6} deg off", off.to_degrees()),
            Relation::Parallel => write!(f, "axes {i} and {j} must be parallel, they are {:.6} deg off", off.to_degrees()),
            Relation::Meeting => write!(f, "axes {i} and {j} must meet, they pass {:.6} mm apart", off * 1e3),
        }
    }
}

impl fmt::Display for NotRecognised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.joints != 6 {
            return write!(f, "{} joints, the known forms have 6", self.joints);
        }
        for (i, condition) in self.conditions().enumerate() {
            write!(f, "{}{condition}", if i == 0 { "for a spherical wrist on an ortho-parallel base, " } else { "; " })?;
        }
        Ok(())
    }
}

/// The table with what is within [`FORM_TOLERANCE`] of the form made exactly so, and the geometry of the arm.
pub(crate) fn recognise(mdh: &Mdh<6>) -> Result<(Mdh<6>, SphericalWrist), Error> {
    let mut squared = square_up(mdh).map_err(ModelFault::NoClosedForm)?;
    let mut geometry = measure(&squared)?;
    if geometry.b.abs() <= FORM_TOLERANCE {
        // The offsets of rows 2 and 3 along the parallel axes cancel.
        squared.rows[2].d = -squared.rows[1].d * geometry.signs[1] * geometry.signs[2];
        geometry.b = 0.0;
    }
    Ok((squared, geometry))
}

/// Checks the form on the rows: row `i + 1` holds the angle and the distance between axes `i` and `i + 1`.
fn square_up(mdh: &Mdh<6>) -> Result<Mdh<6>, NotRecognised> {
    let mut squared = mdh.clone();
    let mut failed = NotRecognised::joint_count(6);
    for ((relation, axes), failed) in FORM.into_iter().zip(&mut failed.off) {
        let row = &mut squared.rows[axes.0];
        let alpha = row.alpha;
        let (value, exact) = match (relation, axes) {
            (Relation::Parallel, _) => (&mut row.alpha, nearest_of(alpha, 0.0)),
            (Relation::Perpendicular, _) => (&mut row.alpha, nearest_of(alpha, FRAC_PI_2)),
            // Between its neighbours' feet on it, axis 5 runs for d of its own row, which is the row before that of axis 6.
            (Relation::Meeting, (4, 6)) => (&mut row.d, 0.0),
            (Relation::Meeting, _) => (&mut row.a, 0.0),
        };
        let off = (*value - exact).abs();
        if off > FORM_TOLERANCE {
            *failed = off;
        } else {
            *value = exact;
        }
    }
    if failed.conditions().next().is_none() { Ok(squared) } else { Err(failed) }
}

/// The angle nearest to `alpha` that is `base` and half turns.
fn nearest_of(alpha: f64, base: f64) -> f64 {
    base + PI * ((alpha - base) / PI).round()
}

/// Reads the geometry off the frames at q = 0 (docs/ik_derivation.md, section 7). Lengths come from the rows, so that none is lost to
/// rounding; the frames give the directions.
fn measure(mdh: &Mdh<6>) -> Result<SphericalWrist, Error> {
    let rows = &mdh.rows;
    let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
    let [f1, f2, f3, f4, f5, f6] = chain.link_frames(&[0.0; 6]).0.map(|pose| Frame::of(&pose));

    // The shoulder: z up, x to where the arm stands off axis 1, or to where it faces at q1 = 0 when it does not.
    let sign_1 = if f1.z.z < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let up = f1.z * sign_1;
    let forward = f1.x * facing(rows[1].a, &f1.x);
    let side = up.cross(&forward);
    let (sign_2, sign_3) = (sign_of(f2.z.dot(&side)), sign_of(f3.z.dot(&side)));

    let c2 = rows[2].a.abs();
    let upper_arm = f2.x * sign_of(rows[2].a);
    let theta_2 = angle(&upper_arm, &up, &forward);

    let (sign_4, c3) = (sign_of(rows[3].d), rows[3].d.abs());
    let forearm = f4.z * sign_4;
    let a2 = rows[3].a * f3.x.dot(&side.cross(&forearm));
    let theta_3 = angle(&forearm, &up, &forward) - theta_2;

    let sign_5 = if f5.z.dot(&side) < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let axis_5 = f5.z * sign_5;
    let theta_4 = angle(&axis_5, &side, &forearm.cross(&side));

    let sign_6 = sign_of(rows[5].d);
    let approach = f6.z * sign_6;
    let theta_5 = angle(&approach, &forearm, &axis_5.cross(&forearm));

    for (field, value) in
        [("upper arm (distance of axes 2 and 3)", c2), ("forearm (distance of the wrist centre from axis 3)", a2.hypot(c3))]
    {
        if value < LEAST_LINK {
            return Err(ModelFault::TooShort { field, value, bound: LEAST_LINK }.into());
        }
    }
    let wrist_at_zero = axes(&axis_5.cross(&approach), &axis_5, &approach);
    let t_wrist_last = rotation_pose(wrist_at_zero.transpose() * axes(&f6.x, &f6.y, &f6.z)) * translation_z(rows[5].d);
    Ok(SphericalWrist {
        a1: rows[1].a * f1.x.dot(&forward),
        a2,
        b: sign_2 * rows[1].d + sign_3 * rows[2].d,
        c2,
        c3,
        k: a2.hypot(c3),
        signs: [sign_1, sign_2, sign_3, sign_4, sign_5, sign_6],
        offsets: [0.0, -theta_2, -theta_3, -theta_4, -theta_5, 0.0],
        t_base_shoulder: mdh.base * shoulder_pose(&f1, &forward, &side, &up),
        t_wrist_flange: t_wrist_last * mdh.flange,
        extent: 0.0,
    }
    .standing_between(&Pose::identity(), &Pose::identity()))
}

/// 1 or -1: which way of axis x the arm faces.
fn facing(a1: f64, x: &Vector3<f64>) -> f64 {
    if a1.abs() > FORM_TOLERANCE {
        return sign_of(a1);
    }
    [x.x, x.y].into_iter().find(|component| component.abs() > FORM_TOLERANCE).map_or(1.0, sign_of)
}

fn sign_of(value: f64) -> f64 {
    if value < 0.0 { -1.0 } else { 1.0 }
}

/// The angle of a unit vector from `zero` towards `quarter`.
fn angle(direction: &Vector3<f64>, zero: &Vector3<f64>, quarter: &Vector3<f64>) -> f64 {
    direction.dot(quarter).atan2(direction.dot(zero))
}

fn axes(x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[*x, *y, *z])
}

fn rotation_pose(rotation: Matrix3<f64>) -> Pose {
    IsometryMatrix3::from_parts(Translation3::identity(), Rotation3::from_matrix_unchecked(rotation))
}

fn shoulder_pose(f1: &Frame, forward: &Vector3<f64>, side: &Vector3<f64>, up: &Vector3<f64>) -> Pose {
    let mut pose = rotation_pose(axes(forward, side, up));
    pose.translation.vector = f1.origin;
    pose
}

/// A frame as its axes and its origin.
struct Frame {
    x: Vector3<f64>,
    y: Vector3<f64>,
    z: Vector3<f64>,
    origin: Vector3<f64>,
}

impl Frame {
    fn of(pose: &Pose) -> Self {
        let axes = pose.rotation.matrix();
        Self { x: axes.column(0).into(), y: axes.column(1).into(), z: axes.column(2).into(), origin: pose.translation.vector }
    }
}
