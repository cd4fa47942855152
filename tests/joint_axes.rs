//! Laws of the tables that are built from joint axes.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{JointAxis, Joints, Mdh, Pose, PoseDifference, Robot, pose};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Unit, Vector3};
use proptest::prelude::*;

/// Relation of an axis to the previous one.
#[derive(Clone, Copy, Debug)]
enum Step {
    Anyhow,
    Parallel(f64),
    Meeting,
    Coincident(f64),
}

fn steps() -> impl Strategy<Value = Step> {
    let sign = || prop_oneof![Just(1.0), Just(-1.0)];
    prop_oneof![
        3 => Just(Step::Anyhow),
        2 => sign().prop_map(Step::Parallel),
        2 => Just(Step::Meeting),
        1 => sign().prop_map(Step::Coincident),
    ]
}

/// A step, and the direction, point and length that it may need.
type Drawn = (Step, [f64; 3], [f64; 3], f64);

fn drawn() -> impl Strategy<Value = Drawn> {
    let direction = prop::array::uniform3(-1.0..1.0)
        .prop_filter("has a length", |d: &[f64; 3]| Vector3::from(*d).norm() > 0.1);
    (steps(), direction, prop::array::uniform3(-1.0..1.0), -0.5..0.5)
}

/// The first axis is to the base's z what each other one is to the previous axis.
fn axes_of<const N: usize>(drawn: &[Drawn; N]) -> [JointAxis; N] {
    let (mut z, mut p) = (Vector3::z(), Vector3::zeros());
    drawn.map(|(step, direction, point, length)| {
        let (direction, point) = (Vector3::from(direction), Vector3::from(point));
        (z, p) = match step {
            Step::Anyhow => (direction, point),
            Step::Parallel(sign) => (z * sign, point),
            Step::Meeting => (direction, p + z * length),
            Step::Coincident(sign) => (z * sign, p + z * length),
        };
        JointAxis { direction: z.into(), point: p.into() }
    })
}

fn tips() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-1.0..1.0), prop::array::uniform3(-PI..PI))
        .prop_map(|(xyz, zyx)| pose::from_euler_zyx(xyz, zyx).unwrap())
}

/// Product of exponentials: the tip at zero, rotated about each axis from the last to the first.
fn fk_of_axes<const N: usize>(axes: &[JointAxis; N], tip: &Pose, q: &[f64; N]) -> Pose {
    axes.iter().zip(q).rev().fold(*tip, |pose, (axis, q)| {
        let point = Vector3::from(axis.point);
        let turn =
            Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis.direction)), *q);
        IsometryMatrix3::from_parts(Translation3::from(point - turn * point), turn) * pose
    })
}

/// Lengths that a pose is summed from [m]: they are long if two axes are nearly parallel.
fn reach_of<const N: usize>(mdh: &Mdh<N>) -> f64 {
    let ends = mdh.base.translation.vector.norm() + mdh.flange.translation.vector.norm();
    1.0 + ends + mdh.rows.iter().map(|row| row.a.hypot(row.d)).sum::<f64>()
}

fn table_moves_like_the_axes<const N: usize>(
    drawn: &[Drawn; N],
    tip: &Pose,
    q: &[f64; N],
) -> Result<(), TestCaseError>
where
    Robot<N>: Joints<N>,
{
    let axes = axes_of(drawn);
    let mdh = Mdh::from_joint_axes(&axes, tip).unwrap();
    let off = PoseDifference::between(
        &Robot::serial_chain(mdh.clone()).unwrap().fk(q),
        &fk_of_axes(&axes, tip, q),
    )
    .largest();
    let bound = 1e-14 * reach_of(&mdh);
    prop_assert!(off <= bound, "off by {off:e}, bound {bound:e}: {mdh:?}");
    for i in 1..N {
        if let Step::Parallel(_) | Step::Coincident(_) = drawn[i].0 {
            prop_assert!(i == 1 || mdh.rows[i - 1].d == 0.0, "between parallel axes: {mdh:?}");
            prop_assert!([0.0, PI].contains(&mdh.rows[i].alpha));
        }
        if let Step::Meeting | Step::Coincident(_) = drawn[i].0 {
            prop_assert!(mdh.rows[i].a == 0.0);
        }
        prop_assert!(
            i == N - 1 || mdh.rows[i].theta.abs() <= FRAC_PI_2 + 1e-9 || mdh.rows[i + 1].a > 0.0
        );
    }
    if let Step::Meeting | Step::Anyhow = drawn[0].0 {
        return Ok(());
    }
    // Height and angle of an upright axis 1 are in the first row, and its distance along x.
    prop_assert_eq!(mdh.base.rotation, Rotation3::identity());
    prop_assert_eq!((mdh.base.translation.x, mdh.base.translation.z), (0.0, 0.0));
    if let Step::Coincident(_) = drawn[0].0 {
        prop_assert_eq!(mdh.base, Pose::identity());
    }
    Ok(())
}

