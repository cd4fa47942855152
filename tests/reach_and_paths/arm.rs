//! Arms of both structures with six axes, placed at any distance from their singularities.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use irbkin::{JointLimits, OpwParameters, Pose, Robot, pose, thresholds};

use crate::common::Rng;

/// An arm and the lengths that place it [m]; its theta is zero when the arm is upright.
pub struct Arm {
    pub name: String,
    pub robot: Robot<6>,
    pub a1: f64,
    pub b: f64,
    pub c2: f64,
    /// Forearm.
    pub k: f64,
    /// Of the elbow angle, against theta_3 [rad].
    psi: f64,
    /// Wrist from axis 4; 0 if axes 4, 5 and 6 intersect.
    pub d5: f64,
    offsets: [f64; 6],
    /// The sum of the lengths that contribute to a position [m].
    pub extent: f64,
}

/// Distances from the singularities: sin q5, the wrist from the shoulder's [m], the elbow angle
/// [rad]; anything if there is none.
#[derive(Clone, Copy, Default)]
pub struct Near {
    pub wrist: Option<f64>,
    pub shoulder: Option<f64>,
    pub elbow: Option<f64>,
}

impl Arm {
    pub fn opw(name: &str, opw: OpwParameters) -> Self {
        let robot = Robot::from_opw(opw).unwrap();
        let k = opw.a2.hypot(opw.c3);
        Self {
            name: name.into(),
            robot: robot.with_limits(JointLimits::UNLIMITED),
            a1: opw.a1,
            b: opw.b,
            c2: opw.c2,
            k,
            psi: opw.a2.atan2(opw.c3),
            d5: 0.0,
            offsets: opw.offsets,
            extent: opw.a1.abs() + opw.b.abs() + opw.c2 + k + opw.c1 + opw.c4,
        }
    }

    pub fn universal(name: &str) -> Self {
        let robot: Robot<6> = Robot::named(name).unwrap();
        let rows = robot.mdh().rows;
        let lengths = [rows[0].d, -rows[2].a, -rows[3].a, rows[3].d, rows[4].d, rows[5].d];
        Self {
            name: name.into(),
            robot: robot.with_limits(JointLimits::UNLIMITED),
            a1: 0.0,
            b: rows[3].d,
            c2: -rows[2].a,
            k: -rows[3].a,
            psi: 0.0,
            d5: rows[4].d,
            offsets: [0.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0],
            extent: lengths.iter().sum(),
        }
    }

    /// The same arm on a base and with a tool.
    pub fn mounted(mut self) -> Self {
        let base = pose::from_wxyz([0.3, -0.2, 0.5], [0.8, 0.36, -0.48, 0.0]).unwrap();
        let tool = pose::from_wxyz([0.1, 0.05, 0.4], [0.6, 0.0, 0.8, 0.0]).unwrap();
        self.extent += base.translation.vector.norm() + tool.translation.vector.norm();
        self.robot = self.robot.with_base(&base).unwrap().with_tool(&tool).unwrap();
        self.name += ", base and tool";
        self
    }

