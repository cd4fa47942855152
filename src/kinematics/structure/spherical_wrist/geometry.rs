//! The stored geometry of an arm with a spherical wrist: measured on a modified Denavit-Hartenberg
//! table with an ortho-parallel basis, or from Brandstoetter's parameters.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{Error, ModelFault};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::pose::angles::{sign_of, wrap};
use crate::kinematics::pose::{Pose, translation_z};
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::recognition::{JointFrame, angle, axes, rotation_pose};
use crate::kinematics::thresholds::{FORM_TOLERANCE, LEAST_LINK, MOST_ANGLE, MOST_LENGTH};
use crate::lanes::{Kernel, MOST_SIN_COS, run, sin_cos};
use crate::report::{Pattern, Relation, UnknownStructure};

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist center.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SphericalWrist {
    pub(super) planar: PlanarArm,
    pub(super) joint_map: JointMap<6>,
}

impl SphericalWrist {
    pub(crate) fn from_opw(opw: &OpwParameters) -> Self {
        Self {
            planar: PlanarArm::new([opw.a1, opw.a2, opw.b, opw.c2, opw.c3]),
            joint_map: JointMap {
                signs: opw.signs.map(f64::from),
                offsets: opw.offsets,
                coupling: 0.0,
                t_base_shoulder: translation_z(opw.c1),
                t_wrist_flange: translation_z(opw.c4),
            },
        }
    }

    #[inline]
    pub(super) fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        self.joint_map.theta(q)
    }

    /// The sine of the elbow angle, x of the wrist center in the plane of the arm [m], and the sine
    /// of joint 5, signed (eq. 21).
    #[inline]
    pub(super) fn factors(&self, q: &[f64; 6]) -> [f64; 3] {
        let [_, theta_2, theta_3, _, theta_5, _] = self.theta(q);
        let theta = [theta_2, theta_3, theta_5];
        let [second, third, fifth] = if theta.iter().all(|angle| angle.abs() <= MOST_SIN_COS) {
            run(Sines { theta })
        } else {
            theta.map(f64::sin_cos)
        };
        let [elbow, x] = self.planar.elbow_and_end(second, third);
        [elbow, x, fifth.0]
    }
}

/// Sines and cosines of three angles, side by side.
struct Sines {
    theta: [f64; 3],
}

impl Kernel for Sines {
    type Answer = [(f64, f64); 3];
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> [(f64, f64); 3] {
        // Four fill a vector.
        let (mut angles, mut sin, mut cos) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        angles[..3].copy_from_slice(&self.theta);
        for lane in 0..4 {
            (sin[lane], cos[lane]) = sin_cos::<FUSED>(angles[lane]);
        }
        [(sin[0], cos[0]), (sin[1], cos[1]), (sin[2], cos[2])]
    }
}

/// The conditions of an ortho-parallel basis with a spherical wrist. Axes 4 and 6 intersect axis 5
/// in one point.
pub(crate) static PATTERN: Pattern = Pattern {
    name: "spherical wrist",
    title: "a spherical wrist on an ortho-parallel base",
    conditions: &[
        (Relation::Perpendicular, (1, 2)),
        (Relation::Parallel, (2, 3)),
        (Relation::Perpendicular, (3, 4)),
        (Relation::Perpendicular, (4, 5)),
        (Relation::Perpendicular, (5, 6)),
        (Relation::Meeting, (4, 5)),
        (Relation::Meeting, (5, 6)),
        (Relation::Meeting, (4, 6)),
    ],
};

