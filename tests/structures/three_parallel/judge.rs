//! Judges answers at and near the singularities of an arm with three parallel axes.

use std::f64::consts::{PI, TAU};

use irbkin::{FreeJoint, Robot, SingularityKind, Solution, Solutions, Status, thresholds};

use super::arm::ParallelArm;
use super::place::{Bounds, FOUND, UNDETERMINED, phi};
use crate::common::wrapped;
use crate::rng::Rng;
use crate::structures::place::{At, Made, Verdict};

/// A pose that was made, with its uncertainty from rounding.
pub struct Judge<'a> {
    pub arm: &'a ParallelArm,
    pub robot: &'a Robot<6>,
    pub made: &'a Made<6>,
    pub bounds: Bounds,
}

impl<'a> Judge<'a> {
    pub fn new(arm: &'a ParallelArm, robot: &'a Robot<6>, made: &'a Made<6>) -> Self {
        Self { arm, robot, made, bounds: Bounds::of(arm, &made.theta, &made.place) }
    }

    /// How far beyond reach the pose is with the shoulder and the wrist of a straight arm, by no
    /// more than such an arm is given for [m]; the uncertainty of x there is no part of
    /// it.
    pub fn beyond_in(&self, solution: &Solution<6>) -> f64 {
        let (arm, slot) = (self.arm, solution.slot.index());
        let Ok(asked) = arm.asked(&self.made.pose) else { return 0.0 };
        let x = arm.x(&self.theta_of(&solution.q)).abs();
        let open = self.rounding() * (1.0 + arm.b() / x.max(f64::MIN_POSITIVE));
        let beyond = asked[slot / 4][slot % 2].missing.abs() + open;
        let straight = solution.singularities().contains(SingularityKind::ELBOW);
        if straight && beyond <= thresholds::REACH_TOLERANCE + open { beyond } else { 0.0 }
    }

    fn theta_of(&self, q: &[f64; 6]) -> [f64; 6] {
        self.arm.theta(q)
    }

    /// Whether the answers have the joint vector that made the pose: as it is, or where a joint is
    /// free as a member of the self-motion.
    fn is_found(&self, solutions: &Solutions<6>) -> bool {
        solutions.iter().any(|solution| {
            let found = self.theta_of(&solution.q);
            if self.bounds.hold(&found, &self.made.theta) {
                return true;
            }
            let Some(free) =
                solution.free_joint.filter(|_| self.bounds.hold_plane(&found, &self.made.theta))
            else {
                return false;
            };
            let value = self.made.q[free.joint() - 1];
            let moved = self.robot.with_free_joint(&self.made.pose, solution, value);
            moved.is_ok_and(|moved| {
                moved.is_some_and(|moved| self.is_on_self_motion(solution, &moved))
            })
        })
    }

    /// Whether a solution moved to the free joint's angle is the one that made the pose. One
    /// straight arm stands for both elbows of the self-motion, and joint 2 of one that is folded
    /// onto axis 2 is free too: of those, the seeded solve has to find the right one.
    fn is_on_self_motion(&self, from: &Solution<6>, moved: &Solution<6>) -> bool {
        let [mut from_theta, mut found] = [&from.q, &moved.q].map(|q| self.theta_of(q));
        let folded = self.is_folding_onto_axis_2()
            && self
                .made
                .place
                .elbow()
                .is_some_and(|off| self.arm.c2 * off <= 2.0 * self.rounding());
        if from.singularities().contains(SingularityKind::ELBOW) || folded {
            [from_theta[1], from_theta[2]] = [self.made.theta[1], self.made.theta[2]];
            [found[1], found[2]] = [self.made.theta[1], self.made.theta[2]];
            found[3] = phi(&self.theta_of(&moved.q)) - found[1] - found[2];
        }
        let bounds = self.bounds_with_six();
        bounds.hold_plane(&from_theta, &self.made.theta)
            && wrapped(found[5] - self.made.theta[5]) <= bounds.six
            && wrapped(phi(&found) - phi(&self.made.theta)) <= bounds.plane + bounds.six
            && wrapped(found[1] - self.made.theta[1]) <= bounds.arm[0]
            && wrapped(found[2] - self.made.theta[2]) <= bounds.arm[1]
    }

    /// The bounds where joint 6 is given.
    fn bounds_with_six(&self) -> Bounds {
        Bounds::of(self.arm, &self.made.theta, &self.made.place.without(At::Wrist))
    }

