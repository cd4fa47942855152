//! Arms with three parallel axes.

pub mod arm;
mod judge;
mod place;

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{Pose, Robot, Solution, Solutions, pose};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::place::{At, Made, Place, Posture, Verdict};
use super::{Arm, SIX, Structure, Subject};
use crate::common::wrapped;
use crate::rng::Rng;
pub use arm::ParallelArm;
use judge::Judge;
use place::clear_of_axis_1;

/// Not a real arm: every parameter has an effect.
pub fn odd() -> ParallelArm {
    ParallelArm {
        a1: 0.07,
        b: [0.2, -0.13, 0.04],
        c1: 0.3,
        c2: 0.5,
        c3: 0.43,
        d5: 0.08,
        d6: 0.11,
        signs: [1.0, -1.0, 1.0, 1.0, -1.0, -1.0],
        offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5],
        base: pose::from_euler_zyx([0.1, -0.2, 0.05], [0.4, 0.1, -0.3]).unwrap(),
        flange: pose::from_euler_zyx([0.02, 0.01, 0.03], [-0.7, 0.2, 0.5]).unwrap(),
    }
}

/// Upper arm and forearm of one length, which fold onto axis 2.
pub fn equal_links() -> ParallelArm {
    ParallelArm {
        c2: 0.35,
        c3: 0.35,
        signs: [-1.0, 1.0, -1.0, -1.0, 1.0, -1.0],
        offsets: [0.25, 0.4, -FRAC_PI_2, 1.1, -0.7, 0.3],
        base: Pose::identity(),
        flange: Pose::identity(),
        ..odd()
    }
}

pub fn structure() -> Structure<6> {
    let many_turns = ParallelArm { offsets: [50.0, -49.0, 31.4, -3.2, 12.5, 7.0], ..odd() };
    let makers = ["UR3", "UR5e", "UR10e"].map(named);
    let others = [("equal links, odd frames", equal_links()), ("odd frames", odd())]
        .map(|(name, arm)| Subject::new(name, arm, &SIX));
    Structure {
        name: "three parallel axes",
        subjects: makers.into_iter().chain(others).collect(),
        many_turns: Subject::new("offsets of many turns", many_turns, &SIX),
        random: arms().prop_map(|arm| Subject::new("random", arm, &SIX)).boxed(),
    }
}

/// An arm of the catalog, with its limits.
pub fn named(name: &str) -> Subject<6> {
    let (arm, robot) = ParallelArm::universal(name);
    Subject::new(name, arm, &SIX).with_robot(|_| robot)
}

/// Arms of the structure, with signs, offsets, a base and a flange; the parallel axes drawn at any
/// places along themselves.
pub fn arms() -> impl Strategy<Value = ParallelArm> {
    let wrist = prop_oneof![Just(0.0), 0.01..0.3];
    let lengths = (
        -0.3..0.5,
        (0.02..0.3, -0.5..0.5, -0.5..0.5),
        0.0..1.0,
        0.2..1.5,
        0.2..1.5,
        wrist,
        0.01..0.3,
    );
    let signs = prop::array::uniform6(prop_oneof![Just(1.0), Just(-1.0)]);
    let poses = || crate::common::poses(2.0);
    (lengths, signs, prop::array::uniform6(-PI..PI), poses(), poses()).prop_map(
        |((a1, (b, b2, b3), c1, c2, c3, d5, d6), signs, offsets, base, flange)| ParallelArm {
            a1,
            b: [b2, b3, b - b2 - b3],
            c1,
            c2,
            c3,
            d5,
            d6,
            signs,
            offsets,
            base,
            flange,
        },
    )
}

impl Arm<6> for ParallelArm {
    fn robot(&self) -> Robot<6> {
        ParallelArm::robot(self)
    }

    fn reach(&self) -> f64 {
        ParallelArm::reach(self)
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        ParallelArm::theta(self, q)
    }

    fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        ParallelArm::q(self, theta)
    }

    fn slot(&self, theta: &[f64; 6]) -> usize {
        ParallelArm::slot(self, theta)
    }

    fn has_slots(&self) -> bool {
        self.d5 != 0.0
    }

    fn determinant(&self, robot: &Robot<6>, q: &[f64; 6]) -> f64 {
        robot.jacobian_determinant(q).unwrap()
    }

    /// Joint 5 the other way, joint 6 and the hand in the plane of the arm by half a turn.
    fn wrist_flip(&self, [straight, flipped]: [&Solution<6>; 2]) -> Result<(), String> {
        let [a, b] = [self.theta(&straight.q), self.theta(&flipped.q)];
        let rounding = 8.0 * f64::EPSILON * (1.0 + self.offsets.map(f64::abs).iter().sum::<f64>());
        let five = wrapped(a[4] + b[4]);
        let six = (wrapped(a[5] - b[5]) - PI).abs();
        let hand = (wrapped(place::phi(&a) - place::phi(&b)) - PI).abs();
        let exact = self.offsets[4] != 0.0 || five == 0.0;
        if straight.q[0].to_bits() != flipped.q[0].to_bits()
            || !exact
            || five.max(six) > rounding
            || hand > 1e-14 + rounding
        {
            return Err(format!("{straight:?} and {flipped:?}: {five:e}, {six:e}, {hand:e}"));
        }
        Ok(())
    }

    fn beyond_in(&self, robot: &Robot<6>, made: &Made<6>, solution: &Solution<6>) -> [f64; 2] {
        [Judge::new(self, robot, made).beyond_in(solution), 0.0]
    }

    fn singular_places(&self) -> &'static [At] {
        &[At::Wrist, At::Shoulder, At::Elbow]
    }

    fn at(&self, place: &Place, rng: &mut Rng) -> Option<[f64; 6]> {
        place::at(self, place, rng)
    }

    fn postures(&self) -> Vec<Posture<6>> {
        let mut postures = self.along_the_line();
        let zero = self.theta(&[0.0; 6]);
        // The zero pose of a Universal Robots arm: stretched, its wrist straight.
        if zero[2] == 0.0 && zero[4] == 0.0 {
            let elbow = Place::of(At::Elbow, 0.0);
            postures.push(Posture {
                name: "J1 to J6 = 0",
                place: Place(vec![(At::Wrist, 0.0), (At::Elbow, 0.0)]),
                draw: Box::new(move |_| Some(zero)),
            });
            let arm = self.clone();
            postures.push(Posture {
                name: "J2 = J3 = J4 = 0",
                place: elbow,
                draw: Box::new(move |rng| {
                    let bent = rng.between(0.2, 2.9);
                    Some(arm.theta(&[rng.angle(), 0.0, 0.0, 0.0, bent, rng.angle()]))
                }),
            });
        }
        postures
    }

    /// A stretched or folded arm with the wrist moved along the line from axis 2 to the end of the
    /// planar arm, out of reach; no other branch reaches.
    fn beyond(&self, beyond: f64, rng: &mut Rng) -> Option<Made<6>> {
        let elbow = Place::of(At::Elbow, 0.0);
        let theta = self.at(&elbow, rng)?;
        let mut made =
            Made::new(&ParallelArm::robot(self), &elbow, theta, ParallelArm::q(self, theta));
        let [x, z] = self.end(&theta);
        let r = x.hypot(z);
        let outward = if theta[2] == 0.0 { beyond } else { -beyond };
        let in_plane =
            Vector3::new(x / r * theta[0].cos(), x / r * theta[0].sin(), z / r) * outward;
        made.pose.translation.vector += self.base.rotation * in_plane;
        let asked = self.asked(&made.pose).ok()?;
        let mut missing = asked.map(|wrists| wrists.map(|asked| asked.missing.abs())).concat();
        missing.sort_by(f64::total_cmp);
        (r.min(missing[1]) > 0.04 * self.c2).then_some(Made { beyond, ..made })
    }

    fn judge(
        &self,
        robot: &Robot<6>,
        made: &Made<6>,
        solutions: &Solutions<6>,
        rng: &mut Rng,
    ) -> Verdict {
        Judge::new(self, robot, made).judge(solutions, rng)
    }
}

impl ParallelArm {
    /// Straight arms with a straight wrist and axis 5 along the links: joint 6 is free, and the arm
    /// reaches with one angle of it alone. An example is a Universal Robots arm that points
    /// straight up, over axis 1.
    fn along_the_line(&self) -> Vec<Posture<6>> {
        let place = Place(vec![(At::Wrist, 0.0), (At::Elbow, 0.0)]);
        let (arm, at) = (self.clone(), place.clone());
        let along = move |rng: &mut Rng| {
            let mut theta = arm.at(&at, rng)?;
            theta[3] = rng.half_turn();
            let [x, z] = arm.end(&theta);
            // Folded onto axis 2, no line is the arm's.
            let is_clear =
                arm.x(&theta).abs() > clear_of_axis_1(&arm) && x.hypot(z) > 0.04 * arm.c2;
            is_clear.then_some(theta)
        };
        let up = |rng: &mut Rng| Some([rng.angle(), 0.0, 0.0, 0.0, rng.half_turn(), rng.angle()]);
        let mut over_axis_1 = place.clone();
        over_axis_1.0.push((At::Shoulder, 0.0));
        let mut postures =
            vec![Posture { name: "axis 5 along the straight arm", place, draw: Box::new(along) }];
        if self.a1 == 0.0 {
            postures.push(Posture { name: "straight up", place: over_axis_1, draw: Box::new(up) });
        }
        postures
    }
}
