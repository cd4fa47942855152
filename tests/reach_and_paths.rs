//! Near the edge of reach and several singularities at once: a pose made by a joint vector has its
//! solution, rounding merges exactly what it must, each slot reaches independently, and smooth
//! joint paths are followed.
//!
//! `IRBKIN_POSES` sets the number of poses; each law prints its rates.
#![allow(clippy::cast_precision_loss)]

mod arm;
use crate::common;

use crate::common::{Rng, asked_set};
use arm::{Arm, Near, arms, equal_links, irb_2600, lateral, log_uniform, sign, universal, wrapped};
use irbkin::{Pose, Robot, Status, follow::FollowOptions, thresholds};
use nalgebra::Vector3;

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(60, |count| count.parse().unwrap())
}

/// Cases that violate a law, of all of a set.
#[derive(Default)]
struct Count {
    of: usize,
    failed: usize,
    first: String,
}

impl Count {
    fn take(&mut self, holds: bool, case: impl FnOnce() -> String) {
        self.of += 1;
        if !holds {
            self.failed += 1;
            if self.first.is_empty() {
                self.first = case();
            }
        }
    }

    /// Prints the rate; returns it if it is not zero.
    fn row(&self, set: &str) -> String {
        let row = format!("{set:60} {:6} of {:7} {}", self.failed, self.of, self.first);
        println!("{row}");
        assert!(self.of > 0, "{set}: no pose");
        if self.failed > 0 { row + "\n" } else { String::new() }
    }
}

fn assert_none(report: &str) {
    assert!(report.is_empty(), "\n{report}");
}

/// Whether one of the solutions of a pose is in the plane of the joint vector that made it, with
/// its joint 5, within the uncertainty of rounding.
fn is_found(arm: &Arm, theta: &[f64; 6], pose: &Pose) -> bool {
    let solutions = arm.robot.ik(pose).unwrap();
    let open = 2.0 * plane_uncertainty(arm, arm.x(theta)) + 1e-12;
    // The twin of a shoulder may be near enough to reach to get the straight arm.
    let beyond = thresholds::REACH_TOLERANCE;
    solutions.iter().all(|solution| arm.meets(&solution.q, pose, beyond))
        && solutions.iter().any(|solution| {
            let found = arm.theta(&solution.q);
            arm.meets(&solution.q, pose, 0.0)
                && wrapped(found[0] - theta[0]) <= open
                && (wrapped(found[4]) - wrapped(theta[4])).abs() <= open + 1e-9
        })
}

/// How far rounding may rotate the plane of the arm (eq. 42) [rad].
fn plane_uncertainty(arm: &Arm, x: f64) -> f64 {
    let (x, p) = (x.abs(), arm.rounding());
    let inward = if x * x > 2.0 * arm.b * p {
        2.0 * p / (x + (x * x - 2.0 * arm.b * p).sqrt())
    } else {
        x / arm.b
    };
    inward.max(2.0 * p / (x + (x * x + 2.0 * arm.b * p).sqrt()))
        + if x <= arm.shoulder_rounding() { arm.shoulder_rounding() / arm.b } else { 0.0 }
}

#[test]
fn straight_elbows_near_the_shoulder_singularity_have_their_solution() {
    asked_set();
    let mut report = String::new();
    for arm in universal() {
        let edge = (2.0 * arm.b * arm.rounding()).sqrt();
        let rng = &mut Rng::new(11);
        let mut check = |set: &str, near: &dyn Fn(&mut Rng) -> Near| {
            let mut count = Count::default();
            for _ in 0..10 * poses() {
                let theta = arm.placed(near(rng), rng);
                let q = arm.q(theta);
                let pose = arm.robot.fk(&q);
                let seeded = arm.robot.ik_nearest(&pose, &q, &[1.0; 6]);
                let holds = is_found(&arm, &theta, &pose) && seeded.is_ok();
                count.take(holds, || format!("{q:?}"));
            }
            report += &count.row(&format!("{}, {set}", arm.name));
        };
        check("at the edge of what rounding merges", &|rng| Near {
            shoulder: Some(edge * rng.between(0.9, 1.5)),
            elbow: Some(0.0),
            wrist: None,
        });
        check("elbow straight, shoulder anywhere", &|rng| Near {
            shoulder: Some(log_uniform(rng, -15.0, -2.0)),
            elbow: Some(0.0),
            wrist: None,
        });
        check("elbow and shoulder", &|rng| Near {
            shoulder: Some(log_uniform(rng, -15.0, -2.0)),
            elbow: Some(log_uniform(rng, -15.0, -2.0)),
            wrist: None,
        });
        check("wrist, elbow and shoulder", &|rng| Near {
            shoulder: Some(log_uniform(rng, -15.0, -2.0)),
            elbow: Some(log_uniform(rng, -15.0, -2.0)),
            wrist: Some(log_uniform(rng, -15.0, -2.0)),
        });
    }
    assert_none(&report);
}