/// Measure the geometry in the frames at q = 0 (docs/theory/spherical_wrist.md, section 7). The
/// rows give the lengths, so that none is lost to rounding; the frames give the directions.
pub(super) fn measure(mdh: &mut Mdh<6>) -> Result<SphericalWrist, UnknownStructure> {
    let rows = mdh.rows;
    let chain = Chain::new(Mdh { base: Pose::identity(), ..mdh.clone() });
    let [f1, f2, f3, f4, f5, f6] = chain.link_frames(&[0.0; 6]).0.map(|pose| JointFrame::of(&pose));

    // The shoulder: z up, x to the side on which the arm is offset from axis 1 or, without an
    // offset, to where it faces at q1 = 0.
    let sign_1 = if f1.z.z < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let up = f1.z * sign_1;
    let forward = f1.x * facing(rows[1].a, &f1.x);
    let side = up.cross(&forward);
    let (sign_2, sign_3) = (sign_of(f2.z.dot(&side)), sign_of(f3.z.dot(&side)));

    let c2 = rows[2].a.abs();
    let upper_arm = f2.x * sign_of(rows[2].a);
    let theta_2 = angle(&upper_arm, &up, &forward);

    let (sign_4, c3) = (sign_of(rows[3].d), rows[3].d.abs());
    let forearm = f4.z * sign_4;
    let a2 = rows[3].a * f3.x.dot(&side.cross(&forearm));
    let theta_3 = angle(&forearm, &up, &forward) - theta_2;

    let sign_5 = if f5.z.dot(&side) < -FORM_TOLERANCE { -1.0 } else { 1.0 };
    let axis_5 = f5.z * sign_5;
    let theta_4 = angle(&axis_5, &side, &forearm.cross(&side));

    let sign_6 = sign_of(rows[5].d);
    let approach = f6.z * sign_6;
    let theta_5 = angle(&approach, &forearm, &axis_5.cross(&forearm));

    PATTERN.check_lengths([
        ("upper arm (distance of axes 2 and 3)", c2),
        ("forearm (distance of the wrist center from axis 3)", a2.hypot(c3)),
    ])?;
    let wrist_at_zero = axes(&axis_5.cross(&approach), &axis_5, &approach);
    let t_wrist_last = rotation_pose(wrist_at_zero.transpose() * axes(&f6.x, &f6.y, &f6.z))
        * translation_z(rows[5].d);
    let lateral = sign_2 * rows[1].d + sign_3 * rows[2].d;
    let b = if lateral.abs() <= FORM_TOLERANCE {
        // The offsets of rows 2 and 3 along the parallel axes cancel.
        mdh.rows[2].d = -rows[1].d * sign_2 * sign_3;
        0.0
    } else {
        lateral
    };
    let mut shoulder = rotation_pose(axes(&forward, &side, &up));
    shoulder.translation.vector = f1.origin;
    Ok(SphericalWrist {
        planar: PlanarArm::new([rows[1].a * f1.x.dot(&forward), a2, b, c2, c3]),
        joint_map: JointMap {
            signs: [sign_1, sign_2, sign_3, sign_4, sign_5, sign_6],
            offsets: [0.0, -theta_2, -theta_3, -theta_4, -theta_5, 0.0],
            coupling: 0.0,
            t_base_shoulder: mdh.base * shoulder,
            t_wrist_flange: t_wrist_last * mdh.flange,
        },
    })
}

/// The direction along axis x that the arm faces, 1 or -1.
fn facing(a1: f64, x: &Vector3<f64>) -> f64 {
    if a1.abs() > FORM_TOLERANCE {
        return sign_of(a1);
    }
    [x.x, x.y].into_iter().find(|component| component.abs() > FORM_TOLERANCE).map_or(1.0, sign_of)
}

/// Brandstoetter's parameters of an ortho-parallel basis with a spherical wrist.
///
/// At zero angles the arm is upright along z. `theta = sign * q - offset`, as in the
/// `opw_kinematics` library. Reference: Brandstoetter, Angerer, Hofbaur, "An analytical solution of
/// the inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis
/// and a spherical wrist", 2014.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OpwParameters {
    /// Distance of axis 2 from axis 1 [m].
    pub a1: f64,
    /// Elbow offset: distance of axis 4 from axis 3 [m]; negative if it raises the forearm of an
    /// ABB arm at zero.
    pub a2: f64,
    /// Lateral offset of the wrist center from the plane through axis 1 [m].
    pub b: f64,
    /// Height of axis 2 [m].
    pub c1: f64,
    /// Upper arm: distance of axis 3 from axis 2 [m].
    pub c2: f64,
    /// Forearm: distance of the wrist center from axis 3, along axis 4 [m].
    pub c3: f64,
    /// Distance of the flange from the wrist center [m].
    pub c4: f64,
    /// Joint offsets [rad].
    pub offsets: [f64; 6],
    /// Joint signs, each 1 or -1.
    pub signs: [i8; 6],
}

