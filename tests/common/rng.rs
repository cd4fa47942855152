//! The only source of random numbers of the tests, including the unit tests in `src`.

use std::f64::consts::{PI, TAU};

use irbkin::JointLimits;

/// A small generator with a fixed seed: a run draws the same numbers everywhere (splitmix64).
///
/// Any seed will do, and every bit is random. `IRBKIN_SEED` (0) draws others; `make soak` counts it.
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        let run = std::env::var("IRBKIN_SEED").ok().and_then(|seed| seed.parse().ok());
        Self(seed ^ run.unwrap_or(0_u64).wrapping_mul(0xd134_2543_de82_ef95))
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Uniform in 0 .. 1.
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 2.0_f64.powi(53)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// 0 or pi.
    pub fn half_turn(&mut self) -> f64 {
        if self.unit() < 0.5 { 0.0 } else { PI }
    }

    /// In -pi .. pi.
    pub fn angle(&mut self) -> f64 {
        self.between(-PI, PI)
    }

    pub fn angles<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.angle())
    }

    /// Uniform inside the limits; within two turns either way for a joint without limits.
    pub fn inside<const N: usize>(&mut self, limits: &JointLimits<N>) -> [f64; N] {
        limits.to_array().map(|[low, high]| self.between(low.max(-TAU * 2.0), high.min(TAU * 2.0)))
    }
}

/// Joint vectors between -pi and pi.
pub fn drawn(seed: u64, count: usize) -> impl Iterator<Item = [f64; 6]> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| rng.angles())
}
