//! At and next to every singularity, and every two of them.

use std::format;
use std::string::String;

use super::*;
use crate::kinematics::structure::free_choice::Trust;
use crate::kinematics::thresholds::REACH_TOLERANCE;

const OFF: [f64; 8] = [0.0, 1e-12, 1e-9, 2e-9, 1e-7, 1e-6, 1e-5, 1e-4];

/// Where an arm can be singular.
#[derive(Clone, Copy, Debug, PartialEq)]
enum At {
    Shoulder,
    Stretched,
    Folded,
    /// The shoulder in the plane of axes 5 and 6.
    Wrist,
    /// The shoulder on axis 5.
    Forearm,
    /// The shoulder on axis 6.
    Hand,
}

/// Angles in the derivation's counting at a distance `off` from a singularity; `None` where this arm does not get there.
fn moved(theta: &mut [f64; 7], links: &Links, at: At, off: f64, rng: &mut Rng) -> Option<()> {
    let psi = theta[3] - links.elbow_angle(theta[3]);
    let upper = links.a3.atan2(links.c3);
    let off = off * rng.sign();
    let half = if rng.sign() < 0.0 { PI } else { 0.0 };
    match at {
        At::Shoulder => theta[1] = half + off,
        At::Stretched => theta[3] = psi + off,
        At::Folded => theta[3] = psi + PI + off,
        At::Wrist => theta[4] = half - FRAC_PI_2 + off,
        At::Forearm => {
            let sine = (links.a4 + off) / links.upper;
            (sine.abs() <= 1.0).then_some(())?;
            theta[3] = upper + if half == 0.0 { sine.asin() } else { PI - sine.asin() };
        }
        At::Hand => {
            let around = rng.between(0.0, PI);
            let cosine = -(links.c5 + off * around.cos()) / links.upper;
            (cosine.abs() <= 1.0).then_some(())?;
            theta[3] = upper + rng.sign() * cosine.acos();
            let across = links.elbow_at(theta[3]).across;
            let cosine = off * around.sin() / across;
            theta[4] =
                rng.sign() * if cosine.abs() <= 1.0 { cosine.acos() } else { rng.between(-PI, PI) };
        }
    }
    Some(())
}

/// How far the joints of a solution may be from those that made the pose [rad]: joint 4; joints 5 and 6; joint 2 and the sum or difference of 1
/// and 3; joints 1 and 3 by themselves.
///
/// A distance that is known to `p` is the cosine of an angle: near the edge of what it can be, the angle is known to the root of `p`.
fn bounds(arm: &Arm, q: &[f64; 7], seeded: f64) -> [f64; 4] {
    let [_, theta_2, _, theta_4, theta_5, ..] = arm.geometry().theta(q);
    let links = arm.geometry().links;
    let elbow = links.elbow_at(theta_4);
    let p = 4.0 * links.position_rounding();
    let root = |p: f64, at: f64| (2.0 * p / at.abs().max(1e-300)).min(2.0 * p.sqrt());
    let (r, sin_e) = (elbow.across.hypot(elbow.along), links.elbow_angle(theta_4).sin());
    let joint_4 = p + root(p * r / links.product(), sin_e);
    let (across, aside) = (elbow.across.abs(), elbow.across * theta_5.cos());
    let rho = aside.hypot(elbow.along);
    let [speed_across, speed_along] = links.speeds(&elbow);
    let lever = if (across * theta_5.sin()).abs() < rho { across } else { rho };
    let moved = p + speed_across.abs().max(speed_along.abs()) * joint_4;
    let aside_error = p + root(moved * lever, aside).min(2.0 * (moved * lever).sqrt());
    // On axis 5 or 6 a seed is kept as far as `seeded`, and a merged twin may stand for the other one.
    let of = |distance: f64| {
        if distance <= 0.9 * seeded { 2.0 * seeded + p } else { (p + aside_error) / distance }
    };
    let joints_56 = of(across) + of(rho) + joint_4;
    let turned = links.forearm * joint_4 / r.max(p) + joints_56;
    let sine = theta_2.sin().abs();
    [
        joint_4,
        joints_56,
        turned + 3e-9,
        if turned + sine <= 0.9 * seeded { 3e-9 } else { (turned + p) / sine },
    ]
    .map(|bound| bound.max(1e-9))
}

