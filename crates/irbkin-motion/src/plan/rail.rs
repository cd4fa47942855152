//! The rail or lift that carries the base of an arm, and the base on external axes.

use alloc::vec::Vec;

use nalgebra::{Translation3, Vector3};

use super::axes::{Carried, ExternalAxis};
use super::fault::PlanFault;
use super::freedom::Freedom;
use super::graph::Values;
use crate::arm::Arm;
use crate::error::Error;
use irbkin::Pose;
use irbkin::internal::thresholds::{FORM_TOLERANCE, LIMIT_TOLERANCE};

/// The joint of a file along which the base of an arm slides.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rail {
    /// In the frame of the base, with which it turns.
    pub(crate) track: ExternalAxis,
    /// Where the base is [m].
    pub(crate) position: f64,
}

impl<const N: usize> Arm<N> {
    /// The rail or lift that carries the base, if the file of the arm has one, for
    /// [`PlanOptions::external`](crate::plan::PlanOptions::external). The values of the plan are
    /// then positions of the file's joint, as [`Arm::at`] takes them.
    #[must_use]
    pub fn carrier(&self) -> Option<ExternalAxis> {
        self.rail.as_ref().map(|rail| rail.track.turned(&self.base().rotation))
    }

    /// Return the arm with its base at a position on the rail or lift that carries it [m], counted
    /// as in its file; [`Arm::carrier`] has the limits.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for a position outside the limits, and an arm without a rail.
    pub fn at(&self, position: f64) -> Result<Self, Error> {
        let bounds = self.rail.as_ref().ok_or(PlanFault::NoCarrier)?.track.range();
        // NaN is in no range.
        if !(bounds[0] - LIMIT_TOLERANCE..=bounds[1] + LIMIT_TOLERANCE).contains(&position) {
            return Err(PlanFault::Position { value: position, bounds }.into());
        }
        self.clone().slid(position)
    }

    /// Return the arm with its base anywhere on the line of its rail, if it has one.
    fn slid(mut self, position: f64) -> Result<Self, Error> {
        let Some(rail) = &mut self.rail else { return Ok(self) };
        let way = Vector3::from(rail.track.direction()) * (position - rail.position);
        rail.position = position;
        let base = self.base() * Translation3::from(way);
        Ok(self.map(|robot| robot.with_base(&base))?)
    }

    /// The arm from whose base tracks count: at the zero of its own rail if one is along that.
    pub(super) fn before(&self, axes: &[ExternalAxis]) -> Result<Self, Error> {
        let Some(own) = self.carrier() else { return Ok(self.clone()) };
        let own = Vector3::from(own.direction());
        let off = |axis: &ExternalAxis| own.cross(&Vector3::from(axis.direction())).norm();
        let mut tracks = axes.iter().filter(|axis| matches!(axis.carried, Carried::Robot(_)));
        let is_along = tracks.any(|axis| off(axis) <= FORM_TOLERANCE);
        if is_along { self.clone().slid(0.0) } else { Ok(self.clone()) }
    }

    /// Return the arm as the work object sees it, with external axes at their values [m, rad].
    #[doc(hidden)]
    pub fn carried(&self, axes: &[ExternalAxis], mut values: Vec<f64>) -> Result<Self, Error> {
        values.resize(Values::default().len(), 0.0);
        let values = Values::try_from(values).unwrap_or_default();
        let t_arm_object = Freedom::new(axes, None, None).carried(&Pose::identity(), &values);
        let base = t_arm_object.inverse() * self.before(axes)?.base();
        Ok(self.clone().map(|robot| robot.with_base(&base))?)
    }
}
