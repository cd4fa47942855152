//! On a path the lanes and the scalar solver agree, too: where the lanes solve a pose, the path has
//! nothing to choose.

use std::format;

use super::*;
use crate::kinematics::thresholds::{PATH_SHOULDER, PATH_WRIST_SIN};

/// The slots of a pose of a path computed in lanes; `None` if the scalar solver decides.
fn on_path(robot: &Robot<6>, pose: &Pose) -> Option<RegularAnswer<6>> {
    let mut solutions = robot.unsolved(*pose);
    let regular = robot.inverse().unwrap().solve_on_path(&mut solutions, f64::NAN);
    regular.then(|| slots(&solutions))
}

impl Comparison {
    /// Take a pose on a path that is heading for `heading`.
    fn take_on_path(&mut self, arm: &Arm, pose: Pose, heading: [f64; 6], what: &str) {
        let pose = checked_pose(&pose).unwrap();
        let Some(regular) = on_path(&arm.robot, &pose) else { return };
        let mut scalar = arm.robot.unsolved(pose);
        arm.robot.solve_scalar(&mut scalar, &FreeChoice::path(heading)).unwrap();
        self.compare(arm, &pose, (regular, scalar), what);
    }
}

/// Distances of the poses of a set from a threshold of a path, as [`BEYOND`].
const BEYOND_ON_PATH: [f64; 6] = [1e-3, 0.5, 0.999, 1.001, 3.0, 10.0];

#[test]
#[expect(clippy::cast_precision_loss, reason = "counts")]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn a_path_has_nothing_to_choose_where_the_lanes_solve_it() {
    on_each_set(|_| {
        let mut random = Rng::new(11);
        for arm in &arms() {
            let places: [(Place, f64, f64); 2] = [
                (Arm::next_to_the_wrist_margin, PATH_WRIST_SIN / REGULAR_WRIST_SIN, 0.85),
                (Arm::next_to_the_shoulder_margin, PATH_SHOULDER / REGULAR_SHOULDER, 0.9),
            ];
            for (number, (place, margin, least)) in places.into_iter().enumerate() {
                for part in BEYOND_ON_PATH {
                    let what = format!("{}, {part} of margin {number}", arm.name);
                    let mut tally = Comparison::default();
                    for _ in 0..POSES {
                        let pose = place(arm, part * margin, &mut random);
                        let heading = heading(arm, &pose, &mut random);
                        tally.take_on_path(arm, pose, heading, &what);
                    }
                    let regular = tally.regular as f64 / POSES as f64;
                    let are_few = if part < 1.0 { regular == 0.0 } else { regular >= least };
                    assert!(are_few, "{what}: {regular} of the poses are regular");
                }
            }
        }
    });
}

/// Where a path may be heading: for a solution of the pose, exactly, to rounding or nearly, with a
/// joint 4 of its own, or elsewhere.
fn heading(arm: &Arm, pose: &Pose, random: &mut Rng) -> [f64; 6] {
    let solutions = scalar(&arm.robot, checked_pose(pose).unwrap(), f64::NAN);
    let mut heading = solutions.iter().next().map_or([0.3; 6], |solution| solution.q);
    let exponent = random.between(-18.0, 0.5);
    let off = if exponent < -16.0 { 0.0 } else { 10.0_f64.powf(exponent) };
    for angle in &mut heading {
        *angle += random.between(-off, off);
    }
    if random.sign() > 0.0 {
        heading[3] += random.between(-0.1, 0.1);
    }
    heading
}
