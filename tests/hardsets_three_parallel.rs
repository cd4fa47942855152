//! Poses of arms with three parallel axes at and next to every singularity: each branch is found, nothing is wrong, nothing comes twice.
//!
//! `make hardsets` prints one row a set with more poses; `make test` runs fewer.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common;
mod place;

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::parallel_arm::{ParallelArm, wrapped};
use crate::common::tally::Tally;
use crate::common::{Rng, asked_set};
use irbkin::{FreeJoint, Pose, Robot, Solution, Solutions, Status, thresholds};
use nalgebra::Vector3;
use self::place::{Bounds, FOUND, OPEN, Place, clear_of_axis_1, phi, place};

const NEAR: [f64; 7] = [0.0, 1e-12, 1e-9, 2e-9, 1e-7, 1e-6, 1e-4];
const BEYOND: [f64; 4] = [1e-12, 9e-10, 1e-6, 1e-3];

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(60, |count| count.parse().unwrap())
}

/// An arm with its robot.
struct Subject {
    name: &'static str,
    arm: ParallelArm,
    robot: Robot<6>,
}

/// A pose with the joint vector that made it.
struct Made<'a> {
    subject: &'a Subject,
    place: Place,
    theta: [f64; 6],
    q: [f64; 6],
    pose: Pose,
    bounds: Bounds,
    /// What the pose is beyond reach [m].
    beyond: f64,
}

impl<'a> Made<'a> {
    fn new(subject: &'a Subject, place: Place, theta: [f64; 6]) -> Self {
        let q = subject.arm.q(theta);
        let (pose, bounds) = (subject.robot.fk(&q), Bounds::of(&subject.arm, &theta, place));
        Self { subject, place, theta, q, pose, bounds, beyond: 0.0 }
    }

    fn theta_of(&self, q: &[f64; 6]) -> [f64; 6] {
        self.subject.arm.theta(q)
    }

    /// Whether the answers have the joint vector that made the pose: as it is, or where a joint is free as a member of the family.
    fn is_found(&self, solutions: &Solutions<6>) -> bool {
        solutions.iter().any(|solution| {
            let found = self.theta_of(&solution.q);
            if self.bounds.hold(&found, &self.theta) {
                return true;
            }
            let Some(free) = solution.free.filter(|_| self.bounds.hold_plane(&found, &self.theta))
            else {
                return false;
            };
            let value = self.q[free.joint() - 1];
            let moved = self.subject.robot.with_free(&self.pose, solution, value);
            moved.is_ok_and(|moved| {
                moved.is_some_and(|moved| self.is_family_member(solution, &moved))
            })
        })
    }

    /// Whether a solution moved to the free joint's angle is the one that made the pose. One straight arm stands for both elbows of the family,
    /// and joint 2 of one that is folded onto axis 2 is free too: of those, the seeded solve has to find the right one.
    fn is_family_member(&self, from: &Solution<6>, moved: &Solution<6>) -> bool {
        let [mut from_theta, mut found] = [&from.q, &moved.q].map(|q| self.theta_of(q));
        let folded = self.is_folding_onto_axis_2()
            && self
                .place
                .elbow
                .is_some_and(|off| self.subject.arm.c2 * off <= 2.0 * self.rounding());
        if from.kinds().contains(Status::ELBOW) || folded {
            [from_theta[1], from_theta[2]] = [self.theta[1], self.theta[2]];
            [found[1], found[2]] = [self.theta[1], self.theta[2]];
            found[3] = phi(&self.theta_of(&moved.q)) - found[1] - found[2];
        }
        let bounds = self.bounds_with_six();
        bounds.hold_plane(&from_theta, &self.theta)
            && wrapped(found[5] - self.theta[5]) <= bounds.six
            && wrapped(phi(&found) - phi(&self.theta)) <= bounds.plane + bounds.six
            && wrapped(found[1] - self.theta[1]) <= bounds.arm[0]
            && wrapped(found[2] - self.theta[2]) <= bounds.arm[1]
    }

    /// The bounds where joint 6 is given.
    fn bounds_with_six(&self) -> Bounds {
        Bounds::of(&self.subject.arm, &self.theta, Place { wrist: None, ..self.place })
    }

    fn is_folding_onto_axis_2(&self) -> bool {
        self.theta[2].cos() < 0.0 && (self.subject.arm.c2 - self.subject.arm.c3).abs() < 1e-9
    }

