//! Replaces solutions outside the limits by other members of their self-motion, or by neighbors of
//! the same pose, that are inside.

use crate::error::Error;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::nearest::{NearestSearch, Wanted};
use crate::kinematics::solve::self_motion::meets;

impl<const N: usize> Robot<N> {
    /// If a solution is outside the limits and another member of its self-motion, at most `allowed`
    /// [rad, m] off the pose, is inside, that member takes its slot.
    pub(in crate::kinematics) fn bring_self_motions_inside(
        &self,
        solutions: &mut Solutions<N>,
        allowed: f64,
    ) -> Result<(), Error> {
        for slot in 0..solutions.slot_count() {
            let Some(outside) = solutions
                .slot(slot)
                .copied()
                .filter(|solution| solution.free_joint.is_some() && !solution.is_within_limits())
            else {
                continue;
            };
            let rest = self.resting(outside.q[self.locked_index()]);
            // A slot that holds another solution is not vacant.
            let vacant = |to: usize| to == slot || solutions.slot(to).is_none();
            let branches = outside.free_joint.map_or(&[][..], |free| free.branches());
            let accepts = |member: &Solution<N>| {
                let to = member.slot.index();
                vacant(to) && branches.iter().copied().flatten().any(|branch| to == slot ^ branch)
            };
            let wanted = Wanted {
                limits: solutions.limits,
                seed: &rest,
                weights: &[1.0; N],
                accepts: &accepts,
            };
            let mut search = NearestSearch::new(self, solutions, &wanted, allowed);
            search.look_along_chain(&outside);
            if self.is_closed_form() {
                search.takes_any = true;
                search.look_along(&outside);
                if search.best.is_none() {
                    search.look_at_twins(&outside)?;
                }
            }
            if let Some(inside) = search.best.map(|best| best.solution) {
                solutions.replace(slot, inside);
            }
        }
        Ok(())
    }

    /// If no solution is inside the limits but another one of the pose is, it takes the slot of the
    /// solution that it was derived from.
    pub(in crate::kinematics) fn bring_one_inside(
        &self,
        solutions: &mut Solutions<N>,
    ) -> Result<(), Error> {
        // For seven axes, one is searched along the redundancy.
        if N != 6 || solutions.is_empty() || solutions.iter().any(Solution::is_within_limits) {
            return Ok(());
        }
        if self.are_regular(solutions) {
            return Ok(());
        }
        let wanted = Wanted {
            limits: solutions.limits,
            seed: &self.limits().rest(),
            weights: &[1.0; N],
            accepts: &|_| true,
        };
        let found = self.nearest_within(solutions, &wanted, meets(solutions.pose()))?;
        if let Some((from, inside)) = found {
            solutions.replace(from.index(), inside);
        }
        Ok(())
    }
}

impl<const N: usize> Solutions<N> {
    /// Replace the solution in `slot` by another one of the same branch, or of its twin.
    fn replace(&mut self, slot: usize, solution: Solution<N>) {
        let (to, places) = (solution.slot.index(), self.places_mut());
        if places[to].found().is_none() {
            // The MERGED status of the other slot now applies to this one.
            places.swap(slot, to);
        }
        places[to] = Place::Found(solution);
    }
}
