//! Recognizes an ortho-parallel basis with a spherical wrist in a modified Denavit-Hartenberg
//! table.

use nalgebra::Vector3;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::SphericalWrist;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::recognition::{JointFrame, angle, axes, rotation_pose};
use crate::kinematics::thresholds::FORM_TOLERANCE;
use crate::report::{Pattern, Relation, UnknownStructure};

/// The conditions of an ortho-parallel basis with a spherical wrist. Axes 4 and 6 intersect axis 5
/// in one point.
pub(crate) static PATTERN: Pattern = Pattern {
    name: "spherical wrist",
    title: "a spherical wrist on an ortho-parallel base",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Parallel, (2, 3)),
        (Relation::Perpendicular, (3, 4)),
        (Relation::Perpendicular, (4, 5)),
        (Relation::Perpendicular, (5, 6)),
        (Relation::Meeting, (4, 5)),
        (Relation::Meeting, (5, 6)),
        (Relation::Meeting, (4, 6)),
    ],
};

/// Measure the geometry in the frames at q = 0 (docs/spherical_wrist.md, section 7). Lengths are
/// those of the rows, so that none is lost to rounding; the frames give the directions.
pub(super) fn measure(mdh: &mut Mdh<6>) -> Result<SphericalWrist, UnknownStructure> {
    let rows = mdh.rows;
    let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
    let [f1, f2, f3, f4, f5, f6] = chain.link_frames(&[0.0; 6]).0.map(|pose| JointFrame::of(&pose));

    // The shoulder: z up, x to the side on which the arm is offset from axis 1 or, without an
    // offset, to where it faces at q1 = 0.
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

    PATTERN.check_lengths([
        ("upper arm (distance of axes 2 and 3)", c2),
        ("forearm (distance of the wrist center from axis 3)", a2.hypot(c3)),
    ])?;
    let wrist_at_zero = axes(&axis_5.cross(&approach), &axis_5, &approach);
    let t_wrist_last = rotation_pose(wrist_at_zero.transpose() * axes(&f6.x, &f6.y, &f6.z))
        * translation_z(rows[5].d);
    let lateral = sign_2 * rows[1].d + sign_3 * rows[2].d;
    let b = if lateral.abs() <= FORM_TOLERANCE {
        // The offsets of rows 2 and 3 along the parallel axes cancel.
        mdh.rows[2].d = -rows[1].d * sign_2 * sign_3;
        0.0
    } else {
        lateral
    };
    Ok(SphericalWrist {
        planar: PlanarArm::new([rows[1].a * f1.x.dot(&forward), a2, b, c2, c3]),
        joint_map: JointMap {
            signs: [sign_1, sign_2, sign_3, sign_4, sign_5, sign_6],
            offsets: [0.0, -theta_2, -theta_3, -theta_4, -theta_5, 0.0],
            coupled: false,
            t_base_shoulder: mdh.base * shoulder_pose(&f1, &forward, &side, &up),
            t_wrist_flange: t_wrist_last * mdh.flange,
        },
    })
}

/// The direction along axis x that the arm faces, 1 or -1.
fn facing(a1: f64, x: &Vector3<f64>) -> f64 {
    if a1.abs() > FORM_TOLERANCE {
        return sign_of(a1);
    }
    [x.x, x.y].into_iter().find(|component| component.abs() > FORM_TOLERANCE).map_or(1.0, sign_of)
}

fn shoulder_pose(
    f1: &JointFrame,
    forward: &Vector3<f64>,
    side: &Vector3<f64>,
    up: &Vector3<f64>,
) -> Pose {
    let mut pose = rotation_pose(axes(forward, side, up));
    pose.translation.vector = f1.origin;
    pose
}
