//! Axes 2 and 3 coupled by a parallelogram: a rod holds the forearm's pitch while axis 2 turns.
//!
//! The controller of such an arm tells axis 3 from the base, not from the upper arm: its q3 is that of the serial chain plus q2
//! (docs/ik_derivation.md, eq. 25).

/// The serial chain's joint angles of a controller's [rad].
#[inline(always)]
pub(crate) fn serial<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 -= *q2;
    }
    q
}

/// The controller's joint angles of a serial chain's [rad].
pub(crate) fn coupled<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 += *q2;
    }
    q
}
