//! Laws of the general solver by itself; `tests/structures` has those of its robots.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::vec::Vec;

use super::*;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::pose::angles::wrap;
use crate::rng::Rng;

fn table(rows: [[f64; 4]; 6]) -> Mdh<6> {
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    Mdh { base: Pose::identity(), rows, flange: Pose::identity() }
}

/// Alpha [deg], a, d [m], theta [deg].
fn degrees(rows: [[f64; 4]; 6]) -> Mdh<6> {
    table(rows.map(|[alpha, a, d, theta]| [alpha.to_radians(), a, d, theta.to_radians()]))
}

fn gofa_5() -> Mdh<6> {
    degrees([
        [0.0, 0.0, 0.265, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 0.444, 0.0, 0.0],
        [-90.0, 0.110, 0.470, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.080, 0.101, 180.0],
    ])
}

fn crx_10ial() -> Mdh<6> {
    degrees([
        [0.0, 0.0, 0.245, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 0.710, 0.0, 0.0],
        [-90.0, 0.0, 0.540, 0.0],
        [90.0, 0.0, 0.150, 0.0],
        [-90.0, 0.0, 0.160, 0.0],
    ])
}

fn manseur_doty() -> Mdh<6> {
    // Standard: a = (.3, 1, 0, 1.5, 0, 0), d = (0, 0, .2, 0, 0, 0), alpha = (90, 1, 90, 1, 90, 1).
    degrees([
        [0.0, 0.0, 0.0, 0.0],
        [90.0, 0.3, 0.0, 0.0],
        [1.0, 1.0, 0.2, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [1.0, 1.5, 0.0, 0.0],
        [90.0, 0.0, 0.0, 0.0],
    ])
}

fn random(rng: &mut Rng) -> Mdh<6> {
    table(core::array::from_fn(|_| {
        [rng.between(0.3, 2.8), rng.between(-0.5, 0.5), rng.between(-0.5, 0.5), rng.angle()]
    }))
}

/// How a general arm answers to joint vectors.
#[derive(Debug, Default)]
struct Report {
    poses: usize,
    missed: usize,
    missed_unflagged: usize,
    uncertain: usize,
    wrong: usize,
    duplicates: usize,
    odd: usize,
    solutions: usize,
    most: usize,
    examples: Vec<[f64; 6]>,
}

fn report(mdh: &Mdh<6>, draws: impl Iterator<Item = [f64; 6]>, close: f64) -> Report {
    let arm = General::of(mdh).unwrap();
    let chain = Chain::new(mdh.clone());
    let map = arm.joint_map();
    let mut report = Report::default();
    for q in draws {
        let pose = chain.fk(&q);
        let t = map.t_base_shoulder.inverse() * pose * map.t_wrist_flange.inverse();
        let (accepted, is_certain) = arm.solve_all(&t);
        let found: Vec<_> =
            accepted.as_slice().iter().map(|one| arm.joint_map.joints(one.theta)).collect();
        report.poses += 1;
        let apart = |a: &[f64; 6], b: &[f64; 6]| {
            (0..6).map(|i| wrap(a[i] - b[i]).abs()).fold(0.0, f64::max)
        };
        let is_found = found.iter().any(|one| apart(one, &q) < close);
        report.missed += usize::from(!is_found);
        report.missed_unflagged += usize::from(!is_found && is_certain);
        report.uncertain += usize::from(!is_certain);
        report.odd += usize::from(accepted.root_count() % 2 == 1);
        report.solutions += found.len();
        report.most = report.most.max(found.len());
        if !is_found && is_certain || report.examples.len() < 2 && !is_certain {
            report.examples.push(q);
        }
        for (i, one) in found.iter().enumerate() {
            let reached = chain.fk(one);
            let off = (reached.translation.vector - pose.translation.vector).amax()
                + (reached.rotation.matrix() - pose.rotation.matrix()).amax();
            report.wrong += usize::from(off > 1e-12);
            report.duplicates += found[..i].iter().filter(|other| apart(one, other) < 1e-9).count();
        }
    }
    report
}

#[test]
fn every_solution_of_random_poses_is_found() {
    let mut rng = Rng::new(1);
    let mut arms = std::vec![
        ("GoFa 5", gofa_5()),
        ("CRX-10iA/L", crx_10ial()),
        ("Manseur-Doty", manseur_doty())
    ];
    for _ in 0..4 {
        arms.push(("random", random(&mut rng)));
    }
    for (name, mdh) in arms {
        let draws: Vec<[f64; 6]> = (0..5000).map(|_| rng.angles()).collect();
        let start = std::time::Instant::now();
        let report = report(&mdh, draws.into_iter(), 1e-7);
        let numbers: Vec<_> =
            General::of(&mdh).unwrap().splits.iter().map(|s| (s.joints, s.sign)).collect();
        std::println!("{name}: {report:?} {:?} {numbers:?}", start.elapsed());
    }
}

#[test]
fn structured() {
    let mut rng = Rng::new(2);
    for (name, mdh) in
        [("GoFa 5", gofa_5()), ("CRX-10iA/L", crx_10ial()), ("Manseur-Doty", manseur_doty())]
    {
        type Change = fn(&mut Rng, [f64; 6]) -> [f64; 6];
        let sets: [(&str, Change); 9] = [
            ("q4=0", |_, q| [q[0], q[1], q[2], 0.0, q[4], q[5]]),
            ("q4=1e-9", |_, q| [q[0], q[1], q[2], 1e-9, q[4], q[5]]),
            ("q4=1e-6", |_, q| [q[0], q[1], q[2], 1e-6, q[4], q[5]]),
            ("q4=1e-4", |_, q| [q[0], q[1], q[2], 1e-4, q[4], q[5]]),
            ("q5=0", |_, q| [q[0], q[1], q[2], q[3], 0.0, q[5]]),
            ("q5=1e-6", |_, q| [q[0], q[1], q[2], q[3], 1e-6, q[5]]),
            ("q4=q5=0", |_, q| [q[0], q[1], q[2], 0.0, 0.0, q[5]]),
            ("90", |_, q| q.map(|q| FRAC_PI_2 * (q / FRAC_PI_2).round())),
            ("45", |_, q| q.map(|q| FRAC_PI_4 * (q / FRAC_PI_4).round())),
        ];
        for (set, change) in sets {
            let draws: Vec<[f64; 6]> = (0..300)
                .map(|_| {
                    let q = rng.angles();
                    change(&mut rng, q)
                })
                .collect();
            let start = std::time::Instant::now();
            let report = report(&mdh, draws.into_iter(), 1e-3);
            std::println!("{name} {set}: {report:?} {:?}", start.elapsed());
        }
    }
    let _ = PI;
}