/// For arms with three parallel axes, the uncertainty of joint 6, and with it of the end of the
/// planar arm, is a rounding over sin q5.
#[test]
fn elbows_that_rounding_merges_are_one() {
    asked_set();
    let mut report = String::new();
    for arm in universal() {
        let rng = &mut Rng::new(12);
        let mut check = |set: &str, near: &dyn Fn(&mut Rng) -> Near| {
            let mut count = Count::default();
            for _ in 0..100 * poses() {
                let theta = arm.placed(near(rng), rng);
                let q = arm.q(theta);
                let solutions = arm.robot.ik(&arm.robot.fk(&q)).unwrap();
                let slot = arm.slot(&theta);
                let met = arm.x(&theta).abs() <= arm.shoulder_rounding();
                let shoulders = if met { [0, 4] } else { [slot & 4; 2] };
                // One of the two elbows of the branch, flagged as representing both.
                let holds = shoulders.iter().any(|shoulder| {
                    let twins = [0, 2].map(|elbow| shoulder + elbow + (slot & 1));
                    let found = twins.map(|slot| solutions.slot(slot).is_some());
                    let status = solutions.status()[twins[1]];
                    found == [true, false] && status.contains(Status::ELBOW | Status::MERGED)
                });
                count.take(holds, || format!("{q:?}"));
            }
            report += &count.row(&format!("{}, {set}", arm.name));
        };
        for elbow in [0.0, 2e-9, 1e-8] {
            let elbow = Some(elbow);
            check(&format!("J3 {elbow:?}"), &|_| Near { elbow, ..Near::default() });
            check(&format!("J3 {elbow:?}, next to the wrist"), &|rng| Near {
                elbow,
                wrist: Some(log_uniform(rng, -8.0, 0.0)),
                shoulder: None,
            });
            check(&format!("J3 {elbow:?}, next to the shoulder"), &|rng| Near {
                elbow,
                shoulder: Some(log_uniform(rng, -7.0, -1.0)),
                wrist: None,
            });
        }
    }
    assert_none(&report);
}

#[test]
fn elbows_that_rounding_does_not_merge_are_two() {
    asked_set();
    let mut report = String::new();
    for arm in arms() {
        let (rng, mut count) = (&mut Rng::new(13), Count::default());
        while count.of < 100 * poses() {
            let elbow = log_uniform(rng, -8.0, -2.0);
            let wrist = log_uniform(rng, -8.0, 0.0);
            let near = Near { elbow: Some(elbow), wrist: Some(wrist), shoulder: None };
            let theta = arm.placed(near, rng);
            let (q, [x, z]) = (arm.q(theta), arm.end(&theta));
            let r = x.hypot(z);
            if r < 1e-3 * arm.c2 {
                continue;
            }
            // How far straightening moves the end of the planar arm, and how far rounding does.
            let moved = arm.c2 * arm.k * elbow.sin().powi(2) / (2.0 * r);
            let plane = plane_uncertainty(&arm, arm.x(&theta)) + 2.0 * thresholds::WRIST_FREE_SIN;
            let open = 2.0 * arm.rounding() + arm.d5 * plane / wrist.sin();
            if moved < open {
                continue;
            }
            let solutions = arm.robot.ik(&arm.robot.fk(&q)).unwrap();
            let slot = arm.slot(&theta);
            // The uncertainty of the forearm may merge the wrist of an arm whose axes 4, 5 and 6
            // intersect.
            let merged = usize::from(!arm.is_universal());
            let holds = [slot, slot ^ 2].iter().all(|slot| {
                [*slot, *slot ^ merged].iter().any(|slot| solutions.slot(*slot).is_some())
            });
            count.take(holds, || format!("{q:?}"));
        }
        report += &count.row(&arm.name);
    }
    assert_none(&report);
}

