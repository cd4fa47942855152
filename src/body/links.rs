//! Capsules that move with the links of an arm.

use alloc::vec::Vec;

use super::shape::Capsule;
use crate::error::{BodyFault, Error};

/// A capsule that moves with a link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkCapsule {
    /// The link: 0 is the base frame, link i the frame of joint i of the modified
    /// Denavit-Hartenberg table.
    pub link: usize,
    /// The capsule, in the link's frame.
    pub capsule: Capsule,
}

/// Capsules that contain the links of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The arm of the catalog whose body it is.
    pub(super) arm: Option<&'static str>,
    pub(super) links: Vec<LinkCapsule>,
    pub(super) parts: Vec<LinkCapsule>,
    pub(super) pairs: Vec<[usize; 2]>,
    pub(super) source: &'static str,
    pub(super) excess: Vec<f64>,
}

impl Body {
    /// A body of capsules and the pairs of links that are to be kept apart.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a pair of a link with itself, or of a link without capsules.
    pub fn new(capsules: Vec<LinkCapsule>, pairs: Vec<[usize; 2]>) -> Result<Self, Error> {
        let has = |link: usize| capsules.iter().any(|own| own.link == link);
        for pair in &pairs {
            if pair[0] == pair[1] || !has(pair[0]) || !has(pair[1]) {
                return Err(BodyFault::Pair { pair: *pair }.into());
            }
        }
        let (parts, excess) = (Vec::new(), Vec::new());
        Ok(Self { arm: None, links: capsules, parts, pairs, source: "given", excess })
    }

    /// The capsules of the links.
    #[must_use]
    pub fn capsules(&self) -> &[LinkCapsule] {
        &self.links
    }

    /// The capsules of cylinders, pistons and rods beside a link, wherever they may be: kept apart
    /// from obstacles, not from links.
    #[must_use]
    pub fn parts(&self) -> &[LinkCapsule] {
        &self.parts
    }

    /// The pairs of links that are kept apart. The others may touch by construction or, of a body of
    /// the catalog, never do inside the catalog's limits.
    #[must_use]
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Where the shapes of the links are from.
    #[must_use]
    pub fn source(&self) -> &str {
        self.source
    }

    /// How far outside its mesh 95 % of the surface of the capsules of each link are at most [m];
    /// empty if it is not known.
    #[must_use]
    pub fn excess(&self) -> &[f64] {
        &self.excess
    }
}
