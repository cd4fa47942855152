use core::f64::consts::PI;
use std::string::ToString;
use std::vec::Vec;

use nalgebra::{Rotation3, Translation3, Vector3};

use super::line::Turn;
use super::spline::{Span, spans};
use super::tests::{apart, random, skew};
use super::*;
use crate::rng::Rng;
use irbkin::{Pose, PoseDifference};

fn poses(rng: &mut Rng, count: usize) -> Vec<Pose> {
    (0..count).map(|_| random(rng)).collect()
}

/// From one random pose to the next, turning by up to 2 rad.
fn mild(rng: &mut Rng, count: usize) -> Vec<Pose> {
    let mut met = std::vec![random(rng)];
    while met.len() < count {
        let last = met[met.len() - 1];
        let turn = Vector3::from([(); 3].map(|()| rng.between(-1.15, 1.15)));
        let place = Vector3::from([(); 3].map(|()| rng.between(-1.0, 1.0)));
        met.push(Pose::from_parts(place.into(), last.rotation * Rotation3::new(turn)));
    }
    met
}

fn spans_of(met: &[Pose]) -> Vec<Span> {
    let indices: Vec<usize> = (0..met.len()).collect();
    spans(met, &indices).unwrap()
}

/// The path with `parts` equal steps from each pose to the next, whatever their distances.
fn even(met: &[Pose], parts: usize) -> Vec<Vec<Pose>> {
    let part = |step| super::line::part(step, parts);
    let along = |span: Span| (0..=parts).map(|step| span.at(part(step)).unwrap()).collect();
    spans_of(met).into_iter().map(along).collect()
}

fn rotation_vector(from: &Pose, to: &Pose) -> Vector3<f64> {
    Turn::new(&from.rotation, &to.rotation, None, 1).unwrap().vector()
}

#[test]
fn a_spline_meets_every_pose_in_equal_steps_between() {
    let mut rng = Rng::new(21);
    for case in 0..200 {
        let met = mild(&mut rng, 2 + case % 9);
        let path = spline(&met, Spacing::step(0.005, f64::INFINITY).unwrap()).unwrap();
        let places: Vec<usize> =
            met.iter().map(|pose| path.iter().position(|other| other == pose).unwrap()).collect();
        assert_eq!((places[0], places[met.len() - 1]), (0, path.len() - 1));
        assert!(path.iter().all(|pose| skew(pose) < 4e-15));
        let steps =
            path.windows(2).map(|pair| PoseDifference::between(&pair[0], &pair[1]).position);
        assert!(steps.into_iter().all(|step| step <= 0.005 * (1.0 + 1e-9)));
        // The length of each step, by fifty chords.
        for span in even(&met, 20 * 50) {
            let chords = span.windows(2).map(|pair| PoseDifference::between(&pair[0], &pair[1]));
            let chords: Vec<f64> = chords.map(|apart| apart.position).collect();
            let steps: Vec<f64> = chords.chunks(50).map(|chords| chords.iter().sum()).collect();
            let longest = steps.iter().copied().fold(0.0, f64::max);
            // Where the curve all but turns back, one chord of fifty may be cut short.
            assert!(steps.iter().all(|step| *step > 0.98 * longest), "{case}: {steps:?}");
        }
    }
}

#[test]
fn a_spline_through_two_poses_is_the_line() {
    let mut rng = Rng::new(22);
    for _ in 0..100 {
        let met = poses(&mut rng, 2);
        let spacing = Spacing::count(17).unwrap();
        let straight = line(&met[0], &met[1], spacing, None).unwrap();
        let path = spline(&met, spacing).unwrap();
        assert_eq!((path[0], path[16]), (met[0], met[1]));
        assert!(path.iter().zip(&straight).all(|(one, other)| apart(one, other) < 1e-14));
    }
}

#[test]
fn evenly_turning_poses_on_a_line_are_a_line() {
    let mut rng = Rng::new(23);
    for _ in 0..100 {
        let ends = poses(&mut rng, 2);
        let whole = line(&ends[0], &ends[1], Spacing::count(41).unwrap(), None).unwrap();
        let met = [whole[0], whole[3], whole[4], whole[20], whole[40]];
        let path = spline(&met, Spacing::count(41).unwrap()).unwrap();
        for (one, other) in path.iter().zip(&whole) {
            assert!(apart(one, other) < 1e-13, "{}", apart(one, other));
        }
    }
}

