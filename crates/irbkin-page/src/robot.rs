//! `robot`: the robot of the page, with all that a drawing of it needs.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use core::f64::consts::PI;
use irbkin::report::ConfigurationRule;

use irbkin::{ByJoints, Error, catalog, on};
use irbkin_motion::AnyArm;
use irbkin_motion::body::{Body, LinkCapsule};
use serde::Serialize;

use super::request::{Refusal, Request, twelve};

/// A robot.
///
/// Its frames at joint angles `q` are `base * links[0] * Rz(q[0]) * links[1] * Rz(q[1]) ...`: after
/// each rotation the frame of a link, after the last one `* flange * tool`. With a coupling,
/// `Rz(q[2] - coupling * q[1])` takes the place of `Rz(q[2])`.
#[derive(Debug, Serialize)]
pub struct Arm {
    /// The catalog name, or the name in the URDF.
    pub name: String,
    /// Number of joints.
    pub dof: usize,
    /// The word for its kinematic structure.
    pub structure: &'static str,
    /// The conditions that keep the arm from a closed form, if it has none.
    pub missing_form: Option<String>,
    /// The name of each slot; none if slots are ordinals.
    pub slot_names: Option<&'static [&'static str]>,
    /// (lower, upper) limit of each joint [rad]; null where a joint has none.
    pub limits: Vec<[f64; 2]>,
    /// (lower, upper) limit of `q[2] - coupling * q[1]` [rad].
    pub linkage: Option<[f64; 2]>,
    /// Largest velocity of each joint [rad/s].
    pub max_velocity: Option<Vec<f64>>,
    /// 1 or -1 if axes 2 and 3 are coupled, else 0.
    pub coupling: f64,
    /// Whether joint angles have a confdata.
    pub has_confdata: bool,
    /// Whether they have an arm angle.
    pub has_arm_angle: bool,
    /// The base in the world, a pose.
    pub base: [f64; 12],
    /// The fixed transform before the rotation of each joint.
    pub links: Vec<[f64; 12]>,
    /// The fixed transform from the last link to the flange.
    pub flange: [f64; 12],
    /// The tool in the flange frame, a pose.
    pub tool: [f64; 12],
    /// The shapes of its links, if they are known.
    pub body: Option<Shapes>,
}

/// Capsules that contain the links of an arm.
#[derive(Debug, Serialize)]
pub struct Shapes {
    /// Whether they are made of the lengths of the arm alone: it may be outside.
    pub approximate: bool,
    /// Where they are from.
    pub source: String,
    /// The capsules of each link: of the base, in the frame `base`, of each joint's link, in its
    /// frame, and of what the flange carries, in its frame.
    pub links: Vec<Vec<Capsule>>,
    /// The capsules of cylinders, pistons and rods beside each link.
    pub parts: Vec<Vec<Capsule>>,
    /// Hulls of links, closer to them than their capsules; of many arms there are none.
    pub hulls: Vec<Hull>,
}

/// All points within a radius of a line; of a point, if both ends are the same.
#[derive(Debug, Serialize)]
pub struct Capsule {
    /// One end of the line [m].
    pub a: [f64; 3],
    /// The other end [m].
    pub b: [f64; 3],
    /// The radius [m].
    pub radius: f64,
}

/// All points within a radius of the convex hull of points.
#[derive(Debug, Serialize)]
pub struct Hull {
    /// Its link, as an index of `links`.
    pub link: usize,
    /// Its points [m].
    pub points: Vec<[f64; 3]>,
    /// Triangles of its surface by their numbers, counterclockwise seen from outside.
    pub faces: Vec<[u8; 3]>,
    /// The radius [m].
    pub radius: f64,
}

/// The arm of six or of seven joints.
pub(crate) type Arms =
    ByJoints<irbkin_motion::Arm<6>, irbkin_motion::Arm<7>, irbkin_motion::Arm<5>>;

