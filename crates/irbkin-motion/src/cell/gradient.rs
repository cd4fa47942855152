//! How a distance changes with the joints.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use nalgebra::Vector3;

use super::postures::{Near, Nearest};
use irbkin::Robot;

impl Nearest {
    /// How the distance changes with each joint [m/rad], at the joint angles that it was found at:
    /// the speed at which the two points come apart along the line between them. NaN where they are
    /// one point, and of an axis inside a solid, whose nearest point on the surface is not known.
    #[must_use]
    pub fn gradient<const N: usize>(&self, robot: &Robot<N>, q: &[f64; N]) -> [f64; N] {
        let [own, other] = self.points.map(Vector3::from);
        let direction = (other - own) / (self.distance.signum() * (other - own).norm());
        let frames = robot.link_frames(q).0;
        // A link turns with the joints up to its own; what the flange carries with all.
        let turned = |link: usize, point: &Vector3<f64>| -> [f64; N] {
            core::array::from_fn(|joint| {
                if joint >= link {
                    return 0.0;
                }
                let frame = &frames[joint];
                let axis = frame.rotation * Vector3::z();
                direction.dot(&axis.cross(&(point - frame.translation.vector)))
            })
        };
        let away = turned(self.link, &own);
        let after = match self.near {
            Near::Link(link) => turned(link, &other),
            Near::Obstacle(_) => [0.0; N],
        };
        robot.by_controller(core::array::from_fn(|joint| after[joint] - away[joint]))
    }
}
