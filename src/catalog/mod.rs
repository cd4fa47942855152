//! The catalog: arms by name. Their figures are in `arms.txt`.

#[cfg(feature = "std")]
mod alike;
mod designation;
pub(crate) mod fault;
mod left_out;
mod names;
mod rows;

use alloc::vec::Vec;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

use crate::error::{Error, ModelFault};
use crate::kinematics::{
    AnyRobot, DhRow, JointAxis, JointLimits, Joints, Mdh, OpwParameters, Pose, Robot, Sdh,
};
use crate::report::ConfigurationRule;

pub use fault::{LeftOut, UnknownRobot};
pub use left_out::left_out;
pub use names::find;

/// Type names of the GoFa family, with the part before the payload.
const GOFA: &str = "CRB 15000-";

/// One arm of the catalog, with the numbers as printed by its maker.
#[derive(Clone, Debug)]
pub struct CatalogArm {
    /// The maker's type name.
    pub name: &'static str,
    /// Its maker, as "Universal Robots".
    pub maker: &'static str,
    /// Payload [kg], as its type name or the maker's data sheet has it; of several
    /// generations the least.
    pub payload: Option<f64>,
    /// Reach [m] in the type name or the maker's data sheet: rounded, and for ABB's arms to the
    /// wrist center.
    pub reach: Option<f64>,
    /// Its geometry.
    pub geometry: CatalogGeometry,
    /// Unit of the limits, velocities and accelerations.
    pub angles: AngleUnit,
    /// (lower, upper) limit of each joint.
    pub limits: Vec<[f64; 2]>,
    /// Largest velocity of each joint; `None` if no source states it.
    pub max_velocity: Option<Vec<f64>>,
    /// Largest acceleration of each joint; `None` if no source states it.
    pub max_acceleration: Option<Vec<f64>>,
    /// Number of independent sources that agree on the lengths: the confidence in them.
    pub sources: u8,
    /// These sources, then, after semicolons, sources of other figures, where they disagree, and
    /// limits that depend on another axis, which are not modeled.
    pub provenance: &'static str,
}

/// The unit of an arm's angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Degrees.
    Degrees,
    /// Radians.
    Radians,
}

impl AngleUnit {
    #[doc(hidden)]
    pub fn to_radians(self, angle: f64) -> f64 {
        match self {
            Self::Degrees => angle.to_radians(),
            Self::Radians => angle,
        }
    }
}

/// The parallelogram linkage of an ABB arm. It couples axes 2 and 3: the controller measures axis 3
/// from the base, q3_serial = q3 - q2, and so are its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Linkage {
    /// The arm has none.
    None,
    /// It has one; no source has the limits of the linkage.
    LimitsUnknown,
    /// (lower, upper) limit of q3 - q2 [deg].
    Limits([f64; 2]),
}

impl Linkage {
    /// The limits of q3 - q2 [rad].
    fn limits(self) -> Option<[f64; 2]> {
        match self {
            Self::Limits(degrees) => Some(degrees.map(f64::to_radians)),
            Self::None | Self::LimitsUnknown => None,
        }
    }
}

/// The geometry of a catalog arm.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum CatalogGeometry {
    /// Ortho-parallel with a spherical wrist, in ABB's joint convention [mm].
    Abb {
        /// Distance of axis 2 from axis 1.
        a1: f64,
        /// Elbow offset, negative upwards.
        a2: f64,
        /// Height of axis 2.
        c1: f64,
        /// Upper arm.
        c2: f64,
        /// Forearm.
        c3: f64,
        /// Wrist center to flange.
        c4: f64,
        /// The linkage that drives axis 3.
        linkage: Linkage,
    },
    /// Three parallel axes, in Universal Robots' standard Denavit-Hartenberg parameters [mm]:
    /// twists of 90, 0, 0, 90, -90 and 0 deg.
    ThreeParallel {
        /// Height of axis 2.
        d1: f64,
        /// Upper arm; negative, as it points to -x at zero.
        a2: f64,
        /// Forearm; negative too.
        a3: f64,
        /// Distance of the wrist from the plane through axis 1.
        d4: f64,
        /// Distance of the wrist from axis 4.
        d5: f64,
        /// Wrist to flange.
        d6: f64,
    },
    /// FANUC's CRX in the joints of the maker's URDF [mm]: joint 3 is measured from the upper arm.
    Crx {
        /// Height of axis 2.
        d1: f64,
        /// Upper arm.
        a2: f64,
        /// Forearm.
        d4: f64,
        /// Distance of axis 6 from axis 4.
        d5: f64,
        /// Axis 5 to flange.
        d6: f64,
    },
    /// Modified Denavit-Hartenberg rows: alpha [deg], a [mm], d [mm], theta offset [deg].
    Mdh(Vec<[f64; 4]>),
    /// A table of an arm that stands turned on a body, to whose frame poses refer.
    StandingMdh {
        /// Position of the frame before the first row [mm].
        xyz: [f64; 3],
        /// Its rotation: about x, then about its own y, then about its own z [rad].
        turns: [f64; 3],
        /// alpha [deg], a [mm], d [mm], theta offset [deg].
        rows: Vec<[f64; 4]>,
    },
    /// The joints of the maker's URDF, each in the frame of the one before.
    Joints {
        /// Position [mm], rotation about fixed x, y and z [deg], and the axis.
        origins: Vec<([f64; 6], Vector3<f64>)>,
        /// The tip in the frame of the last joint.
        tip: [f64; 6],
    },
}

