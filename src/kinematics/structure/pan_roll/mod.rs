//! Arms of five axes: axis 1 perpendicular to the parallel axes 2, 3 and 4, and axis 5, about which
//! the tool rolls, perpendicular to these.
//!
//! Such an arm reaches a position, an elevation of axis 5 and a roll about it. The plane of the arm
//! then determines the heading of the tool: an answer has all joint vectors whose tool is the pose
//! turned about axis 1 by no more than a tolerance. `docs/theory/pan_roll.md` has the derivation,
//! with the equation numbers (from 150 on) cited in the code.

mod geometry;
mod solve;

use alloc::sync::Arc;

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use self::geometry::{Geometry, PATTERN};
use super::end_frames::EndFrames;
use super::free_choice::FreeChoice;
use super::inverse::{Inverse, Solved};
use super::planar_arm::PlanarArm;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::thresholds::UPRIGHT_SIN;
use crate::report::UnknownStructure;

const SLOTS: usize = 8;

const SLOT_NAMES: [&str; SLOTS] = [
    "tool away from axis 1, in front of it, q3 forwards",
    "tool away from axis 1, in front of it, q3 backwards",
    "tool away from axis 1, behind it, q3 forwards",
    "tool away from axis 1, behind it, q3 backwards",
    "tool towards axis 1, in front of it, q3 forwards",
    "tool towards axis 1, in front of it, q3 backwards",
    "tool towards axis 1, behind it, q3 forwards",
    "tool towards axis 1, behind it, q3 backwards",
];

/// The arm between its base and its tool.
#[derive(Clone, Debug)]
pub(crate) struct PanRoll {
    geometry: Geometry,
    end_frames: EndFrames,
    /// The tool center point in the wrist frame [m].
    tool: Vector3<f64>,
    /// Largest heading error of an answer [rad].
    tolerance: f64,
}

impl PanRoll {
    /// The chain and the inverse of a table of this structure.
    pub(crate) fn measured(mdh: &Mdh<5>) -> Result<Solved<5>, UnknownStructure> {
        let squared = PATTERN.square_up(mdh)?;
        let geometry = Geometry::measure(&squared)?;
        let chain = Chain::new(squared);
        let arm = Self::between(geometry, &chain);
        Ok((chain, Arc::new(arm)))
    }

    fn between(mut geometry: Geometry, chain: &Chain<5>) -> Self {
        let map = &geometry.joint_map;
        let fixed = [chain.base(), &map.t_base_shoulder, &map.t_wrist_flange, chain.tool()];
        let end_frames = EndFrames::new(map, chain);
        let tool = (map.t_wrist_flange * chain.tool()).translation.vector;
        let planar = geometry.planar.between(fixed);
        let extent = planar.extent + geometry.below.abs();
        geometry.planar = PlanarArm { extent, ..planar };
        Self { geometry, end_frames, tool, tolerance: chain.heading_tolerance() }
    }

    /// The elevation of axis 5 from axis 1 [rad], and the distance along the plane of the arm [m] of
    /// the tool center point from axis 1 or, where axis 5 is parallel to axis 1, of the wrist.
    fn elevation_and_reach(&self, q: &[f64; 5]) -> [f64; 2] {
        let Geometry { planar, below, joint_map } = &self.geometry;
        let [_, theta_2, theta_3, theta_4, theta_5] = joint_map.theta(q);
        let phi = theta_2 + theta_3 + theta_4;
        let (sin_phi, cos_phi) = phi.sin_cos();
        let [_, end] = planar.elbow_and_end(theta_2.sin_cos(), theta_3.sin_cos());
        let wrist = end + below * cos_phi;
        if sin_phi.abs() <= UPRIGHT_SIN {
            return [phi, wrist];
        }
        let (sin_5, cos_5) = theta_5.sin_cos();
        let across = self.tool.x * cos_5 - self.tool.y * sin_5;
        [phi, wrist + across * cos_phi + self.tool.z * sin_phi]
    }
}

impl Inverse<5> for PanRoll {
    fn name(&self) -> &'static str {
        PATTERN.name
    }

    fn slot_count(&self) -> usize {
        SLOTS
    }

    fn slot_names(&self) -> Option<&'static [&'static str]> {
        Some(&SLOT_NAMES)
    }

    fn between(&self, chain: &Chain<5>, _: &JointLimits<5>) -> Arc<dyn Inverse<5>> {
        Arc::new(Self::between(self.geometry.clone(), chain))
    }

    /// One branch after the other: the tolerance leaves few of them.
    fn solve_in_lanes(&self, solutions: &mut Solutions<5>, locked: f64) -> bool {
        self.solve(solutions, locked, &FreeChoice::rest([0.0; 5]));
        solutions.iter().all(|solution| solution.singularities().is_empty())
    }

    fn solve_on_path(&self, solutions: &mut Solutions<5>, locked: f64) -> bool {
        self.solve_in_lanes(solutions, locked)
    }

    fn solve(&self, solutions: &mut Solutions<5>, _: f64, free: &FreeChoice<5>) {
        let branches = self.branches(&solutions.pose, free);
        let limits = solutions.limits;
        for (slot, place) in solutions.first_places::<SLOTS>().iter_mut().enumerate() {
            *place = branches.place(slot, &limits, f64::NAN);
        }
        solutions.reach = branches.reach;
    }

    fn singular(&self, q: &[f64; 5]) -> (Option<SingularDistances>, SingularityKind) {
        let planar = &self.geometry.planar;
        let theta_3 = self.geometry.joint_map.theta(q)[2];
        let [phi, reach] = self.elevation_and_reach(q);
        let distances = SingularDistances {
            wrist: distance_from_half_turns(phi),
            elbow: distance_from_half_turns(planar.elbow_angle(theta_3)),
            shoulder: reach.abs(),
        };
        let mut singularities = SingularityKind::empty();
        singularities.set(SingularityKind::WRIST, phi.sin().abs() <= UPRIGHT_SIN);
        singularities.set(SingularityKind::ELBOW, planar.is_straight(theta_3));
        singularities.set(SingularityKind::SHOULDER, reach.abs() <= planar.shoulder_merge());
        (Some(distances), singularities)
    }

    /// It is not square.
    fn jacobian_determinant(&self, _: &[f64; 5]) -> Option<f64> {
        None
    }

    fn slot(&self, q: &[f64; 5]) -> Option<Slot> {
        let [phi, reach] = self.elevation_and_reach(q);
        let (_, met) = self.singular(q);
        let towards = phi.sin() < -UPRIGHT_SIN;
        let behind = reach < 0.0 && !met.contains(SingularityKind::SHOULDER);
        let theta_3 = self.geometry.joint_map.theta(q)[2];
        let backwards =
            self.geometry.planar.sin_elbow(theta_3) < 0.0 && !met.contains(SingularityKind::ELBOW);
        Some(Slot::of_bits([towards, behind, backwards]))
    }

    fn end_frames(&self) -> Option<&EndFrames> {
        Some(&self.end_frames)
    }

    #[cfg(test)]
    fn without_lanes(&self) -> Arc<dyn Inverse<5>> {
        Arc::new(self.clone())
    }
}
