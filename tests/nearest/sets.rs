//! Poses of the laws: arms at and near one, two and three singularities.

use std::f64::consts::PI;

use irbkin::{Definition, OpwParameters, Pose, Robot};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

use crate::common::Rng;
use crate::structures::three_parallel::ParallelArm;

/// How far from a singularity [rad, m].
pub const DISTANCES: [f64; 14] =
    [0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];

/// The singularities that an arm is near.
#[derive(Clone, Copy)]
pub struct Kind {
    wrist: bool,
    elbow: bool,
    shoulder: bool,
}

impl std::fmt::Debug for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (letter, at) in [("W", self.wrist), ("E", self.elbow), ("S", self.shoulder)] {
            write!(f, "{}", if at { letter } else { "-" })?;
        }
        Ok(())
    }
}

const fn kind(number: usize) -> Kind {
    Kind { wrist: number & 1 > 0, elbow: number & 2 > 0, shoulder: number & 4 > 0 }
}

/// Singles, pairs, and all three.
pub const KINDS: [Kind; 7] = [kind(1), kind(2), kind(4), kind(3), kind(5), kind(6), kind(7)];

/// A base or a tool.
pub fn random_frame(rng: &mut Rng) -> Pose {
    let mut vector = |size: f64| {
        Vector3::new(rng.between(-size, size), rng.between(-size, size), rng.between(-size, size))
    };
    IsometryMatrix3::from_parts(Translation3::from(vector(0.4)), Rotation3::new(vector(2.0)))
}

enum Geometry {
    Wrist(OpwParameters),
    Parallel(Box<ParallelArm>),
}

pub struct Arm {
    pub name: String,
    pub robot: Robot<6>,
    geometry: Geometry,
}

impl Arm {
    pub fn named(name: &str) -> Self {
        let own = |opw: OpwParameters| Self {
            name: name.to_owned(),
            robot: Robot::from_opw(opw).unwrap(),
            geometry: Geometry::Wrist(opw),
        };
        match name {
            "equal links" => {
                return own(OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045));
            }
            "lateral offset" => {
                let opw = OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1);
                return own(OpwParameters { b: 0.05, ..opw });
            }
            _ => {}
        }
        if name.starts_with("UR") {
            let (arm, robot) = ParallelArm::universal(name);
            return Self {
                name: name.to_owned(),
                robot,
                geometry: Geometry::Parallel(Box::new(arm)),
            };
        }
        let robot: Robot<6> = Robot::named(name).unwrap();
        let Definition::Opw(opw) = *robot.definition() else { unreachable!("{name}") };
        Self { name: name.to_owned(), robot, geometry: Geometry::Wrist(opw) }
    }

    /// A joint vector of the kind, this far from each of its singularities; `None` if this draw has
    /// none.
    pub fn place(&self, kind: Kind, off: f64, rng: &mut Rng) -> Option<[f64; 6]> {
        let drawn = self
            .robot
            .limits()
            .to_array()
            .map(|[low, high]| rng.between(low.max(-2.0 * PI), high.min(2.0 * PI)));
        let side = |rng: &mut Rng| if rng.unit() < 0.5 { -off } else { off };
        // Singularities that are not part of the set are well away.
        let away =
            |rng: &mut Rng| if rng.unit() < 0.5 { 0.3 } else { -0.3 } * rng.between(1.0, 8.0);
        let turn = |at: bool, rng: &mut Rng| if at { side(rng) } else { away(rng) };
        let folded = if rng.unit() < 0.3 { PI } else { 0.0 };
        let elbow = folded + turn(kind.elbow, rng);
        let wrist = if rng.unit() < 0.2 { PI } else { 0.0 } + turn(kind.wrist, rng);
        let x = kind.shoulder.then(|| side(rng));
        let backward = rng.unit() < 0.5;
        match &self.geometry {
            Geometry::Wrist(opw) => {
                let mut drawn = drawn;
                if self.robot.is_coupled() {
                    drawn[2] -= drawn[1];
                }
                let mut theta: [f64; 6] =
                    std::array::from_fn(|i| f64::from(opw.signs[i]) * drawn[i] - opw.offsets[i]);
                let k = opw.a2.hypot(opw.c3);
                theta[2] = elbow - opw.a2.atan2(opw.c3);
                theta[4] = wrist;
                if let Some(x) = x {
                    let end = [opw.c2 + k * elbow.cos(), k * elbow.sin()];
                    theta[1] = over(x - opw.a1, end, backward)?;
                }
                let q =
                    std::array::from_fn(|i| f64::from(opw.signs[i]) * (theta[i] + opw.offsets[i]));
                let q = self.inside(q);
                Some(if self.robot.is_coupled() { coupled(q) } else { q })
            }
            Geometry::Parallel(arm) => {
                let mut theta = arm.theta(&drawn);
                (theta[2], theta[4]) = (elbow, wrist);
                if let Some(x) = x {
                    let last = theta[2] + theta[3];
                    let end = [
                        arm.c2 + arm.c3 * elbow.cos() + arm.d5 * last.cos(),
                        arm.c3 * elbow.sin() + arm.d5 * last.sin(),
                    ];
                    theta[1] = over(x - arm.a1, end, backward)?;
                }
                Some(self.inside(arm.q(theta)))
            }
        }
    }

    /// The 2 pi equivalents inside the limits, if there are any.
    fn inside(&self, q: [f64; 6]) -> [f64; 6] {
        let limits = self.robot.limits().to_array();
        std::array::from_fn(|i| {
            let turns = [0.0, -2.0 * PI, 2.0 * PI].map(|turn| q[i] + turn);
            let holds = |angle: &f64| limits[i][0] <= *angle && *angle <= limits[i][1];
            turns.into_iter().find(holds).unwrap_or(q[i])
        })
    }
}

fn coupled(mut q: [f64; 6]) -> [f64; 6] {
    q[2] += q[1];
    q
}

/// The angle of axis 2, from upright, that brings an end (along the upper arm, across) to x in
/// front of it.
fn over(x: f64, [along, across]: [f64; 2], backward: bool) -> Option<f64> {
    let sine = x / along.hypot(across);
    let angle = if backward { PI - sine.asin() } else { sine.asin() };
    (sine.abs() < 0.99).then_some(angle - across.atan2(along))
}
