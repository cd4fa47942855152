use core::f64::consts::{FRAC_PI_2, PI};
use std::string::ToString;
use std::vec::Vec;

use nalgebra::{Rotation3, Translation3, Vector3};

use super::*;
use crate::rng::Rng;
use irbkin::pose::from_euler_zyx as pose_from_euler_zyx;
use irbkin::{Pose, PoseDifference};

pub(super) fn random(rng: &mut Rng) -> Pose {
    let xyz = [(); 3].map(|()| rng.between(-1.0, 1.0));
    pose_from_euler_zyx(xyz, [rng.between(-PI, PI), rng.between(-1.5, 1.5), rng.between(-PI, PI)])
        .unwrap()
}

pub(super) fn apart(one: &Pose, other: &Pose) -> f64 {
    PoseDifference::between(one, other).largest()
}

/// Largest deviation of R^T R from the identity.
pub(super) fn skew(pose: &Pose) -> f64 {
    let r = pose.rotation.matrix();
    (r.transpose() * r - nalgebra::Matrix3::identity()).abs().max()
}

#[test]
fn a_line_is_even_in_position_and_orientation_and_meets_both_ends() {
    let mut rng = Rng::new(11);
    for _ in 0..500 {
        let (start, end) = (random(&mut rng), random(&mut rng));
        let path = line(&start, &end, Spacing::count(17).unwrap(), None).unwrap();
        assert_eq!((path.len(), path[0], path[16]), (17, start, end));
        let whole = PoseDifference::between(&start, &end);
        for step in path.windows(2) {
            let one = PoseDifference::between(&step[0], &step[1]);
            assert!((one.position - whole.position / 16.0).abs() < 1e-15);
            assert!((one.rotation - whole.rotation / 16.0).abs() < 1e-14);
        }
        assert!(path.iter().all(|pose| skew(pose) < 4e-15));
    }
}

#[test]
fn a_half_turn_needs_an_axis_and_takes_that_way() {
    let start = random(&mut Rng::new(12));
    let about = Vector3::new(0.6, 0.0, 0.8);
    let turned = Rotation3::new(about * PI) * start.rotation;
    let end = Pose::from_parts(start.translation, turned);
    let three = Spacing::count(3).unwrap();
    let refused = line(&start, &end, three, None).unwrap_err().to_string();
    assert!(refused.contains("there are two ways: give axis"), "{refused}");
    for sign in [1.0, -1.0] {
        let path = line(&start, &end, three, Some((about * sign).into())).unwrap();
        let half = Rotation3::new(about * (sign * FRAC_PI_2)) * start.rotation;
        assert!(apart(&path[1], &Pose::from_parts(start.translation, half)) < 1e-14);
    }
    let aside = line(&start, &end, three, Some([0.8, 0.0, -0.6])).unwrap_err().to_string();
    assert!(aside.contains("axis has a part of"), "{aside}");
    assert!(line(&start, &end, three, Some([0.0; 3])).is_err());
}

#[test]
fn steps_are_no_longer_than_asked_and_no_shorter_than_need_be() {
    let mut rng = Rng::new(13);
    for _ in 0..200 {
        let (start, end) = (random(&mut rng), random(&mut rng));
        let (step, turn) = (rng.between(0.01, 0.5), rng.between(0.01, 0.5));
        let path = line(&start, &end, Spacing::step(step, turn).unwrap(), None).unwrap();
        let most = path.windows(2).map(|pair| {
            let apart = PoseDifference::between(&pair[0], &pair[1]);
            (apart.position / step).max(apart.rotation / turn)
        });
        let most = most.fold(0.0, f64::max);
        #[expect(clippy::cast_precision_loss, reason = "a few poses")]
        let steps = (path.len() - 1) as f64;
        assert!(most <= 1.0 + 1e-9 && most * steps > steps - 1.0 - 1e-6, "{most} {steps}");
    }
    let still = random(&mut rng);
    assert_eq!(line(&still, &still, Spacing::step(0.1, 0.1).unwrap(), None).unwrap(), [still]);
    let turned = Pose::from_parts(still.translation, still.rotation * Rotation3::new(Vector3::x()));
    let open = line(&still, &turned, Spacing::step(0.1, f64::INFINITY).unwrap(), None);
    assert!(open.unwrap_err().to_string().contains("give turn, or steps"));
}