/// Straight arms with the wrist moved beyond reach along the line of the arm.
#[test]
fn each_slot_just_beyond_reach_has_the_straight_arm() {
    asked_set();
    let mut report = String::new();
    for arm in arms() {
        for wrist in [None, Some(0.0)] {
            let (rng, mut count, mut others) = (&mut Rng::new(14), Count::default(), 0);
            while count.of < 10 * poses() {
                let theta = arm.placed(Near { elbow: Some(0.0), wrist, ..Near::default() }, rng);
                let [x, z] = arm.end(&theta);
                let r = x.hypot(z);
                if r < 1e-3 * arm.c2 {
                    continue;
                }
                let beyond = log_uniform(rng, -12.0, 9e-10_f64.log10());
                let outward = if arm.elbow(&theta).cos() > 0.0 { beyond } else { -beyond };
                let (sin_1, cos_1) = theta[0].sin_cos();
                // In front of the base of an arm of Universal Robots is -x.
                let forward = if arm.is_universal() { -1.0 } else { 1.0 };
                let line =
                    Vector3::new(forward * x * cos_1, forward * x * sin_1, z) * (outward / r);
                let mut pose = arm.robot.fk(&arm.q(theta));
                pose.translation.vector += arm.robot.base().rotation * line;
                let solutions = arm.robot.ik(&pose).unwrap();
                let status = solutions.status();
                let slots = [0, 1].map(|wrist| (arm.slot(&theta) & 4) + wrist);
                // If joint 6 is free, another angle reaches.
                let is_flagged = |slot: &usize| {
                    status[*slot].contains(Status::ELBOW)
                        || (arm.is_universal() && status[*slot].contains(Status::WRIST))
                };
                let free = arm.is_universal() && wrist.is_none();
                let mine = if free { &slots[arm.slot(&theta) & 1..][..1] } else { &slots[..] };
                let close = solutions.iter().all(|s| arm.meets(&s.q, &pose, 1.01 * beyond));
                others += usize::from(solutions.iter().any(|s| !slots.contains(&s.slot.into())));
                count
                    .take(close && mine.iter().all(is_flagged), || format!("{theta:?} {beyond:e}"));
            }
            report += &count.row(&format!("{}, wrist {wrist:?}, {others} not alone", arm.name));
            assert!(others > 0, "{}: no other branch reaches", arm.name);
        }
    }
    assert_none(&report);
}

#[test]
fn a_lateral_offset_merges_only_what_rounding_merges() {
    asked_set();
    let mut report = String::new();
    for b in [1e-6, 1e-5, 1e-4, 1e-3, 0.05] {
        for arm in [lateral(b), lateral(b).mounted()] {
            let (rng, mut count) = (&mut Rng::new(15), Count::default());
            for _ in 0..100 * poses() {
                let shoulder = log_uniform(rng, -13.0, -2.0);
                let theta = arm.placed(Near { shoulder: Some(shoulder), ..Near::default() }, rng);
                let q = arm.q(theta);
                let pose = arm.robot.fk(&q);
                let slot = arm.slot(&theta);
                let solutions = arm.robot.ik(&pose).unwrap();
                // Rounding moves the wrist center across the plane by less than p / 2: the plane
                // may rotate by that, and at smaller distances merge with its twin.
                let open = 2.0 * plane_uncertainty(&arm, shoulder) + 1e-12;
                let near = |slot: usize| {
                    solutions.slot(slot).is_some_and(|s| wrapped(s.q[0] - q[0]) <= open)
                };
                let apart = shoulder > 1.2 * arm.shoulder_rounding();
                let holds = if apart { near(slot) } else { near(slot) || near(slot ^ 4) };
                let closes = solutions.iter().all(|s| arm.meets(&s.q, &pose, 0.0));
                count.take(holds && closes, || format!("{shoulder:e} {q:?}"));
            }
            report += &count.row(&arm.name);
        }
    }
    assert_none(&report);
}