    fn rounding(&self) -> f64 {
        thresholds::POSITION_ROUNDING * self.subject.arm.reach()
    }

    /// What the solve that is given the joint vector for a seed finds, and whether that is the joint vector. Where the pose leaves a joint open
    /// that no solution declares free, next to two singularities at once, another branch may be nearer to the seed.
    fn seeded(&self) -> Option<(Solution<6>, bool)> {
        let nearest = self.subject.robot.ik_nearest(&self.pose, &self.q, &[1.0; 6]).ok()?;
        let residual = self.subject.robot.residual(&nearest.q, &self.pose).largest();
        let kept = self.place.shoulder.is_none()
            && self.place.wrist.is_none_or(|off| off < thresholds::SEEDED_FREE);
        let bounds = if kept { self.bounds_with_six() } else { self.bounds };
        let is_open = !kept && (bounds.six > OPEN || bounds.arm[0] > OPEN);
        let closes = residual
            <= self.beyond + 3.0 * thresholds::SEEDED_FREE * (1.0 + self.subject.arm.reach());
        Some((nearest, closes && (is_open || bounds.hold(&self.theta_of(&nearest.q), &self.theta))))
    }

    /// Counts solutions that do not close, by themselves or with their free joint elsewhere, or that are in another slot than they should.
    fn count_wrong(&self, solutions: &Solutions<6>, tally: &mut Tally) {
        let (robot, arm, reach) =
            (&self.subject.robot, &self.subject.arm, self.subject.arm.reach());
        // Rounding of the pose moves x by the root of it, next to zero.
        let clear = 1e-7 + 2.0 * (2.0 * arm.b() * self.rounding()).sqrt();
        for solution in solutions {
            let residual = robot.residual(&solution.q, &self.pose);
            tally.position = tally.position.max(residual.position);
            tally.rotation = tally.rotation.max(residual.rotation);
            tally.wrong += usize::from(
                residual.position > self.beyond + 3e-15 * reach || residual.rotation > 1e-14,
            );
            let theta = self.theta_of(&solution.q);
            let told = 4 * usize::from(arm.x(&theta).abs() > clear)
                + 2 * usize::from(theta[2].sin().abs() > 1e-7)
                + usize::from(theta[4].sin().abs() > 1e-8);
            tally.wrong += usize::from((usize::from(solution.slot) ^ arm.slot(&theta)) & told != 0);
            tally.wrong += match solution.free {
                Some(FreeJoint::Parallel) => self.count_wrong_along_family(solution, &theta),
                Some(free) => usize::from(
                    free != FreeJoint::Upper
                        || arm.end(&theta).map(f64::abs).iter().sum::<f64>()
                            > 2.0 * self.rounding(),
                ),
                None => 0,
            };
        }
    }

    /// Holds the family of a wrist against the circle on which the end of the planar arm runs: reached where it is in reach, the tool still.
    fn count_wrong_along_family(&self, solution: &Solution<6>, theta: &[f64; 6]) -> usize {
        let (robot, arm) = (&self.subject.robot, &self.subject.arm);
        let off = theta[4].sin().abs();
        let mut wrong = usize::from(off > thresholds::WRIST_MERGE_SIN);
        for value in [0.7, -2.0, 3.0] {
            let theta_6 = arm.theta(&[value; 6])[5];
            let missing = arm.missing(arm.end_along_family(theta, theta_6)).abs();
            match robot.with_free(&self.pose, solution, value) {
                Ok(Some(moved)) => {
                    let residual = robot.residual(&moved.q, &self.pose).largest();
                    // Up to a nanometre beyond reach the arm is stretched or folded there too.
                    let bound =
                        self.beyond.max(missing) + (2.0 * off + 1e-14) * (1.0 + arm.reach());
                    wrong += usize::from(
                        residual > bound
                            || missing > thresholds::REACH_TOLERANCE + bound
                            || moved.q[5].to_bits() != value.to_bits(),
                    );
                }
                Ok(None) => wrong += 1,
                Err(_) => {
                    wrong += usize::from(
                        arm.margin(arm.end_along_family(theta, theta_6)) > self.rounding(),
                    )
                }
            }
        }
        wrong
    }