#[test]
fn position_and_orientation_have_two_continuous_derivatives() {
    let mut rng = Rng::new(24);
    // Jumps of the second derivative, estimated at two distances: what is continuous falls with it.
    let mut jumps = [[0.0_f64; 2]; 2];
    for _ in 0..50 {
        let met = mild(&mut rng, 6);
        let spans = spans_of(&met);
        for (pair, pose) in spans.windows(2).zip(&met[1..]) {
            for (scale, jumps) in [1e-3, 1e-4].into_iter().zip(&mut jumps) {
                let x = scale * pair[0].length().min(pair[1].length());
                let before = |k: f64| pair[0].at(1.0 - k * x / pair[0].length()).unwrap();
                let after = |k: f64| pair[1].at(k * x / pair[1].length()).unwrap();
                let at = pose.translation.vector;
                let bend = |side: &dyn Fn(f64) -> Pose| {
                    let (near, far) = (side(1.0).translation.vector, side(2.0).translation.vector);
                    (at - near * 2.0 + far) / (x * x)
                };
                jumps[0] = jumps[0].max((bend(&before) - bend(&after)).norm() * x);
                // The rotation vectors to both sides are opposite, but for terms of third order.
                let sides = [before(1.0), after(1.0)].map(|side| rotation_vector(pose, &side));
                jumps[1] = jumps[1].max((sides[0] + sides[1]).norm() / x);
            }
        }
    }
    // A continuous second derivative: the jump of an estimate falls by ten, times x by a hundred.
    for which in 0..2 {
        assert!(jumps[1][which] < 0.02 * jumps[0][which], "{jumps:?}");
    }
}

#[test]
fn a_turn_is_no_larger_than_asked_and_poses_not_many_more_than_it_takes() {
    let mut rng = Rng::new(25);
    let mut tried = 0;
    for _ in 0..300 {
        let met = mild(&mut rng, 5);
        let turn = rng.between(0.003, 0.3);
        let path = spline(&met, Spacing::step(f64::INFINITY, turn).unwrap()).unwrap();
        let turns: Vec<f64> = path
            .windows(2)
            .map(|pair| PoseDifference::between(&pair[0], &pair[1]).rotation)
            .collect();
        assert!(turns.iter().all(|own| *own <= turn * (1.0 + 1e-9)), "{turn}");
        if turn < 0.02 {
            tried += 1;
            let most = turns.iter().copied().fold(0.0, f64::max);
            assert!(most > 0.9 * turn, "{most} {turn}");
        }
    }
    assert!(tried > 5);
}

#[test]
fn where_two_poses_have_one_orientation_it_is_kept() {
    let mut rng = Rng::new(26);
    for _ in 0..50 {
        let mut met = mild(&mut rng, 6);
        met[3].rotation = met[2].rotation;
        let spans = even(&met, 40);
        assert!(spans[2].iter().all(|pose| rotation_vector(&met[2], pose).norm() < 1e-14));
        // About one axis: from each pose to the next by their angle, and a little beyond at most.
        let about = Vector3::new(0.6, 0.0, 0.8);
        let mut angle = 0.0;
        for pose in &mut met {
            pose.rotation = Rotation3::new(about * angle);
            angle += rng.between(0.0, 1.0) * rng.between(0.0, 1.0) * 3.0;
        }
        for span in even(&met, 100) {
            let whole = rotation_vector(&span[0], &span[100]).norm();
            for pose in &span {
                let angle = rotation_vector(&span[0], pose).dot(&about);
                assert!(angle >= -0.071 * whole - 1e-14 && angle <= 1.071 * whole + 1e-14);
            }
        }
    }
}