/// The axes of joints, and the tip, in the base at zero joint angles.
fn joint_axes(origins: &[([f64; 6], Vector3<f64>)], tip: [f64; 6]) -> (Vec<JointAxis>, Pose) {
    let frame = |[x, y, z, roll, pitch, yaw]: [f64; 6]| {
        let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_radians);
        let position = Vector3::new(x, y, z) / 1e3;
        Pose::from_parts(position.into(), Rotation3::from_euler_angles(roll, pitch, yaw))
    };
    let mut at = Pose::identity();
    let mut axes = Vec::new();
    for (origin, axis) in origins {
        at *= frame(*origin);
        axes.push(JointAxis {
            direction: (at.rotation * axis).into(),
            point: at.translation.vector.into(),
        });
    }
    (axes, at * frame(tip))
}

/// The rows of a table in meters and radians.
fn table<const N: usize>(rows: &[[f64; 4]]) -> Option<[DhRow; N]> {
    let rows = <[[f64; 4]; N]>::try_from(rows).ok()?;
    Some(rows.map(|[alpha, a, d, theta]| {
        DhRow::new(alpha.to_radians(), a / 1e3, d / 1e3, theta.to_radians())
    }))
}

/// The frame on which an arm stands: its position [mm] and its rotations about x, y and z [rad].
fn standing(xyz: [f64; 3], turns: [f64; 3]) -> Pose {
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    let [x, y, z] = core::array::from_fn(|i| Rotation3::from_axis_angle(&axes[i], turns[i]));
    let position = Vector3::from(xyz.map(|mm| mm / 1e3));
    IsometryMatrix3::from_parts(position.into(), x * y * z)
}

/// Every arm of the catalog: ABB's by type number, then other makers' arms.
pub fn catalog() -> impl Iterator<Item = CatalogArm> {
    rows::rows().filter_map(rows::Row::arm)
}

impl CatalogArm {
    /// Number of joints.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.limits.len()
    }

    /// Whether a parallelogram linkage couples axes 2 and 3.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.linkage() != Linkage::None
    }

    /// The linkage that couples its axes 2 and 3.
    fn linkage(&self) -> Linkage {
        match self.geometry {
            CatalogGeometry::Abb { linkage, .. } => linkage,
            _ => Linkage::None,
        }
    }

    /// Other names that [`find`] takes for it, besides spellings that differ in what does not
    /// matter.
    pub fn aliases(&self) -> impl Iterator<Item = &'static str> {
        names::aliases(self.name)
    }

    /// How the controller of the arm counts configurations, if in a way of its own
    /// (docs/guide/abb.md). This is known of the arm, not of its structure: other makers' arms with
    /// the same axes have no confdata.
    #[must_use]
    pub fn own_configuration_rule(&self) -> Option<ConfigurationRule> {
        match self.name {
            "IRB 14000-0.5/0.5 (left)" => Some(outward(-1.0)),
            "IRB 14000-0.5/0.5 (right)" | "IRB 14050-0.5/0.5" => Some(outward(1.0)),
            name if name.starts_with(GOFA) => Some(ConfigurationRule::OffsetWrist),
            _ => None,
        }
    }
}

/// Where an arm of a YuMi counts its arm angle from, in the frame of the body: its outer side.
const fn outward(y: f64) -> ConfigurationRule {
    ConfigurationRule::ArmAngle { reference: [0.0, y, 0.0] }
}

impl AnyRobot {
    /// The catalog arm with this name; [`find`] defines which spellings match.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownRobot`], as [`Robot::named`].
    pub fn named(name: &str) -> Result<Self, Error> {
        Self::from_catalog(&find(name)?)
    }

