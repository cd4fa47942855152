//! The inverse: up to eight joint vectors of a pose that may be turned about axis 1.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::{Matrix3, Vector3};

use super::geometry::Geometry;
use super::{PanRoll, SLOTS};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Elbow, Elbows, Shoulder};
use crate::kinematics::thresholds::{REACH_TOLERANCE, UPRIGHT_SIN};
use crate::lanes::atan2;
use crate::report::{FreeJoint, Reach};

/// sin phi up to which the pose may determine the plane of the arm better by its wrist than by its
/// rotation [1]: the rotation of the plane is then off by 1e-9 rad and more.
const NEARLY_UPRIGHT: f64 = 1e-6;

/// A horizontal direction: its sine and its cosine.
type Direction = [f64; 2];

/// The target of a solve, in the shoulder frame.
struct Target {
    rotation: Matrix3<f64>,
    wrist: Vector3<f64>,
    /// The tool center point.
    point: Vector3<f64>,
    /// From the wrist to the tool center point.
    lever: Vector3<f64>,
    /// Sine of the angle of axis 5 from axis 1.
    sin_phi: f64,
}

/// One way for the plane of the arm to contain the tool.
#[derive(Clone, Copy)]
struct Facing {
    /// The plane's direction before the pose is turned by the heading error.
    plane: Direction,
    /// And after that: the direction of theta_1.
    theta_1: Direction,
    sin_phi: f64,
    /// The tool center point from axis 1, along the plane [m].
    reach: f64,
    /// And the wrist.
    wrist: f64,
    /// How far the pose is turned about axis 1 [rad].
    heading: f64,
}

/// Turn a direction into another one: the sine and the cosine of the angle between them.
fn turn([sin, cos]: Direction, [from_sin, from_cos]: Direction) -> Direction {
    [sin * from_cos - cos * from_sin, cos * from_cos + sin * from_sin]
}

fn angle([sin, cos]: Direction) -> f64 {
    atan2::<false>(sin, cos)
}

/// A horizontal vector along a direction, and to its left.
fn along_and_left(vector: &Vector3<f64>, [sin, cos]: Direction) -> [f64; 2] {
    [vector.x * cos + vector.y * sin, vector.y * cos - vector.x * sin]
}

impl Target {
    fn new(arm: &PanRoll, pose: &Pose) -> Self {
        let t_shoulder_wrist = arm.end_frames.wrist_pose(pose);
        let wrist = t_shoulder_wrist.translation.vector;
        let rotation = t_shoulder_wrist.rotation.into_inner();
        let lever = rotation * arm.tool;
        Self {
            rotation,
            wrist,
            point: wrist + lever,
            lever,
            sin_phi: (rotation[(0, 2)].powi(2) + rotation[(1, 2)].powi(2)).sqrt(),
        }
    }

    /// A plane that the wrist is so far along [m], with the heading as it is.
    fn facing(&self, plane: Direction, wrist: f64) -> Facing {
        let axis_5 = self.rotation.column(2).into_owned();
        Facing {
            plane,
            theta_1: plane,
            sin_phi: along_and_left(&axis_5, plane)[0],
            reach: wrist + along_and_left(&self.lever, plane)[0],
            wrist,
            heading: 0.0,
        }
    }

    /// The plane through the wrist that a shoulder faces.
    fn plane_of(&self, shoulder: &Shoulder) -> Facing {
        self.facing([shoulder.sin_1, shoulder.cos_1], shoulder.x)
    }
}

/// An answer while it is filled.
struct Filling<'a> {
    arm: &'a Geometry,
    target: &'a Target,
    free: &'a FreeChoice<5>,
    branches: Branches<5, SLOTS>,
    /// The nearest of those that do not reach.
    missed: Option<Reach>,
    /// The least heading error of those that do [rad].
    least_heading: f64,
}

impl PanRoll {
    /// Every branch of a pose (eq. 150 to 158).
    pub(super) fn branches(&self, pose: &Pose, free: &FreeChoice<5>) -> Branches<5, SLOTS> {
        let target = Target::new(self, pose);
        let filling = self.filled(&target, free, self.tolerance);
        if filling.is_any() {
            return filling.branches;
        }
        let mut branches = filling.branches;
        let turned = self.filled(&target, free, PI);
        branches.reach = if turned.is_any() {
            Reach::Turned { error: turned.least_heading }
        } else {
            turned.missed.unwrap_or(Reach::Reached)
        };
        branches
    }