    fn is_folding_onto_axis_2(&self) -> bool {
        self.made.theta[2].cos() < 0.0 && (self.arm.c2 - self.arm.c3).abs() < 1e-9
    }

    /// How far a solution may be off the pose, seen with the rounding of the position [m].
    fn met(&self) -> f64 {
        thresholds::SEEDED_FREE + self.rounding() + self.made.beyond
    }

    fn rounding(&self) -> f64 {
        thresholds::POSITION_ROUNDING * self.arm.reach()
    }

    /// What the solve that is given the joint vector for a seed finds, and whether that is the
    /// joint vector. Where the pose leaves a joint open that no solution declares free, near two
    /// singularities at once, another branch may be nearer to the seed.
    fn seeded(&self) -> Option<(Solution<6>, bool)> {
        let nearest = self.robot.ik_nearest(&self.made.pose, &self.made.q, &[1.0; 6]).ok()?;
        let residual = self.robot.residual(&nearest.q, &self.made.pose).largest();
        let kept = self.made.place.shoulder().is_none()
            && self.made.place.wrist().is_none_or(|off| off < thresholds::SEEDED_FREE);
        let bounds = if kept { self.bounds_with_six() } else { self.bounds };
        let is_undetermined = !kept && (bounds.six > UNDETERMINED || bounds.arm[0] > UNDETERMINED);
        let closes =
            residual <= self.made.beyond + 3.0 * thresholds::SEEDED_FREE * (1.0 + self.arm.reach());
        Some((
            nearest,
            closes
                && (is_undetermined || bounds.hold(&self.theta_of(&nearest.q), &self.made.theta)),
        ))
    }

    /// Counts solutions that do not close with their free joint elsewhere, or that are in another
    /// slot than they should.
    fn count_incorrect(&self, solutions: &Solutions<6>) -> usize {
        let arm = self.arm;
        // Rounding of the pose moves x by the root of it, near zero.
        let clear = 1e-7 + 2.0 * (2.0 * arm.b() * self.rounding()).sqrt();
        let mut incorrect = 0;
        for solution in solutions {
            let theta = self.theta_of(&solution.q);
            let determined = 4 * usize::from(arm.x(&theta).abs() > clear)
                + 2 * usize::from(theta[2].sin().abs() > 1e-7)
                + usize::from(theta[4].sin().abs() > 1e-8);
            incorrect += usize::from((solution.slot.index() ^ arm.slot(&theta)) & determined != 0);
            incorrect += match solution.free_joint {
                Some(FreeJoint::Parallel) => {
                    self.count_incorrect_along_self_motion(solution, &theta)
                }
                Some(free) => usize::from(
                    free != FreeJoint::Upper
                        || arm.end(&theta).map(f64::abs).iter().sum::<f64>()
                            > 2.0 * self.rounding(),
                ),
                None => 0,
            };
        }
        incorrect
    }

    /// Compares the self-motion of a wrist with the circle of the end of the planar arm:
    /// reached where it is in reach, the tool still.
    fn count_incorrect_along_self_motion(&self, solution: &Solution<6>, theta: &[f64; 6]) -> usize {
        let (robot, arm) = (self.robot, self.arm);
        let off = theta[4].sin().abs();
        let mut incorrect = usize::from(off > thresholds::WRIST_MERGE_SIN);
        for value in [0.7, -2.0, 3.0] {
            let theta_6 = arm.theta(&[value; 6])[5];
            let missing = arm.missing(arm.end_along_self_motion(theta, theta_6)).abs();
            match robot.with_free_joint(&self.made.pose, solution, value) {
                Ok(Some(moved)) => {
                    let residual = robot.residual(&moved.q, &self.made.pose).largest();
                    // Up to a nanometer beyond reach the arm is stretched or folded there too.
                    let bound =
                        self.made.beyond.max(missing) + (2.0 * off + 1e-14) * (1.0 + arm.reach());
                    incorrect += usize::from(
                        residual > bound
                            || missing > thresholds::REACH_TOLERANCE + bound
                            || moved.q[5].to_bits() != value.to_bits(),
                    );
                }
                Ok(None) => incorrect += 1,
                Err(_) => {
                    incorrect += usize::from(
                        arm.margin(arm.end_along_self_motion(theta, theta_6)) > self.rounding(),
                    );
                }
            }
        }
        incorrect
    }

