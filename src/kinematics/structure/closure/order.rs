//! The order of solutions without names.

use core::cmp::Ordering;

/// Difference of two angles that are the same for the order [rad].
pub(crate) const TIED: f64 = 1e-6;

/// The order of two solutions: by their first angles that differ. Equal are those that differ by
/// less than two different ones of a regular pose.
pub(crate) fn in_order(a: &[f64; 6], b: &[f64; 6]) -> Ordering {
    let differ = |(a, b): &(&f64, &f64)| (**a - **b).abs() > TIED;
    a.iter().zip(b).find(differ).map_or(Ordering::Equal, |(a, b)| a.total_cmp(b))
}