/// The robot of a request.
pub(crate) fn read(request: &Request<'_>) -> Result<Arms, Refusal> {
    let arm = match (request.optional_text("name")?, request.optional_text("urdf")?) {
        (Some(name), None) => AnyArm::from_catalog(&catalog::find(name)?)?,
        (None, Some(urdf)) => {
            let (base, tip) = (request.optional_text("base")?, request.optional_text("tip")?);
            AnyArm::from_urdf(urdf, base, tip)?
        }
        (None, None) => return Err("name is missing, and so is urdf".to_owned().into()),
        (Some(_), Some(_)) => {
            return Err("there is a name and a urdf, it must be one of them".to_owned().into());
        }
    };
    Ok(match on!(Arms::from(arm), arm => placed(arm, request)?.into()) {
        // A tool that is dragged keeps its position, whatever heading it takes.
        Arms::Five(arm) => arm.map(|robot| robot.with_heading_tolerance(PI))?.into(),
        arm => arm,
    })
}

/// The robot with the tool and the base of a request, and with a body if it has none.
fn placed<const N: usize>(
    mut arm: irbkin_motion::Arm<N>,
    request: &Request<'_>,
) -> Result<irbkin_motion::Arm<N>, Refusal> {
    if arm.body().is_none()
        && let Ok(body) = arm.approximate_body()
    {
        arm = arm.with_body(Some(body))?;
    }
    let named = |field: &'static str| move |error: Error| Refusal(format!("{field}: {error}"));
    if let Some(tool) = request.optional_pose("tool")? {
        arm = arm.map(|robot| robot.with_tool(&tool)).map_err(named("tool"))?;
    }
    if let Some(base) = request.optional_pose("base_pose")? {
        arm = arm.map(|robot| robot.with_base(&base)).map_err(named("base_pose"))?;
    }
    Ok(arm)
}

impl Arm {
    pub(crate) fn of<const N: usize>(robot: &irbkin_motion::Arm<N>) -> Self {
        let rule = robot.configuration_rule().ok();
        let mut before = *robot.base();
        let (frames, _) = robot.link_frames(&[0.0; N]);
        let links = frames.iter().map(|frame| {
            let link = before.inverse() * frame;
            before = *frame;
            twelve(&link)
        });
        Self {
            name: robot.name().to_owned(),
            dof: N,
            structure: robot.structure(),
            missing_form: robot.missing_form().map(|missing| missing.to_string()),
            slot_names: robot.slot_names(),
            limits: robot.limits().to_array().to_vec(),
            linkage: robot.limits().linkage(),
            max_velocity: robot.max_velocity().map(|velocity| velocity.to_vec()),
            coupling: robot.coupling(),
            has_confdata: rule.is_some(),
            has_arm_angle: matches!(rule, Some(ConfigurationRule::ArmAngle { .. })),
            base: twelve(robot.base()),
            links: links.collect(),
            flange: twelve(&robot.mdh().flange),
            tool: twelve(robot.tool()),
            body: robot.body().map(|body| Shapes::of(body, N)),
        }
    }
}

impl Shapes {
    fn of(body: &Body, dof: usize) -> Self {
        let by_link = |all: &[LinkCapsule]| {
            let of = |link| {
                let own = all.iter().filter(move |own| own.link == link);
                own.map(|own| Capsule::from(&own.capsule)).collect()
            };
            (0..dof + 2).map(of).collect()
        };
        let hulls = body.hulls().iter().map(|own| Hull {
            link: own.link,
            points: own.hull.points().collect(),
            faces: own.hull.faces().to_vec(),
            radius: own.hull.radius(),
        });
        Self {
            approximate: body.is_approximate(),
            source: body.source().to_owned(),
            links: by_link(body.capsules()),
            parts: by_link(body.parts()),
            hulls: hulls.collect(),
        }
    }
}

impl From<&irbkin_motion::body::Capsule> for Capsule {
    fn from(capsule: &irbkin_motion::body::Capsule) -> Self {
        let [a, b] = capsule.ends();
        Self { a, b, radius: capsule.radius() }
    }
}