/// Whether one of the solutions is the branch of `q`.
fn is_found(arm: &Arm, branches: &Branches<7>, q: &[f64; 7], bounds: &[f64; 4]) -> bool {
    let wrapped = |angle: f64| (angle - TAU * (angle / TAU).round()).abs();
    let b = arm.geometry().theta(q);
    branches.q.iter().flatten().any(|found| {
        let a = arm.geometry().theta(found);
        let off = |i: usize| wrapped(a[i] - b[i]);
        let sum = |t: [f64; 7]| if t[1].cos() > 0.0 { t[0] + t[2] } else { t[0] - t[2] };
        let merged_2 = wrapped(wrapped(a[1]) - wrapped(b[1]));
        let split = off(0).max(off(2)) <= bounds[3];
        off(3) <= bounds[0]
            && off(4).max(off(5)) <= bounds[1]
            && (off(1).min(merged_2) <= bounds[2])
            && (split || bounds[3] > 0.1)
            && (wrapped(sum(a) - sum(b)) <= bounds[2] + bounds[3] * b[1].sin().abs() || split)
    })
}

#[derive(Debug, Default)]
struct Found {
    count: u32,
    /// Slots that the arm next to it has and the singular one has not, or the other way round.
    differing: u32,
    lost: u32,
    twice: u32,
    flags: u32,
    wrong: u32,
    position: f64,
    rotation: f64,
    example: Option<String>,
}

impl Found {
    fn join(&mut self, other: &Self) {
        self.count += other.count;
        self.differing += other.differing;
        self.lost += other.lost;
        self.twice += other.twice;
        self.flags += other.flags;
        self.wrong += other.wrong;
        self.position = self.position.max(other.position);
        self.rotation = self.rotation.max(other.rotation);
        self.example = self.example.take().or_else(|| other.example.clone());
    }

    fn amiss(&self) -> u32 {
        self.differing + self.lost + self.twice + self.flags + self.wrong
    }

    fn look(&mut self, arm: &Arm, q: &[f64; 7], rng: &mut Rng) {
        let pose = arm.chain.fk(q);
        let branches = arm.ik(q);
        let before = self.amiss();
        self.count += 1;
        let residual = arm.residual(&reached(arm, q, &branches), &pose);
        self.position = self.position.max(residual.position);
        self.rotation = self.rotation.max(residual.rotation);
        self.wrong += u32::from(residual.position > 6e-15 || residual.rotation > 1e-14);
        let beyond = arm.residual(&branches, &pose).largest();
        self.wrong += u32::from(beyond > 1.01 * REACH_TOLERANCE);
        self.twice += u32::from(nearest_pair(&branches) < 1e-9);
        let beside =
            core::array::from_fn(|i| if i == 6 { q[6] } else { q[i] + rng.between(-1e-4, 1e-4) });
        self.differing += u32::from(differ(arm, q, &branches, &arm.ik(&beside)));
        for (trust, radius) in [(Trust::Seed, 1e-12), (Trust::Path, 1e-12)] {
            let kept = arm.solve(&pose, &FreeChoice { q: *q, trust });
            let bounds = bounds(arm, q, radius);
            self.lost += u32::from(!is_found(arm, &kept, q, &bounds));
            // A path goes on by itself as far as rounding leaves the upper arm open.
            let allowed = 4e-12 + if trust == Trust::Path { bounds[2] } else { 0.0 };
            let residual = arm.residual(&reached(arm, q, &kept), &pose);
            self.wrong += u32::from(residual.largest() > allowed);
        }
        for (slot, found) in
            branches.q.iter().enumerate().filter_map(|(slot, q)| Some((slot, q.as_ref()?)))
        {
            let kinds = arm.geometry().kinds(found);
            // A bit that is open may be the other one.
            let open = [(Status::SHOULDER, 4), (Status::ELBOW, 2), (Status::WRIST, 1)];
            let closed: usize = open
                .iter()
                .filter(|(kind, _)| !branches.flags[slot].contains(*kind))
                .map(|(_, bit)| bit)
                .sum();
            let told = branches.flags[slot] | edge_of_merging(arm, found);
            self.flags +=
                u32::from(!told.contains(kinds) || (arm.slot_of(found) ^ slot) & closed != 0);
            self.wrong += u32::from(
                branches.free[slot]
                    .is_some_and(|free| !family_closes(arm, &pose, found, slot, free.joint())),
            );
        }
        if self.amiss() > before && self.example.is_none() {
            let kept = [Trust::Seed, Trust::Path]
                .map(|trust| arm.solve(&pose, &FreeChoice { q: *q, trust }));
            let residuals = [&kept[0], &kept[1]].map(|kept| arm.residual(kept, &pose));
            self.example = Some(format!(
                "{q:?} slot {}\n{branches:?}\n{:?}\n{kept:?}\n{residuals:?}",
                arm.slot_of(q),
                bounds(arm, q, 1e-12)
            ));
        }
    }
}

