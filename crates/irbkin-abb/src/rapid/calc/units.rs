//! Mechanical units beside the robot: what carries it, and what moves work objects.

use nalgebra::{Rotation3, Translation3, Vector3};

use crate::prelude::*;
use crate::rapid::data::records::NOT_THERE;
use crate::rapid::text::fault::FrameFault;
use irbkin::Pose;

/// Angle above which an axis does not exist [deg]: no joint turns so far, and RAPID writes 9E9.
pub(in crate::rapid) const MOST_DEGREES: f64 = 1e6;

pub(in crate::rapid) const EXTERNAL_AXES: [&str; 6] =
    ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"];

/// An axis of a mechanical unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitAxis {
    /// The external axis that drives it, from 0 for `eax_a`.
    pub external: usize,
    /// Where it stands, seen from what the axis before it moves, or from the world [m].
    pub frame: Pose,
    /// Whether it turns about its z axis; a linear one moves along its x axis.
    pub is_rotation: bool,
}

/// A track, a positioner, a servo gun.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unit {
    /// Its name, as `ufmec` has it.
    pub name: String,
    /// Its axes from the world on.
    pub axes: Vec<UnitAxis>,
    /// Whether it carries the robot.
    pub is_carrier: bool,
    /// Whether its axes are where `axes` says; the external axes of others are known to be no
    /// matter of the robot's base, and work objects on them are not checked.
    pub is_determined: bool,
}

impl Unit {
    /// The frame that it moves, seen from the world, at external axes [deg or mm].
    fn frame(&self, extax: &[f64; 6]) -> Result<Pose, FrameFault> {
        self.axes.iter().try_fold(Pose::identity(), |frame, axis| {
            let value = extax.get(axis.external).copied().unwrap_or(NOT_THERE);
            if value.abs() >= MOST_DEGREES {
                let axis = EXTERNAL_AXES.get(axis.external).copied().unwrap_or("an axis");
                return Err(FrameFault::AxisMissing { axis, unit: self.name.clone() });
            }
            let own = if axis.is_rotation {
                let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), value.to_radians());
                Pose::from_parts(Translation3::identity(), turn)
            } else {
                Pose::from_parts(Translation3::new(value / 1e3, 0.0, 0.0), Rotation3::identity())
            };
            Ok(frame * axis.frame * own)
        })
    }
}

/// The units of a robot's controller.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units(pub Vec<Unit>);

impl Units {
    /// The displacement of the robot's base in the world at external axes, from where it is with
    /// all of them at zero; nothing if it is not carried.
    pub(in crate::rapid) fn carried(&self, extax: &[f64; 6]) -> Result<Pose, FrameFault> {
        let Some(carrier) = self.0.iter().find(|unit| unit.is_carrier) else {
            return Ok(Pose::identity());
        };
        if !carrier.is_determined {
            return Err(FrameFault::Carried { unit: carrier.name.clone() });
        }
        Ok(carrier.frame(extax)? * carrier.frame(&[0.0; 6])?.inverse())
    }

    /// The frame that a unit moves.
    pub(in crate::rapid) fn moved(&self, name: &str, extax: &[f64; 6]) -> Result<Pose, FrameFault> {
        let mut known = self.0.iter().filter(|unit| unit.is_determined);
        let unit = known.find(|unit| unit.name.eq_ignore_ascii_case(name));
        unit.ok_or_else(|| FrameFault::Moved { unit: name.into() })?.frame(extax)
    }

    /// The first external axis, from 0, that is not at zero and belongs to no unit.
    pub(in crate::rapid) fn unknown(&self, extax: &[f64; 6]) -> Option<usize> {
        (0..6).find(|external| {
            let value = extax[*external];
            let mut axes = self.0.iter().flat_map(|unit| &unit.axes);
            value != 0.0
                && value.abs() < MOST_DEGREES
                && !axes.any(|axis| axis.external == *external)
        })
    }

    /// If units move between two targets, whether what they move turns: a straight line is none
    /// there, seen from the robot.
    pub(in crate::rapid) fn turn_between(&self, from: &[f64; 6], to: &[f64; 6]) -> Option<bool> {
        let axes = self.0.iter().filter(|unit| unit.is_determined).flat_map(|unit| &unit.axes);
        let moved = axes.filter(|axis| {
            let [from, to] = [from, to].map(|it| it.get(axis.external).copied().unwrap_or(0.0));
            (from - to).abs() > 0.0
        });
        moved.map(|axis| axis.is_rotation).reduce(|turns, next| turns || next)
    }
}
