//! Random poses.

use super::*;

/// Worst figures of a run.
#[derive(Debug, Default)]
struct Worst {
    position: f64,
    rotation: f64,
    recall: f64,
    coarse: u32,
    merged: u32,
    solutions: usize,
}

fn run(arm: &Arm, count: u32, mut q_of: impl FnMut() -> [f64; 7]) -> Worst {
    let mut worst = Worst::default();
    for _ in 0..count {
        let q = q_of();
        let pose = arm.chain.fk(&q);
        let branches = arm.ik(&q);
        let slot = arm.slot_of(&q);
        let Some(found) = branches.q[slot] else {
            // A random joint vector may stand on a singularity: then the slot gave its solution to another.
            assert!(
                branches.exists(slot) && !arm.geometry().kinds(&q).is_empty(),
                "{}: {q:?} lost\n{branches:#?}",
                arm.name
            );
            worst.merged += 1;
            continue;
        };
        let off = apart(&found, &q);
        assert!(off < arm.recall(&q), "{}: {q:?} found {off:e} off\n{branches:#?}", arm.name);
        worst.coarse += u32::from(off > 1e-9);
        worst.recall = worst.recall.max(off);
        assert_eq!(branches.reach, crate::report::Reach::Reached);
        let residual = arm.residual(&branches, &pose);
        worst.position = worst.position.max(residual.position);
        worst.rotation = worst.rotation.max(residual.rotation);
        assert!(nearest_pair(&branches) > 1e-9, "{}: {q:?} twice\n{branches:#?}", arm.name);
        for (slot, q) in branches.q.iter().enumerate() {
            let Some(q) = q else { continue };
            worst.solutions += 1;
            assert_eq!(arm.slot_of(q), slot, "{}: {q:?}", arm.name);
            let differing = arm.geometry().kinds(q) ^ (branches.flags[slot] & Status::KINDS);
            assert!(edge_of_merging(arm, q).contains(differing), "{}: {q:?}", arm.name);
        }
    }
    std::println!("{} {count}: {worst:?}", arm.name);
    assert!(worst.position <= 4e-15 && worst.rotation <= 1e-14, "{worst:?}");
    worst
}

#[test]
fn every_joint_vector_inside_the_limits_is_found_in_its_slot() {
    let mut rng = Rng::new(3);
    for limits in [PANDA_LIMITS, FR3_LIMITS] {
        run(&panda(), poses(20_000), || rng.inside(&limits));
    }
}

#[test]
fn every_joint_vector_is_found_in_its_slot() {
    let mut rng = Rng::new(4);
    for arm in arms() {
        run(&arm, poses(20_000), || rng.anywhere());
    }
}

#[test]
fn base_and_tool_change_nothing() {
    let mut rng = Rng::new(5);
    for arm in arms() {
        let arm = arm.between(rng.pose(), rng.pose());
        run(&arm, poses(5000) / 4, || rng.anywhere());
    }
}

#[test]
fn joint_7_is_kept_to_the_last_bit() {
    let mut rng = Rng::new(6);
    for _ in 0..200 {
        let mut q = rng.anywhere();
        q[6] *= 3.0;
        assert!(panda().ik(&q).q.iter().flatten().all(|found| found[6] == q[6]));
    }
}

#[test]
fn slots_are_stable_along_a_path() {
    let mut rng = Rng::new(7);
    let arm = panda();
    for _ in 0..200 {
        let (from, to) = (rng.anywhere(), rng.anywhere());
        let mut before: Option<[Option<[f64; 7]>; SLOTS]> = None;
        for step in 0..=1000 {
            let along = f64::from(step) / 1000.0;
            let q = core::array::from_fn(|i| from[i] + along * (to[i] - from[i]));
            let (branches, distances) = (arm.ik(&q), arm.geometry().singular_distances(&q));
            if arm.geometry().aside(&q).abs() < 0.02
                || distances.elbow < 0.02
                || distances.shoulder < 0.02
            {
                before = None;
                continue;
            }
            let slot = arm.slot_of(&q);
            if let Some(q_before) = before.and_then(|before| before[slot]) {
                let step = apart(&branches.q[slot].unwrap(), &q_before);
                assert!(step < 0.02, "step of {step}");
            }
            before = Some(branches.q);
        }
    }
}