    /// Counts solutions that come twice: the same joints, or two members of a family in place of one.
    fn count_twice(&self, solutions: &Solutions<6>, tally: &mut Tally) {
        let all: Vec<_> = solutions.iter().collect();
        for (i, one) in all.iter().enumerate() {
            for other in &all[i + 1..] {
                let [a, b] = [one, other].map(|solution| self.theta_of(&solution.q));
                let apart: [f64; 6] = std::array::from_fn(|joint| wrapped(a[joint] - b[joint]));
                let same = apart.iter().all(|apart| *apart < 1e-9);
                let family = one.free == Some(FreeJoint::Parallel)
                    && other.free == one.free
                    && one.slot & 2 == other.slot & 2;
                tally.twice += usize::from(same || (family && apart[0] < 1e-9));
            }
        }
    }

    /// Whether the flags of the branch that made the pose are told, and what they say of the slots is so.
    fn is_flagged(&self, solutions: &Solutions<6>, seeded: &Solution<6>) -> bool {
        let Place { wrist, shoulder, elbow } = self.place;
        let plane = self.bounds.plane - FOUND;
        let mine: Vec<_> = solutions
            .iter()
            .filter(|solution| self.bounds.hold_plane(&self.theta_of(&solution.q), &self.theta))
            .collect();
        let (is_wrist, is_none) = (
            wrist.is_some_and(|off| off + plane < thresholds::WRIST_MERGE_SIN),
            wrist.is_none_or(|off| off - plane > thresholds::WRIST_MERGE_SIN),
        );
        let wrist_told = |solution: &Solution<6>| {
            let told = solution.kinds().contains(Status::WRIST)
                && solution.free == Some(FreeJoint::Parallel);
            (!is_wrist || told) && (!is_none || solution.free != Some(FreeJoint::Parallel))
        };
        let status = solutions.status();
        let merged_told = |solution: &Solution<6>| {
            let slot = usize::from(solution.slot);
            [(Status::WRIST, 1), (Status::ELBOW, 2)].iter().all(|(kind, bit)| {
                !solution.kinds().contains(*kind)
                    || (status[slot ^ bit].contains(Status::MERGED | *kind)
                        && solutions.slot(slot ^ bit).is_none())
            })
        };
        // Joint 6 that is off by rounding over sin theta_5 bends the arm, and so does x that is off by rounding times b over x; folded onto
        // axis 2, rounding itself does.
        let x_is_known = self.subject.arm.b() < self.subject.arm.x(&self.theta).abs();
        let straight = if self.is_folding_onto_axis_2() { 0.0 } else { 1e-8 };
        let six_is_known = wrist.is_none_or(|off| off == 0.0);
        let is_elbow = elbow.is_some_and(|off| off <= straight) && six_is_known && x_is_known;
        let is_shoulder = shoulder.is_some_and(|off| {
            off <= 0.5 * (self.subject.arm.b() * thresholds::LATERAL_MERGE).sqrt()
        });
        mine.iter().all(|solution| wrist_told(solution))
            && solutions.iter().all(merged_told)
            && (!is_elbow || seeded.kinds().contains(Status::ELBOW))
            && (!is_shoulder
                || mine.iter().all(|solution| solution.kinds().contains(Status::SHOULDER)))
    }

