//! The collision shapes of a URDF as a body: boxes, cylinders, spheres and capsules. Meshes are not
//! read.
//!
//! Reference: ROS wiki, urdf/XML/link.

use core::fmt::Write as _;

use nalgebra::Vector3;
use roxmltree::Node;

use super::joint::{Joint, Placed, is_own};
use super::sweep::{Carrier, Sweep};
use super::tree::Tree;
use crate::arm::Arm;
use crate::body::{Body, Capsule, LinkCapsule, Shape};
use crate::prelude::*;
use crate::urdf::fault::UrdfFault;
use irbkin::Pose;
use irbkin::internal::constant_pose;
use irbkin::pose::{from_wxyz as pose_from_wxyz, to_euler_zyx as pose_to_euler_zyx};

/// Shapes of an arm, at most: to compare all of them takes quadratic time.
const MOST: usize = 2000;

/// Capsules of these, at most: four of each, or more of those that are swept.
const MOST_CAPSULES: usize = 4 * MOST;

/// How far a sphere may be from the end of a cylinder to make a capsule of both, and their radii
/// from each other [m].
const SAME: f64 = 1e-9;

/// A shape that moves with a link of the chain.
pub(super) struct Solid {
    /// Number of joints of the chain between the base and the link.
    after: usize,
    /// In the frame of the link.
    capsules: Vec<Capsule>,
    /// How far outside the shape the capsules are at most [m].
    excess: f64,
}