#[test]
fn an_arc_stays_on_its_circle_and_passes_the_second_point() {
    let mut rng = Rng::new(14);
    let mut passed = 0;
    for _ in 0..300 {
        let frame = random(&mut rng);
        let (radius, via, end) =
            (rng.between(0.1, 2.0), rng.between(0.1, 3.0), rng.between(3.1, 6.2));
        let on = |angle: f64| {
            let point = Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0);
            frame * Pose::from_parts(Translation3::from(point), Rotation3::identity())
        };
        // The tool stands still relative to the path.
        let riding = |angle: f64| {
            on(angle)
                * Pose::from_parts(Translation3::identity(), Rotation3::new(Vector3::z() * angle))
        };
        let poses = [riding(0.0), riding(via), riding(end)];
        let spacing = Spacing::count(101).unwrap();
        let path = arc(&poses[0], &poses[1], &poses[2], ArcOrientation::Path, spacing).unwrap();
        for (index, pose) in path.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "a hundred poses")]
            let wanted = riding(end * index as f64 / 100.0);
            assert!(apart(pose, &wanted) < 1e-12, "{}", apart(pose, &wanted));
        }
        // The others turn from the same orientation to the same; \CirPointOri through the second.
        for orientation in [ArcOrientation::Object, ArcOrientation::Via] {
            let Ok(path) = arc(&poses[0], &poses[1], &poses[2], orientation, spacing) else {
                continue;
            };
            passed += 1;
            assert!(apart(&path[0], &poses[0]) == 0.0 && apart(&path[100], &poses[2]) == 0.0);
            for pose in &path {
                assert!(skew(pose) < 4e-15);
            }
        }
    }
    assert!(passed > 500, "{passed}");
}

#[test]
fn the_second_pose_of_an_arc_chooses_the_direction_of_its_turn() {
    let mut rng = Rng::new(15);
    for end in [0.5, 2.0, PI, 3.5, 4.0, 5.5] {
        let frame = random(&mut rng);
        let at = |angle: f64, turn: f64| {
            let point = Translation3::new(angle.cos(), angle.sin(), 0.0);
            frame * Pose::from_parts(point, Rotation3::new(Vector3::z() * turn))
        };
        let spacing = Spacing::count(101).unwrap();
        let along = |via: f64, to: f64, orientation| {
            arc(&at(0.0, 0.0), &at(0.5 * end, via), &at(end, to), orientation, spacing)
        };
        // The same orientation everywhere, and the path's own.
        for (turn, orientation) in [(0.0, ArcOrientation::Path), (end, ArcOrientation::Object)] {
            for (index, pose) in along(0.5 * turn, turn, orientation).unwrap().iter().enumerate() {
                #[expect(clippy::cast_precision_loss, reason = "a hundred poses")]
                let part = index as f64 / 100.0;
                let off = apart(pose, &at(end * part, turn * part));
                assert!(off < 1e-12, "{end} {turn}: {off}");
            }
        }
        // Of a half turn the nearer direction; one that is as far from both leaves it open.
        for side in [0.1, -0.1] {
            let found = along(0.5 * end + side, end + PI, ArcOrientation::Path).unwrap();
            let wanted = at(0.5 * end, 0.5 * (end + PI.copysign(side)));
            assert!(apart(&found[50], &wanted) < 1e-12, "{end} {side}");
        }
        // Of none there is one direction, wherever the second pose is.
        for via in [0.0, 1.0, 3.0] {
            let found = along(0.5 * end + via, end + 1e-12, ArcOrientation::Path).unwrap();
            assert!(apart(&found[50], &at(0.5 * end, 0.5 * end)) < 1e-11, "{end} {via}");
        }
        let open = along(0.5 * end, end + PI, ArcOrientation::Path);
        assert!(open.unwrap_err().to_string().contains("there are two ways"));
    }
}

#[test]
fn points_on_a_line_are_no_arc() {
    let at = |x: f64, y: f64| pose_from_euler_zyx([x, y, 0.0], [0.0; 3]).unwrap();
    for (second, third) in [
        (at(1.0, 0.0), at(2.0, 0.0)),
        (at(1.0, 1e-7), at(2.0, 0.0)),
        (at(0.0, 0.0), at(1.0, 0.0)),
        (at(1.0, 0.0), at(0.0, 0.0)),
        (at(0.0, 0.0), at(0.0, 0.0)),
    ] {
        let spacing = Spacing::count(5).unwrap();
        let refused = arc(&at(0.0, 0.0), &second, &third, ArcOrientation::Path, spacing);
        assert!(refused.unwrap_err().to_string().contains("must not lie on a line"));
    }
}

