//! Branches that turn, begin, end or merge between two angles at which a cluster is examined (eq.
//! 133).

use super::*;

/// Joint vectors with the wrist point this far from axis 1, or from axis 2, by a joint [rad].
const AHEAD: [f64; 6] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];

/// Joint 4 at which axis 5 is parallel to axis 2, and nearly so [rad].
const PARALLEL: [f64; 4] = [0.0, 1e-6, 1e-4, 3e-3];

/// The wrist point's distance from axis 1 along the plane of the arm [m].
pub(super) fn sigma(arm: &OffsetWrist, q: &[f64; 6]) -> f64 {
    let (frames, _) = arm.chain.link_frames(q);
    frames[0].rotation.matrix().column(0).dot(&frames[3].translation.vector)
}

/// Twice the area between upper arm and forearm: zero where the elbow is stretched or folded [m^2].
pub(super) fn area(arm: &OffsetWrist, q: &[f64; 6]) -> f64 {
    let (frames, _) = arm.chain.link_frames(q);
    let [shoulder, elbow, wrist] = [1, 2, 3].map(|joint| frames[joint].translation.vector);
    let normal = frames[1].rotation.matrix().column(2).into_owned();
    (elbow - shoulder).cross(&(wrist - elbow)).dot(&normal)
}

/// Whether the answer for a joint vector is certified. It must then hold the joint vector.
fn is_certified(name: &str, arm: &OffsetWrist, q: [f64; 6]) -> bool {
    let q = arm.joint_map().theta(&arm.joint_map().joints(q));
    let mut found = Accepted::new();
    let is_certified =
        arm.solutions(&Frame::of(&arm.chain.fk(&q)), &FreeChoice::rest([0.0; 6]), &mut found);
    let is_same =
        |one: &Configuration| one.distance(&q) < if one.least > 1e-4 { 1e-6 } else { 3e-3 };
    assert!(!is_certified || found.as_slice().iter().any(is_same), "{name} {q:?}");
    is_certified
}

/// An arm with a lateral offset [m] and a long hand.
fn lateral(b: f64) -> OffsetWrist {
    arm([
        [0.0, 0.0, 0.49, 0.0],
        [-90.0, 0.0, b, 0.0],
        [180.0, 0.224, 0.0, 0.0],
        [90.0, -0.57, -0.449, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-87.0, -0.708, -0.131, 0.0],
    ])
}

#[test]
fn a_wrist_point_that_passes_an_axis_between_two_angles_is_not_certain() {
    let (_, folding) = arms().into_iter().find(|(name, _)| *name == "CRX-10iA").unwrap();
    let [mut folded, mut beside] = [[0; 2]; 2];
    let count = |[asked, certified]: &mut [usize; 2], is_certified| {
        (*asked, *certified) = (*asked + 1, *certified + usize::from(is_certified));
    };
    for (number, q) in joints(6).take(1000).enumerate() {
        let (ahead, parallel) = (AHEAD[number % 6], PARALLEL[number / 6 % 4]);
        for q in [q, with(q, [(3, parallel)]).unwrap()] {
            if let Some(q) = at_zero(|q| area(&folding, q), q, 2, ahead) {
                count(&mut folded, is_certified("folding", &folding, q));
            }
            for b in [1.5e-9, 1.5e-6] {
                let lateral = lateral(b);
                if let Some(q) = at_zero(|q| sigma(&lateral, q), q, 1, ahead) {
                    count(&mut beside, is_certified("lateral", &lateral, q));
                }
            }
        }
    }
    // Of the folding arm, a third is next to a self-motion.
    std::println!("asked and certified: {folded:?}, {beside:?}");
    assert!(folded[1] > 0 && folded[0] > 1000, "{folded:?}");
    assert!(beside[1] > 0 && beside[0] > 2000, "{beside:?}");
}

#[test]
fn a_branch_that_begins_and_ends_between_two_angles_is_not_certain() {
    // Its wrist point is within reach for a hundredth of a turn at most.
    let small = arm([
        [0.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [180.0, 0.18, 0.0, 0.0],
        [90.0, 0.0, -0.0022, 0.0],
        [90.0, 0.0, -39.0, 0.0],
        [-123.0, 20.0, 0.56, 0.0],
    ]);
    let is_certified = |&(number, q): &(usize, [f64; 6])| {
        let q = with(q, [(3, PARALLEL[number % 4])]).unwrap();
        is_certified("small", &small, q)
    };
    let certified = joints(7).take(200).enumerate().filter(is_certified).count();
    assert!(certified > 0, "{certified}");
}

#[test]
fn a_fold_that_rounding_of_the_pose_opens_is_found() {
    // Poses whose resultant at the fold is up to four times what its surplus harmonics show.
    for name in ["GoFa 5", "GoFa 10", "xArm6"] {
        let (_, arm) = arms().into_iter().find(|(other, _)| *other == name).unwrap();
        let [mut asked, mut missed] = [0; 2];
        for q in joints(3).take(4000).filter_map(|q| singular(&arm, q, 0.0)) {
            let q = arm.joint_map().theta(&arm.joint_map().joints(q));
            let mut found = Accepted::new();
            let is_certified = arm.solutions(
                &Frame::of(&arm.chain.fk(&q)),
                &FreeChoice::rest([0.0; 6]),
                &mut found,
            );
            let is_found = found.as_slice().iter().any(|one| one.distance(&q) < 3e-3);
            assert!(!is_certified, "{name} {q:?}");
            (asked, missed) = (asked + 1, missed + usize::from(!is_found));
        }
        assert!(missed * 1000 <= asked && asked > 3000, "{name}: {missed} of {asked}");
    }
}
