//! Newton's method on the closure, for eight candidates at once.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::chain::{Closure, Conditions, Target, largest};
#[cfg(test)]
use crate::lanes::sin_cos;
use crate::lanes::{Column, LANES, mul_add};

/// Sizes of the step after which a candidate has converged [rad]: the next would be its square.
const CONVERGED: f64 = 1e-8;

/// Largest step [rad]: the series of a turn is then good to 1e-9, and the method is far from its
/// goal.
const MOST_STEP: f64 = 0.3;

/// Steps at most. Candidates are within 1e-3 rad of a solution, from where three are enough; more
/// are left to those that are not.
const MOST_STEPS: usize = 6;

/// Joint angles of eight candidates, and how well they close.
#[derive(Clone, Copy)]
pub(crate) struct Candidates {
    pub(crate) sin: [Column; 6],
    pub(crate) cos: [Column; 6],
    /// The largest of the six conditions that is left [1].
    pub(crate) residual: Column,
    /// The least singular value of the conditions' derivatives, to a small factor [1].
    pub(crate) least: Column,
}

impl Candidates {
    pub(crate) const NEW: Self = Self {
        sin: [[0.0; LANES]; 6],
        cos: [[1.0; LANES]; 6],
        residual: [1.0; LANES],
        least: [0.0; LANES],
    };

    /// Take the angles of others in the lanes where they close better.
    #[inline(always)]
    fn keep(&mut self, other: &Self, residual: &Column) {
        for lane in 0..LANES {
            let is_better = residual[lane] < self.residual[lane];
            self.residual[lane] = if is_better { residual[lane] } else { self.residual[lane] };
            for joint in 0..6 {
                let (sin, cos) = (self.sin[joint][lane], self.cos[joint][lane]);
                self.sin[joint][lane] = if is_better { other.sin[joint][lane] } else { sin };
                self.cos[joint][lane] = if is_better { other.cos[joint][lane] } else { cos };
            }
        }
    }

    /// Take these angles [rad] in a lane.
    #[cfg(test)]
    pub(crate) fn put(&mut self, lane: usize, theta: &[f64; 6]) {
        for joint in 0..6 {
            (self.sin[joint][lane], self.cos[joint][lane]) = sin_cos::<false>(theta[joint]);
        }
    }
}

impl Closure {
    /// Bring candidates to the target (eq. 98). One that does not converge keeps its last angles.
    #[inline(always)]
    pub(crate) fn converge<const FUSED: bool>(&self, target: &Target, on: &mut Candidates) {
        let mut is_moving = [true; LANES];
        let mut best = Candidates { residual: [f64::INFINITY; LANES], ..*on };
        for _ in 0..MOST_STEPS {
            let conditions = self.conditions::<LANES, FUSED>(target, &on.sin, &on.cos);
            best.keep(on, &largest(&conditions.missing));
            let triangle = Triangle::of::<FUSED>(&conditions);
            let step = triangle.step::<FUSED>();
            let size = largest(&step);
            let least = triangle.least::<FUSED>();
            let mut moving = 0;
            for lane in 0..LANES {
                on.least[lane] = if is_moving[lane] { least[lane] } else { on.least[lane] };
                // A singular candidate stays where it is.
                is_moving[lane] &= size[lane] < f64::INFINITY;
                let part = MOST_STEP / size[lane];
                let part = if part < 1.0 { part } else { 1.0 };
                for joint in 0..6 {
                    let (s, c) = (on.sin[joint][lane], on.cos[joint][lane]);
                    let turn = if is_moving[lane] { part * step[joint][lane] } else { 0.0 };
                    (on.sin[joint][lane], on.cos[joint][lane]) = turned::<FUSED>(s, c, turn);
                }
                is_moving[lane] &= size[lane] > CONVERGED;
                moving |= u64::from(is_moving[lane]);
            }
            if moving == 0 {
                break;
            }
        }
        on.residual = largest(&self.missing::<LANES, FUSED>(target, &on.sin, &on.cos));
        // One that wanders about a singularity returns to where it closed best.
        for lane in 0..LANES {
            let last = on.residual[lane];
            let is_better = (last > 2.0 * best.residual[lane]) | last.is_nan();
            for joint in 0..6 {
                let better = [best.sin[joint][lane], best.cos[joint][lane]];
                let last = [on.sin[joint][lane], on.cos[joint][lane]];
                [on.sin[joint][lane], on.cos[joint][lane]] = if is_better { better } else { last };
            }
            let better = best.residual[lane];
            on.residual[lane] = if is_better { better } else { on.residual[lane] };
        }
    }
}

