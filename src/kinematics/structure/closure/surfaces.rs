//! Each surface by one configuration.
//!
//! Docs: general.md, eq. 103b.

use super::accepted::{Accepted, ROOM};
use super::chain::{Closure, Target};
use super::configuration::Kind;
use super::surface::Surface;

/// Configurations that are tried to join with one: those nearest to it.
const NEAREST: usize = 4;

impl Accepted {
    /// Keep one configuration of each surface.
    pub(super) fn thin_surfaces(&mut self, closure: &Closure, target: &Target) {
        let Some(first) = self.as_slice().iter().find(|one| one.is_surface()) else { return };
        let Some(surface) = Surface::next_to(closure, target, &first.theta) else { return };
        let all = self.emptied();
        let all = all.as_slice();
        // Configurations that ways join have the number of the first of them.
        let mut group: [usize; ROOM] = core::array::from_fn(|index| index);
        for (index, one) in all.iter().enumerate() {
            let may_join = |other: &usize| {
                let other = &all[*other];
                let (known, new) = if one.is_surface() { (one, other) } else { (other, one) };
                known.is_surface() && new.is_singular() && !matches!(new.kind, Kind::Free(_))
            };
            let (mut nearest, mut count) = ([0; ROOM], 0);
            for other in (0..index).filter(may_join) {
                nearest[count] = other;
                count += 1;
            }
            let nearest = &mut nearest[..count];
            let distance = |other: &usize| one.distance(&all[*other].theta);
            nearest.sort_unstable_by(|a, b| distance(a).total_cmp(&distance(b)));
            for other in nearest.iter().take(NEAREST) {
                let [here, there] = [group[index], group[*other]];
                if here != there && surface.joins(one, &all[*other]) {
                    for number in &mut group[..=index] {
                        *number =
                            if *number == here.max(there) { here.min(there) } else { *number };
                    }
                }
            }
        }
        for (index, one) in all.iter().enumerate() {
            if group[index] == index {
                self.insert(closure, *one);
            }
        }
    }
}
