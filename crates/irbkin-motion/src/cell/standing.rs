//! Arms that stand still beside the one that moves.

use alloc::format;
use alloc::vec::Vec;

use super::obstacles::Cell;
use crate::arm::Arm;
use crate::body::Shape;
use crate::error::Error;
use irbkin::internal::check_seed;

impl Cell {
    /// The cell with another arm in it, which stands still at joints `q` [rad]. Each of its links is
    /// an obstacle: link 3 of an arm `left` has the name `left, link 3`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has no body, or an obstacle has the name of one of its
    /// links; [`irbkin::Error::InvalidJoints`] for joints that are not finite.
    pub fn with_robot<const N: usize>(
        self,
        name: &str,
        arm: &Arm<N>,
        q: &[f64; N],
    ) -> Result<Self, Error> {
        check_seed("q", q)?;
        let checker = self.checker(arm)?;
        let at = checker.at(q);
        let mut links = Vec::new();
        for link in 0..=N + 1 {
            let groups = checker.outline.groups.iter().enumerate();
            let groups = groups.filter(|(_, group)| group.number == link);
            let own = groups.flat_map(|(place, _)| at.capsules_of(place));
            let shapes: Vec<_> = own.copied().map(Shape::Capsule).collect();
            if !shapes.is_empty() {
                links.push((format!("{name}, link {link}"), Shape::union(shapes)?));
            }
        }
        self.with_obstacles(links)
    }
}
