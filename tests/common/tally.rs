//! Counts of a hard set, and its row.

use irbkin::Solutions;

use super::asked_set;

/// What became of the poses of a set.
#[derive(Default)]
pub struct Tally {
    pub poses: usize,
    pub found: usize,
    pub wrong: usize,
    pub twice: usize,
    pub position: f64,
    pub rotation: f64,
    pub solutions: usize,
    pub flags: usize,
}

impl Tally {
    /// Counts the answer to a pose that is out of reach: nothing, and how far.
    pub fn take_missed(&mut self, solutions: &Solutions<6>, beyond: f64) {
        self.poses += 1;
        self.found += usize::from((solutions.reach().shortfall() - beyond).abs() < 1e-9);
        self.solutions += solutions.len();
        self.wrong += solutions.len();
    }

    /// Prints the row; returns it when something is amiss.
    pub fn tell(&self, name: &str, set: &str) -> String {
        #[expect(clippy::cast_precision_loss, reason = "a mean")]
        let (found, mean) = (
            100.0 * self.found as f64 / self.poses as f64,
            self.solutions as f64 / self.poses as f64,
        );
        let row = format!(
            "{name:22} {:8} {set:34} {:7} poses  found {found:6.2} %  wrong {}  twice {}  worst {:.1e} m {:.1e} rad  {mean:.2} solutions",
            asked_set().name(),
            self.poses,
            self.wrong,
            self.twice,
            self.position,
            self.rotation
        );
        println!("{row}");
        let amiss = self.found != self.poses || self.wrong + self.twice + self.flags > 0;
        if amiss { format!("{row} (flags missing: {})\n", self.flags) } else { String::new() }
    }
}
