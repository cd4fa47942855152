//! Regular poses, alone and in the company of others.

use std::vec::Vec;

use super::{OffsetWrist, SETS, arms, asked, joints};
use crate::kinematics::structure::closure::Accepted;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::offset_wrist::regular::{Eight, One};
use crate::lanes::{LANES, on_each_set};

/// Joint vectors of all sets, those of one set far from one another.
fn mixed(arm: &OffsetWrist, count: usize) -> Vec<[f64; 6]> {
    let of_all = |q| SETS.iter().filter_map(move |(_, change)| change(arm, q));
    joints(7).take(count).flat_map(of_all).collect()
}

fn frames(arm: &OffsetWrist, all: &[[f64; 6]]) -> Vec<Frame> {
    all.iter().map(|q| Frame::of(&arm.chain.fk(q))).collect()
}

#[test]
fn a_pose_has_the_bits_in_company_that_it_has_alone() {
    on_each_set(|_| {
        for (name, arm) in arms() {
            let frames = frames(&arm, &mixed(&arm, 20));
            let (mut alone, mut company) = (One::NEW, Eight::NEW);
            let mut count = 0;
            for block in frames.chunks(LANES) {
                let all = company.solve(&arm.constants, block);
                for (frame, there) in block.iter().zip(all) {
                    let [here] = alone.solve(&arm.constants, &[*frame]) else { unreachable!() };
                    assert_eq!(here.is_regular, there.is_regular, "{name}");
                    if here.is_regular {
                        assert_eq!(here.as_slice(), there.as_slice(), "{name}");
                        count += 1;
                    }
                }
            }
            assert!(8 * count > frames.len(), "{name}: {count} of {}", frames.len());
        }
    });
}

#[test]
fn a_regular_pose_has_the_solutions_of_the_whole_search() {
    for (name, arm) in arms() {
        let all = mixed(&arm, asked());
        let (mut regular, mut count) = (One::NEW, 0);
        for (q, frame) in all.iter().zip(frames(&arm, &all)) {
            let [solved] = regular.solve(&arm.constants, &[frame]) else { unreachable!() };
            if !solved.is_regular {
                continue;
            }
            let mut found = Accepted::NONE;
            let free = FreeChoice::rest([0.0; 6]);
            let is_certified = arm.solutions(&arm.chain.fk(q), &free, &mut found);
            let found = found.as_slice();
            assert!(is_certified && found.len() == solved.as_slice().len(), "{name}: {q:?}");
            for theta in solved.as_slice() {
                assert!(found.iter().any(|one| one.distance(theta) < 1e-9), "{name}: {q:?}");
            }
            count += 1;
        }
        assert!(8 * count > all.len(), "{name}: {count} of {}", all.len());
    }
}

#[test]
fn nearly_all_random_poses_are_regular() {
    for (name, arm) in arms() {
        let all: Vec<_> = joints(8).take(50 * asked()).collect();
        let (mut alone, mut count) = (One::NEW, 0);
        for frame in frames(&arm, &all) {
            count += usize::from(alone.solve(&arm.constants, &[frame])[0].is_regular);
        }
        std::println!("{name}: {count} of {} are regular", all.len());
        assert!(100 * count > 97 * all.len(), "{name}: {count} of {}", all.len());
    }
}
