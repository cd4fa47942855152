//! The text of a URDF of a robot.
//!
//! At zero joint angles the frame of every link is parallel to `base_link`, so that origins and
//! axes can be read as in a drawing. Where an axis is along none of x, y and z, the link has z along
//! it, and the next ones are parallel to that link: some programs round other axes, or turn about
//! one of the three. A number has all the digits that it needs to be read back as it is.
//!
//! References: ROS wiki, urdf/XML/robot, link and joint; REP 199 (`base`, `flange`, `tool0`).

use core::f64::consts::FRAC_PI_2;

use nalgebra::Translation3;

use super::text::{Hinge, Text};
use crate::arm::{AnyArm, Arm};
use crate::body::{Capsule, LinkCapsule};
use crate::error::Error;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::constant_pose;

/// The first lines of a file without shapes.
const KINEMATICS: &str =
    "<!-- Kinematics only, in meters and radians: no masses, no shapes. An effort of 0, a velocity";

/// The first lines of a file with shapes.
const SHAPES: &str =
    "<!-- In meters and radians. Shapes are capsules, no masses. An effort of 0, a velocity";

/// The lines that follow.
const HEAD: &[&str] = &[
    "     of 100000 is unknown. At zero links are parallel, but tool0 and behind oblique axes. -->",
    "<!-- MuJoCo accepts no moving link without a mass; other programs ignore this. -->",
    "<mujoco><compiler fusestatic=\"false\" boundmass=\"0.001\" boundinertia=\"0.001\"/></mujoco>",
];

/// Why an arm with a parallelogram linkage has one joint more.
const LINKAGE: &[&str] = &[
    "<!-- Axes 2 and 3 are coupled: joint_3 is the controller's and is measured from the base. The",
    "     joint of the linkage takes joint_2 back, so that joint_2 does not change the pitch of",
    "     link_3. A program that ignores mimic needs -joint_2 for it. -->",
];

impl<const N: usize> Arm<N> {
    /// The text of a URDF of the robot, which [`Self::from_urdf`] reads back.
    ///
    /// Links are `base_link`, `base` (the same), `link_1` to `link_N`, `flange` and `tool0`; joints
    /// are `joint_1` to `joint_N`, with limits and velocities. `tool0` is the flange of this
    /// crate, with z out of it; `flange` has x out of it. With a base, `base_link` is placed in
    /// `world`; with a tool, `tool` is placed in `tool0`. If axes 2 and 3 are coupled, a
    /// passive joint between them mimics joint 2, and joint 3 is the controller's;
    /// [`Robot::uncoupled`] has no such joint. A joint with a limit on one side only gets
    /// [`MOST_ANGLE`](irbkin::thresholds::MOST_ANGLE) on the other. A rail is not written.
    ///
    /// ```
    /// use irbkin_motion::Arm;
    ///
    /// let arm: Arm<6> = Arm::named("IRB 2600-12/1.65")?;
    /// let again = Arm::<6>::from_urdf(&arm.to_urdf(), None, None)?;
    /// let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    /// assert!(again.residual(&q, &arm.fk(&q)).largest() < 1e-14);
    /// # Ok::<(), irbkin_motion::Error>(())
    /// ```
    #[must_use]
    pub fn to_urdf(&self) -> String {
        Written { arm: self, capsules: &[] }.urdf()
    }

    /// [`Self::to_urdf`] with the body of the robot as the `visual` and `collision` elements of the
    /// links: a capsule is a cylinder and the spheres at its ends. What the flange carries is of
    /// `tool0`. Cylinders, pistons and rods that move beside a link ([`Body::parts`]) are left out.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the robot has no body.
    ///
    /// [`Body::parts`]: crate::body::Body::parts
    pub fn to_urdf_with_body(&self) -> Result<String, Error> {
        Ok(Written { arm: self, capsules: self.needed_body()?.capsules() }.urdf())
    }
}

/// An arm, and the capsules that are written.
struct Written<'a, const N: usize> {
    arm: &'a Arm<N>,
    capsules: &'a [LinkCapsule],
}

