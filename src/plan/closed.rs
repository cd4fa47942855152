//! The best way that ends with the joint angles that it begins with (docs/plan.md, section 6).

use alloc::vec::Vec;

use super::answer::PlanError;
use super::field::Field;
use super::options::PlanOrder;
use super::search::Bound;
use super::turns::TurnStates;
use super::way::{Found, Way};

/// Nodes and turns, with the best way that begins at one of them and ends at one of them: no closed
/// way from one of them is better.
struct Region {
    bound: Bound,
    found: Found,
}

impl Region {
    fn cost(&self, order: PlanOrder) -> (f64, f64) {
        order.cost(self.found.bottleneck, self.found.squares)
    }

    /// Two parts that the ends of the way are not both in; `None` if it is closed.
    fn split(&self, numbers: [usize; 2]) -> Option<[Bound; 2]> {
        let cut = |[first, end]: [usize; 2], [one, other]: [usize; 2]| {
            let middle = (one + other).div_ceil(2);
            (one != other).then_some([[first, middle], [middle, end]])
        };
        let bound = self.bound;
        match cut(bound.nodes, numbers) {
            Some(parts) => Some(parts.map(|nodes| Bound { nodes, ..bound })),
            None => cut(bound.states, self.found.states)
                .map(|parts| parts.map(|states| Bound { states, ..bound })),
        }
    }
}

impl Field<'_> {
    /// The best closed way through all layers; `None` if there is none.
    ///
    /// Branch and bound: of the regions of nodes to begin at, that with the best way is halved
    /// between the ends of that way, until they are one.
    pub(super) fn closed_way(&self, states: &mut TurnStates) -> Result<Option<Way>, PlanError> {
        'with_turns: loop {
            let Some([whole, _]) = self.bounds(0, states) else { return Ok(None) };
            let mut regions: Vec<Region> = Vec::new();
            let mut open = Vec::from([whole]);
            loop {
                for bound in open.drain(..) {
                    let found = self.found(0, states, [bound; 2])?;
                    regions.extend(found.map(|found| Region { bound, found }));
                }
                let costs = regions.iter().enumerate();
                let best = costs.min_by(|(_, a), (_, b)| {
                    let [a, b] = [a, b].map(|region| region.cost(self.order));
                    a.partial_cmp(&b).unwrap_or(core::cmp::Ordering::Equal)
                });
                let Some(best) = best.map(|(number, _)| number) else { return Ok(None) };
                let region = regions.swap_remove(best);
                let nodes = &region.found.nodes;
                let numbers = [nodes[0], nodes[nodes.len() - 1]].map(|n| self.grid.number(n));
                match region.split(numbers) {
                    Some(parts) => open.extend(parts),
                    None => match self.unwound(region.found, 0, states) {
                        Ok(way) => return Ok(Some(way)),
                        Err(joint) => {
                            states.add(joint, self.joints)?;
                            continue 'with_turns;
                        }
                    },
                }
            }
        }
    }
}
