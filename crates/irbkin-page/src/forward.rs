//! `fk`: the frames of joint angles, their margins and contacts.

use alloc::vec::Vec;

use irbkin_motion::Arm;
use irbkin_motion::cell::Cell;
use serde::Serialize;

use super::posture::{Contact, Margin, arm_angle, confdata};
use super::request::{Refusal, Request, twelve};

/// The robot at joint angles.
#[derive(Debug, Serialize)]
pub struct Posture {
    /// The pose of the tool.
    pub tool: [f64; 12],
    /// The frame of each link.
    pub frames: Vec<[f64; 12]>,
    /// ABB's confdata.
    pub confdata: Option<[i32; 4]>,
    /// The arm angle [rad].
    pub arm_angle: Option<f64>,
    /// Whether every joint is inside its limits.
    pub within_limits: bool,
    /// Margin to limits and singularities.
    pub margin: Margin,
    /// Distances from the singularities; null where they have no such names.
    pub singular: Option<Distances>,
    /// The slot of the branch.
    pub slot: Option<usize>,
    /// The nearest two, if they are asked for.
    pub contact: Option<Contact>,
}

/// Distances from the singularities.
#[derive(Debug, Serialize)]
pub struct Distances {
    /// From the wrist singularity [rad].
    pub wrist: f64,
    /// From the stretched or folded arm [rad].
    pub elbow: f64,
    /// From the shoulder singularity [m].
    pub shoulder: f64,
}

impl Posture {
    pub(crate) fn read<const N: usize>(
        robot: &Arm<N>,
        cell: &Cell,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let q: [f64; N] = request.joints("q")?;
        let (frames, tool) = robot.link_frames(&q);
        let asked = request.flag("collide")?;
        Ok(Self {
            tool: twelve(&tool),
            frames: frames.iter().map(twelve).collect(),
            confdata: confdata(robot, &q),
            arm_angle: arm_angle(robot, &q),
            within_limits: robot.limits().contains(&q),
            margin: Margin::of(robot, &q),
            singular: robot.singular_distances(&q).map(|distances| Distances {
                wrist: distances.wrist,
                elbow: distances.elbow,
                shoulder: distances.shoulder,
            }),
            slot: robot.slot_of(&q).map(usize::from),
            contact: asked.then(|| Contact::of(robot, cell, &q)).transpose()?,
        })
    }
}
