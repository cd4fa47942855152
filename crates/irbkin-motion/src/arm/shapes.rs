//! The shapes of an arm: given, or made of the lengths of its kinematic table.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

#[cfg(feature = "urdf")]
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use nalgebra::Vector3;

use super::{Arm, ArmBody};
use crate::body::fault::BodyFault;
use crate::body::{Body, Capsule, LinkCapsule, Shape};
use crate::error::Error;
use crate::paths::line::part;
use irbkin::internal::thresholds::MOST_TOOL;
use irbkin::internal::{POSTURES, checked_pose, screw_x};
use irbkin::{Mdh, Pose};

/// Radius of an approximate body at the base and at the flange, over the sum of all lengths of the
/// table [1]; linear in the number of the link between them. Of the 33 arms with a mesh, so far
/// from the table's lines is 90 % of the surface of links 0 to 6: 0.157, 0.119, 0.127, 0.097,
/// 0.068, 0.041, 0.031 (median).
const RADII: [f64; 2] = [0.155, 0.03];

/// How many links apart are kept apart in an approximate body. Of the next but one, the joint
/// between them decides, of which the table has no shape.
const LINKS_APART: usize = 3;

impl<const N: usize> Arm<N> {
    /// Return the arm with the shapes of its links, or without.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a capsule of a link that the arm does not have, and a pair of the
    /// last link with what the flange carries.
    pub fn with_body(self, body: Option<Body>) -> Result<Self, Error> {
        if let Some(own) = body.iter().flat_map(Body::capsules).find(|own| own.link > N + 1) {
            return Err(BodyFault::NoLink { link: own.link, dof: N }.into());
        }
        let is_rigid = |pair: &&[usize; 2]| pair[0].min(N) == pair[1].min(N);
        if let Some(pair) = body.iter().flat_map(Body::pairs).find(is_rigid) {
            return Err(BodyFault::Rigid { pair: *pair }.into());
        }
        let body = body.map(|body| Arc::new(ArmBody::new(body, N, &self.mdh().flange)));
        Ok(Self { body, ..self })
    }

    /// Return the arm without a body, and why it has none.
    #[cfg(feature = "urdf")]
    pub(crate) fn without_body(self, why: String) -> Self {
        Self { body: None, no_body: Some(why.into()), ..self }
    }

    /// The error of a question that needs a body.
    fn no_body(&self) -> BodyFault {
        let why = self.no_body.as_deref().map(Into::into);
        why.map_or(BodyFault::NoBody, |why| BodyFault::NotRead { why })
    }

    /// The shapes of its links, in their frames ([`Robot::link_frames`]): of an arm of the catalog,
    /// capsules that contain a public mesh or, without one, [`Self::approximate_body`].
    ///
    /// [`Robot::link_frames`]: irbkin::Robot::link_frames
    #[must_use]
    pub fn body(&self) -> Option<&Body> {
        self.body.as_ref().map(|own| &own.body)
    }

    /// Its body, which a question needs.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has none.
    pub(crate) fn needed_body(&self) -> Result<&Body, Error> {
        Ok(&self.shaped()?.body)
    }

    /// Its body with the outline, which a question needs.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has none.
    pub(crate) fn shaped(&self) -> Result<&Arc<ArmBody>, Error> {
        Ok(self.body.as_ref().ok_or_else(|| self.no_body())?)
    }

    /// A body made of the lengths of the kinematic table: capsules along the common normals and the
    /// axes, whose offset `d` two links share by halves; thicker towards the base. The arm may be
    /// outside: motors, counterweights, elbows beside the plane of the arm are in no table.
    ///
    /// Links at least three apart are kept apart, unless they touch in each of 64 postures that
    /// fill the limits.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the lengths of the table are more than ten times the size of the
    /// arm, as of axes that are parallel but for a calibration.
    pub fn approximate_body(&self) -> Result<Body, Error> {
        let lines = lines_of(self.mdh());
        let length = lines.iter().flatten().map(|[a, b]| (b - a).norm()).sum::<f64>();
        let bound = MOST_TOOL * self.size();
        if length > bound || length <= 0.0 {
            return Err(BodyFault::Lengths { length, bound }.into());
        }
        let mut capsules = Vec::new();
        for (link, lines) in lines.into_iter().enumerate() {
            let radius = length * (RADII[0] + (RADII[1] - RADII[0]) * part(link, N));
            let lines = lines.into_iter().map(|[a, b]| Capsule::known(a.into(), b.into(), radius));
            capsules.extend(lines.map(|capsule| LinkCapsule { link, capsule }));
        }
        let pairs = (0..=N).flat_map(|one| (one + LINKS_APART..=N).map(move |two| [one, two]));
        let pairs = self.those_that_come_apart(pairs.collect(), &capsules);
        Ok(Body::approximate(capsules, pairs))
    }

