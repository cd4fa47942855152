//! Regular poses, alone and in the company of others.

use std::vec::Vec;

use super::{OffsetWrist, SETS, arms, asked, joints};
use crate::kinematics::structure::by_roots::regular_of;
use crate::kinematics::structure::by_roots::tests::{is_as_in_whole_search, same_in_company};
use crate::kinematics::structure::closure::Accepted;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::sets::on_each_set;

/// Joint vectors of all sets, of each set far from one another.
fn mixed(arm: &OffsetWrist, count: usize) -> Vec<[f64; 6]> {
    let of_all = |q| SETS.iter().filter_map(move |(_, change)| change(arm, q));
    joints(7).take(count).flat_map(of_all).collect()
}

fn frames(arm: &OffsetWrist, all: &[[f64; 6]]) -> Vec<Frame> {
    all.iter().map(|q| Frame::of(&arm.chain.fk(q))).collect()
}

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn a_pose_has_the_bits_in_company_that_it_has_alone() {
    on_each_set(|_| {
        for (name, arm) in arms() {
            let frames = frames(&arm, &mixed(&arm, 20));
            let count = same_in_company(&arm.constants, &frames, name);
            assert!(8 * count > frames.len(), "{name}: {count} of {}", frames.len());
        }
    });
}

#[test]
fn a_regular_pose_has_the_solutions_of_the_whole_search() {
    for (name, arm) in arms() {
        let all = mixed(&arm, asked());
        let (mut count, mut uncertified) = (0, 0);
        for (q, frame) in all.iter().zip(frames(&arm, &all)) {
            let whole_search = || {
                let mut found = Accepted::new();
                let free = FreeChoice::rest([0.0; 6]);
                let is_certified = arm.solutions(&Frame::of(&arm.chain.fk(q)), &free, &mut found);
                (found.as_slice().to_vec(), is_certified)
            };
            let is_certified = is_as_in_whole_search(&arm.constants, &frame, whole_search, name);
            count += usize::from(is_certified.is_some());
            uncertified += usize::from(is_certified == Some(false));
        }
        assert!(8 * count > all.len(), "{name}: {count} of {}", all.len());
        assert_eq!(uncertified, 0, "{name}: of {count}");
    }
}

#[test]
fn nearly_all_random_poses_are_regular() {
    for (name, arm) in arms() {
        let all: Vec<_> = joints(8).take(50 * asked()).collect();
        let count = regular_of(&arm.constants, &frames(&arm, &all));
        std::println!("{name}: {count} of {} are regular", all.len());
        assert!(100 * count > 97 * all.len(), "{name}: {count} of {}", all.len());
    }
}