#[test]
fn a_corner_is_as_far_from_its_zone_as_is_said() {
    let mut rng = Rng::new(15);
    let mut corners = 0;
    for _ in 0..200 {
        let poses = [random(&mut rng), random(&mut rng), random(&mut rng)];
        let [before, after] = [(0, 1), (1, 2)]
            .map(|(from, to)| poses[to].translation.vector - poses[from].translation.vector);
        let radius = rng.between(0.0, 2.0);
        let zones = [Zone::FINE, Zone::radius(radius), Zone::FINE];
        let spacing = Spacing::count(2001).unwrap();
        // Two random orientations can be half a turn apart.
        let Ok(path) = polyline(&poses, &zones, spacing) else { continue };
        corners += 1;
        let kept = radius.min(0.5 * before.norm().min(after.norm()));
        let said = corner_distance(kept, before.cross(&after).norm().atan2(before.dot(&after)));
        let nearest =
            path.iter().map(|pose| (pose.translation.vector - poses[1].translation.vector).norm());
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        // Legs of different lengths: the parabola is symmetric, its top is at the corner's step.
        assert!((nearest - said).abs() < 1e-12, "{nearest} {said}");
        // No jump and no kink: equal steps before and behind are as long where the zone begins.
        let steps: Vec<f64> = path.windows(2).map(|pair| apart(&pair[0], &pair[1])).collect();
        assert!(steps.iter().all(|step| *step < 0.02));
    }
    assert!(corners > 190, "{corners}");
}

#[test]
fn zones_are_those_of_abb() {
    let z50 = Zone::named("z50").unwrap();
    assert_eq!((z50.position, z50.orientation), (0.05, 0.075));
    assert!((z50.angle.to_degrees() - 7.5).abs() < 1e-12);
    assert_eq!(Zone::named("fine"), Some(Zone::FINE));
    assert_eq!(Zone::named("z7"), None);
}

/// A line, then an arc, with a zone: the path goes on in its direction where the zone begins
/// and where it ends, and is inside the zone halfway.
#[test]
fn a_corner_between_a_line_and_an_arc_has_no_kink() {
    use super::polyline::{Corner, Leg, Rounded};
    let mut rng = Rng::new(31);
    for _ in 0..200 {
        let [a, b, c, d] = [(); 4].map(|()| random(&mut rng));
        let legs = [
            Leg::line([&a, &b], 1).unwrap(),
            Leg::arc([&b, &c, &d], ArcOrientation::Object).unwrap(),
        ];
        let zone = Zone::radius(rng.between(0.01, 0.1));
        let corner = Corner::new(&zone, &legs[0], &legs[1]);
        let before =
            Rounded { before: None, leg: &legs[0], after: Some((&legs[1], corner)), index: 1 };
        let after =
            Rounded { before: Some((&legs[0], corner)), leg: &legs[1], after: None, index: 2 };
        // The place at a distance from the corner, negative before it.
        let at = |distance: f64| {
            let pose = if distance < 0.0 {
                before.at(1.0 + distance / legs[0].length())
            } else {
                after.at(distance / legs[1].length())
            };
            pose.unwrap().translation.vector
        };
        let h = 1e-6;
        let direction = |from: f64, to: f64| (at(to) - at(from)).normalize();
        let radius = zone.position.min(0.5 * legs[0].length().min(legs[1].length()));
        for place in [-radius, radius] {
            let [behind, ahead] =
                [direction(place - 2.0 * h, place - h), direction(place + h, place + 2.0 * h)];
            // Chords next to the place, 3 h apart: the curvature of the cubic at its ends is at most
            // 3 / radius, as its inner points are 2 / 3 radius from them.
            let bend = (ahead - behind).norm();
            assert!(bend < 2.0 * 3.0 * h * 3.0 / radius, "{place} {bend}");
        }
        assert!((at(-radius) - legs[0].position(1.0 - radius / legs[0].length())).norm() < 1e-12);
        assert!((at(0.0) - b.translation.vector).norm() < radius);
    }
}