    /// Counts duplicate solutions: the same joints, or two members of a self-motion in place of
    /// one.
    fn count_duplicates(&self, solutions: &Solutions<6>) -> usize {
        let all: Vec<_> = solutions.iter().collect();
        let mut duplicates = 0;
        for (i, one) in all.iter().enumerate() {
            for other in &all[i + 1..] {
                let [a, b] = [one, other].map(|solution| self.theta_of(&solution.q));
                let apart: [f64; 6] = std::array::from_fn(|joint| wrapped(a[joint] - b[joint]));
                let same = apart.iter().all(|apart| *apart < 1e-9);
                let self_motion = one.free_joint == Some(FreeJoint::Parallel)
                    && other.free_joint == one.free_joint
                    && one.slot.index() & 2 == other.slot.index() & 2;
                duplicates += usize::from(same || (self_motion && apart[0] < 1e-9));
            }
        }
        duplicates
    }

    /// Whether the flags of the branch that made the pose are set, and what they say of the slots
    /// is so.
    fn is_flagged(&self, solutions: &Solutions<6>, seeded: &Solution<6>) -> bool {
        let [wrist, shoulder, elbow] =
            [At::Wrist, At::Shoulder, At::Elbow].map(|at| self.made.place.off(at));
        let plane = self.bounds.plane - FOUND;
        let mine: Vec<_> = solutions
            .iter()
            .filter(|solution| {
                self.bounds.hold_plane(&self.theta_of(&solution.q), &self.made.theta)
            })
            .collect();
        let (is_wrist, is_none) = (
            wrist.is_some_and(|off| off + plane < thresholds::WRIST_MERGE_SIN),
            wrist.is_none_or(|off| off - plane > thresholds::WRIST_MERGE_SIN),
        );
        let wrist_flagged = |solution: &Solution<6>| {
            let determined = solution.singularities().contains(SingularityKind::WRIST)
                && solution.free_joint == Some(FreeJoint::Parallel);
            (!is_wrist || determined)
                && (!is_none || solution.free_joint != Some(FreeJoint::Parallel))
        };
        let status = solutions.status();
        let merged_flagged = |solution: &Solution<6>| {
            let slot = solution.slot.index();
            [(SingularityKind::WRIST, 1), (SingularityKind::ELBOW, 2)].iter().all(|(kind, bit)| {
                !solution.singularities().contains(*kind)
                    || (status[slot ^ bit].contains(Status::MERGED | (*kind).into())
                        && solutions.slot(slot ^ bit).is_none())
            })
        };
        // Joint 6 that is off by rounding over sin theta_5 bends the arm, and so does x that is off
        // by rounding times b over x; folded onto axis 2, rounding itself does.
        let x_is_known = self.arm.b() < self.arm.x(&self.made.theta).abs();
        let straight = if self.is_folding_onto_axis_2() { 0.0 } else { 1e-8 };
        let six_is_known = wrist.is_none_or(|off| off == 0.0);
        let is_elbow = elbow.is_some_and(|off| off <= straight) && six_is_known && x_is_known;
        let is_shoulder =
            shoulder.is_some_and(|off| off <= 0.5 * (2.0 * self.arm.b() * self.rounding()).sqrt());
        mine.iter().all(|solution| wrist_flagged(solution))
            && solutions.iter().all(merged_flagged)
            && (!is_elbow || seeded.singularities().contains(SingularityKind::ELBOW))
            && (!is_shoulder
                || mine
                    .iter()
                    .all(|solution| solution.singularities().contains(SingularityKind::SHOULDER)))
    }

    /// Whether the representative of the wrist's self-motion has joint 6 at rest, or as near to it
    /// as the arm reaches, in both elbows; by trying angles of joint 6 all around. With a seed, the
    /// nearest member.
    fn is_nearest_of_self_motion(&self, solutions: &Solutions<6>, rng: &mut Rng) -> bool {
        let shoulder = 4 * usize::from(self.arm.x(&self.made.theta) < 0.0);
        let determined = [0, 2].map(|elbow| {
            let of_slots = [0, 1].map(|wrist| solutions.slot(shoulder + elbow + wrist));
            let merged = [0, 1].iter().all(|wrist| {
                solutions.status()[shoulder + elbow + wrist]
                    .contains(Status::MERGED | Status::ELBOW)
            });
            match of_slots {
                [Some(solution), None] | [None, Some(solution)] => {
                    self.is_nearest_reached(solution, 0.0)
                }
                [None, None] => merged,
                _ => false,
            }
        });
        let mut seed = self.made.q;
        seed[5] = rng.between(-PI, PI);
        let seeded = self.robot.ik_nearest(&self.made.pose, &seed, &[1.0; 6]).unwrap();
        let of_self_motion = self.bounds.hold_plane(&self.theta_of(&seeded.q), &self.made.theta);
        determined == [true; 2]
            && (!of_self_motion || self.is_nearest_of_members(solutions, &seeded, &seed))
    }

