//! The stored geometry of an arm of five axes, and its measurement from a modified
//! Denavit-Hartenberg table.

use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::recognition::{JointFrame, angle, axes, rotation_pose};
use crate::kinematics::thresholds::FORM_TOLERANCE;
use crate::report::{Pattern, Relation, UnknownStructure};

/// The conditions of three parallel axes between a pan axis and a roll axis.
pub(super) static PATTERN: Pattern = Pattern {
    name: "pan, three parallel axes, roll",
    title: "an arm of five axes",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Parallel, (2, 3)),
        (Relation::Parallel, (3, 4)),
        (Relation::Perpendicular, (4, 5)),
    ],
};

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist, the point
/// of axis 5 that is nearest to axis 4.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Geometry {
    /// The arm up to axis 4.
    pub(super) planar: PlanarArm,
    /// Distance of axis 5 from axis 4 [m]; positive where axis 5, pointing forward, is below.
    pub(super) below: f64,
    pub(super) joint_map: JointMap<5>,
}

impl Geometry {
    /// Measure the frames at q = 0 (docs/theory/pan_roll.md, section 5). The rows give the lengths,
    /// so that none is lost to rounding; the frames give the directions.
    pub(super) fn measure(mdh: &Mdh<5>) -> Result<Self, UnknownStructure> {
        let rows = &mdh.rows;
        let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
        let (frames, flange) = chain.link_frames(&[0.0; 5]);
        let [f1, f2, f3, f4, f5] = frames.map(|pose| JointFrame::of(&pose));

        // The shoulder: z up, x to where the flange is.
        let sign_1 = if f1.z.z < -FORM_TOLERANCE { -1.0 } else { 1.0 };
        let up = f1.z * sign_1;
        let lateral =
            rows[1].d + sign_of(f3.z.dot(&f2.z)) * rows[2].d + sign_of(f4.z.dot(&f2.z)) * rows[3].d;
        let away = flange.translation.vector - f1.origin;
        let sign = sign_of(f2.z.cross(&up).dot(&away));
        let side = f2.z * sign;
        let forward = side.cross(&up);
        let [sign_2, sign_3, sign_4] = [&f2, &f3, &f4].map(|frame| sign_of(frame.z.dot(&side)));

        let (upper_arm, forearm) = (f2.x * sign_of(rows[2].a), f3.x * sign_of(rows[3].a));
        let (theta_2, theta_23) =
            (angle(&upper_arm, &up, &forward), angle(&forearm, &up, &forward));

        // Axis 5, towards the flange.
        let sign_5 = sign_of(rows[4].d + mdh.flange.translation.vector.z);
        let approach = f5.z * sign_5;
        let down = side.cross(&approach);
        let theta_4 = angle(&approach, &up, &forward) - theta_23;

        let (c2, c3) = (rows[2].a.abs(), rows[3].a.abs());
        PATTERN.check_lengths([
            ("upper arm (distance of axes 2 and 3)", c2),
            ("forearm (distance of axes 3 and 4)", c3),
        ])?;
        let wrist_at_zero = axes(&down, &side, &approach);
        let t_wrist_last = rotation_pose(wrist_at_zero.transpose() * axes(&f5.x, &f5.y, &f5.z))
            * translation_z(rows[4].d);
        let mut t_base_shoulder = rotation_pose(axes(&forward, &side, &up));
        t_base_shoulder.translation.vector = f1.origin;
        Ok(Self {
            planar: PlanarArm::new([rows[1].a * f1.x.dot(&forward), 0.0, sign * lateral, c2, c3]),
            below: rows[4].a * f4.x.dot(&down),
            joint_map: JointMap {
                signs: [sign_1, sign_2, sign_3, sign_4, sign_5],
                offsets: [0.0, -theta_2, theta_2 - theta_23, -theta_4, 0.0],
                coupling: 0.0,
                t_base_shoulder: mdh.base * t_base_shoulder,
                t_wrist_flange: t_wrist_last * mdh.flange,
            },
        })
    }
}
