//! Steps of joints: how far apart two joint vectors are.

/// The steps from one joint vector to another [rad].
pub fn steps<const N: usize>(from: &[f64; N], to: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|joint| to[joint] - from[joint])
}

/// The largest size of steps [rad].
pub fn largest<const N: usize>(steps: &[f64; N]) -> f64 {
    steps.iter().fold(0.0, |most, step| most.max(step.abs()))
}

/// The joint (from 1) that moves most from one joint vector to another, and its step [rad].
#[doc(hidden)]
pub fn largest_step<const N: usize>(from: &[f64; N], to: &[f64; N]) -> (usize, f64) {
    let steps = steps(from, to);
    let joint = (0..N).fold(0, |most, i| if steps[i].abs() > steps[most].abs() { i } else { most });
    (joint + 1, steps[joint])
}