    /// Whether the representative of the wrist's family has joint 6 at rest, or as near to it as the arm reaches, in both elbows; by trying
    /// angles of joint 6 all around. So too with a seed.
    fn is_nearest_of_family(&self, solutions: &Solutions<6>, rng: &mut Rng) -> bool {
        let shoulder = 4 * usize::from(self.subject.arm.x(&self.theta) < 0.0);
        let told = [0, 2].map(|elbow| {
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
        let mut seed = self.q;
        seed[5] = rng.between(-PI, PI);
        let seeded = self.subject.robot.ik_nearest(&self.pose, &seed, &[1.0; 6]).unwrap();
        let of_family = self.bounds.hold_plane(&self.theta_of(&seeded.q), &self.theta);
        told == [true; 2] && (!of_family || self.is_nearest_reached(&seeded, seed[5]))
    }

    /// Whether no angle of joint 6 that is nearer to `wanted` than the solution's is reached, and the solution's is.
    fn is_nearest_reached(&self, solution: &Solution<6>, wanted: f64) -> bool {
        let arm = &self.subject.arm;
        let missing =
            |q6: f64| arm.missing(arm.end_along_family(&self.theta, arm.theta(&[q6; 6])[5])).abs();
        let distance = wrapped(solution.q[5] - wanted);
        let steps = 720;
        // Where the circle touches the edge of reach, rounding opens an arc of this to either side.
        let open = 2.0 * (self.rounding() / arm.d5).sqrt();
        let nearer = (0..steps)
            .map(|step| PI * f64::from(step) / f64::from(steps))
            .take_while(|off| *off < distance - open);
        let mut ways = nearer.flat_map(|off| [wanted - off, wanted + off]);
        missing(solution.q[5]) <= 1e-12 + self.beyond
            && ways.all(|q6| missing(q6) > self.rounding())
    }

    fn judge(&self, tally: &mut Tally, rng: &mut Rng) {
        let solutions = self.subject.robot.ik(&self.pose).unwrap();
        tally.poses += 1;
        tally.solutions += solutions.len();
        self.count_wrong(&solutions, tally);
        self.count_twice(&solutions, tally);
        let seeded = self.seeded();
        tally.found +=
            usize::from(self.is_found(&solutions) && seeded.is_some_and(|(_, found)| found));
        tally.flags +=
            usize::from(!seeded.is_some_and(|(seeded, _)| self.is_flagged(&solutions, &seeded)));
        if self.place.wrist == Some(0.0) && self.bounds.plane < FOUND + 1e-12 && self.beyond == 0.0
        {
            tally.flags += usize::from(!self.is_nearest_of_family(&solutions, rng));
        }
    }
}

fn sets() -> Vec<(String, Place)> {
    let mut sets = Vec::new();
    for off in NEAR {
        let [wrist, shoulder, elbow] = [Some(off); 3];
        sets.push((format!("wrist {off:e}"), Place { wrist, ..Place::default() }));
        sets.push((format!("shoulder {off:e}"), Place { shoulder, ..Place::default() }));
        sets.push((format!("elbow {off:e}"), Place { elbow, ..Place::default() }));
        sets.push((format!("all three {off:e}"), Place { wrist, shoulder, elbow }));
    }
    for first in NEAR {
        for second in NEAR {
            let (a, b) = (Some(first), Some(second));
            sets.push((
                format!("wrist {first:e}, shoulder {second:e}"),
                Place { wrist: a, shoulder: b, elbow: None },
            ));
            sets.push((
                format!("wrist {first:e}, elbow {second:e}"),
                Place { wrist: a, shoulder: None, elbow: b },
            ));
            sets.push((
                format!("shoulder {first:e}, elbow {second:e}"),
                Place { wrist: None, shoulder: a, elbow: b },
            ));
        }
    }
    sets
}

/// Stretched or folded arms with the wrist moved along the line from axis 2 to the end of the planar arm, out of reach; no other branch reaches.
fn beyond_reach<'a>(subject: &'a Subject, beyond: f64, rng: &mut Rng) -> Option<(Made<'a>, Pose)> {
    let (arm, elbow) = (&subject.arm, Place { elbow: Some(0.0), ..Place::default() });
    let made = Made::new(subject, elbow, place(arm, elbow, rng));
    let [x, z] = arm.end(&made.theta);
    let r = x.hypot(z);
    let outward = if made.theta[2] == 0.0 { beyond } else { -beyond };
    let in_plane =
        Vector3::new(x / r * made.theta[0].cos(), x / r * made.theta[0].sin(), z / r) * outward;
    let mut pose = made.pose;
    pose.translation.vector += arm.base.rotation * in_plane;
    let missing = arm.asked(&pose).ok()?.map(|wrists| wrists.map(|asked| asked.missing.abs()));
    let mut sorted = missing.concat();
    sorted.sort_by(f64::total_cmp);
    (r.min(sorted[1]) > 0.04 * arm.c2).then_some((made, pose))
}

/// Up to a nanometre beyond reach the arm is stretched or folded, off by no more than that; farther out there is nothing, and the right
/// shortfall.
fn run_beyond(subject: &Subject, rng: &mut Rng) -> String {
    let mut report = String::new();
    for beyond in BEYOND {
        let mut tally = Tally::default();
        while tally.poses < poses() {
            let Some((made, pose)) = beyond_reach(subject, beyond, rng) else { continue };
            if beyond <= thresholds::REACH_TOLERANCE {
                Made { pose, beyond, ..made }.judge(&mut tally, rng);
                continue;
            }
            tally.take_missed(&subject.robot.ik(&pose).unwrap(), beyond);
        }
        report += &tally.tell(subject.name, &format!("beyond reach by {beyond:e} m"));
    }
    report
}

/// Straight arms with a straight wrist and axis 5 along the links: joint 6 is free, and the arm reaches with one angle of it alone. So stands a
/// Universal Robots arm that points straight up, over axis 1.
fn run_along_the_line(subject: &Subject, rng: &mut Rng) -> String {
    let mut tally = Tally::default();
    let set = Place { wrist: Some(0.0), elbow: Some(0.0), shoulder: None };
    while tally.poses < poses() {
        let mut theta = place(&subject.arm, set, rng);
        theta[3] = if rng.unit() < 0.5 { 0.0 } else { PI };
        // Folded onto axis 2, no line is the arm's.
        if subject.arm.x(&theta).abs() > clear_of_axis_1(&subject.arm)
            && subject.arm.end(&theta)[0].hypot(subject.arm.end(&theta)[1]) > 0.04 * subject.arm.c2
        {
            Made::new(subject, set, theta).judge(&mut tally, rng);
        }
    }
    let mut up = Tally::default();
    let set = Place { shoulder: Some(0.0), ..set };
    while up.poses < poses() && subject.arm.a1 == 0.0 {
        let theta = [
            rng.between(-PI, PI),
            0.0,
            0.0,
            0.0,
            if rng.unit() < 0.5 { 0.0 } else { PI },
            rng.between(-PI, PI),
        ];
        Made::new(subject, set, theta).judge(&mut up, rng);
    }
    let report = tally.tell(subject.name, "axis 5 along the straight arm");
    if up.poses == 0 { report } else { report + &up.tell(subject.name, "straight up") }
}

fn run(subject: &Subject) -> String {
    let mut rng = Rng::new(7);
    let mut report = run_beyond(subject, &mut rng);
    let zero = Made::new(
        subject,
        Place { wrist: Some(0.0), elbow: Some(0.0), shoulder: None },
        subject.arm.theta(&[0.0; 6]),
    );
    // The zero pose of a Universal Robots arm: stretched, its wrist straight.
    if zero.theta[2] == 0.0 && zero.theta[4] == 0.0 {
        let mut home = Tally::default();
        zero.judge(&mut home, &mut rng);
        report += &home.tell(subject.name, "J1 to J6 = 0");
        let mut level = Tally::default();
        let elbow = Place { elbow: Some(0.0), ..Place::default() };
        while level.poses < poses() {
            let q =
                [rng.between(-PI, PI), 0.0, 0.0, 0.0, rng.between(0.2, 2.9), rng.between(-PI, PI)];
            Made::new(subject, elbow, subject.arm.theta(&q)).judge(&mut level, &mut rng);
        }
        report += &level.tell(subject.name, "J2 = J3 = J4 = 0");
    }
    report += &run_along_the_line(subject, &mut rng);
    for (name, set) in sets() {
        let mut tally = Tally::default();
        for _ in 0..poses() {
            Made::new(subject, set, place(&subject.arm, set, &mut rng)).judge(&mut tally, &mut rng);
        }
        report += &tally.tell(subject.name, &name);
    }
    report
}

fn check(name: &'static str, arm: ParallelArm, robot: Robot<6>) {
    asked_set();
    let report = run(&Subject { name, arm, robot });
    assert!(report.is_empty(), "\n{report}");
}

#[test]
fn ur3() {
    let (arm, robot) = ParallelArm::universal("UR3");
    check("UR3", arm, robot);
}

#[test]
fn ur10e() {
    let (arm, robot) = ParallelArm::universal("UR10e");
    check("UR10e", arm, robot);
}

#[test]
fn equal_links_with_signs_and_offsets() {
    let arm = ParallelArm {
        a1: 0.07,
        b: [0.2, -0.13, 0.04],
        c1: 0.3,
        c2: 0.35,
        c3: 0.35,
        d5: 0.08,
        d6: 0.11,
        signs: [-1.0, 1.0, -1.0, -1.0, 1.0, -1.0],
        offsets: [0.25, 0.4, -FRAC_PI_2, 1.1, -0.7, 0.3],
        base: Pose::identity(),
        flange: Pose::identity(),
    };
    let robot = arm.robot();
    check("equal links, odd frames", arm, robot);
}
