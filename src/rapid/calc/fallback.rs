//! What a target gets whose configuration names no solution, or more than one.

/// The treatment of a target whose configuration no solution has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fallback<const N: usize = 6> {
    /// It has no joint angles.
    None,
    /// It has no joint angles. If a configuration names more than one solution, it gets the one
    /// nearest to the previous joint angles; these [rad] are before the first target.
    Near([f64; N]),
    /// It gets the solution nearest to the previous joint angles (for the first target, to these
    /// [rad]), and the problem reports so.
    Nearest([f64; N]),
}