impl<const N: usize> Written<'_, N> {
    fn urdf(&self) -> String {
        let mut text = Text::new(self.arm.name());
        text.lines(&[if self.capsules.is_empty() { KINEMATICS } else { SHAPES }]);
        text.lines(HEAD);
        if *self.arm.base() != Pose::identity() {
            text.link("world");
            text.fixed("world-base_link", ["world", "base_link"], self.arm.base());
        }
        text.solid_link("base_link", &self.solids(0, &Pose::identity()));
        let (last, t_last_flange) = self.write_chain(&mut text);
        // z of tool0 is x of the flange.
        let turn = constant_pose([0.0; 3], [0.0, FRAC_PI_2, 0.0]);
        let joint = format!("joint_{N}-flange");
        text.link("flange");
        text.fixed(&joint, [&last, "flange"], &(t_last_flange * turn.inverse()));
        text.solid_link("tool0", &self.solids(N + 1, &Pose::identity()));
        text.fixed("flange-tool0", ["flange", "tool0"], &turn);
        if *self.arm.tool() != Pose::identity() {
            text.link("tool");
            text.fixed("tool0-tool", ["tool0", "tool"], self.arm.tool());
        }
        // Last: some programs follow the first joint of each link.
        text.link("base");
        text.fixed("base_link-base", ["base_link", "base"], &Pose::identity());
        text.finished()
    }

    /// Write the links that turn. Returns the last one, and the flange in it.
    fn write_chain(&self, text: &mut Text) -> (String, Pose) {
        let mut parent = "base_link".to_owned();
        // The table's frame in the parent, at zero joint angles.
        let mdh = self.arm.mdh();
        let mut frame = mdh.base;
        for (i, row) in mdh.rows.iter().enumerate() {
            let twist = constant_pose([row.a, 0.0, 0.0], [0.0, 0.0, row.alpha]);
            frame *= twist * constant_pose([0.0, 0.0, row.d], [row.theta, 0.0, 0.0]);
            let direction = frame.rotation.matrix().column(2);
            let is_oblique = direction.iter().filter(|part| **part != 0.0).count() > 1;
            let turned;
            // The link has its origin there, and is parallel to its parent or is the table's frame.
            (turned, frame) = if is_oblique {
                (frame, Pose::identity())
            } else {
                let rotation = Pose::from_parts(Translation3::identity(), frame.rotation);
                (frame.translation.into(), rotation)
            };
            let mut hinge = self.hinge(i, &frame, turned);
            if i == 2 && self.arm.coupling() != 0.0 {
                let second = self.hinge(1, &frame, turned);
                let second = Hinge { axis: second.axis * self.arm.coupling(), ..second };
                text.lines(LINKAGE);
                text.link("linkage");
                text.linkage([&parent, "linkage"], &second, self.arm.limits().linkage());
                "linkage".clone_into(&mut parent);
                hinge.origin = Pose::identity();
            }
            let (joint, child) = (format!("joint_{}", i + 1), format!("link_{}", i + 1));
            text.solid_link(&child, &self.solids(i + 1, &frame));
            text.hinge(&joint, [&parent, &child], &hinge);
            parent = child;
        }
        (parent, frame * mdh.flange)
    }

    /// The capsules of a link, moved from the table's frame into the text's.
    fn solids(&self, link: usize, frame: &Pose) -> Vec<Capsule> {
        let own = self.capsules.iter().filter(|own| own.link == link);
        own.map(|own| own.capsule.moved(frame)).collect()
    }

    /// Joint `i`, counted from zero, about z of a frame in its link.
    fn hinge(&self, i: usize, frame: &Pose, origin: Pose) -> Hinge {
        let axis = frame.rotation.matrix().column(2).normalize();
        let velocity = self.arm.max_velocity().map(|velocity| velocity[i]);
        Hinge { origin, axis, limits: self.arm.limits().to_array()[i], velocity }
    }
}

impl AnyArm {
    /// The text of a URDF of the robot; see [`Arm::to_urdf`].
    #[must_use]
    pub fn to_urdf(&self) -> String {
        match self {
            Self::Six(arm) => arm.to_urdf(),
            Self::Seven(arm) => arm.to_urdf(),
            Self::Five(arm) => arm.to_urdf(),
        }
    }

    /// The text of a URDF with the body of the robot; see [`Arm::to_urdf_with_body`].
    ///
    /// # Errors
    ///
    /// As [`Arm::to_urdf_with_body`].
    pub fn to_urdf_with_body(&self) -> Result<String, Error> {
        match self {
            Self::Six(arm) => arm.to_urdf_with_body(),
            Self::Seven(arm) => arm.to_urdf_with_body(),
            Self::Five(arm) => arm.to_urdf_with_body(),
        }
    }
}
