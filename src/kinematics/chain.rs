//! A serial chain of revolute joints: forward kinematics and link frames.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::angles::constant_sin_cos;
use super::dh::{DhRow, Mdh};
use super::pose::Pose;

/// `N` revolute joints between a base and a tool, described by a modified Denavit-Hartenberg table.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain<const N: usize> {
    mdh: Mdh<N>,
    t_world_base: Pose,
    t_flange_tool: Pose,
    links: [Link; N],
    t_world_first: Pose,
    t_last_tool: Pose,
}

/// The constants of one row, with the sines taken once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Link {
    sin_alpha: f64,
    cos_alpha: f64,
    a: f64,
    d: f64,
    sin_theta: f64,
    cos_theta: f64,
}

impl Link {
    fn new(row: DhRow) -> Self {
        let (sin_alpha, cos_alpha) = constant_sin_cos(row.alpha);
        let (sin_theta, cos_theta) = constant_sin_cos(row.theta);
        Self { sin_alpha, cos_alpha, a: row.a, d: row.d, sin_theta, cos_theta }
    }
}

/// A frame as its three axes and its origin: what a product of link transforms updates a column at a time.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) x: Vector3<f64>,
    pub(crate) y: Vector3<f64>,
    pub(crate) z: Vector3<f64>,
    pub(crate) origin: Vector3<f64>,
}

impl Frame {
    fn of(pose: &Pose) -> Self {
        let axes = pose.rotation.matrix();
        Self { x: axes.column(0).into(), y: axes.column(1).into(), z: axes.column(2).into(), origin: pose.translation.vector }
    }

    fn pose(&self) -> Pose {
        let axes = Matrix3::from_columns(&[self.x, self.y, self.z]);
        IsometryMatrix3::from_parts(Translation3::from(self.origin), Rotation3::from_matrix_unchecked(axes))
    }

    /// This frame times `Rx(alpha) Tx(a) Rz(theta + q) Tz(d)`.
    fn after(&self, link: &Link, q: f64) -> Self {
        let (sin_q, cos_q) = q.sin_cos();
        let sin = sin_q * link.cos_theta + cos_q * link.sin_theta;
        let cos = cos_q * link.cos_theta - sin_q * link.sin_theta;
        let y = self.y * link.cos_alpha + self.z * link.sin_alpha;
        let z = self.z * link.cos_alpha - self.y * link.sin_alpha;
        Self { x: self.x * cos + y * sin, y: y * cos - self.x * sin, z, origin: self.origin + self.x * link.a + z * link.d }
    }
}

impl<const N: usize> Chain<N> {
    /// A chain with its base at the origin and its tool at the flange.
    #[must_use]
    pub fn new(mdh: Mdh<N>) -> Self {
        let links = mdh.rows.map(Link::new);
        let mut chain = Self {
            mdh,
            t_world_base: Pose::identity(),
            t_flange_tool: Pose::identity(),
            links,
            t_world_first: Pose::identity(),
            t_last_tool: Pose::identity(),
        };
        chain.join();
        chain
    }

    /// The same chain standing at `t_world_base`; poses and Jacobians are then in the world frame.
    #[must_use]
    pub fn with_base(mut self, t_world_base: Pose) -> Self {
        self.t_world_base = t_world_base;
        self.join();
        self
    }

    /// The same chain carrying a tool whose centre point stands at `t_flange_tool`.
    #[must_use]
    pub fn with_tool(mut self, t_flange_tool: Pose) -> Self {
        self.t_flange_tool = t_flange_tool;
        self.join();
        self
    }

    fn join(&mut self) {
        self.t_world_first = self.t_world_base * self.mdh.base;
        self.t_last_tool = self.mdh.flange * self.t_flange_tool;
    }

    /// The modified Denavit-Hartenberg table with its fixed end transforms.
    #[must_use]
    pub fn mdh(&self) -> &Mdh<N> {
        &self.mdh
    }

    /// The base in the world.
    #[must_use]
    pub fn base(&self) -> &Pose {
        &self.t_world_base
    }

    /// The tool in the flange frame.
    #[must_use]
    pub fn tool(&self) -> &Pose {
        &self.t_flange_tool
    }

    /// Pose of the tool for the joint angles `q` [rad].
    #[must_use]
    pub fn fk(&self, q: &[f64; N]) -> Pose {
        let mut frame = Frame::of(&self.t_world_first);
        for (link, angle) in self.links.iter().zip(q) {
            frame = frame.after(link, *angle);
        }
        frame.pose() * self.t_last_tool
    }

    /// Frame `i` of the modified table after joint `i + 1`, for each joint, and the pose of the tool.
    #[must_use]
    pub fn link_frames(&self, q: &[f64; N]) -> ([Pose; N], Pose) {
        let (frames, tool) = self.frames(q);
        (frames.map(|frame| frame.pose()), tool)
    }

    pub(crate) fn frames(&self, q: &[f64; N]) -> ([Frame; N], Pose) {
        let mut frame = Frame::of(&self.t_world_first);
        let mut frames = [frame; N];
        for ((slot, link), angle) in frames.iter_mut().zip(&self.links).zip(q) {
            frame = frame.after(link, *angle);
            *slot = frame;
        }
        (frames, frame.pose() * self.t_last_tool)
    }
}
