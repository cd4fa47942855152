//! A serial chain of revolute joints.

pub(crate) mod axes;
pub(crate) mod corrections;
pub(crate) mod coupling;
pub(crate) mod dh;
pub(crate) mod forward;
pub(crate) mod jacobian;
pub(crate) mod joint_axes;
pub(crate) mod limits;
pub(crate) mod singular_values;
pub(crate) mod skew;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::chain::axes::Link;
use crate::kinematics::chain::coupling::uncoupled;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::skew::{TiltedRow, tilted_rows};
use crate::kinematics::pose::Pose;
use crate::kinematics::thresholds::HEADING_TOLERANCE;

/// `N` revolute joints between a base and a tool, described by a modified Denavit-Hartenberg table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain<const N: usize> {
    mdh: Mdh<N>,
    t_world_base: Pose,
    t_flange_tool: Pose,
    /// Without common normals that are far away.
    links: [Link; N],
    /// Sine and cosine of Hayati's rotation in each link, if there is one.
    tilts: Option<[(f64, f64); N]>,
    /// Factor of q2 in the controller's q3: 1, -1 or, without a coupling, zero.
    coupling: f64,
    /// How far a pose may be turned about axis 1 for an arm of five axes to reach it [rad].
    heading_tolerance: f64,
    t_world_first: Pose,
    t_last_tool: Pose,
}

impl<const N: usize> Chain<N> {
    /// A chain with its base at the origin and its tool at the flange.
    #[must_use]
    pub(crate) fn new(mdh: Mdh<N>) -> Self {
        let rows = tilted_rows(&mdh.rows);
        let is_tilted = rows.iter().any(|row| row.beta != 0.0);
        let links = rows.map(|TiltedRow { row, .. }| Link::new(row));
        let tilts = is_tilted.then(|| rows.map(|TiltedRow { beta, .. }| beta.sin_cos()));
        let mut chain = Self {
            mdh,
            t_world_base: Pose::identity(),
            t_flange_tool: Pose::identity(),
            links,
            tilts,
            coupling: 0.0,
            heading_tolerance: HEADING_TOLERANCE,
            t_world_first: Pose::identity(),
            t_last_tool: Pose::identity(),
        };
        chain.join();
        chain
    }

    /// Return the chain with its base at `t_world_base`; poses and Jacobians are then in the world
    /// frame.
    #[must_use]
    pub(crate) fn with_base(mut self, t_world_base: Pose) -> Self {
        self.t_world_base = t_world_base;
        self.join();
        self
    }

    /// Return the chain with its tool center point at `t_flange_tool`.
    #[must_use]
    pub(crate) fn with_tool(mut self, t_flange_tool: Pose) -> Self {
        self.t_flange_tool = t_flange_tool;
        self.join();
        self
    }

    /// Return the chain with the joint angles of a controller that adds q2 by a factor to joint 3, or
    /// with the angles of the serial chain.
    #[must_use]
    pub(crate) fn with_coupling(mut self, coupling: f64) -> Self {
        self.coupling = coupling;
        self
    }

    #[must_use]
    pub(crate) fn with_heading_tolerance(mut self, tolerance: f64) -> Self {
        self.heading_tolerance = tolerance;
        self
    }

    fn join(&mut self) {
        self.t_world_first = self.t_world_base * self.mdh.base;
        self.t_last_tool = self.mdh.flange * self.t_flange_tool;
    }

    /// The modified Denavit-Hartenberg table with its fixed end transforms.
    #[must_use]
    pub(crate) fn mdh(&self) -> &Mdh<N> {
        &self.mdh
    }

    /// The base in the world.
    #[must_use]
    pub(crate) fn base(&self) -> &Pose {
        &self.t_world_base
    }

    /// The tool in the flange frame.
    #[must_use]
    pub(crate) fn tool(&self) -> &Pose {
        &self.t_flange_tool
    }

    /// Factor of q2 in the controller's q3: 1, -1 or, without a coupling, zero.
    #[must_use]
    pub(crate) fn coupling(&self) -> f64 {
        self.coupling
    }

    pub(crate) fn heading_tolerance(&self) -> f64 {
        self.heading_tolerance
    }

    /// The table's joint angles.
    #[inline(always)]
    pub(in crate::kinematics) fn uncoupled(&self, q: &[f64; N]) -> [f64; N] {
        uncoupled(*q, self.coupling)
    }

    /// The links of the table: they differ from those that lead to the tool if the table has a
    /// common normal that is far away.
    pub(in crate::kinematics) fn table_links(&self) -> [Link; N] {
        if self.tilts.is_some() { self.mdh.rows.map(Link::new) } else { self.links }
    }

    /// The links that lead to the tool.
    pub(in crate::kinematics) fn links(&self) -> &[Link; N] {
        &self.links
    }

    /// Sine and cosine of Hayati's rotation in each link, if there is one.
    pub(in crate::kinematics) fn tilts(&self) -> Option<&[(f64, f64); N]> {
        self.tilts.as_ref()
    }

    /// The transform before the first link.
    pub(in crate::kinematics) fn first(&self) -> &Pose {
        &self.t_world_first
    }

    /// The transform after the last link.
    pub(in crate::kinematics) fn last(&self) -> &Pose {
        &self.t_last_tool
    }
}
