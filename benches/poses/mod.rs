//! The arm that is measured, and what it is asked.
#![allow(dead_code, reason = "each bench uses its part")]

use irbkin::batch::Batch;
use irbkin::{InstructionSet, Robot};

/// A joint vector whose pose has all eight solutions.
pub(crate) const Q: [f64; 6] = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];

/// The same with axes 4 and 6 in one line: a pose for the scalar solve.
pub(crate) const Q_SINGULAR: [f64; 6] = [0.3, -0.2, 0.4, 0.5, 0.0, 0.7];

pub(crate) fn robot() -> Robot<6> {
    Robot::named("IRB 2600-12/1.65").unwrap()
}

/// A joint vector of the UR3 whose pose has all eight solutions.
pub(crate) const Q_UR3: [f64; 6] = [0.4, -1.9, 1.5, -0.6, 1.1, 0.3];

/// A joint vector of the Panda whose pose has all eight solutions with joint 7 there.
pub(crate) const Q_PANDA: [f64; 7] = [0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6];

/// Joint vectors spread evenly inside the limits: multiples of irrational numbers.
pub(crate) fn joints<const N: usize>(robot: &Robot<N>, count: u32) -> Vec<f64> {
    let steps = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0].map(f64::sqrt);
    let limits = robot.limits().to_array();
    let vector = |i| {
        (0..N).map(move |joint| {
            limits[joint][0]
                + (limits[joint][1] - limits[joint][0]) * (f64::from(i) * steps[joint]).fract()
        })
    };
    (1..=count).flat_map(vector).collect()
}

/// Their poses, 16 elements each.
pub(crate) fn poses<const N: usize>(robot: &Robot<N>, q: &[f64]) -> Vec<f64> {
    let mut poses = vec![0.0; q.len() / N * 16];
    Batch::new(None).fk(robot, q, &mut poses).unwrap();
    poses
}

/// Does it once for every instruction set of this processor, with that set in use.
pub(crate) fn with_each_set(mut measure: impl FnMut(&'static str)) {
    for set in InstructionSet::available() {
        set.force().unwrap();
        measure(set.name());
    }
}