    /// Return the arm with shapes that its flange carries, besides those it has: a tool, a work
    /// piece. They are link `N + 1` of its body.
    ///
    /// `pose` moves the shapes into the flange frame, which is `tool0`: the tool center point does not
    /// move them. Capsules contain each shape, nowhere more than `excess` [m] outside of it; if
    /// that is not given, at most four with the least excess. [`Body::excess`] has the largest.
    /// They are kept apart from links 0 to `N - 2`, unless they touch one in each of 64 postures
    /// that fill the limits.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has no body, a shape is a half space or reaches farther
    /// from the flange than the arm, or the excess needs more than 100 capsules for a shape;
    /// [`irbkin::Error::InvalidPose`] if the pose is not a rigid transform.
    pub fn with_attached(
        self,
        shapes: &[Shape],
        pose: &Pose,
        excess: Option<f64>,
    ) -> Result<Self, Error> {
        let (pose, bound) = (checked_pose(pose)?, self.size());
        let body = self.needed_body()?.clone();
        let (mut added, mut outside): (Vec<LinkCapsule>, f64) = (Vec::new(), 0.0);
        for (index, shape) in shapes.iter().enumerate() {
            let cover = shape.cover(excess)?;
            outside = outside.max(cover.excess);
            for capsule in cover.capsules.iter().map(|capsule| capsule.moved(&pose)) {
                let length = capsule.farthest();
                if length > bound {
                    return Err(BodyFault::LargerThanArm { index, length, bound }.into());
                }
                added.push(LinkCapsule { link: N + 1, capsule });
            }
        }
        let all: Vec<LinkCapsule> = body.capsules().iter().chain(&added).copied().collect();
        let carries = all.iter().any(|own| own.link == N + 1);
        let has = |link: &usize| carries && all.iter().any(|own| own.link == *link);
        let pairs = (0..N - 1).filter(has).map(|link| [link, N + 1]).collect();
        let pairs = self.those_that_come_apart(pairs, &all);
        self.with_body(Some(body.carrying(N + 1, added, outside, &pairs)))
    }

    /// A body of the shapes of links: those that are not neighbors are kept apart, unless they
    /// touch in every posture.
    #[cfg(feature = "urdf")]
    pub(crate) fn body_of_shapes(
        &self,
        capsules: Vec<LinkCapsule>,
        excess: Vec<f64>,
        source: String,
    ) -> Body {
        let has = |link: &usize| capsules.iter().any(|own| own.link == *link);
        let links: Vec<usize> = (0..=N + 1).filter(has).collect();
        // What the flange carries has the neighbors of the last link.
        let others = |one: usize| links.iter().filter(move |two| (**two).min(N) > one + 1);
        let pairs = links.iter().flat_map(|one| others(*one).map(|two| [*one, *two]));
        let pairs = self.those_that_come_apart(pairs.collect(), &capsules);
        Body::of_shapes(capsules, pairs, excess, source)
    }

    /// The pairs of links that do not touch in every posture.
    fn those_that_come_apart(
        &self,
        mut touching: Vec<[usize; 2]>,
        capsules: &[LinkCapsule],
    ) -> Vec<[usize; 2]> {
        let mut apart = Vec::new();
        for posture in 0..POSTURES {
            let (frames, _) = self.link_frames(&self.posture(posture));
            let placed: Vec<LinkCapsule> = capsules
                .iter()
                .map(|own| {
                    let capsule = own.capsule.moved(&self.frame_of_link(own.link, &frames));
                    LinkCapsule { link: own.link, capsule }
                })
                .collect();
            let of = |link: usize| placed.iter().filter(move |own| own.link == link);
            touching.retain(|pair| {
                let touches = of(pair[0]).any(|one| {
                    of(pair[1]).any(|two| one.capsule.separation(&two.capsule).distance <= 0.0)
                });
                if !touches {
                    apart.push(*pair);
                }
                touches
            });
        }
        apart.sort_unstable();
        apart
    }

    /// The frame of a link of the body, by the frames of the links at a posture.
    pub(crate) fn frame_of_link(&self, link: usize, frames: &[Pose; N]) -> Pose {
        match link.checked_sub(1) {
            None => *self.base(),
            Some(joint) if joint < N => frames[joint],
            Some(_) => frames[N - 1] * self.mdh().flange,
        }
    }
}

/// The lines of a table, link by link, each in the frame of its link; a point where it has none.
fn lines_of<const N: usize>(mdh: &Mdh<N>) -> Vec<Vec<[Vector3<f64>; 2]>> {
    let lines_of_link = |link: usize| {
        let own = link.checked_sub(1).map(|joint| mdh.rows[joint]);
        let start = if own.is_some() { Vector3::zeros() } else { mdh.base.translation.vector };
        let before = own.map_or(Vector3::zeros(), |row| -0.5 * row.d * Vector3::z());
        let mut points = Vec::from([before, start]);
        match mdh.rows.get(link) {
            Some(next) => {
                let mut foot = screw_x(next.alpha, next.a);
                if own.is_none() {
                    foot = mdh.base * foot;
                }
                let along = foot.rotation * Vector3::z();
                points.extend([0.0, 0.5 * next.d].map(|d| foot.translation.vector + along * d));
            }
            None => points.push(mdh.flange.translation.vector),
        }
        let lines = points.windows(2).map(|ends| [ends[0], ends[1]]);
        let mut lines: Vec<_> = lines.filter(|[a, b]| a != b).collect();
        if lines.is_empty() {
            lines.push([start; 2]);
        }
        lines
    };
    (0..=N).map(lines_of_link).collect()
}
