//! An arm with three parallel axes by its lengths: its table, and its geometry once more, from its
//! joints alone.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{DhRow, Mdh, Pose, Robot};
use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

/// Lengths [m], signs and offsets of an arm with three parallel axes: theta = sign * q - offset
/// is zero when the arm is upright, axis 5 up and axis 6 to the side.
#[derive(Clone, Debug)]
pub struct ParallelArm {
    /// Distance of axis 2 from axis 1.
    pub a1: f64,
    /// Distances of axes 3, 4 and 5 from the foot of axis 1 on axis 2, along it: where they are
    /// drawn; only their sum, the distance of the wrist from the plane through axis 1, counts.
    pub b: [f64; 3],
    /// Height of axis 2.
    pub c1: f64,
    /// Upper arm.
    pub c2: f64,
    /// Forearm.
    pub c3: f64,
    /// Wrist from axis 4.
    pub d5: f64,
    /// Flange from the wrist.
    pub d6: f64,
    pub signs: [f64; 6],
    pub offsets: [f64; 6],
    /// The transforms before axis 1 and after the flange, whose y is axis 6.
    pub base: Pose,
    pub flange: Pose,
}

/// The target of the planar arm for a pose for one shoulder and one wrist.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// End of the planar arm, from axis 2, forward and up [m].
    pub end: [f64; 2],
    /// By how much it is too far (positive) or too near (negative) [m].
    pub missing: f64,
}

