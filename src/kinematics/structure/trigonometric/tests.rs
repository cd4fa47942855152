//! Laws of the roots: all of them, no others, and what noise leaves of them.
#![expect(clippy::cast_precision_loss, reason = "numbers up to 24")]

use core::f64::consts::{PI, TAU};
use std::vec::Vec;

use fearless_simd::prelude::*;

use super::arcs::ARCS_OF;
use super::part::{angle, middle};
use super::roots::Roots;
use super::tables::{ARCS, POWERS, QUARTERS};
use super::*;
use crate::lanes::{Column, InstructionSet, LANES, Vector, VectorKernel, run_on, run_vectors};
use crate::rng::Rng;

/// The polynomial with these real roots and pairs of complex ones, of size 1, sampled: each factor
/// is `sin((x - root) / 2)`, two of which are of degree 1.
fn samples(roots: &[f64], complex: &[(f64, f64)]) -> [Column; 3] {
    let value = |x: f64| {
        let real: f64 = roots.iter().map(|root| ((x - root) / 2.0).sin()).product();
        let pairs: f64 = complex.iter().map(|(at, gap)| gap.cosh() - (x - at).cos()).product();
        real * pairs
    };
    let all: Vec<f64> = (0..SAMPLES).map(|j| value(TAU * j as f64 / 24.0)).collect();
    let size = all.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    core::array::from_fn(|c| core::array::from_fn(|lane| all[LANES * c + lane] / size))
}

/// The polynomial through samples.
struct OfSamples<'a>(&'a [Column; 3]);

impl VectorKernel for OfSamples<'_> {
    type Answer = TrigonometricPolynomial;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> TrigonometricPolynomial {
        let mut samples = [Vector::splat(simd, 0.0); 3];
        for block in 0..3 {
            samples[block] = Vector::load_array_ref(simd, &self.0[block]);
        }
        TrigonometricPolynomial::of_samples(&samples)
    }
}

fn of_samples(samples: &[Column; 3]) -> TrigonometricPolynomial {
    run_vectors(OfSamples(samples))
}

struct RootsOf<'a>(&'a TrigonometricPolynomial);

impl VectorKernel for RootsOf<'_> {
    type Answer = Roots;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Roots {
        self.0.roots(simd, NARROW)
    }
}

impl TrigonometricPolynomial {
    fn all_roots(&self) -> Roots {
        run_vectors(RootsOf(self))
    }
}

impl Roots {
    /// Return the number of roots if all are simple.
    fn count_if_simple(&self) -> Option<usize> {
        let are_simple = self.as_slice().iter().all(|root| root.is_simple);
        (self.is_complete && are_simple).then_some(self.as_slice().len())
    }
}

fn polynomial(roots: &[f64], complex: &[(f64, f64)]) -> TrigonometricPolynomial {
    assert_eq!(roots.len() + 2 * complex.len(), 16);
    of_samples(&samples(roots, complex))
}

/// Distance of two angles on the circle.
fn apart(a: f64, b: f64) -> f64 {
    let turn = (a - b).rem_euclid(TAU);
    turn.min(TAU - turn)
}

/// `count` real roots no nearer to one another than `gap`.
fn separate(rng: &mut Rng, count: usize, gap: f64) -> Vec<f64> {
    let mut roots: Vec<f64> = Vec::new();
    while roots.len() < count {
        let root = rng.angle();
        if roots.iter().all(|other| apart(*other, root) > gap) {
            roots.push(root);
        }
    }
    roots
}

fn pairs(rng: &mut Rng, count: usize) -> Vec<(f64, f64)> {
    (0..count).map(|_| (rng.angle(), rng.between(0.02, 2.0))).collect()
}