    /// Whether no member of a self-motion is nearer to the seed than the solution, by trying angles
    /// of joint 6 all around.
    fn is_nearest_of_members(
        &self,
        solutions: &Solutions<6>,
        nearest: &Solution<6>,
        seed: &[f64; 6],
    ) -> bool {
        let cost = |q: &[f64; 6]| (0..6).map(|i| wrapped(q[i] - seed[i]).powi(2)).sum::<f64>();
        let least = cost(&nearest.q);
        let self_motions =
            solutions.iter().filter(|found| found.free_joint == Some(FreeJoint::Parallel));
        let angles = self.reached_angles();
        let mut members = self_motions.flat_map(|self_motion| {
            angles.iter().filter_map(|value| {
                self.robot.with_free_joint(&self.made.pose, self_motion, *value).ok()?
            })
        });
        let theta_6 = self.arm.theta(&[nearest.q[5]; 6])[5];
        let missing = self.arm.missing(self.arm.end_along_self_motion(&self.made.theta, theta_6));
        missing.abs() <= self.met()
            && least <= cost(&self.made.q) + 1e-9
            && members.all(|member| least <= cost(&member.q) + 1e-9)
    }

    /// Angles of joint 6 all around, and on each arc of the family that is in reach, however
    /// narrow, the denser the nearer to its ends. Those with which the arm reaches: beyond the
    /// edges a stretched or folded arm is given up to a nanometer from there, and is no member.
    fn reached_angles(&self) -> Vec<f64> {
        let (arm, theta) = (self.arm, &self.made.theta);
        let around = (0..180).map(|step| arm.theta(&[TAU * f64::from(step) / 180.0 - PI; 6])[5]);
        let sign = -theta[4].cos().signum();
        let [from_line, least, most] = arm.circle(theta);
        let arcs = [[least, most], [-most, -least], [-most, most]];
        let on_arcs = arcs.into_iter().flat_map(|[low, high]| {
            (0..=60).map(move |step| {
                let part = 0.5 - 0.5 * (PI * f64::from(step) / 60.0).cos();
                theta[5] + sign * (low + (high - low) * part - from_line)
            })
        });
        around
            .chain(on_arcs)
            .filter(|theta_6| {
                arm.missing(arm.end_along_self_motion(theta, *theta_6)).abs() <= self.rounding()
            })
            .map(|theta_6| arm.q([theta_6; 6])[5])
            .collect()
    }

    /// Whether no angle of joint 6 that is nearer to `wanted` than the solution's is reached, and
    /// the solution's is.
    fn is_nearest_reached(&self, solution: &Solution<6>, wanted: f64) -> bool {
        let arm = self.arm;
        let missing = |q6: f64| {
            arm.missing(arm.end_along_self_motion(&self.made.theta, arm.theta(&[q6; 6])[5])).abs()
        };
        let distance = wrapped(solution.q[5] - wanted);
        let steps = 720;
        // Where the circle touches the edge of reach, rounding opens an arc of this to either side.
        let open = 2.0 * (self.rounding() / arm.d5).sqrt();
        let nearer = (0..steps)
            .map(|step| PI * f64::from(step) / f64::from(steps))
            .take_while(|off| *off < distance - open);
        let mut ways = nearer.flat_map(|off| [wanted - off, wanted + off]);
        missing(solution.q[5]) <= self.met() && ways.all(|q6| missing(q6) > self.rounding())
    }

    pub fn judge(&self, solutions: &Solutions<6>, rng: &mut Rng) -> Verdict {
        let seeded = self.seeded();
        let is_on_a_self_motion = self.made.place.wrist() == Some(0.0)
            && self.bounds.plane < FOUND + 1e-12
            && self.made.beyond == 0.0;
        Verdict {
            found: self.is_found(solutions) && seeded.is_some_and(|(_, found)| found),
            incorrect: self.count_incorrect(solutions),
            duplicates: self.count_duplicates(solutions),
            flagged: seeded.is_some_and(|(seeded, _)| self.is_flagged(solutions, &seeded))
                && (!is_on_a_self_motion || self.is_nearest_of_self_motion(solutions, rng)),
        }
    }
}