/// The shapes of the links that move with the chain, none if the links have none, and a remark on
/// those that move beside it. With a mesh, or a link whose place is not known, there are no shapes:
/// a body without it would be called free where the arm is not.
pub(super) fn solids(
    tree: &Tree<'_>,
    robot: Node<'_, '_>,
    base: usize,
    chain: &[&Joint<'_>],
) -> Result<(Vec<Solid>, String), UrdfFault> {
    let links: Vec<_> = robot.children().filter(|node| is_own(*node, "link")).collect();
    let collisions = |link: usize| links[link].children().filter(|it| it.has_tag_name("collision"));
    let has_shapes = shaped(robot, &["collision"]);
    if !has_shapes.contains(&true) {
        return Ok((Vec::new(), String::new()));
    }
    let mut found = Vec::new();
    let carriers = carriers(tree, base, chain);
    for link in (0..carriers.len()).filter(|link| has_shapes[*link]) {
        let Some(carrier) = carriers[link].clone().transpose()? else { continue };
        let name = || tree.links[link].to_owned();
        let mut shapes = Vec::new();
        for collision in collisions(link) {
            let shape = shape_of(collision);
            let shape = shape.map_err(|what| UrdfFault::Shape { link: name(), what })?;
            shapes.push(shape.ok_or_else(|| UrdfFault::MeshOfBody { link: name() })?);
        }
        for (capsules, excess) in covered(&shapes) {
            let (capsules, growth) = carrier.swept(&capsules);
            found.push(Solid { after: carrier.after, capsules, excess: excess + growth });
        }
        let pieces: usize = found.iter().map(|solid| solid.capsules.len()).sum();
        if found.len() > MOST || pieces > MOST_CAPSULES {
            return Err(UrdfFault::Shapes { bound: MOST });
        }
    }
    Ok((found, remark(tree, &carriers, &has_shapes)))
}

/// Of each link, whether it has one of these elements.
pub(super) fn shaped(robot: Node<'_, '_>, elements: &[&str]) -> Vec<bool> {
    let has = |node: Node<'_, '_>| elements.contains(&node.tag_name().name());
    let links = robot.children().filter(|node| is_own(*node, "link"));
    links.map(|link| link.children().any(has)).collect()
}

/// Which links are swept over the joints beside the chain, and which are left out since no moving
/// link of the chain carries them, of those that have shapes.
pub(super) fn remark(
    tree: &Tree<'_>,
    carriers: &[Option<Result<Carrier, UrdfFault>>],
    has_shapes: &[bool],
) -> String {
    let is_swept =
        |link: &usize| matches!(&carriers[*link], Some(Ok(carrier)) if !carrier.beside.is_empty());
    let shaped = || (0..carriers.len()).filter(|link| has_shapes[*link]);
    let swept = tree.quoted(shaped().filter(is_swept));
    let left_out = tree.quoted(shaped().filter(|link| carriers[*link].is_none()));
    let mut text = String::new();
    for (names, what) in [(swept, "wherever their joints are"), (left_out, "left out")] {
        if !names.is_empty() {
            // Writing to a String does not fail.
            let _ = write!(text, "; {what}: {names}");
        }
    }
    text
}

/// The carrier of each link; `None` if none of the moving links of the chain carries it.
pub(super) fn carriers(
    tree: &Tree<'_>,
    base: usize,
    chain: &[&Joint<'_>],
) -> Vec<Option<Result<Carrier, UrdfFault>>> {
    let mut carriers = vec![None; tree.links.len()];
    carriers[base] = Some(Ok(Carrier { after: 0, beside: Vec::new(), pose: Pose::identity() }));
    for link in tree.hanging_on([base].into_iter()) {
        for &index in &tree.below[link] {
            let joint = &tree.joints[index];
            carriers[joint.child] = below(carriers[link].as_ref(), joint, chain, tree);
        }
    }
    carriers
}

/// The carrier of the child of a joint.
fn below(
    carrier: Option<&Result<Carrier, UrdfFault>>,
    joint: &Joint<'_>,
    chain: &[&Joint<'_>],
    tree: &Tree<'_>,
) -> Option<Result<Carrier, UrdfFault>> {
    let mut carrier = match carrier? {
        Ok(carrier) => carrier.clone(),
        Err(fault) => return Some(Err(fault.clone())),
    };
    if chain.get(carrier.after).is_some_and(|next| core::ptr::eq(*next, joint)) {
        let (after, pose) = (carrier.after + 1, Pose::identity());
        return Some(Ok(Carrier { after, beside: Vec::new(), pose }));
    }
    // Another arm, on the same base.
    let moves = chain[..carrier.after].iter().any(|joint| joint.turns());
    if !moves && joint.kind != "fixed" {
        return None;
    }
    let placed = joint.placed(tree.version).and_then(|placed| {
        carrier.pose *= placed.origin(Some(0.0));
        if joint.kind != "fixed" {
            let sweep = Sweep::of(joint, carrier.beside.len(), tree)?;
            carrier.beside.push((carrier.pose, sweep));
            carrier.pose = Pose::identity();
        }
        Ok(carrier)
    });
    Some(placed)
}

/// The shape of an element; `None` for a mesh, and what is wrong with one that is none.
fn shape_of(collision: Node<'_, '_>) -> Result<Option<Shape>, String> {
    let element = |name: &str| collision.children().find(|child| child.has_tag_name(name));
    let (mut xyz, mut rpy) = ([0.0; 3], [0.0; 3]);
    if let Some(origin) = element("origin") {
        xyz = numbers(origin, "xyz")?.unwrap_or(xyz);
        rpy = numbers(origin, "rpy")?.unwrap_or(rpy);
        if let Some([x, y, z, w]) = numbers(origin, "quat_xyzw")? {
            let turned = pose_from_wxyz([0.0; 3], [w, x, y, z]);
            let (_, zyx) = pose_to_euler_zyx(&turned.map_err(|error| format!("{error}"))?);
            rpy = [zyx[2], zyx[1], zyx[0]];
        }
    }
    let [roll, pitch, yaw] = rpy;
    let pose = constant_pose(xyz, [yaw, pitch, roll]);
    let geometry = element("geometry");
    let Some(solid) = geometry.and_then(|geometry| geometry.first_element_child()) else {
        return Err("has no geometry".to_owned());
    };
    let length = |name: &str| needed(solid, name).map(|[value]| value);
    let shape = match solid.tag_name().name() {
        "box" => Shape::cuboid(needed(solid, "size")?, &pose),
        "sphere" => Shape::sphere(length("radius")?, xyz),
        "cylinder" => Shape::cylinder(length("radius")?, length("length")?, &pose),
        "capsule" => {
            let half = 0.5 * length("length")?;
            let ends = [-half, half].map(|z| pose * nalgebra::Point3::new(0.0, 0.0, z));
            Shape::capsule(ends[0].into(), ends[1].into(), length("radius")?)
        }
        _ => return Ok(None),
    };
    shape.map(Some).map_err(|error| format!("{}: {error}", solid.tag_name().name()))
}

/// The numbers of an attribute that must be there.
fn needed<const K: usize>(node: Node<'_, '_>, name: &str) -> Result<[f64; K], String> {
    let missing = || format!("{} has no {name}", node.tag_name().name());
    numbers(node, name)?.ok_or_else(missing)
}

/// The numbers of an attribute, if it is there.
fn numbers<const K: usize>(node: Node<'_, '_>, name: &str) -> Result<Option<[f64; K]>, String> {
    let Some(text) = node.attribute(name) else { return Ok(None) };
    let words: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    let values = words.and_then(|words| <[f64; K]>::try_from(words).ok());
    let is_finite = |values: &[f64; K]| values.iter().all(|value| value.is_finite());
    if let Some(values) = values.filter(is_finite) {
        return Ok(Some(values));
    }
    let (element, text) = (node.tag_name().name(), text.chars().take(60));
    let text: String = text.collect();
    Err(format!("{element} {name} is {text:?}, it must be {K} finite numbers"))
}

/// Capsules that contain shapes, and their excess. A cylinder with a sphere at each end, written
/// next to it, is a capsule.
fn covered(shapes: &[Shape]) -> Vec<(Vec<Capsule>, f64)> {
    let mut is_end = vec![false; shapes.len()];
    let mut found = Vec::new();
    for (index, shape) in shapes.iter().enumerate() {
        let Shape::Cylinder { pose, radius, half } = shape else { continue };
        let ends =
            [-half, *half].map(|z| pose * nalgebra::Point3::new(0.0, 0.0, z)).map(|p| p.coords);
        let near = index.saturating_sub(2)..(index + 3).min(shapes.len());
        let spheres = ends.map(|end| {
            near.clone().find(|other| {
                matches!(&shapes[*other], Shape::Capsule(ball)
                if ball.is_sphere()
                    && (Vector3::from(ball.ends()[0]) - end).norm() <= SAME
                    && (ball.radius() - radius).abs() <= SAME)
            })
        });
        if let [Some(one), Some(two)] = spheres {
            for used in [index, one, two] {
                is_end[used] = true;
            }
            // In the order in which the text has them.
            let ends = if one < two { ends } else { [ends[1], ends[0]] };
            let capsule = Capsule::known(ends[0].into(), ends[1].into(), *radius);
            found.push((vec![capsule], 0.0));
        }
    }
    let others = shapes.iter().zip(is_end).filter(|(_, is_end)| !is_end);
    // Without a wanted excess there is a cover of each of these shapes.
    let covers = others.filter_map(|(shape, _)| shape.cover(None).ok());
    found.extend(covers.map(|cover| (cover.capsules, cover.excess)));
    found
}

/// The body of the shapes for a robot that the chain makes, in the frames of its table.
pub(super) fn body_of<const N: usize>(
    arm: &Arm<N>,
    solids: &[Solid],
    joints: &[Placed],
    snap: Option<f64>,
    remark: &str,
) -> Option<Body> {
    if solids.is_empty() {
        return None;
    }
    let places = places(arm, joints, snap);
    let (mut capsules, mut excess) = (Vec::new(), vec![0.0_f64; N + 2]);
    for solid in solids {
        let (link, pose) = places[solid.after].as_ref()?;
        excess[*link] = excess[*link].max(solid.excess);
        let moved = solid.capsules.iter().map(|capsule| capsule.moved(pose));
        capsules.extend(moved.map(|capsule| LinkCapsule { link: *link, capsule }));
    }
    if capsules.iter().all(|own| own.link <= N) {
        excess.truncate(N + 1);
    }
    let source = format!("collision shapes of a URDF{remark}");
    Some(arm.body_of_shapes(capsules, excess, source))
}

/// Of the base and of each link behind a joint of the chain: the link of the body, and the pose in
/// its frame. `None` between joint 3 and a linkage, where a link moves with neither neighbor.
pub(super) fn places<const N: usize>(
    arm: &Arm<N>,
    joints: &[Placed],
    snap: Option<f64>,
) -> Vec<Option<(usize, Pose)>> {
    let (frames, _) = arm.link_frames(&[0.0; N]);
    let is_carried = joints.last().is_some_and(|joint| joint.motion.is_none());
    let (mut pose, mut turning, mut coupled) = (*arm.base(), 0, false);
    let mut places = vec![Some((0, Pose::identity()))];
    for (index, joint) in joints.iter().enumerate() {
        pose *= joint.origin(snap);
        if let Some(linkage) = &joint.linkage {
            pose *= linkage.turned(snap.unwrap_or(0.0));
            coupled = true;
        }
        turning += usize::from(joint.motion.is_some());
        let link = turning + usize::from(is_carried && index + 1 == joints.len());
        let is_between = arm.is_coupled() && coupled != (turning > 2);
        let t_frame_link = arm.frame_of_link(link, &frames).inverse() * pose;
        places.push((!is_between).then_some((link, t_frame_link)));
    }
    places
}