#[test]
fn values_are_those_of_the_samples() {
    let mut rng = Rng::new(1);
    for _ in 0..200 {
        let (roots, complex) = (separate(&mut rng, 8, 0.01), pairs(&mut rng, 4));
        let samples = samples(&roots, &complex);
        let polynomial = of_samples(&samples);
        assert!(polynomial.noise < 1e-13, "{}", polynomial.noise);
        for c in 0..3 {
            for lane in 0..LANES {
                let [value, slope, second] =
                    polynomial.values(SAMPLE_SIN[c][lane], SAMPLE_COS[c][lane]);
                assert!((value - samples[c][lane]).abs() < 1e-14);
                let x = TAU * (LANES * c + lane) as f64 / 24.0;
                let step = 1e-5;
                let [a, b] = [x - step, x + step].map(|x| polynomial.values(x.sin(), x.cos()));
                assert!((slope - (b[0] - a[0]) / (2.0 * step)).abs() < 1e-8);
                assert!((second - (b[1] - a[1]) / (2.0 * step)).abs() < 1e-7);
            }
        }
    }
}

/// The polynomial on all arcs, by arc and coefficient.
struct OnArcs<'a>(&'a TrigonometricPolynomial);

impl VectorKernel for OnArcs<'_> {
    type Answer = [[f64; POWERS + 1]; ARCS];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [[f64; POWERS + 1]; ARCS] {
        let mut all = [[0.0; POWERS + 1]; ARCS];
        let mut quarters = [[Vector::splat(simd, 0.0); POWERS + 1]; QUARTERS];
        self.0.on_arcs(simd, &mut quarters);
        for (columns, arcs) in quarters.iter().zip(ARCS_OF) {
            for (lane, arc) in arcs.into_iter().enumerate() {
                for j in 0..=POWERS {
                    all[arc][j] = columns[j][lane];
                }
            }
        }
        all
    }
}

#[test]
fn on_each_arc_it_is_what_its_coefficients_make() {
    let mut rng = Rng::new(8);
    for _ in 0..200 {
        let (roots, complex) = (separate(&mut rng, 8, 0.01), pairs(&mut rng, 4));
        let polynomial = polynomial(&roots, &complex);
        let arcs = run_vectors(OnArcs(&polynomial));
        for (arc, coefficients) in arcs.iter().enumerate() {
            for place in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let mut all = *coefficients;
                for row in 1..=POWERS {
                    for j in 0..=POWERS - row {
                        all[j] += place * (all[j + 1] - all[j]);
                    }
                }
                let (sin, cos) = angle(middle(arc), place).sin_cos();
                let [value, ..] = polynomial.values(sin, cos);
                let off = (value - all[0]).abs();
                assert!(off < 16.0 * f64::EPSILON * polynomial.size(), "{arc} {place}: {off:e}");
            }
        }
    }
}

#[test]
fn every_simple_root_is_found_and_no_other() {
    let mut rng = Rng::new(2);
    let mut counts = [0; 17];
    for draw in 0..20_000 {
        let real = 2 * (draw % 9);
        let roots = separate(&mut rng, real, 1e-3);
        let complex = pairs(&mut rng, 8 - real / 2);
        let found = polynomial(&roots, &complex).all_roots();
        // Close roots next to others are in clusters where the noise hides them.
        let Some(count) = found.count_if_simple() else {
            assert!(found.is_complete, "{found:?}");
            for root in &roots {
                let holds = |r: &Root| apart(r.angle(), *root) <= r.radius() + 1e-7;
                assert!(found.as_slice().iter().any(holds), "{roots:?} {found:?}");
            }
            continue;
        };
        counts[real] += 1;
        assert_eq!(count, real, "{roots:?} {complex:?} {:?}", found.as_slice());
        for root in found.as_slice() {
            let off = |other: &f64| apart(root.angle(), *other);
            let nearest = roots.iter().map(off).fold(PI, f64::min);
            // The last step is 3e-4 of an arc, or of the length on which the slope changes; its third
            // power counts by the third derivative, which these pairs leave below 50 / arc^2.
            assert!(nearest <= root.radius() + 3e-10, "{nearest:e} of {:e}", root.radius());
        }
    }
    assert!(counts.iter().step_by(2).all(|count| *count > 1500), "{counts:?}");
}