    pub fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| theta[i] + self.offsets[i])
    }

    pub fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| q[i] - self.offsets[i])
    }

    pub fn is_universal(&self) -> bool {
        self.d5 > 0.0
    }

    /// Upper bound of the rounding of a position [m].
    pub fn rounding(&self) -> f64 {
        thresholds::POSITION_ROUNDING * self.extent
    }

    /// The least distance from the shoulder singularity that rounding can resolve [m].
    pub fn shoulder_rounding(&self) -> f64 {
        (self.rounding() * (2.0 * self.b + self.rounding())).sqrt()
    }

    /// Distance of the wrist from the shoulder singularity, along the plane of the arm [m].
    pub fn x(&self, theta: &[f64; 6]) -> f64 {
        let [x, _] = self.end(theta);
        self.a1 + x + self.d5 * (theta[1] + theta[2] + theta[3]).sin()
    }

    /// The end of the planar arm from axis 2, forward and up [m].
    pub fn end(&self, theta: &[f64; 6]) -> [f64; 2] {
        let forearm = theta[1] + theta[2] + self.psi;
        [
            self.c2 * theta[1].sin() + self.k * forearm.sin(),
            self.c2 * theta[1].cos() + self.k * forearm.cos(),
        ]
    }

    pub fn elbow(&self, theta: &[f64; 6]) -> f64 {
        theta[2] + self.psi
    }

    /// Which branch a joint vector is on: the signs of x, of the elbow angle and of joint 5.
    pub fn slot(&self, theta: &[f64; 6]) -> usize {
        4 * usize::from(self.x(theta) < 0.0)
            + 2 * usize::from(self.elbow(theta).sin() < 0.0)
            + usize::from(theta[4].sin() < 0.0)
    }

    /// Joint angles at the given distances from the singularities, on any side, and well away from
    /// the others.
    pub fn placed(&self, near: Near, rng: &mut Rng) -> [f64; 6] {
        loop {
            let mut theta: [f64; 6] = std::array::from_fn(|_| rng.between(-PI, PI));
            let mut angle = |off: Option<f64>| match off {
                Some(off) => half_turn(rng) + sign(rng) * off,
                None => sign(rng) * rng.between(0.2, 2.9),
            };
            (theta[4], theta[2]) = (angle(near.wrist), angle(near.elbow) - self.psi);
            match near.shoulder {
                None if self.x(&theta).abs() < 0.1 * self.c2 => continue,
                None => {}
                Some(off) => match self.theta_2(&theta, sign(rng) * off, rng) {
                    Some(theta_2) => theta[1] = theta_2,
                    None => continue,
                },
            }
            return theta;
        }
    }

    /// A theta_2 that puts the wrist `x` in front of axis 1; `None` if it cannot get there.
    fn theta_2(&self, theta: &[f64; 6], x: f64, rng: &mut Rng) -> Option<f64> {
        let (elbow, last) = (self.elbow(theta), theta[2] + theta[3]);
        let along = self.c2 + self.k * elbow.cos() + self.d5 * last.cos();
        let across = self.k * elbow.sin() + self.d5 * last.sin();
        let sine = (x - self.a1) / along.hypot(across);
        let forward = if rng.unit() < 0.5 { sine.asin() } else { PI - sine.asin() };
        (sine.abs() < 0.99).then_some(forward - across.atan2(along))
    }

    /// Whether a joint vector reaches a pose that is up to `off` [m] away, to rounding.
    pub fn meets(&self, q: &[f64; 6], pose: &Pose, off: f64) -> bool {
        let residual = self.robot.residual(q, pose);
        residual.position <= off + 3e-15 * self.extent && residual.rotation <= 1e-14
    }
}

pub fn irb_2600() -> Arm {
    Arm::opw("IRB 2600", OpwParameters::abb(0.150, -0.115, 0.445, 0.700, 0.795, 0.085))
}

pub fn lateral(b: f64) -> Arm {
    let opw = OpwParameters { b, ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1) };
    Arm::opw(&format!("lateral offset {b:e} m"), opw)
}

pub fn equal_links() -> Arm {
    Arm::opw("equal links", OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045))
}

pub fn universal() -> Vec<Arm> {
    let names = ["UR3", "UR5e", "UR10e"];
    let bare = names.map(Arm::universal);
    bare.into_iter().chain(names.map(|name| Arm::universal(name).mounted())).collect()
}

/// Every arm, those of both structures.
pub fn arms() -> Vec<Arm> {
    let wrists = [irb_2600(), irb_2600().mounted(), equal_links()];
    let offsets = [1e-6, 1e-4, 0.05].map(lateral);
    wrists.into_iter().chain(offsets).chain([lateral(0.05).mounted()]).chain(universal()).collect()
}

fn half_turn(rng: &mut Rng) -> f64 {
    if rng.unit() < 0.5 { 0.0 } else { PI }
}

pub fn sign(rng: &mut Rng) -> f64 {
    if rng.unit() < 0.5 { -1.0 } else { 1.0 }
}

/// Log-uniform between two powers of ten.
pub fn log_uniform(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10.0_f64.powf(rng.between(low, high))
}

/// Distance of an angle from the nearest multiple of 2 pi [rad].
pub fn wrapped(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs()
}
