//! Postures all over the limits of a robot.

use core::array;
use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::Robot;

/// Postures in which what always holds is looked for.
pub(crate) const POSTURES: u32 = 64;

impl<const N: usize> Robot<N> {
    /// A posture of a Weyl sequence that fills the limits, or a turn where a joint has none.
    pub(crate) fn posture(&self, number: u32) -> [f64; N] {
        const PRIMES: [f64; 7] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0];
        let limits = self.limits().to_array();
        array::from_fn(|joint| {
            let [lower, upper] = limits[joint].map(|limit| limit.clamp(-PI, PI));
            let part = (0.5 + f64::from(number) * PRIMES[joint % PRIMES.len()].sqrt()).fract();
            lower + (upper - lower) * part
        })
    }
}
