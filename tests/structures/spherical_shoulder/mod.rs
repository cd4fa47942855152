//! Arms of seven axes with a spherical shoulder.

pub mod arm;
mod judge;

use std::f64::consts::PI;

use irbkin::{Pose, Robot, SingularityKind, Solution, Solutions, thresholds};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::place::{At, Made, Place, Verdict};
use super::{Arm, SEVEN, Structure, Subject};
use crate::common::wrapped;
use crate::rng::Rng;
pub use arm::ShoulderArm;

pub fn structure() -> Structure<7> {
    let offsets = [50.0, -49.0, 31.4, -3.2, 12.5, 7.0, -20.0];
    let many_turns = ShoulderArm { offsets, ..ShoulderArm::oblique() };
    let makers = ["Panda", "FR3"].map(named);
    let others = [
        ("iiwa", ShoulderArm::iiwa()),
        ("oblique", ShoulderArm::oblique()),
        ("onto itself", ShoulderArm::onto_itself()),
    ]
    .map(|(name, arm)| Subject::new(name, arm, &SEVEN));
    Structure {
        name: "spherical shoulder",
        subjects: makers.into_iter().chain(others).collect(),
        many_turns: Subject::new("offsets of many turns", many_turns, &SEVEN),
        random: arms().prop_map(|arm| Subject::new("random", arm, &SEVEN)).boxed(),
    }
}

/// An arm of Franka in the catalog, with its limits: both have one table.
pub fn named(name: &str) -> Subject<7> {
    let robot = Robot::named(name).unwrap();
    Subject::new(name, ShoulderArm::panda(), &SEVEN).with_robot(|_| robot)
}

/// Arms of the structure, with signs, offsets, a base and a flange.
fn arms() -> impl Strategy<Value = ShoulderArm> {
    let elbow = (prop_oneof![Just(0.0), 0.01..0.15], 0.2..0.6, -0.15..0.15, 0.2..0.6);
    let hand = (-0.1..0.1, -PI..PI, -0.2..0.2, -0.2..0.2);
    let signs = prop::array::uniform7(prop_oneof![Just(1.0), Just(-1.0)]);
    let poses = || crate::common::poses(0.8);
    (0.0..0.5, elbow, hand, signs, prop::array::uniform7(-PI..PI), poses(), poses()).prop_map(
        |(c1, (a3, c3, a4, c5), (d6, alpha7, a7, d7), signs, offsets, base, flange)| ShoulderArm {
            c1,
            a3,
            c3,
            a4,
            c5,
            d6,
            alpha7,
            a7,
            d7,
            signs,
            offsets,
            base,
            flange,
        },
    )
}

impl Arm<7> for ShoulderArm {
    fn robot(&self) -> Robot<7> {
        Robot::from_mdh(self.mdh()).unwrap()
    }

    fn reach(&self) -> f64 {
        ShoulderArm::reach(self)
    }

    fn theta(&self, q: &[f64; 7]) -> [f64; 7] {
        ShoulderArm::theta(self, q)
    }

    fn q(&self, theta: [f64; 7]) -> [f64; 7] {
        ShoulderArm::q(self, theta)
    }

    fn slot(&self, theta: &[f64; 7]) -> usize {
        ShoulderArm::slot(self, theta)
    }

    fn determinant(&self, robot: &Robot<7>, q: &[f64; 7]) -> f64 {
        robot.jacobian_determinant(q).unwrap()
    }

    /// Joint 4 the same, joint 5 mirrored in the plane of axes 5 and 6.
    fn wrist_flip(&self, [straight, flipped]: [&Solution<7>; 2]) -> Result<(), String> {
        let [a, b] = [self.theta(&straight.q), self.theta(&flipped.q)];
        let cosines = wrapped(a[4] + b[4] - PI);
        let rounding = 8.0 * f64::EPSILON * (1.0 + self.offsets.map(f64::abs).iter().sum::<f64>());
        let same = wrapped(a[3] - b[3]);
        if same > rounding || cosines > 1e-14 + rounding {
            return Err(format!("{straight:?} and {flipped:?}: {same:e}, {cosines:e}"));
        }
        Ok(())
    }

    /// The joints of the shoulder come from a hand that rounding has moved already.
    fn singular_residual(&self) -> f64 {
        4.2e-15
    }

    /// The wrist turns by the distance over the arm that is left, and moves the hand with it.
    fn spread(&self) -> f64 {
        1.5
    }

    /// The other elbow may be up to the tolerance beyond reach, with its wrist at its edge.
    fn beyond_in(&self, _robot: &Robot<7>, made: &Made<7>, solution: &Solution<7>) -> [f64; 2] {
        let is_other = (solution.slot.index() ^ self.slot(&made.theta)) & 2 != 0;
        let kinds = solution.singularities();
        let is_at_edge =
            kinds.contains(SingularityKind::WRIST) && !kinds.contains(SingularityKind::ELBOW);
        [if is_other && is_at_edge { 1.01 * thresholds::REACH_TOLERANCE } else { 0.0 }; 2]
    }

    fn singular_places(&self) -> &'static [At] {
        &[At::Wrist, At::Shoulder, At::Stretched, At::Folded, At::Forearm, At::Hand]
    }

    fn at(&self, place: &Place, rng: &mut Rng) -> Option<[f64; 7]> {
        ShoulderArm::at(self, place, rng)
    }

    /// A stretched or folded arm with the hand moved along the line from the shoulder.
    fn beyond(&self, beyond: f64, rng: &mut Rng) -> Option<Made<7>> {
        let far = rng.sign();
        let at = if far > 0.0 { At::Stretched } else { At::Folded };
        if far < 0.0 && beyond >= (self.upper() - self.forearm()).abs() {
            return None;
        }
        let place = Place::of(at, 0.0);
        let theta = self.at(&place, rng)?;
        let robot = Arm::robot(self);
        let mut made = Made::new(&robot, &place, theta, self.q(theta));
        let frames = robot.link_frames(&made.q).0;
        let reached = frames[4].translation.vector - frames[1].translation.vector;
        made.pose.translation.vector += reached * (far * beyond / reached.norm());
        Some(Made { beyond, ..made })
    }

    fn judge(
        &self,
        robot: &Robot<7>,
        made: &Made<7>,
        solutions: &Solutions<7>,
        rng: &mut Rng,
    ) -> Verdict {
        judge::judge(self, robot, made, solutions, rng)
    }
}

/// The hand seen from the shoulder, from the robot's frames alone: z along axis 5 and y along axis
/// 6 where joint 6 is zero, up to a turn about axis 6.
pub fn hand_of(robot: &Robot<7>, pose: &Pose, q7: f64) -> Pose {
    let (frames, tool) = robot.link_frames(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, q7]);
    let t_six_tool = frames[5].inverse() * tool;
    let six = robot.base().inverse() * pose * t_six_tool.inverse();
    let back = robot.mdh().rows[5].d;
    let (axis_6, x) = (six.rotation * Vector3::z(), six.rotation * Vector3::x());
    let columns = Matrix3::from_columns(&[axis_6.cross(&x), axis_6, x]);
    let shoulder = (robot.base().inverse() * frames[1]).translation.vector;
    let hand = six.translation.vector - axis_6 * back - shoulder;
    Pose::from_parts(hand.into(), Rotation3::from_matrix_unchecked(columns))
}
