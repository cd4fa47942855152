//! The arm of a file beside the catalog's arm of the same table.

use core::array::from_fn;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use nalgebra::{Vector2, Vector3};

use super::{CatalogArm, CatalogGeometry, catalog};
use crate::kinematics::{Joints, Robot};

/// By how much the axes of one arm may differ in two sources, lengths [m] and cosines [1], and by
/// how much its limits [rad]: figures with three digits.
const SAME: f64 = 1e-3;

impl<const N: usize> Robot<N>
where
    Self: Joints<N>,
{
    /// The limits of the catalog's arm of the same table where they are others, in words; of
    /// several such arms, of the one with the fewest. `None` if there is no such arm or no such limit.
    #[doc(hidden)]
    pub fn limits_of_the_catalog(&self) -> Option<String> {
        let arms = catalog().filter(|arm| arm.dof() == N && self.may_be(arm));
        let arms = arms.filter_map(|arm| Self::from_catalog(&arm).ok());
        let arms =
            arms.filter(|arm| self.has_the_axes_of(arm)).map(|arm| (self.limits_unlike(&arm), arm));
        let (others, arm) =
            arms.min_by_key(|(others, _)| others.iter().filter(|it| **it).count())?;
        let degrees = |limit: f64| (1e3 * limit.to_degrees()).round() / 1e3;
        let limits = arm.limits().to_array().into_iter().enumerate().filter(|(i, _)| others[*i]);
        let limits: Vec<String> = limits
            .map(|(i, [lower, upper])| {
                format!("J{} {} to {}", i + 1, degrees(lower), degrees(upper))
            })
            .collect();
        let text = || format!("limits of the catalog's {}: {} deg", arm.name(), limits.join(", "));
        (!limits.is_empty()).then(text)
    }

    /// Whether the structure of an arm can be this one's: to recognize it may take milliseconds.
    fn may_be(&self, arm: &CatalogArm) -> bool {
        let closed = |structure| self.structure() == structure;
        match arm.geometry {
            CatalogGeometry::Abb { .. } => closed("spherical wrist"),
            CatalogGeometry::ThreeParallel { .. } => closed("three parallel axes"),
            _ => !closed("spherical wrist") && !closed("three parallel axes"),
        }
    }

    /// Of each joint, whether its limits are others.
    fn limits_unlike(&self, arm: &Self) -> [bool; N] {
        let limits = [self, arm].map(|robot| robot.limits().to_array());
        from_fn(|joint| {
            let [own, other] = [limits[0][joint], limits[1][joint]];
            // Infinities without a difference are equal.
            own.iter().zip(other).any(|(own, other)| (own - other).abs() > SAME)
        })
    }

    /// Whether the axes of another arm lie to one another as this one's at zero, wherever its base
    /// and its tool are.
    fn has_the_axes_of(&self, arm: &Self) -> bool {
        let [own, other] = [self, arm].map(|robot| robot.link_frames(&[0.0; N]).0);
        let pairs = (0..N).flat_map(|i| (i + 1..N).map(move |j| [i, j]));
        self.is_coupled() == arm.is_coupled()
            && pairs.into_iter().all(|pair| {
                let [own, other] = [own, other].map(|frames| {
                    let [one, two] = pair.map(|joint| frames[joint].rotation * Vector3::z());
                    let [start, end] = pair.map(|joint| frames[joint].translation.vector);
                    let (across, between) = (one.cross(&two), end - start);
                    let is_parallel = across.norm() < SAME;
                    let apart =
                        if is_parallel { between.cross(&one).norm() } else { between.dot(&across) };
                    Vector2::new(one.dot(&two), apart)
                });
                (own - other).amax() <= SAME
            })
    }
}
