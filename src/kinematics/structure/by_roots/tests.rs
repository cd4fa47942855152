//! Regular poses, alone and in the company of others: laws for the tests of each structure.

use std::vec::Vec;

use super::method::ByRoots;
use super::regular::Regular;
use crate::kinematics::structure::closure::Configuration;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::LANES;

/// Check that each pose has the bits among eight that it has alone. Returns how many are regular.
pub(crate) fn same_in_company<M: ByRoots>(method: &M, frames: &[Frame], name: &str) -> usize {
    let (mut alone, mut company) = (Regular::new(), Regular::new());
    let mut count = 0;
    for block in frames.chunks(LANES) {
        let all = company.solve(method, block);
        for (frame, there) in block.iter().zip(all) {
            let [here] = alone.solve(method, &[*frame]) else { unreachable!() };
            assert_eq!(here.is_regular, there.is_regular, "{name}");
            if here.is_regular {
                assert_eq!(here.as_slice(), there.as_slice(), "{name}");
                count += 1;
            }
        }
    }
    count
}

/// Check that a pose, if it is regular, has the solutions that the whole search finds. Returns
/// whether it is.
pub(crate) fn is_as_in_whole_search<M: ByRoots>(
    method: &M,
    frame: &Frame,
    whole_search: impl FnOnce() -> (Vec<Configuration>, bool),
    name: &str,
) -> bool {
    let mut regular = Regular::new();
    let [solved] = regular.solve(method, &[*frame]) else { unreachable!() };
    if !solved.is_regular {
        return false;
    }
    let (found, is_certified) = whole_search();
    assert!(is_certified && found.len() == solved.as_slice().len(), "{name}: {frame:?}");
    for theta in solved.as_slice() {
        assert!(found.iter().any(|one| one.distance(theta) < 1e-9), "{name}: {frame:?}");
    }
    true
}
