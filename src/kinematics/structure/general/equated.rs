//! The equations at angles of the searched joint, of one pose or of several.

use fearless_simd::prelude::*;

use super::split::Equations;
use crate::kinematics::structure::closure::Six;
use crate::lanes::{LANES, Number as _, Vector, transposed};

/// The equations of the pose of all lanes, or of one in each.
pub(super) enum Equated<'a> {
    One(&'a Equations),
    Each([&'a Equations; LANES]),
}

impl Equated<'_> {
    /// The equations at angles t5 with these sines and cosines: by powers of x3 and x4, and rows.
    #[inline(always)]
    pub(super) fn at<S: Simd>(&self, sin: Vector<S>, cos: Vector<S>) -> [Six<S>; 9] {
        let mut at = [[sin.like(0.0); 6]; 9];
        match self {
            Self::One(all) => {
                for product in 0..9 {
                    let [constant, of_cos, of_sin] =
                        [&all[product], &all[9 + product], &all[18 + product]];
                    for row in 0..6 {
                        let along = cos.scaled_plus(of_cos[row], sin.like(constant[row]));
                        at[product][row] = sin.scaled_plus(of_sin[row], along);
                    }
                }
            }
            Self::Each(each) => {
                let simd = sin.token();
                let mut rows = [[[0.0; LANES]; LANES]; 9];
                for lane in 0..LANES {
                    let (all, sin, cos) = (each[lane], sin.like(sin[lane]), sin.like(cos[lane]));
                    for product in 0..9 {
                        let constant = Vector::load_array_ref(simd, &all[product]);
                        let of_cos = Vector::load_array_ref(simd, &all[9 + product]);
                        let of_sin = Vector::load_array_ref(simd, &all[18 + product]);
                        let along = cos.times_plus(of_cos, constant);
                        rows[product][lane] = sin.times_plus(of_sin, along).to_array();
                    }
                }
                for product in 0..9 {
                    let columns = transposed(simd, &rows[product].each_ref());
                    at[product].copy_from_slice(&columns[..6]);
                }
            }
        }
        at
    }
}
