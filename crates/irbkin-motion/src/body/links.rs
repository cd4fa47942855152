//! Capsules that move with the links of an arm.

use alloc::borrow::Cow;

use super::shape::{Capsule, RoundedHull, check_length};
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Pose;

/// The source of a body that is made of lengths alone.
const APPROXIMATE: &str = "approximate: capsules along the links of the kinematic table";

/// A capsule that moves with a link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkCapsule {
    /// The link: 0 is the base frame, link i the frame of joint i of the modified
    /// Denavit-Hartenberg table; link n + 1 of n joints is carried by the flange, in its frame.
    pub link: usize,
    /// The capsule, in the link's frame.
    pub capsule: Capsule,
}

/// A convex hull that moves with a link.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkHull {
    /// The link, as of a [`LinkCapsule`].
    pub link: usize,
    /// The hull, in the link's frame.
    pub hull: RoundedHull,
}

/// Capsules that contain the links of an arm, and hulls that do so more closely.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(remote = "Self"))]
pub struct Body {
    /// The arm of the catalog whose body it is.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) arm: Option<&'static str>,
    pub(super) links: Vec<LinkCapsule>,
    pub(super) parts: Vec<LinkCapsule>,
    #[cfg_attr(feature = "serde", serde(default))]
    pub(super) hulls: Vec<LinkHull>,
    pub(super) pairs: Vec<[usize; 2]>,
    pub(super) source: Cow<'static, str>,
    pub(super) excess: Vec<f64>,
    pub(super) is_approximate: bool,
}

impl Body {
    /// A body of capsules and the pairs of links that are to be kept apart.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a pair of a link with itself, or of a link without capsules.
    pub fn new(capsules: Vec<LinkCapsule>, pairs: Vec<[usize; 2]>) -> Result<Self, Error> {
        let body = Self { links: capsules, pairs, ..Self::empty("given") };
        body.check_pairs()?;
        Ok(body)
    }

    /// The body under another source, with how far the capsules of each link are outside of what
    /// they contain [m].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for an excess that is negative, not finite, or not given for every
    /// link.
    pub fn with_source(
        self,
        source: impl Into<Cow<'static, str>>,
        excess: Vec<f64>,
    ) -> Result<Self, Error> {
        excess.iter().try_for_each(|value| check_length("excess", *value, 0.0))?;
        let most = self.links.iter().map(|own| own.link).max().unwrap_or(0);
        if !excess.is_empty() && excess.len() <= most {
            return Err(BodyFault::ExcessCount { found: excess.len(), wanted: most + 1 }.into());
        }
        Ok(Self { arm: None, source: source.into(), excess, ..self })
    }

    /// The body with convex hulls, which contain what the capsules of their links contain: where
    /// capsules touch, these links touch if their hulls do. A link without hulls has its capsules
    /// alone. Replaces the hulls that there were.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a hull of a link without capsules.
    pub fn with_hulls(self, hulls: Vec<LinkHull>) -> Result<Self, Error> {
        let has = |link: usize| self.links.iter().any(|own| own.link == link);
        if let Some(own) = hulls.iter().find(|own| !has(own.link)) {
            return Err(BodyFault::HullLink { link: own.link }.into());
        }
        Ok(Self { arm: None, hulls, ..self })
    }

    fn empty(source: &'static str) -> Self {
        let source = Cow::Borrowed(source);
        let (links, parts, pairs, excess) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let hulls = Vec::new();
        Self { arm: None, links, parts, hulls, pairs, source, excess, is_approximate: false }
    }

    pub(super) fn check_pairs(&self) -> Result<(), Error> {
        let has = |link: usize| self.links.iter().any(|own| own.link == link);
        for pair in &self.pairs {
            if pair[0] == pair[1] || !has(pair[0]) || !has(pair[1]) {
                return Err(BodyFault::Pair { pair: *pair }.into());
            }
        }
        Ok(())
    }

    /// A body that is made of lengths alone.
    pub(crate) fn approximate(links: Vec<LinkCapsule>, pairs: Vec<[usize; 2]>) -> Self {
        Self { links, pairs, is_approximate: true, ..Self::empty(APPROXIMATE) }
    }

    /// A body of the collision shapes of a URDF.
    #[cfg(feature = "urdf")]
    pub(crate) fn of_shapes(
        links: Vec<LinkCapsule>,
        pairs: Vec<[usize; 2]>,
        excess: Vec<f64>,
        source: String,
    ) -> Self {
        Self { links, pairs, excess, source: source.into(), ..Self::empty("") }
    }

    /// The body with capsules that the flange carries, as a link of that number, at most `excess`
    /// outside of what they contain [m].
    pub(crate) fn carrying(
        self,
        link: usize,
        capsules: Vec<LinkCapsule>,
        excess: f64,
        pairs: &[[usize; 2]],
    ) -> Self {
        let mut body = self.with_capsules(capsules);
        body.pairs.retain(|pair| !pair.contains(&link));
        body.pairs.extend(pairs);
        if body.excess.len() > link {
            body.excess[link] = body.excess[link].max(excess);
        } else if body.excess.len() == link {
            body.excess.push(excess);
        }
        body
    }

    /// The body in other frames: each pose moves the shapes of a link into its new one.
    pub(crate) fn in_frames(mut self, pose: impl Fn(usize) -> Option<Pose>) -> Self {
        for own in self.links.iter_mut().chain(&mut self.parts) {
            if let Some(pose) = pose(own.link) {
                own.capsule = own.capsule.moved(&pose);
                self.arm = None;
            }
        }
        for own in &mut self.hulls {
            if let Some(pose) = pose(own.link) {
                own.hull = own.hull.moved(&pose);
            }
        }
        self
    }

    /// The body with more capsules: a hose, a dress pack. The parts beside its links stay.
    #[must_use]
    pub fn with_capsules(mut self, more: Vec<LinkCapsule>) -> Self {
        // Links that have hulls have these as hulls, too.
        for LinkCapsule { link, capsule } in more.iter().copied() {
            if self.hulls.iter().any(|own| own.link == link) {
                self.hulls.push(LinkHull { link, hull: RoundedHull::of_capsule(&capsule) });
            }
        }
        self.links.extend(more);
        Self { arm: None, ..self }
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

    /// Convex hulls of the links, which contain them more closely than the capsules do; of a link
    /// that has none, its capsules decide.
    #[must_use]
    pub fn hulls(&self) -> &[LinkHull] {
        &self.hulls
    }

    /// The pairs of links that are kept apart. The others may touch by construction or, of a body
    /// of the catalog, never do inside the catalog's limits.
    #[must_use]
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Where the shapes of the links are from.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Whether it is made of the lengths of the kinematic table alone: the arm may be outside.
    #[must_use]
    pub fn is_approximate(&self) -> bool {
        self.is_approximate
    }

    /// How far outside its mesh 95 % of the surface of the capsules of each link are at most [m],
    /// and all of the surface of what the flange carries; empty if it is not known.
    #[must_use]
    pub fn excess(&self) -> &[f64] {
        &self.excess
    }
}
