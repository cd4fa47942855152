//! The results for the poses of a set: counts, worst figures and one row of a table.

use irbkin::{Pose, Robot, Solutions};

use super::asked_set;

const SLOTS: usize = 16;

/// Counts of a set of poses.
#[derive(Debug, Default)]
pub struct Tally {
    pub poses: usize,
    /// Poses whose own joint vector is among the answers.
    pub found: usize,
    /// Poses whose own joint vector is not, and whose answer says that it is not certain.
    pub uncertain: usize,
    /// Of those found, found only to worse than 1e-9 rad.
    pub coarse: usize,
    /// Solutions that do not close, or are in an incorrect slot.
    pub incorrect: usize,
    /// Duplicate solutions.
    pub duplicates: usize,
    /// Poses with a flag that is missing.
    pub flags: usize,
    pub solutions: usize,
    /// Poses by their number of solutions.
    pub by_count: [usize; SLOTS + 1],
    /// Worst residuals [m], [rad].
    pub position: f64,
    pub rotation: f64,
    /// Worst distance of the joint vector found from the one that made the pose [rad].
    pub recall: f64,
    /// The first pose with an incorrect result.
    pub example: Option<String>,
}

impl Tally {
    /// Counts the solutions of a pose that do not close, each to its bounds [m, rad].
    pub fn take_residuals<'a, const N: usize>(
        &mut self,
        robot: &Robot<N>,
        pose: &Pose,
        answers: impl IntoIterator<Item = (&'a [f64; N], [f64; 2])>,
    ) {
        let mut count = 0;
        for (q, [position, rotation]) in answers {
            let residual = robot.residual(q, pose);
            self.position = self.position.max(residual.position);
            self.rotation = self.rotation.max(residual.rotation);
            // The negation counts NaN.
            let closes = residual.position <= position && residual.rotation <= rotation;
            self.incorrect += usize::from(!closes);
            count += 1;
        }
        self.poses += 1;
        self.solutions += count;
        self.by_count[count] += 1;
    }

    /// Counts the answer to a pose that is out of reach: no solution, and the shortfall.
    pub fn take_missed<const N: usize>(
        &mut self,
        solutions: &Solutions<N>,
        beyond: f64,
        bound: f64,
    ) {
        self.poses += 1;
        self.by_count[0] += 1;
        self.found += usize::from((solutions.reach().shortfall() - beyond).abs() < bound);
        self.solutions += solutions.len();
        self.incorrect += solutions.len();
    }

    pub fn missed(&self) -> usize {
        self.poses - self.found
    }

    /// The sum of the counts that must be zero.
    pub fn amiss(&self) -> usize {
        self.missed() - self.uncertain + self.incorrect + self.duplicates + self.flags
    }

    /// Prints the row; returns it if a count is not zero.
    pub fn row(&self, name: &str, set: &str) -> String {
        #[expect(clippy::cast_precision_loss, reason = "a mean")]
        let (found, mean) = (
            100.0 * self.found as f64 / self.poses as f64,
            self.solutions as f64 / self.poses as f64,
        );
        let row = format!(
            "{name:22} {:8} {set:34} {:7} poses  found {found:6.2} %  missed {} (of which uncertain \
             {})  incorrect {}  duplicates {}  flags missing {}  worst {:.1e} m {:.1e} rad  {mean:.2} solutions",
            asked_set().name(),
            self.poses,
            self.missed(),
            self.uncertain,
            self.incorrect,
            self.duplicates,
            self.flags,
            self.position,
            self.rotation
        );
        println!("{row}");
        if self.amiss() == 0 {
            return String::new();
        }
        format!("{row}\n{}\n", self.example.as_deref().unwrap_or_default())
    }
}
