//! An arm, and poses near the margins of its lanes.

use core::f64::consts::FRAC_PI_2;

use super::*;
use crate::kinematics::robot::Definition;
use crate::kinematics::structure::spherical_wrist::OpwParameters;

/// An arm, with the quantities that the margins are relative to.
pub(super) struct Arm {
    pub(super) name: &'static str,
    pub(super) robot: Robot<6>,
    pub(super) a1: f64,
    pub(super) b: f64,
    pub(super) c1: f64,
    pub(super) c2: f64,
    pub(super) k: f64,
    /// From the end of the planar arm to the wrist: zero if the wrist is spherical.
    pub(super) d5: f64,
    /// From the wrist to the flange.
    pub(super) t_wrist_flange: Pose,
    pub(super) signs: [f64; 6],
    pub(super) offsets: [f64; 6],
    pub(super) extent: f64,
}

impl Arm {
    pub(super) fn new(name: &'static str, robot: Robot<6>) -> Self {
        let ends = robot.base().translation.vector.norm() + robot.tool().translation.vector.norm();
        match *robot.definition() {
            Definition::Opw(OpwParameters { a1, a2, b, c1, c2, c3, c4, signs, offsets }) => {
                let k = a2.hypot(c3);
                let extent = a1.abs() + b.abs() + c1 + c2 + k + c4 + ends;
                let (t_wrist_flange, signs) = (translation_z(c4), signs.map(f64::from));
                Self {
                    name,
                    robot,
                    a1,
                    b,
                    c1,
                    c2,
                    k,
                    d5: 0.0,
                    t_wrist_flange,
                    signs,
                    offsets,
                    extent,
                }
            }
            // As `parallel_arm` or the maker defines it.
            Definition::Mdh(ref mdh) | Definition::Refined { ref mdh, .. } => {
                let rows = mdh.rows;
                let ([a1, c2, k], [c1, b, d5, d6]) =
                    ([1, 2, 3].map(|i| rows[i].a.abs()), [0, 3, 4, 5].map(|i| rows[i].d));
                let extent = a1 + b + c1 + c2 + k + d5 + d6 + ends;
                // For an arm of Universal Robots, joint 2 and joint 4 are zero a quarter turn from
                // upright.
                let quarter = if rows[2].a < 0.0 { -FRAC_PI_2 } else { 0.0 };
                let offsets = [0.0, quarter, 0.0, quarter, 0.0, 0.0];
                let t_wrist_flange = pose_from_euler_zyx([0.0, d6, 0.0], [0.0, 0.0, -FRAC_PI_2])
                    .unwrap()
                    * mdh.flange;
                Self {
                    name,
                    robot,
                    a1,
                    b,
                    c1,
                    c2,
                    k,
                    d5,
                    t_wrist_flange,
                    signs: [1.0; 6],
                    offsets,
                    extent,
                }
            }
        }
    }

    /// The pose for angles theta.
    pub(super) fn at(&self, theta: [f64; 6]) -> Pose {
        self.robot.fk(&core::array::from_fn(|i| self.signs[i] * (theta[i] + self.offsets[i])))
    }

    /// A pose with random orientation whose end of the planar arm is `x` from axis 1, along the
    /// plane of the arm, and `z` above the shoulder.
    pub(super) fn with_end_of_planar_arm(&self, x: f64, z: f64, random: &mut Rng) -> Pose {
        let phi = random.angle();
        let wrist = [x + self.d5 * phi.sin(), self.b, self.c1 + z + self.d5 * phi.cos()];
        // Axis 5 in the plane, along phi.
        let rotated = [[0.0, phi, 0.0], [random.angle(), 0.0, 0.0], [0.0, random.angle(), 0.0]]
            .map(|zyx| pose_from_euler_zyx([0.0; 3], zyx));
        let rotation =
            rotated.into_iter().fold(Pose::identity(), |product, turn| product * turn.unwrap());
        self.with_wrist(wrist, rotation, random)
    }

    pub(super) fn with_wrist(&self, wrist: [f64; 3], rotation: Pose, random: &mut Rng) -> Pose {
        let heading = pose_from_euler_zyx([0.0; 3], [random.angle(), 0.0, 0.0]).unwrap();
        let wrist = pose_from_euler_zyx(wrist, [0.0; 3]).unwrap() * rotation;
        self.robot.base() * heading * wrist * self.t_wrist_flange * self.robot.tool()
    }

    pub(super) fn anywhere(&self, random: &mut Rng) -> Pose {
        self.at([(); 6].map(|()| random.angle()))
    }

    pub(super) fn next_to_the_wrist_margin(&self, part: f64, random: &mut Rng) -> Pose {
        let off = (part * REGULAR_WRIST_SIN).asin();
        let theta_5 = random.sign() * if random.sign() > 0.0 { off } else { PI - off };
        self.at([
            random.angle(),
            random.angle(),
            random.angle(),
            random.angle(),
            theta_5,
            random.angle(),
        ])
    }

    pub(super) fn next_to_the_shoulder_margin(&self, part: f64, random: &mut Rng) -> Pose {
        let x = part * (REGULAR_SHOULDER * self.extent).max(10.0 * SHOULDER_MERGE);
        // Between folded and stretched, for both shoulders.
        let [shortest, longest] =
            [(self.c2 - self.k).abs() + self.d5 + 0.02, self.c2 + self.k - self.d5 - 0.02];
        let across = self.a1.abs() + x;
        let (least, most) = (
            (shortest * shortest - across * across).max(0.0).sqrt(),
            (longest * longest - across * across).sqrt(),
        );
        let wrist = [x, self.b, self.c1 + random.sign() * random.between(least, most)];
        let rotation =
            pose_from_euler_zyx([0.0; 3], [random.angle(), random.angle(), random.angle()])
                .unwrap();
        self.with_wrist(wrist, rotation, random)
    }

    /// Inside or outside the edge of reach, stretched or folded, of either shoulder.
    pub(super) fn next_to_the_edge_of_reach(&self, part: f64, random: &mut Rng) -> Pose {
        let (c2, k) = (self.c2, self.k);
        let m2 = random.sign()
            * part
            * 2.0
            * (REGULAR_REACH * self.extent).max(10.0 * REACH_TOLERANCE)
            * self.extent
            * c2
            * k;
        let (longest2, shortest2) = ((c2 + k).powi(2), (c2 - k).powi(2));
        let middle = c2 * c2 + k * k;
        // 4 m^2 = (longest^2 - r^2) (r^2 - shortest^2), a parabola over r^2 with its vertex at
        // `middle`.
        let half = ((longest2 - middle) * (middle - shortest2) - 4.0 * m2).sqrt();
        let folded = middle - half;
        let r = if random.sign() > 0.0 || folded <= 0.0 { middle + half } else { folded }.sqrt();
        loop {
            let (sin, cos) = random.angle().sin_cos();
            let x = self.a1 + r * sin;
            if x.abs() > 20.0 * REGULAR_SHOULDER * self.extent {
                return self.with_end_of_planar_arm(x, r * cos, random);
            }
        }
    }

    /// The slots computed in lanes; `None` if the pose is not regular or has no solution.
    pub(super) fn by_lanes(&self, pose: &Pose) -> Option<RegularAnswer<6>> {
        by_lanes(&self.robot, pose, f64::NAN)
    }

    pub(super) fn scalar(&self, pose: Pose) -> Solutions<6> {
        scalar(&self.robot, pose, f64::NAN)
    }
}
