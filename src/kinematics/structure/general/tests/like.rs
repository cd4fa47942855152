//! An arm that takes the splits of another one, which differs by a link.

use std::vec::Vec;

use super::super::split::Split;
use super::{General, RootKind, degrees, poses_or};
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::structure::Structure as _;
use crate::kinematics::structure::closure::{Accepted, Configuration};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::rng::Rng;

/// An iiwa with joint 2 locked at an angle [deg].
fn iiwa_without_joint_2(angle: f64) -> Mdh<6> {
    degrees([
        [0.0, 0.0, 0.36, 90.0],
        [angle, 0.0, 0.42, -90.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.0, 0.4, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.126, 0.0],
    ])
}

/// A wrist whose axes meet in one point has pairs of roots: hardly a pose is regular, but as many
/// splits certify one as at the other angle. To choose splits anew takes a hundred times as long.
#[test]
fn splits_of_an_arm_with_a_spherical_wrist_serve_it_at_another_angle() {
    let mut rng = Rng::new(12);
    let first = General::of(&iiwa_without_joint_2(46.0)).unwrap();
    assert!(matches!(first.roots, RootKind::Pairs(_)));
    let searched = |arm: &General| arm.splits.iter().map(Split::searched).collect::<Vec<_>>();
    let (mut certified, mut asked) = (0, 0);
    for angle in [-110.0, -60.0, -20.0, 15.0, 30.0, 90.0, 119.0] {
        let arm = first.like(&iiwa_without_joint_2(angle)).unwrap();
        assert_eq!((arm.roots, searched(&arm)), (first.roots, searched(&first)), "{angle}");
        for _ in 0..poses_or(50) {
            let theta = rng.angles();
            let (last, mut found) = (arm.closure.last_frame(&theta), Accepted::new());
            let is_all = arm.solutions(&last, &FreeChoice::rest([0.0; 6]), &mut found);
            let is_it = |one: &Configuration| one.distance(&theta) < 1e-6;
            assert!(found.as_slice().iter().any(is_it) || !is_all, "{angle}: {theta:?}");
            (certified, asked) = (certified + usize::from(is_all), asked + 1);
        }
    }
    assert!(10 * certified > 9 * asked, "{certified} of {asked}");
}
