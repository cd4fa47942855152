//! The stored geometry of an arm with a spherical shoulder, and its measurement from a modified
//! Denavit-Hartenberg table.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Rotation3, Vector3};

use super::elbow::Links;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{Mdh, screw_x};
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::recognition::{JointFrame, angle, axes, rotation_pose};
use crate::kinematics::thresholds::FORM_TOLERANCE;
use crate::report::{Pattern, Relation, UnknownStructure};

/// The geometry between the shoulder, where axes 1, 2 and 3 meet, and the flange.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SphericalShoulder {
    pub(super) links: Links,
    /// Its last frame is the frame of joint 7: the transform after it is constant.
    pub(super) joint_map: JointMap<7>,
    /// From the frame of joint 7 at theta_7 = 0 to the hand, at the intersection of axes 5 and 6.
    pub(super) t_seven_hand: Pose,
}

impl SphericalShoulder {
    pub(super) fn theta(&self, q: &[f64; 7]) -> [f64; 7] {
        self.joint_map.theta(q)
    }

    /// Distance of the shoulder from the plane of axes 5 and 6 (eq. 60), signed [m].
    pub(super) fn aside(&self, q: &[f64; 7]) -> f64 {
        let [_, _, _, theta_4, theta_5, ..] = self.theta(q);
        self.links.elbow_at(theta_4).across * theta_5.cos()
    }

    /// The hand with joint 7 at `q7`, from the frame of joint 7 before its rotation (eq. 52).
    pub(crate) fn hand(&self, t_shoulder_seven: &Pose, q7: f64) -> Pose {
        let theta_7 = self.joint_map.signs[6] * q7 - self.joint_map.offsets[6];
        let unturned = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta_7);
        t_shoulder_seven * unturned * self.t_seven_hand
    }
}

/// The conditions of a spherical shoulder, an elbow that may be offset either way, and a forearm
/// that ends where axis 6 intersects it.
pub(crate) static PATTERN: Pattern = Pattern {
    name: "spherical shoulder",
    title: "a spherical shoulder and an offset elbow",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Perpendicular, (2, 3)),
        (Relation::Perpendicular, (3, 4)),
        (Relation::Perpendicular, (4, 5)),
        (Relation::Perpendicular, (5, 6)),
        (Relation::Meeting, (1, 2)),
        (Relation::Meeting, (2, 3)),
        (Relation::Meeting, (1, 3)),
        (Relation::Meeting, (5, 6)),
        (Relation::Coplanar, (3, 5)),
    ],
};

/// Measure the geometry in the frames at q = 0 (docs/theory/spherical_shoulder.md, section 8). The
/// rows give the lengths, so that none is lost to rounding; the frames give the directions.
pub(super) fn measure(mdh: &Mdh<7>) -> Result<SphericalShoulder, UnknownStructure> {
    let rows = &mdh.rows;
    let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
    let [f1, f2, f3, f4, f5, f6, _] =
        chain.link_frames(&[0.0; 7]).0.map(|pose| JointFrame::of(&pose));

    let sign_1 = if f1.z.z < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let (up, side) = (f1.z * sign_1, f2.z);
    let forward = side.cross(&up);

    let (sign_3, c3) = (sign_of(rows[2].d), rows[2].d.abs());
    let upper_arm = f3.z * sign_3;
    let theta_2 = angle(&upper_arm, &up, &forward);

    // Axis 4 is in front of axis 3; where they intersect, joint 4 bends the arm forwards.
    let offset = rows[3].a.abs() > FORM_TOLERANCE;
    let front = if offset { f3.x * sign_of(rows[3].a) } else { f4.z.cross(&upper_arm) };
    let axis_4 = upper_arm.cross(&front);
    let sign_4 = sign_of(f4.z.dot(&axis_4));
    let theta_3 = angle(&axis_4, &side, &upper_arm.cross(&side));

    let (sign_5, c5) = (sign_of(rows[4].d), rows[4].d.abs());
    let forearm = f5.z * sign_5;
    let theta_4 = angle(&forearm, &upper_arm, &front);
    let a4 = rows[4].a * f4.x.dot(&axis_4.cross(&forearm));

    let sign_6 = if f6.z.dot(&axis_4) < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let axis_6 = f6.z * sign_6;
    let theta_5 = angle(&axis_6, &axis_4, &forearm.cross(&axis_4));

    let links = Links::new([rows[3].a * f3.x.dot(&front), c3, a4, c5]);
    let lengths = [
        ("upper arm (distance of axis 4 from the shoulder)", links.upper),
        ("forearm (distance of axis 6 from axis 4)", links.forearm),
    ];
    PATTERN.check_lengths(lengths)?;
    let hand_at_zero = axes(&axis_6.cross(&forearm), &axis_6, &forearm);
    let t_hand_six = rotation_pose(hand_at_zero.transpose() * axes(&f6.x, &f6.y, &f6.z))
        * translation_z(rows[5].d);
    let mut t_base_shoulder = rotation_pose(axes(&forward, &side, &up));
    t_base_shoulder.translation.vector = f1.origin;
    let t_hand_seven = t_hand_six * screw_x(rows[6].alpha, rows[6].a) * translation_z(rows[6].d);
    Ok(SphericalShoulder {
        links,
        joint_map: JointMap {
            signs: [sign_1, 1.0, sign_3, sign_4, sign_5, sign_6, 1.0],
            offsets: [0.0, -theta_2, -theta_3, -theta_4, -theta_5, 0.0, -rows[6].theta],
            coupling: 0.0,
            t_base_shoulder: mdh.base * t_base_shoulder,
            t_wrist_flange: mdh.flange,
        },
        t_seven_hand: t_hand_seven.inverse(),
    })
}