impl ParallelArm {
    /// A catalog arm of Universal Robots, by the figures of its table.
    pub fn universal(name: &str) -> (Self, Robot<6>) {
        let robot: Robot<6> = Robot::named(name).unwrap();
        let rows = &robot.mdh().rows;
        let arm = Self {
            a1: 0.0,
            b: [0.0, 0.0, rows[3].d],
            c1: rows[0].d,
            c2: -rows[2].a,
            c3: -rows[3].a,
            d5: rows[4].d,
            d6: rows[5].d,
            signs: [1.0; 6],
            offsets: [0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0],
            base: turn(Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0))),
            flange: turn(quarters_about_x(3)),
        };
        (arm, robot)
    }

    /// A robot from the table.
    pub fn robot(&self) -> Robot<6> {
        Robot::from_mdh(self.mdh()).unwrap()
    }

    /// The joint angles for theta.
    pub fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| self.signs[i] * (theta[i] + self.offsets[i]))
    }

    pub fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| self.signs[i] * q[i] - self.offsets[i])
    }

    /// The sum of the lengths that contribute to a position [m].
    pub fn reach(&self) -> f64 {
        let along_axis_2: f64 = self.b.iter().map(|b| b.abs()).sum();
        let ends = self.base.translation.vector.norm() + self.flange.translation.vector.norm();
        self.a1.abs()
            + along_axis_2
            + self.c1
            + self.c2
            + self.c3
            + self.d5.abs()
            + self.d6.abs()
            + ends
    }

    pub fn b(&self) -> f64 {
        self.b.iter().sum()
    }

    /// The table. Its zero pose and the directions of its joints follow the offsets and the signs:
    /// a joint of sign -1 has its frame flipped, `Rz(-q) = Rx(pi) Rz(q) Rx(-pi)`.
    pub fn mdh(&self) -> Mdh<6> {
        let [b2, b3, b4] = self.b;
        let mut rows = [
            DhRow::new(0.0, 0.0, self.c1, 0.0),
            DhRow::new(-FRAC_PI_2, self.a1, b2, -FRAC_PI_2),
            DhRow::new(0.0, self.c2, b3, 0.0),
            DhRow::new(0.0, self.c3, b4, FRAC_PI_2),
            DhRow::new(FRAC_PI_2, 0.0, self.d5, 0.0),
            DhRow::new(-FRAC_PI_2, 0.0, self.d6, 0.0),
        ];
        let mut turned = false;
        for (i, row) in rows.iter_mut().enumerate() {
            row.theta -= self.offsets[i];
            let turns = self.signs[i] < 0.0;
            if turns != turned {
                row.alpha += PI;
            }
            if turns {
                (row.d, row.theta) = (-row.d, -row.theta);
            }
            turned = turns;
        }
        Mdh {
            base: self.base,
            rows,
            flange: turn(quarters_about_x(if turned { 3 } else { 1 })) * self.flange,
        }
    }

    /// The wrist of joint angles from axis 1, along the plane of the arm [m].
    pub fn x(&self, theta: &[f64; 6]) -> f64 {
        let [_, t2, t3, t4, ..] = *theta;
        self.a1 + self.c2 * t2.sin() + self.c3 * (t2 + t3).sin() + self.d5 * (t2 + t3 + t4).sin()
    }

    /// The end of the planar arm, on axis 4, from axis 2 [m].
    pub fn end(&self, theta: &[f64; 6]) -> [f64; 2] {
        let [_, t2, t3, ..] = *theta;
        [
            self.c2 * t2.sin() + self.c3 * (t2 + t3).sin(),
            self.c2 * t2.cos() + self.c3 * (t2 + t3).cos(),
        ]
    }

    /// The end of the planar arm where joint 6 of a pose with sin theta_5 = 0 is turned to
    /// `theta_6`: on a circle about the wrist.
    pub fn end_along_self_motion(&self, theta: &[f64; 6], theta_6: f64) -> [f64; 2] {
        let phi = theta[1] + theta[2] + theta[3];
        let turned =
            if theta[4].cos() > 0.0 { phi + theta[5] - theta_6 } else { phi - theta[5] + theta_6 };
        let [x, z] = self.end(theta);
        [x + self.d5 * (phi.sin() - turned.sin()), z + self.d5 * (phi.cos() - turned.cos())]
    }

    /// The angle of axis 5 from the line between axis 2 and the wrist, and the angles from it, to
    /// either side, between which the end of the planar arm is in reach along the family [rad].
    pub fn circle(&self, theta: &[f64; 6]) -> [f64; 3] {
        let phi = theta[1] + theta[2] + theta[3];
        let [x, z] = self.end(theta);
        let [x, z] = [x + self.d5 * phi.sin(), z + self.d5 * phi.cos()];
        let size = x.hypot(z);
        let edge = |r: f64| {
            let cosine = (size * size + self.d5 * self.d5 - r * r) / (2.0 * self.d5 * size);
            cosine.clamp(-1.0, 1.0).acos()
        };
        [phi - x.atan2(z), edge(self.c2 - self.c3), edge(self.c2 + self.c3)]
    }

    /// By how much an end of the planar arm is too far (positive) or too near (negative) [m].
    pub fn missing(&self, [x, z]: [f64; 2]) -> f64 {
        let (r, longest, shortest) = (x.hypot(z), self.c2 + self.c3, (self.c2 - self.c3).abs());
        if r > longest { r - longest } else { (r - shortest).min(0.0) }
    }

    /// How far an end of the planar arm is inside the edges of its reach [m].
    pub fn margin(&self, [x, z]: [f64; 2]) -> f64 {
        let r = x.hypot(z);
        (self.c2 + self.c3 - r).min(r - (self.c2 - self.c3).abs())
    }

    /// Slot of joint angles: the signs of x, sin theta_3 and sin theta_5.
    pub fn slot(&self, theta: &[f64; 6]) -> usize {
        4 * usize::from(self.x(theta) < 0.0)
            + 2 * usize::from(theta[2].sin() < 0.0)
            + usize::from(theta[4].sin() < 0.0)
    }

    /// The wrist in the shoulder frame, for the pose of the flange.
    pub fn wrist(&self, pose: &Pose) -> (Vector3<f64>, Matrix3<f64>) {
        let flange = self.base.inverse() * pose * self.flange.inverse();
        let rotation = *flange.rotation.matrix();
        let approach = rotation.column(1);
        (flange.translation.vector - approach * self.d6 - Vector3::z() * self.c1, rotation)
    }

    /// The target of the planar arm for a pose: shoulder in front and behind, wrist as determined
    /// and flipped. `None` if the wrist is within the cylinder of radius b; how far inside then
    /// [m].
    pub fn asked(&self, pose: &Pose) -> Result<[[Asked; 2]; 2], f64> {
        let (w, rotation) = self.wrist(pose);
        let (rho, b) = (w.x.hypot(w.y), self.b());
        if rho < b {
            return Err(b - rho);
        }
        let size = (rho * rho - b * b).sqrt();
        Ok([size, -size].map(|x| {
            let theta_1 = w.y.atan2(w.x) - b.atan2(x);
            let m = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta_1).matrix() * rotation;
            // Axis 5 is perpendicular to axis 2 and to the approach: along y x (M y) = (m21, 0,
            // -m01), up to its sign.
            let (sin_phi, cos_phi) = (m[(2, 1)], -m[(0, 1)]);
            let sin_5 = sin_phi.hypot(cos_phi);
            [1.0, -1.0].map(|wrist| {
                let end = [
                    x - self.a1 - wrist * self.d5 * sin_phi / sin_5,
                    w.z - wrist * self.d5 * cos_phi / sin_5,
                ];
                Asked { end, missing: self.missing(end) }
            })
        }))
    }
}

/// A pure rotation.
pub fn turn(rotation: Matrix3<f64>) -> Pose {
    IsometryMatrix3::from_parts(
        Translation3::identity(),
        Rotation3::from_matrix_unchecked(rotation),
    )
}

/// A turn about x by quarters, to the bit.
pub fn quarters_about_x(quarters: i32) -> Matrix3<f64> {
    let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]
        [quarters.rem_euclid(4).unsigned_abs() as usize];
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos)
}