/// Added to each theta to get the angle of the modified Denavit-Hartenberg row
/// (docs/theory/spherical_wrist.md, table 1).
const MDH_SHIFT: [f64; 6] = [0.0, -FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0, PI];

impl OpwParameters {
    /// Parameters in meters with ABB's joint convention: axis 3 is at -90 deg where the arm is
    /// straight, all signs are +1.
    #[must_use]
    pub const fn abb(a1: f64, a2: f64, c1: f64, c2: f64, c3: f64, c4: f64) -> Self {
        Self {
            a1,
            a2,
            b: 0.0,
            c1,
            c2,
            c3,
            c4,
            offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
            signs: [1; 6],
        }
    }

    /// The parameters, checked, with offsets in (-pi, pi]. A lateral offset within
    /// [`FORM_TOLERANCE`] of zero becomes zero, because an offset changes how the shoulder's
    /// branches meet.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a parameter is not finite, a sign is not 1 or -1, or the upper
    /// arm or forearm has no length.
    pub(crate) fn squared_up(self) -> Result<Self, Error> {
        self.check()?;
        // Full turns of an offset would cost digits of every angle.
        let offsets =
            self.offsets.map(|offset| if offset.abs() > PI { wrap(offset) } else { offset });
        Ok(Self { b: if self.b.abs() <= FORM_TOLERANCE { 0.0 } else { self.b }, offsets, ..self })
    }

    fn check(&self) -> Result<(), Error> {
        let lengths = [
            ("a1", self.a1),
            ("a2", self.a2),
            ("b", self.b),
            ("c1", self.c1),
            ("c2", self.c2),
            ("c3", self.c3),
            ("c4", self.c4),
        ];
        for (field, value) in lengths {
            ModelFault::check(field, 0, value, MOST_LENGTH)?;
        }
        for (i, value) in self.offsets.into_iter().enumerate() {
            ModelFault::check("offset of joint", i + 1, value, MOST_ANGLE)?;
            ModelFault::check_radians("offset of joint", i + 1, value)?;
        }
        for (i, sign) in self.signs.into_iter().enumerate() {
            if sign != 1 && sign != -1 {
                return Err(ModelFault::Sign { joint: i + 1, value: sign.into() }.into());
            }
        }
        let forearm = nalgebra::Vector2::new(self.a2, self.c3).norm();
        for (field, value) in [("upper arm c2", self.c2), ("forearm hypot(a2, c3)", forearm)] {
            if value < LEAST_LINK {
                return Err(ModelFault::TooShort { field, value, bound: LEAST_LINK }.into());
            }
        }
        Ok(())
    }

    /// The modified Denavit-Hartenberg table of the arm.
    ///
    /// A joint of sign -1 flips its frame: `Rz(-q) = Rx(pi) Rz(q) Rx(-pi)`; the last flip remains
    /// in the flange transform.
    #[must_use]
    pub fn mdh(&self) -> Mdh<6> {
        let mut rows = [
            DhRow::new(0.0, 0.0, self.c1, 0.0),
            DhRow::new(-FRAC_PI_2, self.a1, self.b, 0.0),
            DhRow::new(0.0, self.c2, 0.0, 0.0),
            DhRow::new(-FRAC_PI_2, -self.a2, self.c3, 0.0),
            DhRow::new(FRAC_PI_2, 0.0, 0.0, 0.0),
            DhRow::new(-FRAC_PI_2, 0.0, self.c4, 0.0),
        ];
        let mut turned = false;
        for (i, row) in rows.iter_mut().enumerate() {
            row.theta = wrap(MDH_SHIFT[i] - self.offsets[i]);
            let turns = self.signs[i] < 0;
            if turns != turned {
                row.alpha = wrap(row.alpha + PI);
            }
            if turns {
                (row.d, row.theta) = (-row.d, wrap(-row.theta));
            }
            turned = turns;
        }
        let flange = if turned { screw_x(PI, 0.0) } else { Pose::identity() };
        Mdh { base: Pose::identity(), rows, flange }
    }
}