    fn filled<'a>(
        &'a self,
        target: &'a Target,
        free: &'a FreeChoice<5>,
        tolerance: f64,
    ) -> Filling<'a> {
        let mut filling = Filling {
            arm: &self.geometry,
            target,
            free,
            branches: Branches::empty(Reach::Reached),
            missed: None,
            least_heading: PI,
        };
        if target.sin_phi <= UPRIGHT_SIN {
            filling.fill_upright();
        } else {
            for (base, side) in [(0, 1.0), (4, -1.0)] {
                filling.fill_plane(base, side, tolerance);
            }
        }
        filling
    }
}

impl Filling<'_> {
    fn is_any(&self) -> bool {
        self.branches.q.iter().any(Option::is_some)
    }

    /// Axis 5 parallel to axis 1: the wrist determines the plane, and the roll makes the heading.
    fn fill_upright(&mut self) {
        let planar = &self.arm.planar;
        let wrist = &self.target.wrist;
        let free_theta_1 = self.arm.joint_map.theta(&self.free.q)[0];
        let shoulders = match planar.shoulders([wrist.x, wrist.y], free_theta_1, self.free.policy) {
            Ok(shoulders) => shoulders,
            Err(missed) => return self.miss(missed),
        };
        let mut flags = Status::WRIST;
        let mut free = None;
        if shoulders.merged {
            flags |= Status::SHOULDER;
            free = (planar.b == 0.0).then_some(FreeJoint::Base);
        }
        let kept = if shoulders.keep_behind { &shoulders.behind } else { &shoulders.front };
        let facing = self.target.plane_of(kept);
        let base = if kept.x < 0.0 { 2 } else { 0 };
        self.put(base, &facing, flags, free);
        if shoulders.merged {
            self.merge(base ^ 2, base);
        } else {
            let facing = self.target.plane_of(&shoulders.behind);
            self.put(2, &facing, flags, None);
        }
        self.merge(4, 0);
        self.merge(6, 2);
    }

    /// Fill slots `base` ..= `base` + 3 with the branches of a plane whose direction is the
    /// horizontal part of axis 5, or with -1 for `side` the opposite.
    fn fill_plane(&mut self, base: usize, side: f64, tolerance: f64) {
        let Target { rotation, point, lever, sin_phi, .. } = self.target;
        let [x, y] = [rotation[(0, 2)], rotation[(1, 2)]].map(|of| side * of / sin_phi);
        let plane = [y, x];
        let planar = &self.arm.planar;
        let rounding = planar.position_rounding();

        // How far the tool must be beside axis 1 (eq. 152), and is, with the heading as it is.
        let [lever_ahead, lever_left] = along_and_left(lever, plane);
        let beside = planar.b + lever_left;
        let left = along_and_left(point, plane)[1];
        let as_it_is = self.target.facing(plane, along_and_left(&self.target.wrist, plane)[0]);
        let by_rotation = ((left - beside).abs() <= rounding).then_some(as_it_is);
        let by_wrist = || self.plane_by_wrist(plane);
        let is_upright = *sin_phi <= NEARLY_UPRIGHT;
        let exact =
            if is_upright { by_wrist().or(by_rotation) } else { by_rotation.or_else(by_wrist) };
        let distance = (point.x * point.x + point.y * point.y).sqrt();
        let outside = beside.abs() - distance;
        if outside > REACH_TOLERANCE && exact.is_none() {
            return self.miss(Reach::TooNear { shortfall: outside });
        }
        // Both headings of the plane (eq. 153).
        let root = ((distance - beside.abs()) * (distance + beside.abs())).max(0.0).sqrt();
        let is_one = root <= (rounding * (2.0 * beside.abs() + rounding)).sqrt();
        let turned = |reach: f64| {
            let theta_1 = [reach * point.y - beside * point.x, reach * point.x + beside * point.y];
            let heading = angle(turn(theta_1, plane));
            Facing { theta_1, reach, wrist: reach - lever_ahead, heading, ..as_it_is }
        };
        for (slots, reach) in [(base, root), (base + 2, -root)] {
            let is_there = |exact: &Facing| is_one || (exact.reach < 0.0) == (slots != base);
            let facing = exact.filter(is_there).unwrap_or_else(|| turned(reach));
            if facing.heading.abs() > tolerance {
                continue;
            }
            if is_one {
                self.put(slots, &facing, Status::SHOULDER, None);
                return self.merge(base + 2, base);
            }
            self.put(slots, &facing, Status::empty(), None);
        }
    }

    /// The plane through the wrist, if it contains axis 5 to rounding, on the side of `plane`: next
    /// to where axis 5 is parallel to axis 1, or the tool is on axis 1, the direction of axis 5 alone
    /// has lost digits.
    fn plane_by_wrist(&self, plane: Direction) -> Option<Facing> {
        let wrist = &self.target.wrist;
        let axis_5 = self.target.rotation.column(2).into_owned();
        let found = self.arm.planar.shoulders([wrist.x, wrist.y], 0.0, self.free.policy).ok()?;
        let off = |facing: &Facing| along_and_left(&axis_5, facing.plane)[1].abs();
        [found.front, found.behind]
            .map(|shoulder| self.target.plane_of(&shoulder))
            .into_iter()
            .filter(|facing| off(facing) <= UPRIGHT_SIN && turn(facing.plane, plane)[1] > 0.0)
            .min_by(|one, other| off(one).total_cmp(&off(other)))
    }

    /// The wrist from axis 2 in the plane of the arm (eq. 154, 155).
    fn end(&self, facing: &Facing) -> [f64; 2] {
        let Geometry { planar, below, .. } = self.arm;
        let cos_phi = self.target.rotation[(2, 2)];
        [facing.wrist - below * cos_phi - planar.a1, self.target.wrist.z + below * facing.sin_phi]
    }

    fn miss(&mut self, missed: Reach) {
        self.missed = Some(self.missed.map_or(missed, |nearest| nearest.nearer(missed)));
    }

    /// Put both elbows into `slot` and `slot` + 1 (eq. 156 to 158).
    fn put(&mut self, slot: usize, facing: &Facing, flags: Status, free: Option<FreeJoint>) {
        let free_theta_2 = self.arm.joint_map.theta(&self.free.q)[1];
        let end = self.end(facing);
        let elbows = self.arm.planar.elbows(end, REACH_TOLERANCE, free_theta_2, self.free.policy);
        let Elbows { front, behind, free: is_folded, .. } = match elbows {
            Ok(elbows) => elbows,
            Err(missed) => return self.miss(missed),
        };
        self.least_heading = self.least_heading.min(facing.heading.abs());
        let flags = if behind.is_none() { flags | Status::ELBOW } else { flags };
        let free = if is_folded { Some(FreeJoint::Upper) } else { free };
        let theta_1 = angle(facing.theta_1);
        let theta_5 = angle(self.roll(facing));
        let cos_phi = self.target.rotation[(2, 2)];
        let joints = |elbow: &Elbow| {
            let theta_4 = angle(turn([facing.sin_phi, cos_phi], [elbow.sin_23, elbow.cos_23]));
            let theta = [theta_1, elbow.theta_2, elbow.theta_3, theta_4, theta_5];
            self.arm.joint_map.joints(theta)
        };
        let both = [Some(joints(&front)), behind.as_ref().map(joints)];
        for (slot, q) in [slot, slot + 1].into_iter().zip(both) {
            self.branches.q[slot] = q;
            self.branches.free[slot] = free;
            self.branches.flags[slot] = if q.is_none() { flags | Status::MERGED } else { flags };
        }
    }

    /// The direction of theta_5 (eq. 158): the row of the rotation to the left of the plane.
    fn roll(&self, facing: &Facing) -> Direction {
        let rotation = &self.target.rotation;
        [0, 1].map(|of| along_and_left(&rotation.column(of).into_owned(), facing.plane)[1])
    }

    /// Mark `slot` and `slot` + 1 as merged into `kept` and `kept` + 1, where these are filled.
    fn merge(&mut self, slot: usize, kept: usize) {
        for elbow in 0..2 {
            if self.branches.exists(kept + elbow) {
                self.branches.flags[slot + elbow] =
                    self.branches.flags[kept + elbow] | Status::MERGED;
                self.branches.free[slot + elbow] = self.branches.free[kept + elbow];
            }
        }
    }
}
