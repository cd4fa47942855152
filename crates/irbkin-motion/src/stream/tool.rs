//! The speed of the tool ahead (docs/theory/stream.md, eq. 13).

use nalgebra::SVector;

use super::ahead::Ahead;
use super::brake::Bounds;
use irbkin::internal::lanes::LANES;
use irbkin::{JacobianFrame, Robot};

/// Parts of the motion ahead that are looked at, at most [1].
const MOST_PARTS: usize = 64;

/// A bound of the speed of the tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct ToolSpeed<const N: usize> {
    /// The bound [m/s].
    limit: f64,
    /// How far the tool is from each axis at most [m].
    reach: [f64; N],
}

impl<const N: usize> ToolSpeed<N> {
    pub(super) fn new(robot: &Robot<N>, limit: f64) -> Self {
        let (mdh, mut reach) = (robot.mdh(), [0.0; N]);
        let mut behind =
            mdh.flange.translation.vector.norm() + robot.tool().translation.vector.norm();
        for joint in (0..N).rev() {
            reach[joint] = behind + mdh.rows[joint].d.abs();
            behind = reach[joint] + mdh.rows[joint].a.abs();
        }
        Self { limit, reach }
    }

    /// The bound that is exceeded, or not proven to be kept, and the limit [m/s].
    pub(super) fn check(
        &self,
        robot: &Robot<N>,
        ahead: &Ahead<N>,
        bounds: &[Bounds; N],
        cycle: f64,
    ) -> Result<(), (f64, f64)> {
        let mut parts = [[0.0; 2]; 2 * LANES];
        parts[..LANES].copy_from_slice(&ahead.parts(LANES));
        let mut left = LANES;
        for _ in 0..MOST_PARTS {
            let Some(last) = left.checked_sub(1) else { return Ok(()) };
            let [from, to] = parts[last];
            let most = self.most(robot, ahead, bounds, [from, to]) / cycle;
            left = last;
            if most <= self.limit {
                continue;
            }
            // Even half a cycle is not proven.
            if left + 2 > parts.len() || to - from < 0.5 {
                return Err((most, self.limit));
            }
            let middle = 0.5 * (from + to);
            (parts[left], parts[left + 1]) = ([from, middle], [middle, to]);
            left += 2;
        }
        Err((self.limit, self.limit))
    }

    /// A bound of the way of the tool in a cycle, anywhere in a part: at the joint angles and the
    /// velocities in its middle, and by how much both change.
    fn most(
        &self,
        robot: &Robot<N>,
        ahead: &Ahead<N>,
        bounds: &[Bounds; N],
        [from, to]: [f64; 2],
    ) -> f64 {
        let (q, spans) = ahead.range([from, to]);
        let (pace, half) = (ahead.pace(0.5 * (from + to)), 0.5 * (to - from));
        let jacobian = robot.jacobian(&q, JacobianFrame::Base);
        let way = jacobian.fixed_rows::<3>(0) * SVector::from(pace);
        let changes = robot.table_spans(core::array::from_fn(|joint| half * bounds[joint].second));
        let paces = robot.table_spans(pace.map(f64::abs));
        let spans = robot.table_spans(spans);
        let mut most = way.norm();
        for joint in 0..N {
            most += self.reach[joint] * changes[joint];
            let turned = spans.iter().zip(&self.reach);
            let turned =
                turned.map(|(span, reach)| span * reach.min(self.reach[joint])).sum::<f64>();
            most += (paces[joint] + changes[joint]) * turned;
        }
        most
    }
}
