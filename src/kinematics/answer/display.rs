//! Solutions as text: one line for each, and a table of all.

use core::fmt;

use super::solutions::{Solution, Solutions};

impl<const N: usize> fmt::Display for Solution<N> {
    /// Slot, joint angles [deg], limits and singularities, in one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:4}", self.slot.index())?;
        for angle in self.q {
            let degrees = angle.to_degrees();
            // Without the sign of a rounded zero.
            let shown = if degrees.abs() < 0.005 { 0.0 } else { degrees };
            write!(f, " {shown:8.2}")?;
        }
        f.write_str(if self.is_within_limits() { "  inside limits" } else { "  outside limits" })?;
        for name in self.singularities().words() {
            write!(f, ", {name} singularity")?;
        }
        match self.free_joint {
            Some(free) => write!(f, ", J{} undetermined", free.joint()),
            None => Ok(()),
        }
    }
}

impl<const N: usize> Solutions<N> {
    /// Return the words behind the outcome: whether there may be more solutions.
    #[doc(hidden)]
    pub fn reservation(&self) -> &'static str {
        let may_have_more = !self.is_certified && !self.is_empty();
        if may_have_more { "; there may be more (not certified)" } else { "" }
    }
}

impl<const N: usize> fmt::Display for Solutions<N> {
    /// The outcome in a sentence, then a table with a line for each solution, angles in degrees.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.explain(), self.reservation())?;
        if self.is_empty() {
            return Ok(());
        }
        write!(f, "\nslot")?;
        for joint in 1..=N {
            // As wide as an angle with its blank.
            let width = if joint < 10 { 8 } else { 7 };
            write!(f, "{:>width$}{joint}", "J")?;
        }
        f.write_str("  [deg]")?;
        self.iter().try_for_each(|solution| write!(f, "\n{solution}"))
    }
}