/// Axes along x, y and z at points with three decimals.
fn square() -> impl Strategy<Value = [JointAxis; 6]> {
    let axis = (0..3_usize, any::<bool>(), prop::array::uniform3(-4..5_i32)).prop_map(
        |(along, turned, point)| {
            let mut direction = [0.0; 3];
            direction[along] = if turned { -1.0 } else { 1.0 };
            JointAxis { direction, point: point.map(|tenths| f64::from(tenths) / 10.0) }
        },
    );
    prop::array::uniform6(axis)
}

fn is_quarter_turn(angle: f64) -> bool {
    [-PI, -FRAC_PI_2, 0.0, FRAC_PI_2, PI].contains(&angle)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn tables_of_six_axes_move_like_the_axes(
        drawn in prop::array::uniform6(drawn()),
        tip in tips(),
        q in prop::array::uniform6(-PI..PI),
    ) {
        table_moves_like_the_axes(&drawn, &tip, &q)?;
    }

    #[test]
    fn tables_of_seven_axes_move_like_the_axes(
        drawn in prop::array::uniform7(drawn()),
        tip in tips(),
        q in prop::array::uniform7(-PI..PI),
    ) {
        table_moves_like_the_axes(&drawn, &tip, &q)?;
    }

    #[test]
    fn right_angles_stay_exact(axes in square(), q in prop::array::uniform6(-PI..PI)) {
        let mdh = Mdh::from_joint_axes(&axes, &Pose::identity()).unwrap();
        prop_assert!(mdh.rows.iter().all(|row| is_quarter_turn(row.alpha)), "{mdh:?}");
        // Between parallel axes x may be anywhere; a rotation about them depends on it alone.
        let parallel = (1..6).any(|i| mdh.rows[i].alpha.sin().abs() < 0.5)
            || mdh.rows[0].alpha.sin().abs() > 0.5;
        prop_assert!(parallel || mdh.rows.iter().all(|row| is_quarter_turn(row.theta)), "{mdh:?}");
        let found = Robot::serial_chain(mdh.clone()).unwrap().fk(&q);
        let wanted = fk_of_axes(&axes, &Pose::identity(), &q);
        let off = PoseDifference::between(&found, &wanted).largest();
        prop_assert!(off <= 1e-14 * reach_of(&mdh), "off by {off:e}");
    }

    #[test]
    fn axes_parallel_to_rounding_are_parallel(
        drawn in prop::array::uniform6(drawn()),
        off in 1e-12..9e-10,
        q in prop::array::uniform6(-PI..PI),
    ) {
        let mut axes = axes_of(&drawn);
        let z: Vector3<f64> = Vector3::from(axes[1].direction).normalize();
        let other = if z.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let aside: Vector3<f64> = z.cross(&other).normalize();
        axes[2].direction = Vector3::into(z + aside * off);
        let tip = Pose::identity();
        let mdh = Mdh::from_joint_axes(&axes, &tip).unwrap();
        prop_assert_eq!(mdh.rows[2].alpha, 0.0);
        let found = Robot::serial_chain(mdh.clone()).unwrap().fk(&q);
        let found = PoseDifference::between(&found, &fk_of_axes(&axes, &tip, &q)).largest();
        // Each of the two joints at the deviation rotates it by at most two.
        prop_assert!(found <= (4.0 * off + 1e-14) * reach_of(&mdh), "off by {found:e}");
    }
}

#[test]
fn an_axis_without_direction_is_refused_and_so_is_a_normal_too_far_away() {
    let upright = JointAxis { direction: [0.0, 0.0, 1.0], point: [0.0; 3] };
    let words = |axes: [JointAxis; 3]| {
        Mdh::from_joint_axes(&axes, &Pose::identity()).unwrap_err().to_string()
    };
    assert_eq!(
        words([upright, JointAxis { direction: [0.0; 3], ..upright }, upright]),
        "direction of axis 2 is zero, it must have a length"
    );
    let axis = JointAxis { direction: [0.0, f64::NAN, 0.0], ..upright };
    assert_eq!(words([upright, upright, axis]), "direction of axis 3 is NaN, it must be finite");
    let axis = JointAxis { point: [0.0, 2e6, 0.0], ..upright };
    assert_eq!(
        words([axis, upright, upright]),
        "point of axis 1 is 2e6, its size must be at most 1e6"
    );
    let axis = JointAxis { direction: [0.0, 1e-8, 1.0], point: [0.1, 0.2, 0.0] };
    assert_eq!(
        words([upright, axis, upright]),
        "axes 1 and 2 are 1.0e-8 rad off parallel, their common normal is 2.0e7 m away, it must be at most 1e6 m (are the angles \
         written with all their digits?)"
    );
}

#[test]
fn directions_of_any_length_are_accepted() {
    let axis = |direction| JointAxis { direction, point: [0.1, 0.2, 0.3] };
    let mdh = |size: f64| {
        Mdh::from_joint_axes(&[axis([0.0, 0.0, size]), axis([size, 0.0, 0.0])], &Pose::identity())
            .unwrap()
    };
    for size in [1e-320, 1e-200, 3.0, 1e200, f64::MAX] {
        assert_eq!(mdh(size), mdh(1.0), "{size:e}");
    }
}
