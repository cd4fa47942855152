//! Arms with a spherical wrist.

mod judge;

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{Definition, Error, JointLimits, OpwParameters, Robot, Solution, Solutions};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::place::{At, Made, Place, Posture, Verdict};
use super::{Arm, SIX, Structure, Subject};
use crate::common::wrapped;
use crate::rng::Rng;

/// An arm by the parameters of its derivation.
#[derive(Clone, Copy, Debug)]
pub struct WristArm {
    pub opw: OpwParameters,
    /// Whether a parallelogram linkage couples axes 2 and 3: joint 3 is then measured from the
    /// base.
    pub coupled: bool,
}

impl From<OpwParameters> for WristArm {
    fn from(opw: OpwParameters) -> Self {
        Self { opw, coupled: false }
    }
}

/// Not a real arm: every parameter has an effect.
pub const ODD: OpwParameters = OpwParameters {
    a1: 0.15,
    a2: -0.11,
    b: 0.05,
    c1: 0.45,
    c2: 0.6,
    c3: 0.64,
    c4: 0.1,
    offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5],
    signs: [1, -1, 1, 1, -1, -1],
};

/// KUKA KR 6 R700 sixx, its joints in half a turn either way.
pub fn kuka_kr6() -> Result<Robot<6>, Error> {
    let robot = Robot::from_opw(KUKA_KR6)?;
    Ok(robot.with_limits(JointLimits::new([[-PI, PI]; 6])?))
}

/// KUKA KR 6 R700 sixx (parameters of the cases from rs-opw-kinematics).
pub const KUKA_KR6: OpwParameters = OpwParameters {
    a1: 0.025,
    a2: -0.035,
    b: 0.0,
    c1: 0.4,
    c2: 0.315,
    c3: 0.365,
    c4: 0.08,
    offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
    signs: [-1, 1, 1, -1, 1, -1],
};

pub fn structure() -> Structure<6> {
    let lateral =
        OpwParameters { b: 0.05, ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1) };
    let equal = OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045);
    let many_turns = OpwParameters { offsets: [50.0, -49.0, 31.4, -3.2, 12.5, 7.0], ..ODD };
    let parameters = [
        ("KUKA KR 6 R700", KUKA_KR6),
        ("lateral offset 50 mm", lateral),
        ("odd signs and offsets", ODD),
        ("equal links", equal),
    ];
    let makers = ["IRB 2600-12/1.65", "IRB 120-3/0.58", "IRB 6640-235/2.55"].map(named);
    let others = parameters.map(|(name, opw)| Subject::new(name, WristArm::from(opw), &SIX));
    Structure {
        name: "spherical wrist",
        subjects: makers.into_iter().chain(others).collect(),
        many_turns: Subject::new("offsets of many turns", WristArm::from(many_turns), &SIX),
        random: arms().prop_map(|arm| Subject::new("random", arm, &SIX)).boxed(),
    }
}

/// An arm of the catalog, with its limits.
pub fn named(name: &str) -> Subject<6> {
    let robot: Robot<6> = Robot::named(name).unwrap();
    let Definition::Opw(opw) = *robot.definition() else {
        unreachable!("{name} is built from its parameters")
    };
    Subject::new(name, WristArm { opw, coupled: robot.is_coupled() }, &SIX).with_robot(|_| robot)
}

/// Arms of the structure, with offsets, signs and a lateral offset.
fn arms() -> impl Strategy<Value = WristArm> {
    let lengths = (
        -0.3..0.5,
        -0.3..0.3,
        prop_oneof![Just(0.0), -0.2..0.2],
        0.0..1.0,
        0.2..1.5,
        0.2..1.5,
        0.0..0.3,
    );
    let signs = prop::array::uniform6(prop_oneof![Just(1_i8), Just(-1_i8)]);
    (lengths, prop::array::uniform6(-PI..PI), signs).prop_map(
        |((a1, a2, b, c1, c2, c3, c4), offsets, signs)| {
            WristArm::from(OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs })
        },
    )
}

impl WristArm {
    /// Length of the forearm, from the elbow to the wrist center.
    fn k(&self) -> f64 {
        self.opw.a2.hypot(self.opw.c3)
    }

    /// theta_3 of an elbow angle, which is zero where the arm is stretched.
    fn theta_3(&self, elbow: f64) -> f64 {
        elbow - self.opw.a2.atan2(self.opw.c3)
    }

    /// The wrist center before axis 1, in the plane of the arm [m].
    fn x(&self, [_, t2, t3, ..]: &[f64; 6]) -> f64 {
        let OpwParameters { a1, a2, c2, c3, .. } = self.opw;
        a1 + c2 * t2.sin() + c3 * (t2 + t3).sin() + a2 * (t2 + t3).cos()
    }

    /// A theta_2 that puts the wrist center `x` before axis 1, for an elbow angle; `None` if it
    /// cannot get there.
    fn theta_2(&self, elbow: f64, x: f64, rng: &mut Rng) -> Option<f64> {
        let (along, across) = (self.opw.c2 + self.k() * elbow.cos(), self.k() * elbow.sin());
        let sine = (x - self.opw.a1) / along.hypot(across);
        let phase = across.atan2(along);
        let forward = if rng.unit() < 0.5 { sine.asin() } else { PI - sine.asin() };
        (sine.abs() < 0.99).then_some(forward - phase)
    }
}