/// Elbow and shoulder, and the wrist center on axes 1 and 2 at once: the seed that made the pose is
/// its nearest solution.
#[test]
fn a_seed_keeps_its_branch_behind_axis_1() {
    asked_set();
    let mut report = String::new();
    for arm in [irb_2600(), irb_2600().mounted(), equal_links()] {
        let (rng, mut count) = (&mut Rng::new(16), Count::default());
        while count.of < 100 * poses() {
            let shoulder = log_uniform(rng, -15.0, -11.0);
            let near = Near {
                shoulder: Some(shoulder),
                elbow: Some(log_uniform(rng, -15.0, -6.0)),
                wrist: None,
            };
            let theta = arm.placed(near, rng);
            let (q, [x, z]) = (arm.q(theta), arm.end(&theta));
            let seeded = arm.robot.ik_nearest(&arm.robot.fk(&q), &q, &[1.0; 6]).unwrap();
            // Rounding over the distance from axis 2 rotates joint 2, and at most 1e-12 m is traded
            // for a seed's free joint. Beyond that the pose determines joint 1.
            let plane = if shoulder > 9e-13 { arm.rounding() / shoulder } else { 0.0 };
            let off = 2e-6 + plane + (2e-12 + arm.rounding()) / x.hypot(z);
            let apart = common::apart(&seeded.q, &q);
            let folded = x.hypot(z) < 1e-9;
            let bound = if folded { 0.3 } else { off };
            count.take(apart <= bound, || format!("{apart:e} {q:?}"));
        }
        report += &count.row(&arm.name);
    }
    assert_none(&report);
}

fn largest_step(path: &[[f64; 6]]) -> f64 {
    path.windows(2)
        .flat_map(|pair| (0..6).map(move |i| (pair[1][i] - pair[0][i]).abs()))
        .fold(0.0, f64::max)
}

/// Whether a smooth joint path is followed: every pose reached, no break, no step of one and a half
/// times the path's own.
fn is_followed(robot: &Robot<6>, made: &[[f64; 6]]) -> Result<(), String> {
    let path: Vec<Pose> = made.iter().map(|q| robot.fk(q)).collect();
    let followed = robot.follow(&path, &made[0], &FollowOptions::default()).unwrap();
    if let Some(broken) = followed.breaks.first() {
        return Err(broken.to_string());
    }
    let q: Vec<[f64; 6]> = followed.q.iter().map(|q| q.unwrap()).collect();
    let ratio = largest_step(&q) / largest_step(made);
    if ratio <= 1.5 { Ok(()) } else { Err(format!("largest step {ratio:.2} x the path's")) }
}

/// Whether a path is near no singularities except those of its middle.
fn is_clear(arm: &Arm, path: &[[f64; 6]], near: Near) -> bool {
    path.iter().enumerate().all(|(i, q)| {
        let theta = arm.theta(q);
        let at_middle = i.abs_diff(path.len() / 2) <= 3;
        let clear = |asked: Option<f64>, off: f64, least: f64| match asked {
            Some(_) => at_middle || off.abs() > 0.1 * least,
            None => off.abs() > least,
        };
        clear(near.wrist, theta[4].sin(), 0.05)
            && clear(near.elbow, arm.elbow(&theta).sin(), 0.05)
            && clear(near.shoulder, arm.x(&theta), 0.05 * arm.c2)
    })
}

#[test]
fn smooth_paths_past_several_singularities_are_followed() {
    asked_set();
    let mut report = String::new();
    let sets = ["W", "S", "E", "WS", "WE", "ES", "WES"];
    for arm in
        [irb_2600(), equal_links(), lateral(1e-4), lateral(0.05)].into_iter().chain(universal())
    {
        for set in sets {
            for decades in [
                [-16.0, -15.9],
                [-15.0, -13.0],
                [-13.0, -11.0],
                [-11.0, -9.0],
                [-9.0, -7.0],
                [-7.0, -5.0],
            ] {
                let (rng, mut count) = (&mut Rng::new(17), Count::default());
                while count.of < poses() {
                    let mut off = |kind: char| {
                        let off = log_uniform(rng, decades[0], decades[1]);
                        set.contains(kind).then_some(off)
                    };
                    let near = Near { wrist: off('W'), shoulder: off('S'), elbow: off('E') };
                    let middle = arm.q(arm.placed(near, rng));
                    let rates: [f64; 6] =
                        std::array::from_fn(|_| sign(rng) * rng.between(0.003, 0.015));
                    let path: Vec<[f64; 6]> = (-30..=30)
                        .map(|i| std::array::from_fn(|j| middle[j] + rates[j] * f64::from(i)))
                        .collect();
                    if !is_clear(&arm, &path, near) {
                        continue;
                    }
                    let followed = is_followed(&arm.robot, &path);
                    count.take(followed.is_ok(), || {
                        format!("{} {middle:?} {rates:?}", followed.unwrap_err())
                    });
                }
                report += &count
                    .row(&format!("{}, {set}, 1e{} .. 1e{}", arm.name, decades[0], decades[1]));
            }
        }
    }
    assert_none(&report);
}
