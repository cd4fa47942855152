//! Proves that no joint vector of a pose is nearer to the seed than the best one found.
//!
//! Docs: spherical_shoulder.md, eq. 75 to 77.

use nalgebra::SMatrix;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use super::free_joints::in_metric;
use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::solve::self_motion_curve::Joints;

/// Part of the square of a distance that is left for a slope and for rounding [1].
const SPARE: f64 = 1e-2;

/// By how much another joint vector may be nearer than the best, relative to its cost [1].
const LEVEL: f64 = 1e-12;

impl Search<'_> {
    /// Whether nothing that meets the pose is nearer to the seed than the best joint vector, on any
    /// branch and at any turn: it is the bottom of its valley, and in the ball around the seed
    /// through it the pose bends less than the ball (eq. 77).
    pub(super) fn is_proven_nearest(&self) -> bool {
        let Some((cost, q)) = self.best else { return false };
        if cost == 0.0 {
            return true;
        }
        let roots = Joints::from(self.weights.map(f64::sqrt));
        let way = (Joints::from(q) - Joints::from(self.seed)).component_mul(&roots);
        let velocities = self.velocities(&q, &roots);
        let Some(square) = (velocities * velocities.transpose()).cholesky() else { return false };
        let force = square.solve(&(velocities * way));
        let slope = way - velocities.transpose() * force;

        let [push, turn] = [0, 3].map(|row| force.fixed_rows::<3>(row).into_owned());
        let moved = |joint| velocities.fixed_view::<3, 1>(0, joint).into_owned();
        let axis = |joint| velocities.fixed_view::<3, 1>(3, joint).into_owned();
        let mut form = SMatrix::<f64, 7, 7>::identity();
        let mut thirds = 0.0;
        for [i, j] in (0..7).flat_map(|i| (i..7).map(move |j| [i, j])) {
            let carried = axis(i).cross(&axis(j));
            form[(i, j)] -= push.dot(&axis(i).cross(&moved(j))) + 0.5 * turn.dot(&carried);
            form[(j, i)] = form[(i, j)];
            for k in j..7 {
                let of_turn = turn.dot(&axis(k)) * axis(i).dot(&axis(j))
                    + turn.dot(&axis(i)) * axis(j).dot(&axis(k));
                let third = push.dot(&axis(i).cross(&axis(j).cross(&moved(k)))) - 0.5 * of_turn;
                thirds += orders([i, j, k]) * third * third;
            }
        }
        let [by_length, by_angle] = self.fourth_derivatives();
        let fourth = push.norm() * by_length + turn.norm() * by_angle;
        let rest = 2.0 / 3.0 * (cost * thirds).sqrt() + cost * fourth / 3.0;
        form -= SMatrix::identity() * (SPARE + rest);
        form.cholesky().is_some() && slope.norm_squared() <= LEVEL * cost
    }

    /// How the origin of the last link moves and turns with each joint, in the metric of the
    /// weights.
    fn velocities(&self, q: &[f64; 7], roots: &Joints) -> SMatrix<f64, 6, 7> {
        let (frames, tool) = self.robot.link_frames(q);
        let from_tool = frames[6].translation.vector - tool.translation.vector;
        let mut velocities = self.robot.jacobian(q, JacobianFrame::Base);
        for mut column in velocities.column_iter_mut() {
            let around = column.fixed_rows::<3>(3).cross(&from_tool);
            let mut moved = column.fixed_rows_mut::<3>(0);
            moved += around;
        }
        in_metric(velocities, roots)
    }

    /// Bounds of the fourth derivatives of the origin of the last link and of its rotation, along
    /// any line of joint vectors, in the metric of the weights (eq. 76).
    fn fourth_derivatives(&self) -> [f64; 2] {
        let rows = &self.robot.mdh().rows;
        let mut reach = 0.0_f64;
        let mut of_origin = 0.0;
        let mut of_rotation = 0.0;
        for joint in (0..7).rev() {
            of_origin += reach.sqrt() / self.weights[joint];
            of_rotation += 1.0 / self.weights[joint];
            reach += rows[joint].a.hypot(rows[joint].d);
        }
        [of_origin * of_origin, of_rotation * of_rotation]
    }
}

/// The number of orders of three joints, of which some may be equal.
fn orders([i, j, k]: [usize; 3]) -> f64 {
    match (i == j, j == k) {
        (false, false) => 6.0,
        (true, true) => 1.0,
        _ => 3.0,
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use crate::kinematics::robot::Robot;

    #[test]
    fn the_whole_search_finds_nothing_nearer_than_what_is_proven() {
        let mut state = 7_u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let high = u32::try_from(state >> 33).unwrap();
            f64::from(high) / f64::from(1_u32 << 30) - 1.0
        };
        for name in ["Panda", "IRB 14000-0.5/0.5 (left)"] {
            let robot = Robot::<7>::named(name).unwrap();
            let limits = robot.limits().to_array();
            for (case, least) in [(0.005, 50), (0.02, 30), (0.05, 5), (0.15, 0), (PI, 0)] {
                let mut proven = 0;
                for number in 0..60 {
                    let middle = limits.map(|[low, high]| 0.5 * (low + high));
                    let q = core::array::from_fn(|joint| {
                        middle[joint] + 0.45 * (limits[joint][1] - limits[joint][0]) * random()
                    });
                    let seed = q.map(|angle: f64| angle + case * random());
                    let weights =
                        if number % 2 == 0 { [1.0; 7] } else { [1., 2., 3., 4., 5., 6., 7.] };
                    let pose = robot.fk(&q);
                    let mut search = robot.search(&pose, &seed, &weights, &|_| true).unwrap();
                    search.begin();
                    if !search.is_proven_nearest() {
                        continue;
                    }
                    proven += 1;
                    let (cost, _) = search.best.unwrap();
                    search.look_everywhere().unwrap();
                    let (least, q) = search.best.unwrap();
                    // Both meet the pose up to rounding, which moves a bottom by some 1e-13.
                    let rounding = 1e-9 * cost + 1e-12;
                    assert!(least >= cost - rounding, "{name}: {q:?} {least} {cost}");
                }
                std::println!("{name}: seeds up to {case} rad off: {proven} of 60 proven");
                assert!(proven >= least, "{name}, {case}: {proven}");
            }
        }
    }
}