impl Arm<6> for WristArm {
    fn robot(&self) -> Robot<6> {
        let robot = Robot::from_opw(self.opw).unwrap();
        if self.coupled { robot.coupled().unwrap() } else { robot }
    }

    /// From axis 1, at the height of the shoulder.
    fn reach(&self) -> f64 {
        self.opw.a1.abs() + self.opw.c2 + self.k() + self.opw.c4
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        let mut serial = *q;
        serial[2] -= if self.coupled { q[1] } else { 0.0 };
        std::array::from_fn(|i| f64::from(self.opw.signs[i]) * serial[i] - self.opw.offsets[i])
    }

    fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        let [signs, offsets] = [self.opw.signs.map(f64::from), self.opw.offsets];
        let mut q: [f64; 6] = std::array::from_fn(|i| signs[i] * (theta[i] + offsets[i]));
        q[2] += if self.coupled { q[1] } else { 0.0 };
        q
    }

    /// ABB's cfx by the tests of its definition.
    fn slot(&self, theta: &[f64; 6]) -> usize {
        let [_, _, t3, _, t5, _] = *theta;
        let behind_lower_arm = self.opw.c3 * t3.sin() + self.opw.a2 * t3.cos() < 0.0;
        4 * usize::from(self.x(theta) < 0.0)
            + 2 * usize::from(behind_lower_arm)
            + usize::from(t5.sin() < 0.0)
    }

    fn determinant(&self, robot: &Robot<6>, q: &[f64; 6]) -> f64 {
        robot.jacobian_determinant(q).unwrap()
    }

    /// Joint 5 the other way, joints 4 and 6 by half a turn, the arm the same.
    fn wrist_flip(&self, [straight, flipped]: [&Solution<6>; 2]) -> Result<(), String> {
        let [a, b] = [self.theta(&straight.q), self.theta(&flipped.q)];
        let arm_moves = straight.q[..3] != flipped.q[..3];
        // Where an offset is added, theta has the rounding of q.
        let rounding =
            8.0 * f64::EPSILON * (1.0 + self.opw.offsets.map(f64::abs).iter().sum::<f64>());
        let exact = self.opw.offsets[4] == 0.0;
        let five = wrapped(a[4] + b[4]);
        let half =
            [3, 5].map(|i| (wrapped(a[i] - b[i]) - PI).abs()).into_iter().fold(0.0, f64::max);
        if arm_moves || five > if exact { 0.0 } else { rounding } || half > rounding {
            return Err(format!("{straight:?} and {flipped:?}: {five:e}, {half:e}"));
        }
        Ok(())
    }

    fn beyond_in(&self, _robot: &Robot<6>, made: &Made<6>, solution: &Solution<6>) -> [f64; 2] {
        [judge::beyond_in(self, made, solution), 0.0]
    }

    fn singular_places(&self) -> &'static [At] {
        &[At::Wrist, At::Shoulder, At::Elbow]
    }

    fn at(&self, place: &Place, rng: &mut Rng) -> Option<[f64; 6]> {
        let mut theta: [f64; 6] = rng.angles();
        theta[4] = match place.wrist() {
            Some(off) => rng.half_turn() + rng.sign() * off,
            None => rng.sign() * rng.between(0.2, 2.9),
        };
        let elbow = match place.elbow() {
            Some(off) => rng.half_turn() + rng.sign() * off,
            None => rng.sign() * rng.between(0.2, 2.9),
        };
        theta[2] = self.theta_3(elbow);
        if let Some(off) = place.shoulder() {
            theta[1] = self.theta_2(elbow, rng.sign() * off, rng)?;
        } else if self.robot().singularity(&self.q(theta)).distances?.shoulder < 0.05 {
            return None;
        }
        Some(theta)
    }

    fn postures(&self) -> Vec<Posture<6>> {
        let arm = *self;
        let home = move |rng: &mut Rng| {
            Some(arm.theta(&[rng.angle(), 0.0, 0.0, rng.angle(), 0.0, rng.angle()]))
        };
        // Where joint 5 is zero, theta_5 may be anything.
        if self.opw.offsets[4] != 0.0 {
            return Vec::new();
        }
        let place = Place::of(At::Wrist, 0.0);
        vec![Posture { name: "J2 = J3 = J5 = 0", place, draw: Box::new(home) }]
    }

    /// A stretched arm with the wrist center moved outwards along the line to it, in front of
    /// axis 1, where the arm behind has still farther to go.
    fn beyond(&self, beyond: f64, rng: &mut Rng) -> Option<Made<6>> {
        let elbow = Place::of(At::Elbow, 0.0);
        let mut theta = self.at(&elbow, rng)?;
        theta[2] = self.theta_3(0.0);
        theta[1] = rng.between(0.1, 1.4);
        let (t1, t2) = (theta[0], theta[1]);
        let mut made = Made::new(&self.robot(), &elbow, theta, self.q(theta));
        let outward = Vector3::new(t2.sin() * t1.cos(), t2.sin() * t1.sin(), t2.cos());
        made.pose.translation.vector += outward * beyond;
        Some(Made { beyond, ..made })
    }

    fn judge(
        &self,
        robot: &Robot<6>,
        made: &Made<6>,
        solutions: &Solutions<6>,
        _: &mut Rng,
    ) -> Verdict {
        judge::judge(self, robot, made, solutions)
    }
}
