//! The geometric Jacobian of a chain.

use nalgebra::{SMatrix, Vector3};

use super::chain::Chain;

/// The frame in which a Jacobian's rows are expressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JacobianFrame {
    /// The frame in which poses are given.
    #[default]
    Base,
    /// The tool's own frame.
    Tool,
}

impl<const N: usize> Chain<N> {
    /// Geometric Jacobian of the tool.
    ///
    /// Three linear rows [m/rad], then three angular [1]; column `i` belongs to joint `i + 1`. Column `i` is `z_i x (p_tool - p_i)` over
    /// `z_i`, with axis and origin of frame `i` itself: in a modified table a joint turns about its own frame's z, in a standard one
    /// about the frame's before it.
    /// Reference: Siciliano et al., Robotics, 2009, eq. 3.30, with the modified-DH index shift of docs/conventions.md.
    #[must_use]
    pub fn jacobian(&self, q: &[f64; N], frame: JacobianFrame) -> SMatrix<f64, 6, N> {
        let (frames, t_world_tool) = self.frames(q);
        let mut jacobian = SMatrix::<f64, 6, N>::zeros();
        for (i, link) in frames.iter().enumerate() {
            let lever: Vector3<f64> = t_world_tool.translation.vector - link.origin;
            let (mut linear, mut angular) = (link.z.cross(&lever), link.z);
            if frame == JacobianFrame::Tool {
                linear = t_world_tool.rotation.inverse_transform_vector(&linear);
                angular = t_world_tool.rotation.inverse_transform_vector(&angular);
            }
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&linear);
            jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&angular);
        }
        jacobian
    }
}
