//! The instruction set that the kernels run on.

use core::sync::atomic::{AtomicU8, Ordering};

use crate::error::Error;

/// The instruction sets that kernels are compiled for. The widest one of the processor is chosen
/// when the first kernel runs.
///
/// Answers have the same bits on AVX2 and on AVX-512, and agree with every baseline's to
/// rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstructionSet {
    /// The set that the crate is compiled for: SSE2 on x86-64, NEON on aarch64.
    Baseline,
    /// AVX2 and FMA: four lanes.
    Avx2,
    /// AVX-512 (F, DQ, VL): eight lanes.
    Avx512,
}

/// A computation that is compiled for each instruction set.
pub trait Kernel {
    /// The result.
    type Answer;

    /// Whether there is enough parallel work for 512-bit registers to pay off: the processor lowers
    /// its clock and joins ports for them.
    const WIDE: bool;

    /// Compute the answer; `FUSED` if the instruction set multiplies and adds in one rounding. Must
    /// be `#[inline(always)]`.
    fn run<const FUSED: bool>(self) -> Self::Answer;
}

/// Whether the baseline has fused multiplication and addition.
const BASELINE_FUSED: bool =
    cfg!(all(feature = "std", any(target_arch = "aarch64", target_feature = "fma")));

/// The set in use, as 1 + its number; 0 before it is chosen.
static IN_USE: AtomicU8 = AtomicU8::new(0);

impl InstructionSet {
    const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The set in use.
    #[must_use]
    pub fn in_use() -> Self {
        match IN_USE.load(Ordering::Relaxed) {
            1 => Self::Baseline,
            2 => Self::Avx2,
            3 => Self::Avx512,
            _ => Self::detect(),
        }
    }

    #[cold]
    fn detect() -> Self {
        let widest = Self::available().last().unwrap_or(Self::Baseline);
        IN_USE.store(widest as u8 + 1, Ordering::Relaxed);
        widest
    }

    /// The sets that this processor supports, the narrowest first.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|set| set.is_available())
    }

    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        use std::arch::is_x86_feature_detected as has;
        match self {
            Self::Baseline => true,
            Self::Avx2 => has!("avx2") && has!("fma"),
            Self::Avx512 => {
                has!("avx2")
                    && has!("avx512f")
                    && has!("avx512dq")
                    && has!("avx512vl")
                    && has!("fma")
            }
        }
    }

    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }

    /// Use this set from now on, in the whole process: for tests and measurements.
    ///
    /// # Errors
    ///
    /// [`Error::NoInstructionSet`] when the processor does not support it.
    pub fn force(self) -> Result<(), Error> {
        if !self.is_available() {
            return Err(Error::NoInstructionSet { name: self.name() });
        }
        IN_USE.store(self as u8 + 1, Ordering::Relaxed);
        Ok(())
    }

    /// Its name: "baseline", "avx2" or "avx512".
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

/// Run a kernel on the instruction set in use.
#[inline]
#[cfg_attr(
    all(feature = "std", target_arch = "x86_64"),
    expect(unsafe_code, reason = "a function for instructions that were detected")
)]
pub fn run<K: Kernel>(kernel: K) -> K::Answer {
    match InstructionSet::in_use() {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        // SAFETY: the set in use is one that `is_available` found in this processor.
        InstructionSet::Avx512 if K::WIDE => unsafe { with_avx512(kernel) },
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        // SAFETY: as above; a processor with AVX-512 has AVX2 and FMA.
        InstructionSet::Avx512 | InstructionSet::Avx2 => unsafe { with_avx2(kernel) },
        _ => kernel.run::<BASELINE_FUSED>(),
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
fn with_avx512<K: Kernel>(kernel: K) -> K::Answer {
    kernel.run::<true>()
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn with_avx2<K: Kernel>(kernel: K) -> K::Answer {
    kernel.run::<true>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sets::on_each_set;

    #[test]
    #[ignore = "run by itself: cargo test --lib -- --ignored"]
    fn the_widest_supported_set_is_in_use_and_others_are_refused() {
        let available = || InstructionSet::available();
        assert_eq!(available().next(), Some(InstructionSet::Baseline));
        on_each_set(|set| assert_eq!(InstructionSet::in_use(), set));
        for set in InstructionSet::ALL.into_iter().filter(|set| !available().any(|has| has == *set))
        {
            let refused = std::string::ToString::to_string(&set.force().unwrap_err());
            assert!(refused.contains(set.name()), "{refused}");
        }
    }
}
