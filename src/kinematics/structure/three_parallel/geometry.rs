//! The stored geometry of an arm with three parallel axes, and its measurement from a modified
//! Denavit-Hartenberg table.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::recognition::{JointFrame, angle, axes, rotation_pose};
use crate::kinematics::thresholds::FORM_TOLERANCE;
use crate::report::{Pattern, Relation, UnknownStructure};

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist, the
/// intersection of axes 5 and 6.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ThreeParallel {
    /// The arm up to axis 4.
    pub(super) planar: PlanarArm,
    /// Distance of the wrist from axis 4, along axis 5 [m].
    pub(super) d5: f64,
    pub(super) joint_map: JointMap<6>,
}

impl ThreeParallel {
    /// x of the wrist in the plane of the arm (eq. 41) [m].
    pub(super) fn x_of_wrist(&self, q: &[f64; 6]) -> f64 {
        let [_, theta_2, theta_3, theta_4, ..] = self.joint_map.theta(q);
        let [_, x] = self.planar.elbow_and_end(theta_2.sin_cos(), theta_3.sin_cos());
        x + self.d5 * (theta_2 + theta_3 + theta_4).sin()
    }
}

/// The conditions of three parallel axes between a base axis and two wrist axes, each perpendicular
/// to the next.
pub(crate) static PATTERN: Pattern = Pattern {
    name: "three parallel axes",
    title: "three parallel axes",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Parallel, (2, 3)),
        (Relation::Parallel, (3, 4)),
        (Relation::Perpendicular, (4, 5)),
        (Relation::Perpendicular, (5, 6)),
        (Relation::Meeting, (4, 5)),
        (Relation::Meeting, (5, 6)),
    ],
};

/// Measure the geometry in the frames at q = 0 (docs/theory/three_parallel.md, section 6). The rows
/// give the lengths, so that none is lost to rounding; the frames give the directions.
pub(super) fn measure(mdh: &Mdh<6>) -> Result<ThreeParallel, UnknownStructure> {
    let rows = &mdh.rows;
    let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
    let [f1, f2, f3, f4, f5, f6] = chain.link_frames(&[0.0; 6]).0.map(|pose| JointFrame::of(&pose));

    // The shoulder: z up, y to the side of the wrist.
    let sign_1 = if f1.z.z < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let up = f1.z * sign_1;
    let lateral =
        rows[1].d + sign_of(f3.z.dot(&f2.z)) * rows[2].d + sign_of(f4.z.dot(&f2.z)) * rows[3].d;
    let side = f2.z * sign_of(lateral);
    let forward = side.cross(&up);
    let [sign_2, sign_3, sign_4] = [&f2, &f3, &f4].map(|frame| sign_of(frame.z.dot(&side)));

    let (upper_arm, forearm) = (f2.x * sign_of(rows[2].a), f3.x * sign_of(rows[3].a));
    let (theta_2, theta_23) = (angle(&upper_arm, &up, &forward), angle(&forearm, &up, &forward));

    let (sign_5, sign_6) = (sign_of(rows[4].d), sign_of(rows[5].d));
    let (axis_5, approach) = (f5.z * sign_5, f6.z * sign_6);
    let theta_4 = angle(&axis_5, &up, &forward) - theta_23;
    let theta_5 = angle(&approach, &side, &axis_5.cross(&side));

    let (b, c2, c3) = (lateral.abs(), rows[2].a.abs(), rows[3].a.abs());
    PATTERN.check_lengths([
        ("upper arm (distance of axes 2 and 3)", c2),
        ("forearm (distance of axes 3 and 4)", c3),
        ("lateral offset (of the wrist from the plane through axis 1 that is square to axis 2)", b),
    ])?;
    let wrist_at_zero = axes(&approach.cross(&axis_5), &approach, &axis_5);
    let t_wrist_last = rotation_pose(wrist_at_zero.transpose() * axes(&f6.x, &f6.y, &f6.z))
        * translation_z(rows[5].d);
    let mut t_base_shoulder = rotation_pose(axes(&forward, &side, &up));
    t_base_shoulder.translation.vector = f1.origin;
    Ok(ThreeParallel {
        planar: PlanarArm::new([rows[1].a * f1.x.dot(&forward), 0.0, b, c2, c3]),
        d5: rows[4].d.abs(),
        joint_map: JointMap {
            signs: [sign_1, sign_2, sign_3, sign_4, sign_5, sign_6],
            offsets: [0.0, -theta_2, theta_2 - theta_23, -theta_4, -theta_5, 0.0],
            coupling: 0.0,
            t_base_shoulder: mdh.base * t_base_shoulder,
            t_wrist_flange: t_wrist_last * mdh.flange,
        },
    })
}