#[test]
fn a_circle_is_met_to_the_fourth_order() {
    let error = |count: usize| {
        let on = |index: usize| {
            let angle = 2.0 * PI * super::line::part(index, count);
            let place = Translation3::new(angle.cos(), angle.sin(), 0.0);
            Pose::from_parts(place, Rotation3::identity())
        };
        let met: Vec<Pose> = (0..=count).map(on).collect();
        let path = spline(&met, Spacing::step(1e-3, f64::INFINITY).unwrap()).unwrap();
        let off = path.iter().map(|pose| (pose.translation.vector.norm() - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(20), error(40));
    assert!(fine < coarse / 12.0 && fine < 1e-4, "{coarse} {fine}");
}

#[test]
fn repeated_single_and_turned_poses_are_defined() {
    let mut rng = Rng::new(27);
    let met = mild(&mut rng, 4);
    let count = Spacing::count(31).unwrap();
    let step = Spacing::step(0.01, 0.01).unwrap();
    // A repeated pose is left out, at the ends too.
    let twice: Vec<Pose> = met.iter().flat_map(|pose| [*pose, *pose]).collect();
    assert_eq!(spline(&twice, count).unwrap(), spline(&met, count).unwrap());
    assert_eq!(spline(&met[..1], count).unwrap(), &met[..1]);
    assert_eq!(spline(&twice[..2], step).unwrap(), &met[..1]);
    assert_eq!(spline(&twice[..2], count).unwrap(), std::vec![met[0]; 31]);
    assert!(spline(&[], count).unwrap_err().to_string().contains("T has 0 rows"));
    // Where the tool only turns, it stays: its neighbors are splines of their own.
    let mut turning = met[1];
    turning.rotation *= Rotation3::new(Vector3::new(0.3, -0.2, 0.5));
    let path = spline(&[met[0], met[1], turning, met[2], met[3]], step).unwrap();
    let still = path.iter().filter(|pose| pose.translation == met[1].translation);
    let still: Vec<&Pose> = still.collect();
    assert_eq!(still.len(), 63);
    let turns: Vec<f64> =
        still.windows(2).map(|pair| rotation_vector(pair[0], pair[1]).norm()).collect();
    assert!(turns.iter().all(|turn| (turn - turns[0]).abs() < 1e-14));
    let open = spline(&[met[0], met[1], turning], Spacing::step(0.01, f64::INFINITY).unwrap());
    assert!(open.unwrap_err().to_string().contains("give turn, or steps"));
    // The straight part before it is even, and the parts add up.
    let alone = spline(&[turning, met[2], met[3]], step).unwrap();
    assert_eq!(path[path.len() - alone.len()..], alone);
    // Half a turn is refused, wherever it is.
    let mut turned = met[2];
    turned.rotation = met[1].rotation * Rotation3::new(Vector3::new(0.0, 0.0, PI));
    let refused = spline(&[met[0], met[0], met[1], turned, met[3]], count).unwrap_err();
    assert!(refused.to_string().contains("180.000000 deg to pose 3"), "{refused}");
    let few = spline(&met, Spacing::count(3).unwrap()).unwrap_err().to_string();
    assert!(few.contains("steps must be 4 to"), "{few}");
}

#[test]
fn points_that_go_back_and_forth_or_lie_unevenly_are_met() {
    let at = |x: f64| Pose::from_parts(Translation3::new(x, 0.0, 0.0), Rotation3::identity());
    let spacing = Spacing::step(0.01, f64::INFINITY).unwrap();
    for places in [[0.0, 1.0, 0.0, 1.0], [0.0, 1e-8, 1.0, 1.0 + 1e-8], [0.0, 1e3, 0.0, 1e-6]] {
        let met = places.map(at);
        let path = spline(&met, spacing).unwrap();
        for pose in &met {
            assert!(path.contains(pose), "{places:?}");
        }
        let longest = path.windows(2).map(|pair| apart(&pair[0], &pair[1])).fold(0.0, f64::max);
        assert!(longest <= 0.01 * (1.0 + 1e-9), "{places:?} {longest}");
    }
}

#[test]
fn a_speed_is_a_step_in_a_period() {
    let mut rng = Rng::new(28);
    let met = mild(&mut rng, 3);
    let speed = Spacing::speed(0.25, 0.004, 0.1).unwrap();
    assert_eq!(speed, Spacing::step(0.001, 0.1).unwrap());
    let zones = [Zone::FINE, Zone::radius(0.05), Zone::FINE];
    let paths = [
        line(&met[0], &met[1], speed, None).unwrap(),
        arc(&met[0], &met[1], &met[2], ArcOrientation::Object, speed).unwrap(),
        polyline(&met, &zones, speed).unwrap(),
        spline(&met, speed).unwrap(),
    ];
    for path in paths {
        let way: f64 =
            path.windows(2).map(|pair| PoseDifference::between(&pair[0], &pair[1]).position).sum();
        #[expect(clippy::cast_precision_loss, reason = "a few thousand poses")]
        let speed = way / (0.004 * (path.len() - 1) as f64);
        assert!(speed <= 0.25 * (1.0 + 1e-9) && speed > 0.24, "{speed}");
    }
    for (speed, period, words) in [
        (0.0, 0.004, "speed is 0.0, it must be positive"),
        (-1.0, 0.004, "speed is -1.0"),
        (f64::NAN, 0.004, "speed is NaN"),
        (f64::INFINITY, 0.004, "speed is inf"),
        (1.0, 0.0, "dt is 0.0"),
        (1.0, f64::NAN, "dt is NaN"),
    ] {
        let refused = Spacing::speed(speed, period, 1.0).unwrap_err().to_string();
        assert!(refused.contains(words), "{refused}");
    }
}