/// The branches without those of the other elbow whose wrist is at its edge: that one may be up to
/// a nanometer beyond reach.
fn reached(arm: &Arm, q: &[f64; 7], branches: &Branches<7>) -> Branches<7> {
    let (own, mut reached) = (arm.slot_of(q) & 2, *branches);
    for (slot, flags) in branches.flags.iter().enumerate() {
        if slot & 2 != own && flags.contains(Status::WRIST) && !flags.contains(Status::ELBOW) {
            reached.q[slot] = None;
        }
    }
    reached
}

/// Whether a solution whose free joint is given another angle is one of the pose, to twice the distance from the singularity.
fn family_closes(arm: &Arm, pose: &Pose, found: &[f64; 7], slot: usize, joint: usize) -> bool {
    let mut q = *found;
    q[joint - 1] = 0.7;
    let family = arm.solve(pose, &FreeChoice::forced(q, joint, false));
    // The shoulder, or the wrist and with it the shoulder, may be kept in its other branch there.
    let bits = if joint == 1 { &[0, 4][..] } else { &[0, 1, 4, 5] };
    let moved = bits.iter().find_map(|bits| family.q[slot ^ bits]);
    moved.is_some_and(|q| {
        (q[joint - 1] - 0.7).abs() < 1e-15
            && PoseError::between(&arm.chain.fk(&q), pose).largest() < 4e-9
    })
}

/// Whether two answers have different slots, but for those where the wrist of an elbow that is not that of `q` is at its edge.
fn differ(arm: &Arm, q: &[f64; 7], here: &Branches<7>, beside: &Branches<7>) -> bool {
    let distances = arm.geometry().singular_distances(q);
    let own = arm.slot_of(q) & 2;
    (0..SLOTS).any(|slot| {
        let edge = [here, beside].iter().any(|branches| {
            branches.q.iter().enumerate().any(|(other, q)| {
                let same_elbow = (other ^ slot) & 2 == 0;
                same_elbow && q.is_some_and(|q| arm.geometry().aside(&q).abs() < 0.02)
            })
        });
        let excused = edge && slot & 2 != own
            || distances.elbow < 0.01 && arm.geometry().aside(q).abs() < 0.02;
        here.exists(slot) != beside.exists(slot) && !excused
    })
}

fn set(arm: &Arm, places: &[(At, f64)], count: u32, rng: &mut Rng) -> Found {
    let mut found = Found::default();
    let links = arm.geometry().links;
    for _ in 0..count {
        let mut theta = arm.geometry().theta(&rng.anywhere());
        for (at, off) in places {
            if moved(&mut theta, &links, *at, *off, rng).is_none() {
                return found;
            }
        }
        let q = arm.geometry().placement.joints(theta);
        found.look(arm, &q, rng);
    }
    if let Some(example) = &found.example {
        std::println!("{} {places:?}: {example}", arm.name);
    }
    found
}

#[test]
fn every_branch_is_found_at_and_next_to_singularities() {
    let mut rng = Rng::new(30);
    let count = poses(20_000) / 200;
    let mut amiss = 0;
    for arm in arms() {
        for one in [At::Shoulder, At::Stretched, At::Folded, At::Wrist, At::Forearm, At::Hand] {
            let mut single = Found::default();
            for off in OFF {
                single.join(&set(&arm, &[(one, off)], count, &mut rng));
            }
            tell(&arm, &format!("{one:?}"), &single, &mut amiss);
            for two in [At::Shoulder, At::Wrist].into_iter().filter(|two| *two != one) {
                let mut pair = Found::default();
                for (off, other) in OFF.iter().flat_map(|off| OFF.map(|other| (*off, other))) {
                    pair.join(&set(&arm, &[(one, off), (two, other)], count / 4, &mut rng));
                }
                tell(&arm, &format!("{one:?} {two:?}"), &pair, &mut amiss);
            }
            if matches!(one, At::Shoulder | At::Wrist) {
                continue;
            }
            let mut three = Found::default();
            for (off, other) in OFF.iter().flat_map(|off| OFF.map(|other| (*off, other))) {
                three.join(&set(
                    &arm,
                    &[(one, off), (At::Wrist, other), (At::Shoulder, off)],
                    count / 4,
                    &mut rng,
                ));
            }
            tell(&arm, &format!("{one:?} Wrist Shoulder"), &three, &mut amiss);
        }
    }
    assert_eq!(amiss, 0);
}

fn tell(arm: &Arm, set: &str, found: &Found, amiss: &mut u32) {
    let Found { count, differing, lost, twice, flags, wrong, position, rotation, .. } = found;
    std::println!(
        "{:12} {set:24} {count:7} poses, differing {differing} lost {lost} twice {twice} flags {flags} wrong {wrong}  {position:.1e} m {rotation:.1e} rad",
        arm.name
    );
    *amiss += found.amiss();
}
