//! Regular poses, alone and in the company of others: laws for the tests of each structure.

use std::vec::Vec;

use super::method::ByRoots;
use super::regular::solve;
use super::solved::Solved;
use crate::kinematics::structure::closure::Configuration;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::JointRow;
use crate::lanes::LANES;

/// Check that each pose has the bits among eight that it has alone. Returns how many are regular.
pub(crate) fn same_in_company<M: ByRoots>(method: &M, frames: &[Frame], name: &str) -> usize {
    let mut company = [Solved::NEW; LANES];
    let mut count = 0;
    for block in frames.chunks(LANES) {
        solve(method, &JointRow::OF_TABLE, block, &mut company[..block.len()]);
        for (frame, there) in block.iter().zip(&company) {
            let here = alone(method, frame);
            assert_eq!(here.is_regular, there.is_regular, "{name}");
            if here.is_regular {
                assert_eq!(here.q, there.q, "{name}");
                count += 1;
            }
        }
    }
    count
}

/// The solutions of a pose by angles of the table.
fn alone(method: &impl ByRoots, frame: &Frame) -> Solved {
    let mut solved = [Solved::NEW];
    solve(method, &JointRow::OF_TABLE, &[*frame], &mut solved);
    let [solved] = solved;
    solved
}

/// Check that a pose, if it is regular, has the solutions that the whole search finds. Returns
/// whether the whole search is certain of them, too; `None` for a pose that is not regular.
pub(crate) fn is_as_in_whole_search<M: ByRoots>(
    method: &M,
    frame: &Frame,
    whole_search: impl FnOnce() -> (Vec<Configuration>, bool),
    name: &str,
) -> Option<bool> {
    let solved = alone(method, frame);
    if !solved.is_regular {
        return None;
    }
    let (found, is_certified) = whole_search();
    assert!(found.len() == solved.q.len(), "{name}: {frame:?}");
    for theta in &solved.q {
        assert!(found.iter().any(|one| one.distance(theta) < 1e-9), "{name}: {frame:?}");
    }
    Some(is_certified)
}