    /// The robot of a catalog arm.
    ///
    /// # Errors
    ///
    /// None for the arms of [`catalog`].
    pub fn from_catalog(arm: &CatalogArm) -> Result<Self, Error> {
        match arm.dof() {
            5 => Robot::<5>::from_catalog(arm).map(Self::from),
            7 => Robot::<7>::from_catalog(arm).map(Self::from),
            _ => Robot::<6>::from_catalog(arm).map(Self::from),
        }
    }
}

impl<const N: usize> Robot<N>
where
    Self: Joints<N>,
{
    /// The catalog arm with this name; [`find`] defines which spellings match.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownRobot`] with up to six close names, or with the reason for which an arm is
    /// left out; [`Error::InvalidModel`] when the arm does not have `N` joints.
    pub fn named(name: &str) -> Result<Self, Error> {
        Self::from_catalog(&find(name)?)
    }

    /// The robot of a catalog arm.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when the arm does not have `N` joints.
    pub fn from_catalog(arm: &CatalogArm) -> Result<Self, Error> {
        let wrong_count = || Error::from(ModelFault::JointCount { found: arm.dof(), wanted: N });
        let limits = <[[f64; 2]; N]>::try_from(&arm.limits[..]).map_err(|_| wrong_count())?;
        let velocity = arm.max_velocity.as_ref().map(|all| <[f64; N]>::try_from(&all[..]));
        let velocity = velocity.transpose().map_err(|_| wrong_count())?;
        let velocity = velocity.map(|all| all.map(|rate| arm.angles.to_radians(rate)));
        let robot = match arm.geometry {
            CatalogGeometry::Abb { a1, a2, c1, c2, c3, c4, linkage } => {
                let [a1, a2, c1, c2, c3, c4] = [a1, a2, c1, c2, c3, c4].map(|mm| mm / 1e3);
                Self::of_opw(OpwParameters::abb(a1, a2, c1, c2, c3, c4))?
                    .with_coupling(linkage != Linkage::None)
            }
            CatalogGeometry::ThreeParallel { d1, a2, a3, d4, d5, d6 } => {
                let rows = [
                    [90.0, 0.0, d1, 0.0],
                    [0.0, a2, 0.0, 0.0],
                    [0.0, a3, 0.0, 0.0],
                    [90.0, 0.0, d4, 0.0],
                    [-90.0, 0.0, d5, 0.0],
                    [0.0, 0.0, d6, 0.0],
                ];
                let rows = table(&rows).ok_or_else(wrong_count)?;
                Self::from_sdh(Sdh { base: Pose::identity(), rows, flange: Pose::identity() })?
            }
            CatalogGeometry::Crx { d1, a2, d4, d5, d6 } => {
                let rows = [
                    [0.0, 0.0, d1, 0.0],
                    [-90.0, 0.0, 0.0, -90.0],
                    [180.0, a2, 0.0, 0.0],
                    [-90.0, 0.0, -d4, 0.0],
                    [90.0, 0.0, d5, 0.0],
                    [-90.0, 0.0, -d6, 0.0],
                ];
                let rows = table(&rows).ok_or_else(wrong_count)?;
                // The flange faces away from axis 6, which points back.
                let half_turn = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
                let flange = Pose::from_parts(
                    Translation3::identity(),
                    Rotation3::from_matrix_unchecked(half_turn),
                );
                Self::from_mdh(Mdh { base: Pose::identity(), rows, flange })?
            }
            CatalogGeometry::Mdh(ref rows) => {
                let rows = table(rows).ok_or_else(wrong_count)?;
                Self::from_mdh(Mdh { base: Pose::identity(), rows, flange: Pose::identity() })?
            }
            CatalogGeometry::StandingMdh { xyz, turns, ref rows } => {
                let rows = table(rows).ok_or_else(wrong_count)?;
                let base = standing(xyz, turns);
                Self::from_mdh(Mdh { base, rows, flange: Pose::identity() })?
            }
            CatalogGeometry::Joints { ref origins, tip } => {
                let (axes, tip) = joint_axes(origins, tip);
                let axes = <[JointAxis; N]>::try_from(axes).map_err(|_| wrong_count())?;
                Self::from_mdh(Mdh::from_joint_axes(&axes, &tip)?)?
            }
        };
        let limits =
            JointLimits::new(limits.map(|limit| limit.map(|angle| arm.angles.to_radians(angle))))?;
        let robot = robot.with_name(arm.name).with_limits(limits).with_max_velocity(velocity)?;
        let linkage = arm.linkage().limits();
        let robot = if linkage.is_some() { robot.with_linkage_limits(linkage)? } else { robot };
        Ok(robot.with_rule(arm.own_configuration_rule()))
    }
}
