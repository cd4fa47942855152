//! Arms with axes 2 and 3 coupled by a parallelogram linkage: in a batch, alone and by the scalar
//! solver.

use std::f64::consts::TAU;
use std::num::NonZeroUsize;

use irbkin::batch::Batch;
use irbkin::{JointLimits, Robot, pose};

use crate::common::coupled_arm::{limited, odd, with_linkage};
use crate::common::{Rng, apart, on_each_set};

const SLOTS: usize = 8;

#[test]
fn batch_equals_single_and_the_scalar_solver() {
    let mut rng = Rng::new(6);
    // Limits too far from zero for the lanes: the scalar solver, for the same postures.
    let scalar = |robot: &Robot<6>| {
        let mut far = robot.limits().to_array();
        far[0] = far[0].map(|limit| limit + TAU);
        robot.clone().with_limits(JointLimits::new(far).unwrap())
    };
    on_each_set(|set| {
        for robot in [limited(), with_linkage(), odd()] {
            let slow = scalar(&limited()).with_linkage_limits(robot.limits().linkage()).unwrap();
            let joints: Vec<_> = (0..101).map(|_| rng.inside(robot.limits())).collect();
            let poses: Vec<_> = joints.iter().map(|q| robot.fk(q)).collect();
            let rows: Vec<f64> = poses.iter().flat_map(pose::to_rows).collect();
            let (mut q, mut status) = (vec![[[0.0; 6]; SLOTS]; 101], vec![[0; SLOTS]; 101]);
            Batch::new(NonZeroUsize::new(1))
                .ik(
                    &robot,
                    &rows,
                    q.as_flattened_mut().as_flattened_mut(),
                    status.as_flattened_mut(),
                )
                .unwrap();
            for (row, pose) in poses.iter().enumerate() {
                let single = robot.ik(pose).unwrap();
                assert_eq!(
                    status[row],
                    std::array::from_fn(|slot| single.status()[slot].bits()),
                    "{}",
                    set.name()
                );
                for solution in &single {
                    assert!(apart(&q[row][solution.slot.index()], &solution.q) < 1e-12);
                }
                if robot.limits().to_array()[0][0].is_finite() {
                    let slowly = slow.ik(pose).unwrap();
                    assert_eq!(slowly.status(), single.status());
                    for (one, other) in slowly.iter().zip(&single) {
                        assert!(apart(&one.q, &other.q) < 1e-12);
                    }
                }
            }
        }
    });
}