#[test]
fn two_near_roots_are_two_or_a_cluster_that_holds_them() {
    let mut rng = Rng::new(3);
    for gap in [0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        let mut separated = 0;
        for _ in 0..500 {
            let mut roots = separate(&mut rng, 5, 0.3);
            roots.push(roots[4] + gap);
            let found = polynomial(&roots, &pairs(&mut rng, 5)).all_roots();
            assert!(found.is_complete, "{found:?}");
            for root in &roots {
                let holds = |r: &Root| apart(r.angle(), *root) <= r.radius() + 1e-7;
                assert!(found.as_slice().iter().any(holds), "{gap:e} {roots:?} {found:?}");
            }
            separated += usize::from(found.count_if_simple() == Some(6));
        }
        let all = if gap >= 1e-4 { 450 } else { 0 };
        assert!(separated >= all && (gap > 1e-8 || separated == 0), "{gap:e}: {separated}");
    }
}

#[test]
fn a_pair_that_just_misses_is_no_root_or_a_cluster() {
    let mut rng = Rng::new(4);
    for gap in [0.0, 1e-9, 1e-7, 1e-5, 1e-3] {
        for _ in 0..500 {
            let roots = separate(&mut rng, 4, 0.3);
            let mut complex = pairs(&mut rng, 5);
            complex.push((roots[3] + 0.15, gap));
            let found = polynomial(&roots, &complex).all_roots();
            for root in found.as_slice() {
                let is_root = roots.iter().any(|other| apart(*other, root.angle()) < 1e-6);
                let is_pair = apart(complex[5].0, root.angle()) <= root.radius() + 1e-6;
                assert!(is_root || is_pair && !root.is_simple, "{gap:e} {found:?}");
            }
            assert!(gap < 1e-4 || found.count_if_simple() == Some(4));
        }
    }
}

#[test]
fn noise_is_measured_and_roots_stay_in_their_intervals() {
    let mut rng = Rng::new(5);
    let mut lost = 0;
    for level in [1e-12, 1e-9, 1e-6] {
        for _ in 0..2000 {
            let roots = separate(&mut rng, 6, 0.1);
            let mut samples = samples(&roots, &pairs(&mut rng, 5));
            samples.as_flattened_mut().iter_mut().for_each(|f| *f += rng.between(-level, level));
            let polynomial = of_samples(&samples);
            assert!(polynomial.noise > 0.3 * level && polynomial.noise < 20.0 * level);
            let found = polynomial.all_roots();
            for root in &roots {
                let holds = |r: &Root| apart(r.angle(), *root) <= r.radius() + 1e-7;
                lost += usize::from(!found.as_slice().iter().any(holds));
            }
        }
    }
    // The noise is measured by seven numbers: once in a thousand it is more than it seems.
    assert!(lost < 36, "{lost} of 36000");
}

#[test]
fn what_is_not_a_polynomial_is_not_complete() {
    let zero = of_samples(&[[0.0; LANES]; 3]);
    assert!(zero.is_noise() && !zero.all_roots().is_complete);
    let nan = of_samples(&[[f64::NAN; LANES]; 3]);
    assert!(nan.is_noise() && !nan.all_roots().is_complete);
    let mut rng = Rng::new(6);
    let noise = core::array::from_fn(|_| core::array::from_fn(|_| rng.between(-1.0, 1.0)));
    let noise = of_samples(&noise);
    assert!(noise.is_noise());
}

#[test]
fn instruction_sets_agree() {
    let mut rng = Rng::new(7);
    for _ in 0..500 {
        let roots = separate(&mut rng, 8, 0.05);
        let samples = samples(&roots, &pairs(&mut rng, 4));
        let on = |set| run_on(set, RootsOf(&run_on(set, OfSamples(&samples))));
        let found: Vec<Roots> = InstructionSet::available().map(on).collect();
        let [plain, fused @ ..] = &found[..] else { panic!() };
        for fused in fused {
            for (a, b) in plain.as_slice().iter().zip(fused.as_slice()) {
                assert!(apart(a.angle(), b.angle()) <= a.radius() + b.radius() + 1e-10);
            }
            assert_eq!(plain.as_slice().len(), fused.as_slice().len());
        }
        // With one rounding for a product and a sum, the bits are the same.
        for pair in fused.windows(2) {
            assert_eq!(pair[0].as_slice(), pair[1].as_slice());
        }
    }
}
