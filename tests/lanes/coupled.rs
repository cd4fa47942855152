//! Arms with axes 2 and 3 coupled by a parallelogram linkage: in a batch, alone and by the scalar
//! solver.

use std::f64::consts::TAU;
use std::num::NonZeroUsize;

use irbkin::batch::Batch;
use irbkin::{JointLimits, Robot, Status, pose};

use crate::common::coupled_arm::{limited, odd, opposed, others, with_linkage};
use crate::common::sets::on_each_set;
use crate::common::{Rng, apart};

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn batch_equals_single_and_the_scalar_solver() {
    let mut rng = Rng::new(6);
    // Limits too far from zero for the lanes: the scalar solver, for the same postures.
    let scalar = |robot: &Robot<6>| {
        let mut far = robot.limits().to_array();
        far[0] = far[0].map(|limit| limit + TAU);
        robot.clone().with_limits(JointLimits::new(far).unwrap())
    };
    on_each_set(|set| {
        let [crx, ur, crooked] = others();
        for robot in [limited(), with_linkage(), odd(), opposed(), crx, ur, crooked] {
            let (slow, slots) = (scalar(&robot), robot.slot_count());
            let joints: Vec<_> = (0..101).map(|_| rng.inside(robot.limits())).collect();
            let poses: Vec<_> = joints.iter().map(|q| robot.fk(q)).collect();
            let rows: Vec<f64> = poses.iter().flat_map(pose::to_rows).collect();
            let (mut q, mut status) = (vec![[0.0; 6]; slots * 101], vec![0; slots * 101]);
            Batch::new(NonZeroUsize::new(1))
                .ik(&robot, &rows, q.as_flattened_mut(), &mut status)
                .unwrap();
            for (row, pose) in poses.iter().enumerate() {
                let single = robot.ik(pose).unwrap();
                let bits: Vec<_> = single.status().iter().map(Status::bits).collect();
                assert_eq!(status[slots * row..slots * (row + 1)], bits, "{}", set.name());
                for solution in &single {
                    assert!(apart(&q[slots * row + solution.slot.index()], &solution.q) < 1e-12);
                }
                if robot.limits().to_array()[0][0].is_finite() {
                    let slowly = slow.ik(pose).unwrap();
                    assert_eq!(slowly.status(), single.status());
                    for (one, other) in slowly.iter().zip(&single) {
                        assert!(apart(&one.q, &other.q) < 1e-9);
                    }
                }
            }
        }
    });
}
