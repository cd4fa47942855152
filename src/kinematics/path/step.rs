//! Steps of joints: how far apart two joint vectors are.

/// The steps from one joint vector to another [rad].
pub(crate) fn steps(from: &[f64; 6], to: &[f64; 6]) -> [f64; 6] {
    core::array::from_fn(|joint| to[joint] - from[joint])
}

/// The largest size of steps [rad].
pub(crate) fn largest(steps: &[f64; 6]) -> f64 {
    steps.iter().fold(0.0, |most, step| most.max(step.abs()))
}

/// The joint (from 1) that moves most from one joint vector to another, and its step [rad].
pub(crate) fn largest_step(from: &[f64; 6], to: &[f64; 6]) -> (usize, f64) {
    let steps = steps(from, to);
    let joint = (0..6).fold(0, |most, i| if steps[i].abs() > steps[most].abs() { i } else { most });
    (joint + 1, steps[joint])
}
