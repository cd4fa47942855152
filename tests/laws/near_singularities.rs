//! Which singularities a joint vector is near, beside every one and far from all.

use std::array;

use irbkin::thresholds::{NEAR_ANGLE, NEAR_LENGTH};
use irbkin::{SingularDistances, SingularityKind};

use crate::common::Rng;
use crate::structures::place::{At, Place};
use crate::structures::{Structure, Subject};

crate::structures::on_every_structure!(
    near_names_a_singularity_that_kinds_has_left,
    near_has_kinds_and_no_more_than_its_distances,
);

crate::structures::on_structures_of_ordinals!(
    near_names_a_zero_of_the_determinant,
    near_has_kinds_and_no_more_than_its_distances,
);

/// Draws of each place and of joint vectors.
const DRAWS: usize = 20;

/// Distances from a singularity [rad, m]: merged, just beside, and within the zones.
const OFF: [f64; 4] = [0.0, 1e-8, 1e-6, 1e-4];

fn near<const N: usize>(subject: &Subject<N>, q: &[f64; N]) -> SingularityKind {
    subject.robot.singularity(q).near(NEAR_ANGLE, NEAR_LENGTH)
}

fn near_names_a_singularity_that_kinds_has_left<const N: usize>(structure: &Structure<N>) {
    let mut rng = Rng::new(1);
    let (mut named, mut left) = (0, 0);
    for subject in &structure.subjects {
        for at in subject.arm.singular_places() {
            let kind = match at {
                At::Wrist | At::Forearm | At::Hand => SingularityKind::WRIST,
                At::Shoulder => SingularityKind::SHOULDER,
                At::Elbow | At::Stretched | At::Folded => SingularityKind::ELBOW,
            };
            for off in OFF {
                for _ in 0..DRAWS {
                    let Some(theta) = subject.arm.at(&Place::of(*at, off), &mut rng) else {
                        continue;
                    };
                    let q = subject.arm.q(theta);
                    let found = near(subject, &q);
                    // Where links of about one length are folded, the shoulder is at the wrist: the
                    // angle between axis 5 or 6 and the line to it is not determined.
                    let is_on_axis = matches!(at, At::Forearm | At::Hand);
                    if is_on_axis && found.contains(SingularityKind::ELBOW) {
                        continue;
                    }
                    assert!(found.contains(kind), "{}, {at:?} {off:e}: {found:?}", subject.name);
                    named += 1;
                    left += usize::from(!subject.robot.singularity(&q).kinds.contains(kind));
                }
            }
        }
    }
    assert!(named > 1000 && left > named / 3, "{named} named, {left} without kinds");
}

fn near_has_kinds_and_no_more_than_its_distances<const N: usize>(structure: &Structure<N>) {
    let mut rng = Rng::new(2);
    let mut far = 0;
    for subject in &structure.subjects {
        for _ in 0..DRAWS * DRAWS {
            let q = rng.angles();
            let found = subject.robot.singularity(&q);
            let [angle, length] = array::from_fn(|_| 10.0_f64.powf(rng.between(-12.0, 0.5)));
            let near = found.near(angle, length);
            assert!(near.contains(found.kinds), "{}, {q:?}", subject.name);
            let [wrist, elbow, shoulder] = match found.distances {
                Some(SingularDistances { wrist, elbow, shoulder }) => [wrist, elbow, shoulder],
                None => [f64::INFINITY, found.min_singular_value, f64::INFINITY],
            };
            for (kind, distance, bound) in [
                (SingularityKind::WRIST, wrist, angle),
                (SingularityKind::ELBOW, elbow, angle),
                (SingularityKind::SHOULDER, shoulder, length),
            ] {
                let is_near = distance <= bound || found.kinds.contains(kind);
                assert_eq!(near.contains(kind), is_near, "{}, {q:?}", subject.name);
            }
            far += usize::from(near.is_empty());
        }
    }
    assert!(far > DRAWS * DRAWS, "{far}");
}

/// Without names, every singularity is a zero of the determinant: between two joint vectors at which
/// it has different signs.
fn near_names_a_zero_of_the_determinant<const N: usize>(structure: &Structure<N>) {
    let mut rng = Rng::new(3);
    let mut named = 0;
    for subject in &structure.subjects {
        let determinant = |q: &[f64; N]| subject.robot.jacobian_determinant(q).unwrap();
        for _ in 0..DRAWS {
            let [mut low, mut high]: [[f64; N]; 2] = [rng.angles(), rng.angles()];
            if determinant(&low) * determinant(&high) >= 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = array::from_fn(|joint| 0.5 * (low[joint] + high[joint]));
                if determinant(&low) * determinant(&middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            for off in OFF {
                let beside = low.map(|angle| angle + off * rng.between(-1.0, 1.0) / 6.0);
                assert_eq!(near(subject, &beside), SingularityKind::ELBOW, "{}", subject.name);
                named += 1;
            }
        }
    }
    assert!(named > 100, "{named}");
}
