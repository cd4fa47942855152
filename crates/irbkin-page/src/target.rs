//! `ik_target`: what a target, a tool or a work object means.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin::{Pose, Robot, pose, thresholds};
use irbkin_abb::rapid;
use irbkin_abb::rapid::{Content, JointTarget, RapidPose, RobTarget, Value};
use serde::Serialize;

use super::posture::confdata;
use super::request::{Refusal, Request, twelve};

/// A target, or the frame of a tool or of a work object.
#[derive(Debug, Serialize)]
pub struct Meant {
    /// "robtarget", "jointtarget", "tooldata" or "wobjdata".
    pub kind: &'static str,
    /// Its name, if it is declared.
    pub name: Option<String>,
    /// The pose of the tool in the work object; of a tool in the flange frame, of a work object in
    /// the world.
    #[serde(rename = "T")]
    pub pose: [f64; 12],
    /// The confdata that it asks for; of a jointtarget, the confdata of its joints.
    pub confdata: Option<[i32; 4]>,
    /// The external axes, in degrees or millimeters; null for an axis that does not exist.
    pub extax: [Option<f64>; 6],
    /// The joint angles [rad]: of a robtarget, inside the limits and with its confdata.
    pub q: Option<Vec<f64>>,
    /// Why a target has none.
    pub reason: Option<String>,
}

impl Meant {
    pub(crate) fn read<const N: usize>(
        robot: &Robot<N>,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let text = request.text("robtarget")?;
        // The work object is the world of a robot that stands elsewhere.
        let wobj = request.optional_pose("wobj")?.unwrap_or_default();
        let robot = robot.clone().with_base(&(wobj.inverse() * robot.base()))?;
        match value(text)? {
            (name, Value::RobTarget(target)) => Self::of_pose(&robot, name, &target),
            (name, Value::JointTarget(target)) => Self::of_joints(&robot, name, &target),
            (name, Value::ToolData(tool)) if tool.robhold => {
                Self::of_frame("tooldata", name, pose_of(&tool.tframe)?)
            }
            (name, Value::WobjData(wobj)) if !wobj.robhold && wobj.ufprog => {
                let pose = pose_of(&wobj.uframe)? * pose_of(&wobj.oframe)?;
                Self::of_frame("wobjdata", name, pose)
            }
            (_, Value::ToolData(_)) => {
                Err("robhold of the tooldata is FALSE, it must be TRUE here".to_owned().into())
            }
            (_, Value::WobjData(_)) => Err("the work object moves (robhold is TRUE, or ufprog \
                FALSE), it must stand still here"
                .to_owned()
                .into()),
            (_, other) => Err(format!(
                "robtarget is a {}, it must be a robtarget, a jointtarget, a tooldata or a wobjdata",
                other.type_name()
            )
            .into()),
        }
    }

    #[expect(clippy::unnecessary_wraps, reason = "as of the others")]
    fn of_frame(kind: &'static str, name: Option<String>, pose: Pose) -> Result<Self, Refusal> {
        let (confdata, q, reason) = (None, None, None);
        Ok(Self { kind, name, pose: twelve(&pose), confdata, extax: [None; 6], q, reason })
    }

    fn of_pose<const N: usize>(
        robot: &Robot<N>,
        name: Option<String>,
        target: &RobTarget,
    ) -> Result<Self, Refusal> {
        let RobTarget { trans_mm, rot, .. } = *target;
        let pose = pose_of(&RapidPose { trans_mm, rot })?;
        let joints = rapid::calc_joint_t(robot, target, None, None);
        Ok(Self {
            kind: "robtarget",
            name,
            pose: twelve(&pose),
            confdata: Some(target.robconf.into()),
            extax: external(target.extax),
            reason: joints.as_ref().err().map(ToString::to_string),
            q: joints.ok().map(|joints| rapid::joint_vector::<N>(&joints).to_vec()),
        })
    }

    fn of_joints<const N: usize>(
        robot: &Robot<N>,
        name: Option<String>,
        target: &JointTarget,
    ) -> Result<Self, Refusal> {
        let q = rapid::joint_vector::<N>(target);
        let most = thresholds::MOST_ANGLE;
        if let Some((joint, angle)) = (1..).zip(q).find(|(_, angle)| angle.abs() > most) {
            let degrees = angle.to_degrees();
            return Err(format!("joint {joint} of the jointtarget is {degrees:e} deg").into());
        }
        Ok(Self {
            kind: "jointtarget",
            name,
            pose: twelve(&robot.fk(&q)),
            confdata: confdata(robot, &q),
            extax: external(target.extax),
            q: Some(q.to_vec()),
            reason: None,
        })
    }
}

fn pose_of(own: &RapidPose) -> Result<Pose, Refusal> {
    Ok(pose::from_wxyz(own.trans_mm.map(|mm| mm / 1e3), own.rot)?)
}

/// The value of a text: a literal, or the first datum that is declared, with its name.
fn value(text: &str) -> Result<(Option<String>, Value), Refusal> {
    if text.trim_start().starts_with('[') {
        return Ok((None, rapid::parse_record(text)?));
    }
    let module = rapid::parse(text, &[])?;
    let single = module.data().iter().find_map(|datum| match &datum.content {
        Content::Single(value) => Some((Some(datum.name.clone()), value.clone())),
        _ => None,
    });
    let none = || Refusal("robtarget declares no value, nor is it [[x, y, z], ...]".to_owned());
    single.ok_or_else(none)
}

fn external(extax: [f64; 6]) -> [Option<f64>; 6] {
    extax.map(|axis| (axis < rapid::NOT_THERE).then_some(axis))
}