/// Sine and cosine of an angle after a small turn.
#[inline(always)]
fn turned<const FUSED: bool>(s: f64, c: f64, turn: f64) -> (f64, f64) {
    let z = turn * turn;
    let sin = mul_add::<FUSED>(z, mul_add::<FUSED>(z, 1.0 / 120.0, -1.0 / 6.0), 1.0) * turn;
    let cos = mul_add::<FUSED>(z, mul_add::<FUSED>(z, 1.0 / 24.0, -0.5), 1.0);
    let (s, c) = (mul_add::<FUSED>(s, cos, c * sin), mul_add::<FUSED>(c, cos, -(s * sin)));
    // Back to a unit vector.
    let factor = mul_add::<FUSED>(-0.5, mul_add::<FUSED>(s, s, c * c), 1.5);
    (s * factor, c * factor)
}

/// The triangle that reflections make of the derivatives, and the conditions with it.
struct Triangle {
    /// By column and row; below the diagonal is what is left of the reflections.
    columns: [[Column; 6]; 6],
    right: [Column; 6],
    /// Inverses of the diagonal.
    inverse: [Column; 6],
}

impl Triangle {
    /// Householder's reflections, a column after the other.
    #[inline(always)]
    fn of<const FUSED: bool>(conditions: &Conditions<LANES>) -> Self {
        let Conditions { missing: mut right, mut columns } = *conditions;
        let mut inverse = [[0.0; LANES]; 6];
        for k in 0..6 {
            let (done, rest) = columns.split_at_mut(k + 1);
            let mirror = &mut done[k];
            let mut square = [0.0; LANES];
            for row in k..6 {
                for lane in 0..LANES {
                    square[lane] =
                        mul_add::<FUSED>(mirror[row][lane], mirror[row][lane], square[lane]);
                }
            }
            let (mut scale, mut diagonal) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                let length = square[lane].sqrt();
                let first = mirror[k][lane];
                scale[lane] = -1.0 / (length * (length + first.abs()));
                diagonal[lane] = -length.copysign(first);
                inverse[k][lane] = 1.0 / diagonal[lane];
                mirror[k][lane] = first - diagonal[lane];
            }
            for column in rest.iter_mut().chain([&mut right]) {
                let mut dot = [0.0; LANES];
                for row in k..6 {
                    for lane in 0..LANES {
                        dot[lane] =
                            mul_add::<FUSED>(mirror[row][lane], column[row][lane], dot[lane]);
                    }
                }
                for lane in 0..LANES {
                    dot[lane] *= scale[lane];
                }
                for row in k..6 {
                    for lane in 0..LANES {
                        column[row][lane] =
                            mul_add::<FUSED>(mirror[row][lane], dot[lane], column[row][lane]);
                    }
                }
            }
        }
        Self { columns, right, inverse }
    }

    /// The joint step.
    #[inline(always)]
    fn step<const FUSED: bool>(&self) -> [Column; 6] {
        self.back::<FUSED>(self.right)
    }

    /// The solution for a right side.
    #[inline(always)]
    fn back<const FUSED: bool>(&self, mut right: [Column; 6]) -> [Column; 6] {
        for k in (0..6).rev() {
            for lane in 0..LANES {
                right[k][lane] *= self.inverse[k][lane];
            }
            for row in 0..k {
                for lane in 0..LANES {
                    right[row][lane] = mul_add::<FUSED>(
                        -self.columns[k][row][lane],
                        right[k][lane],
                        right[row][lane],
                    );
                }
            }
        }
        right
    }

    /// The least singular value to a small factor: `|y| / |x|` for `R^T y = +-1`, with the signs
    /// for which y grows, and `R x = y`. Reference: Cline, Moler, Stewart and Wilkinson, An
    /// estimate for the condition number of a matrix, SIAM J. Numer. Anal. 16, 1979.
    #[inline(always)]
    fn least<const FUSED: bool>(&self) -> Column {
        let mut y = [[0.0; LANES]; 6];
        for k in 0..6 {
            let mut sum = [0.0; LANES];
            for row in 0..k {
                for lane in 0..LANES {
                    sum[lane] =
                        mul_add::<FUSED>(-self.columns[k][row][lane], y[row][lane], sum[lane]);
                }
            }
            for lane in 0..LANES {
                let grown = sum[lane] + 1.0_f64.copysign(sum[lane]);
                y[k][lane] = grown * self.inverse[k][lane];
            }
        }
        let x = self.back::<FUSED>(y);
        let mut least = [0.0; LANES];
        for lane in 0..LANES {
            let (mut of_y, mut of_x) = (0.0, 0.0);
            for k in 0..6 {
                of_y = mul_add::<FUSED>(y[k][lane], y[k][lane], of_y);
                of_x = mul_add::<FUSED>(x[k][lane], x[k][lane], of_x);
            }
            let ratio = (of_y / of_x).sqrt();
            // Infinite or not a number: singular.
            least[lane] = if ratio > 0.0 { ratio } else { 0.0 };
        }
        least
    }
}
