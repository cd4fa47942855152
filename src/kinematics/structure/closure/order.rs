//! The order of solutions without names: by their angles of joint 1; those that are tied in it, one
//! with the next, by joint 2; and so on.

use crate::kinematics::answer::slot::MOST_SLOTS;

/// Difference of two angles that are tied [rad]: two solutions of a regular pose differ by more in
/// at least one joint.
pub(crate) const TIED: f64 = 1e-6;

/// Numbers of solutions by their places.
pub(crate) type Order = [u8; MOST_SLOTS];

/// For each solution, as bits: those whose angle of a joint is smaller, and those with which it is
/// tied, itself too.
pub(crate) type BelowAndNear = [[u64; MOST_SLOTS]; 2];

/// The order of so many solutions, by what a function says of each joint, and whether no two are
/// tied in every joint: those that are keep the order in which they were found.
#[inline(always)]
pub(crate) fn in_order(
    count: usize,
    mut below_and_near: impl FnMut(usize) -> BelowAndNear,
) -> (Order, bool) {
    let every = (1_u64 << count) - 1;
    // Of each solution: how many are before it, and with which it is tied in all joints so far.
    let (mut places, mut ties) = ([0; MOST_SLOTS], [every; MOST_SLOTS]);
    let mut is_tied = true;
    for joint in 0..6 {
        let [below, mut near] = below_and_near(joint);
        is_tied = false;
        for number in 0..count {
            near[number] &= ties[number];
            is_tied |= near[number] != 1 << number;
        }
        for number in 0..count {
            let tied = if is_tied { chain(&near, number) } else { near[number] };
            places[number] += (below[number] & ties[number] & !tied).count_ones();
            ties[number] = tied;
        }
        if !is_tied {
            break;
        }
    }
    let mut order = [0; MOST_SLOTS];
    for (number, name) in (0..count).zip(0..) {
        let tied_before = ties[number] & ((1 << number) - 1);
        order[(places[number] + tied_before.count_ones()) as usize] = name;
    }
    (order, !is_tied)
}

/// Order solutions with these angles, which are not in lanes.
pub(crate) fn in_order_one_by_one<'a>(
    count: usize,
    theta: impl Fn(usize) -> &'a [f64; 6],
) -> (Order, bool) {
    in_order(count, |joint| {
        let [mut below, mut near] = [[0; MOST_SLOTS]; 2];
        for number in 0..count {
            for other in 0..count {
                let from = theta(other)[joint] - theta(number)[joint];
                below[number] |= u64::from(from < 0.0) << other;
                near[number] |= u64::from(from.abs() <= TIED) << other;
            }
        }
        [below, near]
    })
}

/// Return the solutions tied with one, the ones tied with these, and so on.
fn chain(near: &[u64; MOST_SLOTS], number: usize) -> u64 {
    let (mut chain, mut new) = (near[number], near[number]);
    while new != 0 {
        let next = near[new.trailing_zeros() as usize];
        new = (new & (new - 1)) | (next & !chain);
        chain |= next;
    }
    chain
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::rng::Rng;

    /// Solutions by their places, and whether no two are tied in every joint.
    fn ordered(all: &[[f64; 6]]) -> (Vec<[f64; 6]>, bool) {
        let (order, are_apart) = in_order_one_by_one(all.len(), |number| &all[number]);
        (order[..all.len()].iter().map(|number| all[usize::from(*number)]).collect(), are_apart)
    }

    #[test]
    fn the_order_does_not_depend_on_that_in_which_solutions_are_found() {
        let mut rng = Rng::new(1);
        let mut compared = 0;
        for _ in 0..2000 {
            // Few angles, with chains of ties among them.
            let angles = [-1.0, 0.0, 0.7e-6, 1.4e-6, 2.0];
            let mut all: Vec<[f64; 6]> = Vec::new();
            for _ in 0..MOST_SLOTS {
                all.push(core::array::from_fn(|_| angles[(rng.bits() % 5) as usize]));
            }
            let (sorted, are_apart) = ordered(&all);
            if are_apart {
                compared += 1;
                for shift in [3, 5] {
                    all.reverse();
                    all.rotate_left(shift);
                    assert_eq!(ordered(&all), (sorted.clone(), true));
                }
            }
            // A chain of ties in joint 1 leaves it to the next joints; what is above it is behind.
            let first: Vec<_> = sorted.iter().map(|q| q[0]).collect();
            assert!(first.windows(2).all(|pair| pair[0] - pair[1] < 2.0 * TIED), "{first:?}");
        }
        assert!(compared > 1000, "{compared}");
    }

    #[test]
    fn a_chain_of_ties_is_left_to_the_next_joint() {
        let solution = |first, second| [first, second, 0.0, 0.0, 0.0, 0.0];
        let all = [solution(0.0, 3.0), solution(1.6e-6, 1.0), solution(0.8e-6, 2.0)];
        assert_eq!(ordered(&all), ([all[1], all[2], all[0]].to_vec(), true));
    }

    #[test]
    fn what_is_tied_in_every_joint_stays_and_is_said() {
        let all = [[0.5; 6], [0.1; 6], [0.1 + 1e-7; 6]];
        assert_eq!(ordered(&all), ([all[1], all[2], all[0]].to_vec(), false));
        assert_eq!(ordered(&[]), (Vec::new(), true));
    }
}
